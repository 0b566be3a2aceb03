"""Events between two blocks of a program that runs."""

from enum import Enum

from msgspec import Struct


class EventKind(Enum):
    """Change of the knowledge about a program between two blocks."""

    FRESH = "fresh"
    """The next blocks do not run from those before: the tool's position is not known, or was kept."""
    LOST = "lost"
    """The tool's position is lost."""
    ENTER = "enter"
    """The profile of a cycle begins here; the blocks behind it begin here as well."""
    LEAVE = "leave"
    """The part since ENTER has ended: all is as it was there."""
    BARRIER = "barrier"
    """Nothing happens, but no contour goes on beyond this place."""
    STOPPED = "stopped"
    """The program stops here, or is not followed any further."""
    PART = "part"
    """Nobody knows which of two ways runs on from here: one follows, the other one is kept."""
    PAUSE = "pause"
    """The way is kept here: another one follows."""
    MEET = "meet"
    """The next blocks run behind each of some kept ways; only the knowledge that all of them share is left."""
    HEAD = "head"
    """The next blocks may run again, nobody knows how often: the knowledge is kept."""
    AGAIN = "again"
    """It does, from what is known here and was known where it was kept; where nothing new follows from that, what
    follows has run. The last time, the way goes on instead: if anything new followed, nothing is known any more."""

    BEYOND = "beyond"
    """The next blocks have run: they only show how the last blocks before them are read."""
    CALLED = "called"
    """Blocks that are not followed have run behind a move: the tool's position is not known, as behind each move. A
    contour of several moves goes on, and is refused for its start."""

    UNDECIDED = "undecided"
    """Nobody knows what runs on from here, so that a program without jumps ends."""

    MAY_STOP = "may stop"
    """The program stops here, if a decision is taken of which nobody knows; what follows runs where it is not."""

    @property
    def is_open(self) -> bool:
        """Whether a contour may go on beyond it."""
        return self in _OPEN


_OPEN = frozenset(
    {
        EventKind.PART,
        EventKind.PAUSE,
        EventKind.MEET,
        EventKind.HEAD,
        EventKind.AGAIN,
        EventKind.BEYOND,
        EventKind.CALLED,
        EventKind.MAY_STOP,
    }
)


class ProgramEvent(Struct, frozen=True):
    """An event between two blocks, with its line and its reason; `mark` is the number of the kept knowledge (see
    `Block`)."""

    kind: EventKind
    line: int
    reason: str = ""
    mark: int = 0
    ways: tuple[int, ...] = ()
    """The marks of the ways that meet."""
    is_last: bool = False
    called: str = ""
    """The name of what is called and is nowhere to be found."""
    unread: str = ""
    """The word of the control that is not read, where that is why."""
    is_told: bool = False
    """Whether what makes it has been told where it began."""
