"""Events between two blocks of a program that runs, and whoever follows it."""

from collections.abc import Generator, Sequence
from enum import Enum
from typing import Any

from msgspec import Struct

from contoursolve.gcode import Block


class EventKind(Enum):
    """An event between two blocks. Whoever follows the program has read all blocks before it goes on."""

    FRESH = "fresh"
    """The next blocks do not run from those before: the tool's position is not known, or was kept."""
    LOST = "lost"
    """A place that is not followed: the tool's position and the modes are not known."""
    ENTER = "enter"
    """The profile of a cycle begins here."""
    LEAVE = "leave"
    """The profile of a cycle has ended: all is as it was where it began."""
    BARRIER = "barrier"
    """Nothing happens, but no contour goes on beyond this place."""
    STOPPED = "stopped"
    """The program stops here, or is not followed any further."""
    PART = "part"
    """Nobody knows which of two ways runs on from here: one follows."""
    MEET = "meet"
    """The next blocks run behind others than those before, or behind others as well."""
    HEAD = "head"
    """The next blocks may run again, nobody knows how often."""
    BEYOND = "beyond"
    """The next blocks have run: they only show how the last blocks before them are read."""
    CALLED = "called"
    """Blocks that are not followed have run behind a move: the tool's position is not known, as behind each move. A
    contour of several moves goes on, and is refused for its start."""
    UNDECIDED = "undecided"
    """Nobody knows what runs on from here, so that a program without jumps ends."""
    REFUSED = "refused"
    """The control stops at a statement, with an alarm; what follows is read as if it went on."""
    READ_AS = "read as"
    """A condition is read as few expect; the words of the reason tell how."""
    MAY_STOP = "may stop"
    """The program stops here, if a decision is taken of which nobody knows; what follows runs where it is not."""

    @property
    def is_open(self) -> bool:
        """Whether a contour may go on beyond it."""
        return self in _OPEN

    @property
    def loses(self) -> bool:
        """Whether the tool's position is not known behind it."""
        return self in _LOSING


_OPEN = frozenset(
    {
        EventKind.PART,
        EventKind.MEET,
        EventKind.HEAD,
        EventKind.BEYOND,
        EventKind.CALLED,
        EventKind.REFUSED,
        EventKind.READ_AS,
        EventKind.MAY_STOP,
    }
)
_LOSING = frozenset({EventKind.LOST, EventKind.STOPPED, EventKind.CALLED})


class ProgramEvent(Struct, frozen=True):
    """An event between two blocks, with its line and its reason."""

    kind: EventKind
    line: int = 0
    reason: str = ""
    mark: int = 0
    """A place where FRESH goes on with what was known before a block: the mark of that block."""
    called: str = ""
    """The name of what is called and is nowhere to be found."""
    unread: str = ""
    """The word of the control that is not read, where that is why."""
    keeps_modes: bool = False
    """Whether it loses the tool's position alone, and no mode."""
    is_told: bool = False
    """Whether what makes it has been told where it began."""


class WrittenBack(Struct, frozen=True):
    """Blocks that say what SAVE brings back, as texts; and what they leave out, or why there can be none."""

    lines: tuple[str, ...] = ()
    left_out: str = ""
    refused: str = ""


class Follower:
    """Whoever follows a program as it runs; this one knows and finds nothing. The machine carries what he knows along
    each way, beside the variables, and looks into none of it; none of these changes it, each gives something new."""

    def begin(self, _event: ProgramEvent | None) -> Any:
        """The state where the program begins, or blocks that do not run from those before."""
        return None

    def read(self, known: Any, _blocks: Sequence[Block], _event: ProgramEvent | None) -> Generator[Any, None, Any]:
        """Read blocks up to an event, or to the end: all that is found in them, one by one. Returns what is known."""
        yield from ()
        return known

    def join(self, _several: Sequence[Any], _reason: str) -> Any:
        """The states on each of several ways; on none of them, all that follows has been read."""
        return None

    def is_same(self, _one: Any, _other: Any) -> bool:
        """Whether as much is known."""
        return True

    def enter(self, known: Any) -> Any:
        """The state in which a subprogram begins that saves the modes."""
        return known

    def restore(self, _entry: Any, now: Any, _reason: str, _line: int) -> Any:
        """The state where a subprogram ends that saves the modes, given what was known where it was called."""
        return now

    def write_back(self, _entry: Any, _now: Any, _earlier: Sequence[Block], _ran: Sequence[Block]) -> WrittenBack:
        """The same in blocks, for a program without calls, given all blocks that have run up to the call, and since."""
        return WrittenBack()

    def lose(
        self,
        known: Any,
        _reason: str,
        _line: int,
        *,
        modes: bool = False,  # noqa: ARG002
        in_passes: bool = False,  # noqa: ARG002
    ) -> Any:
        """The state without the tool's position, which may be another one from pass to pass; and without the
        modes, if what has run may have set them."""
        return known
