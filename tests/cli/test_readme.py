"""README.md and the pages in docs/: what their commands print, what their code does, and where their links lead.

A command stands in an indented block after `$`, and what it prints stands below. One line `...` there stands for any
lines. A block of code below `<!-- file: NAME -->` is a file that the commands of this page find in their folder. A
picture that a command writes is the one in `notebooks/pictures` if that has its name.
"""

import doctest
import re
import shlex
import shutil
from pathlib import Path

import pytest
from click import Context
from click.testing import CliRunner
from tip_numbers import tip_numbers

from contoursolve.__main__ import commands
from contoursolve.controls import CONTROLS, TOOL_FACTS
from contoursolve.tool_radius import ToolFaultKind

ROOT = Path(__file__).parents[2]
PICTURES = ROOT / "notebooks" / "pictures"
README = "README.md"
MOST_WORDS = 1_800
"""So many words has README.md at most; what is more belongs on a page of docs/."""

PAGES = {
    path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8")
    for path in [ROOT / README, *sorted((ROOT / "docs").glob("*.md"))]
}
SHOWN = [
    pytest.param(page, command, output, id=f"{page}-{number}")
    for page, text in PAGES.items()
    for number, (command, output) in enumerate(
        re.findall(r"^    \$ contoursolve (.*)\n((?:    .*\n|\n(?=    (?!\$)))*)", text, re.MULTILINE), 1
    )
]
CODE = [page for page, text in PAGES.items() if "```python\n" in text]


def test_every_command_on_the_pages_is_run_by_the_next_test() -> None:
    assert {each.values[0] for each in SHOWN} >= {README, "docs/machinists.md", "docs/programs.md"}
    for page, text in PAGES.items():
        indented = re.findall(r"```(?s:.*?)```|(^    (?:.*\$ )?contoursolve .*)", text, re.MULTILINE)
        assert sum(map(bool, indented)) == sum(each.values[0] == page for each in SHOWN), page


def enter(folder, monkeypatch, page) -> None:
    """A folder with the programs that a page names, in which nothing that it writes is left for others."""
    for name in ("programs", "conversions"):
        shutil.copytree(ROOT / "notebooks" / name, folder / "notebooks" / name)
    shutil.copytree(ROOT / "docs" / "programs", folder / "docs" / "programs")
    for name, content in re.findall(r"<!-- file: (\S+) -->\n+```\w*\n(.*?)```", PAGES[page], re.DOTALL):
        (folder / name).write_text(content, encoding="utf-8")
    monkeypatch.chdir(folder)


def compare(folder, monkeypatch, page, command, output) -> tuple[list[str], list[str]]:
    """The lines that a page shows for a command, and those that it prints in a folder, shortened alike."""
    enter(folder, monkeypatch, page)
    done = None
    for part in command.split(" | contoursolve "):
        done = CliRunner().invoke(commands(), shlex.split(part), input=done and done.stdout)
    shown = [line.removeprefix("    ") for line in output.rstrip().split("\n")]
    printed = done.output.rstrip().split("\n")
    if "..." in shown:
        place = shown.index("...")
        printed[place : len(printed) - len(shown[place + 1 :])] = ["..."]
    return shown, printed


@pytest.mark.parametrize(("page", "command", "output"), SHOWN)
def test_a_command_prints_what_the_page_shows(tmp_path, monkeypatch, page, command, output) -> None:
    shown, printed = compare(tmp_path, monkeypatch, page, command, output)
    assert shown == printed
    for picture in tmp_path.glob("*.svg"):
        if (PICTURES / picture.name).exists():
            assert picture.read_bytes() == (PICTURES / picture.name).read_bytes()


def test_every_picture_is_drawn_by_a_command_but_those_that_show_measurements() -> None:
    shown = {Path(link).name for text in PAGES.values() for link in links(text) if link.endswith(".svg")}
    drawn = {each.values[1].split()[-1] for each in SHOWN if each.values[1].endswith(".svg")}
    assert shown - drawn == {"family_growth.svg", "waiting_growth.svg", "tips.svg"}
    assert (PICTURES / "tips.svg").read_text(encoding="utf-8") == tip_numbers().svg + "\n"


def test_the_page_about_tools_has_every_alarm_and_every_finding_with_its_grade() -> None:
    (text,) = (text for page, text in PAGES.items() if page.endswith("tool.md"))
    rows = re.findall(r"^\| (`.*?) \| (.*) \|$", text.partition("## What your control does")[2], re.MULTILINE)
    shown = {name: row for names, row in rows for name in re.findall(r"`([\w-]+)`", names)}
    assert shown.keys() == CONTROLS.keys()
    kinds = ("arc_too_small", "element_vanishes", "no_intersection", "interference", "entry_by_arc", "exit_by_arc")
    for name, row in shown.items():
        alarms = TOOL_FACTS[name].alarms if name in TOOL_FACTS else {}
        told = [alarms.get(kind) for kind in (*kinds, "entry_too_short")]
        cells = [f"{each.number} ({each.evidence.value})" if each else "" for each in told]
        assert [cell.strip() for cell in row.split("|")] == cells, name
    assert {*re.findall(r"`(tool-[\w-]+)`", text)} == {kind.code for kind in ToolFaultKind} - {"tool-not-verified"}


@pytest.mark.parametrize("page", CODE)
def test_the_code_of_the_page_runs(tmp_path, monkeypatch, page) -> None:
    enter(tmp_path, monkeypatch, page)
    for code in re.findall(r"```python\n(.*?)```", PAGES[page], re.DOTALL):
        exec(compile(code, page, "exec"), {})


# --- the architecture page ------------------------------------------------------------------------------


def test_the_architecture_page_shows_what_each_stage_makes() -> None:
    page = ROOT / "docs" / "architecture.md"
    assert len(page.read_text(encoding="utf-8").splitlines()) <= 400
    failed, tried = doctest.testfile(str(page), module_relative=False)
    assert not failed
    assert tried >= 20


@pytest.mark.slow
def test_the_page_by_hand_shows_what_is_calculated() -> None:
    failed, tried = doctest.testfile(str(ROOT / "docs" / "by-hand.md"), module_relative=False)
    assert not failed
    assert tried >= 10


def test_each_diff_of_the_architecture_page_stands_in_the_file_that_it_names() -> None:
    (text,) = (text for page, text in PAGES.items() if page.endswith("architecture.md"))
    shown = re.findall(r"^\+\+\+ b/(.*)\n((?:[ +].*\n|\n)+?)(?=---|```)", text, re.MULTILINE)
    assert len(shown) == 7
    for name, added in shown:
        lines = iter((ROOT / name).read_text(encoding="utf-8").splitlines())
        for line in added.splitlines():
            assert line[1:] in lines, f"{name}: {line}"


def test_each_file_that_the_architecture_page_names_is_there() -> None:
    (text,) = (text for page, text in PAGES.items() if page.endswith("architecture.md"))
    for name in set(re.findall(r"`((?:\w+/)+\w+(?:\.pyi?)?)`", text)):
        assert (ROOT / name).exists() or (ROOT / "contoursolve" / name).exists(), name


# --- the README -----------------------------------------------------------------------------------------


def test_the_readme_is_short() -> None:
    assert len(PAGES[README].split()) <= MOST_WORDS


def test_the_line_for_windows_does_what_the_other_one_does() -> None:
    (elsewhere,) = re.findall(r"^<!-- main-job -->\n```sh\n(.*)\n```$", PAGES[README], re.MULTILINE)
    (windows,) = re.findall(r"^```powershell\n(.*)\n```$", PAGES[README], re.MULTILINE)
    meant = elsewhere.replace("python3", "py").replace(".venv/bin/", ".venv/Scripts/").replace("/", "\\")
    assert windows == meant.replace(" && ", "; ")  # PowerShell 5.1 does not know &&


def test_the_readme_has_every_command_in_its_table() -> None:
    named = re.findall(r"^\| `contoursolve (\w+)", PAGES[README], re.MULTILINE)
    assert sorted(named) == sorted(commands().list_commands(Context(commands())))


def test_the_table_of_settings_has_every_setting_of_every_control() -> None:
    _, _, own = PAGES["docs/machinists.md"].partition("\n## Settings of your control\n")
    rows = re.findall(r"^\| `(\S+)` \| ([^|]*) \| ([^|]*) \|$", own.partition("\n## ")[0], re.MULTILINE)
    _, _, tools = PAGES["docs/tool.md"].partition("\n## What you can choose\n")
    of_tools = re.findall(r"^\| `(\S+)` \| (`\S+?`)[^|]* \| (`\S+?`|)[^|]* \|$", tools, re.MULTILINE)
    rows[:0] = [(f"tool-{name}", "all", f"{default} {other}") for name, default, other in of_tools]
    shown = {}
    for name, own, values in rows:
        named = {*re.sub("^all( but )?", "", own).split(", ")} - {""}
        assert named <= CONTROLS.keys(), name
        for control in CONTROLS.keys() - named if own.startswith("all") else named:
            shown[name, control] = re.findall(r"`(\S+?)`", values)
    meant = {
        (each.name, name): [each.default, *(value for value in each.values if value != each.default)]
        for name, own in CONTROLS.items()
        for each in own.settings
    }
    assert shown == meant


# --- links ----------------------------------------------------------------------------------------------


def prose(text: str) -> str:
    """A page without its code."""
    return re.sub(r"```(?s:.*?)```|`[^`\n]*`|^    .*$", "", text, flags=re.MULTILINE)


def links(text: str) -> list[str]:
    """Where a page leads: the targets of its links and pictures, but those on the web."""
    return [each for each in re.findall(r"\]\(([^)\s]+)\)", prose(text)) if "://" not in each]


def anchors(text: str) -> list[str]:
    """The anchors that GitHub gives the headings of a page."""
    headings = re.findall(r"^#+ (.+)$", re.sub(r"```.*?```", "", text, flags=re.DOTALL), re.MULTILINE)
    return [re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings]


@pytest.mark.parametrize("page", [*PAGES, "CHANGELOG.md", "CONTRIBUTING.md"])
def test_every_link_leads_to_a_file_of_the_repository_and_to_a_heading_in_it(page) -> None:
    source = ROOT / page
    for link in links(source.read_text(encoding="utf-8")):
        name, _, anchor = link.partition("#")
        target = (source.parent / name).resolve() if name else source
        assert target.is_file(), link
        assert target.is_relative_to(ROOT), link
        assert not anchor or anchor in anchors(target.read_text(encoding="utf-8")), link


def test_no_two_headings_of_a_page_have_one_anchor() -> None:
    for page, text in PAGES.items():
        found = anchors(text)
        assert len(found) == len(set(found)), page


def test_the_first_page_and_the_readme_lead_to_every_page() -> None:
    others = {page for page in PAGES if page != README}
    assert {f"docs/{link}" for link in links(PAGES["docs/index.md"])} >= others - {"docs/index.md"}
    assert set(links(PAGES[README])) >= others
