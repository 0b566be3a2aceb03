"""The two inputs of a verification: a program as blocks, and a claimed result as records of schema solve/1."""

import json
from collections.abc import Iterator, Sequence
from hashlib import sha256
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta, Struct

from contoursolve import gcode
from contoursolve.diagnostics import UserError
from contoursolve.gcode import STANDARD_INPUT, Program, UnreadableProgramError, decode

FARTHEST = 1e12
"""mm. The largest number read: words end at 1e6 mm, and intersections of lines 0.001 deg apart at 1e11 mm."""

PRINTED = 1e-12
"""mm. Results are written with 12 decimals: twice the half of the last one, for a distance of two points."""

Number = Annotated[float, Meta(ge=-FARTHEST, le=FARTHEST)]
Point = tuple[Number, Number]
"""mm in the plane's axes, X of a lathe as radius."""
Status = Literal[
    "rejected",
    "conflicting",
    "underdetermined",
    "overdetermined",
    "ambiguous",
    "no-solution",
    "undecided",
    "solved",
]
"""In the order of precedence."""
LineNumber = Annotated[int, Meta(ge=0, le=int(FARTHEST))]


class CannotVerifyError(UserError, ValueError):
    """An input that cannot be read, or is not what it should be; the message says which and why."""


class Document(Struct, frozen=True):
    """An input: what messages call it, and its bytes."""

    name: str
    data: bytes

    @property
    def checksum(self) -> str:
        """SHA-256 of the bytes, hexadecimal."""
        return sha256(self.data).hexdigest()


class ClaimedLine(msgspec.Struct, frozen=True, tag="line", tag_field="kind"):
    """A straight element."""

    start: Point
    end: Point


class ClaimedArc(msgspec.Struct, frozen=True, tag="arc", tag_field="kind"):
    """A circular element with the sense in which it is travelled; radius in mm."""

    start: Point
    end: Point
    center: Point
    radius: Number
    turn: Literal["cw", "ccw"]


class ClaimedDouble(msgspec.Struct, frozen=True):
    """That two solutions have become one, and how far they are from that, mm."""

    gap_mm: Number | None


class ClaimedCertificate(msgspec.Struct, frozen=True):
    """How well the result says its points are known: `radius` in mm, None where it names none."""

    kind: str
    radius: Number | None
    reason: str
    double: ClaimedDouble | None


class ClaimedAsked(msgspec.Struct, frozen=True):
    """A value that was asked for: mm (radius) or degrees, as `unit` says; None where nothing determines it."""

    word: str
    line: int
    unit: Literal["mm", "deg", "sign"]
    value: Number | None


class ClaimedPath(msgspec.Struct, frozen=True):
    """Where a path ends, its named points, its elements, what it answers; all empty where there is none."""

    end: Point | None
    points: dict[str, Point]
    elements: tuple[ClaimedLine | ClaimedArc, ...]
    certificate: ClaimedCertificate
    asked: tuple[ClaimedAsked, ...]

    @property
    def is_empty(self) -> bool:
        """Whether nothing of a path is claimed."""
        return self.end is None and not self.points and not self.elements

    def numbers(self) -> Iterator[float]:
        """Every number of its points and elements, in one order."""
        for name in sorted(self.points):
            yield from self.points[name]
        for each in self.elements:
            yield from (*each.start, *each.end, *((*each.center, each.radius) if isinstance(each, ClaimedArc) else ()))


class ClaimedSolution(ClaimedPath, frozen=True):
    """One solution of the equations; its path is empty where the control cannot make it."""

    name: str
    is_chosen: bool
    selects: tuple[str, ...]
    is_path: bool
    reasons: tuple[str, ...]


class ClaimedCount(msgspec.Struct, frozen=True):
    """How many solutions there are said to be, and how many of them are paths."""

    solutions: LineNumber
    contours: LineNumber
    is_complete: bool
    doubts: tuple[str, ...]
    chosen_by: str
    within_mm: Number | None = None


class ClaimedFilled(msgspec.Struct, frozen=True):
    """The blocks with the values that were asked for, and how far their contour is from the claimed one, mm."""

    blocks: tuple[str, ...]
    deviation_mm: Number


class ClaimedFreedom(msgspec.Struct, frozen=True):
    """A point that can move: along a unit vector and at an angle in degrees, or anywhere if both are None."""

    point: str
    direction: Point | None
    angle: Number | None


class ClaimedTie(msgspec.Struct, frozen=True):
    """Words that say the same, by their addresses, and by how much they disagree, mm."""

    addresses: tuple[str, ...]
    off_by_mm: Number
    is_conflict: bool


class ClaimedDiagnosis(msgspec.Struct, frozen=True):
    """What can still move, and which words say the same; `ties_complete` tells that all of these are named."""

    freedoms: tuple[ClaimedFreedom, ...]
    ties: tuple[ClaimedTie, ...]
    ties_complete: bool


class ClaimedConvention(msgspec.Struct, frozen=True):
    """A setting, with its value, on which the contour is said to rest."""

    setting: str
    value: str


class ClaimedContour(ClaimedPath, frozen=True):
    """One contour of the result; the coordinates of `start` are None where the result does not know them."""

    line: LineNumber
    lines: tuple[LineNumber, ...]
    form: str
    status: Status
    plane: tuple[str, str]
    start: tuple[Number | None, Number | None]
    branch: str | None
    branches: dict[str, str]
    conventions: tuple[ClaimedConvention, ...]
    facts: tuple[str, ...]
    filled: ClaimedFilled | None
    solutions: tuple[ClaimedSolution, ...]
    count: ClaimedCount | None
    diagnosis: ClaimedDiagnosis | None

    @property
    def has_path(self) -> bool:
        """Whether a path must be claimed. An overdetermined contour may have none: no-solution ranks after it."""
        return self.status == "solved" or (self.status == "overdetermined" and not self.is_empty)


class ClaimedResult(msgspec.Struct, frozen=True):
    """Everything of a result that can be checked; `control` is None where it names none. `settings` go by
    `control.name`; `diagnostics` are counted and not looked at."""

    schema: Literal["contoursolve/solve/1"]
    control: str | None
    rules: Literal["enforce", "warn", "off"]
    settings: dict[str, str]
    contours: tuple[ClaimedContour, ...]
    diagnostics: tuple[Any, ...]


def read_document(path: str) -> Document:
    """The bytes of a file; `-` is standard input. Raises CannotVerifyError if there is no such file."""
    try:
        return Document("<standard input>" if path == STANDARD_INPUT else path, gcode.read_bytes(path))
    except UnreadableProgramError as error:
        raise CannotVerifyError(str(error)) from None


def document_of_blocks(blocks: Sequence[str]) -> Document:
    """Blocks that were given apart from any file, one a line."""
    return Document("<block>", "\n".join(blocks).encode("utf-8", "replace"))


def parse_program(document: Document) -> Program:
    """The blocks of a program in UTF-8 or Latin-1. Raises CannotVerifyError if it is not text."""
    try:
        return gcode.parse(decode(document.data, document.name), document.name)
    except UnreadableProgramError as error:
        raise CannotVerifyError(str(error)) from None


def read_result(document: Document) -> ClaimedResult:
    """The claims of a result; fields that are not known are left alone. Raises CannotVerifyError, which names the field
    that is missing or mistyped."""
    try:
        data = json.loads(document.data, object_pairs_hook=_unambiguous)
        return msgspec.convert(data, ClaimedResult)
    except RecursionError:
        reason = "it is nested too deeply"
    except msgspec.ValidationError as error:
        message, _, place = str(error).partition(" - at `$")
        reason = f"{place.strip('.`') or 'the document'}: {message[:1].lower()}{message[1:]}"
    except ValueError as error:
        reason = f"it is no JSON document ({error})"
    told = reason.encode("ascii", "backslashreplace").decode()
    raise CannotVerifyError(f"{document.name} is not a result of 'solve --format json': {told}")


def _unambiguous(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """An object; a name that stands twice could be read either way."""
    found = dict(pairs)
    if len(found) < len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"the name {ascii(twice)[:60]} stands twice in one object")
    return found
