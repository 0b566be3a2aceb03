"""The identities that ship with the package, in the user's words."""

import json
import pkgutil
from collections.abc import Iterable
from functools import lru_cache

from contoursolve.model import Fact, Profile, scalar


def identity(profile: Profile, facts: Iterable[Fact]) -> str:
    """How the words of these facts depend on one another, such as `K = I/tan(A)`; empty where no formula is
    kept. The start point's coordinates are called Zstart, Xstart and so on."""
    names = sorted(fact.given for fact in facts if fact.given)
    formula = _shipped().get(f"{profile.form}: {' '.join(names)}", "")
    for name in sorted(names, key=len, reverse=True):
        word = profile.givens[name].word
        formula = formula.replace(name, word.address if word else f"{profile.givens[name].value:f}")
    for number, axis in enumerate(profile.plane.axes):
        formula = formula.replace(scalar(profile.figure.start, number), f"{axis}start")
    return formula


@lru_cache(maxsize=1)
def _shipped() -> dict[str, str]:
    data = pkgutil.get_data("contoursolve.analysis", "identities.json")
    table: dict[str, str] = json.loads(data) if data else {}
    return table
