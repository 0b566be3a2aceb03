"""`contoursolve verify`: right results pass, and no wrong number, element, status or byte gets through."""

import ast
import json
from collections.abc import Iterator
from copy import deepcopy
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import contoursolve
from contoursolve.cli import main
from contoursolve.verification import Document, Verdict, verify

PROGRAMS = Path(__file__).parent.parent / "notebooks" / "programs"
ROOM = Path(contoursolve.__file__).parent / "verification"
FORBIDDEN = "solving constraints analysis backends contour explain examine diagnosis pipeline output api trial rules"

LATHE = "G00 X40. Z0.\n"
MILL = "G17 G90 G0 X50 Y0\nG42\n"
LINE = "G1 X-50 Y42.857 ,A171.87 Q-1"
PROGRAM = LATHE + "G111 X100. A180. K-30. B120. P5. Q5."
PAIR = MILL + "G3 X-50 Y0 R50\n" + LINE

SAMPLES = {
    "two roundings": PROGRAM,
    "two bevels": LATHE + "G111 X100. A180. K-30. B120. C5. D5.",
    "sharp corners": LATHE + "G111 A180. K-30. B120. Z-50.",
    "V1 by its distances": LATHE + "G111 I5. K-30. B120. X100. P2.",
    "facing form": LATHE + "G111 A100. I20. B190. Z-40. P3. Q4.",
    "bevel and rounding": LATHE + "G111 U60. A180. K-30. B120. C5. Q5.",
    "rounding and bevel": LATHE + "G111 W-60. A90. I10. B160. P2. D1.5",
    "line 2 by its end": LATHE + "G111 A180. K-30. X100. W-47. P4.",
    "line 1 by one word": LATHE + "G111 A180. B120. X100. Z-47.3205 P4.",
    "line 1 by X alone": LATHE + "G111 I10. B150. X100. Z-60. P4.",
    "second line vanishes": LATHE + "G111 A180. K-30. B90. X50. P5.",
    "first line vanishes": LATHE + "G111 I0 K0 B120. X100.",
    "bevel takes all of line 1": LATHE + "G111 A180. K-5. B90. X100. C5.",
    "a corner of size 0": LATHE + "G111 A180. K-30. B120. X100. P0 Q5.",
    "A is ignored": LATHE + "G111 A135. I10. K-12. B180. Z-40. P2.",
    "B is ignored": LATHE + "G111 A180. K-30. B100. X100. Z-47. P2.",
    "least increments": "G00 X40000 Z0\nG111 X100000 A180000 K-30000 B120000 P5000",
    "lathe in inches": "G20\nG00 X1.5 Z0.\nG111 X4. A180. K-1.2 B120. P.2 Q.2",
    "far from zero": "G00 X90000. Z50000.\nG111 U60. A180. K-30. B120. P5. Q5.",
    "weakly fixed": LATHE + "G111 A179.99 I0.005 B120. X100. P1.",
    "one after the other": PROGRAM
    + "\nG01 X110. W-5.\nG111 U20. A170. K-20. B100. C1.\nG111 A180. K-9. B135. X160. Q2.",
    "a radius": PAIR,
    "the farther point": MILL + "G3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q1",
    "a long arc": MILL + "G2 X-30 Y40 R-50\nG1 X-50 Y42.857 ,A171.87 Q1",
    "a centre": MILL + "G3 I-50 J0\n" + LINE,
    "a centre by one word": MILL + "G3 I-50\n" + LINE,
    "a centre and a point": MILL + "G3 X0 Y-50 I-50 J0\n" + LINE,
    "a point that is off": MILL + "G3 X0 Y-50.005 I-50 J0\n" + LINE,
    "clockwise": MILL + "G2 I-50 J0\n" + LINE,
    "increments": "G17 G90 G41 G0 X50 Y0\nG91 G3 X-100 Y0 R50\n" + LINE,
    "a line that touches": MILL + "G3 I-50 J0\nG1 X-50 Y50 ,A180 Q-1",
    "a line that nearly touches": MILL + "G3 I-50 J0\nG1 X-50 Y49.9999 ,A180 Q-1",
    "a line of no length": MILL + "G3 I-50 J0\nG1 X-40 Y30 ,A180 Q1",
    "Z-X plane": "G18 G90 G41 G0 Z50 X0\nG3 Z-50 X0 R50\nG1 Z-50 X42.857 ,A171.87 Q-1",
    "Y-Z plane": "G19 G90 G41 G0 Y50 Z0\nG3 J-50 K0\nG1 Y-50 Z42.857 ,A171.87 Q1",
    "mill in inches": "G20\nG17 G90 G41 G0 X2 Y0\nG3 X-2 Y0 R2\nG1 X-2 Y1.7143 ,A171.87 Q-1",
}

NUDGE = 1e-6
"""mm."""


def run(*arguments, stdin=None):
    """(exit status, standard output, standard error); nothing may ever end in a traceback."""
    done = CliRunner().invoke(main, [str(each) for each in arguments], input=stdin)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    assert "Traceback" not in done.output
    return done.exit_code, done.stdout, done.stderr


class Desk:
    """A program and a result as files, to verify."""

    def __init__(self, folder: Path) -> None:
        self.program, self.result = folder / "program.nc", folder / "result.json"

    def solve(self, text: str, *options: str) -> dict[str, Any]:
        self.program.write_bytes(text.encode())
        result: dict[str, Any] = json.loads(run("solve", self.program, "--format", "json", *options)[1])
        return result

    def verify(self, result: object, *options: str) -> tuple[int, str, str]:
        data = result if isinstance(result, bytes) else json.dumps(result).encode()
        self.result.write_bytes(data)
        return run("verify", self.program, self.result, *options)

    def is_wrong(self, result: object) -> bool:
        """The same without the command line, which takes longer than the verification."""
        documents = Document("program", self.program.read_bytes()), Document("result", json.dumps(result).encode())
        return verify(*documents).verdict is Verdict.FAILED

    def receipt(self, result: object, *options: str) -> dict[str, Any]:
        status, output, _ = self.verify(result, "--format", "json", *options)
        receipt: dict[str, Any] = json.loads(output)
        assert status == (receipt["verdict"] == "failed")
        return receipt


@pytest.fixture
def desk(tmp_path):
    return Desk(tmp_path)


def older(result: dict[str, Any]) -> dict[str, Any]:
    """The result without the list of solutions, against which a changed number would stand out."""
    contours = [
        {name: value for name, value in contour.items() if name not in ("solutions", "count")}
        for contour in result["contours"]
    ]
    return {**result, "contours": contours}


def failures(receipt: dict[str, Any]) -> list[str]:
    return [check["name"] for contour in receipt["contours"] for check in contour["checks"] if not check["passed"]]


# --- Right results ---------------------------------------------------------------------------------


@pytest.mark.parametrize("text", SAMPLES.values(), ids=SAMPLES)
def test_what_solve_says_is_right(desk, text):
    result = desk.solve(text)
    assert {contour["status"] for contour in result["contours"]} == {"solved"}
    receipt = desk.receipt(result)
    assert failures(receipt) == []
    assert {contour["verdict"] for contour in receipt["contours"]} == {"verified"}
    assert receipt["verdict"] == "verified"


@pytest.mark.parametrize(("name", "paths"), [("shaft.nc", 7), ("plate.nc", 6), ("shaft_broken.nc", 1)])
def test_the_programs_of_the_notebooks_are_right(desk, name, paths):
    receipt = desk.receipt(desk.solve((PROGRAMS / name).read_text(encoding="utf-8")))
    assert receipt["verdict"] == "verified"
    assert [contour["verdict"] for contour in receipt["contours"]].count("verified") == paths


@pytest.mark.parametrize(
    ("words", "status"),
    [
        ("G111 A180. K-30. B120. X100. U60.", "overdetermined"),
        ("G111 A180. K-30. B120. X100. U60.0009", "overdetermined"),
        ("G111 A180.0005 I0 K-30. B120. X100.", "overdetermined"),
        ("G111 A180.0005 I0 K-30. B120. X100. P5.", "overdetermined"),
        ("G111 A180.0005 I0 K-30. B120. X100. C5. Q5.", "overdetermined"),
        ("G111 A180. K-30. B120. X100. Z-47.3205", "overdetermined"),
        # Says too much, and cannot be made either: without a path.
        ("G111 A0 I0 K-30. B120. X100. U60.", "overdetermined"),
    ],
)
def test_overdetermined_contours_are_held_against_all_their_words(desk, words, status):
    result = desk.solve(LATHE + words, "--rules", "off")
    (contour,) = result["contours"]
    assert contour["status"] == status
    receipt = desk.receipt(result)
    assert failures(receipt) == []
    assert receipt["verdict"] == ("verified" if contour["end"] else "nothing-checked")
    if contour["end"]:
        for wrong in nudged(older(result)):
            assert desk.is_wrong(wrong)
        # With notes v and vi of the manual, A or B is ignored, and the block is solved.
        by_the_notes = desk.solve(LATHE + words)["contours"][0]
        claim = {**older(result)["contours"][0], "status": "solved"}
        is_right = all(by_the_notes[name] == claim[name] for name in ("status", "elements"))
        assert desk.verify({**result, "contours": [claim]})[0] == (0 if is_right else 1)


def test_units_and_control_are_those_of_solve(desk):
    text = "G00 X1.5 Z0.\nG111 X4. A180. K-1.2 B120. P.2 Q.2"
    result = desk.solve(text, "--units", "inch")
    assert desk.receipt(result, "--units", "inch")["verdict"] == "verified"
    assert desk.receipt(result)["verdict"] == "failed"
    assert desk.receipt(result, "--units", "inch", "--control", "yasnac-lx3")["control"] == "yasnac-lx3"
    assert desk.receipt(result, "--units", "inch", "--control", "nct-99m")["verdict"] == "failed"


def test_either_input_may_be_standard_input(desk):
    result = desk.solve(PROGRAM)
    desk.verify(result)
    assert run("verify", "-", desk.result, stdin=PROGRAM)[0] == 0
    assert run("verify", desk.program, "-", stdin=json.dumps(result))[0] == 0
    assert run("verify", "-", "-", stdin=PROGRAM)[0] == 2


def test_fields_that_are_not_known_are_left_alone(desk):
    result = desk.solve(PROGRAM)
    (contour,) = result["contours"]
    contour |= {"families": [{"end": None}], "mood": "any"}
    contour["certificate"]["by"] = "anyone"
    assert desk.receipt({**result, "later": 1})["verdict"] == "verified"


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_result_that_windows_redirected_is_read(desk, encoding):
    data = json.dumps(desk.solve(PROGRAM)).encode(encoding)
    assert desk.receipt(data)["verdict"] == "verified"


# --- Wrong results ---------------------------------------------------------------------------------

Place = tuple[str | int, ...]


def numbers(value: Any, place: Place = ()) -> Iterator[tuple[Place, float]]:
    """Every coordinate and radius below a value, with its place."""
    if isinstance(value, float):
        yield place, value
    elif isinstance(value, (dict, list)):
        for name, each in value.items() if isinstance(value, dict) else enumerate(value):
            yield from numbers(each, (*place, name))


def changed(result: dict[str, Any], place: Place, value: Any) -> dict[str, Any]:
    copy = deepcopy(result)
    target: Any = copy
    for name in place[:-1]:
        target = target[name]
    target[place[-1]] = value
    return copy


def coordinates(result: dict[str, Any]) -> Iterator[tuple[Place, float]]:
    for number, contour in enumerate(result["contours"]):
        for name in ("start", "end", "points", "elements"):
            if contour["end"]:
                yield from numbers(contour[name], ("contours", number, name))


def nudged(result: dict[str, Any]) -> Iterator[dict[str, Any]]:
    for place, value in coordinates(result):
        for off in (NUDGE, -NUDGE):
            yield changed(result, place, value + off)


@pytest.mark.parametrize("text", SAMPLES.values(), ids=SAMPLES)
def test_a_number_that_is_off_by_a_millionth_is_found(desk, text):
    result = older(desk.solve(text))
    for number, wrong in enumerate(nudged(result)):
        assert desk.is_wrong(wrong), number
    for place, value in coordinates(result):
        if value:
            assert desk.is_wrong(changed(result, place, -value)), place


@pytest.mark.parametrize("name", ["shaft.nc", "plate.nc"])
def test_a_number_of_a_whole_program_that_is_off_is_found(desk, name):
    result = older(desk.solve((PROGRAMS / name).read_text(encoding="utf-8")))
    for number, (place, value) in enumerate(coordinates(result)):
        wrong = value + NUDGE if number % 2 or not value else -value
        assert desk.is_wrong(changed(result, place, wrong)), place


def tampered(contour: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Changes of one contour that are no changes of a number."""
    elements = contour["elements"]
    for number, element in enumerate(elements):
        yield f"element {number} dropped", {"elements": elements[:number] + elements[number + 1 :]}
        yield f"element {number} twice", {"elements": elements[: number + 1] + elements[number:]}
        if element["kind"] == "arc":
            turn = "ccw" if element["turn"] == "cw" else "cw"
            yield "turn", {"elements": [*elements[:number], {**element, "turn": turn}, *elements[number + 1 :]]}
            straight = {"kind": "line", "start": element["start"], "end": element["end"]}
            yield "arc cut short", {"elements": [*elements[:number], straight, *elements[number + 1 :]]}
        middle = [(a + b) / 2 for a, b in zip(element["start"], element["end"], strict=True)]
        halves = [{**element, "end": middle}, {**element, "start": middle}]
        yield "element in halves", {"elements": [*elements[:number], *halves, *elements[number + 1 :]]}
    for number, (one, other) in enumerate(pairwise(elements)):
        yield "swapped", {"elements": [*elements[:number], other, one, *elements[number + 2 :]]}
    for status in ("rejected", "underdetermined", "overdetermined", "conflicting", "ambiguous", "no-solution"):
        yield status, {"status": status}
    yield "no elements", {"elements": []}
    yield "no end", {"end": None}
    yield "no start", {"start": [None, None]}
    yield "no points", {"points": {}}
    yield "one point more", {"points": {**contour["points"], "V9": [0.0, 0.0]}}
    yield "branch", {"branch": "farther" if contour["branch"] == "nearer" else "nearer"}
    yield "no line", {"line": contour["line"] + 1}
    yield "other lines", {"lines": [*contour["lines"], 99]}
    yield "axes swapped", {"plane": contour["plane"][::-1]}
    yield "other form", {"form": "G112"}
    yield "kind of certificate", {"certificate": {**contour["certificate"], "kind": "sworn"}}
    yield "negative radius", {"certificate": {"kind": "verified", "radius": -1e-9}}


@pytest.mark.parametrize("name", ["two roundings", "two bevels", "sharp corners", "a radius", "a centre", "increments"])
def test_a_result_that_was_tampered_with_is_found(desk, name):
    result = older(desk.solve(SAMPLES[name]))
    (contour,) = result["contours"]
    for what, change in tampered(contour):
        assert desk.is_wrong({**result, "contours": [{**contour, **change}]}), what


def test_the_branch_of_a_line_that_touches_is_none(desk):
    result = desk.solve(SAMPLES["a line that touches"])
    assert result["contours"][0]["branch"] is None
    assert desk.receipt(changed(result, ("contours", 0, "branch"), "nearer"))["verdict"] == "failed"


def test_the_other_intersection_is_no_answer(desk):
    other = older(desk.solve(SAMPLES["the farther point"]))
    result = desk.solve(PAIR)
    assert desk.receipt(result)["verdict"] == "verified"
    assert desk.receipt(other)["verdict"] == "failed"
    assert "P1 is the intersection that Q chooses" in failures(
        desk.receipt(changed(other, ("contours", 0, "branch"), "nearer"))
    )


def test_contours_missing_added_or_twice_are_found(desk):
    result = desk.solve(SAMPLES["one after the other"])
    contours = result["contours"]
    for wrong in (contours[:1], contours[1:], [], [*contours, contours[0]], [*contours, {**contours[0], "line": 1}]):
        assert desk.receipt({**result, "contours": wrong})["verdict"] == "failed"
    receipt = desk.receipt({**result, "contours": contours[:2]})
    assert [contour["status"] for contour in receipt["contours"]] == ["solved", "solved", None]


def test_a_certificate_covers_what_the_points_show(desk):
    result = desk.solve(PROGRAM)
    place = ("contours", 0, "certificate", "radius")
    at = ("contours", 0, "points", "V2", 0)
    value = result["contours"][0]["points"]["V2"][0]
    assert result["contours"][0]["certificate"]["radius"] > 0
    assert desk.receipt(result)["verdict"] == "verified"
    # Within what a residual may be, and still more than the certificate promises.
    slightly_off = changed(result, at, value + 2e-10)
    assert all("certificate" in name for name in failures(desk.receipt(changed(slightly_off, place, 0.0))))
    assert desk.receipt(changed(slightly_off, place, 0.0))["verdict"] == "failed"
    assert desk.receipt(changed(slightly_off, place, 1e-9))["verdict"] == "verified"
    # No certificate makes a wrong number right.
    assert desk.receipt(changed(changed(result, at, value + NUDGE), place, 1.0))["verdict"] == "failed"
    receipt = desk.receipt(changed(result, ("contours", 0, "certificate"), {"kind": "unknown", "radius": None}))
    assert {"what": "the certificate", "why": "it names no radius"} in receipt["contours"][0]["not_checked"]


@pytest.mark.parametrize(
    ("text", "other"),
    [
        (PROGRAM, PROGRAM.replace(*change))
        for change in (
            ("X40.", "X40.001"),
            ("Z0.", "Z0.001"),
            ("X100.", "X100.001"),
            ("X100.", "U100."),
            ("X100.", ""),
            ("X100.", "Z-50."),
            ("A180.", "A180.001"),
            ("A180.", "A0"),
            ("A180.", "I1."),
            ("A180.", "A180. I1."),
            ("K-30.", "K-30.001"),
            ("B120.", "B-60."),
            ("B120.", "B120.001"),
            ("P5.", "P5.001"),
            ("P5.", "C5."),
            ("P5.", ""),
            ("P5.", "P-5."),
            ("P5.", "P5. C5."),
            ("Q5.", "D5."),
            ("Q5.", "Q0"),
            ("Q5.", "Q#1"),
            ("Q5.", "Q5. R1."),
            ("Q5.", "Q5. W-50."),
            ("G111", "G112"),
            ("G111", "G01"),
            ("G00", "G28"),
            ("G00", "\nG00"),
            ("G00 X40.", "G20 G00 X40."),
        )
    ]
    + [
        (PAIR, PAIR.replace(*change))
        for change in (
            ("R50", "R50.001"),
            ("R50", "R-50"),
            ("R50", "R0"),
            ("R50", ""),
            ("R50", "I-50.001"),
            ("X-50 Y0", "X-50 Y1"),
            ("X-50 Y0", "X-49.999"),
            ("X-50 Y0", ""),
            ("G3", "G2"),
            ("G3", "G91 G3"),
            ("G17", "G18"),
            ("Q-1", "Q1"),
            ("Q-1", "Q0"),
            ("Q-1", ""),
            ("171.87", "-8.13"),
            ("171.87", "171.871"),
            ("Y42.857", "Y42.858"),
            ("Y42.857", "Y80"),
        )
    ],
)
def test_a_program_that_was_changed_afterwards_is_found(desk, text, other):
    result = desk.solve(text)
    if other == PAIR.replace("R50", "R-50"):
        result = desk.solve(text.replace("X-50 Y0", "X-30 Y40"))  # a half circle is the same for both signs
        other = other.replace("X-50 Y0", "X-30 Y40")
    assert result["contours"][0]["status"] == "solved"
    desk.program.write_bytes(other.encode())
    assert desk.verify(result)[0] == 1


# --- Nothing to check ------------------------------------------------------------------------------


def test_checking_nothing_is_not_finding_nothing_wrong(desk):
    rejected = desk.solve(LATHE + "G111 A180. B120. X100.")
    assert rejected["contours"][0]["status"] == "rejected"
    receipt = desk.receipt(rejected)
    assert receipt["verdict"] == "nothing-checked"
    assert [each["what"] for each in receipt["contours"][0]["not_checked"]] == ["the path", "the status"]
    status, output, _ = desk.verify(rejected)
    assert status == 0
    assert "checked nothing" in output
    assert "right" not in output


@pytest.mark.parametrize(("text", "control"), [("G00 X40. Z0.", None), ("", None), (LATHE + "G01 X50.", "yasnac-lx3")])
def test_a_program_without_a_contour_has_nothing_to_check(desk, text, control):
    result = desk.solve(text, *(["--control", control] if control else []))
    receipt = desk.receipt(result)
    assert (receipt["control"], receipt["contours"], receipt["verdict"]) == (control, [], "nothing-checked")


def test_forms_that_are_not_resolved_are_listed(desk):
    receipt = desk.receipt(desk.solve(LATHE + "G112 U0 I10. K-50. P5. Q5. R30."))
    assert receipt["verdict"] == "nothing-checked"
    assert [each["what"] for each in receipt["not_checked"]] == ["line 2"]


def test_ignored_and_unread_words_are_listed(desk):
    receipt = desk.receipt(desk.solve(SAMPLES["A is ignored"]))
    assert receipt["contours"][0]["not_checked"][0]["what"] == "A135."
    result = desk.solve(PAIR.replace("R50", "R50 ,R2"), "--rules", "off")
    receipt = desk.receipt(result)
    assert ",R2" in [each["what"] for each in receipt["contours"][0]["not_checked"]]


def test_a_contour_after_one_without_a_path_is_checked_where_its_start_is_known(desk):
    text = LATHE + "G111 A180. B120. X100. Z-50. P90.\nG111 A180. K-30. B120. X160.\nG111 A180. K-3. B120. X190."
    result = desk.solve(text)
    assert [contour["status"] for contour in result["contours"]] == ["no-solution", "solved", "solved"]
    assert failures(desk.receipt(result)) == []
    unknown = desk.solve(LATHE + "G111 A180. B120. X100.\nG111 A180. K-30. B120. X160.")
    assert unknown["contours"][1]["start"] == [None, 50.0]
    assert failures(desk.receipt(unknown)) == []
    assert desk.receipt(changed(unknown, ("contours", 1, "start", 0), 1.0))["verdict"] == "failed"


# --- The receipt -----------------------------------------------------------------------------------


def test_the_receipt_names_the_bytes_it_is_about(desk):
    result = desk.solve(PROGRAM)
    receipt = desk.receipt(result)
    for name, path in (("program", desk.program), ("result", desk.result)):
        assert receipt[name] == {"name": str(path), "sha256": sha256(path.read_bytes()).hexdigest()}
    assert receipt["schema"] == "contoursolve/verify/1"
    assert receipt["units"] == "mm"
    (contour,) = receipt["contours"]
    assert (contour["line"], contour["lines"], contour["form"], contour["status"]) == (2, [2], "G111", "solved")
    checks = {check["name"]: check for check in contour["checks"]}
    assert checks["X of V2"] == checks["X of V2"] | {"words": ["X100."], "unit": "mm", "passed": True, "remark": ""}
    assert checks["X of V2"]["residual"] <= checks["X of V2"]["limit"] < 1.1e-9
    assert checks["corner 1 turns as the lines do"]["limit"] is None


def test_the_same_inputs_give_the_same_bytes(desk):
    result = desk.solve((PROGRAMS / "plate.nc").read_text(encoding="utf-8"))
    for format_ in ("text", "json"):
        assert desk.verify(result, "--format", format_) == desk.verify(result, "--format", format_)


def test_the_text_says_what_is_wrong_and_by_how_much(desk):
    result = desk.solve(PROGRAM)
    status, output, _ = desk.verify(changed(result, ("contours", 0, "points", "V2", 1), 50.001))
    assert status == 1
    assert "claimed solved: WRONG" in output
    assert "wrong: X of V2 (X100.): off by 0.001 mm, allowed 1.0e-09 mm" in output
    assert output.endswith("1 contour (1 WRONG); the result is not right\n")
    status, output, _ = desk.verify(result)
    assert status == 0
    assert output.endswith("1 contour (1 verified); every claimed path is right\n")


# --- Inputs that are none --------------------------------------------------------------------------

TROUBLE: tuple[tuple[str, Place, Any, str], ...] = (
    ("schema", ("schema",), "contoursolve/check/1", "schema: 'contoursolve/check/1' where"),
    ("control", ("control",), "fanuc", "unknown control 'fanuc'; choose from yasnac-lx3, nct-99m"),
    ("control type", ("control",), 5, "control: 5 where a text is expected"),
    ("contours", ("contours",), {}, "contours: an object where a list is expected"),
    ("contour", ("contours", 0), None, "contours[0]: null where an object is expected"),
    ("boolean line", ("contours", 0, "line"), True, "contours[0].line: true where a whole number"),
    ("broken line", ("contours", 0, "line"), 2.0, "contours[0].line: 2.0 where a whole number"),
    ("negative line", ("contours", 0, "lines"), [-1], "contours[0].lines[0]: -1 is no line number"),
    ("status", ("contours", 0, "status"), "fine", "contours[0].status: 'fine' where one of solved, rejected"),
    ("plane", ("contours", 0, "plane"), ["Z"], "contours[0].plane: 1 values where two are expected"),
    ("boolean", ("contours", 0, "end"), [1.0, False], "contours[0].end[1]: false where a number is expected"),
    ("text", ("contours", 0, "end"), ["1", 2], "contours[0].end[0]: '1' where a number is expected"),
    ("huge", ("contours", 0, "end"), [10**400, 2], "contours[0].end[0]: a very large number is larger than any"),
    ("large", ("contours", 0, "end"), [1e13, 2], "contours[0].end[0]: 10000000000000.0 is larger than any"),
    ("point", ("contours", 0, "points"), {"V1": None}, "contours[0].points.V1: null where a list is expected"),
    ("kind", ("contours", 0, "elements", 1, "kind"), "spline", "elements[1].kind: 'spline' where one of line, arc"),
    ("turn", ("contours", 0, "elements", 1, "turn"), "left", "elements[1].turn: 'left' where one of cw, ccw"),
    ("radius", ("contours", 0, "elements", 1, "radius"), None, "elements[1].radius: null where a number"),
    ("certificate", ("contours", 0, "certificate"), "unique", "certificate: 'unique' where an object"),
)


@pytest.mark.parametrize(
    ("place", "value", "message"), [each[1:] for each in TROUBLE], ids=[each[0] for each in TROUBLE]
)
def test_a_result_that_is_none_is_named_by_its_field(desk, place, value, message):
    status, output, errors = desk.verify(changed(desk.solve(PROGRAM), place, value))
    assert (status, output) == (2, "")
    assert message in errors
    assert errors.count("\n") == 1


def test_every_field_must_be_there(desk):
    result = desk.solve(PROGRAM)
    contour = result["contours"][0]
    arc = contour["elements"][1]
    holders: list[tuple[Place, dict[str, Any], set[str]]] = [
        ((), result, {"program", "diagnostics"}),
        (("contours", 0), contour, {"diagnosis"}),
        (("contours", 0, "elements", 1), arc, set()),
        (("contours", 0, "certificate"), contour["certificate"], set()),
    ]
    for place, holder, optional in holders:
        for name in (
            holder.keys()
            & {
                *(
                    "schema",
                    "control",
                    "contours",
                    "line",
                    "lines",
                    "form",
                    "status",
                    "plane",
                    "start",
                    "end",
                    "points",
                ),
                *("elements", "branch", "certificate", "kind", "center", "radius", "turn"),
            }
            - optional
        ):
            rest = {key: value for key, value in holder.items() if key != name}
            status, _, errors = desk.verify(changed(result, place, rest) if place else rest)
            assert status == 2, name
            assert f"the field '{name}' is missing" in errors


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"{",
        b"[]",
        b"null",
        b"G111 X100.",
        b'{"schema": "contoursolve/solve/1", "schema": "contoursolve/solve/1"}',
        b'{"schema": "contoursolve/solve/1", "control": NaN, "contours": []}',
        b'{"schema": "contoursolve/solve/1", "control": null, "contours": [-Infinity]}',
        b'{"schema": "contoursolve/solve/1", "control": null, "contours": [1e999]}',
        b'{"schema": "contoursolve/solve/1", "control": null, "contours": [' + b"9" * 5_000 + b"]}",
        b"[" * 100_000,
        b'{"a":' * 100_000,
        b"\xff\xfe\x00",
        b'{"schema": "\\ud800"}',
        b'{"\\ud800": {}}',
        b"\xff" * 9,
    ],
    ids=range(16),
)
def test_bytes_that_are_no_result_are_refused(desk, data):
    desk.program.write_bytes(PROGRAM.encode())
    status, output, errors = desk.verify(data)
    assert (status, output) == (2, "")
    assert str(desk.result) in errors


def test_inputs_that_cannot_be_read_are_named(desk, tmp_path):
    result = desk.solve(PROGRAM)
    desk.verify(result)
    for program, claimed, message in (
        (tmp_path / "none.nc", desk.result, "none.nc: no such file"),
        (desk.program, tmp_path / "none.json", "none.json: no such file"),
        (tmp_path, desk.result, "is a directory, not a file"),
        (desk.program, tmp_path, "is a directory, not a file"),
        ("\0", desk.result, "cannot be read"),
    ):
        status, output, errors = run("verify", program, claimed)
        assert (status, output) == (2, "")
        assert message in errors
    desk.program.write_bytes(PROGRAM.encode("utf-16"))
    status, _, errors = run("verify", desk.program, desk.result)
    assert status == 2
    assert "not a text file" in errors
    for arguments in ((), (desk.program,), (desk.program, desk.result, "--control", "fanuc")):
        assert run("verify", *arguments)[0] == 2


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=True) | st.text(max_size=4),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=6,
)
FUZZ = settings(
    derandomize=True, deadline=None, max_examples=300, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def places(value: Any, place: Place = ()) -> Iterator[Place]:
    if place:
        yield place
    if isinstance(value, (dict, list)):
        for name, each in value.items() if isinstance(value, dict) else enumerate(value):
            yield from places(each, (*place, name))


@FUZZ
@given(data=st.data())
def test_whatever_is_put_in_a_result_gets_an_answer(desk, data):
    result = desk.solve(data.draw(st.sampled_from((PROGRAM, PAIR, LATHE + "G111 A180. B120. X100."))))
    del result["diagnostics"]
    wrong = changed(result, data.draw(st.sampled_from(list(places(result)))), data.draw(JSON))
    status, output, errors = desk.verify(wrong, "--format", data.draw(st.sampled_from(("text", "json"))))
    assert status in (0, 1, 2)
    assert bool(output) == (status != 2)
    assert bool(errors) == (status == 2)


VOCABULARY = """G00 G01 G111 G112 G2 G3 G17 G18 G20 G28 G41 G90 G91 X40. X-50 Z0. Z-30. Y0 U60. W-5. A180. A0 B120. I0
I-50 K-30. C5. P5. P0 Q5. D5. Q-1 Q0 R50 R-50 J0 ,A171.87 ,C1 #1=2 X#1 A A1e9 (a ) / M98 N5
X9999999999999999999999999999999. A9999999999999999999999999999999. ,A9999999999999999999999999999999."""
WORDS = st.sampled_from([*VOCABULARY.split(), "\n"])


@FUZZ
@given(
    words=st.lists(WORDS, max_size=12).map(" ".join),
    result=st.sampled_from((PROGRAM, PAIR)),
    replaced=st.integers(0, 12),
    position=st.booleans(),
)
def test_whatever_the_program_there_is_an_answer(desk, words, result, replaced, position):
    claimed = desk.solve(result)
    lines = result.split("\n")
    tail = " ".join(lines[-1].split(" ")[replaced:])
    desk.program.write_text("\n".join([*(lines[:-1] if position else [""]), f"{words} {tail}"]), encoding="utf-8")
    assert desk.verify(claimed)[0] in (0, 1)


@pytest.mark.parametrize("word", ["A", "B", "P", "X", "K"])
def test_a_value_beyond_all_travel_is_no_value(desk, word):
    claimed = desk.solve(PROGRAM)
    parts = [word + "9" * 31 + "." if part[0] == word else part for part in PROGRAM.split("\n")[1].split(" ")]
    desk.program.write_bytes((LATHE + " ".join(parts)).encode())
    assert failures(desk.receipt(claimed))[0] == "every word can be read"


@FUZZ
@given(program=st.binary(max_size=60), claimed=st.binary(max_size=60), which=st.integers(0, 2))
def test_whatever_the_bytes_there_is_an_answer(desk, program, claimed, which):
    result = desk.solve(PROGRAM)
    if which:
        desk.program.write_bytes(program)
    status = desk.verify(claimed if which != 1 else result)[0]
    assert status == (2 if which != 1 else status)
    assert status in (0, 1, 2)


# --- Independence ----------------------------------------------------------------------------------


@pytest.mark.parametrize("module", sorted(ROOM.rglob("*.py")), ids=lambda module: module.name)
def test_the_verifier_uses_nothing_of_the_solver(module):
    imported = set()
    for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            imported |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            imported |= {str(node.module), *(f"{node.module}.{alias.name}" for alias in node.names)}
    assert "importlib" not in imported
    own = {name.split(".")[1] for name in imported if name.startswith("contoursolve.")}
    assert own & set(FORBIDDEN.split()) == set()
    assert not {name.split(".")[0] for name in imported} & {"casadi", "sympy", "numpy", "scipy"}
