"""The smallest sets of words of a contour that say the same: each is read and compared alone.

What ties the facts of all words together tells where to look. Where these are not affine, or where a fact is counted
along the direction that another word states, a set is so only if its words alone say that: a length along a wrong
direction is not the length from point to point.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence, Set
from itertools import chain, combinations

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis.explain import AGAINST
from contoursolve.geometry import Arc, Fact, Layout, Profile, assemble, put_on
from contoursolve.solving import (
    Note,
    Refusal,
    RefusalKind,
    Ties,
    Topic,
    affine_facts,
    circuits_of,
    find_ties,
    first_drawing,
    headings_of,
    is_found_at_once,
    nearest_of_determined,
    refusals_about,
    said_twice,
)


class TiedSet(Struct, frozen=True):
    """A smallest set of words and facts that say the same, by their givens, and what these alone tell.

    `facts` state them, in a `profile` of these words and of what goes without saying. `off` (mm) is by how much they
    disagree, `is_conflict` whether that is more than the least increment. `event` is the comparison of the last of
    them with the others, where it was made apart; None too where two points of one circle agree.
    """

    givens: tuple[str, ...]
    facts: tuple[Fact, ...]
    profile: Profile
    off: float
    is_conflict: bool
    event: Refusal | Note | None = None


class SmallestSets(Struct, frozen=True):
    """Such sets, smallest first, and whether they are all there are.

    A set of which some words alone have no contour, because a point is out of reach, is no smallest one. `beside` are
    such sets, which tell by how much a word disagrees with the others; the words alone are `found`.
    """

    found: tuple[TiedSet, ...]
    is_complete: bool
    beside: tuple[TiedSet, ...] = ()


_AGAINST = AGAINST | refusals_about(Topic.PLACE) | {RefusalKind.NO_POINT}


NO_SETS = SmallestSets((), is_complete=False)


def is_exact(ties: Ties) -> bool:
    """Whether sets of facts that say the same are sets of words that do, with the amounts by which they disagree."""
    if ties.rows is None or not ties.is_affine:
        return not ties.circuits.found
    system = assemble(ties.profile)
    return not any(_lent(each.facts, ties.profile) for each in ties.circuits.found if system.headed)


Part = Callable[[frozenset[str]], Profile]
"""The profile of a contour without what some words state. It raises ValueError where there is none."""


def smallest_sets(part: Part, ties: Ties, whole: Profile) -> SmallestSets:
    """The smallest sets of words of a contour that say the same at its values.

    Args:
        part: the contour without some of its words; its start is known.
        ties: what ties its facts.
        whole: the profile that they are the facts of.
    """
    if is_exact(ties):
        told = (
            TiedSet(ties.givens(each), each.facts, whole, ties.off_by(each), ties.is_conflict(each))
            for each in ties.circuits.found
        )
        return SmallestSets(tuple(told), ties.circuits.is_complete)
    return _read_alone(part, ties, whole)


def _read_alone(part: Part, ties: Ties, whole: Profile) -> SmallestSets:
    words = _Words(part, whole)
    told = [ties, *words.without_lent(ties)]
    candidates = dict.fromkeys(
        # Of what says a part of a word alone, the word.
        frozenset((*each.givens(circuit), *(fact.statement for fact in circuit.facts if fact.statement)))
        for each in told
        for circuit in each.circuits.found
    )
    tied, refused = dict[frozenset[str], None](), dict[frozenset[str], None]()
    for group in words.joined(candidates):
        # What says the same at these values, and not at all others, is a set if it has no contour.
        found_here = [*words.tied_within(group)]
        tied |= dict.fromkeys(found_here)
        refused |= dict.fromkeys(() if found_here else words.refused_at_values(group))
    refused |= dict.fromkeys(chain.from_iterable(map(words.refused_within, tied)))
    smallest = [names for names in tied if not any(each < names for each in refused)]
    smallest += [names for names in refused if names not in tied and not any(each < names for each in refused)]
    found = words.compared(smallest)
    beside = words.compared([names for names in tied if names not in smallest])
    return SmallestSets(found, not words.is_cut, beside)


def stating_givens(profile: Profile) -> tuple[str, ...]:
    """The givens that facts state, in the order of these, which is that of the form: that of the words is the
    programmer's."""
    return tuple(dict.fromkeys(fact.given for fact in (*profile.facts, *profile.ignored) if fact.given))


def _lent(facts: Iterable[Fact], profile: Profile) -> set[str]:
    """The stated directions along which some facts are counted that do not state them."""
    system, facts = assemble(profile), tuple(facts)
    return {name for fact in facts for name in headings_of(fact, system)} - {fact.given for fact in facts}


MOST_READ = 400
"""Sets of words that are read alone; where more would have to be, the list of the smallest is not complete."""

MOST_JOINED = 7
"""Words of which all parts are looked through; of more that are tied with one another, not all sets are listed."""

MOST_SEARCHED = 6
"""Sets of which the comparison takes a search; of more, those that take one are not listed."""

MOST_LENT = 3
"""Words that others are read by, as many as are left out together; of more, those that share no set, and all."""


class _Words:
    """Parts of the words of a contour, each read alone once."""

    def __init__(self, part: Part, whole: Profile) -> None:
        self._part, self._whole, self.is_cut, self._searched = part, whole, False, 0
        self._stating = frozenset(stating_givens(whole))
        self._touching = {fact.statement for fact in whole.facts if fact.foot and fact.statement}
        self._read: dict[frozenset[str], Profile | None] = {}
        self._said: dict[frozenset[str], tuple[Refusal | Note, ...]] = {}
        self._tied: dict[frozenset[str], bool] = {}

    def without_lent(self, ties: Ties) -> Iterator[Ties]:
        """The ties of the facts where words are left out by which other words are read as well."""
        circuits = [{*ties.givens(each)} & self._stating for each in ties.circuits.found]
        lent = [name for name in sorted(set[str]().union(*circuits)) if self._is_lent(name)]
        if len(lent) > MOST_LENT:
            self.is_cut = True
            parts = [*_apart(lent, circuits), tuple(lent)]
        else:
            parts = [part for size in range(1, len(lent) + 1) for part in combinations(lent, size)]
        for part in parts:
            profile = self._alone(self._stating.difference(part))
            if profile is not None:
                yield find_ties(profile, is_told=True)

    def _is_lent(self, name: str) -> bool:
        """Whether other facts change without a word: a direction along which a length is counted, a line that touches
        an arc where this begins."""
        profile = self._alone(self._stating - {name})
        if profile is None:
            return False
        others = {fact for fact in (*self._whole.facts, *self._whole.ignored) if fact.given != name}
        return {*profile.facts} != others or profile.figure.path != self._whole.figure.path

    def joined(self, candidates: Iterable[frozenset[str]]) -> list[frozenset[str]]:
        """The sets joined that share words, as long as they are small enough to be looked through."""
        groups = list[frozenset[str]]()
        for names in candidates:
            near = [each for each in groups if each & names]
            group = names.union(*near)
            if len(group & self._stating) <= MOST_JOINED:
                groups = [each for each in groups if each not in near]
            else:
                self.is_cut, group = True, names
            groups.append(group)
        return groups

    def tied_within(self, names: frozenset[str]) -> Iterator[frozenset[str]]:
        """The smallest sets within one that say the same."""
        return _smallest(names & self._stating, self._is_tied)

    def refused_within(self, names: frozenset[str]) -> Iterator[frozenset[str]]:
        """The smallest sets that are a part of one and that no contour has: a point is out of reach."""
        for each in _smaller(names):
            yield from _smallest(each, self._is_refused)

    def refused_at_values(self, names: frozenset[str]) -> list[frozenset[str]]:
        """The smallest sets within one that no contour has."""
        found = [*_smallest(names & self._stating, self._is_refused)]
        self.is_cut |= not found
        return found

    def compared(self, sets: Iterable[frozenset[str]]) -> tuple[TiedSet, ...]:
        """Sets, smallest first, with what their words alone tell; without those that take one search too many."""
        place = {name: number for number, name in enumerate(stating_givens(self._whole))}
        ordered = (sorted(names, key=place.__getitem__) for names in sets)
        by_size = sorted(ordered, key=lambda order: (len(order), [place[name] for name in order]))
        return tuple(filter(None, map(self._compared, by_size)))

    def _compared(self, order: list[str]) -> TiedSet | None:
        names = frozenset(order)
        profile = self._alone(names)
        if profile is None or not self._may_compare(names, profile):
            self.is_cut = True
            return None
        against = self._against(names)
        events = sorted(self._events(names), key=lambda each: each.kind not in against)
        is_open = any(isinstance(each, Refusal) and each.kind not in against for each in events)
        if is_open or (not events and nearest_of_determined(profile) is None):
            self.is_cut = True  # nothing was found that would tell
            return None
        off = max((each.values.get("off_by_mm", 0.0) for each in events), default=0.0)
        said = (each for each in self._circuits(names) if names == {fact.statement for fact in each if fact.statement})
        facts = next(said, tuple(fact for fact in profile.facts if fact.given in names))
        event = events[0] if events else None
        return TiedSet(tuple(order), facts, profile, off, event is not None and event.kind in against, event)

    def _may_compare(self, names: frozenset[str], profile: Profile) -> bool:
        if names in self._said or is_found_at_once(profile):
            return True
        self._searched += 1
        return self._searched <= MOST_SEARCHED

    def _is_tied(self, names: frozenset[str]) -> bool:
        if names not in self._tied:
            if len(self._tied) >= MOST_READ:
                self.is_cut = True
                return False
            # What goes without saying may say itself twice.
            self._tied[names] = any(fact.given in names for facts in self._circuits(names) for fact in facts)
        return self._tied[names]

    def _is_refused(self, names: frozenset[str]) -> bool:
        """Whether no contour has these words; what takes a search is left open."""
        profile = self._alone(names)
        if profile is None or not (names in self._said or is_found_at_once(profile)):
            self.is_cut = True
            return False
        return any(each.kind in self._against(names) for each in self._events(names))

    def _against(self, names: frozenset[str]) -> frozenset[RefusalKind]:
        """The refusals that speak against some words. Where elements touched that only meet without a word that is left
        out, rounding decides whether they do."""
        return AGAINST if self._touching - names else _AGAINST

    def _circuits(self, names: frozenset[str]) -> Iterable[tuple[Fact, ...]]:
        """Facts of some words that say the same."""
        profile = self._alone(names)
        if profile is None:
            return ()
        affine = affine_facts(profile, profile.facts)
        if affine is not None:
            return (each.facts for each in affine.circuits().found)
        return ((*others, last) for last, others in circuits_of(assemble(profile)).items())

    def _events(self, names: frozenset[str]) -> tuple[Refusal | Note, ...]:
        if names not in self._said:
            profile = self._alone(names)
            said = said_twice(profile) if profile is not None else ()
            # Two lines that meet in general may be one at these values: a drawing shows that nothing contradicts.
            if (
                profile is not None
                and any(each.kind is RefusalKind.NO_POINT for each in said)
                and first_drawing(profile)
            ):
                said = tuple(each for each in said if each.kind is not RefusalKind.NO_POINT)
            self._said[names] = said
        return self._said[names]

    def _alone(self, names: frozenset[str]) -> Profile | None:
        """The profile of some of the words that state something, with all others; None where it cannot be read."""
        if names not in self._read:
            self._read[names] = self._profile(self._stating - names)
        return self._read[names]

    def _profile(self, without: frozenset[str]) -> Profile | None:
        try:
            return _closed(self._part(without), self._whole)
        except ValueError:
            return None


def _closed(profile: Profile, whole: Profile) -> Profile:
    """A part of a profile; the ends of an arc on its circle where the whole says so by what the part lacks: that a line
    touches it there, or the direction in which it begins or ends."""
    ends = ((arc, end) for arc in profile.figure.path if isinstance(arc, Arc) for end in (arc.tail, arc.head))
    lost = [each for each in ends if _is_met(whole, *each) and not _is_met(profile, *each)]
    if not lost:
        return profile
    figure, arcs = profile.figure, dict.fromkeys(arc for arc, _ in lost)
    figure = replace(
        figure,
        points=tuple(dict.fromkeys((*figure.points, *(arc.center for arc in arcs if arc.center != figure.start)))),
        radii=tuple(dict.fromkeys((*figure.radii, *(arc.radius for arc in arcs)))),
    )
    more = (put_on(arc, end) for arc, end in lost)
    return replace(profile, layout=Layout(figure, (*profile.facts, *more)))


def _is_met(profile: Profile, arc: Arc, end: str) -> bool:
    ends = (
        fact.foot[1:] if fact.foot else fact.radial and (fact.radial.center, fact.radial.point)
        for fact in profile.facts
    )
    return (arc.center, end) in ends


def _apart(names: Iterable[str], sets: Sequence[Set[str]]) -> list[tuple[str, ...]]:
    """Names in groups, of which no set has two."""
    groups = list[list[str]]()
    for name in names:
        near = set[str]().union(*(each for each in sets if name in each))
        group = next((each for each in groups if near.isdisjoint(each)), None)
        if group is None:
            groups.append(group := [])
        group.append(name)
    return [tuple(group) for group in groups]


def _smaller(names: frozenset[str]) -> list[frozenset[str]]:
    return [names - {name} for name in sorted(names)]


def _smallest(names: frozenset[str], is_so: Callable[[frozenset[str]], bool]) -> Iterator[frozenset[str]]:
    """The smallest of a set and its parts of which something is so that is so of all that contain them."""
    seen, left = set[frozenset[str]](), [names]
    while left:
        some = left.pop()
        if some not in seen and is_so(some):
            smaller = [each for each in _smaller(some) if is_so(each)]
            left += smaller
            if not smaller:
                yield some
        seen.add(some)
