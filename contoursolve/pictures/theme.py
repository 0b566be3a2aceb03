"""Colours and dashes of pictures: one table a theme, one dash a role."""

from collections.abc import Mapping
from enum import Enum


class Role(Enum):
    """Function of a stroke or a text in a picture; the value names it in a page's style sheet."""

    PAPER = "paper"
    INK = "ink"
    """The path, points and titles."""
    MUTED = "muted"
    """Construction lines, axes and remarks."""
    GHOST = "ghost"
    """Other contours that the block would allow."""
    CANDIDATE = "candidate"
    """One of several contours, where nothing chooses between them."""
    RAPID = "rapid"
    """Moves in rapid traverse."""
    GIVEN = "given"
    DERIVED = "derived"
    IGNORED = "ignored"
    CONFLICTING = "conflicting"
    FREE = "free"
    DETERMINED = "determined"
    """An element of a chain that its data fix, in the blue in which a control with free contours shows it."""
    SEVERAL = "several"
    """One of several solutions for an element of a chain, in the green of such a control."""
    OPEN = "open"
    """An element of a chain for which there are too few data, in the red of such a control."""
    GUESSED = "guessed"
    """An element of a sketch that a guess has chosen among several."""
    SOLUTION_A = "solution-a"
    SOLUTION_B = "solution-b"
    """Parts of one of two solutions that the other one has not."""
    SOLVED_FIELD = "solved-field"
    REFUSED_FIELD = "refused-field"
    OTHER_FIELD = "other-field"
    """Fields of a map."""
    TOOL = "tool"
    TRACK = "track"
    """A tool, and its path beside a contour."""
    REST = "rest"
    """Material that the tool leaves."""
    LEVEL_1 = "level-1"
    LEVEL_2 = "level-2"
    LEVEL_3 = "level-3"
    LEVEL_4 = "level-4"
    LEVEL_5 = "level-5"
    LEVEL_6 = "level-6"
    LEVEL_7 = "level-7"
    LEVEL_8 = "level-8"
    """Fields of a map by the value of a result, from the least to the largest."""


LEVELS = tuple(role for role in Role if role.value.startswith("level-"))
"""Roles of values in maps alone."""

CHAINS = (Role.DETERMINED, Role.SEVERAL, Role.OPEN, Role.GUESSED, Role.SOLUTION_A, Role.SOLUTION_B)
"""Roles of elements of chains, and of two solutions."""

TOOLS = (Role.TRACK, Role.TOOL, Role.REST)
"""Roles of pictures with a tool alone."""

MEANINGS: Mapping[Role, str] = {
    Role.GIVEN: "given",
    Role.DERIVED: "worked out",
    Role.IGNORED: "ignored",
    Role.CONFLICTING: "in conflict, or cannot be cut",
    Role.FREE: "still free",
    Role.DETERMINED: "determined",
    Role.SEVERAL: "one of several solutions",
    Role.OPEN: "too few data",
    Role.GUESSED: "chosen by a guess",
    Role.SOLUTION_A: "solution A alone",
    Role.SOLUTION_B: "solution B alone",
    Role.REST: "stays in the corner",
    Role.CANDIDATE: "one of several solutions",
    Role.RAPID: "rapid move",
    Role.GHOST: "another solution",
    Role.MUTED: "construction",
}
"""Legend text of a role."""

DASHES: Mapping[Role, tuple[float, ...]] = {
    Role.MUTED: (9.0, 2.5, 2.0, 2.5),
    Role.GHOST: (7.0, 4.0),
    Role.CANDIDATE: (12.0, 3.0),
    Role.RAPID: (5.0, 4.0),
    Role.DERIVED: (8.0, 2.0),
    Role.IGNORED: (1.5, 3.0),
    Role.CONFLICTING: (10.0, 3.0, 2.0, 3.0, 2.0, 3.0),
    Role.FREE: (4.0, 3.0),
    Role.SEVERAL: (14.0, 4.0),
    Role.OPEN: (3.0, 5.0),
    Role.GUESSED: (1.0, 4.0),
    Role.SOLUTION_B: (9.0, 4.0),
    Role.TRACK: (9.0, 2.5),
}
"""Pixels on and off of a role's thin lines; solid without. They tell the states apart without colour."""

_COLORS: dict[Role, tuple[str, ...]] = {
    Role.PAPER: ("#ffffff", "#10151f"),
    Role.INK: ("#111827", "#f3f4f6"),
    Role.MUTED: ("#5b6472", "#9aa5b5"),
    Role.GHOST: ("#6b7280", "#8e99a9"),
    Role.CANDIDATE: ("#0e6d84", "#67e8f9"),
    Role.RAPID: ("#5b6472", "#9aa5b5"),
    Role.GIVEN: ("#1d4ed8", "#93c5fd"),
    Role.DERIVED: ("#15693a", "#86efac"),
    Role.IGNORED: ("#8a4b00", "#fcd34d"),
    Role.CONFLICTING: ("#b91c1c", "#fca5a5"),
    Role.FREE: ("#7e22ce", "#d8b4fe"),
    Role.DETERMINED: ("#0b3fb3", "#5ea3ff"),
    Role.SEVERAL: ("#3d7a00", "#9be31c"),
    Role.OPEN: ("#c8102e", "#ff7a85"),
    Role.GUESSED: ("#0e6d84", "#67e8f9"),
    Role.SOLUTION_A: ("#0062ad", "#66b3ff"),
    Role.SOLUTION_B: ("#a85500", "#ffb057"),
    Role.TOOL: ("#0f6f78", "#5eead4"),
    Role.TRACK: ("#0f6f78", "#5eead4"),
    Role.REST: ("#8a4b00", "#fcd34d"),
    Role.SOLVED_FIELD: ("#eaf1fd", "#1b3050"),
    Role.REFUSED_FIELD: ("#f0cdc8", "#5a2a27"),
    Role.OTHER_FIELD: ("#dccfee", "#3a2a55"),
}
"""The colours of a role: light and dark."""


def _between(low: str, high: str, share: float) -> str:
    """A colour between two, by the share of the second."""
    pairs = ((int(low[at : at + 2], 16), int(high[at : at + 2], 16)) for at in (1, 3, 5))
    return "#" + "".join(f"{round(one + share * (other - one)):02x}" for one, other in pairs)


_LEVEL_ENDS = ("#f4f8fe", "#86a6f0"), ("#13233c", "#2c4f8c")
"""The least and the largest level, light and dark: ink can be read on all of them."""

_COLORS |= {
    role: tuple(_between(*ends, number / (len(LEVELS) - 1)) for ends in _LEVEL_ENDS)
    for number, role in enumerate(LEVELS)
}

LIGHT_COLORS, DARK_COLORS = ({role: colors[number] for role, colors in _COLORS.items()} for number in (0, 1))


class Theme(Enum):
    """The colours of a picture."""

    LIGHT = "light"
    DARK = "dark"
    PAGE = "page"
    """For a page of HTML: light or dark as the reader prefers; a page overrules it with `--cs-ink`, `--cs-paper`, ...
    Where style sheets are taken out, and in PNG, it is light."""

    @property
    def colors(self) -> Mapping[Role, str]:
        """The colour of every role; for a page those of the light theme."""
        return DARK_COLORS if self is Theme.DARK else LIGHT_COLORS
