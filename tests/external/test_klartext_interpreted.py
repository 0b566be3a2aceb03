"""Klartext programs in G codes, run by LinuxCNC's interpreter."""

from functools import cache
from math import hypot
from random import Random

import pytest
from examples_heidenhain import PROGRAMS
from interpreter import Motion, assert_path, interpret, interpret_all
from klartext import Drawn, random_program

import contoursolve
from contoursolve.solving.contour import ArcSegment

WITHIN = 0.001
"""mm."""

SHARES = (1.0, 0.6, 0.0)
"""How many of the elements of a drawn program are free ones."""


@cache
def drawings() -> list[Drawn]:
    """Free chains, chains among conventional moves, and conventional moves alone."""
    rng = Random(11)
    return [random_program(rng, SHARES[number % len(SHARES)]) for number in range(90)]


def expanded(text: str, arcs: str = "center") -> str:
    expansion = contoursolve.expand(text, post="linuxcnc", arcs=arcs)
    assert expansion.text is not None, (text, expansion.summary.left)
    assert expansion.summary.unfamiliar == []
    return expansion.text


def cut(motions: list[Motion]) -> list[Motion]:
    """What is not in rapid."""
    return [each for each in motions if each.kind != "traverse"]


def test_every_kind_of_block_is_among_the_programs():
    shown = frozenset[str]().union(*(each.shows for each in drawings()))
    assert shown >= {"FL ends", "FL angle", "FL increments", "FL polar", "FLT", "FC", "FCT", "RND", "CHF"}
    assert shown >= {"L", "L increments", "LP", "C", "CR", "CP", "CP steps", "CT"}


@pytest.mark.interpreter
@pytest.mark.parametrize("arcs", ["center", "radius"])
def test_linuxcnc_runs_every_program_where_it_was_drawn(arcs, tmp_path):
    programs = [expanded(each.text, arcs).rpartition("(")[0] for each in drawings()]
    for each, motions in zip(drawings(), interpret_all(programs, tmp_path), strict=True):
        assert_path(cut(motions), each.path, WITHIN)


@pytest.mark.interpreter
@pytest.mark.parametrize("name", PROGRAMS)
def test_linuxcnc_runs_the_worked_examples_along_their_contours(name, tmp_path):
    text = PROGRAMS[name]
    [answer] = contoursolve.solve(text).answers
    path = [
        (complex(*each.start), complex(*each.end), complex(*each.center), each.turn.value)
        if isinstance(each, ArcSegment)
        else (complex(*each.start), complex(*each.end), None, "line")
        for each in answer.contour.elements
    ]
    motions = cut(interpret("F200\n" + expanded(text), tmp_path))
    begin = next(place for place, each in enumerate(motions) if abs(each.end - path[0][1]) <= WITHIN)
    assert_path(motions[begin : begin + len(path)], path, WITHIN)


@pytest.mark.interpreter
def test_linuxcnc_runs_a_helix_of_several_turns(tmp_path):
    text = "0 BEGIN PGM A MM\n1 L X+30 Y+0 Z+0 F200\n2 CC X+0 Y+0\n3 CP IPA+810 IZ-9 DR+\n4 END PGM A MM\n"
    motions = cut(interpret("F200\n" + expanded(text), tmp_path))
    assert all(each.kind == "ccw" and hypot(each.center.real, each.center.imag) <= WITHIN for each in motions[1:])
    assert abs(motions[-1].end - 30j) <= WITHIN
    assert " Z-9\n" in expanded(text)
