"""What the program for a computer without Python does with what it is started with."""

import importlib.util
import sys
from pathlib import Path

import pytest

_FILE = Path(__file__).parents[2] / "editors" / "desktop" / "start.py"
_SPEC = importlib.util.spec_from_file_location("desktop_start", _FILE)
start = importlib.util.module_from_spec(_SPEC)
_SPEC.loader.exec_module(start)


@pytest.fixture
def home(tmp_path, monkeypatch) -> Path:
    """The home folder of a user with documents, and programs in a folder of their own."""
    home = tmp_path / "Jörg Müller"
    for name in ("Documents", "Programme", "contoursolve"):
        home.joinpath(name).mkdir(parents=True)
    home.joinpath("Programme", "welle 1.nc").write_text("G00 X40. Z0.\n", encoding="utf-8")
    home.joinpath("Programme", "check").write_text("G00 X40. Z0.\n", encoding="utf-8")
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("USERPROFILE", str(home))
    monkeypatch.delenv("XDG_CONFIG_HOME", raising=False)
    monkeypatch.chdir(home / "Programme")
    return home


@pytest.mark.skipif(sys.platform == "win32", reason="the documents of this user, whatever the home folder")
def test_a_double_click_opens_the_documents_and_a_terminal_its_folder(home):
    program = home / "contoursolve" / "contoursolve"
    documents, programs = home / "Documents", home / "Programme"
    found = [start.arguments([], here, program) for here in (programs, program.parent, home, Path(home.anchor))]
    assert found == [["serve", str(each)] for each in (programs, documents, documents, documents)]
    home.joinpath("Dokumente").mkdir()
    home.joinpath(".config").mkdir()
    settings = 'XDG_DESKTOP_DIR="$HOME/Schreibtisch"\nXDG_DOCUMENTS_DIR="$HOME/Dokumente"\n'
    home.joinpath(".config", "user-dirs.dirs").write_text(settings, encoding="utf-8")
    assert start.arguments([], home, program) == ["serve", str(home / "Dokumente")]
    home.joinpath("Dokumente").rmdir()
    assert start.documents() == home
