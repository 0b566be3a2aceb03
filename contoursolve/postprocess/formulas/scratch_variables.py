"""Gives the values of a contour variables of the control: few, for each is used again when nobody needs its value."""

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import UserError
from contoursolve.execution import Assign, When, place_in, variables_of
from contoursolve.numeric import COMMON, Term, Variable
from contoursolve.postprocess.formulas.contour_statements import Choose, Leg, Said, Statement, Stop
from contoursolve.postprocess.formulas.word_dependence import FormulaError

_RANGE = re.compile(r"\s*([^\d\s-]+)(\d+)\s*-\s*(?:[^\d\s-]+)?(\d+)\s*")


class NoFormulasError(UserError, ValueError):
    """Formulas were asked for that there are not; the message says what there is."""


class Scratch(Struct, frozen=True):
    """The variables that may be used, as they are named on the control."""

    text: str
    names: tuple[str, ...]


def read_scratch(text: str) -> Scratch:
    """A range such as `#140-#160`, `R50-R99`, `Q40-Q60`. Raises NoFormulasError."""
    found = _RANGE.fullmatch(text.upper())
    if found is None or int(found[2]) > int(found[3]):
        raise NoFormulasError(f"{text!r} is no range of variables, such as #140-#160")
    return Scratch(text, tuple(f"{found[1]}{number}" for number in range(int(found[2]), int(found[3]) + 1)))


def allocate(
    blocks: Sequence[Sequence[Statement]], scratch: Scratch, taken: Collection[str], kept: Sequence[Term]
) -> tuple[list[list[Statement]], list[Term]]:
    """The statements of blocks with variables of the control in place of names with a colon or a blank, and what is
    kept behind them; `taken` are those that are used otherwise. Raises FormulaError where there are too few."""
    uses = list(_uses(statement for block in blocks for statement in block))
    lasts = {name: number for number, (_, read) in enumerate(uses) for name in read}
    lasts |= dict.fromkeys((name for term in kept for name in names_of(term)), len(uses))
    free = [name for name in scratch.names if name not in taken]
    room, most = len(free), 0
    known, held = dict[str, Term](), dict[str, str]()
    for number, (written, _) in enumerate(uses):
        if not is_local(written) or written in known:
            continue
        # What is read here for the last time is read before this is written.
        for name in [name for name in held if lasts.get(name, -1) <= number]:
            free.insert(0, held.pop(name))
        held[written] = free.pop(0) if free else ""
        known[written] = Variable(held[written])
        free = [name for name in free if name]
        most = max(most, len(held))
    if most > room:
        raise FormulaError(f"it needs {most} variables; {scratch.text} has {room} that the program does not use")
    return [[_named(each, known) for each in block] for block in blocks], [place_in(each, known) for each in kept]


def is_local(name: str) -> bool:
    """Whether a name is none of the control."""
    return ":" in name or " " in name


def names_of(term: Term) -> set[str]:
    """The names of the variables in a term."""
    return {each.name for each in variables_of(term) if isinstance(each, Variable)}


def _uses(statements: Iterable[Statement]) -> Iterator[tuple[str, set[str]]]:
    """The name that each statement writes, and the names that it reads, one after the other."""
    for each in statements:
        match each:
            case Assign(Variable(name), value):
                yield name, names_of(value)
            case When():
                then = list(_uses(each.then))  # type: ignore[arg-type]
                # Its variable keeps its value where the condition does not hold.
                yield "", names_of(each.condition).union(*({name, *read} for name, read in then))
            case Stop():
                yield "", names_of(each.condition)
            case Choose():
                yield "", names_of(each.condition)
                yield from _uses(each.then)
                yield from _uses(each.otherwise)
            case Leg():
                yield "", set().union(*map(names_of, terms_of(each)))


def terms_of(leg: Leg) -> list[Term]:
    """Everything that a leg reads."""
    more = (leg.turn, leg.chord)
    return [*leg.end, *(leg.center or ()), *(each for each in more if each is not None)]


def renamed(term: Term, prefix: str) -> Term:
    """A term whose numbered variables begin with another prefix: `#100` and `R100`."""
    numbered = {name: Variable(prefix + name[1:]) for name in names_of(term) if name[1:].isdigit()}
    return place_in(term, numbered)


def _named(statement: Any, known: Mapping[str, Term]) -> Any:
    """A statement with other variables."""
    match statement:
        case Assign():
            return Assign(place_in(statement.variable, known), place_in(statement.value, known))  # type: ignore[arg-type]
        case When() | Choose():
            parts = {
                name: tuple(_named(each, known) for each in getattr(statement, name))
                for name in ("then", "otherwise")
                if hasattr(statement, name)
            }
            return replace(statement, condition=place_in(statement.condition, known), **parts)
        case Stop():
            return replace(statement, condition=place_in(statement.condition, known))
        case Said():
            return statement
        case Leg():
            end, center = (
                (place_in(a, known), place_in(b, known)) for a, b in (statement.end, statement.center or statement.end)
            )
            turn, chord = (
                each if each is None else place_in(each, known) for each in (statement.turn, statement.chord)
            )
            return Leg(statement.name, end, center if statement.center else None, turn, chord)
    raise TypeError(statement)


def apart(statements: Sequence[Statement], tag: str, shared: Collection[str]) -> Iterator[Statement]:
    """Statements with a tag before the names of their values, but for those that are shared."""
    names = {name for written, read in _uses(statements) for name in (written, *read) if COMMON in name}
    tagged = {name: Variable(tag + name) for name in names if name not in shared}
    return (place(each, tagged) for each in statements)


def place(statement: Statement, terms: Mapping[str, Term]) -> Statement:
    """A statement with terms in place of variables."""
    found: Statement = _named(statement, terms)
    return found
