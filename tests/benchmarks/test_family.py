"""A million contours beside hand-written NumPy that computes the same results and flags, in the same run."""

import sys
from time import perf_counter, process_time

import numpy as np

from contoursolve.families import REASONS, family
from contoursolve.solving import RefusalKind

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
A, P = np.linspace(150, 210, 1000), np.linspace(0.1, 30, 1000)
CHUNK = 8_192
LENGTH, RESIDUAL, REGULAR = 1e-9, 1e-9, 1e-12
CODE = {kind: REASONS.index(kind) for kind in RefusalKind}


def by_hand() -> dict[str, np.ndarray]:
    """G111 by A, K, B, X with two roundings, in chunks: points, corners, room, residual, status, reason."""
    rows = A.size * P.size
    names = [f"{name}.{axis}" for name in ("V1", "V2") for axis in "ZX"]
    names += [f"corner {n}.{place}.{axis}" for n in (1, 2) for place in ("begin", "end", "center") for axis in "ZX"]
    table = {name: np.empty(rows) for name in (*names, "line 1.room", "line 2.room", "residual")}
    table |= {name: np.empty(rows, np.uint8) for name in ("status", "reason")}
    ca_of, sa_of = np.cos(np.radians(A)), np.sin(np.radians(A))
    cb, sb = np.cos(np.radians(120)), np.sin(np.radians(120))
    k, x, q = -30.0, 30.0, 5.0
    for first in range(0, rows, CHUNK):
        part = slice(first, min(first + CHUNK, rows))
        at = np.arange(part.start, part.stop)
        i, p = at // P.size, P[at % P.size]
        ca, sa = ca_of[i], sa_of[i]
        reason = np.zeros(at.size, np.uint8)

        def refuse(mask, kind, reason=reason):
            if mask.any():
                reason[mask & (reason == 0)] = CODE[kind]

        refuse(~(np.abs(ca) > REGULAR), RefusalKind.LINES_PARALLEL)
        refuse(np.broadcast_to(~(np.abs(sb) > REGULAR), at.shape), RefusalKind.LINES_PARALLEL)
        v1z, v1x = np.full(at.size, k), k * sa / ca
        v2x = np.full(at.size, x)
        v2z = v1z + (v2x - v1x) * cb / sb
        dz, dx = v2z - v1z, v2x - v1x
        wrong = np.zeros(at.size, bool)
        worst = np.zeros(at.size)
        for residual in (v1z - k, v1z * sa - v1x * ca, v2x - x, dz * sb - dx * cb):
            size = np.abs(residual)
            wrong |= ~(size <= RESIDUAL)
            worst = np.maximum(worst, size)
        refuse(wrong, RefusalKind.NOT_VERIFIED)
        lengths = v1z * ca + v1x * sa, dz * cb + dx * sb
        for length in lengths:
            refuse(~(length >= -LENGTH), RefusalKind.LINE_REVERSED)
        rooms = list(lengths)
        shapes, checks = [], []
        along = np.sign(cb)
        for n, (z, y, u, v, size) in enumerate(
            (
                (v1z, v1x, (ca, sa), (cb, sb), p),
                (v2z, v2x, (cb, sb), (along, 0.0), q),
            )
        ):
            turn, cosine = u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]
            less, more = np.hypot(u[0] - v[0], u[1] - v[1]), np.hypot(u[0] + v[0], u[1] + v[1])
            back = size * less / more
            side = np.sign(turn) * size
            bz, bx, ez, ex = -back * u[0], -back * u[1], back * v[0], back * v[1]
            cz, cx = bz - side * u[1], bx + side * u[0]
            shapes.append((z + bz, y + bx, z + ez, y + ex, z + cz, y + cx))
            refuse(lengths[n] <= LENGTH, RefusalKind.CORNER_TOO_LARGE)
            if n == 0:
                refuse(lengths[1] <= LENGTH, RefusalKind.CORNER_TOO_LARGE)
            straight = np.broadcast_to(np.abs(turn) <= REGULAR, at.shape)
            refuse(straight & np.broadcast_to(cosine > 0, at.shape), RefusalKind.CORNER_STRAIGHT)
            refuse(straight, RefusalKind.CORNER_REVERSES)
            rooms[n] = rooms[n] - back
            if n == 0:
                rooms[1] = rooms[1] - back
            checks.append((n, np.broadcast_to(back, at.shape)))
            sbz, sbx, sez, sex = bz - cz, bx - cx, ez - cz, ex - cx
            misfits = (
                bz * u[1] - bx * u[0],
                ez * v[1] - ex * v[0],
                np.hypot(sbz, sbx) - size,
                np.hypot(sez, sex) - size,
                sbz * u[0] + sbx * u[1],
                sez * v[0] + sex * v[1],
            )
            for misfit in misfits:
                worst = np.maximum(worst, np.abs(misfit))
        for n, back in checks:
            for element in (0, 1) if n == 0 else (1,):
                fits = (back >= -LENGTH) & (back <= lengths[element] + LENGTH)
                refuse(~fits, RefusalKind.CORNER_TOO_LARGE)
        for room in rooms:
            refuse(room < -LENGTH, RefusalKind.CORNERS_OVERLAP)
        refuse(~(worst <= RESIDUAL), RefusalKind.NOT_VERIFIED)
        is_path = reason == 0
        values = (v1z, v1x + 20, v2z, v2x + 20)
        values += tuple(value + 20 * (n % 2) for shape in shapes for n, value in enumerate(shape))
        for name, value in zip(names, values, strict=True):
            table[name][part] = np.where(is_path, value, np.nan)
        table["line 1.room"][part], table["line 2.room"][part] = rooms
        table["residual"][part] = worst
        table["status"][part] = np.where(is_path, 0, 6)
        table["reason"][part] = reason
    return table


def seconds(function, clock, repeats=5):
    """The least of some runs, by a clock."""
    best, found = np.inf, None
    for _ in range(repeats):
        begin = clock()
        found = function()
        best = min(best, clock() - begin)
    return best, found


def ours(workers):
    return family(BLOCK, start=START, vary={"A": A, "P": P}, workers=workers)


def test_a_million_contours_take_at_most_1_2_times_what_numpy_by_hand_takes(capsys):
    ours(1)
    # Processor time, which others at work on the machine do not change.
    hand, expected = seconds(by_hand, process_time)
    one, found = seconds(lambda: ours(1), process_time)
    with capsys.disabled():
        sys.stdout.write(f"\nNumPy by hand {hand:.3f} s, a family {one / hand:.2f} of it\n")
    assert np.array_equal(expected["status"], found["status"].ravel())
    assert np.array_equal(expected["reason"], found["reason"].ravel())
    for name in found.columns:
        if name not in ("residual", "status", "reason"):
            assert np.allclose(expected[name], found[name].ravel(), rtol=1e-12, atol=1e-11, equal_nan=True), name
    assert one <= 1.2 * hand


def test_two_threads_take_at_most_0_65_times_what_numpy_by_hand_takes(capsys):
    """By the clock on the wall: it needs two idle cores."""
    ours(2)
    hand, _ = seconds(by_hand, perf_counter)
    two, _ = seconds(lambda: ours(2), perf_counter)
    with capsys.disabled():
        sys.stdout.write(f"\nNumPy by hand {hand:.3f} s, a family on two threads {two / hand:.2f} of it\n")
    assert two <= 0.65 * hand
