"""Fanuc and Haas lathes and mills: `,A ,C ,R` in lines and arcs in a row.

Their words, languages and rules come in; four controls go out. Begin with `language`.
"""

from functools import partial

from contoursolve.controls.arc_facts import reading_arcs
from contoursolve.controls.chain import ChainFinder, Language, forms_of
from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.control_settings import SETTINGS_OF_ALL
from contoursolve.controls.fanuc.examples import FANUC_LATHE_WORDS, FANUC_MILL_WORDS, HAAS_LATHE_WORDS, HAAS_MILL_WORDS
from contoursolve.controls.fanuc.language import (
    FANUC_LATHE_LANGUAGE,
    FANUC_MILL_LANGUAGE,
    HAAS_LATHE_LANGUAGE,
    HAAS_LATHE_SETTINGS,
    HAAS_MILL_LANGUAGE,
    HAAS_MILL_SETTINGS,
    LATHE_SETTINGS,
    MILL_SETTINGS,
)
from contoursolve.controls.fanuc.lexicon import HAAS_LATHE_MODES, HAAS_MILL_MODES, LATHE_MODES, MILL_MODES
from contoursolve.controls.fanuc.rules import (
    FANUC_LATHE_RULES,
    FANUC_MILL_RULES,
    HAAS_LATHE_RULES,
    HAAS_MILL_RULES,
)
from contoursolve.controls.own_words import OwnWords
from contoursolve.controls.plain import LATHE, PLANES
from contoursolve.gcode import Block, Word
from contoursolve.reading import Control, Modes, Rule, Setting


def _signs(own: frozenset[str], block: Block) -> tuple[Word, ...]:
    """The words that show a control: those with a comma that it has."""
    if "," not in block.text:
        return ()
    return tuple(word for word in block.words if word.address in own)


def _control(
    name: str,
    title: str,
    modes: Modes,
    language: Language,
    words: OwnWords,
    rules: tuple[Rule, ...],
    settings: tuple[Setting, ...],
    contours: str,
) -> Control:
    control = Control(
        name=name,
        title=title,
        modes=modes,
        plane=LATHE if name.endswith("lathe") else PLANES[17],
        forms=forms_of(language, modes),
        rules=words.tell(*COMMON_RULES, *rules),
        find=ChainFinder(language),
        signs=partial(_signs, frozenset(each for each in modes.lexicon.addresses if each.startswith(","))),
        contours=contours,
        settings=(*settings, *SETTINGS_OF_ALL),
    )
    return reading_arcs(control)


FANUC_LATHE = _control(
    "fanuc-lathe",
    "Fanuc lathes, G-code system A",
    LATHE_MODES,
    FANUC_LATHE_LANGUAGE,
    FANUC_LATHE_WORDS,
    FANUC_LATHE_RULES,
    LATHE_SETTINGS,
    "lines with ,A ,C or ,R",
)
FANUC_MILL = _control(
    "fanuc-mill",
    "Fanuc mills",
    MILL_MODES,
    FANUC_MILL_LANGUAGE,
    FANUC_MILL_WORDS,
    FANUC_MILL_RULES,
    MILL_SETTINGS,
    "lines and arcs with ,C or ,R",
)
HAAS_LATHE = _control(
    "haas-lathe",
    "Haas lathes",
    HAAS_LATHE_MODES,
    HAAS_LATHE_LANGUAGE,
    HAAS_LATHE_WORDS,
    HAAS_LATHE_RULES,
    HAAS_LATHE_SETTINGS,
    "lines with A, and lines with ,C or ,R",
)
HAAS_MILL = _control(
    "haas-mill",
    "Haas mills",
    HAAS_MILL_MODES,
    HAAS_MILL_LANGUAGE,
    HAAS_MILL_WORDS,
    HAAS_MILL_RULES,
    HAAS_MILL_SETTINGS,
    "lines with ,C or ,R",
)
