"""Calls of SINUMERIK and ISG have levels: what SAVE brings back, variables of their own, by reference, and by type."""

import pytest
from click.testing import CliRunner

from contoursolve import Status, expand, solve
from contoursolve.cli import main

SIEMENS, MILL = "siemens-840d", "G17 G71 G90 G54\nG0 X0 Y0\n"
CORNER = "G1 X{} RND=2 F300\nY20\nM30\n"


def result_of(text: str, control: str = SIEMENS, **more):
    return solve(text, control=control, **more)


def start_of(text: str) -> tuple[float, ...]:
    """The start of the only contour that the main program has, mm, X as radius."""
    (answer,) = result_of(text).answers
    assert answer.status is Status.SOLVED, result_of(text).diagnostics
    return tuple(pytest.approx(each, abs=1e-9) for each in answer.contour.start)


def corner_of(text: str, control: str = SIEMENS, **more) -> float:
    """The first coordinate at which the contour turns."""
    (answer,) = result_of(text, control, **more).answers
    assert answer.status is Status.SOLVED, answer.diagnostics
    return round(answer.contour.end[0], 6)


def codes_of(text: str, control: str = SIEMENS, **more) -> list[tuple[str, int]]:
    return [(each.code, each.span.line) for each in result_of(text, control, **more).diagnostics]


# SAVE -----------------------------------------------------------------------------------------------------------------

SAVES = (
    ("SUB(3)", "PROC SUB(REAL AA) SAVE DISPLOF\nG91 G0 X=AA", (3, 0), "G90"),
    ("SUB", "PROC SUB SAVE\nG91 G0 X3", (3, 0), "G90"),
    ("SUB", "PROC SUB DISPLOF SBLOF SAVE ACTBLOCNO\nG91 G0 X3", (3, 0), "G90"),
    ("SUB(5)", "PROC SUB(REAL AA) SAVE\nTRANS X=AA\nG0 X0 Y0", (5, 0), "TRANS"),
    ("TRANS X2\nG0 X0 Y0\nSUB", "PROC SUB SAVE\nTRANS X5\nATRANS Y3\nG0 X0 Y0", (3, 3), "TRANS\nTRANS X2"),
    ("SUB(1)", "PROC SUB(REAL AA) SAVE\nG70\nG0 X=AA", (25.4, 0), "G71"),
    ("SUB P2", "PROC SUB SAVE\nX4\nG91 G0 X3", (7, 0), "G90"),
    ("SUB", "PROC SUB SAVE\nG19 G91 G0 X3\nDEEP\nRET\nPROC DEEP\nG70 G42", (3, 0), "G71 G17 G90 G40"),
    ("SUB", "PROC SUB SAVE\nG91 G0 X3\nIF R5>0\nRET\nENDIF\nG70", (3, 0), ""),
    (
        "G64 G94 SOFT\nSUB",
        "PROC SUB SAVE\nG95 G9\nG60\nDEEP\nG91 G0 X3\nRET\nPROC DEEP SAVE\nG961 BRISK",
        (3, 0),
        "G95 SOFT\nG91 G0 X3\nG90 G64 G94",
    ),
    ("SUB\nG55\nG0 X1 Y0", "PROC SUB SAVE\nG55 G0 X3", (1, 0), "G54"),
)


@pytest.mark.parametrize(("call", "sub", "start", "written"), SAVES)
def test_save_brings_back_modes_and_frames(call, sub, start, written):
    text = f"{MILL}{call}\n{CORNER.format(20)}{sub}\nRET"
    assert start_of(text) == start
    if written:
        plain = expand(text, control=SIEMENS, inline=True).text
        assert f"\n{written}\n" in plain
        assert "SAVE" not in plain
        assert start_of(f"{MILL}{call}\n{CORNER.format(20)}{sub.replace('SAVE', 'SBLOF')}\nG90 G71 G40 G17 G54\nRET")


def test_save_brings_back_what_x_is():
    sub = "PROC SUB(REAL AA) SAVE\nDIAMOF\nG0 Z=AA\nRET"
    text = f"G18 G71 G90 DIAMON\nG0 X40 Z0\nSUB(5)\nG1 X60 RND=2 F300\nZ-20\nM30\n{sub}"
    (answer,) = result_of(text).answers
    assert answer.contour.start == (5, 20)
    assert answer.contour.end == (-20, 30)
    assert "\nDIAMON\n" in expand(text, control=SIEMENS, inline=True).text


def test_without_save_the_modes_stay_as_the_subprogram_left_them():
    text = f"{MILL}SUB\n{CORNER.format(20)}PROC SUB\nG91 G0 X3\nRET"
    assert (start_of(text), corner_of(text)) == ((3, 0), 23)


def test_a_work_offset_that_comes_back_moves_the_zero_by_an_unknown_amount():
    text = f"{MILL}SUB\n{{}}{CORNER.format(20)}PROC SUB SAVE\nG55 G0 X3 Y0\nRET"
    assert codes_of(text.format("")) == [("position-unknown", 4)]
    assert "by SAVE" in result_of(text.format("")).diagnostics[0].message
    assert start_of(text.format("G0 X1 Y0\nG54\n")) == (1, 0)


def test_save_does_not_undo_what_is_written_into_an_offset():
    subs = "M30\nPROC SUB1 SAVE\nSUB2\nG0 X9 Y2\nRET\nPROC SUB2 SAVE\n{}\nRET"
    for changed, start in (("$P_IFRAME=CTRANS(X,5)", (None, None)), ("TRANS X5", (9, 2))):
        program = f"G17 G71 G90 G54\nG0 X8 Y2\nSUB1\nG1 X20 RND=2\nY20\n{subs.format(changed)}"
        assert solve(program, control="siemens-840d").answers[0].start.values == start


def test_numbers_of_an_offset_matter_to_save_where_they_change_behind_its_call():
    data, subs = "$P_UIFR[1]=CTRANS(X,5)\nG54\nG0 X0 Y0\n", "PROC SUB SAVE\n{}RET\nPROC DEEP SAVE\n{}RET"
    moves = "G91 G0 X3\n"
    for before, sub, deep, start in (
        (data, moves, "", (3, 0)),
        ("", f"{data}DEEP\n", moves, None),
        ("", f"DEEP\n{data[data.index('G') :]}", data, None),
        ("", "LOST\nG90 G71 G17 G54 DIAMOF\nTRANS\nG0 X0 Y0\n", "", None),
    ):
        text = f"{MILL}{before}SUB\n{CORNER.format(20)}{subs.format(sub, deep)}"
        found = result_of(text).answers[0].start.values
        assert found == (start or (None, None))


def test_what_save_brings_back_is_not_written_where_it_is_not_known(tmp_path):
    program = tmp_path / "main.mpf"
    program.write_text(f"G17 G90 G0 X0 Y0\nSUB\n{CORNER.format(20)}PROC SUB SAVE\nG55 G0 X3 Y0\nRET")
    done = CliRunner().invoke(main, ["expand", "--inline", str(program), "--control", SIEMENS])
    assert (done.exit_code, done.stdout) == (1, "")
    assert "which work offset and shift are in force at the call is not known" in done.stderr


def test_what_save_brings_back_is_told_where_no_line_says_what_it_is(tmp_path):
    program = tmp_path / "main.mpf"
    program.write_text(f"{MILL}SUB\n{CORNER.format(20)}PROC SUB SAVE\nG95 G9 BRISK\nRET")
    done = CliRunner().invoke(main, ["expand", "--inline", str(program), "--control", SIEMENS])
    assert "what was in force before G95, BRISK is again, and no line says what" in done.stderr


# What is not followed -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("control", "text", "restated"),
    [
        (SIEMENS, f"{MILL}L10\n{{}}G0 X0 Y0\nG1 X20 RND=2 F300\nY20\nM30", "G17 G71 G90 DIAMOF RNDM=0 G40\n"),
        ("fanuc-mill", "G17 G21 G90\nM98 P10\n{}G00 X0 Y0\nG01 X20. ,R2. F300\nY20.\nM30", "G17 G21 G90 G40\n"),
        ("isg", "G17 G71 G90\nL SUB\n{}G00 X0 Y0\nG01 X20 #RND=2 F300\nY20\nM30", "G17 G71 G90 G40 G52\n"),
    ],
)
def test_behind_what_is_not_followed_no_mode_is_known(control, text, restated):
    (finding, *_) = result_of(text.format(""), control).diagnostics
    assert finding.code == "mode-unknown"
    assert "the unit" in finding.message
    assert not codes_of(text.format(restated), control)


# Variables ------------------------------------------------------------------------------------------------------------

HEAD = f"{MILL}{{}}\n{CORNER.format('=AA')}{{}}\nRET"
VALUES = (
    # A formal parameter, and a DEF of the same name, are variables of their own.
    ("DEF REAL AA=15\nSUB(20)", "PROC SUB(REAL AA)\nAA=AA+10", 15),
    ("DEF REAL AA=15\nSUB", "PROC SUB\nDEF REAL AA\nAA=40", 15),
    # What the main program defines is known in all that it calls.
    ("DEF REAL AA=15\nSUB", "PROC SUB\nDEEP\nRET\nPROC DEEP\nAA=AA+7", 22),
    ("DEF REAL AA=15\nSUB(3)", "PROC SUB(REAL BB)\nDEF REAL AA=1\nDEEP\nRET\nPROC DEEP\nAA=AA+7", 22),
    # By reference, through several levels; R parameters and elements of arrays, and whole arrays.
    ("DEF REAL AA=15\nSUB(AA)", "PROC SUB(VAR REAL BB)\nBB=BB+15", 30),
    ("DEF REAL AA=15\nSUB(AA)", "PROC SUB(VAR REAL BB)\nDEEP(BB)\nRET\nPROC DEEP(VAR REAL CC)\nCC=CC+15", 30),
    ("DEF REAL AA\nR1=5\nSUB(R1)\nAA=R1", "PROC SUB(VAR REAL BB)\nBB=BB*4", 20),
    ("DEF REAL AA, FF[3]=SET(1,2,3)\nSUB(FF[R1+1])\nAA=FF[1]*10", "PROC SUB(VAR REAL BB)\nBB=BB+2", 40),
    ("DEF REAL AA, FF[3]=SET(1,2,3)\nSUB(FF)\nAA=FF[2]*10", "PROC SUB(VAR REAL BB[3])\nBB[2]=BB[0]+1", 20),
    ("DEF REAL AA=15\nSUB(AA)", "PROC SUB(VAR REAL AA)\nAA=AA+15", 30),
    # By value, with the type of the parameter; what is left out is 0.
    ("DEF REAL AA=15\nSUB(AA)", "PROC SUB(REAL BB)\nBB=99", 15),
    ("DEF REAL AA\nSUB(22.6)", "PROC SUB(INT BB)\nAA=BB", 23),
    ("DEF REAL AA\nSUB(,5)", "PROC SUB(REAL BB,REAL CC,REAL DD)\nAA=20+BB+CC+DD", 25),
    # An INT is rounded; a BOOL is 1 or 0; R parameters are known everywhere.
    ("DEF INT AA=22.6", "PROC SUB", 23),
    ("DEF INT AA\nAA=22.4999", "PROC SUB", 22),
    ("DEF INT BB=-2.5\nDEF REAL AA=30+BB", "PROC SUB", 27),
    ("DEF BOOL BB=7\nDEF REAL AA=20+BB", "PROC SUB", 21),
    ('DEF CHAR BB="A"\nDEF REAL AA=BB', "PROC SUB", 65),
    ("DEF REAL AA\nSUB\nAA=R7", "PROC SUB\nR7=33", 33),
    ("DEF INT AA=10\nSUB P3\nAA=AA+R1", "PROC SUB\nDEF INT BB\nBB=BB+1\nR1=BB", 11),
    # R parameters by their other names; and names that begin as words do.
    ("DEF REAL AA\nR[1]=5\n$R1=$R[1]+20\nSUB\nAA=R01", "PROC SUB\n$R[1]=R1*2", 50),
    ("DEF REAL AA, ANG1=45\nANG1=30\nPOS2=5\nAA=ANG1+POS2", "PROC SUB", 35),
)


@pytest.mark.parametrize(("call", "sub", "value"), VALUES)
def test_variables_have_their_levels_and_types(call, sub, value):
    text = HEAD.format(f"R1=0\n{call}", sub)
    assert not [each for each in result_of(text).diagnostics if each.is_error]
    assert corner_of(text) == value


def test_the_808d_keeps_what_the_main_program_defines_to_it():
    text = HEAD.format("DEF REAL AA=15\nSUB", "PROC SUB\nAA=AA+7")
    small, program = "siemens-808d", {"siemens-808d.main-def": "program"}
    assert ("siemens-variable-refused", 9) in codes_of(text, small)
    assert corner_of(text, small, settings=program) == corner_of(text) == 22
    local = {"siemens-840d.main-def": "local", "siemens-840d.words": "ZZTOP"}
    assert ("siemens-variable-refused", 9) in codes_of(text, settings=local)


def test_what_nothing_calls_has_a_level_of_its_own():
    sub = "%_N_SUB_SPF\nPROC SUB(REAL AA)\nG1 X=AA RND=2\nY40"
    alone = "%_N_M_MPF\n" + HEAD.format("DEF REAL AA=15", sub)
    assert [(each.status, each.claim.blocks[0].line) for each in result_of(alone).answers] == [
        (Status.SOLVED, 5),
        (Status.UNDERDETERMINED, 10),
    ]


@pytest.mark.parametrize(
    ("call", "sub"),
    [
        ("DEF REAL AA\nSUB(5)\nAA=R1", "PROC SUB(REAL BB)\nR1=BB"),
        ("DEF REAL AA\nSUB\nAA=R1", "PROC SUB\nDEF REAL BB=3\nR1=BB"),
    ],
)
def test_a_stated_value_holds_in_each_level(call, sub):
    assert corner_of(HEAD.format(call, sub), variables={"BB": 40}) == 40
    assert corner_of(HEAD.format("DEF REAL AA=1", "PROC SUB(REAL AA)"), variables={"AA": 40}) == 40
    assert corner_of(HEAD.format("DEF REAL AA\nSUB(7)", "PROC SUB(REAL AA)\nR1=AA"), variables={"AA": 40}) == 40


@pytest.mark.parametrize("type_", ["INT BB=9999999999", "CHAR BB=300", 'REAL BB="A"', "AXIS BB=X"])
def test_what_a_type_cannot_hold_is_not_known(type_):
    (finding,) = result_of(HEAD.format(f"DEF {type_}\nDEF REAL AA=BB", "PROC SUB")).diagnostics
    assert finding.code == "value-variable"


@pytest.mark.parametrize(
    ("call", "told"),
    [
        ("SUB(5)", "write a variable there"),
        ("SUB(AA,3)", "hands over 2 values, and SUB takes 1"),
        ("DEF INT CC\nSUB(CC)", "hands over CC, of type INT, for BB (VAR REAL)"),
    ],
)
def test_what_is_handed_over_is_what_the_subprogram_takes(call, told):
    (finding, *_) = result_of(HEAD.format(f"DEF REAL AA=15\n{call}", "PROC SUB(VAR REAL BB)\nBB=1")).diagnostics
    assert (finding.code, told in finding.message) == ("not-followed", True)


def test_variables_of_isg_end_with_their_level():
    text = "G17 G71 G90\nV.L.A = 15\nV.P.B = 1\nL SUB\nG0 X0 Y0\nG1 X[{}] #RND=2 F300\nY20\nM30\n%L SUB\n{}\nM17\n"
    head, sub = text.partition("%L SUB")[::2]
    program = f"%L SUB{sub}%MAIN\n{head}"
    assert corner_of(program.format("V.L.C = 1", "V.L.A"), "isg") == 15
    assert corner_of(program.format("V.L.A = V.L.A + 5", "V.L.A"), "isg") == 20
    assert corner_of(program.format("#VAR\nV.L.A = 9\n#ENDVAR\nV.L.A = 5", "V.L.A"), "isg") == 15
    assert corner_of(program.format("V.P.B = 7", "V.P.B"), "isg") == 7
    assert codes_of(program.format("V.L.C = 9", "V.L.C"), "isg")[0][0] == "value-variable"


def test_ql_parameters_are_those_of_one_program(tmp_path):
    head, contour = "0 BEGIN PGM {} {}\n", "L X+60 R0 F300\nRND R2\nL Y+60\nM30\nEND PGM A MM"
    called = "QL1=+50\nQ1=+7\nCALL LBL 1\nL X+QL1\nLBL 1\nQL1=QL1+1\nLBL 0\nEND PGM B MM"
    (tmp_path / "B.H").write_text(head.format("B", "MM") + called)
    (tmp_path / "C.H").write_text(head.format("C", "INCH") + called)
    for call, start in (("CALL PGM B\nL X+QL1 Y+Q1", (30, 7)), ("CALL PGM B", (51, 0)), ("CALL PGM C", (None, None))):
        text = f"{head.format('A', 'MM')}QL1=+30\nL X+0 Y+0\n{call}\n{contour}"
        (answer,) = solve(text, control="heidenhain", folders=[tmp_path]).answers
        assert answer.start.values == start
    assert (
        "END PGM B"
        not in expand(text.replace("PGM C", "PGM B"), control="heidenhain", folders=[tmp_path], inline=True).text
    )


def test_a_subprogram_is_no_word_that_another_control_does_not_know(tmp_path):
    program = tmp_path / "main.mpf"
    program.write_text(f"{MILL}SUB(3)\nDEEP\n{CORNER.format(20)}PROC SUB(REAL AA)\nG0 X=AA\nRET\nPROC DEEP\nRET\n")
    done = CliRunner().invoke(main, ["convert", str(program), "--control", SIEMENS, "--to", "siemens-808d"])
    assert done.exit_code == 0
    assert "does not know" not in done.stderr


# Priorities -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("condition", "holds", "is_told"),
    [
        ("1==1 AND 2==3 OR 4==4", False, True),
        ("(1==1) AND (2==3) OR (4==4)", True, False),
        ("R1==10 AND R2==20", False, True),
        ("(R1==10) AND (R2==20)", True, False),
        ("NOT (R1==1) AND (R2>5 OR R1>5)", False, True),
        ("R1+R2>25", True, False),
    ],
)
def test_comparisons_come_last(condition, holds, is_told):
    text = f"{MILL}R1=10 R2=20\nR3=30\nIF {condition}\nR3=50\nENDIF\n{CORNER.format('=R3')}"
    result = result_of(text)
    (answer,) = result.answers
    assert answer.contour.end[0] == (50 if holds else 30)
    assert [each.code for each in result.diagnostics] == ["siemens-comparison-last"] * is_told
