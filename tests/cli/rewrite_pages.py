"""Writes what the commands of README.md and docs/ print now into these pages, and the pictures that they draw:
`python tests/cli/rewrite_pages.py`."""

from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from test_readme import PAGES, PICTURES, ROOT, SHOWN, compare
from tip_numbers import tip_numbers


def rewrite() -> None:
    for page, command, output in (each.values for each in SHOWN):
        with TemporaryDirectory() as folder, pytest.MonkeyPatch.context() as patch:
            shown, printed = compare(Path(folder), patch, page, command, output)
            for picture in Path(folder).glob("*.svg"):
                if (PICTURES / picture.name).exists():
                    (PICTURES / picture.name).write_bytes(picture.read_bytes())
        if shown != printed:
            path = ROOT / page
            end = output[len(output.rstrip()) :]
            lines = "\n".join(f"    {line}".rstrip() for line in printed)
            head = f"    $ contoursolve {command}\n"
            text = path.read_text(encoding="utf-8")
            path.write_text(text.replace(head + output, head + lines + end, 1), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    assert PAGES
    rewrite()
    tip_numbers().save(PICTURES / "tips.svg")
