"""What happens between two blocks of a program that runs."""

from enum import Enum

from msgspec import Struct


class EventKind(Enum):
    """What happens to what is known between two blocks."""

    FRESH = "fresh"
    """What follows does not run from what stands before it: where the tool stands is not known, or was kept."""
    LOST = "lost"
    """Where the tool stands is not known any more."""
    ENTER = "enter"
    """What follows begins here, and so does what comes behind it: the profile of a cycle."""
    LEAVE = "leave"
    """What ENTER began has ended: all is as it was there."""
    BARRIER = "barrier"
    """Nothing happens, but no contour goes on beyond this place."""
    STOPPED = "stopped"
    """The program stops here, or is not followed any further."""
    PART = "part"
    """Nobody knows which of two ways runs on from here: one follows, the other one is kept."""
    PAUSE = "pause"
    """The way is kept here: another one follows."""
    MEET = "meet"
    """What follows runs behind each of some ways that were kept; only in what all of them agree is anything known."""
    HEAD = "head"
    """What follows may run again, nobody knows how often: what is known is kept."""
    AGAIN = "again"
    """It does, from what is known here and was known where it was kept; where nothing new follows from that, what
    follows has run. The last time, the way goes on instead: if anything new followed, nothing is known any more."""

    BEYOND = "beyond"
    """What follows has run: it only shows what the last blocks before it are."""
    CALLED = "called"
    """What is not followed has run behind a move: where the tool stands is not known, as behind each move. A contour of
    several moves goes on, and is refused for its start."""

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
    """What happens between two blocks, on which line, and why; `mark` is the number under which it is kept, or was,
    what is known (see `Block`)."""

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
