"""Facts about a whole line or circle that hold beyond the part of it that is cut."""

from collections.abc import Iterator

from contoursolve.diagnosis.explain import Context, report
from contoursolve.diagnosis.wording import place_text
from contoursolve.diagnostics import Basis, Diagnostic
from contoursolve.geometry import (
    Arc,
    CornerShape,
    Profile,
)
from contoursolve.reading import ReadIssue
from contoursolve.solving import Contour, LineSegment, SystemSolution, is_on, lookup, scalars_of
from contoursolve.tolerance import AGREEMENT


def explain_beyond(
    context: Context, profile: Profile, solution: SystemSolution, contour: Contour
) -> Iterator[Diagnostic]:
    """The facts that hold at a place of a line or a circle that the path does not reach."""
    at = lookup(profile, {**solution.scalars, **scalars_of(solution.points), **solution.radii})
    cut = {segment.name: segment for segment in contour.elements}
    fillets = (corner.name for corner in profile.figure.corners if corner.shape is CornerShape.FILLET)
    round_ones = {f"{name}.center": name for name in fillets}
    round_ones |= {arc.center: arc.name for arc in profile.figure.path if isinstance(arc, Arc)}
    ends = {point for element in profile.figure.path for point in (element.tail, element.head)}
    for fact in profile.facts:
        # How far a line is from another one holds of all of it, wherever the end of that lies.
        if not fact.given or fact.from_line in ends:
            continue
        for name, place in fact.places(at):
            segment = cut.get(round_ones.get(name, name))
            if segment is not None and not is_on(segment, place, AGREEMENT):
                word, shown = profile.givens[fact.given].word, place_text(profile, scalars_of({"": place}))
                whole, about = "line" if isinstance(segment, LineSegment) else "circle", ReadIssue.FACT_BEYOND
                yield report(context, about, Basis.NUMERICAL, [word], element=segment.name, whole=whole, place=shown)
