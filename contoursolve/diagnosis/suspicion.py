"""Legal programs that are hardly meant: a turned path that runs back, a number that begins with a zero, a word that
draws nothing where one like it would, a corner or a taper unlike all others; told as a warning, with what was probably
meant."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import pairwise, permutations

from msgspec.structs import replace

from contoursolve.diagnosis.attempt import Repair, Trial
from contoursolve.diagnosis.edits import Edit, EditKind, change
from contoursolve.diagnosis.examine import SUSPICIONS, Answer, leading_words, problems, turning_words
from contoursolve.diagnosis.explain import context_of, report
from contoursolve.diagnosis.fix_text import with_fixes
from contoursolve.diagnosis.material_side import in_material
from contoursolve.diagnosis.odd_points import aslant, open_end
from contoursolve.diagnosis.outliers import other_taper, sharp_corner, taper_of
from contoursolve.diagnosis.plausibility import Feature, familiarity, numbers_of, oddities, rounding_of
from contoursolve.diagnosis.ranking import repair_of, styled
from contoursolve.diagnosis.slip_kinds import (
    COMPLEMENT,
    LETTER_ALIKE,
    OPPOSITE,
    OTHER_AXIS,
    POINT_MOVED,
    SIGN_ADDED,
    SIGN_LOST,
    SUPPLEMENT,
    ZERO_FIRST,
    ZERO_LOST,
    SlipKind,
)
from contoursolve.diagnosis.slips_around import MOST_TRIED, Candidate, Marked, drafts_around
from contoursolve.diagnosis.solved_contours import mend_crossing
from contoursolve.diagnosis.window import Seen, Stretch, Window, moves_of
from contoursolve.diagnosis.wording import angle_text, either
from contoursolve.diagnostics import Basis, Diagnostic, Span
from contoursolve.gcode import Word
from contoursolve.reading import ParsedContour, ReadIssue

_TURNING = (SIGN_LOST, SIGN_ADDED, SUPPLEMENT, OPPOSITE, OTHER_AXIS, ZERO_LOST)
"""Slips after which a turned path runs back."""

_TENFOLD = (ZERO_LOST, POINT_MOVED)
"""Slips after which an end lies a tenth as far, or ten times."""

_ODD = (Feature.TURNS_BACK, Feature.BEHIND_START, Feature.ACROSS)


def suspect(answer: Answer, window: Window) -> Answer:
    """The answer; with a warning where a legal contour is hardly meant, and a slip explains why."""
    settings = window.control.modes.settings
    if answer.contour is None or answer.profile.is_extended:
        return answer
    if wrong := problems(answer):
        is_crossing = all(each.about is ReadIssue.AXIS_CROSSED for each in wrong)
        return mend_crossing(answer, window) if is_crossing else answer
    if settings.get(SUSPICIONS) == "off":
        return answer
    for reason, kinds, words in _doubtful(answer, window):
        found = [*_meant(answer, window, kinds, words)] or [*_meant_twice(answer, window, kinds, words)]
        found.sort(key=lambda repair: repair.cost)
        if found:
            finding = _told(answer, window, found, reason)
            return replace(answer, diagnostics=(*answer.diagnostics, finding))
    for reason, own, text, drafts in _unlike(answer, window):
        found = sorted(_tried(answer, window, drafts, lambda _: True), key=lambda repair: repair.cost)[:1]
        if found:
            finding = _told(answer, window, found, reason, own, text)
            return replace(answer, diagnostics=(*answer.diagnostics, finding))
    return answer


def _unlike(answer: Answer, window: Window) -> Iterator[tuple[str, Sequence[Word], str, Sequence[Candidate]]]:
    """The reasons for which one block stands out from all others of the drawing, the words that it is about, what they
    were meant to be, and the drafts."""
    claim = answer.claim
    if side := in_material(answer, window):
        code, meant, what = side
        reason = f"beside this {what}, the tool runs in the material"
        yield reason, [code], meant, [Candidate((change(code, meant),), (None,), ())]
    if word := other_taper(claim, window.blocks):
        taper = taper_of(word)
        reason = f"it is a taper of {angle_text(taper)}, and all others are {angle_text(90 - taper)}"
        yield reason, [word], "", [*_drafts(answer, window, (COMPLEMENT,), frozenset({word.span}))]
    aside = "a line runs aslant there, and all others are parallel to an axis"
    for reason, points in ((aside, aslant(answer)), ("the path does not end where it began", open_end(answer))):
        if drafts := [_replaced(each, window) for each in points]:
            yield reason, (), "", drafts
    if sharp := sharp_corner(claim, window.blocks):
        block, word = sharp
        own, text = block.words[-1:], word.text.strip()
        edit = Edit(EditKind.ADD, word.address, text=text, line=block.line)
        reason = f"the corner after it is sharp, and all others have {text}"
        yield reason, own, f"{own[0].text.strip()} {text}", [Candidate((edit,), (None,), ())]


def _replaced(meant: Sequence[tuple[Edit, SlipKind]], window: Window) -> Candidate:
    """The draft that gives words other numbers."""
    edits, slips = tuple(edit for edit, _ in meant), tuple(slip for _, slip in meant)
    familiar = (Feature.FAMILIAR, familiarity(edits, numbers_of(window.blocks)))
    kind = sum(slip.cost for slip in slips)
    return Candidate(edits, slips, ((Feature.KIND, kind), (Feature.ROUND, sum(map(rounding_of, edits))), familiar))


def _doubtful(answer: Answer, window: Window) -> Iterator[tuple[str, tuple[SlipKind, ...], frozenset[Span]]]:
    """The reasons to doubt a contour, each with the slips that may explain it and the words in which they may be."""
    claim = answer.claim
    leading = frozenset(word.span for word in leading_words(claim))
    if leading:
        yield "its number begins with a zero", (ZERO_FIRST,), leading
    beside = frozenset(word.span for word in turning_words(claim))
    if beside:
        yield "it draws nothing here", (LETTER_ALIKE,), beside
    if not _asks_for_farther(claim) and (wide := _wide(answer)):
        yield "an arc turns by more than half a turn, against its neighbours", (), wide
    if _is_odd(window):
        stated = frozenset(word.span for word in claim.words.values())
        yield "the path runs back along the axis", _TURNING, stated
    if window.before.moves and oddities(window.before.moves).get(Feature.TURNS_BACK):
        stated = frozenset(word.span for word in claim.words.values())
        yield "the path runs back along the axis", _TENFOLD, stated


def _asks_for_farther(claim: ParsedContour) -> bool:
    """Whether a word asks for the farther one of two intersections, from which an arc may turn far."""
    return any(name in claim.givens and claim.givens[name].value > 0 for name in claim.form.choices)


def _wide(answer: Answer) -> frozenset[Span]:
    """The codes of arcs, where one turns by more than half a turn and joins its neighbours in corners."""
    moves = tuple(moves_of(answer.contour)) if answer.contour else ()
    for at, move in enumerate(moves):
        beside = [_corner(*pair) for pair in pairwise(moves[max(at - 1, 0) : at + 2])]
        if abs(move.sweep) > _HALF_TURN and beside and min(beside) > _SHARP:
            codes = (word for block in answer.claim.blocks for word in block.words if word.address in ("G", "DR"))
            return frozenset(word.span for word in codes)
    return frozenset()


def _corner(one: Stretch, two: Stretch) -> float:
    """The angle by which a path turns between two elements, degrees."""
    return abs((two.headings[0] - one.headings[1] + 180) % 360 - 180)


_SHARP, _HALF_TURN = 15.0, 180.01
"""Degrees: arcs that are meant to go round join their neighbours tangentially, or are parted from them by a corner."""


def _is_odd(window: Window) -> bool:
    odd = oddities(window.before.moves)
    # Where a path ends, it may run back a little.
    return odd.get(Feature.TURNS_BACK, 0.0) > 1 or any(odd.get(each) for each in _ODD[1:])


def _meant(answer: Answer, window: Window, kinds: tuple[SlipKind, ...], words: frozenset[Span]) -> Iterator[Repair]:
    """The repairs by slips in these words without which nothing is odd."""
    old = oddities(window.before.moves)

    def is_better(seen: Seen) -> bool:
        odd = oddities(seen.moves)
        if kinds:
            return not any(odd.get(each) for each in _ODD)
        is_less_wide = odd.get(Feature.WIDE, 0.0) < old.get(Feature.WIDE, 0.0)
        return is_less_wide and odd.get(Feature.TURNING, 0.0) < old.get(Feature.TURNING, 0.0) - _LESS

    yield from _tried(answer, window, _drafts(answer, window, kinds, words), is_better)


def _meant_twice(
    answer: Answer, window: Window, kinds: tuple[SlipKind, ...], words: frozenset[Span]
) -> Iterator[Repair]:
    """The repairs by two slips in these words without which nothing is odd, where one takes some of it away."""
    from contoursolve.diagnosis.two_slips import both  # noqa: PLC0415 - most have one slip

    odd, drafts = _odd(window.before), [*_drafts(answer, window, kinds, words)] if kinds else []
    better = [each for each in drafts if (seen := window.mended(each.edits)) is not None and _odd(seen) < odd]
    pairs = (both(one, two) for one, two in permutations(drafts, 2) if one in better and not _is_same(one, two))
    found = sorted({each.edits: each for each in pairs}.values(), key=lambda each: round(each.cost, 6))
    yield from _tried(answer, window, found[:MOST_TRIED], lambda seen: not _odd(seen))


def _is_same(one: Candidate, two: Candidate) -> bool:
    """Whether two drafts change the same word."""
    return not {edit.span for edit in one.edits}.isdisjoint(edit.span for edit in two.edits)


def _odd(seen: Seen) -> float:
    """The amount of what is odd about a path."""
    odd = oddities(seen.moves)
    return sum(odd.get(each, 0.0) for each in _ODD)


def _drafts(answer: Answer, window: Window, kinds: tuple[SlipKind, ...], words: frozenset[Span]) -> Iterator[Candidate]:
    """The drafts of slips in some words."""
    marked = Marked(words, frozenset(span.line for span in words))
    for draft in drafts_around(window, marked, answer.claim, kinds)[:MOST_TRIED]:
        if all(edit.span in words for edit in draft.edits) and all(draft.slips):
            yield draft


def _tried(
    answer: Answer, window: Window, drafts: Iterable[Candidate], is_better: Callable[[Seen], bool]
) -> Iterator[Repair]:
    """The repairs of drafts with which all is right and better than before."""
    trial = Trial(answer, window.control, window)
    for draft in drafts:
        repair = repair_of(draft, trial, is_better)
        if repair is not None:
            yield styled(repair, trial)


_LESS = 0.5
"""Half turns by which the path has to turn less."""


def _told(
    answer: Answer, window: Window, found: list[Repair], reason: str, words: Sequence[Word] = (), meant: str = ""
) -> Diagnostic:
    """The warning, about the word of the most plausible slip if it is not told about which."""
    context, edit = context_of(answer.claim, window.control.rules), found[0].edits[0]
    same = [each.edits[0].text for each in found if each.edits[0].span == edit.span]
    words = words or [word for block in answer.claim.blocks for word in block.words if word.span == edit.span]
    finding = report(context, ReadIssue.SUSPECTED, Basis.NUMERICAL, words, meant=meant or either(same), reason=reason)
    return with_fixes(finding, answer, found)
