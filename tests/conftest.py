"""What holds for every test: its options, and what it needs besides Python packages."""

import shutil
import signal
import sys
from collections import defaultdict
from importlib.util import find_spec
from zlib import crc32

import pytest
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
    group.addoption("--one-in", metavar="N", type=int, help="of a test with many slow cases, run one in N of these")
    group.addoption("--sarif-schema", metavar="FILE", help="the SARIF 2.1.0 schema, which our output is held against")
    group.addoption("--axe", metavar="FILE", help="axe.min.js of axe-core, by which pages are held to be accessible")
    group.addoption("--code-server", metavar="FOLDER", help="where code-server is, or is to stay for the next time")
    group.addoption("--desktop", metavar="FOLDER", help="where PyInstaller has built the program without Python")
    group.addoption("--pyodide", metavar="FOLDER", help="npm's package pyodide, unpacked, which the page loads")
    group.addoption("--screenshots", metavar="FOLDER", help="where tests with a browser leave what they saw")


QUICK_CASES = 1
"""Of the cases of a test, so many are run by default, drawn by their names; the others are slow."""

SAMPLED = ({"slow"}, {"interpreter"}, {"slow", "interpreter"}, {"slow", "browser"})
"""The markers of the tests of whose cases `--one-in` takes a share."""


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    quick, slow = defaultdict(list), defaultdict(list)
    for item in items:
        if isinstance(item, pytest.Function):
            own = {mark.name for mark in item.iter_markers()} & SLOW
            if not own:
                quick[item.path, item.originalname].append(item)
            elif own in SAMPLED:
                slow[item.path, item.originalname].append(item)
    for name, cases in quick.items():
        for item in sorted(cases, key=drawn)[QUICK_CASES:]:
            item.add_marker("slow")
            slow[name].append(item)
    if one_in := config.getoption("--one-in"):
        left = {item for cases in slow.values() for item in sorted(cases, key=drawn)[max(1, len(cases) // one_in) :]}
        config.hook.pytest_deselected(items=[item for item in items if item in left])
        items[:] = [item for item in items if item not in left]


def drawn(item: pytest.Item) -> int:
    """A number by which cases are drawn: of the name, so that it is the same wherever they are drawn."""
    return crc32(item.name.encode())


def pytest_runtest_setup(item: pytest.Item) -> None:
    own = {mark.name for mark in item.iter_markers()}
    missing = [advice for marker in own & PROGRAMS.keys() for advice in missing_of(*PROGRAMS[marker])]
    packages = {name for marker in own & PACKAGES.keys() for name in PACKAGES[marker]}
    packages |= {name for mark in item.iter_markers("needs") for name in mark.args}
    missing += [name for name in sorted(packages) if find_spec(name) is None]
    if missing:
        (pytest.fail if item.config.getoption("--insist") else pytest.skip)(f"needs {', '.join(missing)}")


def missing_of(names: tuple[str, ...], advice: str) -> list[str]:
    return [] if any(map(shutil.which, names)) else [advice]
