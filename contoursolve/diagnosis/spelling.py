"""Findings about characters, words and positions, before the equations are looked at."""

import re
import unicodedata
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping, Sequence
from decimal import Decimal

from msgspec.structs import replace

from contoursolve.diagnosis.edits import change, edited
from contoursolve.diagnosis.explain import Context, report, spans_of
from contoursolve.diagnosis.vocabulary import UNITS, corner_at, meant_by, not_read_yet
from contoursolve.diagnosis.wording import angle_text, either, join, length_text
from contoursolve.diagnostics import Applicability, Basis, Diagnostic, Fix, Label, Severity, Span
from contoursolve.gcode import (
    AXES,
    Block,
    Fault,
    FaultKind,
    Lookalike,
    Word,
    find_lookalikes,
    lookalike_at,
    looks_like,
    mended,
)
from contoursolve.geometry import Arc, CornerShape, Given, Length, Start, Unit
from contoursolve.reading import (
    Effect,
    Lexicon,
    Modes,
    ParsedContour,
    Position,
    ReadIssue,
    State,
    WithoutPoint,
    rows_of,
)
from contoursolve.tolerance import LARGEST


def explain_spelling(context: Context, claim: ParsedContour) -> Iterator[Diagnostic]:
    """Findings that keep the words of a contour from being read: nothing can be said of what they mean then."""
    words = [word for block in claim.blocks for word in block.words]
    for block in claim.blocks:
        yield from (_with_corner(each, block, claim.lexicon) for each in explain_faults(context, block))
    yield from explain_words(context, claim.lexicon, claim.repeated, words)
    yield from _explain_unknown(context, claim)
    for word in claim.unread:
        if word.address == "G" and word.number is None:
            name, advice = word.text.strip(), "write out what it does"
            unknown = report(context, ReadIssue.CODE_UNKNOWN, Basis.RULE, [word], name=name, advice=advice)
            yield replace(unknown, severity=Severity.ERROR)
        else:
            yield not_read_yet(context, word, is_needed=True)
    yield from _explain_asked(context, claim)


def _with_corner(finding: Diagnostic, block: Block, lexicon: Lexicon) -> Diagnostic:
    """A finding about what belongs to no word, with the word of a corner or an angle that may have been meant."""
    is_open = finding.about in (FaultKind.STRAY_CHARACTER, FaultKind.NUMBER_MISSING) and "meant" not in finding.help
    found = corner_at(block.text, finding.span, lexicon, in_contour=True) if is_open else None
    if found is None or not found[1]:
        return finding
    word, meant = found
    return replace(finding, help=f"write {either(meant[:2])} for {word.text} if that is meant; else {finding.help}")


def explain_unmarked(context: Context, block: Block) -> Iterator[Diagnostic]:
    """Comments that look like facts and are not read as such."""
    for directive in block.unmarked:
        place = replace(context, place=directive.span)
        yield report(place, ReadIssue.FACT_UNMARKED, Basis.RULE, [], fact=directive.text)


def explain_asked_outside(context: Context, block: Block) -> Iterator[Diagnostic]:
    """Words that ask for something in a block that is no contour."""
    for word in (word for word in block.words if word.is_asked):
        yield report(context, ReadIssue.ASKED_NOTHING, Basis.RULE, [word], allowed="words of contour blocks")


def explain_start_units(context: Context, unit: Length, block: Block) -> Diagnostic:
    """A start point in another unit than that of the contour."""
    units = {Length.MM: "mm", Length.INCH: "inches"}
    codes = {Length.MM: "G21", Length.INCH: "G20"}
    was, now, start = units[context.unit], units[unit], block.text.strip()
    return report(context, ReadIssue.START_UNITS, Basis.RULE, [], was=was, unit=now, code=codes[unit], start=start)


def explain_start_diameter(context: Context, state: State, code: str, block: Block) -> Diagnostic:
    """A start point whose X was read otherwise than that of the contour."""
    meanings = ("a diameter", "a radius")
    now, was = meanings if state.counts_diameters() else reversed(meanings)
    start = block.text.strip()
    return report(context, ReadIssue.START_DIAMETER, Basis.RULE, [], was=was, now=now, code=code, start=start)


def _explain_asked(context: Context, claim: ParsedContour) -> Iterator[Diagnostic]:
    for word in unanswerable(claim):
        names = answerable(claim)
        allowed = ", ".join(dict.fromkeys(claim.vocabulary[name][0] for name in claim.vocabulary if name in names))
        yield report(context, ReadIssue.ASKED_NOTHING, Basis.RULE, [word], allowed=allowed)


def unanswerable(claim: ParsedContour) -> list[Word]:
    """Words that ask for something that is not part of a contour."""
    asking = [word for block in claim.blocks for word in block.words if word.is_asked]
    if not asking:
        return []
    answered = [claim.words[name] for name in answerable(claim) if name in claim.words]
    return [word for word in asking if word not in answered and word not in claim.unknown]


def answerable(claim: ParsedContour) -> set[str]:
    """The names that state facts, sizes or choices."""
    return (
        {row.fact.given or "" for row in claim.form.outline.facts}
        | {*claim.form.outline.shapes}
        | {*claim.form.choices}
    )


def explain_faults(context: Context, block: Block) -> Iterator[Diagnostic]:
    """The faults of a block; of those that slips make in one word, the first."""
    told: set[Span] = set()
    meanings = Meanings(block) if block.faults else None
    for fault in block.faults:
        meant = meanings.at(fault.span) if meanings else None
        if meant is None or meant.span not in told:
            yield _explain_fault(context, fault, meant)
        told |= {meant.span} if meant else set()


def _explain_fault(context: Context, fault: Fault, meant: Lookalike | None) -> Diagnostic:
    """Characters of a block that are not a word."""
    shown = Word(fault.text[:1], None, False, fault.text.strip(), fault.span)
    finding = report(context, fault.kind, Basis.RULE, [shown])
    finding = replace(finding, addresses=(fault.address,) if fault.address else ())
    like = looks_like(fault.text)
    if like != fault.text:
        return _explain_character(finding, fault.text, like)
    if fault.text.strip().lower() in UNITS:
        unit = fault.text.strip()
        told = f"{unit} is no word: a number has no unit after it"
        return replace(finding, message=told, help=f"delete {unit}; the program states its unit for all numbers")
    if meant is None:
        return finding
    advice = f"write {meant.new} for {meant.old} if that is meant; else {finding.help}"
    return replace(finding, message=_ask(context, meant), help=advice)


def _explain_character(finding: Diagnostic, character: str, like: str) -> Diagnostic:
    """A character that looks like another one."""
    name = unicodedata.name(character, "null" if character == "\0" else "control character").lower()
    looks = "a blank" if like == " " else like
    told = f"the character here is U+{ord(character):04X} ({name}), not {looks}; no control reads it"
    return replace(finding, message=told, help=f"type {looks} in its place")


class Meanings:
    """The words that are meant in a block, and none where a word that may mean what it says begins in the middle, as
    in X I5."""

    def __init__(self, block: Block) -> None:
        self._text = block.text
        readable = (word for word in block.words if word.number is not None and word.address not in _NEVER_MEANT)
        begins = sorted(word.span.column for word in readable)
        self._found = [
            each
            for each in find_lookalikes(block)
            if each.is_code or not _is_between(begins, each.span.column, each.span.end_column)
        ]

    def __bool__(self) -> bool:
        return bool(self._found)

    def at(self, place: Span) -> Lookalike | None:
        """The word that is meant at a place; None unless all there is of such words."""
        stretch = self._text[place.column - 1 : place.end_column - 1]
        columns = (place.column + index for index, char in enumerate(stretch) if not char.isspace())
        chars = (Span(place.line, column, column + 1) for column in columns)
        return lookalike_at(self._found, place) if all(lookalike_at(self._found, each) for each in chars) else None


def _is_between(places: Sequence[int], low: int, high: int) -> bool:
    """Whether one of some places, in order, is between two others."""
    index = bisect_right(places, low)
    return index < len(places) and places[index] < high


_NEVER_MEANT = ("L", "O")
"""Letters that look like digits and state nothing about a contour on any control."""


def meant_words(claim: ParsedContour) -> tuple[Lookalike, ...]:
    """The words of a contour that slips keep from being read, in order."""
    found: dict[Span, Lookalike] = {}
    for block in claim.blocks:
        unread = [fault.span for fault in block.faults]
        unknown = [word for word in claim.unknown if word.span.line == block.line]
        if not unread and not unknown:
            continue
        meanings, ends = Meanings(block), {each.span.end_column: each for each in block.words}
        meant = [meanings.at(span) for span in (*unread, *(word.span for word in unknown))]
        behind = [word for word in unknown if word.address[:1] == "," and word.address[1:] in claim.form.allowed]
        meant += [_comma_behind(ends.get(word.span.column), word) for word in behind]
        found |= {each.span: each for each in meant if each}
    return tuple(found[span] for span in sorted(found))


def meant_in(block: Block, unread: Iterable[Span]) -> list[Lookalike]:
    """The words that are meant in a block as G codes, and where something cannot be read."""
    alike = find_lookalikes(block)
    torn = {each.span for each in (lookalike_at(alike, span) for span in unread) if each}
    return [each for each in alike if each.is_code or each.span in torn]


def _comma_behind(number: Word | None, word: Word) -> Lookalike | None:
    """The number that the comma of a word stands right behind, with what the comma means there, as in `A180, K-30.`"""
    if number is None or number.number is None:
        return None
    old = f"{number.text.strip()},"
    span = Span(word.span.line, word.span.column - len(old) + 1, word.span.column + 1)
    return Lookalike(span, old, mended(old))


def _ask(context: Context, meant: Lookalike) -> str:
    """Findings about text that is almost a word."""
    if not meant.has_letters:
        malformed = context.row(FaultKind.NUMBER_MALFORMED).message.format(words=meant.old)
        return f"{malformed}: did you mean {meant.new}?"
    pairs = dict(pair for pair in zip(meant.old, meant.new, strict=True) if pair[0] != pair[1])
    plural = "s" if len(pairs) > 1 else ""
    letters, digits = join(list(pairs)), join(list(pairs.values()))
    return f"letter{plural} {letters} in {meant.old}: did you mean the digit{plural} {digits} ({meant.new})?"


def torn_codes(claim: ParsedContour) -> tuple[Lookalike, ...]:
    """The G codes of a contour that slips keep from being read: what the words are is not known then."""
    return tuple(each for each in meant_words(claim) if each.is_code)


_LARGEST = Decimal(LARGEST)


def explain_words(
    context: Context, lexicon: Lexicon, repeated: Sequence[Word], words: Sequence[Word]
) -> Iterator[Diagnostic]:
    """Addresses given twice, and values beyond all travel."""
    numbers = {each.number for each in repeated}
    for address, line in dict.fromkeys((word.address, word.span.line) for word in repeated):
        same = [word for word in words if word.address == address and word.span.line == line]
        if address == "G":
            same = [word for word in same if word.number in numbers]
        yield report(context, ReadIssue.REPEATED_ADDRESS, Basis.RULE, same)
    for word in words:
        value = lexicon.value(word, context.unit) if word.address in lexicon.addresses else None
        if value is not None and abs(value) > _LARGEST:
            limit = length_text(LARGEST, context.unit)
            yield report(context, ReadIssue.VALUE_TOO_LARGE, Basis.RULE, [word], limit=limit)


def _explain_unknown(context: Context, claim: ParsedContour) -> Iterator[Diagnostic]:
    if not claim.unknown:
        return
    form, torn, mendable = claim.form, torn_codes(claim), meant_words(claim)
    own = [address for address in claim.lexicon.addresses if address in form.allowed]
    others = sorted(form.allowed - {"N", "G", *own})
    allowed = " ".join(own) + (f", and besides {' '.join(others)}" if others else "")
    for word in claim.unknown:
        here, radius = lookalike_at(torn, word.span), ""
        if any(each.span.line == word.span.line and each is not here for each in torn):
            continue
        other = respelled(word, claim)
        meant = lookalike_at(mendable, word.span)
        other = "" if meant else other
        sizes = [] if word.address != "R" else [radius] if (radius := _radius(word, claim)) else _roundings(claim)
        texts = [claim.lexicon.spell(address, claim.lexicon.number_of(word.text, word.address)) for address in sizes]
        ways = [*dict.fromkeys((*texts, *filter(None, [other]))), *([f"{meant.new} for {meant.old}"] if meant else [])]
        do = f"write {' or '.join(ways)}" if ways else "delete it"
        name = form.name if form.name.startswith("G") else form.title
        finding = report(context, ReadIssue.UNKNOWN_ADDRESS, Basis.RULE, [word], form=name, allowed=allowed, advice=do)
        if texts and not meant:
            sizes = [claim.lexicon.spell(each, "").split()[0].strip("=") for each in sizes]
            told = f"the radius of an arc is {join(sizes)}" if radius else f"roundings are {join(sizes)}"
            finding = replace(finding, message=f"{word.text.strip()}: {name} has no R; {told}")
        if other and len(word.address) > 1:
            finding = replace(finding, notes=(*finding.notes, f"{other} is probably meant"))
        yield replace(finding, message=_ask(context, meant)) if meant else finding


def _radius(word: Word, claim: ParsedContour) -> str:
    """The address of an arc's radius, where a word stands in the block of an arc that has one by another name."""
    line = next((at for at, block in enumerate(claim.blocks) if block.line == word.span.line), 0)
    is_arc = line < len(claim.form.outline.path) and isinstance(claim.form.outline.path[line], Arc)
    rows = claim.lexicon.addresses.values()
    return next((row.address for row in rows if row.meaning.startswith("radius")), "") if is_arc else ""


def _roundings(claim: ParsedContour) -> list[str]:
    """The addresses of roundings of a contour."""
    # Under G11 and G12 a corner has the word of a line.
    names = [name for name, shape in claim.form.outline.shapes.items() if shape is CornerShape.FILLET]
    return [claim.vocabulary[name][0] for name in names if name in claim.vocabulary]


def respelled(word: Word, claim: ParsedContour) -> str:
    """The address that a word of a contour was most plausibly meant to have; empty if it is like none."""
    if word.address == "R" and (radius := _radius(word, claim)):
        return claim.lexicon.spell(radius, claim.lexicon.number_of(word.text, word.address))
    allowed = [each for each in claim.lexicon.addresses if each in claim.form.allowed]
    return next(iter(meant_by(word, allowed, claim.lexicon)), "")


def with_comma(word: Word, claim: ParsedContour) -> str:
    """A word with the comma that its address lacks, or without the one that it has not; else empty."""
    address = word.address[1:] if word.address.startswith(",") else f",{word.address}"
    text = word.text.strip()
    if address not in claim.form.allowed:
        return ""
    return text.replace(",", "", 1).strip() if word.address.startswith(",") else f",{text}"


def explain_modes(context: Context, claim: ParsedContour) -> Iterator[Diagnostic]:
    """Findings about what is not known to be in force where a contour is read."""
    by_reason = dict[str, list[str]]()
    for what, why in claim.open_modes():
        by_reason.setdefault(why, []).append(what)
    for why, several in by_reason.items():
        are = "is" if len(several) == 1 else "are"
        yield report(context, ReadIssue.MODE_UNKNOWN, Basis.RULE, [], what=join(several), are=are, reason=why)


def explain_start(context: Context, claim: ParsedContour, start: Start) -> Diagnostic:
    """Findings about axes of the start point that are unknown, and the line that made them so."""
    of_axes = zip(claim.before.plane.axes, start.values, start.free, strict=True)
    unknown = [axis for axis, at, is_free in of_axes if (is_free if start.is_known else at is None)]
    places = [claim.before.axes[axis] for axis in unknown]
    reasons = dict.fromkeys(f"{each.reason}{_on_line(each)}" for each in places)
    about = ReadIssue.START_RELATIVE if start.is_known else ReadIssue.POSITION_UNKNOWN
    if not start.is_known and claim.before.is_incremental and any(each.span is None for each in places):
        reasons["G91 is active, and an increment from an unknown position gives none"] = None
    finding = report(
        context,
        about,
        Basis.RULE,
        [],
        axes=" and ".join(unknown),
        reason="; ".join(reasons),
        count="counts" if len(unknown) == 1 else "count",
    )
    labels = (Label(each.span, "the position is lost here") for each in places if each.span)
    return replace(finding, labels=finding.labels + tuple(dict.fromkeys(labels)), addresses=tuple(unknown))


def _on_line(place: Position) -> str:
    """The place where a position was lost, unless the reason says so."""
    if place.span is None or re.search(rf"\bline {place.span.line}\b", place.reason):
        return ""
    return f" (program line {place.span.line})" if place.span.line else " (--start)"


def explain_skippable(context: Context, claim: ParsedContour) -> Iterator[Diagnostic]:
    """A contour that depends on whether a block is skipped."""
    skippable = {block.is_skippable for block in claim.blocks}
    if len(skippable) > 1 or any(claim.before.axes[axis].is_skippable for axis in claim.before.plane.axes):
        yield report(context, ReadIssue.SKIPPABLE_START, Basis.RULE, [])


# Numbers without a decimal point: the control counts them in least increments, which is seldom what was meant ---

_FULL_TURN, _MANY_INCREMENTS = 360, 1_000
"""A number that is no larger says a direction in degrees, or a length under 1 mm in least increments."""


def without_point(context: Context, claim: ParsedContour, findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Words that are read in least increments because they have no decimal point: each where others have one, and all
    together where none has and the values are hardly meant like this."""
    counted = _counted(context, claim)
    words = list(counted)
    about = ReadIssue.POINT_MISSING
    others = [given.word for given in claim.givens.values() if given.word and given.word.number]
    if any(word.has_point for word in others):
        for word, value in counted.items():
            finding = report(context, about, Basis.RULE, [word], actual=value)
            yield replace(finding, severity=Severity.WARNING) if _is_lone(claim, word, others) else finding
    elif words and _is_slip(claim, words, has_error=any(each.is_error for each in findings)):
        yield report(context, about, Basis.RULE, words, actual=join(list(counted.values())))


def _is_lone(claim: ParsedContour, word: Word, others: Iterable[Word]) -> bool:
    """Whether a word lacks the point that others of its kind have, lengths or angles, and may be meant as it stands."""
    rows = claim.lexicon.addresses
    unit = rows[word.address].unit
    most = _FULL_TURN if unit is Unit.DEGREE else _MANY_INCREMENTS
    is_usual = any(each.has_point and rows[each.address].unit is unit for each in others if each.address in rows)
    return is_usual and word.number is not None and abs(word.number) <= most


def start_without_point(context: Context, claim: ParsedContour, findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """The words before a contour that put its start less than 1 mm from zero because they have no decimal point, where
    other words have one, or those of the contour are hardly meant like this, either."""
    places = [claim.before.axes[axis] for axis in claim.before.plane.axes]
    words = {each.word.span: each.word for each in places if each.word and is_counted_start(each, claim.lexicon)}
    if not words or any(each.value is None for each in places):
        return
    if are_points_usual(claim, findings):
        counted = [words[span] for span in sorted(words)]
        yield _counted_in_increments(context, ReadIssue.START_IN_INCREMENTS, counted, claim.lexicon, claim.before.unit)


def are_points_usual(claim: ParsedContour, findings: Iterable[Diagnostic]) -> bool:
    """Whether a program shows by a contour that it writes lengths with a decimal point: other words of the contour or
    of its start have one, or those of the contour are hardly meant without."""
    places = [claim.before.axes[axis] for axis in claim.before.plane.axes]
    stated = (*(given.word for given in claim.givens.values()), *(each.word for each in places))
    is_suspected = any(each.about is ReadIssue.POINT_MISSING for each in findings)
    return is_suspected or any(word.has_point for word in stated if word)


def move_without_point(context: Context, words: Sequence[Word], lexicon: Lexicon, unit: Length) -> Iterator[Diagnostic]:
    """Coordinates of a block outside contours that are less than 1 mm because they have no decimal point."""
    counted = [word for word in words if counts_few(word, lexicon)]
    if counted:
        yield _counted_in_increments(context, ReadIssue.MOVE_IN_INCREMENTS, counted, lexicon, unit)


def lost_points(blocks: Sequence[Block], around: Sequence[Block], modes: Modes) -> list[Word]:
    """The coordinates of some blocks that have lost their points: of all lengths in the blocks around, each alone has
    none, and with it lies much nearer to the lines before and behind."""
    lexicon, rows = modes.lexicon, modes.lexicon.addresses
    few = [word for block in blocks for word in block.words if word.address in AXES and counts_few(word, lexicon)]
    if not few or any(code.effect is Effect.INCREMENTAL for block in around for code in rows_of(block, modes)):
        return []
    lengths = [
        word
        for block in around
        for word in block.words
        if word.number and word.address in rows and rows[word.address].unit is Unit.MM
    ]
    with_point = [word for word in lengths if word.has_point]
    if len(few) > 1 or len(with_point) < max(_POINTED, len(lengths) - 1):
        return []
    before, behind = _beside(few[0], around, modes)
    beside = [each for each in (before, behind) if each is not None]
    number, step = few[0].number or Decimal(0), lexicon.numbers.step(Unit.MM, Length.MM)
    read, meant = (sum(abs(value - each) for each in beside) for value in (number * step, number))
    return few if beside and _FARTHER * meant < read else []


_POINTED, _FARTHER = 3, 2
"""Lengths with a point beside one without, and how much farther the path is without it, that show that it is lost."""


def _beside(word: Word, around: Sequence[Block], modes: Modes) -> tuple[Decimal | None, Decimal | None]:
    """The numbers that an address has before and behind a word, as far as the tool cuts from the one to the other; None
    where there is none, or where the word is no place."""
    before, is_behind = None, False
    for block in around:
        effects = {code.effect for code in rows_of(block, modes)}
        codes = {word.number for word in block.words if word.address == "G"}
        is_place = effects <= _OF_PLACES
        if word in block.words:
            if not is_place:
                return None, None
            is_behind = True
            continue
        if is_behind and (0 in codes or not is_place):
            break
        own = block.find(word.address)
        if own is not None and own.number is not None and is_place:
            if is_behind:
                return before, own.number
            before = own.number
    return (before, None) if is_behind else (None, None)


_OF_PLACES = {Effect.NONE, Effect.MOTION, Effect.PLANE, Effect.UNITS, Effect.ABSOLUTE, Effect.COMPENSATION}
"""Effects of the codes beside which words of axes are places."""


def explain_lost(context: Context, word: Word, blocks: Sequence[Block], modes: Modes, unit: Length) -> Diagnostic:
    """A coordinate in some blocks that has lost its point, with it as the fix."""
    typed = replace(word, has_point=False)
    finding = _counted_in_increments(context, ReadIssue.POINT_LOST, [typed], modes.lexicon, unit)
    edit = change(word, f"{word.text.strip()}.")
    replaced = "\n".join(block.text for block in blocks)
    fix = Fix(str(edit), edited(blocks, [edit]), Applicability.CHANGES_CONTOUR, replaced=replaced)
    return replace(finding, fixes=(fix,))


def _counted_in_increments(
    context: Context, about: ReadIssue, counted: Sequence[Word], lexicon: Lexicon, unit: Length
) -> Diagnostic:
    """That lengths count least increments, and what they would be with a decimal point."""
    read = [readings(word, lexicon, unit) for word in counted]
    actual, expected, same = (join(texts) for texts in zip(*read, strict=True))
    meant = join([f"{word.text.strip()}." for word in counted])
    return report(context, about, Basis.RULE, counted, actual=actual, expected=expected, meant=meant, same=same)


def is_counted_start(position: Position, lexicon: Lexicon) -> bool:
    """Whether a coordinate was set by so few least increments that the number may be meant as it stands."""
    return position.word is not None and counts_few(position.word, lexicon)


def counts_few(word: Word, lexicon: Lexicon) -> bool:
    """Whether the number of a length counts so few least increments that it may be meant as it stands."""
    if word.has_point or not word.number or abs(word.number) > _MANY_INCREMENTS:
        return False
    return lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS


def readings(word: Word, lexicon: Lexicon, unit: Length) -> tuple[str, str, str]:
    """A length that counts least increments: its value, the value that it has with a point, and the word with a point
    for the first."""
    number, step = word.number or Decimal(0), lexicon.numbers.step(Unit.MM, unit)
    actual, expected = (length_text(float(number * scale * unit.in_mm), unit) for scale in (step, 1))
    return actual, expected, lexicon.spell(word.address, f"{number * step:f}".rstrip("0"))


def tell_points(context: Context, claim: ParsedContour, findings: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Findings, the errors about a word that lacks its point with how it was read, before what else may be done."""
    findings = list(findings)
    lacking = spans_of(findings, ReadIssue.POINT_MISSING)
    counted = (
        {word: value for word, value in _counted(context, claim).items() if word.span in lacking} if lacking else {}
    )
    for finding in findings:
        spans = spans_of([finding])
        blamed = {word: value for word, value in counted.items() if word.span in spans}
        if not blamed or finding.severity is Severity.INFO or finding.basis is not Basis.NUMERICAL:
            yield finding
            continue
        notes = tuple(f"{word.text} is read as {value}: it has no decimal point" for word, value in blamed.items())
        meant = join([f"{word.text}." for word in blamed])
        yield replace(finding, notes=notes + finding.notes, help=f"write {meant} if that is meant; else {finding.help}")


def _counted(context: Context, claim: ParsedContour) -> Mapping[Word, str]:
    """The words of a contour that count least increments, each with its value in the order of the block."""
    counted = {}
    pointless = [each for each in claim.givens.values() if each.word and not each.word.has_point]
    # Such as A18 in A18O.
    torn = meant_words(claim) if pointless else ()
    for given in sorted(pointless, key=_place):
        word = given.word
        if word is None or not word.number or given.unit is Unit.SIGN or lookalike_at(torn, word.span):
            continue
        if value := counted_text(given, context.unit):
            counted[word] = value
    return counted


def counted_text(given: Given, unit: Length) -> str:
    """The value of a word that counts least increments because it has no decimal point; empty for another one."""
    word, typed = given.word, given.value * 2 if given.is_diameter else given.value
    if given.clockwise_from is not None:
        typed = given.clockwise_from - typed
    if word is None or word.has_point or not word.number or abs(typed) >= abs(word.number):
        return ""
    return length_text(float(typed), unit) if given.unit is Unit.MM else angle_text(float(typed))


def _place(given: Given) -> Span:
    return given.word.span if given.word else Span(0, 0, 0)


def _is_slip(claim: ParsedContour, words: Sequence[Word], *, has_error: bool) -> bool:
    """Whether words without any point mean what they say: their angles would be directions in degrees, or without
    an angle a block that is refused would have no length of 1 mm."""
    angles = [word for word in words if claim.lexicon.addresses[word.address].unit is Unit.DEGREE]
    most = _FULL_TURN if angles else _MANY_INCREMENTS
    return (bool(angles) or has_error) and all(
        word.number is None or abs(word.number) <= most for word in angles or words
    )
