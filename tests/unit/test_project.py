"""What stands beside the package: the workflow, the hook of pre-commit and the citation agree with it."""

import json
import re
import tomllib
from importlib.metadata import entry_points
from pathlib import Path

import pytest
import yaml
from click import Context
from click.testing import CliRunner

import contoursolve
from contoursolve.__main__ import commands

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PYTHONS = [each.split(" :: ")[-1] for each in PROJECT["classifiers"] if re.search(r":: 3\.\d+$", each)]


def read_yaml(name: str):
    return yaml.safe_load((ROOT / name).read_text(encoding="utf-8"))


def test_the_supported_pythons_are_the_same_everywhere() -> None:
    (first, last) = re.findall(r"python3\.\{(\d+)\.\.(\d+)\}", (ROOT / ".ci" / "run").read_text(encoding="utf-8"))[0]
    assert [f"3.{minor}" for minor in range(int(first), int(last) + 1)] == PYTHONS
    assert PROJECT["requires-python"] == f">={PYTHONS[0]}"
    assert read_yaml(".github/workflows/ci.yml")["jobs"]["tests"]["strategy"]["matrix"]["python"] == PYTHONS


def test_the_workflow_runs_ci_run_and_the_tests_of_the_readme_on_every_system() -> None:
    workflow = read_yaml(".github/workflows/ci.yml")
    assert {"push", "pull_request"} <= set(workflow[True])  # YAML 1.1 reads `on` as true
    jobs = workflow["jobs"]
    assert ".ci/run" in [step.get("run") for step in jobs["everything"]["steps"]]
    assert set(jobs["tests"]["strategy"]["matrix"]["system"]) >= {"windows-latest", "macos-latest"}
    assert not jobs["tests"]["strategy"]["fail-fast"]
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (line,) = re.findall(r"^<!-- tests -->\n```sh\n(.*)\n```$", readme, re.MULTILINE)
    _, *commands = line.split(" && ")
    run = [step["run"] for step in jobs["tests"]["steps"] if "run" in step]
    assert run == [command.replace(".venv/bin/python", "python") for command in commands]
    for job in [*jobs.values(), *read_yaml(".github/workflows/desktop.yml")["jobs"].values()]:
        for step in job["steps"]:
            assert re.fullmatch(r"actions/[\w-]+@v\d+", step.get("uses", "actions/x@v1"))


def test_the_program_without_python_is_built_on_every_system_and_attached_to_a_tag() -> None:
    workflow = read_yaml(".github/workflows/desktop.yml")
    assert workflow[True]["push"] == {"tags": ["v*"]}
    build, attach = workflow["jobs"]["build"], workflow["jobs"]["attach"]
    systems = {each["system"].partition("-")[0] for each in build["strategy"]["matrix"]["include"]}
    assert systems == {"windows", "macos", "ubuntu"}
    commands = " ".join(step.get("run", "") for step in build["steps"])
    for name in re.findall(r"[\w./-]+\.(?:spec|py)\b", commands):
        assert (ROOT / name).is_file()
    assert (attach["if"], attach["permissions"]) == ("github.ref_type == 'tag'", {"contents": "write"})
    assert workflow["permissions"] == {"contents": "read"}
    brought = " ".join(PROJECT["optional-dependencies"]["desktop"])
    (extras,) = re.findall(r"contoursolve\[([\w,]+)\]", brought)
    assert PROJECT["optional-dependencies"].keys() >= {*extras.split(",")}
    page = (ROOT / "docs" / "install.md").read_text(encoding="utf-8")
    (told, without) = re.search(r"It has the extras (.*?)\. It is without (.*?),\s+which", page, re.DOTALL).groups()
    assert re.findall(r"`(\w+)`", told) == extras.split(",")
    of_users = PROJECT["optional-dependencies"].keys() - {"ci", "desktop", "docs", "peers", "test"}
    assert {*re.findall(r"`(\w+)`", without)} == of_users - {*extras.split(",")}


def test_the_citation_is_of_this_version() -> None:
    citation = read_yaml("CITATION.cff")
    assert citation["version"] == PROJECT["version"] == contoursolve.__version__
    assert citation["title"] == PROJECT["name"]
    assert citation["license"] == PROJECT["license"]
    assert [each["name"] for each in citation["authors"]] == [each["name"] for each in PROJECT["authors"]]
    assert {"cff-version", "message"} <= set(citation)


def test_a_version_of_the_changes_is_short_and_each_line_leads_to_a_page() -> None:
    _, *versions = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").split("\n## ")
    assert versions
    assert versions[0].startswith(contoursolve.__version__)
    for version in versions:
        assert len(version.split()) > 1
        assert len([line for line in version.splitlines() if line]) <= 20
        assert {*re.findall(r"^(\w+):$", version, re.MULTILINE)} <= {"Added", "Changed", "Mended"}
        for entry in re.split(r"^\* ", version, flags=re.MULTILINE)[1:]:
            assert re.search(r"\]\([\w./#-]+\)", entry), entry


def test_the_hook_runs_a_command_that_exists() -> None:
    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    program, command = hook["entry"].split()
    assert program in entry_points(group="console_scripts").names
    assert program in PROJECT["scripts"]
    assert command in commands().list_commands(Context(commands()))
    assert hook["language"] == "python"


@pytest.mark.parametrize(("name", "status"), [("shaft", 0), ("shaft_broken", 1)])
def test_the_hook_takes_programs_and_fails_on_a_faulty_one(name, status) -> None:
    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    program = ROOT / "notebooks" / "programs" / f"{name}.nc"
    assert re.search(hook["files"], program.name)
    assert CliRunner().invoke(commands(), [hook["entry"].split()[1], str(program)]).exit_code == status


@pytest.mark.parametrize("ending", ["nc", "NC", "cnc", "ngc", "tap", "mpf", "MPF", "spf", "min", "eia", "gcode"])
def test_the_hook_takes_files_by_their_ending(ending) -> None:
    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    assert re.search(hook["files"], f"parts/shaft.{ending}")


@pytest.mark.parametrize("name", ["README.md", "stdio.h", "nc", "shaft.nc.bak", "shaft.nc~"])
def test_the_hook_leaves_other_files(name) -> None:
    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    assert not re.search(hook["files"], name)


def test_the_page_of_editors_starts_a_command_that_exists_for_the_files_of_the_hook() -> None:
    page = (ROOT / "docs" / "editors.md").read_text(encoding="utf-8")
    found = dict(re.findall(r"<!-- ([\w.-]+) -->\n```\w+\n(.*?)```", page, re.DOTALL))
    helix, kate = tomllib.loads(found["helix"]), json.loads(found["kate"])["servers"]["gcode"]
    server = helix["language-server"]["contoursolve"]
    assert [server["command"], *server["args"]] == kate["command"] == ["contoursolve", "lsp"]
    assert server["config"] == kate["settings"] == {"contoursolve": {"format": {"blockNumbers": 0}}}
    assert "lsp" in commands().list_commands(Context(commands()))

    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    (endings,) = re.findall(r"\(([\w|]+)\)\$", hook["files"])
    told = {*endings.split("|")} - {"gcode"}
    assert {each.lower() for each in helix["language"][0]["file-types"]} == told
    (names,) = re.findall(r'\("([\w ]+)"\):gmatch', found["neovim"])
    assert {*names.split()} == told
    (pattern,) = re.findall(r"\*\.\{([\w,]+)\}", found["neovim-0.7"])
    assert {each.lower() for each in pattern.split(",")} == told
    assert {*re.findall(r"\w+(?=\\\\[|)])", found["emacs"])} == told
