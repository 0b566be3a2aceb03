"""YASNAC LX3 G111 by its sheet (Instruction Manual, 2.8.30): the words of the two lines, and further facts.

Points count from the start point: real is Z, imaginary is X as radius.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from math import radians, sqrt

from contoursolve.model import FIRST, SECOND
from contoursolve.statements import MeetsLine
from contoursolve.tolerance import RESIDUAL
from contoursolve.verification.asked import check_asked
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedStatus, Rules
from contoursolve.verification.determination import check_statements
from contoursolve.verification.drawing import Drawing
from contoursolve.verification.facts import Sight, statements
from contoursolve.verification.g111_corners import check_elements
from contoursolve.verification.g111_drawing import Lines, Meeting, Sizes, Slots, draw, drawn
from contoursolve.verification.ledger import Ledger, fewest
from contoursolve.verification.measure import angle_between, cross, direction, dot, unit
from contoursolve.verification.quantity import Quantity
from contoursolve.verification.statement import Statement, displacement

LINE_1, LINE_2 = ("A", "I", "K"), ("B", "X", "U", "Z", "W")
END_X, END_Z = ("X", "U"), ("Z", "W")
UNKNOWNS = 4
"""Z and X of V1, Z and X of V2."""

_SIZES = ("C", "P", "D", "Q")

READ = frozenset((*LINE_1, *LINE_2, *_SIZES))


def check(case: Case, ledger: Ledger) -> None:
    """Everything that the words and facts of the block say about the path.

    Where the result does not say under which rules it was made, a contour that is claimed overdetermined may have
    been solved with the notes of the manual or without them.
    """
    names = ", ".join(sorted(map(ascii, case.points))) or "none"
    if not ledger.require(
        "the points are V1 and V2", (), case.points.keys() == {"V1", "V2"}, f"the result has {names}"
    ):
        ledger.omit("the words of the block", "they are about V1 and V2")
        return
    ledger.require("there is no choice of branch", (), case.claimed.branch is None and not case.claimed.branches)
    ignored = ignored_words(case)
    readings = [ignored]
    if case.rules is None and ignored and case.claimed.status is ClaimedStatus.OVERDETERMINED:
        readings = [{}, ignored] if case.is_extended else [{}]
    ledger.add(fewest(partial(_reading, case, each) for each in readings))


def ignored_words(case: Case) -> dict[str, str]:
    """The words that the control ignores (p. 140, v and vi), and why; none where the result was made
    without the rules of the manual."""
    if case.rules is Rules.OFF:
        return {}
    stated = set(case.states(*LINE_1, *LINE_2))
    ignored: dict[str, str] = {}
    has_whole_end = bool(stated & set(END_X)) and bool(stated & set(END_Z))
    if stated >= {"A", "I", "K"}:
        ignored["A"] = "the control ignores it, because I and K are given, too (2.8.30, note v)"
    if "B" in stated and has_whole_end and len(stated & set(LINE_1)) > 1:
        ignored["B"] = "the control ignores it, because X(U), Z(W) and line 1 are given (2.8.30, note vi)"
    return ignored


def _reading(case: Case, ignored: dict[str, str]) -> Ledger:
    """The checks of a contour that was solved without these words."""
    ledger = Ledger()
    for name, why in ignored.items():
        ledger.omit(" ".join(case.texts(name)), why)
    used = tuple(name for name in case.states(*LINE_1, *LINE_2) if name not in ignored)
    lines = _lines(case, used, (case.points["V1"], case.points["V2"]))
    elements, no_sizes = Ledger(), [0.0 for name in _SIZES if name in case.asked]
    found = check_elements(case, elements, lines)
    if found is None:
        check_statements(case, ledger, list(_statements(case, used, lines)), [*_coordinates(lines), *no_sizes])
    else:
        slots, sizes = found
        sight = _sight(case, used, lines, slots, sizes)
        stated = [*_statements(case, used, lines), *statements(case.facts, sight, ledger)]
        check_statements(case, ledger, stated, sight.unknowns)
        check_asked(case, ledger, _values(case, lines, sizes), sight.claimed)
    _check_senses(case, ledger, used, lines)
    ledger.add(elements)
    return ledger


def _sight(case: Case, used: tuple[str, ...], lines: Lines, slots: Slots, sizes: Sizes) -> Sight:
    """The unknowns are Z and X of V1 and V2, and the sizes that are asked for."""
    open_sizes = [name for name in sizes if name in case.asked]

    def redraw(at: Sequence[float]) -> Drawing:
        first, second = complex(at[0], at[1]), complex(at[2], at[3])
        changed = sizes | dict(zip(open_sizes, at[UNKNOWNS:], strict=True))
        return draw(_lines(case, used, (first, second)), {name: size for name, size in changed.items() if size})

    unknowns = (*_coordinates(lines), *(sizes[name] for name in open_sizes))
    return Sight(drawn(lines, slots, sizes), unknowns, redraw, case.origin, case.reach)


def _coordinates(lines: Lines) -> tuple[float, ...]:
    return lines.v1.real, lines.v1.imag, lines.v2.real, lines.v2.imag


def _values(case: Case, lines: Lines, sizes: Sizes) -> dict[str, Quantity]:
    """What every word that may be asked for would have to say."""
    z, x = (float(value) for value in case.origin)
    return {
        "A": Quantity(angle_between(1, lines.first), is_angle=True, reach=abs(lines.v1)),
        "I": Quantity(lines.v1.imag),
        "K": Quantity(lines.v1.real),
        "B": Quantity(angle_between(1, lines.second), is_angle=True, reach=abs(lines.v2 - lines.v1)),
        "X": Quantity(lines.v2.imag + x),
        "U": Quantity(lines.v2.imag),
        "Z": Quantity(lines.v2.real + z),
        "W": Quantity(lines.v2.real),
        **{name: Quantity(size) for name, size in sizes.items()},
    }


def redo(case: Case) -> Drawing | None:
    """The contour of the words alone, near the claimed one; None if they do not fix it."""
    used = tuple(name for name in case.states(*LINE_1, *LINE_2) if name not in ignored_words(case))
    # A result that lacks a point is redone from the start: what the words say is linear.
    lines = _lines(case, used, (case.points.get("V1", 0j), case.points.get("V2", 0j)))
    stated = list(_statements(case, used, lines))
    moved = displacement(stated, UNKNOWNS)
    if moved.rank < UNKNOWNS:
        return None
    return drawn_at(case, used, lines.v1 - complex(*moved.moves[:2]), lines.v2 - complex(*moved.moves[2:]))


def drawn_at(case: Case, used: tuple[str, ...], v1: complex, v2: complex) -> Drawing:
    """The drawing with V1 and V2 there. Raises UnmeasurableError for a corner that does not exist."""
    sizes = {name: case.amount(name) for name in case.states(*_SIZES) if case.value(name)}
    return draw(_lines(case, used, (v1, v2)), sizes)


def _lines(case: Case, used: tuple[str, ...], points: tuple[complex, complex]) -> Lines:
    """The lines between these points, in the directions of the words; corner 2 lands parallel to Z at a programmed
    X, and parallel to X at a programmed Z, unless a fact says which line it meets."""
    v1, v2 = points
    bevel = next((each.value for each in case.claim.conventions if each.setting.name == "bevel"), "")
    by_x, by_z = (bool(set(used) & set(ends)) for ends in (END_X, END_Z))
    return Lines(
        v1=v1,
        v2=v2,
        first=direction(case.value("A")) if "A" in used else unit(v1),
        second=direction(case.value("B")) if "B" in used else unit(v2 - v1),
        landing=None if by_x == by_z else complex(1, 0) if by_x else complex(0, 1),
        zero=0.0 if "A" in used or not v1 else case.limit / abs(v1),
        meeting=_meeting(case, v2),
        is_setback=bevel == "setback",
        share=sqrt(0.5) if bevel == "length" else 1.0,
    )


def _meeting(case: Case, v2: complex) -> Meeting | None:
    """The line that corner 2 meets by a fact, from V2."""
    for each in case.facts:
        if isinstance(each.fact, MeetsLine):
            to, angle = each.fact.line.to, each.fact.line.angle
            if angle is not None:
                return Meeting(direction(angle), None, each.label)
            end = case.next_end if to is None else case.place(to)
            if end is not None:
                return Meeting(unit(end - v2), abs(end - v2), each.label)
    return None


def _statements(case: Case, used: tuple[str, ...], lines: Lines) -> Iterator[Statement]:
    """What each word says about Z and X of V1 and V2; sizes that are asked for change nothing of it."""
    v1, v2 = lines.v1, lines.v2
    for each in statements_at(case, used, v1, v2):
        yield replace(each, gradient=(*each.gradient, *(0.0 for name in _SIZES if name in case.asked)))


def statements_at(case: Case, used: tuple[str, ...], v1: complex, v2: complex) -> Iterator[Statement]:
    """What each word says about Z and X of V1 and V2 there."""
    for name in used:
        (word,) = case.texts(name)
        yield replace(_stated(case, name, word, v1, v2), allowed=_allowed(case, name, v1 if name == "A" else v2 - v1))


def _allowed(case: Case, name: str, run: complex) -> float:
    """How far the word may miss what others say, mm: it is exact to half its increment, and so is every coordinate."""
    own, z, x = case.increment(name), case.increment("0"), case.increment("1")
    if name in "AB":
        u = direction(case.value(name))
        reach = 2 * (abs(u.imag) * z + abs(u.real) * x) + abs(run) * radians(own)
    else:
        reach = own + (1 if name in "XZ" else 2) * (z if name in "KZW" else x)
    return reach / 2 + RESIDUAL


def _stated(case: Case, name: str, word: str, v1: complex, v2: complex) -> Statement:
    """What one word says."""
    match name:
        case "A":
            u = direction(case.value(name))
            off = cross(u, v1)
            return Statement("V1 lies on line 1", word, (-u.imag, u.real, 0, 0), off, angle_between(u, v1))
        case "I":
            return Statement("X of V1 from the start", word, (0, 1, 0, 0), v1.imag - case.amount(name))
        case "K":
            return Statement("Z of V1 from the start", word, (1, 0, 0, 0), v1.real - case.amount(name))
        case "B":
            u, run = direction(case.value(name)), v2 - v1
            slope = (u.imag, -u.real, -u.imag, u.real)
            return Statement("V2 lies on line 2", word, slope, cross(u, run), angle_between(u, run))
        case "X":
            return Statement("X of V2", word, (0, 0, 0, 1), v2.imag - case.coordinate(name, SECOND))
        case "U":
            return Statement("X of V2 from the start", word, (0, 0, 0, 1), v2.imag - case.amount(name))
        case "Z":
            return Statement("Z of V2", word, (0, 0, 1, 0), v2.real - case.coordinate(name, FIRST))
        case _:
            return Statement("Z of V2 from the start", word, (0, 0, 1, 0), v2.real - case.amount(name))


def _check_senses(case: Case, ledger: Ledger, used: tuple[str, ...], lines: Lines) -> None:
    """A and B are directions of travel: 180 degrees off is wrong (p. 146: moves away)."""
    for name, along, run in (("A", lines.first, lines.v1), ("B", lines.second, lines.v2 - lines.v1)):
        if name in used:
            number = "1" if name == "A" else "2"
            against = max(0.0, -dot(along, run))
            ledger.measure(f"line {number} does not run against its angle", case.texts(name), against, case.limit)
