"""A DXF drawing as a sketch: a chain of its lines and arcs, and the numbers that its dimensions give."""

import io
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from math import dist
from pathlib import Path
from typing import Any, Literal

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.controls import DRAWINGS
from contoursolve.diagnostics import hash_of, importing
from contoursolve.gcode import MOST_OF_OTHERS, open_regular
from contoursolve.sketches.dxf_chain import (
    JOINED,
    Contents,
    DrawnCurve,
    DxfChain,
    DxfError,
    Net,
    gaps,
    read_contents,
    several,
    told,
    turned_round,
)
from contoursolve.sketches.dxf_facts import (
    Chained,
    DrawnFact,
    coordinates,
    cornered,
    dimensions,
    elements_of,
    independent,
    relations,
)
from contoursolve.sketches.known_part import solve_sketch
from contoursolve.sketches.sketch import ContourSketch, Value
from contoursolve.sketches.turned_profile import axis_of, one_side
from contoursolve.solving import ArcSegment, Point
from contoursolve.tolerance import LARGEST

_Unit = Literal["mm", "inch"]
_Stated = Literal["mm", "inch", "m"]
_STATED: Mapping[_Stated, tuple[_Unit, float]] = {"mm": ("mm", 1.0), "inch": ("inch", 1.0), "m": ("mm", 1000.0)}
"""Units that may be said of a drawing: the unit of the sketch, and how many of it are one of the drawing."""
_LONGEST = 10_000.0
"""mm. A part is hardly longer; metres in a header are what many programs write where nobody said a unit."""
_Part = Literal["turned", "milled"]
_MM: Mapping[_Unit, float] = {"mm": 1.0, "inch": 25.4}
_UNITS: Mapping[int, tuple[_Unit, float]] = {
    1: ("inch", 1.0),
    2: ("inch", 12.0),
    4: ("mm", 1.0),
    5: ("mm", 10.0),
    6: ("mm", 1000.0),
    9: ("inch", 0.001),
    14: ("mm", 100.0),
}
"""$INSUNITS of a drawing: the unit of the sketch, and how many of it are one of the drawing."""
_MOST = 12
"""So many chains are listed, the largest."""


class DxfSketch(Struct, frozen=True):
    """A sketch of a chain of a DXF drawing.

    Attributes:
        sketch: the sketch; its numbers are what dimensions give, or else the coordinates.
        given: each dimension on which it rests, and what it measures.
        notes: what was left out, joined or taken for granted, one line each.
        layers: how many lines and arcs each layer has.
        measured: for each element all that the drawing tells, by fields, in the unit of the sketch or degrees: a user
            may take others as given.
    """

    sketch: ContourSketch
    given: tuple[str, ...]
    notes: tuple[str, ...]
    layers: Mapping[str, int]
    measured: tuple[Mapping[str, Value], ...]

    __hash__ = hash_of


def read_dxf(
    drawing: str | Path | bytes,
    *,
    part: _Part,
    layer: str | None = None,
    unit: _Stated | None = None,
    zero: Point | None = None,
    chain: int | None = None,
    join: float = JOINED,
    reverse: bool = False,
) -> DxfSketch:
    """The sketch of a chain of lines and arcs in a DXF drawing, a path or its bytes.

    The numbers of its dimensions are the given ones where their points are points of the chain; its coordinates give
    what they leave open. The drawing's X is Z of a turned part. Its Y is the radius, half of X.

    Args:
        drawing: the path of a file, or its bytes.
        part: `turned` or `milled`.
        layer: the name of a layer, or a pattern such as `contour*`; all layers without it.
        unit: of the drawing, where it tells none or a wrong one: mm, inch or m. A header that says metres is not
            believed without it where the part would be longer than 10 m.
        zero: the place of the drawing that is zero of the part; its Y is the axis of a turned part.
        chain: the number of the chain, the largest is 1; needed where there are several.
        join: mm; ends so near are one place.
        reverse: whether to travel it the other way.

    Raises:
        DxfError: a file that cannot be read, no unit, no chain or several, gaps, an axis that is not known.
        OSError: a file that cannot be opened.
        ValueError: another part or unit.
        MissingExtraError: without the package of `contoursolve[dxf]`.
    """
    if part not in DRAWINGS or unit not in (None, *_STATED):
        raise ValueError(f"part is turned or milled, and unit mm or inch, or m, not {part!r} and {unit!r}")
    document, notes = _opened(drawing)
    named, scale = _unit(document, unit, notes)
    near = join / _MM[named]
    hidden = {each.dxf.name.lower() for each in document.layers if each.is_off() or each.is_frozen()}

    place = _Placing(zero or (0.0, 0.0), scale)
    contents = read_contents(document.modelspace(), place, scale, hidden)
    layers = Counter(each.layer for each in contents.curves)
    wanted = {each for each in layers if layer is None or fnmatchcase(each.lower(), layer.lower()) or each == layer}
    if not wanted:
        raise DxfError(_no_lines(contents, layers, layer), layers)
    curves = [each for each in contents.curves if each.layer in wanted]
    length = _longest(curves)
    if unit is None and scale == _STATED["m"][1] and length > _LONGEST:
        scale, notes[-1] = (
            1.0,
            (
                f"warning: the header says metres, and the part would be {length / 1000:.6g} m long: it is read in mm; "
                "--unit mm says so, --unit m takes metres"
            ),
        )
        place = _Placing(zero or (0.0, 0.0), scale)
        contents = read_contents(document.modelspace(), place, scale, hidden)
        curves = [each for each in contents.curves if each.layer in wanted]
    for segment in (each.segment for each in curves):
        if not all(abs(each) * _MM[named] <= LARGEST for each in (*segment.start, *segment.end)):
            raise DxfError(f"{segment.name} lies farther away than a control can travel: {told(segment.end)}", layers)
    if part == "turned":
        if zero is None:
            axis, about = axis_of(curves, near, contents.curves)
            place = _Placing((0.0, axis / scale), scale)
            contents = read_contents(document.modelspace(), place, scale, hidden)
            curves, notes = [each for each in contents.curves if each.layer in wanted], notes + about
        curves, about = one_side(curves, near)
        notes += about
    net = Net(curves, near)
    if not net.curves:
        raise DxfError(f"the drawing has no lines and arcs with a length; {net.notes[0]}", layers)
    strange = [each for each in contents.strange if layer is None or each[1] in wanted]
    chosen = _chosen(net.chains(), chain, layers, named, [name for name, *_ in strange], notes)
    _check(chosen, curves, strange, near)
    beside = Counter(kind for kind, own in contents.beside if layer is None or own in wanted)
    notes += [*net.notes, *(f"left out, no line and no arc: {name}" for name, *_ in strange)]
    notes += [f"left out, beside the contour: {count} {kind}" for kind, count in beside.items()]
    is_backward = part == "turned" and not chosen.is_closed and chosen.elements[0].start[0] < chosen.elements[-1].end[0]
    chosen = _directed(chosen, is_reversed=is_backward != reverse)
    axes, distance = DRAWINGS[part].plane.axes, JOINED / _MM[named]

    def given_by(ends: Iterable[tuple[Point, Point]]) -> tuple[Chained, set[str]]:
        chain, own = cornered(chosen, near, {*every}.difference(ends))
        chained = Chained(chain, axes, distance, is_turned=part == "turned", corners=own)
        return chained, {fact.given for fact in dimensions(chained, contents.dimensions, place)[0]}

    # Where a dimension ends at the end of a chamfer or of a rounding, the drawing says the line or the arc itself.
    every = [each.ends for each in cornered(chosen, near)[1]]
    (chained, told_by_all), told_by_lines = given_by(every), given_by([])[1]
    if not told_by_all >= told_by_lines:
        chained = given_by([ends for ends in every if given_by([ends])[1] >= told_by_lines])[0]
    notes += [
        f"read as a {each.corner.shape} of {each.corner.size} {named}: {_name(chosen, each.ends)}"
        for each in chained.corners.values()
    ]
    known = list(coordinates(chained))
    sketch, given = _sketch(chained, chosen, known, contents.dimensions, place, named, notes)
    return DxfSketch(sketch, given, tuple(notes), dict(layers), tuple(_measured(chained, known)))


def _name(chain: DxfChain, ends: tuple[Point, Point]) -> str:
    return next(each.name for each in chain.elements if (each.start, each.end) == ends)


def _sketch(
    chained: Chained,
    chain: DxfChain,
    known: Sequence[DrawnFact],
    entities: Sequence[Any],
    place: Any,
    unit: _Unit,
    notes: list[str],
) -> tuple[ContourSketch, tuple[str, ...]]:
    """The sketch with the numbers of dimensions, and these; where they fix no contour, or another one, with the
    coordinates. A guess chooses among several solutions. What is told of dimensions is added to the notes."""

    def sketch(facts: Sequence[DrawnFact], *, has_guess: bool = False) -> ContourSketch:
        elements = elements_of(chained, facts, has_guess=has_guess)
        part: _Part = "turned" if chained.is_turned else "milled"
        return ContourSketch(part, elements, chained.place(0), unit, chained.is_closed)

    facts, about = dimensions(chained, entities, place)
    notes += about
    taken, is_complete = independent(chained, list(relations(chained)), facts, known) if facts else ([], False)
    given = tuple(dict.fromkeys(fact.given for fact in taken if fact.given))
    if not given or not is_complete:
        notes += ["no dimension gives a number: the coordinates of the drawing are given"] if entities else []
        return sketch(known), ()
    others = dict.fromkeys(fact.given for fact in facts if fact.given not in given)
    notes += [f"{each}: it follows from others, or no field is free for it" for each in others]
    read = [
        f"{fact.field} of element {fact.element + 1}"
        for fact in taken
        if fact in known and not (chained.is_turned and fact.field == chained.axes[1] and not fact.value)
    ]
    notes += [f"no dimension gives {several(read)}: read from the lines"] if read else []
    for found in (sketch(taken), sketch(taken, has_guess=True)):
        answer = solve_sketch(found).answer
        path = answer.contour.elements if answer is not None and answer.contour is not None else ()
        ends = [(each.end[0] / _MM[unit], each.end[1] / _MM[unit]) for each in path]
        drawn = [each.end for each in chain.elements]
        if len(ends) == len(drawn) and max(map(dist, ends, drawn)) <= chained.near:
            return found, given
    notes.append("the numbers of dimensions do not fix the contour: the coordinates of the drawing are given")
    return sketch(known), ()


def _longest(curves: Sequence[DrawnCurve]) -> float:
    """The reach of lines and arcs along an axis."""
    places = [at for each in curves for at in each.points()]
    return max((max(own) - min(own) for own in zip(*places, strict=True)), default=0.0)


class _Placing(Struct, frozen=True):
    """The place of the sketch for one of the drawing."""

    origin: Point
    scale: float

    def __call__(self, at: Any) -> Point:
        return (at[0] - self.origin[0]) * self.scale, (at[1] - self.origin[1]) * self.scale


def _read(path: str | Path) -> bytes:
    """The bytes of a file. Raises OSError."""
    with open_regular(path, MOST_OF_OTHERS) as file:
        return file.read()


def _opened(drawing: str | Path | bytes) -> tuple[Any, list[str]]:
    """The document of a drawing, and what is damaged in it. Raises DxfError, OSError, MissingExtraError."""
    with importing("dxf", "reading a DXF drawing"):
        from ezdxf.recover import read as recover  # noqa: PLC0415 - an extra
    data = drawing if isinstance(drawing, bytes) else _read(drawing)
    if data.startswith(b"AC10"):
        raise DxfError("this is a DWG drawing; save it as DXF in your CAD")
    notes = list[str]()
    try:
        try:
            document = _strictly(data)
        except Exception as error:  # ezdxf meets damage of every kind
            # Reading with repairs leaves out whatever is odd, also what a strict reader takes.
            document, audit = recover(io.BytesIO(data))
            notes.append(f"the file is damaged, and read as far as it goes: {error}")
            notes += [each.message for each in (*audit.errors, *audit.fixes)]
    except Exception as error:  # the same
        raise DxfError(f"the file is no DXF drawing that can be read: {error}") from None
    if b"SECTION" not in data:
        raise DxfError("the file is no DXF drawing: it has no sections")
    if not len(document.modelspace()):
        is_on_paper = any(len(each) for each in document.layouts if not each.is_modelspace)
        told = "; it has something on paper, which is not read: export the model" if is_on_paper else ""
        raise DxfError(f"the drawing has nothing in its model space{told}")
    return document, notes


def _strictly(data: bytes) -> Any:
    """The document of a file without damage. Raises whatever ezdxf does."""
    from ezdxf.document import Drawing  # noqa: PLC0415 - an extra
    from ezdxf.filemanagement import dxf_stream_info, read  # noqa: PLC0415 - an extra
    from ezdxf.lldxf.tagger import binary_tags_loader  # noqa: PLC0415 - an extra

    if data.startswith(b"AutoCAD Binary DXF"):
        return Drawing.load(binary_tags_loader(data))
    encoding = dxf_stream_info(io.StringIO(data.decode("latin-1"), newline=None)).encoding
    return read(io.StringIO(data.decode(encoding, "surrogateescape"), newline=None))


def _unit(document: Any, wanted: _Stated | None, notes: list[str]) -> tuple[_Unit, float]:
    """The unit of the sketch, and how many of it are one of the drawing. Raises DxfError."""
    stated = _UNITS.get(document.header.get("$INSUNITS", 0))
    if wanted is not None:
        if stated is not None and stated != _STATED[wanted]:
            notes.append(f"the drawing says that its unit is {stated[1]:g} {stated[0]}; {wanted} is taken, as you say")
        return _STATED[wanted]
    if stated is None:
        raise DxfError("the drawing does not tell its unit; say mm or inch (unit)")
    if stated[1] != 1:
        notes.append(f"the unit of the drawing is {stated[1]:g} {stated[0]}")
    return stated


def _no_lines(contents: Contents, layers: Mapping[str, int], layer: str | None) -> str:
    """The reason why no chain can be made."""
    if layers:
        listed = ", ".join(f"{name!r} with {count} lines and arcs" for name, count in layers.items())
        return f"no layer {layer!r} has lines or arcs; there are {listed}"
    strange = several([name for name, *_ in contents.strange])
    return f"the drawing has no lines and arcs{f', only {strange}; convert them in your CAD' if strange else ''}"


def _chosen(
    chains: Sequence[DxfChain],
    wanted: int | None,
    layers: Mapping[str, int],
    unit: _Unit,
    strange: Sequence[str],
    notes: list[str],
) -> DxfChain:
    """The chain of that number, or the only one; that its ends lie near is noted. Raises DxfError."""
    if wanted is not None and 0 < wanted <= len(chains):
        return chains[wanted - 1]
    apart = gaps(chains, 1 / _MM[unit])
    if len(chains) == 1 and wanted is None:
        notes += apart
        return chains[0]
    listed = [
        f"chain {place}: {len(each.elements)} {'closed' if each.is_closed else 'open'}, "
        f"{each.size[0]:.6g} x {each.size[1]:.6g} {unit}, layer {', '.join(map(repr, each.layers))}"
        for place, each in enumerate(chains[:_MOST], 1)
    ]
    rest = [f"{len(chains) - _MOST} smaller chains"] if len(chains) > _MOST else []
    lines = [*listed, *rest, *apart, *(f"no line and no arc: {name}" for name in strange)]
    advice = "; close gaps in your CAD, or by a larger distance (join)" if apart else ""
    count = f"{len(chains)} chains" if len(chains) > 1 else "one chain"
    lacks = "" if wanted is None else f", and there is no chain {wanted}"
    message = f"the lines and arcs make {count}{lacks}; choose one by its number (chain) or layer{advice}"
    raise DxfError("\n  ".join([message, *lines]), layers, chains)


def _check(
    chain: DxfChain, curves: Sequence[Any], strange: Sequence[tuple[str, str, list[Point]]], near: float
) -> None:
    """Raise DxfError for a chain that does not lie in a plane, or that goes on as another kind of curve."""
    names = {each.name for each in chain.elements}
    heights = [each.height for each in curves if each.segment.name in names]
    if max(heights) - min(heights) > near:
        raise DxfError(f"the drawing is not flat: the chain lies from Z{min(heights):.6g} to Z{max(heights):.6g}")
    for name, _, ends in strange:
        for at in ends:
            if any(dist(at, end) <= near for each in chain.elements for end in (each.start, each.end)):
                raise DxfError(
                    f"{name} goes on from the chain at {told(at)}, and is no line and no arc; convert it into arcs in "
                    "your CAD, or take it from the layer"
                )


def _directed(chain: DxfChain, *, is_reversed: bool) -> DxfChain:
    """The chain in its direction; a full circle becomes two halves, as programs have it."""
    elements = list(chain.elements)
    if is_reversed:
        elements = [turned_round(each) for each in reversed(elements)]
    first = elements[0]
    if len(elements) == 1 and chain.is_closed and isinstance(first, ArcSegment):
        opposite = 2 * first.center[0] - first.start[0], 2 * first.center[1] - first.start[1]
        elements = [replace(first, end=opposite), replace(first, start=opposite)]
    return replace(chain, elements=tuple(elements))


def _measured(chained: Chained, known: Sequence[DrawnFact]) -> Iterator[dict[str, Value]]:
    """All that the drawing tells of each element, as fields."""
    for place in range(len(chained.elements)):
        own = [fact for fact in known if fact.element == place]
        further = [*(f"I{name}" for name in chained.axes), *(() if place in chained.arcs else ("AN", "LEN"))]
        yield {fact.field: fact.value for fact in (*own, *(chained.fact(place, name, place) for name in further))}
