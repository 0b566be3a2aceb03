"""Each kind of slip undoes its own example: what is typed becomes what is meant."""

import pytest

from contoursolve.controls import CONTROLS
from contoursolve.diagnosis.edits import apply_edits
from contoursolve.diagnosis.slip_kinds import FEW, OF_DIGITS
from contoursolve.diagnosis.slips_around import Marked, drafts_around
from contoursolve.diagnosis.slips_of_blocks import SEVERAL, Near
from contoursolve.diagnosis.window import Window
from contoursolve.gcode import parse_block
from contoursolve.geometry import Length
from contoursolve.reading import ParsedContour

OF_WORDS = {each.name: each for each in (*FEW, *OF_DIGITS)}
OF_BLOCKS = {each.slip.name: each for each in SEVERAL}


def cases_of(example):
    """The blocks of an example on each control, with the state before them, and what is meant."""
    typed, meant = example.split(" for ")
    for control in CONTROLS.values():
        blocks = tuple(parse_block(text, at, control.modes.syntax) for at, text in enumerate(typed.split("|"), 1))
        state = control.initial_state(Length.MM)
        ahead = ((blocks[:1], state),) if len(blocks) > 3 else ()
        yield Window(ahead, blocks[len(ahead) :], (), state, control, lambda *_: ()), meant


def edited(window, edits):
    """The blocks with edits, as an example has them."""
    lines = "\n".join(apply_edits(window.blocks, edits)).split("\n")
    return "|".join(filter(None, lines))


@pytest.mark.parametrize("name", OF_WORDS)
def test_a_kind_of_word_undoes_its_example(name):
    kind, undone = OF_WORDS[name], []
    for window, meant in cases_of(kind.example):
        found = window.control.find(window.own, 0, window.state, window.control.modes)
        claim = found if isinstance(found, ParsedContour) else None
        marked = Marked(frozenset(word.span for block in window.own for word in block.words), frozenset(window.lines))
        drafts = [each for each in drafts_around(window, marked, claim, [kind]) if each.slips == (kind,)]
        undone.append(meant in [edited(window, each.edits) for each in drafts])
    assert any(undone)


@pytest.mark.parametrize("name", OF_BLOCKS)
def test_a_kind_of_several_words_undoes_its_example(name):
    kind = OF_BLOCKS[name]
    cases = cases_of(kind.slip.example)
    assert any(
        meant in [edited(window, edits) for edits in kind.edits(Near(window, window.blocks))] for window, meant in cases
    )
