"""What may change in a program without changing its contour, and what changes the contour in step.

Blocks are drawn broadly: each comes from a contour, many have a word too many, missing or wrong, under every
policy, so that the laws are tested on every verdict. Answers are alike if status, codes of the findings and
elements are equal, and all coordinates to 1e-9 mm.
"""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from decimal import Decimal
from math import atan2, degrees, hypot
from random import Random
from typing import Any

import pytest
from examples import law
from generate_nct import FORMS, random_chain, random_cornered, random_pair
from hypothesis import assume, given, settings, strategies as st
from oracle import PLANES
from records import replace

from contoursolve import Answer, ArcSegment, solve

LATHE, MILL = "yasnac-lx3", "nct-99m"
NOT_LENGTHS = {LATHE: ("A", "B"), MILL: (",A", "Q")}

Words = dict[str, Decimal]


@dataclass(frozen=True)
class Block:
    codes: tuple[str, ...]
    words: Words

    def texts(self) -> list[str]:
        return [*self.codes, *(address + with_point(value) for address, value in self.words.items())]


@dataclass(frozen=True)
class Problem:
    """A program of one contour: a block that positions the tool, and those of the contour."""

    control: str
    blocks: tuple[Block, ...]
    rules: str
    plane: int = 18
    tolerance: float = 1e-9
    """mm."""

    def answer(self, program: str | None = None, **arguments: str) -> Answer:
        text = program if program is not None else "\n".join(" ".join(block.texts()) for block in self.blocks)
        (answer,) = solve(text, control=self.control, rules=self.rules, depth="verdict", **arguments).answers
        return answer


def with_point(value: Decimal) -> str:
    text = f"{value:f}"
    return text if "." in text else text + "."


# Drawing problems -------------------------------------------------------------------------------------

GRID = st.integers(-1_000, 1_000).map(lambda step: Decimal(step) / 20)
ANGLES = st.one_of(
    st.integers(-24, 24).map(lambda step: Decimal(15 * step)),
    st.integers(-360_000, 360_000).map(lambda step: Decimal(step) / 1_000),
)
SIZES = st.sampled_from([Decimal(size) for size in ("0", "0.5", "1", "2", "5", "10", "40")])
RULES = st.sampled_from(("enforce", "enforce", "warn", "off"))
ONE_IN_FOUR = st.integers(0, 3).map(lambda number: number == 0)


def angle_of(first: Decimal, second: Decimal) -> Decimal:
    """To 0.001 deg, as a drawing gives it."""
    return round(Decimal(degrees(atan2(second, first))), 3)


@st.composite
def tapers(draw: st.DrawFn) -> Problem:
    z, x, k, i, w, u = (draw(GRID) for _ in range(6))
    true = {"A": angle_of(k, i), "I": i, "K": k, "B": angle_of(w - k, u / 2 - i)}
    true |= {"X": x + u, "U": u, "Z": z + w, "W": w}
    first = draw(st.sampled_from(("AI", "AK", "IK", "AIK")))
    second = draw(st.sampled_from(("BX", "BU", "BZ", "BW", "XZ", "XW", "UZ", "UW", "BXZ", "BUW")))
    if len(second) == 3 and draw(st.booleans()):
        first = first[0]
    names = [*first, *second]
    if draw(ONE_IN_FOUR):
        other = draw(st.sampled_from("AIKBXUZW"))
        names = [name for name in names if name != other] if other in names else [*names, other]
    words = {name: true[name] for name in names}
    if draw(ONE_IN_FOUR):
        wrong = draw(st.sampled_from(names))
        words[wrong] = draw(ANGLES if wrong in "AB" else GRID)
    has_corner2 = (len(second) == 2 and "B" in second) or draw(ONE_IN_FOUR)
    for name in draw(st.sampled_from(("", "", "C", "P", "D", "Q", "CD", "CQ", "PD", "PQ", "CP", "DQ"))):
        if name in "CP" or has_corner2:
            words[name] = draw(SIZES)
    return Problem(LATHE, (Block(("G00",), {"X": x, "Z": z}), Block(("G111",), words)), draw(RULES))


@st.composite
def pairs(draw: st.DrawFn) -> Problem:
    plane = draw(st.sampled_from(tuple(PLANES)))
    first, second, i, j = PLANES[plane]
    start = draw(GRID), draw(GRID)
    center = draw(GRID.filter(bool)), draw(st.one_of(st.just(Decimal(0)), GRID))
    # Points of the circle that are as round as its centre; among them the start and the one opposite.
    round_points = [(a * p, b * q) for p, q in (center, center[::-1]) for a in (1, -1) for b in (1, -1)]
    on_circle = [(center[0] + p, center[1] + q) for p, q in round_points]
    step, crossing = draw(st.sampled_from(on_circle)), draw(st.sampled_from(on_circle))
    tangent = center[1] - crossing[1], crossing[0] - center[0]
    run = draw(st.one_of(st.just(tangent), st.tuples(GRID, GRID)))
    ahead = draw(st.sampled_from([Decimal(text) for text in ("-1", "0", "0.5", "1", "2")]))
    end = [start[axis] + crossing[axis] + ahead * run[axis] for axis in (0, 1)]
    distance = draw(st.sampled_from(("G90", "G91")))
    point = step if distance == "G91" else (start[0] + step[0], start[1] + step[1])
    circle = draw(st.sampled_from(("center", "both", "radius", "radius")))
    arc: Words = {}
    if circle != "center":
        arc |= {first: point[0], second: point[1]}
    if circle != "radius":
        arc |= {i: center[0], j: center[1]}
    else:
        arc["R"] = round(Decimal(hypot(*center)), 3) * draw(st.sampled_from((1, -1)))
    line = {first: end[0], second: end[1], ",A": angle_of(*run), "Q": Decimal(draw(st.sampled_from((-1, 1))))}
    if draw(ONE_IN_FOUR):
        other = draw(st.sampled_from((*PLANES[plane], "R", "Q")))
        if other == "Q":
            del line["Q"]
        elif other not in arc:
            arc[other] = draw(GRID)
        elif len(arc) > 1:
            del arc[other]
    if draw(ONE_IN_FOUR):
        wrong = draw(st.sampled_from((*arc, ",A")))
        (line if wrong == ",A" else arc)[wrong] = draw(ANGLES if wrong == ",A" else GRID)
    blocks = (
        Block(
            (f"G{plane}", "G90", draw(st.sampled_from(("G41", "G42", "G41", "G42", "G40"))), "G0"),
            {first: start[0], second: start[1]},
        ),
        Block((distance, draw(st.sampled_from(("G2", "G3")))), arc),
        Block(("G1",), line),
    )
    return Problem(MILL, blocks, draw(RULES), plane)


@st.composite
def chains(draw: st.DrawFn) -> Problem:
    """An NCT program of up to six blocks with corners, written from a path to 12 decimals; each passes rounding on."""
    rng = Random(draw(st.integers(0, 2**32)))
    kinds = (
        lambda: random_pair(rng, rng.choice(FORMS), 17, rng.choice("CR")),
        lambda: random_cornered(rng, 17),
        lambda: random_chain(rng, rng.randint(2, 6), 17),
    )
    found = []
    for line in draw(st.sampled_from(kinds))().program:
        words = re.findall(r"(,?[A-Z])(-?\d*\.?\d+)", line)
        codes = tuple(f"G{int(value)}" for address, value in words if address == "G")
        found.append(Block(codes, {address: Decimal(value) for address, value in words if address not in "GD"}))
    return Problem(MILL, tuple(found), "enforce", 17, 1e-7)


def in_force(problem: Problem) -> Iterator[tuple[Block, bool, bool]]:
    """Each block of a mill, whether it counts from where the tool is, and whether it is the second of two arcs."""
    is_incremental, is_arc = False, False
    for block in problem.blocks:
        is_incremental = "G91" in block.codes or (is_incremental and "G90" not in block.codes)
        was_arc, moves = is_arc, [code for code in block.codes if code in ("G0", "G1", "G2", "G3")]
        is_arc = moves[-1] in ("G2", "G3") if moves else is_arc
        yield block, is_incremental, was_arc and is_arc


def is_over(block: Block, plane: int) -> bool:
    """Whether a block says more than where it ends: then its places are absolute."""
    first, second, i, j = PLANES[plane]
    return block.words.keys() >= {first, second, ",A"} or block.words.keys() >= {first, second, i, j, "R", "Q"}


PAIRS = st.one_of(tapers(), pairs())
PROBLEMS = st.one_of(tapers(), pairs(), chains())


# Likeness ---------------------------------------------------------------------------------------------

INCHES_APART = 0.02
"""mm. By so much words may differ that agree as inches and disagree as millimetres, with some increments of each."""

OTHER_WAY = {"cw": "ccw", "ccw": "cw", "G2": "G3", "G3": "G2", "G41": "G42", "G42": "G41", "": ""}


def describe(answer: Answer, is_mirrored: bool = False, shift: float = 0.0) -> tuple[list[Any], list[float]]:
    """What must be equal, and the lengths that must be equal to the tolerance; after moving the contour."""
    # Moved, a path crosses the spindle axis or does so no more.
    codes = Counter(each.code for each in answer.diagnostics if each.code != "axis-crossed")
    facts: list[Any] = [answer.status, dict(answer.sides), codes]
    if answer.contour is None:
        return facts, []
    points = [answer.contour.start, answer.contour.end, *answer.contour.points.values()]
    lengths = []
    for element in answer.contour.elements:
        turn = element.turn.value if isinstance(element, ArcSegment) else ""
        facts.append((element.name, OTHER_WAY[turn] if is_mirrored else turn))
        points += [element.start, element.end]
        if isinstance(element, ArcSegment):
            points.append(element.center)
            lengths.append(element.radius)
    for first, second in points:
        lengths += [(-first if is_mirrored else first) + shift, second + shift]
    return [*facts, *answer.contour.points], lengths


def assert_alike(problem: Problem, other: Answer, is_mirrored: bool = False, shift: float = 0.0) -> None:
    facts, lengths = describe(problem.answer(), is_mirrored, shift)
    other_facts, other_lengths = describe(other)
    if is_mirrored and problem.control == MILL:
        # A line is met on the same side, two arcs on the other one.
        facts[1] = other_facts[1] = None
    assert other_facts == facts
    assert all(abs(a - b) <= problem.tolerance for a, b in zip(lengths, other_lengths, strict=True)), (
        lengths,
        other_lengths,
    )


# Laws -------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_problems_of_these_laws_meet_every_verdict() -> None:
    met: Counter[str] = Counter()

    @settings(derandomize=True, deadline=None, max_examples=500)
    @given(PAIRS)
    def look(problem: Problem) -> None:
        met[f"{problem.control} {problem.answer().status.value}"] += 1

    look()
    verdicts = ("solved", "rejected", "no-solution", "underdetermined", "overdetermined", "conflicting")
    assert min(met[f"{LATHE} {verdict}"] for verdict in verdicts) >= 2, met
    assert min(met[f"{MILL} {verdict}"] for verdict in ("solved", "rejected", "no-solution", "conflicting")) >= 10, met


@law(PROBLEMS, st.randoms(use_true_random=False))
def test_the_order_of_words_does_not_matter(problem: Problem, rng: Random) -> None:
    lines = [rng.sample(block.texts(), len(block.texts())) for block in problem.blocks]
    assert_alike(problem, problem.answer("\n".join(map(" ".join, lines))))


@law(PROBLEMS, st.randoms(use_true_random=False))
def test_layout_does_not_matter(problem: Problem, rng: Random) -> None:
    """Case, blanks, line ends, block numbers, comments, empty lines, and how a number is spelled."""
    lines = ["%", "", "(G111 X1. ; not a block)"]
    for number, block in enumerate(problem.blocks):
        texts = [spell(text, rng) for text in block.texts()]
        texts.insert(rng.randint(0, len(texts)), rng.choice(("", "(X999.)", "( R1, ,A5 )")))
        head = rng.choice((f"N{10 * number} ", f"n{number}", ""))
        lines += [head + rng.choice((" ", "", "  ", "\t")).join(texts) + rng.choice(("", " ; M30 X5.", "  "))]
        lines += rng.choice(([], [""], ["(G90)"], [f"N{number + 5}"]))
    assert_alike(problem, problem.answer(rng.choice(("\r\n", "\n")).join(lines)))


def spell(text: str, rng: Random) -> str:
    """The same word, written in another way."""
    split = 2 if text[0] == "," else 1
    address, value = text[:split], text[split:]
    if "." in value:
        value = rng.choice((value, value + "0", value.replace("-", "-0"), value if value[0] == "-" else "+" + value))
    return rng.choice((address, address.lower())) + rng.choice(("", "", " ")) + value


@law(PROBLEMS)
def test_the_start_may_be_given_apart(problem: Problem) -> None:
    first, *rest = (" ".join(block.texts()) for block in problem.blocks)
    assert_alike(problem, problem.answer("\n".join(rest), start=first))


@law(PROBLEMS, st.booleans())
def test_inches_and_millimetres_give_the_same_contour(problem: Problem, is_in_program: bool) -> None:
    """25.4 times the inches are exact decimals."""

    def in_mm(block: Block) -> Block:
        kept = NOT_LENGTHS[problem.control]
        words = {name: value if name in kept else value * Decimal("25.4") for name, value in block.words.items()}
        return replace(block, words=words)

    text = "\n".join(" ".join(block.texts()) for block in problem.blocks)
    in_inches = problem.answer("G20\n" + text) if is_in_program else problem.answer(text, units="inch")
    in_millimetres = replace(problem, blocks=tuple(map(in_mm, problem.blocks)))
    # Words agree within half their increments, which are larger in inches.
    findings = (*in_millimetres.answer().diagnostics, *in_inches.diagnostics)
    assume(not any(each.values.get("off_by_mm", 1.0) < INCHES_APART for each in findings))
    assert_alike(in_millimetres, in_inches)


@law(PAIRS)
def test_absolute_and_incremental_words_give_the_same_contour(problem: Problem) -> None:
    """G111: X and U, Z and W. NCT: the arc in G90 and G91; the line stays absolute."""
    at, block, *rest = problem.blocks
    if problem.control == LATHE:
        pairs = (("X", "U", at.words["X"]), ("Z", "W", at.words["Z"]))
        words = {name: value for name, value in block.words.items() if name not in "XUZW"}
        for absolute, increment, start in pairs:
            if absolute in block.words:
                words[increment] = block.words[absolute] - start
            if increment in block.words:
                words[absolute] = block.words[increment] + start
        codes = block.codes
    else:
        sign = 1 if block.codes[0] == "G91" else -1
        words = {name: value + sign * at.words.get(name, 0) for name, value in block.words.items()}
        codes = ("G90" if sign == 1 else "G91", *block.codes[1:])
    assert_alike(problem, replace(problem, blocks=(at, Block(codes, words), *rest)).answer())


@law(PROBLEMS)
def test_the_mirrored_program_gives_the_mirrored_contour(problem: Problem) -> None:
    """Across the plane's second axis: in Z on the lathe."""
    first, _, i, _ = PLANES[problem.plane]
    negated = ("Z", "W", "K") if problem.control == LATHE else (first, i)
    angles = ("A", "B", ",A")

    def mirrored(block: Block, is_between_arcs: bool) -> Block:
        words = {
            name: 180 - value - (360 if value < -180 else 0) if name in angles else -value if name in negated else value
            for name, value in block.words.items()
        }
        # Between circles, Q names a side.
        if is_between_arcs and "Q" in words:
            words["Q"] = -words["Q"]
        return Block(tuple(OTHER_WAY.get(code, code) for code in block.codes), words)

    other = replace(problem, blocks=tuple(mirrored(block, is_second) for block, _, is_second in in_force(problem)))
    assert_alike(problem, other.answer(), is_mirrored=True)


@law(PROBLEMS)
def test_the_program_shifted_by_1000_mm_gives_the_shifted_contour(problem: Problem) -> None:
    first, second, i, j = PLANES[problem.plane]
    diameters = {"X": 2_000, "Z": 1_000}

    def shifted(block: Block, is_incremental: bool) -> Block:
        axes = diameters if problem.control == LATHE else dict.fromkeys((first, second), 1_000)
        if problem.control == MILL and is_over(block, problem.plane):
            axes = axes | (dict.fromkeys((i, j), 1_000) if "R" in block.words else {})
        elif is_incremental:
            return block
        return replace(block, words={name: value + axes.get(name, 0) for name, value in block.words.items()})

    other = replace(
        problem, blocks=tuple(shifted(block, is_from_there) for block, is_from_there, _ in in_force(problem))
    )
    assert_alike(problem, other.answer(), shift=1_000)


@law(PROBLEMS, st.sampled_from((-360, 360)))
def test_a_full_turn_more_in_an_angle_changes_nothing(problem: Problem, turn: int) -> None:
    def turned(block: Block) -> Block:
        words = {
            name: value + turn if name in ("A", "B", ",A") and abs(value + turn) <= 360 else value
            for name, value in block.words.items()
        }
        return replace(block, words=words)

    assert_alike(problem, replace(problem, blocks=tuple(map(turned, problem.blocks))).answer())


@law(tapers())
def test_a_lathe_number_without_a_point_counts_thousandths(problem: Problem) -> None:
    lines = [
        " ".join([*block.codes, *(f"{name}{value * 1_000:.0f}" for name, value in block.words.items())])
        for block in problem.blocks
    ]
    answer = problem.answer("\n".join(lines))
    assert (answer.status, answer.contour) == (problem.answer().status, problem.answer().contour)


# Exact decimals that binary fractions miss by a little.
PLACES = ("0", "66.6", "1234.567", "-7777.7")
RADII = ("50", "2.3")


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("radius", RADII)
@pytest.mark.parametrize(("angle", "side", "ahead"), [(0, 1, 20), (0, -1, 20), (180, 1, -20)])
def test_a_tangent_line_touches_the_circle_wherever_it_lies(place: str, radius: str, angle: int, side: int, ahead: int):
    at, size = Decimal(place), Decimal(radius)
    line = f"G1 X{at - size + ahead} Y{at + size} ,A{angle} Q{side}"
    (answer,) = solve(f"G17 G42 G0 X{at} Y{at}\nG3 I{-size} J0\n{line}", control=MILL).answers
    assert answer.status.value == "solved"
    assert [each.code for each in answer.diagnostics] == ["nct-circle-touched"]


def test_a_conflict_in_the_third_block_is_explained_by_words_of_the_blocks_before() -> None:
    program = "G17 G90 G0 X0 Y0\nG1 X30 ,R2\nG91 Y20 ,R2\nG2 G90 X50 Y25 I20 J0"
    (finding,) = solve(program, control="nct-99m").diagnostics
    assert (finding.code, finding.span.line) == ("nct-radius-difference", 4)
    told = "because the arc begins at the corner between program lines 3 and 4, where X30 (program line 2) and Y20 ("
    assert f"{told}program line 3) put it" in finding.notes


def test_a_corner_at_an_end_that_is_off_its_arc_by_less_than_allowed_is_made() -> None:
    program = "G17 G90 G0 X0 Y0\nG3 X40 Y0.004 I20 J0 ,C5\nG1 X80"
    answer = solve(program, control="nct-99m", depth="verdict").answers[0]
    assert answer.contour is not None
    begin, end = answer.contour.elements[1].start, answer.contour.elements[1].end
    corner = 40 + 0.004j
    assert abs(complex(*begin) - corner) == pytest.approx(5, abs=1e-9)
    assert abs(complex(*end) - corner) == pytest.approx(5, abs=1e-9)
