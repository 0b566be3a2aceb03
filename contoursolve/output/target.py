"""Files that are written: whole or not at all, and never over another one unless that is asked for."""

import os
import tempfile
from pathlib import Path


class TargetError(ValueError):
    """A file that cannot be written, or should not be; the message says which and what to do."""


def check_target(target: Path, sources: tuple[str, ...], *, is_forced: bool) -> None:
    """Raise TargetError if the file exists and may not be replaced, or is one of the sources."""
    for source in sources:
        if target.exists() and Path(source).exists() and target.samefile(source):
            raise TargetError(f"{target} is the program itself; name another file")
    if target.is_dir():
        raise TargetError(f"{target} is a directory, not a file")
    if not target.parent.is_dir():
        raise TargetError(f"{target.parent} is no directory; make it first")
    if target.exists() and not is_forced:
        raise TargetError(f"{target} exists; --force replaces it")


def write_whole(target: Path, data: bytes) -> None:
    """Write a file beside the target and move it into its place. Raises TargetError if that fails."""
    place = target.resolve()
    try:
        handle, name = tempfile.mkstemp(dir=place.parent, prefix=f".{place.name}.")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            Path(name).chmod(_mode(place))
            Path(name).replace(place)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise TargetError(f"{target} cannot be written: {error.strerror}") from None


def _mode(place: Path) -> int:
    """The permissions of the file that is replaced, or those of a new one."""
    if place.exists():
        return place.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask
