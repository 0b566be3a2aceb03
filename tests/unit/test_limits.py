"""Every limit that is shown is one: what is shown works, and one increment more does not.

Findings say how large a corner may be beside its neighbours; ranges and the explorer say where a contour ends. Blocks
of every form are drawn with corners that fit, which are then made larger.
"""

import re
from decimal import Decimal
from random import Random
from typing import NamedTuple

import pytest
from click.testing import CliRunner
from examples import control_of
from generate_g111 import SHAPES, draw_g111
from generate_lx3 import random_g11, random_g112
from generate_nct import FORMS, random_chain, random_cornered, random_pair

from contoursolve import feasible, solve
from contoursolve.cli import main
from contoursolve.solving import RefusalKind

STEP = Decimal("0.001")
OF_CORNERS = (RefusalKind.CORNER_TOO_LARGE, RefusalKind.CORNERS_OVERLAP, RefusalKind.BEVEL_IN_BAND)
SHOWN = re.compile(r"at most ([0-9.]+) (mm|in)\b")


class Limit(NamedTuple):
    """The place of a word, the size of its corner that is shown as the largest, and the words beside which it is; 0
    where no room is left."""

    line: int
    columns: slice
    size: Decimal
    hides_others: bool
    """Whether other corners are looked at when this one is mended: a bevel that is nowhere leaves no path."""


def corners_blamed(text: str) -> tuple[list[Limit], set[tuple[int, int]], bool]:
    """The limits that findings about corners show, the places that they blame, and whether there is a contour."""
    (answer,) = solve(text, depth="verdict", control=control_of(text)).answers
    limits, places = [], set()
    for finding in answer.diagnostics:
        for label in finding.labels if finding.about in OF_CORNERS else ():
            found = SHOWN.match(label.text)
            if found or label.text.startswith("no room left") or not label.text:
                places.add((label.span.line, label.span.column))
            if found or label.text.startswith("no room left"):
                columns = slice(label.span.column - 1, label.span.end_column - 1)
                size, is_nowhere = Decimal(found[1] if found else 0), finding.about is RefusalKind.BEVEL_IN_BAND
                limits.append(Limit(label.span.line, columns, size, is_nowhere))
    return limits, places, answer.contour is not None


def with_size(text: str, limit: Limit, size: Decimal) -> str:
    """The program with another size of the corner; the sign of its word stays."""
    lines = text.split("\n")
    line = lines[limit.line - 1]
    word = line[limit.columns]
    address = word.rstrip("0123456789.")
    lines[limit.line - 1] = line[: limit.columns.start] + f"{address}{size}" + line[limit.columns.stop :]
    return "\n".join(lines)


def assert_limits_are_tight(text: str) -> int:
    """How many limits are shown, each of which is one."""
    limits, _, _ = corners_blamed(text)
    for limit in limits:
        place = limit.line, limit.columns.start + 1
        if limit.size:
            _, places, is_solved = corners_blamed(with_size(text, limit, limit.size))
            assert place not in places, (text, limit, "what is shown does not work")
            if len(limits) == 1:
                assert is_solved or (limit.hides_others and places), (text, limit, "what is shown makes no contour")
        _, places, is_solved = corners_blamed(with_size(text, limit, limit.size + STEP))
        assert not is_solved, (text, limit, "more than the limit works")
        assert place in places or not limit.size, (text, limit, "more than the limit is not refused")
    return len(limits)


def larger(rng: Random, text: str) -> str:
    """A program with the sizes of some corners made larger, to three decimals."""

    def grown(word: re.Match[str]) -> str:
        size = float(word[2]) * rng.choice((1, 1, 2, 5, rng.uniform(1, 20)))
        return f"{word[1]}{round(size, rng.choice((0, 1, 3))) or 1}"

    first, *rest = text.strip().split("\n")
    sizes = (
        r"(?<![A-Z,])([IK]-?)([0-9.]+)" if re.search(r"G1[12] |G01 ", text) else r"(?<![A-Z])(,[CR]|[CPDQ])([0-9.]+)"
    )
    return "\n".join([first, *(re.sub(sizes, grown, line) for line in rest)])


def g111(rng: Random) -> str:
    while True:
        shape = rng.choice(SHAPES)
        square = rng.random() < 0.3, rng.random() < 0.3
        case = draw_g111(rng, shape, rng.randrange(4), rng.choice((1, -1)), square)
        if case and (shape.corner1 or shape.corner2):
            return "\n".join(case.program)


def whole_g111(rng: Random) -> str:
    """Whole numbers, where lines are filled exactly."""
    x, angle, end = 2 * rng.randint(20, 50), rng.choice((90, 120, 135, 150)), rng.randint(1, 12)
    words = f"A180. K-{rng.randint(1, 30)}. B{angle}. X{x + 2 * end}."
    return (
        f"G00 X{x}. Z0.\nG111 {words} {rng.choice('CP')}{rng.randint(1, 20)}. {rng.choice('DQ')}{rng.randint(1, 20)}."
    )


def g112(rng: Random) -> str:
    drawn = random_g112(rng, rng.choice(("turning", "facing")), rng.choice("PC"), rng.choice(("Q", "D", "")))
    return drawn.text


def whole_mill(rng: Random) -> str:
    """Pockets and steps with whole numbers, arcs among them."""
    at, lines, along = [0, 0], ["G17 G90 G0 X0 Y0"], rng.randrange(2)
    for _ in range(rng.randint(2, 6)):
        way = rng.choice((-1, 1)) * rng.randint(2, 80)
        if rng.random() < 0.25:
            end = at[0] + way, at[1] + way
            lines.append(f"G{rng.choice((2, 3))} X{end[0]} Y{end[1]} R{abs(way)}")
            at = [*end]
        else:
            at[along] += way
            lines.append(f"G1 {'XY'[along]}{at[along]}")
            along = 1 - along
        lines[-1] += f" ,{rng.choice('CR')}{rng.randint(1, 40)}" if rng.random() < 0.8 else ""
    lines[-1] = lines[-1].partition(" ,")[0]
    return "\n".join(lines)


KINDS = {
    "G111": lambda rng: larger(rng, g111(rng)),
    "G111 in whole numbers": whole_g111,
    "G112": lambda rng: larger(rng, g112(rng)),
    "G11, G12": lambda rng: larger(rng, random_g11(rng).text),
    "pair": lambda rng: larger(rng, random_pair(rng, rng.choice(FORMS), 17, rng.choice("CR")).text),
    "chain": lambda rng: larger(rng, random_chain(rng, rng.randint(2, 4), 17, 0.9).text),
    "corners": lambda rng: larger(rng, random_cornered(rng, 17).text),
    "corners in whole numbers": whole_mill,
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(12))
def test_every_shown_limit_of_a_corner_works_and_one_increment_more_does_not(kind, seed):
    """Of blocks that are drawn until one shows a limit."""
    rng, shown = Random(f"{kind}{seed}"), 0
    while not shown:
        text = KINDS[kind](rng)
        if len(solve(text, depth="verdict", control=control_of(text)).answers) == 1:
            shown = assert_limits_are_tight(text)


LATHE = "G00 X60. Z0.\nG111 A180. K-30. B90. X66. {}"
MILL = "G17 G90 G0 X0 Y0\n{}"
ROOMS = {
    "each takes all": (LATHE.format("P3. D3."), {"P3.": "no room left beside D3.", "D3.": "no room left beside P3."}),
    "one takes all": (LATHE.format("P50. D3."), {"P50.": "no room left beside D3.", "D3.": "takes all the room"}),
    "something is left": (LATHE.format("P50. D2."), {"P50.": "at most 1.000 mm beside D2."}),
    "a corner takes all of the line after it": (
        MILL.format("G1 X80 ,R50 F100\nG1 Y50 ,C20\nG1 X0"),
        {",R50": "at most 30.000 mm beside ,C20 (program line 3)", ",C20": "no room left beside ,R50 (program line 2)"},
    ),
    "a pocket": (
        MILL.format("G1 Y50 ,C5\nX80 ,R60\nY0 ,C5\nX0"),
        {",R60": "at most 45.000 mm beside ,C5 (program line 4)"},
    ),
    "the chord of an arc": (
        "G17 G90 G0 X200 Y200\nG1 X0 Y31.983 ,C70\nG3 X31.983 Y0 R-31.983",
        {",C70": "at most 63.965 mm"},
    ),
    "inches": ("G20\n" + LATHE.format("P50. D2.9999"), {"P50.": "at most 0.0001 in beside D2.9999"}),
}


@pytest.mark.parametrize("name", ROOMS)
def test_a_corner_is_told_what_its_neighbours_leave_for_it(name):
    text, expected = ROOMS[name]
    lines = text.split("\n")
    (answer,) = solve(text, control=control_of(text)).answers
    labels = [label for finding in answer.diagnostics for label in finding.labels]
    words = [lines[each.span.line - 1][each.span.column - 1 : each.span.end_column - 1] for each in labels]
    assert dict(zip(words, (each.text for each in labels), strict=True)) == expected
    assert "at most 3.000" not in " ".join(each.message + each.help for each in answer.diagnostics)
    if not text.startswith("G20"):
        assert assert_limits_are_tight(text) > 0


FIRST = {
    "G111": (LATHE.format("P4."), ["P3."]),
    "beside another": (LATHE.format("P50. D2."), ["P1.", "delete P50."]),
    "G11": ("G00 X30. Z0.\nG11 Z-5. I-8.", ["I-5."]),
    "G112": ("G00 X100. Z-50.\nG112 U0 I10. K-50. P60. Q5. R30.", ["P6."]),
    "a bevel on an arc": ("G00 X440. Z30.\nG112 X396. I26. K-126. R75. C45.", ["C4.5"]),
    "a pocket": (ROOMS["a pocket"][0], [",R6"]),
    "an overlap": (ROOMS["a corner takes all of the line after it"][0], [",R5"]),
}


@pytest.mark.parametrize("name", FIRST)
def test_a_corner_that_does_not_fit_gets_the_size_first_that_was_meant_or_the_largest(name):
    text, expected = FIRST[name]
    fixes = [fix.description for finding in solve(text, control=control_of(text)).diagnostics for fix in finding.fixes]
    for told, meant in zip(fixes, expected, strict=False):
        assert told.startswith((f"write {meant} for", meant)), fixes


def test_corners_that_leave_each_other_no_room_are_made_smaller_together():
    (finding,) = solve(LATHE.format("P3. D3.")).diagnostics
    assert finding.help == "delete P3., or delete D3., or write at most 1.500 mm for both"
    assert "G111 A180. K-30. B90. X66. P1.5 D1.5" in [fix.replacement for fix in finding.fixes]


# Ranges -----------------------------------------------------------------------------------------------------

END = re.compile(r"at (?:most|least) (-?[0-9.]+) (?:mm|in|deg)$")


def with_value(text: str, word: str, value: Decimal) -> str:
    """The program with another value of a word, which is named by its line and its address."""
    line, _, address = word.partition(":")
    lines = text.split("\n")
    lines[int(line) - 1] = re.sub(rf"(?<![A-Z,]){address}-?[0-9.]+", f"{address}{value}", lines[int(line) - 1])
    return "\n".join(lines)


def has_contour(text: str) -> bool:
    answers = solve(text, depth="verdict", control=control_of(text)).answers
    return len(answers) == 1 and answers[0].contour is not None


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(8))
def test_every_shown_end_of_a_range_works_and_one_increment_more_does_not(kind, seed):
    """Of a word each of random blocks."""
    rng, shown = Random(f"{kind}{seed}"), 0
    for _ in range(20):
        text = KINDS[kind](rng).strip()
        lines = text.split("\n")
        line = rng.randrange(1, len(lines))
        word = f"{line + 1}:{rng.choice(re.findall(r'(,?[A-FH-Z])-?[0-9.]+', lines[line]) or 'X')}"
        try:
            ranges = feasible(text, word)
        except ValueError:  # words that choose, and programs that show no control
            continue
        for each in ranges.intervals:
            for end, way in ((each.low, -1), (each.high, 1)):
                told = END.search(end.reason.text) if end.reason else None
                # Beside lines that are parallel, points are too far away for numbers.
                if told is None or "parallel" in end.reason.text:
                    continue
                value, beyond = Decimal(told[1]), Decimal(told[1]) + way * STEP
                if each.high.value - each.low.value > 2 * STEP:
                    assert has_contour(with_value(text, word, value)), (text, word, end)
                assert float(beyond) not in each, (text, word, end)
                if float(beyond) not in ranges:
                    assert not has_contour(with_value(text, word, beyond)), (text, word, end)
                shown += 1
        if shown:
            break


@pytest.mark.parametrize(
    ("unit", "step"),
    [pytest.param(*each, marks=pytest.mark.boundary) for each in (("mm", STEP), ("inch", Decimal("0.0001")))],
)
def test_the_command_shows_ends_that_work(unit, step):
    block, start = "G111 X4. A180. K-1.2 B119.3 P.2", "X2. Z0."
    arguments = ["range", "--block", block, "--start", start, "--units", unit, "--word", "P"]
    output = CliRunner().invoke(main, arguments).output
    for shown in re.search(r"to +([0-9.]+) (?:mm|in) .*: P at most ([0-9.]+) (?:mm|in)", output).groups():
        works = [
            solve(block.replace("P.2", f"P{size}"), start=start, units=unit).answers[0].contour is not None
            for size in (Decimal(shown), Decimal(shown) + step)
        ]
        assert works == [True, False]
