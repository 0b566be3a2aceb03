"""The statements of the blocks of a contour, with what the control supplies, and what their signs choose."""

from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from functools import lru_cache
from itertools import pairwise

from msgspec.structs import replace

from contoursolve.controls.chain.form import Names, compose, names_of
from contoursolve.controls.chain.language import (
    AIMED,
    ALONE,
    BESIDE_ARC,
    CORNER_ALONE,
    CORNER_BOTH,
    CORNER_CROWDED,
    CORNER_TWICE,
    FEED,
    FOLLOWED,
    IN_ZX,
    LAST,
    LEAVES,
    LEFT_OUT,
    LINE_LINE,
    NEGATIVE,
    NEGATIVE_RADIUS,
    NO_TANGENT,
    ON_PARALLEL_AXES,
    ONE_CENTER,
    ONLY,
    OPEN_ARC_END,
    ORDINARY,
    OTHER_DIAMETER,
    OTHER_PLANE,
    OTHER_ZERO,
    POINT,
    RAPID,
    RAPID_CORNER,
    SIGNED,
    SMOOTH,
    THREAD,
    TURN,
    WAY,
    WITHOUT_POINT,
    Element,
    Joining,
    Language,
    Member,
    pair_role,
)
from contoursolve.gcode import PLAIN, Block, Word
from contoursolve.geometry import Choice, Given, Plane, Side, Turn, Unit
from contoursolve.reading import Bearing, ContourBuilder, ContourForm, Lexicon, Modes, ParsedContour, Selector, State


def claim_of(language: Language, members: Sequence[Member], before: State, modes: Modes) -> ParsedContour:
    """The contour of blocks in a row."""
    elements = tuple(member.element for member in members)
    form, names = compose(language, elements, modes), names_of(elements)
    first, last, builder = members[0].here, members[-1].here, ContourBuilder(modes)
    states = (before, *(each.here for each in members))
    holding: list[dict[str, None]] = []
    for index, member in enumerate(members):
        prefix = f"{index + 1}:"
        own, givens, kept = _stated(language, member, builder, prefix)
        holds = {
            *_circumstances(language, member, first, modes, is_only=len(members) == 1, is_first=not index),
            *([BESIDE_ARC] if any(each.turn is not None for each in elements[index : index + 2]) else []),
            *language.basis.circumstances(member, states[max(index - 1, 0) : index + 2], modes),
            *(name for name, (setting, value) in language.basis.where_set.items() if modes.has(setting, value)),
        }
        builder.state(prefix, own, givens, holds, kept=kept)
        holding.append(dict.fromkeys((*own, *givens, *holds, *_read_by(member, modes))))
    unknown = [word for word in builder.words.values() if not _is_known(word, form, modes.lexicon)]
    unread = [word for word in unknown if modes.lexicon.bearing(word.address) in (Bearing.UNREAD, Bearing.END)]
    known = {name: word for name, word in builder.words.items() if word.address in modes.lexicon.addresses}
    conventions = (
        *language.basis.conventions(form, builder.circumstances, modes),
        *(modes.convention(row.setting) for row in language.basis.premises if row.is_told(holding, modes)),
    )
    return builder.build(
        form,
        _begins(before, members[0]),
        replace(last, plane=replace(last.plane, diameters=_counted(members))),
        words=known,
        unknown=tuple(word for word in unknown if word not in unread),
        unread=tuple(dict.fromkeys((*unread, *filter(None, (member.unread for member in members))))),
        choices=tuple(_choices(language, elements, names, known, modes)),
        selectors=tuple(_selectors(language, elements, names, known, modes)),
        selected=language.planes.get(last.plane.code, last.plane),
        conventions=tuple({each.setting.name: each for each in conventions}.values()),
        makes=_makes(form, members) if len(builder.blocks) > len(members) else (),
        lasting=frozenset(name for name in known if name.partition(":")[2] in language.corner.stays),
        doubts={mode: why for member in members for mode, why in member.here.doubts.items()},
    )


def _counted(members: Sequence[Member]) -> tuple[bool, bool]:
    """The axes of the plane that count diameters: X does where it does in one of the blocks."""
    first, second = (any(axis) for axis in zip(*(member.here.plane.diameters for member in members), strict=True))
    return first, second


def _begins(before: State, member: Member) -> State:
    """The state in which the first block begins: it may move the coordinate system itself."""
    here = member.here
    axes = before.axes if here.axes is member.before.axes else here.axes
    return replace(before, plane=here.plane, unit=here.unit, axes=axes)


def _stated(
    language: Language, member: Member, builder: ContourBuilder, prefix: str
) -> tuple[dict[str, Word], dict[str, Given], dict[str, Word]]:
    """The words of a block and of the one that states the corner behind it, their values, and the words of earlier
    blocks that stay in force."""
    modes, called = builder.modes, _calls(language, member)
    index = builder.add(member.block)
    addresses: dict[str, str] = {}
    for address, name in called.items():
        # Of several words for the same thing, the one that is there; else the plain one.
        if name not in addresses or member.block.find(address):
            addresses[name] = address
    builder.name(prefix, index, addresses.items())
    own = builder.gather(
        (called.get(word.address, f"{word.address}{word.number if word.address == 'G' else ''}"), word)
        for word in member.block.words
    )
    sized, in_force = _kept_corner(language, own, member, modes)
    angled, turned = _kept_angle(language, own, member, modes)
    givens = _givens(language, own, member, builder) | sized | angled
    if member.corner is not None:
        sized, corner, in_force = _corner_of(language, member.corner, member.here, modes)
        builder.name(prefix, builder.add(member.corner), ((name, language.corner.size) for name in corner))
        own, givens = own | {name: word for name, word in corner.items() if name not in own}, givens | sized
    return own, givens, in_force | turned


def _read_by(member: Member, modes: Modes) -> Iterator[str]:
    """The addresses of a block, and what else a setting may decide about it."""
    here, element = member.here, member.element
    rows, whole = modes.lexicon.addresses, list[str]()
    for word in member.block.words:
        yield word.address
        if word.number and "." not in word.text:
            whole.append(word.address)
    if any(address in rows and rows[address].unit in _MEASURED for address in whole):
        yield WITHOUT_POINT
    if element.turn is not None and element.is_followed:
        yield OPEN_ARC_END
    if {*here.plane.axes} == {"X", "Z"}:
        yield IN_ZX


_MEASURED = (Unit.MM, Unit.DEGREE)


def _is_known(word: Word, form: ContourForm, lexicon: Lexicon) -> bool:
    """Whether a word may stand in a block of a contour."""
    if word.address in form.allowed:
        return True
    bears_nothing = lexicon.bearing(word.address) in (Bearing.NONE, Bearing.AXIS)
    return bears_nothing and f",{word.address}" not in lexicon.addresses


def _makes(form: ContourForm, members: Sequence[Member]) -> tuple[tuple[str, ...], ...]:
    """The names of what each block makes, where some corners have blocks of their own."""
    corners = {row.before: row.name for row in form.outline.corners}
    found: list[tuple[str, ...]] = []
    for element, member in zip(form.outline.path, members, strict=True):
        corner = tuple(name for before, name in corners.items() if before == element.name)
        found += [(element.name, *corner)] if member.corner is None else [(element.name,), corner]
    return tuple(found)


def _corner_of(
    language: Language, block: Block, here: State, modes: Modes
) -> tuple[dict[str, Given], dict[str, Word], dict[str, Word]]:
    """The size that a block of its own gives a corner, with its word; the last one given if it has none."""
    name = language.corner.codes[int(shapes_of(language, block)[0].number or 0)]
    own, kept = block.find(language.corner.size), here.memory.get(language.corner.size)
    word = own or kept
    size = modes.words(here).given(name, word, here.unit) if word else None
    givens = {name: size if own else replace(size, word=None)} if size else {}
    return givens, {name: own} if own else {}, {name: _put(kept, block)} if kept and not own else {}


def _crowding(language: Language, member: Member) -> dict[str, bool]:
    """The faults of a block of its own that makes the corner behind an element: it says that twice, more about the path
    than the size, or what the block of the element says already."""
    block = member.corner
    if block is None:
        return {}
    codes = shapes_of(language, block)
    sizes = [word for word in block.words if word.address == language.corner.size]
    others = [word for word in block.words if word.address not in (*"NGFSTMDH", language.corner.size)]
    size = language.corner.codes[int(codes[0].number or 0)]
    return {
        CORNER_BOTH: len(codes) > 1,
        CORNER_CROWDED: len(codes) == 1 and (len(sizes) > 1 or bool(others)),
        CORNER_TWICE: bool(sizes)
        and any(_calls(language, member).get(word.address) == size for word in member.block.words),
    }


def shapes_of(language: Language, block: Block) -> list[Word]:
    """The codes of a block that make a corner."""
    return [word for word in block.words if word.address == "G" and word.number in language.corner.codes]


def _kept_corner(
    language: Language, own: Mapping[str, Word], member: Member, modes: Modes
) -> tuple[dict[str, Given], dict[str, Word]]:
    """The corner that a word makes that stays in force, where the block has no corner word; and that word."""
    is_own = member.corner is not None or any(name in own for name in language.corner.shapes)
    if is_own or member.is_straight or not member.is_joined or member.here.motion == 0:
        return {}, {}
    for address, corner in language.corner.stays.items():
        word = member.here.memory.get(address)
        if word is not None:
            size = modes.words(member.here).given(corner, word, member.here.unit)
            return ({corner: replace(size, word=None)} if size else {}), {corner: _put(word, member.block)}
    return {}, {}


def _put(word: Word, block: Block) -> Word:
    """A word of an earlier block, as if it stood where a block does."""
    return word if word in block.words else replace(word, span=block.span)


def _kept_angle(
    language: Language, own: Mapping[str, Word], member: Member, modes: Modes
) -> tuple[dict[str, Given], dict[str, Word]]:
    """The angle that stays in force, of a line with one coordinate and no angle; and its word."""
    word = member.here.memory.get(language.angle.address) if language.angle.stays else None
    if word is None:
        return {}, {}
    stated = {name.removesuffix("-step") for name in own} & {*_ORDERS}
    if language.angle.address in own or member.element.turn is not None or len(stated) != 1:
        return {}, {}
    here = _put(word, member.block)
    given = modes.words(member.here).given(language.angle.address, here, member.here.unit)
    return ({language.angle.address: given} if given else {}), {language.angle.address: here}


def _calls(language: Language, member: Member) -> Mapping[str, str]:
    """The names of what a block's addresses state, without the number of the block."""
    is_absolute = member.element.is_over and language.meeting.joining is not Joining.OPEN
    angles = [address for address in language.angle.synonyms if member.block.find(address)] or language.angle.synonyms[
        :1
    ]
    called = _calls_in(
        language,
        member.here.plane,
        angles[-1] if angles else "",
        is_arc=member.element.turn is not None,
        is_signed=member.is_signed,
        is_incremental=member.here.is_incremental and not is_absolute,
    )
    if not language.corner.negative:
        return called
    numbers = {word.address: word.number for word in member.block.words}
    return {
        address: NEGATIVE + name if name in language.corner.negative and (numbers.get(address) or 0) < 0 else name
        for address, name in called.items()
    }


@lru_cache(maxsize=256)
def _calls_in(
    language: Language, plane: Plane, angle: str, *, is_arc: bool, is_signed: bool, is_incremental: bool
) -> Mapping[str, str]:
    """The same of all blocks alike; `angle` is the address that states the angle, of several."""
    addresses = language.lexicon.addresses
    called = {address: address for address, row in addresses.items() if not row.axis}
    centers = {center: f"center-{order}" for center, order in zip(plane.centers, _ORDERS, strict=True)}
    called |= {address: centers.get(address, "wrong-center") for address in ("I", "J", "K") if address in addresses}
    called |= {address: f"beside-{address}" for address, row in addresses.items() if row.axis not in ("", *plane.axes)}
    called |= language.names_in(is_arc=is_arc)
    if is_arc:
        called |= language.arc.centers_at(plane)
    if is_signed:
        signed = {address: language.corner.signed_name(address, plane) for address in language.corner.signed}
        called |= {address: name for address, name in signed.items() if name}
    if language.angle.synonyms:
        called |= {address: f"beside-{address}" for address in (language.angle.address, *language.angle.synonyms)}
        called[angle] = language.angle.address
    for axis, order in zip(plane.axes, _ORDERS, strict=True):
        for address, row in addresses.items():
            if row.axis == axis:
                called[address] = order + ("-step" if row.is_step(is_incremental=is_incremental) else "")
    return called


_ORDERS = ("first", "second")


def _givens(language: Language, words: Mapping[str, Word], member: Member, builder: ContourBuilder) -> dict[str, Given]:
    """The values of a block's words, with those that the control supplies. R counts by its size: its sign picks the
    centre of an ordinary arc, and means nothing in an over-defined circle (assumed). So does a corner whose sign tells
    its shape."""
    stated = builder.values(words, member.here)
    sizes = {name: given for name, given in stated.items() if name == "R" or name.startswith((SIGNED, NEGATIVE))}
    stated |= {name: replace(given, value=abs(given.value)) for name, given in sizes.items()}
    asked = {name.removesuffix("-step") for name, word in words.items() if word.is_asked}
    element = member.element
    if element.is_over and language.meeting.joining is Joining.OVER_DEFINED:
        return stated
    if element.is_smooth:
        stated[TURN] = Given(TURN, Decimal(0), Unit.DEGREE, None)
    elif element.turn is not None and not (language.arc.radius_wins and "R" in words):
        stated |= _supplied("center-", "", stated, asked)
    if element.is_over:
        return stated
    if element.aim is not None:
        stated[WAY] = Given(WAY, Decimal(90 * element.aim + 90 * (1 - member.way)), Unit.DEGREE, None)
        return stated
    ends = {name.removesuffix("-step") for name in stated} & {*_ORDERS}
    is_partial = element.turn is None and (
        language.angle.address in words or bool(_kept_angle(language, words, member, builder.modes)[0])
    )
    if not is_partial and (ends or not element.is_followed):
        stated |= _supplied("", "-step", stated, asked, is_always=not element.is_followed)
    if ends and element.is_followed:
        name = AIMED if element.turn is None and language.angle.address in stated else POINT
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


def _circumstances(
    language: Language, member: Member, first: State, modes: Modes, *, is_only: bool, is_first: bool
) -> Iterator[str]:
    radius, plane = member.block.find(language.address_of("R")), member.here.plane
    is_negative = radius is not None and radius.number is not None and radius.number < 0
    centers = sum(member.block.find(address) is not None for address in first.plane.centers)
    holds = {
        FEED: member.block.find("F") is not None,
        NEGATIVE_RADIUS: member.element.is_over and is_negative,
        ONE_CENTER: centers == 1,
        ALONE: member.is_alone,
        OTHER_PLANE: replace(plane, diameters=first.plane.diameters) != first.plane,
        OTHER_ZERO: member.here.axes is not first.axes
        and any(member.here.axes[axis] is not first.axes[axis] for axis in first.plane.axes),
        OTHER_DIAMETER: plane.code == first.plane.code
        and plane.diameters != first.plane.diameters
        # One command may tell diameters in absolute coordinates from radii in increments.
        and member.here.diameter is not first.diameter,
        RAPID: member.here.motion == 0,
        RAPID_CORNER: language.corner.words_in_rapid(modes)
        or (member.corner is not None and language.corner.codes_in_rapid),
        LEFT_OUT: language.corner.leaves_out(modes),
        THREAD: member.here.motion in language.order.threads,
        FOLLOWED: member.element.is_followed,
        LAST: member.is_last,
        ONLY: is_only,
        SMOOTH: member.element.is_smooth,
        CORNER_ALONE: bool(shapes_of(language, member.block)),
        **_crowding(language, member),
        NO_TANGENT: member.element.is_smooth and is_first,
        ON_PARALLEL_AXES: member.here.plane.axes != _own_axes(language, member.here),
        ORDINARY: is_only and member.element.turn is not None,
        **{name: axis in member.leaves for axis, name in enumerate(LEAVES)},
    }
    return (name for name, is_true in holds.items() if is_true)


def _own_axes(language: Language, state: State) -> tuple[str, str]:
    plane = language.planes.get(state.plane.code, state.plane)
    return plane.axes


def _choices(
    language: Language, elements: Sequence[Element], names: Sequence[Names], words: Mapping[str, Word], modes: Modes
) -> Iterator[Choice]:
    """R's sign picks the centre of an ordinary arc: the shorter arc for a positive one. Q's sign picks the
    intersection in which its block begins."""
    for point, name in _picks(language, elements, names):
        value = words[name].number if name in words else 0
        if value in (0, 1):
            yield Choice(point, Side.LONGER if value else Side.SHORTER, name)
    previous: Element | None = None
    for element, each in zip(elements, names, strict=True):
        radius, sign = f"{each.prefix}R", f"{each.prefix}{language.meeting.selector}"
        size = words[radius].number if radius in words else None
        if element.turn is not None and (element.touches or not element.is_over) and size is not None:
            yield Choice(each.center, _center_side(element.turn, is_short=size > 0), radius)
        chosen = words[sign].number if sign in words else None
        if previous is not None and element.is_over and chosen:
            role = pair_role(previous, element)
            if role != LINE_LINE and language.meeting.choose_side is not None:
                yield Choice(each.tail, language.meeting.choose_side(role, chosen < 0, modes), sign)
        previous = element


def _picks(language: Language, elements: Sequence[Element], names: Sequence[Names]) -> Iterator[tuple[str, str]]:
    """The intersections that a value picks, each with its name: the word stands in the block of the arc."""
    for (before, after), (first, second) in zip(pairwise(elements), pairwise(names), strict=True):
        is_line = before.turn is None
        if language.meeting.picks and after.is_over and not after.touches and is_line is not (after.turn is None):
            yield second.tail, f"{(second if is_line else first).prefix}{language.meeting.picks}"


def _center_side(turn: Turn, *, is_short: bool) -> Side:
    return Side.LEFT if is_short == (turn is Turn.CCW) else Side.RIGHT


def _selectors(
    language: Language, elements: Sequence[Element], names: Sequence[Names], words: Mapping[str, Word], modes: Modes
) -> Iterator[Selector]:
    """Q chooses an intersection, a value picks one, and the sign of a stated R chooses a centre."""
    for point, _ in _picks(language, elements, names):
        yield Selector(point, Side.SHORTER, f"{language.meeting.picks}0")
        yield Selector(point, Side.LONGER, f"{language.meeting.picks}1")
    previous: Element | None = None
    for element, each in zip(elements, names, strict=True):
        role = pair_role(previous, element) if previous is not None and element.is_over else LINE_LINE
        if role != LINE_LINE and language.meeting.choose_side is not None:
            for is_negative, number in ((True, "-1"), (False, "1")):
                side = language.meeting.choose_side(role, is_negative, modes)
                yield Selector(each.tail, side, f"{language.meeting.selector}{number}")
        word = words.get(f"{each.prefix}R")
        is_chosen = element.turn is not None and (element.touches or not element.is_over)
        if element.turn is not None and is_chosen and word is not None and word.number is not None:
            size = PLAIN.number_of(word.text, word.address).lstrip("+- \t")
            for is_short, text in ((True, size), (False, f"-{size}")):
                side = _center_side(element.turn, is_short=is_short)
                yield Selector(each.center, side, PLAIN.spell(word.address, text))
        previous = element
