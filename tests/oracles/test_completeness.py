"""A list of solutions that is called complete holds all of them in 100 m; what is not known to be all is not solved."""

import json
from cmath import rect
from math import degrees, pi
from pathlib import Path
from random import Random
from typing import Any

import pytest
from click.testing import CliRunner
from free_chains import random_chain
from oracle_free_chains import heads, other_chains

import contoursolve
from contoursolve import Answer, ArcSegment
from contoursolve.cli import main
from contoursolve.diagnosis.solutions import Solutions, list_solutions
from contoursolve.solving.enumerate import DRAWING, Effort

FAR = """0 BEGIN PGM T MM
1 L X+12 Y-9 RL F500
2 FPOL X-31 Y-27
3 FC DR- CCPA+18 X-31.5
4 FLT P1X-45.6 P1Y+26 IY+40
5 END PGM T MM
"""
"""Of its two contours one has its centre 960 mm away, and no datum is larger than 63 mm."""

TWO_HALVES = (
    "length of line 1 = length of line 2",
    "straight part of line 1 = 30.044",
    "Z of center of corner 1 = -25.536",
)


def solved(text: str, **options: Any) -> tuple[Answer, Solutions]:
    (answer,) = contoursolve.solve(text, **options).answers
    listing = list_solutions(answer)
    assert listing is not None
    return answer, listing


def test_a_contour_much_larger_than_its_data_is_in_the_list() -> None:
    answer, listing = solved(FAR)
    assert answer.status.value == "ambiguous"
    assert listing.is_complete
    assert listing.method.startswith("search within 100000 mm of the start point")
    arcs = [each.contour.elements[0] for each in listing.solutions if each.contour]
    centers = sorted(arc.center for arc in arcs if isinstance(arc, ArcSegment))
    assert centers[0] == pytest.approx((-8.8437, -19.8010), abs=1e-4)
    assert centers[1] == pytest.approx((902.05, 276.17), abs=5e-3)


def test_the_travel_of_a_machine_is_a_setting_and_the_list_says_how_far_it_goes() -> None:
    answer, listing = solved(FAR, settings={"heidenhain.travel": "500"})
    assert answer.status.value == "solved"
    assert listing.is_single
    assert listing.method.startswith("search within 500 mm of the start point")
    assert "1 solution; this is the only one (by search within 500 mm of the start point" in str(answer)
    far, closed = solved(FAR)[1], solved("G111 X100. A180. B120. K-30. P5.", control="yasnac-lx3", start="X40. Z0.")[1]
    assert 0 < listing.boxes < far.boxes
    assert listing.steps == far.steps
    assert (closed.steps, closed.boxes) == (4, 0)


def test_the_natural_contour_of_a_block_with_facts_is_in_the_list() -> None:
    text = "G111 I14.283 X102.550 P? " + " ".join(f"(contoursolve: {fact})" for fact in TWO_HALVES)
    answer, listing = solved(text, control="yasnac-lx3", start="X40. Z0.")
    assert answer.status.value == "ambiguous"
    assert listing.is_complete
    places = sorted(each.contour.points["V1"] for each in listing.solutions if each.contour)
    assert places == [pytest.approx((-26.548, 34.283), abs=1e-3), pytest.approx((32.664, 34.283), abs=1e-3)]


@pytest.fixture
def given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """Searches that end before what lies farther away is decided."""
    few = Effort(300, 300)
    monkeypatch.setattr("contoursolve.solving.enumerate.DRAWING", few)


@pytest.mark.usefixtures("given_up")
def test_one_contour_that_is_not_known_to_be_the_only_one_is_undecided(tmp_path: Path) -> None:
    text = FAR.replace("X-31.5", "X-31.501")
    answer, listing = solved(text)
    assert answer.status.value == "undecided"
    assert answer.contour is None
    assert [each.is_chosen for each in listing.solutions] == [False]
    assert not listing.is_complete
    assert listing.within == pytest.approx(230, abs=1)
    (finding,) = (each for each in answer.diagnostics if each.is_error)
    assert finding.code == "only-unproven"
    assert "one contour fits the block within 230.4" in finding.message
    assert "no other one lies farther away is not proven" in finding.message
    path = tmp_path / "given-up.h"
    path.write_text(text)
    printed = CliRunner().invoke(main, ["solve", str(path), "--format", "json"])
    assert printed.exit_code == 1
    (contour,) = json.loads(printed.output)["contours"]
    assert (contour["status"], contour["branch"], contour["elements"]) == ("undecided", None, [])
    assert (len(contour["solutions"]), contour["count"]["is_complete"]) == (1, False)
    shown = CliRunner().invoke(main, ["solve", str(path)])
    assert "at least 1 solution; there may be more (by search within 230 mm of the start point" in shown.output
    (tmp_path / "given-up.json").write_text(printed.output)
    checked = CliRunner().invoke(main, ["verify", str(path), str(tmp_path / "given-up.json")])
    assert (checked.exit_code, "the result says not decided: path verified, status not checked" in checked.output) == (
        0,
        True,
    )
    document = json.loads(printed.output)
    document["contours"][0]["count"] |= {"is_complete": True, "doubts": []}
    (tmp_path / "given-up.json").write_text(json.dumps(document))
    refuted = CliRunner().invoke(main, ["verify", str(path), str(tmp_path / "given-up.json")])
    assert refuted.exit_code == 1
    assert "a list that is complete holds all in the control's travel" in refuted.output


@pytest.mark.parametrize("seed", range(50))
def test_a_complete_list_holds_every_chain_that_newton_finds_in_100_m(seed: int) -> None:
    chain = random_chain(Random(seed), 3, 5)
    _, listing = solved(chain.text, depth="verdict")
    found = other_chains(chain, Random(seed), 30)
    listed = [[each.end for each in item.contour.elements] for item in listing.solutions if item.contour]
    for drawn in found if listing.is_complete else ():
        places = list(heads(drawn))
        assert any(_are_near(places, each) for each in listed), (chain.text, places)


def _are_near(one: list[tuple[float, float]], other: list[tuple[float, float]]) -> bool:
    return len(one) == len(other) and all(
        abs(a - b) <= 1e-4 * (1 + abs(a))
        for first, second in zip(one, other, strict=True)
        for a, b in zip(first, second, strict=True)
    )


@pytest.mark.slow
def test_a_search_looks_at_no_more_intervals_than_it_may(monkeypatch: pytest.MonkeyPatch) -> None:
    from contoursolve.solving import enumerate as enumerating  # noqa: PLC0415

    looked_at, divide = [], enumerating.divide

    def counted(conditions: Any, tasks: Any) -> Any:
        answers = divide(conditions, tasks)
        looked_at.extend(number for _, number in answers)
        return answers

    monkeypatch.setattr(enumerating, "divide", counted)
    contoursolve.solve(random_chain(Random(36), 3, 8).text, depth="verdict")
    assert DRAWING.intervals < sum(looked_at) < 1.5 * DRAWING.intervals


def told_twice(size: int) -> str:
    """A chain that says everything twice, with one length that is wrong by 1 mm."""
    random, here, way, lines = Random(size), 0j, 0.0, ["0 BEGIN PGM T MM", "1 L X+0 Y+0"]
    for number in range(size):
        if number % 2 == 0:
            length = random.uniform(10, 30)
            here += rect(length, way)
            stated = length + (1 if number == size // 2 else 0)
            words = (
                f"FL{'T' if number else ''} X{here.real:+.4f} Y{here.imag:+.4f} AN{degrees(way):+.4f} LEN{stated:.4f}"
            )
        else:
            sense, radius = random.choice((-1, 1)), random.uniform(5, 20)
            center = here + rect(radius, way + sense * pi / 2)
            way += sense * random.uniform(0.5, 1.5)
            here = center + rect(radius, way - sense * pi / 2)
            words = f"FCT DR{'+' if sense > 0 else '-'} X{here.real:+.4f} Y{here.imag:+.4f} R{radius:.4f}"
        lines.append(f"{number + 2} {words}")
    return "\n".join([*lines, "99 END PGM T MM", ""])


@pytest.mark.slow
@pytest.mark.parametrize("size", [8, 24])
def test_what_is_tied_with_what_takes_one_elimination_however_long_the_chain(
    size: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    from contoursolve.numeric import modular_rank  # noqa: PLC0415

    calls, eliminate = [], modular_rank.exact_rank

    def counted(*arguments: Any) -> Any:
        calls.append(arguments)
        return eliminate(*arguments)

    monkeypatch.setattr(modular_rank, "exact_rank", counted)
    (answer,) = contoursolve.solve(told_twice(size)).answers
    assert answer.status.value == "conflicting"
    (finding,) = (each for each in answer.diagnostics if each.is_error)
    assert finding.span.line == size // 2 + 3
    # The whole chain is looked at a few times; each tied set by itself, and is small.
    assert 1 <= sum(len(rows) > 3 * size for rows, *_ in calls) < 40
