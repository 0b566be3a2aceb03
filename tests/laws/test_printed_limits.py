"""A limit that is printed holds: typed in as it is printed, the contour exists."""

import re
from collections.abc import Iterator
from xml.etree import ElementTree

from examples import law
from hypothesis import strategies as st

import contoursolve
from contoursolve.output import range_lines
from contoursolve.pictures import draw_range

SIZE = st.integers(1_000, 9_999)
CORNER = "G01 ,A{a} ,R#1 F0.2\nX{x} Z-80. ,A{b}"
END = "G01 Z-30. ,R{size} F0.2\nX60. Z#1"
ANGLE = "G01 Z-20. ,A#1 ,C1.\nX{x} Z-60."
BEHIND = "G01 Z-20. ,R{size}\nX{x} Z#1 ,R2.\nZ-90."
START, LATHE = "X40. Z0.", "fanuc-lathe"


def word(thousandths: int) -> str:
    """A number as a word has it."""
    return f"{thousandths / 1000:.3f}"


@st.composite
def drawn(draw: st.DrawFn) -> str:
    """Blocks with one number open, written as #1."""
    about = {
        "a": word(180_000 - draw(st.integers(3_000, 30_000))),
        "b": word(180_000 - draw(st.integers(31_000, 80_000))),
        "x": word(draw(st.integers(50_000, 90_000))),
        "size": word(draw(SIZE)),
    }
    return draw(st.sampled_from([CORNER, END, ANGLE, BEHIND])).format(**about)


NUMBER = r"-?\d+(?:\.\d+)?"
NOTE = re.compile(rf"(?:from|up to|to) ({NUMBER})(?! on)\b")
TABLE = re.compile(rf"(?:from|to) +({NUMBER}) (?:mm|deg)(?! *end of the range)")
REASON = re.compile(rf"at (?:most|least) ({NUMBER}) (?:mm|deg)$")


def typed(text: str, number: str) -> str:
    """The program with a number in the place of what is open."""
    return f"G00 {START}\n{text.replace('#1', number if '.' in number else f'{number}.')}"


def printed(text: str) -> Iterator[tuple[str, str]]:
    """Every limit that is printed of a block, with where."""
    (answer,) = contoursolve.solve(typed(text, "#1"), control=LATHE).answers
    notes = [note for each in answer.diagnostics for note in each.notes if note.startswith("#1 makes")]
    yield from (("note", each) for note in notes for each in NOTE.findall(note))
    found = contoursolve.feasible(text, "#1", start=START, control=LATHE)
    for line in list(range_lines(found))[1:]:
        yield from (("table", each) for each in TABLE.findall(line))
        yield from (("reason", each) for each in REASON.findall(line))
    svg = ElementTree.fromstring(draw_range(found).svg)
    for line in ("".join(each.itertext()) for each in svg.iter("{http://www.w3.org/2000/svg}text")):
        yield from (("picture", each) for each in TABLE.findall(line))


@law(drawn(), few=4, many=12)
def test_a_limit_that_is_typed_in_as_it_is_printed_has_the_contour(text: str) -> None:
    for where, number in printed(text):
        (answer,) = contoursolve.solve(typed(text, number), control=LATHE).answers
        assert answer.contour is not None, (where, number, typed(text, number))


def test_the_limits_of_two_corners_are_those_that_fit() -> None:
    for text, limit in (
        ("G01 ,A170. ,R#1 F0.2\nX60. Z-80. ,A150.", "2.084"),
        ("G01 Z-30. ,R5. F0.2\nX60. Z#1", "-0.834"),
    ):
        assert limit in [number for _, number in printed(text)]
