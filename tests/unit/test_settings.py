"""Conventions that a manual does not state: on the command line, in a project file, and in every result."""

import pytest
from click.testing import CliRunner

import contoursolve
from contoursolve.cli import main
from contoursolve.controls import CONTROLS
from contoursolve.diagnostics import Evidence

CIRCLES = "G17 G90 G0 X90 Y0\nG42 G1 X50 D0\nG3 X-50 Y0 I-50 J0\nG3 X-40 Y60 I-40 J20 R40 Q-1\n"


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


@pytest.mark.parametrize("text", ["nct-99m.circle-circle-q", "circle-circle-q=left", "nct-99m.q=1", "=", "nct-99m.=x"])
def test_a_setting_that_there_is_not_is_refused(text):
    outcome = CliRunner().invoke(main, ["solve", "--setting", text, "--block", "G1 X1"])
    assert outcome.exit_code == 2
    assert "Traceback" not in outcome.output


def test_the_catalogue_lists_every_assumption_and_every_setting_with_its_values():
    printed = CliRunner().invoke(main, ["rules"]).output
    for control in CONTROLS.values():
        for each in control.assumptions:
            assert f"assumption {control.name}.{each.name}: {each.meaning} ({each.source})" in printed
            assert each.source.evidence is Evidence.ASSUMED
        for setting in control.settings:
            assert setting.default in setting.values
            assert all(f"--setting {control.name}.{setting.name}={value}" in printed for value in setting.values)


@pytest.mark.parametrize("control", ["nct-99m", "mitsubishi"])
@pytest.mark.parametrize("block", ["G3 X40 Y0 I20", "G3 X40 Y0 I20 J0", "G3 X40 Y0 R20", "G1 X40 Y10"])
def test_an_assumption_is_named_where_a_block_needs_it_and_nowhere_else(control, block):
    (answer,) = contoursolve.solve(f"G17 G0 X0 Y0\n{block} ,R1\nG1 X60 Y30", control=control).answers
    assert [each.name for each in answer.assumptions] == ["one-of-center"] * block.endswith("I20")
