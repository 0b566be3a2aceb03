"""What benchmarks measure, as one table at the end of a run, and as a chart of growth.

python -m pytest tests/benchmarks --chart notebooks/pictures/waiting_growth.svg
"""

from collections.abc import Callable, Iterator, Mapping
from math import log
from pathlib import Path

import pytest

ROWS: list[tuple[str, str, str]] = []
"""What was measured, how much it is, and beside what."""

GROWTH: dict[str, Mapping[int, float]] = {}
"""Seconds of processor time by size, by what grows."""


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.getgroup("contoursolve").addoption("--chart", metavar="FILE", help="where the chart of growth is written")


@pytest.fixture
def told() -> Callable[[str, str, str], None]:
    """Takes a row for the table: what was measured, how much it is, and beside what."""
    return lambda *row: ROWS.append(row)


@pytest.fixture
def growth() -> Callable[[str, Mapping[int, float]], float]:
    """Takes seconds by size, and gives the exponent between the smallest and the largest: 1 is linear."""

    def take(what: str, seconds: Mapping[int, float]) -> float:
        GROWTH[what] = seconds
        sizes = min(seconds), max(seconds)
        exponent = log(seconds[sizes[1]] / seconds[sizes[0]]) / log(sizes[1] / sizes[0])
        ROWS.append((what, ", ".join(f"{size:,}: {each:.3g} s" for size, each in seconds.items()), f"n^{exponent:.2f}"))
        return exponent

    return take


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    for line in _table():
        terminalreporter.write_line(line)
    if config.getoption("--chart") and GROWTH:
        draw(Path(config.getoption("--chart")))


def _table() -> Iterator[str]:
    if ROWS:
        yield ""
        yield "| what | result | beside |"
        yield "|---|---|---|"
    for row in ROWS:
        yield f"| {' | '.join(row)} |"


def draw(path: Path) -> None:
    """One diagram with logarithmic axes; the same numbers give the same bytes."""
    import matplotlib  # noqa: PLC0415 - only the picture needs it

    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "contoursolve", "svg.fonttype": "path", "font.size": 9})
    from matplotlib import pyplot  # noqa: PLC0415

    figure, axes = pyplot.subplots(figsize=(9, 5), layout="constrained")
    axes.set_prop_cycle(color=matplotlib.colormaps["tab20"].colors)
    for mark, (what, seconds) in zip("os^vD*Px<>ph" * 2, GROWTH.items(), strict=False):
        axes.loglog([*seconds], [*seconds.values()], f"{mark}-", label=what, markersize=4)
    axes.set(xlabel="lines, or elements of the chain", ylabel="seconds (processor)")
    axes.legend(frameon=False, loc="center left", bbox_to_anchor=(1.0, 0.5))
    axes.grid(alpha=0.3)
    figure.savefig(path, metadata={"Date": None, "Creator": None})
