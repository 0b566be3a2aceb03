"""Writes the blocks of a program in the words of a control: lines from what a block says, where the target is."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from math import degrees, dist, tau

from msgspec import Struct

from contoursolve.comparison import Travel
from contoursolve.diagnosis import write_word
from contoursolve.gcode import comment_out, parse_block
from contoursolve.geometry import CornerShape, Length, Turn
from contoursolve.postprocess.conversion.block_meaning import Meaning, SaidFunction
from contoursolve.postprocess.conversion.program_words import OFFSETS, TABLE, ControlKind, ProgramFunction, cell_of
from contoursolve.postprocess.emit import Format, emit
from contoursolve.postprocess.expansion_report import NotConverted
from contoursolve.postprocess.post_processors import Arcs, MachineKind, machine_of, post_of
from contoursolve.reading import Code, Control, Diameter, Effect, State, WithoutPoint, advance, apply_modes
from contoursolve.solving import ArcSegment, Point


class CornerWord(Struct, frozen=True):
    """The corner behind a move, as one word has it: its shape, and its size, mm."""

    shape: CornerShape
    size: float


class WrittenMove(Struct, frozen=True):
    """One move: of some axes, to coordinates or by increments, mm; an arc with its radius or about its centre."""

    is_rapid: bool
    ends: Mapping[str, float]
    steps: Mapping[str, float] = {}
    arc: Travel | None = None
    is_by_radius: bool = False
    corner: CornerWord | None = None
    texts: tuple[str, ...] = ()
    """The words of the target, where they are written already."""
    code: int = 1


class NoWordsError(ValueError):
    """A move has no words on the target, for a reason."""


_POINT = WithoutPoint.LEAST_INCREMENTS
_SIDES = {40: "R0", 41: "RL", 42: "RR"}
_BEFORE = (
    ProgramFunction.CLOCKWISE,
    ProgramFunction.COUNTER,
    ProgramFunction.MIST,
    ProgramFunction.COOLANT,
    ProgramFunction.TOOL_CHANGE,
)
_BEHIND = (
    ProgramFunction.SPINDLE_STOP,
    ProgramFunction.NO_COOLANT,
    ProgramFunction.HOLD,
    ProgramFunction.OPTIONAL_STOP,
    ProgramFunction.END,
)
_SPEEDS = {
    ProgramFunction.CUTTING_SPEED: ProgramFunction.CUTTING_SPEED_A_MINUTE,
    ProgramFunction.TURNING_SPEED: ProgramFunction.TURNING_SPEED_A_MINUTE,
}
_BY_TURNS = {minute: turn for turn, minute in _SPEEDS.items()}
_FEEDS = (ProgramFunction.FEED_A_MINUTE, ProgramFunction.FEED_A_TURN)
_CODES = (
    ProgramFunction.MM,
    ProgramFunction.INCH,
    *OFFSETS,
    ProgramFunction.STOP_EXACTLY,
    ProgramFunction.STOPS,
    ProgramFunction.NO_STOPS,
    *_FEEDS,
    *_SPEEDS,
    *_BY_TURNS,
    ProgramFunction.NO_CYCLE,
)
_FULL_TURN = 1e-6
_LONG_ARC = 175.0


@dataclass(slots=True)
class Feeds:
    """The feed mode in force on one side, and the numbers of the feed in each."""

    mode: ProgramFunction

    def take(self, functions: Iterable[ProgramFunction], kind: ControlKind) -> None:
        """Take what a block says of it: SINUMERIK counts revolutions with G96 and G97."""
        for function in functions:
            if function in _FEEDS:
                self.mode = function
            elif kind is ControlKind.SINUMERIK and function in _SPEEDS:
                self.mode = ProgramFunction.FEED_A_TURN
            elif kind is ControlKind.SINUMERIK and function in _BY_TURNS:
                self.mode = ProgramFunction.FEED_A_MINUTE


def first_feed(control: Control) -> ProgramFunction:
    """The feed mode that is in force at first."""
    is_lathe = machine_of(control) is MachineKind.LATHE
    return ProgramFunction.FEED_A_TURN if is_lathe else ProgramFunction.FEED_A_MINUTE


class BlockWriter:
    """Writes one program for a control, block by block; `state` is the target's behind what is written."""

    def __init__(
        self, control: Control, kind: ControlKind, unit: Length, source: ControlKind, first: ProgramFunction
    ) -> None:
        self.control, self.kind, self.modes, self.source = control, kind, control.modes, source
        self.is_klartext, self.is_lathe = kind is ControlKind.KLARTEXT, machine_of(control) is MachineKind.LATHE
        self.has_two_digits = kind is not ControlKind.SINUMERIK
        self.keeps_names = self.is_klartext or kind is source
        """Tells whether tools may have names."""
        self.state = control.initial_state(unit)
        self.post = post_of(control)
        self.here: dict[str, float] = {}
        """The real place of the tool, mm, as far as that is known."""
        self.trailing = ""
        """A comment behind the next line."""
        self.lines: list[str] = []
        self.origins: list[int] = []
        self.shift: Mapping[str, float] = {}
        """The way from where the program's block leads to its coordinates here, mm by axis."""
        self.shifts: dict[int, Mapping[str, float]] = {}
        """The same by line, from 1."""
        self.line = 0
        self.skip = ""
        self.label = self.called = ""
        self.feeds, self.source_feeds = Feeds(first_feed(control)), Feeds(first)
        self.feed: dict[ProgramFunction, Decimal] = {}
        self.is_feed_due = self.has_metric_feed = False
        self.tool = Decimal(0)
        self.tool_name = ""
        """The name of the tool that was called last, if it has no number."""
        self.is_length_due = False
        self.speed: Decimal | None = None
        self.side: int | None = None
        self.written_side: int | None = None
        self.found: list[NotConverted] = []
        self.used: dict[ProgramFunction, int] = {}
        """The functions that are written, each with the line of the program where it comes first."""
        self.notes: list[str] = []

    # What stands in the program

    def begin(self, line: int, *, is_skippable: bool = False, label: str = "", called: str = "") -> None:
        """From here on, lines are written for a line of the program, or of a file `called` there."""
        self.line, self.skip = line, "/" if is_skippable else ""
        self.called = called
        self.label = label if not self.is_klartext else ""

    def put(self, text: str, *, is_comment: bool = False) -> None:
        """A line, of which the target's state is followed."""
        if not text:
            return
        self.shifts[len(self.lines) + 1] = self.shift
        if is_comment:
            self.lines.append(text)
        else:
            label, self.label = self.label, ""
            trailing, self.trailing = self.trailing, ""
            text = f"{text} {trailing}" if trailing else text
            whole = f"{self.skip}{label + ' ' if label else ''}{text}"
            if self.is_klartext:
                whole = f"{self.skip}{' ' if self.skip else ''}{text}"
            self.lines.append(whole)
            block = parse_block(whole if not self.is_klartext else f"1 {whole}", 1, self.modes.syntax)
            self.state = advance(self.state, block, self.modes)
        self.origins.append(self.line)

    def put_blank(self) -> None:
        """An empty line."""
        self.lines.append("")
        self.origins.append(self.line)

    def comment(self, text: str) -> None:
        """A comment of the target."""
        for each in self.comments(text):
            self.put(each, is_comment=True)

    def comments(self, text: str) -> list[str]:
        """The lines of a comment as the target has it."""
        if self.kind.is_fanuc:
            text = "".join(c if c in _FANUC_COMMENT else _INSTEAD.get(c, "-") for c in text.upper())
            text = text.replace("--", "-")
        found = comment_out(text, self.modes.syntax)
        return [f"; {each[1:]}" for each in found] if self.modes.syntax.remark == ";{}" else found

    def move_zero(self, shifts: Mapping[str, float]) -> bool:
        """Shift the coordinate system, so that no `shift` is left: by which way along each axis, mm. Return whether the
        target has words for it."""
        cell = cell_of(ProgramFunction.SHIFT, self.kind)
        if cell is None or not self.shift.keys() <= {*self.modes.axes} or self.state.counts_diameters():
            return False
        self.used.setdefault(ProgramFunction.SHIFT, self.line)
        if self.state.is_incremental:
            self.put(self._selecting(Effect.ABSOLUTE, 0, ""))
        axes = sorted(self.shift)
        if self.kind is ControlKind.SINUMERIK:
            # Whether the shift of an axis stays that TRANS does not name, manuals contradict.
            axes = sorted({*axes, *(axis for axis, at in shifts.items() if at)}) if any(shifts.values()) else []
        words = [
            write_word(axis, shifts.get(axis, 0.0), self.modes.words(self.state), self.state.unit) for axis in axes
        ]
        *heads, template = cell.texts[0].split(" | ")
        for head in heads:
            self.put(head)
        for place, text in enumerate(words if heads else [" ".join(words)], 1):
            self.put(template.replace("{place}", str(place)).replace("{}", text).strip())
        self.here = {axis: at - self.shift.get(axis, 0.0) for axis, at in self.here.items()}
        return True

    def leave(self, text: str, reason: str, *, is_block: bool = False) -> None:
        """Write what has no counterpart, as a comment in its place."""
        self.found.append(NotConverted(self.line, text, reason, is_block, called=self.called))
        bare = text.strip()
        said = f"NOT CONVERTED: {bare}"
        self.comment(said.replace(":", " -", 1) if self.kind.is_fanuc else said)

    # What a block says

    def write(
        self,
        meaning: Meaning,
        moves: Sequence[WrittenMove],
        speed: Decimal | None,
        codes: Sequence[str] = (),
        *,
        is_incremental: bool = False,
    ) -> None:
        """The lines of a block: what it says, and its moves, which may be by increments. `speed` is that of a tool
        call, `codes` open the program. Raises NoWordsError."""
        if self.is_klartext:
            self._klartext(meaning, moves, speed)
        else:
            self._iso(meaning, moves, codes, is_incremental=is_incremental)

    def word(self, function: ProgramFunction, number: Decimal = Decimal(0), width: int = 1) -> str:
        """The word of a function; empty if it goes without. Raises NoWordsError."""
        cell = cell_of(function, self.kind)
        if cell is None:
            raise NoWordsError(f"{self.control.title} has no word for: {function.value}")
        if not cell.texts:
            return ""
        self.used.setdefault(function, self.line)
        text = cell.texts[0]
        if not self.has_two_digits and re.fullmatch(r"[GM]0\d", text):
            text = text[0] + text[1:].lstrip("0")
        number_text = f"{number.normalize():f}"
        is_whole = number == number.to_integral_value()
        padded = f"{int(number):0{width}d}" if is_whole else number_text
        return text.replace("{ms}", f"{(number * 1000).normalize():f}").replace("{}", padded)

    def feed_word(self, number: Decimal) -> str:
        """A feed, with a point where the control needs one."""
        text = f"{number.normalize():f}"
        return f"F{text}" + "." * (self.kind.is_fanuc and "." not in text)

    def code(self, number: int) -> str:
        """A code of the target."""
        row = self.modes.codes.get(number)
        text = row.text if row is not None else f"G{number:02}"
        return text if self.has_two_digits or text[:1] != "G" else "G" + (text[1:].lstrip("0") or "0")

    def _converted_feed(self, number: Decimal) -> Decimal:
        """A feed in the units of the target: the ISG kernel counts mm in any program, Klartext tenths of an inch. The
        program counts mm, too, with G70 of SINUMERIK."""
        if self.state.unit is not Length.INCH:
            return number
        mm, inch = number * Length.INCH.in_mm, number
        if self.has_metric_feed:
            mm, inch = number, round(number / Length.INCH.in_mm, 5)
        if self.kind is ControlKind.ISG:
            return mm
        return inch * 10 if self.is_klartext else inch

    def _settle(self, meaning: Meaning) -> list[SaidFunction]:
        """The functions of a block as the target needs them: its feed mode, and the feed again where that is due."""
        functions = list(meaning.functions)
        self.source_feeds.take((each.function for each in functions), self.source)
        if meaning.has(ProgramFunction.MM, ProgramFunction.INCH):
            self.has_metric_feed = meaning.is_metric_feed
        functions = [self._with_point(each) for each in functions]
        is_minute = self.source_feeds.mode is ProgramFunction.FEED_A_MINUTE
        if self.kind is ControlKind.SINUMERIK and is_minute:
            functions = [each._replace(function=_SPEEDS.get(each.function, each.function)) for each in functions]
        if self.kind is not ControlKind.SINUMERIK:
            functions = [each._replace(function=_BY_TURNS.get(each.function, each.function)) for each in functions]
        for each in [
            each for each in functions if each.function in TABLE and cell_of(each.function, self.kind) is None
        ]:
            self.leave(each.text, f"{self.control.title} has no word for: {each.function.value}")
            functions.remove(each)
        functions = self._with_known_tool(meaning, functions)
        before = self.feeds.mode
        self.feeds.take((each.function for each in functions), self.kind)
        if self.feeds.mode is not self.source_feeds.mode and not self.is_klartext:
            functions.insert(0, SaidFunction(self.source_feeds.mode))
            self.feeds.mode = self.source_feeds.mode
        has_feed = False
        for each in functions:
            if each.function is ProgramFunction.FEED:
                self.feed[self.source_feeds.mode], has_feed = each.number, True
        is_changed = self.kind is ControlKind.SINUMERIK and before is not self.feeds.mode
        self.is_feed_due = (self.is_feed_due or is_changed) and not has_feed
        return functions

    def _with_point(self, said: SaidFunction) -> SaidFunction:
        """A feed a revolution without a point counts 0.01 mm or 0.0001 inch (Siemens ISO milling 04.07, p. 1-13)."""
        is_feed = said.function is ProgramFunction.FEED and self.source_feeds.mode is ProgramFunction.FEED_A_TURN
        if said.has_point or not is_feed:
            return said
        number = said.number * (_STEP_INCH if self.state.unit is Length.INCH else _STEP_MM)
        if not any(said.text in each for each in self.notes):
            self.notes.append(
                f"{said.text} has no point: read as {number.normalize():f} {self.state.unit.value} a turn"
            )
        return said._replace(number=number, has_point=True)

    def _with_known_tool(self, meaning: Meaning, functions: list[SaidFunction]) -> list[SaidFunction]:
        """The functions without those of a tool that has a name, where the target calls tools by number."""
        if any(each.function is ProgramFunction.TOOL for each in functions):
            self.tool_name = ""
        self.tool_name = meaning.tool_name or self.tool_name
        if not self.tool_name or self.keeps_names:
            return functions
        own = [each for each in functions if each.function in _OF_TOOLS]
        text = " ".join([*filter(None, [meaning.tool_name]), *(each.text for each in own if each.text)])
        if text:
            self.leave(text, f"the tool has a name, and {self.control.title} calls tools by number")
        return [each for each in functions if each not in own]

    def _iso(
        self, meaning: Meaning, moves: Sequence[WrittenMove], opening: Sequence[str], *, is_incremental: bool
    ) -> None:
        functions = self._settle(meaning)
        selecting, has_counts = list(meaning.codes), any(row.effect is Effect.INCREMENTAL for row in self._rows)
        if moves and has_counts:
            # What is in force is said where the moves need it, and not where the program says it.
            selecting = [each for each in selecting if each[0].effect not in _COUNTS]
            wanted = self._selecting(Effect.INCREMENTAL if is_incremental else Effect.ABSOLUTE, 0, "")
            is_new = is_incremental is not self.state.is_incremental
            if (is_new or len(selecting) < len(meaning.codes)) and wanted not in opening:
                opening = [*(each for each in opening if each != self._selecting(Effect.ABSOLUTE, 0, "")), wanted]
        parts = self._parts(meaning, selecting, functions, moves, opening)
        has_more = bool(moves or parts.words or parts.tools)
        if self.kind is ControlKind.FANUC_LATHE and has_more and (unit := _unit_in(parts.codes)):
            parts.codes.remove(unit)
            self.put(unit)
        for text in parts.alone:
            self.put(text)
        if self.kind is ControlKind.SINUMERIK and "M6" in parts.tools:
            # It has a block of its own, behind that of its T.
            parts.tools.remove("M6")
            self.put(" ".join([*parts.codes, *parts.tools]))
            self.put("M6")
            parts.codes, parts.tools = [], []
        texts = self._moves(moves, parts.codes, is_stated=meaning.motion is not None) if moves else []
        own, before, behind = self._spread(parts, has_moves=bool(texts))
        for text in before:
            self.put(text)
        if not texts:
            self.put(" ".join([*parts.codes, *parts.words, *own]))
        for place, written in enumerate(texts):
            codes, words = (parts.codes, parts.words) if not place else ([], [])
            self.put(" ".join([*codes, *written.words, *words, *(own if place == len(texts) - 1 else [])]))
        for text in behind:
            self.put(text)

    @property
    def _rows(self) -> Iterable[Code]:
        return self.modes.codes.values()

    def _parts(
        self,
        meaning: Meaning,
        selecting: Sequence[tuple[Code, int]],
        functions: Sequence[SaidFunction],
        moves: Sequence[WrittenMove],
        opening: Sequence[str],
    ) -> "_Parts":
        """The words of a block, sorted by where they stand."""
        parts = _Parts(codes=[*opening])
        placed = [(each.place, self.word(each.function)) for each in functions if each.function in _CODES]
        for code, place in selecting:
            text = self._selecting(code.effect, code.number, code.plane.code if code.plane else "")
            if text and code.effect is Effect.COMPENSATION and code.number != _NO_SIDE and self.needs_d:
                own = meaning.radius.number if meaning.radius is not None else None
                text += f" D{int(self.tool if own is None else own):02}"
            placed.append((place, text))
        placed.sort(key=lambda each: each[0])
        parts.codes += [text for _, text in placed if text and text not in parts.codes]
        parts.codes.sort(key=lambda each: each in _LAST)
        for function, number, *_ in functions:
            if function is ProgramFunction.FEED:
                parts.words.append(self.feed_word(self._converted_feed(number)))
            elif function is ProgramFunction.SPEED:
                parts.words.append(f"S{number.normalize():f}")
            elif function in (ProgramFunction.MOST_TURNS, ProgramFunction.DWELL):
                parts.alone.append(self.word(function, number))
            elif function is ProgramFunction.END:
                parts.end.append(self.word(function))
            elif function in (*_BEFORE, *_BEHIND) and function is not ProgramFunction.TOOL_CHANGE:
                (parts.before if function in _BEFORE else parts.behind).append(self.word(function, number))
        if self.is_feed_due and moves and not moves[0].is_rapid and self.feeds.mode in self.feed:
            parts.words.append(self.feed_word(self._converted_feed(self.feed[self.feeds.mode])))
            self.is_feed_due = False
        if meaning.tool_name and self.keeps_names:
            parts.tools.append(meaning.tool_name)
        parts.tools += self._tools({each.function: each.number for each in functions}, moves, parts.codes)
        return parts

    def _spread(self, parts: "_Parts", *, has_moves: bool) -> tuple[list[str], list[str], list[str]]:
        """The words behind the path of a block, and the blocks before and behind it: Fanuc has one M word a block, and
        the end of a program has a block of its own."""
        if not self.kind.is_fanuc:
            return [*parts.tools, *parts.before, *parts.behind], [], parts.end
        has_change = any(each.startswith("M") for each in parts.tools)
        words = [*parts.before, *parts.behind]
        own, rest = ([], words) if has_change else (words[:1], words[1:])
        before = [each for each in rest if each in parts.before] if has_moves and not has_change else []
        behind = [each for each in rest if each not in before]
        return [*parts.tools, *own], before, [*behind, *parts.end]

    @property
    def needs_d(self) -> bool:
        """Whether compensation names the radius of a tool: on a mill of Fanuc."""
        return self.kind.is_fanuc and not self.is_lathe

    def _selecting(self, effect: Effect, number: int, plane: str) -> str:
        """A code of the target that selects a plane, increments or a side; empty where none does."""
        for row in self.modes.codes.values():
            if row.effect is not effect or row.diameter is not None:
                continue
            if (effect is Effect.PLANE and row.plane and row.plane.code == plane) or (
                effect is Effect.COMPENSATION and row.number == number
            ):
                return self.code(row.number)
            if effect in (Effect.ABSOLUTE, Effect.INCREMENTAL):
                return self.code(row.number)
        return ""

    def _tools(
        self, values: Mapping[ProgramFunction, Decimal], moves: Sequence[WrittenMove], codes: list[str]
    ) -> list[str]:
        """The words of a tool, its change and its offset."""
        found = list[str]()
        tool = values.get(ProgramFunction.TOOL)
        self.tool = self.tool if tool is None else tool
        if self.is_lathe and self.kind.is_fanuc:
            if ProgramFunction.LENGTH in values or (tool is not None and ProgramFunction.NO_LENGTH not in values):
                return [f"T{int(self.tool):02}{int(self.tool):02}"]
            return [f"T{int(self.tool):02}00"] if ProgramFunction.NO_LENGTH in values and self.tool else []
        if tool is not None:
            found.append(self.word(ProgramFunction.TOOL, tool))
        if ProgramFunction.TOOL_CHANGE in values and not self.is_lathe:
            found.append(self.word(ProgramFunction.TOOL_CHANGE))
        length = values.get(ProgramFunction.LENGTH)
        if self.kind.is_fanuc:
            if ProgramFunction.NO_LENGTH in values:
                codes.append(self.word(ProgramFunction.NO_LENGTH))
                self.is_length_due = False
            self.is_length_due |= length is not None
            if self.is_length_due and any("Z" in (*move.ends, *move.steps) for move in moves[:1]):
                codes.append(self.word(ProgramFunction.LENGTH, self.tool, 2))
                self.is_length_due = False
        elif length is not None:
            edge = Decimal(1) if self.kind is ControlKind.SINUMERIK else self.tool
            (found if tool is not None and self.is_lathe else codes).append(self.word(ProgramFunction.LENGTH, edge))
        elif ProgramFunction.NO_LENGTH in values and self.tool:
            codes.append(self.word(ProgramFunction.NO_LENGTH))
        return found

    # Moves in G codes

    def _moves(self, moves: Sequence[WrittenMove], codes: Sequence[str], *, is_stated: bool) -> list["_Written"]:
        """The words of moves, in the state that the codes before them leave; the first one says its motion if the
        program does."""
        state = self.state
        if codes:
            state = apply_modes(state, parse_block(" ".join(codes), 1, self.modes.syntax), self.modes)
        written = list[_Written]()
        motion = state.motion
        here = dict(self.here)
        for move in moves:
            for code, words in self._words(move, state, here):
                bare = self._bare(code, words, here, state, move)
                is_modal = motion == code and self.control.has_modal_motions and not (is_stated and not written)
                text = [] if is_modal else [self.code(code)]
                motion = code
                spelled = (f"{word}." if self.kind.is_fanuc and _BARE.fullmatch(word) else word for word in bare)
                written.append(_Written((*text, *spelled)))
            here |= {axis: self._rounded(axis, at, state) for axis, at in move.ends.items()}
        self.here = here
        return written

    def _rounded(self, axis: str, value: float, state: State) -> float:
        """A coordinate as it is written, mm."""
        numbers, row = self.modes.lexicon.numbers, self.modes.words(state).addresses[axis]
        step = float(numbers.step(row.unit, state.unit)) * float(state.unit.in_mm) / (2 if row.is_diameter else 1)
        return round(value / step) * step

    def _bare(
        self, code: int, words: Sequence[str], here: Mapping[str, float], state: State, move: WrittenMove
    ) -> Sequence[str]:
        """Words without the coordinates at which the tool is already, in a line of a contour."""
        if code > 1 or not move.texts or state.is_incremental or any("A" in word.upper()[:4] for word in words):
            return words
        unchanged = [
            word
            for axis, at in here.items()
            for word in words
            if word == write_word(axis, at, self.modes.words(state), state.unit)
        ]
        coordinates = [word for word in words if word[:1] in self.modes.axes]
        return words if len(unchanged) >= len(coordinates) else [word for word in words if word not in unchanged]

    def _words(self, move: WrittenMove, state: State, here: Mapping[str, float]) -> Iterator[tuple[int, Sequence[str]]]:
        lexicon, unit = self.modes.words(state), state.unit
        if move.texts:
            yield move.code, move.texts
            return
        if move.arc is not None:
            yield from self._arc(move, state, here)
            return
        words = list[str]()
        steps = {row.axis: row.address for row in lexicon.addresses.values() if row.is_increment and row.axis}
        for axis in sorted({**move.ends, **move.steps}):
            if axis in move.steps:
                if state.is_incremental:
                    words.append(write_word(axis, move.steps[axis], lexicon, unit))
                elif axis in steps:
                    words.append(write_word(self._step(axis, steps), move.steps[axis], lexicon, unit))
                elif axis in move.ends:
                    words.append(write_word(axis, move.ends[axis], lexicon, unit))
                else:
                    raise NoWordsError(f"where {axis} is before it is not known, and the target has no increments")
            elif state.is_incremental:
                raise NoWordsError(f"increments are in force, and {axis} is a coordinate")
            else:
                words.append(write_word(axis, move.ends[axis], lexicon, unit))
        yield 0 if move.is_rapid else 1, words

    def _step(self, axis: str, steps: Mapping[str, str]) -> str:
        return f"{axis}=IC" if self.kind is ControlKind.SINUMERIK else steps[axis]

    def form(self, state: State, arcs: Arcs) -> Format:
        """The format of words in a state of the target."""
        numbers = self.modes.lexicon.numbers
        return Format(
            state.plane,
            state.unit,
            self.post.digits(state.unit, numbers),
            self.post.writes_point(numbers),
            arcs,
            state.is_incremental,
            radius=self.modes.radius,
            words=self.modes.lexicon.spelling,
        )

    def _arc(self, move: WrittenMove, state: State, here: Mapping[str, float]) -> Iterator[tuple[int, Sequence[str]]]:
        arc = _segment(move.arc, state)
        travel = move.arc
        if arc is None or travel is None or travel.bend is None or travel.plane is None:
            raise NoWordsError("where the arc begins is not known")
        axes = state.plane.axes
        if {*axes} != {*travel.plane.axes}:
            raise NoWordsError("the plane of the arc is not that of the target")
        form = self.form(state, Arcs.RADIUS if move.is_by_radius and arc.sweep < _LONG_ARC else Arcs.CENTER)
        at = (here.get(axes[0], arc.start[0]), here.get(axes[1], arc.start[1]))
        beside = {
            axis: (here.get(axis, move.ends[axis] if move.steps.get(axis) is None else 0.0), move.ends[axis])
            for axis in sorted(move.ends)
            if axis not in axes
        }
        if dist(arc.start, arc.end) <= _FULL_TURN and not state.is_incremental:
            code, mm = 2 if travel.bend.sweep * self._hand(travel, state) < 0 else 3, float(state.unit.in_mm)
            words = [
                write_word(axis, end, self.modes.words(state), state.unit)
                for axis, end in zip(axes, arc.end, strict=True)
            ]
            words += [axis + form.number(high / mm) for axis, (_, high) in beside.items()]
            words.sort()
            words += sorted(
                name + form.number((center - start) / mm)
                for name, center, start in zip(state.plane.centers, arc.center, at, strict=True)
            )
            yield code, words
            return
        for block in emit(arc, at, form, beside=beside):
            if block.words:
                yield block.code, block.words

    def _hand(self, travel: Travel, state: State) -> int:
        return 1 if travel.plane is not None and travel.plane.axes == state.plane.axes else -1

    # Klartext

    def _klartext(self, meaning: Meaning, moves: Sequence[WrittenMove], speed: Decimal | None) -> None:
        functions = self._settle(meaning)
        values = {each.function: each.number for each in functions}
        for code, _ in meaning.codes:
            if code.effect is Effect.PLANE and code.plane and code.plane.code != _KLARTEXT_PLANE:
                raise NoWordsError("only the plane of X and Y is written in Klartext")
            self.side = code.number if code.effect is Effect.COMPENSATION else self.side
        if ProgramFunction.FEED_A_TURN in values:
            raise NoWordsError("the feed a revolution is not written in Klartext")
        self._call_tool(values, speed)
        if ProgramFunction.DWELL in values:
            for text in self.word(ProgramFunction.DWELL, values[ProgramFunction.DWELL]).split(" | "):
                self.put(text)
        self.is_feed_due |= ProgramFunction.FEED in values
        before, behind = (
            [f"M{int(self.word(each.function)[1:])}" for each in functions if each.function in group]
            for group in (_M_BEFORE, _BEHIND)
        )
        texts = [text for move in moves for text in self._klartext_move(move)]
        places = [place for place, each in enumerate(texts) if each.is_move]
        for place, each in enumerate(texts):
            beside = self._beside_klartext(each) if each.is_move else []
            first = before if places and place == places[0] else []
            last = behind if places and place == places[-1] else []
            self.put(" ".join([*each.words, *beside, *first, *last]))
        for text in () if places else (*before, *behind):
            self.put(text)

    def _call_tool(self, values: Mapping[ProgramFunction, Decimal], speed: Decimal | None) -> None:
        """The block of a tool, with the speed that comes next; another speed later has one, too."""
        tool = values.get(ProgramFunction.TOOL)
        self.tool = self.tool if tool is None else tool
        if ProgramFunction.TOOL_CHANGE in values:
            self.used.setdefault(ProgramFunction.TOOL, self.line)
            self.speed = speed if speed is not None else self.speed
            spoken = f" S{self.speed.normalize():f}" if self.speed is not None else ""
            named = self.tool_name.partition("=")[2]
            self.put(f"TOOL CALL {named or int(self.tool)} Z{spoken}")
            self.written_side = None
        elif tool is not None:
            self.put(f"TOOL DEF {int(tool)}")
        own = values.get(ProgramFunction.SPEED)
        if own is not None and own != self.speed:
            self.put(f"TOOL CALL S{own.normalize():f}")
            self.speed = own

    def _beside_klartext(self, written: "_Written") -> list[str]:
        """The words of a move beside its coordinates: the side of the tool, and its feed."""
        found, side = list[str](), self.side if self.side is not None else _NO_SIDE
        if side != self.written_side:
            if written.words[0] != "L":
                raise NoWordsError("the side of the tool changes in an arc")
            found.append(_SIDES[side])
            self.written_side = side
        if written.is_rapid:
            found.append("FMAX")
        elif self.is_feed_due and self.feeds_now is not None:
            found.append(f"F{self._converted_feed(self.feeds_now).normalize():f}")
            self.is_feed_due = False
        return found

    @property
    def feeds_now(self) -> Decimal | None:
        """The number of the feed in force."""
        return self.feed.get(self.source_feeds.mode)

    def _klartext_move(self, move: WrittenMove) -> Iterator["_Written"]:
        lexicon, unit = self.modes.lexicon, self.state.unit

        def word(address: str, value: float) -> str:
            text = write_word(address, value, lexicon, unit)
            number = text[len(address) :]
            return text if number[:1] in "+-" else f"{address}+{number}"

        if move.arc is None:
            words = [
                word(f"I{axis}", move.steps[axis]) if axis in move.steps else word(axis, move.ends[axis])
                for axis in sorted({**move.ends, **move.steps})
            ]
            yield _Written(("L", *words), is_rapid=move.is_rapid, is_move=True)
        else:
            yield from self._klartext_arc(move, word)
        if move.corner is not None:
            name = "RND R" if move.corner.shape is CornerShape.FILLET else "CHF "
            number = write_word("R", move.corner.size, lexicon, unit)[1:].lstrip("+")
            yield _Written((f"{name}{number}",))

    def _klartext_arc(self, move: WrittenMove, word: Callable[[str, float], str]) -> Iterator["_Written"]:
        travel = move.arc
        arc = _segment(travel, self.state)
        if arc is None or travel is None or travel.bend is None:
            raise NoWordsError("where the arc begins is not known")
        if travel.plane is None or {*travel.plane.axes} != {"X", "Y"}:
            raise NoWordsError("an arc outside the plane of X and Y is not written in Klartext")
        sense = "DR+" if arc.turn is Turn.CCW else "DR-"
        ends = word("X", arc.end[0]), word("Y", arc.end[1])
        rise = {axis: end for axis, end in move.ends.items() if axis == "Z"}
        is_full = dist(arc.start, arc.end) <= _FULL_TURN
        if rise and travel.start[self._z(travel)] != travel.end[self._z(travel)]:
            yield _Written(("CC", word("X", arc.center[0]), word("Y", arc.center[1])))
            sweep = degrees(travel.bend.sweep)
            yield _Written(("CP", word("IPA", sweep), word("Z", rise["Z"]), sense), is_move=True)
            return
        if move.is_by_radius and not is_full:
            radius = arc.radius if arc.sweep <= _LONG_ARC else -arc.radius
            yield _Written(("CR", *ends, word("R", radius), sense), is_move=True)
            return
        yield _Written(("CC", word("X", arc.center[0]), word("Y", arc.center[1])))
        yield _Written(("C", *ends, sense), is_move=True)

    def _z(self, travel: Travel) -> int:
        return next(n for n in range(len(travel.start)) if travel.bend is None or n not in travel.bend.axes)


@dataclass(slots=True)
class _Parts:
    """The words of a block: blocks before it, codes, feed and speed, the tool, and M words by when they act."""

    alone: list[str] = field(default_factory=list)
    codes: list[str] = field(default_factory=list)
    words: list[str] = field(default_factory=list)
    tools: list[str] = field(default_factory=list)
    before: list[str] = field(default_factory=list)
    behind: list[str] = field(default_factory=list)
    end: list[str] = field(default_factory=list)


def _unit_in(codes: Sequence[str]) -> str:
    return next((each for each in codes if each in ("G20", "G21")), "")


class _Written(Struct, frozen=True):
    """The words of one move."""

    words: tuple[str, ...]
    is_rapid: bool = False
    is_move: bool = False


_NO_SIDE = 40
_STEP_MM, _STEP_INCH = Decimal("0.01"), Decimal("0.0001")
_COUNTS = (Effect.ABSOLUTE, Effect.INCREMENTAL)
_LAST = ("DIAMON", "G51")
_BARE = re.compile(r",?[XYZUVWABCIJKR]=?-?\d+")
_FANUC_COMMENT = frozenset("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789 .,=_-+/#*[]()")
"""Characters of a comment. A control with macros has those of expressions, too."""
_INSTEAD = {'"': "", ":": " -", "<": " LT ", ">": " GT ", "Ä": "AE", "Ö": "OE", "Ü": "UE", "ß": "SS", "'": ""}
_OF_TOOLS = (ProgramFunction.TOOL, ProgramFunction.TOOL_CHANGE, ProgramFunction.LENGTH, ProgramFunction.NO_LENGTH)
_M_BEFORE = tuple(each for each in _BEFORE if each is not ProgramFunction.TOOL_CHANGE)
_KLARTEXT_PLANE = "G17"


def _segment(travel: Travel | None, state: State) -> ArcSegment | None:
    """An arc in the plane of the target's state; None if its begin is not known."""
    if travel is None or travel.bend is None or travel.plane is None:
        return None
    one, other = travel.bend.axes
    start, end = ((at[one], at[other]) for at in (travel.start, travel.end))
    if None in (*start, *end):
        return None
    center, turn = travel.bend.center, Turn.CCW if travel.bend.sweep > 0 else Turn.CW
    points: list[Point] = [(float(at[0] or 0), float(at[1] or 0)) for at in (start, end, center)]
    if travel.plane.axes != state.plane.axes:
        points = [(at[1], at[0]) for at in points]
        turn = Turn.CW if turn is Turn.CCW else Turn.CCW
    sweep = abs(travel.bend.sweep)
    if sweep >= tau - _FULL_TURN:
        points[1] = points[0]
    return ArcSegment(travel.element, points[0], points[1], points[2], max(travel.bend.radii), turn)


def diameter_code(control: Control) -> str:
    """The code with which X is a diameter; empty where none says so."""
    return next((each.text for each in control.modes.codes.values() if each.diameter is Diameter.ON), "")
