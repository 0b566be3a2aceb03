"""All solutions of a determined system, step by step, with proof of their number or an honest doubt."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import product

from contoursolve.analysis import Group, judge, order
from contoursolve.analysis.generic import witness_of
from contoursolve.backends import ball
from contoursolve.backends.ball import Number
from contoursolve.backends.residue import draw
from contoursolve.constraints import System
from contoursolve.model import Line, Profile, scalar
from contoursolve.solving.driven import EVALUATIONS, LEAST, find_drive, follow
from contoursolve.solving.elimination import Close, Limits, Obstacle, ObstacleError, Root, solve_step
from contoursolve.solving.ground import Ground, ground_of
from contoursolve.solving.kernel import ORIGIN, Kernel, make_kernel
from contoursolve.solving.polynomial import Coefficient
from contoursolve.solving.search import search_everywhere


@dataclass(frozen=True, slots=True)
class Found:
    """One solution of the equations: every unknown, exact or in a ball, and the sides at which elements touch.

    `doubles` are the unknowns of steps whose two solutions have become one.
    """

    scalars: Mapping[str, Number]
    signs: Mapping[str, int]
    doubles: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Doubt:
    """A part of the search that could not be decided: the unknowns of the step, and why."""

    unknowns: tuple[str, ...]
    obstacle: Obstacle


@dataclass(frozen=True, slots=True)
class Enumeration:
    """What a search found. The list is complete, with proof, if there is no doubt."""

    found: tuple[Found, ...]
    doubts: tuple[Doubt, ...]
    is_searched: bool = False
    """Whether some step has no closed form, so that solutions were searched for within reach only."""

    @property
    def is_complete(self) -> bool:
        """Whether these are all the solutions there are."""
        return not self.doubts


def enumerate_solutions(profile: Profile, system: System) -> Enumeration:
    """All solutions of a determined system at the values of a profile, whatever the choices of the control.

    Where a ball is too wide to decide, everything is done again with four times the digits.
    """
    verdict = judge(system)
    basis = tuple(system.facts[index] for index in verdict.basis)
    groups = order(system, basis)
    enumeration = Enumeration((), ())
    for bits, close in ((ball.WORKING, Close.REFUSE), (ball.HIGHEST, Close.DOUBLE)):
        with ball.precision(bits):
            enumeration = _Search(system, groups, ground_of(profile), close).run()
        # More digits do not finish a search.
        if not any(doubt.obstacle in (Obstacle.TOUCHING, Obstacle.UNDECIDED) for doubt in enumeration.doubts):
            break
    return enumeration


MOST_SOLUTIONS = 512
"""Solutions that are followed; each point that may lie in two places doubles their number."""


class _Search:
    def __init__(self, system: System, groups: tuple[Group, ...], ground: Ground, close: Close) -> None:
        self.system = system
        self.groups = groups
        self.ground = ground
        self.close = close
        self.doubts: list[Doubt] = []
        self.is_searched = False
        self.budget = EVALUATIONS
        self.reach = ground.reach(system)
        lines = [line for line in (*system.figure.path, *system.figure.lines) if isinstance(line, Line)]
        carriers = [line for line in lines if line.name in system.figure.carriers]
        self.runs = [line for line in carriers if line.tail and line.head]
        self.free = [line.name for line in carriers if not line.tail]

    def run(self) -> Enumeration:
        states = [Found({}, {})]
        for group in self.groups:
            states = [after for state in states for after in self._advance(state, group)]
            if len(states) > MOST_SOLUTIONS:
                self.doubts.append(Doubt(group.unknowns, Obstacle.UNFINISHED))
                states = states[:MOST_SOLUTIONS]
        states = [self._with_sides(state) for state in states]
        return Enumeration(tuple(states), tuple(dict.fromkeys(self.doubts)), self.is_searched)

    def _with_sides(self, state: Found) -> Found:
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
        return Found(state.scalars, signs, state.doubles)

    def _advance(self, state: Found, group: Group) -> Iterator[Found]:
        kernel = make_kernel(self.system, group)
        open_sides = [side for side in kernel.sides if side not in state.signs]
        for values in product((1, -1), repeat=len(open_sides)):
            signs = {**state.signs, **dict(zip(open_sides, values, strict=True))}
            try:
                roots = self._solve(group, kernel, state.scalars, signs)
            except ObstacleError as error:
                self.doubts.append(Doubt(kernel.unknowns, error.obstacle))
                continue
            for root in roots:
                scalars = {**state.scalars, **{kernel.unknowns[index]: each for index, each in root.values.items()}}
                doubles = state.doubles + (kernel.unknowns if root.is_double else ())
                after = Found(scalars, signs, doubles)
                if self._is_possible(after, kernel):
                    yield after

    def _solve(
        self, group: Group, kernel: Kernel, scalars: Mapping[str, Number], signs: Mapping[str, int]
    ) -> list[Root]:
        if kernel.coefficients is not None:
            try:
                roots = solve_step(kernel, self._coefficients(kernel, scalars, signs, {}), Limits(close=self.close))
            except ObstacleError as error:
                if error.obstacle is not Obstacle.NO_CLOSED_FORM:
                    raise
            else:
                doubles = [each for root in roots if root.is_double for each in root.values.values()]
                if any(not ball.is_exact(each) for each in doubles):
                    self.doubts.append(Doubt(kernel.unknowns, Obstacle.TOUCHING))
                return roots
        return self._follow(group, kernel, scalars, signs)

    def _follow(
        self, group: Group, kernel: Kernel, scalars: Mapping[str, Number], signs: Mapping[str, int]
    ) -> list[Root]:
        drive = find_drive(self.system, group)
        self.is_searched = True
        reach = {name: self.reach[name] for name in kernel.unknowns}

        def inputs(step: Kernel, found: Mapping[str, Number]) -> dict[str, Number]:
            names = step.arguments[len(step.unknowns) :]
            return {name: self.ground.number(name, {**scalars, **found}, signs) for name in names}

        if drive is None:
            self.doubts.append(Doubt(kernel.unknowns, Obstacle.NO_CLOSED_FORM))
            return search_everywhere(kernel, inputs(kernel, {}), reach)
        roots, is_complete, used = follow(
            drive,
            kernel,
            lambda step, found, origin: self._coefficients(step, {**scalars, **found}, signs, origin),
            inputs,
            reach,
            max(self.budget, LEAST),
        )
        self.budget -= used
        if not is_complete:
            self.doubts.append(Doubt(kernel.unknowns, Obstacle.UNFINISHED))
        return roots

    def _coefficients(
        self, kernel: Kernel, scalars: Mapping[str, Number], signs: Mapping[str, int], origin: Mapping[str, Number]
    ) -> list[Coefficient]:
        """The parameters of a step; the origin is zero unless told otherwise."""
        zero = Coefficient(ball.exact(0), 0)
        return [
            (Coefficient(origin[name.removeprefix(ORIGIN)], draw(name)) if origin else zero)
            if name.startswith(ORIGIN)
            else Coefficient(self.ground.number(name, scalars, signs), witness_of(name, signs))
            for name in kernel.parameters
        ]

    def _is_possible(self, state: Found, kernel: Kernel) -> bool:
        """Whether radii are positive and everything runs in its stated sense; what cannot be decided is a doubt."""
        for value in self._must_be_positive(state, kernel):
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

    def _must_be_positive(self, state: Found, kernel: Kernel) -> Iterator[Number]:
        new = set(kernel.unknowns)
        yield from (state.scalars[name] for name in self.system.figure.radii if name in new)
        at = self.ground.values(state.scalars, state.signs, self.system)
        for fact in self.system.facts:
            names = self.system.unknowns_among(fact.sense_reads())
            if new & set(names) and all(name in state.scalars for name in names):
                yield from fact.senses(at)
        for line in self.runs:
            yield from self._run(line, state, new)
        for name in self.free:
            # A line beside the path has no sense: it is taken to run to the right, or upwards.
            if f"{name}.cos" in new:
                cosine = state.scalars[f"{name}.cos"]
                yield cosine if ball.sign(cosine) != 0 else state.scalars[f"{name}.sin"]

    def _run(self, line: Line, state: Found, new: set[str]) -> Iterator[Number]:
        ends = [scalar(point, axis) for point in (line.tail, line.head) for axis in (0, 1)]
        names = {*ends, f"{line.name}.cos"} - self.system.known
        if new & names and names <= state.scalars.keys():
            at = self.ground.values(state.scalars, state.signs, self.system)
            cosine, sine = at.bearing(line.name)
            yield (at.coordinate(line.head, 0) - at.coordinate(line.tail, 0)) * cosine + (
                at.coordinate(line.head, 1) - at.coordinate(line.tail, 1)
            ) * sine
