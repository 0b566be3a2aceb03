"""The two inputs of a verification as bytes: their names, their checksums, and the text of a program."""

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from contoursolve import syntax
from contoursolve.syntax import Program

STANDARD_INPUT = "-"

_TAPE_CODES = bytes([0x02, 0x03, 0x11, 0x12, 0x13, 0x14, 0x1A])
_BINARY = frozenset(range(0x20)) - frozenset(b"\t\n\v\f\r" + _TAPE_CODES)
"""Bytes that no program holds; what readers of paper tape and DOS leave behind is no reason to refuse one."""


class CannotVerifyError(ValueError):
    """An input that cannot be read, or is not what it should be; the message says which and why."""


@dataclass(frozen=True, slots=True)
class Document:
    """An input: what messages call it, and its bytes."""

    name: str
    data: bytes

    @property
    def checksum(self) -> str:
        """SHA-256 of the bytes, hexadecimal."""
        return sha256(self.data).hexdigest()


def read_document(path: str) -> Document:
    """The bytes of a file; `-` is standard input. Raises CannotVerifyError if there is no such file."""
    if path == STANDARD_INPUT:
        return Document("<standard input>", sys.stdin.buffer.read())
    try:
        return Document(path, Path(path).read_bytes())
    except FileNotFoundError:
        raise CannotVerifyError(f"{path}: no such file") from None
    except (OSError, ValueError) as error:
        if _is_folder(path):  # Windows answers "permission denied" for a directory
            raise CannotVerifyError(f"{path} is a directory, not a file") from None
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise CannotVerifyError(f"{path} cannot be read: {reason}") from None


def document_of_blocks(blocks: Sequence[str]) -> Document:
    """Blocks that were given apart from any file, one a line."""
    return Document("<block>", "\n".join(blocks).encode("utf-8", "replace"))


def _is_folder(path: str) -> bool:
    try:
        return Path(path).is_dir()
    except ValueError:  # a name with a NUL
        return False


def parse_program(document: Document) -> Program:
    """The blocks of a program in UTF-8 or Latin-1. Raises CannotVerifyError if it is not text."""
    if not _BINARY.isdisjoint(document.data):
        raise CannotVerifyError(
            f"{document.name} is not a text file (it holds control bytes); save it as UTF-8 or Latin-1 text"
        )
    try:
        text = document.data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = document.data.decode("latin-1")
    return syntax.parse(text, document.name)
