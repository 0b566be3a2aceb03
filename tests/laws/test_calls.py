"""Programs with calls, loops, branches and formulas are what they run: the flat program of a reference interpreter."""

import json
import re
from collections import defaultdict
from itertools import pairwise

import pytest
from drawn_calls import CONTROLS, FANUC_LIKE, Program, drawn_program
from reference_interpreter import Fanuc

from contoursolve import Answer, OpenProgram, check, expand, solve
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.output.document import to_json


def drawn(count: int):
    """So many programs of every control."""
    return pytest.mark.parametrize(("control", "seed"), [(name, seed) for seed in range(count) for name in CONTROLS])


MOST_TOLD = 10
ROUNDED = 0.002
"""mm by which two programs may differ that are rounded to 0.001."""


class Flat(Fanuc):
    """Runs a program as Fanuc would, for the numbers of its blocks: `text` is the flat program of them, and `origins`
    are the lines of the program where its lines are."""

    def __init__(self, program: Program) -> None:
        self.blocks, self.found = [], []
        told = program.spell(FANUC_LIKE, self.keep)
        super().__init__(told, lambda: pytest.fail("a condition is not known"), is_turning=False)
        self.section(0)
        self.text, self.origins = program.flat(self.found)

    def keep(self, lines, statement):
        lines.append(f"@{len(self.blocks)}")
        self.blocks.append(statement)

    def words(self, line):
        if line[0] != "@":
            super().words(line)
            return
        statement = self.blocks[int(line[1:])]
        values = [[FANUC_LIKE.formula(each) for each in own] for _, own in statement[1]["blocks"]]
        self.found.append((statement, [[float(self.value(each)[0]) for each in own] for own in values]))


def result_of(answer: Answer) -> object:
    """The status and the path of a contour."""
    ends = [each.end for each in answer.contour.elements] if answer.contour else []
    return answer.status, tuple(tuple(round(at, 5) + 0.0 for at in end) for end in ends)


def results(flat: Flat, control: str) -> dict[int, set[object]]:
    """The results of each contour of the flat program, by its line in the program."""
    found = defaultdict(set)
    for answer in solve(flat.text, control=control, depth="verdict").answers:
        found[flat.origins[answer.lines[0]]].add(result_of(answer))
    return found


@drawn(9)
def test_contours_are_those_of_the_flat_program(control, seed):
    program, own = drawn_program(control, seed), defaultdict(list)
    flat = Flat(program)
    for answer in solve(program.text, control=control, depth="verdict").answers:
        if answer.lines[0] in flat.origins.values():
            own[answer.lines[0]].append(result_of(answer))
    expected = results(flat, control)
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


@drawn(7)
@pytest.mark.usefixtures("without_repairs")
def test_expanded_inline_it_is_the_flat_program(control, seed):
    program = drawn_program(control, seed)
    own = Flat(program)
    options = {"control": control, "comments": False, "keep_going": True}
    inline, flat = expand(program.text, inline=True, **options), expand(own.text, **options)
    assert are_alike(inline.text, flat.text)
    assert inline.summary.replaced == flat.summary.replaced
    once = expand(program.text, **options)
    assert are_alike(expand(once.text, inline=True, **options).text, flat.text)
    # Each contour is written once, if it is the same every time.
    left = {line for each in once.summary.left for line in each.lines}
    for line, found in results(own, control).items():
        status = {each[0].value for each in found}
        assert (line in left) is (len(found) > 1 or status != {"solved"}), line


@drawn(4)
def test_verify_says_that_it_is_right(control, seed):
    program = drawn_program(control, seed).text
    result, text = solve(program, control=control, depth="verdict"), Document("", program.encode())
    told = json.loads(to_json(result))
    solved = [each for each in told["contours"] if each["status"] == "solved"]
    whole = ReceiptVerdict.VERIFIED if solved else ReceiptVerdict.NOTHING_CHECKED
    assert verify(text, Document("", json.dumps(told).encode())).verdict in (whole, ReceiptVerdict.PARTLY_VERIFIED)
    if solved:
        solved[-1]["elements"][-1]["end"][0] += 0.5
        assert verify(text, Document("", json.dumps(told).encode())).verdict is ReceiptVerdict.FAILED


@drawn(4)
def test_an_editor_finds_the_same_whatever_the_order_of_words_and_whenever_it_is_asked(control, seed):
    text = drawn_program(control, seed).text
    result = solve(text, control=control)
    opened = OpenProgram(text, control=control)
    opened.check()
    assert opened.diagnostics == result.diagnostics
    assert {each.code for each in check(text, control=control)} == {each.code for each in result.diagnostics}
    assert to_json(solve(text, control=control)) == to_json(result)
    other = solve(drawn_program(control, seed, is_shuffled=True).text, control=control, depth="verdict")
    assert [*map(result_of, other.answers)] == [*map(result_of, result.answers)]
