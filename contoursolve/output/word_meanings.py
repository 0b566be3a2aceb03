"""A contour in words: its form, its end, and its words one by one: what each means, states and fixes."""

from decimal import Decimal

from msgspec import Struct

from contoursolve.diagnosis import Answer, AskedValue, coordinates, meaning_of, short_name, word_keys
from contoursolve.diagnostics import checked
from contoursolve.gcode import FACT, Word
from contoursolve.geometry import Length, Line, Profile, Unit


@checked
def form_text(answer: Answer) -> str:
    """Name and title of the contour's form, in the control's words."""
    return f"{answer.claim.form.name} ({answer.claim.form.title})"


@checked
def end_text(answer: Answer) -> str:
    """The end point of a contour, as the control writes it: `Z-50.2073 X100.0000`; empty without a path."""
    return coordinates(answer.contour.end, answer.plane, answer.unit) if answer.contour else ""


@checked
def start_text(answer: Answer) -> str:
    """The words that lead to the start point of a contour, as its control reads coordinates; empty if it is unknown.

    >>> import contoursolve
    >>> start_text(contoursolve.solve("G111 X100. A180. K-30. B120.", start="X40. Z0.").answers[0])
    'Z0 X40.'
    """
    from contoursolve.diagnosis import write_word  # noqa: PLC0415 - with what edits programs; few outputs have it

    values, lexicon = answer.start.values, answer.claim.lexicon
    if not answer.start.is_known:
        return ""
    places = zip(answer.plane.axes, values, strict=True)
    return " ".join(write_word(axis, float(value or 0), lexicon, answer.unit) for axis, value in places)


class StatedWord(Struct, frozen=True):
    """A word of a contour.

    Attributes:
        key: its name: `A`, or `2:,A` where two blocks have one.
        word: the word in the program.
        meaning: what it states.
        value: its value as it is written; None for a variable or `?`.
        unit: what it is written in: mm, in or deg.
        fixes: the points and corners that it fixes, by name.
        is_ignored: whether the control drops it by a rule.
    """

    key: str
    word: Word
    meaning: str
    value: float | None
    unit: str
    fixes: tuple[str, ...] = ()
    is_ignored: bool = False


@checked
def stated_words(answer: Answer) -> tuple[StatedWord, ...]:
    """The words that state something about a contour, in the order of the program.

    >>> import contoursolve
    >>> answer = contoursolve.solve("G111 X100. A180. K-30. B120. P5.", start="X40. Z0.").answers[0]
    >>> [(each.key, each.value, each.unit, each.fixes) for each in stated_words(answer)][2:]
    [('K', -30.0, 'mm', ('V1',)), ('B', 120.0, 'deg', ('line 2',)), ('P', 5.0, 'mm', ('corner 1',))]
    """
    givens = {given.name: given.word for given in answer.profile.givens.values() if given.word}
    ignored = {fact.given for fact in answer.profile.ignored}
    keys, found, seen, fixed = word_keys(answer.claim.words.values()), [], set[int](), _fixed(answer.profile)
    for name, word in sorted(givens.items(), key=lambda item: item[1].span):
        if id(word) not in seen:
            seen.add(id(word))
            value, unit = stated_value(word, answer) if word.address != FACT else (None, "")
            meaning, key = meaning_of(name, word, answer.claim), keys.get(word.span, FACT)
            fixes = tuple(dict.fromkeys(fixed.get(name, ())))
            found.append(StatedWord(key, word, meaning, value, unit, fixes, name in ignored))
    return tuple(found)


def _fixed(profile: Profile) -> dict[str, list[str]]:
    """Names of the points, directions, radii and corners that each given fixes."""
    headings = {element.heading: element.name for element in profile.figure.path if isinstance(element, Line)}
    fixed: dict[str, list[str]] = {}
    for fact in profile.facts:
        parts = (getattr(fact, part, "") for part in ("point", "head", "center", "radius", "line"))
        found = headings.get(fact.given) or next(filter(None, parts), "")
        fixed.setdefault(fact.given, []).extend([str(found)] if found else ())
    for corner in profile.figure.corners:
        fixed.setdefault(corner.size, []).append(corner.name)
    return fixed


def stated_value(word: Word, answer: Answer) -> tuple[float | None, str]:
    """The value of a word as it is written, and its unit: mm, in, deg, or empty where only the sign counts."""
    lexicon = answer.claim.lexicon
    row = lexicon.addresses[word.address]
    value = word.number if row.clockwise_from is not None else lexicon.value(word, answer.unit)
    return _as_written(value, row.unit, answer.unit, is_diameter=row.is_diameter)


def found_value(asked: AskedValue, answer: Answer) -> tuple[float | None, str]:
    """The value of a word that was asked for, in the same terms."""
    question = asked.question
    return _as_written(asked.value, question.unit, answer.unit, is_diameter=question.is_diameter)


def _as_written(
    value: float | Decimal | None, kind: Unit, unit: Length, *, is_diameter: bool
) -> tuple[float | None, str]:
    if kind is not Unit.MM:
        return None if value is None else float(value), "deg" if kind is Unit.DEGREE else ""
    shown = None if value is None else float(value) * (2 if is_diameter else 1) / float(unit.in_mm)
    return shown, short_name(unit.value)
