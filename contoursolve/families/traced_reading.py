"""Reading of free words by a control, traced: how each value follows them, and what they were compared with.

A block is read with numbers that remember the words that they come from. What decides how it is read, a sign or a
comparison, is a border between rows that are read alike; rows on the same sides of all borders differ in nothing but
values, each of which is so much of each word and something besides. Where reading calculates further, such as on which
side a tangent arc bends, only the row itself tells.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer
from contoursolve.families.block_template import Template, is_same
from contoursolve.gcode import FACT, Block, Word
from contoursolve.geometry import assemble
from contoursolve.numeric import Affine
from contoursolve.program import attach
from contoursolve.reading import Control, ParsedContour, advance, leave, reach_of, read
from contoursolve.solving import analyse, joints_among


class Notes:
    """Notes about the numbers of one reading."""

    def __init__(self) -> None:
        self.borders: dict[tuple[tuple[tuple[str, Decimal], ...], Decimal], Affine] = {}
        self.is_calculated = False

    def compare(self, value: Affine) -> None:
        """A value was compared with zero."""
        if value.factors:
            self.borders[tuple(value.factors.items()), value.constant] = value


class Traced(Decimal):
    """A number that follows words. What arithmetic makes of it follows them, too; what else is made of it, such as a
    float, is noted as calculated."""

    __slots__ = ("follows", "notes")
    follows: Affine
    notes: Notes

    def __new__(cls, value: Decimal, follows: Affine, notes: Notes) -> "Traced":
        """The number as it is in the row that is read."""
        found = super().__new__(cls, value)
        found.follows, found.notes = follows, notes
        return found

    def _made(self, value: Any, other: Any, own: int, others: int) -> Any:
        """A sum of so much of this number and of another one."""
        return value if value is NotImplemented else _number(value, _sum(self, own, other, others), self.notes)

    def __add__(self, other: Any) -> Any:
        return self._made(Decimal.__add__(self, other), other, 1, 1)

    def __radd__(self, other: Any) -> Any:
        return self._made(Decimal.__radd__(self, other), other, 1, 1)

    def __sub__(self, other: Any) -> Any:
        return self._made(Decimal.__sub__(self, other), other, 1, -1)

    def __rsub__(self, other: Any) -> Any:
        return self._made(Decimal.__rsub__(self, other), other, -1, 1)

    def _scaled(self, value: Any, other: Any, factor: Callable[[], Decimal]) -> Any:
        """This number times a factor; of two that follow words, no one tells."""
        if value is NotImplemented:
            return value
        if isinstance(other, Traced):
            self.notes.is_calculated = True
            return value
        scale = factor()
        factors = {name: each * scale for name, each in self.follows.factors.items() if each * scale}
        return _number(value, Affine(factors, self.follows.constant * scale), self.notes)

    def __mul__(self, other: Any) -> Any:
        return self._scaled(Decimal.__mul__(self, other), other, lambda: Decimal(other))

    def __rmul__(self, other: Any) -> Any:
        return self._scaled(Decimal.__rmul__(self, other), other, lambda: Decimal(other))

    def __truediv__(self, other: Any) -> Any:
        return self._scaled(Decimal.__truediv__(self, other), other, lambda: 1 / Decimal(other))

    def __neg__(self) -> Any:
        return self._made(Decimal.__neg__(self), 0, -1, 1)

    def __pos__(self) -> Any:
        return self

    def __abs__(self) -> Any:
        return -self if self < 0 else self

    def __bool__(self) -> bool:
        self.notes.compare(self.follows)
        return Decimal.__bool__(self)

    def _compared(self, value: Any, other: Any) -> Any:
        if isinstance(other, float):
            self.notes.is_calculated = True
        elif value is not NotImplemented:
            self.notes.compare(_sum(self, 1, other, -1))
        return value

    def __lt__(self, other: Any) -> Any:
        return self._compared(Decimal.__lt__(self, other), other)

    def __le__(self, other: Any) -> Any:
        return self._compared(Decimal.__le__(self, other), other)

    def __gt__(self, other: Any) -> Any:
        return self._compared(Decimal.__gt__(self, other), other)

    def __ge__(self, other: Any) -> Any:
        return self._compared(Decimal.__ge__(self, other), other)

    def __eq__(self, other: object) -> Any:
        return self._compared(Decimal.__eq__(self, other), other)

    def __ne__(self, other: object) -> Any:
        return self._compared(Decimal.__ne__(self, other), other)

    def __hash__(self) -> int:
        # What it is looked up among is not known.
        self.notes.is_calculated = True
        return Decimal.__hash__(self)


def _calculated(name: str) -> Callable[..., Any]:
    """A method of a number that tells of it what its words do not."""
    own = getattr(Decimal, name)

    def call(self: Traced, *others: Any, **options: Any) -> Any:
        self.notes.is_calculated = True
        return own(self, *others, **options)

    return call


for _name in (
    *("__str__", "__repr__", "__format__", "to_eng_string", "compare_total", "compare_signal", "scaleb", "logb"),
    *("ln", "log10", "exp", "next_plus", "next_minus", "number_class", "__reduce__", "__copy__", "__deepcopy__"),
    *("__float__", "__int__", "__round__", "__trunc__", "__floor__", "__ceil__", "__complex__", "__rtruediv__"),
    *("__floordiv__", "__rfloordiv__", "__mod__", "__rmod__", "__divmod__", "__rdivmod__", "__pow__", "__rpow__"),
    *("quantize", "normalize", "to_integral_value", "to_integral_exact", "sqrt", "compare", "copy_abs", "copy_sign"),
    *("is_zero", "is_signed", "as_tuple", "as_integer_ratio", "adjusted", "max", "min", "remainder_near", "fma"),
):
    setattr(Traced, _name, _calculated(_name))


def _number(value: Decimal, follows: Affine, notes: Notes) -> Decimal:
    return Traced(value, follows, notes) if follows.factors else value


def _sum(one: Traced, own: int, other: Any, others: int) -> Affine:
    """So much of a number and so much of another one."""
    second = other.follows if isinstance(other, Traced) else Affine({}, Decimal(other))
    names = dict.fromkeys((*one.follows.factors, *second.factors))
    none = Decimal(0)
    factors = {
        name: own * one.follows.factors.get(name, none) + others * second.factors.get(name, none) for name in names
    }
    return Affine(
        {name: each for name, each in factors.items() if each}, own * one.follows.constant + others * second.constant
    )


Alike = tuple[object, ...]
"""All that is the same of rows that are read alike."""


class Reading(Struct, frozen=True, eq=False):
    """Reading of the free words in one row.

    `givens` are the values of the contour that follow words, by name; `start` has the coordinates of its start point
    that do, by axis, mm. `borders` are values that decide by their sign how the block is read. `is_calculated` tells
    that this depends on more than these signs, so that only rows with the same values are read alike for certain.
    """

    givens: Mapping[str, Affine]
    start: Mapping[int, Affine]
    borders: tuple[Affine, ...]
    is_calculated: bool
    claim: ParsedContour | None = None
    """The contour as it was read, of numbers that remember their words."""
    alike: Alike = ()
    """All of it that is no number."""

    @property
    def is_by_row(self) -> bool:
        """Whether only the row itself tells how it is read: what decides is calculated, or several words together do,
        or a value follows several of them."""
        return self.is_calculated or not self.is_followed or any(len(each.factors) > 1 for each in self.borders)

    @property
    def is_followed(self) -> bool:
        """Whether each value follows one word at most."""
        return all(len(each.factors) == 1 for each in (*self.givens.values(), *self.start.values()))

    def holds(self, template: Template, values: Mapping[str, float]) -> bool:
        """Whether the row of other values, read by itself, states what follows from this one: what a number forgets,
        such as a text that is read again, does not stay hidden."""
        there = read_row(template, values, self.claim) if self.claim is not None else None
        if self.claim is None or there is None:
            return False
        numbers, others = _numbers_of(self.claim), _numbers_of(there)
        return (
            self.alike == _alike(there)
            and numbers.keys() == others.keys()
            and all(abs(_at(each, values) - others[name]) <= _SAME for name, each in numbers.items())
        )


def trace_reading(template: Template, values: Mapping[str, float], answer: Answer) -> Reading:
    """The reading of the block of a template in the row of these values, of which `answer` is the single solve. Facts
    beside the words are not among what it follows."""
    notes = Notes()
    claim = read_row(template, values, answer.claim, notes)
    if claim is None or not _is_read_so(claim, answer) or _may_have_cuts(answer.claim):
        return Reading({}, {}, (), is_calculated=True)
    givens = {name: each.value.follows for name, each in claim.givens.items() if isinstance(each.value, Traced)}
    begins = enumerate(claim.before.start().values)
    start = {axis: value.follows for axis, value in begins if isinstance(value, Traced)}
    return Reading(givens, start, tuple(notes.borders.values()), notes.is_calculated, claim, _alike(claim))


def _is_read_so(claim: ParsedContour, answer: Answer) -> bool:
    """Whether a contour that was read apart is what the program has."""
    with_values = {name: Decimal(each.value) for name, each in claim.givens.items()}
    starts = [value if value is None else Decimal(value) for value in claim.before.start().values]
    return with_values == {name: each.value for name, each in answer.claim.givens.items()} and starts == [
        *answer.start.values
    ]


def read_row(
    template: Template, values: Mapping[str, float], like: ParsedContour, notes: Notes | None = None
) -> ParsedContour | None:
    """The contour of a row, read apart from all else that is said of it, and with `notes` by numbers that remember
    their words; None where a contour like one of another row is not found."""
    control, filled = template.asked.control, template.filled(values)
    if control is None:
        return None
    program, start = attach(filled.program, filled.asked)[0], filled.asked.start
    blocks: Sequence[Block] = program.blocks
    before: Sequence[Block] = start.blocks if start is not None else ()
    if notes is not None:
        marked = _Marking(template.words, values, notes)
        blocks, before = marked.of(blocks), marked.of(before)
    return _first_contour(control, blocks, before, template, like)


class _Marking:
    """The words of a template in the blocks of one row."""

    def __init__(self, words: Mapping[str, Word], values: Mapping[str, float], notes: Notes) -> None:
        self.words = {name: word for name, word in words.items() if name in values and word.address != FACT}
        self.notes = notes

    def of(self, blocks: Iterable[Block]) -> tuple[Block, ...]:
        """The blocks with numbers that remember them."""
        lines = {word.span.line for word in self.words.values()}
        return tuple(
            replace(block, words=tuple(map(self._marked, block.words))) if block.line in lines else block
            for block in blocks
        )

    def _marked(self, word: Word) -> Word:
        name = next((name for name, typed in self.words.items() if is_same(typed, word)), None)
        if name is None or word.number is None:
            return word
        return replace(word, number=Traced(word.number, Affine({name: Decimal(1)}, Decimal(0)), self.notes))


def _first_contour(
    control: Control, blocks: Sequence[Block], before: Sequence[Block], template: Template, like: ParsedContour
) -> ParsedContour | None:
    """The contour at the place of another one. What begins there is read with all that stands before it."""
    state, first = control.initial_state(template.asked.unit), like.blocks[0].line
    for block in before:
        state = advance(state, block, control.modes)
    index, is_behind = 0, all(word.span.line >= first for word in template.words.values())
    while index < len(blocks):
        found = control.find(blocks, index, state, control.modes)
        if blocks[index].line == first:
            return found
        if found is None or not found.form.is_contour:
            state = advance(state, blocks[index], control.modes)
            index += 1
        elif is_behind:
            index += reach_of(found, blocks, index)
            state = leave(found, template.end_of(found.blocks[0].line), control.modes)
        else:
            return None
    return None


OWN = "@"
"""Prefix of the names of values that each row states by itself."""


class RowReading(Struct, frozen=True, eq=False):
    """Reading of one row: what it shares with others, and the values of its own, beside those of its words."""

    kind: Alike
    values: Mapping[str, float]


def place_of_contour(template: Template, values: Mapping[str, float]) -> ParsedContour | None:
    """The contour of the row of these values, if the contour of a row at its place can be read apart from the rest of
    the program. Raises FamilyError as `Template.solve`."""
    answer = template.solve(values)
    claim = read_row(template, values, answer.claim)
    is_so = claim is not None and _is_read_so(claim, answer) and not _may_have_cuts(answer.claim)
    return answer.claim if is_so else None


def _may_have_cuts(claim: ParsedContour) -> bool:
    """Whether the values of a chain tell if something of it is open, or only cuts a straight line in two."""
    profile = read(claim, frozenset())
    return claim.form.is_general and bool(joints_among(profile.figure, analyse(assemble(profile)).free))


def read_alone(
    template: Template, values: Mapping[str, float], like: ParsedContour | None, *, is_kept: bool = False
) -> RowReading:
    """The reading of the row of these values by itself: at the place of a contour, or else with all of the program. One
    that `is_kept` is not read again the next time. Raises FamilyError as `Template.solve`."""
    key = (*values.values(), like.blocks[0].line if like is not None else None)
    found = template.readings.pop(key, None) or _read_alone(template, values, like)
    if is_kept:
        template.readings[key] = found
    return found


def _read_alone(template: Template, values: Mapping[str, float], like: ParsedContour | None) -> RowReading:
    claim = read_row(template, values, like) if like is not None else None
    kind, numbers = tuple[object, ...](), dict[str, Decimal]()
    if claim is None:
        answer = template.solve(values)
        claim, kind = answer.claim, (assemble(answer.profile).key, answer.status)
        # What the solver puts in its place is stated by no word.
        numbers = {name: answer.profile.givens[name].value for name in placed_of(answer)}
    numbers |= _numbers_of(claim)
    own = {OWN + name: float(each) for name, each in numbers.items()}
    return RowReading((*_alike(claim), *kind), {**values, **own})


def placed_of(answer: Answer) -> list[str]:
    """The values of a contour that neither words nor facts state, by name."""
    profile = answer.profile
    return [name for name, given in profile.givens.items() if given.word is None and name not in answer.claim.givens]


def _alike(claim: ParsedContour) -> Alike:
    """All of a contour that is no number."""
    profile = read(claim, frozenset())
    known = tuple(value is not None for value in profile.start.values)
    return profile.layout, profile.plane, profile.choices, profile.picks, claim.circumstances, known


def _numbers_of(claim: ParsedContour) -> dict[str, Decimal]:
    """All that a contour states in numbers, by name: the coordinates of its start point as `start 0` and `start 1`."""
    starts = enumerate(claim.before.start().values)
    found = {f"start {axis}": value for axis, value in starts if value is not None}
    return found | {name: given.value for name, given in claim.givens.items()}


def _at(value: Decimal, values: Mapping[str, float]) -> Decimal:
    """The value of a number in the row of these values."""
    if not isinstance(value, Traced):
        return value
    parts = (factor * Decimal(repr(values[name])) for name, factor in value.follows.factors.items())
    return value.follows.constant + sum(parts, Decimal(0))


_SAME = Decimal("1e-9")
"""mm or degrees. By how much the rounding of decimals may part two numbers."""
