"""SINUMERIK 840D sl, 828D, ONE and 808D: ANG, RND, CHR, CHF, RNDM and CT in lines and arcs in a row.

Their words, language and rules come in; two controls go out. Begin with `language`.
"""

from dataclasses import replace
from functools import partial
from typing import cast

from contoursolve.controls.arc_facts import reading_arcs
from contoursolve.controls.chain import ChainFinder, forms_of
from contoursolve.controls.control_settings import SETTINGS_OF_ALL
from contoursolve.controls.plain import PLANES
from contoursolve.controls.siemens.language import (
    LANGUAGE,
    LANGUAGE_808D,
    RAPID_CORNER_808D,
    RAPID_CORNER_840D,
    SECOND_MOVE_808D,
    SECOND_MOVE_840D,
    SETTINGS,
)
from contoursolve.controls.siemens.lexicon import AXIAL_MODES, BOOK, MODES, SYNTAX, statements
from contoursolve.controls.siemens.rules import RULES, RULES_REDUCING
from contoursolve.execution import MacroLanguage
from contoursolve.gcode import Block, Word, words_as
from contoursolve.reading import Control, Diameter, Setting

_OWN = LANGUAGE.own


def _signs(block: Block) -> tuple[Word, ...]:
    """The words that show the control: those with an equals sign."""
    if "=" not in block.text:
        return ()
    own = (word for word in words_as(block, SYNTAX) if word.address in _OWN)
    # `#ANG=60` is another control's.
    return tuple(word for word in own if not block.text[: word.span.column - 1].rstrip(" \t").endswith("#"))


_LARGE = {
    "error": "it is refused, with an alarm",
    "reduce": "the control makes it smaller by itself, to a size that no page tells; contoursolve refuses it",
}


def _too_big(default: str) -> Setting:
    """The outcome of a corner that does not fit."""
    other = {"error": RULES, "reduce": RULES_REDUCING}
    changes = {value: partial(replace, rules=rules) for value, rules in other.items()}
    source = BOOK.printed("808D") if default == "reduce" else BOOK.assumed("840D: not described")
    return Setting("too-big", "a corner that does not fit", _LARGE, default, source, changes=changes)


def _main_def(default: str) -> Setting:
    """The scope of what the main program defines."""

    def change(control: Control, *, shows_main: bool) -> Control:
        made_by = cast("partial[MacroLanguage]", cast("MacroLanguage", control.modes.language).made_by)
        language = made_by.func(*made_by.args, shows_main=shows_main)
        return replace(control, modes=replace(control.modes, language=language))

    values = {
        "program": "in the main program and in all that it calls",
        "local": "in the main program alone",
    }
    changes = {value: partial(change, shows_main=value == "program") for value in values}
    source = BOOK.printed("turning 01/2017 p. 126" if default == "local" else "job planning 07/2010 p. 23")
    return Setting(
        "main-def", "where a variable is known that the main program defines", values, default, source, changes=changes
    )


_840D = Control(
    name="siemens-840d",
    title="SINUMERIK 840D sl, 828D and ONE",
    modes=AXIAL_MODES,
    plane=PLANES[17],
    forms=forms_of(LANGUAGE, AXIAL_MODES),
    rules=RULES,
    find=ChainFinder(LANGUAGE),
    signs=_signs,
    contours="lines with ANG=, corners with RND=, CHR= or CHF=, and CT",
    settings=(
        *SETTINGS,
        RAPID_CORNER_840D,
        SECOND_MOVE_840D,
        _too_big("error"),
        _main_def("program"),
        *SETTINGS_OF_ALL,
    ),
    motion=1,
    diameter=Diameter.BY_PLANE,
)
_808D = replace(
    _840D,
    name="siemens-808d",
    title="SINUMERIK 808D",
    # A lexicon of its own tells for which control words were read.
    modes=replace(MODES, lexicon=replace(MODES.lexicon), language=statements(shows_main=False)),
    rules=RULES_REDUCING,
    find=ChainFinder(LANGUAGE_808D),
    settings=(*SETTINGS, RAPID_CORNER_808D, SECOND_MOVE_808D, _too_big("reduce"), _main_def("local"), *SETTINGS_OF_ALL),
    # Nothing in a program tells it from its larger sibling.
    rare=LANGUAGE.own,
)
SIEMENS_840D, SIEMENS_808D = reading_arcs(_840D), reading_arcs(_808D)
