"""Every public record comes back from a pickle and a copy as it was, in this process and in another one."""

import io
import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from copy import copy, deepcopy
from dataclasses import fields, is_dataclass, replace
from enum import Enum
from functools import cache, partial
from pathlib import Path
from typing import Any

import ezdxf
import pytest
from msgspec import Struct

import contoursolve
from contoursolve import CONTROLS, Sketch
from contoursolve.comparison import Document, verify
from contoursolve.controls import GEOMETRY_RULES, NCT_99M
from contoursolve.output.document import to_json

START = "X40. Z0."
WHOLE, SHORT = "G111 X100. A180. K-30. B120. P5. Q5.", "G111 X100. A180. B120."
MINE = replace(NCT_99M, name="mine", title="the machine in hall 2", rules=(*NCT_99M.rules, *GEOMETRY_RULES))
PAIR = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"
FK = "0 BEGIN PGM A MM\n1 L X+0 Y+0\n2 FL X+20 Y+20\n3 FL AN+0 LEN20\n4 END PGM A MM"
PROGRAMS: dict[str, tuple[str, dict[str, Any]]] = {
    "solved": (WHOLE, {"start": START}),
    "refused": (SHORT, {"start": START}),
    "asked": ("G111 X100. A180. K-30. B120. P?", {"start": START, "facts": ["straight part of line 2 = 30."]}),
    "with variables": (f"#100=100.\nG00 {START}\n{WHOLE.replace('X100.', 'X#100')}", {}),
    "one after the other": (f"G00 {START}\n{WHOLE}\n{SHORT}\nG111 A135. I10. K-12. B180. Z-90.", {}),
    "fanuc-lathe": ("G00 X0. Z0.\nG01 X40. ,A90. ,R5.\nG01 Z-40. ,A180.", {"control": "fanuc-lathe"}),
    "siemens": ("G18 DIAMON G0 X20 Z0\nG1 X40 RND=2\nZ-50", {}),
    "settings": (
        "G18 DIAMON G0 X20 Z0\nG1 X40 RND=2\nZ-50",
        {"control": "siemens-840d", "settings": {"siemens-840d.machine": "lathe"}},
    ),
    "klartext": (FK, {}),
    "cnc-pilot": ("FERTIGTEIL\nG0 X20 Z0\nG1 X40 BR2\nG1 Z-50", {"control": "cnc-pilot"}),
    "own control": (PAIR, {"control": MINE}),
    "no contour": ("M30", {}),
}
"""Programs that show what answers have; of several controls, one of them from outside."""

RELOAD = "import pickle, sys; sys.stdout.buffer.write(pickle.dumps(pickle.load(sys.stdin.buffer)))"


def of_a_program(text: str, options: dict[str, Any]) -> Iterator[object]:
    result = contoursolve.solve(text, **options)
    yield from (result, result.program, *result.diagnostics)
    for answer in result.answers:
        yield from (answer, answer.system, answer.read_by, answer.contour, *answer.words)
        yield answer.solutions


def of_a_block() -> Iterator[object]:
    start: dict[str, Any] = {"start": START}
    yield contoursolve.family(WHOLE, vary={"P": [1.0, 5.0, 60.0]}, **start)
    yield contoursolve.family(WHOLE, vary={"A": [170.0, 180.0], "P": [1.0, 60.0]}, **start)
    yield contoursolve.ranges(WHOLE, ("P", "Q"), ((1.0, 9.0), (1.0, 9.0)), **start)
    yield contoursolve.ranges(WHOLE, "P", **start)
    yield contoursolve.find(WHOLE, "P", "end Z-50.", **start)
    yield contoursolve.sensitivity(WHOLE, **start)
    yield contoursolve.tolerances(WHOLE, allowed={"P": 0.05}, **start)
    yield contoursolve.tolerances(WHOLE, "A", keep="end Z", within=0.1, **start)
    lacking = contoursolve.solve(SHORT, **start).answer
    yield from (lacking.system.null_space, *lacking.completions, *lacking.addable, *NCT_99M.examples[:5])
    program = Document("p.nc", f"G00 {START}\n{WHOLE}".encode())
    yield verify(program, Document("p.json", to_json(contoursolve.solve(program.data.decode())).encode()))
    yield contoursolve.exercise(WHOLE, "V2 Z", seed=1, **start)
    yield contoursolve.draw(contoursolve.solve(WHOLE, **start))
    yield contoursolve.expand(f"G00 {START}\n{WHOLE}")
    yield contoursolve.convert(f"G00 {START}\n{WHOLE}", "fanuc-lathe")
    yield contoursolve.fix(f"G00 {START}\nG111 A135. I10. K-12. B180. Z-40.\n")
    turned = "G42 G01 X18. Z0.\nX20. Z-1.\nZ-20."
    yield contoursolve.solve(turned, tool="R0.8, tip 3", control="fanuc-lathe", start="X0. Z0.").tool
    opened = contoursolve.OpenProgram(f"G00 {START}\n{WHOLE}")
    assert opened.check()
    yield from opened.contours


def of_a_drawing() -> Iterator[object]:
    sketch = Sketch()
    sketch.circle("a", (0, 0), 3)
    sketch.circle("k")
    for fact in ("k tangent to a", "X of center of k = 10", "Y of center of k = 0", "radius of k = ?"):
        sketch.state(fact)
    yield from (sketch, drawings := sketch.solve(), *drawings)
    for path in sorted((Path(__file__).parents[1] / "sketches").glob("*.toml")):
        known = contoursolve.read_sketch(path.read_text(encoding="utf-8"))
        yield from (known, known.solve())
    yield contoursolve.write(known, "fanuc-lathe")
    document, stream = ezdxf.new(units=4), io.StringIO()
    document.modelspace().add_line((0, 0), (10, 5))
    document.write(stream)
    yield contoursolve.read_dxf(stream.getvalue().encode(), part="milled")


@cache
def errors() -> list[Exception]:
    """Errors as users meet them; they are compared by what they say and hold."""
    found: list[Exception] = [contoursolve.errors.MissingExtraError("a picture needs resvg")]
    asked: list[Callable[[], object]] = [
        partial(contoursolve.solve, WHOLE, control="yasnac"),
        partial(contoursolve.solve, WHOLE, settings={"yasnac-lx3.nothing": "1"}),
        partial(contoursolve.solve, Path("nowhere.nc")),
        partial(contoursolve.ranges, SHORT, "P", start=START),
        partial(contoursolve.solve, WHOLE, tool="R0.8", start=START),
        partial(contoursolve.write, contoursolve.solve(SHORT, start=START), "fanuc-lathe"),
        partial(contoursolve.read_dxf, b"nothing", part="milled"),
    ]
    for ask in asked:
        with pytest.raises(ValueError, match=r".") as caught:
            ask()
        found.append(caught.value)
    return found


RECORDS: dict[str, Callable[[], Iterator[object]]] = {
    **{name: partial(of_a_program, *asked) for name, asked in PROGRAMS.items()},
    "block": of_a_block,
    "drawing": of_a_drawing,
}


@cache
def records_of(name: str) -> list[object]:
    return [*RECORDS[name]()]


@pytest.mark.parametrize("name", RECORDS)
def test_a_record_comes_back_from_a_pickle_and_a_copy_and_an_equal_question_has_an_equal_answer(name: str) -> None:
    assert [*RECORDS[name]()] == records_of(name) != []
    for record in records_of(name):
        for back in (pickle.loads(pickle.dumps(record)), deepcopy(record), copy(record)):
            assert back == record
            assert type(back).__hash__ is None or hash(back) == hash(record)


def test_a_record_comes_back_from_another_process() -> None:
    """Which knows nothing of it; the tables of the control that is not built in stand in this module."""
    told = [records_of(name) for name in RECORDS if name != "own control"]
    done = subprocess.run([sys.executable, "-c", RELOAD], input=pickle.dumps(told), capture_output=True, check=True)
    assert pickle.loads(done.stdout) == told


def test_tables_of_a_built_in_control_are_the_same_objects_again() -> None:
    for control in CONTROLS.values():
        for table in (control, control.modes, control.modes.lexicon, *control.forms, *control.rules):
            assert pickle.loads(pickle.dumps(table)) is deepcopy(table) is table
    back = pickle.loads(pickle.dumps(MINE))
    assert (back, hash(back), {*back.rules}) == (MINE, hash(MINE), {*MINE.rules})
    assert len(pickle.dumps(contoursolve.solve(WHOLE, start=START))) < 10_000


def test_an_error_comes_back_as_it_was() -> None:
    for error in errors():
        back = pickle.loads(pickle.dumps(error))
        assert (type(back), str(back), vars(back)) == (type(error), str(error), vars(error))


def types_in(value: Any, seen: dict[int, Any]) -> Iterator[type]:
    if id(value) in seen or isinstance(value, str | int | float):
        return
    seen[id(value)] = value
    yield type(value)
    if isinstance(value, contoursolve.Control):
        return  # its tables hold nothing that a user gets
    inside = []
    if isinstance(value, Mapping):
        inside = [*value.values()]
    elif isinstance(value, tuple | list):
        inside = [*value]
    elif isinstance(value, Struct):
        inside = [getattr(value, name) for name in value.__struct_fields__]
    elif is_dataclass(value):
        inside = [getattr(value, each.name) for each in fields(value)]
    for each in inside:
        yield from types_in(each, seen)


def test_every_public_type_is_among_them() -> None:
    """But for a program that is open in an editor, which is no record."""
    seen: dict[int, Any] = {}
    met = {each for name in RECORDS for record in records_of(name) for each in types_in(record, seen)}
    met |= {type(error) for error in errors()}
    public = {each for name in contoursolve.__all__ if isinstance(each := getattr(contoursolve, name), type)}
    assert {each.__name__ for each in public - met if not issubclass(each, Enum)} == {"OpenProgram"}
