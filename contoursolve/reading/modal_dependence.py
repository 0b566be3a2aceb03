"""The words of a block besides its contour, and the blocks behind it that rely on the motion in force."""

from collections.abc import Iterable
from enum import Enum
from typing import NamedTuple

from contoursolve.gcode import Block, FaultKind, Macro, Word, late_pattern, parse_block
from contoursolve.reading.lexicon import Code, Effect
from contoursolve.reading.modal_state import Modes, codes_of

MOTIONS = (Effect.MOTION, Effect.CYCLE, Effect.CANCEL)
"""The effects that put another motion in force."""

STANDING_ALONE = (0, 1)
"""Motions whose code may stand in a block of its own; an arc without words is an error on some controls."""

_OWN_WORDS = (Effect.NO_MOTION, Effect.PRESET, Effect.FRAME, Effect.CONTOUR)
"""G codes whose blocks use their words themselves, whatever motion is in force."""


class Reliance(Enum):
    """The part in a block of the motion that is in force before it."""

    NONE = "none"
    ENDS = "ends"
    """It puts another one in force, or begins a program, which has that of the program that calls it."""
    WORDS = "words"
    """Its words are read by it, so that its code may be written into the block."""
    BESIDE = "beside"
    """It may hand it on, as calls and jumps do: it must be in force before the block."""


def reliance(block: Block, modes: Modes) -> Reliance:
    """The part in a block of the motion that is in force before it."""
    codes = codes_of(block, modes)
    known = [code for code in codes if isinstance(code, Code)]
    if any(code.effect in MOTIONS for code in known):
        return Reliance.BESIDE if block.is_skippable else Reliance.ENDS
    if block.macro is Macro.FLOW or len(known) < len(codes):
        return Reliance.BESIDE
    if any(word.address == "M" and word.number in _PROGRAM_ENDS for word in block.words):
        return Reliance.ENDS
    if any(modes.is_call(word) for word in block.words):
        return Reliance.BESIDE
    if block.find("O"):
        return Reliance.ENDS
    single = [code for code in known if code.effect is Effect.SINGLE]
    if single:
        return Reliance.NONE if all(code.leaves_motion for code in single) else Reliance.BESIDE
    if any(code.effect in _OWN_WORDS for code in known):
        return Reliance.NONE
    is_faulty = any(fault.kind is not FaultKind.COMMENT_NOT_CLOSED for fault in block.faults)
    uses = any(word.address in modes.lexicon.addresses for word in block.words)
    return Reliance.WORDS if uses or is_faulty else Reliance.NONE


def why_unmet(motion: int | None, blocks: Iterable[Block], modes: Modes) -> str:
    """The reason why a motion that has been ended is missed by the blocks behind, of which no more are read than
    needed; empty if it can be said again for the one that relies on it."""
    code = modes.codes.get(motion) if motion is not None else None
    is_free = code is not None and (code.effect is Effect.MOTION or code.says_all)
    for block in blocks:
        need = reliance(block, modes)
        if need is Reliance.BESIDE or (need is Reliance.WORDS and not is_free):
            name = f"the {code.name or f'G{motion}'} before it" if code else "what the control starts with"
            return f"program line {block.line} relies on {name}: write the G code of its motion into it"
        if need is Reliance.ENDS or (need is Reliance.WORDS and not block.is_skippable):
            break
    return ""


def restate(block: Block, code: str) -> Block:
    """The block with the code of a motion before its first word that is more than a number."""
    places = [word.span.column for word in block.words if word.address not in "NO"]
    column = min([*places, *(fault.span.column for fault in block.faults)])
    before, after = block.text[: column - 1], block.text[column - 1 :]
    blank = " " if before and before[-1] not in " \t/" else ""
    return parse_block(f"{before}{blank}{code} {after.lstrip()}", block.line, block.syntax)


_BLANKS = " \t\f\v\x02\x03\x11\x12\x13\x14\x1a\ufeff%"

_FRAME = late_pattern(rf"(?P<head>[{_BLANKS}]*+)(?>(?P<skip>/[1-9]?+(?!\d)[ \t]*+)?)")

_PROGRAM_ENDS = frozenset({2, 30})

_DROPPED = (*MOTIONS, Effect.CONTOUR, Effect.CORNER)
"""G codes in whose place those of the plain motions stand."""

_AFTER_MOTION = frozenset({0, 1, 2, 5, 9, 30, 60})
"""M codes that act after the motion of their block, as calls do: stop, end, spindle and coolant off, pallet."""


class Frame(NamedTuple):
    """The frame around the words of a block: what is for a tape reader, blanks before the words, the block skip, and
    what is for a tape reader behind them."""

    before: str = ""
    indent: str = ""
    skip: str = ""
    behind: str = ""


class Carried(NamedTuple):
    """The words of a block besides its contour, as they are written: its numbers and G codes, words for the first and
    for the last line in its place, and the G codes and words among them (`kept`)."""

    numbers: tuple[str, ...]
    codes: tuple[str, ...]
    words: tuple[str, ...]
    last: tuple[str, ...]
    kept: tuple[Word, ...]

    @property
    def says_something(self) -> bool:
        """Whether there is anything besides the contour."""
        return bool(self.kept)


def frame_of(text: str) -> Frame:
    """The frame around the words of a block."""
    if text[:1].isalpha() and (text[-1].isalnum() or text[-1] == "."):
        return Frame()
    frame = _FRAME.match(text)
    if frame is None:
        return Frame()
    head, rest = frame["head"], text[frame.end() :]
    indent = "".join(c for c in head if c in " \t")
    before = "".join(c for c in head if c not in " \t")
    return Frame(before, indent, frame["skip"] or "", rest[len(rest.rstrip(_BLANKS)) :].strip(" \t"))


def carried(block: Block, modes: Modes) -> Carried:
    """The words of a block besides its contour."""
    numbers: list[str] = []
    codes: list[str] = []
    words: list[str] = []
    last: list[str] = []
    kept: list[Word] = []
    rows = iter(codes_of(block, modes) if block.words else ())
    for word in block.words:
        text = word.text.strip()
        if word.address == "G":
            row = next(rows)
            if not isinstance(row, Word) and (row.effect in _DROPPED or row.number in modes.separate):
                continue
            codes.append(text)
        elif word.address in "NO":
            numbers.append(text)
        elif word.address in modes.lexicon.addresses:
            continue
        elif word.address == "M" and (word.number in _AFTER_MOTION or word.number in modes.calls):
            last.append(text)
        else:
            words.append(text)
        kept.append(word)
    return Carried(tuple(numbers), tuple(codes), tuple(words), tuple(last), tuple(kept))
