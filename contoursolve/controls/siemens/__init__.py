"""SINUMERIK 840D sl, 828D, ONE and 808D: ANG, RND, CHR, CHF, RNDM and CT in lines and arcs in a row.

Their words, language and rules come in; two controls go out. Begin with `language`.
"""

from dataclasses import replace
from functools import partial

from contoursolve.controls.chain import ChainFinder, forms_of
from contoursolve.controls.control_settings import SETTINGS_OF_ALL
from contoursolve.controls.plain import PLANES
from contoursolve.controls.siemens.language import LANGUAGE, SETTINGS
from contoursolve.controls.siemens.lexicon import BOOK, MODES, SYNTAX
from contoursolve.controls.siemens.rules import RULES, RULES_REDUCING
from contoursolve.gcode import Block, Word, words_as
from contoursolve.reading import Dialect, Diameter, Setting

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


SIEMENS_840D = Dialect(
    name="siemens-840d",
    title="SINUMERIK 840D sl, 828D and ONE",
    modes=MODES,
    plane=PLANES[17],
    forms=forms_of(LANGUAGE, MODES),
    rules=RULES,
    find=ChainFinder(LANGUAGE),
    signs=_signs,
    contours="lines with ANG=, corners with RND=, CHR= or CHF=, and CT",
    settings=(*SETTINGS, _too_big("error"), *SETTINGS_OF_ALL),
    motion=1,
    diameter=Diameter.BY_PLANE,
)
SIEMENS_808D = replace(
    SIEMENS_840D,
    name="siemens-808d",
    title="SINUMERIK 808D",
    # A lexicon of its own tells for which control words were read.
    modes=replace(MODES, lexicon=replace(MODES.lexicon)),
    rules=RULES_REDUCING,
    settings=(*SETTINGS, _too_big("reduce"), *SETTINGS_OF_ALL),
    # Nothing in a program tells it from its larger sibling.
    rare=LANGUAGE.own,
)
