"""Contact sheets: the pictures of the examples of every rule, a few dozen on a page, for somebody to look at."""

from collections import defaultdict
from html import escape

import pytest
from browsing import Watched

import contoursolve
from contoursolve.controls import CONTROLS
from contoursolve.pictures import draw_result

pytestmark = [pytest.mark.browser, pytest.mark.slow]

ON_A_SHEET = 24
STYLE = """body { margin: 8px; display: grid; grid-template-columns: repeat(4, 1fr); gap: 8px; font: 12px sans-serif }
figure { margin: 0; border: 1px solid #ccc } img { width: 100%; height: auto; display: block }"""
WIDTHS = "images => Promise.all(images.map(image => image.decode().then(() => image.naturalWidth)))"


def rules():
    """Each rule of the catalogues on one of its controls, by control: of those that controls share, each has some."""
    by_code = defaultdict(list)
    for name, control in CONTROLS.items():
        for rule in control.catalogue:
            by_code[rule.code].append((name, rule))
    found = defaultdict(list)
    for number, shared in enumerate(by_code.values()):
        name, rule = shared[number % len(shared)]
        found[name].append(rule)
    return found


def examples(name):
    """The examples of the rules of a control, each program once: what the first one shows."""
    found = {}
    for rule in RULES[name]:
        for kind, programs in (("wrong", rule.rejected), ("right", rule.accepted)):
            for number, program in enumerate(programs, 1):
                found.setdefault(program, f"{rule.code}, {kind} {number}")
    return found


RULES = rules()


@pytest.mark.parametrize("name", CONTROLS)
def test_every_example_of_every_rule_has_a_picture_on_a_sheet(browser, artefacts, name):
    shown = list(examples(name).items())
    for number, begin in enumerate(range(0, len(shown), ON_A_SHEET), 1):
        figures = [
            f"<figure><figcaption>{escape(told)}</figcaption>"
            f"{draw_result(contoursolve.solve(program, control=name, name='a.nc'))._repr_html_()}</figure>"
            for program, told in shown[begin : begin + ON_A_SHEET]
        ]
        watched = Watched(browser, viewport={"width": 1600, "height": 1200})
        page = watched.page
        page.set_content(f"<!doctype html><title>{name}</title><style>{STYLE}</style>{''.join(figures)}")
        assert page.locator("img").evaluate_all(WIDTHS) == [760] * len(figures)
        page.screenshot(path=artefacts / f"sheet-{name}-{number}.png", full_page=True)
        assert watched.complaints == []
        page.close()
