"""Words that may still be written: those that a block may take, the sets of them that complete it, and the legal forms
of a control."""

from collections.abc import Iterator
from itertools import islice

from contoursolve.diagnosis.answer_records import Addition, Completion
from contoursolve.diagnosis.attempt import Repair
from contoursolve.diagnosis.edits import Edit, EditKind, apply_edits
from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.legality_table import legal_samples
from contoursolve.diagnosis.repairs import find_repairs
from contoursolve.diagnosis.subsets import smallest_sets
from contoursolve.diagnostics import checked
from contoursolve.geometry import assemble
from contoursolve.reading import Control, LegalBlock, ParsedContour, check, read, stating
from contoursolve.solving import Contour, analyse

MOST_ADDED = 3
"""Words that complete a block; of a block that lacks more, all is still open."""

MOST_WAYS = 12


@checked
def words_to_add(answer: Answer) -> tuple[Addition, ...]:
    """Every word that the blocks of a contour may still take: no rule refuses it beside the others, and they do not say
    already what it says."""
    claim, control = answer.claim, answer.read_by.control
    completing: dict[tuple[str, int], tuple[str, Contour | None]] = {}
    if answer.contour is None:
        for edit, repair in _completing_alone(answer):
            completing[edit.address, edit.line] = edit.text, repair.contour
    found, possible = [], {*_possible(claim, control)}
    for name, (address, index) in claim.vocabulary.items():
        line, row = claim.blocks[index].line, claim.lexicon.addresses.get(address)
        # What follows from the others for most values does not where their lines are parallel.
        if name not in possible and (name in claim.words or (address, line) not in completing):
            continue
        text, contour = completing.get((address, line), (claim.lexicon.spell(address, "?"), None))
        blocks = apply_edits(claim.blocks, [Edit(EditKind.ADD, address, text=text, line=line)])
        meaning = claim.form.meanings.get(name) or (row.meaning if row else "")
        found.append(Addition(address, meaning, text, line, "\n".join(blocks), contour))
    return tuple(found)


@checked
def completions(answer: Answer) -> tuple[Completion, ...]:
    """Every single word that would complete the blocks of a contour."""
    found = () if answer.contour is not None else _completing_alone(answer)
    return tuple(Completion(edit.text, repair.replacement, repair.contour) for edit, repair in found)


def _completing_alone(answer: Answer) -> Iterator[tuple[Edit, Repair]]:
    """The words of which one alone completes the blocks of a contour."""
    for repair in find_repairs(answer, answer.read_by.control).repairs:
        edit, *others = repair.edits
        if not others and edit.kind is EditKind.ADD:
            yield edit, repair


def ways_to_complete(answer: Answer) -> tuple[tuple[str, ...], ...]:
    """The smallest sets of addresses that complete the blocks of a contour, each refused by no rule; nothing for one
    that is complete."""
    return tuple(
        tuple(answer.claim.vocabulary[name][0] for name in names)
        for names in islice(_completing(answer.claim, answer.read_by.control), MOST_WAYS)
    )


@checked
def legal_blocks(control: Control) -> tuple[LegalBlock, ...]:
    """Examples of all forms of a control; the smallest sets of words of each."""
    return tuple(
        LegalBlock(form.name, form.title, row.addresses, text)
        for form in control.forms
        if form.table.sample is not None and form.is_contour
        for row, text in legal_samples(form, control)
    )


def _completing(claim: ParsedContour, control: Control) -> Iterator[tuple[str, ...]]:
    """The smallest sets of names that complete a contour."""
    if _is_complete(claim, control, ()):
        return
    possible = [*_possible(claim, control)]
    yield from smallest_sets(possible, MOST_ADDED, lambda names: _is_complete(claim, control, names))


def _is_complete(claim: ParsedContour, control: Control, names: tuple[str, ...]) -> bool:
    """Whether the words of a contour and some more are legal and determine it."""
    if _refusals(claim, control, names, claim.passing):
        return False
    return analyse(assemble(read(stating(claim, names), frozenset()))).is_determined


def _possible(claim: ParsedContour, control: Control) -> Iterator[str]:
    """The names that may be stated besides."""
    refused = _refusals(claim, control, ())
    for name, (address, index) in claim.vocabulary.items():
        block = claim.blocks[index]
        if name in claim.words or address not in claim.lexicon.addresses or block.find(address) is not None:
            continue
        if _refusals(claim, control, (name,)) <= refused:
            system = assemble(read(stating(claim, (name,)), frozenset()))
            tied = {system.facts[fact].given for fact in analyse(system).tied}
            if name not in tied:
                yield name


def _refusals(
    claim: ParsedContour, control: Control, names: tuple[str, ...], without: frozenset[str] = frozenset()
) -> set[str]:
    """The rules that refuse the words of a contour and some more, or ignore one of them, without some circumstances."""
    stated = {name: value for name, value in claim.stated().items() if name not in without} | dict.fromkeys(names)
    return {offence.rule.code for offence in check(control.rules, claim.form.roles, stated)}
