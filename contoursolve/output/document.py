"""Results as plain data for JSON: schema contoursolve/solve/1."""

from collections.abc import Iterable, Iterator, Mapping
from tempfile import SpooledTemporaryFile
from typing import TYPE_CHECKING, Any

from contoursolve.diagnosis import Answer, AskedValue, decimals_of, list_solutions, printed_certificate, rank
from contoursolve.diagnostics import Diagnosis, Diagnostic, Fix, Span, json_text, members, plain
from contoursolve.output.listing import Collected, Totals, findings_of
from contoursolve.output.premises import premise_data
from contoursolve.program import Result, Run
from contoursolve.solving import DECIMALS, ArcSegment, Certificate, Contour, Point, Proof, Segment

if TYPE_CHECKING:
    from contoursolve.tool_radius import ToolReport


def to_json(result: Result, tool: "ToolReport | None" = None) -> str:
    """The contours and findings of one program; lengths in mm, X of a lathe as radius, angles in degrees. With a tool,
    there is a contour for each run of cutting moves, with the path of the tool."""
    rows = (_contour(each) for each in result.answers) if tool is None else _beside_tool(result, tool)
    contours = (_indented(each, 2) for each in rows)
    findings = (_indented(finding_data(each, result), 2) for each in result.diagnostics)
    return "".join(_document(_head(result), contours=contours, diagnostics=findings))


def _head(result: Result) -> dict[str, Any]:
    return {
        "schema": "contoursolve/solve/1",
        "program": result.program.name,
        "control": result.control,
        "rules": result.policy.value,
        "settings": {f"{result.control}.{name}": value for name, value in sorted(result.settings.items())},
    }


def stream_json(run: Run | Collected, tally: Totals) -> Iterator[str]:
    """The same document in pieces, as its contours are solved; findings wait for their turn outside the memory."""
    if run.frame.start or run.frame.facts or isinstance(run, Collected):
        # What is stated apart is shown at the only contour, which is known at the end; such programs are short.
        result = run.collect()
        tally.severities.update(finding.severity for finding in result.diagnostics)
        yield to_json(result, run.tool if isinstance(run, Collected) else None)
        return
    with Shelf() as shelf:
        contours = _shelving(run, tally, shelf, 0, {})
        yield from _document(_head(run.frame), contours=map(_in_list, contours), diagnostics=shelf)


def _in_list(answer: Answer) -> str:
    return _indented(_contour(answer), 2)


def _shelving(
    run: Run | Collected, tally: Totals, shelf: "Shelf", number: int, about: Mapping[str, Any]
) -> Iterator[Answer]:
    """The contours of a run, whose findings go to a shelf."""
    for item in run:
        tally.count(item)
        for finding in findings_of(item):
            text = _indented({**about, **finding_data(finding, run.frame)}, 2)
            shelf.put((number, rank(finding), isinstance(item, Answer)), text)
        if isinstance(item, Answer):
            yield item


class Shelf:
    """Texts in a temporary file, which come back in the order of their keys."""

    def __init__(self) -> None:
        self._file = SpooledTemporaryFile(_IN_MEMORY)  # noqa: SIM115 - closed by __exit__
        self._places: list[tuple[Any, int, int]] = []

    def __enter__(self) -> "Shelf":
        return self

    def __exit__(self, *_: object) -> None:
        self._file.close()

    def put(self, key: Any, text: str) -> None:
        """Add a text of ASCII; of equal keys, the first comes first."""
        self._places.append((key, self._file.tell(), len(text)))
        self._file.write(text.encode("ascii"))

    def __iter__(self) -> Iterator[str]:
        for _, place, length in sorted(self._places):
            self._file.seek(place)
            yield self._file.read(length).decode("ascii")


_IN_MEMORY = 1 << 22
"""Bytes of a shelf that need no file."""


class Findings:
    """The findings of several programs as one document; each finding names its program."""

    def __init__(self, shelf: Shelf) -> None:
        self.shelf = shelf
        self._programs: list[dict[str, Any]] = []

    def add(self, run: Run | Collected, tally: Totals) -> None:
        """The findings of one more program, as `check` reports them."""
        frame, about = run.frame, {"program": run.frame.program.name}
        number, contours = len(self._programs), 0
        if frame.start or frame.facts:
            result = run.collect()
            contours = len(result.answers)
            for place, finding in enumerate(result.diagnostics):
                tally.count(finding)
                self.shelf.put((number, place), _indented({**about, **finding_data(finding, result)}, 2))
        else:
            contours = sum(1 for _ in _shelving(run, tally, self.shelf, number, about))
        hidden = {"hidden": run.hidden} if isinstance(run, Collected) and run.hidden is not None else {}
        self._programs.append({**about, "control": frame.control, "contours": contours, **hidden})

    def pieces(self) -> Iterator[str]:
        """The document."""
        programs = (_indented(each, 2) for each in self._programs)
        yield from _document({"schema": "contoursolve/check/1"}, programs=programs, diagnostics=self.shelf)


def _document(head: Mapping[str, Any], **lists: Iterable[str]) -> Iterator[str]:
    """An object of texts and lists in pieces; each row is text by itself, for the data of all would fill the memory."""
    before = "{\n "
    for name, value in head.items():
        yield f"{before}{json_text(name)}: {_indented(value)}"
        before = ",\n "
    for name, rows in lists.items():
        yield f"{before}{json_text(name)}: ["
        between = "\n  "
        for row in rows:
            yield between + row
            between = ",\n  "
        yield "]" if between == "\n  " else "\n ]"
    yield "\n}"


def _indented(data: Any, depth: int = 1) -> str:
    return json_text(data).replace("\n", "\n" + " " * depth)


def finding_data(finding: Diagnostic, result: Result) -> dict[str, Any]:
    """One finding as plain data. What is about a fact or a start point stated apart stands at the block, with the place
    in the fact or the start point."""
    return {
        **members(finding, "code severity"),
        **_place(finding.span, result),
        **members(finding, "message help notes"),
        "labels": [{**_place(label.span, result), "text": label.text} for label in finding.labels],
        **members(finding, "addresses basis source alarm values"),
        "fixes": [_fix(fix) for fix in finding.fixes],
    }


def _fix(fix: Fix) -> dict[str, Any]:
    """A fix; with the numbers that it leaves open, and the lines outside the contour that it changes, if there are
    any."""
    data = members(fix, "description replacement applicability")
    if fix.numbers:
        data["numbers"] = [
            {
                **members(each, "word line"),
                "example": each.example or None,
                "ranges": [{"from": ends.low or None, "to": ends.high or None} for ends in each.ranges],
                "complete": each.is_complete,
            }
            for each in fix.numbers
        ]
    if fix.beside:
        data["beside"] = [{"line": each.span.line, **members(each, "old text")} for each in fix.beside]
    return data


def _place(span: Span, result: Result) -> dict[str, Any]:
    shown, columns = result.place(span), {"column": span.column, "end_column": span.end_column}
    apart: dict[str, Any] = {}
    if span.line <= 0:
        apart = {"fact": {"number": -span.line, **columns}} if span.line else {"start": columns}
    return {"line": shown.line, "column": shown.column, "end_column": shown.end_column, **apart}


def _contour(answer: Answer) -> dict[str, Any]:
    contour, certificate = answer.contour, answer.certificate
    decimals = decimals_of(certificate)
    return {
        "line": answer.lines[0],
        "lines": list(answer.lines),
        **({"calls": list(answer.calls)} if answer.calls else {}),
        "form": answer.form,
        "status": answer.status.value,
        "plane": list(answer.plane.axes),
        "start": [None if value is None else _number(float(value)) for value in answer.start.values],
        **({"place": "relative"} if answer.start.is_relative else {}),
        **_path(contour, decimals),
        "branch": ", ".join(side.value for side in answer.sides.values()) or None,
        "branches": plain(answer.sides),
        "certificate": _certificate(certificate),
        **premise_data(answer.premises),
        "facts": [directive.text for directive in answer.claim.directives],
        "asked": [_asked(each, answer) for each in answer.asked],
        "filled": {"blocks": list(answer.filled.blocks), "deviation_mm": _number(answer.filled.deviation)}
        if answer.filled
        else None,
        **_solutions(answer),
        "diagnosis": _diagnosis(answer.diagnosis) if answer.diagnosis else None,
    }


def _beside_tool(result: Result, report: "ToolReport") -> Iterator[dict[str, Any]]:
    """The runs of a program, as the first contour of each goes on, with the tool; and contours that are in none."""
    runs = {line: number for number, each in enumerate(report.runs) for line in each.run.lines}
    firsts = dict[int, Answer]()
    rows = list[tuple[int, dict[str, Any]]]()
    for answer in result.answers:
        number = next((runs[line] for line in answer.lines if line in runs), None)
        if number is None or answer.contour is None:
            none = dict.fromkeys(("radius", "tip", "side", "start", "elements"))
            rows.append((answer.lines[0], {**_contour(answer), "tool": {**none, "faults": []}}))
        else:
            firsts.setdefault(number, answer)
    for number, each in enumerate(report.runs):
        own, first = each.run, firsts.get(number)
        data = _contour(first) if first is not None else _PLAIN
        path, tip = each.path, own.tool.tip if own.is_lathe else None
        faults = [
            {
                "element": fault.element,
                "kind": fault.kind.name.lower(),
                "short_by_mm": None if fault.short is None else _number(fault.short),
                "largest_radius": _number(fault.largest) if fault.largest else None,
            }
            for fault in each.faults
        ]
        data = {**data, "line": own.lines[0], "lines": list(own.lines), "plane": list(own.plane.axes)}
        data |= {"start": _point(each.part.start, DECIMALS), **_path(each.part, DECIMALS)}
        data |= {"points": _path(first.contour, DECIMALS)["points"]} if first is not None else {}
        tool: dict[str, Any] = {"radius": _number(own.radius), "tip": tip, "side": own.side.value}
        tool["start"] = _point(path.start, DECIMALS) if path else None
        tool["elements"] = [_element(element, DECIMALS) for element in path.elements] if path else None
        rows.append((own.lines[0], {**data, "tool": {**tool, "faults": faults}}))
    yield from (data for _, data in sorted(rows, key=lambda row: row[0]))


_PLAIN = {
    "form": "moves",
    "status": "solved",
    "branch": None,
    "branches": {},
    "certificate": {"kind": Proof.EXACT.value, "radius": 0.0, "reason": "", "double": None},
}
"""A run of plain moves: its points are those that are programmed."""


def _path(contour: Contour | None, decimals: int) -> dict[str, Any]:
    return {
        "end": _point(contour.end, decimals) if contour else None,
        "points": {name: _point(at, decimals) for name, at in contour.points.items()} if contour else {},
        "elements": [_element(element, decimals) for element in contour.elements] if contour else [],
    }


def _certificate(certificate: Certificate | None) -> dict[str, Any]:
    printed = printed_certificate(certificate)
    if printed is None:
        return {"kind": Proof.UNKNOWN.value, "radius": None, "reason": "there is no contour", "double": None}
    return {
        **members(printed, "kind=proof radius reason"),
        "double": members(printed, "gap_mm=gap") if printed.gap is not None else None,
    }


def _asked(asked: AskedValue, answer: Answer) -> dict[str, Any]:
    """A value that was asked for, in mm (X of a lathe as radius) or degrees."""
    question = asked.question
    return {
        "word": question.word.text,
        "line": question.word.span.line,
        "unit": question.unit.value,
        "value": None if asked.value is None else round(asked.value, decimals_of(answer.certificate)) + 0.0,
    }


def _solutions(answer: Answer) -> dict[str, Any]:
    """Every solution of the equations, and whether these are proven to be all."""
    listing = list_solutions(answer)
    if listing is None:
        return {"solutions": [], "count": None}
    solutions = [
        {
            **members(each, "name is_chosen selects"),
            "is_path": each.contour is not None,
            **members(each, "reasons"),
            "asked": [_asked(value, answer) for value in each.asked],
            **_path(each.contour, decimals_of(each.certificate)),
            "certificate": _certificate(each.certificate),
        }
        for each in listing.solutions
    ]
    count = {
        "solutions": len(solutions),
        "contours": sum(each.contour is not None for each in listing.solutions),
        **members(listing, "is_complete method within_mm=within doubts chosen_by"),
    }
    return {"solutions": solutions, "count": count}


def _diagnosis(diagnosis: Diagnosis) -> dict[str, Any]:
    freedoms = [members(each, "point direction angle about is_straight") for each in diagnosis.freedoms]
    return {
        **members(diagnosis, "layers"),
        "freedoms": freedoms,
        **members(diagnosis, "ties ties_complete repairs_complete"),
    }


def _element(element: Segment, decimals: int) -> dict[str, Any]:
    start, end = _point(element.start, decimals), _point(element.end, decimals)
    data: dict[str, Any] = {"kind": "line", "start": start, "end": end}
    if isinstance(element, ArcSegment):
        data["kind"] = "arc"
        data["center"] = _point(element.center, decimals)
        data["radius"] = _number(element.radius, decimals)
        data["turn"] = element.turn.value
    return data


def _point(at: Point, decimals: int) -> list[float]:
    return [_number(at[0], decimals), _number(at[1], decimals)]


def _number(value: float, decimals: int = DECIMALS) -> float:
    return round(value, decimals) + 0.0
