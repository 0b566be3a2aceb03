"""Worked examples wrapped in calls and profiles, with parameters; subprograms in files; what is told about calls."""

import re

import pytest
from click.testing import CliRunner
from examples_fanuc import FL_G5, FM_G1, FM_G3
from examples_heidenhain import PROGRAMS

from contoursolve import Status, check, expand, parse, solve, solve_file
from contoursolve.cli import main
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.controls import DIALECTS
from contoursolve.execution.subprograms import Surroundings
from contoursolve.output.document import to_json
from contoursolve.program.calls import machine_for

LATHE, MILL = "fanuc-lathe", "fanuc-mill"
TAPER = "G01 X60. ,A120."


def paths(text: str, control: str, **options) -> list[object]:
    found = []
    for answer in solve(text, control=control, **options).answers:
        ends = [each.end for each in answer.contour.elements] if answer.contour else []
        found.append((answer.status, [tuple(round(at, 5) + 0.0 for at in end) for end in ends]))
    return found


def parametrised(lines: list[str], words: str, name: str, sign: str) -> tuple[list[str], list[str]]:
    """Lines with variables for the numbers of some words, and what sets these."""
    given = list[str]()

    def put(found: re.Match[str]) -> str:
        given.append(f"{name}{101 + len(given)} = {found[2]}")
        return found[1] + sign + name + str(100 + len(given))

    return [re.sub(words, put, line) for line in lines], given


@pytest.mark.parametrize("name", PROGRAMS)
@pytest.mark.parametrize("has_parameters", [False, True])
def test_free_contours_in_a_label(name, has_parameters):
    first, *lines, last = PROGRAMS[name].splitlines()
    body = [re.sub(r" M30$", "", line) for line in lines]
    # A reference to another block (PAR 11, RX 13) is no length.
    given = list[str]()
    if has_parameters:
        body, given = parametrised(body, r"((?<![IR])[XY]|\bAN|\bLEN ?)([-+]?\d+\.?\d*)(?![\w.])", "Q", "+")
    text = "\n".join([first, *given, "CALL LBL 7", "L Z+100 R0 FMAX M30", "LBL 7", *body, "LBL 0", last])
    own = paths(text, "heidenhain")
    assert own == paths(PROGRAMS[name], "heidenhain")
    assert own
    contour = text.replace("CALL LBL 7", "L X-20 Y-20 R0 FMAX\nCYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 LABEL7\nCYCL CALL")
    assert paths(contour, "heidenhain") == own


EXAMPLES = {
    "FL-G5": (LATHE, FL_G5, r"N10 [\s\S]*?(?=N80)"),
    "FM-G1": (MILL, FM_G1, r"G01 X50\.[\s\S]*"),
    "FM-G3": (MILL, FM_G3, r"N5 Y0[\s\S]*?(?=G00 Z50)"),
}


@pytest.mark.parametrize("name", EXAMPLES)
@pytest.mark.parametrize("has_parameters", [False, True])
def test_direct_drawing_in_a_subprogram(name, has_parameters):
    control, text, contour = EXAMPLES[name]
    body = re.search(contour, text)[0].strip().splitlines()
    before = text[: re.search(contour, text).start()].replace("%\n", "")
    lines, given = parametrised(body, r"((?<![A-Z,])[XYZ]|,[ACR])([-+]?\d+\.?\d*)", "#", "")
    lines = lines if has_parameters else body
    called = "\n".join([*given, before.strip(), "M98 P777", "M30", "O777", *lines, "M99"])
    assert paths(called, control) == paths(text, control)
    kept, inline = (expand(called, control=control, inline=each, comments=False) for each in (False, True))
    assert kept.summary.replaced == inline.summary.replaced > 0
    assert ",R" not in kept.text + inline.text
    assert "M98" in kept.text
    assert "M98" not in inline.text


def test_direct_drawing_in_a_profile():
    head, body, end = re.fullmatch(r"([\s\S]*?)(N10[\s\S]*?)(N80[\s\S]*)", FL_G5).groups()
    cycle = f"{head}G71 U2. R1.\nG71 P9 Q70 U.5 W.1\nN9 G00 X16.\nG01 Z0\n{body}G70 P9 Q70\n{end}"
    assert paths(cycle, LATHE) == paths(FL_G5, LATHE)


def test_subprograms_in_files(tmp_path):
    (tmp_path / "main.nc").write_text("G00 X40. Z0.\nM98 P100\nM98 P200\nG01 X80. ,A120.\nM30")
    (tmp_path / "O0100.nc").write_text(f"O0100\n{TAPER}\nM99")
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "o200").write_text("O0200\nG01 X70. ,A0.\nM99")
    alone = solve_file(tmp_path / "main.nc", control=LATHE)
    assert any("O0200.nc beside it: name its folder with --path" in each.message for each in alone.diagnostics)
    found = solve_file(tmp_path / "main.nc", control=LATHE, folders=[tmp_path / "other"])
    assert [each.code for each in found.diagnostics if each.code == "subprogram-refused"] == ["subprogram-refused"]
    assert next(each for each in found.diagnostics if each.code == "subprogram-refused").span.line == 3
    done = CliRunner().invoke(main, ["check", str(tmp_path / "main.nc"), "--control", LATHE])
    assert "--path" in done.output


def test_what_nothing_calls_begins_where_start_says(tmp_path):
    for control, text, start in (
        (LATHE, f"#1=0\nG00 X40. Z0.\nM30\nO8\n{TAPER}\nM99", "X50. Z0."),
        ("siemens-840d", "%_N_M_MPF\nG17 G0 X40 Y0\nM30\n%_N_L8_SPF\nG1 X60 ANG=20\nM17", "X50 Y0"),
    ):
        result = solve(text, control=control)
        assert [each.status for each in result.answers] == [Status.UNDERDETERMINED]
        assert "--start" in result.diagnostics[0].message
        file = tmp_path / "main.nc"
        file.write_text(text)
        done = CliRunner().invoke(main, ["solve", str(file), "--control", control, "--start", start])
        assert done.exit_code == 0, done.output


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (f"G00 X40. Z0.\nM98 P1\nM30\nO1\n{TAPER}\nM98 P1\nM99", "calls itself again and again"),
        (
            f"G00 X40. Z0.\n{TAPER}\n#1=0\nWHILE [#1 GE 0] DO1\n#1=#1+1.\nEND1\nM30",
            "more than 5,000 blocks run again: the program may never end; --set fanuc-lathe.most-blocks=",
        ),
        (f"G00 X40. Z#5041\n{TAPER}", "#5041"),
        (
            f"G00 X40. Z0.\nIF [#900 EQ 1] GOTO 5\nG00 X45.\nN5 {TAPER}",
            "X40. (program line 1) or X45. (program line 3)",
        ),
        (
            "G00 X40. Z0.\nM98 P1\nG00 X58. Z0.\nM98 P1\nM30\nO1\nG01 Z-20. ,R5.\nX60.\nM99",
            "called in program line 4: from",
        ),
        ("G00 X60. Z2.\nG71 P1 Q2 U.5\nN1 G00 X20.\nG01 Z-20. ,R3.\nX40. ,A120.\nX30.\nN2 Z-60.", "X"),
    ],
)
def test_what_is_told(text, told):
    assert any(told in each.message for each in solve(text, control=LATHE).diagnostics)


BRANCHES = {
    "fanuc-lathe": """#100={0}
G00 X40. Z0.
IF [#100 EQ 2] GOTO 20
G01 X60. ,A120.
Z-40. ,R3.
X80.
GOTO 30
N20 G01 X50. ,A110.
N30 G00 X100. Z5.
G01 X110. ,A100.
M30""",
    "haas-lathe": """#100={0}
G00 X40. Z0.
IF [#100 EQ 1] THEN G01 X42.
IF [#100 EQ 2] GOTO 20
G01 X60. A120.
N20 G01 X70. A110.
M30""",
    "siemens-840d": """R1={0}
G17 G90 G0 X5 Y5
IF R1==1
G1 X20 ANG=45
ELSE
IF R1==2
G1 X30 ANG=30
ENDIF
ENDIF
G0 X0 Y0
IF R1<>1 GOTOF SLOT
G1 Y80 ANG=60
GOTOF ENDS
SLOT: G1 Y70 ANG=50
ENDS: M30""",
    "isg": """P1={0}
G17 G90 G0 X5 Y5
$IF P1==1
G1 X20 #ANG=45
$ELSE
G1 X30 #ANG=30
$ENDIF
M30""",
    "heidenhain": """BEGIN PGM A MM
Q1 = {0}
L X+10 Y+10 R0 F100
FN 9: IF +Q1 EQU +2 GOTO LBL 5
FL X+40 AN+30
LBL 5
L X+10 Y+10
FL X+50 AN+20
END PGM A MM""",
}


@pytest.mark.parametrize("control", BRANCHES)
def test_a_part_that_does_not_run_begins_where_the_decision_was_made(control):
    one, two = (solve(BRANCHES[control].format(value), control=control) for value in (1, 2))
    assert {each.status for each in one.answers} == {Status.SOLVED}
    if control != "haas-lathe":
        assert [(each.lines, each.start.values) for each in one.answers] == [
            (each.lines, each.start.values) for each in two.answers
        ]
    for value, result in enumerate((one, two), 1):
        documents = Document("", BRANCHES[control].format(value).encode()), Document("", to_json(result).encode())
        assert verify(*documents).verdict is ReceiptVerdict.VERIFIED


def test_decisions_in_another_file_are_made_as_well(tmp_path):
    (tmp_path / "plan.h").write_text(
        "BEGIN PGM PLAN MM\n; REMARK\n; REMARK\n; REMARK\n"
        "FN 9: IF +Q1 EQU +2 GOTO LBL 5\nL X+10 Y+10 F100\nLBL 5\nEND PGM PLAN MM"
    )
    main_program = tmp_path / "main.h"
    for value, status in ((1, Status.SOLVED), (2, Status.UNDERDETERMINED)):
        main_program.write_text(f"BEGIN PGM A MM\nQ1 = {value}\nCALL PGM PLAN.H\nFL X+40 AN+30\nEND PGM A MM")
        assert [each.status for each in solve_file(main_program).answers] == [status]


def test_what_is_wrong_in_a_part_that_does_not_run_stops_nothing():
    text = BRANCHES[LATHE].format(1).replace("X50. ,A110.", "X50. Z-40. ,A110.")
    (finding,) = solve(text, control=LATHE).diagnostics
    assert (finding.code, finding.severity.value) == ("words-conflict", "warning")
    assert "the program passes over this line" in finding.notes[0]
    assert solve(text.replace("#100=1", "#100=2"), control=LATHE).diagnostics[0].severity.value == "error"
    behind = "G00 X40. Z0.\nGOTO 9\nG01 X60. ,A120.\nN9 M30"
    assert [each.severity.value for each in solve(behind, control=LATHE).diagnostics] == ["warning"]


def test_what_calls_itself_twice_is_not_run_at_every_depth():
    text = f"G00 X40. Z0.\nM98 P1\n{TAPER}\nM30\nO1\n{TAPER}\nM98 P1\nG01 Z-80. ,R#1\nX70.\nM98 P1\nM99"
    result = solve(text, control=LATHE)
    assert not any("5,000" in each.message for each in result.diagnostics)
    assert result.answers[0].lines == (3,)


@pytest.mark.slow
def test_each_pass_of_a_loop_is_told_with_its_own_values_and_the_first_ones_are_explained():
    passes = 120
    text = f"#1=1\nWHILE [#1 LE {passes}] DO1\nG00 X40. Z0.\nG01 X60. Z-[#1*0.5] ,A170.\n#1=#1+1\nEND1\nM30"
    found = [each for each in solve(text, control=LATHE).diagnostics if each.code == "words-conflict"]
    assert len(found) == passes
    for number, each in enumerate(found, 1):
        assert f"-[#1*0.5] is -{number / 2:.1f}".removesuffix("0").removesuffix(".") in "".join(each.notes)
        assert all("Z-[#1*0.5]" in fix.replacement for fix in each.fixes if ",A170." not in fix.replacement)
        assert ("only the first 100" in "".join(each.notes)) is (number > passes - 20)
        assert bool(each.fixes) is (number <= passes - 20)


def test_values_that_are_stated_hold():
    text = "#100=1.\nG00 X#100 Z0.\nG01 X#101 ,A120."
    assert paths(text, LATHE, variables={"#100": 40.0, "#101": 60.0}) == paths(f"G00 X40. Z0.\n{TAPER}", LATHE)


def test_a_corner_ends_at_a_call_and_what_is_between_is_told():
    called = "G00 X40. Z0.\nG01 Z-20. ,R5.\nM98 P1\nG00 X60. Z0.\nG01 X70. ,A120.\nM30\nO1\nG01 X80. Z-30.\nM99"
    result = solve(called, control=LATHE)
    assert [each.lines for each in result.answers] == [(2,), (5,)]
    assert [each.status for each in result.answers] == [Status.REJECTED, Status.SOLVED]


def test_words_beside_a_contour_keep_their_formulas():
    text = "R1=50 R2=0.5\nL7\nL7\nM30\n%_N_L7_SPF\nG17 G0 X0 Y0\nG1 X=R1 Y10 F=R2*2 CHF=SQRT(R1-46)\nX80 Y50 F200\nM17"
    found = expand(text, control="siemens-840d", comments=False).text
    assert "F=R2*2" in found
    assert "SQRT" not in found


ENDS = {
    "fanuc": ("O1\nG21 G90 G0 X0. Y0.\n{}\nO9001\nG1 X10. ,R1. F100\nY10.\nM99", "M98 P9001", ("M30", "M02", "M99")),
    "siemens": ("G90 G0 X0 Y0\n{}\n%_N_SUB1_SPF\nG1 X10 RND=1 F100\nY10\nM17", "SUB1", ("M30", "M2", "M17", "RET")),
    "isg": ("%MAIN\nG90 G0 X0 Y0\n{}\n%L S\nG1 X10 #RND=5 F100\nY10\nM17", "L S", ("M30", "M02", "M17")),
    "heidenhain": ("L X+0 Y+0 F100\nL X+1 {}\nLBL 1\nFL X+10 AN+0\nLBL 0", "CALL LBL 1", ("M30", "M2")),
}
LIKE = {"siemens-840d": "siemens", "siemens-808d": "siemens", "isg": "isg", "heidenhain": "heidenhain"}


@pytest.mark.parametrize("control", [each for each in DIALECTS if each != "cnc-pilot"])
def test_an_end_and_a_call_in_one_block_is_told_whatever_their_order(control):
    """How a CNC PILOT calls is on no page that we have."""
    text, call, ends = ENDS[LIKE.get(control, "fanuc")]
    for end in ends:
        one, two = (solve(text.format(each), control=control) for each in (f"{end} {call}", f"{call} {end}"))
        told = [each.message for each in one.diagnostics]
        assert told == [each.message for each in two.diagnostics]
        # A lathe has no contour in it.
        assert one.answers or control == "yasnac-lx3"
        if one.answers:
            assert any("in one block: which comes first is not known" in each for each in told)
            assert {each.status for each in one.answers} <= {Status.UNDERDETERMINED, Status.REJECTED}
        inline = expand(text.format(f"{end} {call}"), control=control, inline=True, keep_going=True)
        assert f"{end} {call}" in inline.text


PASSES = "G17 G90 G0 X0 Y0\n{}\nM30"
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
    text = PASSES.format("R1=0\n" + OUTER[outer].format(INNER[inner]))
    result = solve(text, control="siemens-840d")
    assert [each.start.values for each in result.answers] == [(10 * at, 10 * at) for at in range(4)]
    assert not result.diagnostics
    assert expand(text, control="siemens-840d", inline=True).summary.replaced == 4


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
    told = [each.message for each in into.diagnostics if each.code == "not-followed"]
    assert told == [
        "program line 2 jumps into the loop that program line 4 begins: how often that runs then is not known"
    ]
    assert {each.status for each in into.answers} == {Status.UNDERDETERMINED}


@pytest.mark.parametrize("value", [1, 2, 3])
def test_case_jumps_once(value):
    text = f"""R1={value}
G17 G90 G0 X0 Y0
CASE R1 OF 1 GOTOF AA1 2 GOTOF AA2 DEFAULT GOTOF AA3
AA1: G1 X10 ANG=45
GOTOF AA4
AA2: G1 X20 ANG=45
GOTOF AA4
AA3: G1 X30 ANG=45
AA4: G1 X50 ANG=0
M30"""
    assert [each.start.values[0] for each in solve(text, control="siemens-840d").answers] == [0, 0, 0, 10 * value]


@pytest.mark.parametrize(
    ("control", "text", "told"),
    [
        (
            "heidenhain",
            "L X+0 Y+0 F100\nCALL LBL 1 REP2\nFL X+50 AN+20\nM30\nLBL 1\nL IX+5\nLBL 0",
            "CALL LBL 1 REP2 repeats from program line 5 up to itself, but that line stands after it",
        ),
        (
            "siemens-840d",
            "G17 G90 G0 X0 Y0\nREPEAT AAA P=2\nG1 X50 ANG=20\nM30\nAAA: G1 X=IC(5)\nM17",
            "REPEAT AAA P=2 repeats from program line 5 up to itself, but that line stands after it",
        ),
        (
            "siemens-840d",
            "G17 G90 G0 X0 Y0\nBBB: X1\nAAA: X2\nREPEAT AAA BBB\nG1 X50 ANG=20",
            "REPEAT AAA BBB runs from program line 3, but its last line, 2, stands before that",
        ),
    ],
)
def test_a_repetition_of_what_stands_behind_it_is_told(control, text, told):
    result = solve(text, control=control)
    assert told in [each.message for each in result.diagnostics if each.code == "not-followed"]
    assert result.answers[0].status is Status.UNDERDETERMINED
    inline = expand(text, control=control, inline=True, keep_going=True)
    assert told.partition(" repeats")[0].partition(" runs")[0] in inline.text
    assert inline.summary.left


@pytest.mark.parametrize(("value", "start"), [("1", 25), ("2", 20), ("#5041", None)])
def test_words_behind_then_run_if_the_condition_holds(value, start):
    text = f"#100={value}\nG00 X40. Z0.\nIF [#100 EQ 1] THEN G01 X50. F.2\nG01 Z-20. ,R1.\nX60."
    assert solve(text, control="haas-lathe").answers[0].start.values[1] == start
    inline = expand(text, control="haas-lathe", inline=True, keep_going=True)
    assert ("G01 X50. F.2" in inline.text.split("\n")) is (start == 25)
    assert ("THEN" in inline.text) is (start is None)


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
    done = CliRunner().invoke(main, ["check", str(main_program)])
    told = "is solved" if is_right else "corner 1 does not fit"
    assert (done.exit_code, told in done.output) == (0 if is_right else 1, True), done.output
    assert "no contour of its own examined" in done.output
    kept = CliRunner().invoke(main, ["expand", str(main_program)])
    assert ("in this file: nothing to expand" in kept.output, told in kept.output) == (True, True), kept.output
    assert ("expand --inline writes it out" in kept.output) is is_right
    if call != "CYCLE95":
        inline = CliRunner().invoke(main, ["expand", "--inline", str(main_program)])
        assert inline.exit_code == (0 if is_right else 1), inline.output


def test_comments_and_files_that_call_each_other_end(tmp_path):
    (tmp_path / "main.nc").write_text("(FLANGE)\nG00 X60. Z2.\nM98 P1\nM30")
    (tmp_path / "O0001.nc").write_text("O1\nM98 P2\nM99")
    (tmp_path / "O0002.nc").write_text("O2\nM98 P1\nM99")
    (tmp_path / "FLANGE.txt").write_text("FL X+10 AN+0")
    done = CliRunner().invoke(main, ["check", str(tmp_path / "main.nc")])
    assert (done.exit_code, "nothing to solve" in done.output) == (0, True), done.output


ENDLESS = "G17 G21 G90 G0 X0. Y0.\n#1=1\nWHILE[#1 GT 0]DO1\n#1=#1+1\nG01 X10. ,R1. F100\nY10.\nX0\nY0\nEND1"


def ran(text: str, control: str, **settings: str) -> tuple[int, list[str]]:
    """How many blocks run, and what is told of following them."""
    dialect = DIALECTS[control].configure({name.replace("_", "-"): value for name, value in settings.items()})
    machine = machine_for(parse(text), dialect, Surroundings())
    several = [*machine.run()]
    return sum(hasattr(each, "words") for each in several), [each.reason for each in several if hasattr(each, "kind")]


def test_a_loop_that_may_never_end_is_followed_as_far_as_a_setting_says():
    for blocks in (5_000, 1_000):
        count, told = ran(ENDLESS, MILL, **({} if blocks == 5_000 else {"most_blocks": str(blocks)}))
        assert blocks / 2 < count < blocks + 20
        assert any(f"more than {blocks:,} blocks run again" in each for each in told)
    passes = "#1=0\nWHILE[#1 LT 3000]DO1\n#1=#1+1.\nEND1\nG0 X0. Y0.\nG1 X20. ,R1. F1.\nY20."
    short, long = (solve(passes, control=MILL, settings=each) for each in ({}, {f"{MILL}.most-blocks": "20000"}))
    assert [each.code for each in short.diagnostics if each.code == "not-followed"]
    assert [each.status for each in long.answers] == [Status.SOLVED]
    assert not long.diagnostics


@pytest.mark.parametrize(
    ("control", "text"),
    [
        (MILL, "O9001\n#3000=1 M98 P9001 L2"),
        (MILL, "O1\nM98 P2\nM30\nO2\nG0 X1.\nM98 P3 L9\nM99\nO3\nM98 P2 L9\nM99"),
        (MILL, "O1\nG65 P2 A1.\nM30\nO2\nG0 X#1\nG65 P2 A1. L9\nM99"),
        ("siemens-840d", "%_N_A_MPF\nL1\nM30\n%_N_L1_SPF\nG0 X1\nL1 P99\nM17"),
        ("heidenhain", "CALL LBL 1\nM30\nLBL 1\nL X+1 F100\nCALL LBL 1\nCALL LBL 1\nLBL 0"),
        (MILL, "#1=1\nN1 G0 X1.\nGOTO 1"),
        ("siemens-840d", "R1=1\nLOOP\nG0 X1\nENDLOOP"),
    ],
)
def test_what_provably_never_ends_is_told_after_a_few_blocks(control, text):
    count, told = ran(text, control)
    assert count < 100
    assert any("nothing changes from" in each for each in told)


def test_a_loop_that_counts_in_a_local_variable_ends():
    loop = "#2=0\nWHILE[#2 LT #1]DO1\n#2=#2+1.\nG1 X[#2*10.] ,R1. F1.\nY[#2*10.]\nEND1"
    text = f"G0 X0. Y0.\nG65 P9 A3.\nM30\nO9\n{loop}\nM99"
    result = solve(text, control=MILL)
    assert len(result.answers) == 3
    assert not result.diagnostics


TURNED = "O1\nG00 X60. Z2.\nG71 P10 Q{} U.5 W.1\nN10 G00 X20.\nG01 Z-20. ,R3. F.1\nN60 X40.\n{}M30"
MILLED = "O1\nG17 G90 G0 X0. Y0.\n{}\nN10 G1 X10. ,R1. F1.\n{} Y10.\nM30"


@pytest.mark.parametrize(
    ("control", "text", "told"),
    [
        (LATHE, TURNED.format(58, ""), "G71 P10 Q58 U.5 W.1 names block 58, which is not there"),
        (
            LATHE,
            TURNED.format(60, "N60 X42.\n"),
            "program line 3 names block 60, which stands twice, in program lines 6 and 7",
        ),
        (
            MILL,
            MILLED.format("GOTO 10", "N10"),
            "program line 3 names block 10, which stands twice, in program lines 4 and 5",
        ),
        ("haas-mill", MILLED.format("M97 P10\nM30", "N10"), "program line 3 names block 10, which stands twice"),
        ("haas-mill", MILLED.format("M97 P12", "N11"), "M97 P12 names block 12, which is not there"),
        (
            "siemens-840d",
            "G17 G90 G0 X0 Y0\nGOTOF N10\nN10 G1 X10 RND=1\nN10 Y10",
            "program line 2 names block N10, which stands twice, in program lines 3 and 4",
        ),
        (
            "heidenhain",
            "CALL LBL 1\nM30\nLBL 1\nL X+0 Y+0 F100\nFL X+10 AN+0\nLBL 0\nLBL 1\nLBL 0",
            "program line 1 names label 1, which stands twice, in program lines 3 and 7",
        ),
        # Nothing jumps there; or the number stands in another program.
        (MILL, MILLED.format("G0 Z1.", "N10"), ""),
        (MILL, MILLED.format("GOTO 10", "N11") + "\nO2\nN10 G0 Z1.\nM99", ""),
        (LATHE, "O1\nN10 G00 X60.\nM30\n" + TURNED.format(60, "").replace("O1", "O2"), ""),
    ],
)
def test_a_block_that_is_named_and_stands_nowhere_or_twice_is_told(control, text, told):
    found = [each.message for each in solve(text, control=control).diagnostics if each.code == "not-followed"]
    assert [each.startswith(told) for each in found] == [True] * bool(told)


LABELLED = """0 BEGIN PGM A MM
1 L X+0 Y+0 R0 F100
2 LBL 2
3 L X+10 Y+0
4 FL X+20 AN+10
5 {}
6 LBL "END"
7 CALL LBL 7
8 L Z+100 R0 FMAX M30
9 LBL 7
10 FL X+30 AN+10
11 LBL 0
12 END PGM A MM
"""


@pytest.mark.parametrize(
    "line", ["CALL LBL 2 REP 1", 'FN 9: IF +1 EQU +1 GOTO LBL "END"', "FN 9: IF +1 EQU +2 GOTO LBL 2"]
)
def test_labels_that_nothing_names_any_more_are_not_written(line):
    inline = expand(LABELLED.format(line), control="heidenhain", inline=True, comments=False)
    assert "LBL" not in inline.text


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
    advice = "delete the block, or its /" if line.startswith("/") else "state its value by --let"
    assert (inline.text, left.lines) == (None, (3,))
    assert re.fullmatch(rf"{re.escape(line)} cannot be decided: .+; {advice}, or leave out --inline", left.reason)


def test_a_jump_that_a_stated_value_decides_is_written_out():
    control, text, line = UNDECIDED["goto"]
    for value, is_taken in ((1, True), (2, False)):
        inline = expand(text.format(line), control=control, inline=True, variables={"#500": value}, comments=False)
        assert ("X38." in inline.text) is not is_taken
        assert "GOTO" not in inline.text


def test_the_command_names_the_line_and_the_file_of_such_a_jump_and_writes_nothing(tmp_path):
    (tmp_path / "main.nc").write_text("G17 G90 G0 X0. Y0.\nG1 F200\nM98 P5\nM30")
    (tmp_path / "O0005.nc").write_text("O5\nX38.\nIF[#500 EQ 1]GOTO9\nY10. ,R5.\nX80.\nN9 M99")
    words = ["expand", "--inline", "--keep-going", "--control", "fanuc-mill", str(tmp_path / "main.nc")]
    done = CliRunner().invoke(main, words)
    told = "program line 3: IF[#500 EQ 1]GOTO9, line 3 of O0005.nc, cannot be decided: #500 is set by nothing before"
    assert (done.exit_code, done.stdout, told in done.stderr) == (1, "", True), done.stderr
    assert done.stderr.endswith("\nnothing was written\n")


CUTS = "G71 U2. R1.\nG71 P10 Q60 U.5 W.1 F.3\nN10 G00 X16.\nG01 Z0.\nX30. ,C1.5\nN60 Z-20.\n"


@pytest.mark.parametrize(
    ("text", "numbers"),
    [
        (f"O1\nG00 X64. Z2.\n{CUTS}N70 M98 P2\nN80 M30\nO2\nN10 G01 X70. Z-30.\nN70 X80. ,R2.\nN90 Z-50.\nM99", ""),
        (f"O1\nG00 X64. Z2.\n{CUTS}N70 M98 P2 L2\nN80 M30\nO2\nN90 G01 U5. ,R1.\nN91 W-5.\nN92 M99", "90 91"),
        (f"O1\nG00 X64. Z2.\nM98 P2\nN80 M30\nO2\n{CUTS}M99", "10 60"),
    ],
)
def test_calls_that_are_written_out_leave_each_block_number_once(text, numbers):
    inline = expand(text, control="fanuc-lathe", inline=True, comments=False)
    found = re.findall(r"(?m)^N(\d+)", inline.text)
    assert len(found) == len({*found})
    assert set(numbers.split()) <= {*found}
    assert inline.summary.left == []


def test_a_profile_that_is_written_out_twice_is_told():
    text = f"O1\nG00 X64. Z2.\nM98 P2 L2\nN80 M30\nO2\n{CUTS}M99"
    inline = expand(text, control="fanuc-lathe", inline=True, keep_going=True)
    assert "G71 names N10, which stands twice in a program without calls" in {
        each.reason for each in inline.summary.left
    }


LIBRARIES = [
    ("fanuc-mill", "O7002\nG90 G17\nG00 X0 Y0\nG01 X#24 F200 ,R#18\nY40.\nX0\nM99", "#24"),
    ("siemens-840d", "G17 G90 G0 X0 Y0\nG1 X=R1 RND=R2\nY40\nX20\nM17", "R1"),
]


@pytest.mark.parametrize(("control", "program", "name"), LIBRARIES)
def test_what_a_program_that_others_call_sets_nowhere_is_an_argument(control, program, name):
    told = check(program, control=control)
    assert [(each.code, each.severity.value) for each in told] == [("not-checked", "info")]
    assert told[0].message == f"not checked: {name} is an argument of this program, and each call gives it"
    main = program.replace("M99", "M30").replace("M17", "M30")
    assert "error" in {each.severity.value for each in check(main, control=control)}


def test_a_loop_that_ends_by_what_nobody_knows_is_not_said_to_run_for_ever():
    program = "O1\n#1=5.\nN5 #1=#1-#5041\nG01 X10. ,R1.\nY10.\nX0\nY0\nIF[#1 GT 0]GOTO6\nN6 GOTO5\nM30"
    told = " ".join(each.message for each in check(program, control="fanuc-mill", start="X0 Y0"))
    assert "runs for ever" not in told
