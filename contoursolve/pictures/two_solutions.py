"""Two contours that fit one block: A and B, each with its colour, dash and mark, and its letter where it differs."""

from collections.abc import Iterator, Sequence

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnosis import Answer, list_solutions
from contoursolve.pictures.page import TextRun
from contoursolve.pictures.scene import Mark, MarkKind, Trail
from contoursolve.pictures.subject import has_several
from contoursolve.pictures.theme import Role
from contoursolve.solving import ArcSegment, Point, Segment, distance, middle, minus
from contoursolve.tolerance import LENGTH

_LOOKS = ((Role.SOLUTION_A, MarkKind.ROUND), (Role.SOLUTION_B, MarkKind.SQUARE))


class TwoSolutions(Struct, frozen=True):
    """Two contours taken apart: what both have and what one of them has alone, and their letters there."""

    trails: tuple[Trail, ...]
    marks: tuple[Mark, ...]


def two_solutions(answer: Answer) -> TwoSolutions | None:
    """The two contours that fit a block, among which nothing chooses; None of one, or of more than two."""
    if answer.contour is not None or not has_several(answer):
        return None
    found = [each for each in list_solutions(answer) or () if each.contour is not None]
    if len(found) != len(_LOOKS):
        return None
    paths = [each.contour.elements for each in found if each.contour is not None]
    parts = [[*_parted(path, other)] for path, other in (paths, paths[::-1])]
    alike = Role.DETERMINED if answer.claim.form.is_general else Role.INK
    trails, marks = [Trail((each,), alike) for each, is_shared in parts[0] if is_shared], list[Mark]()
    for letter, (role, kind), solution, part in zip("AB", _LOOKS, found, parts, strict=True):
        own = [each for each, is_shared in part if not is_shared]
        if not own:
            return None
        trails += [Trail((each,), role) for each in own]
        label = TextRun(letter, role), *(TextRun(f"  {each}", role) for each in solution.selects[:1])
        marks.append(Mark(middle(max(own, key=lambda each: each.length))[0], kind, label, label[:1], role))
    return TwoSolutions(tuple(trails), tuple(marks))


def _parted(path: Sequence[Segment], other: Sequence[Segment]) -> Iterator[tuple[Segment, bool]]:
    """The pieces of a path, each with whether the other one runs there, too."""
    for each in path:
        like = next((one for one in other if one.name == each.name and _is_on_one(one, each)), None)
        begins, ends = (like is not None and distance(*pair) <= LENGTH for pair in _ends(each, like or each))
        if like is None or not (begins or ends):
            yield each, False
        elif (begins and ends) or each.length <= like.length:
            yield each, True
        elif begins:
            yield replace(each, end=like.end), True
            yield replace(each, start=like.end), False
        else:
            yield replace(each, end=like.start), False
            yield replace(each, start=like.start), True


def _ends(one: Segment, other: Segment) -> tuple[tuple[Point, Point], tuple[Point, Point]]:
    return (one.start, other.start), (one.end, other.end)


def _is_on_one(one: Segment, other: Segment) -> bool:
    """Whether two elements run on one line in one direction, or on one circle in one sense."""
    if isinstance(one, ArcSegment) and isinstance(other, ArcSegment):
        is_round = distance(one.center, other.center) <= LENGTH and abs(one.radius - other.radius) <= LENGTH
        return is_round and one.turn is other.turn
    if isinstance(one, ArcSegment) or isinstance(other, ArcSegment):
        return False
    (at, way), (there, along_) = middle(one), middle(other)
    off = minus(there, at)
    is_straight = way[0] * along_[0] + way[1] * along_[1] > 1 - LENGTH
    return is_straight and abs(way[0] * off[1] - way[1] * off[0]) <= LENGTH
