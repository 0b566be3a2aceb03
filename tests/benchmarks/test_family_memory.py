"""Memory of families, each measured in a process of its own; CONTOURSOLVE_ROWS sets how many rows (1,000,000)."""

import os
import sys

import pytest

pytest.importorskip("pyarrow")
pytest.importorskip("resource")
from growth import run

ROWS = int(os.environ.get("CONTOURSOLVE_ROWS", "1000000"))


def test_a_result_takes_at_most_200_mb_more_than_itself(capsys: pytest.CaptureFixture[str]) -> None:
    found = run(ROWS, "memory")
    over = found["peak"] - found["before"] - found["result"]
    with capsys.disabled():
        sys.stdout.write(f"\n{ROWS:,} rows: {found['result']:.0f} MB, and {over:.0f} MB more while it is made\n")
    assert over <= 200


def test_a_file_of_any_length_takes_at_most_500_mb(capsys: pytest.CaptureFixture[str]) -> None:
    found = run(ROWS, "file")
    with capsys.disabled():
        sys.stdout.write(f"\n{ROWS:,} rows to Parquet: {found['peak']:.0f} MB at most\n")
    assert found["peak"] <= 500
