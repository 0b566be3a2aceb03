"""Exercises: a block with numbers that are drawn, a coordinate that is asked for, and answers to choose from."""

from collections.abc import Iterator, Mapping
from decimal import Decimal
from itertools import islice, zip_longest
from random import Random
from string import ascii_uppercase
from typing import Any

from msgspec import Struct

from contoursolve.api import solve
from contoursolve.diagnosis import Answer, Derivation, change, edited, either, misreadings, typed_text, with_value
from contoursolve.diagnostics import Shown, check_type
from contoursolve.gcode import FACT, Word
from contoursolve.geometry import GrammarError, ResultName, Unit, read_result, vocabulary_of
from contoursolve.reading import Control

_MOST_WRONG = len(ascii_uppercase) - 1
"""Wrong answers that have a letter beside the right one."""

_TRIES = 30
"""Draws of numbers until the block is a contour."""

_APART = 0.01
"""mm by which two answers differ at least."""

_RIGHT_ANGLE, _FEW_DEGREES, _SMALL = 90, 5, 10
"""Degrees along an axis, and steps of other angles; mm below which a length has steps of 0.5, else of 1."""


class OfferedAnswer(Struct, frozen=True):
    """One answer of an exercise: its value as the control writes it, mm, whether it is right, and why it is not."""

    value: float
    is_right: bool
    why: str


class Exercise(Shown, Struct, frozen=True):
    """A question about a block with the answers to choose from. What it shows hides which is right; `right` is its
    letter, and `solution` the calculation by hand.

    Attributes:
        block: the block with the numbers that were drawn.
        start: the words of its start point.
        question: what is asked.
        choices: the answers to choose from, one of them right.
        answer: what `solve` says of the block.
    """

    block: str
    start: str
    question: str
    choices: tuple[OfferedAnswer, ...]
    answer: Answer

    @property
    def letters(self) -> tuple[tuple[str, OfferedAnswer], ...]:
        """The choices, each with its letter."""
        return tuple(zip(ascii_uppercase, self.choices, strict=False))

    @property
    def right(self) -> str:
        """The letter of the right answer."""
        return next(letter for letter, choice in self.letters if choice.is_right)

    @property
    def solution(self) -> Derivation:
        """The calculation by hand."""
        return self.answer.system.derivation


def exercise(
    block: str,
    ask: str = "V2 Z",
    *,
    seed: int = 1,
    most: int = 3,
    start: str,
    control: str | Control | None = None,
) -> Exercise:
    """An exercise of a block: its numbers are drawn around those that it has, and a coordinate is asked for.

    `ask` is a point of the contour and an axis, as in a family, or `end Z`. The wrong answers, `most` at most, are what
    comes out if a word is misread: an angle from the other axis, a sign, a diameter for a radius. The same seed gives
    the same exercise. Raises ValueError for a point or an axis that is not there, and for more answers than letters.
    It does so, too, where no numbers near those of the block make a contour with a wrong answer.

    >>> made = exercise("G111 X100. A180. K-30. B120. P5.", "V2 Z", seed=4, start="X40. Z0.")
    >>> made.block, made.question
    ('G111 X85. A180. K-27. B105. P6.', 'Z of V2, in mm?')
    """
    check_type("ask", ask, str, "a point and an axis, such as 'V2 Z'")
    if most not in range(1, _MOST_WRONG + 1):
        raise ValueError(f"most cannot be {most!r}; an exercise has 1 to {_MOST_WRONG} wrong answers")
    draw, asked = Random(seed), dict[str, Any](start=start, control=control, depth="verdict")
    (first, *others) = solve(block, **asked).answers or (None,)
    if first is None or others:
        raise ValueError("an exercise takes one contour")
    if first.contour is None:
        raise ValueError("an exercise takes a block that has a contour as it stands")
    place = _place(first, ask)
    for _ in range(_TRIES):
        text = _drawn(first, draw)
        result = solve(text, **asked)
        if len(result.answers) != 1 or result.diagnostics:
            continue
        (answer,) = result.answers
        value = _value(answer, place)
        wrong = [] if value is None else [*islice(_wrong(answer, place, value, asked), most)]
        if value is not None and wrong:
            choices = [OfferedAnswer(value, is_right=True, why=""), *wrong]
            draw.shuffle(choices)
            return Exercise(text, start, _question(answer, place), tuple(choices), answer)
    raise ValueError("no numbers around those of the block make a contour with a wrong answer")


def _words(answer: Answer) -> list[Word]:
    """The words with a number that state a length or an angle."""
    stated = [given for given in answer.profile.givens.values() if given.unit is not Unit.SIGN]
    return [each.word for each in stated if each.word and each.word.number is not None and each.word.address != FACT]


def _drawn(answer: Answer, draw: Random) -> str:
    """The block with other numbers: round ones, zeros and angles along an axis as they are."""
    units = {id(given.word): given.unit for given in answer.profile.givens.values()}
    spelling = answer.system.control.modes.syntax.words
    edits = []
    for word in _words(answer):
        number = Decimal(str(word.number))
        if units[id(word)] is Unit.DEGREE:
            moved = number + (_FEW_DEGREES * draw.randint(-4, 4) if number % _RIGHT_ANGLE else 0)
        else:
            step = Decimal("0.5") if abs(number) < _SMALL else Decimal(1)
            moved = round(number * draw.randint(70, 130) / 100 / step) * step
        edits.append(change(word, with_value(word, typed_text(moved.normalize()), spelling)))
    return edited(answer.claim.blocks, edits)


def _place(answer: Answer, ask: str) -> tuple[str, int]:
    """The point that is asked for, and the number of its axis. Raises ValueError."""
    axes, points = answer.plane.axes, (*_points(answer), "end")
    try:
        named = read_result(ask, vocabulary_of(answer.profile))
    except GrammarError:
        named = ResultName()
    if named.point is None or named.axis is None or named.point.text not in points:
        told = either([f"{name} {letter}" for name in points for letter in axes])
        raise ValueError(f"an exercise asks for {told}; not for {ask}")
    return named.point.text, named.axis


def _points(answer: Answer) -> tuple[str, ...]:
    return tuple(answer.contour.points) if answer.contour else ()


def _value(answer: Answer, place: tuple[str, int]) -> float | None:
    """A coordinate of a contour as the control writes it, mm; None without the contour or the point."""
    point, axis = place
    contour = answer.contour
    at = None if contour is None else contour.end if point == "end" else contour.points.get(point)
    return None if at is None else at[axis] * (2 if answer.plane.diameters[axis] else 1)


def _wrong(answer: Answer, place: tuple[str, int], value: float, asked: Mapping[str, Any]) -> Iterator[OfferedAnswer]:
    """The values that come out if one word is misread, each once, the likeliest first."""
    seen = [value]
    for word, text, sentence in _misread(answer):
        (other, *_) = solve(edited(answer.claim.blocks, [change(word, text)]), **asked).answers or (None,)
        found = None if other is None else _value(other, place)
        if found is not None and all(abs(found - each) > _APART for each in seen):
            seen.append(found)
            yield OfferedAnswer(found, is_right=False, why=f"{text} in place of {word.text.strip()}: {sentence}")


def _misread(answer: Answer) -> Iterator[tuple[Word, str, str]]:
    """The misreadings of all words, those of each word in turn."""
    rows = [[(word, *each) for each in misreadings(word, answer.claim)] for word in _words(answer)]
    yield from (each for together in zip_longest(*rows) for each in together if each is not None)


def _question(answer: Answer, place: tuple[str, int]) -> str:
    point, axis = place
    letter, is_diameter = answer.plane.axes[axis], answer.plane.diameters[axis]
    return f"{letter} of {point}, in mm{' as a diameter' if is_diameter else ''}?"


def exercise_lines(made: Exercise) -> Iterator[str]:
    """The question with its answers; which one is right is not told."""
    yield f"  The tool stands at {made.start}"
    yield from (f"  {line}" for line in made.block.splitlines())
    yield ""
    yield f"  {made.question}"
    yield from (f"    {letter} {choice.value:10.3f}" for letter, choice in made.letters)
