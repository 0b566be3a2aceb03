"""The names of straights, arcs, corners and points: by what stands in the program, for `line 2` is a program line.

Facts, and the JSON's points and elements, have the names of the figure; so have points where a label must be short.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache, partial

from msgspec.structs import replace

from contoursolve.diagnosis.wording import number_text
from contoursolve.diagnostics import Diagnostic, Span, checked
from contoursolve.gcode import FACT, Block, late_pattern
from contoursolve.geometry import FIRST, SECOND, Arc, CornerShape, Line, Profile, Unit
from contoursolve.reading import ParsedContour

_NTH = ("first", "second", "third", "4th", "5th", "6th")
_NAME = r"(?<!program )\b(?:line|arc|corner) \d+\b(?! = )"
_PLACE = r"(?P<at>\.(?:begin|end|center)\b)?"
_FACT = r"\([^()]*contoursolve[^()]*\)"
_LINES = r"\bprogram lines? \d+(?:(?:, \d+)* and \d+| to \d+)?"


def named_in_program(findings: Iterable[Diagnostic], claim: ParsedContour, profile: Profile) -> tuple[Diagnostic, ...]:
    """Findings about a contour that name each part of it by what stands in the program."""
    blocks = block_numbers(claim.blocks)
    givens = (given.word for given in profile.givens.values())
    facts = [word for word in (*claim.words.values(), *givens) if word is not None and word.address == FACT]
    places = [*(word.span for word in facts), *(each.span for each in claim.directives)]
    texts = {*(word.text for word in facts), *(each.text for each in claim.directives)}
    pattern = _pattern((*texts, *(block.text.strip() for block in claim.blocks)), profile)
    names = cache(lambda: names_of(profile, claim.blocks, blocks) | names_of_points(profile, blocks))

    def renamed(finding: Diagnostic) -> Diagnostic:
        told = set[str]()

        def write(found: re.Match[str]) -> str:
            if found["lines"]:
                lines = [int(number) for number in re.findall(r"\d+", found["lines"])]
                if not blocks or any(line not in blocks for line in lines):
                    return found[0]
                return re.sub(r"\d+", lambda line: blocks[int(line[0])], found[0].replace("program line", "block"))
            if not found["name"] and not found["point"]:
                # A fact stays as it is written.
                return found[0]
            own = found["name"] or found["point"]
            name, kind, place = names().get(own) or (*[_unknown(own, profile)] * 2, "")
            before = found.string[: found.start()]
            if " -> " in before and found["name"]:
                # Where it runs then is what is told of it.
                return f"{kind} in {place}" if place else kind
            is_new = own not in told
            told.add(own)
            at = _AT.get(found["at"] or "", "")
            name = name.removeprefix("the ") if before.endswith(("no ", "the ")) else name
            return f"{at}{name} ({place})" if place and is_new else f"{at}{name}"

        def rename(text: str) -> str:
            return pattern.sub(write, text)

        return replace(
            finding,
            message=rename(finding.message),
            labels=tuple(replace(each, text=rename(each.text)) for each in finding.labels),
            notes=tuple(map(rename, finding.notes)),
            help=rename(finding.help),
            fixes=tuple(replace(each, description=rename(each.description)) for each in finding.fixes),
        )

    # A finding about a fact speaks as facts do.
    return tuple(each if each.span.line <= 0 or _is_within(each.span, places) else renamed(each) for each in findings)


def _is_within(span: Span, places: Iterable[Span]) -> bool:
    """Whether a span is one of some places, or a part of one."""
    return any(
        each.line == span.line and each.column <= span.column and span.end_column <= each.end_column for each in places
    )


@checked
def called_in_program(profile: Profile, *, has_values: bool = True) -> Callable[[str], str]:
    """A function that calls the straights, arcs and corners in a text by what stands in the program.

    A corner goes by its word, unless the text holds for other values. Points keep their labels, facts their words."""
    words = (given.word for given in profile.givens.values())
    pattern = _pattern(word.text.strip() for word in words if word is not None and word.address == FACT)
    parts = cache(lambda: _parts_of(profile, has_values=has_values))

    def write(found: re.Match[str]) -> str:
        own = found["name"]
        called = own and (parts().get(own) or _unknown(own, profile))
        return f"{_AT.get(found['at'] or '', '')}{called}" if own else found[0]

    return lambda text: pattern.sub(write, text)


def labels_of(profile: Profile) -> Mapping[str, str]:
    """The names of the parts of a contour in tables: `straight (program line 2)`, `rounding P5.`; and where each of
    its points lies: `end of program line 2`."""
    points = {name: told for name, (told, _, _) in names_of_points(profile, block_numbers(profile.blocks)).items()}
    return {name: told.removeprefix("the ") for name, told in (_parts_of(profile) | points).items()}


def _parts_of(profile: Profile, *, has_values: bool = True) -> dict[str, str]:
    """The straights, arcs and corners of a contour by their kinds and places, without from where to where they run."""
    named = names_of(profile, profile.blocks, block_numbers(profile.blocks))
    corners = {corner.name for corner in profile.figure.corners} if has_values else set[str]()
    return {
        name: f"{told if name in corners else kind} ({place})" if place else told if name in corners else kind
        for name, (told, kind, place) in named.items()
    }


def _pattern(kept: Iterable[str], profile: Profile | None = None) -> re.Pattern[str]:
    """A pattern of the names of elements and corners, of the points of a profile, and of program lines, outside what is
    kept as it is written."""
    written = map(re.escape, sorted(filter(None, kept), key=len, reverse=True))
    figure = profile.figure if profile is not None else None
    # Single letters are words as well.
    points = (figure.start, *figure.points) if figure is not None else ()
    ways = [rf"{each}" if each[1:] else rf"(?:{_BEFORE}){each}|{each}{_BEHIND}" for each in points if each.isalnum()]
    point = "|".join((*sorted(ways, reverse=True), _OF_A_FIX)) if figure is not None else "(?!)"
    bounded = rf"(?<![\w.:+=-])(?P<point>{point})(?![\w:=?.+-])"
    return re.compile("|".join((_FACT, *written, f"(?P<name>{_NAME}){_PLACE}", f"(?P<lines>{_LINES})", bounded)))


_BEFORE = "|".join(rf"(?<=\b{word} )" for word in ("about", "from", "through"))
_BEHIND = r"(?= (?:\(|is |can still))"
_OF_A_FIX = r"(?:(?<=-> )|(?<=without )|(?<=mm, ))[VPN]\d+(?=$|,| is at| at)"
"""Points of another contour."""

_AT = {".begin": "the begin of ", ".end": "the end of ", ".center": "the centre of "}
_NUMBERED = late_pattern(r"(line|arc|corner) (\d+)")


def _unknown(name: str, profile: Profile) -> str:
    """The name of a part that the contour as it is written does not have."""
    found, numbers = _NUMBERED.fullmatch(name), block_numbers(profile.blocks)
    if found is None:
        return "the centre" if name.startswith("C") else "the corner"
    kind, nth, path = {"line": "straight"}.get(found[1], found[1]), int(found[2]), profile.figure.path
    place = "" if numbers or nth > len(path) else names_of(profile, profile.blocks, numbers)[path[nth - 1].name][2]
    if kind == "corner" and place:
        return f"the corner in {place}"
    return f"the {kind}" if numbers or nth > len(_NTH) else f"the {_NTH[nth - 1]} {kind}"


def block_numbers(blocks: Sequence[Block]) -> Mapping[int, str]:
    """The number of each block by its line, where a program is counted by them; empty where one lacks it."""
    if not blocks[0].syntax.counts_blocks:
        return {}
    numbers = [(block.line, word.number) for block in blocks if (word := block.find("N")) is not None]
    found = {line: f"{number:f}" for line, number in numbers if number is not None}
    return found if len({*found.values()}) == len(blocks) else {}


def names_of(profile: Profile, blocks: Sequence[Block], numbers: Mapping[int, str]) -> dict[str, tuple[str, str, str]]:
    """The name of each element and corner of a figure, its kind, and its place: from where to where it runs as far as
    the program says it, and its line if the contour has several; `numbers` are those of its blocks, if they count."""
    figure, names = profile.figure, dict[str, tuple[str, str, str]]()
    lines = {number: line for line, number in numbers.items()}
    first = _first_lines(profile)
    own = {
        each.name: lines.get(each.name.partition(" ")[2]) or _line_of(each, first) or blocks[0].line
        for each in figure.path
    }
    several, places = len({*own.values()}) > 1, _places(profile)
    sizes = {name: given.word for name, given in profile.givens.items() if given.word is not None}
    sizes |= {question.name: question.word for question in profile.questions}

    def place_of(line: int) -> str:
        told = f"block {numbers[line]}" if line in numbers else f"program line {line}"
        return told if several else ""

    for each in figure.path:
        alike = [other for other in figure.path if own[other.name] == own[each.name] and type(other) is type(each)]
        nth = f"{_NTH[alike.index(each)]} " if 1 < len(alike) <= len(_NTH) else ""
        kind = f"the {nth}{'arc' if isinstance(each, Arc) else 'straight'}"
        told = _way(each, places, profile)
        names[each.name] = f"the {told}" if told else kind, kind, place_of(own[each.name])
    for corner in figure.corners:
        size = sizes.get(corner.size)
        if size is None or corner.name in names:
            before, _, place = names.get(corner.before, ("the contour", "", ""))
            names[corner.name] = f"the corner at the end of {before}", "the corner", place
        else:
            kind = "the rounding" if corner.shape is CornerShape.FILLET else "the chamfer"
            name, at = f"{kind} {size.text}", figure.corners.index(corner)
            # A fix may write another size, or another shape.
            is_counted = not several and 1 < len(figure.corners) <= len(_NTH)
            names[corner.name] = name, f"the {_NTH[at]} corner" if is_counted else kind, place_of(size.span.line)
    return names


def names_of_points(profile: Profile, numbers: Mapping[int, str]) -> dict[str, tuple[str, str, str]]:
    """The names of the points of a figure, as `names_of` has those of its elements: each says its place itself."""
    figure, told = profile.figure, {profile.figure.start: "the start"}
    named = names_of(profile, profile.blocks, numbers)
    cut = {corner.at for corner in figure.corners}
    for number, each in enumerate(figure.path):
        _, kind, place = named[each.name]
        following = named[figure.path[number + 1].name][2] if number + 1 < len(figure.path) else ""
        if each.head in cut and place and following not in ("", place):
            unit, _, line = place.rpartition(" ")
            told.setdefault(each.head, f"the corner between {unit}s {line} and {following.rpartition(' ')[2]}")
        is_own = place and not any(each is not other and named[other.name][2] == place for other in figure.path)
        told.setdefault(each.head, f"the end of {place if is_own else kind}")
        if isinstance(each, Arc):
            told.setdefault(each.center, f"the centre of {kind}{f' of {place}' if place else ''}")
        stated = f"N{number + 1}"
        if stated in figure.points and stated != each.head:
            told.setdefault(stated, f"the point that {place or kind} states")
    return {name: (text, text, "") for name, text in told.items() if name in (figure.start, *figure.points)}


def _first_lines(profile: Profile) -> dict[str, int]:
    """The line of the first word that says something of each point and each number of a figure."""
    found = dict[str, int]()
    for fact in profile.facts:
        given = profile.givens.get(getattr(fact, "given", ""))
        word = given.word if given is not None else None
        if word is None or word.address == FACT:
            continue
        for value in map(partial(getattr, fact), getattr(fact, "__struct_fields__", ())):
            if isinstance(value, str):
                found[value] = min(found.get(value, word.span.line), word.span.line)
    return found


def _line_of(element: Line | Arc, first: Mapping[str, int]) -> int:
    """The line of the first word that says something of an element; 0 if none does."""
    parts = (element.name, element.head, *((element.center, element.radius) if isinstance(element, Arc) else ()))
    return min((first[part] for part in parts if part in first), default=0)


Places = dict[str, list[float | None]]


def _places(profile: Profile) -> Places:
    """The coordinates of points as far as single words say them, and straight lines along an axis carry them on."""
    figure, givens = profile.figure, profile.givens
    places: Places = {name: [None, None] for name in (figure.start, *figure.points)}
    if profile.start.is_relative:
        return places
    places[figure.start] = [None if value is None else float(value) for value in profile.start.values]
    values = {name: float(given.value) for name, given in givens.items()}
    for _ in figure.path:
        before = {name: [*place] for name, place in places.items()}
        for fact in profile.facts:
            placed = fact.placed
            if placed is None or (placed.is_stepped and fact.given not in values):
                continue
            origin = places[placed.origin][placed.axis] if placed.origin else 0.0
            if origin is not None:
                step = values[fact.given] if placed.is_stepped else 0.0
                places[placed.point][placed.axis] = origin + step
        for line in figure.path:
            heading = values.get(line.heading or "") if isinstance(line, Line) else None
            if heading is not None and heading % 90 == 0:
                across = SECOND if heading % 180 == 0 else FIRST
                places[line.head][across] = places[line.tail][across]
        if before == places:
            break
    return places


def _way(element: Line | Arc, places: Places, profile: Profile) -> str:
    """The kind of an element, and from where to where it runs; empty where the program does not say both ends."""
    begin, end = places[element.tail], places[element.head]
    at, to = (
        ["" if value is None else _text(value, axis, profile) for axis, value in enumerate(each)]
        for each in (begin, end)
    )
    if not all((*at, *to)) or at == to:
        return ""
    is_turned = any(profile.plane.diameters)
    if isinstance(element, Arc):
        return f"arc from {' '.join(at)} to {' '.join(to)}"
    for axis in (FIRST, SECOND):
        if at[axis] == to[axis] and at[1 - axis] != to[1 - axis]:
            name = "straight" if not is_turned else "diameter" if profile.plane.diameters[axis] else "face"
            return f"{name} {at[axis]} from {at[1 - axis]} to {to[1 - axis]}"
    return f"straight from {' '.join(at)} to {' '.join(to)}"


def _text(value: float, axis: int, profile: Profile) -> str:
    """A coordinate as the program would have it, without decimals that say nothing: `X40`."""
    shown = value * (2 if profile.plane.diameters[axis] else 1)
    return f"{profile.plane.axes[axis]}{number_text(shown, Unit.MM, profile.unit).rstrip('.')}"
