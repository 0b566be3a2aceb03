"""`contoursolve verify`: right results pass, and no wrong number, element, status or fact gets through."""

import json
import re
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import pytest
from verifying import (
    CIRCLE,
    EXTENDED,
    LATHE,
    LINE,
    MILL,
    PAIR,
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

from contoursolve.comparison import CannotVerifyError, Document, ReceiptVerdict, verify
from contoursolve.controls import DIALECTS
from contoursolve.gcode import parse

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
PATHS = {"shaft.nc": 7, "plate.nc": 6, "shaft_broken.nc": 1, "roller.nc": 9}
"""Contours of programs that are verified."""


def solved(desk: Desk, name: str) -> dict[str, Any]:
    """The result for one of these programs."""
    is_mill = CLAIMS[name].startswith("G17")
    return desk.solve(CLAIMS[name], *(("--control", "nct-99m") if is_mill else ()))


# --- What solve says is right, and nothing else ----------------------------------------------------


@pytest.mark.parametrize("name", CLAIMS)
def test_what_solve_says_is_right(desk, name):
    result = solved(desk, name)
    receipt = desk.receipt(result)
    assert failures(receipt) == []
    verdicts = [contour["verdict"] for contour in receipt["contours"]]
    assert all(
        each in ("verified", "partly-verified") or not contour["end"]
        for each, contour in zip(verdicts, result["contours"], strict=True)
    )
    assert name not in PATHS or sum(each == "verified" for each in verdicts) == PATHS[name]
    assert name not in SAMPLES or {contour["status"] for contour in result["contours"]} == {"solved"}
    assert name not in EXTENDED or any(each["is_path"] for each in result["contours"][0]["solutions"])


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


@pytest.mark.parametrize("control", DIALECTS)
def test_what_is_tampered_with_is_caught_for_every_control(control):
    """In an example of its rules that has a path with points."""
    rng = Random(control)
    texts = [text for rule in DIALECTS[control].catalogue for text in rule.accepted]
    results = ((text, json.loads(solution(text, "--control", control))) for text in rng.sample(texts, len(texts)))
    text, result = next(each for each in results if each[1]["contours"] and each[1]["contours"][0]["points"])
    for each in rng.sample(list(every_change(result)), MOST):
        documents = Document("program", text.encode()), Document("result", json.dumps(each).encode())
        try:
            verdict = verify(*documents).verdict
        except CannotVerifyError:
            continue  # a count below 0 is no result at all
        assert verdict is ReceiptVerdict.FAILED


WORKED = [
    path for folder in (PROGRAMS, PAGES) for path in sorted(folder.iterdir()) if path.suffix not in (".toml", ".dxf")
]
OF_SEVERAL = {PAGES / "plate.nc": "fanuc-mill"}
"""Programs that controls read differently, and the one that they are for."""


def examples() -> Iterator[Any]:
    """Every example of every rule of every control, and every worked example, with its control."""
    for name, control in DIALECTS.items():
        for rule in control.catalogue:
            for number, text in enumerate((*rule.rejected, *rule.accepted)):
                yield pytest.param(name, text, id=f"{name} {rule.code} {number}")
    for path in WORKED:
        yield pytest.param(
            OF_SEVERAL.get(path), path.read_text(encoding="utf-8"), id=f"{path.parent.parent.name} {path.name}"
        )


DECIDED = ("solved", "overdetermined", "ambiguous", "underdetermined")
"""Statuses that a rank can tell."""


@pytest.mark.parametrize(("control", "text"), [*examples()][::6])
def test_what_solve_says_of_every_example_is_right(control, text):
    """Whatever the control, FK included: what can be measured is right, every path is measured, and no status is called
    verified that a rank does not tell."""
    result = solution(text, *(("--control", control) if control else ()))
    receipt = verify(Document("program", text.encode()), Document("result", result.encode()))
    claims = json.loads(result)["contours"]
    assert [each.name for one in receipt.contours for each in one.checks if not each.passed] == []
    for claim, one in zip(claims, receipt.contours, strict=True):
        verdict = one.verdict.value
        assert not claim["end"] or verdict in ("verified", "partly-verified")
        assert verdict != "verified" or claim["status"] in DECIDED
        assert (verdict == "verified") != ("the status" in [each.name for each in one.omissions])


@pytest.mark.parametrize(
    ("words", "status"),
    [
        ("G111 A180. K-30. B120. X100. U60.", "overdetermined"),
        ("G111 A180. K-30. B120. X100. U60.0009", "overdetermined"),
        ("G111 A180.0005 I0 K-30. B120. X100.", "overdetermined"),
        ("G111 A180.0005 I0 K-30. B120. X100. P5.", "overdetermined"),
        ("G111 A180.0005 I0 K-30. B120. X100. C5. Q5.", "overdetermined"),
        ("G111 A180. K-30. B120. X100. Z-47.3205", "overdetermined"),
        # Says too much, and cannot be made either: without a path.
        ("G111 A180. I0 K-30. B120. X100. U60. P500.", "overdetermined"),
        # Line 1 runs at 180 degrees: an angle that is half a turn off conflicts.
        ("G111 A0 I0 K-30. B120. X100. U60.", "conflicting"),
    ],
)
def test_overdetermined_contours_are_held_against_all_their_words(desk, words, status):
    result = desk.solve(LATHE + words, "--rules", "off")
    (contour,) = result["contours"]
    assert contour["status"] == status
    receipt = desk.receipt(result)
    assert failures(receipt) == []
    assert receipt["verdict"] == ("verified" if contour["end"] else "nothing-checked")
    if contour["end"]:
        # With notes v and vi of the manual, A or B is ignored, and the block is solved.
        by_the_notes = desk.solve(LATHE + words)["contours"][0]
        claim = {**result["contours"][0], "status": "solved"}
        is_right = all(by_the_notes[name] == claim[name] for name in ("status", "elements"))
        assert desk.verify({**result, "contours": [claim], "rules": "enforce"})[0] == (0 if is_right else 1)
        assert desk.verify({**result, "contours": [claim]})[0] == 1, "the result says that the rules were off"


# --- Contours without a path -------------------------------------------------------------------------

NO_CIRCLE = MILL + "G3 X50 Y0 R40\n" + LINE
"""Of all the circles through its one point, none is stated."""

ONE_LINE = "G17 G90 G42 D1 G0 X0 Y0\n"
STANDINGS = {
    "line 1 lacks a word": ("G111 A180. B120. X100.", "rejected", "underdetermined"),
    "X and U agree": ("G111 A180. K-30. B120. X100. U60.", "rejected", "overdetermined"),
    "X and U disagree": ("G111 A180. K-30. B120. X100. U61.", "rejected", "conflicting"),
    "two corners": ("G111 A180. K-30. B120. X100. C5. P5.", "rejected", "conflicting"),
    "a corner lands nowhere": ("G111 A180. K-30. X100. Z-47. Q5.", "rejected", "underdetermined"),
    "an angle of more than a turn": ("G111 A540. K-30. B120. X100.", "rejected", "solved"),
    "an M word": ("G111 A180. K-30. B120. X100. M08", "rejected", "solved"),
    "a variable": ("G111 A180. K-30. B120. X#1", "underdetermined", "underdetermined"),
    "a variable that is ignored": ("G111 A#1 I5. K-30. B120. X100.", "underdetermined", "underdetermined"),
    "the same line twice": ("G111 A180. I0 B120. X100.", "underdetermined", "underdetermined"),
    "parallel lines": ("G111 A180. B180. X100. Z-50.", "no-solution", "no-solution"),
    "reversed": ("G111 X100. A0 K-30. B120.", "no-solution", "no-solution"),
    "A ignored": ("G111 A135. I10. K-12. B180. Z-40. P60.", "no-solution", "conflicting"),
    "an angle alone": (MILL + "G1 ,A150\nX10 Y20", "rejected", "underdetermined"),
    "no circle": (MILL + "G3 X-50 Y0\n" + LINE, "rejected", "underdetermined"),
    "no Q": (MILL + "G3 I-50 J0\nG1 X-50 Y42.857 ,A171.87", "rejected", "ambiguous"),
    "no Q, one path": (MILL + "G3 I-50 J0\nG1 X0 Y42.857 ,A171.87", "rejected", "solved"),
    "no compensation": ("G17 G90 G0 X50 Y0\nG3 I-50 J0\n" + LINE, "rejected", "solved"),
    "a centre on the line": (PAIR + " R5", "rejected", "solved"),
    "lines that part": (MILL + "G1 X0 Y0\n" + LINE, "no-solution", "no-solution"),
    "a line before a circle that it misses": (MILL + "G1 ,A90\n" + CIRCLE, "no-solution", "no-solution"),
    "circles apart": (MILL + "G3 I-5 J0\n" + CIRCLE, "no-solution", "no-solution"),
    "a circle without Q": (MILL + "G1 ,A150\n" + CIRCLE.replace("Q-1", "Q0"), "rejected", "ambiguous"),
    "lines that are parallel": (MILL + "G1 ,A90\nG1 X0 Y30 ,A-90", "no-solution", "no-solution"),
    "a point beside its circle": (MILL + "G1 ,A150\n" + CIRCLE.replace("Y60", "Y61"), "conflicting", "conflicting"),
    "a chamfer and a rounding": (MILL + "G1 X80 ,C3 ,R3\nX90 Y40", "rejected", "conflicting"),
    "a corner and nothing after it": (MILL + "G1 X80 ,C3\nM8", "rejected", "solved"),
    "a corner straight on": (MILL + "G1 X80 ,C3\nX90", "no-solution", "no-solution"),
    "an angle along the only coordinate": (MILL + "G1 X70 ,A90", "no-solution", "no-solution"),
    "an angle along the coordinate it is at": (MILL + "G1 X50 ,A90", "underdetermined", "underdetermined"),
    "G112 lacks a word": ("G112 U0 I10. K-50.", "rejected", "underdetermined"),
    "G112 backs up": ("G112 U30. I10. K-50. R30.", "no-solution", "solved"),
    "G112 misses": ("G112 U0 I10. K-50. R5.", "no-solution", "no-solution"),
    "G112 has no way": ("G112 U0 I10. K0 R30.", "no-solution", "underdetermined"),
    "G11 without a corner": ("G11 Z-20.", "rejected", "underdetermined"),
    "G12 too large": ("G12 U10. K-7.", "no-solution", "no-solution"),
    "a point that is far off": (MILL + "G3 X-50 Y2 I-50 J0\n" + LINE, "conflicting", "conflicting"),
    "against ,A": (MILL + "G3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A-8.13 Q-1", "no-solution", "no-solution"),
    "what cannot be asked for": ("N4 W0 G111 X100. A180. K-30. B120. P? Q?", "rejected", "rejected"),
    "a question of F": ("G111 A180. K-30. B120. X100. F?", "rejected", "rejected"),
    "a question of a bevel of G112": ("G112 U0 I10. K-50. C? D5. R30.", "rejected", "rejected"),
    "a question of a bevel's K": ("G01 Z-20. K?", "rejected", "rejected"),
    "a question that can be asked": ("G111 A180. K-30. B120. X100. Q?", "underdetermined", "underdetermined"),
    "there and back": (ONE_LINE + "G1 ,A0.\nG1 X50. Y0. ,A180.", "underdetermined", "underdetermined"),
    "the same way": (ONE_LINE + "G1 ,A0.\nG1 X50. Y0. ,A0.", "underdetermined", "underdetermined"),
    "by its point": (ONE_LINE + "G1 X20 Y0\nG1 X50. Y0. ,A180.", "underdetermined", "underdetermined"),
    "a third line": (
        ONE_LINE + "G1 ,A0. ,R2\nG1 X50. Y0. ,A180.\nG1 X80 Y50 ,A90",
        "underdetermined",
        "underdetermined",
    ),
    "beside each other": (ONE_LINE + "G1 ,A0.\nG1 X50. Y1. ,A180.", "no-solution", "no-solution"),
    "lacks and contradicts": ("G111 Z-27.727 W-4.211 A180. B-152.", "rejected", "conflicting"),
    "no line 2, and too much": ("G111 A137. I10. K-10.", "rejected", "conflicting"),
    "no line 2, and X and U": ("G111 U60. X100. A180. K-30.", "rejected", "underdetermined"),
    "no line 2, and X against U": ("G111 U61. X100. A180. K-30.", "rejected", "conflicting"),
    "without a start": ("\nG111 A180. K-30. B120. X100.", "underdetermined", "underdetermined"),
}


@pytest.mark.parametrize("name", STANDINGS)
def test_no_status_is_believed_that_the_words_do_not_give(desk, name):
    """The statuses are those that the manuals' rules and the geometry give. One that a rank decides is believed, of the
    others the receipt says that they were not checked, and another one is never believed."""
    words, *wanted = STANDINGS[name]
    text = words if "\n" in words else LATHE + words
    for rules, status in zip(("enforce", "off"), wanted, strict=True):
        control = "nct-99m" if text.startswith("G17") else "yasnac-lx3"
        result = desk.solve(text, "--rules", rules, "--control", control)
        assert result["contours"][-1]["status"] == status
        receipt = desk.receipt(result)
        assert failures(receipt) == []
        assert receipt["rules"] == rules
        (contour,) = receipt["contours"]
        is_told = "the status" not in [each["what"] for each in contour["not_checked"]]
        assert (contour["verdict"] == "verified") == is_told
        assert is_told or status not in ("solved", "overdetermined", "ambiguous")
        assert not is_told or status in ("solved", "overdetermined", "ambiguous", "underdetermined")
        for other in STATUSES:
            assert other == status or not desk.is_believed(with_contour(result, status=other)), other


def test_that_a_list_is_whole_is_not_checked_and_said_so(desk):
    result = desk.solve(SAMPLES["a radius"])
    (contour,) = result["contours"]
    assert len(contour["solutions"]) > 1
    chosen = [each for each in contour["solutions"] if each["is_chosen"]]
    fewer = {**contour["count"], "solutions": 1, "contours": 1}
    receipt = desk.receipt(with_contour(result, solutions=chosen, count=fewer))
    assert failures(receipt) == []
    assert "whether these are all solutions" in [each["what"] for each in receipt["contours"][0]["not_checked"]]


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


STATED = re.compile(r"(?<== )[-+]?[\d.]+|(?<=[ZXYR])-?[\d.]+(?=[ \]])(?=[^\[]*\])|(?<=at )\d+")
"""The numbers in facts."""


@pytest.mark.parametrize("name", [name for name in EXTENDED if STATED.search(EXTENDED[name].partition("solve:")[2])])
def test_the_answer_to_a_slightly_different_fact_is_wrong(desk, name):
    text = EXTENDED[name]
    begin = text.index("contoursolve:")
    for match in STATED.finditer(text, begin):
        # Some only agree within the least increment, and a place may be moved along a level line.
        if name.startswith("a fact") or match[0] == "0":
            continue
        number = match[0] if "." in match[0] else match[0] + "."
        other = text[: match.start()] + number + "00002" + text[match.end() :]
        if "." in match[0]:
            other = text[: match.start()] + f"{float(match[0]) + 2e-5:.6f}" + text[match.end() :]
        result = desk.solve(other, *(("--control", "nct-99m") if text.startswith("G17") else ()))
        assert not desk.is_wrong(result), other
        (contour,) = result["contours"]
        program = parse(text).blocks
        contour |= {"facts": [each.text for block in program for each in block.directives], "filled": None}
        desk.program.write_bytes(text.encode())
        assert desk.is_wrong(result), other


@pytest.mark.parametrize(
    ("text", "facts", "line"),
    [
        (block("X100. A180. K-30. B120."), ["length of line 1 = 30"], "G111 X100. A180. K-30."),
        (block("X100. A180. K-30. B120."), ["Z of V1 = -30"], "G111 X100. A180. K-30."),
        (
            pair("G3 I-50 J0", "G1 X-80 Y42.857", "line tangent to arc"),
            ["radius of arc = 50"],
            "G1 X-80 Y42.857",
        ),
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


def test_filled_blocks_are_not_checked_and_said_so(desk):
    result = solved(desk, "begin of a corner")
    filled = {**result["contours"][0]["filled"], "deviation_mm": 7.0}
    receipt = desk.receipt(with_contour(result, filled=filled))
    assert "the filled blocks" in [each["what"] for each in receipt["contours"][0]["not_checked"]]
