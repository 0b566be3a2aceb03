"""What the words of a contour say, what solutions they have, and what status that gives it."""

from cmath import phase
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import combinations, pairwise
from math import degrees, dist, hypot, inf, pi, tau
from typing import get_args

import numpy
from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Severity
from contoursolve.gcode import FaultKind, Word
from contoursolve.geometry import (
    FIRST,
    INCREMENT_OF,
    SECOND,
    Arc,
    Choice,
    Coordinate,
    Directed,
    Fact,
    Given,
    Heading,
    Layout,
    Line,
    Offset,
    OnCircle,
    Profile,
    Radius,
    Ray,
    TurnBetween,
    Unit,
    apply_statements,
    line_scalars,
    scalar,
)
from contoursolve.reading import Dialect, Offence, ParsedContour, check as check_rules, read
from contoursolve.tolerance import AGREEMENT, LARGEST, LENGTH, REGULAR, RESIDUAL
from contoursolve.verification import rank
from contoursolve.verification.decode import PRINTED, ClaimedArc, ClaimedContour, ClaimedLine, Point, Status
from contoursolve.verification.drawing import Drawing, Path, side_of
from contoursolve.verification.residuals import Array, Place, ResidualSystem, norm, residual, senses, system_of

EPSILON = 2.0**-52
"""1. Two neighbouring doubles differ by this share of their size."""

ROUNDING = 16 * EPSILON
"""1 (share of the sizes that take part). The rounding of a handful of operations on doubles."""

FEW = 8.0
"""1. How often the band of rounding may be taken differently by the solver."""

HIDDEN = 0.05
"""1 (share of the size). Solutions that are nearer may be several that have become one."""


class Found(Struct, frozen=True):
    """A contour block of the program and what the result claims of it, if anything.

    `rules` is the policy that the result names. `apart` is how many facts were stated apart from the program, on lines
    -1, -2 and so on. `start_error` (mm) is how far the position may be from the one that the result was made with: the
    result tells the ends of earlier contours with 12 decimals. `next_end` is where the line of the next block ends, mm,
    if that is known.
    """

    claim: ParsedContour
    claimed: ClaimedContour | None
    start_error: float
    dialect: Dialect
    next_end: tuple[Decimal, Decimal] | None
    rules: str
    apart: int


class Case(Struct, frozen=True):
    """What the words of a contour say: its profile and its residuals, the facts that fix its points, and those that say
    more.

    `statuses` are those that reading alone gives it, each with its reason; `loose` are those of its structure, whatever
    the values. `is_readable` tells whether there is more to say.
    """

    found: Found
    profile: Profile
    system: ResidualSystem
    basis: tuple[Fact, ...]
    spare: tuple[Fact, ...]
    statuses: Mapping[str, str]
    loose: Mapping[str, str]
    is_readable: bool

    @property
    def claim(self) -> ParsedContour:
        """The contour block."""
        return self.found.claim

    @property
    def is_determined(self) -> bool:
        """Whether the facts fix as many unknowns as there are, for nearly all values."""
        return len(self.basis) == len(self.system.unknowns)

    @property
    def has_solutions(self) -> bool:
        """Whether solutions can be worked out."""
        return self.is_readable and self.is_determined and self.profile.start.is_known

    @property
    def size(self) -> float:
        """The largest number that the words state, mm."""
        return max([1.0, *map(abs, self.system.amounts.values())])

    @property
    def reach(self) -> float:
        """The largest number that takes part, mm."""
        return self.size + float(max(map(abs, self.system.origin)))

    @property
    def band(self) -> float:
        """How far apart a circle and what it touches may be as floats see it, mm."""
        return ROUNDING * self.size

    def words(self, facts: Sequence[Fact]) -> list[str]:
        """The words that state facts, as typed; a fact that only the result has is called so."""
        return [self.label(word) for word in self.profile.words_of(facts)]

    def label(self, word: Word) -> str:
        """What checks call a word; a fact may be one that neither the program nor the command states."""
        return f"{word.text} (stated in the result only)" if word.span.line < -self.found.apart else word.text

    def increment(self, name: str) -> float:
        """The least increment of a given by its name, or of a coordinate by its axis, mm or degrees."""
        return self.profile.increments[INCREMENT_OF + name]

    def scalars(self, values: Array) -> dict[str, float]:
        """All scalars by their names."""
        return {**self.system.known, **dict(zip(self.system.unknowns, values.tolist(), strict=True))}

    def draw(self, scalars: Mapping[str, float]) -> Path:
        """The path at values of all scalars."""
        return Drawing(self.system, scalars).draw((self.increment(str(FIRST)), self.increment(str(SECOND))))

    def missed_by(self, fact: Fact, values: Array, signs: Mapping[str, int]) -> float:
        """How far a fact is from being true, mm; on the side that fits best where `signs` lack one."""
        tried = [{**dict.fromkeys(fact.sides(), side), **signs} for side in (1, -1)]
        return min((float(residual(fact, self.system.at(values, each))) for each in tried), key=abs)


def prepare(found: Found, *, has_cuts: bool = False) -> Case:
    """What the words and facts of a contour say, read with the tables of its control. Where it `has_cuts`, what the
    words leave open at their values is where its result has it, as far as that only cuts lines and arcs."""
    claim, statuses, ignored = found.claim, dict[str, str](), set[str]()
    unreadable = _unreadable(claim)
    if unreadable:
        statuses["rejected"] = f"{', '.join(unreadable)} cannot be read"
    variables = [word.text for word in claim.words.values() if word.number is None and not word.is_asked]
    if variables:
        statuses["underdetermined"] = f"{', '.join(variables)} depends on a variable"
    is_readable = not statuses
    is_extended = bool(claim.directives) or any(word.is_asked for word in claim.words.values())
    for offence in _offences(claim, found) if not any(block.faults for block in claim.blocks) else ():
        rule = offence.rule
        if offence.ignored:
            ignored.add(offence.ignored)
        elif rule.severity is Severity.ERROR and found.rules == "enforce" and not is_extended:
            statuses["no-solution" if rule.is_about_geometry else "rejected"] = f"the rule {rule.code} refuses it"
    plain = read(claim, frozenset(ignored))
    profile, faults = apply_statements(plain, claim.directives, lambda: found.next_end)
    wrong = [fault.message for fault in faults]
    wrong += [f"{given.name} is too large" for given in profile.givens.values() if abs(given.value) > LARGEST]
    if wrong:
        profile, is_readable, statuses["rejected"] = plain, False, "; ".join(wrong)
    if not profile.start.is_known:
        statuses.setdefault("underdetermined", "the start point is not known")
    system = _with_half_circles(profile, system_of(profile))
    chosen = rank.independent(rank.jacobian_at_random(system), rank.GENERIC) if is_readable else []
    if claim.form.is_general and is_readable and (has_cuts or len(chosen) < len(system.unknowns)):
        profile = _with_cuts(profile, found, is_first=has_cuts)
        system = _with_half_circles(profile, system_of(profile))
        chosen = rank.independent(rank.jacobian_at_random(system), rank.GENERIC)
    basis = tuple(profile.facts[number] for number in chosen)
    spare = tuple(fact for number, fact in enumerate(profile.facts) if number not in chosen)
    loose = dict(_structure(profile, free=len(system.unknowns) - len(basis), unknowns=len(system.unknowns)))
    if is_readable and not statuses.keys() & {"rejected", "no-solution"}:
        statuses = {**loose, **statuses}  # What a rule refuses counts once.
    return Case(found, profile, system, basis, spare, statuses, loose, is_readable)


def _with_cuts(profile: Profile, found: Found, *, is_first: bool) -> Profile:
    """The profile with the places that a result gives points which only cut a straight line in two, each between its
    neighbours; what else says where they are comes first, unless these are."""
    claimed, figure, start = found.claimed, profile.figure, profile.start.values
    if claimed is None or None in start:
        return profile
    at = {**claimed.points, figure.start: (float(start[FIRST] or 0), float(start[SECOND] or 0))}
    if claimed.end is not None:
        at[figure.path[-1].head] = claimed.end
    sharp = {corner.at for corner in figure.corners}
    facts, givens = list(profile.facts), dict(profile.givens)
    for first, second in pairwise(figure.path):
        point, ends = first.head, (first.tail, first.head, second.head)
        if point in sharp or not at.keys() >= set(ends):
            continue
        places = (complex(*at[end]) for end in ends)
        name = f"{point} as the result has it"
        if isinstance(first, Line) and isinstance(second, Line):
            axis = _axis_of_cut(*places)
            if axis is None:
                continue
            fact: Fact = Coordinate(name, point, axis)
            givens[name] = Given(name, Decimal(repr(at[point][axis])), Unit.MM, None)
        elif isinstance(first, Arc) and isinstance(second, Arc) and first.turn is second.turn:
            angle = _angle_of_cut(_centers_at(claimed.elements, at[point]), first.turn.sign, *places)
            if angle is None:
                continue
            fact = Ray(name, first.center, point)
            givens[name] = Given(name, Decimal(repr(angle)), Unit.DEGREE, None)
        else:
            continue
        facts.insert(0 if is_first else len(facts), fact)
    return replace(profile, layout=Layout(figure, tuple(facts)), givens=givens)


def _axis_of_cut(before: complex, here: complex, behind: complex) -> int | None:
    """The axis along which a point counts that lies between two others, on the line through them."""
    along = (behind - before) / abs(behind - before) if behind != before else 0j
    part = (here - before) * along.conjugate()
    is_between = abs(part.imag) <= RESIDUAL + PRINTED and 0 < part.real < abs(behind - before)
    return (FIRST if abs(along.real) >= abs(along.imag) else SECOND) if is_between else None


def _centers_at(elements: Sequence[ClaimedLine | ClaimedArc], at: Point) -> tuple[complex, complex] | None:
    """The centres of the two arcs of a result that meet in a point."""
    for one, other in pairwise(elements):
        if isinstance(one, ClaimedArc) and isinstance(other, ClaimedArc) and dist(one.end, at) <= RESIDUAL + PRINTED:
            return complex(*one.center), complex(*other.center)
    return None


def _angle_of_cut(
    centers: tuple[complex, complex] | None, sign: int, before: complex, here: complex, behind: complex
) -> float | None:
    """The direction from the centre to a point that lies between two others on an arc of this sense, where both arcs
    have one circle, degrees."""
    if centers is None or abs(centers[0] - centers[1]) > RESIDUAL + PRINTED:
        return None
    spokes = [each - centers[0] for each in (before, here, behind)]
    radii = [abs(each) for each in spokes]
    if max(radii) - min(radii) > RESIDUAL + PRINTED or min(radii) == 0:
        return None
    turned, whole = (sign * phase(each / spokes[0]) % tau for each in spokes[1:])
    # An arc that ends where it begins is a full circle.
    whole = tau if abs(behind - before) <= RESIDUAL + PRINTED else whole
    return degrees(phase(spokes[1])) if 0 < turned < whole else None


def _with_half_circles(profile: Profile, system: ResidualSystem) -> ResidualSystem:
    """The system where a radius that is too small for its two points, by no more than words are exact to, is just large
    enough."""
    known, amounts, steps = rank.rigid(system), dict(system.amounts), profile.increments
    on_it = [fact for fact in system.facts if isinstance(fact, OnCircle)]
    for fact in (each for each in system.facts if isinstance(each, Radius) and profile.givens[each.given].word):
        for one, other in combinations([each for each in on_it if each.radius == fact.radius], 2):
            names = [scalar(each.point, axis) for each in (one, other) for axis in (FIRST, SECOND)]
            if one.center == other.center and known.keys() >= set(names):
                chord = known[names[2]] - known[names[0]], known[names[3]] - known[names[1]]
                half, give = hypot(*chord) / 2, steps[INCREMENT_OF + fact.given] / 2 + RESIDUAL
                for axis, part in enumerate(chord):
                    give += abs(part) * steps[f"{INCREMENT_OF}{axis}"] / (4 * max(half, LENGTH))
                if 0 < half - amounts[fact.given] <= give:
                    amounts[fact.given] = half
    return replace(system, amounts=amounts)


def _unreadable(claim: ParsedContour) -> list[str]:
    """The characters and words of a contour's blocks that have no meaning, whatever the rules are."""
    words = [word for block in claim.blocks for word in block.words]
    faults = [fault for block in claim.blocks for fault in block.faults]
    values = [
        (word, claim.lexicon.value(word, claim.after.unit)) for word in words if word.address in claim.lexicon.addresses
    ]
    large = [word.text for word, value in values if value is not None and abs(value) > LARGEST]
    names = {row.fact.given for row in claim.form.facts} | {*claim.form.choices}
    names |= {name for row in claim.form.corners for name in row.shapes}
    known = [word for name, word in claim.words.items() if name in names]
    idle = [word.text for word in words if word.is_asked and word not in known]
    texts = [fault.text for fault in faults if fault.kind is not FaultKind.COMMENT_NOT_CLOSED]
    return [*texts, *large, *idle, *(word.text for word in (*claim.repeated, *claim.unknown))]


def _offences(claim: ParsedContour, found: Found) -> Iterator[Offence]:
    """Where rules of the control refuse or ignore words. A word that is asked for may fill a gap, but is never one
    too many."""
    if found.rules == "off":
        return
    stated, rules, roles = claim.stated(), found.dialect.rules, claim.form.roles
    sure = {name: value for name, value in stated.items() if name not in claim.words or not claim.words[name].is_asked}
    offences = check_rules(rules, roles, sure)
    codes = {each.rule.code for each in offences}
    yield from (each for each in offences if each.ignored)
    others = check_rules(rules, roles, stated)
    yield from (each for each in others if not each.ignored and each.rule.code in codes)


def _structure(profile: Profile, free: int, unknowns: int) -> Iterator[tuple[str, str]]:
    """Why the facts, whatever their values, make no single contour."""
    if free:
        yield "underdetermined", f"{free} of {unknowns} numbers are open"
    counts = Counter(corner.name for corner in profile.figure.corners)
    for corner in profile.figure.corners:
        given = profile.givens.get(corner.size)
        if given is not None and given.value < 0:
            yield "no-solution", f"{corner.name} has a negative size"
        if corner.after is None and corner.lands_parallel_to is None and corner.lands_on is None:
            yield "underdetermined", f"no word says where {corner.name} lands"
        if counts[corner.name] > 1:
            yield "conflicting", f"{corner.name} is stated twice"


# --- Solutions that are worked out here ------------------------------------------------------------


class Candidate(Struct, frozen=True):
    """A solution of the facts that fix the points: its path, and which of the other facts it is against.

    `is_hidden` tells that several have become one there, `is_open` that the facts leave a point free at their values,
    although not at others.
    """

    values: Array
    signs: Mapping[str, int]
    path: Path
    conflicts: tuple[Fact, ...]
    agreeing: tuple[Fact, ...]
    is_chosen: bool
    is_hidden: bool
    is_open: bool

    @property
    def is_path(self) -> bool:
        """Whether a control can make it."""
        return not self.conflicts and not self.path.against


def candidates(case: Case, near: Sequence[Array] = ()) -> list[Candidate]:
    """The solutions that are found; those near what claimed ones tell (NaN where they do not) are among them."""
    system, found = case.system, list[tuple[Array, dict[str, int]]]()
    if not system.unknowns:
        found = [(system.zero, {})]
    elif not rank.is_linear(system):
        found = rank.search(system, case.basis, case.size, near)
    else:
        rows, off = system.linearised(case.basis)
        if len(rank.independent(rows, REGULAR)) == len(system.unknowns):
            found = [(numpy.linalg.solve(rows, -off), {})]
    kept: list[Candidate] = []
    for each in (_candidate(case, *one) for one in found):
        # Where several have become one, none is found to the last digit.
        twins = [one for one in kept if one.is_hidden]
        if each and all(abs(one.values - each.values).max() > HIDDEN * case.size for one in twins):
            kept.append(each)
    return kept


def _candidate(case: Case, values: Array, signs: Mapping[str, int]) -> Candidate | None:
    """A solution of the basis; None where what must be positive is not."""
    moved = rank.correct(case.system, case.basis, values, signs, case.band, case.band * FEW)
    if float(abs(moved.by).max(initial=0.0)) < rank.APART * case.size:
        values = values + moved.by
    at, scalars = case.system.at(values, signs), case.scalars(values)
    if any(sense < -AGREEMENT * RESIDUAL for fact in case.basis for sense in senses(fact, at)):
        return None
    for line in (*case.system.figure.path, *case.system.figure.lines):
        cosine, sine, _ = line_scalars(line.name)
        if cosine in scalars and line.head:
            ends = at.way(line.tail, line.head)
            if ends[0] * scalars[cosine] + ends[1] * scalars[sine] < -LENGTH:
                return None
    conflicts = tuple(fact for fact in case.spare if not agrees(case, fact, values, signs))
    agreeing = tuple(fact for fact in case.spare if fact.given and fact not in conflicts)
    agreed = {choice: is_on_side(case, scalars, choice) for choice in case.profile.choices}
    if not all(is_right for choice, is_right in agreed.items() if not choice.given):
        return None  # The form itself has no other place.
    path = case.draw(scalars)
    return Candidate(values, signs, path, conflicts, agreeing, all(agreed.values()), moved.is_hidden, moved.is_open)


def is_on_side(case: Case, scalars: Mapping[str, float], choice: Choice) -> bool:
    """Whether a point is where a choice has it, or in the one place that there is."""
    side = side_of(case.system, scalars, choice)
    return side is None or side[0] > 0 or side[1] <= FEW * case.band


def allowance(case: Case, fact: Fact, values: Array, signs: Mapping[str, int]) -> float:
    """How far a fact may miss what others say, mm: coordinates and words are exact to half of their increments."""
    if isinstance(fact, OnCircle) and not fact.given:
        return fact.slack
    if isinstance(fact, Coordinate | Offset):
        own = case.increment(str(fact.axis)) * (2 if isinstance(fact, Offset) else 1)
        return (own + case.increment(fact.given)) / 2 + RESIDUAL
    if isinstance(fact, Heading):
        cosine, sine = case.system.directions[fact.given]
        swing = norm(case.system.at(values, signs).way(fact.tail, fact.head)) * pi / 180 * case.increment(fact.given)
        across = abs(sine) * case.increment(str(FIRST)) + abs(cosine) * case.increment(str(SECOND))
        return float(across + swing / 2 + RESIDUAL)
    return case.increment(fact.given) + RESIDUAL if isinstance(fact, Radius) else AGREEMENT


def difference(case: Case, fact: Fact, values: Array, signs: Mapping[str, int]) -> tuple[float, float]:
    """How far a fact that is not needed is from being true of a solution, and how far it may be, mm."""
    off, allowed = abs(case.missed_by(fact, values, signs)), allowance(case, fact, values, signs)
    at = case.system.at(values, signs)
    if isinstance(fact, TurnBetween | Directed | Ray) and min(senses(fact, at)) < 0:
        off = inf
    lines = (each for each in case.profile.figure.path if isinstance(each, Line))
    if isinstance(fact, Heading) and any(each.heading == fact.given for each in lines) and is_against(case, fact, at):
        off = inf
    return off, allowed


def is_against(case: Case, fact: Heading, at: Place) -> bool:
    """Whether a line runs against the direction that a fact states."""
    way, along = at.way(fact.tail, fact.head), case.system.directions[fact.given]
    return float(way[0] * along[0] + way[1] * along[1]) < -LENGTH


def agrees(case: Case, fact: Fact, values: Array, signs: Mapping[str, int]) -> bool:
    """Whether a fact that is not needed is true of a solution."""
    off, allowed = difference(case, fact, values, signs)
    return off <= allowed


# --- The status ------------------------------------------------------------------------------------


def expected(case: Case, found: Sequence[Candidate]) -> tuple[str | None, str]:
    """The status that words and solutions give a contour, and why; None where it was not worked out."""
    if case.claim.form.is_general:
        return None, "the status of a free contour was not worked out"
    statuses, is_linear = dict(case.statuses), rank.is_linear(case.system)
    if not case.is_readable or "rejected" in statuses:
        return _first(statuses)
    if case.loose or not case.profile.start.is_known or (is_linear and not found):
        if case.profile.start.is_known and is_linear:
            statuses = {**dict(said_twice(case)), **statuses}
        elif case.profile.start.is_known and case.spare and "conflicting" not in statuses:
            return None, "what is said twice of a part of a contour was not worked out"
        return _first(statuses)
    eligible = [each for each in found if each.is_chosen]
    paths, fits = [each for each in eligible if each.is_path], [each for each in eligible if not each.conflicts]
    selecting = {fact for each in found for fact in each.conflicts}
    if len(paths) > 1:
        statuses["ambiguous"] = f"{len(paths)} paths agree with the words"
    elif not paths:
        known = rank.rigid(case.system)
        clear = [fact for fact in case.spare if not found and known.keys() >= set(fact.reads())]
        at = numpy.array([known.get(name, 0.0) for name in case.system.unknowns])
        if any(not agrees(case, fact, at, {}) for fact in clear):
            statuses["conflicting"] = "what the words fix is against other words"
        statuses["no-solution"] = "; ".join(fits[0].path.against) if fits else "no solution was found"
        if eligible and not fits:
            words = ", ".join(case.words(eligible[0].conflicts)) or "a circle"
            statuses["conflicting"] = f"against the others: {words}"
    for each in paths[:1] or fits[:1]:
        if set(each.agreeing) - selecting and "ambiguous" not in statuses:
            statuses["overdetermined"] = f"said twice: {', '.join(case.words(each.agreeing))}"
    return _first(statuses)


def _first(statuses: Mapping[str, str]) -> tuple[str, str]:
    status = min(statuses, key=get_args(Status).index, default="solved")
    return status, statuses.get(status, "one path agrees with the words")


def said_twice(case: Case) -> Iterator[tuple[str, str]]:
    """How facts about lines that follow from those before them compare with these, whatever else is missing."""
    rows, off = case.system.linearised(case.profile.facts)
    generic, basis = rank.jacobian_at_random(case.system), list[int]()
    for number, fact in enumerate(case.profile.facts):
        if len(rank.independent(rows[[*basis, number]], REGULAR)) > len(basis):
            basis.append(number)
            continue
        gap, values, is_fixed = rank.compare(rows, off, basis, number)
        is_tied = len(rank.independent(generic[[*basis, number]], rank.GENERIC)) == len(basis)
        names = ", ".join(case.words([fact]))
        if is_tied and is_fixed:
            is_right = gap <= allowance(case, fact, values, {})
            yield ("overdetermined" if is_right else "conflicting"), f"{names} repeats others"
        else:
            yield ("underdetermined" if gap <= RESIDUAL else "no-solution"), f"{names} follows from others at its value"
