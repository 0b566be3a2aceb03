"""The files of one folder: names only inside it, read as they are, and written whole or not at all."""

import hashlib
import re
from collections.abc import Iterator
from pathlib import Path

from msgspec import Struct

from contoursolve.diagnostics import UserError
from contoursolve.gcode import ENDINGS, SHARED_ENDINGS, CannotWriteError, decode, encoding_of, open_whole

MOST_BYTES = 10_000_000
"""Of a file that is opened."""

MOST_NAMES = 2_000
"""Files of a folder that are listed."""

_SUFFIXES = (*ENDINGS, *SHARED_ENDINGS, ".toml", ".json", ".dxf")
"""Endings of programs, sketches and drawings."""

_LONGEST = 200
_DEVICE = re.compile(r"(?:con|prn|aux|nul|com[0-9¹²³]|lpt[0-9¹²³]|conin\$|conout\$)[ .]*(?:\..*)?", re.IGNORECASE)
"""Names that are devices for Windows, whatever their endings."""

_FORBIDDEN = re.compile(r'[\0-\x1f\x7f"*/:<>?\\|]')


class FileRefusedError(UserError, ValueError):
    """A file that is not opened or not written; the message says why and what to do."""


class FileConflictError(FileRefusedError):
    """A file that somebody else has changed; `mark` is that of its bytes now."""

    def __init__(self, message: str, mark: str) -> None:
        super().__init__(message)
        self.mark = mark


class FileText(Struct, frozen=True):
    """The text of a file, and all that is needed to write another one in its place: the encoding with its byte order
    mark, and the mark of the bytes that were there (empty where there is no file)."""

    name: str
    text: str
    encoding: str = "utf-8"
    order_mark: bytes = b""
    mark: str = ""

    def encode(self, text: str) -> bytes:
        """The bytes of a text that takes its place. Raises FileRefusedError for a character that they cannot hold."""
        try:
            return self.order_mark + text.encode(self.encoding)
        except UnicodeEncodeError as error:
            line = text.count("\n", 0, error.start) + 1
            what = ascii(text[error.start])[1:-1] if not text[error.start].isprintable() else text[error.start]
            raise FileRefusedError(
                f"{self.name} was not saved: line {line} has the character {what}, which {ENCODINGS[self.encoding]} "
                "lacks; write it in other characters"
            ) from None


ENCODINGS = {"utf-8": "UTF-8", "latin-1": "the file's encoding (Latin-1)"}


def mark_of(data: bytes) -> str:
    """The mark that tells bytes from others."""
    return hashlib.sha256(data).hexdigest()[:32]


def text_of(data: bytes, name: str, *, is_file: bool = True) -> FileText:
    """The text of a file's bytes. Raises UnreadableProgramError for what is no program, FileRefusedError for too many
    bytes."""
    if len(data) > MOST_BYTES:
        raise FileRefusedError(
            f"{name} has {len(data):,} bytes, and {MOST_BYTES:,} can be opened here; "
            "use contoursolve check on the command line"
        )
    encoding, order_mark = encoding_of([data], name)
    return FileText(name, decode(data, name), encoding, order_mark, mark_of(data) if is_file else "")


class Folder:
    """The files of one folder. What is written is told apart from what somebody else writes by the marks of bytes."""

    def __init__(self, path: Path) -> None:
        self.path = path

    @property
    def name(self) -> str:
        """Its name, without where it is."""
        return self.path.resolve().name or str(self.path.resolve())

    def names(self) -> tuple[list[dict[str, object]], int]:
        """The programs with their sizes, by name; and the number of those left out. Raises FileRefusedError."""
        try:
            found = sorted(self._found(), key=lambda each: str(each["name"]).lower())
        except OSError as error:
            raise FileRefusedError(
                f"{self.path} cannot be read: {error.strerror}; is the folder still there?"
            ) from None
        return found[:MOST_NAMES], max(len(found) - MOST_NAMES, 0)

    def _found(self) -> Iterator[dict[str, object]]:
        for each in self.path.iterdir():
            suffix = each.suffix.lower()
            if each.name.startswith(".") or suffix not in _SUFFIXES:
                continue
            try:
                if self._inside(each.name).is_file():
                    yield {"name": each.name, "size": each.stat().st_size}
            except (OSError, FileRefusedError):  # it went at this moment, or leads out of the folder
                continue

    def _inside(self, name: str) -> Path:
        """The file of this name. Raises FileRefusedError for one that is not in the folder, or that Windows takes for
        something else."""
        reason = _fault_of(name)
        if reason:
            raise FileRefusedError(f"{name[:_LONGEST]!r} is no name of a file in this folder: {reason}")
        path = self.path / name
        try:
            is_inside = path.resolve().parent == self.path.resolve()
        except (OSError, RuntimeError, ValueError):  # a link to itself, or a name that no file may have
            is_inside = False
        if not is_inside:
            raise FileRefusedError(f"{name!r} leads out of the folder; copy the file into it")
        return path

    def read(self, name: str) -> FileText:
        """A file's text. Raises FileRefusedError, UnreadableProgramError."""
        return text_of(self.read_bytes(name), name)

    def read_bytes(self, name: str) -> bytes:
        """A file's bytes, one more than the most at most. Raises FileRefusedError."""
        path = self._inside(name)
        try:
            if not path.is_file():
                raise FileRefusedError(f"{name}: no such file in the folder {self.name}")
            with path.open("rb") as file:
                return file.read(MOST_BYTES + 1)
        except OSError as error:
            raise FileRefusedError(f"{name} cannot be read: {error.strerror}") from None

    def _mark(self, path: Path) -> str:
        """The mark of the bytes that are there now; empty if there is no file."""
        try:
            return mark_of(path.read_bytes())
        except FileNotFoundError:
            return ""

    def write(self, name: str, data: bytes, base: str) -> str:
        """Put bytes in the place of a file whose bytes have this mark, or of none if that is empty; their mark.

        At any moment the file is the old one or the whole new one. Raises FileConflictError if another file is there,
        FileRefusedError if it cannot be written.
        """
        path = self._inside(name)
        try:
            with open_whole(path) as whole:
                whole.file.write(data)
                # As late as possible, so that nobody else writes in between.
                now = self._mark(path)
                if now not in (base, mark_of(data)):
                    raise FileConflictError(_conflict(name, base, now), now)
        except (CannotWriteError, OSError) as error:
            reason = error.strerror if isinstance(error, OSError) else str(error).removeprefix(f"{path} ")
            raise FileRefusedError(f"{name} was not saved: it {reason}; your text is still here") from None
        return mark_of(data)


def _conflict(name: str, base: str, now: str) -> str:
    if not base:
        return f"{name} was not saved: there is a file of this name already; choose another name, or replace it"
    if not now:
        return f"{name} was not saved: somebody deleted or renamed the file; save it again to write it anew"
    return (
        f"{name} was not saved: another window or program changed the file since it was opened; "
        "save under another name, or replace it"
    )


def safe_name(name: str) -> str:
    """A name like another one that a file in the folder may have."""
    near = _FORBIDDEN.sub("_", name)[-_LONGEST:].strip().rstrip(".")
    return "program.nc" if _fault_of(near) else near


def _fault_of(name: str) -> str:
    """The reason why a name is none of a file in the folder; empty if it is."""
    if not name or name.strip(". ") == "" or len(name) > _LONGEST:
        return "it is empty, too long, or has only points"
    if found := _FORBIDDEN.search(name):
        return f"it has {found[0]!a}"
    if name != name.strip() or name.endswith("."):
        return "it begins or ends with a blank, or ends with a point"
    if _DEVICE.fullmatch(name):
        return "Windows takes it for a device"
    if not name.isprintable():
        return "it has characters that cannot be shown"
    return ""
