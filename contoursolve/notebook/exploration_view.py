"""An exploration as plain data: what a front end shows, and where on its slider each word has a contour."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from math import floor, log10
from typing import Any
from zlib import crc32

import htpy as h
from msgspec import to_builtins
from msgspec.structs import replace

from contoursolve.diagnosis import (
    Answer,
    AskedValue,
    count,
    join,
    list_solutions,
    meaning_of,
)
from contoursolve.diagnostics import Applicability, Diagnostic, Span
from contoursolve.families import FamilyError, called, feasible
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Question, Unit
from contoursolve.notebook.exploration import (
    TOOL,
    ComputedWord,
    Exploration,
    computed_words,
    free,
    is_movable,
    places_of,
    tool_place,
    words_of,
)
from contoursolve.notebook.handles import Handle, HandleKind, derivatives_of, handles_of, moving_of
from contoursolve.notebook.range_text import range_texts
from contoursolve.notebook.reader_edits import MOST_FIXES, ArrangedFix, ReaderEdits, arranged
from contoursolve.notebook.standing_alone import standing_alone
from contoursolve.output import (
    beside_of,
    bounded,
    count_text,
    effect_of,
    finding_pieces,
    found_value,
    html_text,
    path_of,
    short,
    solution_rows,
    sources_of,
    stated_value,
    worst_of,
)
from contoursolve.pictures import (
    Picture,
    Theme,
    draw_answer,
    find_known,
    list_trails,
    named_words,
    path_data,
    plain_trail,
)
from contoursolve.reading import ReadIssue
from contoursolve.solving import Point, lookup, scalars_of
from contoursolve.tool_radius import ToolReport

MOST_FINDINGS, MOST_SOLUTIONS = 12, 24

TURN = 90.0
"""Degrees on both sides of an angle that its slider covers."""

STEPS = 400
"""Steps of a slider, at least."""

DECIMALS = 4
"""Of a value that was asked for, as a listing shows it."""

Data = dict[str, Any]


def view_of(
    exploration: Exploration,
    drawn: Picture | None = None,
    pinned: Collection[str] = (),
    held: Mapping[str, Sequence[str]] | None = None,
    edits: ReaderEdits | None = None,
) -> Data:
    """Everything that is shown but the ranges in which words have a contour; with a picture that is drawn already, the
    words that no handle changes, those of a handle that is held, and what the reader has changed."""
    answer = exploration.answer
    drawn = drawn if drawn is not None or answer is None else picture_of(answer, None, exploration.tool)
    motion = derivatives_of(answer) if answer is not None and drawn is not None else None
    computed = computed_words(exploration)
    still = {*pinned, *computed}
    handles = handles_of(answer, drawn, motion, still, held) if answer is not None and drawn is not None else []
    moved = {key for handle in handles for key in handle.keys}
    return {
        "text": exploration.block,
        "mark": f"{crc32(exploration.text.encode()):08x}",
        "is_changed": exploration.text != exploration.origin[0],
        "status": _status(exploration),
        "picture": drawn.svg if drawn is not None else "",
        "frame": drawn.frame if drawn is not None else {},
        "handles": [_handle(handle) for handle in handles],
        "elements": to_builtins(moving_of(motion, drawn, moved)) if motion is not None and drawn is not None else [],
        "fields": [*_fields(answer, pinned, computed), *_tool_field(exploration, answer)] if answer else [],
        "findings": list(_findings(exploration, edits)),
        "elsewhere": _elsewhere(exploration),
        "solutions": _solutions(answer) if answer else {"text": "", "items": []},
        "path": _path(answer) if answer else [],
    }


def _status(exploration: Exploration) -> Data:
    worst, answer = worst_of([each for _, each in exploration.findings]), exploration.answer
    if answer is None:
        return {"kind": worst, "text": "no contour"}
    return {"kind": worst, "text": answer.state, "form": short(answer.form_text)}


def picture_of(answer: Answer, like: Picture | None = None, tool: ToolReport | None = None) -> Picture | None:
    """The picture of a contour with its tool, which may stand like the one before; without findings, which are told
    beside it. None if it cannot be drawn."""
    try:
        return draw_answer(answer, theme=Theme.PAGE, like=like, has_remarks=False, beside=beside_of(tool, answer))
    except Exception:  # the tables say the same, and the next value may be drawn again
        return None


def _handle(handle: Handle) -> Data:
    """A handle with what is said of it: to those who see it, and to those who do not."""
    texts = {HandleKind.POINT: f"{handle.name}: changes {join(handle.keys)}", HandleKind.ANGLE: f"{handle.name}: angle"}
    return {**to_builtins(handle), "keys": handle.keys, "text": texts.get(handle.kind, f"{handle.name}: size")}


def _fields(answer: Answer, pinned: Collection[str], computed: Mapping[str, ComputedWord]) -> Iterator[Data]:
    """A field for each word with a value; one that is computed says why it cannot be moved."""
    claim, size = answer.claim, _size(answer)
    names = {word.span: name for name, word in claim.words.items()}
    ignored = {answer.profile.givens[fact.given].word for fact in answer.profile.ignored if fact.given}
    found = {each.question.word.span: each for each in answer.asked}
    for key, word in words_of(answer).items():
        row = claim.lexicon.addresses.get(word.address)
        if row is None or not is_movable(answer, word) or (word.number is None and not word.is_asked):
            continue  # a variable without a value
        value, unit = stated_value(word, answer)
        asked = found_value(found[word.span], answer)[0] if word.span in found else None
        value = value if asked is None else round(asked, DECIMALS)
        low, high, step = _scale(answer, word, value or 0.0, size)
        yield {
            "key": key,
            "word": short(computed[key].text if key in computed else word.text),
            "meaning": meaning_of(names[word.span], word, answer.claim),
            "unit": unit,
            "value": None if value is None else round(value, 6) + 0.0,
            "state": "computed" if key in computed else _state(word, ignored),
            "reason": short(computed[key].told) if key in computed else "",
            "is_pinned": key in pinned,
            "increment": float(claim.lexicon.numbers.step(row.unit, answer.unit)),
            "low": low,
            "high": high,
            "step": step,
            "size": TURN if row.unit is Unit.DEGREE else size,
        }


def _state(word: Word, ignored: Collection[Word | None]) -> str:
    return "free" if word.is_asked else "ignored" if word in ignored else "given"


def _tool_field(exploration: Exploration, answer: Answer) -> Iterator[Data]:
    """A field for the radius of the tool, if one is stated."""
    place = tool_place(exploration)
    if place is not None:
        radius, size = float(place[1].radius), _size(answer)
        high = _round_up(3 * radius or size / 10)
        scale = {"low": 0.0, "high": high, "step": 10.0 ** floor(log10(high / STEPS)), "size": size}
        about = {"word": f"R{place[1].radius}", "meaning": "radius of the tool", "unit": answer.unit.value}
        yield {"key": TOOL, **about, "value": radius, "state": TOOL, "is_pinned": False, "increment": 0.001, **scale}


def _size(answer: Answer) -> float:
    """The approximate size of the contour, in the unit of the program."""
    known = answer.claim.lexicon.addresses
    values = (stated_value(word, answer) for word in words_of(answer).values() if word.address in known)
    lengths = [value or 0.0 for value, unit in values if unit != "deg"]
    places = [float(value or 0) / float(answer.unit.in_mm) for value in answer.start.values]
    return max(map(abs, (*lengths, *places, 1.0)))


def _scale(answer: Answer, word: Word, value: float, size: float) -> tuple[float, float, float]:
    """The ends of a slider about a value, and its step."""
    row = answer.claim.lexicon.addresses[word.address]
    if row.unit is Unit.SIGN:
        return -1.0, 1.0, 2.0
    if row.unit is Unit.DEGREE:
        return value - TURN, value + TURN, 0.25
    if row.axis or row.is_increment:
        reach = _round_up(size) / 2
        low, high = value - reach, value + reach
    else:
        reach = _round_up(2 * abs(value) or size / 4)
        low, high = (-reach, 0.0) if value < 0 else (0.0, reach)
    return low, high, 10.0 ** floor(log10((high - low) / STEPS))


def _round_up(size: float) -> float:
    """1, 2 or 5 times a power of ten, not less than a size."""
    power = 10.0 ** floor(log10(size))
    return next(power * each for each in (1.0, 2.0, 5.0, 10.0) if power * each >= size)


def _findings(exploration: Exploration, edits: ReaderEdits | None) -> Iterator[Data]:
    """Findings as the terminal prints them, each with its fixes."""
    result, answer = exploration.result, exploration.answer
    names = named_words(answer) if answer is not None else {}
    numbers = {id(each): str(number) for number, each in enumerate(answer.diagnostics, 1)} if answer is not None else {}
    for number, finding in exploration.findings[:MOST_FINDINGS]:
        # Fixes are buttons.
        lines = finding_pieces(replace(finding, fixes=()), "block", sources_of(result, finding))
        named = [about for label in finding.labels if (about := names.get(label.span)) is not None]
        yield {
            "kind": finding.severity.value,
            "name": numbers.get(id(finding), ""),
            "words": list(dict.fromkeys(about.word for about in named if about.word)),
            "lines": [[list(piece) for piece in bounded(line)] for line in lines if line],
            "fixes": [_fix(number, each, finding) for each in arranged(exploration, finding, edits)],
            "left": f"and {count(left, 'more fix', 'more fixes')}"
            if (left := len(finding.fixes) - MOST_FIXES) > 0
            else "",
        }


def _fix(finding: int, arranged: ArrangedFix, told: Diagnostic) -> Data:
    fix, alone = arranged.fix, arranged.alone
    return {
        "finding": finding,
        "number": arranged.number,
        "text": short(fix.description),
        "effect": effect_of(fix, told),
        "alone": short(f"changes {join(alone)}, which you left alone") if alone else "",
        "is_safe": fix.applicability is Applicability.SAFE,
    }


def _elsewhere(exploration: Exploration) -> str:
    """The findings that are not shown, and the errors in the rest of a program."""
    left = len(exploration.findings) - MOST_FINDINGS
    told = [f"{count(left, 'more finding')} of the block: contoursolve check lists all."] if left > 0 else []
    result, own = exploration.result, {number for number, _ in exploration.findings}
    lines = [
        result.place(each.span).line
        for number, each in enumerate(result.diagnostics)
        if each.is_error and number not in own
    ]
    if lines:
        first = f", the first in program line {min(lines)}" if len(lines) > 1 else f" in program line {lines[0]}"
        told.append(f"The rest of the program has {count(len(lines), 'error')}{first}.")
    return " ".join(told)


def _solutions(answer: Answer) -> Data:
    listing = list_solutions(answer)
    if listing is None or listing.is_single:
        return {"text": "", "items": []}
    items = [
        {
            "number": number,
            "name": short(name),
            "where": short(f"{label} {where}".strip()),
            "selects": short(selects),
            "is_chosen": each.is_chosen,
        }
        for number, (each, (name, label, where, selects, _)) in enumerate(solution_rows(answer, listing))
    ]
    left = f"; the first {MOST_SOLUTIONS} are shown" if items[MOST_SOLUTIONS:] else ""
    return {"text": count_text(listing) + left, "items": items[:MOST_SOLUTIONS]}


def _path(answer: Answer) -> list[Sequence[str]]:
    """The table of the path, its header first."""
    path = path_of(answer, answer.contour) if answer.contour is not None else None
    return [path.header, *path.rows] if path else []


# What might be instead -----------------------------------------------------------------------------------------


def ghost_of(instead: Exploration, now: Answer, drawn: Picture) -> list[str]:
    """Another path in the picture of a contour, as elements of SVG; empty if nothing of it can be drawn."""
    answer, placement = instead.answer, drawn.sheet.placement
    if placement is None:
        return []
    trails = plain_trail(instead.result, now) if answer is None else list_trails(answer, find_known(answer))
    return path_data(trails, placement.view)


def asked_now(now: Exploration, before: Exploration, solved: Exploration, example: Exploration) -> list[Data]:
    """The words that a fix asks for, with the value that each had when the contour was last solved; else that of the
    example of the fix, if it has one."""
    answer, last = now.answer, solved.answer
    if answer is None or last is None:
        return []
    old = {key for key, word in words_of(before.answer).items() if word.is_asked} if before.answer else set()
    questions = {each.question.word.span: each.question for each in answer.asked}
    points = find_known(last).points if last.contour is not None else {}
    proposed = words_of(example.answer) if example.answer is not None else {}
    found = []
    for key, word in words_of(answer).items():
        if word.is_asked and key not in old:
            value = _last_value(answer, questions[word.span], points) if word.span in questions else None
            if value is None and example.answer is not None and key in proposed:
                value = stated_value(proposed[key], example.answer)[0]
            found.append({"key": key, "value": value})
    return found


def _last_value(answer: Answer, question: Question, points: Mapping[str, Point]) -> float | None:
    """The value of a word in another contour of the same form, as it is written."""
    fact, scalars = question.fact, scalars_of(points)
    value = fact.implied(lookup(answer.profile, scalars)) if scalars.keys() >= {*fact.reads()} else None
    shown = found_value(AskedValue(question, value), answer)[0]
    return None if shown is None else round(shown, DECIMALS - 1)


def snaps_of(exploration: Exploration, key: str) -> list[Data]:
    """Values of a word at which another word says no more than the rest: the one that the others give it, and for an
    angle those in line with another angle."""
    answer = exploration.answer
    words = words_of(answer) if answer is not None else {}
    if answer is None or key not in words or words[key].is_asked:
        return []
    found = []
    freed = free(exploration, key)
    asked = next((each for each in freed.answer.asked if each.value is not None), None) if freed.answer else None
    if freed.answer is not None and asked is not None:
        value, _ = found_value(asked, freed.answer)
        found.append({"value": round(value or 0.0, DECIMALS), "text": "as the other words say"})
    for other, word in words.items():
        value, unit = stated_value(word, answer)
        if other != key and unit == "deg" and value is not None and stated_value(words[key], answer)[1] == "deg":
            found += [{"value": value + turn, "text": f"in line with {short(word.text)}"} for turn in (-180, 0, 180)]
    return found


# Sections that are made when they are opened ---------------------------------------------------------------------


def section_of(exploration: Exploration, name: str) -> str:
    """A section of the page as HTML: the `equations` of the contour, or its `calculation` by hand; the reason where
    there is none. Raises KeyError for another name."""
    make, lacking = _SECTIONS[name]
    answer = exploration.answer
    if answer is None:
        return html_text(h.p["There is no contour."])
    try:
        nodes = [*make(answer)]
    except Exception as error:  # what else is shown of the contour stays
        return html_text(h.p[f"This cannot be shown: {type(error).__name__}: {error}"])
    return html_text(h.div[nodes] if nodes else h.p[lacking])


def _equations(answer: Answer) -> Iterator[h.Node]:
    from contoursolve.output import equations_of_contour  # noqa: PLC0415 - sympy is slow to import

    return equations_of_contour(answer)


def _calculation(answer: Answer) -> Iterator[h.Node]:
    from contoursolve.output import calculation_of_contour  # noqa: PLC0415 - sympy is slow to import

    return calculation_of_contour(answer)


_SECTIONS: Mapping[str, tuple[Callable[[Answer], Iterator[h.Node]], str]] = {
    "equations": (_equations, "The contour has no equations."),
    "calculation": (_calculation, "There is nothing to calculate until the contour is solved."),
}

# Ranges ------------------------------------------------------------------------------------------------------

_MARGIN = 0.1
"""Share of a range that a slider shows beyond its ends."""


def frames_of(exploration: Exploration) -> dict[str, str]:
    """The text around each word with a value, by the word's key: its range stays as long as this does. Of the rest of a
    program there is a mark."""
    answer = exploration.answer
    if answer is None:
        return {}
    blocks = exploration.result.program.blocks
    rest = "\n".join(each.text for each in blocks if not exploration.has(each.line))
    mark = f"{crc32(rest.encode()):08x}\n" if rest else ""
    own = [each for each in blocks if exploration.has(each.line)]
    places = places_of(answer)
    typed = {key: places[word.span] for key, word in words_of(answer).items() if word.number is not None}
    spans = {key: each.span for key, each in typed.items() if not each.formulas}
    tool = tool_place(exploration)
    spans |= {TOOL: tool[0]} if tool is not None else {}
    return {key: mark + _frame(own, span) for key, span in spans.items()}


def _frame(blocks: Sequence[Block], span: Span) -> str:
    return "\n".join(
        block.text[: span.column - 1] + "\0" + block.text[span.end_column - 1 :]
        if block.line == span.line
        else block.text
        for block in blocks
    )


def range_of(exploration: Exploration, field: Mapping[str, Any]) -> Data:
    """The ranges of the word of a field, and the ends that its slider needs to show them; nothing for a word of which
    no range can be told."""
    if field["key"] == TOOL:
        return _range_of_tool(exploration, field)
    if any(each.about is ReadIssue.UNDERDETERMINED for _, each in exploration.findings):
        return {}  # whatever this word says, others are missing
    low, high = field["low"], field["high"]
    within = (low - (high - low) / 2, high + (high - low) / 2) if field["unit"] == "deg" else None
    asked = _alone(exploration, field["key"])
    if asked is None:
        return {}
    text, name, label, options = asked
    try:
        found = feasible(text, name, within=within, **options)
    except FamilyError:  # facts without a closed form, words that only choose
        return {}
    # An end that is far away on the scale of the contour is not worth a slider that is too coarse.
    near = (field["value"] - field["size"], field["value"] + field["size"])
    margin = _MARGIN * (high - low)
    for each in found.intervals:
        if field["value"] in each:
            low = min(low, each.low.value - margin) if each.low.value > near[0] else low
            high = max(high, each.high.value + margin) if each.high.value < near[1] else high
    ends = [
        [end.reason.text.replace(called(found.word), label) if end.reason else "" for end in (each.low, each.high)]
        for each in found.intervals
    ]
    note, whole = range_texts(found, field["key"].rpartition(":")[2], field["value"])
    return {
        "intervals": [[each.low.value, each.high.value] for each in found.intervals],
        "stops": [[float(each.low.typed), float(each.high.typed)] for each in found.intervals],
        "ends": ends,
        "low": max(low, found.within[0]),
        "high": min(high, found.within[1]),
        "note": note,
        "whole": whole,
        "reason": "; ".join(dict.fromkeys(text for own in ends for text in own if text)),
        "snaps": snaps_of(exploration, field["key"]),
    }


def _range_of_tool(exploration: Exploration, field: Mapping[str, Any]) -> Data:
    """The radii of tools that cut the contour."""
    answer = exploration.answer
    runs = exploration.tool.runs if exploration.tool is not None else ()
    own = [each for each in runs if answer is not None and not {*answer.lines}.isdisjoint(each.run.lines)]
    most = min((float(each.typed_radius(4)) for each in own if each.largest_radius is not None), default=None)
    if most is None:
        return {"low": field["low"], "high": field["high"], "note": "every tool fits" if own else ""}
    told = {"note": f"R ≤ {most:.10g}", "ends": [["", "the tool does not fit"]], "stops": [[0.0, most]], "snaps": []}
    return {"intervals": [[0.0, most]], "low": 0.0, "high": field["high"], "whole": "", "reason": "", **told}


def _alone(exploration: Exploration, key: str) -> tuple[str, str, str, Mapping[str, Any]] | None:
    """The text, the word, its name for the reader, and the options, for a question about a contour by itself; None
    where it rests on the rest of its program."""
    answer, options = exploration.answer, exploration.options
    if answer is None:
        return None
    word = words_of(answer)[key]
    if exploration.place is None:
        words = [each for block in exploration.result.program.blocks for each in block.words]
        is_alone = sum(each.address == word.address for each in words) == 1
        name = word.address if is_alone else f"{word.span.line}:{word.address}"
        return exploration.text, name, called(key), options
    reading: Data = {name: options[name] for name in ("control", "rules", "settings") if name in options}
    reading["units"] = answer.unit.value
    text = standing_alone(answer, is_exact=True)
    blocks = answer.claim.blocks
    first = text.count("\n") + 2 - len(blocks)
    at = next(number for number, block in enumerate(blocks) if block.line == word.span.line)
    return (text, f"{first + at}:{word.address}", called(key), reading) if text else None
