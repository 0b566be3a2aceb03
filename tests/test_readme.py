"""The README shows what the commands print."""

import re
import shlex
from pathlib import Path

import pytest
from click.testing import CliRunner

from contoursolve.cli import main

README = (Path(__file__).parent.parent / "README.md").read_text(encoding="utf-8")
SHOWN = re.findall(r"^    \$ contoursolve (.*)\n((?:    .*\n|\n(?=    (?!\$)))*)", README, re.MULTILINE)


def test_the_readme_shows_commands() -> None:
    assert len(SHOWN) >= 2


@pytest.mark.parametrize(("command", "output"), SHOWN)
def test_a_command_prints_what_the_readme_shows(command: str, output: str) -> None:
    printed = CliRunner().invoke(main, shlex.split(command)).output
    assert [line.removeprefix("    ") for line in output.rstrip().split("\n")] == printed.rstrip().split("\n")


def test_the_code_of_the_readme_runs() -> None:
    for code in re.findall(r"```python\n(.*?)```", README, re.DOTALL):
        exec(compile(code, "README.md", "exec"), {})
