"""The hook as pre-commit installs it, by the lines of docs/programs.md: a commit waits until the program is mended."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from contoursolve import Diagnostic, Severity, check

pytestmark = [pytest.mark.editor, pytest.mark.needs("pre_commit")]

ROOT = Path(__file__).parents[2]
PUBLISHED = ("contoursolve", "pyproject.toml", "hatch_build.py", "README.md", "LICENSE", ".pre-commit-hooks.yaml")
"""What pip needs of the checkout, which need not be a repository."""


@pytest.fixture
def run(tmp_path: Path):
    """Run a command in a folder, with nobody's own settings of git, and with a store of pre-commit that is new."""
    own = {"GIT_CONFIG_GLOBAL": os.devnull, "PRE_COMMIT_HOME": str(tmp_path / "store"), "GIT_CONFIG_NOSYSTEM": "1"}
    who = {f"GIT_{each}_{what}": "a@b.example" for each in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("GIT_", "PYTHON"))}

    def run(folder: Path, *command: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(command, cwd=folder, env=kept | own | who, capture_output=True, text=True, check=False)

    return run


def errors(program: Path) -> list[Diagnostic]:
    return [each for each in check(program) if each.severity is Severity.ERROR]


def mend(program: Path) -> Iterator[str]:
    """Apply the first fix of each error; a value that is open becomes the one that the fix names."""
    while found := errors(program):
        fix, lines = found[0].fixes[0], program.read_text(encoding="utf-8").split("\n")
        example = re.search(r"add (\S+)\? \(such as (\S+),", fix.description)
        text = fix.replacement.replace(f"{example[1]}?", example[2]) if example else fix.replacement
        lines[found[0].span.line - 1] = text
        program.write_text("\n".join(lines), encoding="utf-8")
        yield text


def test_a_commit_is_stopped_until_the_program_is_mended(tmp_path, run) -> None:
    published, mine = tmp_path / "contoursolve", tmp_path / "mine"
    for folder in (published, mine):
        folder.mkdir()
        assert run(folder, "git", "init", "-q").returncode == 0
    for name in PUBLISHED:
        (shutil.copytree if (ROOT / name).is_dir() else shutil.copy)(ROOT / name, published / name)
    run(published, "git", "add", "-A")
    run(published, "git", "commit", "-q", "-m", "a release")

    page = (ROOT / "docs" / "programs.md").read_text(encoding="utf-8")
    (settings,) = re.findall(r"```yaml\n(repos:.*?)```", page, re.DOTALL)
    (tag,) = re.findall(r"rev: (\S+)", settings)
    assert run(published, "git", "tag", tag).returncode == 0
    (mine / ".pre-commit-config.yaml").write_text(settings.replace("ADDRESS", str(published)), encoding="utf-8")
    program = Path(shutil.copy(ROOT / "notebooks" / "programs" / "shaft_broken.nc", mine))
    assert run(mine, sys.executable, "-m", "pre_commit", "install").returncode == 0
    run(mine, "git", "add", "-A")

    stopped = run(mine, "git", "commit", "-m", "a shaft")
    assert stopped.returncode == 1
    said = stopped.stdout + stopped.stderr
    assert re.findall(r"error\[([\w-]+)\]", said) == [each.code for each in errors(program)]
    assert len([*mend(program)]) == 5
    run(mine, "git", "add", "-A")
    passed = run(mine, "git", "commit", "-m", "a shaft")
    assert passed.returncode == 0, passed.stdout + passed.stderr
    assert re.search(r"contoursolve check\.+Passed", passed.stdout + passed.stderr)
