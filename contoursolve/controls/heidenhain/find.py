"""Which blocks make a chain that is solved together, and what they state.

A chain goes through free elements in a row, and through conventional moves that a corner or a tangency joins.
"""

import re
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import replace as replace_fields
from decimal import Decimal
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
    Element,
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
from contoursolve.reading import Convention, Modes, ParsedContour, State, apply_modes, read
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
    """Where CC is, mm, for a conventional arc about it."""
    is_full: bool = False
    """Whether it is a full circle, as far as that is known before anything is solved."""
    corners: tuple[tuple[int, Block], ...] = ()
    """The blocks of corners behind it, with their places in the chain: more than one is refused."""
    picked: Word | None = None
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
        form = replace_fields(claim.form, path=(), is_contour=False, needs_values=False)
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
    """What the blocks of a chain state."""
    members, numbers, labels = chain.members, _numbers(chain), _labels(chain)
    bends = any(member.function in TANGENT[2:] for member in members)
    tangents = dict(senses(chain.blocks, before, modes)) if bends else {}
    turns = any(member.function in ABOUT_CENTER for member in members)
    circles = frozenset(full_circles(chain.blocks, before, modes)) if turns else frozenset[int]()
    place = -1
    for member in members:
        # A line may run several times.
        place = next(at for at in range(place + 1, len(chain.blocks)) if chain.blocks[at].line == member.block.line)
        member.sense, member.is_full = tangents.get(place, 0), place in circles
    opening = next((n for n, each in enumerate(members, 1) if _sign_of(each.block, "CLSD") > 0), 0)
    is_closed = any(_sign_of(each.block, "CLSD") < 0 for each in members)
    elements: list[Element] = []
    words: dict[str, Word] = {}
    givens: dict[str, Given] = {}
    vocabulary: dict[str, tuple[str, int]] = {}
    circumstances: set[str] = set()
    repeated: list[Word] = []
    lasting: set[str] = set()
    picks: list[Pick] = []
    choices: list[Choice] = []
    for number, member in enumerate(members, 1):
        prefix = f"{number}:"
        own = _own_words(member, repeated)
        referred = dict(_referred(member, own, members, numbers))
        element, lacking = _element(member, own, number, referred, opening, is_closed=is_closed)
        lacking += [NO_TURN] * _turns_either_way(member, members[: number - 1])
        if number > 1 and member.function == "FCT":
            element = _on_circle_of(elements[-1], element, members[number - 2].block, member.block)
            is_turned = element.turn is not elements[-1].turn
            lacking += [TURNS_BACK] * (is_turned and _is_same_circle(members[number - 2].block, member.block))
        elements.append(element)
        words |= {prefix + name: word for name, word in own.items()}
        circumstances |= {prefix + each for each in (*lacking, *_corner_circumstances(members, number))}
        is_behind_line = number > 1 and elements[-2].is_line
        given = _givens(member, own, modes, is_behind_line=is_behind_line)
        ended = givens.get(f"{number - 1}:CCA")
        if ended is not None and element.is_line and member.function in TANGENT:
            # The line goes on where CCA of the arc before ends, a quarter of a turn from that direction.
            quarter = 90 * elements[-2].turn.sign if elements[-2].turn else 0
            tangent = replace(own[TANGENCY], has_point=True)
            given[ALONG] = replace(ended, value=ended.value + quarter, word=tangent, follows=ended.name)
        givens |= {prefix + name: replace(each, name=prefix + name) for name, each in given.items()}
        lasting |= {prefix + name for name in own if name in _NO_FACTS or name in element.touching}
        vocabulary |= {prefix + name: (name, member.index) for name in _may_state(member, own.keys())}
        vocabulary |= {prefix + name: (word.address, member.index) for name, word in own.items()}
        if number == 1 and member.function in FREE:
            vocabulary.setdefault(f"{prefix}CLSD+", ("CLSD", member.index))
        for place, _ in member.corners[:1]:
            vocabulary |= {prefix + name: (name, place) for name in (ROUNDING, CHAMFER)}
        if member.picked is not None and member.picked.number is not None:
            picks.append(Pick(number, int(member.picked.number), prefix + "FSELECT"))
        radius = own.get("R") if member.function == "CR" else None
        if radius is not None and radius.number is not None:
            is_left = (radius.number > 0) is (element.turn is not Turn.CW)
            choices.append(Choice(f"C{labels[number - 1]}", Side.LEFT if is_left else Side.RIGHT, prefix + "R"))
    for name, pole in chain.poles.items():
        stated = _pole_words(pole)
        words |= {f"{name}:{axis}": word for axis, word in stated.items()}
        known = {axis: modes.lexicon.given(axis, word, before.unit) for axis, word in stated.items()}
        if not isinstance(pole[1], Block):
            known = {axis: Given(axis, value, Unit.MM, None) for axis, value in zip(PLANE, pole, strict=True)}
        else:
            vocabulary |= {f"{name}:{axis}": (axis, pole[0]) for axis in PLANE}
        givens |= {f"{name}:{axis}": replace(each, name=f"{name}:{axis}") for axis, each in known.items() if each}
    claim = ParsedContour(
        form=compose(tuple(elements), labels),
        lexicon=modes.words(chain.state),
        blocks=tuple(chain.blocks),
        before=before,
        after=chain.state,
        words=words,
        givens=givens,
        vocabulary=vocabulary,
        unknown=tuple(word for block in chain.blocks for word in _foreign(block)),
        repeated=tuple(repeated),
        circumstances=frozenset(circumstances),
        choices=tuple(choices),
        makes=tuple(_makes(chain, labels)),
        lasting=frozenset(lasting),
        picks=tuple(_picks(picks, len(members), modes)),
        conventions=tuple(_conventions(bool(picks), modes)),
    )
    if chain.is_cut and _has_free(members) and _is_open(read(claim, frozenset())):
        return replace_fields(claim, circumstances=claim.circumstances | {f"{len(members)}:{CUT}"})
    return claim


def _is_open(profile: Profile) -> bool:
    """Whether something of a path is not determined."""
    free = analyse(assemble(profile)).free
    return bool(free) and not place_cuts(profile, free)[1]


def _picks(stated: Sequence[Pick], count: int, modes: Modes) -> Iterator[Pick]:
    """What FSELECT chooses, and where settings say so, the first solution elsewhere."""
    if modes.has(SELECTION, "ignore"):
        stated = ()
    yield from stated
    if modes.has(AMBIGUOUS, "first"):
        told = {each.element for each in stated}
        yield from (Pick(number, 1, "") for number in range(1, count + 1) if number not in told)


def _on_circle_of(other: Element, element: Element, before: Block, block: Block) -> Element:
    """An arc that touches the one before it, where both run one way on one circle: by the centres that they state, or
    by the radii."""
    if element.turn is not other.turn:
        return element
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


def _own_words(member: _Member, repeated: list[Word]) -> dict[str, Word]:
    """The words about an element by their names; those that are there twice are added to `repeated`."""
    own: dict[str, Word] = {}
    blocks = (member.block, *(corner for _, corner in member.corners))
    for block in {each.line: each for each in blocks}.values():
        for word in block.words:
            if word.address in _BESIDE_ANY or word.address not in LEXICON.addresses:
                continue
            name = word.address
            if name == "CLSD":
                name += "+" if word.text.strip().endswith("+") or not word.text.strip().endswith("-") else "-"
            if name in own:
                repeated.append(word)
            own.setdefault(name, word)
    if member.picked is not None:
        own["FSELECT"] = member.picked
    if member.function in TANGENT:
        # What the function states is a word like others.
        function = next(word for word in member.block.words if word.address == "G")
        own[TANGENCY] = replace(function, address=member.function, number=Decimal(0))
    return own


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
    """What elements are called by: the numbers of their blocks, or where some lack them or share them, 1, 2, 3."""
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


def _referred(
    member: _Member, own: Mapping[str, Word], members: Sequence[_Member], numbers: Mapping[Decimal, int]
) -> Iterator[tuple[str, int | str]]:
    """The words of a block that refer to another one, each with the number of its element, or with what is wrong."""
    place = members.index(member)
    for name in REFERRING:
        word = own.get(name)
        if word is None or name not in _ALLOWED[member.function]:
            continue
        other = numbers.get(word.number) if word.number is not None else None
        # From the element right before, IAN counts anyway, whatever that is.
        refers_to_line = name in REFERRING_TO_LINES and not (name == "RAN" and other == place)
        if other == _TWICE:
            yield name, TWO_BLOCKS
        elif other is None or other > place or (name in REFERRING_TO_LINES and not other):
            yield name, NO_BLOCK
        elif refers_to_line and members[other - 1].function not in STRAIGHT:
            yield name, NO_LINE
        else:
            yield name, other


def _turns_either_way(member: _Member, before: Sequence[_Member]) -> bool:
    """Whether CT has no sense that is known from what is before it, because that is still to be found."""
    return member.function in TANGENT[2:] and not member.sense and _has_free(before)


def _has_free(members: Sequence[_Member]) -> bool:
    return any(each.function in FREE for each in members)


def _element(
    member: _Member,
    own: Mapping[str, Word],
    number: int,
    referred: Mapping[str, int | str],
    opening: int,
    *,
    is_closed: bool,
) -> tuple[Element, list[str]]:
    """The element of a block, and what it lacks."""
    lacking = [wrong + name for name, wrong in referred.items() if isinstance(wrong, str)]
    known = {name: other for name, other in referred.items() if isinstance(other, int)}
    counted = tuple((f"I{name}", known[f"R{name}"]) for name in REFERRED if f"R{name}" in known)
    is_line = member.function in STRAIGHT
    sense = _sign_of(member.block, "DR")
    if not is_line and member.function not in TANGENT[2:] and not sense:
        lacking.append(NO_SENSE)
    if own.keys() & POLAR and not member.pole:
        lacking.append(NO_POLE)
    tool = member.here.memory.get(TOOL_AXIS)
    holds = {
        NO_BEFORE: number == 1 and (member.function in TANGENT or ("IAN" in own and "RAN" not in own)),
        NO_CENTER: member.function in (*ABOUT_CENTER, "LP", "CTP") and member.center_at is None,
        FULL: member.is_full,
        NO_RADIUS: member.function == "CR" and "R" not in own,
        CLOSES_NOTHING: "CLSD-" in own and not 0 < opening < number,
        CONTINUED: _CONTINUES.search(member.block.text),
        NEVER_CLOSED: number == opening and not is_closed,
        TOOL: tool is not None and tool.text != "Z",
    }
    lacking += [name for name, is_so in holds.items() if is_so]
    turn = None if is_line else Turn.CW if (sense or member.sense) < 0 else Turn.CCW
    touching = frozenset(name for name in ("D", "DP") if name in own and own[name].number == 0)
    closes = opening if "CLSD-" in own and opening < number else 0
    stated = [name in own and own[name].number is not None for name in ("AN", "CCA")]
    return Element(
        member.function,
        turn,
        member.pole,
        counted,
        known.get("PAR", 0),
        touching,
        is_entered=stated[0],
        is_ended=stated[1] and not is_line,
        is_placed=member.function not in FREE or _is_placed(own.keys()),
        closes=closes,
    ), lacking


def _givens(member: _Member, own: Mapping[str, Word], modes: Modes, *, is_behind_line: bool) -> dict[str, Given]:
    """The values of the words of a block, with those that its function supplies."""
    lexicon = modes.words(member.here)
    found = {name: lexicon.given(name, word, member.here.unit) for name, word in own.items()}
    stated = {name: given for name, given in found.items() if given is not None and name != TANGENCY}
    if "R" in stated and member.function not in FREE:
        # The sign of CR chooses the arc.
        stated["R"] = replace(stated["R"], value=abs(stated["R"].value))
    if member.function in TANGENT:
        # Only two lines in a row state an angle with it: none.
        unit = Unit.DEGREE if is_behind_line and member.function in STRAIGHT else Unit.SIGN
        stated[TANGENCY] = Given(TANGENCY, Decimal(0), unit, own[TANGENCY])
    if member.function in FREE:
        return stated
    if member.function in ("L", "C", "CR", "CT"):
        for axis in PLANE:
            if axis not in own and f"I{axis}" not in own:
                stated[f"I{axis}"] = Given("", Decimal(0), Unit.MM, None)
    if member.function in ABOUT_CENTER and member.center_at is not None:
        for axis, value in zip(PLANE, member.center_at, strict=True):
            stated[f"CC{axis}"] = Given("", value, Unit.MM, None)
    if member.function == "LP":
        for name in ("PR", "PA"):
            if name not in own and f"I{name}" not in own:
                stated[f"I{name}"] = Given("", Decimal(0), Unit.MM if name == "PR" else Unit.DEGREE, None)
    return stated


def _corner_circumstances(members: Sequence[_Member], number: int) -> Iterator[str]:
    """What holds of an element because of the corners at its ends."""
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


def _pole_words(pole: Pole) -> dict[str, Word]:
    """The words of the block that states a pole."""
    block = pole[1]
    if not isinstance(block, Block):
        return {}
    return {word.address: word for word in block.words if word.address in PLANE}


def _makes(chain: _Chain, labels: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """The names of what each block of a chain makes."""
    by_block: dict[int, tuple[str, ...]] = {}
    for label, member in zip(labels, chain.members, strict=True):
        by_block[member.index] = (f"{'line' if member.function in STRAIGHT else 'arc'} {label}",)
        for place, _ in member.corners:
            by_block[place] = (*by_block.get(place, ()), f"corner {label}")
    return (by_block.get(index, ()) for index in range(len(chain.blocks)))
