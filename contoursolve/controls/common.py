"""The rows that all controls have in common: here those about contours, facts and references; those about blocks stand
in `block_rules`."""

from contoursolve.controls.block_rules import GRAMMAR_RULES, READING_RULES
from contoursolve.controls.control_settings import own_source
from contoursolve.diagnostics import Severity, Source
from contoursolve.reading import ReadIssue, Rule
from contoursolve.solving import event_of

_GOOD = "G00 X40. Z0.\nG111 A180. K-30. B120. X100."
_CUT = "0 BEGIN PGM A MM\n1 L X+0 Y+0" + "\n2 FL X+0 Y+20\n3 FL Y+20\n4 FL X+50 Y+20" + "\n5 END PGM A MM"
_START = "G00 X40. Z0.\n"

_GEOMETRY, _READING = own_source("the original equations"), own_source("modal state of a program")


def about_event(code: str, source: Source, accepted: tuple[str, ...], rejected: tuple[str, ...]) -> Rule:
    """The row about the geometric event that the end of a code names, as every control tells it."""
    kind = event_of(code)
    event = kind.event
    return Rule(code, event.message, event.help, source, accepted, rejected, about=kind, severity=event.severity)


SYSTEM_RULES = (
    Rule(
        code="words-missing",
        message="{open}: {completions}",
        help="or state a fact about it: `contoursolve facts` lists them",
        source=_GEOMETRY,
        about=ReadIssue.UNDERDETERMINED,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. B120. X100.",),
    ),
    Rule(
        code="corner-twice",
        message="{words} give {subject} two shapes at once",
        help="keep one of them",
        source=_GEOMETRY,
        about=ReadIssue.CORNER_TWICE,
        accepted=(_GOOD + " C2.",),
        rejected=(_GOOD + " C2. P2.",),
    ),
    Rule(
        code="corner-negative",
        message="{words}: {subject} has a negative size, which no corner has",
        help="delete the minus sign",
        source=_GEOMETRY,
        about=ReadIssue.CORNER_NEGATIVE,
        accepted=(_GOOD + " P2.",),
        rejected=(_GOOD + " P-2.",),
    ),
    Rule(
        code="corner-nowhere",
        message="{words}: {subject} needs the last line by its angle and one coordinate",
        help="give the last line by its angle and one coordinate",
        source=_GEOMETRY,
        about=ReadIssue.CORNER_NOWHERE,
        accepted=(_GOOD + " D2.",),
        rejected=(_START + "G111 A180. K-30. X100. Z-47. D2.",),
    ),
    Rule(
        code="cut-free",
        message="{subject} cuts {what} in two: the path is the same wherever it lies; it is put in the middle",
        help="nothing has to be changed; a coordinate or a length would say where it lies",
        source=_GEOMETRY,
        about=ReadIssue.CUT_FREE,
        severity=Severity.INFO,
        accepted=(_CUT.replace("3 FL", "3 FL X+20"),),
        rejected=(_CUT,),
    ),
    about_event(
        "several-contours",
        _GEOMETRY,
        ("G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1",),
        (_START + "G111 X100. Z-47. B120. (contoursolve: length of line 1 = 30)",),
    ),
    about_event("count-open", _GEOMETRY, (_GOOD,), ()),
    about_event("only-unproven", _GEOMETRY, (_GOOD,), ()),
    about_event(
        "no-point", _GEOMETRY, (_GOOD,), (_START + "G111 X100. Z-47. B120. (contoursolve: length of line 1 = 3)",)
    ),
    about_event("search-unfinished", _GEOMETRY, (_GOOD,), ()),
    Rule(
        code="facts-singular",
        message="at these values {words} {do} not fix {free}",
        help="replace one of them by a fact that tells the place, such as a coordinate or a length",
        source=_GEOMETRY,
        about=ReadIssue.FACTS_SINGULAR,
        accepted=(_GOOD,),
        rejected=(_START + "G111 I0 B120. X100. (contoursolve: direction of line 1 = 180)",),
    ),
    Rule(
        code="asked-nothing",
        message="{words} asks for something that is not part of the contour",
        help="write a number, or delete it; ? can stand after {allowed}",
        source=own_source("words whose value is asked for"),
        about=ReadIssue.ASKED_NOTHING,
        accepted=(_START + "G111 A180. K-30. B120. X100. P? (contoursolve: straight part of line 1 = 25)",),
        rejected=(_START + "G111 A180. K-30. B120. X100. F?", _START + "G111 A180. K-30. B120. X100. M?"),
    ),
    Rule(
        code="start-units",
        message="the start point was read in {was}, the contour is in {unit}",
        help='if the start point is in {unit}, too, write --start "{code} {start}"',
        source=_READING,
        about=ReadIssue.START_UNITS,
        severity=Severity.INFO,
        accepted=("G20 G00 X2. Z0.\nG111 A180. K-1. B120. X4.",),
        rejected=(),
    ),
    Rule(
        code="start-diameter",
        message="X of the start point was read as {was}; in the contour X is {now}",
        help='if the start point is meant so, too, write --start "{code} {start}"',
        source=_READING,
        about=ReadIssue.START_DIAMETER,
        severity=Severity.WARNING,
        accepted=("G18 DIAMON G0 X20 Z0\nG1 X40 RND=2\nZ-50",),
        rejected=(),
    ),
    Rule(
        code="fact-unmarked",
        message="this comment looks like a fact, but is read as an ordinary comment",
        help="write {fact}",
        source=own_source("facts about a contour"),
        about=ReadIssue.FACT_UNMARKED,
        severity=Severity.WARNING,
        accepted=(
            _START + "G111 A180. K-30. B120. (CONTOURSOLVE: length of line 2 = 20)",
            _GOOD + " (contoursolve 0.1)",
        ),
        rejected=(_GOOD + " (contoursolve length of line 1 = 30)", _GOOD + " ;contoursolve: length of line 1 = 30"),
    ),
    Rule(
        code="fact-beyond",
        message="{words} holds at {place}, where {element} is not cut: such a fact is about its whole {whole}",
        help="nothing to do if that is meant; else state a fact about the part that is cut",
        source=own_source("facts about a contour"),
        about=ReadIssue.FACT_BEYOND,
        severity=Severity.INFO,
        accepted=(_START + "G111 A180. K-30. X100. (contoursolve: line 2 passes through [Z-40. X80.])",),
        rejected=(_START + "G111 A180. K-30. X100. (contoursolve: line 2 passes through [Z-60. X160.])",),
    ),
    Rule(
        code="fact-unreadable",
        message="the fact cannot be read: {reason}",
        help="see `contoursolve facts` for what can be stated",
        source=own_source("grammar of a fact"),
        about=ReadIssue.FACT_UNREADABLE,
        accepted=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",),
        rejected=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 9 = 20)",),
    ),
    Rule(
        code="trusted-absent",
        message="{named} cannot be trusted: {reason}",
        help="name a word as it stands there, such as (contoursolve trust: Z-50.)",
        source=own_source("words that are named for contoursolve"),
        about=ReadIssue.TRUSTED_ABSENT,
        accepted=(_GOOD + " (contoursolve trust: A180.)",),
        rejected=(_GOOD + " (contoursolve trust: A18.)", "(contoursolve trust: Z-7.)\n" + _GOOD),
    ),
    Rule(
        code="reference-met",
        message="{named} is met: the contour has {there} at {where}",
        help="nothing to do",
        source=own_source("words that are named for contoursolve"),
        about=ReadIssue.REFERENCE_MET,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=(_GOOD + " (contoursolve reference: X100.)", "(contoursolve reference: X100.)\n" + _GOOD),
    ),
    Rule(
        code="reference-missed",
        message="{named} is {off} from the contour, which has {there} at {where}",
        help="compare both with the drawing",
        source=own_source("words that are named for contoursolve"),
        about=ReadIssue.REFERENCE_MISSED,
        severity=Severity.WARNING,
        accepted=(_GOOD + " (contoursolve reference: X100.)",),
        rejected=(_GOOD + " (contoursolve reference: Z-47.3)",),
    ),
    Rule(
        code="reference-unused",
        message="{named} was not compared: {reason}",
        help="name a coordinate beside the block that ends there, such as (contoursolve reference: Z-50.)",
        source=own_source("words that are named for contoursolve"),
        about=ReadIssue.REFERENCE_UNUSED,
        severity=Severity.WARNING,
        accepted=(_GOOD + " (contoursolve reference: X100.)",),
        rejected=(
            _GOOD + " (contoursolve reference: A180.)",
            "(contoursolve reference: Z-7.)\n" + _GOOD + "\n" + _GOOD,
        ),
    ),
    Rule(
        code="fact-nowhere",
        message="this fact stands in no contour block, and is not used",
        help="write the comment into the block of the contour that it is about",
        source=own_source("facts about a contour"),
        about=ReadIssue.FACT_NOWHERE,
        severity=Severity.WARNING,
        accepted=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",),
        rejected=(_START + "(contoursolve: length of line 2 = 20)\n" + _GOOD.partition("\n")[2],),
    ),
    Rule(
        code="fact-impossible",
        message="{words} says nothing about this contour: {reason}",
        help="see `contoursolve facts` for what can be stated",
        source=own_source("facts about a contour"),
        about=ReadIssue.FACT_IMPOSSIBLE,
        accepted=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",),
        rejected=(_START + "G111 A180. K-30. B120. (contoursolve: radius of line 2 = 20)",),
    ),
    about_event("words-conflict", _GEOMETRY, (_GOOD,), (_GOOD + " U50.",)),
    about_event("fact-conflict", _GEOMETRY, (_GOOD,), (_GOOD + " (contoursolve: line 2 passes through [Z-40. X80.])",)),
    about_event("words-redundant", _GEOMETRY, (_GOOD,), (_GOOD + " U60.",)),
    about_event("not-verified", _GEOMETRY, (_GOOD,), ()),
    about_event("out-of-range", _GEOMETRY, (_GOOD,), ("G00 X40. Z0.\nG111 A180. K-10. B179.9999999999 X41.",)),
    about_event(
        "contour-sensitive",
        _GEOMETRY,
        (_GOOD,),
        ("G17 G41 G0 X5000 Y0\nG3 I-5000 J0\nG1 X-6000 Y4999.9999999999 ,A180 Q-1",),
    ),
    Rule(
        code="axis-crossed",
        message="{subject} crosses the spindle axis: it goes from {start} to {place}",
        help="look for a lost sign or a wrong angle; nothing to do if the tool is meant to pass the centre",
        source=_GEOMETRY,
        about=ReadIssue.AXIS_CROSSED,
        severity=Severity.WARNING,
        accepted=(_GOOD, "G00 X-40. Z0.\nG111 A180. K-30. B-120. X-100.", "G00 X40. Z0.\nG111 A270. I-20. X0 Z-5."),
        rejected=(
            "G00 X26.193 Z-11.645\nG111 I1.766 Z-4.662 A90. B-66.607",
            "G00 X-40. Z0.\nG111 A180. K-30. B120. X100.",
            "G00 X0 Z0.\nG111 A60. I10. B-45. Z30.",
        ),
    ),
    about_event("line-vanishes", _GEOMETRY, (_GOOD,), (_START + "G111 I0 K0 B120. X100.",)),
)

COMMON_RULES = GRAMMAR_RULES + READING_RULES + SYSTEM_RULES
"""Examples of common rows are programs for the control that their words show."""
