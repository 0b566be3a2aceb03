"""Variables of a block as free words: numbers in their place, and the word for which each of them stands."""

from collections.abc import Mapping, Sequence

from contoursolve import gcode
from contoursolve.execution import MacroLanguage, Unknown, Vacant, WordFormula, evaluate, variables_of, written
from contoursolve.families.errors import FamilyError
from contoursolve.gcode import Program
from contoursolve.numeric import Variable
from contoursolve.program import choose
from contoursolve.reading import Control

Places = Mapping[str, tuple[int, int]]
"""By the name of a variable, the line and the column of the value that it is."""

_ANY = 1.0
"""Stands for a variable whose value a family gives."""


def numbered(
    program: Program, language: MacroLanguage | None, values: Mapping[str, float], free: Sequence[str]
) -> tuple[Program, Places]:
    """A block with numbers for its variables, and where those are that are free.

    Raises FamilyError for a variable whose value is not known, and for a free one that is not the value of one word.
    """
    places: dict[str, tuple[int, int]] = {}
    lines = [block.text for block in program.blocks]
    if language is None or not any(map(language.may_say, lines)):
        return program, places
    texts = list[str]()
    for block in program.blocks:
        text, shift = block.text, 0
        for word in language.read(block.text).words:
            typed, number = block.text[word.begin : word.end], _number(word, block.text, values, free, language)
            name = word.value.name if isinstance(word.value, Variable) else ""
            if name in free and name in places:
                raise FamilyError(f"{name} stands in several words; a family varies a variable that is in one")
            if name in free:
                places[name] = block.line, word.begin + shift + 1
            text = text[: word.begin + shift] + number + text[word.end + shift :]
            shift += len(number) - len(typed)
        texts.append(text)
    first = program.blocks[0].line if program.blocks else 1
    return gcode.parse("\n".join(texts), program.name, first, program.syntax), places


def _number(
    word: WordFormula, text: str, values: Mapping[str, float], free: Sequence[str], language: MacroLanguage
) -> str:
    """The text that stands for a word's value."""
    typed = text[word.begin : word.end]
    inside = [each.name for each in variables_of(word.value) if isinstance(each, Variable) and each.name in free]
    if inside and not isinstance(word.value, Variable):
        told = f"{inside[0]} is a part of {typed}"
        raise FamilyError(f"{told}; a family varies a variable that is the whole value of a word: vary that word")
    if inside:
        return written(values.get(inside[0], _ANY))
    found = evaluate(word.value, lambda name: language.value_of(name, values))
    if isinstance(found, float):
        return written(found)
    reason = found.reason if isinstance(found, Unknown) else f"{typed} is no number"
    if isinstance(found, Vacant):
        raise FamilyError(f"{typed} is empty: the control leaves this word out; delete it, or write a number")
    names = ", ".join(dict.fromkeys(each.name for each in variables_of(word.value) if isinstance(each, Variable)))
    raise FamilyError(f'{reason}; state it with --variable "{names or typed}=NUMBER", or vary it')


def with_numbers(
    block: str, control: str | Control | None, settings: Mapping[str, str] | None, values: Mapping[str, float]
) -> str:
    """A block with numbers for all of its variables. Raises FamilyError for one without a value, and as `choose`."""
    program = gcode.parse(block, "<block>")
    chosen = choose(control, program, settings)
    if chosen is None:
        return block
    known = {name.strip().upper(): float(value) for name, value in values.items()}
    spelled = gcode.spelled(program, chosen.modes.syntax)
    return numbered(spelled, chosen.modes.language, known, ())[0].text
