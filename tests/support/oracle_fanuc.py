"""Fanuc and Haas programs of lines and arcs in a row, run from the control sheets alone: plain math, no package.

Of a program come the contours that the control works out, each with the line where it begins, up to the first one that
it refuses. Places are complex numbers, as in `oracle`; X of a lathe is halved on the way in.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import radians, sin, sqrt
from typing import NamedTuple

from oracle import PLANES, Element, Outcome, _RefusedError as Refused, cross, dot, heading, sign
from oracle_corners import Corner, ahead, connect

_WORD = re.compile(r"(,?[A-Z])([+-]?\d*\.?\d+|[+-]?\d+\.)")
_INCH = 25.4
_CORNERS = (",C", ",R")
_DOUBT = 1e-6
"""Of a sine: this close to a limit nobody judges."""


class Machine(NamedTuple):
    """Which control, and its settings."""

    is_lathe: bool
    angle: str = ",A"
    meets: bool = True
    """Whether two lines meet by their angles."""
    arcs: bool = True
    """Whether corners stand beside arcs."""
    sense: str = "line"
    guard: float = 1.0
    strict: bool = False
    signed: str = ""
    """The words of a corner between two axes; their sign tells which way the next line runs."""
    beside: str = ""
    """The axes that turn: they leave the path in the plane as it is."""
    radius_wins: bool = False
    """Whether an arc with both a centre and R is made by R."""


class Run(NamedTuple):
    """A contour, and the line of the program where it begins."""

    line: int
    elements: tuple[Element, ...]


class Answer(NamedTuple):
    """The contours up to the first one that is refused: the line where that begins, 0 if none is."""

    runs: tuple[Run, ...]
    refused: int
    is_near: bool


@dataclass
class _Block:
    line: int
    motion: int
    words: dict[str, float]
    fault: str = ""
    element: Element | None = None
    is_open: bool = False
    corner: Corner | None = None
    axes: frozenset[str] = frozenset()
    sign: float | None = None


@dataclass
class _Walk:
    machine: Machine
    at: complex = 0j
    plane: int = 18
    motion: int = 0
    scale: float = 1.0
    is_incremental: bool = False
    blocks: list[_Block] = field(default_factory=list)
    is_near: bool = False


def run(program: Sequence[str], machine: Machine) -> Answer:
    """The contours of a program whose first line is its position."""
    walk = _Walk(machine, plane=18 if machine.is_lathe else 17)
    for line, text in enumerate(program, 1):
        _take(walk, line, text)
    found, index = list[Run](), 0
    while index < len(walk.blocks):
        end = index
        while end + 1 < len(walk.blocks) and _is_tied(walk.blocks[end]):
            end += 1
        chain = walk.blocks[index : end + 1]
        if len(chain) == 1 and not _is_alone(chain[0], machine):
            walk.is_near |= chain[0].fault == "twice"  # where it ends, nobody says
            index = end + 1
            continue
        outcome = Outcome()
        try:
            _examine(chain, machine, outcome)
        except Refused:
            return Answer(tuple(found), chain[0].line, walk.is_near or outcome.is_near)
        walk.is_near |= outcome.is_near
        if outcome.elements:
            found.append(Run(chain[0].line, tuple(outcome.elements)))
        index = end + 1
    return Answer(tuple(found), 0, walk.is_near)


def whole(program: Sequence[str], machine: Machine) -> tuple[Element, ...]:
    """All that a program cuts, also its lines and arcs beside contours; nothing where one is refused or in doubt."""
    answer = run(program, machine)
    if answer.refused or answer.is_near:
        return ()
    walk = _Walk(machine, plane=18 if machine.is_lathe else 17)
    for line, text in enumerate(program, 1):
        _take(walk, line, text)
    outcome = Outcome()
    connect(
        [block.element for block in walk.blocks if block.element],
        {k: block.corner for k, block in enumerate(walk.blocks) if block.corner},
        outcome,
    )
    return tuple(outcome.elements)


def _is_tied(block: _Block) -> bool:
    return block.corner is not None or block.is_open


def _is_alone(block: _Block, machine: Machine) -> bool:
    return _is_tied(block) or machine.angle in block.words


def _take(walk: _Walk, line: int, text: str) -> None:
    words: dict[str, float] = {}
    fault = ""
    if re.match(r"(N\d+ )?G0?4\b", text):
        return  # a dwell
    for address, number in _WORD.findall(text):
        if address == "G":
            code = int(number)
            walk.motion = code if code in (0, 1, 2, 3) else walk.motion
            walk.plane = code if code in PLANES else walk.plane
            walk.scale = {20: _INCH, 21: 1.0}.get(code, walk.scale)
            walk.is_incremental = {90: False, 91: True}.get(code, walk.is_incremental)
        elif address not in "NFSTMDH":
            fault = "twice" if address in words else fault
            words[address] = float(number) * (1.0 if address in (",A", "A") else walk.scale)
    if not words:
        walk.is_near |= bool(walk.blocks and _is_tied(walk.blocks[-1]))  # a block that says nothing behind a corner
        return
    block = _Block(line, walk.motion, words, fault)
    if walk.motion == 0:
        walk.at = _end(walk, block)
        return
    corners = [address for address in _CORNERS if address in words]
    if corners:
        block.corner = Corner(corners[0][1], words[corners[0]])
        if len(corners) > 1 or words[corners[0]] < 0:
            block.fault = "corner"
    signed = [address for address in walk.machine.signed if address in words] if walk.motion == 1 else []
    signed = [address for address in signed if address == "R" or address in PLANES[walk.plane][2:]]
    if signed:
        value = words[signed[0]]
        block.corner, block.sign = Corner("R" if signed[0] == "R" else "C", abs(value)), value
        block.fault = block.fault or ("signed" if len(signed) + len(corners) > 1 else "")
    before = walk.blocks[-1] if walk.blocks else None
    (_line if walk.motion == 1 else _arc)(walk, block, before if before and before.is_open else None)
    walk.blocks.append(block)


def _names(walk: _Walk) -> dict[str, tuple[str, bool]]:
    """The axis of each address, `1` or `2`, and whether it is an increment."""
    first, second = PLANES[walk.plane][:2]
    if walk.machine.is_lathe:
        return {"Z": ("1", False), "W": ("1", True), "X": ("2", False), "U": ("2", True)}
    return {first: ("1", walk.is_incremental), second: ("2", walk.is_incremental)}


def _stated(walk: _Walk, block: _Block) -> dict[str, tuple[float, bool]]:
    stated: dict[str, tuple[float, bool]] = {}
    for address, (axis, is_step) in _names(walk).items():
        if address in block.words:
            half = 2 if walk.machine.is_lathe and axis == "2" else 1
            block.fault = "twice" if axis in stated else block.fault
            stated[axis] = block.words[address] / half, is_step
    return stated


def _end(walk: _Walk, block: _Block) -> complex:
    """Where its words say that a block ends; a coordinate that it does not have stays as it is."""
    stated = _stated(walk, block)
    values = []
    for axis, here in (("1", walk.at.real), ("2", walk.at.imag)):
        value, is_step = stated.get(axis, (here, False))
        values.append(here + value if is_step else value)
    return complex(*values)


def _line(walk: _Walk, block: _Block, before: _Block | None) -> None:
    machine, words = walk.machine, block.words
    signed = {"R", *PLANES[walk.plane][2:]} & {*machine.signed}
    allowed = {*_names(walk), *_CORNERS, *signed, *machine.beside, *([machine.angle] if machine.is_lathe else [])}
    block.fault = block.fault or ("stray" if words.keys() - allowed else "")
    stated, start = _stated(walk, block), walk.at
    block.axes = frozenset(stated) | ({"angle"} if machine.angle in words else set())
    if block.sign is not None:
        # The letter of a chamfer is that of the axis of the next line.
        own = [address for address in PLANES[walk.plane][2:] if address in words]
        letters = {PLANES[walk.plane][2]: "2", PLANES[walk.plane][3]: "1"}
        is_right = block.axes in ({"1"}, {"2"}) and all(letters[each] in block.axes for each in own)
        block.fault = block.fault or ("" if is_right else "taper or letter")
    along = heading(words[machine.angle]) if machine.angle in words and machine.is_lathe else None
    if before is not None:
        _close(walk, block, before, along, stated)
        return
    if along is not None and not stated:
        block.is_open = True
        block.fault = block.fault or ("" if machine.meets else "open")
        block.element = Element("line", start, start + along)
        return
    end = _end(walk, block)
    if along is not None and len(stated) == 1:
        (axis,) = stated
        share, step = (along.real, end.real - start.real) if axis == "1" else (along.imag, end.imag - start.imag)
        slack = abs(share) - sin(radians(machine.guard))
        walk.is_near |= abs(slack) < _DOUBT
        if slack <= 0 or share == 0:
            block.fault = block.fault or "57"
        else:
            end = start + step / share * along
        _check_way(walk, block, along, end - start)
    elif along is not None:
        off = abs(cross(along, end - start))
        walk.is_near |= 1e-9 < off < 0.01 * abs(end - start)  # how closely they must agree is a choice
        block.fault = block.fault or ("conflict" if off > 1e-9 else "strict" if machine.strict else "")
        _check_way(walk, block, along, end - start)
    block.element = Element("line", start, end)
    walk.at = end


def _check_way(walk: _Walk, block: _Block, along: complex, travel: complex) -> None:
    if walk.machine.sense == "ray" and dot(along, travel) < 0:
        block.fault = block.fault or "ray"


def _close(
    walk: _Walk, block: _Block, before: _Block, along: complex | None, stated: dict[str, tuple[float, bool]]
) -> None:
    start, other = before.element.start, before.element.end - before.element.start
    if along is None or len(stated) < 2 or any(is_step for _, is_step in stated.values()):
        block.fault = block.fault or "56"
        block.element = Element("line", start, start + 1)
        return
    end = complex(stated["1"][0], stated["2"][0])
    slack = abs(cross(other, along)) - sin(radians(walk.machine.guard))
    walk.is_near |= abs(slack) < _DOUBT
    if slack <= 0 or cross(other, along) == 0:
        block.fault = block.fault or "58"
        block.element = Element("line", start, end)
        return
    vertex = start + other * cross(end - start, along) / cross(other, along)
    _check_way(walk, before, other, vertex - start)
    _check_way(walk, block, along, end - vertex)
    before.element = Element("line", start, vertex)
    block.element = Element("line", vertex, end)
    walk.at = end


def _arc(walk: _Walk, block: _Block, before: _Block | None) -> None:
    words, start = block.words, walk.at
    is_by_radius = walk.machine.radius_wins and "R" in words
    centers = [address for address in PLANES[walk.plane][2:] if address in words and not is_by_radius]
    allowed = {*_names(walk), *_CORNERS, *PLANES[walk.plane][2:], "R", *walk.machine.beside}
    walk.is_near |= bool(words.keys() & ({"I", "J", "K"} - allowed))  # outside the plane, it means nothing
    if before is not None or words.keys() - allowed - {"I", "J", "K"} or not walk.machine.arcs:
        block.fault = block.fault or "arc"
    stated, end, turn = _stated(walk, block), _end(walk, block), {2: "cw", 3: "ccw"}[walk.motion]
    walk.at = end
    block.element = Element("arc", start, end, start, 1.0, turn)
    if bool(centers) == ("R" in words):
        block.fault = block.fault or "centre and radius"
        return
    if centers:
        center = start + complex(*(words.get(address, 0.0) for address in PLANES[walk.plane][2:]))
        off = abs(abs(start - center) - abs(end - center))
        walk.is_near |= 1e-9 < off < 0.1 or abs(start - center) < 1e-3
        block.fault = block.fault or ("radii" if off >= 0.1 else "")
        radius = abs(start - center)
    else:
        half, radius = abs(end - start) / 2, abs(words["R"])
        walk.is_near |= abs(half - radius) < 0.1 or half < 1e-3
        if not stated or half > radius or half == 0:
            block.fault = block.fault or "radius"
            return
        side = sign(words["R"]) * (1 if turn == "ccw" else -1)
        center = (start + end) / 2 + 1j * side * sqrt(radius**2 - half**2) * (end - start) / (2 * half)
    block.element = Element("arc", start, end, center, radius, turn)


def _examine(chain: Sequence[_Block], machine: Machine, outcome: Outcome) -> None:
    path = [block.element for block in chain if block.element]
    dropped = set[int]()
    for before, after in pairwise(chain):
        if before.sign is not None and after.element is not None and not (before.fault or after.fault):
            step = after.element.end - after.element.start
            along = step.real if after.axes == {"1"} else step.imag
            if after.motion != 1 or after.axes not in ({"1"}, {"2"}) or after.axes == before.axes:
                raise Refused("not square")
            if before.sign * along < 0:
                raise Refused("sign")
    if any(block.fault for block in chain) or _is_tied(chain[-1]):
        raise Refused("refused")
    for number, (before, after, block) in enumerate(zip(path, path[1:], chain, strict=False)):
        if block.corner and block.corner.amount:
            outcome.need_length(min(_reach(before), _reach(after)))
            u, v = ahead(before, before.end), ahead(after, after.start)
            slack = abs(cross(u, v)) - sin(radians(machine.guard))
            # Where a line goes back along itself, the sheets say nothing.
            outcome.is_near |= abs(slack) < _DOUBT or (slack < 0 and dot(u, v) < 0)
            if slack <= 0 and not machine.guard:
                raise Refused("straight")
            if slack <= 0:
                dropped.add(number)
    connect(path, {k: each.corner for k, each in enumerate(chain) if each.corner and k not in dropped}, outcome)


def _reach(element: Element) -> float:
    """An arc that ends where it begins is a full circle."""
    return abs(element.end - element.start) or (element.radius if element.center is not None else 0.0)
