"""Request for the examination of a program: its control, and the options besides its text."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import wraps
from inspect import Parameter, signature
from pathlib import Path
from typing import TYPE_CHECKING, Literal, ParamSpec, TypedDict, TypeVar

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls import COMMON_RULES, CONTROLS, ControlName
from contoursolve.diagnosis import Depth, Policy
from contoursolve.diagnostics import check_type, choice_of
from contoursolve.execution import ALONE, Surroundings, check_names, surroundings_of
from contoursolve.gcode import ISO, Directive, Named, NamedAs, Program, parse, read_directive, read_named, spelled
from contoursolve.geometry import Length
from contoursolve.program.called_files import blocks_of_called_files
from contoursolve.reading import Control, Rule

if TYPE_CHECKING:
    from contoursolve.geometry import Statement

P = ParamSpec("P")
T = TypeVar("T")


class Request(Struct, frozen=True):
    """Options of an examination; made once for each program, where it comes in."""

    control: Control | None
    """Its control; None where nothing tells it, so that its characters alone are examined."""
    unit: Length = Length.MM
    """Of the numbers before any code that says it."""
    policy: Policy = Policy.ENFORCE
    depth: Depth = Depth.FULL
    start: Program | None = None
    """A block that states the start point apart from the program; its line is line 0."""
    facts: tuple[Directive, ...] = ()
    """Further facts about the only contour; their lines are -1, -2, ..."""
    named: tuple[Named, ...] = ()
    """Words that are named for the whole program: those that are right, and those that are compared."""
    around: Surroundings = ALONE
    """The values of variables, and where subprograms are."""
    is_strict: bool = False
    """Whether every line is told of, and not only that on which a contour depends."""

    def of(self, control: Control, lines: Callable[[], Iterable[str]] | None = None) -> "Request":
        """The same for a program of this control, as which the start point is read, too. Raises VariableNameError
        where a value is stated of what is none of its variables, nor one that its `lines` declare."""
        if self.around.values and control.modes.language is not None:
            check_names(self.around.values, [control.modes.language], lines and (lambda: self._with_called(lines())))
        return replace(self, control=control, start=self.start and spelled(self.start, control.modes.syntax))

    def _with_called(self, lines: Iterable[str]) -> Iterator[str]:
        """Lines, and those of the files that they call."""
        own = [*lines]
        yield from own
        yield from (block.text for block in blocks_of_called_files(own, self.around))

    @property
    def rules(self) -> tuple[Rule, ...]:
        """The rules by which findings are told: where nothing tells the control, those of all controls."""
        return self.control.rules if self.control is not None else COMMON_RULES


Units = Literal["mm", "inch"]
Rules = Literal["enforce", "warn", "off"]
Depths = Literal["verdict", "path", "full", "findings", "trial"]
"""The values of `Length`, `Policy` and `Depth`, as users write them."""


class ReadingKeywords(TypedDict, total=False):
    """Keywords that say as what a program is read."""

    control: "ControlName | Control | None"
    units: Units
    rules: Rules
    settings: "Mapping[str, str] | None"


class StartKeywords(ReadingKeywords, total=False):
    """These, and where it begins, with which values."""

    start: "str | Mapping[str, float] | None"
    variables: "Mapping[str, float] | None"


class ProgramKeywords(StartKeywords, total=False):
    """These, and what else is stated beside a program."""

    facts: "Iterable[str | Statement]"
    folders: "Iterable[str | Path]"


class FindingKeywords(ProgramKeywords, total=False):
    """These, and words about which something is said."""

    trust: "str | Iterable[str]"
    reference: "str | Iterable[str]"


class SolveKeywords(FindingKeywords, total=False):
    """These, and how far findings are explained."""

    depth: Depths


class CheckKeywords(FindingKeywords, total=False):
    """Those without it, and whether all findings are told."""

    strict: bool


class FollowKeywords(SolveKeywords, CheckKeywords, total=False):
    """All keywords."""


class SolveOptions(Struct, frozen=True, kw_only=True):
    """The keywords of `solve` and its kin, as they are stated; see there."""

    control: "str | Control | None" = None
    start: "str | Mapping[str, float] | None" = None
    units: str = "mm"
    rules: str = "enforce"
    depth: str = "full"
    facts: "Iterable[str | Statement]" = ()
    settings: "Mapping[str, str] | None" = None
    variables: "Mapping[str, float] | None" = None
    folders: "Iterable[str | Path]" = ()
    trust: "str | Iterable[str]" = ()
    reference: "str | Iterable[str]" = ()
    strict: bool = False

    def check_types(self) -> None:
        """Raise TypeError, which names the option and what fits, for one of another type."""
        for argument, (kind, fits) in _ARGUMENTS.items():
            if (value := getattr(self, argument)) is not None:
                check_type(argument, value, kind, fits)

    def request(self, name: str, control: Control | None = None) -> Request:
        """The request for the program of this name, for a control; a text alone is one fact. Raises ValueError where
        units, rules or depth is none of its choices."""
        self.check_types()
        start = start_text(self.start)
        several = [self.facts] if isinstance(self.facts, str) else self.facts
        asked = Request(
            None,
            choice_of(Length, self.units, "units"),
            choice_of(Policy, self.rules, "rules"),
            choice_of(Depth, self.depth, "depth"),
            parse(start, name, first_line=0) if start is not None else None,
            tuple(_fact(fact, -number) for number, fact in enumerate(several, 1)),
            tuple(_named(NamedAs.TRUST, self.trust) + _named(NamedAs.REFERENCE, self.reference)),
            surroundings_of(name, self.variables, self.folders),
            self.strict,
        )
        if control is None and asked.around.values:
            check_names(asked.around.values, [each.modes.language for each in CONTROLS.values() if each.modes.language])
        return asked.of(control) if control is not None else asked


_ARGUMENTS: Mapping[str, tuple[type, str]] = {
    "facts": (Iterable, 'texts, such as "length of line 1 = 30"'),
    "settings": (Mapping, 'a mapping of settings, such as {"fanuc-lathe.angle": "normal"}'),
    "variables": (Mapping, 'a mapping of variables, such as {"#100": 95.0}'),
    "folders": (Iterable, "names of folders"),
    "trust": (Iterable, 'words, such as "Z-50. A120."'),
    "reference": (Iterable, 'words, such as "Z-50."'),
}
"""Types of options, and what fits."""


def start_text(start: object) -> str | None:
    """The words of a start point: as they are typed, or numbers by letters such as `{"X": 40, "Z": 0}`, which count as
    the words do. Raises TypeError for anything else."""
    if start is None or isinstance(start, str):
        return start
    if not isinstance(start, Mapping):
        raise TypeError(f'the start is words such as "X40. Z0.", or {{"X": 40, "Z": 0}}, not {start!r}')
    from contoursolve.diagnosis import typed_text  # noqa: PLC0415 - few starts are numbers

    words: list[str] = []
    for letter, value in start.items():
        check_type("a letter of the start", letter, str)
        try:
            words.append(f"{letter}{typed_text(value)}")
        except (TypeError, ValueError):
            raise TypeError(f"{letter} of the start is a number, not {value!r}") from None
    return " ".join(words)


def takes(keywords: type[ReadingKeywords]) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """A function whose further keywords are those of a table: `help` shows them with their defaults, and another one is
    a TypeError."""
    shown = [
        Parameter(
            name,
            Parameter.KEYWORD_ONLY,
            default=getattr(SolveOptions(), name, None),
            annotation=getattr(annotation, "__forward_arg__", annotation),
        )
        for name, annotation in keywords.__annotations__.items()
    ]

    def with_keywords(function: Callable[P, T]) -> Callable[P, T]:
        own = [each for each in signature(function).parameters.values() if each.kind is not Parameter.VAR_KEYWORD]
        whole = signature(function).replace(parameters=[*own, *shown])
        known = {*whole.parameters}

        @wraps(function)
        def checked(*arguments: P.args, **options: P.kwargs) -> T:
            unknown = next((name for name in options if name not in known), None)
            if unknown is not None:
                raise TypeError(f"{function.__name__}() got an unexpected keyword argument {unknown!r}")
            return function(*arguments, **options)

        checked.__signature__ = whole  # type: ignore[attr-defined]
        return checked

    return with_keywords


def _named(role: NamedAs, texts: "str | Iterable[str]") -> list[Named]:
    """Words that are named apart from a program, as they are typed; its control reads them."""
    return [read_named(role, text, ISO) for text in ([texts] if isinstance(texts, str) else texts)]


def _fact(fact: "str | Statement", line: int) -> Directive:
    if not isinstance(fact, str):
        from contoursolve.geometry import Statement  # noqa: PLC0415 - few facts are records

        check_type("a fact", fact, Statement, 'a text such as "length of line 1 = 30", or a statement')
    text = fact if isinstance(fact, str) else str(fact)
    return replace(read_directive(text, line), statement=None if isinstance(fact, str) else fact)
