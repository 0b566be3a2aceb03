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
TURN = "G17 G90 G42 G0 X100 Y20\n"
ARC = "G00 X100. Z-50.\n"
PAIR = MILL + "G3 X-50 Y0 R50\n" + LINE

SAMPLES = {
    "two bevels": LATHE + "G111 X100. A180. K-30. B120. C5. D5.",
    "bevel and rounding": LATHE + "G111 U60. A180. K-30. B120. C5. Q5.",
    "A is ignored": LATHE + "G111 A135. I10. K-12. B180. Z-40. P2.",
    "one after the other": PROGRAM
    + "\nG01 X110. W-5.\nG111 U20. A170. K-20. B100. C1.\nG111 A180. K-9. B135. X160. Q2.",
    "G112, bevels": ARC + "G112 U0 I10. K-50. C5. D5. R30.",
    "two circles": MILL + "G3 X-50 Y0 I-50 J0\nG3 X-40 Y60 I-40 J20 R40 Q-1",
    "a chain": TURN + "G1 ,A150 ,R2\nG1 X10 Y20 ,A225 ,C2\nG3 X-40 Y-20 I-20 J-20 R20 Q1",
}


def block(words: str, facts: str = "", after: str = "") -> str:
    return f"{LATHE}G111 {words}" + (f" (contoursolve: {facts})" if facts else "") + after


def pair(arc: str, line: str, facts: str = "") -> str:
    return f"{MILL}{arc}\n{line}" + (f" (contoursolve: {facts})" if facts else "")


EXTENDED = {
    "coordinate of V1": block("K-30. X100. B120. P3.", "X of V1 = 44"),
    "begin of a corner": block("X100. A180. K-30. B120. P?", "Z of begin of corner 1 = -25"),
    "two contours": block("X100. Z-47. B120.", "length of line 1 = 30"),
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
