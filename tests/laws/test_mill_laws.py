"""What never changes the contour of an NCT program, whatever its form: units, the order of words, where it lies, how
large it is, which way it is turned, and its image in a mirror."""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from random import Random

import pytest
from generate_nct import FORMS, Drawn, random_chain, random_cornered, random_pair

from contoursolve import solve
from contoursolve.solving.contour import ArcSegment, Contour

AXES, CENTERS = ("X", "Y"), ("I", "J")
WORD = re.compile(r"(,?[A-Z])(-?\d*\.?\d+)")
PER_FORM = 6
CLOSE = 1e-7
"""mm. Twelve decimals are written, and a chain of six blocks passes their rounding on."""


@dataclass(frozen=True)
class Block:
    """One block as address and value, with what is in force in it."""

    words: tuple[tuple[str, float], ...]
    motion: int
    is_incremental: bool
    is_over: bool
    follows_arc: bool
    """Over-defined after an arc."""

    def names(self) -> set[str]:
        return {address for address, _ in self.words}


def blocks(program: tuple[str, ...]) -> Iterator[Block]:
    motion, incremental, was_arc = 0, False, False
    for line in program:
        words = tuple((address, float(number)) for address, number in WORD.findall(line))
        codes = {int(value) for address, value in words if address == "G"}
        motion = next((code for code in codes if code in (0, 1, 2, 3)), motion)
        incremental = 91 in codes or (incremental and 90 not in codes)
        names = {address for address, _ in words}
        is_over = names >= {*AXES, ",A"} or names >= {*AXES, *CENTERS, "R", "Q"}
        yield Block(words, motion, incremental, is_over, was_arc)
        was_arc = motion in (2, 3)


def written(block: Block, change: Callable[[str, float, Block], tuple[str, float] | None]) -> str:
    found = (change(address, value, block) for address, value in block.words)
    return " ".join(
        f"{address}{value:.0f}" if address in "GD" else f"{address}{value:.13f}"
        for address, value in filter(None, found)
    )


def is_absolute(address: str, block: Block) -> bool:
    """Whether a value is a place and not a step."""
    if address in CENTERS:
        return block.is_over
    return block.is_over or not block.is_incremental


def scaled(address: str, value: float, _block: Block) -> tuple[str, float]:
    return (address, 3 * value) if address in (*AXES, *CENTERS, "R", ",R", ",C") else (address, value)


def shifted(address: str, value: float, block: Block) -> tuple[str, float]:
    if address in (*AXES, *CENTERS) and is_absolute(address, block):
        return address, value + {"X": 40.0, "I": 40.0, "Y": -70.0, "J": -70.0}[address]
    return address, value


def rotated(address: str, value: float, _block: Block) -> tuple[str, float]:
    """By 90 degrees to the left: (x, y) becomes (-y, x)."""
    if address == ",A":
        return address, value + 90 if value < 270 else value - 270
    turned = {"X": ("Y", 1), "Y": ("X", -1), "I": ("J", 1), "J": ("I", -1)}.get(address)
    return (turned[0], turned[1] * value) if turned else (address, value)


def mirrored(address: str, value: float, block: Block) -> tuple[str, float]:
    """The first axis the other way round: turns swap, and so do the sides of two circles."""
    if address in ("X", "I"):
        return address, -value
    if address == ",A":
        return address, 180 - value if value >= -180 else -180 - value
    if address == "G" and value in (2, 3):
        return address, 5 - value
    if address == "G" and value in (41, 42):
        return address, 83 - value
    between_circles = address == "Q" and block.motion in (2, 3) and block.follows_arc
    return address, -value if between_circles else value


def in_inches(address: str, value: float, _block: Block) -> tuple[str, float]:
    return (address, value / 25.4) if address in (*AXES, *CENTERS, "R", ",R", ",C") else (address, value)


LAWS: dict[str, tuple[Callable[[str, float, Block], tuple[str, float] | None], Callable[[complex], complex], str]] = {
    "three times as large": (scaled, lambda at: 3 * at, ""),
    "elsewhere": (shifted, lambda at: at + 40 - 70j, ""),
    "turned by 90 degrees": (rotated, lambda at: at * 1j, ""),
    "in a mirror": (mirrored, lambda at: -at.conjugate(), ""),
    "in inches": (in_inches, lambda at: at, "G20\n"),
}


def drawings() -> Iterator[Drawn]:
    for seed in range(PER_FORM):
        rng = Random(seed)
        for form in FORMS:
            yield random_pair(rng, form, 17, rng.choice(("", "C", "R")))
        yield random_cornered(rng, 17)
        yield random_chain(rng, 2 + seed, 17)


DRAWN = tuple(drawings())


def contour_of(text: str) -> Contour:
    (answer,) = solve(text, control="nct-99m", depth="verdict").answers
    assert answer.contour is not None, text
    return answer.contour


def off(found: Contour, original: Contour, image: Callable[[complex], complex], *, swaps: bool) -> float:
    """The largest distance of a point of one contour from the image of the other's, mm."""
    assert [each.name for each in found.elements] == [each.name for each in original.elements]
    worst = 0.0
    for one, other in zip(found.elements, original.elements, strict=True):
        pairs = [(one.start, other.start), (one.end, other.end)]
        if isinstance(one, ArcSegment) and isinstance(other, ArcSegment):
            assert (one.turn is other.turn) is not swaps
            pairs.append((one.center, other.center))
        worst = max(worst, *(abs(complex(*a) - image(complex(*b))) for a, b in pairs))
    return worst


@pytest.mark.parametrize("name", LAWS)
def test_an_image_of_a_program_makes_the_image_of_its_contour(name: str) -> None:
    change, image, before = LAWS[name]
    for drawn in DRAWN:
        text = before + "\n".join(written(block, change) for block in blocks(drawn.program))
        found, original = contour_of(text), contour_of(drawn.text)
        assert off(found, original, image, swaps=name == "in a mirror") < CLOSE, (drawn.text, text)


def test_the_order_of_words_changes_nothing() -> None:
    rng = Random(1)
    for drawn in DRAWN:
        lines = []
        for line in drawn.program:
            words = line.split()
            rng.shuffle(words)
            lines.append(" ".join(words))
        assert contour_of("\n".join(lines)) == contour_of(drawn.text)


def test_a_conflict_in_the_third_block_is_explained_by_words_of_the_blocks_before() -> None:
    program = "G17 G90 G0 X0 Y0\nG1 X30 ,R2\nG91 Y20 ,R2\nG2 G90 X50 Y25 I20 J0"
    (finding,) = solve(program, control="nct-99m").diagnostics
    assert (finding.code, finding.span.line) == ("nct-radius-difference", 4)
    assert "because the arc begins at V2, where X30 (program line 2) and Y20 (program line 3) put it" in finding.notes


def test_a_corner_at_an_end_that_is_off_its_arc_by_less_than_allowed_is_made() -> None:
    program = "G17 G90 G0 X0 Y0\nG3 X40 Y0.004 I20 J0 ,C5\nG1 X80"
    answer = solve(program, control="nct-99m", depth="verdict").answers[0]
    assert answer.contour is not None
    begin, end = answer.contour.elements[1].start, answer.contour.elements[1].end
    corner = 40 + 0.004j
    assert abs(complex(*begin) - corner) == pytest.approx(5, abs=1e-9)
    assert abs(complex(*end) - corner) == pytest.approx(5, abs=1e-9)
