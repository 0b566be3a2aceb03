"""Blocks with the values that were asked for filled in: the same text, the values rounded, nearly the same contour."""

from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal

from contoursolve import syntax
from contoursolve.dialects import Dialect
from contoursolve.model import Given, Length, Unit
from contoursolve.reading import Claim, Lexicon
from contoursolve.syntax import Block, Word
from contoursolve.tolerance import RESIDUAL
from contoursolve.verification.case import Case
from contoursolve.verification.drawing import Drawing, UnmeasurableError
from contoursolve.verification.forms import FormChecker
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.path import SHORTEST
from contoursolve.verification.refusals import too_large

SAME = "the filled blocks differ from the program's only where a value is asked for"


def check_filled(case: Case, ledger: Ledger, checker: FormChecker, dialect: Dialect) -> None:
    """The filled blocks of a contour, if the result has any."""
    filled, blocks = case.claimed.filled, case.claim.blocks
    if filled is None:
        return
    words = [word for block in blocks for word in block.words if word.is_asked]
    texts = [word.text for word in words]
    if not ledger.require("a value is asked for", texts, bool(words), "nothing was to be filled in"):
        return
    if not ledger.require(
        SAME,
        texts,
        len(filled.blocks) == len(blocks),
        f"they are {len(filled.blocks)}, and the program's {len(blocks)}",
    ):
        return
    found = [syntax.parse_block(text, block.line) for text, block in zip(filled.blocks, blocks, strict=True)]
    is_same = all(map(_is_filled, blocks, found))
    if not ledger.require(SAME, texts, is_same, "something else was changed, or a value is missing"):
        return
    _check_values(case, ledger, found)
    stripped = tuple(replace(block, directives=()) for block in found)
    claim = dialect.find(stripped, 0, case.claim.before, dialect.modes)
    is_contour = isinstance(claim, Claim) and len(claim.blocks) == len(blocks)
    if ledger.require("the filled blocks are a contour", texts, is_contour) and isinstance(claim, Claim):
        large = too_large(claim)
        if ledger.require("no value that is filled in is too large", large, not large, "no control reads it"):
            _check_deviation(case, ledger, checker, claim, filled.deviation)


def _is_filled(block: Block, filled: Block) -> bool:
    """Whether only the words that are asked for are different, and have values."""
    if len(block.words) != len(filled.words) or filled.faults != block.faults:
        return False
    text = block.text
    for word, new in reversed(list(zip(block.words, filled.words, strict=True))):
        if word.is_asked:
            if new.address != word.address or new.number is None:
                return False
            text = text[: word.span.column - 1] + new.text + text[word.span.end_column - 1 :]
    return text == filled.text


def _check_values(case: Case, ledger: Ledger, found: Sequence[Block]) -> None:
    """Each value is the one that was asked for, rounded to the least increment."""
    lexicon, unit = case.claim.lexicon, case.claim.after.unit
    for block, filled in zip(case.claim.blocks, found, strict=True):
        for word, new in zip(block.words, filled.words, strict=True):
            if not word.is_asked:
                continue
            answers = [
                each for each in case.claimed.asked or () if (each.word, each.line) == (word.text, word.span.line)
            ]
            given = lexicon.given(word.address, new, unit) if word.address in lexicon.addresses else None
            remark = "the result does not mention it"
            name = "a value that is filled in was asked for"
            if not ledger.require(name, [word.text], given is not None and len(answers) == 1, remark) or given is None:
                continue
            value, name = answers[0].value, "the filled value is the asked one, rounded"
            if value is None:
                ledger.require(name, [word.text, new.text], False, "it has no value")
                continue
            stated = abs(given.value) if word.address == "R" else given.value
            off = float(Decimal(value) - stated)
            if given.unit is Unit.DEGREE:
                off = (off + 180) % 360 - 180
            limit = half_increment(given, lexicon, unit) + RESIDUAL
            ledger.measure(name, [word.text, new.text], off, limit, given.unit.value)


def half_increment(given: Given, lexicon: Lexicon, unit: Length) -> float:
    """Half of the least increment of a word, mm (radius) or degrees."""
    step = lexicon.numbers.inch * unit.in_mm if unit is Length.INCH else lexicon.numbers.mm
    if given.unit is Unit.DEGREE:
        step = lexicon.numbers.degree
    return float(step) / (4 if given.is_diameter else 2)


def _check_deviation(case: Case, ledger: Ledger, checker: FormChecker, claim: Claim, deviation: float) -> None:
    """The filled blocks alone make a contour that is as far from the claimed one as the result says."""
    words = [word.text for word in _asked(case)]
    alone = replace(case, claim=claim, facts=(), choices=_choices(claim, checker), is_listed=True)
    try:
        drawing = checker.redo(alone)
    except UnmeasurableError:
        drawing = None
    remark = "they do not fix the points, or choose others"
    if not ledger.require("the filled blocks fix the contour", words, drawing is not None, remark) or drawing is None:
        return
    ends = _ends(drawing)
    claimed = [move.end for move in case.moves]
    if ledger.require(
        "the filled blocks make the same elements",
        words,
        len(ends) == len(claimed),
        f"they make {len(ends)}, and the path has {len(claimed)}",
    ):
        farthest = max((abs(one - other) for one, other in zip(ends, claimed, strict=True)), default=0.0)
        name = "the filled blocks deviate as much as the result says"
        ledger.measure(name, words, farthest - deviation, case.limit)


def _asked(case: Case) -> list[Word]:
    return [case.claim.words[name] for name in case.asked]


def _choices(claim: Claim, checker: FormChecker) -> dict[str, int]:
    numbers = {name: claim.words[name].number for name in checker.choosing(claim) if name in claim.words}
    return {name: 1 if number > 0 else -1 for name, number in numbers.items() if number}


def _ends(drawing: Drawing) -> list[complex]:
    """Where the elements of a drawing end, in order; without those of no length."""
    order = [each for number, name in enumerate(drawing.chain, 1) for each in (name, f"corner {number}")]
    shapes = [drawing.shapes[name] for name in order if name in drawing.shapes]
    return [shape.end for shape in shapes if abs(shape.end - shape.begin) >= SHORTEST]
