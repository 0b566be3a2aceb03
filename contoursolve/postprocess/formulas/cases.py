"""The cases of a contour: values at which a control reads its words in another way, or refuses them."""

from collections.abc import Callable, Iterator, Mapping
from decimal import Decimal
from typing import NamedTuple

from msgspec import Struct

from contoursolve.diagnosis import Answer
from contoursolve.numeric import AT_MOST, LESS, ZERO, Affine, Apply, Constant, Term, Variable
from contoursolve.postprocess.formulas.contour_statements import BlockUnits, Body, Stop, body_of, free_sizes
from contoursolve.postprocess.formulas.trial_run import difference
from contoursolve.postprocess.formulas.word_dependence import (
    CaseBoundary,
    FormulaError,
    Reader,
    Values,
    at,
    borders_of,
    is_same_case,
    refusal,
)

OTHER = "ANOTHER KIND OF CONTOUR"
"""Alarm text of a machine for a case that cannot be written."""

_LETTERS = 26
"""Of what a machine says."""


class Fork(Struct, frozen=True):
    """Two cases of a contour, and where the first one is in force."""

    condition: Term
    then: "Case"
    otherwise: "Case"


Case = Body | Fork


class _Side(NamedTuple):
    """Values of a border at which another case holds: those between two numbers, or one number."""

    value: Affine
    low: Decimal | None
    high: Decimal | None

    def holds(self, values: Values) -> bool:
        """Whether the value is there, at some values."""
        own = at(self.value, values)
        if self.low == self.high:
            return own == self.low
        return (self.low is None or self.low < own) and (self.high is None or own < self.high)

    @property
    def condition(self) -> Term:
        """That the value is there."""
        if self.low is None or self.high is None:
            value = term_of(self.value)
            if self.low is None:
                return Apply(LESS, (value, Constant(float(self.high or 0) - ZERO)))
            return Apply("greater", (value, Constant(float(self.low) + ZERO)))
        middle, half = (self.low + self.high) / 2, (self.high - self.low) / 2
        off = term_of(Affine(self.value.factors, self.value.constant - middle))
        if not half:
            return Apply(AT_MOST, (Apply("absolute", (off,)), Constant(ZERO)))
        return Apply(LESS, (Apply("absolute", (off,)), Constant(float(half) - ZERO)))


def term_of(value: Affine) -> Term:
    """An affine value as a term."""
    found: Term | None = None
    for name, factor in value.factors.items():
        own: Term = Variable(name)
        if abs(factor) != 1:
            own = Apply("multiply", (Constant(abs(float(factor))), own))
        if found is None:
            found = own if factor > 0 else Apply("negate", (own,))
        else:
            found = Apply("add" if factor > 0 else "subtract", (found, own))
    if found is None or not value.constant:
        return found or Constant(float(value.constant))
    return Apply("add" if value.constant > 0 else "subtract", (found, Constant(abs(float(value.constant)))))


def case_of(
    reader: Reader,
    values: Values,
    writing: Callable[[Answer], Mapping[str, BlockUnits]],
    decided: tuple[_Side, ...] = (),
) -> Case:
    """The statements of a contour in the case of some values, and in all others where what is `decided` holds. Raises
    FormulaError."""
    answer, known = reader.answer(values), {**reader.example, **values}
    stated, own = reader.follow(known), refusal(answer)
    main = _refusing(own) if own else body_of(reader, answer.profile, stated, writing(answer))
    borders = borders_of(reader, answer, stated)
    sizes = [stated[size] for size in free_sizes(answer.profile, stated)]
    sharp = [
        _Side(Affine({name: abs(factor)}, Decimal(0)), Decimal(0), Decimal(0))
        for size in sizes
        for name, factor in size.factors.items()
    ]
    tied = {name for border in borders if len(border.value.factors) > 1 for name in border.value.factors}
    stops: list[tuple[_Side, str]] = []
    forks: list[tuple[_Side, Case]] = []
    for border in borders:
        is_tied = not tied.isdisjoint(border.value.factors)
        is_decided = any(border.value.factors == side.value.factors for side in decided)
        for side, inner in _others(border, known) if not is_decided else ():
            there = _reach(reader, side, inner, known, decided)
            if there is None:
                continue
            try:
                other = reader.answer(there)
                code = refusal(other)
                if code and code == own:
                    continue
                is_same = is_same_case(answer, other) and reader.follow(there) == stated
                # Where two values meet borders at once may be another case still.
                is_same = is_same and not own and not (is_tied and side.low == side.high)
                # Without a corner, what is asked of the corner is left out.
                is_met = side in sharp and other.contour is not None
                is_met = is_met and not difference(main.statements, _floats(there), other, writing(answer))
                if is_tied if code else not (is_same or is_met):
                    # Whether it is refused may depend on the other values.
                    code = ""
                    forks.append((side, case_of(reader, there, writing, (*decided, side))))
            except FormulaError:
                code = OTHER
            if code:
                stops.append((side, _message(code)))
    found: Case = _with_stops(main, [Stop(side.condition, message) for side, message in _merged(stops)])
    own_body = found
    for side, case in forks:
        if not _is_part_of(case, own_body):
            found = Fork(side.condition, case, found)
    return found


def _is_part_of(case: Case, other: Case) -> bool:
    """Whether a case is another one, but for what is refused elsewhere."""
    if not isinstance(case, Body) or not isinstance(other, Body):
        return False
    return (case.formulas, case.end) == (other.formulas, other.end) and {*case.stops} <= {*other.stops}


def _message(code: str) -> str:
    """Alarm text of a machine where a rule refuses."""
    return code if code == OTHER else code.partition("-")[2].replace("-", " ").upper()[:_LETTERS]


def _refusing(code: str) -> Body:
    """A case that a rule refuses whatever its values are."""
    nothing = Constant(0.0)
    return Body((Stop(Apply(LESS, (nothing, Constant(1.0))), _message(code)),), (nothing, nothing))


def _floats(values: Values) -> dict[str, float]:
    return {name: float(each) for name, each in values.items()}


def _reach(
    reader: Reader, side: _Side, number: Decimal, known: Values, decided: tuple[_Side, ...]
) -> dict[str, Decimal] | None:
    """Values at which a border value is this number and what is decided holds; None if none are found."""
    tried = [reader.put(side.value, number, known, name) for name in side.value.factors]
    for there in list(tried):
        for other in decided:
            own = at(other.value, known)
            names = [name for name in other.value.factors if name not in side.value.factors]
            tried += [reader.put(other.value, own, there, name) for name in names if not other.holds(there)]
    return next((there for there in tried if all(each.holds(there) for each in (side, *decided))), None)


def _others(border: CaseBoundary, known: Values) -> Iterator[tuple[_Side, Decimal]]:
    """The sides of a border on which a value is not."""
    own = at(border.value, known)
    for low, high, inner in border.sides():
        side = _Side(border.value, low, high)
        if side.holds(known):
            continue
        for end in (low, high):
            # As far behind the border, if that is there: what is solved here is likely to be solved there.
            mirrored = 2 * end - own if end is not None else own
            if low != high and (low is None or low < mirrored) and (high is None or mirrored < high):
                inner = mirrored  # noqa: PLW2901
        yield side, inner


def _merged(stops: list[tuple[_Side, str]]) -> Iterator[tuple[_Side, str]]:
    """Stops that lie side by side as one."""
    held: tuple[_Side, str] | None = None
    for side, message in stops:
        if held is not None and held[1] == message and held[0].value == side.value and held[0].high == side.low:
            held = _Side(side.value, held[0].low, side.high), message
            continue
        if held is not None:
            yield held
        held = side, message
    if held is not None:
        yield held


def _with_stops(case: Case, stops: list[Stop]) -> Case:
    """A case that stops in some other ones, before it does anything else."""
    if isinstance(case, Body):
        return Body(case.formulas, case.end, (*dict.fromkeys([*stops, *case.stops]),))
    return Fork(case.condition, _with_stops(case.then, stops), _with_stops(case.otherwise, stops))
