"""A family says of every row what a single solve says of the block with these values."""

import json
import re
from functools import partial
from types import SimpleNamespace

import calling
import flint
import numpy as np
import pandas
import pyarrow
import pytest
from pyarrow import parquet

import contoursolve
from contoursolve.families import FamilyError, family, sensitivity
from contoursolve.solving import REASONS, STATUSES

LATHE = {"start": "X40. Z0."}

ALL = {
    "G111, two roundings": (
        "G111 X100. A180. K-30. B120. P5. Q5.",
        LATHE,
        {"A": (150, 210), "K": (-60, 5), "B": (60, 200), "P": (-0.5, 25), "Q": (-0.5, 25), "X": (20, 140)},
    ),
    "a start point, of facts": (
        "G111 X100. A180. K-30. B120. P?",
        LATHE | {"facts": ["straight part of line 2 = 20"]},
        {"start.X": (10, 120), "B": (60, 170)},
    ),
    "two angles asked for, by a search": (
        "G111 X100. A? K-30. B?",
        LATHE | {"facts": ["length of line 1 = 35", "angle from line 1 to line 2 = -50"]},
        {"length of line 1": (25, 60), "angle from line 1 to line 2": (-120, -10)},
    ),
}
"""Blocks, options, and words with where their values lie."""


BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."


@pytest.mark.parametrize("name", ALL)
def test_the_number_of_threads_changes_nothing(name, monkeypatch):
    """Where balls prove what is found, the number of their bits is one for the whole process."""
    monkeypatch.setattr("contoursolve.families.evaluate.STRETCH", 30)
    block, options, ranges = ALL[name]
    rows, rng, bits = 120 if "facts" in options else 20_000, np.random.default_rng(1), flint.ctx.prec
    values = {word: np.round(rng.uniform(*ends, rows), 3) for word, ends in ranges.items()}
    one, two = (family(block, vary=values, paired=True, workers=workers, **options) for workers in (1, 2))
    assert len({*one["status"].tolist()}) > 1
    for column in one.names:
        assert one[column].tobytes() == two[column].tobytes(), column
    assert flint.ctx.prec == bits


@pytest.mark.parametrize(
    ("block", "options", "vary", "statuses"),
    [
        # A value that is refused does not end a family.
        (
            "G111 X100. A? K-30. B120. P5.",
            {"facts": ["length of line 1 = 30"]},
            {"length of line 1": [30.0, 0.0, 35.0]},
            ["SOLVED", "REJECTED", "AMBIGUOUS"],
        ),
        # Over all rows line 2 may advance either way, for all that one box of values tells.
        (
            "G111 X? A? K-24.5 B107.8 D4.4",
            {"facts": ["straight part of line 2 = 3.314", "length of line 1 = 24.695"]},
            {"K": [-24.5, -22.25, -20.0, -10.0]},
            ["AMBIGUOUS"] * 4,
        ),
        # Of the rules that refuse P and Q, each speaks of a value; with others there is a contour.
        (BLOCK, {}, {"P": [-5.0, 5.0], "Q": [-4.0, 3.0]}, ["REJECTED", "REJECTED", "REJECTED", "SOLVED"]),
    ],
)
def test_each_row_has_the_status_of_its_own_values(block, options, vary, statuses):
    found = family(block, start=START, vary=vary, **options)
    assert [STATUSES[code].name for code in found["status"].ravel()] == statuses


def test_a_value_that_is_asked_for_is_a_column():
    options = {"start": START, "facts": ["straight part of line 2 = 20", "length of line 1 = ?"]}
    found = family("G111 X100. A180. K-30. B120. P?", vary={"K": [-30, -40]}, **options)
    assert found["asked.P"] == pytest.approx([(30 / 0.75**0.5 - 20) * 3**0.5] * 2)
    assert found["asked.length of line 1"] == pytest.approx([30, 40])


TWICE, LENGTH = f"{BLOCK}\n{BLOCK}", "length of line 1"
NO_FAMILY = [
    ({"vary": {}}, "no word varies"),
    ({"block": "G00 X10.", "vary": {"X": [1]}, "control": "yasnac-lx3"}, "nothing to solve: the program has no"),
    ({"block": TWICE, "vary": {"1:K": [-30], "2:K": [-30]}}, "1:K and 2:K are in 2 contours; a family is about one"),
    ({"vary": {"R": [1]}}, "the block has no word R; its words are X, A, K, B, P, Q"),
    ({"vary": {"A": []}}, "A needs a list of one or more numbers"),
    ({"vary": {"A": ["x"]}}, "the values of A are not numbers"),
    ({"vary": {"A": [float("nan")]}}, "the values of A must be finite"),
    ({"vary": {"A": [1, 2], "P": [1, 2, 3]}, "paired": True}, "A has 2, P has 3"),
    ({"vary": {LENGTH: [180]}}, "no fact says what length of line 1 is; there are none"),
    ({"vary": {"start.U": [180]}}, "the start point has no word U; its words are X, Z"),
    ({"block": f"{BLOCK} (contoursolve: {LENGTH} = ?)", "vary": {LENGTH: [1]}}, "? is no number"),
    ({"block": TWICE, "vary": {"start.X": [40]}}, "2 contours (program lines 1, 2); a family is about one: name"),
    ({"block": TWICE}, "the block has 2 words A; write 1:A or 2:A"),
    ({"facts": ["lenght of line 1 = 30"]}, "lenght"),
    ({"start": None}, "start point"),
    ({"vary": {"A": range(10**6), "P": range(10**6)}}, "1,000,000,000,000 rows do not fit"),
    ({"units": "cm", "error": ValueError}, "units cannot be 'cm'; choose from mm, inch"),
    ({"rules": "none", "error": ValueError}, "rules cannot be 'none'; choose from enforce, warn, off"),
    ({"start": ("X40.", "Z0."), "error": TypeError}, "the start is words such as"),
    ({"vary": ["A", "B"], "error": TypeError}, "vary is a mapping"),
]


@pytest.mark.parametrize(("asked", "message"), NO_FAMILY)
def test_what_makes_no_family_is_refused_with_its_reason(asked, message):
    options = {"block": BLOCK, "error": FamilyError, "start": START, "vary": {"A": [180]}, **asked}
    with pytest.raises(options.pop("error")) as caught:
        family(options.pop("block"), **options)
    assert message in str(caught.value)


def test_families_go_to_arrow_parquet_and_xarray(tmp_path):
    found = family(BLOCK, start=START, vary={"A": [170, 180, 190], "P": [1, 60]})
    table = found.to_arrow()
    found.to_parquet(tmp_path / "family.parquet")
    again = parquet.read_table(tmp_path / "family.parquet")
    assert (tuple(table.column_names), again.schema.equals(table.schema, check_metadata=True)) == (found.names, True)
    check_table(again, found)
    data = found.to_xarray()
    assert dict(data.sizes) == {"A": 3, "P": 2}
    assert float(data["V2 X"].sel(A=190, P=1)) == found["V2 X"][2, 0]
    meanings = data["status"].attrs["flag_meanings"].split()
    assert [meanings[code] for code in data["status"].values[0]] == ["solved", "no-solution"]


def test_a_family_is_a_mapping_that_knows_where_it_comes_from_and_has_each_contour():
    found = family(BLOCK, start=START, vary={"A": [170, 180, 190], "P": [1]})
    assert ("A" in found, "V2 X" in found, "Q" in found) == (True, True, False)
    assert list(found) == list(found.keys()) == list(dict(found))
    row = found.contour(A=190)
    assert row.points["V2"] == pytest.approx((found["V2 Z"][2, 0], found["V2 X"][2, 0] / 2))
    alone = contoursolve.solve(BLOCK.replace("A180.", "A185.").replace(" P5.", " P2."), start=START)
    assert found.contour({"A": 185.0}, P=2) == alone.answers[0].contour
    with pytest.raises(FamilyError, match="the free words are A and P; give each of them a value, and no other"):
        found.contour(A=170, Q=1)
    with pytest.raises(FamilyError, match="there is no contour at A = 180 and P = 60"):
        found.contour(A=180, P=60)
    frame = pandas.DataFrame.from_arrow(found)
    assert (list(frame), frame["A"].tolist()) == (list(found), [170, 180, 190])
    with pytest.raises(TypeError, match=r"its table is pandas\.DataFrame\.from_arrow\(family\)"):
        pandas.DataFrame(found)
    told = {"block": BLOCK, "start": START, "control": "yasnac-lx3"}
    assert told.items() <= found.origin.items()
    assert found.to_xarray().attrs == found.origin
    metadata = {key.decode(): text.decode() for key, text in found.to_arrow().schema.metadata.items()}
    assert metadata == found.origin


def check_table(table, found):
    """A table has the numbers of a family, and the status and the reason of each row in words."""
    assert table["status"].to_pylist() == [STATUSES[code].value for code in found["status"].ravel()]
    reasons = [REASONS[number] for number in found["reason"].ravel()]
    assert table["reason"].to_pylist() == [kind.value if kind else None for kind in reasons]
    for name in set(found.names) - {"status", "reason"}:
        assert np.array_equal(table[name], found[name].ravel(), equal_nan=True), name


def test_every_column_names_its_unit_as_in_one_row_words_and_points_differ():
    """X4. is a diameter in inches; that of the end point is in mm."""
    block, options = "G111 X4. A180. K-1.2 B120. P.2 Q.2", {"start": "X1.6 Z0.", "units": "inch"}
    found = family(block, vary={"X": [4.0], "A": [180.0], "start.Z": [0.0]}, **options)
    assert (found["X"].item(), found["V2 X"].item()) == (4.0, pytest.approx(4 * 25.4))
    schema, data = found.to_arrow().schema, found.to_xarray()
    expected = {
        "X": ("inch", "diameter"),
        "A": ("deg", None),
        "start Z": ("inch", None),
        "V2 X": ("mm", "diameter"),
        "V2 Z": ("mm", None),
        "line 1.room": ("mm", None),
        "residual": ("mm", None),
    }
    for name, (unit, measure) in expected.items():
        metadata = {key.decode(): value.decode() for key, value in schema.field(name).metadata.items()}
        assert (metadata["unit"], metadata.get("measure")) == (unit, measure), name
        assert (data[name].attrs["units"], data[name].attrs.get("measure")) == (unit, measure), name
    asked = family("G111 X100. A? K-30. B120. P5.", start=START, facts=["length of line 1 = 40"], vary={"K": [-30.0]})
    assert [asked.measures()[name].unit for name in ("asked.A", "status")] == ["deg", ""]


ON_BLOCK = ("--block", BLOCK, "--start", START)


run = partial(calling.run, "sweep")


def test_where_no_row_has_a_contour_the_reason_of_most_is_named_with_a_row():
    """The largest P is 51.96 at A180, more at A170."""
    for vary, last in (
        (
            ("P=52:60:1", "A=180"),
            "P=52.0, A=180.0: the rounding P52.0 does not fit: P52.0 is 52.000 mm, at most 51.961 mm",
        ),
        (("P=-5,-6", "Q=-4,3"), "P=-5.0, Q=-4.0: P-5.0 and Q-4.0 are negative"),
    ):
        status, output, _ = run(*ON_BLOCK, "--vary", vary[0], "--vary", vary[1])
        assert (status, output.splitlines()[-1].split(" of them, such as ")[1].startswith(last)) == (0, True)
    example = json.loads(run(*ON_BLOCK, "--vary", "P=52:60:1", "--format", "json")[1])["example"]
    assert (example["count"], example["values"], example["code"]) == (9, {"P": 52.0}, "g111-corner-too-large")
    assert json.loads(run(*ON_BLOCK, "--vary", "P=5,60", "--format", "json")[1])["example"] is None


def test_more_contours_than_anybody_means_are_not_begun(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    grid = ("--vary", "A=0:360:0.001", "--vary", "B=0:360:0.001")
    status, output, errors = run(*ON_BLOCK, *grid, "-o", "family.csv")
    assert (status, output) == (2, "")
    assert re.search(r"129,600,720,001 contours are more than 100,000,000: about .* (h|days) on one thread", errors)
    assert re.search(r"family\.csv, with the rows .* may need [\d.]+ TB, where .* free; .* give --force", errors)
    assert not list(tmp_path.iterdir())
    status, _, errors = run(*ON_BLOCK, *grid, *(f"--vary={word}=0:100:0.01" for word in "PQKX"), "--force")
    assert (status, "cannot be counted" in errors) == (2, True)


def test_a_file_for_which_the_disk_has_no_room_is_begun_only_by_force(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("contoursolve.cli.family.disk_usage", lambda _: SimpleNamespace(free=1000))
    arguments = (*ON_BLOCK, "--vary", "A=170:190:1", "-o", "family.csv")
    status, _, errors = run(*arguments)
    assert (status, "where 1 kB are free; take larger steps, or give --force" in errors) == (2, True)
    assert run(*arguments, "--force")[0] == 0
    # What was estimated is not less than what it took.
    needed = re.search(r"may need ([\d.]+) kB", errors)
    assert float(needed[1]) * 1000 >= (tmp_path / "family.csv").stat().st_size


def test_without_a_terminal_a_line_now_and_then_tells_how_far_it_is(monkeypatch):
    monkeypatch.setattr("contoursolve.cli.progress.BETWEEN", 0.0)
    grid = ("--vary", "A=150:200:0.1", "--vary", "P=1:60:0.2")
    told = run(*ON_BLOCK, *grid)[2].splitlines()
    assert len(told) == 2
    assert all(re.fullmatch(r"[\d,]+ of 148,296 contours, [\d,]+ a second, \d+ s left", line) for line in told)
    assert run(*ON_BLOCK, *grid, "--quiet")[2] == ""


@pytest.mark.parametrize(
    ("text", "name", "values"),
    [
        ("a=170:190:0.01", "A", [round(170 + each / 100, 2) for each in range(2001)]),
        ("01:a=183:181:-1", "A", [183.0, 182.0, 181.0]),
        ("P=1, 2.5", "P", [1.0, 2.5]),
        ("length  of line 1=31:32:1", "length of line 1", [31.0, 32.0]),
        ("Start.x=41", "start X", [41.0]),
        ("A=@in.csv", "A", [170.0, 180.5]),
        ("P=@in.csv:radius", "P", [1.0, 60.0]),
        ("P=@in.parquet", "P", [1.0, 60.0]),
    ],
)
def test_values_are_those_of_a_range_or_of_a_column_of_a_file(text, name, values, tmp_path, monkeypatch):
    """A range has both ends, and no rounding adds up."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in.csv").write_text("A;radius\n170;1\n180.5;60\n", encoding="utf-8-sig")
    if "parquet" in text:
        family(BLOCK, start=START, vary={"A": [170, 180.5], "P": [1, 60]}, paired=True).to_parquet("in.parquet")
    fact = ("--fact", "length of line 1 = 30", "--rules", "off") if "length" in text else ()
    assert run(*ON_BLOCK, *fact, "--vary", text, "-o", "out.csv")[0] == 0
    head, *rows = [line.split(",") for line in (tmp_path / "out.csv").read_text().splitlines()]
    assert (head[0], [float(row[0]) for row in rows]) == (name, values)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("A=@in.txt", "ends with .csv or .parquet"),
        ("A=@none.csv", "none.csv: no such file"),
        ("A=@in.csv:B", "has no column B; there are A, C"),
        ("A=@in.csv", "line 3, column A: 'x' is no number"),
        ("C=@in.csv", "line 3, column C: there is no number"),
        ("A=@comma.csv", "line 2 has 2 columns, the first line 1"),
        ("A=@twice.csv", "2 columns A"),
        ("A=@head.csv", "there are no numbers"),
        ("V1.Z=@in.parquet", "row 1: there is no number"),
        ("A=@broken.parquet", "broken.parquet, column A: "),
    ],
)
def test_a_column_that_is_none_is_one_line_and_status_2(text, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "in.csv").write_text("A,C\n1,2\nx,\n")
    (tmp_path / "comma.csv").write_text("A\n1,5\n")
    (tmp_path / "twice.csv").write_text("A,A\n1,2\n")
    (tmp_path / "head.csv").write_text("A\n")
    (tmp_path / "broken.parquet").write_text("no parquet")
    parquet.write_table(pyarrow.table({"V1.Z": [None, 1.0]}), "in.parquet")
    status, _, errors = run(*ON_BLOCK, "--vary", text)
    assert (status, message in errors) == (2, True), errors


@pytest.mark.parametrize("text", ["A", "A=", "A=1:2", "A=1:2:0", "A=1:2:-1", "A=1:2,3", "A=x", "A=nan", "A=0:1:1e-12"])
def test_a_range_that_is_none_is_refused(text):
    status, output, errors = run(*ON_BLOCK, "--vary", text)
    assert (status, output, f"{text.partition('=')[0]}" in errors) == (2, "", True)


def test_a_sweep_writes_every_row(tmp_path):
    vary = ("--vary", "A=150:200:1", "--vary", "P=0:40:0.5")
    found = family(BLOCK, start=START, vary={"A": np.arange(150.0, 201.0), "P": np.arange(0, 405, 5) / 10})
    target = tmp_path / "family.csv"
    assert run(*ON_BLOCK, *vary, "-o", target)[0] == 0
    names, *rows = [line.split(",") for line in target.read_text().splitlines()]
    assert (tuple(names), len(rows)) == (found.names, len(found))
    for name, column in zip(names, zip(*rows, strict=True), strict=True):
        if name == "status":
            assert list(column) == [STATUSES[code].value for code in found["status"].ravel()]
        elif name != "reason":
            numbers = [float(each) if each else float("nan") for each in column]
            assert np.array_equal(numbers, found[name].ravel(), equal_nan=True), name
    status, _, errors = run(*ON_BLOCK, *vary, "-o", target)
    assert (status, "give --force" in errors) == (2, True)
    files = [tmp_path / f"{workers}.parquet" for workers in (1, 2)]
    for workers, file in enumerate(files, 1):
        assert run(*ON_BLOCK, *vary, "-o", file, "--workers", workers)[0] == 0
    assert files[0].read_bytes() == files[1].read_bytes()
    check_table(parquet.read_table(files[0]), found)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((*ON_BLOCK, "--vary", "R=1"), "the block has no word R"),
        ((*ON_BLOCK, "--vary", "A=1", "--vary", "a=2"), "twice"),
        ((*ON_BLOCK, "--vary", "A=1", "-o", "x.txt"), ".parquet or .csv"),
        ((*ON_BLOCK, "--vary", "A=190:170:0.1"), "from 190 to 170; write 170:190:0.1, or a step of -0.1"),
        (("--block", BLOCK, "--vary", "A=1"), "start point"),
        (("--block", "A1", "--vary", "A=1"), "--control"),
        ((*ON_BLOCK, "--vary", "A=1", "--dask", "tcp://127.0.0.1:1", "--workers", "2"), "the cluster has its own"),
    ],
)
def test_a_sweep_that_makes_no_sense_is_one_line_and_status_2(arguments, message):
    status, output, errors = run(*arguments)
    assert (status, output) == (2, "")
    assert message in errors


def test_tolerances_add_up_at_worst_and_in_squares():
    found = sensitivity(BLOCK, start=START)
    spreads = found.spread({"K": 0.03, "X": 0.04 / abs(found.slopes["V2 Z"]["X"])})
    spread = spreads["V2 Z"]
    assert (spread.worst, spread.typical) == pytest.approx((0.07, 0.05))
    # V2 lies 30 mm (on radius) above V1: 30 cot B behind it.
    assert found.slopes["V2 Z"]["B"] == pytest.approx(-30 / np.sin(np.radians(120)) ** 2 * np.pi / 180)
    assert spreads["Z of V2"] == spread  # a name that the slopes take, too
    with pytest.raises(FamilyError, match="no word R; there are X, A, K, B, P, Q"):
        found.spread({"R": 1})


@pytest.mark.parametrize(
    ("block", "message"),
    [
        (BLOCK.replace("P5.", "P500."), "the block has no contour: the rounding P500. does not fit"),
        (BLOCK.replace("K-30.", ""), "the first straight needs two of A, I and K"),
        ("G17 G41 G0 X50 Y0\nG3 I-50 J0\nG1 X-60 Y50 ,A180 Q-1", "no derivative exists"),
    ],
)
def test_a_contour_without_derivatives_is_refused(block, message):
    with pytest.raises(FamilyError, match=message):
        sensitivity(block, start=None if "G17" in block else START)
