"""Finds words and comments that two programs do not have in common: those of the path, and those besides it."""

import re
from collections import Counter
from collections.abc import Container, Iterable, Iterator, Sequence
from decimal import Decimal
from difflib import SequenceMatcher
from enum import Enum

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.execution import Call, CallKind
from contoursolve.gcode import Block, Word, own_comments
from contoursolve.reading import Bearing, Code, Effect, Modes, codes_of

_OF_TOOLS = frozenset("DH")
"""Addresses of tools that have another meaning in a cycle, and in contours of some controls."""
_MODAL = frozenset("FSTDH")
"""Addresses whose value stays: to say it once more changes nothing."""
_NUMBERING = frozenset("NO")
_BARE = re.compile(r"^[\s/]*(?:N?\d+\b)?\s*")
_FASTEST = "FMAX"
"""The feed of Klartext that is a rapid, and so the path's."""


class Quote(Struct, frozen=True):
    """A word, a comment or a statement as it is typed, and where."""

    kind: str
    """Only the same kind can stand for it: an address, `comment`, or the code of a block that is one statement."""
    text: str
    line: int
    file: str = ""
    number: Decimal | None = None

    @property
    def key(self) -> tuple[str, object]:
        """Its kind and its value, however it is written."""
        written = "".join(self.text.split()).upper() if self.kind not in (COMMENT, KEPT) else self.text
        return self.kind, written if self.number is None else self.number


COMMENT, KEPT = "comment", "kept-block"
"""Kinds of a comment, and of one that keeps a block of the other program."""


class Change(Struct, frozen=True):
    """A word of OLD and the one of NEW in its place; None where a program has none."""

    old: Quote | None
    new: Quote | None

    @property
    def by(self) -> Decimal | None:
        """By how much a number changes, in its own unit; None where there are not two."""
        if self.old is None or self.new is None or self.old.kind in _COUNTED:
            return None
        before, behind = self.old.number, self.new.number
        return None if before is None or behind is None else behind - before

    @property
    def text(self) -> str:
        """Both as they are typed, and by how much."""
        if self.old is not None and self.new is not None:
            off = f" (by {self.by.normalize():+f})" if self.by else ""
            return f"{self.old.text} becomes {self.new.text}{off}"
        name, said = ("OLD", self.old) if self.new is None else ("NEW", self.new)
        return f"only {name} has {said.text}" if said is not None else ""


_COUNTED = frozenset("GMTDHNOP")
"""Addresses whose numbers are names."""


def changes_between(old: Iterable[Quote], new: Iterable[Quote]) -> Iterator[Change]:
    """List what changes from some words to others, whatever their order: the same kinds in pairs."""
    olds, news = [*old], [*new]
    shared = Counter(each.key for each in olds) & Counter(each.key for each in news)
    rest = [_without(olds, shared), _without(news, shared)]
    while rest[0]:
        said = rest[0].pop(0)
        partner = next((each for each in rest[1] if each.kind == said.kind), None)
        if partner is not None:
            rest[1].remove(partner)
        yield Change(said, partner)
    for said in rest[1]:
        yield Change(None, said)


def _without(words: Sequence[Quote], shared: Counter[tuple[str, object]]) -> list[Quote]:
    left, kept = shared.copy(), list[Quote]()
    for each in words:
        if left[each.key] > 0:
            left[each.key] -= 1
        else:
            kept.append(each)
    return kept


def changed_comments(
    old: Sequence[Block], new: Sequence[Block], ran: tuple[Sequence[Block], Sequence[Block]]
) -> Iterator[Change]:
    """The comments of two programs that are not the same, in the order of their lines. One that keeps a block of the
    other program, as it is typed or as it `ran`, stands for no other comment."""
    one, other = ([*_comments(blocks)] for blocks in (old, new))
    if [each.key for each in one] == [each.key for each in other]:
        return
    sides = _sorted_out(one, (*new, *ran[1])), _sorted_out(other, (*old, *ran[0]))
    keys = [[each.key for each in side] for side in sides]
    for _, first, last, begin, end in SequenceMatcher(None, keys[0], keys[1], autojunk=False).get_opcodes():
        yield from changes_between(sides[0][first:last], sides[1][begin:end])


def _sorted_out(comments: Iterable[Quote], others: Iterable[Block]) -> list[Quote]:
    """Comments, those that keep a block of another program by a kind of their own."""
    blocks = {_bare(each.syntax.comment.sub("", each.text)) for each in others if each.says_something}
    inner = ((each, _bare(each.text[1:].removesuffix(")").removesuffix("]"))) for each in comments)
    return [replace(each, kind=KEPT) if text in blocks else each for each, text in inner]


def _bare(text: str) -> str:
    """A block without its number and its blanks."""
    return "".join(_BARE.sub("", text).split())


def _comments(blocks: Iterable[Block]) -> Iterator[Quote]:
    for block in blocks:
        for text in own_comments(block):
            yield Quote(COMMENT, text.strip(), block.line, block.file)


def path_words(block: Block, modes: Modes) -> list[Quote]:
    """The words of a block that may say something of the path; of one without words, what it states."""
    if not block.words:
        return [*_statement(block)]
    beside = _beside(block, modes)
    return [_said(each, block) for each in block.words if each not in beside and each.address not in _NUMBERING]


def is_of_cycle(word: Word, block: Block, modes: Modes) -> bool:
    """Whether a word of a block that is not followed must be the same in another program."""
    is_beside = word in _beside(block, modes) and word.address not in ("G", *_OF_TOOLS)
    return not is_beside and word.address not in _NUMBERING


_MODES = frozenset((Effect.PLANE, Effect.UNITS, Effect.ABSOLUTE, Effect.INCREMENTAL, Effect.COMPENSATION))


def mode_words(block: Block, modes: Modes) -> Iterator[Quote]:
    """The codes of a block by which the blocks behind it mean another path."""
    return (_said(word, block) for word in _codes_with(block, modes, _MODES))


def _codes_with(block: Block, modes: Modes, effects: Container[Effect]) -> list[Word]:
    """The words of codes with one of some effects."""
    words = [word for word in block.words if word.address == "G"]
    rows = zip(words, codes_of(block, modes), strict=True)
    return [word for word, code in rows if isinstance(code, Code) and code.effect in effects]


class BlockUse(Enum):
    """Part that a block has in a path."""

    CONTOUR = "contour"
    """It is a part of a contour."""
    PLAIN = "plain"
    """A move by its coordinates, or none."""
    UNFOLLOWED = "unfollowed"


def beside_path(block: Block, modes: Modes, use: BlockUse) -> Iterator[Quote]:
    """The words of a block besides the path. D and H of a block that is not followed, or that draws a contour by them,
    are the path's. A unit is none that changes it where it is told here alone."""
    if _codes_with(block, modes, (Effect.NO_MOTION,)) or not block.words:
        yield from _statement(block) if use is BlockUse.PLAIN else ()
        return
    told, own = [*_beside(block, modes), *_codes_with(block, modes, (Effect.UNITS,))], modes.lexicon.addresses
    for word in block.words:
        is_shape = use is BlockUse.UNFOLLOWED or (use is BlockUse.CONTOUR and word.address in own)
        if not is_shape if word.address in _OF_TOOLS else word in told:
            yield _said(word, block)


def _statement(block: Block) -> Iterator[Quote]:
    """A block without its number and its comments, if that is anything, by its first word."""
    bare = _BARE.sub("", block.syntax.comment.sub("", block.text)).strip()
    if bare:
        yield Quote(bare.split()[0], bare, block.line, block.file)


def _beside(block: Block, modes: Modes) -> list[Word]:
    """The words of a block that say nothing of the path: the arguments of a call may be anything."""
    language = modes.language
    said = language.read(block.text).statements if language is not None and language.may_say(block.text) else ()
    if any(isinstance(each, Call) and each.kind is not CallKind.PROFILE for each in said):
        return []
    neutral = _codes_with(block, modes, (Effect.NONE,)) if modes.follow is None else []
    return [word for word in block.words if word in neutral or _is_beside(word, modes)]


def _is_beside(word: Word, modes: Modes) -> bool:
    bearing = modes.lexicon.bearing(word.address) if word.address not in modes.lasting else None
    is_named = word.address in _NUMBERING or modes.is_call(word) or word.text.strip().upper() == _FASTEST
    return bearing is Bearing.NONE and not is_named


def _said(word: Word, block: Block) -> Quote:
    return Quote(word.address, word.text.strip(), block.line, block.file, word.number)


def news_of(words: Iterable[Quote], lasting: dict[str, object]) -> Iterator[Quote]:
    """The words that change something, where some values are in force; these change."""
    for each in words:
        if each.kind not in _MODAL or lasting.get(each.kind) != each.key:
            lasting[each.kind] = each.key
            yield each
