"""A sample of the cases by what they cost: `tests/durations.json` says which of them run by default.

`python -m pytest --record-costs` writes what the cases that it runs cost into that file; other cases keep theirs.
"""

import json
import os
from collections import defaultdict
from collections.abc import Iterator, Mapping
from itertools import accumulate
from math import sqrt
from pathlib import Path
from zlib import crc32

import pytest

FILE = Path(__file__).parents[1] / "durations.json"

FIRST = 1 / 3
"""What counts of the cost of the first case of a test."""

DEAR = 0.3
"""Seconds of processor time: a case at a boundary that takes longer is drawn like all others."""

WHOLE = 60.0
"""Seconds of processor time that all cases of the default run take, besides starting and collecting."""

STEPS = (0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)
"""Costs are kept as the nearest of these, so that another measurement changes little."""

ALWAYS, SAMPLED = "always", "sampled"
"""Cases at a boundary and examples of docstrings, and all others but those that are slow by their own mark."""

KIND = pytest.StashKey[str]()
"""Which of them a case is."""

Costs = Mapping[str, Mapping[str, Mapping[str, float]]]
"""Seconds of each case, by file, test and case."""


def place_of(item: pytest.Item) -> tuple[str, str]:
    """The file of a case, from the root and with slashes, and the rest of its name, on one line."""
    file, _, name = item.nodeid.partition("::")
    return file, name.encode("unicode_escape").decode("ascii")


def test_of(name: str) -> str:
    """The test of a case."""
    return name.partition("[")[0]


def read_costs() -> dict[str, Costs]:
    """What each case cost when it was measured last: those that always run, and those of which a sample runs."""
    return json.loads(FILE.read_text(encoding="utf-8")) if FILE.exists() else {ALWAYS: {}, SAMPLED: {}}


def left_out(costs: Mapping[str, Costs]) -> dict[str, set[str]]:
    """The cases that do not run by default, by file. A case that was never measured runs.

    Those run first that cost least, and of equal ones by a fixed draw, as long as the whole allows it. Of a test, the
    first case counts a part of its cost alone, so that few tests run none, and each further one counts more.
    """
    whole, tests = WHOLE, defaultdict[tuple[str, str], list[tuple[float, int, str]]](list)
    for kind, file, name, cost in _all_cases(costs):
        if kind == ALWAYS and cost <= DEAR:
            whole -= cost
        else:
            tests[file, test_of(name)].append((cost, crc32(name.encode()), name))
    order = sorted(
        (case[0] * (sqrt(place) or FIRST), *case, file)
        for (file, _), cases in tests.items()
        for place, case in enumerate(sorted(cases))
    )
    found = defaultdict[str, set[str]](set)
    for spent, (*_, name, file) in zip(accumulate(cost for _, cost, *_ in order), order, strict=True):
        if spent > whole:
            found[file].add(name)
    return found


def _all_cases(costs: Mapping[str, Costs]) -> Iterator[tuple[str, str, str, float]]:
    """The kind, the file, the name and the seconds of each case that was measured."""
    for kind, files in costs.items():
        for file, tests in files.items():
            for cases in tests.values():
                yield from ((kind, file, name, cost) for name, cost in cases.items())


class Recorder:
    """Measures the processor time of each case, with the processes that it starts and waits for."""

    def __init__(self) -> None:
        self.started = 0.0
        self.found: dict[tuple[str, str, str], float] = {}

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_logstart(self) -> None:
        self.started = _processor_time()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self, item: pytest.Item, call: pytest.CallInfo[None]) -> Iterator[None]:
        report = yield
        if call.when == "teardown":
            report.cost = (item.stash.get(KIND, ""), *place_of(item), _processor_time() - self.started)
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if hasattr(report, "cost"):
            kind, file, name, cost = report.cost
            self.found.update({(kind, file, name): cost} if kind else {})

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        if hasattr(session.config, "workerinput") or not self.found:
            return
        costs = {kind: defaultdict[str, dict[str, dict[str, float]]](dict) for kind in (ALWAYS, SAMPLED)}
        for kind, files in read_costs().items():
            for file, tests in files.items():
                costs[kind][file] = {test: {**cases} for test, cases in tests.items()}
        for (kind, file, name), cost in self.found.items():
            step = min(STEPS, key=lambda step: abs(step - cost))
            costs[kind][file].setdefault(test_of(name), {})[name] = step
        FILE.write_text(json.dumps(costs, indent=0, sort_keys=True) + "\n", encoding="utf-8", newline="\n")


def _processor_time() -> float:
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system
