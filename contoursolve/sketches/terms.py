"""The terms of a drawing for those of a sketch's program: its lines are elements, and its words are entries."""

import re

from contoursolve.diagnosis import join
from contoursolve.sketches.sketch import ContourSketch

_LINE = re.compile(r"\b(?:program line|block)(?:s (?P<other>\d+) and|) (?P<line>-?\d+)")
_CORNERS = (("RND R", "rounding "), ("CHF ", "chamfer "))
_WORDS = {"CLSD-": "closed", "CLSD+": "closed", "FLT": "tangent", "FCT": "tangent", "DR+": "ccw", "DR-": "cw"}
_WORD = re.compile(rf"(?<!\w)(?:{'|'.join(map(re.escape, _WORDS))})(?!\w)")


def on_drawing(text: str, sketch: ContourSketch) -> str:
    """A sentence about the program of a sketch as one about its drawing: lines are elements, by their names."""

    def named(number: int) -> str:
        return sketch.name_of(number) if 0 < number <= len(sketch.elements) else "the start"

    for written, told in _CORNERS:
        text = text.replace(written, told)
    text = _LINE.sub(lambda found: join([named(int(each)) for each in found.group("other", "line") if each]), text)
    return _WORD.sub(lambda found: _WORDS[found[0]], text)


def entry_text(words: str) -> str:
    """Words that stand at a dimension as entries: `CLSD- CLSD+` is one entry, `closed`."""
    return " ".join(dict.fromkeys(_WORDS.get(each, each) for each in words.split()))
