"""Contours that differ in their values alone, solved together; whatever is not plainly solved is left alone."""

from collections.abc import Callable, Hashable, Mapping, Sequence
from functools import lru_cache
from itertools import chain

import numpy
from msgspec import Struct, field
from numpy.typing import NDArray

from contoursolve.diagnosis import Answer, Policy, context_of, is_counted_start, without_point
from contoursolve.gcode import Word
from contoursolve.geometry import Length, Line, Profile, System, assemble
from contoursolve.numeric import Compiled, inverse_norms
from contoursolve.reading import ContourForm, Control, ParsedContour, Rule, WithoutPoint, is_refused_by_values
from contoursolve.solving import (
    ROUNDING,
    CheckOutputs,
    Construction,
    Proof,
    RowOutcome,
    Status,
    against_angles,
    certify,
    compile_checked,
    compile_checks,
    compile_system,
    dropped_corners,
    inputs_of,
    sizes_of,
    solution_at,
    trace,
    up_to_one_digit,
)
from contoursolve.tolerance import AGREEMENT, ERROR_BOUND_WARNING, LARGEST, LENGTH

Columns = Mapping[str, NDArray[numpy.float64]]

FEWEST = 3
"""Contours of one kind below which columns take longer than one by one."""

_FAR_BELOW = 0.25
"""Share of a limit up to which a value is within it, however the limit is rounded or measured."""

_SMALL = 30_000
"""A number that is no larger is below the largest value in every unit."""


class Kind(Struct, frozen=True, eq=False):
    """Contours with the same words and choices, by one of them about which there is nothing to say."""

    answer: Answer
    system: System
    machine: Construction
    outputs: CheckOutputs
    function: Compiled
    """The function of the machine, with the outputs of the checks."""
    wanted: tuple[str, ...]
    """The outputs of which a contour is made."""


class Batch(Struct):
    """Solves contours that a control's rules allow and that differ from one that was examined in their values alone.

    The answers are those of `examine`: the same outputs of the same function, checked in columns.
    """

    control: Control
    policy: Policy
    is_proven: bool
    kinds: dict[Hashable, Kind] = field(default_factory=dict)

    @property
    def rules(self) -> tuple[Rule, ...]:
        """The rules of the control."""
        return self.control.rules

    def solve(self, claims: Sequence[ParsedContour], examine: Sequence[Callable[[], Answer]]) -> list[Answer]:
        """The answers to contours whose start is known; `examine` gives that to each of them."""
        answers: dict[int, Answer] = {}
        groups: dict[Hashable, list[int]] = {}
        for number, claim in enumerate(claims):
            key = self._key(claim)
            if key is None:
                answers[number] = examine[number]()
            else:
                groups.setdefault(key, []).append(number)
        for key, numbers in groups.items():
            rest = list(numbers)
            while rest and (key not in self.kinds or len(rest) < FEWEST):
                first = rest.pop(0)
                answers[first] = examine[first]()
                if key not in self.kinds:
                    self._learn(key, answers[first])
            if rest:
                together = self._solve(self.kinds[key], [claims[number] for number in rest])
                answers |= {number: answer or examine[number]() for number, answer in zip(rest, together, strict=True)}
        return [answers[number] for number in range(len(claims))]

    def _learn(self, key: Hashable, answer: Answer) -> None:
        """Solve others as one that was examined, if there was nothing to say of it."""
        if answer.status is Status.SOLVED and not answer.diagnostics and answer.contour and not answer.alternatives:
            system = assemble(answer.profile)
            machine = compile_system(system)
            corners = machine.path.corners.values()
            wanted = [*system.unknowns, *(name for each in corners for name in (*each.begin, *each.end, each.turn))]
            wanted += [name for each in corners if each.center is not None for name in each.center]
            checked = compile_checks(system)
            kind = Kind(answer, system, machine, checked.outputs, compile_checked(system), tuple(wanted))
            self.kinds[key] = kind

    def _key(self, claim: ParsedContour) -> Hashable:
        """Key shared by contours of one kind; None where more than the words and their values counts."""
        if claim.unknown or claim.repeated or claim.doubts or not self._is_plain(claim):
            return None
        before, after = claim.before, claim.after
        for axis in before.plane.axes:
            position = before.axes[axis]
            if position.value is None or position.is_skippable or is_counted_start(position, claim.lexicon):
                return None
        sharp = []
        for size in _sizes(claim.form):
            given = claim.givens.get(size)
            if given is not None and given.value <= 0:
                if given.value < 0:
                    return None
                sharp.append(size)
        if self.policy is not Policy.OFF:
            values = {name: given.value for name, given in claim.givens.items()}
            if is_refused_by_values(self.rules, claim.form.roles, values):
                return None
        if claim.lexicon.numbers.without_point is WithoutPoint.LEAST_INCREMENTS and self._lacks_points(claim):
            return None
        return (
            claim.form,
            frozenset(claim.words),
            frozenset(claim.givens),
            claim.choices,
            claim.circumstances,
            after.unit is Length.INCH,
            after.plane.code,
            before.plane.code,
            *sharp,
        )

    def _is_plain(self, claim: ParsedContour) -> bool:
        """Whether its blocks hold nothing but words with numbers that a control travels."""
        for block in claim.blocks:
            if block.faults or block.directives or block.unmarked or block.is_skippable:
                return False
            for word in block.words:
                if word.number is None or (not -_SMALL <= word.number <= _SMALL and self._is_large(word, claim)):
                    return False
        return True

    def _lacks_points(self, claim: ParsedContour) -> bool:
        """Whether there is something to say of numbers without points."""
        for given in claim.givens.values():
            if given.word is not None and not given.word.has_point:
                return any(True for _ in without_point(context_of(claim, self.rules), claim, ()))
        return False

    @staticmethod
    def _is_large(word: Word, claim: ParsedContour) -> bool:
        """Whether a number is larger than any control travels."""
        if word.address not in claim.lexicon.addresses:
            return False
        value = claim.lexicon.value(word, claim.after.unit)
        return value is None or abs(value) > LARGEST

    def _solve(self, kind: Kind, claims: Sequence[ParsedContour]) -> list[Answer | None]:
        """The answers to contours of a kind, as far as nothing speaks against them."""
        profiles = [_profile_of(claim, kind.answer.profile) for claim in claims]
        found = _evaluate(kind, [inputs_of(profile, kind.system) for profile in profiles])
        return [
            None if row is None else self._answer(kind, claim, profile, *row)
            for claim, profile, row in zip(claims, profiles, found, strict=True)
        ]

    def _answer(
        self, kind: Kind, claim: ParsedContour, profile: Profile, out: Mapping[str, float], bound: float
    ) -> Answer | None:
        like, bound = kind.answer, up_to_one_digit(bound)
        certificate = certify(profile, kind.system, out, bound) if self.is_proven else None
        if certificate is not None and certificate.proof not in (Proof.EXACT, Proof.UNIQUE):
            return None
        corners = kind.machine.path.read(out.get).corners
        solution = solution_at(kind.system, profile.start, sizes_of(profile), out, corners)
        contour = trace(profile, solution)
        told = chain(against_angles(profile, contour), dropped_corners(profile, solution))
        if contour.crossing is not None or any(True for _ in told):
            return None
        return Answer(
            form=like.form,
            lines=tuple([block.line for block in claim.blocks]),
            claim=claim,
            status=like.status,
            plane=like.plane,
            unit=like.unit,
            start=profile.start,
            profile=profile,
            contour=contour,
            sides=like.sides,
            error_bound=bound,
            diagnostics=(),
            read_by=like.read_by,
            certificate=certificate,
        )


def _profile_of(claim: ParsedContour, like: Profile) -> Profile:
    """The profile of a claim that differs from another one in its values alone."""
    return Profile(
        form=like.form,
        blocks=claim.blocks,
        plane=like.plane,
        unit=like.unit,
        layout=like.layout,
        start=claim.before.start(),
        givens=claim.givens,
        intersections=like.intersections,
        choices=claim.choices,
    )


@lru_cache(maxsize=4096)
def _sizes(form: ContourForm) -> tuple[str, ...]:
    """The words that are sizes of corners."""
    return tuple(form.outline.shapes)


def _evaluate(kind: Kind, inputs: Sequence[Mapping[str, float]]) -> list[tuple[dict[str, float], float] | None]:
    """The outputs at many inputs and a bound of their errors, mm; None where something speaks against them."""
    if not inputs:
        return []
    function = kind.function
    rows = [[each[name] for name in function.inputs] for each in inputs]
    found = function.rows(rows)
    out = dict(zip(function.outputs, numpy.ascontiguousarray(found.T), strict=True))
    plain, bounds = _examine(kind, out, len(rows))
    wanted = numpy.stack([out[name] for name in kind.wanted], axis=1).tolist()
    return [
        (dict(zip(kind.wanted, row, strict=True)), bound) if is_plain else None
        for row, is_plain, bound in zip(wanted, plain.tolist(), bounds.tolist(), strict=True)
    ]


def _examine(kind: Kind, out: Columns, rows: int) -> tuple[NDArray[numpy.bool_], NDArray[numpy.float64]]:
    """Mask of the rows that are solved without any finding, and bounds of their errors, mm; both of shape (rows,)."""
    figure, machine = kind.system.figure, kind.machine
    verdict = RowOutcome(kind.outputs, out, rows)
    plain = (verdict.status == Status.SOLVED.code) & (verdict.reason == 0) & ~verdict.again
    for element in figure.path:
        if isinstance(element, Line):
            plain &= numpy.abs(out[machine.path.lengths[element.name]]) > LENGTH
    for step, measures in zip(machine.steps, machine.measures, strict=True):
        if step.has_two_places:
            plain &= ~measures.is_touching(out)
    for name in machine.compared:
        plain &= numpy.abs(out[name]) <= _FAR_BELOW * AGREEMENT
    bounds = numpy.zeros(rows)
    chosen = numpy.flatnonzero(plain)
    unknowns = kind.system.unknowns
    if chosen.size and unknowns:
        entries = {(row, column): out[name][chosen] for row, column, name in kind.machine.slopes}
        largest = numpy.max([numpy.ones(chosen.size), *(numpy.abs(out[name][chosen]) for name in unknowns)], axis=0)
        worst = numpy.max([numpy.abs(out[name][chosen]) for name in machine.residuals], axis=0)
        bounds[chosen] = inverse_norms(entries, len(unknowns), chosen.size) * (worst + ROUNDING * largest)
        plain &= bounds <= _FAR_BELOW * ERROR_BOUND_WARNING
    return plain, bounds
