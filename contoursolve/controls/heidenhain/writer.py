"""Writes Klartext: contours as lines and arcs, and whole programs in G codes."""

import re
from collections.abc import Iterator, Sequence
from math import atan2, degrees, dist

from msgspec.structs import replace

from contoursolve.controls.heidenhain.follow import CENTER, PLANE, begins_chain, follow, pole_of, pole_words
from contoursolve.controls.heidenhain.lexicon import BLOCK_NUMBER, CODES, LEXICON, MOVES, SYNTAX, function_of
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Length, Turn
from contoursolve.reading import Around, Carried, Modes, Restated, State, Writing, axis_words, carried
from contoursolve.solving import Point, center_by_radius
from contoursolve.tolerance import LENGTH, RADIUS_DIFFERENCE

_MODES = Modes(LEXICON, CODES, ("X", "Y", "Z"), frozenset(), syntax=SYNTAX)
_CORNERS = ("RND", "CHF")
_ARCS = ("C", "CR", "CP")
_UNTRANSLATED = "has no counterpart here: write by hand what it does"
_FULL = 360.0


_TOOL_FEED = re.compile(r"[ \t/]*+N?\d*+[ \t]*+TOOL[ \t]+CALL\b[^;]*[ \t]F[ \t]*[\dQ]", re.IGNORECASE)


class _Feed:
    """The feed in force: that of a corner holds for the corner alone."""

    def __init__(self) -> None:
        self.in_force, self.is_due = "", False

    def take(self, block: Block) -> str:
        """Keep in mind what a block says of it; the word that has to be said again in the block, if any."""
        found = block.find("F")
        is_stated = found is not None and (found.number is not None or found.text.strip().upper().endswith("AUTO"))
        stated = found.text.strip() if found is not None and is_stated else ""
        if _TOOL_FEED.match(block.text):
            # FAUTO is the feed of TOOL CALL.
            self.in_force, self.is_due = "FAUTO", False
        if function_of(block) in _CORNERS:
            self.is_due = bool(stated and self.in_force)
        elif stated:
            self.in_force, self.is_due = stated, False
        elif self.is_due and found is None and _is_moving(block):
            return self.in_force if block.is_skippable else self.resume()
        return ""

    def leave(self, block: Block) -> None:
        """A block is not written: what it says of the feed is due."""
        self.take(block)
        self.is_due |= block.find("F") is not None and bool(self.in_force)

    def resume(self) -> str:
        """The word that puts the feed before a corner in force again, if that is due."""
        found, self.is_due = self.in_force if self.is_due else "", False
        return found


class _Own:
    """Klartext: L for a line; CC and C, or CR, for an arc."""

    def __init__(self) -> None:
        self.feed = _Feed()
        self.has_moved_center = False

    def keep(self, block: Block) -> None:
        """A block stays as it is."""
        self.feed.take(block)

    def write(self, block: Block, moves: Sequence[tuple[int, tuple[str, ...]]]) -> list[list[str]]:
        """The lines in the place of a block; what it says besides stands in those that move."""
        rest, feed = carried(block, _MODES), self.feed.take(block)
        once = [text for text in (*(code for code in rest.codes if code.upper() != CENTER), feed) if text]
        first = [*once, *(text for text in rest.words if not _is_rapid_word(text))]
        each = [text for text in rest.words if _is_rapid_word(text)]
        lines = [
            line
            for code, words in moves or ([(1, ())] if first or rest.last else [])
            for line in self._move(code, words)
        ]
        moving = [line for line in lines if line[0] != CENTER]
        for line in moving:
            line += [*(first if line is moving[0] else []), *each, *(rest.last if line is moving[-1] else [])]
        return lines

    def _move(self, code: int, words: Sequence[str]) -> Iterator[list[str]]:
        parts = [_PARTS.fullmatch(word) for word in words]
        numbers = {part["address"]: _signed(part["number"]) for part in parts if part}
        ends = [axis + numbers[axis] for axis in ("X", "Y", "IX", "IY", "Z", "IZ") if axis in numbers]
        sense = {2: "DR-", 3: "DR+"}.get(code)
        if sense is None:
            yield ["L", *ends]
        elif "R" in numbers:
            yield ["CR", *ends, "R" + numbers["R"], sense]
        else:
            self.has_moved_center = True
            yield [CENTER, "X" + numbers["I"], "Y" + numbers["J"]]
            yield ["C", *ends, sense]

    def close(self, after: State) -> list[list[str]]:
        """The pole in force before the arcs, and the feed before a corner."""
        words = pole_words(after, CENTER)
        stated = [
            f"{word.address}{_signed(f'{word.number.normalize():f}')}"
            for word in words
            if word and word.number is not None
        ]
        lines = [[CENTER, *stated]] if self.has_moved_center and stated else []
        self.has_moved_center = False
        feed = self.feed.resume()
        return [*lines, *([["L", feed]] if feed else [])]


def _is_moving(block: Block) -> bool:
    return function_of(block) in MOVES or bool(axis_words(block, _MODES))


_PARTS = re.compile(r"(?P<address>[A-Z]+)(?P<number>.*)")


def _signed(number: str) -> str:
    return number if number.startswith("-") else f"+{number}"


def _is_rapid_word(text: str) -> bool:
    return text.upper().startswith("F") and text.upper().endswith("MAX")


_M = {number: (f"M{number}",) for number in (0, 1, 2, 3, 4, 5, 6, 8, 9, 30)} | {13: ("M3", "M8"), 14: ("M4", "M8")}
"""M functions in the words of the others."""
_AS_WRITTEN = frozenset({"S", "A", "B", "C", "U", "V", "W"})
_OTHER_PLACE_M = frozenset({89, 91, 92, 99, 128, 144})
"""M functions with which a block leads somewhere else than its coordinates say, or runs more."""
_PROGRAM_ENDS = (2, 30)

_STATEMENTS = tuple(
    (name, re.compile(rf"{BLOCK_NUMBER}(?:{pattern})", re.IGNORECASE))
    for name, pattern in (
        ("begin", r"BEGIN[ \t]+PGM\b"),
        ("end", r"END[ \t]+PGM\b"),
        ("comment", r"BLK[ \t]+FORM\b|TOOL[ \t]+DEF\b|[*(]"),
        ("tool", r"TOOL[ \t]+CALL\b(?P<words>[^;]*)"),
        ("assignment", r"(?:FN[ \t]*0[ \t]*:[ \t]*)?(?P<name>Q[LRS]?\d++)[ \t]*="),
        ("other", r"(?P<what>[^\s;]+(?:[ \t]+[A-Z]+)?)"),
    )
)
_TOOL_WORDS = re.compile(
    r"[ \t]*+(?P<tool>\d++)?(?:[ \t]+(?P<axis>[XYZUVW])(?!\w))?(?:[ \t]+S[ \t]*(?P<speed>\d+(?:[.,]\d+)?))?"
    r"(?:[ \t]+F[ \t]*(?P<feed>\d+(?:[.,]\d+)?))?[ \t]*",
    re.IGNORECASE,
)


class _Plain:
    """G codes, block by block."""

    def __init__(self) -> None:
        self.feed = _Feed()
        self.side, self.wanted, self.tool = "G40", "G40", ""
        """The side of the tool as it is written, and as the program has it: a block between may not be written."""
        self.is_length_due = self.has_ended = False

    def restate(self, block: Block, before: State, after: State) -> Restated:
        """A block that belongs to no contour."""
        said = self._statement(block, after) if block.macro is not None else self._move(block, before)
        if said.reason and not said.ends:
            self.feed.leave(block)
            self._take_side(block)
        return said

    def _move(self, block: Block, before: State) -> Restated:
        if block.faults:
            return Restated(reason=f"{block.faults[0].text.strip()} cannot be read")
        function = function_of(block)
        wrong = _wrong_place(block)
        if wrong:
            return Restated(reason=wrong)
        if function in (CENTER, "FPOL"):
            return Restated(reason=_not_known(block))
        if function and function not in MOVES and function != "STOP":
            return Restated(reason=f"{function} {_UNTRANSLATED}")
        # Behind the end of a program, nothing is known.
        path = replace(block, words=tuple(word for word in block.words if word.address != "M"))
        after = follow(before, path, _MODES)
        axes = {LEXICON.addresses[word.address].axis for word in axis_words(block, _MODES)}
        if function in _ARCS or (function in MOVES and any(block.find(name) for name in ("PR", "PA", "IPR", "IPA"))):
            axes |= {*PLANE}
        around = None
        if function in _ARCS:
            found = _arc(block, function, before, after)
            if isinstance(found, str):
                return Restated(reason=found)
            around = found
        elif function not in ("L", "LP", "", "STOP") and not begins_chain(function, block):
            return Restated(reason=f"{function} begins in the direction of what is before it, which is not known")
        ends = {axis: after.axes[axis] for axis in sorted(axes)}
        lost = [end.reason for end in ends.values() if end.value is None]
        if lost:
            return Restated(reason=lost[0])
        said = self.beside(block, before, is_length="Z" in axes)
        return replace(said, ends={axis: float(end.value or 0) for axis, end in ends.items()}, around=around)

    def beside(self, block: Block, before: State, *, is_length: bool = False) -> Restated:
        """The words of a block that are no path: compensation, feed, spindle, other axes, M functions."""
        due = self.feed.take(block)
        self._take_side(block)
        codes, words, last, reasons = self._turn(), list[str](), list[str](), list[str]()
        for word in block.words:
            text, number = word.text.strip().upper(), word.number
            if word.address == "F" and number is not None and text[1:2] not in ("U", "Z"):
                words.append(_feed(text, before.unit))
            elif word.address in _AS_WRITTEN and number is not None:
                words.append(f"{word.address}{number:f}")
            elif word.address == "M" and number in _M:
                self.has_ended |= number in _PROGRAM_ENDS
                (last if number in _AT_ITS_END else words).extend(_M[int(number or 0)])
            elif not (word.address in LEXICON.addresses or word.address in ("N", "G") or _is_rapid_word(text)):
                reasons.append(f"{text} {_UNTRANSLATED}")
        if function_of(block) == "STOP":
            last.insert(0, "M0")
        if due:
            words.append(_feed(due, before.unit))
        if is_length and self.is_length_due:
            codes.append(f"G43 H{self.tool}")
            self.is_length_due = False
        says = _says(block.find("N"), codes, words, last)
        return Restated(says, is_rapid=self.is_rapid(block), reason="; ".join(reasons))

    def is_rapid(self, block: Block) -> bool:
        """Whether it has FMAX."""
        feed = block.find("F")
        return feed is not None and feed.number is None and _is_rapid_word(feed.text.strip())

    def _take_side(self, block: Block) -> None:
        """Keep in mind on which side of the contour the tool goes; a departure ends that."""
        for word in block.words:
            if word.address == "G":
                self.wanted = _SIDES.get(word.text.strip().upper()[:3].strip(), self.wanted)

    def _turn(self) -> list[str]:
        """The code for the side of the tool, where that is another one."""
        if self.wanted == self.side:
            return []
        self.side = self.wanted
        return [f"{self.side} D{self.tool}" if self.tool and self.side != "G40" else self.side]

    def _statement(self, block: Block, after: State) -> Restated:
        name, found = next((name, found) for name, row in _STATEMENTS if (found := row.match(block.text)))
        number = found["number"]
        if name == "end" and not self.has_ended:
            self.has_ended = True
            return Restated(_says(number, [], [], ["M2"]))
        if name == "begin":
            self.has_ended = False
        if name == "tool":
            return self._tool(number, found["words"], after.unit)
        if name == "assignment":
            # Where its value is known, that stands wherever it is used.
            return Restated(reason=f"the value of {found['name']} is not known")
        return Restated(reason=f"{found['what']} {_UNTRANSLATED}" if name == "other" else "")

    def _tool(self, number: str | None, text: str, unit: Length) -> Restated:
        """A tool: its change, its speed, and its length where the tool axis moves next."""
        found = _TOOL_WORDS.fullmatch(text)
        if found is None:
            return Restated(reason=f"TOOL CALL with {text.strip()} {_UNTRANSLATED}")
        if found["axis"] not in (None, "Z", "z"):
            return Restated(reason=f"the tool axis is {found['axis']}: only Z is written")
        codes, words = list[str](), list[str]()
        if found["tool"] is not None:
            self.tool = str(int(found["tool"]))
            self.is_length_due = self.tool != "0"
            codes = [f"T{self.tool} M6"]
        if found["speed"]:
            words.append("S" + found["speed"].replace(",", "."))
        if found["feed"]:
            self.feed.in_force = "F" + found["feed"]
            words.append(_feed(self.feed.in_force, unit))
        return Restated(_says(number, codes, words, []))


_SIDES = {"R0": "G40", "RL": "G41", "RR": "G42", "DEP": "G40"}
_AT_ITS_END = frozenset({0, 1, 2, 5, 9, 30})


def _says(number: Word | str | None, codes: list[str], words: list[str], last: list[str]) -> Carried:
    """The text of a block, with its number if it says anything."""
    label = number.text.strip().upper().lstrip("N") if isinstance(number, Word) else number
    return Carried((f"N{label}",) if label else (), tuple(codes), tuple(words), tuple(last), ())


def _feed(text: str, unit: Length) -> str:
    """A feed; that of a program in inches counts tenths of an inch."""
    value = float(text[1:].strip().replace(",", "."))
    return f"F{value / (10 if unit is Length.INCH else 1):g}"


def _wrong_place(block: Block) -> str:
    """The reason why a block leads elsewhere than its coordinates say; empty if it does not."""
    found = [word for word in block.words if word.address == "M" and word.number in _OTHER_PLACE_M]
    steps = [word for word in block.words if word.address in ("IA", "IB", "IC")]
    unknown = [word for word in block.words if word.address in LEXICON.addresses and word.number is None]
    if unknown:
        return f"{unknown[0].text.strip()} is not known"
    return f"{(found + steps)[0].text.strip()} {_UNTRANSLATED}" if found + steps else ""


def _not_known(block: Block) -> str:
    """The fault of a pole: its place is a comment, because every arc about it has its own centre."""
    lost = [word.text.strip() for word in block.words if word.address in LEXICON.addresses and word.number is None]
    return f"{lost[0]} is not known" if lost else ""


def _arc(block: Block, function: str, before: State, after: State) -> Around | str:
    """The arc of a block, or why it is not known."""
    places = [[state.axes[axis] for axis in PLANE] for state in (before, after)]
    lost = [place.reason for ends in places for place in ends if place.value is None]
    sense = block.find("DR")
    if lost or sense is None or not sense.number:
        return lost[0] if lost else "the arc has no DR"
    turn = Turn.CCW if sense.number > 0 else Turn.CW
    start, end = ((float(first.value or 0), float(second.value or 0)) for first, second in places)
    center = _center(block, function, before, start, end, turn)
    if isinstance(center, str):
        return center
    angles = [atan2(point[1] - center[1], point[0] - center[0]) for point in (start, end)]
    swept = degrees((angles[1] - angles[0]) * turn.sign) % _FULL
    if dist(start, end) <= LENGTH * 10 or swept < _LEAST or _FULL - swept < _LEAST:
        swept = _FULL
    step = block.find("IPA")
    if function == "CP" and step is not None and step.number:
        # More than one turn, as a helix has them.
        swept += _FULL * max(0, round((abs(float(step.number)) - swept) / _FULL))
    return Around(center, turn.sign * swept)


_LEAST = 1e-6
"""deg. What is nearer to a full circle is one."""


def _center(block: Block, function: str, before: State, start: Point, end: Point, turn: Turn) -> Point | str:
    """The centre of an arc, by its radius or by the pole, or why it is not known."""
    if function == "CR":
        word = block.find("R")
        radius = LEXICON.value(word, before.unit) if word else None
        if radius is None:
            return "the radius is not known"
        by_radius = center_by_radius(start, end, float(radius), turn, RADIUS_DIFFERENCE)
        apart = "its ends are farther apart than the radius reaches"
        return by_radius or (apart if dist(start, end) > 2 * LENGTH else "it ends where it begins")
    pole = pole_of(before, CENTER)
    if pole is None:
        return "the centre is not known"
    center = float(pole[0]), float(pole[1])
    if abs(dist(start, center) - dist(end, center)) > RADIUS_DIFFERENCE:
        return "its ends are not equally far from the centre"
    return center


WRITING = Writing(
    own=_Own,
    plain=_Plain,
    opening="G17 {unit} G90 G94",
    number=re.compile(r"(?m)^[ \t/]*+N?(\d{1,5})(?![\d.,])"),
)
"""The writing of Klartext."""
