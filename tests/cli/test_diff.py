"""Whether two programs describe the same path: by worked examples, by laws, and by LinuxCNC's own interpreter."""

import json
import re
import subprocess
from math import atan2, cos, dist, pi, radians, sin
from pathlib import Path

import pytest
from calling import call
from examples import law
from hypothesis import assume, strategies as st

import contoursolve
from contoursolve.comparison import follow
from contoursolve.controls import PLAIN as PLAIN_CONTROLS
from contoursolve.gcode import parse
from contoursolve.geometry import Length
from contoursolve.program import Request, run

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
SHAFT, PLATE = (PROGRAMS.joinpath(name).read_text() for name in ("shaft.nc", "plate.nc"))


def invoke(*arguments, stdin=None):
    done = call("diff", *arguments, stdin=stdin)
    return done.exit_code, done.output


@pytest.fixture(scope="module")
def diff(tmp_path_factory):
    folder = tmp_path_factory.mktemp("diff")

    def run(old, new, *arguments):
        for name, text in (("old.nc", old), ("new.nc", new)):
            (folder / name).write_text(text)
        status, output = invoke(folder / "old.nc", folder / "new.nc", "--format", "json", *arguments)
        document = json.loads(output)
        assert status == (0 if document["verdict"] == "equal" else 1)
        return document

    return run


def replaced(program, **lines):
    """A program with the blocks of these numbers written by hand."""
    for number, text in lines.items():
        program, changed = re.subn(rf"^{number} .*$", f"{number} {text}", program, flags=re.MULTILINE)
        assert changed == 1
    return program


# --- Differences that are named --------------------------------------------------------------------

MANUAL = "G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5."
LINUXCNC = """G7 G18 G21 G90 G91.1 (X is a diameter)
G0 X40 Z0
G1 Z-27.1132 F100
G2 X45 Z-31.4434 I5 K0
G1 X95 Z-45.8771
G3 X100 Z-50.2073 R5
M2"""
RADIUS = re.sub(r"X(\d+)", lambda match: f"X{int(match[1]) / 2}", LINUXCNC).replace("G7", "G8")


@pytest.mark.parametrize(
    ("new", "reason"),
    [
        (LINUXCNC.replace("X95", "X95.02"), "^they end apart$"),
        (LINUXCNC.replace("X45 Z-31.4434", "X45.1 Z-31.4434"), "only NEW has a block that diff does not follow"),
        (LINUXCNC.replace("G7", "G8"), "start apart|end apart"),
        (LINUXCNC.replace("G2 X45", "G3 X45"), "opposite directions"),
        (LINUXCNC.replace("G2 X45 Z-31.4434 I5 K0", "G1 X45 Z-31.4434"), "OLD is an arc, NEW is a line"),
        (LINUXCNC.replace("R5", "R5.05"), "run apart between"),
        (LINUXCNC.replace("R5", "R-5"), "run apart between"),
        (LINUXCNC.replace("G1 X95", "G0 X95"), "OLD is a feed, NEW is a rapid"),
        (LINUXCNC.replace("G1 X95", "/G1 X95"), "only NEW can be skipped"),
        (LINUXCNC.replace("G1 X95", "G41 G1 X95"), "OLD is compensated by G40, NEW by G41"),
        (LINUXCNC.replace("\nM2", "\nG0 X110"), "NEW goes on"),
        (LINUXCNC.partition("G3")[0], "OLD goes on"),
        (LINUXCNC.replace("X95 Z-45.8771", "X95 Z-45.8771 A5"), "only NEW has a block that diff does not follow"),
        (LINUXCNC.replace("I5 K0", "I5 K0.1"), "only NEW has a block that diff does not follow"),
        (LINUXCNC.replace("I5 K0", ""), "only NEW has a block that diff does not follow"),
    ],
)
def test_what_is_different_is_named(diff, new, reason):
    found = diff(MANUAL, new, "--new-control", "linuxcnc")
    assert found["verdict"] == "different"
    assert re.search(reason, found["difference"]["reason"]), found["difference"]


# --- What is not followed --------------------------------------------------------------------------


@pytest.mark.parametrize("program", [SHAFT, PLATE], ids=["shaft", "plate"])
def test_a_program_is_equal_to_itself_and_what_is_not_followed_is_named(diff, program):
    found = diff(program, program)
    assert found["verdict"] == "equal"
    assert found["largest_deviation"]["mm"] == 0
    named = [each["text"].split()[1] for each in found["old"]["not_followed"]]
    assert named[0] in ("G28", "G54")
    assert ("G81" in named) or ("G90" in named)
    assert found["old"]["not_followed"] == found["new"]["not_followed"]


@pytest.mark.parametrize(
    "line",
    [
        "G28 U0 W0",
        "M98 P100",
        "#100 = #5041",
        "G65 P9000 A1.",
        "G01 X#100",
        "G71 P1 Q2 U0.5",
        "G54",
        "G99.3 X1.",
        "GOTO 5",
    ],
)
def test_what_is_not_followed_must_be_the_same_word_by_word(diff, line):
    program = MANUAL + "\n{}\nG00 X40. Z10."
    assert diff(program.format(line), program.format(line))["verdict"] == "equal"
    assert diff(program.format(line), program.format(f"N7 {line} (COMMENT)"))["verdict"] == "equal"
    for other in ("(NOTHING)", line + "1", "G30 U0 W0"):
        assert diff(program.format(line), program.format(other))["verdict"] == "different"


def test_a_program_that_has_errors_has_no_path(diff):
    found = diff(SHAFT, PROGRAMS.joinpath("shaft_broken.nc").read_text())
    assert found["verdict"] == "not-compared"
    assert {each["code"] for each in found["diagnostics"]} >= {"g111-a-ignored", "words-missing"}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("-", "-"), "standard input"),
        (("missing.nc", PROGRAMS / "shaft.nc"), "no such file"),
        ((PROGRAMS / "shaft.nc", PROGRAMS / "shaft.nc", "--tolerance", "0"), "tolerance"),
        ((PROGRAMS / "shaft.nc", PROGRAMS / "shaft.nc", "--control", "unknown"), "linuxcnc"),
        (("-", PROGRAMS / "shaft.nc"), "say which with --control"),
        ((PROGRAMS / "shaft.nc", PROGRAMS / "shaft.nc", "--setting", "x.y=z"), "no setting"),
    ],
)
def test_what_cannot_run_ends_with_2(arguments, said):
    status, output = invoke(*arguments, stdin="G0 X1")
    assert status == 2
    assert said in output


# --- Laws ------------------------------------------------------------------------------------------

lengths = st.integers(2_000, 40_000).map(lambda value: value / 1000)
turns = st.integers(20, 150).flatmap(lambda value: st.sampled_from((value, -value)))
sweeps = st.integers(30, 300).flatmap(lambda value: st.sampled_from((value, -value)))
pieces = st.lists(st.tuples(turns, lengths, st.none() | sweeps), min_size=2, max_size=8)


def write(drawing, turned=(), split=()):
    """Plain G-code of lines and arcs with a corner between each two; some arcs reversed, some elements in two."""
    x = y = heading = 0.0
    blocks = ["G17 G21 G90 G91.1", "G0 X0 Y0"]
    for number, (turn, size, sweep) in enumerate(drawing):
        heading += radians(turn)
        if sweep is None:
            parts = (0.4, 0.6) if number in split else (1.0,)
            for part in parts:
                x, y = x + part * size * cos(heading), y + part * size * sin(heading)
                blocks.append(f"G1 X{x:.6f} Y{y:.6f}")
            continue
        side = pi / 2 if sweep > 0 else -pi / 2
        center = x + size * cos(heading + side), y + size * sin(heading + side)
        parts = (0.4, 0.6) if number in split else (1.0,)
        for part in parts:
            i, j = center[0] - x, center[1] - y
            angle = atan2(-j, -i) + radians(sweep * part)
            x, y = center[0] + size * cos(angle), center[1] + size * sin(angle)
            code = 3 if (sweep > 0) != (number in turned) else 2
            blocks.append(f"G{code} X{x:.6f} Y{y:.6f} I{i:.6f} J{j:.6f}")
        heading += radians(sweep)
    return "\n".join(blocks)


PLAIN = ("--control", "linuxcnc")


@law(pieces, st.data())
def test_dividing_lines_and_arcs_changes_nothing(diff, drawing, data):
    parts = [data.draw(st.sets(st.integers(0, len(drawing) - 1))) for _ in range(2)]
    one, other = (write(drawing, split=each) for each in parts)
    found = diff(one, other, *PLAIN)
    assert found["verdict"] == "equal", found["difference"]
    assert found["largest_deviation"]["mm"] < 1e-5
    back = diff(other, one, *PLAIN)
    assert (back["verdict"], back["largest_deviation"]["mm"]) == ("equal", found["largest_deviation"]["mm"])


@law(pieces, st.data())
def test_every_coordinate_that_is_changed_by_a_hundredth_is_found(diff, drawing, data):
    one = write(drawing)
    other = write(drawing, split=data.draw(st.sets(st.integers(0, len(drawing) - 1))))
    places = list(re.finditer(r"(?<=[XY])-?\d+\.\d+", one))
    place = data.draw(st.sampled_from(places))
    value = float(place[0]) + data.draw(st.sampled_from((0.01, -0.01)))
    changed = one[: place.start()] + f"{value:.6f}" + one[place.end() :]
    for pair in ((changed, other), (other, changed)):
        found = diff(*pair, *PLAIN)
        assert found["verdict"] == "different"


# --- All differences -------------------------------------------------------------------------------

TURNED = """O1 (STUB SHAFT)
G21 G40 G99
T0101
G50 S2500
G00 X16. Z3. M08
G42 G01 Z0. F0.15
X20. ,C1.
Z-25. ,R3.
X30. ,C1.
Z-40.
X40. ,A150.
Z-60.
G02 X60. Z-70. R10.
G01 Z-85.
X72.
G40 G00 X150. Z100. M09
M30"""


def quoted(changes):
    return [tuple(each[name] and each[name]["text"] for name in ("old", "new")) for each in changes]


def test_a_harmless_difference_hides_no_other_one(diff):
    changed = [("T0101", "T0202"), ("F0.15", "F0.25"), ("X30. ", "X30.01 "), ("Z-70. R10.", "Z-70.2 R10.")]
    new = TURNED
    for before, behind in changed:
        new = new.replace(before, behind)
    found = diff(TURNED, new.replace("SHAFT", "SHAFT B"), "--control", "fanuc-lathe")
    assert [quoted(each["changes"]) for each in found["differences"]] == [[("Z-70.", "Z-70.2")], [("X30.", "X30.01")]]
    assert [each["changes"][0]["by"] for each in found["differences"]] == [-0.2, 0.01]
    assert [each["old_lines"] for each in found["differences"]] == [[13, 14], [9, 12]]
    # The line of 150 degrees begins 0.005 mm higher, and ends on X40. so much farther along Z.
    assert [each["distance_mm"] for each in found["differences"]] == [0.2, pytest.approx(0.005 * 3**0.5, abs=1e-6)]
    assert found["difference"]["old"]["line"] == 9
    assert quoted(found["besides"]) == [("T0101", "T0202"), ("F0.15", "F0.25"), ("(STUB SHAFT)", "(STUB SHAFT B)")]


@pytest.mark.parametrize(
    ("before", "behind", "besides"),
    [
        ("T0101", "T0101 (NEW)\nM01", [(None, "M01"), (None, "(NEW)")]),
        ("S2500", "S3000", [("S2500", "S3000")]),
        ("M08", "M07", [("M08", "M07")]),
        ("G01 Z-85.", "G01 Z-85. F0.15", []),
        ("G01 Z-85.", "G01 Z-85. F.1", [(None, "F.1")]),
        ("G00 X16. Z3.", "N7 G0 Z3.00 X16.", []),
        ("Z-25. ,R3.", "W-25. ,R3.", []),
        ("G02 X60. Z-70. R10.", "G02 X60. Z-70. I10. K0.", []),
        ("Z-85.", "Z-77.\nZ-85.", []),
        ("M09", "M09\nG04 X1.5", [(None, "G04 X1.5")]),
        ("G40 G99", "G40 G98", [("G99", "G98")]),
    ],
)
def test_what_changes_no_path_is_told_apart(diff, before, behind, besides):
    new = TURNED.replace(before, behind, 1)
    for pair, told in (((TURNED, new), besides), ((new, TURNED), [each[::-1] for each in besides])):
        found = diff(*pair, "--control", "fanuc-lathe")
        assert (found["verdict"], found["differences"], quoted(found["besides"])) == ("equal", [], told)


@pytest.mark.parametrize(
    ("before", "behind"),
    [("G42", "G41"), ("G54", "G55"), ("X3.", "X4."), ("G17", "G18"), ("G21", "G20"), ("G90", "G91")],
)
def test_a_code_that_the_path_hangs_on_is_the_path(diff, before, behind):
    program = "G17 G21 G90\nG10 L2 P1 X3.\nG54\nG0 X1. Y1. Z5.\nG42 D1 G1 X5. F100\nY7.\nX9.\nG40 G0 Y20."
    found = diff(program, program.replace(before, behind), "--control", "fanuc-mill")
    assert found["verdict"] == "different"
    assert (before, behind) in [pair for each in found["differences"] for pair in quoted(each["changes"])]
    assert found["besides"] == []


def test_a_picture_shows_both_paths_and_marks_their_differences(tmp_path):
    names = [tmp_path / name for name in ("old.nc", "new.nc", "both.svg")]
    names[0].write_text(TURNED)
    names[1].write_text(TURNED.replace("X30. ", "X30.01 ").replace("Z-70. R10.", "Z-70.2 R10."))
    status, output = invoke(*names[:2], "--control", "fanuc-lathe", "--plot", names[2])
    assert (status, output.splitlines()[-1]) == (1, f"{names[2]} written")
    drawn = names[2].read_text(encoding="utf-8")
    for told in ("OLD alone", "NEW alone", "both programs", "Z-70. becomes Z-70.2", "X30. becomes X30.01"):
        assert told in drawn
    # The smaller one is shown enlarged.
    assert "1000 times as large" in drawn
    assert "not drawn" not in drawn
    status, output = invoke(*names[:2], "--control", "fanuc-lathe", "--plot", names[2])
    assert (status, "--force" in output) == (2, True)


def test_a_picture_says_how_many_moves_it_leaves_out(tmp_path, monkeypatch):
    monkeypatch.setattr("contoursolve.pictures.two_paths.MOST_MOVES", 1)
    names = [tmp_path / name for name in ("old.nc", "new.nc", "both.svg")]
    names[0].write_text(program := "G17 G21 G90\nG0 X0 Y0\nG1 X10. F100\nY10.\nX20.\n")
    names[1].write_text(program.replace("X20.", "X21."))
    invoke(*names[:2], "--control", "fanuc-mill", "--plot", names[2])
    assert "... and 2 more moves, which are not drawn" in names[2].read_text(encoding="utf-8")


corners = st.lists(
    st.tuples(st.integers(-40_000, 40_000), st.integers(5_000, 40_000)).map(lambda at: (at[0] / 1000, at[1] / 1000)),
    min_size=4,
    max_size=9,
)


def polygon(points, more=()):
    """Lines that go up from point to point; some have a further point before them."""
    y, blocks = 0.0, ["G17 G21 G90", "G0 X0 Y0"]
    places = [(0.0, 0.0)]
    for x, up in points:
        y += up
        places.append((x, y))
    for number, (x, y) in enumerate(places[1:], 1):
        if number in more:
            blocks.append(f"G1 X{more[number][0]:.6f} Y{more[number][1]:.6f}")
        blocks.append(f"G1 X{x:.3f} Y{y:.3f}")
    return "\n".join(blocks), places


@law(corners, st.data(), many=60)
def test_each_change_is_told_by_its_amount_behind_inserted_and_deleted_moves(diff, points, data):
    _, places = polygon(points)
    kinds = data.draw(st.lists(st.sampled_from(("same", "moved", "added")), min_size=len(points), max_size=len(points)))
    amounts = data.draw(st.lists(st.integers(1, 1_000), min_size=len(points), max_size=len(points), unique=True))
    more, moved, expected = {}, list(points), []
    used, before = -9, ""
    for number, (kind, off) in enumerate(zip(kinds, amounts, strict=True), 1):
        if kind == "same" or number < used + (1 if kind == "moved" == before else 3):
            continue
        used, away, before = number, off / 500, kind
        (x, y), (u, v) = places[number - 1], places[number]
        if kind == "moved":
            # A corner of two lines that are almost one can move along them: the path stays the same then.
            ends = places[number - 1], *places[number + 1 :][:1]
            assume(all(abs(away * (v - b)) > 0.002 * dist((u, v), (a, b)) for a, b in ends))
            moved[number - 1] = (u + away, v - y)
        else:
            # Beside the middle of a line, at a right angle to it.
            long = dist((x, y), (u, v))
            more[number] = (x + u) / 2 - away * (v - y) / long, (y + v) / 2 + away * (u - x) / long
        expected.append((away, kind))
    pair = polygon(points)[0], polygon(moved, more)[0]
    is_back = data.draw(st.booleans())
    found = diff(*pair[:: -1 if is_back else 1], *PLAIN)["differences"]
    expected.sort(reverse=True)
    assert [each["distance_mm"] for each in found] == pytest.approx([away for away, _ in expected], abs=2e-6)
    for each, (away, kind) in zip(found, expected, strict=True):
        if kind == "moved":
            assert [abs(change["by"]) for change in each["changes"]] == [pytest.approx(away)]
        else:
            assert (each["old"] is None, each["new"] is None) == (not is_back, is_back)
            assert each["reason"] == f"only {'OLD' if is_back else 'NEW'} has this move"


@law(st.integers(20, 60), st.integers(100, 160), st.integers(1, 8), st.integers(1, 8))
def test_a_program_and_itself_written_out_are_equal(diff, deep, angle, first, second):
    program = f"G00 X40. Z0. M08\nG111 X120. A180. K-{deep}. B{angle}. P{first}. Q{second}. F0.2\nG00 X130. M09"
    written = call("expand", "--control", "yasnac-lx3", "-", stdin=program)
    assert written.exit_code == 0, written.output
    found = diff(program, written.stdout, "--control", "yasnac-lx3", "--tolerance", "0.002")
    assert (found["verdict"], found["differences"]) == ("equal", []), found["differences"]
    assert {each["kind"] for each in found["besides"]} == {"kept-block"}


MILL = "G17 G21 G90 G91.1\nG0 X0 Y0 Z0\n"
TINY = "".join(f"G1 X{x / 10_000:.4f}\n" for x in (*range(8, 900, 8), *range(900, 8, -8)))


@pytest.mark.parametrize(
    ("old", "new", "verdict"),
    [
        ("G1 X10", "G1 X9.9995", "equal"),
        ("G1 X10", "G1 X9.9985", "different"),
        ("G0 X10", "G0 X4\nX10", "equal"),
        ("G0 X10 Y5", "G0 X4 Y2\nX10 Y5", "different"),
        ("G33 X10 K1", "G33 X4 K1\nX10 K1", "different"),
        ("G1 X10 Y5 Z5", "G1 X4 Y2 Z2\nX10 Y5 Z5", "equal"),
        ("G2 X10 I5 Z5", "G2 X5 Y5 I5 Z2.5\nG2 X10 Y0 J-5 Z5", "equal"),
        ("G2 X10 I5 Z5", "G2 X5 Y5 I5 Z2.51\nG2 X10 Y0 J-5 Z5", "different"),
        ("G2 I5", "G2 X10 I5\nX0 I-5", "equal"),
        ("G2 I5", "G2 X10 I5", "different"),
        ("G1 X10\nX0", "G1 X0", "different"),
        ("G1 X10", "G1 X12\nX10", "different"),
        ("G1 X10", "G1 X10.0008\nX10", "equal"),
        ("G1 Y10", TINY + "G1 X0\nY10", "different"),
        ("G1 Y10", "G1 Y10\n" + TINY + "X0", "different"),
        ("G1 X.0009\nG1 Y10", "G1 Y10", "equal"),
        ("G1 X10 Y0.0018", "G1 X5 Y0\nX10 Y0.0018", "equal"),
        ("G1 X10 Y0.0030", "G1 X5 Y0\nX10 Y0.0030", "different"),
        ("G92 X5\nG1 X10", "G92 X5.01\nG1 X10", "different"),
        ("G1 X1", "G1 X1\nG92 X5", "different"),
        ("G41 G1 X1", "G1 X1", "different"),
    ],
)
def test_a_cut_may_be_divided_and_nothing_else(diff, old, new, verdict):
    for pair in ((old, new), (new, old)):
        found = diff(*(MILL + text for text in pair), *PLAIN)
        assert found["verdict"] == verdict, found["difference"]


# --- LinuxCNC's interpreter ------------------------------------------------------------------------

INTERPRETED = {
    "lathe": LINUXCNC,
    "radius": RADIUS,
    "inches": LINUXCNC.replace("G21", "G20"),
    "absolute centres": "G17 G90 G90.1 G21\nF100\nG0 X0 Y0 Z0\nG2 X10 Y10 I10 J0\nG3 X0 Y20 R10\nG3 X20 R-10.5 Z5",
    "helix": "G17 G90 G91.1 G21\nF100\nG0 X0 Y0 Z1\nG2 X10 Y0 I5 J0 Z0\nG3 I3 J4\nG91 G1 X1 Y1\nG2 X3 R2",
    "planes": "G18 G8 G90 G91.1 G21\nF100\nG0 X0 Y0 Z1\nG2 X4 Z1 I2\nG19\nG3 Y4 Z1 J2\nG17\nG2 X0 Y0 I-2 J-2",
}


@pytest.mark.interpreter
@pytest.mark.parametrize("program", INTERPRETED.values(), ids=INTERPRETED)
def test_plain_g_code_is_followed_as_linuxcnc_runs_it(program, tmp_path):
    file = tmp_path / "part.ngc"
    file.write_text(program if program.rstrip().endswith("M2") else program + "\nM2\n")
    done = subprocess.run(["rs274", "-g", str(file)], capture_output=True, text=True, check=True)
    calls = re.findall(r"(STRAIGHT_TRAVERSE|STRAIGHT_FEED|ARC_FEED|SELECT_PLANE)\((.*)\)", done.stdout)
    planes = {"CANON_PLANE_XY": (0, 1, 2), "CANON_PLANE_XZ": (2, 0, 1), "CANON_PLANE_YZ": (1, 2, 0)}
    wanted, order = [], (0, 1, 2)
    mm = 25.4 if "G20" in program else 1.0
    for name, text in calls:
        if name == "SELECT_PLANE":
            order = planes[text]
            continue
        values = [float(value) * mm for value in text.split(",")]
        end = [0.0, 0.0, 0.0]
        if name == "ARC_FEED":
            end[order[0]], end[order[1]], end[order[2]] = values[0], values[1], values[5]
            wanted.append(("arc", end, values[2:4], "ccw" if values[4] > 0 else "cw"))
        else:
            wanted.append(("line", values[:3], "rapid" if "TRAVERSE" in name else "feed", None))
    followed = steps_of(file)
    assert len(followed) == len(wanted) > 2
    for step, (kind, end, more, turn) in zip(followed, wanted, strict=True):
        got = [value or 0.0 for value in step.end]
        assert got == pytest.approx(end, abs=1.1e-4 * mm)
        if kind == "arc":
            assert step.bend.center == pytest.approx(more, abs=1.1e-4 * mm)
            assert (step.bend.sweep > 0) == (turn == "ccw")
            radius = dist([step.end[axis] for axis in step.bend.axes], step.bend.center)
            assert radius == pytest.approx(step.bend.radii[0], abs=2e-4 * mm)
        else:
            assert step.bend is None
            assert step.motion.value == more


def steps_of(file):
    control = PLAIN_CONTROLS["linuxcnc"]
    return follow(run(parse(file.read_text()), Request(control)), control, Length.MM, ("X", "Y", "Z")).steps


def test_python_compares_as_the_command_does(tmp_path):
    """Texts and files; what has no path is an error with the findings."""
    old, new = (tmp_path / name for name in ("old.nc", "new.nc"))
    old.write_text(SHAFT)
    new.write_text(replaced(SHAFT, N830="G01 Z-144.\nX92. Z-145.1\nU6."))
    found = contoursolve.diff(old, new)
    assert (str(found), found.is_equal) == (invoke(old, new)[1].rstrip(), False)
    assert contoursolve.diff(SHAFT, contoursolve.parse(old)).is_equal
    assert "<figure>" in found._repr_mimebundle_()["text/html"]
    with pytest.raises(contoursolve.errors.NotComparedError, match=r"<old>, program line 2: the first straight needs"):
        contoursolve.diff("G00 X40. Z0.\nG111 X100. A180. B120.", SHAFT)
    with pytest.raises(contoursolve.errors.UnknownControlError, match="<old>: no block shows the control; say which"):
        contoursolve.diff("G01 X1.", SHAFT)
