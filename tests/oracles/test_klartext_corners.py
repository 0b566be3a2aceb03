"""Corners between plain moves in Klartext: RND and CHF make what `,R` and `,C` make of the same moves."""

from math import cos, hypot, pi, sin
from random import Random

import pytest

import contoursolve
from contoursolve import ArcSegment
from contoursolve.comparison import Document, ReceiptVerdict, verify
from contoursolve.families import family
from contoursolve.output.document import to_json
from contoursolve.solving import STATUSES

BEGIN, END = "0 BEGIN PGM A MM\n", "99 END PGM A MM\n"


def klartext(*blocks, before="L X+0 Y+0 R0 F500"):
    numbered = "".join(f"{number} {block}\n" for number, block in enumerate((before, *blocks), 1))
    return BEGIN + numbered + END


def drawn(rng):
    """A chain of moves with corners in Klartext, and the same for a Fanuc mill."""
    at, own, other = (0.0, 0.0), [], []
    count = rng.randint(2, 5)
    for number in range(count):
        way, length = rng.uniform(0, 2 * pi), rng.uniform(8, 60)
        end = (round(at[0] + length * cos(way), 3), round(at[1] + length * sin(way), 3))
        first, second = f"{end[0]:+.3f}", f"{end[1]:+.3f}"
        size, kind = round(rng.uniform(0.5, 7), 3), rng.choice("RC")
        form, chord = rng.choice(["L", "L", "CR", "C"]), hypot(end[0] - at[0], end[1] - at[1])
        sense, code = rng.choice([("DR-", "G2"), ("DR+", "G3")])
        corner = f" ,{kind}{size}" if number < count - 1 else ""
        if form == "L":
            own.append(f"L X{first} Y{second}")
            other.append(f"G1 X{first} Y{second}{corner}")
        elif form == "CR":
            radius = f"{rng.choice('+-')}{chord * rng.uniform(0.55, 1.5):.3f}"
            own.append(f"CR X{first} Y{second} R{radius} {sense}")
            other.append(f"{code} X{first} Y{second} R{radius}{corner}")
        else:
            height = rng.uniform(-1, 1) * chord
            center = [
                (at[0] + end[0]) / 2 - height * (end[1] - at[1]) / chord,
                (at[1] + end[1]) / 2 + height * (end[0] - at[0]) / chord,
            ]
            own += [f"CC X{center[0]:+.6f} Y{center[1]:+.6f}", f"C X{first} Y{second} {sense}"]
            other.append(f"{code} X{first} Y{second} I{center[0] - at[0]:.6f} J{center[1] - at[1]:.6f}{corner}")
        if corner:
            own.append(f"RND R{size}" if kind == "R" else f"CHF {size}")
        at = end
    return klartext(*own), "G90 G17 G0 X0 Y0\n" + "\n".join(other) + "\nM30\n"


def path(answer):
    """The elements, each with its end, and of an arc its centre; None without a contour."""
    if answer.contour is None:
        return None
    return [
        (*each.end, *((*each.center, each.turn.sign) if isinstance(each, ArcSegment) else ()))
        for each in answer.contour.elements
    ]


@pytest.mark.parametrize("seed", range(48))
def test_corners_between_plain_moves_are_those_of_other_controls(seed):
    own, other = drawn(Random(seed))
    ours, theirs = (
        contoursolve.solve(text, control=control, depth="verdict")
        for text, control in ((own, "heidenhain"), (other, "fanuc-mill"))
    )
    if any(each.code == "fanuc-corner-dropped" for each in theirs.diagnostics):
        # It makes no corner where the direction hardly changes.
        return
    one, two = (path(each.answers[0]) for each in (ours, theirs))
    assert (one is None) is (two is None)
    for mine, yours in zip(one or (), two or (), strict=True):
        assert mine == pytest.approx(yours, abs=1e-5)
    assert theirs.has_errors is ours.has_errors


# Full circles -----------------------------------------------------------------------------------------------------

FULL_CIRCLES = ("C X{x} Y{y} DR{s}", "C IX+0 IY+0 DR{s}", "C DR{s}", "CP IPA{s}360 DR{s}", "CP PA{a} DR{s}")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_a_full_circle_between_corners_is_what_the_corners_leave_of_it(seed):
    """Each corner is that beside half of the circle."""
    rng = Random(seed)
    first, second, radius, angle = (
        round(rng.uniform(*each), 3) for each in ((-80, 80), (-80, 80), (5, 60), (-180, 180))
    )
    spoke = radius * complex(cos(angle * pi / 180), sin(angle * pi / 180))
    at, beyond = (f"X{first + each.real:+.9f} Y{second + each.imag:+.9f}" for each in (spoke, -spoke))
    sense, side = rng.choice("+-"), rng.choice([1, -1])
    sizes = [rng.choice([0, 0.5, 1.5]) for _ in "12"]
    corners = [f"RND R{size}" if rng.random() < 0.7 else f"CHF {size}" for size in sizes]
    # Both lines lie without the circle, or within it.
    start, end = (
        f"L X{first + each.real:+.3f} Y{second + each.imag:+.3f}"
        for each in (spoke + spoke / radius * complex(12 * side, rng.uniform(1, 4) * way) for way in (1, -1))
    )

    def elements(before, *blocks):
        result = contoursolve.solve(klartext(before, *blocks, before=f"CC X{first} Y{second}"), depth="verdict")
        assert {each.code for each in result.diagnostics} <= {"heidenhain-chamfer-beside-arc"}
        (answer,) = result.answers
        return answer.contour.elements

    form = FULL_CIRCLES[seed % len(FULL_CIRCLES)].format(
        x=at.split()[0][1:], y=at.split()[1][1:], a=f"{angle:+}", s=sense
    )
    whole = elements(start, f"L {at}", corners[0], form, corners[1], end)
    one = elements(start, f"L {at}", corners[0], f"C {beyond} DR{sense}")
    other = elements(f"L {beyond}", f"C {at} DR{sense}", corners[1], end)
    meant = [*one[:-1], *other[1:]]
    (circle,) = [each for each in whole if each.name == whole[len(one) - 1].name]
    assert len(whole) == len(meant) + 1
    for mine, yours in zip([each for each in whole if each is not circle], meant, strict=True):
        assert (*mine.start, *mine.end) == pytest.approx((*yours.start, *yours.end), abs=1e-6)
    assert circle.sweep == pytest.approx(one[-1].sweep + other[0].sweep, abs=1e-5)
    assert circle.turn.sign == int(f"{sense}1")


def test_a_full_circle_rests_on_an_assumption_and_is_verified():
    text = klartext(
        "L X+80 Y+50", "RND R0", "CC X+50 Y+50", "C X+80 Y+50 DR-", "RND R0", "L X+90 Y+60", before="L X+90 Y+40"
    )
    result = contoursolve.solve(text)
    assert [each.name for each in result.answers[0].assumptions] == ["full-circle"]
    assert [each.sweep for each in result.answers[0].contour.elements if isinstance(each, ArcSegment)] == [360]
    half = contoursolve.solve(text.replace("C X+80", "C X+20"))
    assert [each.name for each in half.answers[0].assumptions] == []
    documents = Document("program", text.encode()), Document("result", to_json(result).encode())
    assert verify(*documents).verdict is ReceiptVerdict.VERIFIED


PATHS = {
    "as a mill": (["L X+40 Y+0 RL", "RND R20", "L X+40 Y+20"], [(20, 0), (40, 20, 20, 20, 1)]),
    "its own feed": (["L X+40 Y+0", "RND R5 F100", "L X+40 Y+30"], [(35, 0), (40, 5, 35, 5, 1), (40, 30)]),
    "words between": (["L X+40", "M8", "RND R5", "* - PART", "M9", "L Y+30"], [(35, 0), (40, 5, 35, 5, 1), (40, 30)]),
    "chamfer": (["L X+40 Y+0", "CHF 5", "L IY+30", "L X+0"], [(35, 0), (40, 5), (40, 30)]),
    "behind a tangent arc": (
        ["L X+40", "CT X+60 Y+20", "RND R5", "L X+80 Y+20"],
        # The rounding touches the circle about (40, 20) from outside: 5 below the line, 25 from that centre.
        [(40, 0), (40 + 0.8 * 600**0.5, 16, 40, 20, 1), (40 + 600**0.5, 20, 40 + 600**0.5, 15, -1), (80, 20)],
    ),
    "parameter": (["Q1 = 2 + 3", "L X+40 Y+0 FQ1", "RND RQ1", "L X+40 Y+30"], [(35, 0), (40, 5, 35, 5, 1), (40, 30)]),
    "an element of no corner before": (
        ["L X+40 Y+0", "L X+40 Y+30", "RND R5", "L X+0"],
        [(40, 25), (35, 30, 35, 25, 1), (0, 30)],
    ),
}


@pytest.mark.parametrize(("blocks", "drawn"), PATHS.values(), ids=PATHS)
def test_a_corner_between_plain_moves_is_made(blocks, drawn):
    (answer,) = contoursolve.solve(klartext(*blocks), depth="verdict").answers
    for found, meant in zip(path(answer), drawn, strict=True):
        assert found == pytest.approx(meant, abs=1e-9)


WRONG = {
    "too large": (["L X+6 Y+0", "RND R12", "L X+6 Y+7"], "corner-too-large"),
    "first": (["DEP LT LEN5", "RND R5", "L X+40 Y+30"], "heidenhain-corner-first"),
    "last": (["L X+40 Y+0", "CHF 5"], "heidenhain-corner-without-next"),
    "before the end": (["L X+40 Y+0", "RND R5", "M30"], "heidenhain-corner-without-next"),
    "behind a free element": (["FL X+40 Y+0", "RND R5", "M30"], "heidenhain-corner-without-next"),
    "reversal": (["L X+40 Y+0", "CHF 5", "L X+10"], "corner-reverses"),
    "straight on": (["L X+40 Y+0", "RND R5", "L X+60"], "corner-straight"),
    "two shapes": (["L X+40 Y+0", "RND R5", "CHF 3", "L X+40 Y+30"], "corner-twice"),
    "twice": (["L X+40 Y+0", "RND R5", "RND R3", "L X+40 Y+30"], "heidenhain-repeated"),
    "no size": (["L X+40 Y+0", "RND", "L X+40 Y+30"], "heidenhain-no-word"),
    "negative, before a departure": (["L X+40 Y+0", "RND R-5", "DEP LT LEN5"], "heidenhain-corner-size"),
    "negative": (["L X+40 Y+0", "RND R-5", "L X+40 Y+30"], "corner-negative"),
    "out of the plane": (["L X+40 Y+0", "RND R5", "L X+40 Y+30 Z-5"], "heidenhain-corner-outside-plane"),
    "no CC": (["L X+40 Y+0", "RND R5", "C X+60 Y+20 DR+"], "heidenhain-centre-missing"),
    "no R": (["L X+40 Y+0", "RND R5", "CR X+60 Y+20 DR+"], "heidenhain-radius-missing"),
    "no DR": (["L X+40 Y+0", "RND R5", "CR X+60 Y+20 R20"], "heidenhain-arc-sense"),
}


@pytest.mark.parametrize(("blocks", "code"), WRONG.values(), ids=WRONG)
def test_a_corner_between_plain_moves_that_cannot_be_made_is_told(blocks, code):
    result = contoursolve.solve(klartext(*blocks))
    assert code in [each.code for each in result.diagnostics if each.is_error]
    assert not any(each.contour for each in result.answers)


# Behind each corner that stands apart a corner is solved: its first line begins where the one before is stated to end.
_BEHIND, _END = ["L X+80 Y+30", "RND R5", "L X+80 Y+60"], [(75, 30), (80, 35, 75, 35, 1), (80, 60)]
APART = {
    "behind an approach": (["APPR LT X+40 Y+30 LEN5 RL", "RND R5", *_BEHIND], 1, [_END]),
    "before a departure": (["L X+40 Y+0", "RND R5", "DEP LT LEN5", "L X+40 Y+30", *_BEHIND], 1, [_END]),
    "two, one of them apart": (
        ["L X+40 Y+0", "RND R5", "L X+40 Y+30", "CHF 2", "DEP LT LEN5"],
        1,
        [[(35, 0), (40, 5, 35, 5, 1), (40, 30)]],
    ),
    "free": (["FL AN+0", "FL X+40 Y+30 AN+90", "RND R5", "DEP LN LEN5"], 1, [[(40, 0), (40, 30)]]),
    "before a call": (
        ["L X+40 Y+0", "RND R5", "CALL LBL 1", *_BEHIND, "M30", "LBL 1", "L X+40 Y+30", "LBL 0"],
        1,
        [_END],
    ),
    "behind a call": (["CALL LBL 1", "RND R5", *_BEHIND, "M30", "LBL 1", "L X+40 Y+30", "LBL 0"], 1, [_END]),
    "first of a call": (["L X+40 Y+30", "CALL LBL 1", "M30", "LBL 1", "RND R5", *_BEHIND, "LBL 0"], 1, [_END]),
    "last of a call": (["CALL LBL 1", *_BEHIND, "M30", "LBL 1", "L X+40 Y+30", "RND R5", "LBL 0"], 1, [_END]),
    "a parameter that is not known": (["L X+40 Y+0", "RND RQ5", "DEP LT LEN5", "L X+40 Y+30", *_BEHIND], 1, [_END]),
    "a program that is not there": (["RND R5", "CALL PGM AWAY.H", "RND R4", "L X+40 Y+30", *_BEHIND], 2, [_END]),
}


@pytest.mark.parametrize(("blocks", "count", "drawn"), APART.values(), ids=APART)
def test_a_corner_beside_a_call_or_an_approach_is_told_and_stays(blocks, count, drawn):
    text = klartext(*blocks)
    result = contoursolve.solve(text)
    assert not result.has_errors
    assert [each.code for each in result.diagnostics].count("heidenhain-corner-apart") == count
    assert [path(each) for each in result.answers] == [[pytest.approx(each) for each in one] for one in drawn]
    written = contoursolve.expand(text).text
    kept = [line.split(maxsplit=1)[1] for line in written.splitlines() if not line.startswith(";") and " " in line]
    assert sum(each.startswith(("RND", "CHF")) for each in kept) == count


def test_a_corner_in_lines_that_are_repeated_is_in_one_contour():
    found = contoursolve.solve(
        klartext("L X+40 Y+0", "LBL 1", "RND R5", "L IY+30", "RND R5", "L IX+30", "CALL LBL 1 REP 2", "L X+0 Y+80")
    )
    assert not found.diagnostics
    assert [path(each)[-1] for each in found.answers] == [(130, 90)]


def test_a_corner_behind_a_move_from_an_unknown_place_asks_for_it():
    found = contoursolve.solve(klartext("RND R5", "L X+40 Y+30", before="L X+40 Y+0"))
    assert [each.code for each in found.diagnostics] == ["position-unknown"]


def test_a_fix_leaves_no_block_with_its_number_alone():
    found = contoursolve.solve(klartext("L X+6 Y+0", "RND R12", "L X+6 Y+7")).diagnostics
    first, *others = (fix.replacement for each in found for fix in each.fixes)
    assert first == "2 L X+6 Y+0\n3 RND R6\n4 L X+6 Y+7"
    assert "2 L X+6 Y+0\n4 L X+6 Y+7" in others


def test_an_arc_beside_a_chamfer_is_told():
    found = contoursolve.solve(klartext("L X+40 Y+0", "CHF 5", "CR X+60 Y+20 R20 DR-"))
    assert [each.code for each in found.diagnostics] == ["heidenhain-chamfer-beside-arc"]
    assert found.answers[0].contour is not None


def test_a_row_of_a_family_is_the_contour_of_its_blocks():
    blocks, sizes, ends = ["L X+40 Y+0", "RND R5", "CR X+60 Y+20 R20 DR-"], (2, 4, 40), (35, 40, 45)
    vary = {"ROUNDING": sizes, "1:X": ends}
    found = family("\n".join(blocks), control="heidenhain", start="X0 Y0", vary=vary, paired=True)
    for row, (size, end) in enumerate(zip(sizes, ends, strict=True)):
        (alone,) = contoursolve.solve(klartext(f"L X+{end} Y+0", f"RND R{size}", blocks[2])).answers
        assert STATUSES[int(found["status"][row])] is alone.status
        if alone.contour is not None:
            _, corner, _ = alone.contour.elements
            at = tuple(found[f"corner 1.center.{axis}"][row] for axis in "XY")
            assert at == pytest.approx(corner.center, abs=1e-9)


# Roundings that nearly touch ------------------------------------------------------------------------------------


def beside(at, way, radius, sense, swept):
    """The centre of an arc that passes a point in a direction, and where it is after turning by so much."""
    center = (at[0] - sense * radius * sin(way), at[1] + sense * radius * cos(way))
    spoke = complex(at[0] - center[0], at[1] - center[1]) * complex(cos(sense * swept), sin(sense * swept))
    return center, (center[0] + spoke.real, center[1] + spoke.imag)


def nearly_tangent(rng):
    """A rounding of nearly the radius of an arc beside it, or where the direction hardly changes or nearly reverses."""
    way, size, at = rng.uniform(0, 2 * pi), 10 ** rng.uniform(-1, 2), (rng.uniform(-99, 99), rng.uniform(-99, 99))
    turn = rng.choice([1, -1]) * rng.choice([10 ** rng.uniform(-5, 0.3), pi - 10 ** rng.uniform(-4, 0)])
    forms = rng.choice(["LA", "AL", "AA"])

    def place(point):
        return f"X{point[0]:+.9f} Y{point[1]:+.9f}"

    def element(form, way, *, is_first):
        """The far end of an element and its blocks, without that end."""
        if form == "L":
            away = -200 if is_first else 200
            return (at[0] + away * cos(way), at[1] + away * sin(way)), [], "L", ""
        near = size * (1 + rng.choice([1, -1]) * 10 ** rng.uniform(-6, 0))
        sense, swept = rng.choice([1, -1]), rng.uniform(0.3, 2.5) * (-1 if is_first else 1)
        center, far = beside(at, way, rng.choice([near, 10 ** rng.uniform(0, 3)]), sense, swept)
        return far, [f"CC {place(center)}"], "C", f" DR{'+' if sense > 0 else '-'}"

    start, centers, name, sense = element(forms[0], way, is_first=True)
    end, others, following, other = element(forms[1], way + turn, is_first=False)
    blocks = [*centers, f"{name} {place(at)}{sense}", f"RND R{size:.3f}", *others, f"{following} {place(end)}{other}"]
    return klartext(*blocks, before=f"L {place(start)}")


def off_edge(center, segment):
    """How far a point is from the line or circle of an element, mm."""
    if isinstance(segment, ArcSegment):
        return abs(hypot(center[0] - segment.center[0], center[1] - segment.center[1]) - segment.radius)
    (x, y), (a, b) = segment.start, segment.end
    return abs((a - x) * (center[1] - y) - (b - y) * (center[0] - x)) / hypot(a - x, b - y)


CLOSE = """0 BEGIN PGM A MM
1 L X38.425 Y33.485
2 L X51.129 Y57.578
3 RND R19.27
4 CC X33.757248 Y65.938874
5 C X14.758345 Y62.664175 DR+
6 END PGM A MM
"""


@pytest.mark.parametrize("text", [CLOSE, *(nearly_tangent(Random(seed)) for seed in range(60))])
def test_a_rounding_that_nearly_touches_is_solved_or_does_not_fit(text):
    result = contoursolve.solve(text, depth="verdict")
    assert "not-verified" not in [each.code for each in result.diagnostics]
    contour = result.answers[0].contour
    if text == CLOSE:
        # The ends of its arc are not equally far from the centre.
        assert contour is not None
    elif contour is not None and len(contour.elements) == 3:
        before, rounding, after = contour.elements
        for each in (before, after):
            # A line that is cut short tells its direction to few digits.
            length = (
                1 if isinstance(each, ArcSegment) else hypot(each.end[0] - each.start[0], each.end[1] - each.start[1])
            )
            off = off_edge(rounding.center, each) - rounding.radius
            assert abs(off) <= 1e-8 / min(1, length)


def test_a_size_that_is_asked_for_beside_a_full_circle_is_told_and_no_traceback():
    text = "1 L X+0 Y+0\n2 CC X+20 Y+0\n3 L X+40 Y+0\n4 RND R2\n5 CP IPA+360 DR-\n6 RND R?\n7 L X+60 Y+20"
    found = contoursolve.check(f"0 BEGIN PGM A MM\n{text}", control="heidenhain")
    (finding,) = (each for each in found if each.is_error)
    assert (finding.code, finding.span.line) == ("words-missing", 7)
    assert finding.message == "one word is missing, so the rounding RND R? (block 6) is open: give RND R? a value"
