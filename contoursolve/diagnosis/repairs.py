"""Repairs: every smallest change of a block's words that the control accepts and that has a
contour. Each one is applied to the text, read, checked and solved again before it is offered."""

from collections.abc import Iterable, Iterator, Set
from decimal import ROUND_HALF_EVEN, Decimal
from itertools import chain, combinations, pairwise, product
from math import copysign, sqrt

from msgspec.structs import replace

from contoursolve.diagnosis.attempt import Repairs, Trial
from contoursolve.diagnosis.drafts import (
    OF_CORNERS,
    commas,
    fitting,
    has_faults,
    marked,
    moving,
    unreadable,
)
from contoursolve.diagnosis.edits import AT_LEAST, PLACEHOLDER, Edit, EditKind, Why, add, change, drop, write_word
from contoursolve.diagnosis.examine import Answer, Policy, examine, problems
from contoursolve.diagnosis.explain import spans_of
from contoursolve.diagnosis.ranking import choose_repairs
from contoursolve.diagnosis.slip_kinds import explained
from contoursolve.diagnosis.slips_around import OPEN
from contoursolve.diagnosis.spelling import torn_codes
from contoursolve.diagnosis.stated_values import Geometry
from contoursolve.diagnosis.subsets import (
    DropSets,
    blamed_spans,
    blocks_at_fault,
    corners_at_fault,
    find_drop_sets,
    is_clean,
    smallest_changes,
    words_of,
)
from contoursolve.diagnosis.typo_fixes import forgotten_codes, point_slips
from contoursolve.diagnosis.window import Window, alone
from contoursolve.diagnostics import Diagnostic, Span
from contoursolve.gcode import FaultKind
from contoursolve.geometry import Given, Unit
from contoursolve.reading import Control, Effect, ParsedContour, ReadIssue, check
from contoursolve.solving import (
    Circuit,
    Status,
    Topic,
    refusals_about,
)


def find_repairs(
    answer: Answer,
    control: Control,
    window: Window | None = None,
) -> Repairs:
    """The repairs of a contour that was refused, or in which a word is ignored.

    A repair leaves no error and no warning. None of them contains another one. `window` are the blocks around. Where
    nothing is wrong but that the start is not known, G90 and G91 stay as they are, and a repair tells where it is.
    """
    found, start = _find_repairs(answer, control, window), answer.start
    if start.is_known and not start.is_relative:
        return found
    is_lost = all(each.about is ReadIssue.POSITION_UNKNOWN for each in problems(answer))
    rows = control.modes.codes.values()
    codes = {code.text for code in rows if code.effect in (Effect.ABSOLUTE, Effect.INCREMENTAL)}
    kept = tuple(
        each
        for each in found.repairs
        if not is_lost
        or (codes.isdisjoint(edit.old.strip() for edit in each.edits) and each.contour and not any(each.contour.free))
    )
    return replace(found, repairs=kept, is_complete=False, is_cut=found.is_cut and not is_lost)


def _find_repairs(
    answer: Answer,
    control: Control,
    window: Window | None,
) -> Repairs:
    answer = _alone(answer, control)
    # No change of words closes a comment, and what leaves a warning is no repair.
    is_open = any(each.kind is FaultKind.COMMENT_NOT_CLOSED for block in answer.claim.blocks for each in block.faults)
    if is_open or (not answer.start.is_known and _waits(answer)):
        return Repairs((), is_complete=False)
    if window is None or not window.begins_at(answer.claim.before.start()):
        window = alone(answer, control)
    trial = Trial(answer, control, window)
    if answer.start.is_known and not problems(answer):
        return choose_repairs(trial, [point_slips(answer)])
    drop_sets = DropSets((), is_complete=False)
    stages: Iterable[Iterable[tuple[Edit, ...]]] = ()
    # With letters in its number a code is another one, which nobody has written.
    is_meant = not torn_codes(answer.claim)
    if is_meant and answer.profile.is_extended:
        # Few blocks state more than their words.
        from contoursolve.diagnosis.drafts_beside_facts import further_drafts  # noqa: PLC0415

        stages = further_drafts(answer, trial)
    elif is_meant and answer.start.is_known:
        drop_sets = find_drop_sets(answer, control)
        stages = _of_words(answer, trial, drop_sets)
    repairs = choose_repairs(trial, stages if answer.start.is_known else ())
    is_complete = repairs.is_complete and drop_sets.is_complete and not has_faults(answer.claim)
    return replace(repairs, is_complete=is_complete)


def _of_words(answer: Answer, trial: Trial, drop_sets: DropSets) -> Iterator[Iterable[tuple[Edit, ...]]]:
    """The stages of drafts for a contour whose words are all that it states, simplest first."""
    claim, whole = answer.claim, trial.geometry
    blamed = blamed_spans(answer)
    alone = [each for each in drop_sets.found if len(each) == 1 and {claim.words[name].span for name in each} <= blamed]
    # What makes a refused combination legal is searched for; of a legal one, any word at fault may be too much.
    first = chain.from_iterable(_legal_sets(answer, trial.control, whole, forced) for forced in unreadable(claim))
    then = _dropping(answer, alone)
    if answer.status in (Status.NO_SOLUTION, Status.CONFLICTING, Status.SOLVED) and not whole.conflicts:
        yield _of_circles(answer, trial)
    yield from (commas(answer), marked(answer), fitting(answer))
    yield _lost_ends(answer)
    yield forgotten_codes(answer, trial.control.modes)
    changes = (
        _values(answer, whole),
        *((first, then) if answer.status is Status.REJECTED else (then, first)),
        _dropping(answer, drop_sets.found),
    )
    yield from (moving(claim, stage) for stage in changes)
    yield _lawful_alone(answer, trial)


def _alone(answer: Answer, control: Control) -> Answer:
    """The answer; of a contour that lacks words, and that is refused for what follows, that to its own blocks alone:
    what it lacks is to be mended."""
    claim = answer.claim
    if answer.status is not Status.REJECTED or all(each.about not in OPEN for each in answer.diagnostics):
        return answer
    found = control.find(claim.blocks, 0, claim.before, control.modes)
    if not isinstance(found, ParsedContour) or not found.circumstances < claim.circumstances:
        return answer
    return examine(found, control, Policy.ENFORCE)


def _waits(answer: Answer) -> bool:
    """Whether something took the start away that it had: that is to be mended first."""
    before = answer.claim.before
    return any(before.axes[axis].value is None and before.axes[axis].span is not None for axis in before.plane.axes)


def _lawful_alone(answer: Answer, trial: Trial) -> Iterator[tuple[Edit, ...]]:
    """Words that make a refused block legal only as it is read with them."""
    if answer.status is Status.REJECTED and not has_faults(answer.claim) and len(answer.claim.blocks) > 1:
        from contoursolve.diagnosis.drafts_beside_facts import lawful  # noqa: PLC0415

        yield from (edits for edits in lawful(answer, trial) if edits[0].kind is EditKind.ADD)


def _lost_ends(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """A coordinate added to a line by its angle alone, of an axis that the line behind it does not state: without it,
    the control asks that line for the end of both."""
    claim = answer.claim
    if answer.status is not Status.REJECTED or has_faults(claim):
        return
    rows = claim.lexicon.addresses
    for block, behind in pairwise(claim.blocks):
        stated = [rows[word.address] for word in block.words if word.address in rows]
        if [row.unit for row in stated] != [Unit.DEGREE]:
            continue
        for axis in claim.before.plane.axes:
            if behind.find(axis) is None and any(map(behind.find, claim.before.plane.axes)):
                yield (Edit(EditKind.ADD, axis, text=claim.lexicon.spell(axis, PLACEHOLDER), line=block.line),)


def _dropping(answer: Answer, sets: Iterable[frozenset[str]]) -> Iterator[tuple[Edit, ...]]:
    """The words of each set dropped, besides what must be dropped or corrected in any case."""
    claim = answer.claim
    if has_faults(claim):
        return
    for forced in unreadable(claim):
        done = {edit.span for edit in forced}
        for names in sets:
            words = [word for name in sorted(names) for word in words_of(claim, name) if word.span not in done]
            yield (*forced, *map(drop, words))


def _legal_sets(
    answer: Answer, control: Control, whole: Geometry, forced: tuple[Edit, ...]
) -> Iterator[tuple[Edit, ...]]:
    """Words to drop and to add besides what is done in any case: every smallest set that makes the combination legal,
    and for a legal one what may be dropped or exchanged."""
    claim, blocks = answer.claim, blocks_at_fault(answer)
    if forced:
        yield forced
    if has_faults(claim):
        return
    present, names = frozenset(claim.words), frozenset(claim.vocabulary)
    extra = frozenset({row.fact.given for row in claim.form.outline.facts} | set(claim.form.choices))
    if not whole.is_singular:
        extra -= present ^ extra if is_clean(claim.form, control.rules, present, claim.circumstances) else set()
    changes = smallest_changes(claim.form, control.rules, present, names & extra, claim.circumstances, blocks)
    corrections = tuple(_corrections(claim, control))
    bases: list[tuple[Edit, ...]] = []
    for swap in changes:
        drops = tuple(drop(claim.words[name]) for name in sorted(swap & present))
        kept = Geometry.of(claim, present - swap) if swap - present else whole
        added = [_additions(claim, name, (whole, kept)) for name in sorted(swap - present)]
        corrected = [options for name, options in corrections if name not in swap]
        bases += [(*forced, *drops, *edits) for edits in product(*added, *corrected)]
    yield from bases
    # A legal block may still have corners that cannot be made.
    at_fault = corners_at_fault(answer)
    for base in bases:
        touched = {edit.span for edit in base}
        corners = [drop(claim.words[name]) for name in sorted(at_fault) if claim.words[name].span not in touched]
        if any(edit.kind is not EditKind.DROP for edit in base):
            sets = chain.from_iterable(combinations(corners, size) for size in range(1, len(corners) + 1))
            yield from (tuple(sorted((*base, *some), key=lambda edit: edit.kind is not EditKind.DROP)) for some in sets)
    if frozenset() in changes:
        yield from ((*forced, *edits) for edits in _other_corners(claim, at_fault))
    if whole.conflicts and all(swap and not swap & present for swap in changes):
        # Too few words, of which some contradict each other: one of these is replaced, too.
        yield from ((*forced, *edits) for edits in _replacing(claim, control, whole.conflicts, names & extra, blocks))


def _other_corners(claim: ParsedContour, at_fault: list[str]) -> Iterator[tuple[Edit, ...]]:
    """Each corner at fault as it is, without its word, or with the word for its other shape."""
    options: list[list[tuple[Edit, ...]]] = []
    for row in claim.form.outline.corners:
        for name in (name for name in at_fault if name in row.shapes):
            word = claim.words[name]
            texts = (word.text.upper().replace(word.address, other, 1) for other in row.shapes if other != name)
            others = [change(word, text) for text in texts]
            options.append([(), (drop(word),), *((other,) for other in others)])
    for choice in product(*options):
        edits = tuple(edit for part in choice for edit in part)
        if edits:
            yield edits


def _replacing(
    claim: ParsedContour, control: Control, conflicts: Iterable[Circuit], extra: frozenset[str], blocks: frozenset[str]
) -> Iterator[tuple[Edit, ...]]:
    """Each word of a contradiction dropped, and the rest completed with other words."""
    present = frozenset(claim.words)
    tied = {fact.given for circuit in conflicts for fact in circuit.facts if fact.given in present}
    for name in sorted(each for each in tied if each):
        rest = present - {name}
        kept = Geometry.of(claim, rest)
        for swap in smallest_changes(claim.form, control.rules, rest, extra - {name}, claim.circumstances, blocks):
            if not swap & present:
                added = [_additions(claim, other, (kept,)) for other in sorted(swap)]
                yield from ((drop(claim.words[name]), *edits) for edits in product(*added))


def _corrections(claim: ParsedContour, control: Control) -> Iterator[tuple[str, list[Edit]]]:
    """Words whose value a rule refuses, with the values that mean the same or were meant."""
    for offence in check(control.rules, claim.form.roles, claim.stated()):
        if offence.rule.when is None or not offence.rule.when.reads_values:
            continue
        for name in offence.names:
            word, given = claim.words[name], claim.givens.get(name)
            if given is None:  # Its value is a variable that nobody knows.
                continue
            if given.unit is Unit.SIGN:
                yield name, [change(word, f"{word.address}-1"), change(word, f"{word.address}1")]
            elif given.value:
                values = [float(abs(given.value))]
                if given.unit is Unit.DEGREE:
                    within = float(given.value % 360)
                    # The line may have to run the other way.
                    values = [within, within - 180 if within > 0 else within + 180]
                lexicon, unit = claim.lexicon, claim.after.unit
                yield name, [change(word, write_word(word.address, value, lexicon, unit)) for value in values]


def _additions(claim: ParsedContour, name: str, geometries: Iterable[Geometry]) -> list[Edit]:
    """A word added: with the value that the geometry fixes, each sign of a choice, or a placeholder."""
    address, _ = claim.vocabulary[name]
    texts = [f"{address}-1", f"{address}1"] if name in claim.form.choices else [""]
    for geometry in geometries:
        value = geometry.implied(claim, name)
        if value is not None:
            texts = [write_word(address, value, claim.lexicon, claim.after.unit)]
            break
    return [add(claim, name, text) for text in texts]


def _values(answer: Answer, whole: Geometry) -> Iterator[tuple[Edit, ...]]:
    """One word with another value: what a finding or the other words ask for."""
    claim, unit, lexicon = answer.claim, answer.claim.after.unit, answer.claim.lexicon
    if has_faults(claim):
        return
    forced = next(unreadable(claim))
    tied = {fact.given for circuit in whole.conflicts for fact in circuit.facts}
    asked_together: list[Edit] = []
    asking: dict[Span, list[Diagnostic]] = {}
    """The errors about each word, by its place."""
    for finding in answer.diagnostics:
        if finding.is_error and finding.about not in OF_CORNERS and finding.labels:
            asking.setdefault(finding.labels[0].span, []).append(finding)
    for name, word in claim.words.items():
        given = claim.givens.get(name)
        if given is None or word.number is None or given.unit is Unit.SIGN:
            continue
        asked = list(_asked(asking.get(word.span, ()), given))
        texts = [write_word(word.address, value, lexicon, unit, rounding) for rounding, value in asked]
        why = {text: Why.FITS for text, (rounding, _) in zip(texts, asked, strict=True) if rounding is AT_LEAST}
        agreeing: list[str] = []
        asked_together += [change(word, texts[0])] if texts and texts[0] != word.text else []
        if name in tied and answer.status is not Status.OVERDETERMINED:
            value = Geometry.of(claim, frozenset(claim.givens) - {name}).implied(claim, name)
            if value is not None and given.unit is Unit.DEGREE:
                value += 360 * round((float(given.value) - value) / 360)
            agreeing = [write_word(word.address, value, lexicon, unit)] if value is not None else []
            texts += agreeing
        new = (text for text in dict.fromkeys(texts) if Decimal(lexicon.number_of(text, word.address)) != word.number)
        why |= dict.fromkeys(agreeing, Why.AGREES)
        yield from ((*forced, change(word, text, why.get(text, Why.OTHER))) for text in new)
    if len(asked_together) > 1:
        yield (*forced, *asked_together)


_OF_RADII = refusals_about(Topic.RADII)


def _of_circles(answer: Answer, trial: Trial) -> Iterator[tuple[Edit, ...]]:
    """Words that place a circle twice, each with the value that agrees with the others, or with what a slip makes of
    about this value."""
    claim, unit, lexicon = answer.claim, answer.claim.after.unit, answer.claim.lexicon
    finding = next((each for each in answer.diagnostics if each.about in _OF_RADII), None)
    if finding is None or has_faults(claim):
        return
    spans = spans_of([finding])
    lines = {span.line for span in spans}
    for name, word in claim.words.items():
        given = claim.givens.get(name)
        is_centre = word.address in _CENTRES and word.span.line in lines
        if given is None or word.number is None or not (word.span in spans or is_centre):
            continue
        value = float(given.value)
        texts = [write_word(word.address, value + step, lexicon, unit) for step in (-_STEP, 0.0, _STEP)]
        gaps = [_gap(trial.examine((change(word, text),))) for text in texts]
        for step in _zeros([gap for gap in gaps if gap is not None]):
            text = write_word(word.address, value + step, lexicon, unit)
            slips = list(explained(word, value + step, claim))
            yield from ((change(word, each, Why.AGREES),) for each in slips or [text])
    yield from _lost_centres(answer, trial, spans)


def _lost_centres(answer: Answer, trial: Trial, spans: Set[Span]) -> Iterator[tuple[Edit, ...]]:
    """The other word of a centre of which a block has one, which counts as 0: with the value at which the circle passes
    through its points."""
    claim, unit, lexicon = answer.claim, answer.claim.after.unit, answer.claim.lexicon
    lines = {span.line for span in spans}
    stated = {(word.address, word.span.line) for word in claim.words.values()}
    for name, (address, index) in claim.vocabulary.items():
        line = claim.blocks[index].line
        is_beside = any((other, line) in stated for other in _CENTRES if other != address)
        if address in _CENTRES and line in lines and is_beside and (address, line) not in stated:
            texts = [write_word(address, step, lexicon, unit) for step in (-_STEP, 0.0, _STEP)]
            gaps = [_gap(trial.examine((add(claim, name, text),))) for text in texts]
            for step in _zeros([gap for gap in gaps if gap is not None]):
                yield (add(claim, name, write_word(address, step, lexicon, unit)),)


_CENTRES = ("I", "J", "K")


_FLAT = 1e-6
"""mm^2: what is bent less is a line."""

_STEP = 5.0
"""mm by which a word of a circle is changed to see how it misses its point then."""


def _gap(answer: Answer | None) -> float | None:
    """By how much the square of a radius differs from that of the distance of a point that the circle misses."""
    if answer is not None and answer.contour is not None:
        return 0.0
    for finding in answer.diagnostics if answer else ():
        if finding.about in _OF_RADII and "distance" in finding.values:
            return finding.values["distance"] ** 2 - finding.values["radius"] ** 2
    return None


def _zeros(gaps: list[float]) -> Iterator[float]:
    """The zeros of a quadratic function that is known a step before, at and behind 0."""
    if len(gaps) != 3:  # noqa: PLR2004
        return
    before, at, behind = gaps
    bend, slope = (before + behind) / 2 - at, (behind - before) / 2
    if abs(bend) <= _FLAT:
        yield from [-at / slope * _STEP] if slope else ()
    elif slope * slope >= 4 * bend * at:
        root = sqrt(slope * slope - 4 * bend * at)
        yield from sorted(((-slope + sign * root) / (2 * bend) * _STEP for sign in (1, -1)), key=abs)


def _asked(findings: Iterable[Diagnostic], given: Given) -> Iterator[tuple[str, float]]:
    """The values that errors about a word ask for, in mm (radius) or degrees, and how they are rounded."""
    for finding, key in product(findings, ("expected", "limit")):
        if given.unit is Unit.DEGREE and key == "limit":
            yield from ((ROUND_HALF_EVEN, angle) for angle in _meeting(finding, given))
        elif key in finding.values and abs(finding.values[key]) < float("inf"):
            value = given.of_typed(finding.values[key])
            rounding = AT_LEAST if key == "limit" else ROUND_HALF_EVEN
            # A limit is a size; what the sign of the word says is not in question.
            yield rounding, copysign(value, given.value) if key == "limit" else value


def _meeting(finding: Diagnostic, given: Given) -> Iterator[float]:
    """The angle nearest to the given one with which a line meets the circle that it misses, degrees."""
    if "angle_from" in finding.values:
        low, high = finding.values["angle_from"] + _INSIDE, finding.values["angle_to"] - _INSIDE
        value = float(given.value)
        near = [edge + 360 * round((value - edge) / 360) for edge in (low, high)]
        yield min(near, key=lambda edge: abs(edge - value))


_INSIDE = 0.002
"""Degrees. Two least increments, so that a rounded angle still meets the circle."""
