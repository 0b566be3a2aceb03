"""Repairs: those that drop words against a search through all sets of words, and how far the numbers reach."""

import random
import re
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
@pytest.mark.parametrize("seed", range(6))
def test_every_smallest_set_of_words_to_drop_is_offered(seed, form):
    check_drops(FORMS[form](random.Random(f"drops {seed}")))


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


@pytest.mark.parametrize(
    "block", ["G111 X100. A180. B160. C2.", "G111 X100. A180. B120. C5. D5.", "G111 I10. B180. Z-40."]
)
def test_a_word_is_offered_without_its_number_exactly_where_some_number_makes_a_contour(block):
    said = [description for description, _ in placeholders(Spoilt(("G00 X40. Z0.", block), "yasnac-lx3"))]
    for address in sorted(set("AIKBXUZW") - {word[0] for word in block.split()[1:]}):
        values = range(-175, 181, 5) if address in "AB" else range(-100, 101, 4)
        works = any(is_clean(["G00 X40. Z0.", f"{block} {address}{value}."], "yasnac-lx3") for value in values)
        assert works == any(each.startswith(f"add {address}?") for each in said), (address, said)


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
        (OUTLINE, "write ,R3 for ,R30 (a zero too many)", 0),
        (zigzag(30, line_15="G1 X300 Y10 ,R100"), "write ,R42.721 for ,R100", 1),
        (zigzag(30, line_15="G1 X300 Y10 ,R-2"), "write ,R2 for ,R-2", 0),
        (zigzag(30, line_15="G1 X-300 Y10 ,R2"), "write X300 for X-300 (a minus sign too many)", 0),
        (zigzag(30, line_15="G1 X300 Y10 R2"), "write ,R2 for R2", 0),
        (zigzag(30, line_15="G1 X300 Y10 ,R2 ,C3"), "delete ,C3", 1),
        (zigzag(30, line_15="G1 X300 Y10 ,A30. ,R2"), "delete ,A30.", 0),
        (zigzag(30, line_15="G1 ,A30. ,R2"), "add X?", 0),
        (zigzag(30, line_15="G2 X300 Y10 ,R2"), "add R?", 0),
    ],
)
def test_one_mistake_in_a_long_chain_is_repaired_near_it(text, fix, place):
    found = [each for finding in solve(text, control="nct-99m").diagnostics for each in finding.fixes]
    assert [each.description.startswith(fix) for each in found].index(True) == place


@pytest.mark.slow
def test_many_mistakes_in_a_long_chain_are_not_tried_in_every_combination():
    """Each of 20 lines lacks a word, and three would do: 3**20 combinations, all of them too many changes."""
    lines = ["G1 ,A30 ,R1", "G1 ,A-30 ,R1"] * 10
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
