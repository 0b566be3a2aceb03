"""Systems of equations for other programs: JSON by the schema contoursolve/systems/1, and SMT-LIB."""

import re
from collections.abc import Iterable
from typing import Any

from contoursolve.diagnosis import EquationSystem
from contoursolve.diagnostics import check_type, json_text
from contoursolve.numeric import smt_lib
from contoursolve.output.equations import NOBODY
from contoursolve.output.plain_text import printable

Systems = EquationSystem | Iterable[EquationSystem]
"""One system, or several."""


def systems_to_json(systems: Systems) -> str:
    """Systems with their verdicts as JSON: unknowns, values, equations, rank, blocks, conditions, what is free and what
    says the same.

    Formulas are as Python and sympy write them; numbers of words are exact texts, such as `"2*pi/3"`. Lengths are mm,
    X of a lathe counts as radius, angles are radians. `docs/systems.schema.json` is the schema.

    >>> import contoursolve, json
    >>> system = contoursolve.system("G111 A160. B120. X101.838", start="X40. Z0.", rules="off")
    >>> json.loads(systems_to_json(system))["systems"][0]["verdict"]
    {'rank': 3, 'is_determined': False, 'has_contour': False}
    """
    return json_text({"schema": "contoursolve/systems/1", "systems": [*map(_system, _several(systems))]}) + "\n"


def _several(systems: Systems) -> Iterable[EquationSystem]:
    if isinstance(systems, EquationSystem):
        return (systems,)
    check_type("systems", systems, Iterable, "a system, or several")
    several = tuple(systems)
    for each in several:
        check_type("each of systems", each, EquationSystem)
    return several


def _system(system: EquationSystem) -> dict[str, Any]:
    columns, rows = system.unknowns, system.statements
    return {
        "control": system.control.name,
        "blocks": [block.text for block in system.claim.blocks],
        "unknowns": [
            {"symbol": each.name, "meaning": each.meaning, "unit": each.unit, "value": each.value} for each in columns
        ],
        "values": [
            {
                "symbol": each.name,
                "word": each.text,
                "meaning": each.meaning,
                "unit": each.unit,
                "number": None if each.number is None else str(each.number),
            }
            for each in system.words
        ],
        "equations": [
            {
                "left": str(each.equation.lhs),
                "right": str(each.equation.rhs),
                "word": each.word,
                "meaning": each.meaning,
            }
            for each in rows
        ],
        "positive": [*map(str, system.senses)],
        "jacobian_blocks": [
            {"state": each.state.value, "equations": [*each.rows], "unknowns": [*each.columns]}
            for each in system.blocks
        ],
        "conditions": [
            {"expression": str(each.expression), "value": each.value, "meaning": each.meaning}
            for each in system.conditions
        ],
        "free": [*map(str, system.free)],
        "ties": [
            {"words": [*each.words], "identity": None if each.identity is None else _told(each.identity)}
            for each in system.ties
        ],
        "verdict": {
            "rank": system.rank,
            "is_determined": system.is_determined,
            "has_contour": bool(system.solution),
        },
    }


def _told(equation: Any) -> str:
    return f"{equation.lhs} = {equation.rhs}"


def to_smt(systems: Systems) -> str:
    """Systems for a solver of SMT-LIB, such as z3 or cvc5, in the logic QF_NRA: one question each, whether the values
    of the words leave any solution.

    Words have their values as rational numbers. A direction is its cosine and its sine on the circle of radius 1;
    where they are no rational numbers, they lie within 1e-30. So `unsat` is a proof that nothing satisfies all words as
    they are typed; words that repeat others, but are rounded, contradict them. Each equation is named by its word, so
    that `(get-unsat-core)` tells the words that contradict each other. Corners that must fit, and the direction of
    travel where no equation has it, are not asked. Raises ValueError for an equation that is no polynomial.
    """
    head = ["(set-option :produce-unsat-cores true)", "(set-option :produce-models true)", "(set-logic QF_NRA)"]
    several = [*_several(systems)]
    if len(several) == 1:
        return "\n".join([*head, *_script(several[0]), "(check-sat)"]) + "\n"
    parts = (["(push 1)", *_script(each), "(check-sat)", "(pop 1)"] for each in several)
    return "\n".join([*head, *(line for part in parts for line in part)]) + "\n"


def _script(system: EquationSystem) -> list[str]:
    """The commands of one system."""
    meanings = {each.symbol: printable(f"{each.meaning}, {each.unit}".strip(", ")) for each in system.unknowns}
    meanings |= {each.symbol: printable(f"{each.text} {each.meaning}".strip()) for each in system.words}
    script = smt_lib.Script(meanings)
    sides = {each.symbol for each in system.words if not each.unit}
    used = set().union(*(each.free_symbols for each in (*system.equations, *system.senses)))
    for each in system.words:
        if each.symbol in used and each.symbol in sides:
            script.sign(each.symbol)
        elif each.symbol in used and each.number is not None:
            (script.angle if each.unit == "rad" else script.value)(each.symbol, each.number)
    for number, stated in enumerate(system.statements, 1):
        told = re.sub(r"[|\\]", "/", printable(stated.word or NOBODY))
        script.equal(stated.equation, f"{number} {told}")
    for expression in system.senses:
        script.positive(expression)
    return [*(f"; {printable(block.text)}" for block in system.claim.blocks), *script.lines]
