"""The worked examples of all controls, right and wrong: docs/vectors, to the digits that they print."""

import json
import re
import subprocess
import sys
from itertools import chain
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator
from oracle import Number, Outcome, circle_line, g111, largest_gap
from vectors import CLOSE, FILES, FOLDER, ROWS, program_of, public, refusal, settings, solved, written

from contoursolve import Result, check, solve
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.controls import CONTROLS
from contoursolve.output.document import to_json

NO_WORDS_OF_CONTOURS = {
    "fanuc-lathe": {"J"},  # Y is no axis of a lathe's plane
    "haas-lathe": {"J"},
    "heidenhain": {"Z", "IZ"},  # beside the plane
}
"""Letters of a control that no contour of a right vector can have."""


RUN, OURS = public("run"), public("answer")


def assert_right(control: str, row: dict, result: Result) -> None:
    """That the path is the vector's, in each number that stands there, or the reason why there is none."""
    if "refused" in row:
        assert refusal(result) == {name: row[name] for name in ("refused", "grade", "source")}, row["id"]
        return
    assert not result.has_errors, (row["id"], [each.message for each in result.diagnostics])
    assert [[each.lines[0], each.lines[-1]] for each in result.answers] == [each["lines"] for each in row["contours"]]
    for answer, meant in zip(result.answers, row["contours"], strict=True):
        contour, points = answer.contour, meant.get("points", {})
        assert list(answer.plane.axes) == meant["axes"]
        # Places that are no ends are compared as lines to them.
        shown = [{"end": at} for at in (meant["start"], *points.values())]
        found = [{"end": at} for at in (contour.start, *(contour.points[name] for name in points))]
        vector = {**row, "contours": [{**meant, "path": [*shown, *meant["path"]]}]}
        path = [*found, *map(OURS.move, contour.elements)]
        assert RUN.difference(vector, {"path": path}) == "", (row["id"], path)
        assert len(contour.elements) == len(meant["path"])


@pytest.mark.parametrize("rows", [ROWS[2::7], pytest.param(ROWS, marks=pytest.mark.slow)], ids=["some", "all"])
def test_a_vector_comes_out_as_it_says(rows):
    for control, row in rows:
        assert_right(control, row, solved(control, row))


@pytest.mark.slow
def test_no_vector_is_refuted_and_nothing_is_reported_of_a_program_as_people_write_it():
    for control, row in ROWS[::6]:
        asked = "\n".join(row["program"])
        result = solve(asked, control=control, settings=settings(control, row), depth="verdict")
        documents = Document("program", asked.encode()), Document("result", to_json(result).encode())
        verdict = verify(*documents, control=control).verdict
        assert (verdict is not ReceiptVerdict.FAILED) if "refused" in row else (verdict is ReceiptVerdict.VERIFIED)
        assert not row.get("part") or {each.severity.value for each in result.diagnostics} <= {"info"}, row["id"]


def test_the_files_are_sorted_have_their_schema_and_every_control():
    schema = json.loads((FOLDER / "schema.json").read_text(encoding="utf-8"))
    Draft202012Validator.check_schema(schema)
    holds = Draft202012Validator(schema)
    assert FILES.keys() == CONTROLS.keys()
    for control, path in FILES.items():
        content = path.read_text(encoding="utf-8")
        file = json.loads(content)
        assert not [each.message for each in holds.iter_errors(file)][:3]
        assert content == written(control, file["vectors"])
        names = [each["id"] for each in file["vectors"]]
        assert len(names) == len({*names})
        programs = [(*each["program"], str(each.get("settings"))) for each in file["vectors"]]
        assert len(programs) == len({*programs})
        assert {"refused", "contours"} <= {*chain.from_iterable(file["vectors"])}
    assert len(ROWS) >= 600


@pytest.mark.slow
def test_the_right_vectors_have_every_form_and_every_word_of_their_control():
    for control, tables in CONTROLS.items():
        own = [row for name, row in ROWS if name == control and "contours" in row]
        claims = [answer.claim for row in own for answer in solved(control, row).answers]
        words = {word.address for claim in claims for block in claim.blocks for word in block.words}
        words |= {word.text for claim in claims for block in claim.blocks for word in block.words}
        lexicon = tables.modes.lexicon.addresses.keys() - {"ROUNDING", "CHAMFER"}
        assert lexicon - words == NO_WORDS_OF_CONTOURS.get(control, set()), control
        forms = {(each.name, each.title) for each in tables.forms if each.is_contour}
        assert forms <= {(claim.form.name, claim.form.title) for claim in claims}, control


def test_the_page_shows_vectors_as_they_are_and_leads_to_each_file():
    page = FOLDER.with_name("vectors.md").read_text(encoding="utf-8")
    shown = [json.loads(each) for each in re.findall(r"```json\n(.*?)```", page, re.DOTALL)]
    rows = [row for _, row in ROWS]
    assert [each in rows for each in shown if "id" in each] == [True, True]
    assert {Path(each).stem for each in re.findall(r"\(vectors/(.*?\.json)\)", page)} == {*FILES, "schema"}
    asked = next(each for each in shown if "control" in each)
    assert OURS.answer(asked)["path"][0]["end"] == pytest.approx(shown[3]["path"][0]["end"])


# The script that runs them against a program ----------------------------------------------------------------------


@pytest.mark.slow
def test_the_script_runs_all_of_them_against_a_program():
    command = [sys.executable, str(FOLDER / "run.py"), sys.executable]
    told = subprocess.run([*command, str(FOLDER / "answer.py")], capture_output=True, text=True, check=True).stdout
    assert told == f"{len(ROWS)} of {len(ROWS)} answers are right\n"
    dumb = "import sys\nfor line in sys.stdin: print('{\"path\": []}')"
    wrong = subprocess.run([*command, "-c", dumb], capture_output=True, text=True, check=False)
    assert (wrong.returncode, wrong.stdout.splitlines()[-1]) == (1, f"0 of {len(ROWS)} answers are right")


def test_the_script_takes_no_other_path_alarm_or_verdict():
    difference = RUN.difference
    assert len((FOLDER / "run.py").read_text(encoding="utf-8").splitlines()) <= 60
    for control, row in ROWS[::40]:
        path = [move for contour in row.get("contours", ()) for move in contour["path"]]
        if not path:
            assert difference(row, {"path": [{"end": [0, 0]}]})
            assert difference(row, {"refused": "", "alarm": "007"})
            assert not difference(row, {"refused": ""})
            continue
        right = OURS.answer(RUN.question(control, row))["path"]
        assert not difference(row, {"path": [{"end": [1e3, 1e3]}, *right, {"end": [0, 0]}]})
        assert difference(row, {"refused": ""})
        for number, move in enumerate(right):
            first, second = move["end"]
            for other in ({"end": [first, second + 2 * row["tolerance"] + CLOSE]}, {"turn": "up"}):
                assert difference(row, {"path": [*right[:number], {**move, **other}, *right[number + 1 :]]}), row["id"]
        assert difference(row, {"path": right[1:]})


# What else the sheets say -----------------------------------------------------------------------------------------


@pytest.mark.parametrize(("q", "side"), [("Q-1", "nearer"), ("Q1", "farther")])
def test_the_pairs_of_the_nct_sheet_are_found_without_a_control_and_tell_their_side(q, side):
    result = solve(program_of("nct-99m", f"p130-{q}-printed"))
    assert result.control == "nct-99m"
    (answer,) = result.answers
    assert answer.sides["P1"].value == side
    assert answer.contour.points["P1"] == answer.contour.elements[0].end


def test_a_taper_in_the_forbidden_band_is_refused_for_both_bevels():
    """YASNAC sheet, third example, derived: both setbacks are negative; alarm 146 is assumed for G111."""
    found = check("G00 X40. Z0.\nG111 X60. A180. K-30. B160. C2. D2.")
    errors = {(each.alarm.number, each.addresses) for each in found if each.alarm}
    assert errors == {("146", ("C",)), ("146", ("D",))}


@pytest.mark.parametrize(
    ("start", "words", "end"),
    [
        (20j, {"X": 100, "A": 180, "K": -30, "B": 120, "C": 5, "D": 5}, -49.4338 + 50j),
        (20j, {"X": 100, "A": 180, "K": -30, "B": 120, "P": 5, "Q": 5}, -50.2073 + 50j),
    ],
)
def test_the_oracle_agrees_with_the_yasnac_sheet(start: complex, words: dict[str, Number], end: complex) -> None:
    assert abs(g111(start, words).end - end) < 1e-4
    assert g111(start, {**words, "X": 60, "B": 160}).status == ("no-solution" if "C" in words else "solved")


@pytest.mark.parametrize(("side", "crossing"), [(-1, 39.99998 + 30.00002j), (1, -30.00012 + 39.99991j)])
def test_the_oracle_agrees_with_the_nct_sheet(side: int, crossing: complex) -> None:
    arc, line = {"X": -50, "Y": 0, "R": 50}, {"X": -50, "Y": 42.857, ",A": 171.87, "Q": side}
    outcome: Outcome = circle_line(17, 50, "ccw", arc, line)
    assert abs(outcome.points["P1"] - crossing) < 1e-5
    solved = solve("G17 G42 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q" + str(side))
    assert largest_gap(outcome, solved.answers[0].contour) < 1e-12
