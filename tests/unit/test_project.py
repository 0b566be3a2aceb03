"""What stands beside the package: the workflow, the hook of pre-commit and the citation agree with it."""

import re
import shutil
import subprocess
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
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = PYPROJECT["project"]
OF_USERS = PROJECT["optional-dependencies"].keys() - {"all", "test"}
PYTHONS = [each.split(" :: ")[-1] for each in PROJECT["classifiers"] if re.search(r":: 3\.\d+$", each)]


def read_yaml(name: str):
    return yaml.safe_load((ROOT / name).read_text(encoding="utf-8"))


def test_the_supported_pythons_are_the_same_everywhere():
    (first, last) = re.findall(r"python3\.\{(\d+)\.\.(\d+)\}", (ROOT / ".ci" / "run").read_text(encoding="utf-8"))[0]
    tried = [f"3.{minor}" for minor in range(int(first), int(last) + 1)]
    assert tried[: len(PYTHONS)] == PYTHONS  # newer ones are tried where they are, before the package claims them
    assert PROJECT["requires-python"] == f">={PYTHONS[0]}"
    assert read_yaml(".github/workflows/ci.yml")["jobs"]["tests"]["strategy"]["matrix"]["python"] == PYTHONS


def test_the_workflow_runs_ci_run_and_the_tests_of_the_readme_on_every_system():
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
    for path in (ROOT / ".github" / "workflows").iterdir():
        for job in read_yaml(path)["jobs"].values():
            for step in job["steps"]:
                allowed = r"actions/[\w-]+@v\d+|pypa/gh-action-pypi-publish@release/v1"
                assert re.fullmatch(allowed, step.get("uses", "actions/x@v1"))


def test_what_is_installed_by_name_is_an_extra_or_a_group():
    """The commands of the pages, the workflows and the scripts; the extras of users stand in one table."""
    extras, groups = PROJECT["optional-dependencies"], PYPROJECT["dependency-groups"]
    files = [*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob(".ci/*"), *ROOT.glob(".github/workflows/*")]
    told = "\n".join(path.read_text(encoding="utf-8") for path in files)
    assert {*re.findall(r"--group (\w+)", told)} <= groups.keys()
    named = {name for each in re.findall(r"(?:contoursolve|\")\.?\[([\w,]+)\]", told) for name in each.split(",")}
    assert {"picture", "test"} <= named <= extras.keys()
    assert extras["all"] == [f"contoursolve[{','.join(sorted(OF_USERS))}]"]
    page = (ROOT / "docs" / "index.md").read_text(encoding="utf-8").partition("\n## Extras\n")[2].partition("\n## ")[0]
    assert {*re.findall(r"^\| `(\w+)` \|", page, re.MULTILINE)} == OF_USERS | {"all"}


def test_the_recipe_for_conda_needs_what_the_package_needs():
    recipe = (ROOT / "conda" / "meta.yaml").read_text(encoding="utf-8")
    needed = re.findall(r"^    - (.*)$", recipe.partition("  run:\n")[2].partition("\ntest:")[0], re.MULTILINE)
    assert [each.replace(" ", "") for each in needed] == [
        f"python{PROJECT['requires-python']}",
        *PROJECT["dependencies"],
    ]
    text = (ROOT / "contoursolve" / "__init__.py").read_text(encoding="utf-8")
    assert re.search(re.search(r"regex_pattern='(.*?)'", recipe)[1], text)[1] == contoursolve.__version__
    entry = f"contoursolve = {PROJECT['scripts']['contoursolve']}"
    assert {entry, PROJECT["description"]} <= {
        line.strip().removeprefix("- ").removeprefix("summary: ") for line in recipe.splitlines()
    }


@pytest.mark.slow
@pytest.mark.needs("hatchling")
def test_on_an_index_every_link_of_the_readme_leads_to_a_file_of_the_repository(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    from hatch_build import PAGES, with_addresses  # noqa: PLC0415 - needs a package

    readme, address = (ROOT / "README.md").read_text(encoding="utf-8"), "https://code.example/a/b"
    found = re.findall(r"(!?)\[[^\]]*\]\(([^)\s]+)\)", with_addresses(readme, address, "v1"))
    assert len(found) == len(re.findall(r"\]\(", readme))
    assert {mark for mark, _ in found} == {"", "!"}
    for mark, target in found:
        place = target.removeprefix(f"{address}/{'raw' if mark else 'blob'}/v1/")
        assert (ROOT / place.partition("#")[0]).is_file(), target
    assert all((ROOT / file).is_file() for file in PAGES.values())


@pytest.mark.slow
def test_the_manual_page_is_made_of_the_help_and_goes_where_man_looks(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "docs" / "site"))
    from man_page import PAGE, man_page  # noqa: PLC0415 - lies beside the pages

    text = PAGE.read_text(encoding="utf-8")
    assert text == man_page(), "run: python docs/site/man_page.py"
    shared = PYPROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]["shared-data"]
    assert shared == {PAGE.relative_to(ROOT).as_posix(): "share/man/man1/contoursolve.1"}
    sections = re.findall(r"^\.SH (.*)$", text.replace("\\-", "-"), re.MULTILINE)
    assert sections[2:] == [name.upper() for name in commands().list_commands(Context(commands()))]
    if shutil.which("groff"):
        done = subprocess.run(["groff", "-man", "-ww", "-z", "-Tutf8", PAGE], capture_output=True, check=True)
        assert done.stderr == b""


def test_a_version_of_the_changes_is_short_and_each_line_leads_to_a_page():
    _, *versions = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8").split("\n## ")
    assert versions[0].startswith(contoursolve.__version__)
    for version in versions:
        assert 1 < len([line for line in version.splitlines() if line]) <= 20
        assert {*re.findall(r"^(\w+):$", version, re.MULTILINE)} <= {"Added", "Changed", "Mended", "Removed"}
        for entry in re.split(r"^\* ", version, flags=re.MULTILINE)[1:]:
            assert re.search(r"\]\([\w./#-]+\)", entry), entry


def test_the_hook_runs_a_command_that_exists_on_files_of_programs():
    (hook,) = read_yaml(".pre-commit-hooks.yaml")
    program, command = hook["entry"].split()
    assert program in PROJECT["scripts"].keys() & entry_points(group="console_scripts").names
    assert hook["language"] == "python"
    for name, status in (("shaft", 0), ("shaft_broken", 1)):
        path = ROOT / "notebooks" / "programs" / f"{name}.nc"
        assert CliRunner().invoke(commands(), [command, str(path)]).exit_code == status
    endings = re.findall(r"\w+", "nc NC cnc ngc tap mpf MPF spf min eia gcode")
    taken = [f"parts/shaft.{each}" for each in endings]
    left = ["README.md", "stdio.h", "nc", "shaft.nc.bak", "shaft.nc~"]
    assert [bool(re.search(hook["files"], name)) for name in (*taken, *left)] == [True] * len(taken) + [False] * len(
        left
    )
