"""The front door for Python: parse, check and solve a block, a text or a file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from msgspec.structs import replace

# What these rooms hold is imported when it is asked for, by `help` and `typing.get_type_hints`, too.
from contoursolve import diagnosis, gcode, program as programs
from contoursolve.controls import ControlName
from contoursolve.diagnosis import Depth
from contoursolve.diagnostics import Diagnostic, LateModule, check_type, choice_of
from contoursolve.gcode import ANY_TEXT, STANDARD_INPUT, Program, decode, file_in_memory
from contoursolve.program import (
    CheckKeywords,
    FollowKeywords,
    ProgramKeywords,
    ReadingKeywords,
    Result,
    Run,
    SolveKeywords,
    SolveOptions,
    choose_alike,
    configure,
    find_control,
    find_settings,
    for_kind,
    restate_control,
    stated_settings,
    takes,
)
from contoursolve.reading import Control

if TYPE_CHECKING:
    from contoursolve import postprocess, tool_radius
else:
    postprocess, tool_radius = LateModule("contoursolve.postprocess"), LateModule("contoursolve.tool_radius")

__all__ = [
    "check",
    "convert",
    "expand",
    "fix",
    "parse",
    "solve",
    "system",
]


MOST_DECIMALS = 8
"""Decimals of a length that can be asked for."""


def parse(text: str | Path, *, name: str = "<program>") -> Program:
    """The blocks and words of a program's text, or of a file, exactly as typed.

    A file is UTF-8 or Latin-1 text. Raises UnreadableProgramError if there is none, or it is not text.

    >>> parse("G111 X100. A180. K-30. B120.").blocks[0].words[1].text
    'X100.'
    """
    check_type("text", text, str | Path, "a text (str), or a Path")
    return read_program(text) if isinstance(text, Path) else gcode.parse(text, name)


@takes(SolveKeywords)
def solve(
    program: str | Path | Program,
    *,
    tool: str | None = None,
    tip: int | None = None,
    side: str | None = None,
    outside: str | None = None,
    name: str = "<program>",
    **options: Unpack[SolveKeywords],
) -> Result:
    """Solve every contour of a program, or of a single block.

    Args:
        program: its text, one or more lines; the `Path` of a file; or what `parse` gave. A file has the settings of the
            project file beside it or above it, and `settings` on top of them.
        tool: a tool that goes along: its radius in the unit of the program, and its tip on a lathe, such as
            `"R0.8, tip 3"`; or `program` for what the program and the project file state.
        tip: the number of its imaginary tip.
        side: `left` or `right`, for a program without G41 or G42.
        outside: the way around an outside corner, `roll` or `intersect`.
        control: its name, such as `fanuc-lathe`, or a control of your own as its tables (see `Control`); found from
            the program where it is clear.
        start: words that give the start point, such as `"X40. Z0."`, as the control reads them; or `{"X": 40, "Z": 0}`.
        units: `mm` or `inch`, for numbers before any G20 or G21.
        rules: `enforce`, `warn` or `off` (see `Policy`).
        depth: `full`, or `verdict` for findings without reasons and repairs (see `Depth`).
        facts: further facts about the only contour, as text (see `contoursolve facts`) or as statements.
        settings: conventions of the controls by `control.name` (see `contoursolve rules`); the default ones without.
        variables: values of variables by name, such as `{"#100": 95.0}`, whatever the program says of them.
        folders: where files with subprograms are, besides that of the program.
        trust: words that are right, such as `"Z-50. A120."`: no fix changes them, and a conflict names the others.
        reference: coordinates with which the end of the only contour is compared; they are not used.
        name: what findings call a text.

    Returns:
        Frozen records. `answers` has one for each contour, with its status and path (mm, X of a lathe as radius).
        `answer` is the only one; `diagnostics` are all findings. With a tool, `tool` has its `runs`: each has its
        `path` (mm, X of a lathe as radius; None where the tool does not fit) and its `faults`.

    Raises:
        UnreadableProgramError: there is no such file, or it is not text.
        ToolError: there cannot be such a tool, or its side or tip is not stated.
        UnknownControlError: the control is unknown, or the program does not tell it.
        FactPlaceError: facts for a program of several contours.
        NamedWordError: a trusted word is not there, or a reference cannot be compared.
        SettingError: there is no such setting, or it has no such value.
        ValueError: units, rules or depth is none of its choices.

    >>> answer = solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").answer
    >>> answer.status.value
    'solved'
    >>> [f"{value:.4f}" for value in answer.contour.end]
    ['-50.2073', '50.0000']
    >>> solve("G111 X100. A180. B120.", start="X40. Z0.").answer.status.value
    'rejected'
    >>> asked = solve("G111 X100. A180. K-30. B120. P?", start="X40. Z0.", facts=["straight part of line 2 = 30."])
    >>> f"{asked.answer.asked[0].value:.3f}"
    '8.038'
    >>> text = "G42 G01 X18. Z0.\\nX20. Z-1.\\nZ-20."
    >>> found = solve(text, tool="R0.8, tip 3", control="fanuc-lathe", start="X0. Z0.").tool
    >>> [f"{value:.4f}" for value in found.runs[0].path.end]
    ['-20.8000', '10.0000']
    """
    run = _follow(program, name, SolveOptions(**options))
    if tool is None:
        if (stated := tip if tip is not None else side or outside) is not None:
            raise ValueError(f'{stated!r} is about a tool, and there is none: say tool="R0.8", or tool="program"')
        return run.collect()
    from contoursolve.tool_radius import look_at_tool, result_beside_tool, wanted_tool  # noqa: PLC0415 - only this

    result = run.collect()
    wanted = wanted_tool(result.program.name, tool, tip, side, outside)
    return result_beside_tool(result, look_at_tool(result, run.asked, wanted))


@takes(SolveKeywords)
def system(
    program: str | Path | Program, *, name: str = "<program>", **options: Unpack[SolveKeywords]
) -> diagnosis.EquationSystem:
    """The system of equations of a block, or of a program with one contour.

    Arguments and errors as for `solve`; raises ValueError where there is no contour, or more than one.

    Returns:
        Its `unknowns`, `words` and `equations` with their meaning, as sympy has them; `jacobian`, `rank`, `free` and
        `ties`; the `condition` on which it is determined; `corners`; and the `steps` in which it is solved.

    >>> shaft = system("G111 X100. A180. K-30. B120. P5.", start="X40. Z0.")
    >>> shaft.rank, shaft.free, shaft.condition
    (4, (), sin(B)*cos(A))
    >>> shaft.equations[0], round(shaft.margin, 6)
    (Eq(Z_V1, K + Z_S), -0.866025)
    >>> [each.symbol for each in shaft.free("B").unknowns], shaft.free("B").free
    ([Z_V1, X_V1, Z_V2, X_V2], (Z_V2,))
    >>> shaft.subs(B=150.).solve().items[0].solution.points["V2"]
    (-81.96152422706632, 50.0)
    """
    options.setdefault("depth", "verdict")
    return _follow(program, name, SolveOptions(**options)).collect().answer.system


def _follow(program: str | Path | Program, name: str, options: SolveOptions) -> Run:
    """A text, a file or a program that was parsed before, as a stream."""
    return follow_options(*read_source(program, name, options))


def read_source(program: str | Path | Program, name: str, options: SolveOptions) -> tuple[Program, SolveOptions]:
    """The blocks of a program; of a file with the settings that are found beside it."""
    if isinstance(program, Program):
        return program, options
    if not isinstance(program, Path):
        return _parsed(program, name), options
    folder = Path() if str(program) == STANDARD_INPUT else program.parent
    found = read_program(program)
    stated = stated_settings(block.text for block in found.blocks) | dict(options.settings or {})
    return found, replace(options, settings=find_settings(folder) | stated)


def _parsed(text: str, name: str) -> Program:
    """The blocks of a text that is no name of a file."""
    if not isinstance(text, str):
        raise TypeError(f"the program is a text (str), a Path or a Program, not {type(text).__name__}")
    _check_is_no_name(text)
    return gcode.parse(text, name)


def _check_is_no_name(text: str) -> None:
    """Raise ValueError for the name of a file in the place of its text."""
    if _FILE.fullmatch(text):
        raise ValueError(f"{text} is the name of a file, not its text: say Path({text!r})")


def _text(text: str | Path, name: str, options: SolveOptions) -> tuple[str, str, SolveOptions]:
    """The text of a program with what it is called, as `read_source`. Raises TypeError, ValueError."""
    if isinstance(text, Path):
        program, options = read_source(text, name, options)
        return program.text, program.name, options
    check_type("text", text, str, "the text of a program (str), or a Path")
    _check_is_no_name(text)
    return text, name, options


_FILE = re.compile(rf"[^\n]*(?:{'|'.join(map(re.escape, (*gcode.ENDINGS, '.txt')))})", re.IGNORECASE)
"""Text that is meant as the name of a program. No block ends so: behind a point there is a digit."""


@takes(CheckKeywords)
def check(
    program: str | Path | Program,
    *,
    name: str = "<program>",
    **options: Unpack[CheckKeywords],
) -> tuple[Diagnostic, ...]:
    """The findings about a program; arguments and errors as for `solve`.

    Outside contours they are those on which a contour depends; `strict` tells all. A program without a contour block
    gets a remark.

    >>> [each.code for each in check("G00 X40. Z0.\\nG111 X100. A180. B120.")]
    ['g111-line-1', 'words-missing']
    """
    return _follow(program, name, SolveOptions(**options, depth=_FINDINGS)).collect().diagnostics


@takes(CheckKeywords)
def fix(
    program: str | Path | Program,
    *,
    unsafe: bool = False,
    name: str = "<program>",
    **options: Unpack[CheckKeywords],
) -> programs.FixedProgram:
    """The program with all fixes that keep the contour applied, one after the other, until none is left.

    With `unsafe`, the first fix of each finding is applied, too, where it changes the contour. The program is examined
    after each fix. A fix that leaves its error, or brings another one, is not applied; `left` says why. Line ends and
    all other characters stay as they are. Other arguments and errors as for `solve`.

    >>> fix("G00 X40. Z0.\\r\\nG111 A135. I10. K-12. B180. Z-40.\\r\\n").text
    'G00 X40. Z0.\\r\\nG111 I10. K-12. B180. Z-40.\\r\\n'
    """
    from contoursolve.program import examined_result, likely_fixes, mend, safe_fixes  # noqa: PLC0415 - only this mends

    first, asked = read_source(program, name, SolveOptions(**options, depth=_FINDINGS))
    return mend(
        first.text,
        lambda now: examined_result(now, follow_options(gcode.parse(now, first.name), asked).collect()),
        likely_fixes if unsafe else safe_fixes,
    )


@takes(FollowKeywords)
def follow_program(
    program: Program,
    **options: Unpack[FollowKeywords],
) -> Run:
    """The same as a stream of contours and findings, for a program of any length; `strict` as for `check`."""
    return follow_options(program, SolveOptions(**options))


def follow_options(program: Program, options: SolveOptions) -> Run:
    """The same, with its options in a record."""
    asked = options.request(program.name)
    control = choose_alike(options.control, program, asked, options.settings)
    asked = asked if control is None else asked.of(control, lambda: (block.text for block in program.blocks))
    together = None
    if asked.control is not None and len(program.blocks) >= _MANY:
        from contoursolve.program import Batch  # noqa: PLC0415 - a few blocks are solved before it is imported

        together = Batch(asked.control, asked.policy, is_proven=asked.depth.is_proven)
    return Run(program, asked, together)


_FINDINGS = Depth.FINDINGS.value

_MANY = 64
"""Blocks of a program whose contours are solved together."""


@takes(ProgramKeywords)
def expand(
    text: str | Path,
    *,
    post: postprocess.PostName | postprocess.Post = "same",
    arcs: postprocess.ArcsName = "center",
    decimals: int | None = None,
    comments: bool = True,
    keep_going: bool = False,
    keep_untranslated: bool = False,
    block_numbers: postprocess.NumberingName = "first",
    inline: bool = False,
    formulas: bool = False,
    scratch: str | None = None,
    name: str = "<program>",
    **options: Unpack[ProgramKeywords],
) -> postprocess.Expansion:
    """A program with every contour written as plain G00, G01, G02 and G03, and everything else as it was.

    A control that is not programmed in G codes gets its own lines and arcs; for another target, all of its program is
    written in G codes.

    Args:
        text: the program, with its line ends, or the `Path` of its file, with the settings as for `solve`.
        post: the target: `same` (the control that the program is for), `linuxcnc` or `fanuc`, or one of your own.
        arcs: `center` (I J K) or `radius` (R).
        decimals: decimals of an end point; the target's own without. Centres and radii have at least those.
        comments: whether to keep the original blocks as comments.
        keep_going: whether to expand the other contours where one fails.
        keep_untranslated: whether to write what the target would run along another path (`summary.misread`).
        block_numbers: `first`: of the lines in the place of a block, the first one has its number; `all`: the others
            have numbers, too, which the program does not use.
        inline: whether to write out each call, jump and loop, with numbers for variables. `text` is None where one of
            them cannot be decided.
        formulas: whether contours whose words hold variables become formulas in the target's macro language; `post` may
            then be `haas`, `sinumerik` or `klartext`, too. Values of `variables` are examples.
        scratch: the variables in which formulas compute, such as `#140-#160`.
        control: and all others as for `solve`, with the same errors.

    >>> print(expand("G00 X40. Z0.\\nG111 X100. A180. K-30. B120. C5. F0.2").text)
    G00 X40. Z0.
    (G111 X100. A180. K-30. B120. C5. F0.2)
    G01 X40. Z-27.887 F0.2
    G01 X50. Z-32.887
    G01 X100. Z-47.321
    """
    text, name, told = _text(text, name, SolveOptions(**options))
    # Only this function needs them.
    from contoursolve.postprocess import (  # noqa: PLC0415
        Arcs,
        Expansion,
        ExpansionOptions,
        Numbering,
        find_post,
        rewrite,
    )

    if decimals is not None and (isinstance(decimals, bool) or decimals not in range(1, MOST_DECIMALS + 1)):
        raise ValueError(f"decimals cannot be {decimals!r}; choose 1 to {MOST_DECIMALS}, or None for the target's own")
    asked = told.request(name)
    writer = None
    if formulas:
        from contoursolve.postprocess import formulas_for, post_of_formulas  # noqa: PLC0415

        post = post_of_formulas(post)
        writer = formulas_for(text, post, scratch, told.variables or {}, asked.policy)
    numbering = choice_of(Numbering, block_numbers, "block_numbers")
    wish = ExpansionOptions(find_post(post), choice_of(Arcs, arcs, "arcs"), decimals, comments, numbering, inline)
    stated = {} if isinstance(told.control, Control) else stated_settings(gcode.split_lines(text))
    own = stated | dict(told.settings or {})
    source = file_in_memory(text, name)
    rewritten = rewrite(source, BytesIO(), wish, asked, control=told.control, settings=own, writer=writer)
    summary, written = rewritten.summary, b"".join(rewritten.pieces())
    is_whole = (keep_going or not summary.left) and not summary.has_end and (keep_untranslated or not summary.misread)
    return Expansion(written.decode(*ANY_TEXT) if is_whole else None, rewritten.control, summary)


@takes(ReadingKeywords)
def convert(
    text: str | Path,
    to: ControlName | Control,
    *,
    comments: bool = True,
    variables: Mapping[str, float] | None = None,
    folders: Iterable[str | Path] = (),
    name: str = "<program>",
    **options: Unpack[ReadingKeywords],
) -> postprocess.Conversion:
    """A whole program in another control's own words.

    Contours keep their corners and angles, as far as the other control has words for them; head, end, feeds, speeds,
    tools, offsets and comments are written as that control writes them. Calls, jumps and variables stay where the other
    control reads them alike. For others they are written out, with the values that they have.

    Args:
        text: the program, with its line ends, or the `Path` of its file, with the settings as for `solve`.
        to: the other control, such as `fanuc-lathe`, or its tables.
        comments: whether the blocks of contours that are written out are kept as comments.
        variables: as for `solve`.
        folders: as for `solve`.
        control: and all others as for `solve`, with the same errors.

    What has no counterpart stands in its place as a comment, and is listed in `not_converted`. The new program is read
    again as the other control reads it. `comparison` is that of both paths, without the blocks that are not converted.
    `text` is None where they are not the same.

    Raises ValueError if nothing tells for which control the program is. Raises it, too, if the target is not programmed
    in lines and arcs, or is for another kind of machine.

    >>> print(convert("G00 X40. Z0.\\nG111 X100. A180. K-30. B120. P5.", "fanuc-lathe", comments=False).text)
    G00 X40. Z0.
    G01 Z-30. ,R5.
    X100. ,A120.
    <BLANKLINE>
    """
    text, name, told = _text(text, name, SolveOptions(variables=variables, folders=folders, **options))
    # Only this function needs them.
    from contoursolve.postprocess import (  # noqa: PLC0415
        Conversion,
        ConversionError,
        Summary,
        convert_program,
        language_of,
        machine_of,
    )

    target = to if isinstance(to, Control) else configure(find_control(to), told.settings)
    if language_of(target) is None and target.writing is None:
        raise ConversionError(
            f"programs are not written in the words of {target.title} ({target.name}): its blocks are of another kind"
        )
    control = choose_alike(told.control, gcode.parse(text, name), told.request(name), told.settings)
    if control is None:
        raise ConversionError("nothing in the program tells for which control it is: state that with --control")
    target = for_kind(target, told.settings or {}, machine_of(control).value)
    if machine_of(control) is not machine_of(target):
        one, other = (f"{each.title} ({each.name}, a {machine_of(each).value})" for each in (control, target))
        switches = (each.name for each in (control, target) if any(one.name == "machine" for one in each.settings))
        advice = "".join(f"; for a lathe, set {name}.machine=lathe" for name in switches)
        raise ConversionError(f"a program is converted for the same kind of machine, not from {one} to {other}{advice}")
    asked = replace(told, strict=True, depth="verdict").request(name)
    found = convert_program(text, name, (control, target), asked, _CONVERTED_WITHIN, has_comments=comments)
    summary = Summary(
        replaced=found.in_words + len(found.written_out), in_words=found.in_words, written_out=[*found.written_out]
    )
    written = found.text and restate_control(found.text, target.name, target.modes.settings)
    if written is not None and "\r\n" in text:
        written = written.replace("\n", "\r\n")
    return Conversion(
        written, control.name, target.name, summary, found.comparison, found.left, found.notes, found.lines
    )


_CONVERTED_WITHIN = 0.002
"""mm. How far apart the paths of a program and of its conversion may be: end points are rounded to 0.001 mm, and a
corner between rounded lines moves a little more."""


def read_program(path: str | Path) -> Program:
    """Read a file of UTF-8 or Latin-1 text; `-` is standard input.

    Raises UnreadableProgramError if there is no such file, or it is not text.
    """
    check_type("path", path, str | PathLike, 'the name of a file, such as "part.nc"')
    name = str(path)
    text = decode(gcode.read_bytes(name, "a program file", gcode.MOST_OF_PROGRAM), name)
    return gcode.parse(text, "<standard input>" if name == STANDARD_INPUT else name)
