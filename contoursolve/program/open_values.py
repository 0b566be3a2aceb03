"""For which values of a variable that is not known a contour exists."""

from collections.abc import Iterator
from itertools import groupby
from math import copysign

from msgspec.structs import replace

from contoursolve.diagnosis import DECIMALS, Answer, Depth, Policy, examine, join
from contoursolve.execution import MacroLanguage, Unknown, evaluate, variables_of, written
from contoursolve.gcode import Block, parse_block
from contoursolve.numeric import Variable, halve
from contoursolve.reading import Control, ParsedContour, ReadIssue
from contoursolve.solving import typed_limit

_STEPS, _GROWTH, _SMALLEST = 48, 1.25, 0.05
"""Values that are tried: from the smallest one on, each so much larger than the one before; and as many below 0."""

_ANGLES = 15
"""Degrees between angles that are tried."""

_MOST = 3
"""Ranges that are told."""


def tell_values(answer: Answer, control: Control, policy: Policy) -> Answer:
    """The answer to a contour that depends on one variable of unknown value, with the ranges in which values that were
    tried make a contour, and what is wrong beside them."""
    language = control.modes.language
    about = next((each for each in answer.diagnostics if each.about is ReadIssue.VARIABLE), None)
    if language is None or about is None or not answer.start.is_known:
        return answer
    names = {name for block in answer.claim.blocks for name in _names(language, block.text)}
    name = next(iter(names)) if len(names) == 1 else ""
    if not name:
        return answer
    finding = replace(about, notes=(*about.notes, *_Search(answer, control, policy, name).told()))
    return replace(answer, diagnostics=tuple(finding if each is about else each for each in answer.diagnostics))


def _names(language: MacroLanguage, text: str) -> Iterator[str]:
    """The variables in the words of a line; an empty name for one whose number is computed."""
    for word in language.read(text).words:
        for variable in variables_of(word.value):
            yield variable.name if isinstance(variable, Variable) else ""


class _Search:
    """Values of one variable of a contour."""

    def __init__(self, answer: Answer, control: Control, policy: Policy, name: str) -> None:
        self.answer, self.control, self.policy, self.name = answer, control, policy, name
        self.decimals = DECIMALS[answer.unit.value]

    def told(self) -> list[str]:
        """Sentences on the values with a contour, and on the errors at the others."""
        # Most values are only tried; what is wrong is asked of few.
        values = self._values()
        runs = [(is_solved, list(run)) for is_solved, run in groupby(values, self._has_contour)]
        ranges, reasons = list[str](), list[str]()
        for number, (is_solved, run) in enumerate(runs):
            if not is_solved:
                continue
            before = self._end(run[0], runs[number - 1][1][-1]) if number else None
            after = self._end(run[-1], runs[number + 1][1][0]) if number + 1 < len(runs) else None
            if before:
                ranges.append(f"from {before[0]} to {after[0]}" if after else f"from {before[0]} on")
            else:
                ranges.append(f"up to {after[0]}" if after else "with every value that was tried")
            reasons += [f"{way} {end[0]}: {end[1]}" for way, end in (("below", before), ("above", after)) if end]
        if not ranges:
            told = f"no value of {self.name} that was tried makes a contour"
            return [f"{told}; with {values[0]:g}: {self._failure(values[0])}"]
        more = f"; and {len(ranges) - _MOST} more ranges" if len(ranges) > _MOST else ""
        found = f"{self.name} makes a contour {join(ranges[:_MOST])}{more}"
        return [found, *(f"{self.name} {each}" for each in reasons[: 2 * _MOST])]

    def _end(self, inside: float, outside: float) -> tuple[str, str]:
        """The last value with a contour on the way to one without, as it is typed, and what is wrong behind it."""
        step = 10**-self.decimals
        _, beyond = halve(inside, outside, self._has_contour, step)
        limit = typed_limit(inside, beyond, self.decimals, self._has_contour)
        behind = round(float(limit) + copysign(step, outside - inside), self.decimals)
        return f"{limit:f}", self._failure(behind) or self._failure(beyond) or ""

    def _has_contour(self, value: float) -> bool:
        return self._failure(value, Depth.TRIAL) is None

    def _values(self) -> list[float]:
        """The values that are tried."""
        words = [float(word.number) for word in self.answer.claim.words.values() if word.number is not None]
        starts = [float(value or 0) for value in self.answer.start.values]
        near = [size * factor for size in (*words, *starts) for factor in (-2, -1, -0.5, 0.5, 1, 2)]
        sizes = [_SMALLEST * _GROWTH**step for step in range(_STEPS)]
        angles = range(-360, 361, _ANGLES)
        return sorted({0.0, *near, *sizes, *(-each for each in sizes), *map(float, angles)})

    def _failure(self, value: float, depth: Depth = Depth.VERDICT) -> str | None:
        """The error of the contour with a value; None without one."""
        claim, control = self.answer.claim, self.control
        found = control.find(
            [self._block(number, value) for number in range(len(claim.blocks))], 0, claim.before, control.modes
        )
        if not isinstance(found, ParsedContour) or len(found.blocks) != len(claim.blocks):
            return "the blocks are read as another contour"
        answer = examine(found, control, self.policy, lambda: None, depth)
        error = next((each for each in answer.diagnostics if each.is_error), None)
        return error.message if error else None if answer.contour is not None else ""

    def _block(self, number: int, value: float) -> Block:
        """A block of the contour with a value of the variable in its words."""
        block = self.answer.claim.blocks[number]
        language, text = self.control.modes.language, block.text
        for word in reversed(language.read(text).words if language else ()):
            result = evaluate(word.value, lambda name: value if name == self.name else Unknown(name))
            if isinstance(result, float):
                text = word.put(written(result), text)
        return parse_block(text, block.line, block.syntax)
