"""Pictures, files and pages of results; and the page of a rule."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

# What these rooms hold is imported when it is asked for, by `help` and `typing.get_type_hints`, too.
from contoursolve import families, output, pictures, sketches
from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import Answer, EquationSystem
from contoursolve.diagnostics import UserError, check_type, choice_of, did_you_mean, importing
from contoursolve.gcode import write_whole
from contoursolve.pictures import Picture, Theme
from contoursolve.program import Result, find_control
from contoursolve.reading import Control
from contoursolve.sketches import ContourSketch


def draw(
    record: Any,
    *,
    tool: Any = None,
    theme: Theme | str = "light",
    title: str | None = None,
    like: Picture | None = None,
    has_remarks: bool | None = None,
    is_whole: bool | None = None,
    words: tuple[str, str] | None = None,
    result: str | None = None,
) -> Picture:
    """The picture of a contour, a program, two programs, a family, a range, a system or a sketch.

    Args:
        record: an `Answer`, a `Result` or a `Comparison`; a `Family` over one or two words, a `FeasibleRange` or a
            `FeasibleRegion`; an `EquationSystem`, which has a matrix; a `Sketch`, its `Drawings` or one `Drawing`; a
            `ContourSketch`, or what its `solve()` gives.
        tool: the `ToolReport` of the tool that is drawn with contours; without it that of the result, if it has one.
        theme: `light`, `dark`, or `page` for a page of HTML, light or dark as its reader prefers.
        title: the title, in the place of the picture's own.
        like: of an answer, its picture before a word was moved: scale, origin and height stay, labels keep their sides.
        has_remarks: of an answer, whether the findings are written below.
        is_whole: of a program, whether turned parts have both halves; without it, where the contours stay at least half
            as large.
        words: of a family, the two words that go to the right and up.
        result: of a family or a region, the result that colours the contours, with lines of equal value: `"V2 Z"`,
            `"line 1.room"`, `"length"`.

    Returns:
        A `Picture`: it shows itself in a notebook, and has `.svg`, `.png()` and `.save(path)`.

    Raises TypeError for an option that the record does not have. Raises ValueError for a family that is no grid of one
    or two words, or a sketch without anything known. Raises FamilyError for a result that is none.

    >>> from contoursolve import solve
    >>> draw(solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").answer).title
    'G111 (taper multiple cornering), program line 1: solved'
    """
    theme = choice_of(Theme, theme, "theme") if isinstance(theme, str) else theme
    named: dict[str, Any] = {"title": title, "like": like, "has_remarks": has_remarks, "is_whole": is_whole}
    named |= {"words": words, "result": result}
    options = {name: value for name, value in named.items() if value is not None}
    if tool is not None and not isinstance(record, Answer | Result):
        raise TypeError(f"a picture of {type(record).__name__} has no option 'tool'; contours have it")
    if isinstance(record, ContourSketch):
        record = record.solve()
    if isinstance(record, sketches.SketchAnswer):
        found = sketches.draw_sketch(record, theme=theme, **options)
        if found is None:
            raise ValueError(f"nothing of the sketch can be drawn: {record.said}")
        return found
    tool = record.tool if tool is None and isinstance(record, Result) else tool
    if tool is not None:
        options["beside"] = output.beside_of(tool, record if isinstance(record, Answer) else None)
    return pictures.draw(record, theme=theme, **options)


def export(record: Any, path: str | Path, *, tool: Any = None, result: str | None = None) -> None:
    """Write a file by the ending of its name.

    * `.dxf`: the solved contours of a `Result` for CAD, with the path of its tool; needs `contoursolve[dxf]`.
    * `.json`: a `Result`, as `contoursolve solve --format json` prints it.
    * `.json`, `.smt2`: an `EquationSystem`, or several in a list, with their verdicts, or for a solver such as z3.
    * `.csv`, `.parquet`: the rows of a `Family`; Parquet needs `contoursolve[family]`.
    * `.html`: the page of a `Result` (see `report`), or the map of a `Family` over two words or of a `FeasibleRegion`:
      pointer and arrow keys choose values, and their contour is drawn. `result` colours the map, as for `draw`. It
      holds at most 800 contours, and 400 kB of them.

    `tool` is a `ToolReport`; without it that of the result, if it has one. Raises ValueError for a record that has no
    file of this ending, or nothing to write. It does so for a `tool` or a `result` that the file has no use for. Raises
    MissingExtraError without a package, and UserError where the file cannot be written.
    """
    check_type("path", path, str | Path)
    target, ending = Path(path), Path(path).suffix.lower()
    if isinstance(record, list | tuple) and record and all(isinstance(each, EquationSystem) for each in record):
        several, record = record, record[0]
    else:
        several = (record,)
    kinds = _FILES.get(ending)
    if kinds is None:
        raise ValueError(f"{target}: a file ends in {', '.join(_FILES)}; a picture has save()")
    if not isinstance(record, kinds):
        own = [each for each, kinds in _FILES.items() if isinstance(record, kinds)]
        told = f", but as {', '.join(own)}" if own else f"; that is for {', '.join(kind.__name__ for kind in kinds)}"
        raise ValueError(f"{target}: {type(record).__name__} is not written as {ending}{told}")
    if result is not None and (ending != ".html" or isinstance(record, Result)):
        raise ValueError(
            f"{target}: only the map of a family or a region is coloured by a result; leave out {result!r}"
        )
    if tool is not None and not isinstance(record, Result):
        raise ValueError(f"{target}: the file of a {type(record).__name__} has no tool; leave out tool")
    tool = record.tool if tool is None and isinstance(record, Result) else tool
    if isinstance(record, families.Family) and ending != ".html":
        (record.to_csv if ending == ".csv" else record.to_parquet)(target)
        return
    if isinstance(record, EquationSystem):
        text = output.to_smt(several) if ending == ".smt2" else output.systems_to_json(several)
        write_whole(target, (text.encode(),), keeps_backup=False)
        return
    write_whole(target, (_bytes_of(record, ending, tool, result),), keeps_backup=False)


_FILES: dict[str, tuple[type, ...]] = {
    ".dxf": (Result,),
    ".json": (Result, EquationSystem),
    ".smt2": (EquationSystem,),
    ".csv": (families.Family,),
    ".parquet": (families.Family,),
    ".html": (Result, families.Family, families.FeasibleRegion),
}
"""The records that are written as a file, by its ending."""


def _bytes_of(record: Any, ending: str, tool: Any, result: str | None) -> bytes:
    if ending == ".dxf":
        with importing("dxf", "a drawing for CAD"):
            drawing = output.drawing_for_cad(record, tool)
        if drawing is None:
            raise ValueError("no contour is solved: the drawing would be empty")
        return drawing[0]
    if ending == ".json":
        return f"{output.to_json(record, tool)}\n".encode()
    if isinstance(record, Result):
        return report(record, tool=tool).encode()
    return output.map_page(record, result, version=_version()).encode()


def report(result: Result, *, tool: Any = None, is_explained: bool = False) -> str:
    """The page of HTML about a result: its contours with pictures, words, paths and findings, and the program.

    With `is_explained`, equations and constructions, too. `tool` is a `ToolReport`; without it that of the result, if
    it has one.
    """
    check_type("result", result, Result)
    return "".join(output.report_page(result, _version(), is_explained=is_explained, tool=tool or result.tool))


def _version() -> str:
    try:
        return version("contoursolve")
    except PackageNotFoundError:  # it runs from its source
        return ""


def explain(code: str, control: str | Control | None = None) -> str:
    """A page of Markdown about a rule by its code (`g111-line-1`), or about all rules behind an alarm number.

    It says what is wrong and what to do, with wrong and right blocks and the place in the manual; of every control that
    has the rule, or of one. Raises UserError if none has it.

    >>> explain("g111-line-1").splitlines()[0]
    '# g111-line-1'
    """
    check_type("code", code, str)
    chosen = [control if isinstance(control, Control) else find_control(control)] if control else [*CONTROLS.values()]
    wanted = str(code).strip().lower()
    behind = {row.rule.code for row in output.alarm_rows(chosen) if row.is_called(wanted)}
    known = {rule.code for each in chosen for rule in each.catalogue}
    found = sorted({wanted} & known | behind & known)
    if not found:
        raise UserError(
            f"no rule has the code or the alarm {code!r}; {did_you_mean(wanted, sorted(known))}".rstrip("; ")
        )
    return "\n".join(output.rule_page(each, chosen) for each in found)
