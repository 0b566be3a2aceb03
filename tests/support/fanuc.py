"""A small reader of the plain part of Fanuc programs, written from the operator's manual alone, to judge what we write.

Lathes are read in G-code system A: X and U are diameters, U and W increments. A number without a point counts in
thousandths of a millimetre, or ten-thousandths of an inch. An arc by R is the one of less than half a turn. What it
does not know, it refuses.
"""

import re
from collections.abc import Iterator
from math import hypot, sqrt

from interpreter import Motion

_WORD = re.compile(r"([A-Z])([+-]?(?:\d+\.?\d*|\.\d+))")
_PLANES = {17: ("X", "Y", "I", "J"), 18: ("Z", "X", "K", "I"), 19: ("Y", "Z", "J", "K")}
_PASSED = {20, 21, 40, 41, 42, 90, 91, *_PLANES}
_RADII_DIFFER = 0.02
"""mm; a usual value of the parameter."""


def read(program: str, *, is_lathe: bool) -> Iterator[Motion]:
    """The motions of a program, in its own units."""
    place = dict.fromkeys("XYZ", 0.0)
    plane, motion, least, is_incremental = (18 if is_lathe else 17), 0, 0.001, False
    for line in program.splitlines():
        code = re.sub(r"\([^()]*\)|\s", "", line)
        found = _WORD.findall(code)
        assert "".join(map("".join, found)) == code, f"not read: {line}"
        numbers = {int(number) for address, number in found if address == "G"}
        assert not is_lathe or not numbers & {17, 19, 90, 91}, f"no such code in system A: {line}"
        assert numbers <= _PASSED | {0, 1, 2, 3}, f"unknown code: {line}"
        assert len(numbers & {0, 1, 2, 3}) <= 1, f"two motions: {line}"
        motion = min(numbers & {0, 1, 2, 3}, default=motion)
        plane = min(numbers & _PLANES.keys(), default=plane)
        least = 0.0001 if 20 in numbers else 0.001 if 21 in numbers else least
        is_incremental = 91 in numbers or (is_incremental and 90 not in numbers)
        names = [address for address, _ in found if address in "XYZUWIJKR"]
        assert len(set(names)) == len(names), f"a word twice: {line}"
        if not names:
            continue
        words = {name: float(text) * (1 if "." in text else least) for name, text in found if name in names}
        first, second, *centers = _PLANES[plane]
        start, before = complex(place[first], place[second]), dict(place)
        for name, value in words.items():
            if name in "XYZUW":
                assert is_lathe or name in "XYZ", f"no such axis: {line}"
                axis = {"U": "X", "W": "Z"}.get(name, name)
                own = value / 2 if is_lathe and axis == "X" else value
                place[axis] = own + (before[axis] if is_incremental or name in "UW" else 0.0)
        end = complex(place[first], place[second])
        if motion in (0, 1):
            assert not words.keys() & set("IJKR"), f"a centre in a line: {line}"
            if place != before:
                yield Motion("line" if motion else "traverse", start, end, None)
            continue
        sign = -1 if motion == 2 else 1
        if "R" in words:
            half = abs(end - start) / 2
            assert 0 < half <= words["R"], f"R does not reach: {line}"
            height = sqrt(words["R"] ** 2 - half**2)
            center = (start + end) / 2 + 1j * sign * height * (end - start) / (2 * half)
        else:
            assert words.keys() & {*centers}, f"an arc without a centre: {line}"
            assert not words.keys() & (set("IJK") - {*centers}), f"a centre outside the plane: {line}"
            center = start + complex(*(words.get(name, 0.0) for name in centers))
            radii = hypot((start - center).real, (start - center).imag), abs(end - center)
            assert abs(radii[0] - radii[1]) < _RADII_DIFFER * least / 0.001, f"the radii differ: {line}"
        yield Motion("cw" if motion == 2 else "ccw", start, end, center)
