"""For which control a program is where several read its words: alike, or differently."""

import pytest

from contoursolve import OpenProgram, check, expand, solve
from contoursolve.errors import UnknownControlError

TURNED_PLAIN = "G0 X20. Z-1.\nG1 X9. F0.2\nG1 Z9. F0.03\nG1 X14. K0.3\nG1 Z16. R0.4\nG1 X20.\nG0 X30.\nM30"
FIRST = "O0101\nG99 G21\nT0101\nG96 S180 M03\nG00 X32. Z2.\nG01 Z0. F0.2\nX20. ,C1.\nZ-20. ,R2.\nX30.\nM30"
MILLED = "G17 G90\nG00 X0 Y0\nG91 G01 X80. ,C8. F200\nX60. Y60.\nG90 G00 Z50.\nM30"
PROFILE = (
    "G00 X34. Z2.\nG71 U2. R1.\nG71 P10 Q50 U0.4 W0.1 F0.2\nN10 G00 X22. Z2.\nG01 Z0.\nZ-15. ,R0.8\nX8. ,R0.5\n"
    "N50 X16. Z-24.\nG70 P10 Q50\nM30"
)
LATHES, MILLS = "fanuc-lathe and haas-lathe", "nct-99m, fanuc-mill, haas-mill and mitsubishi"


def findings_of(opened):
    opened.check()
    return opened.diagnostics


@pytest.mark.parametrize(
    ("program", "readers", "end"),
    [
        (TURNED_PLAIN, LATHES, (16.0, 10.0)),
        (FIRST, LATHES, (-20.0, 15.0)),
        (MILLED, MILLS, (140.0, 60.0)),
        (PROFILE, LATHES, (-24.0, 8.0)),
    ],
)
def test_a_program_that_all_its_controls_read_alike_is_solved_and_the_first_is_named(program, readers, end):
    found = solve(program)
    (told,) = found.diagnostics
    first = readers.split(",")[0].split(" ")[0]
    assert (told.code, told.severity.value, found.control) == ("control-alike", "info", first)
    assert (
        told.message == f"{readers} read this program alike: its findings are those of {first}; "
        "name yours by --control, or in the workbench's list"
    )
    assert [answer.contour.end for answer in found.answers] == [pytest.approx(end)]
    assert solve(program, control=first).answers == found.answers
    assert expand(program).text == expand(program, control=first).text
    assert findings_of(OpenProgram(program)) == found.diagnostics


SAFE = "G00 G18 G20 G40 G80 G99"
TURNED = "G00 X2. Z0.1\nG01 Z-1. F0.01 ,R0.1\nX3.\nM30"
PECKED = "G43 H1 Z5.\nG83 X10. Z-20. R2. Q5. F90\nG80"


@pytest.mark.parametrize(
    ("text", "first"),
    [
        (f"{SAFE}\nT0101\n{TURNED}", "fanuc-lathe"),
        (f"G54 G18\nG50 S2000\n{TURNED}", "fanuc-lathe"),
        (f"G18 G21\nG96 S180 M03\n{TURNED}", "fanuc-lathe"),
        (f"G18\nG28 U0 W0\n{TURNED}", "fanuc-lathe"),
        (f"G18\nG76 P010060 Q100 R0.02\n{TURNED}", "fanuc-lathe"),
        (f"G18\n{TURNED.replace('M30', 'W-2.')}", "fanuc-lathe"),
        # A lathe may have Y, and it drills.
        (f"G18 G20 G99\nT0101\nG50 S2000\nG96 S200 M3\n{TURNED.replace('M30', 'G28 U0. Y0.')}", "fanuc-lathe"),
        (f"G18 G20 G40 G80 G90 G99\nT0101\nG96 S1050 M3\nG0 X0 Z.1\nG83 Z-1.05 F.01\n{TURNED}", "fanuc-lathe"),
        ("G17\nG43 H1 Z5.\nT0101\nG00 X0 Y0\nG01 X30. F100 ,R2.\nY20.", "nct-99m"),
        # Both are spoken for: what a plane says counts.
        (f"G18\nT0101 M06\n{TURNED}", None),
        (f"G18\n{TURNED}", None),
        (f"G18\n{PECKED}\n{TURNED}", "nct-99m"),
        # A pole of SINUMERIK; its file alone says that, too.
        ("N30 G111 X30 Y20\nN40 G0 AP=0 RP=25\nN50 G1 AP=60 RP=25", None),
        ("N30 G111 X30 Z20\nN40 G0 AP=0 RP=25\nN50 G1 AP=60 RP=25", None),
        ("G111 A180. K-30. B120. X80.", "yasnac-lx3"),
        # What only one control has decides; an arc with R and its centre is one of NCT where nothing else is shown.
        ("N10 G00 X0 Y0\nN20 G01 X10 F1000\nN30 G02 X30 Y0 R10 I10 J0\nN40 G01 X50 #RND=2\nN50 Y20", "isg"),
        ("G17 G00 X0 Y0\nG01 X10. F100\nG02 X30. Y0 R10. I10. J0\nG01 X50. Y20.", "nct-99m"),
        # Beside both ends, A is an axis.
        ("G90 G17\nG0 X0 Y0\nG1 X30. Y5. A5. F100\nX40. Y5. A10.", None),
    ],
)
def test_words_that_speak_for_a_kind_of_machine_tell_the_control(text, first):
    try:
        found = check(text)
    except UnknownControlError:
        assert first is None
        return
    told = {each.code for each in found}
    assert "control-unknown" not in told
    assert solve(text).control == first
    mine = OpenProgram(text)
    assert (mine.control.name if mine.control else None) == first


def test_a_program_for_sinumerik_by_its_name_has_no_contour_of_a_lathe():
    assert solve("N10 G111 X30 Z20", name="pole.mpf").control is None
    assert solve("N10 G111 X30 Z20", name="pole.nc").control == "yasnac-lx3"


def test_where_readers_cut_alike_and_tell_other_findings_that_is_said_and_the_findings_are_those_of_the_first():
    text = "G17 G90 G00 X0 Y0\nG01 X30. ,C31.\nX40. Y40."
    *found, told = check(text)
    assert told.message.startswith(f"{MILLS} cut the same path, but tell other findings: its findings are those of nct")
    assert found == [*check(text, control="nct-99m")]
    assert [each.is_error for each in found] == [True]


def test_an_edit_may_make_controls_read_differently():
    opened = OpenProgram(MILLED)
    assert opened.control.name == "nct-99m"
    opened.replace(MILLED.replace("G01 X80. ,C8. F200\n", "G02 X80. Y9. R60. ,R3.\nG01 "))
    assert opened.control is None
    assert "differently" in opened.trouble
    opened.replace(MILLED)
    assert [each.code for each in findings_of(opened)] == ["control-alike"]
