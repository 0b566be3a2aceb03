"""NCT 99M chapter 16 from the control sheet alone: corners, one coordinate with an angle, and intersections.

No import of the package. A place is a complex number: real is the plane's first axis, imaginary its second; mm.

Printed: what makes a block over-defined, that its end is absolute even under G91, that the block before it
gives a point and not an end, Q beside a line (Q<0 of 16.3.2 and both of 16.3.3), the meaning of ,C and ,R, the
sign of R, incremental I J K of an ordinary circle, absolute ones of an over-defined circle in 16.3.2.
Derived: Q>0 of 16.3.2; absolute centres in 16.3.4; Q counted as the line is met, so a start inside the circle
has its nearer point behind it; a line runs the way of its ,A, or from its start to its given point;
coordinates and centres of the block after a corner count from the virtual corner (p.119).
Assumed: Q<0 of 16.3.4 is the point left of C1->C2; the sign of an over-defined R says nothing; Q missing or 0 is
refused except between lines; an over-defined block needs a G1, G2 or G3 before it; a lone coordinate beside ,A may
be incremental; 0.01 mm for alarm 3011; an amount of 0 is no corner.
"""

import re
from cmath import phase, rect
from collections.abc import Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from math import acos, copysign, sqrt, tau
from typing import NamedTuple

from oracle import PLANES, Element, Outcome, Words, _RefusedError as Refused, cross, dot, heading, meet, sign
from oracle_corners import Corner, connect


class Block(NamedTuple):
    motion: str
    """G0, G1, G2 or G3."""
    words: Words
    is_incremental: bool = False
    is_compensated: bool = True
    was_compensated: bool = True
    """Before it."""


class Settings(NamedTuple):
    """What no page says, by the names of the settings."""

    circle_circle_q: str = "left-is-negative"
    radius_difference: str = "0.01"
    compensation: str = "required"


DEFAULT = Settings()


@dataclass
class Run(Outcome):
    """Blocks that are worked out together; `points` are the computed intersections P1, P2, ..."""

    vertices: list[complex] = field(default_factory=list)
    """The start and the ends of all blocks as if they had no corners."""
    settings: Settings = DEFAULT


def follow(plane: int, start: complex, blocks: Sequence[Block], settings: Settings = DEFAULT) -> Run:
    """The path of a run.

    >>> blocks = Block("G1", {",A": 150}), Block("G1", {"X": 10, "Y": 20, ",A": 225})
    >>> f"{follow(17, 90 + 10j, blocks).points['P1']:.4f}"
    '32.9423+42.9423j'
    """
    run = Run(end=start, vertices=[start], settings=settings)
    if not _is_legal(plane, blocks, settings):
        run.status = "rejected"
        return run
    try:
        sharp = _sharp(plane, start, blocks, run)
        corners = {}
        for k, block in enumerate(blocks):
            for word in ",C", ",R":
                if word in block.words:
                    corners[k] = Corner(word[1], float(block.words[word]))
        connect(sharp, corners, run)
        run.status = "solved"
    except Refused as refused:
        run.status = refused.args[0]
    return run


def is_over_defined(plane: int, block: Block) -> bool:
    first, second, i, j = PLANES[plane]
    more = {",A"} if block.motion == "G1" else {i, j, "R"} if block.motion in ("G2", "G3") else None
    return more is not None and block.words.keys() >= {first, second} | more


def _is_legal(plane: int, blocks: Sequence[Block], settings: Settings) -> bool:
    first, second, i, j = PLANES[plane]
    for k, block in enumerate(blocks):
        words, is_circle = block.words, block.motion in ("G2", "G3")
        before = blocks[k - 1] if k else None
        if {",C", ",R"} <= words.keys() or any(words.get(word, 0) < 0 for word in (",C", ",R")):
            return False
        if {",C", ",R"} & words.keys() and (k + 1 == len(blocks) or "G0" in (block.motion, blocks[k + 1].motion)):
            return False
        if is_over_defined(plane, block):
            is_line_line = not is_circle and before is not None and before.motion == "G1"
            if before is None or before.motion == "G0":
                return False
            is_compensated = before.was_compensated and before.is_compensated and block.is_compensated
            if not is_compensated and settings.compensation == "required":
                return False
            if not is_line_line and not words.get("Q"):
                return False
            if is_circle and words["R"] == 0:
                return False
        elif is_circle:
            has_center, has_end = bool(words.keys() & {i, j}), bool(words.keys() & {first, second})
            if has_center == ("R" in words) or not (has_center or has_end) or words.get("R") == 0:
                return False
        elif not words.keys() & {first, second} and (k + 1 == len(blocks) or not is_over_defined(plane, blocks[k + 1])):
            return False
    return True


def _sharp(plane: int, start: complex, blocks: Sequence[Block], run: Run) -> list[Element]:
    over = [is_over_defined(plane, block) for block in blocks] + [False]
    given = []
    at = start
    for k, block in enumerate(blocks):  # what words say of one block comes before what becomes of two
        given.append(_over_defined(plane, block, run) if over[k] else _ordinary(plane, at, block, over[k + 1], run))
        at = given[-1][1]
    sharp: list[Element] = []
    at = start
    for k, (curve, point) in enumerate(given):
        end = point
        if over[k + 1]:
            q = sign(float(blocks[k + 1].words.get("Q", 0)))
            end = crossing(curve._replace(start=at if curve.center else curve.start), given[k + 1][0], q, run)
            run.points[f"P{len(run.points) + 1}"] = end
        if curve.center is None:
            along = curve.end - curve.start
            run.need(dot(along / abs(along), end - at))
        elif over[k] or over[k + 1]:
            run.need_length(abs(end - at))
        sharp.append(curve._replace(start=at, end=end))
        run.vertices.append(end)
        at = end
    return sharp


def _over_defined(plane: int, block: Block, run: Run) -> tuple[Element, complex]:
    """The line or circle as an element whose start says nothing, and the given point."""
    first, second, i, j = PLANES[plane]
    words = block.words
    point = complex(words[first], words[second])
    if block.motion == "G1":
        return Element("line", point - heading(words[",A"]), point), point
    center, radius = complex(words[i], words[j]), abs(float(words["R"]))
    _agree(abs(point - center), radius, run)
    return Element("arc", point, point, center, radius, _turn(block)), point


def _ordinary(plane: int, at: complex, block: Block, gives_point: bool, run: Run) -> tuple[Element, complex]:
    """An element that ends at the given end or point, and that end."""
    first, second, i, j = PLANES[plane]
    words, base = block.words, 0j if block.is_incremental else at
    point = complex(words.get(first, base.real), words.get(second, base.imag))
    if block.is_incremental:
        point += at
    if block.motion in ("G0", "G1"):
        if ",A" in words:
            along = heading(words[",A"])
            if words.keys() & {first, second} and not gives_point:
                wall = (point, 1j if first in words else 1 + 0j)
                point = meet((at, along), wall, run)
            return Element("line", at, at + along), point
        run.need_length(abs(point - at))
        return Element("line", at, point), point
    if "R" in words:
        radius, chord = abs(float(words["R"])), point - at
        run.need_length(abs(chord))
        run.need(radius - abs(chord) / 2)
        # Seen from the start, the centre lies beside the chord: left of it on a short ccw or a long cw arc.
        aside = copysign(acos(min(1.0, abs(chord) / 2 / radius)), words["R"]) * (1 if block.motion == "G3" else -1)
        center = at + chord / abs(chord) * rect(radius, aside)
    else:
        center = at + complex(words.get(i, 0), words.get(j, 0))
        radius = abs(center - at)
        run.need_length(radius)
        _agree(abs(point - center), radius, run)
    return Element("arc", at, point, center, radius, _turn(block)), point


def _agree(one: float, other: float, run: Run) -> None:
    allowed = float(run.settings.radius_difference)
    run.is_near |= abs(abs(one - other) - allowed) < 1e-6
    if abs(one - other) > allowed:
        raise Refused("conflicting")


def _turn(block: Block) -> str:
    return "ccw" if block.motion == "G3" else "cw"


def crossing(one: Element, other: Element, q: int, run: Run) -> complex:
    """Where two consecutive curves meet; of two places the one that the sign of Q names."""
    if one.center is None and other.center is None:
        return meet((one.start, one.end - one.start), (other.start, other.end - other.start), run)
    if one.center is not None and other.center is not None:
        apart = other.center - one.center
        run.need_length(abs(apart))
        # Heron: twice the triangle's area over its base is how far the places are from the line of centres.
        a, b, d = one.radius, other.radius, abs(apart)
        slacks = a + b - d, d - abs(a - b)
        for slack in slacks:
            run.need(slack)
        area = sqrt(max(0.0, slacks[0] * slacks[1] * (a + b + d) * (d + abs(a - b)))) / 4
        foot = ((a - b) * (a + b) + d * d) / (2 * d)
        left, right = (one.center + apart / d * complex(foot, side * 2 * area / d) for side in (1, -1))
        if run.settings.circle_circle_q == "first-met-clockwise":
            # How far to turn clockwise from where the first arc begins.
            turns = {at: -phase((at - one.center) / (one.start - one.center)) % tau for at in (left, right)}
            for turn in turns.values():
                run.is_near |= min(turn, tau - turn) < 1e-6
            left, right = sorted(turns, key=lambda at: turns[at])
        elif run.settings.circle_circle_q == "right-is-negative":
            left, right = right, left
        return left if q < 0 else right
    line, circle = (one, other) if one.center is None else (other, one)
    assert circle.center is not None
    along = (line.end - line.start) / abs(line.end - line.start)
    off = cross(along, circle.center - line.start)
    run.need(circle.radius - abs(off))
    # From the centre: so far to the left of the travel, and so far along it.
    return circle.center + along * complex(q * sqrt(max(0.0, circle.radius**2 - off**2)), -off)


WORD = re.compile(r"(,?[A-Z])\s*([-+]?(?:\d+\.?\d*|\.\d+))")


def runs(program: Sequence[str], settings: Settings = DEFAULT) -> list[Run]:
    """Reads a program's text, and follows every maximal run of blocks that are worked out together."""
    plane, distance, motion, compensation = 17, 90, "G0", 40
    was = compensation
    blocks: list[Block] = []
    for line in program:
        words = {}
        for address, text in WORD.findall(line):
            number = Decimal(text)
            if address != "G":
                words[address] = number
            elif number in (17, 18, 19):
                plane = int(number)
            elif number in (90, 91):
                distance = int(number)
            elif number in (40, 41, 42):
                compensation = int(number)
            else:
                motion = f"G{number}"
        if words.keys() & {"X", "Y", "Z", "I", "J", "K", "R", ",A"}:
            blocks.append(Block(motion, words, distance == 91, compensation != 40, was != 40))
        was = compensation
    found = []
    at, k = 0j, 0
    while k < len(blocks):
        last = k
        while last + 1 < len(blocks) and (
            is_over_defined(plane, blocks[last + 1]) or blocks[last].words.keys() & {",C", ",R"}
        ):
            last += 1
        run = follow(plane, at, blocks[k : last + 1], settings)
        if last > k or ",A" in blocks[k].words:
            found.append(run)
        at, k = run.end, last + 1
    return found
