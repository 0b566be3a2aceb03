"""An angle whose direction is against the one that the other words give never agrees with them; and an arc that turns
the other way round is suspected where it joins its neighbours in corners."""

import json
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, NamedTuple

import pytest
from click.testing import CliRunner

from contoursolve import Result, family, solve
from contoursolve.cli import main
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.solving import STATUSES


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
RAY = {"settings": {"fanuc-lathe.angle-sense": "ray"}}
CASES = {
    "A of G111": Case("yasnac-lx3", G111, 135, "A{}."),
    ",A of Fanuc": Case("fanuc-lathe", "G01 X80. Z40. {A} ,R2.\nX120.", 45, ",A{}."),
    ",A of Fanuc as a direction": Case("fanuc-lathe", "G01 X80. Z40. {A} ,R2.\nX120.", 45, ",A{}.", RAY),
    "AN of FK": Case("heidenhain", "FL X+40 Y+40 {A}\nFL X+80 AN+0", 45, "AN{:+g}"),
    "a fact about a line": Case("yasnac-lx3", "G111 I12. K-12. B180. W-40.", 135, "direction of line 1 = {}"),
}


def test_an_angle_of_a_line_without_length_says_nothing_against_it():
    result = solve("G00 X1. Z-5.\nG01 X2. Z-1. ,R0\nX2. Z-1. ,A341.\nX5. Z-9.", control="fanuc-lathe")
    codes = {each.code for each in result.diagnostics}
    assert codes & {"line-vanishes", "angle-opposite"} == {"line-vanishes"}


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
    assert [STATUSES[each] for each in rows["status"]] == alone


@pytest.mark.parametrize("name", [",A of Fanuc", ",A of Fanuc as a direction", "A of G111", "AN of FK"])
def test_what_is_said_of_it_is_verified(tmp_path, name):
    case, program = CASES[name], tmp_path / "program.nc"
    first = f"{'L' if case.control == 'heidenhain' else 'G00'} {case.start}\n"
    program.write_text(first + case.block.format(A=case.text.format(case.right + 180)))
    options = [f"--setting={name}={value}" for name, value in case.options.get("settings", {}).items()]
    asked = ["solve", str(program), "--format", "json", "--control", case.control, *options]
    shown = CliRunner().invoke(main, asked).stdout
    assert len(json.loads(shown)["contours"]) == 1
    documents = Document("program", program.read_bytes()), Document("result", shown.encode())
    assert verify(*documents).verdict is not ReceiptVerdict.FAILED
