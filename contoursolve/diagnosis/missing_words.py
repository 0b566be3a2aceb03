"""Words that complete a contour, as its equations tell at the values that it has: how many, and which say the same."""

from collections.abc import Callable, Collection, Sequence
from itertools import combinations

from msgspec import Struct

from contoursolve.diagnosis.wording import NUMBERS, either, join
from contoursolve.geometry import Fact, Profile, assemble
from contoursolve.reading import ParsedContour, read, stating
from contoursolve.solving import IndependentFacts, affine_facts, analyse, survey

MOST_WORDS = 10
"""Words among which those that complete a contour are looked for by all their sets."""


class Lack(Struct, frozen=True):
    """The words that a contour lacks: so many (`number`), of several `kinds`.

    The words of one kind say the same, beside what is stated. Any so many kinds are enough but those that contain one
    of `tied`, which are numbers of kinds: beside the others, one of them adds nothing.
    """

    number: int
    kinds: tuple[tuple[str, ...], ...]
    tied: tuple[tuple[int, ...], ...] = ()


def lack_of(claim: ParsedContour, profile: Profile, names: Sequence[str]) -> Lack | None:
    """The words that a contour lacks, of some names that it does not state; None where these help nothing."""
    able, rank = list(names), _rank_with(claim, profile, names)
    least = rank(())
    able = [name for name in able if rank((name,)) > least]
    if not able or len(able) > MOST_WORDS:
        return Lack(1, tuple((name,) for name in able)) if able else None
    number = rank(able) - least
    kinds: list[list[str]] = []
    for name in able:
        kind = next((each for each in kinds if rank((each[0], name)) == least + 1), None)
        if kind is None:
            kinds.append([name])
        else:
            kind.append(name)
    tied: list[tuple[int, ...]] = []
    for size in range(2, number + 1):
        for chosen in combinations(range(len(kinds)), size):
            is_new = not any({*other} <= {*chosen} for other in tied)
            if is_new and rank([kinds[each][0] for each in chosen]) < least + size:
                tied.append(chosen)
    return Lack(number, tuple(map(tuple, kinds)), tuple(tied))


def _rank_with(claim: ParsedContour, profile: Profile, names: Sequence[str]) -> Callable[[Collection[str]], int]:
    """The number of unknowns that a contour determines with some of these words besides its own: for lines between
    points at the values that it has, else at most values."""
    own = frozenset(fact.given for fact in profile.ignored)
    whole = read(stating(claim, names), own)
    affine = affine_facts(whole, whole.facts)
    stated = {*profile.facts}
    if affine is not None:
        basis = IndependentFacts(affine)
        for fact in affine.facts:
            if fact in stated:
                basis.add(fact)
        further = [fact for fact in affine.facts if fact not in stated]
        return lambda added: basis.rank_with(fact for fact in further if fact.given in added)
    system = assemble(whole)

    def is_kept(fact: Fact, added: Collection[str]) -> bool:
        return fact in stated or fact.given in added

    return lambda added: survey(system.keep(tuple(fact for fact in system.facts if is_kept(fact, added)))).rank


def lack_text(lack: Lack, text: Callable[[str], str]) -> str:
    """To add what is lacking, each word as `text` has it: `add K`, `add two of A, I or K, X or U`."""
    kinds = [[text(name) for name in kind] for kind in lack.kinds]
    if lack.number == len(kinds) == 1 and len(kinds[0]) > 1:
        return f"add one of {', '.join(kinds[0])}"
    if lack.number >= len(kinds):
        return f"add {_and([either(kind) for kind in kinds])}"
    told = f"add {NUMBERS.get(lack.number, lack.number)} of {', '.join(either(kind) for kind in kinds)}"
    apart = [f"not {join([either(kinds[each]) for each in chosen])} together" for chosen in lack.tied]
    return "; ".join([told, *apart])


def _and(texts: Sequence[str]) -> str:
    """A list of which each item may be a list itself: `A and B`, `I or K, and X or U`."""
    return ", and ".join(texts) if any(" or " in each for each in texts) else join(texts)


def still_able(lack: Lack, unable: Collection[str]) -> Lack | None:
    """The lack without words that help nothing after all; None if so little is left that it tells nothing."""
    kept = [tuple(name for name in kind if name not in unable) for kind in lack.kinds]
    places = [place for place, kind in enumerate(kept) if kind]
    if len(places) < lack.number:
        return None
    tied = (tuple(map(places.index, chosen)) for chosen in lack.tied if {*chosen} <= {*places})
    return Lack(lack.number, tuple(kept[place] for place in places), tuple(tied))


def partners_of(claim: ParsedContour) -> tuple[list[str], list[str]]:
    """Words that others need to say anything, where with them nothing is open, and these others; none where it is."""
    partners, halves = dict[str, None](), dict[str, None]()
    needs, poles = dict.fromkeys(row.needs for row in claim.form.outline.facts), claim.form.free.poles
    usual = {*claim.form.free.usual}
    effective = {name for each in needs if claim.givens.keys() >= {*each} for name in each}
    for names in needs:
        stated = [name for name in names if name in claim.givens]
        missing = [name for name in names if name not in claim.givens]
        # A pole says nothing without polar words, but it is no half of one; they say nothing without it.
        is_polar = bool(stated) and all(name.rpartition(":")[0] in poles for name in missing)
        is_half = not effective.intersection(names) and usual.isdisjoint(names)
        if missing and (is_polar or is_half):
            partners |= dict.fromkeys(missing if stated else ())
            halves |= dict.fromkeys(name for name in stated if name.rpartition(":")[0] not in poles)
    if not partners or not partners.keys() <= claim.vocabulary.keys():
        return [], []
    is_enough = analyse(assemble(read(stating(claim, partners), frozenset()))).is_determined
    return ([*partners], [*halves]) if is_enough else ([], [])
