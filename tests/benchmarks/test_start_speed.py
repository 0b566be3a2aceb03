"""How long a command takes to begin, beside what it has to import: pytest tests/benchmarks/test_start_speed.py."""

import json
import os
import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import pytest

INSTALLED = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
"""The environment of a process. Installed packages are compiled; ours must be, too, as numpy and casadi are."""

IMPORTS = [sys.executable, "-c", "import numpy, casadi"]
ROUNDS = 15

Told = Callable[[str, str, str], None]


def alternating(*runs: tuple[list[str], dict[str, str], str]) -> list[tuple[float, float]]:
    """Shortest wall time and shortest processor time of each command, seconds, one after the other and again."""
    best = [(float("inf"), float("inf"))] * len(runs)
    for _ in range(ROUNDS):
        for number, (command, more, told) in enumerate(runs):
            before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), perf_counter()
            subprocess.run(command, check=True, capture_output=True, env=INSTALLED | more, input=told, text=True)
            wall, after = perf_counter() - begin, resource.getrusage(resource.RUSAGE_CHILDREN)
            used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            best[number] = min(best[number][0], wall), min(best[number][1], used)
    return best


@pytest.fixture
def one_block(tmp_path: Path) -> list[str]:
    program = tmp_path / "one.nc"
    program.write_text("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.\n", encoding="utf-8")
    return [sys.executable, "-m", "contoursolve", "solve", str(program)]


def test_a_whole_run_on_one_block(one_block: list[str], told: Told) -> None:
    (peer, peer_used), (own, used) = alternating((IMPORTS, {}, ""), (one_block, {}, ""))
    ratios = f"{own / peer:.2f} times, {used / peer_used:.2f} of processor time"
    told("a cold process, one block", f"{own * 1e3:.0f} ms", f"`import numpy, casadi`: {ratios}")
    assert used <= 2.4 * peer_used


def test_no_command_is_slower_with_two_threads_of_linear_algebra_allowed(one_block: list[str], told: Told) -> None:
    """As a user has it who states nothing, and with one thread."""
    clean = dict.fromkeys((name for name in INSTALLED if name.endswith("_NUM_THREADS")), "")
    (_, free), (_, single) = alternating((one_block, clean, ""), (one_block, {"OPENBLAS_NUM_THREADS": "1"}, ""))
    told("one block, threads as they are", f"{free * 1e3:.0f} ms of processor time", f"one: {free / single:.2f} times")
    assert free <= 1.1 * single


def test_an_editor_gets_its_first_answer(told: Told) -> None:
    texts = [
        json.dumps({"jsonrpc": "2.0", "method": method} | more)
        for method, more in (
            ("initialize", {"id": 1, "params": {"processId": None, "rootUri": None, "capabilities": {}}}),
            ("shutdown", {"id": 2}),
            ("exit", {}),
        )
    ]
    session = "".join(f"Content-Length: {len(text)}\r\n\r\n{text}" for text in texts)
    peer, own = alternating(
        ([sys.executable, "-c", "import pygls.lsp.server"], {}, ""),
        ([sys.executable, "-m", "contoursolve", "lsp"], {}, session),
    )
    ratios = f"{own[0] / peer[0]:.2f} times, {own[1] / peer[1]:.2f} of processor time"
    told("an editor's start", f"{own[0] * 1e3:.0f} ms", f"`import pygls.lsp.server`: {ratios}")
    assert own[1] <= 1.3 * peer[1]
