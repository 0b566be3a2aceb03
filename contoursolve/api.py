"""The front door for Python: parse, check and solve a block, a text or a file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from contoursolve import syntax
from contoursolve.diagnostic import Diagnostic, Severity
from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.examine import Depth, Policy
from contoursolve.model import Length
from contoursolve.pipeline import Result, UnknownControlError, recognise, run
from contoursolve.project import configure
from contoursolve.reading import Trouble
from contoursolve.syntax import STANDARD_INPUT, Directive, Program, UnreadableProgramError

if TYPE_CHECKING:
    from contoursolve.expansion import Expansion
    from contoursolve.statements import Statement

__all__ = [
    "UnreadableProgramError",
    "check",
    "check_file",
    "expand",
    "find_dialect",
    "only_findings",
    "parse",
    "read_program",
    "solve",
    "solve_file",
    "solve_program",
]


def parse(text: str, *, name: str = "<program>") -> Program:
    """The blocks and words of a program's text, exactly as typed.

    >>> parse("G111 X100. A180. K-30. B120.").blocks[0].words[1].text
    'X100.'
    """
    return syntax.parse(text, name)


def solve(
    text: str,
    *,
    control: str | None = None,
    start: str | None = None,
    units: str = "mm",
    rules: str = "enforce",
    depth: str = "full",
    facts: Iterable[str | Statement] = (),
    settings: Mapping[str, str] | None = None,
    name: str = "<program>",
) -> Result:
    """Solve every contour of a program, or of a single block.

    Args:
        text: the program, one or more lines.
        control: `yasnac-lx3` or `nct-99m`; found from the program where it is clear.
        start: words that give the start point, such as `"X40. Z0."`, as the control reads them.
        units: `mm` or `inch`, for numbers before any G20 or G21.
        rules: `enforce`, `warn` or `off` (see `Policy`).
        depth: `full`, or `verdict` for findings without reasons and repairs (see `Depth`).
        facts: further facts about the only contour, as text (see `contoursolve facts`) or as statements.
        settings: conventions of the controls by `control.name` (see `contoursolve rules`); the default ones without.
        name: what findings call the program.

    Returns:
        Frozen records: `answers`, one for each contour with its status and path (mm, X of a lathe as
        radius), and `diagnostics`, all findings.

    Raises:
        UnknownControlError: the control is unknown, or the program does not tell it.
        FactPlaceError: facts for a program of several contours.
        SettingError: there is no such setting, or it has no such value.
        ValueError: units, rules or depth is none of its choices.

    >>> answer = solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").answers[0]
    >>> answer.status.value
    'solved'
    >>> [f"{value:.4f}" for value in answer.contour.end]
    ['-50.2073', '50.0000']
    >>> solve("G111 X100. A180. B120.", start="X40. Z0.").answers[0].status.value
    'rejected'
    >>> asked = solve("G111 X100. A180. K-30. B120. P?", start="X40. Z0.", facts=["straight part of line 2 = 30."])
    >>> f"{asked.answers[0].answers[0].value:.3f}"
    '8.038'
    """
    program = syntax.parse(text, name)
    return solve_program(
        program,
        control=control,
        start=start,
        units=units,
        rules=rules,
        depth=depth,
        facts=facts,
        settings=settings,
    )


def check(
    text: str,
    *,
    control: str | None = None,
    start: str | None = None,
    units: str = "mm",
    rules: str = "enforce",
    name: str = "<program>",
) -> tuple[Diagnostic, ...]:
    """The findings about a program; arguments and errors as for `solve`.

    A program without a contour block gets a warning here, where `solve` has an error.

    >>> [each.code for each in check("G00 X40. Z0.\\nG111 X100. A180. B120.")]
    ['g111-line-1', 'words-missing']
    """
    return only_findings(solve(text, control=control, start=start, units=units, rules=rules, name=name)).diagnostics


def solve_file(path: str | Path, *, control: str | None = None, units: str = "mm", rules: str = "enforce") -> Result:
    """Solve every contour of a file; `-` is standard input. Raises UnreadableProgramError, and as `solve`."""
    return solve_program(read_program(path), control=control, units=units, rules=rules)


def check_file(
    path: str | Path, *, control: str | None = None, units: str = "mm", rules: str = "enforce"
) -> tuple[Diagnostic, ...]:
    """The findings about a file; `-` is standard input. Raises UnreadableProgramError, and as `solve`."""
    return only_findings(solve_file(path, control=control, units=units, rules=rules)).diagnostics


def solve_program(
    program: Program,
    *,
    control: str | None = None,
    start: str | None = None,
    units: str = "mm",
    rules: str = "enforce",
    depth: str = "full",
    facts: Iterable[str | Statement] = (),
    settings: Mapping[str, str] | None = None,
) -> Result:
    """Solve every contour of a program that was parsed or read before; as `solve`."""
    dialect = find_dialect(control) if control else recognise(program)
    configured = configure(settings) if settings else {}
    if dialect is not None:
        dialect = configured.get(dialect.name, dialect)
    beginning = syntax.parse(start, program.name, first_line=0) if start is not None else None
    stated = [_fact(fact, -number) for number, fact in enumerate(facts, 1)]
    return run(program, dialect, Length(units), Policy(rules), Depth(depth), beginning, stated)


def _fact(fact: str | Statement, line: int) -> Directive:
    text = fact if isinstance(fact, str) else str(fact)
    return replace(syntax.read_directive(text, line), statement=None if isinstance(fact, str) else fact)


def only_findings(result: Result) -> Result:
    """The result as `check` reports it: that there is nothing to solve is then a warning."""
    findings = [
        replace(each, severity=Severity.WARNING) if each.about is Trouble.NO_CONTOUR else each
        for each in result.diagnostics
    ]
    return replace(result, diagnostics=tuple(findings))


def expand(
    text: str,
    *,
    post: str = "same",
    arcs: str = "center",
    decimals: int | None = None,
    comments: bool = True,
    keep_going: bool = False,
    control: str | None = None,
    start: str | None = None,
    units: str = "mm",
    rules: str = "enforce",
    facts: Iterable[str | Statement] = (),
    settings: Mapping[str, str] | None = None,
    name: str = "<program>",
) -> Expansion:
    """A program with every contour written as plain G00, G01, G02 and G03, and everything else as it was.

    Args:
        text: the program, with its line ends.
        post: the target: `same` (the control that the program is for), `linuxcnc` or `fanuc`.
        arcs: `center` (I J K) or `radius` (R).
        decimals: decimals of a length; the target's own without.
        comments: whether the original blocks are kept as comments.
        keep_going: whether to expand the other contours where one cannot be expanded.
        control: and all others as for `solve`, with the same errors.

    >>> print(expand("G00 X40. Z0.\\nG111 X100. A180. K-30. B120. C5. F0.2").text)
    G00 X40. Z0.
    (G111 X100. A180. K-30. B120. C5. F0.2)
    G01 X40. Z-27.887 F0.2
    G01 X50. Z-32.887
    G01 X100. Z-47.321
    """
    # Only this function needs them.
    from contoursolve.expansion import (  # noqa: PLC0415
        OPENING,
        Expansion,
        Options,
        Summary,
        expand_lines,
        lines_of_facts,
        opening_of,
    )
    from contoursolve.posts import Arcs, find_post  # noqa: PLC0415

    program = syntax.parse(text, name)
    dialect = find_dialect(control) if control else recognise(program)
    options = Options(find_post(post), Arcs(arcs), decimals, comments, keep_going)
    summary, unit, policy = Summary(), Length(units), Policy(rules)
    if dialect is None:
        return Expansion(text, None, summary)
    dialect = (configure(settings) if settings else {}).get(dialect.name, dialect)
    beginning = syntax.parse(start, name, first_line=0) if start is not None else None
    stated = [_fact(fact, -number) for number, fact in enumerate(facts, 1)]
    further = lines_of_facts(program, dialect, unit, beginning, stated)
    pieces = list(
        expand_lines(
            syntax.split_lines(text),
            dialect,
            options,
            summary,
            unit=unit,
            policy=policy,
            start=beginning,
            facts=further,
        )
    )
    opening = opening_of(options, dialect, unit, summary)
    written = "".join(opening if piece is OPENING else str(piece) for piece in pieces)
    return Expansion(written if keep_going or not summary.left else None, dialect.name, summary)


def read_program(path: str | Path) -> Program:
    """Read a file of UTF-8 or Latin-1 text; `-` is standard input.

    Raises UnreadableProgramError if there is no such file, or it is not text.
    """
    name = str(path)
    text = syntax.decode(syntax.read_bytes(name, "a program file"), name)
    return syntax.parse(text, "<standard input>" if name == STANDARD_INPUT else name)


def find_dialect(control: str) -> Dialect:
    """The control of this name. Raises UnknownControlError, which lists the choices."""
    if control not in DIALECTS:
        raise UnknownControlError(f"unknown control {control!r}; choose from {', '.join(DIALECTS)}")
    return DIALECTS[control]
