"""Every arc of every control: right ones are told nothing, impossible ones are found, in whatever order words stand."""

from random import Random

import pytest
from drawn_arcs import Drawing, kinds_of
from hypothesis import given, settings, strategies as st

import contoursolve
from contoursolve.controls import CONTROLS
from contoursolve.diagnostics import Severity

SEEDS = st.integers(0, 2**32)


def findings(arcs):
    # Where each arc is a contour, odd ones are warned of.
    quiet = {"cnc-pilot.suspicions": "off"} if arcs.control == "cnc-pilot" else None
    return contoursolve.solve(arcs.text, control=arcs.control, settings=quiet, depth="verdict").diagnostics


def told(arcs):
    return [each for each in findings(arcs) if each.severity is not Severity.INFO]


def by_line(found):
    """Findings without their columns, which the order of words changes."""
    return sorted((each.span.line, each.code, sorted(each.values.items())) for each in found)


@pytest.mark.parametrize("control", CONTROLS)
@given(SEEDS)
def test_right_arcs_are_told_nothing(control, seed):
    arcs = Drawing(control, Random(seed)).arcs()
    assert told(arcs) == [], arcs.text


@pytest.mark.parametrize(("control", "kind"), [(each, kind) for each in CONTROLS for kind in kinds_of(each)])
@settings(max_examples=10)
@given(SEEDS)
def test_an_impossible_arc_is_found_in_whatever_order_its_words_stand(control, kind, seed):
    arcs = Drawing(control, Random(seed)).arcs(kind)
    found = told(arcs)
    lines, last = {each.span.line for each in found}, arcs.text.count("\n") - (control != "heidenhain")
    # Where arcs make contours, the one before may be another one with it.
    assert (last in lines) if control in ("nct-99m", "cnc-pilot") else (lines == {last}), arcs.text
    other = told(arcs.shuffled(Random(seed)))
    assert by_line(other) == by_line(found), arcs.text
