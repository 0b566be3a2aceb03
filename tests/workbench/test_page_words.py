"""What the page says instead of an option of the command line."""

import re

import pytest
from workbench_page import Page

from contoursolve.controls import DIALECTS
from contoursolve.workbench import Desk

ASKED = re.compile(r"--(set|let|start|control)\b")


@pytest.mark.parametrize("control", DIALECTS)
def test_no_finding_asks_for_an_option(control):
    seen = 0
    for rule in DIALECTS[control].catalogue:
        if not ASKED.search(rule.message + rule.help + rule.note):
            continue
        for number, text in enumerate(rule.rejected):
            opened = Page(Desk()).ask("open", name=f"{number}.nc", text=text, control=control)
            for finding in opened["findings"]:
                labels = [each["text"] for each in finding["labels"]]
                assert not ASKED.search(" ".join([finding["message"], finding["help"], *finding["notes"], *labels]))
                seen += 1
    assert seen


@pytest.mark.parametrize("control", DIALECTS)
def test_the_comment_that_it_names_is_taken(control):
    (rule,) = [each for each in DIALECTS[control].catalogue if each.code == "word-unknown"]
    page, text = Page(Desk()), rule.rejected[0]
    opened = page.ask("open", name="part.nc", text=text, control=control)
    (told,) = [each["help"] for each in opened["findings"] if each["code"] == "word-unknown"]
    comment = re.search(r"the comment (.*) in the first lines$", told)[1]
    again = Page(page.desk).ask("open", name="part.nc", text=f"{comment}\n{text}")
    assert again["control"]["name"] == control
    assert "word-unknown" not in [each["code"] for each in again["findings"]]
    assert again["contours"]


@pytest.mark.parametrize(
    ("text", "note"),
    [
        (
            "G18 G0 X40 Z0\nG1 X60 RND=2\nZ-20\n",
            "RND=2 in program line 2 is for siemens-840d or siemens-808d: choose one of them in the list above",
        ),
        ("L X+0 Y+0\nFL AN+0 LEN20\n", "FL in program line 2 is for heidenhain: choose heidenhain in the list above"),
    ],
)
def test_another_control_is_chosen_in_the_list(text, note):
    opened = Page(Desk()).ask("open", name="part.nc", text=text, control="yasnac-lx3")
    assert note in [each for finding in opened["findings"] for each in finding["notes"]]
