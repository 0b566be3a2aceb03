"""The order of the stages: from text to contours and findings. No stage calls the next by itself."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from enum import Enum

from contoursolve.analysis import judge
from contoursolve.constraints import assemble
from contoursolve.contour import Contour, trace
from contoursolve.diagnostic import Basis, Diagnostic, Label, Severity
from contoursolve.dialects import DIALECTS, Dialect, Unresolved
from contoursolve.explain import (
    Context,
    context_of,
    explain_ignored,
    explain_missing,
    explain_offence,
    explain_result,
    length_text,
    report,
)
from contoursolve.model import Length, Plane, Profile, Side, Start
from contoursolve.reading import Claim, Position, State, Trouble, advance, positions, read
from contoursolve.rules import Rule
from contoursolve.rules import check as check_rules
from contoursolve.solving import (
    Refusal,
    RefusalKind,
    Remark,
    RemarkKind,
    Solution,
    Status,
    points_with_two_solutions,
    solve,
)
from contoursolve.source import Span
from contoursolve.syntax import Block, Fault, FaultKind, Program, Word
from contoursolve.tolerance import LARGEST


class Policy(Enum):
    """What the rules of the manual do to a block that they refuse."""

    ENFORCE = "enforce"
    """It is reported and not solved."""
    WARN = "warn"
    """It is reported as a warning, and solved if the geometry is determined."""
    OFF = "off"
    """The rules are not applied: the geometry alone decides."""


@dataclass(frozen=True, slots=True)
class Answer:
    """What became of one contour of a program.

    `contour` is None unless the status is solved or overdetermined. `side` is the solution that the
    block chose where two exist. `diagnostics` are the findings about this contour alone.
    """

    form: str
    lines: tuple[int, ...]
    status: Status
    plane: Plane
    unit: Length
    start: Start
    profile: Profile
    contour: Contour | None
    side: Side | None
    error_bound: float
    diagnostics: tuple[Diagnostic, ...]


@dataclass(frozen=True, slots=True)
class Result:
    """All contours and findings of a program; `control` is None where there was nothing to tell it by."""

    program: Program
    control: str | None
    answers: tuple[Answer, ...]
    diagnostics: tuple[Diagnostic, ...]

    @property
    def has_errors(self) -> bool:
        """Whether any finding is an error."""
        return any(each.severity is Severity.ERROR for each in self.diagnostics)


class UnknownControlError(ValueError):
    """The program does not tell which control it is for; the message lists the choices."""


def recognise(program: Program) -> Dialect | None:
    """The control that a program is written for; None if no block shows it.

    Raises UnknownControlError if its blocks show more than one.
    """
    signs = {name: block.line for name, dialect in DIALECTS.items() for block in program.blocks if dialect.signs(block)}
    if len(signs) > 1:
        places = ", ".join(f"{name} by line {line}" for name, line in signs.items())
        raise UnknownControlError(f"the program looks like more than one control ({places})")
    return DIALECTS[next(iter(signs))] if signs else None


def run(
    program: Program, dialect: Dialect | None, unit: Length, policy: Policy, start: Program | None = None
) -> Result:
    """Examine every block of a program and solve every contour.

    `start` is a block that states the start point apart from the program. Without a dialect only the
    characters of the program are examined.
    """
    examiner = _Examiner(program, dialect, unit, policy)
    answers = list(examiner.walk(start))
    if not answers and not any(each.severity is Severity.ERROR for each in examiner.diagnostics):
        examiner.nothing_to_solve()
    everything = [*examiner.diagnostics, *(each for answer in answers for each in answer.diagnostics)]
    everything.sort(key=_rank)
    return Result(program, dialect.name if dialect else None, tuple(answers), tuple(everything))


def _rank(finding: Diagnostic) -> tuple[int, int, Span, str]:
    """By line, the worst first."""
    return finding.span.line, list(Severity).index(finding.severity), finding.span, finding.code


_FAULTS_OF_NO_CONSEQUENCE = (FaultKind.STRAY_CHARACTER,)
"""Faults that are only worth a warning in a block that is not a contour."""


class _Examiner:
    """One pass over one program: the modal state as it goes, and the findings outside contours."""

    def __init__(self, program: Program, dialect: Dialect | None, unit: Length, policy: Policy) -> None:
        self.program = program
        self.dialect = dialect
        self.unit = unit
        self.policy = policy
        self.rules = dialect.rules if dialect else DIALECTS["yasnac-lx3"].rules
        self.diagnostics: list[Diagnostic] = []

    def walk(self, start: Program | None) -> Iterator[Answer]:
        """The answer to every contour, in order."""
        if self.dialect is None:
            for block in self.program.blocks:
                self._check_block(block)
            return
        dialect, blocks = self.dialect, self.program.blocks
        state = dialect.initial_state(self.unit)
        for block in start.blocks if start else ():
            self._check_block(block)
            state = advance(state, block, dialect.modes)
        index = 0
        while index < len(blocks):
            block = blocks[index]
            found = dialect.find(blocks, index, state, dialect.modes)
            if isinstance(found, Claim):
                answer = _examine(found, self.rules, self.policy)
                yield answer
                state = _state_after(found, answer, dialect)
                index += found.blocks[-1].line - block.line
            else:
                self._check_block(block)
                state = advance(state, block, dialect.modes)
                if found:
                    self._unresolved(found)
                    state = state.lose(state.plane.axes, f"{found.form} is not resolved", found.word.span)
            index += 1

    def nothing_to_solve(self) -> None:
        """The finding that a program has no contour block."""
        forms = (
            f"{form.name} ({form.title}, {dialect.name})"
            for dialect in DIALECTS.values()
            for form in dialect.forms
            if self.dialect in (None, dialect)
        )
        context = Context(self.rules, self.unit)
        rule = context.row(Trouble.NO_CONTOUR)
        self.diagnostics.append(report(context, rule, Basis.RULE, [], triggers=" and ".join(forms)))

    def _check_block(self, block: Block) -> None:
        context = Context(self.rules, self.unit, place=block.span)
        for fault in block.faults:
            finding = _explain_fault(context, fault)
            if fault.kind in _FAULTS_OF_NO_CONSEQUENCE:
                finding = replace(finding, severity=Severity.WARNING)
            self.diagnostics.append(finding)
        if self.dialect:
            addresses = self.dialect.modes.lexicon.addresses
            axis_words = [word for word in block.words if word.address in addresses and addresses[word.address].axis]
            self.diagnostics += _explain_words(context, _repeated(axis_words), axis_words)

    def _unresolved(self, found: Unresolved) -> None:
        context = Context(self.rules, self.unit, place=found.block.span)
        rule = context.row(Trouble.FORM_UNRESOLVED)
        self.diagnostics.append(report(context, rule, Basis.RULE, [found.word], form=found.form))


def _examine(claim: Claim, rules: Sequence[Rule], policy: Policy) -> Answer:
    """Everything there is to say about one contour, and its path if there is one."""
    context = context_of(claim, rules)
    findings = [_explain_fault(context, fault) for block in claim.blocks for fault in block.faults]
    findings += _explain_words(context, claim.repeated, [word for block in claim.blocks for word in block.words])
    findings += _explain_unknown(context, claim)
    statuses = {Status.REJECTED} if any(each.severity is Severity.ERROR for each in findings) else set()
    variables = [word for name, word in claim.words.items() if word.number is None]
    if variables:
        statuses.add(Status.UNDERDETERMINED)
        findings.append(report(context, context.row(Trouble.VARIABLE), Basis.RULE, variables))
    is_readable = not statuses

    offences = check_rules(rules, claim.form.name, claim.stated()) if policy is not Policy.OFF else ()
    ignored = {offence.rule.ignores for offence in offences} - {""}
    profile = read(claim, frozenset(ignored))
    for offence in offences:
        if not offence.rule.ignores:
            finding = explain_offence(context, offence)
            if policy is Policy.ENFORCE:
                statuses.add(Status.REJECTED)
            findings.append(finding if policy is Policy.ENFORCE else replace(finding, severity=Severity.WARNING))

    if not profile.start.is_known:
        statuses.add(Status.UNDERDETERMINED)
        findings.append(_explain_start(context, claim))
    findings += _explain_skippable(context, claim)
    solution = Solution(Status.UNDERDETERMINED)
    if is_readable and len(claim.blocks) == claim.form.length:
        structure = list(_examine_system(context, claim, profile))
        # A rule has refused the block already: what the equations say of it explains, and counts once.
        severity = Severity.INFO if Status.REJECTED in statuses else Severity.ERROR
        findings += [replace(finding, severity=severity) for _, finding in structure]
        solution, events = _solve(profile, has_system=not structure, is_refused=bool(statuses))
        findings += [explain_result(context, event, profile) for event in events]
        statuses |= {status for status, _ in structure} | {solution.status}
    findings += [explain_ignored(context, offence, profile, solution) for offence in offences if offence.rule.ignores]
    status = next(status for status in Status if status in statuses)
    is_shown = status in (Status.SOLVED, Status.OVERDETERMINED)
    touches = any(remark.kind is RemarkKind.TOUCHES for remark in solution.remarks)
    side = next((choice.side for choice in profile.choices if choice.point in profile.intersections), None)
    return Answer(
        form=claim.form.name,
        lines=tuple(block.line for block in claim.blocks),
        status=status,
        plane=profile.plane,
        unit=profile.unit,
        start=profile.start,
        profile=profile,
        contour=trace(profile, solution) if is_shown else None,
        side=side if is_shown and not touches else None,
        error_bound=solution.error_bound,
        diagnostics=tuple(sorted(findings, key=_rank)),
    )


def _examine_system(context: Context, claim: Claim, profile: Profile) -> Iterator[tuple[Status, Diagnostic]]:
    """Why the facts alone, whatever their values, make no single contour."""
    system = assemble(profile)
    verdict = judge(system)
    if not verdict.is_determined:
        yield Status.UNDERDETERMINED, explain_missing(context, profile, verdict, claim)
    by_name: dict[str, list[str]] = {}
    for corner in profile.figure.corners:
        by_name.setdefault(corner.name, []).append(corner.size)
        if corner.after is None and corner.lands_parallel_to is None:
            rule = context.row(Trouble.CORNER_NOWHERE)
            word = [context.words[corner.size]]
            yield Status.UNDERDETERMINED, report(context, rule, Basis.STRUCTURAL, word, subject=corner.name)
    for name, sizes in by_name.items():
        if len(sizes) > 1:
            words = [context.words[size] for size in sizes]
            rule = context.row(Trouble.CORNER_TWICE)
            yield Status.CONFLICTING, report(context, rule, Basis.STRUCTURAL, words, subject=name)
    if verdict.is_determined:
        chosen = {choice.point for choice in profile.choices}
        for point in points_with_two_solutions(system):
            if point not in chosen:
                rule = context.row(Trouble.CHOICE_MISSING)
                yield Status.UNDERDETERMINED, report(context, rule, Basis.STRUCTURAL, [], subject=point)


def _solve(profile: Profile, has_system: bool, is_refused: bool) -> tuple[Solution, list[Refusal | Remark]]:
    """The solution and what to say about it.

    A block that is refused is not solved; but if it says too much, whether its words agree is told.
    """
    if not has_system or not profile.start.is_known:
        return Solution(Status.UNDERDETERMINED if not profile.start.is_known else Status.SOLVED), []
    system = assemble(profile)
    if not is_refused:
        solution = solve(profile)
        return solution, [*solution.refusals, *solution.remarks]
    if len(system.facts) <= len(system.unknowns):
        return Solution(Status.SOLVED), []
    solution = solve(profile)
    about = (RefusalKind.WORDS_DISAGREE, RemarkKind.WORDS_AGREE)
    events = [event for event in (*solution.refusals, *solution.remarks) if event.kind in about]
    status = solution.status if events else Status.SOLVED
    return Solution(status), events


def _state_after(claim: Claim, answer: Answer, dialect: Dialect) -> State:
    """The modes of the contour's blocks, and the position where it ends.

    Where a contour was not solved, an axis that its last block programs is still known.
    """
    state, last = claim.after, claim.blocks[-1]
    if answer.contour:
        ends = zip(state.plane.axes, answer.contour.end, strict=True)
        return state.move(
            {axis: Position(Decimal(value), "the end of this contour", last.span) for axis, value in ends}
        )
    addresses = dialect.modes.lexicon.addresses
    words = [word for word in last.words if word.address in addresses and addresses[word.address].axis]
    programmed = positions(replace(state, is_incremental=False), words, dialect.modes, last.is_skippable)
    if last.faults:
        programmed = {}
    lines = " and ".join(str(line) for line in answer.lines)
    reason = f"the contour of line {lines} before it is not solved"
    return state.lose(state.plane.axes, reason, last.span).move(programmed)


def _explain_fault(context: Context, fault: Fault) -> Diagnostic:
    shown = Word(fault.text[:1], None, False, fault.text.strip(), fault.span)
    rule = context.row(fault.kind)
    return replace(report(context, rule, Basis.RULE, [shown]), addresses=_letters(fault.text))


def _letters(text: str) -> tuple[str, ...]:
    stripped = text.strip().upper()
    return (stripped[0],) if stripped[:1].isalpha() else ()


def _repeated(words: Sequence[Word]) -> list[Word]:
    seen: set[str] = set()
    return [word for word in words if word.address in seen or seen.add(word.address)]  # type: ignore[func-returns-value]


def _explain_words(context: Context, repeated: Sequence[Word], words: Sequence[Word]) -> Iterator[Diagnostic]:
    """Addresses given twice, and values beyond all travel."""
    for address, line in dict.fromkeys((word.address, word.span.line) for word in repeated):
        same = [word for word in words if word.address == address and word.span.line == line]
        if address == "G":
            same = [word for word in same if word.number in {each.number for each in repeated}]
        yield report(context, context.row(Trouble.REPEATED_ADDRESS), Basis.RULE, same)
    for word in words:
        factor = 1 if word.has_point else 1_000
        if word.number is not None and abs(word.number) > Decimal(LARGEST) * factor and word.address not in ("N", "O"):
            limit = length_text(LARGEST, context.unit)
            yield report(context, context.row(Trouble.VALUE_TOO_LARGE), Basis.RULE, [word], limit=limit)


def _explain_unknown(context: Context, claim: Claim) -> Iterator[Diagnostic]:
    allowed = ", ".join(sorted(claim.form.allowed - {"N", "G"}))
    for word in claim.unknown:
        rule = context.row(Trouble.UNKNOWN_ADDRESS)
        yield report(context, rule, Basis.RULE, [word], form=claim.form.name, allowed=allowed)


def _explain_start(context: Context, claim: Claim) -> Diagnostic:
    """Which axes of the start point are unknown, and which line made them so."""
    unknown = [axis for axis in claim.before.plane.axes if claim.before.axes[axis].value is None]
    places = [claim.before.axes[axis] for axis in unknown]
    reasons = dict.fromkeys(f"{each.reason}{_on_line(each.span)}" for each in places)
    finding = report(
        context,
        context.row(Trouble.POSITION_UNKNOWN),
        Basis.RULE,
        [],
        axes=" and ".join(unknown),
        reason="; ".join(reasons),
    )
    labels = (Label(each.span, "the position is lost here") for each in places if each.span)
    return replace(finding, labels=finding.labels + tuple(dict.fromkeys(labels)), addresses=tuple(unknown))


def _on_line(span: Span | None) -> str:
    return f" (line {span.line})" if span else ""


def _explain_skippable(context: Context, claim: Claim) -> Iterator[Diagnostic]:
    if any(claim.before.axes[axis].is_skippable for axis in claim.before.plane.axes):
        yield report(context, context.row(Trouble.SKIPPABLE_START), Basis.RULE, [])
