"""Formatting changes blanks and block numbers alone: however a program is damaged, its control reads it as before."""

import random
import re

import pytest
from generate_fanuc import random_lathe, random_mill
from mutations import mutate, windows
from respell import isg, sinumerik

from contoursolve import format_program, solve
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
        return rng.choice([each for each in windows() if each[1] == control])
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


@pytest.mark.parametrize(
    ("seed", "count"), [(0, 300), *(pytest.param(seed, 5_000, marks=pytest.mark.slow) for seed in (1, 2))]
)
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
