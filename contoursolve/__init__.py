"""contoursolve: why is this contour block refused, and where does it go?

It reads the contour blocks of CNC programs (Fanuc, Haas, Mitsubishi `,A ,C ,R`, HEIDENHAIN `FL FC`, SINUMERIK `ANG`,
ISG `#ANG`, NCT 99M, YASNAC LX3 `G111`), turns each into a small system of equations, and says what is missing, what is
said twice, and what the path is. Lengths are in mm, X of a lathe is a radius, angles are in degrees.

>>> import contoursolve
>>> result = contoursolve.solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.")
>>> [element.name for element in result.answers[0].contour.elements]
['line 1', 'corner 1', 'line 2', 'corner 2']
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from contoursolve.api import (
        UnreadableProgramError,
        check,
        check_file,
        convert,
        expand,
        parse,
        read_program,
        solve,
        solve_file,
        solve_program,
    )
    from contoursolve.controls import DIALECTS
    from contoursolve.diagnosis.additions import Addition, LegalBlock, legal_blocks, ways_to_complete, words_to_add
    from contoursolve.diagnosis.examine import Answer, Depth, Policy
    from contoursolve.diagnosis.solutions import Listing, list_solutions
    from contoursolve.diagnostics.extras import MissingExtraError
    from contoursolve.diagnostics.finding import Basis, Diagnosis, Diagnostic, Severity
    from contoursolve.families import (
        Family,
        FamilyError,
        Feasible,
        Found,
        Region,
        Sensitivity,
        Tolerances,
        family,
        feasible,
        find_word,
        region,
        sensitivity,
        tolerances,
    )
    from contoursolve.gcode import Block, Program, Word
    from contoursolve.notebook import explore
    from contoursolve.output.catalogue import rule_page
    from contoursolve.output.construction import construction_lines
    from contoursolve.output.contours import path_table
    from contoursolve.output.report import report_page
    from contoursolve.output.words import StatedWord, end_text, form_text, start_text, stated_words
    from contoursolve.postprocess.block_numbers import BlockNumber, Replacement, block_number_at, rename_block
    from contoursolve.postprocess.expansion_report import Conversion, Expansion
    from contoursolve.postprocess.formatting import format_program
    from contoursolve.program.open_program import OpenContour, OpenProgram
    from contoursolve.program.pipeline import Result
    from contoursolve.program.project import SettingError, find_settings
    from contoursolve.program.recognise import UnknownControlError
    from contoursolve.reading.dialect import Dialect
    from contoursolve.sketch import Drawings, Drawn, Sketch
    from contoursolve.solving import Status
    from contoursolve.solving.contour import ArcSegment, Contour, LineSegment
    from contoursolve.try_edits import Completion, completions, what_if

__version__ = "0.1.0"

__all__ = [
    "DIALECTS",
    "Addition",
    "Answer",
    "ArcSegment",
    "Basis",
    "Block",
    "BlockNumber",
    "Completion",
    "Contour",
    "Conversion",
    "Depth",
    "Diagnosis",
    "Diagnostic",
    "Dialect",
    "Drawings",
    "Drawn",
    "Expansion",
    "Family",
    "FamilyError",
    "Feasible",
    "Found",
    "LegalBlock",
    "LineSegment",
    "Listing",
    "MissingExtraError",
    "OpenContour",
    "OpenProgram",
    "Policy",
    "Program",
    "Region",
    "Replacement",
    "Result",
    "Sensitivity",
    "SettingError",
    "Severity",
    "Sketch",
    "StatedWord",
    "Status",
    "Tolerances",
    "UnknownControlError",
    "UnreadableProgramError",
    "Word",
    "block_number_at",
    "check",
    "check_file",
    "completions",
    "construction_lines",
    "convert",
    "end_text",
    "expand",
    "explore",
    "family",
    "feasible",
    "find_settings",
    "find_word",
    "form_text",
    "format_program",
    "legal_blocks",
    "list_solutions",
    "parse",
    "path_table",
    "read_program",
    "region",
    "rename_block",
    "report_page",
    "rule_page",
    "sensitivity",
    "solve",
    "solve_file",
    "solve_program",
    "start_text",
    "stated_words",
    "tolerances",
    "ways_to_complete",
    "what_if",
    "words_to_add",
]

_ROOMS = {
    "solving.contour": ("ArcSegment", "Contour", "LineSegment"),
    "diagnostics.finding": ("Basis", "Diagnosis", "Diagnostic", "Severity"),
    "controls": ("DIALECTS", "Dialect"),
    "diagnosis.examine": ("Answer", "Depth", "Policy"),
    "diagnosis.solutions": ("Listing", "list_solutions"),
    "diagnostics.extras": ("MissingExtraError",),
    "output.construction": ("construction_lines",),
    "postprocess.block_numbers": ("BlockNumber", "Replacement", "block_number_at", "rename_block"),
    "postprocess.expansion_report": ("Conversion", "Expansion"),
    "postprocess.formatting": ("format_program",),
    "families": (
        "Family",
        "FamilyError",
        "Feasible",
        "Found",
        "Region",
        "Sensitivity",
        "Tolerances",
        "family",
        "feasible",
        "find_word",
        "region",
        "sensitivity",
        "tolerances",
    ),
    "notebook": ("explore",),
    "program.open_program": ("OpenContour", "OpenProgram"),
    "program.pipeline": ("Result",),
    "program.recognise": ("UnknownControlError",),
    "sketch": ("Drawings", "Drawn", "Sketch"),
    "solving": ("Status",),
    "gcode": ("Block", "Program", "Word"),
    "diagnosis.additions": (
        "Addition",
        "LegalBlock",
        "legal_blocks",
        "words_to_add",
        "ways_to_complete",
    ),
    "output.catalogue": ("rule_page",),
    "output.contours": ("path_table",),
    "output.report": ("report_page",),
    "output.words": ("StatedWord", "end_text", "form_text", "start_text", "stated_words"),
    "program.project": (
        "SettingError",
        "find_settings",
    ),
    "try_edits": ("Completion", "completions", "what_if"),
}
"""Where the public names live; the others are in `api`."""

_PACKAGES = ("families", "pictures")
"""Rooms with public names of their own."""


def __getattr__(name: str) -> Any:
    """A public name, imported when it is first used: `import contoursolve` itself costs nothing."""
    if name in _PACKAGES:
        return import_module(f"{__name__}.{name}")
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    room = next((room for room, names in _ROOMS.items() if name in names), "api")
    value = getattr(import_module(f"{__name__}.{room}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*globals(), *_PACKAGES, *__all__]
