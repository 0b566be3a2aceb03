"""Puts findings into words: a row of the catalogue, the words of the block, and the values compared."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Any

from contoursolve.analysis import Verdict
from contoursolve.diagnostic import Basis, Diagnostic, Label
from contoursolve.model import Length, Profile, Unit
from contoursolve.reading import Claim, Trouble
from contoursolve.rules import Offence, Rule
from contoursolve.solving import Refusal, RefusalKind, Remark, RemarkKind, Solution, compare, lookup, scalars_of
from contoursolve.source import Span
from contoursolve.syntax import Word
from contoursolve.tolerance import AGREEMENT

_BEGINNING = Span(1, 1, 2)

SHOWN = 60
"""Characters of a word or a list of words in a message; the listing shows the rest."""


@dataclass(frozen=True, slots=True)
class Words:
    """Words in a message, as (name, text). A format keeps only some names: `{words:A B}`."""

    by_name: tuple[tuple[str, str], ...]

    def __format__(self, spec: str) -> str:
        wanted = (spec,) if spec in dict(self.by_name) else spec.split()
        texts = [text for name, text in self.by_name if not spec or name in wanted]
        return shorten(join(texts)) or "the block"


@dataclass(frozen=True, slots=True)
class Present:
    """The stated words among a list of names: `{present:A I K}`."""

    by_name: Mapping[str, str]

    def __format__(self, spec: str) -> str:
        return join([self.by_name[name] for name in spec.split() if name in self.by_name]) or "none of them"


@dataclass(frozen=True, slots=True)
class Absent:
    """The names of a list that are not stated; `X|U` is one of which either will do: `{absent:B X|U}`."""

    by_name: Mapping[str, str]

    def __format__(self, spec: str) -> str:
        slots = [slot.split("|") for slot in spec.split()]
        return " or ".join(" or ".join(slot) for slot in slots if not set(slot) & self.by_name.keys())


@dataclass(frozen=True, slots=True)
class Context:
    """What a message may mention: the stated words by name, the unit to show lengths in."""

    rules: Sequence[Rule]
    unit: Length
    words: Mapping[str, Word] = field(default_factory=dict)
    place: Span = _BEGINNING
    """Where to point if no word is to blame."""

    def row(self, about: Enum) -> Rule:
        """The row about an event."""
        return next(rule for rule in self.rules if rule.about is about)

    def typed(self) -> dict[str, str]:
        """The stated words as typed, by name."""
        return {name: word.text for name, word in self.words.items()}


def context_of(claim: Claim, rules: Sequence[Rule]) -> Context:
    """The context of a contour; it begins where its first block does."""
    return Context(rules, claim.after.unit, claim.words, claim.blocks[0].span)


def length_text(value: float, unit: Length) -> str:
    """A length in the program's unit."""
    if unit is Length.INCH:
        return _number(value / 25.4, 4) + " in"
    return _number(value, 3) + " mm"


def angle_text(value: float) -> str:
    """An angle in degrees."""
    return _number(value, 3) + " deg"


def report(
    context: Context,
    rule: Rule,
    basis: Basis,
    words: Iterable[Word],
    values: Mapping[str, float] | None = None,
    labels: Iterable[str] = (),
    **fields: Any,
) -> Diagnostic:
    """One finding: the row's message with its fields filled in, its words marked."""
    blamed = sorted(words, key=lambda word: word.span)
    spans = [word.span for word in blamed] or [context.place]
    typed = context.typed()
    stated = {
        "words": Words(tuple(_named(blamed, context.words))),
        "present": Present(typed),
        "absent": Absent(typed),
        "address": blamed[0].address if blamed else "",
        **fields,
    }
    texts = list(labels) + [""] * len(spans)
    return Diagnostic(
        code=rule.code,
        severity=rule.severity,
        basis=basis,
        span=spans[0],
        message=rule.message.format_map(stated),
        help=rule.help.format_map(stated),
        source=rule.source,
        alarm=rule.alarm,
        labels=tuple(Label(span, note) for span, note in zip(spans, texts, strict=False)),
        addresses=tuple(dict.fromkeys(word.address for word in blamed)),
        values=values or {},
        about=rule.about,
    )


def _named(words: Sequence[Word], names: Mapping[str, Word]) -> Iterable[tuple[str, str]]:
    """Words as (name, text): the name of the given, else the address."""
    known = {id(word): name for name, word in names.items()}
    return ((known.get(id(word), word.address), word.text) for word in words)


def explain_offence(context: Context, offence: Offence, comparison: str = "") -> Diagnostic:
    """A rule on combinations that holds."""
    words = [context.words[name] for name in offence.names if name in context.words]
    block = [word.span for name, word in context.words.items() if name.startswith(offence.role.prefixes[-1])]
    if not words and block and min(block).line != context.place.line:
        # What is missing is missing in the last block that the rule is about.
        context = replace(context, place=min(block))
    return report(context, offence.rule, Basis.RULE, words, comparison=comparison)


def explain_ignored(context: Context, offence: Offence, profile: Profile, solution: Solution) -> Diagnostic:
    """A word that the control ignores: what it would have had to say, and how far off it is."""
    fact = next(fact for fact in profile.ignored if fact.given == offence.rule.ignores)
    word = context.words[fact.given]
    if not solution.points:
        return report(context, offence.rule, Basis.RULE, [word], comparison="")
    values = compare(fact, profile, lookup(profile, scalars_of(solution.points)))
    expected = values.get("expected")
    comparison = "; they leave it no value to have"
    label = ""
    if expected is not None:
        gap = abs(values["actual"] - expected)
        agrees = "; it agrees with them" if gap <= AGREEMENT else ""
        comparison = agrees or (
            f"; they make it {angle_text(expected)}, it is off by {angle_text(gap)} "
            f"({length_text(values['off_by_mm'], context.unit)})"
        )
        label = f"ignored; the line runs at {angle_text(expected)}"
    return report(context, offence.rule, Basis.NUMERICAL, [word], values, [label], comparison=comparison)


def explain_missing(context: Context, profile: Profile, verdict: Verdict, claim: Claim) -> Diagnostic:
    """Unknowns that no word determines, and the words that speak about them."""
    free = set(verdict.free)
    stated = {fact.given for fact in profile.facts}
    able = [
        row.fact.given
        for row in claim.form.facts
        if row.fact.given and row.fact.given not in stated and free & set(row.fact.reads())
    ]
    addresses = dict.fromkeys(name for name in able if name in claim.form.allowed)
    completions = "add a word for it, or state a fact about it with --fact; 'contoursolve facts' lists them"
    if addresses and not profile.is_extended:
        completions = f"words that say something about it: {', '.join(addresses)}"
    return report(
        context,
        context.row(Trouble.UNDERDETERMINED),
        Basis.SYMBOLIC,
        [],
        free=unknowns_text(verdict.free, profile),
        completions=completions,
    )


_IN_DEGREES = {RefusalKind.LINE_REVERSED}
_OF_A_WORD = {RefusalKind.WORDS_DISAGREE, RemarkKind.WORDS_AGREE}


def explain_result(context: Context, event: Refusal | Remark, profile: Profile) -> Diagnostic:
    """A refusal or a remark of the solver."""
    givens = [profile.givens[name] for name in event.givens if name in profile.givens]
    asked = [question.word for question in profile.questions if question.name in event.givens]
    words = [given.word for given in givens if given.word] + asked
    values = dict(event.values)
    fields: dict[str, Any] = {"subject": event.subject, "free": unknowns_text(event.subject.split(","), profile)}
    is_word = event.kind in _OF_A_WORD
    for name in ("limit", "expected", "actual"):
        if name in values:
            if is_word and givens[0].is_diameter:
                values[name] *= 2
            in_degrees = event.kind in _IN_DEGREES or (is_word and givens[0].unit is Unit.DEGREE)
            text = angle_text(values[name]) if in_degrees else length_text(values[name], context.unit)
            fields[name] = text
    if "off_by_mm" in values:
        fields["off"] = length_text(values["off_by_mm"], context.unit)
    if event.kind is RemarkKind.SEVERAL:
        fields["count"] = f"{event.values['actual']:.0f}"
    labels = _labels(event, fields)
    return report(context, context.row(event.kind), Basis.NUMERICAL, words, values, labels, **fields)


def without_point(context: Context, claim: Claim) -> Iterator[Diagnostic]:
    """Words that are read in least increments because they have no decimal point, where others have one."""
    words = [given.word for given in claim.givens.values() if given.word and given.word.number]
    for given in claim.givens.values() if any(word.has_point for word in words) else ():
        word = given.word
        if word is None or not word.number or word.has_point or given.unit is Unit.SIGN:
            continue
        typed = given.value * 2 if given.is_diameter else given.value
        if abs(typed) < abs(word.number):
            is_length = given.unit is Unit.MM
            text = length_text(float(typed), context.unit) if is_length else angle_text(float(typed))
            yield report(context, context.row(Trouble.POINT_MISSING), Basis.RULE, [word], actual=text)


def _labels(event: Refusal | Remark, fields: Mapping[str, Any]) -> list[str]:
    """What to write under the first word."""
    if "limit" in fields and event.kind is RefusalKind.CORNER_TOO_LARGE:
        return [f"at most {fields['limit']}"]
    if "expected" in fields:
        return [f"expected {fields['expected']}"]
    return []


_PARTS = {"cos": "direction", "sin": "direction", "off": "place", "radius": "radius"}


def unknowns_text(names: Sequence[str], profile: Profile) -> str:
    """Unknown scalars in the user's words: `V1 (Z and X)`, `line 2 (direction)`."""
    things: dict[str, dict[str, None]] = {}
    for name in names:
        thing, _, part = name.rpartition(".")
        shown = profile.plane.axes[int(part)] if part.isdigit() else _PARTS.get(part, "")
        things.setdefault(thing if shown else name, {}).update({shown: None} if shown else {})
    return join([f"{thing} ({join(list(parts))})" if parts else thing for thing, parts in things.items()])


def join(texts: Sequence[str]) -> str:
    """Texts as a list in a sentence: `A, B and C`."""
    return " and ".join(filter(None, (", ".join(texts[:-1]), *texts[-1:])))


def shorten(text: str) -> str:
    """A text for a message, cut where it is very long."""
    return text if len(text) <= SHOWN else text[: SHOWN - 4] + " ..."


def _number(value: float, decimals: int) -> str:
    smallest = 0.5 * 10.0**-decimals
    value += 0.0  # -0.0 is 0
    return f"{value:.{decimals}f}" if abs(value) >= smallest or value == 0 else f"{value:.1e}"
