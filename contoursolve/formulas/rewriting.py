"""How a program is rewritten whose contours become formulas: what `postprocess.rewrite` takes for that."""

import re
from collections.abc import Mapping
from typing import Any

from msgspec import Struct

from contoursolve.diagnosis.examine import Policy
from contoursolve.execution.fanuc import fanuc
from contoursolve.formulas.expander import FormulaExpander
from contoursolve.formulas.lines import FormulaLines
from contoursolve.formulas.scratch import Scratch, read_scratch
from contoursolve.formulas.targets import TARGETS, MacroTarget

_LABELS = re.compile(r"(?:\b[NO]|\bLBL\s+)\s*(\d{1,8})", re.IGNORECASE)
_VARIABLES = re.compile(r"[#RQ]\s*\d{1,5}", re.IGNORECASE)
_FIRST_LABEL = 9001


class Formulas(Struct, frozen=True, eq=False):
    """A target, the variables that may be used, the values of others for example, and what the program uses itself."""

    target: MacroTarget
    scratch: Scratch
    lets: Mapping[str, float]
    policy: Policy
    taken: frozenset[str]
    label: int

    def lines(self, *args: Any, **options: Any) -> FormulaLines:
        """The lines of a program on their way."""
        return FormulaLines(*args, language=fanuc(), lets=self.lets, **options)

    def expander(self, *args: Any) -> FormulaExpander:
        """The pass over a program."""
        return FormulaExpander(
            *args, target=self.target, scratch=self.scratch, policy=self.policy, taken=self.taken, label=self.label
        )


def formulas_for(text: str, target: str, scratch: str | None, lets: Mapping[str, float], policy: Policy) -> Formulas:
    """The formulas of a program in the language of a target. Raises ValueError for a range of variables that is none."""
    own = TARGETS[target]
    used = frozenset(re.sub(r"\s+", "", each).upper() for each in _VARIABLES.findall(text))
    numbers = [int(each) for each in _LABELS.findall(text)]
    label = max([_FIRST_LABEL, *(number + 1 for number in numbers if number >= _FIRST_LABEL)])
    return Formulas(own, read_scratch(scratch or own.scratch), lets, policy, used, label)
