"""How many examples a law takes, and whose words a program is in."""

from collections.abc import Callable, Iterable
from functools import reduce
from inspect import Parameter, Signature, signature
from typing import Any

import pytest
from hypothesis import example, given, settings, strategies as st


def law(
    *strategies: st.SearchStrategy[Any],
    few: int | None = None,
    many: int | None = None,
    examples: Iterable[tuple[Any, ...]] = (),
) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """In the place of `given`: two cases, with the few examples of the profile dev and with the many of the profile ci,
    and always with `examples`. Parameters before those of the strategies are fixtures."""
    dev, ci = settings.get_profile("dev"), settings.get_profile("ci")
    counts = {"few": few or dev.max_examples, "many": many or ci.max_examples}

    def hold(check: Callable[..., None]) -> Callable[..., None]:
        @pytest.mark.parametrize("count", ["few", "many"])
        def test(count: str, **fixtures: Any) -> None:
            profile = settings(dev, max_examples=counts[count])
            held = reduce(lambda test, each: example(*each)(test), examples, given(*strategies)(check))
            profile(held)(**fixtures)

        names = list(signature(check).parameters)[: -len(strategies)]
        wanted = [Parameter(name, Parameter.POSITIONAL_OR_KEYWORD) for name in ("count", *names)]
        test.__signature__ = Signature(wanted)  # type: ignore[attr-defined]
        test.__doc__ = check.__doc__
        return test

    return hold
