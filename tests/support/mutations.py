"""Programs that somebody damaged: one random change after the other, in windows of a few lines around each contour.

A whole program is about 60 lines of which a mutation touches one, so windows try 15 times as many in the same time.
"""

import random
import re
import string
from functools import cache
from pathlib import Path

from contoursolve import solve

PROGRAMS = {
    path.name: (path.read_text(), "nct-99m" if "NCT" in path.read_text() else "yasnac-lx3")
    for path in sorted((Path(__file__).parents[2] / "notebooks" / "programs").glob("*.nc"))
}


ODD = (
    *"%/#[]();,.+-$&'\"\\\0\t\x1a \u00c4\u0663\u2212\ufeff\U0001f600",
    *(" G111 ", " G1 ", " G91 ", " G41 ", " G18 ", " G04 ", " M98 ", " N10 ", " O1 ", " IF ", " #1=", "[#1]"),
    *(" ,A", ",A90", " ,R2", " Q0", " Q-1", " R-5", " I0", " K0", " A90.", " B0", " P1000.", " C0", " X#1", "\n", "\r"),
    *("1e9", "-", "--", "..", "0", "9" * 40, "0.0000001", "." + "9" * 20, "99999.", "NaN", "INF"),
)


WORD = re.compile(r",?[A-Za-z][ ]*[-+]?[0-9.]+")


def mutate(text: str, draw: random.Random) -> str:
    """One random change of characters, words or lines."""
    lines = text.split("\n")
    words = list(WORD.finditer(text))
    place, other = draw.randrange(len(text) + 1), draw.randrange(len(text) + 1)
    match draw.randrange(9):
        case 0:
            return text[:place] + text[place + 1 :]
        case 1:
            return text[:place] + text[place : place + 1] + text[place:]
        case 2:
            return text[:place] + draw.choice(ODD) + text[place:]
        case 3:
            return text[:place] + draw.choice(string.printable) + text[place + 1 :]
        case 4 if words:
            word = draw.choice(words)
            return text[: word.start()] + text[word.end() :]
        case 5 if words:
            word = draw.choice(words)
            return text[: word.end()] + draw.choice((" ", "")) + draw.choice(words)[0] + text[word.end() :]
        case 6 if words:
            word, value = draw.choice(words), draw.choice(words)[0].lstrip(",")[1:]
            return text[: word.start()] + word[0].rstrip("-+0123456789. ") + value + text[word.end() :]
        case 7:
            low, high = sorted((place, other))
            return text[:low] + text[low:high][::-1][: draw.randrange(8)] + text[high if high - low < 8 else low :]
        case _:
            index, target = draw.randrange(len(lines)), draw.randrange(len(lines))
            change = draw.randrange(3)
            if change == 0:
                lines.insert(target, lines[index])
            elif change == 1:
                del lines[index]
            else:
                lines[index], lines[target] = lines[target], lines[index]
            return "\n".join(lines)


@cache
def windows() -> list[tuple[str, str]]:
    """(lines before, the lines of one or two contours with those between, control)."""
    found = []
    for text, control in PROGRAMS.values():
        lines = text.split("\n")
        answers = solve(text, control=control).answers
        for answer, following in zip(answers, (*answers[1:], answers[0]), strict=True):
            start = [float(value) * (2 if control == "yasnac-lx3" and axis == "X" else 1)
                     for axis, value in zip(answer.plane.axes, answer.start.values, strict=True)]  # fmt: skip
            first, second = answer.plane.axes
            modes = "G00 " if control == "yasnac-lx3" else f"{answer.plane.code} G41 G0 "
            before = f"{modes}{first}{start[0]:.4f} {second}{start[1]:.4f}"
            if control == "yasnac-lx3" and answer.claim.before.motion:
                before += f"\nG{answer.claim.before.motion:02}"
            last = following.lines[-1] if 0 < following.lines[0] - answer.lines[-1] <= 3 else answer.lines[-1]
            found.append(("\n".join((before, *lines[answer.lines[0] - 1 : last])), control))
    return found
