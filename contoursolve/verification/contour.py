"""One contour of a result against its block: its status, its path if it claims one, and all that it lists."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from itertools import combinations, islice
from math import degrees, floor, hypot, inf, log10

import numpy

from contoursolve import syntax
from contoursolve.constraints import Coordinate, OnCircle
from contoursolve.model import (
    FIRST,
    SECOND,
    Arc,
    Choice,
    CornerShape,
    Fact,
    Unit,
    line_scalars,
    scalar,
)
from contoursolve.reading import Claim, Selector, unused_words
from contoursolve.statements import apply_statements
from contoursolve.syntax import Block, Word
from contoursolve.tolerance import AGREEMENT, ERROR_BOUND_WARNING, LENGTH, RESIDUAL
from contoursolve.verification import rank
from contoursolve.verification.decode import (
    ClaimedArc,
    ClaimedAsked,
    ClaimedCertificate,
    ClaimedContour,
    ClaimedDiagnosis,
    ClaimedLine,
    ClaimedPath,
    ClaimedSolution,
)
from contoursolve.verification.path import Circle, Move, draw, side_of
from contoursolve.verification.receipt import Ledger
from contoursolve.verification.residuals import Array, measured, residual, senses
from contoursolve.verification.standing import (
    EPSILON,
    FEW,
    PRINTED,
    ROUNDING,
    Candidate,
    Case,
    Found,
    LooseError,
    agrees,
    allowance,
    band,
    candidates,
    expected,
    is_on_side,
    prepare,
)

CERTIFIED = 4
"""1. A residual that compares a point with three others may be off by the error of all four of them."""

MOST_SIGNS = 64
"""Ways to choose the sides on which elements touch that are looked at."""

LOOSE = ("underdetermined", "no-solution", "undecided")
"""What a contour may be whose words leave points free at their values alone."""


def examine(case: Case, path: ClaimedPath, ledger: Ledger, *, is_chosen: bool) -> Array | None:
    """Check a claimed path; the values of all unknowns in it, None where it is no path of this figure.

    One that `is_chosen` must be on the sides that words choose, too.
    """
    _check_joints(case, path, ledger)
    check_certificate(case, path.certificate, ledger)
    if not ledger.require(
        "the words fix the points", case.words(case.profile.facts), case.is_determined, "they do not"
    ):
        return None
    attempts = [(_attempt(case, path, reading, is_chosen=is_chosen)) for reading in islice(_readings(case, path), 8)]
    own, values = min(attempts, key=lambda each: len(each[0].failures), default=(Ledger(), None))
    names = ", ".join(name for name, _ in _order(case))
    found = ", ".join(type(each).__name__.removeprefix("Claimed").lower() for each in path.elements)
    ledger.require(f"the elements are {names}", (), bool(attempts), f"the result has {found or 'none'}")
    ledger.add(own)
    return values


def _place(case: Case, at: tuple[float, float]) -> complex:
    first, second = (float(Decimal(value) - start) for value, start in zip(at, case.sheet.origin, strict=True))
    return complex(first, second)


def _grain(path: ClaimedPath) -> float:
    """Half of the last decimal, mm, if the numbers have only as many as the certificate's radius leaves a meaning."""
    radius = path.certificate.radius
    if not radius or not PRINTED < radius <= ERROR_BOUND_WARNING:
        return 0.0
    decimals, numbers = floor(-log10(radius)), [value for at in path.points.values() for value in at]
    for each in path.elements:
        numbers += [*each.start, *each.end, *((*each.center, each.radius) if isinstance(each, ClaimedArc) else ())]
    return 0.5 * 10.0**-decimals if all(round(value, decimals) == value for value in numbers) else 0.0


def _limit(case: Case, path: ClaimedPath) -> float:
    """What a residual may be, mm: 1e-9, the rounding of the coordinates, and the decimals that are left out."""
    numbers = [abs(value) for each in path.elements for at in (each.start, each.end) for value in at]
    return RESIDUAL + ROUNDING * max([_reach(case), *numbers]) + 4 * _grain(path)


def _reach(case: Case) -> float:
    return case.size + float(max(map(abs, case.sheet.origin)))


def _check_joints(case: Case, path: ClaimedPath, ledger: Ledger) -> None:
    """What holds for every path, whatever its form: no gaps, nothing without length, arcs on their circles."""
    limit, here, name = _limit(case, path), 0j, "the start"
    names = [point for point in case.profile.figure.points if point in case.profile.intersections]
    wanted, has = ", ".join(names) or "none", ", ".join(sorted(map(ascii, path.points))) or "none"
    ledger.require(f"the points are {wanted}", (), path.points.keys() == set(names), f"the result has {has}")
    slack = max((fact.slack for fact in case.spare if isinstance(fact, OnCircle)), default=0.0)
    for number, each in enumerate(path.elements, 1):
        own, start, end = f"element {number}", _place(case, each.start), _place(case, each.end)
        ledger.measure(f"{own} begins at {name}", (), abs(start - here), limit)
        length = abs(end - start)
        ledger.require(f"{own} has a length", (), length >= LENGTH - 2 * PRINTED, f"it is {length:.3g} mm long")
        if isinstance(each, ClaimedArc):
            center = _place(case, each.center)
            ledger.require(f"{own} has a radius", (), each.radius > 0, f"it is {each.radius:g} mm")
            ledger.measure(f"{own} begins on its circle", (), abs(start - center) - each.radius, limit + slack)
            ledger.measure(f"{own} ends on its circle", (), abs(end - center) - each.radius, limit + slack)
        here, name = end, f"the end of {own}"
    if ledger.require("the result says where the contour ends", (), path.end is not None, "end is null") and path.end:
        ledger.measure(f"the contour ends at {name}", (), abs(_place(case, path.end) - here), limit)


CERTIFICATE_KINDS = ("exact", "unique", "verified", "unknown")


def check_certificate(case: Case, certificate: ClaimedCertificate, ledger: Ledger) -> None:
    """What can be said of a certificate alone; its radius is held against every point that is worked out."""
    kind, radius = certificate.kind, certificate.radius
    ledger.require("the certificate is of a known kind", (), kind in CERTIFICATE_KINDS, f"it is {ascii(kind)[:60]}")
    if kind == "unknown":
        ledger.require("the certificate says why it proves nothing", (), bool(certificate.reason), "there is no reason")
    if certificate.double is not None and certificate.double.gap_mm is not None:
        limit = RESIDUAL + ROUNDING * _reach(case)
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


def _order(case: Case) -> list[tuple[str, str]]:
    """Every element and corner of the path with its kind: `line`, the turn of an arc, or `arc` for a rounding."""
    found = []
    for element in case.profile.figure.path:
        found.append((element.name, element.turn.value if isinstance(element, Arc) else "line"))
        corners = [each for each in case.profile.figure.corners if each.at == element.head]
        found += [(each.name, "arc" if each.shape is CornerShape.FILLET else "line") for each in corners]
    return found


Reading = dict[str, "ClaimedLine | ClaimedArc"]


def _readings(case: Case, path: ClaimedPath) -> Iterator[Reading]:
    """Every way in which the claimed elements can be those of the figure: lines of no length are left out."""
    order = _order(case)
    kinds = [each.turn if isinstance(each, ClaimedArc) else "line" for each in path.elements]
    lines = [number for number, (name, kind) in enumerate(order) if kind == "line" and not name.startswith("corner")]
    for dropped in combinations(lines, len(order) - len(kinds)) if len(kinds) <= len(order) else ():
        rest = [each for number, each in enumerate(order) if number not in dropped]
        if all(want == kind or (want == "arc" and kind != "line") for (_, want), kind in zip(rest, kinds, strict=True)):
            yield {name: each for (name, _), each in zip(rest, path.elements, strict=True)}


def _assigned(case: Case, path: ClaimedPath, reading: Reading) -> dict[str, float]:
    """The unknowns that a claimed path tells."""
    found: dict[str, float] = {}

    def put(name: str, at: complex) -> None:
        found[scalar(name, FIRST)], found[scalar(name, SECOND)] = at.real, at.imag

    figure, here = case.profile.figure, 0j
    cut = {corner.at for corner in figure.corners}
    for element in figure.path:
        own = reading.get(element.name)
        here = _place(case, own.end) if own else here
        if element.head not in cut:
            put(element.head, here)
        if isinstance(own, ClaimedArc) and isinstance(element, Arc):
            put(element.center, _place(case, own.center))
            found[element.radius] = own.radius
        elif own:
            along = _place(case, own.end) - _place(case, own.start)
            along = along / abs(along) if along else 1 + 0j
            begin = _place(case, own.start)
            offset = along.real * begin.imag - along.imag * begin.real
            found |= dict(zip(line_scalars(element.name), (along.real, along.imag, offset), strict=True))
    for corner in figure.corners:
        own = reading.get(corner.name)
        if own:
            here = _place(case, own.end)
            put(f"{corner.name}.begin", _place(case, own.start))
            put(f"{corner.name}.end", here)
            if isinstance(own, ClaimedArc):
                put(f"{corner.name}.center", _place(case, own.center))
                found[f"{corner.name}.radius"] = own.radius
    for name, at in path.points.items():
        put(name, _place(case, at))
    return {name: value for name, value in found.items() if name in case.sheet.unknowns}


def _completed(case: Case, known: Mapping[str, float]) -> tuple[Array, dict[str, int]]:
    """The values of all unknowns, those that a path does not tell by the facts, and the sides that fit best."""
    sheet = case.sheet
    values = numpy.array([known.get(name, 0.0) for name in sheet.unknowns])
    free = numpy.array([name not in known for name in sheet.unknowns])
    best: tuple[float, Array, dict[str, int]] = (inf, values, dict.fromkeys(sheet.sides, 1))
    for bits in range(min(2 ** len(sheet.sides), MOST_SIGNS)):
        signs = {side: 1 - 2 * (bits >> number & 1) for number, side in enumerate(sheet.sides)}
        tried = rank.fill(sheet, case.basis, values, signs, free, case.size) if free.any() else [values]
        for each in tried:
            at = sheet.at(each, signs)
            off = float(abs(sheet.residuals(sheet.facts, each, signs)).sum())
            off += sum(max(0.0, -sense) for fact in sheet.facts for sense in senses(fact, at))
            best = min(best, (off, each, signs), key=lambda one: one[0])
    return best[1], best[2]


NAMES: Mapping[str, str] = {
    "ArcContact": "{point} is where the rounding touches the arc",
    "ArcLength": "length of the arc from {tail} to {head}",
    "ChamferLeg": "extent of the bevel from {begin} to {end} along {axis}",
    "ChordSetback": "{point} is its size away from {corner}",
    "Collinear": "{point} is on the line from {tail} through {through}",
    "Contact": "{point} is in line with {first} and {second}",
    "Coordinate": "{axis} of {point}",
    "Directed": "direction of {line}",
    "Distance": "distance from {tail} to {head}",
    "EqualDistances": "both lines are equally long",
    "EqualRadii": "{first} is {second}",
    "Extent": "length of {line} from {tail} to {head}",
    "Foot": "{point} is where {line} is touched",
    "Heading": "direction of the line from {tail} to {head}",
    "Level": "{axis} of {point} is that of {origin}",
    "Offset": "{axis} from {origin} to {point}",
    "OnCircle": "{point} is on the circle about {center}",
    "Parallel": "{line} is parallel to {axis}",
    "Radius": "radius {radius}",
    "Setback": "{point} is its size away from {corner}",
    "TangentArc": "the rounding about {center} touches the arc",
    "TangentCircles": "both circles touch",
    "TangentLine": "{line} touches the circle about {center}",
    "Through": "{line} passes through {point}",
    "TurnBetween": "the angle between both elements",
    "UnitDirection": "{line} has one direction",
}
"""What checks call facts, by their kinds."""


def _name(case: Case, fact: Fact) -> str:
    if fact.given.startswith("fact "):
        return "the fact holds"
    fields = {name: getattr(fact, name) for name in type(fact).__dataclass_fields__}  # type: ignore[attr-defined]
    axis = case.profile.plane.axes[fields["axis"]] if "axis" in fields else ""
    return NAMES[type(fact).__name__].format_map({**fields, "axis": axis})


def _attempt(case: Case, path: ClaimedPath, reading: Reading, *, is_chosen: bool) -> tuple[Ledger, Array]:
    """The checks of a path if its elements are these."""
    ledger, limit, sheet = Ledger(), _limit(case, path), case.sheet
    values, signs = _completed(case, _assigned(case, path, reading))
    noise = ROUNDING * case.size + case.start_error + 2 * _grain(path) + EPSILON * _reach(case)
    hides = inf if path.certificate.double is not None else band(case) / FEW
    moved = rank.correct(sheet, case.basis, values, signs, noise, hides)
    for fact, off in zip(case.basis, sheet.residuals(case.basis, values, signs).tolist(), strict=True):
        ledger.measure(_name(case, fact), case.words([fact]), off, limit + noise)
    if moved.is_hidden or moved.is_open:
        ledger.omit("how far the points may be off", "several solutions have become one there")
    if moved.fold is not None:
        ledger.measure("two solutions have become one", (), moved.fold, limit + 1e3 * noise)
    exact = case.scalars(values + moved.by)
    certificate = path.certificate.radius
    for number, name in enumerate(sheet.unknowns):
        unsure, words = float(moved.unsure[number]), case.words(_about(case, name))
        what = f"{name.rpartition('.')[0] or name} is where the words put it"
        ledger.measure(what, words, float(moved.by[number]), limit + unsure)
        if certificate is not None:
            allowed = CERTIFIED * max(0.0, certificate) + PRINTED + ROUNDING * _reach(case) + unsure
            ledger.measure(f"the certificate's radius covers that {what}", words, float(moved.by[number]), allowed)
    at = sheet.at(values + moved.by, signs)
    for fact in case.spare:
        off = float(residual(fact, sheet.at(values + moved.by, {**dict.fromkeys(fact.sides(), 1), **signs})))
        limit_here = allowance(case, fact, values, signs)
        if agrees(case, fact, values + moved.by, signs):  # An angle may, by more than that over a long line.
            limit_here = max(limit_here, abs(off))
        ledger.measure(_name(case, fact), case.words([fact]), off, limit_here)
    for fact in case.basis:
        worst = min(senses(fact, at), default=0.0)
        ledger.require(f"{_name(case, fact)}, in its sense", case.words([fact]), worst >= -limit, "it is the opposite")
    _check_drawn(case, reading, exact, limit + float(moved.unsure.max(initial=0.0)), ledger)
    for choice in case.profile.choices if is_chosen else ():
        word = case.profile.givens.get(choice.given)
        words = [word.word.text] if word and word.word else []
        is_right = is_on_side(case, exact, choice)
        ledger.require(f"{choice.point} is the {choice.side.value} place", words, is_right, "it is the other one")
    return ledger, values + moved.by


def _about(case: Case, name: str) -> list[Fact]:
    return [fact for fact in case.basis if name in fact.reads() and fact.given]


def _check_drawn(case: Case, reading: Reading, exact: Mapping[str, float], limit: float, ledger: Ledger) -> None:
    """The claimed elements are those that are drawn here between the points."""
    steps = (case.increment(str(FIRST)), case.increment(str(SECOND)))
    drawn = draw(case.sheet, exact, case.sizes(exact), steps)
    sizes = [corner.size for corner in case.profile.figure.corners if corner.size in case.profile.givens]
    words = [word.text for size in sizes if (word := case.profile.givens[size].word)]
    if not ledger.require("the elements and corners can be made", words, not drawn.against, "; ".join(drawn.against)):
        return
    moves = {move.name: move for move in drawn.moves}
    is_same = [*moves] == [*reading]
    if not ledger.require("the elements are those that have a length", (), is_same, f"these have: {', '.join(moves)}"):
        return
    for name, each in reading.items():
        move = moves[name]
        _check_move(case, move, each, limit, ledger)


def _check_move(case: Case, move: Move, claimed: ClaimedLine | ClaimedArc, limit: float, ledger: Ledger) -> None:
    ledger.measure(
        f"{move.name} begins where it is drawn", (), abs(_place(case, claimed.start) - move.start), 2 * limit
    )
    ledger.measure(f"{move.name} ends where it is drawn", (), abs(_place(case, claimed.end) - move.end), 2 * limit)
    if isinstance(claimed, ClaimedArc) and isinstance(move.circle, Circle):
        center, turn = _place(case, claimed.center), {"ccw": 1, "cw": -1}[claimed.turn]
        ledger.measure(f"{move.name} has its centre where it is drawn", (), abs(center - move.circle.center), 2 * limit)
        ledger.measure(f"radius of {move.name}", (), claimed.radius - move.circle.radius, 2 * limit)
        ledger.require(f"{move.name} turns as the path does", (), turn == move.circle.turn, "it turns the other way")


# --- The contour as a whole ---------------------------------------------------------------------------


def check_contour(found: Found, claimed: ClaimedContour) -> tuple[Ledger, bool]:
    """The checks of one contour, and whether a path or its status was among what was checked."""
    ledger = Ledger()
    with numpy.errstate(all="ignore"):
        try:
            is_checked = _check_contour(found, claimed, ledger)
        except numpy.linalg.LinAlgError:
            ledger.omit("the rest of the contour", "its numbers are too far from any solution to be worked with")
            is_checked = False
    return ledger, is_checked


def _check_contour(found: Found, claimed: ClaimedContour, ledger: Ledger) -> bool:
    claim = found.claim
    _check_place(claim, claimed, ledger)
    case = prepare(found, claim)
    for text in (each.text for each in claim.directives if each.span.line < -found.apart):
        ledger.omit(f"the fact {text}", "stated in the result only: checked, but not known from the program")
    values: Array | None = None
    if claimed.has_path:
        why = case.statuses.get("rejected") or ("" if case.is_readable else case.statuses.get("underdetermined", ""))
        ledger.require("every word and fact can be read", (), case.is_readable, why)
        if case.is_readable and case.profile.start.is_known:
            values = examine(case, claimed, ledger, is_chosen=True)
            if values is not None:
                _check_branches(case, claimed, values, ledger)
                _check_asked(case, claimed, values, ledger)
                _check_filled(found, case, claimed, ledger)
    else:
        _check_bare(claimed, ledger)
    listed = [_examine_listed(case, claimed, number, values, ledger) for number in range(len(claimed.solutions))]
    near = [each for each in (values, *listed) if each is not None]
    _check_told(case, claimed, listed, ledger)
    if ledger.failures:
        ledger.omit("the status, and whether there are other solutions", "what is claimed is wrong in itself")
        return False
    solutions: list[Candidate] = []
    status: str | None = None
    try:
        if case.is_readable and case.is_determined and case.profile.start.is_known:
            solutions = candidates(case, near)
        status, why = expected(case, solutions)
    except LooseError:
        is_right = claimed.status in LOOSE
        ledger.require("the words leave points free at their values", (), is_right, f"it is {claimed.status}")
        why = "the words leave points free at their values, and there may be other solutions"
    is_checked = status is not None
    if status is None:
        ledger.omit("the status", why)
    else:
        remark = f"the result says {claimed.status}, and by the words it is {status}: {why}"
        words = [case.label(word) for word in claim.words.values()]
        ledger.require("the status is the one that the words give", words, claimed.status == status, remark)
    if status == "rejected":
        ledger.omit("why it is rejected", "the rules of the manual are read from the same tables")
    elif status == "no-solution" and case.is_determined and not rank.is_linear(case.sheet):
        ledger.omit("whether there is a solution after all", "a search found none, which is no proof")
    ignored = case.profile.words_of(case.profile.ignored)
    for word in (*ignored, *unused_words(claim, case.profile)):
        if case.is_readable:
            ledger.omit(word.text, "the control does not use it for this contour")
    _check_count(case, claimed, solutions, ledger)
    _check_diagnosis(case, claimed.diagnosis, solutions, ledger)
    return is_checked or values is not None


def _check_place(claim: Claim, claimed: ClaimedContour, ledger: Ledger) -> None:
    """Where the contour is, and what its blocks say apart from its geometry."""
    lines, plane, form = tuple(block.line for block in claim.blocks), claim.after.plane.axes, claim.form.name
    told, has = (", ".join(map(str, each)) or "none" for each in (lines, claimed.lines))
    shown = f"they are lines {told}, and the result has {has}"
    ledger.require("the lines are those of its blocks", (), claimed.lines == lines, shown)
    remark = f"it is {form}, and the result has {ascii(claimed.form)[:60]}"
    ledger.require("the form is that of its blocks", (), claimed.form == form, remark)
    remark = f"it is {' '.join(plane)}, and the result has {' '.join(map(ascii, claimed.plane))[:60]}"
    ledger.require("the plane is the one in force", (), claimed.plane == plane, remark)
    for axis, known, value in zip(claim.before.plane.axes, claim.before.start().values, claimed.start, strict=True):
        name = f"{axis} of the start is the program's position"
        if known is not None and value is not None:
            ledger.measure(name, (), value - float(known), RESIDUAL + ROUNDING * abs(float(known)))
            continue
        remark = f"the program is at {known} mm, and the result has none"
        if known is None and value is not None:
            remark = f"the program does not tell it, and the result has {value:g} mm; "
            remark += "if it was solved with --start, verify with the same --start"
        ledger.require(name, (), known is None and value is None, remark)
    texts = list((Counter(each.text for each in claim.directives) - Counter(claimed.facts)).elements())
    ledger.require("the result lists the facts of the program", texts, not texts, "it does not")
    known_ones = sorted((each.setting.name, each.value) for each in claim.conventions)
    others = sorted((each.setting, each.value) for each in claimed.conventions)
    told, has = (", ".join(f"{name}={value}" for name, value in each) or "none" for each in (known_ones, others))
    remark = f"they are {told}, and the result has {has}"
    ledger.require("the conventions are those in force", (), known_ones == others, remark)
    places = [(word.text, word.span.line) for word in claim.words.values() if word.is_asked]
    places += [(each.text, each.span.line) for each in claim.directives]
    for asked in (each for path in (claimed, *claimed.solutions) for each in path.asked):
        is_known = (asked.word, asked.line) in places
        ledger.require("what is answered is asked there", [asked.word], is_known, f"it is not on line {asked.line}")


def _check_bare(claimed: ClaimedContour, ledger: Ledger) -> None:
    """A contour without a path claims nothing else that only a path has."""
    ledger.omit("the path", f"claimed {claimed.status}: there is none to check")
    remark = f"it is {claimed.status}, with a path"
    ledger.require("a contour with this status has no path", (), claimed.is_empty, remark)
    given = (claimed.certificate.radius, claimed.certificate.double, claimed.branch, claimed.branches or None)
    is_bare = all(each is None for each in given)
    ledger.require("without a path nothing is certified or chosen", (), is_bare, "the result does so")
    values = [each.word for each in claimed.asked if each.value is not None]
    ledger.require("without a path no value is known", values, not values, "the result answers what is asked for")
    ledger.require("without a path nothing is filled in", (), claimed.filled is None, "there are filled blocks")


def _check_branches(case: Case, claimed: ClaimedContour, values: Array, ledger: Ledger) -> None:
    """The branches are the sides that words choose, but for points where both places are one."""
    scalars, wanted, open_ones = case.scalars(values), {}, set[str]()
    for choice in case.profile.choices:
        side = side_of(case.sheet, scalars, choice)
        if choice.given and choice.point in case.profile.intersections and side is not None:
            width = band(case)
            if width / FEW < side[1] <= FEW * width:
                open_ones.add(choice.point)
            if side[1] > width / FEW:
                wanted[choice.point] = choice.side.value
    found = {name: side for name, side in claimed.branches.items() if name not in open_ones or side != wanted.get(name)}
    rest = {name: side for name, side in wanted.items() if name not in open_ones}
    told = ", ".join(f"{name} {side}" for name, side in rest.items()) or "none"
    ledger.require("the branches are those that words choose", (), found == rest, f"they are {told}")
    joined = ", ".join(claimed.branches.values()) or None
    ledger.require("the branch is that of the branches", (), claimed.branch == joined, f"they are {joined}")


def _check_asked(case: Case, path: ClaimedPath, values: Array, ledger: Ledger) -> None:
    """Every question has its answer, which is that of the elements."""
    rest, signs = list(path.asked), dict.fromkeys(case.sheet.sides, 1)
    at = case.sheet.at(values, signs)
    for question in case.profile.questions:
        label, key = [case.label(question.word)], (question.word.text, question.word.span.line)
        answer = next((each for each in rest if (each.word, each.line) == key), None)
        remark = "the result does not mention it"
        if not ledger.require("the result answers what is asked for", label, answer is not None, remark) or not answer:
            continue
        rest.remove(answer)
        value, is_angle, reach = measured(question.fact, at)
        name, unit = "the value that is asked for is that of the elements", "deg" if is_angle else "mm"
        hidden = rank.correct(case.sheet, case.basis, values, signs, RESIDUAL, inf).is_hidden
        if hidden:
            ledger.omit(label[0], "several solutions have become one there")
        elif is_angle and reach <= LENGTH:
            ledger.omit(label[0], "what has no length has no direction")
        elif answer.value is None:
            ledger.require(name, label, passed=False, remark=f"it is {value:g} {unit}, and the result has none")
        elif ledger.require("its unit is what it measures", label, answer.unit == unit, f"it is not {unit}"):
            limit = _limit(case, path) + (degrees((2 * PRINTED + ROUNDING * _reach(case)) / reach) if is_angle else 0.0)
            off = answer.value - value
            ledger.measure(name, label, (off + 180) % 360 - 180 if is_angle else off, limit, unit)
    ledger.require(
        "the program asks for what the result answers", [each.word for each in rest], not rest, "it does not"
    )


def _examine_listed(
    case: Case, claimed: ClaimedContour, number: int, exact: Array | None, ledger: Ledger
) -> Array | None:
    """One solution of the list; the values of its unknowns, if it is a path. `exact` are those of the contour."""
    solution, own = claimed.solutions[number], Ledger()
    values: Array | None = None
    if exact is not None and solution.is_chosen and solution.is_path and _is_same(solution, claimed):
        return exact  # It is the contour, and that is checked.
    if not solution.is_path:
        check_certificate(case, solution.certificate, own)
        own.require("it has no path", (), solution.is_empty, "it claims to be none")
        own.require("it has a reason against it", (), bool(solution.reasons), "none is named")
        answers = [asked.word for asked in solution.asked if asked.value is not None]
        own.require("it answers nothing", answers, not answers, "it has no path")
    elif own.require("it has a path", (), not solution.is_empty, "it claims to be one") and case.is_readable:
        values = examine(case, solution, own, is_chosen=solution.is_chosen)
        if values is not None:
            _check_asked(case, solution, values, own)
    elif not case.is_readable:
        own.require("every word and fact can be read", (), passed=False, remark="they cannot")
    ledger.add(own, f"solution {number + 1}: ")
    return values


def _check_count(case: Case, claimed: ClaimedContour, found: Sequence[Candidate], ledger: Ledger) -> None:
    """The list has at least as many solutions as a search finds."""
    count = claimed.count
    if count is not None and found and count.is_complete:
        there, makeable = len(found), sum(each.is_path for each in found)
        remark = f"the result has {count.solutions}, of which {count.contours} can be made, and a search found "
        remark += f"at least {there}, of which {makeable} can be made"
        is_all = count.solutions >= there and count.contours >= makeable
        words = [word.text for word in case.claim.words.values()]
        ledger.require("the solutions are at least those that are found", words, is_all, remark)
    if count is not None:
        ledger.omit("whether these are all solutions", "a search found no others, which is no proof")


def _check_told(case: Case, claimed: ClaimedContour, values: Sequence[Array | None], ledger: Ledger) -> None:
    """The list of solutions: their number, which are told apart by what, which one is the contour."""
    listed, count = claimed.solutions, claimed.count
    paths = [number for number, each in enumerate(listed) if each.is_path]
    if count is None:
        is_right = not listed and not claimed.has_path
        ledger.require("a list of solutions comes with their number", (), is_right, "the number is missing")
    else:
        remark = f"there are said to be {count.solutions}, and {len(listed)} are listed"
        ledger.require("all solutions are listed", (), count.solutions == len(listed), remark)
        remark = f"there are said to be {count.contours}, and {len(paths)} are listed"
        ledger.require("all paths are listed", (), count.contours == len(paths), remark)
        is_told = count.is_complete != bool(count.doubts)
        ledger.require("the list is complete unless there is a doubt", (), is_told, "it is both")
        words = [word.text for word in case.claim.words.values()]
        parts = count.chosen_by.split(" and ") if count.chosen_by else []
        is_known = all(part in words for part in parts)
        ledger.require("what chooses is a word of the program", parts, is_known, "the program does not have it")
    for one, other in combinations(paths, 2):
        first, second = values[one], values[other]
        apart = first is not None and second is not None and float(abs(first - second).max(initial=0.0)) > 10 * RESIDUAL
        ledger.require(f"solutions {one + 1} and {other + 1} are two", (), apart, "they are the same path")
        selects = bool(listed[one].selects and listed[one].selects == listed[other].selects)
        name = f"solutions {one + 1} and {other + 1} are told apart"
        ledger.require(name, listed[one].selects, not selects, "the same words select both")
    _check_selectors(case, [(listed[each].selects, values[each]) for each in paths], ledger)
    for number in paths:
        _check_selects(case, listed[number], values[number], [listed[each] for each in paths if each != number], ledger)
    chosen = [each for each in listed if each.is_chosen]
    if not claimed.has_path:
        ledger.require("no solution is chosen", (), not chosen, f"it is {claimed.status}, with {len(chosen)} chosen")
    elif count is not None and ledger.require("one solution is chosen", (), len(chosen) == 1, f"{len(chosen)} are"):
        own, its = [*_numbers(claimed)], [*_numbers(chosen[0])]
        off = max((abs(a - b) for a, b in zip(own, its, strict=True)), default=0.0) if len(own) == len(its) else inf
        limit = _limit(case, claimed) + _limit(case, chosen[0])
        ledger.measure("the solution that is chosen is the contour", (), off, limit)


def _is_same(solution: ClaimedPath, contour: ClaimedPath) -> bool:
    """Whether two paths have the same numbers and answers, to the last digit."""
    both = [(each.end, each.points, each.elements, each.certificate, each.asked) for each in (solution, contour)]
    return both[0] == both[1]


def _numbers(path: ClaimedPath) -> Iterator[float]:
    """Every number of a path and of what it answers, in one order."""
    for name in sorted(path.points):
        yield from path.points[name]
    for each in path.elements:
        yield from (*each.start, *each.end, *((*each.center, each.radius) if isinstance(each, ClaimedArc) else ()))
    yield from (each.value for each in path.asked if each.value is not None)


def _check_selectors(case: Case, paths: Sequence[tuple[tuple[str, ...], Array | None]], ledger: Ledger) -> None:
    """Words that choose between places select every solution that has those places, point by point in one order."""
    words = {each.word for each in case.claim.selectors}
    own: list[tuple[tuple[str, ...], list[Selector]]] = []
    for selects, values in paths:
        if values is not None and selects and words.issuperset(selects):
            scalars = case.scalars(values)
            own.append((selects, [each for each in case.claim.selectors if _is_selected(case, scalars, each)]))
    points = list(dict.fromkeys(each.point for each in case.claim.selectors))
    differing = (each for size in range(len(points) + 1) for each in combinations(points, size))
    is_right = any(
        all(selects == tuple(each.word for each in true if each.point in some) for selects, true in own)
        for some in islice(differing, 1 << 10)
    )
    if own:
        texts = [word for selects, _ in own for word in selects]
        ledger.require("words select the solutions that have their places", texts, is_right, "they select others")


def _is_selected(case: Case, scalars: Mapping[str, float], selector: Selector) -> bool:
    side = side_of(case.sheet, scalars, Choice(selector.point, selector.side, ""))
    return side is not None and side[0] > 0 and side[1] > band(case) / FEW


SHOWN = 0.5e-3
"""Half of the last decimal of a coordinate that selects a solution, in the program's unit, X as diameter."""


def _check_selects(
    case: Case, solution: ClaimedSolution, values: Array | None, others: Sequence[ClaimedSolution], ledger: Ledger
) -> None:
    """What selects a solution is true of it: a word that chooses its side, the value that it answers, or a coordinate
    that no other one has."""
    claim, unit = case.claim, case.claim.after.unit
    if values is None:
        return
    for text in solution.selects:
        name, truths = "what selects a solution is true of it", list[bool]()
        if any(each.word == text for each in claim.selectors):
            continue
        block = syntax.parse_block(text, 1)
        for word in block.words:
            given = claim.lexicon.given(word.address, word, unit) if word.address in claim.lexicon.addresses else None
            answers = [each for each in solution.asked if given and each.word[: len(word.address)] == word.address]
            limit = half_increment(case, word) + RESIDUAL
            truths += [
                given is not None and abs((each.value or 0.0) - float(_sized(given.value, word))) <= limit
                for each in answers
            ]
        for directive in block.directives if not truths else ():
            facts, faults = apply_statements(replace(case.profile, is_extended=True), [directive], lambda: None)
            fact = facts.facts[-1] if not faults else None
            if isinstance(fact, Coordinate) and fact.point in solution.points:
                limit = SHOWN * float(unit.in_mm) / (2 if case.profile.plane.diameters[fact.axis] else 1) + RESIDUAL
                value = float(facts.givens[fact.given].value)
                truths.append(abs(solution.points[fact.point][fact.axis] - value) <= limit)
                places = [each.points[fact.point][fact.axis] for each in others if fact.point in each.points]
                truths.append(all(abs(each - value) > limit for each in places))
            elif isinstance(fact, Coordinate):
                ledger.omit(text, "what selects a solution is about a point that the result does not list")
                truths.append(True)
        ledger.require(name, [text], bool(truths) and all(truths), "it is not")


def _sized(value: Decimal, word: Word) -> Decimal:
    """The value of a word without the sign that only chooses."""
    return abs(value) if word.address == "R" else value


def half_increment(case: Case, word: Word) -> float:
    """Half of the least increment of a word, mm (radius) or degrees."""
    lexicon, unit = case.claim.lexicon, case.claim.after.unit
    row = lexicon.addresses.get(word.address)
    step = lexicon.numbers.step(row.unit, unit) if row else Decimal(0)
    scale = unit.in_mm if row and row.unit is not Unit.DEGREE and unit.in_mm != 1 else 1
    return float(step * scale) / (4 if row and row.is_diameter else 2)


SAME = "the filled blocks differ from the program's only where a value is asked for"


def _check_filled(found: Found, case: Case, claimed: ClaimedContour, ledger: Ledger) -> None:
    """The filled blocks: the same text with rounded values, which alone make nearly the same contour."""
    filled, blocks, claim = claimed.filled, case.claim.blocks, case.claim
    if filled is None:
        return
    texts = [word.text for block in blocks for word in block.words if word.is_asked]
    if not ledger.require("a value is asked for", texts, bool(texts), "nothing was to be filled in"):
        return
    own = [syntax.parse_block(text, block.line) for text, block in zip(filled.blocks, blocks, strict=False)]
    is_same = len(filled.blocks) == len(blocks) and all(map(_is_filled, blocks, own))
    if not ledger.require(SAME, texts, is_same, "something else was changed, or a value is missing"):
        return
    for block, new in zip(blocks, own, strict=True):
        for word, value in zip(block.words, new.words, strict=True):
            if word.is_asked:
                _check_value(case, claimed.asked, word, value, ledger)
    stripped = tuple(replace(block, directives=()) for block in own)
    again = found.dialect.find(stripped, 0, claim.before, found.dialect.modes)
    name = "the filled blocks make one contour"
    if not isinstance(again, Claim) or len(again.blocks) != len(blocks):
        ledger.require(name, texts, passed=False, remark="they are none")
        return
    other = prepare(replace(found, rules="off"), again)
    made = candidates(other) if other.is_readable and other.is_determined else []
    paths = [each.path.moves for each in made if each.is_chosen and each.is_path]
    ends = [_place(case, each.end) for each in claimed.elements]
    off = [max(abs(a.end - b) for a, b in zip(each, ends, strict=True)) for each in paths if len(each) == len(ends)]
    if ledger.require(name, texts, bool(off), f"they make {len(paths)}"):
        limit = _limit(case, claimed) + ROUNDING * case.size
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
    lexicon = case.claim.lexicon
    given = lexicon.given(word.address, new, case.claim.after.unit) if word.address in lexicon.addresses else None
    value = answers[0].value if len(answers) == 1 else None
    name, words = "the filled value is the asked one, rounded", [word.text, new.text]
    if given is None or value is None:
        ledger.require(name, words, passed=False, remark="it has no value")
        return
    off = value - float(_sized(given.value, word))
    off = (off + 180) % 360 - 180 if given.unit is Unit.DEGREE else off
    ledger.measure(name, words, off, half_increment(case, word) + RESIDUAL, given.unit.value)


def _check_diagnosis(
    case: Case, diagnosis: ClaimedDiagnosis | None, found: Sequence[Candidate], ledger: Ledger
) -> None:
    """What can still move and which words say the same, where the facts are about lines between points."""
    if diagnosis is None:
        return
    is_known = case.profile.start.is_known and not any(block.faults for block in case.claim.blocks)
    facts = (*case.profile.facts, *case.profile.ignored)
    table = replace(case.sheet, facts=facts)
    if not is_known or not rank.is_linear(table):
        is_whole = diagnosis.ties_complete == (is_known and not case.profile.is_extended)
        ledger.require(COMPLETE, (), is_whole, "it says the opposite")
        _check_other_ties(case, diagnosis, found, ledger)
        return
    nothing = numpy.zeros(len(table.unknowns))
    rows, off = table.slopes(facts, nothing, {}), table.residuals(facts, nothing, {})
    _check_freedoms(rank.freedoms(rows, table), diagnosis, ledger)
    tied = rank.ties(rows, off)
    is_whole = diagnosis.ties_complete == (tied is not None and not case.profile.is_extended)
    if tied is None:
        ledger.omit("the ties of the diagnosis", "there are too many sets of words to look at")
        return
    ledger.require(COMPLETE, (), is_whole, "it says the opposite")
    names = [tuple(_address(word) for word in case.profile.words_of([facts[n] for n in tie.facts])) for tie in tied]
    for claimed in diagnosis.ties:
        if ledger.require(
            "words that are tied say the same", claimed.addresses, claimed.addresses in names, "they do not"
        ):
            number = names.index(claimed.addresses)
            tie = tied.pop(number)
            names.pop(number)
            limit = (RESIDUAL + ROUNDING * case.size) * max(1.0, tie.scale)
            ledger.measure("they disagree by as much", claimed.addresses, claimed.off_by_mm - tie.off, limit)
            *others, last = tie.facts
            values = numpy.linalg.lstsq(rows[others], -off[others], rcond=None)[0] if others else nothing
            share = abs(float(rows[last] @ values + off[last])) / allowance(case, facts[last], values, {})
            share = share if _rests_on(rows, others, last) else tie.off / AGREEMENT
            is_right = claimed.is_conflict == (share > 1) or 1 / CLEARLY < share < CLEARLY
            ledger.require("they conflict if that is more than the least increments", claimed.addresses, is_right)
    ledger.require(
        "all words that are tied are named", [" ".join(each) for each in names], not names, "the result lacks these"
    )


HALF_TURN = 180.0
"""Degrees."""

COMPLETE = "ties are complete where the block can be read and has no further facts"

CLEARLY = 2.0
"""1. Within so many times the allowed amount or one part of so many it is left open whether words agree."""


def _rests_on(rows: Array, others: Sequence[int], last: int) -> bool:
    """Whether what a fact is about is fixed by others."""
    touched = rows[last] != 0
    return all(each for each, is_own in zip(rank.fixed(rows[list(others)]), touched, strict=True) if is_own)


def _address(word: Word) -> str:
    return word.text if word.address == syntax.FACT else word.address


def _check_other_ties(case: Case, diagnosis: ClaimedDiagnosis, found: Sequence[Candidate], ledger: Ledger) -> None:
    """Ties of circles and further facts: each disagrees as much as one of the facts that are not needed."""
    ledger.require("freedoms are those of lines between points", (), not diagnosis.freedoms, "there are others")
    ledger.omit("the ties and freedoms of the diagnosis", "they were worked out for lines between points only")
    if not diagnosis.ties:
        return
    off = [
        (
            abs(float(residual(fact, case.sheet.at(each.values, {**dict.fromkeys(fact.sides(), 1), **each.signs})))),
            fact,
            each,
        )
        for each in found
        for fact in case.spare
    ]
    for tie in diagnosis.ties:
        if off and tie.off_by_mm:
            gap, fact, each = min(off, key=lambda one: abs(one[0] - tie.off_by_mm))
            limit = RESIDUAL + ROUNDING * _reach(case)
            ledger.measure("they disagree by as much", tie.addresses, gap - tie.off_by_mm, limit)
            is_right = tie.is_conflict == (fact in each.conflicts)
            ledger.require("they conflict if that is more than is allowed", tie.addresses, is_right)
        else:
            ledger.omit("the ties of the diagnosis", "what circles and facts have in common was not worked out")


def _check_freedoms(
    expected_ones: Mapping[str, tuple[float, float] | None], diagnosis: ClaimedDiagnosis, ledger: Ledger
) -> None:
    names, wanted = [each.point for each in diagnosis.freedoms], ", ".join(expected_ones) or "none"
    is_same = sorted(names) == sorted(expected_ones)
    ledger.require("the points that can move are those", (), is_same, f"they are {wanted}")
    for each in diagnosis.freedoms if is_same else ():
        along, own = expected_ones[each.point], f"{each.point} moves in that direction"
        is_line = (along is not None) == (each.direction is not None) == (each.angle is not None)
        if not ledger.require(f"{each.point} moves along a line or anywhere", (), is_line):
            continue
        if along is None or each.direction is None or each.angle is None:
            continue
        ledger.measure(own, (), rank.turns(along, each.direction), RESIDUAL, "1")
        ledger.measure(f"{own}, given by a unit vector", (), hypot(*each.direction) - 1, RESIDUAL, "1")
        first, second = each.direction
        is_ahead = max(each.direction, key=abs) > 0 or abs(abs(first) - abs(second)) <= RESIDUAL
        ledger.require(f"{own}, its larger part positive", (), is_ahead)
        ledger.require(f"{own}, its angle up to half a turn", (), 0 <= each.angle <= HALF_TURN)
        off = each.angle - degrees(float(numpy.arctan2(second, first)))
        ledger.measure(f"{own}, by its angle", (), (off + 90) % 180 - 90, RESIDUAL, "deg")
