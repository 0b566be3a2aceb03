"""HEIDENHAIN TNC: free contour programming FK in Klartext programs.

Its words, elements and rules come in; a control goes out. Begin with `elements`.
"""

from contoursolve.controls.arc_facts import reading_arcs
from contoursolve.controls.control_settings import SETTINGS_OF_ALL
from contoursolve.controls.heidenhain.arcs import arc_of, suspected
from contoursolve.controls.heidenhain.examples import WORDS
from contoursolve.controls.heidenhain.find import find
from contoursolve.controls.heidenhain.follow import ZERO, follow
from contoursolve.controls.heidenhain.lexicon import CODES, LEXICON, SETTINGS, SYNTAX, shown_by
from contoursolve.controls.heidenhain.rules import RULES
from contoursolve.controls.heidenhain.writer import WRITING
from contoursolve.controls.plain import PLANES
from contoursolve.execution import klartext
from contoursolve.reading import Control, Modes

_HEIDENHAIN = Control(
    name="heidenhain",
    title="HEIDENHAIN TNC, Klartext with free contours FK",
    modes=Modes(
        LEXICON,
        CODES,
        ("X", "Y", "Z"),
        frozenset(),
        syntax=SYNTAX,
        follow=follow,
        language=klartext(),
        zero=ZERO,
    ),
    plane=PLANES[17],
    forms=(),
    rules=WORDS.tell(*RULES),
    find=find,
    signs=shown_by,
    contours="free contours with FL, FLT, FC and FCT; moves with RND, CHF or CT",
    settings=(*SETTINGS, *SETTINGS_OF_ALL),
    writing=WRITING,
)
HEIDENHAIN = reading_arcs(_HEIDENHAIN, read=arc_of, suspects=suspected)
