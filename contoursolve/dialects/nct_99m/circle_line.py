"""NCT 16.3.3, circular-linear intersection: its facts, its path, and how the pair of blocks is found.

Names of givens begin with the number of the block that states them; `first` and `second` are the axes
of the plane, so that one set of tables serves G17, G18 and G19.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal

from contoursolve.constraints import Coordinate, Heading, Offset, OnCircle, Radius
from contoursolve.dialects.dialect import Unresolved
from contoursolve.model import FIRST, SECOND, Arc, Choice, Given, Line, Side, Turn, Unit
from contoursolve.reading import (
    Claim,
    Effect,
    FactRow,
    Form,
    Modes,
    Sample,
    Selector,
    State,
    apply_modes,
    codes_of,
)
from contoursolve.syntax import Block, Word

START, CENTER, ON_CIRCLE, CROSSING, END, RADIUS = "S", "C", "N1", "P1", "N2", "r"
POINT = "1:point"
"""Stated as soon as the arc has a coordinate: then a point of the circle is known."""

CIRCLE_LINE = Form(
    name="circle-line",
    title="circular-linear intersection",
    roles=(),
    start=START,
    points=(CENTER, ON_CIRCLE, CROSSING, END),
    radii=(RADIUS,),
    facts=(
        FactRow(Offset("1:center-first", CENTER, START, FIRST), ("1:center-first",)),
        FactRow(Offset("1:center-second", CENTER, START, SECOND), ("1:center-second",)),
        FactRow(Radius("1:R", RADIUS), ("1:R",)),
        FactRow(Coordinate("1:first", ON_CIRCLE, FIRST), ("1:first",)),
        FactRow(Offset("1:first-step", ON_CIRCLE, START, FIRST), ("1:first-step",)),
        FactRow(Coordinate("1:second", ON_CIRCLE, SECOND), ("1:second",)),
        FactRow(Offset("1:second-step", ON_CIRCLE, START, SECOND), ("1:second-step",)),
        FactRow(OnCircle(START, CENTER, RADIUS), ()),
        FactRow(Coordinate("2:first", END, FIRST), ("2:first",)),
        FactRow(Coordinate("2:second", END, SECOND), ("2:second",)),
        FactRow(OnCircle(CROSSING, CENTER, RADIUS), ()),
        FactRow(Heading("2:,A", CROSSING, END), ("2:,A",)),
        FactRow(OnCircle(ON_CIRCLE, CENTER, RADIUS), (POINT,)),
    ),
    path=(
        Arc("arc", START, CROSSING, CENTER, RADIUS, Turn.CCW),
        Line("line", CROSSING, END, heading="2:,A"),
    ),
    corners=(),
    intersections=(CROSSING,),
    allowed=frozenset(
        {"N", "G", "F", "S", "T", "M", "D", "H", "X", "Y", "Z", "I", "J", "K", "R", ",A", ",C", ",R", "Q"}
    ),
    combinations=(
        ((), ("1:center-first", "1:center-second")),
        ((), ("1:R",)),
        (
            (),
            *((f"1:first{first}", f"1:second{second}", POINT) for first in ("", "-step") for second in ("", "-step")),
        ),
        (("2:first", "2:second", "2:,A"),),
    ),
    sample=Sample("G17 G41 G0 X50 Y0", ("G3 {X-50.0} {Y0} {I-50} {J0} {R50}", "G1 X-50 Y42.857 ,A171.87 {Q-1}")),
    choices=("2:Q",),
    meanings={
        **{f"1:{order}": "a point of the circle" for order in ("first", "second")},
        **{f"1:{order}-step": "a point of the circle, from the start point" for order in ("first", "second")},
        **{f"2:{order}": "end of the line, absolute" for order in ("first", "second")},
    },
)

COMPENSATED, ALONE, OTHER_PLANE, RAPID = "@compensated", "@alone", "@other-plane", "@rapid"
CHAINED = "@chained"
"""The next block is over-defined, too."""

_TURNS = {2: Turn.CW, 3: Turn.CCW}
_OWN_USE = (Effect.SINGLE, Effect.NO_MOTION, Effect.PRESET, Effect.CYCLE, Effect.FRAME)


def find(blocks: Sequence[Block], index: int, state: State, modes: Modes) -> Claim | Unresolved | None:
    """The contour that begins at a block: an arc whose next block is an over-defined line."""
    block = blocks[index]
    if not block.words or not _is_motion(block, state, modes):
        return None
    here = apply_modes(state, block, modes)
    if here.motion in _TURNS and _moves(block):
        following = _next(blocks, index)
        if following is not None and (
            _is_over_defined(blocks[following], here, modes) or _is_stated(block, blocks[following], here, modes)
        ):
            after, last = apply_modes(here, blocks[following], modes), _next(blocks, following)
            is_chained = last is not None and (
                _is_over_defined(blocks[last], after, modes) or _is_over_defined_circle(blocks[last], after, modes)
            )
            return _claim((block, blocks[following]), state, here, modes, is_chained)
    if _is_over_defined(block, state, modes):
        return _claim((block,), state, here, modes, is_chained=False)
    return _unresolved(block, here)


def _next(blocks: Sequence[Block], index: int) -> int | None:
    """The index of the next block that says something."""
    return next((other for other in range(index + 1, len(blocks)) if _has_words(blocks[other])), None)


def _is_over_defined_circle(block: Block, before: State, modes: Modes) -> bool:
    """A circle with end point, centre and radius together, and Q (16.3)."""
    here = apply_modes(before, block, modes)
    stated = {word.address for word in block.words}
    return here.motion in _TURNS and stated >= {*here.plane.axes, *here.plane.centers, "R", "Q"}


def _moves(block: Block) -> bool:
    """Whether a block in an arc's mode is an arc: it has a G code of its own, a coordinate, a centre or R."""
    return any(word.address in "GXYZIJKR" for word in block.words)


def _has_words(block: Block) -> bool:
    return bool(block.faults or block.macro) or any(word.address not in ("N", "O") for word in block.words)


def _is_motion(block: Block, state: State, modes: Modes) -> bool:
    """Whether the block's axis words are the end of a motion with G0 to G3."""
    codes = codes_of(block, modes)
    if any(isinstance(code, Word) or code.effect in _OWN_USE for code in codes):
        return False
    return apply_modes(state, block, modes).motion in (0, 1, 2, 3, None)


def _is_over_defined(block: Block, before: State, modes: Modes) -> bool:
    """A line with both coordinates of the plane and ,A (16.3)."""
    if not _is_motion(block, before, modes):
        return False
    here = apply_modes(before, block, modes)
    # A word that cannot be read still shows what the block was meant to be.
    stated = {word.address for word in block.words} | {fault.address for fault in block.faults}
    return here.motion in (0, 1) and stated.issuperset({*here.plane.axes, ",A"})


def _is_stated(block: Block, following: Block, before: State, modes: Modes) -> bool:
    """A line that further facts join to the arc before it, for contoursolve alone."""
    here = apply_modes(before, following, modes)
    is_line = here.motion in (0, 1) and _is_motion(following, before, modes)
    has_ends = any(word.address in (*here.plane.axes, ",A") for word in following.words)
    is_asked = any(word.is_asked for each in (block, following) for word in each.words)
    return is_line and has_ends and (is_asked or bool(block.directives or following.directives))


def _unresolved(block: Block, here: State) -> Unresolved | None:
    words = {word.address: word for word in block.words}
    if ",A" in words:
        form = "an arc with ,A" if here.motion in _TURNS else "a line by ,A and at most one coordinate (16.2, 16.3.1)"
        return Unresolved(block, words[",A"], form)
    for address, form in ((",C", "a chamfer ,C (16.1)"), (",R", "a rounding ,R (16.1)")):
        if address in words:
            return Unresolved(block, words[address], form)
    if here.motion in _TURNS and words.keys() >= {*here.plane.centers, "R", "Q"}:
        return Unresolved(block, words["Q"], "an over-defined circle (16.3.2, 16.3.4)")
    return None


def _claim(blocks: tuple[Block, ...], state: State, here: State, modes: Modes, is_chained: bool) -> Claim:
    after = apply_modes(here, blocks[-1], modes) if len(blocks) > 1 else here
    names = dict(_names(here, after))
    words: dict[str, Word] = {}
    repeated = []
    for number, block in enumerate(blocks, 3 - len(blocks)):
        for word in block.words:
            code = word.number if word.address == "G" else ""
            name = names.get((number, word.address), f"{number}:{word.address}{code}")
            if name in words and word.address != "M":
                repeated.append(word)
            words.setdefault(name, word)
    givens = {
        name: given
        for name, word in words.items()
        if word.address in modes.lexicon.addresses
        for given in (modes.lexicon.given(name, word, after.unit if name[0] == "2" else here.unit),)
        if given is not None
    }
    turn = _TURNS.get(here.motion or 0, Turn.CCW)
    circumstances = {
        COMPENSATED: after.compensation != 40,  # noqa: PLR2004 - G40
        ALONE: len(blocks) == 1,
        OTHER_PLANE: after.plane != here.plane,
        RAPID: after.motion == 0,
        CHAINED: is_chained,
    }
    return Claim(
        form=CIRCLE_LINE,
        lexicon=modes.lexicon,
        blocks=blocks,
        before=replace(state, plane=here.plane, unit=here.unit),
        after=after,
        words={name: word for name, word in words.items() if word.address in modes.lexicon.addresses},
        givens=_complete(givens, frozenset(name for name, word in words.items() if word.is_asked)),
        vocabulary={
            **{name: (address, number - 1) for (number, address), name in names.items()},
            "1:R": ("R", 0),
            "2:,A": (",A", 1),
            "2:Q": ("Q", 1),
        },
        unknown=tuple(word for word in words.values() if word.address not in CIRCLE_LINE.allowed),
        repeated=tuple(repeated),
        circumstances=frozenset(name for name, holds in circumstances.items() if holds),
        choices=tuple(_choices(givens, turn)),
        selectors=tuple(_selectors(words, turn)),
    )


def _names(here: State, after: State) -> Iterator[tuple[tuple[int, str], str]]:
    """The name of the given that an address states, by block and address."""
    step = "-step" if here.is_incremental else ""
    for number, plane, suffix in ((1, here.plane, step), (2, after.plane, "")):
        for axis, order in zip(plane.axes, ("first", "second"), strict=True):
            yield (number, axis), f"{number}:{order}{suffix}"
        for address, order in zip(plane.centers, ("first", "second"), strict=True):
            yield (number, address), f"{number}:center-{order}"
        for address in {"X", "Y", "Z"} - {*plane.axes}:
            yield (number, address), f"{number}:off-plane"
        for address in {"I", "J", "K"} - {*plane.centers}:
            yield (number, address), f"{number}:wrong-center"


def _complete(givens: dict[str, Given], asked: frozenset[str]) -> dict[str, Given]:
    """The givens with those that the control supplies: of a pair, the missing one is no distance from the
    start (assumed, as for every circle), unless it is asked for. R counts by its size here, its sign is a choice."""
    completed = dict(givens)
    if "1:R" in givens:
        completed["1:R"] = replace(givens["1:R"], value=abs(givens["1:R"].value))
    for first, second in (("1:center-first", "1:center-second"), ("1:first", "1:second")):
        stated = {name.removesuffix("-step") for name in givens} & {first, second}
        if len(stated) == 1:
            missing = (second if first in stated else first) + ("" if "center" in first else "-step")
            if not {missing, missing.removesuffix("-step")} & asked:
                completed[missing] = Given(missing, Decimal(0), Unit.MM, None)
        if stated and first == "1:first":
            completed[POINT] = Given(POINT, Decimal(0), Unit.SIGN, None)
    return completed


def _choices(givens: dict[str, Given], turn: Turn) -> Iterator[Choice]:
    """R's sign picks the centre: the shorter arc for a positive one. Q's sign picks the intersection."""
    if "1:R" in givens:
        left = (givens["1:R"].value > 0) == (turn is Turn.CCW)
        yield Choice(CENTER, Side.LEFT if left else Side.RIGHT, "1:R")
    if "2:Q" in givens and givens["2:Q"].value != 0:
        yield Choice(CROSSING, Side.NEARER if givens["2:Q"].value < 0 else Side.FARTHER, "2:Q")


def _selectors(words: Mapping[str, Word], turn: Turn) -> Iterator[Selector]:
    """Q chooses the intersection, and the sign of a stated R the centre."""
    yield Selector(CROSSING, Side.NEARER, "Q-1")
    yield Selector(CROSSING, Side.FARTHER, "Q1")
    word = words.get("1:R")
    if word is not None and word.number is not None:
        size = word.text.lstrip("Rr +-")
        for side, is_left in ((Side.LEFT, True), (Side.RIGHT, False)):
            sign = "" if is_left == (turn is Turn.CCW) else "-"
            yield Selector(CENTER, side, f"R{sign}{size}")
