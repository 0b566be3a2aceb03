"""`contoursolve verify`: right results pass, and no wrong number, element, status or fact gets through."""

import json
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from random import Random
from typing import Any

import pytest
from verifying import (
    EXTENDED,
    LATHE,
    LINE,
    MILL,
    PROGRAMS,
    SAMPLES,
    STATUSES,
    Desk,
    alike,
    asked_changed,
    block,
    changed,
    failures,
    lists_changed,
    mutations,
    pair,
    solution,
    tampered,
    with_contour,
)

import contoursolve
from contoursolve.comparison import CannotVerifyError, Document, ReceiptVerdict, verify
from contoursolve.controls import CONTROLS
from contoursolve.output.document import to_json

PAGES = Path(__file__).parents[2] / "docs" / "programs"


@pytest.fixture
def desk(tmp_path):
    return Desk(tmp_path)


CLAIMS = {
    **SAMPLES,
    **EXTENDED,
    **{path.name: path.read_text(encoding="utf-8") for path in sorted(PROGRAMS.glob("*.nc"))},
    "freedoms": LATHE + "G111 A180. B120. X100.",
    "a tie": LATHE + "G111 A180. K-30. B120. X100. U61.",
    "a tie of a circle": MILL + "G3 X-50 Y2 I-50 J0\n" + LINE,
    "ambiguous": MILL + "G3 X-30 Y40 R50\nG1 X-50 Y42.857 ,A171.87",
}


def solved(desk: Desk, name: str) -> dict[str, Any]:
    """The result for one of these programs."""
    is_mill = CLAIMS[name].startswith("G17")
    return desk.solve(CLAIMS[name], *(("--control", "nct-99m") if is_mill else ()))


def document(text: str, control: str | None) -> str:
    """What solve says of a program, without repairs, which nobody verifies."""
    return to_json(contoursolve.solve(text, control=control, depth="verdict"))


# --- What solve says is right, and nothing else ----------------------------------------------------


MOST = 12
"""Changes of a program in one case; each takes as long as a verification."""


def every_change(result: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The result with one claim changed: in the contour alone, and with its like in the list of solutions."""
    for place, wrong in mutations(result):
        one = changed(result, place, wrong)
        yield from (one, alike(one)) if place[2] in ("end", "points", "elements", "asked") else (one,)
    contour = result["contours"][0]
    if contour["end"]:
        yield from (alike(with_contour(result, **each)) for each in tampered(contour))
        yield from (with_contour(result, asked=each) for each in asked_changed(contour["asked"]))
    if contour["solutions"]:
        yield from (with_contour(result, **each) for each in lists_changed(contour))
    for number, _ in enumerate(result["contours"]):
        yield {**result, "contours": [*result["contours"][:number], *result["contours"][number + 1 :]]}


@pytest.mark.parametrize("name", CLAIMS)
def test_nothing_that_a_contour_claims_can_be_changed(desk, name):
    """Not a number by a millionth, no sign, no truth, no element, no solution of a list."""
    result = solved(desk, name)
    wrong = list(every_change(result))
    for each in Random(name).sample(wrong, min(MOST, len(wrong))):
        assert desk.is_refused(each)


@pytest.mark.parametrize("control", CONTROLS)
def test_what_is_tampered_with_is_caught_for_every_control(control):
    """In an example of its rules that has a path with points."""
    rng = Random(control)
    texts = [text for rule in CONTROLS[control].catalogue for text in rule.accepted]
    results = ((text, json.loads(document(text, control))) for text in rng.sample(texts, len(texts)))
    text, result = next(each for each in results if each[1]["contours"] and each[1]["contours"][0]["points"])
    for each in rng.sample(list(every_change(result)), MOST):
        documents = Document("program", text.encode()), Document("result", json.dumps(each).encode())
        # A number of solutions below 0 is none.
        with suppress(CannotVerifyError):
            assert verify(*documents).verdict is ReceiptVerdict.FAILED


@pytest.mark.parametrize("off", [0.0, 0.5])
def test_a_residual_is_what_is_wrong_and_noise_is_none(off):
    text = LATHE + "G111 X100. A180. K-30. B120. P5. Q5."
    result = json.loads(solution(text))
    result["contours"][0]["points"]["V1"][0] += off
    receipt = verify(Document("program", text.encode()), Document("result", json.dumps(result).encode()))
    (checks,) = (contour.checks for contour in receipt.contours)
    assert max(each.residual for each in checks if each.limit) == pytest.approx(off, abs=0)


WORKED = [
    path for folder in (PROGRAMS, PAGES) for path in sorted(folder.iterdir()) if path.suffix not in (".toml", ".dxf")
]
OF_SEVERAL = {PAGES / "plate.nc": "fanuc-mill"}
"""Programs that controls read differently, and the one that they are for."""


def examples() -> Iterator[Any]:
    """Every example of every rule of every control, and every worked example, with its control."""
    for name, control in CONTROLS.items():
        for rule in control.catalogue:
            for number, text in enumerate((*rule.rejected, *rule.accepted)):
                yield pytest.param(name, text, id=f"{name} {rule.code} {number}")
    for path in WORKED:
        yield pytest.param(
            OF_SEVERAL.get(path), path.read_text(encoding="utf-8"), id=f"{path.parent.parent.name} {path.name}"
        )


DECIDED = ("solved", "overdetermined", "ambiguous", "underdetermined")
"""Statuses that a rank can tell."""


@pytest.mark.parametrize(("control", "text"), [*examples()][::18])
def test_what_solve_says_of_every_example_is_right(control, text):
    """Whatever the control, FK included: what can be measured is right, every path is measured, and no status is called
    verified that a rank does not tell."""
    result = document(text, control)
    receipt = verify(Document("program", text.encode()), Document("result", result.encode()))
    claims = json.loads(result)["contours"]
    assert [each.name for one in receipt.contours for each in one.checks if not each.passed] == []
    for claim, one in zip(claims, receipt.contours, strict=True):
        verdict = one.verdict.value
        assert not claim["end"] or verdict in ("verified", "partly-verified")
        assert verdict != "verified" or claim["status"] in DECIDED
        assert (verdict == "verified") != ("the status" in [each.name for each in one.omissions])


# --- Further facts, values that are asked for, several solutions ----------------------------------


@pytest.mark.parametrize("name", EXTENDED)
def test_no_other_status_passes_for_what_lists_solutions_and_answers(desk, name):
    """Whether the others are wrong, or nothing can be said of them: none is verified."""
    result = solved(desk, name)
    status = result["contours"][-1]["status"]
    has_paths = any(each["is_path"] for each in result["contours"][-1]["solutions"])
    for other in (*STATUSES, "undecided"):
        if other != status:
            changed_one = with_contour(result, status=other)
            verdict = desk.receipt(changed_one)["verdict"]
            # A fact that chooses among solutions, and one that repeats others: the rank does not tell them apart.
            is_open = {other, status} == {"solved", "overdetermined"} and verdict == "partly-verified"
            assert verdict == "failed" or is_open or (verdict == "nothing-checked" and not has_paths), (other, verdict)


@pytest.mark.parametrize(
    ("text", "facts", "line"),
    [
        (block("X100. A180. K-30. B120."), ["length of line 1 = 30"], "G111 X100. A180. K-30."),
        (block("X100. A180. K-30. B120."), ["Z of V1 = -30"], "G111 X100. A180. K-30."),
        (pair("G3 I-50 J0", "G1 X-80 Y42.857", "line tangent to arc"), ["radius of arc = 50"], "G1 X-80 Y42.857"),
    ],
)
def test_words_that_leave_the_points_loose_fix_none(desk, text, facts, line):
    """As many words as unknowns, of which some say the same: any path along the way would do."""
    result = desk.solve(text, *(("--control", "nct-99m") if text.startswith("G17") else ()))
    program = "\n".join([*text.split("\n")[:-1], f"{line} (contoursolve: {facts[0]})"])
    desk.program.write_bytes(program.encode())
    found = failures(desk.receipt(with_contour(result, facts=facts)))
    assert "the words fix the points" in found


def test_a_half_circle_and_a_touching_line_are_fixed(desk):
    for text in (
        pair("G3 X-50 Y0 R50", LINE, "length of line = ?"),
        pair("G3 I-50 J0", "G1 X-50 Y50 ,A180", "length of arc = ?"),
    ):
        result = desk.solve(text)
        receipt = desk.receipt(result)
        assert failures(receipt) == []


def test_python_takes_a_result_its_text_or_its_file(tmp_path):
    text, start = "G111 X100. A180. K-30. B120. P5.", "X40. Z0."
    result = contoursolve.solve(text, start=start)
    contoursolve.export(result, tmp_path / "block.json")
    for claimed in (result, (tmp_path / "block.json").read_text(), tmp_path / "block.json"):
        receipt = contoursolve.verify(text, claimed, start=start)
        assert (receipt.verdict, "(1 verified)" in str(receipt)) == (ReceiptVerdict.VERIFIED, True)
        assert contoursolve.verify(text.replace("P5", "P6"), claimed, start=start).verdict is ReceiptVerdict.FAILED
    with pytest.raises(CannotVerifyError, match="rules are those that the result names"):
        contoursolve.verify(text, result, start=start, rules="off")


def test_facts_missing_added_or_unreadable_are_found(desk):
    result = solved(desk, "coordinate of V1")
    facts = result["contours"][0]["facts"]
    for wrong in ([], ["X of V1 = 45"], [*facts, "length of line 1 = 30"], [*facts, "nonsense"], [*facts, *facts]):
        assert desk.is_wrong(with_contour(result, facts=wrong)), wrong
    assert desk.is_wrong(with_contour(result, facts=[*facts, "length of corner 2 = 3"])), "there is no corner 2"
    assert desk.is_wrong(with_contour(result, facts=[*facts, "Z of V1 = 1e999"]))
    assert desk.is_wrong(with_contour(result, asked=[asks("Z of V1 = ?", -1, -30.0)])), "nobody asks"


def asks(word: str, line: int, value: float | None, unit: str = "mm") -> dict[str, Any]:
    return {"word": word, "line": line, "unit": unit, "value": value}
