"""Rules about what a drawing gives: those about chains of free elements, in the words of a drawing."""

from collections.abc import Mapping

from contoursolve.controls.heidenhain.lexicon import PlaneWords
from contoursolve.controls.heidenhain.rules import rules_in
from contoursolve.controls.rule_rows import row
from contoursolve.diagnostics import Source
from contoursolve.reading import Rule

_OTHERS = "heidenhain-"
_OF_MACHINES = frozenset(
    f"{_OTHERS}{name}"
    for name in (
        *("arc-sense", "pole-half", "pole-empty", "block-illegal", "centre-missing", "radius-missing", "corner-first"),
        *("corner-apart", "corner-size", "corner-outside-plane", "chamfer-beside-arc", "turns", "continued"),
        *("tangent-arc", "tool-axis"),
    )
)
"""Rules about what a drawing has not: moves of a machine, calls, poles between elements."""

_SAID: Mapping[str, tuple[str, str]] = {
    "sense": ("it is not said to which side the arc turns", "say cw (clockwise) or ccw"),
    "point-1": ("{words}: of this point one coordinate is missing", "give both coordinates"),
    "distance-alone": ("{words}: a distance needs the line to which it is parallel", "give PAR and the number of it"),
    "block-missing": ("{words}: no element of this number stands before it", "give the number of an earlier element"),
    "block-no-line": ("{words} is the number of an arc, and RAN needs a line", "give the number of a line"),
    "pole-missing": ("{words}: polar data need a pole, and the drawing has none", "give the pole of the drawing"),
    "tangent-first": (
        "it is the first element, and nothing is before it to which it could be tangent",
        "say that it is not tangent, and give its direction AN",
    ),
    "corner-without-next": (
        "{words}: a corner needs an element after it, and none follows",
        "add the next line or arc, or leave the corner out",
    ),
    "turns-back": (
        "the arc goes back on the circle of the arc before it: it turns the other way",
        "let both turn the same way, or say that it is not tangent",
    ),
    "no-word": ("{words} is no field of a line or an arc", "leave it out"),
    "repeated": ("{words} is given twice for this element", "leave one of them out"),
    "redundant": ("", "nothing has to be changed: the drawing says it twice, and both agree"),
}
"""Message (empty: as the rule has it) and advice of rules in the words of a drawing, by the end of their code."""


def drawing_rules(words: PlaneWords, source: Source) -> tuple[Rule, ...]:
    """The rules about a drawing with these words."""
    return tuple(_told(rule, source) for rule in rules_in(words) if rule.code not in _OF_MACHINES)


def _told(rule: Rule, source: Source) -> Rule:
    if not rule.code.startswith(_OTHERS):
        return rule
    name = rule.code.removeprefix(_OTHERS)
    message, advice = _SAID.get(name, ("", ""))
    return row(f"drawing-{name}", message, advice, source, like=rule, alarm=None)
