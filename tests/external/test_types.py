"""A user's script passes type checkers: what the public functions take and give back has types, and runs so."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow
ROOT = Path(__file__).parents[2]
SCRIPT = Path(__file__).with_name("typed_user.py")
WRONG = """
import contoursolve
contoursolve.solve("", units="cm")
contoursolve.ranges("", "P", rules="strict")
contoursolve.family("", vary={"P": [1]}, control="fanuc")
contoursolve.solve("", statr="X40. Z0.")
contoursolve.system("").equations.end
contoursolve.solve("").answers[0].contour.end
"""


def told_by(checker: str, *arguments: str) -> list[str]:
    """The lines in which a type checker says what is wrong."""
    command = [sys.executable, "-m", checker, *arguments]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert not done.stderr
    return [line for line in done.stdout.splitlines() if "error:" in line or " - error: " in line]


def wrong_lines(told: list[str]) -> set[str]:
    """The lines of the script that something is wrong with; of several forms of a function, each says so."""
    return {re.search(r"\.py:(\d+)", line)[1] for line in told}  # type: ignore[index]


@pytest.fixture
def wrong(tmp_path: Path) -> Path:
    path = tmp_path / "wrong.py"
    path.write_text(WRONG, encoding="utf-8")
    return path


@pytest.mark.needs("xarray")
def test_the_script_runs() -> None:
    done = subprocess.run([sys.executable, SCRIPT], cwd=ROOT, capture_output=True, text=True, check=True)
    assert "fanuc-lathe" in done.stdout


@pytest.mark.needs("mypy")
def test_mypy_understands_every_line_and_sees_what_is_wrong(wrong: Path) -> None:
    assert told_by("mypy", "--strict", str(SCRIPT)) == []
    assert len(wrong_lines(told_by("mypy", "--strict", str(wrong)))) == WRONG.count("contoursolve.")


@pytest.mark.needs("basedpyright")
def test_pyright_understands_every_line_and_sees_what_is_wrong(wrong: Path, tmp_path: Path) -> None:
    """As basedpyright, whose package brings all that it needs."""
    settings = {
        "typeCheckingMode": "strict",
        "extraPaths": [str(ROOT)],
        "include": [str(SCRIPT)],
        "pythonVersion": "3.11",
    }
    config = tmp_path / "pyrightconfig.json"
    config.write_text(json.dumps(settings), encoding="utf-8")
    told = told_by("basedpyright", "-p", str(config), "--pythonpath", sys.executable)
    assert told == []
    config.write_text(
        json.dumps(settings | {"typeCheckingMode": "standard", "include": [str(wrong)]}), encoding="utf-8"
    )
    found = wrong_lines(told_by("basedpyright", "-p", str(config), "--pythonpath", sys.executable))
    assert len(found) == WRONG.count("contoursolve.")
