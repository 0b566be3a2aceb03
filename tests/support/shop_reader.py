"""A small reader of whole programs, for lathes and mills, in four notations: the path as points, mm. It uses nothing of
the package. What it does not know moves nothing: a reference point, a cycle, an offset."""

import re
from math import atan2, ceil, cos, degrees, dist, hypot, pi, radians, sin, tan

import numpy as np

_WORD = re.compile(
    r"(?P<name>,[ACR]|#?[A-Z]{2,}(?==)|[A-Z])\s*=?\s*(?P<how>IC|AC)?\(?(?P<number>[-+]?(?:\d+\.?\d*|\.\d+))\)?"
)
_KLARTEXT = re.compile(r"\b(?P<name>[A-Z]+)(?P<number>[-+]?\d+\.?\d*)")
_OTHER = {28, 30, 53, 70, 71, 72, 73, 74, 75, 76, *range(81, 90), 92, 4, 10, 65, 68}
_CORNERS = {
    ",C": "leg",
    ",R": "round",
    "CHR": "leg",
    "CHF": "face",
    "RND": "round",
    "#CHR": "leg",
    "#RND": "round",
    "#CHF": "face",
}


class Reader:
    def __init__(self, control, kind):
        self.control, self.is_lathe = control, kind == "lathe"
        self.is_klartext = control == "heidenhain"
        self.place = {"X": 0.0, "Y": 0.0, "Z": 0.0}
        self.axes = ("Z", "X") if self.is_lathe else ("X", "Y")
        self.is_diameter = self.is_lathe and control != "isg"
        self.is_absolute, self.unit, self.motion, self.in_cycle = True, 1.0, 0, False
        self.pole = (0.0, 0.0)
        self.moves = []  # [kind, end or None for each axis of the plane, angle, corner, across, center or radius]

    def read(self, text):
        for line in text.splitlines():
            bare = re.sub(r"(?<!IC)(?<!AC)\([^)]*\)", " ", line)
            bare = re.sub(r";.*", "", bare).strip()
            (self._klartext if self.is_klartext else self._iso)(bare)
        return self._points()

    # Words

    def _iso(self, line):
        if re.match(r"%|O\d|[A-Z]{3,}\(|CYCLE", line):
            return
        words = [
            (w["name"], w["how"], float(w["number"]))
            for w in _WORD.finditer(re.sub(r"^/?\d?\s*N\d+", "", line.lstrip("/")))
        ]
        codes = {number for name, _, number in words if name == "G"}
        if "DIAMON" in line or (self.control == "isg" and 51 in codes):
            self.is_diameter = True
        if "DIAMOF" in line or (self.control == "isg" and 52 in codes and self.is_lathe):
            self.is_diameter = False
        if not (self.is_lathe and "siemens" not in self.control and self.control != "isg"):
            self.is_absolute = (self.is_absolute or 90 in codes) and 91 not in codes
        units = {20: 25.4, 21: 1.0, 70: 25.4, 700: 25.4, 71: 1.0, 710: 1.0}
        allowed = (70, 71, 700, 710) if self.control in ("isg", "siemens-840d") else (20, 21)
        self.unit = next((units[code] for code in codes if code in allowed), self.unit)
        planes = {17: ("X", "Y"), 18: ("Z", "X"), 19: ("Y", "Z")}
        self.axes = next((planes[code] for code in codes if code in planes), self.axes)
        other = _OTHER - ({70, 71} if self.control in ("isg", "siemens-840d") else set())
        if codes & {*range(81, 90), 73.0} and not self.is_lathe:
            self.in_cycle = True
        self.in_cycle = self.in_cycle and not codes & {80, 0, 1, 2, 3}
        if codes & other or self.in_cycle or re.search(r"\bSUPA\b", line):
            return
        self.motion = next((int(code) for code in codes if code in (0, 1, 2, 3)), self.motion)
        self._move([w for w in words if w[0] not in "GMNTSFDHP"])

    def _move(self, words):
        ends, corner, angle, center, radius = {}, None, None, {}, None
        for name, how, number in words:
            if name in _CORNERS:
                corner = (_CORNERS[name], number * self.unit)
            elif name in (",A", "ANG", "#ANG") or (name == "A" and self.is_lathe):
                angle = number
            elif name in "IJK":
                center["XYZ"["IJK".index(name)]] = (number * self.unit, how == "AC")
            elif name in ("R", "CR"):
                radius = number * self.unit
            elif name in "XYZUVW":
                axis = "XYZXYZ"["XYZUVW".index(name)]
                value = number * self.unit / (2 if axis == "X" and self.is_diameter else 1)
                step = name in "UVW" or how == "IC" or (not self.is_absolute and how != "AC")
                ends[axis] = self.place[axis] + value if step else value
        if not (ends or angle is not None or center):
            return
        one, two = self.axes
        start = self.place[one], self.place[two]
        shape = None
        if self.motion in (2, 3):
            if center:
                at = [center.get(axis, (0.0, False)) for axis in self.axes]
                shape = tuple(v if absolute else v + begin for (v, absolute), begin in zip(at, start, strict=True))
            else:
                shape = radius
        self._add(self.motion, {axis: ends.get(axis) for axis in "XYZ"}, angle, corner, shape)

    def _add(self, motion, ends, angle, corner, shape, sweep=None):
        plane = [ends[axis] for axis in self.axes]
        if angle is None:
            plane = [self.place[axis] if end is None else end for axis, end in zip(self.axes, plane, strict=True)]
        across = next(axis for axis in "XYZ" if axis not in self.axes)
        depth = self.place[across] if ends[across] is None else ends[across]
        before = self.place[across]
        self.moves.append([motion, plane, angle, corner, (across, before, depth), shape, self.axes, sweep])
        self.place[across] = depth
        # Where the tool is behind an angle is known once it is solved: at once, or with the next line.
        if angle is not None and None in plane and any(each is not None for each in plane):
            begin = [self.place[axis] for axis in self.axes]
            own = 0 if plane[0] is not None else 1
            way = plane[own] - begin[own]
            slope = tan(radians(angle))
            plane[1 - own] = begin[1 - own] + (way * slope if own == 0 else way / slope)
        for axis, end in zip(self.axes, plane, strict=True):
            self.place[axis] = end if end is not None else self.place[axis]

    def _klartext(self, line):
        line = re.sub(r"^/?\d+\s*/?\s*", "", line)
        head = line.split()[:1]
        if not head or head[0] in ("BEGIN", "END", "TOOL", "CYCL", "BLK", "CALL", "LBL"):
            return
        name = head[0]
        words = {w["name"]: float(w["number"]) * self.unit for w in _KLARTEXT.finditer(line)}
        if name in ("RND", "CHF"):
            size = float(re.search(r"[\d.]+", line)[0])
            self.moves[-1][3] = ("round" if name == "RND" else "leg", size)
        elif name == "CC":
            self.pole = words["X"], words["Y"]
        elif name in ("L", "C", "CR", "CP"):
            ends = {
                axis: self.place[axis] + words[f"I{axis}"] if f"I{axis}" in words else words.get(axis) for axis in "XYZ"
            }
            if name == "CP":
                angle, (one, two) = radians(words["IPA"]), self.pole
                off = complex(self.place["X"] - one, self.place["Y"] - two) * complex(cos(angle), sin(angle))
                ends["X"], ends["Y"] = one + off.real, two + off.imag
            if not any(end is not None for end in ends.values()):
                return
            turn = 3 if "DR+" in line else 2
            motion = turn if name != "L" else 0 if "FMAX" in line else 1
            self._add(
                motion,
                ends,
                None,
                None,
                {"C": self.pole, "CP": self.pole, "CR": words.get("R")}.get(name),
                words.get("IPA"),
            )

    # Path

    def _points(self):
        self._cross()
        path = [(0.0, 0.0, 0.0)]
        place = {"X": 0.0, "Y": 0.0, "Z": 0.0}
        cut = None  # where a corner has taken away the begin of the next line
        for number, (motion, plane, _, corner, (across, low, high), shape, axes, sweep) in enumerate(self.moves):
            begin = cut or (place[axes[0]], place[axes[1]])
            real = place[axes[0]], place[axes[1]]
            end, cut, round_ = tuple(plane), None, []
            if corner is not None:
                end, cut, round_ = _corner(real, tuple(plane), tuple(self.moves[number + 1][1]), corner)
            points = [end] if motion in (0, 1) else _arc(begin, end, shape, motion, sweep)
            for share, at in enumerate([*points, *round_], 1):
                rise = low + (high - low) * min(share / len(points), 1)
                row = {axes[0]: at[0], axes[1]: at[1], across: rise}
                path.append((row["X"], row["Y"], row["Z"]))
            place |= {axes[0]: plane[0], axes[1]: plane[1], across: high}
        return np.array(path)

    def _cross(self):
        """Lines with an angle alone end where the line behind them begins."""
        for number, move in enumerate(self.moves):
            if None not in move[1]:
                continue
            after = self.moves[number + 1]
            begin = self.moves[number - 1][1]
            one, other = radians(move[2]), radians(after[2])
            (z, x), (end_z, end_x) = begin, after[1]
            way = ((end_z - z) * sin(other) - (end_x - x) * cos(other)) / sin(other - one)
            move[1] = [z + way * cos(one), x + way * sin(one)]


def _corner(before, at, after, corner):
    kind, size = corner
    back, on = ((p[0] - at[0], p[1] - at[1]) for p in (before, after))
    back, on = ((v[0] / hypot(*v), v[1] / hypot(*v)) for v in (back, on))
    angle = abs(atan2(back[0] * on[1] - back[1] * on[0], back[0] * on[0] + back[1] * on[1]))
    leg = {"leg": size, "face": size / (2 * sin(angle / 2)), "round": size / tan(angle / 2)}[kind]
    first, last = ((at[0] + v[0] * leg, at[1] + v[1] * leg) for v in (back, on))
    if kind != "round":
        return first, last, [last]
    way = size / sin(angle / 2)
    middle = back[0] + on[0], back[1] + on[1]
    center = at[0] + middle[0] / hypot(*middle) * way, at[1] + middle[1] / hypot(*middle) * way
    turn = (first[0] - center[0]) * (last[1] - center[1]) - (first[1] - center[1]) * (last[0] - center[0])
    return first, last, _arc(first, last, center, 3 if turn > 0 else 2)


def _arc(begin, end, shape, motion, sweep=None):
    turn = 1 if motion == 3 else -1
    if isinstance(shape, float):
        half = dist(begin, end) / 2
        height = max(shape * shape - half * half, 0.0) ** 0.5 * (1 if shape > 0 else -1) * turn
        unit = (end[0] - begin[0]) / 2 / half, (end[1] - begin[1]) / 2 / half
        shape = (begin[0] + end[0]) / 2 - unit[1] * height, (begin[1] + end[1]) / 2 + unit[0] * height
    start, stop = (atan2(p[1] - shape[1], p[0] - shape[0]) for p in (begin, end))
    way = (stop - start) * turn % (2 * pi)
    way = 2 * pi if dist(begin, end) < 1e-6 else way
    way = radians(abs(sweep)) if sweep else way
    count, radius = max(1, ceil(degrees(way) / 2)), dist(begin, shape)
    angles = [start + turn * way * n / count for n in range(1, count)]
    return [*((shape[0] + radius * cos(a), shape[1] + radius * sin(a)) for a in angles), end]


def apart(one, other, count=3000):
    """The largest distance between two paths, at equal shares of their lengths; and by how much these differ."""
    found, lengths = [], []
    for path in (one, other):
        steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
        ways = np.concatenate([[0.0], np.cumsum(steps)])
        at = np.linspace(0, ways[-1], count)
        found.append(np.stack([np.interp(at, ways, path[:, n]) for n in range(3)]))
        lengths.append(ways[-1])
    return float(np.linalg.norm(found[0] - found[1], axis=0).max()), abs(lengths[0] - lengths[1])
