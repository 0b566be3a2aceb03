"""Programs with calls, loops, branches and formulas are what they run: the flat program of a small interpreter."""

import json
import re
from collections import defaultdict
from itertools import pairwise

import pytest
from small_interpreter import CONTROLS, Typed, program

from contoursolve import Answer, OpenProgram, check, expand, solve
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.output.document import to_json


def drawn(count: int):
    """So many programs of every control."""
    return pytest.mark.parametrize(("control", "seed"), [(name, seed) for seed in range(count) for name in CONTROLS])


MOST_TOLD = 10
ROUNDED = 0.002
"""mm by which two programs may differ that are rounded to 0.001."""


def result_of(answer: Answer) -> object:
    """The status and the path of a contour."""
    ends = [each.end for each in answer.contour.elements] if answer.contour else []
    return answer.status, tuple(tuple(round(at, 5) + 0.0 for at in end) for end in ends)


def results(typed: Typed, control: str) -> dict[int, set[object]]:
    """The results of each contour of the flat program, by its line in the program."""
    found = defaultdict(set)
    for answer in solve(typed.flat, control=control).answers:
        found[typed.origins[answer.lines[0]]].add(result_of(answer))
    return found


@drawn(12)
def test_contours_are_those_of_the_flat_program(control, seed):
    typed, own = program(control, seed), defaultdict(list)
    for answer in solve(typed.text, control=control).answers:
        if answer.lines[0] in typed.origins.values():
            own[answer.lines[0]].append(result_of(answer))
    expected = results(typed, control)
    assert own.keys() == expected.keys()
    for line, found in own.items():
        assert expected[line] >= {*found} if len(found) == MOST_TOLD else expected[line] == {*found}, line


def moves(text: str) -> list[list[tuple[str, float | None]]]:
    """The words of each line that moves; a centre is that of the arc behind it."""
    bare = [re.sub(r"\([^)]*\)|;.*|^N\d+|^\d+ |^[O%].*|.*PGM.*| ", "", line) for line in text.split("\n")]
    moving = [line for line in bare if re.search("[XYZ][-+=.0-9]", line)]
    used = [line for line, behind in pairwise([*moving, ""]) if line[:2] != "CC" or behind[:1] == "C"]
    words = (re.findall(r"(CC|DR|[A-Z])=?([-+]?\d*\.?\d*)", line) for line in used)
    return [[(name, float(each) if each.strip("+-") else None) for name, each in line] for line in words]


def are_alike(one: str, other: str) -> bool:
    first, second = moves(one), moves(other)
    return len(first) == len(second) and all(
        [name for name, _ in left] == [name for name, _ in right]
        and all(a == b or abs((a or 0) - (b or 0)) < ROUNDED for (_, a), (_, b) in zip(left, right, strict=True))
        for left, right in zip(first, second, strict=True)
    )


@drawn(9)
def test_expanded_inline_it_is_the_flat_program(control, seed):
    typed = program(control, seed)
    options = {"control": control, "comments": False, "keep_going": True}
    inline, flat = expand(typed.text, inline=True, **options), expand(typed.flat, **options)
    assert are_alike(inline.text, flat.text)
    assert inline.summary.replaced == flat.summary.replaced
    once = expand(typed.text, **options)
    assert are_alike(expand(once.text, inline=True, **options).text, flat.text)
    # Each contour is written once, if it is the same every time.
    left = {line for each in once.summary.left for line in each.lines}
    for line, found in results(typed, control).items():
        status = {each[0].value for each in found}
        assert (line in left) is (len(found) > 1 or status != {"solved"}), line


@drawn(4)
def test_verify_says_that_it_is_right(control, seed):
    typed = program(control, seed)
    result, text = solve(typed.text, control=control), Document("", typed.text.encode())
    told = json.loads(to_json(result))
    right = (
        {ReceiptVerdict.VERIFIED, ReceiptVerdict.PARTLY_VERIFIED}
        if result.answers
        else {ReceiptVerdict.NOTHING_CHECKED}
    )
    assert verify(text, Document("", json.dumps(told).encode())).verdict in right
    solved = [each for each in told["contours"] if each["status"] == "solved"]
    if solved:
        solved[-1]["elements"][-1]["end"][0] += 0.5
        assert verify(text, Document("", json.dumps(told).encode())).verdict is ReceiptVerdict.FAILED


@drawn(4)
def test_an_editor_finds_the_same_whatever_the_order_of_words_and_whenever_it_is_asked(control, seed):
    text = program(control, seed).text
    result = solve(text, control=control)
    opened = OpenProgram(text, control=control)
    opened.check()
    assert opened.diagnostics == result.diagnostics
    assert {each.code for each in check(text, control=control)} == {each.code for each in result.diagnostics}
    assert to_json(solve(text, control=control)) == to_json(result)
    other = solve(program(control, seed, is_shuffled=True).text, control=control)
    assert [*map(result_of, other.answers)] == [*map(result_of, result.answers)]
