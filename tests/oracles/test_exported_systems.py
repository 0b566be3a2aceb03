"""Systems for other programs: what they hold is read again by a small reader, and decided by z3 where it is there."""

import json
import re
from collections import ChainMap
from math import cos, isclose, prod, sin
from pathlib import Path

import pytest
import sympy
from jsonschema import Draft202012Validator
from vectors import BY_HAND, solved

import contoursolve
from contoursolve.output import systems_to_json, to_smt

START = "X40. Z0."
SCHEMA = Path(__file__).parents[2] / "docs" / "systems.schema.json"
MISSED = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y60 ,A180 Q-1"


def system_of(block, **options):
    return contoursolve.system(block, start=START, rules="off", **options)


def expressions(text):
    """The commands of a script, as nested lists."""
    stack = [[]]
    for part in re.findall(r"[()]|\|[^|]*\||[^\s()|]+", re.sub(r"(?m);.*$", "", text)):
        if part == "(":
            stack.append([])
        elif part == ")":
            last = stack.pop()
            stack[-1].append(last)
        else:
            stack[-1].append(part)
    (found,) = stack
    return found


def value(term, at):
    """The value of a term, or whether it holds to a billionth."""
    if isinstance(term, str):
        return at[term] if term in at else float(term)
    name, *rest = term
    if name == "!":
        return value(rest[0], at)
    found = [value(each, at) for each in rest]
    table = {
        "+": sum,
        "*": prod,
        "-": lambda each: -each[0],
        "/": lambda each: each[0] / each[1],
        "=": lambda each: isclose(*each, rel_tol=1e-9, abs_tol=1e-6),
        "<=": lambda each: each[0] <= each[1] + 1e-9,
        ">=": lambda each: each[0] >= each[1] - 1e-9,
        ">": lambda each: each[0] > each[1],
        "and": all,
        "or": any,
    }
    return table[name](found)


def missed(system):
    """The names of what does not hold in the contour that was solved."""
    numbers = {str(each.symbol): float(each.number) for each in system.words if each.number is not None}
    turned = {f"{part.__name__}_{name}": part(number) for name, number in numbers.items() for part in (cos, sin)}
    at = ChainMap({str(symbol): number for symbol, number in system.solution.items()}, turned, numbers)
    script = expressions(system.to_smt())
    asserted = [rest[0] for name, *rest in script if name == "assert"]
    declared = [rest[0] for name, *rest in script if name == "declare-const"]
    assert len(declared) == len(set(declared))
    return [each[-1] if each[0] == "!" else each for each in asserted if not value(each, at)]


@pytest.mark.parametrize(
    "programs", [pytest.param(BY_HAND[::90], id="some"), pytest.param(BY_HAND[::25], id="more", marks=pytest.mark.slow)]
)
def test_contours_satisfy_what_is_exported(programs):
    count, holds = 0, Draft202012Validator(json.loads(SCHEMA.read_text(encoding="utf-8")))
    for program in programs:
        for answer in solved(program["control"], program).answers:
            if answer.contour is None:
                continue
            system = answer.system
            assert missed(system) == [], program["id"]
            data = json.loads(system.to_json())
            holds.validate(data)
            (own,) = data["systems"]
            assert own["verdict"]["has_contour"]
            at = {each["symbol"]: sympy.sympify(each["number"]) for each in own["values"] if each["number"]}
            at |= {each["symbol"]: each["value"] for each in own["unknowns"]}
            names = {name: sympy.Symbol(name) for name in at}
            for each in own["equations"]:
                off = sympy.sympify(f"({each['left']}) - ({each['right']})", locals=names)
                assert abs(float(off.subs(at))) < 1e-6, program["id"]
            count += 1
    assert count > len(programs) / 2


def test_several_systems_are_one_document(tmp_path):
    several = [system_of("G111 A160. B120. X101.838"), system_of("G111 A135. I10. K-12. B180. Z-40.")]
    for name, text in (("all.json", systems_to_json(several)), ("all.smt2", to_smt(several))):
        contoursolve.export(several, tmp_path / name)
        assert (tmp_path / name).read_text() == text
    data = json.loads(systems_to_json(several))
    Draft202012Validator(json.loads(SCHEMA.read_text(encoding="utf-8"))).validate(data)
    assert [each["verdict"]["rank"] for each in data["systems"]] == [3, 4]
    assert data["systems"][1]["ties"] == [{"words": ["I10.", "K-12.", "A135."], "identity": "K = I/tan(A)"}]
    script = to_smt(several)
    assert [script.count(each) for each in ("(push 1)", "(check-sat)", "(pop 1)")] == [2, 2, 2]
    Draft202012Validator.check_schema(json.loads(SCHEMA.read_text(encoding="utf-8")))


@pytest.mark.parametrize(
    ("system", "core"),
    [
        pytest.param(lambda: system_of("G111 A160. I10.919 B120. Z-41.547"), None, id="solved"),
        pytest.param(lambda: system_of("G111 A160. B120. X101.838"), None, id="open"),
        pytest.param(
            lambda: system_of("G111 A135. I10. K-12. B180. Z-40."), {"1 I10.", "2 K-12.", "3 A135."}, id="conflict"
        ),
        pytest.param(lambda: contoursolve.system(MISSED, control="nct-99m"), {",A180", "R50"}, id="a circle is missed"),
    ],
)
def test_a_solver_of_others_says_whether_there_is_a_solution(system, core):
    z3 = pytest.importorskip("z3")
    solver = z3.Solver()
    solver.set(unsat_core=True)
    solver.from_string(system().to_smt())
    assert solver.check() == (z3.sat if core is None else z3.unsat)
    if core is not None:
        told = {str(each).strip("|") for each in solver.unsat_core()}
        assert all(any(each in name for name in told) for each in core)
