"""Which words the sheets of the controls refuse, read here once more, without the tables of rules."""

from collections.abc import Callable, Iterator, Mapping
from decimal import Decimal

from contoursolve.reading import Claim
from contoursolve.syntax import FaultKind
from contoursolve.tolerance import LARGEST
from contoursolve.verification.nct_words import Element, choosing_pairs, elements_of

TURNED = 360
"""Degrees. The largest angle of G111 (p. 140)."""


def unreadable(claim: Claim) -> list[str]:
    """The characters and words of a contour's blocks that have no meaning, whatever the control's rules are."""
    faults = [fault.text for block in claim.blocks for fault in block.faults if fault.kind not in HARMLESS]
    words = [word for block in claim.blocks for word in block.words if word.address in claim.lexicon.addresses]
    values = ((word, claim.lexicon.value(word, claim.after.unit)) for word in words)
    large = [word.text for word, value in values if value is not None and abs(value) > LARGEST]
    return [*faults, *large, *(word.text for word in (*claim.repeated, *claim.unknown))]


def unaskable(claim: Claim, reads: frozenset[str]) -> list[str]:
    """What a contour of words alone asks for and cannot be told, under any rules; `reads` are the givens of its form.

    A size is one of a corner between two elements: a last corner of G111 lands along the axis of which the block, or
    else what it asks for, has the only coordinate; a bevel at 45 degrees beside an arc has no equations.
    """
    form = claim.form.name
    asked = {name for name, word in claim.words.items() if word.is_asked}
    if form in ("G11", "G12", "G01"):
        reads -= {"I"} if claim.words.keys() & {"X", "U"} else {"K"}
    known = [claim.words[name] for name in asked & reads]
    words = [word for block in claim.blocks for word in block.words]
    found = [f"{word.text} asks for nothing of the contour" for word in words if word.is_asked and word not in known]
    if form == "G111" and asked & {"D", "Q"}:
        told = [[ends for ends in ("XU", "ZW") if names & {*ends}] for names in (claim.givens.keys(), asked)]
        if len(told[0] or told[1]) != 1:
            found.append("nothing tells which line corner 2 lands on, so that its size cannot be asked for")
    if form == "G112" and asked & {"C", "D"}:
        is_setback = any((each.setting.name, each.value) == ("bevel", "setback") for each in claim.conventions)
        found += [] if is_setback else ["the size of a bevel beside an arc cannot be asked for"]
    return found


def too_large(claim: Claim) -> list[str]:
    """The words whose values are beyond all travel, and beyond what decimals of 28 digits can reduce to one turn."""
    return [given.word.text for given in claim.givens.values() if given.word and abs(given.value) > LARGEST]


HARMLESS = (FaultKind.COMMENT_NOT_CLOSED,)


def refused(claim: Claim) -> list[str]:
    """What the sheet of the control says against the words of a contour; nothing where not all could be read."""
    if any(block.faults for block in claim.blocks):
        return []
    return list(_SHEETS[claim.form.name](claim)) if claim.form.name in _SHEETS else []


def _g111(claim: Claim) -> Iterator[str]:
    """YASNAC LX3 2.8.30: Tables 2.33 and 2.34, notes i and iii, p. 140."""
    stated, given = set(claim.words), claim.givens
    first, to_x, to_z = stated & {"A", "I", "K"}, stated & {"X", "U"}, stated & {"Z", "W"}
    ways = ("B" in stated) + bool(to_x) + bool(to_z)
    if len(first) < (1 if ways == 3 else 2):  # noqa: PLR2004 - note i: all of B, X(U), Z(W) leave one word to line 1
        yield "line 1 lacks a word"
    if ways < 2:  # noqa: PLR2004 - Table 2.34
        yield "line 2 lacks a word"
    for both in ({"X", "U"}, {"Z", "W"}, {"C", "P"}, {"D", "Q"}):
        if both <= stated:
            yield f"{' and '.join(sorted(both))} exclude each other"
    if to_x and to_z and stated & {"D", "Q"}:
        yield "corner 2 is not available where X(U) and Z(W) give line 2"
    for name in ("A", "B"):
        if name in given and abs(given[name].value) > TURNED:
            yield f"{name} is larger than a turn"
    for name in ("C", "P", "D", "Q"):
        if name in given and given[name].value < 0:
            yield f"{name} is negative"
    yield from (f"{name} cannot stand in the block" for name in ("M", "S", "T", "other G") if name in stated)


def _g112(claim: Claim) -> Iterator[str]:
    """YASNAC LX3 2.8.30, p. 144: the words of G112, the signs of its corners and of R."""
    stated, given = set(claim.words), claim.givens
    ends = stated & {"X", "U", "Z", "W"}
    if not ends or not stated >= {"I", "K", "R"}:
        yield "a word is missing"
    if len(ends) > 1:
        yield "two words give the line on which corner 2 lands"
    yield from (f"{' and '.join(pair)} exclude each other" for pair in ("CP", "DQ") if stated >= {*pair})
    yield from (f"{name} is negative" for name in "CPDQ" if name in given and given[name].value < 0)
    if "R" in given and given["R"].value <= 0:
        yield "R is not positive"
    yield from (f"{name} cannot stand in the block" for name in ("M", "S", "T", "other G") if name in stated)


def _leaving(claim: Claim) -> Iterator[str]:
    """YASNAC LX3 p. 31-32: one axis a block, with the letter of the other one."""
    stated, given = set(claim.words), claim.givens
    by_x, by_z, letters = stated & {"X", "U"}, stated & {"Z", "W"}, stated & {"I", "K"}
    if by_x and by_z:
        yield "both axes in one block"
    elif not (by_x or by_z):
        yield "no axis"
    else:
        if letters != {"K" if by_x else "I"}:
            yield "no corner, or one along the axis of the move"
        if max(len(by_x), len(by_z)) > 1:
            yield "one axis twice"
    yield from (f"{name} is 0" for name in sorted(letters) if name in given and not given[name].value)
    if "other G" in stated:
        yield "another G code that uses the axis words"


def _nct(claim: Claim) -> Iterator[str]:
    """NCT 99M chapter 16, block by block, then pair by pair."""
    for each in elements_of(claim):
        prefix = f"{each.number}:"
        names = {name.removeprefix(prefix) for name in claim.words if name.startswith(prefix)}
        around = {name.removeprefix(prefix) for name in claim.circumstances if name.startswith(prefix)}
        given = {
            name.removeprefix(prefix): each.value for name, each in claim.givens.items() if name.startswith(prefix)
        }
        for text in (*_of_place(each, names, around), *_of_shape(each, names, given)):
            yield f"block {each.number}: {text}"
    for _, each in choosing_pairs(claim):
        q = each.given("Q")
        if q not in claim.words:
            yield f"block {each.number}: Q is missing"
        elif q in claim.givens and not claim.givens[q].value:
            yield f"block {each.number}: Q is 0"


_CENTERS = {"center-first", "center-second"}
_POINT = {"first", "first-step", "second", "second-step"}
_BENDS = {",C", ",R"}


def _of_place(each: Element, names: set[str], around: set[str]) -> Iterator[str]:
    """What cannot stand where the block is."""
    if each.is_over and names & {",A", "R"} and "@uncompensated" in around:
        yield "without G41 or G42"
    if names & {",A", "R"} and "@alone" in around:
        yield "over-defined without an element before it"
    if each.is_over and each.turn is None and ",A" in names and "@rapid" in around:
        yield "with G0"
    if not each.is_over and "Q" in names and "@alone" not in around:
        yield "Q without an intersection"
    if each.turn is None and not each.is_over and each.is_followed:
        if ",A" in names and names & _POINT:
            yield "its direction is given twice"
        if not names & {",A", *_POINT}:
            yield "its direction is not given"
    whole = {"first", "second", ",A"} if each.turn is None else {"first", "second", *_CENTERS, "R"}
    if each.is_over and "Q" in names and not whole <= names:
        yield "Q, and a word that over-defines it is missing"
    if names & _BENDS and "@last" in around:
        yield "a corner and nothing after it"
    beside = sum(name.startswith("beside-") for name in names)
    if beside and "@ordinary" not in around and not ("@only" in around and ",A" in names and beside == 1):
        yield "an axis outside the plane"
    if "@other-plane" in around:
        yield "in another plane"


def _of_shape(each: Element, names: set[str], given: Mapping[str, Decimal]) -> Iterator[str]:
    """What makes no line, no circle or no corner."""
    if each.turn is None:
        if names & {*_CENTERS, "wrong-center", "R"}:
            yield "a line with a centre or a radius"
        if not (each.is_over or each.is_followed) and ",A" in names and not names & _POINT:
            yield "its angle alone does not say where the line ends"
    else:
        if not each.is_over and not names & {*_CENTERS, "R"}:
            yield "the circle has neither a centre nor a radius"
        is_whole = names >= _CENTERS and len({name.removesuffix("-step") for name in names & _POINT}) == len(_CENTERS)
        if not each.is_over and names & _CENTERS and "R" in names and not is_whole:
            yield "the circle has a centre and a radius"
        if not each.is_over and "R" in names and not names & _POINT:
            yield "R has no point"
        if "R" in given and not given["R"]:
            yield "R is 0"
        if "wrong-center" in names:
            yield "a centre outside the plane"
        if ",A" in names:
            yield "an arc with an angle"
    if names >= _BENDS:
        yield "a chamfer and a rounding"
    yield from (f"{name} is negative" for name in sorted(_BENDS) if name in given and given[name] < 0)


_SHEETS: Mapping[str, Callable[[Claim], Iterator[str]]] = {
    "G111": _g111,
    "G112": _g112,
    **dict.fromkeys(("G11", "G12", "G01"), _leaving),
    **dict.fromkeys(("line-angle", "corners", "line-line", "line-circle", "circle-line", "circle-circle"), _nct),
    "chain": _nct,
}
