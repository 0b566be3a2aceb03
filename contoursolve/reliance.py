"""Which blocks rely on the motion code that is in force, and how it is said again where a contour has ended it."""

from collections.abc import Iterable
from enum import Enum

from contoursolve.reading import Code, Effect, Modes, codes_of
from contoursolve.syntax import Block, FaultKind, Macro, parse_block

MOTIONS = (Effect.MOTION, Effect.CYCLE, Effect.CANCEL)
"""What puts another motion in force."""

STANDING_ALONE = (0, 1)
"""Motions whose code may stand in a block of its own; an arc without words is an error on some controls."""

_OWN_WORDS = (Effect.NO_MOTION, Effect.PRESET, Effect.FRAME, Effect.CONTOUR)
"""G codes whose blocks use their words themselves, whatever motion is in force."""

_BY_THEMSELVES = frozenset({27, 28, 29, 30, 31, 36, 37})
"""Reference points, skip and measuring: they move in their own way, and leave the motion in force."""

_MODAL_CORNERS = frozenset({11, 12})
"""Cycles of which every block says all that it needs. The others keep words from one block to the next, and a
motion between them ends that."""


class Reliance(Enum):
    """What a block has to do with the motion that is in force before it."""

    NONE = "none"
    ENDS = "ends"
    """It puts another one in force, or begins a program, which has that of the program that calls it."""
    WORDS = "words"
    """Its words are read by it, so that its code may be written into the block."""
    BESIDE = "beside"
    """It may hand it on, as calls and jumps do: it must be in force before the block."""


def reliance(block: Block, modes: Modes) -> Reliance:
    """What a block has to do with the motion that is in force before it."""
    codes = codes_of(block, modes)
    known = [code for code in codes if isinstance(code, Code)]
    if any(code.effect in MOTIONS for code in known):
        return Reliance.BESIDE if block.is_skippable else Reliance.ENDS
    if block.macro is Macro.FLOW or len(known) < len(codes):
        return Reliance.BESIDE
    if any(word.address == "M" and word.number in modes.calls for word in block.words):
        return Reliance.BESIDE
    if block.find("O"):
        return Reliance.ENDS
    single = [code.number for code in known if code.effect is Effect.SINGLE]
    if single:
        return Reliance.NONE if _BY_THEMSELVES.issuperset(single) else Reliance.BESIDE
    if any(code.effect in _OWN_WORDS for code in known):
        return Reliance.NONE
    is_faulty = any(fault.kind is not FaultKind.COMMENT_NOT_CLOSED for fault in block.faults)
    uses = any(word.address in modes.lexicon.addresses for word in block.words)
    return Reliance.WORDS if uses or is_faulty else Reliance.NONE


def why_unmet(motion: int | None, blocks: Iterable[Block], modes: Modes) -> str:
    """Why a motion that has been ended is missed by the blocks behind, of which no more are read than needed; empty
    if it can be said again for the one that relies on it."""
    code = modes.codes.get(motion) if motion is not None else None
    is_free = code is not None and (code.effect is Effect.MOTION or code.number in _MODAL_CORNERS)
    for block in blocks:
        need = reliance(block, modes)
        if need is Reliance.BESIDE or (need is Reliance.WORDS and not is_free):
            name = f"the G{motion} before it" if code else "what the control starts with"
            return f"line {block.line} relies on {name}: write the G code of its motion into line {block.line}"
        if need is Reliance.ENDS or (need is Reliance.WORDS and not block.is_skippable):
            break
    return ""


def restate(block: Block, motion: int) -> Block:
    """The block with a motion code before its first word that is more than a number."""
    places = [word.span.column for word in block.words if word.address not in "NO"]
    column = min([*places, *(fault.span.column for fault in block.faults)])
    before, after = block.text[: column - 1], block.text[column - 1 :]
    blank = " " if before and before[-1] not in " \t/" else ""
    return parse_block(f"{before}{blank}G{motion:02} {after.lstrip()}", block.line)
