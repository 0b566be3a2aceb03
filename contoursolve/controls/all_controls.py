"""All controls, by name."""

from contoursolve.controls.fanuc import FANUC_LATHE, FANUC_MILL, HAAS_LATHE, HAAS_MILL
from contoursolve.controls.heidenhain import HEIDENHAIN
from contoursolve.controls.isg import ISG
from contoursolve.controls.mitsubishi import MITSUBISHI
from contoursolve.controls.nct_99m import NCT_99M
from contoursolve.controls.siemens import SIEMENS_808D, SIEMENS_840D
from contoursolve.controls.yasnac_lx3 import YASNAC_LX3

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
