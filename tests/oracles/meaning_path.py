"""The path of lines, arcs and corners between lines that the moves of a reference interpreter make."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import acos, cos, degrees, tan

from reference_interpreter import Fanuc, Interpreter, Move, Sinumerik, Stopped, Value, is_known

CONTROLS = ("siemens-840d", "siemens-turning", "fanuc-mill", "fanuc-lathe")
"""SINUMERIK also as a lathe, and Fanuc."""

MOST_WAYS = 16


@dataclass(frozen=True)
class Path:
    """Where it starts, and each line or arc: its end, and the centre of an arc; mm in the plane."""

    start: complex
    elements: tuple[tuple[complex, complex | None], ...]


@dataclass(frozen=True)
class Open:
    """A path that is not known."""


class Hard(Exception):  # noqa: N818 - too near to a limit to be judged by arithmetic of its own
    pass


def runs(text: str, control: str) -> list[list[Move]]:
    """The moves of each way that a program can take."""
    found, waiting = list[list[Move]](), list[list[bool]]([[]])
    while waiting:
        chosen, taken = waiting.pop(), list[bool]()

        def decide(chosen=chosen, taken=taken) -> bool:
            if len(taken) == len(chosen):
                waiting.append([*taken, False])
                chosen.append(True)
            taken.append(chosen[len(taken)])
            return taken[-1]

        found.append(interpreter(text, control, decide).section(0))
        if len(found) > MOST_WAYS:
            raise Stopped("too many ways")
    return found


def interpreter(text: str, control: str, decide) -> Interpreter:
    language = Sinumerik if control.startswith("siemens") else Fanuc
    return language(text, decide, is_turning=control in ("siemens-turning", "fanuc-lathe"))


def path_of(moves: Sequence[Move]) -> Path | Open | None:
    """The path of moves in a row, in the coordinates of the first; None if no path is like that."""
    zero = moves[0].zero
    places = [moves[0].seen(moves[0].start, zero), *(each.seen(each.end, zero) for each in moves)]
    sizes = [each.corner[1] for each in moves if each.corner]
    values = [*(each for place in places for each in place), *sizes]
    values += [each for move in moves if move.center is not None for each in move.center]
    if not all(map(is_known, values)):
        return Open()
    if any(move.axes != moves[0].axes or move.motion < 0 for move in moves):
        return None
    points = [complex(*place[:, 0]) for place in places]
    taken, corners = [0.0] * (len(points) + 1), dict[int, tuple[complex, complex, complex | None]]()
    for at, move in enumerate(moves[:-1], 1):
        if move.corner and move.corner[1][0]:
            before, here, after = points[at - 1 : at + 2]
            if moves[at].center is not None or move.center is not None:
                raise Hard
            corner = corner_of(before, here, after, move.corner)
            taken[at - 1] += abs(corner[0] - here)
            taken[at] += abs(corner[0] - here)
            corners[at] = corner
    elements = list[tuple[complex, complex | None]]()
    for at, move in enumerate(moves, 1):
        room = abs(points[at] - points[at - 1]) - taken[at - 1]
        if corners and abs(room) < 0.02 and taken[at - 1]:
            raise Hard
        if room < 0:
            return None
        first, second, center = corners.get(at, (points[at], points[at], None))
        own = None if move.center is None else complex(*move.center[:, 0])
        elements += [(first, own), (second, center)] if at in corners else [(first, own)]
    start, kept = points[0], list[tuple[complex, complex | None]]()
    for end, center in elements:
        if abs(end - start) > 1e-6:
            kept.append((end, center))
        start = end
    return Path(points[0], tuple(kept))


def corner_of(before: complex, here: complex, after: complex, corner: tuple[str, Value]):
    """Where the corner begins and ends, and the centre of a rounding."""
    name, size = corner[0], corner[1][0]
    if abs(here - before) < 0.01 or abs(after - here) < 0.01 or size <= 0:
        raise Hard
    one, other = (here - before) / abs(here - before), (after - here) / abs(after - here)
    turn = acos(max(-1.0, min(1.0, (one * other.conjugate()).real)))
    if not 3 < degrees(turn) < 177:
        raise Hard
    side = 1j if (one.conjugate() * other).imag > 0 else -1j
    if name in ("RND", ",R"):
        far = size * tan(turn / 2)
        return here - far * one, here + far * other, here - far * one + side * size * one
    far = size if name in ("CHR", ",C") else size / (2 * cos(turn / 2))
    return here - far * one, here + far * other, None


def are_alike(one: Path, other: Path, within: float = 1e-5) -> bool:
    return (
        abs(one.start - other.start) <= within
        and len(one.elements) == len(other.elements)
        and all(
            abs(a - b) <= within and (c is None) is (d is None) and (c is None or abs(c - (d or 0)) <= within)
            for (a, c), (b, d) in zip(one.elements, other.elements, strict=True)
        )
    )
