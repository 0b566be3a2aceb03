"""One finding about a program, complete enough for a terminal, JSON and an editor."""

from collections.abc import Mapping, Sequence
from enum import Enum
from math import atan2, degrees

from msgspec import Struct, field

from contoursolve.diagnostics.display import Shown, hash_of
from contoursolve.diagnostics.source import Evidence, Source, Span


class Severity(Enum):
    """Severity of a finding; only `ERROR` makes a command exit with 1."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


class Basis(Enum):
    """Kind of reasoning on which a finding rests."""

    RULE = "rule"
    """Text or words alone: grammar, or a rule of the control's manual."""
    STRUCTURAL = "structural"
    """The structure of the equations: the unknowns that each mentions."""
    SYMBOLIC = "symbolic"
    """The equations for all values of the words."""
    NUMERICAL = "numerical"
    """The equations at the values of this block."""


class Applicability(Enum):
    """Effect of a fix on the contour."""

    SAFE = "safe"
    CHANGES_CONTOUR = "changes-contour"
    PLACEHOLDER = "placeholder"


class LineChange(Struct, frozen=True):
    """The new text of a whole line; nothing if it is dropped, several lines if it becomes these."""

    span: Span
    text: str
    old: str = ""
    """The text that it has."""


class NumberRange(Struct, frozen=True):
    """A range of numbers, as words: from one to another; empty where it may be any number on that side."""

    low: str
    high: str


class OpenNumber(Struct, frozen=True):
    """A number that a fix leaves open: the word in which `?` stands for it, and the word with one that makes a contour,
    where one is known.

    Each end of `ranges` was tried, while the other open numbers were those of their examples. `is_complete` tells that
    no range was left out.
    """

    word: str
    line: int
    example: str = ""
    ranges: tuple[NumberRange, ...] = ()
    is_complete: bool = False


class Fix(Struct, frozen=True):
    """A whole new block to write instead, or a line for each block of a contour of several; a single block may become
    several lines.

    Attributes:
        description: what it does, as a command.
        replacement: the new text of the block, a line for each block of the contour.
        applicability: whether it keeps the contour, changes it, or leaves numbers open.
        effect: its effect in words, where `applicability` alone does not say it.
        example: the replacement with numbers that make a contour, where it leaves gaps and such numbers are known.
        replaced: the text that it replaces, a line for each block of the contour.
        beside: the lines outside the contour that it changes, too.
        numbers: the numbers that it leaves open.
    """

    description: str
    replacement: str
    applicability: Applicability
    effect: str = ""
    example: str = ""
    replaced: str = ""
    beside: tuple[LineChange, ...] = ()
    numbers: tuple[OpenNumber, ...] = ()

    def by_line(self, lines: Sequence[int]) -> dict[int, str]:
        """The new text of each of the lines that it replaces, and of those beside: empty for a line that it drops,
        several lines where it adds some."""
        return self._own(lines) | {each.span.line: each.text for each in self.beside}

    def _own(self, lines: Sequence[int]) -> dict[int, str]:
        texts = [self.replacement] if len(lines) == 1 else self.replacement.split("\n")
        if len(texts) == len(lines):
            return dict(zip(lines, texts, strict=True))
        before = self.replaced.split("\n")
        # What stays as it is on both sides tells which lines the others replace.
        most = min(len(texts), len(lines) - 1)
        head = next((at for at in range(most) if texts[at] != before[at]), most)
        most = min(len(texts), len(lines) - 1) - head
        tail = next((at for at in range(most) if texts[-1 - at] != before[-1 - at]), most)
        changed, new = lines[head : len(lines) - tail], texts[head : len(texts) - tail]
        if len(new) <= len(changed):
            new += [""] * (len(changed) - len(new))
        else:
            new[len(changed) - 1 :] = ["\n".join(new[len(changed) - 1 :])]
        return dict(zip(lines, [*before[:head], *new, *before[len(lines) - tail :]], strict=True))


class Label(Struct, frozen=True):
    """A remark beside a stretch of the program."""

    span: Span
    text: str


class Alarm(Struct, frozen=True):
    """The number (and name) with which the control itself would stop."""

    number: str
    evidence: Evidence


class Diagnostic(Shown, Struct, frozen=True):
    """One finding.

    Attributes:
        code: the name of its rule, such as `words-missing`; see `contoursolve rules`.
        severity: whether it is an error, a warning or a remark.
        basis: the kind of reasoning on which it rests.
        span: its place in the program.
        message: what is found; it stands alone on one line.
        source: the page on which the rule stands, and how sure it is.
        labels: the words that it is about; the first one is the place of the finding.
        addresses: the addresses of these words.
        alarm: the alarm with which the control itself would stop; None where none is known.
        values: `limit`, `expected`, `actual` and `off_by_mm` as far as they apply: mm, X as radius; or degrees.
        notes: why it is so.
        help: what to do.
        fixes: what to write instead, the best first.
        about: the event that it is about, whatever the control calls it; None for a plain rule.
    """

    code: str
    severity: Severity
    basis: Basis
    span: Span
    message: str
    source: Source
    labels: tuple[Label, ...] = ()
    addresses: tuple[str, ...] = ()
    alarm: Alarm | None = None
    values: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    help: str = ""
    fixes: tuple[Fix, ...] = ()
    about: Enum | None = None

    __hash__ = hash_of

    @property
    def is_error(self) -> bool:
        """Whether its severity is that of an error."""
        return self.severity is Severity.ERROR


class Verdict(Enum):
    """Outcome of one check."""

    PASSED = "passed"
    FOUND = "found"
    NOT_RUN = "not run"


class Layer(Struct, frozen=True):
    """One check, its verdict, and in words what it looked at or why it could not run."""

    name: str
    verdict: Verdict
    remark: str


class Freedom(Struct, frozen=True):
    """Freedom of a point: with a `direction` it slides along it, without it lies anywhere.

    `direction` is a unit vector in the plane's axes, `about` the centre of the circle along which it slides, if any.
    Along any other curve (neither that nor `is_straight`) it is the direction where the point is drawn.
    """

    point: str
    direction: tuple[float, float] | None
    about: str = ""
    is_straight: bool = True

    @property
    def angle(self) -> float | None:
        """The direction in degrees, 0 to less than 180; None where the point lies anywhere."""
        return None if self.direction is None else degrees(atan2(self.direction[1], self.direction[0])) % 180

    @property
    def how(self) -> str:
        """The way in which the point can move, such as `slides along 90.0000 deg`."""
        if self.angle is None:
            return "lies anywhere"
        if self.about:
            return f"slides along the circle about {self.about}"
        angle = f"{self.angle:.4f} deg"
        return f"slides along {angle}" if self.is_straight else f"slides along a curve, here at {angle}"


class Tie(Struct, frozen=True):
    """A smallest set of words that say the same, each following from the others.

    `identity` is the formula that ties them for all values, where one is kept. `off_by_mm` is by how much
    they disagree; `is_conflict` whether that is more than the least increment, or
    a line runs against its angle.
    """

    addresses: tuple[str, ...]
    identity: str
    off_by_mm: float
    is_conflict: bool


class Diagnosis(Shown, Struct, frozen=True):
    """Findings of the equations of one contour.

    Attributes:
        layers: the checks that it went through, in their order.
        freedoms: the points that can still move, each with the direction in which it can slide.
        ties: the smallest sets of words that say the same.
        ties_complete: whether the ties are all there are, found exhaustively.
        repairs_complete: whether all smallest sets of words to drop and to add were tried.
    """

    layers: tuple[Layer, ...]
    freedoms: tuple[Freedom, ...]
    ties: tuple[Tie, ...]
    ties_complete: bool
    repairs_complete: bool

    @property
    def conflicts(self) -> tuple[Tie, ...]:
        """The ties whose words disagree."""
        return tuple(each for each in self.ties if each.is_conflict)

    @property
    def redundant(self) -> tuple[Tie, ...]:
        """The ties whose words agree: one of each says nothing new."""
        return tuple(each for each in self.ties if not each.is_conflict)
