"""Programs and drawings in another control's own words: the same path, and nothing else changed."""

import re
from pathlib import Path
from random import Random

import pytest
from calling import run
from generate_nct import random_chain, random_cornered
from generate_typing import random_g111

import contoursolve

ROOT = Path(__file__).parents[2]
SHAFT = ROOT / "notebooks" / "programs" / "shaft.nc"
PLATE = ROOT / "docs" / "programs" / "plate.nc"


def words(text, to, **options):
    found = contoursolve.convert(text, to, comments=False, **options)
    assert found.text is not None, (found.summary, found.comparison)
    return found.text.split("\n")


@pytest.mark.parametrize(
    ("to", "codes"),
    [
        ("siemens-840d", ["G17 G90 G710 G94", "D1 G0 Z100 M3", "G41 X0 Y0 F300 ; START OF THE CONTOUR"]),
        ("isg", ["G17 G90 G71 G94", "D4 G00 Z100 M03", "G41 X0 Y0 F300 (START OF THE CONTOUR)"]),
        (
            "mitsubishi",
            ["G17 G90 G21 G94", "G43 H04 G00 Z100. M03", "G41 D04 X0. Y0. F300. (START OF THE CONTOUR)"],
        ),
    ],
)
def test_a_klartext_program_gets_the_targets_codes_of_units_and_offsets(to, codes):
    found = words((ROOT / "docs" / "programs" / "cam.h").read_text(), to)
    assert [each for each in found if each in codes] == codes


def test_what_the_target_has_no_words_for_is_written_out_and_named():
    text = "G00 X100. Z-50.\nG112 U0 I10. K-50. R30. C5. D5.\nG01 Z-120."
    found = contoursolve.convert(text, "fanuc-lathe")
    assert (found.summary.in_words, found.summary.written_out) == (0, [2])
    assert found.comparison.is_equal


def test_a_program_that_states_its_control_states_the_new_one():
    text = "(contoursolve control: fanuc-lathe)\nG21\nG00 X40. Z0.\nG01 Z-30. ,R5. F0.2\nX60.\nM30\n"
    found = contoursolve.convert(text, "siemens-840d").text
    assert contoursolve.solve(found).control == "siemens-840d"
    assert not contoursolve.solve(found).has_errors


_CALLS = (
    "O7\nG21 G17 G90 G94\n#1=20.\nG00 X0. Y0.\nM98 P8 L2\n"
    "G01 X[#1+40.] ,R2. F100.\nY#1\nM30\nO8\nG91 G01 X#{}\nG90\nM99"
)
_WRITTEN_OUT = "G0 X0 Y0|G91 G1 X{0}|G90|G91 G1 X{0}|G90|G1 X60 RND=2 F100|Y20|M30"


@pytest.mark.parametrize(
    ("text", "control", "to", "variables", "lines", "left"),
    [
        (_CALLS.format(1), "fanuc-mill", "mitsubishi", {}, _CALLS.format(1).replace("O7", "O0007"), []),
        (_CALLS.format(1), "fanuc-mill", "siemens-840d", {}, _WRITTEN_OUT.format(20), []),
        (_CALLS.format(5041), "fanuc-mill", "siemens-840d", {"#5041": 3}, _WRITTEN_OUT.format(3), []),
        (_CALLS.format(5041), "fanuc-mill", "siemens-840d", {}, "; NOT CONVERTED: G91 G01 X#5041", [10, 6, 7]),
        ("G00 X9. Z0.\n#1=3.\nG01 Z-5. ,A170. ,R#1\nX40.\nM30", "fanuc-lathe", "haas-lathe", {},
         "G01 Z-5. A170. ,R#1", []),
        ("M97 P9 L2\nG00 X5.\nM30\nN9 G91 G00 X1.\nG90\nM99", "haas-mill", "fanuc-mill", {},
         "G91 G00 X1.|G90|G91 G00 X1.|G90|G00 X5.", []),
        ("M98 P1\nM30\nO1\nG04 P500\nM99", "fanuc-mill", "haas-mill", {}, "O00002|M98 P1|M30|O1|G04 P500", []),
        ("G21 G99\nG00 X9. Z1.\nG01 Z-5. F20\nG04 X500\nG98\nX20. F100\nM30", "fanuc-lathe", "haas-lathe", {},
         "G01 Z-5. F0.2|G04 P500|G98|X20. F100.", []),
        ("G70\nG0 X0 Y0\nG1 X1 F254\nM30", "siemens-840d", "heidenhain", {},
         "1 L X+0 Y+0 R0 FMAX|2 L X+1 F100", []),
        ("G00 X0.\nN1 #1=#1+1.\nG00 X#1\nGOTO 1\nM30", "fanuc-mill", "isg", {},
         "(NOT CONVERTED: GOTO 1)|M30", [2, 3, 4]),
        ("R1=2 ; DEPTH\nG0 X=R1 F=R2\nM30", "siemens-840d", "isg", {}, "(NOT CONVERTED: F=R2)|G00 X2|M30", [2]),
    ],
)  # fmt: skip
def test_calls_and_variables_stay_or_are_written_out(text, control, to, variables, lines, left):
    found = contoursolve.convert(text, to, control=control, variables=variables)
    written = [line for line in found.text.split("\n") if line not in ("%", "")]
    wanted = lines.replace("\n", "|").split("|")
    assert "\n".join(wanted) in "\n".join(written), (written, found.not_converted)
    assert [each.line for each in found.not_converted] == left
    assert sum(each.times for each in found.not_converted) == found.text.count("NOT CONVERTED")


@pytest.mark.parametrize("number", range(24))
def test_a_converted_program_cuts_the_same_path(number, tmp_path):
    """`convert` proves it by what it writes; here both are expanded, and the plain programs compared."""
    rng = Random(number)
    if number % 3 == 0:
        text, control, to = random_g111(rng).text(), "yasnac-lx3", ("fanuc-lathe", "haas-lathe")[number % 2]
    else:
        drawn = random_chain(rng, 3, 17, 0.6) if number % 3 == 1 else random_cornered(rng, 17)
        text, control, to = drawn.text, "nct-99m", ("fanuc-mill", "haas-mill", "nct-99m")[number // 3 % 3]
    found = contoursolve.convert(text, to, control=control)
    if found.not_converted:
        assert contoursolve.solve(text, control=control).has_errors, (text, found.not_converted)
        return
    plain = []
    for name, program, reader in (("one.nc", text, control), ("other.nc", found.text, to)):
        plain += [tmp_path / name, *(() if plain else ("--control", reader))]
        (tmp_path / name).write_text(contoursolve.expand(program, control=reader, comments=False).text)
    status, output, _ = run("diff", *plain, "--new-control", to, "--tolerance", 0.004)
    assert status == 0, (text, output)


@pytest.mark.parametrize(
    ("arguments", "status", "said"),
    [
        (
            (SHAFT, "--to", "fanuc-mill"),
            2,
            "not from YASNAC LX3 lathe control (yasnac-lx3, a lathe) to Fanuc mills (fanuc-mill, a mill)",
        ),
        ((SHAFT,), 2, "say for which control: --to nct-99m|fanuc-lathe|fanuc-mill|haas-lathe|haas-mill"),
        ((PLATE, "--to", "nct-99m"), 2, "say which with --control nct-99m|fanuc-mill|haas-mill"),
        (("missing.nc", "--to", "fanuc-mill"), 2, "no such file"),
    ],
)
def test_nothing_is_written_where_it_could_be_wrong(arguments, status, said):
    found, output, told = run("convert", *arguments)
    assert (found, output) == (status, "")
    assert said in told


@pytest.mark.parametrize("name", ["plate.nc", "shaft_broken.nc"])
def test_what_is_not_converted_stands_as_a_comment_and_is_listed(name):
    to = {"plate.nc": "siemens-840d", "shaft_broken.nc": "fanuc-lathe"}[name]
    status, output, told = run("convert", SHAFT.with_name(name), "--to", to)
    comments = [line for line in output.splitlines() if "NOT CONVERTED" in line]
    assert status == 1
    assert comments
    assert told.count("is not converted: ") == len(comments)


_BEGINS = {
    "siemens-840d": "G17 G90 G710 G94\nG54",
    "fanuc-mill": "G21 G17 G90 G94\nG54",
    "haas-mill": "G21 G17 G90 G94\nG54",
    "isg": "%PART\nG17 G90 G71 G94\nG54",
    "heidenhain": "BEGIN PGM PART MM",
}
_FRAMES = (
    # What moves both axes by numbers, and its end.
    ("siemens-840d", "TRANS X50 Y10", "TRANS", True),
    ("siemens-840d", "TRANS X50\nATRANS Y10", "ROT", True),
    ("siemens-840d", "G58 X50\nG59 Y10", "TRANS", True),
    ("siemens-840d", "$P_PFRAME=CTRANS(X,50,Y,10)", "TRANS", True),
    ("fanuc-mill", "G52 X50. Y10.", "G52 X0 Y0", True),
    ("fanuc-mill", "G92 X-49. Y-8.", "G92 X70. Y30.", True),
    ("isg", "G92 X50\nG92 Y10", "G92 X0 Y0", True),
    ("heidenhain", "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+50\nCYCL DEF 7.2 IY+10",
     "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0", True),
    # What does otherwise.
    ("siemens-840d", "ROT RPL=30", "ROT", False),
    ("siemens-840d", "TRANS X5\nAROT RPL=30", "TRANS", False),
    ("siemens-840d", "SCALE X2 Y2", "SCALE", False),
    ("siemens-840d", "MIRROR X0", "MIRROR", False),
    ("siemens-840d", "TRANSMIT", "TRAFOOF", False),
    ("siemens-840d", "/TRANS X5", "TRANS", False),
    ("siemens-840d", "G58 X5\n$P_PFRAME=CROT(Z,30)", "TRANS", False),
    ("fanuc-mill", "G68 X0 Y0 R30.", "G69", False),
    ("fanuc-mill", "G51 X0 Y0 P2.", "G50", False),
    ("fanuc-mill", "G51.1 X0 Y0", "G50.1 X0\nG50.1 Y0", False),
    ("fanuc-mill", "G16", "G15", False),
    ("fanuc-mill", "G12.1", "G13.1", False),
    ("fanuc-mill", "G54.1 P2", "G54", False),
    ("haas-mill", "G101 X0", "G100 X0", False),
    ("haas-mill", "G154 P2", "G54", False),
    ("isg", "G21", "G20", False),
    ("isg", "G68 R30", "G69", False),
    ("isg", "#ROTATION ON [ANGLE 30]", "#ROTATION OFF", False),
    ("isg", "#CS ON [1,2,3,0,0,5]", "#CS OFF", False),
    ("heidenhain", "CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X", "CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1", False),
    ("heidenhain", "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+35", "CYCL DEF 10.1 ROT+0", False),
    ("heidenhain", "CYCL DEF 11.1 SCL 2", "CYCL DEF 11.1 SCL 1", False),
    ("heidenhain", "CYCL DEF 19.1 A+0 B+45 C+0", "CYCL DEF 19.1 A+0 B+0 C+0", False),
    ("heidenhain", "PLANE SPATIAL SPA+0 SPB+45 SPC+0 STAY", "PLANE RESET STAY", False),
    ("heidenhain", "TRANS DATUM AXIS X+3", "TRANS DATUM RESET", False),
)  # fmt: skip
_SHIFT = re.compile(r"(?P<all>TRANS\b)|G52|G92|CYCL DEF 7\.\d")
_AXIS = re.compile(r"(?<![A-Z])([XY])=?([+-]?[\d.]+)")


def places(text):
    """Where plain code leads, read without the package: with the shifts that it states."""
    at, shift = {"X": 0.0, "Y": 0.0}, {"X": 0.0, "Y": 0.0}
    for line in text.splitlines():
        bare, words = re.sub(r"\(.*|;.*", "", line), {}
        words = {axis: float(number) for axis, number in _AXIS.findall(bare)}
        stated = _SHIFT.search(bare)
        if stated is not None:
            shift = {**(dict.fromkeys("XY", 0.0) if stated["all"] else shift), **words}
        elif words:
            at |= {axis: number + shift[axis] for axis, number in words.items()}
            yield at["X"], at["Y"]


@pytest.mark.parametrize(("control", "begins", "ends", "is_shift"), _FRAMES)
def test_no_block_is_written_in_another_coordinate_system(control, begins, ends, is_shift):
    """Behind what moves the coordinate system, blocks lead to the same places, or are left until that ends."""
    moves = "{0}X{2} Y{3}{5}\n{1}X{4}{6}\n{1}Y{4}"
    is_klartext = control == "heidenhain"
    rapid, line = ("L ", "L ") if is_klartext else ("G00 ", "G01 ")
    numbers = ("+1", "+2", "+20") if is_klartext else ("1.", "2.", "20.")
    inside = moves.format(rapid, line, *numbers, " FMAX" if is_klartext else "", " F100")
    last = f"{rapid}X{numbers[0]} Y{numbers[0]}" + (" FMAX\nEND PGM PART MM" if is_klartext else "\nM30")
    text = "\n".join([_BEGINS[control], inside.split("\n")[0], begins, inside, ends, last])
    kin = {"haas-mill": "fanuc-mill"}.get(control, control)
    for to in {"fanuc-mill", "siemens-840d", "isg", "heidenhain"} - {kin}:
        found = contoursolve.convert(text, to, control=control)
        assert found.text is not None, (to, found.comparison)
        left = {each.line: each.reason for each in found.not_converted if "G54" not in each.text}
        first = len((_BEGINS[control] + "\n" + begins).split("\n")) + 2
        if is_shift:
            assert left == {}, found.text
            assert [*places(found.text)] == [(1, 2), (51, 12), (70, 12), (70, 30), (1, 1)], found.text
        else:
            assert {first, first + 1, first + 2} <= {*left}, (to, found.text)
            assert "not converted, and moves or turns it" in left[first]
            assert [*places(found.text)] == [(1, 2), (1, 1)], found.text


@pytest.mark.parametrize(
    ("control", "to", "program", "called", "file", "lines"),
    [
        ("fanuc-mill", "siemens-840d", "G21 G17 G90 G94\nG0 X0 Y0\nM98 P8 L2\nG1 X30. F100.\nM30",
         "O8\nG91 G1 X10. F50.\nG28 Z0.\nG90\nM99", "O0008.nc",
         "G91 G1 X10 F50|; NOT CONVERTED: G28 Z0.|G90"),
        ("siemens-840d", "heidenhain", "G17 G90 G710 G94\nG0 X0 Y0\nPOCKET\nG1 X30 F100\nM30",
         "G1 X=IC(10) F50\nY4 RND=1\nX2\nM17", "POCKET.SPF", "2 L IX+10 F50|3 L Y+4|4 RND R1|5 L X+2"),
        ("heidenhain", "isg", "BEGIN PGM A MM\nL X+0 Y+0 FMAX\nCALL PGM SUB.H\nL X+30 F100\nEND PGM A MM",
         "BEGIN PGM SUB MM\nL IX+10 F50\nEND PGM SUB MM", "SUB.H", "G01 X10 F50|X30 F100"),
        ("fanuc-mill", "haas-mill", "G21 G17 G90 G94\nG0 X0 Y0\nM98 P8 L2\nG1 X30. F100.\nM30",
         "O8\nG91 G1 X10. F50.\nG90\nM99", "O0008.nc", "M98 P8 L2"),
    ],
)  # fmt: skip
def test_a_subprogram_of_another_file_stands_where_it_is_called(control, to, program, called, file, lines, tmp_path):
    (tmp_path / "main.nc").write_text(program)
    (tmp_path / "subs").mkdir()
    (tmp_path / "subs" / file).write_text(called)
    command = ("convert", tmp_path / "main.nc", "--control", control, "--to", to)
    assert "name its folder with --path" in run(*command)[2] or to == "haas-mill"
    status, output, told = run(*command, "--path", tmp_path / "subs")
    assert "\n".join(lines.split("|")) in output
    assert (status, file in told) == (int("NOT CONVERTED" in output), True)
    assert "G28 Z0. in O0008.nc, line 3 is not converted (2 times)" in told or not status
    (tmp_path / "new.nc").write_text(output)
    compared = ("diff", tmp_path / "main.nc", tmp_path / "new.nc", "--control", control, "--new-control", to)
    assert run(*compared, "--path", tmp_path / "subs")[0] == 0 or status
