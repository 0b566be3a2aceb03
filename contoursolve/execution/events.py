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
    """What follows begins here, and so does what comes behind it: the profile of a cycle, or one part of a branch."""
    LEAVE = "leave"
    """What ENTER began has ended: all is as it was there."""
    BARRIER = "barrier"
    """Nothing happens, but no contour goes on beyond this place."""
    STOPPED = "stopped"
    """The program stops here, or is not followed any further."""


class ProgramEvent(Struct, frozen=True):
    """What happens between two blocks, on which line, and why; `mark` is that of the block before which it was kept
    what is known (see `Block`)."""

    kind: EventKind
    line: int
    reason: str = ""
    mark: int = 0
