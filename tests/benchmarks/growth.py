"""How time and memory of a sweep grow with its rows, each measured in a process of its own.

    python tests/benchmarks/growth.py                    1e3 to 1e7 rows; prints a table, writes the picture
    python tests/benchmarks/growth.py 30000000           these numbers of rows only, without the picture
    python tests/benchmarks/growth.py --measure ROWS     what each process does

The result in memory is `contoursolve.family`, the file is what `contoursolve family -o family.parquet` writes.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path
from time import process_time
from typing import Any

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
PICTURE = Path(__file__).parents[2] / "notebooks" / "pictures" / "family_growth.svg"
ROWS = [1_000, 10_000, 100_000, 1_000_000, 10_000_000]


def peak() -> float:
    """The most memory that this process ever had, MB."""
    # What `resource` tells includes that of the process that started this one.
    status = Path("/proc/self/status").read_text(encoding="ascii")
    return int(status.partition("VmHWM:")[2].split()[0]) / 1024


def ranges(rows: int) -> dict[str, Any]:
    import numpy  # noqa: PLC0415 - counts as memory of the package

    first = max(1, round(rows**0.5 / 10) * 10) if rows > 100 else 1
    while rows % first:
        first -= 1
    return {"A": numpy.linspace(150, 210, first), "P": numpy.linspace(0.1, 30, rows // first)}


def measure(rows: int, kind: str) -> dict[str, float]:
    """Seconds of processor time, which others at work do not change, and MB of one sweep; its functions are compiled
    before."""
    from contoursolve import family  # noqa: PLC0415 - what is imported counts, and nothing else
    from contoursolve.families import parts_of, sweep, write_parquet  # noqa: PLC0415

    family(BLOCK, start=START, vary=ranges(1_000))
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "family.parquet"
        if kind == "file":
            first = parts_of(target, sweep(BLOCK, start=START, vary=ranges(1_000)))
            write_parquet(target.with_name("first.parquet"), first.tables(), first.ready.measures())
        before, begin, result = peak(), process_time(), 0.0
        if kind == "memory":
            found = family(BLOCK, start=START, vary=ranges(rows))
            result = sum(each.nbytes for each in found.columns.values()) / 2**20
        else:
            parts = parts_of(target, sweep(BLOCK, start=START, vary=ranges(rows)))
            write_parquet(target, parts.tables(), parts.ready.measures())
            parts.remove()
        return {"seconds": process_time() - begin, "peak": peak(), "before": before, "result": result}


def run(rows: int, kind: str) -> dict[str, float]:
    done = subprocess.run(
        [sys.executable, __file__, "--measure", str(rows), kind], check=True, capture_output=True, text=True
    )
    found: dict[str, float] = json.loads(done.stdout)
    return found


def table(counts: list[int]) -> list[tuple[int, dict[str, float], dict[str, float]]]:
    print("| rows | in memory | more than the result | to Parquet | peak memory |")  # noqa: T201 what it is run for
    print("|---|---|---|---|---|")  # noqa: T201
    found = []
    for rows in counts:
        memory, file = run(rows, "memory"), run(rows, "file")
        over = memory["peak"] - memory["before"] - memory["result"]
        cells = f"{memory['seconds']:.3f} s | {max(over, 0):.0f} MB | {file['seconds']:.2f} s | {file['peak']:.0f} MB"
        print(f"| {rows:,} | {cells} |", flush=True)  # noqa: T201
        found.append((rows, memory, file))
    return found


def draw(found: list[tuple[int, dict[str, float], dict[str, float]]]) -> None:
    """Two diagrams with logarithmic axes; the same numbers give the same bytes."""
    import matplotlib  # noqa: PLC0415 - only the picture needs it

    matplotlib.use("svg")
    matplotlib.rcParams.update({"svg.hashsalt": "contoursolve", "svg.fonttype": "path", "font.size": 9})
    from matplotlib import pyplot  # noqa: PLC0415

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(8, 3), layout="constrained")
    rows = [each[0] for each in found]
    left.loglog(rows, [each[1]["seconds"] for each in found], "o-", label="in memory")
    left.loglog(rows, [each[2]["seconds"] for each in found], "s--", label="to Parquet")
    left.set(xlabel="contours", ylabel="seconds (processor)")
    right.loglog(rows, [each[1]["peak"] for each in found], "o-", label="in memory")
    right.loglog(rows, [each[1]["before"] + each[1]["result"] for each in found], ":", label="the result itself")
    right.loglog(rows, [each[2]["peak"] for each in found], "s--", label="to Parquet")
    right.set(xlabel="contours", ylabel="peak memory of the process, MB", ylim=(50, None))
    for axes in (left, right):
        axes.legend(frameon=False)
        axes.grid(alpha=0.3)
    figure.savefig(PICTURE, metadata={"Date": None, "Creator": None})


def main() -> None:
    if sys.argv[1:2] == ["--measure"]:
        print(json.dumps(measure(int(sys.argv[2]), sys.argv[3])))  # noqa: T201
        return
    counts = [int(each) for each in sys.argv[1:]]
    found = table(counts or ROWS)
    if not counts:
        draw(found)


if __name__ == "__main__":
    main()
