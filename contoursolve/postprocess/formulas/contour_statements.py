"""A contour as statements of a macro language: values in the order of need, conditions that stop, legs of a path."""

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import count
from typing import Any

from msgspec import Struct

from contoursolve.execution import Assign, When
from contoursolve.families import ORIGIN
from contoursolve.geometry import FIRST, SECOND, Arc, Profile, assemble, scalar
from contoursolve.numeric import (
    AT_MOST,
    COMMON,
    LESS,
    SIDE,
    SIGN,
    TURNED,
    ZERO,
    Affine,
    Apply,
    Constant,
    Tape,
    Term,
    Variable,
    at_most,
    formulas_of,
    magnitude,
)
from contoursolve.postprocess.formulas.word_dependence import FormulaError, Reader, less
from contoursolve.solving import (
    Check,
    MeasuredFigure,
    Test,
    axes_of,
    is_closed,
    plain_checks,
    points_with_two_solutions,
)
from contoursolve.tolerance import LARGEST

SHORTEST = 1e-6
"""mm squared. The least increment, squared: an arc whose ends are nearer is a line, for it could be a full turn."""

LONGEST_TERM, DEEPEST_TERM = 60, 3
"""Characters and brackets in brackets of an expression that a control surely reads in one block."""
LONGEST_MARGIN = 25
"""Characters of one beside which a message stands."""


class Stop(Struct, frozen=True):
    """The machine stops where a condition holds, and says why."""

    condition: Term
    message: str


class Leg(Struct, frozen=True):
    """A line, or an arc about a centre that is counted from where it begins: its end as words have it, whether it turns
    left (a number above 0), and the square of its chord."""

    name: str
    end: tuple[Term, Term]
    center: tuple[Term, Term] | None = None
    turn: Term | None = None
    chord: Term | None = None


class Choose(Struct, frozen=True):
    """Other statements where a condition holds, or where it does not."""

    condition: Term
    then: tuple["Statement", ...]
    otherwise: tuple["Statement", ...]


class Said(Struct, frozen=True):
    """A line that stays as it is."""

    text: str


Statement = Assign | When | Stop | Leg | Choose | Said


class BlockUnits(Struct, frozen=True):
    """Units of a block: words for a mm on each axis, and whether its ends count from where its elements begin."""

    scales: tuple[float, float]
    is_incremental: bool


class Body(Struct, frozen=True):
    """A contour of one case: its statements, each leg behind what it needs, where it ends, as absolute words, and where
    other cases are refused."""

    formulas: tuple[Statement, ...]
    end: tuple[Term, Term]
    stops: tuple[Stop, ...] = ()

    @property
    def statements(self) -> tuple[Statement, ...]:
        """Everything, in order."""
        return (*self.stops, *self.formulas)


def body_of(reader: Reader, profile: Profile, stated: Mapping[str, Affine], writing: Mapping[str, BlockUnits]) -> Body:
    """The statements of a contour of one case; `writing` goes by the names of elements and corners. Raises
    FormulaError where a step has no closed form."""
    system = assemble(profile)
    if profile.is_extended:
        raise FormulaError("what it states besides its words has no closed form")
    if not is_closed(system):
        raise FormulaError("a step of it has no closed form")
    chosen = {choice.point for choice in profile.choices}
    loose = [point for point in points_with_two_solutions(system) if point not in chosen]
    if loose:
        raise FormulaError(f"nothing chooses between the two places of {loose[0]}")
    tape, measured, checks = plain_checks(system)
    absent = {
        corner.name: LARGEST * at_most(magnitude(tape.input(corner.size)), ZERO)
        for corner in profile.figure.corners
        if corner.size in free_sizes(profile, stated)
    }
    """Added to what is asked of corners, where their size may be 0: then there is none."""
    margins = [_failing(check, margin, absent.get(check.subject)) for check, margin in checks]
    path = list(_path(tape, measured, profile, writing))
    outputs = [margin for margin, *_ in margins]
    for leg in path:
        outputs += leg.values
    inputs, signs = _inputs(reader, profile, stated)
    formulas = formulas_of(tape, outputs, inputs, signs)
    results = iter(formulas.results)
    maker = _Maker(formulas.steps, formulas.rooted)
    for (check, _), (_, kind, limit) in zip(checks, margins, strict=True):
        maker.stop(next(results), kind, limit, message_of(check, profile))
    for leg in path:
        maker.leg(leg.name, [next(results) for _ in leg.values], writing[leg.name].is_incremental)
    return Body(tuple(maker.statements), maker.end)


def _inputs(
    reader: Reader, profile: Profile, stated: Mapping[str, Affine]
) -> tuple[dict[str, Affine], dict[str, Affine]]:
    """The inputs of the functions of a contour, and those that are the sign of a value."""
    system = assemble(profile)
    start = [
        reader.axes.get(axis, Affine({}, value or Decimal(0)))
        for axis, value in zip(profile.plane.axes, profile.start.values, strict=True)
    ]
    nothing = Affine({}, Decimal(0))
    found = {scalar(profile.figure.start, axis): nothing for axis in (FIRST, SECOND)}
    found |= {f"{ORIGIN}{axis}": each for axis, each in enumerate(start)}
    axes = axes_of(system)
    found |= {
        name: less(each, start[axes[name]]) if name in axes else each
        for name, each in stated.items()
        if name in profile.givens
    }
    found |= {name: Affine({}, Decimal(repr(each))) for name, each in profile.increments.items()}
    signs = dict[str, Affine]()
    for choice in profile.choices:
        own, side = stated.get(choice.given, nothing), Decimal(choice.side.sign)
        if own.factors and reader.is_turned(choice, own):
            factor = side if profile.givens[choice.given].value > 0 else -side
            signs[SIDE + choice.point] = Affine(
                {name: each * factor for name, each in own.factors.items()}, own.constant * factor
            )
        found[SIDE + choice.point] = Affine({}, side)
    return found, signs


class _Way(Struct, frozen=True):
    """A leg as expressions: its end, the centre from its start, its turn and the square of its chord, in this order."""

    name: str
    values: tuple[Any, ...]


def _path(tape: Tape, measured: MeasuredFigure, profile: Profile, writing: Mapping[str, BlockUnits]) -> Iterator[_Way]:
    """The elements and corners of a path, as `solving.contour.trace` has them."""
    figure = profile.figure
    corners = {corner.at: corner for corner in figure.corners}
    origin = tape.input(f"{ORIGIN}0"), tape.input(f"{ORIGIN}1")
    here = measured.point(figure.start)

    def way(name: str, end: Any, center: Any = None, turn: Any = None) -> _Way:
        scales, is_incremental = writing[name].scales, writing[name].is_incremental
        steps = [end[axis] - here[axis] for axis in (FIRST, SECOND)]
        own = [steps[axis] if is_incremental else origin[axis] + end[axis] for axis in (FIRST, SECOND)]
        values = [own[axis] * scales[axis] for axis in (FIRST, SECOND)]
        if is_incremental:
            values += [(origin[axis] + end[axis]) * scales[axis] for axis in (FIRST, SECOND)]
        if center is not None:
            # A centre is no diameter, but has the unit of the program.
            unit, chord = min(scales), steps[0] * steps[0] + steps[1] * steps[1]
            spoke = [center[axis] - here[axis] for axis in (FIRST, SECOND)]
            values += [spoke[axis] * unit for axis in (FIRST, SECOND)]
            values += [turn, chord]
        return _Way(name, tuple(values))

    for element in figure.path:
        corner = corners.get(element.head)
        end = measured.point(element.head)
        if corner is not None:
            end = measured.path.corners[corner.name].begin
        if isinstance(element, Arc):
            yield way(element.name, end, measured.point(element.center), element.turn.sign)
        else:
            yield way(element.name, end)
        here = end
        if corner is not None:
            built = measured.path.corners[corner.name]
            end = built.end
            yield way(corner.name, end, built.center, built.turn)
            here = end


def free_sizes(profile: Profile, stated: Mapping[str, Affine]) -> list[str]:
    """The sizes of corners that follow variables."""
    sizes = dict.fromkeys(corner.size for corner in profile.figure.corners)
    return [size for size in sizes if size in stated and stated[size].factors]


def _failing(check: Check, margin: Any, more: Any) -> tuple[Any, str, float]:
    """A margin and what is added to it, the comparison in which a check fails, and with what."""
    if more is not None:
        margin = (magnitude(margin) if check.test is Test.APART else margin) + more
    match check.test:
        case Test.AT_LEAST | Test.NOT_BELOW:
            return margin, LESS, min(check.limit, -ZERO) if check.limit <= 0 else check.limit
        case Test.ABOVE:
            return margin, AT_MOST, max(check.limit, ZERO)
        case Test.APART:
            return magnitude(margin), AT_MOST, max(check.limit, ZERO)


class _Maker:
    """Puts formulas into the order in which statements need them."""

    def __init__(self, steps: Mapping[str, Term], rooted: frozenset[str]) -> None:
        self.steps, self.rooted = steps, rooted
        self.statements: list[Statement] = []
        self.end: tuple[Term, Term] = Constant(0.0), Constant(0.0)
        self._message = ""
        self._made: set[str] = set()
        self._stops: set[Term] = set()
        self._numbers = count()

    def stop(self, margin: Term, kind: str, limit: float, message: str) -> None:
        """Stop where a check fails; one that cannot is left out."""
        self._message = message
        if kind == LESS and limit < 0 and self._is_length(margin):
            return
        own = self._ready(margin)
        if length_of(own) > LONGEST_MARGIN:
            own = self._word(own)
        condition = Apply(kind, (own, Constant(limit)))
        if not isinstance(margin, Constant) and condition not in self._stops:
            self._stops.add(condition)
            self.statements.append(Stop(condition, message))

    def _is_length(self, term: Term) -> bool:
        """Whether a value is never below 0."""
        made = self.steps.get(term.name, term) if isinstance(term, Variable) else term
        return isinstance(made, Apply) and made.function in ("square_root", "absolute")

    def leg(self, name: str, values: Sequence[Term], is_incremental: bool) -> None:
        """A leg behind what it needs."""
        own = [self._word(each) for each in values]
        self.end = (own[2], own[3]) if is_incremental else (own[0], own[1])
        rest = own[4 if is_incremental else 2 :]
        arc = ((rest[0], rest[1]), rest[2], rest[3]) if rest else (None, None, None)
        self.statements.append(Leg(name, (own[0], own[1]), *arc))

    def _word(self, value: Term) -> Term:
        """A value that stands behind an address: a number, or a variable."""
        value = self._ready(value)
        if isinstance(value, Apply):
            return self._assign(value)
        return value

    def _assign(self, value: Term) -> Variable:
        variable = Variable(f"{COMMON}part{next(self._numbers)}")
        self.statements.append(Assign(variable, value))
        return variable

    def _ready(self, term: Term) -> Term:
        """A term whose variables have their values, short enough for a block."""
        match term:
            case Variable(name) if isinstance(self.steps.get(name), Variable | Constant):
                # It is another one.
                return self._ready(self.steps[name])
            case Variable(name):
                if name in self.steps and name not in self._made:
                    self._made.add(name)
                    self._make(term, self.steps[name])
                return term
            case Apply(function, arguments):
                return self._short(Apply(function, tuple(map(self._ready, arguments))))
        return term

    def _short(self, term: Term) -> Term:
        """A term without its longest parts, which get variables, until it is short."""
        while isinstance(term, Apply) and (length_of(term) > LONGEST_TERM or depth_of(term) > DEEPEST_TERM):
            by = depth_of if depth_of(term) > DEEPEST_TERM else length_of
            longest = max(term.arguments, key=by)
            if not isinstance(longest, Apply):
                break
            part = self._assign(longest)
            term = Apply(term.function, tuple(part if each is longest else each for each in term.arguments))
        return term

    def _make(self, variable: Variable, term: Term) -> None:
        """The statements that give a step its value."""
        kind = term.function if isinstance(term, Apply) else ""
        # Some controls write a direction by several functions.
        ready = self._word if kind == TURNED else self._ready
        arguments = tuple(map(ready, term.arguments)) if isinstance(term, Apply) else ()
        if kind in (AT_MOST, LESS):
            self._flag(variable, Apply(kind, arguments), 1.0, is_first=True)
        elif kind == SIGN:
            own = self._word(arguments[0])
            self._flag(variable, Apply("greater", (own, Constant(ZERO))), 1.0, is_first=True)
            self._flag(variable, Apply(LESS, (own, Constant(-ZERO))), -1.0)
        else:
            own = Apply(kind, arguments) if kind == TURNED else self._ready(term)
            self.statements.append(Assign(variable, own))
            if kind == TURNED:
                # Some controls count from 0 to 360.
                less_turn = Apply("subtract", (variable, Constant(360.0)))
                over = Apply("greater", (variable, Constant(180.0)))
                self.statements.append(When(over, (Assign(variable, less_turn),)))
        if variable.name in self.rooted:
            self.statements.append(Stop(Apply(LESS, (variable, Constant(-ZERO))), self._message))
            self._flag(variable, Apply(LESS, (variable, Constant(0.0))), 0.0)

    def _flag(self, variable: Variable, condition: Term, value: float, *, is_first: bool = False) -> None:
        if is_first:
            self.statements.append(Assign(variable, Constant(0.0)))
        self.statements.append(When(condition, (Assign(variable, Constant(value)),)))


def length_of(term: Term) -> int:
    """About how many characters a term has."""
    if isinstance(term, Apply):
        return sum(map(length_of, term.arguments)) + (6 if len(term.arguments) == 1 else 5)
    return 5 if isinstance(term, Variable) else 12


def depth_of(term: Term) -> int:
    """Depth of nested brackets in a term."""
    return 1 + max(map(depth_of, term.arguments)) if isinstance(term, Apply) else 0


def message_of(check: Check, profile: Profile) -> str:
    """The alarm text of a failing check."""
    sizes = [corner.size for corner in profile.figure.corners if check.subject in (corner.name, corner.at)]
    givens = (*sizes, check.fact, *check.givens)
    words = (profile.givens[name].word for name in givens if name in profile.givens)
    return check.kind.event.stop.format(next((word.address.lstrip(",") for word in words if word), "IT"))
