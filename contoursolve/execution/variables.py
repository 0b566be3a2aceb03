"""Values of a program's variables while it runs."""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from msgspec import Struct

from contoursolve.diagnostics import UserError
from contoursolve.execution.evaluate import evaluate, is_true, name_of_indexed
from contoursolve.execution.macro_language import (
    ARGUMENT,
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
)
from contoursolve.numeric import Indexed, Term, Variable

MOST_LOGGED = 10_000
"""Assignments that are kept in mind while it is not known whether a jump took place."""

_LAST_LOCAL = 33


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
    return name in code.parameters or any(isinstance(each, Variable) and each.name == name for each in set_here)


def _setting(name: str) -> str:
    return "; a setting is stated with --set" if re.fullmatch(r"[\w-]+\.[\w-]+", name) else ""


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
        targets = {*code.parameters, *_names_in(tuple(set_here))}
        numbers = {each.variable: _number_of(each) for each in code.statements if isinstance(each, Assign)}
        for name in (*code.parameters, *_names_in((code.statements, code.words))):
            set_on = number if name in targets else None
            is_set = set_on is not None
            value = numbers.get(Variable(name)) if is_set else None
            before = found.setdefault(name, NamedVariable(name, number, set_on, value))
            if before.set_on is None and is_set:
                found[name] = NamedVariable(name, before.line, set_on, value)
    own = (each for each in found.values() if each.name not in (SKIP_SWITCH.name, language.always_empty))
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


class Variables:
    """The variables of a program; `given` are values that are stated apart from it and hold whatever it sets, `own`
    tells the local variables of the subprogram that runs, None if it has none of its own."""

    def __init__(
        self, language: MacroLanguage, given: Mapping[str, float], own: Callable[[], dict[str, Known] | None]
    ) -> None:
        self.given, self.values = dict(given), dict[str, Known](given)
        self.assigned: list[str] = []
        """What was set, in order."""
        self.line = 0
        """The line that runs."""
        self.is_called = False
        """Whether others call the program, so that what nothing sets is an argument."""
        self._lines: dict[tuple[str, Known], int] = {}
        """On which line a variable got a value last."""
        self._language, self._own = language, own

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
        self.set(name, value)
        return not isinstance(value, Unknown)

    def set(self, name: str, value: Known) -> None:
        """Let a variable hold a value."""
        own = self._own()
        if name in self.given and not (own is not None and name in own):
            return
        target = own if own is not None and _is_local(name) else self.values
        target[name] = value
        self._lines[name, value] = self.line
        if len(self.assigned) < MOST_LOGGED:
            self.assigned.append(name)

    def join(self, one: Mapping[str, Known], other: Mapping[str, Known], reason: str) -> dict[str, Known]:
        """The values of variables where two ways meet, given those on each; `reason` names what decides between the
        ways."""
        both = dict.fromkeys([*one, *other])
        return {name: self._join(name, one.get(name), other.get(name), reason) for name in both}

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
            if name not in self.given:
                self.values[name] = Unknown(reason)

    def lose_all(self, reason: str) -> None:
        """Forget what every variable holds."""
        self.lose([*self.values], reason)

    def all(self) -> dict[str, Known]:
        """The values of all variables, those of the subprogram among them."""
        return self.values | (self._own() or {})

    def set_once(self) -> dict[str, Known]:
        """Those that were set once in all, or are stated apart."""
        once = {name for name, times in Counter(self.assigned).items() if times == 1} | self.given.keys()
        return {name: value for name, value in self.values.items() if name in once}

    def _look_up(self, name: str) -> Known:
        if name == SKIP_SWITCH.name:
            return Unknown("a switch at the machine skips blocks that begin with /")
        own = self._own()
        if own is not None and name in own:
            return own[name]
        if own is not None and _is_local(name):
            # The call does not give it.
            return VACANT
        value = self._language.value_of(name, self.values)
        is_given = self.is_called and (_is_local(name) or not name.startswith("#"))
        if is_given and isinstance(value, Unknown) and value.reason == f"{name}{UNSET}":
            return Unknown(f"{name}{ARGUMENT}this program")
        return value


def _shown(value: Known) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _is_local(name: str) -> bool:
    """Whether a variable belongs to one subprogram: #1 to #33 of Fanuc."""
    return name.startswith("#") and name[1:].isdigit() and 1 <= int(name[1:]) <= _LAST_LOCAL
