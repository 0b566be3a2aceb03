"""The points of a drawing with their names, the words that state them, and where they are."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from contoursolve.constraints import Coordinate
from contoursolve.examine import Answer
from contoursolve.model import FIRST, SECOND, Arc, Profile
from contoursolve.pictures.known import Known
from contoursolve.pictures.scene import Kind, Mark
from contoursolve.pictures.sheet import Run
from contoursolve.pictures.theme import Role
from contoursolve.pictures.vectors import SAME, distance
from contoursolve.pictures.wording import coordinate, word_text
from contoursolve.solving import Point

BETWEEN = "  "
"""What parts the pieces of a label."""

Others = Mapping[str, Sequence[tuple[Point, str]]]
"""By the name of a point, where it is in other solutions, with the words that select each."""


@dataclass(frozen=True, slots=True)
class _Spot:
    """A place and the names of all points there."""

    at: Point
    names: tuple[str, ...]


def givens_at_points(profile: Profile) -> dict[str, tuple[str, ...]]:
    """The givens whose words state coordinates of a point, by the point, first axis first."""
    found: dict[str, dict[int, str]] = {}
    for fact in (*profile.facts, *profile.ignored):
        given = profile.givens.get(fact.given)
        if isinstance(fact, Coordinate) and given is not None and given.word is not None:
            found.setdefault(fact.point, {}).setdefault(fact.axis, fact.given)
    return {point: tuple(given for _, given in sorted(givens.items())) for point, givens in found.items()}


def list_marks(
    answer: Answer,
    known: Known,
    roles: Mapping[str, Role],
    noted: Mapping[str, Sequence[str]],
    others: Others,
    end: Point | None,
    is_end_free: bool,
) -> Iterator[Mark]:
    """The start, the end, the named points, the points that words state in full (`noted`), and centres."""
    profile = answer.profile
    start = known.points.get(profile.figure.start)
    if start is None:
        return
    if _lacks_last_corner(answer, known):
        end = None
    spots = _spots(known)
    ranks = {"start": start, **({"end": end} if end is not None else {})}
    spots.sort(key=lambda spot: next((n for n, at in enumerate(ranks.values()) if distance(spot.at, at) <= SAME), 2))
    if end is not None and all(distance(spot.at, end) > SAME for spot in spots):
        spots.insert(1, _Spot(end, ()))
    for spot in spots:
        role = next((name for name, at in ranks.items() if distance(spot.at, at) <= SAME), "")
        yield from _mark(answer, known, roles, noted, others, spot, role, is_end_free)
    for name, places in others.items():
        for at, selects in places:
            if all(distance(at, spot.at) > SAME for spot in spots):
                runs = [Run(name, Role.GHOST), *([Run(selects, Role.GHOST)] if selects else [])]
                yield Mark(at, Kind.PLACE, _joined([*runs, _computed(answer, at)]), _joined(runs), Role.GHOST)


def _lacks_last_corner(answer: Answer, known: Known) -> bool:
    """Whether the path ends behind a corner that has not been worked out."""
    figure = answer.profile.figure
    last = {corner.name for corner in figure.corners if corner.at == figure.path[-1].head}
    return answer.contour is None and not known.refusals and not last <= known.corners.keys()


def _spots(known: Known) -> list[_Spot]:
    found: list[_Spot] = []
    for name, at in known.points.items():
        index = next((n for n, spot in enumerate(found) if distance(spot.at, at) <= SAME), None)
        if index is None:
            found.append(_Spot(at, (name,)))
        else:
            found[index] = _Spot(found[index].at, (*found[index].names, name))
    return found


def _mark(
    answer: Answer,
    known: Known,
    roles: Mapping[str, Role],
    noted: Mapping[str, Sequence[str]],
    others: Others,
    spot: _Spot,
    role: str,
    is_end_free: bool,
) -> Iterator[Mark]:
    """The mark of one place, if anything is to be said of it."""
    profile = answer.profile
    shown = [name for name in spot.names if name in profile.intersections]
    # Where the path ends at a virtual intersection, it is the end that counts.
    named = [name for name in shown if not role or not name.startswith("V")]
    is_free = not known.placed.isdisjoint(spot.names) or (role == "end" and is_end_free)
    words = [
        Run(word_text(word.text), roles.get(given, Role.GIVEN))
        for name in spot.names
        for given in noted.get(name, ())
        for word in [profile.givens[given].word]
        if word is not None
    ]
    centers = {element.center for element in profile.figure.path if isinstance(element, Arc)}
    if not (role or shown or words):
        if centers & {*spot.names}:
            yield Mark(spot.at, Kind.CENTER)
        return
    names = [*([role] if role else []), *named]
    if is_free and role == "end":
        names[0] = "end (free)"
    short = [Run(name, Role.FREE if is_free else Role.INK) for name in names]
    short += _choosing(answer, roles, others, spot)
    about = list(words)
    if role == "start" and not words:
        about.append(Run(_place(answer, spot.at), Role.MUTED))
    elif names and not words and not is_free:
        about.append(_computed(answer, spot.at))
    yield Mark(
        spot.at,
        _kind(profile, spot, role, is_center=bool(centers & {*spot.names}) and not shown),
        _joined([*short, *about]),
        _joined(short),
        Role.FREE if is_free else Role.INK,
    )


def _kind(profile: Profile, spot: _Spot, role: str, *, is_center: bool) -> Kind:
    if role:
        return Kind.START if role == "start" else Kind.END
    cut = {corner.at for corner in profile.figure.corners}
    if is_center:
        return Kind.CENTER
    return Kind.VIRTUAL if cut & {*spot.names} else Kind.PLACE


def _choosing(answer: Answer, roles: Mapping[str, Role], others: Others, spot: _Spot) -> list[Run]:
    """The words that choose this place, or would."""
    profile = answer.profile
    runs = []
    for choice in profile.choices:
        given = profile.givens.get(choice.given)
        # The sign of a radius chooses a centre, and is shown with the radius.
        if choice.point in spot.names and choice.point in profile.intersections and given and given.word:
            runs.append(Run(word_text(given.word.text), roles.get(choice.given, Role.GIVEN)))
    for name in spot.names:
        texts = (text for at, text in others.get(name, ()) if distance(at, spot.at) <= SAME)
        runs += [Run(text, Role.GIVEN) for text in texts if text][:1]
    return runs


def _place(answer: Answer, at: Point) -> str:
    return " ".join(coordinate(at, axis, answer.plane, answer.unit) for axis in (FIRST, SECOND))


def _computed(answer: Answer, at: Point) -> Run:
    return Run(_place(answer, at), Role.DERIVED)


def _joined(runs: Sequence[Run]) -> tuple[Run, ...]:
    """Runs with what parts them."""
    return tuple(Run((BETWEEN if number else "") + run.text, run.role) for number, run in enumerate(runs))
