"""Formulas run by LinuxCNC's interpreter at random values: the path is ours, and it stops where we refuse."""

import re
from cmath import phase
from collections import defaultdict
from collections.abc import Sequence
from functools import cache
from itertools import accumulate
from random import Random
from typing import NamedTuple

import pytest
from interpreter import Motion, assert_path, interpret_rows
from macros import motions_of, run_macros
from test_interpreted import Drawing, drawings

import contoursolve
from contoursolve.controls import CONTROLS
from contoursolve.diagnosis.examine import Depth
from contoursolve.gcode import parse
from contoursolve.program.pipeline import run
from contoursolve.program.request import Request
from contoursolve.solving import NoteKind
from contoursolve.solving.contour import ArcSegment, Contour

VALUES = 500
"""Of every form."""
LONGEST_MESSAGE = 26
"""Characters that a Fanuc control shows."""
LONGEST_LINE, MOST_BRACKETS = 80, 5
"""Characters of a block, and brackets in brackets."""
PROGRAMS = 10
"""Of every form; each with several values."""
INCREMENT, OFF = 0.001, 0.01
"""mm or inch. The increment, and how far the ends of an arc may be off its circle."""
FORMS = {
    "G111": ("G111",),
    "G112 turning": ("G112 turning",),
    "G112 facing": ("G112 facing",),
    "G11, G12, G01 with I or K": ("G11", "G12", "G01"),
    "line-line": ("line-line",),
    "line-circle": ("line-circle",),
    "circle-line": ("circle-line",),
    "circle-circle": ("circle-circle",),
    "chains of 3 and 4": ("chain of 3", "chain of 4"),
    "chains of 5 and 6": ("chain of 5", "chain of 6"),
    "16.1": ("16.1",),
    "16.2": ("16.2",),
}
"""What shows each form."""

_WORD = re.compile(r"(?<![\w#,])(,?[A-FI-KPQRUWXYZD])(-?\d+\.\d+)")


class Family(NamedTuple):
    """A program with variables, the numbers that it was drawn with, and its formulas."""

    drawing: Drawing
    text: str
    values: dict[str, float]
    formulas: str

    def typed(self, values: dict[str, float]) -> str:
        """The program with numbers."""
        return re.sub(r"#\d+", lambda found: f"{values[found[0]]:.6f}", self.text)


def with_variables(rng: Random, drawing: Drawing) -> tuple[str, dict[str, float]]:
    """A drawn program with variables in some of its words."""
    lines = drawing.text.splitlines()
    words = [(number, word) for number, line in enumerate(lines) if number for word in _WORD.finditer(line)]
    chosen = sorted(rng.sample(words, rng.randint(1, 3)), key=lambda each: (each[0], each[1].start()), reverse=True)
    values = {}
    for count, (number, word) in enumerate(chosen, 100):
        values[f"#{count}"] = round(float(word[2]), 6)
        lines[number] = f"{lines[number][: word.start(2)]}#{count}{lines[number][word.end(2) :]}"
    return "\n".join(lines) + "\n", values


def another(rng: Random, value: float) -> float:
    """A value near another one, or of another kind."""
    near = value * rng.gauss(1, 0.1), value + rng.gauss(0, 3)
    return round(rng.choice((*near, *near, *near, -value, 0.0, float(round(value)), rng.uniform(-200, 200))), 3)


@cache
def families(form: str) -> list[Family]:
    """Programs of a form with variables."""
    rng, found = Random(form), []
    own = [each for each in drawings() if each.shows & {*FORMS[form]}]
    for drawing in rng.sample(own, min(PROGRAMS, len(own))):
        text, values = with_variables(rng, drawing)
        expansion = contoursolve.expand(
            text, post="linuxcnc", control=drawing.control, formulas=True, variables=values, scratch="#140-#400"
        )
        assert expansion.text is not None, (text, values, expansion.summary.left)
        # LinuxCNC has no compensation in G19, and says so; with D0, it changes nothing.
        formulas = re.sub(r"G4[12] |D0", "", expansion.text) if drawing.plane == 19 else expansion.text
        found.append(Family(drawing, text, values, formulas))
    return found


def solved(family: Family, values: dict[str, float]) -> tuple[list[Contour], bool, bool]:
    """The contours that a single solve of each makes, whether one is refused, and whether the ends of an arc are off
    its circle by as much as the control allows."""
    asked = Request(CONTROLS[family.drawing.control], depth=Depth.VERDICT)
    result = run(parse(family.typed(values)), asked)
    found: list[Contour] = []
    is_off = any(each.about is NoteKind.RADIUS_DIFFERS for each in result.diagnostics)
    for answer in result.answers:
        is_refused = any(each.severity.value == "error" for each in answer.diagnostics)
        if is_refused or answer.contour is None:
            return found, True, is_off
        found.append(answer.contour)
    return found, not found, is_off


def is_nothing(motion: Motion) -> bool:
    """Whether a motion is so short that it may be left out; a full turn is not."""
    if abs(motion.end - motion.start) > 3 * INCREMENT or motion.center is None:
        return abs(motion.end - motion.start) <= 3 * INCREMENT
    sign = 1 if motion.kind == "ccw" else -1
    return sign * phase((motion.end - motion.center) / (motion.start - motion.center)) > 0


def elements_of(contours: Sequence[Contour], unit: float) -> list[tuple]:
    found = []
    for contour in contours:
        for each in contour.elements:
            arc = each if isinstance(each, ArcSegment) else None
            places = (each.start, each.end, arc.center if arc else None)
            start, end, center = (complex(*place) / unit if place else None for place in places)
            found.append((start, end, center, arc.turn.value if arc else ""))
    return found


@pytest.mark.interpreter
@pytest.mark.slow
@pytest.mark.parametrize("form", FORMS)
def test_the_interpreter_runs_formulas_as_we_solve(form, tmp_path):
    rng, own = Random(f"values {form}"), families(form)
    rows = [
        (family, {name: another(rng, value) if count else value for name, value in family.values.items()})
        for family in own
        for count in range(-(-VALUES // len(own)))
    ]
    runs = interpret_rows([(family.formulas, values) for family, values in rows], tmp_path)
    seen = defaultdict(int)
    for (family, values), (motions, is_stopped) in zip(rows, runs, strict=True):
        contours, is_refused, is_off = solved(family, values)
        assert is_stopped == is_refused, (family.text, values, family.formulas)
        unit = 25.4 if "G20" in family.text else 1.0
        # An element that is shorter than that need not be written.
        cut = [each for each in motions if each.kind != "traverse" and not is_nothing(each)]
        assert_path(cut, elements_of(contours, unit), OFF if is_off else INCREMENT)
        seen[is_refused] += 1
    assert len(rows) >= VALUES
    # Of the seeds here, 52 of 504 at the least.
    assert min(seen[True], seen[False]) >= VALUES // 10, dict(seen)


def nested(line: str) -> int:
    """How many brackets of a line lie in each other."""
    depths = accumulate((sign == "[") - (sign == "]") for sign in line)
    return max(depths, default=0)


LANGUAGES = {"fanuc": "#140-#400", "haas": "#140-#400", "sinumerik": "R140-R400", "klartext": "Q240-Q500"}


@pytest.mark.slow
@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_written_for_other_controls_does_the_same(language):
    rng, seen = Random(language), defaultdict(int)
    for form in FORMS:
        for family in families(form)[:1]:
            drawing = family.drawing
            if "G91" in drawing.shows or drawing.shows & {"G11", "G12", "G01"}:
                continue  # of several contours, or increments
            expansion = contoursolve.expand(
                family.text,
                post=language,
                control=drawing.control,
                formulas=True,
                variables=family.values,
                scratch=LANGUAGES[language],
                keep_going=True,
                keep_untranslated=True,
            )
            assert expansion.text is not None
            written = [line for line in expansion.text.splitlines() if line[:1] not in "(;" and line not in family.text]
            most = LONGEST_LINE + 20 * (language == "klartext")
            assert max(map(len, written)) < most, max(written, key=len)
            assert max(map(nested, written)) <= MOST_BRACKETS
            for _ in range(VALUES // 60):
                values = {name: another(rng, value) for name, value in family.values.items()}
                contours, is_refused, is_off = solved(family, values)
                prefix = {"sinumerik": "R", "klartext": "Q"}.get(language, "#")
                own = {prefix + name[1:]: value for name, value in values.items()}
                done = run_macros(expansion.text, {**own, **values})
                assert bool(done.message) == is_refused, (family.text, values, done.message)
                assert len(done.message) <= LONGEST_MESSAGE
                seen[is_refused] += 1
                if is_refused:
                    continue
                unit = 25.4 if "G20" in family.text else 1.0
                plane = contours[0].plane
                scales = tuple(2.0 if is_diameter else 1.0 for is_diameter in plane.diameters)
                start = complex(*contours[0].start) / unit
                motions = motions_of(done, start, "".join(plane.axes), scales)
                assert_path(list(motions), elements_of(contours, unit), OFF if is_off else INCREMENT)
    # Of the seeds here, 19 of 48 at the least.
    assert min(seen[True], seen[False]) >= 15, dict(seen)
