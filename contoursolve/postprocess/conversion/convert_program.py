"""A whole program of one control in the words of another, read back: what leads elsewhere is written more plainly."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace as replace_fields
from decimal import Decimal
from enum import IntEnum
from itertools import count
from pathlib import PurePath

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison import Comparison, Motion, Place, ToolPath, Travel, Unfollowed, along, compare, follow
from contoursolve.diagnosis import Answer
from contoursolve.diagnostics import Severity
from contoursolve.execution import Call, CodeLine, ProgramKind, kind_of
from contoursolve.gcode import Block, Program, Word, parse
from contoursolve.geometry import CornerShape, Length, Plane
from contoursolve.postprocess.contour_drawing import draw, size_as
from contoursolve.postprocess.conversion.block_meaning import Meaning, is_message
from contoursolve.postprocess.conversion.block_writer import (
    BlockWriter,
    CornerWord,
    NoWordsError,
    WrittenMove,
    diameter_code,
    first_feed,
)
from contoursolve.postprocess.conversion.frames import FramePart, Frames
from contoursolve.postprocess.conversion.program_lines import ProgramLine, as_it_runs, in_order, lines_of, place_in
from contoursolve.postprocess.conversion.program_words import (
    ControlKind,
    ProgramFunction,
    are_alike,
    cell_of,
    kind_of_control,
)
from contoursolve.postprocess.expansion_report import NotConverted
from contoursolve.postprocess.post_processors import Arcs, MachineKind, machine_of
from contoursolve.postprocess.written import Moves, translate
from contoursolve.program import Request, Run, names_called, run
from contoursolve.reading import (
    Control,
    Effect,
    Modes,
    ReadIssue,
    State,
    axis_words,
    blocks_of,
    codes_of,
    rows_of,
)
from contoursolve.solving import ArcSegment
from contoursolve.tolerance import LENGTH


class Plainness(IntEnum):
    """The plainness of a line: what is not the same path in one way is tried in the next."""

    OWN_WORDS = 0
    PLAIN = 1
    LEFT = 2


class Converted(Struct, frozen=True):
    """A program in another control's words.

    Attributes:
        text: the program; None where its path would be wrong.
        left: what has no counterpart, by program line.
        in_words: how many contours are in the target's own words.
        written_out: the first program lines of contours that are plain lines and arcs there.
        notes: what was taken as the program does not say it, and what is assumed.
        comparison: that of both paths without the lines that are left; None where nothing was written.
        lines: the program line for each line of the text; 0 for one of its frame.
    """

    text: str | None
    left: tuple[NotConverted, ...]
    in_words: int
    written_out: tuple[int, ...]
    notes: tuple[str, ...]
    comparison: Comparison | None
    lines: tuple[int, ...] = ()
    shifts: Mapping[int, Mapping[str, float]] = {}
    """By line of the text, the way from where the program leads to its coordinates, mm by axis."""
    verbatim: frozenset[int] = frozenset()
    """The program lines that stay as they are."""


_CORNERS_OF_KLARTEXT = (CornerShape.FILLET, CornerShape.CHAMFER_SETBACK)
_MOST_ROUNDS = 60


def convert_program(
    text: str,
    name: str,
    controls: tuple[Control, Control],
    asked: Request,
    within: float,
    *,
    has_comments: bool = True,
    number: int = 1,
) -> Converted:
    """A program of the first control for the second one; `within` is how far apart both paths may be, mm, and `number`
    the program number where the program has a name. With `has_comments`, contours that are written out have their
    blocks above them as comments."""
    source, target = controls
    asked = replace(asked, control=source)
    examined = Run(parse(text, name), asked)
    program = examined.frame.program
    axes = tuple(sorted({*source.modes.axes, *target.modes.axes}))
    is_kept = are_alike(source, target) and all(
        _statements(source.modes, each) == _statements(target.modes, each) for each in program.blocks
    )
    ran, notes = (None, ()) if is_kept else as_it_runs(program, asked)
    result = examined.collect() if ran is None else examined.frame
    old = follow(result, source, asked.unit, axes, ran=ran)
    lines = [
        *lines_of(in_order(result, source, asked.unit) if ran is None else ran, source, old, is_run=ran is not None)
    ]
    levels = dict[int, Plainness]()
    found = None
    for _ in range(_MOST_ROUNDS):
        writer = _Program(lines, controls, asked, levels, name, number, has_comments=has_comments)
        found = writer.write()
        blamed, comparison = _judge(found, target, asked, old, within)
        found = replace(found, comparison=comparison, notes=(*notes, *found.notes))
        if not blamed:
            return replace(found, notes=(*found.notes, *_calls_of_others(program, source, old, found)))
        moved = [line for line in blamed if _retreat(line, lines, levels)]
        if not moved:
            break
    assert found is not None
    return replace(found, text=None)


def _calls_of_others(program: Program, source: Control, old: ToolPath, found: Converted) -> Iterator[str]:
    """That lines which stay as they are call other files."""
    language, ran = source.modes.language, dict[int, str]()
    for block in old.blocks:
        for caller in block.callers:
            ran[caller.line] = "" if not block.file else ran.get(caller.line, block.file)
    for block in program.blocks:
        names = names_called(language, block.text) if language is not None and block.line in found.verbatim else ()
        for name in dict.fromkeys(names):
            if file := ran.get(block.line, name):
                yield f"program line {block.line} calls {file}, another file: convert that, too"


def _retreat(line: int, lines: Sequence[ProgramLine], levels: dict[int, Plainness]) -> bool:
    """Write a line more plainly; whether that is possible."""
    for own in lines:
        key, level = own.first, levels.get(own.first, Plainness.OWN_WORDS)
        if own.line != line or level is Plainness.LEFT:
            continue
        is_contour = own.answer is not None and level is Plainness.OWN_WORDS
        levels[key] = Plainness.PLAIN if is_contour else Plainness.LEFT
        return True
    return False


def _judge(
    found: Converted, target: Control, asked: Request, old: ToolPath, within: float
) -> tuple[list[int], Comparison | None]:
    """The program lines to blame for an error of the new program or another path, and the comparison of both paths."""
    assert found.text is not None
    program = parse(found.text, "new", syntax=target.modes.syntax)
    result = run(program, replace(asked, control=target, start=None))
    errors = [
        (found.lines[each.span.line - 1] if 0 < each.span.line <= len(found.lines) else 0, each.about)
        for each in result.diagnostics
        if each.severity is Severity.ERROR
    ]
    blamed = [line for line, about in errors if line not in found.verbatim or about not in _NOT_KNOWN]
    if blamed:
        return [*dict.fromkeys(blamed)], None
    left = {each.called or each.line for each in found.left if each.is_block}
    new = follow(result, target, asked.unit, old.axes)
    first, second = _comparable(old, new, found, left)
    comparison = compare(first, second, within)
    if comparison.is_equal:
        return [], comparison
    difference = comparison.difference
    lines = [0]
    if difference is not None:
        at = [found.lines[difference.new.line - 1]] if difference.new is not None else []
        lines = [*at, *([difference.old.line] if difference.old is not None else [])] or [0]
    return [*dict.fromkeys(lines)][:1], comparison


def _comparable(old: ToolPath, new: ToolPath, found: Converted, left: set[int | str]) -> tuple[ToolPath, ToolPath]:
    """Both paths without the lines that are left: an axis that is not known behind one is not known in either."""
    origins, kept = found.lines, found.verbatim
    steps = [each for each in old.steps if (_place_of(each) not in left if _is_move(each) else _place_of(each) in kept)]
    called = [replace(each, line=each.called_at) if isinstance(each, Travel) and each.file else each for each in steps]
    first = [each for each in called if not each.file or each.line not in kept]
    has_left = len(first) < len(old.steps)
    second = [
        _moved_back(each, found.shifts.get(each.line, {}), new.axes) if isinstance(each, Travel) else each
        for each in new.steps
        if not each.file and (_is_move(each) or origins[each.line - 1] in kept)
    ]
    by_line, at = dict[int, list[int]](), None
    for place, step in enumerate(second):
        by_line.setdefault(origins[step.line - 1], []).append(place)
    seen, there = dict[int, int](), set[int]()
    for number, step in enumerate(first):
        places, count = by_line.get(step.line, []), seen.get(step.line, 0)
        own = second[places[count]] if count < len(places) else None
        if own is None and at is not None and isinstance(step, Travel) and _leads_to(step, at):
            there.add(number)
            continue
        seen[step.line] = count + 1
        if isinstance(own, Travel) and isinstance(step, Travel):
            at = own.end
            second[places[count]] = _as_unknown(own, step)
            if has_left and step.bend is None:
                first[number] = _at_rest(step, own)
    kept_steps = (step for number, step in enumerate(first) if number not in there)
    return replace(old, steps=tuple(kept_steps)), replace(new, steps=tuple(second))


def _place_of(step: Travel | Unfollowed) -> int | str:
    """The place of a step, as what is left names it."""
    return place_in(step.file, step.line) if step.file else step.line


def _is_move(step: Travel | Unfollowed) -> bool:
    return isinstance(step, Travel) and step.motion is not Motion.PRESET


def _leads_to(step: Travel, place: Place) -> bool:
    """Whether a line from where nobody knows leads to where the tool is in the new program already."""
    ways = [(end, at) for start, end, at in zip(step.start, step.end, place, strict=True) if start != end]
    return None in step.start and all(
        end is not None and at is not None and abs(end - at) <= LENGTH for end, at in ways
    )


def _moved_back(step: Travel, shift: Mapping[str, float], axes: tuple[str, ...]) -> Travel:
    """A step of the new program in the coordinates of the old one."""
    return step.moved([-shift.get(axis, 0.0) * (axis not in step.free) for axis in axes]) if shift else step


def _as_unknown(step: Travel, like: Travel) -> Travel:
    """A step without the places that another one does not know."""
    start = tuple(None if other is None else at for at, other in zip(step.start, like.start, strict=True))
    end = tuple(None if other is None else at for at, other in zip(step.end, like.end, strict=True))
    return replace(step, start=start, end=end) if (start, end) != (step.start, step.end) else step


def _at_rest(step: Travel, like: Travel) -> Travel:
    """A step without the places of axes that it does not move, and that another one does not know: a block that is left
    has led there."""
    ways = [*zip(step.start, step.end, like.start, like.end, strict=True)]
    unknown = [one == two and other is None and last is None for one, two, other, last in ways]
    if not any(unknown):
        return step
    start, end = (
        tuple(None if is_open else at for at, is_open in zip(place, unknown, strict=True))
        for place in (step.start, step.end)
    )
    return replace(step, start=start, end=end)


_HEADS = (
    re.compile(r"^\s*%_N_(?P<name>\w+?)_(?:MPF|SPF)\s*$", re.IGNORECASE),
    re.compile(r"^\s*(?:N?\d+\s+)?BEGIN\s+PGM\s+(?P<name>\S+)\s+(?:MM|INCH)\s*$", re.IGNORECASE),
    re.compile(r"^\s*(?:O|:)(?P<number>\d{1,8})\s*(?:\((?P<told>[^)]*)\))?\s*$", re.IGNORECASE),
    re.compile(r"^\s*%(?P<number>\d{1,8})\s*$"),
    re.compile(r"^\s*%(?P<name>[A-Za-z]\w*)\s*(?:\((?P<told>[^)]*)\))?\s*$"),
    re.compile(r"^\s*<(?P<name>\w+)>\s*$"),
)
_TAPE = re.compile(r"^\s*%\s*$")
_PATH = re.compile(r"^\s*;\s*\$PATH=", re.IGNORECASE)
_DATUM = re.compile(r"^\s*(?:N?\d+\s+)?CYCL\s+DEF\s+7\.0\b", re.IGNORECASE)
"""The head of a datum shift in Klartext, whose numbers follow."""
_END_PGM = re.compile(r"^\s*(?:N?\d+\s+)?END\s+PGM\b", re.IGNORECASE)


class _Program:
    """One attempt to write all lines, some of them more plainly than others."""

    def __init__(
        self,
        lines: Sequence[ProgramLine],
        controls: tuple[Control, Control],
        asked: Request,
        levels: Mapping[int, Plainness],
        name: str,
        number: int,
        *,
        has_comments: bool,
    ) -> None:
        source, self.target = controls
        self.source, self.lines, self.levels, self.number = source, lines, levels, number
        self.has_comments = has_comments
        self.kinds = kind_of_control(source), kind_of_control(self.target)
        first = next((_unit(each) for each in lines if _unit(each)), None) or _unit_of_head(lines) or asked.unit
        self.unit = first
        self.writer = BlockWriter(self.target, self.kinds[1], first, self.kinds[0], first_feed(source))
        self.in_words, self.written_out = 0, list[int]()
        self.translated = dict[int, Moves | None]()
        self.name = "" if name.startswith("<") else PurePath(name).stem
        self.is_opened = False
        self.has_frame = False
        self.is_alike = are_alike(source, self.target)
        self.is_run = (
            self.is_alike
            and kind_of((each.block.text for each in lines), source.modes.language) is ProgramKind.FOLLOWED
        )
        """Tells whether blocks run as relatives call and compute them, so that they stay as they are where both read
        them alike."""
        self._names = _names_of(source, self.target) if self.is_run else {}
        self.verbatim = set[int]()
        """The lines that stay as they are."""
        self.speeds_told = set[int]()
        self.frames = Frames(source)
        self.changed: Mapping[str, FramePart] = {}
        """The parts of the coordinate system that the line changes."""

    def write(self) -> Converted:
        """The whole program."""
        writer = self.writer
        head, told = self._head()
        self._begin(head, told)
        for place, line in enumerate(self.lines):
            self._line(place, line)
        self._end()
        texts = writer.lines
        if writer.is_klartext:
            texts = [f"{number} {text}" for number, text in enumerate(texts)]
        assumed = [*self._assumptions()]
        notes = [
            *dict.fromkeys(writer.notes),
            *([f"{', '.join(assumed)}: assumed, as we saw no page of a manual"] if assumed else []),
        ]
        return Converted(
            "\n".join(texts) + "\n",
            _once(writer.found),
            self.in_words,
            tuple(self.written_out),
            tuple(notes),
            None,
            tuple(writer.origins),
            {line: shift for line, shift in writer.shifts.items() if shift and line <= len(writer.lines)},
            frozenset(self.verbatim),
        )

    def _assumptions(self) -> Iterator[str]:
        """The words that are written by rows that no page seen prints."""
        for function, line in self.writer.used.items():
            cells = [cell_of(function, kind) for kind in self.kinds]
            if self.kinds[0] is not self.kinds[1] and any(
                cell is not None and cell.source.evidence.value == "assumed" for cell in cells
            ):
                cell = cells[1]
                text = cell.texts[0].replace(" {}", "").replace("{}", "") if cell and cell.texts else ""
                yield f"{text or function.value} ({function.value}, program line {line})"

    # The frame

    def _head(self) -> tuple[dict[str, str], int]:
        """The name and the number of the program, and its line; 0 for none."""
        for line in self.lines[:8]:
            text = line.block.text
            for pattern in _HEADS:
                match = pattern.match(text)
                if match is not None:
                    return {name: value for name, value in match.groupdict().items() if value}, line.block.line
            if line.block.words or line.block.macro:
                break
        return {}, 0

    def _begin(self, head: Mapping[str, str], line: int) -> None:
        writer, kind = self.writer, self.kinds[1]
        writer.begin(line)
        self.head_line = line
        is_whole = bool(head) or any(_TAPE.match(each.block.text) for each in self.lines) or self._has_end()
        self.has_frame = is_whole or writer.is_klartext
        if not self.has_frame:
            return
        number = head.get("number", "")
        name = head.get("name", "")
        told = head.get("told", "").strip()
        if kind.is_fanuc:
            digits = number or (re.sub(r"^PROG", "", name) if re.fullmatch(r"PROG\d{1,5}", name) else "")
            said = name if name and not digits else told
            width = 5 if kind in (ControlKind.HAAS_LATHE, ControlKind.HAAS_MILL) else 4
            writer.put("%", is_comment=True)
            comment = f" {writer.comments(said)[0]}" if said else ""
            writer.put(f"O{int(digits or self._free_number()):0{width}d}{comment}", is_comment=True)
            return
        own = name or (f"PROG{int(number)}" if number else self.name or "PROG")
        own = re.sub(r"\W", "_", own.upper())[:24]
        if kind is ControlKind.SINUMERIK:
            own = own if re.match(r"[A-Z_]{2}", own) else f"PROG_{own}"[:24]
            writer.put(f"%_N_{own}_MPF", is_comment=True)
        elif kind is ControlKind.ISG:
            writer.put(f"%{own}", is_comment=True)
        elif writer.is_klartext:
            unit = "MM" if self.unit is Length.MM else "INCH"
            writer.put(f"BEGIN PGM {own} {unit}")
            self.own_name = f"{own} {unit}"
        if told:
            writer.comment(told)

    def _free_number(self) -> int:
        """The number of a program that has none: one that no subprogram of it has."""
        taken = {word.number for each in self.lines for word in each.block.words if word.address == "O"}
        return next(number for number in count(self.number) if number not in taken)

    own_name = ""

    def _has_end(self) -> bool:
        return any(each.meaning.has(ProgramFunction.END) for each in self.lines)

    def _end(self) -> None:
        writer = self.writer
        writer.begin(0)
        if not self.has_frame:
            return
        if self.kinds[0] is ControlKind.KLARTEXT and not self._has_end():
            writer.put("M30")
        if self.kinds[1].is_fanuc:
            writer.put("%", is_comment=True)
        elif writer.is_klartext:
            writer.put(f"END PGM {self.own_name}")

    def _opening(self, line: ProgramLine) -> list[str]:
        """The codes of the first block: whatever the program leaves to how its control starts is written, too."""
        writer, target, meaning = self.writer, self.target, line.meaning
        if writer.is_klartext:
            return []
        is_alike = self.is_alike
        codes = list[str]()
        has_plane = any(code.effect is Effect.PLANE for code, _ in meaning.codes)
        if not is_alike and not has_plane and self.kinds[1].family is not ControlKind.FANUC_LATHE:
            plane = next(
                (row for row in target.modes.codes.values() if row.plane and row.plane.code == line.before.plane.code),
                None,
            )
            codes += [writer.code(plane.number)] if plane is not None else []
        has_absolute = any(code.effect in (Effect.ABSOLUTE, Effect.INCREMENTAL) for code, _ in meaning.codes)
        has_code = any(row.effect is Effect.ABSOLUTE for row in target.modes.codes.values())
        if not is_alike and has_code and not has_absolute:
            codes.append(writer.code(90))
        says_unit = any(_unit(each) for each in self.lines[:30])
        if not is_alike and not says_unit and self.kinds[0] is not ControlKind.KLARTEXT:
            codes.append(writer.word(ProgramFunction.MM if self.unit is Length.MM else ProgramFunction.INCH))
            writer.notes.append(
                f"the program states no unit: {codes[-1]} is written, as {self.unit.value} is what it was read in"
            )
        elif not is_alike and self.kinds[0] is ControlKind.KLARTEXT:
            codes.append(writer.word(ProgramFunction.MM if self.unit is Length.MM else ProgramFunction.INCH))
        says_feed = any(
            each.meaning.has(
                ProgramFunction.FEED_A_MINUTE,
                ProgramFunction.FEED_A_TURN,
                ProgramFunction.CUTTING_SPEED,
                ProgramFunction.TURNING_SPEED,
            )
            for each in self.lines
        )
        has_feed = any(each.meaning.has(ProgramFunction.FEED) for each in self.lines)
        if not is_alike and not says_feed and has_feed:
            mode = first_feed(self.source)
            codes.append(writer.word(mode))
            if self.kinds[0] is not ControlKind.KLARTEXT:
                writer.notes.append(f"the program states no feed mode: {codes[-1]} ({mode.value}) is written")
            writer.feeds.mode = mode
        if not is_alike and machine_of(target) is MachineKind.LATHE and (text := diameter_code(target)):
            codes.append(writer.code(51) if text == "G51" else text)
        return codes

    # Lines

    def _line(self, place: int, line: ProgramLine) -> None:
        writer, block, meaning = self.writer, line.block, line.meaning
        self.changed, text = self.frames.take(line), block.text.strip()
        if self.head_line and line.line == self.head_line:
            self._comments(meaning, is_head=True)
            return
        if _TAPE.match(text) or _PATH.match(text) or _END_PGM.match(text) or self._is_head(text):
            return
        if not text:
            if not writer.is_klartext:
                writer.begin(line.line)
                writer.put_blank()
            return
        called = place_in(block.file, block.line) if block.file else ""
        writer.begin(line.line, is_skippable=block.is_skippable, label=meaning.number, called=called)
        if not (block.words or block.macro or block.faults) or is_message(block) or self._is_silent(line):
            self._comments(meaning)
            return
        writer.shift = self.frames.shift()
        reason = self._reason(line)
        if self.is_run and self._is_read_alike(line):
            self._keep(line)
        elif self._is_of_zero(line):
            self._move_zero(line)
        elif not reason:
            self._write(place, line)
        else:
            self._keep_or_leave(line, reason)
        writer.here = {axis: at for axis, at in writer.here.items() if _is_known(line.after, axis)}

    def _is_head(self, text: str) -> bool:
        return self.kinds[0] is ControlKind.KLARTEXT is not self.kinds[1] and _DATUM.match(text) is not None

    def _is_of_zero(self, line: ProgramLine) -> bool:
        """Whether a block only shifts the coordinate system, by numbers, or ends what does not turn it."""
        meaning, block, modes = line.meaning, line.block, self.source.modes
        rows = [(row, word.text.strip()) for row, word in modes.zero.rows_in(block) if not row.group]
        lost = {*meaning.lost} - {text for _, text in rows}
        has_codes = any(code.effect not in _COUNTS for code, _ in meaning.codes)
        says_more = bool(meaning.functions or lost or meaning.motion or has_codes or block.is_skippable)
        is_frame = any(code.effect in (Effect.FRAME, Effect.PRESET) for code in rows_of(block, modes))
        is_end = is_frame and not axis_words(block, modes)
        if says_more or not (is_end or (self.changed and (is_frame or rows or block.macro))):
            return False
        return self.frames.differs_by() is None and not self._is_read_alike(line)

    def _move_zero(self, line: ProgramLine) -> None:
        """A shift of the coordinate system in the words of the target, or worked into the blocks behind it."""
        writer = self.writer
        self._comments(line.meaning)
        if not writer.shift:
            return
        if writer.move_zero(self.frames.shifts()):
            self.frames.convert_shifts()
        else:
            writer.comment(line.block.text)
            writer.notes.append(f"program line {line.line}: {_bare(line)} is worked into the coordinates behind it")
        writer.shift = self.frames.shift()

    def _keep_or_leave(self, line: ProgramLine, reason: str) -> None:
        """A block that is not converted: between relatives that read it alike it stays as it is, else as a comment."""
        if self._is_read_alike(line):
            self._keep(line)
        else:
            self._leave(line, reason)

    def _keep(self, line: ProgramLine) -> None:
        """A block as it is, but for the names of its words."""
        block, writer = line.block, self.writer
        text = block.text
        for word in reversed(block.words):
            own, begin, end = self._names.get(word.address), word.span.column - 1, word.span.end_column - 1
            if own is not None:
                text = text[:begin] + own + text[begin:end].strip(" ,")[len(word.address.strip(",")) :] + text[end:]
        text = text.strip()
        # Its number and its skip are in it, which a statement needs as well.
        writer.label = writer.skip = ""
        writer.put(text, is_comment="O" in text[:1].upper())
        writer.here = {}
        if line.answer is not None and line.answer.lines[0] == block.line:
            self.in_words += 1
        self.verbatim.add(line.line)
        self.is_opened = True
        self.frames.convert(self.changed)

    def _write(self, place: int, line: ProgramLine) -> None:
        """Write what a line says in the words of the target; what it has no words for is left."""
        writer, meaning = self.writer, line.meaning
        speed = self._speed_behind(place) if writer.is_klartext else None
        if writer.is_klartext and line.line in self.speeds_told:
            meaning = _without(meaning, ProgramFunction.SPEED)
        kept = writer.state, len(writer.lines), len(writer.found), writer.label
        opening = [] if self.is_opened else self._opening(line)
        has_states = bool(meaning.codes) or meaning.has(*_HEAD)
        try:
            if opening and not has_states:
                label, skip = writer.label, writer.skip
                writer.label = writer.skip = ""
                writer.put(" ".join(opening))
                writer.label, writer.skip, opening = label, skip, []
            self._put(line, meaning, speed, opening)
            self.is_opened = True
            if len(writer.found) == kept[2]:
                self.frames.convert(self.changed)
        except NoWordsError as error:
            writer.state, length, found, writer.label = kept
            del writer.lines[length:], writer.origins[length:], writer.found[found:]
            writer.trailing = ""
            self._keep_or_leave(line, str(error))

    def _put(self, line: ProgramLine, meaning: Meaning, speed: Decimal | None, opening: Sequence[str]) -> None:
        """The lines of a block, with its comments and what of it is not converted."""
        writer = self.writer
        moves = [*self._moves(line)]
        *above, last = meaning.comments or [""]
        for text in above:
            writer.comment(text)
        for word in meaning.lost:
            is_open = any(each.text.strip() == word.strip() and each.number is None for each in line.block.words)
            is_value = is_open and word.strip()[:1].isalpha() and "=" in word
            writer.leave(word, "its value is known only when it runs" if is_value else "no counterpart is known")
        writer.trailing = " ".join(writer.comments(last)) if last else ""
        radius = meaning.radius
        if radius is not None and radius.number != writer.tool and writer.tool and not writer.needs_d:
            writer.leave(radius.text, "the radius is not that of the tool, and the target takes it from the tool")
        counts = line.answer is None and line.after.is_incremental and not any(move.arc for move in moves)
        writer.write(meaning, moves, speed, [code for code in opening if code], is_incremental=counts)
        if writer.trailing:
            writer.trailing = ""
            writer.comment(last)

    def _is_read_alike(self, line: ProgramLine) -> bool:
        """Whether a block stays as it is: both controls are relatives that read its statements and its words alike."""
        block, answer = line.block, line.answer
        level = self.levels.get(line.first, Plainness.OWN_WORDS)
        if not self.is_alike or level is not Plainness.OWN_WORDS or block.faults:
            return False
        if answer is not None and not (self.is_run and _is_sound(answer)):
            return False
        one, other = self.source.modes, self.target.modes
        said = _statements(one, block)
        if said != _statements(other, block):
            return False
        is_same_kind = self.kinds[0] is self.kinds[1]
        for own, new in zip(codes_of(block, one), codes_of(block, other), strict=True):
            if isinstance(own, Word) or isinstance(new, Word):
                # A name is a cycle or a subprogram, which only a control of the same kind calls so.
                if not (is_same_kind and isinstance(own, Word) and isinstance(new, Word)):
                    return False
            elif own.effect is not new.effect:
                return False
        if not self.is_run or (said is not None and any(isinstance(each, Call) for each in said.statements)):
            return True
        has_same_words = all(
            (word.address in one.lexicon.addresses)
            is (self._names.get(word.address, word.address) in other.lexicon.addresses)
            for word in block.words
        )
        return has_same_words and all(
            cell_of(each.function, self.kinds[0]) == cell_of(each.function, self.kinds[1])
            and (is_same_kind or (each.has_point and each.function is not ProgramFunction.DWELL))
            for each in line.meaning.functions
        )

    def _is_silent(self, line: ProgramLine) -> bool:
        """Whether a line of Klartext is the pole of arcs, which each arc has itself, or says nothing more."""
        said = line.meaning.restated
        is_said = said is not None and not (said.ends or said.around or said.reason)
        return is_said and line.meaning.is_silent and not line.travels and line.answer is None

    def _comments(self, meaning: Meaning, *, is_head: bool = False) -> None:
        for text in meaning.comments:
            if not (is_head and self.has_frame):
                self.writer.comment(text)

    def _leave(self, line: ProgramLine, reason: str) -> None:
        self._comments(line.meaning)
        if self.is_run and self.writer.label:
            # A jump may lead to it.
            label, self.writer.label = self.writer.label, ""
            self.writer.put(label)
        self.writer.leave(_bare(line), reason, is_block=True)

    def _reason(self, line: ProgramLine) -> str:
        """The reason why a line is not converted at all; empty if it is."""
        if self.levels.get(line.first) is Plainness.LEFT:
            return "the target would cut another path there"
        if any(each.cycle for each in line.block.callers):
            return "it is the profile of a cycle"
        if line.meaning.reason:
            return line.meaning.reason
        if line.meaning.end and (self.is_alike or self.changed):
            return line.meaning.end
        other = self.frames.differs_by() if line.travels or line.lost or line.answer is not None else None
        if other is not None and other is not line:
            return f"{_bare(other)} (line {other.line}) is not converted, and moves or turns it: write both by hand"
        if line.answer is not None and line.answer.contour is None:
            errors = [each for each in line.answer.diagnostics if each.is_error]
            return f"{errors[0].code}: {errors[0].message}" if errors else "the contour is not solved"
        is_offset = any(each.function.is_offset for each in line.meaning.functions)
        return line.lost[0].reason if line.lost and not (is_offset or line.meaning.end) else ""

    def _speed_behind(self, place: int) -> Decimal | None:
        """The next speed behind a tool call, which Klartext has in it."""
        if not self.lines[place].meaning.has(ProgramFunction.TOOL_CHANGE):
            return None
        for number, line in enumerate(self.lines[place:]):
            if number and line.meaning.has(ProgramFunction.TOOL_CHANGE):
                return None
            speed = line.meaning.value(ProgramFunction.SPEED)
            if speed is not None:
                self.speeds_told.add(line.line)
                return speed
        return None

    def _moves(self, line: ProgramLine) -> Iterator[WrittenMove]:
        shift = self.writer.shift
        for move in self._own_moves(line):
            if not shift:
                yield move
                continue
            ends = {axis: at + shift.get(axis, 0.0) for axis, at in move.ends.items()}
            by = [shift.get(axis, 0.0) for axis in self._axes()]
            yield replace(move, ends=ends, arc=move.arc.moved(by) if move.arc is not None else None)

    def _own_moves(self, line: ProgramLine) -> Iterator[WrittenMove]:
        answer = line.answer
        if answer is not None:
            level = self.levels.get(line.first, Plainness.OWN_WORDS)
            own = self._own_words(line, answer) if level is Plainness.OWN_WORDS else None
            if own is not None:
                yield from own
                return
            if line.first not in self.written_out:
                self.written_out.append(line.first)
            if self.has_comments:
                self.writer.comment(line.block.text)
            for travel in line.travels:
                yield self._travel(travel)
            return
        yield from self._plain(line)

    def _travel(self, travel: Travel) -> WrittenMove:
        """A step of the path as one move, by coordinates."""
        if travel.free:
            raise NoWordsError("where it begins is not known")
        ends = {
            axis: float(end)
            for axis, start, end in zip(self._axes(), travel.start, travel.end, strict=True)
            if end is not None and start != end
        }
        in_plane = travel.plane.axes if travel.plane is not None and travel.bend is not None else ()
        ends |= {
            axis: float(end)
            for axis, end in zip(self._axes(), travel.end, strict=True)
            if axis in in_plane and end is not None
        }
        return WrittenMove(travel.motion is Motion.RAPID, ends, arc=travel if travel.bend is not None else None)

    def _axes(self) -> tuple[str, ...]:
        return tuple(sorted({*self.source.modes.axes, *self.target.modes.axes}))

    def _plain(self, line: ProgramLine) -> Iterator[WrittenMove]:
        """The moves of a line that is no contour."""
        block, modes = line.block, self.source.modes
        if line.meaning.has(ProgramFunction.DWELL):
            return
        if modes.follow is not None:
            yield from self._of_klartext(line)
            return
        here = line.after
        lexicon = modes.words(here)
        words = [
            (word, lexicon.addresses[word.address])
            for word in block.words
            if word.address in lexicon.addresses and lexicon.addresses[word.address].axis
        ]
        arcs = [each for each in line.travels if each.bend is not None]
        if arcs:
            by_radius = block.find(modes.radius) is not None
            for travel in arcs:
                yield replace(self._travel(travel), is_by_radius=by_radius)
            return
        if not words:
            return
        places, counts = dict[str, float](), dict[str, float]()
        for word, row in words:
            value = lexicon.value(word, here.unit)
            if value is None:
                raise NoWordsError(f"{word.text.strip()} is not known")
            if row.is_step(is_incremental=here.is_incremental):
                counts[row.axis] = float(value)
                at = here.axes[row.axis].value
                if at is not None:
                    places[row.axis] = float(at)
            else:
                places[row.axis] = float(value)
        if here.motion is None and not line.travels:
            raise NoWordsError("no motion is in force")
        yield WrittenMove(here.motion == 0, places, counts)

    def _of_klartext(self, line: ProgramLine) -> Iterator[WrittenMove]:
        """The moves of a line of Klartext that is no contour."""
        block, modes, said = line.block, self.source.modes, line.meaning.restated
        if said is None or not said.ends:
            return
        if said.around is not None:
            for travel in line.travels:
                yield replace(self._travel(travel), is_by_radius=block.find(modes.radius) is not None)
            return
        rows = [modes.lexicon.addresses.get(word.address) for word in block.words]
        steps = {row.axis for row in rows if row is not None and row.is_increment}
        ends = dict(said.ends)
        yield WrittenMove(said.is_rapid, ends, {axis: self._step(line, axis) for axis in steps if axis in ends})

    def _step(self, line: ProgramLine, axis: str) -> float:
        one, other = line.before.axes[axis].value, line.after.axes[axis].value
        if one is None or other is None:
            raise NoWordsError(f"where {axis} is before it is not known")
        return float(other - one)

    # Contours

    def _own_words(self, line: ProgramLine, answer: Answer) -> list[WrittenMove] | None:
        """The moves of a line of a contour in the words of the target; None where it has none for the contour."""
        first = id(answer)
        if first not in self.translated:
            self.translated[first] = None
            if not self.writer.is_klartext:
                self.translated[first] = self._translate(answer)
            if self.writer.is_klartext or self.translated[first] is not None:
                self.in_words += 1
        if self.writer.is_klartext:
            return [*self._with_corners(line, answer)]
        moves = self.translated[first]
        if moves is None:
            return None
        found = list[WrittenMove]()
        for name, blocks in moves.items():
            if line.part is None or not line.part.makes(name):
                continue
            for each in blocks:
                ends = dict(zip(answer.plane.axes, each.end, strict=True))
                found.append(WrittenMove(each.code == 0, ends, texts=each.words, code=each.code))
        return found

    def _translate(self, answer: Answer) -> Moves | None:
        if answer.contour is None or answer.start.is_relative or self.writer.state.is_incremental or self.writer.shift:
            return None
        parts = [*blocks_of(answer.claim, answer.claim.before, self.source.modes)]
        if len({part.is_rapid for part in parts}) > 1 or len({part.state.is_incremental for part in parts}) > 1:
            return None
        state = self.writer.state
        if {*state.plane.axes} != {*answer.plane.axes}:
            return None
        plane = replace(answer.plane, diameters=_diameters(answer.plane, state.plane), centers=answer.plane.centers)
        form = self.writer.form(
            replace(state, plane=plane), Arcs.RADIUS if self._states_radius(answer) else Arcs.CENTER
        )
        place = tuple(
            self.writer.here.get(axis, start)
            for axis, start in zip(answer.plane.axes, answer.contour.start, strict=True)
        )
        return translate(answer, self.target, (place[0], place[1]), form, is_rapid=parts[0].is_rapid)

    def _states_radius(self, answer: Answer) -> bool:
        return any(word.address == self.source.modes.radius for block in answer.claim.blocks for word in block.words)

    def _with_corners(self, line: ProgramLine, answer: Answer) -> Iterator[WrittenMove]:
        """The elements of a line with the words of Klartext for the corners behind them."""
        drawn, is_rapid = draw(answer), any(each.motion is Motion.RAPID for each in line.travels)
        for element in drawn.elements:
            segment = element.segment
            if line.part is None or not line.part.makes(segment.name):
                continue
            corner = element.corner
            said = None
            if corner is not None:
                shape = next((each for each in _CORNERS_OF_KLARTEXT if size_as(each, element) is not None), None)
                if shape is None or element is drawn.elements[-1]:
                    raise NoWordsError("Klartext has no word for its corner")
                said = CornerWord(shape, float(size_as(shape, element) or 0.0))
            ends = dict(zip(answer.plane.axes, segment.end, strict=True))
            if isinstance(segment, ArcSegment):
                like = next(each for each in line.travels)
                axes = self._axes()
                arc = along(replace(like, plane=answer.plane, element=segment.name), segment, axes)
                yield WrittenMove(False, ends, arc=arc, is_by_radius=self._states_radius(answer), corner=said)
                continue
            changed = {
                axis: end
                for axis, end, start in zip(answer.plane.axes, segment.end, segment.start, strict=True)
                if abs(end - start) > LENGTH
            }
            yield WrittenMove(is_rapid, changed or ends, corner=said)


_COUNTS = (Effect.ABSOLUTE, Effect.INCREMENTAL)
_NUMBER = re.compile(r"^N?\d+\s+", re.IGNORECASE)


def _bare(line: ProgramLine) -> str:
    """A block without its number and its comments."""
    block = line.block
    bare = block.syntax.comment.sub("", block.text).strip().lstrip("/").strip()
    return _NUMBER.sub("", bare) if line.meaning.restated is not None or block.macro is not None else bare


_HEAD = (ProgramFunction.MM, ProgramFunction.INCH, ProgramFunction.FEED_A_MINUTE, ProgramFunction.FEED_A_TURN)
_NOT_KNOWN = (ReadIssue.VARIABLE, ReadIssue.POSITION_UNKNOWN, ReadIssue.MODE_UNKNOWN)


def _once(found: Iterable[NotConverted]) -> tuple[NotConverted, ...]:
    """All that is left, each once: a block that runs again as it is where it runs first."""
    first = dict[tuple[int, str], NotConverted]()
    for each in found:
        key = each.line, each.called if each.is_block else each.text
        first[key] = replace(first[key], times=first[key].times + 1) if key in first else each
    return tuple(first.values())


def _is_sound(answer: Answer) -> bool:
    """Whether a contour has no error but that something is not known before it runs."""
    return all(each.about in _NOT_KNOWN for each in answer.diagnostics if each.is_error)


def _statements(modes: Modes, block: Block) -> CodeLine | None:
    """The statements of a block beside words with numbers, as a control reads them; None if it has none."""
    language = modes.language
    return language.read(block.text) if language is not None and language.may_say(block.text) else None


def _names_of(source: Control, target: Control) -> Mapping[str, str]:
    """The addresses of a control that have another name on a relative."""
    own, new = source.modes.lexicon.addresses, target.modes.lexicon.addresses
    by_meaning = {row.meaning: address for address, row in new.items() if address not in own}
    return {a: by_meaning[row.meaning] for a, row in own.items() if a not in new and row.meaning in by_meaning}


def _diameters(plane: Plane, other: Plane) -> tuple[bool, ...]:
    """By axis of a plane, whether another state counts it as a diameter."""
    known = dict(zip(other.axes, other.diameters, strict=False))
    return tuple(bool(known.get(axis, False)) for axis in plane.axes)


def _is_known(state: State, axis: str) -> bool:
    return axis in state.axes and state.axes[axis].value is not None


def _unit(line: ProgramLine) -> Length | None:
    return (
        Length.MM
        if line.meaning.has(ProgramFunction.MM)
        else Length.INCH
        if line.meaning.has(ProgramFunction.INCH)
        else None
    )


def _unit_of_head(lines: Sequence[ProgramLine]) -> Length | None:
    """The unit in the first line of Klartext."""
    for line in lines[:3]:
        match = re.search(r"\bBEGIN\s+PGM\s+\S+\s+(MM|INCH)\b", line.block.text, re.IGNORECASE)
        if match is not None:
            return Length.MM if match[1].upper() == "MM" else Length.INCH
    return None


def _without(meaning: Meaning, function: ProgramFunction) -> Meaning:
    return replace_fields(meaning, functions=[each for each in meaning.functions if each.function is not function])
