"""What all solutions and their proof cost, and how often they are found, beside peers: pytest tests/benchmarks."""

import sys
from collections import Counter
from time import perf_counter
from typing import Any

import pytest
from peers import ADAPTERS, RIGHT, Case, Ours, random_cases, run_peer, run_peers, table
from pytest_benchmark.fixture import BenchmarkFixture
from sketches import chain_case

import contoursolve
from contoursolve import Sketch
from contoursolve.solving.solution import Certificate, Proof

CASES = 300

TAPER = ("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.", "yasnac-lx3")
PAIR = ("G17 G90 G41 G0 X0 Y0\nG3 I50 J0\nG1 X60 Y100 ,A80 Q1", "nct-99m")


def seconds_of(program: str, control: str, solves: int = 20) -> float:
    begin = perf_counter()
    for _ in range(solves):
        contoursolve.solve(program, control=control)
    return (perf_counter() - begin) / solves


@pytest.mark.parametrize(("program", "control"), [TAPER, PAIR], ids=["G111", "NCT"])
def test_a_certified_contour_takes_at_most_twice_as_long_as_one_without_a_certificate(
    benchmark: BenchmarkFixture, monkeypatch: pytest.MonkeyPatch, program: str, control: str
) -> None:
    answer = benchmark(contoursolve.solve, program, control=control).answers[0]
    assert answer.certificate.proof is Proof.UNIQUE
    # In turns, so that whatever else the machine does slows both; `contoursolve.solving.solve` is a function, too.
    module = sys.modules["contoursolve.solving.solve"]
    certified, bare = [], []
    for _ in range(15):
        certified.append(seconds_of(program, control))
        with monkeypatch.context() as patch:
            patch.setattr(module, "certify", lambda *_: Certificate(Proof.VERIFIED, 0.0))
            bare.append(seconds_of(program, control))
    ratio = min(certified) / min(bare)
    benchmark.extra_info.update(certified_ms=min(certified) * 1e3, bare_ms=min(bare) * 1e3, ratio=ratio)
    assert ratio <= 2


def test_the_eight_circles_of_apollonius_take_less_than_100_ms(benchmark: BenchmarkFixture) -> None:
    def solve() -> Any:
        sketch = Sketch()
        for name, x, y, radius in (("a", 0, 0, 10), ("b", 45, 5, 14), ("c", 12, 50, 7)):
            sketch.circle(name, center=(x, y), radius=radius)
        sketch.circle("k")
        for name in "abc":
            sketch.state(f"k tangent to {name}")
        return sketch.solve()

    drawings = benchmark(solve)
    assert (len(drawings), drawings.is_complete) == (8, True)
    assert benchmark.stats.stats.median < 0.100


def test_every_chain_is_found_again() -> None:
    """Chains that were drawn first, and then described by facts that are true of them."""
    described = [(chain, tuple(facts)) for chain, facts in map(chain_case, range(CASES))]
    classes, seconds = run_peer([Case(chain, facts, chain) for chain, facts in described], Ours())
    print(f"\n{CASES} chains in {sum(seconds):.0f} s: {dict(Counter(classes))}")  # noqa: T201 what this is run for
    assert Counter(classes) == {RIGHT: CASES}


def test_beside_its_peers_ours_gives_no_wrong_answer_for_a_right_one() -> None:
    rows = run_peers(random_cases(CASES, 1), ADAPTERS)
    print(f"\n{table(rows)}")  # noqa: T201 what this is run for
    ours = next(row for row in rows if row.peer == Ours.name)
    assert ours.wrong == 0
