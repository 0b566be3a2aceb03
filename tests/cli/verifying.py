"""Programs, results and ways to change these, for the tests of `contoursolve verify`."""

import json
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

from calling import run

from contoursolve.comparison import CannotVerifyError, Document, ReceiptVerdict, verify

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
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


NUDGE = 1e-6
"""mm."""

Place = tuple[str | int, ...]


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

    def receipt(self, result: object, *options: str) -> dict[str, Any]:
        status, output, _ = self.verify(result, "--format", "json", *options)
        receipt: dict[str, Any] = json.loads(output)
        assert status == {"verified": 0, "failed": 1, "partly-verified": 0, "nothing-checked": 2}[receipt["verdict"]]
        return receipt


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


def numbers(value: Any, place: Place = ()) -> Iterator[tuple[Place, float]]:
    """Every coordinate and radius below a value, with its place."""
    if isinstance(value, float):
        yield place, value
    elif isinstance(value, (dict, list)):
        for name, each in value.items() if isinstance(value, dict) else enumerate(value):
            yield from numbers(each, (*place, name))


def changed(value: Any, place: Place, new: Any) -> Any:
    """A value with something else at a place below it; the rest is shared, for copies take longer than verifying."""
    if not place:
        return new
    copy = {**value} if isinstance(value, dict) else [*value]
    copy[place[0]] = changed(value[place[0]], place[1:], new)
    return copy


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


def paths_changed(elements: list[dict[str, Any]]) -> Iterator[list[dict[str, Any]]]:
    """A path without an element, with one twice, in halves, the other way round or straight, and in another order."""
    for number, element in enumerate(elements):
        before, after = elements[:number], elements[number + 1 :]
        middle = [(a + b) / 2 for a, b in zip(element["start"], element["end"], strict=True)]
        yield [*before, *after]
        yield [*before, element, element, *after]
        yield [*before, {**element, "end": middle}, {**element, "start": middle}, *after]
        if element["kind"] == "arc":
            yield [*before, {**element, "turn": "ccw" if element["turn"] == "cw" else "cw"}, *after]
            yield [*before, {"kind": "line", "start": element["start"], "end": element["end"]}, *after]
    for number, (one, other) in enumerate(pairwise(elements)):
        yield [*elements[:number], other, one, *elements[number + 2 :]]


STATUSES = ("solved", "rejected", "underdetermined", "conflicting", "overdetermined", "ambiguous", "no-solution")


def tampered(contour: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Changes of a contour with a path that are no changes of a number."""
    yield from ({"elements": each} for each in paths_changed(contour["elements"]))
    yield from ({"status": each} for each in STATUSES if each not in ("solved", "overdetermined"))
    yield from ({"elements": []}, {"end": None}, {"start": [None, None]})
    yield from [{"points": {}}] if contour["points"] else []
    yield {"points": {**contour["points"], "V9": [0.0, 0.0]}}
    yield {"branch": "farther" if contour["branch"] == "nearer" else "nearer"}
    yield {"line": contour["line"] + 1}
    yield {"lines": [*contour["lines"], 9999]}
    yield {"plane": contour["plane"][::-1]}
    yield {"form": "G112" if contour["form"] != "G112" else "G111"}
    yield {"facts": [*contour["facts"], "length of line 1 = 7"]}
    yield {"certificate": {**contour["certificate"], "kind": "sworn"}}
    yield {"certificate": {**contour["certificate"], "radius": -1e-9}}
    for point, side in contour["branches"].items():
        others = {"nearer", "farther", "left", "right"} - {side}
        yield from ({"branches": {**contour["branches"], point: other}} for other in sorted(others))


def lists_changed(contour: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Changes of the list of solutions, and of what is said of it."""
    solutions, count = contour["solutions"], contour["count"]
    yield {"count": None}
    for number, each in enumerate(solutions):
        before, after = solutions[:number], solutions[number + 1 :]
        yield {"solutions": [*before, *after]}
        yield {"solutions": [*solutions, each]}
        if each["is_path"]:
            more = {"solutions": count["solutions"] + 1, "contours": count["contours"] + 1}
            yield {"solutions": [*solutions, each], "count": {**count, **more}}
        if each["is_path"] and each["is_chosen"]:
            fewer = {"solutions": count["solutions"] - 1, "contours": count["contours"] - 1}
            yield {"solutions": [*before, *after], "count": {**count, **fewer}}
        for change in (
            {"is_chosen": not each["is_chosen"]},
            {"is_path": not each["is_path"]},
            {"elements": each["elements"][:-1], "is_path": True},
            {"points": {}, "is_path": True},
            {"end": None, "is_path": True},
        ):
            yield {"solutions": [*before, {**each, **change}, *after]}
        if each["is_path"] and not each["is_chosen"] and contour["end"]:
            yield {"solutions": [{**one, "is_chosen": one is each} for one in solutions]}
    for change in (
        {"solutions": count["solutions"] + 1},
        {"contours": count["contours"] - 1},
        {"is_complete": not count["is_complete"]},
    ):
        yield {"count": {**count, **change}}
    if contour["end"]:
        yield {"count": {**count, "chosen_by": "Q7"}}
        yield {"solutions": [{**each, "is_chosen": False} for each in solutions]}


def asked_changed(asked: list[dict[str, Any]]) -> Iterator[list[dict[str, Any]]]:
    """Other answers: one is missing, twice, without a value, of another line or unit."""
    for number, each in enumerate(asked):
        rest = [*asked[:number], *asked[number + 1 :]]
        other = "mm" if each["unit"] == "deg" else "deg"
        yield from (rest, [*asked, each])
        yield from ([*rest, {**each, **change}] for change in ({"value": None}, {"line": 7}, {"unit": other}))


def with_contour(result: dict[str, Any], **change: Any) -> dict[str, Any]:
    return {**result, "contours": [{**result["contours"][0], **change}, *result["contours"][1:]]}
