"""Findings for other tools: SARIF, GitHub's annotations, exit statuses and the summary of many files."""

import json
import re
from pathlib import Path

import jsonschema
import pytest
from calling import call

from contoursolve import solve

BROKEN = "G00 X40. Z0.\nG111 A135. I10. K-12. B180. Z-40. P2.\nG00 X40. Z0.\nG111 A180. K-30. P90. B120. X100.\n"
CLEAN = "G00 X40. Z0.\nG111 A180. K-30. B120. X100.\n"
WARNED = "G00 X40. Z0.\nG111 A135. I10. K-12. B180. Z-40.\n"
NOTHING = "G00 X40. Z0.\nM30\n"


@pytest.fixture
def save(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def write(text: str, name: str = "part.nc") -> str:
        Path(name).write_text(text, encoding="utf-8")
        return name

    return write


def check(*arguments):
    return call("check", *arguments)


def sarif(*paths: str) -> dict:
    (run,) = json.loads(check(*paths, "--format", "sarif").output)["runs"]
    return run


# SARIF ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("text", [BROKEN, CLEAN, WARNED, NOTHING, "", "G111 A1,5\n", "%\nG111 A#1 \u00e9\n"])
def test_sarif_holds_against_its_schema(text, save, request):
    path = request.config.getoption("--sarif-schema")
    if not path:
        pytest.skip("--sarif-schema names the file of the SARIF 2.1.0 schema, to validate against it")
    schema = json.loads(Path(path).read_text(encoding="utf-8"))
    log = json.loads(check(save(text), "--control", "yasnac-lx3", "--format", "sarif").output)
    jsonschema.validators.validator_for(schema)(schema).validate(log)


def fingerprints(run: dict) -> list[tuple[str, str]]:
    return [(result["ruleId"], json.dumps(result["partialFingerprints"])) for result in run["results"]]


def test_fingerprints_stay_when_lines_are_inserted_above_and_differ_from_one_another(save):
    twice = BROKEN + BROKEN
    before = fingerprints(sarif(save(twice)))
    after = fingerprints(sarif(save("(a comment)\nG21\n\n" + twice)))
    assert before == after
    assert len(set(before)) == len(before) == 4


def test_sarif_fixes_applied_to_the_file_remove_their_finding(save):
    run = sarif(save(BROKEN))
    fixes = [(result["ruleId"], fix) for result in run["results"] for fix in result.get("fixes", ())]
    assert {code for code, _ in fixes} == {"g111-a-ignored", "g111-corner-too-large"}
    for code, fix in fixes:
        (change,) = fix["artifactChanges"]
        (replacement,) = change["replacements"]
        region, lines = replacement["deletedRegion"], BROKEN.splitlines()
        assert change["artifactLocation"]["uri"] == "part.nc"
        line = lines[region["startLine"] - 1]
        text = replacement["insertedContent"]["text"]
        lines[region["startLine"] - 1] = line[: region["startColumn"] - 1] + text + line[region["endColumn"] - 1 :]
        found = [each.code for each in solve("\n".join(lines)).diagnostics]
        assert code not in found, (fix["description"], found)
        assert len(found) == 1


def test_a_fix_that_drops_a_line_takes_its_end_out_too(save):
    lines = ["1 L X+0 Y+0 R0 F500", "2 FL X+30 AN+0", "3 RND R60", "4 FL X+50 Y+30", "5 L X+60", ""]
    (found,) = sarif(save("\n".join(lines), "part.h"))["results"]
    (fix,) = [each for each in found["fixes"] if each["description"]["text"].startswith("delete RND")]
    (replacement,) = fix["artifactChanges"][0]["replacements"]
    assert replacement["deletedRegion"] == {"startLine": 3, "startColumn": 1, "endLine": 4, "endColumn": 1}
    assert replacement["insertedContent"]["text"] == ""


# GitHub -----------------------------------------------------------------------------------------------

COMMAND = re.compile(r"::(error|warning|notice) ((?:[A-Za-z]+=[^,:\r\n]*,?)+)::(.+)")


def test_github_has_one_line_a_finding_with_its_place(save):
    first, second = check(save(BROKEN), "--format", "github").output.splitlines()
    warning, error = solve(BROKEN).diagnostics
    assert first.startswith(f"::warning file=part.nc,line=2,col=6,endColumn=11,title={warning.code}::")
    assert second.startswith(f"::error file=part.nc,line=4,col=18,endColumn=22,title={error.code}::")
    for line, finding in ((first, warning), (second, error)):
        assert COMMAND.fullmatch(line)[3].split("%0A")[0] == finding.message.replace("%", "%25")
    assert check(save(CLEAN), "--format", "github").output == "\n"


def test_github_escapes_what_would_end_a_property_or_a_command(save):
    name = save("G00 X40. Z0.\nG111 A180. K-30. B120. X10%0.\n", "50%,a:b.nc")
    for line in check(name, "--format", "github").output.splitlines():
        _, properties, message = COMMAND.fullmatch(line).groups()
        assert properties.startswith("file=50%25%2Ca%3Ab.nc,")
        assert not re.search(r"%(?!25|0A|0D)", message)


# Folders ----------------------------------------------------------------------------------------------


def test_a_folder_stands_for_its_programs_and_those_of_the_folders_in_it(save):
    for folder in ("parts/deep", "parts/.git", "empty"):
        Path(folder).mkdir(parents=True)
    names = ["parts/O1234", "parts/a.NC", "parts/deep/b.mpf"]
    for name in [*names, "parts/.git/c.nc", "parts/.d.nc", "parts/notes.txt", "parts/part.dxf"]:
        save(WARNED, name)

    def examined(*paths: str) -> list[str]:
        return [each.partition("=")[2] for each in re.findall("file=[^,]*", check(*paths, "--format", "github").stdout)]

    assert examined("parts") == examined("p*s", "empty") == names
    assert {*examined("parts/*")} == {*names, "parts/notes.txt", "parts/part.dxf"}
    assert examined("**/*.mpf") == names[2:]
    assert examined("parts/notes.txt") == ["parts/notes.txt"]
    done = check("empty")
    assert (done.exit_code, "empty: no program is in this folder; programs end in .nc," in done.stderr) == (2, True)
    assert check("parts", "--fix").exit_code == 0
    assert examined("parts") == []


# Exit statuses and the summary ------------------------------------------------------------------------


def test_summary_of_several_files_tells_nothing_found_from_nothing_examined(save):
    clean, nothing, broken = save(CLEAN, "1.nc"), save(NOTHING, "2.nc"), save(BROKEN, "3.nc")
    assert check(clean).output == "1 contour solved, no problems\n"
    assert check(nothing).output == f"{nothing}: no contour block, nothing to solve; --explain says how one begins\n"
    assert check(clean, clean).output.splitlines()[-1] == "2 programs, 2 contours solved, no problems"
    last = check(clean, nothing, broken).output.splitlines()[-1]
    assert last == "3 programs, 3 contours: 2 solved, 1 cannot be cut; 1 error, 1 warning"
