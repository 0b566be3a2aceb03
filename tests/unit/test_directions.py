"""An angle whose direction is against the one that the other words give never agrees with them."""

import json
import re
from typing import Any

import pytest
from click.testing import CliRunner

from contoursolve import Diagnostic, Result, family, solve
from contoursolve.cli import main
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.diagnostics.finding import Tie
from contoursolve.solving import StatusCode

G111 = "G111 {A} I12. K-12. B180. Z-40."
CASES: dict[str, dict[str, Any]] = {
    "A of G111": {"control": "yasnac-lx3", "block": G111, "right": 135, "word": "A{}."},
    "A of G111 without rules": {
        "control": "yasnac-lx3", "block": G111, "right": 135, "word": "A{}.", "rules": "off"
    },
    "A of G111 with a word missing": {
        "control": "yasnac-lx3", "block": "G111 {A} I12. K-12. B180.", "right": 135, "word": "A{}.", "rules": "off"
    },
    "B of G111": {
        "control": "yasnac-lx3", "block": "G111 I12. K-12. {A} X64. Z-40.", "right": 180, "word": "B{}."
    },
    "B of G111 beside A": {
        "control": "yasnac-lx3", "block": "G111 A135. I12. {A} U24. W-40.", "right": 180, "word": "B{}."
    },
    "A of Mitsubishi": {
        "control": "mitsubishi", "block": "G17 G90 G01 X40. Y40. {A}", "right": 45, "word": "A{}."
    },
    "A of Mitsubishi with a corner": {
        "control": "mitsubishi", "block": "G17 G90 G01 X40. Y40. {A} ,R2.\nX80.", "right": 45, "word": "A{}."
    },
    "ANG of SINUMERIK": {
        "control": "siemens-840d", "block": "G17 G90 G1 X40 Y40 {A} RND=2\nX80", "right": 45, "word": "ANG={}"
    },
    "ANG of SINUMERIK that is checked": {
        "control": "siemens-840d", "block": "G17 G90 G1 X40 Y40 {A} RND=2\nX80", "right": 45, "word": "ANG={}",
        "settings": {"siemens-840d.redundant-angle": "check"},
    },
    "#ANG of ISG": {
        "control": "isg", "block": "G17 G90 G1 X40 Y40 {A} #RND=2\nX80", "right": 45, "word": "#ANG={}"
    },
    ",A of Fanuc": {
        "control": "fanuc-lathe", "block": "G01 X80. Z40. {A} ,R2.\nX120.", "right": 45, "word": ",A{}."
    },
    ",A of Fanuc as a direction": {
        "control": "fanuc-lathe", "block": "G01 X80. Z40. {A} ,R2.\nX120.", "right": 45, "word": ",A{}.",
        "settings": {"fanuc-lathe.angle-sense": "ray"},
    },
    "AN of FK": {
        "control": "heidenhain", "block": "FL X+40 Y+40 {A}\nFL X+80 AN+0", "right": 45, "word": "AN{:+g}"
    },
    "AN of FK beside LEN": {
        "control": "heidenhain", "block": "FL X+40 Y+30 LEN50 {A}\nFL X+80 AN+0", "right": 36.8699, "word": "AN{:+g}"
    },
    "a fact about a line": {
        "control": "yasnac-lx3", "block": "G111 I12. K-12. B180. W-40.", "right": 135,
        "fact": "direction of line 1 = {}",
    },
    "a fact about a line whose angle is given": {
        "control": "yasnac-lx3", "block": "G111 A135. K-12. B180. W-40.", "right": 135,
        "fact": "direction of line 1 = {}",
    },
    "a fact about an FK line": {
        "control": "heidenhain", "block": "FL X+40 Y+40\nFL X+80 AN+0", "right": 45, "fact": "direction of line 1 = {}"
    },
}  # fmt: skip

STARTS = {"yasnac-lx3": "X40. Z0.", "fanuc-lathe": "X0 Z0"}


def solved(name: str, angle: float) -> tuple[Result, str]:
    """What becomes of a case with an angle, and its word or its fact."""
    case = CASES[name]
    word, fact = (case.get(each, "").format(angle) for each in ("word", "fact"))
    options = {each: case[each] for each in ("rules", "settings") if each in case}
    start = STARTS.get(case["control"], "X0 Y0")
    block = case["block"].format(A=word)
    return solve(block, control=case["control"], start=start, facts=[fact] if fact else [], **options), word or fact


def told(finding: Diagnostic) -> str:
    return " ".join([finding.message, *finding.notes, *(label.text for label in finding.labels)])


def is_about(tie: Tie, word: str) -> bool:
    return any(word == each or word.rstrip("0123456789.+-=") == each for each in tie.addresses)


@pytest.mark.parametrize("turn", [180, pytest.param(-180, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", CASES)
def test_the_opposite_direction_never_agrees(name, turn):
    result, word = solved(name, CASES[name]["right"] + turn)
    texts = [told(each) for each in result.diagnostics if word in each.message]
    right = f"{CASES[name]['right']:.3f} deg"
    assert any(right in text or f"write A{CASES[name]['right']}." in text for text in texts), texts
    assert not any(re.search(r"\b(agrees|repeats|the same place)\b", text) for text in texts)
    for answer in result.answers:
        assert answer.diagnosis is not None
        assert all(tie.is_conflict for tie in answer.diagnosis.ties if is_about(tie, word))


@pytest.mark.parametrize("name", CASES)
def test_the_direction_itself_agrees(name):
    result, _ = solved(name, CASES[name]["right"])
    assert not any(
        claim in told(each) for each in result.diagnostics for claim in ("opposite", "disagrees", "other way")
    )
    for answer in result.answers:
        assert not any(tie.is_conflict for tie in (answer.diagnosis.ties if answer.diagnosis else ()))


def test_no_fix_leaves_a_direction_that_is_opposite():
    result, _ = solved("A of G111 without rules", -45)
    (finding,) = result.diagnostics
    assert [each.replacement for each in finding.fixes[:2]] == [G111.format(A="A135."), G111.replace("{A} ", "")]


def test_an_angle_of_a_line_without_length_says_nothing_against_it():
    block = "X2. Z-1. ,A341."
    result = solve(f"G00 X1. Z-5.\nG01 X2. Z-1. ,R0\n{block}\nX5. Z-9.", control="fanuc-lathe")
    codes = [each.code for each in result.diagnostics]
    assert "line-vanishes" in codes
    assert "angle-opposite" not in codes


def test_what_agrees_to_rounding_alone_is_told_from_what_agrees():
    texts = {
        angle: solve(f"G17 G90 G01 X40. Y20. A{angle}", control="mitsubishi", start="X0 Y0").diagnostics[0].message
        for angle in ("26.565", "26.56505118")
    }
    assert texts["26.565"].endswith("it agrees with them to its least increment")
    assert texts["26.56505118"].endswith("it agrees with them")


@pytest.mark.parametrize("name", [",A of Fanuc as a direction", "AN of FK", "a fact about a line"])
def test_rows_of_a_family_have_the_status_of_their_block(name):
    case, angles = CASES[name], [-135.0, 45.0, 135.0, 44.0, -45.0]
    word, fact = (case.get(each, "").format(45) for each in ("word", "fact"))
    rows = family(
        case["block"].format(A=word),
        vary={fact.partition(" =")[0] or (("1:" if "\n" in case["block"] else "") + word.rstrip("45.+")): angles},
        control=case["control"],
        start=STARTS.get(case["control"], "X0 Y0"),
        facts=[fact] if fact else [],
        settings=case.get("settings"),
    )
    alone = [solved(name, angle if angle % 1 else int(angle))[0].answers[0].status for angle in angles]
    assert [StatusCode(each).status for each in rows["status"]] == alone


@pytest.mark.parametrize("name", [",A of Fanuc", ",A of Fanuc as a direction", "A of G111", "AN of FK"])
def test_what_is_said_of_it_is_verified(tmp_path, name):
    case, program = CASES[name], tmp_path / "program.nc"
    word = case["word"].format(case["right"] + 180)
    start = STARTS.get(case["control"], "X0 Y0")
    program.write_text(
        ("L " if case["control"] == "heidenhain" else "G00 ") + start + "\n" + case["block"].format(A=word)
    )
    options = [f"--set={name}={value}" for name, value in case.get("settings", {}).items()]
    shown = CliRunner().invoke(
        main, ["solve", str(program), "--format", "json", "--control", case["control"], *options]
    )
    assert json.loads(shown.stdout)["contours"]
    documents = Document("program", program.read_bytes()), Document("result", shown.stdout.encode())
    assert verify(*documents).verdict is not ReceiptVerdict.FAILED
