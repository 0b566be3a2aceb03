"""The front door for Python: parse, check and solve a block, a text or a file."""

import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from contoursolve import syntax
from contoursolve.contour import Contour
from contoursolve.diagnosis import Edit, EditKind, apply_edits, find_repairs
from contoursolve.diagnostic import Diagnostic, Severity
from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.examine import Depth, Policy
from contoursolve.model import Length
from contoursolve.pipeline import Result, UnknownControlError, recognise, run
from contoursolve.syntax import Program

STANDARD_INPUT = "-"
_TAPE_CODES = bytes([0x02, 0x03, 0x11, 0x12, 0x13, 0x14, 0x1A])
"""STX, ETX, DC1 to DC4 and SUB: left in a program by a reader of paper tape or by DOS."""

_BINARY = frozenset(range(0x20)) - frozenset(b"\t\n\v\f\r" + _TAPE_CODES)
"""Bytes that no program holds; a file in UTF-16 holds NUL."""


@dataclass(frozen=True, slots=True)
class Completion:
    """A word that completes a block: the word, the whole block with it, and the contour that it then has
    (None while the word's number is open)."""

    word: str
    block: str
    contour: Contour | None


class UnreadableProgramError(ValueError):
    """A file that is missing, is no file, or is not text; the message says which."""


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
        name: what findings call the program.

    Returns:
        Frozen records: `answers`, one for each contour with its status and path (mm, X of a lathe as
        radius), and `diagnostics`, all findings.

    Raises:
        UnknownControlError: the control is unknown, or the program does not tell it.
        ValueError: units, rules or depth is none of its choices.

    >>> answer = solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").answers[0]
    >>> answer.status.value
    'solved'
    >>> [f"{value:.4f}" for value in answer.contour.end]
    ['-50.2073', '50.0000']
    >>> solve("G111 X100. A180. B120.", start="X40. Z0.").answers[0].status.value
    'rejected'
    """
    program = syntax.parse(text, name)
    return solve_program(program, control=control, start=start, units=units, rules=rules, depth=depth)


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


def what_if(
    block: str,
    *,
    drop: Iterable[str] = (),
    add: Iterable[str] = (),
    change: Mapping[str, str] | None = None,
    control: str | None = None,
    start: str | None = None,
    units: str = "mm",
    rules: str = "enforce",
) -> Result:
    """Solve a block with words dropped (by address), added, or changed (address to the new word).

    Other arguments and errors as for `solve`; raises ValueError if a word to drop or change is not there,
    or there more than once.

    >>> block = "G111 A135. I10. K-12. B180. Z-40."
    >>> what_if(block, drop=["A"], start="X40. Z0.").diagnostics
    ()
    >>> what_if(block, change={"K": "K-10."}, start="X40. Z0.", rules="off").answers[0].status.value
    'overdetermined'
    """
    program = syntax.parse(block)
    edits = [_edit(program, address, "") for address in drop]
    edits += [_edit(program, address, word) for address, word in (change or {}).items()]
    last = next(each for each in reversed(program.blocks) if each.words)
    edits += [Edit(EditKind.ADD, word, text=word, line=last.line) for word in add]
    text = "\n".join(apply_edits(program.blocks, edits))
    return solve(text, control=control, start=start, units=units, rules=rules)


def _edit(program: Program, address: str, text: str) -> Edit:
    words = [word for block in program.blocks for word in block.words if word.address == address.upper()]
    if len(words) != 1:
        raise ValueError(f"the block has {len(words)} words {address}; exactly one can be dropped or changed")
    kind = EditKind.CHANGE if text else EditKind.DROP
    return Edit(kind, words[0].address, words[0].span, words[0].text, text)


def completions(
    block: str, *, control: str | None = None, start: str | None = None, units: str = "mm"
) -> tuple[Completion, ...]:
    """Every single word that would complete a block, with its value where the geometry fixes it already.

    Arguments and errors as for `solve`. A word whose number is still to be chosen ends with `?`.

    >>> [each.word for each in completions("G111 A135. B180. Z-40.", start="X40. Z0.")]
    ['I?', 'K?', 'U?', 'X?']
    """
    program = syntax.parse(block)
    dialect = _dialect(control) if control else recognise(program)
    result = solve(block, control=control, start=start, units=units)
    repairs = (repair for answer in result.answers if dialect for repair in find_repairs(answer, dialect).repairs)
    return tuple(
        Completion(repair.edits[0].text, repair.replacement, repair.contour)
        for repair in repairs
        if len(repair.edits) == 1 and repair.edits[0].kind is EditKind.ADD
    )


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
) -> Result:
    """Solve every contour of a program that was parsed or read before; as `solve`."""
    dialect = _dialect(control) if control else recognise(program)
    beginning = syntax.parse(start, program.name, first_line=0) if start is not None else None
    return run(program, dialect, Length(units), Policy(rules), Depth(depth), beginning)


def only_findings(result: Result) -> Result:
    """The result as `check` reports it: that there is nothing to solve is then a warning."""
    findings = (
        replace(each, severity=Severity.WARNING) if each.code == "no-contour" else each for each in result.diagnostics
    )
    return replace(result, diagnostics=tuple(findings))


def read_program(path: str | Path) -> Program:
    """Read a file of UTF-8 or Latin-1 text; `-` is standard input.

    Raises UnreadableProgramError if there is no such file, or it is not text.
    """
    name = str(path)
    try:
        data = sys.stdin.buffer.read() if name == STANDARD_INPUT else Path(path).read_bytes()
    except IsADirectoryError:
        raise UnreadableProgramError(f"{name} is a directory, not a program file") from None
    except FileNotFoundError:
        raise UnreadableProgramError(f"{name}: no such file") from None
    except (OSError, ValueError) as error:
        if Path(name).is_dir():  # Windows answers "permission denied" for a directory
            raise UnreadableProgramError(f"{name} is a directory, not a program file") from None
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise UnreadableProgramError(f"{name} cannot be read: {reason}") from None
    if not _BINARY.isdisjoint(data):
        raise UnreadableProgramError(
            f"{name} is not a text file (it holds control bytes); save it as UTF-8 or Latin-1 text"
        )
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
    return syntax.parse(text, "<standard input>" if name == STANDARD_INPUT else name)


def _dialect(control: str) -> Dialect:
    if control not in DIALECTS:
        raise UnknownControlError(f"unknown control {control!r}; choose from {', '.join(DIALECTS)}")
    return DIALECTS[control]
