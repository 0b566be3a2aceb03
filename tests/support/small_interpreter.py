"""Programs with calls, loops, branches and formulas, drawn as trees: a tree is written for a control, and run here.

What runs is the flat program: the blocks in their order, with numbers for variables. Nothing of the package is used.
"""

import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from random import Random

# Expressions and statements -----------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Var:
    number: int


@dataclass(frozen=True)
class Op:
    sign: str
    left: "Expr"
    right: "Expr"


@dataclass(frozen=True)
class Of:
    function: str
    inner: "Expr"


Expr = float | Var | Op | Of
SIGNS: dict[str, Callable[[float, float], float]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
COMPARED: dict[str, Callable[[float, float], bool]] = {
    "EQ": operator.eq,
    "NE": operator.ne,
    "GT": operator.gt,
    "LT": operator.lt,
}
FUNCTIONS: dict[str, Callable[[float], float]] = {
    "SIN": lambda a: math.sin(math.radians(a)),
    "COS": lambda a: math.cos(math.radians(a)),
    "SQRT": math.sqrt,
    "ABS": abs,
}


def value(expr: Expr, known: Mapping[int, float]) -> float:
    match expr:
        case Var():
            return known[expr.number]
        case Op():
            return SIGNS[expr.sign](value(expr.left, known), value(expr.right, known))
        case Of():
            return FUNCTIONS[expr.function](value(expr.inner, known))
    return expr


@dataclass(eq=False)
class Assignment:
    number: int
    value: Expr


@dataclass(eq=False)
class Lines:
    """Some blocks in a row, each a template with `{}` for each of its values."""

    blocks: list[tuple[str, list[Expr]]]


@dataclass(eq=False)
class Called:
    name: int
    count: int


@dataclass(eq=False)
class Counting:
    """A loop that counts a variable from 0 up to a last value, which is not reached."""

    number: int
    last: int
    body: list["Node"]


@dataclass(eq=False)
class Decided:
    """What runs where a comparison holds, and what otherwise."""

    sign: str
    left: Expr
    right: Expr
    then: list["Node"]
    otherwise: list["Node"]
    jumps: bool
    """Whether it is written with jumps, where a language has both."""


@dataclass(eq=False)
class Left:
    """A jump behind the loop in which it stands, or behind so many more around that, where a comparison holds."""

    sign: str
    left: Expr
    right: Expr
    more: int


Node = Assignment | Lines | Called | Counting | Decided | Left


@dataclass
class Tree:
    main: list[Node]
    subprograms: dict[int, list[Node]]


class LeftError(Exception):
    """A loop is left, and so many more around it."""


class Runner:
    """Runs a tree: blocks as they are in the tree, and with numbers for their values."""

    def __init__(self, tree: Tree) -> None:
        self.tree = tree
        self.known: dict[int, float] = {}

    def walk(self, nodes: list[Node]) -> Iterator[tuple[Lines, list[str]]]:
        for node in nodes:
            match node:
                case Assignment():
                    self.known[node.number] = value(node.value, self.known)
                case Lines():
                    numbers = ((text, [number(value(each, self.known)) for each in own]) for text, own in node.blocks)
                    yield node, [text.format(*given) for text, given in numbers]
                case Called():
                    for _ in range(node.count):
                        yield from self.walk(self.tree.subprograms[node.name])
                case Counting():
                    yield from self.count(node)
                case Decided():
                    yield from self.walk(node.then if self.holds(node) else node.otherwise)
                case Left() if self.holds(node):
                    raise LeftError(node.more)

    def count(self, node: Counting) -> Iterator[tuple[Lines, list[str]]]:
        self.known[node.number] = 0.0
        try:
            while self.known[node.number] < node.last:
                yield from self.walk(node.body)
                self.known[node.number] += 1
        except LeftError as error:
            if error.args[0]:
                raise LeftError(error.args[0] - 1) from None

    def holds(self, node: Decided | Left) -> bool:
        return COMPARED[node.sign](value(node.left, self.known), value(node.right, self.known))


def number(amount: float) -> str:
    text = f"{amount:.9f}".rstrip("0")
    return "0." if text == "-0." else text


# Programs ------------------------------------------------------------------------------------------------------------


@dataclass
class Typed:
    """A program as it is written, and the flat program: its lines, each with the line of the program that it is."""

    text: str
    flat: str
    origins: dict[int, int]


class Writer:
    """Writes a tree for Fanuc and its kin; each subclass for another language. Numbers of blocks are those of
    labels."""

    head: tuple[str, ...] = ("O0001",)
    foot: tuple[str, ...] = ("M30",)
    flat_head: tuple[str, ...] = ()
    flat_foot: tuple[str, ...] = ()
    subprograms_first = False
    signs: Mapping[str, str] = {each: f" {each} " for each in COMPARED}
    brackets = "[]"

    def __init__(self, modes: str) -> None:
        self.modes = modes
        self.lines: list[str] = []
        self.places: dict[int, int] = {}
        self.labels = 0
        self.depth = 0
        self.ends: list[int] = []
        """The labels behind the loops that are open."""

    def write(self, tree: Tree) -> Typed:
        main = lambda: self._main(tree)  # noqa: E731
        rest = [lambda name=name: self._subprogram(name, tree.subprograms[name]) for name in tree.subprograms]
        for each in [*rest, main] if self.subprograms_first else [main, *rest]:
            each()
        self.lines += self.flat_foot
        flat, origins = [*self.flat_head, *filter(None, [self.modes])], {}
        for node, blocks in Runner(tree).walk(tree.main):
            first = self.places[id(node)]
            for offset, block in enumerate(blocks):
                flat.append(self.block(block))
                origins[len(flat)] = first + offset
        return Typed("\n".join(self.lines) + "\n", "\n".join((*flat, *self.foot, *self.flat_foot)) + "\n", origins)

    def _main(self, tree: Tree) -> None:
        self.lines += [*self.head, *filter(None, [self.modes])]
        self.nodes(tree.main)
        self.lines += self.foot

    def _subprogram(self, name: int, nodes: list[Node]) -> None:
        self.lines.append(f"O{name:04}")
        self.nodes(nodes)
        self.lines.append("M99")

    def nodes(self, nodes: list[Node]) -> None:
        for node in nodes:
            match node:
                case Assignment():
                    self.assign(node.number, node.value)
                case Lines():
                    self.move(node)
                case Called():
                    self.call(node.name, node.count)
                case Counting():
                    self.assign(node.number, 0.0)
                    self.ends.append(6000 + self.label())
                    self.count(node)
                    if any(isinstance(each, Left) for each in all_of(node.body)):
                        self.mark(self.ends[-1])
                    self.ends.pop()
                case Decided():
                    self.decide(node)
                case Left():
                    self.leave(node, self.ends[-1 - node.more])

    def move(self, node: Lines) -> None:
        given = [[self.in_word(each) for each in values] for _, values in node.blocks]
        self.places[id(node)] = len(self.lines) + 1
        for (text, _), values in zip(node.blocks, given, strict=True):
            self.lines.append(self.block(text.format(*values)))

    def block(self, text: str) -> str:
        return text

    def label(self) -> int:
        self.labels += 1
        return self.labels

    def bracketed(self, text: str) -> str:
        return f"{self.brackets[0]}{text}{self.brackets[1]}"

    def term(self, expr: Expr) -> str:
        match expr:
            case Var():
                return self.variable(expr.number)
            case Op():
                return f"{self.operand(expr.left)}{expr.sign}{self.operand(expr.right)}"
            case Of():
                return f"{expr.function}{self.bracketed(self.term(expr.inner))}"
        return number(expr)

    def operand(self, expr: Expr) -> str:
        is_bare = isinstance(expr, Var | Of) or (isinstance(expr, float) and expr >= 0)
        return self.term(expr) if is_bare else self.bracketed(self.term(expr))

    def condition(self, node: Decided | Left) -> str:
        return f"{self.operand(node.left)}{self.signs[node.sign]}{self.operand(node.right)}"

    # Fanuc

    def variable(self, place: int) -> str:
        return f"#{100 + place}"

    def in_word(self, expr: Expr) -> str:
        return self.term(expr) if isinstance(expr, float | Var) else self.bracketed(self.term(expr))

    def assign(self, place: int, expr: Expr) -> None:
        self.lines.append(f"{self.variable(place)}={self.term(expr)}")

    def call(self, name: int, count: int) -> None:
        self.lines.append(f"M98 P{name:04}" + (f" L{count}" if count > 1 else ""))

    def count(self, node: Counting) -> None:
        self.depth += 1
        self.lines.append(f"WHILE [{self.variable(node.number)} LT {node.last}] DO{self.depth}")
        self.nodes(node.body)
        self.assign(node.number, Op("+", Var(node.number), 1.0))
        self.lines.append(f"END{self.depth}")
        self.depth -= 1

    def leave(self, node: Left, label: int) -> None:
        self.lines.append(f"IF [{self.condition(node)}] GOTO {label}")

    def mark(self, label: int) -> None:
        self.lines.append(f"N{label}")

    def decide(self, node: Decided) -> None:
        then, end = 100 * self.label(), 100 * self.label()
        self.lines.append(f"IF [{self.condition(node)}] GOTO {then}")
        self.nodes(node.otherwise)
        self.lines += [f"GOTO {end}", f"N{then}"]
        self.nodes(node.then)
        self.lines.append(f"N{end}")


class SinumerikWriter(Writer):
    head = ("%_N_MAIN_MPF",)
    signs: Mapping[str, str] = {"EQ": "==", "NE": "<>", "GT": ">", "LT": "<"}
    brackets = "()"

    def _subprogram(self, name: int, nodes: list[Node]) -> None:
        self.lines.append(f"%_N_L{name}_SPF")
        self.nodes(nodes)
        self.lines.append("M17" if name % 2 else "RET")

    def block(self, text: str) -> str:
        return re.sub(r"([A-Z]{3})(?=[-.\d])", r"\1=", text)

    def variable(self, place: int) -> str:
        return f"R{place}"

    def in_word(self, expr: Expr) -> str:
        return f"={self.term(expr)}"

    def call(self, name: int, count: int) -> None:
        self.lines.append(f"L{name}" + (f" P{count}" if count > 1 else ""))

    def count(self, node: Counting) -> None:
        self.lines.append(f"WHILE {self.variable(node.number)}<{node.last}")
        self.nodes(node.body)
        self.assign(node.number, Op("+", Var(node.number), 1.0))
        self.lines.append("ENDWHILE")

    def leave(self, node: Left, label: int) -> None:
        self.lines.append(f"IF {self.condition(node)} GOTOF ENDS_{label}")

    def mark(self, label: int) -> None:
        self.lines.append(f"ENDS_{label}:")

    def decide(self, node: Decided) -> None:
        if node.jumps:
            then, end = f"THEN_{self.label()}", f"END_{self.label()}"
            self.lines.append(f"IF {self.condition(node)} GOTOF {then}")
            self.nodes(node.otherwise)
            self.lines += [f"GOTOF {end}", f"{then}:"]
            self.nodes(node.then)
            self.lines.append(f"{end}:")
            return
        self.lines.append(f"IF {self.condition(node)}")
        self.nodes(node.then)
        self.lines.append("ELSE")
        self.nodes(node.otherwise)
        self.lines.append("ENDIF")


class IsgWriter(SinumerikWriter):
    head = ("%MAIN",)
    subprograms_first = True
    brackets = "[]"

    def _subprogram(self, name: int, nodes: list[Node]) -> None:
        self.lines.append(f"%L SUB{name}")
        self.nodes(nodes)
        self.lines.append("M29")

    def variable(self, place: int) -> str:
        return f"P{place}" if place % 2 else f"V.L.R{place}"

    def call(self, name: int, count: int) -> None:
        self.lines += [f"LL SUB{name}"] * count

    def count(self, node: Counting) -> None:
        self.lines.append(f"$WHILE {self.variable(node.number)} < {node.last}")
        self.nodes(node.body)
        self.assign(node.number, Op("+", Var(node.number), 1.0))
        self.lines.append("$ENDWHILE")

    def leave(self, node: Left, label: int) -> None:
        self.lines.append(f"$IF {self.condition(node)} $GOTO N{label}")

    def mark(self, label: int) -> None:
        Writer.mark(self, label)

    def decide(self, node: Decided) -> None:
        self.lines.append(f"$IF {self.condition(node)}")
        self.nodes(node.then)
        self.lines.append("$ELSE")
        self.nodes(node.otherwise)
        self.lines.append("$ENDIF")


class KlartextWriter(Writer):
    """Its words have parameters, and no formulas: those are computed before; its loops run once at least."""

    head = flat_head = ("BEGIN PGM A MM",)
    foot: tuple[str, ...] = ("L Z+100 R0 FMAX M30",)
    flat_foot = ("END PGM A MM",)
    signs: Mapping[str, str] = {"EQ": "EQU", "NE": "NE", "GT": "GT", "LT": "LT"}
    brackets = "()"

    def _subprogram(self, name: int, nodes: list[Node]) -> None:
        self.lines.append(f"LBL {name}")
        self.nodes(nodes)
        self.lines.append("LBL 0")

    def variable(self, place: int) -> str:
        return f"Q{place}"

    def operand(self, expr: Expr) -> str:
        return f"+{self.term(expr)}" if isinstance(expr, float) and expr >= 0 else super().operand(expr)

    def term(self, expr: Expr) -> str:
        if isinstance(expr, Op):
            return f"{super().operand(expr.left)} {expr.sign} {super().operand(expr.right)}"
        if isinstance(expr, Of):
            return f"{expr.function} {super().operand(expr.inner)}"
        return super().term(expr).removesuffix(".")

    def in_word(self, expr: Expr) -> str:
        if isinstance(expr, Op | Of):
            place = 1000 + self.label()
            self.assign(place, expr)
            expr = Var(place)
        return f"+{self.term(expr)}" if isinstance(expr, Var) or expr >= 0 else self.term(expr)

    def assign(self, place: int, expr: Expr) -> None:
        if isinstance(expr, float) and place % 2:
            self.lines.append(f"FN 0: Q{place} = {self.in_word(expr)}")
        else:
            self.lines.append(f"Q{place} = {self.term(expr)}")

    def call(self, name: int, count: int) -> None:
        again = 5000 + self.label()
        if count > 1:
            self.lines.append(f"LBL {again}")
        self.lines.append(f"CALL LBL {name}")
        if count > 1:
            self.lines.append(f"CALL LBL {again} REP {count - 1}")

    def count(self, node: Counting) -> None:
        again = 5000 + self.label()
        self.lines.append(f"LBL {again}")
        self.nodes(node.body)
        self.assign(node.number, Op("+", Var(node.number), 1.0))
        self.lines.append(f"FN 12: IF +Q{node.number} LT +{node.last} GOTO LBL {again}")

    def leave(self, node: Decided | Left, label: int) -> None:
        left, right = self.in_word(node.left), self.in_word(node.right)
        number_of = {"EQ": 9, "NE": 10, "GT": 11, "LT": 12}[node.sign]
        self.lines.append(f"FN {number_of}: IF {left} {self.signs[node.sign]} {right} GOTO LBL {label}")

    def mark(self, label: int) -> None:
        self.lines.append(f"LBL {label}")

    def decide(self, node: Decided) -> None:
        then, end = 5000 + self.label(), 5000 + self.label()
        self.leave(node, then)
        self.nodes(node.otherwise)
        self.lines += [f"FN 9: IF +0 EQU +0 GOTO LBL {end}", f"LBL {then}"]
        self.nodes(node.then)
        self.lines.append(f"LBL {end}")


# What is drawn -------------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Control:
    """How one control is programmed: its writer, a rapid move, a line, and its contours, each with what its values
    add to where it begins (`x`, `y`) and to nothing (`n`)."""

    name: str
    writer: type[Writer]
    modes: str
    rapid: str
    feed: str
    contours: tuple[tuple[tuple[str, str], ...], ...]


LATHE = (
    (("G01 X{} Z{} ,R{}", "xyr"), ("X{}", "X")),
    (("G01 Z{} ,C{}", "yr"), ("X{} ,A{}", "Xa")),
    (("G01 X{} ,A{}", "Xa"),),
)
CONTROLS = {
    "fanuc-lathe": Control("fanuc-lathe", Writer, "G21 G40", "G00 X{} Z{}", "G01 X{} Z{} F.2", LATHE),
    "haas-lathe": Control(
        "haas-lathe",
        Writer,
        "G21 G40",
        "G00 X{} Z{}",
        "G01 X{} Z{} F.2",
        ((("G01 X{} Z{} ,R{}", "xyr"), ("X{}", "X")),),
    ),
    "fanuc-mill": Control(
        "fanuc-mill",
        Writer,
        "G17 G21 G90",
        "G00 X{} Y{}",
        "G01 X{} Y{} F100.",
        ((("G01 X{} Y{} ,R{}", "xyr"), ("X{}", "X")), (("G01 Y{} ,C{}", "yr"), ("X{}", "X"))),
    ),
    "yasnac-lx3": Control(
        "yasnac-lx3", Writer, "", "G00 X{} Z{}", "G01 X{} Z{} F.2", ((("G111 X{} A180. K{} B{} P{}", "Xkar"),),)
    ),
    "siemens-840d": Control(
        "siemens-840d",
        SinumerikWriter,
        "G17 G90",
        "G0 X{} Y{}",
        "G1 X{} Y{} F100",
        (
            (("G1 X{} Y{} RND{}", "xyr"), ("X{}", "X")),
            (("G1 X{} ANG{}", "Xa"),),
            (("G1 Y{} CHF{}", "yr"), ("X{} ANG{}", "Xa")),
        ),
    ),
    "isg": Control(
        "isg",
        IsgWriter,
        "G17 G90",
        "G00 X{} Y{}",
        "G01 X{} Y{} F100",
        ((("G01 X{} Y{} #RND{}", "xyr"), ("X{}", "X")), (("G01 X{} #ANG{}", "Xa"),)),
    ),
    "heidenhain": Control(
        "heidenhain",
        KlartextWriter,
        "",
        "L X{} Y{} R0 FMAX",
        "L X{} Y{} F100",
        (
            (("L X{} Y{}", "xy"), ("FL X{} Y{}", "xy"), ("RND R{}", "r"), ("FL X{} AN{}", "Xa")),
            (("L X{} Y{}", "xy"), ("FL X{} AN{}", "Xa")),
        ),
    ),
}


class Drawing:
    """Draws a tree for a control."""

    def __init__(self, control: Control, seed: int) -> None:
        self.control, self.draw = control, Random(seed)
        self.counters, self.loops = 50, 0

    def tree(self) -> Tree:
        names = [10 * each for each in range(1, self.draw.randint(1, 3) + 1)]
        names = [each + self.draw.randint(0, 1) for each in names]
        subprograms = {name: [self.rapid(), *self.nodes(names[at + 1 :], 1), self.contour()]
                       for at, name in enumerate(names)}  # fmt: skip
        start: list[Node] = [Assignment(place, self.length(10, 40)) for place in range(1, 6)]
        return Tree(
            [*start, self.rapid(), *self.nodes(names, 2), Called(names[0], self.draw.randint(1, 2))], subprograms
        )

    def nodes(self, names: list[int], depth: int) -> list[Node]:
        return [self.node(names, depth) for _ in range(self.draw.randint(1, 3))]

    def node(self, names: list[int], depth: int) -> Node:
        if self.loops and self.draw.random() < 0.2:
            sides = Var(self.draw.randint(1, 5)), self.expr()
            return Left(self.draw.choice([*COMPARED]), *sides, self.draw.randrange(self.loops))
        kind = self.draw.randrange(12)
        if kind < 3 and names:
            return Called(self.draw.choice(names), self.draw.choice((1, 1, 2)))
        if kind < 4 and depth:
            self.counters += 1
            counter, self.loops = self.counters, self.loops + 1
            body = self.nodes(names, depth - 1)
            self.loops -= 1
            return Counting(counter, self.draw.randint(1, 3), body)
        if kind < 6 and depth:
            sign, sides = self.draw.choice([*COMPARED]), (Var(self.draw.randint(1, 5)), self.expr())
            then, otherwise = self.nodes(names, depth - 1), self.nodes(names, depth - 1)
            return Decided(sign, *sides, then, otherwise, self.draw.random() < 0.5)
        if kind < 8:
            return Assignment(self.draw.randint(1, 5), self.expr())
        return self.rapid() if kind < 9 else self.feed() if kind < 10 else self.contour()

    def length(self, least: float, most: float) -> float:
        return round(self.draw.uniform(least, most), 3)

    def expr(self) -> Expr:
        """A length between some 5 and 60."""
        var = Var(self.draw.randint(1, 5))
        match self.draw.randrange(6):
            case 0:
                return var
            case 1:
                return Op("/", Op("+", var, Var(self.draw.randint(1, 5))), 2.0)
            case 2:
                return Op(
                    "+", 25.0, Op("*", self.length(1, 15), Of(self.draw.choice(("SIN", "COS")), Op("*", var, 3.0)))
                )
            case 3:
                return Op("+", 10.0, Of("SQRT", Of("ABS", Op("-", var, self.length(1, 40)))))
            case 4:
                return Op("-", self.length(60, 70), var)
        return self.length(10, 40)

    def rapid(self) -> Lines:
        return Lines([(self.control.rapid, [self.expr(), self.expr()])])

    def feed(self) -> Lines:
        return Lines([(self.control.feed, [self.expr(), self.expr()])])

    def contour(self) -> Lines:
        """A contour that ends farther out than anything else."""
        blocks = list[tuple[str, list[Expr]]]()
        for text, kinds in self.draw.choice(self.control.contours):
            blocks.append((text, [self.amount(kind) for kind in kinds]))
        return Lines(blocks)

    def amount(self, kind: str) -> Expr:
        match kind:
            case "r":
                return self.length(0.5, 3) if self.draw.random() < 0.7 else Op("/", self.expr(), 20.0)
            case "a":
                return self.length(20, 70) if self.draw.random() < 0.7 else Op("+", 10.0, self.expr())
            case "k":
                return Op("-", 0.0, self.expr())
            case "X":
                return Op("+", 80.0, self.expr())
        return self.expr()


def program(control: str, seed: int, *, is_shuffled: bool = False) -> Typed:
    """A program that is drawn for a control, and the flat program of it; with the words of each block in another order,
    if it is shuffled."""
    own = CONTROLS[control]
    tree, draw = Drawing(own, seed).tree(), Random(seed)
    for node in all_of([*tree.main, *(each for nodes in tree.subprograms.values() for each in nodes)]):
        if is_shuffled and isinstance(node, Lines):
            node.blocks = [shuffled(text, given, draw) for text, given in node.blocks]
    return own.writer(own.modes).write(tree)


def all_of(nodes: list[Node]) -> Iterator[Node]:
    for node in nodes:
        yield node
        if isinstance(node, Counting):
            yield from all_of(node.body)
        elif isinstance(node, Decided):
            yield from all_of([*node.then, *node.otherwise])


def shuffled(text: str, given: list[Expr], draw: Random) -> tuple[str, list[Expr]]:
    """A block with its words in another order, the first one apart: Klartext says with it what the block is."""
    first, *words = text.split()
    values = iter(given)
    parts = [(word, [next(values)] if "{" in word else []) for word in [first, *words]]
    rest = parts[1:]
    draw.shuffle(rest)
    return " ".join(word for word, _ in [parts[0], *rest]), [each for _, own in [parts[0], *rest] for each in own]
