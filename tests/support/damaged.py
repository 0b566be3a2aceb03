"""Right programs of every control with slips of the hand in them: wrong digits, letters, signs, words too many.

No import of the package but for its examples of right programs.
"""

import re
from collections.abc import Callable
from functools import cache
from random import Random

from contoursolve import DIALECTS, solve

NUMBER = re.compile(r"(?<=[A-Z=+,-])(\d+\.?\d*|\.\d+)")
WORD = re.compile(r"(?<!\S)[,#]?[A-Z]{1,4}=?[+-]?\d*\.?\d+(?!\S)")
ENDS = ("\n", "\r\n", "\r")
REMARK = "\u00e4\u00f6\u00fc \u00b0"


@cache
def right_programs(control: str) -> list[str]:
    """The programs of a control's own examples that have a contour and no error."""
    examples = dict.fromkeys(text for rule in DIALECTS[control].catalogue for text in rule.accepted)
    results = ((text, solve(text, control=control)) for text in examples)
    return [text for text, each in results if any(one.contour for one in each.answers) and not each.has_errors]


def _number(text: str, draw: Random, change: Callable[[str], str]) -> str:
    places = [*NUMBER.finditer(text)]
    if not places:
        return text
    place = draw.choice(places)
    return text[: place.start()] + change(place[0]) + text[place.end() :]


def _digit(number: str, draw: Random) -> str:
    at = draw.choice([at for at, each in enumerate(number) if each.isdigit()])
    return number[:at] + draw.choice("0123456789") + number[at + 1 :]


def _twice(text: str, draw: Random) -> str:
    """A word once more, with another sign or letter."""
    words = [*WORD.finditer(text)]
    if not words:
        return text
    word = draw.choice(words)[0]
    return f"{text} {draw.choice((word, word.replace('-', '') if '-' in word else word, 'I5.', 'K-3.', 'R4.', 'A45.'))}"


def _word(text: str, draw: Random, change: Callable[[str], str]) -> str:
    words = [*WORD.finditer(text)]
    if not words:
        return text
    word = draw.choice(words)
    return text[: word.start()] + change(word[0]) + text[word.end() :]


def _letter(word: str, draw: Random) -> str:
    at = next(at for at, each in enumerate(word) if each.isalpha())
    return word[:at] + draw.choice("ABCIJKPQRUWXYZ") + word[at + 1 :]


def _other(word: str, draw: Random) -> str:
    """A word that often states again what is there."""
    number = word.lstrip(",#=" + "ABCDEFGHIJKLMNOPQRSTUVWXYZ")
    return draw.choice(("X{}", "U{}", "Z{}", "W{}", "CR={}", "R{}", "I{}", "J{}", ",A{}", "ANG={}", "Q1")).format(
        number
    )


def _turned(word: str) -> str:
    return word.replace("-", "") if "-" in word else re.sub(r"(?=\d|\.\d)", "-", word, count=1)


SLIPS: tuple[Callable[[str, Random], str], ...] = (
    lambda text, draw: _number(text, draw, lambda number: _digit(number, draw)),
    lambda text, draw: _number(text, draw, lambda number: number.replace(".", "")),
    lambda text, draw: _number(text, draw, lambda number: number + number[-1] if number[-1] != "." else number[:-1]),
    lambda text, draw: _word(text, draw, lambda word: _letter(word, draw)),
    lambda text, _draw: text.replace(",", "", 1),
    lambda text, draw: _word(text, draw, _turned),
    lambda text, draw: _word(text, draw, lambda _: ""),
    _twice,
    _twice,
    _twice,
    lambda text, draw: _word(text, draw, lambda word: f"{word} {_other(word, draw)}"),
    lambda text, draw: _word(text, draw, lambda word: f"{word} {_other(word, draw)}"),
    lambda text, draw: _number(text, draw, lambda number: f"{float(number) + 360:g}."),
    lambda text, draw: f"{text} {draw.choice(('M08', 'M8', 'S500', 'T0101', 'F0.2', 'G01', 'G90', 'M03'))}",
    lambda text, draw: re.sub(r"G0?1\b", draw.choice(("G02", "G00", "G03")), text, count=1),
    lambda text, draw: text.replace("0", "O", 1) if draw.random() < 0.5 else text.replace("1", "l", 1),
)


TOO_MANY: tuple[Callable[[str, Random], str], ...] = (
    lambda text, draw: f"{text} {draw.choice(('M08', 'T0101', 'G01', 'R5.', 'I5.', 'J5.', 'Q1', 'CR=20', '#ANG=30'))}",
    lambda text, draw: _word(text, draw, lambda word: f"{word} {word}"),
    lambda text, draw: _word(text, draw, lambda word: f"{word} {_other(word, draw)}"),
    lambda text, draw: re.sub(r"(A|ANG=)(-?\d+)\.?", lambda angle: f"{angle[1]}{int(angle[2]) + 360}.", text, count=1),
)
"""Words too many, and those that say the same in other words."""


def damaged(seed: int) -> tuple[bytes, str]:
    """A program of one or several contours with a slip or two, in bytes with line ends and characters of every kind,
    and its control."""
    draw = Random(seed)
    control = draw.choice([*DIALECTS])
    programs = right_programs(control)
    text = draw.choice(programs)
    others = [each for each in programs if "BEGIN PGM" not in each]
    parts = [text] if "BEGIN PGM" in text else [text, *draw.sample(others, min(draw.choice((0, 1, 2)), len(others)))]
    lines = [line for part in parts for line in part.split("\n")]
    if draw.random() < 0.5:
        # What a fix may mend without a change of the contour.
        at = draw.choice([at for at, line in enumerate(lines) if len(line) > len(lines[0])] or [len(lines) - 1])
        lines[at] = draw.choice(TOO_MANY)(lines[at], draw)
    for _ in range(draw.choice((1, 1, 2, 3))):
        # A long line is rather one of a contour.
        at = max(draw.choices(range(len(lines)), k=2), key=lambda at: len(lines[at]))
        lines[at] = draw.choice(SLIPS)(lines[at], draw)
    lines.insert(0, DIALECTS[control].modes.syntax.remark.format(REMARK))
    usual, encoding = draw.choice(ENDS), draw.choice(("utf-8", "utf-8-sig", "cp1252"))
    ends = [draw.choice(ENDS) if draw.random() < 0.1 else usual for _ in lines]
    ends[-1] = draw.choice(("", usual))
    whole = "".join(line + end for line, end in zip(lines, ends, strict=True))
    return whole.encode(encoding), control
