"""Values of a program's variables while it runs."""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.diagnostics import UserError
from contoursolve.execution.evaluate import FUNCTIONS, evaluate, is_true, name_of_indexed
from contoursolve.execution.macro_language import (
    ANGLE_INCREMENT,
    ARGUMENT,
    LENGTH_INCREMENT,
    MACHINES,
    SKIP_SWITCH,
    UNSET,
    VACANT,
    Assign,
    For,
    Forget,
    Known,
    MacroLanguage,
    Unknown,
    Vacant,
    VariableScope,
    VariableType,
)
from contoursolve.numeric import Indexed, Term, Variable

MOST_LOGGED = 10_000
"""Assignments that are kept in mind while it is not known whether a jump took place."""


class VariableNameError(UserError, ValueError):
    """A value is stated of what is no variable of a control; the message says what its variables are called."""


def check_names(
    names: Iterable[str], languages: Sequence[MacroLanguage], lines: Callable[[], Iterable[str]] | None = None
) -> None:
    """Raise VariableNameError for the first name that is no variable in any of some languages, and that the lines of a
    program do not declare; without lines, any name is that may be declared."""
    for name in names:
        if any(not each.variables or re.fullmatch(each.variables, name, re.ASCII) for each in languages):
            continue
        may_be = [each for each in languages if each.declared and re.fullmatch(each.declared, name, re.ASCII)]
        if may_be and (lines is None or any(_declares(each, text, name) for text in lines() for each in may_be)):
            continue
        if any(name == each.always_empty for each in languages):
            raise VariableNameError(f"{name} is always empty; no value can be stated")
        told = ", ".join(dict.fromkeys(each.examples for each in languages))
        number = re.fullmatch(r"[A-Z#]+(\d+)", name)
        meant = f": write {languages[0].examples[0]}{number[1]}" if number and len(languages) == 1 else ""
        raise VariableNameError(f"there is no variable {name}; variables are called {told}{meant}{_setting(name)}")


def _declares(language: MacroLanguage, text: str, name: str) -> bool:
    """Whether a line declares a variable."""
    if not language.may_say(text):
        return False
    code = language.read(text)
    set_here = (each.variable for each in code.statements if isinstance(each, Assign | Forget))
    is_formal = any(each.name == name for each in code.parameters)
    return is_formal or any(isinstance(each, Variable) and each.name == name for each in set_here)


def _setting(name: str) -> str:
    return "; a setting is stated with --setting" if re.fullmatch(r"[\w-]+\.[\w-]+", name) else ""


class NamedVariable(Struct, frozen=True):
    """A variable that a program names: the first line that does, and the first that sets it, if any does, with the
    number there; none where that depends on more than numbers."""

    name: str
    line: int
    set_on: int | None
    number: float | None = None


def named_variables(language: MacroLanguage, lines: Iterable[str]) -> list[NamedVariable]:
    """The variables of the user that lines name, in their order, those that only the machine knows left out."""
    found: dict[str, NamedVariable] = {}
    for number, text in enumerate(lines, 1):
        if not language.may_say(text):
            continue
        code = language.read(text)
        set_here = (each.variable for each in code.statements if isinstance(each, _SETTING))
        formal = [each.name for each in code.parameters]
        targets = {*formal, *_names_in(tuple(set_here))}
        numbers = {each.variable: _number_of(each) for each in code.statements if isinstance(each, Assign)}
        for name in (*formal, *_names_in((code.statements, code.words))):
            set_on = number if name in targets else None
            is_set = set_on is not None
            value = numbers.get(Variable(name)) if is_set else None
            before = found.setdefault(name, NamedVariable(name, number, set_on, value))
            if before.set_on is None and is_set:
                found[name] = NamedVariable(name, before.line, set_on, value)
    left_out = SKIP_SWITCH.name, LENGTH_INCREMENT.name, ANGLE_INCREMENT.name, language.always_empty
    own = (each for each in found.values() if each.name not in left_out)
    return [each for each in own if not language.unknown(each.name).endswith(MACHINES)]


def _number_of(assigned: Assign) -> float | None:
    """The number that an assignment says by itself."""
    value = evaluate(assigned.value, Unknown)
    return value if isinstance(value, float) else None


_SETTING = (Assign, Forget, For)


def _names_in(record: object) -> Iterator[str]:
    """The names of all variables in a record, and in what it holds."""
    if isinstance(record, Variable):
        yield record.name
    elif isinstance(record, tuple):
        for each in record:
            yield from _names_in(each)
    elif isinstance(record, Struct):
        for field in record.__struct_fields__:
            yield from _names_in(getattr(record, field))


class VariableLevel(Struct):
    """The own variables of a program that was called: values, types of what it defines, and by the names of what it has
    by reference, which variable of which level that is. The first level is the main program's, and has what is known
    everywhere."""

    program: str = ""
    values: dict[str, Known] = field(default_factory=dict)
    types: dict[str, VariableType] = field(default_factory=dict)
    links: Mapping[str, tuple[int, str]] = field(default_factory=dict)

    def copy(self) -> "VariableLevel":
        """Another one that changes by itself."""
        return VariableLevel(self.program, dict(self.values), dict(self.types), self.links)


class Variables:
    """The variables of a program, by the levels of its calls; `given` are values that are stated apart from it and hold
    whatever it sets, but for what a subprogram has for itself."""

    def __init__(self, language: MacroLanguage, given: Mapping[str, float]) -> None:
        self.given, self.levels = dict(given), [VariableLevel(values=dict[str, Known](given))]
        self.assigned: list[str] = []
        """What was set, in order."""
        self.undefined: list[str] = []
        """What is read or set where it is not defined, told and not yet taken."""
        self.defines = False
        """Whether what is set is defined in the level that runs."""
        self.line = 0
        """The line that runs."""
        self.is_called = False
        """Whether others call the program, so that what nothing sets is an argument."""
        self._lines: dict[tuple[str, Known], int] = {}
        """On which line a variable got a value last."""
        self._definers: dict[str, str] = {}
        """The program of a level that has ended, by what it defined."""
        self._language = language

    @property
    def values(self) -> dict[str, Known]:
        """The values of what is known everywhere."""
        return self.levels[0].values

    def leave(self, depth: int) -> None:
        """End levels; what they have is gone."""
        for level in self.levels[depth:]:
            self._definers |= dict.fromkeys(level.types, level.program)
        del self.levels[depth:]

    def place(self, name: str) -> tuple[int, str]:
        """The level that has a variable, and its name there."""
        top, (array, bracket, index) = len(self.levels) - 1, name.partition("[")
        link = self.levels[top].links.get(array)
        if link is not None:
            return link[0], f"{link[1]}{bracket}{index}"
        if array in self.levels[top].types:
            return top, name
        match self._language.scope(name):
            case VariableScope.LEVEL:
                return top, name
            case VariableScope.NESTED:
                return next((at for at in range(top, -1, -1) if name in self.levels[at].values), top), name
            case _:
                return 0, name

    def type_of(self, name: str) -> VariableType | None:
        """The type of a variable, where that is known: an R parameter is REAL."""
        depth, there = self.place(name)
        is_number = re.fullmatch(r"R\d+", there) is not None
        return self.levels[depth].types.get(_array(there), VariableType.REAL if is_number else None)

    def is_set(self, name: str) -> bool:
        """Whether a variable has been set."""
        depth, there = self.place(name)
        return there in self.levels[depth].values

    def value(self, term: Term) -> Known:
        """The value of a term."""
        return evaluate(term, self._look_up)

    def truth(self, condition: Term) -> bool | Unknown:
        """The truth of a condition; Unknown with its reason if a variable has no value."""
        value = self.value(condition)
        return value if isinstance(value, Unknown) else is_true(value)

    def resolve(self, target: Term | str) -> str | Unknown:
        """The name or the number of what is called."""
        value = target if isinstance(target, str) else self.value(target)
        if isinstance(value, Vacant):
            return Unknown("its variable is empty")
        return f"{value:.0f}" if isinstance(value, float) else value

    def name(self, variable: Variable | Indexed) -> str | Unknown:
        """The name of a variable, its indices computed."""
        if isinstance(variable, Variable):
            return variable.name
        indices = [self.value(each) for each in variable.indices]
        unknown = next((each for each in indices if isinstance(each, Unknown)), None)
        return unknown or name_of_indexed(variable.prefix, indices, variable.suffix)

    def assign(self, statement: Assign | Forget) -> bool:
        """Set a variable; whether its value is known."""
        name = self.name(statement.variable)
        value = Unknown(statement.reason) if isinstance(statement, Forget) else self.value(statement.value)
        if isinstance(name, Unknown):
            # Which one it is, is not known: it may be any.
            self.lose_all(name.reason)
            return False
        if statement.of_type is not None:
            self.levels[-1].types[_array(name)] = statement.of_type
        elif self.defines and self._language.scope(name) is VariableScope.NESTED:
            self.levels[-1].values[name] = value
        elif self._where_defined(name):
            return False
        self.set(name, value)
        return not isinstance(value, Unknown)

    def set(self, name: str, value: Known) -> None:
        """Let a variable hold a value, of its type."""
        depth, there = self.place(name)
        if depth == 0 and there in self.given:
            return
        level = self.levels[depth]
        kind = level.types.get(_array(there))
        value = value if kind is None else as_type(value, kind, name)
        value = level.values[there] = self.stated(there, value) if depth else value
        self._lines[there, value] = self.line
        if len(self.assigned) < MOST_LOGGED:
            self.assigned.append(there)

    def stated(self, name: str, value: Known) -> Known:
        """The value that is stated apart of what a subprogram has for itself, unless the main program has the name;
        else another one."""
        is_main = not self._language.declares or _array(name) in self.levels[0].types
        return value if is_main else self.given.get(name, value)

    def copy(self) -> list[VariableLevel]:
        """The levels, to be kept."""
        return [each.copy() for each in self.levels]

    def join(self, one: Sequence[VariableLevel], other: Sequence[VariableLevel], reason: str) -> list[VariableLevel]:
        """The levels where two ways meet, given those on each; `reason` names what decides between the ways."""
        return [self._join_level(*levels, reason) for levels in zip(one, other, strict=True)]

    def _join_level(self, one: VariableLevel, other: VariableLevel, reason: str) -> VariableLevel:
        names = dict.fromkeys([*one.values, *other.values])
        values = {name: self._join(name, one.values.get(name), other.values.get(name), reason) for name in names}
        return VariableLevel(one.program, values, {**other.types, **one.types}, one.links)

    def _join(self, name: str, one: Known | None, other: Known | None, reason: str) -> Known:
        if one is not None and (one == other or isinstance(one, Unknown)):
            return one
        if isinstance(other, Unknown):
            return other
        held = [each for each in (one, other) if each is not None]
        told = [f"{_shown(each)}{self._set_on(name, each)}" for each in held]
        return Unknown(f"{name} is {' or '.join([*told, *['not set'] * (2 - len(held))])}; {reason}")

    def _set_on(self, name: str, value: Known) -> str:
        line = self._lines.get((name, value), 0)
        return f" (program line {line})" if line else ""

    def lose(self, names: Iterable[str], reason: str) -> None:
        """Forget what some variables hold."""
        for name in names:
            depth, there = self.place(name)
            if depth or there not in self.given:
                self.levels[depth].values[there] = Unknown(reason)

    def lose_all(self, reason: str) -> None:
        """Forget what every variable holds."""
        for depth, level in enumerate(self.levels):
            for name in level.values:
                if depth or name not in self.given:
                    level.values[name] = Unknown(reason)

    def given_of(self, names: Iterable[str]) -> dict[str, Known]:
        """Those of some variables that are stated apart."""
        return {name: self.given[name] for name in names if name in self.given}

    def all(self) -> tuple[frozenset[tuple[str, Known]], ...]:
        """The values of all variables, level by level, to be compared."""
        return tuple(frozenset(each.values.items()) for each in self.levels)

    def set_once(self) -> VariableLevel:
        """The variables that are known everywhere and were set once in all, or is stated apart."""
        once = {name for name, times in Counter(self.assigned).items() if times == 1} | self.given.keys()
        return replace(self.levels[0], values={name: value for name, value in self.values.items() if name in once})

    def _look_up(self, name: str) -> Known:
        if name == SKIP_SWITCH.name:
            return Unknown("a switch at the machine skips blocks that begin with /")
        depth, there = self.place(name)
        if depth:
            value = self.levels[depth].values.get(there)
            # A call does not give what is empty.
            is_vacant = self._language.always_empty and self._language.scope(name) is VariableScope.LEVEL
            empty = VACANT if is_vacant else Unknown(self._language.unknown(name))
            return value if value is not None else empty
        definer = self._where_defined(name)
        if definer:
            return Unknown(definer)
        value = self._language.value_of(there, self.values)
        is_given = self.is_called and (self._language.scope(name) is VariableScope.LEVEL or not name.startswith("#"))
        if is_given and isinstance(value, Unknown) and value.reason == f"{there}{UNSET}":
            return Unknown(f"{name}{ARGUMENT}this program")
        return value

    def _where_defined(self, name: str) -> str:
        """That a variable is defined elsewhere, and not for what runs here; empty if that is not so."""
        (depth, there), array, is_main = self.place(name), _array(name), len(self.levels) == 1
        if depth or (array in self.levels[0].types and (is_main or self._language.shows_main)):
            return ""
        if array in self.levels[0].types:
            definer = "the main program"
        elif there in self.values:
            return ""
        else:
            hidden = (each.program for each in reversed(self.levels[1:]) if array in each.types)
            definer = next(hidden, self._definers.get(array, ""))
        told = f"{name} is not known here: {definer} defines it for itself alone" if definer else ""
        if told and told not in self.undefined:
            self.undefined.append(told)
        return told


_LARGEST_INT = 2**31
_MOST_CHARACTERS = 255


def as_type(value: Known, kind: VariableType, name: str) -> Known:
    """A value as a variable of a type holds it: a whole number as an INT, TRUE or FALSE as a BOOL. From the middle, an
    INT goes away from 0: printed of positive numbers, assumed of negative ones."""
    if isinstance(value, Unknown | Vacant):
        return value
    if kind is VariableType.BOOL:
        return float(is_true(value))
    if kind is VariableType.CHAR and isinstance(value, str) and len(value) == 1:
        value = float(ord(value))
    if kind in _NOT_FOLLOWED:
        return Unknown(f"{name} is of type {kind.value}, which is not followed")
    if isinstance(value, str) == (kind is VariableType.STRING):
        if isinstance(value, str) or kind is VariableType.REAL:
            return value
        whole = FUNCTIONS["round"](value)
        least, most = (0, _MOST_CHARACTERS) if kind is VariableType.CHAR else (-_LARGEST_INT, _LARGEST_INT - 1)
        if least <= whole <= most:
            return whole
    shown = f'"{value}"' if isinstance(value, str) else f"{value:g}"
    return Unknown(f"{name} is of type {kind.value} and cannot hold {shown}")


_NOT_FOLLOWED = (VariableType.AXIS, VariableType.FRAME)


def _array(name: str) -> str:
    """The name of a variable, or of the array to which it belongs."""
    return name.partition("[")[0]


def _shown(value: Known) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
