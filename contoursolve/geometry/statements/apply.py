"""Further facts of a block, put into its profile, and as words that findings can show."""

from collections.abc import Callable, Sequence
from typing import cast

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Span
from contoursolve.gcode import FACT, Directive, Word
from contoursolve.geometry.profile import Profile, Question, Unit
from contoursolve.geometry.statements.draft import Draft, StatementError
from contoursolve.geometry.statements.grammar import GrammarError, PointName, Vocabulary, read_statement
from contoursolve.geometry.statements.statement import (
    ANGLES,
    DirectionIs,
    Meeting,
    MeetsLine,
    ParallelTo,
    PassesBeside,
    PassesThrough,
    Place,
    PointIs,
    Statement,
    StraightIs,
    Touches,
    TurnIs,
)


def word_of(directive: Directive, begin: int = 0, end: int | None = None) -> Word:
    """A directive, or a part of it, as a word that a finding can mark."""
    text = directive.text[begin:end] or directive.text[-1:]
    column = directive.span.column + begin
    return Word(FACT, None, False, text, Span(directive.span.line, column, column + max(len(text), 1)))


_FIRST = (MeetsLine, Touches, DirectionIs, TurnIs, PassesThrough, PassesBeside, ParallelTo, StraightIs)
"""Statements that say what a line is come before those that measure it."""


class UnusedFact(Struct, frozen=True):
    """A fact that was not used: what is wrong, in words, and where."""

    message: str
    word: Word
    is_readable: bool = True


def apply_statements(
    profile: Profile, directives: Sequence[Directive], next_place: Callable[[], Place | None]
) -> tuple[Profile, tuple[UnusedFact, ...]]:
    """The profile with further facts and with what is asked for, and the facts that make no sense.

    `next_place` tells where the next block's line ends, mm; None if it is not known.
    """
    if not profile.is_extended:
        return profile, ()
    draft = Draft(profile.figure, profile.facts, profile.givens)
    words = vocabulary_of(profile)
    faults: list[UnusedFact] = []
    read: list[tuple[str, Statement, Word]] = []
    for number, directive in enumerate(directives, 1):
        try:
            statement = directive.statement or read_statement(directive.text, words)
            read.append((f"fact {number}", cast("Statement", statement), word_of(directive)))
        except GrammarError as error:
            # A comment ends with the first ), wherever that stands.
            is_cut = "(" in directive.text and directive.span.line > 0
            hint = "; inside a comment write [ ] for ( )" if is_cut else ""
            faults.append(UnusedFact(f"{error}{hint}", word_of(directive, error.begin, error.end), is_readable=False))
    questions = list(profile.questions)
    for name, statement, word in sorted(read, key=lambda each: rank(each[1])):
        draft.word = word
        try:
            stated = _resolved(statement, next_place)
            fact = stated.state(draft, name)
        except StatementError as error:
            faults.append(UnusedFact(str(error), word))
            continue
        axis = stated.axis if isinstance(stated, PointIs) else None
        is_diameter = axis is not None and profile.plane.diameters[axis]
        if name in draft.givens:
            draft.givens[name] = replace(draft.givens[name], is_diameter=is_diameter)
        elif fact.given == name:
            unit = Unit.DEGREE if isinstance(stated, ANGLES) else Unit.MM
            questions.append(Question(name, fact, unit, word, is_diameter))
    draft.word = None
    for question in profile.questions:
        _add_size(draft, question, faults)
    extended = replace(profile, layout=draft.layout(), givens=draft.givens, questions=tuple(questions))
    return extended, tuple(faults)


def vocabulary_of(profile: Profile) -> Vocabulary:
    """The names that facts about a profile may mention."""
    figure = profile.figure
    elements = [element.name for element in (*figure.path, *figure.corners)]
    at = {corner.at: corner.name for corner in figure.corners}
    cut = {
        f"{element.name}.{part}": (f"{at[point]}.{its}", point)
        for element in figure.path
        for part, point, its in (("begin", element.tail, "end"), ("end", element.head, "begin"))
        if point in at
    }
    end = PointName("", figure.path[-1].head) if figure.path else None
    if end is not None and end.of in at:
        end = PointName("end", at[end.of])
    return Vocabulary(elements, (figure.start, *figure.points), profile.plane, profile.unit, end, cut)


def _resolved(statement: Statement, next_place: Callable[[], Place | None]) -> Statement:
    """The next block's line as a line to where it ends."""
    if isinstance(statement, MeetsLine) and statement.line == Meeting(None, None):
        return MeetsLine(statement.corner, Meeting(next_place(), None))
    return statement


def _add_size(draft: Draft, question: Question, faults: list[UnusedFact]) -> None:
    """A corner whose size is asked for is part of the equations."""
    for corner in draft.figure.corners if question.fact.sizes else ():
        try:
            if corner.size == question.name:
                draft.corner(corner.name)
        except StatementError as error:
            faults.append(UnusedFact(str(error), question.word))


def rank(statement: Statement) -> int:
    """In which order statements are put into a draft."""
    return _FIRST.index(type(statement)) if type(statement) in _FIRST else len(_FIRST)
