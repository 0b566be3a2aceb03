"""Puts findings into words: a row of the catalogue, the words of the block, and the values compared."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from decimal import Decimal
from enum import Enum
from functools import cached_property, lru_cache
from math import asin, degrees
from typing import TYPE_CHECKING, Any

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.diagnosis.wording import (
    LEAST_SHOWN,
    NUMBERS,
    angle_text,
    by_line,
    either,
    element_text,
    join,
    length_limit,
    length_text,
    limit_text,
    open_text,
    place_text,
    shorten,
    statement_text,
    tell_apart,
    unknowns_text,
)
from contoursolve.diagnostics import Basis, Diagnostic, Label, Span
from contoursolve.gcode import FACT, Word
from contoursolve.geometry import Arc, BlockRole, Fact, Given, Length, Profile, Unit, assemble
from contoursolve.reading import VERBS, Offence, ParsedContour, ReadIssue, Rule
from contoursolve.solving import (
    BESIDE,
    Contour,
    Determinacy,
    Note,
    NoteKind,
    Refusal,
    RefusalKind,
    Status,
    SystemSolution,
    Topic,
    against_angles,
    compare,
    dropped_corners,
    events_about,
    increments_of,
    lookup,
    opposes,
    refusals_about,
    scalars_of,
)
from contoursolve.tolerance import AGREEMENT, ERROR_BOUND_WARNING

if TYPE_CHECKING:
    from contoursolve.solving import Alternatives

_BEGINNING = Span(1, 1, 2)

MOST_THINGS = 2
"""Points and lines that a message names as missing; beyond it, all of the contour is."""


class Words(Struct, frozen=True):
    """Words in a message, as (name, text). A format keeps only some names: `{words:A B}`."""

    by_name: tuple[tuple[str, str], ...]

    def __format__(self, spec: str) -> str:
        wanted = (spec,) if spec in dict(self.by_name) else spec.split()
        texts = [text for name, text in self.by_name if not spec or name in wanted]
        return shorten(join(texts)) or "the block"


class Present(Struct, frozen=True):
    """The stated words among a list of names: `{present:A I K}`."""

    by_name: Mapping[str, str]

    def __format__(self, spec: str) -> str:
        return join([self.by_name[name] for name in spec.split() if name in self.by_name]) or "none of them"


class NotStated(Struct, frozen=True):
    """The names of a list that are not stated; `X|U` is one of which either will do: `{absent:B X|U}`."""

    by_name: Mapping[str, str]

    def __format__(self, spec: str) -> str:
        slots = [slot.split("|") for slot in spec.split()]
        return " or ".join(" or ".join(slot) for slot in slots if not set(slot) & self.by_name.keys())


class Able(Struct, frozen=True):
    """As `NotStated`, the names of a list that are among some."""

    names: frozenset[str]

    def __format__(self, spec: str) -> str:
        return " or ".join(name for slot in spec.split() for name in slot.split("|") if name in self.names)


class Context(Struct, frozen=True, dict=True):
    """The names that a message may mention: the stated words by name, the unit to show lengths in."""

    rules: Sequence[Rule]
    unit: Length
    words: Mapping[str, Word] = field(default_factory=dict)
    place: Span = _BEGINNING
    """The place to point at if no word is to blame."""
    trusted: frozenset[Span] = frozenset()
    """The places of words that are said to be right: a finding points at the others."""

    @cached_property
    def typed(self) -> Mapping[str, str]:
        """The texts of the words by name."""
        return {name: word.text for name, word in self.words.items()}

    @cached_property
    def names(self) -> Mapping[int, str]:
        """The names of the words by their identity."""
        return {id(word): name for name, word in self.words.items()}

    def row(self, about: Enum) -> Rule:
        """The row about an event. Raises LookupError if the control has none."""
        found = next((rule for rule in self.rules if rule.about is about), None)
        if found is None:
            raise LookupError(f"the rules of this control have no row about {about}; let them end with GEOMETRY_RULES")
        return found


def context_of(claim: ParsedContour, rules: tuple[Rule, ...]) -> Context:
    """The context of a contour; it begins where its first block does, and rows of its own roles come first."""
    return Context(
        _own_first(rules, claim.form.roles),
        claim.after.unit,
        {**claim.kept, **claim.words},
        claim.blocks[0].span,
        claim.trusted,
    )


@lru_cache(maxsize=256)
def _own_first(rules: tuple[Rule, ...], roles: tuple[BlockRole, ...]) -> tuple[Rule, ...]:
    own = {role.name for role in roles}
    return tuple(sorted(rules, key=lambda rule: own.isdisjoint(rule.roles)))


def report(
    context: Context,
    about: Rule | Enum,
    basis: Basis,
    words: Iterable[Word | None],
    values: Mapping[str, float] | None = None,
    labels: Iterable[str] = (),
    **fields: Any,
) -> Diagnostic:
    """One finding: the message of a row, or of the row about an event, with its fields filled in, its words marked; of
    words that are None, nothing stands in the program."""
    rule = about if isinstance(about, Rule) else context.row(about)
    blamed = sorted(filter(None, words), key=lambda word: word.span)
    spans = [word.span for word in blamed] or [context.place]
    stated = {
        "words": Words(tuple(_named(blamed, context))),
        "present": Present(context.typed),
        "absent": NotStated(context.typed),
        "address": blamed[0].address if blamed else "",
        "control": rule.control,
        **{several: several if len(blamed) > 1 else one for several, one in VERBS.items()},
        **fields,
    }
    texts = list(labels) + [""] * len(spans)
    marked = [Label(span, note) for span, note in zip(spans, texts, strict=False)]
    marked.sort(key=lambda label: label.span in context.trusted)
    return Diagnostic(
        code=rule.code,
        severity=rule.severity,
        basis=basis,
        span=marked[0].span,
        message=rule.message.format_map(stated),
        help=rule.help.format_map(stated),
        source=rule.source,
        alarm=rule.alarm,
        labels=tuple(marked),
        addresses=tuple(dict.fromkeys(word.address for word in blamed)),
        values=values or {},
        about=rule.about,
    )


def absent_advice(rule: Rule | None, able: Collection[str]) -> str:
    """The help of a rule that asks for words, of which these are known to help; empty where it asks for none, or where
    none of its own words helps."""
    if rule is None or "{absent:" not in rule.help:
        return ""
    advice = rule.help.format_map({"absent": Able(frozenset(able))})
    return "" if advice.startswith("add ;") else advice


def spans_of(findings: Iterable[Diagnostic], about: Enum | None = None) -> set[Span]:
    """The places that findings are about, or those about one event."""
    chosen = (each for each in findings if about is None or each.about is about)
    return {label.span for each in chosen for label in each.labels}


def facts_at(profile: Profile, place: Span) -> list[Fact]:
    """The facts that the word at a place states."""
    words = {name: given.word for name, given in profile.givens.items() if given.word}
    return [fact for fact in profile.facts if fact.given in words and words[fact.given].span == place]


def _named(words: Sequence[Word], context: Context) -> Iterable[tuple[str, str]]:
    """Words as (name, text): the name of the given, else the address."""
    return ((context.names.get(id(word), word.address), word.text) for word in words)


def explain_offence(context: Context, offence: Offence, claim: ParsedContour) -> Diagnostic:
    """A rule on combinations that holds."""
    givens = claim.givens
    words = [context.words[name] for name in offence.names if name in context.words]
    prefix = offence.role.prefixes[-1]
    if not words:
        # What is missing is missing in the last block that the rule is about.
        block = [word.span for name, word in context.words.items() if name.startswith(prefix)]
        if block and min(block).line != context.place.line:
            context = replace(context, place=min(block))
    turned = (givens[name] for name in offence.names if name in givens and givens[name].unit is Unit.DEGREE)
    within = [claim.lexicon.spell(each.word.address, _pointed(each.value % _FULL_TURN)) for each in turned if each.word]
    is_asked = "{lacking" in offence.rule.message + offence.rule.help
    lacking = join(_lacking(claim, prefix)) if is_asked else ""
    return report(context, offence.rule, Basis.RULE, words, comparison="", within=join(within), lacking=lacking)


def _lacking(claim: ParsedContour, prefix: str) -> list[str]:
    """The fewest addresses whose words make a block, by the prefix of its names, one that states an element."""
    options = [option for slot in claim.form.table.combinations for option in slot]
    own = [[name for name in option if name.startswith(prefix) and name in claim.vocabulary] for option in options]
    missing = [[claim.vocabulary[name][0] for name in names if name not in claim.words] for names in own if names]
    return min(missing, key=len, default=[])


_FULL_TURN = 360


def _pointed(value: Decimal) -> str:
    """A number as a word has it, with its decimal point."""
    text = f"{value:f}"
    return f"{text.rstrip('0')}" if "." in text else f"{text}."


def explain_ignored(context: Context, offence: Offence, profile: Profile, solution: SystemSolution) -> Diagnostic:
    """A word that the control ignores: what it would have had to say, and how far off it is."""
    fact = next((fact for fact in profile.ignored if fact.given == offence.ignored), None)
    word = context.words[offence.ignored]
    if fact is None or not solution.points:  # a variable states no fact
        return report(context, offence.rule, Basis.RULE, [word], comparison="")
    at = lookup(profile, scalars_of(solution.points))
    values = compare(fact, profile, at)
    expected = values.get("expected")
    comparison = "; they leave it no value to have"
    label = ""
    given = profile.givens.get(offence.ignored)
    if expected is not None and given is not None and given.unit is Unit.MM:
        text = length_text(expected if abs(expected) > LEAST_SHOWN else 0.0, context.unit)
        is_same = values["off_by_mm"] <= fact.allowance(at, increments_of(profile))
        away = f"; they make it {text}, {length_text(values['off_by_mm'], context.unit)} away"
        comparison = "; it agrees with them" if is_same else away
        label = f"ignored; the path has {text}"
    elif expected is not None:
        comparison = _compared(values, fact.allowance(at, increments_of(profile)), context.unit)
        label = f"ignored; the line runs at {angle_text(expected)}"
    return report(context, offence.rule, Basis.NUMERICAL, [word], values, [label], comparison=comparison)


def _compared(values: Mapping[str, float], allowed: float, unit: Length) -> str:
    """The comparison of an angle that is ignored with the one that the other words give."""
    gap, off = abs(values["actual"] - values["expected"]), values["off_by_mm"]
    given = f"; they make it {tell_apart((values['expected'], values['actual']), angle_text)[0]}"
    if opposes(values, Unit.DEGREE):
        return f"{given}, the opposite direction" if off <= allowed else f"{given}, {angle_text(gap)} away"
    if off <= allowed:
        return "; it agrees with them" + (" to its least increment" if off > ERROR_BOUND_WARNING else "")
    return f"{given}, {angle_text(gap)} ({length_text(off, unit)}) away"


def explain_missing(
    context: Context,
    profile: Profile,
    verdict: Determinacy,
    claim: ParsedContour,
    unable: Collection[str] = (),
    *,
    is_brief: bool = False,
) -> Diagnostic:
    """Unknowns that no word determines, and the words that do, without those that are known to help nothing (`unable`);
    a brief one does not name them."""
    free = set(verdict.free)
    absent = absent_words(claim, profile, free)
    # Of a corner whose size is not determined, nothing is.
    corners = tuple(f"{corner.name}." for corner in profile.figure.corners if corner.radius in free)
    shown = [name for name in verdict.free if not name.startswith(corners) or name.endswith(".radius")]
    open_count = len(assemble(profile).unknowns) - verdict.rank
    ways = [] if is_brief else list(_adding(absent, claim, profile, unable))
    open_sizes = [question.word.text for question in profile.questions if question.fact.sizes in free]
    valued = [f"give {' or '.join(open_sizes)} a value"] if profile.is_extended and open_sizes else []
    # What is asked may be among the words that are added, too.
    ways = list(dict.fromkeys([*ways, *valued]))
    told = open_text(shown, profile)
    if claim.form.is_general:
        from contoursolve.diagnosis.missing_words import partners_of  # noqa: PLC0415 - few blocks lack words
        from contoursolve.diagnosis.sample_drawing import sample_drawing  # noqa: PLC0415 - nor such

        drawing = None if is_brief else sample_drawing(claim, profile, absent)
        cuts = drawing.cuts() if drawing is not None else []
        if drawing is not None and cuts and drawing.missing():
            # Where a line or a circle is cut in two is no word that is missing.
            free, open_count = {name for name in free if name.rpartition(".")[0] not in cuts}, drawing.missing()
        told, first = _open_elements(free, open_count, profile)
        blocks = zip(claim.blocks, claim.makes, strict=True)
        context = replace(context, place=next((block.span for block, names in blocks if first in names), context.place))
        helping = absent if drawing is None else drawing.helping(absent)
        usual_words = [claim.vocabulary[name] for name in helping[:_MOST_NAMED]]
        ways = [_adding_by_line(usual_words, open_count, claim)] if usual_words else valued
        partners, halves = partners_of(claim)
        if partners:
            asked = _adding_by_line([claim.vocabulary[name] for name in partners], 1, claim, join)
            words = join([claim.words[name].text for name in halves if name in claim.words])
            says = "say" if len(halves) > 1 else "says"
            told, ways = told.partition(", so ")[2], [f"{asked}, without which {words} {says} nothing"]
    completions = "; or ".join(ways) or f"state a fact about {'them' if told.endswith('are still open') else 'it'}"
    return report(context, ReadIssue.UNDERDETERMINED, Basis.SYMBOLIC, [], open=told, completions=completions)


def absent_words(claim: ParsedContour, profile: Profile, free: Collection[str]) -> list[str]:
    """The usual words that a contour does not state, and that say something of what is free, by their names."""
    stated = {fact.given for fact in profile.facts}
    able = [
        row.fact.given
        for row in claim.form.outline.facts
        if row.fact.given and row.fact.given not in stated and {*free}.intersection(row.fact.reads())
    ]
    usual = claim.form.free.usual if claim.form.is_general else able
    return [name for name in dict.fromkeys(usual) if name in able and name in claim.vocabulary]


_MOST_NAMED = 8
"""Words that a message names as missing."""


def _open_elements(free: set[str], number: int, profile: Profile) -> tuple[str, str]:
    """The number of missing words, and which elements they leave open; and the first of these."""
    corners = {f"{each.name}.": each.name for each in profile.figure.corners}
    things = {
        next((corner for begin, corner in corners.items() if name.startswith(begin)), name.rpartition(".")[0] or name)
        for name in free
    }
    open_ = [
        each.name
        for each in profile.figure.path
        if things & {each.name, each.head, *((each.center, each.radius) if isinstance(each, Arc) else ())}
    ]
    # Of what is beside the path, such as a pole, the elements do not tell.
    open_ = open_ or sorted(things)
    missing = f"{NUMBERS.get(number, number)} word{' is' if number == 1 else 's are'} missing"
    told = f"{join(open_)} {'is' if len(open_) == 1 else 'are'} open" if open_ else "the contour is open"
    return f"{missing}, so {told}", next(iter(open_), "")


def _adding_by_line(
    words: Sequence[tuple[str, int]], number: int, claim: ParsedContour, joined: Callable[[list[str]], str] = either
) -> str:
    """To add so many of these words, those of one line together."""
    lines: dict[int, list[str]] = {}
    for address, index in words:
        lines.setdefault(claim.blocks[index].line, []).append(address)
    told = [f"{joined(own)} in program line {line}" for line, own in lines.items()]
    amount = "" if number == 1 else f"{NUMBERS.get(number, number)} of "
    return f"add {amount}{', or '.join(told) if number == 1 else ', '.join(told)}"


def _adding(names: Sequence[str], claim: ParsedContour, profile: Profile, unable: Collection[str]) -> Iterator[str]:
    """To add the words that complete a contour, with their lines where it has several; to give a value to one that is
    there and asks for it."""
    from contoursolve.diagnosis.missing_words import lack_of, lack_text, still_able  # noqa: PLC0415 - few blocks lack words

    if claim.form.is_general:
        return
    lack = lack_of(claim, profile, names)
    lack = (still_able(lack, unable) or lack) if lack else None
    if lack is None:
        return
    asking = [name for name in names if name in claim.words and claim.words[name].is_asked]
    asking = [name for name in asking if lack.number == 1 and any(name in kind for kind in lack.kinds)]
    if asking:
        yield f"give {either([claim.words[name].text for name in asking])} a value"
        lack = still_able(lack, asking)
    if lack is None:
        return
    lines = {name: claim.blocks[claim.vocabulary[name][1]].line for kind in lack.kinds for name in kind}
    is_one = len({*lines.values()}) == 1

    def text(name: str) -> str:
        return claim.vocabulary[name][0] + ("" if is_one else f" in program line {lines[name]}")

    where = f" in program line {next(iter(lines.values()))}" if len(claim.blocks) > 1 and is_one else ""
    yield lack_text(lack, text) + where


OF_A_WORD = events_about(Topic.WORD)
SAID_AGAIN = events_about(Topic.WORD, Topic.FACT)
"""Events about a word or a fact that follows from others."""
SINGULAR = events_about(Topic.SINGULAR)
"""Events about facts that leave something free at their values only; they name all words that they are about."""
LEAVING_FREE = frozenset(kind for kind in RefusalKind if kind.status is Status.UNDERDETERMINED)
AGAINST = refusals_about(Topic.WORD, Topic.FACT, Topic.RADII, Topic.SINGULAR) - LEAVING_FREE
"""Refusals of words and facts that contradict one another."""


def explain_result(
    context: Context, event: Refusal | Note, profile: Profile, alternatives: Alternatives | None = None
) -> Diagnostic:
    """A refusal or a remark of the solver; `alternatives` is what a search found."""
    if event.kind is NoteKind.WORDS_AGREE and opposes(event.values, profile.givens[event.subject].unit):
        return _explain_opposite(context, event.subject, event.values["expected"], profile)
    names = [name for name in event.givens if name in profile.givens]
    givens = [profile.givens[name] for name in names]
    stated = [profile.givens[name].word or context.words.get(name) for name in names]
    asked = [question.word for question in profile.questions if question.name in event.givens]
    words = list({word.span: word for word in (*stated, *asked) if word}.values())
    values = dict(event.values)
    things = list(dict.fromkeys(name.rpartition(".")[0] or name for name in event.subject.split(",")))
    fields: dict[str, Any] = {
        "subject": element_text(event.subject),
        "free": unknowns_text(event.subject.split(","), profile),
        "things": join(things) if len(things) <= MOST_THINGS else "contour",
        "together": " together" if len(words) > 1 else "",
        # Of a line whose direction no word states.
        "expected": "180 deg from that",
    }
    is_word = event.kind in OF_A_WORD
    compared = [name for name in ("limit", "expected", "actual") if name in values]
    if is_word:
        values |= {name: givens[0].as_typed(values[name]) for name in compared}
    in_degrees = event.kind.event.in_degrees or (is_word and givens[0].unit is Unit.DEGREE)
    write = angle_text if in_degrees else lambda value, more: length_text(value, context.unit, more)
    fields |= zip(compared, tell_apart([values[name] for name in compared], write), strict=True)
    fields |= {name: length_text(values[name], context.unit) for name in ("radius", "distance") if name in values}
    if "off_by_mm" in values:
        turned = _turned(event, givens, words)
        fields["off"] = _off(event, turned, context.unit, profile, is_diameter=is_word and givens[0].is_diameter)
    if is_word and "expected" in values:
        fields["meant"] = statement_text(givens[0], values["expected"], profile)
    fields |= {**_counted(event, alternatives), **_outside(event, context.unit, profile)}
    notes: tuple[str, ...] = ()
    if event.kind in SAID_AGAIN:
        fields |= _others(event, profile)
    if event.kind.event.status is Status.UNDECIDED and alternatives is not None:
        fields["advice"] = _ADVICE[alternatives.doubts[0].obstacle.name]
        notes = tuple(_search_notes(profile, alternatives))
        # Whether everything nearby is decided, and only what lies farther away is not.
        is_near = all(doubt.obstacle.name == "FARTHER" for doubt in alternatives.doubts)
        far = length_text(alternatives.reach, profile.unit) if is_near and alternatives.reach is not None else ""
        fields |= {"within": f" within {far} of the start point", "does": "lies farther away"} if far else {}
        fields = {"within": "", "does": "fits", **fields}
    labels = [f"expected {fields['expected']}"] if "expected" in compared else []
    if event.kind is RefusalKind.RADIUS_TOO_SMALL:
        fields["limit"] = limit_text(length_limit(values["limit"], context.unit, -1), context.unit.value)
    if "fits" in event.kind.event.needs and isinstance(event, Refusal):
        more, labels = _room(event, values, profile)
        fields |= more
    if event.kind.event.limits == BESIDE:
        rooms = _rooms(event, values, words, profile)
        labels = [label for _, label in rooms]
        advice = [advice for advice, _ in rooms if advice]
        if rooms and not any(each.startswith("write") for each in advice):
            advice += _for_both(values, profile.unit)
        fields["smaller"] = ", or ".join(advice) or f"make the corners smaller, to need {fields['off']} less together"
    finding = _against_trusted(context, event, words, values, profile, fields)
    finding = finding or report(context, event.kind, Basis.NUMERICAL, words, values, labels, **fields)
    if isinstance(event, Refusal):
        finding = _without_number(finding, event, words, fields)
        finding = _with_what_helps(finding, event, values, asked, profile)
    return replace(finding, notes=finding.notes + notes)


def _turned(event: Refusal | Note, givens: Sequence[Given], words: Sequence[Word]) -> float | None:
    """By how much a direction is off, degrees; None where millimetres say it."""
    if event.kind not in OF_A_WORD or givens[0].unit is not Unit.DEGREE or "expected" not in event.values or not words:
        return None
    # Of an opposite direction, millimetres tell nothing.
    is_turned = words[0].address == FACT or event.values["off_by_mm"] <= AGREEMENT or _is_bare(words[0])
    expected, actual = (givens[0].as_typed(event.values[name]) for name in ("expected", "actual"))
    return abs(expected - actual) if is_turned else None


def _is_bare(word: Word) -> bool:
    """Whether a word states something without a number: that an element touches the one before it."""
    return word.text == word.address


def _without_number(
    finding: Diagnostic, event: Refusal, words: Sequence[Word], fields: Mapping[str, str]
) -> Diagnostic:
    """The finding; about a word without a number, none that could be written instead."""
    if event.kind not in SAID_AGAIN or not words or not _is_bare(words[0]):
        return finding
    word = words[0].text
    return replace(
        finding,
        message=f"{word} disagrees with {fields['others']} by {fields['off']}",
        help="correct one of them",
        labels=tuple(replace(each, text="") for each in finding.labels),
    )


def _against_trusted(
    context: Context,
    event: Refusal | Note,
    words: Sequence[Word],
    values: Mapping[str, float],
    profile: Profile,
    fields: Mapping[str, str],
) -> Diagnostic | None:
    """The finding that others disagree with words which are right; None where these are not right, or all others are,
    too."""
    is_trusted = bool(words) and {word.span for word in words} <= context.trusted
    if not is_trusted or event.kind not in SAID_AGAIN or not isinstance(event, Refusal):
        return None
    others = [word for word in _tied_words(event, profile) if word.span not in context.trusted]
    if not others:
        return None
    wrong, trusted = (join([word.text for word in each]) for each in (others, words))
    verb = "disagree" if len(others) > 1 else "disagrees"
    finding = report(context, event.kind, Basis.NUMERICAL, [*words, *others], values, **fields)
    message = f"{wrong} {verb} with {trusted}, which you trust, by {fields['off']}"
    return replace(finding, message=message, help=f"correct {wrong}")


def _off(event: Refusal | Note, turned: float | None, unit: Length, profile: Profile, *, is_diameter: bool) -> str:
    """By how much something is off: by an angle (`turned`, degrees) where a fact is about directions; as a diameter
    where its word is one."""
    off = event.values["off_by_mm"]
    if any(event.subject == fact.statement and fact.parallel for fact in profile.facts):
        turned = degrees(asin(min(1.0, off)))
    turned = event.values.get("turned_by", turned)
    return length_text(off * (1 + is_diameter), unit) if turned is None else angle_text(turned)


def _outside(event: Refusal | Note, unit: Length, profile: Profile) -> dict[str, str]:
    """By how much a corner is outside its lines, and along which axis: as a diameter where that is one."""
    if "axis" not in event.kind.event.needs or not isinstance(event, Refusal):
        return {}
    (axis,) = event.elements
    is_diameter = profile.plane.diameters[profile.plane.axes.index(axis)]
    off = length_text(event.values["off_by_mm"] * (1 + is_diameter), unit)
    return {"off": off, "axis": f"{axis} (diameter)" if is_diameter else axis}


def _counted(event: Refusal | Note, alternatives: Alternatives | None) -> dict[str, str]:
    """The number of contours, or of solutions at an element."""
    if event.kind is NoteKind.SEVERAL:
        is_open = alternatives is not None and not alternatives.is_complete
        return {"count": f"{'at least ' if is_open else ''}{event.values['actual']:.0f}"}
    if event.kind.event.topic is Topic.PICK:
        count = int(event.values["limit"])
        numbers = "1" if count == 1 else f"a number from 1 to {count}"
        return {"limit_count": f"{count} solution{'s' * (count != 1)}", "numbers": numbers}
    return {}


def _with_what_helps(
    finding: Diagnostic, event: Refusal, values: Mapping[str, float], asked: Sequence[Word], profile: Profile
) -> Diagnostic:
    """The finding with what its row cannot say: the largest bevel, what takes the room, where an answer comes from."""
    if event.kind is RefusalKind.BEVEL_IN_BAND and "limit" in values:
        _, shown = _largest(values["limit"], profile.unit)
        finding = replace(
            finding,
            labels=(Label(finding.span, f"at most {shown}"), *finding.labels[1:]),
            help=f"write at most {shown}, or {finding.help}",
        )
    # A negative length says that a corner would leave an arc beyond its end.
    if event.elements and values.get("needed", -1.0) >= 0:
        available, needed = (length_text(values[name], profile.unit) for name in ("available", "needed"))
        note = f"{element_text(event.elements[0])} is {available} long; {event.subject} takes {needed} of it"
        finding = replace(finding, notes=(note,))
    if event.beside and "together" in values:
        takers = [given.word for name in event.beside if (given := profile.givens.get(name)) and given.word]
        finding = replace(
            finding, labels=(*finding.labels, *(Label(word.span, "takes all the room") for word in takers))
        )
    if asked:
        causes = list(dict.fromkeys(text for word in asked for text in _causes(word, profile)))
        advice = f"change {join(causes) or 'another word'}: the value follows from there"
        finding = replace(finding, help=advice, labels=tuple(replace(each, text="") for each in finding.labels))
    return finding


def _room(event: Refusal, values: Mapping[str, float], profile: Profile) -> tuple[dict[str, str], list[str]]:
    """The room for a corner, as fields of its row, and its label."""
    largest, shown = _largest(values["limit"], profile.unit)
    others = (profile.givens[name].word for name in event.beside if name in profile.givens)
    beside = join([_named_in(word, profile) for word in others if word])
    beside = f" beside {beside}" if beside else ""
    where = element_text(event.elements[-1]) if event.elements else "its elements"
    if not largest:
        fits = f"no room is left{beside}" if beside else "nothing fits"
        smaller = ", or ".join(["delete it", *_for_both(values, profile.unit)])
        return {"limit": shown, "fits": fits, "where": where, "smaller": smaller}, [f"no room left{beside}"]
    fields = {"limit": shown, "fits": f"at most {shown} fits", "where": where, "smaller": f"write at most {shown}"}
    return fields, [f"at most {shown}{beside}"]


def _for_both(values: Mapping[str, float], unit: Length) -> list[str]:
    """The sizes that corners may have, which leave each other no room, if all of them come down."""
    largest, shown = _largest(values.get("together", 0.0), unit)
    return [f"write at most {shown} for both"] if largest else []


def _largest(limit: float, unit: Length) -> tuple[Decimal, str]:
    """The largest size (mm) as it is shown, in the program's unit."""
    largest = length_limit(limit, unit)
    return largest, limit_text(largest, unit.value)


def _named_in(word: Word, profile: Profile) -> str:
    """A word, with its line where there are several."""
    return by_line([(word.text, word.span.line)]) if len(profile.blocks) > 1 else word.text


def _rooms(
    event: Refusal | Note, values: dict[str, float], words: Sequence[Word], profile: Profile
) -> list[tuple[str, str]]:
    """For either of two words for corners that overlap, in the order of the words, which the values then have, too:
    what to write if the other one stays, and its label; for one of them if the other one cannot stay."""
    known = {name: values.pop(key) for name, key in zip(event.givens, BESIDE, strict=False) if key in values}
    sizes = {given.word: known[name] for name in known if (given := profile.givens.get(name)) and given.word}
    own = sorted(words, key=lambda word: word.span)
    if len(own) != len(BESIDE) or not sizes:
        return []
    values |= {key: sizes[word] for key, word in zip(BESIDE, own, strict=True) if word in sizes}
    names = [_named_in(word, profile) for word in own]
    rooms = []
    for word, name, other in zip(own, names, reversed(names), strict=True):
        largest, shown = _largest(sizes.get(word, 0.0), profile.unit)
        if word not in sizes:
            rooms.append(("", ""))
        elif largest:
            rooms.append((f"write at most {shown} for {name}", f"at most {shown} beside {other}"))
        else:
            rooms.append((f"delete {name}", f"no room left beside {other}"))
    return rooms


def _causes(asked: Word, profile: Profile) -> Iterator[str]:
    """The words and facts that determine the size of a corner that is asked for."""
    from contoursolve.solving import settled_by  # noqa: PLC0415 - few blocks ask for anything

    for question in profile.questions:
        if question.word is asked and question.fact.sizes:
            for name in settled_by(profile, question.fact.sizes):
                word = profile.givens[name].word
                if word is not None:
                    yield word.text


def _tied_words(event: Refusal | Note, profile: Profile) -> list[Word]:
    """The words and facts from which a word or a fact follows."""
    from contoursolve.solving import tied_with  # noqa: PLC0415 - few blocks say anything twice

    system = assemble(profile)
    facts = [fact for fact in profile.facts if fact.statement == event.subject]
    names = [name for fact in facts for name in tied_with(system, fact) if name != event.subject]
    return [word for word in (profile.givens[name].word for name in dict.fromkeys(names)) if word]


def _others(event: Refusal | Note, profile: Profile) -> dict[str, str]:
    """The same in words, or else all others, and their verbs."""
    words = _tied_words(event, profile)
    if len(words) == 1:
        return {"others": words[0].text, "they": words[0].text, "give": "gives"}
    are_named = profile.is_extended or len(words) <= _FEW
    text = join([word.text for word in words]) if are_named and words else "the other words"
    return {"others": text, "they": "they", "give": "give"}


_FEW = 4
"""Words that a message names; beyond it, they are the others."""


# By name: the obstacles belong to the search, which few blocks need.
_ADVICE = {
    "SINGULAR": "state another fact in place of one of them",
    "UNDECIDED": "change a value a little: the case is too close to a limit to be decided",
    "TOUCHING": "change a value a little: two places are one, or none, as far as numbers can tell",
    "NO_CLOSED_FORM": "state a simpler fact in place of one of them, such as a coordinate or a direction",
    "FARTHER": "state one more fact, or a simpler one in place of one of them, such as a coordinate",
    "UNFINISHED": "state a simpler fact in place of one of them, such as a coordinate or a direction",
}


def _search_notes(profile: Profile, alternatives: Alternatives) -> Iterator[str]:
    """Notes on what was tried, and what is not decided."""
    way = "in closed form"
    if alternatives.reach is not None:
        way = f"by a search within {length_text(alternatives.reach, profile.unit)} of the start point"
    yield f"tried: every combination of sides, {way}"
    for doubt in alternatives.doubts:
        yield f"not decided: {unknowns_text(doubt.unknowns, profile)}: {doubt.obstacle.value}"


def explain_singular(context: Context, names: Sequence[str], loose: Sequence[str], profile: Profile) -> Diagnostic:
    """Facts that do not fix what they are about at their values, though they would at others."""
    words = [profile.givens[name].word for name in names]
    return report(context, ReadIssue.FACTS_SINGULAR, Basis.NUMERICAL, words, free=unknowns_text(loose, profile))


def explain_path(
    context: Context, profile: Profile, solution: SystemSolution, contour: Contour
) -> Iterator[Diagnostic]:
    """Findings about a path that may not be meant: it goes on across the spindle axis, lines run against the angle that
    states them where that is no direction of travel, and corners are left out where it hardly turns."""
    crossing = contour.crossing
    if crossing is not None:
        (radius,) = (at for at, is_diameter in zip(crossing.at, contour.plane.diameters, strict=True) if is_diameter)
        start, place = (place_text(profile, scalars_of({"": at})) for at in (crossing.element.start, crossing.at))
        values, subject = {"limit": 0.0, "actual": radius, "off_by_mm": abs(radius)}, crossing.element.name
        about, names = ReadIssue.AXIS_CROSSED, [each.name for each in profile.figure.path]
        own = context
        if subject in names and len(names) == len(profile.blocks):
            own = replace(context, place=profile.blocks[names.index(subject)].span)
        yield report(own, about, Basis.NUMERICAL, [], values, subject=subject, start=start, place=place)
    told = {remark.subject for remark in solution.remarks if remark.kind is NoteKind.WORDS_AGREE}
    for name, _ in against_angles(profile, contour):
        if name not in told:
            actual = float(profile.givens[name].value)
            yield _explain_opposite(context, name, actual - 180 if actual > 0 else actual + 180, profile)
    for corner, turn in dropped_corners(profile, solution):
        word, values, shown = profile.givens[corner.size].word, {"actual": abs(turn)}, angle_text(abs(turn))
        about = ReadIssue.CORNER_DROPPED
        yield report(context, about, Basis.NUMERICAL, [word], values, subject=corner.name, actual=shown)


def _explain_opposite(context: Context, name: str, expected: float, profile: Profile) -> Diagnostic:
    """An angle of a line that runs the other way."""
    given = profile.givens[name]
    tails = {fact.heading[0] for fact in profile.facts if fact.heading and fact.given == name}
    line = next(each for each in profile.figure.path if each.tail in tails)
    values = {"actual": given.as_typed(float(given.value)), "expected": given.as_typed(expected)}
    expected = values["expected"]
    shown, about = angle_text(expected), ReadIssue.ANGLE_OPPOSITE
    return report(context, about, Basis.NUMERICAL, [given.word], values, subject=line.name, expected=shown)
