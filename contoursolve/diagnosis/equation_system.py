"""The system of equations of one contour, by sympy: what it leaves open, on which condition it is determined."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from decimal import Decimal, InvalidOperation
from functools import cached_property
from math import atan2, nan
from typing import TYPE_CHECKING, Any, Protocol

from contoursolve.diagnosis.answer_records import Solution
from contoursolve.diagnosis.chosen_solution import Chosen, chosen_solution
from contoursolve.diagnosis.edits import Edit, change, typed_text, with_value
from contoursolve.diagnosis.equation_records import (
    BlockState,
    CornerSystem,
    Equation,
    NullSpace,
    SystemBlock,
    SystemCondition,
    SystemStep,
    SystemUnknown,
    SystemValue,
    TiedWords,
)
from contoursolve.diagnosis.fact_words import condition_text, fact_key, fact_subject, fact_text
from contoursolve.diagnosis.hand_calculation import HandCalculation
from contoursolve.diagnosis.hand_sheet import Derivation
from contoursolve.diagnosis.names_in_program import called_in_program
from contoursolve.diagnosis.reasons import freedom_reasons
from contoursolve.diagnosis.smallest_sets import smallest_sets
from contoursolve.diagnosis.symbol_names import CORNER_PLACES, corner_names, symbol_names
from contoursolve.diagnosis.wording import join, meaning_of, unknowns_text, word_keys
from contoursolve.diagnostics import LateModule, Shown, Span, from_above
from contoursolve.gcode import FACT, Word, words_called
from contoursolve.geometry import (
    Corner,
    CornerShape,
    Fact,
    Given,
    Profile,
    System,
    Unit,
    assemble,
    both,
    line_scalars,
    scalar,
)
from contoursolve.numeric import COSINE, SINE, Array, Expression, angle, symbol
from contoursolve.reading import Control, ParsedContour
from contoursolve.solving import (
    Alternatives,
    ConstructionStep,
    Determinacy,
    Group,
    StepCondition,
    StepKind,
    TypedValues,
    analyse,
    axes_of,
    blocks_of,
    build_function,
    circuits_of,
    conditions_of,
    corner_equations,
    ends_somewhere,
    find_alternatives,
    find_ties,
    first_drawing,
    givens_of_facts,
    is_known,
    is_searched,
    jacobian_of,
    order,
    rank_of,
    rows_of,
    steps_of,
    symbolic_values,
    tie_of,
    values_at,
)

if TYPE_CHECKING:
    from contoursolve.numeric import named_function, symbolic
else:
    # These have sympy and CasADi: importing them takes longer than solving a program.
    symbolic = LateModule("contoursolve.numeric.symbolic")
    named_function = LateModule("contoursolve.numeric.named_function")


_MEANINGS = {"cos": "cosine of the direction of {}", "sin": "sine of the direction of {}", "off": "place of {}"}
_PLACES = {
    "begin": "{0} where {1} begins",
    "end": "{0} where {1} ends",
    "center": "{0} of the centre of {1}",
}
_HOW = {
    StepKind.AFFINE: "linear equations",
    StepKind.RADIUS: "the distance of two points",
    StepKind.LINE_CIRCLE: "a line meets a circle, in two places",
    StepKind.TWO_CIRCLES: "two circles meet, in two places",
    StepKind.GENERAL: "a closed form with several solutions",
}


_SAME = 1e-6
"""mm a mm. By so much a formula of a motion may differ from its number."""


class FreeUnknowns(tuple[Any, ...]):
    """The unknowns that no equation determines, as symbols. A call gives the system without the equations of words."""

    _without: "Callable[[Iterable[str]], EquationSystem]"

    @classmethod
    def of(
        cls, symbols: "Iterable[symbolic.Symbol]", without: "Callable[[Iterable[str]], EquationSystem]"
    ) -> "FreeUnknowns":
        """Symbols, and what a call does."""
        found = cls(symbols)
        found._without = without
        return found

    def __call__(self, *words: str) -> "EquationSystem":
        """The system in which the values of these words (`"K"`, or `"2:K"` with its line) are free."""
        return self._without(words)


class Rereading(Protocol):
    """The control of a contour, which reads its blocks again."""

    @property
    def control(self) -> Control:
        """Its tables."""
        ...

    def read(self, claim: ParsedContour, edits: Iterable[Edit]) -> ParsedContour | None:
        """The contour with edits; None where that is another one, or none."""
        ...

    def profile(self, claim: ParsedContour, without: frozenset[str]) -> Profile:
        """The profile of a contour without what some words state. Raises ValueError."""
        ...

    def part(self, claim: ParsedContour, without: frozenset[str]) -> Profile:
        """The same, of nothing left out what no rule was asked of."""
        ...


class EquationSystem(Shown):
    """The system of equations of one contour, as `contoursolve.system` gives it.

    Nothing is derived before it is asked for; then sympy is imported. Lengths are mm, X of a lathe counts as radius,
    angles are radians. `profile` is the drawing, `claim` the blocks with their words.
    """

    def __init__(
        self, claim: ParsedContour, profile: Profile, read_by: Rereading, without: frozenset[str] = frozenset()
    ) -> None:
        self.claim, self.profile, self._read_by, self._left_out = claim, profile, read_by, without
        self._system: System = assemble(profile)

    def _made_of(self) -> tuple[ParsedContour, Profile, Rereading, frozenset[str]]:
        return self.claim, self.profile, self._read_by, self._left_out

    def __eq__(self, other: object) -> bool:
        return isinstance(other, EquationSystem) and self._made_of() == other._made_of()

    def __hash__(self) -> int:
        return hash((self.claim.form.name, self.profile.layout, self._left_out))

    def __reduce__(self) -> Any:
        return EquationSystem, self._made_of()

    @property
    def control(self) -> Control:
        """The control that reads it, as tables."""
        return self._read_by.control

    # What it consists of -----------------------------------------------------------------------------------------

    @cached_property
    def unknowns(self) -> tuple[SystemUnknown, ...]:
        """The unknowns: coordinates of points, radii, directions of lines; in the order of `jacobian`'s columns."""
        return tuple(map(self._unknown, self._system.unknowns))

    @cached_property
    def words(self) -> tuple[SystemValue, ...]:
        """The values that words state, the start point, and the sides on which the contour that was solved touches or
        lies, where nothing states them: each with its symbol, meaning and number."""
        return (*self._start(), *map(self._value, self._stated()), *self._open_sides())

    @property
    def values(self) -> "dict[symbolic.Symbol, symbolic.Expr]":
        """The numbers of the words and of the start point by their symbols, exact, in mm and radians."""
        return {each.symbol: each.number for each in self.words if each.number is not None}

    @property
    def solution(self) -> "dict[symbolic.Symbol, float]":
        """The values of the unknowns in the contour that was solved, by their symbols; empty without one."""
        return {each.symbol: each.value for each in self.unknowns if each.value is not None}

    @cached_property
    def statements(self) -> tuple[Equation, ...]:
        """Each equation with the word that states it and what it says; in the order of `jacobian`'s rows."""
        return tuple(map(self._equation, self._system.facts))

    @property
    def equations(self) -> "tuple[symbolic.Eq, ...]":
        """The equations, of sympy: one for each word that states one, then those of the form itself."""
        return tuple(each.equation for each in self.statements)

    @cached_property
    def senses(self) -> tuple[Any, ...]:
        """The expressions that must be positive besides, because the equations alone allow the opposite."""
        at = symbolic_values(self._symbols, symbolic.FUNCTIONS, self._system.headed)
        return tuple(each for fact in self._system.facts for each in fact.senses(at) if not each.is_number)

    @cached_property
    def corners(self) -> tuple[CornerSystem, ...]:
        """The corners with the places where they begin and end, their centres, and the equations of these; none of a
        corner that has nothing to end on."""
        figure = self._system.figure
        return tuple(self._corner(each) for each in figure.corners if ends_somewhere(each, figure))

    def _repr_latex_(self) -> str:
        """The equations, one below the other, and the condition."""
        return f"$\\displaystyle {from_above('system_latex', self)}$"

    # What sympy says of it ---------------------------------------------------------------------------------------

    @cached_property
    def jacobian(self) -> "symbolic.Matrix":
        """The derivatives of the equations by the unknowns, a Matrix of sympy: a row for each equation, a column for
        each unknown."""
        return jacobian_of(self._system, self._symbols)

    @property
    def rank(self) -> int:
        """The rank of the Jacobian, exact, for all values but those on which the condition is zero."""
        return self._verdict.rank

    @property
    def is_determined(self) -> bool:
        """Whether the equations determine every unknown."""
        return self._verdict.is_determined

    @property
    def dof(self) -> int:
        """The degrees of freedom: the unknowns less the rank."""
        return len(self._system.unknowns) - self.rank

    @property
    def free(self) -> FreeUnknowns:
        """The unknowns that nothing determines, as symbols. `free("K")` is the system without the value of a word."""
        return FreeUnknowns.of(map(self._symbols.scalar, self._verdict.free), self._without)

    @cached_property
    def null_space(self) -> NullSpace | None:
        """The motions that are left at a drawing that has all that is stated; None where none is found."""
        drawing = first_drawing(self.profile)
        if drawing is None:
            return None
        names, verdict, exact = self._system.unknowns, self._verdict, None
        if self._chosen is not None:
            # A solution stands alone; where the slopes of its equations vanish, as of an arc that ends where it may end
            # at most, these alone would let it move.
            values = {self._symbols.scalar(name): self._chosen.scalars[name] for name in names}
            return NullSpace(values, (), (), drawing.basis[:, :0], symbolic.no_motions(len(names)))
        values = {self._symbols.scalar(name): value for name, value in drawing.scalars.items()}
        values |= {self._symbols.scalar(side): float(sign) for side, sign in drawing.sides.items()}
        if drawing.dimension == len(names) - verdict.rank:
            exact = self._exact_motions([*drawing.leading], values | self.values, drawing.basis)
        texts = tuple(freedom_reasons(self.profile, [*drawing.freedoms()]))
        return NullSpace(values, drawing.motions, texts, drawing.basis, exact)

    def _exact_motions(self, leading: Sequence[str], values: Mapping[Any, Any], numbers: Array) -> Any:
        """The motions of leading unknowns as formulas; None where these are too long, or do not give the numbers at the
        values of a drawing, where they divide by nothing."""
        system, facts = self._system, self._system.facts
        bound = [name for name in system.unknowns if name not in leading]
        try:
            groups = order(system, [facts[row] for row in self._verdict.basis], bound)
        except ValueError:
            return None  # in general, others lead
        rows, columns = ({each: place for place, each in enumerate(some)} for some in (map(id, facts), system.unknowns))
        places = [([rows[id(fact)] for fact in each.facts], [columns[n] for n in each.unknowns]) for each in groups]
        exact = symbolic.null_space(self.jacobian, places, [columns[name] for name in leading])
        is_right = exact is not None and symbolic.is_near(exact, values, numbers, _SAME)
        return exact if is_right else None

    @cached_property
    def ties(self) -> tuple[TiedWords, ...]:
        """Each smallest set of words that say the same, with the equation that ties them, if it has a formula.

        Of a start point that is not known, one for each word that others determine."""
        profile, system = self.profile, self._system
        if profile.start.is_known:
            sets = smallest_sets(self._part, find_ties(profile, is_told=True), profile).found
            facts = [(each.facts, assemble(each.profile), each.givens, each.is_conflict) for each in sets]
        else:
            tied = [(*others, last) for last, others in circuits_of(system).items()]
            facts = [(each, system, givens_of_facts(each, system), False) for each in tied]
        found = []
        for each, of, givens, is_conflict in facts:
            words = {word.span: word.text for name in givens if (word := profile.givens[name].word)}
            found.append(TiedWords(tuple(words.values()), tie_of(of, each, self._symbols), is_conflict))
        return tuple(found)

    @property
    def conflicts(self) -> tuple[TiedWords, ...]:
        """The ties whose words disagree."""
        return tuple(each for each in self.ties if each.is_conflict)

    @property
    def redundant(self) -> tuple[TiedWords, ...]:
        """The ties whose words agree: one of each says nothing new."""
        return tuple(each for each in self.ties if not each.is_conflict)

    @cached_property
    def conditions(self) -> tuple[SystemCondition, ...]:
        """The condition of each step that has one, in the order in which the steps are solved; none where something is
        free, nor of the steps that are `too_large`."""
        found = list[SystemCondition]()
        for each in self._step_conditions:
            expression = symbolic.product(each.factors)
            if each.factors:
                determines = tuple(map(self._symbols.scalar, each.group.unknowns))
                value = symbolic.value_at(expression, self._numbers)
                meaning = self._called(condition_text(each.group, self._system, self.profile))
                found.append(SystemCondition(expression, value, meaning, determines))
        return tuple(found)

    @property
    def too_large(self) -> tuple[tuple[SystemUnknown, ...], ...]:
        """The unknowns of each step of which no condition is worked out, for it has too many of them."""
        named = dict(zip(self._system.unknowns, self.unknowns, strict=True))
        large = (each.group for each in self._step_conditions if each.is_large)
        return tuple(tuple(named[name] for name in group.unknowns) for group in large)

    @property
    def condition(self) -> "symbolic.Expr | None":
        """The expression that must not be zero for the equations to determine the unknowns: 1 if they always do, None
        if they never do. It leaves out the steps that are `too_large`."""
        if not self.is_determined:
            return None
        factors = (factor for each in self.conditions for factor in symbolic.factors_of(each.expression))
        return symbolic.product(factors)

    @property
    def margin(self) -> float | None:
        """The value of the condition at the contour that was solved; None without one."""
        return symbolic.value_at(self.condition, self._numbers) if self.is_determined else None

    @cached_property
    def steps(self) -> tuple[SystemStep, ...]:
        """The steps in which the unknowns are found, one after the other; none where something is free."""
        return tuple(map(self._step, steps_of(self._system))) if self.is_determined else ()

    @cached_property
    def blocks(self) -> tuple[SystemBlock, ...]:
        """The equations and unknowns in blocks, in the order in which they are solved: the Jacobian is triangular in
        it. What stays open comes then, and last the equations that repeat others."""
        groups, left, repeated = blocks_of(self._system, self._verdict)
        rows = {id(fact): row for row, fact in enumerate(self._system.facts)}
        columns = {name: column for column, name in enumerate(self._system.unknowns)}
        told = [*((BlockState.SOLVED, group) for group in groups), (BlockState.OPEN, left)]
        told.append((BlockState.REPEATED, Group(repeated, ())))
        return tuple(
            SystemBlock(state, tuple(rows[id(fact)] for fact in facts), tuple(columns[name] for name in unknowns))
            for state, (facts, unknowns) in told
            if facts or unknowns
        )

    @cached_property
    def derivation(self) -> Derivation:
        """The calculation by hand of the contour that was solved, as its construction has it, then of its corners.

        Raises ValueError without a contour.
        """
        chosen = self._chosen
        if chosen is None:
            raise ValueError("there is no contour at the values of the words that could be calculated")
        profile, system, symbols = self.profile, self._system, self._symbols
        places = {corner.name: self._places(corner) for corner in system.figure.corners}
        hand = HandCalculation(profile, system, symbols, self.values, chosen.scalars, chosen.solution.corners, places)
        return Derivation(tuple(hand.steps()))

    def of_word(self, word: str | Word) -> tuple[tuple[Equation, ...], tuple[SystemCondition, ...]]:
        """The equations that a word states, and the conditions in which it plays a part.

        The word is `"B"`, or `"2:B"` with its line, its symbol, or one of `words` of its answer. Raises ValueError for
        what is no word of the contour."""
        if isinstance(word, Word):
            spans = {word.span}
        else:
            spans = {each.word.span for each in self._named(word) if each.word is not None}
        symbols = {each.symbol for each in self.words if each.source and each.source.span in spans}
        stated = tuple(each for each in self.statements if each.source and each.source.span in spans)
        return stated, tuple(each for each in self.conditions if symbols & each.expression.free_symbols)

    # What can be done with it ------------------------------------------------------------------------------------

    def solve(self) -> Alternatives:
        """Every solution of the equations, certified: `items`, and whether these are proven to be all.

        Raises ValueError where something is free, or the start point is not known.
        """
        if not self.is_determined:
            raise ValueError(f"still open: {unknowns_text(self._verdict.free, self.profile)}")
        if not self.profile.start.is_known:
            raise ValueError("the start point is not known")
        return find_alternatives(self.profile)

    def subs(self, values: Mapping[str, float] | None = None, /, **words: float) -> "EquationSystem":
        """The system of the block with other numbers in words, as they are typed with a decimal point: `subs(A=120)`,
        `subs({"2:X": 80})`, or by a symbol, `subs(X_2=80)`. The block is read anew, with these words.

        Raises ValueError for what is no word with a number in the block, and where the block is no contour then."""
        edits = dict[Span, Edit]()
        spelling = self._read_by.control.modes.syntax.words
        for key, typed in {**(values or {}), **words}.items():
            for given in self._named(key):
                assert given.word is not None
                edits[given.word.span] = change(given.word, with_value(given.word, _typed(typed), spelling))
        claim = self._read_by.read(self.claim, edits.values())
        told = ", ".join(edit.text for edit in edits.values())
        if claim is None:
            raise ValueError(f"with {told} the block is read as another contour, or as none")
        found = self._read_by.profile(claim, self._left_out)
        return EquationSystem(claim, found, self._read_by, self._left_out)

    def function(self, name: str = "contour", *, solution: str | Solution | None = None) -> "named_function.Function":
        """The contour as a function of CasADi, for `map`, `jacobian`, `nlpsol` and whatever else that has.

        Inputs are the start point and the words with a value, a scalar each, by the names of their symbols and as they
        are typed with a decimal point: X of a lathe as a diameter, inches in an inch program, degrees. By name, one
        that is left out has the value that it has in the block.

        Outputs, mm and X as radius, are matrices; `rows` has the names of their rows:

        * `points` (n, 2), `radii` (n, 1): the points of the drawing and the radii of its arcs;
        * `elements` (n, 4): where each element begins and ends, corners among them, in the order of travel;
        * `centers` (n, 2): those of the roundings;
        * `room` (n, 1): what the corners leave of each element, negative where they do not fit;
        * `conditions` (n, 1): the values of `conditions`, zero where a step is not determined;
        * `residuals` (n, 1): by how much each equation is missed.

        It follows the solution that the control takes at the values of the words, in closed form where there is one,
        else by Newton's method from there on. It checks nothing: a contour is right where `room` is not negative,
        `residuals` are zero and no line runs backwards. The side to which an arc bends that only touches the element
        before stays, too, although the control may then read it otherwise. With `solution`, such as `"P1 nearer"`,
        it follows the solution of that name in `answer.solutions` instead, also where no word of the block chooses one.

        Raises ValueError where there is no contour to follow, or no solution of that name.
        """
        if not isinstance(name, str):
            raise TypeError(f"a function takes all words, and no names but its own: function()(B=120), not {name!r}")
        if solution is not None:
            return self._along(solution).function(name)
        chosen = self._chosen
        if chosen is None:
            why = f"still open: {join(list(map(str, self.free)))}" if self.free else "subs(B=150) writes others"
            if not self.free and (names := [each.name for each in self.solve().paths]):
                why = f"of several, name one: solution={' or '.join(map(repr, names))}"
            raise ValueError(f"there is no contour at the values of the words that a function could follow; {why}")
        inputs, typed = self._inputs()
        known = self.inputs, chosen.scalars
        found: named_function.Function = build_function(self.profile, name, inputs, typed, self._conditions_of, known)
        return found

    @property
    def inputs(self) -> dict[str, float]:
        """The inputs of `function` as they are typed, by their names: `system.function()(**system.inputs)`."""
        profile, found = self.profile, dict[str, float]()
        for axis, value in enumerate(profile.start.values):
            scale = profile.unit.in_mm / (2 if profile.plane.diameters[axis] else 1)
            found[self._names[scalar(self._system.figure.start, axis)]] = nan if value is None else float(value / scale)
        for given in self._typed_words():
            found[self._names[given.name]] = float(
                (self._read(given) - (given.clockwise_from or 0)) / self._scale_of(given)
            )
        return found

    @property
    def rows(self) -> dict[str, tuple[str, ...]]:
        """The names of the rows of each output of `function`."""
        told = tuple(each.word or each.meaning for each in self.statements)
        return rows_of(self._system) | {
            "conditions": tuple(each.meaning for each in self.conditions),
            "residuals": told,
        }

    def _inputs(self) -> tuple[dict[str, Expression], TypedValues]:
        """The inputs of the function, and the values of the contour as expressions of them."""
        profile, inputs = self.profile, dict[str, Expression]()
        scales = [profile.unit.in_mm / (2 if is_half else 1) for is_half in profile.plane.diameters]
        start = []
        for axis, scale in enumerate(scales):
            name = self._names[scalar(self._system.figure.start, axis)]
            inputs[name] = symbol(name)
            start.append(inputs[name] * float(scale))
        givens: dict[str, Any] = {}
        for given in self._typed_words():
            name = self._names[given.name]
            inputs[name] = symbol(name)
            scale, rest = self._following(given)
            givens[given.name] = inputs[name] * float(scale) + float(rest) if rest else inputs[name] * float(scale)
        for given in profile.givens.values():
            if given.follows in givens:
                moved = float(given.value - profile.givens[given.follows].value)
                givens[given.name] = givens[given.follows] + moved
        return inputs, TypedValues((start[0], start[1]), givens, self._sides)

    def _conditions_of(self, at: Mapping[str, Any]) -> list[Any]:
        """The conditions as expressions of CasADi, of the values by name."""
        symbols, system = self._symbols, self._system
        values = {symbols.scalar(name): at[name] for name in (*system.unknowns, *both(system.figure.start))}
        for given in self._stated():
            if given.unit is Unit.DEGREE:
                values[symbols.angle(given.name)] = angle(at[given.name + SINE], at[given.name + COSINE])
            else:
                values[symbols.scalar(given.name)] = at[given.name]
        values |= {symbols.scalar(name): sign for name, sign in self._sides.items()}
        for line in system.figure.carriers:
            cosine, sine, _ = line_scalars(line)
            values[symbolic.symbol(self._names[line])] = angle(at[sine], at[cosine])
        return [symbolic.casadi_of(each.expression, values) for each in self.conditions]

    def to_json(self) -> str:
        """The system with its verdicts as JSON, as `export([system], "name.json")` writes it of several.

        Formulas are as Python and sympy write them; numbers of words are exact texts, such as `"2*pi/3"`. Lengths are
        mm, X of a lathe counts as radius, angles are radians. `docs/systems.schema.json` is the schema.
        """
        text: str = from_above("systems_to_json", self)
        return text

    def to_smt(self) -> str:
        """The system for a solver of SMT-LIB, such as z3 or cvc5: whether the values of the words leave any solution.

        Its logic is QF_NRA. Each equation is named by its word, so that `(get-unsat-core)` tells the words that
        contradict each other. `unsat` is a proof that nothing satisfies all words as they are typed; words that repeat
        others, but are rounded, contradict them. `export([system], "name.smt2")` writes several. Raises ValueError for
        an equation that is no polynomial.
        """
        text: str = from_above("to_smt", self)
        return text

    def _along(self, solution: str | Solution) -> "EquationSystem":
        """The system with a solution, by its name, as the one that is meant."""
        name = solution.name if isinstance(solution, Solution) else solution
        every = self.solve()
        found = next((each for each in every.paths if each.name == name), None)
        if found is None:
            have = ", ".join(repr(each.name) for each in every.paths) or "none"
            raise ValueError(f"no solution is called {name!r}; there are {have}")
        meant = EquationSystem(*self._made_of())
        meant._chosen = Chosen(found.solution, found.scalars, found.sides)
        return meant

    def _without(self, words: Iterable[str]) -> "EquationSystem":
        names = self._left_out.union(given.name for key in words for given in self._named(key))
        return EquationSystem(self.claim, self._read_by.profile(self.claim, names), self._read_by, names)

    # -------------------------------------------------------------------------------------------------------------

    def _part(self, without: frozenset[str]) -> Profile:
        return self._read_by.part(self.claim, self._left_out | without)

    @cached_property
    def _names(self) -> Mapping[str, str]:
        return symbol_names(self.claim, self.profile, self._system)

    @cached_property
    def _called(self) -> Callable[[str], str]:
        return called_in_program(self.profile)

    @cached_property
    def _symbols(self) -> "symbolic.Symbols":
        return symbolic.Symbols(lambda name: self._names.get(name, name))

    @cached_property
    def _numbers(self) -> dict[Any, Any]:
        """The values of all symbols, as far as they are known."""
        return self.values | self.solution | self._turned()

    @cached_property
    def _step_conditions(self) -> list[StepCondition]:
        if not self.is_determined:
            return []
        return conditions_of(self._system, self._symbols, self.jacobian, self._verdict.basis)

    @cached_property
    def _verdict(self) -> Determinacy:
        system = self._system
        return analyse(system) if is_known(system) else rank_of(system, self._symbols, self.jacobian)

    @cached_property
    def _chosen(self) -> Chosen | None:
        """The solution that the control takes."""
        figure, known = self._system.figure, {*self.profile.givens, *self._system.unknowns}
        # Where a fact that asks for its size is refused, a corner has none.
        is_sized = all(each.size in known or each.radius in known for each in figure.corners)
        is_ready = is_sized and self.profile.start.is_known and self.is_determined
        return chosen_solution(self.profile) if is_ready else None

    @cached_property
    def _sides(self) -> Mapping[str, int]:
        """The sign of each side that no word states, in the contour that was solved, by its name."""
        facts = self._system.facts
        if self._chosen is None or not any(fact.sides() for fact in facts):
            return {}
        signs = values_at(self.profile, facts, self._chosen.scalars).signs
        return {side: signs[side] for fact in facts for side in fact.sides()}

    def _unknown(self, name: str) -> SystemUnknown:
        thing, _, part = name.rpartition(".")
        meaning = f"{self.profile.plane.axes[int(part)]} of {thing}" if part.isdigit() else _MEANINGS.get(part, "")
        meaning = self._called(meaning.format(thing) or unknowns_text([name], self.profile))
        unit = "" if part in ("cos", "sin") else "mm"
        value = self._chosen.scalars.get(name) if self._chosen else None
        return SystemUnknown(self._symbols.scalar(name), meaning, unit, value, self._names[name])

    def _stated(self) -> list[Given]:
        used = {name for fact in self._system.facts for name in (fact.given, *map(str, fact.reads()))}
        used |= {corner.size for corner in self._system.figure.corners}
        for heading, place in self._system.headed.values():
            used |= {heading, *both(place)}
        return [given for given in self.profile.givens.values() if given.name in used and given.unit is not Unit.SIGN]

    def _typed_words(self) -> list[Given]:
        """The values that a word with a number states."""
        words = ((given, given.word) for given in self._stated())
        return [
            given for given, word in words if word is not None and (word.number is not None or word.address == FACT)
        ]

    def _read(self, given: Given) -> Decimal:
        """The value of a word by itself, mm or degrees; it may count from another one."""
        word = given.word
        value = self.claim.lexicon.value(word, self.profile.unit) if word and word.address != FACT else None
        return given.value if value is None else value

    def _start(self) -> list[SystemValue]:
        profile, figure = self.profile, self._system.figure
        found = []
        for axis, value in enumerate(profile.start.values):
            name = scalar(figure.start, axis)
            number = symbolic.exact(value) if value is not None else None
            meaning = f"{profile.plane.axes[axis]} of the start point"
            found.append(SystemValue(self._symbols.scalar(name), meaning, "mm", number, self._names[name]))
        return found

    def _open_sides(self) -> list[SystemValue]:
        """The sides as values: -1 or 1, of which a number says which way a contour touches."""
        named = {side: fact.side_names for fact in self._system.facts for side in fact.sides()}
        return [
            SystemValue(
                self._symbols.scalar(side),
                f"the side on which it touches: 1 is {first}, -1 is {second}",
                "",
                symbolic.exact(Decimal(self._sides[side])) if side in self._sides else None,
                self._names[side],
            )
            for side, (first, second) in named.items()
        ]

    def _value(self, given: Given) -> SystemValue:
        is_angle = given.unit is Unit.DEGREE
        symbol = self._symbols.angle(given.name) if is_angle else self._symbols.scalar(given.name)
        number = symbolic.exact(given.value, is_angle=is_angle)
        meaning = self._called(meaning_of(given.name, given.word, self.claim)) if given.word else ""
        return SystemValue(symbol, meaning, "rad" if is_angle else "mm", number, self._names[given.name], given.word)

    def _equation(self, fact: Fact) -> Equation:
        numeric, symbols = symbolic, self._symbols
        at = symbolic_values(symbols, numeric.FUNCTIONS, self._system.headed)
        given = self.profile.givens.get(fact.given) if fact.given else None
        word = given.word if given is not None else None
        if fact.placed is not None:
            point, axis, origin, is_stepped = fact.placed
            right = at.coordinate(origin, axis) if origin else 0
            right += at.amount(fact.given) if is_stepped else 0
            found = numeric.equation(at.coordinate(point, axis), right)
        elif fact.sizes and fact.given:
            found = numeric.equation(symbols.scalar(fact.sizes), at.amount(fact.given))
        else:
            found = numeric.balanced(fact.equation(at))
        meaning = self._called(fact_text(fact, self._system.unknowns, self.profile))
        return Equation(found, "" if word is not None and word.address == FACT else meaning, word)

    def _places(self, corner: Corner) -> Mapping[str, tuple[Any, Any]]:
        """The symbols of the places of a corner."""
        names = corner_names(corner.name, self.profile, self._names.values())
        return {place: (symbolic.symbol(one), symbolic.symbol(two)) for place, (one, two) in names.items()}

    def _corner(self, corner: Corner) -> CornerSystem:
        numeric, pairs = symbolic, self._places(corner)
        at = symbolic_values(self._symbols, numeric.FUNCTIONS, self._system.headed)
        size = corner.radius if corner.radius in self._system.unknowns else corner.size
        told = corner_equations(
            corner, self._system.figure, at, self._symbols.scalar(size), *(pairs[place] for place in CORNER_PLACES)
        )
        solved = self._chosen.solution.corners.get(corner.name) if self._chosen else None
        shown = CORNER_PLACES if corner.shape is CornerShape.FILLET else CORNER_PLACES[:2]
        unknowns = []
        for place in shown:
            point = getattr(solved, place) if solved else None
            for axis, own in enumerate(pairs[place]):
                meaning = self._called(_PLACES[place].format(self.profile.plane.axes[axis], corner.name))
                unknowns.append(SystemUnknown(own, meaning, "mm", point[axis] if point else None, str(own)))
        given = self.profile.givens.get(corner.size)
        word = given.word if given else None
        equations = tuple(Equation(numeric.balanced(zero), self._called(meaning), word) for meaning, zero in told)
        return CornerSystem(corner.name, tuple(unknowns), equations)

    def _step(self, step: ConstructionStep) -> SystemStep:
        rows = dict(zip(self._system.facts, self.statements, strict=True))
        is_searched_for = len(step.unknowns) > 1 and is_searched(self._system, Group(step.facts, step.unknowns))
        how = "no closed form: searched, and proven" if is_searched_for else _HOW[step.kind]
        symbols = tuple(map(self._symbols.scalar, step.unknowns))
        return SystemStep(symbols, tuple(rows[fact] for fact in step.facts), how, not is_searched_for)

    def _turned(self) -> dict[Any, Any]:
        """The angles of lines whose direction is an unknown, by their symbols."""
        if self._chosen is None:
            return {}
        scalars = self._chosen.scalars
        lines = self._system.figure.carriers
        return {
            symbolic.symbol(self._names[line]): atan2(scalars[f"{line}.sin"], scalars[f"{line}.cos"]) for line in lines
        }

    def _named(self, key: object) -> list[Given]:
        """The values that a word states, by its key, its symbol or its text, as `TiedWords` has it; of a fact also by
        what it gives the value of. Raises ValueError."""
        if not isinstance(key, str):
            if not isinstance(key, symbolic.Symbol):
                raise TypeError(f"a word is named by a text, such as 'B' or '2:B', or by its symbol, not by {key!r}")
            key = str(key)
        keys = word_keys(self.claim.words.values())
        words = self.claim.words.values()
        called = {
            word.span for word in words_called(key, words) or [each for each in words if each.text.strip() == key]
        }
        spans = called if len(called) == 1 else set()
        stated = [(given, given.word) for given in self.profile.givens.values() if given.word is not None]
        facts = {word.span: fact_subject(word.text) for _, word in stated if word.address == FACT}
        spans |= {span for span, subject in facts.items() if fact_key(subject) == fact_key(key)}
        found = [given for given, word in stated if word.span in spans or self._names.get(given.name) == key]
        if not found:
            known = dict.fromkeys((*keys.values(), *facts.values()))
            raise ValueError(f"{key} is no word of the contour; its words are {join(list(known))}")
        if any(given.unit is Unit.SIGN for given in found):
            raise ValueError(f"{key} chooses between two solutions: its value is in no equation")
        return found

    def _following(self, given: Given) -> tuple[Decimal, Decimal]:
        """The mm or degrees for each unit of the word that states a value, and what there is besides: it may count from
        another one that stays, and of a size the sign may say something else."""
        read, scale = self._read(given), self._scale_of(given)
        if read and given.unit is Unit.MM and given.value == -read and given.name not in axes_of(self._system):
            return -scale, Decimal(0)
        return scale, given.value - read + (given.clockwise_from or 0)

    def _scale_of(self, given: Given) -> Decimal:
        """The mm (radius) or degrees of one unit of a word with a decimal point."""
        if given.unit is not Unit.MM:
            return Decimal(1 if given.clockwise_from is None else -1)
        return self.profile.unit.in_mm / (1 + given.is_diameter)


def _typed(value: float | Decimal | str) -> str:
    """A number as it is typed, with a decimal point. Raises ValueError for what is none."""
    is_exact = isinstance(value, Decimal | str | int)
    try:
        number = Decimal(str(value) if is_exact else repr(float(value)))
    except (InvalidOperation, TypeError, ValueError):
        number = Decimal("nan")
    if not number.is_finite():
        raise ValueError(f"{value!r} is no number")
    return typed_text(number.normalize())
