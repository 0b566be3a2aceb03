"""Text that nobody would write: reading it loses no character, and solving it always ends in statuses and findings."""

import random
import re
from decimal import Decimal
from math import hypot, isfinite

import pytest
from examples import law
from hypothesis import strategies as st
from mutations import PROGRAMS, mutate, windows

from contoursolve import Result, Severity, Status, parse, solve
from contoursolve.controls import DIALECTS
from contoursolve.diagnosis.spelling import Meanings
from contoursolve.gcode import number_of, parse_block, spell
from contoursolve.output.contours import contour_lines
from contoursolve.output.document import to_json
from contoursolve.output.findings import finding_lines

GAP = 1e-9
"""mm."""

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
    syntax = DIALECTS[control].modes.syntax
    block, here = parse_block(text, 1, syntax), 0
    for part in sorted((*block.words, *block.faults), key=lambda part: part.span):
        begin, end = part.span.column - 1, part.span.end_column - 1
        assert here <= begin < end <= len(text)
        assert text[begin:end] == part.text
        here = end
    for word in block.words:
        if word.number is not None and word.address != "G":
            again = parse_block(spell(word.address, number_of(word.text, word.address)), 1, syntax)
            assert [(each.address, each.number) for each in again.words] == [(word.address, word.number)]


@law(ANYTHING, st.sampled_from(sorted(DIALECTS)), st.sampled_from(["enforce", "warn", "off"]), few=2, many=6)
def test_arbitrary_text_is_answered(text, control, rules):
    check(solve(text, control=control, rules=rules), text)


def check(result: Result, text: str) -> None:
    """What holds for the answer to any text."""
    lines = [block.text for block in result.program.blocks]
    for answer in result.answers:
        assert isinstance(answer.status, Status)
        has_path = answer.status in (Status.SOLVED, Status.OVERDETERMINED) and answer.contour is not None
        assert has_path or any(each.severity is Severity.ERROR for each in answer.diagnostics)
        if has_path:
            here = answer.contour.start
            for element in answer.contour.elements:
                assert hypot(element.start[0] - here[0], element.start[1] - here[1]) <= GAP
                here = element.end
            assert isfinite(here[0])
            assert isfinite(here[1])
    assert result.answers or result.diagnostics
    for finding in result.diagnostics:
        for span in (finding.span, *(label.span for label in finding.labels)):
            assert 1 <= span.line <= max(len(lines), 1)
            assert 1 <= span.column < span.end_column <= max(len(lines[span.line - 1]) if lines else 0, 1) + 1
        assert finding.message.isprintable() or not text.isprintable()


@pytest.mark.parametrize(
    ("seed", "mutants"), [(0, 15), *(pytest.param(seed, 50, marks=pytest.mark.slow) for seed in range(2))]
)
def test_mutated_contours_are_answered(seed, mutants):
    draw = random.Random(seed)
    for count in range(mutants):
        text, control = draw.choice(windows())
        for _ in range(draw.choice((1, 1, 1, 2, 3, 8))):
            text = mutate(text, draw) or " "
        rules = draw.choice(("enforce", "enforce", "warn", "off"))
        try:
            result = solve(text, control=control, rules=rules)
            check(result, text)
            if count % 10 == 0:
                sources = {block.line: block.text for block in result.program.blocks}
                assert to_json(result)
                assert all(contour_lines(answer, result) for answer in result.answers)
                assert all(finding_lines(finding, "x.nc", sources) for finding in result.diagnostics)
        except Exception as error:
            raise AssertionError(f"solve({text!r}, control={control!r}, rules={rules!r})") from error


MANY, EVERY = 4_000, 100
"""How many mutants of one seed are read, of which two in five are judged; and of how many one goes all the way."""


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(1_000, 1_001))
def test_many_mutated_contours_are_judged(seed):
    draw = random.Random(seed)
    for count in range(MANY):
        text, control = draw.choice(windows())
        for _ in range(draw.choice((1, 1, 2, 2, 3, 8))):
            text = mutate(text, draw) or " "
        rules, depth = draw.choice((*["enforce"] * 8, "warn", "off")), "full" if count % EVERY == 0 else "verdict"
        try:
            if count % 5 > 1:
                for block in parse(text).blocks:
                    Meanings(block).at(block.span)
                continue
            result = solve(text, control=control, rules=rules, depth=depth)
            if depth == "full":
                check(result, text)
        except Exception as error:
            raise AssertionError(f"solve({text!r}, control={control!r}, rules={rules!r}, depth={depth!r})") from error


@pytest.mark.parametrize("count", [3, pytest.param(30, marks=pytest.mark.slow)])
def test_mutated_whole_programs_are_answered(count):
    draw = random.Random(99)
    for _ in range(count):
        text, control = draw.choice(list(PROGRAMS.values()))
        for _ in range(5):
            text = mutate(text, draw)
        try:
            check(solve(text, control=control), text)
        except Exception as error:
            raise AssertionError(f"solve({text!r}, control={control!r})") from error


@pytest.mark.slow
def test_windows_cover_every_contour_and_most_are_solved():
    answers = [solve(text, control=control).answers[0] for text, control in windows()]
    assert len(answers) == sum(len(solve(text, control=control).answers) for text, control in PROGRAMS.values())
    assert sum(answer.status is Status.SOLVED for answer in answers) == 9 + 7 + 6 + 6 + 1 + 3
