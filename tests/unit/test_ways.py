"""Where it is not known which way a program takes: both are followed, and where they meet only what both agree on is
known; a corner finds its neighbour on each of them."""

import pytest

from contoursolve import OpenProgram, expand, solve
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.output.document import to_json
from contoursolve.solving import Status

SIEMENS, LATHE, MILL = "siemens-840d", "fanuc-lathe", "fanuc-mill"
J1 = """G00 X60. Z2.
IF[#5042 GT 5.]GOTO20
G01 X40. Z0 F0.2
GOTO30
N20 G01 X38. Z0 F0.2
N30 Z-20. ,R2.
X60.
M30"""
J3 = """G18 DIAMON G90
G0 X60 Z2
IF $AA_IM[X]>5
 G1 X40 Z0 F0.2
ELSE
 G1 X38 Z0 F0.2
ENDIF
Z-20 RND=2
X60
M30"""
CASE = """G18 DIAMON G90
G0 X60 Z2
CASE $AA_IM[X] OF 1 GOTOF ONE 2 GOTOF TWO DEFAULT GOTOF THREE
ONE: G1 X40 Z0 F0.2
GOTOF ON
TWO: G1 X38 Z0 F0.2
GOTOF ON
THREE: G1 X38 Z0 F0.2
ON: Z-20 RND=2
X60
M30"""
ISG = """G17 G90 G0 X60 Y2
$IF V.A.X > 5
G1 X40 Y0
$ELSEIF V.A.X > 3
G1 X38 Y0
$ELSE
G1 X40 Y0
$ENDIF
Y-20 #RND=2
X60
M30"""
KLARTEXT = """BEGIN PGM A MM
L X+60 Y+2 R0 F100
FN 18: SYSREAD Q1 = ID20 NR3
FN 11: IF +Q1 GT +5 GOTO LBL 20
L X+40 Y+0
FN 9: IF +0 EQU +0 GOTO LBL 30
LBL 20
L X+38 Y+0
LBL 30
FL X+70 AN+20
END PGM A MM"""
G111 = (
    "G00 X60. Z2.\nIF[#5042 GT 5.]GOTO20\nG00 X40. Z0.\nGOTO30\nN20 G00 X38. Z0.\nN30 G111 X100. A180. K-30. B120.\nM30"
)


@pytest.mark.parametrize(
    ("control", "text", "first", "second"),
    [
        (LATHE, J1, 3, 5),
        ("haas-lathe", J1, 3, 5),
        (SIEMENS, J3, 4, 6),
        ("siemens-808d", CASE, 4, 6),
        ("isg", ISG, 3, 5),
        ("heidenhain", KLARTEXT, 5, 8),
        ("yasnac-lx3", G111, 3, 5),
    ],
)
def test_where_ways_meet_only_what_they_agree_on_is_known(control, text, first, second):
    result = solve(text, control=control)
    (answer,) = result.answers
    (finding,) = answer.diagnostics
    assert (finding.code, finding.addresses) == ("position-unknown", ("X",))
    assert f"(program line {first})" in finding.message
    assert f"(program line {second})" in finding.message
    assert "decides" in finding.message
    left = expand(text, control=control, keep_going=True).text.split("\n")
    assert [line for line in left if "NOT EXPANDED" not in line] == text.split("\n")
    # What both set alike is known.
    alike = text.replace("X38", "X40").replace("X+38", "X+40")
    assert [each.status for each in solve(alike, control=control).answers] == [Status.SOLVED]
    assert expand(alike, control=control).summary.replaced == 1
    opened = OpenProgram(text, control=control)
    opened.check()
    assert opened.diagnostics == result.diagnostics
    for each in (text, alike):
        claimed = to_json(solve(each, control=control))
        right = [ReceiptVerdict.VERIFIED, ReceiptVerdict.NOTHING_CHECKED][: 2 if control == "heidenhain" else 1]
        assert verify(Document("", each.encode()), Document("", claimed.encode())).verdict in right
    assert verify(Document("", text.encode()), Document("", claimed.encode())).verdict is ReceiptVerdict.FAILED


MODES = {
    "motion": (
        LATHE,
        "G01",
        "G00",
        "the motion in force is not known here: G00 (program line 1) or G01 (program line 3)",
    ),
    "unit": (LATHE, "G20", "G21", "the unit is not known here: mm or inch (program line 3)"),
    "increments": (MILL, "G91", "G90", "whether increments are in force is not known here: coordinates or increments"),
    "plane": (MILL, "G19", "G17", "the plane is not known here: G17 or G19 (program line 3)"),
    "diameters": (SIEMENS, "DIAMON", "DIAMOF", "whether X is a diameter is not known here: no code or DIAMON"),
    "corners": (SIEMENS, "RNDM=1", "RNDM=0", "whether RNDM is in force is not known here: no RNDM or RNDM=1"),
}


@pytest.mark.parametrize("name", MODES)
def test_a_mode_on_which_ways_do_not_agree_is_not_known(name):
    control, code, other, told = MODES[name]
    jump, label, plane = (
        ("IF R99==1 GOTOF L5", "L5:", "G18 G90") if control == SIEMENS else ("IF[#599 EQ 1]GOTO5", "N5", "")
    )
    corner, first = (" RND=1", "Z") if control == SIEMENS else (" ,R1.", "Z" if control == LATHE else "Y")
    own = "" if name == "motion" else "G01 "
    # In a program with Y, nothing but its code says that X is a diameter.
    end = "Y1\nM30" if name == "diameters" else "M30"
    lines = f"{plane} G00 X40. {first}0.\n{jump}\n{code}\n{label}\n{{}}{own}{first}-20.{corner}\nX60.\n{end}"
    (answer, *_) = solve(lines.format(""), control=control).answers
    assert any(told in each.message for each in answer.diagnostics), [each.message for each in answer.diagnostics]
    assert answer.contour is None
    # The corner is right: no fix deletes it.
    assert not any(each.fixes for each in answer.diagnostics)
    # Said again, it is known.
    known = solve(lines.format(f"{'G01' if name == 'motion' else other}\n"), control=control)
    assert {each.status for each in known.answers} <= {Status.SOLVED}
    assert not any(each.is_error for each in known.diagnostics)


def test_a_variable_on_which_ways_do_not_agree_names_both_lines():
    text = "#1=3.\nIF[#599 EQ 1]GOTO5\n#1=5.\nN5 G00 X40. Z0.\nG01 Z-20. ,R#1\nX60."
    messages = str(solve(text, control=LATHE).diagnostics)
    assert "#1 is 3 (program line 1) or 5 (program line 3); program line 2 decides" in messages
    assert [each.status for each in solve(text.replace("5.\n", "3.\n"), control=LATHE).answers] == [Status.SOLVED]
    then = "G00 X40. Z0.\nIF[#599 EQ 1]THEN #1=5.\nG01 Z-20. ,R#1\nX60."
    assert "#1 is 5 (program line 2) or not set; program line 2 decides" in str(solve(then, control=LATHE).diagnostics)


LOOPS = {
    "jump back": (LATHE, "N5 G01 Z-20. ,R1.\nX50.\n{}IF[#599 EQ 1]GOTO5"),
    "WHILE": (LATHE, "WHILE[#599 EQ 1]DO1\nG01 Z-20. ,R1.\nX50.\n{}END1"),
    "a way out of an endless loop": (LATHE, "N5 IF[#599 EQ 1]GOTO9\nG01 Z-20. ,R1.\nX50.\n{}GOTO5\nN9 G00 X100."),
    "REPEAT": (SIEMENS, "REPEAT\nG01 Z-20. RND=1\nX50.\n{}UNTIL R99==1"),
    "LOOP": (SIEMENS, "LOOP\nG01 Z-20. RND=1\nX50.\n{}IF R99==1 GOTOF OUT\nENDLOOP\nOUT: G0 X100."),
    "FOR": (SIEMENS, "FOR R1=1 TO R99\nG01 Z-20. RND=1\nX50.\n{}ENDFOR"),
    "GOTOB": (SIEMENS, "BACK: G01 Z-20. RND=1\nX50.\n{}IF R99==1 GOTOB BACK"),
}


@pytest.mark.parametrize("name", LOOPS)
def test_the_head_of_a_loop_is_reached_from_above_and_from_its_end(name):
    control, text = LOOPS[name]
    head = "G18 G90 DIAMON\n" if control == SIEMENS else ""
    whole = f"{head}G00 X40. Z2.\n{text}\nG00 X100.\nM30"
    (answer,) = solve(whole.format(""), control=control).answers
    (finding,) = answer.diagnostics
    assert finding.addresses == ("Z", "X")
    assert finding.message.count("(program line ") == 4
    (answer,) = solve(whole.format("G00 X40. Z2.\n"), control=control).answers
    assert answer.status is Status.SOLVED


@pytest.mark.parametrize("control", ["fanuc-lathe", "haas-lathe"])
def test_a_first_pass_that_ends_where_it_began_says_nothing_of_the_second_one(control):
    loop = "#1=20\nWHILE[#500 GT 0]DO1\nG01 X#1\nM05\n#1=#1+2\nEND1"
    text = f"G00 X40. Z0.\nG01 X20. F0.2\nM05\n{loop}\nM05\nG01 Z-40. ,R2.\nX60.\nM30"
    (answer,) = solve(text, control=control).answers
    (finding,) = answer.diagnostics
    assert finding.code == "position-unknown"


B10 = """PROC REC(INT K)
G18 G90 DIAMON
G0 X60 Z2
G1 X40 F0.2
IF K>0
  Z-20 RND=2
ELSE
  Z-25 RND=3
ENDIF
X52
Z-40
M17"""


def ends(answer):
    return [tuple(round(at, 3) for at in each.end) for each in answer.contour.elements]


def test_a_corner_finds_its_neighbour_behind_the_end_of_a_branch():
    result = solve(B10, control=SIEMENS)
    assert [each.lines for each in result.answers] == [(6, 10), (8, 10)]
    assert [ends(each) for each in result.answers] == [
        [(-18.0, 20.0), (-20.0, 22.0), (-20.0, 26.0)],
        [(-22.0, 20.0), (-25.0, 23.0), (-25.0, 26.0)],
    ]
    assert not result.diagnostics
    left = expand(B10, control=SIEMENS, keep_going=True)
    assert left.summary.replaced == 0
    assert ";NOT EXPANDED: program line 10 is cut in another way" in left.text


def test_a_corner_finds_its_neighbour_behind_a_jump_and_keeps_it():
    text = "G00 X50. Z2.\nIF[#3 EQ #0]GOTO 5\nG01 Z-10. ,R1.\nN5 X60.\nM30"
    result = solve(text, control=LATHE)
    assert ends(result.answers[0]) == [(-9.0, 25.0), (-10.0, 26.0), (-10.0, 30.0)]
    before = "G00 X50. Z2.\nG01 Z-10. ,R1.\nIF[#3 EQ 1]GOTO 5\nX60.\nGOTO6\nN5 X70.\nN6 G00 X100.\nM30"
    found = solve(before, control=LATHE)
    assert [each.lines for each in found.answers] == [(2, 4), (2, 6)]
    assert not any(each.is_error for each in found.diagnostics)
    assert expand(before, control=LATHE, keep_going=True).summary.replaced == 0
    large = solve(text.replace(",R1.", ",R9."), control=LATHE)
    assert not any("N5" not in fix.replacement for each in large.diagnostics for fix in each.fixes)


@pytest.mark.parametrize("places", [(20, 30, 20), (20, 20, 30), (30, 20, 20), (20, 30, 40), (20, 20, 20)])
def test_all_ways_of_case_meet(places):
    """The tool is where all ways that CASE opens end alike, else it is not known."""
    ways = [f"LA{number}: X{place}\nGOTOF EE" for number, place in enumerate(places, 1)]
    text = "\n".join(
        ["G17 G90 G0 X0 Y0\nG1 F9", "CASE R1 OF 1 GOTOF LA1 2 GOTOF LA2 DEFAULT GOTOF LA3", *ways, "EE: Y10 RND=2\nX60"]
    )
    result = solve(text, control="siemens-840d")
    told = {each.code for each in result.diagnostics}
    assert told == (set() if len({*places}) == 1 else {"position-unknown"})
    for value, place in enumerate(places, 1):
        (answer,) = solve(text, control="siemens-840d", variables={"R1": value}).answers
        assert answer.start.values[0] == place


SKIPPED = {
    "goto": (MILL, "G17 G90 G0 X0. Y0.\nG1 F200\n/GOTO10\nX{}.\nN10 Y30. ,R5.\nX80.\nM30"),
    "goto, switch 2": ("haas-mill", "G17 G90 G0 X0. Y0.\nG1 F200\n/2 N5 GOTO10\nX{}.\nN10 Y30. ,R5.\nX80.\nM30"),
    "call": ("nct-99m", "G17 G90 G0 X0. Y0.\nG1 F200\n/M98 P9001\nY30. ,R5.\nX80.\nM30\nO9001\nX{}.\nM99"),
    "return": (MILL, "G17 G90 G0 X0. Y0.\nG1 F200\nM98 P9001\nY30. ,R5.\nX80.\nM30\nO9001\n/M99\nX{}.\nM99"),
    "variable": ("mitsubishi", "G17 G90 G0 Y0.\nG1 F200\n#1=0\n/#1={}.\nX#1\nY30. ,R5.\nX80.\nM30"),
    "condition": (LATHE, "G0 X0. Z0.\nG1 F200\n/IF[#1 EQ 1]GOTO10\nX{}.\nN10 Z-30. ,R5.\nX80.\nM30"),
    "label": (SIEMENS, "G17 G90 G0 X0 Y0\nG1 F200\n/GOTOF A1\nX{}\nA1: Y30 RND=5\nX80\nM30"),
    "subprogram": (SIEMENS, "G17 G90 G0 X0 Y0\nG1 F200\n/L10\nY30 RND=5\nX80\nM30\n%_N_L10_SPF\nX{}\nM17"),
    "$GOTO": ("isg", "G17 G90 G0 X0 Y0\nG1 F200\n/$GOTO N50\nX{}\nN50 Y30 #RND=5\nX80\nM30"),
    "CALL LBL": ("heidenhain", "L X+0 Y+0 R0 F100\n/CALL LBL 1\nL Y+30\nRND R5\nL X+80\nL M30\nLBL 1\nL X+{}\nLBL 0"),
}


@pytest.mark.parametrize("name", SKIPPED)
def test_what_a_block_with_a_slash_sets_jumps_to_or_calls_is_not_known(name):
    control, text = SKIPPED[name]
    line = next(at for at, each in enumerate(text.splitlines()) if each.startswith("/"))
    lines = text.splitlines()
    both = ["\n".join([*lines[:line], *way, *lines[line + 1 :]]) for way in ([lines[line][1:].lstrip("2 ")], [])]
    if name == "condition":
        both = [each.replace("IF[#1 EQ 1]", "") for each in both]
    for value in (0, 42):
        starts = {solve(each.format(value), control=control).answers[-1].contour.start for each in both}
        result = solve(text.format(value), control=control)
        answer = result.answers[-1]
        assert (answer.status is Status.SOLVED) is (len(starts) == 1)
        if len(starts) == 1:
            assert {answer.contour.start} == starts
        else:
            (finding,) = (each for each in result.diagnostics if each.is_error)
            told = "\n".join((finding.message, *finding.notes))
            assert name == "variable" or (f"program line {line + 1}" in told and "a switch at the machine" in told)


IN_DOUBT = [
    # A jump to an unknown block: behind it nothing is known where a block has a name.
    (MILL, "IF[#500 EQ 1]GOTO#501\nX38. Y0.\nN20 Y10. ,R5.\nX80.", ("position-unknown", 5), None),
    (MILL, "GOTO[#501*10]\nX38. Y0.\nN20 Y10. ,R5.\nX80.", ("position-unknown", 5), None),
    (SIEMENS, 'GOTOF "AA"<<R500\nX38 Y0\nAA1: Y10 RND=5\nX80', ("position-unknown", 5), None),
    # A jump to what is not there: the other way runs.
    (MILL, "IF[#500 EQ 1]GOTO77\nX38.\nY10. ,R5.\nX80.", ("not-followed", 3), (38.0, 0.0)),
    (SIEMENS, "IF R500==1 GOTOF ABSENT\nX38\nY10 RND=5\nX80", ("not-followed", 3), (38.0, 0.0)),
]


@pytest.mark.parametrize(("control", "text", "told", "start"), IN_DOUBT)
def test_a_jump_in_doubt_to_an_unknown_block_or_none_is_told(control, text, told, start):
    result = solve(f"G17 G90 G0 X0. Y0.\nG1 F200\n{text}\nM30", control=control)
    (answer,) = result.answers
    assert told in [(each.code, each.span.line) for each in result.diagnostics]
    assert (answer.contour.start if answer.contour else None) == start
    assert start or any("not known in X and Y" in each.message for each in answer.diagnostics)


KLARTEXT = "0 BEGIN PGM A MM\n1 L X+0 Y+0 R0 FMAX\n{}2 FN 9: IF +Q1 EQU +1 GOTO LBL 5\n{}\nLBL 5\n{}\n9 END PGM A MM"
POLAR, ABOUT_CC = "FL PR+20 PA+30\nFL X+50 Y+20", "L X+40 Y+0\nRND R5\nC X+50 Y+20 DR+"


@pytest.mark.parametrize(
    ("before", "on_one_way", "behind", "told"),
    [
        ("", "FPOL X+5 Y+5", POLAR, ("whether FPOL is in force", "no FPOL X or FPOL X5 (program line 4)")),
        ("FPOL X+1 Y+1\n", "FPOL X+5 Y+5", POLAR, ("FPOL X1 (program line 3) or FPOL X5 (program line 5)",)),
        ("", "CC X+50 Y+10", ABOUT_CC, ("whether CC is in force", "CC X50 (program line 4)")),
        ("", "TOOL CALL 1 X S100", "FL X+40 Y+0\nFL X+50 Y+20", ("tool axis X (program line 4)",)),
        # What all ways agree on, or no word needs.
        ("", "TOOL CALL 1 Z S100", "FL X+40 Y+0\nFL X+50 Y+20", ()),
        ("FPOL X+5 Y+5\n", "FPOL X+5 Y+5", POLAR, ()),
        ("", "FPOL X+9 Y+9", f"FPOL X+5 Y+5\n{POLAR}", ()),
        ("", "FPOL X+9 Y+9", "FL X+40 Y+0\nFL X+50 Y+20", ()),
    ],
)
def test_what_one_way_of_a_klartext_program_puts_in_force_is_doubtful_where_a_word_needs_it(
    before, on_one_way, behind, told
):
    (answer,) = solve(KLARTEXT.format(before, on_one_way, behind), control="heidenhain").answers
    errors = [each for each in answer.diagnostics if each.is_error]
    assert answer.status is (Status.UNDERDETERMINED if told else Status.SOLVED)
    assert [each.code for each in errors] == ["mode-unknown"] * bool(told)
    assert all(part in each.message for each in errors for part in told)
