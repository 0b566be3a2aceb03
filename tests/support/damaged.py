"""Right programs of every control with slips of the hand in them: wrong digits, letters, signs, words too many.

No import of the package but for its examples of right programs.
"""

import re
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from random import Random

from contoursolve import DIALECTS, Severity, solve

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
NUMBER = re.compile(r"(?<=[A-Z=+,-])(\d+\.?\d*|\.\d+)")
WORD = re.compile(r"(?<!\S)[,#]?[A-Z]{1,4}=?[+-]?\d*\.?\d+(?!\S)")
ENDS = ("\n", "\r\n", "\r")
REMARK = "\u00e4\u00f6\u00fc \u00b0"


@cache
def right_programs() -> list[tuple[str, str]]:
    """Programs that have a contour and no error, with their controls."""
    found = dict[str, str]()
    for name, dialect in DIALECTS.items():
        for rule in dialect.rules:
            for text in rule.accepted:
                if text not in found and any(each.contour for each in solve(text, control=name).answers):
                    found[text] = name
    return [
        (text, name)
        for text, name in found.items()
        if all(each.severity is not Severity.ERROR for each in solve(text, control=name).diagnostics)
    ]


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


def damaged(seed: int) -> tuple[bytes, str]:
    """A program of one or several contours with a slip or two, in bytes with line ends and characters of every kind,
    and its control."""
    draw = Random(seed)
    programs = right_programs()
    text, control = draw.choice(programs)
    alike = [text for text, name in programs if name == control and ("BEGIN PGM" not in text)]
    parts = [text] if "BEGIN PGM" in text else [text, *draw.sample(alike, draw.choice((0, 1, 2)))]
    lines = [line for part in parts for line in part.split("\n")]
    for _ in range(draw.choice((1, 1, 2, 3))):
        # A long line is rather one of a contour.
        at = max(draw.choices(range(len(lines)), k=2), key=lambda at: len(lines[at]))
        lines[at] = draw.choice(SLIPS)(lines[at], draw)
    comment = {"heidenhain": "; {}", "siemens-840d": "; {}", "siemens-808d": "; {}"}.get(control, "({})")
    lines.insert(0, comment.format(REMARK))
    usual, encoding = draw.choice(ENDS), draw.choice(("utf-8", "utf-8-sig", "cp1252"))
    ends = [draw.choice(ENDS) if draw.random() < 0.1 else usual for _ in lines]
    ends[-1] = draw.choice(("", usual))
    whole = "".join(line + end for line, end in zip(lines, ends, strict=True))
    return whole.encode(encoding), control


def several(first: int, count: int) -> Iterator[tuple[bytes, str]]:
    """So many of them."""
    return (damaged(seed) for seed in range(first, first + count))
