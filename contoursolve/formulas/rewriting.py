"""How a program is rewritten whose contours become formulas: what `postprocess.rewrite` takes for that."""

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from msgspec import Struct

from contoursolve.controls import HAAS_MILL, HEIDENHAIN, SIEMENS_840D
from contoursolve.diagnosis.examine import Policy
from contoursolve.formulas.expander import FormulaExpander
from contoursolve.formulas.lines import FormulaLines
from contoursolve.formulas.scratch import Scratch, read_scratch
from contoursolve.formulas.targets import TARGETS, MacroTarget
from contoursolve.postprocess.post_processors import POSTS, Post, find_post, post_of
from contoursolve.reading.dialect import Dialect

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
        return FormulaLines(*args, lets=self.lets, **options)

    def expander(self, *args: Any) -> FormulaExpander:
        """The pass over a program."""
        return FormulaExpander(
            *args, target=self.target, scratch=self.scratch, policy=self.policy, taken=self.taken, label=self.label
        )


POSTS_OF_FORMULAS = {"haas": HAAS_MILL, "sinumerik": SIEMENS_840D, "klartext": HEIDENHAIN}
"""Controls for which there is no other plain program than in their own words."""


def post_of_formulas(post: str | Post, dialect: Dialect | None) -> tuple[str, Post]:
    """The language of formulas for a target, and how it writes a program: for the program's own control, the language
    of that. Raises ValueError, which lists the choices."""
    name = post.name if isinstance(post, Post) else post
    if name in POSTS_OF_FORMULAS:
        return name, replace(post_of(POSTS_OF_FORMULAS[name]), target=None)
    own = dialect.name.partition("-")[0] if dialect is not None else ""
    language = {"haas": "haas", "siemens": "sinumerik", "heidenhain": "klartext"}.get(own, "fanuc")
    if name not in (*POSTS, *POSTS_OF_FORMULAS):
        raise ValueError(f"unknown post {name!r}; choose from {', '.join((*POSTS, *POSTS_OF_FORMULAS))}")
    return (language if name == "same" else name), find_post(post)


def formulas_for(text: str, target: str, scratch: str | None, lets: Mapping[str, float], policy: Policy) -> Formulas:
    """The formulas of a program in the language of a target. Raises ValueError for a range of variables that is none."""
    own = TARGETS[target]
    used = frozenset(re.sub(r"\s+", "", each).upper() for each in _VARIABLES.findall(text))
    numbers = [int(each) for each in _LABELS.findall(text)]
    label = max([_FIRST_LABEL, *(number + 1 for number in numbers if number >= _FIRST_LABEL)])
    return Formulas(own, read_scratch(scratch or own.scratch), lets, policy, used, label)
