"""The command line, called in this process."""

import json
from typing import Any

from click.testing import CliRunner, Result

from contoursolve.cli import main

NOSE = ("--tool", "R0.8", "--tip", "3")
COMPENSATED = """\
N1 G21 G40 G18
N5 G00 X40. Z5.
N6 G42 G00 X20. Z2. D1
N10 G01 Z-10. F0.2
N20 X30. Z-20.
N30 Z-30.
N40 G40 X50.
N50 G00 Z100.
"""
"""A lathe's contour with compensation, and the tool that cuts it."""


def call(*words: object, stdin: str | bytes | None = None, **environment: str) -> Result:
    """What a command answers; nothing may ever end in a traceback."""
    done = CliRunner(env=environment).invoke(main, [str(each) for each in words], input=stdin)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exc_info
    assert "Traceback" not in done.output
    return done


def run(*words: object, **more: Any) -> tuple[int, str, str]:
    """Exit status, standard output, standard error."""
    done = call(*words, **more)
    return done.exit_code, done.stdout, done.stderr


def data(*words: object, **more: Any) -> Any:
    """What a command prints as JSON."""
    return json.loads(call(*words, "--format", "json", **more).stdout)


def blocks(*lines: str, start: str | None = None) -> list[str]:
    """The options that stand in for a program."""
    options = [] if start is None else ["--start", start]
    return options + [word for line in lines for word in ("--block", line)]


def block(row: str) -> list[str]:
    """The same of a start and lines in one row: `X40. Z0. / G01 X50. / Z-20.`."""
    start, *lines = row.split(" / ")
    return blocks(*lines, start=start)
