"""Blocks that are refused whatever the values of their free words: they cannot be read, or have the wrong words."""

from collections.abc import Iterator, Mapping
from itertools import pairwise

from contoursolve.diagnostic import Basis, Severity
from contoursolve.examine import Answer
from contoursolve.families.kinds import limits_of, value_of
from contoursolve.families.ranges import FamilyError
from contoursolve.families.template import RefusedError, Template
from contoursolve.reading import Trouble
from contoursolve.solving import Status
from contoursolve.tolerance import LARGEST

Refusals = frozenset[tuple[str, int, tuple[str, ...]]]
"""Findings by code, line and words."""


def check_block(template: Template, values: Mapping[str, float] | None = None) -> None:
    """Raise RefusedError where a block is refused whatever the values of its free words; `values` are those of one row,
    without it those that the words have in the block.

    Rules treat the values between two of their limits alike. Word by word, the value with the fewest refusals is
    taken; what then is left does not depend on the values.
    """
    answer = template.solve(values or {})
    left = _refusals(answer)
    if not left:
        return
    chosen = dict(values or {name: value_of(word, answer) for name, word in template.words.items()})
    limits = zip(chosen, *limits_of(template, chosen), strict=True) if chosen else ()
    for name, scale, bounds in limits:
        for value in _probes(bounds):
            tried = {**chosen, name: value / scale}
            try:
                found = _refusals(template.solve(tried))
            except FamilyError:  # with this value it is no single contour
                continue
            if _weight(found) < _weight(left):
                left, chosen = found, tried
            if not left:
                return
    raise RefusedError(template.examined())


def _refusals(answer: Answer) -> Refusals:
    """What refuses a block by its text, its words or the structure of its equations."""
    if answer.status not in _REFUSED:
        return frozenset()
    errors = (each for each in answer.diagnostics if each.severity is Severity.ERROR)
    return frozenset(
        (each.code, each.span.line, each.addresses)
        for each in errors
        if each.basis is not Basis.NUMERICAL or each.about in _USELESS
    )


_REFUSED = (Status.REJECTED, Status.CONFLICTING, Status.UNDERDETERMINED)
"""What a block may be without its values."""


def _weight(refusals: Refusals) -> tuple[int, int]:
    """How much is refused: findings, and the words that they name."""
    return len(refusals), sum(len(words) for _, _, words in refusals)


_USELESS = (Trouble.FACT_UNREADABLE, Trouble.FACT_IMPOSSIBLE)
"""Findings about facts that cannot be used, whatever they rest on."""


def _probes(bounds: tuple[float, ...]) -> Iterator[float]:
    """A value on each limit of the rules and between each two, as far as values are read."""
    inner = [each for each in bounds if abs(each) < LARGEST]
    yield from inner
    # Near the least of them, for what is large may fit nowhere.
    for low, high in pairwise((-LARGEST, *inner, LARGEST)):
        step = min(1.0, (high - low) / 2)
        yield low + step if low >= 0 else high - step
