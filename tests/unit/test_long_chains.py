"""A long contour takes work in proportion to its length, right or wrong: counted, not timed."""

from functools import partial

import pytest
from counted import calls
from long_chains import angles, corners, klartext

import contoursolve
from contoursolve.diagnosis.attempt import Trial
from contoursolve.solving import enumerate as enumerate_module
from contoursolve.solving.construction import Builder

SHORT, TIMES = 24, 4
"""Elements of the short chain, and how much longer the long one is."""

CHAINS = {
    "FK, a word twice": ("heidenhain", lambda number: klartext(number, "twice"), "heidenhain-repeated"),
    "FK, a word that disagrees": ("heidenhain", lambda number: klartext(number, "disagrees"), "words-conflict"),
    "FK, a word missing": ("heidenhain", lambda number: klartext(number, "missing"), "words-missing"),
    "NCT, an angle reversed": ("nct-99m", lambda number: angles(number, "reversed"), "nct-reversed"),
    "NCT, a corner too large": ("nct-99m", lambda number: angles(number, "large"), "nct-corner-too-large"),
    "NCT, an angle twice": ("nct-99m", lambda number: angles(number, "twice"), "address-repeated"),
    "no corner on a line": ("siemens-840d", lambda number: corners(number, "siemens-840d", 0.0), "siemens-corner"),
    "corners": ("nct-99m", lambda number: corners(number, "nct-99m"), ""),
}

LONG = list(CHAINS)[:-1]
"""Those that are slow to count."""


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.slow) if name in LONG else name for name in CHAINS]
)
def test_a_chain_so_many_times_as_long_takes_about_so_many_times_the_work(name):
    control, chain, code = CHAINS[name]
    found = contoursolve.solve(chain(8), control=control).diagnostics
    assert found[0].code.startswith(code) if code else not found
    first = 4 * SHORT if name.endswith("line") else SHORT
    short, long = (calls(partial(contoursolve.solve, chain(size), control=control)) for size in (first, TIMES * first))
    assert long <= 1.3 * TIMES * short


@pytest.mark.slow
def test_trials_on_a_chain_solve_what_they_change_and_no_more():
    """Of 100 steps of two facts each, a trial without one word leaves nearly all as they are."""
    enumerate_module._roots_of.cache_clear()
    (answer,) = contoursolve.solve(klartext(100, "disagrees"), control="heidenhain").answers
    assert len(answer.diagnostics[0].fixes) > 1
    asked, solved = enumerate_module._roots_of.cache_info()[:2]
    assert solved <= 300 < 1_500 <= asked + solved


@pytest.mark.slow
def test_numbers_for_a_missing_word_are_tried_on_what_they_move_alone(monkeypatch):
    """Of 80 steps, each of the 8 words that may be missing moves a few."""
    build, built = Builder.run, list[str]()
    monkeypatch.setattr(Builder, "run", lambda builder, step: built.append(step.kind.name) or build(builder, step))
    (answer,) = contoursolve.solve(klartext(40, "missing"), control="heidenhain").answers
    numbers = [each for fix in answer.diagnostics[0].fixes for each in fix.numbers]
    assert len([each for each in numbers if each.ranges]) > 4
    assert len(built) < 300


@pytest.mark.slow
def test_of_a_long_chain_no_more_words_are_tried_than_of_a_short_one(monkeypatch):
    find, counts = Trial.find, list[int]()

    def counted(trial, edits):
        counts[-1] += 1
        return find(trial, edits)

    monkeypatch.setattr(Trial, "find", counted)
    for size in (12, 30):
        counts.append(0)
        (answer,) = contoursolve.solve(klartext(size, "missing"), control="heidenhain", depth="path").answers
        assert any(fix.description.startswith("add AN") for fix in answer.diagnostics[0].fixes)
    assert counts[1] <= 1.5 * counts[0]
