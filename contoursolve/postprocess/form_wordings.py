"""The words of a control whose contours are blocks of their own forms: every set that the rules of a form allow."""

from collections.abc import Iterator, Sequence
from itertools import islice, product

from msgspec.structs import replace

from contoursolve.diagnosis import legal_samples
from contoursolve.geometry import Arc, Line
from contoursolve.postprocess.contour_drawing import DrawnElement, size_as
from contoursolve.postprocess.wordings import CornerWay, GCodeSpeller, Wording, WrittenBlock, WrittenWord
from contoursolve.reading import ContourForm, Control, check, stated_sets
from contoursolve.solving import LineSegment


class FormWordings(GCodeSpeller):
    """The words of a control's forms for elements of a contour."""

    def special(self, index: int, *, is_cut: bool) -> Iterator[Wording]:
        for form, names in _uses(self.control):
            path = form.outline.path
            row = self.drawn.elements[index : index + len(path)]
            if [isinstance(each, Line) for each in path] == [isinstance(each.segment, LineSegment) for each in row]:
                for ways in product(*(self._ways(form, *each) for each in zip(path, row, strict=True))):
                    values = self.laid(form, row, self.begin(index, is_cut=is_cut), ways)
                    if names <= values.keys() and not any(way.behind for way in ways[:-1]):
                        words = [self.word(name, *values[name]) for name in sorted(names)]
                        words += [word for way in ways for word in way.words]
                        found = self._stated(form, tuple(words), len(row), ways[-1])
                        yield from (replace(each, is_cut=row[-1].corner is not None) for each in found)

    def _ways(self, form: ContourForm, line: Line | Arc, element: DrawnElement) -> Iterator[CornerWay]:
        """The ways in which a form makes the corner behind an element: by its words (none where another one makes it),
        or else as a block of its own."""
        shapes = [row.shapes for row in form.outline.corners if row.before == line.name]
        sizes = [(word, size_as(shape, element)) for each in shapes for word, shape in each.items()]
        said = [(word, size) for word, size in sizes if size is not None]
        for word, size in said:
            words = (self.word(word, size),) if word in self.lexicon.addresses else ()
            yield CornerWay(words, element.segment.end)
        yield from () if said else islice(self.corners(element), 1)

    def _stated(
        self, form: ContourForm, words: tuple[WrittenWord, ...], count: int, way: CornerWay
    ) -> Iterator[Wording]:
        """The block of a form with some words, if its rules allow them."""
        if not check(self.control.rules, form.roles, {word.text[:1]: None for word in words}):
            number = int(form.name.removeprefix("G"))
            block = WrittenBlock(number if number in _MODAL else None, form.name, words)
            yield self.closed(count, (block,), replace(way, words=()))


_MODAL = (1, 11, 12)
"""The codes of forms that stay in force."""

_USES: dict[object, tuple[tuple[ContourForm, frozenset[str]], ...]] = {}
"""The sets of words of the controls that were asked for, by their forms and settings: a sample that one setting
refuses may be right by another."""


def _uses(control: Control) -> tuple[tuple[ContourForm, frozenset[str]], ...]:
    """The sets of words by which each form of a control may be stated, but for those of corners."""
    key = control.name, control.forms, *sorted(control.modes.settings.items())
    if key not in _USES:
        _USES[key] = tuple(dict.fromkeys(_sets(control)))
    return _USES[key]


def _sets(control: Control) -> Iterator[tuple[ContourForm, frozenset[str]]]:
    for form in (each for each in control.forms if each.is_contour):
        if form.table.sample is not None:
            sets: Sequence[frozenset[str]] = [frozenset(row.addresses) for row, _ in legal_samples(form, control)]
        else:
            sets = [each for each in stated_sets(form) if not check(control.rules, form.roles, dict.fromkeys(each))]
        yield from ((form, each.difference(form.outline.shapes)) for each in sets)
