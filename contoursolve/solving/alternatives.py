"""Every contour that satisfies a profile, named and certified, and which one the control takes."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from math import inf

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.geometry import (
    FIRST,
    SECOND,
    Arc,
    Choice,
    Profile,
    System,
    Unit,
    Values,
    assemble,
    scalar,
)
from contoursolve.numeric import COSINE, SINE, Created, Number, ball
from contoursolve.solving.certify import certificate_of
from contoursolve.solving.checks import MeasuredFigure, unverified
from contoursolve.solving.compare import compare_fact, increments_of
from contoursolve.solving.compile import compile_corners, compile_path
from contoursolve.solving.determinacy import analyse, basis_of, circuits_of, groups_of, spare_of
from contoursolve.solving.enumerate import Enumeration, ExactSolution, enumerate_solutions
from contoursolve.solving.events import NoteKind, RefusalKind, Status, Topic, refusals_about
from contoursolve.solving.exact_inputs import ground_of
from contoursolve.solving.judge import MeasuredPath, judge_path, judge_range, vanishing_lines
from contoursolve.solving.krawczyk import Prover
from contoursolve.solving.numbers import corner_of
from contoursolve.solving.partition import Group, order
from contoursolve.solving.path_outputs import PathOutputs
from contoursolve.solving.picks import pick
from contoursolve.solving.sides import BOTH, sides_of
from contoursolve.solving.solution import (
    Alternative,
    Alternatives,
    Certificate,
    CornerSolution,
    Doubt,
    Note,
    Obstacle,
    Point,
    Proof,
    Refusal,
    SystemSolution,
)
from contoursolve.tolerance import LENGTH, RESIDUAL


def find_alternatives(profile: Profile, enumeration: Enumeration | None = None) -> Alternatives:
    """Every solution of a profile whose system is determined and whose start is known; `enumeration` is what was found
    of it among others."""
    return _find(_Question(profile)) if enumeration is None else _alternatives(profile, enumeration)


class _Question:
    """A profile, equal to others with the same equations and values: what chooses among their solutions may differ."""

    def __init__(self, profile: Profile) -> None:
        self.profile = profile
        picked = {each.given for each in profile.picks}
        stated = (each for name, each in profile.givens.items() if name not in picked)
        givens = tuple((each.name, each.value, each.unit, each.word is None) for each in stated)
        which = assemble(profile), profile.plane, profile.unit, profile.start, profile.choices
        self._key = (*which, profile.travel, givens)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Question) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)


@lru_cache(maxsize=16)
def _find(question: _Question) -> Alternatives:
    """The solutions; repairs ask again and again for the same drawing, with other words that choose."""
    profile = question.profile
    return _alternatives(profile, enumerate_solutions(profile, assemble(profile)))


def _alternatives(profile: Profile, enumeration: Enumeration) -> Alternatives:
    system = assemble(profile)
    # Where a direction that was not needed leaves nothing, it is what disagrees.
    stated = frozenset(fact for fact in spare_of(system) if fact.is_ray)
    if stated and not enumeration.found:
        enumeration = enumerate_solutions(profile, system, stated)
    if not enumeration.found and (exact := _exact_first(system)) is not None:
        again = enumerate_solutions(profile, exact)
        system, enumeration = (exact, again) if again.found else (system, enumeration)
    with ball.precision(ball.WORKING):
        prover = Prover(system, groups_of(system), ground_of(profile))
        items = [_alternative(profile, system, prover, found) for found in enumeration.found]
    doubts = enumeration.doubts
    if any(refusal.kind.event.topic is Topic.ARITHMETIC for item in items for refusal in item.solution.refusals):
        doubts = (*doubts, Doubt((), Obstacle.UNDECIDED))
    # What the form chooses by itself is no alternative for a user.
    items = [item for item in items if _agrees(item, [choice for choice in profile.choices if not choice.given])]
    return Alternatives(tuple(_named(items, profile)), doubts, enumeration.within, enumeration.boxes)


def _exact_first(system: System) -> System | None:
    """The system with a basis of what holds exactly and of words, where some of the former is beside its basis; None
    for nowhere. Where words say something twice and differ by rounding, a word is what is not needed, never that an arc
    begins where it touches. Of the words, the one that leaves the smallest groups to solve goes; larger ones than those
    of the basis may take minutes, and are not tried."""
    if all(fact.given for fact in spare_of(system)):
        return None
    first = system.keep(tuple(sorted(system.facts, key=lambda fact: bool(fact.given))))
    basis = basis_of(first)
    bases = [basis]
    for spare, others in circuits_of(first).items():
        bases += [tuple(spare if fact is word else fact for fact in basis) for word in others if word.given]
    sizes, number = min((_group_sizes(order(system, each)), number) for number, each in enumerate(bases))
    if sizes >= _group_sizes(groups_of(system)):
        return None
    return system.keep((*bases[number], *(fact for fact in first.facts if fact not in bases[number])))


def _group_sizes(groups: Iterable[Group]) -> list[int]:
    """The numbers of unknowns that are solved together, the largest first."""
    return sorted((len(group.unknowns) for group in groups), reverse=True)


def choose(alternatives: Alternatives, choices: tuple[Choice, ...]) -> tuple[Alternative, ...]:
    """The solutions that agree with the control's choices; a double solution agrees with either side."""
    return tuple(item for item in alternatives.items if _agrees(item, choices))


def _agrees(item: Alternative, choices: Sequence[Choice]) -> bool:
    return all(item.sides.get(choice.point) in (choice.side.value, BOTH, None) for choice in choices)


def _alternative(profile: Profile, system: System, prover: Prover, found: ExactSolution) -> Alternative:
    proven = prover.prove(found.scalars, found.signs)
    boxes = found.scalars if proven is None else proven
    scalars = {name: ball.middle(value) for name, value in boxes.items()}
    path = _Path.at(profile, system, boxes)
    at = prover.ground.values(boxes, found.signs, system)
    residuals = [fact.residual(at) for fact in system.facts]
    refusals, remarks = _compare(profile, system, residuals, at, scalars)
    if not refusals:
        measured = path.measured()
        refusals += judge_range(measured)
        if not refusals:
            refusals += judge_path(measured)
            remarks += vanishing_lines(system.figure, path.measures)
    sides = sides_of(system, at, {choice.point for choice in profile.choices})
    # A circle about the middle of two of its points is an ordinary half circle.
    centers = {element.center for element in system.figure.path if isinstance(element, Arc)}
    gap = 0.0 if any(name.rpartition(".")[0] not in centers for name in found.doubles) else None
    if gap is not None:
        subject = _touching(system, found)
        kind = NoteKind.TOUCHES if sides.get(subject) == BOTH else NoteKind.DOUBLE
        remarks.append(Note(kind, subject, (), {}))
    places = [(box, scalars[name]) for name, box in boxes.items()]
    if proven is None:
        certificate = _doubtful(found, places, gap)
    else:
        corners = None if refusals else _corner_places(profile, path.numbers, path.out)
        certificate = certificate_of([*places, *(corners or ())], residuals, gap)
        if corners is None and not refusals:
            reason = "interval arithmetic cannot decide a corner"
            certificate = Certificate(Proof.VERIFIED, certificate.radius, reason, gap)
    solution = path.solution(scalars, refusals, remarks)
    solution = replace(solution, error_bound=certificate.radius, certificate=certificate)
    return Alternative(solution, scalars, sides, certificate)


class _Path(Struct, frozen=True):
    """A path at places of all unknowns, as balls: the inputs of its function, the outputs, and its measures."""

    profile: Profile
    system: System
    numbers: Mapping[str, Number]
    sizes: Mapping[str, float]
    values: Mapping[str, float]
    out: Mapping[str, float]
    measures: PathOutputs

    @classmethod
    def at(cls, profile: Profile, system: System, boxes: Mapping[str, Number]) -> "_Path":
        """The path at these values of the unknowns, mm."""
        machine = compile_path(system)
        numbers = _path_numbers(profile, system, boxes)
        values = {name: ball.middle(value) for name, value in numbers.items()}
        sizes = {name: ball.middle(value) for name, value in _sizes(profile, boxes).items()}
        out = machine.function(values)
        return cls(profile, system, numbers, sizes, values, out, machine.path.read(out.__getitem__))

    def measured(self) -> MeasuredPath:
        """The same, to be judged."""
        machine, profile = compile_path(self.system), self.profile
        figure = MeasuredFigure(self.system.figure, Values(self.values, {}, {}), self.measures, increments_of(profile))

        def resized(sizes: Mapping[str, float]) -> PathOutputs:
            return machine.path.read(machine.function({**self.values, **sizes}).__getitem__)

        return MeasuredPath(profile, figure, self.sizes, resized)

    def solution(self, scalars: Mapping[str, float], refusals: list[Refusal], remarks: list[Note]) -> SystemSolution:
        """The contour, or what speaks against it."""
        figure, starts = self.system.figure, [float(value or 0) for value in self.profile.start.values]
        status = _status(refusals, remarks)
        if refusals:
            return SystemSolution(status, refusals=tuple(refusals), remarks=tuple(remarks))
        points = {name: (scalars[scalar(name, FIRST)], scalars[scalar(name, SECOND)]) for name in figure.points}
        points[figure.start] = starts[FIRST], starts[SECOND]
        return SystemSolution(
            status,
            points=points,
            radii={name: scalars[name] for name in figure.radii},
            corners=_corners(self.system, self.values, self.measures, starts),
            remarks=tuple(remarks),
            scalars=scalars,
        )


def drawn_at(profile: Profile, scalars: Mapping[str, float]) -> SystemSolution:
    """The path at a place of all unknowns (mm) at which facts hold, with its corners, or what speaks against it."""
    path = _Path.at(profile, assemble(profile), {name: ball.exact(value) for name, value in scalars.items()})
    measured = path.measured()
    return path.solution(scalars, judge_range(measured) or judge_path(measured), [])


def _doubtful(found: ExactSolution, places: Sequence[tuple[Number, float]], gap: float | None) -> Certificate:
    if found.doubles:
        radius = certificate_of(places).radius
        return Certificate(Proof.VERIFIED, radius, "two solutions have become one, so no proof can part them", gap)
    return Certificate(Proof.UNKNOWN, inf, "nothing near it could be proven to hold this solution alone", gap)


def _corner_places(
    profile: Profile, numbers: Mapping[str, Number], out: Mapping[str, float]
) -> list[tuple[Number, float]] | None:
    """The places of the corners, each with its float among the outputs of the path, of which `numbers` are the inputs;
    None where balls do not tell which way one turns."""
    if not profile.figure.corners:
        return []
    function, axes = compile_corners(assemble(profile))
    try:
        found = function.replay([numbers[name] for name in function.inputs])
    except (ArithmeticError, ValueError):
        return None
    origin = [value for value in profile.start.values if value is not None]
    return [
        (value + ball.exact(origin[axis]), out[name] + float(origin[axis]))
        for value, (name, axis) in zip(found, axes, strict=True)
    ]


def _status(refusals: list[Refusal], remarks: list[Note]) -> Status:
    if refusals:
        found = {refusal.kind.status for refusal in refusals}
        return next(status for status in Status if status in found)
    agrees = any(remark.kind is NoteKind.WORDS_AGREE for remark in remarks)
    return Status.OVERDETERMINED if agrees else Status.SOLVED


def _path_numbers(profile: Profile, system: System, boxes: Mapping[str, Number]) -> dict[str, Number]:
    """All inputs of the path at these points, which count from the start."""
    figure = system.figure
    origin = [ball.exact(value) for value in profile.start.values if value is not None]
    numbers = dict(boxes)
    for axis in (FIRST, SECOND):
        numbers |= {scalar(point, axis): boxes[scalar(point, axis)] - origin[axis] for point in figure.points}
        numbers[scalar(figure.start, axis)] = ball.exact(0.0)
    numbers |= _sizes(profile, numbers)
    for given in profile.givens.values():
        if given.unit is Unit.DEGREE:
            numbers[given.name + COSINE], numbers[given.name + SINE] = ball.direction(given.value)
        else:
            numbers.setdefault(given.name, ball.exact(given.value))
    for place in figure.places:
        for axis in (FIRST, SECOND):
            name = scalar(place, axis)
            numbers[name] = ball.exact(profile.givens[name].value) - origin[axis]
    return numbers


def _corners(
    system: System, values: Mapping[str, float], measures: PathOutputs, starts: list[float]
) -> dict[str, CornerSolution]:
    """The corners of a path in numbers."""

    def absolute(point: Point) -> Point:
        return point[FIRST] + starts[FIRST], point[SECOND] + starts[SECOND]

    corners = {corner.name: values[corner.size] for corner in system.figure.corners}
    return {name: corner_of(measures.corners[name], size, absolute) for name, size in corners.items()}


def _sizes(profile: Profile, numbers: Mapping[str, Number]) -> dict[str, Number]:
    """The sizes of all corners by the words that state or ask for them."""
    found, givens = dict[str, Number](), profile.givens
    for corner in profile.figure.corners:
        if corner.radius in numbers:
            found[corner.size] = numbers[corner.radius]
        if corner.size in givens:
            found[corner.size] = ball.exact(givens[corner.size].value)
    return found


def _compare(
    profile: Profile, system: System, residuals: Sequence[Number], at: Values, scalars: Mapping[str, float]
) -> tuple[list[Refusal], list[Note]]:
    """Every original equation in exact arithmetic; what was not needed must agree as well as words can."""
    refusals: list[Refusal] = []
    remarks: list[Note] = []
    basis = frozenset(analyse(system).basis)
    floats = Values(
        {**scalars, **{name: ball.middle(value) for name, value in at.scalars.items()}},
        {name: ball.middle(value) for name, value in at.amounts.items()},
        Created(lambda name: tuple(map(ball.middle, at.directions[name]))),
        at.headed,
        at.signs,
    )
    for index, (fact, residual) in enumerate(zip(system.facts, residuals, strict=True)):
        off = ball.distance(residual, 0.0)
        if index in basis:
            if not off <= RESIDUAL:  # true for NaN
                refusals.append(unverified(off))
            continue
        event = compare_fact(fact, off, profile, system, floats)
        if isinstance(event, Refusal):
            refusals.append(event)
        elif event is not None:
            remarks.append(event)
    return refusals, remarks


def _touching(system: System, found: ExactSolution) -> str:
    """The point at which two solutions have become one; a centre only if there is no other."""
    points = {name.rpartition(".")[0] for name in found.doubles}
    centers = {fact.circle.center for fact in system.facts if fact.circle}
    touching = [point for point in system.figure.points if point in points]
    return next(iter(sorted(touching, key=centers.__contains__)), "the contour")


def _named(items: list[Alternative], profile: Profile) -> Iterator[Alternative]:
    """Every solution with a name made of the sides in which it differs from the others."""
    centers = {arc.name: arc.center for arc in profile.figure.path if isinstance(arc, Arc)}
    differing = [
        key
        for key in dict.fromkeys(key for item in items for key in item.sides)
        if len({item.sides.get(key) for item in items}) > 1 and not _is_fixed(centers.get(key, key), items)
    ]
    shown = [", ".join(f"{key} {item.sides[key]}" for key in differing if key in item.sides) for item in items]
    for number, item in enumerate(items):
        same = [other for other, name in zip(items, shown, strict=True) if name == shown[number]]
        place = _place(item, same, profile) if len(same) > 1 else ""
        yield replace(item, name=", ".join(filter(None, (shown[number], place))))


def _is_fixed(key: str, items: list[Alternative]) -> bool:
    """Whether a key is that of a point that lies in the same place in all solutions."""
    names = [scalar(key, axis) for axis in (FIRST, SECOND)]
    return all(
        name in item.scalars and abs(item.scalars[name] - items[0].scalars[name]) <= LENGTH
        for item in items
        for name in names
    )


def _apart(values: Iterable[float]) -> list[float]:
    """Values in order; of those that are one, the first."""
    found: list[float] = []
    for value in sorted(values):
        if not found or value - found[-1] > LENGTH:
            found.append(value)
    return found


_RANKS = ("lowest", "second lowest", "third lowest", "fourth lowest")


def _place(item: Alternative, same: list[Alternative], profile: Profile) -> str:
    """The name of one of several solutions: the first coordinate or radius in which they differ."""
    for key in item.scalars:
        values = _apart(other.scalars[key] for other in same)
        if len(values) > 1 and not key.endswith((".cos", ".sin", ".off")):
            rank = sum(value < item.scalars[key] - LENGTH for value in values)
            point, _, axis = key.rpartition(".")
            what = f"{profile.plane.axes[int(axis)]} of {point}" if axis.isdigit() else key
            if rank == len(values) - 1:
                return f"{what} highest"
            return f"{what} {_RANKS[rank] if rank < len(_RANKS) else f'{rank + 1}th lowest'}"
    return ""


def decide(alternatives: Alternatives, profile: Profile) -> SystemSolution:
    """The contour of a profile, of whose equations these are the solutions.

    Several contours, between which nothing chooses, are ambiguous.
    """
    eligible = choose(alternatives, profile.choices)
    paths, events = [item for item in eligible if item.is_path], list[Refusal | Note]()
    if profile.picks:
        # They are put in order to be counted.
        paths, events = pick(paths, profile)
    refusals = tuple(event for event in events if isinstance(event, Refusal))
    if refusals:
        return SystemSolution(Status.NO_SOLUTION, refusals=refusals)
    notes = tuple(event for event in events if isinstance(event, Note))
    count = {"actual": float(len(paths))}
    if len(paths) > 1:
        return SystemSolution(Status.AMBIGUOUS, remarks=(*notes, Note(NoteKind.SEVERAL, "", (), count)))
    if paths:
        solution = _without_selecting(paths[0].solution, alternatives)
        solution = replace(solution, remarks=(*solution.remarks, *notes))
        if alternatives.is_complete:
            return solution
        # Two that have become one are one contour, and what a word has chosen from others is the one that is meant.
        is_open = any(doubt.obstacle is not Obstacle.TOUCHING for doubt in alternatives.doubts)
        if len(alternatives.paths) == 1 and (is_open or not paths[0].certificate.is_double):
            kind = RefusalKind.COUNT_OPEN
            return SystemSolution(kind.status, refusals=(Refusal(kind, "", (), count),), remarks=solution.remarks)
        return replace(solution, remarks=(*solution.remarks, Note(NoteKind.COUNT_OPEN, "", (), count)))
    return _refused(eligible, alternatives)


_AGAINST_OTHERS = refusals_about(Topic.WORD, Topic.FACT)


def _without_selecting(solution: SystemSolution, alternatives: Alternatives) -> SystemSolution:
    """A solution without the remark that a word was not needed, where the word tells it from another solution."""
    selecting = {
        refusal.subject
        for item in alternatives.items
        for refusal in item.solution.refusals
        if refusal.kind in _AGAINST_OTHERS
    }
    remarks = tuple(
        remark
        for remark in solution.remarks
        if remark.kind is not NoteKind.WORDS_AGREE or remark.subject not in selecting
    )
    agrees = any(remark.kind is NoteKind.WORDS_AGREE for remark in remarks)
    return replace(solution, status=Status.OVERDETERMINED if agrees else Status.SOLVED, remarks=remarks)


def _refused(items: tuple[Alternative, ...], alternatives: Alternatives) -> SystemSolution:
    """The reasons why there is no contour: the refusals of the first of the solutions, or that there is none. Where a
    search was given up, there may be others."""
    given_up = (Obstacle.UNFINISHED, Obstacle.FARTHER)
    is_open = any(doubt.obstacle in given_up for doubt in alternatives.doubts)
    if items and not is_open:
        return items[0].solution
    kind = RefusalKind.NO_POINT if alternatives.is_complete else RefusalKind.SEARCH_UNFINISHED
    return SystemSolution(kind.status, refusals=(Refusal(kind, ""),))
