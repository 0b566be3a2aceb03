"""The receipt of a verification: what was checked, what was not, the verdict; as records, as JSON and as text."""

from collections.abc import Iterable, Iterator, Mapping
from enum import Enum
from math import isfinite

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.diagnosis import count
from contoursolve.diagnostics import json_text, members
from contoursolve.geometry import Length
from contoursolve.tolerance import AGREEMENT, RESIDUAL
from contoursolve.verification.decode import Document

SCHEMA = "contoursolve/verify/1"


class Verdict(Enum):
    """The answer; that nothing was checked is not the same as that nothing is wrong."""

    VERIFIED = "verified"
    """A path was checked, or why there is none, and everything that was checked is right."""
    FAILED = "failed"
    """Something is wrong."""
    NOTHING_CHECKED = "nothing-checked"
    """Nothing is wrong, but there was no path to check, and why there is none was not worked out."""


class Check(Struct, frozen=True):
    """One check of a claim against the words that it rests on.

    `residual` says by how much the claim is off and `limit` how much is allowed, in `unit` (mm or deg); all three
    are None where the answer is yes or no. `remark` says what was found where the check failed.
    """

    name: str
    words: tuple[str, ...]
    residual: float | None
    limit: float | None
    unit: str | None
    passed: bool
    remark: str = ""


class Omission(Struct, frozen=True):
    """Something that was not checked, and why."""

    what: str
    why: str


_STEPS = 10
"""Of a limit in which residuals are told."""


class Ledger(Struct):
    """The checks and omissions of one contour, in the order in which they were made."""

    checks: list[Check] = field(default_factory=list)
    omissions: list[Omission] = field(default_factory=list)

    def measure(self, name: str, words: Iterable[str], residual: float, limit: float, unit: str = "mm") -> bool:
        """Write down a residual, which must not be larger than the limit; whether it is not."""
        size = abs(residual)
        passed = size <= limit  # false for NaN
        if passed and limit > 0:
            # What is far below the limit is the noise of this machine.
            size = round(size / limit * _STEPS) * limit / _STEPS
        self.checks.append(Check(name, tuple(words), size if isfinite(size) else None, limit, unit, passed))
        return passed

    def require(self, name: str, words: Iterable[str], passed: bool, remark: str = "") -> bool:
        """Write down a question of yes or no; the remark is kept where the answer is no."""
        self.checks.append(Check(name, tuple(words), None, None, None, passed, "" if passed else remark))
        return passed

    def omit(self, what: str, why: str) -> None:
        """Write down what was not checked, once."""
        omission = Omission(what, why)
        if omission not in self.omissions:
            self.omissions.append(omission)

    def add(self, other: "Ledger", prefix: str = "") -> None:
        """Append what another ledger holds, its checks under a name that begins so."""
        self.checks += [replace(check, name=prefix + check.name) for check in other.checks]
        for each in other.omissions:
            self.omit(each.what, each.why)

    @property
    def failures(self) -> list[Check]:
        """The checks that failed."""
        return [check for check in self.checks if not check.passed]


class ContourReceipt(Struct, frozen=True):
    """The checks of one contour; `status` is the claimed one, None where the result does not mention it."""

    line: int
    lines: tuple[int, ...]
    form: str
    status: str | None
    verdict: Verdict
    checks: tuple[Check, ...]
    omissions: tuple[Omission, ...]


class Receipt(Struct, frozen=True):
    """The verdict on a result, with the bytes that it is about; `control` is None where neither input tells.

    `start` and `facts` are what was given apart from the program.
    """

    program: Document
    result: Document
    control: str | None
    unit: Length
    contours: tuple[ContourReceipt, ...]
    omissions: tuple[Omission, ...]
    rules: str = "enforce"
    start: str | None = None
    facts: tuple[str, ...] = ()
    settings: Mapping[str, str] = field(default_factory=dict)
    """Under which the program was read, as the result says, by `control.name`."""

    @property
    def verdict(self) -> Verdict:
        """The verdict on all contours together."""
        verdicts = [contour.verdict for contour in self.contours]
        for each in (Verdict.FAILED, Verdict.VERIFIED):
            if each in verdicts:
                return each
        return Verdict.NOTHING_CHECKED


def to_json(receipt: Receipt) -> str:
    """The receipt as JSON: the same bytes for the same inputs."""
    contours = [
        members(each, "line lines form status verdict checks not_checked=omissions") for each in receipt.contours
    ]
    for check in (check for contour in contours for check in contour["checks"]):
        # More than three digits would be the noise of the machine's sine.
        check |= {key: float(f"{check[key]:.3g}") for key in ("residual", "limit") if check[key] is not None}
    return json_text(
        {
            "schema": SCHEMA,
            **members(receipt, "verdict"),
            "program": members(receipt.program, "name sha256=checksum"),
            "result": members(receipt.result, "name sha256=checksum"),
            **members(receipt, "control units=unit rules settings start facts"),
            "contours": contours,
            **members(receipt, "not_checked=omissions"),
        }
    )


_VERDICTS = {
    Verdict.VERIFIED: "verified",
    Verdict.FAILED: "WRONG",
    Verdict.NOTHING_CHECKED: "not checked",
}


def report_lines(receipt: Receipt) -> Iterator[str]:
    """The lines of a receipt, in pure ASCII apart from the names of the inputs."""
    for contour in receipt.contours:
        yield from _contour_lines(receipt, contour)
    for omission in receipt.omissions:
        yield f"{receipt.program.name}: not checked: {_plain(omission.what)}: {_plain(omission.why)}"
    for name, value in receipt.settings.items():
        yield f"{receipt.program.name}: read with {_plain(name)}={_plain(value)}, as the result says"
    if receipt.contours or receipt.omissions or receipt.settings:
        yield ""
    yield f"program {receipt.program.name}: SHA-256 {receipt.program.checksum}"
    yield f"result {receipt.result.name}: SHA-256 {receipt.result.checksum}"
    yield _summary(receipt)


def _contour_lines(receipt: Receipt, contour: ContourReceipt) -> Iterator[str]:
    claimed = f"claimed {contour.status}" if contour.status else "not in the result"
    place = f"{receipt.program.name}:{contour.line}: {_plain(contour.form)}: {claimed}"
    checks = count(len(contour.checks), "check")
    if contour.verdict is Verdict.NOTHING_CHECKED:
        checks = f"neither path nor status; {checks} of other things passed"
    yield f"{place}: {_VERDICTS[contour.verdict]} ({checks}{_largest(contour)})"
    for check in contour.checks:
        if not check.passed:
            yield f"  wrong: {_check_text(check)}"
    for omission in contour.omissions:
        yield f"  not checked: {_plain(omission.what)}: {_plain(omission.why)}"


def _largest(contour: ContourReceipt) -> str:
    """The largest residual, if the path was checked; what the control lets differ, or a word rounds, is no error of
    the result."""
    measured = [check for check in contour.checks if check.limit is not None and check.limit < AGREEMENT / 10]
    found = max((check.residual for check in measured if check.residual is not None), default=None)
    if found is None or contour.verdict is not Verdict.VERIFIED or contour.status not in _WITH_PATH:
        return ""
    return f", off by at most {found:.1e} mm" if found else f", off by less than {RESIDUAL / _STEPS:.0e} mm"


_WITH_PATH = ("solved", "overdetermined")


def _check_text(check: Check) -> str:
    words = f" ({' '.join(map(_plain, check.words))})" if check.words else ""
    if check.limit is None:
        return f"expected: {check.name}{words}; but {_plain(check.remark) or 'it is not so'}"
    off = "not a number" if check.residual is None else f"off by {check.residual:.3g} {check.unit}"
    return f"{check.name}{words}: {off}, allowed {check.limit:.1e} {check.unit}"


def _summary(receipt: Receipt) -> str:
    """How many contours got which verdict, and the verdict on all of them."""
    verdicts = [contour.verdict for contour in receipt.contours]
    counts = ", ".join(f"{verdicts.count(each)} {_VERDICTS[each]}" for each in Verdict if each in verdicts)
    examined = f"{count(len(verdicts), 'contour')} ({counts})" if verdicts else "no contour"
    meaning = {
        Verdict.VERIFIED: "every claim that was checked is right",
        Verdict.FAILED: "the result is not right",
        Verdict.NOTHING_CHECKED: "checked nothing: "
        + ("see above what was not checked, and why" if verdicts else "there is no contour to check"),
    }
    return f"{examined}; {meaning[receipt.verdict]}"


def _plain(text: str) -> str:
    """Text of the inputs in printable ASCII."""
    return text if text.isascii() and text.isprintable() else ascii(text)[1:-1]
