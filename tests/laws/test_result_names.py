"""Laws of the names of results and of words: what is listed can be asked for everywhere, with one number; however it is
spelled, the answer is the same; X counts as the block counts it; what is no name is refused with those that are."""

import numpy
import pytest

import contoursolve
from contoursolve.families import FamilyError, family, feasible, find, sensitivity, tolerance_for, tolerances

TAPER = ("G111 X100. A180. K-30. B120. P5. Q5.", "B", {"start": "X40. Z0."})
BLOCKS = {
    "a lathe": TAPER,
    "inches": ("G111 X4. A175. K-1.2 B120. P.2 Q.2", "B", {"start": "X1.6 Z0.", "units": "inch"}),
    "a chain of a lathe": ("G01 Z-30. ,R5.\nX60. ,A150.\nZ-80.", ",A", {"start": "X40. Z0.", "control": "fanuc-lathe"}),
    "a mill": ("G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1", ",A", {}),
    "arcs": ("G17 G41 D0 G0 X-30 Y60\nG1 ,A180 ,R3\nG3 X-85 Y50 I-60 J50 R25 Q-1\nG1 X-75 Y0 ,A-90 Q1", "2:,A", {}),
}


def solved(name):
    """A family with the block's own value of its word, in its first row, and the answer of a single solve."""
    block, word, options = BLOCKS[name]
    answer = contoursolve.solve(block, **options).answers[0]
    stated = feasible(block, word, **options).stated
    return family(block, vary={word: [stated, stated + STEP]}, **options), answer


def spellings(name, axes):
    """The other ways to write a result."""
    point, _, axis = name.rpartition(" ")
    if axis in axes:
        element, dot, part = point.rpartition(".")
        of = f"{part} of {element}" if dot else point
        yield from (f"{point}.{axis}", f"{axis} of {of}", f"  {point}   {axis} ", f"{axis.lower()} OF  {of.upper()}")
    yield from (name.upper(), name.lower())


@pytest.mark.parametrize("name", BLOCKS)
def test_a_result_that_is_listed_has_one_number_wherever_it_is_asked_for(name):
    """Family, derivatives, kept results, goals, points and facts agree, and with the points of the contour."""
    found, answer = solved(name)
    block, word, options = BLOCKS[name]
    axes, in_mm, names = answer.plane.axes, float(answer.unit.in_mm), found.results
    slopes = sensitivity(block, **options).slopes
    # Each of the slow questions is asked of a part of the results.
    kept = names[:: len(names) // 4]
    wanted = [each for each in names if each[-1] in axes][1::5]
    for result in names:
        own = found.result(result)
        for spelled in spellings(result, axes):
            assert numpy.array_equal(found.result(spelled), own), spelled
        assert numpy.array_equal(found[result], own)
        if result in slopes:
            (rate,) = (slopes[result][each] for each in found.ranges.values)
            assert (own[1] - own[0]) / STEP == pytest.approx(rate, rel=0.02, abs=1e-3), result
        if result in kept:
            most = abs(own[1] - own[0]) / in_mm + 1e-7
            room = tolerance_for(block, word, keep=result, within=most, **options)
            assert (room.kept, room.plus >= STEP - 1e-9) == (result, True)
        if result in wanted:
            goal = f"{result}{float(own[1]) / in_mm!r}"
            assert is_found(find(block, word, goal, **options), room.stated + STEP, own), result
        point, _, axis = result.rpartition(" ")
        if axis in axes:
            factor = 1 + answer.plane.diameters[axes.index(axis)]
            at = (
                tolerances(block, point=point, **options).place[axes.index(axis)]
                if result in wanted
                else own[0] / factor
            )
            asked = contoursolve.solve(block, facts=[f"{result} = ?"], depth="verdict", **options).answer.asked[0]
            assert [at * factor, asked.value * factor] == pytest.approx([own[0], own[0]], abs=1e-6), result


STEP = 0.01


def is_found(found, value, moved):
    """Whether a value meets a goal, or the word does not move the point to it."""
    return abs(moved[1] - moved[0]) < 1e-5 or any(abs(hit.value - value) < 1e-5 for hit in found.hits)


def test_however_a_result_is_spelled_its_answer_and_its_proof_are_the_same():
    block, word, options = TAPER
    for result, others in {
        "end Z": ("end.Z", "Z of end", "END z"),
        "corner 2.end X": ("X of end of corner 2", "corner 2.end.x"),
        "corner 1.center Z": ("Z of centre of corner 1", "Z of center of corner 1"),
        "straight part of line 2": ("line 2.room", "Straight  part of LINE 2"),
    }.items():
        own = tolerance_for(block, word, keep=result, within=0.01, **options)
        assert own.kept == result
        for each in others:
            other = tolerance_for(block, word, keep=each, within=0.01, **options)
            assert (other.kept, other.low, other.high, other.doubts) == (result, own.low, own.high, own.doubts)
    for own, others in {"B": ("b", " 1:B", "01:b"), "start X": ("start.X", "START x", " Start.x")}.items():
        one = feasible(block, own, **options)
        for each in others:
            other = feasible(block, each, **options)
            assert (other.word, other.intervals, other.doubts) == (own, one.intervals, one.doubts)
    # A fact is a word by what it gives the value of, as it is written there.
    stated = {"facts": ["Z of end of corner 2 = -50.2"], "start": "X40. Z0."}
    rows = [
        family("G111 X100. A180. K-30. P5. Q5.", vary={each: [-52.0, -51.0]}, **stated)
        for each in ("Z of end of corner 2", "corner 2.end z", "z OF end  of corner 2")
    ]
    assert {each.names[0] for each in rows} == {"Z of end of corner 2"}
    assert all(numpy.array_equal(each["end Z"], [-52.0, -51.0]) for each in rows)


LISTED = "the results are end Z, end X, V1 Z, V1 X"
POINTS = "there are end, V1, V2, corner 1.begin"
WRONG = {
    "endZ": (LISTED, POINTS),
    "end Z X": ("found `X`", "found `X`"),
    "end Y": ("the axes of this contour are Z and X", "the axes of this contour are Z and X"),
    "V9 Z": ("did you mean V2 Z or V1 Z?", POINTS),
    "line 1.end Z": ("write corner 1.begin for where it ends, or V1 for its virtual end",) * 2,
    "Z of end of line 1": ("write corner 1.begin for where it ends, or V1 for its virtual end",) * 2,
    "length of line 9": ("found `line 9`", "found `line 9`"),
    "": (LISTED, POINTS),
}


@pytest.mark.parametrize("wrong", WRONG)
def test_what_is_no_result_is_refused_with_those_that_are(wrong):
    block, word, options = TAPER
    found, _ = solved("a lathe")
    told, at_point = WRONG[wrong]
    asked = {
        found.result: told,
        lambda name: tolerance_for(block, word, keep=name, within=1, **options): told,
        lambda name: tolerances(block, point=name, **options): at_point,
        lambda name: find(block, word, f"{name} Z-50.", **options): at_point if wrong else "no goal",
    }
    for ask, message in asked.items():
        with pytest.raises(FamilyError) as caught:
            ask(wrong)
        assert message in str(caught.value)
    for ask in (found.__getitem__, sensitivity(block, **options).slopes.__getitem__):
        with pytest.raises(KeyError) as missing:
            ask(wrong)
        assert told in str(missing.value)
    with pytest.raises(FamilyError, match="V2 is a point; name one coordinate of it: V2 Z or V2 X"):
        found.result("V2")


def test_what_is_no_word_is_refused_with_those_that_are():
    block, _, options = TAPER
    for wrong, message in {
        "W": "the block has no word W; its words are X, A, K, B, P, Q",
        "N20:X": "N names a block, LINE is the line of the program",
        "2:A": "the block has no word A in program line 2",
        "length of line 1": "no fact says what length of line 1 is; there are none",
    }.items():
        with pytest.raises(FamilyError) as caught:
            feasible(block, wrong, **options)
        assert message in str(caught.value)
    for ask in (
        lambda: feasible(block, ("A",), **options),
        lambda: find(block, "A", ("end", -50), **options),
        lambda: tolerance_for(block, "A", keep=("end", "Z"), within=1, **options),
        lambda: tolerances(block, point=2, **options),
        lambda: family(block, vary={1: [2]}, **options),
    ):
        with pytest.raises(TypeError, match=r"named by a text \(str\), such as"):
            ask()
