"""Whole programs of shops' style, for every control of the same kind of machine: an independent reader finds one path,
and the control that they are for finds no error."""

import re
from pathlib import Path

import pytest
from shop_reader import Reader, apart

import contoursolve
from contoursolve.controls import CONTROLS
from contoursolve.gcode import Word, parse_block
from contoursolve.postprocess.conversion.program_words import TABLE, cell_of, kind_of_control
from contoursolve.reading import codes_of

LATHES = ("fanuc-lathe", "haas-lathe", "siemens-840d", "isg")
MILLS = ("fanuc-mill", "haas-mill", "siemens-840d", "isg", "mitsubishi", "heidenhain")
WITHIN = 0.02  # mm; 0.002 of a path, whose length differs a little

_PARTS = re.split(r"^=== (.*), (.*)\n", (Path(__file__).parent / "shop_programs.txt").read_text(), flags=re.MULTILINE)
PROGRAMS = {name: (control, text) for name, control, text in zip(*[iter(_PARTS[1:])] * 3, strict=True)}


def kind_of(control, text):
    is_lathe = "lathe" in control or "G18" in text
    return "lathe" if is_lathe else "mill"


def pairs():
    for number, (name, (control, text)) in enumerate(PROGRAMS.items()):
        for place, to in enumerate(LATHES if kind_of(control, text) == "lathe" else MILLS):
            if to != control:
                marks = () if (number + place) % 12 == 0 else (pytest.mark.slow,)
                yield pytest.param(name, to, marks=marks)


@pytest.mark.parametrize(("name", "to"), [*pairs()])
def test_a_shop_program_is_the_same_path_on_every_other_control(name, to):
    control, text = PROGRAMS[name]
    kind = kind_of(control, text)
    settings = {f"{each}.machine": kind for each in (control, to) if each in ("siemens-840d", "isg")}
    found = contoursolve.convert(text, to, control=control, settings=settings)
    assert found.text is not None, found.comparison
    old, new = (Reader(each, kind).read(program) for each, program in ((control, text), (to, found.text)))
    off, longer = apart(old, new)
    assert off < WITHIN, (off, longer, found.text, found.not_converted)
    assert found.text.count("NOT CONVERTED") == sum(each.times for each in found.not_converted)
    own = {name: value for name, value in settings.items() if name.startswith(f"{to}.")}
    assert not [each for each in contoursolve.check(found.text, control=to, settings=own) if each.is_error], found.text


def test_there_are_thirty():
    assert len(PROGRAMS) == 30


@pytest.mark.parametrize("name", sorted({*LATHES, *MILLS}))
def test_every_word_that_is_written_is_known_to_its_own_reader(name):
    control = CONTROLS[name]
    for function in TABLE:
        cell = cell_of(function, kind_of_control(control))
        for text in cell.texts[:1] if cell is not None else ():
            block = parse_block(text.replace("{ms}", "500").replace("{}", "1"), 1, control.modes.syntax)
            assert not [each for each in codes_of(block, control.modes) if isinstance(each, Word)], (function, text)
            assert cell.source.place
