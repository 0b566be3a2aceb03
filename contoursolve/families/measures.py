"""What the numbers of a family are measured in, column by column."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from contoursolve.examine import Answer
from contoursolve.families.kinds import unit_of
from contoursolve.families.ranges import FamilyError
from contoursolve.families.several import asked_of
from contoursolve.families.template import Template, is_same
from contoursolve.model import Unit
from contoursolve.syntax import Word


@dataclass(frozen=True, slots=True)
class Measure:
    """The unit of a column (mm, inch, deg; empty for one without), and where it matters whether it is the `radius` or
    the `diameter` that is meant."""

    unit: str
    measure: str = ""

    def attributes(self, unit: str = "unit") -> dict[str, str]:
        """As plain names and texts, where the unit goes by this name."""
        found = {unit: self.unit, "measure": self.measure}
        return {name: text for name, text in found.items() if text}


def measures_of(template: Template, values: Mapping[str, float], names: Iterable[str]) -> dict[str, Measure]:
    """The measures of some columns; `values` are those of any row."""
    answer = template.solve(values)
    plane = answer.plane
    radial = {axis for axis, is_diameter in zip(plane.axes, plane.diameters, strict=True) if is_diameter}
    asked = asked_of(answer.profile)
    found: dict[str, Measure] = {}
    for name in names:
        head, _, axis = name.rpartition(".")
        if name in template.words:
            found[name] = measure_of_word(template.words[name], answer)
        elif name in ("status", "reason") or head == "branch":
            found[name] = Measure("")
        elif name in asked:
            is_angle = asked[name].unit is Unit.DEGREE
            found[name] = Measure("deg" if is_angle else "mm", "radius" if asked[name].is_diameter else "")
        else:
            found[name] = Measure("mm", "radius" if axis in radial else "")
    return found


def measure_of_word(word: Word, answer: Answer) -> Measure:
    """What a word of a block or of the start point, or a fact, is written in; no unit for one that only chooses between
    two places, and where nothing tells."""
    try:
        kind = unit_of(word, answer)
    except FamilyError:
        return Measure("")
    if kind is not Unit.MM:
        return Measure("deg" if kind is Unit.DEGREE else "")
    row = answer.claim.lexicon.addresses.get(word.address)
    given = next((each for each in answer.profile.givens.values() if each.word and is_same(word, each.word)), None)
    is_diameter = row.is_diameter if row is not None else given is not None and given.is_diameter
    return Measure(answer.unit.value, "diameter" if is_diameter else "")
