"""A plugin of pytest: which lines of the package each case reaches, or which cases run, and in which order.

`REACH` names the folder where the lines are kept; `CHOSEN` names a file of cases to run, nearest first.
"""

import os
from collections.abc import Iterator
from pathlib import Path

import coverage
import pytest

RUN = """\
[run]
source_pkgs = contoursolve
data_file = {folder}/reached
parallel = true
patch = subprocess
sigterm = true
context = ${{REACH_CASE-}}
disable_warnings = no-data-collected, module-not-imported, dynamic-conflict, couldnt-parse
"""


def case_id(item: pytest.Item) -> str:
    """The name of a case, which can stand on a line."""
    return item.nodeid.encode("unicode_escape").decode("ascii")


class Reached:
    """Keeps the lines that a case reaches, also in the processes that it starts."""

    def __init__(self, folder: Path) -> None:
        settings = folder / "coverage.ini"
        if not settings.exists():
            settings.write_text(RUN.format(folder=folder.as_posix()), encoding="utf-8")
        self.coverage = coverage.Coverage(config_file=str(settings), data_suffix=True)
        self.coverage.start()

    @pytest.hookimpl(wrapper=True, tryfirst=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Iterator[None]:
        os.environ["REACH_CASE"] = case_id(item)
        self.coverage.switch_context(case_id(item))
        result = yield
        self.coverage.switch_context("")
        return result

    def pytest_unconfigure(self) -> None:
        self.coverage.stop()
        self.coverage.save()


class Chosen:
    """Runs the cases that a file names, in its order."""

    def __init__(self, file: Path) -> None:
        self.order = {name: place for place, name in enumerate(file.read_text(encoding="utf-8").splitlines())}

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, config: pytest.Config, items: list[pytest.Item]) -> None:
        left = [item for item in items if case_id(item) not in self.order]
        config.hook.pytest_deselected(items=left)
        items[:] = sorted((item for item in items if case_id(item) in self.order), key=self._place)

    def _place(self, item: pytest.Item) -> int:
        return self.order[case_id(item)]


def pytest_configure(config: pytest.Config) -> None:
    is_controller = bool(config.getoption("numprocesses", None)) and not hasattr(config, "workerinput")
    if (folder := os.environ.get("REACH")) and not is_controller:
        config.pluginmanager.register(Reached(Path(folder)))
    if file := os.environ.get("CHOSEN"):
        config.pluginmanager.register(Chosen(Path(file)))
