"""Judging a program or a chain takes work by its length: eight times as long, and it takes eight times the work, or
less; and a slip in a long chain is told as in a short one. Work is counted in calls."""

import re
from functools import partial

import pytest
from counted import calls
from long_chains import angles, corners, klartext

from contoursolve import check, expand

# Programs ------------------------------------------------------------------------------------------------------------

QUIET = {
    "empty lines": ("fanuc-mill", "\n"),
    "comments": ("siemens-840d", "; a comment\n"),
    "numbers alone": ("yasnac-lx3", "N10\n"),
    "comments of a plain-text control": ("heidenhain", "; a comment\n"),
}
"""Lines that say nothing."""

CORNER = {
    "fanuc-mill": ("G00 X0. Y0.", "G01 X10. F100. ,R1.", "Y10."),
    "siemens-840d": ("G0 X0 Y0", "G1 X10 F100 RND=1", "Y10"),
    "yasnac-lx3": ("G00 X40. Z0.", "G111 X100. A180. K-30. B120.", "Z-100."),
    "heidenhain": ("L X+0 Y+0 FMAX", "FL AN+0 LEN20", "FCT DR+ R10 CCA+30"),
}


@pytest.mark.parametrize(("control", "line"), QUIET.values(), ids=QUIET)
@pytest.mark.parametrize("place", [0, 1, 2, 3])
def test_work_goes_by_the_number_of_lines_that_say_nothing(control, line, place):
    """A program that is read as a stream. It waited for the next line that says something once for each of them."""

    def act(count: int) -> None:
        lines = [f"{each}\n" for each in CORNER[control]]
        expand("".join((*lines[:place], line * count, *lines[place:])), control=control)

    act(1)
    few, many = (calls(lambda count=count: act(count)) for count in (100, 800))
    assert many <= 1.2 * 8 * few


# Chains --------------------------------------------------------------------------------------------------------------


def pairs(count: int, code: str) -> str:
    """A line at an angle and one to a point, again and again, of which one corner in the middle is too large."""
    heads = {
        "siemens-840d": ("G17 G90 G0 X0 Y0\nG1 F500\n", "G1 ANG=30 RND={size}\nX{end} Y0 ANG=-30 RND=1\n"),
        "nct-99m": ("G17 G90 G00 X0. Y0.\nG41 D1 G01 F500.\n", "G01 ,A30. ,R{size}.\nX{end} Y0. ,A-30. ,R1.\n"),
        "fanuc-lathe": ("G00 X0. Z0.\nG01 F500.\n", "G01 ,A30. ,R{size}.\nX0. Z{end} ,A-30. ,R1.\n"),
    }
    head, pair = heads[code]
    sizes = [20 if each == count // 2 else 1 for each in range(count)]
    texts = [pair.format(size=size, end=f"{17.3205 * place:.4f}") for place, size in enumerate(sizes, 1)]
    return head + "".join(texts) + f"{'Z' if code == 'fanuc-lathe' else 'X'}{17.3205 * count + 30:.4f}\n"


ROWS = {
    "fanuc-mill": ("G17 G90 G00 X0. Y0.\nG01 F500.\n", "X{at}. ,R0.001\n"),
    "fanuc-lathe": ("G00 X40. Z0.\nG01 F500.\n", "Z-{at}. ,R0.001\n"),
    "siemens-840d": ("G17 G90 G0 X0 Y0\nG1 F500\n", "X{at} RND=0.001\n"),
    "heidenhain": ("L X+0 Y+0 R0 F500\n", "L X+{at}\nRND R0.001\n"),
    "nct-99m": ("G17 G90 G00 X0. Y0.\nG41 D1 G01 F500.\n", "X{at}. ,R0.001\n"),
}
"""Lines that go on straight ahead, each with a corner behind it that is none."""


def straight(count: int, control: str) -> str:
    head, line = ROWS[control]
    lines = [line.format(at=at) for at in range(1, count + 2)]
    return head + "".join(lines)[: -len(lines[-1])] + re.split(r" ,R| RND|\nRND", lines[-1])[0] + "\n"


def increments(count: int, code: str) -> str:
    """Angle pairs in increments, each of which the control refuses, and one corner that is too large."""
    heads = {
        "nct-99m": ("G17 G90 G00 X0. Y0.\nG91 G01 F500.\n", "G01 ,A30. ,R{size}.\nX17.3205 Y0. ,A-30. ,R1.\n"),
        "fanuc-lathe": ("G00 X0. Z0.\nG01 F500.\n", "G01 ,A30. ,R{size}.\nU0. W17.3205 ,A-30. ,R1.\n"),
    }
    head, pair = heads[code]
    return head + "".join(pair.format(size=20 if each == count // 2 else 1) for each in range(count))


def lacking(count: int) -> str:
    """Every second line lacks its length: each word that could be added was held against all."""
    return "L X+0 Y+0 R0 F500\n" + "".join(f"FL AN{30 * (-1) ** at:+d}{' LEN20' * (at % 2)}\n" for at in range(count))


CHAINS = {
    "FK, a word twice": ("heidenhain", lambda size: klartext(size, "twice"), "heidenhain-repeated", 16),
    "FK, a word that disagrees": ("heidenhain", lambda size: klartext(size, "disagrees"), "words-conflict", 16),
    "FK, a word missing": ("heidenhain", lambda size: klartext(size, "missing"), "words-missing", 16),
    "FK, many words missing": ("heidenhain", lacking, "words-missing", 10),
    "NCT, an angle reversed": ("nct-99m", lambda size: angles(size, "reversed"), "nct-reversed", 16),
    "NCT, a corner too large": ("nct-99m", lambda size: angles(size, "large"), "nct-corner-too-large", 16),
    "NCT, an angle twice": ("nct-99m", lambda size: angles(size, "twice"), "address-repeated", 16),
    "no corner on a line": ("siemens-840d", lambda size: corners(size, "siemens-840d", 0.0), "siemens-corner", 48),
    "corners": ("nct-99m", lambda size: corners(size, "nct-99m"), "", 16),
    **{
        f"{control}, pairs": (
            control,
            lambda size, control=control: pairs(size, control),
            f"{name}-corner-too-large",
            4,
        )
        for control, name in (("nct-99m", "nct"), ("siemens-840d", "siemens"))
    },
    **{
        f"{control}, increments": (control, lambda size, control=control: increments(size, control), "", 12)
        for control in ("nct-99m", "fanuc-lathe")
    },
    **{
        f"{control}, straight": (control, lambda size, control=control: straight(size, control), "", 12)
        for control in ROWS
    },
}
"""Controls, chains of so many elements, what is told first, and how many elements the short one has."""


@pytest.mark.slow
@pytest.mark.parametrize("name", CHAINS)
def test_a_chain_four_times_as_long_takes_about_four_times_the_work(name):
    control, chain, code, size = CHAINS[name]
    found = check(chain(8), control=control)
    assert not code or found[0].code.startswith(code)
    short, long = (calls(partial(check, chain(each), control=control)) for each in (size, 4 * size))
    assert long <= (1.5 if "increments" in name else 1.3) * 4 * short


@pytest.mark.parametrize("is_ahead", [True, False])
def test_a_slip_costs_as_much_beside_many_contours_as_beside_few(is_ahead):
    """What an edit cannot change is not examined again, and blocks far away are not looked at."""
    start, taper = "G00 X40. Z0.\n", "G111 X100. A180. K-30. B120.{more}\n"

    def steps(count: int) -> int:
        others = (start + taper.format(more="")) * count
        texts = [start + taper.format(more=more) for more in (" P90.", " P9.")]
        wrong, right = (others + text if is_ahead else text + others for text in texts)
        assert [each.code for each in check(wrong)] == ["g111-corner-too-large"]
        return calls(lambda: check(wrong)) - calls(lambda: check(right))

    steps(4)
    few, many = steps(12), steps(48)
    assert many <= 1.1 * few


LOOPS = {
    "WHILE": ("WHILE R{n}<R{m}\n", "R{n}=R{n}+1\nENDWHILE\n"),
    "FOR": ("FOR R{n}=1 TO R{m}\n", "ENDFOR\n"),
    "REPEAT": ("REPEAT\n", "UNTIL R{n}>R{m}\n"),
    "LOOP": ("LOOP\nIF R{n}>R{m} GOTOF OUT{n}\n", "ENDLOOP\nOUT{n}:\n"),
    "GOTOB": ("BACK{n}:\n", "IF R{n}<R{m} GOTOB BACK{n}\n"),
}
"""What begins a loop of which nobody knows how often it runs, and what ends it."""


@pytest.mark.slow
@pytest.mark.parametrize("kind", LOOPS)
def test_loops_in_one_another_end_as_soon_as_nothing_new_follows(kind):
    """Each ran four times in each pass of the one around it; with long ones in them, they were followed no further."""
    head, tail = LOOPS[kind]
    corners = "".join(f"G1 X{20 * at} RND=1\nY{10 * (at % 2)} RND=1\n" for at in range(1, 9)) + "X0\nY0\n"

    def steps(depth: int) -> int:
        numbers = range(1, depth + 1)
        text = "G17 G90 G0 X0 Y0\nG1 F500\n"
        text += "".join(head.format(n=n, m=20 + n) + "X5 RND=1\nY5\nX0\nY0\n" for n in numbers) + corners
        text += "".join("X7 RND=1\nY7\nX0\nY0\n" + tail.format(n=n, m=20 + n) for n in reversed(numbers))
        told = []
        made = calls(lambda: told.extend(check(text + "X50 RND=1\nY60\nM30\n", control="siemens-840d")))
        assert told == []
        return made

    steps(1)
    few, many = steps(2), steps(5)
    # Where a pass ends elsewhere than it began, the loops in it are followed anew.
    assert many <= 1.2 * 2**3 * few
