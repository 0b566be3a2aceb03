"""Files of the workbench: names, encodings, and that nothing is ever lost."""

import errno
import os
import sys
from pathlib import Path

import pytest
from workbench_page import Page

from contoursolve.workbench import Desk

TEXT = "G00 X40. Z0.\r\nG111 X100. A180. K-30. B120. P5.\r\n"
TRICKS = (
    *("", ".", "..", "../out.nc", "..\\out.nc", "/etc/passwd", "C:\\out.nc", "C:out.nc", "out.nc:stream", "a/b.nc"),
    *("con", "CON.nc", "nul.txt", "com1", "LPT9.nc", "aux .nc", "COM¹", "a\0.nc", "a\n.nc", "a\x7f.nc", " a.nc"),
    *("a.nc ", "a.nc.", "...", "a?.nc", "a*.nc", "a|b.nc", '"a".nc', "<a>.nc", "x" * 300, "a\u202ecn.nc", "\ud800.nc"),
)


@pytest.mark.parametrize("name", TRICKS, ids=ascii)
def test_no_name_leads_out_of_the_folder_or_to_a_device(name, tmp_path):
    (tmp_path / "out.nc").write_bytes(b"OUTSIDE")
    folder = tmp_path / "programs"
    folder.mkdir()
    page = Page(Desk(folder))
    assert [*page.ask("open", name=name)] == ["trouble"]
    page.ask("open", name="new.nc", text=TEXT)
    assert page.ask("save", name=name)["trouble"]
    assert [*folder.iterdir()] == []
    # A file that is dropped may be called so elsewhere.
    page.ask("open", name=name, text=TEXT)
    assert page.ask("save")["saved"] == page.view["name"]
    assert [each.name for each in folder.iterdir()] == [page.view["name"]]
    assert (tmp_path / "out.nc").read_bytes() == b"OUTSIDE"
    assert sorted(each.name for each in tmp_path.iterdir()) == ["out.nc", "programs"]


@pytest.mark.skipif(sys.platform == "win32", reason="links need a right there")
def test_a_link_out_of_the_folder_is_not_followed(tmp_path):
    (tmp_path / "out.nc").write_bytes(b"OUTSIDE")
    folder = tmp_path / "programs"
    folder.mkdir()
    (folder / "link.nc").symlink_to(tmp_path / "out.nc")
    (folder / "loop.nc").symlink_to(folder / "loop.nc")
    (folder / "own.nc").write_bytes(TEXT.encode())
    (folder / "inside.nc").symlink_to(folder / "own.nc")
    page = Page(Desk(folder))
    assert [each["name"] for each in page.ask("files")["files"]] == ["inside.nc", "own.nc"]
    for name in ("link.nc", "loop.nc"):
        assert "leads out of the folder" in page.ask("open", name=name)["trouble"]
        page.ask("open", name="new.nc", text=TEXT)
        assert "leads out of the folder" in page.ask("save", name=name, over="")["trouble"]
    assert (tmp_path / "out.nc").read_bytes() == b"OUTSIDE"
    page.ask("open", name="inside.nc")
    page.type("P5.", "P6.")
    assert page.ask("save")["saved"]
    assert (folder / "own.nc").read_bytes() == TEXT.replace("P5.", "P6.").encode()


@pytest.mark.parametrize(
    "data",
    [
        TEXT.encode(),
        b"\xef\xbb\xbf" + TEXT.encode(),
        b"(\xd8 20)\r" + TEXT.encode(),
        b"%\nO1\r\n\r\r(\xc3\x98)\n\n",
        b"\x12" + TEXT.encode() + b"\x14\0\0\0",
        b"",
        b"\r\n",
    ],
    ids=ascii,
)
def test_a_file_keeps_its_encoding_and_every_byte_that_nobody_changed(data, tmp_path):
    (tmp_path / "a.nc").write_bytes(data)
    page = Page(Desk(tmp_path))
    opened = page.ask("open", name="a.nc")
    assert not opened["has_changes"]
    assert "\r" not in page.text
    assert page.ask("edit", edits=[{"from": 0, "to": 0, "text": "(NEW)\n"}])["has_changes"]
    assert not page.ask("edit", edits=[{"from": 0, "to": 6, "text": ""}])["has_changes"]
    page.ask("edit", text=f"{page.text}M30")
    assert page.ask("save")["saved"] == "a.nc"
    assert (tmp_path / "a.nc").read_bytes() == data + b"M30"


def test_a_character_that_the_file_cannot_hold_is_named_and_nothing_is_written(tmp_path):
    data = b"(\xd8 20)\n" + TEXT.encode()
    (tmp_path / "a.nc").write_bytes(data)
    page = Page(Desk(tmp_path))
    page.ask("open", name="a.nc")
    page.type("P5.", "P5. (≥)")
    assert "line 3 has the character ≥" in page.ask("save")["trouble"]
    assert (tmp_path / "a.nc").read_bytes() == data
    page.ask("edit", text="\ud800")
    assert "\\ud800" in page.ask("save")["trouble"]


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
    (tmp_path / "a.nc").write_bytes(TEXT.encode())
    page = Page(Desk(tmp_path))
    page.ask("open", name="a.nc")
    page.type("P5.", "P6.")
    with monkeypatch.context() as patched:
        DamagedFile(patched, step, error)
        trouble = page.ask("save")["trouble"]
    assert trouble.startswith("a.nc was not saved: it cannot be written: ")
    assert "your text is still here" in trouble
    assert (tmp_path / "a.nc").read_bytes() == TEXT.encode()
    assert [each.name for each in tmp_path.iterdir()] == ["a.nc"]
    assert page.ask("view")["text"] == page.text
    assert page.ask("save")["saved"]
    assert (tmp_path / "a.nc").read_bytes() == TEXT.replace("P5.", "P6.").encode()


def test_a_full_disk_a_folder_that_is_gone_and_a_protected_file(tmp_path):
    folder = tmp_path / "programs"
    folder.mkdir()
    (folder / "a.nc").write_bytes(TEXT.encode())
    page = Page(Desk(folder))
    page.ask("open", name="a.nc")
    page.type("P5.", "P6.")
    (folder / "a.nc").chmod(0o444)
    assert "it is write-protected" in page.ask("save")["trouble"]
    (folder / "a.nc").chmod(0o644)
    (folder / "a.nc").unlink()
    told = page.ask("save")
    assert "somebody deleted or renamed the file" in told["trouble"]
    assert page.ask("save", over=told["conflict"])["saved"] == "a.nc"
    (folder / "a.nc").unlink()
    folder.rmdir()
    assert "is the folder still there" in page.ask("files")["trouble"]
    assert "a.nc was not saved" in page.ask("save", over="")["trouble"]
    assert page.ask("view")["text"] == page.text


def test_what_is_no_program_is_not_opened(tmp_path):
    (tmp_path / "a.nc").write_bytes(b"\x89PNG\r\n\x1a\n" + bytes(100))
    (tmp_path / "big.nc").write_bytes(b"G01 X1.\n" * 2_000_000)
    (tmp_path / "folder.nc").mkdir()
    page = Page(Desk(tmp_path))
    assert "a picture, no CNC program" in page.ask("open", name="a.nc")["trouble"]
    assert "16,000,000" not in page.ask("open", name="a.nc")["trouble"]
    assert "can be opened here" in page.ask("open", name="big.nc")["trouble"]
    assert "no such file" in page.ask("open", name="folder.nc")["trouble"]
    assert "no such file" in page.ask("open", name="lost.nc")["trouble"]
    assert [each["name"] for each in page.ask("files")["files"]] == ["a.nc", "big.nc"]


def test_what_the_desk_has_forgotten_a_page_opens_again_and_saves(tmp_path):
    (tmp_path / "a.nc").write_bytes(b"\xef\xbb\xbf" + TEXT.encode())
    page = Page(Desk(tmp_path))
    opened = page.ask("open", name="a.nc")
    page.type("P5.", "P6.")
    again = Page(Desk(tmp_path))  # the server was started anew
    again.program = page.program
    assert again.ask("edit", text="x")["is_gone"]
    kept = {name: opened[name] for name in ("name", "base", "encoding", "has_order_mark", "line_end")}
    assert again.ask("open", text=page.text, **kept)["has_changes"]
    assert again.ask("save")["saved"] == "a.nc"
    assert (tmp_path / "a.nc").read_bytes() == b"\xef\xbb\xbf" + TEXT.replace("P5.", "P6.").encode()


def test_what_a_page_has_kept_is_not_written_over_what_somebody_else_wrote_meanwhile(tmp_path):
    (tmp_path / "a.nc").write_bytes(TEXT.encode())
    page = Page(Desk(tmp_path))
    opened = page.ask("open", name="a.nc")
    page.type("P5.", "P6.")
    (tmp_path / "a.nc").write_bytes(TEXT.replace("P5.", "P7.").encode())
    again = Page(Desk(tmp_path))
    assert again.ask("open", text=page.text, name="a.nc", base=opened["base"])["has_changes"]
    told = again.ask("save")
    assert "another window or program changed the file" in told["trouble"]
    assert again.ask("save", over=told["conflict"])["saved"]
    assert (tmp_path / "a.nc").read_bytes() == TEXT.replace("P5.", "P6.").encode()
