"""A claimed path against the words of its block: its joints, each word's value at its points, corners, sides, answers.

The solutions of the words are worked out first: the nearest one tells which element is which, and what the result tells
gives the unknowns their values.
"""

from collections.abc import Mapping, Sequence
from decimal import Decimal
from math import degrees, floor, inf, log10

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve import gcode
from contoursolve.gcode import Block, Word
from contoursolve.geometry import FIRST, SECOND, Arc, Fact, Unit, scalar
from contoursolve.reading import ParsedContour
from contoursolve.tolerance import ERROR_BOUND_WARNING, LENGTH, RESIDUAL
from contoursolve.verification import rank
from contoursolve.verification.decode import (
    PRINTED,
    ClaimedArc,
    ClaimedAsked,
    ClaimedCertificate,
    ClaimedContour,
    ClaimedPath,
)
from contoursolve.verification.drawing import Circle, Move, side_of
from contoursolve.verification.receipt import Ledger
from contoursolve.verification.residuals import MEANINGS, Array, measured
from contoursolve.verification.status import (
    EPSILON,
    FEW,
    ROUNDING,
    Candidate,
    Case,
    candidates,
    difference,
    is_on_side,
    prepare,
)

CERTIFIED = 4
"""1. A residual that compares a point with three others may be off by the error of all four of them."""


class ClaimedMoves(Struct, frozen=True):
    """A claimed path counted from the start point; `limit` is what a residual may be, mm, and `grain` half of the last
    decimal that its numbers have, if the certificate's radius leaves them no more."""

    path: ClaimedPath
    moves: tuple[Move, ...]
    points: Mapping[str, complex]
    end: complex | None
    limit: float
    grain: float


def moves_of(case: Case, path: ClaimedPath) -> ClaimedMoves:
    """The moves of a path without their names."""

    def place(at: tuple[float, float]) -> complex:
        first, second = (float(Decimal(value) - start) for value, start in zip(at, case.system.origin, strict=True))
        return complex(first, second)

    moves = []
    for each in path.elements:
        circle = None
        if isinstance(each, ClaimedArc):
            circle = Circle(place(each.center), each.radius, 1 if each.turn == "ccw" else -1)
        moves.append(Move("", place(each.start), place(each.end), circle))
    points, end = {name: place(at) for name, at in path.points.items()}, path.end and place(path.end)
    grain = _grain(path)
    largest = max([case.reach, *(abs(value) for each in path.elements for value in (*each.start, *each.end))])
    limit = RESIDUAL + ROUNDING * largest + 4 * grain
    return ClaimedMoves(path, tuple(moves), points, end, limit, grain)


def _grain(path: ClaimedPath) -> float:
    radius = path.certificate.radius
    if not radius or not PRINTED < radius <= ERROR_BOUND_WARNING:
        return 0.0
    decimals = floor(-log10(radius))
    return 0.5 * 10.0**-decimals if all(round(value, decimals) == value for value in path.numbers()) else 0.0


def examine(
    case: Case, path: ClaimedPath, found: Sequence[Candidate], ledger: Ledger, *, is_chosen: bool
) -> Array | None:
    """Check a claimed path; the values of all unknowns in it, None where none of the solutions `found` has such
    elements.

    One that `is_chosen` must be on the sides that words choose, too.
    """
    claimed = moves_of(case, path)
    _check_outline(case, claimed, ledger)
    check_certificate(case, path.certificate, ledger)
    words = case.words(case.profile.facts)
    if not ledger.require("the words fix the points", words, case.is_determined, "they do not"):
        return None
    solution = nearest(claimed, found)
    if solution is None:
        has = ", ".join("arc" if each.circle else "line" for each in claimed.moves) or "none"
        others = ["; ".join(each.path.against) or ", ".join(move.name for move in each.path.moves) for each in found]
        remark = f"the result has {has}; the words give {' or '.join(dict.fromkeys(others)) or 'no solution'}"
        ledger.require("the elements are those that the words give", (), passed=False, remark=remark)
        return None
    return _examine_at(case, claimed, solution, ledger, is_chosen=is_chosen)


def _check_outline(case: Case, claimed: ClaimedMoves, ledger: Ledger) -> None:
    """What holds for every path, whatever its form: its points by their names, nothing without length, its end."""
    names = [point for point in case.profile.figure.points if point in case.profile.intersections]
    wanted, has = ", ".join(names) or "none", ", ".join(sorted(map(ascii, claimed.path.points))) or "none"
    is_same = claimed.path.points.keys() == set(names)
    ledger.require(f"the points are {wanted}", (), is_same, f"the result has {has}")
    for number, move in enumerate(claimed.moves, 1):
        length = abs(move.end - move.start)
        # An arc that ends where it begins is a full circle.
        is_long = length >= LENGTH - 2 * PRINTED or move.circle is not None
        ledger.require(f"element {number} has a length", (), is_long, f"it is {length:.3g} mm long")
    if ledger.require("the result says where the contour ends", (), claimed.end is not None, "end is null"):
        last = claimed.moves[-1].end if claimed.moves else 0j
        ledger.measure("the contour ends with its last element", (), abs((claimed.end or 0j) - last), claimed.limit)


def nearest(claimed: ClaimedMoves, found: Sequence[Candidate]) -> Candidate | None:
    """The solution with elements of the same kinds and turns that is nearest to a claimed path."""

    def kinds(moves: Sequence[Move]) -> list[int]:
        return [move.circle.turn if move.circle else 0 for move in moves]

    def gap(solution: Candidate) -> float:
        # Of two that share their path, the one that agrees with all words.
        off = RESIDUAL if solution.conflicts else 0.0
        for own, its in zip(solution.path.moves, claimed.moves, strict=True):
            off += abs(own.end - its.end)
            off += abs(own.circle.center - its.circle.center) if own.circle and its.circle else 0.0
        return off

    return min((each for each in found if kinds(each.path.moves) == kinds(claimed.moves)), key=gap, default=None)


CERTIFICATE_KINDS = ("exact", "unique", "verified", "unknown")


def check_certificate(case: Case, certificate: ClaimedCertificate, ledger: Ledger) -> None:
    """What can be said of a certificate alone; its radius is held against every point that is worked out."""
    kind, radius = certificate.kind, certificate.radius
    ledger.require("the certificate is of a known kind", (), kind in CERTIFICATE_KINDS, f"it is {ascii(kind)[:60]}")
    if kind == "unknown":
        ledger.require("the certificate says why it proves nothing", (), bool(certificate.reason), "there is no reason")
    if certificate.double is not None and certificate.double.gap_mm is not None:
        limit = RESIDUAL + ROUNDING * case.reach
        ledger.measure("the certificate calls double what just touches", (), certificate.double.gap_mm, limit)
    if radius is None:
        ledger.omit("the certificate", "it names no radius")
        return
    # An exact number may have no double, or no twelve decimals, that are exactly it.
    is_exact = 0 <= radius <= PRINTED if kind == "exact" else radius > 0
    ledger.require("the certificate's radius is that of its kind", (), is_exact, f"{kind}, and {radius:g} mm")
    if radius > 0:
        digit = float(f"{radius:.17e}".partition("e")[0])
        is_one = abs(digit - round(digit)) < PRINTED
        ledger.require("the certificate's radius has one digit", (), is_one, f"it is {radius!r} mm")


# --- Which unknowns a path tells -------------------------------------------------------------------


def told(case: Case, path: ClaimedPath) -> Array:
    """The values of the unknowns that a claimed path tells, before its elements are known by their names."""
    claimed, names, figure = moves_of(case, path), list[str](), case.profile.figure
    for element in figure.path:
        names += [element.name, *(each.name for each in figure.corners if each.at == element.head)]
    is_whole = len(names) == len(claimed.moves)
    return _values(case, claimed, names if is_whole else ())


def _values(case: Case, claimed: ClaimedMoves, names: Sequence[str]) -> Array:
    """The values of the unknowns that claimed elements of these names tell, NaN for the others."""
    found, figure, here = dict[str, float](), case.profile.figure, 0j

    def put(name: str, at: complex) -> None:
        found[scalar(name, FIRST)], found[scalar(name, SECOND)] = at.real, at.imag

    cut, moves = {corner.at for corner in figure.corners}, dict(zip(names, claimed.moves, strict=False))
    for name, at in claimed.points.items():
        put(name, at)
    for element in figure.path if names else ():
        own = moves.get(element.name)
        here = own.end if own else here
        if element.head not in cut and element.head not in claimed.points:
            put(element.head, here)
        if own and own.circle and isinstance(element, Arc):
            put(element.center, own.circle.center)
            found[element.radius] = own.circle.radius
        for corner in (each for each in figure.corners if each.at == element.head and each.name in moves):
            own = moves[corner.name]
            here = own.end
            put(f"{corner.name}.begin", own.start)
            put(f"{corner.name}.end", own.end)
            if own.circle:
                put(f"{corner.name}.center", own.circle.center)
                found[f"{corner.name}.radius"] = own.circle.radius
    return numpy.array([found.get(name, numpy.nan) for name in case.system.unknowns])


# --- What the words say of these values ------------------------------------------------------------


def _examine_at(case: Case, claimed: ClaimedMoves, solution: Candidate, ledger: Ledger, *, is_chosen: bool) -> Array:
    """The checks of a path that is near a solution; the values of all unknowns where the words put them."""
    limit, system, certificate, signs = claimed.limit, case.system, claimed.path.certificate, solution.signs
    own = _values(case, claimed, [move.name for move in solution.path.moves])
    values = rank.settle(
        system, case.basis, numpy.where(numpy.isnan(own), solution.values, own), ~numpy.isnan(own), signs
    )
    noise = ROUNDING * case.size + case.found.start_error + 2 * claimed.grain + EPSILON * case.reach
    hides = inf if certificate.double is not None else case.band / FEW
    moved = rank.correct(system, case.basis, values, signs, noise, hides)
    for fact, off in zip(case.basis, system.residuals(case.basis, values, signs).tolist(), strict=True):
        ledger.measure(_name(case, fact), case.words([fact]), off, limit + noise)
    if moved.is_hidden or moved.is_open:
        ledger.omit("how far the points may be off", "several solutions have become one there")
    if moved.fold is not None:
        ledger.measure("two solutions have become one", (), moved.fold, limit + 1e3 * noise)
    for name, by, unsure in zip(system.unknowns, moved.by.tolist(), moved.unsure.tolist(), strict=True):
        words = case.words([fact for fact in case.basis if name in fact.reads() and fact.given])
        what, allowed = f"{name.rpartition('.')[0] or name} is where the words put it", limit
        if certificate.radius is not None:
            what += ", within the certificate's radius"
            allowed = min(limit, CERTIFIED * max(0.0, certificate.radius) + PRINTED + ROUNDING * case.reach)
        ledger.measure(what, words, by, allowed + unsure)
    values = values + moved.by
    for fact in case.spare:
        off, allowed = difference(case, fact, values, signs)
        ledger.measure(_name(case, fact), case.words([fact]), off, allowed)
    scalars = case.scalars(values)
    _check_drawn(case, claimed.moves, scalars, limit + float(moved.unsure.max(initial=0.0)), ledger)
    for choice in case.profile.choices if is_chosen else ():
        given = case.profile.givens.get(choice.given)
        words = [given.word.text] if given and given.word else []
        is_right = is_on_side(case, scalars, choice)
        ledger.require(f"{choice.point} is the {choice.side.value} place", words, is_right, "it is the other one")
    _check_asked(case, claimed, values, ledger, is_hidden=moved.is_hidden)
    return values


def _name(case: Case, fact: Fact) -> str:
    """What checks call a fact."""
    if fact.given.startswith("fact "):
        return "the fact holds"
    fields = {name: getattr(fact, name) for name in type(fact).__struct_fields__}  # type: ignore[attr-defined]
    axis = case.profile.plane.axes[fields["axis"]] if "axis" in fields else ""
    return MEANINGS[type(fact)].name.format_map({**fields, "axis": axis})


def _check_drawn(case: Case, moves: Sequence[Move], scalars: Mapping[str, float], limit: float, ledger: Ledger) -> None:
    """The claimed elements are those that are drawn here between the points."""
    drawn, givens = case.draw(scalars), case.profile.givens
    sizes = [givens[corner.size].word for corner in case.profile.figure.corners if corner.size in givens]
    words = [word.text for word in sizes if word]
    if not ledger.require("the elements and corners can be made", words, not drawn.against, "; ".join(drawn.against)):
        return
    names = ", ".join(move.name for move in drawn.moves)
    is_whole = len(drawn.moves) == len(moves)
    if not ledger.require("the elements are those that have a length", (), is_whole, f"these have: {names}"):
        return
    for move, claimed in zip(drawn.moves, moves, strict=True):
        off = max(abs(claimed.start - move.start), abs(claimed.end - move.end))
        if claimed.circle and move.circle:
            wider = abs(claimed.circle.radius - move.circle.radius)
            off = max(off, abs(claimed.circle.center - move.circle.center), wider)
            is_right = claimed.circle.turn == move.circle.turn
            ledger.require(f"{move.name} turns as the path does", (), is_right, "it turns the other way")
        ledger.measure(f"{move.name} is where it is drawn", (), off, 2 * limit)


# --- What a path says besides ----------------------------------------------------------------------


def check_branches(case: Case, branches: Mapping[str, str], branch: str | None, values: Array, ledger: Ledger) -> None:
    """The branches are the sides that words choose, but for points where both places are one."""
    scalars, wanted, open_ones = case.scalars(values), {}, set[str]()
    for choice in case.profile.choices:
        side = side_of(case.system, scalars, choice)
        if choice.given and choice.point in case.profile.intersections and side is not None:
            if case.band / FEW < side[1] <= FEW * case.band:
                open_ones.add(choice.point)
            if side[1] > case.band / FEW:
                wanted[choice.point] = choice.side.value
    found = {name: side for name, side in branches.items() if name not in open_ones or side != wanted.get(name)}
    rest = {name: side for name, side in wanted.items() if name not in open_ones}
    told = ", ".join(f"{name} {side}" for name, side in rest.items()) or "none"
    ledger.require("the path takes the sides that words choose", (), found == rest, f"they are {told}")
    joined = ", ".join(branches.values()) or None
    ledger.require("its branch names these sides", (), branch == joined, f"they are {joined}")


def _check_asked(case: Case, claimed: ClaimedMoves, values: Array, ledger: Ledger, *, is_hidden: bool) -> None:
    """Every question has its answer, which is that of the elements."""
    rest, at = list(claimed.path.asked), case.system.at(values, dict.fromkeys(case.system.sides, 1))
    name = "the answer is the value that the elements have"
    for question in case.profile.questions:
        label, key = [case.label(question.word)], (question.word.text, question.word.span.line)
        answer = next((each for each in rest if (each.word, each.line) == key), None)
        is_there = answer is not None
        ledger.require("the result answers what is asked for", label, is_there, "the result does not mention it")
        if answer is None:
            continue
        rest.remove(answer)
        value, is_angle, reach = measured(question.fact, at, case.system.origin)
        unit = "deg" if is_angle else "mm"
        if is_hidden:
            ledger.omit(label[0], "several solutions have become one there")
        elif is_angle and reach <= LENGTH:
            ledger.omit(label[0], "what has no length has no direction")
        elif answer.value is None:
            ledger.require(name, label, passed=False, remark=f"it is {value:g} {unit}, and the result has none")
        elif ledger.require("its unit is what it measures", label, answer.unit == unit, f"it is not {unit}"):
            limit, off = claimed.limit, answer.value - value
            if is_angle:
                limit += degrees((2 * PRINTED + ROUNDING * case.reach) / reach)
                off = (off + 180) % 360 - 180
            ledger.measure(name, label, off, limit, unit)
    words = [each.word for each in rest]
    ledger.require("the program asks for what the result answers", words, not rest, "it does not")


# --- Values that are filled in ---------------------------------------------------------------------


def missed(case: Case, answer: ClaimedAsked, word: Word) -> float:
    """By how much a word misses an answer, mm (radius) or degrees; infinite where it has no value."""
    lexicon = case.claim.lexicon
    known = word.address in lexicon.addresses
    given = lexicon.given(word.address, word, case.claim.after.unit) if known else None
    if given is None or answer.value is None:
        return inf
    # The sign of a radius only chooses.
    off = answer.value - float(abs(given.value) if word.address == "R" else given.value)
    return (off + 180) % 360 - 180 if given.unit is Unit.DEGREE else off


def half_increment(case: Case, word: Word) -> float:
    """Half of the least increment of a word, mm (radius) or degrees."""
    lexicon, unit = case.claim.lexicon, case.claim.after.unit
    row = lexicon.addresses.get(word.address)
    step = lexicon.numbers.step(row.unit, unit) if row else Decimal(0)
    scale = unit.in_mm if row and row.unit is not Unit.DEGREE and unit.in_mm != 1 else 1
    return float(step * scale) / (4 if row and row.is_diameter else 2)


SAME = "the filled blocks differ from the program's only where a value is asked for"


def check_filled(case: Case, claimed: ClaimedContour, ledger: Ledger) -> None:
    """The filled blocks: the same text with rounded values, which alone make nearly the same contour."""
    filled, blocks, claim, dialect = claimed.filled, case.claim.blocks, case.claim, case.found.dialect
    if filled is None:
        return
    texts = [word.text for block in blocks for word in block.words if word.is_asked]
    if not ledger.require("a value is asked for", texts, bool(texts), "nothing was to be filled in"):
        return
    own = [
        gcode.parse_block(text, block.line, block.syntax) for text, block in zip(filled.blocks, blocks, strict=False)
    ]
    is_same = len(filled.blocks) == len(blocks) and all(map(_is_filled, blocks, own))
    if not ledger.require(SAME, texts, is_same, "something else was changed, or a value is missing"):
        return
    for block, new in zip(blocks, own, strict=True):
        for word, value in zip(block.words, new.words, strict=True):
            if word.is_asked:
                _check_value(case, claimed.asked, word, value, ledger)
    stripped = tuple(replace(block, directives=()) for block in own)
    again, name = dialect.find(stripped, 0, claim.before, dialect.modes), "the filled blocks make one contour"
    if not isinstance(again, ParsedContour) or len(again.blocks) != len(blocks):
        ledger.require(name, texts, passed=False, remark="they are none")
        return
    other = prepare(replace(case.found, rules="off", claim=again))
    made = candidates(other) if other.is_readable and other.is_determined else []
    paths, own_moves = [each for each in made if each.is_chosen and each.is_path], moves_of(case, claimed)
    solution = nearest(own_moves, paths)
    if ledger.require(name, texts, solution is not None, f"they make {len(paths)}") and solution:
        pairs = zip(solution.path.moves, own_moves.moves, strict=True)
        off = max((abs(own.end - its.end) for own, its in pairs), default=0.0)
        limit = own_moves.limit + ROUNDING * case.size
        ledger.measure("they deviate as much as the result says", texts, off - filled.deviation_mm, limit)


def _is_filled(block: Block, filled: Block) -> bool:
    """Whether only the words that are asked for are different, and have values."""
    if len(block.words) != len(filled.words) or filled.faults != block.faults:
        return False
    text = block.text
    for word, new in reversed(list(zip(block.words, filled.words, strict=True))):
        if word.is_asked:
            if new.address != word.address or new.number is None:
                return False
            text = text[: word.span.column - 1] + new.text + text[word.span.end_column - 1 :]
    return text == filled.text


def _check_value(case: Case, asked: Sequence[ClaimedAsked], word: Word, new: Word, ledger: Ledger) -> None:
    """A value that is filled in is the one that was asked for, rounded to the least increment."""
    answers = [each for each in asked if (each.word, each.line) == (word.text, word.span.line)]
    name, words = "the filled value is the asked one, rounded", [word.text, new.text]
    off = missed(case, answers[0], new) if len(answers) == 1 else inf
    if off == inf:
        ledger.require(name, words, passed=False, remark="it has no value")
        return
    unit = case.claim.lexicon.addresses[word.address].unit.value
    ledger.measure(name, words, off, half_increment(case, word) + RESIDUAL, unit)
