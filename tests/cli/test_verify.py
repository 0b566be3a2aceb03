"""`contoursolve verify`: right results pass, and no wrong number, element, status or byte gets through."""

import ast
import json
import re
from collections.abc import Iterator
from copy import deepcopy
from functools import cache
from hashlib import sha256
from itertools import pairwise
from pathlib import Path
from random import Random
from typing import Any

import generate_lx3
import generate_nct
import pytest
from click.testing import CliRunner
from hypothesis import HealthCheck, given, settings, strategies as st

import contoursolve
from contoursolve.cli import main
from contoursolve.comparison import CannotVerifyError, Document, ReceiptVerdict, verify
from contoursolve.controls import DIALECTS
from contoursolve.gcode import parse

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
PAGES = Path(__file__).parents[2] / "docs" / "programs"
ROOM = Path(contoursolve.__file__).parent / "comparison"
MODULES = [ROOM / f"{name}.py" for name in ("claims", "judge", "measure", "verify")]
FORBIDDEN = "solving analysis numeric diagnosis program output api try_edits families"
"""Of `geometry` it knows the kinds of facts and what they are about, of `reading` which words are refused."""

PLAIN = {
    *(f"contoursolve.numeric.{name}" for name in ("Array", "Functions", "direction", "pinv", "svd")),
    "contoursolve.diagnosis.count",
    "contoursolve.diagnosis.status_text",
}
"""Linear algebra, the direction of an angle, the plural of a word, and the words for a status."""

LATHE = "G00 X40. Z0.\n"
MILL = "G17 G90 G0 X50 Y0\nG42\n"
LINE = "G1 X-50 Y42.857 ,A171.87 Q-1"
PROGRAM = LATHE + "G111 X100. A180. K-30. B120. P5. Q5."
CIRCLE = "G3 X-40 Y60 I-40 J20 R40 Q-1"
TURN = "G17 G90 G42 G0 X100 Y20\n"
ARC = "G00 X100. Z-50.\n"
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
    "G112, roundings": ARC + "G112 U0 I10. K-50. P5. Q5. R30.",
    "G112, bevels": ARC + "G112 U0 I10. K-50. C5. D5. R30.",
    "G112, facing": ARC + "G112 Z-50. I30. K5. R15. P2. D2.",
    "G112, sharp": ARC + "G112 U-10. I0 K-50. R30.",
    "G11, G12 and G01": "G00 X30. Z0.\nG11 Z-20. I8.\nX80. K-7.\nG12 W-20. I-2.\nG01 U20. K3.",
    "two lines": TURN + "G1 ,A150\nG1 X10 Y20 ,A225",
    "two lines by points": TURN + "G1 X50 Y33.094 ,R2\nG1 X10 Y20 ,A225",
    "a line and a circle": TURN + "G1 X-30 Y-20 ,C2\nG3 X20 Y40 I20 J-10 R50 Q-1",
    "two circles": MILL + "G3 X-50 Y0 I-50 J0\nG3 X-40 Y60 I-40 J20 R40 Q-1",
    "two circles, rounded": MILL + "G3 X0 Y50 R50 ,R2\nG3 X-40 Y60 I-40 J20 R-40 Q1",
    "a chain": TURN + "G1 ,A150 ,R2\nG1 X10 Y20 ,A225 ,C2\nG3 X-40 Y-20 I-20 J-20 R20 Q1",
    "a chain to a point that is off": TURN + "G1 ,A197\nG3 X20 Y40.005 I20 J-10 R50 Q-1",
    "chamfers and roundings": MILL + "G1 X80 ,C10\nX90 Y40 ,R5\nG3 X60 Y70 R30 ,R3\nG3 X40 Y90 I-20 J0 ,C2\nG1 Y60",
    "a line by its angle": MILL + "G91 G1 X40 ,A45",
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

NEW = [
    *("G112, roundings", "G112, bevels", "G112, facing", "two lines by points", "a line and a circle", "two circles"),
    *("two circles, rounded", "a chain", "chamfers and roundings", "a line by its angle"),
]

NUDGE = 1e-6
"""mm."""


def run(*arguments, stdin=None):
    """(exit status, standard output, standard error); nothing may ever end in a traceback."""
    done = CliRunner().invoke(main, [str(each) for each in arguments], input=stdin)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    assert "Traceback" not in done.output
    return done.exit_code, done.stdout, done.stderr


@cache
def solution(text: str, *options: str) -> str:
    """What solve says of a program; several tests look at the same one."""
    return run("solve", "-", "--format", "json", *options, stdin=text)[1]


class Desk:
    """A program and a result as files, to verify."""

    def __init__(self, folder: Path) -> None:
        self.program, self.result = folder / "program.nc", folder / "result.json"

    def solve(self, text: str, *options: str) -> dict[str, Any]:
        self.program.write_bytes(text.encode())
        result: dict[str, Any] = json.loads(solution(text, *options))
        return result

    def verify(self, result: object, *options: str) -> tuple[int, str, str]:
        data = result if isinstance(result, bytes) else json.dumps(result).encode()
        self.result.write_bytes(data)
        return run("verify", self.program, self.result, *options)

    def is_wrong(self, result: object) -> bool:
        """The same without the command line, which takes longer than the verification."""
        documents = Document("program", self.program.read_bytes()), Document("result", json.dumps(result).encode())
        return verify(*documents).verdict is ReceiptVerdict.FAILED

    def is_refused(self, result: object) -> bool:
        """Whether it is wrong, or no result at all."""
        try:
            return self.is_wrong(result)
        except CannotVerifyError:
            return True

    def is_believed(self, result: object) -> bool:
        """Whether all that the first contour claims, its status among it, is called verified."""
        return self.receipt(result)["contours"][0]["verdict"] == "verified"

    def receipt(self, result: object, *options: str) -> dict[str, Any]:
        status, output, _ = self.verify(result, "--format", "json", *options)
        receipt: dict[str, Any] = json.loads(output)
        assert status == {"verified": 0, "failed": 1, "partly-verified": 0, "nothing-checked": 2}[receipt["verdict"]]
        return receipt


@pytest.fixture
def desk(tmp_path):
    return Desk(tmp_path)


def alike(result: dict[str, Any]) -> dict[str, Any]:
    """The result with the chosen solution of each list as the contour, from which a changed number would stand out."""
    own = ("end", "points", "elements", "certificate", "asked")
    contours = []
    for contour in result["contours"]:
        path = {name: contour[name] for name in own if name in contour}
        solutions = [{**each, **path} if each["is_chosen"] else each for each in contour["solutions"]]
        contours.append({**contour, "solutions": solutions})
    return {**result, "contours": contours}


def failures(receipt: dict[str, Any]) -> list[str]:
    return [check["name"] for contour in receipt["contours"] for check in contour["checks"] if not check["passed"]]


# --- Right results ---------------------------------------------------------------------------------


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
        ("G111 A180. I0 K-30. B120. X100. U60. P500.", "overdetermined"),
        # Line 1 runs at 180 degrees: an angle that is half a turn off conflicts.
        ("G111 A0 I0 K-30. B120. X100. U60.", "conflicting"),
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
        for wrong in nudged(result):
            assert desk.is_wrong(alike(wrong))
        # With notes v and vi of the manual, A or B is ignored, and the block is solved.
        by_the_notes = desk.solve(LATHE + words)["contours"][0]
        claim = {**result["contours"][0], "status": "solved"}
        is_right = all(by_the_notes[name] == claim[name] for name in ("status", "elements"))
        assert desk.verify({**result, "contours": [claim], "rules": "enforce"})[0] == (0 if is_right else 1)
        assert desk.verify({**result, "contours": [claim]})[0] == 1, "the result says that the rules were off"


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


def nudged(result: dict[str, Any], most: int = 6) -> Iterator[dict[str, Any]]:
    """The result with one number off by a millionth, of some of its numbers."""
    every = list(coordinates(result))
    for number, (place, value) in enumerate(Random(len(every)).sample(every, min(len(every), most))):
        yield changed(result, place, value + (NUDGE if number % 2 else -NUDGE))


def leaves(value: Any, place: Place = ()) -> Iterator[tuple[Place, Any]]:
    """Everything below a value that holds nothing else."""
    if isinstance(value, (dict, list)):
        for name, each in value.items() if isinstance(value, dict) else enumerate(value):
            yield from leaves(each, (*place, name))
    else:
        yield place, value


def mutations(result: dict[str, Any]) -> Iterator[tuple[Place, Any]]:
    """Where to put what: one number off or with its other sign, or one truth turned round, in any contour.

    What no check is about is left out: the diagnosis, the filled blocks, the sizes of certificates.
    """
    for place, value in leaves(result["contours"], ("contours",)):
        if {"diagnosis", "filled", "certificate", "within_mm"} & {*place}:
            values = []
        elif isinstance(value, bool):
            values = [not value]
        elif isinstance(value, (int, float)):
            values = [value + (1 if isinstance(value, int) else NUDGE), *([-value] if value else [])]
        else:
            values = []
        for each in values:
            if abs(each - value) > NUDGE / 2 or isinstance(value, bool):  # the other sign of a rounding is no change
                yield place, each


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
    if contour["points"]:
        yield "no points", {"points": {}}
    yield "one point more", {"points": {**contour["points"], "V9": [0.0, 0.0]}}
    yield "branch", {"branch": "farther" if contour["branch"] == "nearer" else "nearer"}
    yield "no line", {"line": contour["line"] + 1}
    yield "other lines", {"lines": [*contour["lines"], 99]}
    yield "axes swapped", {"plane": contour["plane"][::-1]}
    yield "other form", {"form": "G112" if contour["form"] != "G112" else "G111"}
    yield "kind of certificate", {"certificate": {**contour["certificate"], "kind": "sworn"}}
    yield "negative radius", {"certificate": {**contour["certificate"], "radius": -1e-9}}


@pytest.mark.parametrize(
    "name",
    [
        "two roundings",
        "a radius",
        *(pytest.param(name, marks=pytest.mark.slow) for name in ("two bevels", "sharp corners", "a centre", *NEW)),
    ],
)
def test_a_result_that_was_tampered_with_is_found(desk, name):
    result = desk.solve(SAMPLES[name], *(("--control", "nct-99m") if SAMPLES[name].startswith("G17") else ()))
    (contour,) = result["contours"]
    for what, change in tampered(contour):
        assert desk.is_wrong(alike({**result, "contours": [{**contour, **change}]})), what
    for point, side in contour["branches"].items():
        for other in ("nearer", "farther", "left", "right"):
            branches = {**contour["branches"], point: other}
            assert (other == side) != desk.is_wrong(with_contour(result, branches=branches))


def random_programs(count: int) -> Iterator[tuple[str, str]]:
    """Programs of every form, written from drawn paths, and some with another value in one word."""
    rng = Random(7)
    for number in range(count):
        form, plane = generate_nct.FORMS[number % 4], (17, 18, 19)[number % 3]
        kinds = (
            generate_nct.random_pair(rng, form, plane, rng.choice(("", "C", "R"))),
            generate_nct.random_chain(rng, rng.choice((2, 3)), plane),
            generate_nct.random_cornered(rng, plane),
            generate_lx3.random_g112(
                rng, rng.choice(generate_lx3.FORMS), rng.choice(("", "P", "C")), rng.choice(("", "Q", "D"))
            ),
            generate_lx3.random_g11(rng, 2),
        )
        drawn, control = kinds[number % 5], ("yasnac-lx3" if number % 5 > 2 else "nct-99m")
        yield drawn.text, control
        if number % 2:
            yield "\n".join(generate_nct.disturbed(rng, drawn)), control


@pytest.mark.slow
@pytest.mark.parametrize("count", [2, pytest.param(5, marks=pytest.mark.slow)])
def test_random_programs_of_every_form_are_right(desk, count):
    """Whatever becomes of the blocks is worked out again, and one number that is off is found."""
    rng, statuses = Random(8), set()
    for text, control in random_programs(count):
        result = desk.solve(text, "--control", control)
        statuses |= {contour["status"] for contour in result["contours"]}
        receipt = desk.receipt(result)
        assert failures(receipt) == [], text
        paths = {one["verdict"] for one, own in zip(receipt["contours"], result["contours"], strict=True) if own["end"]}
        assert paths <= {"verified"}, text
        every = list(coordinates(result))
        for place, value in rng.sample(every, min(len(every), 4)):
            assert desk.is_wrong(alike(changed(result, place, value + NUDGE))), (place, text)
    assert "solved" in statuses
    assert count < 25 or statuses >= {"solved", "no-solution", "conflicting"}


BESIDE = "1 L X+0 Y+0 R0 FMAX\n{}\n{}"


@pytest.mark.parametrize(
    "lines",
    [
        ("FL X+21 Y+36", "FL X+26 PDX+10 PDY+10 D3"),
        ("FL LEN10 P1X+5 P1Y+12", "FL LEN20 PDX+10 PDY+10 D3"),
    ],
)
def test_lines_beside_a_place_are_measured_on_the_side_where_they_lie(desk, lines):
    result = desk.solve(BESIDE.format(*lines), "--control", "heidenhain")
    assert result["contours"][0]["status"] == "ambiguous"
    assert desk.receipt(result)["verdict"] == "verified"


@pytest.mark.parametrize(
    ("name", "setting", "value"),
    [
        ("two circles", "nct-99m.circle-circle-q", "right-is-negative"),
        ("G112, bevels", "yasnac-lx3.bevel", "setback"),
        ("two bevels", "yasnac-lx3.bevel", "length"),
        ("bevel and rounding", "yasnac-lx3.bevel", "setback"),
    ],
)
def test_the_program_is_read_with_the_settings_that_the_result_names(desk, name, setting, value):
    other = desk.solve(SAMPLES[name])
    result = desk.solve(SAMPLES[name], "--set", f"{setting}={value}")
    assert other["contours"][0]["elements"] != result["contours"][0]["elements"]
    for each, settings_of in ((other, {}), (result, {setting: value})):
        receipt = desk.receipt(each)
        assert (failures(receipt), receipt["verdict"], receipt["settings"]) == ([], "verified", settings_of)
    assert f"read with {setting}={value}, as the result says" in desk.verify(result)[1]
    assert desk.is_wrong({**result, "settings": {}})
    assert desk.is_wrong({**other, "settings": {setting: value}})
    assert desk.is_wrong(with_contour(result, conventions=[]))
    for wrong in nudged(result):
        assert desk.is_wrong(alike(wrong))
    for unknown, message in (
        ({"fanuc.bevel": value}, "has the setting 'fanuc.bevel', which is none of"),
        ({setting: "none"}, "has a setting that is none"),
        ({setting: 5}, "settings[...]: expected `str`, got `int`"),
        ([], "settings: expected `object`, got `array`"),
    ):
        status, output, errors = desk.verify({**result, "settings": unknown})
        assert (status, output, message in errors) == (2, "", True), errors


def test_the_branch_of_a_line_that_touches_is_none(desk):
    result = desk.solve(SAMPLES["a line that touches"])
    assert result["contours"][0]["branch"] is None
    assert desk.receipt(changed(result, ("contours", 0, "branch"), "nearer"))["verdict"] == "failed"


def test_the_other_intersection_is_no_answer(desk):
    other = desk.solve(SAMPLES["the farther point"])
    result = desk.solve(PAIR)
    assert desk.receipt(result)["verdict"] == "verified"
    assert desk.receipt(other)["verdict"] == "failed"
    assert "P1 is the nearer place" in failures(desk.receipt(other))


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
    assert all("certificate" in name for name in failures(desk.receipt(alike(changed(slightly_off, place, 0.0)))))
    assert desk.receipt(alike(changed(slightly_off, place, 0.0)))["verdict"] == "failed"
    assert desk.receipt(alike(changed(slightly_off, place, 1e-9)))["verdict"] == "verified"
    # No certificate makes a wrong number right.
    assert desk.receipt(alike(changed(changed(result, at, value + NUDGE), place, 1.0)))["verdict"] == "failed"
    nothing = {"kind": "unknown", "radius": None, "reason": "none", "double": None}
    receipt = desk.receipt(changed(result, ("contours", 0, "certificate"), nothing))
    assert "what certificates prove" in [each["what"] for each in receipt["contours"][0]["not_checked"]]


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
    loose = desk.solve(NO_CIRCLE)
    assert loose["contours"][0]["status"] == "no-solution"
    receipt = desk.receipt(loose)
    assert receipt["verdict"] == "nothing-checked"
    assert "the status" in [each["what"] for each in receipt["contours"][0]["not_checked"]]
    status, output, _ = desk.verify(loose)
    assert status == 2
    assert "not checked (neither path nor status; " in output
    assert "checked nothing: see above" in output
    assert "right" not in output


@pytest.mark.parametrize(("text", "control"), [("G00 X40. Z0.", None), ("", None), (LATHE + "G01 X50.", "yasnac-lx3")])
def test_a_program_without_a_contour_has_nothing_to_check(desk, text, control):
    result = desk.solve(text, *(["--control", control] if control else []))
    receipt = desk.receipt(result)
    assert (receipt["control"], receipt["contours"], receipt["verdict"]) == (control, [], "nothing-checked")
    assert "checked nothing: there is no contour to check" in desk.verify(result)[1]


def test_facts_and_questions_are_checked_with_every_form(desk):
    text = "G00 X100. Z-50.\nG112 U0 I10. K-50. Q5. R30. (contoursolve: length of arc = ?)"
    result = desk.solve(text)
    assert (failures(desk.receipt(result)), desk.receipt(result)["verdict"]) == ([], "verified")
    place = ("contours", 0, "asked", 0, "value")
    value = result["contours"][0]["asked"][0]["value"]
    assert desk.is_wrong(alike(changed(result, place, value + NUDGE)))


def test_ignored_and_unread_words_are_listed(desk):
    receipt = desk.receipt(desk.solve(SAMPLES["A is ignored"]))
    assert "A135." in [each["what"] for each in receipt["contours"][0]["not_checked"]]
    result = desk.solve(PAIR + " ,R2", "--rules", "off")
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


# --- Contours without a path -------------------------------------------------------------------------

STATUSES = ("solved", "rejected", "underdetermined", "conflicting", "overdetermined", "ambiguous", "no-solution")

NO_CIRCLE = MILL + "G3 X50 Y0 R40\n" + LINE
"""Of all the circles through its one point, none is stated."""

STANDINGS = {
    "line 1 lacks a word": ("G111 A180. B120. X100.", "rejected", "underdetermined"),
    "X and U agree": ("G111 A180. K-30. B120. X100. U60.", "rejected", "overdetermined"),
    "X and U disagree": ("G111 A180. K-30. B120. X100. U61.", "rejected", "conflicting"),
    "two corners": ("G111 A180. K-30. B120. X100. C5. P5.", "rejected", "conflicting"),
    "a corner lands nowhere": ("G111 A180. K-30. X100. Z-47. Q5.", "rejected", "underdetermined"),
    "an angle of more than a turn": ("G111 A540. K-30. B120. X100.", "rejected", "solved"),
    "a word too large": ("G111 A180. K-30. B120. X9999999.", "rejected", "rejected"),
    "a word twice": ("G111 A180. K-30. B120. X100. X100.", "rejected", "rejected"),
    "an M word": ("G111 A180. K-30. B120. X100. M08", "rejected", "solved"),
    "a variable": ("G111 A180. K-30. B120. X#1", "underdetermined", "underdetermined"),
    "a variable that is ignored": ("G111 A#1 I5. K-30. B120. X100.", "underdetermined", "underdetermined"),
    "the same line twice": ("G111 A180. I0 B120. X100.", "underdetermined", "underdetermined"),
    "parallel lines": ("G111 A180. B180. X100. Z-50.", "no-solution", "no-solution"),
    "reversed": ("G111 X100. A0 K-30. B120.", "no-solution", "no-solution"),
    "too large": ("G111 X100. A180. K-30. B120. P60.", "no-solution", "no-solution"),
    "the corners overlap": ("G111 X100. A180. K-30. B120. P35. Q35.", "no-solution", "no-solution"),
    "in the band": ("G111 X60. A180. K-30. B160. C2.", "no-solution", "no-solution"),
    "a bevel outside": ("G111 X100. A180. K-30. B60. C5.", "no-solution", "no-solution"),
    "straight on": ("G111 A135. K-30. B135. X120. P2.", "no-solution", "no-solution"),
    "A ignored": ("G111 A135. I10. K-12. B180. Z-40. P60.", "no-solution", "conflicting"),
    "an angle alone": (MILL + "G1 ,A150\nX10 Y20", "rejected", "underdetermined"),
    "an angle alone, and a corner": (MILL + "G1 ,A150 ,R2\nX10 Y20", "rejected", "underdetermined"),
    "no circle": (MILL + "G3 X-50 Y0\n" + LINE, "rejected", "underdetermined"),
    "no Q": (MILL + "G3 I-50 J0\nG1 X-50 Y42.857 ,A171.87", "rejected", "ambiguous"),
    "no Q, one path": (MILL + "G3 I-50 J0\nG1 X0 Y42.857 ,A171.87", "rejected", "solved"),
    "Q is 0": (MILL + "G3 I-50 J0\nG1 X-50 Y42.857 ,A171.87 Q0", "rejected", "ambiguous"),
    "no compensation": ("G17 G90 G0 X50 Y0\nG3 I-50 J0\n" + LINE, "rejected", "solved"),
    "a centre on the line": (PAIR + " R5", "rejected", "solved"),
    "lines that part": (MILL + "G1 X0 Y0\n" + LINE, "no-solution", "no-solution"),
    "a line before a circle that it misses": (MILL + "G1 ,A90\n" + CIRCLE, "no-solution", "no-solution"),
    "circles apart": (MILL + "G3 I-5 J0\n" + CIRCLE, "no-solution", "no-solution"),
    "a circle without Q": (MILL + "G1 ,A150\n" + CIRCLE.replace("Q-1", "Q0"), "rejected", "ambiguous"),
    "lines that are parallel": (MILL + "G1 ,A90\nG1 X0 Y30 ,A-90", "no-solution", "no-solution"),
    "a point beside its circle": (MILL + "G1 ,A150\n" + CIRCLE.replace("Y60", "Y61"), "conflicting", "conflicting"),
    "a chamfer too large": (MILL + "G1 X80 ,C31\nX90 Y40", "no-solution", "no-solution"),
    "chamfers that overlap": (MILL + "G1 X80 ,C20\nY30 ,C20\nX60", "no-solution", "no-solution"),
    "a chamfer and a rounding": (MILL + "G1 X80 ,C3 ,R3\nX90 Y40", "rejected", "conflicting"),
    "a corner and nothing after it": (MILL + "G1 X80 ,C3\nM8", "rejected", "solved"),
    "a corner straight on": (MILL + "G1 X80 ,C3\nX90", "no-solution", "no-solution"),
    "the arc's rounding too large": (MILL + "G1 X80 ,R40\nG3 X50 Y30 R30", "no-solution", "no-solution"),
    "an angle along the only coordinate": (MILL + "G1 X70 ,A90", "no-solution", "no-solution"),
    "an angle along the coordinate it is at": (MILL + "G1 X50 ,A90", "underdetermined", "underdetermined"),
    "G112 lacks a word": ("G112 U0 I10. K-50.", "rejected", "underdetermined"),
    "G112 backs up": ("G112 U30. I10. K-50. R30.", "no-solution", "solved"),
    "G112 misses": ("G112 U0 I10. K-50. R5.", "no-solution", "no-solution"),
    "G112 has no way": ("G112 U0 I10. K0 R30.", "no-solution", "underdetermined"),
    "G112, a corner too large": ("G112 U0 I10. K-50. R30. C40.", "no-solution", "no-solution"),
    "G11 without a corner": ("G11 Z-20.", "rejected", "underdetermined"),
    "G12 too large": ("G12 U10. K-7.", "no-solution", "no-solution"),
    "missed": (MILL + "G3 X-50 Y0 R50\nG1 X-50 Y80 ,A180 Q-1", "no-solution", "no-solution"),
    "the radius too small": (MILL + "G3 X-50 Y0 R40\n" + LINE, "no-solution", "no-solution"),
    "a point that is far off": (MILL + "G3 X-50 Y2 I-50 J0\n" + LINE, "conflicting", "conflicting"),
    "against ,A": (MILL + "G3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A-8.13 Q-1", "no-solution", "no-solution"),
    "no arc": (MILL + "G3 X-50 Y0 R50\nG1 X90 Y0 ,A0 Q1", "no-solution", "no-solution"),
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] * (n % 12 > 0)) for n, name in enumerate(STANDINGS)]
)
def test_no_status_is_believed_that_the_words_do_not_give(desk, name):
    """The statuses are those that the manuals' rules and the geometry give. One that a rank decides is believed, of the
    others the receipt says that they were not checked, and another one is never believed."""
    words, *wanted = STANDINGS[name]
    text = words if "\n" in words else LATHE + words
    for rules, status in zip(("enforce", "off"), wanted, strict=True):
        control = "nct-99m" if text.startswith("G17") else "yasnac-lx3"
        result = desk.solve(text, "--rules", rules, "--control", control)
        assert result["contours"][-1]["status"] == status
        receipt = desk.receipt(result)
        assert failures(receipt) == []
        assert receipt["rules"] == rules
        (contour,) = receipt["contours"]
        is_told = "the status" not in [each["what"] for each in contour["not_checked"]]
        assert (contour["verdict"] == "verified") == is_told
        assert is_told or status not in ("solved", "overdetermined", "ambiguous")
        assert not is_told or status in ("solved", "overdetermined", "ambiguous", "underdetermined")
        for other in STATUSES:
            assert other == status or not desk.is_believed(with_contour(result, status=other)), other


ONE_LINE = {
    "there and back": "G1 ,A0.\nG1 X50. Y0. ,A180.",
    "the same way": "G1 ,A0.\nG1 X50. Y0. ,A0.",
    "by its point": "G1 X20 Y0\nG1 X50. Y0. ,A180.",
    "and a third line": "G1 ,A0. ,R2\nG1 X50. Y0. ,A180.\nG1 X80 Y50 ,A90",
    "that are parallel": "G1 ,A0.\nG1 X50. Y1. ,A180.",
}


@pytest.mark.parametrize("name", ONE_LINE)
def test_two_lines_that_are_one_leave_their_meeting_open(desk, name):
    status = "no-solution" if "parallel" in name else "underdetermined"
    result = desk.solve("G17 G90 G42 D1 G0 X0 Y0\n" + ONE_LINE[name], "--control", "nct-99m")
    assert result["contours"][0]["status"] == status
    receipt = desk.receipt(result)
    assert failures(receipt) == []
    for other in (*STATUSES, "undecided"):
        assert other == status or not desk.is_believed(with_contour(result, status=other)), other


BOTH_AT_ONCE = ["Z-27.727 W-4.211 A180. B-152.", "A137. I10. K-10.", "U61. X100. A180. K-30.", "U60. X100. A180. K-30."]


@pytest.mark.parametrize("words", [*BOTH_AT_ONCE, "A180. K-30. B120. X100. Z-47. Q5."])
def test_words_that_lack_something_and_contradict_each_other_conflict(desk, words):
    result = desk.solve(f"{LATHE}G111 {words}", "--rules", "off")
    status = result["contours"][0]["status"]
    assert failures(desk.receipt(result)) == []
    for other in (*STATUSES, "undecided"):
        assert other == status or not desk.is_believed(with_contour(result, status=other)), other


@pytest.mark.parametrize(
    "words",
    [
        "N4 W0 G111 X100. A180. K-30. B120. P? Q?",
        "G111 A180. K-30. B120. Q?",
        "G111 A180. K-30. B120. X100. F?",
        "G112 U0 I10. K-50. C? D5. R30.",
        "G01 Z-20. K?",
    ],
)
def test_what_cannot_be_asked_for_is_rejected(desk, words):
    for rules in ("enforce", "off"):
        result = desk.solve(LATHE + words, "--rules", rules, "--control", "yasnac-lx3")
        assert result["contours"][0]["status"] == "rejected"
        assert failures(desk.receipt(result)) == []
        for status in STATUSES:
            assert status == "rejected" or desk.is_wrong(with_contour(result, status=status)), status
    askable = desk.solve(LATHE + "G111 A180. K-30. B120. X100. Q?")
    assert askable["contours"][0]["status"] == "underdetermined"
    assert desk.is_wrong(with_contour(askable, status="rejected"))


def test_without_a_start_a_contour_is_loose(desk):
    result = desk.solve("G111 A180. K-30. B120. X100.")
    assert result["contours"][0]["status"] == "underdetermined"
    assert desk.receipt(result)["verdict"] == "verified"
    for status in STATUSES:
        assert status == "underdetermined" or not desk.is_believed(with_contour(result, status=status))


def test_that_a_list_is_whole_is_not_checked_and_said_so(desk):
    result = desk.solve(SAMPLES["a radius"])
    (contour,) = result["contours"]
    assert len(contour["solutions"]) > 1
    chosen = [each for each in contour["solutions"] if each["is_chosen"]]
    fewer = {**contour["count"], "solutions": 1, "contours": 1}
    receipt = desk.receipt(with_contour(result, solutions=chosen, count=fewer))
    assert failures(receipt) == []
    assert "whether these are all solutions" in [each["what"] for each in receipt["contours"][0]["not_checked"]]


def test_verify_takes_what_solve_takes(desk):
    block = "G111 X100. A180. K-30. B120. P?"
    apart = ("--start", "X40. Z0.", "--fact", "straight part of line 2 = 20")
    desk.result.write_text(run("solve", "--block", block, *apart, "--format", "json")[1], encoding="utf-8")
    status, output, _ = run("verify", "--block", block, *apart, desk.result, "--format", "json")
    receipt = json.loads(output)
    assert (status, receipt["verdict"], receipt["start"], receipt["facts"]) == (0, "verified", apart[1], [apart[3]])
    for old, new in (("X40.", "X41."), ("= 20", "= 21"), ("B120.", "B121.")):
        options = [each.replace(old, new) for each in ("--block", block, *apart)]
        assert run("verify", *options, desk.result)[0] == 1
    output = run("verify", "--block", block, *apart[:2], desk.result)[1]
    assert "the facts are those of the program; but the program has none, and the result has straight part of" in output
    desk.program.write_text(PROGRAM, encoding="utf-8")
    for wrong, message in (
        ((desk.program,), "name PROGRAM and RESULT.json"),
        (("--block", block), "name RESULT.json and no PROGRAM"),
        (("--block", block, desk.program, desk.result), "name RESULT.json and no PROGRAM"),
    ):
        status, _, errors = run("verify", *wrong)
        assert (status, message in errors) == (2, True)
    several = desk.solve(SAMPLES["one after the other"])
    desk.verify(several)
    status, _, errors = run("verify", desk.program, desk.result, "--fact", "length of line 1 = 3")
    assert (status, "a fact is about the only contour, and the program has 3 (program lines 2, 4, 5)" in errors) == (
        2,
        True,
    )


# --- Further facts, values that are asked for, several solutions -------------------------------------


def block(words: str, facts: str = "", after: str = "") -> str:
    return f"{LATHE}G111 {words}" + (f" (contoursolve: {facts})" if facts else "") + after


def pair(arc: str, line: str, facts: str = "") -> str:
    return f"{MILL}{arc}\n{line}" + (f" (contoursolve: {facts})" if facts else "")


EXTENDED = {
    "length of line 1": block("X100. A180. B120. P5.", "length of line 1 = 30"),
    "length of line 2": block("A180. K-30. B120.", "length of line 2 = 34.641"),
    "direction": block("X100. A180. K-30.", "direction of line 2 = 120"),
    "turn of lines": block("X100. A180. K-30.", "angle from line 1 to line 2 = -60"),
    "line through a place": block("X100. A180. K-30.", "line 2 passes through [Z-40. X74.641]"),
    "rounding through a place": block("X100. A180. K-30. B120. P?", "corner 1 passes through [Z-31. X44.]"),
    "coordinate of V1": block("K-30. X100. B120. P3.", "X of V1 = 44"),
    "begin of a corner": block("X100. A180. K-30. B120. P?", "Z of begin of corner 1 = -25"),
    "center of a corner": block("X100. A180. K-30. B120. P?", "X of center of corner 1 = 57"),
    "radius of a corner": block("X100. A180. K-30. B120. P?", "radius of corner 1 = 5.5"),
    "length of a bevel": block("X100. A180. K-30. B120. C?", "length of corner 1 = 6"),
    "line touches a circle": block("X100. A180. B120. P1.", "line 2 tangent to circle [Z-40. X120. R10.]"),
    "rounding touches a line": block("X100. A180. K-30. B120. P?", "corner 1 tangent to line [Z0. X50.1 A179.]"),
    "rounding touches a circle": block("X100. A180. K-30. B120. P?", "corner 1 tangent to circle [Z-20. X60. R2.]"),
    "equal lengths": block("X100. A180. B120.", "length of line 1 = length of line 2"),
    "meets a line at an angle": block("X100. A180. K-30. B120. Q5.", "corner 2 meets line at 170"),
    "bevel meets a line": block("X100. A180. K-30. B120. D2.", "corner 2 meets line at 170"),
    "meets a line to a place": block("X100. A180. K-30. B120. Q5.", "corner 2 meets line to [Z-60. X130.]"),
    "meets the next line": block("X100. A180. K-30. B120. Q5.", "corner 2 meets next line", "\nG01 Z-70. X110."),
    "two contours": block("X100. Z-47. B120.", "length of line 1 = 30"),
    "an angle that is asked for": block("A? I5. B120. X100. P3.", "length of line 1 = 20"),
    "an increment that is asked for": block("A180. K-30. B120. U? P3.", "length of line 2 = 40"),
    "inches": "G20\nG00 X1.5 Z0.\nG111 X4. A180. K-1.2 B120. P? (contoursolve: straight part of line 2 = 1.1)",
    "line beside a place": block("X100. A180. K-30.", "line 2 passes beside [Z-40. X80.] at 2"),
    "rounding beside a place": block("X100. A180. K-30. B120. P?", "corner 1 passes beside [Z-31. X44.] at 0.5"),
    "chord of a rounding": block("X100. A180. K-30. B120. P?", "chord of corner 1 = 6"),
    "parallel lines": TURN + "G1 X60 Y40 ,R2\nG1 X40 Y10 ,R3\nG1 X80 Y? (contoursolve: line 3 parallel to line 1)",
    "lines at a distance": TURN
    + "G1 X60 Y40 ,R2\nG1 X? Y20 ,R3\nG1 X80 Y? (contoursolve: line 3 parallel to line 1 at 20)",
    "polar angle of the arc": pair("G3 I-50 J0", "G1 X-80 Y42.857", "polar angle of arc = 75"),
    "a fact that agrees, on its side": block(
        "X100. A180. K-30. B135.", "line 2 passes beside [Z-30. X80.] at 14.1421356"
    ),
    "a fact that agrees": block("X100. A180. K-30. B120.", "Z of V2 = -47.3205"),
    "a fact that agrees, A and B ignored": block("X100. A135. I10. K-12. B180. Z-40.", "Z of V2 = -40"),
    "everything is asked for": block(
        "X100. A170. K-30. B120. P5.",
        "length of line 1 = ?; straight part of line 2 = ?; direction of line 1 = ?; X of end of corner 1 = ?; "
        "angle from line 1 to line 2 = ?; Z of V2 = ?; radius of corner 1 = ?; Z of begin of line 2 = ?",
    ),
    "length of a line of two": TURN + "G1 ,A150\nG1 X10 Y? ,A225 (contoursolve: length of line 1 = 40)",
    "rounding of two lines": TURN + "G1 ,A150 ,R?\nG1 X10 Y20 ,A225 (contoursolve: straight part of line 1 = 30)",
    "chamfer of two lines": TURN + "G1 ,A150 ,C?\nG1 X10 Y20 ,A225 (contoursolve: length of corner 1 = 4)",
    "coordinate of a crossing": MILL + "G3 I? J0\n" + CIRCLE + " (contoursolve: X of P1 = -45)",
    "radius in a chain": TURN + "G1 ,A150 ,R2\nG1 X10 Y20 ,A225\nG3 X-40 Y-20 I-20 J-20 R? Q1",
    "a chamfer before a rounding": MILL
    + "G1 X80 ,C?\nX90 Y40 ,R5\nG3 X60 Y70 R30 (contoursolve: straight part of line 1 = 25)",
    "tangent": pair("G3 I-50 J0", "G1 X-80 Y42.857", "line tangent to arc"),
    "tangent, clockwise": pair("G2 I-50 J0", "G1 X-80 Y42.857", "arc tangent to line"),
    "tangent, one coordinate": pair("G3 I-50 J0", "G1 X-80 ,A171.87", "line tangent to arc"),
    "length of the arc": pair("G3 I-50 J0", "G1 X-80 Y42.857", "length of arc = 60"),
    "turn from the arc": pair("G3 I-50 J0", "G1 X-80 Y42.857", "angle from arc to line = 10"),
    "begin of the line": pair("G3 I-50 J0", "G1 X-80 Y42.857", "X of begin of line = -10"),
    "length of the line": pair("G3 I-50 J0", "G1 X-50 Y42.857 ,A?", "length of line = 20"),
    "the arc touches a line": pair("G3 X-50 Y0 R?", "G1 X-80 Y42.857 ,A171.87 Q1", "arc tangent to line [X0 Y60 A0]"),
    "the arc through two places": pair(
        "G3 I? J?", "G1 X-80 Y42.857 ,A171.87 Q1", "arc passes through [X10 Y50.1]; arc passes through [X-50 Y0]"
    ),
    "radius that is asked for": pair("G3 X-30 Y40 R?", "G1 X-50 Y42.857 ,A171.87 Q-1", "Y of C = 0.2"),
    "a fact chooses the point": pair("G3 X? Y-40 I-50 J0", "G1 X-80 Y42.857 ,A171.87 Q1", "X of N1 = 30"),
    "Q that is asked for": pair("G3 I-50 J0", "G1 X-50 Y42.857 ,A171.87 Q?"),
    "R and Q choose": pair("G3 X-30 Y40 R50", "G1 X-50 Y42.857 ,A171.87 Q-1"),
    "Q is missing": pair("G3 I-50 J0", "G1 X-50 Y42.857 ,A171.87"),
    "a fact chooses": pair("G3 I-50 J0", "G1 X-50 Y42.857 ,A171.87", "length of line = 90.914"),
}


def solved(desk: Desk, name: str) -> dict[str, Any]:
    """The result for one of these programs."""
    is_mill = CLAIMS[name].startswith("G17")
    return desk.solve(CLAIMS[name], *(("--control", "nct-99m") if is_mill else ()))


def listed(result: dict[str, Any]) -> Iterator[tuple[Place, float]]:
    """Every number of all paths and answers that a result lists, apart from the lines of the program."""
    for place, value in numbers(result["contours"]):
        if not {"certificate", "diagnosis", "start", "deviation_mm"} & set(place):
            yield ("contours", *place), value


QUICK = ("Q is missing", "a fact chooses", "line touches a circle")


SOME_QUICK = [pytest.param(n, marks=() if n in QUICK else pytest.mark.slow) for n in EXTENDED]


@pytest.mark.parametrize("name", SOME_QUICK)
def test_no_other_status_passes_for_what_lists_solutions_and_answers(desk, name):
    """Whether the others are wrong, or nothing can be said of them: none is verified."""
    result = solved(desk, name)
    status = result["contours"][-1]["status"]
    has_paths = any(each["is_path"] for each in result["contours"][-1]["solutions"])
    for other in (*STATUSES, "undecided"):
        if other != status:
            changed_one = with_contour(result, status=other)
            verdict = desk.receipt(changed_one)["verdict"]
            # A fact that chooses among solutions, and one that repeats others: the rank does not tell them apart.
            is_open = {other, status} == {"solved", "overdetermined"} and verdict == "partly-verified"
            assert verdict == "failed" or is_open or (verdict == "nothing-checked" and not has_paths), (other, verdict)


WORKED = [
    path for folder in (PROGRAMS, PAGES) for path in sorted(folder.iterdir()) if path.suffix not in (".toml", ".dxf")
]
OF_SEVERAL = {PAGES / "plate.nc": "fanuc-mill"}
"""Programs that controls read differently, and the one that they are for."""


def examples() -> Iterator[Any]:
    """Every example of every rule of every control, and every worked example, with its control."""
    for name, control in DIALECTS.items():
        for rule in control.catalogue:
            for number, text in enumerate((*rule.rejected, *rule.accepted)):
                yield pytest.param(name, text, id=f"{name} {rule.code} {number}")
    for path in WORKED:
        yield pytest.param(
            OF_SEVERAL.get(path), path.read_text(encoding="utf-8"), id=f"{path.parent.parent.name} {path.name}"
        )


DECIDED = ("solved", "overdetermined", "ambiguous", "underdetermined")
"""Statuses that a rank can tell."""


@pytest.mark.parametrize(("control", "text"), [*examples()][::8])
def test_what_solve_says_of_every_example_is_right(control, text):
    """Whatever the control, FK included: what can be measured is right, every path is measured, and no status is called
    verified that a rank does not tell."""
    result = solution(text, *(("--control", control) if control else ()))
    receipt = verify(Document("program", text.encode()), Document("result", result.encode()))
    claims = json.loads(result)["contours"]
    assert [each.name for one in receipt.contours for each in one.checks if not each.passed] == []
    for claim, one in zip(claims, receipt.contours, strict=True):
        verdict = one.verdict.value
        assert not claim["end"] or verdict in ("verified", "partly-verified")
        assert verdict != "verified" or claim["status"] in DECIDED
        assert (verdict == "verified") != ("the status" in [each.name for each in one.omissions])


def turned(contour: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """A contour with an arc in the other sense, for each of its arcs."""
    for number, each in enumerate(contour["elements"]):
        if each["kind"] == "arc":
            other = {**each, "turn": "cw" if each["turn"] == "ccw" else "ccw"}
            yield {**contour, "elements": [*contour["elements"][:number], other, *contour["elements"][number + 1 :]]}


def off_by_little(contour: dict[str, Any], field: str, rng: Random) -> Iterator[dict[str, Any]]:
    """A contour with one number of a field off by a millionth."""
    every = list(numbers(contour[field]))
    for place, value in rng.sample(every, min(3, len(every))):
        yield changed(contour, (field, *place), value + rng.choice((NUDGE, -NUDGE)))


def tampered_kinds(contour: dict[str, Any], rng: Random) -> Iterator[tuple[str, dict[str, Any]]]:
    """A contour with a path, with one claim of each kind changed."""
    for field in ("start", "end", "points", "elements", "asked"):
        yield from ((field, each) for each in off_by_little(contour, field, rng))
    yield from (("sense", each) for each in turned(contour))
    for status in ("rejected", "conflicting", "underdetermined", "ambiguous", "no-solution", "undecided"):
        yield "status", {**contour, "status": status}
    for name in ("solutions", "contours"):
        yield "count", {**contour, "count": {**contour["count"], name: contour["count"][name] + 1}}
    yield "plane", {**contour, "plane": contour["plane"][::-1]}
    yield "lines", {**contour, "lines": [*contour["lines"], 9999]}
    yield "form", {**contour, "form": "another"}
    yield "facts", {**contour, "facts": [*contour["facts"], "length of line 1 = 7"]}
    yield "element", {**contour, "elements": contour["elements"][1:]}


KINDS = {
    "start",
    "end",
    "points",
    "elements",
    "status",
    "count",
    "plane",
    "lines",
    "form",
    "facts",
    "element",
    "contour",
}
"""What every contour with a path claims."""


FEW_CONTROLS = [pytest.param(name, marks=[pytest.mark.slow] * (n % 4 > 0)) for n, name in enumerate(DIALECTS)]


@pytest.mark.slow
@pytest.mark.parametrize("count", [2])
@pytest.mark.parametrize("control", FEW_CONTROLS)
def test_what_is_tampered_with_is_caught_for_every_control(control, count):
    """Every kind of number, in the contour alone and with its like in the list of solutions, and contours that are
    missing: in so many examples of the rules of a control."""
    rng, kinds, caught = Random(control), set[str](), 0
    texts = [text for rule in DIALECTS[control].catalogue for text in rule.accepted]
    for text in rng.sample(texts, len(texts)):
        result = json.loads(solution(text, "--control", control))
        if not result["contours"] or not result["contours"][0]["end"] or not result["contours"][0]["points"]:
            continue
        wrong = [("contour", {**result, "contours": result["contours"][1:]})]
        for kind, each in tampered_kinds(result["contours"][0], rng):
            one = {**result, "contours": [each, *result["contours"][1:]]}
            wrong += [(kind, one), (kind, alike(one))]
        for kind, each in wrong:
            documents = Document("program", text.encode()), Document("result", json.dumps(each).encode())
            assert verify(*documents).verdict is ReceiptVerdict.FAILED, (kind, text)
        kinds |= {kind for kind, _ in wrong}
        caught += 1
        if caught == count:
            break
    assert kinds >= KINDS


STATED = re.compile(r"(?<== )[-+]?[\d.]+|(?<=[ZXYR])-?[\d.]+(?=[ \]])(?=[^\[]*\])|(?<=at )\d+")
"""The numbers in facts."""


@pytest.mark.parametrize("name", [n for n in SOME_QUICK if STATED.search(EXTENDED[n.values[0]].partition("solve:")[2])])
def test_the_answer_to_a_slightly_different_fact_is_wrong(desk, name):
    text = EXTENDED[name]
    begin = text.index("contoursolve:")
    for match in STATED.finditer(text, begin):
        # Some only agree within the least increment, and a place may be moved along a level line.
        if name.startswith("a fact") or match[0] == "0":
            continue
        number = match[0] if "." in match[0] else match[0] + "."
        other = text[: match.start()] + number + "00002" + text[match.end() :]
        if "." in match[0]:
            other = text[: match.start()] + f"{float(match[0]) + 2e-5:.6f}" + text[match.end() :]
        result = desk.solve(other, *(("--control", "nct-99m") if text.startswith("G17") else ()))
        assert not desk.is_wrong(result), other
        (contour,) = result["contours"]
        program = parse(text).blocks
        contour |= {"facts": [each.text for block in program for each in block.directives], "filled": None}
        desk.program.write_bytes(text.encode())
        assert desk.is_wrong(result), other


def with_contour(result: dict[str, Any], **change: Any) -> dict[str, Any]:
    return {**result, "contours": [{**result["contours"][0], **change}]}


@pytest.mark.parametrize(
    "name",
    [each for each in SOME_QUICK if not each.values[0].startswith("a fact that agrees")],
)
def test_a_list_of_solutions_that_was_tampered_with_is_found(desk, name):
    result = solved(desk, name)
    (contour,) = result["contours"]
    solutions, count = contour["solutions"], contour["count"]
    for number, each in enumerate(solutions):
        rest = [*solutions[:number], *solutions[number + 1 :]]
        assert desk.is_wrong(with_contour(result, solutions=rest))
        assert desk.is_wrong(with_contour(result, solutions=[*solutions, each])), "the number is wrong"
        more = {**count, "solutions": count["solutions"] + 1, "contours": count["contours"] + each["is_path"]}
        if each["is_path"]:
            assert desk.is_wrong(with_contour(result, solutions=[*solutions, each], count=more)), "twice"
        if each["is_path"] and each["is_chosen"]:
            fewer = {**count, "solutions": len(rest), "contours": sum(other["is_path"] for other in rest)}
            assert desk.is_wrong(with_contour(result, solutions=rest, count=fewer)), "the contour is not among them"
        for change in (
            {"is_chosen": not each["is_chosen"]},
            {"is_path": not each["is_path"]},
            {"elements": each["elements"][:-1], "is_path": True},
            {"points": {}, "is_path": True},
            {"end": None, "is_path": True},
        ):
            changed_one = [*solutions[:number], {**each, **change}, *solutions[number + 1 :]]
            assert desk.is_wrong(with_contour(result, solutions=changed_one)), change
        for other in solutions:
            if each["is_path"] and other["is_path"] and other is not each:
                marked = [{**one, "is_chosen": one is each} for one in solutions]
                assert each["is_chosen"] or desk.is_wrong(with_contour(result, solutions=marked)), "another is marked"
    for change in (
        {"solutions": count["solutions"] + 1},
        {"contours": count["contours"] - 1},
        {"is_complete": not count["is_complete"]},
    ):
        assert desk.is_wrong(with_contour(result, count={**count, **change}))
    assert desk.is_wrong(with_contour(result, count=None))
    if contour["end"]:
        assert desk.is_wrong(with_contour(result, count={**count, "chosen_by": "Q7"}))
        assert desk.is_wrong(with_contour(result, solutions=[{**each, "is_chosen": False} for each in solutions]))
        # A word that tells the contour from another solution may agree, too.
        for status in (
            "ambiguous",
            "underdetermined",
            *(() if name.startswith("a fact chooses") else ("overdetermined",)),
        ):
            assert desk.is_wrong(with_contour(result, status=status)), status
    else:
        path = next(each for each in solutions if each["is_path"])
        own = {key: path[key] for key in ("end", "points", "elements", "certificate", "asked")}
        one = [{**each, "is_chosen": each is path} for each in solutions]
        claim = with_contour(result, **own, status="solved", solutions=one)
        assert desk.is_wrong(with_contour(result, **own, solutions=one))
        if contour["status"] == "ambiguous" and "Q" not in name:
            # That nothing chooses cannot be seen in the contour; the other paths of the list tell it.
            assert desk.is_wrong(claim)


@pytest.mark.parametrize(
    ("text", "facts", "line"),
    [
        (block("X100. A180. K-30. B120."), ["length of line 1 = 30"], "G111 X100. A180. K-30."),
        (block("X100. A180. K-30. B120."), ["Z of V1 = -30"], "G111 X100. A180. K-30."),
        (
            pair("G3 I-50 J0", "G1 X-80 Y42.857", "line tangent to arc"),
            ["radius of arc = 50"],
            "G1 X-80 Y42.857",
        ),
    ],
)
def test_words_that_leave_the_points_loose_fix_none(desk, text, facts, line):
    """As many words as unknowns, of which some say the same: any path along the way would do."""
    result = desk.solve(text, *(("--control", "nct-99m") if text.startswith("G17") else ()))
    program = "\n".join([*text.split("\n")[:-1], f"{line} (contoursolve: {facts[0]})"])
    desk.program.write_bytes(program.encode())
    found = failures(desk.receipt(with_contour(result, facts=facts)))
    assert "the words fix the points" in found


def test_a_half_circle_and_a_touching_line_are_fixed(desk):
    for text in (
        pair("G3 X-50 Y0 R50", LINE, "length of line = ?"),
        pair("G3 I-50 J0", "G1 X-50 Y50 ,A180", "length of arc = ?"),
    ):
        result = desk.solve(text)
        receipt = desk.receipt(result)
        assert failures(receipt) == []


def test_facts_missing_added_or_unreadable_are_found(desk):
    result = solved(desk, "coordinate of V1")
    facts = result["contours"][0]["facts"]
    for wrong in ([], ["X of V1 = 45"], [*facts, "length of line 1 = 30"], [*facts, "nonsense"], [*facts, *facts]):
        assert desk.is_wrong(with_contour(result, facts=wrong)), wrong
    assert desk.is_wrong(with_contour(result, facts=[*facts, "length of corner 2 = 3"])), "there is no corner 2"
    assert desk.is_wrong(with_contour(result, facts=[*facts, "Z of V1 = 1e999"]))
    assert desk.is_wrong(with_contour(result, asked=[asks("Z of V1 = ?", -1, -30.0)])), "nobody asks"


def asks(word: str, line: int, value: float | None, unit: str = "mm") -> dict[str, Any]:
    return {"word": word, "line": line, "unit": unit, "value": value}


@pytest.mark.slow
def test_facts_from_the_command_line_are_given_again(desk):
    for text, fact, options in (
        (block("X100. A180. B120."), "length of line 1 = 30", ()),
        (pair("G3 I-50 J0", "G1 X-80 Y42.857"), "line tangent to arc", ("--control", "nct-99m")),
    ):
        result = desk.solve(text, "--fact", fact, *options)
        receipt = desk.receipt(result, "--fact", fact)
        assert (receipt["verdict"], receipt["facts"]) == ("verified", [fact])
        words = [word for check in receipt["contours"][0]["checks"] for word in check["words"]]
        assert fact in words
        assert failures(desk.receipt(result))
        for place, value in (each for each in listed(result) if each[0][2] != "solutions"):
            wrong = alike(changed(result, place, value + NUDGE))
            assert desk.receipt(wrong, "--fact", fact)["verdict"] == "failed", place


def test_a_value_that_was_asked_for_is_answered_once(desk):
    result = solved(desk, "everything is asked for")
    asked = result["contours"][0]["asked"]
    assert len(asked) == 8
    for number, each in enumerate(asked):
        rest = [*asked[:number], *asked[number + 1 :]]
        for wrong in (rest, [*asked, each], [*rest, {**each, "value": None}], [*rest, {**each, "line": 7}]):
            assert desk.is_wrong(with_contour(result, asked=wrong))
        unit = "mm" if each["unit"] == "deg" else "deg"
        assert desk.is_wrong(with_contour(result, asked=[*rest, {**each, "unit": unit}]))


def test_filled_blocks_are_not_checked_and_said_so(desk):
    result = solved(desk, "begin of a corner")
    filled = {**result["contours"][0]["filled"], "deviation_mm": 7.0}
    receipt = desk.receipt(with_contour(result, filled=filled))
    assert "the filled blocks" in [each["what"] for each in receipt["contours"][0]["not_checked"]]


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("length of line 1", "= 30", "= 30.0001"),
        ("length of line 1", "A180.", "A180. K-30."),
        ("tangent", "tangent to", "passes through"),
        ("tangent", "line tangent to arc", "angle from arc to line = 180"),
        ("tangent", "G3", "G2"),
        ("tangent, one coordinate", ",A171.87", ",A171.88"),
        ("length of the arc", "length of arc = 60", "length of arc = 374.159265358979"),
        ("length of the arc", "length of arc = 60", "length of arc = -60"),
        ("meets a line at an angle", "170", "-10"),
        ("meets the next line", "X110.", "X110.001"),
        ("meets the next line", "G01", "G02"),
        ("meets a line to a place", "Z-60. X130.", "Z-47.4 X100.274"),
        ("direction", "= 120", "= -60"),
        ("turn of lines", "-60", "60"),
        ("radius that is asked for", "R?", "R50"),
        ("radius that is asked for", "R?", ""),
        ("begin of a corner", "P?", "Q?"),
        ("begin of a corner", "P?", "C?"),
        ("begin of a corner", "P?", "P8.66"),
        ("R and Q choose", "R50", "R-50"),
        ("R and Q choose", "Q-1", "Q1"),
    ],
)
def test_a_program_with_facts_that_was_changed_afterwards_is_found(desk, name, old, new):
    result = solved(desk, name)
    text = EXTENDED[name]
    assert old in text
    desk.program.write_bytes(text.replace(old, new).encode())
    own = [each.text for block in parse(text.replace(old, new)).blocks for each in block.directives]
    assert desk.verify(result)[0] == 1
    assert desk.verify(with_contour(result, facts=own))[0] == 1


# --- The two laws ------------------------------------------------------------------------------------

CLAIMS = {
    **SAMPLES,
    **EXTENDED,
    **{path.name: path.read_text(encoding="utf-8") for path in sorted(PROGRAMS.glob("*.nc"))},
    "freedoms": LATHE + "G111 A180. B120. X100.",
    "a tie": LATHE + "G111 A180. K-30. B120. X100. U61.",
    "a tie of a circle": MILL + "G3 X-50 Y2 I-50 J0\n" + LINE,
    "ambiguous": MILL + "G3 X-30 Y40 R50\nG1 X-50 Y42.857 ,A171.87",
}
PATHS = {"shaft.nc": 7, "plate.nc": 6, "shaft_broken.nc": 1, "roller.nc": 9}
"""Contours of programs that are verified."""


def some(every: int) -> list[Any]:
    """One claim in so many; the others in the slow part."""
    return [pytest.param(name, marks=[pytest.mark.slow] * (n % every > 0)) for n, name in enumerate(CLAIMS)]


@pytest.mark.parametrize("name", some(12))
def test_what_solve_says_is_right(desk, name):
    result = solved(desk, name)
    receipt = desk.receipt(result)
    assert failures(receipt) == []
    verdicts = [contour["verdict"] for contour in receipt["contours"]]
    assert all(
        each in ("verified", "partly-verified") or not contour["end"]
        for each, contour in zip(verdicts, result["contours"], strict=True)
    )
    assert name not in PATHS or sum(each == "verified" for each in verdicts) == PATHS[name]
    assert name not in SAMPLES or {contour["status"] for contour in result["contours"]} == {"solved"}
    assert name not in EXTENDED or any(each["is_path"] for each in result["contours"][0]["solutions"])


MOST = 8
"""Changes of a program; each of a longer one takes so much longer to verify."""


@pytest.mark.parametrize("name", some(27))
def test_nothing_that_a_contour_claims_can_be_changed(desk, name):
    """Not a number by a millionth, no sign, no truth: neither by itself nor with its like in the list of solutions."""
    result = solved(desk, name)
    every = list(mutations(result))
    assert len(every) > 3
    for place, wrong in Random(name).sample(every, min(MOST, len(every))):
        assert desk.is_refused(changed(result, place, wrong)), place
        if place[2] in ("end", "points", "elements", "asked"):
            assert desk.is_refused(alike(changed(result, place, wrong))), place


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
    assert checks["corner 1 turns as the path does"]["limit"] is None


def test_the_same_inputs_give_the_same_bytes(desk):
    result = desk.solve((PROGRAMS / "plate.nc").read_text(encoding="utf-8"))
    for format_ in ("text", "json"):
        assert desk.verify(result, "--format", format_) == desk.verify(result, "--format", format_)


def test_the_text_says_what_is_wrong_and_by_how_much(desk):
    result = desk.solve(PROGRAM)
    status, output, _ = desk.verify(changed(result, ("contours", 0, "points", "V2", 1), 50.001))
    assert status == 1
    assert "said to be solved: WRONG" in output
    assert "wrong: X of V2 (X100.): off by 0.001 mm, allowed 1.0e-09 mm" in output
    assert output.endswith("1 contour (1 WRONG); the result is not right\n")
    status, output, _ = desk.verify(result)
    assert status == 0
    assert output.endswith("1 contour (1 verified); every claim that was checked is right\n")
    assert f"program {desk.program}: SHA-256 {sha256(desk.program.read_bytes()).hexdigest()}\n" in output


def test_what_is_wrong_is_said_as_what_was_expected_and_found(desk):
    def wrong(result: object, *options: str) -> list[str]:
        lines = desk.verify(result, *options)[1].split("\n")
        return [line.partition("wrong: ")[2] for line in lines if "wrong: " in line]

    result = desk.solve(PROGRAM)
    assert wrong(changed(result, ("contours", 0, "line"), 3)) == [
        "expected: the result mentions this contour; but it has none on this line",
        "expected: the program has a contour block here; but line 3 begins none",
    ]
    assert wrong(changed(result, ("contours", 0, "form"), "G112")) == [
        "expected: the form is that of its blocks; but the program has G111, and the result has G112"
    ]
    fewer = changed(result, ("contours", 0, "count", "solutions"), 2)
    assert wrong(fewer) == ["expected: all solutions are listed; but there are said to be 2, and 1 are listed"]
    desk.program.write_text(PROGRAM.split("\n")[1], encoding="utf-8")
    assert (
        "expected: Z of the start is the program's position; but the program has none, and the result has 0 mm; if it "
        "was solved with --start, verify with it"
    ) in wrong(changed(result, ("contours", 0, "line"), 1))


# --- Inputs that are none --------------------------------------------------------------------------

TROUBLE: tuple[tuple[str, Place, Any, str], ...] = (
    ("schema", ("schema",), "contoursolve/check/1", "schema: invalid enum value 'contoursolve/check/1'"),
    ("control", ("control",), "fanuc", "unknown control 'fanuc'; choose from yasnac-lx3, nct-99m"),
    ("control type", ("control",), 5, "control: expected `str | null`, got `int`"),
    ("contours", ("contours",), {}, "contours: expected `array`, got `object`"),
    ("contour", ("contours", 0), None, "contours[0]: expected `object`, got `null`"),
    ("boolean line", ("contours", 0, "line"), True, "contours[0].line: expected `int`, got `bool`"),
    ("broken line", ("contours", 0, "line"), 2.0, "contours[0].line: expected `int`, got `float`"),
    ("negative line", ("contours", 0, "lines"), [-1], "contours[0].lines[0]: expected `int` >= 0"),
    ("status", ("contours", 0, "status"), "fine", "contours[0].status: invalid enum value 'fine'"),
    ("plane", ("contours", 0, "plane"), ["Z"], "contours[0].plane: expected `array` of length 2, got 1"),
    ("boolean", ("contours", 0, "end"), [1.0, False], "contours[0].end[1]: expected `float`, got `bool`"),
    ("huge", ("contours", 0, "end"), [10**400, 2], "contours[0].end[0]: number out of range"),
    (
        "large",
        ("contours", 0, "end"),
        [10000000000000.0, 2],
        "contours[0].end[0]: expected `float` <= 1000000000000.0",
    ),
    ("point", ("contours", 0, "points"), {"V1": None}, "contours[0].points[...]: expected `array`, got `null`"),
    ("kind", ("contours", 0, "elements", 1, "kind"), "spline", "contours[0].elements[1].kind: invalid value 'spline'"),
    ("radius", ("contours", 0, "elements", 1, "radius"), None, "elements[1].radius: expected `float`, got `null`"),
    (
        "double",
        ("contours", 0, "certificate", "double"),
        5,
        "certificate.double: expected `object | null`, got `int`",
    ),
    ("facts", ("contours", 0, "facts"), "any", "contours[0].facts: expected `array`, got `str`"),
    ("asked", ("contours", 0, "asked"), [None], "contours[0].asked[0]: expected `object`, got `null`"),
    (
        "filled",
        ("contours", 0, "filled"),
        5,
        "contours[0].filled: expected `object | null`, got `int`",
    ),
    ("solution", ("contours", 0, "solutions", 0, "end"), 1, "contours[0].solutions[0].end: expected `array | null`"),
    ("complete", ("contours", 0, "count", "is_complete"), None, "is_complete: expected `bool`, got `null`"),
)


@pytest.mark.parametrize(
    ("place", "value", "message"), [each[1:] for each in TROUBLE], ids=[each[0] for each in TROUBLE]
)
def test_a_result_that_is_none_is_named_by_its_field(desk, place, value, message):
    status, output, errors = desk.verify(changed(desk.solve(PROGRAM), place, value))
    assert (status, output) == (2, "")
    assert message in errors
    assert errors.count("\n") == 1


FIELDS = (
    ((), "schema control rules settings contours diagnostics"),
    (("contours", 0), "line lines form status plane start end points elements branch branches certificate conventions"),
    (("contours", 0), "facts asked filled solutions count diagnosis"),
    (("contours", 0, "elements", 1), "kind start end center radius turn"),
    (("contours", 0, "certificate"), "kind radius reason double"),
    (("contours", 0, "solutions", 0), "name is_chosen selects is_path reasons asked end points elements certificate"),
    (("contours", 0, "count"), "solutions contours is_complete doubts chosen_by"),
)


def test_every_field_must_be_there(desk):
    result = desk.solve(PROGRAM)
    for place, names in FIELDS:
        for name in names.split():
            wrong = deepcopy(result)
            holder: Any = wrong
            for step in place:
                holder = holder[step]
            del holder[name]
            with pytest.raises(CannotVerifyError, match=f"missing required field `{name}`"):
                desk.is_wrong(wrong)


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
    _, _, errors = run("verify", desk.program, desk.program)
    assert f"{desk.program} is not a result of 'solve --format json': it is no JSON document" in errors
    desk.program.write_bytes(PROGRAM.encode("utf-16"))
    status, _, errors = run("verify", desk.program, desk.result)
    assert status == 2
    assert "is UTF-16 text" in errors
    for arguments in ((), (desk.program,), (desk.program, desk.result, "--control", "fanuc")):
        assert run("verify", *arguments)[0] == 2


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=True) | st.text(max_size=4),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=6,
)
FUZZ = settings(
    derandomize=True, deadline=None, max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture]
)


def places(value: Any, place: Place = ()) -> Iterator[Place]:
    if place:
        yield place
    if isinstance(value, (dict, list)):
        for name, each in value.items() if isinstance(value, dict) else enumerate(value):
            yield from places(each, (*place, name))


@pytest.mark.slow
@FUZZ
@given(data=st.data())
def test_whatever_is_put_in_a_result_gets_an_answer(desk, data):
    samples = (
        PROGRAM,
        PAIR,
        LATHE + "G111 A180. B120. X100.",
        *map(EXTENDED.get, ("begin of a corner", "two contours")),
    )
    result = desk.solve(data.draw(st.sampled_from(samples)))
    result["diagnostics"] = []
    wrong = changed(result, data.draw(st.sampled_from(list(places(result)))), data.draw(JSON))
    status, output, errors = desk.verify(wrong, "--format", data.draw(st.sampled_from(("text", "json"))))
    assert status in (0, 1, 2)
    # Without an error, what could not be checked is on the receipt.
    assert bool(output) != bool(errors)
    assert status == 2 if errors else "nothing" in output or status != 2


GARBAGE = ("", "A" + "9" * 31, "\n", "\ud800", "length of line 1 = ?", "X of V2 = 1", "G111 X", "V1", "R5")
DAMAGE = (None, {}, [], True, 0, -1, 1e-9, 5e-324, 1e12, [0.0, 0.0], *GARBAGE)


def damaged(result: dict[str, Any], others: list[dict[str, Any]], rng: Random) -> dict[str, Any]:
    """The result with a node of it gone, of another kind or value, with other digits, or from another contour."""
    copy = deepcopy(result)
    # A place by its depth first: most of a result are numbers far below.
    every = list(places(copy))
    depth = rng.choice([len(place) for place in every[:: max(1, len(every) // 50)]])
    place = rng.choice([place for place in every if len(place) <= depth])
    holder: Any = copy
    for name in place[:-1]:
        holder = holder[name]
    old, kind = holder[place[-1]], rng.randrange(4)
    if kind == 0:
        del holder[place[-1]]
    elif kind == 1 and isinstance(old, str) and re.search(r"\d", old):
        holder[place[-1]] = re.sub(r"[\d.]+", rng.choice(("9" * 31, "0", "?", "#1")), old, count=rng.randrange(3))
    elif kind == 2 and place[0] == "contours" and len(place) > 2:
        holder[place[-1]] = rng.choice(others).get(place[2], old) if len(place) == 3 else [old]
    else:
        holder[place[-1]] = rng.choice(DAMAGE)
    return copy


@pytest.mark.slow
@pytest.mark.parametrize("times", [6])
def test_however_a_result_is_damaged_there_is_an_answer(desk, times):
    """Right, wrong, or no result: never an exception."""
    rng, results = Random(11), {}
    for path in sorted(PROGRAMS.glob("*.nc")):
        text = path.read_text(encoding="utf-8")
        results[text] = desk.solve(text)
        results[text]["diagnostics"] = []
    others = [contour for result in results.values() for contour in result["contours"]]
    for text, result in results.items():
        desk.program.write_bytes(text.encode())
        for number, contour in enumerate(result["contours"]):
            for point in contour["points"]:
                rest = {name: at for name, at in contour["points"].items() if name != point}
                assert desk.is_refused(changed(result, ("contours", number, "points"), rest)), point
        for _ in range(times):
            desk.is_refused(damaged(result, others, rng))


@pytest.mark.parametrize(
    ("name", "place", "value"),
    [
        ("radius of a corner", ("points", "V1"), [0.0, 0.0]),
        ("radius of a corner", ("points",), {}),
    ],
)
def test_what_cannot_be_worked_with_is_wrong(desk, name, place, value):
    result = desk.solve({**SAMPLES, **EXTENDED}[name])
    assert desk.receipt(changed(result, ("contours", 0, *place), value))["verdict"] == "failed"


VOCABULARY = """G00 G01 G111 G112 G2 G3 G17 G18 G20 G28 G41 G90 G91 X40. X-50 Z0. Z-30. Y0 U60. W-5. A180. A0 B120. I0
I-50 K-30. C5. P5. P0 Q5. D5. Q-1 Q0 R50 R-50 J0 ,A171.87 ,C1 #1=2 X#1 A A1e9 (a ) / M98 N5
X9999999999999999999999999999999. A9999999999999999999999999999999. ,A9999999999999999999999999999999."""
WORDS = st.sampled_from([*VOCABULARY.split(), "\n"])


@pytest.mark.slow
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
    assert failures(desk.receipt(claimed))[0] == "every word and fact can be read"


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


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.name)
def test_the_verifier_uses_nothing_of_the_solver(module):
    imported = set()
    for node in ast.walk(ast.parse(module.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            imported |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            imported |= {str(node.module), *(f"{node.module}.{alias.name}" for alias in node.names)}
    assert "importlib" not in imported
    named = {name for name in imported if name.count(".") > 1} - PLAIN
    own = {name.split(".")[1] for name in named if name.startswith("contoursolve.")}
    assert own & set(FORBIDDEN.split()) == set()
    assert not {name.split(".")[0] for name in imported} & {"casadi", "sympy", "flint", "scipy"}
