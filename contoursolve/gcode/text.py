"""The text of programs: files and bytes as they come from controls, tapes and DOS."""

import errno
import re
import sys
from pathlib import Path
from typing import BinaryIO

from contoursolve.diagnostics.errors import UserError

STANDARD_INPUT = "-"


class UnreadableProgramError(UserError, ValueError):
    """A file that is missing, is no file, or is no program; the message says which."""


def no_such_file(name: str) -> str:
    """What to say of a name that leads nowhere, which may be a block."""
    is_block = _BLOCK.match(name) is not None
    return f"{name}: no such file" + (f'; a block is given by --block "{name}"' if is_block else "")


_BLOCK = re.compile(r"(?:[Nn]\d+ ?)?[Gg]\d+ ?[A-Za-z,]|[A-Za-z],?-?\d+\.? [A-Za-z,]")
"""How a block begins."""


def read_bytes(path: str, wanted: str = "a file") -> bytes:
    """The bytes of a file; `-` is standard input. Raises UnreadableProgramError; `wanted` is what should be there."""
    try:
        return standard_input().read() if path == STANDARD_INPUT else Path(path).read_bytes()
    except FileNotFoundError:
        raise UnreadableProgramError(no_such_file(path)) from None
    except (OSError, ValueError) as error:
        if is_folder(path):  # Windows answers "permission denied" for a directory
            raise UnreadableProgramError(f"{path} is a directory, not {wanted}") from None
        raise UnreadableProgramError(f"{path} cannot be read: {reason_of(error)}") from None


def standard_input() -> BinaryIO:
    """The bytes of standard input. Raises OSError if it is closed."""
    if sys.stdin is None or sys.stdin.closed:
        raise OSError(errno.EBADF, "standard input is closed")
    return sys.stdin.buffer


def reason_of(error: OSError | ValueError) -> str:
    """Why a file cannot be read, in the words of the system."""
    return (error.strerror if isinstance(error, OSError) else None) or str(error)


def is_folder(path: str) -> bool:
    """Whether a name is that of a directory."""
    try:
        return Path(path).is_dir()
    except ValueError:  # a name with a NUL
        return False
