"""What the page says instead of an option of the command line."""

import re

import pytest
from workbench_page import Page

from contoursolve.controls import CONTROLS
from contoursolve.workbench import Desk

ASKED = re.compile(r"--(set|let|start|control)\b")
RULES = [
    (control, rule.code, number)
    for control, tables in CONTROLS.items()
    for rule in tables.catalogue
    if ASKED.search(rule.message + rule.help + rule.note)
    for number in range(len(rule.rejected))
]


def opened(text, control=None):
    return Page(Desk()).ask("open", name="part.nc", text=text, control=control)


def text_of(control, code, number=0):
    return next(each for each in CONTROLS[control].catalogue if each.code == code).rejected[number]


@pytest.mark.parametrize(("control", "code", "number"), RULES)
def test_no_finding_asks_for_an_option(control, code, number):
    findings = opened(text_of(control, code, number), control)["findings"]
    labels = [each["text"] for finding in findings for each in finding["labels"]]
    texts = [part for each in findings for part in (each["message"], each["help"], *each["notes"])]
    assert texts
    assert not ASKED.search(" ".join(texts + labels))


@pytest.mark.parametrize("control", CONTROLS)
def test_the_comment_that_it_names_is_taken(control):
    text = text_of(control, "word-unknown")
    (told,) = [each["help"] for each in opened(text, control)["findings"] if each["code"] == "word-unknown"]
    comment = re.search(r"the comment (.*) in the first lines$", told)[1]
    again = opened(f"{comment}\n{text}")
    assert (again["control"]["name"], again["control_from"]) == (control, "comment")
    assert "word-unknown" not in [each["code"] for each in again["findings"]]
    assert again["contours"]


LIST = "in program line 2 is for {}: choose {} in the list above"


@pytest.mark.parametrize(
    ("control", "text", "told"),
    [
        (
            *("yasnac-lx3", "G18 G0 X40 Z0\nG1 X60 RND=2\nZ-20\n"),
            f"RND=2 {LIST.format('siemens-840d or siemens-808d', 'one of them')}",
        ),
        ("yasnac-lx3", "L X+0 Y+0\nFL AN+0 LEN20\n", f"FL {LIST.format('heidenhain', 'heidenhain')}"),
        (
            *("fanuc-lathe", "#5=10\nG00 X40. Z0.\nG01 Z-30. ,R2.\nX#1 ,A120.\n"),
            "write the number, or state the value: #1=95. under Variables",
        ),
    ],
)
def test_an_option_is_the_list_or_the_pane_that_stands_for_it(control, text, told):
    findings = opened(text, control)["findings"]
    assert told in [part for each in findings for part in (each["help"], *each["notes"])]
