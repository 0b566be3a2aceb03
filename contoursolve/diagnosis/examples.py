"""Numbers for words that a repair adds without one: some with which there is a contour."""

import dataclasses
from collections.abc import Callable, Iterator, Mapping, Sequence
from decimal import Decimal
from math import inf, isinf, log10

import numpy
from msgspec.structs import replace
from numpy.typing import NDArray

from contoursolve.diagnosis.edits import PLACEHOLDER, Edit, write_word
from contoursolve.diagnostics import NumberRange, OpenNumber
from contoursolve.geometry import Profile, Unit
from contoursolve.numeric import Array, section
from contoursolve.reading import Lexicon, ParsedContour
from contoursolve.solving import agreement_rows, last_holding, passed_rows

MOST_PROPOSED = 8
"""Numbers that are proposed for a repair; a few, because a rule may refuse what the equations accept."""

FEW_PROPOSED = 4
"""Numbers that are proposed where none has room around it."""

MOST_VARIED = 400
"""Combinations among which the proposed ones are chosen."""

MOST_PLACES = 4
"""Places about which words may agree that are looked at closely."""

ROWS = 4_000
"""Numbers, or combinations of several, that are looked through."""

FAR = 2_000.0
"""mm from the start, or from zero: drawings have nothing farther away, and numbers up to there are looked through."""

MOST_RANGES, MOST_FAR, MOST_TRIED = 3, 20, 10
"""Ranges of one number that are told, the nearest to its example; lengths beyond the reach on either side; and numbers
on either side that are tried one by one, where no one function tells."""

MOST_OPEN = 2
"""Open numbers of one repair whose ranges are looked for."""

SEED = 1
"""Of the combinations that are looked through."""

REACH = 4.0
"""Times the largest length of a contour: how far its other lengths are looked for."""

SAMPLE = "37.123"
"""Stands for any number where only the words matter."""


def sampled(edits: Sequence[Edit], lexicon: Lexicon) -> tuple[Edit, ...]:
    """The edits with some number for every placeholder."""
    return tuple(
        _numbered(edit, lexicon.spell(edit.address, SAMPLE)) if edit.is_placeholder else edit for edit in edits
    )


def propose(claim: ParsedContour, profile: Profile, edits: Sequence[Edit]) -> Iterator[tuple[Edit, ...]]:
    """The edits with numbers for the placeholders, with which every check is passed as far as floats can tell, those
    with the most room around them first; where no one function tells, some that lie far apart.

    `claim` and `profile` are those of the sampled edits.
    """
    added = [edit for edit in edits if edit.is_placeholder]
    names = [_name_of(claim, edit) for edit in added]
    if any(name not in profile.givens for name in names):
        return
    runs = list(_one(claim, profile, names[0]) if len(names) == 1 else _several(claim, profile, names))
    for run in runs[:MOST_PROPOSED]:
        texts = [_write(claim, name, run[:, column]) for column, name in enumerate(names)]
        numbers = iter(texts)
        yield tuple(_numbered(edit, next(numbers)) if edit.is_placeholder else edit for edit in edits)


IsAccepted = Callable[[tuple[Edit, ...]], bool]
Holds = Callable[[float], bool]


def numbers_for(
    claim: ParsedContour, profile: Profile, edits: Sequence[Edit], example: Sequence[Edit], is_accepted: IsAccepted
) -> Iterator[tuple[OpenNumber, float]]:
    """The numbers that the equations and the rules accept for each placeholder, and how far apart the first one and the
    last one are, mm or degrees. `claim` and `profile` are those of the example."""
    is_alone = sum(edit.is_placeholder for edit in edits) == 1
    for place, edit in enumerate(edits):
        if not edit.is_placeholder:
            continue
        name, open_ = _name_of(claim, edit), OpenNumber(edit.text, edit.line, example[place].text)
        if name not in profile.givens:
            yield open_, inf
            continue

        def accepts(text: str, place: int = place) -> bool:
            tried = [*example]
            tried[place] = _numbered(tried[place], text)
            return is_accepted(tuple(tried))

        ranges, is_complete, width = _ranges_of(claim, profile, name, accepts)
        value = float(profile.givens[name].value)
        texts = (_text(claim, name, round(value, digits)) for digits in (-1, 0, 1))
        is_odd = is_alone and round(value, 1) != value
        rounder = next(filter(accepts, texts), open_.example) if is_odd else open_.example
        yield replace(open_, example=rounder, ranges=ranges, is_complete=is_complete), width


def _ranges_of(
    claim: ParsedContour, profile: Profile, name: str, accepts: Callable[[str], bool]
) -> tuple[tuple[NumberRange, ...], bool, float]:
    """The ranges of a number, whether these are all, and how far apart their ends are."""
    value, is_angle = float(profile.givens[name].value), profile.givens[name].unit is Unit.DEGREE
    if is_angle:
        value = (value + _HALF_TURN) % (2 * _HALF_TURN) - _HALF_TURN

    def holds(number: float) -> bool:
        return accepts(_text(claim, name, number))

    grid, step = _far_grid(claim, profile, name, value), _increment(claim, name)
    passed = _passed(profile, {name: grid})
    is_told = passed is not None and bool(passed[numpy.argmin(abs(grid - value))])
    if not is_told:
        grid = _few(grid, value)
        passed = numpy.array([holds(float(each)) for each in grid])
    assert passed is not None
    places = numpy.flatnonzero(passed)
    runs = numpy.split(places, numpy.flatnonzero(numpy.diff(places) > 1) + 1) if places.size else []
    runs.sort(key=lambda run: float(numpy.min(abs(grid[run] - value))))
    found = list[tuple[float, float]]()
    for run in runs[:MOST_RANGES]:
        is_own = run[0] <= numpy.argmin(abs(grid - value)) <= run[-1]
        middle = value if is_own else float(grid[run[len(run) // 2]])
        if is_own or holds(middle):
            ends = ((int(run[0]), -1), (int(run[-1]), 1))
            low, high = (_end(profile, name, step, grid, middle, end, holds, is_told) for end in ends)
            found.append((low, high))
    found.sort()
    if is_angle and len(found) > 1 and (found[0][0], found[-1][1]) == (-_HALF_TURN, _HALF_TURN):
        (_, last), *found, (first, _) = found
        turn = 2 * _HALF_TURN * (value < first)
        around = (first - turn, last + 2 * _HALF_TURN - turn)
        if all(map(holds, around)):
            found.append(around)
        else:
            found = [(-_HALF_TURN, last), *found, (first, _HALF_TURN)]
    if is_angle and found == [(-_HALF_TURN, _HALF_TURN)]:
        found = [(-inf, inf)]
    texts = (tuple("" if isinf(each) else _text(claim, name, each) for each in ends) for ends in found)
    ranges = tuple(NumberRange(*ends) for ends in texts)
    return ranges, len(runs) <= MOST_RANGES, found[-1][1] - found[0][0] if found else inf


_HALF_TURN = 180.0


def _far_grid(claim: ParsedContour, profile: Profile, name: str, value: float) -> Array:
    """The numbers that are looked through, a value that is accepted among them; lengths as far as any machine goes."""
    grid = _grid(claim, profile, name)
    if profile.givens[name].unit is Unit.DEGREE:
        return numpy.unique(numpy.append(grid, value))
    step, start = _increment(claim, name), _starts_of(profile).get(name, 0.0)
    reach = _reach(profile, [name])
    far = numpy.geomspace(reach, max(2 * reach, FAR), MOST_FAR)
    sides = [start + far] if name in _sizes(profile) else [start - far, start + far]
    about = [value, step] if name in _sizes(profile) else [value, -step, 0.0, step]
    return numpy.unique(numpy.rint(numpy.concatenate([grid, *sides, about]) / step) * step)


def _few(grid: Array, value: float) -> Array:
    """Few numbers of a grid, the denser the nearer to a value, which is one of them."""
    own, least, most = int(numpy.argmin(abs(grid - value))), 0, len(grid) - 1
    steps = numpy.unique(numpy.rint(numpy.geomspace(1, len(grid), MOST_TRIED)).astype(int))
    zero = int(numpy.argmin(abs(grid)))
    places = numpy.concatenate([own - steps, [own], own + steps, [zero - 1, zero, zero + 1]])
    return numpy.unique(grid[numpy.clip(places, least, most)])


def _end(
    profile: Profile, name: str, step: float, grid: Array, middle: float, end: tuple[int, int], holds: Holds, told: bool
) -> float:
    """The last number on one side of a stretch that is accepted, infinite where each one is that was tried. Rules
    refuse some of the last numbers that the equations accept, where these tell at all."""
    place, side = end
    is_edge = not 0 <= place + side < len(grid)
    last, beyond = float(grid[place]), float(grid[place if is_edge else place + side])
    if told and not is_edge:
        beyond, _ = section(last, beyond, lambda values: ~_is_passed(profile, name, values), step * _FINE)
        nearest = round(beyond / step) * step
        beyond = nearest if _is_passed(profile, name, numpy.array([nearest]))[0] else beyond
    inside, outside = (Decimal(repr(round(each, _DIGITS))) for each in (middle, beyond))
    found = last_holding(inside, outside, Decimal(repr(step)), holds)
    is_open = profile.givens[name].unit is not Unit.DEGREE and (side > 0 or name not in _sizes(profile))
    return side * inf if is_edge and is_open and found == outside else float(found)


_FINE, _DIGITS = 1e-3, 9
"""Share of an increment to which the last number that is passed is found, and decimals of a value, mm or degrees."""


def _is_passed(profile: Profile, name: str, values: Array) -> NDArray[numpy.bool_]:
    return numpy.asarray(_passed(profile, {name: values}), bool)


def _sizes(profile: Profile) -> set[str]:
    """The givens that are sizes of corners and circles, which are above zero."""
    return {corner.size for corner in profile.figure.corners} | {fact.given for fact in profile.facts if fact.sizes}


def _passed(profile: Profile, values: Mapping[str, Array]) -> Array | None:
    """The numbers that pass every check; None where no function tells, as of a word that states several values, which
    change with it."""
    spans = {word.span for name in values if (word := profile.givens[name].word) is not None}
    stated = [name for name, given in profile.givens.items() if given.word is not None and given.word.span in spans]
    return passed_rows(profile, values) if len(stated) == len(values) else None


def _numbered(edit: Edit, text: str) -> Edit:
    return dataclasses.replace(edit, text=text)


def _name_of(claim: ParsedContour, edit: Edit) -> str:
    """The given that an added word states."""
    words = claim.words.items()
    return next(
        (name for name, word in words if word.address == edit.address and word.span.line == edit.line), PLACEHOLDER
    )


def _one(claim: ParsedContour, profile: Profile, name: str) -> list[Array]:
    """Stretches of numbers for one given that are passed, shape (numbers, 1), the longest first."""
    grid = _grid(claim, profile, name)
    passed = _passed(profile, {name: grid})
    if passed is not None and passed.sum() <= FEW_PROPOSED:
        grid = _closer(claim, profile, name, grid)
        passed = _passed(profile, {name: grid})
    if passed is None or not passed.any():
        # Where a corner always takes the whole of a line, as under G12, no number has room around it.
        count = MOST_PROPOSED if passed is None else FEW_PROPOSED
        return [grid[[place], numpy.newaxis] for place in _apart(len(grid), count)]
    places = numpy.flatnonzero(passed)
    parts = numpy.split(places, numpy.flatnonzero(numpy.diff(places) > 1) + 1) if places.size else []
    runs = [grid[part, numpy.newaxis] for part in sorted(parts, key=len, reverse=True)]
    # The middle of a stretch may be the one number that a rule refuses, such as 0 between either sign.
    halves = [part for run in runs for part in numpy.array_split(run, 2) if part.size]
    return [*runs[: MOST_PROPOSED - 2], *halves[:2], *runs[MOST_PROPOSED - 2 :]]


def _closer(claim: ParsedContour, profile: Profile, name: str, grid: Array) -> Array:
    """And the numbers about those with which the other words agree best, as those of a circle with its point, if there
    are words that need not be there."""
    agreement = agreement_rows(profile, {name: grid})
    if agreement is None or profile.givens[name].unit is Unit.DEGREE:
        return grid
    agreement = numpy.nan_to_num(agreement, nan=-numpy.inf)
    inner = agreement[1:-1]
    peaks = 1 + numpy.flatnonzero((inner >= agreement[:-2]) & (inner > agreement[2:]))
    peaks = peaks[numpy.argsort(-agreement[peaks], kind="stable")][:MOST_PLACES]
    step = _increment(claim, name)
    about = [numpy.linspace(grid[place - 1], grid[place + 1], ROWS) for place in peaks]
    return numpy.unique(numpy.rint(numpy.concatenate([grid, *about]) / step) * step)


def _several(claim: ParsedContour, profile: Profile, names: Sequence[str]) -> Iterator[Array]:
    """Combinations of numbers for several givens that are passed, shape (1, givens): first those of few decimals, those
    of lengths that are usual in this contour first."""
    rng, reach = numpy.random.default_rng(SEED), _reach(profile, names)
    for is_coarse in (True, False):
        grids = [_grid(claim, profile, name, reach / REACH / 5 if is_coarse else 0.0) for name in names]
        rows = numpy.stack([rng.choice(grid, ROWS) for grid in grids], axis=1)
        passed = _passed(profile, dict(zip(names, rows.T, strict=True)))
        if passed is None:
            yield from (rows[[place]] for place in _apart(len(rows), MOST_PROPOSED))
            return
        lengths = [place for place, name in enumerate(names) if profile.givens[name].unit is not Unit.DEGREE]
        starts = _starts_of(profile)
        steps = rows[:, lengths] - [starts.get(names[place], 0.0) for place in lengths]
        unusual = ((abs(steps) * REACH / reach - 0.5) ** 2).sum(axis=1)
        places = numpy.flatnonzero(passed)
        ordered = rows[places[numpy.argsort(unusual[places], kind="stable")]]
        yield from (row[numpy.newaxis] for row in _varied(ordered[:MOST_VARIED]))


def _varied(rows: Array) -> list[Array]:
    """The first few rows, those first that share no number with another one: where one number leaves a line no
    length, others do not."""
    found: list[Array] = []
    for row in rows:
        if len(found) == MOST_PROPOSED:
            return found
        if not any((row == other).any() for other in found):
            found.append(row)
    return found + [row for row in rows[:MOST_PROPOSED] if not any((row == each).all() for each in found)]


def _apart(count: int, few: int) -> list[int]:
    """A few of so many places, far apart."""
    return [number * (count - 1) // (few + 1) for number in range(1, few + 1)]


def _reach(profile: Profile, names: Sequence[str]) -> float:
    """The distance from the start point, or from zero, within which lengths are looked for, mm."""
    starts = _starts_of(profile)
    lengths = (
        abs(float(given.value) - starts.get(name, 0.0))
        for name, given in profile.givens.items()
        if given.unit is Unit.MM and name not in names
    )
    return REACH * max((*lengths, 10.0))


def _starts_of(profile: Profile) -> dict[str, float]:
    """The coordinates of the start point from which givens that are coordinates count, mm; those of others are 0."""
    found: dict[str, float] = {}
    for fact in profile.facts:
        if placed := fact.placed:
            found.setdefault(fact.given, 0.0 if placed.origin else float(profile.start.values[placed.axis] or 0))
    return found


def _grid(claim: ParsedContour, profile: Profile, name: str, coarse: float = 0.0) -> Array:
    """The numbers that are looked through for a given, mm (X as radius) or degrees, at the least increments: dense
    about what is near, up to several times the contour's size. Coarse ones differ by about so many mm, or 15 degrees.
    """
    if profile.givens[name].unit is Unit.DEGREE:
        return numpy.linspace(-180, 180, 25 if coarse else 1441)
    along = numpy.linspace(-1, 1, 2001)
    steps = _reach(profile, [name]) * (0.1 * along + 0.9 * along**3)
    if name in _sizes(profile):
        steps = steps[steps > 0]
    step = _increment(claim, name)
    if coarse:
        step *= 10 ** max(0, round(log10(coarse / step)))
    return numpy.unique(numpy.rint((_starts_of(profile).get(name, 0.0) + steps) / step) * step)


def _increment(claim: ParsedContour, name: str) -> float:
    """The least increment of a given's word, mm (X as radius)."""
    row, unit = claim.lexicon.addresses[claim.words[name].address], claim.after.unit
    step = float(claim.lexicon.numbers.step(row.unit, unit)) * float(unit.in_mm)
    return step / 2 if row.is_diameter else step


def _write(claim: ParsedContour, name: str, values: Array) -> str:
    """A word for a value among those of a run, with as few decimals as one in its middle half can have."""
    row, unit = claim.lexicon.addresses[claim.words[name].address], claim.after.unit
    scale = 1.0
    if row.unit is not Unit.DEGREE:
        scale = (2 if row.is_diameter else 1) / float(unit.in_mm)
    quarter = len(values) // 4
    low, high = (float(values[place]) * scale for place in (quarter, len(values) - 1 - quarter))
    middle = float(values[len(values) // 2]) * scale
    rounded = (round(middle, digits) for digits in (-1, 0, 1, 2))
    number = next((each for each in rounded if low <= each <= high), middle)
    return _text(claim, name, number / scale)


def _text(claim: ParsedContour, name: str, value: float) -> str:
    """A word for a value, mm (X as radius) or degrees."""
    return write_word(claim.words[name].address, value, claim.lexicon, claim.after.unit)
