"""The two inputs of a verification as bytes: their names, their checksums, and the text of a program."""

from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256

from contoursolve import syntax
from contoursolve.syntax import STANDARD_INPUT, Program, UnreadableProgramError


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
    try:
        return Document("<standard input>" if path == STANDARD_INPUT else path, syntax.read_bytes(path))
    except UnreadableProgramError as error:
        raise CannotVerifyError(str(error)) from None


def document_of_blocks(blocks: Sequence[str]) -> Document:
    """Blocks that were given apart from any file, one a line."""
    return Document("<block>", "\n".join(blocks).encode("utf-8", "replace"))


def parse_program(document: Document) -> Program:
    """The blocks of a program in UTF-8 or Latin-1. Raises CannotVerifyError if it is not text."""
    try:
        return syntax.parse(syntax.decode(document.data, document.name), document.name)
    except UnreadableProgramError as error:
        raise CannotVerifyError(str(error)) from None
