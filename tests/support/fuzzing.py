"""Programs of every control that somebody damaged, and the commands that are to answer them.

`python tests/support/fuzzing.py --seed 0 --count 1000 --control isg` runs many, and prints each that is not answered.
"""

import argparse
import json
import random
import re
import shlex
import signal
import string
import sys
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import chdir, contextmanager
from functools import cache
from math import hypot, isfinite
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time
from typing import NamedTuple

import drawn_calls
import sympy  # noqa: F401 - the first --explain imports it, which is not its fault
from click.testing import CliRunner

from contoursolve import CONTROLS, Result, Severity, Status, solve
from contoursolve.cli import main

ROOT = Path(__file__).parents[2]
SLOW = 5.0
"""Seconds of processor time that no run may need on an idle machine; most take a hundredth of it."""

ENDLESS = 60.0
"""Seconds of processor time after which a test stops a run: a busy machine needs several times as many."""

GAP = 1e-9
"""mm."""

NAMED = tuple(CONTROLS)


@cache
def examples(control: str) -> list[str]:
    """The right and wrong examples of a control's rules, its test vectors, and programs with calls and loops."""
    rules = [rule.told for rule in CONTROLS[control].catalogue]
    texts = [text for rule in rules for text in (*rule.accepted, *rule.rejected)]
    vectors = json.loads((ROOT / "docs" / "vectors" / f"{control}.json").read_text(encoding="utf-8"))["vectors"]
    texts += ["\n".join(each["program"]) for each in vectors]
    if control in drawn_calls.CONTROLS:
        texts += [drawn_calls.drawn_program(control, seed).text for seed in range(20)]
    return [*dict.fromkeys(texts)]


@cache
def right_programs(control: str) -> list[str]:
    """The programs of a control's own examples that have a contour and no error."""
    accepted = dict.fromkeys(text for rule in CONTROLS[control].catalogue for text in rule.accepted)
    results = ((text, solve(text, control=control)) for text in accepted)
    return [text for text, each in results if any(one.contour for one in each.answers) and not each.has_errors]


# What is changed ---------------------------------------------------------------------------------------------

ODD = (
    *"%/#[]();,.+-$&'\"\\\0\t\x1a \u00c4\u0663\u2212\ufeff\U0001f600\ud800",
    *(" G111 ", " G1 ", " G91 ", " G41 ", " G18 ", " G04 ", " M98 ", " N10 ", " O1 ", " IF ", " #1=", "[#1]"),
    *(" ,A", ",A90", " ,R2", " Q0", " Q-1", " R-5", " I0", " K0", " A90.", " B0", " P1000.", " C0", " X#1", "\n", "\r"),
    *("1e9", "-", "--", "..", "0", "9" * 40, "0.0000001", "." + "9" * 20, "99999.", "NaN", "INF", "?"),
)
NUMBERS = ("", *f"1e300 {'9' * 20} {'1' * 17} 0.{'3' * 20} -0. .000000001 0 -1 1e-300 90. 180 360. 99999.999 ?".split())

_FANUC = """#1=#1+1.|#100=10./0|#1=SQRT[-1]|#1=ATAN[1]/[0]|#1=#1*#1|#[#1]=5|#500=1e300|#1=#0|#3000=1(ALARM)|N10|N20|O100
END1|IF [#1 LT 10] GOTO 10|IF [#1 EQ #0] THEN #2=5|WHILE [#1 LT 10] DO1|GOTO 10|GOTO #1|M98 P100|M98 P100 L99|M99
M99 P10|M30|G65 P100 A10. B-5.|G66 P100|G67|X#1|X[#1+5.]|X[1./0]|Z-#2 R#3|G10 L2 P1 X10.|G52 X10.|G92 X0 Z0
G50 X10. Z5.|G54|G31 X5.|G68 X0 Y0 R30|G51 X0 Y0 P2|G50.1 X0|G71 P10 Q20 U.4 W.1 F.2|G70 P10 Q20|G28 U0 W0|G41 D1|G42
G40|G43 H1|G20|G91|G18|G19|G16|G96 S200|G76 X10. Z-5.|G04 P500|T0101|/G01 X10.|G02 X20. Z-10. R5.|G03 X20. I5. K0|G12.1
G112|G07.1 C20."""
_SINUMERIK = """R1=R1+1|R1=10/0|R1=SQRT(-1)|R1=R1*R1|R[R1]=5|DEF REAL A=5|DEF INT B[3]|IF R1<10 GOTOB L1|GOTOF L1
GOTO N10|L1:|N10|M17|WHILE R1<10|ENDWHILE|FOR R1=0 TO 10|ENDFOR|REPEAT L1 P=5|REPEAT|UNTIL R1==5|LOOP|ENDLOOP|IF R1==1
ELSE|ENDIF|CALL "A"|A P3|RET|PROC A(REAL B)|%_N_A_SPF|L10 P2|X=R1|X=R1*2 Y=AC(R1)|X=IC(1/0)|RND=R1|ANG=ATAN2(0,0)
$P_UIFR[1,X,TR]=10|TRANS X10|ATRANS Z5|ROT RPL=30|AROT|SCALE X2|MIRROR X0|CYCLE95("A",1,2)|MCALL CYCLE81(1)|DIAMON
DIAMOF|G500|G54|G710|G700|G91|G18|G41|TRANSMIT|CASE R1 OF 1 GOTOF L1 DEFAULT GOTOF L2|STOPRE|G2 X20 Y10 CR=5
CIP X5 I1=2 J1=3|CT X50 Y20|AP=30 RP=20|M30|SETAL(65000,"A")"""
_ISG = """P1=P1+1|P1=10/0|P1=SQRT[-1]|P1=P1*P1|P[P1]=5|V.L.A=5|V.P.A[3]=5|$IF P1<5|$ELSEIF P1==2|$ELSE|$ENDIF
$WHILE P1<10|$ENDWHILE|$FOR P1=0, 10, 1|$ENDFOR|$DO|$ENDDO P1>5|$GOTO N10|$GOTO [L1]|[L1]|N10|$SWITCH P1|$CASE 1
$DEFAULT|$ENDSWITCH|LL A|L A|%L A|%MAIN|L CYCLE [NAME=A]|#VAR|V.L.B=1|#ENDVAR|X=P1|X=P1*2|X[P1/0]|#RND=P1|#ANG=ATAN[0]
#ROTATION ON [ANGLE 30]|G92 X10|G54|M17|M29|M30|G51|G52|G91|G18|G70|G301 I5|G302 I5|G2 X20 Y10 R5|#ANG=30 #ANG=40
#CHR=5|M[1]=5|X=V.A.ABS.X|G41|G161|G2 X5 I1 K2"""
_KLARTEXT = """FN 0: Q1 = +5|FN 1: Q1 = +Q1 + +1|FN 4: Q1 = +1 DIV +0|FN 5: Q1 = SQRT -1|FN 9: IF +Q1 EQU +5 GOTO LBL 1
LBL 1|LBL 0|LBL "A"|FN 12: IF +Q1 LT +10 GOTO LBL 1|CALL LBL 1|CALL LBL 1 REP 5/5|CALL LBL "A" REP 3|CALL PGM B
Q1 = Q1 * 1e10|Q1 = Q1 * Q1|Q1 = 1 / 0|L X+Q1|L IX+5 R0 FMAX|QS1 = "A"|QL1 = TAN 90|QR1 = 5|FN 14: ERROR = 1000
FN 18: SYSREAD Q1 = ID1|M30|STOP|TRANS DATUM AXIS X+10|CYCL DEF 7.0 NULLPUNKT|CYCL DEF 7.1 X+10|CYCL DEF 8.1 X
CYCL DEF 10.0 DREHUNG|CYCL DEF 10.1 ROT+30|CYCL DEF 11.1 SCL 2|CC X+0 Y+0|TOOL CALL 1 Z S1000|FPOL X+0 Y+0|FL AN+30|FLT
FC DR+ R10|FCT DR- CCX+Q1|FSELECT 1|FSELECT 99|FL CLSD+|FL CLSD-|RND R5|CHF 3|CT X+5|CR X+5 Y+5 R+5 DR+|LP PR+20 PA+30
CP IPA+30 DR+|FL PDX+5 PDY+5 D3|FL PAR 2 DP5|FL RAN 1|FC RCCX1|RL|L Z-5 R0 F MAX|APPR LT X+5|BEGIN PGM A INCH
END PGM A MM|FL LEN0|FL X+Q1 Y+1|BLK FORM 0.1 Z X+0 Y+0 Z-5"""
_PILOT = """#l1=5|#1=5|#l1=#l1+1|#l1=10/0|#l1=SQRT(-1)|IF #l1<5|THEN|ELSE|ENDIF|WHILE #l1<10|ENDWHILE|SWITCH #l1|CASE 1
DEFAULT|ENDSWITCH|L"A" V1|UNTERPROGRAMM "A"|RETURN|X#l1|X{#l1+5}|X(1/0)|BEARBEITUNG|FERTIGTEIL|ROHTEIL|ENDE|G80|M99
G59 X10|G56|G820 NS1 NE3|N1|N5|X?|Z? A30|B-2|B0|Q1|Q0|R5|G2 X20 Z-10 R5|G3 X20 Z-10 I5 K-5|G12 X5 Z-5 R3|G13
G20 X50 Z100|G1 XI5 ZI-3|G22|G23 H0|G24|G25 H4|G52 P.5|AN30"""
LINES = {
    **dict.fromkeys(NAMED, _FANUC),
    **dict.fromkeys(("siemens-840d", "siemens-808d"), _SINUMERIK),
    "isg": _ISG,
    "heidenhain": _KLARTEXT,
    "cnc-pilot": _PILOT,
}
"""Lines of each control that compute, jump, call, shift, or change how the others are read."""

_BROKEN = re.compile(r",?[A-Za-z][ ]*[-+]?[0-9.]+")
_NUMBER = re.compile(r"(?<=[A-Z=+,-])(\d+\.?\d*|\.\d+)")
_WORD = re.compile(r"(?<!\S)[,#]?[A-Z]{1,4}=?[+-]?\d*\.?\d+(?!\S)")

Change = Callable[[str, random.Random], str]


def _put(text: str, pattern: re.Pattern[str], draw: random.Random, change: Callable[[str], str]) -> str:
    places = [*pattern.finditer(text)]
    if not places:
        return text
    place = draw.choice(places)
    return text[: place.start()] + change(place[0]) + text[place.end() :]


def _number(text: str, draw: random.Random, change: Callable[[str], str]) -> str:
    return _put(text, _NUMBER, draw, change)


def _word(text: str, draw: random.Random, change: Callable[[str], str]) -> str:
    return _put(text, _WORD, draw, change)


def _one_of(text: str, draw: random.Random, letters: str) -> str:
    """One letter or digit of a text becomes another."""
    at = draw.choice([at for at, each in enumerate(text) if each.isalpha() == letters.isalpha() and each.isalnum()])
    return text[:at] + draw.choice(letters) + text[at + 1 :]


def _other(word: str, draw: random.Random) -> str:
    """A word that often states again what is there."""
    name = draw.choice(("X", "U", "Z", "W", "CR=", "R", "I", "J", ",A", "ANG=", "Q1"))
    return "Q1" if name == "Q1" else name + word.lstrip(",#=" + string.ascii_uppercase)


def _turned(word: str) -> str:
    return word.replace("-", "") if "-" in word else re.sub(r"(?=\d|\.\d)", "-", word, count=1)


def _twice(text: str, draw: random.Random) -> str:
    words = [found[0] for found in _WORD.finditer(text)]
    return f"{text} {draw.choice((draw.choice(words), 'I5.', 'K-3.', 'R4.', 'A45.'))}" if words else text


SLIPS: tuple[Change, ...] = (
    lambda text, draw: _number(text, draw, lambda number: _one_of(number, draw, string.digits)),
    lambda text, draw: _number(text, draw, lambda number: number.replace(".", "")),
    lambda text, draw: _number(text, draw, lambda number: number + number[-1] if number[-1] != "." else number[:-1]),
    lambda text, draw: _number(text, draw, lambda number: f"{float(number) + 360:g}."),
    lambda text, draw: _word(text, draw, lambda word: _one_of(word, draw, "ABCIJKPQRUWXYZ")),
    lambda text, draw: _word(text, draw, _turned),
    lambda text, draw: _word(text, draw, lambda _: ""),
    lambda text, draw: _word(text, draw, lambda word: f"{word} {_other(word, draw)}"),
    lambda text, draw: text.replace(",", "", 1),
    _twice,
    lambda text, draw: f"{text} {draw.choice(('M08', 'M8', 'S500', 'T0101', 'F0.2', 'G01', 'G90', 'M03'))}",
    lambda text, draw: re.sub(r"G0?1\b", draw.choice(("G02", "G00", "G03")), text, count=1),
    lambda text, draw: text.replace(*draw.choice((("0", "O"), ("1", "l"))), 1),
)
"""One slip of a hand."""

TOO_MANY: tuple[Change, ...] = (
    lambda text, draw: f"{text} {draw.choice(('M08', 'T0101', 'G01', 'R5.', 'I5.', 'J5.', 'Q1', 'CR=20', '#ANG=30'))}",
    lambda text, draw: _word(text, draw, lambda word: f"{word} {word}"),
    lambda text, draw: _word(text, draw, lambda word: f"{word} {_other(word, draw)}"),
    lambda text, draw: re.sub(r"(A|ANG=)(-?\d+)\.?", lambda angle: f"{angle[1]}{int(angle[2]) + 360}.", text, count=1),
)
"""Words too many, and those that say the same in other words."""


def mutate(text: str, draw: random.Random) -> str:
    """One random change of characters, words or lines, which no hand would make."""
    lines = text.split("\n")
    words = [*_BROKEN.finditer(text)]
    place, other = draw.randrange(len(text) + 1), draw.randrange(len(text) + 1)
    match draw.randrange(11):
        case 0 | 1:
            return text[:place] + text[place : place + 1] * draw.choice((0, 2)) + text[place + 1 :]
        case 2:
            return text[:place] + draw.choice(ODD) + text[place:]
        case 3:
            return text[:place] + draw.choice(string.printable) + text[place + 1 :]
        case 4 if words:
            word = draw.choice(words)
            return text[: word.start()] + word[0].rstrip("0123456789.") + draw.choice(NUMBERS) + text[word.end() :]
        case 5 if words:
            word = draw.choice(words)
            return text[: word.end()] + draw.choice((" ", "")) + draw.choice(words)[0] + text[word.end() :]
        case 6 if words:
            word, value = draw.choice(words), draw.choice(words)[0].lstrip(",")[1:]
            return text[: word.start()] + word[0].rstrip("-+0123456789. ") + value + text[word.end() :]
        case 7:
            low, high = sorted((place, other))
            return text[:low] + text[low:high][::-1][: draw.randrange(8)] + text[high if high - low < 8 else low :]
        case 8 if draw.random() < 0.2:
            return text.lower()
        case 9:
            return draw.choice(SLIPS)(text, draw)
        case _:
            index, target = draw.randrange(len(lines)), draw.randrange(len(lines))
            change = draw.randrange(3)
            if change == 0:
                lines.insert(target, lines[index])
            elif change == 1:
                del lines[index]
            else:
                lines[index], lines[target] = lines[target], lines[index]
            return "\n".join(lines)


def _spliced(text: str, control: str, draw: random.Random) -> str:
    """Lines of other programs, or such as compute, jump and call, between those of a program."""
    lines = text.split("\n")
    for _ in range(draw.choice((1, 1, 2, 4))):
        of = control if draw.random() < 0.9 else draw.choice(NAMED)
        other = draw.choice(examples(of)).split("\n") if draw.random() < 0.4 else re.split(r"[|\n]", LINES[of])
        at = draw.randrange(len(other))
        lines[(place := draw.randrange(len(lines) + 1)) : place] = other[at : at + draw.choice((1, 1, 1, 3))]
    return "\n".join(lines)


def mutant(control: str, draw: random.Random, *, is_slight: bool = False) -> tuple[str, str]:
    """An example of a control, and what became of it; slight changes leave most contours."""
    right = text = draw.choice(right_programs(control) if is_slight else examples(control))
    for _ in range(draw.choice((0, 1) if is_slight else (1, 1, 1, 2, 2, 3, 6))):
        kind = draw.random()
        text = (
            draw.choice(SLIPS)(text, draw) if kind < 0.35 else
            _number(text, draw, lambda _: draw.choice(NUMBERS)) if kind < 0.45 else
            _spliced(text, control, draw) if kind < 0.7 else mutate(text, draw)
        ) or " "  # fmt: skip
    return right, text


def damaged(seed: int) -> tuple[bytes, str]:
    """A program of one or several contours with a slip or two, in bytes with line ends and characters of every kind,
    and its control."""
    draw = random.Random(seed)
    control = draw.choice(NAMED)
    programs = right_programs(control)
    text = draw.choice(programs)
    others = [each for each in programs if "BEGIN PGM" not in each]
    parts = [text] if "BEGIN PGM" in text else [text, *draw.sample(others, min(draw.choice((0, 1, 2)), len(others)))]
    lines = [line for part in parts for line in part.split("\n")]
    if draw.random() < 0.5:
        # What a fix may mend without a change of the contour.
        at = draw.choice([at for at, line in enumerate(lines) if len(line) > len(lines[0])] or [len(lines) - 1])
        lines[at] = draw.choice(TOO_MANY)(lines[at], draw)
    for _ in range(draw.choice((1, 1, 2, 3))):
        # A long line is rather one of a contour.
        at = max(draw.choices(range(len(lines)), k=2), key=lambda at: len(lines[at]))
        lines[at] = draw.choice(SLIPS)(lines[at], draw)
    lines.insert(0, CONTROLS[control].modes.syntax.remark.format("\u00e4\u00f6\u00fc \u00b0"))
    every = ("\n", "\r\n", "\r")
    usual, encoding = draw.choice(every), draw.choice(("utf-8", "utf-8-sig", "cp1252"))
    ends = [draw.choice(every) if draw.random() < 0.1 else usual for _ in lines]
    ends[-1] = draw.choice(("", usual))
    whole = "".join(line + end for line, end in zip(lines, ends, strict=True))
    return whole.encode(encoding), control


# The commands that answer ------------------------------------------------------------------------------------

COMMANDS = """
check part.nc | check part.nc --strict --explain --format json | check part.nc --rules off --format sarif
check part.nc --fix --diff | check part.nc {tool} | check part.nc {tool} --outside intersect --format github
solve part.nc --format json | solve part.nc --explain | solve part.nc --derivation --units inch
solve part.nc --rules off --format json | expand part.nc --keep-going
expand part.nc --keep-going --arcs radius --decimals 3 --block-numbers all
expand part.nc --post linuxcnc --keep-untranslated --rules warn
expand part.nc --post {post} --formulas --keep-going --keep-untranslated | expand part.nc --inline --keep-going
expand part.nc --formulas --keep-going | expand part.nc {tool} --keep-going | filter part.nc
convert part.nc --to {to} | convert part.nc --to {to} --rules off --no-comments | plot part.nc -o a.svg --force
plot part.nc -o a.dxf --force | plot part.nc -o a.svg --each --theme dark --force
plot part.nc -o a.svg --force {tool} | report part.nc -o a.html --force --explain
diff part.nc right.nc --format json | diff right.nc part.nc --tolerance 0.5 | diff part.nc part.nc {tool}
verify part.nc result.json | verify right.nc result.json --format json | sweep {blocks} --vary {word}={value} --quiet
sweep {blocks} --vary tool=0.2:20:2.2 {tip} --quiet
sweep {blocks} --vary {word}=-10:400:41 --quiet --plot a.svg --force
sweep {blocks} --vary {word}=1:5:1 --vary {second}=0:90:45 --quiet --format json | range {blocks} --word {word}
range {blocks} --word {word} --within -5:200 --format json | find {blocks} --word {word} --goal {goal}
find part.nc --word tool {tip} | sensitivity {blocks} | sensitivity {blocks} --tolerance {word}=0.1 --format json
sensitivity {blocks} --keep {kept} | write part.toml --to {control} | write part.toml --to {to} --all --format json
facts"""
RUNS = [shlex.split(line) for line in re.split(r"[|\n]", COMMANDS) if line]
ATOMS = (
    *("", "--", *" -=:,.@?()[\n\t\0\x1b\u7c97\u0663\udcff", "length of line 1 = 1e999", "Z of end of line 2 = ?"),
    *shlex.split("1e308 -1e308 1e-400 1e9999999999 nan inf -0 0.1 0x1 1_0 1:2:0 0:1:1e-99 '#1' G111 X1 A180. K V1"),
    *shlex.split(
        "--format json --control sys:x nct-99m --setting a.b=c --rules off --units inch --block --start --fact"
    ),
    *shlex.split("/ .. ::x nowhere.nc part.nc right.nc @part.nc:B x.png -o start.X end --help --vary --word --goal"),
)


class Case(NamedTuple):
    """One run of the command: its arguments, and the files beside it. `result.json` is what solve says before."""

    arguments: tuple[str, ...]
    files: dict[str, str]
    control: str

    def __str__(self) -> str:
        shown = "".join(f"\n--- {name}: {text!r}\n{text}" for name, text in self.files.items())
        return f"contoursolve {' '.join(map(repr, self.arguments))}{shown}"


def drawn_case(control: str, seed: int) -> Case:
    """The case of a seed: mostly a mutant under a command as it is, sometimes with other arguments."""
    draw = random.Random(f"{control} {seed}")
    line = draw.choice(RUNS)
    right, text = mutant(control, draw, is_slight=line[0] in ("sweep", "range", "find", "sensitivity"))
    files = {"part.nc": text}
    if line[0] == "write":
        sketch = draw.choice(sorted((ROOT / "tests" / "sketches").glob("*.toml"))).read_text(encoding="utf-8")
        for _ in range(draw.choice((1, 1, 2, 4))):
            sketch = draw.choice((mutate, _sketched, _sketched, _sketched))(sketch, draw)
        files = {"part.toml": sketch}
    elif "right.nc" in line:
        files["right.nc"] = right
    others = [each for each in NAMED if each not in ("yasnac-lx3", "heidenhain", "cnc-pilot", control)]
    named = re.compile(r"(?<![^\s])[,#]?(?:[A-FH-LP-Z]|[A-Z]{2,5})(?:\d(?==)|(?==?[-+.\d]))")
    words = [f"{n}:{each[0]}" for n, line in enumerate(text.split("\n")) for each in named.finditer(line) if n]
    words = [*words, *("start.X", "X", "R")[: 1 if words else 3]]
    tip = "--side left" if re.search(r"Y[-+=\d]", text) else "--tip 3 --side right"
    filled = {
        "to": draw.choice(others),
        "control": control,
        "word": draw.choice(words),
        "second": draw.choice(words),
        "post": draw.choice(("same", "fanuc", "haas", "sinumerik", "klartext", "linuxcnc")),
        "value": draw.choice(NUMBERS) or "5",
        "goal": draw.choice(("end Z-50.", "end X10", "V1 X44.", "end X20 Y10", "corner 1.center Z-20.", "P2 Y5")),
        "kept": draw.choice(("end Z=0.01", "end X=0.01", "end Y=1", "V1 X=0")),
    }
    several = {"{blocks}": as_blocks(text), "{tip}": tip.split(), "{tool}": ["--tool", "0.8", *tip.split()]}
    arguments = [part for each in line for part in several.get(each) or [each.format(**filled)]]
    if line[0] not in ("convert", "write", "facts") and draw.random() < 0.9:
        arguments += ["--control", control]
    if draw.random() < 0.08:
        for _ in range(draw.choice((1, 1, 1, 2, 4))):
            arguments = _other_arguments(arguments, draw)
        arguments = ["below" if _is_outside(each) else each for each in arguments]
    return Case(tuple(arguments), files, control)


def as_blocks(text: str) -> list[str]:
    """The options that state a program as a start and blocks."""
    start, *blocks = text.split("\n")
    return ["--start", re.sub(r"(?i)\bG0?0\b ?", "", start), *(part for each in blocks for part in ("--block", each))]


def case_of(control: str, command: str, text: str) -> Case:
    """A case by hand: a command with part.nc for the program, or with {blocks}."""
    parts = [part for each in shlex.split(command) for part in (as_blocks(text) if each == "{blocks}" else [each])]
    return Case((*parts, "--control", control), {"part.nc": text}, control)


def _sketched(text: str, draw: random.Random) -> str:
    """A sketch with another value, or the value of another line."""
    lines = text.split("\n")
    pairs = [at for at, line in enumerate(lines) if "=" in line and line[0] != "#"]
    if not pairs:
        return text
    at = draw.choice(pairs)
    name, value = lines[at].split("=", 1)[0], lines[draw.choice(pairs)].split("=", 1)[1]
    if draw.random() < 0.3:
        name = draw.choice(("X", "Y", "Z", "AN", "LEN", "R", "CCX", "CCY", "tangent", "IX", "IY", "P1X"))
    new = draw.choice((value, "0", "-1", "1e300", "360", "true", '"arc"', "[]", "{}", "nan", "1e-12", "5", "90", "10"))
    lines[at] = f"{name}={new}"
    return "\n".join(lines)


def _other_arguments(arguments: list[str], draw: random.Random) -> list[str]:
    """One random change of arguments, or within one of them."""
    place, changed = draw.randrange(len(arguments) + 1), list(arguments)
    text = changed[place] if place < len(changed) else ""
    at = draw.randrange(len(text) + 1)
    changed[place : place + draw.randrange(2)] = draw.choice((
        [draw.choice(ATOMS)],
        [],
        [text[:at] + draw.choice(ATOMS) + text[at:]],
        [text[:at] + draw.choice(string.printable) + text[at + 1 :]],
        [text[:at] + text[at + 1 :]],
    ))  # fmt: skip
    return [each for each in changed if each != "--watch"]


def _is_outside(argument: str) -> bool:
    """Whether an argument is an absolute path, or leads to a folder above: a run stays in its own."""
    return argument.lstrip().startswith("/") or ".." in argument


class TooSlowError(BaseException):
    """A run took more processor time than it may; no `except Exception` holds it up."""


@contextmanager
def patience(seconds: float) -> Iterator[None]:
    """Raise TooSlowError in what takes more processor time, where the system has such a clock."""

    def stop(*_: object) -> None:
        raise TooSlowError

    begin = process_time()
    if hasattr(signal, "SIGPROF"):
        before = signal.signal(signal.SIGPROF, stop)
        signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        if hasattr(signal, "SIGPROF"):
            signal.setitimer(signal.ITIMER_PROF, 0)
            signal.signal(signal.SIGPROF, before)
    if process_time() - begin > seconds:
        raise TooSlowError


def fault_of(case: Case, seconds: float = ENDLESS) -> str:
    """What is wrong with the way a run ends; nothing, where it is answered within so much processor time."""
    with TemporaryDirectory() as folder, chdir(folder), warnings.catch_warnings():
        warnings.simplefilter("error")
        Path("below").mkdir()
        for name, text in case.files.items():
            Path(name).write_bytes(text.encode("utf-8", "surrogatepass"))
        runner = CliRunner()
        try:
            with patience(seconds):
                if "result.json" in case.arguments:
                    solved = runner.invoke(main, ["solve", "part.nc", "--format", "json", "--control", case.control])
                    Path("result.json").write_bytes(solved.stdout_bytes)
                done = runner.invoke(main, case.arguments, input="G111 X1\n")
        except TooSlowError as error:
            return f"more than {seconds:g} s of processor time\n{_told(error)}"
        if done.exception is not None and not isinstance(done.exception, SystemExit):
            return f"traceback\n{_told(done.exception)}"
        if done.exit_code not in (0, 1, 2):
            return f"exit status {done.exit_code}: {done.output}"
        is_quiet = case.arguments[:1] == ("diff",) or "--quiet" in case.arguments
        return "" if done.output or Path("a.svg").exists() or is_quiet else f"exit status {done.exit_code}, no output"


def _told(error: BaseException) -> str:
    return "".join(traceback.format_exception(error)[-12:])


def check_answers(result: Result, text: str) -> None:
    """What holds for the answer to any text."""
    lines = [block.text for block in result.program.blocks]
    for answer in result.answers:
        assert isinstance(answer.status, Status)
        has_path = answer.status in (Status.SOLVED, Status.OVERDETERMINED) and answer.contour is not None
        # Of a contour that may not run the errors are warnings.
        # One that waits for another contour is told by an info.
        codes = ("not-checked", "position-unknown", "contour-waits")
        is_told = any(each.severity is not Severity.INFO or each.code in codes for each in answer.diagnostics)
        assert has_path or is_told
        if has_path:
            here = answer.contour.start
            for element in answer.contour.elements:
                assert hypot(element.start[0] - here[0], element.start[1] - here[1]) <= GAP
                here = element.end
            assert isfinite(here[0])
            assert isfinite(here[1])
    assert result.answers or result.diagnostics
    for finding in result.diagnostics:
        for span in (finding.span, *(label.span for label in finding.labels)):
            assert 1 <= span.line <= max(len(lines), 1)
            assert 1 <= span.column < span.end_column <= max(len(lines[span.line - 1]) if lines else 0, 1) + 1
        assert finding.message.isprintable() or not text.isprintable()


def run_many(arguments: list[str]) -> int:
    """The command of this file; the number of cases that were not answered."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=100, help="how many seeds of each control")
    parser.add_argument("--control", choices=NAMED, action="append")
    parser.add_argument("--command", help="only cases of this command")
    parser.add_argument("--seconds", type=float, default=SLOW, help="of processor time that a run may take")
    asked = parser.parse_args(arguments)
    count, faults, begin = 0, 0, process_time()
    for seed in range(asked.seed, asked.seed + asked.count):
        for control in asked.control or NAMED:
            case = drawn_case(control, seed)
            if asked.command not in (None, case.arguments[0]):
                continue
            count += 1
            if fault := fault_of(case, asked.seconds):
                faults += 1
                print(f"=== {control} {seed}: {fault}\n{case}", flush=True)  # noqa: T201
        if not (seed + 1) % 50:
            print(f"seed {seed}: {faults} of {count} not answered; {process_time() - begin:.0f} s", flush=True)  # noqa: T201
    return faults


if __name__ == "__main__":
    sys.exit(bool(run_many(sys.argv[1:])))
