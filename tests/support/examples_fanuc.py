"""The worked examples of the Fanuc and Haas sheets, with the paths that the sheets print."""

import re
from collections.abc import Sequence

from oracle import Element

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


FL_G1 = "G00 X50. Z50.\nG01 ,A30. F0.3\nX0. Z150. ,A-45."
FL_G2 = """G00 X0 Z0
N002 G01 X60. ,A90. ,C1.
N003 Z-30. ,A180. ,R6.
N004 X100. ,A90.
N005 ,A170. ,R20.
N006 X300. Z-180. ,A112. ,R15.
N007 Z-230. ,A180."""
FL_G3 = "G00 X20. Z0\nG01 X40. ,A150.\nZ-30. ,A175."
FL_G4 = "G00 X20. Z0\nG01 Z-25. R5.\nX50. C-3.\nZ-50."
"""Plain words: parameter 3405, bit 4."""
FL_G5 = """%
O1001 (FLANGED STUD, FINISHING)
N1 G21 G40 G99
N2 G50 S2500
N3 T0101 (OD TOOL)
N4 G96 S180 M03
N5 G00 X16. Z2.
N6 G01 Z0 F0.2
N10 X24. ,C1.5
N20 Z-18. ,R3. F0.12
N30 X36. ,A120.
N40 ,A175. ,R8.
N50 X60. Z-55. ,A100. ,C2.
N60 Z-70. ,R2.
N70 X72.
N80 G00 X100. Z50. M05
N90 M30
%
"""
FM_G1 = """G17 G90 G00 X10. Y10.
G01 X50. F10. ,C5.
Y25. ,R8.
G03 X80. Y55. R30. ,R8.
G01 X50. ,R8.
Y70. ,C5.
X10. ,C5.
Y10."""
FM_G2 = "G17 G90 G00 X0 Y0\nG01 X40. ,C6.\nG02 X60. Y20. I20. J0"
FM_G3 = """%
O2001 (PLATE OUTSIDE)
G21 G17 G40 G49 G80 G90
T03 M06
G54 S2400 M03
G43 H03 Z50.
G00 X-40. Y-10. M08
G01 Z-6. F120.
N5 Y0 F300.
N10 Y25. ,C6.
N20 X10. ,R5.
N30 G02 X40. Y5. R25. ,R4.
N40 G01 Y-25. ,R8.
N50 X-10. Y-40. ,C4.
N60 X-40. Y-25. ,R6.
N70 Y0
G00 Z50. M09
M30
%
"""
HM_G1 = "G20 G00 X0 Z0\nG01 X1.0 ,C0.05 F0.01\nZ-0.75 ,R0.1\nX2.0 ,R0.125\nZ-1.5"

EXAMPLES = {
    "FL-G1": (None, FL_G1, "50 50; 104.90381 97.54809; 0 150"),
    "FL-G2": (
        None,
        FL_G2,
        (
            "0 0; 58 0; 60 -1; 60 -24 > cw 72 -30 72 -24; 100 -30; 137.7644 -137.0863 > cw 162.1725 -152.1570 177.1567 "
            "-133.6134; 281.2382 -176.2099 > ccw 300 -190.1176 270 -190.1176; 300 -230"
        ),
    ),
    "FL-G3": (None, FL_G3, "20 0; 40 -17.32051; 42.21862 -30"),
    "FL-G5": (
        None,
        FL_G5,
        (
            "16 0; 21 0; 24 -1.5; 24 -16.2679 > cw 27 -18.8660 30 -16.2679; 36 -21.4641; 40.5139 -47.2611 > cw 53.6746 "
            "-54.4423 56.4530 -46.5639; 56.0608 -54.6527; 60 -57; 60 -68 > cw 64 -70 64 -68; 72 -70"
        ),
    ),
    "FM-G1": (
        MILL,
        FM_G1,
        (
            "10 10; 45 10; 50 15; 50 17.8516 > cw 56.3158 25.6724 58 17.8516; ccw 77.9462 44.0909 50 55; "
            "ccw 70.4939 55 70.4939 47; 58 55 > cw 50 63 58 63; 50 65; 45 70; 15 70; 10 65; 10 10"
        ),
    ),
    "FM-G2": (MILL, FM_G2, "0 0; 34 0; 40.9 5.9321; cw 60 20 60 0"),
    "FM-G3": (
        MILL,
        FM_G3,
        (
            "-40 0; -40 19; -34 25; 9.4795 25 > ccw 10.4649 25.0981 9.4795 30; cw 39.9253 5.3982 15.3923 0.5885; "
            "cw 40 4.6287 36 4.6287; 40 -19.0478 > cw 34.2988 -26.7104 32 -19.0478; -6.1687 -38.8506; "
            "-13.5777 -38.2111; "
            "-36.6833 -26.6584 > cw -40 -21.2918 -34 -21.2918; -40 0"
        ),
    ),
    "HM-G1": (
        HAAS_LATHE,
        HM_G1,
        (
            "0 0; 22.86 0; 25.4 -1.27; 25.4 -16.51 > cw 30.48 -19.05 30.48 -16.51; 44.45 -19.05 > "
            "ccw 50.8 -22.225 44.45 -22.225; 50.8 -38.1"
        ),
    ),
}
