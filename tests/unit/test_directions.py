"""An angle whose direction is against the one that the other words give never agrees with them; and an arc that turns
the other way round is suspected where it joins its neighbours in corners."""

import json
import re
from cmath import rect
from collections.abc import Mapping
from math import radians
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest
from click.testing import CliRunner

from contoursolve import Diagnostic, Result, check, family, solve
from contoursolve.cli import main
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.solving import StatusCode


class Case(NamedTuple):
    """A block with a place for an angle, the direction that the other words give, and the word or the fact for it."""

    control: str
    block: str
    right: float
    text: str
    options: Mapping[str, Any] = MappingProxyType({})

    @property
    def start(self) -> str:
        return {"yasnac-lx3": "X40. Z0.", "fanuc-lathe": "X0 Z0"}.get(self.control, "X0 Y0")

    @property
    def is_fact(self) -> bool:
        return " " in self.text

    def solved(self, angle: float) -> Result:
        """What becomes of it with an angle."""
        text = self.text.format(angle)
        block = self.block.format(A="" if self.is_fact else text)
        facts = [text] if self.is_fact else []
        return solve(block, control=self.control, start=self.start, facts=facts, **self.options)


G111 = "G111 {A} I12. K-12. B180. Z-40."
OFF: dict[str, Any] = {"rules": "off"}
CHECKED = {"settings": {"siemens-840d.redundant-angle": "check"}}
RAY = {"settings": {"fanuc-lathe.angle-sense": "ray"}}
CASES = {
    "A of G111": Case("yasnac-lx3", G111, 135, "A{}."),
    "A of G111 without rules": Case("yasnac-lx3", G111, 135, "A{}.", OFF),
    "A of G111 with a word missing": Case("yasnac-lx3", "G111 {A} I12. K-12. B180.", 135, "A{}.", OFF),
    "B of G111": Case("yasnac-lx3", "G111 I12. K-12. {A} X64. Z-40.", 180, "B{}."),
    "B of G111 beside A": Case("yasnac-lx3", "G111 A135. I12. {A} U24. W-40.", 180, "B{}."),
    "A of Mitsubishi": Case("mitsubishi", "G17 G90 G01 X40. Y40. {A}", 45, "A{}."),
    "A of Mitsubishi with a corner": Case("mitsubishi", "G17 G90 G01 X40. Y40. {A} ,R2.\nX80.", 45, "A{}."),
    "ANG of SINUMERIK": Case("siemens-840d", "G17 G90 G1 X40 Y40 {A} RND=2\nX80", 45, "ANG={}"),
    "ANG that is checked": Case("siemens-840d", "G17 G90 G1 X40 Y40 {A} RND=2\nX80", 45, "ANG={}", CHECKED),
    "#ANG of ISG": Case("isg", "G17 G90 G1 X40 Y40 {A} #RND=2\nX80", 45, "#ANG={}"),
    ",A of Fanuc": Case("fanuc-lathe", "G01 X80. Z40. {A} ,R2.\nX120.", 45, ",A{}."),
    ",A of Fanuc as a direction": Case("fanuc-lathe", "G01 X80. Z40. {A} ,R2.\nX120.", 45, ",A{}.", RAY),
    "AN of FK": Case("heidenhain", "FL X+40 Y+40 {A}\nFL X+80 AN+0", 45, "AN{:+g}"),
    "AN of FK beside LEN": Case("heidenhain", "FL X+40 Y+30 LEN50 {A}\nFL X+80 AN+0", 36.8699, "AN{:+g}"),
    "a fact about a line": Case("yasnac-lx3", "G111 I12. K-12. B180. W-40.", 135, "direction of line 1 = {}"),
    "a fact beside an angle": Case("yasnac-lx3", "G111 A135. K-12. B180. W-40.", 135, "direction of line 1 = {}"),
    "a fact about an FK line": Case("heidenhain", "FL X+40 Y+40\nFL X+80 AN+0", 45, "direction of line 1 = {}"),
}


def told(finding: Diagnostic) -> str:
    return " ".join([finding.message, *finding.notes, *(label.text for label in finding.labels)])


@pytest.mark.parametrize("turn", [180, -180])
@pytest.mark.parametrize("name", CASES)
def test_the_opposite_direction_never_agrees(name, turn):
    case = CASES[name]
    result, word = case.solved(case.right + turn), case.text.format(case.right + turn)
    texts = [told(each) for each in result.diagnostics if word in each.message]
    right = f"{case.right:.3f} deg"
    assert any(right in text or f"write A{case.right}." in text for text in texts), texts
    assert not any(re.search(r"\b(agrees|repeats|the same place)\b", text) for text in texts)
    for answer in result.answers:
        own = [tie for tie in answer.diagnosis.ties if {word, word.rstrip("0123456789.+-=")} & {*tie.addresses}]
        assert all(tie.is_conflict for tie in own)


@pytest.mark.parametrize("name", CASES)
def test_the_direction_itself_agrees(name):
    result = CASES[name].solved(CASES[name].right)
    texts = [told(each) for each in result.diagnostics]
    assert not re.search("opposite|disagrees|other way", " ".join(texts))
    ties = [tie for answer in result.answers if answer.diagnosis for tie in answer.diagnosis.ties]
    assert not any(tie.is_conflict for tie in ties)


def test_no_fix_leaves_a_direction_that_is_opposite():
    (finding,) = CASES["A of G111 without rules"].solved(-45).diagnostics
    assert [each.replacement for each in finding.fixes[:2]] == [G111.format(A="A135."), G111.replace("{A} ", "")]


def test_an_angle_of_a_line_without_length_says_nothing_against_it():
    result = solve("G00 X1. Z-5.\nG01 X2. Z-1. ,R0\nX2. Z-1. ,A341.\nX5. Z-9.", control="fanuc-lathe")
    codes = {each.code for each in result.diagnostics}
    assert codes & {"line-vanishes", "angle-opposite"} == {"line-vanishes"}


@pytest.mark.parametrize(("angle", "end"), [("26.565", " to its least increment"), ("26.56505118", "")])
def test_what_agrees_to_rounding_alone_is_told_from_what_agrees(angle, end):
    (finding,) = solve(f"G17 G90 G01 X40. Y20. A{angle}", control="mitsubishi", start="X0 Y0").diagnostics
    assert finding.message.endswith(f"it agrees with them{end}")


@pytest.mark.parametrize("name", [",A of Fanuc as a direction", "AN of FK", "a fact about a line"])
def test_rows_of_a_family_have_the_status_of_their_block(name):
    case, angles = CASES[name], [-135, 45, 135, 44, -45]
    word = case.text.partition(" =")[0] if case.is_fact else "1:" + case.text.partition("{")[0]
    rows = family(
        case.block.format(A=case.text.format(45)),
        vary={word: [float(angle) for angle in angles]},
        control=case.control,
        start=case.start,
        facts=[case.text.format(45)] if case.is_fact else [],
        **case.options,
    )
    alone = [case.solved(angle).answers[0].status for angle in angles]
    assert [StatusCode(each).status for each in rows["status"]] == alone


@pytest.mark.parametrize("name", [",A of Fanuc", ",A of Fanuc as a direction", "A of G111", "AN of FK"])
def test_what_is_said_of_it_is_verified(tmp_path, name):
    case, program = CASES[name], tmp_path / "program.nc"
    first = f"{'L' if case.control == 'heidenhain' else 'G00'} {case.start}\n"
    program.write_text(first + case.block.format(A=case.text.format(case.right + 180)))
    options = [f"--set={name}={value}" for name, value in case.options.get("settings", {}).items()]
    asked = ["solve", str(program), "--format", "json", "--control", case.control, *options]
    shown = CliRunner().invoke(main, asked).stdout
    assert len(json.loads(shown)["contours"]) == 1
    documents = Document("program", program.read_bytes()), Document("result", shown.encode())
    assert verify(*documents).verdict is not ReceiptVerdict.FAILED


def arc_and_line(sense: int, sweep: float, turn: float) -> tuple[complex, float, complex]:
    """Where an arc of 50 mm about X0 Y0 from X50 ends, and the direction and end of the line that leaves it there."""
    crossing, heading = rect(50, radians(sense * sweep)), sense * (sweep + 90 + turn)
    return crossing, (heading + 180) % 360 - 180, crossing + rect(60, radians(heading))


SWEEPS = [(210, 120, True), (300, 150, True), (210, 100, False), (210, 60, False), (179, 120, False)]


@pytest.mark.boundary
@pytest.mark.parametrize(("sweep", "turn", "is_told"), SWEEPS)
@pytest.mark.parametrize("sense", [1, -1])
def test_an_arc_of_more_than_half_a_turn_that_leaves_in_a_sharp_corner_is_suspected(sense, sweep, turn, is_told):
    """The other way round the path would turn by less; a corner that is rounded is joined without one."""
    crossing, heading, end = arc_and_line(sense, sweep, turn)
    code, other = ("G3", "G2") if sense > 0 else ("G2", "G3")
    line = f"G1 X{end.real:.4f} Y{end.imag:.4f}"
    met = f"G17 G90 G{41 if sense > 0 else 42} G0 X50 Y0\n{code} I-50 J0\n{line} ,A{heading:.3f} Q-1"
    found = check(met, control="nct-99m")
    assert [each.code for each in found] == ["suspected"] * is_told
    assert [each.fixes[0].description.partition(" ->")[0] for each in found] == [
        f"write {other} for {code} (the other way round)"
    ] * is_told
    to = f"X{crossing.real:.4f} Y{crossing.imag:.4f}"
    rounded = f"G17 G90 G0 X50. Y0.\n{code} {to} I-50. J0 ,R2. F100\n{line}"
    assert check(rounded, control="fanuc-mill") == ()
