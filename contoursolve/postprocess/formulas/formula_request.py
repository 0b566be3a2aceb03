"""Request for formulas: the parts that `postprocess.rewrite` takes for a program whose contours become formulas."""

import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from msgspec import Struct

from contoursolve.controls import HAAS_MILL, HEIDENHAIN, SIEMENS_840D
from contoursolve.diagnosis import Policy
from contoursolve.postprocess.formulas.formula_expander import FormulaExpander
from contoursolve.postprocess.formulas.formula_lines import FormulaLines
from contoursolve.postprocess.formulas.macro_targets import TARGETS
from contoursolve.postprocess.formulas.scratch_variables import NoFormulasError, Scratch, read_scratch
from contoursolve.postprocess.post_processors import POSTS, Post, find_post, post_of
from contoursolve.reading import Control

_LABELS = re.compile(r"(?:\b[NO]|\bLBL\s+)\s*(\d{1,8})", re.IGNORECASE)
_VARIABLES = re.compile(r"[#RQ]\s*\d{1,5}", re.IGNORECASE)
_FIRST_LABEL = 9001

_FURTHER = {"haas": HAAS_MILL, "sinumerik": SIEMENS_840D, "klartext": HEIDENHAIN}
"""Controls that contours are written for in their own words alone, but for formulas."""

POST_NAMES = (*POSTS, *_FURTHER)
"""Targets of formulas."""


class FormulaRequest(Struct, frozen=True, eq=False):
    """A target by its name, the variables that may be used, if they are named, the values of others for example, and
    what the program uses itself."""

    target: str
    scratch: Scratch | None
    lets: Mapping[str, float]
    policy: Policy
    taken: frozenset[str]
    label: int

    def lines(self, *args: Any, **options: Any) -> FormulaLines:
        """The lines of a program on their way."""
        return FormulaLines(*args, lets=self.lets, **options)

    def expander(self, *args: Any) -> FormulaExpander:
        """The pass over a program."""
        control: Control = args[0]
        own = {"haas": "haas", "siemens": "sinumerik", "heidenhain": "klartext"}
        name = own.get(control.name.partition("-")[0], "fanuc") if self.target == "same" else self.target
        scratch = self.scratch or read_scratch(TARGETS[name].scratch)
        return FormulaExpander(
            *args,
            target=TARGETS[name],
            scratch=scratch,
            policy=self.policy,
            taken=self.taken,
            label=self.label,
        )


def post_of_formulas(post: str | Post) -> Post:
    """The target of this name for formulas. Raises ValueError, which lists the choices."""
    if isinstance(post, Post) or post in POSTS:
        return find_post(post)
    if post not in _FURTHER:
        raise ValueError(f"unknown post {post!r}; choose from {', '.join(POST_NAMES)}")
    return replace(post_of(_FURTHER[post]), name=post)


def formulas_for(
    text: str, post: Post, scratch: str | None, lets: Mapping[str, float], policy: Policy
) -> FormulaRequest:
    """The formulas of a program for a target. Raises NoFormulasError for a range of variables that is none."""
    used = frozenset(re.sub(r"\s+", "", each).upper() for each in _VARIABLES.findall(text))
    numbers = [int(each) for each in _LABELS.findall(text)]
    label = max([_FIRST_LABEL, *(number + 1 for number in numbers if number >= _FIRST_LABEL)])
    if post.name not in ("same", *TARGETS):
        raise NoFormulasError(f"{post.title} has no formulas; choose from {', '.join(POST_NAMES)}")
    return FormulaRequest(post.name, read_scratch(scratch) if scratch else None, lets, policy, used, label)
