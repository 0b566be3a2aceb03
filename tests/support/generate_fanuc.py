"""Fanuc and Haas programs written from paths that were drawn first, as `generate_nct` does. No import of the package.

Twelve decimals keep every point within 1e-9 mm of the drawing, so `oracle_fanuc` and the drawing agree.
"""

import re
from cmath import phase
from collections.abc import Sequence
from math import degrees
from random import Random

from generate_nct import _corners, _ordinary_arc, _point, _Writer, draw_path, printed
from oracle import Element
from oracle_corners import Corner, ahead

_LENGTHS = re.compile(r"(?<![A-Z,])(,[CR]|[XYZUWIJKR])(-?[\d.]+)")


def random_lathe(rng: Random, lines: int, angle: str = ",A", *, meets: bool = True, reverses: bool = True) -> list[str]:
    """Lines by their ends, by an angle and a coordinate, and by two angles; X is a diameter."""
    path = draw_path(rng, ["line"] * lines)
    up = 5 - min(0.0, *(at.imag for each in path for at in (each.start, each.end)))
    path = [Element("line", each.start + 1j * up, each.end + 1j * up) for each in path]
    corners = _corners(rng, path, 0.7)
    start = path[0].start
    blocks = [f"G00 X{printed(2 * start.imag)} Z{printed(start.real)}"]
    is_open = False
    for k, element in enumerate(path):
        is_closing, is_open = is_open, False
        if is_closing:
            words = [
                _word("X", 2 * element.end.imag),
                _word("Z", element.end.real),
                _angle(rng, element, angle, reverses),
            ]
        elif meets and k + 1 < lines and rng.random() < 0.35:
            is_open = True
            words = [_angle(rng, element, angle, reverses)]
        elif rng.random() < 0.45:
            words = [*_coordinate(rng, element), _angle(rng, element, angle, reverses)]
        else:
            words = [*_words_of_end(rng, element)]
        motion = "G01" if k == 0 or rng.random() < 0.3 else ""
        blocks.append(_block(rng, motion, words, corners.get(k)))
        if k in corners and rng.random() < 0.1:
            blocks.append("G04 P500")
    return _in_unit(rng, blocks)


def random_mill(rng: Random, elements: Sequence[str], plane: int, corners: float = 0.85) -> list[str]:
    """Lines and arcs by their ends, with corners at most of their joints."""
    path = draw_path(rng, elements)
    found = _corners(rng, path, corners)
    writer = _Writer(rng, plane, path[0].start)
    for k, element in enumerate(path):
        if element.center is not None:
            words, kind = _ordinary_arc(writer, element, element.end)
        else:
            words, kind = _point(writer, element.start, element.end), "line"
        motion = {"": "G1", "cw": "G2", "ccw": "G3"}[element.turn]
        writer.write(motion, words, found.get(k), kind)
        writer.choose_distance()
    return _in_unit(rng, writer.program)


def disturbed(rng: Random, program: Sequence[str], addresses: Sequence[str]) -> list[str]:
    """The program with a word lost, one too many, or one wrong; nobody drew what it means now."""
    lines = [line.split() for line in program]
    places = [
        (line, index)
        for line, words in enumerate(lines)
        if line
        for index, word in enumerate(words)
        if word[0] not in "GDF" and not any(each == "G04" for each in words)
    ]
    line, index = rng.choice(places)
    words = lines[line]
    address = re.match(r",?[A-Z]", words[index])[0]
    value = float(words[index].removeprefix(address))
    wrong = rng.choice((0.0, -value, value * rng.uniform(0.3, 3), rng.uniform(-100, 100), value + 180))
    way = rng.choice(("lost", "more", "wrong", "wrong", "comma", "address"))
    if way == "lost" and len(words) > 1:
        del words[index]
    elif way == "more":
        more = rng.choice([each for each in addresses if all(not word.startswith(each) for word in words)])
        words.append(more + printed(rng.choice((wrong, rng.uniform(1, 40)))))
    elif way == "comma" and address.startswith(","):
        words[index] = words[index].removeprefix(",")
    elif way == "address":
        words[index] = rng.choice(addresses) + words[index].removeprefix(address)
        if len({re.match(r",?[A-Z]", each)[0] for each in words if each[0] != "G"}) < sum(
            each[0] != "G" for each in words
        ):
            words[index] = address + printed(wrong)
    else:
        words[index] = address + printed(wrong)
    return [" ".join(words) for words in lines]


def _word(address: str, value: float) -> str:
    return address + printed(value)


def _angle(rng: Random, element: Element, angle: str, reverses: bool) -> str:
    value = degrees(phase(ahead(element, element.start)))
    if reverses and rng.random() < 0.15:
        value += 180
    return _word(angle, rng.choice([value + turns for turns in (-360, 0, 360) if abs(value + turns) <= 360]))


def _first(rng: Random, element: Element) -> str:
    return rng.choice((_word("Z", element.end.real), _word("W", (element.end - element.start).real)))


def _second(rng: Random, element: Element) -> str:
    return rng.choice((_word("X", 2 * element.end.imag), _word("U", 2 * (element.end - element.start).imag)))


def _coordinate(rng: Random, element: Element) -> list[str]:
    along = ahead(element, element.start)
    by_first = abs(along.real) > 0.3 and (abs(along.imag) < 0.3 or rng.random() < 0.5)
    if rng.random() < 0.1:
        return [_first(rng, element), _second(rng, element)]
    return [(_first if by_first else _second)(rng, element)]


def _words_of_end(rng: Random, element: Element) -> list[str]:
    step = element.end - element.start
    words = []
    if abs(step.real) > 1e-13 or rng.random() < 0.5:
        words.append(_first(rng, element))
    if abs(step.imag) > 1e-13 or not words or rng.random() < 0.5:
        words.append(_second(rng, element))
    return words


def _block(rng: Random, motion: str, words: list[str], corner: Corner | None) -> str:
    if corner:
        words = [*words, f",{corner.kind}{printed(corner.amount)}"]
    if rng.random() < 0.2:
        words = [*words, "F0.2"]
    rng.shuffle(words)
    return " ".join(filter(None, (motion, *words)))


def _in_unit(rng: Random, blocks: Sequence[str]) -> list[str]:
    """Every third program in inches."""
    if rng.random() < 0.67:
        return [f"G21 {blocks[0]}", *blocks[1:]]
    inches = [_LENGTHS.sub(lambda word: f"{word[1]}{float(word[2]) / 25.4:.14f}", line) for line in blocks]
    return [f"G20 {inches[0]}", *inches[1:]]
