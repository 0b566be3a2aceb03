"""Conventions that a manual does not state: on the command line, in a project file, and in every result."""

import json
from pathlib import Path

import pytest
from click.testing import CliRunner

import contoursolve
from contoursolve.cli import main
from contoursolve.controls import DIALECTS
from contoursolve.diagnostics import Evidence
from contoursolve.output import to_json

CIRCLES = "G17 G90 G0 X90 Y0\nG42 G1 X50 D0\nG3 X-50 Y0 I-50 J0\nG3 X-40 Y60 I-40 J20 R40 Q-1\n"
LEFT, RIGHT = (-46.0220, -19.5441), (-11.9780, 48.5441)
OTHER = "nct-99m.circle-circle-q=right-is-negative"


def solved(folder: Path, *arguments: str) -> dict:
    program = folder / "circles.nc"
    program.write_text(CIRCLES)
    outcome = CliRunner().invoke(main, ["solve", str(program), "--format", "json", *arguments])
    assert outcome.exit_code == 0, outcome.output
    return json.loads(outcome.stdout)


def crossing(document: dict) -> tuple[float, ...]:
    return tuple(round(value, 4) for value in document["contours"][0]["points"]["P1"])


@pytest.mark.parametrize(
    ("arguments", "at", "value"), [((), LEFT, "left-is-negative"), (("--set", OTHER), RIGHT, "right-is-negative")]
)
def test_a_setting_changes_the_contour_and_the_result_names_it(tmp_path, arguments, at, value):
    document = solved(tmp_path, *arguments)
    assert crossing(document) == at
    (convention,) = document["contours"][0]["conventions"]
    told = convention["setting"], convention["value"], convention["evidence"]
    assert told == ("circle-circle-q", value, "assumed")
    assert document["settings"] == ({"nct-99m.circle-circle-q": value} if arguments else {})


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("contoursolve.toml", '[nct-99m]\ncircle-circle-q = "right-is-negative"\n'),
        ("pyproject.toml", '[tool.contoursolve.nct-99m]\ncircle-circle-q = "right-is-negative"\n'),
    ],
)
def test_a_project_file_above_the_program_holds_for_it(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    folder = tmp_path / "part" / "one"
    folder.mkdir(parents=True)
    assert crossing(solved(folder)) == RIGHT
    assert crossing(solved(folder, "--set", "nct-99m.circle-circle-q=left-is-negative")) == LEFT
    answer = contoursolve.solve_file(folder / "circles.nc").answers[0]
    assert tuple(round(value, 4) for value in answer.contour.points["P1"]) == RIGHT


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[nct-99m", "contoursolve.toml cannot be read"),
        ('[nct-99m]\nbevel = "axis-45"', "line 2: nct-99m has no setting 'bevel'; settings are: circle-circle-q"),
        ('[nct-99m]\ncircle-circle-q = "left"', "cannot be 'left'; values are: left-is-negative, right-is-negative"),
        ('circle-circle-q = "left-is-negative"', "'circle-circle-q' stands in no table"),
        ('[sinumerik]\na = "b"', "line 1: there is no table [sinumerik]; tables are: tools, yasnac-lx3"),
        ('contrl = "nct-99m"', "line 1: 'contrl' stands in no table; did you mean control?"),
        ('\ncontrol = "nct99m"', "line 2: there is no control 'nct99m'; did you mean nct-99m?"),
        (
            '[nct-99m]\n# C\n"radius_differnce" = 1',
            "line 3: nct-99m has no setting 'radius_differnce'; did you mean rad",
        ),
        (
            'nct-99m.circle-circle-q = "left-is-negativ"',
            "line 1: nct-99m.circle-circle-q cannot be 'left-is-negativ'; did",
        ),
        ('nct-99m = {suspicion = "off"}', "line 1: nct-99m has no setting 'suspicion'; did you mean suspicions?"),
        ("[tols]\nT1 = {radius = 0.8}", "line 1: there is no table [tols]; did you mean tools?"),
        ("[tools]\n\nT1 = {radus = 0.8}", "line 3: tools.T1: a tool has no 'radus'; did you mean radius?"),
    ],
)
def test_a_project_file_that_makes_no_sense_is_an_error_that_names_it(tmp_path, text, message):
    (tmp_path / "contoursolve.toml").write_text(text)
    (tmp_path / "circles.nc").write_text(CIRCLES)
    outcome = CliRunner().invoke(main, ["solve", str(tmp_path / "circles.nc"), "--tool", "program"])
    assert outcome.exit_code == 2
    assert "contoursolve.toml" in outcome.output
    assert message in outcome.output


def test_a_broken_file_of_another_tool_is_not_ours_but_one_with_our_table_is(tmp_path):
    (tmp_path / "pyproject.toml").write_text("[project\n")
    assert crossing(solved(tmp_path)) == LEFT
    (tmp_path / "pyproject.toml").write_text("[tool.contoursolve.nct-99m]\n[broken\n")
    assert CliRunner().invoke(main, ["solve", str(tmp_path / "circles.nc")]).exit_code == 2


@pytest.mark.parametrize("text", ["nct-99m.circle-circle-q", "circle-circle-q=left", "nct-99m.q=1", "=", "nct-99m.=x"])
def test_a_setting_that_there_is_not_is_refused(text):
    outcome = CliRunner().invoke(main, ["solve", "--set", text, "--block", "G1 X1"])
    assert outcome.exit_code == 2
    assert "Traceback" not in outcome.output


@pytest.mark.parametrize(
    ("block", "names"),
    [
        ("G111 X100. A180. K-30. B120. C5. D5.", []),
        ("G111 X100. A180. K-30. B120. P5.", ["no-corner-word"]),
        ("G111 X100. A180. K-30. B120. Q5.", ["no-corner-word"]),
        ("G111 X100. A180. K-30. Z-47. P5.", []),
        ("G111 X100. A180. B120. Z-47.", ["no-corner-word"]),
        ("G111 X100. A180. K-30. B120. P0 Q5.", ["corner-of-zero"]),
        ("G111 X100. A180. K-30. B120. C5. D5. F.2", ["feed-in-block"]),
        ("G111 X100. A180. K-30. B120. F0.2", ["no-corner-word", "feed-in-block"]),
        ("G112 U0 I10. K-50. R30. P5. Q5. F.2", ["feed-in-block"]),
        ("G112 U0 I10. K-50. R30. P0", ["no-corner-word", "corner-of-zero"]),
        ("G11 Z-20. I8. F30.", []),
        pytest.param("G111 X100. A180. K-30. B135. C5. D5.", ["bevel-at-its-limit"], marks=pytest.mark.boundary),
        pytest.param("G111 X100. A180. K-30. B134.9 C5. D5.", [], marks=pytest.mark.boundary),
        ("G111 X100. A180. K-30. B135. P5. Q5.", []),
    ],
)
def test_a_result_names_what_the_control_is_taken_to_accept(block, names):
    (contour,) = json.loads(to_json(contoursolve.solve(block, start="X40. Z0.")))["contours"]
    assert [each["name"] for each in contour["assumptions"]] == names
    assert {each["source"]["evidence"] for each in contour["assumptions"]} <= {"assumed"}


def test_the_catalogue_lists_every_assumption_and_every_setting_with_its_values():
    printed = CliRunner().invoke(main, ["rules"]).output
    for dialect in DIALECTS.values():
        for each in dialect.assumptions:
            assert f"assumption {dialect.name}.{each.name}: {each.meaning} ({each.source})" in printed
            assert each.source.evidence is Evidence.ASSUMED
        for setting in dialect.settings:
            assert setting.default in setting.values
            assert all(f"--set {dialect.name}.{setting.name}={value}" in printed for value in setting.values)


ZX, XY = "G18 G90 G00 X0 Z0\n", "G17 G90 G00 X0 Y0\n"


@pytest.mark.parametrize(
    ("control", "program", "settings", "named"),
    [
        ("mitsubishi", ZX + "G01 X40. ,A30.", {}, {"diameter=off"}),
        ("mitsubishi", ZX + "G01 X40. ,A30.", {"diameter": "on"}, {"diameter=on"}),
        ("mitsubishi", XY + "G01 X40. ,A30.", {}, set()),
        ("mitsubishi", XY + "G01 X40. A30.", {}, {"angle-word=A"}),
        ("mitsubishi", XY + "G01 X40 ,A30.", {"number": "increment"}, {"number=increment"}),
        ("mitsubishi", XY + "G03 I30. J0\nG01 X20. Y-60. ,A-90.", {},
         {"first-centre=start", "arc-without-end=contact"}),
        ("mitsubishi", XY + "G01 X40. ,C6.\nG02 X60. Y20. I20. J0", {}, {"corner=II", "chamfer-on-arc=chord"}),
        ("fanuc-lathe", "G00 X20. Z0.\nG01 Z-20. ,R5.\nX40.", {}, set()),
        ("fanuc-lathe", "G00 X20. Z0.\nG01 Z-20000 ,R5.\nX40.", {}, {"number=increment"}),
        ("fanuc-lathe", "G00 X20. Z0.\nG01 X60. ,A120.", {}, {"angle=normal"}),
        ("fanuc-lathe", "G00 X20. Z0.\nG01 X60. Z-11.547 ,A120. ,R1.\nZ-30.", {},
         {"angle=normal", "redundant-angle=check"}),
        ("fanuc-lathe", "G00 X20. Z0.\nG01 Z-20. I5.\nX40.", {}, {"corner-words=comma"}),
        ("fanuc-mill", XY + "G01 X30. J5.\nY40.", {}, {"corner-words=comma"}),
        ("fanuc-mill", XY + "G01 X40. ,C6.\nG02 X60. Y20. I20. J0", {}, {"chamfer-on-arc=chord"}),
        ("haas-mill", XY + "G01 X30. ,C10000\nX40. Y40.", {}, {"number=increment"}),
        ("haas-mill", XY + "G01 X40. ,C6.\nG02 X60. Y20. I20. J0", {"arcs": "on"}, {"arcs=on"}),
        ("siemens-840d", ZX + "G1 X40 ANG=30", {}, {"diam=plane"}),
        ("siemens-840d", XY + "G1 X40 ANG=30", {"diam": "DIAMON"}, {"diam=DIAMON"}),
        ("siemens-840d", XY + "G1 X40 CHR=6\nG2 X60 Y20 I20 J0", {}, {"chamfer-on-arc=chord"}),
        ("isg", XY + "G1 X40 #ANG=30", {"machine": "lathe"}, {"machine=lathe"}),
    ],
)  # fmt: skip
def test_an_answer_names_the_settings_on_which_it_rests(control, program, settings, named):
    result = contoursolve.solve(
        program, control=control, settings={f"{control}.{name}": value for name, value in settings.items()}
    )
    (answer,) = result.answers
    assert {f"{each.setting.name}={each.value}" for each in answer.claim.conventions} == named
    shown = str(result)
    assert all(f"(--set {control}.{each})" in shown for each in named)
