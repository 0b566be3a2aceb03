"""The words of a contour one by one: what each means, states and fixes."""

from decimal import Decimal

from contoursolve.diagnosis import Answer, AskedValue, StatedWord, meaning_of, short_name, word_keys
from contoursolve.diagnostics import checked
from contoursolve.gcode import FACT, Word
from contoursolve.geometry import Length, Line, Profile, Unit


@checked
def stated_words(answer: Answer) -> tuple[StatedWord, ...]:
    """The words that state something about a contour, in the order of the program."""
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
