"""The findings about the block behind a contour, from what its control says of it."""

from msgspec.structs import replace

from contoursolve.diagnosis.examine import Policy, examine
from contoursolve.diagnosis.explain import Context, report
from contoursolve.diagnosis.wording import angle_text, length_text, place_text
from contoursolve.diagnostics import Applicability, Basis, Diagnostic, Fix, LineChange
from contoursolve.gcode import Block
from contoursolve.geometry import FIRST, SECOND
from contoursolve.reading import Behind, Control


def report_behind(found: Behind, control: Control, blocks: tuple[Block, ...]) -> Diagnostic:
    """One finding about what follows these blocks of a contour, with the block that is meant where that has a path."""
    unit = found.state.unit
    context = Context(control.rules, unit, place=found.block.span)
    numbers = {
        **{name: length_text(value, unit) for name, value in found.lengths.items()},
        **{name: angle_text(value) for name, value in found.angles.items()},
    }
    fields = {name: text.format_map(numbers) for name, text in found.fields.items()} | numbers
    basis = Basis.NUMERICAL if found.values else Basis.RULE
    finding = report(context, found.about, basis, found.words, found.values, **fields)
    if found.meant is None:
        return finding
    advice = found.advice
    if found.contour is not None:
        answer = examine(found.contour, control, Policy.ENFORCE)
        if answer.contour is None or any(each.is_error for each in answer.diagnostics):
            return finding
        end = {"end.0": answer.contour.end[FIRST], "end.1": answer.contour.end[SECOND]}
        advice = f"{advice} -> the contour ends at {place_text(answer.profile, end)}"
    own = "\n".join(block.text for block in blocks)
    beside = (LineChange(found.block.span, found.meant.text, found.block.text),)
    fix = Fix(advice, own, Applicability.CHANGES_CONTOUR, replaced=own, beside=beside)
    return replace(finding, fixes=(fix,))
