"""Words of a block that moves which the control has not, which contoursolve does not read, or which bear on nothing."""

import pytest

import contoursolve
from contoursolve import DIALECTS, Severity, Status
from contoursolve.diagnostics.source import Evidence

MILL = "G17 G90 G0 X0 Y0\n"
SINUMERIK, ISG, KLARTEXT, YASNAC, MITSUBISHI = "siemens-840d", "isg", "heidenhain", "yasnac-lx3", "mitsubishi"
LATHE_CONTOUR = "G111 A180. K-30. B120. X140."
BESIDE = {
    SINUMERIK: MILL + "G1 X60 {} F200\nY40 CHR=5\nX20",
    ISG: MILL + "G1 X60 {} F200\nY40 #CHR=5\nX20",
    MITSUBISHI: MILL + "G1 X60. {} F200\nY40. ,R5.\nX20.",
    "fanuc-mill": MILL + "G1 X60. {} F200\nY40. ,R5.\nX20.",
    "haas-mill": MILL + "G1 X60. {} F200\nY40. ,R5.\nX20.",
    "nct-99m": MILL + "G1 X60. {} F200\nY40. ,R5.\nX20.",
    "fanuc-lathe": "G0 X40. Z0.\nG1 X60. {} F.2\nZ-40. ,R5.\nX80.",
    "haas-lathe": "G0 X40. Z0.\nG1 X60. {} F.2\nZ-40. ,R5.\nX80.",
    YASNAC: "G00 X40. Z0.\nG01 X100. {} F.2\n" + LATHE_CONTOUR,
    KLARTEXT: "1 L X+0 Y+0 R0 FMAX\n2 L X+60 {} F200\n3 L Y+40\n4 RND R2\n5 L X+0",
}
"""A block that moves, with a word besides; a contour stands behind it."""


def findings(control, text, **options):
    return contoursolve.check(text, control=control, **options)


ALONE = {
    SINUMERIK: MILL + "G1 X60 F200\nY40 {}\nX20",
    ISG: MILL + "G1 X60 F200\nY40 {}\nX20",
    KLARTEXT: "1 L X+0 Y+0 R0 FMAX\n2 L X+60 F200\n3 {}\n4 L Y+40",
    "fanuc-lathe": "G0 X40. Z0.\nG1 X60. F.2\nZ-40. {}\nX80.",
    "nct-99m": MILL + "G1 X60. F200\nY40. {}\nX20.",
}
"""Programs whose only word of a contour is misspelt."""

BEFORE = {SINUMERIK: MILL + "{}\nG1 X60 F200\nY40 RND=5\nX20"}
COMMAND = {SINUMERIK: "G17 G90\n{}\nG0 X0 Y0\nG1 X60 F200\nY40 RND=5\nX20"}
G111 = {YASNAC: "G0 X40. Z0.\nG111 {} X100."}
POLAR = {KLARTEXT: "1 L X+0 Y+0 R0 F100\n2 L X+10\n3 RND R3\n4 {}\n5 END PGM A MM"}
ANY = dict.fromkeys(DIALECTS, "{}")
TOLD = [
    (SINUMERIK, BESIDE, "RN=8", "word-mistyped e2", "write RND=8 or RNDM=8"),
    (SINUMERIK, BESIDE, "RD=8", "word-mistyped e2", "write RND=8 or RNDM=8"),
    (SINUMERIK, BESIDE, "RMD=8", "word-mistyped e2", "write RND=8"),
    (SINUMERIK, BESIDE, "CHAM=2", "word-mistyped e2", "write CHR=2 or CHF=2"),
    (SINUMERIK, BESIDE, "CHFR=2", "word-mistyped e2", "write CHF=2 or CHR=2"),
    (SINUMERIK, BESIDE, "CRH=2", "word-mistyped e2", "write CHR=2 or CR=2"),
    (SINUMERIK, BESIDE, "SPSO=90", "word-mistyped e2", "write SPOS=90"),
    (ISG, BESIDE, "#RDN=5", "word-mistyped e2", "write #RND=5"),
    (ISG, BESIDE, "#FASE=1", "word-mistyped e2", "write #CHR=1 or #CHF=1"),
    (MITSUBISHI, BESIDE, "#CHR=1", "word-mistyped e2", "write ,C1"),
    (MITSUBISHI, BESIDE, "RND=4", "word-mistyped e2", "write ,R4"),
    (MITSUBISHI, BESIDE, ",B120.", "word-mistyped e2", "write ,A120., ,C120. or ,R120."),
    ("fanuc-lathe", BESIDE, ",B120.", "word-mistyped e2", "write ,A120., ,C120. or ,R120."),
    ("fanuc-mill", BESIDE, "RAD=2", "word-mistyped e2", "write ,R2"),
    ("haas-mill", BESIDE, ",D2.", "word-mistyped e2", "write ,C2. or ,R2."),
    ("nct-99m", BESIDE, ",E2.", "word-mistyped e2", "write ,C2., ,R2. or ,A2."),
    ("fanuc-lathe", ALONE, ",FIL5.", "word-mistyped e3", "write ,R5."),
    ("fanuc-lathe", ALONE, "R,5.", "word-mistyped e3", "write ,R5."),
    ("fanuc-lathe", ALONE, ",ANG30.", "word-mistyped e3", "write ,A30."),
    ("nct-99m", ALONE, ".R5.", "word-mistyped e3", "write ,R5."),
    (ISG, ALONE, "#C5", "word-mistyped e3", "write #CHR=5 or #CHF=5"),
    (ISG, ALONE, "##RND=5", "word-mistyped e3", "write #RND=5"),
    (ISG, ALONE, ",R5", "stray-character e3", "write #RND=5 for ,R5"),
    (SINUMERIK, ALONE, "R=5", "word-mistyped e3", "write RND=5 or RNDM=5"),
    (SINUMERIK, ALONE, ",C5", "stray-character e3", "write CHR=5 or CHF=5 for ,C5"),
    (SINUMERIK, ALONE, "RND:5", "stray-character e3", "write RND=5 or RNDM=5 for RND:5"),
    (ISG, ALONE, "RND=5", "comma-word-unknown e3", "write #RND=5"),
    (ISG, ALONE, "CHR5", "comma-word-unknown e3", "write #CHR=5 or #CHF=5"),
    (ISG, ALONE, "ANG30", "comma-word-unknown e3", "write #ANG=30"),
    (SINUMERIK, ALONE, "R5", "word-mistyped e3", "write RND=5 or RNDM=5"),
    ("fanuc-lathe", ALONE, "#R5.", "stray-character e3", "write ,R5. for #R5."),
    ("fanuc-lathe", ALONE, "#C5.", "stray-character e3", "write ,C5. for #C5."),
    ("fanuc-lathe", ALONE, "ANG30.", "comma-word-unknown e3", "write ,A30."),
    (KLARTEXT, ALONE, "RND 5", "number-malformed e3", "write RND R5 for RND 5"),
    (KLARTEXT, ALONE, "RND=5", "number-malformed e3", "write RND R5 for RND=5"),
    (KLARTEXT, ALONE, "RMD R5", "word-mistyped e3", "write RND R5"),
    (KLARTEXT, ALONE, "RNDR5", "word-mistyped e3", "write RND R5"),
    (KLARTEXT, ALONE, "RDN R5", "word-mistyped e3", "write RND R5"),
    (KLARTEXT, ALONE, "ROUND R5", "word-mistyped e3", "write RND R5"),
    (KLARTEXT, ALONE, "CFH 5", "word-mistyped e3", "write CHF 5"),
    (KLARTEXT, ALONE, "FAS 5", "word-mistyped e3", "write CHF 5"),
    (KLARTEXT, ALONE, "CHR5", "word-mistyped e3", "write CHF 5"),
    (SINUMERIK, BESIDE, "QZW=5", "word-unknown w2", "QZW=5: contoursolve knows no word QZW of this control"),
    (ISG, BESIDE, "#QZW=5", "word-unknown w2", "#QZW=5: contoursolve knows no word #QZW of this control"),
    (MITSUBISHI, BESIDE, "P5", "word-idle w2", "P5 means nothing in a line that ends at coordinates"),
    ("fanuc-mill", BESIDE, "P5", "word-unknown w2", "P5: contoursolve knows no word P of this control"),
    ("fanuc-lathe", BESIDE, "P5", "word-unknown w2", "P5: contoursolve knows no word P of this control"),
    (YASNAC, BESIDE, "E135.", "word-unknown w2", "E135.: contoursolve knows no word E of this control"),
    (
        YASNAC,
        ANY,
        "G00 X40. Z0.\nG111 A180. K-30. E135. X100.",
        "address-unknown e2",
        "E135.: the address E has no meaning",
    ),
    (SINUMERIK, BESIDE, "CR=5", "word-idle w2", "CR=5 means nothing in a line that ends at coordinates"),
    (SINUMERIK, ANY, MILL + "G1 X60 RND=8,5\nY40 X70 CHR=5\nX20", "number-malformed e2", "write RND=8.5 for RND=8,5"),
    (SINUMERIK, ANY, MILL + "G1 X60,5 RND=8\nY40 X70 CHR=5\nX20", "number-malformed e2", "write X60.5 for X60,5"),
    (SINUMERIK, ANY, MILL + "G1 X60 ANG=30,5\nY40 X70", "number-malformed e2", "write ANG=30.5 for ANG=30,5"),
    (ISG, ALONE, "#RND=5,5", "number-malformed e3", "write #RND=5.5 for #RND=5,5"),
    (ISG, ALONE, "#RND = 5,25", "number-malformed e3", "write #RND=5.25 for #RND = 5,25"),
    ("fanuc-lathe", ANY, "G0 X40. Z0.\nG1 Z-40. ,C1. 5\nX80.", "stray-character e2", "write ,C1.5 for ,C1. 5"),
    (SINUMERIK, ANY, "G18 G90 G0 X0 Z0\nG1 Z-40. CHR=1. 5\nX80", "stray-character e2", "write CHR=1.5 for CHR"),
    (ISG, ANY, MILL + "G1 #ANG30\nX60 #ANG=90\nX20 Y40", "number-malformed e2", "write #ANG=30 for #ANG30"),
    (KLARTEXT, ANY, "1 L X+0 Y+0\n2 FLAN+30 LEN20\n3 FL X+60 Y+40", "blank-missing e2", "FL is not set apart"),
    (KLARTEXT, ANY, "1 L X+0 Y+0\n2 FL X+60 Y+0\n3 CHF R5\n4 FL Y+40 AN+90", "number-malformed e3", "write CHF 5"),
    (KLARTEXT, ALONE, "CHF R5", "number-malformed e3", "write CHF 5 for CHF R5"),
    (SINUMERIK, COMMAND, "TC", "code-unknown w2", "write CT, TCA or TCI"),
    (SINUMERIK, COMMAND, "DIAMONN", "code-unknown w2", "write DIAMON"),
    (SINUMERIK, COMMAND, "G310", "code-unknown w2", "G310 is no code of this control that contoursolve knows"),
    (ISG, ANY, MILL + "G1 X60\nG310 I5\nY40\nX20 #RND=3\nY9", "suspected w3", "G310 was probably meant to be G301"),
    (SINUMERIK, ALONE, "RND", "number-missing e3", "RND has no number"),
    (SINUMERIK, ALONE, "RND=", "number-missing e3", "RND has no number"),
    (SINUMERIK, ALONE, "ANG", "number-missing e3", "ANG has no number"),
    (ISG, ALONE, "#RND", "number-missing e3", "#RND has no number"),
    (KLARTEXT, ALONE, "RND Q5", "number-malformed e3", "RND Q5 is not a number that a control reads"),
    (KLARTEXT, ALONE, "FLX AN+30 LEN20", "heidenhain-no-word e3", "FLX is no function and no word with a number"),
    (SINUMERIK, BEFORE, "G1 RN=5", "word-mistyped e2", "write RND=5 or RNDM=5"),
    (SINUMERIK, BEFORE, "G1 Z-5 RN=5", "word-mistyped e2", "write RND=5 or RNDM=5"),
    (SINUMERIK, BEFORE, "G0 RDN=5", "word-mistyped e2", "write RND=5 or RNDM=5"),
    (KLARTEXT, BESIDE, "RND R5", "word-idle w2", "RND R5 means nothing in a line that ends at coordinates"),
    (KLARTEXT, BESIDE, "CHF 2", "word-idle w2", "CHF 2 means nothing in a line that ends at coordinates"),
    (KLARTEXT, BESIDE, "AN+30", "word-idle w2", "AN+30 means nothing in a line that ends at coordinates"),
    (KLARTEXT, BESIDE, "LEN20", "word-idle w2", "LEN20 means nothing in a line that ends at coordinates"),
    (YASNAC, ANY, "G0 X40. Z0.\nG111 A170. X100.mm K-5. Z-9.", "number-missing e2", "delete mm"),
    ("nct-99m", ALONE, ",R5mm", "number-missing e3", "delete mm"),
    ("nct-99m", ALONE, ",A30\N{DEGREE SIGN}", "stray-character e3", "delete \N{DEGREE SIGN}"),
    (ISG, ALONE, "#RND=5 mm", "code-unknown e3", "delete mm"),
    (KLARTEXT, ALONE, "FL AN+30\N{DEGREE SIGN} LEN20", "stray-character e3", "delete \N{DEGREE SIGN}"),
    (YASNAC, G111, "RN5.", "number-missing e2", "write P5. or Q5. for RN5."),
    (YASNAC, G111, "ANG170.", "number-missing e2", "write A170. or B170. for ANG170."),
    (YASNAC, G111, "CHF2.", "number-missing e2", "write C2. or D2. for CHF2."),
    ("fanuc-mill", BESIDE, ",A30.", "comma-word-unknown e2", ",A30.: this control has no ,A; it stops "),
    (ISG, ANY, MILL + "G1 X40\nG301 G302 I5\nY50", "isg-corner-both e2", "the block after it has G301 and G302"),
    (SINUMERIK, ANY, "G17 G0 X40 Y0\nR10=10\nG3 X50 Y10 R=R10\nG1 X80 RND=2\nY50", "word-mistyped e3", "write CR=10."),
    (KLARTEXT, POLAR, "LP PR+30 PA+90", "heidenhain-centre-missing e4", "it counts from CC, and no CC is in force"),
    (KLARTEXT, POLAR, "CTP PR+30 PA+90", "heidenhain-centre-missing e4", "it counts from CC, and no CC is in force"),
    (KLARTEXT, POLAR, "CP IPA+90 DR+", "heidenhain-centre-missing e4", "it counts from CC, and no CC is in force"),
    (SINUMERIK, BEFORE, "G1 X60\xa0F200", "stray-character e2", "the character here is U+00A0 (no-break space)"),
    (SINUMERIK, BEFORE, "G1 X\u221260", "stray-character e2", "the character here is U+2212 (minus sign)"),
    (SINUMERIK, BEFORE, "G1 X60\x00F200", "stray-character e2", "the character here is U+0000 (null)"),
    (SINUMERIK, BEFORE, "G1 X60\u2003F200", "stray-character e2", "the character here is U+2003 (em space)"),
]
"""A control and a program, what is typed in it, the code, severity and line of the first finding, and what it says."""


@pytest.mark.parametrize(("control", "frame", "typed", "code", "said"), TOLD)
def test_a_word_that_is_not_meant_is_told_with_what_it_was_meant_to_be(control, frame, typed, code, said):
    (finding, *_) = findings(control, frame[control].format(typed))
    assert f"{finding.code} {finding.severity.value[0]}{finding.span.line}" == code
    assert said in (finding.message[: len(said)], finding.help[: len(said)])


@pytest.mark.parametrize("words", ["A+5", "IC+30", "U+3 V+2", "A+3 C+9 M13", "TX+0.5 TY+0.1"])
def test_axes_that_turn_stand_beside_moves_that_a_corner_joins(words):
    text = f"1 L X+0 Y+0 R0 FMAX\n2 L X+60 {words} F200\n3 RND R5\n4 L Y+40 {words}"
    result = contoursolve.solve(text, control=KLARTEXT)
    assert (result.diagnostics, result.answers[0].contour.end) == ((), (60.0, 40.0))
    free = f"1 L X+0 Y+0 R0 FMAX\n2 FL X+60 AN+0 {words}"
    assert any(each.code == "heidenhain-word-unknown" for each in findings(KLARTEXT, free))


def test_a_machine_builder_s_words_are_a_setting():
    text = BESIDE[SINUMERIK].format("CLAMP=8").replace("X20", "X20 V9Q=4")
    assert {each.code for each in findings(SINUMERIK, text)} == {"word-unknown", "address-unknown"}
    assert not findings(SINUMERIK, text, settings={"siemens-840d.words": "clamp,V9Q"})
    with pytest.raises(contoursolve.SettingError, match="names with commas between them"):
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
    (row,) = (each for each in DIALECTS[SINUMERIK].modes.codes.values() if each.name == "WAITS")
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
