"""The rows of the catalogue that hold for every control: characters, words, positions, geometry."""

from contoursolve.diagnostic import Severity
from contoursolve.reading import Trouble
from contoursolve.rules import Rule
from contoursolve.solving import RefusalKind, RemarkKind
from contoursolve.source import Evidence, Source
from contoursolve.syntax import FaultKind

_GOOD = "G00 X40. Z0.\nG111 A180. K-30. B120. X100."
_START = "G00 X40. Z0.\n"


def _own(place: str) -> Source:
    return Source("contoursolve", place, Evidence.ASSUMED)


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
        code="number-too-long",
        message="{words} has more digits than any control reads",
        help="write at most 8 digits",
        source=_own("at most 32 characters a number"),
        about=FaultKind.NUMBER_TOO_LONG,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K-30.0000000000000000000000000000000000 B120. X100.",),
    ),
    Rule(
        code="value-too-large",
        message="{words} is larger than a control can travel",
        help="check the decimal point; the limit is {limit}",
        source=_own("at most 1,000,000 mm or degrees"),
        about=Trouble.VALUE_TOO_LARGE,
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
        about=Trouble.REPEATED_ADDRESS,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A10. A20. K-30. B120. X100.",),
    ),
    Rule(
        code="address-unknown",
        message="{words}: the address {address} has no meaning in {form}",
        help="delete it; {form} reads {allowed}",
        source=_READING,
        about=Trouble.UNKNOWN_ADDRESS,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K-30. B120. X100. R5.",),
    ),
    Rule(
        code="value-variable",
        message="{words} depends on a macro variable, whose value is known only to the control",
        help="write the number",
        source=_READING,
        about=Trouble.VARIABLE,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. K#101 B120. X100.",),
    ),
    Rule(
        code="point-missing",
        message="{words} has no decimal point, unlike other words of the block, and is read as {actual}",
        help="write the point if {words} means what it says",
        source=_READING,
        about=Trouble.POINT_MISSING,
        severity=Severity.INFO,
        accepted=(_GOOD, _START + "G111 A180000 K-30000 B120000 X100000"),
        rejected=(_GOOD + " P2",),
    ),
    Rule(
        code="position-unknown",
        message="the start point is not known in {axes}: {reason}",
        help="position {axes} with an absolute word before this block (with --block: by --start)",
        source=_READING,
        about=Trouble.POSITION_UNKNOWN,
        accepted=(_GOOD,),
        rejected=(_START + "G28 U0 W0\nG111 A180. K-30. B120. X100.", "G111 A180. K-30. B120. X100."),
    ),
    Rule(
        code="start-skippable",
        message="the contour depends on a block that begins with / and is taken as executed",
        help="make sure that the contour is right with that block skipped, too",
        source=_READING,
        about=Trouble.SKIPPABLE_START,
        severity=Severity.INFO,
        accepted=(_GOOD,),
        rejected=("G00 X40. Z0.\n/G01 X50.\nG111 A180. K-30. B120. X100.",),
    ),
    Rule(
        code="form-unresolved",
        message="{form} is a contour form that this version of contoursolve does not resolve",
        help="the block was not checked, and the position after it is taken as unknown",
        source=_own("forms resolved: see the README"),
        about=Trouble.FORM_UNRESOLVED,
        accepted=(_GOOD,),
        rejected=(_START + "G112 U0 I10. K-50. P5. Q5. R30.",),
    ),
    Rule(
        code="no-contour",
        message="nothing to solve: the program has no contour block",
        help="contour blocks are {triggers}",
        source=_READING,
        about=Trouble.NO_CONTOUR,
        accepted=(_GOOD,),
        rejected=("G00 X40. Z0.\nG01 Z-30. F0.2",),
    ),
)

SYSTEM_RULES = (
    Rule(
        code="words-missing",
        message="words are missing: nothing determines {free}",
        help="{completions}",
        source=_GEOMETRY,
        about=Trouble.UNDERDETERMINED,
        accepted=(_GOOD,),
        rejected=(_START + "G111 A180. B120. X100.",),
    ),
    Rule(
        code="corner-twice",
        message="{words} give {subject} two shapes at once",
        help="keep one of them",
        source=_GEOMETRY,
        about=Trouble.CORNER_TWICE,
        accepted=(_GOOD + " C2.",),
        rejected=(_GOOD + " C2. P2.",),
    ),
    Rule(
        code="corner-negative",
        message="{words}: {subject} has a negative size, which no corner has",
        help="delete the minus sign",
        source=_GEOMETRY,
        about=Trouble.CORNER_NEGATIVE,
        accepted=(_GOOD + " P2.",),
        rejected=(_GOOD + " P-2.",),
    ),
    Rule(
        code="corner-nowhere",
        message="{words}: nothing tells which line {subject} lands on",
        help="give the last line by its angle and one coordinate",
        source=_GEOMETRY,
        about=Trouble.CORNER_NOWHERE,
        accepted=(_GOOD + " D2.",),
        rejected=(_START + "G111 A180. K-30. X100. Z-47. D2.",),
    ),
    Rule(
        code="several-contours",
        message="{count} contours satisfy the block, and nothing chooses between them",
        help="add the word or the fact that chooses: the solutions are listed, each with what selects it",
        source=_GEOMETRY,
        about=RemarkKind.SEVERAL,
        accepted=("G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1",),
        rejected=(_START + "G111 X100. Z-47. B120. (contoursolve: length of line 1 = 30)",),
    ),
    Rule(
        code="count-open",
        message="this contour satisfies the block, but whether it is the only one is not proven",
        help="state one more fact, or simpler ones",
        source=_GEOMETRY,
        about=RemarkKind.COUNT_OPEN,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(),
    ),
    Rule(
        code="no-point",
        message="the words and facts contradict one another: no contour satisfies them all",
        help="change a value; every combination of sides has been tried",
        source=_GEOMETRY,
        about=RefusalKind.NO_POINT,
        accepted=(_GOOD,),
        rejected=(_START + "G111 X100. Z-47. B120. (contoursolve: length of line 1 = 3)",),
    ),
    Rule(
        code="search-unfinished",
        message="no contour was found, and whether there is one could not be decided",
        help="state simpler facts, such as coordinates",
        source=_GEOMETRY,
        about=RefusalKind.SEARCH_UNFINISHED,
        accepted=(_GOOD,),
        rejected=(),
    ),
    Rule(
        code="fact-unreadable",
        message="the fact cannot be read: {reason}",
        help="see `contoursolve facts` for what can be stated",
        source=_own("grammar of a fact"),
        about=Trouble.FACT_UNREADABLE,
        accepted=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",),
        rejected=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 9 = 20)",),
    ),
    Rule(
        code="fact-impossible",
        message="{words} says nothing about this contour: {reason}",
        help="see `contoursolve facts` for what can be stated",
        source=_own("facts about a contour"),
        about=Trouble.FACT_IMPOSSIBLE,
        accepted=(_START + "G111 A180. K-30. B120. (contoursolve: length of line 2 = 20)",),
        rejected=(_START + "G111 A180. K-30. B120. (contoursolve: radius of line 2 = 20)",),
    ),
    Rule(
        code="words-conflict",
        message="{words} disagrees with the other words by {off}: it states {actual}, they give {expected}",
        help="delete it, or write {expected}",
        source=_GEOMETRY,
        about=RefusalKind.WORDS_DISAGREE,
        accepted=(_GOOD,),
        rejected=(_GOOD + " U50.",),
    ),
    Rule(
        code="words-redundant",
        message="{words} says what the other words say already",
        help="delete it",
        source=_GEOMETRY,
        about=RemarkKind.WORDS_AGREE,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(_GOOD + " U60.",),
    ),
    Rule(
        code="not-verified",
        message="the result does not satisfy the equations of the block: off by {actual}, allowed {limit}",
        help="please report this block: it is an error of contoursolve",
        source=_GEOMETRY,
        about=RefusalKind.NOT_VERIFIED,
        accepted=(_GOOD,),
        rejected=(),
    ),
    Rule(
        code="contour-sensitive",
        message="the points are known to {actual} only: the block is close to a singular case",
        help="choose words that fix the points more firmly, such as coordinates instead of angles",
        source=_GEOMETRY,
        about=RemarkKind.SENSITIVE,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=("G17 G41 G0 X5000 Y0\nG3 I-5000 J0\nG1 X-6000 Y4999.9999999999 ,A180 Q-1",),
    ),
    Rule(
        code="line-vanishes",
        message="{subject} has no length and is left out",
        help="check the words that place its ends",
        source=_GEOMETRY,
        about=RemarkKind.LINE_VANISHES,
        severity=Severity.WARNING,
        accepted=(_GOOD,),
        rejected=(_START + "G111 I0 K0 B120. X100.",),
    ),
)

COMMON_RULES = GRAMMAR_RULES + READING_RULES + SYSTEM_RULES
"""Examples of common rows are programs for the control that their words show."""
