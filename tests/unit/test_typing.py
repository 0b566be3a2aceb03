"""The first fix is what was meant: typing slips in sound blocks, and blocks that machinists have shown us."""

from collections.abc import Iterator
from random import Random

import pytest
from generate_typing import FORMS, Slip, Sound, random_slip, random_sound

from contoursolve import solve
from contoursolve.diagnostics.finding import Fix
from contoursolve.program.pipeline import Result
from contoursolve.solving.contour import Contour

LATHE = "G00 X40. Z0.\n"
CIRCLE_LINE = "G17 G0 X90 Y0 M3 S200\nG42 G1 X50 D0\nG3 X-50 Y0 {}\nG1 X-50 Y42.857 ,A171.87 Q-1\nG40 G0 Y70"
LINE_CIRCLE = "G17 G42 G0 X100 Y20 D0 S200 M3\nG1 X-30 Y-20\nG3 X20 Y40 I20 J-10 {} Q-1\nG40 G0 Y60"


def fixes_of(result: Result) -> list[Fix]:
    return [fix for finding in result.diagnostics for fix in finding.fixes]


# Blocks of which it is known what was meant ----------------------------------------------------------------

MEANT = {
    LATHE + "G111 X100. A180. K30. B120.": "G111 X100. A180. K-30. B120.",
    LATHE + "G111 A180. K-30. B120. W47.32": "G111 A180. K-30. B120. W-47.32",
    LATHE + "G111 A180. K-30. B120. Z47.32": "G111 A180. K-30. B120. Z-47.32",
    LATHE + "G111 A180. K-30. B120. Z-47": "G111 A180. K-30. B120. Z-47.",
    LATHE + "G111 A180. K-30. B120. X30.": "G111 A180. K-30. B-120. X30.",
    LATHE + "G111 X100. A180. K-30. B120. P2": "G111 X100. A180. K-30. B120. P2.",
    LATHE + "G111 X100. A180. K-30. B120. R5.": "G111 X100. A180. K-30. B120. P5.",
    LATHE + "G111 X100. A180. K-30. B120. P2. R5.": "G111 X100. A180. K-30. B120. P2. Q5.",
    LATHE + "G111 X100. A180. K-30. B120. P2. P5.": "G111 X100. A180. K-30. B120. P2. Q5.",
    LATHE + "G112 X100. A180. K-30. B120.": "G111 X100. A180. K-30. B120.",
    LATHE + "G110 X100. A180. K-30. B120.": "G111 X100. A180. K-30. B120.",
    LATHE + "G1111 X100. A180. K-30. B120.": "G111 X100. A180. K-30. B120.",
    CIRCLE_LINE.format("I-45 J0"): CIRCLE_LINE.format("I-50 J0"),
    CIRCLE_LINE.format("R55"): CIRCLE_LINE.format("R50"),
    LINE_CIRCLE.format("R55"): LINE_CIRCLE.format("R50"),
}


@pytest.mark.parametrize("text", MEANT)
def test_the_first_fix_is_what_a_colleague_would_name(text):
    control = "nct-99m" if "G17" in text else "yasnac-lx3"
    first = fixes_of(solve(text, control=control))[0]
    assert first.replacement in MEANT[text]


# Slips in random blocks ------------------------------------------------------------------------------------


def sound_ones(rng: Random) -> Iterator[tuple[Sound, Contour]]:
    """Random contours of every form in turn that have no finding, and their paths."""
    while True:
        for form in FORMS:
            while True:
                sound = random_sound(rng, form)
                result = solve(sound.text(), control=sound.control, depth="verdict")
                if not result.diagnostics and len(result.answers) == 1 and result.answers[0].contour:
                    break
            yield sound, result.answers[0].contour


def is_alike(contour: Contour | None, other: Contour) -> bool:
    return contour is not None and contour.is_alike(other) and contour.deviation(other) <= 0.002


def place_of(slip: Slip, contour: Contour, result: Result) -> int | None:
    """The place of what was meant among the fixes for the contour, or else the line, in which the slip is: the block
    itself, or one of the same path."""
    line = slip.line + 2
    answer = next((each for each in result.answers if line in each.lines), None)
    lines = answer.lines if answer else (line,)
    found = [fix for each in result.diagnostics if each.span.line in lines for fix in each.fixes]
    for place, fix in enumerate(found):
        if fix.replacement in slip.sound.text():
            return place
        if "?" not in fix.replacement:
            blocks = slip.text.split("\n")
            blocks[lines[0] - 1 : lines[-1]] = fix.replacement.split("\n")
            (other, *more) = solve("\n".join(blocks), control=slip.sound.control, depth="verdict").answers or (None,)
            if other is not None and not more and is_alike(other.contour, contour):
                return place
    return None


def places(seed: int, count: int) -> tuple[list[int | None], int]:
    """Of so many random slips that are found, at which place among the fixes each is what was meant; and how many more
    made another sound contour, in which nothing is wrong for any reader: no error, no point that lacks, no warning but
    that it crosses the spindle axis, which may be meant."""
    rng, found, sound_again = Random(seed), list[int | None](), 0
    for sound, contour in sound_ones(rng):
        slip = random_slip(sound, rng)
        if slip is None:
            continue
        result = solve(slip.text, control=sound.control)
        lacks = {each.code for each in result.diagnostics} - {"nct-radius-differs", "axis-crossed", "suspected"}
        path = result.answers[0].contour if len(result.answers) == 1 else None
        if path is not None and (not lacks or is_alike(path, contour)):
            sound_again += 1
            continue
        found.append(place_of(slip, contour, result))
        if len(found) == count:
            return found, sound_again
    raise AssertionError


@pytest.mark.slow
def test_of_random_slips_95_percent_have_what_was_meant_as_first_fix_and_99_among_three():
    """Of fewer than 100, one may be missed."""
    found, sound_again = places(16, 60)
    first, three = (sum(place is not None and place < most for place in found) for most in (1, 3))
    assert first >= 0.95 * len(found), (first, three, len(found))
    assert three >= len(found) - 1, (first, three, len(found))
    assert sound_again > len(found) / 8
