"""A script as a user writes it, every line of which a type checker understands; it runs, too."""

from collections.abc import Mapping
from typing import assert_type

import numpy

import contoursolve
from contoursolve import Answer, ArcSegment, Contour, Diagnostic, LineSegment, OpenProgram, Result, Status

BLOCK = "G111 X100. A180. K-30. B120. P5. Q5."
START = {"X": 40.0, "Z": 0.0}


def lengths(contour: Contour) -> dict[str, float]:
    """The length of each element, mm."""
    return {element.name: element.length for element in contour.elements}


def radii(contour: Contour) -> list[float]:
    return [element.radius for element in contour.elements if isinstance(element, ArcSegment)]


def first_words(findings: tuple[Diagnostic, ...]) -> list[str]:
    return [fix.replacement for finding in findings for fix in finding.fixes if finding.is_error]


result = contoursolve.solve(BLOCK, start=START, control="yasnac-lx3", units="mm", rules="enforce", depth="full")
assert_type(result, Result)
answer = result.answer
assert_type(answer.status, Status)
contour = answer.contour
assert contour is not None
assert_type(contour.elements, tuple[LineSegment | ArcSegment, ...])
assert_type(contour.end, tuple[float, float])
print(lengths(contour), radii(contour), first_words(contoursolve.check("G111 X100. A180. B120.", start="X40. Z0.")))

shaft = contoursolve.system(BLOCK, start=START)
for equation in shaft.equations:
    print(equation.lhs, equation.rhs)
print(shaft.jacobian.shape, shaft.rank, {symbol.name: value for symbol, value in shaft.solution.items()})
print(sorted(symbol.name for symbol in shaft.values), shaft.function("shaft").name(), shaft.free("B").is_determined)
assert_type(shaft.subs(B=150.0).solve().is_complete, bool)

family = contoursolve.family(
    BLOCK, start=START, vary={"A": numpy.linspace(170, 180, 3), "P": [1, 5]}, branches="chosen"
)
assert_type(family.shape, tuple[int, ...])
print(family.to_xarray().sizes, family["V2 Z"].mean(), family.summary()[Status.SOLVED])

allowed = contoursolve.ranges(BLOCK, "P", start=START, units="mm")
assert_type(allowed.intervals[0].high.value, float)
slopes: Mapping[str, Mapping[str, float]] = contoursolve.sensitivity(BLOCK, start=START).slopes
print(slopes["V2 Z"]["K"], contoursolve.tolerances(BLOCK, "A", keep="end Z", within=0.1, start=START).high.value)

program = OpenProgram(f"G00 X40. Z0.\n{BLOCK}", units="mm", rules="warn")
assert_type(program.check(), bool)
answers: list[Answer] = [each.answer for each in program.contours]
for name in contoursolve.CONTROLS:
    print(name, contoursolve.CONTROLS[name].title, len(answers))
written = contoursolve.expand(program.text, post="linuxcnc", arcs="radius", block_numbers="first")
assert_type(written.text, str | None)
converted = contoursolve.convert(program.text, "fanuc-lathe", comments=False, rules="off")
report = contoursolve.solve(program.text, tool="R0.4, tip 3", side="right", outside="roll").tool
assert report is not None
print(converted.control, [run.largest_radius for run in report.runs])
