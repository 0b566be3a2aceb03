"""A small disk of its own in memory, which a test fills."""

import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest


class SmallDisk:
    """A disk of 64 kB, mounted on a folder; where that is not permitted, the test is skipped."""

    def __init__(self, folder: Path) -> None:
        if sys.platform != "linux":
            pytest.skip("only Linux mounts a disk in memory")
        folder.mkdir()
        command = ["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", str(folder)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=False)
        except OSError as error:
            pytest.skip(f"mount does not run: {error}")
        if done.returncode:
            pytest.skip(f"no disk may be mounted here: {done.stderr.strip()}")
        self.folder, self._filling = folder, folder / "filling.bin"

    def fill(self) -> None:
        """Leave no room."""
        with suppress(OSError), self._filling.open("wb", buffering=0) as file:
            while True:
                file.write(bytes(4096))

    def make_room(self) -> None:
        """Take the filling away."""
        self._filling.unlink()

    def names(self) -> list[str]:
        """The names of the files besides the filling."""
        return sorted(each.name for each in self.folder.iterdir() if each != self._filling)

    def unmount(self) -> None:
        """Take the disk away."""
        subprocess.run(["umount", "--lazy", str(self.folder)], check=True)
