"""One contour from its words to its path: every check in order, and everything there is to say."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from decimal import Decimal
from enum import Enum

from contoursolve.analysis import judge
from contoursolve.constraints import assemble
from contoursolve.contour import Contour, trace
from contoursolve.diagnostic import Basis, Diagnostic, Label, Severity
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
from contoursolve.reading import Claim, Trouble, read
from contoursolve.rules import Rule, check
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
from contoursolve.syntax import Fault, Word
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


def examine(claim: Claim, rules: tuple[Rule, ...], policy: Policy) -> Answer:
    """Everything there is to say about one contour, and its path if there is one."""
    context = context_of(claim, rules)
    findings = [explain_fault(context, fault) for block in claim.blocks for fault in block.faults]
    findings += explain_words(context, claim.repeated, [word for block in claim.blocks for word in block.words])
    findings += _explain_unknown(context, claim)
    statuses = {Status.REJECTED} if any(each.severity is Severity.ERROR for each in findings) else set()
    variables = [word for name, word in claim.words.items() if word.number is None]
    if variables:
        statuses.add(Status.UNDERDETERMINED)
        findings.append(report(context, context.row(Trouble.VARIABLE), Basis.RULE, variables))
    is_readable = not statuses

    offences = check(rules, claim.form.name, claim.stated()) if policy is not Policy.OFF else ()
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
        diagnostics=tuple(sorted(findings, key=rank)),
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
    found: list[Refusal | Remark] = [*solution.refusals, *solution.remarks]
    events = [event for event in found if event.kind in about]
    status = solution.status if events else Status.SOLVED
    return Solution(status), events


def explain_fault(context: Context, fault: Fault) -> Diagnostic:
    """Characters that are not a word."""
    shown = Word(fault.text[:1], None, False, fault.text.strip(), fault.span)
    rule = context.row(fault.kind)
    return replace(report(context, rule, Basis.RULE, [shown]), addresses=_letters(fault.text))


def _letters(text: str) -> tuple[str, ...]:
    stripped = text.strip().upper()
    return (stripped[0],) if stripped[:1].isalpha() else ()


def explain_words(context: Context, repeated: Sequence[Word], words: Sequence[Word]) -> Iterator[Diagnostic]:
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


def rank(finding: Diagnostic) -> tuple[int, int, Span, str]:
    """By line, the worst first."""
    return finding.span.line, list(Severity).index(finding.severity), finding.span, finding.code
