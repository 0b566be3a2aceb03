"""The text of programs: files and bytes as they come from controls, tapes and DOS."""

import errno
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

from contoursolve.diagnostics import UserError
from contoursolve.gcode.late_pattern import late_pattern

STANDARD_INPUT = "-"


class UnreadableProgramError(UserError, ValueError):
    """A file that is missing, is no file, or is no program; the message says which."""


@contextmanager
def opening(path: str, wanted: str) -> Iterator[None]:
    """Context in which a file is opened. Raises UnreadableProgramError if that fails; `wanted` names the expected
    content."""
    try:
        yield
    except FileNotFoundError:
        # What leads nowhere may be a block.
        advice = f'; a block is given by --block "{path}"' if _BLOCK.match(path) else ""
        raise UnreadableProgramError(f"{path}: no such file{advice}") from None
    except (OSError, ValueError) as error:
        if _is_folder(path):  # Windows answers "permission denied" for a directory
            raise UnreadableProgramError(f"{path} is a directory, not {wanted}") from None
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise UnreadableProgramError(f"{path} cannot be read: {reason}") from None


def _is_folder(path: str) -> bool:
    try:
        return Path(path).is_dir()
    except ValueError:  # a name with a NUL
        return False


_BLOCK = late_pattern(r"(?:[Nn]\d+ ?)?[Gg]\d+ ?[A-Za-z,]|[A-Za-z],?-?\d+\.? [A-Za-z,]")
"""Beginning of a block."""


def read_bytes(path: str, wanted: str = "a file") -> bytes:
    """The bytes of a file; `-` is standard input. Raises UnreadableProgramError; `wanted` is what should be there."""
    with opening(path, wanted):
        return standard_input().read() if path == STANDARD_INPUT else Path(path).read_bytes()


def standard_input() -> BinaryIO:
    """The bytes of standard input. Raises OSError if it is closed."""
    if sys.stdin is None or sys.stdin.closed:
        raise OSError(errno.EBADF, "standard input is closed")
    return sys.stdin.buffer
