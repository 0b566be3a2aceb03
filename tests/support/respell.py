"""Fanuc programs respelled for SINUMERIK and for the ISG kernel, so that `oracle_fanuc` judges them, too. No import of
the package.

A respelled program is its lines, each with the number of the Fanuc line that it comes from. X of a lathe is a diameter;
in another plane (17 to 19), the second axis has the halves.
"""

import re
from collections.abc import Sequence
from functools import partial
from random import Random

from generate_nct import printed
from oracle import PLANES
from oracle_fanuc import Machine, _take, _Walk

Line = tuple[int, str]

_WORD = re.compile(r"(,?[A-Z])([+-]?\d*\.?\d+|[+-]?\d+\.)")
_SINUMERIK = {",A": "ANG=", ",C": "CHR=", ",R": "RND=", "R": "CR="}
_ISG = {",A": "#ANG=", ",C": "#CHR=", ",R": "#RND=", "R": "R"}
_UNITS = {"G20": "G70", "G21": "G71"}


def sinumerik(rng: Random, program: Sequence[str], plane: int | None) -> list[Line]:
    """A lathe's program with DIAMON or in a plane; a mill's one (`plane` is 0) with DIAMOF."""
    found = []
    for number, line in enumerate(program, 1):
        words = []
        for address, value in _WORD.findall(line):
            if line.startswith("G04") and address == "P":
                words.append(f"F{float(value) / 1000}")
            elif address == "G":
                words.append(_UNITS.get(address + value, address + value))
            elif plane is not None and address in ("X", "Z", "U", "W") and plane:
                words.append(_coordinate(rng, *_placed(address, value, plane)))
            elif plane is None and address in ("X", "Z", "U", "W"):
                words.append(_coordinate(rng, {"U": "X", "W": "Z"}.get(address, address), value, address in "UW"))
            else:
                words.append(_SINUMERIK.get(address, address) + value)
        head = _head(plane, "G18 DIAMON", "DIAMOF") if number == 1 else []
        text = " ".join((*head, *words))
        found.append((number, text.lower() if rng.random() < 0.05 else text))
    return found


def isg(rng: Random, program: Sequence[str], plane: int | None) -> list[Line]:
    """The same for ISG. There are no words for increments: where the oracle says that they end stands in their place.
    Some corners are blocks of their own."""
    found: list[Line] = []
    walk = _Walk(Machine(is_lathe=plane != 0), plane=17 if plane == 0 else 18)
    size = ""
    for number, line in enumerate(program, 1):
        _take(walk, number, line)
        if line.startswith("G04"):
            continue
        words, corner = [], ""
        for address, value in map(partial(_absolute, walk, plane), _WORD.findall(line)):
            if address == "G":
                words.append(_UNITS.get(address + value, address + value))
            elif address in (",C", ",R") and rng.random() < 0.4 and not corner and "-" not in value and float(value):
                corner = f"G30{1 + (address == ',R')}" + ("" if value == size and rng.random() < 0.5 else f" I{value}")
                size = value
            else:
                text = _ISG.get(address, address) + value
                words.append(text.replace("=", " ") if rng.random() < 0.2 else text)
        head = _head(plane, "G18 G51", "G52") if number == 1 else []
        found.append((number, " ".join((*head, *words))))
        if corner:
            found.append((number, corner))
    return found


def _absolute(walk: _Walk, plane: int | None, word: tuple[str, str]) -> tuple[str, str]:
    """A word of a lathe's block, in its plane, behind which the oracle has gone. In a closing block, an
    increment stays one, and is refused as a word that does not exist."""
    address, value = word
    is_wrong = address in "UW" and walk.blocks and walk.blocks[-1].fault == "56"
    if plane == 0 or address not in ("X", "Z", "U", "W") or is_wrong:
        return word
    if address in "UW":
        at = 2 * walk.at.imag if address == "U" else walk.at.real
        address, value = {"U": "X", "W": "Z"}[address], printed(at / walk.scale)
    return _placed(address, value, plane)[:2] if plane else (address, value)


def _head(plane: int | None, lathe: str, mill: str) -> list[str]:
    if plane is None:
        return [lathe, "G90"]
    return [f"G{plane or 17}", mill, "G90"]


def _placed(address: str, value: str, plane: int) -> tuple[str, str, bool]:
    """A coordinate of a lathe in a plane: its address, its number, and whether it is an increment."""
    first, second = PLANES[plane][:2]
    is_step = address in "UW"
    return (first, value, is_step) if address in "ZW" else (second, f"{float(value) / 2:.14f}", is_step)


def _coordinate(rng: Random, address: str, value: str, is_step: bool) -> str:
    if is_step:
        return f"{address}=IC({value})"
    way = rng.random()
    if way < 0.1:
        return f"{address}=AC({value})"
    if way < 0.2:
        return f"{address}={value}"
    return f"{address} {value}" if way < 0.3 else address + value
