"""Checks claimed results: what a stranger can believe of them without the solver.

What is shared with the solver is the reading alone: which contours a program has, what their words state, which rules a
control has, and the equation of each kind of constraint. The equation of each word is evaluated at the claimed points
and elements; the rank of its derivatives there, by central differences, tells the status. Nothing is solved, and what
was not measured is listed as not checked.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from pathlib import Path

from contoursolve import gcode
from contoursolve.comparison.claims import (
    FARTHEST,
    PRINTED,
    CannotVerifyError,
    ClaimCheck,
    ClaimedContour,
    ClaimedResult,
    ContourReceipt,
    Document,
    Ledger,
    Receipt,
    ReceiptVerdict,
    read_result,
)
from contoursolve.comparison.judge import check_contour, prepare
from contoursolve.controls import CONTROLS
from contoursolve.execution import ALONE, Limit, Surroundings, surroundings_of
from contoursolve.gcode import Program
from contoursolve.geometry import Length
from contoursolve.reading import Control, ParsedContour, advance, contours_as_run, machine_in, state_facts

_FINDINGS = ClaimCheck("findings", "the findings", passed=None, remark="their words and values, and their fixes")
_NO_CONTOUR = ClaimCheck("count", "whether there is no contour", passed=None, remark="a finding of the result says so")


def verify(
    program: Document,
    result: Document,
    control: str | Control | None = None,
    units: str = "mm",
    start: str | None = None,
    facts: Sequence[str] = (),
    variables: Mapping[str, float] | None = None,
    folders: Iterable[str | Path] = (),
) -> Receipt:
    """Check a claimed result against the words of the program.

    Args:
        program: the program.
        result: what `contoursolve solve PROGRAM --format json` printed for it.
        control: the control, by its name or as its tables; without it the one that the result names.
        units: `mm` or `inch`, for numbers before any G20 or G21.
        start: words that give the start point apart from the program, such as `X40. Z0.`.
        facts: further facts about the only contour, as they were given to solve.
        variables: values of variables, as they were given to solve.
        folders: where files with subprograms are, besides that of the program.

    Raises:
        CannotVerifyError: an input is not what it should be, the control is unknown, or facts are for several
            contours.
    """
    blocks, claims, unit = program.program(), read_result(result), Length(units)
    beginning = gcode.parse(start, program.name, first_line=0) if start is not None else None
    chosen, contours = _control(blocks, claims, control), list[ContourReceipt]()
    is_refused = not claims.contours and any(each.get("code") == "no-contour" for each in claims.diagnostics)
    if chosen and not is_refused:
        syntax, around = chosen.modes.syntax, surroundings_of(blocks.name, variables, folders)
        blocks, beginning = gcode.spelled(blocks, syntax), beginning and gcode.spelled(beginning, syntax)
        if facts:
            found = [each.blocks for each, *_ in follow(blocks, chosen, unit, (), beginning)]
            if len(found) > 1:
                told = f"has {len(found)} (program lines {', '.join(str(each[0].line) for each in found)})"
                raise CannotVerifyError(f"a fact is about the only contour, and the program {told}")
            directives = [gcode.read_directive(text, -number) for number, text in enumerate(facts, 1)]
            blocks = state_facts(blocks, found[0] if found else (), directives)
        for claim, claimed, next_end in follow(blocks, chosen, unit, claims.contours, beginning, around):
            ledger, name = Ledger(kind="count"), "the result mentions this contour"
            if ledger.require(name, (), claimed is not None, "it has none on this line") and claimed:
                check_contour(prepare(claim, claimed, chosen, claims.rules, next_end), ledger)
            lines = tuple(block.line for block in claim.blocks)
            contours.append(_receipt(lines, claim.form.name, claimed, ledger))
    contours += _surplus(claims, {each.line for each in contours})
    return Receipt(
        program,
        result,
        chosen.name if chosen else None,
        unit,
        tuple(sorted(contours, key=lambda each: each.line)),
        (*((_FINDINGS,) if claims.diagnostics else ()), *((_NO_CONTOUR,) if is_refused else ())),
        claims.rules,
        start,
        tuple(facts),
        claims.settings,
    )


def _control(program: Program, claims: ClaimedResult, control: str | Control | None) -> Control | None:
    """The control that is asked for, the one that the result names, or the only one that the program shows, with the
    settings under which the result says that it was made."""
    wanted = control or claims.control
    shown = (each for each in CONTROLS.values() if any(map(each.signs, program.blocks)))
    chosen = wanted if isinstance(wanted, Control) else CONTROLS.get(wanted) if wanted else next(shown, None)
    if wanted and chosen is None:
        choices = f"choose from {', '.join(CONTROLS)}, or name the tables of your own with --control MODULE:NAME"
        raise CannotVerifyError(f"unknown control {wanted!a}; {choices}")
    if chosen is None or not claims.settings:
        return chosen
    for name in claims.settings:
        if name.partition(".")[0] != chosen.name:
            raise CannotVerifyError(f"the result has the setting {name!a}, which is none of {chosen.name}")
    try:
        return chosen.configure({name.partition(".")[2]: value for name, value in claims.settings.items()})
    except ValueError as error:
        raise CannotVerifyError(f"the result has a setting that is none: {ascii(str(error))[1:-1]}") from None


def _surplus(claims: ClaimedResult, lines: set[int]) -> Iterator[ContourReceipt]:
    """Contours of the result where the program has none, or that the result has twice."""
    keys = [(each.line, each.start, each.status, each.end, repr(each.elements)) for each in claims.contours]
    times = Counter(keys)
    for key, contour in dict(zip(keys, claims.contours, strict=True)).items():
        ledger, is_once = Ledger(kind="count"), times[key] == 1 or not contour.has_path
        remark = f"line {contour.line} begins none" if lines else "no line of the program begins one"
        ledger.require("the program has a contour block here", (), contour.line in lines, remark)
        ledger.require("the result has this contour once", (), is_once, f"it has it {times[key]} times")
        if ledger.is_broken:
            yield _receipt(contour.lines, contour.form, contour, ledger)


def _receipt(lines: tuple[int, ...], form: str, claimed: ClaimedContour | None, ledger: Ledger) -> ContourReceipt:
    kinds = {each.kind for each in ledger.checks if each.passed}
    verdict = ReceiptVerdict.PARTLY_VERIFIED if "words" in kinds else ReceiptVerdict.NOTHING_CHECKED
    verdict = ReceiptVerdict.FAILED if ledger.is_broken else ReceiptVerdict.VERIFIED if "status" in kinds else verdict
    line, status = (claimed.line, claimed.status) if claimed else (lines[0], None)
    return ContourReceipt(line, lines, form, status, verdict, tuple(ledger.checks))


Followed = tuple[ParsedContour, ClaimedContour | None, tuple[Decimal, Decimal] | None]
"""A contour of a program, what is claimed of it, and where the line of the next block ends, mm, if that is known."""


def follow(
    program: Program,
    control: Control,
    unit: Length,
    claims: Sequence[ClaimedContour],
    start: Program | None = None,
    around: Surroundings = ALONE,
) -> Iterator[Followed]:
    """Every contour of a program, in the order in which they run first, for each claim about it; behind it, the tool is
    where the claim ends. `start` are blocks that state the start point apart from the program."""
    first, modes, taken = control.initial_state(unit), control.modes, dict[object, ClaimedContour]()
    for block in start.blocks if start else ():
        first = advance(first, block, modes)
    by_line = dict[int, list[ClaimedContour]]()
    for each in claims:
        by_line.setdefault(each.line, []).append(each)

    def claimed_of(found: ParsedContour) -> ClaimedContour | None:
        """The claim from the nearest start; of several from one start, with other values of variables, in order."""
        block = found.blocks[0]
        there = by_line.get(block.line, []) if not block.file else []
        nearest = min((_distance(each, found) for each in there), default=0.0)
        alike = [each for each in there if _distance(each, found) <= nearest + PRINTED]
        if len(alike) <= 1:
            return alike[0] if alike else None
        words = (word for block in found.blocks for word in block.words if word.address in found.lexicon.addresses)
        free = (each for each in alike if not any(each is one for one in taken.values()))
        key = block.line, tuple(word.text for word in words), tuple(found.before.start().values)
        return taken.setdefault(key, next(free, alike[-1]))

    def end_of(found: ParsedContour) -> tuple[float, float] | None:
        """The claimed end of a contour; the same steps from another start are one claim."""
        claimed = claimed_of(found)
        if claimed is None or claimed.end is None or not claimed.has_path:
            return None
        starts = zip(claimed.start, found.before.start().values, strict=True)
        away = [float(at or 0) - float(start or 0) if found.after.is_incremental else 0.0 for start, at in starts]
        return claimed.end[0] + away[0], claimed.end[1] + away[1]

    machine = machine_in(program, modes, around, unit, Limit(modes.most_blocks))
    visits = dict[int, list[Followed]]()
    for found, next_end in contours_as_run(program.blocks, machine, control.find, modes, first, end_of):
        visits.setdefault(found.blocks[0].line, []).append((found, claimed_of(found), next_end))
    for line, several in visits.items():
        if line not in by_line:
            yield several[0]
        for claimed in by_line.get(line, ()):
            # Of the times that it runs, the one of which the result claims something.
            mine = [(each[1] is not claimed, _distance(claimed, each[0])) for each in several]
            found, _, next_end = several[mine.index(min(mine))]
            yield found, claimed, next_end


def _distance(claimed: ClaimedContour, found: ParsedContour) -> float:
    """The distance between two starts, mm; a coordinate that one of them does not know counts as far."""
    here = (None if value is None else float(value) for value in found.before.start().values)
    # From an unknown place, a claimed path begins at 0.
    of_axes = zip(claimed.start, here, strict=True)
    pairs = ((None if b is None and claimed.place and a == 0 else a, b) for a, b in of_axes)
    return sum(abs(a - b) if a is not None and b is not None else FARTHEST * (a is not b) for a, b in pairs)
