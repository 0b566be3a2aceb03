"""Edits of a program at the desk, as a page counts them: what each does to the text, and to the bytes of the file."""

from random import Random

import pytest
from workbench_page import Page, edited, units

from contoursolve.workbench import Desk

LINES = ("", "M8", "M9", "M98", "(Ø)", "(\N{GRINNING FACE}a)", "(a\N{GRINNING FACE}\N{GRINNING FACE})")
"""Lines of random programs; several look alike at their begin or end."""


def opened(folder, data: bytes, name: str = "a.nc") -> Page:
    """A window with a file of these bytes."""
    (folder / name).write_bytes(data)
    page = Page(Desk(folder))
    page.ask("open", name=name)
    return page


def random_lines(draw: Random, most: int) -> list[str]:
    few = draw.sample(LINES, 3)
    return [draw.choice(few) for _ in range(draw.randrange(most))]


def changed(draw: Random, lines: list[str]) -> list[str]:
    """Lines of which some in a row are other ones: at the head, at the tail, or between."""
    begin = draw.choice((0, draw.randrange(len(lines) + 1)))
    end = draw.choice((len(lines), draw.randrange(begin, len(lines) + 1)))
    return [*lines[:begin], *random_lines(draw, 4), *lines[end:]] or [""]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=ascii)
@pytest.mark.parametrize("seed", range(8))
def test_another_text_for_the_whole_becomes_the_text_and_the_file(seed, end, tmp_path):
    draw = Random(f"{seed} {end}")
    lines = ["(Ø \N{GRINNING FACE})", *random_lines(draw, 6), "M30"]
    page = opened(tmp_path, end.join(lines).encode())
    for number in range(1, 31):
        before, lines = lines, changed(draw, lines)
        seen = page.ask("edit", text="\n".join(lines))
        assert page.ask("view")["text"] == "\n".join(lines), (before, lines)
        assert page.ask("edit", text="\n".join(lines))["seq"] == page.seq == seen["seq"]
        assert page.view["lines"] == len(lines)
        if number % 10 == 0:
            page.ask("save")
            saved = (tmp_path / "a.nc").read_bytes().decode()
            assert saved.replace(end, "\n") == "\n".join(lines)
            assert saved.count(end) == len(lines) - 1


@pytest.mark.parametrize("seed", range(8))
def test_edits_by_their_places_do_what_they_do_on_the_page(seed, tmp_path):
    draw = Random(seed)
    text = "\n".join(["(Ø \N{GRINNING FACE})", *random_lines(draw, 8), "M30"])
    page = opened(tmp_path, text.replace("\n", "\r\n").encode())
    for number in range(1, 31):
        places = sorted(draw.randrange(len(page.text) + 1) for _ in range(2 * draw.randrange(1, 4)))
        offsets = [units(page.text[:place]) for place in places]
        edits = [
            {"from": begin, "to": end, "text": "\n".join(random_lines(draw, 3))}
            for begin, end in zip(offsets[::2], offsets[1::2], strict=True)
        ]
        wanted = page.text
        for each in reversed(edits):
            wanted = edited(wanted, each)
        if len({*offsets[::2]}) < len(edits):
            continue  # of two that begin at one place, nobody knows which comes first
        page.text = wanted
        assert "trouble" not in page.ask("edit", edits=draw.sample(edits, len(edits)))
        assert page.ask("view")["text"] == wanted, edits
        if number % 10 == 0:
            page.ask("save")
            assert (tmp_path / "a.nc").read_bytes().decode() == wanted.replace("\n", "\r\n")


@pytest.mark.parametrize(
    ("edits", "text"),
    [
        pytest.param([(0, 0, "a")], "aM8\n(\N{GRINNING FACE})\nM9", marks=pytest.mark.boundary),
        pytest.param([(-1, 0, "a")], None, marks=pytest.mark.boundary),
        pytest.param([(10, 10, "a")], "M8\n(\N{GRINNING FACE})\nM9a", marks=pytest.mark.boundary),
        pytest.param([(10, 11, "a")], None, marks=pytest.mark.boundary),
        pytest.param([(0, 3, "a"), (3, 7, "b")], "ab\nM9", marks=pytest.mark.boundary),
        pytest.param([(0, 4, "a"), (3, 7, "b")], None, marks=pytest.mark.boundary),
        ([(3, 2, "a")], None),
        ([(4, 6, "\r\nx\ry\n")], "M8\n(\nx\ny\n)\nM9"),
    ],
    ids=str,
)
def test_edits_that_overlap_or_leave_the_text_change_nothing(edits, text, tmp_path):
    page = opened(tmp_path, "M8\n(\N{GRINNING FACE})\nM9".encode())
    told = page.ask("edit", edits=[{"from": begin, "to": end, "text": new} for begin, end, new in edits])
    refused = {"trouble": "these edits are of another text; nothing was changed"}
    assert (told if text is None else told["seq"]) == (refused if text is None else 1)
    assert page.ask("view")["text"] == (text or "M8\n(\N{GRINNING FACE})\nM9")


@pytest.mark.parametrize(
    ("word", "fix", "edit"),
    [
        ("P60.", 0, {"from": 47, "to": 48, "text": ""}),
        ("P66.", 0, {"from": 47, "to": 48, "text": ""}),
        ("P60.", 1, {"from": 46, "to": 49, "text": "51.961"}),
        ("P60.", 2, {"from": 45, "to": 50, "text": ""}),
    ],
)
def test_a_fix_is_told_as_the_fewest_characters_that_differ(word, fix, edit, tmp_path):
    page = opened(tmp_path, f"\N{GRINNING FACE}\nG00 X40. Z0.\nG111 X100. A180. K-30. B120. {word} Q5.\nM30".encode())
    assert page.ask("fix", finding=0, fix=fix)["edits"] == [edit]
    assert page.ask("view")["text"] == page.text


@pytest.mark.parametrize(
    ("data", "encoding"),
    [
        (b"G00 X40.\r\nM30\r\n", "utf-8"),
        (b"\xef\xbb\xbfG00 X40.\r\nM30\r\n", "utf-8"),
        (b"(\xd8 20)\rG00 X40.\r\nM30\r\n", "latin-1"),
        (b"%\nO1\r\n\r\r(\xc3\x98)\n\n", "utf-8"),
        (b"\x12G00 X40.\r\n\x14\0\0\0", "utf-8"),
        (b"", "utf-8"),
        (b"\r\n", "utf-8"),
    ],
    ids=ascii,
)
def test_a_file_keeps_its_encoding_and_every_byte_that_nobody_changed(data, encoding, tmp_path):
    page = opened(tmp_path, data)
    assert (page.view["encoding"], page.view["has_order_mark"]) == (encoding, data[:1] == b"\xef")
    assert (page.view["has_changes"], "\r" in page.text) == (False, False)
    assert page.ask("edit", edits=[{"from": 0, "to": 0, "text": "(NEW)\n"}])["has_changes"]
    assert not page.ask("edit", edits=[{"from": 0, "to": 6, "text": ""}])["has_changes"]
    page.ask("edit", text=f"{page.text}M30")
    assert page.ask("save") == {"saved": "a.nc", "base": page.view["base"], "has_changes": False, "seq": 3}
    assert (tmp_path / "a.nc").read_bytes() == data + b"M30"
    assert not page.ask("view")["has_changes"]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("M8\nM9 (≥)", "line 2 has the character ≥"),
        ("(Ø)\n\n(Ł)", "line 3 has the character Ł"),
        ("\ud800", "line 1 has the character \\ud800"),
        ("M8\n\N{RIGHT-TO-LEFT OVERRIDE}", "line 2 has the character \\u202e"),
    ],
)
def test_a_character_that_the_file_cannot_hold_is_named_and_nothing_is_written(text, told, tmp_path):
    page = opened(tmp_path, b"(\xd8 20)\nM30")
    assert page.ask("edit", text=text)["has_changes"]
    assert page.ask("save")["trouble"] == (
        f"a.nc was not saved: {told}, which the file's encoding (Latin-1) lacks; write it in other characters"
    )
    assert (tmp_path / "a.nc").read_bytes() == b"(\xd8 20)\nM30"
    page.ask("edit", text="(Ø)")
    assert page.ask("save")["saved"] == "a.nc"
    assert (tmp_path / "a.nc").read_bytes() == b"(\xd8)"


KEPT = {"encoding": "latin-1", "has_order_mark": False, "line_end": "\r\n", "base": ""}


@pytest.mark.parametrize(
    ("said", "there", "saved"),
    [
        ({}, None, b"(\xd8)\r\nM30"),
        ({"encoding": "utf-8"}, None, b"(\xc3\x98)\r\nM30"),
        ({"encoding": "utf-8", "has_order_mark": True, "line_end": "\n"}, None, b"\xef\xbb\xbf(\xc3\x98)\nM30"),
        ({"line_end": "\r"}, None, b"(\xd8)\rM30"),
        # The file is there, and counts more than what the page says of it; one that is gone does not.
        ({"base": True}, b"\xef\xbb\xbfM30\n", b"\xef\xbb\xbf(\xc3\x98)\nM30"),
        ({"base": "0" * 32}, None, b"(\xd8)\r\nM30"),
    ],
)
def test_what_the_desk_has_forgotten_a_page_opens_again_and_saves(said, there, saved, tmp_path):
    page = opened(tmp_path, there or b"")
    base = page.view["base"] if there else ""
    if there is None:
        (tmp_path / "a.nc").unlink()
    again = Page(Desk(tmp_path))  # the server was started anew
    again.program = page.program
    assert again.ask("edit", text="x")["is_gone"]
    fields = {**KEPT, **said, **({"base": base} if said.get("base") is True else {})}
    seen = again.ask("open", name="a.nc", text="(Ø)\nM30", **fields)
    assert (seen["seq"], seen["has_changes"], seen["base"]) == (0, True, fields["base"])
    conflict = again.ask("save").get("conflict")
    assert conflict == ("" if said.get("base") == "0" * 32 else None)
    if conflict is not None:
        again.ask("save", over=conflict)
    assert (tmp_path / "a.nc").read_bytes() == saved
