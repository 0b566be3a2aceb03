"""What is said of facts beside words: what they contradict or repeat, by how much, and what to write instead."""

import pytest
from click.testing import CliRunner

from contoursolve import Answer, Diagnostic, Status, solve
from contoursolve.cli import main
from contoursolve.diagnostics import ProgramError

LINES = "G111 A180. K-30. B120. X100."
ONE = f"{LINES} P5. Q5."
PAIR_TEXT = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"


def told(block: str, *facts: str) -> tuple[Answer, dict[str, Diagnostic]]:
    """What becomes of a block, and its findings by their codes."""
    (answer,) = solve(block, start="X40. Z0." if "G111" in block else None, facts=facts).answers
    return answer, {each.code: each for each in answer.diagnostics}


@pytest.mark.parametrize(
    "program", [f"G00 X40. Z0.\n{ONE}\nG00 X40. Z0.\n{ONE}", f"{PAIR_TEXT}\nG0 X50 Y0\n" + PAIR_TEXT]
)
def test_a_fact_for_one_of_two_contours_is_refused(program: str) -> None:
    with pytest.raises(ProgramError, match="2 contours"):
        solve(program, facts=["length of line 1 = 30"])
    blocks = [part for line in program.splitlines() for part in ("--block", line)]
    done = CliRunner().invoke(main, ["check", *blocks, "--fact", "length of line 1 = 30"])
    assert (done.exit_code, done.stdout) == (2, "")
    assert "(contoursolve: ...)" in done.stderr


def test_a_size_that_is_asked_for_has_no_limit_to_write_but_what_it_follows_from() -> None:
    _, found = told(f"{LINES} P?", "radius of corner 1 = 80")
    assert found["g111-corner-too-large"].help.startswith("change radius of corner 1 = 80:")
    assert [each.text for each in found["g111-corner-too-large"].labels] == [""]


PASSES = f"G00 X40. Z0.\n{LINES} P5. Q? (contoursolve: corner 1 passes beside {{}})"
CHAIN = "G17 G90 G42 G0 X100 Y20\n{}\n{} (contoursolve: arc tangent to line 1)"


@pytest.mark.parametrize(
    ("text", "control", "status"),
    [
        # The centre of corner 1 lies at Z-27.113, X50: 10 mm beside the place, and 4.910 mm beside the other one.
        (PASSES.format("[Z-27.1132487 X70.] at 5"), "yasnac-lx3", Status.UNDERDETERMINED),
        (PASSES.format("[Z-31. X44.] at 0.5"), "yasnac-lx3", Status.CONFLICTING),
        (CHAIN.format("G3 X27 Y28 R50 ,R?", "G3 X-45 Y26 R40"), "nct-99m", Status.REJECTED),
    ],
)
def test_a_fact_that_nothing_needs_is_compared_beside_a_size_that_nothing_tells(
    text: str, control: str, status: Status
) -> None:
    assert solve(text, control=control).answers[0].status is status
