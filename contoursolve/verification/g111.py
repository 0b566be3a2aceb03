"""YASNAC LX3 G111 by its sheet (Instruction Manual, 2.8.30): the words of the two lines.

Points count from the start point: real is Z, imaginary is X as radius.
"""

from collections.abc import Iterator

from contoursolve.model import FIRST, SECOND
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedStatus
from contoursolve.verification.g111_corners import Lines, check_elements
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import angle_between, cross, direction, dot, unit
from contoursolve.verification.statement import Statement, check_statements

LINE_1, LINE_2 = ("A", "I", "K"), ("B", "X", "U", "Z", "W")
END_X, END_Z = ("X", "U"), ("Z", "W")
UNKNOWNS = 4
"""Z and X of V1, Z and X of V2."""

READ = frozenset((*LINE_1, *LINE_2, "C", "P", "D", "Q"))


def check(case: Case, ledger: Ledger) -> None:
    """Everything that the words of the block say about the path."""
    names = ", ".join(sorted(map(ascii, case.points))) or "none"
    if not ledger.require("the points are V1 and V2", (), case.points.keys() == {"V1", "V2"}, names):
        ledger.omit("the words of the block", "they are about V1 and V2")
        return
    ledger.require("there is no choice of branch", (), case.claimed.branch is None, f"{case.claimed.branch!a}")
    used = _used(case, ledger)
    lines = _lines(case, used)
    check_statements(case, ledger, list(_statements(case, used)), UNKNOWNS)
    _check_senses(case, ledger, used, lines)
    check_elements(case, ledger, lines)


def _used(case: Case, ledger: Ledger) -> tuple[str, ...]:
    """The words of both lines without those that the control ignores (supplementary notes v and vi).

    A contour that is claimed overdetermined was solved without these notes: all words count.
    """
    stated = case.states(*LINE_1, *LINE_2)
    if case.claimed.status is ClaimedStatus.OVERDETERMINED:
        return stated
    ignored: dict[str, str] = {}
    has_whole_end = bool(set(stated) & set(END_X)) and bool(set(stated) & set(END_Z))
    if set(stated) >= {"A", "I", "K"}:
        ignored["A"] = "the control ignores it, because I and K are given, too (2.8.30, note v)"
    if "B" in stated and has_whole_end and len(set(stated) & set(LINE_1)) > 1:
        ignored["B"] = "the control ignores it, because X(U), Z(W) and line 1 are given (2.8.30, note vi)"
    for name, why in ignored.items():
        ledger.omit(" ".join(case.texts(name)), why)
    return tuple(name for name in stated if name not in ignored)


def _lines(case: Case, used: tuple[str, ...]) -> Lines:
    """The lines of the claimed points, in the directions of the words; corner 2 lands parallel to Z at a
    programmed X, and parallel to X at a programmed Z."""
    v1, v2 = case.points["V1"], case.points["V2"]
    by_x, by_z = (bool(set(used) & set(ends)) for ends in (END_X, END_Z))
    return Lines(
        v1=v1,
        v2=v2,
        first=direction(case.value("A")) if "A" in used else unit(v1),
        second=direction(case.value("B")) if "B" in used else unit(v2 - v1),
        landing=None if by_x == by_z else complex(1, 0) if by_x else complex(0, 1),
        zero=0.0 if "A" in used or not v1 else case.limit / abs(v1),
    )


def _statements(case: Case, used: tuple[str, ...]) -> Iterator[Statement]:
    """What each word says about Z and X of V1 and V2."""
    v1, v2 = case.points["V1"], case.points["V2"]
    for name in used:
        (word,) = case.texts(name)
        match name:
            case "A":
                u = direction(case.value(name))
                off = cross(u, v1)
                yield Statement("V1 lies on line 1", word, (-u.imag, u.real, 0, 0), off, angle_between(u, v1))
            case "I":
                yield Statement("X of V1 from the start", word, (0, 1, 0, 0), v1.imag - case.amount(name))
            case "K":
                yield Statement("Z of V1 from the start", word, (1, 0, 0, 0), v1.real - case.amount(name))
            case "B":
                u, run = direction(case.value(name)), v2 - v1
                slope = (u.imag, -u.real, -u.imag, u.real)
                yield Statement("V2 lies on line 2", word, slope, cross(u, run), angle_between(u, run))
            case "X":
                yield Statement("X of V2", word, (0, 0, 0, 1), v2.imag - case.coordinate(name, SECOND))
            case "U":
                yield Statement("X of V2 from the start", word, (0, 0, 0, 1), v2.imag - case.amount(name))
            case "Z":
                yield Statement("Z of V2", word, (0, 0, 1, 0), v2.real - case.coordinate(name, FIRST))
            case _:
                yield Statement("Z of V2 from the start", word, (0, 0, 1, 0), v2.real - case.amount(name))


def _check_senses(case: Case, ledger: Ledger, used: tuple[str, ...], lines: Lines) -> None:
    """A and B are directions of travel: 180 degrees off is wrong (p. 146: moves away)."""
    for name, along, run in (("A", lines.first, lines.v1), ("B", lines.second, lines.v2 - lines.v1)):
        if name in used:
            number = "1" if name == "A" else "2"
            against = max(0.0, -dot(along, run))
            ledger.measure(f"line {number} does not run against its angle", case.texts(name), against, case.limit)
