"""The words of a control whose contours are blocks of their own forms: every set that the rules of a form allow."""

from collections.abc import Iterator, Sequence
from itertools import product

from contoursolve.diagnosis import legal_samples
from contoursolve.geometry import Line
from contoursolve.postprocess.contour_drawing import ContourDrawing, DrawnElement, size_as
from contoursolve.postprocess.wordings import GCodeSpeller, Wording, WrittenBlock, WrittenWord, values_of
from contoursolve.reading import ContourForm, Dialect, State, check, stated_sets
from contoursolve.solving import ArcSegment, LineSegment, Point


class FormWordings(GCodeSpeller):
    """The words of a control's forms for elements of a contour."""

    def __init__(self, drawn: ContourDrawing, dialect: Dialect, state: State) -> None:
        super().__init__(drawn, dialect, state)
        self.uses = _uses(dialect)

    def corner_words(self, _: DrawnElement) -> Iterator[WrittenWord]:
        return iter(())

    def special(self, index: int, _plain: Sequence[Wording], *, is_cut: bool) -> Iterator[Wording]:
        for form, names in self.uses:
            yield from self._of_form(form, names, index, is_cut=is_cut)

    def _of_form(self, form: ContourForm, names: frozenset[str], index: int, *, is_cut: bool) -> Iterator[Wording]:
        path = form.outline.path
        row = self.drawn.elements[index : index + len(path)]
        if [isinstance(each, Line) for each in path] != [isinstance(each.segment, LineSegment) for each in row]:
            return
        corners = [self._corners(form, each.name, drawn) for each, drawn in zip(path, row, strict=True)]
        behind, ends = row[-1].corner, [each.segment.end for each in row]
        written_out: tuple[WrittenBlock, ...] = ()
        if behind is not None and not corners[-1]:
            ends[-1], written_out = behind.segment.start, next(self.moves(behind.segment))
        if any(each.corner and not words for each, words in zip(row[:-1], corners, strict=False)):
            return
        places, radii = {path[0].tail: self.begin(index, is_cut=is_cut)}, dict[str, float]()
        for each, drawn, end in zip(path, row, ends, strict=True):
            places[each.head] = end
            if not isinstance(each, Line) and isinstance(drawn.segment, ArcSegment):
                places[each.center], radii[each.radius] = drawn.segment.center, drawn.segment.radius
        self._place_beside(form, places, behind.segment.end if behind and not written_out else None)
        values = values_of(form, places, radii)
        if not names <= values.keys():
            return
        own = tuple(self.word(name, *values[name]) for name in sorted(names))
        for chosen in product(*(each or [()] for each in corners)):
            words = (*own, *(word for each in chosen for word in each))
            if not check(self.dialect.rules, form.roles, {word.text[:1]: None for word in words}):
                number = int(form.name.removeprefix("G"))
                block = WrittenBlock(number if number in _MODAL else None, form.name, words)
                has_corner = behind is not None
                yield Wording(len(path), (block, *written_out), has_corner, writes_corner=bool(written_out))

    def _corners(self, form: ContourForm, name: str, element: DrawnElement) -> list[tuple[WrittenWord, ...]]:
        """The words of a form for the corner behind an element; no word where another one makes it."""
        shapes = [row.shapes for row in form.outline.corners if row.before == name]
        sizes = [(word, size_as(shape, element)) for each in shapes for word, shape in each.items()]
        return [
            (self.word(word, size),) if word in self.lexicon.addresses else ()
            for word, size in sizes
            if size is not None
        ]

    def _place_beside(self, form: ContourForm, places: dict[str, Point], behind: Point | None) -> None:
        """Place the ends of the lines beside the path, on which the last corner lands."""
        for line in form.outline.lines:
            if line.head not in places and behind is not None:
                places[line.head] = behind
            if line.head in places:
                places.setdefault(line.tail, places[line.head])


_MODAL = (1, 11, 12)
"""The codes of forms that stay in force."""

_USES: dict[tuple[ContourForm, ...], tuple[tuple[ContourForm, frozenset[str]], ...]] = {}


def _uses(dialect: Dialect) -> tuple[tuple[ContourForm, frozenset[str]], ...]:
    """The sets of words by which each form of a control may be stated, but for those of corners."""
    if dialect.forms not in _USES:
        _USES[dialect.forms] = tuple(dict.fromkeys(_sets(dialect)))
    return _USES[dialect.forms]


def _sets(dialect: Dialect) -> Iterator[tuple[ContourForm, frozenset[str]]]:
    for form in (each for each in dialect.forms if each.is_contour):
        if form.table.sample is not None:
            sets: Sequence[frozenset[str]] = [frozenset(row.addresses) for row, _ in legal_samples(form, dialect)]
        else:
            sets = [each for each in stated_sets(form) if not check(dialect.rules, form.roles, dict.fromkeys(each))]
        yield from ((form, each.difference(form.outline.shapes)) for each in sets)
