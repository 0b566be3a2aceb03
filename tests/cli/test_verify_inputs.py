"""`contoursolve verify`: its inputs, its receipt, settings and certificates, and programs that were changed since."""

import ast
import json
import re
from collections.abc import Iterator
from copy import deepcopy
from hashlib import sha256
from pathlib import Path
from random import Random
from typing import Any

import pytest
from calling import run
from hypothesis import HealthCheck, given, settings, strategies as st
from verifying import (
    EXTENDED,
    LATHE,
    LINE,
    MILL,
    NUDGE,
    PAIR,
    PROGRAM,
    PROGRAMS,
    SAMPLES,
    Desk,
    Place,
    alike,
    changed,
    failures,
    with_contour,
)

import contoursolve
from contoursolve.comparison import CannotVerifyError
from contoursolve.gcode import parse


@pytest.fixture
def desk(tmp_path):
    return Desk(tmp_path)


def test_units_and_control_are_those_of_solve(desk):
    text = "G00 X1.5 Z0.\nG111 X4. A180. K-1.2 B120. P.2 Q.2"
    result = desk.solve(text, "--units", "inch")
    assert desk.receipt(result, "--units", "inch")["verdict"] == "verified"
    assert desk.receipt(result)["verdict"] == "failed"
    assert desk.receipt(result, "--units", "inch", "--control", "yasnac-lx3")["control"] == "yasnac-lx3"
    assert desk.receipt(result, "--units", "inch", "--control", "nct-99m")["verdict"] == "failed"


def test_either_input_may_be_standard_input(desk):
    result = desk.solve(PROGRAM)
    desk.verify(result)
    assert run("verify", "-", desk.result, stdin=PROGRAM)[0] == 0
    assert run("verify", desk.program, "-", stdin=json.dumps(result))[0] == 0
    assert run("verify", "-", "-", stdin=PROGRAM)[0] == 2


def test_fields_that_are_not_known_are_left_alone(desk):
    result = desk.solve(PROGRAM)
    (contour,) = result["contours"]
    contour |= {"families": [{"end": None}], "mood": "any"}
    contour["certificate"]["by"] = "anyone"
    assert desk.receipt({**result, "later": 1})["verdict"] == "verified"


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_result_that_windows_redirected_is_read(desk, encoding):
    data = json.dumps(desk.solve(PROGRAM)).encode(encoding)
    assert desk.receipt(data)["verdict"] == "verified"


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


BESIDE = "1 L X+0 Y+0 R0 FMAX\n{}\n{}"


@pytest.mark.parametrize(
    "lines",
    [
        ("FL X+21 Y+36", "FL X+26 PDX+10 PDY+10 D3"),
        ("FL LEN10 P1X+5 P1Y+12", "FL LEN20 PDX+10 PDY+10 D3"),
    ],
)
def test_lines_beside_a_place_are_measured_on_the_side_where_they_lie(desk, lines):
    result = desk.solve(BESIDE.format(*lines), "--control", "heidenhain")
    assert result["contours"][0]["status"] == "ambiguous"
    assert desk.receipt(result)["verdict"] == "verified"


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
    result = desk.solve(SAMPLES[name], "--set", f"{setting}={value}")
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


def test_the_branch_of_a_line_that_touches_is_none(desk):
    result = desk.solve(SAMPLES["a line that touches"])
    assert result["contours"][0]["branch"] is None
    assert desk.receipt(changed(result, ("contours", 0, "branch"), "nearer"))["verdict"] == "failed"


def test_the_other_intersection_is_no_answer(desk):
    other = desk.solve(SAMPLES["the farther point"])
    result = desk.solve(PAIR)
    assert desk.receipt(result)["verdict"] == "verified"
    assert desk.receipt(other)["verdict"] == "failed"
    assert "P1 is the nearer place" in failures(desk.receipt(other))


def test_contours_missing_added_or_twice_are_found(desk):
    result = desk.solve(SAMPLES["one after the other"])
    contours = result["contours"]
    for wrong in (contours[:1], contours[1:], [], [*contours, contours[0]], [*contours, {**contours[0], "line": 1}]):
        assert desk.receipt({**result, "contours": wrong})["verdict"] == "failed"
    receipt = desk.receipt({**result, "contours": contours[:2]})
    assert [contour["status"] for contour in receipt["contours"]] == ["solved", "solved", None]


def test_a_certificate_covers_what_the_points_show(desk):
    result = desk.solve(PROGRAM)
    place = ("contours", 0, "certificate", "radius")
    at = ("contours", 0, "points", "V2", 0)
    value = result["contours"][0]["points"]["V2"][0]
    assert result["contours"][0]["certificate"]["radius"] > 0
    assert desk.receipt(result)["verdict"] == "verified"
    # Within what a residual may be, and still more than the certificate promises.
    slightly_off = changed(result, at, value + 2e-10)
    assert all("certificate" in name for name in failures(desk.receipt(alike(changed(slightly_off, place, 0.0)))))
    assert desk.receipt(alike(changed(slightly_off, place, 0.0)))["verdict"] == "failed"
    assert desk.receipt(alike(changed(slightly_off, place, 1e-9)))["verdict"] == "verified"
    # No certificate makes a wrong number right.
    assert desk.receipt(alike(changed(changed(result, at, value + NUDGE), place, 1.0)))["verdict"] == "failed"
    nothing = {"kind": "unknown", "radius": None, "reason": "none", "double": None}
    receipt = desk.receipt(changed(result, ("contours", 0, "certificate"), nothing))
    assert "what certificates prove" in [each["what"] for each in receipt["contours"][0]["not_checked"]]


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


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("length of line 1", "= 30", "= 30.0001"),
        ("length of line 1", "A180.", "A180. K-30."),
        ("tangent", "tangent to", "passes through"),
        ("tangent", "line tangent to arc", "angle from arc to line = 180"),
        ("tangent", "G3", "G2"),
        ("tangent, one coordinate", ",A171.87", ",A171.88"),
        ("length of the arc", "length of arc = 60", "length of arc = 374.159265358979"),
        ("meets a line at an angle", "170", "-10"),
        ("meets the next line", "X110.", "X110.001"),
        ("meets the next line", "G01", "G02"),
        ("meets a line to a place", "Z-60. X130.", "Z-47.4 X100.274"),
        ("direction", "= 120", "= -60"),
        ("turn of lines", "-60", "60"),
        ("radius that is asked for", "R?", "R50"),
        ("begin of a corner", "P?", "C?"),
        ("begin of a corner", "P?", "P8.66"),
        ("R and Q choose", "R50", "R-50"),
    ],
)
def test_a_program_with_facts_that_was_changed_afterwards_is_found(desk, name, old, new):
    text = EXTENDED[name]
    result = desk.solve(text, *(("--control", "nct-99m") if text.startswith("G17") else ()))
    assert old in text
    desk.program.write_bytes(text.replace(old, new).encode())
    own = [each.text for block in parse(text.replace(old, new)).blocks for each in block.directives]
    assert desk.verify(result)[0] == 1
    assert desk.verify(with_contour(result, facts=own))[0] == 1


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


@pytest.mark.parametrize(("text", "control"), [("G00 X40. Z0.", None), ("", None), (LATHE + "G01 X50.", "yasnac-lx3")])
def test_a_program_without_a_contour_has_nothing_to_check(desk, text, control):
    result = desk.solve(text, *(["--control", control] if control else []))
    receipt = desk.receipt(result)
    assert (receipt["control"], receipt["contours"], receipt["verdict"]) == (control, [], "nothing-checked")
    assert "checked nothing: there is no contour to check" in desk.verify(result)[1]


def test_facts_and_questions_are_checked_with_every_form(desk):
    text = "G00 X100. Z-50.\nG112 U0 I10. K-50. Q5. R30. (contoursolve: length of arc = ?)"
    result = desk.solve(text)
    assert (failures(desk.receipt(result)), desk.receipt(result)["verdict"]) == ([], "verified")
    place = ("contours", 0, "asked", 0, "value")
    value = result["contours"][0]["asked"][0]["value"]
    assert desk.is_wrong(alike(changed(result, place, value + NUDGE)))


def test_ignored_and_unread_words_are_listed(desk):
    receipt = desk.receipt(desk.solve(SAMPLES["A is ignored"]))
    assert "A135." in [each["what"] for each in receipt["contours"][0]["not_checked"]]
    result = desk.solve(PAIR + " ,R2", "--rules", "off")
    receipt = desk.receipt(result)
    assert ",R2" in [each["what"] for each in receipt["contours"][0]["not_checked"]]


def test_a_contour_after_one_without_a_path_is_checked_where_its_start_is_known(desk):
    text = LATHE + "G111 A180. B120. X100. Z-50. P90.\nG111 A180. K-30. B120. X160.\nG111 A180. K-3. B120. X190."
    result = desk.solve(text)
    assert [contour["status"] for contour in result["contours"]] == ["no-solution", "solved", "solved"]
    assert failures(desk.receipt(result)) == []
    unknown = desk.solve(LATHE + "G111 A180. B120. X100.\nG111 A180. K-30. B120. X160.")
    assert unknown["contours"][1]["start"] == [None, 50.0]
    assert failures(desk.receipt(unknown)) == []
    assert desk.receipt(changed(unknown, ("contours", 1, "start", 0), 1.0))["verdict"] == "failed"


def test_the_receipt_names_the_bytes_it_is_about(desk):
    result = desk.solve(PROGRAM)
    receipt = desk.receipt(result)
    for name, path in (("program", desk.program), ("result", desk.result)):
        assert receipt[name] == {"name": str(path), "sha256": sha256(path.read_bytes()).hexdigest()}
    assert receipt["schema"] == "contoursolve/verify/1"
    assert receipt["units"] == "mm"
    (contour,) = receipt["contours"]
    assert (contour["line"], contour["lines"], contour["form"], contour["status"]) == (2, [2], "G111", "solved")
    checks = {check["name"]: check for check in contour["checks"]}
    assert checks["X of V2"] == checks["X of V2"] | {"words": ["X100."], "unit": "mm", "passed": True, "remark": ""}
    assert checks["X of V2"]["residual"] <= checks["X of V2"]["limit"] < 1.1e-9
    assert checks["corner 1 turns as the path does"]["limit"] is None


def test_the_text_says_what_is_wrong_and_by_how_much(desk):
    result = desk.solve(PROGRAM)
    status, output, _ = desk.verify(changed(result, ("contours", 0, "points", "V2", 1), 50.001))
    assert status == 1
    assert "said to be solved: WRONG" in output
    assert "wrong: X of V2 (X100.): off by 0.001 mm, allowed 1.0e-09 mm" in output
    assert output.endswith("1 contour (1 WRONG); the result is not right\n")
    status, output, _ = desk.verify(result)
    assert status == 0
    assert output.endswith("1 contour (1 verified); every claim that was checked is right\n")
    assert f"program {desk.program}: SHA-256 {sha256(desk.program.read_bytes()).hexdigest()}\n" in output


def test_what_is_wrong_is_said_as_what_was_expected_and_found(desk):
    def wrong(result: object, *options: str) -> list[str]:
        lines = desk.verify(result, *options)[1].split("\n")
        return [line.partition("wrong: ")[2] for line in lines if "wrong: " in line]

    result = desk.solve(PROGRAM)
    assert wrong(changed(result, ("contours", 0, "line"), 3)) == [
        "expected: the result mentions this contour; but it has none on this line",
        "expected: the program has a contour block here; but line 3 begins none",
    ]
    assert wrong(changed(result, ("contours", 0, "form"), "G112")) == [
        "expected: the form is that of its blocks; but the program has G111, and the result has G112"
    ]
    fewer = changed(result, ("contours", 0, "count", "solutions"), 2)
    assert wrong(fewer) == ["expected: all solutions are listed; but there are said to be 2, and 1 are listed"]
    desk.program.write_text(PROGRAM.split("\n")[1], encoding="utf-8")
    assert (
        "expected: Z of the start is the program's position; but the program has none, and the result has 0 mm; if it "
        "was solved with --start, verify with it"
    ) in wrong(changed(result, ("contours", 0, "line"), 1))


ELEMENT, OF_ALL = ("contours", 0, "elements", 1), ("contours", 0)
TROUBLE: dict[str, tuple[Place, Any, str]] = {
    "schema": (("schema",), "contoursolve/check/1", "schema: invalid enum value 'contoursolve/check/1'"),
    "control": (("control",), "fanuc", "unknown control 'fanuc'; choose from yasnac-lx3, nct-99m"),
    "boolean line": ((*OF_ALL, "line"), True, "contours[0].line: expected `int`, got `bool`"),
    "negative line": ((*OF_ALL, "lines"), [-1], "contours[0].lines[0]: expected `int` >= 0"),
    "status": ((*OF_ALL, "status"), "fine", "contours[0].status: invalid enum value 'fine'"),
    "plane": ((*OF_ALL, "plane"), ["Z"], "contours[0].plane: expected `array` of length 2, got 1"),
    "huge": ((*OF_ALL, "end"), [10**400, 2], "contours[0].end[0]: number out of range"),
    "large": ((*OF_ALL, "end"), [1e13, 2], "contours[0].end[0]: expected `float` <= 1000000000000.0"),
    "point": ((*OF_ALL, "points"), {"V1": None}, "contours[0].points[...]: expected `array`, got `null`"),
    "kind": ((*ELEMENT, "kind"), "spline", "contours[0].elements[1].kind: invalid value 'spline'"),
    "radius": ((*ELEMENT, "radius"), None, "elements[1].radius: expected `float`, got `null`"),
    "complete": ((*OF_ALL, "count", "is_complete"), None, "is_complete: expected `bool`, got `null`"),
}


@pytest.mark.parametrize("name", TROUBLE)
def test_a_result_that_is_none_is_named_by_its_field(desk, name):
    place, value, message = TROUBLE[name]
    status, output, errors = desk.verify(changed(desk.solve(PROGRAM), place, value))
    assert (status, output) == (2, "")
    assert message in errors
    assert errors.count("\n") == 1


FIELDS = (
    ((), "schema control rules settings contours diagnostics"),
    (("contours", 0), "line lines form status plane start end points elements branch branches certificate conventions"),
    (("contours", 0), "facts asked filled solutions count diagnosis"),
    (("contours", 0, "elements", 1), "kind start end center radius turn"),
    (("contours", 0, "certificate"), "kind radius reason double"),
    (("contours", 0, "solutions", 0), "name is_chosen selects is_path reasons asked end points elements certificate"),
    (("contours", 0, "count"), "solutions contours is_complete doubts chosen_by"),
)


@pytest.mark.parametrize(("place", "names"), FIELDS)
def test_every_field_must_be_there(desk, place, names):
    result = desk.solve(PROGRAM)
    for name in names.split():
        wrong = deepcopy(result)
        holder: Any = wrong
        for step in place:
            holder = holder[step]
        del holder[name]
        with pytest.raises(CannotVerifyError, match=f"missing required field `{name}`"):
            desk.is_wrong(wrong)


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


def test_inputs_that_cannot_be_read_are_named(desk, tmp_path):
    result = desk.solve(PROGRAM)
    desk.verify(result)
    for program, claimed, message in (
        (tmp_path / "none.nc", desk.result, "none.nc: no such file"),
        (desk.program, tmp_path / "none.json", "none.json: no such file"),
        (tmp_path, desk.result, "is a directory, not a file"),
        (desk.program, tmp_path, "is a directory, not a file"),
        ("\0", desk.result, "cannot be read"),
    ):
        status, output, errors = run("verify", program, claimed)
        assert (status, output) == (2, "")
        assert message in errors
    _, _, errors = run("verify", desk.program, desk.program)
    assert f"{desk.program} is not a result of 'solve --format json': it is no JSON document" in errors
    desk.program.write_bytes(PROGRAM.encode("utf-16"))
    status, _, errors = run("verify", desk.program, desk.result)
    assert status == 2
    assert "is UTF-16 text" in errors
    for arguments in ((), (desk.program,), (desk.program, desk.result, "--control", "fanuc")):
        assert run("verify", *arguments)[0] == 2


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


@pytest.mark.parametrize("word", ["A", "B", "P", "X", "K"])
def test_a_value_beyond_all_travel_is_no_value(desk, word):
    claimed = desk.solve(PROGRAM)
    parts = [word + "9" * 31 + "." if part[0] == word else part for part in PROGRAM.split("\n")[1].split(" ")]
    desk.program.write_bytes((LATHE + " ".join(parts)).encode())
    assert failures(desk.receipt(claimed))[0] == "every word and fact can be read"


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
        *["solving", "analysis", "numeric", "diagnosis", "program", "output", "api", "try_edits", "families"]
    }
    assert not {name.split(".")[0] for name in named} & {"casadi", "sympy", "flint", "scipy", "importlib"}
