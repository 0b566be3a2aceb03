"""Programs as files: read as a stream whatever their encoding, and written whole or not at all."""

import io
import os
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from itertools import count
from pathlib import Path
from typing import BinaryIO

from msgspec import Struct

from contoursolve.diagnostics import UserError
from contoursolve.gcode.decoding import encoding_of
from contoursolve.gcode.text import (
    MOST_OF_PROGRAM,
    STANDARD_INPUT,
    UnreadableProgramError,
    check_size,
    open_regular,
    opening,
    standard_input,
)

ENDINGS = (
    *(".nc", ".ngc", ".cnc", ".tap", ".mpf", ".spf", ".arc", ".eia", ".min", ".h", ".gcode", ".iso"),
    *(".prg", ".pim", ".din", ".dnc", ".xpi", ".ncc"),
)
"""Endings of files that are programs."""
SHARED_ENDINGS = (".txt", ".sub", ".i", ".", "")
"""Endings of programs that many other files have, too."""

_CHUNK = 1 << 20
_IN_MEMORY = 1 << 22
"""Bytes of standard input that are held in memory."""


class CannotWriteError(UserError, ValueError):
    """A target that cannot be written; the message says why and what to do."""


class OpenFile(Struct, frozen=True):
    """An open program: its name, its bytes, how many there are, and how they are to be read."""

    name: str
    data: BinaryIO
    size: int
    encoding: str
    mark: bytes
    """The byte order mark that it begins with, if any."""
    stamp: object = None
    """Mark that changes when the file is changed after it was opened; None if there is no file."""
    errors: str = "strict"
    """Treatment of bytes that the encoding does not know, as `codecs` names it."""

    def lines(self) -> Iterator[str]:
        """Its lines from the first, each with its end, one at a time. Raises UnreadableProgramError at the last one if
        the file was changed since it was opened."""
        self.data.seek(len(self.mark))
        text = io.TextIOWrapper(self.data, self.encoding, self.errors, newline="")
        try:
            for line in text:  # noqa: UP028 - `yield from` would close the file when it is not read to its end
                yield line
            if self.stamp is not None and _stamp_of(self.data) != self.stamp:
                raise UnreadableProgramError(f"{self.name} was changed while it was read; start again")
        finally:
            if not self.data.closed:
                text.detach()

    def encode(self, text: str) -> bytes:
        """The bytes of a text that takes the place of its lines. Remarks may quote a fact of the command line, with
        characters that the program's encoding lacks; they become question marks."""
        return text.encode(self.encoding, "replace" if self.errors == "strict" else self.errors)

    def read(self) -> str:
        """All of it."""
        self.data.seek(len(self.mark))
        return self.data.read().decode(self.encoding, self.errors)

    @property
    def share(self) -> float:
        """The part of it that has been read, from 0 to 1."""
        return self.data.tell() / self.size if self.size else 1.0


@contextmanager
def open_program_file(path: str | Path) -> Iterator[OpenFile]:
    """Open a file of UTF-8 or Latin-1 text; `-` is standard input.

    Raises UnreadableProgramError if there is no such file, or it is no program.
    """
    name = str(path)
    with opening(name, "a program file"):
        data = _spool() if name == STANDARD_INPUT else open_regular(path, MOST_OF_PROGRAM)
    with data:
        stamp = _stamp_of(data) if name != STANDARD_INPUT else None
        encoding, mark = encoding_of(iter(partial(data.read, _CHUNK), b""), name)
        size = data.seek(0, os.SEEK_END)
        yield OpenFile("<standard input>" if name == STANDARD_INPUT else name, data, size, encoding, mark, stamp)


def _stamp_of(data: BinaryIO) -> object:
    """The size of an open file and when it was written last; None for what is in memory."""
    try:
        status = os.fstat(data.fileno())
    except OSError:  # as in memory
        return None
    return status.st_size, status.st_mtime_ns


@contextmanager
def program_file_of(text: str, name: str) -> Iterator[OpenFile]:
    """A text as if it were in a file."""
    try:
        data = text.encode("utf-8", "surrogateescape")
    except UnicodeEncodeError:
        raise UnreadableProgramError(f"{name} is not text") from None
    # A terminal's bytes need not be UTF-8.
    encoding, _ = encoding_of([data], name)
    yield OpenFile(name, io.BytesIO(data), len(data), encoding, b"")


def file_in_memory(text: str, name: str) -> OpenFile:
    """Any text as if it were in a file; its bytes are in `ANY_TEXT`."""
    data = text.encode(*ANY_TEXT)
    return OpenFile(name, io.BytesIO(data), len(data), ANY_TEXT[0], b"", errors=ANY_TEXT[1])


ANY_TEXT = ("utf-8", "surrogatepass")
"""An encoding of every text that Python holds."""


def _spool() -> BinaryIO:
    """Standard input as a file that can be read twice."""
    from tempfile import SpooledTemporaryFile  # noqa: PLC0415 - most programs are files

    copy = SpooledTemporaryFile(_IN_MEMORY)  # noqa: SIM115 - the caller closes it
    data = standard_input()
    while chunk := data.read(_CHUNK):
        copy.write(chunk)
        check_size(copy.tell(), MOST_OF_PROGRAM)
    copy.seek(0)
    return copy  # type: ignore[return-value]


def check_target(target: Path, source: Path | None, *, is_forced: bool) -> None:
    """Raise CannotWriteError if a file exists and may not be replaced, or cannot be written at all."""
    _resolve(target)
    if target.is_dir():
        raise CannotWriteError(f"{target} is a directory; name a file")
    if not target.parent.is_dir():
        raise CannotWriteError(f"{target.parent} is no directory; make it first")
    if target.exists():
        if source is not None and source.exists() and target.samefile(source):
            raise CannotWriteError(f"{target} is the program itself; write to another file")
        if not target.is_file():
            raise CannotWriteError(f"{target} is not a regular file")
        if not is_forced:
            raise CannotWriteError(f"{target} exists; give --force to replace it")
        check_unprotected(target)


def check_unprotected(target: Path) -> None:
    """Raise CannotWriteError if a file is write-protected: it would be replaced all the same."""
    try:
        mode = target.stat().st_mode
    except (OSError, ValueError):
        return
    if stat.S_ISREG(mode) and (not mode & _WRITABLE or not os.access(target, os.W_OK)):
        raise CannotWriteError(f"{target} is write-protected; make it writable, or write to another file")


_WRITABLE = stat.S_IWUSR | stat.S_IWGRP | stat.S_IWOTH
"""Permissions of which a file that is not write-protected has one, on Windows too."""


def _resolve(target: Path) -> Path:
    """The file that a name leads to, which need not exist. Raises CannotWriteError for a link to itself."""
    try:
        target.stat()
    except FileNotFoundError:
        pass
    except OSError as error:
        raise CannotWriteError(f"{target} cannot be written: {error.strerror}") from None
    except ValueError as error:  # a name with a NUL
        raise CannotWriteError(f"{target} cannot be written: {error}") from None
    return target.resolve()


def write_whole(target: Path, pieces: Iterable[bytes], *, keeps_backup: bool) -> Path | None:
    """Write a file so that at any moment it is either the old one or the whole new one; returns where the old one is
    kept. Raises CannotWriteError."""
    with open_whole(target, keeps_backup=keeps_backup) as whole:
        for piece in pieces:
            whole.file.write(piece)
    return whole.backup


class Whole(Struct):
    """A file on its way to a target: what to write to, and afterwards where the old one is kept, if it is."""

    file: BinaryIO
    backup: Path | None = None


@contextmanager
def open_whole(target: Path, *, temporary: Path | None = None, keeps_backup: bool = False) -> Iterator[Whole]:
    """Open a file that takes the place of a target once all of it is written, with the target's permissions; where
    that is a link, what it leads to is replaced. Raises CannotWriteError.

    `temporary` is where it is until then, on the same disk; without it, beside the target under a name of its own.
    """
    import shutil  # noqa: PLC0415 - most commands write nothing

    real = _resolve(target)
    check_unprotected(real)
    temporary = temporary or real.with_name(f".{real.name}.{os.urandom(4).hex()}.tmp")
    whole = None
    try:
        try:
            with temporary.open("xb") as file:
                whole = Whole(file)
                yield whole
                file.flush()
                os.fsync(file.fileno())
            if real.exists():
                shutil.copymode(real, temporary)
                whole.backup = _back_up(real) if keeps_backup else None
            temporary.replace(real)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        left = f"; {whole.backup} is a copy of it" if whole and whole.backup else ""
        raise CannotWriteError(f"{target} cannot be written: {error.strerror or error}{left}") from error


def _back_up(file: Path) -> Path:
    """A whole copy beside a file, under the first name that is free: .bak, .bak2, ..."""
    import shutil  # noqa: PLC0415 - most commands write nothing

    copy = file.with_name(f".{file.name}.{os.urandom(4).hex()}.bak.tmp")
    try:
        with copy.open("xb") as target, file.open("rb") as original:
            shutil.copyfileobj(original, target)
            target.flush()
            os.fsync(target.fileno())
        shutil.copystat(file, copy)
        for number in count(1):
            backup = file.with_name(f"{file.name}.bak{number if number > 1 else ''}")
            if not backup.exists() and _take_name(copy, backup):
                return backup
    finally:
        copy.unlink(missing_ok=True)
    raise AssertionError("there is always a free number")


def _take_name(file: Path, name: Path) -> bool:
    """Give a file another name, unless somebody has just taken that."""
    try:
        os.link(file, name)
    except FileExistsError:
        return False
    except (OSError, NotImplementedError):  # a file system without links
        file.rename(name)
    return True
