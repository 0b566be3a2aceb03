"""Files of the workbench: what names are of its folder, what is opened, and that nothing is ever lost."""

import errno
import os
import sys
from pathlib import Path

import pytest
from workbench_page import Page

from contoursolve.workbench import Desk

TEXT = b"G00 X40. Z0.\r\nG111 X100. A180. K-30. B120. P5.\r\n"
MENDED = TEXT.replace(b"P5.", b"P6.")
KEPT = "a.nc was not saved: it cannot be written: {}; your text is still here"
EMPTY, ENDS, DEVICE, UNSEEN = (
    "it is empty, too long, or has only points",
    "it begins or ends with a blank, or ends with a point",
    "Windows takes it for a device",
    "it has characters that cannot be shown",
)
TRICKS = (
    *(("", EMPTY, "program.nc"), (".", EMPTY, "program.nc"), ("..", EMPTY, "program.nc"), ("...", EMPTY, "program.nc")),
    ("../out.nc", "it has '/'", ".._out.nc"),
    ("..\\out.nc", "it has '\\\\'", ".._out.nc"),
    *(("/etc/passwd", "it has '/'", "_etc_passwd"), ("C:\\out.nc", "it has ':'", "C__out.nc")),
    *(("out.nc:stream", "it has ':'", "out.nc_stream"), ("a\0.nc", "it has '\\x00'", "a_.nc")),
    *(("a\n.nc", "it has '\\n'", "a_.nc"), ("a\x7f.nc", "it has '\\x7f'", "a_.nc"), ("a?.nc", "it has '?'", "a_.nc")),
    *(("a*.nc", "it has '*'", "a_.nc"), ("a|b.nc", "it has '|'", "a_b.nc"), ("<a>.nc", "it has '<'", "_a_.nc")),
    ('"a".nc', "it has '\"'", "_a_.nc"),
    *((name, DEVICE, "program.nc") for name in ("con", "CON.nc", "nul.txt", "com1", "LPT9.nc", "aux .nc", "COM¹")),
    *((" a.nc", ENDS, "a.nc"), ("a.nc ", ENDS, "a.nc"), ("a.nc.", ENDS, "a.nc")),
    *(("a\u202ecn.nc", UNSEEN, "program.nc"), ("\ud800.nc", UNSEEN, "program.nc")),
    pytest.param("y" + 197 * "x" + ".nc", EMPTY, 197 * "x" + ".nc", marks=pytest.mark.boundary),
    pytest.param("x" * 197 + ".nc", "", 197 * "x" + ".nc", marks=pytest.mark.boundary),
)


@pytest.mark.parametrize(("name", "fault", "safe"), TRICKS, ids=ascii)
def test_no_name_leads_out_of_the_folder_or_to_a_device(name, fault, safe, tmp_path):
    (tmp_path / "out.nc").write_bytes(b"OUTSIDE")
    folder = tmp_path / "programs"
    folder.mkdir()
    page = Page(Desk(folder))
    told = f"{name[:200]!r} is no name of a file in this folder: {fault}" if fault else f"{name}: no such file in the"
    assert page.ask("open", name=name)["trouble"] == (told if fault else f"{told} folder programs")
    page.ask("open", name="new.nc", text=TEXT.decode())
    if fault:
        assert page.ask("save", name=name) == {"trouble": told}
        assert [*folder.iterdir()] == []
    # A file that is dropped may be called so elsewhere.
    assert page.ask("open", name=name, text=TEXT.decode())["name"] == safe
    assert page.ask("save")["saved"] == safe
    assert [each.name for each in folder.iterdir()] == [safe]
    assert (tmp_path / "out.nc").read_bytes() == b"OUTSIDE"
    assert sorted(each.name for each in tmp_path.iterdir()) == ["out.nc", "programs"]


@pytest.mark.skipif(sys.platform == "win32", reason="links need a right there")
def test_a_link_out_of_the_folder_is_not_followed(tmp_path):
    (tmp_path / "out.nc").write_bytes(b"OUTSIDE")
    folder = tmp_path / "programs"
    folder.mkdir()
    (folder / "own.nc").write_bytes(TEXT)
    for name, target in (
        ("link.nc", tmp_path / "out.nc"),
        ("loop.nc", folder / "loop.nc"),
        ("in.nc", folder / "own.nc"),
    ):
        (folder / name).symlink_to(target)
    page = Page(Desk(folder))
    assert page.ask("files") == {"files": [{"name": each, "size": 48} for each in ("in.nc", "own.nc")], "left_out": 0}
    for name in ("link.nc", "loop.nc"):
        refused = {"trouble": f"'{name}' leads out of the folder; copy the file into it"}
        assert page.ask("open", name=name) == refused
        page.ask("open", name="new.nc", text="M30")
        assert page.ask("save", name=name, over="") == refused
    assert (tmp_path / "out.nc").read_bytes() == b"OUTSIDE"
    page.ask("open", name="in.nc")
    page.type("P5.", "P6.")
    assert page.ask("save")["saved"] == "in.nc"
    assert (folder / "own.nc").read_bytes() == MENDED


def test_the_list_has_the_programs_sketches_and_drawings_by_name_and_counts_those_left_out(tmp_path):
    shown = ["B.toml", "a.NC", "C.dxf", "d.json", "e.mpf", "f.h", "plain"]
    for name in (*shown, ".hidden.nc", "a.png"):
        (tmp_path / name).write_bytes(b"%%")
    (tmp_path / "folder.nc").mkdir()
    page = Page(Desk(tmp_path))
    assert [each["name"] for each in page.ask("files")["files"]] == sorted(shown, key=str.lower)
    for number in range(1_993):
        (tmp_path / f"n{number:04}.nc").touch()
    listed = page.ask("files")
    assert (len(listed["files"]), listed["left_out"]) == (2_000, 0)
    for number in range(3):
        (tmp_path / f"0{number}.nc").touch()
    listed = page.ask("files")
    assert (len(listed["files"]), listed["left_out"], listed["files"][-1]["name"]) == (2_000, 3, "n1990.nc")


class DamagedFile:
    """What opens a file that fails at some step, as a full disk, a folder that is gone or another program does it."""

    def __init__(self, monkeypatch, step, error):
        def fail(*_, **__):
            raise OSError(error, os.strerror(error))

        where = {"fsync": (os, "fsync"), "replace": (Path, "replace"), "open": (Path, "open")}[step]
        monkeypatch.setattr(*where, fail)


@pytest.mark.parametrize("step", ["open", "fsync", "replace"])
@pytest.mark.parametrize("error", [errno.ENOSPC, errno.EACCES, errno.EROFS, errno.EIO, errno.ENOENT])
def test_where_a_file_cannot_be_written_the_old_one_and_the_text_stay(step, error, tmp_path, monkeypatch):
    (tmp_path / "a.nc").write_bytes(TEXT)
    page = Page(Desk(tmp_path))
    page.ask("open", name="a.nc")
    page.type("P5.", "P6.")
    with monkeypatch.context() as patched:
        DamagedFile(patched, step, error)
        trouble = page.ask("save")["trouble"]
    assert trouble == KEPT.format(os.strerror(error))
    assert (tmp_path / "a.nc").read_bytes() == TEXT
    assert [each.name for each in tmp_path.iterdir()] == ["a.nc"]
    assert page.ask("view")["text"] == page.text
    assert page.ask("save")["saved"] == "a.nc"
    assert (tmp_path / "a.nc").read_bytes() == MENDED


def test_a_protected_file_one_that_is_gone_and_a_folder_that_is_gone_are_told(tmp_path):
    folder = tmp_path / "programs"
    folder.mkdir()
    (folder / "a.nc").write_bytes(TEXT)
    page = Page(Desk(folder))
    page.ask("open", name="a.nc")
    page.type("P5.", "P6.")
    (folder / "a.nc").chmod(0o444)
    protected = "a.nc was not saved: it is write-protected; make it writable, or write to another file; "
    assert page.ask("save")["trouble"] == f"{protected}your text is still here"
    (folder / "a.nc").chmod(0o644)
    (folder / "a.nc").unlink()
    gone = "a.nc was not saved: somebody deleted or renamed the file; save it again to write it anew"
    assert page.ask("save") == {"trouble": gone, "conflict": ""}
    assert page.ask("save", over="")["saved"] == "a.nc"
    (folder / "a.nc").unlink()
    folder.rmdir()
    lost = f"{folder} cannot be read: No such file or directory; is the folder still there?"
    assert page.ask("files") == {"trouble": lost}
    assert page.ask("save", over="")["trouble"] == KEPT.format("No such file or directory")
    assert page.ask("view")["text"] == page.text


def test_what_is_no_program_is_not_opened(tmp_path):
    (tmp_path / "a.nc").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(100))
    (tmp_path / "big.nc").write_bytes(bytes(10_000_001))
    (tmp_path / "folder.nc").mkdir()
    page = Page(Desk(tmp_path))
    assert page.ask("open", name="a.nc")["trouble"] == "a.nc is a picture, no CNC program"
    assert page.ask("open", name="big.nc")["trouble"] == (
        "big.nc has 10,000,001 bytes, and 10,000,000 can be opened here; use contoursolve check on the command line"
    )
    for name in ("folder.nc", "lost.nc"):
        assert page.ask("open", name=name)["trouble"] == f"{name}: no such file in the folder {tmp_path.name}"
    assert [each["name"] for each in page.ask("files")["files"]] == ["a.nc", "big.nc"]
    told = [(each["folder"], each["may_write"]) for each in (page.ask("hello"), Page(Desk()).ask("hello"))]
    assert told == [(tmp_path.name, True), ("", False)]
    assert Page(Desk()).ask("files")["trouble"] == Page(Desk()).ask("open", name="a.nc")["trouble"] == NO_FOLDER


NO_FOLDER = "there is no folder here: open a file by dropping it, and save it by your browser"


@pytest.mark.boundary
@pytest.mark.slow
def test_the_largest_file_is_opened(tmp_path):
    (tmp_path / "a.nc").write_bytes(b"(" + b"x" * 9_999_998 + b")")
    assert Desk(tmp_path).answer({"do": "open", "name": "a.nc"})["lines"] == 1


def test_of_two_windows_that_save_one_file_the_second_is_asked(tmp_path):
    (tmp_path / "a.nc").write_bytes(TEXT)
    desk = Desk(tmp_path)
    first, second = Page(desk, "first"), Page(desk, "second")
    for page, word in ((first, "P6."), (second, "P7.")):
        page.ask("open", name="a.nc")
        page.type("P5.", word)
    assert first.ask("save")["saved"] == "a.nc"
    changed = (
        "a.nc was not saved: another window or program changed the file since it was opened; "
        "save under another name, or replace it"
    )
    told = second.ask("save")
    assert told == {"trouble": changed, "conflict": first.view["base"]}
    there = "a.nc was not saved: there is a file of this name already; choose another name, or replace it"
    assert second.ask("save", name="b.nc")["saved"] == "b.nc"
    assert second.ask("save", name="a.nc") == {"trouble": there, "conflict": told["conflict"]}
    assert (tmp_path / "a.nc").read_bytes() == MENDED
    assert second.ask("save", name="a.nc", over=told["conflict"])["saved"] == "a.nc"
    assert [(tmp_path / each).read_bytes() for each in ("a.nc", "b.nc")] == [TEXT.replace(b"P5.", b"P7.")] * 2
    # What is there already is no conflict.
    first.type("P6.", "P7.")
    assert first.ask("save")["saved"] == "a.nc"
