"""Words that are named for contoursolve alone: those that are right, and those that are compared with the contour."""

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace as with_fields

from msgspec.structs import replace

from contoursolve.diagnosis import Answer, Context, join, rank, report
from contoursolve.diagnostics import Basis, Diagnostic, Fix, ProgramError
from contoursolve.gcode import ISO, Block, Named, NamedAs, Program, Syntax, Word, parse_block, read_named
from contoursolve.program.request import Request
from contoursolve.reading import Control, ParsedContour, ReadIssue, contours_of

_MARK = re.compile(r"contoursolve\s*+:?+\s*+(?:trust|reference)", re.IGNORECASE)

_MOST_NAMED = 6
"""Words that a message names."""


class NamedWordError(ProgramError, ValueError):
    """A word was named apart from a program and is not there, or cannot be compared; the message says why."""


def has_named(text: str) -> bool:
    """Whether a text may name words for contoursolve alone."""
    return _MARK.search(text) is not None


def is_named_for_all(block: Block) -> bool:
    """Whether a block names words for the whole program: it has nothing but a comment."""
    return bool(block.named) and not block.says_something


def _named_beside(blocks: Iterable[Block]) -> list[tuple[Block, Named]]:
    """The words that comments beside blocks name, each with its block."""
    return [(block, each) for block in blocks if block.named and block.says_something for each in block.named]


def with_named(asked: Request, control: Control, program: Program) -> tuple[Request, tuple[Diagnostic, ...]]:
    """The request with the words that lines of their own name for the whole program, and the findings about them.
    Raises NamedWordError for those that are named apart from the program."""
    syntax = control.modes.syntax
    apart = [read_named(each.role, each.text, syntax) for each in asked.named]
    own = [each for block in program.blocks if is_named_for_all(block) for each in block.named]
    if not apart and not own:
        return asked, ()
    findings = list[Diagnostic]()
    there = [word for block in program.blocks for word in block.words]
    are_compared = any(each.role is NamedAs.REFERENCE for each in own + apart)
    contours = _lines_of_contours(asked, control, program) if are_compared else []
    kept = []
    for each in (*apart, *own):
        about, reason = ReadIssue.TRUSTED_ABSENT, _absent(each, there, "the program")
        if each.role is NamedAs.REFERENCE:
            about, reason = ReadIssue.REFERENCE_UNUSED, _unclear(each, contours)
        if reason and each.span.line <= 0:
            verb = "cannot be trusted" if each.role is NamedAs.TRUST else "cannot be compared"
            raise NamedWordError(f'--{each.role.value} "{each.text}" {verb}: {reason}')
        if reason:
            context = Context(asked.rules, asked.unit, place=each.span)
            findings.append(report(context, about, Basis.RULE, [], named=each.text, reason=reason))
        else:
            kept.append(each)
    return replace(asked, named=tuple(kept)), tuple(findings)


def _lines_of_contours(asked: Request, control: Control, program: Program) -> list[int]:
    before = control.initial_state(asked.unit)
    found = contours_of(program.blocks, control.find, control.modes, before, asked.start)
    return [each.blocks[0].line for each, _ in found]


def _unclear(named: Named, lines: Sequence[int]) -> str:
    """The reason why it is not clear with which contour words are compared; empty if it is."""
    if not named.words:
        return "write words such as Z-50."
    if not lines:
        return "the program has no contour"
    if len(lines) == 1:
        return ""
    told = ", ".join(map(str, lines[:_MOST_NAMED])) + (", ..." if len(lines) > _MOST_NAMED else "")
    return f"the program has {len(lines)} contours (program lines {told}); write a comment beside the block"


def _absent(named: Named, there: Iterable[Word], where: str) -> str:
    """The reason why words cannot be trusted, and what may be meant; empty if all of them are there."""
    if not named.words:
        return "write words such as Z-50."
    known = {_key(word) for word in there}
    absent = next((word for word in named.words if _key(word) not in known), None)
    if absent is None:
        return ""
    alike = list(dict.fromkeys(word.text.strip() for word in there if word.address == absent.address))
    meant = f"; it has {join(alike[:_MOST_NAMED])}" if alike else f", and no word {absent.address} at all"
    return f"{where} has no word {absent.text.strip()}{meant}"


def _key(word: Word) -> object:
    """The key of a word, which two spellings of it have in common."""
    return word.address, word.number if word.number is not None else word.text.strip(), word.has_point, word.is_asked


# Contours --------------------------------------------------------------------------------------------------------


def mark_trusted(found: ParsedContour, asked: Request) -> ParsedContour:
    """A contour with the places of its words that are right: those that comments beside its blocks name, and those of
    the whole program."""
    beside = [each for _, each in _named_beside(found.blocks)]
    if not beside and not asked.named:
        return found
    texts = {_key(word) for each in (*beside, *asked.named) if each.role is NamedAs.TRUST for word in each.words}
    if not texts:
        return found
    words = (word for block in found.blocks for word in block.words)
    return with_fields(found, trusted=frozenset(word.span for word in words if _key(word) in texts))


def with_named_words(answer: Answer, asked: Request) -> Answer:
    """An answer with the findings about the words that are named for it, and without fixes that change trusted ones."""
    claim = answer.claim
    beside = _named_beside(claim.blocks)
    if not beside and not asked.named:
        return answer
    references: list[tuple[Block | None, Named]] = [
        (None, each) for each in asked.named if each.role is NamedAs.REFERENCE
    ]
    references += [(block, each) for block, each in beside if each.role is NamedAs.REFERENCE]
    findings = [*untouched(answer.diagnostics, claim.blocks, asked)]
    words = [word for block in claim.blocks for word in block.words]
    for _, each in beside:
        reason = _absent(each, words, "the contour") if each.role is NamedAs.TRUST else ""
        if reason:
            context = Context(asked.rules, asked.unit, place=each.span)
            findings.append(report(context, ReadIssue.TRUSTED_ABSENT, Basis.RULE, [], named=each.text, reason=reason))
    if references:
        from contoursolve.diagnosis import compare_reference  # noqa: PLC0415 - few programs have any

        for block, each in references:
            findings += compare_reference(answer, each, block, asked.rules)
    return replace(answer, diagnostics=tuple(sorted(findings, key=rank)))


def named_outside(asked: Request, block: Block) -> Iterator[Diagnostic]:
    """The findings about words that a comment names beside a block that is no contour."""
    for _, each in _named_beside([block]):
        about, reason = ReadIssue.REFERENCE_UNUSED, "there is no contour in this line"
        if each.role is NamedAs.TRUST:
            about, reason = ReadIssue.TRUSTED_ABSENT, _absent(each, block.words, "the line")
        if reason:
            context = Context(asked.rules, asked.unit, place=each.span)
            yield report(context, about, Basis.RULE, [], named=each.text, reason=reason)


# Fixes -----------------------------------------------------------------------------------------------------------


def untouched(findings: Iterable[Diagnostic], blocks: Sequence[Block], asked: Request) -> tuple[Diagnostic, ...]:
    """Findings about some blocks, without the fixes that change words which are right."""
    named = [*asked.named, *(each for block in blocks for each in block.named)]
    if not named:
        return tuple(findings)
    trusted = {_key(word) for each in named if each.role is NamedAs.TRUST for word in each.words}
    if not trusted:
        return tuple(findings)
    syntax = blocks[0].syntax if blocks else ISO

    def keeps(fix: Fix) -> bool:
        old = _count("\n".join([fix.replaced, *(each.old for each in fix.beside)]), syntax)
        new = _count("\n".join([fix.replacement, *(each.text for each in fix.beside)]), syntax)
        return all(new[key] >= old[key] for key in trusted)

    return tuple(replace(each, fixes=tuple(filter(keeps, each.fixes))) if each.fixes else each for each in findings)


def _count(text: str, syntax: Syntax) -> Counter[object]:
    return Counter(_key(word) for line in text.split("\n") for word in parse_block(line, 1, syntax).words)
