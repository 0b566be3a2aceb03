"""No word of a cutting block is lost: each is in the answer, in a finding, or in a table of words without effect."""

import string

import pytest
from hypothesis import strategies as st

import contoursolve
from contoursolve import CONTROLS
from contoursolve.gcode import parse_block
from tests.support.examples import law

_FRAME = {
    "siemens-840d": ("G17 G90 G0 X0 Y0", "G1 X60 {} F200", "Y40 CHR=5", "X20"),
    "isg": ("G17 G90 G0 X0 Y0", "G1 X60 {} F200", "Y40 #CHR=5", "X20"),
    "yasnac-lx3": ("G00 X40. Z0.", "G01 X100. {} F.2", "G111 A180. K-30. B120. X140."),
    "fanuc-lathe": ("G0 X40. Z0.", "G1 X60. {} F.2", "Z-40. ,R5.", "X80."),
    "haas-lathe": ("G0 X40. Z0.", "G1 X60. {} F.2", "Z-40. ,R5.", "X80."),
    **dict.fromkeys(
        ("fanuc-mill", "haas-mill", "mitsubishi", "nct-99m"),
        ("G17 G90 G0 X0 Y0", "G1 X60. {} F200", "Y40. ,R5.", "X20."),
    ),
}
"""Programs of each control with a cutting block, in which words stand, and a contour behind it."""

_LETTERS = st.sampled_from(string.ascii_uppercase).map(lambda letter: f"{letter}7.")
_COMMAS = st.sampled_from(string.ascii_uppercase).map(lambda letter: f",{letter}7.")
_NAMES = st.text(string.ascii_uppercase, min_size=2, max_size=5).map(lambda name: f"{name}=7")
_WORDS = st.one_of(_LETTERS, _COMMAS, _NAMES, _NAMES.map(lambda word: f"#{word}"))
_UNKNOWN = {"position-unknown", "not-read", "value-variable"}


@pytest.mark.parametrize("control", sorted(_FRAME))
@law(st.lists(_WORDS, min_size=1, max_size=2, unique=True), few=2, many=26)
def test_each_word_of_a_cutting_block_is_used_told_or_without_effect(control, words):
    before, cutting, *behind = _FRAME[control]
    cutting = cutting.format(" ".join(words))
    result = contoursolve.solve("\n".join((before, cutting, *behind)), control=control, depth="verdict")
    lexicon, syntax = CONTROLS[control].modes.lexicon, CONTROLS[control].modes.syntax
    spans = [label.span for each in result.diagnostics for label in each.labels]
    told = [span for span in spans if span.line == 2]
    used = {word.span for answer in result.answers for word in answer.claim.words.values()}
    block = parse_block(cutting, 2, syntax)
    places = [(word.address, word.span) for word in block.words] + [
        (fault.address, fault.span) for fault in block.faults
    ]
    for address, span in places:
        row = lexicon.addresses.get(address)
        is_end = row is not None and bool(row.axis)
        is_used = span in used or is_end or address == "G" or lexicon.is_beside(address)
        is_told = any(each.column <= span.column < each.end_column for each in told)
        # Behind what is not known, nothing is.
        is_lost = any(each.code in _UNKNOWN for each in result.diagnostics)
        assert is_used or is_told or is_lost, (address, cutting)
