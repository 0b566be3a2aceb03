"""One contour from its words to its path: every check in order, and everything there is to say."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from enum import Enum
from functools import lru_cache
from math import dist, pi
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.answer_records import (
    Addition,
    AskedValue,
    Completion,
    Filled,
    Solutions,
    StatedWord,
)
from contoursolve.diagnosis.explain import (
    AGAINST,
    LEAVING_FREE,
    OF_A_WORD,
    SAID_AGAIN,
    SINGULAR,
    Context,
    context_of,
    explain_ignored,
    explain_missing,
    explain_offence,
    explain_path,
    explain_result,
    explain_singular,
    report,
    spans_of,
)
from contoursolve.diagnosis.outliers import stands_out
from contoursolve.diagnosis.spelling import (
    explain_modes,
    explain_skippable,
    explain_spelling,
    explain_start,
    explain_unmarked,
    meant_words,
    start_without_point,
    tell_points,
    without_point,
)
from contoursolve.diagnosis.wording import ContourState, coordinates, join, state_of
from contoursolve.diagnostics import (
    Basis,
    Diagnosis,
    Diagnostic,
    LateModule,
    Severity,
    Shown,
    Span,
    from_above,
    hash_of,
)
from contoursolve.geometry import Length, Line, Plane, Profile, Question, Side, Start, System, Unit, assemble
from contoursolve.reading import (
    AT_ITS_LIMIT,
    Assumption,
    Control,
    ParsedContour,
    Premises,
    ReadIssue,
    offences_of,
    read,
    unused_words,
)
from contoursolve.solving import (
    Alternatives,
    ArcSegment,
    Certificate,
    Contour,
    Note,
    NoteKind,
    Refusal,
    Status,
    SystemSolution,
    Topic,
    analyse,
    is_closed,
    lookup,
    points_with_two_solutions,
    refusals_about,
    scalars_of,
    solve,
    trace,
)
from contoursolve.tolerance import LENGTH

if TYPE_CHECKING:
    from contoursolve.diagnosis import equation_system, hand_sheet
    from contoursolve.diagnosis.edits import Edit
    from contoursolve.gcode import Block, Word
else:
    equation_system = LateModule("contoursolve.diagnosis.equation_system")
    hand_sheet = LateModule("contoursolve.diagnosis.hand_sheet")


class Policy(Enum):
    """The effect of the manual's rules on a block that they refuse."""

    ENFORCE = "enforce"
    """It is reported and not solved."""
    WARN = "warn"
    """It is reported as a warning, and solved if the geometry is determined."""
    OFF = "off"
    """The rules are not applied: the geometry alone decides."""


@dataclass(frozen=True, slots=True, repr=False, eq=False)
class ReadBy:
    """The control that reads a contour, and what its rules do; with it the contour can be read again."""

    control: Control
    policy: Policy

    def __repr__(self) -> str:
        return f"ReadBy({self.control.name!r}, {self.policy})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ReadBy) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))

    def read(self, claim: ParsedContour, edits: Iterable[Edit]) -> ParsedContour | None:
        """A contour with edits of its blocks; None where these are another one then, or none."""
        from contoursolve.diagnosis.edits import read_edits  # noqa: PLC0415 - few contours are read again

        blocks = read_edits(claim.blocks, edits, self.control.modes.syntax)
        found = self.control.find(blocks, 0, claim.before, self.control.modes)
        if not isinstance(found, ParsedContour) or len(found.blocks) != len(claim.blocks):
            return None
        return found

    def profile(self, claim: ParsedContour, without: frozenset[str]) -> Profile:
        """The profile of a contour without what some words state, by the names of these. Raises ValueError for a fact
        that cannot be used."""
        if not without:
            return examine(claim, self.control, self.policy, depth=Depth.VERDICT).profile
        return self.part(claim, without)

    def part(self, claim: ParsedContour, without: frozenset[str]) -> Profile:
        """The same, also without a word that is none of its givens; of nothing left out, what no rule was asked of."""
        profile = read(claim, without.intersection(claim.givens))
        if claim.directives:
            from contoursolve.geometry import Layout, apply_statements  # noqa: PLC0415 - few contours have facts

            profile, faults = apply_statements(profile, claim.directives, lambda: None)
            if faults:
                raise ValueError(faults[0].message)
            facts = tuple(fact for fact in profile.facts if fact.given not in without)
            profile = replace(profile, layout=Layout(profile.figure, facts))
        return replace(profile, ignored=())


class Depth(Enum):
    """The amount that is worked out about a contour that has an error or a warning."""

    VERDICT = "verdict"
    """Its findings."""
    PATH = "path"
    """Also why they are so, and every repair, where there is no contour; nothing is proven of one without a
    finding."""
    FULL = "full"
    """Also why they are so, and every repair; some milliseconds a contour."""
    FINDINGS = "findings"
    """Also why they are so, and every repair; nothing is proven, for who reads the findings sees no proof."""
    TRIAL = "trial"
    """Only whether there is a contour without a finding; of one with findings, not every word that is to blame."""

    @property
    def is_proven(self) -> bool:
        """Whether what is solved is proven to be the only solution."""
        return self in (Depth.VERDICT, Depth.FULL)

    @property
    def is_full(self) -> bool:
        """Whether everything is said of what is wrong."""
        return self in (Depth.FULL, Depth.FINDINGS)


class Answer(Shown, Struct, frozen=True):
    """The result for one contour of a program.

    Attributes:
        form: the name of its form, such as `G111`.
        lines: the program lines of its blocks, from 1.
        claim: its blocks as they were read: words, values, and the modes before and behind them.
        status: what came of it.
        plane: the axes in which its points are, first and second.
        unit: the unit of its words; all other lengths here are mm.
        start: where it begins, mm, X of a lathe as radius; None for a coordinate that is not known.
        profile: the drawing, partly unknown, with the facts that its words state.
        contour: the path; None unless the status is solved or overdetermined.
        sides: the solutions that the block chose where two exist, by the point.
        error_bound: by how much a coordinate may be off, mm.
        diagnostics: the findings about this contour alone.
        read_by: the control and the policy by which it was read.
        diagnosis: the checks, freedoms and ties; made where there is a finding.
        certificate: what is proven of the path; None where nothing was.
        asked: the values that were asked for with `?`.
        alternatives: every solution, where more than the control's own was looked for; see `list_alternatives`.
        filled: the block with the values that were asked for filled in, where it then stands alone.
        calls: the lines of the blocks that call it, if it belongs to a subprogram.
        mended: the answer with slips that are certain mended in thought, where something else is wrong as well.
    """

    form: str
    lines: tuple[int, ...]
    claim: ParsedContour
    status: Status
    plane: Plane
    unit: Length
    start: Start
    profile: Profile
    contour: Contour | None
    sides: Mapping[str, Side]
    error_bound: float
    diagnostics: tuple[Diagnostic, ...]
    read_by: ReadBy
    diagnosis: Diagnosis | None = None
    certificate: Certificate | None = None
    asked: tuple[AskedValue, ...] = ()
    alternatives: Alternatives | None = None
    filled: Filled | None = None
    calls: tuple[int, ...] = ()
    mended: Answer | None = None

    __hash__ = hash_of

    @property
    def state(self) -> str:
        """Its status as a reader sees it, after a colon: of a solved contour with the words that are too many."""
        state = state_of(self.status, has_path=self.contour is not None)
        if self.status is not Status.OVERDETERMINED or state is not ContourState.SOLVED:
            return state.value
        places = {each.span for each in self.diagnostics if each.about is NoteKind.WORDS_AGREE}
        words = [word.text for word in self.claim.words.values() if word.span in places]
        told = "are" if len(words) > 1 else "is one word"
        return f"{state.value} ({join(words) or 'one'} {told} too many)"

    @property
    def system(self) -> equation_system.EquationSystem:
        """Its equations, what they leave open, and on which condition they determine it; by sympy, when it is asked."""
        return equation_system.EquationSystem(self.claim, self.profile, self.read_by)

    @property
    def solutions(self) -> Solutions | None:
        """Every solution, each with what selects it and how sure it is, and whether these are all; None if nothing was
        solved.

        >>> import contoursolve
        >>> answer = contoursolve.solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").answer
        >>> len(answer.solutions), answer.solutions.is_complete
        (1, True)
        """
        found: Solutions | None = from_above("list_solutions", self)
        return found

    @property
    def words(self) -> tuple[StatedWord, ...]:
        """The words that state something about it, in the order of the program.

        >>> import contoursolve
        >>> answer = contoursolve.solve("G111 X100. A180. K-30. B120. P5.", start="X40. Z0.").answer
        >>> [(each.key, each.value, each.unit, each.fixes) for each in answer.words][2:]
        [('K', -30.0, 'mm', ('V1',)), ('B', 120.0, 'deg', ('line 2',)), ('P', 5.0, 'mm', ('corner 1',))]
        """
        found: tuple[StatedWord, ...] = from_above("stated_words", self)
        return found

    @property
    def missing(self) -> tuple[tuple[str, ...], ...]:
        """The smallest sets of addresses that complete its blocks, at most 12, each refused by no rule; nothing where
        they are complete. `completions` and `addable` tell to which of several blocks a word belongs.

        >>> import contoursolve
        >>> contoursolve.solve("G111 A135. B180. Z-40.", start="X40. Z0.").answer.missing
        (('X',), ('U',), ('I',), ('K',))
        """
        found: tuple[tuple[str, ...], ...] = from_above("ways_to_complete", self)
        return found

    @property
    def completions(self) -> tuple[Completion, ...]:
        """The single words that would complete its blocks, each with its value where the geometry fixes it already; a
        word whose number is still to be chosen ends with `?`. Of many words in several blocks, the likeliest 12 or so.

        >>> import contoursolve
        >>> answer = contoursolve.solve("G111 A135. B180. Z-40.", start="X40. Z0.").answer
        >>> [each.word for each in answer.completions]
        ['I?', 'K?', 'X?', 'U?']
        """
        found: tuple[Completion, ...] = from_above("completions", self)
        return found

    @property
    def addable(self) -> tuple[Addition, ...]:
        """Every word that its blocks may still take: no rule refuses it beside the others, and they do not say already
        what it says.

        >>> import contoursolve
        >>> answer = contoursolve.solve("G111 A135. K-10. B120. U40.", start="X40. Z0.").answer
        >>> [each.text for each in answer.addable]
        ['P?', 'Q?', 'C?', 'D?']
        """
        found: tuple[Addition, ...] = from_above("words_to_add", self)
        return found

    @property
    def construction(self) -> str:
        """The construction step by step, as `contoursolve solve --explain` prints it: what each step finds, from which
        words, and where it is; what is still open where nothing can be constructed.

        >>> import contoursolve
        >>> print(contoursolve.solve("G111 X100. A180. K-30. B120.", start="X40. Z0.").answer.construction)
          construction:
            1. V1: -30.000 mm from S along Z (K-30.) and on the line through S at 180.000 deg (A180.)
               -> Z-30.000 mm X40.000 mm
            2. V2 (X and Z): V2 at X100.000 mm (X100.) and on the line through V1 at 120.000 deg (B120.)
               -> X100.000 mm Z-47.321 mm
        """
        return "\n".join(from_above("construction_lines", self))

    @property
    def derivation(self) -> hand_sheet.Derivation:
        """The calculation by hand. Raises ValueError without a contour."""
        return self.system.derivation

    @property
    def form_text(self) -> str:
        """Name and title of its form, in the control's words."""
        return f"{self.claim.form.name} ({self.claim.form.title})"

    @property
    def start_text(self) -> str:
        """The words that lead to its start point, as its control reads coordinates; empty if that is not known.

        >>> import contoursolve
        >>> contoursolve.solve("G111 X100. A180. K-30. B120.", start="X40. Z0.").answer.start_text
        'Z0 X40.'
        """
        from contoursolve.diagnosis.edits import write_word  # noqa: PLC0415 - few ask for it

        if not self.start.is_known:
            return ""
        places = zip(self.plane.axes, self.start.values, strict=True)
        return " ".join(write_word(axis, float(value or 0), self.claim.lexicon, self.unit) for axis, value in places)

    @property
    def end_text(self) -> str:
        """Its end point, as the control writes it: `Z-50.2073 X100.0000`; empty without a path."""
        return coordinates(self.contour.end, self.plane, self.unit) if self.contour else ""

    def with_words(
        self, *, drop: Iterable[str] = (), add: Iterable[str] = (), change: Mapping[str, str] | None = None
    ) -> Answer:
        """The answer with words of its blocks dropped (by address), added, or changed (address to the new word).

        An address that several blocks have is named with its program line: `2:,A`. Words that are added stand in the
        last block, or in that of their line: `7:LEN50`. Findings are those of the blocks alone, each with its fixes.
        Raises ValueError if a word is not there, or more than once, and where the blocks are read as another contour
        then, or as none.

        >>> import contoursolve
        >>> answer = contoursolve.solve("G111 A135. I10. K-12. B180. Z-40.", start="X40. Z0.").answer
        >>> answer.with_words(drop=["A"]).diagnostics
        ()
        >>> answer.with_words(change={"K": "K-10."}, add=["P2."]).end_text
        'Z-40.0000 X60.0000'
        """
        found: Answer = from_above("with_words", self, drop=drop, add=add, change=change or {})
        return found

    def standing_alone(self, *, is_exact: bool = False) -> str:
        """A program of its own: its blocks after what leads to its start point and puts its modal codes in force.

        `solve` takes it with the control of the program, and with `units="inch"` where the program is in inches there.
        It is empty if that would be another contour, or the start point is not known. With `is_exact`, the start point
        is not rounded to the least increment of the control.

        >>> import contoursolve
        >>> program = "G00 X40. Z0.\\nG111 X100. A180. K-30. B120. P5.\\nG111 A180. W-20."
        >>> print(contoursolve.solve(program).answers[0].standing_alone())
        G00 Z0 X40.
        G111 X100. A180. K-30. B120. P5.
        """
        return str(from_above("standing_alone", self, is_exact=is_exact))

    def draw(self, **options: Any) -> Any:
        """Its picture, with the options of `contoursolve.draw`: a `Picture`, with `.svg` and `.png()`."""
        return from_above("draw", self, **options)

    @property
    def led(self) -> tuple[float, float]:
        """The way that steps have led before it where its place is not known, mm: from the place that was lost."""
        of_axes = zip(self.plane.axes, self.start.free, strict=True)
        first, second = (float(self.claim.before.axes[axis].beyond) if is_free else 0.0 for axis, is_free in of_axes)
        return first, second

    @property
    def assumptions(self) -> tuple[Assumption, ...]:
        """Assumptions on which the contour rests, of all that the control is taken to accept."""
        return self.claim.rests_on([AT_ITS_LIMIT] if self._has_bevel_at_its_limit() else [])

    @property
    def premises(self) -> Premises:
        """All that the contour depends on beside its words."""
        return Premises(self.claim.conventions, self.assumptions)

    def _has_bevel_at_its_limit(self) -> bool:
        """Whether a 45 degree bevel begins or ends at its virtual intersection, so that it runs along a line."""
        cut = {each.name: each for each in self.contour.elements} if self.contour else {}
        return any(
            dist(self.contour.points[corner.at], at) <= LENGTH
            for corner in self.profile.figure.corners
            if self.contour and corner.shape.share and corner.name in cut and corner.at in self.contour.points
            for at in (cut[corner.name].start, cut[corner.name].end)
        )


class _Notebook:
    """The findings about one contour, and the statuses that they give it."""

    def __init__(self) -> None:
        self.findings: list[Diagnostic] = []
        self.statuses: set[Status] = set()
        self._placed: dict[tuple[str, Span], list[Diagnostic]] = {}
        self._count = 0

    def add(self, finding: Diagnostic, status: Status | None = None) -> None:
        for each in self.findings[self._count :]:
            self._placed.setdefault((each.code, each.span), []).append(each)
        self._count = len(self.findings)
        if finding not in self._placed.get((finding.code, finding.span), ()):
            self.findings.append(finding)
        if status and finding.is_error:
            self.statuses.add(status)

    @property
    def status(self) -> Status:
        if not self.statuses:
            return Status.SOLVED
        return next(status for status in Status if status in self.statuses)


def examine(
    claim: ParsedContour,
    control: Control,
    policy: Policy,
    next_place: Callable[[], tuple[Decimal, Decimal] | None] = lambda: None,
    depth: Depth = Depth.FULL,
) -> Answer:
    """Everything there is to say about one contour, and its path if there is one.

    `next_place` tells where the line of the next block ends, if that is known; some facts are about it.
    """
    rules = control.rules
    context, notebook = context_of(claim, rules), _Notebook()
    _examine_words(context, claim, notebook)
    is_readable = not notebook.statuses
    # Where characters could not be read, which words the block has is not known.
    is_whole = not any(block.faults for block in claim.blocks) and not (claim.unknown and meant_words(claim))
    offences = offences_of(claim, rules) if is_whole and policy is not Policy.OFF else ()
    # What states or asks more than the control reads is not a block for the control yet.
    is_strict = policy is Policy.ENFORCE and not _is_extended(claim)
    for offence in offences:
        if not offence.rule.ignores:
            finding = explain_offence(context, offence, claim)
            status = Status.NO_SOLUTION if offence.rule.is_about_geometry else Status.REJECTED
            notebook.add(finding if is_strict else replace(finding, severity=Severity.WARNING), status)
    ignoring = [offence for offence in offences if offence.rule.ignores]
    profile, is_stated = _state_more(
        context, claim, read(claim, frozenset(offence.ignored for offence in ignoring)), next_place, notebook
    )
    is_readable = is_readable and is_stated
    for finding in explain_modes(context, claim):
        notebook.add(finding, Status.UNDERDETERMINED)
    # What rules refuse because nothing of it moves begins nowhere.
    is_still = is_whole and Status.REJECTED in notebook.statuses and not _says_where(claim)
    if not (profile.start.is_known and not profile.start.is_relative) and not is_still:
        notebook.add(explain_start(context, claim, profile.start), Status.UNDERDETERMINED)
    unmarked = (finding for block in claim.blocks for finding in explain_unmarked(context, block))
    notebook.findings += (*explain_skippable(context, claim), *unmarked)
    left_out = (claim.words.get(offence.ignored) for offence in ignoring)
    explained = spans_of(notebook.findings) | {word.span for word in left_out if word is not None}
    # What rules refuse of a chain is not solved without a word either.
    is_doubtful = any(claim.open_modes())
    is_refused = bool(claim.unread) or (claim.form.is_general and (is_doubtful or Status.REJECTED in notebook.statuses))
    for word in unused_words(claim, profile) if is_whole and not (is_refused or is_still) else ():
        # Whatever the rules say of it: nothing is dropped without a word.
        if word.span not in explained:
            notebook.add(report(context, ReadIssue.WORD_UNUSED, Basis.RULE, [word], form=claim.form.name))
    is_tried = depth is Depth.TRIAL and bool(notebook.statuses)
    if is_readable and not is_tried and not (claim.form.is_general and is_doubtful):
        if claim.form.is_general:
            profile = _without_cuts(context, profile, claim, analyse(assemble(profile)).free, notebook)
        profile, solution, alternatives = _examine_geometry(context, claim, profile, notebook, depth)
    else:
        solution, alternatives = SystemSolution(Status.REJECTED), None
    for offence in ignoring:
        finding = explain_ignored(context, offence, profile, solution)
        notebook.add(finding if is_strict else replace(finding, severity=Severity.WARNING), Status.REJECTED)
    notebook.findings += without_point(context, claim, notebook.findings)
    notebook.findings += start_without_point(context, claim, notebook.findings)

    is_path = bool(solution.points) and notebook.status in (Status.SOLVED, Status.OVERDETERMINED)
    contour = trace(profile, solution) if is_path else None
    if contour is not None:
        notebook.findings += explain_path(context, profile, solution, contour)
        if claim.directives:
            from contoursolve.diagnosis.off_path import explain_beyond  # noqa: PLC0415 - few blocks state more

            notebook.findings += explain_beyond(context, profile, solution, contour)
    touching = {remark.subject for remark in solution.remarks if remark.kind is NoteKind.TOUCHES}
    shown = {*profile.intersections} - touching
    chosen = (choice for choice in profile.choices if choice.given in claim.words)
    sides = {choice.point: choice.side for choice in chosen if choice.point in shown}
    return Answer(
        form=claim.form.name,
        lines=tuple(block.line for block in claim.blocks),
        claim=claim,
        status=notebook.status,
        plane=profile.plane,
        unit=profile.unit,
        start=profile.start,
        profile=profile,
        contour=contour,
        sides=sides if contour else {},
        error_bound=solution.error_bound,
        diagnostics=tuple(sorted(tell_points(context, claim, notebook.findings), key=rank)),
        read_by=ReadBy(control, policy),
        certificate=solution.certificate if contour else None,
        asked=tuple(answer_question(question, profile, solution) for question in profile.questions),
        alternatives=alternatives,
    )


MOST_CHOICES = 5
"""Points of which each may lie in two places; each doubles the number of solutions. Of more, in a long chain, only
the one that the words choose is worked out."""


def count_choices(profile: Profile) -> int:
    """The points that may lie in two places each, for all that the form says of it; 0 where the system is not
    determined or has no closed form."""
    points = _chosen_points(assemble(profile))
    return len(points - {choice.point for choice in profile.choices if not choice.given}) if points else 0


@lru_cache(maxsize=8192)
def _chosen_points(system: System) -> frozenset[str]:
    """The points that may lie in two places each; none where the system is not determined or has no closed form."""
    is_ordered = analyse(system).is_determined and is_closed(system)
    return frozenset(points_with_two_solutions(system) if is_ordered else ())


def is_rounded(answer: Answer) -> bool:
    """Whether it has a half circle that is one within the least increments: no circle of exactly the stated radius has
    its ends."""
    return any(finding.about is NoteKind.HALF_CIRCLE for finding in answer.diagnostics)


def list_alternatives(answer: Answer) -> Alternatives | None:
    """Every solution of a contour, the control's choice among them; None where nothing was solved, where the
    equations are solved one after the other without a choice, so that there is one, or where there are too many."""
    if (
        answer.alternatives is not None
        or answer.contour is None
        or is_rounded(answer)
        or not 0 < count_choices(answer.profile) <= MOST_CHOICES
    ):
        return answer.alternatives
    from contoursolve.solving import find_alternatives  # noqa: PLC0415 - see _solve

    return find_alternatives(answer.profile)


def _is_extended(claim: ParsedContour) -> bool:
    return bool(claim.directives) or any(word.is_asked for word in claim.words.values())


def _state_more(
    context: Context,
    claim: ParsedContour,
    profile: Profile,
    next_place: Callable[[], tuple[Decimal, Decimal] | None],
    notebook: _Notebook,
) -> tuple[Profile, bool]:
    """The profile with the facts that comments state, and whether all of them could be used."""
    if not profile.is_extended:
        return profile, True
    # Few blocks state more than their words.
    from contoursolve.geometry import apply_statements  # noqa: PLC0415

    extended, faults = apply_statements(profile, claim.directives, next_place)
    for fault in faults:
        about = ReadIssue.FACT_IMPOSSIBLE if fault.is_readable else ReadIssue.FACT_UNREADABLE
        notebook.add(report(context, about, Basis.RULE, [fault.word], reason=fault.message), Status.REJECTED)
    # With a fact that cannot be used, the others may speak of what is not drawn.
    stated = profile if faults else extended
    return stated if claim.needs_place else stated.with_free_start(), not faults


def problems(answer: Answer) -> list[Diagnostic]:
    """The errors and the warnings about a contour."""
    return [each for each in answer.diagnostics if each.severity is not Severity.INFO]


def may_be_suspected(answer: Answer, beside: Iterable[Block], around: Callable[[], Sequence[Block]]) -> bool:
    """Whether a contour is worth a second look: a turned one that crosses its axis, or runs away from the chuck
    somewhere, an arc of more than half a turn, a number that begins with a zero, a turning axis, a tool on the side of
    the material, a corner or a taper unlike all others in the blocks around, of which some are beside it."""
    contour, claim = answer.contour, answer.claim
    if contour is None:
        return False
    if any(each.about is ReadIssue.AXIS_CROSSED for each in answer.diagnostics):
        return True
    along = contour.plane.diameters.index(False) if any(contour.plane.diameters) else None
    for each in contour.elements:
        if along is not None and each.end[along] - each.start[along] > LENGTH:
            return True
        if isinstance(each, ArcSegment) and each.length > _WIDE * each.radius:
            return True
    if next(leading_words(claim), None) or next(turning_words(claim), None):
        return True
    if along is not None and is_compensated_inward(answer) is (contour.end[1 - along] > contour.start[1 - along]):
        return True
    return stands_out(claim, beside, around)


def is_compensated_inward(answer: Answer) -> bool | None:
    """True if the compensation of a turned contour leads the tool towards the axis on a way to the chuck; None where
    none is in force."""
    state = answer.claim.before
    if state.compensation not in (_LEFT, _RIGHT) or not any(state.plane.diameters):
        return None
    return (state.compensation == _LEFT) is state.plane.diameters[1]


_LEFT, _RIGHT = 41, 42


def leading_words(claim: ParsedContour) -> Iterator[Word]:
    """The words whose number begins with a zero that nobody writes."""
    for block in claim.blocks:
        if LEADING.search(block.text):
            yield from (word for word in block.words if word.has_point and LEADING.search(word.text))


def turning_words(claim: ParsedContour) -> Iterator[Word]:
    """The words of turning axes, which move nothing in the plane, with a number as an angle has it."""
    words = [word for block in claim.blocks for word in block.words if word.address in _TURNING and word.number]
    if words:
        stated = {each.span for each in claim.words.values()}
        yield from (word for word in words if word.span not in stated)


def may_have_odd_points(answer: Answer) -> bool:
    """Whether a path of lines has few of them aslant, or ends beside where it began."""
    contour = answer.contour
    lines = [each for each in contour.elements if not isinstance(each, ArcSegment)] if contour else []
    lines = [each for each in lines if not each.name.startswith("corner")]
    if contour is None or len(lines) < _FEWEST:
        return False
    slanted = sum(all(abs(a - b) > LENGTH for a, b in zip(each.start, each.end, strict=True)) for each in lines)
    apart = sum(abs(a - b) > LENGTH for a, b in zip(contour.start, contour.end, strict=True))
    return slanted in (1, 2) or (apart == 1 and not any(contour.plane.diameters))


_FEWEST = 4
"""Lines of a path in which one stands out."""

_WIDE = pi + 1e-3
"""Radians: half a turn is usual."""

LEADING = re.compile(r"[A-Za-z][ \t]*+[=(]?+[ \t]*+[+-]?0\d")
"""A word whose number begins with a zero that nobody writes, as in 08.4."""

_TURNING = "ABC"
"""Axes that turn on most machines."""

SUSPICIONS = "suspicions"
"""The name of the setting by which suspicions are told, or not."""


def answer_question(question: Question, profile: Profile, solution: SystemSolution) -> AskedValue:
    """The value of what is asked for, at the points of a solution."""
    if not solution.points:
        return AskedValue(question, None)
    scalars = {**solution.scalars, **scalars_of(solution.points), **solution.radii}
    return AskedValue(question, question.fact.implied(lookup(profile, scalars)))


def _examine_words(context: Context, claim: ParsedContour, notebook: _Notebook) -> None:
    """Characters, addresses and values, before any of them is given a meaning."""
    for finding in explain_spelling(context, claim):
        notebook.add(finding, Status.REJECTED)
    texts = {word.text for word in claim.words.values()}
    in_force = {word.text: word for word in claim.kept.values() if word.text not in texts}
    stated = (*claim.words.values(), *in_force.values())
    variables = [word for word in stated if word.number is None and not word.is_asked]
    if variables:
        named = next(filter(None, (_NAMED.search(word.text[len(word.address) :]) for word in variables)), None)
        value = f'"{named[0].upper()}=95."' if named is not None else "NAME=NUMBER"
        notebook.add(report(context, ReadIssue.VARIABLE, Basis.RULE, variables, stated=value), Status.UNDERDETERMINED)


_NAMED = re.compile(
    r"#(?:\d++|<[^<>]++>)|(?<![A-Z0-9_.#])(?:[RP]\d++|V\.[A-Z]++\.[A-Z_]\w*+|\$?+[A-Z_]{2}\w*+)(?![\w(\[])",
    re.IGNORECASE | re.ASCII,
)
"""The name of a variable in a word: a function has an argument behind it."""


def _says_where(claim: ParsedContour) -> bool:
    """Whether any word of a contour is a coordinate or an angle."""
    rows = (claim.lexicon.addresses.get(word.address) for word in claim.words.values())
    return any(row is not None and (row.axis or row.unit is Unit.DEGREE) for row in rows)


def _examine_geometry(
    context: Context, claim: ParsedContour, profile: Profile, notebook: _Notebook, depth: Depth
) -> tuple[Profile, SystemSolution, Alternatives | None]:
    """The system for all values, then its solution at the values of the block.

    A block that is refused is not solved; but whether its words agree is told. Where something is missing, so is what
    is said of the rest.
    """
    is_refused = bool(notebook.statuses & {Status.REJECTED, Status.NO_SOLUTION})
    structure = list(_examine_system(context, claim, profile, is_brief=depth is Depth.TRIAL))
    against: list[Diagnostic] = []
    if structure and profile.start.is_known and not (is_refused and profile.is_extended):
        from contoursolve.solving import said_twice  # noqa: PLC0415 - few blocks lack something

        compared = _each_word_once(said_twice(profile))
        for event in (each for each in compared if not is_refused or each.kind in _ABOUT_WORDS):
            finding = explain_result(context, event, profile)
            against += [finding] if isinstance(event, Refusal) else []
            notebook.add(finding)
            notebook.statuses.add(event.kind.status if isinstance(event, Refusal) else Status.OVERDETERMINED)
    for status, finding in structure:
        told = _behind(finding, against, claim)
        # What the equations say of a block that a rule has refused already explains, and counts once.
        notebook.add(replace(told, severity=Severity.INFO) if is_refused else told, status)
    is_solvable = not structure and profile.start.is_known
    is_open = is_solvable and is_refused and not profile.is_extended and _has_choice(profile)
    is_long = is_open and count_choices(profile) > MOST_CHOICES
    if is_open and not is_long:
        # Which contours the missing word could choose is worth knowing.
        profile, _, alternatives = _solve(profile, context, claim, notebook, depth)
        return profile, SystemSolution(Status.UNDERDETERMINED), alternatives
    if not is_solvable or is_long:
        return profile, SystemSolution(Status.UNDERDETERMINED), None
    profile, solution, alternatives = _solve(profile, context, claim, notebook, depth)
    for event in _each_word_once([*solution.refusals, *solution.remarks]):
        # A rule about the angles of the block has said that it has no vertex.
        is_said = event.kind in SINGULAR and Status.NO_SOLUTION in notebook.statuses
        if not is_refused or (event.kind in _ABOUT_WORDS and not is_said):
            notebook.add(explain_result(context, event, profile, alternatives))
            notebook.statuses.add(solution.status)
    return (profile, SystemSolution(solution.status), None) if is_refused else (profile, solution, alternatives)


def _each_word_once(events: Sequence[Refusal | Note]) -> list[Refusal | Note]:
    """The events about each word: where a word states several facts, such as both parts of a direction, what is most
    wrong of them."""
    said = [each for each in events if each.kind in OF_A_WORD and each.subject]
    worst: dict[str, Refusal | Note] = {}
    for each in said:
        known = worst.setdefault(each.subject, each)
        if (isinstance(each, Refusal), each.values.get("off_by_mm", 0.0)) > (
            isinstance(known, Refusal),
            known.values.get("off_by_mm", 0.0),
        ):
            worst[each.subject] = each
    return [each for each in events if each not in said or each is worst[each.subject]]


def _behind(finding: Diagnostic, against: Sequence[Diagnostic], claim: ParsedContour) -> Diagnostic:
    """The finding about missing words, told behind what contradicts itself: no word that is added can mend that."""
    first = min((each.span.line for each in against), default=0)
    if finding.about is not ReadIssue.UNDERDETERMINED or first <= finding.span.line:
        return finding
    return replace(finding, span=next((block.span for block in claim.blocks if block.line == first), finding.span))


def _without_cuts(
    context: Context, profile: Profile, claim: ParsedContour, open_: Sequence[str], notebook: _Notebook
) -> Profile:
    """The profile with the points in place that only cut a line or an arc in two, each of them told."""
    if not open_ or not profile.start.is_known:
        return profile
    from contoursolve.solving import place_cuts  # noqa: PLC0415 - few blocks leave something open

    profile, cuts = place_cuts(profile, open_)
    lines = {name: block for block, names in zip(claim.blocks, claim.makes, strict=True) for name in names}
    for element in profile.figure.path:
        if element.head in cuts:
            place = replace(context, place=lines[element.name].span)
            what = "a straight line" if isinstance(element, Line) else "an arc"
            notebook.add(report(place, ReadIssue.CUT_FREE, Basis.NUMERICAL, [], subject=element.head, what=what))
    return profile


def _solve(
    profile: Profile, context: Context, claim: ParsedContour, notebook: _Notebook, depth: Depth
) -> tuple[Profile, SystemSolution, Alternatives | None]:
    """The contour that the control makes, or the only one that there is; and the profile that it is one of."""
    is_chosen = not profile.is_extended and not _has_choice(profile)
    solution = solve(profile, is_proven=depth.is_proven) if is_chosen else None
    touches = solution is not None and any(remark.kind is NoteKind.TOUCHES for remark in solution.remarks)
    if solution is not None and not (touches and count_choices(profile) <= MOST_CHOICES):
        return profile, solution, None
    # Unusual combinations, open choices, and lines that touch as far as floats can tell.
    from contoursolve.solving import settle  # noqa: PLC0415

    settlement = settle(profile, is_blaming=depth is not Depth.TRIAL)
    open_ = [
        name
        for each in settlement.solution.refusals
        if each.kind in _LEAVING_OPEN and each.subject
        for name in each.subject.split(",")
    ]
    is_cut = claim.form.is_general and (settlement.loose or open_)
    placed = _without_cuts(context, profile, claim, settlement.loose or open_, notebook) if is_cut else profile
    if placed is not profile:
        profile, settlement = placed, settle(placed, is_blaming=depth is not Depth.TRIAL)
    elif is_cut and settlement.singular:
        from contoursolve.solving import said_twice  # noqa: PLC0415 - few blocks contradict themselves beside a cut

        # Where a circle is cut in two, its point has no place of its own; what contradicts itself beside it is wrong.
        against = tuple(each for each in said_twice(profile) if isinstance(each, Refusal))
        if against:
            return profile, SystemSolution(Status.CONFLICTING, refusals=against), None
    if settlement.singular and Status.REJECTED not in notebook.statuses:
        finding = explain_singular(context, settlement.singular, settlement.loose, profile)
        notebook.add(finding, Status.UNDERDETERMINED)
    return profile, settlement.solution, settlement.alternatives


_LEAVING_OPEN = LEAVING_FREE | refusals_about(Topic.SEARCH)
"""Refusals that tell of unknowns that words leave open at their values."""


def _has_choice(profile: Profile) -> bool:
    """Whether there are points between whose two places nothing chooses; what has no closed form may have several."""
    system, chosen = assemble(profile), {choice.point for choice in profile.choices}
    return not is_closed(system) or any(point not in chosen for point in points_with_two_solutions(system))


_ABOUT_WORDS = SAID_AGAIN | AGAINST


def _examine_system(
    context: Context, claim: ParsedContour, profile: Profile, *, is_brief: bool
) -> Iterator[tuple[Status, Diagnostic]]:
    """The reasons for which the facts alone, whatever their values, make no single contour."""
    system = assemble(profile)
    verdict = analyse(system)
    if not verdict.is_determined:
        yield Status.UNDERDETERMINED, explain_missing(context, profile, verdict, claim, is_brief=is_brief)
    by_name: dict[str, list[str]] = {}
    for corner in profile.figure.corners:
        # A size that stays in force has no word in the contour.
        own = [context.words.get(corner.size)]
        by_name.setdefault(corner.name, []).append(corner.size)
        if corner.size in profile.givens and profile.givens[corner.size].value < 0:
            finding = report(context, ReadIssue.CORNER_NEGATIVE, Basis.NUMERICAL, own, subject=corner.name)
            yield Status.NO_SOLUTION, finding
        if corner.after is None and corner.lands_parallel_to is None and corner.lands_on is None:
            finding = report(context, ReadIssue.CORNER_NOWHERE, Basis.STRUCTURAL, own, subject=corner.name)
            yield Status.UNDERDETERMINED, finding
    for name, sizes in by_name.items():
        if len(sizes) > 1:
            words = [word for size in sizes if (word := context.words.get(size))]
            yield Status.CONFLICTING, report(context, ReadIssue.CORNER_TWICE, Basis.STRUCTURAL, words, subject=name)


def rank(finding: Diagnostic) -> tuple[bool, int, int, bool, Span, str]:
    """By line, the worst first, and what follows from lines before, or is missing, after what is wrong; first of all
    points that are lost, on which everything behind rests."""
    follows = finding.about in (ReadIssue.POSITION_UNKNOWN, ReadIssue.UNDERDETERMINED)
    is_lost = finding.about is ReadIssue.POINT_LOST
    return not is_lost, finding.span.line, list(Severity).index(finding.severity), follows, finding.span, finding.code
