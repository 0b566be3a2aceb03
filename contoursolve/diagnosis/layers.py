"""Which checks a contour went through, what each found, and which could not run, and why."""

from contoursolve.analysis import decompose, judge
from contoursolve.constraints import OnCircle, System, assemble
from contoursolve.diagnostic import Basis, Layer, Severity, Verdict
from contoursolve.examine import Answer, Policy
from contoursolve.model import Profile
from contoursolve.reading import Trouble, read
from contoursolve.solving import RefusalKind, RemarkKind
from contoursolve.syntax import FaultKind


def list_layers(answer: Answer, policy: Policy) -> tuple[Layer, ...]:
    """The six checks of a contour, in order. A check that could not run has found nothing and passed nothing."""
    claim = answer.claim
    # Further facts belong to the profile that was solved; those of ignored words are left out there as well.
    whole = read(claim, frozenset(fact.given for fact in answer.profile.ignored))
    whole = answer.profile if whole.is_extended else whole
    grammar = [each for each in answer.diagnostics if each.about in _GRAMMAR]
    refused = [each for each in answer.diagnostics if each.basis is Basis.RULE and _counts(each.severity)]
    refused = [each for each in refused if each.about not in _GRAMMAR and each.about is not Trouble.START_IN_INCREMENTS]
    layers = [_layer("grammar", bool(grammar), f"{_count(claim.blocks, 'block')}, every character")]
    if any(block.faults for block in claim.blocks):
        layers.append(Layer("rules", Verdict.NOT_RUN, "not every word could be read"))
    elif policy is Policy.OFF:
        layers.append(Layer("rules", Verdict.NOT_RUN, "switched off"))
    else:
        layers.append(_layer("rules", bool(refused), "which words may stand together"))
    blocked = "not every word could be read" if grammar else ""
    if blocked:
        return (*layers, *(Layer(name, Verdict.NOT_RUN, blocked) for name in _EQUATIONS))
    system = assemble(whole)
    return (*layers, *_equations(answer, whole, system))


_GRAMMAR = (
    *FaultKind,
    Trouble.REPEATED_ADDRESS,
    Trouble.UNKNOWN_ADDRESS,
    Trouble.VARIABLE,
    Trouble.FACT_UNREADABLE,
    Trouble.FACT_IMPOSSIBLE,
    Trouble.ASKED_NOTHING,
    Trouble.VALUE_TOO_LARGE,
)
_EQUATIONS = ("structure", "generic rank", "values", "geometry")


def _equations(answer: Answer, profile: Profile, system: System) -> list[Layer]:
    parts, verdict = decompose(system), judge(system)
    size = f"{_count(system.facts, 'equation')}, {_count(system.unknowns, 'unknown')}"
    # A point of a circle may be given besides its centre: the control compares the radii, and so do we.
    spare = [system.facts[index] for index in range(len(system.facts)) if index not in verdict.basis]
    is_over = any(not isinstance(fact, OnCircle) for fact in spare)
    if spare and not is_over:
        size += f", {_count(tuple(spare), 'check')}"
    layers = [_layer("structure", bool(parts.under_unknowns or (parts.over_facts and is_over)), size)]
    rank = f"rank {verdict.rank} of {len(system.unknowns)}, exact"
    # A condition on points and not on words says nothing to a reader.
    if verdict.condition and verdict.condition != "1" and "." not in verdict.condition:
        rank += f"; determined unless {verdict.condition} = 0"
    layers.append(_layer("generic rank", bool(verdict.free or is_over), rank))
    blocked = ""
    if not profile.start.is_known:
        blocked = "the start point is not known"
    elif verdict.free:
        blocked = "words are missing"
    elif any(each.basis is Basis.STRUCTURAL for each in answer.diagnostics):
        blocked = "a corner or a choice is not determined"
    numerical = [each for each in answer.diagnostics if each.basis is Basis.NUMERICAL]
    about_values = [each for each in numerical if each.about in _ABOUT_VALUES]
    found_any = _layer("values", bool(about_values), "regular at these values, and words agree")
    if blocked:
        values = found_any if about_values else Layer("values", Verdict.NOT_RUN, blocked)
        return [*layers, values, Layer("geometry", Verdict.NOT_RUN, blocked)]
    layers.append(found_any)
    if any(each.basis is Basis.RULE and each.severity is Severity.ERROR for each in answer.diagnostics):
        return [*layers, Layer("geometry", Verdict.NOT_RUN, "a rule refuses the block")]
    found = any(each.severity is Severity.ERROR and each not in about_values for each in numerical)
    if about_values and not found and answer.contour is None:
        return [*layers, Layer("geometry", Verdict.NOT_RUN, "the points are not determined")]
    return [*layers, _layer("geometry", found, "intersections exist, direction of travel, room for corners")]


_ABOUT_VALUES = (
    RefusalKind.LINES_PARALLEL,
    RefusalKind.NOT_FIXED,
    RefusalKind.POINT_IS_START,
    Trouble.FACTS_SINGULAR,
    RefusalKind.WORDS_DISAGREE,
    RefusalKind.FACT_DISAGREES,
    RefusalKind.RADIUS_DIFFERENCE,
    RemarkKind.WORDS_AGREE,
    RemarkKind.SENSITIVE,
)


def _layer(name: str, has_found: bool, remark: str) -> Layer:
    return Layer(name, Verdict.FOUND if has_found else Verdict.PASSED, remark)


def _counts(severity: Severity) -> bool:
    return severity is not Severity.INFO


def _count(things: tuple[object, ...], noun: str) -> str:
    return f"{len(things)} {noun}{'' if len(things) == 1 else 's'}"
