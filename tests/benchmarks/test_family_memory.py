"""Memory of families, each measured in a process of its own."""

import sys

import pytest

pytest.importorskip("pyarrow")
from growth import run

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the peak is read from /proc")
ROWS = 1_000_000


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
