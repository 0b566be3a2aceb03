"""How a G111 block of words alone stands: its two virtual intersections are where linear equations put them."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

from contoursolve.verification.case import Case
from contoursolve.verification.drawing import Drawing, Round, UnmeasurableError
from contoursolve.verification.g111 import LINE_1, LINE_2, UNKNOWNS, drawn_at, ignored_words, statements_at
from contoursolve.verification.g111_drawing import CORNERS
from contoursolve.verification.standing import Candidate, Leg, Standing, path_of
from contoursolve.verification.statement import Statement, displacement

_GENERIC = {"A": "37.31", "B": "101.77"}
"""Degrees. Angles in which no two directions have anything to do with each other."""

_CLEARLY = 2.0
"""1. Words disagree if they do by so many times the least increment, and agree within one part of so many."""


def stand(case: Case) -> Standing | None:
    """None where it depends on which of the words are solved for first."""
    used = tuple(name for name in case.states(*LINE_1, *LINE_2) if name not in ignored_words(case))
    made = {name: [word for word in words if word in _sizes(case)] for name, *words in CORNERS}
    twice = [name for name, words in made.items() if len(words) > 1]
    by_x, by_z = bool(set(used) & {"X", "U"}), bool(set(used) & {"Z", "W"})
    lands_nowhere = bool(made["corner 2"]) and by_x == by_z
    generic = list(statements_at(_with_angles(case), used, 0j, 0j))
    rank = displacement(generic, UNKNOWNS).rank
    is_loose = lands_nowhere or rank < UNKNOWNS
    if twice:
        return Standing(disagrees=f"{' and '.join(twice)} given twice", is_twice=True, is_loose=is_loose)
    stated = list(statements_at(case, used, 0j, 0j))
    if is_loose:
        agree = _agree(case, used, stated, generic, rank) if len(stated) > rank else True
        return None if agree is None else Standing("" if agree else " ".join(case.texts(*used)), is_loose=True)
    if any(size < 0 for size in _sizes(case).values()):
        return Standing()
    moved = displacement(stated, UNKNOWNS)
    if len(stated) == UNKNOWNS and moved.rank < UNKNOWNS:
        # Two words state the same line, or two parallel ones; where both happens, it is open which counts.
        if moved.rank < UNKNOWNS - 1:
            return None
        left = _at(stated, moved.moves)
        return Standing(is_loose=max(map(abs, left)) <= case.limit)
    if len(stated) > UNKNOWNS:
        return _over(case, used, stated, generic)
    return Standing(candidates=(_candidate(case, used, moved.moves),))


def _sizes(case: Case) -> dict[str, float]:
    return {
        name: case.amount(name) for _, *words in CORNERS for name in words if case.states(name) and case.value(name)
    }


def _with_angles(case: Case) -> Case:
    """The case with other angles."""
    givens = dict(case.claim.givens)
    for name, angle in _GENERIC.items():
        if name in givens:
            value = type(givens[name].value)(angle)
            givens[name] = replace(givens[name], value=value)
    return replace(case, claim=replace(case.claim, givens=givens))


def _at(stated: Sequence[Statement], moves: Sequence[float]) -> list[float]:
    """The residuals, mm, after the corrections of all unknowns."""
    return [
        each.residual - sum(slope * move for slope, move in zip(each.gradient, moves, strict=True)) for each in stated
    ]


def _over(case: Case, used: tuple[str, ...], stated: list[Statement], generic: list[Statement]) -> Standing | None:
    agree = _agree(case, used, stated, generic, UNKNOWNS)
    if agree:
        return Standing(is_over=True, candidates=(_candidate(case, used, displacement(stated, UNKNOWNS).moves),))
    return None if agree is None else Standing(disagrees=" ".join(case.texts(*used)))


def _agree(
    case: Case, used: tuple[str, ...], stated: list[Statement], generic: list[Statement], rank: int
) -> bool | None:
    """Whether words that say more than they need to agree. Every set of so many of them as say something of their own
    must tell whether the others do; None where it depends on which are solved for."""
    worst: list[float] = []
    for rows in combinations(range(len(stated)), rank):
        if displacement([generic[row] for row in rows], UNKNOWNS).rank < rank:
            continue
        moved = displacement([stated[row] for row in rows], UNKNOWNS)
        if moved.rank < rank:
            return None
        v1, v2 = complex(*moved.moves[:2]), complex(*moved.moves[2:])
        here = list(statements_at(case, used, -v1, -v2))
        worst.append(max(abs(each.residual) / each.allowed for each in here))
    if all(each > _CLEARLY for each in worst):
        return False
    return True if all(each < 1 / _CLEARLY for each in worst) else None


def _candidate(case: Case, used: tuple[str, ...], moves: Sequence[float]) -> Candidate:
    v1, v2 = -complex(*moves[:2]), -complex(*moves[2:])
    try:
        drawing = drawn_at(case, used, v1, v2)
    except UnmeasurableError:
        return Candidate(None)
    return Candidate(path_of(list(_legs(drawing)), {"V1": v1, "V2": v2}, case.origin))


def _legs(drawing: Drawing) -> list[Leg]:
    legs = []
    for name in ("line 1", "corner 1", "line 2", "corner 2"):
        if name in drawing.shapes:
            shape = drawing.shapes[name]
            arc = (shape.center, shape.radius, shape.turn) if isinstance(shape, Round) else None
            legs.append(Leg(shape.end, arc))
    return legs
