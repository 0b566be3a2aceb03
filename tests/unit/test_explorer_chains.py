"""The explorer of chains of lines and arcs: words are moved as Klartext spells them, FSELECT chooses."""

import json
import random

import pytest

from contoursolve import Status
from contoursolve.controls.heidenhain.rules import RULES
from contoursolve.notebook import exploration as explore
from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration_view import picture_of, view_of

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
ACCEPTED = {text for rule in RULES if rule.code.startswith("heidenhain-") for text in rule.accepted} - {APART}
PROGRAMS = (LINES, PARTED, POLAR, CLOSED, OPEN, CONFLICTING)


def begin(text: str):
    return explore.begin(text, control="heidenhain")


def keys(now) -> list[str]:
    return [each["key"] for each in view_of(now)["fields"]]


def test_words_are_spelled_as_klartext_spells_them():
    now = explore.set_words(begin(POLAR), {"IX": 21.5, "R": 22, "AN": -10})
    assert "5 FCT IX+21.5 DR- R22 CCA+90 RX 3" in now.text
    assert "4 FL AN-10\n" in now.text
    assert "4 FL AN+30.5\n" in explore.set_word(now, "AN", 30.5).text
    freed = explore.free(begin(LINES), "X")
    assert "3 FL X? Y+20" in freed.text
    assert explore.free(freed, "X").text == LINES


def test_what_only_says_which_facts_hold_has_no_slider():
    assert keys(begin(POLAR)) == ["PR", "4:PA", "AN", "IX", "R", "CCA", "IPR", "7:PA"]
    now = begin(CLOSED)
    shown = {key.rpartition(":")[2] for key in keys(now)}
    assert not shown & {"DR", "CLSD", "FCT", "FLT"}
    with pytest.raises(ValueError, match="DR has no value to move"):
        explore.set_word(now, "DR", -1)


def test_a_solution_is_chosen_by_fselect_behind_its_element():
    now = begin(PARTED)
    assert now.answer.status is Status.AMBIGUOUS
    numbers = {each["selects"]: each["number"] for each in view_of(now)["solutions"]["items"]}
    chosen = explore.select(now, numbers["FSELECT 2 after line 2"])
    assert "P1Y+10\nFSELECT 2\n3 FL" in chosen.text
    assert chosen.answer.contour.points["P2"] == pytest.approx((-37.947, -12.649), abs=1e-3)
    back = explore.select(chosen, numbers["FSELECT 1 after line 2"])
    assert back.text == chosen.text.replace("FSELECT 2", "FSELECT 1")
    assert back.answer.contour.points["P2"] == pytest.approx((37.947, 12.649), abs=1e-3)


def test_a_solution_is_shown_before_it_is_chosen():
    talk = Conversation(begin(PARTED))
    for item in view_of(talk.exploration)["solutions"]["items"]:
        ghost = talk.answer({"do": "ghost", "solution": item["number"]})["ghost"]
        assert item["selects"].partition(" after")[0] in ghost["text"]
        assert ghost["paths"]


@pytest.mark.parametrize("text", [POLAR, CLOSED])
def test_points_centres_angles_and_radii_can_be_taken_hold_of(text):
    """A word a little farther, solved and drawn in the same frame, is where the derivatives of the word put it."""
    now = begin(text)
    drawn = picture_of(now.answer)
    view = view_of(now, drawn)
    assert {each["kind"] for each in view["handles"]} == {"point", "angle", "size"}
    assert any(each["name"].startswith("C") for each in view["handles"])
    values = {each["key"]: each["value"] for each in view["fields"]}
    for key in {key for handle in view["handles"] for key in handle["moves"]}:
        moved = explore.set_word(now, key, values[key] + 0.002)
        assert moved.answer.contour is not None
        after = view_of(moved, picture_of(moved.answer, drawn))
        there = {each["name"]: each["places"] for each in after["elements"]}
        for element in view["elements"]:
            for before, slopes, found in zip(element["places"], element["slopes"], there[element["name"]], strict=True):
                wanted = [at + 0.002 * by for at, by in zip(before, slopes.get(key, (0, 0)), strict=True)]
                assert found == pytest.approx(wanted, abs=5e-4), (key, element["name"])


def test_words_that_say_something_twice_have_no_handles():
    moved = {key for each in view_of(begin(CLOSED))["handles"] for key in each["keys"]}
    assert moved.isdisjoint({"8:X", "8:Y"})
    assert {"LEN", "R", "7:X"} <= moved


@pytest.mark.slow
def test_what_lacks_is_offered():
    now = begin(OPEN)
    fixes = [fix for finding in view_of(now)["findings"] for fix in finding["fixes"]]
    assert any("R?" in fix["text"] for fix in fixes)
    assert all(explore.apply_fix(now, fix["finding"], fix["number"]).answer is not None for fix in fixes)


def test_a_fix_that_drops_a_line_writes_no_other_twice():
    text = FRAME.format("2 L X+40 Y+0\n3 RND R5\n4 L X+60 Y+0\n5 L X+60 Y+20")
    now = begin(text)
    fixes = view_of(now)["findings"][0]["fixes"]
    number = next(at for at, fix in enumerate(fixes) if "delete RND R5" in fix["text"])
    assert explore.apply_fix(now, 0, number).text == text.replace("3 RND R5\n", "")


def test_a_corner_beside_a_departure_is_no_contour():
    assert APART in {text for rule in RULES for text in rule.accepted}
    assert begin(APART).answer is None


def act(talk: Conversation, rng: random.Random) -> dict[str, object] | None:
    """Something that a reader can do now."""
    view = talk.state["view"]
    fields = [each for each in view["fields"] if each["value"] is not None]
    fixes = [fix for finding in view["findings"] for fix in finding["fixes"]]
    solutions = [each for each in view["solutions"]["items"] if each["selects"]]
    kind = rng.choice(("move", "drag", "free", "pin", "range", "fix", "ghost", "select", "solution", "undo", "redo"))
    if kind == "move" and fields:
        field = rng.choice(fields)
        value = rng.choice((rng.uniform(field["low"], field["high"]), 0, -field["value"]))
        return {"do": "move", "values": {field["key"]: value}}
    if kind == "drag" and view["handles"]:
        handle = rng.choice(view["handles"])
        values = {each["key"]: each["value"] + rng.uniform(-2, 2) for each in fields if each["key"] in handle["keys"]}
        return {"do": "move", "values": values, "is_held": True, "handle": {handle["name"]: list(handle["keys"])}}
    if kind in ("free", "pin", "range") and view["fields"]:
        return {"do": kind, "key": rng.choice(view["fields"])["key"]}
    if kind in ("fix", "ghost") and fixes:
        fix = rng.choice(fixes)
        return {"do": kind, "finding": fix["finding"], "fix": fix["number"]}
    if kind in ("select", "solution") and solutions:
        return {"do": "select" if kind == "select" else "ghost", "solution": rng.choice(solutions)["number"]}
    return {"do": kind} if kind in ("undo", "redo") else None


@pytest.mark.parametrize(
    ("text", "times"),
    [
        *((text, 6) for text in (LINES, POLAR)),
        *(pytest.param(text, 12, marks=pytest.mark.slow) for text in (*PROGRAMS, *sorted(ACCEPTED))),
    ],
)
def test_whatever_the_reader_does_goes_without_trouble(text, times):
    talk, rng = Conversation(begin(text)), random.Random(f"chains {text}")
    for _ in range(times):
        action = act(talk, rng)
        if action is None:
            continue
        changed = talk.answer(action)
        json.dumps(changed, allow_nan=False)
        view = talk.state["view"]
        assert not view["trouble"], action
        # A fix may delete the only corner between plain moves, which leaves no contour.
        is_left = any(word in talk.exploration.text for word in ("FL", "FC", "FPOL", "RND", "CHF", "CT"))
        assert view["picture"] or not is_left, action


def test_a_corner_whose_size_is_freed_beside_points_that_are_open_is_told():
    """A path whose corner has no size cannot be measured: no other point is tried as a cut."""
    text = (
        "0 BEGIN PGM HEART MM\n1 L X+0 Y-40 RR F300\n2 FL X+35 Y+5\n3 RND R6\n4 FL X+20 Y+30\n5 RND R8\n"
        "6 FL X+0 Y+15\n7 FL X-20 Y+30\n8 RND R8\n9 FL X-35 Y+5\n10 RND R6\n11 FL X+0 Y-40\n12 L Y-60 R0 FMAX\n"
        "13 END PGM HEART MM"
    )
    now = begin(text)
    corners = [key for key, word in explore.words_of(now.answer).items() if word.text.endswith("R6")]
    assert len(corners) == 2
    for key in corners:
        freed = explore.free(now, key)
        assert "open" in freed.result.diagnostics[0].message
        assert explore.free(freed, key).text == text
