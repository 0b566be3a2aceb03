"""The text of programs: files and bytes as they come from controls, tapes and DOS."""

import errno
import os
import stat
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

from contoursolve.diagnostics import UserError, did_you_mean
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
        advice = f'; a block is given by --block "{path}"' if _BLOCK.match(path) else _where_it_may_be(Path(path))
        raise UnreadableProgramError(f"{path}: no such file{advice}") from None
    except (OSError, ValueError) as error:
        if _is_folder(path):  # Windows answers "permission denied" for a directory
            raise UnreadableProgramError(f"{path} is a directory, not {wanted}") from None
        reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        raise UnreadableProgramError(f"{path} cannot be read: {reason}") from None


def _where_it_may_be(path: Path) -> str:
    """Advice where a file is missing: that there is no such folder, or the files there with such an ending."""
    try:
        if not path.parent.is_dir():
            return f"; there is no folder {path.parent}"
        names = sorted(each.name for each in path.parent.iterdir() if each.suffix == path.suffix and each.is_file())
    except (OSError, ValueError):  # a folder that cannot be read, a name with a NUL
        return ""
    hint = did_you_mean(path.name, names).strip()
    if hint:
        return f"; {hint}"
    where = "this folder" if path.parent == Path() else str(path.parent)
    if not names:
        return f"; {where} has no file that ends in {path.suffix}" if path.suffix else ""
    rest = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
    return f"; {where} has {', '.join(names[:_SHOWN])}{rest}"


_SHOWN = 4
"""Names of files that an error lists."""


def _is_folder(path: str) -> bool:
    try:
        return Path(path).is_dir()
    except ValueError:  # a name with a NUL
        return False


_BLOCK = late_pattern(r"(?:[Nn]\d+ ?)?[Gg]\d+ ?[A-Za-z,]|[A-Za-z],?-?\d+\.? [A-Za-z,]")
"""Beginning of a block."""


_DEEP = late_pattern(r"""(?m:^|[\[{,])[ \t]*(?:(?>[\w-]+|"[^"\n]*"|'[^'\n]*')[ \t]*\.[ \t]*){9}""")
"""A key of TOML with more than 8 dots: of one with thousands, a reader takes gigabytes."""


def read_toml(text: str, parse_float: Callable[[str], Any] = float) -> dict[str, Any]:
    """The tables of a TOML file. Raises ValueError, or RecursionError where brackets are nested too deeply."""
    import tomllib  # noqa: PLC0415 - most runs read no such file

    deep = _DEEP.search(text)
    if deep is not None:
        line = text.count("\n", 0, deep.end()) + 1
        raise ValueError(f"a key has more than 8 dots (at line {line})")
    return tomllib.loads(text, parse_float=parse_float)


MOST_OF_PROGRAM, MOST_OF_OTHERS = 100_000_000, 20_000_000
"""Bytes of a program, and of a file of any other kind, that are read: a hundred times what the largest ones have."""


def read_bytes(path: str, wanted: str = "a file", most: int = MOST_OF_OTHERS) -> bytes:
    """The bytes of a file; `-` is standard input. Raises UnreadableProgramError, also for more than `most` bytes;
    `wanted` is what should be there."""
    with opening(path, wanted):
        if path != STANDARD_INPUT:
            with open_regular(path, most) as file:
                return file.read(most)
        data = standard_input().read(most + 1)
        check_size(len(data), most)
        return data


def open_regular(path: str | Path, most: int) -> BinaryIO:
    """A file, open for reading. Raises OSError for what is no regular file, of which nobody knows whether it ever ends,
    and for one of more than `most` bytes."""
    mode = Path(path).stat().st_mode
    if stat.S_ISDIR(mode):
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
    if not stat.S_ISREG(mode):
        raise OSError(errno.EINVAL, "it is a pipe or a device, not a file; give its text on standard input, as -")
    file = Path(path).open("rb")  # noqa: SIM115 - the caller closes it
    try:
        check_size(os.fstat(file.fileno()).st_size, most)
    except OSError:
        file.close()
        raise
    return file


_MEGABYTE = 1_000_000


def check_size(size: int, most: int) -> None:
    """Raise OSError for more bytes than are read."""
    if size > most:
        told = f"{most // _MEGABYTE} MB" if most >= _MEGABYTE else f"{most:,} bytes"
        raise OSError(errno.EFBIG, f"it has more than {told}, and no more are read")


def standard_input() -> BinaryIO:
    """The bytes of standard input. Raises OSError if it is closed."""
    if sys.stdin is None or sys.stdin.closed:
        raise OSError(errno.EBADF, "standard input is closed")
    return sys.stdin.buffer
