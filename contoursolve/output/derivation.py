"""The calculation of a contour by hand as text."""

from collections.abc import Iterator

from contoursolve.diagnosis import Calculation, CalculationLine, Derivation
from contoursolve.numeric import symbolic
from contoursolve.output.plain_text import columns


def derivation_lines(derivation: Derivation) -> Iterator[str]:
    """The steps with their formulas, the same with numbers, and the results."""
    yield "  calculation by hand (X of a lathe as radius):"
    for number, step in enumerate(derivation.steps, 1):
        yield f"    {number}. {step.title}"
        yield from columns([_cells(line, step) for line in step.lines], left=(0, 1, 2, 3), indent="       ")


def _cells(line: CalculationLine, step: Calculation) -> tuple[str, str, str, str]:
    """The symbol, the formula, the numbers with the result, and what that is."""
    result = value_text(line)
    if step.is_searched:
        return symbolic.text(line.symbol), f"= {result}", "", ""
    formula = symbolic.text(line.formula)
    numbers = numbers_text(line)
    shown = f"= {numbers} = {result}" if numbers else f"= {result}"
    return symbolic.text(line.symbol), f"= {formula}", shown, line.meaning


def numbers_text(line: CalculationLine) -> str:
    """A formula with its numbers; empty where that is the result itself."""
    return "" if line.formula.is_Symbol else line.numbers


def value_text(line: CalculationLine) -> str:
    """A result with its unit."""
    return f"{line.value:z.4f} {line.unit}".rstrip()
