"""What holds for every control: the rows of the catalogue about characters, words, positions, geometry; settings."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from decimal import Decimal
from typing import Any

from contoursolve.diagnostics.finding import Severity
from contoursolve.diagnostics.source import OWN, Evidence, Source
from contoursolve.gcode import FaultKind
from contoursolve.reading import ReadIssue, Setting, WithoutPoint
from contoursolve.reading.dialect import Dialect
from contoursolve.reading.rules import row
from contoursolve.solving import NoteKind, RefusalKind

_GOOD = "G00 X40. Z0.\nG111 A180. K-30. B120. X100."
_START = "G00 X40. Z0.\n"
_PROFILE = (
    "G00 X140. Z2.\nG71 P10 Q20 U.4 W.1 F.2\nN10 G00 X40.\nG01 Z0.\n"
    "G111 A180. K-30. B120. X100.\nN20 G01 {}\nG70 P10 Q20"
)
_CALLING = "G00 X40. Z0.\nM98 P100\n{}\nM98 P100\nM30\nO0100\nG111 A180. K-30. B120. X100.\nM99"


def _own(place: str) -> Source:
    return Source(OWN, place, Evidence.ASSUMED)


def setting(
    name: str,
    meaning: str,
    values: Mapping[str, str],
    source: Source,
    changes: Mapping[str, Callable[[Any], Any]] | None = None,
) -> Setting:
    """One whose first value is in force unless told otherwise."""
    return Setting(name, meaning, values, next(iter(values)), source, changes=changes or {})


def number_setting(values: Mapping[str, str], source: Source) -> Setting:
    """What numbers without a point are, `increment` or `calculator`; the first of them is in force."""
    changes = {"increment": _reading(WithoutPoint.LEAST_INCREMENTS), "calculator": _reading(WithoutPoint.AS_WRITTEN)}
    return setting("number", "what a number without a decimal point means", values, source, changes)


def _reading(meant: WithoutPoint) -> Callable[[Dialect], Dialect]:
    """From a control to the one for which a number without a point means this."""

    def change(dialect: Dialect) -> Dialect:
        lexicon = dialect.modes.lexicon
        words = replace(lexicon, numbers=replace(lexicon.numbers, without_point=meant))
        return replace(dialect, modes=replace(dialect.modes, lexicon=words))

    return change


def first_motion_setting(source: Source) -> Setting:
    """Which motion is in force before the program states one; its samples rely on G1."""
    return setting(
        "first-motion",
        "which motion is in force before the program states one",
        {"G1": "lines by G1", "none": "none: the program must state it"},
        source,
        changes={"none": lambda dialect: replace(dialect, motion=None)},
    )


def angle_sense_setting(source: Source, name: str = "angle-sense", line: str = "a line") -> Setting:
    """Whether lines must run as their angles say."""
    return setting(
        name,
        f"whether {line} may run against its angle",
        {
            "line": "it may: the angle is that of the line, either way",
            "ray": "it may not: the angle is the direction of travel",
        },
        source,
    )


def arc_chamfer_setting(what: str, source: Source, corner: str = "corner") -> Setting:
    """How the size of a chamfer is measured on an arc."""
    values = {
        "chord": f"straight from the {corner}",
        "arc_length": "along the arc; contoursolve does not compute this",
    }
    return setting("chamfer-on-arc", f"how {what} is measured on an arc", values, source)


def length_setting(name: str, meaning: str, default: str, source: Source, most: int = 1) -> Setting:
    """One whose value is a number of mm, up to so many."""
    return Setting(name, meaning, {default: "mm"}, default, source, bounds=(Decimal("0.001"), Decimal(most)))


_GRAMMAR = _own("grammar of a word: an address and a number")
_READING = _own("modal state of a program")
_GEOMETRY = _own("the original equations")

GRAMMAR_RULES = (
    row("number-missing", "{words} has no number", "write the value after the address; a zero must be written, too",
        _GRAMMAR, FaultKind.NUMBER_MISSING, _GOOD, _START + "G111 A180. K B120. X100.",
        _START + "G111 A180. KNaN B120. X100."),
    row("number-malformed", "{words} is not a number that a control reads",
        "write digits with at most one decimal point, without exponent or decimal comma",
        _GRAMMAR, FaultKind.NUMBER_MALFORMED, (_GOOD, _START + "G111 A180. K-.5 B+120. X100."),
        _START + "G111 A180. K-1.2.3 B120. X100.", _START + "G111 A180. K-30,5 B120. X100."),
    row("number-too-long", "{words} has more digits than any control reads", "write at most 8 digits",
        _own("at most 32 characters a number, 20 of them before its point"), FaultKind.NUMBER_TOO_LONG, _GOOD,
        _START + "G111 A180. K-30.0000000000000000000000000000000000 B120. X100."),
    row("value-too-large", "{words} is larger than a control can travel",
        "check the decimal point; the limit is {limit}",
        _own("at most 1,000,000 mm or degrees"), ReadIssue.VALUE_TOO_LARGE, _GOOD,
        _START + "G111 A180. K-30. B120. X10000000000."),
    row("comma-without-address", "the comma in {words} stands before no address",
        "write the address right after the comma (,A ,C ,R), or a point for a decimal",
        _GRAMMAR, FaultKind.COMMA_WITHOUT_ADDRESS, _GOOD, _START + "G111 A180. K-30. B120. X100. ,"),
    row("stray-character", "{words} is not part of any word", "delete it, or put it into a comment in parentheses",
        _GRAMMAR, FaultKind.STRAY_CHARACTER, _GOOD, _START + "G111 A180. K-30. $ B120. X100."),
    row("comment-not-closed", "a comment begins here and does not end on its line", "close it with )",
        _own("grammar of a comment: ( to ), or ; to the end of the line"), FaultKind.COMMENT_NOT_CLOSED,
        _GOOD + " (finish)", _GOOD + " (finish", severity=Severity.WARNING),
    row("block-too-long", "the block has {words} and was not read",
        "check that this is an NC program; a block has at most 2,000 characters",
        _own("at most 2,000 characters a block"), FaultKind.BLOCK_TOO_LONG, _GOOD, _START + "G111" + " A180." * 400),
)  # fmt: skip

READING_RULES = (
    row("address-repeated", "{words}: {address} is given twice in one block", "keep one of them",
        _READING, ReadIssue.REPEATED_ADDRESS, _GOOD, _START + "G111 A10. A20. K-30. B120. X100."),
    row("address-unknown", "{words}: the address {address} has no meaning in this contour ({form})",
        "{advice}; such a contour is written with {allowed}",
        _READING, ReadIssue.UNKNOWN_ADDRESS, _GOOD, _START + "G111 A180. K-30. B120. X100. R5."),
    row("comma-word-unknown", "{words}: this control has no {address}; it stops there, or leaves the word out",
        "name the control by --control, if it is another one; else write out what the word means",
        _READING, ReadIssue.COMMA_WORD_UNKNOWN, _GOOD, _GOOD + "\nG01 X120. ,A30.", severity=Severity.WARNING),
    row("word-mistyped", "{words}: this control has no word {address}, so the block is read without it",
        "write {meant} if that is meant",
        _READING, ReadIssue.WORD_MISTYPED, "G17 G90 G0 X0 Y0\nG1 X30 RND=5\nY40",
        "G17 G90 G0 X0 Y0\nG1 X30 RND=5\nY40\nG1 X50 AGN=5", severity=Severity.WARNING),
    row("letter-for-digit",
        "{words} has a letter where a digit seems to be meant: with {meant} this block would be a contour",
        "write {meant} if that is meant",
        _GRAMMAR, ReadIssue.LETTER_FOR_DIGIT, _GOOD, _GOOD + "\nG1l1 A180. B120. X160. Z-80.",
        severity=Severity.WARNING),
    row("code-mistyped", "{words} is no code that is known here: with {meant} this block would be a contour",
        "write {meant} if that is meant",
        _READING, ReadIssue.CODE_MISTYPED, _GOOD, _GOOD + "\nG110 A180. B120. X160. Z-80.", severity=Severity.WARNING),
    row("value-variable", "{words} {depend} on a variable, whose value is not known here",
        'write the number, or state the value: --let "#100=95."',
        _READING, ReadIssue.VARIABLE, _GOOD, _START + "G111 A180. K#101 B120. X100."),
    row("word-unused", "{words} has no part in this contour ({form}), which was solved without it",
        "delete it, or write it in a block of its own",
        _READING, ReadIssue.WORD_UNUSED, _GOOD, severity=Severity.WARNING),
    row("point-missing", "{words} {have} no decimal point and {are} read as {actual}",
        "write the point where the number means what it says",
        _READING, ReadIssue.POINT_MISSING, (_GOOD, _START + "G111 A180000 K-30000 B120000 X100000"), _GOOD + " P2",
        _START + "G111 A180 K-30 B120 X100", severity=Severity.INFO),
    row("start-in-increments",
        "{words} of the start point {have} no decimal point and {are} read as {actual}; {meant} would be {expected}",
        "write {meant} if that is meant; else {same}, which says the same",
        _READING, ReadIssue.START_IN_INCREMENTS,
        (_GOOD, "G00 X40000 Z0\nG111 A180. K-30. B120. X100.", "G00 X40 Z0\nG111 A180000 K-30000 B120000 X9000"),
        "G00 X40 Z0\nG111 A180. K-30. B120. X100.", "G00 X40 Z2\nG111 A180 K-30 B120 X100", severity=Severity.WARNING),
    row("position-unknown", "the start point is not known in {axes}: {reason}",
        "position {axes} with an absolute word before this block, or state where the tool is with --start",
        _READING, ReadIssue.POSITION_UNKNOWN, _GOOD, _START + "G28 U0 W0\nG111 A180. K-30. B120. X100.",
        "G111 A180. K-30. B120. X100."),
    row("start-assumed", "checked from {place}, where the best fix of program line {line} ends",
        "mend program line {line} first",
        _READING, ReadIssue.START_ASSUMED, _GOOD, _GOOD + " P90.\nG111 A180. K-10. B120. X120.",
        severity=Severity.INFO),
    row("contour-waits", "not checked: it waits for the end point of program line {line}",
        "mend program line {line} first",
        _READING, ReadIssue.CONTOUR_WAITS, _GOOD, _START + "G111 A180. B120. X100.\nG111 A180. K-10. B120. X120.",
        severity=Severity.INFO),
    row("calls-differ", "what runs here is not the same every time; {results}",
        "check each call; expand --inline writes each of them out",
        _READING, ReadIssue.CALLS_DIFFER, _CALLING.format("G00 X40. Z0."), _CALLING.format("G00 X130. Z0."),
        severity=Severity.INFO),
    row("subprogram-refused", "the contour in line {line} of {file}, which is called here, is refused: {finding}",
        "check {file} by itself, with --start for where the tool is then",
        _READING, ReadIssue.SUBPROGRAM_REFUSED, _GOOD),
    row("not-followed", "{reason}", "contours behind this block are examined from an unknown point",
        _READING, ReadIssue.NOT_FOLLOWED, _CALLING.format("G00 X40. Z0."),
        "G00 X40. Z0.\nGOTO 20\nG111 A180. K-30. B120. X100.", severity=Severity.WARNING),
    row("profile-turns-back",
        "the profile of {cycle} turns back along {axis} on its way to {place} (program line {line}); {cycle} cuts "
            "profiles that go one way along {axis}",
        "part the profile; or give both axes in its first block, if the control then admits pockets",
        _own("roughing cycles of lathes; controls stop with a number of their own"), ReadIssue.PROFILE_TURNS_BACK,
        _PROFILE.format("X120."), _PROFILE.format("X90."), severity=Severity.WARNING),
    row("start-skippable", "the contour depends on a block that begins with /; contoursolve takes it as executed",
        "make sure that the contour is right with that block skipped, too",
        _READING, ReadIssue.SKIPPABLE_START, _GOOD, "G00 X40. Z0.\n/G01 X50.\nG111 A180. K-30. B120. X100.",
        severity=Severity.INFO),
    row("text-outside",
        "this line stands {side} the % in {mark} that {does} the program: a control leaves it out, or takes it "
            "for another program; here it is read as a block",
        "delete it, or put the % where the program {does}",
        _own("tape format of ISO 6983 and RS-274: a program stands between two %"), ReadIssue.TEXT_OUTSIDE,
        (f"%\nO1\n{_GOOD}\nM30\n%\n(end)", f"{_GOOD} (50%)\nM30\n%", f"(part)\n%\n{_GOOD}\nM30"),
        f"%\n{_GOOD}\n%\nG01 Z-90.", f"G01 Z5.\n%\n{_GOOD}\nM30\n%", f"{_GOOD}\n%\nG01 Z-90.",
        severity=Severity.WARNING),
    row("no-contour", "nothing to solve: the program has no contour block", "contour blocks {triggers}",
        _READING, ReadIssue.NO_CONTOUR, _GOOD, "G00 X40. Z0.\nG01 Z-30. F0.2"),
    row("control-unknown", "control not recognised; with --control {control}: {finding}",
        "name the control by --control {control}, or in contoursolve.toml",
        _READING, ReadIssue.CONTROL_UNKNOWN, _GOOD, "G17 G90 G0 X0 Y0\nG1 X50 A30\nG1 X10 Y20"),
)  # fmt: skip

SYSTEM_RULES = (
    row("words-missing", "{open}: {completions}", "or state a fact about it: `contoursolve facts` lists them",
        _GEOMETRY, ReadIssue.UNDERDETERMINED, _GOOD, _START + "G111 A180. B120. X100."),
    row("corner-twice", "{words} give {subject} two shapes at once", "keep one of them",
        _GEOMETRY, ReadIssue.CORNER_TWICE, _GOOD + " C2.", _GOOD + " C2. P2."),
    row("corner-negative", "{words}: {subject} has a negative size, which no corner has", "delete the minus sign",
        _GEOMETRY, ReadIssue.CORNER_NEGATIVE, _GOOD + " P2.", _GOOD + " P-2."),
    row("corner-nowhere", "{words}: {subject} needs the last line by its angle and one coordinate",
        "give the last line by its angle and one coordinate",
        _GEOMETRY, ReadIssue.CORNER_NOWHERE, _GOOD + " D2.", _START + "G111 A180. K-30. X100. Z-47. D2."),
    row("several-contours", "{count} contours fit the block, and no word chooses one",
        "add the word or the fact that chooses: `contoursolve solve` lists them, each with what selects it",
        _GEOMETRY, NoteKind.SEVERAL, "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1",
        _START + "G111 X100. Z-47. B120. (contoursolve: length of line 1 = 30)"),
    row("count-open", "this contour fits the block; whether another one fits, too, is not proven",
        "state one more fact, or simpler ones",
        _GEOMETRY, NoteKind.COUNT_OPEN, _GOOD, severity=Severity.WARNING),
    row("no-point", "no {things} fits {words}{together}",
        "change one of the values; every combination of sides has been tried, so this is proven",
        _GEOMETRY, RefusalKind.NO_POINT, _GOOD, _START + "G111 X100. Z-47. B120. (contoursolve: length of line 1 = 3)"),
    row("search-unfinished",
        "undecided: the search found no {things} for {words}{together}, and did not prove that there is none",
        "{advice}",
        _GEOMETRY, RefusalKind.SEARCH_UNFINISHED, _GOOD),
    row("facts-singular", "at these values {words} {do} not fix {free}",
        "replace one of them by a fact that tells the place, such as a coordinate or a length",
        _GEOMETRY, ReadIssue.FACTS_SINGULAR, _GOOD,
        _START + "G111 I0 B120. X100. (contoursolve: direction of line 1 = 180)"),
    row("asked-nothing", "{words} asks for something that is not part of the contour",
        "write a number, or delete it; ? can stand after {allowed}",
        _own("words whose value is asked for"), ReadIssue.ASKED_NOTHING,
        _START + "G111 A180. K-30. B120. X100. P? (contoursolve: straight part of line 1 = 25)",
        _START + "G111 A180. K-30. B120. X100. F?", _START + "G111 A180. K-30. B120. X100. M?"),
    row("start-units", "the start point was read in {was}, the contour is in {unit}",
        'if the start point is in {unit}, too, write --start "{code} {start}"',
        _READING, ReadIssue.START_UNITS, "G20 G00 X2. Z0.\nG111 A180. K-1. B120. X4.", severity=Severity.INFO),
    row("start-diameter", "X of the start point was read as {was}; in the contour X is {now}",
        'if the start point is meant so, too, write --start "{code} {start}"',
        _READING, ReadIssue.START_DIAMETER, "G18 DIAMON G0 X20 Z0\nG1 X40 RND=2\nZ-50", severity=Severity.WARNING),
    row("fact-unmarked", "this comment looks like a fact, but is read as an ordinary comment", "write {fact}",
        _own("facts about a contour"), ReadIssue.FACT_UNMARKED,
        (_START + "G111 A180. K-30. B120. (CONTOURSOLVE: length of line 2 = 20)", _GOOD + " (contoursolve 0.1)"),
        _GOOD + " (contoursolve length of line 1 = 30)", _GOOD + " ;contoursolve: length of line 1 = 30",
        severity=Severity.WARNING),
    row("fact-beyond", "{words} holds at {place}, where {element} is not cut: such a fact is about its whole {whole}",
        "nothing to do if that is meant; else state a fact about the part that is cut",
        _own("facts about a contour"), ReadIssue.FACT_BEYOND,
        _START + "G111 A180. K-30. X100. (contoursolve: line 2 passes through [Z-40. X80.])",
        _START + "G111 A180. K-30. X100. (contoursolve: line 2 passes through [Z-60. X160.])", severity=Severity.INFO),
    row("fact-unreadable", "the fact cannot be read: {reason}", "see `contoursolve facts` for what can be stated",
        _own("grammar of a fact"), ReadIssue.FACT_UNREADABLE,
        _START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",
        _START + "G111 A180. K-30. B120. (contoursolve: length of line 9 = 20)"),
    row("fact-nowhere", "this fact stands in no contour block, and is not used",
        "write the comment into the block of the contour that it is about",
        _own("facts about a contour"), ReadIssue.FACT_NOWHERE,
        _START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",
        _START + "(contoursolve: length of line 2 = 20)\n" + _GOOD.partition("\n")[2], severity=Severity.WARNING),
    row("fact-impossible", "{words} says nothing about this contour: {reason}",
        "see `contoursolve facts` for what can be stated",
        _own("facts about a contour"), ReadIssue.FACT_IMPOSSIBLE,
        _START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",
        _START + "G111 A180. K-30. B120. (contoursolve: radius of line 2 = 20)"),
    row("words-conflict", "{words} disagrees with {others} by {off}: it states {actual}, {they} {give} {expected}",
        "delete it, or write {meant}",
        _GEOMETRY, RefusalKind.WORDS_DISAGREE, _GOOD, _GOOD + " U50."),
    row("fact-conflict", "{words} is not true of what {others} {give}: it is off by {off}",
        "delete it, or change what it is about",
        _GEOMETRY, RefusalKind.FACT_DISAGREES, _GOOD, _GOOD + " (contoursolve: line 2 passes through [Z-40. X80.])"),
    row("words-redundant", "{words} repeats {others}", "delete it",
        _GEOMETRY, NoteKind.WORDS_AGREE, _GOOD, _GOOD + " U60.", severity=Severity.WARNING),
    row("not-verified", "the result does not satisfy the equations of the block: off by {actual}, allowed {limit}",
        "please report this block: it is an error of contoursolve",
        _GEOMETRY, RefusalKind.NOT_VERIFIED, _GOOD),
    row("out-of-range", "{subject} lies {actual} from the start point, and words reach {limit} at most",
        "look for two directions that are almost the same, or for a lost decimal point",
        _GEOMETRY, RefusalKind.OUT_OF_RANGE, _GOOD, "G00 X40. Z0.\nG111 A180. K-10. B179.9999999999 X41."),
    row("contour-sensitive", "the points are sure to {actual} only: a small change of a word moves them far",
        "choose words that fix the points more firmly, such as coordinates instead of angles",
        _GEOMETRY, NoteKind.SENSITIVE, _GOOD, "G17 G41 G0 X5000 Y0\nG3 I-5000 J0\nG1 X-6000 Y4999.9999999999 ,A180 Q-1",
        severity=Severity.WARNING),
    row("axis-crossed", "{subject} crosses the spindle axis: the contour begins at {start} and reaches {place}",
        "look for a lost sign or a wrong angle; nothing to do if the tool is meant to pass the centre",
        _GEOMETRY, ReadIssue.AXIS_CROSSED,
        (_GOOD, "G00 X-40. Z0.\nG111 A180. K-30. B-120. X-100.", "G00 X40. Z0.\nG111 A270. I-20. X0 Z-5."),
        "G00 X26.193 Z-11.645\nG111 I1.766 Z-4.662 A90. B-66.607", "G00 X-40. Z0.\nG111 A180. K-30. B120. X100.",
        "G00 X0 Z0.\nG111 A60. I10. B-45. Z30.", severity=Severity.WARNING),
    row("line-vanishes", "{subject} has no length and is left out", "check the words that place its ends",
        _GEOMETRY, NoteKind.LINE_VANISHES, _GOOD, _START + "G111 I0 K0 B120. X100.", severity=Severity.WARNING),
)  # fmt: skip

COMMON_RULES = GRAMMAR_RULES + READING_RULES + SYSTEM_RULES
"""Examples of common rows are programs for the control that their words show."""
