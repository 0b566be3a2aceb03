"""Where the tool is when a contour begins: the right start point, or a finding that names the line that lost it."""

import pytest

from contoursolve import Result, solve

CONTOUR = "G111 A180. K-30. B120. X200."


def start_of(result: Result) -> dict[str, float | None]:
    answer = result.answers[-1]
    values = [None if value is None else float(value) for value in answer.start.values]
    return dict(zip(answer.plane.axes, values, strict=True))


def check(result: Result, expected: dict[str, float | None], line: int | tuple[int, ...] | None) -> None:
    """`line` (one or several) made the coordinates unknown that are expected to be None."""
    lines = line if isinstance(line, tuple) else (line,) if line else ()
    assert start_of(result) == pytest.approx(expected)
    lost = [each for each in result.answers[-1].diagnostics if each.code in ("position-unknown", "contour-waits")]
    unknown = tuple(axis for axis, value in expected.items() if value is None)
    assert len(lost) == bool(unknown)
    assert result.answers[-1].contour is None or not unknown
    if unknown and lost[0].code == "position-unknown":
        assert lost[0].addresses == unknown
        assert f"start point is not known in {' and '.join(unknown)}:" in lost[0].message
    if unknown:
        assert all(f"line {line}" in lost[0].message for line in lines)
        assert {label.span.line for label in lost[0].labels[1:]} == set(lines)


HERE = "G00 X40. Z0."  # line 1
LATHE = {
    # name: (blocks before the contour, Z, X as radius, the line that lost the position)
    "absolute words": ("G00 X40. Z0.", 0, 20, None),
    "nothing": ("", None, None, None),
    "one axis only": ("G00 Z5.", 5, None, None),
    "numbers without a point": ("G00 X40000 Z-500", -0.5, 20, None),
    "a zero that is written": ("G00 X0 Z0", 0, 0, None),
    "U and W": (f"{HERE}\nG01 U10. W-5. F0.2", -5, 25, None),
    "U and W twice": (f"{HERE}\nU10.\nW-5. U-4.", -5, 23, None),
    "U before any position": ("G01 U10. W-5.", None, None, None),
    "X with W": (f"{HERE}\nG01 X50. W-2.", -2, 25, None),
    "X and U in one block": (f"{HERE}\nG01 X50. U2.", 0, None, 2),
    "inches": ("G20 G00 X1. Z-2.", -50.8, 12.7, None),
    "inches without a point": ("G20\nG00 X10000 Z0", 0, 12.7, None),
    "back to millimetres": ("G20\nG21\nG00 X40. Z0.", 0, 20, None),
    "arcs": (f"{HERE}\nG02 X50. Z-5. R5.\nG03 X60. Z-10. I5. K0", -10, 30, None),
    "a thread": (f"{HERE}\nG32 Z-20. F1.5", -20, 20, None),
    "dwell X": (f"{HERE}\nG04 X2.", 0, 20, None),
    "dwell P": (f"{HERE}\nG04 P2000", 0, 20, None),
    "offsets written by G10": (f"{HERE}\nG10 P1 X0 Z0", None, None, 2),
    "the offset in force, written by G10": (f"T0101\n{HERE}\nG10 P1 X0 Z0", None, None, 3),
    "another offset, written by G10": (f"T0101\n{HERE}\nG10 P2 X0 Z0", 0, 20, None),
    "another tool": (f"T0101\n{HERE}\nT0202", None, None, 3),
    "the tool that is there": (f"T0101\n{HERE}\nT0101", 0, 20, None),
    "a tool whose offset is taken back": (f"T0101\n{HERE}\nT0100", None, None, 3),
    "another tool, then absolute words": (f"T0101\n{HERE}\nT0202\nG00 Z5.\nX60.", 5, 30, None),
    "another tool, then an increment": (f"T0101\n{HERE}\nT0202\nG00 X60. W5.", None, 30, 3),
    "speed limit": (f"{HERE}\nG50 S2000", 0, 20, None),
    "coordinates set by G50, then a move": ("G28 U0 W0\nG50 X300. Z200.\nG00 U-260. W-200.", 0, 20, None),
    "one coordinate set by G50": (f"{HERE}\nG50 Z5.", 5, 20, None),
    "speeds and feeds": (f"{HERE}\nG96 S180\nG97 S600 M03\nG98 F100\nG99 F0.2\nM08\nG40", 0, 20, None),
    "compensation with a move": (f"{HERE}\nG42 G01 X42. Z-1.", -1, 21, None),
    "comments, empty lines, N and F alone": (f"{HERE}\n(X99.)\n\nN20 F0.2 (Z99.)\n; G28 U0\n%", 0, 20, None),
    "an assignment": (f"{HERE}\n#101 = 5.", 0, 20, None),
    "reference point return": (f"{HERE}\nG28 U0 W0", None, None, 2),
    "reference point return of one axis": (f"{HERE}\nG28 U0", 0, None, 2),
    "reference point return, then absolute": ("G28 U0 W0\nG00 X40. Z0.", 0, 20, None),
    "reference point return, then one axis": ("G28 U0 W0\nG00 Z0.", 0, None, 1),
    "reference point return, then an increment": (f"{HERE}\nG28 U0 W0\nG00 U5. W5.", None, None, 2),
    "machine coordinates": (f"{HERE}\nG53 X100. Z100.", None, None, 2),
    "skip": (f"{HERE}\nG31 Z-20. F50", None, 20, 2),
    "turning cycle, repeated": (f"{HERE}\nG90 X35. Z-20.\nX30.", None, None, (2, 3)),
    "thread cycle": (f"{HERE}\nG92 X35. Z-20. F1.5", None, None, 2),
    "turning cycle, then a move": (f"{HERE}\nG90 X35. Z-20.\nX30.\nG00 X40. Z0.", 0, 20, None),
    "cycle that is in force moves no axis by itself": (f"{HERE}\nG90 X35. Z-20.\nG00 X40. Z0.\nM08", 0, 20, None),
    "roughing cycle": (f"{HERE}\nG71 P100 Q200 U0.4 W0.1 D3000 F0.3", None, None, 2),
    "finishing cycle": (f"{HERE}\nG70 P100 Q200", None, None, 2),
    "threading cycle": (f"{HERE}\nG76 X30. Z-20. K1. D300 F1.5 A60", 0, 20, None),
    "bevel mode": (f"{HERE}\nG11 Z-20. I8.", -20, 28, None),
    "bevel mode goes on": (f"{HERE}\nG11 Z-20. I8.\nX80. K-7.", -27, 40, None),
    "bevel mode without a bevel": (f"{HERE}\nG11 Z-20. I8.\nX80.", None, 40, 3),
    "a line with a bevel": (f"{HERE}\nG01 Z-20. I8.", -20, 28, None),
    "G112": (f"{HERE}\nG112 U0 I10. K-50. R30. C2.", -50 - 800**0.5, 20, None),
    "G112 that is not solved": (f"{HERE}\nG112 U10. I10. K-50. R3.", None, 25, 2),
    "subprogram": (f"{HERE}\nM98 P100", None, None, 2),
    "work coordinates": (f"{HERE}\nG54", None, None, 2),
    "work coordinates with a move": ("G54 G00 X40. Z0.", 0, 20, None),
    "a variable": ("G00 X#101 Z0.", 0, None, 1),
    "an expression": (f"{HERE}\nG01 Z-[#1+2]", None, 20, 2),
    "IF that would stop at a block that is not there": (f"{HERE}\nIF [#1 EQ 0] GOTO 100", 0, 20, None),
    "GOTO": (f"{HERE}\nGOTO 100", None, None, 2),
    "WHILE": (f"{HERE}\nWHILE [#1 LT 5] DO1\n#1 = #1 + 1\nEND1", 0, 20, None),
    "an unknown G code": (f"{HERE}\nG189 X10.", None, None, 2),
    "G91, which a lathe does not have": (f"{HERE}\nG91 Z-5.", None, None, 2),
    "a G code with a decimal": (f"{HERE}\nG54.1 P3", None, None, 2),
    "a new program": (f"{HERE}\nO0002", None, None, 2),
    "a word that cannot be read": (f"{HERE}\nG01 X1.2.3", 0, None, 2),
    "an axis without a number": (f"{HERE}\nG01 Z", None, 20, 2),
    "a line that cannot be read": (f"{HERE}\nG01 X50. ({'A' * 10})" + " X1." * 700, None, None, 2),
    "a stray character": (f"{HERE}\nG01 X50. $", 0, 25, None),
    "block skip": (f"{HERE}\n/G01 X50.", 0, 25, None),
    "block skip of a jump": (f"{HERE}\n/M98 P100", None, None, 2),
    "a contour that is solved": (f"{HERE}\nG111 A180. K-30. B90. X100.", -30, 50, None),
    "a contour that is rejected": (f"{HERE}\nG111 A180. B90. X100.", None, 50, 2),
    "a contour with an error in a word": (f"{HERE}\nG111 A180. K B90. X100.", None, None, 2),
    "a move after a contour that is rejected": (f"{HERE}\nG111 A180. B90. X100.\nG00 Z-30.", -30, 50, None),
}


@pytest.mark.parametrize("name", LATHE)
def test_lathe_contour_starts_where_the_blocks_before_it_lead(name):
    before, z, x, line = LATHE[name]
    check(solve(f"{before}\n{CONTOUR}", control="yasnac-lx3"), {"Z": z, "X": x}, line)
