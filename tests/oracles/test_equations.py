"""The system on the table: its equations, conditions and functions, against contours, ranks and families."""

import re
from decimal import Decimal
from fractions import Fraction
from math import pi
from random import Random

import numpy as np
import pytest
import sympy
from vectors import BY_HAND as RIGHT, solved

import contoursolve
from contoursolve.controls import write_tables
from contoursolve.numeric import symbolic
from contoursolve.solving import conditions_of, jacobian_of, rank_of

SHAFT, START = "G111 X100. A180. K-30. B120. P5.", "X40. Z0."


def contours(programs):
    for each in programs:
        result = solved(each["control"], each)
        yield from ((each["id"], answer) for answer in result.answers if answer.contour)


def off(equation, values):
    """By how much an equation of sympy is missed at values of all its symbols."""
    rest = sympy.sympify(equation.lhs - equation.rhs).xreplace({key: sympy.sympify(at) for key, at in values.items()})
    return abs(float(rest))


@pytest.mark.parametrize(
    "programs", [pytest.param(RIGHT[::90], id="some"), pytest.param(RIGHT[::20], id="more", marks=pytest.mark.slow)]
)
def test_contours_satisfy_their_equations_and_are_what_their_function_gives(programs):
    for name, answer in contours(programs):
        system = answer.system
        values = system.values | system.solution
        assert all(off(each.equation, values) < 1e-9 for each in system.statements), name
        assert system.rank == len(system.unknowns), name
        assert (system.free, system.margin is None) == ((), False), name
        for corner in system.corners:
            known = values | {each.symbol: each.value for each in corner.unknowns}
            assert all(off(each.equation, known) < 1e-6 for each in corner.equations), (name, corner.name)
        known = values | {each.symbol: each.value for corner in system.corners for each in corner.unknowns}
        lines = [line for step in system.derivation.steps for line in step.lines if line.symbol in known]
        assert {each.symbol for each in system.unknowns if each.unit} <= {line.symbol for line in lines}, name
        assert all(abs(line.value - float(known[line.symbol])) < 1e-6 for line in lines), name
        found = {key: np.array(value) for key, value in system.function()(**system.inputs).items()}
        rows = system.rows
        assert all(len(rows[key]) == len(value) for key, value in found.items()), name
        elements = dict(zip(rows["elements"], found["elements"], strict=True))
        for element in answer.contour.elements:
            assert elements[element.name] == pytest.approx([*element.start, *element.end], abs=1e-9), name
        assert abs(found["residuals"]).max(initial=0.0) < 1e-9, name
        assert found["conditions"].ravel() == pytest.approx([each.value for each in system.conditions], rel=1e-6), name


def drawn(rng, factor, matrix):
    """Values of all symbols: angles, and numbers about ten."""
    turned = {
        symbol for each in (factor, matrix) for one in each.atoms(sympy.sin, sympy.cos) for symbol in one.free_symbols
    }
    symbols = sorted(factor.free_symbols | matrix.free_symbols, key=str)
    return {each: rng.uniform(0.2, 1.3) if each in turned else rng.uniform(-10, 10) for each in symbols}


def halved(function, low, high):
    """A zero between two places where a function has opposite signs."""
    sign = np.sign(function(low))
    for _ in range(60):
        middle = (low + high) / 2
        if function(middle) * sign > 0:
            low = middle
        else:
            high = middle
    return low


def zero_of(factor, values, rng):
    """The values with one of them changed so that a factor is zero there; None if none was found."""
    for symbol in sorted(factor.free_symbols, key=str):
        function = sympy.lambdify(symbol, factor.xreplace({key: at for key, at in values.items() if key != symbol}))
        at = np.linspace(-4, 4, 81) if abs(values[symbol]) < 2 else np.linspace(-40, 40, 401)
        found = [function(each) for each in at]
        for place in range(len(at) - 1):
            if found[place] * found[place + 1] < 0:
                return {**values, symbol: halved(function, at[place], at[place + 1])}
    return None


SYSTEMS = sorted(write_tables.systems().items())


@pytest.mark.parametrize(
    "systems",
    [pytest.param(SYSTEMS[::60], id="some"), pytest.param(SYSTEMS[5::20], id="a twentieth", marks=pytest.mark.slow)],
)
def test_conditions_of_all_forms_are_zero_exactly_where_the_rank_falls(systems):
    """At values that nothing but the words for coordinates ties: the rank of each step's own matrix, by numpy."""
    rng, count = np.random.default_rng(39), 0
    for key, system in systems:
        symbols = symbolic.Symbols()
        matrix = jacobian_of(system, symbols)
        verdict = rank_of(system, symbols, matrix)
        if verdict.free or not system.facts:
            continue
        place = {name: number for number, name in enumerate(system.unknowns)}
        row = {fact: number for number, fact in enumerate(system.facts)}
        known = {}
        for step in conditions_of(system, symbols, matrix, verdict.basis):
            part = matrix.extract(
                [row[fact] for fact in step.group.facts], [place[name] for name in step.group.unknowns]
            )
            part = part.xreplace(symbols.turned()).xreplace(known)
            placed = step.group.facts[0].placed
            if len(step.group.facts) == 1 and placed is not None:
                origin = symbols.scalar(f"{placed.origin}.{placed.axis}") if placed.origin else sympy.Integer(0)
                own = symbols.scalar(step.group.facts[0].given) if placed.is_stepped else 0
                known[symbols.scalar(step.group.unknowns[0])] = known.get(origin, origin) + own
            for factor in step.factors:
                values = drawn(rng, factor, part)
                least = np.linalg.svd(np.array(part.xreplace(values), float), compute_uv=False)[-1]
                assert min(least, abs(factor.xreplace(values))) > 1e-9, key
                at = zero_of(factor, values, rng)
                if at is not None:
                    singular = np.linalg.svd(np.array(part.xreplace(at), float), compute_uv=False)
                    assert singular[-1] < 1e-7 * max(singular[0], 1), (key, factor)
                    count += 1
    assert count > len(systems) / 4


def test_a_system_says_what_each_word_states_and_on_which_condition_it_is_determined():
    system = contoursolve.system(SHAFT, start=START)
    assert [str(each.symbol) for each in system.unknowns] == ["Z_V1", "X_V1", "Z_V2", "X_V2"]
    assert [each.word for each in system.statements] == ["K-30.", "A180.", "X100.", "B120."]
    assert str(system.condition) == "sin(B)*cos(A)"
    assert system.margin == pytest.approx(-(3**0.5) / 2)
    assert [each.meaning for each in system.conditions] == [
        "the line at A180. must not be parallel to X",
        "the line at B120. must not be parallel to Z",
    ]
    assert {str(symbol): number for symbol, number in system.values.items()}["A"] == sympy.pi
    assert sympy.Matrix([each.lhs - each.rhs for each in system.equations]).rank() >= 1
    assert system.jacobian.shape == (4, 4)
    (corner,) = system.corners
    assert (len(corner.unknowns), len(corner.equations)) == (6, 6)


def test_other_values_and_fewer_words_give_other_systems():
    system = contoursolve.system(SHAFT, start=START)
    assert system.subs(A=90.0).margin == pytest.approx(0, abs=1e-12)
    assert system.subs(K=-20).solve().items[0].solution.points["V1"] == (-20, 20)
    less = system.free("K")
    assert ([str(each) for each in less.free], less.rank, less.condition) == (["Z_V1", "X_V1", "Z_V2"], 3, None)
    with pytest.raises(ValueError, match="still open: V1"):
        less.solve()
    with pytest.raises(ValueError, match="Q is no word of the contour; its words are X, A, K, B and P"):
        system.subs(Q=1)
    arc = contoursolve.system(NCT.format("G41", 50, 0) + "G3 X-50 Y0 R-55\nG1 X-50 Y42.857 ,A150 Q-1")
    (radius,) = (each.value for each in arc.subs(R=-60).unknowns if each.symbol.name == "r")
    assert (radius, arc.inputs["R"]) == (60, -55)
    tied = contoursolve.system("G111 A135. I10. K-10. B180. Z-40.", start=START, rules="off")
    assert [(each.words, str(each.identity)) for each in tied.ties] == [(("I10.", "K-10.", "A135."), "Eq(K, I/tan(A))")]
    with pytest.raises(ValueError, match="the program has no contour"):
        contoursolve.system("G00 X1.", control="yasnac-lx3")


def test_sympy_takes_a_system_as_it_is():
    system = contoursolve.system(SHAFT, start=START)
    found = sympy.solve(system.equations, system.unknowns)
    numbers = {name: float(value.subs(system.values)) for name, value in found.items()}
    assert numbers == pytest.approx(system.solution)
    assert sympy.sympify(system.words[0]) == system.words[0].symbol
    assert sympy.sympify(system.statements[0]) == system.equations[0]
    assert system.unknowns[0]._repr_latex_() == "$\\displaystyle Z_{V1}$"
    latex = system._repr_latex_()
    assert (latex.count("&="), latex.count("&\\neq 0"), latex.count("\\\\")) == (4, 1, 4)


def test_two_equal_questions_have_equal_answers_and_one_hash():
    one, same, other = (contoursolve.solve(SHAFT.replace("A180", f"A{a}"), start=START) for a in (180, 180, 170))
    assert (one, hash(one), hash(one.answers[0].contour)) == (same, hash(same), hash(same.answers[0].contour))
    assert len({one.answers[0], same.answers[0], other.answers[0]}) == 2
    wrong = [contoursolve.solve("G111 X70. A150. K-20.", start=START).answers[0].diagnostics for _ in range(2)]
    assert len({*wrong[0], *wrong[1]}) == len(wrong[0]) > 0


ODD = (0, 15, 170, -30)
"""Numbers at which some forms are read otherwise, or have no contour."""


def shown(system):
    """All of a system that its numbers and texts are in."""
    try:
        path = {key: np.array(value).tolist() for key, value in system.function()(**system.inputs).items()}
    except ValueError as error:
        path = str(error)
    words = [(str(each.symbol), each.number, each.text) for each in system.words]
    statements = [(str(each.equation), each.meaning, each.word) for each in system.statements]
    return path, words, statements, [(str(key), value) for key, value in system.solution.items()], system.inputs


@pytest.mark.parametrize(
    "programs", [pytest.param(RIGHT[::60], id="some"), pytest.param(RIGHT[1::9], id="more", marks=pytest.mark.slow)]
)
def test_a_system_with_other_numbers_is_that_of_the_block_so_written(programs):
    count = 0
    for each in programs:
        rng, result = Random(each["id"]), solved(each["control"], each)
        for answer in (one for one in result.answers if one.contour):
            system = answer.system
            stated = [one for one in system.words if one.source is not None and one.source.number is not None]
            if not stated:
                continue
            named = rng.choice(stated)
            word = named.source
            number = word.number
            other = rng.choice((-number, number + Decimal(rng.choice((-1.0, 0.5, -0.125, 10.0))), *map(Decimal, ODD)))
            key = rng.choice((named.name, f"{word.span.line}:{word.address}"))
            found = system.subs({key: other})
            text = result.program.syntax.words.spell(word.address, f"{float(other):.6f}".rstrip("0"))
            lines, (begin, end) = [*each["program"]], (word.span.column - 1, word.span.end_column - 1)
            lines[word.span.line - 1] = lines[word.span.line - 1][:begin] + text + lines[word.span.line - 1][end:]
            written = solved(each["control"], {**each, "program": lines}).contour_at(answer.lines[0]).system
            assert shown(found) == shown(written), (each["id"], key, other)
            assert shown(found.subs({key: number}))[1:] == shown(system.subs({key: number}))[1:], (each["id"], key)
            count += 1
    assert count >= len(programs)


def test_a_system_with_other_numbers_keeps_its_facts_and_what_is_free():
    system = contoursolve.system("G111 X100. A180. K? B120. P5.", start=START, facts=["length of line 1 = 31"])
    moved = contoursolve.system("G111 X100. A180. K? B120. P5.", start=START, facts=["length of line 1 = 40."])
    assert shown(system.subs(fact1=40)) == shown(system.subs({"length of line 1": 40})) == shown(moved)
    without = contoursolve.system("G111 X100. A180. K? B120. P5.", start=START)
    assert shown(system.free("length of line 1"))[1:] == shown(without)[1:]
    shaft = contoursolve.system(SHAFT, start=START)
    assert shaft.free("K").subs(X=50).free == shaft.free("K").free
    for value in ("a", float("nan"), float("inf")):
        with pytest.raises(ValueError, match="is no number"):
            shaft.subs(X=value)


def test_a_system_with_facts_or_free_contours_has_a_condition_and_the_rank_of_residues():
    """Where the table that ships has no row, sympy derives it; the rank modulo a prime says the same."""
    from contoursolve.solving import survey  # noqa: PLC0415

    facts = contoursolve.system("G111 X100. A180. B120.", start=START, facts=["length of line 1 = 30."], rules="warn")
    assert (facts.rank, str(facts.condition)) == (4, "sin(B)")
    programs = [each for each in RIGHT if each["control"] == "heidenhain"]
    for name, answer in contours(programs[:12]):
        system = answer.system
        quick = survey(system._system)
        assert (quick.rank, len(quick.free)) == (system.rank, len(system.free)), name


NCT = "G17 G90 {} G0 X{} Y{}\n"
FAMILIES = {
    "G111": ("G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0.", "yasnac-lx3", {"A": "A", "B": "B", "P": "P"}),
    "G111, bevels": ("G111 X100. A180. K-30. B120. C5. D5.", "X40. Z0.", "yasnac-lx3", {"K": "K", "X": "X", "C": "C"}),
    "G112": ("G112 X50. K-30. I10. R20. P2. Q2.", "X40. Z0.", "yasnac-lx3", {"R": "R", "K": "K", "X": "X"}),
    "two lines": ("G1 ,A60\nX70 Y50 ,A-20", "X0 Y0", "nct-99m", {"1:,A": "A_1", "X": "X"}),
    "a line and a circle": (
        NCT.format("G42", 100, 20) + "G1 ,A197.103 ,R2\nG3 X20 Y30 I20 J-10 R40 Q-1",
        None,
        "nct-99m",
        {"2:,A": "A", ",R": "comma_R"},
    ),
    "a circle and a line": (
        NCT.format("G41", 50, 0) + "G3 X-50 Y0 R55\nG1 X-50 Y42.857 ,A150 Q-1",
        None,
        "nct-99m",
        {"R": "R", "3:,A": "A"},
    ),
    "a long arc, whose radius is negative": (
        NCT.format("G41", 50, 0) + "G3 X-50 Y0 R-55\nG1 X-50 Y42.857 ,A150 Q-1",
        None,
        "nct-99m",
        {"R": "R", "3:X": "X_3"},
    ),
    "two circles": (
        NCT.format("G41", 50, 0) + "G3 X-50 Y0 R55 ,R2\nG3 X-40 Y60 I-40 J20 R40 Q-1",
        None,
        "nct-99m",
        {"2:R": "R_2", ",R": "comma_R"},
    ),
    "a chain of three": (
        NCT.format("G41", 90, 10) + "G1 ,A150 ,R2\nG1 X10 Y20 ,A225 Q1 ,C2\nG3 X-40 Y-20 I-20 J-20 R20 Q1",
        None,
        "nct-99m",
        {"2:,A": "A_2", "3:,A": "A_3", ",C": "C"},
    ),
    "angles in a row": ("G01 Z-30. ,R2.\nX60. ,A120. ,C1.\nZ-80.", "X40. Z0.", "fanuc-lathe", {",A": "A", "X": "X"}),
    "an angle before a known end": ("G01 ,A150.\nX80. Z-90. ,A120.", "X40. Z0.", "fanuc-lathe", {"1:,A": "A_1"}),
    "Haas": ("G01 Z-20. ,C2.\nX60. Z-40. ,R1.\nZ-60.", "X40. Z0.", "haas-lathe", {",C": "C", "X": "X", ",R": "R"}),
    "Siemens": ("G1 ANG=30 RND=2\nX60 Y40 ANG=90", "X0 Y0", "siemens-840d", {"1:ANG": "ANG_1", "RND": "RND"}),
    "tangent arcs, searched": (
        "G17 G90 G1 X39.19 Y1.84\nCT X-35.01 Y-22.0\nCT X87.0 Y-3.0",
        "X0 Y0",
        "siemens-808d",
        {"2:Y": "Y_2", "3:Y": "Y_3"},
    ),
    "Mitsubishi": (
        NCT.format("", 0, 0) + "G01 A10.\nG02 X60. Y10. I-20. J-25. H0",
        None,
        "mitsubishi",
        {"A": "A", "3:X": "X"},
    ),
    "a free contour": ("FL X+10 Y+0\nFCT DR+ R5\nFLT X+30 Y+20", "X0 Y0", "heidenhain", {"R": "R", "3:X": "X_3"}),
}


@pytest.mark.parametrize(("block", "start", "control", "vary"), FAMILIES.values(), ids=FAMILIES)
@pytest.mark.parametrize("rows", [10, pytest.param(4_000, marks=pytest.mark.slow)])
def test_the_function_gives_what_a_sweep_gives(block, start, control, vary, rows):
    """Random rows near the block, each as a family solves it: all that both have of what is solved."""
    rng = np.random.default_rng(rows)
    system = contoursolve.system(block, start=start, control=control)
    values = {key: system.inputs[name] * rng.uniform(0.85, 1.15, rows) for key, name in vary.items()}
    family = contoursolve.family(block, start=start, control=control, vary=values, paired=True, rules="off")
    function, inputs = system.function(), {**system.inputs, **{name: values[key] for key, name in vary.items()}}
    order = [np.broadcast_to(inputs[name], rows).reshape(1, -1) for name in function.name_in()]
    found = dict(zip(function.name_out(), function.map(rows).call(order), strict=True))
    solved, compared, axes = family["status"] == 0, set(), system.profile.plane.axes
    assert solved.sum() > rows / 4
    for output, suffixes in OUTPUTS.items():
        table = np.array(found[output]).reshape(len(system.rows[output]), rows, len(suffixes))
        for number, name in enumerate(system.rows[output]):
            for place, suffix in enumerate(suffixes):
                column = f"{name}{suffix.format(*axes)}"
                if column in family.names:
                    compared.add(column)
                    factor = 2 if family.measures()[column].measure == "diameter" else 1
                    off = abs(table[number, solved, place] * factor - family[column][solved])
                    assert off.max() < 1e-9, (column, off.max())
    own = {name for name in family.columns if name not in ("status", "reason", "residual") and "branch." not in name}
    assert compared == own


OUTPUTS = {
    "points": (" {0}", " {1}"),
    "radii": ("",),
    "elements": (".begin {0}", ".begin {1}", ".end {0}", ".end {1}"),
    "centers": (".center {0}", ".center {1}"),
    "room": (".room",),
}
"""What the columns of each output are called in a family."""


@pytest.mark.parametrize(
    ("chain", "start"),
    [
        ("FL AN+15\nFC DR- R25 CCX+50 CCY+20\nFL X+90 Y+10 AN-20", "X+0 Y+10"),
        ("FC DR- R40 CCX+0 CCY+0\nFC DR- R25 CCX+50 CCY+0\nFL X+90 Y-40 AN-20", "X-40 Y+0"),
        ("FL AN+45\nFC DR- R20 CCX+40 CCY+40 X+40 Y+60", "X0 Y20"),
    ],
)
def test_each_solution_has_its_function(chain, start):
    answer = contoursolve.solve(chain, start=start, control="heidenhain").answer
    system, found = answer.system, [each for each in answer.solutions if each.contour is not None]
    for each in found:
        made = system.function(solution=each)(**system.inputs)
        points = dict(zip(system.rows["points"], np.array(made["points"]).tolist(), strict=True))
        assert all(
            points[name] == pytest.approx(at, abs=1e-9) for name, at in each.contour.points.items() if name in points
        )
        assert np.abs(np.array(made["residuals"])).max() < 1e-9
    if answer.contour is None:
        with pytest.raises(ValueError, match=f"of several, name one: solution='{found[0].name}'"):
            system.function()
    else:
        assert str(system.function()(**system.inputs)) == str(made)
    with pytest.raises(ValueError, match="no solution is called 'C'"):
        system.function(solution="C")


def test_a_function_that_is_searched_tells_by_its_residuals_where_there_is_nothing():
    """Beyond R20 the place lies inside the circle: no row of many ends the others."""
    system = contoursolve.system("FL X+10 Y+0\nFCT DR+ R5\nFLT X+30 Y+20", start="X0 Y0", control="heidenhain")
    rows, function = np.array([[5.0, 19.0, 25.0]]), system.function()
    order = [rows if name == "R" else np.full((1, 3), system.inputs[name]) for name in function.name_in()]
    found = function.map(3).call(order)
    off = abs(np.array(found[function.name_out().index("residuals")])).max(axis=0)
    assert off[:2].max() < 1e-9
    assert not off[2] < 1e-3


def test_a_function_is_differentiated_and_optimised_by_casadi():
    """The derivative of a point by a word is what `sensitivity` says; and the largest radius that leaves room."""
    import casadi  # noqa: PLC0415

    system = contoursolve.system(SHAFT, start=START)
    function = system.function()
    assert function(K=-20)["points"][0, 0] == -20 == function(**{**system.inputs, "K": -20})["points"][0, 0]
    inputs = {name: casadi.MX.sym(name) for name in function.name_in()}
    points = function(**inputs)["points"]
    slope = casadi.Function("slope", [*inputs.values()], [casadi.jacobian(points[0, 0], inputs["K"])])
    assert float(slope(*system.inputs.values())) == 1
    known = {**system.inputs, "P": inputs["P"]}
    problem = {"x": inputs["P"], "f": -inputs["P"], "g": function(**known)["room"]}
    solver = casadi.nlpsol(
        "largest", "ipopt", problem, {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes"}
    )
    largest = float(solver(x0=5, lbg=0)["x"])
    # The tangent of half the turn of 60 degrees, on the shorter line of 30 mm.
    assert largest == pytest.approx(min(30, 40 / 3**0.5 * 1.5) / np.tan(pi / 6), rel=1e-5)


@pytest.mark.parametrize(
    ("block", "start", "control", "told"),
    [
        # The radius of the half circle is less than half its chord, by what the control allows.
        (
            "G1 X50\nG3 X-50 Y0 R49.9995\nG1 X-50 Y42.857 ,A171.87 Q-1",
            "G42 X90 Y0",
            "nct-99m",
            "as the solution has it",
        ),
        ("G01 X30. ,R3.\nG03 X50. Y20. R20.", "X0. Y0.", "fanuc-mill", "the control leaves it out"),
    ],
)
def test_what_nobody_calculates_by_hand_is_told(block, start, control, told):
    for answer in contoursolve.solve(block, start=start, control=control).answers:
        if answer.contour:
            assert any(told in step.title for step in answer.system.derivation.steps)


def test_a_calculation_by_hand_is_latex():
    derivation = contoursolve.system("G111 X100. A180. K-30. B120. P5. (#1)", start=START).derivation
    written = derivation.latex
    assert "(-30) + \\frac{50 - 20}{\\tan{\\left(120^{\\circ} \\right)}} = -47.3205\\,\\mathrm{mm}" in written
    assert written.count("\\item ") == len(derivation.steps) == written.count("\\begin{align*}")
    assert written.count("{") == written.count("}")
    values = [f"{line.value:z.4f}" for step in derivation.steps for line in step.lines]
    assert re.findall(r"= (-?[\d.]+)(?:\\,\\mathrm{mm}|\^{\\circ})(?: \\\\)?$", written, re.MULTILINE) == values


def test_a_corner_that_has_nothing_to_end_on_has_no_equations():
    (answer,) = contoursolve.solve(
        "G112 K32.023 I--92.673 W2.851 P40.372 Q22.272 R62.798", start="X369.372 Z-88.938"
    ).answers
    assert [corner.name for corner in answer.system.corners] == ["corner 1"]


def test_a_start_is_words_or_numbers_by_letters():
    stated = contoursolve.solve(SHAFT, start={"X": 40, "Z": 0.0})
    assert stated.answers[0].contour == contoursolve.solve(SHAFT, start=START).answers[0].contour
    assert contoursolve.family(SHAFT, start={"X": 40, "Z": 0}, vary={"A": [180.0]})["V2 Z"] == pytest.approx(
        -47.3205081
    )
    for start in (("X40.", "Z0."), 3):
        with pytest.raises(TypeError, match="the start is words such as"):
            contoursolve.solve(SHAFT, start=start)
    with pytest.raises(TypeError, match="facts is texts, such as"):
        contoursolve.solve(SHAFT, start=START, facts=3)


def at_drawing(expression, values):
    """A matrix of sympy as numbers."""
    return np.array(sympy.Matrix(expression).xreplace(values).tolist(), dtype=complex).reshape(expression.shape)


@pytest.mark.parametrize(
    "programs", [pytest.param(RIGHT[::60], id="some"), pytest.param(RIGHT[::15], id="more", marks=pytest.mark.slow)]
)
def test_what_can_still_move_keeps_every_equation_and_is_all_that_does(programs):
    random = Random(5)
    for name, answer in contours(programs):
        sources = [each.source for each in answer.system.words if each.source and each.number is not None]
        words = sorted({f"{each.span.line}:{each.address}" for each in sources})
        system = answer.system.free(*random.sample(words, min(len(words), random.randint(1, 3))))
        space = system.null_space
        if space is None:
            continue
        values = {key: sympy.sympify(value) for key, value in (system.values | space.values).items()}
        assert all(off(each, values) < 1e-6 for each in system.equations), name
        slopes = at_drawing(system.jacobian, values).real
        sizes = np.maximum(np.linalg.norm(slopes, axis=1, keepdims=True), 1e-300)
        rank = np.linalg.matrix_rank(slopes / sizes, tol=1e-7) if slopes.size else 0
        assert space.dimension == len(system.unknowns) - rank >= len(system.unknowns) - system.rank, name
        assert abs(slopes @ space.numbers / sizes).max(initial=0.0) < 1e-6, name
        if space.exact is not None:
            assert abs(at_drawing(space.exact, values) - space.numbers).max(initial=0.0) < 1e-5, name
        for motion in space.motions:
            first, *_ = [*(np.hypot(*way) for way in motion.points.values()), *map(abs, motion.radii.values()), 1.0]
            assert first == pytest.approx(1), name


def test_what_these_values_fix_is_not_called_open():
    # The second straight is level, so that its end gives the height of the first one's.
    answer = contoursolve.solve("G111 A150. X70. B180. P4.", start="X40. Z0.").answers[0]
    space = answer.system.null_space
    assert [*space.motions[0].points] == ["V2"]
    assert space.texts == ("V2 can still slide along Z",)
    told = next(each for each in answer.diagnostics if each.code == "words-missing")
    assert told.message == "the end of the second straight is still open in Z: add one of Z, W"


def test_a_point_slides_along_the_arc_that_it_is_on():
    program = "0 BEGIN PGM T MM\n1 L X+0 Y+0 F9\n2 FC DR- CCX+20 CCY+0\n3 FL X+60 Y+10\n99 END PGM T MM\n"
    (answer,) = contoursolve.solve(program).answers
    (motion,) = answer.system.null_space.motions
    assert [*motion.points] == ["P2"]
    assert "the end of block 2 can still slide along the arc" in answer.diagnostics[0].notes
    (freedom,) = answer.diagnosis.freedoms
    assert (freedom.point, freedom.about, freedom.how) == ("P2", "C2", "slides along the circle about C2")


def test_a_contour_that_is_solved_cannot_move_even_where_slopes_alone_would_let_it():
    half_circle = "G17 G90 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"
    system = contoursolve.system(half_circle, control="nct-99m")
    assert (system.dof, system.margin, system.null_space.texts, system.null_space.dimension) == (0, 0.0, (), 0)
    singular = contoursolve.system("G111 A90. K0. X100. B120. P5.", start=START, rules="off")
    assert singular.null_space.texts


@pytest.mark.parametrize("value", [np.float64(150), np.int64(150), Fraction(150), sympy.Rational(150), "150"])
def test_a_number_of_any_kind_is_typed_into_a_word_that_goes_by_its_symbol_too(value):
    system = contoursolve.system("G111 X100. A180. K-30. B120. P5.", start=START)
    (symbol,) = (each.symbol for each in system.words if each.name == "B")
    assert system.subs({symbol: value}).inputs == system.subs(B=150.0).inputs
    assert system.free(symbol).free == system.free("B").free
    with pytest.raises(TypeError, match="a word is named by a text, such as 'B'"):
        system.free([symbol])


def test_words_of_a_tie_that_have_the_same_text_are_both_named():
    blocks = "0 BEGIN PGM T MM\n1 L X+0 Y+0 RL F300\n2 FL X+20 Y+0\n3 FL X+40 Y+0 LEN20 AN+0\n9 END PGM T MM\n"
    ties = contoursolve.solve(blocks, control="heidenhain").answer.system.ties
    assert ("X+20", "Y+0", "X+40", "Y+0", "LEN20") in [each.words for each in ties]
