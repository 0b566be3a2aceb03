"""Closed forms of two contours for millions of rows, from the control sheets alone: no import of the package.

A place is a complex number (first axis real), mm, X of the lathe as radius; directions are unit complex numbers. Each
function returns places by name; the margin by which the contour exists, which is the least of all lengths that must not
be negative and of all that a root is taken of, as a share of the drawing's size, and NaN where nobody can judge it; and
the size, larger where lines are nearly parallel or touch, by which errors are measured.
"""

import numpy as np

JUDGED = 1e-7
"""1. Contours that exist, or do not, by less than this share of their size are not judged."""


def turned(degrees):
    return np.exp(1j * np.radians(degrees))


def corner(at, arriving, leaving, size):
    """A rounding: where it begins and ends, its centre, what it takes of each line, and its turn in radians."""
    turn = np.angle(leaving / arriving)
    back = size * np.tan(np.abs(turn) / 2)
    begin = at - back * arriving
    return begin, at + back * leaving, begin + 1j * np.sign(turn) * size * arriving, back, turn


def g111(A, K, B, X, P, Q):  # noqa: N803 - the words
    """Two lines from X40. Z0. by A, K, B and X, with roundings P and Q; the third line runs parallel to Z onwards."""
    with np.errstate(all="ignore"):
        start, first, second = 20j, turned(A), turned(B)
        one = K / first.real
        v1 = start + one * first
        two = (X / 2 - v1.imag) / second.imag
        v2 = v1 + two * second
        # Where line 2 does not advance along Z, the way is that of line 1 (Tables 2.35 and 2.36).
        third = np.sign(np.where(np.abs(second.real) > JUDGED, second.real, first.real)) + 0j
        begin1, end1, center1, back1, turn1 = corner(v1, first, second, P)
        begin2, end2, center2, back2, turn2 = corner(v2, second, third, Q)
        size = 1 + np.abs(v1) + np.abs(v2) + P + Q
        margin = np.minimum.reduce([one - back1, two - back1 - back2, one, two]) / size
        blunt = np.minimum(np.abs(np.sin(turn1)), np.where(Q > 0, np.abs(np.sin(turn2)), 1))
        blunt = np.minimum(np.where(P > 0, blunt, 1), np.minimum(np.abs(first.real), np.abs(second.imag)))
        margin = np.where((blunt < JUDGED) | (P < 0) | (Q < 0), np.nan, margin)
        weight = size / np.maximum(blunt, JUDGED)
    places = {"V1": v1, "V2": v2}
    for number, has, rounding in ((1, P > 0, (begin1, end1, center1)), (2, Q > 0, (begin2, end2, center2))):
        for name, place in zip(("begin", "end", "center"), rounding, strict=True):
            places[f"corner {number}.{name}"] = np.where(has, place, np.nan)
    return places, margin, weight


def circle_line(X, Y, R, A, Q):  # noqa: N803 - the words
    """From (50, 0) counter-clockwise on the circle of radius R through (X, Y), then on a line at the angle A to
    (-50, 42.857); Q chooses between the two places where they meet, negative the first along the line."""
    with np.errstate(all="ignore"):
        start, through, end, along = 50 + 0j, X + 1j * Y, -50 + 42.857j, turned(A)
        chord, radius = through - start, np.abs(R)
        half = np.abs(chord) / 2
        # A positive radius is that of the arc of less than half a circle.
        rise = np.sign(R) * np.sqrt(radius**2 - half**2)
        center = start + chord / 2 + 1j * chord / np.abs(chord) * rise
        foot = end + along * ((center - end) / along).real
        away = np.abs(foot - center)
        meeting = foot + np.where(Q < 0, -1, 1) * along * np.sqrt(radius**2 - away**2)
        size = 1 + radius + np.nan_to_num(np.abs(center)) + np.abs(end)
        last = ((end - meeting) / along).real
        roots = np.where(radius < half, radius - half, np.where(radius < away, radius - away, last))
        margin = roots / size
        thin = np.minimum((radius - half) / size, np.where(radius < half, 1, (radius - away) / size))
        is_odd = (np.abs(thin) < JUDGED) | (half < 1e-3) | (np.abs(meeting - start) < 1e-3) | (radius < 1e-3) | (Q == 0)
        margin = np.where(is_odd, np.nan, margin)
        weight = size / np.sqrt(np.maximum(thin, JUDGED))
    return {"C": center, "P1": meeting}, margin, weight
