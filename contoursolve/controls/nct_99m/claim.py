"""NCT chapter 16: what the blocks of a contour state, with what the control supplies, and what their signs choose."""

from collections.abc import Iterator, Mapping, Sequence, Set
from decimal import Decimal

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls.nct_99m.chain import Names, compose, names_of
from contoursolve.controls.nct_99m.lexicon import (
    AIMED,
    ALONE,
    AXES,
    BESIDE,
    CIRCLE_CIRCLE,
    FEED,
    FOLLOWED,
    LAST,
    LINE_LINE,
    MANUAL,
    NEGATIVE_RADIUS,
    ON_PARALLEL_AXES,
    ONE_CENTER,
    ONLY,
    ORDINARY,
    OTHER_PLANE,
    PARALLEL_TO,
    PLANES,
    POINT,
    RAPID,
    UNCOMPENSATED,
    UNCOMPENSATED_FREE,
    Element,
    pair_role,
)
from contoursolve.diagnostics.source import Evidence, Source
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Choice, Given, OnCircle, Side, Turn, Unit
from contoursolve.reading import ContourForm, Convention, Lexicon, Modes, ParsedContour, Selector, Setting, State
from contoursolve.tolerance import RADIUS_DIFFERENCE

CLOCKWISE = "first-met-clockwise"

CIRCLE_CIRCLE_Q = Setting(
    name="circle-circle-q",
    meaning="which intersection of two circles Q chooses",
    values={
        "left-is-negative": "Q<0 the point left of the way from the first centre to the second, Q>0 the one right",
        "right-is-negative": "Q<0 the point right of the way from the first centre to the second, Q>0 the one left",
        CLOCKWISE: "Q<0 the point met first, clockwise along the first circle from its arc's start, Q>0 the one met "
        "second",
    },
    default="left-is-negative",
    source=Source(MANUAL, "16.3.4: the page has not been seen", Evidence.ASSUMED),
)

COMPENSATION = Setting(
    name="compensation",
    meaning="whether intersections are computed without G41 or G42",
    values={
        "required": "G41 or G42 must be active before the first of two blocks that meet in an intersection",
        "free": "intersections are computed without G41 and G42, too",
    },
    default="required",
    source=Source(MANUAL, "16.3: every format and example has it; the sentence is on no page seen", Evidence.ASSUMED),
)

RADIUS_DIFFERENCES = Setting(
    name="radius-difference",
    meaning="how much the radii at two points of an arc may differ (machine parameter RADDIFF)",
    values={str(RADIUS_DIFFERENCE): "mm"},
    default=str(RADIUS_DIFFERENCE),
    source=Source(MANUAL, "p. 26 (4.3): alarm 3011; the value is one of each machine", Evidence.ASSUMED),
    bounds=(Decimal("0.001"), Decimal(10)),
)

SETTINGS = (CIRCLE_CIRCLE_Q, COMPENSATION, RADIUS_DIFFERENCES)


class Member(Struct, frozen=True):
    """One block of a contour: its element, the states before and after its G codes, whether it can stand here."""

    block: Block
    element: Element
    here: State
    is_alone: bool = False
    """Over-defined, but no G1, G2 or G3 block is right before it."""
    is_last: bool = False
    """No G1, G2 or G3 block follows."""


def claim_of(members: Sequence[Member], before: State, modes: Modes) -> ParsedContour:
    """The contour of blocks in a row."""
    elements = tuple(member.element for member in members)
    counts_clockwise = modes.convention(CIRCLE_CIRCLE_Q).value == CLOCKWISE
    form = compose(elements, modes.radius_difference, counts_clockwise=counts_clockwise)
    names = names_of(elements)
    first = members[0].here
    words: dict[str, Word] = {}
    repeated: list[Word] = []
    givens: dict[str, Given] = {}
    vocabulary: dict[str, tuple[str, int]] = {}
    circumstances: set[str] = set()
    for index, member in enumerate(members):
        called = _calls(member, modes.lexicon)
        prefix = f"{index + 1}:"
        vocabulary |= {prefix + name: (address, index) for address, name in called.items()}
        own: dict[str, Word] = {}
        for word in member.block.words:
            code = word.number if word.address == "G" else ""
            name = called.get(word.address, f"{word.address}{code}")
            if name in own and word.address != "M":
                repeated.append(word)
            own.setdefault(name, word)
        own_givens = _givens(own, member, modes.lexicon)
        words |= {prefix + name: word for name, word in own.items()}
        givens |= {prefix + name: replace(given, name=prefix + name) for name, given in own_givens.items()}
        since = (before, *(each.here for each in members))[max(index - 1, 0) : index + 2]
        holds = {*_circumstances(member, first, is_only=len(members) == 1), *_uncompensated(member, since, modes)}
        circumstances |= {prefix + name for name in holds}
    known = {name: word for name, word in words.items() if word.address in modes.lexicon.addresses}
    return ParsedContour(
        form=form,
        lexicon=modes.lexicon,
        blocks=tuple(member.block for member in members),
        before=replace(before, plane=first.plane, unit=first.unit),
        after=members[-1].here,
        words=known,
        givens=givens,
        vocabulary=vocabulary,
        unknown=tuple(word for word in words.values() if word.address not in form.allowed),
        repeated=tuple(repeated),
        circumstances=frozenset(circumstances),
        choices=tuple(_choices(elements, names, known, modes)),
        selectors=tuple(_selectors(elements, names, known, modes)),
        is_end_absolute=elements[-1].is_over,
        selected=PLANES[members[-1].here.plane.code],
        conventions=tuple(_conventions(form, circumstances, modes)),
    )


def _calls(member: Member, lexicon: Lexicon) -> dict[str, str]:
    """What a block's addresses state, without the number of the block."""
    plane = member.here.plane
    step = "-step" if member.here.is_incremental and not member.element.is_over else ""
    called = {address: address for address, row in lexicon.addresses.items() if not row.axis}
    called |= {axis: name for axis, name in zip(AXES, BESIDE, strict=True) if axis not in plane.axes}
    called |= dict.fromkeys({"I", "J", "K"} - {*plane.centers}, "wrong-center")
    for addresses, what, suffix in ((plane.axes, "", step), (plane.centers, "center-", "")):
        called |= {address: f"{what}{order}{suffix}" for address, order in zip(addresses, _ORDERS, strict=True)}
    return called


_ORDERS = ("first", "second")


def _givens(words: Mapping[str, Word], member: Member, lexicon: Lexicon) -> dict[str, Given]:
    """The values of a block's words, with those that the control supplies. R counts by its size: its sign picks the
    centre of an ordinary arc, and means nothing in an over-defined circle (assumed)."""
    stated = {
        name: given
        for name, word in words.items()
        if word.address in lexicon.addresses
        for given in (lexicon.given(name, word, member.here.unit),)
        if given is not None
    }
    if "R" in stated:
        stated["R"] = replace(stated["R"], value=abs(stated["R"].value))
    asked = {name.removesuffix("-step") for name, word in words.items() if word.is_asked}
    element = member.element
    if element.is_over:
        return stated
    if element.turn is not None:
        stated |= _supplied("center-", "", stated, asked)
    ends = {name.removesuffix("-step") for name in stated} & {*_ORDERS}
    is_partial = element.turn is None and ",A" in words
    if not is_partial and (ends or not element.is_followed):
        stated |= _supplied("", "-step", stated, asked, is_always=not element.is_followed)
    if ends and element.is_followed:
        name = AIMED if element.turn is None and ",A" in stated else POINT
        stated[name] = Given(name, Decimal(0), Unit.SIGN, None)
    return stated


def _supplied(
    what: str, suffix: str, stated: Mapping[str, Given], asked: set[str], *, is_always: bool = False
) -> dict[str, Given]:
    """Of a pair, the missing one is no distance from where the element begins (assumed, as for every circle)."""
    names = [what + order for order in _ORDERS]
    present = {name.removesuffix("-step") for name in stated} | asked
    missing = [name for name in names if name not in present]
    if len(missing) == len(names) and not is_always:
        return {}
    return {name + suffix: Given(name + suffix, Decimal(0), Unit.MM, None) for name in missing}


def _circumstances(member: Member, first: State, *, is_only: bool) -> Iterator[str]:
    radius = member.block.find("R")
    is_negative = radius is not None and radius.number is not None and radius.number < 0
    centers = sum(member.block.find(address) is not None for address in first.plane.centers)
    holds = {
        FEED: member.block.find("F") is not None,
        NEGATIVE_RADIUS: member.element.is_over and is_negative,
        ONE_CENTER: member.element.turn is not None and not member.element.is_over and centers == 1,
        ALONE: member.is_alone,
        OTHER_PLANE: member.here.plane != first.plane,
        RAPID: member.here.motion == 0,
        FOLLOWED: member.element.is_followed,
        LAST: member.is_last,
        ONLY: is_only,
        ON_PARALLEL_AXES: not {*member.here.plane.axes} <= {*PARALLEL_TO},
        ORDINARY: is_only and member.element.turn is not None,
    }
    return (name for name, is_true in holds.items() if is_true)


def _uncompensated(member: Member, states: Sequence[State], modes: Modes) -> Iterator[str]:
    """Whether G41 or G42 is missing in one of the states before N1, in N1 and in N2."""
    if member.element.is_over and any(state.compensation == 40 for state in states):  # noqa: PLR2004 - G40
        yield UNCOMPENSATED_FREE if modes.convention(COMPENSATION).value == "free" else UNCOMPENSATED


def _conventions(form: ContourForm, circumstances: Set[str], modes: Modes) -> Iterator[Convention]:
    """What decides here: a difference of radii has a finding of its own, so that only one that was set is named."""
    if any(name.endswith((UNCOMPENSATED, UNCOMPENSATED_FREE)) for name in circumstances):
        yield modes.convention(COMPENSATION)
    difference = modes.convention(RADIUS_DIFFERENCES)
    if difference.value != RADIUS_DIFFERENCES.default and any(isinstance(row.fact, OnCircle) for row in form.facts):
        yield difference
    if CIRCLE_CIRCLE in {role.name for role in form.roles}:
        yield modes.convention(CIRCLE_CIRCLE_Q)


def _choices(
    elements: Sequence[Element], names: Sequence[Names], words: Mapping[str, Word], modes: Modes
) -> Iterator[Choice]:
    """R's sign picks the centre of an ordinary arc: the shorter arc for a positive one. Q's sign picks the
    intersection in which its block begins."""
    previous: Element | None = None
    for element, each in zip(elements, names, strict=True):
        radius, sign = f"{each.prefix}R", f"{each.prefix}Q"
        size = words[radius].number if radius in words else None
        if element.turn is not None and not element.is_over and size is not None:
            yield Choice(each.center, _center_side(element.turn, is_short=size > 0), radius)
        chosen = words[sign].number if sign in words else None
        if previous is not None and element.is_over and chosen:
            role = pair_role(previous, element)
            if role != LINE_LINE:
                yield Choice(each.tail, _side(role, is_negative=chosen < 0, modes=modes), sign)
        previous = element


def _center_side(turn: Turn, *, is_short: bool) -> Side:
    return Side.LEFT if is_short == (turn is Turn.CCW) else Side.RIGHT


def _side(role: str, *, is_negative: bool, modes: Modes) -> Side:
    """The intersection that a sign of Q chooses."""
    if role != CIRCLE_CIRCLE:
        return Side.NEARER if is_negative else Side.FARTHER
    negative, positive = _CIRCLE_SIDES[modes.convention(CIRCLE_CIRCLE_Q).value]
    return negative if is_negative else positive


_CIRCLE_SIDES = {
    "left-is-negative": (Side.LEFT, Side.RIGHT),
    "right-is-negative": (Side.RIGHT, Side.LEFT),
    CLOCKWISE: (Side.FIRST, Side.SECOND),
}
"""What a negative and a positive Q of two circles choose."""


def _selectors(
    elements: Sequence[Element], names: Sequence[Names], words: Mapping[str, Word], modes: Modes
) -> Iterator[Selector]:
    """Q chooses an intersection, and the sign of a stated R a centre."""
    previous: Element | None = None
    for element, each in zip(elements, names, strict=True):
        if previous is not None and element.is_over and pair_role(previous, element) != LINE_LINE:
            for is_negative, text in ((True, "Q-1"), (False, "Q1")):
                side = _side(pair_role(previous, element), is_negative=is_negative, modes=modes)
                yield Selector(each.tail, side, text)
        word = words.get(f"{each.prefix}R")
        if element.turn is not None and not element.is_over and word is not None and word.number is not None:
            size = word.text.lstrip("Rr +-")
            yield Selector(each.center, _center_side(element.turn, is_short=True), f"R{size}")
            yield Selector(each.center, _center_side(element.turn, is_short=False), f"R-{size}")
        previous = element
