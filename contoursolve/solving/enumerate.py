"""All solutions of a determined system, step by step, with proof of their number or an honest doubt."""

from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from functools import lru_cache, partial
from itertools import product
from typing import TypeVar

from msgspec import Struct

from contoursolve.geometry import Fact, Profile, System
from contoursolve.numeric import SIDE, Number, ball
from contoursolve.solving.branch_and_prune import Division, Task, conditions_of, divide, settle
from contoursolve.solving.closed_steps import close_step
from contoursolve.solving.determinacy import groups_of, witness_of
from contoursolve.solving.elimination import Close, ObstacleError, Root, solve_step
from contoursolve.solving.exact_inputs import Ground, ground_of
from contoursolve.solving.partition import Group
from contoursolve.solving.senses import Sense, senses_of
from contoursolve.solving.solution import Doubt, Obstacle
from contoursolve.solving.step_equations import Coefficient, Kernel, Local, local_of, make_kernel, polynomials_of


class Effort(Struct, frozen=True):
    """The number of intervals, one for each unknown of a box, that are looked at for one drawing before the search is
    given up as undecided; and how many every step may look at, however many the ones before it used.

    With `is_guessing`, a search that is given up is followed by one for solutions near what it left undecided.
    """

    intervals: int
    least: int
    is_guessing: bool = False


DRAWING = Effort(300_000, 30_000, is_guessing=True)
"""For a single drawing; about three seconds."""


class ExactSolution(Struct, frozen=True):
    """One solution of the equations: every unknown, exact or in a ball, and the sides at which elements touch.

    `doubles` are the unknowns of steps whose two solutions have become one.
    """

    scalars: Mapping[str, Number]
    signs: Mapping[str, int]
    doubles: tuple[str, ...] = ()


class Enumeration(Struct, frozen=True):
    """The result of a search. The list is complete, with proof, if there is no doubt."""

    found: tuple[ExactSolution, ...]
    doubts: tuple[Doubt, ...]
    within: float | None = None
    """The distance from the start point within which there is no other solution, mm, where some step has no closed form
    and was searched for; None where all have one."""
    boxes: int = 0
    """The number of boxes that the search looked at."""

    @property
    def is_complete(self) -> bool:
        """Whether these are all the solutions there are."""
        return not self.doubts


def enumerate_solutions(profile: Profile, system: System, unsensed: frozenset[Fact] = frozenset()) -> Enumeration:
    """All solutions of a determined system at the values of a profile, whatever the choices of the control, and
    whichever way what `unsensed` facts are about runs."""
    (found,) = enumerate_each([profile], system, unsensed)
    return found


def enumerate_each(
    profiles: Sequence[Profile], system: System, unsensed: frozenset[Fact] = frozenset()
) -> list[Enumeration]:
    """The solutions at the values of each profile; what has no closed form is searched for all of them together.

    Where a ball is too wide to decide, everything is done again with four times the digits.
    """
    groups, found = groups_of(system), [Enumeration((), ())] * len(profiles)
    left = list(range(len(profiles)))
    for bits, close in ((ball.WORKING, Close.REFUSE), (ball.HIGHEST, Close.DOUBLE)):
        with ball.precision(bits):
            grounds = [ground_of(profiles[number]) for number in left]
            for number, each in zip(
                left, enumerate_many(grounds, system, groups, close, DRAWING, unsensed), strict=True
            ):
                if not isinstance(each, Enumeration):
                    raise each
                found[number] = each
        # More digits do not finish a search.
        unsure = (Obstacle.TOUCHING, Obstacle.UNDECIDED)
        left = [number for number in left if any(doubt.obstacle in unsure for doubt in found[number].doubts)]
    return found


Undecidable = ArithmeticError | ValueError
"""The errors of numbers that are too wide to decide by."""


def enumerate_many(
    grounds: Sequence[Ground],
    system: System,
    groups: tuple[Group, ...],
    close: Close,
    effort: Effort,
    unsensed: frozenset[Fact] = frozenset(),
) -> list[Enumeration | Undecidable]:
    """All solutions on each ground, or the error in which the search ended; what has no closed form is searched for on
    all of them together."""
    searches = [_Search(system, groups, ground, close, effort, unsensed).run() for ground in grounds]
    found: dict[int, Enumeration | Undecidable] = {}
    waiting: dict[int, tuple[Group, Task]] = {}

    def go_on(number: int, step: Callable[[], tuple[Group, Task]]) -> None:
        try:
            waiting[number] = step()
        except StopIteration as end:
            found[number] = end.value
        except (ArithmeticError, ValueError) as error:
            found[number] = error

    for number, search in enumerate(searches):
        go_on(number, search.__next__)
    for group in groups:
        while together := [number for number, (where, _) in waiting.items() if where is group]:
            answers = divide(conditions_of(system, group), [waiting.pop(number)[1] for number in together])
            for number, answer in zip(together, answers, strict=True):
                go_on(number, partial(searches[number].send, answer))
    return [found[number] for number in range(len(searches))]


_Result = TypeVar("_Result")
_Steps = Generator[tuple[Group, Task], tuple[list[Division], int], _Result]
"""Stops where a step has no closed form, and goes on with what its task leads to."""

MOST_SOLUTIONS = 512
"""Solutions that are followed; each point that may lie in two places doubles their number."""


class _Search:
    def __init__(
        self,
        system: System,
        groups: tuple[Group, ...],
        ground: Ground,
        close: Close,
        effort: Effort,
        unsensed: frozenset[Fact],
    ) -> None:
        self.system = system
        self.groups = groups
        self.ground = ground
        self.close = close
        self.doubts: list[Doubt] = []
        self.within: float | None = None
        self.boxes = 0
        self.effort = effort
        self.left = effort.intervals
        self.near, self.far = ground.nearby(system), ground.farthest(system)
        self.senses = [sense for sense in senses_of(system) if unsensed.isdisjoint(sense.facts)]
        self.sensing: dict[str, list[int]] = {}
        """By unknown or side, the senses that read it."""
        for number, sense in enumerate(self.senses):
            for name in sense.reads | sense.sides:
                self.sensing.setdefault(name, []).append(number)

    def run(self) -> _Steps[Enumeration]:
        """Everything but the steps without a closed form, which are left to whoever runs it."""
        states = [ExactSolution({}, {})]
        for group in self.groups:
            states = yield from self._advance(states, group)
            if not states:
                break
            if len(states) > MOST_SOLUTIONS:
                self.doubts.append(Doubt(group.unknowns, Obstacle.UNFINISHED))
                states = states[:MOST_SOLUTIONS]
        states = [self._with_sides(state) for state in states]
        return Enumeration(tuple(states), tuple(dict.fromkeys(self.doubts)), self.within, self.boxes)

    def _with_sides(self, state: ExactSolution) -> ExactSolution:
        """The state with the sides of facts that were not needed: where the fact is nearer to being true."""
        signs = dict(state.signs)
        for fact in self.system.facts:
            for side in fact.sides():
                if side not in signs:
                    off = {
                        sign: ball.distance(
                            fact.residual(self.ground.values(state.scalars, {**signs, side: sign}, self.system)), 0.0
                        )
                        for sign in (1, -1)
                    }
                    signs[side] = 1 if off[1] <= off[-1] else -1
        return ExactSolution(state.scalars, signs, state.doubles)

    def _advance(self, states: Sequence[ExactSolution], group: Group) -> _Steps[list[ExactSolution]]:
        local = local_of(self.system, group)
        kernel = make_kernel(local)
        cases = [
            ExactSolution(state.scalars, signs, state.doubles) for state in states for signs in _choices(state, kernel)
        ]
        solved = self._solve_each(local, cases)
        unsolved = [case for case, roots in zip(cases, solved, strict=True) if roots is None]
        searched = iter((yield from self._search(group, kernel, unsolved)) if unsolved else [])
        numbers = {number for name in (*kernel.unknowns, *kernel.sides) for number in self.sensing.get(name, ())}
        senses = [self.senses[number] for number in sorted(numbers)]
        found: list[ExactSolution] = []
        for case, roots in zip(cases, solved, strict=True):
            for root in next(searched) if roots is None else roots:
                values = {kernel.unknowns[index]: each for index, each in root.values.items()}
                doubles = case.doubles + (kernel.unknowns if root.is_double else ())
                after = ExactSolution({**case.scalars, **values}, case.signs, doubles)
                if self._is_possible(after, kernel, senses):
                    found.append(after)
        return found

    def _solve_each(self, local: Local, cases: Sequence[ExactSolution]) -> list[list[Root] | None]:
        """All solutions of a step for each case. Cases that differ elsewhere alone have the very same numbers here, and
        are solved once."""
        closed = close_step(local)
        step = closed if closed is not None else polynomials_of(local)
        if step is None:
            return [None] * len(cases)
        given = [ball.SameNumbers(self._numbers(step.parameters, case)) for case in cases]
        for numbers in dict.fromkeys(given):
            roots, obstacle = _roots_of(local, numbers, self.close)
            doubles = (each for root in roots or () if root.is_double for each in root.values.values())
            if obstacle is None and not all(map(ball.is_exact, doubles)):
                obstacle = Obstacle.TOUCHING
            if obstacle is not None:
                self.doubts.append(Doubt(local.group.unknowns, obstacle))
        return [_roots_of(local, numbers, self.close)[0] for numbers in given]

    def _numbers(self, names: Sequence[str], case: ExactSolution) -> list[Number]:
        return [self.ground.number(name, case.scalars, case.signs) for name in names]

    def _search(self, group: Group, kernel: Kernel, cases: Sequence[ExactSolution]) -> _Steps[list[list[Root]]]:
        """All solutions of a step without a closed form, for each case; all cases are searched together, and those that
        differ elsewhere alone are one. First what is nearby is searched, and where that could be decided, all that the
        control can reach."""
        conditions = conditions_of(self.system, group)
        names = sorted({*conditions.narrowed_by, *conditions.arguments} - {*kernel.unknowns})
        # What stands in neither scalars nor signs has the same value in all cases.
        keys = [
            tuple(id(case.scalars[name]) if name in case.scalars else witness_of(name, case.signs) for name in names)
            for case in cases
        ]
        apart = dict(zip(keys, cases, strict=True)).values()
        inputs = [{name: self.ground.number(name, case.scalars, case.signs) for name in names} for case in apart]
        searched, inner = list[list[Division]](), None
        for far in dict.fromkeys((self.near, self.far)):
            reach, budget = self.ground.reach(self.system, far), max(self.left, self.effort.least)
            task = Task(inputs, reach, self.ground.sizes(self.system), budget, self.effort.is_guessing, inner)
            divisions, looked_at = yield group, task
            self.left -= looked_at
            self.boxes += looked_at // len(kernel.unknowns)
            searched.append(divisions)
            if not all(division.is_complete for division in divisions):
                obstacle = Obstacle.UNFINISHED if inner is None else Obstacle.FARTHER
                self.doubts.append(Doubt(kernel.unknowns, obstacle))
                self.within = self.near
                break
            inner = reach
        self.within = min(far, self.within or far)
        roots = [settle(kernel, each, at) for each, at in zip(zip(*searched, strict=True), inputs, strict=True)]
        found = dict(zip(dict.fromkeys(keys), roots, strict=True))
        return [found[key] for key in keys]

    def _is_possible(self, state: ExactSolution, kernel: Kernel, senses: Sequence[Sense]) -> bool:
        """Whether radii are positive and everything runs in its stated sense; what cannot be decided is a doubt."""
        for value in self._must_be_positive(state, kernel, senses):
            match ball.sign(value):
                case None:
                    # With all the digits there are, what may still be zero is taken for it, and said so.
                    self.doubts.append(Doubt(kernel.unknowns, Obstacle.UNDECIDED))
                    return False
                case 1:
                    pass
                case _:
                    return False
        return True

    def _must_be_positive(self, state: ExactSolution, kernel: Kernel, senses: Sequence[Sense]) -> Iterator[Number]:
        yield from (state.scalars[name] for name in kernel.unknowns if name in self.system.figure.radii)
        # The side of a fact that was not needed is chosen in the end, and its senses are compared there.
        known = state.scalars.keys() | state.signs.keys()
        complete = [sense for sense in senses if sense.reads | sense.sides <= known]
        if complete:
            at = self.ground.values(state.scalars, state.signs, self.system)
            for sense in complete:
                yield from sense.values(at)


@lru_cache(maxsize=8192)
def _roots_of(local: Local, numbers: ball.SameNumbers, close: Close) -> tuple[list[Root] | None, Obstacle | None]:
    """All solutions of a step at these values of its parameters, None if it has no closed form; and why it could not be
    solved. What is tried on a chain leaves most of its steps as they are."""
    closed, step = close_step(local), None
    found = closed.solve(numbers.numbers) if closed is not None else None
    if found is not None or (step := polynomials_of(local)) is None:
        return found, None
    # What the construction does not close, or is a special one at these values.
    values = dict(zip((closed or step).parameters, numbers.numbers, strict=True))
    sides = {name.removeprefix(SIDE): int(value) for name, value in values.items() if name.startswith(SIDE)}
    coefficients = [Coefficient(values[name], witness_of(name, sides)) for name in step.parameters]
    try:
        return solve_step(step, coefficients, close), None
    except ObstacleError as error:
        return (None, None) if error.obstacle is Obstacle.NO_CLOSED_FORM else ([], error.obstacle)


def _choices(state: ExactSolution, kernel: Kernel) -> Iterator[dict[str, int]]:
    """The sides of a state with those that a step leaves open, chosen in every way."""
    open_sides = [side for side in kernel.sides if side not in state.signs]
    for values in product((1, -1), repeat=len(open_sides)):
        yield {**state.signs, **dict(zip(open_sides, values, strict=True))}
