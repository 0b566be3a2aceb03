"""Programs of which nobody knows which way they take agree with each way that they can take: each is written out as a
flat program here, by nothing of the package."""

from collections import defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import count, islice
from random import Random

import pytest

from contoursolve import Answer, solve


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
    parts: tuple[str, str, str] | None = None
    loops: tuple[tuple[str, str, bool], ...] = ()
    """How a loop begins and ends, and whether it may run no time at all."""
    axes: str = "XY"


_FANUC = Spelling(
    *("G90 G00 X0. Y0. Z5.", "G01 {}", " ,R.5", "G00 {}", "#{} EQ {}", "GOTO {}", "IF[{}]GOTO {}", "N{}"),
    ("IF [{}] THEN", "ELSE", "ENDIF"),
    (("WHILE [{}] DO{}", "END{}", True),),
)
_SIEMENS = Spelling(
    *("G17 G90 G0 X0 Y0", "G1 {}", " RND=0.5", "G0 {}", "R{}=={}", "GOTO L{}", "IF {} GOTO L{}", "L{}:"),
    ("IF {}", "ELSE", "ENDIF"),
    (("WHILE {}", "ENDWHILE", True), ("REPEAT", "UNTIL NOT({})", False)),
)
_ISG = Spelling(
    *("G17 G90 G0 X0 Y0", "G1 {}", " #RND=0.5", "G0 {}", "P{}=={}", "$GOTO N{}", "$IF {}\n$GOTO N{}\n$ENDIF", "N{}"),
    ("$IF {}", "$ELSE", "$ENDIF"),
    (("$WHILE {}", "$ENDWHILE", True),),
)
_JUMP = "FN 9: IF {} GOTO LBL {}"
_KLARTEXT = Spelling(
    *("BEGIN PGM A MM\nL X+0 Y+0 R0 F100", "L {}", "", "L {} FMAX", "+Q{} EQU +{}", _JUMP.format("+0 EQU +0", "{}")),
    *(_JUMP, "LBL {}"),
)
SPELLINGS = {
    "fanuc-lathe": replace(_FANUC, head="G00 X0. Z0.", axes="XZ"),
    "fanuc-mill": _FANUC,
    "haas-mill": _FANUC,
    "nct-99m": _FANUC,
    "mitsubishi": replace(_FANUC, head="G17 G90 G00 X0. Y0."),
    "siemens-840d": _SIEMENS,
    "siemens-808d": _SIEMENS,
    "isg": _ISG,
    "heidenhain": _KLARTEXT,
}

Decide = Callable[[int], int]
"""Which of so many options happens."""


class Left(Exception):  # noqa: N818 - no error
    """The program ends before its last block."""


class Program:
    """A drawn program: its text, and the flat programs of all ways through it with the lines from which they are.

    Its parts are lists of `("lines", *texts)`, of `("choice", number, style, part, other)` between two parts, of
    `("again", number, style, part)` and of `("leave", number)`, each by a condition on the variable of that number.
    """

    def __init__(self, control: str, seed: str) -> None:
        self.spelling, self.draw, self.count = SPELLINGS[control], Random(f"ways {control} {seed}"), 0
        self.is_klartext, self.labels = control == "heidenhain", 0
        self.tree = self.nodes(0)
        self.written = [*self.spelling.head.split("\n")]
        self.places = dict[int, int]()
        self.write(self.tree)
        self.type(f"{self.spelling.label.format(99)}\nM30")
        self.text = "\n".join(self.written)

    def nodes(self, depth: int) -> list[tuple]:
        return [self.node(depth) for _ in range(self.draw.choice((1, 2, 2, 3)))]

    def node(self, depth: int) -> tuple:
        kind = self.draw.random()
        if depth > 1 or kind < 0.45 or self.count > 2:
            return ("lines", *(self.line() for _ in range(self.draw.choice((1, 2, 3)))))
        self.count += 1
        number = 500 + self.count
        if kind < 0.8:
            part = self.nodes(depth + 1)
            other = self.nodes(depth + 1) if self.draw.random() < 0.6 else []
            return "choice", number, self.draw.randrange(2), part, other
        return ("leave", number) if kind < 0.9 else ("again", number, self.draw.randrange(3), self.nodes(depth + 1))

    def line(self) -> str:
        own, draw = self.spelling, self.draw
        sign, point = ("+" if self.is_klartext else ""), "." * own.head.endswith(".")
        values = [draw.choice((-1, 1)) * draw.randrange(1, 90) for _ in own.axes]
        words = [f"{axis}{value:{sign}}{point}" for axis, value in zip(own.axes, values, strict=True)]
        kind = draw.random()
        if kind < 0.15:
            return own.rapid.format(" ".join(words))
        if kind < 0.25 or kind > 0.9:
            return own.block.format(draw.choice(words))
        if self.is_klartext and kind < 0.6:
            return f"FL {words[0]} AN{draw.randrange(20, 70):+}"
        return own.block.format(" ".join(words)) + (own.corner if kind < 0.7 else "")

    def type(self, text: str) -> None:
        self.written += text.split("\n")

    def write(self, nodes: list[tuple]) -> None:
        own = self.spelling
        for node in nodes:
            kind, *rest = node
            if kind == "lines":
                self.places[id(node)] = len(self.written)
                self.written += rest
                continue
            number, is_true = rest[0], own.condition.format(rest[0], 1)
            if kind == "leave":
                self.type(own.jump_if.format(is_true, 99))
            elif kind == "choice" and rest[1] and own.parts:
                begin, other, end = own.parts
                self.type(begin.format(own.condition.format(number, 0)))
                self.write(rest[2])
                if rest[3]:
                    self.type(other)
                    self.write(rest[3])
                self.type(end)
            elif kind == "choice":
                self.labels += 2
                first, second = 99 + self.labels, 100 + self.labels
                self.type(own.jump_if.format(is_true, first))
                self.write(rest[2])
                if rest[3]:
                    self.type(own.jump.format(second))
                self.type(own.label.format(first))
                self.write(rest[3])
                self.type(own.label.format(second))
            elif rest[1] < len(own.loops):
                begin, end, _ = own.loops[rest[1]]
                self.type(begin.format(is_true, number - 500))
                self.write(rest[2])
                self.type(end.format(number - 500 if "END" in end else is_true))
            else:
                self.labels += 1
                label = 100 + self.labels
                self.type(own.label.format(label))
                self.write(rest[2])
                self.type(own.jump_if.format(is_true, label))

    def run(self, nodes: list[tuple], decide: Decide) -> Iterator[tuple[str, int]]:
        """The blocks of one way, with their lines. In Klartext a remark stands for a label: a chain ends there."""
        mark = [("* - LABEL", 0)] * self.is_klartext
        for node in nodes:
            kind, *rest = node
            if kind == "lines":
                yield from ((text, self.places[id(node)] + place) for place, text in enumerate(rest, 1))
            elif kind == "leave":
                if decide(2):
                    raise Left
            elif kind == "choice":
                which = decide(2)
                yield from mark * which
                yield from self.run(rest[2 + which], decide)
                yield from mark
            else:
                is_while = rest[1] < len(self.spelling.loops) and self.spelling.loops[rest[1]][2]
                for _ in range(decide(4) if is_while else 1 + decide(3)):
                    yield from mark
                    yield from self.run(rest[2], decide)

    def ways(self) -> Iterator[tuple[str, dict[int, int]]]:
        """The text of each way, and from which line each of its lines is."""
        head, chosen = self.spelling.head.split("\n"), list[int]()
        while True:
            taken, blocks = list[tuple[int, int]](), list[tuple[str, int]]()

            def decide(options: int, taken=taken, chosen=chosen) -> int:
                taken.append((chosen[len(taken)] if len(taken) < len(chosen) else 0, options))
                return taken[-1][0]

            try:
                for block in self.run(self.tree, decide):
                    blocks.append(block)
            except Left:
                pass
            text = "\n".join([*head, *(text for text, _ in blocks), "M30"])
            yield text, {len(head) + place: line for place, (_, line) in enumerate(blocks, 1)}
            while taken and taken[-1][0] + 1 == taken[-1][1]:
                taken.pop()
            if not taken:
                return
            chosen = [*(which for which, _ in taken[:-1]), taken[-1][0] + 1]


def drawn(control: str, seed: int) -> tuple[Program, list[tuple[str, dict[int, int]]]]:
    """A program with at most 20 ways, and these."""
    for number in count():
        typed = Program(control, f"{seed} {number}")
        ways = list(islice(typed.ways(), 21))
        if len(ways) <= 20:
            return typed, ways
    raise AssertionError


def result_of(answer: Answer) -> object:
    ends = [each.end for each in answer.contour.elements] if answer.contour else []
    return answer.status, tuple(tuple(round(at, 5) + 0.0 for at in end) for end in ends)


@pytest.mark.parametrize("control", SPELLINGS)
@pytest.mark.parametrize("seed", range(6))
def test_what_is_told_of_all_ways_is_right_on_each_of_them(control, seed):
    (typed, ways), happens, starts = drawn(control, seed), defaultdict(set), defaultdict(set)
    for text, origins in ways:
        for answer in solve(text, control=control, depth="verdict").answers:
            happens[origins[answer.lines[0]]].add(result_of(answer))
            starts[origins[answer.lines[0]]].add(answer.start.values)
    told, is_open, endless = defaultdict(set), set[int](), "goes on from pass to pass"
    result = solve(typed.text, control=control, depth="verdict")
    for answer in result.answers:
        told[answer.lines[0]].add(result_of(answer))
        if {"position-unknown", "mode-unknown"} & {each.code for each in answer.diagnostics}:
            is_open.add(answer.lines[0])
    assert told.keys() == happens.keys(), typed.text
    for line, found in told.items():
        if line == min(is_open, default=0) and endless not in str(result.diagnostics):
            # What all ways agree on is known.
            assert len(starts[line]) > 1 or len(happens[line]) > 1 or None in min(starts[line]), (line, typed.text)
        elif line not in is_open:
            assert found == happens[line], (line, typed.text)
