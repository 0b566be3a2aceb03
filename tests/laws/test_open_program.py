"""A program that is open in an editor has the findings that `solve` finds in its text, after every edit."""

import random
import re
from itertools import combinations_with_replacement, product
from pathlib import Path

import pytest
from drawn_calls import CONTROLS as RUN, drawn_program
from editor import random_edit

import contoursolve
from contoursolve import OpenProgram
from contoursolve.gcode import lexer, parse_block
from contoursolve.gcode.decoding import decode
from contoursolve.program import contour_answers, open_lines, open_program, told_control

ROOT = Path(__file__).parents[2]
PROGRAMS = sorted(
    [
        *(ROOT / "notebooks" / "programs").glob("*.nc"),
        *(each for each in (ROOT / "docs" / "programs").glob("*.*") if each.suffix != ".dxf"),
    ]
)
CONTROLS = {"plate.nc": "nct-99m", "cover.nc": "nct-99m", "bracket.nc": "isg", "flange.mpf": "siemens-840d"}


def edited(text: str, begin: tuple[int, int], end: tuple[int, int], new: str) -> str:
    """The text with an edit, by its own reckoning."""
    lines = contoursolve.gcode.split_lines(text)
    if not lines or lines[-1][-1:] in "\r\n":
        lines.append("")

    def offset(line: int, column: int) -> int:
        if line > len(lines):
            return len(text)
        return sum(map(len, lines[: line - 1])) + min(column - 1, len(lines[line - 1].rstrip("\r\n")))

    return text[: offset(*begin)] + new + text[offset(*end) :]


def compare(program: OpenProgram, text: str, control: str | None) -> None:
    assert program.text == text
    trouble, fresh = "", None
    try:
        fresh = contoursolve.solve(text, control=control)
    except (contoursolve.errors.UnknownControlError, contoursolve.errors.SettingError) as error:
        trouble = str(error)
    assert program.trouble == trouble
    if fresh is None:
        return
    assert program.diagnostics == fresh.diagnostics
    contours = list(program.contours)
    assert [(each.first, each.last) for each in contours] == [(each.lines[0], each.lines[-1]) for each in fresh.answers]
    # Where calls lead to several results, an editor shows the first.
    firsts = [next(each for each in fresh.answers if each.lines == answer.lines) for answer in fresh.answers]
    for contour, answer in zip(contours, firsts, strict=True):
        now = program.contour_at(contour.first)
        assert now is not None
        assert (now.lines, now.status, now.contour, now.diagnostics) == (
            answer.lines,
            answer.status,
            answer.contour,
            answer.diagnostics,
        )
    whole = program.result()
    assert (whole.control, whole.diagnostics, len(whole.answers)) == (
        fresh.control,
        fresh.diagnostics,
        len(fresh.answers),
    )
    assert [each.contour for each in whole.answers] == [each.contour for each in fresh.answers]
    for finding, lines in program.found():
        if finding.fixes:
            assert lines == fresh.lines_of(finding)


def test_edits_beside_any_end_of_a_line_are_those_of_the_text() -> None:
    """A carriage return and a line feed that an edit brings together are one end; one that it parts are two."""
    spans = [*combinations_with_replacement([(1, 6), (2, 1), (2, 2), (3, 1), (9, 9)], 2)]
    for one, other in product(("\n", "\r", "\r\n"), repeat=2):
        text = f"G0 X1{one}{other}X2{one}Y3"
        for (begin, end), new in product(spans, ("", "\n", "\r\nG1", "\nY4\r")):
            program, expected = OpenProgram(text), edited(text, begin, end, new)
            program.edit(begin, end, new)
            program.edit((3, 1), (3, 2), "Z")
            assert program.text == edited(expected, (3, 1), (3, 2), "Z"), (text, begin, end, new)


def test_a_program_with_variables_is_examined_again_for_another_control() -> None:
    text = "#1=20.\nG00 X30. Z0.\nG01 Z-#1 ,R3.\nX60. ,A150.\n"
    program = OpenProgram(text)
    for control in (None, "fanuc-lathe"):
        program.configure(control, {})
        assert program.check()
        compare(program, text, control)


@pytest.mark.parametrize("plane", ["G17 ", "G18 ", ""])
def test_without_a_contour_arcs_alone_tell_the_control(plane: str) -> None:
    """An edit of any line may lead an arc elsewhere."""
    text = f"G21 G90\n{plane}G00 X0 Y0\nG01 X20. F300.\nG02 X40. Y20. I20. J0.\n"
    program = OpenProgram(text)
    for line, before, now in ((3, "20.", "22."), (3, "22.", "20."), (4, "I20.", "I18."), (2, "Y0", "Z0")):
        column = text.split("\n")[line - 1].index(before) + 1
        place = (line, column), (line, column + len(before)), now
        text = edited(text, *place)
        program.edit(*place)
        assert program.check()
        compare(program, text, None)
        if plane == "G17 ":
            assert contoursolve.solve(text).has_errors == (now != "20." and now != "Z0")


def edit_at_random(text: str, name: str, control: str | None, seed: int, edits: int) -> None:
    draw = random.Random(seed)
    program = OpenProgram(text, control=control)
    for number in range(edits):
        begin, end, new = random_edit(contoursolve.gcode.split_lines(text) or [""], draw)
        if begin > end:
            continue
        text = edited(text, begin, end, new)
        program.edit(begin, end, new)
        if draw.randrange(4):
            # An edit may come while an earlier one is still examined.
            assert program.check(None if draw.randrange(2) else 10_000)
            try:
                compare(program, text, control)
            except AssertionError as error:
                raise AssertionError(f"{name}, seed {seed}, edit {number}: {begin} {end} {new!r}") from error
        else:
            program.check(draw.randrange(1, 5))
            look(program, draw.randrange(1, len(program.blocks) + 1), control)


def look(program: OpenProgram, line: int, control: str | None) -> None:
    """What is examined before its turn is what `solve` finds there."""
    program.look(line, line)
    while not program.is_examined(line, line) and not program.check(1):
        pass
    if not program.trouble:
        now, fresh = program.contour_at(line), contoursolve.solve(program.text, control=control)
        wanted = next((each for each in fresh.answers if each.lines[0] <= line <= each.lines[-1]), None)
        assert (now is None) == (wanted is None)
        if now is not None and wanted is not None:
            assert (now.lines, now.contour, now.diagnostics) == (wanted.lines, wanted.contour, wanted.diagnostics)


def test_what_is_examined_before_its_turn_parts_the_lines_around_it() -> None:
    text = "G00 X40. Z0.\nG111 A180. K-30. B120. P5. X100.\nG01 Z-60.\n" * 4
    program = OpenProgram(text)
    for line in (1, 8, 11, 5):
        look(program, line, None)
    assert program.check()
    for line in (11, 2):
        place = (line, 12), (line, 13), "5"
        text = edited(text, *place)
        program.edit(*place)
        assert program.check()
        compare(program, text, None)


def test_the_result_of_many_contours_on_lines_that_have_moved_is_that_of_the_text(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    program = OpenProgram("G00 X40. Z0.\nG111 A180. K-30. B120. P5. X100.\nG01 Z-60.\n" * 40)
    assert program.check()
    program.edit((1, 1), (1, 1), "(NEW)\n")
    assert program.check(2)
    fresh = contoursolve.solve(program.text)
    for most in (0, 1_000):
        monkeypatch.setattr(open_program, "_MOST_RENEWED", most)
        assert program.result().answers == fresh.answers
        program.edit((1, 1), (2, 1), "")
        program.edit((1, 1), (1, 1), "(NEW)\n")
        assert program.check()


def test_what_is_found_so_far_is_found_in_the_end() -> None:
    text = "G00 X40. Z0.\nG111 A180. K-30. B120. P60. X100.\nG01 Z-60.\nG00 X200. Z,5\n" * 4
    program, found = OpenProgram(text), []
    while not program.check(1):
        assert program.examined < 17
        found.append(program.diagnostics)
    assert program.examined == 17
    final = program.diagnostics
    assert {len(each) for each in found} > {0, 1, 2, 3}
    assert all(each in final for early in found for each in early)


@pytest.mark.parametrize("line", [2, 4, 5, 203, 204, -5, -2])
def test_an_edit_reads_what_depends_on_it_alone(line: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """How many blocks are read for an edit depends neither on the length of the program, nor on the line."""
    counts = []
    for contours in (60, 240):
        one = "G00 X40. Z0.\nG111 X100. A180. K-{}. B120. P5. Q5.\nG01 Z-80.\nX130.\n(COMMENT)\n"
        program = OpenProgram("G50 S2000\nM3\n" + "".join(one.format(30 + n % 9) for n in range(contours)))
        assert program.check()
        assert program.diagnostics == ()
        number, read = line % len(program.blocks), list[object]()
        column = re.search(r"\d", program.line(number)[1:]).start() + 2
        for module in (open_lines, told_control, lexer):
            monkeypatch.setattr(
                module, "parse_block", lambda *given, read=read: read.append(given) or parse_block(*given)
            )
        for digit in "234":
            program.edit((number, column), (number, column + 1), digit)
            assert program.check()
            assert isinstance(program.diagnostics, tuple)
        counts.append(len(read))
        monkeypatch.undo()
    assert 0 < counts[0] == counts[1] < 400


@pytest.mark.parametrize("contours", [5, 40])
def test_an_edit_of_a_program_that_runs_solves_what_depends_on_it_alone(
    contours: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = "G00 X40. Z0.\nG111 X100. A180. K-30. B120. P#100\nG01 Z-80.\nM98 P7\n"
    program = OpenProgram(f"O1\n#100=5.\n{one * contours}M30\nO7\nG00 X200. Z5.\nM99\n", control="yasnac-lx3")
    assert program.check()
    assert program.diagnostics == ()
    solved = list[object]()
    monkeypatch.setattr(
        contour_answers, "examine", lambda *given: solved.append(given) or contoursolve.diagnosis.examine(*given)
    )
    for line, column, text, count in ((8, 20, "31", 1), (3, 6, "50", 1), (2, 6, "6", contours)):
        solved.clear()
        program.edit((line, column), (line, column + len(text)), text)
        assert program.check()
        assert program.diagnostics == ()
        assert len(solved) == count
        compare(program, program.text, "yasnac-lx3")


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda path: path.name)
@pytest.mark.parametrize("seed", range(2))
def test_random_edits(path: Path, seed: int) -> None:
    control = CONTROLS.get(path.name, "yasnac-lx3") if seed % 2 else None
    edit_at_random(decode(path.read_bytes(), path.name), path.name, control, 100 + seed, 8)


@pytest.mark.parametrize("seed", range(16))
def test_random_edits_of_programs_that_run(seed: int) -> None:
    control = sorted(RUN)[seed % len(RUN)]
    edit_at_random(drawn_program(control, seed).text, control, control, seed, 4)
