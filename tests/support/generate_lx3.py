"""YASNAC LX3 blocks G112, G11 and G12 written from paths that were drawn first.

No import of the package. A fillet is drawn from the place where it touches the arc, a bevel from its end on the arc;
their amounts are measured there, so the drawing owes nothing to `oracle_corners`. Same generator, same bytes.
"""

from math import sqrt
from random import Random

from generate_nct import Drawn, printed
from oracle import Element

FORMS = ("turning", "facing")


def random_g112(rng: Random, form: str, corner1: str = "", corner2: str = "") -> Drawn:
    """A hollow or a crown, either way along the axis; `corner1` is P, C or "", `corner2` Q, D or ""."""
    while True:
        drawn = _g112(rng, form, corner1, corner2)
        if drawn:
            return drawn


def _g112(rng: Random, form: str, corner1: str, corner2: str) -> Drawn | None:
    # Drawn with the travel towards +Z and the centre at 0, then turned into place. `hollow` is the side of S: below.
    radius = rng.uniform(8, 80)
    side = rng.choice((-1, 1))
    low1, low2 = (rng.uniform(0.05, 0.9) * radius for _ in range(2))
    v1, v2 = complex(-sqrt(radius**2 - low1**2), low1 * side), complex(sqrt(radius**2 - low2**2), low2 * side)
    ends = []
    sizes = {}
    for word, low, reach in ((corner1, low1, v1.real), (corner2, low2, v2.real)):
        if not word:
            ends.append((complex(reach, low * side), complex(reach, low * side), 0j))
            continue
        # On the arc, seen from the corner: up to 40 % of the quarter that is left of it.
        deep = low + rng.uniform(0.05, 0.4) * (radius - low)
        sign = -1 if reach < 0 else 1
        touch = complex(sign * sqrt(radius**2 - deep**2), deep * side)
        if word in "PQ":
            # The fillet's centre is beyond `touch` as seen from 0, as far as it is below the line at height `low`.
            size = (deep - low) / (1 - deep / radius)
            middle = touch * (1 + size / radius)
            if abs(abs(middle.imag) - low - size) > 1e-9:
                return None
            on_line = complex(middle.real, low * side)
            if size > 4 * radius:
                return None
        else:
            size, middle = deep - low, 0j
            on_line = complex(touch.real + sign * size, low * side)
            if abs(on_line.real) < abs(reach) + 0.01:  # its arc is too flat for 45 degrees
                return None
        sizes[word] = size
        ends.append((on_line, touch, middle))
    (leave, join, middle1), (land, part, middle2) = ends
    start = complex(leave.real - rng.uniform(3, 50), v1.imag)
    turn, other = ("cw", "ccw") if side > 0 else ("ccw", "cw")
    places = [Element("line", start, leave)]
    if corner1:
        places.append(_corner(corner1, leave, join, middle1, sizes[corner1], other))
    places.append(Element("arc", join, part, 0j, radius, turn))
    if corner2:
        places.append(_corner(corner2, part, land, middle2, sizes[corner2], other))
    sense, middle = rng.choice((-1, 1)), complex(rng.uniform(-200, 50), rng.uniform(90, 260))

    def put(at: complex) -> complex:
        at = complex(at.real * sense, at.imag)
        return (at if form == "turning" else complex(at.imag, at.real)) + middle

    flips = (sense < 0) != (form == "facing")
    path = [
        element._replace(
            start=put(element.start),
            end=put(element.end),
            center=None if element.center is None else put(element.center),
            turn={"cw": "ccw", "ccw": "cw", "": ""}[element.turn] if flips else element.turn,
        )
        for element in places
    ]
    begin, first, last = path[0].start, put(v1), put(v2)
    absolute, incremental = ("X", "U") if form == "turning" else ("Z", "W")
    end = rng.choice((absolute, incremental))
    reached = last if end == absolute else last - begin
    words = {
        end: printed(2 * reached.imag if form == "turning" else reached.real),
        "I": printed((middle - begin).imag),
        "K": printed((middle - begin).real),
        "R": printed(radius),
        **{word: printed(size) for word, size in sizes.items()},
    }
    texts = [address + text for address, text in words.items()]
    rng.shuffle(texts)
    program = f"G00 X{printed(2 * begin.imag)} Z{printed(begin.real)}", f"G112 {' '.join(texts)}"
    kind = form, end, "crown" if side > 0 else "hollow", "+" if sense > 0 else "-", corner1, corner2
    return Drawn(program, 18, begin, tuple(path), {"V1": first, "V2": last}, kind)


def _corner(word: str, start: complex, end: complex, middle: complex, size: float, turn: str) -> Element:
    return Element("arc", start, end, middle, size, turn) if word in "PQ" else Element("line", start, end)


def random_g11(rng: Random, blocks: int = 1) -> Drawn:
    """Blocks of G11 (bevel) or G12 (quarter circle), by their own code, modal, or as G01 for a bevel."""
    at = begin = complex(rng.uniform(-50, 50), rng.uniform(150, 250))
    begin = complex(float(printed(begin.real)), float(printed(2 * begin.imag)) / 2)
    at = begin
    program = [f"G00 X{printed(2 * at.imag)} Z{printed(at.real)}"]
    elements: list[Element] = []
    kinds = []
    in_force = ""
    for _ in range(blocks):
        code = rng.choice(("G11", "G12", "G01"))
        along = rng.choice((1, -1, 1j, -1j))
        aside = along * rng.choice((1j, -1j))
        way = rng.uniform(2, 40)
        size = way * rng.uniform(0.1, 0.95)
        leave, end = at + (way - size) * along, at + way * along + size * aside
        elements.append(Element("line", at, leave))
        if code == "G12":
            turn = "ccw" if (aside / along).imag > 0 else "cw"
            elements.append(Element("arc", leave, end, leave + size * aside, size, turn))
        else:
            elements.append(Element("line", leave, end))
        step, name = way * along, rng.choice((0, 1))
        if along.imag:
            value, words = 2 * (step if name else at + step).imag, ("XU"[name], "K")
        else:
            value, words = (step if name else at + step).real, ("ZW"[name], "I")
        texts = [words[0] + printed(value), words[1] + printed(size * (aside.real + aside.imag))]
        rng.shuffle(texts)
        shown = [] if code == in_force and rng.random() < 0.5 else [code]
        program.append(" ".join(shown + texts))
        in_force = code
        kinds.append(code + words[0])
        at = end
    return Drawn(tuple(program), 18, begin, tuple(elements), {}, tuple(kinds))
