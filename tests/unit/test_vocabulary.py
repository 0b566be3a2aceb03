"""Words of a block that moves which the control has not, which contoursolve does not read, or which bear on nothing."""

import pytest

import contoursolve
from contoursolve import CONTROLS, Severity, Status
from contoursolve.diagnostics.source import Evidence

MILL = "G17 G90 G0 X0 Y0\n"
SINUMERIK, KLARTEXT, MITSUBISHI = "siemens-840d", "heidenhain", "mitsubishi"


def findings(control, text, **options):
    return contoursolve.check(text, control=control, **options)


@pytest.mark.parametrize("words", ["A+5", "IC+30", "U+3 V+2", "A+3 C+9 M13", "TX+0.5 TY+0.1"])
def test_axes_that_turn_stand_beside_moves_that_a_corner_joins(words):
    text = f"1 L X+0 Y+0 R0 FMAX\n2 L X+60 {words} F200\n3 RND R5\n4 L Y+40 {words}"
    result = contoursolve.solve(text, control=KLARTEXT)
    assert (result.diagnostics, result.answers[0].contour.end) == ((), (60.0, 40.0))
    free = f"1 L X+0 Y+0 R0 FMAX\n2 FL X+60 AN+0 {words}"
    assert any(each.code == "heidenhain-word-unknown" for each in findings(KLARTEXT, free))


def test_a_machine_builder_s_words_are_a_setting():
    text = MILL + "G1 X60 CLAMP=8 F200\nY40 CHR=5\nX20 V9Q=4"
    assert {each.code for each in findings(SINUMERIK, text)} == {"word-unknown", "address-unknown"}
    assert not findings(SINUMERIK, text, settings={"siemens-840d.words": "clamp,V9Q"})
    with pytest.raises(contoursolve.errors.SettingError, match="names with commas between them"):
        findings(SINUMERIK, text, settings={"siemens-840d.words": "a b"})


# What contoursolve does not read ----------------------------------------------------------------------------------


def told(found):
    return [(each.code, each.severity.value, each.message) for each in found]


@pytest.mark.parametrize(
    ("lines", "name"),
    [
        ("G1 X60 RND=3\nCIP X40 Y40 I1=50 J1=20", "CIP"),
        ("CIP X40 Y40 I1=50 J1=20 RND=3\nG1 Y60", "CIP"),
        ("CIP X40 Y40 I1=50 J1=20\nY60 RND=3\nX9", "CIP"),
        ("G1 X10 RND=2\nAP=30 RP=40", "AP"),
        ("G1 X10\nAP=30 RP=40 RND=3\nY60", "AP"),
    ],
)
def test_a_contour_that_needs_it_is_refused_with_its_name_alone(lines, name):
    found = findings(SINUMERIK, f"{MILL}G1 X5 Y5\n{lines}")
    errors = [each for each in found if each.is_error]
    assert {each.code for each in errors} == {"not-read"}
    assert f"contoursolve does not read {name} yet" in {each.message for each in errors}
    assert not any(each.fixes for each in found)


@pytest.mark.parametrize(
    ("control", "call", "end", "corner", "name"),
    [
        (SINUMERIK, "MCALL CYCLE81(1,2)", "MCALL", "RND=2", "MCALL"),
        (SINUMERIK, "MCALL DRILLING", "MCALL", "RND=2", "MCALL"),
        ("fanuc-mill", "G66 P100 A5.", "G67", ",R2.", "G66"),
        ("haas-mill", "G66 P100", "N9 G67", ",R2.", "G66"),
        (MITSUBISHI, "G66 P100", "G67", ",R2.", "G66"),
    ],
)
def test_behind_each_move_of_a_modal_call_nothing_is_known(control, call, end, corner, name):
    """What is called behind each move is not read: the position is not known there, nor behind the last one."""
    head = f"{MILL}G1 X5. Y5. F9.\n{call}\nX10. Y10.\n"
    info = ("not-read", "info", f"contoursolve does not read {name} yet")
    chain, stated = f"Y60. {corner}\nX20.", "X10. Y10.\n"
    if "CYCLE" not in call:
        modes = told(findings(control, head + chain))[1]
        assert modes[0] == "mode-unknown"
        return
    for text in (head + chain, f"{head}{end}\n{chain}", f"{head}{chain}\n{end}\n{chain}\n{stated}"):
        first, *others = told(findings(control, text))
        assert first == info
        assert {each[0] for each in others} == {"position-unknown"}
    result = contoursolve.solve(f"{head}{end}\n{stated}{chain}", control=control)
    assert (told(result.diagnostics), result.answers[0].contour.end) == ([info], (20.0, 60.0))
    assert not told(findings(control, f"{MILL}{end}\nG1 X5. Y5. F9.\n{chain}"))


@pytest.mark.parametrize("decides", ["IF R5>0", "IF R5>0 GOTOF ON"])
def test_ways_that_meet_know_whether_a_modal_call_is_in_force(decides):
    ends = "ENDIF" if "GOTO" not in decides else "ON:"
    text = f"{MILL}G1 X5 Y5 F9\n{decides}\nMCALL HOLES1(1)\n{ends}\nX10 Y10\nX30 Y10\nY60 RND=3\nX20"
    assert {each.code for each in findings(SINUMERIK, text)} == {"not-read", "position-unknown"}


QUIET = """
WAITS(2)|WAITM(1,1,2)|CYCLE832(0.01,1)|FGROUP(X,Y)|GET(C)|RELEASE(C)|GROUP_BEGIN(0,"A",0,0)|GROUP_END(0,0)
G96 S100 LIMS=2000 SCC[X]|WRITE(ERR,"LOG","A")|SETMS(1)|SOFT|STOPRE|SPOS[2]=0|G01 G53 F=0.15|G4 F1
GETSELT(T1)|BRISKA(X)|MCALL
"""


@pytest.mark.parametrize("command", QUIET.strip().replace("\n", "|").split("|"))
def test_predefined_words_neither_move_nor_shift(command):
    text = f"G18 G90 DIAMON\nG0 X60 Z2\nG1 X40 F0.2\n{command}\nG1 Z-20 RND=2\nX52\nM30"
    result = contoursolve.solve(text, control=SINUMERIK)
    assert (result.diagnostics, result.answers[0].contour.end) == ((), (-20.0, 26.0))
    (row,) = (each for each in CONTROLS[SINUMERIK].modes.codes.values() if each.name == "WAITS")
    assert row.source.evidence is Evidence.ASSUMED


def test_r_behind_an_arc_of_sinumerik_is_its_radius():
    text = MILL + "R10=18\nG1 X60 Y-10 F500 RND=3\nG3 X78 Y8 R=R10\nG1 X78 Y50 CHR=2\nG2 X60 Y68 R=R10"
    found = findings(SINUMERIK, text)
    assert [each.fixes[0].description.split(" for ")[0] for each in found if each.fixes] == ["write CR=R10"] * 2
    assert any("the radius of an arc is CR" in each.message for each in found)


@pytest.mark.parametrize("block", ["Y40 RND=CORNER", "Y=CORNER RND=2", "Y40 RND=2*CORNER"])
def test_an_argument_of_a_subprogram_is_one_note(block):
    text = f"PROC POCKET(REAL DEPTH, REAL CORNER)\nG17 G90 G0 X0 Y0\nG1 X60 F200\n{block}\nX20\nM17"
    (finding,) = findings(SINUMERIK, text)
    assert (finding.code, finding.severity) == ("not-checked", Severity.INFO)
    assert "CORNER is an argument of POCKET" in finding.message
    assert not findings(SINUMERIK, text, variables={"CORNER": 3.0})


@pytest.mark.parametrize(
    ("action", "known"),
    [
        ("WHEN $AC_TIME>1 DO M8", True),
        ("ID=1 WHENEVER $AA_IM[X]>2 DO $AC_OVR=0", True),
        ("N40 IDS=2 EVERY R1==1 DO H5", True),
        ("DO R7=5", True),
        ("IDS=1 EVERY $A_IN[1]==1 DO POS[X]=10", False),
        ("WHEN TRUE DO MOV[Y]=1", False),
    ],
)
def test_a_synchronous_action_of_sinumerik_runs_beside_the_program(action, known):
    result = contoursolve.solve(MILL + f"G1 X60 RND=5 F200\n{action}\nY40\nX20 RND=3\nY0", control=SINUMERIK)
    if known:
        assert (result.diagnostics, {each.status for each in result.answers}) == ((), {Status.SOLVED})
        assert result.answers[0].lines == (2, 4)
    else:
        assert any("moves an axis beside the program" in each.message for each in result.diagnostics if each.is_error)


def test_a_formal_parameter_or_a_program_of_one_letter_is_one():
    text = MILL + "A(3)\nM30\nPROC A(REAL C)\nDEF REAL DD=2\nG1 X60 F200 RND=C\nY40 CHR=DD\nX20\nM17"
    result = contoursolve.solve(text, control=SINUMERIK)
    assert (result.diagnostics, [each.status for each in result.answers]) == ((), [Status.SOLVED])


@pytest.mark.parametrize(
    ("control", "text", "fix"),
    [
        (MITSUBISHI, "G17 G90 G00 X0. Y0.\nG02 CR=25. F300\nG01 X70. Y20. A-20.\nX90.", "write R25. for CR=25."),
        (MITSUBISHI, "G17 G90 G00 X0. Y0.\nG02 X10. Y10. CR=25. F300", "write R25. for CR=25."),
        (SINUMERIK, "G17 G90 G0 X0 Y0\nG2 X10 Y10 R25 F300\nG1 X70 RND=3\nY90", "write CR=25 for R25"),
    ],
)
def test_the_radius_of_another_control_is_told_in_each_arc(control, text, fix):
    (found,) = [each for each in findings(control, text) if each.span.line == 2]
    assert found.severity.value == "error"
    assert found.fixes[0].description.startswith(fix)
