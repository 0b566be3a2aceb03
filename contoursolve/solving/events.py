"""Geometric events: why a block gives no contour, and what a user should know about one. All that is said of an event
stands in its row."""

import re
from enum import Enum

from msgspec import Struct

from contoursolve.diagnostics import Severity, from_above


class Status(Enum):
    """The verdict on one contour; the order is the order of precedence."""

    REJECTED = "rejected"
    """The control's rules refuse it, whatever the geometry: write what the rule asks for."""
    CONFLICTING = "conflicting"
    """More words than needed, and they disagree: drop or correct one."""
    UNDERDETERMINED = "underdetermined"
    """Words are missing: add one."""
    OVERDETERMINED = "overdetermined"
    """More words than needed that agree: drop one."""
    AMBIGUOUS = "ambiguous"
    """Several contours satisfy it, and nothing chooses: add the word or the fact that does."""
    NO_SOLUTION = "no-solution"
    """Determined, but the geometry does not exist or the control cannot make it: change a value."""
    UNDECIDED = "undecided"
    """Determined, but that there is no contour, or no other one than was found, is not proven: state simpler facts."""
    SOLVED = "solved"

    @property
    def text(self) -> str:
        """The same as a reader sees it, after a colon: what is to be done is the same for several of them.

        >>> Status.CONFLICTING.text
        'cannot be cut'
        """
        return str(from_above("status_text", self))

    @property
    def code(self) -> int:
        """Its number in the column `status` of a family.

        >>> Status.SOLVED.code, STATUSES[1]
        (0, <Status.OVERDETERMINED: 'overdetermined'>)
        """
        return _CODES[self]


STATUSES = (
    Status.SOLVED,
    Status.OVERDETERMINED,
    Status.REJECTED,
    Status.CONFLICTING,
    Status.UNDERDETERMINED,
    Status.AMBIGUOUS,
    Status.NO_SOLUTION,
    Status.UNDECIDED,
)
"""The meaning of a number in the column `status`; those below 2 are contours if they have no reason."""

_CODES = {status: code for code, status in enumerate(STATUSES)}


BESIDE = ("limit_first", "limit_second")
"""For two corners that overlap: the largest size of either, mm, if the other one stays."""


class PointsAt(Enum):
    """The places that an event points at."""

    WORDS = "words"
    POINT = "point"
    ELEMENT = "element"
    CORNER = "corner"
    BLOCK = "block"


class Topic(Enum):
    """Matter of a geometric event."""

    WORD = "a word that follows from others"
    FACT = "a fact without a value of its own that follows from others"
    RADII = "the distances of a circle's points from its centre"
    SINGULAR = "facts that leave something free at their values only"
    PLACE = "a step of the construction without a place"
    SEARCH = "a search that found nothing"
    ARITHMETIC = "a result that does not satisfy its equations"
    DIRECTION = "the direction in which a line is stated to run"
    NO_CORNER = "two elements that make no corner"
    PICK = "a word that chooses among solutions"
    OTHER = "something else"


class GeometricEvent(Struct, frozen=True):
    """The texts of one geometric event, for all controls that say nothing else.

    `message` and `help` have fields in braces. `phrase` says what fails beyond the end of a range, without values, and
    `stop` what a machine shows where a program with variables fails: controls show 26 characters. `limits` are the
    values that say how large a corner may be; a smaller one mends it. Other values are lengths, or degrees where they
    are `in_degrees`. `is_local` tells that it rests on the form of the
    elements around its block alone, wherever they lie. `codes` are other ends of the codes of rules about it.
    """

    code: str
    message: str = ""
    help: str = ""
    severity: Severity = Severity.ERROR
    status: Status = Status.NO_SOLUTION
    topic: Topic = Topic.OTHER
    points_at: PointsAt = PointsAt.BLOCK
    limits: tuple[str, ...] = ()
    in_degrees: bool = False
    is_local: bool = False
    phrase: str = ""
    stop: str = ""
    codes: tuple[str, ...] = ()

    @property
    def needs(self) -> frozenset[str]:
        """The fields that its sentences have."""
        return frozenset(re.findall(r"\{(\w+)", self.message + self.help))


class GeometricEventKind(Enum):
    """A kind of event by its code; `event` is its row."""

    event: GeometricEvent
    _value_: str

    def __new__(cls, event: GeometricEvent) -> "GeometricEventKind":
        """The member of a row."""
        member = object.__new__(cls)
        member._value_, member.event = event.code, event
        return member


class RefusalKind(GeometricEventKind):
    """The reasons why a determined system gives no contour at the values of this block."""

    LINES_PARALLEL = GeometricEvent(
        "lines-parallel",
        "no {things} fits {words}: the lines are parallel and {off} apart",
        "change an angle or a point",
        topic=Topic.SINGULAR,
        points_at=PointsAt.POINT,
        phrase="{parallel}",
        stop="LINES ARE PARALLEL",
        codes=("parallel",),
    )

    NOT_FIXED = GeometricEvent(
        "not-fixed",
        "{words} {do} not fix {free}: at these values they state the same line",
        "replace one of them by a word that says where on the line the point is",
        status=Status.UNDERDETERMINED,
        topic=Topic.SINGULAR,
        points_at=PointsAt.POINT,
        phrase="{parallel}",
    )

    POINT_IS_START = GeometricEvent(
        "point-is-start",
        "{words}: this point of the line is the one where the line begins, so it gives no direction",
        "give another point of the line, or its angle",
        topic=Topic.PLACE,
        points_at=PointsAt.POINT,
        phrase="the point of the line is its start point",
        stop="TWO POINTS ARE ONE",
    )
    """A line through two points, which are one."""

    CIRCLE_MISSED = GeometricEvent(
        "circle-missed",
        "the line misses the circle: it passes the centre at {actual}, the radius is {limit}, {off} too far",
        "change the line, or make the circle larger",
        topic=Topic.PLACE,
        points_at=PointsAt.POINT,
        phrase="the line misses the circle",
        stop="LINE MISSES THE CIRCLE",
        codes=("missed",),
    )

    RADIUS_TOO_SMALL = GeometricEvent(
        "radius-too-small",
        "{words}: the radius of {actual} is less than half the distance between two points of the arc, {limit}",
        "write at least {limit}, or correct a point",
        topic=Topic.PLACE,
        points_at=PointsAt.POINT,
        phrase="the radius is less than half the distance between its two points",
        stop="RADIUS IS TOO SMALL",
    )

    CIRCLES_APART = GeometricEvent(
        "circles-apart",
        "the two circles do not meet: their centres are {actual} apart, and they meet at {limit}",
        "change a centre or a radius by {off}",
        topic=Topic.PLACE,
        points_at=PointsAt.POINT,
        phrase="the circles do not meet",
        stop="CIRCLES DO NOT MEET",
    )

    CIRCLE_UNDEFINED = GeometricEvent(
        "circle-undefined",
        "{words} {define} no circle: the radius is 0, or two of its points are one",
        "give a centre or a point away from where the arc begins",
        topic=Topic.PLACE,
        points_at=PointsAt.POINT,
        phrase="the radius of the circle is 0",
        stop="CIRCLE HAS NO RADIUS",
        codes=("undefined", "circle-degenerate"),
    )

    WORDS_DISAGREE = GeometricEvent(
        "words-disagree",
        "{words} disagrees with {others} by {off}: it states {actual}, {they} {give} {expected}",
        "delete it, or write {meant}",
        status=Status.CONFLICTING,
        topic=Topic.WORD,
        points_at=PointsAt.WORDS,
        phrase="{disagreeing} disagrees with the other words",
        stop="{} DISAGREES",
        codes=("words-conflict",),
    )

    FACT_DISAGREES = GeometricEvent(
        "fact-disagrees",
        "{words} is not true of what {others} {give}: it is off by {off}",
        "delete it, or change what it is about",
        status=Status.CONFLICTING,
        topic=Topic.FACT,
        points_at=PointsAt.WORDS,
        phrase="the words disagree about {subject}",
        stop="WORDS DISAGREE",
        codes=("fact-conflict",),
    )
    """A fact without a value of its own is not true of what the others give."""

    RADIUS_DIFFERENCE = GeometricEvent(
        "radius-difference",
        "{words}: two points of the arc differ in their distance from its centre by {off}, allowed {limit}",
        "correct the point, the centre or the radius",
        status=Status.CONFLICTING,
        topic=Topic.RADII,
        points_at=PointsAt.WORDS,
        phrase="two points of the circle differ in their distance from its centre",
        stop="RADII DIFFER",
    )

    LINE_REVERSED = GeometricEvent(
        "line-reversed",
        "{words} points away from the end of {subject}, which lies {off} behind its start",
        "check the signs: as its ends lie, it would run at {expected}",
        topic=Topic.DIRECTION,
        points_at=PointsAt.ELEMENT,
        in_degrees=True,
        is_local=True,
        phrase="{reversed}",
        stop="LINE RUNS BACKWARDS",
        codes=("reversed",),
    )

    LINE_BACKWARDS = GeometricEvent(
        "line-backwards",
        "{subject} would run backwards: it ends {off} behind where it begins",
        "move the point that it runs to",
        points_at=PointsAt.ELEMENT,
        phrase="{subject} would run backwards",
        stop="LINE RUNS BACKWARDS",
        codes=("backwards",),
    )

    CORNER_TOO_LARGE = GeometricEvent(
        "corner-too-large",
        "{subject} does not fit: {words} is {actual}, {fits} on {where}",
        "{smaller}, or make the elements longer",
        points_at=PointsAt.CORNER,
        limits=("limit",),
        is_local=True,
        phrase="{large}",
        stop="{} DOES NOT FIT",
    )

    CORNERS_OVERLAP = GeometricEvent(
        "corners-overlap",
        "{words} overlap on {subject}: they need {actual}, it has {limit}",
        "{smaller}",
        points_at=PointsAt.CORNER,
        limits=BESIDE,
        is_local=True,
        phrase="{large}",
        stop="CORNERS OVERLAP",
    )

    CORNER_STRAIGHT = GeometricEvent(
        "corner-straight",
        "{words}: {subject} joins two elements of the same direction, so it is no corner",
        "delete {words}",
        topic=Topic.NO_CORNER,
        points_at=PointsAt.CORNER,
        is_local=True,
        phrase="{subject} joins two lines of one direction",
        stop="NO CORNER FOR {}",
        codes=("no-corner",),
    )

    CORNER_REVERSES = GeometricEvent(
        "corner-reverses",
        "{words}: {subject} turns back by 180 deg, where no corner can be made",
        "change the direction of one element",
        topic=Topic.NO_CORNER,
        points_at=PointsAt.CORNER,
        is_local=True,
        phrase="{subject} turns back by 180 deg",
        stop="NO CORNER FOR {}",
    )

    BEVEL_OUTSIDE = GeometricEvent(
        "bevel-outside",
        "{words}: the virtual intersection lies {off} in {axis} outside the rectangle that its line spans",
        "use a rounding, or a sharp corner",
        points_at=PointsAt.CORNER,
        phrase="the bevel of {subject} lies outside the rectangle of its lines",
        stop="{} IS OUTSIDE THE LINES",
    )

    BEVEL_IN_BAND = GeometricEvent(
        "bevel-in-band",
        "{words}: no 45 deg segment joins the two elements of {subject}",
        "use a rounding, or a sharp corner",
        points_at=PointsAt.CORNER,
        limits=("limit",),
        phrase="no 45 deg bevel joins the lines of {subject}",
        stop="{} DOES NOT FIT",
        codes=("bevel-band",),
    )

    LANDING_UNKNOWN = GeometricEvent(
        "landing-unknown",
        "{words}: no line advances along the line that {subject} would land on",
        "delete {words}",
        points_at=PointsAt.CORNER,
        phrase="no line advances along the line that {subject} lands on",
        stop="NO LINE BEHIND {}",
    )

    ARC_EMPTY = GeometricEvent(
        "arc-empty",
        "{subject} ends where it begins: no arc, or a full circle, would be cut",
        "choose the other point, or drop the arc",
        points_at=PointsAt.ELEMENT,
        phrase="{subject} ends where it begins",
        stop="ARC HAS NO LENGTH",
    )

    NO_POINT = GeometricEvent(
        "no-point",
        "no {things} fits {words}{together}",
        "change one of the values; every combination of sides has been tried, so this is proven",
        topic=Topic.SEARCH,
        points_at=PointsAt.POINT,
        phrase="{apart}",
    )

    SEARCH_UNFINISHED = GeometricEvent(
        "search-unfinished",
        "not decided: the search found no {things} for {words}{together}, and did not prove that there is none",
        "{advice}",
        status=Status.UNDECIDED,
        topic=Topic.SEARCH,
    )

    COUNT_OPEN = GeometricEvent(
        "only-unproven",
        "not decided: one contour fits the block{within}, and that no other one {does} is not proven",
        "{advice}; `contoursolve solve` lists what was found",
        status=Status.UNDECIDED,
    )
    """One contour was found, no word has chosen it from others, and that there is no other one is not proven."""

    NOT_VERIFIED = GeometricEvent(
        "not-verified",
        "the result does not satisfy the equations of the block: off by {actual}, allowed {limit}",
        "please report this block: it is an error of contoursolve",
        topic=Topic.ARITHMETIC,
    )

    OUT_OF_RANGE = GeometricEvent(
        "out-of-range",
        "{subject} lies {actual} from the start point, and words reach {limit} at most",
        "look for two directions that are almost the same, or for a lost decimal point",
        points_at=PointsAt.POINT,
        phrase="a point lies farther away than words reach",
    )
    """A point lies farther from the start than any word reaches."""

    CORNER_SIGN = GeometricEvent(
        "corner-sign",
        "{words}: the sign says which way {subject} runs, and it runs the other way",
        "change the sign; plus is the positive direction of that axis",
        points_at=PointsAt.ELEMENT,
        phrase="{subject} runs against the sign of its corner",
        stop="SIGN OF {} IS WRONG",
    )
    """The sign of a corner word says that the next line runs the other way."""

    PICK_NONE = GeometricEvent(
        "pick-none",
        topic=Topic.PICK,
    )
    """A word chooses a solution that is not there."""

    @property
    def status(self) -> Status:
        """The status that this refusal gives a contour."""
        return self.event.status


class NoteKind(GeometricEventKind):
    """The facts that a user should know about a contour that was solved."""

    TOUCHES = GeometricEvent(
        "touches",
        "{subject}: two elements only touch, so that both intersections are one point",
        "a value slightly different splits it in two or loses it: check that tangency is meant",
        severity=Severity.WARNING,
        points_at=PointsAt.POINT,
        codes=("circle-touched",),
    )
    """The line touches the circle: both solutions are one."""

    DOUBLE = GeometricEvent(
        "double",
        "{subject}: two contours have become one, because an element just touches; a small change parts them",
        "check that it is meant to touch",
        severity=Severity.WARNING,
        points_at=PointsAt.POINT,
    )
    """Two solutions have become one, and not because a line of the path touches a circle."""

    HALF_CIRCLE = GeometricEvent(
        "half-circle",
        "{words}: the ends are {limit} from their middle, {off} more than the radius, so it is a half circle",
        "within the least increments nothing is wrong; the arc ends where its words say",
        severity=Severity.INFO,
        points_at=PointsAt.WORDS,
    )
    """Half the distance of its ends is more than a radius, by as little as words are exact to."""

    SEVERAL = GeometricEvent(
        "several",
        "{count} contours fit the block, and no word chooses one",
        "add the word or the fact that chooses: `contoursolve solve` lists them, each with what selects it",
        codes=("several-contours",),
    )
    """More than one contour satisfies the block."""

    COUNT_OPEN = GeometricEvent(
        "count-open",
        "this contour fits the block; whether another one fits, too, is not proven",
        "state one more fact, or simpler ones",
        severity=Severity.WARNING,
    )
    """It is not proven that these are all contours."""

    SENSITIVE = GeometricEvent(
        "sensitive",
        "the points are sure to {actual} only: a small change of a word moves them far",
        "choose words that fix the points more firmly, such as coordinates instead of angles",
        severity=Severity.WARNING,
        codes=("contour-sensitive",),
    )
    """Rounding alone may move a point by more than a thousandth of the least increment."""

    LINE_VANISHES = GeometricEvent(
        "line-vanishes",
        "{subject} has no length and is left out",
        "check the words that place its ends",
        severity=Severity.WARNING,
        points_at=PointsAt.ELEMENT,
    )

    PICK_OPEN = GeometricEvent(
        "pick-open",
        topic=Topic.PICK,
    )
    """A word chooses among solutions, and the other words leave one alone."""

    PICK_FIRST = GeometricEvent(
        "pick-first",
        topic=Topic.PICK,
    )
    """Nothing chooses, and a setting takes the first of several contours."""

    WORDS_AGREE = GeometricEvent(
        "words-agree",
        "{words} repeats {others}",
        "delete it",
        severity=Severity.WARNING,
        topic=Topic.WORD,
        points_at=PointsAt.WORDS,
        codes=("words-redundant",),
    )
    """A word that was not needed agrees."""

    RADIUS_DIFFERS = GeometricEvent(
        "radius-differs",
        "{words}: two points of the arc differ in their distance from the centre by {off}, within the allowed {limit}",
        "correct the point, the centre or the radius",
        severity=Severity.INFO,
        topic=Topic.RADII,
        points_at=PointsAt.WORDS,
    )
    """Two points of a circle differ in radius, by less than the control allows."""


def events_about(*topics: Topic) -> frozenset[RefusalKind | NoteKind]:
    """The kinds of events about some topics."""
    return frozenset(kind for kind in (*RefusalKind, *NoteKind) if kind.event.topic in topics)


def refusals_about(*topics: Topic) -> frozenset[RefusalKind]:
    """The same of those that leave no contour."""
    return frozenset(kind for kind in RefusalKind if kind.event.topic in topics)
