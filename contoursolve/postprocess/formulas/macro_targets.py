"""Spelling of statements on each control: assignments, conditions, alarms, and the words of a path."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import count

from msgspec import Struct

from contoursolve.execution import Assign, When, write_term, written
from contoursolve.geometry import Plane
from contoursolve.numeric import AT_MOST, LESS, Apply, Constant, Term, Variable
from contoursolve.postprocess.formulas.contour_statements import SHORTEST, Choose, Leg, Said, Statement, Stop

ALARM = 101
"""The number of the alarm by which a program stops on Fanuc and Haas, of those that programs may use."""

Fork = Callable[[str, Sequence[str], Sequence[str], int], Iterable[str]]
"""The lines for a condition, for what is done where it holds and where not, with a number that nothing else has."""


class MacroTarget(Struct, frozen=True, eq=False):
    """One control: its notation, the variables that it uses unless others are named, and how it writes statements."""

    notation: str
    scratch: str
    fork: Fork
    stop: str
    """Pattern of the line that stops the machine with a text."""
    prefix: str = "#"
    """First characters of its variables' names."""
    equals: str = ""
    """Text between an address and an expression."""
    assign: str = "{}={}"
    when: str = ""
    """Pattern of a conditional assignment, if that is one line."""
    is_klartext: bool = False
    has_brackets: bool = False
    """Whether what a variable is set to has brackets if it is computed."""


def _by_words(condition: str, then: Sequence[str], otherwise: Sequence[str], number: int) -> Iterator[str]:
    """LinuxCNC."""
    yield f"o{number} if [{condition}]"
    yield from then
    if otherwise:
        yield f"o{number} else"
        yield from otherwise
    yield f"o{number} endif"


def _by_jumps(condition: str, then: Sequence[str], otherwise: Sequence[str], number: int) -> Iterator[str]:
    """Fanuc and Haas: a block number where it goes on, and one more."""
    yield f"IF [{condition}] GOTO {number}"
    yield from otherwise
    yield f"GOTO {number + 1}"
    yield f"N{number}"
    yield from then
    yield f"N{number + 1}"


def _by_lines(condition: str, then: Sequence[str], otherwise: Sequence[str], _: int) -> Iterator[str]:
    """SINUMERIK."""
    yield f"IF {condition}"
    yield from then
    if otherwise:
        yield "ELSE"
        yield from otherwise
    yield "ENDIF"


def _by_labels(condition: str, then: Sequence[str], otherwise: Sequence[str], number: int) -> Iterator[str]:
    """Klartext, whose condition has its own jump."""
    yield f"{condition} GOTO LBL {number}"
    yield from otherwise
    yield f"FN 9: IF +0 EQU +0 GOTO LBL {number + 1}"
    yield f"LBL {number}"
    yield from then
    yield f"LBL {number + 1}"


_FANUC = MacroTarget("fanuc", "#140-#199", _by_jumps, f"IF [{{}}] THEN #3000={ALARM} ({{}})", when="IF [{}] THEN {}={}")
TARGETS = {
    "fanuc": _FANUC,
    "haas": MacroTarget("haas", "#140-#199", _by_jumps, _FANUC.stop, when=_FANUC.when),
    "linuxcnc": MacroTarget("linuxcnc", "#140-#199", _by_words, "(abort, {})", has_brackets=True),
    "sinumerik": MacroTarget("sinumerik", "R50-R99", _by_lines, 'SETAL(65000,"{}")', prefix="R", equals="="),
    "klartext": MacroTarget(
        "klartext", "Q40-Q99", _by_labels, "FN 14: ERROR = 1000", prefix="Q", assign="{} = {}", is_klartext=True
    ),
}
"""Targets by the names of their languages."""

PREFIXES = {"sinumerik": "R", "klartext": "Q"}
"""First characters of variables' names in the language of a program, where they are no #."""

_JUMPS = {"greater": ("FN 11", "GT"), LESS: ("FN 12", "LT")}
"""The conditions of Klartext."""


class TargetWriter:
    """Writes statements for one control; numbers of branches go up from `first`."""

    def __init__(self, target: MacroTarget, plane: Plane, first: int) -> None:
        self.target, self.plane = target, plane
        self.numbers = count(first, 2)

    def lines(self, statements: Iterable[Statement]) -> Iterator[str]:
        """The lines of some statements."""
        for each in statements:
            match each:
                case Assign():
                    yield self._assign(each)
                case When(condition, (Assign() as then, *_)):
                    if self.target.when:
                        yield self.target.when.format(
                            self._condition(condition), self._text(then.variable), self._text(then.value)
                        )
                    else:
                        yield from self._fork(condition, [self._assign(then)])
                case Stop():
                    if self.target.when:
                        yield self.target.stop.format(self._condition(each.condition), each.message)
                    else:
                        yield from self._fork(each.condition, [self.target.stop.format(each.message)])
                case Choose():
                    yield from self._fork(each.condition, list(self.lines(each.then)), list(self.lines(each.otherwise)))
                case Leg():
                    yield from self._leg(each)
                case Said():
                    yield each.text

    def _text(self, term: Term) -> str:
        return write_term(term, self.target.notation)

    def _assign(self, statement: Assign) -> str:
        value = self._text(statement.value)
        if self.target.has_brackets and isinstance(statement.value, Apply):
            value = f"[{value}]"
        return self.target.assign.format(self._text(statement.variable), value)

    def _condition(self, term: Term) -> str:
        if not self.target.is_klartext:
            return self._text(term)
        if not isinstance(term, Apply):
            raise TypeError(term)
        first, second = (f"+{self._text(each)}".replace("+-", "-") for each in term.arguments)
        function, name = _JUMPS[term.function]
        return f"{function}: IF {first} {name} {second}"

    def _fork(self, condition: Term, then: Sequence[str], otherwise: Sequence[str] = ()) -> Iterable[str]:
        if isinstance(condition, Apply) and condition.function == AT_MOST and self.target.is_klartext:
            # It compares with GT and LT alone.
            condition, then, otherwise = Apply("greater", condition.arguments), otherwise, then
        return self.target.fork(self._condition(condition), then, otherwise, next(self.numbers))

    def _leg(self, leg: Leg) -> Iterable[str]:
        """The line of a leg; an arc may turn either way, or be a line."""
        straight = [self._motion("G01", "L", leg)]
        if leg.turn is None or leg.chord is None:
            return straight
        left, right = ([*self._arc(code, way, leg)] for code, way in (("G03", "DR+"), ("G02", "DR-")))
        is_left = Apply("greater", (leg.turn, Constant(0.0)))
        turned = (
            (left if leg.turn.value > 0 else right)
            if isinstance(leg.turn, Constant)
            else list(self._fork(is_left, left, right))
        )
        if isinstance(leg.chord, Constant):
            return turned if leg.chord.value >= SHORTEST else straight
        return self._fork(Apply(LESS, (leg.chord, Constant(SHORTEST))), straight, turned)

    def _arc(self, code: str, way: str, leg: Leg) -> Iterator[str]:
        centers = list(zip(self.plane.centers, leg.center or leg.end, strict=True))
        if not self.target.is_klartext:
            words = (self._word(*each) for each in sorted(centers, key=lambda each: each[0]))
            yield " ".join([self._motion(code, "", leg), *words])
            return
        names = [f"I{axis}" for axis in self.plane.axes]
        yield " ".join(["CC", *(self._word(name, each) for name, (_, each) in zip(names, centers, strict=True))])
        yield f"{self._motion('', 'C', leg)} {way}"

    def _motion(self, code: str, name: str, leg: Leg) -> str:
        words = sorted(zip(self.plane.axes, leg.end, strict=True), key=lambda each: each[0])
        return " ".join([name if self.target.is_klartext else code, *(self._word(*each) for each in words)])

    def _word(self, address: str, value: Term) -> str:
        """A word with a number or a variable."""
        text = written(value.value) if isinstance(value, Constant) else self._text(value)
        if self.target.is_klartext:
            text = text.removesuffix(".")
            return f"{address}{text if text.startswith('-') else '+' + text}"
        return f"{address}{self.target.equals}{text}" if isinstance(value, Variable) else address + text


def lowered(statements: Iterable[Statement], target: MacroTarget, numbers: Iterator[int]) -> Iterator[Statement]:
    """Statements whose conditions compare variables and numbers alone, where the control compares nothing else."""
    for each in statements:
        if isinstance(each, When | Stop | Choose) and target.is_klartext and isinstance(each.condition, Apply):
            simple: list[Term] = []
            for part in each.condition.arguments:
                if isinstance(part, Apply):
                    name = Variable(f"condition {next(numbers)}")
                    yield Assign(name, part)
                    part = name  # noqa: PLW2901
                simple.append(part)
            condition = Apply(each.condition.function, tuple(simple))
            if isinstance(each, Choose):
                then, otherwise = (tuple(lowered(some, target, numbers)) for some in (each.then, each.otherwise))
                yield Choose(condition, then, otherwise)
            else:
                yield When(condition, each.then) if isinstance(each, When) else Stop(condition, each.message)
        else:
            yield each
