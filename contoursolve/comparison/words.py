"""What blocks of two programs say differently: of the path, and besides it."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from decimal import Decimal
from difflib import SequenceMatcher

from msgspec import Struct

from contoursolve.execution import Call
from contoursolve.gcode import Block, Word, own_comments
from contoursolve.reading import Bearing, Code, Effect, Modes, codes_of

_BESIDE = frozenset("FSTDHM")
_IN_CYCLES = frozenset("DH")
"""Addresses of tools that are numbers of a path where they stand in a cycle."""
_MODAL = frozenset("FSTDH")
"""Addresses whose value stays: to say it once more changes nothing."""
_NUMBERING = frozenset("NO")
_BARE = re.compile(r"^[\s/]*(?:N?\d+\b)?\s*")
_FASTEST = "FMAX"
"""The feed of Klartext that is a rapid, and so the path's."""


class Said(Struct, frozen=True):
    """A word, a comment or a statement as it is typed, and where."""

    kind: str
    """What it is compared with: its address, `comment`, or the code of a block that is one statement."""
    text: str
    line: int
    file: str = ""
    number: Decimal | None = None

    @property
    def key(self) -> tuple[str, object]:
        """What it says, however it is written."""
        written = "".join(self.text.split()).upper() if self.kind != COMMENT else self.text
        return self.kind, written if self.number is None else self.number


COMMENT = "comment"


class Change(Struct, frozen=True):
    """What OLD says and what NEW says in its place; None where it says nothing."""

    old: Said | None
    new: Said | None

    @property
    def by(self) -> Decimal | None:
        """By how much a number changes, in its own unit; None where there are not two."""
        ends = (self.old and self.old.number, self.new and self.new.number)
        if ends[0] is None or ends[1] is None or (self.old and self.old.kind in _COUNTED):
            return None
        return ends[1] - ends[0]


_COUNTED = frozenset("GMTDHNOP")
"""Addresses whose numbers are names."""


def changes_between(old: Iterable[Said], new: Iterable[Said]) -> Iterator[Change]:
    """What changes from some words to others, whatever their order: the same address in pairs."""
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


def _without(words: Sequence[Said], shared: Counter[tuple[str, object]]) -> list[Said]:
    left, kept = shared.copy(), list[Said]()
    for each in words:
        if left[each.key] > 0:
            left[each.key] -= 1
        else:
            kept.append(each)
    return kept


def changed_comments(old: Iterable[Block], new: Iterable[Block]) -> Iterator[Change]:
    """The comments of two programs that are not the same, in the order of their lines."""
    one, other = ([*_comments(blocks)] for blocks in (old, new))
    keys = [[each.key for each in side] for side in (one, other)]
    for _, first, last, begin, end in SequenceMatcher(None, keys[0], keys[1], autojunk=False).get_opcodes():
        yield from changes_between(one[first:last], other[begin:end])


def _comments(blocks: Iterable[Block]) -> Iterator[Said]:
    for block in blocks:
        for text in own_comments(block):
            yield Said(COMMENT, text.strip(), block.line, block.file)


def path_words(block: Block, modes: Modes) -> list[Said]:
    """The words of a block that may say something of the path."""
    beside = _beside(block, modes)
    return [_said(each, block) for each in block.words if each not in beside and each.address not in _NUMBERING]


def is_of_cycle(word: Word, block: Block, modes: Modes) -> bool:
    """Whether a word of a block that is not followed must be the same in another program."""
    is_beside = word.address in _BESIDE - _IN_CYCLES and word in _beside(block, modes)
    return not is_beside and word.address not in _NUMBERING


def beside_path(block: Block, modes: Modes, *, is_followed: bool) -> Iterator[Said]:
    """What a block says besides the path. One that is not followed has tools' numbers that count as path."""
    codes = [each for each in codes_of(block, modes) if isinstance(each, Code)]
    alone = next((each for each in codes if each.effect is Effect.NO_MOTION), None)
    bare = _BARE.sub("", block.syntax.comment.sub("", block.text)).strip()
    if alone is not None or (bare and is_followed and not (block.words or block.macro)):
        yield Said(alone.text if alone else bare.split()[0], bare, block.line, block.file)
        return
    for word in _beside(block, modes):
        if is_followed or word.address not in _IN_CYCLES:
            yield _said(word, block)


def _beside(block: Block, modes: Modes) -> list[Word]:
    """The words of a block that say nothing of the path: the arguments of a call may be anything."""
    language = modes.language
    said = language.read(block.text).statements if language is not None and language.may_say(block.text) else ()
    if any(isinstance(each, Call) for each in said):
        return []
    return [word for word in block.words if _is_beside(word, modes)]


def _is_beside(word: Word, modes: Modes) -> bool:
    if word.address == "G":
        row = modes.codes.get(int(word.number)) if word.number is not None and word.number % 1 == 0 else None
        return row is not None and row.effect is Effect.NONE
    if len(word.address) > 1:
        return word.address not in modes.lasting and modes.lexicon.bearing(word.address) is Bearing.NONE
    return word.address in _BESIDE and not modes.is_call(word) and word.text.strip().upper() != _FASTEST


def _said(word: Word, block: Block) -> Said:
    return Said(word.address, word.text.strip(), block.line, block.file, word.number)


class Lasting(Struct):
    """The values in force of one program, so that what says them once more can be left out."""

    values: dict[str, object]

    def news(self, words: Iterable[Said]) -> Iterator[Said]:
        """The words that change something."""
        for each in words:
            if each.kind not in _MODAL or self.values.get(each.kind) != each.key:
                self.values[each.kind] = each.key
                yield each
