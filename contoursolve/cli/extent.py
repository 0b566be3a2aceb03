"""Whether a sweep is larger than anybody may have meant."""

import sys
from pathlib import Path
from shutil import disk_usage

from contoursolve.cli.options import CouldNotRunError
from contoursolve.cli.progress import duration
from contoursolve.families import MOST_ROWS, CompiledSweep, Parts, room_of, seconds_of


def check_extent(ready: CompiledSweep, parts: Parts | None, target: Path | None, *, is_forced: bool) -> None:
    """Raise CouldNotRunError for more contours than are begun at a word, or a file that the disk has no room for."""
    rows = ready.ranges.count
    if rows > sys.maxsize:
        raise CouldNotRunError(f"{rows:.1e} contours cannot be counted; vary fewer words, or take larger steps")
    if is_forced:
        return
    told = []
    if rows > MOST_ROWS:
        took = duration(seconds_of(ready))
        told.append(f"{rows:,} contours are more than {MOST_ROWS:,}: about {took} on one thread, by the first ones")
    if parts is not None and target is not None:
        room, free = room_of(parts, is_text=target.suffix.lower() == ".csv"), disk_usage(target.parent).free
        if room > free:
            told.append(
                f"{target}, with the rows that are kept beside it until it is whole, may need {size(room)}, where "
                f"{size(free)} are free"
            )
    if told:
        raise CouldNotRunError(f"{'; '.join(told)}; take larger steps, or give --force")


def size(count: float) -> str:
    """A number of bytes in the unit that fits: `3.1 GB`."""
    for unit in ("bytes", "kB", "MB", "GB"):
        if count < 1000:  # noqa: PLR2004 - decimal prefixes
            return f"{count:.3g} {unit}"
        count /= 1000
    return f"{count:,.1f} TB"
