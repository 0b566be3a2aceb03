"""Build the documentation site: `python docs/site/build.py` writes it to build/site/html, or to html in a named folder.

Its pages are README.md and the pages of docs/, the manual of each control, the reference of the public names, the
notebooks, and one that solves in the browser. All but the first are made here from tables, docstrings and notebooks.
Needs the packages of the group `docs`, and pip.

Set PYODIDE to the address of a folder with another copy of Pyodide's distribution, of the same version, to load Python
from there: for a site without other hosts.
"""

import json
import os
import re
import shutil
import subprocess
import sys
from base64 import b64decode
from collections.abc import Iterator
from html import escape
from os.path import relpath
from pathlib import Path
from types import ModuleType
from urllib.parse import urlsplit
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from manual import alarms_page, control_page, manuals, rule_page, setting_anchor, words_page, words_title

import contoursolve
from contoursolve import pictures
from contoursolve.controls import CONTROLS
from contoursolve.geometry import Unit

ROOT = Path(__file__).parents[2]
TRY = Path(__file__).with_name("try")
OUTPUT = Path(sys.argv[1] if sys.argv[1:] else ROOT / "build" / "site").resolve()
PAGES = OUTPUT / "pages"
SITE = OUTPUT / "html"

STAGED = {
    ROOT / "README.md": "overview.md",
    ROOT / "CONTRIBUTING.md": "contributing.md",
    ROOT / "CHANGELOG.md": "changes.md",
    TRY / "page.md": "try.md",
    **{path: path.name for kind in ("md", "schema.json") for path in sorted((ROOT / "docs").glob(f"*.{kind}"))},
    **{path: f"vectors/{path.name}" for path in sorted((ROOT / "docs" / "vectors").glob("*.*"))},
    **{path: f"notebooks/{path.stem}.md" for path in sorted((ROOT / "notebooks").glob("*.ipynb"))},
    **{path: f"pictures/{path.name}" for path in sorted((ROOT / "notebooks" / "pictures").iterdir())},
}
"""Where on the site each file of the repository stands."""

PYODIDE_VERSION = "314.0.7"
PYODIDE = os.environ.get("PYODIDE", f"https://cdn.jsdelivr.net/pyodide/v{PYODIDE_VERSION}/full/")
"""From where a reader's browser loads Python, when asked to."""

DISTRIBUTED, DISTRIBUTED_FOR_FEW = ("numpy", "casadi", "markupsafe"), ("sympy",)
"""Packages of Pyodide's distribution: what the first picture needs, and what few blocks need."""

WHEELS = ("python-flint==0.9.0", "msgspec==0.22.0", "htpy==26.5.1", "lark==1.3.1", "lazy-loader==0.6")
"""Packages that it has not, or not as new: the site has their wheels."""

WHEELS_FOR = ("--platform=pyemscripten_2026_0_wasm32", "--platform=any", "--python-version=3.14")
"""For which Python, that of this version of Pyodide."""


def main() -> None:
    """Write the pages, and have zensical make the site of them; a warning of it is an error."""
    for folder in (PAGES, SITE):
        shutil.rmtree(folder, ignore_errors=True)
    for source, name in STAGED.items():
        if source.suffix == ".md":
            write(name, with_links(source.read_text(encoding="utf-8"), source))
        elif source.suffix == ".ipynb":
            write(name, notebook_page(source))
        else:
            write(name, source.read_bytes())
    told = manuals()
    write("assets/pictures.css", Path(__file__).with_name("pictures.css").read_bytes())
    write("rules/index.md", "\n".join(rules_index()))
    write("rules/alarms.md", "\n".join(alarms_page(told)))
    for each in told:
        write(f"rules/{each.name}.md", "\n".join(control_page(each)))
        write(f"rules/{each.name}/words.md", "\n".join(words_page(each)))
        for rule in each.control.catalogue:
            write(f"rules/{each.place(rule.code)}", "\n".join(rule_page(each, rule)))
        for name, drawn in each.pictures.items():
            write(f"rules/pictures/{name}", drawn)
    write("reference.md", "\n".join(reference_page()))
    write("try.md", try_page())

    settings = OUTPUT / "zensical.toml"
    shutil.copy(Path(__file__).with_name("doctests.py"), OUTPUT)
    nav = Path(__file__).with_name(settings.name).read_text(encoding="utf-8")
    for each in told:
        words = f"{{ {json.dumps(words_title(each.control))} = 'rules/{each.name}/words.md' }}"
        page = f'"rules/{each.name}.md"'
        nav = nav.replace(f"{page},", f"{{ {json.dumps(each.control.title)} = [{page}, {words}] }},")
    settings.write_text(nav, encoding="utf-8")
    named = set(re.findall(r"""["']([\w/-]+\.md)["']""", settings.read_text(encoding="utf-8")))
    rules = {f"rules/{each.place(rule.code)}" for each in told for rule in each.control.catalogue}  # reached by links
    written = {path.relative_to(PAGES).as_posix() for path in PAGES.rglob("*.md")} - rules
    if named != written:
        sys.exit(f"docs/site/zensical.toml and the pages differ: {', '.join(sorted(named ^ written))}")
    command = [sys.executable, "-m", "zensical", "build", "--strict", "--config-file", settings.name]
    subprocess.run(command, cwd=OUTPUT, check=True)
    for page in SITE.rglob("*.html"):
        page.write_bytes(with_own_worker(page.read_bytes(), "../" * (len(page.relative_to(SITE).parts) - 1)))
    titles = {f"rules/{each.place(code)}": each.control.title for each in told for code in each.shown}
    for path in (SITE / "search.json", SITE / "search.js"):
        path.write_text(with_controls(path.read_text(encoding="utf-8"), titles), encoding="utf-8")
    shutil.copy(Path(__file__).with_name("worker.js"), SITE / "assets")
    write_try(SITE / "try")


def with_own_worker(page: bytes, up: str) -> bytes:
    """A page whose search in files needs no other host: zensical loads a script from one."""
    return re.sub(rb'"https://[^"]*/iframe-worker/shim"', f'"{up}assets/worker.js"'.encode(), page)


def with_controls(index: str, titles: dict[str, str]) -> str:
    """The index of the search with the control of each rule: what is in no menu has its own title there once more, and
    would be found before a word of that name. So would names of the reference without `contoursolve.`"""
    begin = index.index("{")
    found, end = json.JSONDecoder().raw_decode(index, begin)
    for item in found["items"]:
        title = titles.get(item["location"].partition("#")[0].replace(".html", ".md"))
        item["path"] = ["Manuals of the controls", title] if title else item["path"]
        page, _, name = item["location"].partition("#")
        item["title"] = name if page == "reference.html" and name.startswith("contoursolve.") else item["title"]
    return index[:begin] + json.dumps(found, separators=(",", ":")) + index[end:]


def write(name: str, content: str | bytes) -> None:
    """One file among the pages."""
    path = PAGES / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content.encode() if isinstance(content, str) else content)


def with_links(text: str, source: Path) -> str:
    """A page of the repository, with its links leading to where their targets stand on the site."""
    here = Path(STAGED[source]).parent

    def moved(link: re.Match[str]) -> str:
        name, hash_sign, anchor = (link[1] or "").partition("#")
        if "://" in name or not name:
            return link[0]  # code, another host, or a place on this page
        target = STAGED[(source.parent / name).resolve()]
        return f"]({Path(relpath(target, here)).as_posix()}{hash_sign}{anchor})"

    code = r"```(?s:.*?)```|`[^`\n]*`|^    .*$"
    return re.sub(rf"{code}|\]\(([^)\s]+)\)", moved, text, flags=re.MULTILINE)


# Notebooks ---------------------------------------------------------------------------------------------------


def notebook_page(path: Path) -> str:
    """A notebook as a page: its text, its code, and what it printed and drew when it was last executed."""
    lines: list[str] = []
    for number, cell in enumerate(json.loads(path.read_text(encoding="utf-8"))["cells"]):
        source = "".join(cell["source"])
        lines += [with_links(source, path), ""] if cell["cell_type"] == "markdown" else [*fenced(source, "python"), ""]
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            drawn, painted = ("".join(data.get(kind, "")) for kind in ("image/svg+xml", "image/png"))
            if painted:
                name = f"{path.stem}-{number}.png"
                write(f"notebooks/{name}", b64decode(painted))
                lines += [f"![What this code draws]({name})", ""]
            elif drawn:
                name = f"{path.stem}-{number}.svg"
                write(f"notebooks/{name}", drawn)
                title = re.search("<title[^>]*>(.*?)</title>", drawn)
                lines += [f"![{title[1] if title else path.stem}]({name})", ""]
            else:
                lines += [*fenced("".join(output.get("text", data.get("text/plain", ""))), "text"), ""]
    return "\n".join(lines)


def fenced(text: str, language: str) -> Iterator[str]:
    """A block of code."""
    yield f"````{language}"
    yield text.rstrip("\n")
    yield "````"


# Rules -------------------------------------------------------------------------------------------------------


def rules_index() -> Iterator[str]:
    """The page that leads to the manual of each control."""
    yield "# Manuals of the controls\n"
    yield "Each control has its words, its rules with wrong and right blocks, and its settings."
    yield "Your machine shows a number? Look it up in the [alarm numbers](alarms.md)."
    yield "\n## How to read these pages { #how-to-read }\n"
    yield "`<word>` in a rule stands for a word of your program, `<line>` and `<element>` for parts of its contour."
    yield "`<actual>`, `<limit>` and the like stand for numbers, which contoursolve fills in."
    yield "Each fact has a source, and the grade of the source:\n"
    yield "| grade | meaning |\n|---|---|"
    yield "| printed | read on a page of the control's manual |"
    yield "| derived | follows from printed facts by geometry or symmetry |"
    yield "| assumed | our choice where the pages that we have are silent |\n"
    yield "## The controls\n"
    yield "| control | words | rules | printed | derived | assumed |\n|---|---|--:|--:|--:|--:|"
    for control in CONTROLS.values():
        grades = [rule.source.evidence.value for rule in control.catalogue]
        counts = [len(grades), *map(grades.count, ("printed", "derived", "assumed"))]
        words = f"[words]({control.name}/words.md)"
        yield f"| [{control.title}]({control.name}.md) | {words} | {' | '.join(map(str, counts))} |"
    yield "\n`contoursolve rules` lists them in the terminal, `contoursolve explain CODE` prints one of them."
    yield from counted_from()


def counted_from() -> Iterator[str]:
    """What X is and from where angles count, of all controls."""
    yield "\n## Is X a diameter or a radius? From where does an angle count?\n"
    yield "| control | X | angle of a line | settings about it |\n|---|---|---|---|"
    for control in CONTROLS.values():
        rows = control.modes.lexicon.addresses
        angles = [
            f"`{row.address}`: {row.meaning}"
            for row in rows.values()
            if row.unit is Unit.DEGREE and re.search(r"\bof (the )?line\b|^travel direction", row.meaning)
        ]
        asked = [each for each in control.settings if re.search(r"\bX is\b|A counts|after ,A", each.meaning)]
        is_open = control.diameter is not None or any("X is" in each.meaning for each in asked)
        what = "a diameter" if rows["X"].is_diameter else "no diameter: a mill"
        what = "a diameter or a radius, as the program or a setting says" if is_open else what
        about = [f"[{each.name}]({control.name}.md#{setting_anchor(each)})" for each in asked]
        cells = (what, "<br>".join(angles), ", ".join(about))
        yield f"| [{control.title}]({control.name}/words.md) | {' | '.join(cells)} |"


# Reference ---------------------------------------------------------------------------------------------------


def reference_page() -> Iterator[str]:
    """The public names, whose docstrings mkdocstrings shows."""
    groups: dict[str, list[str]] = {"Functions": [], "Records": []}
    for name in contoursolve.__all__:
        each = getattr(contoursolve, name)
        if isinstance(each, ModuleType):
            continue
        groups["Records" if isinstance(each, type) else "Functions"].append(f"contoursolve.{name}")
    for title, door in (("Errors", "errors"), ("Editing", "editing"), ("Tables of a control", "tables")):
        groups[title] = [f"contoursolve.{door}.{name}" for name in getattr(contoursolve, door).__all__]
    drawn = (name for name in pictures.__all__ if name.startswith("draw") or name in ("Drawable", "Theme"))
    groups["Pictures"] = [f"contoursolve.pictures.{name}" for name in drawn]

    yield "# Reference\n"
    yield "The public names of `contoursolve`. [In Python](python.md) shows how they work together."
    for kind, names in groups.items():
        yield f"\n## {kind}\n"
        yield from (f"::: {name}\n" for name in names)


# The page that solves in the browser -------------------------------------------------------------------------


def try_page() -> str:
    """The page of the workbench, with what it shows before Python is there, and where Python comes from."""
    text = (TRY / "page.md").read_text(encoding="utf-8")
    controls = [{"name": name, "title": control.title} for name, control in CONTROLS.items()]
    hello = {
        "controls": controls,
        "examples": [{"control": each["name"], "title": each["title"]} for each in controls],
        "may_write": False,
    }
    host, packages = urlsplit(PYODIDE).netloc or "This site", [each.partition("==")[0] for each in WHEELS]
    for name, said in {
        "HELLO": escape(json.dumps(hello)),
        "HOST": f"`{host}`" if "." in host else host,
        "PYODIDE": f"Pyodide {PYODIDE_VERSION}",
        "WHEELS": f"{', '.join(packages[:-1])} and {packages[-1]}",
    }.items():
        text = re.sub(rf"\b{name}\b", said, text)
    return text


def write_try(folder: Path) -> None:
    """What the page loads from this site: the page of the workbench, this package, and wheels."""
    folder.mkdir()
    house = Path(contoursolve.__file__).parent
    bundle = house / "workbench" / "page"
    for path in (TRY / "worker.js", *(each for each in bundle.iterdir() if each.suffix != ".html")):
        shutil.copy(path, folder)
    with ZipFile(folder / "contoursolve.zip", "w", ZIP_DEFLATED) as archive:
        for path in sorted(house.rglob("*")):
            if path.is_file() and path.suffix != ".pyc" and path.parent != bundle:
                entry = ZipInfo(
                    path.relative_to(house.parent).as_posix()
                )  # of no date: the same files, the same archive
                entry.compress_type = ZIP_DEFLATED
                archive.writestr(entry, path.read_bytes())
    wheels = OUTPUT / "wheels"
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--only-binary=:all:", *WHEELS_FOR]
    subprocess.run([*command, f"--dest={wheels}", *WHEELS], check=True)
    names = [next(wheels.glob(f"{each.replace('-', '_').replace('==', '-')}-*.whl")).name for each in WHEELS]
    for name in names:
        shutil.copy(wheels / name, folder)
    sources = {
        "pyodide": PYODIDE,
        "packages": DISTRIBUTED,
        "archives": ["contoursolve.zip", *names],
        "later": DISTRIBUTED_FOR_FEW,
    }
    (folder / "sources.json").write_text(json.dumps(sources, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
