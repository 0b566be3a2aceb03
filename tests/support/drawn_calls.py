"""Programs with calls, loops, branches and formulas, drawn as statements and spelled for a control.

A statement is its kind and its fields. Formulas are those of Fanuc. Nothing of the package is used.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import Any

Statement = tuple[str, dict[str, Any]]
SIGNS = {"EQ": "==", "NE": "<>", "GT": ">", "LT": "<"}
NUMBERED = {"EQ": "FN 9: {} EQU", "NE": "FN 10: {} NE", "GT": "FN 11: {} GT", "LT": "FN 12: {} LT"}


def _kinds(text: str) -> dict[str, str]:
    """How each kind of statement is written, `|` between lines."""
    return {kind: own.replace("|", "\n") for kind, own in (line.split(" ", 1) for line in text.strip().split("\n"))}


FANUC = _kinds("""
main O0001
sub O{name:04}
return M99
end M30
call M98 P{name:04}
set {var}={value}
while WHILE [{var} LT {last}] DO{depth}
wend {var}={var}+1.|END{depth}
leave IF [{test}] GOTO {label}9
mark N{label}9
if IF [{test}] GOTO {label}1|GOTO {label}2|N{label}1
else GOTO {label}3|N{label}2
endif N{label}3
""")
SINUMERIK = _kinds("""
main %_N_MAIN_MPF
sub %_N_L{name}_SPF
return {word}
end M30
call L{name} P{count}
set {var}={value}
while WHILE {var}<{last}
wend {var}={var}+1|ENDWHILE
leave IF {test} GOTOF ENDS_{label}
mark ENDS_{label}:
if IF {test}
else ELSE
endif ENDIF
if-jumps IF {test} GOTOF THEN_{label}|GOTOF ELSE_{label}|THEN_{label}:
else-jumps GOTOF END_{label}|ELSE_{label}:
endif-jumps END_{label}:
""")
ISG = _kinds("""
main %MAIN
sub %L SUB{name}
return M29
end M30
call LL SUB{name}
set {var}={value}
while $WHILE {var} < {last}
wend {var}={var}+1|$ENDWHILE
leave $IF {test} $GOTO N{label}9
mark N{label}9
if $IF {test}
else $ELSE
endif $ENDIF
""")
KLARTEXT = _kinds("""
main BEGIN PGM A MM
sub LBL {name}
return LBL 0
end L Z+100 R0 FMAX M30
call CALL LBL {name}
set {var} = {value}
set-number FN 0: {var} = +{value}
while LBL {label}8
wend {var} = {var} + 1|FN 12: IF +{var} LT +{last} GOTO LBL {label}8
leave {test} GOTO LBL {label}9
mark LBL {label}9
if {test} GOTO LBL {label}1|FN 9: IF +0 EQU +0 GOTO LBL {label}2|LBL {label}1
else FN 9: IF +0 EQU +0 GOTO LBL {label}3|LBL {label}2
endif LBL {label}3
""")
"""Its loops run once at least."""


@dataclass(frozen=True)
class Language:
    """What a language writes: each kind of statement, a variable, a formula and a comparison, and a formula in a
    word."""

    kinds: dict[str, str]
    variable: Callable[[int], str]
    is_numbered: bool = False
    """Whether formulas are in no words, and comparisons have numbers."""
    brackets: str = "[]"
    value: str = "[{}]"

    def formula(self, text: str) -> str:
        text = re.sub(r"#(\d+)", lambda found: self.variable(int(found[1])), text)
        text = text.translate(str.maketrans("[]", self.brackets))
        if self.is_numbered:
            text = re.sub(r"(?<=[\d)])([-+*/])", r" \1 ", re.sub(r"\.(?!\d)", "", text))
        return text

    def test(self, left: str, sign: str, right: str) -> str:
        one, other = self.formula(left), self.formula(right)
        if self.is_numbered:
            return f"{NUMBERED[sign].format(f'IF +{one}')} +{other}"
        return f"{one} {sign} {other}" if self.kinds is FANUC else f"{one}{SIGNS[sign]}{other}"

    def word(self, text: str) -> str:
        if self.is_numbered:
            return self.formula(text) if text.startswith("-") else f"+{self.formula(text)}"
        return self.formula(text) if self.kinds is FANUC and is_plain(text) else self.value.format(self.formula(text))


def is_plain(text: str) -> bool:
    return re.fullmatch(r"#?-?\d+\.?\d*", text) is not None


FANUC_LIKE = Language(FANUC, "#1{:02}".format)
LANGUAGES = {
    "siemens-840d": Language(SINUMERIK, "R{}".format, brackets="()", value="={}"),
    "isg": Language(ISG, lambda number: f"P{number}" if number % 2 else f"V.L.R{number}", value="={}"),
    "heidenhain": Language(KLARTEXT, "Q{}".format, is_numbered=True, brackets="()"),
}


@dataclass(frozen=True)
class Control:
    """How one control is programmed: its modes, a rapid move, a line, and its contours, each with what its values add
    to where it begins (`x`, `y`) and to nothing."""

    modes: str
    rapid: str
    feed: str
    contours: tuple[tuple[tuple[str, str], ...], ...]


_ROUNDED = (("G01 X{} Z{} ,R{}", "xyr"), ("X{}", "X"))
_LATHE = ("G21 G40", "G00 X{} Z{}", "G01 X{} Z{} F.2")
_MILL = ((("G01 X{} Y{} ,R{}", "xyr"), ("X{}", "X")), (("G01 Y{} ,C{}", "yr"), ("X{}", "X")))
_SINUMERIK = (
    (("G1 X{} Y{} RND{}", "xyr"), ("X{}", "X")),
    (("G1 X{} ANG{}", "Xa"),),
    (("G1 Y{} CHF{}", "yr"), ("X{} ANG{}", "Xa")),
)
_ISG = ((("G01 X{} Y{} #RND{}", "xyr"), ("X{}", "X")), (("G01 X{} #ANG{}", "Xa"),))
_FL = (("L X{} Y{}", "xy"), ("FL X{} AN{}", "Xa"))
_RND = (("L X{} Y{}", "xy"), ("FL X{} Y{}", "xy"), ("RND R{}", "r"), ("FL X{} AN{}", "Xa"))
CONTROLS = {
    "fanuc-lathe": Control(
        *_LATHE, (_ROUNDED, (("G01 Z{} ,C{}", "yr"), ("X{} ,A{}", "Xa")), (("G01 X{} ,A{}", "Xa"),))
    ),
    "haas-lathe": Control(*_LATHE, (_ROUNDED,)),
    "fanuc-mill": Control("G17 G21 G90", "G00 X{} Y{}", "G01 X{} Y{} F100.", _MILL),
    "yasnac-lx3": Control("", *_LATHE[1:], ((("G111 X{} A180. K{} B{} P{}", "Xkar"),),)),
    "siemens-840d": Control("G17 G90", "G0 X{} Y{}", "G1 X{} Y{} F100", _SINUMERIK),
    "isg": Control("G17 G90", "G00 X{} Y{}", "G01 X{} Y{} F100", _ISG),
    "heidenhain": Control("", "L X{} Y{} R0 FMAX", "L X{} Y{} F100", (_RND, _FL)),
}


@dataclass
class Program:
    """A drawn program: the statements of its main program and of each subprogram."""

    control: str
    main: list[Statement]
    subprograms: dict[int, list[Statement]]
    text: str = ""
    places: dict[int, int] = field(default_factory=dict)
    """The program line of each statement of blocks."""

    @property
    def language(self) -> Language:
        return LANGUAGES.get(self.control, FANUC_LIKE)

    def spell(self, language: Language, block: Callable[[list[str], Statement], None]) -> str:
        """The text; `block` writes a statement of blocks behind the lines so far."""
        lines, parts = list[str](), [[("main", {}), ("modes", {}), *self.main, ("end", {})]]
        for name, own in self.subprograms.items():
            parts.append([("sub", {"name": name}), *own, ("return", {"word": "M17" if name % 2 else "RET"})])
        ordered = [*parts[1:], parts[0]] if language.kinds is ISG else parts
        for statement in (each for part in ordered for each in part):
            if statement[0] == "block":
                block(lines, statement)
            elif statement[0] == "modes":
                lines += filter(None, [CONTROLS[self.control].modes])
            else:
                lines += self.spelled(*statement, language, lines).split("\n")
        return "\n".join([*lines, *["END PGM A MM"] * language.is_numbered]) + "\n"

    def spelled(self, kind: str, fields: dict[str, Any], language: Language, lines: list[str]) -> str:
        known, count = {**fields, "var": language.variable(fields.get("number", 0))}, fields.get("count", 1)
        if "value" in fields:
            known["value"] = language.formula(fields["value"])
            if language.is_numbered and is_plain(fields["value"]) and fields["number"] % 2:
                kind = "set-number"
        if "sides" in fields:
            left, sign, right = fields["sides"]
            known["test"] = language.test(left, sign, self.computed(lines, right) if language.is_numbered else right)
        own = language.kinds.get(kind, language.kinds[kind.partition("-")[0]]).format(**known)
        if count > 1 and language.is_numbered:
            return f"LBL {7000 + len(lines)}\n{own}\nCALL LBL {7000 + len(lines)} REP {count - 1}"
        if count > 1 and language.kinds is FANUC:
            return f"{own} L{count}"
        return "\n".join([own] * count) if language.kinds is ISG else own

    def computed(self, lines: list[str], value: str) -> str:
        """A variable in which a formula is computed, where no word has one."""
        if not self.language.is_numbered or is_plain(value):
            return value
        lines.append(f"Q{1000 + len(lines)} = {self.language.formula(value)}")
        return f"#{999 + len(lines)}"

    def write(self, lines: list[str], statement: Statement) -> None:
        told = statement[1]["blocks"]
        given = [[self.language.word(self.computed(lines, each)) for each in values] for _, values in told]
        self.places[id(statement)] = len(lines) + 1
        lines += [text.format(*values) for (text, _), values in zip(told, given, strict=True)]

    def flat(self, run: Sequence[tuple[Statement, list[list[float]]]]) -> tuple[str, dict[int, int]]:
        """The blocks in the order in which they run, with numbers, and the program line of each."""
        begin, origins = ["BEGIN PGM A MM"] * self.language.is_numbered, dict[int, int]()
        lines = [*begin, *filter(None, [CONTROLS[self.control].modes])]
        for statement, numbers in run:
            for offset, ((text, _), own) in enumerate(zip(statement[1]["blocks"], numbers, strict=True)):
                lines.append(text.format(*(self.language.word(number(each)) for each in own)))
                origins[len(lines)] = self.places[id(statement)] + offset
        end = [self.language.kinds["end"], *["END PGM A MM"] * self.language.is_numbered]
        return "\n".join([*lines, *end]) + "\n", origins


def number(amount: float) -> str:
    text = f"{amount:.9f}".rstrip("0")
    return "0." if text == "-0." else text


class Drawing:
    """Draws a program for a control; the words of its blocks in another order, if it `is_shuffled`."""

    def __init__(self, control: str, seed: int, *, is_shuffled: bool) -> None:
        self.control, self.draw, self.order = CONTROLS[control], Random(seed), Random(seed)
        self.is_shuffled, self.labels, self.counters, self.loops = is_shuffled, 100, 50, list[int]()
        names = [10 * each + self.draw.randint(0, 1) for each in range(1, self.draw.randint(1, 3) + 1)]
        subprograms = {
            name: [self.rapid(), *self.nodes(names[at + 1 :], 1), self.contour()] for at, name in enumerate(names)
        }
        start = [("set", {"number": place, "value": self.length(10, 40)}) for place in range(1, 6)]
        last = ("call", {"name": names[0], "count": self.draw.randint(1, 2)})
        self.program = Program(control, [*start, self.rapid(), *self.nodes(names, 2), last], subprograms)
        self.program.text = self.program.spell(self.program.language, self.program.write)

    def nodes(self, names: list[int], depth: int) -> list[Statement]:
        return [each for _ in range(self.draw.randint(1, 3)) for each in self.node(names, depth)]

    def label(self) -> int:
        self.labels += 1
        return self.labels

    def sides(self) -> tuple[str, str, str]:
        return f"#{self.draw.randint(1, 5)}", self.draw.choice([*SIGNS]), f"[{self.formula()}]"

    def node(self, names: list[int], depth: int) -> list[Statement]:
        if self.loops and self.draw.random() < 0.2:
            return [("leave", {"sides": self.sides(), "label": self.draw.choice(self.loops)})]
        kind = self.draw.randrange(12)
        if kind < 3 and names:
            return [("call", {"name": self.draw.choice(names), "count": self.draw.choice((1, 1, 2))})]
        if kind < 4 and depth:
            return self.loop(names, depth)
        if kind < 6 and depth:
            jumps = "-jumps" * (self.draw.random() < 0.5)
            label, sides = {"label": self.label()}, {"sides": self.sides()}
            then, otherwise = self.nodes(names, depth - 1), self.nodes(names, depth - 1)
            parts = [("if" + jumps, {**label, **sides}), *then, ("else" + jumps, label), *otherwise]
            return [*parts, ("endif" + jumps, label)]
        if kind < 8:
            return [("set", {"number": self.draw.randint(1, 5), "value": self.formula()})]
        return [self.rapid() if kind < 9 else self.feed() if kind < 10 else self.contour()]

    def loop(self, names: list[int], depth: int) -> list[Statement]:
        """A loop that counts from 0 up to a last value, which is not reached; it can be left."""
        self.counters, label = self.counters + 1, self.label()
        self.loops.append(label)
        fields = {"number": self.counters, "last": self.draw.randint(1, 3), "depth": len(self.loops), "label": label}
        body = self.nodes(names, depth - 1)
        self.loops.pop()
        start = ("set", {"number": fields["number"], "value": "0."})
        return [start, ("while", fields), *body, ("wend", fields), ("mark", fields)]

    def length(self, least: float, most: float) -> str:
        return number(round(self.draw.uniform(least, most), 3))

    def formula(self) -> str:
        """A length between some 5 and 60."""
        var, other = f"#{self.draw.randint(1, 5)}", f"#{self.draw.randint(1, 5)}"
        wave = f"{self.length(1, 15)}*{self.draw.choice(('SIN', 'COS'))}[{var}*3.]"
        root = f"SQRT[ABS[{var}-{self.length(1, 40)}]]"
        far = f"{self.length(60, 70)}-{var}"
        return self.draw.choice((var, f"[{var}+{other}]/2.", f"25.+[{wave}]", f"10.+{root}", far, self.length(10, 40)))

    def rapid(self) -> Statement:
        return self.block((self.control.rapid, "xy"))

    def feed(self) -> Statement:
        return self.block((self.control.feed, "xy"))

    def contour(self) -> Statement:
        """A contour that ends farther out than anything else."""
        return self.block(*self.draw.choice(self.control.contours))

    def block(self, *told: tuple[str, str]) -> Statement:
        blocks = [(text, [self.amount(kind) for kind in kinds]) for text, kinds in told]
        return "block", {"blocks": [self.shuffled(*each) for each in blocks] if self.is_shuffled else blocks}

    def amount(self, kind: str) -> str:
        own, is_plain_one = self.formula(), self.draw.random() < 0.7
        if kind == "r":
            return self.length(0.5, 3) if is_plain_one else f"[{own}]/20."
        if kind == "a":
            return self.length(20, 70) if is_plain_one else f"10.+[{own}]"
        return {"k": f"0.-[{own}]", "X": f"80.+[{own}]"}.get(kind, own)

    def shuffled(self, text: str, given: list[str]) -> tuple[str, list[str]]:
        """A block with its words in another order, the first one apart: Klartext says with it what the block is."""
        values = iter(given)
        first, *rest = [(word, [next(values)] if "{" in word else []) for word in text.split()]
        self.order.shuffle(rest)
        return " ".join(word for word, _ in [first, *rest]), [each for _, own in [first, *rest] for each in own]


def drawn_program(control: str, seed: int, *, is_shuffled: bool = False) -> Program:
    return Drawing(control, seed, is_shuffled=is_shuffled).program
