"""Settings of controls: how rows of them are made, and those of every control."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from decimal import Decimal
from typing import Any

from contoursolve.controls.further import WORDS
from contoursolve.controls.tool_settings import TOOL_SETTINGS
from contoursolve.diagnostics import OWN, Evidence, Source
from contoursolve.execution import MOST_BLOCKS, Limit
from contoursolve.reading import ARGUMENTS, Control, Setting, WithoutPoint
from contoursolve.tolerance import LARGEST, TRAVEL


def own_source(place: str) -> Source:
    """The source of what contoursolve takes by itself."""
    return Source(OWN, place, Evidence.ASSUMED)


def setting(
    name: str,
    meaning: str,
    values: Mapping[str, str],
    source: Source,
    changes: Mapping[str, Callable[[Any], Any]] | None = None,
) -> Setting:
    """One whose first value is in force unless told otherwise."""
    return Setting(name, meaning, values, next(iter(values)), source, changes=changes or {})


def number_setting(values: Mapping[str, str], source: Source) -> Setting:
    """The setting of numbers without a point, `increment` or `calculator`; the first of them is in force."""
    changes = {"increment": _reading(WithoutPoint.LEAST_INCREMENTS), "calculator": _reading(WithoutPoint.AS_WRITTEN)}
    return setting("number", "what a number without a decimal point means", values, source, changes)


def _reading(meant: WithoutPoint) -> Callable[[Control], Control]:
    """From a control to the one for which a number without a point means this."""

    def change(control: Control) -> Control:
        lexicon = control.modes.lexicon
        words = replace(lexicon, numbers=replace(lexicon.numbers, without_point=meant))
        return replace(control, modes=replace(control.modes, lexicon=words))

    return change


def arguments_setting(source: Source) -> Setting:
    """The setting of arguments of G65 without a point, on which a machine parameter may decide."""
    return setting(
        ARGUMENTS,
        "what an argument of G65 without a decimal point means",
        {
            "increment": "least increments of its address: lengths 0.001 mm or 0.0001 inch, A B C 0.001 deg",
            "whole": "what it says, as with a point",
        },
        source,
    )


def first_motion_setting(source: Source) -> Setting:
    """The setting of the motion that is in force before the program states one; its samples rely on G1."""
    return setting(
        "first-motion",
        "which motion is in force before the program states one",
        {"G1": "lines by G1", "none": "none: the program must state it"},
        source,
        changes={"none": lambda control: replace(control, motion=None)},
    )


def angle_sense_setting(source: Source, name: str = "angle-sense", line: str = "a line") -> Setting:
    """The setting that lets lines run against their angles, or not."""
    return setting(
        name,
        f"whether {line} may run against its angle",
        {
            "line": "it may: the angle is that of the line, either way",
            "ray": "it may not: the angle is the direction of travel",
        },
        source,
    )


def redundant_angle_setting(source: Source, default: str) -> Setting:
    """The setting of an angle beside both coordinates, `check` or `error`; the default one is in force."""
    values = {"check": "it may stand there if it agrees", "error": "it must not stand there"}
    ordered = {name: values[name] for name in sorted(values, key=lambda name: name != default)}
    meaning = "an angle beside both coordinates, after a line that has an end"
    return setting("redundant-angle", meaning, ordered, source)


def arc_chamfer_setting(what: str, source: Source, corner: str = "corner") -> Setting:
    """The setting of how the size of a chamfer is measured on an arc."""
    values = {
        "chord": f"straight from the {corner}",
        "arc_length": "along the arc; contoursolve does not compute this",
    }
    return setting("chamfer-on-arc", f"how {what} is measured on an arc", values, source)


def length_setting(name: str, meaning: str, default: str, source: Source, most: int = 1) -> Setting:
    """One whose value is a number of mm, up to so many."""
    return Setting(name, meaning, {default: "mm"}, default, source, bounds=(Decimal("0.001"), Decimal(most)))


TRAVEL_SETTING = length_setting(
    "travel",
    "how far from the start point solutions are searched for that no closed form gives",
    f"{TRAVEL:.0f}",
    own_source("no machine is larger"),
    most=int(LARGEST),
)
BLOCKS_SETTING = Setting(
    Limit().setting,
    "how many blocks may run again, or in another file, before a program is said to go on for ever",
    {f"{MOST_BLOCKS}": "blocks"},
    f"{MOST_BLOCKS}",
    own_source("programs are shorter, and one that never ends stops soon"),
    bounds=(Decimal(1), Decimal(100_000_000)),
    unit="blocks",
)
SUSPICIONS_SETTING = setting(
    "suspicions",
    "whether legal programs that are hardly meant are warned of",
    {"on": "each with what was probably meant", "off": "not at all"},
    own_source("one right program of fifty at most is warned of without a reason"),
)
SETTINGS_OF_ALL = (TRAVEL_SETTING, BLOCKS_SETTING, SUSPICIONS_SETTING, WORDS, *TOOL_SETTINGS)
"""Those of every control."""


def with_default(settings: Iterable[Setting], name: str, default: str) -> tuple[Setting, ...]:
    """Settings, of which one has another value in force."""
    return tuple(replace(each, default=default) if each.name == name else each for each in settings)
