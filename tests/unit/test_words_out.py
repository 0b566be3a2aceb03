"""A contour in the words of a control: the manuals' own blocks come back, and every candidate is the same contour."""

from math import hypot
from pathlib import Path

import pytest
from click.testing import CliRunner
from examples import law
from hypothesis import assume, strategies as st

import contoursolve
from contoursolve.__main__ import commands
from contoursolve.api import follow_program, parse
from contoursolve.comparison import Motion, Travel, follow
from contoursolve.geometry import Length
from contoursolve.postprocess import NumberGround
from contoursolve.sketches import read_sketch, solve_sketch

SKETCHES = sorted((Path(__file__).parent.parent / "sketches").glob("*.toml"))


@pytest.mark.parametrize(
    ("elements", "arguments", "status", "told"),
    [
        ("X = 30\nY = 10\nAN = 90", ("--to", "isg"), 1, "error[words-conflict]: AN90 disagrees with X30 and Y10"),
        ("LEN = 40\nY = 25", ("--to", "isg"), 1, "contour 1: guess = { X = -31.2250, Y = 25.0000 } in line 1"),
        ("AN = 30", ("--to", "isg"), 1, "error[words-missing]"),
        ("X = 0\nY = 0", ("--to", "isg"), 2, "the contour has no length, so that it has no words"),
        ("X = 30\nY = 10", ("--to", "fanuc-lathe"), 2, "the contour is milled, and this control is for lathes"),
        ("X = 30\nY = 10", ("--all",), 2, "--all goes with --to"),
        ("X = 30\nY = 10", ("-o", "new.nc"), 2, "-o goes with --to, and without --all and --format json"),
        ("X = 30\nY = ten", ("--to", "isg"), 2, "the file is no TOML"),
    ],
)
def test_the_command_says_why_it_writes_nothing(
    elements: str, arguments: tuple[str, ...], status: int, told: str, tmp_path: Path
):
    sketch = tmp_path / "s.toml"
    head = 'sketch = 1\npart = "milled"\nstart = { X = 0, Y = 0 }\n[[element]]\nkind = "line"\n'
    sketch.write_text(head + elements, encoding="utf-8")
    done = CliRunner().invoke(commands(), ["write", str(sketch), *arguments])
    assert (done.exit_code, told in done.output) == (status, True), done.output


def check_all(
    answer: contoursolve.Answer, found: contoursolve.WrittenContours, control: contoursolve.Control | None = None
) -> None:
    """Each candidate has no finding, and runs along the contour, over its whole length; the cheapest comes first."""
    assert found.candidates
    inch, control = answer.unit.value == "inch", control or contoursolve.CONTROLS[found.control]
    for each in found.candidates:
        result = follow_program(parse(each.program), control=control, strict=True, depth="verdict").collect()
        assert [one.code for one in result.diagnostics if one.code != "no-contour"] == []
        limit = (0.0052 if inch else 0.0021) if each.words(NumberGround.COMPUTED) else 1e-6
        is_rounded = limit > 1e-6 or each.deviation > 1e-6  # the start may be rounded, too
        path = followed(result, control, answer)
        assert len(path) >= len(answer.contour.elements)
        assert sum(travel.length() for travel in path) == pytest.approx(
            sum(element.length for element in answer.contour.elements), abs=0.02 if is_rounded else 1e-5
        )
        places = [travel.at(part / PARTS) for travel in path for part in range(PARTS + 1)]
        for point in answer.contour.sample(0.05):
            assert min(hypot(point[0] - at[0], point[1] - at[1]) for at in places) < longest(path) / PARTS + 0.01
        for place in places:
            assert beside(place, answer.contour) <= (0.0052 if is_rounded else 1e-6)
    assert [each.cost for each in found.candidates] == sorted(each.cost for each in found.candidates)


PARTS = 12


def followed(result: contoursolve.Result, control: contoursolve.Control, answer: contoursolve.Answer) -> list[Travel]:
    """The cuts of a program."""
    steps = follow(result, control, Length.MM, answer.plane.axes).steps
    assert all(isinstance(each, Travel) for each in steps)
    return [each for each in steps if each.motion is Motion.FEED]


def longest(path: list[Travel]) -> float:
    return max(travel.length() for travel in path)


def beside(place: tuple[float, ...], contour: contoursolve.Contour) -> float:
    """The distance of a point from the nearest line or circle of a contour."""
    off = []
    for each in contour.elements:
        if isinstance(each, contoursolve.ArcSegment):
            off.append(abs(hypot(place[0] - each.center[0], place[1] - each.center[1]) - each.radius))
            continue
        along = (each.end[0] - each.start[0], each.end[1] - each.start[1])
        aside = along[0] * (place[1] - each.start[1]) - along[1] * (place[0] - each.start[0])
        off.append(abs(aside) / hypot(*along))
    return min(off)


OF_KIND = {"turned": ("fanuc-lathe", "yasnac-lx3", "siemens-840d"), "milled": ("fanuc-mill", "isg", "heidenhain")}


@pytest.mark.parametrize(("number", "path"), [*enumerate(SKETCHES)], ids=lambda each: getattr(each, "stem", ""))
def test_sketches_are_written_for_a_control(number: int, path: Path):
    sketch = read_sketch(path.read_text(encoding="utf-8"))
    check_all(solve_sketch(sketch).answer, contoursolve.write(sketch, OF_KIND[sketch.part][number % 3]))


def test_a_control_of_the_other_kind_says_so():
    plate = contoursolve.solve("G17 G90 G00 X0 Y0\nG01 X40. ,R5.\nY30.", control="fanuc-mill")
    found = contoursolve.write(plate, "yasnac-lx3")
    assert (found.candidates, found.reason) == ((), "the contour is milled, and this control is for lathes")
    shaft = contoursolve.solve("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5.")
    table = contoursolve.write(shaft)
    assert [each.control for each in table] == [*contoursolve.CONTROLS]
    assert [each.control for each in table if each.candidates] == [
        *("yasnac-lx3", "fanuc-lathe", "haas-lathe", "siemens-840d", "siemens-808d", "isg", "cnc-pilot")
    ]
    lathe = contoursolve.write(shaft, "mitsubishi", settings={"mitsubishi.diameter": "on"})
    assert lathe.candidates[0].lines == ("G01 Z-30 ,R5", "X100 A120")
    assert "(contoursolve control: mitsubishi, diameter: on)" in lathe.candidates[0].program.split("\n")
    check_all(shaft.answers[0], lathe, contoursolve.CONTROLS["mitsubishi"].configure({"diameter": "on"}))


def test_an_open_contour_has_no_words():
    open_ = contoursolve.solve("G00 X40. Z0.\nG111 X100. A180. B120.")
    with pytest.raises(
        contoursolve.errors.UnfinishedError, match="there is no contour to write: cannot be cut; solve it first"
    ):
        contoursolve.write(open_, "fanuc-lathe")


NICE = st.integers(2, 12).map(lambda number: 5 * number)
STEPS = st.lists(
    st.tuples(
        st.sampled_from(["end", "angle", "open", "arc"]),
        NICE,
        st.sampled_from([15, 30, 45, 60, 70, 110, 120, 150]),
        st.sampled_from(["", "RND=2", "CHR=1.5"]),
    ),
    min_size=2,
    max_size=4,
)


@law(STEPS, st.booleans(), st.booleans(), few=2, many=8)
def test_random_contours_are_the_same_for_all_controls(
    steps: list[tuple[str, int, int, str]], is_turned: bool, is_inch: bool
):
    """A contour of SINUMERIK in the words of every control of its kind of machine."""
    across, along = ("X", "Z") if is_turned else ("Y", "X")
    lines, at, is_open = [], [20, 0], False
    for kind, number, angle, corner in steps:
        at = [at[0] + number, at[1] + 2 * number]
        place = f"{across}{at[0] * (1 + is_turned)} {along}{at[1]}"
        match "end" if is_open and kind in ("angle", "open") else kind:
            case "arc" if not is_open:
                lines.append(f"G3 {place} CR={3 * number} {corner}")
            case "angle":
                lines.append(f"G1 {across}{at[0] * (1 + is_turned)} ANG={min(angle, 80)} {corner}")
                is_open = False
            case "open":
                lines.append(f"G1 ANG={angle} {corner}")
                is_open = True
            case _:
                lines.append(f"G1 {place} {f'ANG={angle - 90}' if is_open else ''} {corner}")
                is_open = False
    head = f"{'G70' if is_inch else 'G71'} {'G18 DIAMON' if is_turned else 'G17'} G90 G0 {across}40 {along}0"
    result = contoursolve.solve("\n".join((head, *lines)), control="siemens-840d", depth="verdict")
    solved = [each for each in result.answers if each.contour is not None and each.contour.elements]
    assume(solved and not any(each.is_error for each in solved[0].diagnostics))
    for found in contoursolve.write(solved[0]):
        if found.candidates:
            check_all(solved[0], found)
