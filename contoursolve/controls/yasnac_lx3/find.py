"""YASNAC LX3: which blocks are contours, of which form, and what the block behind multiple cornering does."""

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import islice
from math import asin, atan2, cos, degrees, hypot, pi, radians, sin

from msgspec.structs import replace

from contoursolve.controls.yasnac_lx3.claim import AXIS_EFFECTS
from contoursolve.controls.yasnac_lx3.g111 import claim_g111
from contoursolve.controls.yasnac_lx3.g112 import WAY, claim_g112
from contoursolve.controls.yasnac_lx3.leaving import claim_leaving
from contoursolve.gcode import Block, Macro, Word
from contoursolve.geometry import FIRST, SECOND
from contoursolve.reading import (
    Behind,
    Code,
    Effect,
    Modes,
    ParsedContour,
    ReadIssue,
    State,
    apply_modes,
    codes_of,
    positions,
    restate,
)
from contoursolve.solving import Contour, Point
from contoursolve.tolerance import AGREEMENT, LENGTH

AXIS_WORDS = frozenset("XUZW")
"""Words that move an axis."""

_BEVELLING, _ROUNDING, _LINE = 11, 12, 1


def find(blocks: Sequence[Block], index: int, state: State, modes: Modes) -> ParsedContour | None:
    """The contour that a block states by itself, if it states one."""
    block = blocks[index]
    codes = codes_of(block, modes)
    known = [code for code in codes if isinstance(code, Code)]
    own = [code.number for code in known if code.effect in AXIS_EFFECTS]
    if 111 in own:  # noqa: PLR2004 - the code
        return claim_g111(block, state, modes)
    if 112 in own:  # noqa: PLR2004
        return claim_g112(block, state, modes)
    # A word that cannot be read still shows what the block was meant to be.
    addresses = {word.address.lstrip(",") for word in block.words} | {fault.address for fault in block.faults}
    corner = next((code for code in own if code in (_BEVELLING, _ROUNDING)), None)
    if corner and addresses & {*AXIS_WORDS, "I", "K"}:
        return claim_leaving(block, corner, state, modes)
    if len(codes) > len(known) or len(own) > 1:
        return None
    motion = own[0] if own else state.motion
    if motion in (_BEVELLING, _ROUNDING) and addresses & {*AXIS_WORDS, "I", "K"}:
        return claim_leaving(block, motion, state, modes)
    if motion == _LINE and addresses & AXIS_WORDS and addresses & {"I", "K"}:
        # p. 31-32: the bevel of G11 in another form.
        return claim_leaving(block, _LINE, state, modes)
    return None


MOST = 8
"""Lines behind a contour that are looked at: blocks that do not move may stand between."""

CORNERING = {"G111": 111, "G112": 112}
"""The forms that are not modal, and their codes."""

_OWN = frozenset("AIKBCPDQR")
"""Addresses that mean something in multiple cornering beside the ends."""

_RAPID, _MOVING, _ARCS = 0, (1, 11, 12, 32, 34), {2: -1, 3: 1}
"""Motions: the rapid, those that begin with a line to their end, and arcs, +1 with the centre to the left."""

_PARTED = frozenset("OT")
"""Addresses behind which another piece of work begins."""

_ENDING = frozenset({0, 1, 2, 30, 98, 99})
"""M codes that stop, end or leave the program."""

_POSITIONING = re.compile(r"[^(;]*G0*0(?![0-9.])", re.IGNORECASE)
"""A line that says itself that it is a rapid: there is nothing to say of it."""


def follow(
    name: str,
    contour: Contour | None,
    leave: Callable[[], State],
    blocks: Iterable[Block],
    modes: Modes,
) -> Iterator[Behind]:
    """The faults of the block behind a contour of a form. `leave` gives the state behind it; no more blocks
    are read than needed."""
    state: State | None = None
    for block in islice(blocks, MOST):
        if _POSITIONING.match(block.text):
            return
        if not block.words and not block.faults and block.macro is None:
            continue
        addresses = {word.address for word in block.words}
        ends = any(word.address == "M" and word.number in _ENDING for word in block.words)
        if block.macro is Macro.FLOW or block.faults or ends or not addresses.isdisjoint(_PARTED):
            return
        state = state or leave()
        codes = codes_of(block, modes)
        effects = {code.effect for code in codes if isinstance(code, Code)}
        if Effect.NO_MOTION in effects:
            # The X of a dwell is a time.
            state = apply_modes(state, block, modes)
            continue
        if effects & _NOT_FOLLOWED:
            return
        own = [code.number for code in codes if isinstance(code, Code) and code.effect in AXIS_EFFECTS]
        if addresses & AXIS_WORDS or (addresses & _OWN and not own):
            yield from _look(name, contour, state, block, own, modes)
            return
        if any(not isinstance(code, Code) or code.effect not in _PASSING for code in codes):
            return
        state = apply_modes(state, block, modes)


_NOT_FOLLOWED = {Effect.SINGLE, Effect.PRESET}
"""Codes with which axis words are not where the tool goes from the contour."""

_PASSING = (Effect.NONE, Effect.COMPENSATION, Effect.MOTION, Effect.NO_MOTION)
"""The codes that may stand between a contour and the block that moves on."""


def _look(
    name: str,
    contour: Contour | None,
    state: State,
    block: Block,
    own: list[int],
    modes: Modes,
) -> Iterator[Behind]:
    """The faults of the first block behind a contour that moves."""
    if not own:
        alone = _left_alone(block, state.motion)
        if alone:
            yield _forgotten(name, alone, block, state, modes)
            return
        if state.motion == _RAPID:
            yield _rapid(name, block, state)
            return
    if contour is not None and not (own and own[-1] == _RAPID):
        yield from _leaving(contour, state, block, modes)


def _left_alone(block: Block, motion: int | None) -> list[Word]:
    """The words that only mean something in multiple cornering, as the motion in force has no use for them."""
    addresses = {word.address for word in block.words}
    found = addresses & _OWN
    if not found & {"A", "B"}:
        has_bevel = motion == 1 and bool(addresses & AXIS_WORDS) and found <= {"I", "K"}
        if has_bevel or motion not in (_RAPID, 1, None):
            return []
    return [word for word in block.words if word.address in found]


def _forgotten(name: str, alone: list[Word], block: Block, state: State, modes: Modes) -> Behind:
    """Words of multiple cornering without its code. Behind G11 and G12 nothing says which of the two is meant."""
    found = Behind(ReadIssue.CODE_FORGOTTEN, state, block, tuple(alone), {"code": name})
    if name not in CORNERING:
        return found
    meant = restate(block, f"G{CORNERING[name]:02}")
    claim = find([meant], 0, state, modes)
    return found if claim is None else replace(found, meant=meant, contour=claim, advice=f"write {name}")


def _rapid(name: str, block: Block, state: State) -> Behind:
    """Axis words alone, under a G00 that was in force before the contour."""
    words = tuple(word for word in block.words if word.address in AXIS_WORDS)
    advice = "write G01 if this is a cut"
    fields = {"code": name}
    return Behind(ReadIssue.RAPID_BEHIND, state, block, words, fields, meant=restate(block, "G01"), advice=advice)


def _leaving(contour: Contour, state: State, block: Block, modes: Modes) -> Iterator[Behind]:
    """A motion that does not go on along the line on which corner 2 lands."""
    last = contour.elements[-1] if contour.elements else None
    if last is None or last.name != "corner 2":
        return
    v2, end = contour.points["V2"], contour.end
    reach = hypot(end[0] - v2[0], end[1] - v2[1])
    way = _way(state, block, end, modes)
    if reach <= LENGTH or way is None or hypot(*way) <= LENGTH:
        return
    along = (end[0] - v2[0]) / reach, (end[1] - v2[1]) / reach
    aside, ahead = along[0] * way[1] - along[1] * way[0], along[0] * way[0] + along[1] * way[1]
    if ahead > 0 and abs(aside) <= AGREEMENT:
        return
    turn = abs(degrees(atan2(aside, ahead)))
    words = tuple(word for word in block.words if word.address in AXIS_WORDS)
    is_along_z = abs(along[FIRST]) > abs(along[SECOND])
    line = "the line along Z at X{across}" if is_along_z else "the line along X at Z{across}"
    fields = {"leave": "leave" if len(words) > 1 else "leaves", "line": line}
    place = {"across": 2 * end[SECOND] if is_along_z else end[FIRST]}
    values = {"expected": 0.0, "actual": turn}
    yield Behind(ReadIssue.LANDING_LEFT, state, block, words, fields, place, {"angle": turn}, values)


def _way(state: State, block: Block, end: Point, modes: Modes) -> Point | None:
    """The direction in which a motion begins: to its end, mm, or a unit vector; None where its words do not tell."""
    claim = find([block], 0, state, modes)
    if claim is not None and claim.form.name in CORNERING:
        values = {name: float(given.value) for name, given in claim.givens.items()}
        if {"I", "K"} <= values.keys() and "A" in claim.form.allowed:
            return values["K"], values["I"]
        angle = values.get("A", values.get(WAY))
        return None if angle is None else (cos(radians(angle)), sin(radians(angle)))
    after = apply_modes(state, block, modes)
    words = [word for word in block.words if word.address in AXIS_WORDS]
    found = positions(after, words, modes, is_skippable=False)
    there = [found[axis].value if axis in found else after.axes[axis].value for axis in after.plane.axes]
    first, second = there
    if first is None or second is None:
        return None
    step = float(first) - end[FIRST], float(second) - end[SECOND]
    if after.motion in _ARCS:
        return _tangent(block, step, _ARCS[after.motion], after, modes)
    return step if after.motion in _MOVING else None


def _tangent(block: Block, step: Point, side: int, state: State, modes: Modes) -> Point | None:
    """The direction in which an arc begins, by its centre or its radius."""
    words = {word.address: modes.lexicon.value(word, state.unit) for word in block.words if word.address in "IKR"}
    values = {address: float(value) for address, value in words.items() if value is not None}
    if len(values) < len(words):
        return None
    if "R" in values:
        chord, radius = hypot(*step), values["R"]
        if not LENGTH < chord <= 2 * abs(radius):
            return None
        half = asin(chord / (2 * radius))
        turn = atan2(step[1], step[0]) - side * (half if radius > 0 else pi + half)
        return cos(turn), sin(turn)
    along, across = values.get("K", 0.0), values.get("I", 0.0)
    reach = hypot(along, across)
    return (side * across / reach, -side * along / reach) if reach > LENGTH else None
