"""The command line: exit status, JSON, processes, and an answer to every bad input."""

import json
import os
import re
import subprocess
import sys
from decimal import Decimal
from importlib import import_module
from pathlib import Path

import pytest
from calling import blocks, data, run
from click.testing import CliRunner
from jsonschema import Draft202012Validator

from contoursolve import solve
from contoursolve.__main__ import commands
from contoursolve.cli import main
from contoursolve.controls import CONTROLS
from contoursolve.solving import certify

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
SHAFT, BROKEN, PLATE = (str(PROGRAMS / name) for name in ("shaft.nc", "shaft_broken.nc", "plate.nc"))
ONE = tuple(blocks("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0."))

START = "G00 X40. Z0.\n"
GOOD = START + "G111 X100. A180. K-30. B120. P5. Q5."


def run_process(*arguments, stdin=b"", **environment):
    command = [sys.executable, "-m", "contoursolve", *map(str, arguments)]
    done = subprocess.run(command, input=stdin, capture_output=True, check=False, env={**os.environ, **environment})
    assert b"Traceback" not in done.stdout + done.stderr
    return done.returncode, done.stdout, done.stderr


def solve_json(*arguments, **options):
    """The document, whose exit status is that of its findings."""
    status, output, errors = run("solve", *arguments, "--format", "json", **options)
    document = json.loads(output)
    assert (status, errors) == (any(each["severity"] == "error" for each in document["diagnostics"]), "")
    return document


@pytest.fixture
def save(tmp_path):
    def write(content: str | bytes) -> Path:
        path = tmp_path / "program.nc"
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    return write


# --- Exit status -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("status", "arguments"),
    [
        (0, ("check", SHAFT, PLATE)),
        (0, ("check", *ONE)),
        (0, ("solve", SHAFT, "--start", "X40. Z0.")),
        (0, ("rules", "--control", "nct-99m")),
        (0, ("--version",)),
        (1, ("solve", "--block", "G111 A180. B120.", "--start", "X40. Z0.")),
    ],
)
def test_exit_status_is_0_without_errors_and_1_with_errors(status, arguments):
    found, output, errors = run(*arguments)
    assert (found, errors) == (status, "")
    assert output


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ((), "Commands:"),
        (("solve",), "missing PROGRAM"),
        (("check",), "missing PROGRAM"),
        (("solve", SHAFT, *ONE), "give either a PROGRAM or --block, not both\n"),
        (("solve", SHAFT, "--control", "fanuc"), "is not one of " + ", ".join(f"'{name}'" for name in CONTROLS)),
        (("solve", SHAFT, "--units", "cubit"), "'cubit' is not one of 'mm', 'inch'"),
        (("solve", SHAFT, "--rules", "perhaps"), "'perhaps' is not one of"),
        (("solve", SHAFT, "--format", "xml"), "'xml' is not one of"),
        (("solve", "no such file.nc"), "no such file.nc: no such file; this folder has no file that ends in .nc\n"),
        (("solve", "G111 A180. K-30."), 'no such file; a block is given by --block "G111 A180. K-30."\n'),
        (("explain", "no-such-rule"), "no rule has the code or the alarm 'no-such-rule'; 'contoursolve rules' lists"),
        (("explain", "g111-line1"), "; did you mean g111-line-1 or g111-line-2 or "),
        (("explain", "999"), "no rule has the code or the alarm '999'; 'contoursolve rules' lists them\n"),
        (("rules", "--table", "--format", "json"), "leave out --table or --format json\n"),
        (("solv", SHAFT), "No such command 'solv'. Did you mean 'solve'?\n"),
        (("help", "chek"), "No such command 'chek'. Did you mean 'check'?\n"),
        (("weld", SHAFT), "No such command 'weld'.\n"),
        (("check", *ONE[2:], "--start", "X40. Z"), '--start "X40. Z": Z has no number'),
    ],
)
def test_what_cannot_run_ends_with_2_and_says_what_to_write(arguments, told):
    status, output, errors = run(*arguments)
    assert (status, output) == (2, "")
    assert told in errors


def test_of_several_programs_those_that_could_be_read_are_reported_all_the_same():
    status, output, errors = run("check", SHAFT, "no such file.nc")
    assert (status, errors) == (2, "Error: no such file.nc: no such file; this folder has no file that ends in .nc\n")
    told = "7 contours solved, no problems; 1 program not examined: its error says what to do"
    assert output.splitlines()[-1] == told
    with pytest.raises(ValueError, match=r"say Path\('shaft.nc'\)"):
        solve("shaft.nc")


# --- Help, and what the commands know of the controls -------------------------------------------------


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        (("ch",), ["plain,check"]),
        (("help", "che"), ["plain,check"]),
        (("check", "--control", "nct"), ["plain,nct-99m"]),
        (("check", "sha"), ["file,sha"]),
        (("solve", "sha"), ["file,sha"]),
        (("chek", "--con"), []),
        (("check", "--control", "x", "--control", "y", "--stri"), ["plain,--strict"]),
    ],
)
def test_a_shell_completes_commands_controls_and_files_whatever_stands_before(words, wanted):
    """As click's protocol for bash says it."""
    asked = {"COMP_WORDS": " ".join(("contoursolve", *words)), "COMP_CWORD": str(len(words))}
    done = CliRunner(env={"_CONTOURSOLVE_COMPLETE": "bash_complete", **asked}).invoke(main, prog_name="contoursolve")
    assert (done.exception, done.output.split()) == (None, wanted)


TEXT, TEXTS = {"type": "string"}, {"type": "array", "items": {"type": "string"}}
SOURCE = {"type": "object", "required": ["manual", "place", "evidence"], "additionalProperties": False}
SOURCE["properties"] = {"evidence": {"enum": ["printed", "derived", "assumed"]}, "manual": {}, "place": {}}
ALARM = {"type": ["object", "null"], "required": ["number", "evidence"], "maxProperties": 2}
RULE = {"source": SOURCE, "alarm": ALARM, "severity": {"enum": ["error", "warning", "info"]}}
RULE |= {name: TEXT | {"minLength": 1} for name in ("code", "message", "advice")}
RULE |= {"note": TEXT, "options": TEXT, "wrong": TEXTS, "right": TEXTS}
SETTING = dict.fromkeys(("name", "meaning", "default", "unit"), TEXT)
SETTING |= {"source": SOURCE, "values": {"type": "object"}, "bounds": {"type": ["array", "null"]}}
ZERO = {"names": TEXT | {"minLength": 1}, "move": TEXT | {"minLength": 1}, "source": SOURCE}


def test_the_catalogue_as_json_has_the_fields_that_the_page_lists():
    document = data("rules")
    assert document["schema"] == "contoursolve/rules/1"
    page = (PROGRAMS.parents[1] / "docs" / "programs.md").read_text(encoding="utf-8")
    for kind, schema in (("rules", RULE), ("zero", ZERO), ("settings", SETTING)):
        assert all(f"`{name}`" in page for name in schema)
        exact = {"type": "object", "properties": schema, "required": [*schema], "additionalProperties": False}
        for control in document["controls"]:
            Draft202012Validator({"items": exact, "minItems": 1}).validate(control[kind])
    told = {control["name"]: {rule["code"] for rule in control["rules"]} for control in document["controls"]}
    assert told == {name: {rule.code for rule in each.catalogue} for name, each in CONTROLS.items()}


# --- JSON ------------------------------------------------------------------------------------------


def test_json_of_the_worked_example_is_what_the_contract_shows():
    (contour,) = solve_json(*ONE)["contours"]
    assert (contour["plane"], contour["start"], contour["branch"]) == (["Z", "X"], [0, 20], None)
    assert contour["points"]["V1"] == pytest.approx([-30, 20])
    told = [(each["kind"], each.get("turn"), each.get("radius")) for each in contour["elements"]]
    assert told == [("line", None, None), ("arc", "cw", 5), ("line", None, None), ("arc", "ccw", 5)]
    ends = [[-27.1132, 20], [-31.4434, 22.5], [-45.8771, 47.5], [-50.2073, 50]]
    assert [each["end"] for each in contour["elements"]] == [pytest.approx(end, abs=5e-5) for end in ends]
    assert contour["end"] == contour["elements"][-1]["end"]


@pytest.mark.parametrize("circle", ["I-5000 J0", "X-5000 Y0 I-5000 J0", "X0 Y5000 R5000", "X-5000 Y0 R5000"])
@pytest.mark.parametrize("height", ["4999.99", "4999.999999", "4999.9999999999"])
def test_radius_of_the_certificate_bounds_the_error_of_a_line_that_almost_touches(circle, height):
    lines = ("G17 G41 G0 X5000 Y0", f"G3 {circle}", f"G1 X-6000 Y{height} ,A180 Q-1")
    (contour,) = solve_json(*blocks(*lines))["contours"]
    exact = float((Decimal(5000) ** 2 - Decimal(height) ** 2).sqrt())
    assert abs(contour["points"]["P1"][0] - exact) <= contour["certificate"]["radius"] < 1e-6


def test_json_of_check_names_each_finding_and_its_program():
    status, output, _ = run("check", SHAFT, BROKEN, "--format", "json")
    document = json.loads(output)
    assert status == 1
    assert [each["program"] for each in document["programs"]] == [SHAFT, BROKEN]
    assert [each.pop("program") for each in document["diagnostics"]] == [BROKEN] * len(document["diagnostics"])
    assert document["diagnostics"] == solve_json(BROKEN)["diagnostics"]


@pytest.mark.slow
def test_processes_write_the_same_bytes_whatever_the_order_of_sets():
    text = b"G17 G90 G0 X0 Y0\nG1 X60 ROUND=8 R5\nY40 ,R5"
    asked = "check", "-", "--control", "siemens-840d", "--format", "json"
    first, other = (run_process(*asked, stdin=text, PYTHONHASHSEED=seed) for seed in "12")
    assert first[0] == 1
    assert other == first


# --- Bad inputs ------------------------------------------------------------------------------------


UNREAD = {
    "check, errors": ("check", "--block", "G111 A180. B120.", "--start", "X40. Z0.", "--format", "json"),
    "expand": ("expand", SHAFT),
    "sweep": ("sweep", *ONE, "--vary", "A=170:190:1"),
    "bad usage": ("solve", "--nonsense"),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", UNREAD)
def test_the_exit_status_is_the_same_if_nobody_reads_the_output(name):
    command = [sys.executable, "-m", "contoursolve", *UNREAD[name]]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        said = process.stderr.read()
    assert (process.returncode, b"Traceback" in said) == (run(*UNREAD[name])[0], False)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no disk that is always full")
def test_a_full_disk_behind_the_output_is_told():
    with Path("/dev/full").open("wb") as full:
        command = [sys.executable, "-m", "contoursolve", "solve", SHAFT]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, check=False)
    assert (done.returncode, done.stderr) == (2, b"Error: the output cannot be written: No space left on device\n")


@pytest.mark.parametrize("command", ["solve", "check"])
@pytest.mark.parametrize(
    ("content", "told"),
    [
        (b"\x7fELF\x02\x01\x01\x00" + bytes(range(256)), "an executable"),
        (b"PK\x03\x04\x14\x00\x00\x00", "a zip archive or a spreadsheet"),
        (GOOD.encode() + bytes(range(32)), "binary data"),
        (b"// A part\n#ifndef PART_H\n#define PART_H\nint part(void);\n#endif\n", "C source"),
        (b"import math\nprint(math.pi)\n", "Python source"),
        (b"<?xml version='1.0'?>\n<part/>", "an XML or HTML file"),
        (GOOD.encode("utf-16"), "UTF-16 text: save it as UTF-8 or Latin-1 text"),
    ],
)
def test_an_unreadable_file_is_one_line_on_standard_error(command, content, told, save):
    for format_ in ("text", "json"):
        status, output, errors = run(command, path := save(content), "--format", format_)
        assert (status, output, errors.count("\n")) == (2, "", 1)
        assert f"{path} is {told}" in errors


def test_a_folder_is_no_file(tmp_path):
    for command, told in (("check", "no program is in this folder"), ("solve", "is a directory")):
        status, output, errors = run(command, tmp_path)
        assert (status, output, errors.count("\n")) == (2, "", 1)
        assert str(tmp_path) in errors
        assert told in errors


# --- Numbers without their point ---------------------------------------------------------------------


@pytest.mark.parametrize(
    "command",
    [
        ("sweep", "--vary", "A=170,180"),
        ("range", "--word", "P"),
        ("find", "--word", "A", "--bring", "end Z-50."),
        ("sensitivity",),
    ],
)
def test_commands_about_one_block_warn_of_its_start_point_beside_their_output(command):
    status, output, errors = run(*command, *ONE[2:], "--start", "X40 Z0", "--format", "json")
    assert (status, json.loads(output)["schema"]) == (0, f"contoursolve/{command[0]}/1")
    assert errors.startswith("warning: X40 of the start point has no decimal point and is read as 0.040 mm; X40. would")
    assert run(*command, *ONE)[2] == ""


# --- Units, rules, facts, and contours that wait ------------------------------------------------------


def test_a_finding_about_a_fact_that_is_stated_apart_stands_at_its_block():
    arguments = (*ONE, "--fact", "X of V2 = 100", "--fact", "X of V1 = 42")
    assert "--> --fact 2:1\n" in run("solve", *arguments)[1]
    for finding in data("check", *arguments)["diagnostics"]:
        assert (finding["line"], finding["column"], finding["end_column"]) == (1, 1, len(ONE[3]) + 1)
        assert finding["fact"]["number"] == {"words-redundant": 1, "words-conflict": 2}[finding["code"]]
    (log,) = json.loads(run("check", *arguments, "--format", "sarif")[1])["runs"]
    regions = [each["locations"][0]["physicalLocation"]["region"] for each in log["results"]]
    assert regions == [{"startLine": 1, "startColumn": 1, "endColumn": len(ONE[3]) + 1}] * 2
    fixes = [fix for each in log["results"] for fix in each.get("fixes", ())]
    both = 'delete --fact "X of V1 = 42"; delete --fact "X of V2 = 100"'
    assert any(both in each["description"]["text"] for each in fixes)


def test_contours_behind_a_refused_one_are_checked_from_where_its_best_fix_ends(save):
    lines = (
        "G00 X40. Z0.",
        "G111 A180. K-30. B120. X60. P50.",
        "G111 A180. K-10. B120. X100. Q3.",
        "G111 A180. K-10. B120. X120. Q300.",
        "G111 A180. K-10. B120. X140.",
    )
    path = save("\n".join(lines))
    document = solve_json(path)
    # What rests on an assumption is no contour.
    assert [each["status"] for each in document["contours"]] == ["no-solution", *["underdetermined"] * 3]
    assert [each["end"] for each in document["contours"]] == [None] * 4
    told = [(each["code"], each["line"]) for each in document["diagnostics"]]
    errors = [("g111-corner-too-large", 2), ("g111-corner-too-large", 4)]
    behind = [(code, line) for code in ("position-unknown", "start-assumed") for line in (3, 4, 5)]
    assert sorted(told) == sorted([*errors, *behind])
    # 20 mm is the largest P; with it line 2 ends at the same point.
    assert "checked from Z-35.7735 X60.0000 mm, where the best fix of program line 2 ends" in run("solve", path)[1]
    assert "= program lines 3, 4 and 5 are checked as if this were fixed\n" in run("check", path)[1]
    # The same findings as with the best fixes written.
    mended = [line.replace("P50.", "P20.").replace("Q300.", "Q20.") for line in lines]
    assert run("check", save("\n".join(mended)))[1] == "4 contours solved, no problems\n"


@pytest.mark.parametrize("count", [1, 40])
def test_a_command_that_shows_no_proof_makes_none(count, save, monkeypatch):
    made = []
    for module in ("contoursolve.solving.solve", "contoursolve.program.batch"):
        monkeypatch.setattr(import_module(module), "certify", lambda *asked: made.append(asked) or certify(*asked))
    path = save("\n".join([GOOD] * count))
    for command in ("check", "expand"):
        run(command, path)
        assert not made, command
    assert (run("solve", path)[0], len(made)) == (0, count)


@pytest.mark.parametrize(
    ("other", "own"),
    [
        (("plot", "a.nc", "-o", "a.svg"), ("draw", "a.nc", "-o", "a.svg", "--force")),
        (("sweep", *ONE, "--vary", "A=170:190:10", "--quiet"), ("family", *ONE, "--vary", "A=170:190:10", "--quiet")),
        (("range", *ONE, "--word", "P"), ("ranges", *ONE, "--word", "P")),
        (("sensitivity", *ONE, "--tolerance", "A=0.1"), ("tolerances", *ONE, "--tolerance", "A=0.1")),
        (("sensitivity", *ONE, "--keep=end Z=0.01"), ("tolerances", *ONE, "--keep=end Z=0.01")),
        (("fix", "a.nc", "--diff"), ("check", "--fix", "a.nc", "--diff")),
        (
            ("find", *ONE, "--word", "A", "--bring", "end Z-50.", "--set=yasnac-lx3.bevel=setback"),
            ("find", *ONE, "--word", "A", "--goal", "end Z-50.", "--setting=yasnac-lx3.bevel=setback"),
        ),
        (("solve", "a.nc", "--let", "#1=2."), ("solve", "a.nc", "--variable", "#1=2.")),
    ],
)
def test_other_spellings_do_the_same_and_no_help_lists_them(
    other: tuple[str, ...], own: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "a.nc").write_text("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5.\n", encoding="utf-8")
    found, expected = (CliRunner().invoke(main, list(each)) for each in (other, own))
    assert (found.exit_code, found.output) == (expected.exit_code, expected.output)
    assert found.exit_code == 0
    listed = re.findall(r"^  (\w+) ", CliRunner().invoke(main, ["--help"]).output, re.MULTILINE)
    assert own[0] in listed
    assert own[0] == other[0] or other[0] not in {*listed} - {"sensitivity"}


def listed_options(command, asked):
    """The options below the heading of a help."""
    listed = re.split(r"^(?:Main o|O)ptions.*:$", run(command, asked)[1], flags=re.MULTILINE)[1]
    return re.findall(r"^  (?:-\w, )?(--[\w-]+)", listed, re.MULTILINE)


@pytest.mark.parametrize("command", ["check", "solve", "family", "write"])
def test_the_help_of_a_long_command_shows_eight_options_and_help_all_every_one(command):
    brief, whole = (listed_options(command, each) for each in ("--help", "--help-all"))
    assert (len(brief), brief[-2:]) == (10, ["--help-all", "--help"])
    known = {param.opts[-1] for param in commands().get_command(None, command).params if param.opts[-1][:2] == "--"}
    assert {*brief} - {"--help-all", "--help"} < {*whole} - {"--help-all", "--help"} == known


def test_a_program_of_several_contours_is_one_table_with_the_numbers_of_each():
    status, table, _ = run("solve", SHAFT)
    assert (status, len(table.splitlines())) == (0, 40)
    contours = solve_json(SHAFT)["contours"]
    rows = re.findall(r"^ {7}.*? G0[123] +(-?[\d.]+) +(-?[\d.]+)", table, re.MULTILINE)
    ends = [(each["end"][0], 2 * each["end"][1]) for contour in contours for each in contour["elements"]]
    assert [tuple(map(float, row)) for row in rows] == [pytest.approx(end, abs=1e-4) for end in ends]
    assert [int(line) for line in re.findall(r"^ {1,5}(\d+)  ", table, re.MULTILINE)] == [53, *range(67, 73)]
    whole = run("solve", SHAFT, "--full")[1]
    assert whole.count(": solved\n") == 7 == len(contours)
    # One that is refused is told in full between the rows; with one contour there is no table.
    told = run("solve", BROKEN)[1]
    assert (told.count("cannot be cut\n"), told.count("line  element")) == (5, 1)
    assert "line  element" not in run("solve", *ONE)[1]
