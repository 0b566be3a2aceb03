"""Examples of rules in a control's own words: right programs with gaps, and the slips that fill the gaps wrongly.

A rule of every control names a slip, such as `size=""`; a control names its programs, such as `G01 X30. ,R{size}`.
"""

import re
from collections.abc import Mapping
from dataclasses import replace

from msgspec import Struct

from contoursolve.reading import Rule

_GAP = re.compile(r"\{(\w+)\}")
_BLANKS = re.compile(r" +(?= |$)", re.MULTILINE)
_PROGRAM = "{first}{start}{between}{contour}{behind}{tail}"
"""A program with one contour; its gaps but the start and the contour are empty in a right one."""

G_CODES: Mapping[str, str] = {
    **dict.fromkeys(("first", "between", "more", "behind", "tail", "said"), ""),
    "block": "{line} {before} {corner}{size}",
    "contour": "{block}{more}\n{turn}",
    "angled_block": "{line} {end} {angle}{degrees}",
    "vertex_blocks": "{line} {angle}{opening}\n{closing_end} {angle}{closing}",
    "arc_blocks": "{before_arc}\n{arc_code} {arc_end} {center}",
    "twice": "{line} {before} {corner}{each}\n{turn} {corner}{each}\n{after}",
    "each": "2.",
    "asked": "{line} X? {across} {corner}{size} {comment}\n{on_to}",
    "across": "Y40.",
    "level": "Y0",
    "along": "0",
    "nearly_along": "0.0000000001",
    "on_to": "X70. Y0",
    "series": "{line} X60. {corner}4.\nY30. {corner}4.\nX40. {corner}4.\nY50.{odd}\nX0. {corner}4.\nY0.",
    "odd": " {corner}4.",
    "unlike": "",
    "beside_code": "G10 X50. {corner}{size}",
    "parametrised": "O7002\n{start}{line} X#24 {corner}#18\nY40.\nX0\nM99",
    "beside": "[X20. Y30.]",
    "beyond": "[X50. Y80.]",
    "repetition": "length of line 1 = 30",
    "at_start": "X0",
    "across_end": "90.",
    "in_inches": "G20\n",
    "stated_start": "X1. Y1.",
    "closing_mark": "\n%",
    "unread": "G53.1",
    "no_word": "E135.",
    "mistyped": "R66,5",
    "element": "line 1",
    "unfinished": "{line} {angle}{opening}",
    "again": "M8\n{line} X90. {corner}5.\nY60.",
    "one_axis": "Y40.",
    "closing_on": "-45",
    "end_on": "X80 Y-80",
    "comment": "({said})",
    "variable": "#101",
    "known": "#500",
    "with_variable": "{known}={size}\n{start}{line} {before} {corner}{known}\n{turn}",
    "nowhere": "GOTO 20\n",
    "jump": "IF[#1 EQ 1]GOTO5\nG20\nN5 ",
    "place": "{start_again}",
    "steps": "G91\n{contour}",
    "call": "M98 P100",
    "subprogram": "\nM30\nO0100\n{contour}\nM99",
    "call_file": "M98 P200",
    "file_name": "O0200.nc",
    "return": "M99",
}
"""The gaps of programs in G codes, as far as controls agree."""


NO_CONTROL = {"no control is named": "control-unknown control-alike control-called"}
UNKNOWN = {"no block is known to cause it": "count-open only-unproven search-unfinished not-verified"}
AS_WRITTEN = {
    "a number without a point is as large as it says": "point-missing point-lost start-in-increments move-in-increments"
}
NO_ARGUMENTS = {"its calls hand over no numbers by letters": "argument-in-increments"}
NO_CODES = {"a contour needs no code of its own": "letter-for-digit code-mistyped"}
NO_PAIRS = {
    "no two elements meet that have no ends of their own": "point-is-start circle-missed circles-apart line-backwards "
    "arc-empty touches double",
}
NO_MEASURE = {
    "a corner is where its two lines meet, whatever they are": "corner-dropped contour-sensitive radius-differs"
}
NO_SIGNS = {"no corner is measured along an axis": "bevel-outside bevel-in-band landing-unknown corner-sign"}
NO_COMMAS = {"no word has a comma": "comma-without-address comma-missing"}
"""Reasons why controls do not meet some rules (see `OwnWords.absent`)."""


class OwnWords(Struct, frozen=True):
    """The words of a control for examples.

    `{program}` stands for a right program, and each gap of it for a text that may have gaps. A slip, of a rule or of a
    control, is what gaps have in a wrong program. `wrong` or `right` is a whole program in the place of `{program}`,
    `options` are the options of `contoursolve check` with which both are examined, and `file` is a file beside them:
    its name, and its text from the second line on.
    """

    gaps: Mapping[str, str]
    slips: Mapping[str, Mapping[str, str]] = {}
    """Slips of the control's own, by the codes of rules; they are added to what the slip of the rule says."""
    absent: Mapping[str, str] = {}
    """Codes of rules, separated by blanks, that no program of the control meets, by the reason."""

    right: Mapping[str, tuple[str, ...]] = {}
    """Further right programs, by the codes of rules: with words that no other example has."""

    def tell(self, *rules: Rule) -> tuple[Rule, ...]:
        """The rules of the control, which have examples in its words when they are asked for. A row after another one
        about the same event, that holds everywhere, is never asked for, and left out."""
        reasons = {code: reason for reason, codes in self.absent.items() for code in codes.split()}
        first = {rule.about: rule for rule in reversed(rules) if rule.about and not rule.roles}
        kept = [rule for rule in rules if rule.about is None or rule.roles or first[rule.about] is rule]
        return tuple(replace(rule, absent=reasons.get(rule.code, rule.absent), fill=self._fill) for rule in kept)

    def _fill(self, rule: Rule) -> Rule:
        told, more = self._with_slip(rule), self.right.get(rule.code, ())
        filled = (_filled(text, {**self.gaps, "program": _PROGRAM}) for text in more)
        return replace(told, accepted=(*told.accepted, *filled), fill=None)

    def _with_slip(self, rule: Rule) -> Rule:
        own = self.slips.get(rule.code, {})
        slip = {**rule.slip, **own}
        if rule.absent or (rule.rejected and not own):
            return rule
        try:
            right = _filled(slip.get("right", "{program}"), {**self.gaps, "program": slip.get("program", _PROGRAM)})
            wrong = _filled(slip.get("wrong", "{program}"), {**self.gaps, "program": _PROGRAM, **slip})
        except KeyError:  # the control has no such words: it has to say what is wrong in its own
            return rule
        return replace(
            rule,
            accepted=(right,),
            rejected=() if wrong == right and not slip.keys() & {"options", "file"} else (wrong,),
            options=_filled(slip.get("options", rule.options), self.gaps),
            file=_filled(slip.get("file", rule.file), self.gaps),
        )


def _filled(text: str, gaps: Mapping[str, str]) -> str:
    """A text without gaps. Raises KeyError for a gap that is not known."""
    while _GAP.search(text):
        text = _GAP.sub(lambda gap: gaps[gap[1]], text)
    return _BLANKS.sub("", text)
