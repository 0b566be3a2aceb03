"""Words that may be left out or added so that the control accepts the rest, as far as no equation has to be solved for
it."""

from collections.abc import Callable, Hashable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import chain, combinations
from typing import NamedTuple

from msgspec.structs import replace

from contoursolve.diagnosis.examine import Answer, problems
from contoursolve.diagnosis.explain import spans_of
from contoursolve.diagnosis.spelling import answerable
from contoursolve.diagnostics import Span
from contoursolve.gcode import Word
from contoursolve.geometry import BlockRole
from contoursolve.reading import ContourForm, Control, ParsedContour, Rule, check, is_refused_by_values

MOST_CHECKED = 2_000
"""Sets of words of one contour that the rules are asked about."""

MOST_READ = 240
"""Sets of words without which a block is read again, because it may then be of another form; of two blocks, for which
that takes as long as for fifty of the other sets, a quarter of it."""

LARGEST_ROLE = 2
"""Blocks that a rule sees at once. A contour of more blocks is repaired near what is wrong with it."""

MOST_EDITS = 4
"""Words that a repair may touch; more is a new block."""


def block_of(name: str) -> str:
    """The beginning that the names of one block share; empty in a contour of one block."""
    return name[: name.find(":") + 1]


def blocks_at_fault(answer: Answer) -> frozenset[str]:
    """The beginnings of the names of the blocks that a finding is about and of those beside them; of all blocks, where
    a rule can see them at once."""
    claim = answer.claim
    near = lines_near(claim, blamed_spans(answer))
    is_short = len(claim.blocks) <= LARGEST_ROLE or not near
    places = claim.vocabulary.items()
    return frozenset(block_of(name) for name, (_, index) in places if is_short or claim.blocks[index].line in near)


def lines_near(claim: ParsedContour, spans: Iterable[Span]) -> set[int]:
    """The lines of a contour in which some places are, and those beside them."""
    lines, blamed = [block.line for block in claim.blocks], {span.line for span in spans}
    return {line for at, own in enumerate(lines) if own in blamed for line in lines[max(0, at - 1) : at + 2]}


def corners_at_fault(answer: Answer) -> list[str]:
    """The words of the corners that a finding is about; of all near it, if it is about none. In few blocks, of all."""
    claim, blocks, blamed = answer.claim, blocks_at_fault(answer), blamed_spans(answer)
    near = [name for name in claim.form.outline.shapes if name in claim.words and block_of(name) in blocks]
    at_fault = [name for name in near if claim.words[name].span in blamed]
    return near if len(claim.blocks) <= LARGEST_ROLE or not at_fault else at_fault


def words_of(claim: ParsedContour, name: str) -> list[Word]:
    """The word that states a given, and those that state it again."""
    word = claim.words[name]
    again = [each for each in claim.repeated if each.address == word.address and each.span.line == word.span.line]
    return [word, *(each for each in again if each.address != "G")]


def blamed_spans(answer: Answer) -> set[Span]:
    """The places that errors and warnings are about."""
    return spans_of(problems(answer))


def is_clean(form: ContourForm, rules: tuple[Rule, ...], names: frozenset[str], circumstances: frozenset[str]) -> bool:
    """Whether no rule refuses or ignores something in the combination of words, whatever their values."""
    return not check(rules, form.roles, dict.fromkeys(names | circumstances))


@lru_cache(maxsize=4096)
def smallest_changes(
    form: ContourForm,
    rules: tuple[Rule, ...],
    present: frozenset[str],
    extra: frozenset[str],
    circumstances: frozenset[str],
    blocks: frozenset[str],
) -> tuple[frozenset[str], ...]:
    """All smallest sets of names whose dropping or adding makes a combination that no rule
    refuses, and in which none ignores a word.

    Where the combination is that already, a word of the `blocks` may be dropped or exchanged for another one.
    """

    if is_clean(form, rules, present, circumstances):
        old_names, new_names = (
            sorted(name for name in names if block_of(name) in blocks) for names in (present, extra - present)
        )
        one = (frozenset({name}) for name in old_names)
        exchanged = (
            frozenset({old, new})
            for old in old_names
            for new in new_names
            if old in extra and (not _is_chain(form) or block_of(old) == block_of(new))
        )
        changes = (frozenset(), *one, *exchanged)
        return tuple(change for change in changes if is_clean(form, rules, present ^ change, circumstances))
    if not _is_chain(form):
        return _smallest(form.roles, rules, present, present | extra, circumstances)
    # What one block of a chain says is legal or not whatever blocks far from it say.
    unions: tuple[frozenset[str], ...] = (frozenset(),)
    for prefixes in _offending(form.roles, rules, present | circumstances):
        roles = tuple(role for role in form.roles if prefixes & set(role.prefixes))
        near = {prefix for role in roles for prefix in role.prefixes}
        own, around = (
            frozenset(name for name in present | extra | circumstances if block_of(name) in within)
            for within in (prefixes, near)
        )
        part = _smallest(roles, rules, present & around, own & (present | extra), circumstances & around)
        # Too many changes stay too many: there are few others, however many blocks are at fault.
        joined = dict.fromkeys(union | change for union in unions for change in part)
        unions = tuple(union for union in joined if len(union) <= MOST_EDITS)
    return tuple(union for union in unions if union)


def _is_chain(form: ContourForm) -> bool:
    """Whether it has more blocks than a rule sees at once."""
    return (
        len(form.table.combinations) > LARGEST_ROLE
        and len({prefix for role in form.roles for prefix in role.prefixes}) > 1
    )


def _offending(roles: tuple[BlockRole, ...], rules: tuple[Rule, ...], stated: frozenset[str]) -> list[set[str]]:
    """The beginnings of the names of blocks that are refused; those that are refused together in one set."""
    groups: list[set[str]] = []
    for role in roles:
        if check(rules, (role,), dict.fromkeys(stated)):
            group = set(role.prefixes)
            for other in [other for other in groups if other & group]:
                groups.remove(other)
                group |= other
            groups.append(group)
    return groups


def _smallest(
    roles: tuple[BlockRole, ...],
    rules: tuple[Rule, ...],
    present: frozenset[str],
    touched: frozenset[str],
    circumstances: frozenset[str],
) -> tuple[frozenset[str], ...]:
    """The smallest changes among the names that may be touched after which no rule about these roles holds."""

    def is_legal(names: tuple[str, ...]) -> bool:
        return not check(rules, roles, dict.fromkeys(present ^ {*names} | circumstances))

    return tuple(map(frozenset, smallest_sets(sorted(touched), MOST_EDITS, is_legal)))


class DropSets(NamedTuple):
    """Sets of names without which no rule refuses or ignores anything, smallest first, and whether they are all."""

    found: tuple[frozenset[str], ...]
    is_complete: bool


def find_drop_sets(answer: Answer, control: Control) -> DropSets:
    """The sets of words near what is wrong that may be left out, whatever the path is then.

    Of a contour of many blocks, each word alone, those that a finding is about first.
    """
    claim, rules, blamed = answer.claim, control.rules, blamed_spans(answer)
    stating = answerable(claim)
    names = [name for name, word in claim.words.items() if name in stating or word.span in blamed]
    near = blocks_at_fault(answer)
    droppable = frozenset(name for name in names if block_of(name) in near)
    if len(claim.blocks) > LARGEST_ROLE:
        alone = sorted(droppable, key=lambda name: (claim.words[name].span not in blamed, name))
        return DropSets(tuple(frozenset({name}) for name in alone), is_complete=False)
    # An arc that stands alone is told from a full circle by its values, and some forms read words by others' values.
    is_by_values = claim.limits or not claim.form.is_contour
    values = (*(block.text for block in claim.blocks), claim.before.start().values) if is_by_values else ()
    key = (control.find, rules, claim.form, frozenset(claim.words), claim.circumstances, values)
    sets = _drop_sets(_Combination(key, claim, control), droppable)
    stated, roles = claim.stated(), claim.form.roles
    plain = (
        names
        for names in sets.of_same_form
        if not is_refused_by_values(rules, roles, {name: stated[name] for name in stated if name not in names})
    )
    found = sorted((*plain, *sets.of_other_form), key=lambda names: (len(names), sorted(names)))
    return DropSets(tuple(found), sets.is_complete)


@dataclass(frozen=True, slots=True)
class _Combination:
    """A contour, equal to others with the same words, and the same values where these tell what may be left out."""

    key: Hashable
    claim: ParsedContour = field(compare=False)
    control: Control = field(compare=False)


class _Sets(NamedTuple):
    """Sets of names by whether the rules see the same form in the blocks without them; whether they are all."""

    of_same_form: tuple[frozenset[str], ...]
    of_other_form: tuple[frozenset[str], ...]
    is_complete: bool


@lru_cache(maxsize=1024)
def _drop_sets(words: _Combination, droppable: frozenset[str]) -> _Sets:
    claim, rules, form = words.claim, words.control.rules, words.claim.form
    shaping = {name for name in droppable if not _is_alike(_read_without(words, frozenset({name})), claim)}
    same, other = [], []
    most_read = MOST_READ // len(claim.blocks) ** 2
    checked = read = 0
    for names in _subsets(sorted(droppable - shaping)):
        checked += 1
        if checked > MOST_CHECKED:
            break
        if not check(rules, form.roles, dict.fromkeys((claim.words.keys() | claim.circumstances) - names)):
            same.append(names)
    # What several words of two blocks do to their form together, no single one need show.
    is_single = len(claim.blocks) == 1
    reread = shaping if is_single else droppable
    for names in _subsets(sorted(droppable)) if reread else ():
        if names & reread:
            read += 1
            if read > most_read:
                break
            found = _read_without(words, names)
            if found and not check(rules, found.form.roles, dict.fromkeys((*found.words, *found.circumstances))):
                other.append(names)
    return _Sets(tuple(same), tuple(other), is_single and checked <= MOST_CHECKED and read <= most_read)


def smallest_sets(
    names: Sequence[str], most: int, holds: Callable[[tuple[str, ...]], bool]
) -> Iterator[tuple[str, ...]]:
    """The sets of at most so many names for which something holds, smallest first; none that contains another one."""
    found: list[set[str]] = []
    for size in range(1, most + 1):
        for chosen in combinations(names, size):
            if not any(other <= {*chosen} for other in found) and holds(chosen):
                found.append({*chosen})
                yield chosen


def _subsets(names: Iterable[str]) -> Iterator[frozenset[str]]:
    """The sets of some of the names, smallest first, without the empty one."""
    names = list(names)
    return map(frozenset, chain.from_iterable(combinations(names, size) for size in range(1, len(names) + 1)))


def _is_alike(found: ParsedContour | None, claim: ParsedContour) -> bool:
    """Whether the rules see the same form in the same circumstances."""
    return found is not None and found.form is claim.form and found.circumstances == claim.circumstances


def _read_without(words: _Combination, names: frozenset[str]) -> ParsedContour | None:
    """The same blocks without some words; None if they are not one contour any more."""
    claim, control = words.claim, words.control
    dropped = {word.span for name in names for word in words_of(claim, name)}
    blocks = [
        replace(block, words=tuple(word for word in block.words if word.span not in dropped)) for block in claim.blocks
    ]
    found = control.find(blocks, 0, claim.before, control.modes)
    return found if isinstance(found, ParsedContour) and len(found.blocks) == len(blocks) else None
