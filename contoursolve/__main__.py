"""Starts the command `contoursolve`, also as `python -m contoursolve`."""

import atexit
import gc
import os
import sys


def main() -> None:
    """Run the command in a process of its own.

    A run makes no reference cycles to speak of and then ends: looking for them would take a third of its time, at
    the imports, in between, and once more at the end.
    """
    gc.disable()
    atexit.register(gc.freeze)
    from contoursolve.cli import main as command  # noqa: PLC0415 - after the collector is off

    try:
        command(prog_name="contoursolve")
    except OSError as error:
        # A full disk behind the output; what is left in its buffer goes nowhere, or Python complains at the end.
        sys.stderr.write(f"Error: the output cannot be written: {error.strerror}\n")
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(2)


if __name__ == "__main__":
    main()
