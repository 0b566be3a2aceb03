"""The identities that ship with the package, in the user's words."""

import json
import pkgutil
from collections.abc import Iterable
from functools import lru_cache


def identity(form: str, givens: Iterable[str]) -> str:
    """How these words of a form depend on one another, such as `K = I/tan(A)`; empty where no formula is kept."""
    return _shipped().get(f"{form}: {' '.join(sorted(givens))}", "")


@lru_cache(maxsize=1)
def _shipped() -> dict[str, str]:
    data = pkgutil.get_data("contoursolve.analysis", "identities.json")
    table: dict[str, str] = json.loads(data) if data else {}
    return table
