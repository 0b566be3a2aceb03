"""The system of equations of a drawing that is no program: its facts are the words."""

from collections.abc import Iterable
from dataclasses import dataclass

from contoursolve.controls import DRAWINGS
from contoursolve.diagnosis import Edit, EquationSystem
from contoursolve.geometry import Profile
from contoursolve.reading import ContourBuilder, ContourForm, Control, Outline, ParsedContour, WordTable
from contoursolve.solving import Sketch

_FORM = ContourForm("sketch", "sketch", (), Outline("", (), (), (), (), (), ()), frozenset(), WordTable(()))


def sketch_system(sketch: Sketch) -> EquationSystem:
    """The equations of a sketch; raises GrammarError or StatementError as its `profile`."""
    reading = _SketchReading(sketch)
    claim = reading.claim()
    return EquationSystem(claim, reading.profile(claim, frozenset()), reading)


@dataclass(slots=True)
class _SketchReading:
    """A sketch, read with other values or fewer of its facts; its coordinates are those of a milled drawing."""

    sketch: Sketch

    @property
    def control(self) -> Control:
        """The control of a milled drawing."""
        return DRAWINGS["milled"]

    def claim(self) -> ParsedContour:
        """The facts of the sketch as the words of a contour without blocks."""
        profile, build = self.sketch.profile(), ContourBuilder(self.control.modes)
        words = {name: given.word for name, given in profile.givens.items() if given.word is not None}
        build.state("", words, profile.givens)
        here = self.control.initial_state(profile.unit)
        return build.build(_FORM, here, here)

    def read(self, claim: ParsedContour, edits: Iterable[Edit]) -> ParsedContour:
        """The facts with other values."""
        texts = {edit.span: edit.text for edit in edits}
        changed = {name: texts[word.span] for name, word in claim.words.items() if word.span in texts}
        return _SketchReading(self.sketch.with_facts({**self._facts(claim), **changed})).claim()

    def profile(self, claim: ParsedContour, without: frozenset[str]) -> Profile:
        """The drawing without what some facts state."""
        facts = self._facts(claim)
        return self.sketch.with_facts({name: facts[name] for name in facts if name not in without}).profile()

    part = profile

    def _facts(self, claim: ParsedContour) -> dict[str, str]:
        """All facts of the sketch, those with a value as the claim has them."""
        return {name: str(fact) for name, fact in self.sketch.facts.items()} | {
            name: word.text for name, word in claim.words.items()
        }
