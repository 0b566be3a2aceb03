"""What is said twice of the part that is determined, where something else is missing."""

from contoursolve.analysis import judge
from contoursolve.constraints import assemble
from contoursolve.model import Profile
from contoursolve.settling.restrict import restrict
from contoursolve.solving import Refusal, RefusalKind, Remark, RemarkKind
from contoursolve.solving.affine import affine_facts
from contoursolve.solving.alternatives import Alternative, find_alternatives
from contoursolve.solving.compare import compare_affine

_COMPARED = (
    RefusalKind.WORDS_DISAGREE,
    RefusalKind.FACT_DISAGREES,
    RefusalKind.RADIUS_DIFFERENCE,
    RemarkKind.WORDS_AGREE,
)


def said_twice(profile: Profile) -> tuple[Refusal | Remark, ...]:
    """How the facts that are not needed compare with the others, as far as these determine what they speak about.

    Facts about lines are compared whatever the others leave free. Of the others, where they leave several places, the
    one with which most of them agree counts.
    """
    affine = affine_facts(profile, profile.facts)
    if affine is not None:
        return tuple(compare_affine(profile, affine))
    system = assemble(profile)
    free = judge(system).free
    part = restrict(profile, (name for name in system.unknowns if name not in free))
    if len(part.facts) <= len(assemble(part).unknowns) or not judge(assemble(part)).is_determined:
        return ()
    items = find_alternatives(part).items
    compared = [tuple(event for event in _events(item) if event.kind in _COMPARED) for item in items]
    return min(compared, key=_disagreements) if compared else ()


def _events(item: Alternative) -> tuple[Refusal | Remark, ...]:
    return (*item.solution.refusals, *item.solution.remarks)


def _disagreements(events: tuple[Refusal | Remark, ...]) -> int:
    return sum(isinstance(event, Refusal) for event in events)
