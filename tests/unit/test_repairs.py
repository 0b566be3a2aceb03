"""Repairs: those that drop words against a search through all sets of words, and how far the numbers reach."""

import random
import re
from decimal import Decimal
from itertools import combinations

import pytest
from generate_slips import FORMS, Spoilt

from contoursolve import Status, solve
from contoursolve.diagnostics import Applicability


def places(lines: tuple[str, ...]) -> list[tuple[int, int]]:
    """Line and place of each word of a contour but its G codes."""
    words = [(line, place, text) for line, row in enumerate(lines) for place, text in enumerate(row.split())]
    return [(line, place) for line, place, text in words if line and text[0] != "G"]


def without(lines: tuple[str, ...], dropped: frozenset[tuple[int, int]]) -> list[str]:
    return [
        " ".join(text for place, text in enumerate(row.split()) if (line, place) not in dropped)
        for line, row in enumerate(lines)
    ]


BESIDE = re.compile(r"[MST]\d+(?: [MST]\d+)*")
"""A block of words that have nothing to do with the contour, as they may be moved into one of their own."""


def is_clean(lines: list[str], control: str, contours: int = 1, plain: int = 0) -> bool:
    """Whether all blocks but those of other words, and so many that are plain, make one contour, or so many, solved
    without an error or a warning, but for a path that crosses the spindle axis, which may be meant."""
    result = solve("\n".join(lines), control=control, depth="verdict")
    blocks = [line for line in lines[1:] if not BESIDE.fullmatch(line)]
    covered = sum(len(each.lines) for each in result.answers)
    is_whole = len(result.answers) == contours and covered == len(blocks) - plain
    # No control reads a block with facts: rules only warn there.
    severities = {"error"} if any("(contoursolve:" in line for line in lines) else {"error", "warning"}
    findings = [
        each for each in result.diagnostics if each.severity.value in severities and each.code != "axis-crossed"
    ]
    return is_whole and all(each.status is Status.SOLVED for each in result.answers) and not findings


def drops_by_search(spoilt: Spoilt, largest: int = 5) -> list[frozenset[tuple[int, int]]]:
    """All smallest sets of words whose dropping leaves a clean contour."""
    found: list[frozenset[tuple[int, int]]] = []
    words = places(spoilt.lines)
    for size in range(1, min(largest, len(words)) + 1):
        for dropped in map(frozenset, combinations(words, size)):
            if not any(other < dropped for other in found) and is_clean(without(spoilt.lines, dropped), spoilt.control):
                found.append(dropped)
    return found


def check_drops(spoilt: Spoilt) -> None:
    """That each smallest set of words to drop is offered where all repairs are said to be."""
    result = solve(spoilt.text, control=spoilt.control)
    findings = [each for each in result.diagnostics if each.severity.value != "info"]
    if not findings or len(result.answers) != 1 or len(result.answers[0].lines) != len(spoilt.lines) - 1:
        return
    diagnosis = result.answers[0].diagnosis
    if diagnosis is not None and diagnosis.repairs_complete:
        offered = {tuple(fix.replacement.split()) for finding in findings for fix in finding.fixes}
        for dropped in drops_by_search(spoilt):
            assert tuple(" ".join(without(spoilt.lines, dropped)[1:]).split()) in offered, (spoilt, dropped)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("seed", range(10))
def test_every_smallest_set_of_words_to_drop_is_offered(seed, form):
    check_drops(FORMS[form](random.Random(f"drops {seed}")))


@pytest.mark.parametrize(
    ("block", "start", "left"),
    [
        (
            "G111 A265.141 K-3.645 U-85.747 I-42.864 W-49.354 C-1.881",
            "X119.046 Z53.326",
            "G111 A265.141 K-3.645 U-85.747 W-49.354",
        ),
        ("G111 X100. A180. K-30. B120. C-5.", "X40. Z0.", "G111 X100. A180. K-30. B120."),
        ("G111 X100. A180. K-30. I0. B120. Q-5. M08", "X40. Z0.", "G111 X100. A180. K-30. B120."),
        ("G112 X233.08 P6.541 R51.128 K-88.154 I17.263 Q-28.507 Z-5.276", "X150. Z60.", None),
    ],
)
def test_negative_corner_words_are_dropped_like_others(block, start, left):
    spoilt = Spoilt((f"G00 {start}", block), "yasnac-lx3")
    assert solve(spoilt.text).answers[0].diagnosis.repairs_complete
    check_drops(spoilt)
    if left:
        fixes = [fix.replacement for finding in solve(block, start=start).diagnostics for fix in finding.fixes]
        assert left in fixes


def placeholders(spoilt: Spoilt) -> list[tuple[str, str]]:
    """The fixes that lack a number: what they say, and the program with the numbers that they name."""
    result = solve(spoilt.text, control=spoilt.control)
    found = []
    for finding, fix in ((each, fix) for each in result.diagnostics for fix in each.fixes):
        if fix.applicability is Applicability.PLACEHOLDER:
            assert all(each.example for each in fix.numbers)
            text = fix.example
            mended = next((each.lines for each in result.answers if finding.span.line in each.lines), (2,))
            lines = [*spoilt.lines[: mended[0] - 1], *text.split("\n"), *spoilt.lines[mended[-1] :]]
            found.append((fix.description, "\n".join(lines)))
    return found


@pytest.mark.parametrize("form", ["g111", "g112", "pair", "cornered", "chain"])
@pytest.mark.parametrize("seed", range(12))
def test_a_word_without_its_number_is_offered_with_a_number_that_makes_a_contour(seed, form):
    draw = random.Random(f"numbers {seed}")
    for spoilt in (FORMS[form](draw) for _ in range(3)):
        found = placeholders(spoilt)
        answers = solve(spoilt.text, control=spoilt.control, depth="verdict").answers if found else ()
        if sum(answer.status is not Status.SOLVED for answer in answers) > 1:
            continue  # each of two contours would have to be mended
        plain = len(spoilt.lines) - 1 - sum(len(answer.lines) for answer in answers)
        for description, text in found:
            assert is_clean(text.split("\n"), spoilt.control, len(answers), plain), (spoilt, description)


@pytest.mark.parametrize(
    ("circle", "fix"),
    [
        ("X-40 Y60 I-40 J20", "add R40 to program line 3"),
        ("X-40 I-40 J20 R40", "add Y60 to program line 3"),
        ("X-30 Y60 J30 R50", "add I-70 to program line 3"),
    ],
)
def test_the_word_that_closes_a_circle_has_the_number_that_the_circle_fixes(circle, fix):
    result = solve(f"G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG3 {circle} Q-1", control="nct-99m")
    fixes = [each.description.partition(" -> ")[0] for finding in result.diagnostics for each in finding.fixes]
    assert fix in fixes


def check_ends(spoilt: Spoilt) -> int:
    """That each end of the numbers that a fix names makes a contour, and one increment more does not; how many."""
    count = 0
    for fix in (fix for each in solve(spoilt.text, control=spoilt.control).diagnostics for fix in each.fixes):
        for number in fix.numbers if len(fix.numbers) == 1 else ():
            for ends, sign in ((each, sign) for each in number.ranges for sign in (-1, 1)):
                word = ends.low if sign < 0 else ends.high
                if word:
                    address, at = re.fullmatch(r"(,?[A-Z]+)(.+)", word).groups()
                    count += 1
                    for value, is_good in ((Decimal(at), True), (Decimal(at) + sign * Decimal("0.001"), False)):
                        spelled = f"{address}{value:f}{'' if '.' in str(value) else '.'}"
                        text = fix.replacement.replace(number.word, spelled)
                        told = is_clean([spoilt.lines[0], *text.split("\n")], spoilt.control)
                        assert told is is_good, (spoilt, fix, value)
    return count


@pytest.mark.parametrize("form", ["g111", "g112", "pair", "cornered"])
@pytest.mark.parametrize("seed", range(10))
def test_the_numbers_that_are_named_for_a_word_reach_to_the_last_increment_in_many_blocks(seed, form):
    check_ends(FORMS[form](random.Random(f"ends {seed}")))


@pytest.mark.parametrize(
    ("block", "ends"),
    [
        ("G111 X100. A180. B160. C2.", 3),
        ("G111 X100. A180. K-30. P5. Q5.", 4),
        ("G111 A180. K-30. B135. P5. Q5.", 4),
        ("G111 X100. A180. C2. (contoursolve: length of line 1 = 30)", 6),
        ("G111 K-20. A180. C2. (contoursolve: length of line 2 = 30)", 4),
    ],
)
def test_the_numbers_that_are_named_for_a_word_reach_to_the_last_increment(block, ends):
    assert check_ends(Spoilt(("G00 X40. Z0.", block), "yasnac-lx3")) == ends


@pytest.mark.parametrize(
    "block", ["G111 X100. A180. B160. C2.", "G111 X100. A180. B120. C5. D5.", "G111 I10. B180. Z-40."]
)
def test_a_word_is_offered_without_its_number_exactly_where_some_number_makes_a_contour(block):
    said = [description for description, _ in placeholders(Spoilt(("G00 X40. Z0.", block), "yasnac-lx3"))]
    for address in sorted(set("AIKBXUZW") - {word[0] for word in block.split()[1:]}):
        values = range(-175, 181, 5) if address in "AB" else range(-100, 101, 4)
        works = any(is_clean(["G00 X40. Z0.", f"{block} {address}{value}."], "yasnac-lx3") for value in values)
        assert works == any(each.startswith(f"add {address}?") for each in said), (address, said)


def test_a_point_on_the_line_itself_is_not_offered():
    result = solve("G17 G90 G42 D1 G0 X0 Y0\nG1 ,A0.\nG1 X50. Y0. ,A180.", control="nct-99m")
    fixes = [fix.description for finding in result.diagnostics for fix in finding.fixes]
    assert not any(fix.startswith("delete ,A0.; add X?") for fix in fixes)


OUTLINE = """G17 G90 G0 X0 Y0
G1 X20 Y0 ,R2 F200
X30 Y10 ,R2
X40 Y0 ,R2
X60 Y0 ,R2
X60 Y20 ,R30
X50 Y30 ,R2
X60 Y40 ,R2
X0 Y40 ,R2
X-10 Y20 ,R2
X0 Y0"""
"""Ten elements, of which two do not fit."""


def zigzag(length: int, **changed: str) -> str:
    """A chain of lines with a rounding between each two, some of them written otherwise: `line_3="G1 X60 ,R2"`."""
    lines = [f"G1 X{20 * number} Y{10 * (number % 2)} ,R2" for number in range(1, length)]
    lines.append(f"G1 X{20 * length} Y{10 * (length % 2)}")
    for name, text in changed.items():
        lines[int(name.removeprefix("line_")) - 1] = text
    return "\n".join(["G17 G90 G0 X0 Y0", *lines])


@pytest.mark.parametrize(
    ("text", "fix", "place"),
    [
        (OUTLINE, "write ,R29.313 for ,R30", 5),
        (zigzag(30, line_15="G1 X300 Y10 ,R100"), "write ,R42.721 for ,R100", 3),
        (zigzag(30, line_15="G1 X300 Y10 ,R-2"), "write ,R2 for ,R-2", 0),
        (zigzag(30, line_15="G1 X-300 Y10 ,R2"), "write X300 for X-300 (a minus sign too many)", 0),
        (zigzag(30, line_15="G1 X300 Y10 R2"), "write ,R2 for R2", 0),
        (zigzag(30, line_15="G1 X300 Y10 ,R2 ,C3"), "delete ,C3", 1),
        (zigzag(30, line_15="G1 X300 Y10 ,A30. ,R2"), "delete ,A30.", 0),
        (zigzag(30, line_15="G1 ,A30. ,R2"), "add X?", 1),
        (zigzag(30, line_15="G2 X300 Y10 ,R2"), "add R?", 0),
    ],
)
def test_one_mistake_in_a_long_chain_is_repaired_near_it(text, fix, place):
    found = [each for finding in solve(text, control="nct-99m").diagnostics for each in finding.fixes]
    assert [each.description.startswith(fix) for each in found].index(True) == place


@pytest.mark.parametrize(
    ("chain", "fixes"),
    [
        (
            "G1 X80 ,R90\nG1 Y50",
            ["write ,R9 for ,R90 (a zero too many)", "write ,R50 for ,R90 (another digit)", "delete ,R90"],
        ),
        (
            "G1 X80 ,R50\nG1 Y50 ,C20\nG1 X0",
            [
                "write ,R5 for ,R50 (a zero too many)",
                "write ,R30 for ,R50 (another digit)",
                "delete ,C20",
                "delete ,R50",
            ],
        ),
        (
            "G1 X80 ,R5\nG1 X90 ,R5\nG1 Y50",
            ["delete ,R5 in program line 2", "write Y80 for X80 (another letter)"],
        ),
    ],
    ids=["lines are left", "a contour and a line", "a contour is left"],
)
def test_a_corner_that_cannot_be_made_may_be_left_out_though_it_parts_the_contour(chain, fixes):
    start = "G17 G90 G0 X0 Y0"
    result = solve(f"{start}\n{chain}", control="nct-99m")
    found = [fix for finding in result.diagnostics for fix in finding.fixes]
    assert [fix.description.partition(" -> ")[0] for fix in found] == fixes
    for fix in found:
        mended = solve(f"{start}\n{fix.replacement}", control="nct-99m")
        assert not [each for each in mended.diagnostics if each.code != "no-contour"]


@pytest.mark.slow
def test_many_mistakes_in_a_long_chain_are_not_tried_in_every_combination():
    """Each of 40 lines lacks a word, and three would do: 3**40 combinations, all of them too many changes."""
    lines = ["G1 ,A30 ,R1", "G1 ,A-30 ,R1"] * 20
    result = solve("\n".join(["G17 G90 G41 D0 G0 X0 Y0", *lines]), control="nct-99m")
    assert [fix for finding in result.diagnostics for fix in finding.fixes] == []


def test_a_corner_far_from_the_mistake_is_not_touched():
    result = solve(OUTLINE, control="nct-99m")
    line = result.diagnostics[0].span.line
    for fix in (fix for finding in result.diagnostics for fix in finding.fixes):
        changed = [
            number
            for number, lines in enumerate(zip(OUTLINE.split("\n")[1:], fix.replacement.split("\n"), strict=True), 2)
            if len({each.partition(",")[2] for each in lines}) > 1
        ]
        assert all(abs(number - line) <= 1 for number in changed)


MILL = "G17 G90 G0 X0 Y0\n"


@pytest.mark.parametrize(
    ("control", "program", "told"),
    [
        ("fanuc-lathe", "G0 X20. Z0.\nG1 Z-20. ,R30.\nX60.", {"limit": 20.0}),
        ("nct-99m", MILL + "G1 X30 ,C31\nX40 Y40", {"limit": 30.0}),
        # The largest is no decimal: 20 is sqrt(2) times it.
        ("fanuc-lathe", "G0 X20. Z0.\nG1 Z-20. ,C31.\nX40. Z-30.", {"limit": 14.142135624}),
        # Each of two keeps the other one's room.
        ("nct-99m", MILL + "G1 X30 ,C20\nY30 ,C20\nX60", {"limit_first": 10.0, "limit_second": 10.0}),
        # The second takes all of the line, so both must come down.
        ("nct-99m", MILL + "G1 X60 ,C20\nY30 ,C30\nX120", {"together": 15.0}),
        # An arc before the corner: what is left does not fall linearly, and ends where no rounding touches both.
        ("nct-99m", MILL + "G1 X50 Y0 ,R90\nG3 X-50 Y0 R50", {"limit": 25.0}),
    ],
)
def test_what_fits_is_told_to_the_last_digit(control, program, told):
    (finding, *_) = [each for each in solve(program, control=control, rules="off").diagnostics if each.is_error]
    assert {name: finding.values[name] for name in told} == pytest.approx(told, abs=1e-8)
