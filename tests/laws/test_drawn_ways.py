"""Programs of which nobody knows which way they take agree with each way that they can take: each is written out as a
flat program here, by nothing of the package."""

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random

import pytest

from contoursolve import solve
from contoursolve.diagnosis.examine import Answer

# A program is a tree -------------------------------------------------------------------------------------------------


@dataclass(eq=False)
class Lines:
    """Blocks in a row."""

    texts: list[str]


@dataclass(eq=False)
class Choice:
    """One of two parts runs, by a condition."""

    number: int
    parts: tuple[list["Node"], list["Node"]]
    style: int


@dataclass(eq=False)
class Again:
    """A part runs several times, by a condition."""

    number: int
    part: list["Node"]
    style: int


@dataclass(eq=False)
class Leave:
    """The program ends here, by a condition."""

    number: int


Node = Lines | Choice | Again | Leave


@dataclass(frozen=True)
class Spelling:
    """How a control writes blocks, conditions on a variable, jumps, branches and loops."""

    head: str
    block: str
    corner: str
    rapid: str
    condition: str
    jump: str
    jump_if: str
    label: str
    ends: str
    parts: tuple[str, str, str] | None = None
    loops: tuple[tuple[str, str, bool], ...] = ()
    """How a loop begins and ends, and whether it may run no time at all."""
    axes: str = "XY"


_FANUC = Spelling(
    "G90 G00 X0. Y0. Z5.",
    "G01 {}",
    " ,R.5",
    "G00 {}",
    "#{} EQ {}",
    "GOTO {}",
    "IF[{}]GOTO {}",
    "N{}",
    "M30",
    ("IF [{}] THEN", "ELSE", "ENDIF"),
    (("WHILE [{}] DO{}", "END{}", True),),
)
_SIEMENS = Spelling(
    "G17 G90 G0 X0 Y0",
    "G1 {}",
    " RND=0.5",
    "G0 {}",
    "R{}=={}",
    "GOTO L{}",
    "IF {} GOTO L{}",
    "L{}:",
    "M30",
    ("IF {}", "ELSE", "ENDIF"),
    (("WHILE {}", "ENDWHILE", True), ("REPEAT", "UNTIL NOT({})", False)),
)
SPELLINGS = {
    "fanuc-lathe": _FANUC.__class__(**(vars(_FANUC) | {"head": "G00 X0. Z0.", "axes": "XZ"})),
    "fanuc-mill": _FANUC,
    "haas-mill": _FANUC,
    "nct-99m": _FANUC,
    "mitsubishi": _FANUC.__class__(**(vars(_FANUC) | {"head": "G17 G90 G00 X0. Y0."})),
    "siemens-840d": _SIEMENS,
    "siemens-808d": _SIEMENS,
    "isg": Spelling(
        "G17 G90 G0 X0 Y0",
        "G1 {}",
        " #RND=0.5",
        "G0 {}",
        "P{}=={}",
        "$GOTO N{}",
        "$IF {}\n$GOTO N{}\n$ENDIF",
        "N{}",
        "M30",
        ("$IF {}", "$ELSE", "$ENDIF"),
        (("$WHILE {}", "$ENDWHILE", True),),
    ),
    "heidenhain": Spelling(
        "L X+0 Y+0 R0 F100",
        "L {}",
        "",
        "L {} FMAX",
        "+Q{} EQU +{}",
        "FN 9: IF +0 EQU +0 GOTO LBL {}",
        "FN 9: IF {} GOTO LBL {}",
        "LBL {}",
        "M30",
    ),
}


class Program:
    """A drawn program: its text, and the flat programs of all ways through it with the lines from which they are."""

    def __init__(self, control: str, seed: int) -> None:
        self.spelling, self.draw, self.count = SPELLINGS[control], Random(f"ways {control} {seed}"), 0
        self.control, self.labels, self.written = control, 0, list[str]()
        self.tree = self.nodes(0)
        self.places = dict[int, int]()
        self.begin, self.end = "", ""
        if control == "heidenhain":
            self.begin, self.end = "BEGIN PGM A MM", "END PGM A MM"
        self.type(self.begin)
        self.type(self.spelling.head)
        self.write(self.tree)
        self.type(self.spelling.label.format(99))
        self.type(self.spelling.ends)
        self.type(self.end)
        self.text = "\n".join(self.written)

    # Drawing

    def nodes(self, depth: int) -> list[Node]:
        return [self.node(depth) for _ in range(self.draw.choice((1, 2, 2, 3)))]

    def node(self, depth: int) -> Node:
        kind = self.draw.random()
        if depth > 1 or kind < 0.45 or self.count > 2:
            return Lines([self.line() for _ in range(self.draw.choice((1, 2, 3)))])
        self.count += 1
        number = 500 + self.count
        if kind < 0.8:
            other = self.nodes(depth + 1) if self.draw.random() < 0.6 else []
            return Choice(number, (self.nodes(depth + 1), other), self.draw.randrange(2))
        if kind < 0.9:
            return Leave(number)
        return Again(number, self.nodes(depth + 1), self.draw.randrange(3))

    def line(self) -> str:
        own, draw = self.spelling, self.draw
        first, second = (draw.choice((-1, 1)) * draw.randrange(1, 90) for _ in range(2))
        sign = "+" if self.control == "heidenhain" else ""
        words = [
            f"{axis}{value:{sign}}" + "." * (own.head.endswith("."))
            for axis, value in zip(own.axes, (first, second), strict=True)
        ]
        kind = draw.random()
        if kind < 0.15:
            return own.rapid.format(" ".join(words))
        if kind < 0.25:
            return own.block.format(draw.choice(words))
        if self.control == "heidenhain":
            return f"FL {words[0]} AN{draw.randrange(20, 70):+}" if kind < 0.6 else own.block.format(" ".join(words))
        corner = own.corner if kind < 0.7 else ""
        return own.block.format(draw.choice((" ".join(words), words[0] if kind > 0.8 else " ".join(words)))) + corner

    # Writing

    def type(self, *lines: str) -> None:
        self.written += [line for text in lines if text for line in text.split("\n")]

    def label(self) -> int:
        self.labels += 1
        return 100 + self.labels

    def write(self, nodes: Sequence[Node]) -> None:
        own = self.spelling
        for node in nodes:
            match node:
                case Lines():
                    for place, text in enumerate(node.texts):
                        self.places[id(node), place] = len(self.written) + 1
                        self.type(text)
                case Leave():
                    self.type(own.jump_if.format(own.condition.format(node.number, 1), 99))
                case Choice() if node.style and own.parts:
                    begin, other, end = own.parts
                    self.type(begin.format(own.condition.format(node.number, 0)))
                    self.write(node.parts[0])
                    if node.parts[1]:
                        self.type(other)
                        self.write(node.parts[1])
                    self.type(end)
                case Choice():
                    first, second = self.label(), self.label()
                    self.type(own.jump_if.format(own.condition.format(node.number, 1), first))
                    self.write(node.parts[0])
                    if node.parts[1]:
                        self.type(own.jump.format(second))
                    self.type(own.label.format(first))
                    self.write(node.parts[1])
                    self.type(own.label.format(second))
                case Again() if node.style < len(own.loops):
                    begin, end, _ = own.loops[node.style]
                    condition, name = own.condition.format(node.number, 1), node.number - 500
                    self.type(begin.format(condition, name))
                    self.write(node.part)
                    self.type(end.format(name if "END" in end else condition))
                case Again():
                    first = self.label()
                    self.type(own.label.format(first))
                    self.write(node.part)
                    self.type(own.jump_if.format(own.condition.format(node.number, 1), first))

    # Ways

    def ways(self) -> Iterator[list[tuple[str, int]]]:
        """The blocks of each way, with their lines."""
        for blocks, _ in self._ways(self.tree):
            yield blocks

    def _ways(self, nodes: Sequence[Node]) -> Iterator[tuple[list[tuple[str, int]], bool]]:
        """The blocks, and whether the program goes on behind them."""
        if not nodes:
            yield [], True
            return
        first, rest = nodes[0], nodes[1:]
        for blocks, goes_on in self._ways_of(first):
            if not goes_on:
                yield blocks, False
                continue
            for more, is_whole in self._ways(rest):
                yield [*blocks, *more], is_whole

    def _ways_of(self, node: Node) -> Iterator[tuple[list[tuple[str, int]], bool]]:
        match node:
            case Lines():
                yield [(text, self.places[id(node), place]) for place, text in enumerate(node.texts)], True
            case Leave():
                yield from (([], True), ([], False))
            case Choice():
                for place, part in enumerate(node.parts):
                    for blocks, goes_on in self._ways(part):
                        yield [*self._mark() * place, *blocks, *self._mark()], goes_on
            case Again():
                is_while = node.style < len(self.spelling.loops) and self.spelling.loops[node.style][2]
                for passes in range(0 if is_while else 1, 4):
                    for blocks, goes_on in self._passes(node.part, passes):
                        yield blocks, goes_on

    def _passes(self, part: Sequence[Node], count: int) -> Iterator[tuple[list[tuple[str, int]], bool]]:
        if not count:
            yield [], True
            return
        for blocks, goes_on in self._ways(part):
            for more, is_whole in self._passes(part, count - 1) if goes_on else [([], False)]:
                yield [*self._mark(), *blocks, *more], is_whole

    def _mark(self) -> list[tuple[str, int]]:
        """What stands for a label in a flat program: in Klartext, a chain ends there."""
        return [("* - LABEL", 0)] if self.control == "heidenhain" else []

    def flat(self, way: Sequence[tuple[str, int]]) -> tuple[str, dict[int, int]]:
        """The text of a way, and from which line each of its lines is."""
        head = [each for each in (self.begin, self.spelling.head) if each]
        lines = [*head, *(text for text, _ in way), self.spelling.ends, *([self.end] if self.end else [])]
        return "\n".join(lines), {len(head) + place: line for place, (_, line) in enumerate(way, 1)}


# The law -------------------------------------------------------------------------------------------------------------


def result_of(answer: Answer) -> object:
    ends = [each.end for each in answer.contour.elements] if answer.contour else []
    return answer.status, tuple(tuple(round(at, 5) + 0.0 for at in end) for end in ends)


_OPEN = {"position-unknown", "mode-unknown"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("control", "seed"),
    [
        pytest.param(control, seed, marks=[pytest.mark.slow] if seed or number % 3 else [])
        for seed in range(8)
        for number, control in enumerate(SPELLINGS)
    ],
)
def test_what_is_told_of_all_ways_is_right_on_each_of_them(control, seed):
    typed, happens, starts = Program(control, seed), defaultdict(set), defaultdict(set)
    for way in typed.ways():
        text, origins = typed.flat(way)
        for answer in solve(text, control=control).answers:
            happens[origins[answer.lines[0]]].add(result_of(answer))
            starts[origins[answer.lines[0]]].add(answer.start.values)
    told, is_open, endless = defaultdict(set), set[int](), "goes on from pass to pass"
    result = solve(typed.text, control=control)
    for answer in result.answers:
        told[answer.lines[0]].add(result_of(answer))
        if _OPEN & {each.code for each in answer.diagnostics}:
            is_open.add(answer.lines[0])
    assert told.keys() == happens.keys(), typed.text
    for line, found in told.items():
        if line == min(is_open, default=0) and endless not in str(result.diagnostics):
            # What all ways agree on is known.
            assert len(starts[line]) > 1 or len(happens[line]) > 1 or None in min(starts[line]), (line, typed.text)
        elif line not in is_open:
            assert found == happens[line], (line, typed.text)
