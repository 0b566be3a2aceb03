"""The command line: exit status, JSON, processes, and an answer to every bad input."""

import json
import os
import re
import shlex
import subprocess
import sys
from decimal import Decimal
from importlib import import_module
from math import atan2, tau
from pathlib import Path

import pytest
from calling import blocks, call, data, run
from click.testing import CliRunner
from jsonschema import Draft202012Validator

from contoursolve import solve
from contoursolve.cli import main
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.controls import DIALECTS
from contoursolve.solving import certify

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
SHAFT, BROKEN, PLATE = (str(PROGRAMS / name) for name in ("shaft.nc", "shaft_broken.nc", "plate.nc"))
ONE = tuple(blocks("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0."))

START = "G00 X40. Z0.\n"
GOOD = START + "G111 X100. A180. K-30. B120. P5. Q5."
MILL = "G17 G90 G0 X90 Y0\nG42 G1 X50 D0\n"
PAIR = MILL + "G3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"


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


def codes(document, *severities):
    return [each["code"] for each in document["diagnostics"] if not severities or each["severity"] in severities]


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
        (0, ("check", SHAFT, PLATE)),
        (0, ("check", *ONE)),
        (0, ("solve", SHAFT, "--start", "X40. Z0.")),
        (0, ("rules", "--control", "nct-99m")),
        (0, ("--version",)),
        (1, ("solve", BROKEN)),
        (1, ("check", SHAFT, BROKEN)),
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
        (("solve", SHAFT, "--control", "fanuc"), "is not one of " + ", ".join(f"'{name}'" for name in DIALECTS)),
        (("solve", SHAFT, "--units", "cubit"), "'cubit' is not one of 'mm', 'inch'"),
        (("solve", SHAFT, "--rules", "perhaps"), "'perhaps' is not one of"),
        (("solve", SHAFT, "--format", "xml"), "'xml' is not one of"),
        (("solve", "no such file.nc"), "no such file.nc: no such file\n"),
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
    assert (status, errors) == (2, "Error: no such file.nc: no such file\n")
    assert output.splitlines()[-1] == "7 contours solved, no problems"
    with pytest.raises(ValueError, match="call solve_file"):
        solve("shaft.nc")


@pytest.mark.parametrize("command", ["solve", "check"])
def test_a_program_that_looks_like_several_controls_is_not_guessed(command, save):
    path = save(f"{GOOD}\n{PAIR}\n")
    status, output, errors = run(command, path)
    assert (status, output) == (2, "")
    assert "(yasnac-lx3 by G111 in program line 2; nct-99m by ,A171.87 and Q-1 in program line 6; " in errors
    assert errors.endswith("say which with --control yasnac-lx3|nct-99m|fanuc-lathe\n")
    assert run(command, path, "--control", "yasnac-lx3")[0] == 0


@pytest.mark.parametrize("command", ["solve", "check"])
@pytest.mark.parametrize(
    ("text", "options", "status", "told"),
    [
        ("G00 X40. Z0.\n", (), 0, "program.nc: no contour block, nothing to solve"),
        (
            "G17 G90 G0 X0 Y0\nG1 X50 A30\nG1 X10 Y20\n",
            (),
            2,
            "control not recognised; with mitsubishi, A30 is a word of a contour; with --control nct-99m: A30 has",
        ),
        (
            "G17 G90 G0 X0 Y0\nG1 X30 ,C10\nX40 Y40\n",
            ("--control", "yasnac-lx3"),
            2,
            "has no contour block: ,C10 in program line 2 is for nct-99m, fanuc-lathe, ",
        ),
        (
            "X60. ,A150. ,R2.\nZ-40.\n",
            ("--control", "fanuc-lathe"),
            2,
            "no G code of a motion is in force at ,A150. and ,R2. in program line 1: write G01",
        ),
    ],
)
def test_a_program_without_a_contour_is_told_why(command, text, options, status, told, save):
    found, output, _ = run(command, save(text), *options)
    assert found == status
    assert told in output
    assert ("try --control" in output) == (",C10" in told)


# --- Help, and what the commands know of the controls -------------------------------------------------


def test_help_is_a_command_too():
    assert run("help", "check") == run("check", "--help")
    assert run("help") == run("--help")
    assert run("-V") == run("--version")


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


def test_the_catalogue_as_json_has_the_fields_that_the_page_lists():
    document = data("rules")
    assert document["schema"] == "contoursolve/rules/1"
    page = (PROGRAMS.parents[1] / "docs" / "programs.md").read_text(encoding="utf-8")
    for kind, schema in (("rules", RULE), ("settings", SETTING)):
        assert all(f"`{name}`" in page for name in schema)
        exact = {"type": "object", "properties": schema, "required": [*schema], "additionalProperties": False}
        for control in document["controls"]:
            Draft202012Validator({"items": exact}).validate(control[kind])
    told = {control["name"]: {rule["code"] for rule in control["rules"]} for control in document["controls"]}
    assert told == {name: {rule.code for rule in dialect.catalogue} for name, dialect in DIALECTS.items()}


def test_an_alarm_is_explained_as_a_newer_control_prints_it_and_without_its_zeros():
    status, text, _ = run("explain", "055")
    assert (status, re.findall(r"alarm (\d+) ", text)) == (0, ["055"] * 3)
    assert all(run("explain", each)[:2] == (0, text) for each in ("55", "PS0055", "ps055"))
    status, text, _ = run("explain", "52", "--control", "fanuc-mill")
    assert (status, "fanuc-corner-without-next" in text) == (0, True)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (ONE, "YASNAC LX3 lathe control (from G111 in program line 1)"),
        (
            (*blocks("G1 X30 Y30 ,A45", start="X0 Y0"), "--rules", "off"),
            "NCT 99M and 2000M milling controls (from ,A45 in program line 1)",
        ),
        (
            (*blocks("G11 Z-20. I8.", start="X30. Z0."), "--control", "yasnac-lx3"),
            "YASNAC LX3 lathe control (from G11 in program line 1)",
        ),
        ((*ONE, "--control", "nct-99m"), "NCT 99M and 2000M milling controls (as asked for)"),
        (blocks("X1"), None),
    ],
)
def test_solve_says_for_which_control_it_read_and_what_shows_that(arguments, told):
    output = run("solve", *arguments)[1]
    assert re.findall(r"^control: (.*?\))", output, re.MULTILINE) == ([told] if told else [])


def test_every_column_of_numbers_has_its_unit():
    inch = blocks("G20 G111 X4. A180. K-1. B120. P.2", start="G20 X2. Z0.")
    for words, unit in ((ONE, "mm"), (inch, "in")):
        (head,) = (each for each in run("solve", *words)[1].splitlines() if "radius [" in each)
        assert head.count(f"[{unit}]") == head.count("[") == 5


def test_color_goes_only_to_who_wants_it(monkeypatch):
    bad = ["check", *blocks("G111 X100. A180. B120.", start="X40. Z0.")]
    monkeypatch.delenv("NO_COLOR", raising=False)
    shown = [
        "\x1b[" in CliRunner(env=environment).invoke(main, bad, color=color).output
        for environment, color in (({}, True), ({}, False), ({"NO_COLOR": "1"}, True), ({"TERM": "dumb"}, True))
    ]
    assert shown == [True, False, False, False]


# --- JSON ------------------------------------------------------------------------------------------


def check_document(document, text):
    """Nothing that the contours claim is wrong, and findings stand inside the program."""
    receipt = verify(Document("program", text.encode()), Document("result", json.dumps(document).encode()))
    assert receipt.verdict is not ReceiptVerdict.FAILED
    lines = text.split("\n")
    for each in document["diagnostics"]:
        assert 0 <= each["line"] <= len(lines)
        assert 1 <= each["column"] < each["end_column"] <= max(len(lines[each["line"] - 1]), 1) + 1
        assert re.fullmatch(r"[^\n]{1,399}", each["message"])
        assert each["source"].keys() == {"manual", "place", "evidence"}
        assert all(value is None or isinstance(value, (int, float)) for value in each["values"].values())


@pytest.mark.parametrize("rules", ["enforce", "warn", "off"])
@pytest.mark.parametrize(
    ("path", "control", "statuses"),
    [(SHAFT, "yasnac-lx3", ["solved"] * 7), (PLATE, "nct-99m", ["solved"] * 6), (BROKEN, "yasnac-lx3", None)],
    ids=["shaft", "plate", "broken"],
)
def test_json_of_a_program_is_right_whatever_the_rules(path, control, statuses, rules):
    document = solve_json(path, "--rules", rules)
    check_document(document, Path(path).read_text())
    assert document["control"] == control
    if statuses:
        assert ([each["status"] for each in document["contours"]], document["diagnostics"]) == (statuses, [])


def test_json_of_the_worked_example_is_what_the_contract_shows():
    (contour,) = solve_json(*ONE)["contours"]
    assert (contour["plane"], contour["start"], contour["branch"]) == (["Z", "X"], [0, 20], None)
    assert contour["points"]["V1"] == pytest.approx([-30, 20])
    told = [(each["kind"], each.get("turn"), each.get("radius")) for each in contour["elements"]]
    assert told == [("line", None, None), ("arc", "cw", 5), ("line", None, None), ("arc", "ccw", 5)]
    ends = [[-27.1132, 20], [-31.4434, 22.5], [-45.8771, 47.5], [-50.2073, 50]]
    assert [each["end"] for each in contour["elements"]] == [pytest.approx(end, abs=5e-5) for end in ends]
    assert contour["end"] == contour["elements"][-1]["end"]


@pytest.mark.parametrize(("sign", "branch", "crossing"), [("-1", "nearer", (40, 30)), ("1", "farther", (-30, 40))])
def test_json_of_a_circle_and_a_line_names_its_branch_and_turns_the_right_way(sign, branch, crossing):
    (contour,) = solve_json(*blocks(PAIR.replace("Q-1", f"Q{sign}")))["contours"]
    assert (contour["branch"], contour["plane"]) == (branch, ["X", "Y"])
    assert contour["points"]["P1"] == pytest.approx(crossing, abs=2e-4)
    arc = contour["elements"][0]
    begin, end = (atan2(arc[at][1], arc[at][0]) for at in ("start", "end"))
    assert arc["turn"] == "ccw"
    assert 0 < (end - begin) % tau < tau / 2


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
    several = "check", "-", "--control", "siemens-840d"
    text = b"G17 G90 G0 X0 Y0\nG1 X60 ROUND=8 R5\nY40 ,R5"
    for arguments, status in ((("solve", BROKEN, "--format", "json"), 1), (several, 1)):
        first, *others = (run_process(*arguments, stdin=text, PYTHONHASHSEED=seed) for seed in "123")
        assert first[0] == status
        assert others == [first, first]


# --- Bad inputs ------------------------------------------------------------------------------------

BAD = {
    # What a word that cannot be read would have said is not known: it is no finding that it is missing.
    "nothing at all": ("", "no-contour"),
    "blank lines": ("\n\n  \n", "no-contour"),
    "no contour block": ("%\nO1\nG00 X40. Z0.\nG01 Z-30. F0.2\nM30\n%", "no-contour"),
    "an address twice": (START + "G111 A10. A20. K-30. B120. X100.", "address-repeated"),
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
    "a Greek letter": (START + "G111 X100. A180. \N{GREEK CAPITAL LETTER BETA}120. K-30. B120.", "stray-character"),
    "Arabic digits": (START + "G111 X100. A180. K-30. B120. Q\u0661\u0662.", "number-missing stray-character"),
    "an expression": (START + "G111 X100. A180. K[#1+2] B120.", "value-variable"),
    "no start point": ("G111 X100. A180. K-30. B120.", "position-unknown"),
    "an M block between the arc and the line": (
        PAIR.replace("\nG1 X-50", "\nM8\nG1 X-50"),
        "nct-nothing-before words-conflict",
    ),
    "centre of another plane only": (
        PAIR.replace("X-50 Y0 R50", "K-50"),
        "nct-center-outside-plane nct-circle-undefined",
    ),
    "Q-0": (PAIR.replace("Q-1", "Q-0"), "nct-q-zero"),
    "a line that misses the circle by 1 nm": (
        PAIR.replace("X-50 Y42.857 ,A171.87", "X-60 Y50.000001 ,A180"),
        "nct-circle-missed",
    ),
    "UTF-8 byte order mark and a bad word": ("\ufeff" + START + "G111 X100. A180. K B120.", "number-missing"),
    "100 kB of words": (START + "G111 " + "A10. " * 20_000, "block-too-long"),
    "100 kB of one letter": ("X" * 100_000, "block-too-long"),
    "100 kB of digits": (START + "G111 A" + "9" * 100_000, "block-too-long"),
    "100 kB of brackets": (START + "G111 A" + "[" * 100_000, "block-too-long"),
    "100 kB of commas": (START + "G111 " + "," * 100_000, "block-too-long"),
    "100 kB of an open comment": (GOOD + " (" + "(" * 100_000, "comment-not-closed"),
    "500 bad lines": ("G111 A\n" * 500, "number-missing position-unknown"),
}
HARMLESS = {"comment-not-closed": "warning", "no-contour": "info"}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_gives_one_clear_finding_in_short_lines(name, save):
    text, expected = BAD[name]
    path, options = save(text), ("--control", "nct-99m") if text.startswith(MILL) else ()
    document = solve_json(path, *options)
    check_document(document, text.removeprefix("\ufeff"))
    assert {*codes(document, HARMLESS.get(expected, "error"))} == {*expected.split()}
    assert expected in HARMLESS or not any(each["end"] for each in document["contours"])
    assert max(map(len, run("check", path, *options)[1].splitlines())) < 500


UNREAD = {
    "check, errors": ("check", BROKEN, "--format", "json"),
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


# --- Ways to give a program ------------------------------------------------------------------------

SMALL = "(SHAFT \N{LATIN CAPITAL LETTER O WITH DIAERESIS} 40)\nG00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.\nM30"
ENCODINGS = {
    "UTF-8 with a byte order mark": (SMALL + "\n").encode("utf-8-sig"),
    "Latin-1": (SMALL + "\n").encode("latin-1"),
    "CRLF": (SMALL + "\n").replace("\n", "\r\n").encode(),
    "CR": (SMALL + "\n").replace("\n", "\r").encode(),
    "lower case": SMALL.lower().encode(),
    "no blanks": SMALL.replace(" ", "").encode(),
    "blanks inside words": SMALL.replace("X100.", "X 100.").encode(),
    "tabs": SMALL.replace(" ", "\t").encode(),
    "a DOS end of file": (SMALL + "\r\n\x1a").encode(),
    "tape codes": b"\x12% " + SMALL.encode() + b"\x14",
}


@pytest.mark.parametrize("name", ENCODINGS)
def test_the_same_program_in_any_encoding_from_anywhere_gives_the_same_contours(name, save):
    expected, found = solve_json(save(SMALL)), solve_json(save(ENCODINGS[name]))
    assert (found["contours"], found["diagnostics"]) == (expected["contours"], [])
    assert solve_json("-", stdin=ENCODINGS[name]) == {**found, "program": "<standard input>"}


def test_a_block_with_a_start_is_the_same_as_a_program(save):
    (expected,), (found,) = solve_json(save(GOOD))["contours"], solve_json(*ONE)["contours"]
    assert found == {**expected, "line": 1, "lines": [1]}


def test_blocks_follow_each_other():
    lines = (START.strip(), "G111 X100. A180. K-30. B120.", "G111 X120. B90. I0 K-5.")
    first, second = solve_json(*blocks(*lines))["contours"]
    assert (first["line"], second["line"], second["start"]) == (2, 3, first["end"])
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
    assert ("position-unknown" in codes(document)) == (None in start)


# --- Numbers without their point ---------------------------------------------------------------------

TAPER = "G111 X100. A180. K-30. B120."
COUNTED = {
    "in the program": (("G00 X40 Z0", TAPER), (), "X40", "0.040 mm", "40.000 mm", "X0.04"),
    "both words": (
        ("G00 X40 Z-2", TAPER),
        (),
        "X40 and Z-2",
        "0.040 mm and -0.002 mm",
        "40.000 mm and -2.000 mm",
        "X0.04 and Z-0.002",
    ),
    "apart": ((TAPER,), ("--start", "X40 Z0"), "X40", "0.040 mm", "40.000 mm", "X0.04"),
    "as a step": (("G00 X40. Z0.", "W-5", TAPER), (), "W-5", "-0.005 mm", "-5.000 mm", "W-0.005"),
    "no point anywhere": (("G00 X40 Z0", "G111 X100 A180 K-30 B120"), (), "X40", "0.040 mm", "40.000 mm", "X0.04"),
    "inches": (("G20 G00 X2 Z0.", "G111 X4. A180. K-1. B120."), (), "X2", "0.0002 in", "2.0000 in", "X0.0002"),
}


@pytest.mark.parametrize("name", COUNTED)
def test_a_start_point_that_counts_least_increments_is_told_with_both_readings(name):
    lines, start, words, actual, expected, same = COUNTED[name]
    document = data("check", *blocks(*lines), *start)
    (found,) = (each for each in document["diagnostics"] if each["code"] == "start-in-increments")
    several = "have no decimal point and are" if " and " in words else "has no decimal point and is"
    meant = " and ".join(f"{word}." for word in words.split(" and "))
    told = f"{words} of the start point {several} read as {actual}; {meant} would be {expected}"
    assert (found["severity"], found["message"], found["fixes"]) == ("warning", told, [])
    assert f"else {same}," in found["help"]
    assert found["line"] == max(1, len(lines) - 1)
    assert found.get("start") == ({"column": 1, "end_column": 4} if start else None)
    # Written as it is meant, or as it is read, nothing is left to say of it.
    for texts in (meant, same):
        again = "\n".join((*lines, *start))
        for old, new in zip(words.split(" and "), texts.split(" and "), strict=True):
            again = again.replace(old, new)
        text, _, apart = again.partition("\n--start\n")
        assert "start-in-increments" not in codes(data("check", "--block", text, "--start", apart))


@pytest.mark.parametrize(
    "program",
    [
        "G00 X40000 Z0\nG111 X100. A180. K-30. B120.",
        "G00 X40 Z0\nG111 X9000 A180000 K-30000 B120000",
        "G17 G90 G0 X90 Y0\nG1 X30 ,A45",
    ],
)
def test_a_start_point_that_can_be_meant_as_it_is_read_is_not_told(program):
    assert "start-in-increments" not in call("check", "-", stdin=program).output


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
def test_strict_names_each_move_whose_missing_point_makes_it_small(control, program, said):
    about = ("check", "-", "--control", control)
    findings = data(*about, "--strict", stdin=program)["diagnostics"]
    told = [each["message"] for each in findings if each["code"] == "move-in-increments"]
    assert len(told) == len(said), told
    assert all(text in each for each, text in zip(told, said, strict=True)), told
    assert "move-in-increments" not in codes(data(*about, stdin=program))


def test_strict_tells_a_word_once_where_the_start_of_a_contour_lacks_its_point():
    told = data("check", "-", "--strict", "--control", "fanuc-lathe", stdin="G0 X80 Z2.\nG1 Z-20. ,R3.\nX120.")
    about = [each["code"] for each in told["diagnostics"] if each["message"].startswith("X80 ")]
    assert about == ["start-in-increments"]


@pytest.mark.parametrize(("corner", "severity"), [(",R3", "warning"), (",R3000", "info"), (",R3.", None)])
def test_a_word_without_its_point_among_others_with_one_is_a_warning(corner, severity):
    program = f"G0 X20. Z2.\nG1 Z-20. {corner} F0.2\nX40."
    found = data("check", "-", "--control", "fanuc-lathe", stdin=program)["diagnostics"]
    told = [each["severity"] for each in found if each["code"] == "point-missing"]
    assert told == ([severity] if severity else [])


def test_range_tells_how_an_angle_without_its_point_is_read():
    about = blocks("G111 X100. A180 K-30. B120.", start="X40. Z0.")
    assert "A180 (read as 0.180 deg) points away from the end of line 1" in run("range", *about, "--word", "K")[1]


# --- Units, rules, facts, and contours that wait ------------------------------------------------------


def test_inches_are_shown_in_inches_and_written_to_json_in_mm():
    about = (*blocks("G111 X4. A180. K-1. B120.", start="X2. Z0."), "--units", "inch")
    assert solve_json(*about)["contours"][0]["points"]["V1"] == pytest.approx([-25.4, 25.4])
    assert "-1.00000" in run("solve", *about)[1]


@pytest.mark.parametrize(
    ("options", "is_told"), [(("X2. Z0.",), True), (("G20 X2. Z0.",), False), (("X2. Z0.", "--units", "inch"), False)]
)
def test_a_start_point_in_another_unit_than_the_contour_is_pointed_out(options, is_told):
    output = run("solve", "--block", "G20 G111 X4. A180. K-1. B120.", "--start", *options)[1]
    told = "info[start-units]: the start point was read in mm, the contour is in inches"
    assert (told in output, '--start "G20 X2. Z0."' in output) == (is_told, is_told)
    assert ("start X   2.00000" in output) is not is_told


@pytest.mark.parametrize(
    ("rules", "status", "severities"),
    [
        ("enforce", "rejected", {"g111-x-and-u": "error", "words-redundant": "warning"}),
        ("warn", "overdetermined", {"g111-x-and-u": "warning", "words-redundant": "warning"}),
        ("off", "overdetermined", {"words-redundant": "warning"}),
    ],
)
def test_rules_choose_whether_a_determined_block_that_the_manual_refuses_is_solved(rules, status, severities):
    about = blocks("G111 X100. A180. K-30. B120. U60.", start="X40. Z0.")
    document = solve_json(*about, "--rules", rules)
    assert document["contours"][0]["status"] == status
    assert {each["code"]: each["severity"] for each in document["diagnostics"]} == severities


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
    assert 'delete --fact "X of V1 = 42"; delete --fact "X of V2 = 100"' in fixes[0]["description"]["text"]


@pytest.mark.parametrize(
    ("third", "code", "cause"), [("X1l0.", "address-unknown", 3), ("X110.", "position-unknown", 2)]
)
def test_what_follows_from_a_line_before_comes_last_and_names_that_line(third, code, cause):
    lines = (START.strip(), "G111 X100. A180. B120.", f"G111 {third} A180. K-30. B120.", *[f"{TAPER}"] * 2)
    found = [each for each in data("check", *blocks(*lines))["diagnostics"] if each["severity"] == "error"]
    waiting = "the start point is not known in Z: this contour waits for program line {}, which is not solved"
    last = {each["line"]: each["message"] for each in found}
    assert [last[3], last[4], last[5]] == [waiting.format(line) for line in (2, cause, cause)]
    assert next(each["code"] for each in found if each["line"] == 3) == code


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
    assert "checked from Z-35.7735 X60.0000 mm, where the best fix of program line 2 ends" in run("check", path)[1]
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
    for module in ("contoursolve.solving.solve", "contoursolve.program.batch"):
        monkeypatch.setattr(import_module(module), "certify", lambda *asked: made.append(asked) or certify(*asked))
    path = save("\n".join([GOOD] * count))
    for command in ("check", "expand"):
        run(command, path)
        assert not made, command
    assert run("solve", path)[1].count("proven") == len(made) == count


REFUSED = (*blocks("G111 X100. A180. K-30. B120. P60.", start="X40. Z0."), "--rules", "warn")
OVERLAP = "G17 G90 G0 X0 Y0\nG1 X72.505 Y33.809 ,R10\nX64.053 Y51.935 ,R10\nX-8.452 Y18.126\n"


@pytest.mark.parametrize("command", ["expand", "plot -o out.svg", "diff", "sweep --vary P=-1,-2"])
def test_the_command_that_a_finding_names_shows_all_of_its_fixes(command, save, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    name, *options = command.split()
    path, control = save(OVERLAP), ("--control", "nct-99m")
    given = {"diff": (path, path, *control), "expand": (path, *control)}.get(name, REFUSED)
    if name == "sweep":
        given = (*blocks("G111 X100. A180. B120. P5.", start="X40. Z0."),)
    said = "\n".join(run(name, *options, *given)[1:])
    (told,) = {line.partition(": ")[2] for line in said.splitlines() if " more fix" in line}
    shown = run(*shlex.split(told.removesuffix(" lists all"))[1:])[1]
    (more,) = {int(each) for each in re.findall(r"= (\d+) more fix", said)}
    assert shown.count("= fix [") == said.count("= fix [") // said.count(" more fix") + more
    assert "more fix" not in shown
