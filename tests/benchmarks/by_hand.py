"""NumPy written by hand, in chunks, for two families: the same points, corners, rooms, residuals, statuses, reasons.

It is what a user would write who knows the formulas of these blocks, and every check that contoursolve makes of them.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from contoursolve.solving import REASONS, RefusalKind as Kind

CHUNK = 8_192
LENGTH, RESIDUAL, REGULAR, TOUCHING = 1e-9, 1e-9, 1e-12, 16 * 2.0**-52
CODE = {kind: REASONS.index(kind) for kind in Kind}
SIDE = 1_000

Table = dict[str, np.ndarray]


class Reasons:
    """The first reason against each row of a chunk."""

    def __init__(self, rows: int) -> None:
        self.codes = np.zeros(rows, np.uint8)

    def refuse(self, mask: Any, kind: Kind) -> None:
        if np.any(mask):
            self.codes[mask & (self.codes == 0)] = CODE[kind]


@dataclass(frozen=True)
class Case:
    """A block with two words that vary, and the same by hand."""

    block: str
    options: dict[str, str]
    vary: dict[str, np.ndarray]
    by_hand: Callable[[], Table]


def chunks(rows: int) -> list[slice]:
    return [slice(first, min(first + CHUNK, rows)) for first in range(0, rows, CHUNK)]


def empty(names: list[str], rows: int) -> Table:
    table = {name: np.empty(rows) for name in names}
    return table | {name: np.empty(rows, np.uint8) for name in ("status", "reason")}


A, P = np.linspace(150, 210, SIDE), np.linspace(0.1, 30, SIDE)


def skeleton(ca: Any, sa: Any, cb: float, sb: float, reasons: Reasons) -> Any:
    """G111 by A, K, B, X: both intersections, lengths of both lines, the largest residual."""
    k, x = -30.0, 30.0
    reasons.refuse(~(np.abs(ca) > REGULAR), Kind.LINES_PARALLEL)
    reasons.refuse(np.broadcast_to(~(np.abs(sb) > REGULAR), ca.shape), Kind.LINES_PARALLEL)
    v1z, v1x = np.full(ca.size, k), k * sa / ca
    v2x = np.full(ca.size, x)
    v2z = v1z + (v2x - v1x) * cb / sb
    dz, dx = v2z - v1z, v2x - v1x
    worst = np.zeros(ca.size)
    for residual in (v1z - k, v1z * sa - v1x * ca, v2x - x, dz * sb - dx * cb):
        worst = np.maximum(worst, np.abs(residual))
    reasons.refuse(~(worst <= RESIDUAL), Kind.NOT_VERIFIED)
    lengths = v1z * ca + v1x * sa, dz * cb + dx * sb
    for length in lengths:
        reasons.refuse(~(length >= -LENGTH), Kind.LINE_REVERSED)
    return (v1z, v1x), (v2z, v2x), lengths, worst


def finish(table: Table, part: slice, reasons: Reasons, points: list[Any], rooms: dict[str, Any], worst: Any) -> None:
    """Write a chunk of the result."""
    is_path = reasons.codes == 0
    for name, value in points:
        table[name][part] = np.where(is_path, value, np.nan)
    for name, room in rooms.items():
        table[name][part] = room
    table["residual"][part] = worst
    table["status"][part] = np.where(is_path, 0, 6)
    table["reason"][part] = reasons.codes


def check_lengths(n: int, lengths: Any, reasons: Reasons) -> None:
    reasons.refuse(lengths[n] <= LENGTH, Kind.CORNER_TOO_LARGE)
    if n == 0:
        reasons.refuse(lengths[1] <= LENGTH, Kind.CORNER_TOO_LARGE)


def check_turn(turn: Any, cosine: Any, reasons: Reasons, shape: Any) -> None:
    straight = np.broadcast_to(np.abs(turn) <= REGULAR, shape)
    if straight.any():
        reasons.refuse(straight & np.broadcast_to(cosine > 0, shape), Kind.CORNER_STRAIGHT)
        reasons.refuse(straight, Kind.CORNER_REVERSES)


def check_room(backs: Any, lengths: Any, reasons: Reasons) -> Any:
    """Each corner on its elements, then what is left of each; `backs` are (element, setback) by corner."""
    rooms = list(lengths)
    for corner in backs:
        for element, back in corner:
            reasons.refuse(~((back >= -LENGTH) & (back <= lengths[element] + LENGTH)), Kind.CORNER_TOO_LARGE)
            rooms[element] = rooms[element] - back
    for room in rooms:
        reasons.refuse(room < -LENGTH, Kind.CORNERS_OVERLAP)
    return rooms


def roundings() -> Table:
    """G111 by A, K, B, X with P and Q."""
    rows, q = A.size * P.size, 5.0
    places = ("begin", "end", "center")
    names = [f"{name} {axis}" for name in ("V1", "V2") for axis in "ZX"]
    names += [f"corner {n}.{place} {axis}" for n in (1, 2) for place in places for axis in "ZX"]
    table = empty([*names, "line 1.room", "line 2.room", "residual"], rows)
    ca_of, sa_of = np.cos(np.radians(A)), np.sin(np.radians(A))
    cb, sb = np.cos(np.radians(120)), np.sin(np.radians(120))
    for part in chunks(rows):
        at = np.arange(part.start, part.stop)
        ca, sa, p = ca_of[at // P.size], sa_of[at // P.size], P[at % P.size]
        reasons = Reasons(at.size)
        (v1z, v1x), (v2z, v2x), lengths, worst = skeleton(ca, sa, cb, sb, reasons)
        points = [("V1 Z", v1z), ("V1 X", 2 * (v1x + 20)), ("V2 Z", v2z), ("V2 X", 2 * (v2x + 20))]
        backs, along = [], np.sign(cb)
        corners = ((v1z, v1x, (ca, sa), (cb, sb), p), (v2z, v2x, (cb, sb), (along, 0.0), q))
        for n, (z, y, u, v, size) in enumerate(corners):
            turn, cosine = u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]
            back = size * np.hypot(u[0] - v[0], u[1] - v[1]) / np.hypot(u[0] + v[0], u[1] + v[1])
            side = np.sign(turn) * size
            bz, bx, ez, ex = -back * u[0], -back * u[1], back * v[0], back * v[1]
            cz, cx = bz - side * u[1], bx + side * u[0]
            shape = zip(places, ((z + bz, y + bx), (z + ez, y + ex), (z + cz, y + cx)), strict=True)
            for place, pair in shape:
                points += [(f"corner {n + 1}.{place} Z", pair[0]), (f"corner {n + 1}.{place} X", 2 * (pair[1] + 20))]
            check_lengths(n, lengths, reasons)
            check_turn(turn, cosine, reasons, at.shape)
            backs.append([(element, np.broadcast_to(back, at.shape)) for element in ((0, 1) if n == 0 else (1,))])
            sbz, sbx, sez, sex = bz - cz, bx - cx, ez - cz, ex - cx
            for misfit in (
                bz * u[1] - bx * u[0],
                ez * v[1] - ex * v[0],
                np.hypot(sbz, sbx) - size,
                np.hypot(sez, sex) - size,
                sbz * u[0] + sbx * u[1],
                sez * v[0] + sex * v[1],
            ):
                worst = np.maximum(worst, np.abs(misfit))
        rooms = check_room(backs, lengths, reasons)
        reasons.refuse(~(worst <= RESIDUAL), Kind.NOT_VERIFIED)
        finish(table, part, reasons, points, {"line 1.room": rooms[0], "line 2.room": rooms[1]}, worst)
    return table


COMMA_A, R = np.linspace(150, 200, SIDE), np.linspace(45, 80, SIDE)


def circle_line() -> Table:
    """NCT: an arc from the start through (-50, 0) by its radius, then a line through (-50, 42.857) by its angle."""
    rows = COMMA_A.size * R.size
    names = [f"{name} {axis}" for name in ("C", "N1", "P1", "N2") for axis in "XY"]
    table = empty([*names, "r", "arc.room", "line.room", "residual"], rows)
    table["branch.P1"] = np.empty(rows, np.int8)
    ca_of, sa_of = np.cos(np.radians(COMMA_A)), np.sin(np.radians(COMMA_A))
    n1x, n1y, n2x, n2y = -100.0, 0.0, -100.0, 42.857
    chord = np.hypot(n1x, n1y)
    for part in chunks(rows):
        at = np.arange(part.start, part.stop)
        ca, sa, r = ca_of[at // R.size], sa_of[at // R.size], R[at % R.size]
        reasons = Reasons(at.size)
        half = chord / 2
        with np.errstate(invalid="ignore"):
            touches = np.abs(half - r) <= TOUCHING * (2 * r + chord)
            reasons.refuse(~(touches | (half < r)), Kind.RADIUS_TOO_SMALL)
            rise = np.where(touches, 0.0, np.sqrt((r - half) * (r + half))) / chord
            cx, cy = n1x / 2 - rise * n1y, n1y / 2 + rise * n1x
            offset = -(n2x - cx) * sa + (n2y - cy) * ca
            size = np.abs(offset)
            doubtful = np.abs(size - r) <= TOUCHING * (r + np.abs(cx) + np.abs(cy) + abs(n2x) + abs(n2y))
            reasons.refuse(~(doubtful | (size < r)), Kind.CIRCLE_MISSED)
            root = np.where(doubtful, 0.0, np.sqrt((r - offset) * (r + offset)))
            px, py = cx - sa * offset - ca * root, cy + ca * offset - sa * root
            sx, sy = px - cx, py - cy
            worst = np.zeros(at.size)
            for residual in (
                (n2x - px) * sa - (n2y - py) * ca,
                (cx * cx + cy * cy - r * r) / (2 * r),
                (sx * sx + sy * sy - r * r) / (2 * r),
                ((n1x - cx) ** 2 + (n1y - cy) ** 2 - r * r) / (2 * r),
            ):
                worst = np.maximum(worst, np.abs(residual))
            reasons.refuse(~(worst <= RESIDUAL), Kind.NOT_VERIFIED)
            reasons.refuse(np.hypot(px, py) <= LENGTH, Kind.ARC_EMPTY)
            line = (n2x - px) * ca + (n2y - py) * sa
            reasons.refuse(~(line >= -LENGTH), Kind.LINE_REVERSED)
            swept = np.arctan2(-cx * sy + cy * sx, -cx * sx - cy * sy)
            arc = r * np.where(swept > 0, swept, swept + 2 * np.pi)
        points = [("C X", cx + 50), ("C Y", cy), ("N1 X", n1x + 50), ("N1 Y", n1y)]
        points += [("P1 X", px + 50), ("P1 Y", py), ("N2 X", n2x + 50), ("N2 Y", n2y), ("r", r)]
        finish(table, part, reasons, points, {"arc.room": arc, "line.room": line}, worst)
        table["branch.P1"][part] = np.where(reasons.codes == 0, -1, 0)
    return table


LATHE = {"start": "X40. Z0."}
CASES = {
    "G111 with two roundings": Case("G111 X100. A180. K-30. B120. P5. Q5.", LATHE, {"A": A, "P": P}, roundings),
    "NCT circle and line": Case(
        "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1", {}, {",A": COMMA_A, "R": R}, circle_line
    ),
}
