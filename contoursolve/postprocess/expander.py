"""One pass over a program: its contours written as plain G-code, and everything else byte for byte as it was."""

import re
from collections import deque
from collections.abc import Hashable, Iterable, Iterator
from decimal import Decimal
from itertools import chain

from msgspec.structs import replace

from contoursolve.diagnosis import Answer
from contoursolve.gcode import (
    ISO,
    Block,
    Passage,
    Syntax,
    Word,
    blocks_in,
    comment_out,
    is_remark,
    motion_of,
    own_comments,
    parse_block,
    remark,
    with_comments_of,
    words_of,
)
from contoursolve.geometry import Length
from contoursolve.postprocess.emit import Format, MotionBlock, emit, plane_of
from contoursolve.postprocess.expansion_report import ExpansionOptions, FixedWords, Left, Summary, left_unread
from contoursolve.postprocess.numbering import Numberer, Numbers, Offsets
from contoursolve.postprocess.post_processors import SAME, Arcs, MachineKind, machine_of
from contoursolve.postprocess.untranslatable import Watch
from contoursolve.program import ELSEWHERE, Lines, Step, path_of
from contoursolve.reading import (
    STANDING_ALONE,
    Code,
    ContourBlock,
    Control,
    Diameter,
    ParsedContour,
    ReadIssue,
    Reliance,
    State,
    apply_modes,
    blocks_of,
    carried,
    codes_of,
    frame_of,
    reliance,
    restate,
    why_unmet,
)
from contoursolve.solving import Point

OPENING = object()
"""Stands where the words belong that the target needs before anything else."""

_NO_MOTION = -1
"""The motion that is in force where none is: the control starts with it."""

NAMES = tuple(f"G{code:02}" for code in range(4))
"""The codes of motions as they are written."""


_TOLD = (
    ReadIssue.TEXT_OUTSIDE,
    ReadIssue.LETTER_FOR_DIGIT,
    ReadIssue.CODE_MISTYPED,
    ReadIssue.COMMA_MISSING,
    ReadIssue.COMMA_WORD_UNKNOWN,
)
"""Findings that are told about lines that stay, because these may be read otherwise than they are meant."""


class Expander:
    """One pass over one program."""

    has_motions = True
    """Tells that a motion stays in force."""
    has_absolute_centers, center_decimals = False, 0
    """Format of arc centres: coordinates or distances from the start, and the additional decimals."""

    def __init__(
        self, control: Control, options: ExpansionOptions, summary: Summary, lines: Lines, numbers: Numbers | None
    ) -> None:
        self.control = control
        self.modes = control.modes
        self.options = options
        self.summary = summary
        self.lines = lines
        self.watch = Watch(options.post, control, options.post.readings.get(machine_of(control)))
        summary.unfamiliar = self.watch.found
        self.numberer = Numberer(self.modes, numbers)
        self.lasting = self.modes.lasting if self.watch.reading is None else {}
        self.formats: dict[Hashable, Format] = {}
        self.offsets = Offsets(self.modes)
        spelled = options.post.modes.syntax if options.post.modes else control.modes.syntax
        self._other = spelled if spelled is not control.modes.syntax else None
        """How the target spells blocks, if it is in another way."""
        self._radius = control.modes.radius if options.post is SAME else "R"
        self.motion: int | None = None
        """The motion that is in force in the expanded program, where it differs from the original."""
        self.is_opened = False
        self.is_marked = False
        """Whether the last line says why what follows is not expanded."""

    def expand(self, steps: Iterable[Step]) -> Iterator[str | object]:
        coming, rest = deque[Step](), iter(steps)
        for step in _in_turn(rest, coming):
            if not self.is_opened and any(map(_is_active, step.blocks)):
                self.is_opened = True
                self.summary.line_end = self.lines.end_of(step.blocks[0].line)
                yield OPENING
            self.summary.warn([each for each in step.findings if each.about in _TOLD])
            if lost := [each for each in step.findings if each.about is ReadIssue.POINT_LOST]:
                line, sources = lost[0].span.line, {block.line: block.text for block in step.blocks}
                self.summary.left.append(Left((line,), f"{lost[0].code}: {lost[0].message}", tuple(lost), sources))
            self.summary.elsewhere += [each for each in step.findings if each.about in ELSEWHERE]
            if step.passage is not None:
                yield from self._pass(step.passage, step.before)
                continue
            if step.answer is None:
                for block in step.blocks:
                    yield from self._keep(block, step.before)
                continue
            differs = len({path_of(each) for each in (step.answer, *step.others)}) > 1
            several = "it is not the same every time that it runs; --inline writes each time out" if differs else ""
            reason = self._obstacle(step.answer) or step.shares or several or self._relying(step.answer, rest, coming)
            if reason:
                yield from self._leave(step, step.answer, reason)
            else:
                yield from self._replace(step, step.answer)
        self.watch.finish()

    # What stays as it is

    def _pass(self, passage: Passage, state: State) -> Iterator[str | object]:
        """Lines that only move, as they are; they are read into words only if they matter."""
        is_asking = self.watch.asks(passage.text) or self.watch.minds(state)
        texts: list[str] = []
        for place, line in enumerate(passage.lines):
            if self.is_opened and self.motion is None and not (self.offsets or is_asking or self._other):
                self.is_marked = is_remark(passage.lines[-1])
                texts.append(self.lines.take(passage, place))
                break
            words, number = words_of(line, passage.syntax), passage.line + place
            if words and not self.is_opened:
                self.is_opened = True
                self.summary.line_end = self.lines.end_of(number)
                yield "".join(texts)
                yield OPENING
                texts = []
            is_asked = is_asking and (self.watch.asks(line) or self.watch.minds(state))
            # An arc is restated in its own block.
            is_arc = self.motion is not None and motion_of(words) is None and state.motion not in ISO.plain.motions
            if words and (is_asked or is_arc):
                texts += self._keep(parse_block(line.rstrip("\r\n"), number, self.modes.syntax), state)
                continue
            if words:
                if self.motion is not None and motion_of(words) is None:
                    texts.append(self._name(state.motion) + self.lines.end)
                self.motion = None
                if self.offsets:
                    self.offsets.keep([axis for axis in self.modes.axes if axis not in words])
            self.is_marked = is_remark(line)
            texts.append(self._commented(line.rstrip("\r\n")) + self.lines.take_end(number))
        yield "".join(texts)

    def _keep(self, block: Block, state: State, there: int | None = None) -> Iterator[str]:
        """A block as it is; `there` is the motion that is in force before it in the expanded program. The target writes
        units, X as a diameter, and comments in its own way."""
        if block.words or block.macro or block.faults:
            there = self._motion_before(block, state) if there is None else there
            if self.motion is not None:
                before, block = self._restore(block, state)
                yield from before
            if self.offsets:
                self._tell(block, self.offsets.update(block, state))
            block, words = self._in_own_way(block)
            self.watch.look(block, words, state, there)
            self._tell(block, self.numberer.look(block))
            unread = left_unread(block)
            if unread:
                self.summary.left.append(unread)
                if not self.is_marked:
                    yield remark(unread.reason, self._syntax_of(block)) + self.lines.end
        self.is_marked = is_remark(block.text)
        yield self._commented(block.text) + self.lines.take_end(block.line)

    def _commented(self, text: str) -> str:
        """A line with its comments as the target has them."""
        return with_comments_of(text, self.modes.syntax, self._other) if self._other else text

    def _in_own_way(self, block: Block) -> tuple[Block, tuple[Word, ...]]:
        """A block with the codes of the target, and the words of it that stay as they are."""
        text, kept = block.text, list[Word]()
        for word, new in reversed([*self._switches(block)]):
            if new:
                text = text[: word.span.column - 1] + new + text[word.span.end_column - 1 :]
            else:
                kept.insert(0, word)
        return (block if text == block.text else replace(block, text=text)), tuple(kept)

    def _syntax_of(self, block: Block) -> Syntax:
        """Syntax of comments that are written for a block."""
        return self._other or block.syntax

    def _switches(self, block: Block) -> Iterator[tuple[Word, str]]:
        """The words of a block, each with how the target writes it, if that is in its own way."""
        rows = iter(codes_of(block, self.modes))
        for word in block.words:
            row = next(rows) if word.address == "G" else word
            yield word, self.options.post.switch(row) if isinstance(row, Code) else ""

    def _tell(self, block: Block, reason: str) -> None:
        """Keep in mind what is wrong with a block, if anything is."""
        if reason:
            self.summary.left.append(Left((block.line,), reason, (), {block.line: block.text}))

    def _restore(self, block: Block, state: State) -> tuple[list[str], Block]:
        """Lines before a block, and the block itself, after a contour that left another motion in force. With them the
        motion on which the block relies is in force again."""
        need, motion, before = reliance(block, self.modes), state.motion, []
        if need is Reliance.NONE:
            return [], block
        if need is not Reliance.ENDS and motion is not None:
            if motion in STANDING_ALONE:
                before = [self._name(motion) + self.lines.end]
            else:
                block = restate(block, self._name(motion))
                if block.is_skippable:
                    return [], block
        self.motion = None
        return before, block

    def _name(self, motion: int | None) -> str:
        """Spelling of a motion on the target."""
        code = self.modes.codes.get(motion) if motion is not None else None
        return code.text if code else f"G{motion:02}"

    def _motion_before(self, block: Block, state: State) -> int | None:
        """The motion that a block finds in the expanded program: that of a contour before it, unless what the block
        relies on is said again."""
        if self.motion is None or reliance(block, self.modes) is not Reliance.ENDS:
            return state.motion
        return self.motion

    def _leave(self, step: Step, answer: Answer, reason: str) -> Iterator[str]:
        """A contour as it was, below a comment that says why."""
        sources = {block.line: block.text for block in step.blocks}
        lines = tuple(block.line for block in answer.claim.blocks)
        self.summary.left.append(Left(lines, reason, answer.diagnostics, sources))
        first, *others = step.blocks
        there = self._motion_before(first, step.before)
        if self.motion is not None:
            before, first = self._restore(first, step.before)
            yield from before
        if not self.is_marked:
            yield remark(reason, self._syntax_of(first)) + self.lines.end
        state = step.before
        for block in (first, *others):
            yield from self._keep(block, state, there if block is first else None)
            state = apply_modes(state, block, self.modes)

    def _obstacle(self, answer: Answer) -> str:
        """The reason why a contour cannot be expanded; empty if it can."""
        errors = [each for each in answer.diagnostics if each.is_error]
        if errors or answer.contour is None:
            return f"{errors[0].code}: {errors[0].message}" if errors else "the contour is not known"
        if len({block.is_skippable for block in answer.claim.blocks}) > 1:
            return "some of its blocks begin with / and some do not: with them skipped, it is another contour"
        is_open = any(answer.claim.before.axes[axis].is_skippable for axis in answer.plane.axes)
        if is_open and not answer.claim.blocks[0].is_skippable:
            return "it begins where a block with / leads: with that block skipped, it is another contour"
        if answer.start.is_relative and None in {self._steps(part, answer) for part in self._parts(answer)}:
            return "where it begins is not known, and the target has no words for increments here"
        miscounted = self._miscounted(answer)
        if miscounted:
            return miscounted
        makes = answer.claim.makes or [("",) for _ in answer.claim.blocks]
        making = [block for block, made in zip(answer.claim.blocks, makes, strict=True) if made]
        beside = [word.text for block in making for word in answer.claim.beside_plane(block)]
        if not beside or (len(answer.claim.blocks) == 1 and len(answer.contour.elements) <= 1):
            return ""
        return f"{beside[0]} moves an axis outside the plane: move it in a block of its own"

    def _parts(self, answer: Answer) -> Iterator[ContourBlock]:
        return blocks_of(answer.claim, answer.claim.before, self.modes)

    def _steps(self, part: ContourBlock, answer: Answer) -> tuple[str, ...] | None:
        """The addresses of increments along the axes of a contour that has no place; empty where the axes have them by
        a code in force, None where the target has none."""
        if part.state.is_incremental or not answer.start.is_relative:
            return ()
        modes = self.modes if self.options.post is SAME else self.options.post.modes
        rows = modes.words(part.state).addresses.values() if modes is not None else ()
        steps = {row.axis: row.address for row in reversed([*rows]) if row.is_increment}
        found = tuple(steps[axis] for axis in answer.plane.axes if axis in steps)
        return found if len(found) == len(answer.plane.axes) else None

    def _miscounted(self, answer: Answer) -> str:
        """The reason why the target would mistake X for a diameter or for a radius; empty if it reads X alike."""
        claim, modes, counts = answer.claim, self.options.post.modes, any(answer.plane.diameters)
        diameter = claim.before.diameter
        if modes is None or diameter is None:
            return ""
        what = "a diameter" if counts else "a radius"
        parts = blocks_of(claim, claim.before, self.modes) if diameter is Diameter.ABSOLUTE else ()
        is_mixed = counts and any(part.state.is_incremental for part in parts)
        if not any(code.diameter for code in modes.codes.values()) and not is_mixed:
            is_lathe = machine_of(self.control) is MachineKind.LATHE
            settings = {setting.name for setting in self.control.settings}
            advice = f"; for a lathe, set {self.control.name}.machine=lathe" if "machine" in settings else ""
            return "" if counts is is_lathe else f"X is {what} here, and the target cannot switch that{advice}"
        if diameter is Diameter.ABSOLUTE:
            return "X is a diameter in absolute coordinates alone, which the target does not know"
        if diameter is Diameter.BY_PLANE:
            if self.summary.counts_diameters not in (None, counts):
                return f"X is {what} here, and another time it is not: say it in the program"
            self.summary.counts_diameters = counts
        return ""

    def _relying(self, answer: Answer, steps: Iterator[Step], coming: deque[Step]) -> str:
        """The reason why a contour must stay: a block behind it relies on the motion before it, which cannot be
        restored. Empty if there is none; steps read in the search are added to `coming`."""
        motion = answer.claim.after.motion
        if motion in STANDING_ALONE:
            return ""
        blocks = (block for step in chain(list(coming), _read_on(steps, coming)) for block in _blocks_of(step))
        return why_unmet(motion, blocks, self.modes)

    # What is replaced

    def _replace(self, step: Step, answer: Answer) -> Iterator[str]:
        claim, state = answer.claim, step.before
        elements = answer.contour.elements if answer.contour else ()
        parts = deque(blocks_of(claim, state, self.modes))
        axes = answer.plane.axes
        here = self._place(answer)
        had_ended = self.motion is not None
        motion = self.motion if had_ended else state.motion
        ended = self._ended(claim, state)
        for block in step.blocks:
            # A line may run several times.
            found = parts.popleft() if parts and parts[0].block.line == block.line else None
            aside = self._aside(found, claim, state)
            if aside is not None or found is None:
                yield from self._keep(block, aside or state)
                continue
            part = found
            state = part.state
            plane = state.plane if answer.plane is state.plane else plane_of(answer.plane, state)
            form = self._format(replace(state, plane=plane), self._steps(part, answer) or ())
            moves: list[MotionBlock] = []
            for segment in (each for each in elements if part.makes(each.name)):
                for move in emit(segment, here, form, is_rapid=self._is_rapid(part)):
                    here = move.end
                    if move.deviation > self.summary.deviation:
                        self.summary.deviation = move.deviation
                    if move.words:
                        moves.append(move)
            beside = [self._as_written(word, form, state) for word in claim.beside_plane(block)]
            if beside:
                move = moves.pop() if moves else MotionBlock(0 if part.is_rapid else 1, (), here, 0.0)
                moves.append(move._replace(words=(*move.words, *beside)))
            end = self.lines.take_end(block.line)
            self._end_lasting(moves, ended, claim.after if block is step.blocks[-1] else None)
            self._note_fixed(block, part.block)
            text = self._write(block, moves, end, state, part.block)
            if text:
                yield text
            if moves:
                motion = moves[-1].code
        self.is_marked = False
        is_same = (not self.has_motions or motion == claim.after.motion) and not (
            had_ended and claim.blocks[0].is_skippable
        )
        self.motion = None if is_same else _NO_MOTION if motion is None else motion
        contour = answer.contour
        if contour is not None:
            self.offsets.leave(axes, here, contour.end)
        self.summary.replaced += 1
        self.summary.warn(answer.diagnostics)

    def _aside(self, part: ContourBlock | None, _claim: ParsedContour, state: State) -> State | None:
        """The state before a block between those of a contour; None for a block that makes some of it."""
        return state if part is None else None

    def _is_rapid(self, part: ContourBlock) -> bool:
        return part.is_rapid

    def _ended(self, claim: ParsedContour, before: State) -> list[str]:
        """Codes that end the words which stay in force before a contour or in it; the written contour contains their
        effect."""
        stated = {word.address for block in claim.blocks for word in block.words} | before.memory.keys()
        return [off for address, off in self.lasting.items() if address in stated]

    def _end_lasting(self, moves: list[MotionBlock], ended: list[str], after: State | None) -> None:
        """Write what ends words into the first move of a contour, and those in force behind it into the last one."""
        if moves and ended:
            moves[0] = moves[0]._replace(words=(*moves[0].words, *ended))
            ended.clear()
        if moves and after is not None and self.lasting:
            resumed = [word.text.strip() for address, word in after.memory.items() if address in self.lasting]
            words = [word for word in moves[-1].words if not resumed or word not in self.lasting.values()]
            moves[-1] = moves[-1]._replace(words=(*words, *resumed))

    def _place(self, answer: Answer) -> Point:
        """The position of the tool at the start of a contour, in the expanded program; mm, X as radius."""
        (first, second), (one, two) = answer.start.values, self.offsets.take(answer.plane.axes)
        return float(first or 0) + one, float(second or 0) + two

    def _format(self, state: State, letters: tuple[str, ...] = ()) -> Format:
        """The format of the words of a block, with other `letters` of increments than its axes."""
        key = state.plane.axes, state.plane.diameters, state.unit is Length.INCH, state.is_incremental, letters
        if key not in self.formats:
            numbers, post = self.modes.lexicon.numbers, self.options.post
            own, decimals = post.digits(state.unit, numbers), self.options.decimals
            self.formats[key] = Format(
                state.plane,
                state.unit,
                own if decimals is None else decimals,
                post.writes_point(numbers),
                # Without a place, an absolute centre has none either.
                Arcs.RADIUS if letters and self.has_absolute_centers else self.options.arcs,
                state.is_incremental or bool(letters),
                own + self.center_decimals,
                self._radius,
                self.has_absolute_centers,
                letters,
                self.modes.lexicon.spelling,
            )
        return self.formats[key]

    def _as_written(self, word: Word, form: Format, state: State) -> str:
        """A word that moves an axis beside a contour, as the target writes numbers."""
        value = (self.modes.words(state).value(word, state.unit) or Decimal(0)) / state.unit.in_mm
        exponent = value.normalize().as_tuple().exponent
        places = max(form.decimals, -exponent if isinstance(exponent, int) else 0)
        return self.modes.lexicon.spell(word.address, form.number(float(value), f"%.{places}f"))

    def _write(self, block: Block, moves: list[MotionBlock], end: str, state: State, solved: Block) -> str:
        """The lines in place of a block; `solved` is the same with numbers for variables. Its number and what it sets
        stand in the first, what ends it in the last."""
        frame, rest = frame_of(block.text), carried(solved, self.modes)
        own = {word.text.strip(): new for word, new in self._switches(solved) if new}
        typed = self._typed(block)
        beside = [typed.get(word.address, word.text.strip()) for word in self._kept(solved)]
        indent = frame.indent
        lines = (
            [indent + text for text in comment_out(block.text.strip(), self._syntax_of(block))]
            if self.options.has_comments
            else []
        )
        self.watch.look(solved, [word for word in rest.kept if word.text.strip() not in own], state, None)
        comments = [] if self.options.has_comments else own_comments(block)
        texts = [[NAMES[move.code], *move.words] for move in moves]
        texts = texts or ([[]] if rest.says_something or comments else [])
        if texts:
            texts[0] = [*(own.get(code, code) for code in rest.codes), *texts[0], *beside, *comments]
            texts[-1] += rest.last
            self._tell(block, self.numberer.number(solved, [*rest.numbers], texts))
        lines += [indent + frame.skip + " ".join(text) for text in texts]
        if lines:
            lines[0] = frame.before + lines[0]
            lines[-1] += frame.behind
        return (end or self.lines.end).join(lines) + end if lines else ""

    def _note_fixed(self, block: Block, solved: Block) -> None:
        """Keep in mind the variables of a block that are numbers in what is written."""
        typed = self._typed(block)
        if not typed:
            return
        kept = {word.address for word in self._kept(solved)}
        known = {word.address: word.text.strip() for word in solved.words if word.address not in {"N", "G"}}
        # What a control reads as one word, RND R5, may be typed as several; what is empty is no word.
        others = {
            address: next((each for each in known.values() if f" {address}" in each), "nothing") for address in typed
        }
        fixed = {text: known.get(address, others[address]) for address, text in typed.items() if address not in kept}
        # What has no value stays as typed.
        fixed = {text: number for text, number in fixed.items() if text != number}
        if fixed:
            self.summary.fixed.append(FixedWords(block.line, tuple(fixed), tuple(dict.fromkeys(fixed.values()))))

    def _kept(self, solved: Block) -> list[Word]:
        """The words of a block of a contour that are written as typed."""
        rest = carried(solved, self.modes)
        return [word for word in rest.kept if word.text.strip() in rest.words]

    def _typed(self, block: Block) -> dict[str, str]:
        """The words of a block that have variables, by their addresses."""
        language = self.modes.language
        if language is None or not language.may_say(block.text):
            return {}
        code, found = language.read(block.text), dict[str, str]()
        for each in code.words:
            address = re.search(r"(,?[A-Za-z]*)[ \t]*=?[ \t]*\Z", block.text[: each.begin])
            if address is not None:
                found[address[1].upper()] = block.text[address.start() : each.end]
        return found


def _in_turn(steps: Iterator[Step], coming: deque[Step]) -> Iterator[Step]:
    """Every step, those that have been read ahead first."""
    for step in steps:
        yield step
        while coming:
            yield coming.popleft()


def _read_on(steps: Iterator[Step], coming: deque[Step]) -> Iterator[Step]:
    for step in steps:
        coming.append(step)
        yield step


def _blocks_of(step: Step) -> Iterable[Block]:
    if step.passage is None:
        return step.blocks
    return blocks_in(step.passage)


def _is_active(block: Block) -> bool:
    """Whether a block is more than the name of the program."""
    return bool(block.faults or block.macro) or any(word.address != "O" for word in block.words)
