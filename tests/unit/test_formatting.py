"""What formatting does to one line or one program; that it never changes what a program says is a law of its own."""

import re

import pytest

from contoursolve import (
    BlockNumber,
    UnknownControlError,
    block_number_at,
    check,
    format_program,
    rename_block,
    solve,
)
from contoursolve.diagnostics.source import Span

FANUC, HAAS, SINUMERIK, ISG = "fanuc-lathe", "haas-mill", "siemens-840d", "isg"


# --- blanks ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("control", "text", "expected"),
    [
        (None, "G1X10", "G1 X10"),
        (None, "G1   X10\t Y2", "G1 X10 Y2"),
        (None, "N 10 X 10. ,A 30.", "N10 X10. ,A30."),
        (None, "X2 X2. X+5 Y01 Z.5", "X2 X2. X+5 Y01 Z.5"),
        (None, "G1 X10.,R5.", "G1 X10. ,R5."),
        (None, "X1   ", "X1"),
        (None, "  G1  X1", "  G1 X1"),
        (None, "/N10G1X1", "/N10 G1 X1"),
        (None, "/ G1", "/G1"),
        (None, "/2G1", "/2 G1"),
        (None, "O0012(PART  A)", "O0012 (PART  A)"),
        (None, "(A  B)X1", "(A  B) X1"),
        (None, "X1     (ALIGNED)", "X1     (ALIGNED)"),
        (None, "X1;  note  ", "X1 ;  note  "),
        (None, "X#1Y2", "X#1 Y2"),
        (None, "X1  Y?", "X1 Y?"),
        (None, "G1X1\r\nG1X2\rG1X3\n\n", "G1 X1\r\nG1 X2\rG1 X3\n\n"),
        (None, "X1\r  \n  \n", "X1\r  \n\n"),
        (None, "%  ", "%"),
        (SINUMERIK, "G1X=AC( 5 )  ANG = 30 RND=5", "G1X=AC(5) ANG=30 RND=5"),
        (SINUMERIK, 'N10  MSG("A  B")G1', 'N10 MSG("A  B") G1'),
        (SINUMERIK, "LBL:G1X1", "LBL: G1 X1"),
        (SINUMERIK, "G1 X10.5Y3  ; A  B", "G1 X10.5 Y3  ; A  B"),
        (SINUMERIK, "DIAMON   G18", "DIAMON G18"),
        (ISG, "G1X10# ANG=30 Y3", "G1 X10 #ANG=30 Y3"),
        (ISG, "#ANG 30  X5", "#ANG 30 X5"),
        (ISG, "#RND=5(A (B)  C)G1", "#RND=5 (A (B)  C) G1"),
        (ISG, "#COMMENT BEGIN\nG1X1\n#COMMENT END\nG1X1", "#COMMENT BEGIN\nG1X1\n#COMMENT END\nG1 X1"),
    ],
)
def test_there_is_one_blank_between_words(control, text, expected) -> None:
    assert format_program(text, control=control) == expected


LEFT = {
    None: [
        *("#100  =  5.  ", "IF[#1 GT  5]GOTO20", "  WHILE[#1LT5]DO1  ", "X1 0", "G1X1E2", ":100", "$G1X1", "(OPEN  X1"),
        *("X [#1  + 2]", "\udcff G1X1", "G1X1 %", "(A) % ", "G01X1O5.", "G1X180,Q-30.", "X" + "1 " * 1_500, "\x1aG1X1"),
    ],
    SINUMERIK: ["IF  R1>5  GOTOF  N10", "DEF  REAL  A", "R1=R2 + 5", "%_N_PART_MPF ;A ", "N 10 GOTOF N20"],
    ISG: ["$IF  P1 > 5", "P1 = 5  ", "V.P.A  = 5", "X1Y1(A(B(C(D(E(F"],
}


@pytest.mark.parametrize(("control", "text"), [(control, text) for control, texts in LEFT.items() for text in texts])
def test_what_may_be_read_otherwise_stays_as_it_is(control, text) -> None:
    assert format_program(text, control=control) == text


def test_a_program_that_may_be_for_several_controls_is_formatted() -> None:
    program = "G0X10.Z0\nG1X20.,R5.\nZ-5."
    assert "control-alike" in {each.code for each in solve(program).diagnostics}
    assert format_program(program) == "G0 X10. Z0\nG1 X20. ,R5.\nZ-5."
    with pytest.raises(UnknownControlError):
        format_program(program, control="fanuk")


# --- block numbers --------------------------------------------------------------------------------------

NUMBERED = [
    (None, "%\nO1 (A)\n\n(B)\nG0X0\n/G1X1\n#1=5\nM30\n%", "%\nO1 (A)\n\n(B)\nN10 G0 X0\n/N20 G1 X1\n#1=5\nN30 M30\n%"),
    (None, "N5G1\nN5X2", "N10 G1\nN20 X2"),
    (None, "N0005 G1\nX2\nGOTO5", "N0010 G1\nN0020 X2\nGOTO10"),
    (None, "N5 #1=5\nN7 IF[#1EQ5]GOTO5", "N10 #1=5\nN20 IF[#1EQ5]GOTO10"),
    (None, "GOTO 5 (GOTO 7)\nN5 X1", "GOTO 10 (GOTO 7)\nN10 X1"),
    (None, "O1\nN5 G1\nGOTO5\nO2\nN5 G1\nGOTO5", "O1\nN10 G1\nGOTO10\nO2\nN10 G1\nGOTO10"),
    (None, "G71 U1. R1.\nG71 P5 Q6 U1.\nN5 G0\nN6 X2", "N10 G71 U1. R1.\nN20 G71 P30 Q40 U1.\nN30 G0\nN40 X2"),
    (None, "N5 G73 Z-5. R1. P5 Q700", "N10 G73 Z-5. R1. P5 Q700"),
    (None, "N5 X1\nM99 P5\nM30", "N10 X1\nN20 M99 P10\nN30 M30"),
    (FANUC, "O1\nM98 P2\nN4 X1\nM30\nO2\nN3 X2\nM99 P4", "O1\nN10 M98 P2\nN20 X1\nN30 M30\nO2\nN10 X2\nN20 M99 P20"),
    (FANUC, "M97 P5\nM98 P7 Q5\nM98 Q5\nN5", "N10 M97 P5\nN20 M98 P7 Q5\nN30 M98 Q40\nN40"),
    (HAAS, "M97 P5 L2\nM30\nN5 X1\nM99", "N10 M97 P30 L2\nN20 M30\nN30 X1\nN40 M99"),
    (HAAS, "N5 M96 P5 Q8\nN7 [#1 LT 10] M99 P5", "N10 M96 P10 Q8\nN20 [#1 LT 10] M99 P10"),
    (HAAS, "IF[#1EQ2]M99 P5\nN5 X1", "IF[#1EQ2]M99 P10\nN10 X1"),
    ("mitsubishi", "M98 H5\nM98 P1 Q5\nN5", "N10 M98 H30\nN20 M98 P1 Q5\nN30"),
    (SINUMERIK, "N5 GOTOF N7\nN7 LBL: X1\nGOTOB LBL", "N10 GOTOF N20\nN20 LBL: X1\nGOTOB LBL"),
    (SINUMERIK, "REPEAT N5 N6 P=3\nN5\nN6 X1", "REPEAT N10 N20 P=3\nN10\nN20 X1"),
    (SINUMERIK, "CASE R1 OF 1 GOTOF N5 DEFAULT GOTOF :7\nN5", "CASE R1 OF 1 GOTOF N10 DEFAULT GOTOF :7\nN10"),
    (SINUMERIK, "N5GOTOF N6\nN6REPEAT N5N6", "N10GOTOF N20\nN20REPEAT N10N20"),
    (SINUMERIK, "CALL BLOCK N5 TO N6\nN5\nN6", "CALL BLOCK N10 TO N20\nN10\nN20"),
    (SINUMERIK, 'CYCLE95("N5:N6",1)\nN5\nN6', 'N10 CYCLE95("N20:N30",1)\nN20\nN30'),
    (SINUMERIK, 'MSG("GOTOF N5")\nMSG("N5")\nN5 ;N5', 'N10 MSG("GOTOF N5")\nN20 MSG("N5")\nN30 ;N5'),
    (ISG, "N5 $GOTO N6\nN6 X1\n$GOTO [LBL]", "N10 $GOTO N20\nN20 X1\n$GOTO [LBL]"),
    (ISG, "N5L SEQUENCE[N5]", "N10 L SEQUENCE[N10]"),
    (ISG, "L SEQUENCE [N5 N6 REPEAT=2]\nN5\nN6", "L SEQUENCE [N10 N20 REPEAT=2]\nN10\nN20"),
]


@pytest.mark.parametrize(("control", "text", "expected"), NUMBERED)
def test_blocks_have_numbers_and_jumps_follow(control, text, expected) -> None:
    assert format_program(text, control=control, block_numbers=10) == expected
    assert format_program(expected, control=control, block_numbers=10) == expected


REFUSED = [
    (None, "GOTO#1\nN5 X1", "program line 1: GOTO#1 may lead to any block, so the blocks keep their numbers"),
    (None, "GOTO[#1+5]\nN5 X1", "program line 1: GOTO[#1+5] may lead to any block, so the blocks keep their numbers"),
    (None, "N5\nGOTO 7", "program line 2: GOTO 7 leads to N7, which is not there"),
    (None, "N5\nN5\nGOTO 5", "program line 3: GOTO 5 leads to N5, which is in program lines 1 and 2"),
    (None, "N5\nM99 P5", "program line 2: M99 P5 may lead to a block of the program that calls this one"),
    (None, "N5\nM99 P#1\nM30", "program line 2: M99 P#1 may lead to any block, so the blocks keep their numbers"),
    (None, "G70 P#1 Q5\nN5", "program line 1: G70 P#1 may lead to any block, so the blocks keep their numbers"),
    (None, "N5.5 X1", "program line 1: N5.5 is no plain block number"),
    (None, "N5 X1 N6", "program line 1: N6 does not begin its block"),
    (
        None,
        "G10 L50\nN1815 R5\nG11",
        "program line 1: here N is the number of a parameter, so the blocks keep their numbers",
    ),
    (FANUC, "M98 P#1 Q5\nN5", "program line 1: M98 Q5 may lead to any block, so the blocks keep their numbers"),
    (SINUMERIK, "GOTOF R1", "program line 1: GOTOF R1 may lead to any block, so the blocks keep their numbers"),
    (
        SINUMERIK,
        'GOTOF "N"<<R1',
        'program line 1: GOTOF "N"<<R1 may lead to any block, so the blocks keep their numbers',
    ),
    (SINUMERIK, 'CALL "A" BLOCK N5 TO N6', 'program line 1: CALL "A" BLOCK names blocks of another program'),
    (SINUMERIK, 'RET("N5")', 'program line 1: RET("N5") may lead to a block of the program that calls this one'),
    (ISG, "$GOTO NP1", "program line 1: $GOTO NP1 may lead to any block, so the blocks keep their numbers"),
    (ISG, "L SEQUENCE [NAME=a N5]", "program line 1: L SEQUENCE names blocks of another program"),
    (None, "X1\n" * 1_000, "block numbers would go to N10000, and the highest is N9999: choose a smaller step"),
]


@pytest.mark.parametrize(("control", "text", "message"), REFUSED)
def test_numbers_stay_where_a_jump_cannot_follow(control, text, message) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        format_program(text, control=control, block_numbers=10)
    assert format_program(text, control=control)


@pytest.mark.parametrize("step", [-1, 1_001, True, 2.5])
def test_a_step_is_a_whole_number(step) -> None:
    with pytest.raises(ValueError, match="choose a step from 1 to 1,000, or 0"):
        format_program("X1", block_numbers=step)


# --- one block ------------------------------------------------------------------------------------------

PROGRAM = "O1\nN0010 X1\nIF [#1 EQ 1] GOTO 10\nN20 M99 P010\nM30\nO2\nN10 X1\nGOTO 10\nN30 GOTO 40"


def renamed(text, line, number, **options):
    lines = text.split("\n")
    for each in reversed(rename_block(text, line, number, **options)):
        place, begin, end = each.span
        lines[place - 1] = lines[place - 1][: begin - 1] + each.text + lines[place - 1][end - 1 :]
    return "\n".join(lines)


def test_a_block_is_renamed_with_its_jumps_in_its_own_program() -> None:
    first = "O1\nN0007 X1\nIF [#1 EQ 1] GOTO 7\nN20 M99 P007\nM30\n"
    assert renamed(PROGRAM, 2, 7) == first + PROGRAM[PROGRAM.index("O2") :]
    assert renamed(PROGRAM, 7, 500) == PROGRAM.replace("O2\nN10 X1\nGOTO 10", "O2\nN500 X1\nGOTO 500")
    assert rename_block(PROGRAM, 2, 10) == ()
    assert renamed("GOTOF N5\nN5 X1 ;N5", 2, 70, control=SINUMERIK) == "GOTOF N70\nN70 X1 ;N5"


@pytest.mark.parametrize(
    ("text", "line", "number", "message"),
    [
        (PROGRAM, 2, 20, "N20 is in program line 4 already"),
        (PROGRAM, 9, 40, "program line 9 leads to N40 already, which is not there"),
        (PROGRAM, 3, 40, "program line 3 has no block number"),
        (PROGRAM, 99, 40, "program line 99 has no block number"),
        (PROGRAM, 2, 0, "a block number is a whole number from 1 to 99,999, not 0"),
        (PROGRAM, 2, 100_000, "a block number is a whole number from 1 to 99,999, not 100000"),
        (PROGRAM, 2, "7", "a block number is a whole number from 1 to 99,999, not '7'"),
        ("N5\nGOTO#1", 1, 7, "program line 2: GOTO#1 may lead to any block, so the blocks keep their numbers"),
        ("N5\nN5\nGOTO 5", 1, 7, "program line 3: GOTO 5 leads to N5, which is in program lines 1 and 2"),
        ("N5\nM99 P5", 1, 7, "program line 2: M99 P5 may lead to a block of the program that calls this one"),
    ],
)
def test_a_block_keeps_its_number_where_another_one_would_be_meant(text, line, number, message) -> None:
    with pytest.raises(ValueError, match=f"^{re.escape(message)}$"):
        rename_block(text, line, number)


def test_a_jump_to_another_block_keeps_no_number() -> None:
    assert renamed("N5\nN8\nM99 P5", 2, 9) == "N5\nN9\nM99 P5"


@pytest.mark.parametrize(
    ("line", "column", "expected"),
    [
        (2, 1, (Span(2, 2, 6), 10, 2)),
        (2, 6, (Span(2, 2, 6), 10, 2)),
        (2, 7, None),
        (3, 14, (Span(3, 19, 21), 10, 2)),
        (3, 10, None),
        (4, 2, (Span(4, 2, 4), 20, 4)),
        (4, 10, (Span(4, 10, 13), 10, 2)),
        (8, 6, (Span(8, 6, 8), 10, 7)),
        (9, 10, (Span(9, 10, 12), 40, None)),
        (1, 1, None),
        (99, 1, None),
    ],
)
def test_the_number_under_the_cursor(line, column, expected) -> None:
    assert block_number_at(PROGRAM, line, column) == (expected and BlockNumber(*expected))


def test_a_formatted_program_has_the_same_findings() -> None:
    program = "G00X40.Z0.\nG111X100.A180.B120.(NO K)"
    assert [each.code for each in check(program)] == [each.code for each in check(format_program(program))] != []


def test_of_two_blocks_with_one_number_each_has_its_own_line() -> None:
    program = "N5 X1\nN5 X2\nGOTO 5"
    assert [block_number_at(program, line, 2).line for line in (1, 2, 3)] == [1, 2, None]
