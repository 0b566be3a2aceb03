"""Which words the sheets of the controls refuse, read here once more, without the tables of rules."""

from collections.abc import Callable, Iterator, Mapping

from contoursolve.reading import Claim
from contoursolve.syntax import FaultKind
from contoursolve.tolerance import LARGEST

TURNED = 360
"""Degrees. The largest angle of G111 (p. 140)."""


def unreadable(claim: Claim) -> list[str]:
    """The characters and words of a contour's blocks that have no meaning, whatever the control's rules are."""
    faults = [fault.text for block in claim.blocks for fault in block.faults if fault.kind not in HARMLESS]
    words = [word for block in claim.blocks for word in block.words if word.address in claim.lexicon.addresses]
    values = ((word, claim.lexicon.value(word, claim.after.unit)) for word in words)
    large = [word.text for word, value in values if value is not None and abs(value) > LARGEST]
    return [*faults, *large, *(word.text for word in (*claim.repeated, *claim.unknown))]


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


def _circle_line(claim: Claim) -> Iterator[str]:
    """NCT 99M 16.3.3."""
    stated, around, given = set(claim.words), claim.circumstances, claim.givens
    centers, point = {"1:center-first", "1:center-second"} & stated, {name for name in stated if _is_point(name)}
    if "2:,A" in stated:
        yield from (text for name, text in _WITH_ANGLE.items() if (name in around) is _FORBIDS[name])
    is_pair = "@alone" not in around
    if is_pair and "2:,A" in stated and "2:Q" not in stated:
        yield "Q is missing"
    if "2:Q" in given and not given["2:Q"].value:
        yield "Q is 0"
    if is_pair and not centers and "1:R" not in stated:
        yield "the circle has neither a centre nor a radius"
    if "1:R" in stated and centers:
        yield "the circle has a centre and a radius"
    if "1:R" in stated and not point:
        yield "R has no point"
    if "1:R" in given and not given["1:R"].value:
        yield "R is 0"
    yield from (f"{name} has no meaning there" for name in _NEVER if name in stated)
    yield from (f"the pair is {name.removeprefix('@')}" for name in ("@chained", "@other-plane") if name in around)


def _is_point(name: str) -> bool:
    return name.removesuffix("-step") in ("1:first", "1:second")


_WITH_ANGLE = {
    "@compensated": "without G41 or G42",
    "@alone": "without an arc before it",
    "@rapid": "with G0",
}
_FORBIDS = {"@compensated": False, "@alone": True, "@rapid": True}
"""Whether a circumstance, or its absence, refuses a line with ,A."""

_NEVER = (
    *("1:wrong-center", "2:wrong-center", "2:center-first", "2:center-second", "2:R", "1:Q", "1:,A"),
    *("1:off-plane", "2:off-plane", "1:,C", "1:,R", "2:,C", "2:,R"),
)

_SHEETS: Mapping[str, Callable[[Claim], Iterator[str]]] = {"G111": _g111, "circle-line": _circle_line}
