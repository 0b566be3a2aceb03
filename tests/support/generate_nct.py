"""NCT programs written from paths that were drawn first: every number of a block is measured on the drawing.

No import of the package. Elements are 5 to 100 mm long and turn by 15 to 150 degrees where they meet, corners take
less than half of an element; so 12 decimals keep every point within 1e-9 mm of the drawing. Same generator, same bytes.

Assumed in what is written (see `oracle_nct`): the side that Q names between circles, a negative R of an
over-defined circle, an incremental coordinate beside ,A.
"""

from cmath import phase, rect
from collections.abc import Sequence
from math import degrees, radians, tau
from random import Random
from typing import NamedTuple

from oracle import PLANES, Element, Outcome, _RefusedError as Refused, cross, dot, heading
from oracle_corners import Corner, ahead, bend, connect, length, stretch

FORMS = ("line-line", "line-circle", "circle-line", "circle-circle")


class Drawn(NamedTuple):
    """A program of one contour, and the path it was written from."""

    program: tuple[str, ...]
    plane: int
    start: complex
    elements: tuple[Element, ...]
    points: dict[str, complex]
    """The computed intersections P1, P2, ..."""
    kind: tuple[str, ...]
    """How each block is written, for counting what was covered."""

    @property
    def text(self) -> str:
        return "\n".join(self.program) + "\n"


def random_pair(rng: Random, form: str, plane: int, corner: str = "") -> Drawn:
    """Two blocks of 16.3.1 to 16.3.4; `corner` is `C`, `R` or "" for none."""
    while True:
        path = draw_path(rng, [{"line": "line", "circle": "arc"}[kind] for kind in form.split("-")])
        amount = _amount(rng, path, 0, corner, {}) if corner else None
        if amount or not corner:
            return _over_defined(rng, plane, path, {0: amount} if amount else {})


def random_chain(rng: Random, blocks: int, plane: int, corners: float = 0.3) -> Drawn:
    """16.3.5: one block that gives a line or circle, and so many over-defined ones after it.

    Each block but the last has a corner with the chance `corners`.
    """
    path = draw_path(rng, [rng.choice(("line", "line", "arc")) for _ in range(blocks + 1)])
    return _over_defined(rng, plane, path, _corners(rng, path, corners))


def random_cornered(rng: Random, plane: int) -> Drawn:
    """16.1 and 16.2: two to six ordinary blocks with a corner at each joint, or one line by a coordinate and ,A."""
    count = rng.choice((1, 2, 2, 3, 4, 5, 6))
    if count == 1:
        path, corners = draw_path(rng, ["line"]), {}
    else:
        while True:
            path = draw_path(rng, [rng.choice(("line", "line", "arc")) for _ in range(count)])
            corners = _corners(rng, path, 1.0)
            if len(corners) == count - 1:
                break
    writer = _Writer(rng, plane, path[0].start)
    for k, element in enumerate(path):
        if element.center is not None:
            words, kind = _ordinary_arc(writer, element, element.end)
        elif count == 1 or rng.random() < 0.4:
            words, kind = _coordinate_and_angle(writer, element)
        else:
            words, kind = _point(writer, element.start, element.end), "line to end"
        motion = "G0" if count == 1 and rng.random() < 0.3 else _motion(element)
        writer.write(motion, words, corners.get(k), kind)
        writer.choose_distance()
    return writer.drawn(path, corners, {})


def disturbed(rng: Random, drawn: Drawn) -> tuple[str, ...]:
    """The program with another value in one word of its blocks; nobody drew what it means now."""
    blocks = [
        (line, word) for line, text in enumerate(drawn.program) if line for word in text.split() if word[0] != "G"
    ]
    line, word = rng.choice(blocks)
    address = word.rstrip("-.0123456789")
    old = float(word[len(address) :])
    new = rng.choice((0.0, -old, old * rng.uniform(0.3, 3), rng.uniform(-100, 100), float(round(old))))
    if address == ",A":
        new = rng.choice((rng.uniform(-360, 360), 45.0 * rng.randint(-8, 8)))
    texts = [address + printed(new) if text == word else text for text in drawn.program[line].split()]
    return (*drawn.program[:line], " ".join(texts), *drawn.program[line + 1 :])


# Drawing ----------------------------------------------------------------------------------------------


def draw_path(rng: Random, kinds: Sequence[str]) -> list[Element]:
    """Elements that meet in sharp corners."""
    at = _rounded(complex(rng.uniform(-150, 150), rng.uniform(-150, 150)))
    along = heading(90 * rng.randrange(4)) if rng.random() < 0.2 else rect(1, rng.uniform(0, tau))
    path: list[Element] = []
    for kind in kinds:
        if path:
            arriving = ahead(path[-1], at)
            along = arriving * rect(1, radians(rng.choice((-1, 1)) * rng.uniform(15, 150)))
            square = heading(90 * rng.randrange(4))
            if rng.random() < 0.25 and abs(cross(arriving, square)) > 0.3 and dot(arriving, square) > -0.8:
                along = square
        if kind == "line":
            element = Element("line", at, at + rng.uniform(5, 100) * along)
        else:
            turn, radius = rng.choice(("cw", "ccw")), rng.uniform(6, 90)
            side = 1 if turn == "ccw" else -1
            center = at + 1j * side * along * radius
            swept = min(rng.uniform(5, 100) / radius, radians(330))
            element = Element("arc", at, center + (at - center) * rect(1, side * swept), center, radius, turn)
        path.append(element)
        at = element.end
    return path


def _corners(rng: Random, path: Sequence[Element], chance: float) -> dict[int, Corner]:
    corners: dict[int, Corner] = {}
    for k in range(len(path) - 1):
        if rng.random() < chance:
            corner = _amount(rng, path, k, rng.choice("CR"), corners)
            if corner:
                corners[k] = corner
    return corners


def _amount(rng: Random, path: Sequence[Element], k: int, kind: str, others: dict[int, Corner]) -> Corner | None:
    """A corner that takes less than half of both elements, if there is one of a sensible size."""
    before, after = path[k : k + 2]
    amount = rng.uniform(0.1, 0.9) * min(length(before), length(after))
    while amount > 0.2:
        amount = round(amount, rng.choice((1, 3, 12)))
        trial = Outcome()
        try:
            connect([before, after], {0: Corner(kind, amount)}, trial)
        except Refused:
            amount /= 2
            continue
        first, _, last = trial.elements
        if length(first) > 0.55 * length(before) and length(last) > 0.55 * length(after):
            return Corner(kind, amount)
        amount /= 2
    return None


# Writing ----------------------------------------------------------------------------------------------


def printed(value: float) -> str:
    return f"{value:.12f}"


def _rounded(at: complex) -> complex:
    return complex(float(printed(at.real)), float(printed(at.imag)))


class _Writer:
    """Blocks as text, with the codes that stay in force."""

    def __init__(self, rng: Random, plane: int, start: complex):
        self.rng, self.plane, self.start = rng, plane, start
        self.first, self.second, self.i, self.j = PLANES[plane]
        side = rng.choice((41, 42))
        self.program = [
            f"G{plane} G90 G{side} G0 {self.first}{printed(start.real)} {self.second}{printed(start.imag)} D0"
        ]
        self.motion, self.said, self.distance = "G0", 90, 90
        self.kinds: list[str] = []
        self.choose_distance()

    @property
    def is_incremental(self) -> bool:
        return self.distance == 91

    def choose_distance(self) -> None:
        self.distance = self.rng.choice((self.distance, 90, 91))

    def write(self, motion: str, words: dict[str, str], corner: Corner | None, kind: str) -> None:
        codes = []
        if motion != self.motion or self.rng.random() < 0.5:
            codes.append(motion)
        if self.distance != self.said or self.rng.random() < 0.2:
            codes.append(f"G{self.distance}")
        self.motion, self.said = motion, self.distance
        texts = [address + text for address, text in words.items()]
        if corner:
            texts.append(f",{corner.kind}{printed(corner.amount)}")
            kind += f" ,{corner.kind}"
        self.rng.shuffle(texts)
        self.program.append(" ".join(codes + texts))
        self.kinds.append(f"{kind} G91" if self.is_incremental else kind)

    def drawn(self, path: Sequence[Element], corners: dict[int, Corner], points: dict[str, complex]) -> Drawn:
        outcome = Outcome()
        connect(path, corners, outcome)
        return Drawn(tuple(self.program), self.plane, self.start, tuple(outcome.elements), points, tuple(self.kinds))


def _over_defined(rng: Random, plane: int, path: Sequence[Element], corners: dict[int, Corner]) -> Drawn:
    writer = _Writer(rng, plane, path[0].start)
    points = {}
    for k, element in enumerate(path):
        if k == 0:
            words, kind = _given_line(writer, element) if element.center is None else _given_arc(writer, element)
        else:
            points[f"P{k}"] = element.start
            writer.choose_distance()
            at = element.end if k + 1 == len(path) else _anywhere(rng, element)
            words = {writer.first: printed(at.real), writer.second: printed(at.imag)}
            if element.center is None:
                words[",A"] = _angle(rng, ahead(element, at))
                kind = "over-defined line"
            else:
                words |= {writer.i: printed(element.center.real), writer.j: printed(element.center.imag)}
                words["R"] = printed(element.radius * rng.choice((1, 1, 1, -1)))
                kind = "over-defined arc"
            q = _side(path[k - 1], element)
            if q:
                words["Q"] = ("-" if q < 0 else "") + rng.choice(("1", "0.001", "77"))
                kind += " Q-" if q < 0 else " Q+"
        writer.write(_motion(element), words, corners.get(k), kind)
    return writer.drawn(path, corners, points)


def _motion(element: Element) -> str:
    return {"": "G1", "cw": "G2", "ccw": "G3"}[element.turn]


def _side(before: Element, after: Element) -> int:
    """The sign of Q that names the place where two elements meet; 0 between lines."""
    at = after.start
    if before.center is None and after.center is None:
        return 0
    if before.center is not None and after.center is not None:
        return -1 if cross(after.center - before.center, at - before.center) > 0 else 1
    line, arc = (before, after) if before.center is None else (after, before)
    assert arc.center is not None
    # Where the line enters the circle is the nearer place, where it leaves it the farther.
    return 1 if dot(ahead(line, at), at - arc.center) > 0 else -1


def _anywhere(rng: Random, element: Element) -> complex:
    """A place on the element's line or circle, before its start and behind its end as well."""
    if element.center is None:
        return element.start + rng.uniform(-150, 150) * ahead(element, element.start)
    return element.center + rect(element.radius, rng.uniform(0, tau))


def _angle(rng: Random, along: complex) -> str:
    angle = degrees(phase(along))
    return printed(rng.choice([angle + turns for turns in (-360, 0, 360) if abs(angle + turns) <= 360]))


def _point(writer: _Writer, start: complex, at: complex) -> dict[str, str]:
    """Coordinates as the distance mode has them; one that does not change may be left out."""
    step = at - start
    told = step if writer.is_incremental else at
    words = {writer.first: printed(told.real), writer.second: printed(told.imag)}
    for name, change in ((writer.first, step.real), (writer.second, step.imag)):
        if abs(change) < 1e-13 and writer.rng.random() < 0.5:
            del words[name]
    return words


def _given_line(writer: _Writer, element: Element) -> tuple[dict[str, str], str]:
    along = ahead(element, element.start)
    if writer.rng.random() < 0.5:
        return {",A": _angle(writer.rng, along)}, "line by ,A"
    ahead_of_it = element.start + writer.rng.uniform(20, 200) * along
    return _point(writer, element.start, ahead_of_it), "line by a point"


def _given_arc(writer: _Writer, element: Element) -> tuple[dict[str, str], str]:
    if writer.rng.random() < 0.3:
        return _center(writer, element), "arc by its center"
    swept = radians(writer.rng.choice((writer.rng.uniform(20, 160), writer.rng.uniform(200, 320))))
    out = (element.start - (element.center or 0)) * rect(1, swept * bend(element))
    return _ordinary_arc(writer, element, (element.center or 0) + out)


def _ordinary_arc(writer: _Writer, element: Element, at: complex) -> tuple[dict[str, str], str]:
    """An arc from the element's start to a place, by its centre or by R."""
    words = _point(writer, element.start, at)
    swept = degrees(stretch(element, element.start, at) / element.radius)
    if abs(swept - 180) < 15 or not 5 < swept < 335 or not words or writer.rng.random() < 0.5:
        return words | _center(writer, element), "arc by center and point"
    is_long = swept > 180
    return words | {"R": printed(element.radius * (-1 if is_long else 1))}, "arc by R-" if is_long else "arc by R+"


def _center(writer: _Writer, element: Element) -> dict[str, str]:
    step = (element.center or 0) - element.start
    return {writer.i: printed(step.real), writer.j: printed(step.imag)}


def _coordinate_and_angle(writer: _Writer, element: Element) -> tuple[dict[str, str], str]:
    along = ahead(element, element.start)
    told = element.end - element.start if writer.is_incremental else element.end
    by_first = abs(along.real) > 0.3 and (abs(along.imag) < 0.3 or writer.rng.random() < 0.5)
    word = {writer.first: printed(told.real)} if by_first else {writer.second: printed(told.imag)}
    return word | {",A": _angle(writer.rng, along)}, "line by one coordinate and ,A"
