"""HEIDENHAIN CNC PILOT 4290: contours of lines and arcs in DIN PLUS programs.

Its words and rules come in; a control goes out. Begin with `contour`.
"""

import re

from contoursolve.controls.arc_rules import arc_setting
from contoursolve.controls.cnc_pilot.contour import find
from contoursolve.controls.cnc_pilot.lexicon import BOOK, MODES, SETTINGS, SHOWS, SYNTAX
from contoursolve.controls.cnc_pilot.rules import RULES
from contoursolve.controls.control_settings import SETTINGS_OF_ALL
from contoursolve.controls.plain import LATHE
from contoursolve.gcode import words_as
from contoursolve.geometry import CornerShape
from contoursolve.reading import Control

_SHOWS = re.compile(SHOWS, re.IGNORECASE)
CNC_PILOT = Control(
    name="cnc-pilot",
    title="HEIDENHAIN CNC PILOT 4290, DIN PLUS",
    modes=MODES,
    plane=LATHE,
    forms=(),
    rules=RULES,
    find=find,
    signs=lambda block: [each for each in words_as(block, SYNTAX) if each.address == "O" and _SHOWS.match(each.text)],
    contours="lines and arcs with A, B, R, I and K, and coordinates with ?; not those of G100 to G173",
    corners=(("B", 1, CornerShape.FILLET), ("B", -1, CornerShape.CHAMFER_SETBACK)),
    has_modal_motions=False,
    settings=(*SETTINGS, arc_setting("radius-difference", BOOK.assumed("not described")), *SETTINGS_OF_ALL),
)
