"""The command line, called in this process."""

import json
from typing import Any

from click.testing import CliRunner, Result

from contoursolve.cli import main


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
