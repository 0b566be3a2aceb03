"""A sample of the cases by what they cost: `tests/durations.json` says which of them run by default.

`python -m pytest --record-costs` writes what the cases that it runs cost into that file; other cases keep theirs.
"""

import json
import os
from collections import defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path
from zlib import crc32

import pytest

FILE = Path(__file__).parents[1] / "durations.json"

EACH = 2.0
"""Seconds of processor time: a test that takes no longer runs with all of its cases, if the whole allows it."""

WHOLE = 110.0
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


def quick_cases(costs: Mapping[str, Costs]) -> dict[str, dict[str, set[str]]]:
    """The cases that run by default, by file and test. A case that was never measured runs, too.

    Each test has the same time, `EACH` or what the whole allows: of its cases those run that fit into it, the cheapest
    first, and of equal ones by a fixed draw. The cheapest of the others fill what is left of the whole.
    """
    tests = {
        (file, test): sorted((cost, crc32(name.encode()), name) for name, cost in cases.items())
        for file, tests in costs[SAMPLED].items()
        for test, cases in tests.items()
    }
    whole = WHOLE - sum(sum(cases.values()) for tests in costs[ALWAYS].values() for cases in tests.values())
    shares = (EACH * part / 40 for part in range(40, -1, -1))
    most = next(each for each in shares if sum(_spent(cases, each) for cases in tests.values()) <= max(whole, 0))
    found: dict[str, dict[str, set[str]]] = defaultdict(dict)
    left = []
    for (file, test), cases in tests.items():
        taken = _fitting(cases, most)
        found[file][test] = {name for _, name in taken}
        whole -= _spent(cases, most)
        left += [(*case, file, test) for case in cases[len(taken) :]]
    for cost, _, name, file, test in sorted(left):
        whole -= cost
        if whole < 0:
            break
        found[file][test].add(name)
    return found


def _fitting(cases: list[tuple[float, int, str]], seconds: float) -> list[tuple[float, str]]:
    """The first cases that fit into a time, each with what is spent by then."""
    found, spent = list[tuple[float, str]](), 0.0
    for cost, _, name in cases:
        spent += cost
        if spent > seconds:
            break
        found.append((spent, name))
    return found


def _spent(cases: list[tuple[float, int, str]], seconds: float) -> float:
    return max((spent for spent, _ in _fitting(cases, seconds)), default=0.0)


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
