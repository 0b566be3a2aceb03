"""The program for a computer without Python, built by PyInstaller: it prints and writes what the command does."""

import os
import re
import shutil
import subprocess
import sys
import time
import urllib.request
from locale import getencoding
from pathlib import Path
from shlex import quote

import pytest

pytestmark = pytest.mark.desktop

ROOT = Path(__file__).parents[2]
PROGRAMS = [
    ROOT / "notebooks" / "programs" / "shaft_broken.nc",
    ROOT / "docs" / "programs" / "cam.h",
    ROOT / "docs" / "programs" / "shaft.dxf",
]
SUFFIX = ".exe" if sys.platform == "win32" else ""
PLACE = "Prüfung der Wellen"
"""A folder with a blank and an umlaut."""


@pytest.fixture(scope="module")
def built(request, tmp_path_factory) -> Path:
    """The folder in which the program lies, as a folder and as one file."""
    place = tmp_path_factory.mktemp("built") / PLACE
    given = request.config.getoption("--desktop")
    if given:
        shutil.copytree(given, place, symlinks=True)
    else:
        spec = ROOT / "editors" / "desktop" / "contoursolve.spec"
        folders = "--distpath", place, "--workpath", tmp_path_factory.mktemp("build")
        subprocess.run(
            [sys.executable, "-m", "PyInstaller", "--noconfirm", "--log-level", "WARN", *folders, spec], check=True
        )
    return place


@pytest.fixture(scope="module")
def folder(built) -> Path:
    """The program in its folder."""
    return built / "contoursolve" / f"contoursolve{SUFFIX}"


@pytest.fixture(scope="module")
def one_file(built) -> Path:
    """The program as one file."""
    return built / f"contoursolve-one-file{SUFFIX}"


@pytest.fixture
def place(tmp_path) -> Path:
    """A folder of programs."""
    found = tmp_path / PLACE
    found.mkdir()
    for program in PROGRAMS:
        shutil.copy(program, found)
    return found


def run(command, place: Path, *arguments, **environment):
    """Status, output, errors, and the files that are new; in a folder, which is as before then."""
    before = {path.name for path in place.iterdir()}
    environment = {**os.environ, "PYTHONPATH": str(ROOT), **environment}
    options = {"cwd": place, "env": environment, "capture_output": True, "timeout": 120}
    done = subprocess.run([*command, *arguments], check=False, **options)
    files = {path.name: path for path in place.iterdir() if path.name not in before}
    written = {name: path.read_bytes() for name, path in files.items()}
    for path in files.values():
        path.unlink()
    return done.returncode, done.stdout, done.stderr, written


COMMAND = sys.executable, "-m", "contoursolve"
BLOCK = "--block", "G111 X100. A180. K-30. B120. P5. Q5.", "--start", "X40. Z0."
ARGUMENTS = [
    ("check", "shaft_broken.nc", "cam.h", "--format", "json"),
    ("solve", "cam.h"),
    ("expand", "shaft_broken.nc", "-o", "ä b.nc"),
    ("convert", "shaft_broken.nc", "--to", "fanuc-lathe"),
    ("plot", "cam.h", "-o", "a.svg"),
    ("plot", "cam.h", "-o", "a.png"),
    ("plot", "cam.h", "-o", "a.dxf"),
    ("write", "shaft.dxf", "--to", "fanuc-lathe", "--sketch", "ö.toml"),
    ("report", "cam.h", "-o", "a.html"),
    ("sweep", *BLOCK, "--vary", "A=170:180:5", "-o", "a.csv", "--workers", "2"),
    ("rules", "--control", "nct-99m"),
    ("facts",),
    ("no such command",),
    ("--version",),
]


@pytest.mark.parametrize("arguments", ARGUMENTS, ids=" ".join)
def test_it_prints_and_writes_what_the_command_does(folder, place, arguments):
    expected = run(COMMAND, place, *arguments)
    assert run([folder], place, *arguments) == expected
    assert b"Traceback" not in expected[2]


def test_one_file_does_too_and_leaves_nothing_in_the_folder_for_temporary_files(one_file, place, tmp_path):
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    where = dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(temporary))
    for arguments in (ARGUMENTS[0], ARGUMENTS[5]):
        assert run([one_file], place, *arguments, **where) == run(COMMAND, place, *arguments)
    assert not list(temporary.iterdir())


def test_it_says_which_extra_it_is_without(folder, place):
    status, _, errors, written = run([folder], place, "sweep", *BLOCK, "--vary", "A=170", "-o", "a.parquet")
    told = errors.decode().replace(os.linesep, "\n")
    assert (status, written) == (2, {})
    assert "a Parquet file needs pyarrow; this program is without it" in told


def contents(place: Path) -> dict[str, int]:
    return {str(path): path.stat().st_mtime_ns for path in sorted(place.rglob("*"))}


def test_nothing_is_written_beside_it(built, folder, place):
    before = contents(built)
    for arguments in ARGUMENTS[5:9]:
        run([folder], place, *arguments)
    assert contents(built) == before


@pytest.mark.parametrize(
    ("kind", "arguments"),
    [("folder", ()), ("folder", ("serve", "--no-browser")), ("one_file", ("cam.h",)), ("one_file", ())],
    ids=str,
)
def test_a_double_click_and_a_dropped_file_open_the_workbench(request, kind, place, tmp_path, arguments):
    told, browser = tmp_path / "address", tmp_path / "browser.py"
    note = "import os, sys; open(sys.argv[1], 'w').write(sys.argv[2] + os.environ.get('LD_LIBRARY_PATH', ''))"
    browser.write_text(note, encoding="utf-8")
    started = [quote(path.as_posix()) for path in (Path(sys.executable), browser, told)]
    environment = {**os.environ, "BROWSER": f"{' '.join(started)} %s", "LD_LIBRARY_PATH": "/as/it/was"}
    program = request.getfixturevalue(kind)
    with subprocess.Popen([program, *arguments], cwd=place, env=environment, stdout=subprocess.PIPE) as process:
        try:
            first, address = (process.stdout.readline().decode(getencoding()).rstrip() for _ in range(2))
            assert first == f"The workbench of {place.resolve()}:"
            assert re.fullmatch(r"http://127\.0\.0\.1:\d+/\?token=\S+", address)
            with urllib.request.urlopen(address, timeout=30) as page:
                assert "contoursolve" in page.read().decode("utf-8")
            if "--no-browser" not in arguments:
                wait_for(told)
                # A browser has its own libraries, not those of the program.
                assert told.read_text(encoding="utf-8") == f"{address}/as/it/was"
        finally:
            end(process)


def wait_for(file: Path) -> None:
    for _ in range(200):
        if file.is_file() and file.stat().st_size:
            return
        time.sleep(0.1)
    pytest.fail(f"{file.name} was never written")


def end(process: subprocess.Popen) -> None:
    """End the program; as one file it is two processes, and Windows ends one alone."""
    if sys.platform == "win32":
        subprocess.run(["taskkill", "/F", "/T", "/PID", str(process.pid)], check=False, capture_output=True)
    process.terminate()
    process.wait(60)
