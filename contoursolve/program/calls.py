"""A program that calls or computes: its contours are solved where they run, and told once where they are written."""

import re
from collections.abc import Iterable, Iterator, Sequence, Set
from decimal import Decimal
from itertools import chain, pairwise

from msgspec.structs import replace

from contoursolve.diagnosis import Answer, Context, context_of, join, measured, report, status_text
from contoursolve.diagnostics import Basis, Diagnostic, Fix, Label, Severity, Span
from contoursolve.execution import ARGUMENT, MACHINES, Call, Limit, Machine, ModalCall, Surroundings, When, counts_in
from contoursolve.gcode import PLAIN, Block, Caller, Program, Substitution, late_pattern, parse_block, typed_span
from contoursolve.geometry import Length
from contoursolve.program.cycle_profiles import CycleProfile, begins_wrongly, profiles_of, turns_back
from contoursolve.program.request import Request
from contoursolve.program.solve_queue import Step
from contoursolve.reading import Control, ReadIssue, Rule, State, machine_in
from contoursolve.solving import ArcSegment

MOST_TOLD = 10
"""Results of one contour that are told; of more, their number."""

_ALIKE = 6
"""Decimals of mm to which two paths are compared."""


def machine_for(program: Program, control: Control, around: Surroundings, unit: Length) -> Machine | None:
    """The machine that runs a program, which begins in a unit; None for one that neither calls, jumps nor computes."""
    limit = Limit(control.modes.most_blocks, f"{control.name}.{Limit().setting}")
    return machine_in(program, control.modes, around, unit, limit)


def arguments_without_point(machine: Machine, asked: Request) -> Iterator[Diagnostic]:
    """The arguments of calls in a program that have no decimal point, with what the called program gets."""
    context, given = Context(asked.rules, asked.unit), machine.variables.given
    for index, block in enumerate(machine.main.blocks):
        said = machine.main.code(index).statements
        within = (one for each in said for one in (each.then if isinstance(each, When) else (each,)))
        letters = "".join(each.counted for each in within if isinstance(each, Call | ModalCall))
        if not letters:
            continue
        # Behind IF and THEN, a block has words as well.
        own = parse_block(_CONDITION.sub(lambda found: " " * len(found[0]), block.text), block.line, block.syntax)
        words = [each for each in own.words if each.address in letters and each.number and not each.has_point]
        if not words:
            continue
        numbers = [each.number or Decimal(0) for each in words]
        scales = [given.get(counts_in(each.address)) for each in words]
        read = [number * Decimal(repr(scale or 0.0)) for number, scale in zip(numbers, scales, strict=True)]
        texts = [f"{each.normalize():f}" for each in read]
        yield report(
            replace(context, place=block.span),
            ReadIssue.ARGUMENT_IN_INCREMENTS,
            Basis.RULE,
            words,
            actual=join(texts) if None not in scales else "least increments",
            expected=join([f"{each:f}" for each in numbers]),
            meant=join([f"{each.text.strip()}." for each in words]),
            same=join([PLAIN.spell(each.address, text) for each, text in zip(words, texts, strict=True)]),
        )


_CONDITION = late_pattern(r"\A.*\]THEN", re.IGNORECASE)


def in_text_order(
    blocks: Sequence[Block],
    steps: Iterable[Step],
    passed_over: Set[int],
    asked: Request,
    told: Sequence[Diagnostic],
    profiles: list[CycleProfile],
    control: Control,
    called: list[Answer],
) -> Iterator[Step]:
    """The steps of a program as it runs, each contour once, in the order in which the program is written. What is
    wrong in lines that the program passes over, stops nothing. `told` are findings about the whole text; the profiles
    of cycles are added to `profiles`, contours of other files to `called`; it is for a control."""
    rules, state = asked.rules, control.initial_state(asked.unit)
    ran: dict[int, list[Step]] = {}
    before: dict[int, State] = {}
    findings, here = list(told), _Substituted()
    in_cycle, reached = list[Step](), set[int]()
    for ran_step in steps:
        in_cycle.append(ran_step)
        state, step = ran_step.before, _as_warning(ran_step, passed_over)
        if not _counts(step, reached):
            continue
        here |= _substituted(step.blocks)
        findings += (_as_typed(each, blocks, here) for each in step.findings)
        if step.answer is not None and step.blocks[0].file:
            called.append(step.answer)
            findings += _of_other_file(step.answer, step.blocks[0], rules)
        elif step.answer is not None:
            answer = _checked(_typed(step.answer, blocks, here), here, rules)
            ran.setdefault(step.blocks[0].line, []).append(replace(step, answer=answer))
        for block in step.blocks if not step.blocks or not step.blocks[0].file else ():
            before.setdefault(block.line, step.before)
    findings += _solved_elsewhere(called, rules)
    if not ran:
        # No contour minds where it is not followed.
        findings = [each for each in findings if each.about is not ReadIssue.NOT_FOLLOWED]
    profiles.extend(profiles_of(in_cycle, control.modes))
    told_of = chain.from_iterable((*turns_back(each, rules), *begins_wrongly(each, rules)) for each in profiles)
    findings += (_as_typed(each, blocks, here) for each in told_of)
    by_line: dict[int, list[Diagnostic]] = {}
    for finding in {_key(each): each for each in findings}.values():
        by_line.setdefault(finding.span.line, []).append(finding)
    index, shared = 0, _shared(in_cycle, passed_over)
    while index < len(blocks):
        line, count, answers, shares = blocks[index].line, 1, tuple[Answer, ...](), ""
        if line in ran:
            count = max(each.line for step in ran[line] for each in step.blocks) - line + 1
            # Between blocks of a contour stand others, where a jump leads from one to another.
            within = [at for at in range(line, line + count) if at in ran]
            inside = [_once([_kept_right(each, shared) for each in ran[at]], blocks, rules) for at in within]
            answers = tuple(each for once in inside for each in once)
            shares = next((why for each in answers if (why := _why_shared(each.lines, shared))), "")
        own = tuple(blocks[index : index + count])
        own_findings = tuple(each for block in own for each in by_line.pop(block.line, ()))
        state = before.get(line, state)
        yield Step(own, state, next(iter(answers), None), own_findings, others=answers[1:], shares=shares)
        index += count
    rest = tuple(each for found in by_line.values() for each in found)
    if rest:
        yield Step((), state, findings=rest)


def _shared(steps: Iterable[Step], passed_over: Set[int]) -> set[int]:
    """The lines of contours that run outside of their contour as well: on another way, or in another pass."""
    runs: dict[int, set[int]] = {}
    for step in steps:
        own = step.blocks if step.answer is None else step.answer.claim.blocks
        if not own or own[0].file or own[0].line in passed_over:
            continue
        for block in own:
            if block.words:
                runs.setdefault(block.line, set()).add(own[0].line if step.answer is not None else 0)
    return {line for line, several in runs.items() if len(several) > 1}


def _why_shared(lines: Sequence[int], shared: Set[int]) -> str:
    """The reason why blocks of a contour cannot be written anew, by their lines; empty if they can."""
    if any(line <= before for before, line in pairwise(lines)):
        return "it goes on from one pass of a loop to the next, so that its blocks run several times"
    there = [str(line) for line in lines if line in shared]
    what = f"program line{'s' * (len(there) > 1)} {join(there)}"
    return (
        f"{what} {'are' if len(there) > 1 else 'is'} cut in another way where the program comes there otherwise"
        * bool(there)
    )


def _kept_right(step: Step, shared: Set[int]) -> Step:
    """A step without the fixes of its contour that change what runs outside of it, too."""
    answer = step.answer
    if answer is None or not _why_shared(answer.lines, shared):
        return step
    texts = {block.line: block.text for block in answer.claim.blocks}
    is_once = len(texts) == len(answer.lines)

    def is_right(fix: Fix) -> bool:
        new = fix.by_line(answer.lines)
        return is_once and all(new.get(line) == texts[line] for line in shared & texts.keys())

    told = (replace(each, fixes=tuple(filter(is_right, each.fixes))) for each in answer.diagnostics)
    return replace(step, answer=replace(answer, diagnostics=tuple(told)))


def _as_warning(step: Step, passed_over: Set[int]) -> Step:
    """A step; the errors of one whose lines do not run are warnings."""
    if not step.blocks or step.blocks[0].file or step.blocks[0].line not in passed_over:
        return step
    if step.answer is not None:
        diagnostics = tuple(map(_warning, step.answer.diagnostics))
        step = replace(step, answer=replace(step.answer, diagnostics=diagnostics))
    return replace(step, findings=tuple(map(_warning, step.findings)))


def _warning(finding: Diagnostic) -> Diagnostic:
    if not finding.is_error:
        return finding
    note = "the program passes over this line, so that this is a warning only"
    return replace(finding, severity=Severity.WARNING, notes=(note, *finding.notes))


def _counts(step: Step, reached: set[int]) -> bool:
    """Whether a step counts: what is called from where the main program never comes does where nothing else calls it.
    The lines that the main program reaches are added to `reached`."""
    is_reached = all(each.is_reached for block in step.blocks[:1] for each in block.callers)
    if is_reached:
        reached |= {block.line for block in step.blocks if not block.file}
    return is_reached or step.blocks[0].line not in reached


def _key(finding: Diagnostic) -> tuple[Span, str, str]:
    return finding.span, finding.code, finding.message


def _once(visits: Sequence[Step], blocks: Sequence[Block], rules: tuple[Rule, ...]) -> list[Answer]:
    """The different answers to one contour that runs several times; the first one says how their verdicts differ."""
    groups: dict[object, list[Answer]] = {}
    for step in visits:
        if step.answer is not None:
            groups.setdefault(_result(step.answer), []).append(step.answer)
    found = [_with_calls(each) for each in groups.values()]
    if len({each.status for each in found}) > 1:
        first = found[0]
        context = context_of(first.claim, rules)
        several = report(context, context.row(ReadIssue.CALLS_DIFFER), Basis.RULE, [], results=_results(found))
        told = _as_typed(several, blocks, _substituted(first.claim.blocks), first)
        found[0] = replace(first, diagnostics=(*first.diagnostics, told))
    return found


def _with_calls(answers: Sequence[Answer]) -> Answer:
    callers = (each.claim.blocks[0].callers for each in answers)
    return replace(answers[0], calls=tuple(dict.fromkeys(each[-1].line for each in callers if each)))


def _result(answer: Answer) -> object:
    """Key by which two results of a contour are the same."""
    return answer.status, tuple(each.message for each in answer.diagnostics), answer.start.is_known, path_of(answer)


def path_of(answer: Answer) -> object:
    """A path as it is written: its ends, or where increments are in force its steps, and the centres of arcs."""
    if answer.contour is None:
        return answer.status
    is_stepwise = answer.claim.after.is_incremental
    found = []
    for each in answer.contour.elements:
        reference = each.start if is_stepwise else (0.0, 0.0)
        found.append(tuple(round(end - base, _ALIKE) for end, base in zip(each.end, reference, strict=True)))
        if isinstance(each, ArcSegment):
            found.append(tuple(round(to - base, _ALIKE) for to, base in zip(each.center, each.start, strict=True)))
    return tuple(found)


def _results(answers: Sequence[Answer]) -> str:
    """The results of a contour in each of its calls, in words."""
    told = list[str]()
    for answer in answers[:MOST_TOLD]:
        values = [None if value is None else float(value) for value in answer.start.values]
        place = measured(values, answer.plane, answer.unit) if answer.start.is_known else "an unknown point"
        errors = [each.message for each in answer.diagnostics if each.is_error]
        lines = join([str(line) for line in answer.calls])
        called = (
            f"called in program line{'s' * (len(answer.calls) > 1)} {lines}"
            if answer.calls
            else f"pass {len(told) + 1}"
        )
        told.append(f"{called}: from {place}: {errors[0] if errors else status_text(answer.status)}")
    more = len(answers) - MOST_TOLD
    return "; ".join(told) + (f"; and {more} more" if more > 0 else "")


def _of_other_file(answer: Answer, block: Block, rules: tuple[Rule, ...]) -> Iterator[Diagnostic]:
    """Errors of a contour of another file, told at the block that calls it."""
    caller = block.callers[0]
    context = Context(rules, answer.unit, place=Span(caller.line, 1, len(caller.text) + 1))
    for each in answer.diagnostics:
        if each.is_error:
            row = context.row(ReadIssue.SUBPROGRAM_REFUSED)
            yield report(context, row, Basis.RULE, [], file=block.file, line=each.span.line, finding=each.message)


def _solved_elsewhere(called: Sequence[Answer], rules: tuple[Rule, ...]) -> Iterator[Diagnostic]:
    """The contours of other files that are solved, told at the block that calls them."""
    solved: dict[tuple[Caller, str], dict[tuple[int, ...], Answer]] = {}
    for answer in called:
        block = answer.claim.blocks[0]
        if not any(each.is_error for each in answer.diagnostics):
            solved.setdefault((block.callers[0], block.file), {})[answer.lines] = answer
    for (caller, file), answers in solved.items():
        unit = next(iter(answers.values())).unit
        context = Context(rules, unit, place=Span(caller.line, 1, len(caller.text) + 1))
        lines = join([str(each[0]) for each in answers])
        contours = (
            f"the contours in program lines {lines}" if len(answers) > 1 else f"the contour in program line {lines}"
        )
        row, are = context.row(ReadIssue.SUBPROGRAM_SOLVED), "are" if len(answers) > 1 else "is"
        yield report(context, row, Basis.RULE, [], file=file, contours=contours, are=are)


# What was typed in the place of numbers --------------------------------------------------------------------------


_Substituted = dict[int, tuple[Substitution, ...]]
"""Values that replace the variables of some lines of the main file, as they ran last."""


def _substituted(blocks: Sequence[Block]) -> _Substituted:
    return {each.line: each.substituted for each in blocks if not each.file and each.substituted}


def _typed(answer: Answer, blocks: Sequence[Block], here: _Substituted) -> Answer:
    """An answer whose findings are about what was typed."""
    if not any(line in here for line in answer.lines):
        return answer
    return replace(answer, diagnostics=tuple(_as_typed(each, blocks, here, answer) for each in answer.diagnostics))


def _checked(answer: Answer, here: _Substituted, rules: tuple[Rule, ...]) -> Answer:
    """An answer; one that depends on arguments alone, which each call of the program gives, with one note in the place
    of its errors."""
    errors = [each for each in answer.diagnostics if each.is_error]
    if not errors or any(each.about not in _OF_VALUES for each in errors):
        return answer
    lines = {*answer.lines, *(label.span.line for each in errors for label in each.labels)}
    reasons = [each.reason for line in sorted(lines) for each in here.get(line, ()) if each.reason]
    arguments = [each for each in reasons if ARGUMENT in each]
    if not arguments or not all(ARGUMENT in each or each.endswith(MACHINES) for each in reasons):
        return answer
    context = context_of(answer.claim, rules)
    note = report(context, context.row(ReadIssue.NOT_CHECKED), Basis.RULE, [], reason=arguments[0])
    # For which values there is a contour is worth knowing all the same.
    notes = tuple(dict.fromkeys(one for each in errors for one in each.notes))
    others = tuple(each for each in answer.diagnostics if not each.is_error)
    return replace(answer, diagnostics=(replace(note, notes=notes), *others))


_OF_VALUES = (ReadIssue.VARIABLE, ReadIssue.POSITION_UNKNOWN)
"""Findings about a value that is not known."""


def _as_typed(
    finding: Diagnostic,
    blocks: Sequence[Block],
    here: _Substituted,
    answer: Answer | None = None,
) -> Diagnostic:
    """A finding about a line with numbers for its variables, about what was typed there: its places, what is to be
    written instead, and what the variables stand for."""
    lines = answer.lines if answer is not None else (finding.span.line,)
    if not any(line in here for line in lines):
        return finding
    changes = [(line, each) for line in lines for each in here.get(line, ())]
    stands = [f"{each.typed} is {each.number} here" for _, each in changes if each.number]
    why = [f"{each.typed}: {each.reason}" for _, each in changes if each.reason]
    return replace(
        finding,
        span=_place(finding.span, blocks, here),
        labels=tuple(Label(_place(each.span, blocks, here), each.text) for each in finding.labels),
        notes=(*finding.notes, *dict.fromkeys([*stands, *why])),
        fixes=tuple(_fix(each, [*lines], blocks, here) for each in finding.fixes),
    )


def _place(span: Span, blocks: Sequence[Block], here: _Substituted) -> Span:
    """The columns of what was typed; the whole line, where it ran again since with other numbers, so that they would
    lie behind its end."""
    if span.line not in here:
        return span
    found, block = typed_span(span, here[span.line]), blocks[span.line - blocks[0].line]
    return found if found.end_column <= len(block.text) + 1 else block.span


def _fix(fix: Fix, lines: Sequence[int], blocks: Sequence[Block], here: _Substituted) -> Fix:
    """A fix that keeps the variables that it does not change."""
    texts = fix.replacement.split("\n")
    if len(texts) != len(lines) and len(lines) > 1:
        return fix
    first, description = blocks[0].line, fix.description
    for place, line in enumerate(lines):
        typed = blocks[line - first].text
        for each in here.get(line, ()):
            if each.number:
                address = re.search(r"[A-Za-z_,=]*[ \t]*$", typed[: each.begin])
                before = re.escape(address[0] if address else "")
                pattern = rf"(?<![A-Za-z_,]){before}{re.escape(each.number)}(?![\d.])"
                kept = (address[0] if address else "") + each.typed
                texts[place], count = re.subn(pattern, kept.replace("\\", r"\\"), texts[place], count=1)
                if not count and typed[: each.begin].endswith("="):
                    # Another address has the same value.
                    told = re.compile(rf"={re.escape(each.number)}(?!\d)")
                    if len(told.findall(texts[place])) == 1:
                        meant = f"={each.typed}".replace("\\", r"\\")
                        texts[place], description = told.sub(meant, texts[place]), told.sub(meant, description)
    replaced = "\n".join(blocks[line - first].text for line in lines)
    return replace(fix, description=description, replacement="\n".join(texts), replaced=replaced)
