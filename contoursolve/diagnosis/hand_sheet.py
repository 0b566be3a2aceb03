"""The sheet of a calculation by hand: its lines, with the triangles of which several steps are made."""

import re
from collections.abc import Callable, Iterable, Mapping
from math import degrees, hypot
from typing import Any

from msgspec import Struct

from contoursolve.diagnosis.names_in_program import called_in_program
from contoursolve.diagnostics import Shown
from contoursolve.geometry import (
    FIRST,
    SECOND,
    Profile,
    System,
    Unit,
    scalar,
)
from contoursolve.solving import CornerSolution, symbolic_values

Pair = tuple[Any, Any]


Triangle = tuple[tuple[str, tuple[float, float]], ...]
"""The corners of a triangle by their names, mm."""


class CalculationLine(Struct, frozen=True):
    """One line: the symbol that it finds, the formula (of sympy), the same with numbers, and the value: mm, X of a
    lathe as radius, or degrees."""

    symbol: Any
    formula: Any
    numbers: str
    value: float
    unit: str
    meaning: str = ""
    latex: str = ""
    """The formula with numbers, for LaTeX."""


class Calculation(Struct, frozen=True):
    """The lines that find one point, radius or corner: what is found, why so, and the corners of the triangle in which
    it is calculated (mm); none where there is no triangle. `is_searched` tells that nobody can calculate it by hand."""

    title: str
    lines: tuple[CalculationLine, ...]
    triangle: Triangle = ()
    is_searched: bool = False


class Derivation(Shown, Struct, frozen=True):
    """The calculation of a contour by hand: `steps` find its points one after the other, then its corners."""

    steps: tuple[Calculation, ...]

    @property
    def latex(self) -> str:
        """The calculation for LaTeX with amsmath: a numbered list of its steps, with their lines in `align*`."""
        from contoursolve.numeric import symbolic  # noqa: PLC0415 - sympy is slow to import

        lines = ["\\begin{enumerate}"]
        for step in self.steps:
            rows = " \\\\\n".join(_latex_of(line, symbolic.latex, is_taken=step.is_searched) for line in step.lines)
            lines += [f"\\item {_plain(step.title)}", "\\begin{align*}", rows, "\\end{align*}"]
        return "\n".join([*lines, "\\end{enumerate}"])


def _latex_of(line: CalculationLine, latex: Callable[[Any], str], *, is_taken: bool) -> str:
    """A line with its formula, and below it the same with numbers."""
    unit = {"deg": "^{\\circ}", "mm": "\\,\\mathrm{mm}"}.get(line.unit, "")
    value = f"{line.value:z.4f}{unit}"
    if is_taken:
        return f"{latex(line.symbol)} &= {value}"
    meaning = f" && \\text{{{_plain(line.meaning)}}}" if line.meaning else ""
    numbers = "" if line.formula.is_Symbol else f"{line.latex} = "
    return f"{latex(line.symbol)} &= {latex(line.formula)}{meaning} \\\\\n&= {numbers}{value}"


def _plain(text: str) -> str:
    """A text in which no character is a command of LaTeX."""
    return re.sub(r"[&%$#_{}]", r"\\\g<0>", re.sub(r"[\\~^]", "", text))


class HandSheet:
    """The lines of the calculation of one contour, in the symbols of its system, with the values so far. `places` are
    the symbols of the places of each corner, by its name and theirs; `scalars` and `corners` are the solution."""

    def __init__(
        self,
        profile: Profile,
        system: System,
        symbols: Any,
        values: Mapping[Any, Any],
        scalars: Mapping[str, float],
        corners: Mapping[str, CornerSolution],
        places: Mapping[str, Mapping[str, Pair]],
    ) -> None:
        from contoursolve.numeric import hand, symbolic  # noqa: PLC0415 - sympy is slow to import

        self._hand = hand
        self._profile, self._system, self._symbols = profile, system, symbols
        self._scalars, self._corners, self._places = scalars, corners, places
        self._called = called_in_program(profile)
        self._sheet = hand.Calculator(values)
        angles = (given.name for given in profile.givens.values() if given.unit is Unit.DEGREE)
        self._sheet.angles |= set(map(symbols.angle, angles))
        self._meant_values = {symbols.scalar(name): value for name, value in scalars.items()}
        for name, corner in corners.items():
            for place, pair in places.get(name, {}).items():
                self._meant_values |= zip(pair, getattr(corner, place) or (), strict=False)
        self._at = symbolic_values(symbols, symbolic.FUNCTIONS, system.headed)
        self._number = 0
        self._lines: list[CalculationLine] = []
        self._triangle: Triangle = ()

    def _put(self, name: str | Any, formula: Any, unit: str = "mm", meaning: str = "") -> Any:
        """A line of the calculation; its symbol."""
        is_angle = unit == "deg"
        own = f"{name}_{self._number}" if isinstance(name, str) else name
        numbers, latex = self._sheet.numbers(formula), self._sheet.latex(formula)
        symbol, value = self._sheet.put(own, formula, is_angle=is_angle)
        shown = degrees(value) if is_angle else value
        self._lines.append(CalculationLine(symbol, formula, numbers, shown, unit, self._called(meaning), latex))
        return symbol

    def _put_pair(self, symbols: Pair, formulas: Pair) -> None:
        """Both coordinates of a place."""
        for symbol, formula in zip(symbols, formulas, strict=True):
            self._put(symbol, formula)

    def _checked(self, calculate: Callable[[], Calculation | None]) -> Calculation | None:
        """A calculation that gives what the solution has; None where there is none, as where a control allows a radius
        to be less than it must be."""
        try:
            found = calculate()
        except ArithmeticError:
            return None
        known = self._meant_values
        lines = [line for line in found.lines if line.symbol in known] if found else []
        return found if all(abs(line.value - known[line.symbol]) <= SAME for line in lines) else None

    def _taken(self, title: str, values: Iterable[tuple[Any, float, str]]) -> Calculation:
        """Values that nobody calculates by hand, each with its symbol and its unit, as the solution has them."""
        self._lines, self._triangle = [], ()
        for symbol, value, unit in values:
            self._sheet.put(symbol, value)
            self._lines.append(CalculationLine(symbol, symbol, "", value, unit))
        return self._done(f"{title}: no calculation by hand; as the solution has it", is_searched=True)

    def _done(self, title: str, *, is_searched: bool = False) -> Calculation:
        found = Calculation(self._called(title), tuple(self._lines), self._triangle, is_searched)
        self._lines, self._triangle = [], ()
        return found

    def _point(self, name: str) -> Pair:
        return self._at.coordinate(name, FIRST), self._at.coordinate(name, SECOND)

    def _place(self, pair: Pair) -> tuple[float, float]:
        return self._sheet.value(pair[0]), self._sheet.value(pair[1])

    def _right(self, one: str, first: Pair, other: str, second: Pair) -> Triangle:
        """The right triangle between two points, with its legs along the axes."""
        (a, b), (x, y) = self._place(first), self._place(second)
        return (one, (a, b)), ("", (x, b)), (other, (x, y))

    def _meant(self, point: str) -> tuple[float, float]:
        return self._scalars[scalar(point, FIRST)], self._scalars[scalar(point, SECOND)]

    def _crossing(self, tail: Pair, angle: Any, center: Pair, radius: Any, meant: tuple[float, float]) -> Any:
        """The way along a line to a circle, on that side on which a point is meant."""
        sine, cosine = self._hand.sine(angle), self._hand.cosine(angle)
        east, north = center[0] - tail[0], center[1] - tail[1]
        d = self._put("d", north * cosine - east * sine, meaning="from the line to the centre")
        f = self._put("f", east * cosine + north * sine, meaning="along the line to the foot of that")
        h = self._put("h", self._hand.root(radius**2 - d**2), meaning="half the chord")
        way = f + h
        for sign in (1, -1):
            s = self._sheet.value(f + sign * h)
            place = (
                self._sheet.value(tail[0]) + s * self._sheet.value(cosine),
                self._sheet.value(tail[1]) + s * self._sheet.value(sine),
            )
            if hypot(place[0] - meant[0], place[1] - meant[1]) <= SAME:
                way = f + sign * h
        foot = tail[0] + f * cosine, tail[1] + f * sine
        self._triangle = ("centre", self._place(center)), ("foot", self._place(foot)), ("", meant)
        return way

    def _meeting(self, first: Pair, second: Pair, one: Any, other: Any, meant: tuple[float, float]) -> tuple[Any, Any]:
        """The formulas of a point at distances from two others, on that side on which it is meant."""
        root = self._hand.root
        c = self._put("c", root((second[0] - first[0]) ** 2 + (second[1] - first[1]) ** 2), meaning="between them")
        w = self._put(
            "w", self._hand.heading(second[1] - first[1], second[0] - first[0]), "deg", "from one to the other"
        )
        a = self._put("a", (c**2 + one**2 - other**2) / (2 * c), meaning="along that")
        h = self._put("h", root(one**2 - a**2), meaning="across it")
        sine, cosine = self._hand.sine(w), self._hand.cosine(w)
        self._triangle = ("1", self._place(first)), ("", meant), ("2", self._place(second))
        found = first[0] + a * cosine - h * sine, first[1] + a * sine + h * cosine
        mirrored = first[0] + a * cosine + h * sine, first[1] + a * sine - h * cosine
        here = self._place(found)
        return found if hypot(here[0] - meant[0], here[1] - meant[1]) <= SAME else mirrored


SAME = 1e-6
"""mm by which two places of a step may differ and still be the same."""
