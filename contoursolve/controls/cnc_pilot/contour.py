"""Contours: which blocks are solved together, where elements touch, and what their words state."""

from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal
from functools import cached_property, lru_cache
from itertools import count, pairwise

from msgspec import Struct, structs

from contoursolve.controls.cnc_pilot.lexicon import ARC_Q, BOOK, EXTRA, MISSING, MODAL, SENSE, SETTINGS, TURNS, WIDTH
from contoursolve.controls.heidenhain.elements import ARC, LINE, TANGENCY, FkElement
from contoursolve.controls.heidenhain.form import compose
from contoursolve.controls.heidenhain.lexicon import CHAMFER, ROUNDING, PlaneWords
from contoursolve.controls.plain import LATHE
from contoursolve.gcode import Block
from contoursolve.geometry import Choice, CornerShape, Given, Pick, Side, Turn, Unit
from contoursolve.reading import (
    COMMENTED,
    Assumption,
    ContourBuilder,
    ContourForm,
    Effect,
    Modes,
    ParsedContour,
    Selector,
    State,
    apply_modes,
    rows_of,
    some,
)

NO_CODE, LAST, OVERSIZE = "@no-code", "@last", "@oversize"
"""An element without a G code; the last one; one with G52."""
TOO_MUCH = "@too-much"
"""Behind a known point, where an angle beside both coordinates is refused."""
_ENDS = (("Z", "ZI"), ("X", "XI"))
_NAMES = {"XI": "IX", "ZI": "IZ", "I": "CCX", "K": "CCZ"}
_WORDS = PlaneWords(LATHE.axes, across=(), has_corners=True)
_FACES = structs.replace(_WORDS, chamfer=CornerShape.CHAMFER_FACE)
_STRAIGHT = 1e-6
"""The sine of the turn up to which two elements touch, so that there is no corner."""
_ALONG = (Side.NEARER, Side.FARTHER)


class _Member(Struct, frozen=True, dict=True):
    """A block of a contour, the state with its codes in force, and whether it begins at a known point."""

    block: Block
    here: State
    is_placed: bool

    @property
    def turn(self) -> Turn | None:
        return TURNS.get(self.here.motion or 0)

    @cached_property
    def has(self) -> frozenset[str]:
        """The addresses of its words, without those that are asked for."""
        return frozenset(word.address for word in self.block.words if not word.is_asked)

    @cached_property
    def open(self) -> int:
        """The number of coordinates of its end that are to be computed."""
        is_free, ends = not self.turn and "A" in self.has, [[*filter(None, map(self.block.find, p))] for p in _ENDS]
        return sum(any(word.is_asked for word in words) or (is_free and not words) for words in ends)

    @cached_property
    def lacking(self) -> int:
        """The number of data that it lacks; below 0 behind an open end, which these data close."""
        found = self.open + (1 - len(self.has & {*"IKR"}) if self.turn else -("A" in self.has))
        return max(0, found) if self.is_placed else found

    @property
    def is_centered(self) -> bool:
        """Whether its centre is known: in G2 and G3 it counts from where the arc begins."""
        return self.turn is not None and self.has >= {*"IK"} and (self.is_placed or self.here.motion not in (2, 3))

    @property
    def ways(self) -> tuple[bool, bool]:
        """The knowledge of its directions: where it begins, and where it ends."""
        is_known = (self.is_placed and not self.open and not self.lacking) or (not self.turn and "A" in self.has)
        return is_known or (self.is_placed and self.is_centered), is_known or (not self.open and self.is_centered)

    def code(self, *numbers: int | None) -> bool:
        """Whether it has one of some G codes."""
        return any(word.address == "G" and word.number in numbers for word in self.block.words)

    def name(self, address: str) -> str:
        """The name of what a word states, among those of free contours."""
        size = self.block.find("B")
        if address == "B" and size is not None and size.number != 0:
            return CHAMFER if size.number is not None and size.number < 0 else ROUNDING
        step = "I" if address in "IK" and self.here.motion in (2, 3) else ""
        return "AN" if address == "A" and not self.turn else step + _NAMES.get(address, address)


def _member(block: Block, before: State, modes: Modes, *, is_placed: bool = True) -> _Member | None:
    """The block as an element, if it is one."""
    codes, here = rows_of(block, modes), apply_modes(before, block, modes)
    is_own = all(code.effect in (Effect.MOTION, Effect.NONE, Effect.COMPENSATION) for code in codes)
    is_own = is_own and sum(word.address == "G" for word in block.words) == len(codes) and block.macro is None
    is_moving = any(word.address in modes.lexicon.addresses for word in block.words)
    return _Member(block, here, is_placed) if is_own and is_moving and here.motion in (1, *TURNS) else None


def _next(blocks: Sequence[Block], index: int, last: _Member, modes: Modes) -> tuple[int, _Member] | None:
    """The next element: blocks that say nothing, and attributes alone, may stand before it."""
    for place in count(index + 1):
        try:
            block = blocks[place]
        except IndexError:
            return None
        found, codes = _member(block, last.here, modes, is_placed=not last.open), rows_of(block, modes)
        if found is not None:
            return place, found
        is_attribute = all(code.effect is Effect.NONE for code in codes) and {w.address for w in block.words} <= {*"NG"}
        if block.find("O") or (block.says_something and not (codes and is_attribute)):
            return None
    return None


def find(blocks: Sequence[Block], index: int, state: State, modes: Modes) -> ParsedContour | None:
    """The contour that begins at a block: as many elements as one needs for another."""
    first = _member(blocks[index], state, modes)
    if first is None or COMMENTED in state.memory:
        return None
    members, lacking, place, is_always = [first], first.lacking, index, modes.has(MISSING, "always")
    while (after := _next(blocks, place, members[-1], modes)) is not None:
        (place, following), last = after, members[-1]
        corner = last.block.find("B")
        joins = following.lacking > 0 or is_always if corner is None else corner.number != 0
        if not (last.open or joins or lacking > len(_joints(members))):
            break
        members.append(following)
        lacking += following.lacking
    x, is_coded = first.block.find("X"), first.code(first.here.motion)
    is_below = x is not None and x.number is not None and x.number < 0
    if len(members) == 1 and is_coded and not (first.turn or first.open or is_below or first.has & {*"AIKRBEQ"}):
        return None
    joints = _joints(members, is_always=is_always)
    touching = frozenset(joints if is_always else joints[: max(0, lacking)])
    return _claim(members, touching, state, modes, is_last=after is None, is_open=lacking > 0 or bool(touching))


def _joints(members: Sequence[_Member], *, is_always: bool = False) -> list[int]:
    """The numbers of the elements, from 0, at whose begin no B stands, and a tangency would tell something."""
    pairs = enumerate(pairwise(members), 1)
    return [n for n, (a, b) in pairs if "B" not in a.has and (is_always or not (a.ways[1] and b.ways[0]))]


def _claim(
    members: Sequence[_Member], touching: frozenset[int], before: State, modes: Modes, *, is_last: bool, is_open: bool
) -> ParsedContour:
    """The contour of elements, of which some touch the one before; `is_last` tells that no element follows, `is_open`
    that without that something would be open."""
    builder, rows, elements = ContourBuilder(modes), modes.lexicon.addresses, list[FkElement]()
    choices, selectors, picks = list[Choice](), list[Selector](), list[Pick]()
    numbers = [word.text.strip()[1:] for each in members for word in each.block.words if word.address == "N"]
    labels = numbers if len({*numbers}) == len(members) else [f"{n}" for n, _ in enumerate(members, 1)]
    for number, (member, label) in enumerate(zip(members, labels, strict=True)):
        prefix, index, aims = f"{number + 1}:", builder.add(member.block), _aims(members, number)
        own = builder.gather((member.name(each.address), each) for each in member.block.words if each.address in rows)
        is_ray = modes.has(SENSE, "ray") or bool({number, number + 1} & touching) or aims
        element = FkElement(("FC" if member.turn else "FL") + "T" * (number in touching), member.turn)
        is_entered, is_placed = "AN" in own and is_ray, not member.open
        elements.append(structs.replace(element, is_entered=is_entered, is_placed=is_placed, is_loose=not is_ray))
        givens = builder.values(own, member.here)
        if CHAMFER in givens:
            givens[CHAMFER] = structs.replace(givens[CHAMFER], value=-givens[CHAMFER].value)
        if number in touching:
            are_lines = not (member.turn or members[number - 1].turn)
            givens[TANGENCY] = Given("", Decimal(0), Unit.DEGREE if are_lines else Unit.SIGN, None)
        if member.open and not member.turn and "Q" not in own:
            givens["Q"] = Given("", Decimal(0), Unit.SIGN, None)
        for axis, step in _ENDS:
            if not (member.block.find(axis) or member.block.find(step) or "AN" in own):
                givens[_NAMES[step]] = Given("", Decimal(0), Unit.MM, None)
        holds = {
            NO_CODE: not member.code(member.here.motion) and modes.has(MODAL, "off"),
            TOO_MUCH: member.is_placed and modes.has(EXTRA, "error"),
            OVERSIZE: member.code(52),
            LAST: is_last and number == len(members) - 1,
            TANGENCY: number in touching,
        }
        circumstances = (name for name, is_so in holds.items() if is_so)
        builder.state(prefix, own, givens, circumstances, lasting=own.keys() & {"B", "E", "Q"})
        names = (*_ENDS[0], *_ENDS[1], *("RIK" if member.turn else "A"), "B")
        builder.name(prefix, index, ((member.name(each), each) for each in names))
        builder.name(prefix, index, ((name, word.address) for name, word in own.items()))
        chosen = int(own["Q"].number or 0) if "Q" in own else 0
        chosen = 1 - chosen if member.turn and modes.has(ARC_Q, "zero_far") else chosen
        if aims:
            choices.append(Choice(f"P{label}", _ALONG[chosen == 1], f"{prefix}Q"))
            selectors += [Selector(f"P{label}", side, f"Q{value}") for value, side in enumerate(_ALONG)]
        elif "Q" in own or member.open:
            picks.append(Pick(number + 1, 1 + chosen, f"{prefix}Q" if "Q" in own or not member.turn else "", most=2))
        if member.turn and "R" in member.has:
            # Of two arcs, the shorter one.
            choices.append(Choice(f"C{label}", Side.LEFT if member.turn is Turn.CCW else Side.RIGHT, f"{prefix}R"))
    words = _FACES if modes.has(WIDTH, "face") else _WORDS
    if words.slack != modes.radius_difference:
        words = structs.replace(words, slack=modes.radius_difference)
    form = _form(tuple(elements), tuple(labels), words, is_open)
    foreign = [each for member in members for each in member.block.words if each.address not in (*rows, "G")]
    told = {ARC_Q.name} if any(each.turn and (each.open or "Q" in each.has) for each in members) else set[str]()
    conventions = (modes.convention(each) for each in SETTINGS if each.name in {*told, *modes.settings})
    makes = ((each.name, f"corner {label}") for each, label in zip(form.outline.path, labels, strict=True))
    return builder.build(
        form,
        before,
        members[-1].here,
        unknown=tuple(each for each in foreign if not modes.lexicon.is_beside(each.address)),
        choices=tuple(choices),
        selectors=tuple(selectors),
        picks=tuple(picks),
        conventions=tuple(conventions),
        makes=tuple(makes),
    )


def _aims(members: Sequence[_Member], number: int) -> bool:
    """Whether an element is a line by its angle alone, and the next one an arc about a known centre."""
    line, *after = members[number : number + 2]
    is_free = not line.turn and "A" in line.has and line.open == len(_ENDS)
    return is_free and any(each.is_centered for each in after)


_TANGENCY = Assumption(
    "tangency",
    "without B, elements touch in the direction of travel where data are open",
    BOOK.derived("p. 147: no B is tangential"),
    (LINE, ARC),
    some(TANGENCY),
)


@lru_cache(maxsize=2048)
def _form(elements: tuple[FkElement, ...], labels: tuple[str, ...], words: PlaneWords, is_open: bool) -> ContourForm:
    form = compose(elements, labels, (), words)
    form = replace(form, outline=replace(form.outline, guard=_STRAIGHT))
    free = replace(form.free, picking="")
    form = replace(form, name="din-plus", title="contour of lines and arcs", assumptions=(_TANGENCY,), free=free)
    return replace(form, is_general=is_open)
