"""Text outside the two % of a program: it is named, read all the same, and kept."""

from random import Random

import pytest
from click.testing import CliRunner
from interpreter import interpret

import contoursolve
from contoursolve.cli import main

TAPER = "G111 X100. A180. K-30. B120. P5. Q5."
LINES = {"%": "%", "move": "G01 X{number}. Z{number}. F100.", "comment": "(50%)", "nothing": "", "code": "T0101"}


def programs(count):
    """Lines of programs, drawn at random, each a kind of line; with the text."""
    draw = Random(7)
    for _ in range(count):
        kinds = draw.choices(list(LINES), (4, 3, 1, 1, 1), k=draw.randint(1, 9))
        yield kinds, "\n".join(LINES[kind].format(number=number) for number, kind in enumerate(kinds, 1))


def outside(kinds):
    """The lines that a control would leave out, by side: what stands before the first of two % with something between
    them, and what stands after the % that ends the program."""
    marks = [line for line, kind in enumerate(kinds, 1) if kind == "%"]
    says = [line for line, kind in enumerate(kinds, 1) if kind in ("move", "code")]
    if not marks:
        return {}
    before = [line for line in says if line < marks[0]]
    has_pair = len(marks) > 1 and any(marks[0] < line < marks[1] for line in says)
    if before and not has_pair:
        return {"after": [line for line in says if line > marks[0]]}
    end = marks[1] if len(marks) > 1 else float("inf")
    return {"before": before, "after": [line for line in says if line > end]}


@pytest.mark.parametrize("control", ["yasnac-lx3", "nct-99m", None])
def test_the_first_line_outside_is_named_on_either_side(control):
    for kinds, text in programs(60):
        every = contoursolve.check(text, control=control, strict=True)
        found = [each for each in every if each.code == "text-outside"]
        told = {each.message.split()[3]: each.span.line for each in found}
        assert told == {side: lines[0] for side, lines in outside(kinds).items() if lines}, text
        assert all(each.severity.value == "warning" for each in found)


@pytest.mark.interpreter
def test_linuxcnc_runs_what_is_not_named(tmp_path):
    compared = 0
    for kinds, text in programs(60):
        if "".join(kinds).startswith("%") and kinds.count("%") > 1:
            inside = set(range(1, len(kinds) + 1)) - set(outside(kinds)["after"])
            moves = [line for line in sorted(inside) if kinds[line - 1] == "move"]
            ran = [
                motion for motion in interpret(text.replace("T0101", "S1") + "\n", tmp_path) if motion.kind == "line"
            ]
            assert len(ran) == len(moves), text
            compared += 1
    assert compared > 5


def test_expand_keeps_it_and_says_so():
    for kinds, text in programs(60):
        program = f"{text}\nO2\nG00 X40. Z0.\n{TAPER}\n"
        expansion = contoursolve.expand(program)
        assert expansion.text is not None
        assert expansion.text.startswith(f"{text}\nO2\nG00 X40. Z0.\n({TAPER})\n")
        named = outside([*kinds, "code", "move", "move"])
        told = [each.span.line for each in expansion.summary.warned if each.code == "text-outside"]
        assert told == sorted(lines[0] for lines in named.values() if lines)
    done = CliRunner().invoke(main, ["expand", "-"], input=f"%\nM30\n%\nG00 X40. Z0.\n{TAPER}\n%\nM5\n")
    assert "line 4: warning[text-outside]" in done.stderr
    assert done.stdout.endswith("%\nM5\n")
