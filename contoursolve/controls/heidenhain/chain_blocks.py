"""The blocks of a chain that is solved as one, as they are read: free elements in a row, and conventional moves that a
corner or a tangency joins."""

from collections.abc import Mapping, Sequence
from decimal import Decimal
from functools import cached_property
from itertools import count

from msgspec import Struct

from contoursolve.controls.heidenhain.follow import (
    CENTER,
    POLE,
    is_of_machine,
    keep_joint,
    pole_of,
    says_nothing,
    set_pole,
)
from contoursolve.controls.heidenhain.lexicon import (
    CHAMFER,
    FREE,
    IN_KLARTEXT,
    MOVES,
    ROUNDING,
    TANGENT,
    PlaneWords,
    function_of,
)
from contoursolve.gcode import Block, Word
from contoursolve.reading import Modes, State, apply_modes

OF_CORNERS = {"RND": ROUNDING, "CHF": CHAMFER}

Pole = tuple[int, Block] | tuple[Decimal, Decimal]
"""A block with its place in the chain, or coordinates, mm, that were in force before."""


class ChainMember(Struct):
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


class ChainBlocks:
    """The blocks of a chain as they are read."""

    def __init__(self, state: State, modes: Modes, words: PlaneWords = IN_KLARTEXT) -> None:
        self.start = self.state = state
        self.words = words
        self.modes = modes
        self.blocks: list[Block] = []
        self.members: list[ChainMember] = []
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
        return next((n for n, each in enumerate(self.members, 1) if sign_of(each.block, "CLSD") > 0), 0)

    @cached_property
    def is_closed(self) -> bool:
        """Whether an element has CLSD-."""
        return any(sign_of(each.block, "CLSD") < 0 for each in self.members)

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
        if corner > index and self.members[-1].corners and leads_elsewhere(blocks, corner):
            # That corner stands alone.
            self.members[-1].corners = ()
        while self.blocks and self.blocks[-1] is not self._last_block():
            self.blocks.pop()
        self.poles = {name: pole for name, pole in self.poles.items() if not _is_behind(pole, self.blocks)}

    def read_pole(self, block: Block) -> None:
        """Read a pole that stands before no chain: an element of no length."""
        self.poles["pole 1"] = 0, block
        self._add(block, "L")

    @property
    def is_contour(self) -> bool:
        """Whether its blocks are solved together: with a free element, a corner, or several of them."""
        return len(self.members) > 1 or any(each.function in FREE or each.corners for each in self.members)

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
        if function not in FREE and is_of_machine(block) and is_in_plane(block):
            return False
        if stands_between(block, function):
            if function == "FSELECT" and last is not None:
                last.picked = block.find("FSELECT")
            elif function == POLE:
                self.poles[f"pole {len(self.poles) + 1}"] = len(self.blocks), block
            elif function == CENTER:
                self.state = set_pole(self.state, block, CENTER, self.modes)
            return self._pass(block)
        if last is None:
            self._add(block, "L" if function in OF_CORNERS else function)
            if function in OF_CORNERS:
                # The corner of no element: that of a line of no length, which is refused.
                self.members[0].corners = ((len(self.blocks) - 1, block),)
            return function not in OF_CORNERS
        if function in OF_CORNERS:
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
        member = ChainMember(block, function, self.state, index, pole, center)
        if self.words.has_corners:
            member.corners = ((index, block),) if has_corner(block) else ()
            member.picked = block.find("FSELECT")
        self.members.append(member)


def has_corner(block: Block) -> bool:
    """Whether a block has the size of a corner."""
    return any(word.address in (ROUNDING, CHAMFER) for word in block.words)


def stands_between(block: Block, function: str) -> bool:
    """Whether a block may stand between two elements, and is no corner."""
    if block.macro is not None:
        return says_nothing(block)
    # A move of the tool axis alone may, too.
    is_beside = function in MOVES and function not in FREE and not is_in_plane(block)
    return is_beside or function in ("", "STOP", "FSELECT", POLE, CENTER)


def leads_elsewhere(blocks: Sequence[Block], index: int) -> bool:
    """Whether an approach or a departure stands behind a corner, or what stands there is run by another call."""
    for place in count(index):
        try:
            block = blocks[place]
        except IndexError:
            return True
        if any(word.address == "M" and word.number in _ENDS_PROGRAM for word in block.words):
            return False
        function, is_empty = function_of(block), block.macro is None and not block.words and not block.faults
        if not is_empty and function not in OF_CORNERS and not stands_between(block, function):
            is_end_of_call = block.macro is not None and bool(block.callers)
            return is_end_of_call or function.startswith(("APPR", "DEP"))
    return False


_ENDS_PROGRAM = (2, 30)


def _is_behind(pole: Pole, blocks: Sequence[Block]) -> bool:
    """Whether the block of a pole stands behind the last one of a chain."""
    return isinstance(pole[1], Block) and pole[1] not in blocks


def is_in_plane(block: Block) -> bool:
    """Whether a block moves in the plane."""
    return any(word.address in _MOVING for word in block.words)


_MOVING = frozenset({"X", "Y", "IX", "IY", "PR", "PA", "IPR", "IPA", "DR", "R"})


def sign_of(block: Block, address: str) -> int:
    """The sign of a word; 0 if the block has none."""
    word = block.find(address)
    return 0 if word is None or not word.number else 1 if word.number > 0 else -1


def _numbers(chain: ChainBlocks) -> dict[Decimal, int]:
    """The numbers of the elements by those of their blocks; 0 is where the chain begins. A file without numbers counts
    its lines from 0."""
    stated = [member.block.find("N") for member in chain.members]
    found: dict[Decimal, int] = {}
    is_numbered = any(stated)
    for number, (word, member) in enumerate(zip(stated, chain.members, strict=True), 1):
        own = word.number if word is not None else None if is_numbered else Decimal(member.block.line - 1)
        if own is not None:
            found[own] = number if own not in found else TWICE
    first, where = chain.members[0].block, [chain.start.axes[axis].span for axis in chain.words.axes]
    if found and where[0] is not None and where[0] == where[1]:
        found.setdefault(next(iter(found)) - (first.line - where[0].line), 0)
    return found


TWICE = -1
"""A number that two blocks have tells of neither."""
