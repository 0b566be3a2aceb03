"""A contour in the words of a control: the manuals' own blocks come back, and every candidate is the same contour."""

import re
from math import hypot
from pathlib import Path

import pytest
from click.testing import CliRunner
from examples import law
from hypothesis import assume, strategies as st

import contoursolve
from contoursolve.__main__ import commands
from contoursolve.comparison import Motion, Travel, follow
from contoursolve.geometry import Length
from contoursolve.sketches import read_sketch, solve_sketch

SKETCHES = sorted((Path(__file__).parent.parent / "sketches").glob("*.toml"))

OWN_WORDS = [
    # control, program, its contour's blocks as they come back
    (
        "fanuc-lathe",
        "G00 X0. Z0.\nG01 X60. ,A90. ,C1.\nZ-30. ,A180. ,R6.\nX100. ,A90.",
        "G01 X60. ,C1./Z-30. ,R6./X100.",
    ),
    (
        "fanuc-lathe",
        "G00 X100. Z-30.\nG01 ,A170. ,R20.\nX300. Z-180. ,A112. ,R15.\nZ-230. ,A180.",
        "G01 ,A170. ,R20./X300. Z-180. ,A112. ,R15./Z-230.",
    ),
    ("fanuc-lathe", "G00 X20. Z0.\nG01 Z-25. R5.\nX50. K-3.\nZ-50.", "G01 Z-25. ,R5./X50. ,C3./Z-50."),
    ("isg", "G0 X10 Y10\nG01 #ANG=35 Y20", "G01 Y20 #ANG=35"),
    ("isg", "G0 X0 Y0\nG91 G01 X80 Y-40\nG301 I40\nG01 X80 Y40", "G01 X80 Y-40 #CHR=40/X160 Y0"),
    ("isg", "G0 X0 Y0\nG91 G01 X60\nG302 I30\nX-40 Y-55", "G01 X60 #RND=30/X20 Y-55"),
    ("nct-99m", "G17 G90 G41 D0 G0 X90 Y10\nG1 X50 Y33.094\nX10 Y20 ,A225", "G01 X50 Y33.094/X10 Y20 ,A225"),
    ("nct-99m", "G17 G0 X0 Y0\nG91 G01 X30 ,R8\nG03 X-30 Y30 R30", "G01 X30 ,R8/G03 X0 Y30 R30"),
    ("mitsubishi", "G17 G00 X10. Y5.\nG01 X40. A25.", "G01 X40 A25"),
    # The manual gives the line's end twice: its height is enough.
    ("mitsubishi", "G17 G00 X0. Y0.\nG01 A60.\nX50. Y60. A0", "G01 Y60 A60/X50"),
    ("siemens-840d", "G18 DIAMON G0 X23.293 Z0\nG1 X40 Z-30\nCT X58.146 Z-42", "G01 X40 Z-30/CT X58.146 Z-42"),
    (
        "heidenhain",
        (
            "0 BEGIN PGM A MM\n1 L X+0 Y+0 R0\n10 FPOL X+50 Y+20\n11 FL LEN64.5 CLSD+ P1X+15 P1Y+35\n12 FSELECT 1\n"
            "13 FL PR+67 AN+21\n14 FL IX+15 IY+0\n15 FL LEN 40 PAR 11\n16 FSELECT 2\n17 FL X+75 Y+20\n18 FL CLSD-\n"
            "19 END PGM A MM"
        ),
        (
            "5 FL LEN64.5 CLSD+ P1X+15 P1Y+35/6 FSELECT 1/7 FPOL X+50 Y+20/8 FL PR+67 AN+21/9 FL IX+15 IY+0/"
            "10 FL LEN40 PAR 5/11 FSELECT 2/12 FL X+75 Y+20/13 FL CLSD-"
        ),
    ),
    (
        "heidenhain",
        (
            "0 BEGIN PGM A MM\n1 L X+0 Y+30 R0\n2 FC DR- R20 CCX+20 CCY+30\n3 FLT\n"
            "4 FCT DR- R12 CCX+90 CCY+45 X+102 Y+45\n5 END PGM A MM"
        ),
        "5 FC R20 CCX+20 CCY+30 DR-/6 FLT/7 FCT R12 CCX+90 CCY+45 X+102 Y+45 DR-",
    ),
    (
        "heidenhain",
        (
            "0 BEGIN PGM A MM\n7 L X+0 Y+0 R0\n8 FL AN+80 LEN50 CLSD+\n9 FCT DR- R15\n10 FLT X+90 Y+40\n11 RND R8\n"
            "12 FL X+90 Y+0\n13 CHF 5\n14 FL X+0 Y+0 CLSD-\n17 END PGM A MM"
        ),
        "5 FL AN+80 LEN50/6 FCT R15 DR-/7 FLT X+90 Y+40/8 RND R8/9 L Y+0/10 CHF 5/11 L X+0",
    ),
    (
        "fanuc-mill",
        "G17 G90 G00 X10. Y10.\nG01 X50. ,C5.\nY25. ,R8.\nG03 X80. Y55. R30. ,R8.\nG01 X50. ,R8.\nY70. ,C5.\nX10.",
        "G01 X50. ,C5./Y25. ,R8./G03 X80. Y55. R30. ,R8./G01 X50. ,R8./Y70. ,C5./X10.",
    ),
    ("haas-lathe", "G20 G00 X0 Z0\nG01 X1.0 ,C0.05\nZ-0.75 ,R0.1\nX2.0", "G01 X1. ,C0.05/Z-0.75 ,R0.1/X2."),
    ("yasnac-lx3", "G00 X40. Z0.\nG111 X100. A180. K-30. B120. C5. D5.", "G111 A180. B120. K-30. X100. C5. D5."),
    ("yasnac-lx3", "G00 X100. Z-50.\nG112 U0 I10. K-50. P5. Q5. R30.", "G112 I10. K-50. R30. X100. P5. Q5."),
    ("yasnac-lx3", "G00 X30. Z0.\nG12 Z-20. I8.\nX80. K-7.", "G12 I8. Z-20."),
    ("nct-99m", "G17 G90 G41 D0 G0 X90 Y10\nG1 ,A150\nX10 Y20 ,A225", "G01 ,A150/X10 Y20 ,A225"),
    (
        "nct-99m",
        "G17 G0 X50 Y0 G42 D0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1",
        "G03 I-50 J0/G01 X-50 Y42.857 ,A171.87 Q-1",
    ),
    ("mitsubishi", "G17 G00 X0 Y5.\nG01 A10.\nG02 X60. Y15. I-20. J-25. H1", "G01 A10/G02 X60 Y15 I-20 J-25 H1"),
    ("mitsubishi", "G17 G00 X0 Y0\nG01 A15.\nG03 X70. Y50. R30.", "G01 A15/G03 X70 Y50 R30"),
    (
        "siemens-840d",
        "G18 DIAMON G0 X40.9297 Z-22.8868\nG1 ANG=175 RND=10\nX70 Z-60 ANG=105 CHR=2\nZ-85 RND=3\nX84",
        "G01 ANG=175 RND=10/X70 Z-60 ANG=105 CHR=2/Z-85 RND=3/X84",
    ),
    (
        "heidenhain",
        (
            "0 BEGIN PGM A MM\n1 L X+0 Y+0 R0\n12 FPOL X+10 Y+10\n13 FL PR+20 PA+20\n14 FL AN+45\n"
            "15 FCT IX+20 DR- R20 CCA+90 RX 13\n16 FL IPR+35 PA+0 RPR 13\n17 END PGM A MM"
        ),
        "5 FPOL X+10 Y+10/6 FL PR+20 PA+20/7 FL AN+45/8 FCT IX+20 R20 CCA+90 RX 6 DR-/9 FL IPR+35 PA+0 RPR 6",
    ),
]


@pytest.mark.parametrize(("control", "text", "blocks"), OWN_WORDS)
def test_the_words_of_manuals_come_back_and_all_that_is_found_is_the_same_contour(control: str, text: str, blocks: str):
    answer = contoursolve.solve(text, control=control).answers[0]
    found = contoursolve.write(answer, control)
    assert "/".join(found.candidates[0].lines) == blocks
    assert not found.candidates[0].words(contoursolve.NumberGround.COMPUTED)
    check_all(answer, found)


PROGRAMS = {
    "fanuc-lathe": "%\nO0001\n{}G21\n{}G00 X0 Z0\nG01 X40. ,C1.5\nZ-30.\nX80. ,A135. ,R2.\nZ-60.\nM30\n%\n",
    "yasnac-lx3": "%\nO0001\n{}G21\n{}G00 X0 Z0\nG01 K-1.5 X40.\nZ-30.\nG111 A135. B180. X80. Z-60. P2.\nM30\n%\n",
    "siemens-840d": "{}G71 G18 G90 DIAMON\n{}G00 X0 Z0\nG01 X40 CHR=1.5\nZ-30\nX80 ANG=135 RND=2\nZ-60\nM30\n",
    "isg": "%CONTOUR\n{}G71 G18 G90 G51\n{}G00 X0 Z0\nG01 X40 #CHR=1.5\nZ-30\nX80 #ANG=135 #RND=2\nZ-60\nM30\n",
}
TOLD = (
    "contoursolve control: {}",
    "Add tool, speed, feed, approach and retract: they are not in it.",
    "The next block is a rapid straight to the start of the contour. Make it a safe approach.",
)


@pytest.mark.parametrize("control", PROGRAMS)
def test_the_command_writes_a_whole_program(control: str, tmp_path: Path):
    sketch = Path(__file__).parent.parent / "sketches" / "turned_shaft.toml"
    done = CliRunner().invoke(commands(), ["write", str(sketch), "--to", control, "-o", str(tmp_path / "new.nc")])
    assert (done.exit_code, done.stdout) == (0, "")
    remark = contoursolve.DIALECTS[control].modes.syntax.remark
    own, missing, rapid = (f"{remark.format(each.format(control))}\n" for each in TOLD)
    text = (tmp_path / "new.nc").read_text(encoding="utf-8")
    assert text == PROGRAMS[control].format(own + missing, rapid)
    checked = CliRunner().invoke(commands(), ["check", "--strict", str(tmp_path / "new.nc")])
    assert (checked.exit_code, checked.stdout.split("solved")[1]) == (0, ", no problems\n")


@pytest.mark.parametrize(
    ("elements", "arguments", "status", "told"),
    [
        ("X = 30\nY = 10\nAN = 90", ("--to", "isg"), 1, "error[words-conflict]: AN90 disagrees with X30 and Y10"),
        ("LEN = 40\nY = 25", ("--to", "isg"), 1, "contour 1: guess = { X = -31.2250, Y = 25.0000 } in line 1 chooses"),
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
    answer: contoursolve.Answer, found: contoursolve.Written, control: contoursolve.Dialect | None = None
) -> None:
    """Each candidate has no finding, and runs along the contour, over its whole length; the cheapest comes first."""
    assert found.candidates
    inch, control = answer.unit.value == "inch", control or contoursolve.DIALECTS[found.control]
    for each in found.candidates:
        told = contoursolve.check(each.program, control=control, strict=True)
        assert [one.code for one in told if one.code != "no-contour"] == []
        limit = (0.0052 if inch else 0.0021) if each.words(contoursolve.NumberGround.COMPUTED) else 1e-6
        is_rounded = limit > 1e-6 or each.deviation > 1e-6  # the start may be rounded, too
        path = followed(each.program, control, answer)
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


def followed(text: str, control: contoursolve.Dialect, answer: contoursolve.Answer) -> list[Travel]:
    """The cuts of a program."""
    result = contoursolve.solve(text, control=control)
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


@pytest.mark.parametrize("number", range(3))
@pytest.mark.parametrize("path", SKETCHES, ids=lambda path: path.stem)
def test_sketches_are_written_for_three_controls(path: Path, number: int):
    sketch = read_sketch(path.read_text(encoding="utf-8"))
    check_all(solve_sketch(sketch).answer, contoursolve.write(sketch, OF_KIND[sketch.part][number]))


def test_a_control_of_the_other_kind_says_so():
    plate = contoursolve.solve("G17 G90 G00 X0 Y0\nG01 X40. ,R5.\nY30.", control="fanuc-mill")
    found = contoursolve.write(plate, "yasnac-lx3")
    assert (found.candidates, found.reason) == ((), "the contour is milled, and this control is for lathes")
    shaft = contoursolve.solve("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5.")
    table = contoursolve.write_for_all(shaft)
    assert [each.control for each in table] == [*contoursolve.DIALECTS]
    assert [each.control for each in table if each.candidates] == [
        *("yasnac-lx3", "fanuc-lathe", "haas-lathe", "siemens-840d", "siemens-808d", "isg", "cnc-pilot")
    ]
    lathe = contoursolve.write(shaft, "mitsubishi", settings={"mitsubishi.diameter": "on"})
    assert lathe.candidates[0].lines == ("G01 Z-30 ,R5", "X100 A120")
    assert "(contoursolve control: mitsubishi, diameter: on)" in lathe.candidates[0].program.split("\n")
    check_all(shaft.answers[0], lathe, contoursolve.DIALECTS["mitsubishi"].configure({"diameter": "on"}))


def test_a_corner_without_a_word_has_its_own_block():
    shaft = contoursolve.solve("G00 X40. Z0.\nG111 X100. A150. K-30. B110. C3.")
    found = contoursolve.write(shaft, "fanuc-lathe")
    assert found.reason == "this control has no word for corner 1: a block of its own makes it"
    check_all(shaft.answers[0], found)
    bow = contoursolve.solve("G17 G90 G00 X0 Y0\nG01 X40. ,R5.\nG03 X60. Y20. R25.", control="fanuc-mill")
    told = contoursolve.write(bow, "haas-mill")
    assert told.reason.startswith("this control has no word for corner 1")
    check_all(bow.answers[0], told)


BY_LENGTH = """sketch = 1
part = "milled"
start = { X = 0, Y = 0 }
[[element]]
kind = "line"
LEN = 40
Y = 25
guess = { X = 31, Y = 25 }
[[element]]
kind = "line"
AN = 0
LEN = 20
"""
WHY_PLAIN = [
    (BY_LENGTH, "siemens-840d", "plain lines and arcs are the shortest; 3 further ways have the control's own words"),
    (BY_LENGTH, "fanuc-mill", "these are plain lines and arcs: the control has no other words for this contour"),
    (
        "guessed_meeting",
        "yasnac-lx3",
        (
            "these are plain lines and arcs: the control refuses its own words for this contour (g112-touches: the "
            "line through V2 just touches the arc, so the path has no corner there)"
        ),
    ),
]


@pytest.mark.parametrize(("sketch", "control", "told"), WHY_PLAIN)
def test_plain_lines_that_come_first_say_why(sketch: str, control: str, told: str):
    own = [path.read_text(encoding="utf-8") for path in SKETCHES if path.stem == sketch]
    found = contoursolve.write(read_sketch(*own or [sketch]), control)
    assert (found.reason, found.candidates[0].is_plain) == (told, True)
    assert sum(not each.is_plain for each in found.candidates) == (3 if "3 further" in told else 0)


@pytest.mark.parametrize("path", SKETCHES, ids=lambda path: path.stem)
def test_no_two_ways_differ_in_increments_alone(path: Path):
    sketch = read_sketch(path.read_text(encoding="utf-8"))
    for control in OF_KIND[sketch.part]:
        ways = [re.sub(r"[-+]?[.\d]+", "", each.program) for each in contoursolve.write(sketch, control).candidates]
        alike = [re.sub(r"\bU", "X", re.sub(r"\bW", "Z", re.sub(r"=IC\(\)", "", each))) for each in ways]
        blocks = [tuple(tuple(sorted(line.split())) for line in each.split("\n")) for each in alike]
        assert len({*blocks}) == len(blocks)


def test_an_open_contour_has_no_words():
    open_ = contoursolve.solve("G00 X40. Z0.\nG111 X100. A180. B120.")
    with pytest.raises(contoursolve.UnfinishedError, match="the contour is refused: solve it first"):
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


@law(STEPS, st.booleans(), st.booleans(), few=2, many=12)
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
    for found in contoursolve.write_for_all(solved[0]):
        if found.candidates:
            check_all(solved[0], found)


def test_a_point_inside_an_arc_is_computed_where_it_is_rounded():
    """An arc that is too long for CR= is three: the points between them are told with what rounding puts them off."""
    arc = contoursolve.solve("G17 G00 X0 Y0\nG01 X20.\nG03 X7. Y15. R-12.3 ,R1.\nG01 X-40.", control="fanuc-mill")
    words = [word for each in contoursolve.write(arc, "siemens-840d").candidates for word in each.blocks[0].words]
    assert [(word.ground.value, f"{word.off:.4f}") for word in words if word.text in ("X31.288", "Y12.011")] == [
        ("computed and rounded", "0.0001"),
        ("computed and rounded", "0.0003"),
    ]
