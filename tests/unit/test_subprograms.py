"""Worked examples wrapped in calls and profiles, with parameters; subprograms in files; what is told about calls."""

import re

import pytest
from click.testing import CliRunner

from contoursolve import CONTROLS, Status, expand, solve
from contoursolve.cli import main
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.output.document import to_json

LATHE, MILL, SINUMERIK, KLARTEXT = "fanuc-lathe", "fanuc-mill", "siemens-840d", "heidenhain"
TAPER = "G01 X60. ,A120."


def not_followed(result) -> list[tuple[int, str]]:
    return [(each.span.line, each.message) for each in result.diagnostics if each.code == "not-followed"]


def run(command: str, *words: object) -> tuple[int, str]:
    done = CliRunner().invoke(main, [command, *map(str, words)])
    return done.exit_code, done.output


# The same contours, written out and called ---------------------------------------------------------------------------


def test_calls_that_are_written_out_leave_each_block_number_once():
    cuts = "G71 U2. R1.\nG71 P10 Q60 U.5 W.1 F.3\nN10 G00 X16.\nG01 Z0.\n{}N60 {}Z-20.\n"
    corner, written = cuts.format("X30. ,C1.5\n", ""), cuts.format("G01 X27. Z0.\nG01 X30. Z-1.5\n", "G01 X30. ")
    begin, end = "O1\nG00 X64. Z2.\n", "N80 M30\n"
    arc = "G01 X{}. Z{}.\nG03 X{}. Z{}. I0. K-{}.\n"
    once, first, second = (arc.format(*at) for at in ((76, -30, 80, -32, 2), (67, 2, 69, 1, 1), (72, -3, 74, -4, 1)))
    for text, lines in (
        (
            f"{corner}N70 M98 P2\n{end}O2\nN10 G01 X70. Z-30.\nN70 X80. ,R2.\nN90 Z-50.\nM99",
            f"{written}G01 X70. Z-30.\n{once}N90 G01 X80. Z-50.\n",
        ),
        (
            f"{corner}N70 M98 P2 L2\n{end}O2\nN90 G01 U5. ,R1.\nN91 W-5.\nN92 M99",
            f"{written}N90 {first}N91 G01 X69. Z-3.\n{second}G01 X74. Z-8.\n",
        ),
        (f"M98 P2\n{end}O2\n{corner}M99", written),
    ):
        inline = expand(begin + text, control=LATHE, inline=True, comments=False)
        assert (inline.text, inline.summary.left) == (begin + lines + end, [])
    twice = expand(f"{begin}M98 P2 L2\n{end}O2\n{corner}M99", control=LATHE, inline=True, keep_going=True)
    told = "G71 names N10, which stands twice in a program without calls"
    assert told in {each.reason for each in twice.summary.left}


@pytest.mark.parametrize(("value", "place", "cut"), [("1", 50, "G01 X50. F.2\n"), ("2", 40, "")])
def test_words_behind_then_run_if_the_condition_holds(value, place, cut):
    text = f"#100={value}\nG00 X40. Z0.\nIF [#100 EQ 1] THEN G01 X50. F.2\nG01 Z-20. ,R1.\nX60."
    corner = f"G01 X{place}. Z-19.\nG02 X{place + 2}. Z-20. I1. K0."
    written = expand(text, control="haas-lathe", inline=True, comments=False).text
    assert written == f"G00 X40. Z0.\n{cut}{corner}\nG01 X60. Z-20."
    in_doubt = solve(text.replace(f"={value}\n", "=#5041\n"), control="haas-lathe").answers[0]
    assert in_doubt.start.values == (0, None)


# Files ---------------------------------------------------------------------------------------------------------------


def test_decisions_in_another_file_are_made_as_well(tmp_path):
    (tmp_path / "plan.h").write_text(
        "BEGIN PGM PLAN MM\n; REMARK\n; REMARK\n; REMARK\n"
        "FN 9: IF +Q1 EQU +2 GOTO LBL 5\nL X+10 Y+10 F100\nLBL 5\nEND PGM PLAN MM"
    )
    main_program = tmp_path / "main.h"
    for value, status in ((1, Status.SOLVED), (2, Status.UNDERDETERMINED)):
        main_program.write_text(f"BEGIN PGM A MM\nQ1 = {value}\nCALL PGM PLAN.H\nFL X+40 AN+30\nEND PGM A MM")
        assert [each.status for each in solve(main_program).answers] == [status]


CALLING = {
    "M98": ("G21 G99\nG00 X60. Z2.\nM98 P8001\nM30", {"O8001.nc": "O8001\nG01 X30. F0.2\nZ-10. ,R{}\nX40.\nM99"}),
    "G65 through another": (
        "G21 G90\nG00 X0. Y0.\nG65 P1 A10.\nM30",
        {"O0001.nc": "O1\nM98 P2\nM99", "O0002.nc": "O2\nG17 G01 X#1 ,R{} F100\nY10.\nM99"},
    ),
    "G111": ("G00 X40. Z0.\nM98 P5\nM30", {"O0005.nc": "O5\nG111 X100. A180. K-30. B120. P{}\nM99"}),
    "L10": ("G17 G90 G0 X0 Y0\nL10\nM30", {"L10.SPF": "G1 X10 RND={} F100\nY10\nM17"}),
    "POCKET": ("G17 G90 G0 X0 Y0\nPOCKET\nM30", {"POCKET.SPF": "G1 X10 RND={} F100\nY10\nRET"}),
    "CYCLE95": (
        'G18 G90 DIAMON G0 X60 Z2\nCYCLE95("CONTOUR",2,0,0,0,0.3,0.2,0.1,9,0,0,0.5)\nM30',
        {"CONTOUR.SPF": "G1 X20 Z0 F.2\nZ-10 RND={}\nX40\nM17"},
    ),
    "CALL PGM": ("L X+0 Y+0 R0 F100\nCALL PGM SUB.H\nM30", {"SUB.H": "FL X+10 AN+0\nRND R{}\nFL AN+90 Y+10"}),
    "LL": ("%MAIN\nG17 G90 G0 X0 Y0\nLL SUB\nM30", {"SUB.nc": "%L SUB\nG1 X10 #RND={} F100\nY10\nM29"}),
}


@pytest.mark.parametrize("call", CALLING)
@pytest.mark.parametrize("is_right", [True, False])
def test_the_control_is_told_from_what_is_called_and_contours_there_are_found(call, is_right, tmp_path):
    text, files = CALLING[call]
    main_program = tmp_path / ("main.h" if call == "CALL PGM" else "main.nc")
    main_program.write_text(text)
    for name, sub in files.items():
        (tmp_path / name).write_text(sub.format("2." if is_right else "200."))
    told = "is solved" if is_right else "does not fit"
    status, output = run("check", main_program)
    assert (status, told in output, "no contour of its own examined" in output) == (not is_right, True, True), output
    _, output = run("expand", main_program)
    assert ("in this file: nothing to expand" in output, told in output) == (True, True), output
    assert ("expand --inline writes it out" in output) is is_right
    if call != "CYCLE95":
        assert run("expand", "--inline", main_program)[0] == (not is_right)


def test_comments_and_files_that_call_each_other_end(tmp_path):
    (tmp_path / "main.nc").write_text("(FLANGE)\nG00 X60. Z2.\nM98 P1\nM30")
    (tmp_path / "O0001.nc").write_text("O1\nM98 P2\nM99")
    (tmp_path / "O0002.nc").write_text("O2\nM98 P1\nM99")
    (tmp_path / "FLANGE.txt").write_text("FL X+10 AN+0")
    status, output = run("check", tmp_path / "main.nc")
    assert (status, "nothing to solve" in output) == (0, True), output


# Parts that do not run -----------------------------------------------------------------------------------------------

_BEGIN = "G17 G90 G0 X5 Y5\n"
_OTHER = "N20 G01 X50. ,A110.\nN30 G00 X100. Z5.\nG01 X110. ,A100."
_SLOT = "G0 X0 Y0\nIF R1<>1 GOTOF SLOT\nG1 Y80 ANG=60\nGOTOF ENDS\nSLOT: G1 Y70 ANG=50"
BRANCHES = {
    LATHE: (
        f"#100={{0}}\nG00 X40. Z0.\nIF [#100 EQ 2] GOTO 20\n{TAPER}\nZ-40. ,R3.\nX80.\nGOTO 30\n{_OTHER}\nM30",
        [((4,), 0, 20), ((5, 6), -(10 / 3**0.5), 30), ((8,), 0, 20), ((10,), 5, 50)],
    ),
    SINUMERIK: (
        f"R1={{0}}\n{_BEGIN}IF R1==1\nG1 X20 ANG=45\nELSE\nIF R1==2\nG1 X30 ANG=30\nENDIF\nENDIF\n{_SLOT}\nENDS: M30",
        [((4,), 5, 5), ((7,), 5, 5), ((12,), 0, 0), ((14,), 0, 0)],
    ),
    "isg": (
        f"P1={{0}}\n{_BEGIN}$IF P1==1\nG1 X20 #ANG=45\n$ELSE\nG1 X30 #ANG=30\n$ENDIF\nM30",
        [((4,), 5, 5), ((6,), 5, 5)],
    ),
    KLARTEXT: (
        "Q1 = {0}\nL X+10 Y+10\nFN 9: IF +Q1 EQU +2 GOTO LBL 5\nFL X+40 AN+30\nLBL 5\nL X+10 Y+10\nFL X+50 AN+20",
        [((4,), 10, 10), ((7,), 10, 10)],
    ),
}
"""Programs with a decision, and the lines and the starts of all contours, those of the other way among them."""


@pytest.mark.parametrize("control", BRANCHES)
@pytest.mark.parametrize("value", [1, 2])
def test_a_part_that_does_not_run_begins_where_the_decision_was_made(control, value):
    text, expected = BRANCHES[control]
    result = solve(text.format(value), control=control)
    assert [(each.lines, *map(float, each.start.values)) for each in result.answers] == [
        (lines, pytest.approx(first), pytest.approx(second)) for lines, first, second in expected
    ]
    assert {each.status for each in result.answers} == {Status.SOLVED}
    documents = Document("", text.format(value).encode()), Document("", to_json(result).encode())
    assert verify(*documents).verdict is ReceiptVerdict.VERIFIED


@pytest.mark.parametrize(("value", "starts"), [(1, [21, 30]), (2, [20, 20])])
def test_words_behind_then_move_the_part_that_does_not_run(value, starts):
    text = f"#100={value}\nG00 X40. Z0.\nIF [#100 EQ 1] THEN G01 X42.\nIF [#100 EQ 2] GOTO 20\nG01 X60. A120.\nN20 "
    answers = solve(f"{text}G01 X70. A110.\nM30", control="haas-lathe").answers
    assert [each.start.values[1] for each in answers] == starts


# Loops and jumps -----------------------------------------------------------------------------------------------------

STEP = "G1 X=IC(10) RND=1\nY=IC(10)"
INNER = {
    "LOOP": f"LOOP\nIF R2>=2 GOTOF EX2\nR2=R2+1\n{STEP}\nENDLOOP",
    "WHILE": f"WHILE R2<9\nIF R2>=2 GOTOF EX2\nR2=R2+1\n{STEP}\nENDWHILE",
    "FOR": f"FOR R2=1 TO 9\nIF R2>2 GOTOF EX2\n{STEP}\nENDFOR",
    "REPEAT": f"REPEAT\nIF R2>=2 GOTOF EX2\nR2=R2+1\n{STEP}\nUNTIL R2>9",
    "IF in LOOP": f"LOOP\nIF R2>=2\nGOTOF EX2\nELSE\nR2=R2+1\n{STEP}\nENDIF\nENDLOOP",
}
OUTER = {
    "FOR": "FOR R1=1 TO 2\nR2=0\n{}\nEX2:\nENDFOR",
    "WHILE": "WHILE R1<2\nR1=R1+1\nR2=0\n{}\nEX2:\nENDWHILE",
    "LOOP": "LOOP\nR1=R1+1\nR2=0\n{}\nEX2: IF R1>=2 GOTOF ALLEND\nENDLOOP\nALLEND:",
    "REPEAT": "REPEAT\nR1=R1+1\nR2=0\n{}\nEX2:\nUNTIL R1>=2",
    "IF": "LOOP\nR1=R1+1\nIF R1<=2\nR2=0\n{}\nEX2:\nELSE\nGOTOF ALLEND\nENDIF\nENDLOOP\nALLEND:",
}


@pytest.mark.parametrize("inner", INNER)
@pytest.mark.parametrize("outer", OUTER)
def test_a_jump_ends_the_loops_that_it_leaves(inner, outer):
    text = f"G17 G90 G0 X0 Y0\nR1=0\n{OUTER[outer].format(INNER[inner])}\nM30"
    result = solve(text, control=SINUMERIK)
    assert [each.start.values for each in result.answers] == [(10 * at, 10 * at) for at in range(4)]
    assert not result.diagnostics
    assert expand(text, control=SINUMERIK, inline=True).summary.replaced == 4


FANUC_LOOP = """G21 G90 G0 X0. Y0.
#1=0
#3=0
WHILE[#1 LT 2]DO1
#1=#1+1
#2=0
WHILE[#2 LT 9]DO2
#2=#2+1
IF[#2 GT 2]GOTO 50
#3=#3+10.
G1 X#3 ,R1. F100
Y#3
END2
N50
END1
M30"""


def test_jumps_out_of_and_into_loops_of_macro_b():
    result = solve(FANUC_LOOP, control=MILL)
    assert [each.start.values for each in result.answers] == [(10 * at, 10 * at) for at in range(4)]
    into = solve(FANUC_LOOP.replace("#1=0", "GOTO 60").replace("#2=#2+1", "N60 #2=1"), control=MILL)
    told = "program line 2 jumps into the loop that program line 4 begins: how often that runs then is not known"
    assert not_followed(into) == [(2, told)]
    assert {each.status for each in into.answers} == {Status.UNDERDETERMINED}


@pytest.mark.parametrize(
    ("setting", "passes", "line"),
    [
        pytest.param("100", 34, 5, marks=pytest.mark.boundary),
        pytest.param("101", 34, None, marks=pytest.mark.boundary),
        (None, 3_000, 4),
        ("20000", 3_000, None),
    ],
)
def test_a_loop_that_may_never_end_is_followed_as_far_as_a_setting_says(setting, passes, line):
    """Of its three blocks all run again in each pass but the first, and the head once more at the end."""
    text = f"#1=0\nWHILE[#1 LT {passes}]DO1\n#1=#1+1.\nEND1\nG0 X0. Y0.\nG1 X20. ,R1. F1.\nY20."
    result = solve(text, control=MILL, settings={f"{MILL}.most-blocks": setting} if setting else {})
    told = "blocks run again: the program may never end; --setting fanuc-mill.most-blocks=NUMBER follows more of them"
    most = f"{int(setting or 5_000):,}"
    assert not_followed(result) == ([] if line is None else [(line, f"more than {most} {told}")])


@pytest.mark.slow
def test_each_pass_of_a_loop_is_told_with_its_own_values_and_the_first_ones_are_explained():
    passes = 101
    text = f"#1=1\nWHILE [#1 LE {passes}] DO1\nG00 X40. Z0.\nG01 X60. Z-[#1*0.5] ,A170.\n#1=#1+1\nEND1\nM30"
    found = [each for each in solve(text, control=LATHE).diagnostics if each.code == "words-conflict"]
    assert len(found) == passes
    for number, each in enumerate(found, 1):
        assert f"-[#1*0.5] is -{number / 2:.1f}".removesuffix("0").removesuffix(".") in "".join(each.notes)
        assert all("Z-[#1*0.5]" in fix.replacement for fix in each.fixes if ",A170." not in fix.replacement)
        assert ("only the first 100" in "".join(each.notes), bool(each.fixes)) == (number > 100, number <= 100)


# What is told of calls and jumps -------------------------------------------------------------------------------------


def test_a_loop_that_ends_by_what_nobody_knows_is_not_said_to_run_for_ever():
    program = "O1\n#1=5.\nN5 #1=#1-#5041\nG01 X10. ,R1.\nY10.\nX0\nY0\nIF[#1 GT 0]GOTO6\nN6 GOTO5\nM30"
    told = "program line 9 goes back again and again: what ends that is not known, so it is followed no further"
    assert not_followed(solve(program, control=MILL, start="X0 Y0")) == [(9, told)]


ENDS = {
    "fanuc": ("O1\nG21 G90 G0 X0. Y0.\n{}\nO9001\nG1 X10. ,R1. F100\nY10.\nM99", "M98 P9001", ("M30", "M02", "M99")),
    "siemens": ("O1\nG90 G0 X0 Y0\n{}\n%_N_SUB1_SPF\nG1 X10 RND=1 F100\nY10\nM17", "SUB1", ("M30", "M2", "M17", "RET")),
    "isg": ("%MAIN\nG90 G0 X0 Y0\n{}\n%L S\nG1 X10 #RND=5 F100\nY10\nM17", "L S", ("M30", "M02", "M17")),
    KLARTEXT: ("L X+0 Y+0 F100\nL X+1\nL X+2 {}\nLBL 1\nFL X+10 AN+0\nLBL 0", "CALL LBL 1", ("M30", "M2")),
}
LIKE = {"siemens-840d": "siemens", "siemens-808d": "siemens", "isg": "isg", KLARTEXT: KLARTEXT}


@pytest.mark.parametrize("control", [each for each in CONTROLS if each not in ("cnc-pilot", "yasnac-lx3")])
def test_an_end_and_a_call_in_one_block_is_told_whatever_their_order(control):
    """How a CNC PILOT calls is on no page that we have."""
    text, call, ends = ENDS[LIKE.get(control, "fanuc")]
    for end in ends:
        does = "ends the program" if end in ("M30", "M02", "M2") else "returns"
        told = f"program line 3 {does} and calls a subprogram in one block: which comes first is not known"
        one, two = (solve(text.format(each), control=control) for each in (f"{end} {call}", f"{call} {end}"))
        assert not_followed(one) == [(3, f"{told}; write two blocks")]
        assert [each.message for each in one.diagnostics] == [each.message for each in two.diagnostics]
        assert {each.contour for each in one.answers} == {None}
        inline = expand(text.format(f"{end} {call}"), control=control, inline=True, keep_going=True)
        assert f"{end} {call}" in inline.text


UNDECIDED = {
    "goto": ("fanuc-mill", "G17 G90 G0 X0. Y0.\nG1 F200\n{}\nX38.\nN20 Y10. ,R5.\nX80.\nM30", "IF[#500 EQ 1]GOTO20"),
    "goto to what is not there": ("fanuc-mill", "G90 G0 X0. Y0.\nG1\n{}\nY10. ,R5.\nX80.", "IF[#500 EQ 1]GOTO77"),
    "computed": ("fanuc-mill", "G17 G90 G0 X0. Y0.\nG1 F200\n{}\nN20 Y10. ,R5.\nX80.\nM30", "GOTO#500"),
    "loop": ("fanuc-mill", "G17 G90 G0 X0. Y0.\nG1 F200\n{}\nY10. ,R5.\nX80.\nEND1\nM30", "WHILE[#500 LT 3]DO1"),
    "call": ("fanuc-mill", "G90 G0 X0. Y0.\nG1\n{}\nY10. ,R5.\nX80.\nM30\nO5\nX1.\nM99", "/M98 P5"),
    "end": ("fanuc-mill", "G90 G0 X0. Y0.\nG1\n{}\nY10. ,R5.\nX80.\nM30", "/M30"),
    "if": ("siemens-840d", "G17 G90 G0 X0 Y0\nG1 F200\n{}\nX38\nENDIF\nY10 RND=5\nX80\nM30", "IF R5==1"),
    "case": (
        "siemens-840d",
        "G90 G0 X0 Y0\nG1\n{}\nL1: X10\nL2: Y10 RND=5\nX60",
        "CASE R1 OF 1 GOTOF L1 DEFAULT GOTOF L2",
    ),
    "until": ("siemens-840d", "G90 G0 X0 Y0\nREPEAT\n{}\nG1 Y10 RND=5\nX60\nM30", "UNTIL R5==1"),
    "for": ("siemens-840d", "G90 G0 X0 Y0\nG1\n{}\nX=IC(10)\nY10 RND=5\nX60\nENDFOR\nM30", "FOR R1=1 TO R5"),
    "label": (
        "heidenhain",
        "L X+0 Y+0 R0 F100\nL Y+5\n{}\nL X+10\nLBL 5\nFL X+20 AN+10",
        "FN 9: IF +Q5 EQU +1 GOTO LBL 5",
    ),
}


@pytest.mark.parametrize("name", UNDECIDED)
@pytest.mark.parametrize("keeps_going", [False, True])
def test_a_jump_that_cannot_be_decided_is_not_written_out(name, keeps_going):
    control, text, line = UNDECIDED[name]
    inline = expand(text.format(line), control=control, inline=True, keep_going=keeps_going)
    (left,) = inline.summary.left
    advice = "delete the block, or its /" if line.startswith("/") else "state its value by --variable"
    assert (inline.text, left.lines) == (None, (3,))
    assert re.fullmatch(rf"{re.escape(line)} cannot be decided: .+; {advice}, or leave out --inline", left.reason)


def test_a_label_with_the_number_of_a_block_is_not_that_block():
    program = "G17 G90 G0 X0 Y0\nGOTOF A10\nN10 G1 X99 F100\nA10: G1 X10 Y0 RND=1 F100\nX10 Y10\nM30\n"
    (answer,) = solve(program, control="siemens-840d").answers
    assert (answer.contour.start, answer.contour.end) == ((0, 0), (10, 10))
