"""The receipt of a verification as JSON and as text."""

from collections import Counter
from collections.abc import Iterator

from contoursolve.comparison import ClaimCheck, ContourReceipt, Receipt, ReceiptVerdict
from contoursolve.diagnosis import count, status_text, statuses_text
from contoursolve.diagnostics import json_text, members
from contoursolve.solving import Status
from contoursolve.tolerance import AGREEMENT, RESIDUAL

SCHEMA = "contoursolve/verify/1"

_CHECK = " ".join(("kind", "name", "words", "residual", "limit", "unit", "passed", "remark"))
"""The members of one check."""


def receipt_json(receipt: Receipt) -> str:
    """The receipt as JSON: the same bytes for the same inputs."""
    contours = list[dict[str, object]]()
    for each in receipt.contours:
        checks = [members(check, _CHECK) for check in each.checks]
        for check in checks:
            # More than three digits would be the noise of the machine's sine.
            check |= {key: float(f"{check[key]:.3g}") for key in ("residual", "limit") if check[key] is not None}
        omitted = [members(check, "what=name why=remark") for check in each.omissions]
        contours.append({**members(each, "line lines form status verdict"), "checks": checks, "not_checked": omitted})
    return json_text(
        {
            "schema": SCHEMA,
            **members(receipt, "verdict"),
            "program": members(receipt.program, "name sha256=checksum"),
            "result": members(receipt.result, "name sha256=checksum"),
            **members(receipt, "control units=unit rules settings start facts"),
            "contours": contours,
            "not_checked": [members(check, "what=name why=remark") for check in receipt.omissions],
        }
    )


_VERDICTS = {
    ReceiptVerdict.VERIFIED: "verified",
    ReceiptVerdict.FAILED: "WRONG",
    ReceiptVerdict.PARTLY_VERIFIED: "path verified, status not checked",
    ReceiptVerdict.NOTHING_CHECKED: "not checked",
}
_MEANINGS = {
    ReceiptVerdict.VERIFIED: "every claim that was checked is right",
    ReceiptVerdict.FAILED: "the result is not right",
    ReceiptVerdict.PARTLY_VERIFIED: "every claim that was checked is right; see above what was not checked, and why",
    ReceiptVerdict.NOTHING_CHECKED: "checked nothing: see above what was not checked, and why",
}


def receipt_lines(receipt: Receipt) -> Iterator[str]:
    """The lines of a receipt, in pure ASCII apart from the names of the inputs."""
    for contour in receipt.contours:
        claimed = f"the result says {status_text(contour.status)}" if contour.status else "not in the result"
        place = f"{receipt.program.name}:{contour.line}: {_plain(contour.form)}: {claimed}"
        checks = count(len(contour.checks), "check")
        if contour.verdict is ReceiptVerdict.NOTHING_CHECKED:
            checks = f"neither path nor status; {checks} of other things passed"
        yield f"{place}: {_VERDICTS[contour.verdict]} ({checks}{_largest(contour)})"
        yield from (f"  wrong: {_check_text(check)}" for check in contour.checks if not check.passed)
        yield from (f"  not checked: {_plain(each.name)}: {_plain(each.remark)}" for each in contour.omissions)
    for omission in receipt.omissions:
        yield f"{receipt.program.name}: not checked: {_plain(omission.name)}: {_plain(omission.remark)}"
    for name, value in receipt.settings.items():
        yield f"{receipt.program.name}: read with {_plain(name)}={_plain(value)}, as the result says"
    if receipt.contours or receipt.omissions or receipt.settings:
        yield ""
    yield f"program {receipt.program.name}: SHA-256 {receipt.program.checksum}"
    yield f"result {receipt.result.name}: SHA-256 {receipt.result.checksum}"
    verdicts = [contour.verdict for contour in receipt.contours]
    if not verdicts:
        yield "no contour; checked nothing: there is no contour to check"
        return
    counts = ", ".join(f"{verdicts.count(each)} {_VERDICTS[each]}" for each in ReceiptVerdict if each in verdicts)
    yield f"{count(len(verdicts), 'contour')} ({counts}); {_MEANINGS[receipt.verdict]}"


def receipt_summary(receipt: Receipt) -> str:
    """A verification in sentences, for all who ask no more: how many paths agree, how many contours have none."""
    several = receipt.contours
    if not several:
        return "Nothing to check: the program has no contour."
    total = count(len(several), "contour")
    if wrong := sum(each.verdict is ReceiptVerdict.FAILED for each in several):
        return (
            f"Not right: {wrong} of {total} {'disagrees' if wrong == 1 else 'disagree'} with the words of the program."
        )
    if receipt.verdict is ReceiptVerdict.VERIFIED:
        who = "the contour is" if len(several) == 1 else f"all {total} are"
        return f"Checked again without the solver: {who} as shown."
    agreeing = [each for each in several if any(check.kind == "words" for check in each.checks)]
    told = []
    if agreeing:
        agree = (
            "has a path that agrees with its words" if len(agreeing) == 1 else "have paths that agree with their words"
        )
        told.append(f"Checked again without the solver: {len(agreeing)} of {total} {agree}.")
    if unproven := sum(each.verdict is ReceiptVerdict.PARTLY_VERIFIED for each in agreeing):
        told.append(f"{unproven} of them may have another path: that was not checked.")
    if without := Counter(Status(each.status) for each in several if each not in agreeing and each.status):
        told.append(f"{without.total()} of {total} without a path to check: {statuses_text(without)}.")
    return " ".join(told)


def _largest(contour: ContourReceipt) -> str:
    """The largest residual of a path that is right; what the control lets differ, or a word rounds, is no error."""
    checks = (check for check in contour.checks if check.limit is not None and check.limit < AGREEMENT / 10)
    found = [check.residual or 0.0 for check in checks if check.kind == "words"]
    if not found or contour.verdict is ReceiptVerdict.FAILED:
        return ""
    return f", off by at most {max(found):.1e} mm" if max(found) else f", off by less than {RESIDUAL / 10:.0e} mm"


def _check_text(check: ClaimCheck) -> str:
    words = f" ({' '.join(map(_plain, check.words))})" if check.words else ""
    if check.limit is None:
        return f"expected: {check.name}{words}; but {_plain(check.remark) or 'it is not so'}"
    off = "not a number" if check.residual is None else f"off by {check.residual:.3g} {check.unit}"
    return f"{check.name}{words}: {off}, allowed {check.limit:.1e} {check.unit}"


def _plain(text: str) -> str:
    """Text of the inputs in printable ASCII."""
    return text if text.isascii() and text.isprintable() else ascii(text)[1:-1]
