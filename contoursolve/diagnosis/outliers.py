"""Words in which one block differs from all others of a drawing: a corner that is left sharp, a taper that is measured
from the other axis."""

from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache
from itertools import chain

from contoursolve.gcode import Block, Word
from contoursolve.reading import ContourForm, ParsedContour

_BROKEN = 3
"""Corners that are broken alike, by which one that is sharp stands out."""

_ALIKE = 2
"""Tapers that are alike, by which another one stands out."""

_RIGHT_ANGLE, _HALF_TURN = 90, 180


def stands_out(claim: ParsedContour, beside: Iterable[Block], around: Callable[[], Sequence[Block]]) -> bool:
    """Whether one of its blocks differs from all others around. Of these, which are `beside` it without plain lines,
    only as many are read as it takes to see that none does."""
    if other_taper(claim, chain(claim.blocks, beside)) is not None:
        return True
    shapes = _shapes(claim)
    is_sharp = shapes and not all(any(word.address in shapes for word in block.words) for block in claim.blocks)
    return bool(is_sharp) and sharp_corner(claim, around()) is not None


def sharp_corner(claim: ParsedContour, blocks: Sequence[Block]) -> tuple[Block, Word] | None:
    """The only block of a contour behind which a corner is sharp, where all others around are broken by one word, and
    that word; None if there is none such. `blocks` are those of the contour and some around it."""
    shapes = _shapes(claim)
    sized = [word for block in blocks for word in block.words if word.address in shapes]
    if len(sized) < _BROKEN or len({(word.address, word.number) for word in sized}) > 1:
        return None
    first, last = sized[0].span.line, sized[-1].span.line
    broken = {word.span.line for word in sized}
    rows = claim.lexicon.addresses
    sharp = [
        block
        for block in blocks
        if first < block.line < last
        and block.line not in broken
        and any((row := rows.get(word.address)) is not None and row.axis for word in block.words)
    ]
    own = {block.line for block in claim.blocks}
    return (sharp[0], sized[0]) if len(sharp) == 1 and sharp[0].line in own else None


def other_taper(claim: ParsedContour, blocks: Iterable[Block]) -> Word | None:
    """The only angle of a turned contour that makes with the other axis the angle that all other tapers around make
    with theirs; None if there is none such. `blocks` are those of the contour and some around it, in any order; no more
    of them are read than it takes."""
    words, headings = claim.words, _headings(claim.form)
    tapers = [(words[name], taper_of(words[name])) for name in headings if name in words]
    odd = [each for each in tapers if each[1] not in (0, _RIGHT_ANGLE / 2, _RIGHT_ANGLE)]
    if not odd or not any(claim.before.plane.diameters):
        return None
    addresses, count = {claim.vocabulary[name][0] for name in headings if name in claim.vocabulary}, 0
    for block in blocks:
        for other in block.words:
            if other.address in addresses and (taper := taper_of(other)) not in (0, _RIGHT_ANGLE):
                count += 1
                odd = [each for each in odd if each[1] == _RIGHT_ANGLE - taper or each[0].span == other.span]
        if not odd:
            return None
    return odd[0][0] if count > _ALIKE else None


def _shapes(claim: ParsedContour) -> set[str]:
    """The addresses of the words that break corners."""
    return {claim.vocabulary[name][0] for name in claim.form.outline.shapes if name in claim.vocabulary}


@lru_cache(maxsize=256)
def _headings(form: ContourForm) -> frozenset[str]:
    """The words that are angles of lines."""
    return frozenset(row.fact.given for row in form.outline.facts if row.fact.heading)


def taper_of(word: Word) -> float:
    """The angle of a line with the spindle axis, degrees from 0 to 90."""
    angle = float(word.number or 0) % _HALF_TURN
    return min(angle, _HALF_TURN - angle)
