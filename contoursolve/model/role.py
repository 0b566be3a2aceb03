"""Which rules of a manual apply to which blocks of a contour."""

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Role:
    """What some blocks of a contour are together, by the name under which rules speak of it.

    `prefixes` begin the names of what each of these blocks states. A rule about one block sees the names without
    the prefix, a rule about several sees `1:`, `2:`, ... in its place.
    """

    name: str
    prefixes: tuple[str, ...] = ("",)

    def names(self, stated: Iterable[str]) -> dict[str, str]:
        """Of the names that a contour states, those of this role, by what its rules call them."""
        if self.prefixes == ("",):
            return {name: name for name in stated}
        calls = ("",) if len(self.prefixes) == 1 else tuple(f"{number}:" for number in range(1, len(self.prefixes) + 1))
        return {
            call + name.removeprefix(prefix): name
            for name in [name for name in stated if name.startswith(self.prefixes)]
            for prefix, call in zip(self.prefixes, calls, strict=True)
            if name.startswith(prefix)
        }
