"""Request for the examination of a program: its control, and the options besides its text."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls import COMMON_RULES, DIALECTS
from contoursolve.diagnosis import Depth, Policy
from contoursolve.diagnostics import choice_of
from contoursolve.execution import ALONE, Surroundings, check_names, surroundings_of
from contoursolve.gcode import Directive, Program, parse, read_directive, spelled
from contoursolve.geometry import Length
from contoursolve.program.called_files import blocks_of_called_files
from contoursolve.reading import Dialect, Rule

if TYPE_CHECKING:
    from contoursolve.geometry import Statement


class Request(Struct, frozen=True):
    """Options of an examination; made once for each program, where it comes in."""

    dialect: Dialect | None
    """Its control; None where nothing tells it, so that its characters alone are examined."""
    unit: Length = Length.MM
    """Of the numbers before any code that says it."""
    policy: Policy = Policy.ENFORCE
    depth: Depth = Depth.FULL
    start: Program | None = None
    """A block that states the start point apart from the program; its line is line 0."""
    facts: tuple[Directive, ...] = ()
    """Further facts about the only contour; their lines are -1, -2, ..."""
    around: Surroundings = ALONE
    """The values of variables, and where subprograms are."""
    is_strict: bool = False
    """Whether every line is told of, and not only that on which a contour depends."""

    def of(self, dialect: Dialect, lines: Callable[[], Iterable[str]] | None = None) -> "Request":
        """The same for a program of this control, as which the start point is read, too. Raises VariableNameError
        where a value is stated of what is none of its variables, nor one that its `lines` declare."""
        if self.around.values and dialect.modes.language is not None:
            check_names(self.around.values, [dialect.modes.language], lines and (lambda: self._with_called(lines())))
        return replace(self, dialect=dialect, start=self.start and spelled(self.start, dialect.modes.syntax))

    def _with_called(self, lines: Iterable[str]) -> Iterator[str]:
        """Lines, and those of the files that they call."""
        own = [*lines]
        yield from own
        yield from (block.text for block in blocks_of_called_files(own, self.around))

    @property
    def rules(self) -> tuple[Rule, ...]:
        """The rules by which findings are told: where nothing tells the control, those of all controls."""
        return self.dialect.rules if self.dialect is not None else COMMON_RULES


def request_for(  # noqa: PLR0913 - takes what `solve` takes
    name: str,
    dialect: Dialect | None = None,
    *,
    start: str | None = None,
    units: str = "mm",
    rules: str = "enforce",
    depth: str = "full",
    facts: "Iterable[str | Statement]" = (),
    variables: Mapping[str, float] | None = None,
    folders: Iterable[str | Path] = (),
    strict: bool = False,
) -> Request:
    """The request that arguments of `solve` state about the program of this name for a control; a text alone is one
    fact. Raises ValueError where units, rules or depth is none of its choices."""
    several = [facts] if isinstance(facts, str) else facts
    asked = Request(
        None,
        choice_of(Length, units, "units"),
        choice_of(Policy, rules, "rules"),
        choice_of(Depth, depth, "depth"),
        parse(start, name, first_line=0) if start is not None else None,
        tuple(_fact(fact, -number) for number, fact in enumerate(several, 1)),
        surroundings_of(name, variables, folders),
        strict,
    )
    if dialect is None and asked.around.values:
        check_names(asked.around.values, [each.modes.language for each in DIALECTS.values() if each.modes.language])
    return asked.of(dialect) if dialect is not None else asked


def _fact(fact: "str | Statement", line: int) -> Directive:
    text = fact if isinstance(fact, str) else str(fact)
    return replace(read_directive(text, line), statement=None if isinstance(fact, str) else fact)
