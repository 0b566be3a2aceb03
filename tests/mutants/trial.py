"""Runs the tests that reach a fault, nearest first, and tells which one notices it."""

import compileall
import os
import re
import shutil
import signal
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import closing
from dataclasses import dataclass
from functools import lru_cache
from itertools import count
from pathlib import Path
from sqlite3 import connect

from tests.mutants.faults import PACKAGE, Fault

ROOT = Path(__file__).parents[2]
KEPT = ROOT / "build" / "mutants"
"""Where the reached lines are kept, and copies of the package that have a fault."""

SLOW = "slow or interpreter or browser or notebook or editor"
"""The cases that are tried last: those that the README's command leaves out."""

_TIMES = count(1)
"""Times of change, in seconds: no two of a file are the same, so that no compiled file stands for another."""

ENDLESS = 900
"""Seconds that the quick cases have. What takes longer never ends: whoever runs them notices."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What became of a fault."""

    by: str
    """`quick`, `slow`, or nothing."""
    case: str
    """The case that noticed it, or what else happened."""
    cases: int
    """How many cases reach the line."""


def measure(jobs: int) -> None:
    """Run all cases and keep which lines each reaches. It takes about an hour on two cores."""
    shutil.rmtree(KEPT, ignore_errors=True)
    KEPT.mkdir(parents=True)
    paths = f"{ROOT}{os.pathsep}{os.environ.get('PYTHONPATH', '')}"
    run = [sys.executable, "-m", "pytest", "-q", "-n", str(jobs), "-p", "tests.mutants.plugin", "-p", "no:randomly"]
    for marks in ([], ["-m", SLOW, "--dist", "worksteal"]):
        subprocess.run(
            [*run, *marks], cwd=ROOT, env=os.environ | {"REACH": str(KEPT), "PYTHONPATH": paths}, check=False
        )
    subprocess.run(
        [sys.executable, "-m", "coverage", "combine", f"--rcfile={KEPT / 'coverage.ini'}"], cwd=KEPT, check=True
    )


_ROWS = """
    select context.context, file.path, numbits from line_bits
    join context on context.id = context_id join file on file.id = file_id
"""
"""What coverage.py keeps, by cases and files: with its own methods the same takes minutes."""


def _rows(more: str = "", *values: str) -> Iterator[tuple[str, str, bytes]]:
    if not (KEPT / "reached").exists():
        raise SystemExit("no lines are known that the tests reach: python -m tests.mutants --measure finds them")
    with closing(connect(KEPT / "reached")) as database:
        yield from database.execute(_ROWS + more, values)


@lru_cache(maxsize=1)
def _breadth() -> Counter[str]:
    """How many lines of the package each case reaches: the fewer, the nearer it is to each of them."""
    lines: Counter[str] = Counter()
    for case, _, bits in _rows():
        lines[case] += int.from_bytes(bits).bit_count()
    return lines


@lru_cache(maxsize=8)
def _cases_of(file: str) -> list[tuple[str, frozenset[int]]]:
    """The cases that reach a file, nearest first, each with its lines."""
    from coverage.numbits import numbits_to_nums  # noqa: PLC0415 - the tests of faults do without it

    rows = _rows("where replace(file.path, '\\', '/') like ?", f"%{file}")
    found = [(case, frozenset(numbits_to_nums(bits))) for case, _, bits in rows if case]
    return sorted(found, key=lambda each: (_breadth()[each[0]], each[0]))


def reaching(fault: Fault) -> tuple[list[str], list[str]]:
    """The cases that reach the line of a fault, and those that reach its file alone, both nearest first.

    What is kept in a cache is reached by the first case that asks; what runs at import, by none in particular. What a
    server reaches that is stopped is not told: the cases of its room stand for it.
    """
    lines = range(fault.line, fault.line + fault.old.count("\n") + 1)
    near = [case for case, reached in _cases_of(fault.file) if not reached.isdisjoint(lines)]
    known = set(near)
    far = [case for case, _ in _cases_of(fault.file) if case not in known]
    return near, far or [case for case in _breadth() if not near and f"/test_{fault.room}." in case]


def copy_tree(number: int) -> Path:
    """A copy of what the tests need, in which faults are put one at a time."""
    folder = KEPT / f"copy{number}"
    shutil.rmtree(folder, ignore_errors=True)
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    compileall.compile_dir(folder / PACKAGE, quiet=2)
    return folder


def judge(fault: Fault, folder: Path, patience: int) -> Verdict:
    """Put a fault into a copy, run what reaches it, quick cases first, and take it out again.

    Args:
        fault: what is put in.
        folder: the copy.
        patience: seconds for the slow cases.
    """
    path = folder / fault.file
    sound, before = path.read_bytes(), path.stat()
    near, far = reaching(fault)
    try:
        path.write_bytes(fault.apply(sound))
        os.utime(path, (0, next(_TIMES)))
        for by, marks, cases, limit in (
            ("quick", [], near, ENDLESS),
            ("slow", ["-m", SLOW], near, patience),
            ("quick", [], far, ENDLESS),
        ):
            if cases and limit and (caught := _run(folder, cases, marks, limit)):
                if caught == "no end" and by == "slow":
                    break
                return Verdict(by, caught, len(near))
        return Verdict("", "", len(near))
    finally:
        path.write_bytes(sound)
        os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


def _run(folder: Path, cases: list[str], marks: list[str], limit: int) -> str:
    """The first case that fails, or what else went wrong."""
    chosen = folder / "chosen.txt"
    chosen.write_text("\n".join(cases), encoding="utf-8")
    files = list(dict.fromkeys(case.split("::")[0] for case in cases))
    paths = {"PYTHONPATH": str(folder), "CHOSEN": str(chosen)}
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "tests.mutants.plugin", "-p", "no:cacheprovider"]
    run = [*command, *marks, *[each for each in files if (folder / each).exists()]]
    process = subprocess.Popen(
        run,
        cwd=folder,
        env=os.environ | paths,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )
    try:
        told, _ = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)  # with the servers and browsers that it started
        process.communicate()
        return "no end"
    if process.returncode in (0, 5):
        return ""
    failed = re.search(r"^(?:FAILED|ERROR) (\S.*?::.+?)(?: - .*)?$", told, re.MULTILINE)
    return failed[1] if failed else "the tests cannot start"
