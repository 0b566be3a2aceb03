"""Where things stand on the page of a report: lines, contours and findings, and what points at what."""

from dataclasses import dataclass, field

from contoursolve.diagnostic import Diagnostic, Label
from contoursolve.examine import Answer
from contoursolve.pipeline import Result


@dataclass(frozen=True, slots=True)
class Marked:
    """A stretch of a line that a finding marks."""

    label: Label
    finding: Diagnostic
    target: str


@dataclass(frozen=True, slots=True)
class Places:
    """The addresses on the page."""

    lines: frozenset[int]
    contour_at: dict[int, int] = field(default_factory=dict)
    """The number of the contour that a line belongs to, from 1."""
    number_of: dict[int, int] = field(default_factory=dict)
    """The number of each finding by its identity."""
    marks: dict[int, list[Marked]] = field(default_factory=dict)
    """What findings mark, by line."""

    def line(self, number: int) -> str | None:
        """The address of a line; None for what was stated apart from the program."""
        return f"#line-{number}" if number in self.lines else None

    def finding(self, finding: Diagnostic) -> str:
        """The name of a finding."""
        return f"finding-{self.number_of[id(finding)]}"


def find_places(result: Result) -> Places:
    """The places of everything that a result holds."""
    places = Places(frozenset(block.line for block in result.program.blocks))
    for number, answer in enumerate(result.answers, 1):
        for line in answer.lines:
            places.contour_at.setdefault(line, number)
    for number, finding in enumerate(result.diagnostics, 1):
        places.number_of[id(finding)] = number
        for label in finding.labels:
            marked = Marked(label, finding, f"#finding-{number}")
            places.marks.setdefault(label.span.line, []).append(marked)
    return places


def contour_name(answer: Answer, number: int) -> str:
    """What a heading calls a contour."""
    form = answer.claim.form
    return f"Contour {number}, line {answer.lines[0]}: {form.name} ({form.title})"
