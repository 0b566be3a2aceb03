"""Expressions and statements of programs, as each control spells them."""

import math
import re
from collections.abc import Callable

import pytest
from examples import law
from hypothesis import strategies as st

from contoursolve.execution.evaluate import FUNCTIONS, evaluate, name_of_indexed, variables_of, written
from contoursolve.execution.fanuc import fanuc, haas
from contoursolve.execution.isg import isg
from contoursolve.execution.klartext import klartext
from contoursolve.execution.macro_language import (
    Assign,
    Call,
    CallKind,
    Else,
    ElseIf,
    EndIf,
    EndLoop,
    For,
    Forget,
    If,
    Jump,
    JumpWay,
    Loop,
    ProgramEnd,
    Return,
    Strange,
    Unknown,
    When,
    WordFormula,
)
from contoursolve.execution.notation import FANUC, ISG, KLARTEXT, LINUXCNC, SINUMERIK, Notation, UnreadableTermError
from contoursolve.execution.sinumerik import sinumerik
from contoursolve.execution.term_reader import LONGEST_TERM, read_term
from contoursolve.execution.term_writer import NOTATIONS, UnwritableTermError, write_term
from contoursolve.numeric.terms import Apply, Constant, Indexed, Term, Variable

VALUES = (2.5, -3.0, 0.75)
"""Of the variables of drawn expressions; each language has names of its own for them."""
NAMES = {
    "fanuc": ("#1", "#2", "#103"),
    "haas": ("#1", "#2", "#103"),
    "linuxcnc": ("#1", "#<_B>", "#3"),
    "sinumerik": ("R1", "_B", "A[2]"),
    "isg": ("P1", "V.L.B", "V.P.A[2]"),
    "klartext": ("Q1", "QL2", "QR30"),
}
PYTHON = (
    (r"\[(?!2\])", "("),
    (r"(?<!\[2)\]", ")"),
    (r"\b(SIN|COS|SQRT|ABS|SQ|POT|SQR) ([\w.]+)", r"\1(\2)"),
    (r"\bB_AND\b|\bAND\b", "and"),
    (r"\bNE\b|<>", "!="),
    (r"\bLT\b", "<"),
)
"""What makes Python of an expression: its own `eval` says what that is worth."""


def in_python(text: str, target: str) -> float:
    names = sorted(NAMES[target], key=len, reverse=True)
    for place, name in enumerate(names):
        text = text.replace(name, f"v{place}v")
    for pattern, python in PYTHON:
        text = re.sub(pattern, python, text)
    known = {f"v{place}v": VALUES[NAMES[target].index(name)] for place, name in enumerate(names)}
    functions = {name: FUNCTIONS[meaning] for name, meaning in NOTATIONS[target].functions.items()}
    return float(eval(text, {**functions, **known}))


def applied(functions: str, *arguments: st.SearchStrategy[Term]) -> st.SearchStrategy[Term]:
    names = st.sampled_from(functions.split())
    return st.builds(lambda name, *given: Apply(name, given), names, *arguments)


NUMBERS = st.integers(-4000, 4000).map(lambda eighths: Constant(eighths / 8))
TERMS = st.recursive(
    st.one_of(NUMBERS, st.sampled_from("ABC").map(Variable)),
    lambda inner: st.one_of(
        applied("add subtract multiply divide", inner, inner),
        applied("negate sine cosine absolute square square_root", inner),
    ),
    max_leaves=12,
)
COMPARED = applied("less unequal", TERMS, TERMS)
CONDITIONS = st.one_of(COMPARED, applied("and", COMPARED, COMPARED))


def renamed(term: Term, target: str) -> Term:
    match term:
        case Variable(name):
            return Variable(NAMES[target]["ABC".index(name)])
        case Apply(function, arguments):
            return Apply(function, tuple(renamed(each, target) for each in arguments))
    return term


@law(st.one_of(TERMS, CONDITIONS), few=13, many=333)
def test_what_is_written_has_its_value_for_python_and_for_who_reads_it(term):
    for target, names in NAMES.items():
        known = dict(zip(names, VALUES, strict=True)).__getitem__
        own = evaluate(renamed(term, target), known)
        try:
            text = write_term(renamed(term, target), target)
        except UnwritableTermError:
            assert target == "klartext"
            continue
        again, end = read_term(NOTATIONS[target], text)
        assert end == len(text)
        assert evaluate(again, known) == own, text
        try:
            value = in_python(text, target)
        except (ValueError, ArithmeticError):
            assert isinstance(own, Unknown), text
        else:
            # Python does not compute what stands behind a false `and`.
            assert value == own or (isinstance(own, Unknown) and "AND" in text), text


ANGLES = st.sampled_from([0.0, 0.5, 1.0, -1.0, -7.25, 1e-3, 300.0])


@law(ANGLES, ANGLES)
def test_what_a_language_lacks_is_said_otherwise(y, x):
    for function, expected in (
        ("arctangent2", math.degrees(math.atan2(y, x))),
        ("length", math.hypot(y, x)),
        ("arctangent", math.degrees(math.atan(y))),
        ("modulo", y - x * math.trunc(y / x) if x else None),
    ):
        term = Apply(function, (Constant(y), Constant(x))[: 1 if function == "arctangent" else 2])
        for target in NAMES:
            if function == "modulo" and target == "linuxcnc":
                continue  # its FIX is another one
            value = evaluate(read_term(NOTATIONS[target], write_term(term, target))[0], str)
            if expected is None or (function == "arctangent2" and x == y == 0):
                assert isinstance(value, Unknown) or value == 0
            else:
                assert value == pytest.approx(expected, abs=1e-5)


def test_every_function_computes_as_python_does():
    table = {"sine": 0.5, "cosine": math.sqrt(0.75), "tangent": math.sqrt(1 / 3), "square_root": math.sqrt(30)}
    table |= {"logarithm": math.log(30), "exponential": math.exp(30), "round": 30.0, "fraction": 0.0, "sign": 1.0}
    for name, expected in table.items():
        assert evaluate(Apply(name, (Constant(30.0),)), str) == pytest.approx(expected), name
    halves = {"round": (3, -3), "truncate": (2, -2), "round_away": (3, -3), "floor": (2, -3), "ceiling": (3, -2)}
    for name, both in halves.items():
        assert tuple(evaluate(Apply(name, (Constant(each),)), str) for each in (2.5, -2.5)) == both, name
    assert evaluate(Apply("sine", (Constant(180.0),)), str) == 0


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("1/0", "it divides by 0"),
        ("1 MOD 0", "it divides by 0"),
        ("SQRT[0-1]", "it takes the root of a negative number"),
        ("ACOS[2]", "it takes the arccosine of a number beyond 1"),
        ("TAN[90]", "it takes the tangent of a right angle"),
        ("EXP[1000]", "its value is too large"),
        ("[0-8]**.5", "it takes a power of a negative number that is not whole"),
        ("#1+#2", "#1?"),
        ("#[1.5]", "1.5 is no number of a variable"),
        ("#[#1+1]", "#1?"),
    ],
)
def test_what_has_no_value_says_why(text, reason):
    assert evaluate(read_term(FANUC, text)[0], lambda name: Unknown(f"{name}?")) == Unknown(reason)


def test_ten_times_a_tenth_is_one():
    tenth = Constant(0.1)
    total = tenth
    for _ in range(9):
        total = Apply("add", (total, tenth))
    assert evaluate(Apply("less", (total, Constant(1.0))), str) == 0
    assert evaluate(Apply("truncate", (Apply("divide", (Constant(0.3), tenth)),)), str) == 3


def test_numbers_are_written_as_a_program_has_them():
    numbers = (95.0, -0.5, 0.1, 1e-12, -1e-12, 1e22, 1 / 3, -40.0, 123456.789)
    texts = "95. -0.5 0.1 0. 0. 10000000000000000000000. 0.333333333 -40. 123456.789"
    assert " ".join(map(written, numbers)) == texts


def test_variables_by_number():
    assert name_of_indexed("#", [101.0]) == "#101"
    assert name_of_indexed("A", [2.0, 0.0]) == "A[2,0]"
    assert [*variables_of(read_term(FANUC, "##1+#[#2]")[0])] == [
        Indexed("#", (Variable("#1"),)),
        Variable("#1"),
        Indexed("#", (Variable("#2"),)),
        Variable("#2"),
    ]


@pytest.mark.parametrize(
    ("notation", "text", "value"),
    [
        (FANUC, "2+3*4 EQ 14", 1),
        (FANUC, "ATAN[1]/[0-1]", 135),
        (FANUC, "ATAN[4]/2", math.degrees(math.atan(4)) / 2),
        (FANUC, "13 AND 7 OR 16", 21),
        (LINUXCNC, "1 LT 2 AND 3 GT 2", 1),
        (LINUXCNC, "FIX[-2.8]", -3),
        (SINUMERIK, "1+2*3 DIV 4", 2),
        (SINUMERIK, "NOT (1==2)", 1),
        (SINUMERIK, "12EX-1", 1.2),
        (SINUMERIK, "POT(3)-ATAN2(1,1)", -36),
        (ISG, "SQR[3]+SQRT[16]**2", 25),
        (ISG, "11 MOD 3", 2),
        (KLARTEXT, "( 115 - ( TAN 45 * 10 ) )", 105),
        (KLARTEXT, "-2^2 + SQ -3", 5),
        (KLARTEXT, "SQRT 16 * 2", 8),
        (KLARTEXT, "+3 LEN 4,0", 5),
    ],
)
def test_operators_bind_as_the_language_says(notation, text, value):
    term, end = read_term(notation, text)
    assert (evaluate(term, str), end) == (pytest.approx(value), len(text))


def test_an_expression_ends_where_it_cannot_go_on():
    assert read_term(FANUC, "X#100Y#101", 1, is_value=True) == (Variable("#100"), 5)
    assert read_term(SINUMERIK, "R1=5 ORIWKS", 3) == (Constant(5.0), 4)
    for text in ("", "SIN[30", "1+", "]", "+" * 10_000, "[" * 10_000, "1+" * LONGEST_TERM + "1"):
        with pytest.raises(UnreadableTermError):
            read_term(FANUC, text)


def of(notation: Notation) -> Callable[[str], Term]:
    return lambda text: read_term(notation, text)[0]


F = of(FANUC)
FANUC_LINES = [
    (
        "N0010 #100=#101+2.*SIN[30] (A #5)",
        "N0010                      (A #5)",
        [Assign(F("#100"), F("#101+2*SIN[30]"))],
    ),
    ("#1=5 #[#1+2]=#1*2 G0 X5", "                  G0 X5", [Assign(F("#1"), F("5")), Assign(F("#[#1+2]"), F("#1*2"))]),
    ("IF[#1 GT 3]GOTO 20", "", [Jump("20", F("#1 GT 3"))]),
    ("IF [#1 EQ #0] THEN #1=5", "", [When(F("#1 EQ #0"), (Assign(F("#1"), F("5")),))]),
    ("IF[#1 EQ 1] THEN", "", [If(F("#1 EQ 1"))]),
    ("ELSE", "", [Else()]),
    ("ENDIF", "", [EndIf()]),
    ("WHILE[#1 LT 10]DO1", "", [Loop("1", F("#1 LT 10"))]),
    ("END 1", "", [EndLoop("1")]),
    ("GOTO#5", "", [Jump(F("#5"))]),
    ("GOTON0100", "", [Jump("100")]),
    ("GOTO 0", "", [Jump("0")]),
    ("G0 X40. M98 P0100 L3", "G0 X40.", [Call(CallKind.PROGRAM, "100", count=F("3"))]),
    ("M98P50100", "", [Call(CallKind.PROGRAM, "100", count=F("5"))]),
    ("M98 P#1", "", [Call(CallKind.PROGRAM, F("#1"))]),
    ("M97 P1000 L2", "M97 P1000 L2", []),
    ("M99", "M99", [Return()]),
    ("M99 P30", "", [Return(F("30"))]),
    ("G28 U0 M30", "G28 U0 M30", [ProgramEnd()]),
    (
        "G65 P9010 A1. B#2 I4 I-[#3+1] L2",
        "",
        [
            Call(
                CallKind.PROGRAM,
                "9010",
                count=F("2"),
                arguments=(("#1", F("1")), ("#2", F("#2")), ("#4", F("4")), ("#7", F("-[#3+1]"))),
                is_local=True,
            )
        ],
    ),
    ("G71 P10 Q020 U.5 F.2", "G71 P10 Q020 U.5 F.2", [Call(CallKind.PROFILE, "10", "20", cycle="G71")]),
    ("G73 X5 Z-3 R1 Q2 P5", "G73 X5 Z-3 R1 Q2 P5", []),
    ("G71 U2. R1.", "G71 U2. R1.", []),
    ("#1=", "", [Forget(F("#1"), "#1= cannot be read")]),
    ("WHILE[#1", "", [Strange("WHILE[#1 cannot be read")]),
    ("#3000=1(ALARM)", "       (ALARM)", [ProgramEnd()]),
    ("G65 H01 P#100 Q#101", "", [Strange("G65 H01 P#100 Q#101 cannot be followed")]),
]

K = of(KLARTEXT)
KLARTEXT_LINES = [
    ("12 Q30 = ( 115 - ( TAN 72 * 10 ) ) ; x", "12".ljust(35) + "; x", [Assign(K("Q30"), K("115 - TAN 72 * 10"))]),
    ("FN 0: Q1 = +5", "", [Assign(K("Q1"), K("5"))]),
    ("FN0:QL1=-5,5", "", [Assign(K("QL1"), K("-5.5"))]),
    ("3 FN 4: Q4 = +4 DIV +Q2", "3", [Assign(K("Q4"), K("4 / Q2"))]),
    ("FN 13: Q1 = +5 ANG -Q2", "", [Assign(K("Q1"), Apply("arctangent2", (K("5"), K("-Q2"))))]),
    ("FN 9: IF +Q1 EQU +Q2 GOTO LBL 5", "", [Jump("5", Apply("equal", (K("Q1"), K("Q2"))))]),
    ('FN 12: IF +Q1 LT +10 GOTO LBL "Up"', "", [Jump("UP", Apply("less", (K("Q1"), K("10"))))]),
    ("FN 18: SYSREAD Q25 = ID210 NR4 IDX3", "", [Forget(K("Q25"), "FN 18 reads it from the control")]),
    ("FN 14: ERROR = 1000", "FN 14: ERROR = 1000", []),
    ("LBL 0", "", [Return()]),
    ("CALL LBL 1", "", [Call(CallKind.LABEL, "1")]),
    ("CALL LBL 1 REP 2/2", "", [Call(CallKind.SECTION, "1", count=K("2"))]),
    ('CALL LBL "a" REP Q5', "", [Call(CallKind.SECTION, "A", count=K("Q5"))]),
    ("CALL PGM TNC:\\dir\\name.H", "", [Call(CallKind.PROGRAM, "NAME")]),
    ("6 CYCL DEF 14.0 KONTUR", "6 CYCL DEF 14.0 KONTUR", []),
    (
        "6 CYCL DEF 14.1 KONTURLABEL1 /2",
        "6",
        [Call(CallKind.PROFILE, each, cycle="CYCL DEF 14") for each in "12"],
    ),
    (
        'CONTOUR DEF P1 = LBL 1 I2 = "B.H" DEPTH 5',
        "",
        [Call(CallKind.PROFILE, each, cycle="CONTOUR DEF") for each in ("1", "B")],
    ),
    ("L Z+100 R0 FMAX M30", "L Z+100 R0 FMAX M30", [ProgramEnd()]),
    (
        "CYCL DEF 200 A Q200=2 Q201=-20 ~",
        "CYCL DEF 200 A".ljust(31) + "~",
        [Assign(K("Q200"), K("2")), Assign(K("Q201"), K("-20"))],
    ),
    ("Q206=FAUTO", "", [Forget(K("Q206"), "Q206=FAUTO cannot be read")]),
    ("* - Q5 = 3", "* - Q5 = 3", []),
    ('TOOL CALL "SEQ5" Z S100', 'TOOL CALL "SEQ5" Z S100', []),
]
S = of(SINUMERIK)
SINUMERIK_LANGUAGE = sinumerik(["MSG", "TRANS", "ANG", "RND", "CHF", "CR", "AC", "FRCM"])
SINUMERIK_LINES = [
    (
        "N10 R[R2]=R1+1 R3=R1*2 ; R5=1",
        "N10".ljust(23) + "; R5=1",
        [Assign(S("R[R2]"), S("R1+1")), Assign(S("R3"), S("R1*2"))],
    ),
    (
        "DEF REAL AA=5, BB, CC[2]",
        "",
        [Assign(S(name), S(value)) for name, value in (("AA", "5"), ("BB", "0"), ("CC[0]", "0"), ("CC[1]", "0"))],
    ),
    ("DEF INT DD[2]=SET(1,2)", "", [Assign(S("DD[0]"), S("1")), Assign(S("DD[1]"), S("2"))]),
    ("IF R1==5 GOTOF MARK", "", [Jump("MARK", S("R1==5"), JumpWay.FORWARD)]),
    ("IF (R1>5) AND NOT (R2<3)", "", [If(S("(R1>5) AND NOT (R2<3)"))]),
    ("WHILE R1<10", "", [Loop("WHILE", S("R1<10"))]),
    ("ENDWHILE", "", [EndLoop("WHILE")]),
    ("FOR II=1 TO R2+1", "", [For(S("II"), S("1"), S("R2+1"), name="FOR")]),
    ("LOOP", "", [Loop("LOOP")]),
    ("REPEAT", "", [Loop("REPEAT")]),
    ("UNTIL R1>=5", "", [EndLoop("REPEAT", S("R1>=5"))]),
    ("GOTOB N100", "", [Jump("N100", way=JumpWay.BACKWARD)]),
    (
        "CASE R1 OF 1 GOTOF AA DEFAULT GOTOB BB",
        "",
        [Jump("AA", S("R1==1"), JumpWay.FORWARD), Jump("BB", way=JumpWay.BACKWARD)],
    ),
    ("REPEAT LAB P=3", "", [Call(CallKind.SECTION, "LAB", count=S("3"))]),
    ("REPEAT AA BB P=R1", "", [Call(CallKind.LABEL, "AA", "BB", S("R1"))]),
    ("REPEATB AA P3", "", [Call(CallKind.LABEL, "AA", "AA", S("3"))]),
    ("L10 P3", "", [Call(CallKind.PROGRAM, "L10", count=S("3"))]),
    ("Kontur", "", [Call(CallKind.PROGRAM, "KONTUR")]),
    ("KONTUR(1,,R2)", "", [Call(CallKind.PROGRAM, "KONTUR", arguments=(("1", S("1")), ("2", S("0")), ("3", S("R2"))))]),
    ('CALL "/_N_WKS_DIR/_N_NAME_SPF"', "", [Call(CallKind.PROGRAM, "NAME")]),
    ("CALL BLOCK AA TO BB", "", [Call(CallKind.LABEL, "AA", "BB")]),
    ("G0 X5 M17", "G0 X5 M17", [Return()]),
    ("S2=1000 M2=3 FRCM= 200", "S2=1000 M2=3 FRCM= 200", []),
    ("RET", "", [Return()]),
    ('CYCLE95("NAME",1,2)', "", [Call(CallKind.PROFILE, "NAME", cycle="CYCLE95")]),
    ('CYCLE95("A:B",1,2)', "", [Call(CallKind.PROFILE, "A", "B", cycle="CYCLE95")]),
    ('CYCLE62(,2,"L1","L2")', "", [Call(CallKind.PROFILE, "L1", "L2", cycle="CYCLE62")]),
    ('MSG("X R1=5")', 'MSG("X R1=5")', []),
    ("R1=FOO(3)", "", [Forget(S("R1"), "R1=FOO(3) cannot be read")]),
    ("GOTOS", "", [Strange("GOTOS cannot be read", jumps=True)]),
]
G = of(ISG)
ISG_LINES = [
    ("N10 P[P1]=3*P2 (x (y) P1=4)", "N10".ljust(15) + "(x (y) P1=4)", [Assign(G("P[P1]"), G("3*P2"))]),
    ("V.P.A[1].B=2", "", [Assign(G("V.P.A[1].B"), G("2"))]),
    ("$IF P1 > 5", "", [If(G("P1>5"))]),
    ("$ELSEIF P1==2", "", [ElseIf(G("P1==2"))]),
    ("$FOR P1 = 0, 10, 2", "", [For(G("P1"), G("0"), G("10"), G("2"), "FOR")]),
    ("$ENDFOR", "", [EndLoop("FOR")]),
    ("$DO", "", [Loop("DO")]),
    ("$ENDDO P1<5", "", [EndLoop("DO", Apply("not", (G("P1<5"),)))]),
    ("$GOTO N0010", "", [Jump("10")]),
    ("$GOTO [Lab]", "", [Jump("LAB")]),
    ("LL Sub1", "", [Call(CallKind.PROGRAM, "SUB1")]),
    ("M29", "M29", [Return()]),
    ('#MSG ["P1=5"]', '#MSG ["P1=5"]', []),
    ("$SWITCH P1", "", [Strange("$SWITCH P1 cannot be read")]),
]
LANGUAGES = {
    fanuc(): FANUC_LINES,
    haas(): [("M97 P1000 L2", "", [Call(CallKind.LINES, "1000", count=F("2"))])],
    klartext(): KLARTEXT_LINES,
    SINUMERIK_LANGUAGE: SINUMERIK_LINES,
    isg(): ISG_LINES,
}
LINES = [(language, *row) for language, rows in LANGUAGES.items() for row in rows]


@pytest.mark.parametrize(("language", "line", "rest", "statements"), LINES)
def test_what_a_line_says(language, line, rest, statements):
    code = language.read(line)
    assert [*code.statements] == statements
    assert code.rest == rest.ljust(len(line))
    assert language.may_say(line) or not statements


def test_formulas_of_words_have_their_places():
    line = "G1 X#100Z-[#1+2.] ,A-#3 F.2 (X#5)"
    code = fanuc().read(line)
    assert code.rest == line
    assert code.words == (
        WordFormula(4, 8, F("#100")),
        WordFormula(9, 17, F("-[#1+2]")),
        WordFormula(20, 23, F("-#3")),
    )
    code = SINUMERIK_LANGUAGE.read("G1X=R1Y=AC(R2+1) ANG=-_ANG CR=5")
    assert code.words == (WordFormula(4, 6, S("R1")), WordFormula(11, 15, S("R2+1")), WordFormula(21, 26, S("-_ANG")))
    code = isg().read("X100+P10 Y[P1+2] #ANG=V.L.A F1000")
    assert code.words == (
        WordFormula(1, 8, G("100+P10")),
        WordFormula(10, 16, G("P1+2")),
        WordFormula(22, 27, G("V.L.A")),
    )
    assert klartext().read("L X+Q1 LENQ31 RQL2").words == (
        WordFormula(3, 6, K("Q1")),
        WordFormula(10, 13, K("Q31")),
        WordFormula(15, 18, K("QL2")),
    )


def test_programs_and_blocks_begin():
    assert SINUMERIK_LANGUAGE.read("%_N_L10_SPF").begins == "L10"
    assert (isg().read("%L Sub1").begins, isg().read("%BRACKET").begins) == ("SUB1", "BRACKET")
    procedure = SINUMERIK_LANGUAGE.read("PROC Name(REAL AA, VAR INT BB=3, STRING[20] CC) SAVE")
    assert (procedure.begins, procedure.parameters) == ("NAME", ("AA", "BB", "CC"))
    assert SINUMERIK_LANGUAGE.read("N5 Mark: G1 X5").labels == ("MARK",)
    assert isg().read("[Lab]").labels == ("LAB",)
    assert klartext().read("0 BEGIN PGM Cam MM").begins == "CAM"
    assert [klartext().read(line).labels for line in ("5 LBL 012", 'LBL "Up"')] == [("12",), ("UP",)]
    assert (fanuc().read("O0100 (A)").begins, fanuc().read(":7").begins) == ("100", "7")
    assert [fanuc().read(line).number for line in ("N0020 X5", "/N7#1=2", "X5")] == ["20", "7", ""]


@pytest.mark.parametrize(
    ("language", "line"),
    [
        (fanuc(), "N1234 G1 X12.345 Y-23.456 Z1.234 F1000."),
        (fanuc(), "G02X1.Y2.I3.J-4.F100"),
        (fanuc(), "M3 S1000 T01"),
    ],
)
def test_words_say_nothing_else(language, line):
    assert not language.may_say(line)


@pytest.mark.parametrize(
    ("language", "name", "files"),
    [
        (fanuc(), "100", {"O0100.nc", "O100", "0100.txt"}),
        (klartext(), "POCKET", {"POCKET.H"}),
        (SINUMERIK_LANGUAGE, "L10", {"L10.SPF", "L10.ARC", "L10.MPF"}),
        (isg(), "SUB.NC", {"SUB.NC"}),
    ],
)
def test_files_in_which_a_subprogram_may_be(language, name, files):
    assert files <= {*language.files(name)}


@pytest.mark.parametrize(
    ("language", "name", "reason"),
    [
        (fanuc(), "#5041", "#5041 is the machine's"),
        (fanuc(), "#100", "#100 is set by nothing before"),
        (klartext(), "Q108", "Q108 is the machine's"),
        (klartext(), "QL108", "QL108 is set by nothing before"),
        (SINUMERIK_LANGUAGE, "$AA_IW[X]", "$AA_IW[X] is the machine's"),
        (isg(), "V.E.A", "V.E.A is the machine's"),
    ],
)
def test_why_a_variable_is_not_known(language, name, reason):
    assert language.unknown(name) == reason


PIECES = sorted({piece for rows in LANGUAGES.values() for row in rows for piece in re.findall(r"\w+|\S| ", row[0])})


@law(st.lists(st.sampled_from(PIECES), max_size=40).map("".join) | st.text(max_size=60).filter(str.isprintable), few=6)
def test_nothing_raises_and_columns_stay(line):
    for language in LANGUAGES:
        code = language.read(line)
        assert len(code.rest) == len(line)
        assert all(new in (old, " ") for old, new in zip(line, code.rest, strict=True))
        assert all(0 <= word.begin < word.end <= len(line) for word in code.words)
        assert language.may_say(line) or code.rest == line


@pytest.mark.parametrize(
    "piece", ["[", "X[", "X[ ", "#", "(", "IF[", "-", "1+", "SIN(", "$IF ", "R1=", "Q1=", "LBL ", '("', "A,"]
)
def test_a_line_of_one_thing_again_and_again_is_read(piece):
    for language in LANGUAGES:
        for times in (100, 1900 // len(piece), 10_000):
            assert len(language.read(piece * times).rest) == len(piece * times)
