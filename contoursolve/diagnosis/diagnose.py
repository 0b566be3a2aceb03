"""Adds to findings why they are so and what to write instead, and which checks a contour went through."""

from collections.abc import Iterable, Iterator, Mapping, Sequence, Set
from functools import partial

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.attempt import Repair, Repairs
from contoursolve.diagnosis.certain_slips import MendedText, about, certain_slips
from contoursolve.diagnosis.edits import Edit, EditKind, edited, edits_of_words
from contoursolve.diagnosis.examine import SUSPICIONS, Answer, Depth, Policy, examine, problems, rank
from contoursolve.diagnosis.explain import (
    AGAINST,
    LEAVING_FREE,
    SAID_AGAIN,
    SINGULAR,
    absent_advice,
    context_of,
    explain_missing,
    explain_result,
    spans_of,
)
from contoursolve.diagnosis.fix_text import fixes_of, with_fixes
from contoursolve.diagnosis.names_in_program import named_in_program
from contoursolve.diagnosis.reasons import conflict_reasons, freedom_reasons, identity, path_reasons
from contoursolve.diagnosis.repairs import find_repairs
from contoursolve.diagnosis.slips_around import touches
from contoursolve.diagnosis.smallest_sets import NO_SETS, SmallestSets, TiedSet, is_exact, smallest_sets, stating_givens
from contoursolve.diagnosis.vocabulary import names_like
from contoursolve.diagnosis.window import Window
from contoursolve.diagnosis.wording import SHOWN, count, join, length_text
from contoursolve.diagnostics import (
    Applicability,
    Basis,
    Diagnosis,
    Diagnostic,
    Freedom,
    Label,
    Layer,
    Severity,
    Span,
    Tie,
    Verdict,
)
from contoursolve.gcode import FACT, Block, FaultKind, Word
from contoursolve.geometry import Fact, Profile, System, Unit, assemble
from contoursolve.reading import Control, ParsedContour, ReadIssue, read
from contoursolve.solving import (
    AffineFacts,
    NoteKind,
    RefusalKind,
    Ties,
    Topic,
    affine_facts,
    analyse,
    compare_affine,
    decompose,
    events_about,
    find_ties,
    lookup,
    opposes,
    refusals_about,
    runs_against,
    scalars_of,
    spare_of,
)


def diagnose(
    answer: Answer,
    control: Control,
    policy: Policy,
    following: Iterable[Block] = (),
    window: Window | None = None,
) -> Answer:
    """The answer with a diagnosis; its findings with their reasons, the first one with the repairs. Slips that are
    certain are mended in thought, so that what else is wrong is told as well. `following` are the next blocks."""
    following = tuple(following)
    known = _Diagnosed.of(answer, control, policy, window)
    edits = certain_slips(answer, window) if window is not None else ()
    if not edits or window is None:
        return known.answer
    joined = control.find(
        [*MendedText(answer.claim.blocks, edits).read(), *following], 0, answer.claim.before, control.modes
    )
    count = len(answer.claim.blocks)
    more = len(joined.blocks) - count if isinstance(joined, ParsedContour) else -1
    if not isinstance(joined, ParsedContour) or more < 0:
        return known.answer
    # With its comma, a corner joins the blocks behind.
    text = MendedText((*answer.claim.blocks, *following[:more]), edits, count)
    mended = examine(joined, control, policy, depth=Depth.FINDINGS)
    if not problems(mended) or any(each.about in _GRAMMAR for each in mended.diagnostics):
        # Where something still cannot be read, nothing more is known.
        if any(known.repairs.values()):
            return known.answer
        told, others = _certain(known.answer, text)
        return replace(known.answer, diagnostics=tuple(sorted((*told, *others), key=rank)))
    around = replace(window, own=joined.blocks, behind=window.behind[more:])
    beside = _Diagnosed.of(mended, control, policy, around)
    if known.cost < float("inf") and known.cost <= beside.cost + _CERTAIN * len(edits):
        return known.answer
    return _with_both(known.answer, text, beside)


_UNREAD = (ReadIssue.FACT_UNREADABLE, ReadIssue.FACT_IMPOSSIBLE)
"""Findings about facts that are compared with nothing."""

_CUT = "no change that was tried mends it alone; not all could be tried"
"""The note where a search for fixes ended before all that it thought of was tried."""

_CERTAIN = 1.5
"""The cost of a slip that is certain beside another one: two are less likely than one."""


def _certain(answer: Answer, text: MendedText, note: str = "") -> tuple[list[Diagnostic], list[Diagnostic]]:
    """The findings about what is certain, each with its fix and with a note if there is one; and the others."""
    told, others, left = list[Diagnostic](), list[Diagnostic](), [*text.edits]
    for finding in answer.diagnostics:
        own = tuple(edit for edit in about(finding, text.edits) if edit in left)
        if not own:
            others.append(finding)
            continue
        left = [edit for edit in left if edit not in own]
        repair = Repair(own, edited(text.own, own), Applicability.CHANGES_CONTOUR, None, 0.0, slips=(None,) * len(own))
        new = with_fixes(replace(finding, notes=()), answer, [repair])
        notes = [note.format(join([edit.text for edit in own]))] if note else ()
        told.append(replace(new, notes=(*new.notes, *notes)))
    return told, others


def _with_both(answer: Answer, text: MendedText, beside: "_Diagnosed") -> Answer:
    """An answer with what is certain, each with its fix, and with what is wrong beside it."""
    findings, _ = _certain(answer, text, "the contour is checked as if {} stood there")
    for number, finding in enumerate(beside.answer.diagnostics):
        fixes = fixes_of(beside.answer, beside.repairs.get(number, ()), text)
        findings.append(replace(text.told(finding), fixes=fixes))
    is_whole = len(text.own) == len(text.blocks)
    return replace(answer, diagnostics=tuple(sorted(findings, key=rank)), mended=beside.answer if is_whole else None)


class _Diagnosed(Struct, frozen=True):
    """An answer with a diagnosis, and the repairs that its findings have, by their number; `cost` is that of the
    edits of the best one that undoes one slip."""

    answer: Answer
    repairs: Mapping[int, Sequence[Repair]]
    cost: float

    @classmethod
    def of(
        cls,
        answer: Answer,
        control: Control,
        policy: Policy,
        window: Window | None,
    ) -> "_Diagnosed":
        """The diagnosis of an answer as it is."""
        profile = answer.profile
        is_readable = not any(block.faults for block in answer.claim.blocks)
        affine = affine_facts(profile, (*profile.facts, *profile.ignored))
        found = None
        if answer.start.is_known and (is_readable or affine is None):
            is_told = any(each.is_error or each.about in SAID_AGAIN | _ABOUT_RADII for each in answer.diagnostics)
            found = find_ties(profile, is_told=is_told)
        part = partial(answer.read_by.part, answer.claim)
        sets = smallest_sets(part, found, profile) if found is not None else NO_SETS
        answer = replace(answer, diagnostics=tuple(_compared_alone(answer, sets, control)))
        freedoms = tuple(_freedoms(profile, affine)) if is_readable else ()
        # What a contour needs and nobody reads here is no slip.
        repairs = Repairs((), is_complete=False)
        is_slip = all(_is_like_own(word, control) for word in answer.claim.unread)
        if is_slip and all(each.about is not ReadIssue.NOT_READ for each in answer.diagnostics):
            repairs = find_repairs(answer, control, window)
        diagnosis = Diagnosis(
            layers=list_layers(answer, policy),
            freedoms=freedoms,
            ties=tuple(_tie(answer, found, each) for each in sets.found),
            ties_complete=is_readable
            and sets.is_complete
            and all(each.about not in _UNREAD for each in answer.diagnostics),
            repairs_complete=repairs.is_complete,
        )
        findings = []
        for finding in answer.diagnostics:
            reasons = tuple(_reasons(answer, affine, found, diagnosis, finding))
            labels = _start_labels(answer) if reasons and finding.about in _FROM_START else ()
            findings.append(replace(finding, notes=finding.notes + reasons, labels=finding.labels + labels))
        if repairs.repairs and any(edit.address == "G" for edit in repairs.repairs[0].edits):
            # What is unknown to this contour may be known to that one.
            first = "; ".join(map(str, repairs.repairs[0].edits))
            findings = [
                replace(each, help=first) if each.about is ReadIssue.UNKNOWN_ADDRESS else each for each in findings
            ]
        findings = _with_able(findings, answer, control, repairs)
        # The rules of a control whose words are facts of all kinds are meant as they are.
        main = _main(findings, is_extended=profile.is_extended and not answer.claim.form.is_general)
        if main is None and repairs.repairs:
            # What is almost a number depends on nothing.
            places = [each.span if each.about is ReadIssue.VARIABLE else None for each in findings]
            edits = repairs.repairs[0].edits
            main = next((at for at, span in enumerate(places) if span and all(_writes(e, span) for e in edits)), None)
        fixing = dict[int, Sequence[Repair]]()
        if main is not None:
            for number in (main, *_both(findings)):
                fixing[number] = repairs.repairs
                findings[number] = with_fixes(findings[number], answer, fixing[number])
            if repairs.is_cut and not repairs.repairs:
                findings[main] = replace(
                    findings[main], notes=(*findings[main].notes[:1], _CUT, *findings[main].notes[1:])
                )
        alone = (each.cost_of_edits for each in repairs.repairs if not each.is_double)
        cost = min(alone, default=float("inf"))
        return cls(replace(answer, diagnostics=tuple(findings), diagnosis=diagnosis), fixing, cost)


def _writes(edit: Edit, span: Span) -> bool:
    """Whether an edit writes something else at a place."""
    return edit.kind is EditKind.CHANGE and touches(edit, span)


def _is_like_own(word: Word, control: Control) -> bool:
    """Whether a word that nobody reads here is almost the name of one that the control has."""
    return any(names_like(word.text.strip(), control.modes.lexicon, control.modes.syntax.codes))


def _with_able(findings: list[Diagnostic], answer: Answer, control: Control, repairs: Repairs) -> list[Diagnostic]:
    """The findings; those that ask for words without the ones that no repair adds, where some add any and all have been
    tried. What is added in place of other words counts only where nothing is added alone."""
    claim, edits = answer.claim, [repair.edits for repair in repairs.repairs]
    alone = [each for each in edits if all(edit.kind is EditKind.ADD for edit in each)]
    adding = (edit for each in alone or edits for edit in each if edit.kind is EditKind.ADD and edit.address != "G")
    added = {(edit.address, edit.line) for edit in adding}
    if not (added and repairs.has_tried_all) or claim.form.is_general:
        return findings
    places = ((name, address, claim.blocks[index].line) for name, (address, index) in claim.vocabulary.items())
    unable = {name for name, address, line in places if (address, line) in repairs.tried - added}
    context, rules = context_of(claim, control.rules), {rule.code: rule for rule in control.rules}
    found = []
    for finding in findings:
        if finding.about is ReadIssue.UNDERDETERMINED:
            verdict = analyse(assemble(answer.profile))
            message = explain_missing(context, answer.profile, verdict, claim, unable).message
            found.append(replace(finding, message=message))
        else:
            advice = absent_advice(rules.get(finding.code), {address for address, _ in added})
            found.append(replace(finding, help=advice) if advice else finding)
    return found


def _both(findings: list[Diagnostic]) -> list[int]:
    """The indices of the findings about what is missing and about what contradicts itself, where a contour has both: a
    repair mends either."""
    errors = {number: each for number, each in enumerate(findings) if each.is_error}
    missing = [number for number, each in errors.items() if each.about in _MISSING]
    against = [number for number, each in errors.items() if each.about in AGAINST]
    return [*missing, *against] if missing and against else []


_MISSING = {ReadIssue.UNDERDETERMINED, ReadIssue.CORNER_NOWHERE, *LEAVING_FREE}


def mend_points(answer: Answer, control: Control) -> Answer:
    """The answer; its findings that a number lacks its point with what they were meant to be, each about its words."""
    repairs = find_repairs(answer, control).repairs
    findings, is_telling = [], control.modes.settings.get(SUSPICIONS) != "off"
    for finding in answer.diagnostics:
        spans = spans_of([finding], ReadIssue.POINT_MISSING)
        own = [repair for repair in repairs if any(edit.span in spans for edit in repair.edits)]
        told = with_fixes(finding, answer, own)
        is_doubted = is_telling and finding.about is ReadIssue.POINT_MISSING and _is_tiny(answer, spans)
        findings.append(replace(told, severity=Severity.WARNING) if is_doubted else told)
    return replace(answer, diagnostics=tuple(findings))


def _is_tiny(answer: Answer, spans: Set[Span]) -> bool:
    """Whether one word alone lacks its point, and counts so few least increments that nobody means that."""
    words = [word for word in answer.claim.words.values() if word.span in spans]
    return len(words) == 1 and 0 < abs(float(words[0].number or 0)) < _FEW_INCREMENTS


_FEW_INCREMENTS = 100


def _main(findings: list[Diagnostic], *, is_extended: bool) -> int | None:
    """The index of the finding that the repairs go with: the first one; with further facts the worst one, because
    the rules only warn there."""
    severities = [Severity.ERROR, Severity.WARNING]
    for group in [[each] for each in severities] if is_extended else [severities]:
        for index, finding in enumerate(findings):
            if (
                finding.severity in group
                and finding.about not in _NOT_MENDED
                and not (is_extended and finding.about is None)
            ):
                return index
    return None


_NOT_MENDED = (
    ReadIssue.START_IN_INCREMENTS,
    ReadIssue.AXIS_CROSSED,
    ReadIssue.MODE_UNKNOWN,
    ReadIssue.VARIABLE,
)
"""Matters that no repair of the contour is about: its start point, a path that may be meant, and what is right but not
known: without a corner, it would be another contour that is as little known."""

_FROM_START = {ReadIssue.WORD_IGNORED, *refusals_about(Topic.WORD, Topic.DIRECTION)}


def _start_labels(answer: Answer) -> tuple[Label, ...]:
    """The words that set the start point, on the lines before the contour."""
    profile, before = answer.profile, answer.claim.before
    labels: dict[Span, str] = {}
    for axis, value, is_diameter in zip(profile.plane.axes, profile.start.values, profile.plane.diameters, strict=True):
        span = before.axes[axis].span
        if span and value is not None and 0 < span.line < answer.lines[0]:
            text = "start point used here"
            if is_diameter:
                text = f"start point used here, radius {length_text(float(value), profile.unit)}"
            labels.setdefault(span, text)
    return tuple(Label(span, text) for span, text in labels.items())


def _tie(answer: Answer, ties: Ties | None, words: TiedSet) -> Tie:
    named = dict.fromkeys(filter(None, (answer.profile.givens[name].word for name in words.givens)))
    return Tie(
        addresses=tuple(word.text if word.address == FACT else word.address for word in named),
        identity=identity(answer.profile, words.facts),
        # Below the rounding of the arithmetic, which is another one on other machines.
        off_by_mm=round(words.off, 12),
        is_conflict=words.is_conflict or _is_turned(answer, ties, words.facts),
    )


def _compared_alone(answer: Answer, sets: SmallestSets, control: Control) -> list[Diagnostic]:
    """The findings of an answer; those that compare a word with others compare it with the others of a smallest set,
    if one of these tells of it. What is wrong with these others is told by itself: of a word that agrees with all that
    is not blamed nothing is told."""
    compared = [number for number, each in enumerate(answer.diagnostics) if each.about in SAID_AGAIN | _ABOUT_RADII]
    if not compared or not sets.found:
        return [*answer.diagnostics]
    context, blamed, used = context_of(answer.claim, control.rules), set[Span](), list[TiedSet]()
    found: dict[int, Diagnostic | None] = dict(enumerate(answer.diagnostics))
    stated = [answer.profile.givens[name].word for name in stating_givens(answer.profile)]
    places = {word.span: place for place, word in enumerate(stated) if word is not None}
    spans = {number: _spans(answer.diagnostics[number]) for number in compared}

    def order(number: int) -> tuple[int, list[int]]:
        return len(spans[number]), sorted(places.get(span, 0) for span in spans[number])

    # The order of the words does not tell which of them is blamed first.
    for number in sorted(compared, key=order):
        finding, own = answer.diagnostics[number], spans[number]
        able = [each for each in (*sets.found, *sets.beside) if each not in used and _tells(each, finding, own)]
        best = min(able, key=lambda each: (len(blamed & _places(each)), not each.is_conflict), default=None)
        if best is not None and best.event is not None and best.event.kind is finding.about:
            used.append(best)
            found[number] = explain_result(context, best.event, best.profile)
            blamed |= _places(best) if finding.about in _ABOUT_RADII else {finding.span}
        elif finding.is_error:
            # What agrees with all that is not blamed follows from what is; the first one is always told.
            if blamed and best is not None and not best.is_conflict:
                found[number] = None
            blamed.add(finding.span)
        elif _is_against(sets, finding.span):
            found[number] = None
    return [each for each in found.values() if each is not None]


def _spans(finding: Diagnostic) -> set[Span]:
    return {finding.span, *(label.span for label in finding.labels)}


def _is_against(sets: SmallestSets, span: Span) -> bool:
    return any(each.is_conflict and span in _places(each) for each in sets.found)


def _places(words: TiedSet) -> set[Span]:
    stated = (words.profile.givens[name].word for name in words.givens)
    return {word.span for word in stated if word is not None}


def _tells(words: TiedSet, finding: Diagnostic, own: Set[Span]) -> bool:
    """Whether a set tells of the same matter as a finding, about the same word; of two points of one circle, whether it
    is about some of the words."""
    if words.event is None or (finding.about in _ABOUT_RADII) != (words.event.kind in _ABOUT_RADII):
        return False
    if finding.about in _ABOUT_RADII:
        return _places(words) <= own
    given = words.profile.givens.get(words.event.subject)
    return given is not None and given.word is not None and given.word.span == finding.span


def _is_turned(answer: Answer, ties: Ties | None, facts: Sequence[Fact]) -> bool:
    """Whether a line runs against the angle of one of the facts that say the same: as the contour runs, or where these
    facts alone put its ends."""
    profile, contour = answer.profile, answer.contour
    rows = ties.rows if ties is not None else None
    known = rows.fixed_by(facts) if rows is not None and rows.places.keys() >= {*facts} else {}
    return runs_against(facts, profile, lookup(profile, known | scalars_of(contour.points if contour else {})))


_ABOUT_RADII = events_about(Topic.RADII)


def _reasons(
    answer: Answer,
    affine: AffineFacts | None,
    ties: Ties | None,
    diagnosis: Diagnosis,
    finding: Diagnostic,
) -> Iterator[str]:
    profile = answer.profile
    if affine is not None and ties is not None and is_exact(ties) and finding.about in _ABOUT_TIES:
        words = ((each.unit, each.word) for each in profile.givens.values() if each.word)
        unit = next((unit for unit, word in words if word.span == finding.span), Unit.MM)
        is_opposite = opposes(finding.values, unit)
        for circuit in ties.circuits.found:
            addresses = {word.address for word in profile.words_of(circuit.facts)}
            about = addresses if finding.about in SINGULAR else addresses.intersection(finding.addresses)
            if about and about <= {*finding.addresses}:
                is_about_direction = is_opposite or _is_turned(answer, ties, circuit.facts)
                trusted = answer.claim.trusted
                yield from conflict_reasons(profile, affine, circuit, trusted, is_about_direction=is_about_direction)
    if finding.about in _ABOUT_FREEDOM:
        lost = _points_lost(profile, affine) if affine is not None else set()
        yield from freedom_reasons(profile, [each for each in diagnosis.freedoms if each.point not in lost])
    yield from path_reasons(profile, affine, finding)
    if finding.about in _ABOUT_RADII:
        identities = (tie.identity for tie in diagnosis.ties)
        yield from (each for each in identities if 0 < len(each) <= SHOWN)


def _freedoms(profile: Profile, affine: AffineFacts | None) -> Iterator[Freedom]:
    """The points that can still move: of lines alone, whatever these say; else in a drawing, where one is found."""
    from contoursolve.solving import first_drawing  # noqa: PLC0415 - few blocks lack words

    if affine is not None:
        yield from affine.freedoms()
    elif not analyse(assemble(profile)).is_determined:
        drawing = first_drawing(profile)
        yield from drawing.freedoms() if drawing is not None else ()


def _points_lost(profile: Profile, affine: AffineFacts) -> set[str]:
    """The points for which lines that are parallel leave no place: nothing of them can move."""
    parallel = (each for each in compare_affine(profile, affine) if each.kind in SINGULAR - LEAVING_FREE)
    return {name.rpartition(".")[0] for each in parallel for name in each.subject.split(",")}


_ABOUT_TIES = {ReadIssue.WORD_IGNORED, *events_about(Topic.WORD, Topic.SINGULAR)}
_ABOUT_FREEDOM = {ReadIssue.UNDERDETERMINED, *LEAVING_FREE}


def list_layers(answer: Answer, policy: Policy) -> tuple[Layer, ...]:
    """The six checks of a contour, in order. A check that could not run has found nothing and passed nothing."""
    claim = answer.claim
    # Further facts belong to the profile that was solved; those of ignored words are left out there as well.
    whole = read(claim, frozenset(fact.given for fact in answer.profile.ignored))
    whole = answer.profile if whole.is_extended else whole
    grammar = [each for each in answer.diagnostics if each.about in _GRAMMAR]
    besides = (*_GRAMMAR, ReadIssue.START_IN_INCREMENTS)
    refused = [each for each in problems(answer) if each.basis is Basis.RULE and each.about not in besides]
    layers = [_layer("grammar", bool(grammar), f"{count(len(claim.blocks), 'block')}, every character")]
    if any(block.faults for block in claim.blocks):
        layers.append(Layer("rules", Verdict.NOT_RUN, "not every word could be read"))
    elif policy is Policy.OFF:
        layers.append(Layer("rules", Verdict.NOT_RUN, "switched off"))
    else:
        layers.append(_layer("rules", bool(refused), "which words may stand together"))
    blocked = "not every word could be read" if grammar else ""
    if blocked:
        return (*layers, *(Layer(name, Verdict.NOT_RUN, blocked) for name in _EQUATIONS))
    system = assemble(whole)
    return (*layers, *_equations(answer, whole, system))


_GRAMMAR = (
    *FaultKind,
    ReadIssue.REPEATED_ADDRESS,
    ReadIssue.UNKNOWN_ADDRESS,
    ReadIssue.NOT_READ,
    ReadIssue.VARIABLE,
    ReadIssue.FACT_UNREADABLE,
    ReadIssue.FACT_IMPOSSIBLE,
    ReadIssue.ASKED_NOTHING,
    ReadIssue.VALUE_TOO_LARGE,
)
_EQUATIONS = ("structure", "generic rank", "values", "geometry")


def _equations(answer: Answer, profile: Profile, system: System) -> list[Layer]:
    parts, verdict = decompose(system), analyse(system)
    size = f"{count(len(system.facts), 'equation')}, {count(len(system.unknowns), 'unknown')}"
    # A point of a circle may be given besides its centre: the control compares the radii, and so do we.
    spare = spare_of(system)
    is_over = any(not fact.circle for fact in spare)
    if spare and not is_over:
        size += f", {count(len(spare), 'check')}"
    layers = [_layer("structure", bool(parts.under_unknowns or (parts.over_facts and is_over)), size)]
    rank = f"rank {verdict.rank} of {len(system.unknowns)}, exact"
    # A condition on points and not on words says nothing to a reader.
    if verdict.condition and verdict.condition != "1" and "." not in verdict.condition:
        rank += f"; determined unless {verdict.condition} = 0"
    layers.append(_layer("generic rank", bool(verdict.free or is_over), rank))
    blocked = ""
    if not profile.start.is_known:
        blocked = "the start point is not known"
    elif verdict.free:
        blocked = "words are missing"
    elif any(each.basis is Basis.STRUCTURAL for each in answer.diagnostics):
        blocked = "a corner or a choice is not determined"
    numerical = [each for each in answer.diagnostics if each.basis is Basis.NUMERICAL]
    about_values = [each for each in numerical if each.about in _ABOUT_VALUES]
    found_any = _layer("values", bool(about_values), "regular at these values, and words agree")
    if blocked:
        values = found_any if about_values else Layer("values", Verdict.NOT_RUN, blocked)
        return [*layers, values, Layer("geometry", Verdict.NOT_RUN, blocked)]
    layers.append(found_any)
    if any(each.basis is Basis.RULE and each.is_error for each in answer.diagnostics):
        return [*layers, Layer("geometry", Verdict.NOT_RUN, "a rule refuses the block")]
    found = any(each.is_error and each not in about_values for each in numerical)
    if about_values and not found and answer.contour is None:
        return [*layers, Layer("geometry", Verdict.NOT_RUN, "the points are not determined")]
    return [*layers, _layer("geometry", found, "intersections exist, direction of travel, room for corners")]


_ABOUT_VALUES = (
    *SINGULAR,
    *SAID_AGAIN,
    RefusalKind.POINT_IS_START,
    *refusals_about(Topic.RADII),
    ReadIssue.FACTS_SINGULAR,
    NoteKind.SENSITIVE,
)


def _layer(name: str, has_found: bool, remark: str) -> Layer:
    return Layer(name, Verdict.FOUND if has_found else Verdict.PASSED, remark)


def with_words(answer: Answer, *, drop: Iterable[str], add: Iterable[str], change: Mapping[str, str]) -> Answer:
    """The answer with other words in its blocks; see `Answer.with_words`."""
    control, policy = answer.read_by.control, answer.read_by.policy
    claim = answer.read_by.read(answer.claim, edits_of_words(answer.claim.blocks, drop, add, change))
    if claim is None:
        raise ValueError("with these words the blocks are read as another contour, or as none")
    found = examine(claim, control, policy)
    if found.diagnostics:
        found = diagnose(found, control, policy)
        found = replace(found, diagnostics=named_in_program(found.diagnostics, claim, found.profile))
    return found
