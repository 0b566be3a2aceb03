"""The order of a verification: read both inputs, follow the program, check every contour that either of them has."""

from collections import Counter
from collections.abc import Iterator

from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.model import Length
from contoursolve.syntax import Program
from contoursolve.verification.claimed import ClaimedContour, ClaimedResult
from contoursolve.verification.contour import check_contour
from contoursolve.verification.document import CannotVerifyError, Document, parse_program
from contoursolve.verification.ledger import Ledger, Omission
from contoursolve.verification.receipt import ContourReceipt, Receipt, Verdict
from contoursolve.verification.result import read_result
from contoursolve.verification.walk import Found, follow

_RULES = Omission(
    "the rules of the manual", "only those that decide the path are; a result does not say which it was solved under"
)


def verify(program: Document, result: Document, control: str | None = None, units: str = "mm") -> Receipt:
    """Check every element of a claimed result against the words of the program.

    Args:
        program: the program.
        result: what `contoursolve solve PROGRAM --format json` printed for it.
        control: the control; without it the one that the result names.
        units: `mm` or `inch`, for numbers before any G20 or G21.

    Raises:
        CannotVerifyError: an input is not what it should be, or the control is unknown.
    """
    blocks, claims, unit = parse_program(program), read_result(result), Length(units)
    dialect = _dialect(blocks, claims, control)
    contours: list[ContourReceipt] = []
    omissions: list[Omission] = []
    lines: set[int] = set()
    by_line = {contour.line: contour for contour in claims.contours}
    for found in follow(blocks, dialect, unit, by_line) if dialect else ():
        lines.add(found.claim.blocks[0].line)
        contours.append(_examined(found))
    contours += _surplus(claims, lines)
    contours.sort(key=lambda each: each.line)
    if any(contour.verdict is Verdict.VERIFIED for contour in contours):
        omissions.append(_RULES)
    return Receipt(program, result, dialect.name if dialect else None, unit, tuple(contours), tuple(omissions))


def _dialect(program: Program, claims: ClaimedResult, control: str | None) -> Dialect | None:
    """The control that is asked for, the one that the result names, or the only one that the program shows."""
    wanted = control or claims.control
    if wanted is None:
        signs = [each for each in DIALECTS.values() if any(map(each.signs, program.blocks))]
        return signs[0] if signs else None
    if wanted not in DIALECTS:
        raise CannotVerifyError(f"unknown control {wanted!a}; choose from {', '.join(DIALECTS)}")
    return DIALECTS[wanted]


def _examined(found: Found) -> ContourReceipt:
    """A contour block of the program; that the result does not mention it is a fault of the result."""
    claim, claimed = found.claim, found.claimed
    lines = tuple(block.line for block in claim.blocks)
    if claimed is None:
        ledger, has_path = Ledger(), False
        ledger.require("the result mentions this contour", (), False, "the program has a contour block here")
    else:
        ledger, has_path = check_contour(found, claimed)
    return _receipt(lines, claim.form.name, claimed, ledger, has_path)


def _surplus(claims: ClaimedResult, lines: set[int]) -> Iterator[ContourReceipt]:
    """Contours of the result where the program has none, or that the result has twice."""
    times = Counter(contour.line for contour in claims.contours)
    for contour in {contour.line: contour for contour in claims.contours}.values():
        ledger = Ledger()
        if contour.line not in lines:
            ledger.require("the program has a contour here", (), False, "no contour block that could be checked")
        elif times[contour.line] > 1:
            ledger.require("the result has this contour once", (), False, f"{times[contour.line]} times")
        else:
            continue
        yield _receipt(contour.lines, contour.form, contour, ledger, has_path=False)


def _receipt(
    lines: tuple[int, ...], form: str, claimed: ClaimedContour | None, ledger: Ledger, has_path: bool
) -> ContourReceipt:
    verdict = Verdict.VERIFIED if has_path else Verdict.NOTHING_CHECKED
    if ledger.failures:
        verdict = Verdict.FAILED
    status = claimed.status.value if claimed else None
    line = claimed.line if claimed else lines[0]
    return ContourReceipt(line, lines, form, status, verdict, tuple(ledger.checks), tuple(ledger.omissions))
