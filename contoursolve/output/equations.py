"""The system of equations of a contour as text: what each word says first, the formula behind it."""

from typing import Any

from msgspec import Struct

from contoursolve.diagnosis import (
    Answer,
    Equation,
    EquationSystem,
    SystemCondition,
    called_in_program,
    count,
    join,
    word_keys,
)
from contoursolve.diagnostics import checked
from contoursolve.gcode import FACT, Word
from contoursolve.numeric import symbolic
from contoursolve.output.plain_text import NAMELESS, Folded, RecordView, Table, printable

NOBODY = "the form"
"""The origin of an equation that no word states."""


class Formula(Struct, frozen=True, eq=False):
    """An expression in a cell of a table: a text, and maths on a page."""

    expression: Any

    @property
    def text(self) -> str:
        """The expression as a person types it."""
        return symbolic.text(self.expression)

    def __html__(self) -> str:
        """The expression as MathML."""
        from contoursolve.output.equations_html import maths  # noqa: PLC0415 - text needs no extra

        return str(maths(self.expression))


def system_view(system: EquationSystem) -> RecordView:
    """A system: its unknowns, its values, then what `equation_view` has."""
    named = Folded("Unknowns and values", [unknown_table(system), value_table(system)])
    return RecordView("", [named, *equation_view(system).parts])


def equation_view(system: EquationSystem) -> RecordView:
    """The equations, what they leave open, on which condition they determine the rest, what says the same, and the
    corners."""
    parts: list[str | Table | Folded] = [equation_table(system)]
    if system.free:
        parts += ["", open_line(system), *([motion_table(system)] if system.null_space else [])]
    parts += [condition_table(system), *large_lines(system), tie_table(system)]
    parts += [Folded(f"Equations of {each.caption}", [each]) for each in corner_tables(system)]
    return RecordView("", parts)


@checked
def equations_of(answer: Answer, word: Word) -> tuple[list[str], list[tuple[str, str, str]]]:
    """The equations that a word states, and the conditions in which it plays a part: in words, as an expression, and
    the value of that.

    Args:
        answer: one of `Result.answers`.
        word: a word of its blocks.

    >>> import contoursolve
    >>> answer = contoursolve.solve("G111 X100. A180. K-30. B120.", start="X40. Z0.").answer
    >>> equations_of(answer, answer.claim.words["B"])[0]
    ['(Z_V2 - Z_V1)*sin(B) = (X_V2 - X_V1)*cos(B)']
    """
    stated, conditions = answer.system.of_word(word)
    equations = [symbolic.text(each.equation) for each in stated]
    return equations, [(printable(each.meaning), symbolic.text(each.expression), _here(each)) for each in conditions]


def size_text(system: EquationSystem) -> str:
    """The number of equations and of unknowns, and the rank."""
    many = count(len(system.statements), "equation")
    found = f"{many} for {count(len(system.unknowns), 'unknown')}"
    is_even = system.rank == len(system.statements) == len(system.unknowns)
    return found if is_even else f"{found}; {system.rank} of them say something new"


def open_line(system: EquationSystem) -> str:
    """The unknowns that nothing determines, and the number of equations that are missing."""
    meanings = [each.meaning for each in system.unknowns if each.symbol in system.free]
    missing = len(system.unknowns) - system.rank
    return f"still open: {join(meanings)}; {count(missing, 'equation')} {'is' if missing == 1 else 'are'} missing"


def large_lines(system: EquationSystem) -> list[str]:
    """A line for each step of which no condition is worked out."""
    return [
        f"no condition is worked out for {join([each.meaning for each in step])}: they are solved together"
        for step in system.too_large
    ]


def unknown_table(system: EquationSystem) -> Table:
    """The unknowns, what each is, and its value where there is a contour."""
    rows = [
        (str(each.symbol), each.meaning, "" if each.value is None else f"{each.value:z.4f}", each.unit)
        for each in system.unknowns
    ]
    return Table("Unknowns", ("unknown", "meaning", "value", "unit"), rows, left=(0, 1, 3), is_headed=False)


def value_table(system: EquationSystem) -> Table:
    """The values that words state, as the equations have them."""
    rows = [
        (
            str(each.symbol),
            printable(each.text),
            each.meaning,
            "not known" if each.number is None else f"{float(each.number):z.4f}",
            each.unit,
        )
        for each in system.words
    ]
    return Table("Values", ("symbol", "word", "meaning", "value", "unit"), rows, left=(0, 1, 2, 4), is_headed=False)


def equation_table(system: EquationSystem) -> Table:
    """The equations, each with its word and what that says."""
    rows = [(*_stated_pair(each), Formula(each.equation)) for each in system.statements]
    keys = word_keys(system.claim.words.values())
    names = [
        NAMELESS if word is None or word.address == FACT or word.span not in keys else ("word", keys[word.span])
        for word in (each.source for each in system.statements)
    ]
    header = ("word", "what it says", "equation")
    return Table(size_text(system), header, rows, left=(0, 1, 2), names=names, is_headed=False)


def _stated_pair(each: Equation) -> tuple[str, str]:
    """The word of an equation, and its meaning without that."""
    word = printable(each.word)
    return word or NOBODY, printable(each.meaning.removesuffix(f" ({each.word})"))


def condition_table(system: EquationSystem) -> Table:
    """The conditions, in words and as expressions that must not be zero, with their values."""
    rows = [(printable(each.meaning), Formula(each.expression), _here(each)) for each in system.conditions]
    header = ("what must hold", "must not be 0", "here")
    return Table("These conditions must hold", header, rows, left=(0, 1, 2), is_headed=False)


def _here(each: SystemCondition) -> str:
    return "must not be 0" if each.value is None else f"is {each.value:.4g}, must not be 0"


def motion_table(system: EquationSystem) -> Table:
    """The motions that are left, each by the points, and radii, that move with it."""
    space, axes = system.null_space, system.profile.plane.axes
    motions = space.motions if space is not None else ()
    rows = list[tuple[str, ...]]()
    for number, motion in enumerate(motions, 1):
        rows += [(str(number), name, f"{a:z.4f}", f"{b:z.4f}", "") for name, (a, b) in motion.points.items()]
        rows += [(str(number), name, "", "", f"{way:z.4f}") for name, way in motion.radii.items()]
    header = ("way", "moves", *axes, "radius")
    # Few drawings have a radius that can change.
    shown = len(header) if any(motion.radii for motion in motions) else len(header) - 1
    caption = "What can still move at these values, mm a mm"
    return Table(caption, header[:shown], [row[:shown] for row in rows], left=(0, 1))


def tie_table(system: EquationSystem) -> Table:
    """The sets of words that say the same, with the formula that ties them, and whether it fails here."""
    rows = [
        (
            printable(" ".join(each.words)),
            "" if each.identity is None else Formula(each.identity),
            "but their values disagree" if each.is_conflict else "",
        )
        for each in system.ties
    ]
    header = ("words", "formula", "here")
    return Table("These words say the same", header, rows, left=(0, 1, 2), is_headed=False).without_empty()


def corner_tables(system: EquationSystem) -> list[Table]:
    """The equations of each corner."""
    called, header = called_in_program(system.profile), ("what it says", "equation")
    told = [(each.name, [(row.meaning, Formula(row.equation)) for row in each.equations]) for each in system.corners]
    return [Table(called(name), header, rows, left=(0, 1), is_headed=False) for name, rows in told]
