"""The explorer: a block is changed word by word, and what is shown is always what the block comes to."""

import json
import random
import re
import statistics
import subprocess
import sys
import time
from base64 import b64decode
from importlib.resources import files
from pathlib import Path

import pytest

import contoursolve
from contoursolve import Status
from contoursolve.notebook import exploration as explore
from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration_view import picture_of, range_of, section_of, view_of

WHOLE = "G111 X100. A180. K-30. B120. P5. Q5."
START = {"start": "X40. Z0."}
PAIR = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87"
PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
UPDATE = 0.05
"""Seconds of the processor for a change and all that is shown of it."""


def field(now, key):
    return next(each for each in view_of(now)["fields"] if each["key"] == key)


def test_a_word_is_written_as_the_control_reads_it():
    now = explore.begin(WHOLE, **START)
    assert explore.set_word(now, "P", 7.12349).text == "G111 X100. A180. K-30. B120. P7.123 Q5."
    assert explore.set_word(now, "A", "-170").text == "G111 X100. A-170. K-30. B120. P5. Q5."
    assert explore.set_word(now, "K", "-22,5").text == "G111 X100. A180. K-22.5 B120. P5. Q5."
    assert field(explore.set_word(now, "X", 90), "X")["value"] == 90
    inch = explore.begin("G111 X4. A180. K-1. B120. P.2", start="X2. Z0.", units="inch")
    moved = explore.set_word(inch, "P", 0.12345)
    assert moved.text == "G111 X4. A180. K-1. B120. P0.1234"
    assert (field(moved, "P")["value"], field(moved, "P")["unit"]) == (0.1234, "in")


@pytest.mark.parametrize(
    ("key", "value"), [("Z", 1), ("P", "x"), ("P", float("nan")), ("P", 1e300), ("P", ""), ("P", "1.060,5")]
)
def test_what_is_no_word_or_no_number_is_refused(key, value):
    with pytest.raises(ValueError, match=key):
        explore.set_word(explore.begin(WHOLE, **START), key, value)


def test_a_freed_word_gets_the_value_that_the_others_give_or_its_own_back():
    now = explore.begin(WHOLE, facts=["straight part of line 2 = 20"], **START)
    assert now.text.endswith("(contoursolve: straight part of line 2 = 20)")
    free = explore.free(now, "P")
    assert "P?" in free.text
    assert field(free, "P")["state"] == "free"
    assert field(free, "P")["value"] == pytest.approx(20.359, abs=1e-3)
    given = explore.free(free, "P")
    assert "P20.359 " in given.text
    assert given.answer.contour is not None
    open_ = explore.free(explore.begin(WHOLE, **START), "A")
    assert open_.answer.status is Status.UNDERDETERMINED
    assert field(open_, "A")["value"] is None
    assert explore.free(open_, "A").text == WHOLE
    assert explore.set_word(open_, "A", 175).text == WHOLE.replace("A180.", "A175.")


def test_a_freed_word_is_drawn_with_where_it_may_lead():
    freed = explore.free(explore.begin(WHOLE, **START), "X")
    picture = view_of(freed)["picture"]
    assert all(text in picture for text in ("end (free)", "other values", "Z-30 X40"))
    assert not re.search(r"end\s*</tspan>", picture)  # V1 is no end
    fixes = [fix["text"] for finding in view_of(freed)["findings"] for fix in finding["fixes"]]
    # U would say what X does.
    assert fixes == ["add Z? (such as Z-70., Z-32.114 or below)", "add W? (such as W-70., W-32.114 or below)"]


def test_a_number_that_no_control_reads_is_told_as_that():
    now = explore.begin(WHOLE, **START)
    with pytest.raises(ValueError, match=r"P takes numbers below 1,000,000,000, not 1e9"):
        explore.set_word(now, "P", "1e9")


def test_each_fix_gives_the_block_that_it_promises():
    now = explore.begin("G111 X100. A180. K-30. B120. P60.", **START)
    (found,) = view_of(now)["findings"]
    for fix in found["fixes"]:
        fixed = explore.apply_fix(now, fix["finding"], fix["number"])
        assert fixed.answer.status is Status.SOLVED
    chain = explore.begin(PAIR, rules="off")
    texts = {explore.apply_fix(chain, 0, number).text for number in range(len(chain.result.diagnostics[0].fixes))}
    assert texts == {f"{PAIR} Q-1", f"{PAIR} Q1"}
    with pytest.raises(ValueError, match="no fix 9"):
        explore.apply_fix(now, 0, 9)


@pytest.mark.parametrize(
    ("text", "facts", "options"),
    [
        (PAIR, (), {"rules": "off"}),
        (f"{PAIR} Q1", (), {}),
        ("G111 X100. A180. K-30. B?", ("line 2 tangent to circle (Z-40. X120. R10.)",), START),
    ],
    ids=["nothing chooses", "a word chooses", "a fact chooses"],
)
def test_each_solution_can_be_selected_and_is_then_the_contour(text, facts, options):
    now = explore.begin(text, facts, **options)
    items = view_of(now)["solutions"]["items"]
    assert len(items) == 2
    ends = set()
    for item in items:
        chosen = explore.select(now, item["number"])
        assert chosen.answer.contour is not None, chosen.text
        ends.add(tuple(round(value, 2) for at in chosen.answer.contour.points.values() for value in at))
    assert len(ends) == 2


TANGENT = "line 2 tangent to circle (Z-40. X120. R10.)"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "facts", "stays"),
    [
        ("G111 X100. A180. K-30. B?", (TANGENT,), ()),
        ("G111 X100. A180. K-30. B? P?", (TANGENT, "straight part of line 2 = 5"), ()),
        ("G111 A180. K-30. B?", ("X of V2 = 100", TANGENT), ("X of V2 = 100",)),
    ],
    ids=["one", "two", "one and what is stated besides"],
)
def test_a_selected_value_takes_the_place_of_the_facts_that_asked_for_it(text, facts, stays):
    now = explore.begin(text, facts, **START)
    assert now.answer.status is Status.AMBIGUOUS
    items = view_of(now)["solutions"]["items"]
    assert len(items) == 2
    for item in items:
        chosen = explore.select(now, item["number"])
        assert chosen.answer.status is Status.SOLVED, chosen.text
        assert "?" not in chosen.text
        assert "tangent" not in chosen.text
        assert all(fact in chosen.text for fact in stays)
        assert explore.reset(chosen).text == now.text


def test_one_contour_is_explored_at_a_time():
    with pytest.raises(ValueError, match=r"this text has 7 \(program lines 53, 67"):
        explore.begin((PROGRAMS / "shaft.nc").read_text())
    with pytest.raises(contoursolve.UnknownControlError):
        explore.begin("G111 A180.\nG3 X-50 Y0 R50 Q-1\nG1 X-50 Y42.857 ,A171.87")


def changed_lines(old, new):
    """The lines of two programs that differ, by number; they have as many."""
    pairs = list(zip(old.splitlines(keepends=True), new.splitlines(keepends=True), strict=True))
    return {number: new for number, (old, new) in enumerate(pairs, 1) if old != new}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "line", "key"),
    [("shaft.nc", 68, "B"), ("roller.nc", 27, "K"), ("cover.nc", 16, "15:Y"), ("plate.nc", 64, ",A")],
)
def test_a_line_takes_one_contour_out_of_a_program_and_changes_go_back_into_it(name, line, key):
    text = (PROGRAMS / name).read_text().replace("\n", "\r\n")
    now = explore.begin(text, line=line)
    whole = contoursolve.solve(text)
    assert now.answer.contour == whole.contour_at(line).contour
    first, last = now.answer.lines[0], now.answer.lines[-1]
    assert view_of(now)["text"].split("\n") == text.split("\r\n")[first - 1 : last]
    each = field(now, key)
    found = range_of(now, each)
    assert "of block" not in found["reason"] or ":" in key
    for stops, ends in zip(found["stops"], found["ends"], strict=True):
        for value, told in zip(stops, ends, strict=True):
            if told:
                moved = explore.set_word(now, key, value)
                assert moved.answer.contour is not None, (key, value)
                assert moved.answer.lines == now.answer.lines
                assert {*changed_lines(text, moved.text)} <= {*range(first, last + 1)}
    broken = explore.rewrite_block(now, f"(LOOK)\n{view_of(now)['text']}\n(LOOKED)")
    assert broken.text.split("\r\n")[first - 1] == "(LOOK)"
    assert broken.answer.lines[0] == first + 1
    assert explore.reset(broken).text == text
    assert explore.rewrite(broken, text).answer.lines == now.answer.lines


@pytest.mark.slow
def test_a_contour_of_a_broken_program_has_its_own_findings_and_fixes():
    text = (PROGRAMS / "shaft_broken.nc").read_text()
    now = explore.begin(text, line=21)
    view = view_of(now)
    assert view["elsewhere"] == "The rest of the program has 4 errors, the first in program line 13."
    (found,) = view["findings"]
    fixed = explore.apply_fix(now, found["fixes"][0]["finding"], found["fixes"][0]["number"])
    assert [*changed_lines(text, fixed.text)] == [21]
    assert fixed.answer.status is Status.SOLVED
    stated = explore.begin(text, ["straight part of line 1 = 5"], line=21)
    assert changed_lines(text, stated.text)[21].endswith("(contoursolve: straight part of line 1 = 5)\n")
    gone = explore.rewrite(now, "".join(each for each in text.splitlines(keepends=True) if "N310" not in each))
    assert (gone.answer, gone.block) == (None, "")
    assert explore.rewrite_block(gone, now.block).text == text


@pytest.mark.slow
def test_a_line_without_a_contour_of_its_own_is_told_in_one_sentence():
    text = (PROGRAMS / "shaft.nc").read_text()
    with pytest.raises(
        ValueError, match=r"^program line 1 belongs to no contour; contours begin in program lines 53, 67"
    ):
        contoursolve.explore(text, line=1)
    with pytest.raises(ValueError, match=r"^program line 1 belongs to no contour; the program has none$"):
        contoursolve.explore("G00 X40. Z0.", line=1, control="fanuc-lathe")
    loop = "#1=5\nWHILE [#1 LT 8] DO1\nG0 X40. Z0.\nG1 Z-30. ,R#1\nX100. ,A120.\n#1=#1+1\nEND1\nM30"
    with pytest.raises(
        ValueError, match=r"^program line 4 makes 3 contours, one each time it runs; explore its block alone"
    ):
        contoursolve.explore(loop, line=4, control="fanuc-lathe")
    now = explore.begin(text, line=67)
    with pytest.raises(ValueError, match=r"this block has 2 \(program lines 67, 68\)$"):
        explore.rewrite_block(now, "\n".join(text.split("\n")[66:68]))


def test_the_traits_of_a_line_are_those_of_the_program_and_variables_are_numbers():
    text = "#100=40.\nG00 X#100 Z0.\nG111 X#101 A180. K-30. B120. P5.\nG111 A180. W-20. B90. U10."
    widget = contoursolve.explore(text, line=3, control="yasnac-lx3", variables={"#101": 95})
    assert widget.text == text.replace("#101", "95.")
    widget.values = {"X": 100}
    assert widget.text == text.replace("X#101", "X100.")
    widget.text = text.replace("X#101", "X90.").replace("B90", "B100")
    assert (widget.values["X"], widget.view["text"]) == (90, "G111 X90. A180. K-30. B120. P5.")


def test_the_control_stays_when_what_shows_it_is_taken_out():
    now = explore.begin(f"{PAIR} Q-1")
    bare = explore.write(now, now.text.replace(",A171.87 Q-1", ""))
    assert (bare.result.control, bare.answer) == ("nct-99m", None)
    assert view_of(bare)["status"]["text"] == "no contour"
    assert explore.reset(bare).answer.status is Status.SOLVED


def act(now, rng):
    """Something that a reader might do."""
    view = view_of(now)
    ways = [
        lambda: explore.write(now, now.text[: rng.randrange(len(now.text) + 1)] + rng.choice(("P1.", "?", "(", "")))
    ]
    for each in view["fields"]:
        share = rng.uniform(-0.2, 1.2)
        value = each["low"] + share * (each["high"] - each["low"])
        ways += [
            lambda each=each, value=value: explore.set_word(now, each["key"], value),
            lambda each=each: explore.free(now, each["key"]),
        ]
    for finding in view["findings"]:
        ways += [lambda fix=fix: explore.apply_fix(now, fix["finding"], fix["number"]) for fix in finding["fixes"]]
    for item in view["solutions"]["items"]:
        if item["selects"]:
            ways.append(lambda item=item: explore.select(now, item["number"]))
    return rng.choice(ways)()


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        WHOLE,
        pytest.param(f"{PAIR} Q-1", marks=pytest.mark.slow),
        pytest.param("G112 X60. I10. K-8. R10. P1. Q1.", marks=pytest.mark.slow),
    ],
    ids=["G111", "pair", "G112"],
)
@pytest.mark.parametrize("times", [1, pytest.param(2, marks=pytest.mark.slow)])
def test_whatever_the_reader_does_the_view_shows_what_the_text_comes_to(text, times):
    rng = random.Random(f"explorer {text}")
    options = {} if "G17" in text else START
    seen = set()
    for _ in range(times):
        now = explore.begin(text, **options)
        for _ in range(8):
            now = act(now, rng)
            view = view_of(now)
            json.dumps(view, allow_nan=False)
            assert view["text"] == now.text
            fresh = contoursolve.solve(now.text, **options)
            assert [each.message for each in fresh.diagnostics] == [each.message for each in now.result.diagnostics]
            seen.add(view["status"]["text"])
            for each in view["fields"]:
                if each["state"] == "given":
                    assert each["low"] <= each["value"] <= each["high"]
        assert explore.reset(now).text == text
    assert len(seen) > 1


@pytest.mark.slow
def test_a_range_on_a_slider_ends_where_single_solves_say_so():
    now = explore.begin(WHOLE, **START)
    for each in view_of(now)["fields"]:
        found = range_of(now, each)
        assert found["low"] <= each["low"] or found["low"] > -10_000
        for low, high in found["intervals"]:
            for end, inward in ((low, 1), (high, -1)):
                if found["low"] < end < found["high"]:
                    assert explore.set_word(now, each["key"], end + inward * 0.002).answer.contour is not None
                    assert explore.set_word(now, each["key"], end - inward * 0.002).answer.contour is None
    assert range_of(now, field(now, "P"))["note"] == "0 ≤ P ≤ 51.961"
    assert range_of(now, field(now, "A"))["note"] == "138.219 ≤ A ≤ 269.998"
    beside = explore.begin("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5.")
    assert range_of(beside, field(beside, "X"))["note"] == "X ≥ 45"
    freed = explore.free(now, "X")
    assert [range_of(freed, field(freed, key)) for key in "AKBP"] == [{}] * 4  # another word is missing
    assert range_of(explore.begin(f"{PAIR} Q-1"), {**field(explore.begin(f"{PAIR} Q-1"), "Q")}) == {}


CHAIN = "G18 G1 X40. Z0.\nG1 Z-20. ,R2.\nX70. Z-35. ,C1.\nZ-60."
MOVED = {
    "G111": (WHOLE, START),
    "pair": (f"{PAIR} Q-1", {}),
    "chain": (CHAIN, {**START, "control": "fanuc-lathe"}),
    "asked": ("G111 X100. A180. K-30. B? P5. Z-50.", START),
    "fact": ("G111 X100. A180. K-30. B120. P? (contoursolve: straight part of line 2 = 20)", START),
}


@pytest.mark.parametrize(("text", "options"), MOVED.values(), ids=MOVED)
def test_what_is_drawn_moves_as_its_derivatives_say(text, options):
    """A word a little farther, solved and drawn in the same frame, is where the derivatives of the word put it."""
    now = explore.begin(text, **options)
    drawn = picture_of(now.answer)
    view = view_of(now, drawn)
    assert {each["kind"] for each in view["handles"]} >= {"point"}
    for key in {key for handle in view["handles"] for key in handle["keys"]}:
        value, step = field(now, key)["value"], 0.002
        moved = explore.set_word(now, key, value + step)
        assert field(moved, key)["value"] == pytest.approx(value + step)
        after = view_of(moved, picture_of(moved.answer, drawn))
        assert after["frame"] == view["frame"]
        there = {each["name"]: each["places"] for each in after["elements"]}
        for element in view["elements"]:
            for before, slopes, found in zip(element["places"], element["slopes"], there[element["name"]], strict=True):
                wanted = [at + step * by for at, by in zip(before, slopes.get(key, (0, 0)), strict=True)]
                assert found == pytest.approx(wanted, abs=2e-4), (key, element["name"])
        grips = {each["name"]: each["at"] for each in after["handles"]}
        for handle in view["handles"]:
            if key in handle["moves"] and handle["kind"] == "point":
                wanted = [at + step * by for at, by in zip(handle["at"], handle["moves"][key], strict=True)]
                assert grips[handle["name"]] == pytest.approx(wanted, abs=2e-4), (key, handle["name"])


@pytest.mark.parametrize(
    ("text", "options"),
    [
        (WHOLE, START),
        ("G00 X20. Z0.\nG01 X40. ,A150.", {"control": "fanuc-lathe"}),
        ("G00 X100. Z-50.\nG112 U0 I10. K-50. R30. P0", {"control": "yasnac-lx3"}),
    ],
)
def test_where_a_drag_stops_there_is_a_contour(text, options):
    now = explore.begin(text, **options)
    count = 0
    for each in view_of(now)["fields"]:
        found = range_of(now, each)
        for stops, ends in zip(found.get("stops", ()), found.get("ends", ()), strict=True):
            for value, told in zip(stops, ends, strict=True):
                if told and stops[0] <= stops[1]:
                    count += 1
                    assert explore.set_word(now, each["key"], value).answer.contour is not None, (each["key"], value)
    assert count


@pytest.mark.parametrize(
    ("name", "line", "key", "short", "whole"),
    [
        ("roller.nc", 27, "K", "-9 ≤ K ≤ 9 but 0", ""),
        ("roller.nc", 25, "X", "X ≤ 8 or X ≥ 16", ""),
        ("plate.nc", 20, ",A", "-7.88 ≤ ,A ≤ 51.483 but about 14.62", ""),
        (
            "plate.nc",
            25,
            "J",
            "-96 ≤ J ≤ 3 or J ≥ 786 (at least)",
            "-96.146 ≤ J ≤ 3.334 or J ≥ 785.876 (at least)",
        ),
        (
            "plate.nc",
            64,
            "64:Z",
            "-28.643 ≤ Z ≤ -28.374 or 4.68 ≤ Z ≤ 6.56 and 1 more",
            "-28.643 ≤ Z ≤ -28.374 or 4.675 ≤ Z ≤ 6.561 or 40.623 ≤ Z ≤ 40.643",
        ),
    ],
)
def test_many_ranges_are_told_in_a_line_and_nothing_is_left_out_silently(name, line, key, short, whole):
    now = explore.begin((PROGRAMS / name).read_text(), line=line)
    found = range_of(now, field(now, key))
    assert (found["note"], found["whole"]) == (short, whole)
    inside = [float(each) for each in re.findall(r"-?[\d.]+(?= ≤ \w)|(?<= ≤ )-?[\d.]+|(?<= ≥ )-?[\d.]+", short)]
    assert inside
    for value in inside:
        assert explore.set_word(now, key, value).answer.contour is not None, value


def test_a_value_at_which_the_other_words_agree_is_one_to_catch():
    now = explore.begin("G18 G1 X40. Z0.\nG1 X50. ,A170. ,R3.\n,A120. Z-60. X80.\nX80. Z-90.", control="fanuc-lathe")
    assert now.answer.contour is None
    snaps = {each["text"]: each["value"] for each in range_of(now, field(now, "3:,A"))["snaps"]}
    assert snaps["as the other words say"] == pytest.approx(154.638, abs=1e-3)
    assert explore.set_word(now, "3:,A", snaps["as the other words say"]).answer.contour is not None
    assert "in line with ,A170." in snaps


@pytest.mark.slow
def test_an_update_takes_less_than_50_ms_of_python():
    now = explore.begin(WHOLE, **START)
    times = []
    for number in range(24):
        begin = time.process_time()
        now = explore.set_word(now, "P", (5, 60, 20, 70)[number % 4] + number / 10)
        json.dumps(view_of(now))
        times.append(time.process_time() - begin)
    assert statistics.median(times[4:]) < UPDATE


@pytest.fixture
def widget():
    return contoursolve.explore(WHOLE, **START)


def test_the_widget_answers_each_action_by_its_number(widget):
    widget.action = {"do": "move", "values": {"P": 60}, "number": 1}
    assert (widget.number, widget.view["status"]["text"], widget.view["trouble"]) == (1, "without a solution", "")
    assert widget.text == WHOLE.replace("P5.", "P60.")
    assert widget.result.answers[0].status is Status.NO_SOLUTION
    widget.action = {"do": "range", "key": "P", "number": 2}
    assert widget.number == 2
    assert widget.ranges["P"]["intervals"][0][0] == 0
    widget.action = {"do": "fix", "finding": 0, "fix": 0, "number": 3}
    assert widget.view["status"]["text"] == "solved"
    widget.action = {"do": "reset", "number": 4}
    assert (widget.text, widget.view["is_changed"]) == (WHOLE, False)


@pytest.mark.parametrize(
    "action",
    [
        {"do": "move", "values": {"P": "?"}},
        {"do": "move", "values": {"V": 1}},
        {"do": "move", "values": "P"},
        {"do": "move"},
        {"do": "fix", "finding": 7, "fix": 0},
        {"do": "fix", "finding": None, "fix": 0},
        {"do": "select", "solution": 3},
        {"do": "nothing"},
        {},
    ],
    ids=str,
)
def test_an_action_that_makes_no_sense_changes_nothing_and_is_told(widget, action):
    widget.action = {**action, "number": 1}
    assert widget.text == WHOLE
    assert widget.number == 1
    assert widget.view["trouble"]


def test_whatever_fails_is_told_and_answered(widget, monkeypatch):
    def fail(*_, **__):
        raise RuntimeError("no")

    monkeypatch.setattr("contoursolve.notebook.exploration.solve", fail)
    widget.action = {"do": "move", "values": {"P": 6}, "number": 1}
    assert (widget.text, widget.number, widget.view["trouble"]) == (WHOLE, 1, "RuntimeError: no")


@pytest.mark.slow
@pytest.mark.needs("nbconvert", "nbformat")
def test_without_a_kernel_the_picture_is_there(widget):
    from nbconvert import HTMLExporter  # noqa: PLC0415 - slow to import
    from nbformat import v4  # noqa: PLC0415

    data, _ = widget._repr_mimebundle_()
    assert {"application/vnd.jupyter.widget-view+json", "text/plain", "text/html", "image/svg+xml"} == set(data)
    cell = v4.new_code_cell("explore", outputs=[v4.new_output("display_data", data)])
    page, _ = HTMLExporter(embed_images=True).from_notebook_node(v4.new_notebook(cells=[cell]))
    pictures = map(b64decode, re.findall(r'<img[^>]* src="data:image/svg\+xml;base64,([^"]+)', page))
    assert any(b"corner 1" in picture for picture in pictures)


def strings(data):
    """All texts in plain data."""
    if isinstance(data, str):
        return [data]
    items = [*data.keys(), *data.values()] if isinstance(data, dict) else data if isinstance(data, list | tuple) else []
    return [text for each in items for text in strings(each)]


def test_a_notebook_gets_plain_texts(widget):
    """marimo sends a subclass of str, such as markupsafe's, as an object, and shows an error in its place."""
    for number, name in enumerate(("equations", "calculation"), 1):
        widget.action = {"do": "section", "name": name, "number": number}
    shown = [widget._repr_mimebundle_()[0], widget.view, widget.sections]
    shown += [each._repr_mimebundle_() for each in (widget.result, widget.answer, widget.answer.system)]
    shown.append(contoursolve.solve("G111 X100. A180. K-30. B120. P60.", **START).diagnostics[0]._repr_mimebundle_())
    assert {type(text) for each in shown for text in strings(each)} == {str}
    assert sum("<table" in text for each in shown for text in strings(each)) > 4


def test_without_a_picture_the_tables_are_there(widget, monkeypatch):
    monkeypatch.setattr("contoursolve.pictures.drawing.draw_answer", None)
    data, _ = widget._repr_mimebundle_()
    assert "text/html" in data
    assert "image/svg+xml" not in data


def test_the_front_end_sets_texts_and_loads_nothing():
    house = files("contoursolve.notebook")
    script, sheet = (house.joinpath(f"explorer.{kind}").read_text() for kind in ("js", "css"))
    assert not re.search(
        r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|eval\(|import\(|fetch\(|XMLHttp", script
    )
    assert not re.search(
        r"https?:|//cdn|@import|url\(", script.replace("// ", "").replace('"http://www.w3.org/2000/svg"', "") + sheet
    )


def test_what_is_missing_is_named():
    program = (
        "import sys; sys.modules['anywidget'] = None; import contoursolve\n"
        f"try:\n contoursolve.explore({WHOLE!r}, start='X40. Z0.')\nexcept ImportError as error: print(error)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == (
        "exploring a contour needs anywidget; install it with: "
        f'{sys.executable} -m pip install "contoursolve[notebook]"'
    )


def test_the_traits_of_the_widget_are_observed_and_set():
    widget = contoursolve.explore("G111 X100. A180. K-30. B120. P5.", start="X40. Z0.")
    seen = []
    widget.observe(lambda change: seen.append((change["name"], change["new"])), ["text", "values", "answer"])
    widget.values = {"A": 170.0}
    assert widget.text == "G111 X100. A170. K-30. B120. P5."
    assert widget.answer.contour.end == pytest.approx((-44.2664, 50), abs=1e-4)
    assert {name for name, _ in seen} == {"text", "values", "answer"}
    widget.text = "G111 X100. A180. K-30. B130. P5."
    assert widget.values == {"X": 100, "A": 180, "K": -30, "B": 130, "P": 5}
    assert widget.view["text"] == widget.text
    for name, wrong in (("values", {"Q": 1.0}), ("values", {"A": "x"})):
        with pytest.raises(ValueError, match=r"Q|x"):
            setattr(widget, name, wrong)
        assert widget.text == "G111 X100. A180. K-30. B130. P5."
        assert widget.values["A"] == 180


@pytest.mark.slow
def test_sympy_is_imported_when_a_section_is_opened_and_not_before():
    program = (
        "import sys, contoursolve\n"
        f"widget = contoursolve.explore({WHOLE!r}, start='X40. Z0.')\n"
        "widget._repr_mimebundle_()\n"
        "for number, asked in enumerate(\n"
        "    ({'do': 'move', 'values': {'P': 60}}, {'do': 'free', 'key': 'X'}, {'do': 'undo'}, {'do': 'undo'},\n"
        "     {'do': 'range', 'key': 'P'}, {'do': 'section', 'name': 'equations'}), 1):\n"
        "    print('sympy' in sys.modules, end=' ')\n"
        "    widget.action = {**asked, 'number': number}\n"
        "print('sympy' in sys.modules, 'sin(B)' in widget.sections['equations']['html'])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.split() == [*["False"] * 6, "True", "True"]


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (WHOLE, {"equations": "must not be parallel", "calculation": "right triangle"}),
        ("G111 X100. A180. B120.", {"equations": "still open", "calculation": "nothing to calculate"}),
        (f"{WHOLE} (contoursolve: X of V1 = 40)", {"equations": "the same", "calculation": "triangle"}),
        ("G01 X50.", {"equations": "no contour", "calculation": "no contour"}),
    ],
    ids=["solved", "open", "tied", "none"],
)
def test_each_section_tells_what_the_block_comes_to(text, wanted):
    now = explore.write(explore.begin(WHOLE, **START), text)
    for name, words in wanted.items():
        told = section_of(now, name)
        assert words in told.lower(), told
        assert 'words-"' not in told


def fixes_after(text, values, **options):
    """The fixes of the first finding after words were moved."""
    talk = Conversation(explore.begin(text, **options))
    talk.answer({"do": "move", "values": values, "number": 1})
    return talk, talk.state["view"]["findings"][0]["fixes"]


@pytest.mark.parametrize(("key", "value"), [("A", 100), ("B", 200), ("X", 30)])
def test_what_the_reader_has_just_changed_is_the_first_to_be_changed_again(key, value):
    talk, (first, *others) = fixes_after(WHOLE, {key: value}, **START)
    assert first["alone"] == ""
    assert first["text"].startswith(f"write {key}")
    assert any(fix["alone"] == "changes B120., which you left alone" or key == "B" for fix in others)
    assert {fix["number"] for fix in (first, *others)} == {*range(len(others) + 1)}
    talk.answer({"do": "fix", "finding": first["finding"], "fix": first["number"], "number": 2})
    words = [text.split() for text in (talk.exploration.block, WHOLE)]
    assert {word[0] for word, old in zip(*words, strict=True) if word != old} == {key}
    assert talk.exploration.answer.contour is not None


def test_a_number_that_was_pulled_is_no_slip_of_a_typist():
    for is_held, wanted in ((True, "write P51.961 for P60."), (False, "write P6. for P60. (a zero too many)")):
        talk = Conversation(explore.begin(WHOLE, **START))
        talk.answer({"do": "move", "values": {"P": 60}, "is_held": is_held, "number": 1})
        talk.answer({"do": "release", "number": 2})
        assert talk.state["view"]["findings"][0]["fixes"][0]["text"].startswith(wanted)


def test_a_fix_of_a_word_that_was_left_alone_says_so():
    text = (PROGRAMS / "shaft.nc").read_text()
    _, (only,) = fixes_after(text, {"Z": -60}, line=69)
    assert only["alone"] == "changes B135., which you left alone"
    _, fixes = fixes_after(
        "G18 G1 X40. Z0.\nG1 Z-20. ,R2.\nX70. Z-35. ,C1.\nZ-60.", {"X": 40}, control="fanuc-lathe", **START
    )
    beside = [fix for fix in fixes if "program line 1" in fix["text"]]
    assert {fix["alone"] for fix in beside} == {"changes X40., which you left alone"}
    broken = explore.begin("G111 X100. A180. K-30. B120. P60.", **START)
    assert {fix["alone"] for each in view_of(broken)["findings"] for fix in each["fixes"]} == {""}
