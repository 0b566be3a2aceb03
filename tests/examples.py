"""Laws of whatever hypothesis draws: held against few examples by default, and against many as a slow test."""

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st


def law(
    *strategies: st.SearchStrategy[Any], few: int = 20, many: int = 80, derandomize: bool = True
) -> Callable[[Callable[..., None]], Callable[[int], None]]:
    """In the place of `given`."""

    def hold(check: Callable[..., None]) -> Callable[[int], None]:
        @pytest.mark.parametrize("count", [few, pytest.param(many, marks=pytest.mark.slow)])
        def test(count: int) -> None:
            settings(derandomize=derandomize, deadline=None, max_examples=count)(given(*strategies)(check))()

        test.__doc__ = check.__doc__
        return test

    return hold
