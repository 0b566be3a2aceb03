"""Contours that are solved together come out as they do one by one: the same answers, findings and bytes."""

import sys
from random import Random

import pytest
from generate_lx3 import random_g11, random_g112
from generate_nct import FORMS, random_chain, random_cornered, random_pair

import contoursolve
from contoursolve.output.document import to_json
from contoursolve.program import examination, pipeline

TAPERS = (
    "G111 X{x} A180. K-30. B120. P{s} Q{s}",
    "G111 A180. K-{k} B{b} X{x} C{s} D{s} F0.2",
    "N{n} G111 X{x} Z-{z} A180. K-{k} P{s}",
    "G111 A{a} K-{k} B{b} U{u} P{s}",
    "G111 I{i} K-{k} W-{w} U{u} C{s}",
    "G111 I0 K-{k} P{s} U{u} W-{w} T0101",
    "g111 a180.k-{k}b{b}u{u}",
    "G111 A135. I{i} K-{k} B180. Z-{z} P{s}",
    "G111 A180. B120. X{x}",
    "G111 A180 K-{k} B120 U{u}",
    "G111 A180. K-{k} B{b} U{u} (A COMMENT)",
    "/G111 A180. K-{k} B{b} U{u}",
    "G42 G111 A180. K-{k} B{b} U{u} M08",
    "G111 A180. K-{k} B{b} U{u} P? (contoursolve: length of line 1 = {k})",
    "G11 Z-{z} I{s}",
    "G112 U0 I10. K-50. P{s} Q{s} R30.",
)
BETWEEN = (
    "G00 X40. Z0.",
    "G00 X{x} Z{z}",
    "G01 X{x} F.2 (T5)",
    "Z-{z}",
    "X{x} Z-{z} T0202",
    "W-1.",
    "U2. W{s}",
    "(A COMMENT)",
    "M08",
    "G02 X{x} Z-{z} R900.",
    "/G01 X{x}",
    "G20",
    "G21",
    "#1=5",
    "G28 U0 W0",
    "G40 G01 X{x} Z5.",
    "X 50. Z -3.",
    "G71 P10 Q{n} U.4",
    "M98 P1000",
    "G76 X{x}",
    "/W-1.",
    "N{n}",
    "W-1. (OPEN",
    "G00 X60 Z5",
)


def fill(rng, text):
    """A line with numbers, some of them zero, negative, too large or without a point."""
    sizes = (f"{rng.uniform(0.1, 2):.2f}", "1.", "2.", "0.", "-1.", "60.", "2")
    return text.format(
        x=f"{rng.uniform(60, 160):.3f}",
        z=f"{rng.uniform(30, 90):.3f}",
        k=rng.choice((f"{rng.uniform(5, 40):.2f}", "30.", "0.", "15")),
        b=rng.choice((f"{rng.uniform(91, 179):.3f}", "120.", "150.", "365.", "180.")),
        a=rng.choice((f"{rng.uniform(91, 179):.2f}", "180.", "-160.", "90.")),
        u=f"{rng.uniform(2, 60):.2f}",
        w=f"{rng.uniform(15, 90):.2f}",
        i=f"{rng.uniform(-3, 9):.2f}",
        n=rng.randrange(9999),
        s=rng.choices(sizes, (10, 4, 4, 1, 1, 1, 1))[0],
    )


def lathe_program(rng):
    tapers = rng.sample(TAPERS, rng.randint(1, 6))
    between = rng.choices(BETWEEN, (*(9,) * 4, 3, *(2,) * 3, *(1,) * 15, 4), k=8)
    lines = ["G00 X40. Z0."]
    for _ in range(rng.randint(5, 24)):
        lines += [fill(rng, rng.choice(between)) for _ in range(rng.choice((0, 1, 1, 2, 4)))]
        lines.append(fill(rng, rng.choice(tapers)))
        if rng.random() < 0.03:
            lines += random_g11(rng, 2).text.splitlines()
            lines += random_g112(rng, rng.choice(("turning", "facing")), "P", "").text.splitlines()
    return rng.choice(("\n", "\n", "\r\n")).join(lines) + rng.choice(("", "\n"))


def mill_program(rng):
    drawn = [
        lambda: random_pair(rng, rng.choice(FORMS[:4]), 17, rng.choice(("", "C", "R"))),
        lambda: random_chain(rng, rng.randint(2, 4), 17),
        lambda: random_cornered(rng, 17),
    ]
    parts = []
    for _ in range(rng.randint(2, 25)):
        parts.append(rng.choice(drawn)().text)
        parts.append(rng.choice(("", "G90 G1 X1. Y1.\n", "Z5\n", "G91 X3 Y1\nG90\n")))
    return "".join(parts)


@pytest.fixture
def alone(monkeypatch):
    """Has every contour solved by itself."""

    def switch():
        walk = pipeline.walk
        monkeypatch.setattr(
            "contoursolve.postprocess.expansion.walk",
            lambda *given, **options: walk(*given[:2], None, *given[3:], **options),
        )
        monkeypatch.setattr("contoursolve.api._MANY", 10**9)

    monkeypatch.setattr("contoursolve.api._MANY", 1)
    return switch


@pytest.mark.parametrize("seed", [*range(6), *range(12, 16)])
def test_contours_solved_together_are_those_solved_one_by_one(seed, alone, monkeypatch, request):
    rng = Random(seed)
    if seed % 6:
        request.getfixturevalue("without_repairs")
    control, text = ("nct-99m", mill_program(rng)) if seed % 4 == 3 else ("yasnac-lx3", lathe_program(rng))
    post, rules = rng.choice(("same", "linuxcnc", "fanuc")), rng.choice(("enforce", "enforce", "warn", "off"))
    written = {
        "arcs": rng.choice(("center", "radius")),
        "decimals": rng.choice((None, None, 2, 5)),
        "comments": rng.random() < 0.6,
        "block_numbers": rng.choice(("first", "all")),
        "units": rng.choice(("mm", "inch")),
        "start": rng.choice((None, "X40. Z0." if control == "yasnac-lx3" else "X0 Y0")),
    }
    monkeypatch.setattr(examination, "_FIRST", rng.choice((1, 4, 16)))
    monkeypatch.setattr(examination, "_WINDOW", rng.choice((8, 64, 4096)))
    monkeypatch.setattr("contoursolve.program.batch.FEWEST", rng.choice((1, 2, 8)))
    found = []
    for is_alone in (False, True):
        if is_alone:
            alone()
        expansion = contoursolve.expand(text, post=post, rules=rules, control=control, keep_going=True, **written)
        summary = expansion.summary
        told = summary.replaced, summary.warnings, summary.deviation, summary.unfamiliar, summary.line_end
        left = [(each.lines, each.reason, each.diagnostics) for each in summary.left]
        result = contoursolve.solve(text, rules=rules, control=control, depth="full" if seed % 6 == 0 else "verdict")
        bounds = [answer.error_bound for answer in result.answers]
        found.append((expansion.text, told, left, to_json(result), bounds))
    assert found[0] == found[1]


@pytest.mark.parametrize("seed", [1, *range(3, 11)])
def test_a_block_that_is_solved_often_is_told_as_at_first(seed, monkeypatch):
    """From then on its checks are a part of its function, and nothing else may differ."""
    rng = Random(seed)
    control, text = ("nct-99m", mill_program(rng)) if seed % 2 else ("yasnac-lx3", lathe_program(rng))
    monkeypatch.setattr("contoursolve.api._MANY", 10**9)
    solving, start = sys.modules["contoursolve.solving.solve"], "X0 Y0" if seed % 2 else "X40. Z0."
    judge, judged, told = solving.judge_range, [], []
    monkeypatch.setattr(solving, "judge_range", lambda path: judged.append(path) or judge(path))
    for often in (10**9, 0):
        monkeypatch.setattr(solving, "OFTEN", often)
        told.append((to_json(contoursolve.solve(text, control=control, start=start, depth="verdict")), len(judged)))
        judged.clear()
    (at_first, one_by_one), (often_told, rest) = told
    assert at_first == often_told
    # What passes all its checks is no more judged one by one; behind a call that is not there, nothing is judged.
    assert rest < one_by_one or not one_by_one
