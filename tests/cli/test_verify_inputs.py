"""`contoursolve verify`: its inputs, its receipt, settings and certificates, and programs that were changed since."""

import ast
import json
import re
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path
from random import Random
from typing import Any

import pytest
from calling import run
from hypothesis import HealthCheck, given, settings, strategies as st
from verifying import EXTENDED, LINE, MILL, PAIR, PROGRAM, PROGRAMS, SAMPLES, Desk, Place, failures, with_contour

import contoursolve


@pytest.fixture
def desk(tmp_path):
    return Desk(tmp_path)


def test_either_input_may_be_standard_input(desk):
    result = desk.solve(PROGRAM)
    desk.verify(result)
    assert run("verify", "-", desk.result, stdin=PROGRAM)[0] == 0
    assert run("verify", desk.program, "-", stdin=json.dumps(result))[0] == 0
    assert run("verify", "-", "-", stdin=PROGRAM)[0] == 2


def test_verify_takes_what_solve_takes(desk):
    block = "G111 X100. A180. K-30. B120. P?"
    apart = ("--start", "X40. Z0.", "--fact", "straight part of line 2 = 20")
    desk.result.write_text(run("solve", "--block", block, *apart, "--format", "json")[1], encoding="utf-8")
    status, output, _ = run("verify", "--block", block, *apart, desk.result, "--format", "json")
    receipt = json.loads(output)
    assert (status, receipt["verdict"], receipt["start"], receipt["facts"]) == (0, "verified", apart[1], [apart[3]])
    for old, new in (("X40.", "X41."), ("= 20", "= 21"), ("B120.", "B121.")):
        options = [each.replace(old, new) for each in ("--block", block, *apart)]
        assert run("verify", *options, desk.result)[0] == 1
    output = run("verify", "--block", block, *apart[:2], desk.result)[1]
    assert "the facts are those of the program; but the program has none, and the result has straight part of" in output
    desk.program.write_text(PROGRAM, encoding="utf-8")
    for wrong, message in (
        ((desk.program,), "name PROGRAM and RESULT.json"),
        (("--block", block), "name RESULT.json and no PROGRAM"),
        (("--block", block, desk.program, desk.result), "name RESULT.json and no PROGRAM"),
    ):
        status, _, errors = run("verify", *wrong)
        assert (status, message in errors) == (2, True)
    several = desk.solve(SAMPLES["one after the other"])
    desk.verify(several)
    status, _, errors = run("verify", desk.program, desk.result, "--fact", "length of line 1 = 3")
    assert (status, "a fact is about the only contour, and the program has 3 (program lines 2, 4, 5)" in errors) == (
        2,
        True,
    )


@pytest.mark.parametrize(
    ("name", "setting", "value"),
    [
        ("two circles", "nct-99m.circle-circle-q", "right-is-negative"),
        ("G112, bevels", "yasnac-lx3.bevel", "setback"),
        ("two bevels", "yasnac-lx3.bevel", "length"),
        ("bevel and rounding", "yasnac-lx3.bevel", "setback"),
    ],
)
def test_the_program_is_read_with_the_settings_that_the_result_names(desk, name, setting, value):
    other = desk.solve(SAMPLES[name])
    result = desk.solve(SAMPLES[name], "--setting", f"{setting}={value}")
    assert other["contours"][0]["elements"] != result["contours"][0]["elements"]
    for each, settings_of in ((other, {}), (result, {setting: value})):
        receipt = desk.receipt(each)
        assert (failures(receipt), receipt["verdict"], receipt["settings"]) == ([], "verified", settings_of)
    assert f"read with {setting}={value}, as the result says" in desk.verify(result)[1]
    assert desk.is_wrong({**result, "settings": {}})
    assert desk.is_wrong({**other, "settings": {setting: value}})
    assert desk.is_wrong(with_contour(result, conventions=[]))
    for unknown, message in (
        ({"fanuc.bevel": value}, "has the setting 'fanuc.bevel', which is none of"),
        ({setting: "none"}, "has a setting that is none"),
        ({setting: 5}, "settings[...]: expected `str`, got `int`"),
        ([], "settings: expected `object`, got `array`"),
    ):
        status, output, errors = desk.verify({**result, "settings": unknown})
        assert (status, output, message in errors) == (2, "", True), errors


def test_contours_missing_added_or_twice_are_found(desk):
    result = desk.solve(SAMPLES["one after the other"])
    contours = result["contours"]
    for wrong in (contours[:1], contours[1:], [], [*contours, contours[0]], [*contours, {**contours[0], "line": 1}]):
        assert desk.receipt({**result, "contours": wrong})["verdict"] == "failed"
    receipt = desk.receipt({**result, "contours": contours[:2]})
    assert [contour["status"] for contour in receipt["contours"]] == ["solved", "solved", None]


AFTERWARDS = {
    PROGRAM: (
        "X40. > X40.001 | Z0. > Z0.001 | X100. > X100.001 | X100. > U100. | X100. > | X100. > Z-50. | A180. > A180.001"
        " | A180. > A0 | A180. > I1. | A180. > A180. I1. | K-30. > K-30.001 | B120. > B-60. | B120. > B120.001"
        " | P5. > P5.001 | P5. > C5. | P5. > | P5. > P-5. | P5. > P5. C5. | Q5. > D5. | Q5. > Q0 | Q5. > Q#1"
        " | Q5. > Q5. R1. | Q5. > Q5. W-50. | G111 > G112 | G111 > G01 | G00 > G28 | G00 > \nG00"
        " | G00 X40. > G20 G00 X40."
    ),
    PAIR: (
        "R50 > R50.001 | R50 > R0 | R50 > | R50 > I-50.001 | X-50 Y0 > X-50 Y1 | X-50 Y0 > X-49.999 | X-50 Y0 >"
        " | G3 > G2 | G3 > G91 G3 | G17 > G18 | Q-1 > Q1 | Q-1 > Q0 | Q-1 > | 171.87 > -8.13 | 171.87 > 171.871"
        " | Y42.857 > Y42.858 | Y42.857 > Y80"
    ),
    # A half circle would be the same for both signs.
    PAIR.replace("X-50 Y0", "X-30 Y40"): "R50 > R-50",
}
"""Programs, and in which word they are changed once they are solved."""


@pytest.mark.parametrize(
    ("text", "change"), [(text, change) for text, changes in AFTERWARDS.items() for change in changes.split(" | ")]
)
def test_a_program_that_was_changed_afterwards_is_found(desk, text, change):
    old, _, new = change.partition(" > ")
    result = desk.solve(text)
    assert result["contours"][0]["status"] == "solved"
    desk.program.write_bytes(text.replace(old.removesuffix(" >"), new).encode())
    assert desk.verify(result)[0] == 1


def test_checking_nothing_is_not_finding_nothing_wrong(desk):
    loose = desk.solve(MILL + "G3 X50 Y0 R40\n" + LINE)
    assert loose["contours"][0]["status"] == "no-solution"
    receipt = desk.receipt(loose)
    assert receipt["verdict"] == "nothing-checked"
    assert "the status" in [each["what"] for each in receipt["contours"][0]["not_checked"]]
    status, output, _ = desk.verify(loose)
    assert status == 2
    assert "not checked (neither path nor status; " in output
    assert "checked nothing: see above" in output
    assert "right" not in output


def test_ignored_and_unread_words_are_listed(desk):
    receipt = desk.receipt(desk.solve(SAMPLES["A is ignored"]))
    assert "A135." in [each["what"] for each in receipt["contours"][0]["not_checked"]]
    result = desk.solve(PAIR + " ,R2", "--rules", "off")
    receipt = desk.receipt(result)
    assert ",R2" in [each["what"] for each in receipt["contours"][0]["not_checked"]]


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{",
        b"[]",
        b"null",
        b"G111 X100.",
        b'{"schema": "contoursolve/solve/1", "schema": "contoursolve/solve/1"}',
        b'{"schema": "contoursolve/solve/1", "control": NaN, "contours": []}',
        b'{"schema": "contoursolve/solve/1", "control": null, "contours": [-Infinity]}',
        b'{"schema": "contoursolve/solve/1", "control": null, "contours": [1e999]}',
        b'{"schema": "contoursolve/solve/1", "control": null, "contours": [' + b"9" * 5_000 + b"]}",
        b"[" * 100_000,
        b'{"a":' * 100_000,
        b"\xff\xfe\x00",
        b'{"schema": "\\ud800"}',
        b'{"\\ud800": {}}',
        b"\xff" * 9,
    ],
    ids=range(16),
)
def test_bytes_that_are_no_result_are_refused(desk, data):
    desk.program.write_bytes(PROGRAM.encode())
    status, output, errors = desk.verify(data)
    assert (status, output) == (2, "")
    assert str(desk.result) in errors


FUZZ = settings(
    derandomize=True, deadline=None, max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def places(value: Any, place: Place = ()) -> Iterator[Place]:
    if place:
        yield place
    if isinstance(value, (dict, list)):
        for name, each in value.items() if isinstance(value, dict) else enumerate(value):
            yield from places(each, (*place, name))


GARBAGE = ("", "A" + "9" * 31, "\n", "\ud800", "length of line 1 = ?", "X of V2 = 1", "G111 X", "V1", "R5")
DAMAGE = (None, {}, [], True, 0, -1, 1e-9, 5e-324, 1e12, [0.0, 0.0], *GARBAGE)


def damaged(result: dict[str, Any], others: list[dict[str, Any]], rng: Random) -> dict[str, Any]:
    """The result with a node of it gone, of another kind or value, with other digits, or from another contour."""
    copy = deepcopy(result)
    # A place by its depth first: most of a result are numbers far below.
    every = list(places(copy))
    depth = rng.choice([len(place) for place in every[:: max(1, len(every) // 50)]])
    place = rng.choice([place for place in every if len(place) <= depth])
    holder: Any = copy
    for name in place[:-1]:
        holder = holder[name]
    old, kind = holder[place[-1]], rng.randrange(4)
    if kind == 0:
        del holder[place[-1]]
    elif kind == 1 and isinstance(old, str) and re.search(r"\d", old):
        holder[place[-1]] = re.sub(r"[\d.]+", rng.choice(("9" * 31, "0", "?", "#1")), old, count=rng.randrange(3))
    elif kind == 2 and place[0] == "contours" and len(place) > 2:
        holder[place[-1]] = rng.choice(others).get(place[2], old) if len(place) == 3 else [old]
    else:
        holder[place[-1]] = rng.choice(DAMAGE)
    return copy


@pytest.mark.parametrize("seed", range(10))
def test_however_a_result_is_damaged_there_is_an_answer(desk, seed):
    """Right, wrong, or no result: never an exception."""
    rng = Random(seed)
    texts = [path.read_text(encoding="utf-8") for path in sorted(PROGRAMS.glob("*.nc"))]
    texts += [PROGRAM, PAIR, EXTENDED["begin of a corner"], EXTENDED["two contours"]]
    text, other = rng.sample(texts, 2)
    others = desk.solve(other)["contours"]
    result = {**desk.solve(text), "diagnostics": []}
    for _ in range(6):
        assert desk.is_refused(damaged(result, others, rng)) in (True, False)


@FUZZ
@given(program=st.binary(max_size=60), claimed=st.binary(max_size=60), which=st.integers(0, 2))
def test_whatever_the_bytes_there_is_an_answer(desk, program, claimed, which):
    result = desk.solve(PROGRAM)
    if which:
        desk.program.write_bytes(program)
    status = desk.verify(claimed if which != 1 else result)[0]
    assert status == (2 if which != 1 else status)
    assert status in (0, 1, 2)


PLAIN = {
    *(f"contoursolve.numeric.{name}" for name in ("Array", "Functions", "direction", "pinv", "svd")),
    "contoursolve.diagnosis.count",
    "contoursolve.diagnosis.status_text",
}
"""Linear algebra, the direction of an angle, the plural of a word, and the words for a status."""


@pytest.mark.parametrize("module", ["claims", "judge", "measure", "verify"])
def test_the_verifier_uses_nothing_of_the_solver(module):
    """Of `geometry` it knows the kinds of facts and what they are about, of `reading` which words are refused."""
    text = (Path(contoursolve.__file__).parent / "comparison" / f"{module}.py").read_text(encoding="utf-8")
    named = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Import):
            named |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            named |= {f"{node.module}.{alias.name}" for alias in node.names}
    rooms = {name.split(".")[1] for name in named - PLAIN if name.startswith("contoursolve.")}
    assert not rooms & {
        *["solving", "analysis", "numeric", "diagnosis", "program", "output", "api", "try_examples", "families"]
    }
    assert not {name.split(".")[0] for name in named} & {"casadi", "sympy", "flint", "scipy", "importlib"}
