"""Drafts of repairs for blocks that state further facts or ask for values; rules of the manual only warn there."""

import re
from collections.abc import Iterable, Iterator
from decimal import Decimal
from itertools import combinations, islice, product

from contoursolve.diagnosis.answer_records import AskedValue
from contoursolve.diagnosis.attempt import Trial
from contoursolve.diagnosis.drafts import (
    OF_CORNERS,
    fitting,
    marked,
    unreadable,
)
from contoursolve.diagnosis.edits import (
    FACT_VALUE,
    PLACEHOLDER,
    Edit,
    EditKind,
    Why,
    add,
    change,
    drop,
    rounded,
    with_value,
    write_word,
)
from contoursolve.diagnosis.examine import Answer, problems
from contoursolve.diagnosis.examples import sampled
from contoursolve.diagnosis.explain import SAID_AGAIN, facts_at, spans_of
from contoursolve.diagnosis.sample_drawing import sample_drawing
from contoursolve.diagnosis.slip_kinds import partners
from contoursolve.diagnostics import Diagnostic, Span
from contoursolve.gcode import FACT, Word
from contoursolve.geometry import Fact, Line, Profile, Unit, assemble, both, word_of
from contoursolve.numeric import trimmed
from contoursolve.reading import ParsedContour, ReadIssue, check, read
from contoursolve.solving import (
    Status,
    Topic,
    analyse,
    choose,
    numbers_of,
    pick,
    refusals_about,
    tied_with,
)

MOST_ADDED = 2
"""Words that a repair adds to such a block."""

MOST_CUTS = 3
"""Points that only cut a line or a circle in two, beside these words."""

MOST_HELPING, MOST_SHOWN = 20, 12
"""Of a chain in which any word may stand: the words that are combined, and the sets of them that are tried."""

_NO_CORNERS = {*refusals_about(Topic.NO_CORNER), ReadIssue.CORNER_TWICE}
_TWICE = SAID_AGAIN | refusals_about(Topic.RADII)
_USELESS = (ReadIssue.FACT_UNREADABLE, ReadIssue.FACT_IMPOSSIBLE)
_DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")


def further_drafts(answer: Answer, trial: Trial) -> Iterator[Iterable[tuple[Edit, ...]]]:
    """The stages of drafts, simplest first."""
    if answer.claim.form.is_general and answer.status is Status.REJECTED:
        yield lawful(answer, trial)
    findings = [each for each in problems(answer) if each.about is not None]
    if not findings:
        return
    yield _picked(answer)
    yield marked(answer)
    yield _brackets(answer)
    yield _decimal_commas(answer)
    yield _useless(answer, findings)
    twice = [each for each in findings if each.about in _TWICE]
    ways = _completing(answer, trial) if answer.claim.form.is_general else _additions(answer)
    missing = list(ways) if any(each.about is ReadIssue.UNDERDETERMINED for each in findings) else [()]
    drops = [[(drop(word),) for word in _blamed(answer, each)] for each in twice]
    yield [tuple(dict.fromkeys(sum(choice, ()))) for choice in product(*drops, missing) if any(choice)]
    yield _corrected(answer, twice, trial)
    yield fitting(answer)
    yield _without_corners(answer, findings)
    nowhere = spans_of(findings, ReadIssue.CORNER_NOWHERE)
    # Corners after which nothing says where the path leads.
    yield [tuple(drop(word) for word in answer.claim.words.values() if word.span in nowhere)] if nowhere else ()


def _without_corners(answer: Answer, findings: list[Diagnostic]) -> Iterator[tuple[Edit, ...]]:
    """The corners that cannot be made, left out: all, and each alone."""
    spans = spans_of(each for each in findings if each.about in OF_CORNERS or each.about in _NO_CORNERS)
    found = [drop(answer.claim.words[name]) for name in answer.claim.form.outline.shapes if name in answer.claim.words]
    edits = [edit for edit in found if edit.span in spans]
    yield from ((edit,) for edit in edits)
    if len(edits) > 1:
        yield tuple(edits)


def _picked(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """Of several contours each, by the words that choose it, where the control has such."""
    word = answer.claim.form.free.picking
    if not word or answer.status is not Status.AMBIGUOUS or answer.alternatives is None:
        return
    profile, blocks = answer.profile, answer.claim.blocks
    lines = {name: block.line for block, names in zip(blocks, answer.claim.makes, strict=True) for name in names}
    eligible = [item for item in choose(answer.alternatives, profile.choices) if item.is_path]
    paths, _ = pick(eligible, profile)
    for item in paths:
        picks = numbers_of(item, paths, profile)
        places = [lines[profile.figure.path[each.element - 1].name] for each in picks]
        texts = [f"\n{answer.claim.lexicon.spell(word, str(each.number))}" for each in picks]
        yield tuple(Edit(EditKind.ADD, word, text=text, line=line) for text, line in zip(texts, places, strict=True))


def _brackets(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """The places in comments with [ ] for ( ), which would end the comment."""
    for block in answer.claim.blocks:
        for directive in (each for each in block.directives if each.span.line == block.line):
            begin = directive.span.column - 1 + directive.text.find("(")
            end = block.text.find(")", begin)
            if "(" in directive.text and ")" in block.text[end + 1 :]:
                old, span = block.text[begin : end + 1], Span(block.line, begin + 1, end + 2)
                yield (change(Word(FACT, None, False, old, span), f"[{old[1:-1]}]"),)


def _decimal_commas(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """Facts with a decimal comma, with a point for it: no comma of a fact stands between digits otherwise."""
    for word in map(word_of, answer.claim.directives):
        text = _DECIMAL_COMMA.sub(".", word.text)
        if text != word.text:
            yield (change(word, text),)


def _useless(answer: Answer, findings: list[Diagnostic]) -> Iterator[tuple[Edit, ...]]:
    """Drafts without the text that cannot be read or says nothing."""
    spans = [each.span for each in findings if each.about in _USELESS]
    facts = [word for word in map(word_of, answer.claim.directives) if any(_holds(word.span, span) for span in spans)]
    dropped = tuple(drop(word) for word in facts)
    for forced in unreadable(answer.claim):
        if forced or dropped:
            yield (*forced, *dropped)


def _holds(outer: Span, inner: Span) -> bool:
    return outer.line == inner.line and outer.column <= inner.column <= outer.end_column


def _blamed(answer: Answer, finding: Diagnostic) -> list[Word]:
    """The words and facts that say something twice, the one that the finding is about first."""
    profile = answer.profile
    system = assemble(profile)
    stated = facts_at(profile, finding.span)
    names = dict.fromkeys(name for fact in stated for name in (fact.given, *tied_with(system, fact)))
    words = (profile.givens[name].word for name in names)
    return list({word.span: word for word in words if word is not None}.values())


def _additions(answer: Answer) -> Iterator[tuple[Edit, ...]]:
    """Words that the form could have besides, without their numbers: each alone, then several; none for the coordinate
    that a word asks for, as U beside X?."""
    claim = answer.claim
    facts = [row.fact for row in claim.form.outline.facts if row.fact.given in claim.vocabulary]
    asked = {_coordinate(fact) for fact in facts if fact.given in claim.words and claim.words[fact.given].is_asked}
    names = [fact.given for fact in facts if _coordinate(fact) is None or _coordinate(fact) not in asked]
    edits = [add(claim, name) for name in dict.fromkeys(names) if name not in claim.words]
    for size in range(1, MOST_ADDED + 1):
        yield from combinations(edits, size)


def _completing(answer: Answer, trial: Trial) -> Iterator[tuple[Edit, ...]]:
    """Words that determine a chain in which any may stand, the usual ones first: each alone, or else two."""
    claim = answer.claim

    def freedom(edits: tuple[Edit, ...]) -> int:
        found = trial.find(sampled(edits, claim.lexicon))
        system = assemble(read(found, frozenset())) if found else None
        return len(system.unknowns) - analyse(system).rank if system else len(claim.vocabulary)

    all_open = freedom(())
    if all_open > MOST_ADDED + MOST_CUTS:
        return
    halves = (
        name
        for name, (address, index) in claim.vocabulary.items()
        if any(map(claim.blocks[index].find, partners(address)))
    )
    usual = dict.fromkeys((*halves, *claim.form.free.usual))
    absent = [name for name in usual if name not in claim.words and name in claim.vocabulary]
    here = trial.find(())
    absent = _about_open(absent, claim, read(here, frozenset())) if here else absent
    drawing = sample_drawing(claim, answer.profile, absent)
    if drawing is not None and not drawing.missing():
        # It is of another contour, in which nothing is open.
        drawing = None
    cuts = len(drawing.cuts()) if drawing is not None else 0
    open_ = drawing.missing() if drawing is not None and cuts else all_open
    if open_ > MOST_ADDED:
        return
    names = {add(claim, name): name for name in (absent if drawing is None else drawing.helping(absent))}
    helping = list(islice((edit for edit in names if freedom((edit,)) < all_open), MOST_HELPING))

    def is_enough(edits: tuple[Edit, ...]) -> bool:
        told = [names[edit] for edit in edits]
        there = drawing is None or not drawing.further.keys() >= {*told} or not drawing.missing(told)
        return there and freedom(edits) <= cuts

    for size in range(1, MOST_ADDED + 1):
        sets = (each for each in combinations(helping, size) if open_ <= size and is_enough(each))
        if shown := list(islice(sets, MOST_SHOWN)):
            yield from shown
            return


def _about_open(names: Iterable[str], claim: ParsedContour, profile: Profile) -> list[str]:
    """Some words without those that speak only of what is determined already: none of them completes a chain."""
    system = assemble(profile)
    known = system.known | {*system.unknowns} - {*analyse(system).free}
    lines = {each.name: each for each in (*profile.figure.path, *profile.figure.lines) if isinstance(each, Line)}
    reads: dict[str, set[str]] = {}
    for row in claim.form.outline.facts:
        reads.setdefault(row.fact.given, set()).update(row.fact.reads())

    def is_known(name: str) -> bool:
        line = lines.get(name.rpartition(".")[0])
        return name in known or (line is not None and known.issuperset(both(line.tail, line.head)))

    return [name for name in names if name not in reads or not all(map(is_known, reads[name]))]


def _coordinate(fact: Fact) -> tuple[str, int] | None:
    """The point and the axis of the coordinate that a fact states."""
    return fact.placed[:2] if fact.placed and fact.given else None


def _corrected(answer: Answer, twice: list[Diagnostic], trial: Trial) -> Iterator[tuple[Edit, ...]]:
    """One word or fact of those that disagree with the value that the others give it: it is asked for instead."""
    lexicon = answer.claim.lexicon
    for finding in twice if any(each.is_error for each in twice) else ():
        for word in _blamed(answer, finding):
            asking = with_value(word, PLACEHOLDER, lexicon.spelling)
            if not asking or (word.address != FACT and word.number is None):
                continue
            other = trial.examine((change(word, asking),))
            for asked in other.asked if other else ():
                if asked.value is not None and asked.question.word.text == asking:
                    yield (change(word, with_value(word, _shown(asked, word, answer), lexicon.spelling), Why.AGREES),)


def _shown(asked: AskedValue, word: Word, answer: Answer) -> str:
    """A value as a word or a fact states it, rounded to the least increment."""
    lexicon, value, unit = answer.claim.lexicon, float(asked.value or 0), asked.question.unit
    match = FACT_VALUE.search(word.text)
    stated = word.number if match is None or match["value"] == "?" else Decimal(match["value"])
    if unit is Unit.DEGREE and stated is not None:
        value += 360 * round((float(stated) - value) / 360)
    if word.address != FACT:
        return lexicon.number_of(write_word(word.address, value, lexicon, answer.unit), word.address)
    return trimmed(rounded(value, unit, lexicon, answer.unit, is_diameter=asked.question.is_diameter))


def lawful(answer: Answer, trial: Trial) -> Iterator[tuple[Edit, ...]]:
    """A word that the rules ask for in a line that they refuse, or one that they refuse taken out."""
    claim = answer.claim
    offences = check(trial.control.rules, claim.form.roles, claim.stated())
    lines = {claim.blocks[claim.vocabulary[name][1]].line for name in claim.vocabulary for each in offences
             if name.startswith(each.role.prefixes)}  # fmt: skip
    for name, (address, index) in claim.vocabulary.items():
        line, row = claim.blocks[index].line, claim.lexicon.addresses.get(address)
        if name in claim.words or line not in lines or row is None:
            continue
        numbers = ("1", "-1") if row.unit is Unit.SIGN else (PLACEHOLDER,)
        edits = (add(claim, name, claim.lexicon.spell(address, number)) for number in numbers)
        yield from ((edit,) for edit in edits if _is_lawful((edit,), trial))
    for each in offences:
        edits = (drop(claim.words[name]) for name in each.names if name in claim.words)
        yield from ((edit,) for edit in edits if _is_lawful((edit,), trial))


def _is_lawful(edits: tuple[Edit, ...], trial: Trial) -> bool:
    """Whether no rule refuses the edited blocks."""
    found = trial.find(sampled(edits, trial.claim.lexicon))
    return found is not None and not found.unknown and not check(trial.control.rules, found.form.roles, found.stated())
