"""Lines that nobody reads into words come to the same as those that are read: in findings, contours and places."""

from unittest import mock

import pytest
from hypothesis import strategies as st

import contoursolve
from contoursolve.gcode import lexer
from contoursolve.reading import PlainLines
from tests.support.examples import law

_KLARTEXT = (
    "5 L X+{} Y-{} R0 F500", "L Z+{} FMAX", "CC X+{} Y+{}", "CR X+{} Y+{} R-{} DR- RL", "C X+{} Y+{} DR+", "L X{} RR",
    "; note", "CC", "L IX+{}", "RND R5", "CT X+{} Y+{}", "FL X+{} Y+{}", "FL AN+30", "APPR LT X+{} Y+{} LEN5",
    "l x+{}", "", "Q1 = {}", "L X+Q1 Y-{}",
)  # fmt: skip
_SINUMERIK = (
    "G1 X{} Y{} F500", "N5 G3 X{} Y{} CR={}", "G1 X={} Y=AC({})", "; note", "X{} Y{}", "G2 X{} Y{} I{} J5", "G0 Z{}",
    "X=IC({})", "X1={}", "G91", "G90", "G18", "X{} RND=3", "G1 X{} ANG=30", "CT X{} Y{}", "T1", "G1 X{} I{}", "RNDM=1",
    "", "R1={}", "X=R1 Y={}",
)  # fmt: skip
_ISG = (
    "G01 X{} Y{} F500", "G3 X={} Y{} R{}", "G2 X{} Y{} I{} J5 (a) ; b", "(note)", "X{} Y{}", "G0 Z{}", "#COMMENT BEGIN",
    "#COMMENT END", "G91", "G90", "G52", "X{} #RND=3", "G1 X{} #ANG=30", "G302 I2", "G1 X{}+5", "N7", "",
    "P1={}", "X=P1 Y{}",
)  # fmt: skip
_MACROS = (
    "G01 X{} Y{} F200", "X{} Y{}", "X{} ,R3", "#1={}", "#2=#1+{}", "#3=[#1*2]/SIN[30]", "G1 X#1 Y{}", "X-#2 Y[#1+{}]",
    "(note)", "G02 X{} Y{} R{}", "G91", "G90", "IF[#1 GT 50]GOTO 9", "N9 Y{} ,A30", "X{} ,A60", "/X{}",
)  # fmt: skip
_LINES = {
    "heidenhain": ("0 BEGIN PGM T MM\n1 L X+0 Y+0 R0 FMAX", _KLARTEXT, "L X+200 Y+200\nRND R5\nL X+250 Y+300"),
    "siemens-840d": ("G17 G90\nG0 X0 Y0 Z5", _SINUMERIK, "G1 X200 RND=5\nG1 X300 Y300"),
    "isg": ("G17 G90\nG0 X0 Y0", _ISG, "G1 X200 #RND=5\nG1 X300 Y300"),
    "fanuc-mill": ("G17 G90\nG0 X0 Y0", _MACROS, "G1 X200. ,R5.\nG1 X300. Y300."),
}
"""Of each control the begin of a program, lines, and a contour that tells where the tool is."""


def told(text: str, control: str) -> object:
    result = contoursolve.solve(text, control=control, depth="verdict")
    return result.diagnostics, [(each.start, each.contour, each.diagnostics) for each in result.answers]


@pytest.mark.parametrize("control", _LINES)
@law(
    st.lists(st.tuples(st.integers(0, 40), st.integers(-90, 90).map(lambda number: number / 4)), max_size=40),
    few=2,
    many=50,
)
def test_what_plain_lines_come_to_is_the_same_read_or_not(control, drawn):
    begin, lines, end = _LINES[control]
    # Every other one is plain.
    rows = [lines[place % (len(lines) if place % 2 else 4)].replace("{}", f"{number:.2f}") for place, number in drawn]
    text = "\n".join((begin, *rows, end)).replace("+-", "-").replace("--", "-")
    with mock.patch.object(lexer, "MANY_LINES", 0):
        plain = told(text, control)
    with mock.patch.object(PlainLines, "has", return_value=False):
        assert told(text, control) == plain
