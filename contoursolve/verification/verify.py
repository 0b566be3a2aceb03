"""The order of a verification: read both inputs, follow the program, check every contour that either of them has."""

from collections import Counter
from collections.abc import Iterator, Sequence

from contoursolve import syntax
from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.model import Length
from contoursolve.syntax import Program
from contoursolve.verification.claimed import ClaimedContour, ClaimedResult
from contoursolve.verification.contour import check_contour
from contoursolve.verification.document import CannotVerifyError, Document, parse_program
from contoursolve.verification.ledger import Ledger, Omission
from contoursolve.verification.receipt import ContourReceipt, Receipt, Verdict
from contoursolve.verification.result import read_result
from contoursolve.verification.walk import Found, follow, with_facts

_FINDINGS = Omission(
    "the findings", "their words and values, the repairs that they offer, and the layers of a diagnosis"
)
_RULES = Omission("the rules of the manual", "the result does not say under which it was made")


def verify(
    program: Document,
    result: Document,
    control: str | Dialect | None = None,
    units: str = "mm",
    start: str | None = None,
    facts: Sequence[str] = (),
) -> Receipt:
    """Check every element of a claimed result against the words of the program.

    Args:
        program: the program.
        result: what `contoursolve solve PROGRAM --format json` printed for it.
        control: the control, by its name or as its tables; without it the one that the result names.
        units: `mm` or `inch`, for numbers before any G20 or G21.
        start: words that give the start point apart from the program, such as `X40. Z0.`.
        facts: further facts about the only contour, as they were given to solve.

    Raises:
        CannotVerifyError: an input is not what it should be, the control is unknown, or facts are for several
            contours.
    """
    blocks, claims, unit = parse_program(program), read_result(result), Length(units)
    beginning = syntax.parse(start, program.name, first_line=0) if start is not None else None
    dialect = _configured(_dialect(blocks, claims, control), claims)
    if dialect and facts:
        blocks = with_facts(blocks, dialect, unit, beginning, facts)
    contours: list[ContourReceipt] = []
    omissions: list[Omission] = []
    lines: set[int] = set()
    by_line = {contour.line: contour for contour in claims.contours}
    for found in follow(blocks, dialect, unit, by_line, claims.rules, beginning) if dialect else ():
        lines.add(found.claim.blocks[0].line)
        contours.append(_examined(found))
    contours += _surplus(claims, lines)
    contours.sort(key=lambda each: each.line)
    if contours and claims.rules is None:
        omissions.append(_RULES)
    if claims.findings:
        omissions.append(_FINDINGS)
    name, rules = dialect.name if dialect else None, claims.rules
    return Receipt(
        program,
        result,
        name,
        unit,
        tuple(contours),
        tuple(omissions),
        rules,
        start,
        tuple(facts),
        claims.settings or {},
    )


def _dialect(program: Program, claims: ClaimedResult, control: str | Dialect | None) -> Dialect | None:
    """The control that is asked for, the one that the result names, or the only one that the program shows."""
    if isinstance(control, Dialect):
        return control
    wanted = control or claims.control
    if wanted is None:
        signs = [each for each in DIALECTS.values() if any(map(each.signs, program.blocks))]
        return signs[0] if signs else None
    if wanted not in DIALECTS:
        choices = f"choose from {', '.join(DIALECTS)}, or name the tables of your own with --control MODULE:NAME"
        raise CannotVerifyError(f"unknown control {wanted!a}; {choices}")
    return DIALECTS[wanted]


def _configured(dialect: Dialect | None, claims: ClaimedResult) -> Dialect | None:
    """The control with the settings under which the result says that it was made."""
    if dialect is None or not claims.settings:
        return dialect
    values = {}
    for name, value in claims.settings.items():
        control, _, setting = name.partition(".")
        if control != dialect.name:
            raise CannotVerifyError(f"the result has the setting {name!a}, which is none of {dialect.name}")
        values[setting] = value
    try:
        return dialect.configure(values)
    except ValueError as error:
        raise CannotVerifyError(f"the result has a setting that is none: {ascii(str(error))[1:-1]}") from None


def _examined(found: Found) -> ContourReceipt:
    """A contour block of the program; that the result does not mention it is a fault of the result."""
    claim, claimed = found.claim, found.claimed
    lines = tuple(block.line for block in claim.blocks)
    if claimed is None:
        ledger, has_path = Ledger(), False
        ledger.require("the result mentions this contour", (), False, "it has none on this line")
    else:
        ledger, has_path = check_contour(found, claimed)
    return _receipt(lines, claim.form.name, claimed, ledger, has_path)


def _surplus(claims: ClaimedResult, lines: set[int]) -> Iterator[ContourReceipt]:
    """Contours of the result where the program has none, or that the result has twice."""
    times = Counter(contour.line for contour in claims.contours)
    for contour in {contour.line: contour for contour in claims.contours}.values():
        ledger = Ledger()
        if contour.line not in lines:
            remark = f"line {contour.line} begins none"
            if not lines:
                remark = "no line of the program begins one"
            ledger.require("the program has a contour block here", (), False, remark)
        elif times[contour.line] > 1:
            ledger.require("the result has this contour once", (), False, f"it has it {times[contour.line]} times")
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
