"""Typing slips in sound contour blocks of every form of both controls, each with what was meant.

A slip changes one word of one block the way a hand does: a sign, a point or a comma, one digit, two digits, a letter.
Nothing here looks at what the package says about it. Same generator, same slips.
"""

import re
from dataclasses import dataclass
from math import cos, radians, sin, tan
from random import Random

from generate_lx3 import random_g11, random_g112
from generate_nct import random_chain, random_cornered, random_pair
from oracle import PLANES


@dataclass(frozen=True, slots=True)
class Sound:
    """A contour as it was meant: the block before it, and its own blocks as words."""

    form: str
    control: str
    before: str
    blocks: tuple[tuple[str, ...], ...]

    def text(self, line: int = -1, word: int = 0, typed: str = "") -> str:
        """The program, with one word as it was typed."""
        lines = [list(block) for block in self.blocks]
        if line >= 0:
            lines[line][word] = typed
        return "\n".join([self.before, *(" ".join(words) for words in lines)])


@dataclass(frozen=True, slots=True)
class Slip:
    """A slip in one word of a sound contour: its kind, and the word as it was meant and as it was typed."""

    sound: Sound
    kind: str
    line: int
    word: int
    typed: str

    @property
    def meant(self) -> str:
        return self.sound.blocks[self.line][self.word]

    @property
    def text(self) -> str:
        return self.sound.text(self.line, self.word, self.typed)


# Slips -----------------------------------------------------------------------------------------------------

_WORD = re.compile(r"(,?[A-Z])([+-]?)([0-9.]+)")
_BESIDE = {"1": "2", "2": "13", "3": "24", "4": "35", "5": "46", "6": "57", "7": "68", "8": "79", "9": "80", "0": "9"}
_NEIGHBOURS = {"C": "D", "D": "C", "P": "Q", "Q": "P"}


KINDS = (
    *("sign lost", "sign added", "two signs", "two points", "comma for point", "point missing", "point swallowed"),
    *("stray comma", "letter for digit", "wrong digit", "digit lost", "digit twice", "digits swapped"),
    *("comma of address", "word of the other corner", "R for P or Q"),
)


def _typed(kind: str, word: str, rng: Random) -> str:
    """A word with a slip of a kind; empty where it can have none."""
    match = _WORD.fullmatch(word)
    assert match is not None, word
    address, sign, number = match.groups()
    has_point, is_whole = "." in word, word.endswith(".")
    plain = {
        "sign lost": address + number if sign == "-" else "",
        "sign added": f"{address}-{number}" if not sign and float(number) else "",
        "two signs": f"{address}--{number}" if sign else "",
        "two points": word.replace(".", "..") if has_point else "",
        "comma for point": address + sign + number.replace(".", ",") if has_point else "",
        "point missing": word[:-1] if is_whole else "",
        "point swallowed": word.replace(".", "") if has_point and not is_whole else "",
        "stray comma": f"{word},",
        "comma of address": word[1:] if word.startswith(",") else "",
        "word of the other corner": _NEIGHBOURS[word[0]] + word[1:] if word[0] in _NEIGHBOURS else "",
        "R for P or Q": "R" + word[1:] if word[0] in "PQ" and has_point else "",
    }
    if kind in plain:
        return plain[kind]
    digits = [at for at, char in enumerate(number) if char.isdigit()]
    places = {
        "letter for digit": [at for at in digits if number[at] in "01"],
        "digit lost": digits[: len(digits) * (len(digits) > 1)],
        "digits swapped": [at for at in digits[:-1] if number[at + 1].isdigit() and number[at] != number[at + 1]],
    }.get(kind, digits)
    if not places:
        return ""
    at = rng.choice(places)
    old, behind = number[at], number[at + 1 :]
    match kind:
        case "letter for digit":
            new = {"0": "O", "1": "l"}[old]
        case "wrong digit":
            new = rng.choice(_BESIDE[old])
        case "digits swapped":
            new, behind = behind[0] + old, behind[1:]
        case _:
            new = 2 * old if kind == "digit twice" else ""
    return address + sign + number[:at] + new + behind


OFTEN = {"sign added": 1, "R for P or Q": 1, "digits swapped": 1, "wrong digit": 1, "digit lost": 1}
"""How often a kind is drawn, where that is not twice: a sign is rather lost than added."""


def random_slip(sound: Sound, rng: Random) -> Slip | None:
    """A slip in a contour, if one of the kind that is drawn can happen there."""
    kind = rng.choices(list(KINDS), [OFTEN.get(each, 2) for each in KINDS])[0]
    found = [
        Slip(sound, kind, line, at, typed)
        for line, block in enumerate(sound.blocks)
        for at, word in enumerate(block)
        if _can_have(sound, block, word, kind) and (typed := _typed(kind, word, rng))
    ]
    return rng.choice(found) if found else None


def _can_have(sound: Sound, block: tuple[str, ...], word: str, kind: str) -> bool:
    """Whether a word may have a slip of a kind, that a reader can see.

    One wrong digit can be seen in what is said twice, as by the words of an over-defined circle. In other words it
    makes another drawing; where that cannot be, any of its words may be the one that is wrong.
    """
    if word[0] in "GNFSM":
        return False
    if kind in ("R for P or Q", "word of the other corner"):
        return sound.form == "G111"
    if kind in ("wrong digit", "digit lost"):
        addresses = {each[0] for each in block}
        return (
            sound.control == "nct-99m" and word[0] in "XYZIJKR" and "R" in addresses and len(addresses & set("IJK")) > 1
        )
    return not (kind == "stray comma" and word[0] == "Q" and sound.control == "nct-99m")


# Sound contours --------------------------------------------------------------------------------------------


def written(value: float, control: str = "yasnac-lx3", places: int = 3) -> str:
    text = f"{round(value, places) + 0:.{places}f}".rstrip("0")
    text = "0." if text == "-0." else text
    return text if control == "yasnac-lx3" else text.rstrip(".")


def _nice(rng: Random, low: float, high: float) -> float:
    return round(rng.uniform(low, high) * 2) / 2 if rng.random() < 0.6 else round(rng.uniform(low, high), 3)


def _angle(rng: Random) -> float:
    # Half of the lines as in turning from the face: towards the chuck and outwards.
    if rng.random() < 0.5:
        return rng.choice((90.0, 180.0, 180.0, 135.0, 120.0, 150.0, float(rng.randint(95, 175))))
    return float(rng.choice((rng.randint(-180, 180), 15 * rng.randint(-12, 12), round(rng.uniform(-180, 180), 3))))


_PAIRS_1 = ("AI", "AK", "IK", "AI", "AK", "IK", "A", "I", "K")
_PAIRS_2 = ("BX", "BU", "BZ", "BW", "XZ", "XW", "UZ", "UW")
_WHOLE_2 = ("BXZ", "BXW", "BUZ", "BUW")


def random_g111(rng: Random) -> Sound:
    """A taper multiple cornering with words rounded as people write them."""
    while True:
        x, z = _nice(rng, 20, 200), rng.choice((0.0, 2.0, _nice(rng, -40, 40)))
        a, b = _angle(rng), _angle(rng)
        if not 15 < abs((b - a + 180) % 360 - 180) < 165:
            continue
        reach = [_nice(rng, 5, 60), _nice(rng, 5, 60)]
        v1 = (z + reach[0] * cos(radians(a)), x / 2 + reach[0] * sin(radians(a)))
        v2 = (v1[0] + reach[1] * cos(radians(b)), v1[1] + reach[1] * sin(radians(b)))
        if min(v1[1], v2[1]) < 1:
            continue
        values = {
            "A": a,
            "I": v1[1] - x / 2,
            "K": v1[0] - z,
            "B": b,
            "X": 2 * v2[1],
            "U": 2 * v2[1] - x,
            "Z": v2[0],
            "W": v2[0] - z,
        }
        if rng.random() < 0.7:
            values = {name: round(2 * value) / 2 if name not in "AB" else value for name, value in values.items()}
        line1 = rng.choice(_PAIRS_1)
        line2 = rng.choice(_PAIRS_2 if len(line1) > 1 else _WHOLE_2)
        words = [name + written(values[name]) for name in line1 + line2]
        room = min(reach) * min(1.0, 1 / tan(radians(abs((b - a + 180) % 360 - 180) / 2)))
        corners = rng.choice(("", "P", "C", "PQ", "PD", "CQ", "CD", "Q", "D"))
        fitting = corners if "B" in line2 and len(line2) < 3 else corners[:1].strip("QD")
        words += [corner + written(max(1.0, round(room * rng.uniform(0.05, 0.4)))) for corner in fitting]
        rng.shuffle(words)
        words.sort(key=lambda word: word[0] in "DQ")
        if rng.random() < 0.2:
            words.append("F0.2")
        return Sound("G111", "yasnac-lx3", f"G00 X{written(x)} Z{written(z)}", (("G111", *words),))


def _rounded(program: tuple[str, ...], form: str, control: str) -> Sound:
    """A drawn program with numbers as they are written."""
    before, *blocks = (
        tuple(
            f"{word[: -len(number)]}{written(float(number), control)}" if (number := _number(word)) else word
            for word in block.split()
        )
        for block in program
    )
    return Sound(form, control, " ".join(before), tuple(blocks))


def _number(word: str) -> str:
    match = re.search(r"[+-]?\d+\.\d+$", word)
    return match[0] if match else ""


def random_sound(rng: Random, form: str) -> Sound:
    """A contour of a form, that is not held against any control yet."""
    if form == "G111":
        return random_g111(rng)
    if form == "G112":
        shape = rng.choice(("turning", "facing"))
        corners = rng.choice(("", "P", "C")), rng.choice(("", "Q", "D"))
        return _rounded(random_g112(rng, shape, *corners).program, form, "yasnac-lx3")
    if form == "G11":
        return _rounded(random_g11(rng).program, form, "yasnac-lx3")
    plane = rng.choice(tuple(PLANES))
    if form == "chain":
        return _rounded(random_chain(rng, rng.choice((2, 3)), plane).program, form, "nct-99m")
    if form == "corners":
        return _rounded(random_cornered(rng, plane).program, form, "nct-99m")
    return _rounded(random_pair(rng, form, plane, rng.choice(("", "", "C", "R"))).program, form, "nct-99m")


FORMS = ("G111", "G112", "G11", "line-line", "line-circle", "circle-line", "circle-circle", "chain", "corners")
