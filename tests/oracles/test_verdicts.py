"""The table of sympy's verdicts that ships: up to date, right on cases known by hand, and right by numpy."""

import json
import pkgutil
import random
import re
from math import cos, radians, sin, sqrt

import numpy as np
import pytest
from msgspec.structs import asdict

from contoursolve import geometry
from contoursolve.controls import CONTROLS, write_tables
from contoursolve.geometry import build_system
from contoursolve.reading import lay_out, stated_sets
from contoursolve.solving import circuits_for_all_values, derive, derive_identity

TEXT = pkgutil.get_data("contoursolve.solving", "verdicts.json").decode()
TABLE = json.loads(TEXT)
FACTS = {name: getattr(geometry, name) for name in geometry.__all__}
STEP = 1e-6
ZERO = 1e-6
"""Singular values below this are zero: the derivatives are of size 1 and known to 1e-9."""


def letters(key: str) -> frozenset[str]:
    return frozenset(re.findall(r"given='([A-Z])'", key))


BY_LETTERS = {letters(key): row for key, row in TABLE.items() if key.startswith("V1.0,")}


@pytest.mark.slow
def test_shipped_table_is_what_sympy_derives_today():
    systems = write_tables.systems()
    assert systems.keys() == TABLE.keys()
    for key in [*systems][::4]:  # all of them take minutes
        assert json.loads(json.dumps(asdict(derive(systems[key])))) == TABLE[key], key


def test_shipped_formulas_of_g111_are_what_sympy_derives_today():
    form = CONTROLS["yasnac-lx3"].forms[0]
    shipped = json.loads(pkgutil.get_data("contoursolve.solving", "identities.json"))
    layout = lay_out(form, frozenset().union(*stated_sets(form)), frozenset())
    system = build_system(layout.figure, layout.facts)
    for each in circuits_for_all_values(system).found[:2]:  # all of them take seconds
        names = " ".join(sorted(fact.given for fact in each.facts if fact.given))
        assert derive_identity(system, each.facts) == shipped[f"{form.name}: {names}"]


@pytest.mark.parametrize(
    ("words", "condition"),
    [("AIBX", "sin(A)*sin(B)"), ("ABXZ", "sin(A - B)"), ("IBXZ", "sin(B)"), ("KBXZ", "cos(B)"), ("IKXZ", "1")],
)
def test_determinants_of_well_known_combinations(words, condition):
    row = BY_LETTERS[frozenset(words)]
    assert row["condition"] == condition
    assert (row["rank"], row["free"], row["tied"]) == (4, [], [])


class _Point:
    """A lookup of random values; every name gets its own, the same one each time."""

    def __init__(self, seed: int, facts=()) -> None:
        self._draw = random.Random(seed)
        # A line that touches an arc has the direction that the only angle states.
        self._heading = next((fact for fact in facts if isinstance(fact, geometry.Heading)), None)
        self.values: dict[str, float] = {}

    def _value(self, name: str) -> float:
        if name not in self.values:
            self.values[name] = self._draw.uniform(1, 9)
        return self.values[name]

    def coordinate(self, point: str, axis: int) -> float:
        return self._value(f"{point}.{axis}")

    radius = amount = _value
    root = staticmethod(sqrt)

    @staticmethod
    def vanishes(value: float) -> bool:
        return value == 0

    def direction(self, given: str) -> tuple[float, float]:
        angle = radians(self._value(f"angle {given}") * 40)
        return cos(angle), sin(angle)

    def bearing(self, _line: str) -> tuple[float, float]:
        return self.direction(self._heading.given)

    def line(self, name: str) -> tuple[float, float, float]:
        cosine, sine = self.bearing(name)
        tail = self._heading.tail
        return cosine, sine, cosine * self.coordinate(tail, 1) - sine * self.coordinate(tail, 0)


def jacobian(facts, unknowns, seed):
    """Derivatives of the residuals by the unknowns, shape (facts, unknowns), by central differences."""
    at = _Point(seed, facts)
    for fact in facts:
        fact.residual(at)
    matrix = np.zeros((len(facts), len(unknowns)))
    for column, name in enumerate(unknowns):
        middle = at.values.setdefault(name, 5.0)
        sides = []
        for at.values[name] in (middle + STEP, middle - STEP):
            sides.append([fact.residual(at) for fact in facts])
        at.values[name] = middle
        matrix[:, column] = (np.array(sides[0]) - np.array(sides[1])) / (2 * STEP)
    return matrix


def rank(matrix):
    return int(np.linalg.matrix_rank(matrix, tol=ZERO)) if matrix.size else 0


def analyse(matrix):
    """Rank, rows that the others imply, and columns that nothing determines, at one point."""
    whole = rank(matrix)
    units = np.eye(matrix.shape[1])
    tied = [row for row in range(len(matrix)) if rank(np.delete(matrix, row, axis=0)) == whole]
    free = [column for column, unit in enumerate(units) if rank(np.vstack([matrix, unit])) > whole]
    return whole, tied, free


@pytest.mark.slow
def test_shipped_verdicts_equal_those_of_numpy_at_random_values():
    wrong = {}
    for key, row in TABLE.items():
        names, _, texts = key.partition(": ")
        unknowns = names.split(",") if names else []
        facts = [eval(text, FACTS.copy()) for text in texts.split("; ") if text]
        matrices = [jacobian(facts, unknowns, seed) for seed in (1, 2, 3)]
        best = max(matrices, key=rank)
        found = analyse(best)
        if found != (row["rank"], row["tied"], [unknowns.index(name) for name in row["free"]]):
            wrong[key] = found
        elif len(row["basis"]) != rank(best[row["basis"]]) or len(row["basis"]) != row["rank"]:
            wrong[key] = row["basis"]
    assert wrong == {}
    assert len(TABLE) > 2**8  # the facts of G111, and those of the other forms
