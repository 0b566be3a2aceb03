"""The command line as the contract states it: exit status, text, JSON, and an answer to every bad input."""

import json
import os
import shlex
import subprocess
import sys
import time
from decimal import Decimal
from importlib import import_module
from math import atan2, hypot, tau
from pathlib import Path

import pytest
from click.testing import CliRunner
from jsonschema import Draft202012Validator

from contoursolve import solve
from contoursolve.cli import main
from contoursolve.controls import DIALECTS
from contoursolve.solving import certify

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
SHAFT, BROKEN, PLATE = (str(PROGRAMS / name) for name in ("shaft.nc", "shaft_broken.nc", "plate.nc"))
ONE = ("--block", "G111 X100. A180. K-30. B120. P5. Q5.", "--start", "X40. Z0.")

START = "G00 X40. Z0.\n"
GOOD = START + "G111 X100. A180. K-30. B120. P5. Q5."
MILL = "G17 G90 G0 X90 Y0\nG42 G1 X50 D0\n"
PAIR = MILL + "G3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"


def run(*arguments, stdin=None, **environment):
    """(exit status, standard output, standard error); nothing may ever end in a traceback."""
    done = CliRunner(env=environment).invoke(main, [str(each) for each in arguments], input=stdin)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    assert "Traceback" not in done.output
    return done.exit_code, done.stdout, done.stderr


def run_process(*arguments, stdin=b"", **environment):
    done = subprocess.run(
        [sys.executable, "-m", "contoursolve", *map(str, arguments)],
        input=stdin,
        capture_output=True,
        check=False,
        env={**os.environ, **environment},
    )
    assert b"Traceback" not in done.stdout + done.stderr
    return done.returncode, done.stdout, done.stderr


def solve_json(*arguments, **options):
    status, output, errors = run("solve", *arguments, "--format", "json", **options)
    assert errors == ""
    document = json.loads(output)
    assert status == any(each["severity"] == "error" for each in document["diagnostics"])
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
        (0, ("solve", SHAFT)),
        (0, ("solve", PLATE)),
        (0, ("check", SHAFT, PLATE)),
        (0, ("solve", *ONE)),
        (0, ("check", *ONE)),
        (0, ("rules",)),
        (0, ("rules", "--control", "nct-99m")),
        (0, ("explain", "g111-line-1")),
        (0, ("--help",)),
        (0, ("--version",)),
        (1, ("solve", BROKEN)),
        (1, ("check", BROKEN)),
        (1, ("check", SHAFT, BROKEN)),
        (2, ()),
        (2, ("solve",)),
        (2, ("check",)),
        (2, ("solve", SHAFT, *ONE)),
        (0, ("solve", SHAFT, "--start", "X40. Z0.")),
        (2, ("solve", SHAFT, "--control", "fanuc")),
        (2, ("solve", SHAFT, "--units", "cubit")),
        (2, ("solve", SHAFT, "--rules", "perhaps")),
        (2, ("solve", SHAFT, "--format", "xml")),
        (2, ("solve", "no such file.nc")),
        (2, ("check", SHAFT, "no such file.nc")),
        (2, ("explain", "no-such-rule")),
        (2, ("weld", SHAFT)),
    ],
)
def test_exit_status_is_0_without_errors_1_with_errors_and_2_if_it_could_not_run(status, arguments):
    found, output, errors = run(*arguments)
    assert found == status
    assert bool(errors) == (status == 2)
    # Of several programs, those that could be read are reported all the same.
    assert bool(output) == (status != 2 or arguments == ("check", SHAFT, "no such file.nc"))


@pytest.mark.parametrize(
    ("status", "arguments"),
    [
        pytest.param(0, (SHAFT,), marks=pytest.mark.slow),
        pytest.param(1, (BROKEN,), marks=pytest.mark.slow),
        (2, ("nothing.nc",)),
    ],
)
def test_exit_status_of_a_process_is_the_same(status, arguments):
    assert run_process("solve", *arguments)[0] == status


def test_unknown_control_lists_the_choices():
    status, _, errors = run("solve", SHAFT, "--control", "fanuc")
    assert status == 2
    assert all(name in errors for name in DIALECTS)


@pytest.mark.parametrize("command", ["solve", "check"])
def test_program_that_looks_like_both_controls_is_not_guessed(command, save):
    path = save(f"{GOOD}\n{PAIR}\n")
    status, output, errors = run(command, path)
    assert (status, output) == (2, "")
    assert all(name in errors for name in ("yasnac-lx3", "nct-99m"))
    assert run(command, path, "--control", "yasnac-lx3")[0] != 2


# --- Text ------------------------------------------------------------------------------------------


def test_text_of_a_solved_block_has_words_points_elements_and_a_summary():
    _, output, _ = run("solve", *ONE)
    for words in (
        ("start X", "40.0000", "mm"),
        ("A180.", "180.0000", "deg"),
        ("V1", "point", "-30.0000", "40.0000"),
        ("V2", "point", "-47.3205", "100.0000"),
        ("line 1", "G01", "-27.1132", "40.0000"),
        ("corner 1", "G02", "-31.4434", "45.0000"),
        ("line 2", "G01", "-45.8771", "95.0000"),
        ("corner 2", "G03", "-50.2073", "100.0000"),
    ):
        assert any(all(word in line for word in words) for line in output.splitlines()), words
    assert output.splitlines()[-1] == "1 contour solved, no problems"


def test_text_of_a_refused_block_marks_the_word_and_says_what_to_do():
    _, output, _ = run("check", "--block", "G111 X100. A180. B120.", "--start", "X40. Z0.")
    lines = output.splitlines()
    assert lines[0].startswith("error[g111-line-1]: ")
    listing = lines.index(next(line for line in lines if line.startswith("1 | ")))
    column = lines[listing].index("A180.")
    assert lines[listing + 1][column : column + 5] == "^^^^^"
    assert any("fix [fill in]: add K?" in line for line in lines)
    assert any("Table 2.34 (printed)" in line for line in lines)


def test_six_typical_mistakes_are_each_found_in_their_block():
    found = solve_json(BROKEN)
    lines = Path(BROKEN).read_text().splitlines()
    worst = {}
    for each in found["diagnostics"]:
        if each["severity"] != "info":
            worst.setdefault(lines[each["line"] - 1].split()[0], each["code"])
    assert worst == {
        "N120": "g111-line-1",
        "N210": "g111-a-ignored",
        "N310": "g111-corner-too-large",
        "N410": "g111-reversed",
        "N510": "g111-reversed",
        "N610": "g111-x-and-u",
    }
    ignored = next(each for each in found["diagnostics"] if each["code"] == "g111-a-ignored")
    assert ignored["values"]["expected"] == pytest.approx(140.1944, abs=1e-4)


@pytest.mark.parametrize(
    ("path", "control", "contours"),
    [pytest.param(SHAFT, "yasnac-lx3", 7, id="shaft"), pytest.param(PLATE, "nct-99m", 6, id="plate")],
)
def test_realistic_program_is_solved_without_a_finding(path, control, contours):
    found = solve_json(path)
    assert (found["control"], found["diagnostics"]) == (control, [])
    assert [each["status"] for each in found["contours"]] == ["solved"] * contours


@pytest.mark.slow
def test_every_rule_is_listed_and_explained():
    _, listing, _ = run("rules")
    for dialect in DIALECTS.values():
        for rule in dialect.catalogue:
            status, text, _ = run("explain", rule.code)
            assert (status, rule.code in listing, text.startswith(rule.code)) == (0, True, True)


SOURCE = {"type": "object", "required": ["manual", "place", "evidence"], "additionalProperties": False}
SOURCE["properties"] = {"evidence": {"enum": ["printed", "derived", "assumed"]}, "manual": {}, "place": {}}
ALARM = {"type": ["object", "null"], "required": ["number", "evidence"], "maxProperties": 2}
RULE = {"source": SOURCE, "alarm": ALARM, "severity": {"enum": ["error", "warning", "info"]}}
RULE |= {name: {"type": "string", "minLength": 1} for name in ("code", "message", "advice")}
RULE |= {name: {"type": "string"} for name in ("note", "options")}
RULE |= {name: {"type": "array", "items": {"type": "string"}} for name in ("wrong", "right")}
SETTING = {name: {"type": "string"} for name in ("name", "meaning", "default", "unit")} | {"source": SOURCE}
SETTING |= {"values": {"type": "object"}, "bounds": {"type": ["array", "null"]}}


def test_the_catalogue_as_json_has_the_fields_that_the_page_lists():
    document = json.loads(run("rules", "--format", "json")[1])
    assert document["schema"] == "contoursolve/rules/1"
    page = (Path(__file__).parents[2] / "docs" / "programs.md").read_text(encoding="utf-8")
    for kind, schema in (("rules", RULE), ("settings", SETTING)):
        assert all(f"`{name}`" in page for name in schema)
        exact = {"type": "object", "properties": schema, "required": [*schema], "additionalProperties": False}
        for control in document["controls"]:
            Draft202012Validator({"items": exact}).validate(control[kind])
    told = {control["name"]: {rule["code"] for rule in control["rules"]} for control in document["controls"]}
    assert told == {name: {rule.code for rule in dialect.catalogue} for name, dialect in DIALECTS.items()}
    status, _, errors = run("rules", "--table", "--format", "json")
    assert (status, "leave out --table" in errors) == (2, True)


def test_a_code_that_is_almost_one_is_asked_about():
    status, _, errors = run("explain", "g111-line1")
    assert status == 2
    assert "did you mean g111-line-1 or " in errors
    assert "did you mean" not in run("explain", "999")[2]


def test_an_alarm_is_explained_as_a_newer_control_prints_it_and_without_its_zeros():
    status, text, _ = run("explain", "055")
    assert status == 0
    assert all(run("explain", each)[:2] == (0, text) for each in ("55", "PS0055", "ps055"))
    both = run("explain", "52", "--control", "fanuc-mill")
    assert both[0] == 0
    assert "fanuc-corner-without-next" in both[1]


def test_solve_says_for_which_control_it_read_and_what_shows_that(save):
    line = ("--block", "G1 X30 Y30 ,A45", "--start", "X0 Y0", "--rules", "off")
    for arguments, told in (
        (ONE, "YASNAC LX3 lathe control (from G111 in program line 1)"),
        (line, "NCT 99M and 2000M milling controls (from ,A45 in program line 1)"),
        (
            ("--block", "G11 Z-20. I8.", "--start", "X30. Z0.", "--control", "yasnac-lx3"),
            "YASNAC LX3 lathe control (from G11 in program line 1)",
        ),
        ((*ONE, "--control", "nct-99m"), "NCT 99M and 2000M milling controls (as asked for)"),
    ):
        _, output, _ = run("solve", *arguments)
        assert output.splitlines()[-2].startswith(f"control: {told}")
    assert "control:" not in run("solve", "--block", "X1")[1]


def test_every_column_of_numbers_has_its_unit():
    for words, start, unit in ((ONE[1], "X40. Z0.", "mm"), ("G20 G111 X4. A180. K-1. B120. P.2", "G20 X2. Z0.", "in")):
        _, output, _ = run("solve", "--block", words, "--start", start)
        (head,) = (each for each in output.splitlines() if "radius [" in each)
        assert head.count(f"[{unit}]") == head.count("[") == 5


@pytest.mark.slow
def test_color_goes_only_to_who_wants_it(monkeypatch):
    bad = ["check", "--block", "G111 X100. A180. B120.", "--start", "X40. Z0."]
    monkeypatch.delenv("NO_COLOR", raising=False)
    assert "\x1b[" in CliRunner().invoke(main, bad, color=True).output
    assert "\x1b[" not in CliRunner().invoke(main, bad).output
    assert "\x1b[" not in CliRunner(env={"NO_COLOR": "1"}).invoke(main, bad, color=True).output
    assert "\x1b[" not in CliRunner(env={"TERM": "dumb"}).invoke(main, bad, color=True).output
    assert b"\x1b[" not in run_process(*bad)[1]


def test_help_is_a_command_too_and_knows_what_was_meant():
    assert run("help", "check") == run("check", "--help")
    assert run("help") == run("--help")
    assert run("-V") == run("--version")
    status, _, errors = run("help", "chek")
    assert (status, "Did you mean 'check'?" in errors) == (2, True)


def completed(*words):
    """What a shell is told that may stand for the last word, as click's protocol for bash says it."""
    asked = {"COMP_WORDS": " ".join(("contoursolve", *words)), "COMP_CWORD": str(len(words))}
    done = CliRunner(env={"_CONTOURSOLVE_COMPLETE": "bash_complete", **asked}).invoke(main, prog_name="contoursolve")
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.output.split()


def test_a_shell_completes_commands_controls_and_files_whatever_stands_before():
    assert completed("ch") == ["plain,check"]
    assert completed("help", "che") == ["plain,check"]
    assert completed("check", "--control", "nct") == ["plain,nct-99m"]
    assert completed("check", "sha") == completed("solve", "sha") == ["file,sha"]
    assert completed("chek", "--con") == []
    assert completed("check", "--control", "x", "--control", "y", "--stri") == ["plain,--strict"]


# --- JSON ------------------------------------------------------------------------------------------

POINT = {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}
COUNT = {"type": "integer", "minimum": 1}


def choice(*values):
    return {"enum": list(values)}


def record(optional=(), **properties):
    return {
        "type": "object",
        "properties": properties,
        "required": [name for name in properties if name not in optional],
    }


TEXT = {"type": "string"}
GRADE = choice("printed", "derived", "assumed")
SOURCE = record(manual=TEXT, place=TEXT, evidence=GRADE)
ELEMENT = {
    "oneOf": [
        record(kind={"const": "line"}, start=POINT, end=POINT),
        record(
            kind={"const": "arc"},
            start=POINT,
            end=POINT,
            center=POINT,
            radius={"type": "number", "exclusiveMinimum": 0},
            turn=choice("cw", "ccw"),
        ),
    ]
}
CONTOUR = record(
    line=COUNT,
    lines={"type": "array", "items": COUNT, "minItems": 1, "uniqueItems": True},
    status=choice("solved", "rejected", "underdetermined", "overdetermined", "conflicting", "no-solution"),
    plane=choice(["Z", "X"], ["X", "Y"], ["Y", "Z"]),
    start={"type": "array", "items": {"type": ["number", "null"]}, "minItems": 2, "maxItems": 2},
    end={"anyOf": [POINT, {"type": "null"}]},
    points={"type": "object", "patternProperties": {"^[VP][1-9]$": POINT}, "additionalProperties": False},
    elements={"type": "array", "items": ELEMENT},
    branch={"type": ["string", "null"]},
    conventions={"type": "array", "items": record(setting=TEXT, value=TEXT, meaning=TEXT, evidence=GRADE)},
    assumptions={"type": "array", "items": record(name=TEXT, meaning=TEXT, source=SOURCE)},
    certificate=record(
        kind=choice("exact", "unique", "verified", "unknown"), radius={"type": ["number", "null"], "minimum": 0}
    ),
)
VALUES = {"type": "object", "additionalProperties": {"type": ["number", "null"]}}
DIAGNOSTIC = record(
    code={"type": "string", "pattern": "^[a-z0-9]+(-[a-z0-9]+)*$"},
    severity=choice("error", "warning", "info"),
    line={"type": "integer", "minimum": 0},
    column=COUNT,
    end_column=COUNT,
    message={"type": "string", "pattern": "^[^\\n]+$"},
    addresses={"type": "array", "items": {"type": "string", "pattern": "^,?[A-Z]$"}},
    basis=choice("rule", "structural", "symbolic", "numerical"),
    source=SOURCE,
    values=VALUES,
    fixes={
        "type": "array",
        "items": record(
            description={"type": "string"},
            replacement={"type": "string"},
            applicability=choice("safe", "changes-contour", "placeholder"),
        ),
    },
)
SCHEMA = record(
    schema={"const": "contoursolve/solve/1"},
    control=choice("yasnac-lx3", "nct-99m", None),
    contours={"type": "array", "items": CONTOUR},
    diagnostics={"type": "array", "items": DIAGNOSTIC},
)
VALIDATOR = Draft202012Validator(SCHEMA)
GAP = 1e-9
"""mm."""


def check_document(document, text):
    """The contract beyond types: no gaps, arcs on their circles, findings inside the program."""
    VALIDATOR.validate(document)
    lines = text.split("\n")
    for contour in document["contours"]:
        elements, has_path = contour["elements"], contour["status"] in ("solved", "overdetermined")
        assert contour["line"] == contour["lines"][0]
        assert (contour["end"] is not None) == has_path == (contour["certificate"]["kind"] != "unknown")
        assert has_path or not (elements or contour["points"] or contour["branch"])
        here = contour["start"]
        for element in elements:
            assert gap(here, element["start"]) <= GAP < gap(element["start"], element["end"])
            here = element["end"]
            if element["kind"] == "arc":
                assert gap(element["center"], element["start"]) == pytest.approx(element["radius"], abs=GAP)
                assert gap(element["center"], element["end"]) == pytest.approx(element["radius"], abs=GAP)
        assert not has_path or gap(here, contour["end"]) <= GAP
    for each in document["diagnostics"]:
        assert each["line"] <= len(lines)
        assert each["column"] < each["end_column"] <= max(len(lines[each["line"] - 1]), 1) + 1


def gap(a, b):
    return hypot(a[0] - b[0], a[1] - b[1])


@pytest.mark.parametrize("rules", ["enforce", "warn", "off"])
@pytest.mark.parametrize("path", [SHAFT, BROKEN, PLATE], ids=["shaft", "broken", "plate"])
def test_json_of_a_program_keeps_the_contract(path, rules):
    check_document(solve_json(path, "--rules", rules), Path(path).read_text())


def test_json_of_the_worked_example_is_what_the_contract_shows():
    (contour,) = solve_json(*ONE)["contours"]
    assert contour["plane"] == ["Z", "X"]
    assert contour["start"] == [0, 20]
    assert contour["end"] == pytest.approx([-50.2073, 50], abs=5e-5)
    assert contour["points"]["V1"] == pytest.approx([-30, 20])
    assert [each["kind"] for each in contour["elements"]] == ["line", "arc", "line", "arc"]
    assert [each.get("turn") for each in contour["elements"]] == [None, "cw", None, "ccw"]
    assert contour["branch"] is None


def test_json_of_a_circle_and_a_line_names_its_branch_and_turns_the_right_way():
    for sign, branch, crossing in (("-1", "nearer", (40, 30)), ("1", "farther", (-30, 40))):
        (contour,) = solve_json("--block", MILL + PAIR.removeprefix(MILL).replace("Q-1", f"Q{sign}"))["contours"]
        assert (contour["branch"], contour["plane"]) == (branch, ["X", "Y"])
        assert contour["points"]["P1"] == pytest.approx(crossing, abs=2e-4)
        arc = contour["elements"][0]
        begin, end = (atan2(arc[at][1], arc[at][0]) for at in ("start", "end"))
        assert arc["turn"] == "ccw"
        assert 0 < (end - begin) % tau < tau / 2


@pytest.mark.parametrize("circle", ["I-5000 J0", "X-5000 Y0 I-5000 J0", "X0 Y5000 R5000", "X-5000 Y0 R5000"])
@pytest.mark.parametrize("height", ["4999.99", "4999.999999", "4999.9999999999"])
def test_radius_of_the_certificate_bounds_the_error_of_a_line_that_almost_touches(circle, height):
    blocks = ("G17 G41 G0 X5000 Y0", f"G3 {circle}", f"G1 X-6000 Y{height} ,A180 Q-1")
    (contour,) = solve_json(*(part for block in blocks for part in ("--block", block)))["contours"]
    exact = float((Decimal(5000) ** 2 - Decimal(height) ** 2).sqrt())
    assert abs(contour["points"]["P1"][0] - exact) <= contour["certificate"]["radius"]


def test_json_of_check_names_each_finding_and_its_program():
    status, output, _ = run("check", SHAFT, BROKEN, "--format", "json")
    document = json.loads(output)
    assert status == 1
    assert [each["program"] for each in document["programs"]] == [SHAFT, BROKEN]
    findings = document["diagnostics"]
    assert {each["program"] for each in findings} == {BROKEN}
    Draft202012Validator({"type": "array", "items": DIAGNOSTIC}).validate(findings)


@pytest.mark.parametrize(
    ("path", "form"),
    [
        (BROKEN, "json"),
        *(pytest.param(*case, marks=pytest.mark.slow) for case in ((BROKEN, "text"), (PLATE, "text"), (PLATE, "json"))),
    ],
    ids=["broken-json", "broken-text", "plate-text", "plate-json"],
)
@pytest.mark.slow
def test_two_processes_write_the_same_bytes(path, form):
    first = run_process("solve", path, "--format", form, PYTHONHASHSEED="1")
    assert first == run_process("solve", path, "--format", form, PYTHONHASHSEED="2")


@pytest.mark.slow
def test_two_processes_name_the_words_that_may_be_meant_in_the_same_order():
    def told(seed):
        arguments = "check", "-", "--control", "siemens-840d"
        return run_process(*arguments, stdin=b"G17 G90 G0 X0 Y0\nG1 X60 ROUND=8 R5\nY40 ,R5", PYTHONHASHSEED=seed)

    assert told("1") == told("2") == told("3")


# --- Bad inputs ------------------------------------------------------------------------------------

BAD = {
    # What a word that cannot be read would have said is not known: it is no finding that it is missing.
    "nothing at all": ("", "no-contour"),
    "blank lines": ("\n\n  \n", "no-contour"),
    "no contour block": ("%\nO1\nG00 X40. Z0.\nG01 Z-30. F0.2\nM30\n%", "no-contour"),
    "an address twice": (START + "G111 A10. A20. K-30. B120. X100.", "address-repeated"),
    "an address twice with the same value": (START + "G111 A180. A180. K-30. B120. X100.", "address-repeated"),
    "a word without a number": (START + "G111 X100. A180. K B120.", "number-missing"),
    "two decimal points": (START + "G111 X100. A180. K-1.2.3 B120.", "number-malformed"),
    "a decimal comma": (START + "G111 X100. A180. K-30,5 B120.", "number-malformed"),
    "two signs": (START + "G111 X100. A180. K--30. B120.", "number-malformed"),
    "NaN": (START + "G111 X100. A180. KNaN B120.", "number-missing"),
    "infinity": (START + "G111 X100. A180. K-inf B120.", "number-malformed number-missing"),
    "1e400": (START + "G111 X100. A180. K1e400 B120.", "number-malformed"),
    "400 digits": (START + f"G111 X100. A180. K{'9' * 400} B120.", "number-too-long"),
    "400 decimals": (START + f"G111 X100. A180. K-0.{'0' * 400}1 B120.", "number-too-long"),
    "a light year": (START + "G111 X100. A180. K-30. B120. Q9460730472580800.", "value-too-large"),
    "an address that G111 does not know": (START + "G111 X100. A180. K-30. B120. R5.", "address-unknown"),
    "a comma": (START + "G111 X100. A180. K-30. B120. ,", "comma-without-address"),
    "a dollar": (START + "G111 X100. A180. $ K-30. B120.", "stray-character"),
    "a Greek letter": (START + "G111 X100. A180. \N{GREEK CAPITAL LETTER BETA}120. K-30. B120.", "stray-character"),
    "Arabic digits": (START + "G111 X100. A180. K-30. B120. Q\u0661\u0662.", "number-missing stray-character"),
    "a variable": (START + "G111 X100. A180. K#101 B120.", "value-variable"),
    "an expression": (START + "G111 X100. A180. K[#1+2] B120.", "value-variable"),
    "G01 in the block": (START + "G01 G111 X100. A180. K-30. B120.", "g111-other-g"),
    "G04 in the block": (START + "G111 G04 X100. A180. K-30. B120.", "g111-other-g"),
    "G28 in the block": (START + "G111 G28 X100. A180. K-30. B120.", "g111-other-g"),
    "M in the block": (GOOD + " M08", "g111-m-s-t"),
    "S in the block": (GOOD + " S500", "g111-m-s-t"),
    "T in the block": (GOOD + " T0101", "g111-m-s-t"),
    "no start point": ("G111 X100. A180. K-30. B120.", "position-unknown"),
    "line over-defined without G41 or G42": (PAIR.replace("G42 ", ""), "nct-compensation-off"),
    "line over-defined after G40": (PAIR.replace("G3", "G40 G3"), "nct-compensation-off"),
    "line over-defined after positioning": (
        MILL + "G0 X60 Y10\nG1 X-50 Y42.857 ,A171.87",
        "nct-nothing-before words-conflict",
    ),
    "lines that are parallel": (MILL + "G1 ,A171.87\nG1 X-50 Y42.857 ,A171.87", "nct-parallel"),
    "a line by its angle and no coordinate": (MILL + "G1 ,A30", "nct-coordinate-missing"),
    "a corner before positioning": (MILL + "G1 X60 ,C2\nG0 X70", "nct-corner-without-next"),
    "a chamfer and a rounding": (MILL + "G1 X60 ,C2 ,R2\nY20", "nct-two-corners"),
    "line over-defined at the beginning": (
        "G17 G41\nG1 X-50 Y42.857 ,A171.87 Q-1",
        "nct-nothing-before position-unknown",
    ),
    "an M block between the arc and the line": (
        PAIR.replace("\nG1 X-50", "\nM8\nG1 X-50"),
        "nct-nothing-before words-conflict",
    ),
    "centre of another plane": (PAIR.replace("R50", "I-50 K0"), "nct-center-outside-plane"),
    "centre of another plane only": (
        PAIR.replace("X-50 Y0 R50", "K-50"),
        "nct-center-outside-plane nct-circle-undefined",
    ),
    "radius below half the chord": (PAIR.replace("R50", "R49.9"), "nct-radius-too-small"),
    "radius and no point": (PAIR.replace("X-50 Y0 R50", "R50"), "nct-radius-without-point"),
    "radius zero": (PAIR.replace("R50", "R0"), "nct-radius-zero"),
    "Q0": (PAIR.replace("Q-1", "Q0"), "nct-q-zero"),
    "Q-0": (PAIR.replace("Q-1", "Q-0"), "nct-q-zero"),
    "no Q": (PAIR.replace(" Q-1", ""), "nct-q-missing"),
    "a line that misses the circle by 1 nm": (
        PAIR.replace("X-50 Y42.857 ,A171.87", "X-60 Y50.000001 ,A180"),
        "nct-circle-missed",
    ),
    "NCT: two decimal points": (PAIR.replace("42.857", "42.8.57"), "number-malformed"),
    "NCT: an address twice": (PAIR.replace("R50", "R50 R50"), "address-repeated"),
    "NCT: an unknown address": (PAIR.replace("R50", "R50 E1"), "address-unknown"),
    "UTF-8 byte order mark and a bad word": ("\ufeff" + START + "G111 X100. A180. K B120.", "number-missing"),
    "1 MB of words": (START + "G111 " + "A10. " * 200_000, "block-too-long"),
    "1 MB of one letter": ("X" * 1_000_000, "block-too-long"),
    "1 MB of digits": (START + "G111 A" + "9" * 1_000_000, "block-too-long"),
    "1 MB of brackets": (START + "G111 A" + "[" * 1_000_000, "block-too-long"),
    "1 MB of commas": (START + "G111 " + "," * 1_000_000, "block-too-long"),
    "1 MB of an open comment": (GOOD + " (" + "(" * 1_000_000, "comment-not-closed"),
    "100 bad lines": ("G111 A\n" * 100, "number-missing position-unknown"),
    "5,000 bad lines": ("G111 A\n" * 5_000, "number-missing position-unknown"),
}
LONG = ("5,000 bad lines", "1 MB of an open comment")
"""Seconds are spent on them."""
WARNINGS = {"comment-not-closed": "warning", "no-contour": "info"}


@pytest.mark.parametrize("name", [pytest.param(name, marks=[pytest.mark.slow] * (name in LONG)) for name in BAD])
def test_bad_input_gives_one_clear_finding(name, save):
    text, expected = BAD[name]
    path, began = save(text), time.process_time()
    # The words of a mill are those of several controls.
    document = solve_json(path, *(("--control", "nct-99m") if text.startswith(MILL) else ()))
    assert time.process_time() - began < 60
    check_document(document, text)
    is_harmless = expected in WARNINGS
    wanted = WARNINGS.get(expected, "error")
    findings = [each for each in document["diagnostics"] if each["severity"] == wanted]
    assert {each["code"] for each in findings} == set(expected.split())
    assert max(len(each["message"]) for each in findings) < 400
    assert is_harmless or not any(each["end"] for each in document["contours"])


@pytest.mark.slow
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[pytest.mark.slow] * (name in LONG))
        for name, (text, _) in BAD.items()
        if len(text) > 30_000
    ],
)
def test_listing_of_a_huge_program_is_quick_and_its_lines_are_short(name, save):
    text, _ = BAD[name]
    path, began = save(text), time.process_time()
    for command in ("solve", "check"):
        status, output, _ = run(command, path)
        assert status in (0, 1)
        assert max(map(len, output.splitlines())) < 500
    assert time.process_time() - began < 100


@pytest.mark.parametrize("command", ["solve", "check"])
def test_a_program_that_only_looks_as_if_it_had_a_contour_could_not_be_examined(save, command):
    status, output, _ = run(command, save("G00 X40. Z0.\n"))
    assert (status, output.count("\n")) == (0, 1)
    assert "program.nc: no contour block, nothing to solve" in output
    status, output, _ = run(command, save("G17 G90 G0 X0 Y0\nG1 X50 A30\nG1 X10 Y20\n"))
    assert (status, output.startswith("error[control-unknown]")) == (2, True)
    assert (
        "control not recognised; with mitsubishi, A30 is a word of a contour; with --control nct-99m: A30 has" in output
    )
    status, output, _ = run(command, save("G17 G90 G0 X0 Y0\nG1 X30 ,C10\nX40 Y40\n"), "--control", "yasnac-lx3")
    assert (status, output.count("\n")) == (2, 1)
    assert "has no contour block: ,C10 in program line 2 is for nct-99m, " in output


def test_what_is_no_file_but_a_block_is_told_where_blocks_are_given():
    _, _, errors = run("solve", "G111 A180. K-30.")
    assert errors.endswith('no such file; a block is given by --block "G111 A180. K-30."\n')
    assert run("solve", "shaft 2.nc")[2].endswith("no such file\n")
    with pytest.raises(ValueError, match="call solve_file"):
        solve("shaft.nc")


UNREAD = {
    "solve": ("solve", SHAFT),
    "check, errors": ("check", BROKEN, "--format", "json"),
    "expand": ("expand", SHAFT),
    "filter": ("filter", PLATE),
    "sweep": ("sweep", *ONE, "--vary", "A=170:190:1"),
    "rules": ("rules", "--table"),
    "explain": ("explain", "g111-line-1"),
    "help": ("--help",),
    "bad usage": ("solve", "--nonsense"),
}


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[] if name == "bad usage" else pytest.mark.slow) for name in UNREAD],
)
@pytest.mark.slow
def test_the_exit_status_is_the_same_if_nobody_reads_the_output(name):
    command = [sys.executable, "-m", "contoursolve", *UNREAD[name]]
    status = run(*UNREAD[name])[0]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        process.stdout.close()
        said = process.stderr.read()
    assert (process.returncode, b"Traceback" in said) == (status, False)
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        process.stdout.close()
    assert process.returncode == status


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="there is no disk that is always full")
def test_a_full_disk_behind_the_output_is_told():
    with Path("/dev/full").open("wb") as full:
        command = [sys.executable, "-m", "contoursolve", "solve", SHAFT]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, check=False)
    assert (done.returncode, done.stderr) == (2, b"Error: the output cannot be written: No space left on device\n")


@pytest.mark.parametrize("command", ["solve", "check"])
@pytest.mark.parametrize("output", ["text", "json"])
def test_unreadable_file_is_one_line_on_standard_error(command, output, save, tmp_path):
    binaries = {
        "an executable": b"\x7fELF\x02\x01\x01\x00" + bytes(range(256)),
        "a zip archive or a spreadsheet": b"PK\x03\x04\x14\x00\x00\x00",
        "binary data": GOOD.encode() + bytes(range(32)),
        "C source": b"// A part\n#ifndef PART_H\n#define PART_H\nint part(void);\n#endif\n",
        "Python source": b"import math\nprint(math.pi)\n",
        "an XML or HTML file": b"<?xml version='1.0'?>\n<part/>",
        "UTF-16 text: save it as UTF-8 or Latin-1 text": GOOD.encode("utf-16"),
    }
    for name, content in binaries.items():
        status, found, errors = run(command, save(content), "--format", output)
        assert (status, found, errors.count("\n")) == (2, "", 1), name
        assert f" is {name}" in errors
    (tmp_path / "program.nc").unlink()
    folder = "no program is in this folder" if command == "check" else "is a directory"
    for path, reason in ((tmp_path / "missing.nc", "no such file"), (tmp_path, folder)):
        status, found, errors = run(command, path, "--format", output)
        assert (status, found, errors.count("\n")) == (2, "", 1)
        assert reason in errors
        assert str(path) in errors


# --- Ways to give a program ------------------------------------------------------------------------

SMALL = "(SHAFT \N{LATIN CAPITAL LETTER O WITH DIAERESIS} 40)\nG00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.\nM30"
ENCODINGS = {
    "UTF-8": (SMALL + "\n").encode(),
    "UTF-8 with a byte order mark": (SMALL + "\n").encode("utf-8-sig"),
    "Latin-1": (SMALL + "\n").encode("latin-1"),
    "CRLF": (SMALL + "\n").replace("\n", "\r\n").encode(),
    "CR": (SMALL + "\n").replace("\n", "\r").encode(),
    "no end of the last line": SMALL.encode(),
    "lower case": SMALL.lower().encode(),
    "no blanks": SMALL.replace(" ", "").encode(),
    "blanks inside words": SMALL.replace("X100.", "X 100.").encode(),
    "tabs": SMALL.replace(" ", "\t").encode(),
    "a DOS end of file": (SMALL + "\r\n\x1a").encode(),
    "tape codes": b"\x12%\n".replace(b"\n", b" ") + SMALL.encode() + b"\x14",
}


@pytest.mark.parametrize("name", ENCODINGS)
def test_same_program_in_any_encoding_gives_the_same_contours(name, save):
    expected, found = solve_json(save(SMALL)), solve_json(save(ENCODINGS[name]))
    assert (found["contours"], found["diagnostics"]) == (expected["contours"], [])


def test_standard_input_is_read_like_a_file(save):
    for name in ("UTF-8", "Latin-1", "CRLF"):
        from_file = solve_json(save(ENCODINGS[name]))
        assert solve_json("-", stdin=ENCODINGS[name]) == {**from_file, "program": "<standard input>"}
    assert run_process("solve", "-", "--format", "json", stdin=ENCODINGS["Latin-1"])[0] == 0
    assert run("check", "-", stdin=b"\x00\x01")[0] == 2
    assert run("check", "-", stdin=b"")[0] == 0


def test_block_with_start_is_the_same_as_a_program(save):
    path = save("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.")
    (expected,), (found,) = solve_json(path)["contours"], solve_json(*ONE)["contours"]
    assert found == {**expected, "line": 1, "lines": [1]}


def test_blocks_follow_each_other():
    blocks = (START.strip(), "G111 X100. A180. K-30. B120.", "G111 X120. B90. I0 K-5.")
    first, second = solve_json(*(part for block in blocks for part in ("--block", block)))["contours"]
    assert (first["line"], second["line"]) == (2, 3)
    assert second["start"] == first["end"]
    assert second["end"] == pytest.approx([first["end"][0] - 5, 60])


@pytest.mark.parametrize(
    ("arguments", "start"),
    [
        (("--start", "X40. Z0."), [0, 20]),
        (("--start", "x40.z0."), [0, 20]),
        (("--start", "G00 X40000 Z0"), [0, 20]),
        (("--start", "X2. Z0.", "--units", "inch"), [0, 25.4]),
        (("--start", "G20 X2. Z0."), [0, 25.4]),
        (("--start", "X40."), [None, 20]),
        (("--start", ""), [None, None]),
        ((), [None, None]),
    ],
)
def test_start_is_read_as_the_control_reads_a_block(arguments, start):
    document = solve_json("--block", "G111 X100. A180. K-1. B120.", *arguments)
    assert document["contours"][0]["start"] == start
    assert ("position-unknown" in {each["code"] for each in document["diagnostics"]}) == (None in start)


COUNTED = {
    "in the program": (("G00 X40 Z0", "G111 X100. A180. K-30. B120."), (), "X40", "0.040 mm", "40.000 mm", "X0.04"),
    "both words": (
        ("G00 X40 Z-2", "G111 X100. A180. K-30. B120."),
        (),
        "X40 and Z-2",
        "0.040 mm and -0.002 mm",
        "40.000 mm and -2.000 mm",
        "X0.04 and Z-0.002",
    ),
    "apart": (("G111 X100. A180. K-30. B120.",), ("--start", "X40 Z0"), "X40", "0.040 mm", "40.000 mm", "X0.04"),
    "as a step": (
        ("G00 X40. Z0.", "W-5", "G111 X100. A180. K-30. B120."),
        (),
        "W-5",
        "-0.005 mm",
        "-5.000 mm",
        "W-0.005",
    ),
    "no point anywhere": (("G00 X40 Z0", "G111 X100 A180 K-30 B120"), (), "X40", "0.040 mm", "40.000 mm", "X0.04"),
    "inches": (("G20 G00 X2 Z0.", "G111 X4. A180. K-1. B120."), (), "X2", "0.0002 in", "2.0000 in", "X0.0002"),
}


@pytest.mark.parametrize("name", COUNTED)
def test_a_start_point_that_counts_least_increments_is_told_with_both_readings(name, save):
    lines, start, words, actual, expected, same = COUNTED[name]
    blocks = [part for line in lines for part in ("--block", line)]
    _, output, _ = run("check", *blocks, *start, "--format", "json")
    (found,) = (each for each in json.loads(output)["diagnostics"] if each["code"] == "start-in-increments")
    several = "have no decimal point and are" if " and " in words else "has no decimal point and is"
    meant = " and ".join(f"{word}." for word in words.split(" and "))
    told = f"{words} of the start point {several} read as {actual}; {meant} would be {expected}"
    assert (found["severity"], found["message"]) == ("warning", told)
    assert f"else {same}," in found["help"]
    assert found["line"] == max(1, len(lines) - 1)
    assert found.get("start") == ({"column": 1, "end_column": 4} if start else None)
    assert found["fixes"] == []
    # Written as it is meant, or as it is read, nothing is left to say of it.
    for texts in (meant, same):
        again = "\n".join((*lines, *start))
        for old, new in zip(words.split(" and "), texts.split(" and "), strict=True):
            again = again.replace(old, new)
        text, _, apart = again.partition("\n--start\n")
        _, output, _ = run("check", "--block", text, "--start", apart)
        assert "start-in-increments" not in output


@pytest.mark.parametrize(
    "program",
    [
        "G00 X40000 Z0\nG111 X100. A180. K-30. B120.",
        "G00 X40 Z0\nG111 X9000 A180000 K-30000 B120000",
        "G17 G90 G0 X90 Y0\nG1 X30 ,A45",
    ],
)
def test_a_start_point_that_can_be_meant_as_it_is_read_is_not_told(program, save):
    assert "start-in-increments" not in run("check", save(program))[1]


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
    status, output, errors = run(*command, *ONE[:2], "--start", "X40 Z0", "--format", "json")
    assert status == 0
    assert json.loads(output)["schema"].startswith("contoursolve/")
    assert errors.startswith("warning: X40 of the start point has no decimal point and is read as 0.040 mm; X40. would")
    assert run(*command, *ONE)[2] == ""


def test_inches_are_shown_in_inches_and_written_to_json_in_mm():
    block = ("--block", "G111 X4. A180. K-1. B120.", "--start", "X2. Z0.", "--units", "inch")
    assert solve_json(*block)["contours"][0]["points"]["V1"] == pytest.approx([-25.4, 25.4])
    assert "-1.00000" in run("solve", *block)[1]


def test_rules_choose_whether_a_determined_block_that_the_manual_refuses_is_solved():
    block = ("--block", "G111 X100. A180. K-30. B120. U60.", "--start", "X40. Z0.")
    documents = {rules: solve_json(*block, "--rules", rules) for rules in ("enforce", "warn", "off")}
    found = {
        rules: (document["contours"][0]["status"], {each["code"]: each["severity"] for each in document["diagnostics"]})
        for rules, document in documents.items()
    }
    assert found["enforce"][0] == "rejected"
    assert found["enforce"][1]["g111-x-and-u"] == "error"
    assert found["warn"][0] == "overdetermined"
    assert found["warn"][1]["g111-x-and-u"] == "warning"
    assert found["off"] == ("overdetermined", {"words-redundant": "warning"})


@pytest.mark.slow
def test_a_finding_about_a_fact_that_is_stated_apart_stands_at_its_block():
    arguments = (*ONE, "--fact", "X of V2 = 100", "--fact", "X of V1 = 42")
    _, output, _ = run("solve", *arguments)
    assert "--> --fact 2:1\n" in output
    assert "--fact 2 | X of V1 = 42\n" in output
    _, output, _ = run("check", *arguments, "--format", "json")
    for finding in json.loads(output)["diagnostics"]:
        assert (finding["line"], finding["column"], finding["end_column"]) == (1, 1, len(ONE[1]) + 1)
        assert finding["fact"]["number"] == {"words-redundant": 1, "words-conflict": 2}[finding["code"]]
    _, output, _ = run("check", *arguments, "--format", "sarif")
    (log,) = json.loads(output)["runs"]
    regions = [each["locations"][0]["physicalLocation"]["region"] for each in log["results"]]
    assert regions == [{"startLine": 1, "startColumn": 1, "endColumn": len(ONE[1]) + 1}] * 2
    fixes = [fix for each in log["results"] for fix in each.get("fixes", ())]
    assert 'delete --fact "X of V1 = 42"; delete --fact "X of V2 = 100"' in fixes[0]["description"]["text"]


def test_a_start_point_in_another_unit_than_the_contour_is_pointed_out():
    inches = ("--block", "G20 G111 X4. A180. K-1. B120.")
    _, output, _ = run("solve", *inches, "--start", "X2. Z0.")
    assert "info[start-units]: the start point was read in mm, the contour is in inches" in output
    assert '--start "G20 X2. Z0."' in output
    for arguments in (("--start", "G20 X2. Z0."), ("--start", "X2. Z0.", "--units", "inch")):
        _, output, _ = run("solve", *inches, *arguments)
        assert "start-units" not in output
        assert "start X   2.00000" in output


def test_what_follows_from_a_line_before_comes_last_and_names_that_line(save):
    lines = ("G00 X40. Z0.", "G111 X100. A180. B120.", "G111 X1l0. A180. K-30. B120.", "G111 X120. A180. K-30. B120.")
    waiting = "the start point is not known in Z: this contour waits for program line {}, which is not solved"
    for third, causes in ((lines[2], (2, 3)), ("G111 X110. A180. K-30. B120.", (2, 2))):
        text = "\n".join((*lines[:2], third, lines[3], "G111 X130. A180. K-30. B120."))
        _, output, _ = run("check", save(text), "--format", "json")
        found = [each for each in json.loads(output)["diagnostics"] if each["severity"] == "error"]
        last = {each["line"]: each["message"] for each in found}
        assert [last[3], last[4], last[5]] == [waiting.format(line) for line in (2, causes[1], causes[1])]
        assert next(each["code"] for each in found if each["line"] == 3) == (
            "address-unknown" if causes[1] == 3 else "position-unknown"
        )
    status, _, errors = run("check", *ONE[:2], "--start", "X40. Z")
    assert (status, '--start "X40. Z": Z has no number' in errors) == (2, True)


def test_the_other_control_is_named_with_the_words_that_show_it(save):
    chamfer, both = "G17 G90 G0 X0 Y0\nG1 X30 ,C10\nX40 Y40\n", "G1 X30 ,C10\nG111 A4.\n"
    _, output, _ = run("check", save(chamfer), "--control", "yasnac-lx3")
    (advice,) = output.splitlines()
    others = "nct-99m, fanuc-lathe, fanuc-mill, haas-lathe, haas-mill or mitsubishi"
    assert advice.endswith(f",C10 in program line 2 is for {others}: try --control with one of them")
    assert len(advice) < 250
    _, _, errors = run("check", save(both))
    assert "yasnac-lx3 by G111 in program line 2; " in errors
    assert "nct-99m" in errors


def test_a_block_of_the_named_control_without_a_motion_is_not_sent_to_another_control():
    block = ("--block", "X60. ,A150. ,R2.", "--block", "Z-40.", "--start", "X40. Z0.")
    status, output, _ = run("check", *block, "--control", "fanuc-lathe")
    assert status == 2
    assert "no G code of a motion is in force at ,A150. and ,R2. in program line 1: write G01" in output
    assert "--control" not in output


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
    assert all(each["end"] is None for each in document["contours"])
    told = [(each["code"], each["line"]) for each in document["diagnostics"]]
    errors = [("g111-corner-too-large", 2), ("g111-corner-too-large", 4)]
    behind = [(code, line) for code in ("position-unknown", "start-assumed") for line in (3, 4, 5)]
    assert sorted(told) == sorted([*errors, *behind])
    _, output, _ = run("check", path)
    # 20 mm is the largest P; with it line 2 ends at the same point.
    assert "checked from Z-35.7735 X60.0000 mm, where the best fix of program line 2 ends" in output
    # The same findings as with the best fixes written.
    mended = [line.replace("P50.", "P20.").replace("Q300.", "Q20.") for line in lines]
    assert run("check", save("\n".join(mended)))[1] == "4 contours solved, no problems\n"


def test_contours_of_which_nobody_knows_where_they_begin_are_counted(save):
    path = save("G00 X40. Z0.\nG111 A180. B120. X100.\nG111 A180. K-10. B120. X120.\nG111 A180. K-10. B120. X130.\n")
    _, output, _ = run("check", path)
    assert "contour-waits" not in output
    assert output.splitlines()[-1].endswith("1 error; 2 contours wait for an end point")
    assert run("solve", path)[1].count("not checked: it waits for the end point of program line 2") == 2


@pytest.mark.parametrize("count", [1, 40])
def test_a_command_that_shows_no_proof_makes_none(count, save, monkeypatch):
    made = []

    def certified(*arguments):
        made.append(arguments)
        return certify(*arguments)

    for module in ("contoursolve.solving.solve", "contoursolve.program.batch"):
        monkeypatch.setattr(import_module(module), "certify", certified)
    path = save("\n".join([GOOD] * count))
    for command in ("check", "expand"):
        run(command, path)
        assert not made, command
    assert run("solve", path)[1].count("proven") == len(made) == count


# --- The command that explains ---------------------------------------------------------------------

REFUSED = ("--block", "G111 X100. A180. K-30. B120. P60.", "--start", "X40. Z0.", "--rules", "warn")
OVERLAP = "G17 G90 G0 X0 Y0\nG1 X72.505 Y33.809 ,R10\nX64.053 Y51.935 ,R10\nX-8.452 Y18.126\n"


@pytest.mark.parametrize("command", ["expand", "plot -o out.svg", "diff", "sweep --vary P=-1,-2"])
def test_the_command_that_a_finding_names_shows_all_of_its_fixes(command, save, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    name, *options = command.split()
    path, control = save(OVERLAP), ("--control", "nct-99m")
    given = {"diff": (path, path, *control), "expand": (path, *control)}.get(name, REFUSED)
    if name == "sweep":
        given = ("--block", "G111 X100. A180. B120. P5.", *REFUSED[2:4])
    said = "\n".join(run(name, *options, *given)[1:])
    (told,) = {line.partition(": ")[2] for line in said.splitlines() if " more fix" in line}
    shown = run(*shlex.split(told.removesuffix(" lists all"))[1:])[1]
    assert shown.count("= fix [") > 2
    assert "more fix" not in shown


_POINTED = "G0 X20. Z2.\nG1 Z0. F0.2\nG1 Z-20. ,R3.\nX40.\n"
_MILLED = "G17 G90 G0 X0 Y0\nG1 X30. ,C3. F100.\nY20.\n"


@pytest.mark.parametrize(
    ("control", "program", "said"),
    [
        (
            "fanuc-lathe",
            _POINTED + "Z-60\nX80",
            ["-0.060 mm; Z-60. would be -60.000", "0.080 mm; X80. would be 80.000"],
        ),
        ("haas-lathe", "G0 X80\n" + _POINTED + "G90 X30 Z-5", ["0.080 mm; X80.", "0.030 mm and -0.005 mm; X30. and"]),
        ("haas-mill", _MILLED + "G0 Z-60\nG81 Z-20 R2. F100", ["-0.060 mm; Z-60.", "-0.020 mm; Z-20."]),
        ("yasnac-lx3", "G00 X40. Z0.\nG111 A180. K-30. B120. X100.\nG01 U5", ["0.005 mm; U5. would be 5.000 mm"]),
        ("fanuc-mill", _MILLED + "G2 X40. Y30. R10\nM30", ["0.010 mm; R10. would be 10.000 mm"]),
        # Times, other uses of axis words, and zeros; small increments where no word has a point; as it is written.
        ("fanuc-mill", _MILLED + "G4 X500\nG28 Z0\nX0 Y0\nX80000", []),
        ("fanuc-lathe", "G0 X20000 Z2000\nG1 Z-20000 ,R3000 F200\nX40000\nX800", []),
        ("fanuc-lathe", "G0 X80\nZ-60", []),
        ("siemens-840d", "G17 G90 G0 X0 Y0\nG1 X30 RND=3\nY20\nX80", []),
    ],
)
def test_strict_names_each_move_whose_missing_point_makes_it_small(control, program, said, save):
    findings = json.loads(run("check", "--strict", "--control", control, "--format", "json", save(program))[1])
    told = [each["message"] for each in findings["diagnostics"] if each["code"] == "move-in-increments"]
    assert len(told) == len(said), told
    assert all(text in each for each, text in zip(told, said, strict=True)), told
    assert "move-in-increments" not in run("check", "--control", control, save(program))[1]


def test_strict_tells_a_word_once_where_the_start_of_a_contour_lacks_its_point(save):
    output = run("check", "--strict", "--control", "fanuc-lathe", save("G0 X80 Z2.\nG1 Z-20. ,R3.\nX120."))[1]
    assert output.count("X80 ") == 1 + output.count("4 | ") + output.count("| G0 X80 ")
    assert "start-in-increments" in output


@pytest.mark.parametrize(("corner", "severity"), [(",R3", "warning"), (",R3000", "info"), (",R3.", None)])
def test_a_word_without_its_point_among_others_with_one_is_a_warning(corner, severity, save):
    program = save(f"G0 X20. Z2.\nG1 Z-20. {corner} F0.2\nX40.")
    found = json.loads(run("check", "--control", "fanuc-lathe", "--format", "json", program)[1])
    told = [each["severity"] for each in found["diagnostics"] if each["code"] == "point-missing"]
    assert told == ([severity] if severity else [])


def test_a_command_with_a_slip_is_answered_with_the_one_that_is_meant():
    status, _, errors = run("solv", "x.nc")
    assert (status, "No such command 'solv'. Did you mean 'solve'?" in errors) == (2, True)
    assert "mean" not in run("zzz")[2]


def test_range_tells_how_an_angle_without_its_point_is_read():
    block = ("--block", "G111 X100. A180 K-30. B120.", "--start", "X40. Z0.")
    assert "A180 (read as 0.180 deg) points away from the end of line 1" in run("range", *block, "--word", "K")[1]


def test_a_summary_says_the_status_in_plain_words(save):
    output = run("check", "--control", "mitsubishi", save("G17 G90\nG0 X0 Y0\nG1 X0 A90. F100.\nM30"))[1]
    assert "determined" not in output
    assert "1 contour" in output
