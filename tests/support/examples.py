"""How many cases a test takes: a few by default, and the others as slow tests."""

from collections.abc import Callable, Container, Iterable
from functools import reduce
from inspect import Parameter, Signature, signature
from typing import Any

import pytest
from _pytest.mark import ParameterSet
from hypothesis import example, given, settings, strategies as st


def law(
    *strategies: st.SearchStrategy[Any],
    few: int | None = None,
    many: int | None = None,
    derandomize: bool = True,
    examples: Iterable[tuple[Any, ...]] = (),
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """In the place of `given`: held against the few examples of the profile dev by default, and against the many of the
    profile ci as a slow test, and always against `examples`. Parameters before those of the strategies are fixtures."""
    dev, ci = settings.get_profile("dev"), settings.get_profile("ci")
    counts = {
        "few": few or dev.max_examples,
        "many": many or ci.max_examples,
    }

    def hold(check: Callable[..., None]) -> Callable[..., None]:
        @pytest.mark.parametrize("count", ["few", pytest.param("many", marks=pytest.mark.slow)])
        def test(count: str, **fixtures: Any) -> None:
            profile = settings(dev, derandomize=derandomize, max_examples=counts[count])
            held = reduce(lambda test, each: example(*each)(test), examples, given(*strategies)(check))
            profile(held)(**fixtures)

        names = list(signature(check).parameters)[: -len(strategies)]
        wanted = [Parameter(name, Parameter.POSITIONAL_OR_KEYWORD) for name in ("count", *names)]
        test.__signature__ = Signature(wanted)  # type: ignore[attr-defined]
        test.__doc__ = check.__doc__
        return test

    return hold


def some_of(
    names: str | tuple[str, ...], cases: Iterable[Any], *, only: Container[Any], **options: Any
) -> pytest.MarkDecorator:
    """In the place of `pytest.mark.parametrize`: all cases are slow but those with these ids or first values."""
    is_single = isinstance(names, str) and "," not in names
    taken = list[ParameterSet]()
    for each in cases:
        case = each if isinstance(each, ParameterSet) else pytest.param(*([each] if is_single else each))
        if case.id not in only and case.values[0] not in only:
            case = pytest.param(*case.values, marks=(*case.marks, pytest.mark.slow), id=case.id)
        taken.append(case)
    return pytest.mark.parametrize(names, taken, **options)


def control_of(text: str) -> str:
    """The first two controls of a test's program: others read words of the mill, too."""
    return "nct-99m" if text.startswith("G17") or "\nG17" in text else "yasnac-lx3"


def few_and_many(few: Any, many: Any, name: str = "count", **options: Any) -> pytest.MarkDecorator:
    """One case by default, and one more as a slow test."""
    return pytest.mark.parametrize(name, [few, pytest.param(many, marks=pytest.mark.slow)], **options)
