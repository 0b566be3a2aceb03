"""The table legality x determinacy: every set of a form's words, what the manual and the equations say of it."""

import re
from collections.abc import Iterator
from itertools import combinations, islice

from msgspec import Struct

from contoursolve.diagnosis.wording import unknowns_text
from contoursolve.diagnostics import Severity
from contoursolve.gcode import parse, parse_block
from contoursolve.geometry import Length, Profile, assemble
from contoursolve.reading import ContourForm, Control, ParsedContour, Sample, advance, check, read
from contoursolve.solving import analyse, is_closed, points_with_two_solutions

_OPTIONAL = re.compile(r"\{([^}]*)\}")


class Row(Struct, frozen=True):
    """One set of words: the rules that refuse it, those that warn, the words that the control ignores, what the words
    that remain leave free or say twice, and the condition under which they determine the contour.

    `other` is the form as which they are read, where that is another one, or `nothing`.
    """

    addresses: tuple[str, ...]
    refusals: tuple[str, ...]
    warnings: tuple[str, ...]
    ignored: tuple[str, ...]
    faults: tuple[str, ...]
    condition: str
    other: str = ""

    def __str__(self) -> str:
        words = " ".join(self.addresses) or "-"
        if self.other:
            return f"{words} | read as {self.other} | -"
        legality = f"refused: {', '.join(self.refusals)}" if self.refusals else "legal"
        if self.warnings:
            legality += f" (warns {', '.join(self.warnings)})"
        if self.ignored:
            legality += f" (ignores {', '.join(self.ignored)})"
        determinacy = "; ".join(self.faults) or "determined"
        if not self.faults and self.condition not in ("", "1"):
            determinacy += f" unless {self.condition} = 0"
        return f"{words} | {legality} | {determinacy}"


def tabulate(form: ContourForm, control: Control) -> Iterator[Row]:
    """One row for every set of the optional words of a form's sample, smallest sets first."""
    sample = _sample(form)
    texts = [word for block in sample.blocks for word in _OPTIONAL.findall(block)]
    for size in range(len(texts) + 1):
        for chosen in combinations(texts, size):
            yield _row(form, control, frozenset(chosen))


MOST_TRIED = 1_000
"""Sets of words of a form among which the smallest legal ones are looked for."""


def legal_samples(form: ContourForm, control: Control) -> Iterator[tuple[Row, str]]:
    """The smallest sets of words of a form's sample that are legal and make a contour: the row of each, and its
    blocks."""
    sample, found = _sample(form), list[frozenset[str]]()
    texts = [word for block in sample.blocks for word in _OPTIONAL.findall(block)]
    sets = (frozenset(chosen) for size in range(len(texts) + 1) for chosen in combinations(texts, size))
    for chosen in islice(sets, MOST_TRIED):
        if any(each <= chosen for each in found):
            continue
        row = _row(form, control, chosen)
        if not (row.refusals or row.warnings or row.ignored or row.faults or row.other):
            found.append(chosen)
            yield row, "\n".join(" ".join(line.split()) for line in _lines(sample, chosen))


def _lines(sample: Sample, chosen: frozenset[str]) -> list[str]:
    """The blocks of a sample with some of the words that may be left out."""
    return [_OPTIONAL.sub(lambda word: word[1] if word[1] in chosen else "", block) for block in sample.blocks]


def _row(form: ContourForm, control: Control, chosen: frozenset[str]) -> Row:
    sample = _sample(form)
    lines = _lines(sample, chosen)
    state = advance(
        control.initial_state(Length.MM), parse_block(sample.before, 1, control.modes.syntax), control.modes
    )
    blocks = parse("\n".join(lines), syntax=control.modes.syntax).blocks
    claim = control.find(blocks, 0, state, control.modes)
    words = [(number, word) for number, block in enumerate(blocks, 1) for word in block.words if word.address != "G"]
    addresses = tuple(f"{number}:" * (len(blocks) > 1) + word.address for number, word in words)
    if not isinstance(claim, ParsedContour) or claim.form is not form:
        other = claim.form.name if isinstance(claim, ParsedContour) else "nothing"
        return Row(addresses, (), (), (), (), "", other)
    offences = check(control.rules, form.roles, claim.stated())
    ignored = tuple(offence.ignored for offence in offences if offence.ignored)
    profile = read(claim, frozenset(ignored))
    verdict = analyse(assemble(profile))
    refusing = [offence.rule for offence in offences if not offence.rule.ignores]
    return Row(
        addresses=addresses,
        refusals=tuple(rule.code for rule in refusing if rule.severity is Severity.ERROR),
        warnings=tuple(rule.code for rule in refusing if rule.severity is not Severity.ERROR),
        ignored=ignored,
        faults=tuple(_faults(profile)),
        condition=verdict.condition,
    )


def _sample(form: ContourForm) -> Sample:
    if form.table.sample is None:
        raise ValueError(f"the form {form.name} has no sample")
    return form.table.sample


def _faults(profile: Profile) -> Iterator[str]:
    """The reason for which the facts do not determine one contour."""
    system = assemble(profile)
    verdict = analyse(system)
    if verdict.free:
        yield f"free: {unknowns_text(verdict.free, profile)}"
    # A circle may have more points than it needs; what counts is what words say.
    tied = [system.facts[index] for index in verdict.tied]
    if any(fact.given for fact in tied):
        yield f"tied: {', '.join(word.address for word in profile.words_of(tied))}"
    corners = profile.figure.corners
    names = [corner.name for corner in corners]
    yield from (f"{name} given twice" for name in dict.fromkeys(names) if names.count(name) > 1)
    last = (corner for corner in corners if corner.after is None and corner.lands_on is None)
    nowhere = {corner.name for corner in last if corner.lands_parallel_to is None}
    yield from (f"{name} lands nowhere" for name in sorted(nowhere))
    if not verdict.free and is_closed(system):
        chosen = {choice.point for choice in profile.choices}
        yield from (f"two solutions for {each}" for each in points_with_two_solutions(system) if each not in chosen)
