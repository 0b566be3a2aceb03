"""Progress of a long command, and the signals that stop it."""

import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

import click

from contoursolve.cli.printing import is_screen, say
from contoursolve.families import THREADS

BETWEEN = 30.0
"""Seconds between two lines about progress where no terminal shows a bar."""

STOPPED = 130
"""Exit status of a command that was told to stop, as shells give it for Ctrl-C."""


@contextmanager
def progress(total: int, *, is_quiet: bool) -> Iterator[Callable[[int], None]]:
    """A function that takes the number of contours just solved. It moves a bar on a terminal, else prints a line on
    standard error now and then, or nothing."""
    begin = told = time.monotonic()
    done = 0
    with click.progressbar(
        length=total,
        label="solving",
        file=sys.stderr,
        hidden=is_quiet or not is_screen(sys.stderr),
        show_pos=True,
        show_eta=True,
        item_show_func=lambda rate: rate,
    ) as bar:

        def advance(rows: int) -> None:
            nonlocal done, told
            done, now = done + rows, time.monotonic()
            rate = done / max(now - begin, 1e-9)
            bar.update(rows, f"{rate:,.0f} a second")
            if not (is_quiet or is_screen(sys.stderr)) and now - told >= BETWEEN and done < total:
                left = duration((total - done) / rate)
                say(f"{done:,} of {total:,} contours, {rate:,.0f} a second, {left} left", err=True)
                told = now

        yield advance


def duration(seconds: float) -> str:
    """A time in the unit that fits: `40 s`, `5 min`, `12 h`, `80 days`."""
    for unit, each, most in (("s", 1, 100), ("min", 60, 100), ("h", 3_600, 48)):
        if seconds < most * each:
            return f"{max(1, round(seconds / each))} {unit}"
    return f"{seconds / 86_400:,.0f} days"


@contextmanager
def stoppable() -> Iterator[None]:
    """Take SIGTERM for Ctrl-C: KeyboardInterrupt."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGTERM, _stop)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)


def _stop(_number: int, _frame: FrameType | None) -> None:
    raise KeyboardInterrupt


def leave_threads(status: int) -> None:
    """End the process now if threads are still solving: Python would wait for them, which may take minutes."""
    if any(thread.name.startswith(THREADS) for thread in threading.enumerate()):
        os._exit(status)
