"""What every command printed and wrote, as text: one file a record, in the folder of its command.

    python tests/golden/record.py --changed                    # runs all records, and writes those that differ
    python tests/golden/record.py --add NAME [FILE...] -- check part.nc --control isg

A record begins with its command. Then follows what the command reads, and what came of it. `--add` copies each FILE
beside the command. NAME ends with the control, as in `corner-too-large.yasnac-lx3`.

A part is shown as it was, line by line. In an "escaped" part a backslash leads what cannot be seen: `\\r`, `\\x1b`,
`\\u2028`, `\\udcff` for a byte that is no UTF-8, `\\=` for an `=` that begins a line, `\\\\` for itself. A backslash
at the end of a line means that the line goes on. An "unended" part has no newline at its end.
"""

import argparse
import gzip
import hashlib
import json
import os
import re
import shlex
import sys
from dataclasses import dataclass, field
from pathlib import Path
from tempfile import TemporaryDirectory

from click.testing import CliRunner

FOLDER = Path(__file__).parent
PROGRAM = "$ contoursolve "
BEFORE = "before.txt"
"""Holds what a run before a case printed."""

CODING = ("utf-8", "surrogateescape")
LONG = 240
"""A line with more characters goes on in the next line."""


@dataclass(frozen=True, slots=True)
class Case:
    """One run of the command: its arguments, what it reads, and the files beside it. `before` are runs that make files
    for it; what the last one prints is a file, too."""

    arguments: tuple[str, ...]
    stdin: str = ""
    files: dict[str, str] = field(default_factory=dict)
    before: tuple[tuple[str, ...], ...] = ()


Parts = dict[str, str]  # the texts that came of a case, by the heads of their parts


_WRITTEN = 1_767_355_200
"""2026-01-02: the date of each file, seconds."""


def run(case: Case, folder: Path) -> Parts:
    """Exit status, standard output and error, and every file that was written."""
    from contoursolve.__main__ import commands  # noqa: PLC0415 - tests import this module before they choose a package

    for name, text in case.files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(text.encode(*CODING))
        os.utime(folder / name, (_WRITTEN, _WRITTEN))
    runner, here = CliRunner(env={"COLUMNS": "100", "NO_COLOR": "1"}), Path.cwd()
    os.chdir(folder)
    try:
        for arguments in case.before:
            (folder / BEFORE).write_bytes(runner.invoke(commands(), list(arguments)).stdout_bytes)
        old = contents(folder)
        done = runner.invoke(commands(), list(case.arguments), input=case.stdin.encode(*CODING) or None)
    finally:
        os.chdir(here)
    assert done.exception is None or isinstance(done.exception, SystemExit), (case, done.exception)
    told = {"stdout": done.stdout_bytes.decode(*CODING), "stderr": done.stderr_bytes.decode(*CODING)}
    new = {path: content for path, content in contents(folder).items() if old.get(path) != content}
    made = {f"written {path.relative_to(folder).as_posix()}": shown(path, new[path]) for path in sorted(new)}
    parts = {name: shortened(text).replace(str(folder), "{folder}") for name, text in told.items() if text}
    return {f"status {done.exit_code}": "", **parts, **made}


def contents(folder: Path) -> dict[Path, bytes]:
    """The files of a folder."""
    files = (path for path in folder.rglob("*") if path.is_file())
    # What Python keeps of a control of one's own is no work of the command.
    return {path: path.read_bytes() for path in files if path.parent.name != "__pycache__"}


def shown(path: Path, content: bytes) -> str:
    """A file as text: a table by its columns, a picture by its kind, all else without time and version."""
    match path.suffix:
        case ".parquet":
            from pyarrow import parquet  # noqa: PLC0415 - only here

            table = parquet.read_table(path)
            return json.dumps({name: table[name].to_pylist() for name in table.column_names}, default=repr)
        case ".png":
            return f"{len(content) > 0} {content[:4]!r}"
        case ".gz":
            content = gzip.decompress(content)
    text = re.sub(r"\bcontoursolve \d+\.\d+\.\d+", "contoursolve {version}", shortened(content.decode(*CODING)))
    return re.sub(r"\d{4}-\d\d-\d\dT[\d:.+]+", "TIME", text)


def shortened(text: str) -> str:
    """A document with the size and the digest of what is the same in each: style sheets, scripts, all rules."""

    def short(found: re.Match[str]) -> str:
        known = hashlib.sha256(found[2].encode(*CODING)).hexdigest()[:16]
        return f"{found[1]}{{{len(found[2]):,} characters, SHA-256 {known}}}{found[3]}"

    styles, rules = r"(?s)(<(?:style|script)\b[^>]*>)(.{200,}?)(</)", r'(?s)("rules": \[\n)(.{200,}?)(\n {5}\])'
    return re.sub(rules, short, re.sub(styles, short, text))


UNSEEN = re.compile(
    r"^=|[\\\x00-\x09\x0b-\x1f\x7f-\xa0\xad\u200b-\u200f\u2028-\u202e\ud800-\udfff\ufeff]", re.MULTILINE
)
ESCAPED = re.compile(r"\\(\n|\\|=|r|t|x[0-9a-f]{2}|u[0-9a-f]{4})")
SIGNS = {"\r": "\\r", "\t": "\\t", "\\": "\\\\", "=": "\\="}


def escaped(text: str) -> str:
    """A text in which everything can be seen, with short lines."""

    def sign(found: re.Match[str]) -> str:
        code = ord(found[0])
        return SIGNS.get(found[0]) or (f"\\x{code:02x}" if code < 256 else f"\\u{code:04x}")

    def broken(line: str) -> str:
        tags = re.split(r"(?<=>)(?=<[^/])", line) if len(line) > LONG else [line]
        pieces = (piece for tag in tags for piece in re.findall(rf".{{1,{LONG}}}(?<=[ >,;])|.{{1,{LONG}}}|^$", tag))
        return "\\\n".join(re.sub(UNSEEN, sign, piece) for piece in pieces)

    return "\n".join(map(broken, text.split("\n")))


def unescaped(text: str) -> str:
    """What `escaped` was given."""
    others = {shown[1]: sign for sign, shown in SIGNS.items()} | {"\n": ""}
    return ESCAPED.sub(lambda found: others[found[1]] if found[1] in others else chr(int(found[1][1:], 16)), text)


def part(head: str, text: str) -> str:
    """A part of a record."""
    is_odd = UNSEEN.search(text) or max(map(len, text.split("\n"))) > LONG
    is_ended = not text or text.endswith("\n")
    marks = ", ".join(["escaped"] * bool(is_odd) + ["unended"] * (not is_ended))
    return f"=== {head}{marks and f' ({marks})'}\n{escaped(text) if is_odd else text}{'' if is_ended else chr(10)}"


def written(case: Case, parts: Parts) -> str:
    """The text of a record."""
    reads = {f"before {shlex.join(each)}": "" for each in case.before}
    reads |= {"stdin": case.stdin} if case.stdin else {}
    reads |= {f"file {name}": text for name, text in case.files.items()}
    text = PROGRAM + shlex.join(case.arguments) + "\n" + "".join(part(*each) for each in (reads | parts).items())
    assert read(text) == (case, parts), case
    return text


def read(text: str) -> tuple[Case, Parts]:
    """The case that a record holds, and what came of it."""
    first, *found = re.split(r"^=== (.*?)(?: \(([a-z, ]+)\))?\n", text, flags=re.MULTILINE)
    texts = Parts()
    for head, marks, shown in zip(found[::3], found[1::3], found[2::3], strict=True):
        body = shown[:-1] if "unended" in (marks or "") else shown
        texts[head] = unescaped(body) if "escaped" in (marks or "") else body
    names = [*texts]
    at = next((at for at, name in enumerate(names) if name.startswith("status ")), len(names))
    arguments, reads = tuple(shlex.split(first.removeprefix(PROGRAM))), {name: texts[name] for name in names[:at]}
    files = {name.removeprefix("file "): text for name, text in reads.items() if name.startswith("file ")}
    before = tuple(tuple(shlex.split(name)[1:]) for name in reads if name.startswith("before "))
    return Case(arguments, reads.get("stdin", ""), files, before), {name: texts[name] for name in names[at:]}


def paths() -> list[Path]:
    """All records."""
    return sorted(FOLDER.glob("*/*.txt"))


def path_of(case: Case, name: str) -> Path:
    """Where a record stands: in the folder of its command."""
    command = next((each for each in case.arguments if not each.startswith("-")), "contoursolve")
    return FOLDER / command / f"{name}.txt"


def stored(path: Path) -> str:
    return path.read_bytes().decode("utf-8")


def made(case: Case) -> str:
    """The record of a case, by a run."""
    with TemporaryDirectory() as folder:
        return written(case, run(case, Path(folder)))


def keep(path: Path, case: Case) -> None:
    """Write the record of a case if it differs from what stands there, and say so."""
    text = made(case)
    if not path.exists() or stored(path) != text:
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(text.encode())
        sys.stdout.write(f"{path.relative_to(FOLDER).as_posix()}\n")


def main() -> None:
    at = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--changed", action="store_true", help="run all records, and write those that differ")
    parser.add_argument("--add", metavar="NAME", help="add the record of the command behind --")
    parser.add_argument("--stdin", type=Path, metavar="FILE", help="its standard input")
    parser.add_argument("--before", action="append", default=[], metavar="COMMAND", help="a run before it")
    parser.add_argument("files", nargs="*", type=Path, metavar="FILE", help="files that it reads")
    told = parser.parse_args(sys.argv[1:at])
    if told.add:
        stdin, *files = (each.read_bytes().decode(*CODING) if each else "" for each in (told.stdin, *told.files))
        names = [path.name for path in told.files]
        before = tuple(tuple(shlex.split(each)) for each in told.before)
        case = Case(tuple(sys.argv[at + 1 :]), stdin, dict(zip(names, files, strict=True)), before)
        keep(path_of(case, told.add), case)
    for path in paths() if told.changed else []:
        keep(path, read(stored(path))[0])


if __name__ == "__main__":
    main()
