"""The test vectors of docs/vectors, as tests read them; and how they are written.

A new vector is a row `{"id": ..., "program": [...]}` of the file of its control, with its settings if it has some:
`python tests/support/vectors.py` computes what is missing, and sorts. It changes no number that stands there.
"""

import json
import re
import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from oracle import Element

import contoursolve
from contoursolve import Answer, ArcSegment, Diagnostic, Result
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.controls import CONTROLS
from contoursolve.output.document import to_json

FOLDER = Path(__file__).parents[2] / "docs" / "vectors"
FILES = {path.stem: path for path in sorted(FOLDER.glob("*.json")) if path.stem in CONTROLS}
VECTORS: dict[str, dict[str, dict[str, Any]]] = {
    name: {each["id"]: each for each in json.loads(path.read_text(encoding="utf-8"))["vectors"]}
    for name, path in FILES.items()
}
"""By control and by id."""

ROWS = [(control, row) for control, rows in VECTORS.items() for row in rows.values()]
BY_HAND = [{**row, "control": control} for control, row in ROWS if row.get("part")]
"""Programs as people write them, without a mistake: nothing is to be reported of them."""

COMPUTED = f"points computed by contoursolve {contoursolve.__version__} and checked by its verify"
CLOSE = 2e-6
"""mm. Computed numbers have six decimals."""


def public(name: str) -> ModuleType:
    """A script of the folder."""
    sys.path.insert(0, str(FOLDER))
    try:
        return import_module(name)
    finally:
        sys.path.remove(str(FOLDER))


def program_of(control: str, name: str) -> str:
    """The program of a vector."""
    return "\n".join(VECTORS[control][name]["program"])


def ends(row: dict[str, Any]) -> list[tuple[float, float]]:
    """Where the elements of all contours of a vector end, as it has them."""
    return [tuple(move["end"]) for contour in row["contours"] for move in contour["path"]]


def path_of(row: dict[str, Any]) -> list[Element]:
    """The path of a vector, X as radius."""
    found = list[Element]()
    for contour in row["contours"]:
        sizes = [2 if row.get("x") == "diameter" and axis == "X" else 1 for axis in contour["axes"]]
        at = _complex(contour["start"], sizes)
        for move in contour["path"]:
            end, center = _complex(move["end"], sizes), _complex(move["center"], sizes) if "center" in move else None
            radius = move.get("radius", 0.0 if center is None else abs(end - center))
            found.append(Element("arc" if "turn" in move else "line", at, end, center, radius, move.get("turn", "")))
            at = end
    return found


def _complex(place: list[float], sizes: list[int]) -> complex:
    return complex(place[0] / sizes[0], place[1] / sizes[1])


def settings(control: str, row: dict[str, Any]) -> dict[str, str]:
    """The settings of a vector as functions take them."""
    return {f"{control}.{name}": value for name, value in row.get("settings", {}).items()}


def solved(control: str, row: dict[str, Any]) -> Result:
    """What contoursolve says of a vector."""
    return contoursolve.solve(
        "\n".join(row["program"]), control=control, settings=settings(control, row), depth="verdict"
    )


def refusal(result: Result) -> dict[str, Any]:
    """What a vector says of the first error, with its grade and its source."""
    first = next(each for each in result.diagnostics if each.is_error)
    line = first.span.line
    assert not any(each.contour and each.lines[0] <= line <= each.lines[-1] for each in result.answers)
    around = [each.status.value for each in result.answers if each.contour is None]
    own = [each.status.value for each in result.answers if each.lines[0] <= line <= each.lines[-1]]
    status = {"status": (own or around)[0]} if own or around else {}
    refused = {"line": line, **status, "code": first.code, **_alarms(first)}
    return {"refused": refused, "grade": first.source.evidence.value, "source": str(first.source)}


def _alarms(finding: Diagnostic) -> dict[str, Any]:
    if not finding.alarm:
        return {"alarms": []}
    numbers = re.findall(r"(?<![\w.])P?\d{2,}(?:-\d+)?(?![\w.])", finding.alarm.number)
    return {"alarms": numbers, "alarm_grade": finding.alarm.evidence.value}


def _contour(answer: Answer) -> dict[str, Any]:
    contour = answer.contour
    assert contour is not None
    path = []
    for each in contour.elements:
        arc = isinstance(each, ArcSegment)
        rest = {"center": _place(each.center), "radius": _number(each.radius), "turn": each.turn.value} if arc else {}
        path.append({"end": _place(each.end), **rest})
    lines, axes = [answer.lines[0], answer.lines[-1]], list(answer.plane.axes)
    return {"lines": lines, "axes": axes, "start": _place(contour.start), "path": path}


def _place(at: tuple[float, float]) -> list[float]:
    return [_number(each) for each in at]


def _number(value: float) -> float:
    rounded = round(value, 6)
    return int(rounded) if rounded == int(rounded) else rounded


def _filled(control: str, row: dict[str, Any]) -> dict[str, Any]:
    """A vector with what is missing in it."""
    if "refused" in row or "contours" not in row:
        result = solved(control, row)
        if result.has_errors:
            row |= refusal(result)
        else:
            assert "refused" not in row, f"{control}, {row['id']}: no error any more"
            document = to_json(result).encode()
            program = Document("program", "\n".join(row["program"]).encode())
            receipt = verify(program, Document("result", document), control=control)
            assert receipt.verdict is ReceiptVerdict.VERIFIED, row["id"]
            contours = [_contour(each) for each in result.answers]
            x = {"x": "radius"} if ["Z", "X"] in [each["axes"] for each in contours] else {}
            row |= {**x, "tolerance": CLOSE, "contours": contours, "grade": "derived"}
            row.setdefault("source", COMPUTED)
    order = ("id", "part", "program", "settings", "x", "tolerance", "contours", "refused", "grade", "source")
    assert row.keys() <= {*order}, row
    return {name: row[name] for name in order if name in row}


def written(control: str, rows: list[dict[str, Any]]) -> str:
    """The text of a file: a line for each vector, sorted by id."""
    rows = sorted(rows, key=lambda each: each["id"])
    lines = ",\n".join(json.dumps(each, ensure_ascii=False) for each in rows)
    return f'{{"control": "{control}", "vectors": [\n{lines}\n]}}\n'


if __name__ == "__main__":
    for control, path in FILES.items():
        rows = json.loads(path.read_text(encoding="utf-8"))["vectors"]
        filled = written(control, [_filled(control, row) for row in rows])
        path.write_text(filled, encoding="utf-8", newline="\n")
