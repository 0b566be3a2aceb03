"""The meaning of what the blocks of a program say beside their path, in functions that controls share."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cache
from typing import NamedTuple

from contoursolve.gcode import Block, own_comments
from contoursolve.geometry import Length
from contoursolve.postprocess.conversion.program_words import TABLE, ControlKind, ProgramFunction, cell_of
from contoursolve.reading import MOTIONS, Bearing, Code, Control, Effect, Plain, Restated, State, WithoutPoint


class SaidFunction(NamedTuple):
    """A function that a block says: its number, its words as they are typed, and its place among the words."""

    function: ProgramFunction
    number: Decimal = Decimal(0)
    text: str = ""
    place: int = 0
    has_point: bool = True
    """Whether its number has a point, where one without counts steps."""


class Token(NamedTuple):
    """A word by its address and its number, and as it is typed."""

    address: str
    number: Decimal | None
    text: str
    has_point: bool = False


@dataclass(slots=True)
class Meaning:
    """The meaning of a block beside its path. `reason` is why it is not converted, `lost` the words that are not."""

    block: Block
    functions: list[SaidFunction] = field(default_factory=list)
    codes: list[tuple[Code, int]] = field(default_factory=list)
    """Codes with a row of their own, as planes and compensation, each with its place among the words."""
    motion: Code | None = None
    """The motion that it states."""
    number: str = ""
    comments: list[str] = field(default_factory=list)
    lost: list[str] = field(default_factory=list)
    reason: str = ""
    end: str = ""
    """The reason why it is not converted where it ends what turns the coordinate system; where nothing does, it is
    nothing that is lost."""
    restated: Restated | None = None
    radius: Token | None = None
    """The D of its compensation."""
    tool_name: str = ""
    """The name of a tool that has no number, as it is typed."""
    is_metric_feed: bool = False
    """Tells whether its unit leaves the feed in mm."""

    def has(self, *functions: ProgramFunction) -> bool:
        """Whether it says one of these functions."""
        return any(each.function in functions for each in self.functions)

    def value(self, function: ProgramFunction) -> Decimal | None:
        """The number of a function, if it says that."""
        return next((each.number for each in self.functions if each.function is function), None)

    @property
    def is_silent(self) -> bool:
        """Whether it says nothing beside its path."""
        return not (self.functions or self.codes or self.lost or self.reason or self.tool_name)


class _Pattern(NamedTuple):
    """Words of a function: addresses, each with the number that it must have, None for any one."""

    function: ProgramFunction
    words: tuple[tuple[str, Decimal | None], ...]
    factor: Decimal = Decimal(1)


_WORD = re.compile(r"(?P<address>[A-Z]+)=?(?P<number>\{\w*\}|\d+)?")
_TOKEN = re.compile(r"(?P<address>[A-Z]+)(?P<number>[+-]?(?:\d+\.?\d*|\.\d+))")
_MS, _DWELL = Decimal("0.001"), 4


@cache
def _patterns(kind: ControlKind) -> tuple[_Pattern, ...]:
    """The words that are read on a kind of control, the most special first."""
    found = list[_Pattern]()
    for function in TABLE:
        cell = cell_of(function, kind)
        for text in cell.texts if cell else ():
            words = []
            for part in text.split():
                match = _WORD.fullmatch(part)
                if match is None:
                    break
                is_slot = (match["number"] or "{").startswith("{")
                words.append((match["address"], None if is_slot else Decimal(match["number"])))
            else:
                found.append(_Pattern(function, tuple(words), _MS if "{ms}" in text else Decimal(1)))
    return tuple(sorted(found, key=lambda each: -sum(number is not None for _, number in each.words) - len(each.words)))


_OF_CONTOURS = (*MOTIONS, Effect.CONTOUR, Effect.CORNER)
_SELECTING = (Effect.PLANE, Effect.ABSOLUTE, Effect.INCREMENTAL, Effect.COMPENSATION)
_LATHE_TOOL = re.compile(r"T(?P<tool>\d{1,2})(?P<offset>\d{2})")
_STRAY = {"F": ProgramFunction.FEED, "S": ProgramFunction.SPEED}
_METRIC_FEED = (Decimal(70), Decimal(71))


class MeaningReader:
    """Reads the blocks of one program of a control, in their order."""

    def __init__(self, control: Control, kind: ControlKind) -> None:
        self.control, self.kind, self.modes = control, kind, control.modes
        self.plain: Plain | None = control.writing.plain() if control.writing is not None else None
        self.tool = Decimal(0)
        is_haas = kind in (ControlKind.HAAS_LATHE, ControlKind.HAAS_MILL)
        numbers = control.modes.lexicon.numbers
        self.counts = kind.is_fanuc and not is_haas and numbers.without_point is WithoutPoint.LEAST_INCREMENTS
        """Tells whether a feed and a dwell without a point count steps; on a Haas, a setting decides."""

    def read(self, block: Block, before: State, after: State, *, is_contour: bool) -> Meaning:
        """Read a block, between two states."""
        meaning = Meaning(block, comments=[*_comments_of(block)])
        if self.plain is not None:
            return self._klartext(meaning, before, after, self.plain, is_contour=is_contour)
        if block.macro is not None:
            meaning.reason = "it computes or jumps"
            return meaning
        if block.faults:
            meaning.reason = f"{block.faults[0].text.strip()} cannot be read"
            return meaning
        calls = [word for word in block.words if self.modes.is_call(word)]
        if calls:
            meaning.reason = self.modes.why_lost(calls[0])
            return meaning
        tokens = [Token(word.address, word.number, word.text.strip(), word.has_point) for word in block.words]
        self._take(meaning, tokens, is_contour=is_contour)
        return meaning

    def _klartext(self, meaning: Meaning, before: State, after: State, plain: Plain, *, is_contour: bool) -> Meaning:
        block = meaning.block
        if not (block.words or block.macro or block.faults):
            return meaning
        if is_contour:
            said = plain.beside(block, before)
        else:
            said = plain.restate(block, before, after)
            meaning.restated = said
        texts = [*said.says.codes, *said.says.words, *said.says.last]
        head = re.match(r"\s*/?\s*\d*\s*(?P<name>BLK FORM|TOOL DEF|BEGIN|END)\b(?P<rest>.*)", block.text, re.IGNORECASE)
        if head is not None:
            if head["name"].upper() in ("BLK FORM", "TOOL DEF"):
                meaning.comments = [f"{head['name'].upper()}{head['rest']}"]
            return meaning
        meaning.number = ""
        tokens = [
            Token(match["address"], Decimal(match["number"]), match[0], "." in match["number"])
            for text in texts
            for match in _TOKEN.finditer(text)
        ]
        if said.reason and (not is_contour or not texts):
            meaning.reason = said.reason
            return meaning
        self._take(meaning, tokens, is_contour=is_contour)
        return meaning

    def _take(self, meaning: Meaning, tokens: list[Token], *, is_contour: bool) -> None:
        """Sort the words of a block by what they mean."""
        kind = ControlKind.FANUC_MILL if self.plain is not None else self.kind
        rest = list(tokens)
        if kind in (ControlKind.FANUC_LATHE, ControlKind.HAAS_LATHE):
            rest = self._lathe_tool(meaning, rest)
        for pattern in _patterns(kind):
            taken = _match(pattern, rest)
            if taken is None or (
                pattern.function is ProgramFunction.DWELL and not any(each.number == _DWELL for each in taken)
            ):
                continue
            value = next((each for each, (_, fixed) in zip(taken, pattern.words, strict=True) if fixed is None), None)
            number = value.number if value is not None and value.number is not None else Decimal(0)
            if (
                pattern.function is ProgramFunction.DWELL
                and kind is ControlKind.HAAS_MILL
                and value is not None
                and value.has_point
            ):
                number *= 1000
            if self.counts and pattern.function is ProgramFunction.DWELL and value is not None:
                number *= 1 if value.has_point or value.address == "P" else _MS
            said = " ".join(each.text for each in taken)
            meaning.functions.append(
                SaidFunction(pattern.function, number * pattern.factor, said, tokens.index(taken[0]))
            )
            if pattern.function in (ProgramFunction.MM, ProgramFunction.INCH):
                meaning.is_metric_feed = self.kind is ControlKind.SINUMERIK and taken[0].number in _METRIC_FEED
            rest = [each for each in rest if each not in taken]
            if pattern.function is ProgramFunction.DWELL:
                break
        rest, has_side = self._codes(meaning, tokens, rest, is_contour=is_contour)
        for token in rest:
            self._remains(meaning, token, has_side=has_side)

    def _codes(
        self, meaning: Meaning, tokens: list[Token], rest: list[Token], *, is_contour: bool
    ) -> tuple[list[Token], bool]:
        """Take the codes that have a row of their own; the words that remain, and whether one selects a side."""
        left, has_side = list[Token](), False
        for token in rest:
            code = self._row(token)
            if code is not None and (code.effect in _SELECTING or code.diameter is not None):
                meaning.codes.append((code, tokens.index(token)))
                has_side |= code.effect is Effect.COMPENSATION
            elif code is not None and code.effect is Effect.MOTION and code.number in range(4):
                meaning.motion = code
            elif code is None or not is_contour or code.effect not in _OF_CONTOURS:
                left.append(token)
        return left, has_side

    def _row(self, token: Token) -> Code | None:
        """The row of a G code; of Klartext that is written in G codes, those of compensation."""
        if token.address != "G" or token.number is None:
            return None
        rows = self.modes.codes.values()
        if self.plain is None:
            # Codes with a point are looked up by a decimal.
            row: Code | None = self.modes.codes.get(token.number)  # type: ignore[call-overload]
            return row
        return next((row for row in rows if row.effect is Effect.COMPENSATION and row.number == token.number), None)

    def _lathe_tool(self, meaning: Meaning, tokens: list[Token]) -> list[Token]:
        """T of a lathe of Fanuc: its last two digits are the offset."""
        rest = list[Token]()
        for token in tokens:
            if token.address != "T":
                rest.append(token)
                continue
            text = token.text.replace(" ", "").upper()
            found = _LATHE_TOOL.fullmatch(text)
            if found is None:
                meaning.lost.append(token.text)
                continue
            tool, offset = Decimal(found["tool"]), Decimal(found["offset"])
            if tool and tool != self.tool:
                meaning.functions.append(SaidFunction(ProgramFunction.TOOL, tool, token.text))
            self.tool = tool or self.tool
            if offset == 0:
                meaning.functions.append(SaidFunction(ProgramFunction.NO_LENGTH, tool, token.text))
            else:
                meaning.functions.append(SaidFunction(ProgramFunction.LENGTH, tool, token.text))
            if offset not in (0, tool):
                meaning.lost.append(token.text)
        return rest

    def _remains(self, meaning: Meaning, token: Token, *, has_side: bool) -> None:
        """A word that the table does not have."""
        address, lexicon = token.address, self.modes.lexicon
        if address == "N":
            meaning.number = token.text.upper().replace(" ", "")
        elif address in ("O", ":") and self.kind.is_fanuc:
            meaning.reason = meaning.reason or "it begins a subprogram"
        elif address in _STRAY:
            if token.number is None:
                meaning.lost.append(token.text)
            else:
                has_point = token.has_point or not self.counts
                meaning.functions.append(SaidFunction(_STRAY[address], token.number, token.text, has_point=has_point))
        elif address == "G":
            code = self._row(token) if self.plain is None else None
            if code is not None and (code.effect is Effect.NONE or code.effect is Effect.CANCEL) and code.is_read:
                meaning.lost.append(token.text)
            else:
                told = f": {code.meaning}" if code is not None else ""
                reason = f"{token.text} has no counterpart{told}"
                if code is not None and code.ends_frame:
                    meaning.end = meaning.end or reason
                else:
                    meaning.reason = meaning.reason or reason
        elif address == "D" and has_side:
            meaning.radius = token
        elif self.is_of_path(token):
            pass
        elif address == "T" and token.number is None:
            meaning.tool_name = token.text
        elif address == "M" or lexicon.bearing(address) in (Bearing.NONE, None) or address in ("T", "D", "H", "LIMS"):
            meaning.lost.append(token.text)
        else:
            meaning.reason = meaning.reason or f"{token.text} has no counterpart"

    def is_of_path(self, token: Token) -> bool:
        """Whether a word is one of the path."""
        name, modes = token.address, self.modes
        return (
            name in modes.lexicon.addresses or name == modes.radius or name.partition("=")[0] in ("I", "J", "K", "AR")
        )


def _match(pattern: _Pattern, tokens: Sequence[Token]) -> list[Token] | None:
    """The words of a block that a pattern is; None if it has not all of them."""
    taken = list[Token]()
    for address, number in pattern.words:
        found = next(
            (
                each
                for each in tokens
                if each.address == address
                and each not in taken
                and (each.number == number if number is not None else each.number is not None)
            ),
            None,
        )
        if found is None:
            return None
        taken.append(found)
    return taken


_DELIMITED = re.compile(r"^[(\[;]\s*|\s*[)\]]$")


def _comments_of(block: Block) -> Iterator[str]:
    """The comments of a block, without what marks them; a message to the operator is one, too."""
    message = re.search(r"\bMSG\s*\(\s*\"([^\"]*)\"", block.text)
    texts: Iterable[str] = own_comments(block)
    for text in texts:
        bare = _DELIMITED.sub("", text.strip()).strip()
        if bare:
            yield bare
    if message is not None:
        yield message[1]


def is_message(block: Block) -> bool:
    """Whether a block is a message to the operator alone."""
    return bool(re.match(r"\s*(?:N\d+\s*)?MSG\s*\(", block.text))


def unit_of(meaning: Meaning) -> Length | None:
    """The unit that a block states."""
    return Length.MM if meaning.has(ProgramFunction.MM) else Length.INCH if meaning.has(ProgramFunction.INCH) else None
