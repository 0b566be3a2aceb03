"""Before and during a long sweep: how long it takes, how much room it needs, and its finished parts, kept beside its
file until it is whole: a sweep that was killed goes on there.
"""

import hashlib
import os
import zipfile
from collections.abc import Collection, Iterator
from concurrent.futures import Executor
from glob import escape
from pathlib import Path
from shutil import rmtree
from time import perf_counter

import numpy
from msgspec import Struct

from contoursolve.families.compiled_sweep import CompiledSweep, Table
from contoursolve.families.evaluate import STRETCH, rows_of, solve_parts
from contoursolve.families.versions import versions

MOST_ROWS = 100_000_000
"""Rows that are begun at a word: a minute or two where there is a closed form, and a file of some 20 GB. More come of a
step that is too small more often than of a wish."""

ENOUGH = 0.2
"""Seconds. So long rows are measured, without waiting for a sweep whose rows take milliseconds each."""

FEWEST = 64
"""Rows that are measured first; the function that they need is compiled then."""

NUMBER = 20
"""Bytes of a number in CSV: 17 digits, a sign, a point and a comma."""


class Checkpoints(Struct, frozen=True):
    """A folder with a file for each finished stretch of rows of one sweep.

    The name of the folder tells the sweep: another block, other values, another version have another folder. The same
    sweep may run several times at once: each has names of its own for what it writes, and whichever is whole first
    removes the folder.
    """

    folder: Path
    ready: CompiledSweep

    def is_done(self, number: int) -> bool:
        """Whether a part was finished, as far as its file's being there tells."""
        return self._file(number).exists()

    @property
    def rows_done(self) -> int:
        """The rows of the parts that were finished."""
        count = self.ready.ranges.count
        names = (file.stem for file in self.folder.glob("*.npz"))
        firsts = (int(name) * STRETCH for name in names if name.isdigit())
        return sum(min(STRETCH, count - first) for first in firsts)

    def tables(self, workers: int | None = None, executor: Executor | None = None) -> Iterator[Table]:
        """The words and results of all rows in order; parts that were finished are read, others solved and kept."""
        every = list(rows_of(self.ready))
        missing = {number for number in range(len(every)) if not self.is_done(number)}
        solved = solve_parts(self.ready, [every[number] for number in sorted(missing)], workers, executor)
        for number, part in enumerate(every):
            table = next(solved) if number in missing else self._load(number, part)
            if table is None:
                table = next(solve_parts(self.ready, [part]))
                missing.add(number)
            if number in missing:
                self._save(number, table)
            yield {**self.ready.ranges.rows(*part).values, **table}

    def temporary(self, name: str) -> Path:
        """A file in the folder that no other process writes to."""
        self.folder.mkdir(exist_ok=True)
        return self.folder / f"{name}.{os.urandom(4).hex()}.tmp"

    def remove(self) -> None:
        """Throw the parts away."""
        rmtree(self.folder, ignore_errors=True)

    def _file(self, number: int) -> Path:
        return self.folder / f"{number:06}.npz"

    def _load(self, number: int, part: tuple[int, int]) -> Table | None:
        """A part that was finished; None where there is none, or a damaged one."""
        try:
            # A damaged file that NumPy opens itself stays open.
            with self._file(number).open("rb") as file, numpy.load(file) as parts:
                table = {name: parts[name] for name in parts.files}
        except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
            return None
        kinds = self.ready.columns()
        is_whole = list(table) == list(kinds) and all(
            table[name].shape == (part[1] - part[0],) and table[name].dtype == kind for name, kind in kinds.items()
        )
        return table if is_whole else None

    def _save(self, number: int, table: Table) -> None:
        """Keep a part; whoever is killed here leaves no half of one."""
        temporary = self.temporary(f"{number:06}")
        try:
            with zipfile.ZipFile(temporary, "w") as archive:
                for name, values in table.items():
                    with archive.open(f"{name}.npy", "w", force_zip64=True) as file:
                        numpy.lib.format.write_array(file, values, allow_pickle=False)
            temporary.replace(self._file(number))
        except FileNotFoundError:
            pass  # the same sweep is whole elsewhere, which has removed the folder
        finally:
            temporary.unlink(missing_ok=True)


def parts_of(target: Path, ready: CompiledSweep) -> Checkpoints:
    """The parts of a sweep that is to be written to a file, on the disk on which that is."""
    target = _real(target)
    return Checkpoints(target.with_name(f".{target.name}.{digest(ready)}.parts"), ready)


def _real(target: Path) -> Path:
    """The file that is written in the place of a target: the one to which a link leads, else itself."""
    return target.resolve() if target.is_symlink() else target


def others(parts: Checkpoints, target: Path) -> Collection[Path]:
    """The folders of other sweeps to the same file that were not finished."""
    target = _real(target)
    found = target.parent.glob(f".{escape(target.name)}.*.parts")
    return sorted(folder for folder in found if folder != parts.folder)


def digest(ready: CompiledSweep) -> str:
    """A name for everything that the results depend on: the block, its options, its values, and the versions."""
    about = (ready.spec, ready.ranges.is_paired, STRETCH, versions(), *filter(None, [ready.tool]))
    found = hashlib.sha256(repr(about).encode())
    for word, values in ready.ranges.values.items():
        found.update(f"{word} {values.size} {values.dtype.str}".encode())
        found.update(numpy.ascontiguousarray(values).data)
    return found.hexdigest()[:16]


def seconds_of(ready: CompiledSweep) -> float:
    """The seconds that all rows take on one thread, if they take as long as the first ones."""
    most, rows = min(STRETCH, ready.ranges.count), FEWEST
    while True:
        rows = min(rows, most)
        begin = perf_counter()
        ready.evaluate(0, rows, ready.empty(rows))
        took = perf_counter() - begin
        if took >= ENOUGH or rows == most:
            return took / rows * ready.ranges.count
        rows *= 2


def room_of(parts: Checkpoints, *, is_text: bool) -> int:
    """The bytes that the file (as CSV: `is_text`) and the parts that are still to come take at most, while both are
    there."""
    kinds, words = parts.ready.columns(), len(parts.ready.ranges.values)
    part = sum(numpy.dtype(kind).itemsize for kind in kinds.values())
    row = NUMBER * (len(kinds) + words) if is_text else part + 8 * words
    rows = parts.ready.ranges.count
    return rows * row + (rows - parts.rows_done) * part
