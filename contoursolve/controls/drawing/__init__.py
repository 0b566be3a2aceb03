"""A drawing: what it gives of a contour, in the words of free contours. No machine reads it, and no program shows it.

It is a relative of HEIDENHAIN's free contours: any words in any order, all solved together. Its plane is that of the
part, X of a turned part is a diameter, and the corner behind an element stands in the element's block.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

from contoursolve.controls.drawing.rules import drawing_rules
from contoursolve.controls.heidenhain.find import find
from contoursolve.controls.heidenhain.follow import follow
from contoursolve.controls.heidenhain.lexicon import (
    CODES,
    OF_CORNERS,
    OF_SENSES,
    SPELLING,
    PlaneWords,
    rows_of,
    spelling,
)
from contoursolve.controls.plain import LATHE, PLANES
from contoursolve.diagnostics import OWN, Evidence, Source
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Plane
from contoursolve.reading import Control, Lexicon, Modes, NumberFormat, ParsedContour, State, WithoutPoint

_MEANING = Source(OWN, "what a drawing means", Evidence.DERIVED)


def _find(
    blocks: Sequence[Block], index: int, state: State, modes: Modes, *, words: PlaneWords
) -> ParsedContour | None:
    """The contour that begins at a block. Nothing of it is taken for granted: its words are what a drawing gives."""
    claim = find(blocks, index, state, modes, words)
    if claim is None:
        return None
    return replace(claim, form=replace(claim.form, title="contour of a drawing", assumptions=()))


def _shows_nothing(_: Block) -> tuple[Word, ...]:
    """No program is a drawing."""
    return ()


_SPELLING = replace(SPELLING, before={**SPELLING.before, "rounding": "rounding ", "chamfer": "chamfer "}, names={})


def _drawing(part: str, plane: Plane, words: PlaneWords) -> Control:
    rows = rows_of(words, _MEANING, _MEANING, _MEANING, _MEANING, is_diameter=any(plane.diameters))
    lexicon = Lexicon(rows, NumberFormat(WithoutPoint.AS_WRITTEN, _MEANING), spelling=_SPELLING)
    modes = Modes(
        *(lexicon, CODES, words.axes, frozenset()),
        settings={"suspicions": "off"},
        syntax=spelling("drawing", words, rf"{OF_SENSES}|CC?W(?!\w)", rf"{OF_CORNERS}|(?:ROUNDING|CHAMFER)[ \t]++"),
        follow=follow,
    )
    return Control(
        "drawing",
        f"a drawing of a {part} part",
        modes,
        plane,
        (),
        drawing_rules(words, _MEANING),
        partial(_find, words=words),
        _shows_nothing,
        contours="lines and arcs with what a drawing gives",
    )


_WORDS: Mapping[str, tuple[Plane, PlaneWords]] = {
    part: (plane, PlaneWords(plane.axes, across=(), has_corners=True))
    for part, plane in (("turned", LATHE), ("milled", PLANES[17]))
}
DRAWINGS: Mapping[str, Control] = {part: _drawing(part, *row) for part, row in _WORDS.items()}
"""The drawings of parts, by how these are made."""


def words_of_drawing(part: str, kind: str | None = None) -> Mapping[str, str]:
    """The words with a number that a line or an arc may have, or any of both, with their meaning."""
    words, addresses = _WORDS[part][1], DRAWINGS[part].modes.lexicon.addresses
    kinds = [is_line for is_line in (True, False) if kind in (None, "line" if is_line else "arc")]
    names = dict.fromkeys(name for is_line in kinds for name in words.of_element(is_line=is_line))
    return {name: addresses[name].meaning for name in names}
