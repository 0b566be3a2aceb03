"""A lookup over plain mappings, for numbers and symbols of every kind."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from contoursolve.model import scalar


@dataclass(frozen=True, slots=True)
class Values:
    """`scalars` holds coordinates and radii by name, `amounts` and `directions` the givens."""

    scalars: Mapping[str, Any]
    amounts: Mapping[str, Any]
    directions: Mapping[str, tuple[Any, Any]]

    def coordinate(self, point: str, axis: int) -> Any:
        return self.scalars[scalar(point, axis)]

    def radius(self, name: str) -> Any:
        return self.scalars[name]

    def amount(self, given: str) -> Any:
        return self.amounts[given]

    def direction(self, given: str) -> tuple[Any, Any]:
        return self.directions[given]
