"""Names of symbols: words by their letters, points by their names and axes, so that equations can be read."""

import re
from collections.abc import Iterable, Mapping

from contoursolve.diagnosis.wording import word_keys
from contoursolve.gcode import FACT
from contoursolve.geometry import FIRST, SECOND, Profile, System, line_scalars, scalar
from contoursolve.reading import ParsedContour


def symbol_names(claim: ParsedContour, profile: Profile, system: System) -> Mapping[str, str]:
    """The name of the symbol of every value and unknown of a system, by its name there: letters, digits and single
    underscores, each once.

    A word goes by its letters, with the line where several have them (`A`, `A_2`), and `,R` beside R as `comma_R`; a
    coordinate by the axis and the point (`Z_V1`); of a line whose direction is unknown, `c`, `s` and `d` are its
    cosine, its sine and its place; `side_1` is the first side that no word states.
    """
    keys = word_keys(claim.words.values())
    letters = {word.address for word in claim.words.values()}
    called: dict[str, str] = {}
    for name, given in profile.givens.items():
        is_word = given.word is not None and given.word.address != FACT
        key = keys.get(given.word.span, "") if is_word and given.word is not None else ""
        line, _, address = key.rpartition(":")
        if address.startswith(",") and address[1:] in letters:
            address = f"comma_{address[1:]}"
        called[name] = f"{address}_{line}" if line else address or name.rpartition(":")[2]
    axes, figure = profile.plane.axes, system.figure
    for point in (figure.start, *figure.points, *figure.places):
        called |= {scalar(point, axis): f"{axes[axis]}_{point}" for axis in (FIRST, SECOND)}
    for line in figure.carriers:
        called |= {name: f"{part}_{line}" for name, part in zip(line_scalars(line), "csd", strict=True)}
        called[line] = f"angle_{line}"
    called |= {name: name.replace(".radius", "") + "_size" for name in system.unknowns if name.endswith(".radius")}
    called |= {name: name for name in system.unknowns if name not in called}
    sides = dict.fromkeys(side for fact in system.facts for side in fact.sides())
    called |= {side: f"side_{number}" for number, side in enumerate(sides, 1)}
    return _each_once(called)


def corner_names(corner: str, profile: Profile, taken: Iterable[str]) -> Mapping[str, tuple[str, str]]:
    """The names of the coordinates of the places of a corner: where it begins, where it ends, and its centre."""
    own = corner.rpartition(" ")[2]
    places = {place: [f"{axis}_{place}_{own}" for axis in profile.plane.axes] for place in CORNER_PLACES}
    every = _each_once({name: name for names in places.values() for name in names}, taken)
    return {place: (every[one], every[two]) for place, (one, two) in places.items()}


CORNER_PLACES = ("begin", "end", "center")


def _each_once(called: Mapping[str, str], taken: Iterable[str] = ()) -> dict[str, str]:
    """The names, those alike with a number behind them."""
    found, seen = dict[str, str](), set(taken)
    for name, text in called.items():
        plain = re.sub(r"\W+|_+", "_", re.sub(r"(?<=[a-z]) (?=\d)", "", text.strip(",#"))).strip("_") or "value"
        plain = plain if plain[0].isalpha() else f"v{plain}"
        own, number = plain, 2
        while own in seen:
            own, number = f"{plain}_{number}", number + 1
        seen.add(own)
        found[name] = own
    return found
