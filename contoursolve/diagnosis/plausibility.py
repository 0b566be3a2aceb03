"""The plausibility of edits: one table of features, summed up, orders the fixes of every finding.

Each row is a cost in natural units: the negative logarithm of about how much more often what was meant lacks it. The
sum over a repair orders it among the others; nothing else does.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence, Set
from decimal import Decimal
from enum import Enum
from itertools import groupby, pairwise

from msgspec import Struct

from contoursolve.diagnosis.edits import Edit, EditKind, Why
from contoursolve.diagnosis.examine import LEADING
from contoursolve.diagnosis.slip_kinds import SlipKind, number_in
from contoursolve.diagnosis.window import Stretch
from contoursolve.diagnostics import Span
from contoursolve.gcode import Block
from contoursolve.solving import Contour
from contoursolve.tolerance import AGREEMENT


class Feature(Enum):
    """A feature of an edit, or of the path that it makes."""

    KIND = "kind"
    ROUND = "round"
    NEAR = "near"
    FAMILIAR = "familiar"
    POINTS = "points"
    TURNS_BACK = "turns-back"
    BEHIND_START = "behind-start"
    INWARD = "inward"
    TURNING = "turning"
    WIDE = "wide"
    CLOSED = "closed"
    ACROSS = "across"
    LARGE = "large"
    LONG = "long"
    SAME = "same"
    WARNING = "warning"


FEATURES: dict[Feature, tuple[float, str]] = {
    Feature.KIND: (1.0, "what kind of slip it undoes; a word that is missing, too many or does not fit is no slip"),
    Feature.ROUND: (1.0, "drawings have round numbers, and the typed one was hardly round by chance"),
    Feature.NEAR: (0.8, "the word that the finding marks, its block, the blocks beside it"),
    Feature.FAMILIAR: (1.0, "the blocks around have the number, or the sign, which drawings repeat"),
    Feature.POINTS: (2.2, "the intersections that a control computes come out round"),
    Feature.TURNS_BACK: (1.6, "a turned path runs back along Z"),
    Feature.BEHIND_START: (1.0, "a turned path reaches beyond where it began to cut"),
    Feature.INWARD: (0.9, "a turned path runs back across"),
    Feature.TURNING: (1.4, "the path turns by half a turn more"),
    Feature.WIDE: (1.3, "an arc sweeps more than half a turn"),
    Feature.CLOSED: (1.4, "a milled path ends where it began, which it hardly does by chance"),
    Feature.ACROSS: (4.0, "a turned path crosses the spindle axis"),
    Feature.LARGE: (
        1.1,
        "the path becomes four times as large as another repair makes it, and larger",
    ),
    Feature.LONG: (0.15, "the path becomes twice as long as another repair makes it"),
    Feature.SAME: (0.8, "the path stays as it is"),
    Feature.WARNING: (1.0, "a rule warns of the block then"),
}
"""The cost of each unit of evidence, and why it counts."""

OF_EDITS = (Feature.KIND, Feature.NEAR, Feature.ROUND, Feature.FAMILIAR)
"""Features of edits that are known before they are tried."""

REASONS: dict[Why, float] = {
    Why.ROUNDED: 0.0,
    Why.SLIP: 0.0,
    Why.AGREES: 3.0,
    Why.FITS: 3.3,
    Why.OTHER: 3.6,
    Why.MISSING: 3.0,
    Why.NOT_NEEDED: 3.7,
}
"""The cost of an edit that no slip explains, by why it is proposed."""


def cost_of(edit: Edit, slip: SlipKind | None) -> float:
    """The cost of an edit for what it undoes."""
    if edit.why is Why.FITS:
        # What is a little too large was taken from the drawing before its neighbours changed.
        fitting = _NEARLY_FITS if _ratio(edit) >= _HALF else REASONS[Why.FITS]
        return min(slip.cost, fitting) if slip is not None else fitting
    if slip is not None:
        if edit.why is Why.AGREES:
            return min(slip.cost, REASONS[Why.AGREES]) - _EXPLAINED
        is_leading = edit.old and LEADING.search(edit.old)
        return min(slip.cost, 0.6) if is_leading and slip.name in _OF_ZEROS else slip.cost
    return REASONS[edit.reason]


def _ratio(edit: Edit) -> float:
    new, old = (number_in(text) for text in (edit.text, edit.old))
    return float(new) / float(old) if new and old and float(old) else 0.0


_NEARLY_FITS, _HALF = 2.7, 0.5
"""The cost of the largest size that fits, and the share of the typed one from which on it has that."""

_OF_ZEROS = ("zero-first", "swapped")
"""Kinds of slips after which a number begins with a zero."""

_EXPLAINED = 0.2
"""By so much more plausible a value is that agrees with the others if a slip explains it."""


def roundness(text: str) -> float:
    """The roundness of a number, the lower the rounder: 0 for a ten, more with each further digit."""
    number = number_in(text)
    if not number:
        return 0.0
    digits = number.replace(".", "").strip("0")
    decimals = len(number.partition(".")[2].rstrip("0"))
    last = digits[-1:] if digits else ""
    fine = 0.0 if number.partition(".")[0].endswith("0") and not decimals else 0.2 if last == "5" else 0.5
    return fine + (0.3, 0.9, 2.2, 3.0)[min(decimals, 3)] - 0.3 + 0.15 * max(len(digits) - 2, 0)


def rounding_of(edit: Edit) -> float:
    """By how much less round the number of a word becomes."""
    if edit.kind is not EditKind.CHANGE or edit.why is Why.ROUNDED or edit.address == "G" or not number_in(edit.old):
        return 0.0
    typed, meant = (number_in(text).replace(".", "").strip("0") for text in (edit.old, edit.text))
    if typed == meant and len(typed) > _SHORT - ("." not in edit.old):
        # A point in a long number is where it was.
        return 0.0
    less = roundness(edit.text) - roundness(edit.old)
    if typed == meant and len(meant) == 1 and "." not in number_in(edit.text).rstrip("."):
        # Of sizes, those of one digit are as frequent as tens.
        return min(less, 0.0)
    # A size that fits is computed, not read from a drawing.
    return 0.3 * max(less, 0.0) if edit.why is Why.FITS else less


_SHORT = 4
"""Digits of a number in which the place of the point tells how round it is."""


class NumbersAround(Struct, frozen=True):
    """The numbers of the words around a finding: the places and addresses that have each, whatever its sign; and how
    many words of each address are above and below zero."""

    places: Mapping[Decimal, Sequence[tuple[Span, str]]]
    signs: Mapping[str, tuple[int, int]]


def numbers_of(blocks: Iterable[Block]) -> NumbersAround:
    """The numbers of the words of some blocks, without those of codes and of what is no length and no angle."""
    places, signs = dict[Decimal, list[tuple[Span, str]]](), dict[str, tuple[int, int]]()
    for block in blocks:
        for word in block.words:
            if word.number and word.address not in "GMNFST":
                address = word.address.strip(",#")
                places.setdefault(abs(word.number), []).append((word.span, address))
                above, below = signs.get(address, (0, 0))
                signs[address] = (above + (word.number > 0), below + (word.number < 0))
    return NumbersAround(places, signs)


_LEAST = 0.5


def coarseness(numbers: NumbersAround) -> float:
    """The share of numbers that are round, to a tenth, or half: where few are, a round one tells less."""
    found = [number.normalize() for number, places in numbers.places.items() for _ in places]
    share = sum(each == round(each, 1) for each in found) / len(found) if found else 1.0
    # Those that are computed stand beside some that a drawing states.
    return max(share, _LEAST)


def familiarity(edits: Iterable[Edit], numbers: NumbersAround) -> float:
    """The plausibility of new numbers that other words around have, the more with the same address; negative, as a
    cost."""
    changes = {edit.span: edit for edit in edits if edit.kind is EditKind.CHANGE}
    found = 0.0
    for edit in changes.values():
        new, old = number_in(edit.text), number_in(edit.old)
        if new and edit.text != edit.old and (number := Decimal(new)):
            letters = {address for span, address in numbers.places.get(number, ()) if span not in changes}
            is_same = edit.address.strip(",#") in letters
            if new != old:
                found -= 0.7 if is_same else 0.3 if letters else 0.0
            else:
                found -= 0.4 * is_same
        if edit.text.replace("-", "") == edit.old.replace("-", ""):
            found += _sign_cost(edit, changes, numbers)
    pairs = [(number_in(edit.text), number_in(edit.old)) for edit in changes.values()]
    is_exchanged = len(pairs) > 1 and sorted(new for new, _ in pairs) == sorted(old for _, old in pairs)
    # Of words that are exchanged, each has the number of another one.
    return found / len(pairs) if is_exchanged and any(new != old for new, old in pairs) else found


def _sign_cost(edit: Edit, changes: Mapping[Span | None, Edit], numbers: NumbersAround) -> float:
    """The cost of another sign: less if all other words of the address have it, more if all have the old one."""
    own = edit.address.strip(",#")
    counts = [*numbers.signs.get(own, (0, 0))]
    for each in changes.values():
        if each.address.strip(",#") == own and number_in(each.old).strip("0."):
            counts["-" in each.old] -= 1
    if sum(counts) < _SEVERAL or min(counts) > 0:
        return 0.0
    return -_SIGN if ("-" in edit.text) is (counts[1] > 0) else _SIGN


_SEVERAL, _SIGN = 3, 0.4
"""Words of one address by whose sign another one stands out, and what that is worth."""


def distance(line: int, is_marked: bool, marked: Set[int]) -> float:
    """The distance of an edit from what a finding marks: 0 for its words, 1 for their block, more for others."""
    if is_marked or not marked:
        return 0.0
    apart = (away for away in range(len(_DISTANCES) - 1) if line - away in marked or line + away in marked)
    return _DISTANCES[next(apart, -1)]


_DISTANCES = (0.6, 1.3, 2.0, 2.4, 2.7)
"""The costs of an edit so many lines away from what is marked, and further."""


def oddities(moves: Sequence[Stretch]) -> dict[Feature, float]:
    """The features of a path: how far it turns, how often a turned one turns back, whether it goes beyond where it
    began, and across the axis."""
    found: dict[Feature, float] = {}
    # Rapid traverse parts passes.
    for is_cutting, run in groupby(moves, lambda move: move.is_cutting):
        for evidence, amount in _oddities_of(list(run)) if is_cutting else ():
            found[evidence] = found.get(evidence, 0.0) + amount
    return found


def _oddities_of(cutting: Sequence[Stretch]) -> Iterator[tuple[Feature, float]]:
    corners = (abs((two.headings[0] - one.headings[1] + 180) % 360 - 180) for one, two in pairwise(cutting))
    yield Feature.TURNING, (sum(corners) + sum(abs(each.sweep) for each in cutting)) / 180
    yield Feature.WIDE, float(sum(abs(each.sweep) > _HALF_TURN for each in cutting))
    turned = next((each.turned for each in cutting if each.turned is not None), None)
    if turned is None:
        gap = max(abs(one - other) for one, other in zip(cutting[0].start, cutting[-1].end, strict=True))
        yield Feature.CLOSED, -float(len(cutting) > 1 and gap <= AGREEMENT)
        return
    cutting = [each for each in cutting if each.turned is not None]
    along = 1 - turned
    began = cutting[0].start[along]
    steps = [each.end[along] - each.start[along] for each in cutting]
    falls = next((step < 0 for step in steps if abs(step) > AGREEMENT), True)
    ends = [each.end[along] for each in cutting]
    beyond = max(ends) > began + AGREEMENT if falls else min(ends) < began - AGREEMENT
    across = any(min(each.start[turned], each.end[turned]) < -AGREEMENT for each in cutting)
    backs = _turns(steps)
    yield Feature.TURNS_BACK, float(backs)
    yield Feature.BEHIND_START, float(beyond and backs > 0)
    yield Feature.INWARD, float(_turns([each.end[turned] - each.start[turned] for each in cutting]))
    yield Feature.ACROSS, float(across)


_HALF_TURN = 180.01
"""Degrees; a half circle is usual."""


def _turns(steps: Iterable[float]) -> int:
    """The number of times that steps change their direction."""
    signs = [step > 0 for step in steps if abs(step) > AGREEMENT]
    return sum(one is not other for one, other in pairwise(signs))


def size_of(contour: Contour) -> float:
    """The larger side of the rectangle around the points of a path, mm."""
    points = [contour.start, *(element.end for element in contour.elements)]
    return max(max(each[axis] for each in points) - min(each[axis] for each in points) for axis in (0, 1))


ROUNDEST = 1.3
"""The roundness of intersections in steps of 5 mm."""


def round_points(contour: Contour | None) -> float:
    """The roundness of the intersections that a control computes, which they hardly have by chance: 0 for none."""
    points = [each for name, at in contour.points.items() if name.startswith("P") for each in at] if contour else []
    for step, amount in ((5.0, ROUNDEST), (1.0, 1.0), (0.1, 0.7)):
        if points and all(abs(round(each / step) * step - each) <= AGREEMENT for each in points):
            return amount
    return 0.0


def total(found: Iterable[tuple[Feature, float]], without: Collection[Feature] = ()) -> float:
    """The cost of all that is known; `without` some of it."""
    return sum(FEATURES[each][0] * amount for each, amount in found if each not in without)
