"""What every command printed and wrote when these records were made: `python tests/golden/record.py` makes them anew.

A record holds all that a run needs (arguments, standard input, files), so that nothing else has to stay as it is, and
all that came of it. A change of a byte is a change for users: make the records anew only for one that is meant.
"""

import gzip
import io
import json
import lzma
import os
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import cycle
from pathlib import Path
from random import Random

from click.testing import CliRunner

FOLDER = Path(__file__).parent
ROOT = FOLDER.parent.parent
GROUPS = ("catalogue", "rules", "repository", "generated", "families")
BEFORE = "before.txt"
"""Holds what a run before a case printed."""

STARTED = "{folder}"
"""Stands for the folder in which a case ran."""


@dataclass(frozen=True, slots=True)
class Case:
    """One run of the command: its arguments, what it reads, and the files beside it. `before` are runs that make files
    for it; what the last one prints is a file, too."""

    arguments: tuple[str, ...]
    stdin: str = ""
    files: dict[str, str] = field(default_factory=dict)
    before: tuple[tuple[str, ...], ...] = ()


# What came of it ---------------------------------------------------------------------------------------------


def run(case: Case, folder: Path) -> dict[str, object]:
    """Exit status, standard output and error, and every file that was written, as text."""
    from contoursolve.__main__ import commands  # noqa: PLC0415 - tests import this module before they choose a package

    for name, text in case.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8", newline="")
    here, old = Path.cwd(), {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    runner = CliRunner(env={"COLUMNS": "100", "NO_COLOR": "1"})
    os.chdir(folder)
    try:
        for arguments in case.before:
            (folder / BEFORE).write_text(runner.invoke(commands(), list(arguments)).stdout, encoding="utf-8")
        old |= {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} if case.before else {}
        done = runner.invoke(commands(), list(case.arguments), input=case.stdin or None)
    finally:
        os.chdir(here)
    assert done.exception is None or isinstance(done.exception, SystemExit), (case, done.exception)
    new = {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
    written = {
        path.relative_to(folder).as_posix(): shown(path, content)
        for path, content in new.items()
        if old.get(path) != content
    }
    texts = {"stdout": done.stdout, "stderr": done.stderr}
    result = {name: text.replace(str(folder), STARTED) for name, text in texts.items()}
    return {"status": done.exit_code, **result, "written": written}


def shown(path: Path, content: bytes) -> str:
    """A file as text: a table by its columns, a picture by its size, a document without the time of its making."""
    match path.suffix:
        case ".parquet":
            from pyarrow import parquet  # noqa: PLC0415 - only here

            table = parquet.read_table(path)
            return json.dumps({name: table[name].to_pylist() for name in table.column_names}, default=repr)
        case ".png":
            return f"{len(content) > 0} {content[:4]!r}"
        case ".gz":
            content = gzip.decompress(content)
    return re.sub(r"\d{4}-\d\d-\d\dT[\d:.+]+", "TIME", content.decode("utf-8", "surrogateescape"))


# The cases ---------------------------------------------------------------------------------------------------


def catalogue() -> Iterator[Case]:
    """What is told about the controls, whatever the program."""
    from contoursolve.controls import DIALECTS  # noqa: PLC0415 - only when records are made

    commands = (
        "check solve expand filter convert diff plot report sweep range find sensitivity verify rules explain facts"
    )
    yield Case(("--help",))
    for command in (*commands.split(), "explain", "facts"):
        yield Case((command, "--help"))
        yield Case((command, "--nonsense"))
    yield Case(("facts",))
    yield Case(("rules",))
    for control, dialect in DIALECTS.items():
        yield Case(("rules", "--control", control))
        yield Case(("rules", "--control", control, "--table"))
        for rule in filter(lambda rule: is_recorded(rule.code, control), dialect.rules):
            yield Case(("explain", rule.code, "--control", control))
    for alarm in ("145", "146", "3010", "3011", "999"):
        yield Case(("explain", alarm))


FIRST = ("yasnac-lx3", "nct-99m")
"""The controls with which the rows are run that controls share."""


def is_recorded(code: str, control: str) -> bool:
    """Whether a rule is run with a control: a shared row only with the first ones."""
    return control in FIRST or code.startswith(control.partition("-")[0])


def rules() -> Iterator[Case]:
    """The examples of every rule."""
    from contoursolve.controls import DIALECTS  # noqa: PLC0415 - only when records are made

    files = {"contoursolve.toml": ""}
    forms = cycle([("check",), ("solve",), ("solve", "--format", "json"), ("check", "--format", "github")])
    others = cycle([("check", "--rules", "off"), ("check", "--rules", "warn"), ("check", "--format", "sarif")])
    for control, dialect in DIALECTS.items():
        is_first = control in FIRST
        for rule in filter(lambda rule: is_recorded(rule.code, control), dialect.rules):
            for example in (*rule.told.rejected, *rule.told.accepted):
                for form in (next(forms), next(others)) if is_first else (next(forms),):
                    yield Case((*form, "-", "--control", control), example, files)


def repository() -> Iterator[Case]:
    """Every command, format and option on the programs that stand in the repository."""
    folder = ROOT / "notebooks" / "programs"
    programs = {path.name: path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.nc"))}
    for name, text in programs.items():
        yield from (Case(arguments, files={name: text}) for arguments in on_a_program(name))
        yield Case(("verify", name, BEFORE), files={name: text}, before=(("solve", name, "--format", "json"),))
    pairs = [("shaft.nc", "shaft_broken.nc"), ("shaft.nc", "shaft.nc"), ("plate.nc", "cover.nc")]
    for old, new in pairs:
        for more in ((), ("--format", "json"), ("--tolerance", "5"), ("--new-control", "linuxcnc")):
            yield Case(("diff", old, new, *more), files={old: programs[old], new: programs[new]})
    for name in ("shaft.nc", "roller.nc", "plate.nc", "cover.nc"):
        for to in ("fanuc-lathe", "haas-lathe", "fanuc-mill", "nct-99m"):
            yield Case(("convert", name, "--to", to, "-o", "new.nc"), files={name: programs[name]})
    others = {path.name: path.read_text(encoding="utf-8") for path in sorted((ROOT / "docs" / "programs").glob("*.nc"))}
    for name, control in {"stud.nc": "fanuc-lathe", "plate.nc": "fanuc-mill"}.items():
        for arguments in on_a_program(name):
            yield Case((*arguments, "--control", control), files={name: others[name]})
    yield Case(("check", *programs), files=programs)
    yield Case(("check", *programs, "missing.nc", "--format", "json"), files=programs)


def on_a_program(name: str) -> Iterator[tuple[str, ...]]:
    """Arguments for one program, every option of every command at least once."""
    for form in ("text", "json"):
        yield ("solve", name, "--format", form)
        for level in ("off", "warn"):
            yield ("solve", name, "--format", form, "--rules", level)
    yield ("solve", name, "--explain")
    yield ("solve", name, "--units", "inch")
    for form in ("text", "json", "sarif", "github"):
        yield ("check", name, "--format", form)
        yield ("check", name, "--format", form, "--rules", "off", "--fail-on", "warning")
    yield ("check", name, "--set", "nct-99m.radius-difference=0.002", "--set", "yasnac-lx3.bevel=setback")
    for post in ("same", "linuxcnc", "fanuc"):
        for arcs in ("center", "radius"):
            yield ("expand", name, "--post", post, "--arcs", arcs, "--keep-going", "--keep-untranslated")
        yield ("expand", name, "--post", post, "-o", "new.nc", "--no-comments", "--block-numbers", "all")
    yield ("expand", name, "--decimals", "2")
    yield ("expand", name, "--in-place", "--keep-going")
    yield ("filter", name)
    yield ("filter", name, "--decimals", "2", "--no-comments")
    for kind in ("svg", "png", "dxf"):
        yield ("plot", name, "-o", f"out.{kind}")
        yield ("plot", name, "--each", "-o", f"out.{kind}")
    for theme in ("light", "dark", "page"):
        yield ("plot", name, "--theme", theme)
    yield ("report", name)
    yield ("report", name, "--rules", "off", "-o", "page.html")


SEEN = (
    ("solve", "-", "--explain"),
    ("check", "-", "--format", "sarif"),
    ("expand", "-", "--keep-going"),
    ("plot", "program.nc", "-o", "out.svg"),
    ("solve", "-", "--rules", "off"),
    ("check", "-", "--format", "github"),
    ("expand", "program.nc", "--post", "fanuc", "--arcs", "radius", "--keep-going", "--keep-untranslated"),
    ("report", "program.nc"),
    ("plot", "program.nc", "-o", "out.dxf"),
    ("solve", "-", "--units", "inch", "--format", "json"),
)
"""What is run on generated programs in turn, besides `solve` as text and as JSON and `verify`."""


def generated() -> Iterator[Case]:
    """Programs of every form: sound, with a slip of typing, and spoilt."""
    sys.path.insert(0, str(ROOT / "tests" / "support"))
    import generate_slips  # noqa: PLC0415 - only when records are made
    import generate_typing  # noqa: PLC0415

    rng, programs = Random(2026), []
    for number in range(216):
        sound = generate_typing.random_sound(rng, generate_typing.FORMS[number % len(generate_typing.FORMS)])
        slip = generate_typing.random_slip(sound, rng) if number % 3 else None
        programs.append(((slip or sound).text() if slip is None else slip.text, sound.control))
    spoilt = [form(rng) for _ in range(17) for form in generate_slips.FORMS.values()]
    programs += [(each.text, each.control) for each in spoilt]
    for number, (program, control) in enumerate(programs):
        files, told = {"program.nc": program + "\n"}, ("--control", control)
        yield Case(("solve", "-", *told), program)
        yield Case(("solve", "-", "--format", "json", *told), program)
        form = SEEN[number % len(SEEN)]
        yield Case((*form, *told), program if "-" in form else "", {} if "-" in form else files)
        if number % 4 == 0:
            made = ("expand", "program.nc", "-o", "new.nc", "--keep-going", *told)
            yield Case(("diff", "program.nc", "new.nc", *told), files=files, before=(made,))


G111, PAIR = "G111 X100. A180. K-30. B120. P5. Q5.", ("G3 X-50 Y0 R50", "G1 X-50 Y42.857 ,A171.87 Q-1")
BLOCKS = {
    "taper": ("--block", G111, "--start", "X40. Z0."),
    "pair": ("--block", PAIR[0], "--block", PAIR[1], "--start", "G17 G90 G41 X50 Y0", "--control", "nct-99m"),
    "asked": ("--block", "G111 X100. A180. K? B120. P5.", "--start", "X40. Z0.", "--fact", "length of line 1 = 30"),
    "turning": ("--block", "G112 X80. Z-60. I5. K-20. R30.", "--start", "X40. Z0."),
}


def families() -> Iterator[Case]:
    """Blocks with many values of their words."""
    for form in ("text", "json"):
        told = ("--format", form)
        for block in BLOCKS.values():
            yield Case(("solve", *block, *told))
        taper, pair, asked = BLOCKS["taper"], BLOCKS["pair"], BLOCKS["asked"]
        yield Case(("sweep", *taper, "--vary", "A=170:190:1", "--vary", "P=1:60:5", "--quiet", *told))
        yield Case(("sweep", *taper, "--vary", "P=60:80:5", "--quiet", *told))
        yield Case(("sweep", *taper, "--vary", "A=170:190:1", "--vary", "K=-50:-30:1", "--paired", "--quiet", *told))
        yield Case(("sweep", *taper, "--vary", "start.X=30:50:5", "-o", "rows.csv", "--quiet", *told))
        yield Case(("sweep", *taper, "--vary", "K=-40:-20:1", "-o", "rows.parquet", "--workers", "2", "--quiet", *told))
        yield Case(("sweep", *taper, "--vary", "K=-40:-20:2", "--plot", "rows.svg", "--quiet", *told))
        yield Case(("sweep", *pair, "--vary", "R=50:60:1", "--quiet", *told))
        yield Case(("sweep", *asked, "--vary", "X=90:110:5", "--quiet", *told))
        for word in ("A", "K", "B", "X", "P", "Q", "start.X"):
            yield Case(("range", *taper, "--word", word, *told))
        for word in ("R", "2:X", ",A"):
            yield Case(("range", *pair, "--word", word, *told))
        yield Case(("range", *taper, "--word", "P", "--word", "K", *told))
        yield Case(("range", *taper, "--word", "P", "--within", "0:20", *told))
        yield Case(("range", *asked, "--word", "X", *told))
        for word, goal in (
            ("K", "end Z-54."),
            ("A", "V1 X50."),
            ("B", "end Z-60."),
            ("P", "end Z-60."),
            ("X", "V2 Z-65."),
        ):
            yield Case(("find", *taper, "--word", word, "--bring", goal, *told))
        yield Case(("find", *pair, "--word", "R", "--bring", "end X-51.", *told))
        for point in ("end", "V1", "corner 1.center"):
            yield Case(("sensitivity", *taper, "--point", point, *told))
        yield Case(("sensitivity", *taper, "--point", "end", "--tolerance", "A=0.1", "--tolerance", "K=0.05", *told))
        yield Case(("sensitivity", *pair, "--point", "end", "--tolerance", "R=0.02", *told))
    for name, block in BLOCKS.items():
        yield Case(("plot", *block, "-o", f"{name}.svg"))
        yield Case(("report", *block, "-o", f"{name}.html"))
        yield Case(("expand", *block))


# Records -----------------------------------------------------------------------------------------------------


def archive(group: str) -> Path:
    return FOLDER / f"{group}.jsonl.xz"


def load(group: str) -> list[tuple[Case, dict[str, object]]]:
    """The cases of a group, each with what came of it when the records were made."""
    with lzma.open(archive(group), "rt", encoding="utf-8") as file:
        rows = [json.loads(line) for line in file]
    return [(_case(row["case"]), row["result"]) for row in rows]


def _case(row: dict[str, object]) -> Case:
    before = tuple(map(tuple, row["before"]))
    return Case(tuple(row["arguments"]), row["stdin"], row["files"], before)


def record(group: str, cases: list[Case]) -> None:
    """Run the cases of a group and keep what came of them."""
    from tempfile import TemporaryDirectory  # noqa: PLC0415

    lines = io.StringIO()
    for case in cases:
        with TemporaryDirectory() as folder:
            result = run(case, Path(folder))
        row = {"arguments": case.arguments, "stdin": case.stdin, "files": case.files, "before": case.before}
        lines.write(json.dumps({"case": row, "result": result}, ensure_ascii=True) + "\n")
    archive(group).write_bytes(lzma.compress(lines.getvalue().encode(), preset=9 | lzma.PRESET_EXTREME))


if __name__ == "__main__":
    for each in sys.argv[1:] or GROUPS:
        found = list(globals()[each]())
        record(each, found)
        sys.stdout.write(f"{each}: {len(found)} cases, {archive(each).stat().st_size:,} bytes\n")
