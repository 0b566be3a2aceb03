"""NCT chapter 16: every form, corners and chains, held against drawings and against closed forms of their own.

Programs are written from paths that were drawn first; `disturbed` ones mean something that nobody drew, and are held
against the oracle's verdict. Set MILL_INSTANCES to draw so many of each form in the slow tests (default 15).
"""

import json
import os
import re
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from decimal import Decimal
from itertools import islice, product
from math import asin, atan2, degrees, hypot
from random import Random
from typing import Any

import pytest
from generate_nct import FORMS, Drawn, disturbed, random_chain, random_cornered, random_pair
from oracle import PLANES
from oracle_corners import miss
from oracle_nct import Run, runs

from contoursolve import Result, check, solve
from contoursolve.controls import CONTROLS
from contoursolve.diagnostics.finding import Applicability, Severity
from contoursolve.output.document import to_json

CLOSE = 1e-8
"""mm. Words have 12 decimals, and points of a chain build on each other."""

MANY = int(os.environ.get("MILL_INSTANCES", "15"))
COUNTS = (6, pytest.param(MANY, marks=pytest.mark.slow))
"""Instances of each form."""

CHAINS = (1, 2, 3, 5, 8, 12, 19)
"""Blocks."""


def answers_of(result: Result) -> list[dict[str, Any]]:
    """The contours in JSON."""
    contours: list[dict[str, Any]] = json.loads(to_json(result))["contours"]
    return contours


def solve_mill(program: Sequence[str], rules: str = "enforce", depth: str = "verdict") -> Result:
    return solve("\n".join(program), control="nct-99m", rules=rules, depth=depth)


# Drawings -----------------------------------------------------------------------------------------------


def assert_drawn(drawn: Drawn) -> None:
    (contour,) = answers_of(solve_mill(drawn.program))
    assert contour["status"] == "solved", drawn.text
    assert contour["certificate"]["kind"] in ("exact", "unique"), drawn.text
    assert miss(drawn.elements, drawn.points, contour) < CLOSE, drawn.text


@pytest.mark.parametrize(("form", "corner"), tuple(product(FORMS, ("", "C", "R"))))
@pytest.mark.parametrize("instances", COUNTS)
def test_every_drawn_pair_is_found_again(form, corner, instances):
    rng = Random(f"{form}{corner}")
    kinds: Counter[str] = Counter()
    for number in range(instances):
        drawn = random_pair(rng, form, tuple(PLANES)[number % 3], corner)
        assert_drawn(drawn)
        kinds.update((drawn.elements[0].turn, drawn.elements[-1].turn, "Q-" if "Q-" in drawn.text else "Q+"))
    assert min(kinds[side] for side in ("Q-", "Q+")) > instances // 7 or form == "line-line"
    assert min(kinds[turn] for turn in ("cw", "ccw")) > instances // 7 or form == "line-line"


@pytest.mark.parametrize("plane", PLANES)
@pytest.mark.parametrize("instances", COUNTS)
def test_every_drawn_path_with_corners_is_found_again(plane, instances):
    rng = Random(plane)
    for _ in range(2 * instances):
        assert_drawn(random_cornered(rng, plane))


@pytest.mark.parametrize(
    ("blocks", "instances"),
    [(1, 4), (2, 4), (6, 1), *(pytest.param(each, MANY, marks=pytest.mark.slow) for each in CHAINS)],
)
def test_every_drawn_chain_is_found_again(blocks, instances):
    rng = Random(blocks)
    for _ in range(1 + instances // blocks // 2):
        for plane in PLANES:
            assert_drawn(random_chain(rng, blocks, plane))


# What nobody drew ---------------------------------------------------------------------------------------


def draw_any(rng: Random) -> Drawn:
    plane = rng.choice(tuple(PLANES))
    match rng.randrange(3):
        case 0:
            return random_pair(rng, rng.choice(FORMS), plane, rng.choice(("", "C", "R")))
        case 1:
            return random_chain(rng, rng.randint(1, 4), plane, corners=0.2)
        case _:
            return random_cornered(rng, plane)


def compare(program: Sequence[str], expected: Run) -> str:
    """The status that both agree on; empty where the oracle does not judge."""
    if expected.is_near:
        return ""
    result = solve_mill(program)
    (contour,) = answers_of(result)
    text = "\n".join(program)
    if {each.code for each in result.diagnostics} & {"nct-corner-reverses", "nct-no-corner"}:
        return ""  # a chamfer where a path goes straight on, or turns back: the sheet says nothing of it
    if (contour["status"], expected.status) == ("conflicting", "no-solution"):
        return ""  # both may hold, of two blocks; a conflict goes first, and the oracle ends at what it meets first
    assert contour["status"] == expected.status, text
    if expected.status == "solved":
        size = max(abs(at) for at in (*expected.points.values(), expected.end, 1e3))
        # A line that ends where it begins is left out.
        gap = miss(expected.elements, expected.points, contour) if expected.elements else len(contour["elements"])
        # Where an arc's end is off its circle by what the control allows, corners may be cut from it in two ways.
        is_off = any(each.code == "nct-radius-differs" for each in result.diagnostics)
        assert gap < (0.01 if is_off else CLOSE * size / 1e3), text
    return expected.status


@pytest.mark.slow
@pytest.mark.parametrize("instances", COUNTS)
def test_blocks_that_nobody_drew_are_solved_or_refused_as_the_sheet_says(instances):
    rng = Random(1600)
    statuses: Counter[str] = Counter()
    for _ in range(12 * instances):
        program = disturbed(rng, draw_any(rng))
        (expected,) = runs(program)
        statuses[compare(program, expected)] += 1
    assert statuses[""] < 0.03 * statuses.total()
    assert min(statuses[status] for status in ("solved", "no-solution", "conflicting", "rejected")) > instances // 4


def subsets() -> Iterator[tuple[str, list[str]]]:
    """Every set of the optional words of every form's sample."""
    optional = re.compile(r"\{([^}]*)\}")
    for form in CONTROLS["nct-99m"].forms:
        texts = [word for block in form.table.sample.blocks for word in optional.findall(block)]
        for kept in product((True, False), repeat=len(texts)):
            keep = iter(kept)
            blocks = [
                optional.sub(lambda word, keep=keep: word[1] if next(keep) else "", b) for b in form.table.sample.blocks
            ]
            yield form.name, [form.table.sample.before, *blocks]


@pytest.mark.parametrize("rules", ["enforce", "off"])
@pytest.mark.parametrize("stride", [37, pytest.param(3, marks=pytest.mark.slow)])
def test_every_set_of_words_of_a_form_gets_a_status(rules, stride):
    for name, program in islice(subsets(), 0, None, stride):
        result = solve_mill(program, rules)
        assert result.answers or result.has_errors, program
        for answer in result.answers:
            assert (answer.contour is None) == result.has_errors, (name, program)


# Ordinary arcs --------------------------------------------------------------------------------------------

AT = "G17 G90 G0 X0 Y0 Z0"


@pytest.mark.parametrize(
    ("block", "codes"),
    [
        ("G2 X30 Y2 I15 J0", {"arc-radii-differ"}),
        ("G2 X30 Y5 I15 J0 Z-5", {"arc-radii-differ"}),
        ("G2 X30 R14.9", {"arc-radius-small"}),
        ("G2 X30 R14.9995", set()),
        ("G2 X30 R14.988", {"arc-radius-small"}),
        ("G2 X30 I15 K0", {"arc-outside-plane"}),
        ("G2 R15", {"arc-full-by-radius"}),
        ("G2 X30", {"arc-undefined"}),
        ("G2 X0 Y0 R15", {"arc-full-by-radius"}),
        ("G2 X30 I15 ,A30", {"nct-angle-on-arc"}),
        ("G2 X30 R15", set()),
        ("G2 X30 I15 Z-5", set()),
        ("G2 I15", set()),
        ("G2 X0 Y0 I15", set()),
        ("G91 G2 X0 Y0 I15", set()),
        ("G2 X#1 Y2 I15", set()),
    ],
)
def test_an_ordinary_arc_is_checked_and_not_listed(block, codes):
    found = check("\n".join((AT, block)), control="nct-99m")
    assert {each.code for each in found if each.severity.value == "error"} == codes
    assert solve_mill((AT, block)).answers == ()


def test_an_arc_from_an_unknown_point_says_nothing():
    assert {each.code for each in check("G17 G90\nG2 X30 Y5 I15 J0", control="nct-99m")} == {"no-contour"}


# Chains that are wrong ------------------------------------------------------------------------------------


def spoil(program: Sequence[str], kind: str) -> tuple[list[str], int]:
    """A program with one mistake in the middle of its chain, and the line that has it."""
    lines = list(program)
    for index in range(len(lines) // 2, len(lines)):
        if kind == "no Q" and "Q" in lines[index] and ",A" in lines[index]:
            lines[index] = re.sub(r"Q\S+", "", lines[index])
        elif kind == "Q0" and "Q" in lines[index]:
            lines[index] = re.sub(r"Q\S+", "Q0", lines[index])
        elif kind == "off its circle" and "Q" in lines[index] and "I" in lines[index]:
            lines[index] = re.sub(r"X\S+", "X500", lines[index])
        elif kind == "corner twice" and ",C" not in lines[index] and ",R" not in lines[index]:
            lines[index] += " ,C1 ,R1"
        else:
            continue
        break
    return lines, index + 1


@pytest.mark.parametrize(
    ("kind", "code"),
    [
        ("no Q", "nct-q-missing"),
        ("Q0", "nct-q-zero"),
        ("off its circle", "nct-radius-difference"),
        ("corner twice", "nct-two-corners"),
    ],
)
@pytest.mark.parametrize("blocks", [7, pytest.param(13, marks=pytest.mark.slow)])
def test_a_mistake_in_a_long_chain_is_found_in_its_block_and_soon(kind, code, blocks):
    drawn = random_chain(Random(0), blocks, 17, corners=0)
    program, line = spoil(drawn.program, kind)
    began = time.process_time()
    result = solve_mill(program, depth="full")
    assert time.process_time() - began < 60  # a chain of 20 whose alternatives were all listed took minutes
    finding = next(each for each in result.diagnostics if each.code == code)
    assert line in {finding.span.line, *(label.span.line for label in finding.labels)}
    assert len(finding.fixes) < 10


@pytest.mark.slow
def test_lines_of_a_chain_that_are_parallel_are_shown_in_both_of_their_blocks():
    (answer,) = solve_mill(
        ("G17 G90 G41 G0 X90 Y10", "G1 ,A150", "X10 Y20 ,A225", "X10 Y80 ,A225"), depth="full"
    ).answers
    assert answer.status.value == "no-solution"
    assert {label.span.line for label in answer.diagnostics[0].labels} >= {3, 4}


def test_an_angle_that_is_asked_for_beside_a_point_is_answered() -> None:
    program = "G17 G90 G42 G0 X100 Y20\nG1 ,A?\nG3 X20 Y40 I20 J-10 R50 Q-1 (contoursolve: line tangent to arc)"
    (answer,) = solve(program, control="nct-99m").answers
    (asked,) = answer.asked
    to_center, away = degrees(atan2(-30, -80)) % 360, degrees(asin(50 / hypot(80, 30)))
    assert asked.value == pytest.approx(to_center - away, abs=1e-9)


@pytest.mark.parametrize(
    ("text", "code", "fixed"),
    [
        ("G1 X30 ,C10\nX40 Y40 C4\nX80", "address-unknown", "G1 X30 ,C10\nX40 Y40 ,C4"),
        ("G1 X30 ,C10\nX40 Y40 R5\nX80", "nct-center-on-line", "G1 X30 ,C10\nX40 Y40 ,R5"),
        ("G1 X30 ,C10\nX40 A30", "address-unknown", "G1 X30 ,C10\nX40 ,A30"),
        ("G1 X30 C10\nX40 Y40 ,R5\nX80", "nct-comma-missing", "G1 X30 ,C10"),
    ],
)
def test_a_forgotten_comma_is_told_and_written_first(text, code, fixed):
    (finding,) = solve("G17 G90 G0 X0 Y0\n" + text, control="nct-99m").diagnostics
    assert finding.code == code
    assert finding.fixes[0].replacement == fixed


def test_what_is_told_of_an_arc_off_its_centre_and_of_a_word_beside_the_plane():
    text = "G17 G90 G42 G0 X50 Y0\n{}\nG1 X-50 Y42.857{} ,A171.87 Q-1"
    (arc,) = solve(text.format("G3 X-50 Y2 I-50 J0", ""), control="nct-99m").diagnostics
    assert "50.000 mm" in arc.message
    assert "50.040 mm" in arc.message
    assert not any("tied" in note for note in arc.notes)
    (beside,) = solve(text.format("G3 X-50 Y0 R50", " Z-5"), control="nct-99m").diagnostics
    assert "safe" not in {fix.applicability.value for fix in beside.fixes}


@pytest.mark.parametrize(("angle", "within"), [("405", "45"), ("-675", "-315"), ("360.5", ".5"), ("-360.5", "-.5")])
def test_an_angle_of_more_than_a_turn_is_solved_as_one_within_a_turn_and_told(angle, within):
    before = "G17 G90 G0 X0 Y0\nG1 X30 ,A"
    (turned,), (same,) = (solve(before + text).answers for text in (angle, within))
    assert turned.contour.end == pytest.approx(same.contour.end)
    (finding,) = turned.diagnostics
    assert (finding.code, finding.severity, finding.source.evidence.value) == (
        "nct-angle-range",
        Severity.WARNING,
        "assumed",
    )
    assert same.diagnostics == ()
    (safe,) = [each for each in finding.fixes if each.applicability is Applicability.SAFE]
    assert Decimal(safe.replacement.partition(",A")[2]) == Decimal(within)
    assert safe in finding.fixes[:3]  # slips that explain the number come first
    for edge in ("360", "-360"):
        assert solve(before + edge).diagnostics == ()
