"""Words that change the radius of a tool, or compensation: they are followed, or the path is refused."""

from pathlib import Path

import pytest
from calling import call as invoke

MILL = """\
G21 G17 G90
G00 X-40. Y-20.
{0}
G41 D1 G01 X-30. Y-20. F500
{1}
Y30.
X30.
Y-30.
X-40.
G40 Y-50.
{2}
M30
"""
LATHE = "G21\n{0}\nG00 X20. Z2.\nG42 G01 Z0. F0.1\nX30. Z-10.\n{1}\nZ-30.\nG40 G00 X60. Z50.\n{2}\nM30\n"
SIEMENS = MILL.replace("G00", "G0").replace(".", "")
KLARTEXT = """\
0 BEGIN PGM A MM
1 TOOL DEF 2 L+0 R+9
2 TOOL CALL 1 Z S3000
3 {0}
4 L X-40 Y-20 R0 FMAX
5 L X-30 Y-20 RL F500
6 L Y30
7 L X30 {1}
8 L Y-30
9 L X-40
10 L Y-50 R0 FMAX
11 {2}
12 END PGM A MM
"""
PROGRAMS = {"fanuc-mill": MILL, "haas-mill": MILL, "mitsubishi": MILL, "nct-99m": MILL, "siemens-840d": SIEMENS,
            "fanuc-lathe": LATHE, "haas-lathe": LATHE, "yasnac-lx3": LATHE, "heidenhain": KLARTEXT}  # fmt: skip
R5, NOSE = ("--tool", "R5"), ("--tool", "R0.8", "--tip", "3")


def call(command, text, control, *words):
    return invoke(command, "--control", control, *(words or _tool(control)), "-", stdin=text)


def _tool(control):
    return NOSE if control.endswith(("lathe", "lx3")) else R5


def program(control: str, *lines: str) -> str:
    text = PROGRAMS[control].format(*lines, *[""] * (3 - len(lines)))
    return "".join(f"{line}\n" for line in text.splitlines() if line.strip(" 0123456789"))


def wall(text: str, control: str) -> float:
    """The largest X of the path that is written for the tool."""
    done = call("expand", text, control, *R5, "--inline")
    assert done.exit_code == 0, done.stderr
    moves = [line for line in done.stdout.splitlines() if not line.lstrip().startswith(("(", ";"))]
    return max(float(word[1:]) for line in moves for word in line.split() if word[0] == "X")


@pytest.mark.parametrize(
    ("control", "lines", "radius"),
    [
        ("heidenhain", ("TOOL CALL 1 Z S3000 DR+0.5",), 5.5),
        ("heidenhain", ("TOOL CALL 1 Z DL+1 DR-0.25 DR2:+1",), 4.75),
        ("heidenhain", ("TOOL CALL 1 Z DR+0.5\n5 TOOL CALL DR+0.2",), 5.2),
        ("siemens-840d", ("OFFN=0.5",), 5.5),
        ("siemens-840d", ("T1 D1 OFFN=-.5 TOFFR=0",), 4.5),
        ("siemens-840d", ("OFFN=0.5\nOFFN=0",), 5.0),
    ],
)
def test_what_adds_to_the_radius_is_followed(control: str, lines: tuple[str, ...], radius: float):
    text = program(control, *lines)
    assert wall(text, control) == pytest.approx(30 + radius)
    found = invoke("find", "--word", "tool", "--control", control, "-", stdin=text)
    assert ("adds to the radius, so that no radius is that of the tool alone" in found.stderr) == (radius != 5.0)
    assert ("tool-radius-added" in call("check", text, control).stdout) == (radius != 5.0)


def test_a_radius_in_the_program_against_the_one_that_is_asked_for():
    text = program("heidenhain", "TOOL DEF 1 L+0 R+{}")
    told = "TOOL DEF 1 L+0 R+4 in program line 4 states a radius (assumed): here it is the cutter R5"
    assert told in call("check", text.replace("{}", "4"), "heidenhain").stdout
    assert "tool-radius-stated" not in call("check", text.replace("{}", "5"), "heidenhain").stdout
    assert (
        "G10 L12 P1 R4. in program line 3"
        in call("check", program("fanuc-mill", "G10 L12 P1 R4."), "fanuc-mill").stdout
    )
    assert "$TC_DP6[1,1]=4" in call("check", program("siemens-840d", "$TC_DP6[1,1]=4"), "siemens-840d").stdout.upper()


def test_scaling_is_refused_when_paths_are_compared(tmp_path: Path):
    (tmp_path / "a.nc").write_text(program("fanuc-mill", "G51 X0. Y0. P2000"))
    name = str(tmp_path / "a.nc")
    done = invoke("diff", "--control", "fanuc-mill", "--tool", "R5", name, name)
    assert done.exit_code == 2
    assert "G51 in program line 3 scales the contour" in done.stderr


@pytest.mark.parametrize("control", ["fanuc-lathe", "haas-lathe", "yasnac-lx3"])
@pytest.mark.parametrize(
    ("word", "told"), [("T0100", "write T0101 for T0100"), ("T1200", "write T1212"), ("T0101", "")]
)
def test_a_lathe_without_an_offset(control: str, word: str, told: str):
    done = call("check", program(control, word), control)
    assert ("error[tool-no-offset]" in done.stdout, told in done.stdout) == (bool(told), True)


ARC = "G17 G90 G71\nG0 X5 Y0\nG41 D1 G1 X20 Y0 F500\nG3 X-20 Y0 {}\nG3 X20 Y0 I=AC(0)\nG40 G1 X5 Y0\nM30\n"


@pytest.mark.parametrize("center", ["I-20 J0", "I=AC(0) J=AC(0)", "I=AC(0)", "J=AC(0) I-20", "I=AC( 0.0 ) J0", "CR=20"])
def test_a_centre_may_be_absolute(center: str, tmp_path: Path):
    text = ARC.format(center)
    assert "contour solved, no problems" in call("check", text, "siemens-840d", "--tool", "R5").stdout.replace(
        "1 info", "no problems"
    )
    assert "X-15 Y0 I-15 J0" in call("expand", text, "siemens-840d").stdout
    one, other = tmp_path / "one.mpf", tmp_path / "other.mpf"
    one.write_text(text)
    other.write_text(ARC.format("CR=20"))
    done = invoke("diff", "--control", "siemens-840d", str(one), str(other))
    assert done.exit_code == 0, done.output
    wrong = ARC.format("I=AC(1)")
    assert (
        "the radius of the arc is"
        in invoke("check", "--control", "siemens-840d", "--tool", "R5", "-", stdin=wrong).output
    )
