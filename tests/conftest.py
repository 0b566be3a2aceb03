"""What holds for every test: its options, and what it needs besides Python packages."""

import gc
import shutil
import signal
import sys
from collections.abc import Iterator
from importlib import import_module
from importlib.util import find_spec

import pytest
import sampling
from hypothesis import settings

pytest_plugins = ["browsing"]

if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    # A shell ignores interrupts in what it starts in the background, and so would every child of a test.
    signal.signal(signal.SIGINT, signal.default_int_handler)

# For the syntax of IRIs jsonschema builds dozens of parsers when it is imported, which takes seconds. No test has them.
sys.modules.setdefault("rfc3987_syntax", None)

# How many examples a law takes by default, and as a slow test.
settings.register_profile("dev", max_examples=10, deadline=None, derandomize=True)
settings.register_profile("ci", settings.get_profile("dev"), max_examples=20)
settings.load_profile("dev")

PROGRAMS = {
    "interpreter": (("rs274",), "rs274 (Debian: apt-get install linuxcnc-uspace)"),
    "browser": (("chromium", "chromium-browser"), "chromium (Debian: apt-get install chromium)"),
}
"""The programs of which tests with a marker need one, and how to get them."""

SLOW = {"slow", *PROGRAMS, "editor", "notebook", "desktop", "site"}
"""The markers of tests that are not run by default."""

PACKAGES = {
    "browser": ("playwright", "jupyterlab", "ipykernel", "anywidget", "htpy"),
    "desktop": ("PyInstaller", "ezdxf", "htpy", "pygls", "resvg_py", "starlette", "uvicorn"),
    "notebook": ("nbclient", "nbformat", "ipykernel"),
    "site": ("zensical", "mkdocstrings_handlers"),
}
"""The packages that tests with a marker need."""


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("contoursolve")
    group.addoption("--insist", action="store_true", help="fail where a program or a package is missing, not skip")
    group.addoption("--record-costs", action="store_true", help="write what cases cost to tests/durations.json")
    group.addoption("--sarif-schema", metavar="FILE", help="the SARIF 2.1.0 schema, which our output is held against")
    group.addoption("--axe", metavar="FILE", help="axe.min.js of axe-core, by which pages are held to be accessible")
    group.addoption("--code-server", metavar="FOLDER", help="where code-server is, or is to stay for the next time")
    group.addoption("--desktop", metavar="FOLDER", help="where PyInstaller has built the program without Python")
    group.addoption("--pyodide", metavar="FOLDER", help="npm's package pyodide, unpacked, which the page loads")
    group.addoption("--screenshots", metavar="FOLDER", help="where tests with a browser leave what they saw")


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """What collecting makes stays to the end, so no garbage is looked for meanwhile: a fifth of its time."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Cases are slow that the sample by time leaves out."""
    slow = sampling.left_out(sampling.read_costs())
    for item in items:
        marks = {mark.name for mark in item.iter_markers()}
        if not marks & SLOW:
            is_sampled = isinstance(item, pytest.Function) and "boundary" not in marks
            item.stash[sampling.KIND] = sampling.SAMPLED if is_sampled else sampling.ALWAYS
            file, name = sampling.place_of(item)
            if name in slow.get(file, ()):
                item.add_marker("slow")


def pytest_configure(config: pytest.Config) -> None:
    if config.getoption("record_costs"):
        config.pluginmanager.register(sampling.Recorder())


def pytest_runtest_setup(item: pytest.Item) -> None:
    own = {mark.name for mark in item.iter_markers()}
    missing = [advice for marker in own & PROGRAMS.keys() for advice in missing_of(*PROGRAMS[marker])]
    packages = {name for marker in own & PACKAGES.keys() for name in PACKAGES[marker]}
    packages |= {name for mark in item.iter_markers("needs") for name in mark.args}
    missing += [name for name in sorted(packages) if find_spec(name) is None]
    if missing:
        (pytest.fail if item.config.getoption("--insist") else pytest.skip)(f"needs {', '.join(missing)}")


@pytest.fixture
def without_repairs(monkeypatch: pytest.MonkeyPatch) -> None:
    """No repairs are looked for, which takes most of the time of a diagnosis: for tests of what is known besides."""
    from contoursolve.diagnosis.attempt import Repairs  # noqa: PLC0415 - most runs need none of it

    none = Repairs((), is_complete=False)
    monkeypatch.setattr(import_module("contoursolve.diagnosis.diagnose"), "find_repairs", lambda *_: none)


def missing_of(names: tuple[str, ...], advice: str) -> list[str]:
    return [] if any(map(shutil.which, names)) else [advice]
