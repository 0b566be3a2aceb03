"""Findings about blocks outside contours: their characters, their words, the slips that keep them from being contours,
and arcs. `told_outside` chooses those that are told."""

from collections.abc import Callable, Container, Iterable, Iterator, Sequence
from functools import cached_property
from itertools import repeat

from msgspec.structs import replace

from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import (
    Answer,
    Context,
    Depth,
    Policy,
    corner_words,
    explain_asked_outside,
    explain_codes_by_name,
    explain_corners,
    explain_faults,
    explain_unmarked,
    explain_vocabulary,
    explain_words,
    has_corners,
    is_corner_word,
    is_known,
    like_corners,
    move_without_point,
    moves,
    name_of,
    not_read_yet,
    report,
)
from contoursolve.diagnostics import Basis, Diagnostic, Severity, Span
from contoursolve.gcode import Block, FaultKind, Word, has_lookalike_code, parse_block
from contoursolve.program.named_words import named_outside
from contoursolve.program.request import Request
from contoursolve.program.solve_queue import Ahead, Pending, Previous, Step
from contoursolve.program.windows import Parts, last_of, window_of
from contoursolve.reading import (
    COMMENTED,
    Control,
    Effect,
    Lexicon,
    Modes,
    ParsedContour,
    ReadIssue,
    State,
    advance_plainly,
    arc_of,
    codes_of,
    doubtful_words,
    is_read_by_arcs,
    suspected,
)
from contoursolve.solving import RefusalKind

NEAR = 8
"""Blocks at a place that are looked at together for what may have been meant there."""

_FAULTS_OF_NO_CONSEQUENCE = (FaultKind.STRAY_CHARACTER,)
"""Faults that are only worth a warning in a block that is not a contour."""

_ARCS = (2, 3)
"""Motions of arcs. Those with an end or a centre end where their words say, whatever else is wrong with them."""

_OF_ARCS = "IJK"
"""Words that most arcs have."""

_OTHERWISE = (Effect.SINGLE, Effect.NO_MOTION)
"""Effects of codes beside which words of axes are no places: a time, or the sizes of a cycle."""

_ABOUT_VALUES = (ReadIssue.VARIABLE, ReadIssue.POSITION_UNKNOWN)
"""Findings that matter to calculated values alone."""

_USUAL = 10_000
"""A number that is no value too large, in inches neither."""

_OWN_USE = (*_OTHERWISE, Effect.PRESET, Effect.CYCLE, Effect.FRAME)
"""Effects of codes beside which no block is a line or an arc of a contour."""

Examine = Callable[[ParsedContour, Pending], Answer]
"""A function that gives the answer to a contour."""


# Characters and words --------------------------------------------------------------------------------------------


def findings_of_block(
    asked: Request, block: Block, here: State | None = None, ahead: Ahead = ()
) -> Sequence[Diagnostic]:
    """Findings about a block that is no contour; `here` is the state with its codes in force, `ahead` what says
    something before it."""
    control = asked.control
    points: Sequence[Diagnostic] = ()
    if asked.is_strict and control is not None and here is not None:
        points = tuple(_of_points(_context_of(asked, block), block, here, control))
    if control and _is_clean(block, control, here):
        return points
    context = _context_of(asked, block)
    found = [*_of_characters(context, block), *_of_facts(asked, block), *points]
    if control is None:
        return found
    lexicon = control.modes.lexicon
    axis_words = [each for each in block.words if (own := lexicon.addresses.get(each.address)) and own.axis]
    found += explain_asked_outside(context, block)
    found += explain_words(context, lexicon, _repeated(axis_words), axis_words)
    if here is None:
        return found
    if COMMENTED not in here.memory:
        previous = last_of(ahead, control.modes)
        found += _of_vocabulary(context, block, here, control, previous)
        found += _of_unread(context, block, here, control, previous)
    if found and has_corners(block, here, control.modes):
        return [*explain_corners(context, block.text, found, lexicon, _CORNER_WORDS)]
    return found


def _context_of(asked: Request, block: Block) -> Context:
    """The context of findings about a block."""
    return Context(asked.rules, asked.unit, place=block.span)


def _is_clean(block: Block, control: Control, here: State | None) -> bool:
    """Whether a block has words alone, all read, and moves each axis once, as usual: there is nothing to say then."""
    if block.faults or block.directives or block.unmarked or block.named:
        return False
    addresses, modes = [word.address for word in block.words], control.modes
    own = {*_OF_ARCS, modes.radius} if here is not None and here.motion in _ARCS else set[str]()
    others = [each for each in addresses if not is_known(each, modes.lexicon)]
    is_read = own.issuperset(others)
    codes = codes_of(block, modes) if "G" in addresses else ()
    is_read = is_read and all(not isinstance(code, Word) and code.is_read for code in codes)
    rows = modes.lexicon.addresses
    # Beside the words of an arc, which not all controls have, every word counts.
    moved = [word for word in block.words if others or ((row := rows.get(word.address)) and row.axis)]
    is_usual = all(abs(word.number) <= _USUAL if word.number is not None else not others for word in moved)
    is_once = len({word.address for word in moved}) == len(moved) and not any(word.is_asked for word in block.words)
    return is_read and is_usual and is_once and not (here is not None and modes.unread(block, here))


def _repeated(words: Sequence[Word]) -> list[Word]:
    seen: set[str] = set()
    return [word for word in words if word.address in seen or seen.add(word.address)]  # type: ignore[func-returns-value]


def _of_characters(context: Context, block: Block) -> Iterator[Diagnostic]:
    """Characters that cannot be read, and what looks like a fact."""
    for finding in explain_faults(context, block):
        is_slight = finding.about in _FAULTS_OF_NO_CONSEQUENCE
        yield replace(finding, severity=Severity.WARNING) if is_slight else finding
    yield from explain_unmarked(context, block)


def _of_facts(asked: Request, block: Block) -> Iterator[Diagnostic]:
    """Facts that are about no contour."""
    for directive in block.directives:
        place = Context(asked.rules, asked.unit, place=directive.span)
        yield report(place, place.row(ReadIssue.FACT_NOWHERE), Basis.RULE, [])
    yield from named_outside(asked, block)


def _of_points(context: Context, block: Block, here: State, control: Control) -> Iterator[Diagnostic]:
    """Coordinates without a decimal point that count least increments, in a block that moves by them."""
    modes, rows = control.modes, control.modes.lexicon.addresses
    if COMMENTED in here.memory or block.macro is not None or any(modes.is_call(word) for word in block.words):
        return
    if any(isinstance(code, Word) or code.effect in _OTHERWISE for code in codes_of(block, modes)):
        return
    own = {*_OF_ARCS, modes.radius} if here.motion in _ARCS else set[str]()
    words = [each for each in block.words if (row := rows.get(each.address)) and (row.axis or each.address in own)]
    yield from move_without_point(context, words, modes.lexicon, here.unit)


def _of_vocabulary(
    context: Context, block: Block, here: State, control: Control, previous: Previous | None
) -> Iterator[Diagnostic]:
    """Words and codes that the control has not."""
    modes, signs = control.modes, control.signs(block)
    for each in explain_codes_by_name(context, block, modes):
        # The contour of this block is lost with it.
        yield replace(each, severity=Severity.ERROR) if signs else each
    yield from _of_words_beside(context, block, control)
    if not (
        moves(block, here, modes, signs) or has_corners(block, here, modes) or like_corners(block, modes, _CORNER_WORDS)
    ):
        return
    # Of the block behind a contour, some controls tell by themselves what its words would have meant there.
    is_said = control.follow is not None and _is_of_contour(previous, modes)
    for each in explain_vocabulary(context, block, here, modes, _COMMA_WORDS):
        if not is_said or each.about is not ReadIssue.WORD_IDLE:
            yield each


def _of_words_beside(context: Context, block: Block, control: Control) -> Iterator[Diagnostic]:
    """Words of corners and angles beside a code that uses the words of its block in its own way."""
    words = [word for word in block.words if is_corner_word(word.address, control.modes.lexicon)]
    codes = codes_of(block, control.modes) if words else ()
    own = next((each for each in codes if not isinstance(each, Word) and each.effect in _OWN_USE), None)
    if own is not None:
        row = context.row(ReadIssue.WORD_BESIDE_CODE)
        yield report(context, row, Basis.RULE, words, name=own.text, meaning=own.meaning)


def _is_of_contour(previous: Previous | None, modes: Modes) -> bool:
    """Whether the last block that said something has the code of a contour."""
    codes = codes_of(previous[0][-1], modes) if previous else ()
    return any(not isinstance(code, Word) and code.effect is Effect.CONTOUR for code in codes)


def _of_unread(
    context: Context, block: Block, here: State, control: Control, previous: Previous | None
) -> Iterator[Diagnostic]:
    """That a block is not read, which is told once of several in a row."""
    unread, is_needed = control.modes.unread(block, here), bool(control.signs(block))
    if unread is None or (not is_needed and is_read_by_arcs(unread, block, here, control.modes)):
        return
    last = previous[0][-1].words if previous else ()
    is_first = unread in block.words and all(name_of(each) != name_of(unread) for each in last)
    if is_needed or is_first:
        yield not_read_yet(context, unread, is_needed=is_needed)


class _OfAllControls(Container[str]):
    """Words that any control has, which are looked for where one is not known."""

    def __init__(self, find: Callable[[Lexicon], Iterable[str]]) -> None:
        self._find = find

    @cached_property
    def _words(self) -> frozenset[str]:
        return frozenset(each for control in CONTROLS.values() for each in self._find(control.modes.lexicon))

    def __contains__(self, word: object) -> bool:
        return word in self._words


_COMMA_WORDS = _OfAllControls(lambda lexicon: (each for each in lexicon.addresses if each.startswith(",")))
"""The words with a comma."""

_CORNER_WORDS = _OfAllControls(corner_words)
"""The words that make corners and angles."""


# Slips -----------------------------------------------------------------------------------------------------------


def with_slips(
    asked: Request,
    blocks: Sequence[Block],
    states: tuple[State, State],
    ahead: Ahead,
    found: Sequence[Diagnostic],
    parts: Parts,
) -> Sequence[Diagnostic]:
    """The findings about the first of some blocks, with those about slips without which it would be a contour, and with
    what was meant. `states` are those before and behind it, `ahead` is before it, `parts` examines what is tried."""
    block, control = blocks[0], asked.control
    if control is None or asked.depth in (Depth.VERDICT, Depth.TRIAL):
        return found
    modes, context = control.modes, _context_of(asked, block)
    after_comma = modes.lexicon.after_comma
    if after_comma and any(word.address in after_comma for word in block.words):
        from contoursolve.diagnosis import explain_commas  # noqa: PLC0415 - few programs need it

        found = [
            *found,
            *explain_commas(_context_of(asked, block), control, blocks[:NEAR], states, last_of(ahead, modes)),
        ]
    if has_lookalike_code(block):
        found = with_letters(asked, control, blocks[:NEAR], states[0], found)
    own = [each for each in found if each.span.line == block.line]
    is_open = any(each.severity is not Severity.INFO for each in own) and not any(each.fixes for each in own)
    is_near = is_open and (any(map(_may_draw, blocks[:NEAR], repeat(control))) or _is_like_contour(block, modes))
    if is_near or (not own and any(doubtful_words(block, modes))):
        from contoursolve.diagnosis import mend_line  # noqa: PLC0415 - few programs need it

        window = window_of(ahead, (block,), blocks[1:NEAR], states[0], control, parts)
        others = [each for each in found if each.span.line != block.line]
        found = [*others, *mend_line(context, own, window)]
    return found


def _is_like_contour(block: Block, modes: Modes) -> bool:
    """Whether a code that the control has not is like that of a contour."""
    words = [word for word in block.words if word.address == "G" and word.number not in modes.codes and word.number]
    if not words:
        return False
    from contoursolve.diagnosis import mistyped_codes  # noqa: PLC0415 - few programs need it

    return any(mistyped_codes(word, modes) for word in words)


def _may_draw(block: Block, control: Control) -> bool:
    """Whether a block has, or almost has, a word by which contours are known."""
    is_long = any(len(word.address) > 1 for word in block.words) or "," in block.text
    return is_long or bool(control.signs(block))


def with_letters(
    asked: Request, control: Control, blocks: Sequence[Block], before: State, found: Sequence[Diagnostic]
) -> Sequence[Diagnostic]:
    """The findings about the first of some blocks, with those about letters with digits in whose place it would be a
    contour."""
    from contoursolve.diagnosis import explain_letters  # noqa: PLC0415 - few programs need it

    block = blocks[0]
    own = [each for each in found if each.span.line == block.line]
    others = [each for each in found if each.span.line != block.line]
    return [*others, *explain_letters(_context_of(asked, block), control, blocks, before, own)]


# Arcs ------------------------------------------------------------------------------------------------------------


def with_arcs(asked: Request, control: Control, step: Step) -> Step:
    """A step with the findings about its arcs, if it is no contour: about those in plain lines as well."""
    if step.answer is not None or asked.policy is Policy.OFF or (not step.blocks and step.passage is None):
        return step
    modes, context, found = control.modes, Context(asked.rules, asked.unit), list[Diagnostic]()
    for block in () if any(map(_is_of_shape, step.findings)) else step.blocks:
        found += _elsewhere(context, block, _explain_arc(context, control, block, step.before))
    if step.passage is not None:
        passage = step.passage
        for index in suspected(passage, step.before, modes):
            before = advance_plainly(step.before, passage.part(0, index), modes) if index else step.before
            line = passage.lines[index].rstrip("\r\n")
            found += _explain_arc(context, control, parse_block(line, passage.line + index, passage.syntax), before)
    if asked.policy is Policy.WARN:
        found = [replace(each, severity=Severity.WARNING) if each.is_error else each for each in found]
    return replace(step, findings=(*step.findings, *found)) if found else step


def _explain_arc(context: Context, control: Control, block: Block, before: State) -> Iterator[Diagnostic]:
    arc = arc_of(block, before, control.modes)
    if arc is not None:
        from contoursolve.diagnosis import explain_arc  # noqa: PLC0415 - many programs have none

        yield from explain_arc(context, control, arc, before)


def _is_of_shape(finding: Diagnostic) -> bool:
    """Whether a finding is an error in the shape of what is read as a contour is: it says what is wrong."""
    return finding.is_error and (finding.about is None or isinstance(finding.about, RefusalKind))


def _elsewhere(context: Context, block: Block, found: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Findings about a block; errors in another file are told at the block that calls it."""
    if not block.file:
        yield from found
        return
    caller = block.callers[0]
    place = Context(context.rules, context.unit, place=Span(caller.line, 1, len(caller.text) + 1))
    for each in found:
        if each.is_error:
            row = place.row(ReadIssue.SUBPROGRAM_REFUSED)
            yield report(place, row, Basis.RULE, [], file=block.file, line=each.span.line, finding=each.message)


def findings_of_values(pending: Pending, examine: Examine) -> Sequence[Diagnostic]:
    """Findings about what is read as a contour is, and is none."""
    answer = examine(pending.contour, pending)
    if not pending.contour.form.needs_values:
        return [each for each in answer.diagnostics if each.about not in _ABOUT_VALUES]
    return answer.diagnostics if answer.start.is_known else ()
