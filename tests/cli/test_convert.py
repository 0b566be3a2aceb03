"""Programs and drawings in another control's own words: the same path, and nothing else changed."""

from pathlib import Path
from random import Random

import pytest
from calling import run
from generate_nct import random_chain, random_cornered
from generate_typing import random_g111

import contoursolve

ROOT = Path(__file__).parents[2]
SHAFT = ROOT / "notebooks" / "programs" / "shaft.nc"
STUD, PLATE = (ROOT / "docs" / "programs" / name for name in ("stud.nc", "plate.nc"))


def words(text, to, **options):
    found = contoursolve.convert(text, to, comments=False, **options)
    assert found.text is not None, (found.summary, found.comparison)
    return found.text.split("\n")


@pytest.mark.parametrize(
    ("to", "codes"),
    [
        ("siemens-840d", ["G17 G71 G90 G94", "N4 D1 G00 Z100 M3", "N7 G41 D1 G01 X0 Y0 F300 ;START OF THE CONTOUR"]),
        ("isg", ["G17 G71 G90 G94", "N4 D4 G00 Z100 M3", "N7 G41 D4 G01 X0 Y0 F300 (START OF THE CONTOUR)"]),
        ("mitsubishi", ["G17 G21 G90 G94", "N4 G43 H4 G00 Z100 M3", "N7 G41 D4 G01 X0 Y0 F300 (START OF THE CONTOUR)"]),
    ],
)
def test_a_klartext_program_gets_the_targets_codes_of_units_and_offsets(to, codes):
    found = words((ROOT / "docs" / "programs" / "cam.h").read_text(), to)
    assert [each for each in found if each in codes] == codes


TAPER = "G00 X40. Z0.\nG111 X100. A180. K-30. B120. {}F0.2\nG01 Z-60."


@pytest.mark.parametrize(
    ("text", "to", "lines"),
    [
        (TAPER.format("P5. "), "fanuc-lathe", ["G01 X40. Z-30. ,R5. F0.2", "G01 X100. ,A120."]),
        (TAPER.format("P5. "), "haas-lathe", ["G01 X40. Z-30. ,R5. F0.2", "G01 X100. A120."]),
        # The last corner meets a line of another block: it is written out, the rest is not.
        (
            TAPER.format("P5. Q5. "),
            "fanuc-lathe",
            ["G01 X40. Z-30. ,R5. F0.2", "G01 X95. ,A120.", "G03 X100. Z-50.207 I-2.5 K-4.33"],
        ),
        # A bevel along the axes is ,C between lines along the axes alone.
        (
            "G00 X60. Z0.\nG111 A180. K-20. C2. B90. X90.\nG01 Z-60.",
            "fanuc-lathe",
            ["G01 X60. Z-20. ,C2.", "G01 X90. Z-20."],
        ),
        # A vertex that no number states stays one: the angle stands, not a rounded point.
        (
            "G00 X20. Z0.\nG01 ,A150. ,R3.\nX90. Z-40. ,A100.\nG01 Z-60.",
            "fanuc-lathe",
            ["G01 ,A150. ,R3.", "G01 X90. Z-40. ,A100."],
        ),
    ],
)
def test_a_contour_is_written_in_the_words_of_the_target(text, to, lines):
    start, *converted, last = words(text, to)
    assert (start, converted, last) == (text.split("\n")[0], lines, text.split("\n")[-1])


NCT = "G17 G90 G42 G0 X100 Y20\n"


@pytest.mark.parametrize(
    "chain",
    [
        "G03 I-50 J0\nG01 X-50 Y42.857 ,A171.87 Q-1",
        "G03 I-50 J0\nG01 X-50 Y42.857 ,A171.87 Q1",
        "G03 I-50 J0\nG03 X-40 Y60 I-40 J20 R40 Q-1",
        NCT + "G01 X-30 Y-20 ,C2\nG03 X20 Y40 I20 J-10 R50 Q-1",
        NCT + "G01 ,A150\nG01 X10 Y20 ,A225",
        NCT + "G01 ,A150 ,R2\nG01 X10 Y20 ,A225 ,C2\nG03 X-40 Y-20 I-20 J-20 R20 Q1",
    ],
)
def test_a_chain_comes_back_in_the_words_that_it_had(chain):
    text = chain if chain.startswith("G17") else f"G17 G90 G0 X50 Y0\nG42\n{chain}"
    found = contoursolve.convert(text, "nct-99m", control="nct-99m", comments=False)
    assert (found.text, found.summary.in_words, found.summary.written_out) == (text, 1, [])


def test_each_corner_of_a_drawing_is_a_word_beside_the_element_before_it():
    """DIN PLUS has one word for both: a chamfer is below 0. The last element has no corner."""
    drawing = (ROOT / "tests" / "sketches" / "turned_shaft.toml").read_text(encoding="utf-8")
    drawing = drawing.replace("Z = -30\n", "Z = -30\ncorner = {rounding = 3}\n")
    status, written, told = run("write", "-", "--to", "cnc-pilot", stdin=drawing)
    blocks = ["G00 X0 Z0", "G01 X40 B-1.5", "G01 Z-30 B3", "G01 X80 Z-50 B2", "G01 Z-60", "ENDE"]
    assert (status, written.splitlines()[4:]) == (0, blocks)
    assert told.startswith("12 words in 4 blocks, with round numbers\n")


def test_what_the_target_has_no_words_for_is_written_out_and_named():
    text = "G00 X100. Z-50.\nG112 U0 I10. K-50. R30. C5. D5.\nG01 Z-120."
    found = contoursolve.convert(text, "fanuc-lathe")
    assert (found.summary.in_words, found.summary.written_out) == (0, [2])
    assert found.comparison.is_equal


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
    if found.text is None:
        # What is no contour, such as a number without a point, may be read otherwise.
        is_refused = contoursolve.solve(text, control=control).has_errors
        assert is_refused or found.summary.misread or found.comparison.difference is not None, text
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
        ((SHAFT.with_name("plate.nc"), "--to", "fanuc-mill"), 1, "has no point and is"),
        ((SHAFT.with_name("shaft_broken.nc"), "--to", "fanuc-lathe"), 1, "nothing was written"),
        (("missing.nc", "--to", "fanuc-mill"), 2, "no such file"),
    ],
)
def test_nothing_is_written_where_it_could_be_wrong(arguments, status, said):
    found, output, told = run("convert", *arguments)
    assert (found, output) == (status, "")
    assert said in told


def test_what_sinumerik_does_not_know_or_reads_by_a_setting_is_named(tmp_path):
    lathe, mill = tmp_path / "lathe.nc", tmp_path / "mill.nc"
    lathe.write_text("O300\nG18 G21\nG0 X20. Z2.\nG1 Z-20. ,R3. F0.2\nX40.\nM30\n")
    mill.write_text("O1\nG17 G90 G0 X0 Y0\nG1 X30. ,C3. F100.\nY20.\nM30\n")
    status, _, told = run("convert", "--control", "haas-lathe", "--to", "siemens-840d", lathe)
    assert status == 0
    assert "program line 1: on SINUMERIK 840D sl, 828D and ONE, O300 is no program number" in told
    assert "X is a diameter by the machine's setting alone; write DIAMON before the first block" in told
    status, _, told = run("convert", "--control", "haas-mill", "--to", "siemens-840d", mill)
    assert (status, "O1 is no program number" in told, "DIAMON" in told) == (0, True, False)
