"""Notes what a program says that a target does not know, or reads in another way."""

import re
from collections.abc import Sequence
from decimal import Decimal
from functools import lru_cache

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import join
from contoursolve.gcode import Block, Macro, Word
from contoursolve.geometry import Length
from contoursolve.postprocess.post_processors import Other, Post, Risk, SupportedCodes
from contoursolve.reading import Control, Effect, State, WithoutPoint, rows_of

_NO_COMPENSATION = 40

_RUN_AS = {0: "a rapid", 1: "a line", 2: "an arc", 3: "an arc"}
"""Motion that a target makes of coordinates, by the motion in force there."""

_BESIDE_MOTION = (Effect.NONE, Effect.ABSOLUTE, Effect.INCREMENTAL, Effect.PLANE)
"""Effects of codes that leave the coordinates of their block to the motion in force."""

_CENTERS = frozenset("IJKR")
"""Of the words that are no coordinates, those that a path is made of."""


_NOT_KNOWN = Other("is not known")
_LONG = re.compile(r"=|^[ \t]*#|\d,|^[ \t]*[A-Za-z]{2}")
"""Words that are no letter with a plain number."""
_PATH_WITHOUT_POINT = "path without point"


class Unfamiliar(Struct, frozen=True):
    """One code or word, as it was first written: what is the matter with it, and in which line that is.

    With Risk.PATH, `meant` is what it is on the control of the program.
    """

    text: str
    problem: str
    line: int
    risk: Risk = Risk.TOLD
    meant: str = ""
    runs: str = ""
    """Words of this block that the target would run as another motion than the program's control."""
    run_as: str = ""
    followers: int = 0
    """Number of lines behind it that rely on it."""
    advice: str = ""

    def sentence(self, target: str) -> str:
        """The problem in words, on a target of this title."""
        meant = f" ({self.meant})" if self.meant else ""
        behind = f"{self.followers} line{'s' * (self.followers > 1)} after it" if self.followers else ""
        runs = join([each for each in (self.runs, behind) if each])
        result = f", which would run {runs} as {self.run_as}" if runs and self.run_as else ""
        title = target.partition(";")[0]
        if self.problem == _NOT_KNOWN.meaning and not meant:
            return f"{title} does not know {self.text}{self.advice}"
        return f"on {title}, {self.text}{meant} {self.problem}{result}{self.advice}"


@lru_cache(maxsize=32)
def _looking_for(addresses: str, is_counting: bool) -> re.Pattern[str]:
    """A word of one of some addresses, or (where numbers without a point count in another way) a coordinate without a
    point; or something in a comment that looks like one."""
    parts = [rf"[{addresses}][ \t]*[+-]?[.0-9]"] * bool(addresses)
    parts += [r"[XYZ][ \t]*[+-]?[0-9]+(?![0-9.])"] * is_counting
    return re.compile("|".join(parts), re.IGNORECASE)


class Watch:
    """Looks at every block that is not replaced."""

    def __init__(self, post: Post, control: Control, reading: SupportedCodes | None) -> None:
        self.post = post
        self.reading = reading
        self.control = control.name
        self.lexicon = control.modes.lexicon
        self.modes = control.modes
        without_point = post.without_point or self.lexicon.numbers.without_point
        self.counts = None if without_point is self.lexicon.numbers.without_point else without_point
        self.found: list[Unfamiliar] = []
        self._places: dict[str, int] = {}
        """What is noted, by its name, and where in the list of what was found it is."""
        self._open = {*"FST"} & reading.otherwise.keys() if reading else set()
        """What may be said in a line that only moves, and is not noted yet."""
        self._verdicts: dict[tuple[str, str], Other | None] = {}
        self._followers: dict[int, int] = {}
        """How many blocks rely on a cycle, by its place in the list of what was found."""
        self._motion: int | None = None
        """The motion that is in force on the target."""

    def asks(self, text: str) -> bool:
        """Whether lines that only move may say something that is not noted yet."""
        if self.reading is None:
            return False
        is_counting = self.counts is not None and _PATH_WITHOUT_POINT not in self._places
        if not self._open and not is_counting:
            return False
        return _looking_for("".join(sorted(self._open)), is_counting).search(text) is not None

    def minds(self, state: State) -> bool:
        """Whether what is in force may be worth a note at any block."""
        is_flat = self.reading is not None and self.reading.flat_compensation
        return is_flat and state.plane.code == "G19" and state.compensation != _NO_COMPENSATION

    def look(self, block: Block, words: Sequence[Word], state: State, motion: int | None) -> None:
        """Note what a block, with the state before it, says in words that the target does not read like this; `motion`
        is what is in force there in the expanded program."""
        reading = self.reading
        if reading is None:
            return
        if block.macro is Macro.FLOW and not reading.has_macros:
            self._note("IF, WHILE, GOTO", Unfamiliar(block.text.strip(), "is not known", block.line))
        self._follow(words, motion)
        self._count(words, state)
        for word in words:
            key = word.address, word.text
            if key in self._verdicts:
                other = self._verdicts[key]
            else:
                other = self._judge(word, reading)
                if word.address in "GMT":
                    self._verdicts[key] = other
            if other is not None:
                self._note_other(word, other, block)
            if self.counts is not None and self._counts_otherwise(word):
                self._note_without_point(word, block, state, is_path=not self._stops(block, words, reading))
        if self.minds(state):
            self._note("G19 compensation", Unfamiliar(f"G{state.compensation} in G19", "is not known", block.line))

    def _judge(self, word: Word, reading: SupportedCodes) -> Other | None:
        """The meaning of a word on the target, if it is another one; else None."""
        if _LONG.search(word.text) and word.address not in ("G", "M"):
            return _NOT_KNOWN
        if word.address not in ("G", "M"):
            return reading.otherwise.get(word.address)
        known = reading.g if word.address == "G" else reading.m
        if word.number is None or word.number != word.number.to_integral_value():
            return _NOT_KNOWN
        number = int(word.number)
        other = reading.otherwise.get(f"{word.address}{number}")
        if other is None:
            return None if number in known else _NOT_KNOWN
        own = self.modes.codes.get(number) if word.address == "G" else None
        return None if own is not None and own.effect is other.effect else other

    def _note_other(self, word: Word, other: Other, block: Block) -> None:
        text = word.text.strip()
        name = word.address
        if name in "GM":
            name += text[1:] if word.number is None else f"{word.number.normalize():f}"
        place = self._places.get(name)
        if place is not None and (other.risk is Risk.TOLD or self.found[place].risk is Risk.PATH):
            return
        if other.risk is Risk.TOLD:
            self._note(name, Unfamiliar(text, other.meaning, block.line))
            return
        own = self.modes.codes.get(int(word.number)) if word.address == "G" and word.number is not None else None
        meant = f"{own.meaning if own else 'not known to contoursolve'} on {self.control}"
        runs, run_as = "", ""
        if other.effect in _BESIDE_MOTION:
            runs = " ".join(each.text.strip() for each in block.words if self._is_coordinate(each))
        if other.effect in (*_BESIDE_MOTION, Effect.PRESET):
            is_known = self._motion in _RUN_AS
            run_as = f"{_RUN_AS[self._motion or 0]}: G{self._motion:02} is in force" if is_known else "what is in force"
        # By itself, such a code only says what is in force there already.
        is_path = runs or other.effect not in (Effect.NONE, Effect.ABSOLUTE)
        risk = Risk.PATH if is_path else Risk.TOLD
        found = Unfamiliar(text, other.meaning, block.line, risk, meant, runs, run_as)
        if place is None:
            self._note(name, found)
        elif is_path:
            self.found[place] = found

    def _follow(self, words: Sequence[Word], motion: int | None) -> None:
        """Update the motion in force on the target, where a cycle of the source control alone changes nothing."""
        codes = [int(word.number) for word in words if word.address == "G" and word.number in _RUN_AS]
        if codes or motion in _RUN_AS:
            self._motion = codes[-1] if codes else motion

    def _count(self, words: Sequence[Word], state: State) -> None:
        """Count a block that relies on a cycle that the target reads in another way."""
        place = self._places.get(f"G{state.motion}")
        own = self.modes.codes.get(state.motion or 0)
        if place is None or own is None or own.effect is not Effect.CYCLE or not any(map(self._is_coordinate, words)):
            return
        if not any(word.address == "G" and self._moves(word) for word in words):
            self._followers[place] = self._followers.get(place, 0) + 1

    def _moves(self, word: Word) -> bool:
        row = self.modes.codes.get(int(word.number)) if word.number is not None else None
        return row is not None and row.effect in (Effect.MOTION, Effect.CYCLE)

    def finish(self) -> None:
        """Say of what was found how many lines rely on it."""
        for place, followers in self._followers.items():
            found = self.found[place]
            if found.meant:
                self.found[place] = replace(found, risk=Risk.PATH, followers=followers)

    def _is_coordinate(self, word: Word) -> bool:
        row = self.lexicon.addresses.get(word.address)
        return row is not None and bool(row.axis)

    def _stops(self, block: Block, words: Sequence[Word], reading: SupportedCodes) -> bool:
        """Whether the words of a block make no path there: a dwell, data, or a code at which the target stops."""
        codes = rows_of(block, self.modes)
        if any(code.effect is Effect.NO_MOTION for code in codes):
            return True
        return any(word.address == "G" and self._judge(word, reading) is _NOT_KNOWN for word in words)

    def _counts_otherwise(self, word: Word) -> bool:
        """Whether a number means another length or angle on the target because it has no point."""
        is_number = word.number is not None and word.number != 0 and not word.has_point
        return is_number and word.address in self.lexicon.addresses and word.address != "Q"

    def _note_without_point(self, word: Word, block: Block, state: State, *, is_path: bool) -> None:
        is_count = self.counts is WithoutPoint.LEAST_INCREMENTS
        text = word.text.strip()
        if not is_path or not (self._is_coordinate(word) or word.address in _CENTERS):
            problem = "counts in least increments" if is_count else "is taken as written"
            self._note("without point", Unfamiliar(text, f"{problem} where it has no point", block.line))
            return
        number = word.number or Decimal(0)
        step = self.lexicon.numbers.step(self.lexicon.addresses[word.address].unit, state.unit)
        here, there = (number, number * step) if is_count else (number * step, number)
        unit = "in" if state.unit is Length.INCH else "mm"
        problem = f"has no point and is {there.normalize():f} {unit}"
        meant = f"{here.normalize():f} {unit} on {self.control}"
        pointed = f"{here.normalize():f}" + "." * (here == here.to_integral_value())
        advice = "; write " + self.lexicon.spell(word.address, pointed)
        found = Unfamiliar(text, problem, block.line, Risk.PATH, meant, advice=advice)
        self._note(_PATH_WITHOUT_POINT, found)

    def _note(self, name: str, found: Unfamiliar) -> None:
        if name not in self._places:
            self._places[name] = len(self.found)
            self._open.discard(name)
            self.found.append(found)
