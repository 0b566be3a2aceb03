"""The order of a verification: read both inputs, follow the program from contour to contour as the control does, check
every contour that either of them has; after each, the claimed end is the position."""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

from msgspec.structs import replace

from contoursolve import gcode
from contoursolve.controls import DIALECTS
from contoursolve.execution import (
    ALONE,
    EventKind,
    Limit,
    Machine,
    ProgramEvent,
    Surroundings,
    machine_of,
    surroundings_of,
)
from contoursolve.gcode import Block, Directive, Program
from contoursolve.geometry import Length
from contoursolve.reading import (
    Ahead,
    Dialect,
    Modes,
    ParsedContour,
    State,
    Ways,
    advance,
    leave,
    next_place,
    reach_of,
    state_facts,
)
from contoursolve.verification.contour_checks import check_contour
from contoursolve.verification.decode import (
    FARTHEST,
    PRINTED,
    CannotVerifyError,
    ClaimedContour,
    ClaimedResult,
    Document,
    parse_program,
    read_result,
)
from contoursolve.verification.receipt import ContourReceipt, Ledger, Omission, Receipt, Verdict
from contoursolve.verification.status import Found

_FINDINGS = Omission(
    "the findings", "their words and values, the repairs that they offer, and the layers of a diagnosis"
)


def verify(
    program: Document,
    result: Document,
    control: str | Dialect | None = None,
    units: str = "mm",
    start: str | None = None,
    facts: Sequence[str] = (),
    variables: Mapping[str, float] | None = None,
    folders: Iterable[str | Path] = (),
) -> Receipt:
    """Check every element of a claimed result against the words of the program.

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
    blocks, claims, unit = parse_program(program), read_result(result), Length(units)
    beginning = gcode.parse(start, program.name, first_line=0) if start is not None else None
    dialect = _configured(_dialect(blocks, claims, control), claims)
    if dialect:
        syntax = dialect.modes.syntax
        blocks, beginning = gcode.spelled(blocks, syntax), beginning and gcode.spelled(beginning, syntax)
    if dialect and facts:
        blocks = with_facts(blocks, dialect, unit, beginning, facts)
    contours, around = list[ContourReceipt](), surroundings_of(blocks.name, variables, folders)
    by_line = dict[int, list[ClaimedContour]]()
    for contour in claims.contours:
        by_line.setdefault(contour.line, []).append(contour)
    for found in follow(blocks, dialect, unit, by_line, claims.rules, beginning, around) if dialect else ():
        lines, claimed = tuple(block.line for block in found.claim.blocks), found.claimed
        ledger, is_checked = check_contour(found, claimed) if claimed else (Ledger(), False)
        if claimed is None:
            ledger.require("the result mentions this contour", (), False, "it has none on this line")
        contours.append(_receipt(lines, found.claim.form.name, claimed, ledger, is_checked=is_checked))
    contours += _surplus(claims, {each.line for each in contours})
    return Receipt(
        program,
        result,
        dialect.name if dialect else None,
        unit,
        tuple(sorted(contours, key=lambda each: each.line)),
        (_FINDINGS,) if claims.diagnostics else (),
        claims.rules,
        start,
        tuple(facts),
        claims.settings,
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


def _surplus(claims: ClaimedResult, lines: set[int]) -> Iterator[ContourReceipt]:
    """Contours of the result where the program has none, or that the result has twice."""
    keys = [(each.line, each.start, each.status, each.end, repr(each.elements)) for each in claims.contours]
    times = Counter(keys)
    for key, contour in dict(zip(keys, claims.contours, strict=True)).items():
        ledger = Ledger()
        if contour.line not in lines:
            remark = f"line {contour.line} begins none" if lines else "no line of the program begins one"
            ledger.require("the program has a contour block here", (), False, remark)
        elif times[key] > 1 and contour.has_path:
            ledger.require("the result has this contour once", (), False, f"it has it {times[key]} times")
        if ledger.failures:
            yield _receipt(contour.lines, contour.form, contour, ledger, is_checked=False)


def _receipt(
    lines: tuple[int, ...], form: str, claimed: ClaimedContour | None, ledger: Ledger, *, is_checked: bool
) -> ContourReceipt:
    verdict = Verdict.VERIFIED if is_checked else Verdict.NOTHING_CHECKED
    verdict = Verdict.FAILED if ledger.failures else verdict
    line, status = (claimed.line, claimed.status) if claimed else (lines[0], None)
    return ContourReceipt(line, lines, form, status, verdict, tuple(ledger.checks), tuple(ledger.omissions))


Claims = Mapping[int, Sequence[ClaimedContour]]
"""The contours of a result by their first line; a subprogram may have several on one."""


def follow(
    program: Program,
    dialect: Dialect,
    unit: Length,
    claims: Claims,
    rules: str = "enforce",
    start: Program | None = None,
    around: Surroundings = ALONE,
) -> Iterator[Found]:
    """Every contour block of a program, in the order in which they run first, for each claim about it.

    `start` are blocks that state the start point apart from the program. Facts that only the result states are taken
    as stated in the last block of their contour.
    """
    blocks = _with_claimed_facts(program.blocks, claims)
    apart = sum(each.span.line < 0 for block in program.blocks for each in block.directives)

    first = dialect.initial_state(unit)
    for block in start.blocks if start else ():
        first = advance(first, block, dialect.modes)
    walk, heads = _Walk(dialect, rules, _Matching(claims), apart), dict[int, int]()
    ways = Ways(lambda: first, dialect.modes)
    machine = _machine(replace(program, blocks=blocks), dialect.modes, around)
    for run, event in _runs(blocks, machine):
        ways.read_on(run, partial(walk.read, ways.marked), is_open=event is not None and event.kind.is_open)
        walk.reached |= {each.line for each in run if not each.file and all(one.is_reached for one in each.callers)}
        if event is not None and event.kind is EventKind.HEAD:
            heads[event.mark] = len(walk.found)
        if event is not None and ways.happen(event):
            del walk.found[heads[event.mark] :]
        if machine is not None:
            machine.settled = ways.settled
    visits = dict[int, list[Found]]()
    for each in walk.found:
        visits.setdefault(each.claim.blocks[0].line, []).append(each)
    for line, several in visits.items():
        if line not in claims:
            yield several[0]
        for claimed in claims.get(line, ()):
            yield replace(_best(several, claimed), claimed=claimed)


class _Walk:
    """The contours of a program that are found on its ways."""

    def __init__(self, dialect: Dialect, rules: str, matching: "_Matching", apart: int) -> None:
        self._dialect, self._rules, self._matching, self._apart = dialect, rules, matching, apart
        self._start_error = 0.0
        self.found: list[Found] = []
        self.reached: set[int] = set()
        """The lines that the main program reaches."""

    def read(
        self, marked: dict[int, State], held: Sequence[Block], index: int, state: State, is_open: bool
    ) -> tuple[int, Callable[[], State]] | None:
        """What begins at a block, as `Ways` asks for it."""
        ahead, block, modes = Ahead(held), held[index], self._dialect.modes
        if block.mark:
            marked[block.mark] = state
        found = self._dialect.find(ahead, index, state, modes)
        if is_open and ahead.is_passed:
            return None
        if found is None or not found.form.is_contour:
            return 1, lambda: advance(state, block, modes)
        behind, claimed = index + reach_of(found, held, index), self._matching.claimed(found)
        if not block.file and (all(each.is_reached for each in block.callers) or block.line not in self.reached):
            following = next_place(held[behind:], found, modes)
            here = Found(found, claimed, self._start_error, self._dialect, following, self._rules, self._apart)
            self.found.append(here)
        self._start_error = PRINTED if claimed and claimed.end is not None else self._start_error
        end = self._matching.end_of(found)
        return behind - index, lambda: leave(found, end, modes, "the contour before has no path")


def _best(several: Sequence[Found], claimed: ClaimedContour) -> Found:
    """Of the times that a contour runs, the one of which a result claims something."""
    return min(several, key=lambda each: (each.claimed is not claimed, _distance(claimed, each.claim)))


class _Matching:
    """Which claim is about a contour, each time that it runs."""

    def __init__(self, claims: Claims) -> None:
        self._claims = claims
        self._taken: dict[object, ClaimedContour] = {}
        """Those of several from one start."""

    def claimed(self, claim: ParsedContour) -> ClaimedContour | None:
        """The claim from the nearest start."""
        there = self._claims.get(claim.blocks[0].line, ()) if not claim.blocks[0].file else ()
        nearest = min((_distance(each, claim) for each in there), default=0.0)
        alike = [each for each in there if _distance(each, claim) <= nearest + PRINTED]
        if len(alike) <= 1:
            return alike[0] if alike else None
        # With other values of variables: in the order in which they run.
        words = (word for block in claim.blocks for word in block.words if word.address in claim.lexicon.addresses)
        key = claim.blocks[0].line, tuple(word.text for word in words), tuple(claim.before.start().values)
        free = (each for each in alike if not any(each is one for one in self._taken.values()))
        return self._taken.setdefault(key, next(free, alike[-1]))

    def end_of(self, claim: ParsedContour) -> tuple[float, float] | None:
        """Where a contour ends by its claim; the same steps from another start are one claim."""
        claimed = self.claimed(claim)
        if claimed is None or claimed.end is None or not claimed.has_path:
            return None
        if not claim.after.is_incremental:
            return claimed.end
        steps = zip(claimed.end, claimed.start, claim.before.start().values, strict=True)
        first, second = (end + float(at or 0) - float(start or 0) for end, start, at in steps)
        return first, second


def _distance(claimed: ClaimedContour, claim: ParsedContour) -> float:
    """How far two starts are from each other, mm; what one of them does not know is far."""
    here = (None if value is None else float(value) for value in claim.before.start().values)
    pairs = zip(claimed.start, here, strict=True)
    return sum(abs(a - b) if a is not None and b is not None else FARTHEST * (a is not b) for a, b in pairs)


def _machine(program: Program, modes: Modes, around: Surroundings) -> Machine | None:
    """What runs a program; None for one that neither calls, jumps nor computes."""
    return machine_of(program, modes.language, modes.syntax, around, Limit(modes.most_blocks))


def _runs(blocks: Sequence[Block], machine: Machine | None) -> Iterator[tuple[Sequence[Block], ProgramEvent | None]]:
    """The blocks of a program between its events, each time with the event behind them."""
    run = list[Block]()
    for each in machine.run() if machine is not None else blocks:
        if isinstance(each, Block):
            run.append(each)
        else:
            yield run, each
            run = []
    yield run, None


def with_facts(
    program: Program, dialect: Dialect, unit: Length, start: Program | None, facts: Sequence[str]
) -> Program:
    """The program with facts that were stated apart from it. Raises CannotVerifyError if there are several contours."""
    found = [each.claim.blocks for each in follow(program, dialect, unit, {}, start=start)]
    if len(found) > 1:
        lines = ", ".join(str(each[0].line) for each in found)
        raise CannotVerifyError(
            f"a fact is about the only contour, and the program has {len(found)} (program lines {lines})"
        )
    directives = [gcode.read_directive(text, -number) for number, text in enumerate(facts, 1)]
    return state_facts(program, found[0] if found else (), directives)


def _with_claimed_facts(blocks: Sequence[Block], claims: Claims) -> tuple[Block, ...]:
    """The blocks with the facts that only the result states, on lines below zero as they were given."""
    added = dict[int, list[Directive]]()
    own = {block.line: [each.text for each in block.directives] for block in blocks}
    given = sum(each.span.line < 0 for block in blocks for each in block.directives)
    for claimed in (each for several in claims.values() for each in several if each.lines):
        known = Counter(text for line in claimed.lines for text in own.get(line, ()))
        rest = (Counter(claimed.facts) - known).elements()
        added[claimed.lines[-1]] = [gcode.read_directive(text, -given - number) for number, text in enumerate(rest, 1)]
    return tuple(
        replace(block, directives=(*block.directives, *added[block.line])) if added.get(block.line) else block
        for block in blocks
    )
