"""Every byte that the commands print and write is as it was when `tests/golden/record.py` recorded it."""

from pathlib import Path

import pytest
from record import GROUPS, Case, load, run

STRIDE = 150
"""Of the records, one in so many is compared by default, and all in the slow part."""

CASES = [
    pytest.param(case, result, id=f"{group}-{number}", marks=() if number % STRIDE == 0 else pytest.mark.slow)
    for group in GROUPS
    for number, (case, result) in enumerate(load(group))
]


@pytest.mark.parametrize(("case", "result"), CASES)
def test_what_a_command_prints_and_writes_is_as_recorded(case: Case, result: dict[str, object], tmp_path: Path) -> None:
    found = run(case, tmp_path)
    for name, expected in result.items():
        assert found[name] == expected, (case.arguments, name)
