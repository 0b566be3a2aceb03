"""What a diagnosis says of the equations of a contour of words alone: what can still move, which words say the same."""

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from math import atan2, degrees, hypot

from contoursolve.model import FIRST, SECOND
from contoursolve.tolerance import AGREEMENT, REGULAR, RESIDUAL
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedDiagnosis, ClaimedFreedom
from contoursolve.verification.g111 import LINE_1, LINE_2, UNKNOWNS, ignored_words, statements_at
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.statement import Statement, displacement

POINTS = ("V1", "V2")

Row = Sequence[float]

HALF_TURN = 180.0
"""Degrees."""


def check_linear(case: Case, diagnosis: ClaimedDiagnosis, ledger: Ledger) -> None:
    """The freedoms and ties of a G111 block, whose words are linear in Z and X of V1 and V2."""
    used = case.states(*LINE_1, *LINE_2)
    stated = list(statements_at(case, used, 0j, 0j))
    _check_freedoms([each.gradient for each in stated], diagnosis.freedoms, ledger)
    found = dict(_ties(used, stated))
    for tie in diagnosis.ties:
        name = tuple(sorted(tie.addresses))
        if ledger.require("the words that are tied say the same", tie.addresses, name in found, "they do not"):
            off, weight = found.pop(name)
            ledger.measure(
                "they disagree by as much", tie.addresses, tie.off_by_mm - off, case.limit / min(1.0, weight)
            )
            share = _share(case, name)
            is_right = tie.is_conflict == (share > 1) or 1 / CLEARLY < share < CLEARLY
            ledger.require("they conflict if that is more than the least increments", tie.addresses, is_right)
    ledger.require(
        "all words that are tied are named", [" ".join(each) for each in found], not found, "the result lacks these"
    )


def _share(case: Case, names: tuple[str, ...]) -> float:
    """By how much the last of words that are tied misses what the others say, as a share of what is allowed."""
    ignored = ignored_words(case)
    *others, last = sorted(names, key=lambda name: (name in ignored, _ORDER.index(name)))
    moved = displacement(list(statements_at(case, tuple(others), 0j, 0j)), UNKNOWNS)
    v1, v2 = -complex(*moved.moves[:2]), -complex(*moved.moves[2:])
    (stated,) = statements_at(case, (last,), v1, v2)
    touched = {index for index, slope in enumerate(stated.gradient) if slope}
    return abs(stated.residual) / (AGREEMENT if touched & {*moved.free} else stated.allowed)


_ORDER = "IKAXUZWB"
"""Words that come later are held against those before."""

CLEARLY = 2.0
"""1. Within so many times the allowed amount or one part of so many it is left open whether words agree."""


def _list(names: Iterable[str]) -> str:
    return ", ".join(ascii(name)[1:-1] for name in names) or "none"


def _check_freedoms(rows: Sequence[Row], freedoms: Sequence[ClaimedFreedom], ledger: Ledger) -> None:
    null = _null_space(rows)
    expected = {name: at for name, at in _moving(null).items() if at is not None}
    names = [each.point for each in freedoms]
    remark = f"the result has {_list(names)}, and by the words they are {_list(expected)}"
    ledger.require("the points that can move are those", (), sorted(names) == sorted(expected), remark)
    for each in freedoms:
        if each.point not in expected:
            continue
        along, claimed = expected[each.point], each.direction
        is_line = along is not None and bool(along)
        name = f"{each.point} moves along a line or anywhere"
        if not ledger.require(name, (), is_line == (claimed is not None) == (each.angle is not None)) or not claimed:
            continue
        first, second = claimed
        own = f"{each.point} moves in that direction"
        ledger.measure(own, (), along[FIRST] * second - along[SECOND] * first, RESIDUAL, "1")
        ledger.measure(f"{own}, given by a unit vector", (), hypot(first, second) - 1, RESIDUAL, "1")
        is_ahead = max(claimed, key=abs) > 0 or abs(abs(first) - abs(second)) <= RESIDUAL
        ledger.require(f"{own}, its larger part positive", (), is_ahead)
        off = (each.angle or 0.0) - degrees(atan2(second, first))
        ledger.require(f"{own}, its angle up to half a turn", (), 0 <= (each.angle or 0.0) <= HALF_TURN)
        ledger.measure(f"{own}, by its angle", (), (off + HALF_TURN / 2) % HALF_TURN - HALF_TURN / 2, RESIDUAL, "deg")


def _null_space(rows: Sequence[Row]) -> list[list[float]]:
    """Directions of all unknowns in which no row changes, by Gauss-Jordan elimination."""
    work, fixed = [list(row) for row in rows], dict[int, int]()
    while len(fixed) < UNKNOWNS:
        places = [(row, column) for row in range(len(work)) for column in range(UNKNOWNS) if row not in fixed.values()]
        at, column = max(places, key=lambda place: abs(work[place[0]][place[1]]), default=(0, 0))
        if not places or abs(work[at][column]) <= REGULAR:
            break
        work[at] = [entry / work[at][column] for entry in work[at]]
        for other in range(len(work)):
            if other != at:
                factor = work[other][column]
                work[other] = [a - factor * b for a, b in zip(work[other], work[at], strict=True)]
        fixed[column] = at
    return [
        [
            1.0 if column == free else -work[fixed[column]][free] if column in fixed else 0.0
            for column in range(UNKNOWNS)
        ]
        for free in range(UNKNOWNS)
        if free not in fixed
    ]


def _moving(null: Sequence[Row]) -> dict[str, tuple[float, ...] | None]:
    """For each point the unit direction in which it can move; empty where it lies anywhere, None where it is fixed."""
    found: dict[str, tuple[float, ...] | None] = {}
    for number, name in enumerate(POINTS):
        ways = [(row[2 * number], row[2 * number + 1]) for row in null]
        longest = max(ways, key=lambda way: hypot(*way), default=(0.0, 0.0))
        length = hypot(*longest)
        if length <= REGULAR:
            found[name] = None
            continue
        along = longest[0] / length, longest[1] / length
        is_anywhere = any(abs(along[0] * way[1] - along[1] * way[0]) > REGULAR for way in ways)
        found[name] = () if is_anywhere else along
    return found


def _ties(used: Sequence[str], stated: Sequence[Statement]) -> Iterator[tuple[tuple[str, ...], tuple[float, float]]]:
    """The smallest sets of words of which each follows from the others: by how much the one that is off most misses
    what the others say, mm, and the least of their weights."""
    found: list[set[int]] = []
    for size in range(1, min(UNKNOWNS + 1, len(stated)) + 1):
        for rows in combinations(range(len(stated)), size):
            if any(other <= set(rows) for other in found):
                continue
            if displacement([stated[row] for row in rows], UNKNOWNS).rank == size:
                continue
            found.append(set(rows))
            weights = _weights([stated[row].gradient for row in rows])
            gap = sum(weight * stated[row].residual for weight, row in zip(weights, rows, strict=True))
            least = min(map(abs, weights))
            yield tuple(sorted(used[row] for row in rows)), (abs(gap) / least, least)


def _weights(rows: Sequence[Row]) -> list[float]:
    """How often each row must be taken for all of them to add up to nothing; the first one once."""
    first, others = rows[0], rows[1:]
    columns = [
        Statement("", "", tuple(row[index] for row in others), first[index]) for index in range(UNKNOWNS) if others
    ]
    return [1.0, *(-move for move in displacement(columns, len(others)).moves)]
