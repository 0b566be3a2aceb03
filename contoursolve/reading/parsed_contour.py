"""A contour found in a program: its form, blocks and words, and where it leaves the tool."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace as replace_fields
from decimal import Decimal
from enum import Enum
from functools import lru_cache

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Span
from contoursolve.gcode import Block, Directive, Word
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Choice,
    Fact,
    Given,
    Layout,
    Line,
    Pick,
    Plane,
    Profile,
    Question,
    Radius,
    Side,
)
from contoursolve.reading.contour_form import Assumption, ContourForm, Convention, lay_out
from contoursolve.reading.lexicon import TURNED, Lexicon
from contoursolve.reading.modal_state import Mode, Modes, Position, State, apply_modes, axis_words, positions
from contoursolve.reading.rules import Offence, Rule, check


class ReadIssue(Enum):
    """An issue that can keep a program or a contour from being read, apart from its characters."""

    REPEATED_ADDRESS = "repeated-address"
    UNKNOWN_ADDRESS = "unknown-address"
    VARIABLE = "variable"
    WORD_IGNORED = "word-ignored"
    POINT_MISSING = "point-missing"
    POINT_LOST = "point-lost"
    SUSPECTED = "suspected"
    START_IN_INCREMENTS = "start-in-increments"
    MOVE_IN_INCREMENTS = "move-in-increments"
    ARGUMENT_IN_INCREMENTS = "argument-in-increments"
    COMMA_MISSING = "comma-missing"
    COMMA_WORD_UNKNOWN = "comma-word-unknown"
    WORD_MISTYPED = "word-mistyped"
    LETTER_FOR_DIGIT = "letter-for-digit"
    WORD_UNKNOWN = "word-unknown"
    WORD_IDLE = "word-idle"
    WORD_BESIDE_CODE = "word-beside-code"
    CODE_UNKNOWN = "code-unknown"
    NOT_READ = "not-read"
    CODE_MISTYPED = "code-mistyped"
    VALUE_TOO_LARGE = "value-too-large"
    POSITION_UNKNOWN = "position-unknown"
    START_RELATIVE = "start-relative"
    MODE_UNKNOWN = "mode-unknown"
    START_ASSUMED = "start-assumed"
    CONTOUR_WAITS = "contour-waits"
    NOT_CHECKED = "not-checked"
    CALLS_DIFFER = "calls-differ"
    SUBPROGRAM_REFUSED = "subprogram-refused"
    SUBPROGRAM_SOLVED = "subprogram-solved"
    NOT_FOLLOWED = "not-followed"
    VARIABLE_REFUSED = "variable-refused"
    COMPARISON_LAST = "comparison-last"
    PROFILE_TURNS_BACK = "profile-turns-back"
    SKIPPABLE_START = "skippable-start"
    NO_CONTOUR = "no-contour"
    CONTROL_UNKNOWN = "control-unknown"
    CONTROL_ALIKE = "control-alike"
    CONTROL_CALLED = "control-called"
    MACHINE_TAKEN = "machine-taken"
    TEXT_OUTSIDE = "text-outside"
    UNDERDETERMINED = "underdetermined"
    CORNER_TWICE = "corner-twice"
    CORNER_NEGATIVE = "corner-negative"
    CORNER_NOWHERE = "corner-nowhere"
    CUT_FREE = "cut-free"
    FACT_UNREADABLE = "fact-unreadable"
    FACT_IMPOSSIBLE = "fact-impossible"
    FACT_NOWHERE = "fact-nowhere"
    FACT_UNMARKED = "fact-unmarked"
    FACT_BEYOND = "fact-beyond"
    TRUSTED_ABSENT = "trusted-absent"
    REFERENCE_MET = "reference-met"
    REFERENCE_MISSED = "reference-missed"
    REFERENCE_UNUSED = "reference-unused"
    FACTS_SINGULAR = "facts-singular"
    START_UNITS = "start-units"
    START_DIAMETER = "start-diameter"
    ASKED_NOTHING = "asked-nothing"
    WORD_UNUSED = "word-unused"
    AXIS_CROSSED = "axis-crossed"
    ANGLE_OPPOSITE = "angle-opposite"
    CORNER_DROPPED = "corner-dropped"
    CODE_FORGOTTEN = "code-forgotten"
    RAPID_BEHIND = "rapid-behind"
    LANDING_LEFT = "landing-left"


class Selector(Struct, frozen=True):
    """A word that chooses one of the two places of a point."""

    point: str
    side: Side
    word: str


@dataclass(frozen=True, slots=True)
class ParsedContour:
    """A contour before any check.

    `words` are the words by the name of the given that they state; `givens` their values in mm or
    degrees, without those that are variables; `circumstances` are names such as `@alone`. `before` is the
    state at the start point, `after` the state with the modes of all its blocks.
    """

    form: ContourForm
    lexicon: Lexicon
    blocks: tuple[Block, ...]
    before: State
    after: State
    words: Mapping[str, Word]
    givens: Mapping[str, Given]
    vocabulary: Mapping[str, tuple[str, int]]
    """The address and the block (its index) of every name that a word may state here."""
    unknown: tuple[Word, ...] = ()
    unread: tuple[Word, ...] = ()
    """The words that shape its path, or the block behind it, in a way that contoursolve does not read."""
    repeated: tuple[Word, ...] = ()
    circumstances: frozenset[str] = frozenset()
    passing: frozenset[str] = frozenset()
    """Those of its circumstances that end where words determine it."""
    choices: tuple[Choice, ...] = ()
    selectors: tuple[Selector, ...] = ()
    """The words that would choose, whether they are stated or not."""
    picks: tuple[Pick, ...] = ()
    """The choices of several solutions, element by element."""
    conventions: tuple[Convention, ...] = ()
    """The settings that the manual does not state and that the reading rests on."""
    selected: Plane | None = None
    """The plane in force behind it, where a parallel axis may stand for an axis of that."""
    makes: tuple[tuple[str, ...], ...] = ()
    """The names of what each block makes, where that is not one element and the corner behind it."""
    limits: Mapping[str, Decimal] = field(default_factory=dict)
    """Values of givens, mm, on whose two sides the words are read in different ways while the others stay."""

    kept: Mapping[str, Word] = field(default_factory=dict)
    """Words before its block that stay in force, by the names of the givens that they state; each as if it stood in the
    block."""
    lasting: frozenset[str] = frozenset()
    """Names of words that stay in force behind their block, whether they state anything in it or not."""
    trusted: frozenset[Span] = frozenset()
    """The places of the words that are said to be right."""
    doubts: Mapping[Mode | str, str] = field(default_factory=dict)
    """The modes that are not known to be in force in some of its blocks, and why (see `State`)."""
    needs_place: bool = False
    """Whether its shape alone is not looked at where its place is not known: an error before it is to be mended first,
    or since that, the coordinate system may be turned, mirrored or scaled."""

    def beside_plane(self, block: Block) -> list[Word]:
        """The words of one of its blocks that move an axis outside the plane."""
        rows = ((word, self.lexicon.addresses.get(word.address)) for word in block.words)
        return [word for word, row in rows if row and row.axis and row.axis not in self.after.plane.axes]

    @property
    def left(self) -> State:
        """The modes that it leaves."""
        return self.after if self.selected in (None, self.after.plane) else replace(self.after, plane=self.selected)

    def open_modes(self) -> Iterator[tuple[str, str]]:
        """The modes that are not known to be in force although they matter, in words, and why."""
        if not self.doubts:
            return
        rows = (self.lexicon.addresses.get(word.address) for word in self.words.values())
        minds = {
            Mode.MOVE: False,
            Mode.COMPENSATION: False,
            Mode.INCREMENTS: any(row.follows_increments for row in rows if row and row.axis),
            Mode.DIAMETER: TURNED in self.after.plane.axes,
        }
        for mode, why in self.doubts.items():
            if isinstance(mode, str):
                yield f"whether {mode} is in force", why
            elif minds.get(mode, True):
                yield mode.value, why

    @property
    def directives(self) -> tuple[Directive, ...]:
        """The directives that comments in its blocks state for contoursolve alone."""
        return tuple(directive for block in self.blocks for directive in block.directives)

    def stated(self) -> dict[str, Decimal | None]:
        """The values and circumstances that the rules on combinations look at."""
        values = {name: self.givens[name].value if name in self.givens else None for name in self.words}
        return {**values, **dict.fromkeys(self.circumstances)}

    def rests_on(self, more: Iterable[str] = ()) -> tuple[Assumption, ...]:
        """The assumptions on which the contour rests, of all that the control is taken to accept; `more` are
        circumstances that the words alone do not show."""
        addresses = dict.fromkeys(word.address for block in self.blocks for word in block.words)
        stated = {**addresses, **self.stated(), **dict.fromkeys(more)}
        by_names, roles = _carried_by_names(self.form, frozenset(stated)), self.form.roles
        return tuple(
            each
            for each, is_carried in zip(self.form.assumptions, by_names, strict=True)
            if (each.carries(roles, stated) if is_carried is None else is_carried)
        )


@lru_cache(maxsize=8192)
def _carried_by_names(form: ContourForm, stated: frozenset[str]) -> tuple[bool | None, ...]:
    """The verdict on each assumption of a form: whether a contour that states these names rests on it; None where
    values decide. Programs repeat few combinations of words many times."""
    given = dict.fromkeys(stated)
    return tuple(None if each.when.reads_values else each.carries(form.roles, given) for each in form.assumptions)


def read(claim: ParsedContour, ignored: frozenset[str]) -> Profile:
    """The profile of a claim, without the facts that the control ignores."""
    names = frozenset(claim.givens)
    sharp = frozenset(
        word
        for row in claim.form.outline.corners
        for word in row.shapes
        if word in names and not claim.givens[word].value
    )
    asked = frozenset(name for name, word in claim.words.items() if word.is_asked)
    layout = lay_out(claim.form, names - ignored, sharp, asked)
    dropped = tuple(row.fact for row in claim.form.outline.facts if row.fact.given in ignored & names)
    profile = Profile(
        form=claim.form.name,
        blocks=claim.blocks,
        plane=claim.after.plane,
        unit=claim.after.unit,
        layout=layout,
        start=claim.before.start(),
        givens=claim.givens,
        intersections=claim.form.outline.intersections,
        ignored=dropped,
        choices=claim.choices,
        questions=tuple(_questions(claim, asked, layout)),
        picks=claim.picks,
        is_extended=bool(asked or claim.directives or claim.form.is_general),
        travel=claim.before.travel,
    )
    return profile if profile.start.is_known or claim.needs_place else profile.with_free_start()


def offences_of(claim: ParsedContour, rules: tuple[Rule, ...]) -> tuple[Offence, ...]:
    """The rules that hold for the words of a contour. A word that is asked for may fill a gap, but it is never one too
    many: what refuses must do so without it as well, and what ignores another word must do so by itself."""
    stated = claim.stated()
    offences = check(rules, claim.form.roles, stated)
    asked = {name for name, word in claim.words.items() if word.is_asked}
    if not asked:
        return offences
    without = check(rules, claim.form.roles, {name: stated[name] for name in stated if name not in asked})
    codes = {offence.rule.code for offence in without}
    refusing = tuple(each for each in offences if not each.rule.ignores and each.rule.code in codes)
    return (*refusing, *(each for each in without if each.rule.ignores))


def stating(claim: ParsedContour, names: Iterable[str]) -> ParsedContour:
    """A contour that states more; with what values does not matter."""
    units = {name: claim.lexicon.addresses[claim.vocabulary[name][0]].unit for name in names}
    values = (_ANY + 7 * number for number in range(len(units)))
    more = {name: Given(name, value, unit, None) for (name, unit), value in zip(units.items(), values, strict=True)}
    return replace_fields(claim, givens={**claim.givens, **more})


_ANY = Decimal(1)
"""The value of a word of which only matters that it is there; those of others differ."""


def unused_words(claim: ParsedContour, profile: Profile) -> list[Word]:
    """The words with a value that states nothing about the contour and chooses nothing."""
    used = {fact.given for fact in (*profile.facts, *profile.ignored)}
    used |= {choice.given for choice in claim.choices} | {question.name for question in profile.questions}
    used |= claim.form.outline.shapes.keys() | claim.lasting
    # One block moves all its axes; where several make a contour, that is left to its rules.
    beside = claim.beside_plane(claim.blocks[0]) if len(claim.blocks) == 1 else []
    words = ((name, given.word) for name, given in claim.givens.items() if given.word and name not in used)
    return [word for name, word in words if word not in beside and not _moves_beside(name, word, claim)]


def _moves_beside(name: str, word: Word, claim: ParsedContour) -> bool:
    """Whether a word that would state something of a contour moves another axis, because there is another one for it:
    A beside ,A."""
    return name.partition(":")[2] == f"beside-{word.address}" and claim.lexicon.is_beside(word.address)


def _questions(claim: ParsedContour, asked: frozenset[str], layout: Layout) -> Iterator[Question]:
    """The words that are asked for, each with the fact that it would state about what there is."""
    if not asked:
        return
    figure = layout.figure
    headed = (each.name for each in figure.path if isinstance(each, Line) and each.heading)
    drawn = {figure.start, *figure.points, *figure.radii, *figure.carriers, *headed}
    facts: dict[str, Fact] = {}
    for row in claim.form.outline.facts:
        if row.fact.given in asked and drawn.issuperset(name.partition(".")[0] for name in row.fact.reads()):
            facts.setdefault(row.fact.given, row.fact)
    yield from (_question(claim, name, fact) for name, fact in facts.items())
    for corner in claim.form.outline.corners:
        for name in (name for name in corner.shapes if name in asked):
            yield _question(claim, name, Radius(name, f"{corner.name}.radius"))


def _question(claim: ParsedContour, name: str, fact: Fact) -> Question:
    word = claim.words[name]
    row = claim.lexicon.addresses[word.address]
    return Question(name, fact, row.unit, word, row.is_diameter)


def leave(
    claim: ParsedContour, end: tuple[float, float] | None, modes: Modes, reason: str = "", cause: Span | None = None
) -> State:
    """The modes of a contour's blocks, and the position where it ends, mm; on an axis on which its start is not known,
    it is so far from there.

    Where it has no end, for this reason, whose `cause` may lie in a line before it, what its words say of the end is
    still known.
    """
    state, last, axes = claim.left.cut(), claim.blocks[-1], claim.after.plane.axes
    before = claim.before.axes
    is_skippable = any(block.is_skippable for block in claim.blocks) or any(before[axis].is_skippable for axis in axes)
    if end is not None:
        ends = zip(axes, end, strict=True)
        state = state.move(
            {
                axis: before[axis].step(Decimal(value))
                if before[axis].value is None
                else end_of_contour(value, last.span, is_skippable=is_skippable)
                for axis, value in ends
            }
        )
        return _move_beside(state, claim, modes)
    lost = state.lose(axes, reason, cause or last.span)
    if last.faults or any(word in last.words for word in claim.unread):
        return lost
    # Increments count from where the last block begins, which is known of an only one.
    origin = state if len(claim.blocks) == 1 else lost
    moved = positions(origin, axis_words(last, modes), modes, last.is_skippable)
    is_read = all(word.number is not None for word in claim.words.values())
    is_read = is_read and not (claim.unread or claim.repeated or claim.doubts)
    if is_read and not any(block.faults for block in claim.blocks):
        for axis, value in zip(axes, _stated_end(claim), strict=True):
            # Where the coordinate system moves between two blocks, only the last one says where it is.
            if state.axes[axis] is before[axis] and (axis not in moved or moved[axis].value != value):
                moved[axis] = lost.axes[axis] if value is None else Position(value, _END, last.span, is_skippable)
    return lost.move(moved)


def _stated_end(claim: ParsedContour) -> tuple[Decimal | None, Decimal | None]:
    """The coordinates of the end that words state, mm, whatever becomes of its corners: along each axis back from point
    to point, over lines that run along the other axis too, to a coordinate or to the start."""
    profile = read(claim, frozenset())
    figure, givens = profile.figure, profile.givens
    steps = {
        (placed.point, placed.axis): (placed, fact)
        for fact in profile.facts
        if (placed := fact.placed) is not None and placed.is_stepped
    }

    def along(axis: int) -> Decimal | None:
        tails = {
            line.head: line.tail
            for line in (*figure.path, *figure.lines)
            if isinstance(line, Line) and _is_across(givens.get(line.heading or ""), axis)
        }
        point, total = figure.path[-1].head, Decimal(0)
        while point != figure.start:
            if (point, axis) in steps:
                placed, fact = steps.pop((point, axis))
                if fact.given not in givens:
                    return None
                total += givens[fact.given].value
                if not placed.origin:
                    return total
                point = placed.origin
            elif point in tails:
                point = tails.pop(point)
            else:
                return None
        first = claim.before.start().values[axis]
        return None if first is None else total + first

    return along(FIRST), along(SECOND)


def _is_across(heading: Given | None, axis: int) -> bool:
    """Whether a line in a direction keeps its coordinate on an axis."""
    return heading is not None and heading.value % 180 == (90 if axis == FIRST else 0)


_END = "the end of this contour"


def _move_beside(state: State, claim: ParsedContour, modes: Modes) -> State:
    """The state with the axes outside the plane where the words of a contour's blocks lead."""
    here = claim.before
    for block in claim.blocks:
        words = claim.beside_plane(block)
        here = apply_modes(here.move(state.axes), block, modes)
        state = state.move(positions(here, words, modes, block.is_skippable)) if words else state
    return state


def end_of_contour(value: float, span: Span, *, is_skippable: bool = False) -> Position:
    """The position where a contour ends on an axis, mm; `span` is its last block."""
    return Position(Decimal(value), _END, span, is_skippable)


def next_place(blocks: Iterable[Block], claim: ParsedContour, modes: Modes) -> tuple[Decimal, Decimal] | None:
    """The end of the next block with words, mm, if it is a line and both its coordinates are known."""
    block = next((block for block in blocks if block.words), None)
    if block is None or block.faults:
        return None
    left = claim.left
    state = apply_modes(left, block, modes)
    if state.motion not in (0, 1, None) or any(state.axes[axis] is not left.axes[axis] for axis in state.plane.axes):
        # What moves the coordinate system gives other coordinates to the same place.
        return None
    unknown = state.lose(modes.axes, "the contour before it is not solved yet", block.span)
    found = positions(unknown, axis_words(block, modes), modes, is_skippable=False)
    first, second = (found[axis].value if axis in found else None for axis in state.plane.axes)
    return None if first is None or second is None else (first, second)
