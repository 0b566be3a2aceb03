"""Formatting changes blanks and block numbers alone: however a program is damaged, its control reads it as before. And
every jump leads to the block that it led to."""

import random
import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import pytest
from examples import few_and_many
from generate_fanuc import random_lathe, random_mill
from mutants import mutate, right_programs
from respell import isg, sinumerik

from contoursolve import Replacement, block_number_at, format_program, rename_block, solve
from contoursolve.controls import DIALECTS
from contoursolve.gcode import parse, spelled

ENDS = ("\n", "\n", "\n", "\r\n", "\r")
BLANKS = ("", "", " ", " ", "  ", "\t", " \t ")
BESIDE = (
    *("%", "O0012(PART)", "(A  NOTE)", "", "   ", "/G04 X1.", "/2 M08", "#100=  5.", "  IF[#1 GT 5] GOTO 20"),
    *("GOTO 10", "M98P1000", "M99 P20", "M30", "N10 T1", "N 20  S500M3", "G71 P10Q20 U1.", "G71P100 Q200", "X1 0"),
    *(
        "G1X1E2",
        "M97 P10",
        'MSG("A  B")  G40',
        "ANG = 30.  X=AC(5)",
        "LBL:G40",
        "GOTOF  N10",
        "REPEAT N10 N20",
        ";A  B",
    ),
    *("#ANG 30", "#COMMENT BEGIN", "#COMMENT END", "L SEQUENCE [N10 N20]", "$GOTO N10", "%_N_X_MPF", "( \udcff )"),
    *("\udcff", ":100", "X40.,A180,K-30.", "G2X1O5."),
)
END = re.compile(r"\r\n|\r|\n")
_WORD = re.compile(r"(?<=[0-9.)?])[ \t]*(?=[,A-Za-z#])")


def draw(rng: random.Random) -> tuple[str, str]:
    """A program for one of the controls, small and mostly sound, and the name of the control."""
    control = rng.choice([*DIALECTS])
    if control in ("yasnac-lx3", "nct-99m"):
        return rng.choice(right_programs(control)), control
    is_mill = control.endswith("-mill") or (control in ("siemens-840d", "siemens-808d", "isg") and rng.random() < 0.3)
    if is_mill:
        program = random_mill(rng, [rng.choice(("line", "line", "arc")) for _ in range(rng.randint(2, 4))], 17)
    else:
        program = random_lathe(rng, rng.randint(2, 4), "A" if control == "haas-lathe" else ",A")
    if control in ("siemens-840d", "siemens-808d", "isg"):
        program = [line for _, line in (isg if control == "isg" else sinumerik)(rng, program, 0 if is_mill else None)]
    return "\n".join(program), control


def untidy(text: str, rng: random.Random) -> str:
    """Other blanks between words, blocks with numbers, lines of another kind between, and other line ends."""
    found = []
    for line in text.split("\n"):
        if rng.random() < 0.3:
            found.append(rng.choice(BESIDE))
        number = f"N{rng.choice((1, 1, 1, 10)) * rng.randrange(40)}{rng.choice(BLANKS)}" if rng.random() < 0.2 else ""
        block = number + (_WORD.sub(lambda _: rng.choice(BLANKS), line) if rng.random() < 0.7 else line)
        found.append(rng.choice(BLANKS) + block + rng.choice(BLANKS) if rng.random() < 0.3 else block)
    return "".join(line + rng.choice(ENDS) for line in found)


def drawn(rng: random.Random) -> tuple[str, str]:
    """A program that somebody left untidy, or damaged."""
    text, control = draw(rng)
    if rng.random() < 0.8:
        text = untidy(text, rng)
    for _ in range(rng.choice((0, 1, 1, 2, 3, 8))):
        text = mutate(text, rng) or " "
    return text, control


def words(text: str, control: str, *, is_numbered: bool) -> list[list[str]]:
    """The words of each line without their blanks; where blocks are numbered anew, no numbers and no jumps."""
    found = []
    for block in spelled(parse(text), DIALECTS[control].modes.syntax).blocks:
        texts = [(word.address, re.sub(r"[ \t]", "", word.text)) for word in block.words]
        if is_numbered:
            is_jump = re.search(r"(?i)M0*9[6-9]|G0*7[0-3]|SEQUENCE|GOTO|REPEAT|BLOCK", block.text) is not None
            texts = [(address, "" if is_jump and address in "PQHN" else each) for address, each in texts]
            texts = [each for each in texts if each[0] != "N"]
        found.append([text for _, text in texts])
    while found and not found[-1]:
        found.pop()
    return found


def seen(text: str, control: str) -> tuple[object, ...]:
    """What solving a program says, but for columns: behind a number, the whole block may come before its first word."""
    result = solve(text, control=control, depth="verdict")
    return (
        [(each.status, each.lines, each.contour and each.contour.elements) for each in result.answers],
        sorted((each.span.line, each.code, each.severity.value) for each in result.diagnostics),
    )


def holds(text: str, control: str, step: int) -> bool:
    """Hold one program against the law; whether its blocks could be numbered."""
    try:
        after = format_program(text, control=control, block_numbers=step)
    except ValueError:
        assert step
        return False
    assert format_program(after, control=control, block_numbers=step) == after
    assert END.findall(text) == END.findall(after)
    if not step:
        assert re.sub(r"[ \t]", "", text) == re.sub(r"[ \t]", "", after)
    is_numbered = step > 0
    assert words(text, control, is_numbered=is_numbered) == words(after, control, is_numbered=is_numbered)
    assert seen(text, control) == seen(after, control)
    return True


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "count"), [(0, 120), pytest.param(1, 480, marks=pytest.mark.slow)])
def test_a_formatted_program_is_read_as_before(seed: int, count: int) -> None:
    rng, numbered = random.Random(seed), 0
    for number in range(count):
        text, control = drawn(rng)
        step = 0 if number % 3 else rng.choice((1, 5, 10))
        try:
            numbered += holds(text, control, step) and step > 0
        except Exception as error:
            raise AssertionError(f"format_program({text!r}, control={control!r}, block_numbers={step})") from error
    assert numbered > count / 6


# --- jumps ----------------------------------------------------------------------------------------------

MACRO, WORDS = False, True
JUMPS = {
    "fanuc-lathe": [
        ("GOTO {}", MACRO),
        ("IF [#1 EQ 5] GOTO{}", MACRO),
        ("G71 P{} Q{} U1.", WORDS),
        ("M99 P{}", WORDS),
        ("M98 Q{} L2", WORDS),
    ],
    "haas-mill": [("M97 P{} L2", WORDS), ("M96 P{} Q5", WORDS), ("IF [#1 EQ 5] M99 P{}", MACRO)],
    "mitsubishi": [("M98 H{}", WORDS), ("GOTO{}", MACRO)],
    "siemens-840d": [
        ("GOTOF N{} ; N10", MACRO),
        ("REPEAT N{} N{} P=2", MACRO),
        ("CASE R1 OF 1 GOTOF N{} DEFAULT GOTOB N{}", MACRO),
        ('CYCLE95("N{}:N{}",1)', WORDS),
    ],
    "isg": [("$GOTO N{}", MACRO), ("L SEQUENCE [N{} N{} REPEAT=2]", MACRO)],
}
"""Statements that name blocks, and whether they are words, which have a number of their own."""


class Drawn(NamedTuple):
    """A program with jumps: its lines with a gap for each number, the lines that these are of, and the numbers."""

    lines: list[tuple[str, list[int]]]
    own: dict[int, int]
    named: list[int]
    """Lines that have a number, or get one if all blocks with words do."""

    def text(self, numbers: Mapping[int, int]) -> str:
        """The program with these numbers of its lines."""
        texts = [text.format(*(numbers[line] for line in targets)) for text, targets in self.lines]
        return "\n".join(f"N{numbers[line]} {text}" if line in numbers else text for line, text in enumerate(texts, 1))


def draw_jumps(rng: random.Random, control: str) -> Drawn:
    """A main program; some of its blocks have numbers."""
    count = rng.randint(4, 12)
    kinds = [rng.choice(JUMPS[control]) if rng.random() < 0.4 else ("G1 X5.", WORDS) for _ in range(count)]
    kinds.append(("M30", WORDS))
    numbered = [line for line in range(1, count + 2) if rng.random() < 0.5] or [1]
    own = dict(zip(numbered, rng.sample(range(1, 2_000), len(numbered)), strict=True))
    lines = [(text, rng.choices(numbered, k=text.count("{}"))) for text, _ in kinds]
    return Drawn(lines, own, [line for line, (_, words) in enumerate(kinds, 1) if words is WORDS or line in own])


@few_and_many(20, 400)
@pytest.mark.parametrize("control", JUMPS)
def test_jumps_lead_to_the_same_blocks(control: str, count: int) -> None:
    rng = random.Random(count)
    for _ in range(count):
        drawn, step = draw_jumps(rng, control), rng.choice((1, 5, 10))
        text = drawn.text(drawn.own)
        anew = {line: step * place for place, line in enumerate(drawn.named, 1)}
        assert format_program(text, control=control, block_numbers=step) == drawn.text(anew), text
        line, number = rng.choice(list(drawn.own)), rng.randint(2_000, 9_999)
        assert applied(text, rename_block(text, line, number, control=control)) == drawn.text(
            drawn.own | {line: number}
        )
        for place in rename_block(text, line, number, control=control):
            found = block_number_at(text, place.span.line, place.span.end_column, control=control)
            assert (found.span, found.number, found.line) == (place.span, drawn.own[line], line)


def applied(text: str, changes: Sequence[Replacement]) -> str:
    lines = text.split("\n")
    for (line, begin, end), new in ((each.span, each.text) for each in reversed(changes)):
        lines[line - 1] = lines[line - 1][: begin - 1] + new + lines[line - 1][end - 1 :]
    return "\n".join(lines)
