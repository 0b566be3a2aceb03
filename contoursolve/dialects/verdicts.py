"""Writes the table of sympy's verdicts that ships with the package: `python -m contoursolve.dialects.verdicts`."""

import json
from dataclasses import asdict
from pathlib import Path

from contoursolve import analysis
from contoursolve.analysis import derive
from contoursolve.constraints import build_system
from contoursolve.dialects import DIALECTS
from contoursolve.reading import lay_out, stated_sets


def table() -> str:
    """The verdict on every combination of words of every form, by sympy, as JSON."""
    rows = {}
    for dialect in DIALECTS.values():
        for form in dialect.forms:
            for stated in stated_sets(form):
                layout = lay_out(form, stated, frozenset(), None)
                system = build_system(layout.figure, layout.facts)
                rows[system.equations_key] = json.dumps(asdict(derive(system)))
    return "{\n" + ",\n".join(f"{json.dumps(key)}: {row}" for key, row in sorted(rows.items())) + "\n}\n"


if __name__ == "__main__":
    (Path(analysis.__file__).parent / "verdicts.json").write_text(table(), encoding="utf-8", newline="\n")
