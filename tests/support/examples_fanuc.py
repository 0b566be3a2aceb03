"""The worked examples of the Fanuc and Haas sheets, and paths as sheets print them."""

import re
from collections.abc import Sequence

from oracle import Element
from vectors import VECTORS, program_of

LATHE, MILL, HAAS_LATHE, HAAS_MILL = "fanuc-lathe", "fanuc-mill", "haas-lathe", "haas-mill"


def drawn(text: str, share: float) -> list[Element]:
    """A path as the sheets print it, `X Z` or `X Y` of each end, behind an arc its sense and its centre; `share` is
    that of X which is a radius."""
    found: list[Element] = []
    at: complex | None = None
    for part in re.split(r" *[;>] *", text):
        numbers = [float(number) for number in re.findall(r"-?\d+\.?\d*", part)]
        there = place(numbers, share)
        if at is not None:
            turn = next((turn for turn in ("ccw", "cw") if part.startswith(turn + " ")), "")
            center = place(numbers[2:], share) if turn else None
            radius = abs(there - center) if center is not None else 0.0
            found.append(Element("arc" if turn else "line", at, there, center, radius, turn))
        at = there
    return found


def place(numbers: Sequence[float], share: float) -> complex:
    """X stands first on a lathe, too; there Z is the first axis."""
    return complex(numbers[1], numbers[0] / 2) if share == 0.5 else complex(*numbers[:2])


FL_G1, FL_G5 = (program_of(LATHE, f"FL-G{number}") for number in (1, 5))
FM_G1, FM_G2, FM_G3 = (program_of(MILL, f"FM-G{number}") for number in (1, 2, 3))

EXAMPLES = [
    (control, row)
    for control in (LATHE, MILL, HAAS_LATHE)
    for name, row in VECTORS[control].items()
    if re.match(r"[FH][LM]-G", name)
]
"""The worked examples: control and vector."""
