"""Free contours in Klartext: the programs of the manuals, and chains that are drawn forwards and told backwards."""

import re
from dataclasses import replace
from itertools import pairwise
from math import atan2, cos, dist, pi, radians, sin, tau
from random import Random

import pytest
from examples_heidenhain import PROGRAMS
from free_chains import random_chain
from vectors import VECTORS, program_of, solved as solved_vector

import contoursolve
from contoursolve import ArcSegment
from contoursolve.controls import CONTROLS
from contoursolve.diagnosis.solutions import list_solutions
from contoursolve.geometry import assemble
from contoursolve.solving import (
    alternatives as alternatives_module,
    analyse,
    closed_steps,
    enumerate as enumerate_module,
    free_cuts,
    groups_of,
)
from contoursolve.solving.alternatives import find_alternatives
from contoursolve.solving.step_equations import Local

HEIDENHAIN = "heidenhain"
FKEXAMP1 = program_of(HEIDENHAIN, "HF-G1")


def chain(*blocks, before="L X+0 Y+0"):
    numbered = [before, *blocks]
    return "0 BEGIN PGM T MM\n" + "".join(f"{n} {block}\n" for n, block in enumerate(numbered, 1)) + "99 END PGM T MM\n"


def solved(program):
    result = contoursolve.solve(program)
    assert result.control == "heidenhain"
    (answer,) = result.answers
    return answer


def ends(answer):
    return {each.name: each.end for each in answer.contour.elements}


def test_both_choices_of_fkexamp1_are_listed_and_chosen_by_their_numbers():
    def at(name, first, second):
        text = FKEXAMP1.replace("FSELECT 1", f"FSELECT {first}").replace("FSELECT 2", f"FSELECT {second}")
        return ends(solved(text))[name]

    assert at("line 15", 1, 1) == pytest.approx((110.3791, 116.8617), abs=6e-5)
    assert at("line 15", 1, 2) == pytest.approx((78.8656, 43.3301), abs=6e-5)
    listing = list_solutions(solved(FKEXAMP1))
    paths = [each for each in listing.solutions if each.contour]
    assert listing.is_complete
    assert len(paths) == 6
    (chosen,) = (each for each in paths if each.is_chosen)
    assert chosen.selects == ("FSELECT 1 after block 11", "FSELECT 2 after block 15")
    opposite = [each.contour.points["P11"] for each in paths if each.selects[0] == "FSELECT 2 after block 11"]
    assert opposite
    assert all(each == pytest.approx((-25.4078, -59.2849), abs=6e-5) for each in opposite)


def test_a_line_meets_a_circle_in_two_points_and_both_are_listed():
    answer = solved(chain("FL AN+15", "FC DR- R25 CCX+50 CCY+20 CCA+0", before="L X+0 Y+10"))
    assert answer.status.value == "ambiguous"
    places = sorted(each.contour.points["P2"] for each in list_solutions(answer).solutions)
    assert places[0] == pytest.approx((25.2114, 16.7554), abs=6e-5)
    assert places[1] == pytest.approx((73.0898, 29.5844), abs=6e-5)
    (finding,) = answer.diagnostics
    # The second one turns less.
    assert [fix.replacement.split("\n")[2] for fix in finding.fixes] == ["FSELECT 2", "FSELECT 1"]


@pytest.mark.slow
def test_settings_tell_what_numbers_choose_and_what_comes_without_them():
    ignoring = contoursolve.solve(FKEXAMP1, settings={"heidenhain.fselect": "ignore"}).answers[0]
    assert ignoring.status.value == "ambiguous"
    without = FKEXAMP1.replace("12 FSELECT 1\n", "").replace("16 FSELECT 2\n", "")
    first = contoursolve.solve(without, settings={"heidenhain.ambiguous": "first"}).answers[0]
    assert {each.code for each in first.diagnostics} == {"heidenhain-first-taken"}
    assert ends(first)["line 15"] == pytest.approx((110.3791, 116.8617), abs=6e-5)


ARC = "FC X+50 Y+20 CCX+30 CCY+20 DR+ R20"


@pytest.mark.parametrize(
    ("name", "word"), [("block-no-line", "RAN 2"), ("block-missing", "PAR 9"), ("block-missing-2", "RY 7")]
)
def test_a_reference_to_a_block_that_it_cannot_mean_is_told(name, word):
    row = VECTORS[HEIDENHAIN][f"heidenhain-{name}"]
    (own,) = (each for each in solved_vector(HEIDENHAIN, row).diagnostics if each.code == row["refused"]["code"])
    assert own.message.startswith(word)


@pytest.mark.parametrize(
    ("blocks", "number", "element", "off"),
    [
        (("FL AN+30", "FL AN+30", "FL X+80 Y+20"), "one", "straight (block 3)", None),
        (("FL AN+30", "FLT", "FLT", "FL AN-30 X+80"), "one", "straight (block 4)", None),
        (("FL AN+30", "FL AN+210", "FL X+80 Y+20"), "two", "straight (block 2)", None),
        (("FC DR- R20 CCX+20 CCY+0", "FCT DR- R20", "FLT"), "two", "arc (block 3)", None),
        (("FL X+20 Y+0 LEN25", "FL AN+30", "FL AN+30", "FL X+80 Y+20"), "one", "straight (block 4)", "5.000 mm"),
        (("FC DR- R20 CCX+25 CCY+0", "FCT DR- R20", "FLT"), "two", "arc (block 3)", "5.000 mm"),
    ],
)
def test_where_a_line_or_a_circle_is_cut_in_two_is_no_missing_word_and_a_contradiction_has_its_amount(
    blocks, number, element, off
):
    found = [each for each in solved(chain(*blocks, before="L X+0 Y+0")).diagnostics if each.severity.value == "error"]
    (missing,) = (each.message for each in found if each.code == "words-missing")
    verb = "word is" if number == "one" else "words are"
    assert missing.startswith(f"{number} {verb} missing, so ")
    assert element in missing.partition(": ")[0]
    against = [each.message for each in found if each.code != "words-missing"]
    assert [f"by {off}" in each for each in against] == [True] * (off is not None)


def test_what_contradicts_itself_beside_a_cut_circle_is_told_for_the_cut():
    answer = solved(chain("FC DR- R20 CCX+20 CCY+0", "FCT DR- R20", "FLT AN-60 LEN40 IX+30", before="L X+0 Y+0"))
    assert [(each.code, " by " in each.message) for each in answer.diagnostics] == [("words-conflict", True)]


def test_an_arc_that_goes_on_around_a_stated_centre_touches_by_itself():
    blocks = ("FC DR+ R20 CCX+0 CCY+0 X+0 Y+20", "FCT DR+ R20 CCX+0 CCY+0 X-20 Y+0")
    answer = solved(chain(*blocks, before="L X+20 Y+0 RL"))
    assert (answer.status.value, [*answer.diagnostics]) == ("solved", [])


@pytest.mark.parametrize("corner", ["RND R5", "CHF 5"])
@pytest.mark.parametrize("head", ["", "TOOL CALL 4 Z S3200\n", "L X+0 Y+0\nTOOL CALL 4 Z S3200\n"])
def test_a_corner_before_any_element_is_refused(head, corner):
    text = f"0 BEGIN PGM A MM\n{head}{corner}\nFL X+30 Y+20\nFL X+50 Y+0\nEND PGM A MM"
    found = contoursolve.check(text, control=HEIDENHAIN)
    assert [each.code for each in found if each.severity.value == "error"] == ["heidenhain-corner-first"]


def test_a_line_may_be_parallel_to_the_begin_of_an_arc_at_a_distance():
    radius, sense = 40.0, radians(60)
    blocks = "FC DR- R40 CCA+60", "FL AN-30 LEN10", "FL PAR 2 DP 60", "FL X+80 Y+0 AN-90"
    answer = solved(chain(*blocks, before="L X+0 Y+0"))
    assert answer.status.value == "ambiguous"
    for item in answer.alternatives.items:
        points = {name: complex(*at) for name, at in item.solution.points.items()}
        center = points["P2"] - radius * complex(cos(sense), sin(sense))
        tangent = center * 1j / abs(center)
        line = points["P4"] - points["P3"]
        assert abs(center) == pytest.approx(radius)
        assert (line.conjugate() * tangent).imag == pytest.approx(0, abs=1e-6)
        assert abs((points["P4"].conjugate() * tangent).imag) == pytest.approx(60)


def test_two_points_about_one_pole_may_be_at_two_distances():
    blocks = "FC DR- R20 CCX+20 CCY+30", "FLT", "FCT DR- R12 ICCPR+40 RCCPR 3 CCPA+26.31 CCA+0"
    answer = solved(chain("FPOL X+0 Y+0", *blocks, before="L X+0 Y+30"))
    end, center = ends(answer)["arc 3"], answer.contour.elements[-1].center
    assert dist(center, (0, 0)) - dist(end, (0, 0)) == pytest.approx(40)
    assert end == pytest.approx((18.9340, 49.9716), abs=1e-4)  # the outer tangent of both circles


def test_a_reference_beside_both_coordinates_is_told():
    found = solved(chain(ARC, "FL LEN30 X+60 Y+45 RX 2", before="L X+10 Y+20")).diagnostics
    assert [each.message[:4] for each in found if each.code == "heidenhain-reference-alone"] == ["RX 2"]


def test_an_angle_may_count_from_the_arc_right_before():
    alone, named = (solved(chain(ARC, f"FL LEN30 IAN+20{word}", before="L X+10 Y+20")) for word in ("", " RAN 2"))
    assert ends(named) == ends(alone)


def test_a_block_number_that_stands_twice_is_told_where_data_refer_to_it():
    text = chain("FL X+30 Y+0", "FL X+30 Y+10", "FL LEN30 PAR 2").replace("3 FL", "2 FL")
    found = [(each.code, each.message) for each in solved(text).diagnostics if each.is_error]
    assert found[0] == (
        "heidenhain-block-twice", "PAR 2: two elements of the chain have this block number, so it tells of neither",
    )  # fmt: skip


def test_a_circle_that_may_slide_lacks_one_word():
    text = chain(
        "FL X+5 Y+15", "FC CCX+20 CCY+15 DR+ R15", "FPOL X+20 Y+15", "FL AN+40", "FC DR+ R15 CCPR+35 CCPA+40 CCA+180"
    )
    answer = solved(text)
    assert answer.status.value == "underdetermined"
    (finding,) = answer.diagnostics
    assert finding.message.startswith("one word is missing, so the arc (block 3) and the straight (block 5) are open")


@pytest.mark.slow
def test_data_that_agree_are_accepted_with_a_note_and_others_are_told_by_how_much():
    agreeing = solved(chain("FL AN+60 LEN57.321", "FL X+80 Y+20 AN-30"))
    assert agreeing.contour is not None
    assert [each.severity.value for each in agreeing.diagnostics] == ["info"]
    against = solved(chain("FL AN+60 LEN50", "FL X+80 Y+20 AN-30"))
    assert against.status.value == "conflicting"
    assert against.diagnostics[0].values["off_by_mm"] == pytest.approx(7.321, abs=1e-3)
    apart = solved(chain("FC DR+ R20 CCX+0 CCY+20", "FCT DR- R15 CCX+35.917 CCY+20 CCA+90"))
    assert apart.diagnostics[0].values["off_by_mm"] == pytest.approx(0.917, abs=1e-3)
    parallel = solved(chain("FL AN+60", "FL X+80 Y+20 AN-120"))
    assert parallel.status.value == "no-solution"


TOP = "FC DR- CCX+20 CCY+0 R20"


@pytest.mark.parametrize(
    ("blocks", "cuts"),
    [
        (["FL X+0 Y+20", "FL Y+20", "FL X+50 Y+20", "FL X+50 Y+0"], {"P3": (25, 20)}),
        (["FL X+0 Y+20", "FL AN+0", "FL X+50 Y+20", "L X+50 Y+0"], {"P3": (25, 20)}),
        (["FL X+0 Y+20", "FL P1X+10 P1Y+20", "FL X+50 Y+20"], {"P3": (25, 20)}),
        (["FL X+0 Y+20", "FL Y+20", "FL AN+0", "FL X+60 Y+20"], {"P3": (20, 20), "P4": (40, 20)}),
        (["FL X+10 Y+20", "FL AN+45", "FL X+50 Y+60 AN+45", "FL X+50 Y+0"], {"P3": (30, 40)}),
        (["FL X+10 Y+20", "FL AN+45", "FLT X+50 Y+60", "FL X+50 Y+0"], {"P3": (30, 40)}),
        # What is behind the cut is known through it alone.
        (["FL AN+0", "FL AN+0 X+50"], {"P2": (25, 0)}),
        (["FL AN+90", "FLT Y+50", "FL X+10 Y+50"], {"P2": (0, 25)}),
        (["FL AN+0", "FL AN+0 X+50", "FL AN+90", "FL AN+90 Y+30"], {"P2": (25, 0), "P4": (50, 15)}),
        (["FL AN+0", "FLT", "FL X+60 AN+0", "FL X+60 Y+20"], {"P2": (20, 0), "P3": (40, 0)}),
        (["FL AN+0", "FL AN+0", "FCT DR+ R10 CCA+0 X+40"], {"P2": (15, 0)}),
        # Arcs on one circle, by their centres or by their radii.
        ([TOP, "FC DR- CCX+20 CCY+0 R20 X+40 Y+0"], {"P2": (20, 20)}),
        ([TOP, "FC DR- CCX+20 CCY+0 R20 X+0 Y+0"], {"P2": (40, 0)}),
        ([TOP, "FCT DR- R20 X+40 Y+0"], {"P2": (20, 20)}),
        ([TOP, "FCT DR- R20", "FLT AN-90 Y-30"], {"P2": (20, 20)}),
        # An arc through two points of a circle that it touches is on that circle.
        ([TOP, "FCT DR- X+40 Y+0"], {"P2": (20, 20)}),
        (["FC DR- CCX+20 CCY+0", "FCT DR- X+36 Y+12", "FLT LEN5"], {"P2": (20 - 20 / 10**0.5, 60 / 10**0.5)}),
        ([TOP, TOP, "FC DR- CCX+20 CCY+0 X+40 Y+0"], {"P2": (10, 17.320508), "P3": (30, 17.320508)}),
        ([TOP, "FC DR- CCX+20 CCY+0 R20 X+40 Y+0", "FL AN+0", "FL AN+0 X+60"], {"P2": (20, 20), "P4": (50, 0)}),
    ],
)
def test_a_block_that_only_cuts_a_line_or_an_arc_is_told_and_the_path_is_solved(blocks, cuts):
    answer = solved(chain(*blocks))
    told = [each.message.split(" cuts ")[0] for each in answer.diagnostics if each.code == "cut-free"]
    # Block 1 leads to where the contour begins, P1.
    assert told == [f"the end of block {name[1:]}" for name in cuts]
    for point, at in cuts.items():
        assert answer.contour.points[point] == pytest.approx(at)
    assert not any(each.is_error for each in answer.diagnostics)


@pytest.mark.parametrize(
    ("name", "off"),
    [
        ("radius-difference", 0.917),
        ("radius-difference-2", 0.917),
        ("words-conflict", 5),
        ("no-point", None),
        ("no-point-2", None),
    ],
)
def test_a_contradiction_is_told_before_what_is_missing(name, off):
    row = VECTORS[HEIDENHAIN][name]
    first, second = solved_vector(HEIDENHAIN, row).diagnostics[:2]
    assert (first.code, second.code) == (row["refused"]["code"], "words-missing")
    assert first.values.get("off_by_mm") == (off and pytest.approx(off, abs=1e-3))


def test_a_coordinate_that_rounding_alone_parts_from_zero_is_told_as_zero():
    (finding,) = solved(
        chain("FL AN+0 LEN60 CLSD+", "FL AN+90 LEN40", "FL AN+180 LEN60", "FL AN+240 CLSD-")
    ).diagnostics
    texts = [fix.description for fix in finding.fixes]
    assert any("write AN+270 for AN+240" in text for text in texts)
    assert not any("e-" in text for text in texts)


@pytest.mark.slow
def test_many_arcs_on_one_circle_are_told_and_not_searched(monkeypatch):
    calls = []
    monkeypatch.setattr(
        free_cuts, "find_alternatives", lambda profile: calls.append(profile) or find_alternatives(profile)
    )
    answer = solved(chain(*[TOP] * 14, f"{TOP} X+40 Y+0"))
    assert (answer.status.value, calls) == ("underdetermined", [])


@pytest.mark.parametrize(("number", "word"), [(2, "CCA+0"), (3, "CCA-90"), (4, "CCA+0")])
def test_a_direction_of_an_arc_that_others_contradict_is_one_conflict_and_never_agrees(number, word):
    (finding,) = solved(program_of(HEIDENHAIN, f"words-conflict-{number}")).diagnostics
    assert (finding.code, finding.values["expected"]) == ("words-conflict", pytest.approx(float(word[3:])))
    assert any(fix.description.startswith(f"write {word} for") for fix in finding.fixes)


@pytest.mark.parametrize(
    ("blocks", "line", "helping"),
    [
        # Through two known points, or beside one, a line has its direction.
        (["FL PDX+35.67 PDY+14.07 D9.222", "FL IX+3.839 Y-14.242"], 2, {"X", "Y", "LEN"}),
        (["FL X+30", "FL P1X+50 P1Y+20 AN+40", "FL AN+0 LEN10"], 3, {"X", "Y", "LEN"}),
        (["FL X+20 Y+0", "FL P1X+50 P1Y+20", "FL P1X+70 P1Y+0 LEN30"], 3, {"X", "Y", "LEN"}),
        (["FC DR+ CCX+0 CCY+20", "FLT LEN10"], 2, {"X", "Y", "LEN", "CCA"}),
    ],
)
def test_no_word_is_offered_that_repeats_what_there_is(blocks, line, helping):
    answer = solved(chain(*blocks))
    (finding,) = (each for each in answer.diagnostics if each.code == "words-missing")
    found = re.search(rf"((?:[A-Z0-9]+(?:, | or )?)+) in block {line}\b", finding.message)
    assert found
    assert {*re.split(", | or ", found[1])} - {"IX", "IY"} == helping
    for fix in finding.fixes:
        for word, at in re.findall(r"add ([A-Z]+)\? to block (\d+)", fix.description):
            assert int(at) != line or word in helping | {"IX", "IY"}


@pytest.mark.parametrize(
    ("stated", "lacking"),
    [("P1X+60", "add P1Y"), ("PDY+20", "add PDX and D"), ("PDY+20 D0", "add PDX"), ("PDX+60 PDY+35", "add D")],
)
def test_what_half_a_point_lacks_is_its_other_half(stated, lacking):
    missing, error = solved(chain("FL AN+60", f"FL X+80 Y+20 {stated}")).diagnostics
    assert (error.is_error, missing.code, missing.is_error) == (True, "words-missing", False)
    assert missing.message.partition(": ")[2].startswith(f"{lacking} in block 3, without which {stated[:3]}")


def test_a_closing_line_in_the_wrong_direction_is_told_with_the_right_one():
    text = chain("FL AN+0 LEN60 CLSD+", "FL AN+90 LEN40", "FL AN+180 LEN60", "FL AN+240 CLSD-")
    (finding,) = solved(text).diagnostics
    assert finding.values["off_by_mm"] == pytest.approx(40 / 3**0.5)
    assert finding.fixes[0].replacement.endswith("FL AN+270 CLSD-")


# Chains drawn forwards ------------------------------------------------------------------------------------------

CHAINS, SHARE, FAST = 60, 10, 3
WITHIN = 1e-3
"""mm. Their data are written with nine decimals."""


def rebuilt(contour, chain):
    """The elements of a contour as they were drawn: by their ends and centres alone."""
    found = []
    for segment, each in zip(contour.elements, chain.drawn, strict=True):
        sense = each.step.sense
        if isinstance(segment, ArcSegment):
            tail, head, center = segment.start, segment.end, segment.center
            ways = [atan2(at[1] - center[1], at[0] - center[0]) + sense * pi / 2 for at in (tail, head)]
            found.append(replace(each, tail=tail, head=head, begin=ways[0], end=ways[1], center=center))
        else:
            way = atan2(segment.end[1] - segment.start[1], segment.end[0] - segment.start[0])
            found.append(replace(each, tail=segment.start, head=segment.end, begin=way, end=way))
    return found


def turn(one, other):
    """The angle between two directions, radians."""
    return abs((one - other + pi) % tau - pi)


def solutions(answer):
    """Every contour that satisfies a chain, with how well it is known."""
    listing = list_solutions(answer)
    return [each for each in listing.solutions if each.contour] if listing else []


def is_true(contour, chain):
    """Whether a contour is smooth and measures what the words of the chain say."""
    found = rebuilt(contour, chain)
    smooth = all(turn(one.end, other.begin) < 1e-6 for one, other in pairwise(found))
    # A point beside a line may lie on either side, and angles are the same after a turn.
    off = [(abs(datum(found)) - abs(value)) for datum, value in chain.data]
    turned = [abs(datum(found) - value) % 360 for datum, value in chain.data]
    return smooth and all(abs(a) < 1e-6 or min(b, 360 - b) < 1e-6 for a, b in zip(off, turned, strict=True))


def has_drawn(chain):
    """Whether what was drawn is among the contours of a chain; none of them may be wrong."""
    found = solutions(solved(chain.text))
    for each in found:
        assert is_true(each.contour, chain), chain.text
    drawn = [each.head for each in chain.drawn]
    ends = [[segment.end for segment in each.contour.elements] for each in found]
    return any(max(map(dist, points, drawn)) <= WITHIN for points in ends)


@pytest.mark.slow
@pytest.mark.parametrize(
    "seeds",
    [range(FAST), *(pytest.param(range(at, at + SHARE), marks=pytest.mark.slow) for at in range(0, CHAINS, SHARE))],
    ids=lambda seeds: f"{seeds.start}-{seeds.stop}",
)
def test_a_chain_that_its_data_just_determine_is_among_the_solutions_and_none_is_wrong(seeds):
    missed = [chain.text for chain in (random_chain(Random(seed)) for seed in seeds) if not has_drawn(chain)]
    assert len(missed) <= max(1, len(seeds) // 100), missed[:3]


@pytest.mark.slow
@pytest.mark.parametrize("seeds", [range(0), pytest.param(range(12), marks=pytest.mark.slow)])
def test_the_construction_has_the_solutions_that_elimination_finds_in_the_same_order(monkeypatch, seeds):
    """Two ways that share no code from the equations to the numbers."""
    found, closed = [], 0
    examples = (example for rule in CONTROLS["heidenhain"].catalogue for example in (*rule.accepted, *rule.rejected))
    texts = [*PROGRAMS.values(), *dict.fromkeys(examples), *(random_chain(Random(seed), 3, 6).text for seed in seeds)]
    for close in (closed_steps.close_step, lambda *_: None):
        monkeypatch.setattr(enumerate_module, "close_step", close)
        alternatives_module._find.cache_clear()
        enumerate_module._roots_of.cache_clear()
        lists = []
        for text in texts:
            for answer in contoursolve.solve(text, control="heidenhain", depth="verdict").answers:
                profile = answer.profile
                if not (profile.is_extended and profile.start.is_known):
                    continue
                system = assemble(profile)
                if analyse(system).is_determined:
                    closed += any(close(Local(system, group)) is not None for group in groups_of(system))
                    drawn = find_alternatives(profile)
                    lists.append([(each.name, each.certificate.proof, each.scalars) for each in drawn.items])
        found.append(lists)
    assert closed > 10
    assert [[each[:2] for each in items] for items in found[0]] == [[each[:2] for each in items] for items in found[1]]
    for ours, theirs in zip(*found, strict=True):
        for one, other in zip(ours, theirs, strict=True):
            assert one[2] == pytest.approx(other[2], abs=1e-12)


def test_an_end_that_no_direction_puts_on_its_circle_conflicts():
    """The centre lies 10 mm left of X-17 Y-18, and CCA+90 above it: the arc ends at Y-8."""
    text = "0 BEGIN PGM A MM\n1 L X+0 Y+0 R0 FMAX\n2 L X-17 Y-18\n3 FC DR+ Y{} AN+90 R10 CCA+90\n4 END PGM A MM\n"
    for end, status in (("+47", "conflicting"), ("-8.01", "conflicting"), ("-8", "overdetermined")):
        (answer,) = contoursolve.solve(text.format(end), control="heidenhain").answers
        assert answer.status.value == status
        assert answer.contour is None or answer.contour.end == pytest.approx((-27, -8), abs=1e-9)


@pytest.mark.slow
def test_a_search_that_an_earlier_choice_does_not_touch_gives_each_choice_the_same_and_says_that_it_is_open(
    monkeypatch,
):
    """P2 stands in two places; what follows counts from P3, and knows nothing of P2."""
    monkeypatch.setattr(enumerate_module, "DRAWING", enumerate_module.Effort(20_000, 2_000, is_guessing=True))
    program = chain(
        "FC X+14.771601 CCX+9.998735 LEN24.390705 DR-",
        "FL",
        "FL AN+138.449694 IY+29.489106 RY 3 PDX+39.32547 PDY+49.560417 D3.254282",
        "FL IY+39.1449 RY 3 LEN23.552269",
        "FL P1X+64.958969 P1Y+42.777649 IX+16.763865 PR+75.212128",
        before="L X-4.7698947 Y+3.977564\nFPOL X+7 Y-3",
    )
    answer = solved(program)
    after = {}
    for each in list_solutions(answer).solutions:
        points = {name: (round(x, 4), round(y, 4)) for name, (x, y) in each.contour.points.items()}
        after.setdefault(points.pop("P2"), set()).add(tuple(points.values()))
    first, second = after.values()
    assert first == second
    assert not list_solutions(answer).is_complete
    (finding,) = answer.diagnostics
    assert finding.message.startswith(f"at least {2 * len(first)} contours fit")
