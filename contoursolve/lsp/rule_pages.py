"""Pages about rules, in a folder of this server alone: any editor can open them, and none needs a network."""

import atexit
from collections.abc import Iterable
from pathlib import Path
from tempfile import TemporaryDirectory

import contoursolve
from contoursolve.errors import UserError


class Pages:
    """The files that a server writes for its client to show; they are gone when it ends."""

    def __init__(self) -> None:
        self._folder = TemporaryDirectory(prefix="contoursolve-", ignore_cleanup_errors=True)
        atexit.register(self._folder.cleanup)

    def uri(self, code: str, control: "contoursolve.Control | None") -> str:
        """The address of the page about a rule; empty if there is none."""
        name = f"{control.name}-{code}.md" if control is not None else f"{code}.md"
        path = Path(self._folder.name) / name
        try:
            return path.as_uri() if path.exists() else self.write(name, [contoursolve.explain(code, control)])
        except (UserError, OSError):
            return ""

    def write(self, name: str, pieces: Iterable[str]) -> str:
        """Write a file, and say where it is. Raises OSError."""
        path = Path(self._folder.name) / name
        path.write_text("".join(pieces), encoding="utf-8", errors="replace", newline="")
        return path.as_uri()

    def close(self) -> None:
        """Delete them all."""
        self._folder.cleanup()
