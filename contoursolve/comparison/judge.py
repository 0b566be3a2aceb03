"""One contour of a claimed result: what its words state, measured at what is claimed; its status by the rank there."""

from collections.abc import Callable, Iterator, Mapping
from decimal import Decimal
from functools import cached_property
from itertools import combinations, islice, pairwise
from math import degrees, floor, inf, log10

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison.claims import PRINTED, ClaimedArc, ClaimedContour, ClaimedPath, Ledger
from contoursolve.comparison.measure import (
    INDEPENDENT,
    PRINTED_FLOATS,
    Move,
    Place,
    check_element,
    cross,
    dot,
    missing,
    name_moves,
    side_of,
    unit,
)
from contoursolve.diagnosis import status_text
from contoursolve.diagnostics import Severity
from contoursolve.gcode import FaultKind
from contoursolve.geometry import (
    INCREMENT_OF,
    Arc,
    Draft,
    Fact,
    Line,
    Profile,
    Unit,
    Values,
    apply_statements,
    both,
    build_system,
    line_scalars,
)
from contoursolve.numeric import Array, direction, pinv, svd
from contoursolve.reading import Control, ParsedContour, offences_of, read, unused_words
from contoursolve.tolerance import ERROR_BOUND_WARNING, LARGEST, LENGTH, RESIDUAL

ROUNDING = 16 * 2.0**-52
"""1 (share of the sizes that take part). The rounding of a handful of operations on doubles."""

MOST_UNKNOWNS = 1_000
"""Of which the rank is worked out: a decomposition takes a second."""

MOST_WAYS = 32
"""In which claimed elements are taken for those of the words, where some of these have no length."""


class Case(Struct, frozen=True, dict=True):
    """Words of a contour, read with the tables of its control, and the claims about it.

    `blank` has the values of givens alone, counted from `origin`, the start point. Reading alone tells that words are
    `unreadable`, that they leave it `loose`, that a rule has `rejected` it; rules that may have are `hints`.
    """

    claim: ParsedContour
    claimed: ClaimedContour
    profile: Profile
    blank: Place
    unreadable: str
    loose: str
    rejected: str
    hints: str
    origin: complex

    @property
    def size(self) -> float:
        """The largest number that the words state, mm."""
        return float(max([1.0, *map(abs, self.blank.at.amounts.values())]))

    def words(self, *facts: Fact) -> list[str]:
        """The words that state facts, as typed."""
        given = [self.profile.givens[fact.given].word for fact in facts if fact.given in self.profile.givens]
        return [word.text for word in given if word]

    @property
    def unknowns(self) -> tuple[str, ...]:
        """The names of what the words are to fix."""
        return self.blank.system.unknowns

    def name(self, fact: Fact) -> str:
        """The name of a fact in checks: what it is about."""
        axes, placed = self.profile.plane.axes, fact.placed
        if fact.given.startswith("fact "):
            return "the fact holds"
        if placed is not None:
            return f"{axes[placed.axis]} {f'from {placed.origin} to' if placed.origin else 'of'} {placed.point}"
        subjects = dict.fromkeys(name.rpartition(".")[0] or name for name in fact.reads())
        return fact.phrase(axes, ()) or f"what is stated about {', '.join(subjects)}"

    def increment(self, name: str) -> float:
        """The least increment of a coordinate by its axis, or of a value by its name; 0 of what no word states."""
        return self.increments.get(INCREMENT_OF + name, 0.0)

    @cached_property
    def increments(self) -> dict[str, float]:
        """The least increments of the control, see `Profile.increments`."""
        return self.profile.increments


def prepare(
    claim: ParsedContour,
    claimed: ClaimedContour,
    control: Control,
    rules: str,
    next_end: tuple[Decimal, Decimal] | None,
) -> Case:
    """Read the words and facts of a contour into a case."""
    is_faulty, refusals = any(block.faults for block in claim.blocks), list[str]()
    offences = () if rules == "off" or is_faulty else offences_of(claim, control.rules)
    plain = read(claim, frozenset(each.ignored for each in offences if each.ignored))
    profile, faults = apply_statements(plain, claim.directives, lambda: next_end)
    profile = plain if faults else profile if claim.needs_place else profile.with_free_start()
    wrong = [*_unreadable(claim), *(fault.message for fault in faults)]
    is_strict = rules == "enforce" and not claim.directives and not any(word.is_asked for word in claim.words.values())
    for rule in (each.rule for each in offences if is_strict and not each.ignored):
        if rule.severity is Severity.ERROR and not rule.is_about_geometry:
            refusals.append(f"the rule {rule.code} refuses it")
    open_ones = [word.text for word in claim.words.values() if word.number is None and not word.is_asked]
    loose = [f"{mode}: {why}" for mode, why in claim.open_modes()] + [
        f"{text} depends on a variable" for text in open_ones
    ]
    loose += [] if profile.start.is_known else ["the start point is not known"]
    for each in profile.figure.corners:
        lands = each.after is not None or each.lands_on is not None or each.lands_parallel_to is not None
        loose += [] if lands else [f"no word says where {each.name} lands"]
    figure, start = profile.figure, [value or Decimal(0) for value in profile.start.values]
    facts = [*profile.facts, *profile.ignored, *(question.fact for question in profile.questions)]
    shifts = {fact.given: start[fact.placed.axis] for fact in facts if fact.placed and not fact.placed.origin}
    shifts |= {name: start[axis] for place in figure.places for axis, name in enumerate(both(place))}
    lengths = [each for each in profile.givens.values() if each.unit is not Unit.DEGREE]
    amounts = {each.name: float(each.value - shifts.get(each.name, 0)) for each in lengths}
    directions = {each.name: direction(each.value) for each in profile.givens.values() if each.unit is Unit.DEGREE}
    known = dict.fromkeys(both(figure.start), 0.0)
    known |= {name: amounts[name] for name in (*both(*figure.places), *figure.known_radii)}
    system = build_system(figure, profile.facts)
    blank = Place(system, Values(known, amounts, directions, system.headed, functions=PRINTED_FLOATS))
    origin, hints = complex(*map(float, start)), [each.rule.code for each in offences] if is_strict else []
    told = ["; ".join(each) for each in (wrong, loose, refusals, hints)]
    return Case(claim, claimed, profile, blank, told[0], told[1], told[2], told[3], origin)


def _unreadable(claim: ParsedContour) -> Iterator[str]:
    """Reasons why words have no meaning, whatever the rules are: characters, words, numbers beyond all travel, idle
    questions."""
    outline = claim.form.outline
    names = {*claim.form.choices, *outline.shapes, *(row.fact.given for row in outline.facts)}
    askable = [word for name, word in claim.words.items() if name in names]
    faults = (fault for block in claim.blocks for fault in block.faults)
    texts = [fault.text for fault in faults if fault.kind is not FaultKind.COMMENT_NOT_CLOSED]
    texts += [word.text.strip() for word in (*claim.repeated, *claim.unknown, *claim.unread)]
    texts += [name for name, given in claim.givens.items() if abs(given.value) > LARGEST]
    for word in (word for block in claim.blocks for word in block.words):
        value = claim.lexicon.value(word, claim.after.unit) if word.address in claim.lexicon.addresses else None
        if (value is not None and abs(value) > LARGEST) or (word.is_asked and word not in askable):
            texts.append(word.text)
    return (f"{text} cannot be read" for text in texts)


# --- A claimed path ----------------------------------------------------------------------------------


class Measured(Struct, frozen=True, dict=True):
    """A claimed path at its figure: the elements by their names, the values of all scalars with the facts about them,
    and how far each may be off."""

    case: Case
    path: ClaimedPath
    named: Mapping[str, Move]
    place: Place
    limit: float

    def off(self, fact: Fact) -> tuple[float, float]:
        """The error of a fact, and its limit, mm."""
        off, allowance = self.place.error(fact), fact.allowance(self.place.at, self.case.increment)
        allowed = max(self.limit, allowance) if fact in self.spare else self.limit
        if fact not in self.case.profile.facts:
            # A corner is cut in the stated direction, which is exact to its increment only.
            allowed += self.beside.get(getattr(fact, "line", ""), 0.0)
        if fact.sizes and self.limit < off <= allowance:
            # It may be too small for its half circle, by no more than words are exact to.
            circles = [each.circle for each in self.place.system.facts if each.circle]
            ends = [each.point for each in circles if each.radius == fact.sizes]
            spans = (abs(self.place.way(one, other)) for one, other in combinations(ends, 2))
            diameter = 2 * self.place.at.radius(fact.sizes)
            off = 0.0 if any(abs(span - diameter) <= 4 * self.limit for span in spans) else off
        wrong = self.place.sense(fact)
        return (wrong if wrong < -PRINTED else off), allowed

    @cached_property
    def beside(self) -> dict[str, float]:
        """The distance, mm, by which each line of a stated direction leads past its last point."""
        lines = [each for each in self.case.profile.figure.path if isinstance(each, Line)]
        headed = [each for each in lines if each.name in self.place.at.headed]
        return {
            each.name: abs(cross(self.place.heading(each), self.place.way(each.tail, each.head))) for each in headed
        }

    @cached_property
    def spare(self) -> frozenset[Fact]:
        """The facts that follow from those before them: what they state may be off as far as words are exact."""
        facts, names = self.case.profile.facts, self.case.unknowns
        if len(names) > MOST_UNKNOWNS:
            return frozenset(fact for fact in facts if fact.circle)
        return frozenset(facts[row] for row in dependent(self.place.slopes(facts, names)))

    @cached_property
    def sides(self) -> list[tuple[float, float] | None]:
        """For each choice, on which side its point is, see `side_of`."""
        return [side_of(self.place, choice) for choice in self.case.profile.choices]

    def is_on_its_sides(self, band: float = 0.0) -> bool:
        """Whether each point of which there are two is the one that words choose; both are one within a band, mm."""
        return all(side is None or side[0] > 0 or side[1] <= band for side in self.sides)

    @cached_property
    def rank(self) -> "Rank":
        """The rank of the facts' derivatives at the path."""
        return rank_at(self)


def examine(case: Case, path: ClaimedPath, ledger: Ledger, *, is_chosen: bool) -> Measured | None:
    """Measure a claimed path by the table of checks; None where its elements are not those of the words. One that
    `is_chosen` is on the sides that words choose, too."""

    def place(at: tuple[float, float]) -> complex:
        return complex(*at) - case.origin

    ledger.kind, moves = "path", list[Move]()
    for each in path.elements:
        ends = place(each.start), place(each.end)
        if isinstance(each, ClaimedArc):
            moves.append(Move(*ends, 1 if each.turn == "ccw" else -1, place(each.center), each.radius))
        else:
            moves.append(Move(*ends))
    points, figure, here = {name: place(at) for name, at in path.points.items()}, case.profile.figure, 0j
    limit = RESIDUAL + ROUNDING * max([case.size + abs(case.origin), *map(abs, path.numbers())]) + 4 * _grain(path)
    names = [point for point in figure.points if point in case.profile.intersections]
    has = ", ".join(sorted(map(ascii, points))) or "none"
    ledger.require(f"the points are {', '.join(names) or 'none'}", (), {*points} == {*names}, f"the result has {has}")
    for number, move in enumerate(moves, 1):
        ledger.measure(f"element {number} begins where the one before it ends", (), abs(move.start - here), limit)
        is_long = abs(move.end - move.start) >= LENGTH - 2 * PRINTED or move.turn != 0
        # Equations have the square of a radius.
        is_turned_out = move.turn != 0 and move.radius <= 0.0
        remark = f"its radius is {move.radius:g} mm" if is_turned_out else "it has none"
        ledger.require(f"element {number} has a length", (), is_long and not is_turned_out, remark)
        here = move.end
    if ledger.require("the result says where the contour ends", (), path.end is not None, "end is null") and path.end:
        ledger.measure("the contour ends with its last element", (), abs(place(path.end) - here), limit)
    best, found = Ledger(), None
    for named in islice(name_moves(figure, moves, points), MOST_WAYS):
        own = Ledger(prefix=ledger.prefix)
        tried = _measure(case, path, named, points, limit)
        for own.kind, check in PATH_CHECKS.items():
            if is_chosen or own.kind != "sides":
                check(tried, own)
        if found is None or not own.is_broken:
            best, found = own, tried
        if not own.is_broken:
            break
    has = ", ".join("arc" if move.turn else "line" for move in moves) or "none"
    wanted = ", ".join([each.name for each in (*figure.path, *figure.corners)])
    remark = f"the result has {has}; the words give {wanted}, but for those of no length"
    ledger.require("the elements are those that the words give", (), found is not None, remark)
    ledger.checks += best.checks
    return found


def _grain(path: ClaimedPath) -> float:
    """Half of the last decimal that a path's numbers have, if its certificate leaves them no more, mm."""
    radius = path.certificate.radius
    if not radius or not PRINTED < radius <= ERROR_BOUND_WARNING:
        return 0.0
    decimals = floor(-log10(radius))
    return 0.5 * 10.0**-decimals if all(round(value, decimals) == value for value in path.numbers()) else 0.0


def _measure(
    case: Case, path: ClaimedPath, named: Mapping[str, Move], points: Mapping[str, complex], limit: float
) -> Measured:
    """The values that a claimed path, whose elements are called so, gives all scalars of its figure and its corners;
    what it does not list is guessed first, and settled by the facts about it."""
    figure, here, told, guessed = case.profile.figure, 0j, dict[str, float](), dict[str, float]()
    draft = Draft(figure, case.profile.facts, case.profile.givens)

    def put(name: str, at: complex, values: dict[str, float] = told) -> None:
        values.update(zip(both(name), (at.real, at.imag), strict=True))

    def guess(line: str, start: complex, end: complex) -> None:
        along = unit(end - start) or 1 + 0j
        guessed.update(zip(line_scalars(line), (along.real, along.imag, cross(along, start)), strict=True))

    for element in figure.path:
        own, corners = named.get(element.name), [each for each in figure.corners if each.at == element.head]
        begin, here = here, own.end if own else here
        if not any(each.name in named for each in corners):
            put(element.head, here)
        if own and isinstance(element, Arc):
            put(element.center, own.center)
            told[element.radius] = own.radius
        elif isinstance(element, Line):
            guess(element.name, own.start if own else begin, own.end if own else points.get(element.head, here))
        for corner in (each for each in corners if each.name in named):
            own, name = named[corner.name], corner.name
            here = own.end
            draft.corner(name, is_solved=False)
            put(corner.at, (own.start + own.end) / 2, guessed)
            put(f"{name}.begin", own.start)
            put(f"{name}.end", own.end)
            guess(corner.lands_on or f"{name}.landing", points.get(corner.at, own.start), own.end)
            guessed[f"{name}.radius"] = abs(own.end - own.start)
            if own.turn:
                put(f"{name}.center", own.center)
                told[f"{name}.radius"] = own.radius
    for name, at in points.items():
        put(name, at)
    system = build_system(draft.figure, tuple(draft.facts))
    scalars = {**dict.fromkeys(system.unknowns, 0.0), **guessed, **case.blank.at.scalars, **told}
    values = replace(case.blank.at, scalars=scalars, headed=system.headed)
    found, rest = Place(system, values), [name for name in system.unknowns if name not in told]
    # A side can be told where the line that it belongs to is known.
    found = found.settled(rest, [fact for fact in system.facts if not fact.sides()])
    for _ in range(2):
        found = found.with_sides().settled(rest, system.facts)
    return Measured(case, path, named, found.with_sides(), limit)


def _check_words(own: Measured, ledger: Ledger) -> None:
    """Measure what words, forms and corners state about the points."""
    for fact in own.place.system.facts:
        ledger.measure(own.case.name(fact), own.case.words(fact), *own.off(fact))


def _check_elements(own: Measured, ledger: Ledger) -> None:
    """Each element goes from its first to its last point; corners turn as the path does, or have no size."""
    figure, givens = own.case.profile.figure, own.case.profile.givens
    for element in figure.path:
        for name, off in (
            check_element(own.place, element, own.named[element.name]) if element.name in own.named else ()
        ):
            ledger.measure(name, (), off, 2 * own.limit)
    for corner in figure.corners:
        move, given = own.named.get(corner.name), givens.get(corner.size)
        words = [given.word.text] if given and given.word else []
        if move is None:
            ledger.measure(f"{corner.name} is there", words, missing(own.place, corner), LENGTH)
        elif move.turn:
            is_right = cross(move.start - move.center, move.end - move.center) * move.turn > 0
            ledger.require(f"{corner.name} turns as the path does", words, is_right, "it turns the other way")


def _check_place(own: Measured, ledger: Ledger) -> None:
    """The words fix the points, which are where these put them to first order, within the certificate's radius."""
    certificate, rank = own.path.certificate, own.rank
    radius = inf if certificate.radius is None else certificate.radius
    is_right = radius >= 0 and certificate.kind in ("exact", "unique", "verified", "unknown")
    ledger.require("the certificate is of a known kind", (), is_right, f"{ascii(certificate.kind)[:40]}, {radius:g} mm")
    if rank.open is None:
        why = "several solutions have become one there" if rank.fold is not None else "there are too many unknowns"
        ledger.omit("whether the words fix the points", f"the equations do not tell it here: {why}")
        return
    remark = f"{rank.open} of {len(own.case.unknowns)} numbers are open"
    if not ledger.require("the words fix the points", own.case.words(*own.place.system.facts), not rank.open, remark):
        return
    if rank.fold is not None:
        ledger.measure("two solutions have become one", (), rank.fold, FOLDED)
    allowed = min(own.limit, 4 * radius + PRINTED + ROUNDING * (own.case.size + abs(own.case.origin)))
    ledger.measure(
        "the points are where the words put them, within the certificate's radius", (), rank.off, allowed + rank.unsure
    )


def _check_sides(own: Measured, ledger: Ledger) -> None:
    """Points of which there are two are those that words choose."""
    for choice, side in zip(own.case.profile.choices, own.sides, strict=True):
        given, name = own.case.profile.givens.get(choice.given), f"{choice.point} is the {choice.side.value} place"
        if side is None:
            ledger.omit(name, "the figure does not tell")
            continue
        is_right = side[0] > 0 or side[1] <= 8 * ROUNDING * own.case.size
        ledger.require(name, [given.word.text] if given and given.word else [], is_right, "it is the other one")


def _check_answers(own: Measured, ledger: Ledger) -> None:
    """Every question has its answer, which is measured at the points."""
    rest, case, name = list(own.path.asked), own.case, "the answer is the value that the elements have"
    for question in case.profile.questions:
        word, line, is_angle = question.word.text, question.word.span.line, question.unit is Unit.DEGREE
        answer = next((each for each in rest if (each.word, each.line) == (word, line)), None)
        if (
            not ledger.require("the result answers what is asked for", [word], answer is not None, "it does not")
            or not answer
        ):
            continue
        rest.remove(answer)
        fact, value, limit = question.fact, question.fact.implied(own.place.at), own.limit
        reach = abs(own.place.way(*fact.heading)) if fact.heading else 1.0
        if own.rank.fold is not None or value is None:
            ledger.omit(word, "two solutions have become one there, or what has no length has no direction")
            continue
        if fact.placed and not fact.placed.origin:
            value += (case.origin.real, case.origin.imag)[fact.placed.axis]
        off = inf if answer.value is None else answer.value - value
        if is_angle:
            limit, off = limit + degrees((2 * PRINTED + ROUNDING * case.size) / reach), (off + 180) % 360 - 180
        unit_of = "deg" if is_angle else "mm"
        if ledger.require("its unit is what it measures", [word], answer.unit == unit_of, f"it is not {unit_of}"):
            ledger.measure(name, [word], off, limit, unit_of)
    ledger.require(
        "the program asks for what the result answers", [each.word for each in rest], not rest, "it does not"
    )


PATH_CHECKS: Mapping[str, Callable[[Measured, Ledger], None]] = {
    "words": _check_words,
    "elements": _check_elements,
    "points": _check_place,
    "sides": _check_sides,
    "answers": _check_answers,
}
"""Checks of each claimed path, by their kind."""


# --- What the derivatives tell -----------------------------------------------------------------------

NEARLY = 1e-5
"""1 (share of the largest). A singular value below this may be that of two solutions that have become one."""

BEND, BENDS, FOLDED = 1e-2, 1e-6, 1e-7
"""mm by which values are moved to see whether derivatives change; 1/mm by which they do; mm by which two solutions may
miss each other, which central differences do not tell from zero."""


class Rank(Struct, frozen=True):
    """Rank of the derivatives of facts at claimed values.

    `open` is how many unknowns they leave free, `surplus` are the stated facts that follow from others; None where that
    is not told. `off` and `unsure` are how far values are from where the facts are true, to first order, and how far
    rounding may put them, mm. `fold` is how far they are from several solutions that have become one, mm, None where
    those are apart.
    """

    open: int | None
    surplus: tuple[Fact, ...] | None = None
    off: float = 0.0
    unsure: float = 0.0
    fold: float | None = None


def rank_at(own: Measured) -> Rank:
    """The rank of the words' derivatives at a claimed path."""
    case, names, facts, values = own.case, own.case.unknowns, own.case.profile.facts, own.place.at.scalars
    exact, most = [fact for fact in facts if abs(own.off(fact)[0]) <= own.limit], len(names)
    if most > MOST_UNKNOWNS:
        return Rank(None)
    surplus = tuple(fact for fact in facts if fact in own.spare and fact.given)
    if not names:
        return Rank(0, surplus)

    def moved(along: Array) -> Place:
        by = {name: values[name] + step for name, step in zip(names, along.tolist(), strict=True)}
        return replace(own.place, at=replace(own.place.at, scalars={**values, **by}))

    rows, off = own.place.slopes(exact, names), numpy.array([own.place.error(fact) for fact in exact])
    cuts = _free_cuts(own)
    rows, off = numpy.vstack([rows, cuts]), numpy.concatenate([off, numpy.zeros(len(cuts))])
    left, sizes, right = svd(rows)
    found, near = (int((sizes > share * sizes.max(initial=0.0)).sum()) for share in (INDEPENDENT, NEARLY))
    if len(sizes) == most > near and not len(cuts):
        # Where solutions have become one, the derivatives vanish along what could move, and change along it.
        bends = list[float]()
        for way in (*numpy.eye(most - near), numpy.ones(most - near)):
            along = BEND * (way @ right[near:])
            ends = [[at.error(fact) for fact in exact] for at in (moved(-along), own.place, moved(along))]
            bent = left[:, near:most].T @ (numpy.array([1.0, -2.0, 1.0]) @ numpy.array(ends))
            bends.append(float(numpy.linalg.norm(bent)) / BEND**2)
        hides = inf if own.path.certificate.double else ROUNDING * case.size / 8
        if min(bends) > BENDS and float(sizes[-1]) ** 2 / min(bends) <= hides:
            # How far off they are is told where only two are one.
            fold = float(sizes[-1]) / bends[0] if most == near + 1 else 0.0
            return Rank(0, () if len(facts) == most else None, fold=fold)
        away = moved(numpy.random.default_rng(16).normal(0, 0.1, most)).slopes(exact, names)
        if found < most == len(away) - len(dependent(away)):
            return Rank(None, fold=0.0)
    inverse, noise = pinv(rows, rcond=INDEPENDENT), ROUNDING * case.size + 3 * PRINTED + own.limit - RESIDUAL
    step, unsure = abs(inverse @ off), abs(inverse).sum(axis=1) * noise
    worst = int((step - unsure).argmax())
    return Rank(most - found, surplus, float(step[worst]), float(unsure[worst]))


def dependent(rows: Array) -> list[int]:
    """The rows that follow from those before them."""
    found, basis = list[int](), numpy.zeros((0, rows.shape[1]))
    for number, row in enumerate(rows):
        rest = row - (basis @ row) @ basis
        rest = rest - (basis @ rest) @ basis
        if float(numpy.linalg.norm(rest)) > INDEPENDENT * float(numpy.linalg.norm(row)):
            basis = numpy.vstack((basis, rest / numpy.linalg.norm(rest)))
        else:
            found.append(number)
    return found


def _free_cuts(own: Measured) -> Array:
    """Rows that hold points which only cut a line or an arc of a free contour in two, wherever they are on it."""
    figure, names, rows = own.case.profile.figure, own.case.unknowns, list[Array]()
    cut = {corner.at for corner in figure.corners}
    for first, second in pairwise(figure.path) if own.case.claim.form.is_general else ():
        one, other = own.named.get(first.name), own.named.get(second.name)
        if not one or not other or first.head in cut or one.turn != other.turn:
            continue
        along = one.turn * 1j * unit(one.end - one.center) if one.turn else unit(one.end - one.start)
        beside = abs(cross(along, other.end - other.start)) if not one.turn else abs(one.center - other.center)
        if beside <= own.limit and (one.turn or dot(along, other.end - other.start) > 0):
            rows.append(numpy.zeros(len(names)))
            rows[-1][[names.index(name) for name in both(first.head)]] = along.real, along.imag
    return numpy.array(rows).reshape(len(rows), len(names))


# --- A contour ---------------------------------------------------------------------------------------


class ContourEvidence(Struct, frozen=True):
    """Measurements of a contour: at its path, and at each other path of its list."""

    case: Case
    own: Measured | None
    listed: tuple[Measured | None, ...]

    @property
    def claimed(self) -> ClaimedContour:
        """The claims about it."""
        return self.case.claimed


def _check_block(of: ContourEvidence, ledger: Ledger) -> None:
    """Check the contour's lines, form, plane, settings and facts against its blocks."""
    claim, claimed = of.case.claim, of.claimed
    conventions = [f"{each.setting.name}={each.value}" for each in claim.conventions]
    others = [f"{each.get('setting')}={each.get('value')}" for each in claimed.conventions]
    for name, own, its in (
        ("the lines are those of its blocks", [str(each.line) for each in claim.blocks], map(str, claimed.lines)),
        ("the form is that of its blocks", [claim.form.name], [claimed.form]),
        ("the plane is the one in force", claim.after.plane.axes, claimed.plane),
        ("the conventions are those in force", sorted(conventions), sorted(others)),
        ("the facts are those of the program", sorted(each.text for each in claim.directives), sorted(claimed.facts)),
    ):
        told, has = (" ".join(ascii(each)[1:60].strip("'") for each in texts) or "none" for texts in (own, its))
        ledger.require(name, (), told == has, f"the program has {told}, and the result has {has}")
    start, is_relative = of.case.profile.start, claimed.place is not None
    if is_relative or start.is_relative:
        whose = "the program's words alone" if start.is_relative else "the result's alone"
        name, remark = "coordinates count from the start", f"{whose} make them count so"
        ledger.require(name, (), is_relative is start.is_relative, remark)
    for axis, known, value in zip(claim.before.plane.axes, start.values, claimed.start, strict=True):
        name = f"{axis} of the start is the program's position"
        if known is not None and value is not None:
            ledger.measure(name, (), value - float(known), RESIDUAL + ROUNDING * abs(float(known)))
            continue
        told, has = ("none" if each is None else f"{float(each):g} mm" for each in (known, value))
        remark = f"the program has {told}, and the result has {has}; if it was solved with --start, verify with it"
        ledger.require(name, (), known is None and value is None, remark)
    given = {(word.text, word.span.line) for word in claim.words.values() if word.is_asked}
    given |= {(each.text, each.span.line) for each in claim.directives}
    asked = [
        each.word
        for path in (claimed, *claimed.solutions)
        for each in path.asked
        if (each.word, each.line) not in given
    ]
    ledger.require("what is answered is asked there", asked, not asked, "it is not")


def _check_path(of: ContourEvidence, ledger: Ledger) -> None:
    """A contour claims a path if its status has one, and nothing that only a path has if not."""
    claimed, why = of.claimed, of.case.unreadable or of.case.loose or of.case.rejected
    if claimed.has_path:
        ledger.require("every word and fact can be read", (), not why, why)
        pairs = zip(of.case.profile.choices, of.own.sides, strict=True) if of.own else ()
        shown, band = of.case.profile.intersections, ROUNDING * of.case.size
        words = of.case.claim.words
        told = [(one, side[1]) for one, side in pairs if one.given in words and one.point in shown and side]
        # In a band, it is left open whether both places are one.
        sure, maybe = ({(one.point, one.side.value) for one, gap in told if gap > band * by} for by in (8, 1 / 8))
        is_right = sure <= {*claimed.branches.items()} <= maybe
        is_right = is_right and claimed.branch == (", ".join(claimed.branches.values()) or None)
        remark = f"they are {', '.join(' '.join(each) for each in sorted(sure)) or 'none'}"
        ledger.require("the branches are the sides that words choose", (), is_right or not of.own, remark)
        return
    its = status_text(claimed.status)
    ledger.omit("the path", f"there is none: {its}")
    ledger.require("a contour with this status has no path", (), claimed.is_bare, f"it has a path, and: {its}")
    given = (
        claimed.certificate.radius,
        claimed.certificate.double,
        claimed.branch,
        claimed.branches or None,
        claimed.filled,
    )
    is_bare = all(each is None for each in given)
    ledger.require("without a path nothing is certified, chosen or filled in", (), is_bare, "the result does so")


def _check_list(of: ContourEvidence, ledger: Ledger) -> None:
    """The list of solutions: their number, which are paths, which one is the contour."""
    claimed, listed, count = of.claimed, of.claimed.solutions, of.claimed.count
    if count is None:
        is_right = not listed and not claimed.has_path
        ledger.require("a list of solutions comes with their number", (), is_right, "the number is missing")
        return
    paths, chosen = [each for each in listed if each.is_path], [each for each in listed if each.is_chosen]
    for name, said, has in (("solutions", count.solutions, len(listed)), ("paths", count.contours, len(paths))):
        ledger.require(f"all {name} are listed", (), said == has, f"there are said to be {said}, and {has} are listed")
    ledger.require(
        "the list is complete unless there is a doubt", (), count.is_complete != bool(count.doubts), "it is both"
    )
    if count.is_complete and count.within_mm is not None:
        remark = f"it holds all within {count.within_mm:g} mm, and the travel is {of.case.profile.travel:g} mm"
        is_all = count.within_mm >= of.case.profile.travel
        ledger.require("a list that is complete holds all in the control's travel", (), is_all, remark)
    is_told = all(each.is_path or (each.is_bare and bool(each.reasons)) for each in listed)
    ledger.require("what is no path has a reason and nothing else", (), is_told, "it has something else, or none")
    for one, other in combinations(paths, 2):
        is_same = (one.elements, one.points) == (other.elements, other.points)
        ledger.require("listed paths differ", (), not is_same, "two are the same")
    words = [word.text for word in of.case.claim.words.values()]
    unknown = [text for text in count.chosen_by.split(" and ") if count.chosen_by and text not in words]
    ledger.require("what chooses is a word of the program", unknown, not unknown, "the program does not have it")
    is_one = len(chosen) == claimed.has_path
    ledger.require("a contour with a path is one solution of the list", (), is_one, f"{len(chosen)} are chosen")
    for each in chosen if claimed.has_path else ():
        its, own = each.numbers(), claimed.numbers()
        is_like = [type(one) for one in each.elements] == [type(one) for one in claimed.elements] and len(its) == len(
            own
        )
        off = max((abs(one - other) for one, other in zip(its, own, strict=True)), default=0.0) if is_like else inf
        limit = 10 * RESIDUAL + 2 * max(each.certificate.radius or 0.0, claimed.certificate.radius or 0.0)
        ledger.measure("the solution that is chosen is the contour", (), off, min(limit, ERROR_BOUND_WARNING))
    ledger.omit("whether these are all solutions", "nothing was searched for")
    if paths:
        ledger.omit("what certificates prove", "that a box holds one solution is not proven again")
    if len(listed) > 1:
        ledger.omit("what selects each solution, and why others are no paths", "it is not worked out again")


def _check_status(of: ContourEvidence, ledger: Ledger) -> None:
    """The status by the rank of the equations; what that does not tell is not checked."""
    case, status, own, name = of.case, of.claimed.status, of.own, "the status is the one that the words give"
    paths, band = [each for each in of.listed if each is not None], 8 * ROUNDING * case.size
    agreeing = sum(each.is_on_its_sides() for each in paths) or sum(each.is_on_its_sides(band) for each in paths)
    rejected = case.unreadable or case.rejected or (case.hints if status == "rejected" else "")
    if ledger.is_broken:
        ledger.omit("the status", "what is claimed is wrong in itself")
    elif (status == "rejected") != bool(rejected):
        ledger.require(name, (), holds=False, remark=rejected or "every word can be read, and no rule refuses it")
    elif status == "rejected":
        ledger.omit("the status", f"{rejected}: words and rules are read from the same tables as the solver's")
    elif agreeing > 1 and status in ("solved", "overdetermined") and not case.profile.picks:
        ledger.require("one path agrees with the words", (), holds=False, remark=f"{agreeing} listed ones do")
    elif own is not None:
        _judge_path(of, own.rank, ledger)
    elif status == "ambiguous":
        ledger.require("several paths agree with the words", (), agreeing > 1, f"{agreeing} listed ones do")
    elif agreeing and status != "undecided" and not case.profile.picks:
        ledger.require("no path agrees with the words", (), holds=False, remark=f"{agreeing} listed ones do")
    elif status == "undecided" and of.claimed.count and of.claimed.count.is_complete:
        ledger.require("the list is not complete", (), holds=False, remark="it is said to be")
    elif status == "underdetermined":
        _judge_open(case, ledger)
    else:
        ledger.omit("the status", "that there is no solution, or no path, is not worked out")


def _judge_path(of: ContourEvidence, rank: Rank, ledger: Ledger) -> None:
    """Check the status of a path: its words are as many as it takes to fix it, or more."""
    words = of.case.words(*(rank.surplus or ()))
    if rank.open is None or rank.surplus is None:
        ledger.omit("the status", "the equations do not tell it here, see above")
    elif rank.surplus and of.claimed.count and of.claimed.count.solutions > 1:
        ledger.omit("the status", f"whether {', '.join(words)} repeats others or chooses among the solutions")
    else:
        has = "overdetermined" if rank.surplus else "solved"
        told = f"by the equations {'a word' if rank.surplus else 'no word'} is too many"
        ledger.require("the status is that of the equations", words, of.claimed.status == has, told)


def _judge_open(case: Case, ledger: Ledger) -> None:
    """Check that the words leave numbers open: by reading alone, or by the rank at arbitrary points. Where an equation
    follows from others, words may contradict each other as well, which is another status."""
    facts, names, ranks, name = case.profile.facts, case.unknowns, list[int](), "the words leave numbers open"
    rng, corners = numpy.random.default_rng(16), [corner.name for corner in case.profile.figure.corners]
    for _ in range(3 if len(names) <= MOST_UNKNOWNS else 0):
        values = dict(zip(names, rng.uniform(1, 2, len(names)).tolist(), strict=True))
        at = replace(case.blank.at, scalars={**values, **case.blank.at.scalars})
        ranks.append(len(facts) - len(dependent(replace(case.blank, at=at).with_sides().slopes(facts, names))))
    if case.hints or not ranks or max(ranks) < len(facts) or len(corners) > len({*corners}):
        ledger.omit(
            "the status", "equations follow from others, or a rule refuses them: their number does not tell the status"
        )
    elif case.loose or max(ranks) < len(names):
        ledger.require(name, (), holds=True)
    elif all(each.is_affine for each in facts):
        ledger.require(name, (), holds=False, remark="there are as many independent equations as unknowns")
    else:
        ledger.omit(
            "the status",
            "there are as many independent equations as unknowns at arbitrary points; at others there may be fewer",
        )


CONTOUR_CHECKS: Mapping[str, Callable[[ContourEvidence, Ledger], None]] = {
    "block": _check_block,
    "path": _check_path,
    "list": _check_list,
    "status": _check_status,
}
"""Checks of each contour besides its paths, by their kind."""

NOT_CHECKED = {
    "filled": ("the filled blocks", "they are not read anew"),
    "diagnosis": ("the diagnosis", "what can move, and what says the same, is not worked out again"),
}
"""Claims of a contour that no check is about: fields of the result, their names in receipts, and the reasons."""


def check_contour(case: Case, ledger: Ledger) -> None:
    """Everything that is checked of one contour, by the two tables of checks."""
    claimed, listed, own = case.claimed, list[Measured | None](), None
    with numpy.errstate(all="ignore"):
        try:
            if claimed.has_path and not (case.unreadable or case.loose):
                own = examine(case, claimed, ledger, is_chosen=True)
            for number, each in enumerate(claimed.solutions, 1):
                is_own = claimed.has_path and each.numbers() == claimed.numbers()
                is_own = is_own and (each.elements, each.certificate) == (claimed.elements, claimed.certificate)
                ledger.prefix, found = f"solution {number}: ", own if is_own and each.asked == claimed.asked else None
                if each.is_path and not (case.unreadable or case.loose) and found is None:
                    found = examine(case, each, ledger, is_chosen=each.is_chosen)
                ledger.prefix = ""
                listed.append(found)
            for ledger.kind, check in CONTOUR_CHECKS.items():
                check(ContourEvidence(case, own, tuple(listed)), ledger)
        except (numpy.linalg.LinAlgError, ArithmeticError):
            ledger.kind, ledger.prefix = "path", ""
            ledger.require(
                "the numbers of the result can be worked with", (), holds=False, remark="they are too far off"
            )
    ledger.kind = "rest"
    for name, (what, why) in NOT_CHECKED.items():
        if getattr(claimed, name):
            ledger.omit(what, why)
    for word in (*case.profile.words_of(case.profile.ignored), *unused_words(case.claim, case.profile)):
        ledger.omit(word.text, "the control does not use it for this contour")
