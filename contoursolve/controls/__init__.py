"""The controls: each is a record of tables in a folder of its own.

Blocks come in, parsed contours go out, and the rules about them. Begin with a folder, or with `common` for what holds
for every control.
"""

from contoursolve.controls.common import COMMON_RULES
from contoursolve.controls.fanuc import FANUC_LATHE, FANUC_MILL, HAAS_LATHE, HAAS_MILL
from contoursolve.controls.heidenhain import HEIDENHAIN
from contoursolve.controls.isg import ISG
from contoursolve.controls.mitsubishi import MITSUBISHI
from contoursolve.controls.nct_99m import NCT_99M
from contoursolve.controls.plain import PLAIN
from contoursolve.controls.siemens import SIEMENS_808D, SIEMENS_840D
from contoursolve.controls.yasnac_lx3 import YASNAC_LX3
from contoursolve.reading.dialect import Dialect
from contoursolve.reading.follow import Finder

DIALECTS = {
    dialect.name: dialect
    for dialect in (
        YASNAC_LX3,
        NCT_99M,
        FANUC_LATHE,
        FANUC_MILL,
        HAAS_LATHE,
        HAAS_MILL,
        MITSUBISHI,
        SIEMENS_840D,
        SIEMENS_808D,
        ISG,
        HEIDENHAIN,
    )
}

__all__ = [
    "COMMON_RULES",
    "DIALECTS",
    "FANUC_LATHE",
    "FANUC_MILL",
    "HAAS_LATHE",
    "HAAS_MILL",
    "HEIDENHAIN",
    "ISG",
    "MITSUBISHI",
    "NCT_99M",
    "PLAIN",
    "SIEMENS_808D",
    "SIEMENS_840D",
    "YASNAC_LX3",
    "Dialect",
    "Finder",
]
