"""A sample of the cases by what they cost: `tests/durations.json` says which of them run by default.

`python -m pytest --record-costs` writes what the cases that it runs cost into that file; other cases keep theirs.
"""

import json
import os
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from pathlib import Path
from zlib import crc32

import pytest

FILE = Path(__file__).parents[1] / "durations.json"

EACH = 2.0
"""Seconds of processor time: a test that takes no longer runs with all of its cases."""

WHOLE = 170.0
"""Seconds of processor time that all cases of the default run take together, besides starting and collecting."""

STEPS = (0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0)
"""Costs are kept as the nearest of these, so that another measurement changes little."""

Costs = Mapping[str, Mapping[str, Mapping[str, float]]]
"""Seconds of each case, by file, test and case."""


def place_of(item: pytest.Item) -> tuple[str, str]:
    """The file of a case, from the root and with slashes, and the rest of its name, on one line."""
    file, _, name = item.nodeid.partition("::")
    return file, name.encode("unicode_escape").decode("ascii")


def test_of(name: str) -> str:
    """The test of a case."""
    return name.partition("[")[0]


def read_costs() -> Costs:
    """What each case cost when it was measured last."""
    return json.loads(FILE.read_text(encoding="utf-8")) if FILE.exists() else {}


def quick_cases(costs: Costs) -> dict[str, dict[str, set[str]]]:
    """The cases that run by default, by file and test. A case that was never measured runs, too.

    First each test has the same time: of its cases those run that fit into it, the cheapest first, and of equal ones by
    a fixed draw. Then the cheapest of the others fill what is left of the whole, drawn in the same way.
    """
    cases = [
        (cost, crc32(name.encode()), name, (file, test))
        for file, tests in costs.items()
        for test, names in tests.items()
        for name, cost in names.items()
    ]
    used: Counter[tuple[str, str]] = Counter()
    found: dict[str, dict[str, set[str]]] = {file: {test: set() for test in tests} for file, tests in costs.items()}
    left, whole = [], WHOLE
    for case in sorted(cases):
        cost, _, name, (file, test) = case
        used[file, test] += cost
        is_taken = used[file, test] <= EACH
        (found[file][test].add if is_taken else left.append)(name if is_taken else case)
        whole -= cost * is_taken
    for cost, _, name, (file, test) in left:
        whole -= cost
        if whole < 0:
            break
        found[file][test].add(name)
    return found


class Recorder:
    """Measures the processor time of each case, with the processes that it starts and waits for."""

    def __init__(self) -> None:
        self.started = 0.0
        self.found: dict[tuple[str, str], float] = {}

    @pytest.hookimpl(tryfirst=True)
    def pytest_runtest_logstart(self) -> None:
        self.started = _processor_time()

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_makereport(self, item: pytest.Item, call: pytest.CallInfo[None]) -> Iterator[None]:
        report = yield
        if call.when == "teardown":
            report.cost = (*place_of(item), _processor_time() - self.started)
        return report

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if hasattr(report, "cost"):
            file, name, cost = report.cost
            self.found[file, name] = cost

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        if hasattr(session.config, "workerinput") or not self.found:
            return
        costs: dict[str, dict[str, dict[str, float]]] = defaultdict(lambda: defaultdict(dict))
        for file, tests in read_costs().items():
            for test, cases in tests.items():
                costs[file][test].update(cases)
        for (file, name), cost in self.found.items():
            costs[file][test_of(name)][name] = min(STEPS, key=lambda step: abs(step - cost))
        FILE.write_text(json.dumps(costs, indent=0, sort_keys=True) + "\n", encoding="utf-8", newline="\n")


def _processor_time() -> float:
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system
