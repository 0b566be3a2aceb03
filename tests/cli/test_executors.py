"""A family is the same, byte for byte, wherever its rows are solved; and a sweep that was killed goes on."""

import json
import multiprocessing
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import ExitStack, contextmanager
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import contoursolve
import contoursolve.families.evaluate as evaluating
from contoursolve.cli import main
from contoursolve.cli.family import _write
from contoursolve.families import family, parts_of, sweep
from contoursolve.gcode.files import CannotWriteError

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
VARY = {"A": np.linspace(90, 270, 400), "P": np.linspace(-1, 30, 200)}
FACTS = {"facts": ["straight part of line 2 = 20"], "vary": {"K": np.linspace(-60, 0, 50)}}


@contextmanager
def processes():
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as executor:
        yield executor


@pytest.fixture(scope="module")
def here():
    """Families that are solved without an executor."""
    return family(BLOCK, start=START, vary=VARY), family("G111 X100. A180. K-30. B120. P?", start=START, **FACTS)


@pytest.mark.parametrize(
    "pool",
    [
        pytest.param(lambda: ThreadPoolExecutor(2), id="threads"),
        pytest.param(processes, id="processes", marks=pytest.mark.slow),
    ],
)
@pytest.mark.slow
def test_any_executor_gives_the_same_bytes(pool, here):
    one, asked = here
    with pool() as executor:
        other = family(BLOCK, start=START, vary=VARY, executor=executor)
        also = family("G111 X100. A180. K-30. B120. P?", start=START, executor=executor, **FACTS)
    for name in one.names:
        assert one[name].tobytes() == other[name].tobytes(), name
    for name in asked.names:
        assert asked[name].tobytes() == also[name].tobytes(), name


def test_an_error_in_the_program_ends_the_family_with_its_traceback(monkeypatch):
    def fail(*_):
        raise ZeroDivisionError("a fault in the program")

    monkeypatch.setattr(evaluating, "_solve", fail)
    with ThreadPoolExecutor(2) as executor, pytest.raises(ZeroDivisionError, match="a fault in the program") as caught:
        family(BLOCK, start=START, vary=VARY, executor=executor)
    assert "solve_rows" in [entry.name for entry in caught.traceback]


SWEEP = ["sweep", "--block", BLOCK, "--start", START, "--vary", "A=150:210:0.1", "--vary", "P=0:60:0.1"]


def start(*arguments, cwd):
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(Path(contoursolve.__file__).parents[1])])}
    command = [sys.executable, "-m", "contoursolve", *arguments]
    return subprocess.Popen(
        command, cwd=cwd, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


@pytest.mark.slow
@pytest.mark.parametrize(("name", "step", "most"), [("family.csv", "0.15", 4)])
def test_a_sweep_that_was_killed_goes_on_and_ends_with_the_same_bytes(name, step, most, tmp_path, monkeypatch):
    asked = [*SWEEP[:-1], f"P=0:60:{step}", "-o", name]
    unbroken, broken = tmp_path / "unbroken", tmp_path / "broken"
    for folder in (unbroken, broken):
        folder.mkdir()
    monkeypatch.chdir(unbroken)
    whole = CliRunner().invoke(main, asked)
    assert (whole.exit_code, whole.stderr.endswith(f"{name} written\n")) == (0, True), whole.stderr
    with start(*asked, cwd=broken) as child:
        deadline = time.monotonic() + 60
        while len(list(broken.glob(".*.parts/*.npz"))) < 2 and time.monotonic() < deadline:
            time.sleep(0.005)
        child.kill()
        child.communicate()
    assert not (broken / name).exists()
    parts = sorted(broken.glob(".*.parts/*.npz"))
    assert 2 <= len(parts) <= most
    # What was half written does not count.
    parts[0].write_bytes(parts[0].read_bytes()[:-1000])
    with start(*asked, cwd=broken) as child:
        again, errors = child.communicate()
    assert (child.returncode, again) == (0, whole.stdout), errors
    assert errors.startswith("going on after ")
    assert (broken / name).read_bytes() == (unbroken / name).read_bytes()
    assert [path.name for path in broken.iterdir()] == [name]


@pytest.mark.parametrize(("told", "workers"), [(signal.SIGINT, "1"), (signal.SIGTERM, "2")])
@pytest.mark.slow
def test_a_sweep_that_was_told_to_stop_says_what_is_kept(told, workers, tmp_path):
    longer = [*SWEEP[:-1], "P=0:60:0.01", "--workers", workers, "-o", "family.csv"]
    with start(*longer, cwd=tmp_path) as child:
        deadline = time.monotonic() + 60
        while len(list(tmp_path.glob(".*.parts/*.npz"))) < 2 and time.monotonic() < deadline:
            time.sleep(0.005)
        child.send_signal(told)
        output, errors = child.communicate()
    (folder,) = tmp_path.iterdir()
    kept = len(list(folder.glob("*.npz")))
    assert (child.returncode, output) == (130, "")
    assert errors.startswith(
        f"stopped after {kept * 65_536:,} of 3,606,601 contours, which are kept in {folder.name}: "
    )
    assert "the same command goes on there" in errors
    assert not list(folder.glob("*.tmp"))


def test_a_file_that_somebody_else_has_written_meanwhile_is_not_replaced(tmp_path):
    target = tmp_path / "family.csv"
    ready = sweep(BLOCK, vary={"A": [170, 180]}, start=START)
    parts = parts_of(target, ready)

    def tables():
        yield from parts.tables()
        target.write_text("mine")

    with pytest.raises(CannotWriteError, match=r"exists; give --force.*; 2 of 2 contours are kept in .*parts"):
        _write(target, parts, tables(), is_forced=False)
    assert target.read_text() == "mine"
    _write(target, parts, parts.tables(), is_forced=True)
    assert target.read_text().count("\n") == 3
    assert list(tmp_path.iterdir()) == [target]


@pytest.mark.skipif(os.name != "posix", reason="links need rights on Windows, and permissions are others there")
@pytest.mark.parametrize("name", ["family.parquet", "family.csv"])
def test_a_sweep_keeps_permissions_and_follows_links_as_a_report_does(name, tmp_path):
    (tmp_path / "there").mkdir()
    real, link = tmp_path / "there" / name, tmp_path / name
    real.touch(0o640)
    real.chmod(0o604)
    link.symlink_to(real)
    asked = ["sweep", "--block", BLOCK, "--start", START, "--vary", "A=1,2", "-o", str(link), "--force", "--quiet"]
    done = CliRunner().invoke(main, asked)
    assert (done.exit_code, done.stderr) == (0, f"{link} written\n")
    assert link.is_symlink()
    assert (real.stat().st_mode & 0o777, real.stat().st_size > 0) == (0o604, True)
    assert [*(tmp_path / "there").iterdir()] == [real]


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="no limit of files on Windows")
def test_what_a_full_disk_leaves_behind_is_named(tmp_path):
    """A limit on the size of files stands in for the disk: the parts fit, the whole does not."""
    limit = "import resource, runpy, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (3 << 19, 3 << 19)); "
    run = "sys.argv[0] = 'contoursolve'; runpy.run_module('contoursolve', run_name='__main__')"
    environment = os.environ | {"PYTHONPATH": str(Path(contoursolve.__file__).parents[1])}
    longer = ["sweep", "--block", BLOCK, "--start", START, "--vary", "A=150:210:0.01", "-o", "family.csv", "--quiet"]
    command = [sys.executable, "-c", limit + run, *longer]
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    (folder,) = tmp_path.iterdir()
    assert done.returncode == 2
    assert "family.csv cannot be written: File too large; 6,001 of 6,001 contours are kept in" in done.stderr
    assert folder.name in done.stderr
    assert [path.suffix for path in folder.iterdir()] == [".npz"]


def test_another_sweep_does_not_go_on_where_one_was_killed(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / ".family.csv.0123456789abcdef.parts").mkdir()
    arguments = ["sweep", "--block", BLOCK, "--start", START, "--vary", "A=1,2", "-o", "family.csv"]
    done = CliRunner().invoke(main, arguments)
    assert done.exit_code == 0
    assert "0123456789abcdef.parts is left of another family that was not finished" in done.stderr


def is_written(file: Path) -> bool:
    """Whether a scheduler has told its address: the file is there before that."""
    return file.exists() and file.read_text().rstrip().endswith("}")


@pytest.mark.slow
@pytest.mark.needs("distributed")
def test_a_sweep_runs_on_the_cluster_of_a_scheduler(tmp_path):
    file = tmp_path / "scheduler.json"
    environment = os.environ | {"PYTHONPATH": str(Path(contoursolve.__file__).parents[1])}

    def launch(module, *arguments):
        command = [sys.executable, "-m", f"distributed.cli.{module}", *arguments, "--scheduler-file", str(file)]
        return subprocess.Popen(
            command, env=environment, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )

    with ExitStack() as processes:
        for arguments in (
            ("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"),
            ("dask_worker", "--no-dashboard", "--nthreads", "1", "--host", "127.0.0.1"),
        ):
            process = processes.enter_context(launch(*arguments))
            processes.callback(process.terminate)
            deadline = time.monotonic() + 60
            while not is_written(file) and time.monotonic() < deadline:
                time.sleep(0.05)
        address = json.loads(file.read_text())["address"]
        for name, options in (("one.parquet", ()), ("two.parquet", ("--dask", address))):
            with start(*SWEEP[:-1], "P=0:60:1", *options, "-o", name, cwd=tmp_path) as child:
                _, errors = child.communicate()
            assert child.returncode == 0, errors
    assert (tmp_path / "one.parquet").read_bytes() == (tmp_path / "two.parquet").read_bytes()


@pytest.mark.slow
@pytest.mark.needs("distributed")
def test_a_scheduler_that_does_not_answer_is_one_line_and_status_2(tmp_path):
    with start(*SWEEP, "--dask", "tcp://127.0.0.1:1", cwd=tmp_path) as child:
        _, errors = child.communicate()
    assert (child.returncode, errors.count("\n")) == (2, 1), errors
    assert "no Dask scheduler answers at tcp://127.0.0.1:1" in errors
