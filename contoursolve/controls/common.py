"""The rows that all controls have in common: here those about contours, facts and references; those about blocks stand
in `block_rules`."""

from collections.abc import Mapping

from contoursolve.controls.block_rules import GRAMMAR_RULES, READING_RULES
from contoursolve.controls.control_settings import own_source
from contoursolve.diagnostics import Severity, Source
from contoursolve.reading import ReadIssue, Rule
from contoursolve.solving import event_of

_GEOMETRY, _READING = own_source("the original equations"), own_source("modal state of a program")


def about_event(code: str, source: Source, slip: Mapping[str, str] | None = None) -> Rule:
    """The row about the geometric event that the end of a code names, as every control tells it."""
    kind = event_of(code)
    event = kind.event
    return Rule(code, event.message, event.help, source, about=kind, severity=event.severity, slip=slip or {})


SYSTEM_RULES = (
    Rule(
        code="words-missing",
        message="{open}: {completions}",
        help="or state a fact about it: `contoursolve facts` lists them",
        source=_GEOMETRY,
        about=ReadIssue.UNDERDETERMINED,
        slip={"contour": "{unfinished}"},
    ),
    Rule(
        code="corner-twice",
        message="{words} give {subject} two shapes at once",
        help="keep one of them",
        source=_GEOMETRY,
        about=ReadIssue.CORNER_TWICE,
        slip={"more": " {other_corner}"},
    ),
    Rule(
        code="corner-negative",
        message="{words}: {subject} has a negative size, which no corner has",
        help="delete the minus sign",
        source=_GEOMETRY,
        about=ReadIssue.CORNER_NEGATIVE,
        slip={"size": "-5."},
    ),
    Rule(
        code="corner-nowhere",
        message="{words}: {subject} needs the last line by its angle and one coordinate",
        help="give the last line by its angle and one coordinate",
        source=_GEOMETRY,
        about=ReadIssue.CORNER_NOWHERE,
    ),
    Rule(
        code="cut-free",
        message="{subject} cuts {what} in two: the path is the same wherever it lies; it is put in the middle",
        help="nothing has to be changed; a coordinate or a length would say where it lies",
        source=_GEOMETRY,
        about=ReadIssue.CUT_FREE,
        severity=Severity.INFO,
    ),
    about_event(
        "several-contours", _GEOMETRY, {"contour": "{asked}", "said": "contoursolve: length of {element} = 50"}
    ),
    about_event("count-open", _GEOMETRY),
    about_event("only-unproven", _GEOMETRY),
    about_event("no-point", _GEOMETRY, {"contour": "{asked}", "said": "contoursolve: length of {element} = 3"}),
    about_event("search-unfinished", _GEOMETRY),
    Rule(
        code="facts-singular",
        message="at these values {words} {do} not fix {free}",
        help="replace one of them by a fact that tells the place, such as a coordinate or a length",
        source=_GEOMETRY,
        about=ReadIssue.FACTS_SINGULAR,
        slip={"contour": "{asked}", "across": "{level}", "said": "contoursolve: direction of {element} = {along}"},
    ),
    Rule(
        code="asked-nothing",
        message="{words} asks for something that is not part of the contour",
        help="write a number, or delete it; ? can stand after {allowed}",
        source=own_source("words whose value is asked for"),
        about=ReadIssue.ASKED_NOTHING,
        slip={"more": " F?"},
    ),
    Rule(
        code="start-units",
        message="the start point was read in {was}, the contour is in {unit}",
        help='if the start point is in {unit}, too, write --start "{code} {start}"',
        source=_READING,
        about=ReadIssue.START_UNITS,
        severity=Severity.INFO,
        slip={"start": "{in_inches}", "options": '--start "{stated_start}"'},
    ),
    Rule(
        code="start-diameter",
        message="X of the start point was read as {was}; in the contour X is {now}",
        help='if the start point is meant so, too, write --start "{code} {start}"',
        source=_READING,
        about=ReadIssue.START_DIAMETER,
        severity=Severity.WARNING,
    ),
    Rule(
        code="fact-unmarked",
        message="this comment looks like a fact, but is read as an ordinary comment",
        help="write {fact}",
        source=own_source("facts about a contour"),
        about=ReadIssue.FACT_UNMARKED,
        severity=Severity.WARNING,
        slip={"more": " {comment}", "said": "contoursolve length of {element} = 30"},
    ),
    Rule(
        code="fact-beyond",
        message="{words} holds at {place}, where {element} is not cut: such a fact is about its whole {whole}",
        help="nothing to do if that is meant; else state a fact about the part that is cut",
        source=own_source("facts about a contour"),
        about=ReadIssue.FACT_BEYOND,
        severity=Severity.INFO,
        slip={"more": " {comment}", "said": "contoursolve: line 2 passes through {beyond}"},
    ),
    Rule(
        code="fact-unreadable",
        message="the fact cannot be read: {reason}",
        help="see `contoursolve facts` for what can be stated",
        source=own_source("grammar of a fact"),
        about=ReadIssue.FACT_UNREADABLE,
        slip={"more": " {comment}", "said": "contoursolve: length of line 99 = 20"},
    ),
    Rule(
        code="trusted-absent",
        message="{named} cannot be trusted: {reason}",
        help="name a word as it stands there, such as (contoursolve trust: Z-50.)",
        source=own_source("words that are named for contoursolve"),
        about=ReadIssue.TRUSTED_ABSENT,
        slip={"more": " {comment}", "said": "contoursolve trust: X777."},
    ),
    Rule(
        code="reference-met",
        message="{named} is met: the contour has {there} at {where}",
        help="nothing to do",
        source=own_source("words that are named for contoursolve"),
        about=ReadIssue.REFERENCE_MET,
        severity=Severity.INFO,
        slip={"behind": " {comment}", "said": "contoursolve reference: {end_word}"},
    ),
    Rule(
        code="reference-missed",
        message="{named} is {off} from the contour, which has {there} at {where}",
        help="compare both with the drawing",
        source=own_source("words that are named for contoursolve"),
        about=ReadIssue.REFERENCE_MISSED,
        severity=Severity.WARNING,
        slip={"behind": " {comment}", "said": "contoursolve reference: {missed}"},
    ),
    Rule(
        code="reference-unused",
        message="{named} was not compared: {reason}",
        help="name a coordinate beside the block that ends there, such as (contoursolve reference: Z-50.)",
        source=own_source("words that are named for contoursolve"),
        about=ReadIssue.REFERENCE_UNUSED,
        severity=Severity.WARNING,
        slip={"more": " {comment}", "said": "contoursolve reference: {corner}{size}"},
    ),
    Rule(
        code="fact-nowhere",
        message="this fact stands in no contour block, and is not used",
        help="write the comment into the block of the contour that it is about",
        source=own_source("facts about a contour"),
        about=ReadIssue.FACT_NOWHERE,
        severity=Severity.WARNING,
        slip={"between": "{comment}\n", "said": "contoursolve: length of {element} = 30"},
    ),
    Rule(
        code="fact-impossible",
        message="{words} says nothing about this contour: {reason}",
        help="see `contoursolve facts` for what can be stated",
        source=own_source("facts about a contour"),
        about=ReadIssue.FACT_IMPOSSIBLE,
        slip={"more": " {comment}", "said": "contoursolve: radius of {element} = 20"},
    ),
    about_event(
        "words-conflict", _GEOMETRY, {"more": " {comment}", "said": "contoursolve: direction of {element} = 10"}
    ),
    about_event(
        "fact-conflict", _GEOMETRY, {"more": " {comment}", "said": "contoursolve: {element} passes through {beside}"}
    ),
    about_event("words-redundant", _GEOMETRY, {"more": " {comment}", "said": "contoursolve: {repetition}"}),
    about_event("not-verified", _GEOMETRY),
    about_event(
        "out-of-range",
        _GEOMETRY,
        {"contour": "{asked}", "said": "contoursolve: direction of {element} = {nearly_along}"},
    ),
    about_event("contour-sensitive", _GEOMETRY),
    Rule(
        code="axis-crossed",
        message="{subject} crosses the spindle axis: it goes from {start} to {place}",
        help="look for a lost sign or a wrong angle; nothing to do if the tool is meant to pass the centre",
        source=_GEOMETRY,
        about=ReadIssue.AXIS_CROSSED,
        severity=Severity.WARNING,
        slip={"turn": "{beyond_axis}"},
    ),
    about_event(
        "line-vanishes", _GEOMETRY, {"contour": "{vertex_blocks}", "closing": "{closing_on}", "closing_end": "{end_on}"}
    ),
)

COMMON_RULES = GRAMMAR_RULES + READING_RULES + SYSTEM_RULES
"""Their examples are made in the words of each control (see `own_words`)."""
