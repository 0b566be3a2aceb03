"""Pictures of chains of lines and arcs: every word of them as a dimension, elements in the colours of the control."""

import pytest

import contoursolve
from contoursolve import Severity, Status
from contoursolve.pictures import Role, Trail, compose, draw_answer
from contoursolve.pictures.page import Stroke, Text
from contoursolve.pictures.scene import Ring, Thin

FRAME = "0 BEGIN PGM A MM\n1 L X+0 Y+0\n{}\n99 END PGM A MM"

LINES = """2 FPOL X+20 Y+10
3 FL X+40 Y+0 CLSD+
4 FL IAN+90 LEN30
5 FL PAR 3 DP 30 IX-30 IY+0
6 RND R4
7 FL P1X+5 P1Y+20 P2X+2.5 P2Y+15 PDX+9.472 PDY+17.764 D5 PR+20 PA+180
8 CHF 2
9 FL CLSD-"""
ARCS = """2 FPOL X+10 Y+40
3 FL AN+0 X+30 Y+0
4 FCT DR+ R20 CCX+30 CCY+20 CCA+0
5 FLT LEN30
6 FC DR+ AN+90 ICCX-10 ICCY+0 R10 LEN14.142 CCA+90
7 FL IX-40 RX 3 IY+65 RY 3"""
ON_ARC = """2 FL AN+0 LEN30
3 FC DR+ R20 CCX+30 CCY+20 CCA+0
4 FLT LEN30
5 FC DR- R10 P1X+52.929 P1Y+57.071 P2X+60 P2Y+60 P3X+67.071 P3Y+57.071 PDX+60 PDY+65 D5 CCA+0"""
POLAR = """2 FL X+50 Y+50
3 FPOL X+10 Y+40
4 FC DR+ CCPR+31.623 CCPA+18.435 IPR-5.175 IPA+19.654
5 FC DR- IAN+0 ICCPR+6.371 ICCPA+11.31 X+50 Y+70
6 FL IAN-45 RAN 5 LEN20"""
TOUCHING = """2 FL X+40 Y+0
3 FL AN+90 LEN20
4 FL PAR 2 DP 20 AN+180 PDX+10 PDY+20 D0 X+5"""
COUNTED = """2 FPOL X+0 Y+10
3 FL X+30 Y+10
4 FL IPR+10 PA+0 RPR 3
5 FL IPA+90 RPA 3 IPR+0 RPR 4
6 FC DR+ ICCX-40 RCCX 4 ICCY+0 RCCY 4 X+0 Y-30"""
SHOWN_BY_THE_PATH = {"DR", "FSELECT", "FL", "FLT", "FC", "FCT"}


def only(body: str):
    (answer,) = contoursolve.solve(FRAME.format(body)).answers
    return answer


def drawn_texts(answer) -> str:
    items = draw_answer(answer).sheet.drawing
    return "  ".join(item.words for item in items if isinstance(item, Text))


@pytest.mark.parametrize("body", [LINES, ARCS, ON_ARC, POLAR, TOUCHING, COUNTED])
def test_every_word_stands_on_the_drawing_of_a_solved_chain(body):
    answer = only(body)
    assert answer.contour is not None
    assert all(finding.severity is Severity.INFO for finding in answer.diagnostics)
    texts = drawn_texts(answer)
    missing = [
        w.text for w in answer.claim.words.values() if w.address not in SHOWN_BY_THE_PATH and w.text not in texts
    ]
    assert not missing


def trails(answer) -> dict[Role, list[str]]:
    """The names of the elements that are drawn, by their roles."""
    found: dict[Role, list[str]] = {}
    for trail in compose(answer).each(Trail):
        found.setdefault(trail.role, []).extend(segment.name for segment in trail.segments)
    return found


def test_what_is_determined_is_blue_and_what_lacks_data_is_red():
    solved = only("2 FL AN+60\n3 FL X+80 Y+20 AN-30")
    assert trails(solved) == {Role.DETERMINED: ["line 2", "line 3"]}
    short = only("2 FL X+50 Y+0\n3 FC DR+ X+50 Y+40\n4 FL P1X+20 P1Y+30\n5 FL X+0 Y+60 PAR 2")
    assert short.status is Status.UNDERDETERMINED
    assert trails(short) == {Role.DETERMINED: ["line 2", "line 4", "line 5"]}
    chord = [thin for thin in compose(short).each(Thin) if thin.role is Role.OPEN]
    assert [(thin.start, thin.end) for thin in chord] == [((50.0, 0.0), (50.0, 40.0))]


def test_open_lines_and_circles_are_red_as_far_as_they_are_known():
    answer = only("2 FL X+30 Y+0\n3 FL AN+45\n4 FC DR+ CCX+60 CCY-30 R10\n5 FL X+80 Y+0")
    assert answer.status is Status.UNDERDETERMINED
    assert trails(answer) == {Role.DETERMINED: ["line 2"], Role.OPEN: ["line 3"]}
    (ring,) = compose(answer).each(Ring)
    assert (ring.center, ring.radius, ring.role) == ((60.0, -30.0), 10.0, Role.OPEN)


ARC = "2 FL AN+15\n3 FC DR- R25 CCX+50 CCY+20\n4 FL X+90 Y+30"
PARTED = "2 FL LEN40 P1X+30 P1Y+10\n{}3 FL X+80 Y+20"


def test_of_several_solutions_each_has_one_label_with_what_selects_it():
    assert trails(only(ARC)) == {Role.SEVERAL: ["line 2", "line 2"]}
    answer = only(PARTED.format(""))
    assert answer.status is Status.AMBIGUOUS
    names = ["line 2", "line 3"]
    assert trails(answer) == {Role.SOLUTION_A: names, Role.SOLUTION_B: names}
    texts = drawn_texts(answer)
    assert [texts.count(text) for text in ("FSELECT 1 after block 2", "FSELECT 2 after block 2")] == [1, 1]


def test_refused_chains_show_where_the_words_lead():
    answer = only("2 FL X+30 Y+0\n3 FL AN+80 LEN30\n4 FL PAR 2 DP 20\n5 FL X+0 Y+10 AN+200")
    assert answer.status is Status.CONFLICTING
    assert trails(answer) == {Role.DETERMINED: ["line 2", "line 3", "line 4", "line 5"]}
    assert {each.text: each.role for each in compose(answer).dimensions}["DP 20"] is Role.CONFLICTING


def test_the_legend_tells_what_the_colours_mean():
    sheets = [draw_answer(only(body)).sheet for body in ("2 FL AN+0\n3 FCT DR+\n4 FLT X+50 Y+60", PARTED.format(""))]
    texts = ["  ".join(item.words for item in sheet.around if isinstance(item, Text)) for sheet in sheets]
    assert "still free" in texts[0]
    assert "solution A alone  solution B alone" in texts[1]
    assert len([item for item in sheets[0].around if isinstance(item, Stroke) and item.role is Role.FREE]) >= 1


def test_of_a_chain_without_a_solution_what_comes_before_is_drawn():
    answer = only("2 FL AN+20\n3 FCT DR+ R10\n4 FLT AN+90 X+50 Y+60\n5 FC DR- R20 CCX+70 CCY+60\n6 FL LEN10 X+150 Y+10")
    assert answer.status is Status.NO_SOLUTION
    assert trails(answer) == {Role.DETERMINED: ["line 2", "arc 3", "line 4"]}
