"""What is said of facts beside words: what they contradict or repeat, by how much, and what to write instead."""

from cmath import rect
from math import radians

import pytest
from click.testing import CliRunner

from contoursolve import Answer, Diagnostic, Severity, Status, list_solutions, solve
from contoursolve.cli import main
from contoursolve.diagnostics import Applicability, ProgramError

LINES = "G111 A180. K-30. B120. X100."
ONE = f"{LINES} P5. Q5."
PAIR_TEXT = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"


def told(block: str, *facts: str) -> tuple[Answer, dict[str, Diagnostic]]:
    """What becomes of a block, and its findings by their codes."""
    (answer,) = solve(block, start="X40. Z0." if "G111" in block else None, facts=facts).answers
    return answer, {each.code: each for each in answer.diagnostics}


@pytest.mark.parametrize(
    "program", [f"G00 X40. Z0.\n{ONE}\nG00 X40. Z0.\n{ONE}", f"{PAIR_TEXT}\nG0 X50 Y0\n" + PAIR_TEXT]
)
def test_a_fact_for_one_of_two_contours_is_refused(program: str) -> None:
    with pytest.raises(ProgramError, match="2 contours"):
        solve(program, facts=["length of line 1 = 30"])
    blocks = [part for line in program.splitlines() for part in ("--block", line)]
    done = CliRunner().invoke(main, ["check", *blocks, "--fact", "length of line 1 = 30"])
    assert (done.exit_code, done.stdout) == (2, "")
    assert "(contoursolve: ...)" in done.stderr


def test_a_fact_in_a_comment_is_about_its_own_contour() -> None:
    first = f"{ONE} (contoursolve: length of line 1 = ?)"
    second = "G111 A180. B120. X160. (contoursolve: Z of V1 = -80)"
    result = solve(f"G00 X40. Z0.\n{first}\n{second}")
    assert [len(answer.claim.directives) for answer in result.answers] == [1, 1]
    assert [answer.contour.points["V1"][0] for answer in result.answers if answer.contour] == [-30, -80]
    assert [each.value for each in result.answers[0].answers] == [30]


OPEN = {
    ONE.replace("A180.", "A?"): "V1 (X) and V2 (Z) are still open: give A? a value; or add I",
    ONE.replace("K-30.", "K?"): "V1 (Z and X) and V2 (Z) are still open: give K? a value; or add one of Z, W",
    ONE.replace("B120.", "B?"): "V2 is still open in Z: give B? a value; or add one of Z, W",
    ONE.replace("X100.", "X?"): "V2 is still open in Z and X: give X? a value; or add one of U, Z, W",
    ONE.replace("P5.", "P?"): "the radius of corner 1 is still open: give P? a value",
    ONE.replace("Q5.", "Q?"): "the radius of corner 2 is still open: give Q? a value",
    PAIR_TEXT.replace("X-50 Y0", "X? Y0"): (
        "C (X and Y), N1 (X) and P1 (X and Y) are still open: give X? a value; or add one of I, J in program line 2"
    ),
    PAIR_TEXT.replace("X-50 Y0 R50", "I-50 J?"): (
        "C (Y), P1 (X and Y) and the radius of the arc are still open: give J? a value; or add R in program line 2"
    ),
    PAIR_TEXT.replace("G1 X-50", "G1 X?"): "P1 (X and Y) and N2 (X) are still open: give X? a value",
    PAIR_TEXT.replace(",A171.87", ",A?"): "P1 is still open in X and Y: give ,A? a value",
    "G111 A90. C2. B180. Z-30. Q3. I?": "V1 (Z and X) and V2 (X) are still open: give I? a value; or add one of X, U",
}


@pytest.mark.parametrize("block", OPEN)
def test_a_word_that_is_asked_for_alone_names_what_is_missing(block: str) -> None:
    answer, found = told(block)
    assert answer.status is Status.UNDERDETERMINED
    assert [(each.question.word.text[-1], each.value) for each in answer.answers] == [("?", None)]
    assert found["words-missing"].message == OPEN[block]


@pytest.mark.parametrize(
    ("word", "value"), [("I?", 0.0), ("U?", 30.0), ("Z?", -30 - 30 / 3**0.5), ("W?", -30 - 30 / 3**0.5)]
)
def test_a_word_that_the_others_determine_can_be_asked_for(word: str, value: float) -> None:
    answer, found = told(f"{LINES} {word}")
    assert (answer.status, found) == (Status.SOLVED, {})
    assert [each.value for each in answer.answers] == [pytest.approx(value)]


FULL = "A180. K-30. B120. X100. P5. Q5."
CORNERED = "A180. K-30. B120. X100. P5. Q4."
SAID = [
    # words, fact, status, and what the first finding says behind "disagrees with", "is not true of what", "repeats"
    (FULL, "length of line 1 = 31", "K-30. and A180. by 1.000 mm: it states 31.000 mm, they give 30.000 mm"),
    (FULL, "Z of V1 = -29", "K-30. by 1.000 mm: it states -29.000 mm, K-30. gives -30.000 mm"),
    (FULL, "X of S = 41", "the other words by 1.000 mm: it states 41.000 mm, they give 40.000 mm"),
    (FULL, "radius of corner 1 = 6", "P5. by 1.000 mm: it states 6.000 mm, P5. gives 5.000 mm"),
    (FULL, "direction of line 2 = 60", "B120. by 60.000 deg: it states 60.000 deg, B120. gives 120.000 deg"),
    (
        *(FULL, "angle from line 1 to line 2 = -50"),
        "A180. and B120. by 10.000 deg: it states -50.000 deg, they give -60.000 deg",
    ),
    # 5 mm times the tangent of 30 degrees are missing of 30 mm.
    (
        *(FULL, "straight part of line 1 = 20"),
        "K-30., A180., P5. and B120. by 7.113 mm: it states 20.000 mm, they give 27.113 mm",
    ),
    (
        *(FULL, "Z of center of corner 1 = -28"),
        "K-30., A180., P5. and B120. by 0.887 mm: it states -28.000 mm, they give -27.113 mm",
    ),
    (
        "A180. K-30. B120.",
        "length of line 1 = 31",
        "K-30. and A180. by 1.000 mm: it states 31.000 mm, they give 30.000 mm",
    ),
    ("A180. B120. X100.", "X of V2 = 102", "X100. by 2.000 mm: it states 102.000 mm, X100. gives 100.000 mm"),
    (CORNERED, "length of line 1 = length of line 2", "K-30., A180., X100. and B120. give: it is off by 4.641 mm"),
    (CORNERED, "radius of corner 1 = radius of corner 2", "P5. and Q4. give: it is off by 1.000 mm"),
    (CORNERED, "line 1 passes through (Z-10. X41.)", "A180. gives: it is off by 0.500 mm"),
    (CORNERED, "corner 1 passes through (Z-28. X50.)", "K-30., A180., P5. and B120. give: it is off by 2.421 mm"),
    (CORNERED, "line 1 tangent to circle (Z-10. X46. R4.)", "A180. gives: it is off by 1.000 mm"),
    (
        *(CORNERED, "corner 1 tangent to circle (Z-10. X46. R4.)"),
        "K-30., A180., P5. and B120. give: it is off by 11.992 mm",
    ),
    (FULL, "length of line 1 = 30", "K-30. and A180."),
    (FULL, "Z of V1 = -30", "K-30."),
    (FULL, "X of S = 40", "the other words"),
    (FULL, "radius of corner 1 = 5", "P5."),
    (FULL, "direction of line 2 = -240", "B120."),
    (FULL, "angle from line 1 to line 2 = -60", "A180. and B120."),
    (FULL, "line 1 passes through (Z-10. X40.)", "A180."),
    (FULL, "radius of corner 1 = radius of corner 2", "P5. and Q5."),
    (FULL, "line 1 tangent to circle (Z-10. X46. R3.)", "A180."),
    ("A180. B120. X100.", "X of V2 = 100", "X100."),
    ("A180. K-30. B120.", "length of line 1 = 30", "K-30. and A180."),
]


@pytest.mark.parametrize(("words", "fact", "others"), SAID)
def test_a_fact_that_words_decide_is_held_against_just_these(words: str, fact: str, others: str) -> None:
    answer, found = told(f"G111 {words}", fact)
    code = "fact-conflict" if " off by " in others else "words-conflict" if " by " in others else "words-redundant"
    says = {"words-conflict": "disagrees with", "fact-conflict": "is not true of what", "words-redundant": "repeats"}
    assert found[code].message == f"{fact} {says[code]} {others}"
    is_open = "P5." not in words
    if code == "words-redundant" and not is_open:
        assert (answer.status, answer.contour) == (Status.OVERDETERMINED, told(ONE)[0].contour)
    else:
        status = Status.UNDERDETERMINED if code == "words-redundant" else Status.CONFLICTING
        assert (answer.status, answer.contour) == (status, None)
    missing = {
        "A180. B120. X100.": "V1 (Z and X) and V2 (Z) are still open: add one of K, Z, W",
        "A180. K-30. B120.": "V2 is still open in Z and X: add one of X, U, Z, W",
    }
    assert [each.message for code, each in found.items() if code == "words-missing"] == [missing.get(words)] * is_open


TRAVEL = "the fact cannot be read: {} is larger than a control can travel"
FITS = "corner {} does not fit: {} mm, at most {} mm fits on line {}"
REFUSED = [
    ("A180. B120. X100.", "length of line 1 = 1e999", "fact-unreadable", TRAVEL.format("1e999")),
    ("A180. B120. X100.", "length of line 1 = 1000001", "fact-unreadable", TRAVEL.format("1000001")),
    (
        *("A180. K-30. B120. X100. P?", "Z of begin of corner 1 = 29.9", "g111-corner-too-large"),
        FITS.format(1, "P? is 103.750", "51.961", 1),
    ),
    (
        *("A180. K-30. B120. X100. C?", "Z of begin of corner 1 = -5", "g111-corner-too-large"),
        FITS.format(1, "C? is 59.151", "30.000", 2),
    ),
    (
        *("A180. K-30. B120. X100. P2. D?", "straight part of line 2 = -5", "g111-corner-too-large"),
        FITS.format(2, "D? is 33.330", "29.000", 2),
    ),
    (
        *("K-30. I0. B120. X100. P2.", "length of line 1 = 0", "fact-impossible"),
        "length of line 1 = 0 says nothing about this contour: a length is larger than 0, not 0",
    ),
    ("X100. Z-47. B120.", "length of line 1 = 3", "no-point", "no V1 fits length of line 1 = 3 and B120. together"),
    (
        *("I0 B120. X100.", "direction of line 1 = 180", "facts-singular"),
        "at these values direction of line 1 = 180 and I0 do not fix V1 (Z)",
    ),
    (
        *("A180. B180. X100. Z-50. P?", "straight part of line 1 = 2", "g111-parallel"),
        "no V1 fits A180., B180. and X100.: the lines are parallel and 30.000 mm apart",
    ),
    (
        *("A180. I0 B120. X100. P?", "straight part of line 1 = 2", "g111-not-fixed"),
        "A180. and I0 do not fix V1 (Z): at these values they state the same line",
    ),
]


@pytest.mark.parametrize(("words", "fact", "code", "message"), REFUSED)
def test_words_and_facts_that_do_not_go_together_are_named(words: str, fact: str, code: str, message: str) -> None:
    answer, found = told(f"G111 {words}", fact)
    assert answer.contour is None
    assert (found[code].message, found[code].severity) == (message, Severity.ERROR)


@pytest.mark.parametrize(
    ("words", "facts", "status", "codes"),
    [
        ("A180. K-30. B120. X100. P2.", ["corner 1 tangent to line 2"], "overdetermined", {"words-redundant"}),
        (
            *("A180. K-30. B120. X100. P?", ["corner 1 passes through (Z-28. X41.)", "corner 1 tangent to line 2"]),
            *("ambiguous", {"several-contours"}),
        ),
        ("A180. B120. X100. Q2.", ["Z of end of corner 2 = -50"], "solved", {"g111-line-1"}),
        # Line 2 is as long as its height above V1: it stands upright.
        ("A180. K-30. X100. Z?", ["length of line 1 = length of line 2"], "solved", {"g111-touches"}),
        ("A? K? B? X? Z? P? Q? C? D? I? U? W?", [], "rejected", {"fact-impossible"}),
        ("A180. K-30. B120. X100. P? Q?", ["straight part of line 2 = 20"], "underdetermined", {"words-missing"}),
    ],
)
def test_unusual_facts_are_answered(words: str, facts: list[str], status: str, codes: set[str]) -> None:
    answer, found = told(f"G111 {words}", *facts)
    assert (answer.status.value, found.keys()) == (status, codes)


def test_several_contours_are_listed_and_each_is_selected_by_what_is_offered() -> None:
    """The circle of 30 mm about the start meets the line of 120 degrees through V2 twice."""
    answer, found = told("G111 X100. Z-47. B120.", "length of line 1 = 30")
    assert (answer.status, answer.contour) == (Status.AMBIGUOUS, None)
    assert "2 contours" in found["several-contours"].message
    listing = list_solutions(answer)
    assert listing is not None
    assert listing.is_complete
    # V1 = V2 - t * u, at 30 mm from the start: t**2 - 2 t (V2 - S) u + |V2 - S|**2 - 30**2 = 0
    gap, along = complex(-47, 30), rect(1, radians(120))
    half = (gap * along.conjugate()).real
    roots = [half - way * (half**2 - abs(gap) ** 2 + 900) ** 0.5 for way in (1, -1)]
    true = sorted(((complex(-47, 50) - root * along) for root in roots), key=lambda at: at.real)
    places = [complex(*each.contour.points["V1"]) for each in listing.solutions if each.contour]
    assert sorted(places, key=lambda at: at.real) == pytest.approx(true, abs=1e-9)
    for each, place in zip(listing.solutions, places, strict=True):
        (fact,) = each.selects
        chosen, _ = told(f"G111 X100. Z-47. B120. {fact}", "length of line 1 = 30")
        assert chosen.status in (Status.SOLVED, Status.OVERDETERMINED)
        assert chosen.contour is not None
        assert complex(*chosen.contour.points["V1"]) == pytest.approx(place, abs=1e-3)


def test_what_was_asked_for_is_filled_in_and_the_block_stands_alone() -> None:
    answer, _ = told(f"{LINES} P? Q5.", "straight part of line 2 = 25")
    # Line 2 has 30/sin(120) mm, of which both corners take tan(30) of their radius.
    size = (30 / 0.75**0.5 - 25) * 3**0.5 - 5
    assert answer.filled is not None
    assert answer.filled.blocks == (f"{LINES} P{size:.3f} Q5.",)
    alone, found = told(answer.filled.blocks[0])
    assert (alone.status, found) == (Status.SOLVED, {})
    assert alone.contour is not None
    assert answer.contour is not None
    gaps = [
        abs(complex(*mine.end) - complex(*theirs.end))
        for mine, theirs in zip(alone.contour.elements, answer.contour.elements, strict=True)
    ]
    assert max(gaps) <= answer.filled.deviation + 1e-12


ENDS = "the contour ends at Z{:.3f} mm X{:.3f} mm"
FACT_FIXES = [
    (f"{LINES} (contoursolve: length of line 1 = 31)", "delete length of line 1 = 31"),
    (f"{LINES} (contoursolve: length of line 1 = 31)", "write length of line 1 = 30 for"),
    (f"{LINES} (contoursolve: length of line 1 = 31)", "write K-31. for K-30."),
    (f"{LINES} (contoursolve: X of V2 = 100; X of V1 = 40)", "delete X of V2 = 100; delete X of V1 = 40"),
    ("G111 A180. K-30. B120. (contoursolve: X of V2 = 100; X of V1 = 40)", "delete X of V1 = 40"),
    ("G111 A180. K-30. X100. (contoursolve: line 2 passes through (Z-40. X80.))", "write [Z-40. X80.] for"),
    ("G111 A180. K-30. B120. (contoursolve X of V2 = 100)", "write (contoursolve: X of V2 = 100) for"),
    (f"{LINES} F?", "delete F?"),
    (f"{LINES} (contoursolve: length of line 3 = 1)", "delete length of line 3 = 1"),
]


@pytest.mark.parametrize(("block", "wanted"), FACT_FIXES)
def test_a_fix_of_a_block_with_facts_is_solved_as_it_is_shown(block: str, wanted: str) -> None:
    fixes = [fix for each in solve(block, start="X40. Z0.").diagnostics for fix in each.fixes]
    (fix,) = [each for each in fixes if each.description.startswith(wanted)]
    for each in (each for each in fixes if each.applicability is not Applicability.PLACEHOLDER):
        answer, _ = told(each.replacement)
        assert answer.status in (Status.SOLVED, Status.OVERDETERMINED)
        assert answer.contour is not None
        z, x = answer.contour.end
        assert each is not fix or each.description.endswith(ENDS.format(z, 2 * x))


def test_a_word_that_is_missing_besides_facts_is_offered_and_settles_the_block() -> None:
    _, found = told("G111 A180. B120. X100. P?", "straight part of line 1 = 20")
    fixes = {fix.description.partition(" (")[0]: fix for each in found.values() for fix in each.fixes}
    assert [*fixes] == ["add I?", "add K?", "add Z?", "add W?"]
    after, _ = told(fixes["add K?"].replacement.replace("K?", "K-30."), "straight part of line 1 = 20")
    # P takes tan(30) of itself from 30 mm.
    assert [each.value for each in after.answers] == [pytest.approx(10 * 3**0.5)]


def test_a_size_that_is_asked_for_has_no_limit_to_write_but_what_it_follows_from() -> None:
    _, found = told(f"{LINES} P?", "radius of corner 1 = 80")
    assert found["g111-corner-too-large"].help.startswith("change radius of corner 1 = 80:")
    assert [each.text for each in found["g111-corner-too-large"].labels] == [""]


def test_a_coordinate_that_is_asked_for_tells_where_the_last_corner_lands() -> None:
    asked, _ = told("G111 X? A180. K-30. B120. Q5.", "Z of V2 = -47.")
    assert asked.contour is not None
    stated, _ = told(f"G111 X{2 * asked.contour.points['V2'][1]:.9f} A180. K-30. B120. Q5.")
    assert stated.contour is not None
    assert asked.contour.end == pytest.approx(stated.contour.end, abs=1e-6)


@pytest.mark.parametrize("word", ["F?", "N?", "M?", "S?", "T?"])
def test_a_question_about_what_is_no_part_of_the_contour_is_refused(word: str) -> None:
    answer, found = told(f"{LINES} {word}")
    assert answer.status is Status.REJECTED
    assert word in found.get("asked-nothing", found.get("address-unknown", found)).message  # type: ignore[union-attr]


@pytest.mark.boundary
@pytest.mark.parametrize(
    ("words", "fact", "is_beyond"),
    [
        ("A180. K-30. X100.", "line 2 passes through [Z-60. X160.]", True),
        ("A180. K-30. X100.", "line 2 passes through [Z-40. X80.]", False),
        ("A180. K-30. X100.", "line 2 passes through [Z-45. X100.]", False),
        ("A180. K-30. X100.", "line 2 passes through [Z-45. X100.01]", True),
        ("A180. K-30. B120. X100. P?", "corner 1 tangent to line [Z0. X46. A180.]", True),
        ("A180. K-30. B120. X100. P?", "corner 1 passes through [Z-28. X40.5]", False),
        ("A180. K-30. X100.", "line 2 tangent to circle [Z-40. X120. R10.]", False),
    ],
)
def test_a_fact_that_holds_where_nothing_is_cut_is_pointed_out(words: str, fact: str, is_beyond: bool) -> None:
    _, found = told(f"G111 {words}", fact)
    assert ("fact-beyond" in found) is is_beyond


PASSES = f"G00 X40. Z0.\n{LINES} P5. Q? (contoursolve: corner 1 passes beside {{}})"
CHAIN = "G17 G90 G42 G0 X100 Y20\n{}\n{} (contoursolve: arc tangent to line 1)"


@pytest.mark.parametrize(
    ("text", "control", "status"),
    [
        # The centre of corner 1 lies at Z-27.113, X50: 10 mm beside the place, and 4.910 mm beside the other one.
        (PASSES.format("[Z-27.1132487 X70.] at 5"), "yasnac-lx3", Status.UNDERDETERMINED),
        (PASSES.format("[Z-31. X44.] at 0.5"), "yasnac-lx3", Status.CONFLICTING),
        (CHAIN.format("G3 X27 Y28 R50 ,R?", "G3 X-45 Y26 R40"), "nct-99m", Status.REJECTED),
    ],
)
def test_a_fact_that_nothing_needs_is_compared_beside_a_size_that_nothing_tells(
    text: str, control: str, status: Status
) -> None:
    assert solve(text, control=control).answers[0].status is status


@pytest.mark.parametrize("length", ["10", "41.2", "41.3", "77"])
def test_a_length_that_is_not_that_of_two_stated_ends_disagrees(length: str) -> None:
    block = f"G17 G90 G0 X0 Y0\nG1 X30 RND=5\nX40 Y40 ; contoursolve: length of line 2 = {length}"
    (finding,) = solve(block, control="siemens-840d").diagnostics
    assert finding.code == "words-conflict"
    off = abs(float(length) - 1700**0.5)
    assert f"by {off:.3f} mm: it states {float(length):.3f} mm, they give 41.231 mm" in finding.message
