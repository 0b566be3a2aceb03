"""The command line: arguments in, text or JSON out, exit status 0 (no error found), 1 (errors found), 2."""

from contoursolve.cli.group import main

__all__ = ["main"]
