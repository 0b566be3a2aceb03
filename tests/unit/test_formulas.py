"""Contours as formulas: what is written, what is refused, and where a program with variables goes on."""

import re

import pytest
from click.testing import CliRunner

import contoursolve
from contoursolve.cli import main

BLOCK = "#100=95.\nG0 X40. Z0.\nG111 X#100 A180. K-30. B120. P5. Q5. F0.2\n"
LX3 = {"control": "yasnac-lx3", "formulas": True}


def test_the_program_keeps_its_variables_and_each_check_stops_the_machine():
    text = contoursolve.expand(BLOCK, post="fanuc", **LX3).text
    assert text.startswith("#100=95.\nG0 X40. Z0.\n(G111 X#100 A180. K-30. B120. P5. Q5. F0.2)\nF0.2\n")
    assert "IF [#141 LE 0.000001] THEN #3000=101 (P DOES NOT FIT)" in text
    assert text.splitlines()[-1].startswith("G03 X#100 Z#")
    assert max(map(len, text.splitlines())) < 80


CHANGED = "#100=95.\n#101=40.\nG0 X#101 Z0.\n#101=50.\nG111 X#100 A180. K-30. B120.\n"
FREE = "#100=95.\nG0 X40. Z0.\nG111 X#100 A180. B120. (contoursolve: length of line 1 = 30)\n"
WITHOUT = BLOCK.replace("#100=95.\n", "")


@pytest.mark.parametrize(
    ("text", "options", "reason"),
    [
        (BLOCK, {"scratch": "#140-#142"}, None),
        pytest.param(
            BLOCK,
            {"scratch": "#140-#141"},
            "no formulas: it needs 3 variables; #140-#141 has 2 that the program does not use",
            marks=pytest.mark.boundary,
        ),
        (WITHOUT, {"variables": {"#100": 80.0}}, None),
        (WITHOUT, {}, ".*X#100.*"),
        (BLOCK, {"variables": {"#100": 41.0}}, ".*corner.*"),
        (CHANGED, {}, "no formulas: X of its start follows variables that have changed"),
        (FREE, {}, "no formulas: what it states besides its words has no closed form"),
    ],
)
def test_nothing_is_written_where_there_is_no_formula_or_no_example(text, options, reason):
    expansion = contoursolve.expand(text, **{**LX3, "post": "linuxcnc", **options})
    if reason is None:
        assert (expansion.text is not None, expansion.summary.left) == (True, [])
    else:
        assert (expansion.text, re.fullmatch(reason, expansion.summary.left[0].reason) is not None) == (None, True)


def test_the_sign_of_a_word_is_a_case_of_its_own():
    text = "#100=-8.\nG0 X100. Z0.\nG12 X60. K#100\n"
    written = contoursolve.expand(text, post="linuxcnc", **LX3).text
    assert re.search(r"o\d+ if \[#100 (LT|GT) ", written)


def test_klartext_has_the_contour_and_the_rest_is_left():
    expansion = contoursolve.expand(BLOCK, post="klartext", keep_going=True, **LX3)
    assert [each.lines for each in expansion.summary.left] == [(2,)]
    assert "Q100 = 95\n" in expansion.text
    assert "FN 14: ERROR = 1000" in expansion.text
    assert re.search(r"CC IZ\+\S+ IX\+\S+\nC X\+Q100 Z\+Q\d+ DR\+", expansion.text.replace("-", "+"))


def command(*arguments: str) -> tuple[int, str]:
    """The exit status of `expand --formulas`, and what it prints."""
    done = CliRunner().invoke(main, ["expand", "--formulas", *arguments])
    return done.exit_code, done.output


WORDS = ("--control", "yasnac-lx3", "--start", "X40. Z0.", "--block")


@pytest.mark.parametrize(
    ("arguments", "status", "told"),
    [
        (("--scratch", "#140-#140", "--variable", "#1=95."), 1, "it needs 3 variables; #140-#140 has 1"),
        (("--scratch", "#160-#140", "--variable", "#1=95."), 2, "is no range of variables"),
        (("--arcs", "radius", "--variable", "#1=95."), 2, "goes without --arcs radius"),
        ((), 1, "X#1"),
    ],
)
def test_the_command_says_why_it_writes_nothing(arguments, status, told):
    found, text = command(*arguments, *WORDS, "G111 X#1 A180. K-30. B120. P5. Q5.")
    assert found == status
    assert told in text


def test_what_belongs_to_formulas_is_asked_for_with_them():
    for option in (("--scratch", "#140-#160"), ("--post", "sinumerik")):
        done = CliRunner().invoke(main, ["expand", *option, *WORDS, "G111 X95. A180. K-30. B120."])
        assert done.exit_code == 2
        assert "--formulas" in done.output
