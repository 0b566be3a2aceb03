"""Executes the notebooks, each in a kernel of its own: `python tests/external/run_notebooks.py [NOTEBOOK...]`.

Writes their outputs into them, or with `--into FOLDER` into copies there.
"""

import argparse
import asyncio
import os
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import nbformat  # takes seconds, and whoever collects tests imports this module

FOLDER = Path(__file__).parents[2] / "notebooks"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))
CHECKS = Path(__file__).parent / "notebook_checks"
"""What must hold after each notebook, by its number; a reader of the notebook does not need it."""

SECONDS = 300
"""For one cell, on a loaded machine."""


def execute(path: Path) -> "nbformat.NotebookNode":
    """The notebook with the outputs that a clean kernel gives it; raises CellExecutionError.

    What tells of the machine and of the moment is left out: versions and times.
    """
    import nbformat  # noqa: PLC0415
    from nbclient import NotebookClient  # noqa: PLC0415

    notebook = nbformat.read(path, as_version=4)
    check = nbformat.v4.new_code_cell((CHECKS / f"check_{path.name[:2]}.py").read_text(encoding="utf-8"))
    notebook.cells.append(check)
    client = NotebookClient(
        notebook,
        timeout=SECONDS,
        kernel_name="python3",
        resources={"metadata": {"path": str(FOLDER)}},
        record_timing=False,
        coalesce_streams=True,
        store_widget_state=False,
    )
    client.execute()
    notebook.cells.remove(check)
    notebook.metadata["language_info"] = {"name": "python"}
    return notebook


def text_of(notebook: "nbformat.NotebookNode") -> str:
    """The file of a notebook; the same notebook gives the same text."""
    import nbformat  # noqa: PLC0415

    return nbformat.writes(notebook, indent=1, sort_keys=True, ensure_ascii=False) + "\n"


def main() -> int:
    """Execute the notebooks that are named, or all of them."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("notebooks", nargs="*", type=Path, default=NOTEBOOKS)
    parser.add_argument("--into", type=Path, help="the folder for the results, instead of the notebooks themselves")
    arguments = parser.parse_args()
    from nbclient.exceptions import CellExecutionError  # noqa: PLC0415

    if sys.platform == "win32":
        # The sockets of a kernel need an event loop that can wait for them.
        asyncio.set_event_loop_policy(asyncio.WindowsSelectorEventLoopPolicy())
    failed = 0
    with tempfile.TemporaryDirectory() as clean:
        # No startup files, kernels and settings of whoever runs this.
        os.environ |= {"IPYTHONDIR": clean, "JUPYTER_CONFIG_DIR": clean, "JUPYTER_DATA_DIR": clean}
        for path in arguments.notebooks:
            try:
                text = text_of(execute(path))
            except CellExecutionError as error:
                sys.stderr.write(f"{path.name}: {error}\n")
                failed += 1
                continue
            target = arguments.into / path.name if arguments.into else path
            target.write_text(text, encoding="utf-8", newline="\n")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
