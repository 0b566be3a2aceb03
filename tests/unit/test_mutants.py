"""The faults that `python -m tests.mutants` puts in: each is Python, on as many lines, and what is listed is there."""

from itertools import islice

from tests.mutants.__main__ import draw, name_of, unnoticeable
from tests.mutants.faults import KINDS, faults_of
from tests.mutants.trial import ROOT

FILES = sorted(
    {"contoursolve/solving/contour.py", "contoursolve/numeric/hand.py", *(file for file, *_ in unnoticeable())}
)
FAULTS = [fault for file in FILES for fault in faults_of((ROOT / file).read_bytes(), file)]
SOURCE = b"""
def size(a, b=-1):
    if a < b and not b:
        return a - b
    return [each for each in (a, b) if each] if a else f"{-a}"
"""


def test_each_kind_of_fault_is_put_in_where_it_can_be():
    assert [(each.kind, each.line, each.change) for each in faults_of(SOURCE, "contoursolve/x.py")] == [
        ("sign", 2, "(1) for -1"),
        ("condition", 3, "((a < b)) for a < b and not b"),
        ("condition", 3, "((not b)) for a < b and not b"),
        ("condition", 3, "False for a < b and not b"),
        ("condition", 3, "True for a < b and not b"),
        ("comparison", 3, "<= for <"),
        ("comparison", 3, "> for <"),
        ("comparison", 3, ">= for <"),
        ("condition", 3, "(b) for not b"),
        ("sign", 4, "+ for -"),
        (
            "branches",
            5,
            (
                '((f"{-a}") if (a) else ([each for each in (a, b) if each]))'
                ' for [each for each in (a, b) if each] if a else f"{-a}"'
            ),
        ),
        ("condition", 5, "True for each"),
    ]


def test_a_fault_is_python_on_as_many_lines():
    for fault in FAULTS[::23]:
        source = (ROOT / fault.file).read_bytes()
        spoilt = fault.apply(source)
        compile(spoilt, fault.file, "exec")
        assert spoilt.count(b"\n") == source.count(b"\n"), fault


def test_the_same_seed_draws_the_same_faults_of_all_kinds_in_turn():
    drawn = [[*islice(draw(FAULTS, 7), 12)] for _ in range(2)]
    assert drawn[0] == drawn[1]
    assert [fault.kind for fault in drawn[0]] == [*KINDS] * 3


def test_what_is_said_to_change_nothing_could_still_be_put_in():
    assert unnoticeable().keys() <= {name_of(fault) for fault in FAULTS}
