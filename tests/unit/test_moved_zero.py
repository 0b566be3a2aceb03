"""What moves the coordinate system: offsets, shifts, frames and tools, in a contour's block, in the one beside, or in
none. A shift by numbers moves the place, a table makes it unknown, and what is in force again moves nothing."""

import pytest

from contoursolve import CONTROLS, OpenProgram, expand, solve
from contoursolve.reading import ZeroMove

FRAMES = "G17 G71 G90 G54\n{}\nG0 X0 Y0\n{}\nG1 X20 RND=5 F300\nY20\nM30"
PROGRAMS = {
    "siemens-840d": FRAMES,
    "siemens-808d": FRAMES,
    "isg": "G17 G71 G90\n{}\nG0 X0 Y0\n{}\nG1 X20 #RND=5 F300\nY20\nM30",
    "heidenhain": "0 BEGIN PGM A MM\n{}\n4 L X+0 Y+0 R0 FMAX\n{}\n6 L X+20 R0 F300\n7 RND R5\n8 L Y+20\n9 END PGM A MM",
    "fanuc-mill": "G21 G17 G90 G54\n{}\nG00 X0. Y0.\n{}\nG01 X20. ,R5. F300.\nY20.\nM30",
    "fanuc-lathe": "{}\nG00 X40. Z0.\n{}\nG01 X60. ,C2. F0.2\nZ-20.\nM30",
    "yasnac-lx3": "{}\nG00 X40. Z0.\n{}\nG111 A180. K-30. B90. X100.\nM30",
    "cnc-pilot": "{}\nBEARBEITUNG\nG0 X40 Z0\n{}\nG1 X50 A20 B-2\nG1 Z-30\nENDE",
}
PROGRAMS["haas-mill"] = PROGRAMS["mitsubishi"] = PROGRAMS["nct-99m"] = PROGRAMS["fanuc-mill"]
PROGRAMS["haas-lathe"] = PROGRAMS["fanuc-lathe"]
AT, UNKNOWN = (0.0, 0.0), (None, None)
LATHE = (0.0, 20.0)
ZX = "G18\nG0 Z0"

MOVES = [
    # (control, what is in force where the position is stated, what moves it, the start of the contour)
    ("siemens-840d", "", "TRANS X10", (-10, 0)),
    ("siemens-840d", "", "TRANS X10 Y5\nG0 X1\nTRANS", (11, 0)),
    ("siemens-840d", "TRANS X10\nATRANS X5", "G58 X20", (-10, 0)),
    ("siemens-840d", "TRANS X10\nATRANS X5\nG58 X20", "G59 X10", (-5, 0)),
    ("siemens-840d", "TRANS X10", "G59 X10 Y0\nG59 X10", (-10, 0)),
    ("siemens-840d", "TRANS X10 Y5", "TRANS X3", (7, None)),
    ("siemens-840d", "ATRANS X5", "TRANS X3", UNKNOWN),
    ("siemens-840d", "ROT RPL=30", "TRANS", UNKNOWN),
    ("siemens-840d", "ROT RPL=30", "TRANS X5", UNKNOWN),
    ("siemens-840d", "", "G70\nTRANS X1\nG71", (-25.4, 0)),
    ("siemens-840d", "", "TRANS X=R1", (None, 0)),
    ("siemens-840d", "", "/TRANS X5", UNKNOWN),
    ("siemens-840d", "", "IF R7==1\nTRANS X5\nENDIF", (None, 0)),
    ("siemens-840d", "", "IF R7==1\nTRANS X5\nENDIF\nG0 X0\nTRANS X7", UNKNOWN),
    ("siemens-840d", "TRANS X10", "$P_PFRAME=CTRANS(X,15,Y,2)", (-5, -2)),
    ("siemens-840d", "TRANS X10", "$P_PFRAME=$P_PFRAME:CTRANS(X,5)", UNKNOWN),
    ("siemens-840d", "", "$P_PFRAME=CROT(Z,30)", UNKNOWN),
    ("siemens-840d", "", "$P_PFRAME=CTRANS(X,R1)", UNKNOWN),
    ("siemens-840d", "", "$P_IFRAME=CTRANS(X,1)", UNKNOWN),
    ("siemens-840d", "", "$P_UIFR[1]=CTRANS(X,1)", AT),
    ("siemens-840d", "", "$P_UIFR[1,X,TR]=5\nG54", UNKNOWN),
    ("siemens-840d", "", "G54", AT),
    ("siemens-840d", "", "G500", UNKNOWN),
    ("siemens-840d", "", "G53 X5", (None, 0)),
    ("siemens-840d", "", "D2", AT),
    ("siemens-840d", ZX, "D2\nG18 G1 Z5 RND=2\nX30\nM30", UNKNOWN),
    ("siemens-840d", "TRANS X5", "AROT", UNKNOWN),
    *(("siemens-840d", "", each, UNKNOWN) for each in ("TOFF[X]=3", "TCARR=1", "AX[X]=5", "AX[AXV]=5")),
    *(
        ("siemens-840d", ZX, f"{each}\nG18 G1 Z5 RND=2\nX30\nM30", UNKNOWN)
        for each in ("DL=1", "TOFFL=2", "$TC_DP3[1,1]=5", "$TC_DP12[R1,1]=R2")
    ),
    ("siemens-840d", "", "TOFFL=2\nDL=1\n$TC_DP3[1,1]=5\n$TC_DP6[1,1]=4", AT),
    ("siemens-808d", "", "G58", UNKNOWN),
    ("siemens-808d", "", "G58 G0 X3 Y0", (3, 0)),
    ("isg", "", "G53", AT),
    ("isg", "", "G54", UNKNOWN),
    ("isg", "", "G54\nG91 X0\nG90", UNKNOWN),
    ("isg", "G159=2", "G159=2", AT),
    ("isg", "G159=2", "G159=3", UNKNOWN),
    ("isg", "", "G92 X5", (-5, 0)),
    ("isg", "G92 X5", "G91 G92 X3\nG90", (-3, 0)),
    ("isg", "", "V.G.NP_AKT.V.X = 10", (None, 0)),
    ("isg", "", "$IF P1==1\nV.G.NP_AKT.ALL = V.G.NP[2].ALL\n$ENDIF", UNKNOWN),
    ("isg", "G54", "V.G.NP_AKT.V.X += 5\nG0 X1 Y1\nG54", UNKNOWN),
    ("isg", "G54", "V.G.NP[1].V.Y = 5", (0, None)),
    ("isg", "G159=1", "V.G.NP[P1].V.Y = 5", (0, None)),
    ("isg", "G55", "V.G.NP[1].V.X = 5\nV.G.TIMER[1] = 5", AT),
    ("isg", "", "V.G.WZ_AKT.L = 5", UNKNOWN),
    ("heidenhain", "", "TOOL CALL 5 Z S1000 DR+0.1", AT),
    ("heidenhain", "CYCL DEF 7.1 X+60", "TRANS DATUM RESET\nL X+0 Y+0\nCYCL DEF 7.1 X+0", UNKNOWN),
    ("heidenhain", "", "L X+5 M99", UNKNOWN),
    ("heidenhain", "", "L X+5 M89\nL X+5 Y+5", UNKNOWN),
    ("heidenhain", "", "L X+5 M89\nL X+5 Y+5 M99\nL X+3 Y+4", (3, 4)),
    ("heidenhain", "", "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+60\nCYCL DEF 7.2 Y-5", (-60, 5)),
    ("heidenhain", "CYCL DEF 7.1 X+60", "CYCL DEF 7.1 IX+5", (-5, 0)),
    ("heidenhain", "CYCL DEF 7.1 IX+5", "CYCL DEF 7.1 X+0", (5, 0)),
    ("heidenhain", "CYCL DEF 7.1 X+60", "CYCL DEF 7.1 #5", UNKNOWN),
    ("heidenhain", "CYCL DEF 10.1 ROT+30", "CYCL DEF 7.1 X+5", UNKNOWN),
    ("heidenhain", "", "CYCL DEF 7.1 X+Q5", (None, 0)),
    ("heidenhain", "", "L X+5 M91", (None, 0)),
    *(
        ("heidenhain", "", each, UNKNOWN)
        for each in ("CYCL DEF 247 DATUM ~\nQ339=+4", "CYCL DEF 8.1 X", "CYCL DEF 26.1 X2", "PLANE RESET STAY")
    ),
    ("fanuc-mill", "", "G10 L2 P1 X10. Y0.", UNKNOWN),
    ("fanuc-mill", "", "G10 L50\nN1221 P1 R100\nG11", UNKNOWN),
    ("fanuc-mill", "", "#5221=#5221+10.", (None, 0)),
    ("fanuc-mill", "", "#2502=7.\n#2601=#2601+10.", (0, None)),
    ("haas-mill", "G110", "G154 P1", AT),
    ("haas-mill", "G154 P2", "G110", UNKNOWN),
    ("haas-mill", "G110", "G10 L20 P1 X1.", (None, 0)),
    ("haas-mill", "G110", "G10 L20 P2 X1.\n#7021=3.", AT),
    ("mitsubishi", "", "G52 X5.", (-5, 0)),
    ("fanuc-lathe", "T0101", "T0202", UNKNOWN),
    ("fanuc-lathe", "T0101", "T0", UNKNOWN),
    ("haas-lathe", "T0101", "T0101", LATHE),
    ("fanuc-lathe", "G54 T0101", "G10 L2 P1 X5.", (0, None)),
    ("fanuc-lathe", "G54 T0101", "G10 L2 P2 X5.\nG10 P2 X5.\n#2002=1.\n#5242=1.", LATHE),
    ("fanuc-lathe", "T0101", "G10 P10001 X5.", UNKNOWN),
    ("fanuc-lathe", "T0101", "#1=101\n#[2000+#1]=1.", UNKNOWN),
    ("yasnac-lx3", "T0202", "T0200", UNKNOWN),
    ("yasnac-lx3", "T0202", "T0202", LATHE),
    ("cnc-pilot", "", "T2", UNKNOWN),
]


def starts(text: str, control: str) -> list[tuple[float | None, ...]]:
    values = (answer.start.values for answer in solve(text, control=control).answers)
    return [tuple(None if value is None else float(value) for value in each) for each in values]


def test_a_place_that_a_refused_corner_states_moves_with_the_zero_though_it_was_not_known_before():
    move = "G153 G0 X3\nG1 X54 RND=2\n$P_PFRAME=CTRANS(X,17)\nY4"
    assert starts(PROGRAMS["siemens-840d"].format("", move), "siemens-840d")[1] == (37, 4)


@pytest.mark.parametrize(("control", "before", "move", "start"), MOVES)
def test_what_moves_the_zero_moves_the_place_or_makes_it_unknown(control, before, move, start):
    result = solve(PROGRAMS[control].format(before, move), control=control)
    (answer, *_) = result.answers
    assert starts(PROGRAMS[control].format(before, move), control)[0] == pytest.approx(start)
    assert (answer.contour is None) is (None in start)
    lost = [each for each in answer.diagnostics if each.code == "position-unknown"]
    assert [f"in {' and '.join(each.addresses)}:" in each.message for each in lost] == [True] * (None in start)
    assert all("program line" in each.message for each in lost)


HELD = {
    "fanuc-mill": ("G21 G17 G90 G54\nG00 X0. Y0.\n{}G01 X20. ,R5. F300.\n{}Y20.\nM30", "G55 ", "G54 "),
    "fanuc-lathe": ("T0101\nG00 X40. Z0.\n{}G01 X60. ,C2. F0.2\n{}Z-20.\nM30", "T0202 ", "T0101 "),
    "siemens-840d": ("G17 G71 G90 G54\nG0 X0 Y0\n{}G1 X20 RND=5 F300\n{}Y20\nM30", "G55 ", "G54 "),
    "isg": ("G17 G71 G90 G159=1\nG0 X0 Y0\n{}G1 X20 #RND=5 F300\n{}Y20\nM30", "G159=2 ", "G159=1 "),
}
HELD |= dict.fromkeys(("haas-mill", "mitsubishi", "nct-99m"), HELD["fanuc-mill"])
HELD |= {"haas-lathe": HELD["fanuc-lathe"], "siemens-808d": HELD["siemens-840d"]}


@pytest.mark.parametrize("control", HELD)
def test_in_the_blocks_of_a_corner_an_offset_is_refused_or_leaves_the_start_unknown(control):
    program, other, same = HELD[control]
    plain = solve(program.format("", ""), control=control).answers[0].contour
    assert plain is not None
    # Otherwise the 808D leaves that corner out.
    settings = {"siemens-808d.no-second-move": "error"} if control == "siemens-808d" else {}
    for places, expected in (
        ((other, ""), "unknown"),
        (("", other), "zero-moves"),
        (("", f"{other.strip()}\n"), "corner-without-next"),
    ):
        (answer, *_) = solve(program.format(*places), control=control, settings=settings).answers
        assert answer.contour is None
        assert [each.code.partition("-")[2] for each in answer.diagnostics] == [expected]
    again = solve(program.format(same, same), control=control).answers[0].contour
    assert again is not None
    assert again.points == plain.points


@pytest.mark.parametrize("control", HELD)
def test_no_coordinate_is_written_that_was_not_known(control):
    program, other, _ = HELD[control]
    for places in ((other, ""), ("", other)):
        text = program.format(*places)
        written = expand(text, control=control, keep_going=True).text
        assert [line for line in written.splitlines() if "NOT EXPANDED" not in line] == text.splitlines()


KLARTEXT = "0 BEGIN PGM A MM\n1 L X+0 Y+0 R0 FMAX\n2 L X+20 R0 F300{}\n3 RND R5\n4 L Y+20{}\n5 L X+60 Y+40"
FREE = "0 BEGIN PGM A MM\n1 L X+0 Y+0 R0 FMAX\n2 FL AN+30 LEN20{}\n3 FL X+60 Y+40\n4 L Y+80"


@pytest.mark.parametrize("text", [KLARTEXT.format(" M91", ""), KLARTEXT.format("", " M92"), FREE.format(" M91")])
def test_no_contour_has_coordinates_of_the_machine(text):
    plain = solve(text.replace(" M91", "").replace(" M92", ""), control="heidenhain")
    result = solve(text, control="heidenhain")
    assert [each.contour is None for each in plain.answers] == [False]
    assert all(each.contour is None for each in result.answers)
    assert result.diagnostics


@pytest.mark.parametrize(
    ("control", "shift", "end", "last"),
    [
        ("siemens-840d", "TRANS X5", "M17", "M30"),
        ("siemens-840d", "TRANS X5", "RET", "M2"),
        ("fanuc-mill", "G52 X5.", "M99", "M30"),
    ],
)
def test_what_others_call_does_not_know_the_shift_in_force(control, shift, end, last):
    text = f"G17 G90\nG0 X0 Y0\n{shift}\nG1 X20. {',R' if 'mill' in control else 'RND='}5. F300.\nY20.\n{{}}"
    opened = OpenProgram(text.format(last), control=control)
    for ends, start in ((last, (-5, 0)), (end, UNKNOWN), ("", (-5, 0))):
        assert starts(text.format(ends), control) == [start]
        opened.replace(text.format(ends))
        assert opened.check()
        assert any(each.code == "position-unknown" for each in opened.diagnostics) is (start is UNKNOWN)
        written = expand(text.format(ends), control=control, keep_going=True).text
        assert ("NOT EXPANDED" in written) is (start is UNKNOWN)


@pytest.mark.parametrize("word", ["M91", "M99"])
def test_behind_a_refused_contour_nothing_is_known_by_words_that_are_not_read(word):
    text = f"0 BEGIN PGM A MM\n1 L X+0 Y+0\n2 FL AN+30 LEN20\n3 FL X+60 Y+40 {word}\n4 L X+80\n5 RND R2\n6 L Y+60"
    assert starts(text, "heidenhain") == [AT, UNKNOWN]


SELECTIONS = [
    (control, name)
    for control, tables in CONTROLS.items()
    for name, row in tables.modes.zero.names.items()
    if row.move is ZeroMove.SELECT and row.axes_in("G17") != ("Z",) and not "G505" < name < "G599"
]


@pytest.mark.parametrize(("control", "name"), SELECTIONS)
def test_each_selection_of_a_table_makes_the_place_unknown_but_for_the_one_in_force(control, name):
    word = f"{name}{ {'T': '0303', 'G154': ' P3', 'G54.1': ' P3', 'G159': '=3'}.get(name, '') }"
    before = {"G54": "G55", "T": "T0101"}.get(name, "G54")
    program = PROGRAMS[control]
    start = starts(program.format(before, word), control)[0]
    again = starts(program.format(word, word), control)[0]
    assert None not in again
    assert None in start


@pytest.mark.parametrize(
    ("control", "text", "told"),
    [
        (
            "fanuc-mill",
            "G17 G90 G54\nG0 X0 Y0\nG1 X20. ,R5. F300.\n(A)\nG52 X10.\nY40.",
            "G52 X10. in program line 5 moves",
        ),
        ("siemens-840d", "G17 G71 G90\nG0 X0 Y0\nG1 X20 RND=5\nTRANS X10\nY40", "TRANS X10 in program line 4 moves"),
        (
            "siemens-840d",
            "G17 G71 G90\nSUB\nM30\nPROC SUB\nG0 X0 Y0\nG1 X20 RND=5\nTRANS X10\nY40\nRET",
            "TRANS X10 in program line 7 moves",
        ),
    ],
)
def test_a_corner_right_before_a_moved_zero_is_told_why(control, text, told):
    (error,) = [each.message for each in solve(text, control=control).diagnostics if each.is_error]
    assert told in error
    assert error.endswith("move it before the contour")
