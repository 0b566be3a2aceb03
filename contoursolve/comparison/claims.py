"""Claims of a result, as records of schema solve/1, and the outcome of each claim: the receipt."""

import json
from collections.abc import Iterable, Mapping, Sequence
from enum import Enum
from hashlib import sha256
from math import isfinite
from typing import Annotated, Any, Literal

import msgspec
from msgspec import Meta, Struct, field

from contoursolve import gcode
from contoursolve.diagnostics import Shown, UserError, hash_of
from contoursolve.gcode import STANDARD_INPUT, Program, UnreadableProgramError, decode
from contoursolve.geometry import Length

FARTHEST = 1e12
"""mm. The largest number read: words end at 1e6 mm, and intersections of lines 0.001 deg apart at 1e11 mm."""

PRINTED = 1e-12
"""mm. Results are written with 12 decimals: twice the half of the last one, for a distance of two points."""

Number = Annotated[float, Meta(ge=-FARTHEST, le=FARTHEST)]
LineNumber = Annotated[int, Meta(ge=0, le=int(FARTHEST))]
Point = tuple[Number, Number]
"""mm in the plane's axes, X of a lathe as radius."""
Status = Literal[
    "rejected", "conflicting", "underdetermined", "overdetermined", "ambiguous", "no-solution", "undecided", "solved"
]


class CannotVerifyError(UserError, ValueError):
    """An input that cannot be read, or is not what it should be; the message says which and why."""


class Document(Struct, frozen=True):
    """An input: what messages call it, and its bytes."""

    name: str
    data: bytes

    @classmethod
    def of_blocks(cls, blocks: Sequence[str]) -> "Document":
        """Blocks that were given apart from any file, one a line."""
        return cls("<block>", "\n".join(blocks).encode("utf-8", "replace"))

    @property
    def checksum(self) -> str:
        """SHA-256 of the bytes, hexadecimal."""
        return sha256(self.data).hexdigest()

    def program(self) -> Program:
        """The blocks of a program in UTF-8 or Latin-1. Raises CannotVerifyError if it is not text."""
        try:
            return gcode.parse(decode(self.data, self.name), self.name)
        except UnreadableProgramError as error:
            raise CannotVerifyError(str(error)) from None


class ClaimedLine(Struct, frozen=True, tag="line", tag_field="kind"):
    """A straight element."""

    start: Point
    end: Point


class ClaimedArc(Struct, frozen=True, tag="arc", tag_field="kind"):
    """A circular element with the sense in which it is travelled; radius in mm."""

    start: Point
    end: Point
    center: Point
    radius: Number
    turn: Literal["cw", "ccw"]


class ClaimedCertificate(Struct, frozen=True):
    """Claimed accuracy of points: `radius` in mm, None if the result names none."""

    kind: str
    radius: Number | None
    reason: str
    double: dict[str, Number | None] | None


class ClaimedAnswer(Struct, frozen=True):
    """A value that was asked for, mm (radius) or degrees; None where nothing determines it."""

    word: str
    line: int
    unit: Literal["mm", "deg", "sign"]
    value: Number | None


class ClaimedPath(Struct, frozen=True):
    """Claimed path: its end, its named points, its elements and its answers; all empty if there is none."""

    end: Point | None
    points: dict[str, Point]
    elements: tuple[ClaimedLine | ClaimedArc, ...]
    certificate: ClaimedCertificate
    asked: tuple[ClaimedAnswer, ...]

    @property
    def is_bare(self) -> bool:
        """Whether nothing of a path is claimed."""
        has_path = self.end is not None or self.points or self.elements
        return not has_path and all(each.value is None for each in self.asked)

    def numbers(self) -> list[float]:
        """Every number of its end, points and elements, in one order."""
        found = [*(self.end or ()), *(value for name in sorted(self.points) for value in self.points[name])]
        for each in self.elements:
            found += (*each.start, *each.end, *((*each.center, each.radius) if isinstance(each, ClaimedArc) else ()))
        return found


class ClaimedSolution(ClaimedPath, frozen=True):
    """One solution of the equations; its path is empty where the control cannot make it."""

    name: str
    is_chosen: bool
    selects: tuple[str, ...]
    is_path: bool
    reasons: tuple[str, ...]


class ClaimedCount(Struct, frozen=True):
    """Claimed number of solutions, and the number of paths among them."""

    solutions: LineNumber
    contours: LineNumber
    is_complete: bool
    doubts: tuple[str, ...]
    chosen_by: str
    within_mm: Number | None = None


class ClaimedContour(ClaimedPath, frozen=True):
    """One contour of the result; the coordinates of `start` are None where the result does not know them, and 0 where
    its `place` is relative."""

    line: LineNumber
    lines: tuple[LineNumber, ...]
    form: str
    status: Status
    plane: tuple[str, str]
    start: tuple[Number | None, Number | None]
    branch: str | None
    branches: dict[str, str]
    conventions: tuple[dict[str, Any], ...]
    facts: tuple[str, ...]
    filled: dict[str, Any] | None
    solutions: tuple[ClaimedSolution, ...]
    count: ClaimedCount | None
    diagnosis: dict[str, Any] | None
    place: Literal["relative"] | None = None

    @property
    def has_path(self) -> bool:
        """Whether a path must be claimed. An overdetermined contour may have none: no-solution ranks after it."""
        return self.status == "solved" or (self.status == "overdetermined" and not self.is_bare)


class ClaimedResult(Struct, frozen=True):
    """A result; `control` is None where it names none, `settings` go by `control.name`."""

    schema: Literal["contoursolve/solve/1"]
    control: str | None
    rules: Literal["enforce", "warn", "off"]
    settings: dict[str, str]
    contours: tuple[ClaimedContour, ...]
    diagnostics: tuple[dict[str, Any], ...]


def read_document(path: str) -> Document:
    """The bytes of a file; `-` is standard input. Raises CannotVerifyError if there is no such file."""
    try:
        return Document(
            "<standard input>" if path == STANDARD_INPUT else path, gcode.read_bytes(path, most=gcode.MOST_OF_PROGRAM)
        )
    except UnreadableProgramError as error:
        raise CannotVerifyError(str(error)) from None


def read_result(document: Document) -> ClaimedResult:
    """The claims of a result; fields that are not known are left alone. Raises CannotVerifyError, which names the field
    that is missing or mistyped."""
    try:
        return msgspec.convert(json.loads(document.data, object_pairs_hook=_unambiguous), ClaimedResult)
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
    names = [name for name, _ in pairs]
    for name in names if len({*names}) < len(names) else ():
        if names.count(name) > 1:
            raise ValueError(f"the name {ascii(name)[:60]} stands twice in one object")
    return dict(pairs)


# --- The receipt -------------------------------------------------------------------------------------


class ReceiptVerdict(Enum):
    """The answer; that nothing was checked is not the same as that nothing is wrong."""

    VERIFIED = "verified"
    """The status was worked out, and the path was measured if there is one; everything that was checked is right."""
    FAILED = "failed"
    PARTLY_VERIFIED = "partly-verified"
    """The measured claims are right; the status (of a program: that of some contours) was not worked out."""
    NOTHING_CHECKED = "nothing-checked"


class ClaimCheck(Struct, frozen=True):
    """One claim, and whether it holds; None where that was not checked. `kind` is what it is about.

    `residual` says by how much it is off and `limit` how much is allowed, in `unit` (mm or deg), None where the answer
    is yes or no. `remark` says what was found where it is broken, and why where it was not checked.
    """

    kind: str
    name: str
    passed: bool | None
    words: tuple[str, ...] = ()
    residual: float | None = None
    limit: float | None = None
    unit: str | None = None
    remark: str = ""


STEPS = 10
"""Of a limit in which residuals are told: what is far below it is the noise of a machine."""


class Ledger(Struct):
    """The checks of one contour in their order; the next ones are of this `kind`, under names that begin so."""

    checks: list[ClaimCheck] = field(default_factory=list)
    kind: str = ""
    prefix: str = ""

    def measure(self, name: str, words: Iterable[str], off: float, limit: float, unit: str = "mm") -> bool:
        """Write down by how much something is off, which must not be more than the limit; whether it is not."""
        size, holds = abs(off), abs(off) <= limit  # false for NaN
        size = round(size / limit * STEPS) * limit / STEPS if holds and limit > 0 else size
        told = size if isfinite(size) else None
        self.checks.append(ClaimCheck(self.kind, self.prefix + name, holds, tuple(words), told, limit, unit))
        return holds

    def require(self, name: str, words: Iterable[str], holds: bool, remark: str = "") -> bool:
        """Write down a question of yes or no; the remark is kept where the answer is no."""
        told = "" if holds else remark
        self.checks.append(ClaimCheck(self.kind, self.prefix + name, holds, tuple(words), remark=told))
        return holds

    def omit(self, what: str, why: str) -> None:
        """Write down what was not checked, once."""
        check = ClaimCheck(self.kind, self.prefix + what, passed=None, remark=why)
        self.checks += [check] if check not in self.checks else []

    @property
    def is_broken(self) -> bool:
        """Whether a claim is broken."""
        return any(check.passed is False for check in self.checks)


class ContourReceipt(Struct, frozen=True):
    """The checks of one contour; `status` is the claimed one, None where the result does not mention it."""

    line: int
    lines: tuple[int, ...]
    form: str
    status: str | None
    verdict: ReceiptVerdict
    told: tuple[ClaimCheck, ...]

    @property
    def checks(self) -> list[ClaimCheck]:
        """The claims that were checked."""
        return [each for each in self.told if each.passed is not None]

    @property
    def omissions(self) -> list[ClaimCheck]:
        """The claims that were not checked."""
        return [each for each in self.told if each.passed is None]


class Receipt(Shown, Struct, frozen=True):
    """The verdict on a result, with the bytes that it is about.

    Attributes:
        program: the program, with its SHA-256.
        result: the result that was checked, with its own.
        control: the name of the control; None where neither input tells.
        unit: the unit of the program, mm or inch.
        contours: the verdict on each contour.
        omissions: the contours of the program that the result leaves out.
        rules: what the manual's rules did, as the result says.
        start: the words of the start point that were given apart from the program; None without any.
        facts: the facts that were given apart from it.
        settings: the settings under which it was read, as the result says, by `control.name`.
    """

    program: Document
    result: Document
    control: str | None
    unit: Length
    contours: tuple[ContourReceipt, ...]
    omissions: tuple[ClaimCheck, ...]
    rules: str = "enforce"
    start: str | None = None
    facts: tuple[str, ...] = ()
    settings: Mapping[str, str] = field(default_factory=dict)

    __hash__ = hash_of

    @property
    def verdict(self) -> ReceiptVerdict:
        """The verdict on all contours together."""
        verdicts = {contour.verdict for contour in self.contours} or {ReceiptVerdict.NOTHING_CHECKED}
        if ReceiptVerdict.FAILED in verdicts:
            return ReceiptVerdict.FAILED
        return verdicts.pop() if len(verdicts) == 1 else ReceiptVerdict.PARTLY_VERIFIED
