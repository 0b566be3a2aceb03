"""Words in which one block differs from all others of a drawing: a corner that is left sharp, a taper that is measured
from the other axis."""

from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache

from contoursolve.gcode import Block, Word
from contoursolve.reading import ContourForm, ParsedContour

_BROKEN = 3
"""Corners that are broken alike, by which one that is sharp stands out."""

_ALIKE = 2
"""Tapers that are alike, by which another one stands out."""

_RIGHT_ANGLE, _HALF_TURN = 90, 180


def stands_out(claim: ParsedContour, beside: Iterable[Block], around: Callable[[], Sequence[Block]]) -> bool:
    """Whether one of its blocks differs from all others around. Of these, which are `beside` it, only as many are read
    as it takes to see that none does."""
    if not (_may_be_sharp(claim) or _may_be_other_taper(claim, beside)):
        return False
    blocks = around()
    return sharp_corner(claim, blocks) is not None or other_taper(claim, blocks) is not None


def _may_be_sharp(claim: ParsedContour) -> bool:
    """Whether one of its blocks breaks no corner, and the others break theirs alike."""
    shapes = _shapes(claim)
    sized = [[word for word in block.words if word.address in shapes] for block in claim.blocks] if shapes else [[None]]
    return not all(sized) and len({(word.address, word.number) for words in sized for word in words if word}) <= 1


def _may_be_other_taper(claim: ParsedContour, beside: Iterable[Block]) -> bool:
    """Whether all tapers beside it are measured from the axis from which one of its own is not."""
    if not any(claim.before.plane.diameters):
        return False
    own = [claim.words[name] for name in _headings(claim.form) if name in claim.words]
    odd = {taper for taper in map(taper_of, own) if taper not in (0, _RIGHT_ANGLE / 2, _RIGHT_ANGLE)}
    if not odd:
        return False
    found = _tapers(claim, claim.blocks)
    count = len(found) - 1
    for block in beside:
        for taper, _ in _tapers(claim, [block]):
            odd &= {_RIGHT_ANGLE - taper}
            count += 1
        if not odd:
            break
    return bool(odd) and count >= _ALIKE


def _shapes(claim: ParsedContour) -> set[str]:
    """The addresses of the words that break corners."""
    return {claim.vocabulary[name][0] for name in claim.form.outline.shapes if name in claim.vocabulary}


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


def other_taper(claim: ParsedContour, blocks: Sequence[Block]) -> Word | None:
    """The only angle of a turned contour that makes with the other axis the angle that all other tapers around make
    with theirs; None if there is none such."""
    if not any(claim.before.plane.diameters):
        return None
    tapers = _tapers(claim, blocks)
    own = {word.span for word in claim.words.values()}
    for taper, word in tapers:
        others = [each for each, other in tapers if other is not word]
        is_other = len(others) >= _ALIKE and {*others} == {_RIGHT_ANGLE - taper}
        if is_other and word.span in own and taper != _RIGHT_ANGLE - taper:
            return word
    return None


def _tapers(claim: ParsedContour, blocks: Iterable[Block]) -> list[tuple[float, Word]]:
    """The words of some blocks that are angles of lines as a contour has them, aslant, each with its taper."""
    addresses = {claim.vocabulary[name][0] for name in _headings(claim.form) if name in claim.vocabulary}
    words = [word for block in blocks for word in block.words if word.address in addresses and word.number is not None]
    return [(taper, word) for word in words if (taper := taper_of(word)) not in (0, _RIGHT_ANGLE)]


@lru_cache(maxsize=256)
def _headings(form: ContourForm) -> frozenset[str]:
    """The words that are angles of lines."""
    return frozenset(row.fact.given for row in form.outline.facts if row.fact.heading)


def taper_of(word: Word) -> float:
    """The angle of a line with the spindle axis, degrees from 0 to 90."""
    angle = float(word.number or 0) % _HALF_TURN
    return min(angle, _HALF_TURN - angle)
