"""What stands beside the package: the workflow, the hook of pre-commit and the citation agree with it."""

import re
import tomllib
from importlib.metadata import entry_points
from pathlib import Path

import pytest
import yaml
from click import Context
from click.testing import CliRunner

import contoursolve
from contoursolve.cli import main

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
    for job in jobs.values():
        for step in job["steps"]:
            assert re.fullmatch(r"actions/[\w-]+@v\d+", step.get("uses", "actions/x@v1"))


def test_the_citation_is_of_this_version() -> None:
    citation = read_yaml("CITATION.cff")
    assert citation["version"] == PROJECT["version"] == contoursolve.__version__
    assert citation["title"] == PROJECT["name"]
    assert citation["license"] == PROJECT["license"]
    assert [each["name"] for each in citation["authors"]] == [each["name"] for each in PROJECT["authors"]]
    assert {"cff-version", "message"} <= set(citation)


def test_the_hook_runs_a_command_that_exists() -> None:
    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    program, command = hook["entry"].split()
    assert program in entry_points(group="console_scripts").names
    assert program in PROJECT["scripts"]
    assert command in main.list_commands(Context(main))
    assert hook["language"] == "python"


@pytest.mark.parametrize(("name", "status"), [("shaft", 0), ("shaft_broken", 1)])
def test_the_hook_takes_programs_and_fails_on_a_faulty_one(name, status) -> None:
    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    program = ROOT / "notebooks" / "programs" / f"{name}.nc"
    assert re.search(hook["files"], program.name)
    assert CliRunner().invoke(main, [hook["entry"].split()[1], str(program)]).exit_code == status


@pytest.mark.parametrize("ending", ["nc", "NC", "cnc", "ngc", "tap", "mpf", "MPF", "spf", "min", "eia", "gcode"])
def test_the_hook_takes_files_by_their_ending(ending) -> None:
    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    assert re.search(hook["files"], f"parts/shaft.{ending}")


@pytest.mark.parametrize("name", ["README.md", "stdio.h", "nc", "shaft.nc.bak", "shaft.nc~"])
def test_the_hook_leaves_other_files(name) -> None:
    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    assert not re.search(hook["files"], name)
