"""Starts the command `contoursolve`, also as `python -m contoursolve`."""

import atexit
import gc


def main() -> None:
    """Run the command in a process of its own.

    A run makes no reference cycles to speak of and then ends: looking for them would take a third of its time, at
    the imports, in between, and once more at the end.
    """
    gc.disable()
    atexit.register(gc.freeze)
    from contoursolve.cli import main as command  # noqa: PLC0415 - after the collector is off

    command(prog_name="contoursolve")


if __name__ == "__main__":
    main()
