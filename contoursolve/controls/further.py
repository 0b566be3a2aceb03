"""The words and codes of controls beside those that draw contours, as tables: further axes, feeds, speeds, tools, and
codes that are known by name alone."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from decimal import Decimal
from itertools import count
from typing import cast

from contoursolve.diagnostics import OWN, Evidence, Source
from contoursolve.reading import Bearing, Beside, Code, Control, Effect, Modes, Setting

_LETTERS: tuple[tuple[str, str, Bearing], ...] = (
    ("N O", "number of a block or a program", Bearing.NONE),
    ("F", "feed", Bearing.NONE),
    ("S", "speed of a spindle", Bearing.NONE),
    ("T", "tool", Bearing.NONE),
    ("M", "function of the machine", Bearing.NONE),
    ("D H", "offset of a tool", Bearing.NONE),
    ("A B C", "axis that turns, or second auxiliary function", Bearing.AXIS),
    ("X Y Z U V W", "further axis", Bearing.AXIS),
    ("E I J K L P Q R", "argument of a G or M code", Bearing.ARGUMENT),
)
"""The letters of ISO 6983, as far as a control gives them no meaning of its own."""


def letters(source: Source) -> tuple[Beside, ...]:
    """The letters of a control that follows ISO 6983."""
    return rows(source, _LETTERS)


def rows(source: Source, table: Iterable[tuple[str, str, Bearing]]) -> tuple[Beside, ...]:
    """Rows of words, the names of each in one text."""
    return tuple(Beside(tuple(names.split()), meaning, source, bearing) for names, meaning, bearing in table)


def _with_words(control: Control, names: tuple[str, ...]) -> Control:
    """A control whose machine has more words, which move nothing."""
    lexicon = control.modes.lexicon
    row = Beside(names, "word of the machine builder", Source("the setting words", "", Evidence.ASSUMED))
    words = replace(lexicon, beside=(*lexicon.beside, row))
    return replace(control, modes=_with_commands(replace(control.modes, lexicon=words), names, row.source))


def _with_commands(modes: Modes, names: Iterable[str], source: Source) -> Modes:
    """The same where a name without a value is a command, on controls that have such ones."""
    syntax, language = modes.syntax, modes.language
    new = tuple(name for name in names if len(name) > 1 and name not in syntax.codes)
    if not syntax.codes or language is None or language.with_names is None or not new:
        return modes
    numbers = dict(zip(new, count(max(modes.codes) + 1), strict=False))
    rows = {
        number: Code(number, Effect.NONE, "command of the machine builder", source, name=name)
        for name, number in numbers.items()
    }
    return replace(
        modes,
        codes={**modes.codes, **rows},
        syntax=replace(syntax, codes={**syntax.codes, **numbers}),
        language=language.with_names(new),
    )


WORDS = Setting(
    "words",
    "words and commands that the machine builder has added, and that move nothing",
    {"none": "none but those of the control"},
    "none",
    Source(OWN, "lexicons of controls", Evidence.ASSUMED),
    names=_with_words,
)


_BY_THEMSELVES = frozenset({27, 28, 29, 30, 31, 36, 37})
"""Codes of reference points, skip and measuring."""


def leaving(code: Code) -> Code:
    """The row of a code, which may leave the motion in force."""
    is_leaving = code.effect is Effect.SINGLE and code.number in _BY_THEMSELVES
    return replace(code, leaves_motion=True) if is_leaving else code


def known_by_name(
    source: Source, table: Mapping[Effect, Mapping[int, str]], own: Mapping[int, Code]
) -> dict[int, Code]:
    """The codes of a control and those besides of which it is known that it has them: what changes the path, the motion
    or the coordinates is not read."""
    more = {
        number: leaving(Code(number, effect, meaning, source, is_read=effect in (Effect.NONE, Effect.SHIFT)))
        for effect, row in table.items()
        for number, meaning in row.items()
    }
    read = {number: replace(code, is_read=False) if number in _MODAL_CALLS else code for number, code in own.items()}
    return {**more, **read}


_MODAL_CALLS = (66,)
"""Codes that call a macro behind each move."""


def _points(*numbers: str) -> tuple[int, ...]:
    """Numbers of codes with a point, as G02.2 has one. They are looked up as those of words are, which are decimals."""
    return tuple(cast("int", Decimal(number)) for number in numbers)


UNREAD_CALLS = frozenset({97, 198})
"""M codes that call lines or programs on some machines, and that are the machine builder's on others."""

_CURVES: Mapping[int, str] = (
    dict.fromkeys(_points("2.1", "3.1"), "spiral or arc of a special kind")
    | dict.fromkeys(_points("2.2", "3.2"), "involute")
    | dict.fromkeys(_points("2.3", "3.3"), "exponential interpolation")
    | dict.fromkeys(_points("2.4", "3.4"), "arc in space")
    | dict.fromkeys(_points("5.2", "6.1", "6.2"), "spline")
)
_SPEEDS: Mapping[int, str] = {
    **dict.fromkeys((5, 8, *_points("5.1", "5.3", "5.4", "8.1", "8.2", "8.3")), "high-speed machining, look ahead"),
    **dict.fromkeys((25, 26), "watch over the spindle"),
    **dict.fromkeys((9, 60, 61, 62, 63, 64, *_points("61.1", "61.2", "62.1", "64.1")), "exact stop or cutting mode"),
    **dict.fromkeys((93, 94, 95, *_points("93.1", "96.1", "96.2", "96.3", "96.4")), "kind of feed or speed"),
    **dict.fromkeys((*_points("40.1", "40.2", "41.3", "39.1", "39.2"), 39), "kind of compensation"),
    **dict.fromkeys((*_points("10.3", "10.6", "10.9", "11.3"), 11), "data setting"),
    **dict.fromkeys(_points("22.1", "22.2", "23.1", "80.4", "80.5", "81.1", "81.4"), "limits and synchronous axes"),
}
_FRAMES: Mapping[int, str] = {
    **dict.fromkeys(_points("7.1", "12.1", "16.1", "16.2"), "interpolation on another surface"),
    **dict.fromkeys(_points("13.1"), "end of interpolation on another surface"),
    **dict.fromkeys(_points("50.1"), "end of mirroring"),
    **dict.fromkeys(_points("51.1"), "mirroring"),
    **dict.fromkeys(_points("51.2", "51.4"), "polygon turning or synchronous axes"),
    **dict.fromkeys(_points("50.2", "50.4"), "end of polygon turning or synchronous axes"),
    **dict.fromkeys(_points("53.1", "53.2", "53.6", "68.1", "68.2", "68.3", "68.4", "69.1"), "tilted plane"),
    **dict.fromkeys(_points("43.1", "43.3", "43.4", "43.5", "43.8", "43.9", "44.1", "49.1"), "tool direction"),
    **dict.fromkeys(_points("41.1", "42.1", "41.2", "42.2", "41.4", "42.4", "41.5", "42.5"), "compensation in space"),
    **dict.fromkeys(_points("54.2", "54.4", "92.1", "52.1"), "coordinate system"),
}
_OFFSETS: Mapping[int, str] = dict.fromkeys(_points("54.1"), "further work coordinate system")
_ACTIONS: Mapping[int, str] = {
    **dict.fromkeys(
        _points("28.2", "30.1", "28.1", "30.2", "31.1", "31.2", "31.3", "31.8", "31.9", "37.1"), "reference"
    ),
    **dict.fromkeys(_points("66.1", "65.1", "72.1", "72.2", "84.2", "84.3", "88.1", "88.2"), "call or cycle"),
}
_ISO = {
    Effect.MOTION: _CURVES,
    Effect.SHIFT: _OFFSETS,
    Effect.NONE: _SPEEDS,
    Effect.FRAME: _FRAMES,
    Effect.SINGLE: _ACTIONS,
}

_SURFACES = {
    **dict.fromkeys((7, 107, 112), "interpolation on another surface"),
    113: "end of interpolation on another surface",
}
_MILLS = {
    Effect.NONE: dict.fromkeys((160, 161), "cutter compensation mode"),
    Effect.SINGLE: dict.fromkeys((45, 46, 47, 48), "tool offset by steps") | {12: "pocket", 13: "pocket"},
    Effect.FRAME: _SURFACES,
}
_LATHES = {
    Effect.NONE: dict.fromkeys((160, 161), "compensation mode"),
    Effect.CYCLE: dict.fromkeys((*range(81, 90), 187), "drilling cycle"),
    Effect.CANCEL: {80: "end of cycle"},
    Effect.SINGLE: {29: "return from reference point", 33: "thread"}
    | dict.fromkeys((38, 39, 52), "shift or measurement")
    | dict.fromkeys((68, 69), "second turret"),
    Effect.FRAME: _SURFACES,
}
_HAAS = {
    Effect.NONE: dict.fromkeys((103, 187, 188, 254, 255), "look ahead and accuracy")
    | dict.fromkeys((184, 186, 195, 196), "tapping with a live tool"),
    Effect.SHIFT: dict.fromkeys((*range(110, 130), 154), "work coordinate system"),
    Effect.FRAME: {100: "end of mirroring", 101: "mirroring"} | dict.fromkeys((141, 143, 234, 253), "tool direction"),
    Effect.SINGLE: dict.fromkeys((35, 36, 136, 102, 105), "measurement or output")
    | dict.fromkeys((12, 13, 70, 71, 72, 150), "pocket or row of holes"),
    Effect.CYCLE: dict.fromkeys((77, 153, 155, 156, 174, 178, 241, 242, 243, 244, 245, 246, 247, 248, 249), "drilling"),
}


def _joined(*tables: Mapping[Effect, Mapping[int, str]]) -> dict[Effect, dict[int, str]]:
    found: dict[Effect, dict[int, str]] = {}
    for table in tables:
        for effect, row in table.items():
            found.setdefault(effect, {}).update(row)
    return found


MILLS, LATHES = _joined(_ISO, _MILLS), _joined(_ISO, _LATHES)
HAAS_MILLS, HAAS_LATHES = _joined(_ISO, _MILLS, _HAAS), _joined(_ISO, _LATHES, _HAAS)
"""Codes of which nothing is known here but what they are for."""
