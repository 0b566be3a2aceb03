"""How long an editor waits: for an edit in a program of any length, and for a hover while it is examined."""

import asyncio
import re
from statistics import median
from time import perf_counter, process_time

import pytest
from editor import Editor, types

from contoursolve import OpenProgram, solve
from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration import begin

ROUNDS = 41
HEAD = "O1\nG50 X200. Z200.\nG96 S200 M3\n"
ONE = (
    "N{number} G00 X{start}. Z0.\nG01 Z-5. F0.2\nX50. Z-10.\nG00 X200. Z2.\nX40. Z0.\n"
    "G111 X100. A180. K-{depth}. B120. {corner} Q5.\nG00 X200.\nZ2.\nT0101 M8\nG04 X1.\n"
)
MIDDLE = 5_009
"""A contour in the midst of 10,000 lines."""


def program_of(lines: int, corner: str = "P5.") -> str:
    ones = (
        ONE.format(number=(10 * n + 10) % 10_000, start=40 + n % 7, depth=30 + n % 9, corner=corner)
        for n in range(lines // 10)
    )
    return HEAD + "".join(ones)


def edit(program: OpenProgram, line: int, digit: int) -> float:
    """Type one digit into the K of a contour; how long its findings take, seconds of processor time."""
    column = program.line(line).index("K-") + 4
    begin = process_time()
    program.edit((line, column), (line, column + 1), str(digit))
    program.check()
    assert isinstance(program.diagnostics, tuple)
    return process_time() - begin


def check_alone(lines: list[str], digit: int) -> float:
    """The same contour with the lines from the last known position to the next one."""
    text = re.sub(r"K-\d+", f"K-3{digit}", "\n".join(lines))
    begin = process_time()
    solve(text, control="yasnac-lx3")
    return process_time() - begin


@pytest.mark.parametrize("corner", ["P5.", "P500."], ids=["solved", "refused"])
def test_an_edit_costs_what_depends_on_it(corner, told):
    program = OpenProgram(program_of(10_000))
    program.check()
    if corner != "P5.":
        block = program.blocks[MIDDLE - 1].text
        program.edit((MIDDLE, 1), (MIDDLE, len(block) + 1), block.replace("P5.", corner))
        program.check()
    assert bool(program.diagnostics) == (corner != "P5.")
    around = [program.blocks[line - 1].text for line in range(MIDDLE - 1, MIDDLE + 3)]
    edits, alone = [], []
    for number in range(ROUNDS):
        edits.append(edit(program, MIDDLE, number % 5 + 1))
        alone.append(check_alone(around, number % 5 + 1))
    ours, theirs = 1e3 * median(edits), 1e3 * median(alone)
    what = "an edit of a contour in 10,000 lines" + (", which is refused" if corner != "P5." else "")
    told(what, f"{ours:.1f} ms", f"{ours / theirs:.1f} times that contour with its neighbours alone")
    assert ours < 4 * theirs


@pytest.mark.parametrize("where", ["in the first lines", "in the midst"])
def test_an_edit_hardly_grows_with_the_program(where, growth):
    seconds = {}
    for lines in (1_000, 10_000, 100_000):
        program = OpenProgram(program_of(lines))
        program.check()
        line = 9 if where == "in the first lines" else lines // 20 * 10 + 9
        seconds[lines] = median(edit(program, line, number % 5 + 1) for number in range(ROUNDS))
    assert growth(f"an edit {where} of a program", seconds) < 0.9


def test_a_hover_is_answered_while_a_program_is_examined(told):
    """The slowest of the hovers over places that are not examined yet."""

    async def use() -> list[float]:
        editor, uri, waits = Editor(), "file:///programs/long.nc", []
        await editor.start()
        editor.open(uri, program_of(20_000))
        for line in range(18_008, 0, -3_000):
            wanted = types.HoverParams(types.TextDocumentIdentifier(uri), types.Position(line, 30))
            begin = perf_counter()
            found = await editor.ask(editor.client.text_document_hover_async(wanted))
            waits.append(perf_counter() - begin)
            assert found.contents.value
        await editor.stop()
        return waits

    waits = asyncio.run(use())
    told(f"a hover while 20,000 lines are examined, the slowest of {len(waits)}", f"{1e3 * max(waits):.0f} ms", "")


def test_the_first_examination(growth):
    seconds = {}
    for lines in (1_000, 10_000, 100_000):
        program = OpenProgram(program_of(lines))
        begin = process_time()
        program.check()
        seconds[lines] = process_time() - begin
    assert growth("the first examination in the editor", seconds) < 1.2


PLATE = [(60, 0), (60, 20), (80, 20), (80, 60), (50, 60), (50, 80), (20, 80), (20, 60), (0, 60), (0, 0)]


def test_a_corner_of_a_plate_is_pulled_in_the_explorer(told):
    corners = "\n".join(f"X{x}. Y{y}. ,R3." for x, y in PLATE[:-1])
    talk = Conversation(begin(f"G17 G90 F200\nG0 X0. Y0.\nG1 {corners}\nX0. Y0.", control="fanuc-mill"))
    times = []
    for number in range(ROUNDS):
        wide = 80 + number / 10
        pulled = {"do": "move", "values": {"5:X": wide, "6:X": wide}, "number": number, "is_held": True}
        begin_ = process_time()
        shown = talk.answer({**pulled, "handle": {"P": ["5:X", "6:X"]}})
        times.append(process_time() - begin_)
        assert not shown["view"]["trouble"]
    told("an update of a plate with ten corners in the explorer", f"{1e3 * median(times):.0f} ms", "")
