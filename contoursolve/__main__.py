"""Starts the command `contoursolve`, also as `python -m contoursolve`."""

import atexit
import errno
import gc
import io
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

if TYPE_CHECKING:
    import click
    from _typeshed import ReadableBuffer


_THREADS = (
    "OPENBLAS_NUM_THREADS",
    "GOTO_NUM_THREADS",
    "OMP_NUM_THREADS",
    "MKL_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)
"""Variables by which users tell NumPy's linear algebra how many threads to take."""


class _Pipe(io.FileIO):
    """An output whose reader may leave before the end, as `head` does: what follows goes nowhere, so that the exit
    status never depends on who reads how much."""

    def write(self, data: "ReadableBuffer", /) -> int:
        try:
            return super().write(data)
        except OSError as error:
            # Windows says "invalid argument" of a pipe that is closed.
            if error.errno != errno.EPIPE and not (sys.platform == "win32" and error.errno == errno.EINVAL):
                raise
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, self.fileno())
        os.close(nowhere)
        return memoryview(data).nbytes


def _open_pipe(stream: TextIO | None) -> TextIO:
    """The stream as one whose reader may leave; a terminal stays as it is, and what is closed leads nowhere."""
    if stream is None:
        return Path(os.devnull).open("w", encoding="utf-8")
    if not isinstance(stream, io.TextIOWrapper) or stream.isatty():
        return stream
    stream.flush()
    pipe = io.BufferedWriter(_Pipe(stream.fileno(), "w", closefd=False))
    return io.TextIOWrapper(
        pipe, stream.encoding, stream.errors, line_buffering=stream.line_buffering, write_through=stream.write_through
    )


def commands() -> "click.Group":
    """The command `contoursolve`: the command line, and the language server and the workbench beside it."""
    from contoursolve.cli import main as command  # noqa: PLC0415 - after the collector is off
    from contoursolve.lsp import lsp  # noqa: PLC0415 - as above
    from contoursolve.workbench import serve  # noqa: PLC0415 - as above

    command.add_command(lsp)
    command.add_command(serve)
    return command


def main() -> None:
    """Run the command in a process of its own.

    A run makes no reference cycles to speak of and then ends: looking for them would take a third of its time, at
    the imports, in between, and once more at the end.
    """
    gc.disable()
    atexit.register(gc.freeze)
    if not any(os.environ.get(name) for name in _THREADS):
        # The matrices of contours are small: more threads of NumPy's would wait for each other, each on a core of its
        # own, as long as the command runs. Rows of families have threads of their own.
        os.environ["OPENBLAS_NUM_THREADS"] = os.environ["MKL_NUM_THREADS"] = "1"
    try:
        command = commands()
        sys.stdout, sys.stderr = _open_pipe(sys.stdout), _open_pipe(sys.stderr)
        command(prog_name="contoursolve")
    except KeyboardInterrupt:
        # Before the command has begun, or after its end.
        sys.exit(130)
    except OSError as error:
        # A full disk behind the output; what is left in its buffer goes nowhere, or Python complains at the end.
        sys.stderr.write(f"Error: the output cannot be written: {error.strerror}\n")
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(2)
    except Exception as error:
        if os.environ.get("CONTOURSOLVE_DEBUG"):
            raise
        sys.stderr.write(fault_text(error))
        sys.exit(2)


def fault_text(error: Exception) -> str:
    """The sentence about a fault of our own, with how to report it."""
    from contoursolve import __version__  # noqa: PLC0415 - hardly ever needed

    what = " ".join(f"{type(error).__name__} {error}".split())[:200]
    return (
        f"Error: a fault of contoursolve {__version__} ended this run: {what}. Please report it, with the command and "
        "the program; CONTOURSOLVE_DEBUG=1 shows where it is\n"
    )


if __name__ == "__main__":
    main()
