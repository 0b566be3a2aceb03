"""Writes the tables of sympy's results that ship with the package: `python -m contoursolve.controls.write_tables`."""

import json
from collections.abc import Iterator
from pathlib import Path

from msgspec.structs import asdict

from contoursolve import solving
from contoursolve.controls.all_controls import CONTROLS
from contoursolve.geometry import Fact, System, build_system
from contoursolve.reading import ContourForm, lay_out, stated_sets
from contoursolve.solving import (
    Determinacy,
    circuits_for_all_values,
    derive,
    derive_identity,
    is_affine,
)


def systems() -> dict[str, System]:
    """The equations of every combination of words of every form, by their key."""
    layouts = (
        lay_out(form, stated, frozenset())
        for control in CONTROLS.values()
        for form in control.forms
        for stated in stated_sets(form)
    )
    found = (build_system(layout.figure, layout.facts) for layout in layouts)
    return {system.equations_key: system for system in found}


def table() -> str:
    """The verdict on each of them, by sympy, as JSON."""
    return _write({key: json.dumps(asdict(_verdict(system))) for key, system in systems().items()})


_VERDICTS: dict[str, Determinacy] = {}


def _verdict(system: System) -> Determinacy:
    """The verdict of sympy today, each system once."""
    if system.equations_key not in _VERDICTS:
        _VERDICTS[system.equations_key] = derive(system)
    return _VERDICTS[system.equations_key]


def identity_table() -> str:
    """For every smallest set of words that say the same: the formula that ties them, by sympy, as JSON."""
    rows = {}
    for control in CONTROLS.values():
        for form in control.forms:
            for facts, formula in _identities(form):
                key = f"{form.name}: {' '.join(sorted(fact.given for fact in facts if fact.given))}"
                rows[key] = json.dumps(formula)
    return _write(rows)


def _identities(form: ContourForm) -> Iterator[tuple[tuple[Fact, ...], str]]:
    layout = lay_out(form, frozenset().union(*stated_sets(form)), frozenset())
    if is_affine(layout.facts):
        system = build_system(layout.figure, layout.facts)
        circuits = circuits_for_all_values(system).found
        yield from ((each.facts, derive_identity(system, each.facts)) for each in circuits)
        return
    for stated in stated_sets(form):
        layout = lay_out(form, stated, frozenset())
        if any(fact.foot or fact.centers for fact in layout.facts):
            continue  # that a contact lies on both elements says nothing about words
        system = build_system(layout.figure, layout.facts)
        verdict = _verdict(system)
        tied = tuple(layout.facts[index] for index in verdict.tied)
        formula = derive_identity(system, tied)
        if formula and len(layout.facts) == len(system.unknowns) + 1:
            yield tied, formula


def _write(rows: dict[str, str]) -> str:
    return "{\n" + ",\n".join(f"{json.dumps(key)}: {row}" for key, row in sorted(rows.items())) + "\n}\n"


if __name__ == "__main__":
    folder = Path(solving.__file__).parent
    (folder / "verdicts.json").write_text(table(), encoding="utf-8", newline="\n")
    (folder / "identities.json").write_text(identity_table(), encoding="utf-8", newline="\n")
