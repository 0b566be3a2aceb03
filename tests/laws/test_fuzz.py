"""Text that nobody would write: reading it loses no character, and every command answers it in time, with no traceback.

`python tests/support/fuzzing.py` runs as many programs as one likes.
"""

import random
import re
from decimal import Decimal
from pathlib import Path

import pytest
from examples import law
from fuzzing import NAMED, case_of, check_answers, drawn_case, fault_of, mutant
from hypothesis import strategies as st

from contoursolve import parse, solve
from contoursolve.controls import CONTROLS
from contoursolve.diagnosis.spelling import Meanings
from contoursolve.gcode import parse_block

LETTERS = st.sampled_from("ABCDFGIJKMNOPQRSTUWXYZabcxyz,/%#[]();.+-0123456789 \t$\0\u00e9\u0663\u20ac\U0001f600")
ANYTHING = st.one_of(st.text(), st.text(alphabet=LETTERS), st.text(alphabet="\r\n\x0b\x0c\x1c\x85\u2028X1. ;("))
BLANKS = re.compile(r"[ \t\f\v\x02\x03\x11-\x14\x1a\ufeff%]*")
SKIP = re.compile(r"[ \t]*/[1-9]?(?![0-9])")
COMMENTS = re.compile(r"\([^)]*\)|;.*")


@law(ANYTHING, few=2, many=3)
def test_every_character_is_in_a_word_a_fault_a_comment_or_blank(text):
    program = parse(text)
    assert "\n".join(block.text for block in program.blocks) == re.sub(r"\r\n?", "\n", text).removesuffix("\n")
    for number, block in enumerate(program.blocks, 1):
        assert block.line == number
        skip = SKIP.match(block.text)
        rest, here = "", skip.end() if skip else 0
        for part in sorted((*block.words, *block.faults), key=lambda part: part.span):
            begin, end = part.span.column - 1, part.span.end_column - 1
            assert part.span.line == number
            assert here <= begin < end <= len(block.text)
            rest, here = rest + block.text[here:begin] + "\n", end
        for word in block.words:
            assert block.text[word.span.column - 1 : word.span.end_column - 1] == word.text
            value = re.fullmatch(r",?[ \t]*[A-Z][ \t]*(.+)", word.text, re.IGNORECASE | re.ASCII)[1]
            assert "".join(word.text.removesuffix(value).split()).upper() == word.address
            assert word.number == (None if set("#[") & set(value) else Decimal(value))
            assert word.number is None or value.isascii()
        if not block.macro:
            for piece in (rest + block.text[here:]).split("\n"):
                assert BLANKS.fullmatch(COMMENTS.sub("", piece)), piece


LONG = st.sampled_from(
    [*"XYZIJKGNFR0123456789.,-+=()[]#;:%\"' \tOol|$_", "ANG", "RND=", "#ANG", "AC(", "IC(", "DIAMON", "N10 "]
)


@law(st.lists(LONG, max_size=40).map("".join), st.sampled_from(["siemens-840d", "isg"]), few=2, many=10)
def test_words_with_long_addresses_stand_where_they_say_and_are_spelled_as_they_were_typed(text, control):
    syntax, lexicon = CONTROLS[control].modes.syntax, CONTROLS[control].modes.lexicon
    block, here = parse_block(text, 1, syntax), 0
    for part in sorted((*block.words, *block.faults), key=lambda part: part.span):
        begin, end = part.span.column - 1, part.span.end_column - 1
        assert here <= begin < end <= len(text)
        assert text[begin:end] == part.text
        here = end
    for word in block.words:
        if word.number is not None and word.address != "G":
            again = parse_block(lexicon.spell(word.address, lexicon.number_of(word.text, word.address)), 1, syntax)
            assert [(each.address, each.number) for each in again.words] == [(word.address, word.number)]


@law(ANYTHING, st.sampled_from(sorted(CONTROLS)), st.sampled_from(["enforce", "warn", "off"]), few=2, many=6)
def test_arbitrary_text_is_answered(text, control, rules):
    check_answers(solve(text, control=control, rules=rules), text)


@pytest.mark.parametrize(
    ("control", "seeds"), [(each, range(first, first + 4)) for each in NAMED for first in range(100, 120, 4)]
)
def test_every_command_answers_mutants_of_every_control(control, seeds):
    for seed in seeds:
        for each in NAMED if control is None else [control]:
            case = drawn_case(each, seed)
            fault = fault_of(case)
            assert not fault, f"{each} {seed}: {fault}\n{case}"


@pytest.mark.parametrize("count", [1, 40])
def test_what_solve_says_of_mutants_is_complete_and_each_word_has_a_meaning(count):
    for control in NAMED:
        draw = random.Random(control)
        for _ in range(count):
            _, text = mutant(control, draw)
            rules = draw.choice(("enforce", "enforce", "warn", "off"))
            try:
                check_answers(solve(text, control=control, rules=rules), text)
                for block in parse(text).blocks:
                    Meanings(block).at(block.span)
            except Exception as error:
                raise AssertionError(f"solve({text!r}, control={control!r}, rules={rules!r})") from error


MENDED = [
    ("isg", "check part.nc", "G90 G17 G0 X0 Y0\nG302.005 I5\nG1 X10\nG1 Y10"),
    ("fanuc-lathe", "check part.nc", "G0 X0 Z0\nG1 X#100 ,A30"),
    ("fanuc-lathe", "sensitivity {blocks}", "G00 X20. Z0.\nG01 Z-20. ,R5. (contoursolve trust: X777.)\nX40. Z-30."),
    ("haas-mill", "convert part.nc --to fanuc-mill --rules off", "G17 G90 G00 X0 Y0\nG00 X30.\n,C5.\nX40. Y40."),
    ("heidenhain", "sweep {blocks} --vary tool=1:9:4 --side left --quiet", "X0 Y0\nFL AN+60\nFL X+80 Y+20 AN-30"),
    (
        "fanuc-mill",
        "check part.nc",
        "G01X-.032F.005\nG00Z.05\nX.625\nG71U400R500\nG71P10Q11U420W150F.009\nX-0.3708Y.0356 ,R0.02",
    ),
    ("yasnac-lx3", "sensitivity {blocks}", "G00 X100. Z-50.\nG112 U0 I10. K-50. R30. P5. Q5.\nG00 X60.\nG112"),
    ("cnc-pilot", "solve part.nc", "FERTIGTEIL\nG0 X30 Z0\nG1 X30 Z-20\nG1 Z? X30\nG1 X30 Z-50\nG1 A60"),
    ("heidenhain", "check part.nc", "L X+0 Y+0\nFL X+30 Y+0\nFCT DR+ R10 CCA+0\nFLT\nFC DR+ R10\nFCT DR- CCX+Q1"),
    ("heidenhain", "solve part.nc --derivation", "L X+0 Y+0\nFL AN+0 LEN50\nFL AN+90\nFL PAR 2 DP20 X+10"),
]
"""What ended in a traceback, or took too long: the control, the command with part.nc or {blocks}, and the program."""


@pytest.mark.parametrize(("control", "command", "text"), MENDED, ids=range(len(MENDED)))
def test_what_was_mended_stays_so(control, command, text):
    fault = fault_of(case_of(control, command, text))
    assert not fault, fault


BROKEN = sorted((Path(__file__).parents[1] / "cases" / "known_broken").glob("*.nc"))


@pytest.mark.slow
@pytest.mark.parametrize("path", BROKEN, ids=lambda path: path.stem)
def test_what_is_listed_as_broken_still_is(path):
    """A program that is answered leaves the list. Its first line is a comment: control | command | reason."""
    first, _, text = path.read_text(encoding="utf-8").partition("\n")
    control, command, reason = (each.strip(" (;)[]") for each in first.split("|"))
    assert reason
    fault = fault_of(case_of(control, command, text))
    assert fault, f"{path.name} is answered now: delete it"
