"""ISG kernel: the worked examples of its sheet, right and wrong, how it is spelled, corners in blocks of their own."""

import pytest
from oracle import Element, elements_of

from contoursolve import check, solve

ISG = "isg"
MILL = "G17 G90 G0 X0 Y0\n"


def isg(text: str, depth: str = "full", **settings: str):
    named = {f"isg.{name.replace('_', '-')}": value for name, value in settings.items()}
    return solve(text, control=ISG, settings=named, depth=depth)


def path(text: str, **settings: str) -> list[Element]:
    """All contours, one behind the other; they have no errors."""
    result = isg(text, **settings)
    assert not result.has_errors, [each.message for each in result.diagnostics]
    assert all(answer.contour for answer in result.answers)
    return [element for answer in result.answers for element in elements_of(answer)]


def ends(text: str, **settings: str) -> list[complex]:
    return [each.end for each in path(text, **settings)]


def refused(text: str, code: str, number: str | None = None, **settings: str) -> None:
    """That the error is found first, with its ID, and no contour of its blocks called solved."""
    result = isg(text, "verdict", **settings)
    errors = [each for each in result.diagnostics if each.severity.value == "error"]
    assert [each.code for each in errors][:1] == [code], [each.message for each in errors]
    assert (errors[0].alarm.number.split()[0] if errors[0].alarm else None) == number
    line = errors[0].span.line
    assert not [each for each in result.answers if each.contour and each.lines[0] <= line <= each.lines[-1]]


def test_lines_of_a_comment_move_nothing():
    text = MILL + "#COMMENT BEGIN\nG1 X55 #ANG=100\nX90\n#COMMENT END\nG1 #ANG=45 X20"
    assert ends(text) == [pytest.approx(20 + 20j)]


def test_without_a_motion_code_g1_is_in_force_or_the_program_must_say_it():
    text = "N100 G17 X10 Y10\n#ANG=45 X20 Y25"
    refused(text, "isg-angle-redundant", "21895")
    result = isg(text, first_motion="none")
    assert not any(each.contour for each in result.answers)
    assert "no G code of a motion is in force" in result.diagnostics[0].notes[0]


# Planes, diameters and settings -------------------------------------------------------------------------------------


def test_a_line_of_its_own_is_a_ray_and_one_of_a_pair_need_not_be():
    refused(MILL + "G1 X-40 #ANG=30", "isg-line-reversed")
    pair = MILL + "G1 #ANG=210\nX60 Y20 #ANG=-45"
    assert ends(pair) == pytest.approx(ends(pair.replace("210", "30")))
    assert [(each.code, each.severity.value) for each in isg(pair).diagnostics] == [("angle-opposite", "warning")]
    refused(pair, "isg-line-reversed", pair_sense="ray")
    assert ends(pair.replace("210", "30"), pair_sense="ray") == ends(pair.replace("210", "30"))
    refused(pair.replace("210", "30").replace("-45", "135"), "isg-line-reversed", pair_sense="ray")
    (answer,) = isg(pair, pair_sense="ray").answers
    assert [each.setting.name for each in answer.claim.conventions] == ["pair-sense"]


@pytest.mark.parametrize(
    ("text", "code", "fix"),
    [
        ("G1 #ANG=30 #RND=6\nX60 Y20", "isg-closing-incomplete", "G1 #ANG=30 #RND=6\nX60 Y20 #ANG=?"),
        ("G1 #ANG=30\nX60 #ANG=-45", "isg-closing-incomplete", "G1 #ANG=30\nX60 #ANG=-45 Y?"),
        ("G1 #ANG=30\nX60 Y20 #ANG=45", "angle-opposite", "G1 #ANG=30\nX60 Y20 #ANG=-45"),
        ("G1 X40 Y20 #ANG=62", "isg-angle-redundant", "G1 X40 Y20"),
        ("G1 X30 #RND=300\nY40", "isg-corner-too-large", "G1 X30 #RND=30\nY40"),
        ("G1 X30\nG302 I300\nG1 Y40", "isg-corner-too-large", "G1 X30\nG302 I30\nG1 Y40"),
        ("G1 X30\nG302 I-3\nG1 Y40", "isg-corner-negative", "G1 X30\nG302 I3\nG1 Y40"),
        ("G1 X30 #CHR=2 #RND=3\nY40", "isg-two-corners", "G1 X30 #RND=3\nY40"),
        ("G1 X30 #RND 3\nX50", "isg-corner-straight", "G1 X30\nX50"),
        ("G1 X30 #RND=2\nG2 X40 Y10", "isg-circle-undefined", "G1 X30 #RND=2\nG2 X40 Y10 R?"),
        ("G1 #ANG=30\nX60 Y20 #ANG=-45 #RND=5\nM30", "isg-corner-without-next", "G1 #ANG=30\nX60 Y20 #ANG=-45"),
        ("G1 X-40 #ANG=30", "isg-line-reversed", "G1 X-40 #ANG=150"),
    ],
)
def test_the_first_fix_is_what_a_colleague_would_name(text, code, fix):
    found = [each for each in check(MILL + text, control=ISG) if each.fixes]
    assert found[0].code == code
    assert found[0].fixes[0].replacement == fix


# Corners in blocks of their own -------------------------------------------------------------------------------------


@pytest.mark.parametrize("code", ["G301", "G302"])
def test_a_corner_of_its_own_stands_beside_rapids_with_a_feed_and_a_word_does_not(code):
    text = f"{MILL}{{}} X30\n{code} I5 F100\n{{}} X40 Y40\nM30"
    plain = path(text.format("G1", "G1").replace(" F100", ""))
    for first, second in (("G0", "G1"), ("G1", "G0"), ("G0", "G0")):
        assert path(text.format(first, second)) == plain
    word = "#RND" if code == "G302" else "#CHR"
    refused(f"{MILL}G0 X30 {word}=5\nG1 X40 Y40", "isg-corner-rapid")
    refused(f"{MILL}G1 X30 {word}=5\nG0 X40 Y40", "isg-corner-without-next")


# Expansion ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("code", ["G999", "G310"])
def test_a_code_that_a_lathe_has_not_is_named_in_the_block_of_a_contour(code):
    found = check(f"G00 X40. Z0.\n{code} G111 X100. A180. K-30. B120. C5.", control="yasnac-lx3")
    assert [(each.code, each.message.partition(" ")[0]) for each in found] == [("code-unknown", code)]
