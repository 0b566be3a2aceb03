"""The finder of chains of blocks that are solved together, and of what they state.

A chain goes through free elements in a row, and through conventional moves that a corner or a tangency joins.
"""

import re
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import replace as replace_fields
from decimal import Decimal
from functools import cached_property
from itertools import count

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls.heidenhain.elements import (
    ALONG,
    BESIDE,
    FULL,
    OF_ARCS,
    OF_LINES,
    POINTS,
    POLAR,
    TANGENCY,
    FkElement,
    compose,
)
from contoursolve.controls.heidenhain.follow import (
    CENTER,
    DEPARTED,
    JOINT,
    PLANE,
    POLE,
    TOOL_AXIS,
    begins_chain,
    full_circles,
    keep_joint,
    pole_of,
    says_nothing,
    senses,
    set_pole,
)
from contoursolve.controls.heidenhain.lexicon import (
    ABOUT_CENTER,
    AMBIGUOUS,
    CHAMFER,
    FREE,
    LEXICON,
    MOVES,
    REFERRED,
    REFERRING,
    REFERRING_TO_LINES,
    ROUNDING,
    SELECTION,
    STRAIGHT,
    TANGENT,
    function_of,
)
from contoursolve.gcode import Block, Word
from contoursolve.geometry import Choice, Given, Pick, Profile, Side, Turn, Unit, assemble
from contoursolve.reading import ContourBuilder, Convention, Modes, ParsedContour, State, apply_modes, read
from contoursolve.solving import analyse, place_cuts

NO_SENSE, NO_POLE, NO_BEFORE = "@no-sense", "@no-pole", "@no-before"
"""An arc without DR; polar data without a pole; a tangent element behind none."""
NO_BLOCK, TWO_BLOCKS, NO_LINE = "@no-block ", "@two-blocks ", "@no-line "
"""Before the name of a word that refers to a block: that block is not there; there are two; it is an arc, where the
word refers to a line."""
NO_CENTER, NO_RADIUS = "@no-center", "@no-radius"
"""C without a CC in force; CR without R."""
NO_TURN = "@no-turn"
"""CT behind what is still to be found: to which side it turns is not known before."""
TURNS_BACK, CONTINUED, NEVER_CLOSED = "@turns-back", "@continued", "@never-closed"
"""An arc that goes back on the circle before it; a block that goes on in the next line; CLSD+ without CLSD-."""
CUT, TOOL, CLOSES_NOTHING = "@cut", "@tool-axis", "@closes-nothing"
"""A conventional move behind a chain that is still open; a tool axis that is not Z; CLSD- without CLSD+, or alone."""

FIRST_CORNER, LAST_CORNER, CORNERED, AT_ARC = "@first-corner", "@last-corner", "@cornered", "@at-arc"
"""A corner behind no element; an element with a corner, behind which none follows; an element beside a corner; an
element with a corner, of which that or the next one is an arc."""

APART = "@apart"
"""A corner beside an approach, a departure or a call."""

_CORNERS = {"RND": ROUNDING, "CHF": CHAMFER}
_BESIDE_ANY = frozenset({"N", "G", "F", "M", "S"})
_POINTS = frozenset(f"{point}{axis}" for point in POINTS for axis in PLANE)
_SHARED = frozenset({f"{BESIDE}X", f"{BESIDE}Y", "D", "CLSD", "Z", "IZ", *REFERRING[1:]})
_LINE_WORDS = frozenset({*OF_LINES, "P1X", "P1Y", "P2X", "P2Y", "PAR", "DP"}) | _SHARED
_ARC_WORDS = frozenset({*OF_ARCS, "DR"}) | _POINTS | _SHARED
_ENDS = frozenset({"X", "Y", "Z", "IX", "IY", "IZ"})
_ALLOWED: Mapping[str, frozenset[str]] = {
    **{name: (_LINE_WORDS if name in STRAIGHT else _ARC_WORDS) for name in FREE},
    "L": _ENDS,
    "LP": frozenset({"PR", "PA", "IPR", "IPA", "Z", "IZ"}),
    "C": _ENDS | {"DR"},
    "CP": frozenset({"PA", "IPA", "DR", "Z", "IZ"}),
    "CR": _ENDS | {"DR", "R"},
    "CT": _ENDS,
    "CTP": frozenset({"PR", "PA", "IPR", "IPA", "Z", "IZ"}),
    "FPOL": frozenset({"X", "Y"}),
    "CC": _ENDS,
    "RND": frozenset({ROUNDING}),
    "CHF": frozenset({CHAMFER}),
    "FSELECT": frozenset({"FSELECT"}),
}
"""The words that a function may have."""


Pole = tuple[int, Block] | tuple[Decimal, Decimal]
"""A block with its place in the chain, or coordinates, mm, that were in force before."""


class _Member(Struct):
    """One block of a chain on its way: its function, the states before and behind its modes, its place among the
    blocks, what stands behind it, and the poles that are in force for it."""

    block: Block
    function: str
    here: State
    index: int
    pole: str
    center_at: tuple[Decimal, Decimal] | None
    """The place of CC, mm, for a conventional arc about it."""
    is_full: bool = False
    """Whether it is a full circle, as far as that is known before anything is solved."""
    corners: tuple[tuple[int, Block], ...] = ()
    """The blocks of corners behind it, with their places in the chain: more than one is refused."""
    picked: Word | None = None
    own: Mapping[str, Word] = {}
    """Its words by name, once they are gathered."""
    sense: int = 0
    """Of a conventional arc that has no DR, where it is known: 1 is counter-clockwise."""


class _Chain:
    """The blocks of a chain as they are read."""

    def __init__(self, state: State, modes: Modes) -> None:
        self.start = self.state = state
        self.modes = modes
        self.blocks: list[Block] = []
        self.members: list[_Member] = []
        self.poles: dict[str, Pole] = {}
        """The poles by name: a block with its place, or coordinates that were in force before the chain."""
        self.is_cut = False

    @cached_property
    def numbers(self) -> Mapping[Decimal, int]:
        """The numbers of the elements by those of their blocks."""
        return _numbers(self)

    @cached_property
    def opening(self) -> int:
        """The number of the first element with CLSD+; 0 if there is none."""
        return next((n for n, each in enumerate(self.members, 1) if _sign_of(each.block, "CLSD") > 0), 0)

    @cached_property
    def is_closed(self) -> bool:
        """Whether an element has CLSD-."""
        return any(_sign_of(each.block, "CLSD") < 0 for each in self.members)

    def read(self, blocks: Sequence[Block], index: int) -> None:
        """Read the chain that begins at a block."""
        self._keep(POLE, "pole 0")
        corner = index
        for place in count(index):
            try:
                block = blocks[place]
            except IndexError:
                break
            if block.macro is None and not block.words and not block.faults:
                continue
            corner = place if self.members and not self.members[-1].corners else corner
            if not self._take(block):
                break
        if corner > index and self.members[-1].corners and _leads_elsewhere(blocks, corner):
            # That corner stands alone.
            self.members[-1].corners = ()
        while self.blocks and self.blocks[-1] is not self._last_block():
            self.blocks.pop()
        self.poles = {name: pole for name, pole in self.poles.items() if not _is_behind(pole, self.blocks)}

    def _last_block(self) -> Block:
        """The last block that belongs to an element."""
        last = self.members[-1]
        own = (last.block, *(block for _, block in last.corners))
        return next(block for block in reversed(self.blocks) if block in own or block.find("FSELECT"))

    def _keep(self, function: str, name: str) -> None:
        values = pole_of(self.state, function)
        if values is not None:
            self.poles[name] = values

    def _take(self, block: Block) -> bool:
        """Whether a block belongs to the chain; then it is taken."""
        function, last = function_of(block), self.members[-1] if self.members else None
        if _stands_between(block, function):
            if function == "FSELECT" and last is not None:
                last.picked = block.find("FSELECT")
            elif function == POLE:
                self.poles[f"pole {len(self.poles) + 1}"] = len(self.blocks), block
            elif function == CENTER:
                self.state = set_pole(self.state, block, CENTER, self.modes)
            return self._pass(block)
        if last is None:
            self._add(block, "L" if function in _CORNERS else function)
            if function in _CORNERS:
                # The corner of no element: that of a line of no length, which is refused.
                self.members[0].corners = ((len(self.blocks) - 1, block),)
            return function not in _CORNERS
        if function in _CORNERS:
            last.corners = (*last.corners, (len(self.blocks), block))
            return self._pass(block)
        if function in FREE or function in TANGENT or (last.corners and function in MOVES):
            self._add(block, function)
            return True
        self.is_cut = block.macro is None and not function.startswith(("APPR", "DEP"))
        return False

    def _pass(self, block: Block) -> bool:
        self.state = apply_modes(self.state, block, self.modes)
        self.blocks.append(block)
        return True

    def _add(self, block: Block, function: str) -> None:
        pole = next((name for name in reversed(self.poles) if name.startswith("pole")), "")
        center = pole_of(self.state, CENTER)
        if function not in FREE:
            pole = f"centre {len(self.members) + 1}" if center and function in ("CP", "LP", "CTP") else ""
            if center and pole:
                self.poles[pole] = center
        index = len(self.blocks)
        self._pass(block)
        self.state = keep_joint(self.state, block, function)
        self.members.append(_Member(block, function, self.state, index, pole, center))


def _stands_between(block: Block, function: str) -> bool:
    """Whether a block may stand between two elements, and is no corner."""
    if block.macro is not None:
        return says_nothing(block)
    # A move of the tool axis alone may, too.
    is_beside = function in MOVES and function not in FREE and not _is_in_plane(block)
    return is_beside or function in ("", "STOP", "FSELECT", POLE, CENTER)


def _leads_elsewhere(blocks: Sequence[Block], index: int) -> bool:
    """Whether an approach or a departure stands behind a corner, or what stands there is run by another call."""
    for place in count(index):
        try:
            block = blocks[place]
        except IndexError:
            return True
        if any(word.address == "M" and word.number in _ENDS_PROGRAM for word in block.words):
            return False
        function, is_empty = function_of(block), block.macro is None and not block.words and not block.faults
        if not is_empty and function not in _CORNERS and not _stands_between(block, function):
            is_end_of_call = block.macro is not None and bool(block.callers)
            return is_end_of_call or function.startswith(("APPR", "DEP"))
    return False


_ENDS_PROGRAM = (2, 30)


def _follows_elsewhere(block: Block, state: State) -> bool:
    """Whether a corner that follows no element may join an approach, or one that another call has run."""
    lost = (each for each in (state.axes[axis] for axis in PLANE) if each.value is None and each.span is not None)
    return bool(block.callers) or JOINT in state.memory or any(each.reason != DEPARTED for each in lost)


def _is_behind(pole: Pole, blocks: Sequence[Block]) -> bool:
    """Whether the block of a pole stands behind the last one of a chain."""
    return isinstance(pole[1], Block) and pole[1] not in blocks


def _is_in_plane(block: Block) -> bool:
    return any(word.address in _MOVING for word in block.words)


_MOVING = frozenset({"X", "Y", "IX", "IY", "PR", "PA", "IPR", "IPA", "DR", "R"})


def find(blocks: Sequence[Block], index: int, state: State, modes: Modes) -> ParsedContour | None:
    """The chain that begins at a block, if any: with a free element, a move with a corner, one that the next element
    touches, or a corner behind no element."""
    block = blocks[index]
    if block.macro is not None or not block.words:
        return None
    function, is_known = function_of(block), state.start().is_known
    if function in FREE:
        # A chain may begin with where it begins.
        is_begun = is_known or not begins_chain(function, block)
    elif function in MOVES:
        # What touches a move from an unknown place cannot be found.
        joins = (*_CORNERS, *TANGENT) if is_known else tuple(_CORNERS)
        is_begun = _is_in_plane(block) and _next_function(blocks, index) in joins
    elif function == POLE:
        # A pole is read where it stands; one with a coordinate missing is none for the chain behind it.
        is_half = (block.find("X") is None) is not (block.find("Y") is None)
        is_begun = is_half and _next_function(blocks, index) in MOVES
    else:
        is_begun = function in _CORNERS
    if not is_begun:
        return None
    chain = _Chain(state, modes)
    chain.read(blocks, index)
    if len(chain.members) == 1 and function in MOVES and function not in FREE and not chain.members[0].corners:
        return None
    claim = _claim(chain, state, modes)
    if function in _CORNERS and (_follows_elsewhere(block, state) or _leads_elsewhere(blocks, index)):
        outline = replace_fields(claim.form.outline, path=())
        form = replace_fields(claim.form, outline=outline, is_contour=False, needs_values=False)
        circumstances = claim.circumstances - {f"1:{FIRST_CORNER}", f"1:{LAST_CORNER}"} | {f"1:{APART}"}
        return replace_fields(claim, form=form, circumstances=circumstances)
    return claim


def _next_function(blocks: Sequence[Block], index: int) -> str:
    """The function of the next element or corner behind a block; empty if something else comes first."""
    for place in count(index + 1):
        try:
            block = blocks[place]
        except IndexError:
            return ""
        function = function_of(block)
        says_something = block.words or block.faults or block.macro is not None
        if says_something and not _stands_between(block, function):
            return function if block.macro is None else ""
    return ""


def _claim(chain: _Chain, before: State, modes: Modes) -> ParsedContour:
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
        lasting = [name for name in member.own if name in _NO_FACTS or name in elements[-1].touching]
        builder.state(f"{number}:", member.own, _givens(chain, elements, builder), circumstances, lasting=lasting)
        _name_words(builder, number, member)
    for name, pole in chain.poles.items():
        _state_pole(builder, f"{name}:", pole, before)
    picks = [
        Pick(number, int(member.picked.number), f"{number}:FSELECT")
        for number, member in enumerate(members, 1)
        if member.picked is not None and member.picked.number is not None
    ]
    claim = replace_fields(
        builder.build(compose(tuple(elements), labels), before, chain.state),
        unknown=tuple(word for block in chain.blocks for word in _foreign(block)),
        choices=tuple(_choices(members, elements, labels)),
        makes=tuple(_makes(chain, labels)),
        picks=tuple(_picks(picks, len(members), modes)),
        conventions=tuple(_conventions(bool(picks), modes)),
    )
    if chain.is_cut and _has_free(members) and _is_open(read(claim, frozenset())):
        return replace_fields(claim, circumstances=claim.circumstances | {f"{len(members)}:{CUT}"})
    return claim


def _bend(chain: _Chain, before: State, modes: Modes) -> None:
    """Find what is known of conventional arcs before anything is solved: their sense, and which are full circles."""
    functions = {member.function for member in chain.members}
    known = dict(senses(chain.blocks, before, modes)) if functions & {*TANGENT[2:]} else {}
    circles = {*full_circles(chain.blocks, before, modes)} if functions & {*ABOUT_CENTER} else set[int]()
    for member in chain.members:
        member.sense, member.is_full = known.get(member.index, 0), member.index in circles


def _choices(members: Sequence[_Member], elements: Sequence[FkElement], labels: Sequence[str]) -> Iterator[Choice]:
    """The centres that the signs of R in CR choose."""
    for number, (member, element, label) in enumerate(zip(members, elements, labels, strict=True), 1):
        radius = member.own.get("R") if member.function == "CR" else None
        if radius is not None and radius.number is not None:
            is_left = (radius.number > 0) is (element.turn is not Turn.CW)
            yield Choice(f"C{label}", Side.LEFT if is_left else Side.RIGHT, f"{number}:R")


def _name_words(builder: ContourBuilder, number: int, member: _Member) -> None:
    """Add the names of all that the blocks of an element may state."""
    prefix, own = f"{number}:", member.own
    builder.name(prefix, member.index, ((name, name) for name in _may_state(member, own.keys())))
    builder.name(prefix, member.index, ((name, word.address) for name, word in own.items()))
    if number == 1 and member.function in FREE and "CLSD+" not in own:
        builder.name(prefix, member.index, [("CLSD+", "CLSD")])
    for place, _ in member.corners[:1]:
        builder.name(prefix, place, ((name, name) for name in (ROUNDING, CHAMFER)))


def _state_pole(builder: ContourBuilder, prefix: str, pole: Pole, before: State) -> None:
    """Add what a pole states: its block, or the coordinates that were in force before the chain."""
    place, block = pole
    if isinstance(block, Block):
        words = {word.address: word for word in block.words if word.address in PLANE}
        builder.state(prefix, words, builder.values(words, before))
        builder.name(prefix, int(place), ((axis, axis) for axis in PLANE))
    else:
        values = zip(PLANE, (Decimal(place), block), strict=True)
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


def _on_circle_of(element: FkElement, before: Block, block: Block) -> FkElement:
    """An arc that touches one that runs the same way, where both are on one circle: by the centres that they state, or
    by the radii."""
    if _is_same_circle(before, block):
        return replace(element, goes_round=True)
    radii = [word.number for word in (before.find("R"), block.find("R")) if word is not None]
    is_one = len(radii) == 2 and radii[0] == radii[1] is not None  # noqa: PLR2004 - of both
    return replace(element, has_radius_of_before=is_one)


def _is_same_circle(before: Block, block: Block) -> bool:
    """Whether two arcs have the same stated centre."""
    pairs = [(each.find("CCX"), each.find("CCY")) for each in (before, block)]
    places = [tuple(word.number if word else None for word in pair) for pair in pairs]
    return None not in places[0] and places[0] == places[1]


def _conventions(is_picked: bool, modes: Modes) -> Iterator[Convention]:
    """The settings on which the reading rests."""
    if is_picked:
        yield modes.convention(SELECTION)
    if modes.has(AMBIGUOUS, "first"):
        yield modes.convention(AMBIGUOUS)


def _is_placed(own: Set[str]) -> bool:
    """Whether words state where an element ends: both coordinates, or one on a circle of which all is stated."""
    coordinates = [not own.isdisjoint((axis, f"I{axis}")) for axis in PLANE]
    return all(coordinates) or (any(coordinates) and own >= {"CCX", "CCY", "R"})


_CONTINUES = re.compile(r"~[ \t]*(?:;.*)?$")
_NO_FACTS = frozenset({TANGENCY, "DR", "CLSD+", "FSELECT", "Z", "IZ", *REFERRING[1:]})
"""Words that state no equation, or not always: they say which one it is."""


def _sign_of(block: Block, address: str) -> int:
    """The sign of a word; 0 if the block has none."""
    word = block.find(address)
    return 0 if word is None or not word.number else 1 if word.number > 0 else -1


def _own_words(member: _Member, builder: ContourBuilder) -> dict[str, Word]:
    """The words about an element by their names, each once."""
    blocks = {block.line: block for block in (member.block, *(corner for _, corner in member.corners))}
    own = builder.gather(
        (_name_of(word), word)
        for block in blocks.values()
        for word in block.words
        if word.address not in _BESIDE_ANY and word.address in LEXICON.addresses
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


def _foreign(block: Block) -> Iterator[Word]:
    """The words of a block that have no meaning in it."""
    function = function_of(block)
    allowed, is_plain = _ALLOWED.get(function, frozenset()) | _BESIDE_ANY, function in MOVES and function not in FREE
    return (
        word
        for word in block.words
        if word.address not in allowed and not (is_plain and LEXICON.is_beside(word.address))
    )


def _labels(chain: _Chain) -> tuple[str, ...]:
    """The labels of elements: the numbers of their blocks, or where some lack them or share them, 1, 2, 3."""
    words = [member.block.find("N") for member in chain.members]
    labels = [f"{word.number:f}" for word in words if word is not None and word.number is not None]
    if len(set(labels)) == len(chain.members):
        return tuple(labels)
    return tuple(str(number) for number in range(1, len(chain.members) + 1))


def _numbers(chain: _Chain) -> dict[Decimal, int]:
    """The numbers of the elements by those of their blocks; 0 is where the chain begins. A file without numbers counts
    its lines from 0."""
    stated = [member.block.find("N") for member in chain.members]
    found: dict[Decimal, int] = {}
    is_numbered = any(stated)
    for number, (word, member) in enumerate(zip(stated, chain.members, strict=True), 1):
        own = word.number if word is not None else None if is_numbered else Decimal(member.block.line - 1)
        if own is not None:
            found[own] = number if own not in found else _TWICE
    first, where = chain.members[0].block, [chain.start.axes[axis].span for axis in PLANE]
    if found and where[0] is not None and where[0] == where[1]:
        found.setdefault(next(iter(found)) - (first.line - where[0].line), 0)
    return found


_TWICE = -1
"""A number that two blocks have tells of neither."""


def _referred(chain: _Chain, number: int) -> Iterator[tuple[str, int | str]]:
    """The words of a block that refer to another one, each with the number of its element, or with what is wrong."""
    place, member = number - 1, chain.members[number - 1]
    for name in REFERRING:
        word = member.own.get(name)
        if word is None or name not in _ALLOWED[member.function]:
            continue
        other = chain.numbers.get(word.number) if word.number is not None else None
        # From the element right before, IAN counts anyway, whatever that is.
        refers_to_line = name in REFERRING_TO_LINES and not (name == "RAN" and other == place)
        if other == _TWICE:
            yield name, TWO_BLOCKS
        elif other is None or other > place or (name in REFERRING_TO_LINES and not other):
            yield name, NO_BLOCK
        elif refers_to_line and chain.members[other - 1].function not in STRAIGHT:
            yield name, NO_LINE
        else:
            yield name, other


def _has_free(members: Sequence[_Member]) -> bool:
    return any(each.function in FREE for each in members)


def _element(chain: _Chain, number: int, before: Sequence[FkElement]) -> FkElement:
    """The element of a number, behind those before it."""
    member = chain.members[number - 1]
    own, is_line = member.own, member.function in STRAIGHT
    known = {name: other for name, other in _referred(chain, number) if isinstance(other, int)}
    stated = [name in own and own[name].number is not None for name in ("AN", "CCA")]
    element = FkElement(
        member.function,
        None if is_line else Turn.CW if (_sign_of(member.block, "DR") or member.sense) < 0 else Turn.CCW,
        member.pole,
        counted=tuple((f"I{name}", known[f"R{name}"]) for name in REFERRED if f"R{name}" in known),
        parallel=known.get("PAR", 0),
        touching=frozenset(name for name in ("D", "DP") if name in own and own[name].number == 0),
        is_entered=stated[0],
        is_ended=stated[1] and not is_line,
        is_placed=member.function not in FREE or _is_placed(own.keys()),
        closes=chain.opening if "CLSD-" in own and chain.opening < number else 0,
    )
    if before and member.function == "FCT" and element.turn is before[-1].turn:
        return _on_circle_of(element, chain.members[number - 2].block, member.block)
    return element


def _lacking(chain: _Chain, number: int, elements: Sequence[FkElement]) -> Iterator[str]:
    """The circumstances of the last of the elements: what it lacks, and what is wrong with it."""
    member, element, before = chain.members[number - 1], elements[-1], chain.members[: number - 1]
    own, tool = member.own, member.here.memory.get(TOOL_AXIS)
    yield from (wrong + name for name, wrong in _referred(chain, number) if isinstance(wrong, str))
    is_touching, is_bent = member.function in TANGENT, member.function in TANGENT[2:]
    is_turned = number > 1 and member.function == "FCT" and element.turn is not elements[-2].turn
    holds = {
        NO_SENSE: not element.is_line and not is_bent and not _sign_of(member.block, "DR"),
        NO_POLE: own.keys() & POLAR and not member.pole,
        NO_BEFORE: number == 1 and (is_touching or ("IAN" in own and "RAN" not in own)),
        NO_CENTER: member.function in (*ABOUT_CENTER, "LP", "CTP") and member.center_at is None,
        FULL: member.is_full,
        NO_RADIUS: member.function == "CR" and "R" not in own,
        CLOSES_NOTHING: "CLSD-" in own and not 0 < chain.opening < number,
        CONTINUED: _CONTINUES.search(member.block.text),
        NEVER_CLOSED: number == chain.opening and not chain.is_closed,
        TOOL: tool is not None and tool.text != "Z",
        # To which side CT turns is not known before what is still to be found.
        NO_TURN: is_bent and not member.sense and _has_free(before),
        TURNS_BACK: is_turned and _is_same_circle(before[-1].block, member.block),
    }
    yield from (name for name, is_so in holds.items() if is_so)


def _givens(chain: _Chain, elements: Sequence[FkElement], builder: ContourBuilder) -> dict[str, Given]:
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
        stated |= _supplied(member, stated)
    return stated


def _supplied(member: _Member, stated: Mapping[str, Given]) -> Iterator[tuple[str, Given]]:
    """The givens that a conventional move states by its function: what it does not program stays as it is."""
    if "R" in stated:
        # The sign of CR chooses the arc.
        yield "R", replace(stated["R"], value=abs(stated["R"].value))
    for name, unit in _STAYING.get(member.function, {}).items():
        if name not in member.own and f"I{name}" not in member.own:
            yield f"I{name}", Given("", Decimal(0), unit, None)
    if member.function in ABOUT_CENTER and member.center_at is not None:
        yield from (
            (f"CC{axis}", Given("", value, Unit.MM, None)) for axis, value in zip(PLANE, member.center_at, strict=True)
        )


_STAYING: Mapping[str, Mapping[str, Unit]] = {
    **dict.fromkeys(("L", "C", "CR", "CT"), dict.fromkeys(PLANE, Unit.MM)),
    "LP": {"PR": Unit.MM, "PA": Unit.DEGREE},
}
"""The words of conventional moves that mean no step where they are missing."""


def _corner_circumstances(members: Sequence[_Member], number: int) -> Iterator[str]:
    """The circumstances of an element because of the corners at its ends."""
    pair = members[number - 1 : number + 1]
    has_corner = bool(pair[0].corners)
    holds = {
        FIRST_CORNER: has_corner and pair[0].corners[0][1] is pair[0].block,
        LAST_CORNER: has_corner and len(pair) == 1,
        CORNERED: has_corner or (number > 1 and bool(members[number - 2].corners)),
        AT_ARC: has_corner and any(each.function not in STRAIGHT for each in pair),
    }
    return (name for name, is_so in holds.items() if is_so)


def _may_state(member: _Member, own: Set[str]) -> Iterator[str]:
    """The words that a free element may have: those that stand alone, and those that the others need."""
    if member.function in FREE:
        is_line = member.function in STRAIGHT
        words = OF_LINES if is_line else (*OF_ARCS, "DR")
        yield from (word for word in words if member.pole or word not in POLAR)
        for together in _TOGETHER:
            yield from together if not own.isdisjoint(together) else ()


_TOGETHER = (*((f"{point}X", f"{point}Y") for point in POINTS), (f"{BESIDE}X", f"{BESIDE}Y", "D"))
"""The words of a point, all or none."""


def _makes(chain: _Chain, labels: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """The names of what each block of a chain makes."""
    by_block: dict[int, tuple[str, ...]] = {}
    for label, member in zip(labels, chain.members, strict=True):
        by_block[member.index] = (f"{'line' if member.function in STRAIGHT else 'arc'} {label}",)
        for place, _ in member.corners:
            by_block[place] = (*by_block.get(place, ()), f"corner {label}")
    return (by_block.get(index, ()) for index in range(len(chain.blocks)))
