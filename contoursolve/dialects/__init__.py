"""The controls: each is a record of tables."""

from contoursolve.dialects.common import COMMON_RULES
from contoursolve.dialects.dialect import Dialect, Finder
from contoursolve.dialects.nct_99m import NCT_99M
from contoursolve.dialects.plain import PLAIN
from contoursolve.dialects.yasnac_lx3 import YASNAC_LX3

DIALECTS = {dialect.name: dialect for dialect in (YASNAC_LX3, NCT_99M)}

__all__ = [
    "COMMON_RULES",
    "DIALECTS",
    "NCT_99M",
    "PLAIN",
    "YASNAC_LX3",
    "Dialect",
    "Finder",
]
