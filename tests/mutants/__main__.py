"""Puts small faults into the package, one at a time, and tells which test notices each: `python -m tests.mutants`."""

import sys
import tomllib
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from itertools import cycle
from pathlib import Path
from queue import SimpleQueue
from random import Random

import click

from tests.mutants.faults import KINDS, Fault, all_faults
from tests.mutants.trial import ROOT, Verdict, copy_tree, judge, measure

UNNOTICEABLE = Path(__file__).with_name("unnoticeable.toml")
"""Faults that change nothing, each with a reason."""


def unnoticeable() -> dict[tuple[str, str, str], str]:
    """The reason of each fault that changes nothing, by its file, the text of its line, and the change."""
    rows = tomllib.loads(UNNOTICEABLE.read_text(encoding="utf-8"))["fault"]
    return {(row["file"], row["line"], row["change"]): row["reason"] for row in rows}


def name_of(fault: Fault) -> tuple[str, str, str]:
    """What a fault is called in that list, wherever its line stands."""
    text = (ROOT / fault.file).read_bytes().splitlines()[fault.line - 1].decode()
    return fault.file, text.strip(), fault.change


def draw(faults: list[Fault], seed: int) -> Iterator[Fault]:
    """Faults by chance, their kinds in turn, without those that change nothing and without a second one of a line."""
    random, known, lines = Random(seed), unnoticeable(), set()
    left = {kind: [fault for fault in faults if fault.kind == kind] for kind in KINDS}
    for kind in cycle(KINDS):
        if not any(left.values()):
            return
        while left[kind]:
            fault = left[kind].pop(random.randrange(len(left[kind])))
            if (fault.file, fault.line) not in lines and name_of(fault) not in known:
                lines.add((fault.file, fault.line))
                yield fault
                break


@click.command()
@click.option("--seed", type=int, default=1, show_default=True, help="What the faults are drawn by.")
@click.option("--count", type=click.IntRange(1), default=60, show_default=True, help="How many faults.")
@click.option("--room", "rooms", multiple=True, metavar="R", help="Only in this folder of the package. Repeatable.")
@click.option("--at", "places", multiple=True, metavar="FILE:LINE", help="All faults of this line. Repeatable.")
@click.option("--patience", type=int, default=180, show_default=True, help="Seconds for a fault's slow cases; 0: none.")
@click.option("--jobs", type=click.IntRange(1), default=2, show_default=True, help="How many run at once.")
@click.option("--measure", "is_measured", is_flag=True, help="First run all tests, to learn which lines they reach.")
@click.option("--list", "is_listed", is_flag=True, help="Print the faults, and run nothing.")
def main(
    seed: int,
    count: int,
    rooms: tuple[str, ...],
    places: tuple[str, ...],
    patience: int,
    jobs: int,
    is_measured: bool,
    is_listed: bool,
) -> None:
    """Draw small faults, run the tests that reach each, and print which one notices it."""
    if is_measured:
        measure(jobs)
    faults = [fault for fault in all_faults(ROOT) if not rooms or fault.room in rooms]
    if places:
        drawn = [fault for fault in faults if f"{fault.file}:{fault.line}" in places]
    else:
        drawn = [fault for fault, _ in zip(draw(faults, seed), range(count), strict=False)]
    if is_listed:
        for fault in drawn:
            click.echo(_row(fault, ""))
        return
    folders: SimpleQueue[Path] = SimpleQueue()
    for number in range(jobs):
        folders.put(copy_tree(number))

    def run(fault: Fault) -> Verdict:
        folder = folders.get()
        try:
            return judge(fault, folder, patience)
        finally:
            folders.put(folder)

    verdicts = []
    with ThreadPoolExecutor(jobs) as executor:
        for fault, verdict in zip(drawn, executor.map(run, drawn), strict=True):
            verdicts.append(verdict)
            told = f"{verdict.by or 'NONE':5} {verdict.case or f'of {verdict.cases} cases'}"
            click.echo(_row(fault, told))
            sys.stdout.flush()
    quick, slow = (sum(verdict.by == by for verdict in verdicts) for by in ("quick", "slow"))
    click.echo(
        f"{len(drawn)} faults: {quick} noticed by the quick cases, {slow} more by the slow ones, "
        f"{len(drawn) - quick - slow} by none"
    )


def _row(fault: Fault, told: str) -> str:
    return f"{fault.kind:10} {fault.file}:{fault.line}: {fault.change}\n           {told}"


if __name__ == "__main__":
    main()
