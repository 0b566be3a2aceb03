"""The contour that the blocks of a chain state: words by their names, values, circumstances, choices."""

import re
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import replace as replace_fields
from decimal import Decimal
from functools import cache

from msgspec.structs import replace

from contoursolve.controls.heidenhain.chain_blocks import TWICE, ChainBlocks, ChainMember, Pole, sign_of
from contoursolve.controls.heidenhain.circumstances import (
    AT_ARC,
    CLOSES_NOTHING,
    CONTINUED,
    CORNERED,
    CUT,
    FIRST_CORNER,
    FULL,
    LAST_CORNER,
    NEVER_CLOSED,
    NO_BEFORE,
    NO_BLOCK,
    NO_CENTER,
    NO_COORDINATE,
    NO_LINE,
    NO_POLE,
    NO_RADIUS,
    NO_SENSE,
    NO_TURN,
    PARAMETER,
    TOOL,
    TURNS_BACK,
    TWO_BLOCKS,
)
from contoursolve.controls.heidenhain.elements import (
    ALONG,
    POINTS,
    POLAR,
    TANGENCY,
    FkElement,
)
from contoursolve.controls.heidenhain.follow import (
    CENTER,
    POLE,
    TOOL_AXIS,
    full_circles,
    senses,
    words_of_cycle,
    words_of_machine,
)
from contoursolve.controls.heidenhain.form import compose
from contoursolve.controls.heidenhain.lexicon import (
    ABOUT_CENTER,
    AMBIGUOUS,
    CHAMFER,
    FREE,
    MOVES,
    REFERRING_TO_LINES,
    ROUNDING,
    SELECTION,
    STRAIGHT,
    TANGENT,
    PlaneWords,
    function_of,
)
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Choice, Given, Pick, Profile, Side, Turn, Unit, assemble
from contoursolve.reading import ContourBuilder, Convention, Modes, ParsedContour, State, read
from contoursolve.solving import analyse, place_cuts

_BESIDE_ANY = frozenset({"N", "G", "F", "M", "S"})


@cache
def _allowed(words: PlaneWords) -> Mapping[str, frozenset[str]]:
    """The words that a function may have."""
    beside = {"CLSD", *words.across, *((ROUNDING, CHAMFER, "FSELECT") if words.has_corners else ())}
    of_lines = frozenset({*words.of_element(is_line=True), *beside})
    of_arcs = frozenset({*words.of_element(is_line=False), "DR", *beside})
    ends, polar = frozenset({*words.axes, *words.increments, *words.across}), {"PR", "PA", "IPR", "IPA"}
    return {
        **{name: (of_lines if name in STRAIGHT else of_arcs) for name in FREE},
        "L": ends,
        "LP": frozenset({*polar, *words.across}),
        "C": ends | {"DR"},
        "CP": frozenset({"PA", "IPA", "DR", *words.across}),
        "CR": ends | {"DR", "R"},
        "CT": ends,
        "CTP": frozenset({*polar, *words.across}),
        "FPOL": frozenset(words.axes),
        "CC": ends,
        "RND": frozenset({ROUNDING}),
        "CHF": frozenset({CHAMFER}),
        "FSELECT": frozenset({"FSELECT"}),
    }


def claim_of(chain: ChainBlocks, before: State, modes: Modes) -> ParsedContour:
    """The contour that the blocks of a chain state."""
    members, labels, builder = chain.members, _labels(chain), ContourBuilder(modes)
    builder.add(*chain.blocks)
    _bend(chain, before, modes)
    for member in members:
        member.own = _own_words(member, builder)
    elements: list[FkElement] = []
    for number, member in enumerate(members, 1):
        elements.append(_element(chain, number, elements))
        circumstances = *_lacking(chain, number, elements), *_corner_circumstances(members, number)
        lasting = [name for name in member.own if name in _no_facts(chain.words) or name in elements[-1].touching]
        builder.state(f"{number}:", member.own, _givens(chain, elements, builder), circumstances, lasting=lasting)
        _name_words(builder, number, member, chain.words)
    for name, pole in chain.poles.items():
        _state_pole(builder, f"{name}:", pole, before)
    picks = [
        Pick(number, int(member.picked.number), f"{number}:FSELECT")
        for number, member in enumerate(members, 1)
        if member.picked is not None and member.picked.number is not None
    ]
    stated = tuple(name for name, (_, block) in chain.poles.items() if isinstance(block, Block))
    claim = replace_fields(
        builder.build(compose(tuple(elements), labels, stated, chain.words), before, chain.state),
        unknown=tuple(word for block in chain.blocks for word in _foreign(block, chain)),
        unread=tuple(word for block in chain.blocks for word in (*words_of_machine(block), *words_of_cycle(block))),
        choices=tuple(_choices(members, elements, labels)),
        makes=tuple(_makes(chain, labels)),
        picks=tuple(_picks(picks, len(members), modes)),
        conventions=tuple(_conventions(bool(picks), modes)),
        doubts={name: why for member in members for name, why in _doubts(member)},
    )
    if not before.start().is_known and any(each.function in OF_CENTER and each.center_at is None for each in members):
        # From a place that is known, CC may have one.
        claim = replace_fields(claim, needs_place=True)
    if chain.is_cut and _has_free(members) and _is_open(read(claim, frozenset())):
        cut = frozenset({f"{len(members)}:{CUT}"})
        return replace_fields(claim, circumstances=claim.circumstances | cut, passing=cut)
    return claim


def _bend(chain: ChainBlocks, before: State, modes: Modes) -> None:
    """Find what is known of conventional arcs before anything is solved: their sense, and which are full circles."""
    functions = {member.function for member in chain.members}
    known = dict(senses(chain.blocks, before, modes)) if functions & {*TANGENT[2:]} else {}
    circles = {*full_circles(chain.blocks, before, modes)} if functions & {*ABOUT_CENTER} else set[int]()
    for member in chain.members:
        member.sense, member.is_full = known.get(member.index, 0), member.index in circles


def _choices(members: Sequence[ChainMember], elements: Sequence[FkElement], labels: Sequence[str]) -> Iterator[Choice]:
    """The centres that the signs of R in CR choose."""
    for number, (member, element, label) in enumerate(zip(members, elements, labels, strict=True), 1):
        radius = member.own.get("R") if member.function == "CR" else None
        if radius is not None and radius.number is not None:
            is_left = (radius.number > 0) is (element.turn is not Turn.CW)
            yield Choice(f"C{label}", Side.LEFT if is_left else Side.RIGHT, f"{number}:R")


def _name_words(builder: ContourBuilder, number: int, member: ChainMember, words: PlaneWords) -> None:
    """Add the names of all that the blocks of an element may state."""
    prefix, own = f"{number}:", member.own
    builder.name(prefix, member.index, ((name, name) for name in _may_state(member, own.keys(), words)))
    builder.name(prefix, member.index, ((name, word.address) for name, word in own.items()))
    if number == 1 and member.function in FREE and "CLSD+" not in own:
        builder.name(prefix, member.index, [("CLSD+", "CLSD")])
    for place, _ in member.corners[:1]:
        builder.name(prefix, place, ((name, name) for name in (ROUNDING, CHAMFER)))


def _state_pole(builder: ContourBuilder, prefix: str, pole: Pole, before: State) -> None:
    """Add what a pole states: its block, or the coordinates that were in force before the chain."""
    (place, block), plane = pole, before.plane.axes
    if isinstance(block, Block):
        words = {word.address: word for word in block.words if word.address in plane}
        circumstances = () if words else (NO_COORDINATE,)
        builder.state(prefix, words, builder.values(words, before), circumstances)
        builder.name(prefix, int(place), ((axis, axis) for axis in plane))
    else:
        values = zip(plane, (Decimal(place), block), strict=True)
        builder.state(prefix, {}, {axis: Given(axis, value, Unit.MM, None) for axis, value in values})


def _is_open(profile: Profile) -> bool:
    """Whether something of a path is not determined."""
    free = analyse(assemble(profile)).free
    return bool(free) and not place_cuts(profile, free)[1]


def _picks(stated: Sequence[Pick], count: int, modes: Modes) -> Iterator[Pick]:
    """The choices of FSELECT, and where settings say so, the first solution elsewhere."""
    if modes.has(SELECTION, "ignore"):
        stated = ()
    yield from stated
    if modes.has(AMBIGUOUS, "first"):
        told = {each.element for each in stated}
        yield from (Pick(number, 1, "") for number in range(1, count + 1) if number not in told)


def _on_circle_of(element: FkElement, before: Block, block: Block, words: PlaneWords) -> FkElement:
    """An arc that touches one that runs the same way, where both are on one circle: by the centres that they state, or
    by the radii."""
    if _is_same_circle(before, block, words):
        return replace(element, goes_round=True)
    radii = [word.number for word in (before.find("R"), block.find("R")) if word is not None]
    is_one = len(radii) == 2 and radii[0] == radii[1] is not None  # noqa: PLR2004 - of both
    return replace(element, has_radius_of_before=is_one)


def _is_same_circle(before: Block, block: Block, words: PlaneWords) -> bool:
    """Whether two arcs have the same stated centre."""
    pairs = [tuple(map(each.find, words.each("CC{}"))) for each in (before, block)]
    places = [tuple(word.number if word else None for word in pair) for pair in pairs]
    return None not in places[0] and places[0] == places[1]


def _conventions(is_picked: bool, modes: Modes) -> Iterator[Convention]:
    """The settings on which the reading rests."""
    if is_picked:
        yield modes.convention(SELECTION)
    if modes.has(AMBIGUOUS, "first"):
        yield modes.convention(AMBIGUOUS)


def _is_placed(own: Set[str], words: PlaneWords) -> bool:
    """Whether words state where an element ends: both coordinates, or one on a circle of which all is stated."""
    coordinates = [not own.isdisjoint((axis, f"I{axis}")) for axis in words.axes]
    return all(coordinates) or (any(coordinates) and own >= {*words.each("CC{}"), "R"})


_CONTINUES = re.compile(r"~[ \t]*(?:;.*)?$")


@cache
def _no_facts(words: PlaneWords) -> frozenset[str]:
    """Words that state no equation, or not always: they say which one it is."""
    return frozenset({TANGENCY, "DR", "CLSD+", "FSELECT", *words.across, *words.referring[1:]})


def _own_words(member: ChainMember, builder: ContourBuilder) -> dict[str, Word]:
    """The words about an element by their names, each once."""
    blocks = {block.line: block for block in (member.block, *(corner for _, corner in member.corners))}
    own = builder.gather(
        (_name_of(word), word)
        for block in blocks.values()
        for word in block.words
        if word.address not in _BESIDE_ANY and word.address in builder.modes.lexicon.addresses
    )
    if member.picked is not None:
        own["FSELECT"] = member.picked
    if member.function in TANGENT:
        # What the function states is a word like others.
        function = next(word for word in member.block.words if word.address == "G")
        own[TANGENCY] = replace(function, address=member.function, number=Decimal(0))
    return own


def _name_of(word: Word) -> str:
    """The name of a word: its address, CLSD with its sign."""
    if word.address != "CLSD":
        return word.address
    return "CLSD-" if word.text.strip().endswith("-") else "CLSD+"


def _foreign(block: Block, chain: ChainBlocks) -> Iterator[Word]:
    """The words of a block that have no meaning in it."""
    function, lexicon = function_of(block), chain.modes.lexicon
    allowed = _allowed(chain.words).get(function, frozenset()) | _BESIDE_ANY
    is_plain = function in MOVES and function not in FREE
    return (
        word
        for word in block.words
        if word.address not in allowed and not (is_plain and lexicon.is_beside(word.address))
    )


def _labels(chain: ChainBlocks) -> tuple[str, ...]:
    """The labels of elements: the numbers of their blocks, or where some lack them or share them, 1, 2, 3."""
    words = [member.block.find("N") for member in chain.members]
    labels = [f"{word.number:f}" for word in words if word is not None and word.number is not None]
    if len(set(labels)) == len(chain.members):
        return tuple(labels)
    return tuple(str(number) for number in range(1, len(chain.members) + 1))


def _referred(chain: ChainBlocks, number: int) -> Iterator[tuple[str, int | str]]:
    """The words of a block that refer to another one, each with the number of its element, or with what is wrong."""
    place, member = number - 1, chain.members[number - 1]
    for name in chain.words.referring:
        word = member.own.get(name)
        if word is None or name not in _allowed(chain.words)[member.function]:
            continue
        other = chain.numbers.get(word.number) if word.number is not None else None
        # From the element right before, IAN counts anyway, whatever that is.
        refers_to_line = name in REFERRING_TO_LINES and not (name == "RAN" and other == place)
        if other == TWICE:
            yield name, TWO_BLOCKS
        elif other is None or other > place or (name in ("PAR", *REFERRING_TO_LINES) and not other):
            yield name, NO_BLOCK
        elif refers_to_line and chain.members[other - 1].function not in STRAIGHT:
            yield name, NO_LINE
        else:
            yield name, other


def _has_free(members: Sequence[ChainMember]) -> bool:
    return any(each.function in FREE for each in members)


def _element(chain: ChainBlocks, number: int, before: Sequence[FkElement]) -> FkElement:
    """The element of a number, behind those before it."""
    member = chain.members[number - 1]
    own, is_line = member.own, member.function in STRAIGHT
    known = {name: other for name, other in _referred(chain, number) if isinstance(other, int)}
    stated = [name in own and own[name].number is not None for name in ("AN", "CCA")]
    element = FkElement(
        member.function,
        None if is_line else Turn.CW if (sign_of(member.block, "DR") or member.sense) < 0 else Turn.CCW,
        member.pole,
        counted=tuple((f"I{name}", known[f"R{name}"]) for name in chain.words.referred if f"R{name}" in known),
        parallel=known.get("PAR", 0),
        touching=frozenset(name for name in ("D", "DP") if name in own and own[name].number == 0),
        is_entered=stated[0],
        is_ended=stated[1] and not is_line,
        is_placed=member.function not in FREE or _is_placed(own.keys(), chain.words),
        closes=chain.opening if "CLSD-" in own and chain.opening < number else 0,
    )
    if before and member.function == "FCT" and element.turn is before[-1].turn:
        return _on_circle_of(element, chain.members[number - 2].block, member.block, chain.words)
    return element


def _doubts(member: ChainMember) -> Iterator[tuple[str, str]]:
    """Poles, or another tool axis, that a block needs and on which ways that meet before it do not agree; and why."""
    needed: dict[str, tuple[str, ...]] = {f"a {TOOL_AXIS}": (TOOL_AXIS,)}
    if member.own.keys() & POLAR and not member.pole and member.function in FREE:
        needed[POLE] = tuple(f"{POLE} {axis}" for axis in member.here.plane.axes)
    if member.function in OF_CENTER and member.center_at is None:
        needed[CENTER] = tuple(f"{CENTER} {axis}" for axis in member.here.plane.axes)
    for told, names in needed.items():
        whys = [member.here.doubts[name] for name in names if name in member.here.doubts]
        yield from ((told, why) for why in whys[:1])


OF_CENTER = (*ABOUT_CENTER, "LP", "CTP")
"""Functions that count from CC."""


def _lacking(chain: ChainBlocks, number: int, elements: Sequence[FkElement]) -> Iterator[str]:
    """The circumstances of the last of the elements: what it lacks, and what is wrong with it."""
    member, element, before = chain.members[number - 1], elements[-1], chain.members[: number - 1]
    own, tool = member.own, member.here.memory.get(TOOL_AXIS)
    yield from (wrong + name for name, wrong in _referred(chain, number) if isinstance(wrong, str))
    is_bent = member.function in TANGENT[2:]
    is_doubtful = any(_doubts(member))
    is_turned = number > 1 and member.function == "FCT" and element.turn is not elements[-2].turn
    holds = {
        NO_SENSE: not element.is_line and not is_bent and not sign_of(member.block, "DR"),
        NO_POLE: own.keys() & POLAR and not member.pole and not is_doubtful,
        NO_BEFORE: number == 1,
        NO_CENTER: member.function in OF_CENTER and member.center_at is None and not is_doubtful,
        FULL: member.is_full,
        NO_RADIUS: member.function == "CR" and "R" not in own,
        CLOSES_NOTHING: "CLSD-" in own and not 0 < chain.opening < number,
        PARAMETER: any(_is_parameter(word, member.block) for word in own.values()),
        CONTINUED: _CONTINUES.search(member.block.text),
        NEVER_CLOSED: number == chain.opening and not chain.is_closed,
        TOOL: tool is not None,
        # To which side CT turns is not known before what is still to be found.
        NO_TURN: is_bent and not member.sense and _has_free(before),
        TURNS_BACK: is_turned and _is_same_circle(before[-1].block, member.block, chain.words),
    }
    yield from (name for name, is_so in holds.items() if is_so)


def _is_parameter(word: Word, block: Block) -> bool:
    """Whether the number of a word is that of a Q parameter, or such a parameter whose value is not known."""
    span = block.typed_span(word.span)
    is_open = word.number is None and not word.is_asked
    return is_open or any(each.is_within(span) for each in block.substituted)


def _givens(chain: ChainBlocks, elements: Sequence[FkElement], builder: ContourBuilder) -> dict[str, Given]:
    """The values of the words of the last element's block, with those that its function supplies."""
    number, element = len(elements), elements[-1]
    member, before = chain.members[number - 1], elements[-2] if number > 1 else None
    own, function = member.own, member.function
    stated = builder.values(own, member.here)
    if function in TANGENT:
        # Only two lines in a row state an angle with it: none.
        unit = Unit.DEGREE if element.is_line and before is not None and before.is_line else Unit.SIGN
        stated[TANGENCY] = Given(TANGENCY, Decimal(0), unit, own[TANGENCY])
        ended = builder.givens.get(f"{number - 1}:CCA")
        if ended is not None and element.is_line and before is not None:
            # The line goes on where CCA of the arc before ends, a quarter of a turn from that direction.
            quarter = 90 * before.turn.sign if before.turn else 0
            tangent = replace(own[TANGENCY], has_point=True)
            stated[ALONG] = replace(ended, value=ended.value + quarter, word=tangent, follows=ended.name)
    if function not in FREE:
        stated |= _supplied(member, stated, chain.words)
    return stated


def _supplied(member: ChainMember, stated: Mapping[str, Given], words: PlaneWords) -> Iterator[tuple[str, Given]]:
    """The givens that a conventional move states by its function: what it does not program stays as it is."""
    if "R" in stated:
        # The sign of CR chooses the arc.
        yield "R", replace(stated["R"], value=abs(stated["R"].value))
    for name, unit in _staying(member.function, words):
        if name not in member.own and f"I{name}" not in member.own:
            yield f"I{name}", Given("", Decimal(0), unit, None)
    if member.function in ABOUT_CENTER and member.center_at is not None:
        yield from (
            (f"CC{axis}", Given("", value, Unit.MM, None))
            for axis, value in zip(words.axes, member.center_at, strict=True)
        )


def _staying(function: str, words: PlaneWords) -> Sequence[tuple[str, Unit]]:
    """The words of conventional moves that mean no step where they are missing."""
    if function == "LP":
        return ("PR", Unit.MM), ("PA", Unit.DEGREE)
    return [(axis, Unit.MM) for axis in words.axes] if function in ("L", "C", "CR", "CT") else ()


def _corner_circumstances(members: Sequence[ChainMember], number: int) -> Iterator[str]:
    """The circumstances of an element because of the corners at its ends."""
    pair = members[number - 1 : number + 1]
    has_corner = bool(pair[0].corners)
    holds = {
        FIRST_CORNER: has_corner and pair[0].corners[0][1] is pair[0].block and pair[0].function not in FREE,
        LAST_CORNER: has_corner and len(pair) == 1,
        CORNERED: has_corner or (number > 1 and bool(members[number - 2].corners)),
        AT_ARC: has_corner and any(each.function not in STRAIGHT for each in pair),
    }
    return (name for name, is_so in holds.items() if is_so)


def _may_state(member: ChainMember, own: Set[str], words: PlaneWords) -> Iterator[str]:
    """The words that a free element may have: those that stand alone, and those that the others need."""
    if member.function in FREE:
        is_line = member.function in STRAIGHT
        names = words.of_lines if is_line else (*words.of_arcs, "DR")
        yield from (word for word in names if member.pole or word not in POLAR)
        # The words of a point, all or none.
        for together in (*(words.each(f"{point}{{}}") for point in POINTS), (*words.beside, "D")):
            yield from together if not own.isdisjoint(together) else ()


def _makes(chain: ChainBlocks, labels: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """The names of what each block of a chain makes."""
    by_block: dict[int, tuple[str, ...]] = {}
    for label, member in zip(labels, chain.members, strict=True):
        by_block[member.index] = (f"{'line' if member.function in STRAIGHT else 'arc'} {label}",)
        for place, _ in member.corners:
            by_block[place] = (*by_block.get(place, ()), f"corner {label}")
    return (by_block.get(index, ()) for index in range(len(chain.blocks)))
