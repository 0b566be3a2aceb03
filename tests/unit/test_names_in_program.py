"""Straights, arcs, corners and points are named by what stands in the program, alike in text and picture."""

import re
from pathlib import Path

import pytest

import contoursolve
from contoursolve.diagnosis import called_in_program, labels_of
from contoursolve.output import path_of
from contoursolve.pictures import draw_answer

PROGRAMS = Path(__file__).parents[2] / "docs" / "programs"
TURNED = "G00 X38.2 Z1.7\nG01 ,A163.4 ,R2.7\nX87.4 Z-61.9 ,A118.3 ,C1.6\nZ-83.1"
FREE = "0 BEGIN PGM A MM\n1 L X+0 Y+0 R0 FMAX\n2 FL AN+35 F300\n3 FCT DR- R20\n4 FLT X+90 Y+10 AN-30\n5 END PGM A MM"
PAIR = "G17 G90\nG00 X0. Y0.\nG01 A20. F300.\nG03 X65. Y45. R25.\nG01 X20. Y70."


@pytest.mark.parametrize(
    ("control", "text", "labels"),
    [
        (
            "yasnac-lx3",
            "G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5.",
            {"V1": "end of the first straight", "line 2": "second straight", "corner 1": "rounding P5.", "S": "start"},
        ),
        (
            "fanuc-lathe",
            TURNED,
            {
                "P1": "corner between program lines 2 and 3",
                "V1": "corner between program lines 3 and 4",
                "N3": "end of program line 4",
                "line 2": "straight (program line 3)",
                "corner 2": "chamfer ,C1.6 (program line 3)",
            },
        ),
        ("heidenhain", FREE, {"P3": "end of block 3", "C3": "centre of the arc of block 3", "arc 3": "arc (block 3)"}),
        ("mitsubishi", PAIR, {"P1": "end of program line 3", "C": "centre of the arc of program line 4"}),
    ],
)
def test_parts_of_a_contour_are_called_by_what_stands_in_the_program(control, text, labels):
    profile = contoursolve.solve(text, control=control).answers[0].profile
    found = labels_of(profile)
    assert {name: found[name] for name in labels} == labels


def test_texts_are_told_with_them_and_facts_stay():
    text = "G00 X40. Z0.\nG111 X100. A180. B120. K? (contoursolve: length of line 1 = 30)"
    called = called_in_program(contoursolve.solve(text, control="yasnac-lx3").answers[0].profile)
    told = called("length of line 1 = 30, where line 2 begins, no program line 2; corner 2.begin")
    assert told == (
        "length of line 1 = 30, where the second straight begins, no program line 2; the begin of the second corner"
    )


@pytest.mark.parametrize("path", sorted(PROGRAMS.glob("*.[!d]*")), ids=lambda path: path.name)
def test_a_point_has_one_label_in_the_picture_and_in_the_listing(path):
    options = {"control": "nct-99m"} if path.name == "plate.nc" else {}
    answers = contoursolve.solve(path.read_text("utf-8"), **options).answers
    for answer in (each for each in answers if each.contour is not None):
        svg = draw_answer(answer).svg
        drawn = set(re.findall(r">(?:, )?([VP]\d+)(?:,? ?)<", svg))
        listed = {row[0].partition(", ")[0] for row in path_of(answer, answer.contour).rows if row[1] == "point"}
        told = set(re.findall(r"\b([VP]\d+), (?:corner|end|the) ", svg))
        assert drawn <= listed
        assert told <= listed
        assert drawn | told or not listed


def test_a_contour_that_waits_says_so_once():
    text = "FERTIGTEIL\nG0 X30 Z0\nG1 X50 B#101\nG1 Z-40\nM8\nG1 X60 B1 B2\nG1 Z-60"
    second = contoursolve.solve(text, control="cnc-pilot").answers[1]
    assert [each.code for each in second.diagnostics] == ["address-repeated", "contour-waits"]
    assert {label.span.line for label in second.diagnostics[1].labels} == {4, 6}
