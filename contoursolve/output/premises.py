"""Premises of contours, as text and as plain data."""

from collections.abc import Iterator
from typing import Any

from contoursolve.diagnostics import members
from contoursolve.reading import Convention, Premises


def premise_texts(premises: Premises, control: str) -> Iterator[str]:
    """Lines of the premises of contours: each setting on its own, and all assumptions together in the last one."""
    yield from (_convention_text(each, control) for each in premises.conventions)
    by_grade: dict[str, list[str]] = {}
    for each in premises.assumptions:
        by_grade.setdefault(each.source.evidence.value, []).append(each.meaning)
    if by_grade:
        told = (f"{'; '.join(meanings)} ({grade})" for grade, meanings in by_grade.items())
        yield f"depends on: {'; '.join(told)}"


def _convention_text(convention: Convention, control: str) -> str:
    setting = convention.setting
    name = f"{control}.{setting.name}" if control else setting.name
    return f"{convention.evidence.value}: {convention.meaning} (--setting {name}={convention.value})"


def premise_data(premises: Premises) -> dict[str, Any]:
    """The same as members of an object."""
    return {
        "conventions": [
            {"setting": each.setting.name, **members(each, "value meaning evidence")} for each in premises.conventions
        ],
        "assumptions": [members(each, "name meaning source") for each in premises.assumptions],
    }
