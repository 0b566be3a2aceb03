"""Slips of several words, of codes and of blocks: one table of kinds, as `slip_kinds` has it for one word."""

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from decimal import Decimal
from functools import cached_property
from itertools import pairwise, permutations

from msgspec import Struct

from contoursolve.diagnosis.edits import Edit, EditKind, change, drop
from contoursolve.diagnosis.slip_kinds import MEANING, SlipKind, number_in, plain_code
from contoursolve.diagnosis.vocabulary import names_like
from contoursolve.diagnosis.window import Window
from contoursolve.diagnostics import Span, typing_distance
from contoursolve.gcode import Block, Word, find_lookalikes
from contoursolve.geometry import Length, Unit
from contoursolve.reading import Effect, State, WithoutPoint, advance

Edits = tuple[Edit, ...]
Place = tuple[Decimal, Decimal]

CODES = ("G", "DR")
"""Addresses of words that are one of few."""
_CENTRES = (("I", "J"), ("I", "K"), ("J", "K"), ("CCX", "CCY"))
_ENDS = (("X", "Y"), ("X", "Z"), ("U", "W"), ("P", "Q"))
"""Words that belong together, of which each may get the number of the other."""
_MOTIONS, _AXES = ("G0", "G1", "G2", "G3"), "XYZUVW"
_SIDES = ("G41", "G42")
_KLARTEXT_ARCS = ("FC", "FCT", "C", "CR", "CT", "CP", "CTP")
_TURNING = ("FC", "FCT", "C", "CR", "CP")
_KLARTEXT_LINES = ("FL", "FLT", "L", "LP", "LT")
_OF_PATHS = (Effect.MOTION, Effect.PLANE, Effect.CONTOUR, Effect.CORNER, Effect.ABSOLUTE, Effect.INCREMENTAL)
_FEW_INCREMENTS = 1000
_RESPELLED = (
    (re.compile(r",,+"), ","),
    (re.compile(r"(?<=\d)(\.\d*),(?=\s|$)"), r"\1"),
    (re.compile(r"(?<![\d.])(\d+),(?=\s|$)"), r"\1."),
    (re.compile(r"(?<=\d)\.\.(?=[A-Z])"), ". ,"),
    (re.compile(r"(?<=\s)\.(?=[A-Z])"), ","),
    (re.compile(r"(?<=\d)\.\.(?![A-Z])"), "."),
    (re.compile(r"(#?[A-Z]{2,})[ \t]*(-?\d+\.?\d*)"), r"\1=\2"),
    (re.compile(r"(?<![#A-Z])([A-Z]{2,}=)"), r"#\1"),
    (re.compile(r"#([A-Z]{2,}=)"), r"\1"),
    (re.compile(r"(?<=\d)[ \t]+(?=\.?\d)"), ""),
    (re.compile(r"\b([GM])[OQ](?=\d)"), r"\g<1>0"),
    (re.compile(r"\b([GM])[lI]\b"), r"\g<1>1"),
    (re.compile(r"(?<==)([AI]C)([+-]?\d+\.?\d*)(?!\S)"), r"\1(\2)"),
)
"""Text that is almost a word, and the word."""


class Near(Struct, frozen=True, dict=True):
    """The blocks near a finding, of all in the window around it."""

    window: Window
    blocks: Sequence[Block]

    @cached_property
    def lines(self) -> set[int]:
        """Their lines."""
        return {block.line for block in self.blocks}

    @cached_property
    def centres(self) -> set[str]:
        """The addresses by which a block is an arc."""
        return {"I", "J", "K", self.window.control.modes.radius}

    @cached_property
    def drawing(self) -> set[str]:
        """The codes that draw something, or say how."""
        modes = self.window.control.modes
        codes = (code for code in modes.codes.values() if code.effect in _OF_PATHS or code.number in modes.separate)
        return {plain_code(code.text) for code in codes}

    @cached_property
    def before(self) -> dict[int, str]:
        """The code of the element before each block, by its identity; corners and poles are none."""
        found, code = dict[int, str](), ""
        for block in self.window.blocks:
            found[id(block)] = code
            own = next((plain_code(word.text) for word in block.words if word.address == "G"), "")
            code = own if own and own != "FPOL" else code
        return found

    def states(self) -> Iterator[tuple[Block, State, State]]:
        """Every block of the window with the states before and behind it."""
        state = self.window.ahead[0][1] if self.window.ahead else self.window.state
        for block in self.window.blocks:
            before, state = state, advance(state, block, self.window.control.modes)
            yield block, before, state


def _in_pairs(blocks: Iterable[Block], pairs: Sequence[tuple[str, str]]) -> Iterator[tuple[Word, Word]]:
    """The words of blocks that belong together."""
    for block in blocks:
        named = {word.address: word for word in block.words}
        yield from ((named[one], named[two]) for one, two in pairs if one in named and two in named)


def _number(word: Word) -> str:
    return word.text.strip()[len(word.address) :]


def _exchanged(*pairs: tuple[str, str]) -> Callable[[Near], Iterator[Edits]]:
    """The words of each pair with each other's numbers."""

    def edits(near: Near) -> Iterator[Edits]:
        for one, two in _in_pairs(near.blocks, pairs):
            if _number(one) != _number(two):
                yield change(one, one.address + _number(two)), change(two, two.address + _number(one))

    return edits


def _both_signs(near: Near) -> Iterator[Edits]:
    for words in _in_pairs(near.blocks, (*_CENTRES, *_ENDS)):
        if all(word.number and word.number > 0 and number_in(word.text) for word in words):
            yield tuple(change(word, f"{word.address}-{_number(word).lstrip('+')}") for word in words)


def _all_points(near: Near) -> Iterator[Edits]:
    lexicon = near.window.control.modes.lexicon
    for block in near.blocks if lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS else ():
        rows = ((word, lexicon.addresses.get(word.address)) for word in block.words if word.number)
        words = [word for word, row in rows if not word.has_point and row and row.unit in (Unit.MM, Unit.DEGREE)]
        # Those with few digits are hardly increments, whatever the others are.
        few = [word for word in words if abs(float(word.number or 0)) < _FEW_INCREMENTS]
        for some in [words, few] if len(few) < len(words) else [words]:
            if len(some) > 1:
                yield tuple(change(word, f"{word.text.strip()}.") for word in some)


def _centres(shifts: Callable[[Place, Place], Iterable[Place]]) -> Callable[[Near], Iterator[Edits]]:
    """Both words of each centre with a shift that follows from where its arc begins and ends."""

    def edits(near: Near) -> Iterator[Edits]:
        for block, before, behind in near.states():
            names, start, end = before.plane.centers, _place(before), _place(behind)
            words = [word for each in names if (word := block.find(each)) is not None and word.number is not None]
            if block.line not in near.lines or len(words) != len(names) or start is None or end is None:
                continue
            for shift in dict.fromkeys(shifts(start, end)):
                new = [((word.number or 0) + step, word) for word, step in zip(words, shift, strict=True) if step]
                if new:
                    yield tuple(change(word, _with(word, value)) for value, word in new)

    return edits


def _place(state: State) -> Place | None:
    """The place of the tool in the plane, as centres count: radii, in the unit of the program."""
    first, second = state.start().values
    inch = Decimal("25.4") if state.unit is Length.INCH else Decimal(1)
    return None if first is None or second is None else (Decimal(first) / inch, Decimal(second) / inch)


def _with(word: Word, value: Decimal) -> str:
    """A word with another number, spelled as it is."""
    text = f"{value.normalize():f}"
    return f"{word.address}{text}{'.' if word.has_point and '.' not in text else ''}"


# Codes -----------------------------------------------------------------------------------------------------------

Meant = Callable[[Near, Block, Word], Iterable[str]]
"""The codes, without a zero that leads, that one of a block may have been meant to be."""


def _codes(meant: Meant, *, everywhere: bool = False) -> Callable[[Near], Iterator[Edits]]:
    """Each code as others, which the control has, and which say nothing that another code of its block says."""

    def edits(near: Near) -> Iterator[Edits]:
        known = near.window.codes
        for block in near.window.blocks if everywhere else near.blocks:
            for word in (word for word in block.words if word.address in CODES):
                for code in meant(near, block, word):
                    if (code in known or word.address != "G") and not _is_second(near, block, word, code):
                        yield (change(word, _like(word.text, code)),)

    return edits


def _is_second(near: Near, block: Block, word: Word, code: str) -> bool:
    known = near.window.codes
    others = (plain_code(each.text) for each in block.words if each.address == "G" and each is not word)
    return code in known and any(known.get(other) is known[code] for other in others)


def _like(text: str, code: str) -> str:
    """A code with the zero that leads another one, or with as many digits."""
    has_two = re.fullmatch(r"G\d\d", text.strip(), re.IGNORECASE)
    return f"G0{code[1:]}" if has_two and len(code) == 2 else code  # noqa: PLR2004


def _pairs(*pairs: tuple[str, str]) -> Meant:
    return lambda _near, _block, word: (meant for typed, meant in pairs if typed == plain_code(word.text))


def _both(*names: str) -> tuple[tuple[str, str], ...]:
    """Each of some codes for each other one."""
    return tuple(permutations(names, 2))


def _digits(*, draws: bool) -> Meant:
    """G codes that draw something, or those that do not, with two digits swapped, or one that is another, too many or
    lost."""

    def meant(near: Near, _: Block, word: Word) -> list[str]:
        is_like = (plain_code(word.text) in near.drawing) is draws and re.fullmatch(r"G\d+", plain_code(word.text))
        return _almost(word, near.drawing) if is_like else []

    return meant


def _almost(word: Word, codes: Iterable[str]) -> list[str]:
    """The codes that differ from one by a slip of its digits."""
    text, own = word.text.strip(), plain_code(word.text)
    others = (code for code in codes if re.fullmatch(r"G\d+", code) and code != own)
    return [code for code in others if typing_distance(text.upper(), _like(text, code)) == 1]


def _arc_for_line(near: Near, block: Block, word: Word) -> Sequence[str]:
    """An arc for a line that has a centre or a radius, and for a code of none that is almost one."""
    if near.centres.isdisjoint(each.address for each in block.words):
        return ()
    is_long = re.fullmatch(r"G\d\d+", plain_code(word.text))
    return _MOTIONS[2:] if plain_code(word.text) in _MOTIONS[:2] else _almost(word, _MOTIONS[2:]) if is_long else ()


def _tangents(near: Near, block: Block, word: Word) -> Sequence[str]:
    """Lines and arcs that begin in the direction of the element before: of two of these, one is an arc."""
    name, before = plain_code(word.text), near.before[id(block)]
    return [f"{name}T"] if name == "FC" or (name == "FL" and before in _KLARTEXT_ARCS) else ()


def _sides(near: Near, block: Block, word: Word) -> Sequence[str]:
    """The code for no compensation as one for a side, where none stands behind it: that of a head is meant."""
    behind = (each for each in near.window.blocks if each.line >= block.line)
    codes = {plain_code(each.text) for other in behind for each in other.words}
    return _SIDES if plain_code(word.text) == "G40" and codes.isdisjoint(_SIDES) else ()


def _said_again(near: Near) -> Iterator[Edits]:
    """A code for increments or places that says what is in force already, as the other one."""
    for block, before, behind in near.states():
        if behind.is_incremental is before.is_incremental:
            pair = ("G91", "G90") if before.is_incremental else ("G90", "G91")
            yield from _codes(_pairs(pair))(Near(near.window, [block]))


def _motion_lost(near: Near) -> Iterator[Edits]:
    """The code of a line behind an arc, and of an arc behind a line, that a block lacks."""
    motion, blocks = "", near.window.blocks
    like = "G01" if any(re.match(r"G0\d", word.text.strip()) for block in blocks for word in block.words) else "G1"
    for block in blocks:
        codes = [plain_code(word.text) for word in block.words if word.address == "G"]
        motion = next((code for code in codes if near.window.codes.get(code) is Effect.MOTION), "" if codes else motion)
        addresses = {word.address for word in block.words}
        if not motion or codes or block.line not in near.lines or addresses.isdisjoint(_AXES):
            continue
        is_round = not addresses.isdisjoint(near.centres)
        if is_round is (motion in _MOTIONS[:2]):
            for code in _MOTIONS[2:] if is_round else _MOTIONS[1:2]:
                yield (Edit(EditKind.ADD, "G", text=_like(like, code), line=block.line),)


def _sense_lost(near: Near) -> Iterator[Edits]:
    """The sense of rotation of an arc of Klartext that has none."""
    for block in near.blocks:
        codes = [plain_code(word.text) for word in block.words if word.address == "G"]
        if block.line in near.lines and not block.find("DR") and any(code in _TURNING for code in codes):
            yield from ((Edit(EditKind.ADD, "DR", text=text, line=block.line),) for text in ("DR+", "DR-"))


# Blocks, and text that is no word --------------------------------------------------------------------------------


def _between(near: Near) -> Iterator[Edits]:
    """Blocks without a motion that stand between a corner and its neighbour, moved before the contour."""
    blocks, first = near.window.blocks, near.window.first
    for block in blocks[first + 1 : min(first + len(near.window.own) + 2, len(blocks) - 1)]:
        said = [word for word in block.words if word.address != "N"]
        if said and all(word.address in "MSTF" for word in said):
            text = "\n" + " ".join(word.text.strip() for word in said)
            ahead = [Edit(EditKind.ADD, said[0].address, text=text, line=blocks[first - 1].line)] if first else []
            yield (*map(drop, said), *ahead)


def _swapped_blocks(near: Near) -> Iterator[Edits]:
    for one, two in pairwise(near.window.blocks):
        if {one.line, two.line} <= near.lines and one.words and two.words:
            first, second = _body(one), _body(two)
            if first.text and second.text and first.text != second.text:
                yield change(first, second.text), change(second, first.text)


def _body(block: Block) -> Word:
    """All of a block behind its number, as one word."""
    match = re.match(r"\s*(?:N?\d+\s+)?", block.text)
    begin = match.end() if match else 0
    text = block.text[begin:].rstrip()
    return Word("", None, False, text, Span(block.line, begin + 1, begin + 1 + len(text)))


def _other_block(near: Near) -> Iterator[Edits]:
    """A word of a corner or an angle, or one of two for an axis, that stands in the block before or behind the one that
    it belongs to."""
    beside = [*pairwise(near.blocks)]
    for one, two in (*beside, *((two, one) for one, two in beside)):
        for word in one.words if two.words else ():
            is_twice = word.address in _AXES and sum(each.address == word.address for each in one.words) > 1
            if (is_twice or _is_apart(word, near.window)) and two.find(word.address) is None:
                yield drop(word), Edit(EditKind.ADD, word.address, text=word.text.strip(), line=two.line)


def _is_apart(word: Word, window: Window) -> bool:
    """Whether a word is one of a corner or an angle, by its spelling, or chooses. Without its offset, a contour lies
    elsewhere."""
    row = window.control.modes.lexicon.addresses.get(word.address)
    is_long = word.address.startswith((",", "#")) or len(word.address) > 1 or bool(row and row.unit is Unit.SIGN)
    return is_long and word.address not in window.control.modes.zero.names


def _dropped(near: Near) -> Iterator[Edits]:
    words = (word for block in near.blocks if block.line in near.window.lines for word in block.words)
    return ((drop(word),) for word in words if _is_apart(word, near.window))


def _respelled(near: Near) -> Iterator[Edits]:
    """Text that cannot be read, as words that it may have been."""
    for block in (block for block in near.blocks if block.line in near.window.lines):
        alike = [each for each in find_lookalikes(block) if not re.fullmatch("[A-Za-z]{3,}", each.old)]
        edits = tuple(Edit(EditKind.CHANGE, each.address, each.span, each.old, each.new) for each in alike)
        yield from ((edit,) for edit in edits)
        if len(edits) > 1:
            yield edits
        yield from ((edit,) for edit in rewritten(near.window, [block]))


def rewritten(window: Window, blocks: Iterable[Block]) -> Iterator[Edit]:
    """Text that is almost a word, as the word: with a comma, a point or an equals sign more or less."""
    lexicon = window.control.modes.lexicon
    equal = {address for address in lexicon.addresses if "=" in lexicon.spell(address, "1")}
    has_marks = any(address.startswith("#") for address in lexicon.addresses)
    for block in blocks:
        for pattern, new in _RESPELLED:
            for match in pattern.finditer(block.text) if has_marks or "#" not in new else ():
                begin = block.text.rfind(" ", 0, match.start()) + 1
                end = (block.text + " ").find(" ", match.end())
                old = block.text[begin:end]
                text = block.text[begin : match.start()] + match.expand(new) + block.text[match.end() : end]
                if text != old and ("=" not in new or text.partition("=")[0].upper() in equal):
                    yield Edit(EditKind.CHANGE, "", Span(block.line, begin + 1, end + 1), old, text)


def _misspelt(near: Near) -> Iterator[Edits]:
    """The name of what is no word or code of the control, as one that it has."""
    modes = near.window.control.modes
    known = {*modes.lexicon.plain_names(), *modes.syntax.codes}
    for block in near.blocks:
        strange = [
            word.span
            for word in block.words
            if (word.number is None if word.address == "G" else len(word.address) > 1 and word.address not in known)
        ]
        for span in (*strange, *(fault.span for fault in block.faults)):
            match = re.compile(r"#?[A-Za-z]{2,}").match(block.text, span.column - 1)
            if match is not None and match[0].upper() not in known:
                place = Span(block.line, match.start() + 1, match.end() + 1)
                for name in names_like(match[0], modes.lexicon, modes.syntax.codes):
                    yield (Edit(EditKind.CHANGE, "", place, match[0], name),)


def _references(near: Near) -> Iterator[Edits]:
    """The block of a parallel line, from which a distance counts: the numbers of the lines before it."""
    numbers = list[str]()
    for block in near.window.own if "PAR" in near.window.control.modes.lexicon.addresses else ():
        if block.line in near.lines and block.find("DP") and not block.find("PAR"):
            yield from ((Edit(EditKind.ADD, "PAR", text=f"PAR {each}", line=block.line),) for each in numbers)
        number = block.find("N")
        if number is not None and any(plain_code(word.text) in _KLARTEXT_LINES for word in block.words):
            numbers.append(number.text.strip())


class SeveralKind(Struct, frozen=True):
    """A kind of slip that is not of one word, and the edits that undo it near a finding."""

    slip: SlipKind
    edits: Callable[[Near], Iterator[Edits]]


def _kind(name: str, sentence: str, example: str, cost: float, edits: Callable[[Near], Iterator[Edits]]) -> SeveralKind:
    return SeveralKind(SlipKind(name, sentence, example, cost, MEANING), edits)


def _less(place: Place, other: Place) -> Place:
    return place[0] - other[0], place[1] - other[1]


_ORIGIN = Decimal(0), Decimal(0)

OTHER_BLOCK = SlipKind(
    "other-block", "a word of the block beside", "G01 X40.|Y70. ,C2. for G01 X40. ,C2.|Y70.", 4.2, MEANING
)
SEVERAL = (
    _kind("respelled", "", "G01 X30. ,,C2. for G01 X30. ,C2.", 0.5, _respelled),
    _kind("misspelt", "", "FTL X+10 for FLT X+10", 0.7, _misspelt),
    _kind("all-points", "", "G01 X30 Y40 for G01 X30. Y40.", 0.4, _all_points),
    _kind(
        "words-swapped",
        "two words swapped",
        "G03 X40. Y70. I0. J-20. for G03 X40. Y70. I-20. J0.",
        1.4,
        _exchanged(*_CENTRES),
    ),
    _kind("ends-swapped", "two words swapped", "G01 X70. Y40. for G01 X40. Y70.", 2.6, _exchanged(*_ENDS)),
    _kind(
        *(
            "from-start",
            "the centre counted from the start",
            "G00 X60. Y50.|G03 X40. Y70. I40. J50. for G00 X60. Y50.|G03 X40. Y70. I-20. J0.",
            2.0,
        ),
        _centres(lambda start, end: (_less(_ORIGIN, start), _less(end, start))),
    ),
    _kind(
        "from-origin",
        "the centre counted from the origin",
        "G00 X60. Y50.|G03 X40. Y70. I-20. J0. for G00 X60. Y50.|G03 X40. Y70. I40. J50.",
        3.0,
        _centres(lambda start, end: (start, end)),
    ),
    _kind(
        "both-signs",
        "two lost minus signs",
        "G03 X40. Y70. I20. J10. for G03 X40. Y70. I-20. J-10.",
        3.0,
        _both_signs,
    ),
    _kind(
        "turn",
        "the other way round",
        "G02 X40. Y70. R20. for G03 X40. Y70. R20.",
        2.1,
        _codes(_pairs(*_both("G2", "G3"), *_both("DR+", "DR-"))),
    ),
    _kind("motion-lost", "", "G03 X40. Y70. R20.|X0. for G03 X40. Y70. R20.|G01 X0.", 1.6, _motion_lost),
    _kind("sense-lost", "", "C X+10 Y+0 for C X+10 Y+0 DR+", 1.6, _sense_lost),
    _kind("line-for-arc", "an arc", "G01 X40. Y70. R20. for G02 X40. Y70. R20.", 1.6, _codes(_arc_for_line)),
    _kind("tangent", "the tangent", "FC DR+ R20|FL X+10 for FC DR+ R20|FLT X+10", 1.9, _codes(_tangents)),
    _kind(
        "no-tangent",
        "no tangent",
        "FLT X+10 for FL X+10",
        3.4,
        _codes(_pairs(("FLT", "FL"), ("FCT", "FC"))),
    ),
    _kind("free-line", "", "L PR+20 for FL PR+20", 2.0, _codes(_pairs(("L", "FL"), ("C", "FC")))),
    _kind(
        "plane",
        "another plane",
        "G18 for G17",
        1.6,
        _codes(_pairs(*_both("G17", "G18", "G19")), everywhere=True),
    ),
    _kind("increments", "", "G91 for G90", 2.6, _codes(_pairs(*_both("G90", "G91")), everywhere=True)),
    _kind("increments-again", "", "G90|G90 X10. Y5. for G90|G91 X10. Y5.", 1.2, _said_again),
    _kind("compensation", "", "G40 G01 X30. for G41 G01 X30.", 2.2, _codes(_sides, everywhere=True)),
    _kind("code", "", "G91|G50 X10. for G91|G90 X10.", 2.4, _codes(_digits(draws=False), everywhere=True)),
    _kind(
        "other-code",
        "",
        "G19 for G17",
        4.8,
        _codes(_digits(draws=True), everywhere=True),
    ),
    _kind("rapid", "", "G00 X40. ,C2. for G01 X40. ,C2.", 2.8, _codes(_pairs(("G0", "G1")))),
    _kind("between", "", "G00 X0.|G01 X40. ,C2.|M08|Y70. for G00 X0.|M08|G01 X40. ,C2.|Y70.", 0.0, _between),
    _kind("blocks-swapped", "two blocks swapped", "G01 X40.|Y70. for Y70.|G01 X40.", 3.2, _swapped_blocks),
    SeveralKind(OTHER_BLOCK, _other_block),
    _kind("reference-lost", "", "5 FL AN+30|6 FL DP 10 for 5 FL AN+30|6 FL DP 10 PAR 5", 1.8, _references),
    _kind("too-many", "", "G01 X40. ,C2. for G01 X40.", 4.2, _dropped),
)
"""Kinds of slips that are not of one word."""
