"""A contour in the words of another control: lines by their ends or angles, and corners by its corner words.

A control whose blocks are lines and arcs in a row can say most contours. What it cannot say is written out as plain
moves: a corner without a word, or a whole contour that the target's own rules refuse.
"""

from collections.abc import Mapping
from decimal import Decimal
from math import cos, radians, sin

from contoursolve.controls import ChainFinder, Joining, Language
from contoursolve.diagnosis import Answer, Depth
from contoursolve.gcode import parse, spell
from contoursolve.geometry import Arc, Corner, CornerShape, Line, Profile, Unit
from contoursolve.postprocess.emit import Format, MotionBlock, emit
from contoursolve.program import Request, run
from contoursolve.reading import Dialect, Diameter, WithoutPoint
from contoursolve.solving import ArcSegment, Contour, LineSegment, Point, Segment

EXACT = 5e-9
"""mm. A coordinate that is off a number with the target's decimals by no more is that number."""

Moves = Mapping[str, tuple[MotionBlock, ...]]
"""The moves for each element of a contour, by its name."""


def language_of(target: Dialect) -> Language | None:
    """The language of a target that writes lines and arcs in a row; None for another target."""
    return target.find.language if isinstance(target.find, ChainFinder) else None


def translate(answer: Answer, target: Dialect, here: Point, form: Format, *, is_rapid: bool) -> Moves | None:
    """The moves of a solved contour in the words of a target, from where the tool really is; None if the target refuses
    it, or has no words for any of it."""
    language = language_of(target)
    if language is None or answer.contour is None:
        return None
    moves = _Translator(answer.profile, answer.contour, target, language, form, is_rapid=is_rapid).moves(here)
    has_words = any(word.startswith(tuple(language.own)) for each in moves.values() for m in each for word in m.words)
    return moves if has_words and _is_accepted(moves, answer, target, here, form) else None


class _Translator:
    def __init__(
        self, profile: Profile, contour: Contour, target: Dialect, language: Language, form: Format, *, is_rapid: bool
    ) -> None:
        self.profile = profile
        self.segments: Mapping[str, Segment] = {each.name: each for each in contour.elements}
        self.target, self.language, self.form, self.is_rapid = target, language, form, is_rapid
        self.corners = {each.before: each for each in self.profile.figure.corners if each.name in self.segments}
        facts = (fact for fact in self.profile.facts if fact.heading)
        self.angles = {fact.heading: self.profile.givens[fact.given].value for fact in facts}
        self.words = {shape: word for word, shape in language.corner.words.items()}
        figure = self.profile.figure
        self.points = {figure.path[-1].head: contour.end, **contour.points, figure.start: contour.start}
        """Where the elements begin and end, corners aside."""

    def moves(self, here: Point) -> Moves:
        """Element by element, in the order of the path."""
        found: dict[str, tuple[MotionBlock, ...]] = {}
        path = self.profile.figure.path
        is_open = False
        for number, element in enumerate(path):
            corner = self.corners.get(element.name)
            word = self._corner_word(corner) if corner else ""
            after = path[number + 1] if number + 1 < len(path) else None
            own = self._sharp(element, is_cut=corner is not None and not word)
            if own is None:
                continue
            line: tuple[str, ...] | None = None
            if isinstance(element, Line) and isinstance(own, LineSegment) and not (corner and not word):
                line, is_open = self._line_words(element, own.end, after, is_open)
            if line is not None:
                written = [MotionBlock(0 if self.is_rapid else 1, line, own.end, 0.0)]
            else:
                written = [move for move in emit(own, here, self.form, is_rapid=self.is_rapid) if move.words]
            if word and written:
                written[-1] = written[-1]._replace(words=(*written[-1].words, word))
            here = written[-1].end if written else here
            found[element.name] = tuple(written)
            if corner is not None and not word and corner.name in self.segments:
                plain = [move for move in emit(self.segments[corner.name], here, self.form) if move.words]
                here = plain[-1].end if plain else here
                found[corner.name] = tuple(plain)
        return found

    def _sharp(self, element: Line | Arc, *, is_cut: bool) -> Segment | None:
        """An element up to its virtual intersection, or where a corner that is written out cuts it."""
        start, end = self.points[element.tail], self.points[element.head]
        segment = self.segments.get(element.name)
        if is_cut and segment is not None:
            end = segment.end
        if isinstance(element, Line):
            return LineSegment(element.name, start, end) if start != end else None
        if not isinstance(segment, ArcSegment):
            return None
        return ArcSegment(element.name, start, end, segment.center, segment.radius, segment.turn)

    def _spell(self, name: str, number: str) -> str:
        """A word of the target by what it is called."""
        return spell(self.language.address_of(name), number)

    def _corner_word(self, corner: Corner) -> str:
        """The word that makes a corner; empty if the target has none."""
        shape, size = corner.shape, self.profile.givens[corner.size].value
        if corner.after is None:
            return ""
        if shape is CornerShape.CHAMFER_AXIS_45 and self._is_square(corner):
            shape = CornerShape.CHAMFER_SETBACK
        address = self.words.get(shape)
        text = self._exactly(size / self.form.unit.in_mm) if address else None
        return self._spell(address, text) if address and text is not None else ""

    def _is_square(self, corner: Corner) -> bool:
        """Whether a corner lies between two lines along the axes."""
        lines = [each for each in self.profile.figure.path if each.name in (corner.before, corner.after)]
        if not all(isinstance(each, Line) for each in lines):
            return False
        steps = [tuple(b - a for a, b in zip(self.points[e.tail], self.points[e.head], strict=True)) for e in lines]
        return all(min(map(abs, step)) <= EXACT for step in steps)

    def _line_words(self, line: Line, end: Point, after: object, is_open: bool) -> tuple[tuple[str, ...] | None, bool]:
        """The words that give a line without rounding, and whether it leaves its end open; None: its rounded end."""
        angle = self._angle(line)
        exact = [self._coordinate(axis, value) for axis, value in enumerate(end)]
        if is_open and angle is not None:
            # What closes it has both coordinates and the angle.
            return (*sorted(each or "" for each in exact), self._spell(self.language.angle.address, angle)), False
        if all(exact) or angle is None or self.form.is_incremental:
            return None, False
        way = radians(float(self.angles[line.tail, line.head]))
        for axis, other in ((0, cos(way)), (1, sin(way))):
            # A coordinate along which the line hardly advances does not tell where it ends.
            if exact[axis] and abs(other) > _STEEP:
                return (str(exact[axis]), self._spell(self.language.angle.address, angle)), False
        if self.language.meeting.joining is Joining.OPEN and isinstance(after, Line) and self._closes(after, way):
            return (self._spell(self.language.angle.address, angle),), True
        return None, False

    def _closes(self, line: Line, way: float) -> bool:
        """Whether a line has an angle and both coordinates of its end exactly, and turns off from a direction."""
        corner = self.corners.get(line.name)
        if self._angle(line) is None or (corner is not None and not self._corner_word(corner)):
            return False
        own = radians(float(self.angles[line.tail, line.head]))
        return all(self._coordinate(axis, value) for axis, value in enumerate(self.points[line.head])) and (
            abs(sin(own - way)) > _STEEP
        )

    def _angle(self, line: Line) -> str | None:
        """The angle of a line as the program states it, where the target writes angles."""
        value = self.angles.get((line.tail, line.head))
        if (
            value is None
            or self.language.address_of(self.language.angle.address) not in self.target.modes.lexicon.addresses
        ):
            return None
        return self._exactly(value, Unit.DEGREE)

    def _coordinate(self, axis: int, value: float) -> str | None:
        """A coordinate as a word, if it is a number with the target's decimals."""
        scaled = value / self.form.mm * self.form.scales[axis]
        text = self.form.number(scaled)
        off = abs(float(text) - scaled) * self.form.mm
        return self.form.plane.axes[axis] + text if off <= EXACT else None

    def _exactly(self, value: Decimal, unit: Unit = Unit.MM) -> str | None:
        """A number as the target writes it; None if it has more decimals than that."""
        numbers = self.target.modes.lexicon.numbers
        step = numbers.step(unit, self.form.unit)
        if value % step:
            return None
        text = f"{value.normalize():f}"
        if "." not in text and numbers.without_point is WithoutPoint.LEAST_INCREMENTS:
            text += "."
        return text


_STEEP = sin(radians(1.5))
"""Directions closer than this are left to the ends of the lines: controls refuse angles within 1 deg."""


def _is_accepted(moves: Moves, answer: Answer, target: Dialect, here: Point, form: Format) -> bool:
    """Whether the target reads these moves without an error."""
    names = ("G00", "G01", "G02", "G03")
    lines = [" ".join((names[move.code], *move.words)) for each in moves.values() for move in each]
    rows = target.modes.codes.values()
    unit = next(each.text for each in rows if each.unit is form.unit)
    if target.diameter is not None:
        meant = Diameter.ON if any(form.plane.diameters) else Diameter.OFF
        unit += " " + next(each.text for each in rows if each.diameter is meant)
    sense = ["G91" if form.is_incremental else "G90"] if 91 in target.modes.codes else []  # noqa: PLR2004 - its code
    side = {41: "G41", 42: "G42"}.get(answer.claim.before.compensation, "G40")
    values = (value / form.mm * scale for value, scale in zip(here, form.scales, strict=True))
    start = " ".join(axis + f"{value:.9f}" for axis, value in zip(form.plane.axes, values, strict=True))
    absolute = ["G90"] if sense else []
    head = " ".join(("G00", unit, answer.plane.code, side, *absolute, start))
    text = "\n".join([head, *sense, *lines])
    result = run(parse(text, syntax=target.modes.syntax), Request(target, form.unit, depth=Depth.VERDICT))
    return all(not each.is_error for each in result.diagnostics)
