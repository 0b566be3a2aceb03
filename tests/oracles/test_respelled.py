"""Random Fanuc contours respelled for SINUMERIK and ISG come out where an oracle that shares no code has them."""

import re
from collections import Counter
from collections.abc import Sequence
from math import inf
from random import Random

import pytest
from generate_fanuc import disturbed, random_lathe, random_mill
from oracle import elements_of
from oracle_corners import gap
from oracle_fanuc import Machine, run
from respell import Line, isg, sinumerik

from contoursolve import solve

SINUMERIK, ISG = "siemens-840d", "isg"
ALIKE = {
    SINUMERIK: {f"{SINUMERIK}.closing-incremental": "error", f"{SINUMERIK}.redundant-angle": "check"},
    ISG: {f"{ISG}.pair-sense": "ray"},
}
"""Settings with which the oracle and the control agree."""
LATHE = {SINUMERIK: Machine(is_lathe=True, guard=0.0), ISG: Machine(is_lathe=True, guard=0.0, strict=True, sense="ray")}
MILL = Machine(is_lathe=False, guard=0.0)
TYPED = {
    True: (",A", ",C", ",R", "X", "Z", "U", "W", "R", "I", "K"),
    False: (",C", ",R", "X", "Y", "Z", "R", "I", "J", "K"),
}
MACHINES = [None, 17, 18, 19, 0]
"""A lathe, its lines in the planes of a mill, and a mill with arcs."""


def draw(rng: Random, plane: int | None, *, reverses: bool) -> list[str]:
    count = rng.randint(2, 6)
    if plane != 0:
        return random_lathe(rng, count, reverses=reverses)
    return random_mill(rng, [rng.choice(["line", "line", "arc"]) for _ in range(count)], rng.choice((17, 18, 19)))


def respell(rng: Random, control: str, program: Sequence[str], plane: int | None) -> list[Line]:
    return (sinumerik if control == SINUMERIK else isg)(rng, program, plane)


def judge(lines: Sequence[Line], program: Sequence[str], control: str, machine: Machine) -> str:
    """`right`, `refused` or `near`; fails where a contour is wrong, or is solved and the oracle refuses it."""
    program = [_without_turning(line) for line in program]
    expected = run([_rounded(line) for line in program] if control == SINUMERIK else program, machine)
    if expected.is_near:
        return "near"
    text = "\n".join(line for _, line in lines)
    result = solve(text, control=control, settings=ALIKE[control], depth="verdict")
    found = {lines[each.claim.blocks[0].line - 1][0]: elements_of(each) for each in result.answers if each.contour}
    told = [each.message for each in result.diagnostics if each.severity.value == "error"]
    for each in expected.runs:
        size = max(abs(element.end) for element in each.elements)
        assert gap(each.elements, found.pop(each.line, [])) < 1e-8 * max(1, size / 1000), (text, each.line, told)
    last = expected.refused or inf
    assert not any(rest for line, rest in found.items() if line <= last), (text, found)
    return "refused" if expected.refused else "right"


def _without_turning(line: str) -> str:
    """On both controls, A and C without a comma are axes that turn, which are beside the contour."""
    return re.sub(r"(?<![,A-Z])[AC][-+]?[\d.]+", "", line)


def _rounded(line: str) -> str:
    """Of a rounding and a chamfer in one block, SINUMERIK makes the rounding."""
    return re.sub(r" ,C\d\S*", "", line) if re.search(r",R\d", line) else line


def machine_of(control: str, plane: int | None) -> Machine:
    return LATHE[control] if plane != 0 else MILL


@pytest.mark.parametrize("plane", MACHINES)
@pytest.mark.parametrize("control", [SINUMERIK, ISG])
@pytest.mark.parametrize("count", [12, 40])
def test_random_contours_come_out_where_they_were_drawn(control, plane, count):
    rng, verdicts = Random(f"{control}{plane}{count}"), Counter[str]()
    for _ in range(count):
        program = draw(rng, plane, reverses=control == SINUMERIK)
        verdict = judge(respell(rng, control, program, plane), program, control, machine_of(control, plane))
        # ISG takes no angle beside both coordinates.
        assert verdict != "refused" or (control == ISG and plane != 0)
        verdicts[verdict] += 1
    assert verdicts["right"] > count / 2


@pytest.mark.parametrize("plane", MACHINES)
@pytest.mark.parametrize("control", [SINUMERIK, ISG])
@pytest.mark.parametrize("count", [12, 40])
def test_no_program_with_a_word_lost_too_many_or_wrong_is_solved_wrongly(control, plane, count):
    rng, verdicts = Random(f"wrong {control}{plane}{count}"), Counter[str]()
    for _ in range(count):
        program = disturbed(rng, draw(rng, plane, reverses=control == SINUMERIK), TYPED[plane != 0])
        verdicts[judge(respell(rng, control, program, plane), program, control, machine_of(control, plane))] += 1
    assert min(verdicts["refused"], verdicts["right"]) > count / 20
