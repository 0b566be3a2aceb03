"""A claimed path against the words of its block: its joints, each word's value at its points, corners, sides, answers.

The elements that a result has are told apart by the figure's own; what they tell gives the unknowns their values.
"""

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import combinations, islice
from math import degrees, floor, inf, log10

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve import gcode
from contoursolve.gcode import Block, Word
from contoursolve.geometry import FIRST, SECOND, Arc, CornerShape, Fact, OnCircle, Unit, line_scalars, scalar
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
from contoursolve.verification.residuals import MEANINGS, Array, measured, senses
from contoursolve.verification.status import (
    EPSILON,
    FEW,
    ROUNDING,
    Case,
    agrees,
    allowance,
    candidates,
    is_on_side,
    prepare,
)

CERTIFIED = 4
"""1. A residual that compares a point with three others may be off by the error of all four of them."""

MOST_SIGNS, MOST_READINGS = 64, 8
"""Ways to choose the sides on which elements touch, and to tell the elements apart, that are looked at."""


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


def examine(case: Case, path: ClaimedPath, ledger: Ledger, *, is_chosen: bool) -> Array | None:
    """Check a claimed path; the values of all unknowns in it, None where it is no path of this figure.

    One that `is_chosen` must be on the sides that words choose, too.
    """
    claimed = moves_of(case, path)
    _check_joints(case, claimed, ledger)
    check_certificate(case, path.certificate, ledger)
    words = case.words(case.profile.facts)
    if not ledger.require("the words fix the points", words, case.is_determined, "they do not"):
        return None
    order = _order(case)
    attempts = [
        _attempt(case, claimed, reading, is_chosen=is_chosen)
        for reading in islice(_readings(case, claimed, order), MOST_READINGS)
    ]
    own, values = min(attempts, key=lambda each: len(each[0].failures), default=(Ledger(), None))
    found = ", ".join("arc" if each.circle else "line" for each in claimed.moves) or "none"
    names = ", ".join(name for name, _ in order)
    ledger.require(f"the elements are {names}", (), bool(attempts), f"the result has {found}")
    ledger.add(own)
    return values


def _check_joints(case: Case, claimed: ClaimedMoves, ledger: Ledger) -> None:
    """What holds for every path, whatever its form: no gaps, nothing without length, arcs on their circles."""
    limit, here, name = claimed.limit, 0j, "the start"
    names = [point for point in case.profile.figure.points if point in case.profile.intersections]
    wanted, has = ", ".join(names) or "none", ", ".join(sorted(map(ascii, claimed.path.points))) or "none"
    is_same = claimed.path.points.keys() == set(names)
    ledger.require(f"the points are {wanted}", (), is_same, f"the result has {has}")
    slack = max((fact.slack for fact in case.spare if isinstance(fact, OnCircle)), default=0.0)
    for number, move in enumerate(claimed.moves, 1):
        own, length, circle = f"element {number}", abs(move.end - move.start), move.circle
        ledger.measure(f"{own} begins at {name}", (), abs(move.start - here), limit)
        ledger.require(f"{own} has a length", (), length >= LENGTH - 2 * PRINTED, f"it is {length:.3g} mm long")
        if circle:
            ledger.require(f"{own} has a radius", (), circle.radius > 0, f"it is {circle.radius:g} mm")
            for verb, at in (("begins", move.start), ("ends", move.end)):
                off = abs(at - circle.center) - circle.radius
                ledger.measure(f"{own} {verb} on its circle", (), off, limit + slack)
        here, name = move.end, f"the end of {own}"
    ledger.require("the result says where the contour ends", (), claimed.end is not None, "end is null")
    if claimed.end is not None:
        ledger.measure(f"the contour ends at {name}", (), abs(claimed.end - here), limit)


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

LINE, ANY_TURN = 0, 2
"""Beside the signs of turns."""


def _order(case: Case) -> list[tuple[str, int]]:
    """Every element and corner of the path with the sign of its turn."""
    found = list[tuple[str, int]]()
    for element in case.profile.figure.path:
        found.append((element.name, element.turn.sign if isinstance(element, Arc) else LINE))
        corners = [each for each in case.profile.figure.corners if each.at == element.head]
        found += [(each.name, ANY_TURN if each.shape is CornerShape.FILLET else LINE) for each in corners]
    return found


def _readings(case: Case, claimed: ClaimedMoves, order: list[tuple[str, int]]) -> Iterator[dict[str, Move]]:
    """Every way in which the claimed elements can be those of the figure: lines of no length are left out, and corners
    that the control may leave out, where an element ends in their intersection."""
    moves = claimed.moves
    turns = [each.circle.turn if each.circle else LINE for each in moves]
    ends = [each.end for each in moves]
    is_loose = {
        corner.name: bool(corner.guard) and any(abs(claimed.points.get(corner.at, at) - at) <= LENGTH for at in ends)
        for corner in case.profile.figure.corners
    }
    loose = [number for number, (name, turn) in enumerate(order) if is_loose.get(name, turn == LINE)]
    loose.sort(key=lambda number: order[number][0] not in is_loose)
    for dropped in combinations(loose, len(order) - len(turns)) if len(turns) <= len(order) else ():
        rest = [each for number, each in enumerate(order) if number not in dropped]
        if all(own == turn or (own == ANY_TURN and turn) for (_, own), turn in zip(rest, turns, strict=True)):
            yield {name: replace(each, name=name) for (name, _), each in zip(rest, moves, strict=True)}


def _values(case: Case, claimed: ClaimedMoves, reading: Mapping[str, Move]) -> Array:
    """The values of the unknowns that a claimed path tells, NaN for the others."""
    found, figure, here = dict[str, float](), case.profile.figure, 0j

    def put(name: str, at: complex) -> None:
        found[scalar(name, FIRST)], found[scalar(name, SECOND)] = at.real, at.imag

    cut = {corner.at for corner in figure.corners}
    for element in figure.path:
        own = reading.get(element.name)
        here = own.end if own else here
        if element.head not in cut:
            put(element.head, here)
        if own and own.circle and isinstance(element, Arc):
            put(element.center, own.circle.center)
            found[element.radius] = own.circle.radius
        elif own:
            along = own.end - own.start
            along = along / abs(along) if along else 1 + 0j
            offset = along.real * own.start.imag - along.imag * own.start.real
            found |= dict(zip(line_scalars(element.name), (along.real, along.imag, offset), strict=True))
        for corner in figure.corners:
            own = reading.get(corner.name) if corner.at == element.head else None
            if own:
                here = own.end
                put(f"{corner.name}.begin", own.start)
                put(f"{corner.name}.end", here)
                if own.circle:
                    put(f"{corner.name}.center", own.circle.center)
                    found[f"{corner.name}.radius"] = own.circle.radius
    for name, at in claimed.points.items():
        put(name, at)
    return numpy.array([found.get(name, numpy.nan) for name in case.system.unknowns])


def _completed(case: Case, told: Array) -> tuple[Array, dict[str, int]]:
    """The values of all unknowns, those that a path does not tell by the facts, and the sides that fit best."""
    system = case.system
    best: tuple[float, Array, dict[str, int]] = (inf, told, dict.fromkeys(system.sides, 1))
    for bits in range(min(2 ** len(system.sides), MOST_SIGNS)):
        signs = {side: 1 - 2 * (bits >> number & 1) for number, side in enumerate(system.sides)}
        for each in rank.fill(system, case.basis, told, signs, case.size):
            at = system.at(each, signs)
            off = float(abs(system.residuals(system.facts, each, signs)).sum())
            off += sum(max(0.0, -sense) for fact in system.facts for sense in senses(fact, at))
            best = min(best, (off, each, signs), key=lambda one: one[0])
    return best[1], best[2]


# --- What the words say of these values ------------------------------------------------------------


def _attempt(
    case: Case, claimed: ClaimedMoves, reading: Mapping[str, Move], *, is_chosen: bool
) -> tuple[Ledger, Array]:
    """The checks of a path if its elements are these."""
    ledger, limit, system, certificate = Ledger(), claimed.limit, case.system, claimed.path.certificate
    values, signs = _completed(case, _values(case, claimed, reading))
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
        what = f"{name.rpartition('.')[0] or name} is where the words put it"
        ledger.measure(what, words, by, limit + unsure)
        if certificate.radius is not None:
            allowed = CERTIFIED * max(0.0, certificate.radius) + PRINTED + ROUNDING * case.reach + unsure
            ledger.measure(f"the certificate's radius covers that {what}", words, by, allowed)
    values = values + moved.by
    for fact in case.spare:
        off, allowed = case.missed_by(fact, values, signs), allowance(case, fact, values, signs)
        if agrees(case, fact, values, signs):  # An angle may, by more than that over a long line.
            allowed = max(allowed, abs(off))
        ledger.measure(_name(case, fact), case.words([fact]), off, allowed)
    at, scalars = system.at(values, signs), case.scalars(values)
    for fact in case.basis:
        worst = min(senses(fact, at), default=0.0)
        ledger.require(f"{_name(case, fact)}, in its sense", case.words([fact]), worst >= -limit, "it is the opposite")
    _check_drawn(case, reading, scalars, limit + float(moved.unsure.max(initial=0.0)), ledger)
    for choice in case.profile.choices if is_chosen else ():
        given = case.profile.givens.get(choice.given)
        words = [given.word.text] if given and given.word else []
        is_right = is_on_side(case, scalars, choice)
        ledger.require(f"{choice.point} is the {choice.side.value} place", words, is_right, "it is the other one")
    return ledger, values


def _name(case: Case, fact: Fact) -> str:
    """What checks call a fact."""
    if fact.given.startswith("fact "):
        return "the fact holds"
    fields = {name: getattr(fact, name) for name in type(fact).__struct_fields__}  # type: ignore[attr-defined]
    axis = case.profile.plane.axes[fields["axis"]] if "axis" in fields else ""
    return MEANINGS[type(fact)].name.format_map({**fields, "axis": axis})


def _check_drawn(
    case: Case, reading: Mapping[str, Move], scalars: Mapping[str, float], limit: float, ledger: Ledger
) -> None:
    """The claimed elements are those that are drawn here between the points."""
    drawn, givens = case.draw(scalars), case.profile.givens
    sizes = [givens[corner.size].word for corner in case.profile.figure.corners if corner.size in givens]
    words = [word.text for word in sizes if word]
    if not ledger.require("the elements and corners can be made", words, not drawn.against, "; ".join(drawn.against)):
        return
    names = [move.name for move in drawn.moves]
    if not ledger.require(
        "the elements are those that have a length", (), names == [*reading], f"these have: {', '.join(names)}"
    ):
        return
    for move, claimed in zip(drawn.moves, reading.values(), strict=True):
        name = move.name
        ledger.measure(f"{name} begins where it is drawn", (), abs(claimed.start - move.start), 2 * limit)
        ledger.measure(f"{name} ends where it is drawn", (), abs(claimed.end - move.end), 2 * limit)
        if claimed.circle and move.circle:
            off, wider = abs(claimed.circle.center - move.circle.center), claimed.circle.radius - move.circle.radius
            ledger.measure(f"{name} has its centre where it is drawn", (), off, 2 * limit)
            ledger.measure(f"radius of {name}", (), wider, 2 * limit)
            is_right = claimed.circle.turn == move.circle.turn
            ledger.require(f"{name} turns as the path does", (), is_right, "it turns the other way")


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


def check_asked(case: Case, path: ClaimedPath, values: Array, ledger: Ledger) -> None:
    """Every question has its answer, which is that of the elements."""
    rest, signs = list(path.asked), dict.fromkeys(case.system.sides, 1)
    at, name = case.system.at(values, signs), "the answer is the value that the elements have"
    for question in case.profile.questions:
        label, key = [case.label(question.word)], (question.word.text, question.word.span.line)
        answer = next((each for each in rest if (each.word, each.line) == key), None)
        is_there = answer is not None
        ledger.require("the result answers what is asked for", label, is_there, "the result does not mention it")
        if answer is None:
            continue
        rest.remove(answer)
        value, is_angle, reach = measured(question.fact, at)
        unit = "deg" if is_angle else "mm"
        if rank.correct(case.system, case.basis, values, signs, RESIDUAL, inf).is_hidden:
            ledger.omit(label[0], "several solutions have become one there")
        elif is_angle and reach <= LENGTH:
            ledger.omit(label[0], "what has no length has no direction")
        elif answer.value is None:
            ledger.require(name, label, passed=False, remark=f"it is {value:g} {unit}, and the result has none")
        elif ledger.require("its unit is what it measures", label, answer.unit == unit, f"it is not {unit}"):
            limit, off = moves_of(case, path).limit, answer.value - value
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
    paths = [each.path.moves for each in made if each.is_chosen and each.is_path]
    own_moves = moves_of(case, claimed)
    off = [
        max(abs(a.end - b.end) for a, b in zip(each, own_moves.moves, strict=True))
        for each in paths
        if len(each) == len(own_moves.moves)
    ]
    if ledger.require(name, texts, bool(off), f"they make {len(paths)}"):
        limit = own_moves.limit + ROUNDING * case.size
        ledger.measure("they deviate as much as the result says", texts, min(off) - filled.deviation_mm, limit)


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
