"""Points of legal contours that stand out: the only one beside which a line runs aslant where all others are parallel
to the axes, or the one by which a path does not end where it began; with the number that it was probably meant to have.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from contoursolve.diagnosis.edits import Edit, change, write_word
from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.plausibility import rounding_of
from contoursolve.diagnosis.slip_kinds import (
    FEW,
    OF_DIGITS,
    POINT_MOVED,
    SIGN_ADDED,
    SIGN_LOST,
    ZERO_LOST,
    Changes,
    SlipKind,
    explained,
    recognise,
)
from contoursolve.gcode import Word
from contoursolve.reading import ParsedContour
from contoursolve.solving import ArcSegment, Point
from contoursolve.tolerance import AGREEMENT

_FEWEST = 4
"""Lines of a path in which one stands out."""

SHIFTED = SlipKind("shifted", "the start of the corner", "", 1.5, "slips by hand, tests/slips")


class Vertex(NamedTuple):
    """The end of a line as its block states it: the place, mm, and the word of each axis that has one there."""

    place: Point
    words: tuple[Word | None, Word | None]
    size: float
    """The size of the corner at it, mm; 0 for none."""


Meant = tuple[Edit, SlipKind]
"""A word with another number, and the slip that explains it."""


def aslant(answer: Answer) -> Iterator[tuple[Meant, ...]]:
    """The word without whose number all lines would be parallel to an axis, with each one that makes them so; of a
    milled contour, two such words where no one does."""
    vertices, is_turned = _vertices(answer), any(answer.plane.diameters)
    count = _count_aslant(vertices)
    if len(vertices) <= _FEWEST or count not in (1, 2):
        return
    moved = [*_moves(answer, vertices)]
    alone = [(each,) for new, each in moved if not _count_aslant(new)]
    yield from alone
    for new, first in moved if not (alone or is_turned) else ():
        if _count_aslant(new) < count:
            for last, second in _moves(answer, new):
                if first[0].place < second[0].place and not _count_aslant(last):
                    yield first, second


def _moves(answer: Answer, vertices: list[Vertex]) -> Iterator[tuple[list[Vertex], Meant]]:
    """The vertices with one of another place, at which a line that may have been meant is parallel to an axis."""
    is_turned = any(answer.plane.diameters)
    for at in range(1, len(vertices)):
        before, *after = (vertices[each].place for each in (at - 1, at + 1) if each < len(vertices))
        for axis, word in enumerate(vertices[at].words):
            if word is None:
                continue
            here = vertices[at].place[axis]
            for value in dict.fromkeys(place[axis] for place in (before, *after)):
                new = _moved(vertices, at, axis, value)
                if new is None or _count_aslant(new) >= _count_aslant(vertices):
                    continue
                is_short = min(before[axis], value) < here < max(before[axis], value)
                is_shifted = is_short and abs(abs(value - here) - vertices[at].size) <= AGREEMENT
                # A taper is meant, unless it leads back.
                is_back = _turns(vertices, is_turned=is_turned) > _turns(new, is_turned=is_turned)
                if is_shifted or is_back or not is_turned:
                    meant = _explained(answer, word, value, is_shifted=is_shifted, is_back=is_back)
                    yield from ((new, each) for each in meant)


def open_end(answer: Answer) -> Iterator[tuple[Meant, ...]]:
    """The words of a milled contour with which it ends where it began, if a slip explains their number."""
    vertices = _vertices(answer)
    if any(answer.plane.diameters) or len(vertices) <= _FEWEST:
        return
    start, end = vertices[0].place, vertices[-1].place
    apart = [axis for axis in (0, 1) if abs(start[axis] - end[axis]) > AGREEMENT]
    if len(apart) != 1:
        return
    for vertex in reversed(vertices):
        if (word := vertex.words[apart[0]]) is not None:
            found = _explained(answer, word, start[apart[0]], is_shifted=False, is_back=False)
            yield from ((each,) for each in found if each[1] in (SIGN_LOST, SIGN_ADDED, POINT_MOVED, ZERO_LOST))
            return


def has_odd_points(answer: Answer) -> bool:
    """Whether a point of a contour stands out, and a slip explains it."""
    return next(aslant(answer), None) is not None or next(open_end(answer), None) is not None


def _vertices(answer: Answer) -> list[Vertex]:
    """The points of a contour whose lines are stated by their ends; nothing for others."""
    claim, contour = answer.claim, answer.contour
    if contour is None or any(isinstance(each, ArcSegment) and _is_line(each.name) for each in contour.elements):
        return []
    stated = {claim.words[name].span: name for name in claim.words}
    facts = {row.fact.given: row.fact for row in claim.form.outline.facts if row.fact.given in claim.words}
    sizes = _sizes(claim)
    if not {*stated.values()} <= {*facts, *claim.form.outline.shapes}:
        return []
    found, place = [Vertex(contour.start, (None, None), 0.0)], list(contour.start)
    for number in range(len(claim.blocks)):
        words: list[Word | None] = [None, None]
        for name, fact in facts.items():
            if claim.vocabulary[name][1] != number or name in claim.form.outline.shapes:
                continue
            if fact.placed is None or fact.placed.origin or name not in claim.givens:
                return []
            place[fact.placed.axis] = float(claim.givens[name].value)
            words[fact.placed.axis] = claim.words[name]
        if any(words):
            found.append(Vertex((place[0], place[1]), (words[0], words[1]), sizes.get(number, 0.0)))
    return found


def _is_line(name: str) -> bool:
    return not name.startswith("corner")


def _sizes(claim: ParsedContour) -> dict[int, float]:
    """The sizes of corners, mm, by the number of their block."""
    names = [name for name in claim.form.outline.shapes if name in claim.givens and name in claim.vocabulary]
    return {claim.vocabulary[name][1]: abs(float(claim.givens[name].value)) for name in names}


def _is_aslant(one: Vertex, other: Vertex) -> bool:
    return all(abs(one.place[axis] - other.place[axis]) > AGREEMENT for axis in (0, 1))


def _count_aslant(vertices: list[Vertex]) -> int:
    return sum(map(_is_aslant, vertices, vertices[1:]))


def _moved(vertices: list[Vertex], at: int, axis: int, value: float) -> list[Vertex] | None:
    """The vertices with another number, which counts until the next one that is stated; None where nothing changes, or
    a line has no length then."""
    if abs(vertices[at].place[axis] - value) <= AGREEMENT:
        return None
    new = list(vertices)
    for each in range(at, len(new)):
        if each > at and new[each].words[axis] is not None:
            break
        place = list(new[each].place)
        place[axis] = value
        new[each] = Vertex((place[0], place[1]), new[each].words, new[each].size)
    is_short = any(_is_same(one, two) for one, two in pairwise(new))
    return None if is_short else new


def _is_same(one: Vertex, other: Vertex) -> bool:
    return all(abs(one.place[axis] - other.place[axis]) <= AGREEMENT for axis in (0, 1))


def _turns(vertices: list[Vertex], *, is_turned: bool) -> int:
    """The number of times that a turned path runs in again, or back."""
    count = 0
    for axis in (0, 1) if is_turned else ():
        steps = [two.place[axis] - one.place[axis] for one, two in pairwise(vertices)]
        signs = [step > 0 for step in steps if abs(step) > AGREEMENT]
        count += sum(one is not two for one, two in pairwise(signs))
    return count


def _explained(answer: Answer, word: Word, value: float, *, is_shifted: bool, is_back: bool) -> Iterator[Meant]:
    """A word with another value, mm, if a slip explains it, or it is shifted by a corner."""
    claim = answer.claim
    for text in explained(word, value, claim, (*_OF_NUMBERS, *OF_DIGITS) if is_back else _OF_NUMBERS):
        if (kind := recognise(edit := change(word, text), claim)) is not None:
            yield edit, kind
            return
    edit = change(word, write_word(word.address, value, claim.lexicon, claim.after.unit))
    if is_shifted and rounding_of(edit) <= _AS_ROUND:
        yield edit, SHIFTED


_OF_NUMBERS = tuple(kind for kind in FEW if kind.changes is not Changes.ADDRESS)
_AS_ROUND = 0.3
"""By so much less round the number of a corner may be than that of where it begins."""
