"""Which of several contours is chosen does not depend on how a drawing is turned, where it lies, or how large it is."""

import re
from cmath import phase, rect
from collections.abc import Iterator
from itertools import product
from math import degrees, radians

import pytest
from examples import law
from hypothesis import strategies as st

import contoursolve
from contoursolve.diagnosis.solutions import list_solutions

BLOCK = "0 BEGIN PGM T MM\n{}\n99 END PGM T MM\n"

TELESCOPE = """1 L X+50 Y+75 RL F500
2 FC DR+ R25 CCX+50 CCY+50
3 FCT DR- R14
4 FCT DR- R88 CCX+50 CCY+0
5 FSELECT{}
6 FCT DR- R14
7 FCT DR+ R25 CCX+50 CCY+50 X+50 Y+75"""
"""The arc of block 2 ends where block 4 says so."""

CHAINS = {
    "an end that a later block determines": TELESCOPE,
    "the same, chosen one block earlier": TELESCOPE.replace("4 FCT", "4 FSELECT{}\n4 FCT").replace("5 FSELECT{}\n", ""),
    "two images in a mirror": "1 L X+0 Y+0\n2 FL LEN50\n3 FSELECT{}\n4 FL X+80 Y+20 LEN60",
    "a line that meets a circle": "1 L X+0 Y+10\n2 FL AN+15\n3 FC DR- R25 CCX+50 CCY+20 CCA+0\n4 FSELECT{}",
    "two choices": """8 L X+0 Y+0 RL F250
10 FPOL X+50 Y+20
11 FL LEN64.5 CLSD+ P1X+15 P1Y+35
12 FSELECT{}
13 FL PR+67 AN+21
14 FL IX+15 IY+0
15 FL LEN 40 PAR 11
16 FSELECT{}
17 FL X+75 Y+20
18 FL CLSD-""",
    "a bridge between circles": """1 L X+5 Y+40
2 FC DR- R20 CCX+5 CCY+20
3 FCT DR+ R35
4 FSELECT{}
5 FCT DR- R12 CCX+70 CCY+25
6 FL X+120 Y+10 LEN50
7 FSELECT{}""",
}
"""Chains of which FSELECT chooses one contour."""

PAIR = re.compile(r"(?<![A-Z0-9])(P1|CC|I|)X ?([+-]?[\d.]+) (?:\1)Y ?([+-]?[\d.]+)")
ANGLE = re.compile(r"\b(AN|CCA)([+-]?[\d.]+)")
SIZE = re.compile(r"\b(LEN|PR|R) ?([+-]?\d[\d.]*)")


def moved(text: str, turn: complex, shift: complex, size: float) -> str:
    """A program as it is where everything is turned, shifted and made larger, to nine decimals."""

    def place(match: re.Match[str]) -> str:
        name, at = match[1], complex(float(match[2]), float(match[3]))
        at = size * turn * at + (0 if name == "I" else shift)
        return f"{name}X{at.real:+.9f} {name}Y{at.imag:+.9f}"

    by = degrees(phase(turn))
    text = PAIR.sub(place, text)
    text = ANGLE.sub(lambda match: f"{match[1]}{(float(match[2]) + by) % 360:+.9f}", text)
    return SIZE.sub(lambda match: f"{match[1]}{size * float(match[2]):+.9f}", text)


def chosen(text: str) -> list[complex] | str:
    """The ends of the elements of the contour that is chosen, or the status where none is."""
    (answer,) = contoursolve.solve(text, control="heidenhain", depth="verdict").answers
    if answer.contour is None:
        return answer.status.value
    return [complex(*each.end) for each in answer.contour.elements]


def numbered(chain: str) -> Iterator[str]:
    """A chain with every number behind each FSELECT, and one that is too many."""
    for numbers in product((1, 2, 3), repeat=chain.count("{}")):
        yield BLOCK.format(chain.format(*numbers))


def test_the_nearer_end_along_the_first_element_that_differs_counts_first():
    near, far = (chosen(BLOCK.format(TELESCOPE.format(number))) for number in (1, 2))
    assert near[0] == pytest.approx(26.80498963 + 59.32692308j, abs=1e-6)
    assert far[0] == pytest.approx(73.19501037 + 59.32692308j, abs=1e-6)


@law(
    st.sampled_from(sorted(CHAINS)),
    st.sampled_from((45, 90, 180, 201.5, 300)) | st.floats(0.5, 359.5),
    st.tuples(st.floats(-900, 900), st.floats(-900, 900)),
    st.sampled_from((1, 0.125, 7, 40)),
    examples=[(name, 45, (0, 0), 1) for name in CHAINS],
)
def test_a_choice_by_fselect_is_the_same_wherever_the_drawing_lies(
    name: str, angle: float, shift: tuple[float, float], size: float
) -> None:
    turn, by = rect(1, radians(angle)), complex(round(shift[0], 3), round(shift[1], 3))
    answers = []
    for text in numbered(CHAINS[name]):
        here, there = chosen(text), chosen(moved(text, turn, by, size))
        answers.append(here)
        if isinstance(here, str):
            assert there == here, text
        else:
            assert not isinstance(there, str), (there, moved(text, turn, by, size))
            image = [size * turn * at + by for at in here]
            assert max(abs(one - other) for one, other in zip(there, image, strict=True)) < 1e-4 * size, text
    assert sum(not isinstance(each, str) for each in answers) > 1, answers


ONE_AXIS = {
    "no place in common": "1 L X+0 Y+0\n2 FL LEN50 X+30\n3 FSELECT{}\n4 FL LEN70 Y+20\n5 FSELECT{}",
    "nor in the middle": "1 L X+7 Y-3\n2 FC DR+ R40 CCX+20 X+50\n3 FSELECT{}\n4 FL LEN90 Y+20\n5 FSELECT{}",
    "two arcs": "1 L X+0 Y+0\n2 FC DR- R30 CCY+10 X+45\n3 FSELECT{}\n4 FCT DR- R90 Y-60\n5 FSELECT{}",
}
"""Chains with single coordinates, which only quarters of a turn leave single ones."""

AXIS = re.compile(r"\b(CC|I|)([XY])([+-][\d.]+)")


@law(
    st.sampled_from(sorted(ONE_AXIS)),
    st.sampled_from((1, 2, 3)),
    st.tuples(st.integers(-900, 900), st.integers(-900, 900)),
    st.sampled_from((1, 0.125, 7)),
    examples=[(name, turns, (0, 0), 1) for name in ONE_AXIS for turns in (1, 2)],
)
def test_a_choice_is_the_same_in_each_quarter_where_all_contours_have_nothing_in_common(
    name: str, turns: int, shift: tuple[int, int], size: float
) -> None:
    by, turn = complex(*shift), 1j**turns

    def place(match: re.Match[str]) -> str:
        at = size * turn * (float(match[3]) * (1 if match[2] == "X" else 1j))
        axis = "XY".index(match[2]) ^ (turns % 2)
        return f"{match[1]}{'XY'[axis]}{(at.real, at.imag)[axis] + shift[axis]:+.9f}"

    seen = set()
    for text in numbered(ONE_AXIS[name]):
        here = chosen(text)
        there = chosen(SIZE.sub(lambda match: f"{match[1]}{size * float(match[2])}", AXIS.sub(place, text)))
        if isinstance(here, str):
            assert there == here, text
            continue
        assert not isinstance(there, str), there
        assert max(abs(size * turn * a + by - b) for a, b in zip(here, there, strict=True)) < 1e-4 * size, text
        seen.add(tuple(complex(round(at.real, 3), round(at.imag, 3)) for at in here))
    assert len(seen) > 1


@law(st.sampled_from(sorted(CHAINS)))
def test_what_is_listed_as_choosing_a_contour_chooses_it(name: str) -> None:
    text = BLOCK.format(re.sub(r"\d+ FSELECT\{\}\n?", "", CHAINS[name]))
    (answer,) = contoursolve.solve(text, control="heidenhain").answers
    listing = list_solutions(answer)
    assert listing is not None
    for each in listing.solutions:
        lines = text.split("\n")
        for word in each.selects if each.contour is not None else ():
            number, element = re.fullmatch(r"FSELECT (\d+) after \w+ (\d+)", word).groups()
            index = next(index for index, line in enumerate(lines) if line.startswith(f"{element} F"))
            lines[index] += f"\n{element} FSELECT {number}"
        if each.contour is not None:
            assert chosen("\n".join(lines)) == [complex(*one.end) for one in each.contour.elements]


WORDS = {
    ("mitsubishi", "a line that crosses an arc"): "G17 G90 G00 X0 Y5.\nG01 A10.\nG02 X60. Y15. I-20. J-25. H{0|1}",
    ("mitsubishi", "a full circle that is left"): "G17 G90 G00 X0 Y0\nG03 I30. J0 H{0|1}\nG01 X20. Y-60. A-90.",
    ("mitsubishi", "a tangent arc"): "G17 G90 G00 X0 Y0\nG01 A15.\nG03 X70. Y50. R{|-}30.",
    ("nct-99m", "a line that crosses an arc"): (
        "G17 G42 G0 X100 Y20\nG1 X-30 Y-20\nG3 X20 Y40 I20 J-10 R50 Q{-1|1}\nG40 G0 Y60"
    ),
    ("nct-99m", "a line behind an arc"): (
        "G17 G42 G0 X50 Y0\nG3 X0 Y50 R50\nG1 X-50 Y42.857 ,A171.87 Q{-1|1}\nG40 G0 Y70"
    ),
}
"""Pairs of blocks in which a word chooses between two contours, by the control."""


@law(
    st.sampled_from(sorted(WORDS)),
    st.sampled_from((45, 90, 180, 201.5)) | st.floats(0.5, 359.5),
    st.tuples(st.integers(-900, 900), st.integers(-900, 900)),
    st.sampled_from((1, 0.125, 7)),
    examples=[(name, 45, (0, 0), 1) for name in WORDS],
)
def test_a_word_chooses_the_same_contour_wherever_the_drawing_lies(
    name: tuple[str, str], angle: float, shift: tuple[int, int], size: float
) -> None:
    control, by = name[0], complex(*shift)

    def place(match: re.Match[str]) -> str:
        at = size * rect(1, radians(angle)) * complex(float(match[2]), float(match[4]))
        at += by if match[1] == "X" or control == "nct-99m" else 0
        return f"{match[1]}{at.real:.9f} {match[3]}{at.imag:.9f}"

    def turned(text: str) -> str:
        text = re.sub(r"\b([XI])([-\d.]+) ([YJ])([-\d.]+)", place, text)
        text = re.sub(r"\bA([-\d.]+)", lambda match: f"A{(float(match[1]) + angle) % 360:.9f}", text)
        return re.sub(r"\bR(-?)([\d.]+)", lambda match: f"R{match[1]}{size * float(match[2]):.9f}", text)

    ways = [re.sub(r"\{(.*)\|(.*)\}", rf"\{number}", WORDS[name]) for number in (1, 2)]
    images = []
    for text in ways:
        (here,), (there,) = (contoursolve.solve(each, control=control).answers for each in (text, turned(text)))
        assert here.contour is not None, text
        assert there.contour is not None, turned(text)
        for one, other in zip(here.contour.elements, there.contour.elements, strict=True):
            image = size * rect(1, radians(angle)) * complex(*one.end) + by
            assert abs(image - complex(*other.end)) < 1e-4 * max(size, 1), turned(text)
        images.append([each.end for each in here.contour.elements])
    assert images[0] != images[1]
