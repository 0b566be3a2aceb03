"""The common ground of all controls: the rows of the catalogue about characters, words, positions, geometry;
settings."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from decimal import Decimal
from typing import Any

from contoursolve.controls.further import WORDS
from contoursolve.diagnostics import OWN, Evidence, Severity, Source
from contoursolve.execution import MOST_BLOCKS, Limit
from contoursolve.gcode import FaultKind
from contoursolve.reading import Dialect, ReadIssue, Rule, Setting, WithoutPoint
from contoursolve.solving import event_of
from contoursolve.tolerance import LARGEST, TRAVEL

_GOOD = "G00 X40. Z0.\nG111 A180. K-30. B120. X100."
_CUT = "0 BEGIN PGM A MM\n1 L X+0 Y+0" + "\n2 FL X+0 Y+20\n3 FL Y+20\n4 FL X+50 Y+20" + "\n5 END PGM A MM"
_START = "G00 X40. Z0.\n"
_PROFILE = (
    "G00 X140. Z2.\nG71 P10 Q20 U.4 W.1 F.2\nN10 G00 X40.\nG01 Z0.\n"
    "G111 A180. K-30. B120. X100.\nN20 G01 {}\nG70 P10 Q20"
)
_CALLING = "G00 X40. Z0.\nM98 P100\n{}\nM98 P100\nM30\nO0100\nG111 A180. K-30. B120. X100.\nM99"


def _own(place: str) -> Source:
    return Source(OWN, place, Evidence.ASSUMED)


def about_event(code: str, source: Source, accepted: tuple[str, ...], rejected: tuple[str, ...]) -> Rule:
    """The row about the geometric event that the end of a code names, as every control tells it."""
    kind = event_of(code)
    event = kind.event
    return Rule(code, event.message, event.help, source, accepted, rejected, about=kind, severity=event.severity)


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
    """The setting of numbers without a point, `increment` or `calculator`; the first of them is in force."""
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
    """The setting of the motion that is in force before the program states one; its samples rely on G1."""
    return setting(
        "first-motion",
        "which motion is in force before the program states one",
        {"G1": "lines by G1", "none": "none: the program must state it"},
        source,
        changes={"none": lambda dialect: replace(dialect, motion=None)},
    )


def angle_sense_setting(source: Source, name: str = "angle-sense", line: str = "a line") -> Setting:
    """The setting that lets lines run against their angles, or not."""
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
    """The setting of how the size of a chamfer is measured on an arc."""
    values = {
        "chord": f"straight from the {corner}",
        "arc_length": "along the arc; contoursolve does not compute this",
    }
    return setting("chamfer-on-arc", f"how {what} is measured on an arc", values, source)


def length_setting(name: str, meaning: str, default: str, source: Source, most: int = 1) -> Setting:
    """One whose value is a number of mm, up to so many."""
    return Setting(name, meaning, {default: "mm"}, default, source, bounds=(Decimal("0.001"), Decimal(most)))


TRAVEL_SETTING = length_setting(
    "travel",
    "how far from the start point solutions are searched for that no closed form gives",
    f"{TRAVEL:.0f}",
    _own("no machine is larger"),
    most=int(LARGEST),
)
BLOCKS_SETTING = Setting(
    Limit().setting,
    "how many blocks may run again, or in another file, before a program is said to go on for ever",
    {f"{MOST_BLOCKS}": "blocks"},
    f"{MOST_BLOCKS}",
    _own("programs are shorter, and one that never ends stops soon"),
    bounds=(Decimal(1), Decimal(100_000_000)),
    unit="blocks",
)
SETTINGS_OF_ALL = (TRAVEL_SETTING, BLOCKS_SETTING, WORDS)
"""Those of every control."""

_GRAMMAR = _own("grammar of a word: an address and a number")
_READING = _own("modal state of a program")
_GEOMETRY = _own("the original equations")

GRAMMAR_RULES = (
    Rule(
        code="number-missing",
        message="{words} has no number",
        help="write the value after the address; a zero must be written, too",
        source=_GRAMMAR,
        about=FaultKind.NUMBER_MISSING,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K B120. X100.", _START + "G111 A180. KNaN B120. X100."),
    ),
    Rule(
        code="number-malformed",
        message="{words} is not a number that a control reads",
        help="write digits with at most one decimal point, without exponent or decimal comma",
        source=_GRAMMAR,
        about=FaultKind.NUMBER_MALFORMED,
        accepted=(_GOOD, _START + "G111 A180. K-.5 B+120. X100."),
        rejected=(_START + "G111 A180. K-1.2.3 B120. X100.", _START + "G111 A180. K-30,5 B120. X100."),
    ),
    Rule(
        code="blank-missing",
        message="{words} is not set apart from the word behind it",
        help="write a blank behind {words}",
        source=_GRAMMAR,
        about=FaultKind.BLANK_MISSING,
        accepted=(_GOOD,),
        rejected=("1 L X+0 Y+0 R0\n2 FLAN+30 LEN20\n3 FL X+60 Y+40",),
    ),
    Rule(
        code="number-too-long",
        message="{words} has more digits than any control reads",
        help="write at most 8 digits",
        source=_own("at most 32 characters a number, 20 of them before its point"),
        about=FaultKind.NUMBER_TOO_LONG,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K-30.0000000000000000000000000000000000 B120. X100.",),
    ),
    Rule(
        code="value-too-large",
        message="{words} is larger than a control can travel",
        help="check the decimal point; the limit is {limit}",
        source=_own("at most 1,000,000 mm or degrees"),
        about=ReadIssue.VALUE_TOO_LARGE,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K-30. B120. X10000000000.",),
    ),
    Rule(
        code="comma-without-address",
        message="the comma in {words} stands before no address",
        help="write the address right after the comma (,A ,C ,R), or a point for a decimal",
        source=_GRAMMAR,
        about=FaultKind.COMMA_WITHOUT_ADDRESS,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K-30. B120. X100. ,",),
    ),
    Rule(
        code="stray-character",
        message="{words} is not part of any word",
        help="delete it, or put it into a comment in parentheses",
        source=_GRAMMAR,
        about=FaultKind.STRAY_CHARACTER,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K-30. $ B120. X100.",),
    ),
    Rule(
        code="comment-not-closed",
        message="a comment begins here and does not end on its line",
        help="close it with )",
        source=_own("grammar of a comment: ( to ), or ; to the end of the line"),
        about=FaultKind.COMMENT_NOT_CLOSED,
        severity=Severity.WARNING,
        accepted=(_GOOD + " (finish)",),
        rejected=(_GOOD + " (finish",),
    ),
    Rule(
        code="block-too-long",
        message="the block has {words} and was not read",
        help="check that this is an NC program; a block has at most 2,000 characters",
        source=_own("at most 2,000 characters a block"),
        about=FaultKind.BLOCK_TOO_LONG,
        accepted=(_GOOD,),
        rejected=(_START + "G111" + " A180." * 400,),
    ),
)

READING_RULES = (
    Rule(
        code="address-repeated",
        message="{words}: {address} is given twice in one block",
        help="keep one of them",
        source=_READING,
        about=ReadIssue.REPEATED_ADDRESS,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A10. A20. K-30. B120. X100.",),
    ),
    Rule(
        code="address-unknown",
        message="{words}: the address {address} has no meaning in this contour ({form})",
        help="{advice}; such a contour is written with {allowed}",
        source=_READING,
        about=ReadIssue.UNKNOWN_ADDRESS,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K-30. B120. X100. R5.",),
    ),
    Rule(
        code="comma-word-unknown",
        message="{words}: this control has no {address}; it stops there, or leaves the word out",
        help="{advice}; name the control by --control, if it is another one",
        source=_READING,
        about=ReadIssue.COMMA_WORD_UNKNOWN,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(_GOOD + "\nG01 X120. ,A30.",),
    ),
    Rule(
        code="word-mistyped",
        message="{words}: this control has no word {address}, so the block is read without it",
        help="write {meant} if that is meant",
        source=_READING,
        about=ReadIssue.WORD_MISTYPED,
        severity=Severity.WARNING,
        accepted=("G17 G90 G0 X0 Y0\nG1 X30 RND=5\nY40",),
        rejected=(
            "G17 G90 G0 X0 Y0\nG1 X30 RND=5\nY40\nG1 X50 AGN=5",
            "G17 G90 G0 X0 Y0\nG1 X60 RN=8\nY40 CHR=5\nX20",
        ),
    ),
    Rule(
        code="word-unknown",
        message="{words}: contoursolve knows no word {address} of this control, so the block is read without it",
        help="delete it; if the machine builder has added it, name it by --set CONTROL.words={address}",
        source=_READING,
        about=ReadIssue.WORD_UNKNOWN,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(_GOOD + "\nG01 X120. E135.",),
    ),
    Rule(
        code="word-idle",
        message="{words} means nothing in a line that ends at coordinates; the block is read without it",
        help="delete it; or write the code or the words of the arc or of the contour that it belongs to",
        source=_READING,
        about=ReadIssue.WORD_IDLE,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=("G17 G90 G0 X0 Y0\nG1 X30 CR=5\nY40 RND=3\nX9",),
    ),
    Rule(
        code="code-unknown",
        message="{name} is no code of this control that contoursolve knows; where the tool is behind it is not known",
        help="{advice}",
        source=_READING,
        about=ReadIssue.CODE_UNKNOWN,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(_GOOD + "\nG399",),
    ),
    Rule(
        code="not-read",
        message="contoursolve does not read {name} yet",
        help="contours that do not depend on it are examined; for others, write out what it does",
        source=_own("what contoursolve follows"),
        about=ReadIssue.NOT_READ,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=(_GOOD + "\nG02.2 X120.",),
    ),
    Rule(
        code="letter-for-digit",
        message="{words} has a letter where a digit seems to be meant: with {meant} this block would be a contour",
        help="write {meant} if that is meant",
        source=_GRAMMAR,
        about=ReadIssue.LETTER_FOR_DIGIT,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(_GOOD + "\nG1l1 A180. B120. X160. Z-80.",),
    ),
    Rule(
        code="code-mistyped",
        message="{words} is no code that is known here: with {meant} this block would be a contour",
        help="write {meant} if that is meant",
        source=_READING,
        about=ReadIssue.CODE_MISTYPED,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(_GOOD + "\nG110 A180. B120. X160. Z-80.",),
    ),
    Rule(
        code="value-variable",
        message="{words} {depend} on a variable, whose value is not known here",
        help="write the number, or state the value: --let {stated}",
        source=_READING,
        about=ReadIssue.VARIABLE,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K#101 B120. X100.",),
    ),
    Rule(
        code="word-unused",
        message="{words} has no part in this contour ({form}), which was solved without it",
        help="delete it, or write it in a block of its own",
        source=_READING,
        about=ReadIssue.WORD_UNUSED,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(),
    ),
    Rule(
        code="point-missing",
        message="{words} {have} no decimal point and {are} read as {actual}",
        help="write the point where the number means what it says",
        source=_READING,
        about=ReadIssue.POINT_MISSING,
        severity=Severity.INFO,
        accepted=(_GOOD, _START + "G111 A180000 K-30000 B120000 X100000"),
        rejected=(_GOOD + " P2", _START + "G111 A180 K-30 B120 X100"),
    ),
    Rule(
        code="start-in-increments",
        message="{words} of the start point {have} no decimal point and {are} read as {actual}; {meant} would be "
        "{expected}",
        help="write {meant} if that is meant; else {same}, which says the same",
        source=_READING,
        about=ReadIssue.START_IN_INCREMENTS,
        severity=Severity.WARNING,
        accepted=(
            _GOOD,
            "G00 X40000 Z0\nG111 A180. K-30. B120. X100.",
            "G00 X40 Z0\nG111 A180000 K-30000 B120000 X9000",
        ),
        rejected=("G00 X40 Z0\nG111 A180. K-30. B120. X100.", "G00 X40 Z2\nG111 A180 K-30 B120 X100"),
    ),
    Rule(
        code="position-unknown",
        message="the start point is not known in {axes}: {reason}",
        help="position {axes} with an absolute word before this block, or state where the tool is with --start",
        source=_READING,
        about=ReadIssue.POSITION_UNKNOWN,
        accepted=(_GOOD,),
        rejected=(_START + "G28 U0 W0\nG111 A180. K-30. B120. X100.", "G111 A180. K-30. B120. X100."),
    ),
    Rule(
        code="mode-unknown",
        message="{what} is not known here: {reason}",
        help="say it in this block, or behind the place where the ways meet",
        source=_READING,
        about=ReadIssue.MODE_UNKNOWN,
        accepted=(_GOOD,),
        rejected=(_START + "IF[#1 EQ 1]GOTO5\nG20\nN5 " + _GOOD.rpartition("\n")[2],),
    ),
    Rule(
        code="start-assumed",
        message="checked from {place}, where the best fix of program line {line} ends",
        help="mend program line {line} first",
        source=_READING,
        about=ReadIssue.START_ASSUMED,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=(_GOOD + " P90.\nG111 A180. K-10. B120. X120.",),
    ),
    Rule(
        code="contour-waits",
        message="not checked: it waits for the end point of program line {line}",
        help="mend program line {line} first",
        source=_READING,
        about=ReadIssue.CONTOUR_WAITS,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. B120. X100.\nG111 A180. K-10. B120. X120.",),
    ),
    Rule(
        code="not-checked",
        message="not checked: {reason}, and each call gives it",
        help="check a program that calls it; or state a value by --let",
        source=_READING,
        about=ReadIssue.NOT_CHECKED,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=("PROC SLOT(REAL RAD)\nG17 G90 G0 X0 Y0\nG1 X60\nY40 RND=RAD\nX20",),
    ),
    Rule(
        code="calls-differ",
        message="what runs here is not the same every time; {results}",
        help="check each call; expand --inline writes each of them out",
        source=_READING,
        about=ReadIssue.CALLS_DIFFER,
        severity=Severity.INFO,
        accepted=(_CALLING.format("G00 X40. Z0."),),
        rejected=(_CALLING.format("G00 X130. Z0."),),
    ),
    Rule(
        code="subprogram-refused",
        message="the contour in program line {line} of {file}, which is called here, has an error: {finding}",
        help="check {file} by itself, with --start for where the tool is then",
        source=_READING,
        about=ReadIssue.SUBPROGRAM_REFUSED,
        accepted=(_GOOD,),
        rejected=(),
    ),
    Rule(
        code="subprogram-solved",
        message="{contours} of {file}, which is called here, {are} solved",
        help="expand --inline writes the blocks of both files as one program",
        source=_READING,
        about=ReadIssue.SUBPROGRAM_SOLVED,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=(),
    ),
    Rule(
        code="not-followed",
        message="{reason}",
        help="contours behind this block are examined from an unknown point",
        source=_READING,
        about=ReadIssue.NOT_FOLLOWED,
        severity=Severity.WARNING,
        accepted=(_CALLING.format("G00 X40. Z0."),),
        rejected=("G00 X40. Z0.\nGOTO 20\nG111 A180. K-30. B120. X100.",),
    ),
    Rule(
        code="profile-turns-back",
        message="the profile of {cycle} turns back along {axis} on its way to {place} (program line {line}); {cycle} "
        "cuts profiles that go one way along {axis}",
        help="part the profile; or give both axes in its first block, if the control then admits pockets",
        source=_own("roughing cycles of lathes; controls stop with a number of their own"),
        about=ReadIssue.PROFILE_TURNS_BACK,
        severity=Severity.WARNING,
        accepted=(_PROFILE.format("X120."),),
        rejected=(_PROFILE.format("X90."),),
    ),
    Rule(
        code="start-skippable",
        message="the contour depends on a block that begins with /; contoursolve takes it as executed",
        help="make sure that the contour is right with that block skipped, too",
        source=_READING,
        about=ReadIssue.SKIPPABLE_START,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=("G00 X40. Z0.\n/G01 X50.\nG111 A180. K-30. B120. X100.",),
    ),
    Rule(
        code="text-outside",
        message="this line stands {side} the % in {mark} that {does} the program: a control leaves it out, or takes it "
        "for another program; here it is read as a block",
        help="delete it, or put the % where the program {does}",
        source=_own("tape format of ISO 6983 and RS-274: a program stands between two %"),
        about=ReadIssue.TEXT_OUTSIDE,
        severity=Severity.WARNING,
        accepted=(f"%\nO1\n{_GOOD}\nM30\n%\n(end)", f"{_GOOD} (50%)\nM30\n%", f"(part)\n%\n{_GOOD}\nM30"),
        rejected=(f"%\n{_GOOD}\n%\nG01 Z-90.", f"G01 Z5.\n%\n{_GOOD}\nM30\n%", f"{_GOOD}\n%\nG01 Z-90."),
    ),
    Rule(
        code="no-contour",
        message="nothing to solve: the program has no contour block",
        help="contour blocks {triggers}",
        source=_READING,
        about=ReadIssue.NO_CONTOUR,
        accepted=(_GOOD,),
        rejected=("G00 X40. Z0.\nG01 Z-30. F0.2",),
    ),
    Rule(
        code="control-unknown",
        message="control not recognised; {readings}",
        help="name the control by --control {control}, or in contoursolve.toml",
        source=_READING,
        about=ReadIssue.CONTROL_UNKNOWN,
        accepted=(_GOOD,),
        rejected=("G17 G90 G0 X0 Y0\nG1 X50 A30\nG1 X10 Y20",),
    ),
    Rule(
        code="control-alike",
        message="{controls} read this program alike: its findings are those of {control}; --control names yours",
        help="name your control by --control or in contoursolve.toml: rules, alarms and fixes are then its own",
        source=_READING,
        about=ReadIssue.CONTROL_ALIKE,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=("G00 X40. Z2.\nG01 Z0. F0.2\nX60. ,C2.\nZ-20.\nX70.",),
    ),
    Rule(
        code="control-called",
        message="the program shows no control, but what it calls does: {sign} is for {control}",
        help="name your control by --control or in contoursolve.toml, if it is another one",
        source=_READING,
        about=ReadIssue.CONTROL_CALLED,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=(),
    ),
    Rule(
        code="machine-taken",
        message="X and Z move alone and no plane is selected: the program is read as one for a lathe, in G18; "
        "for a mill, --set {setting}=mill",
        help="write G18 into the program, or state {setting} in contoursolve.toml",
        source=_READING,
        about=ReadIssue.MACHINE_TAKEN,
        severity=Severity.INFO,
        accepted=(_GOOD, "G18 G90 DIAMON\nG0 X60 Z2\nG1 X40 F0.2\nZ-20 RND=2\nX52"),
        rejected=("G90 DIAMON\nG0 X60 Z2\nG1 X40 F0.2\nZ-20 RND=2\nX52",),
    ),
)

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
        source=_own("words whose value is asked for"),
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
        source=_own("facts about a contour"),
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
        source=_own("facts about a contour"),
        about=ReadIssue.FACT_BEYOND,
        severity=Severity.INFO,
        accepted=(_START + "G111 A180. K-30. X100. (contoursolve: line 2 passes through [Z-40. X80.])",),
        rejected=(_START + "G111 A180. K-30. X100. (contoursolve: line 2 passes through [Z-60. X160.])",),
    ),
    Rule(
        code="fact-unreadable",
        message="the fact cannot be read: {reason}",
        help="see `contoursolve facts` for what can be stated",
        source=_own("grammar of a fact"),
        about=ReadIssue.FACT_UNREADABLE,
        accepted=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",),
        rejected=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 9 = 20)",),
    ),
    Rule(
        code="trusted-absent",
        message="{named} cannot be trusted: {reason}",
        help="name a word as it stands there, such as (contoursolve trust: Z-50.)",
        source=_own("words that are named for contoursolve"),
        about=ReadIssue.TRUSTED_ABSENT,
        accepted=(_GOOD + " (contoursolve trust: A180.)",),
        rejected=(_GOOD + " (contoursolve trust: A18.)", "(contoursolve trust: Z-7.)\n" + _GOOD),
    ),
    Rule(
        code="reference-met",
        message="{named} is met: the contour has {there} at {where}",
        help="nothing to do",
        source=_own("words that are named for contoursolve"),
        about=ReadIssue.REFERENCE_MET,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=(_GOOD + " (contoursolve reference: X100.)", "(contoursolve reference: X100.)\n" + _GOOD),
    ),
    Rule(
        code="reference-missed",
        message="{named} is {off} from the contour, which has {there} at {where}",
        help="compare both with the drawing",
        source=_own("words that are named for contoursolve"),
        about=ReadIssue.REFERENCE_MISSED,
        severity=Severity.WARNING,
        accepted=(_GOOD + " (contoursolve reference: X100.)",),
        rejected=(_GOOD + " (contoursolve reference: Z-47.3)",),
    ),
    Rule(
        code="reference-unused",
        message="{named} was not compared: {reason}",
        help="name a coordinate beside the block that ends there, such as (contoursolve reference: Z-50.)",
        source=_own("words that are named for contoursolve"),
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
        source=_own("facts about a contour"),
        about=ReadIssue.FACT_NOWHERE,
        severity=Severity.WARNING,
        accepted=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",),
        rejected=(_START + "(contoursolve: length of line 2 = 20)\n" + _GOOD.partition("\n")[2],),
    ),
    Rule(
        code="fact-impossible",
        message="{words} says nothing about this contour: {reason}",
        help="see `contoursolve facts` for what can be stated",
        source=_own("facts about a contour"),
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
