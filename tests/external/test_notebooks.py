"""Every notebook runs in a clean kernel, and shows what this version of the package gives."""

import difflib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from interpreter import RS274
from run_notebooks import CHECKS, NOTEBOOKS

RUNNER = Path(__file__).parent / "run_notebooks.py"
NAMES = ["01", "02", "03", "04", "05", "06", "07", "08", "09", "10", "11", "12", "13"]
MOST_BYTES = 400_000
LINUXCNC = "linuxcnc"
"""The tag of cells that run LinuxCNC's interpreter; without it their outputs are others."""

PAINTED = "image/png"
"""What matplotlib painted: each version of it gives other bytes."""


@pytest.fixture(scope="module")
def executed(request, tmp_path_factory):
    """A folder with every notebook that this run looks at executed again, and what was said of those that failed.
    The kernels run apart from the tests: what Jupyter warns of is no warning of ours."""
    looking = [item for item in request.session.items if "executed" in getattr(item, "fixturenames", ())]
    folder = tmp_path_factory.mktemp("notebooks")
    done = subprocess.run(
        [sys.executable, str(RUNNER), "--into", str(folder), *(str(item.callspec.params["path"]) for item in looking)],
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
        env={**os.environ, "PYTHONIOENCODING": "utf-8"},
    )
    return folder, done.stderr


def read(path):
    return json.loads(path.read_text(encoding="utf-8"))


def shown(notebook, *, with_linuxcnc):
    """What a notebook shows, cell by cell, as lines."""
    for number, cell in enumerate(notebook["cells"], 1):
        is_compared = with_linuxcnc or LINUXCNC not in cell["metadata"].get("tags", ())
        outputs = cell.get("outputs", []) if is_compared else []
        for output in outputs:
            output.get("data", {}).pop(PAINTED, None)
        yield from (f"cell {number}: {line}" for line in json.dumps([cell["source"], outputs], indent=1).splitlines())


def test_there_is_one_notebook_of_each_number():
    assert [path.name[:2] for path in NOTEBOOKS] == NAMES


@pytest.mark.notebook
@pytest.mark.parametrize(
    "path",
    [NOTEBOOKS[0], *(pytest.param(path, marks=pytest.mark.slow) for path in NOTEBOOKS[1:])],
    ids=lambda path: path.stem,
)
def test_a_notebook_runs_and_shows_what_this_version_gives(path, executed):
    folder, errors = executed
    again = folder / path.name
    assert again.exists(), errors
    both = [list(shown(read(each), with_linuxcnc=RS274 is not None)) for each in (path, again)]
    difference = list(difflib.unified_diff(*both, "in the repository", "now", lineterm="", n=1))
    advice = f"python tests/external/run_notebooks.py notebooks/{path.name} writes what is shown now"
    assert not difference, "\n".join(line[:300] for line in [*difference[:60], advice])


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_small_tells_nothing_of_a_machine_is_checked_and_says_what_comes_next(path):
    text, notebook = path.read_text(encoding="utf-8"), read(path)
    assert len(text.encode()) < MOST_BYTES
    code = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert [cell["execution_count"] for cell in code] == list(range(1, len(code) + 1))
    assert len({cell["id"] for cell in notebook["cells"]}) == len(notebook["cells"])
    assert set(notebook["metadata"]) == {"kernelspec", "language_info"}
    assert {output.get("name") for cell in code for output in cell["outputs"]} <= {None, "stdout"}
    assert "\nassert " in (CHECKS / f"check_{path.name[:2]}.py").read_text(encoding="utf-8")
    last = "".join(notebook["cells"][-1]["source"])
    assert "Next" in last
    assert all((path.parent / link).is_file() for link in re.findall(r"\]\((.*?)\)", last))
    rooms = re.findall(r"`((?:contoursolve|tests|notebooks)/[\w./]+)`", text)
    assert all((path.parents[1] / each).exists() for each in rooms), rooms
    assert notebook["cells"][0]["source"][0].startswith("# ")
    assert "?" in "".join(notebook["cells"][0]["source"])
    for private in (str(Path.home()), str(Path.cwd()), " at 0x", "site-packages"):
        assert private not in text
