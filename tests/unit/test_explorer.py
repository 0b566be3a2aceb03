"""The explorer: a block is changed word by word, and what is shown is always what the block comes to."""

import json
import random
import re
import subprocess
import sys
from base64 import b64decode
from importlib.resources import files
from pathlib import Path

import pytest

import contoursolve
from contoursolve import CONTROLS, Status
from contoursolve.notebook import Conversation, begin

WHOLE = "G111 X100. A180. K-30. B120. P5. Q5."
START = {"start": "X40. Z0."}
PAIR = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87"
PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
TURNED = {**START, "control": "fanuc-lathe"}
CHAIN = "G18 G1 X40. Z0.\nG1 Z-20. ,R2.\nX70. Z-35. ,C1.\nZ-60."


class Talk:
    """A reader who changes a contour, and what is shown then."""

    def __init__(self, text, *facts, **options):
        self.own = Conversation(begin(text, facts, **options))

    def do(self, kind, **action):
        self.own.answer({"do": kind, **action})
        return self

    def move(self, is_held=False, **values):
        return self.do("move", values=values, is_held=is_held)

    @property
    def text(self):
        return self.own.exploration.text

    @property
    def answer(self):
        return self.own.exploration.answer

    @property
    def view(self):
        return self.own.state["view"]

    @property
    def fixes(self):
        return [fix for finding in self.view["findings"] for fix in finding["fixes"]]

    def fix(self, fix):
        return self.do("fix", finding=fix["finding"], fix=fix["number"])

    def field(self, key):
        return next(each for each in self.view["fields"] if each["key"] == key)

    def range(self, key):
        return self.do("range", key=key).own.state["ranges"].get(key, {})

    def has_contour(self, key, value):
        """Whether there is one at another value of a word."""
        found = self.do("move", values={key: value}).answer.contour is not None
        assert not self.view["trouble"]
        self.do("undo")
        return found


@pytest.mark.parametrize(
    ("key", "value", "text"),
    [
        ("P", 7.12349, "G111 X100. A180. K-30. B120. P7.123 Q5."),
        ("A", "-170", "G111 X100. A-170. K-30. B120. P5. Q5."),
        ("K", "-22,5", "G111 X100. A180. K-22.5 B120. P5. Q5."),
        ("X", 90, "G111 X90. A180. K-30. B120. P5. Q5."),
    ],
)
def test_a_word_is_written_as_the_control_reads_it(key, value, text):
    now = Talk(WHOLE, **START).move(**{key: value})
    assert now.text == text
    assert now.field(key)["value"] == float(re.search(rf"{key}(\S+)", text)[1])


def test_a_word_in_inches_has_four_decimals():
    moved = Talk("G111 X4. A180. K-1. B120. P.2", start="X2. Z0.", units="inch").move(P=0.12345)
    assert moved.text == "G111 X4. A180. K-1. B120. P0.1234"
    assert (moved.field("P")["value"], moved.field("P")["unit"]) == (0.1234, "in")


@pytest.mark.parametrize(
    ("action", "told"),
    [
        ({"do": "move", "values": {"Z": 1}}, "the contour has no word Z; there are X, A, K, B, P, Q"),
        ({"do": "move", "values": {"P": "x"}}, "P"),
        ({"do": "move", "values": {"P": float("nan")}}, "P"),
        ({"do": "move", "values": {"P": ""}}, "P"),
        ({"do": "move", "values": {"P": "1.060,5"}}, "P"),
        ({"do": "move", "values": {"P": "1e9"}}, "P takes numbers below 1,000,000,000, not 1e9"),
        ({"do": "move", "values": "P"}, ""),
        ({"do": "move"}, "KeyError"),
        ({"do": "fix", "finding": 7, "fix": 0}, ""),
        ({"do": "fix", "finding": None, "fix": 0}, "TypeError"),
        ({"do": "select", "solution": 3}, ""),
        ({"do": "nothing"}, "nothing is called 'nothing' here"),
        ({}, ""),
    ],
    ids=str,
)
def test_what_makes_no_sense_changes_nothing_and_is_told(action, told):
    talk = Conversation(begin(WHOLE, **START))
    talk.answer({**action, "number": 4})
    assert (talk.exploration.text, talk.state["number"]) == (WHOLE, 4)
    assert talk.state["view"]["trouble"].startswith(told)
    assert talk.state["view"]["trouble"] != ""


def test_a_freed_word_gets_the_value_that_the_others_give_or_its_own_back():
    now = Talk(WHOLE, "straight part of line 2 = 20", **START)
    assert now.text == f"{WHOLE} (contoursolve: straight part of line 2 = 20)"
    now.do("free", key="P")
    assert now.text.startswith(WHOLE.replace("P5.", "P?"))
    # Line 2 has 30/sin(120) mm, of which both corners take tan(30) of their radius.
    assert now.field("P")["state"] == "free"
    assert now.field("P")["value"] == pytest.approx((30 / 0.75**0.5 - 20) * 3**0.5 - 5)
    given = now.do("free", key="P")
    assert "P20.359 " in given.text
    assert given.answer.contour is not None
    open_ = Talk(WHOLE, **START).do("free", key="A")
    assert (open_.answer.status, open_.field("A")["value"]) == (Status.UNDERDETERMINED, None)
    assert open_.do("free", key="A").text == WHOLE
    assert open_.do("undo").move(A=175).text == WHOLE.replace("A180.", "A175.")


def test_a_freed_word_is_drawn_with_where_it_may_lead():
    freed = Talk(WHOLE, **START).do("free", key="X")
    picture = freed.view["picture"]
    assert [text for text in ("end (free)", "other values", "Z-30 X40") if text not in picture] == []
    assert not re.search(r"end\s*</tspan>", picture)  # V1 is no end
    # U would say what X does.
    assert [fix["text"] for fix in freed.fixes] == [
        "add Z? (such as Z-70., Z-32.114 or below)",
        "add W? (such as W-70., W-32.114 or below)",
    ]
    assert [freed.range(key).keys() for key in "AKBP"] == [{"frame"}] * 4  # another word is missing


def test_changes_are_undone_and_made_again_and_what_is_held_is_one_change():
    now = Talk(WHOLE, **START).move(P=6).move(P=7)
    assert (now.view["can_undo"], now.view["can_redo"]) == (True, False)
    texts = [now.do(kind).text[-7:] for kind in ("undo", "undo", "undo", "redo", "undo", "redo", "redo", "redo")]
    assert texts == [f"P{size}. Q5."[-7:] for size in (6, 5, 5, 6, 5, 6, 7, 7)]
    now.move(is_held=True, P=8).move(is_held=True, P=9)
    assert now.view["is_held"]
    assert now.do("release").do("undo").text == WHOLE.replace("P5.", "P7.")
    assert now.do("redo").move(is_held=True, P=11).move(is_held=True, P=12).do("cancel").text[-7:] == "P9. Q5."
    assert now.do("pin", key="P").field("P")["is_pinned"]
    assert now.do("write", text=f"{WHOLE} M8").text == f"{WHOLE} M8"
    assert (now.do("reset").text, now.view["is_changed"]) == (WHOLE, False)


def test_each_fix_gives_the_block_that_it_promises():
    now = Talk("G111 X100. A180. K-30. B120. P60.", **START)
    assert len(now.fixes) >= 2
    for fix in now.fixes:
        assert now.fix(fix).answer.status is Status.SOLVED
        now.do("undo")
    chain = Talk(PAIR, rules="off")
    assert {chain.fix(fix).text for fix in chain.fixes for chain in [Talk(PAIR, rules="off")]} == {
        f"{PAIR} Q-1",
        f"{PAIR} Q1",
    }


TANGENT = "line 2 tangent to circle (Z-40. X120. R10.)"


@pytest.mark.parametrize(
    ("text", "facts", "options", "stays"),
    [
        (PAIR, (), {"rules": "off"}, None),
        (f"{PAIR} Q1", (), {}, None),
        ("G111 X100. A180. K-30. B?", (TANGENT,), START, ()),
        ("G111 X100. A180. K-30. B? P?", (TANGENT, "straight part of line 2 = 5"), START, ()),
        ("G111 A180. K-30. B?", ("X of V2 = 100", TANGENT), START, ("X of V2 = 100",)),
    ],
    ids=["nothing chooses", "a word chooses", "a fact", "two facts", "one and what is stated besides"],
)
def test_each_solution_can_be_selected_and_takes_the_place_of_what_asked_for_it(text, facts, options, stays):
    now = Talk(text, *facts, **options)
    whole, items = now.text, now.view["solutions"]["items"]
    assert len(items) == 2
    ends = set()
    for item in items:
        ghost = now.do("ghost", solution=item["number"]).own.state["ghost"]
        assert ghost["solution"] == item["number"]
        chosen = now.do("select", solution=item["number"])
        assert chosen.answer.status is Status.SOLVED, chosen.text
        assert ghost["text"] == chosen.own.exploration.block
        if stays is not None:
            assert "?" not in chosen.text
            assert "tangent" not in chosen.text
            assert [fact for fact in stays if fact not in chosen.text] == []
        ends.add(tuple(round(value, 2) for at in chosen.answer.contour.points.values() for value in at))
        assert now.do("reset").text == whole
    assert len(ends) == 2


LOOP = "#1=5\nWHILE [#1 LT 8] DO1\nG0 X40. Z0.\nG1 Z-30. ,R#1\nX100. ,A120.\n#1=#1+1\nEND1\nM30"


@pytest.mark.parametrize(
    ("text", "line", "told"),
    [
        ("shaft.nc", None, r"this text has 7 \(program lines 53, 67"),
        ("shaft.nc", 1, r"^program line 1 belongs to no contour; contours begin in program lines 53, 67"),
        ("G00 X40. Z0.", 1, r"^program line 1 belongs to no contour; the program has none$"),
        (LOOP, 4, r"^program line 4 makes 3 contours, one each time it runs; explore its block alone"),
    ],
    ids=["all", "other", "none", "loop"],
)
def test_one_contour_is_explored_at_a_time(text, line, told):
    control = None if text == "shaft.nc" else "fanuc-lathe"
    text = (PROGRAMS / text).read_text() if text == "shaft.nc" else text
    with pytest.raises(ValueError, match=told):
        contoursolve.explore(text, line=line, control=control)


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
    now = Talk(text, line=line)
    assert now.answer.contour == contoursolve.solve(text).contour_at(line).contour
    lines = now.answer.lines
    first, last = lines[0], lines[-1]
    block = now.view["text"]
    assert block.split("\n") == text.split("\r\n")[first - 1 : last]
    found = now.range(key)
    assert "of block" not in found["reason"] or ":" in key
    for stops, ends in zip(found["stops"], found["ends"], strict=True):
        for value, told in zip(stops, ends, strict=True):
            if told:
                now.do("move", values={key: value})
                assert (now.answer.contour is not None, now.answer.lines) == (True, lines)
                assert {*changed_lines(text, now.text)} <= {*range(first, last + 1)}
                now.do("undo")
    broken = now.do("write", text=f"(LOOK)\n{block}\n(LOOKED)")
    assert broken.text.split("\r\n")[first - 1] == "(LOOK)"
    assert broken.answer.lines[0] == first + 1
    assert broken.do("program", text=text).answer.lines[0] == first
    assert broken.do("reset").text == text
    if name == "shaft.nc":
        told = now.do("write", text=f"{block}\n{block}").view["trouble"]
        assert told == "one contour can be explored at a time; this block has 2 (program lines 68, 69)"


@pytest.mark.slow
def test_a_contour_of_a_broken_program_has_its_own_findings_and_fixes():
    text = (PROGRAMS / "shaft_broken.nc").read_text()
    now = Talk(text, line=21)
    block = now.own.exploration.block
    assert now.view["elsewhere"] == "The rest of the program has 4 errors, the first in program line 13."
    fixed = now.fix(now.fixes[0])
    assert ([*changed_lines(text, fixed.text)], fixed.answer.status) == ([21], Status.SOLVED)
    stated = Talk(text, "straight part of line 1 = 5", line=21)
    assert changed_lines(text, stated.text)[21].endswith("(contoursolve: straight part of line 1 = 5)\n")
    now = Talk(text, line=21)
    now.do("program", text="".join(each for each in text.splitlines(keepends=True) if "N310" not in each))
    assert (now.answer, now.view["text"], now.view["status"]["text"]) == (None, "", "no contour")
    assert now.do("write", text=block).text == text


def test_the_traits_of_a_line_are_those_of_the_program_and_variables_are_numbers():
    text = "#100=40.\nG00 X#100 Z0.\nG111 X#101 A180. K-30. B120. P5.\nG111 A180. W-20. B90. U10."
    widget = contoursolve.explore(text, line=3, control="yasnac-lx3", variables={"#101": 95})
    assert widget.text == text.replace("#101", "95.")
    seen = []
    widget.observe(lambda change: seen.append(change["name"]), ["text", "values", "answer"])
    widget.values = {"X": 100, "A": 170.0}
    assert widget.text == text.replace("X#101 A180.", "X100. A170.")
    assert {*seen} == {"text", "values", "answer"}
    # Line 2 goes up by 30 mm less what line 1 rises, at 120 degrees.
    assert widget.answer.contour.end == pytest.approx((-44.2664, 50), abs=1e-4)
    widget.text = text.replace("X#101", "X90.").replace("B90", "B100")
    assert (widget.values["X"], widget.view["text"]) == (90, "G111 X90. A180. K-30. B120. P5.")
    for name, wrong in (("values", {"Q": 1.0}), ("values", {"A": "x"})):
        with pytest.raises(ValueError, match=r"Q|x"):
            setattr(widget, name, wrong)
        assert (widget.values["X"], widget.values["A"]) == (90, 180)


def test_the_control_stays_when_what_shows_it_is_taken_out():
    with pytest.raises(contoursolve.errors.UnknownControlError):
        begin("G111 A180. K-30. B120. X80.\nG1 X-50 RND=2\nZ-90")
    now = Talk(f"{PAIR} Q-1")
    now.do("write", text=now.text.replace(",A171.87 Q-1", ""))
    assert (now.own.exploration.result.control, now.answer) == ("nct-99m", None)
    assert now.view["status"]["text"] == "no contour"
    assert now.do("reset").answer.status is Status.SOLVED


FRAME = "0 BEGIN PGM A MM\n1 L X+0 Y+0\n{}\n99 END PGM A MM"
LINES = FRAME.format("2 FL AN+60\n3 FL X+80 Y+20 AN-30")
PARTED = FRAME.format("2 FL LEN40 P1X+30 P1Y+10\n3 FL X+80 Y+20")
POLAR = FRAME.format(
    "2 FPOL X+10 Y+10\n3 FL PR+20 PA+20\n4 FL AN+45\n5 FCT IX+20 DR- R20 CCA+90 RX 3\n6 FL IPR+35 PA+0 RPR 3"
)
CLOSED = FRAME.format(
    "2 FL AN+80 LEN50 CLSD+\n3 FCT DR- R15\n4 FLT X+90 Y+40\n5 RND R8\n6 FL X+90 Y+0\n7 FL X+0 Y+0 CLSD-"
)
OPEN = FRAME.format("2 FL AN+0\n3 FCT DR+\n4 FLT X+50 Y+60")
CONFLICTING = FRAME.format("2 FL AN+60 LEN50\n3 FL X+80 Y+20 AN-30")
# A corner beside a departure is not solved, so that there is nothing to draw.
APART = FRAME.format("2 L X+40 Y+0\n3 RND R5\n4 DEP LT LEN5").replace("99 END", "5 END")
TNC = {"control": "heidenhain"}


def test_of_many_solutions_the_first_are_shown_and_that_is_said():
    arcs = [f"FC X+{20 * number} Y+0 R+15 DR-" for number in range(1, 6)]
    told = Talk("\n".join(["L X+0 Y+0 R0 F500", *arcs, "L Y+50"]), **TNC).view["solutions"]
    assert told["text"] == "32 solutions; these are all (by closed form); the first 24 are shown"
    assert len(told["items"]) == 24
    assert told["items"][1]["selects"].endswith("FSELECT 1 after arc 4, FSELECT 2 after arc 5")


RULES = [rule for rule in CONTROLS["heidenhain"].catalogue if rule.code.startswith("heidenhain-")]
ACCEPTED = {text for rule in RULES for text in rule.accepted} - {APART}
READ = [
    *((text, START, seed) for text in (WHOLE, "G112 X60. I10. K-8. R10. P1. Q1.") for seed in range(2)),
    (f"{PAIR} Q-1", {}, 0),
    *((text, TNC, 0) for text in (LINES, PARTED, POLAR, CLOSED, OPEN, CONFLICTING, *sorted(ACCEPTED)[::6])),
]


def act(talk, rng):
    """Something that a reader can do now."""
    view = talk.view
    fields = [each for each in view["fields"] if each["value"] is not None]
    solutions = [each for each in view["solutions"]["items"] if each["selects"]]
    kind = rng.choice(
        ("move", "drag", "free", "pin", "range", "fix", "ghost", "select", "solution", "undo", "redo", "write")
    )
    if kind == "move" and fields:
        field = rng.choice(fields)
        value = rng.choice((rng.uniform(field["low"], field["high"]), 0, -field["value"]))
        return {"do": "move", "values": {field["key"]: value}}
    if kind == "drag" and view["handles"]:
        handle = rng.choice(view["handles"])
        values = {each["key"]: each["value"] + rng.uniform(-2, 2) for each in fields if each["key"] in handle["keys"]}
        return {"do": "move", "values": values, "is_held": True, "handle": {handle["name"]: list(handle["keys"])}}
    written = [each["key"] for each in view["fields"] if each["state"] != "computed"]
    if kind in ("free", "pin", "range") and written:
        return {"do": kind, "key": rng.choice(written)}
    if kind in ("fix", "ghost") and talk.fixes:
        fix = rng.choice(talk.fixes)
        return {"do": kind, "finding": fix["finding"], "fix": fix["number"]}
    if kind in ("select", "solution") and solutions:
        return {"do": "select" if kind == "select" else "ghost", "solution": rng.choice(solutions)["number"]}
    if kind == "write":
        return {"do": kind, "text": view["text"] + rng.choice((" P1.", "(", ""))}
    return {"do": kind if kind in ("undo", "redo") else "release"}


@pytest.mark.slow
@pytest.mark.parametrize(("text", "options", "seed"), READ)
def test_whatever_the_reader_does_the_view_shows_what_the_text_comes_to(text, options, seed):
    talk, rng = Talk(text, **options), random.Random(f"explorer {text} {seed}")
    for _ in range(5):
        action = act(talk, rng)
        changed = talk.own.answer(action)
        json.dumps(changed, allow_nan=False)
        assert not talk.view["trouble"] or action["do"] == "write", action
        fresh = contoursolve.solve(talk.text, **options)
        told = [each.message for each in talk.own.exploration.result.diagnostics]
        assert [each.message for each in fresh.diagnostics] == told
        for each in talk.view["fields"]:
            if each["state"] == "given":
                assert each["low"] <= each["value"] <= each["high"]
        # A fix may delete the only corner between plain moves, which leaves no contour.
        assert talk.view["picture"] or talk.answer is None, action
    assert talk.do("reset").text == text


@pytest.mark.parametrize("key", "XAKBPQ")
def test_a_range_on_a_slider_ends_where_single_solves_say_so(key):
    now = Talk(WHOLE, **START)
    found, field = now.range(key), now.field(key)
    assert found["low"] <= field["low"] or found["low"] > -10_000
    notes = {"P": "0 ≤ P ≤ 51.961", "A": "138.219 ≤ A ≤ 269.998"}
    assert found["note"] == notes.get(key, found["note"])
    for low, high in found["intervals"]:
        for end, inward in ((low, 1), (high, -1)):
            if found["low"] < end < found["high"]:
                steps = (end + inward * 0.002, end - inward * 0.002)
                assert [now.has_contour(key, value) for value in steps] == [True, False]


@pytest.mark.parametrize(
    ("text", "options"),
    [
        (WHOLE, START),
        (f"{PAIR} Q-1", {}),
        (CHAIN, TURNED),
        ("G111 X100. A180. K-30. B? P5. Z-50.", START),
        ("G111 X100. A180. K-30. B120. P? (contoursolve: straight part of line 2 = 20)", START),
        (POLAR, TNC),
        (CLOSED, TNC),
    ],
    ids=["G111", "pair", "chain", "asked", "fact", "polar", "closed"],
)
def test_what_is_drawn_moves_as_its_derivatives_say(text, options):
    """A word a little farther, solved and drawn in the same frame, is where the derivatives of the word put it."""
    now, step = Talk(text, **options), 0.002
    view = now.view
    assert {each["kind"] for each in view["handles"]} >= {"point"}
    for key in {key for handle in view["handles"] for key in handle["keys"]}:
        value = now.field(key)["value"]
        after = now.do("move", values={key: value + step}, is_held=True).view
        assert now.field(key)["value"] == pytest.approx(value + step)
        assert after["frame"] == view["frame"]
        there = {each["name"]: each["places"] for each in after["elements"]}
        for element in view["elements"]:
            for before, slopes, found in zip(element["places"], element["slopes"], there[element["name"]], strict=True):
                wanted = [at + step * by for at, by in zip(before, slopes.get(key, (0, 0)), strict=True)]
                assert found == pytest.approx(wanted, abs=5e-4), (key, element["name"])
        grips = {each["name"]: each["at"] for each in after["handles"]}
        for handle in view["handles"]:
            if key in handle["moves"] and handle["kind"] == "point":
                wanted = [at + step * by for at, by in zip(handle["at"], handle["moves"][key], strict=True)]
                assert grips[handle["name"]] == pytest.approx(wanted, abs=5e-4), (key, handle["name"])
        now.do("cancel")


def test_words_that_say_something_twice_have_no_handles():
    view = Talk(CLOSED, **TNC).view
    moved = {key for each in view["handles"] for key in each["keys"]}
    assert moved & {"8:X", "8:Y", "LEN", "R", "7:X"} == {"LEN", "R", "7:X"}
    assert {each["kind"] for each in view["handles"]} == {"point", "angle", "size"}
    assert len([each for each in view["handles"] if each["name"].startswith("C")]) >= 1


@pytest.mark.parametrize(
    ("name", "line", "key", "short", "whole"),
    [
        ("roller.nc", 27, "K", "-9 ≤ K ≤ 9 but 0", ""),
        ("roller.nc", 25, "X", "X ≤ 8 or X ≥ 16", ""),
        ("plate.nc", 20, ",A", "-7.88 ≤ ,A ≤ 51.483 but about 14.62", ""),
        (
            *("plate.nc", 25, "J", "-96 ≤ J ≤ 3 or J ≥ 786 (at least)"),
            "-96.146 ≤ J ≤ 3.334 or J ≥ 785.876 (at least)",
        ),
        (
            *("plate.nc", 64, "64:Z", "-28.643 ≤ Z ≤ -28.374 or 4.68 ≤ Z ≤ 6.56 and 1 more"),
            "-28.643 ≤ Z ≤ -28.374 or 4.675 ≤ Z ≤ 6.561 or 40.623 ≤ Z ≤ 40.643",
        ),
    ],
)
def test_many_ranges_are_told_in_a_line_and_nothing_is_left_out_silently(name, line, key, short, whole):
    now = Talk((PROGRAMS / name).read_text(), line=line)
    found = now.range(key)
    assert (found["note"], found["whole"]) == (short, whole)
    inside = [float(each) for each in re.findall(r"-?[\d.]+(?= ≤ \w)|(?<= ≤ )-?[\d.]+|(?<= ≥ )-?[\d.]+", short)]
    assert [value for value in inside if not now.has_contour(key, value)] == []


def test_a_value_at_which_the_other_words_agree_is_one_to_catch():
    now = Talk("G18 G1 X40. Z0.\nG1 X50. ,A170. ,R3.\n,A120. Z-60. X80.\nX80. Z-90.", control="fanuc-lathe")
    assert now.answer.contour is None
    snaps = {each["text"]: each["value"] for each in now.range("3:,A")["snaps"]}
    assert snaps["as the other words say"] == pytest.approx(154.638, abs=1e-3)
    assert snaps["in line with ,A170."] == 350
    assert now.has_contour("3:,A", snaps["as the other words say"])


# Words as Klartext spells them; FSELECT chooses ---------------------------------------------------------------


def test_words_are_spelled_as_klartext_spells_them():
    now = Talk(POLAR, **TNC).move(IX=21.5, R=22, AN=-10)
    assert "5 FCT IX+21.5 DR- R22 CCA+90 RX 3" in now.text
    assert "4 FL AN-10\n" in now.text
    assert "4 FL AN+30.5\n" in now.move(AN=30.5).text
    freed = Talk(LINES, **TNC).do("free", key="X")
    assert "3 FL X? Y+20" in freed.text
    assert freed.do("free", key="X").text == LINES


def test_what_only_says_which_facts_hold_has_no_slider():
    keys = [each["key"] for each in Talk(POLAR, **TNC).view["fields"]]
    assert keys == ["PR", "4:PA", "AN", "IX", "R", "CCA", "IPR", "7:PA"]
    now = Talk(CLOSED, **TNC)
    assert {each["key"].rpartition(":")[2] for each in now.view["fields"]} & {"DR", "CLSD", "FCT", "FLT"} == set()
    assert "DR has no value to move" in now.move(DR=-1).view["trouble"]


def test_a_solution_is_chosen_by_fselect_behind_its_element():
    now = Talk(PARTED, **TNC)
    assert now.answer.status is Status.AMBIGUOUS
    for number, end in ((2, (-37.947, -12.649)), (1, (37.947, 12.649))):
        items = {each["selects"].partition(" after ")[0]: each["number"] for each in now.view["solutions"]["items"]}
        solution = items[f"FSELECT {number}"]
        ghost = now.do("ghost", solution=solution).own.state["ghost"]
        assert f"FSELECT {number}" in ghost["text"]
        assert len(ghost["paths"]) >= 1
        now.do("select", solution=solution)
        assert f"P1Y+10\nFSELECT {number}\n3 FL" in now.text
        assert now.answer.contour.points["P2"] == pytest.approx(end, abs=1e-3)


def test_a_fix_that_drops_a_line_writes_no_other_twice():
    text = FRAME.format("2 L X+40 Y+0\n3 RND R5\n4 L X+60 Y+0\n5 L X+60 Y+20")
    now = Talk(text, **TNC)
    (fix,) = (fix for fix in now.fixes if "delete RND R5" in fix["text"])
    assert now.fix(fix).text == text.replace("3 RND R5\n", "")


def test_a_corner_beside_a_departure_is_no_contour():
    assert APART in {text for rule in RULES for text in rule.accepted}
    assert Talk(APART, **TNC).answer is None


def test_a_corner_whose_size_is_freed_beside_points_that_are_open_is_told():
    """A path whose corner has no size cannot be measured: no other point is tried as a cut."""
    text = (
        "0 BEGIN PGM HEART MM\n1 L X+0 Y-40 RR F300\n2 FL X+35 Y+5\n3 RND R6\n4 FL X+20 Y+30\n5 RND R8\n"
        "6 FL X+0 Y+15\n7 FL X-20 Y+30\n8 RND R8\n9 FL X-35 Y+5\n10 RND R6\n11 FL X+0 Y-40\n12 L Y-60 R0 FMAX\n"
        "13 END PGM HEART MM"
    )
    now = Talk(text, **TNC)
    corners = [each["key"] for each in now.view["fields"] if each["word"].endswith("R6")]
    assert len(corners) == 2
    for key in corners:
        assert "open" in now.do("free", key=key).answer.diagnostics[0].message
        assert now.do("free", key=key).text == text


# The widget, and fixes after a change -----------------------------------------------------------------------


@pytest.fixture
def widget():
    return contoursolve.explore(WHOLE, **START)


def test_the_widget_answers_each_action_by_its_number(widget):
    widget.action = {"do": "move", "values": {"P": 60}, "number": 1}
    assert (widget.number, widget.view["status"]["text"], widget.view["trouble"]) == (1, "cannot be cut", "")
    assert widget.text == WHOLE.replace("P5.", "P60.")
    assert widget.result.answers[0].status is Status.NO_SOLUTION
    widget.action = {"do": "range", "key": "P", "number": 2}
    assert (widget.number, widget.ranges["P"]["intervals"][0][0]) == (2, 0)
    widget.action = {"do": "fix", "finding": 0, "fix": 0, "number": 3}
    assert widget.view["status"]["text"] == "solved"


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


def test_the_front_end_sets_texts_and_loads_nothing():
    house = files("contoursolve.notebook")
    script, sheet = (house.joinpath(f"explorer.{kind}").read_text() for kind in ("js", "css"))
    wrong = r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|eval\(|import\(|fetch\(|XMLHttp"
    assert not re.search(wrong, script)
    asked = script.replace("// ", "").replace('"http://www.w3.org/2000/svg"', "") + sheet
    assert not re.search(r"https?:|//cdn|@import|url\(", asked)


def test_what_is_missing_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "anywidget", None)
    monkeypatch.delitem(sys.modules, "contoursolve.notebook.explorer", raising=False)
    with pytest.raises(contoursolve.errors.MissingExtraError) as error:
        contoursolve.explore(WHOLE, **START)
    install = f'{sys.executable} -m pip install "contoursolve[notebook]"'
    assert str(error.value) == f"exploring a contour needs anywidget; install it with: {install}"


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
    ("text", "equations", "calculation"),
    [
        (WHOLE, "must not be parallel", "right triangle"),
        ("G111 X100. A180. B120.", "still open", "nothing to calculate"),
        (f"{WHOLE} (contoursolve: X of V1 = 40)", "the same", "triangle"),
        ("G01 X50.", "no contour", "no contour"),
    ],
    ids=["solved", "open", "tied", "none"],
)
def test_each_section_tells_what_the_block_comes_to(text, equations, calculation):
    now = Talk(WHOLE, **START).do("write", text=text)
    for name, words in (("equations", equations), ("calculation", calculation)):
        told = now.do("section", name=name).own.state["sections"][name]["html"]
        assert words in told.lower()
        assert 'words-"' not in told


@pytest.mark.parametrize(("key", "value"), [("A", 100), ("B", 200), ("X", 30)])
def test_what_the_reader_has_just_changed_is_the_first_to_be_changed_again(key, value):
    talk = Talk(WHOLE, **START).move(**{key: value})
    fixes = talk.view["findings"][0]["fixes"]
    first, *others = fixes
    assert (first["alone"], first["text"].startswith(f"write {key}")) == ("", True)
    told = {fix["alone"] for fix in others}
    assert key == "B" or "changes B120., which you left alone" in told
    assert {fix["number"] for fix in fixes} == {*range(len(fixes))}
    words = [text.split() for text in (talk.fix(first).view["text"], WHOLE)]
    assert {word[0] for word, old in zip(*words, strict=True) if word != old} == {key}
    assert talk.answer.contour is not None


@pytest.mark.parametrize(
    ("is_held", "wanted"), [(True, "write P51.961 for P60."), (False, "write P6. for P60. (a zero too many)")]
)
def test_a_number_that_was_pulled_is_no_slip_of_a_typist(is_held, wanted):
    talk = Talk(WHOLE, **START).move(is_held=is_held, P=60).do("release")
    assert talk.view["findings"][0]["fixes"][0]["text"].startswith(wanted)


def test_a_fix_of_a_word_that_was_left_alone_says_so():
    (only,) = Talk((PROGRAMS / "shaft.nc").read_text(), line=69).move(Z=-60).view["findings"][0]["fixes"]
    assert only["alone"] == "changes B135., which you left alone"
    fixes = Talk(CHAIN, **TURNED).do("move", values={"X": 40}).fixes
    assert {fix["alone"] for fix in fixes if "program line 1" in fix["text"]} == {"changes X40., which you left alone"}
    broken = Talk("G111 X100. A180. K-30. B120. P60.", **START)
    assert {fix["alone"] for fix in broken.fixes} == {""}
