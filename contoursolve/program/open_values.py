"""For which values of a variable that is not known a contour exists."""

from collections.abc import Iterator
from decimal import Decimal
from itertools import groupby

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer, Depth, Policy, examine, inward, join
from contoursolve.execution import MacroLanguage, Unknown, evaluate, variables_of, written
from contoursolve.gcode import Block, parse_block
from contoursolve.numeric import Variable
from contoursolve.reading import Dialect, ParsedContour, ReadIssue

_STEPS, _GROWTH, _SMALLEST = 48, 1.25, 0.05
"""Values that are tried: from the smallest one on, each so much larger than the one before; and as many below 0."""

_ANGLES = 15
"""Degrees between angles that are tried."""

_EXACT = 1e-4
"""Accuracy of the ends of a range, in the unit of the variable."""

_MOST = 3
"""Ranges that are told."""


class _Trial(Struct, frozen=True):
    """Outcome at one value: `message` is the error of a block without a contour."""

    value: float
    is_solved: bool
    message: str


def tell_values(answer: Answer, dialect: Dialect, policy: Policy) -> Answer:
    """The answer to a contour that depends on one variable of unknown value, with the ranges in which values that were
    tried make a contour, and what is wrong beside them."""
    language = dialect.modes.language
    about = next((each for each in answer.diagnostics if each.about is ReadIssue.VARIABLE), None)
    if language is None or about is None or not answer.start.is_known:
        return answer
    names = {name for block in answer.claim.blocks for name in _names(language, block.text)}
    name = next(iter(names)) if len(names) == 1 else ""
    if not name:
        return answer
    search = _Search(answer, dialect, policy, name)
    told = search.told()
    finding = replace(about, notes=(*about.notes, *told))
    return replace(answer, diagnostics=tuple(finding if each is about else each for each in answer.diagnostics))


def _names(language: MacroLanguage, text: str) -> Iterator[str]:
    """The variables in the words of a line; an empty name for one whose number is computed."""
    for word in language.read(text).words:
        for variable in variables_of(word.value):
            yield variable.name if isinstance(variable, Variable) else ""


class _Search:
    """Values of one variable of a contour."""

    def __init__(self, answer: Answer, dialect: Dialect, policy: Policy, name: str) -> None:
        self.answer, self.dialect, self.policy, self.name = answer, dialect, policy, name

    def told(self) -> list[str]:
        """Sentences on the values with a contour, and on the errors at the others."""
        # Most values are only tried; what is wrong is asked of few.
        trials = [self._try(value, Depth.TRIAL) for value in self._values()]
        runs = [list(group) for _, group in groupby(trials, lambda each: each.is_solved)]
        ranges, reasons = list[str](), list[str]()
        for number, run in enumerate(runs):
            if not run[0].is_solved:
                continue
            before, after = (
                runs[at][end] if 0 <= at < len(runs) else None for at, end in ((number - 1, -1), (number + 1, 0))
            )
            low, high = self._end(run[0], before), self._end(run[-1], after)
            begin, end = self._inward(low[0], run[0], -1), self._inward(high[0], run[-1], 1)
            if before:
                ranges.append(f"from {begin} to {end}" if after else f"from {begin} on")
            else:
                ranges.append(f"up to {end}" if after else "with every value that was tried")
            for (_, why), value, way in ((low, begin, "below"), (high, end, "above")):
                reasons += [f"{way} {value}: {why}"] if why else []
        if not ranges:
            first = self._try(trials[0].value)
            return [f"no value of {self.name} that was tried makes a contour; with {first.value:g}: {first.message}"]
        more = f"; and {len(ranges) - _MOST} more ranges" if len(ranges) > _MOST else ""
        found = f"{self.name} makes a contour {join(ranges[:_MOST])}{more}"
        return [found, *(f"{self.name} {each}" for each in reasons[: 2 * _MOST])]

    def _inward(self, limit: float, tried: _Trial, way: int) -> str:
        """An upper (`way` 1) or a lower limit as it is told, rounded towards a value that was tried: typed in like
        that, it has the contour. With all decimals where rounding leaves nothing of the range."""
        exact = Decimal(repr(limit))
        shown = inward(exact, self.answer.unit.value, way) + 0
        nearest = exact.quantize(shown)
        # The limit itself is one of the values where it is reached, whatever the last digits of the floats say.
        if nearest != shown and self._try(float(nearest), Depth.TRIAL).is_solved:
            shown = nearest
        goes_beyond = way * (shown - Decimal(repr(tried.value))) < 0
        if goes_beyond and not self._try(float(shown), Depth.TRIAL).is_solved:
            return f"{exact.normalize():f}"
        return f"{abs(shown) if shown == 0 else shown:f}"

    def _values(self) -> list[float]:
        """The values that are tried."""
        words = [float(word.number) for word in self.answer.claim.words.values() if word.number is not None]
        starts = [float(value or 0) for value in self.answer.start.values]
        near = [size * factor for size in (*words, *starts) for factor in (-2, -1, -0.5, 0.5, 1, 2)]
        sizes = [_SMALLEST * _GROWTH**step for step in range(_STEPS)]
        angles = range(-360, 361, _ANGLES)
        return sorted({0.0, *near, *sizes, *(-each for each in sizes), *map(float, angles)})

    def _try(self, value: float, depth: Depth = Depth.VERDICT) -> _Trial:
        claim, dialect = self.answer.claim, self.dialect
        found = dialect.find(
            [self._block(number, value) for number in range(len(claim.blocks))], 0, claim.before, dialect.modes
        )
        if not isinstance(found, ParsedContour) or len(found.blocks) != len(claim.blocks):
            return _Trial(value, False, "the blocks are read as another contour")
        answer = examine(found, dialect.rules, self.policy, lambda: None, depth)
        error = next((each for each in answer.diagnostics if each.is_error), None)
        return _Trial(value, answer.contour is not None and error is None, error.message if error else "")

    def _block(self, number: int, value: float) -> Block:
        """A block of the contour with a value of the variable in its words."""
        block = self.answer.claim.blocks[number]
        language, text = self.dialect.modes.language, block.text
        for word in reversed(language.read(text).words if language else ()):
            result = evaluate(word.value, lambda name: value if name == self.name else Unknown(name))
            if isinstance(result, float):
                text = word.put(written(result), text)
        return parse_block(text, block.line, block.syntax)

    def _end(self, inside: _Trial, outside: _Trial | None) -> tuple[float, str]:
        """The last value with a contour on the way to one without, and what is wrong there."""
        if outside is None:
            return inside.value, ""
        outside = self._try(outside.value)
        while abs(outside.value - inside.value) > _EXACT:
            middle = self._try((inside.value + outside.value) / 2)
            inside, outside = (middle, outside) if middle.is_solved else (inside, middle)
        return inside.value, outside.message
