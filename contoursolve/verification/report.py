"""A receipt as text: a line for each contour, what is wrong with it, what was not checked, the verdict."""

from collections.abc import Iterator

from contoursolve.tolerance import AGREEMENT
from contoursolve.verification.ledger import Check
from contoursolve.verification.receipt import ContourReceipt, Receipt, Verdict

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
    checks = _count(len(contour.checks), "check")
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
    measured = (check for check in contour.checks if check.limit is not None and check.limit < AGREEMENT / 10)
    found = [check.residual for check in measured if check.residual is not None]
    is_path = contour.verdict is Verdict.VERIFIED and contour.status in _WITH_PATH
    return f", off by at most {max(found):.1e} mm" if found and is_path else ""


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
    examined = f"{_count(len(verdicts), 'contour')} ({counts})" if verdicts else "no contour"
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


def _count(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
