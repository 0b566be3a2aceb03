"""Dependence of a contour's values on variables, found by reading its blocks at other values of each."""

from collections.abc import Iterator, Mapping
from decimal import Decimal
from itertools import pairwise

from msgspec import Struct

from contoursolve.diagnosis import Answer, Depth, Policy, examine
from contoursolve.families import FamilyError, errors_of, limits_beside, verdict_of
from contoursolve.gcode import Block
from contoursolve.geometry import Choice
from contoursolve.numeric import Affine
from contoursolve.postprocess.formulas.formula_lines import Free, MacroLine
from contoursolve.reading import Control, Position, State

STEP = Decimal(1) / 1024
"""By how much a value is changed to see what follows it; a power of 2, so that quotients are exact."""

Values = Mapping[str, Decimal]


class FormulaError(Exception):
    """A contour that has no formulas; the message says why."""


def at(value: Affine, values: Values) -> Decimal:
    """An affine value at these values of what it follows."""
    return value.constant + sum((factor * values[name] for name, factor in value.factors.items()), Decimal(0))


def less(one: Affine, other: Affine) -> Affine:
    """The difference of two affine values."""
    names = {**one.factors, **other.factors}
    factors = {name: one.factors.get(name, Decimal(0)) - other.factors.get(name, Decimal(0)) for name in names}
    return Affine({name: each for name, each in factors.items() if each}, one.constant - other.constant)


class Reader(Struct, frozen=True, eq=False):
    """The blocks of a contour, the state before them, and the values that follow variables: of words, and of the
    coordinates of the start point, mm."""

    control: Control
    policy: Policy
    blocks: tuple[Block, ...]
    macros: Mapping[int, MacroLine]
    before: State
    axes: Mapping[str, Affine]
    free: Mapping[str, Free]

    @property
    def example(self) -> dict[str, Decimal]:
        """The example of every value."""
        return {name: each.value for name, each in self.free.items()}

    def moved(self, values: Values) -> State:
        """The state before the blocks at some values."""
        held = self.before.axes
        return self.before.move(
            {axis: Position(at(each, values), held[axis].reason, held[axis].span) for axis, each in self.axes.items()}
        )

    def answer(self, values: Values) -> Answer:
        """The answer of a single solve at some values."""
        known = {**self.example, **values}
        blocks = [
            self.macros[block.line].typed(block, known)[0] if block.line in self.macros else block
            for block in self.blocks
        ]
        claim = self.control.find(blocks, 0, self.moved(known), self.control.modes)
        if claim is None:
            raise FormulaError("with other values of its variables it is no contour")
        return examine(claim, self.control, self.policy, depth=Depth.PATH)

    def follow(self, values: Values) -> dict[str, Affine]:
        """The stated values of the blocks as affine functions near some values, by name. Limits of the control's
        reading have `limit:` before their names."""
        known = {**self.example, **values}
        base = self.answer(known)
        here = _stated(base)
        factors: dict[str, dict[str, Decimal]] = {name: {} for name in here}
        for name in self.free:
            moved = next((each for each in self._beside(known, name) if is_same_case(base, each[1])), None)
            if moved is None:
                # The case is that of this number alone.
                continue
            step, there = moved[0], _stated(moved[1])
            for stated, value in here.items():
                if there[stated] != value:
                    factors[stated][name] = (there[stated] - value) / step
        return {
            stated: Affine(each, here[stated] - sum((each[name] * known[name] for name in each), Decimal(0)))
            for stated, each in factors.items()
        }

    def _beside(self, known: Values, name: str) -> Iterator[tuple[Decimal, Answer]]:
        for step in (STEP, -STEP):
            yield step, self.answer({**known, name: known[name] + step})

    def put(self, value: Affine, number: Decimal, values: Values, name: str = "") -> dict[str, Decimal]:
        """Values with one of them changed, so that an affine value is this number."""
        known, name = {**self.example, **values}, name or next(iter(value.factors))
        return {**known, name: known[name] + (number - at(value, known)) / value.factors[name]}

    def is_turned(self, choice: Choice, value: Affine) -> bool:
        """Whether a choice is another one where the value that makes it has the other sign."""
        other = self.answer(self.put(value, -at(value, self.example), {}))
        sides = {each.point: each.side for each in other.profile.choices}
        return sides.get(choice.point, choice.side).sign == -choice.side.sign


def _stated(answer: Answer) -> dict[str, Decimal]:
    """The values that the blocks of a contour state, and their limits, by name."""
    limits = {f"limit:{name}": value for name, value in answer.claim.limits.items()}
    return {name: given.value for name, given in answer.profile.givens.items()} | limits


def is_same_case(one: Answer, other: Answer) -> bool:
    """Whether two contours differ in nothing but values."""
    first, second = one.profile, other.profile
    return (
        first.layout is second.layout
        and [(each.point, each.given) for each in first.choices]
        == [(each.point, each.given) for each in second.choices]
        and all(one.side is two.side or one.given for one, two in zip(first.choices, second.choices, strict=True))
        and first.givens.keys() == second.givens.keys()
        and first.ignored == second.ignored
        and one.claim.limits.keys() == other.claim.limits.keys()
    )


def refusal(answer: Answer) -> str:
    """The code of the rule that refuses a contour whatever its other values are; empty if none does."""
    try:
        is_refused = verdict_of(answer) is not None
    except FamilyError as error:
        raise FormulaError(str(error)) from None
    return errors_of(answer)[0].code if is_refused else ""


class CaseBoundary(Struct, frozen=True):
    """A value on whose sides the words may be read in different ways: where it is one of these numbers."""

    value: Affine
    numbers: tuple[Decimal, ...]

    def sides(self) -> Iterator[tuple[Decimal | None, Decimal | None, Decimal]]:
        """The numbers, and what lies between them: from where to where, and one value there."""
        ends = (None, *self.numbers, None)
        for low, high in pairwise(ends):
            if low is not None:
                yield low, low, low
            inner = (low + high) / 2 if low is not None and high is not None else None
            yield low, high, inner or (high - 1 if low is None and high is not None else (low or Decimal(0)) + 1)


def borders_of(reader: Reader, answer: Answer, stated: Mapping[str, Affine]) -> list[CaseBoundary]:
    """The borders between cases; the cases of one do not depend on the others."""
    claim, found = answer.claim, list[CaseBoundary]()
    for block in claim.blocks:
        macro = reader.macros.get(block.line)
        for index, slot in (macro.typed(block, {})[1] if macro else {}).items():
            word = block.words[index]
            if word.address in claim.lexicon.addresses:
                one = claim.lexicon.factor(word, answer.unit, has_point=True)
                numbers = sorted({Decimal(0), *limits_beside(reader.control.rules, claim, word)})
                found.append(CaseBoundary(Affine({slot.free.name: one}, Decimal(0)), tuple(numbers)))
    for name in claim.limits:
        value = less(stated[name], stated[f"limit:{name}"])
        own = next((each for each in found if each.value.factors.keys() == value.factors.keys()), None)
        if value.factors and own is None:
            found.append(CaseBoundary(value, (Decimal(0),)))
            # Seen from either of two values, it is the same border.
            break
        if own is not None:
            (factor,) = value.factors.values()
            number = -value.constant / factor * next(iter(own.value.factors.values()))
            found[found.index(own)] = CaseBoundary(own.value, tuple(sorted({*own.numbers, number})))
    return found
