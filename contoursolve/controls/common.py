"""The rows that all controls have in common: here those about contours, facts and references; those about blocks stand
in `block_rules`. Tables of every control are pickled as `pickled_tables` says."""

import copyreg
from typing import Any

from contoursolve.controls.block_rules import GRAMMAR_RULES, READING_RULES
from contoursolve.controls.control_settings import own_source
from contoursolve.controls.rule_rows import EVENTS, row
from contoursolve.diagnostics import Severity
from contoursolve.gcode import Syntax
from contoursolve.reading import Assumption, ContourForm, Control, Lexicon, Modes, ReadIssue, Rule, Setting

_GEOMETRY, _READING = own_source("the original equations"), own_source("modal state of a program")


SYSTEM_RULES = (
    row("words-missing", "{open}: {completions}", "or state a fact about it: `contoursolve facts` lists them",
        _GEOMETRY, ReadIssue.UNDERDETERMINED, {"contour": "{unfinished}"}),
    row("corner-twice", "{words} give {subject} two shapes at once", "keep one of them", _GEOMETRY,
        ReadIssue.CORNER_TWICE, {"more": " {other_corner}"}),
    row("corner-negative", "{words}: {subject} has a negative size, which no corner has", "delete the minus sign",
        _GEOMETRY, ReadIssue.CORNER_NEGATIVE, {"size": "-5."}),
    row("corner-nowhere", "{words}: {subject} needs the last line by its angle and one coordinate",
        "give the last line by its angle and one coordinate", _GEOMETRY, ReadIssue.CORNER_NOWHERE),
    row("cut-free", "{subject} cuts {what} in two: the path is the same wherever it lies; it is put in the middle",
        "nothing has to be changed; a coordinate or a length would say where it lies", _GEOMETRY, ReadIssue.CUT_FREE,
        severity=Severity.INFO),
    row("several-contours", like=EVENTS, source=_GEOMETRY,
        examples={"contour": "{asked}", "said": "contoursolve: length of {element} = 50"}),
    row("count-open", like=EVENTS, source=_GEOMETRY),
    row("only-unproven", like=EVENTS, source=_GEOMETRY),
    row("no-point", like=EVENTS, source=_GEOMETRY,
        examples={"contour": "{asked}", "said": "contoursolve: length of {element} = 3"}),
    row("search-unfinished", like=EVENTS, source=_GEOMETRY),
    row("facts-singular", "at these values {words} {do} not fix {free}",
        "replace one of them by a fact that tells the place, such as a coordinate or a length", _GEOMETRY,
        ReadIssue.FACTS_SINGULAR,
        {"contour": "{asked}", "across": "{level}", "said": "contoursolve: direction of {element} = {along}"}),
    row("asked-nothing", "{words} asks for something that is not part of the contour",
        "write a number, or delete it; ? can stand after {allowed}", own_source("words whose value is asked for"),
        ReadIssue.ASKED_NOTHING, {"more": " F?"}),
    row("start-units", "the start point was read in {was}, the contour is in {unit}",
        'if the start point is in {unit}, too, write --start "{code} {start}"', _READING, ReadIssue.START_UNITS,
        {"start": "{in_inches}", "options": '--start "{stated_start}"'}, severity=Severity.INFO),
    row("start-diameter", "X of the start point was read as {was}; in the contour X is {now}",
        'if the start point is meant so, too, write --start "{code} {start}"', _READING, ReadIssue.START_DIAMETER,
        severity=Severity.WARNING),
    row("fact-unmarked", "this comment looks like a fact, but is read as an ordinary comment", "write {fact}",
        own_source("facts about a contour"), ReadIssue.FACT_UNMARKED,
        {"more": " {comment}", "said": "contoursolve length of {element} = 30"}, severity=Severity.WARNING),
    row("fact-beyond", "{words} holds at {place}, where {element} is not cut: such a fact is about its whole {whole}",
        "nothing to do if that is meant; else state a fact about the part that is cut",
        own_source("facts about a contour"), ReadIssue.FACT_BEYOND,
        {"more": " {comment}", "said": "contoursolve: line 2 passes through {beyond}"}, severity=Severity.INFO),
    row("fact-unreadable", "the fact cannot be read: {reason}", "see `contoursolve facts` for what can be stated",
        own_source("grammar of a fact"), ReadIssue.FACT_UNREADABLE,
        {"more": " {comment}", "said": "contoursolve: length of line 99 = 20"}),
    row("trusted-absent", "{named} cannot be trusted: {reason}",
        "name a word as it stands there, such as (contoursolve trust: Z-50.)",
        own_source("words that are named for contoursolve"), ReadIssue.TRUSTED_ABSENT,
        {"more": " {comment}", "said": "contoursolve trust: X777."}),
    row("reference-met", "{named} is met: the contour has {there} at {where}", "nothing to do",
        own_source("words that are named for contoursolve"), ReadIssue.REFERENCE_MET,
        {"behind": " {comment}", "said": "contoursolve reference: {end_word}"}, severity=Severity.INFO),
    row("reference-missed", "{named} is {off} from the contour, which has {there} at {where}",
        "compare both with the drawing", own_source("words that are named for contoursolve"),
        ReadIssue.REFERENCE_MISSED, {"behind": " {comment}", "said": "contoursolve reference: {missed}"},
        severity=Severity.WARNING),
    row("reference-unused", "{named} was not compared: {reason}",
        "name a coordinate beside the block that ends there, such as (contoursolve reference: Z-50.)",
        own_source("words that are named for contoursolve"), ReadIssue.REFERENCE_UNUSED,
        {"more": " {comment}", "said": "contoursolve reference: {corner}{size}"}, severity=Severity.WARNING),
    row("fact-nowhere", "this fact stands in no contour block, and is not used",
        "write the comment into the block of the contour that it is about", own_source("facts about a contour"),
        ReadIssue.FACT_NOWHERE, {"between": "{comment}\n", "said": "contoursolve: length of {element} = 30"},
        severity=Severity.WARNING),
    row("fact-impossible", "{words} says nothing about this contour: {reason}",
        "see `contoursolve facts` for what can be stated", own_source("facts about a contour"),
        ReadIssue.FACT_IMPOSSIBLE, {"more": " {comment}", "said": "contoursolve: radius of {element} = 20"}),
    row("words-conflict", like=EVENTS, source=_GEOMETRY,
        examples={"more": " {comment}", "said": "contoursolve: direction of {element} = 10"}),
    row("fact-conflict", like=EVENTS, source=_GEOMETRY,
        examples={"more": " {comment}", "said": "contoursolve: {element} passes through {beside}"}),
    row("words-redundant", like=EVENTS, source=_GEOMETRY,
        examples={"more": " {comment}", "said": "contoursolve: {repetition}"}),
    row("not-verified", like=EVENTS, source=_GEOMETRY),
    row("out-of-range", like=EVENTS, source=_GEOMETRY,
        examples={"contour": "{asked}", "said": "contoursolve: direction of {element} = {nearly_along}"}),
    row("contour-sensitive", like=EVENTS, source=_GEOMETRY),
    row("axis-crossed", "{subject} crosses the spindle axis: it goes from {start} to {place}",
        "look for a lost sign or a wrong angle; nothing to do if the tool is meant to pass the centre", _GEOMETRY,
        ReadIssue.AXIS_CROSSED, {"turn": "{beyond_axis}"}, severity=Severity.WARNING),
    row("line-vanishes", like=EVENTS, source=_GEOMETRY,
        examples={"contour": "{vertex_blocks}", "closing": "{closing_on}", "closing_end": "{end_on}"}),
)  # fmt: skip

COMMON_RULES = GRAMMAR_RULES + READING_RULES + SYSTEM_RULES
"""Their examples are made in the words of each control (see `own_words`)."""


def _reduced(table: Any) -> Any:
    from contoursolve.controls.pickled_tables import reduced  # noqa: PLC0415 - few programs are sent elsewhere

    return reduced(table)


for _kind in (Control, Modes, Lexicon, Syntax, ContourForm, Assumption, Setting, Rule):
    copyreg.pickle(_kind, _reduced)
