"""The page of the workbench that the package holds is what its sources give, byte for byte."""

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "contoursolve" / "workbench" / "page"
SECONDS = 300

pytestmark = pytest.mark.slow


def test_the_sources_give_the_page_byte_for_byte(request, tmp_path) -> None:
    npm = shutil.which("npm")
    if npm is None:
        (pytest.fail if request.config.getoption("--insist") else pytest.skip)("needs npm")
    sources = tmp_path / "editors" / "workbench"
    shutil.copytree(ROOT / "editors" / "workbench", sources, ignore=shutil.ignore_patterns("node_modules"))
    notebook = tmp_path / "contoursolve" / "notebook"
    notebook.mkdir(parents=True)
    for name in ("explorer.js", "explorer.css"):
        shutil.copy(ROOT / "contoursolve" / "notebook" / name, notebook)
    for command in (["ci", "--no-audit", "--no-fund"], ["run", "check"], ["run", "build"]):
        done = subprocess.run(
            [npm, *command], cwd=sources, capture_output=True, text=True, timeout=SECONDS, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
    built = tmp_path / "contoursolve" / "workbench" / "page"
    assert sorted(each.name for each in built.iterdir()) == sorted(each.name for each in PAGE.iterdir())
    for each in built.iterdir():
        assert each.read_bytes() == (PAGE / each.name).read_bytes(), f"{each.name}: run npm run build in {sources.name}"
