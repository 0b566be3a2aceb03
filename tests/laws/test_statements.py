"""Statements about drawings: drawings told backwards, which an oracle measures, and what changes no drawing."""

import json
from cmath import phase
from collections import Counter
from decimal import Decimal
from itertools import combinations, permutations
from math import degrees
from random import Random
from typing import Any

import pytest
from chains import (
    KINDS,
    Chain,
    Fact,
    distance_between,
    form_residuals,
    measure,
    random_chain,
    random_facts,
    standard_facts,
)
from examples import law
from hypothesis import strategies as st
from sketches import chain_of, sketch_of

from contoursolve import Sketch, geometry, solve
from contoursolve.output.document import to_json
from contoursolve.solving import NoClosedFormError, analyse, is_closed, solve as solve_in_closed_form

ARC_LENGTH = "length of an arc"
PAIRED = ("angle", "tangent", "equal length", "equal radius")


Told = tuple[Chain, list[Fact]]


def told(seed: int, size: int, swaps: int) -> Told:
    rng = Random(seed)
    chain = random_chain(rng, size, offset=rng.choice((0, 100)))
    return chain, random_facts(chain, rng, swaps)


def kind_of(chain: Chain, fact: Fact) -> str:
    return ARC_LENGTH if fact.kind == "length" and chain.is_arc(fact.elements[0]) else fact.kind


def misses(chain: Chain, facts: list[Fact], drawing: Chain) -> float:
    return max(map(abs, [*form_residuals(drawing), *(measure(drawing, fact) for fact in facts)]))


KINDS_OF = {1: [*(kind for kind in KINDS if kind not in PAIRED), ARC_LENGTH], 2: [*PAIRED]}
"""The kinds of facts about so many elements."""


@pytest.mark.parametrize("part", range(4))
@pytest.mark.parametrize(("size", "kind"), [(size, kind) for size, kinds in KINDS_OF.items() for kind in kinds])
def test_a_drawing_comes_back_from_facts_of_every_kind(size: int, kind: str, part: int) -> None:
    """Two drawings come back, and none of those before is missing in a list without doubt."""
    back = 0
    for seed in range(part, 3_000, 4):
        chain, facts = told(seed, size, 1 + seed % 3 if size == 1 else 1)
        if kind not in {kind_of(chain, fact) for fact in facts}:
            continue
        texts = [fact.text for fact in facts]
        drawings = sketch_of(chain, facts).solve()
        found = [chain_of(drawing, chain) for drawing in drawings]
        assert all(misses(chain, facts, drawing) < 1e-7 for drawing in found), texts
        nearest = min((distance_between(drawing, chain) for drawing in found), default=1e9)
        assert nearest < 1e-6 or not drawings.is_complete, texts
        back += nearest < 1e-6
        if back == 2:
            return
    pytest.fail(f"{back} drawings came back")


def beside(chain: Chain, number: int, rng: Random) -> str:
    """A place that an element passes at some distance, and the distance as it is."""
    place = complex(rng.randint(-60, 60), rng.randint(-60, 60))
    if chain.is_arc(number):
        arc = chain.arc(number)
        distance = abs(abs(place - arc.center) - arc.radius)
    else:
        start, travel = chain.line(number)
        distance = abs((travel.conjugate() * (place - start)).imag) / abs(travel)
    return f"E{number} passes beside [X{place.real} Y{place.imag}] at {distance:.12f}"


def measured(chain: Chain, rng: Random) -> list[str]:
    """Facts of further kinds, with what is measured of a drawing."""
    facts = [beside(chain, number, rng) for number in chain.numbers]
    for number in chain.arcs:
        center, ends = chain.arc(number).center, chain.points[number - 1 : number + 1]
        facts.append(f"chord of E{number} = {abs(ends[1] - ends[0]):.12f}")
        for part, end in zip(("begin of ", ""), ends, strict=True):
            facts.append(f"polar angle of {part}E{number} = {degrees(phase(end - center)):.12f}")
    return facts


@law(st.integers(0, 2**32), few=2, many=13)
def test_a_fact_that_is_measured_on_a_drawing_is_true_of_it_and_adds_nothing(seed: int) -> None:
    rng = Random(seed)
    chain = random_chain(rng, rng.randint(1, 3))
    facts = standard_facts(chain)
    before = sketch_of(chain, facts).solve()
    for text in measured(chain, rng):
        sketch = sketch_of(chain, facts)
        sketch.state(text)
        after = sketch.solve()
        assert min(distance_between(chain_of(drawing, chain), chain) for drawing in after) < 1e-6, text
        assert not before.ties, text
        assert len(facts) in after.ties, text  # the last one repeats others
        # What is measured asks for the same value, but for whole turns.
        asking = sketch_of(chain, facts)
        if "=" in text:
            asking.state(f"{text.partition('=')[0]}= ?")
            values = [drawing.asked[0].value or 0.0 for drawing in asking.solve()]
            assert min(abs(value - float(text.partition("=")[2])) for value in values) < 1e-6, text


@law(st.integers(0, 2**32), few=2, many=13)
def test_a_point_beside_an_element_is_as_far_from_it_as_stated_on_either_side(seed: int) -> None:
    rng = Random(seed)
    radius, distance, place = rng.randint(5, 30), rng.randint(1, 40), complex(rng.randint(-60, 60), 0)
    line, circle = Sketch(), Sketch()
    line.infinite_line("e")
    line.state(f"direction of e = {rng.randint(-89, 89)}")
    circle.circle("e")
    for fact in (f"radius of e = {radius}", f"X of center of e = {rng.randint(-60, 60)}"):
        circle.state(fact)
    for sketch in (line, circle):
        sketch.state(f"e passes [X{place.real} Y0] at {distance}")
        for drawn in sketch.solve():
            if drawn.radii:
                off = abs(abs(complex(*drawn.points["e.center"]) - place) - radius)
            else:
                cosine, sine, offset = drawn.lines["e"]
                off = abs(cosine * place.imag - sine * place.real - offset)
            assert off == pytest.approx(distance, abs=1e-9)
    assert len(line.solve()) == 2


@law(st.integers(0, 2**32), few=2, many=6)
def test_a_parallel_line_is_as_far_away_as_measured(seed: int) -> None:
    """Of four corners the last one is left open, and comes back from how far its side is from the first."""
    rng = Random(seed)
    corners = [complex(rng.uniform(-60, 60), rng.uniform(-60, 60)) for _ in range(3)]
    way = corners[1] - corners[0]
    share = rng.choice((1, -1)) * rng.uniform(0.2, 2)
    apart = abs((way.conjugate() * (corners[2] - corners[0])).imag) / abs(way)
    last = corners[2] + share * way
    if min(apart, abs(way), abs(corners[2] - corners[1])) < 1:
        return
    for fact in ("c parallel to a", f"c parallel to a at {apart:.12f}"):
        sketch = Sketch((corners[0].real, corners[0].imag))
        for name in "abc":
            sketch.line(name)
        for name, at in (("P1", corners[1]), ("P2", corners[2])):
            sketch.state(f"X of {name} = {at.real:.12f}")
            # The distance says where P2 is, but for the side.
            if not (name == "P2" and "at" in fact):
                sketch.state(f"Y of {name} = {at.imag:.12f}")
        sketch.state(f"X of P3 = {last.real:.12f}")
        sketch.state(fact)
        drawings = sketch.solve()
        assert drawings.is_complete
        assert min(abs(complex(*drawn.points["P3"]) - last) for drawn in drawings) < 1e-6
        sketch.state(f"c parallel to a at {apart:.12f}")
        assert min(abs(complex(*drawn.points["P3"]) - last) for drawn in sketch.solve()) < 1e-6


def test_a_fact_against_the_direction_that_a_word_states_is_no_repetition() -> None:
    for fact in ("direction of line 2 = -60", "angle from line 1 to line 2 = 120"):
        (answer,) = solve("G111 A180. K-30. B120. X100.", start=START, facts=[fact]).answers
        assert answer.status.value == "conflicting"


# What may change without changing the drawing -------------------------------------------------------------

START = "X40. Z0."
TURNED = geometry.Plane("", ("Z", "X"), ("K", "I"), (False, True))
MILLED = geometry.Plane("", ("X", "Y"), ("I", "J"), (False, False))
PROGRAMS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("G111 X100. A180. K-30. B120. P?", ("straight part of line 2 = 30", "length of line 1 = ?")),
    ("G111 A180. B120. X100. P5. Q2.", ("Z of V1 = -30", "direction of line 2 = ?")),
    ("G111 X100. Z-47. B120.", ("length of line 1 = 30",)),
    ("G111 A180. K-30. B120. X100. P? Q?", ("radius of corner 1 = 3", "radius of corner 1 = radius of corner 2")),
    ("G111 A180. K-30. B120. P4. Q?", ("Z of center of corner 2 = -50", "X of V2 = 100", "corner 2 meets line at 180")),
    ("G111 A180. K-30. B? X100. P4.", ("line 2 passes through (Z-40. X70.)", "radius of corner 1 = ?")),
    ("G111 A180. K-30. B120. X100.", ("length of line 1 = 30", "X of S = 40")),
    ("G111 A180. K-30. B120. X100.", ("length of line 1 = 31",)),
    ("G111 A180. K-30. B120.", ("length of line 1 = ?",)),
    ("G111 A180. K-30. B120. P3.", ("length of line 2 = 20", "radius of line 2 = 4")),
)
STATEMENTS: dict[str, Any] = {
    "straight part of line 2 = 30": geometry.StraightIs("line 2", Decimal(30)),
    "length of line 1 = ?": geometry.LengthIs("line 1", None),
    "Z of V1 = -30": geometry.PointIs("", "V1", 0, Decimal(-30)),
    "direction of line 2 = ?": geometry.DirectionIs("line 2", None),
    "length of line 1 = 30": geometry.LengthIs("line 1", Decimal(30)),
    "radius of corner 1 = 3": geometry.RadiusIs("corner 1", Decimal(3)),
    "radius of corner 1 = radius of corner 2": geometry.EqualSizes("corner 1", "corner 2"),
    "Z of center of corner 2 = -50": geometry.PointIs("center", "corner 2", 0, Decimal(-50)),
    "X of V2 = 100": geometry.PointIs("", "V2", 1, Decimal(50)),
    "corner 2 meets line at 180": geometry.MeetsLine("corner 2", geometry.Meeting(None, Decimal(180))),
    "line 2 passes through (Z-40. X70.)": geometry.PassesThrough("line 2", (Decimal(-40), Decimal(35))),
    "radius of corner 1 = ?": geometry.RadiusIs("corner 1", None),
    "X of S = 40": geometry.PointIs("", "S", 1, Decimal(20)),
    "length of line 1 = 31": geometry.LengthIs("line 1", Decimal(31)),
    "length of line 2 = 20": geometry.LengthIs("line 2", Decimal(20)),
    "radius of line 2 = 4": geometry.RadiusIs("line 2", Decimal(4)),
    "line 2 passes beside [Z-40. X80.] at 5": geometry.PassesBeside("line 2", (Decimal(-40), Decimal(40)), Decimal(5)),
    "line 2 parallel to line 1": geometry.ParallelTo("line 2", "line 1", None),
    "line 2 parallel to line 1 at 10.5": geometry.ParallelTo("line 2", "line 1", Decimal("10.5")),
    "chord of corner 1 = 6": geometry.ChordIs("corner 1", Decimal(6)),
    "polar angle of corner 1 = 90": geometry.PolarAngleIs("corner 1", Decimal(90), "end"),
    "polar angle of begin of corner 1 = ?": geometry.PolarAngleIs("corner 1", None, "begin"),
    "angle from line 1 to line 2 = -60.5": geometry.TurnIs("line 1", "line 2", Decimal("-60.5")),
    "X of begin of corner 1 = 44": geometry.PointIs("begin", "corner 1", 1, Decimal(22)),
    "length of line 1 = length of line 2": geometry.EqualLengths("line 1", "line 2"),
    "line 1 tangent to line 2": geometry.Touches("line 1", "line 2"),
    "line 2 tangent to circle [Z-40. X120. R10.]": geometry.Touches(
        "line 2", geometry.CircleAt((Decimal(-40), Decimal(60)), Decimal(10))
    ),
    "corner 1 tangent to line [Z0. X30. A180.]": geometry.Touches(
        "corner 1", geometry.LineAt((Decimal(0), Decimal(15)), Decimal(180))
    ),
    "corner 2 meets next line": geometry.MeetsLine("corner 2", geometry.Meeting(None, None)),
    "corner 2 meets line to [Z-60. X130.]": geometry.MeetsLine(
        "corner 2", geometry.Meeting((Decimal(-60), Decimal(65)), None)
    ),
}


def essence(program: str, *facts: Any, start: str = START) -> dict[str, Any]:
    """The document without what tells where and in which words something was stated."""
    document = json.loads(to_json(solve(program, start=start, facts=facts)))
    (contour,) = document["contours"]
    asked = sorted((each["unit"], str(each["value"])) for each in contour.pop("asked"))
    for name in ("facts", "lines", "line", "diagnosis", "filled"):
        contour.pop(name)
    for solution in contour["solutions"]:
        solution["asked"] = sorted((each["unit"], str(each["value"])) for each in solution.get("asked", ()))
    codes = sorted((each["code"], each["severity"]) for each in document["diagnostics"])
    return {**contour, "asked": asked, "codes": codes}


@pytest.mark.parametrize(("block", "facts"), PROGRAMS)
def test_the_order_of_words_and_facts_does_not_matter(block: str, facts: tuple[str, ...]) -> None:
    expected = essence(block, *facts)
    code, *words = block.split()
    for order in permutations(facts):
        assert essence(" ".join((code, *reversed(words))), *order) == expected


@pytest.mark.parametrize(("block", "facts"), PROGRAMS)
def test_facts_mean_the_same_in_a_comment_apart_and_as_objects(block: str, facts: tuple[str, ...]) -> None:
    expected = essence(block, *facts)
    inside = [fact.replace("(", "[").replace(")", "]") for fact in facts]
    assert essence(f"{block} (contoursolve: {'; '.join(inside)})") == expected
    assert essence(block + "".join(f" (Contoursolve :{fact})" for fact in inside)) == expected
    assert essence(f"(contoursolve: {inside[0]}) {block}", *facts[1:]) == expected
    assert essence(block, *(STATEMENTS[fact] for fact in facts)) == expected
    assert essence(block, *(fact.upper() for fact in facts)) == expected


@pytest.mark.parametrize(("fact", "statement"), [*STATEMENTS.items()])
def test_a_statement_is_what_its_text_says(fact: str, statement: Any) -> None:
    elements, points = ("line 1", "line 2", "corner 1", "corner 2"), ("V1", "V2", "S")
    assert geometry.read_statement(fact, geometry.Vocabulary(elements, points, TURNED, geometry.Length.MM)) == statement


@pytest.mark.parametrize(("block", "facts"), PROGRAMS)
def test_a_shift_of_everything_shifts_the_contour(block: str, facts: tuple[str, ...]) -> None:
    """By 7 mm along Z and 6 mm of diameter along X; words and facts that state a place move with it."""

    def shifted(text: str) -> str:
        for axis, at, there in (("X of ", "100", "106"), ("X of ", "40", "46"), ("Z of ", "-30", "-23")):
            text = text.replace(f" = {at}", f" = {there}") if text.startswith(axis) else text
        text = text.replace("Z of center of corner 2 = -50", "Z of center of corner 2 = -43")
        return text.replace("X100.", "X106.").replace("Z-47.", "Z-40.").replace("Z-40. X70.", "Z-33. X76.")

    here, there = essence(block, *facts), essence(shifted(block), *map(shifted, facts), start="X46. Z7.")
    assert (there["status"], there["codes"]) == (here["status"], here["codes"])
    assert len(there["solutions"]) == len(here["solutions"])
    for mine, theirs in zip(here["solutions"], there["solutions"], strict=True):
        for one, other in zip(mine["elements"], theirs["elements"], strict=True):
            assert other["end"] == pytest.approx([one["end"][0] + 7, one["end"][1] + 3], abs=1e-9)
            assert one["kind"] == other["kind"]
            assert one.get("turn") == other.get("turn")


NAMES = "line 1", "line 2", "arc", "corner 1", "k"
VALUE = st.integers(-9_999_999, 9_999_999).map(lambda thousandths: Decimal(thousandths) * Decimal("0.0254"))
"""mm: with few digits in inches, too."""
NAME = st.sampled_from(NAMES)
GIVEN = st.builds(geometry.CircleAt, st.tuples(VALUE, VALUE), VALUE.map(abs)) | st.builds(
    geometry.LineAt, st.tuples(VALUE, VALUE), VALUE
)
ALL_STATEMENTS = st.one_of(
    st.builds(geometry.PassesBeside, NAME, st.tuples(VALUE, VALUE), VALUE),
    st.builds(geometry.PassesThrough, NAME, st.tuples(VALUE, VALUE)),
    st.builds(geometry.ParallelTo, NAME, NAME, st.none() | VALUE),
    *(
        st.builds(kind, NAME, st.none() | VALUE)
        for kind in (geometry.ChordIs, geometry.DirectionIs, geometry.LengthIs, geometry.RadiusIs, geometry.StraightIs)
    ),
    st.builds(geometry.PolarAngleIs, NAME, st.none() | VALUE, st.sampled_from(("begin", "end"))),
    st.builds(geometry.TurnIs, NAME, NAME, st.none() | VALUE),
    st.builds(
        geometry.PointIs, st.sampled_from(("", "begin", "end", "center")), NAME, st.integers(0, 1), st.none() | VALUE
    ),
    st.builds(geometry.EqualLengths, NAME, NAME),
    st.builds(geometry.EqualSizes, NAME, NAME),
    st.builds(geometry.Touches, NAME, NAME | GIVEN),
    st.builds(geometry.LiesOn, st.sampled_from(("begin", "end", "center")), NAME, NAME | GIVEN),
    st.builds(geometry.MeetsLine, NAME, st.builds(geometry.Meeting, st.none(), st.none() | VALUE)),
    st.builds(geometry.MeetsLine, NAME, st.builds(geometry.Meeting, st.tuples(VALUE, VALUE), st.none())),
)


@law(ALL_STATEMENTS, st.sampled_from(geometry.Length), st.booleans(), few=6, many=66)
def test_every_statement_is_written_as_a_text_that_reads_as_itself(
    statement: Any, unit: geometry.Length, turned: bool
) -> None:
    words = geometry.Vocabulary(NAMES, NAMES, TURNED if turned else MILLED, unit)
    text = geometry.write_statement(statement, words.plane, unit)
    assert geometry.read_statement(text, words) == statement


def test_statements_as_objects_are_shown_as_text() -> None:
    facts = [STATEMENTS["X of V2 = 100"], STATEMENTS["length of line 1 = 31"]]
    result = solve("G111 A180. K-30. B120.", start=START, facts=facts)
    assert [each.text for each in result.facts] == ["X of V2 = 100", "length of line 1 = 31"]
    assert "length of line 1 = 31 disagrees with" in result.diagnostics[0].message


STATING = ("A180.", "K-30.", "B120.", "X100.", "P5.")
STATED = (
    "length of line 1 = 30",
    "length of line 2 = 40",
    "length of line 1 = length of line 2",
    "distance from S to V2 = 60",
    "straight part of line 2 = 20",
    "angle between line 1 and line 2 = 60",
    "line 2 passes through [Z-40. X80.]",
    "X of V1 = 44",
)


EVERY = [
    (words, facts)
    for size in range(2, 6)
    for words in combinations(STATING, size)
    for facts in [*((each,) for each in STATED), *combinations(STATED[:6], 2)]
]


@pytest.mark.parametrize("part", range(30))
def test_whatever_has_a_closed_form_is_solved_by_it_and_nothing_else_is_said_to_have_one(part: int) -> None:
    seen: Counter[bool] = Counter()
    for words, stated in EVERY[part::30]:
        text = " ".join(("G111", *words, *(f"(contoursolve: {each})" for each in stated)))
        (answer,) = solve(text, start="X40. Z0.", rules="off", depth="verdict").answers
        system = geometry.assemble(answer.profile)
        if not analyse(system).is_determined:
            continue
        seen[is_closed(system)] += 1
        if is_closed(system):
            solution = solve_in_closed_form(answer.profile, is_proven=False)
            assert solution.points or solution.refusals
        else:
            with pytest.raises(NoClosedFormError):
                solve_in_closed_form(answer.profile, is_proven=False)
    assert seen.total() >= 3, seen
