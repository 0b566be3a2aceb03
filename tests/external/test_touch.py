"""The explorer in a browser, without a notebook: its front end on a page, and Python behind a function of that page."""

import json
import math
from importlib.resources import files

import pytest
from browsing import Watched

from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration import begin
from contoursolve.output.html import notebook_style

pytestmark = pytest.mark.browser

HOUSE = files("contoursolve.notebook")
BLOCK = "G111 X100. A180. K-30. B120. P5. Q5."
PAGE = """<!doctype html><html lang="en"><head><meta charset="utf-8"><title>explorer</title>
<style>{style}</style></head>
<body><main><h1>Explorer</h1><div id="here"></div></main><script type="module">{script}
const state = {state}, heard = {{}};
window.model = {{
  get: (name) => state[name],
  set: (name, value) => (state[name] = value),
  save_changes: async () => {{
    if (window.isSilent) return;
    window.pending = (window.pending ?? 0) + 1;
    const told = await window.answer(state.action);
    // Some notebooks hand over part after part, in the order of a table of their own.
    const rank = (name) => (window.order ?? ["number"]).indexOf(name) >>> 0;
    for (const name of Object.keys(told).sort((one, other) => rank(one) - rank(other))) {{
      state[name] = told[name];
      for (const tell of heard[`change:${{name}}`] ?? []) tell();
      await new Promise((go) => setTimeout(go));
    }}
    window.pending -= 1;
  }},
  on: (name, tell) => (heard[name] ??= []).push(tell),
  off: () => {{}},
}};
explorer.render({{ model: window.model, el: document.getElementById("here") }});
</script></body></html>"""


class Desk(Watched):
    """An explorer on a page; `talk` is Python's side of it."""

    def __init__(self, browser, folder, text, scheme="light", **options):
        super().__init__(browser, viewport={"width": 1400, "height": 1000}, color_scheme=scheme)
        self.talk = Conversation(begin(text, **options))
        self.page.expose_function("answer", self.answer)
        style = notebook_style() + HOUSE.joinpath("explorer.css").read_text()
        script = HOUSE.joinpath("explorer.js").read_text().replace("export default", "const explorer =")
        state = json.dumps(self.talk.state).replace("</", "<\\/")
        written = folder / "explorer.html"
        written.write_text(PAGE.format(style=style, script=script, state=state), encoding="utf-8")
        self.page.goto(written.as_uri())
        self.page.locator(".paper svg").wait_for()

    def answer(self, action):
        return json.loads(json.dumps(self.talk.answer(action)))

    @property
    def text(self):
        return self.talk.exploration.text

    def settle(self):
        """Wait until Python has answered all that was asked."""
        self.page.wait_for_timeout(50)
        self.page.wait_for_function("!window.pending")

    def place(self, selector):
        """The middle of something, in pixels of the screen."""
        box = self.page.locator(selector).first.bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(self, name, by, steps=10):
        """Take hold of a handle, and pull it so many pixels, without letting go."""
        x, y = self.place(f".handle[aria-label^='{name}:']")
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        mouse.move(x + by[0], y + by[1], steps=steps)
        self.settle()


START = "[data-point~='start']"


@pytest.fixture
def desk(browser, tmp_path):
    found = Desk(browser, tmp_path, BLOCK, start="X40. Z0.")
    yield found
    found.page.close()


def test_a_point_is_dragged_and_the_picture_stands_still_until_it_is_let_go(desk, artefacts):
    desk.page.screenshot(path=artefacts / "touch-before.png")
    start, height = desk.place(START), desk.page.locator(".paper svg").bounding_box()["height"]
    pixels = desk.talk.state["view"]["handles"][1]["moves"]["K"][0]
    desk.drag("V1", (-20 * pixels, 3))
    assert "K-50." in desk.text
    assert desk.talk.state["view"]["is_held"]
    assert desk.place(START) == pytest.approx(start, abs=0.01)
    assert desk.page.locator(".paper svg").bounding_box()["height"] == height
    desk.page.screenshot(path=artefacts / "touch-held.png")
    desk.page.mouse.up()
    desk.page.wait_for_timeout(400)
    assert not desk.talk.state["view"]["is_held"]
    assert desk.place(START)[0] != pytest.approx(start[0], abs=5)  # fitted
    desk.page.screenshot(path=artefacts / "touch-fitted.png")
    desk.page.locator("button.undo").click()
    desk.settle()
    assert desk.text == BLOCK
    desk.page.keyboard.press("Control+y")
    desk.settle()
    assert "K-50." in desk.text
    desk.check()


def test_a_drag_stops_where_the_contour_ends_and_says_why(desk, artefacts):
    desk.page.locator(".row[data-word='P'] .range", has_text="0 ≤ P ≤ 51.961").wait_for()
    desk.drag("P", (300, -520))
    assert "P51.961 " in desk.text
    assert desk.page.locator(".hint").inner_text().startswith("P: stops: P is too large for the first straight")
    assert desk.page.locator(".tracks text").all_inner_texts() != []
    desk.page.screenshot(path=artefacts / "touch-stopped.png")
    desk.page.keyboard.press("Escape")
    desk.page.mouse.up()
    desk.settle()
    assert desk.text == BLOCK
    desk.check()


def test_all_handles_follow_the_arrow_keys(desk):
    handles = desk.page.locator(".handle")
    texts = [handles.nth(number).get_attribute("aria-label") for number in range(handles.count())]
    assert texts == [
        "end: changes K and X", "V1: changes K", "V2: changes X and K", "A: angle", "B: angle", "P: size", "Q: size",
    ]  # fmt: skip
    for number, text in enumerate(texts):
        before = desk.text
        desk.page.locator(f".handle[aria-label='{text}']").focus()
        desk.page.keyboard.press("ArrowUp" if number else "ArrowLeft")
        desk.page.keyboard.press("ArrowLeft")
        desk.page.keyboard.press("Shift+ArrowLeft")
        desk.page.wait_for_timeout(900)
        assert desk.text != before, text
        for _ in range(3):  # one step, or one for each press where they come slowly
            if desk.text != before:
                desk.page.keyboard.press("Control+z")
                desk.settle()
        assert desk.text == before
    desk.check()


def test_the_slider_of_the_tool_moves_the_picture_and_the_findings(browser, tmp_path, artefacts):
    desk = Desk(browser, tmp_path, BLOCK, start="X40. Z0.", tool="R0.8, tip 3", side="right")
    row = desk.page.locator(".row[data-word='tool']")
    desk.page.locator(".row[data-word='tool'] .range", has_text="R ≤ 5").wait_for()
    assert not row.locator("button.free").is_visible()
    assert desk.page.locator(".paper .s-track").count() > 0
    desk.page.screenshot(path=artefacts / "touch-tool.png")
    row.locator("input.value").fill("6")
    row.locator("input.value").press("Enter")
    desk.page.locator(".finding.error").wait_for()
    assert "(contoursolve tool: R6, tip 3)" in desk.text
    assert desk.page.locator(".paper .s-track").count() == 0
    desk.page.screenshot(path=artefacts / "touch-tool-large.png")
    desk.page.locator("button.fix", has_text="write P6. for P5.").click()
    desk.page.locator(".paper .s-track").first.wait_for(state="attached")
    row.locator("input[type=range]").focus()
    desk.page.keyboard.press("ArrowLeft")
    desk.page.wait_for_timeout(900)
    assert "R5.9" in desk.text
    desk.check()
    desk.page.close()


def test_a_pinned_word_stays(desk):
    desk.page.locator(".row[data-word='K'] button.pin").click()
    desk.settle()
    assert desk.page.locator(".handle[aria-label='V1: changes A']").count() == 1
    desk.drag("V2", (30, 30))
    desk.page.mouse.up()
    desk.settle()
    assert "K-30." in desk.text
    assert "X100." not in desk.text
    desk.check()


def test_each_fix_and_each_solution_has_a_ghost_and_a_click_takes_it(browser, tmp_path, artefacts):
    for text, options, count in (
        ("G111 X100. A180. K-30. B120. P60. Q5.", {"start": "X40. Z0."}, 2),
        ("G111 X100. A180. K-30. B? P5. Q5. Z-50.", {"start": "X40. Z0."}, 1),
        ("G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87", {"rules": "off"}, 4),
    ):
        desk = Desk(browser, tmp_path, text, **options)
        buttons = desk.page.locator("button.fix, .solutions button")
        assert buttons.count() >= count, text
        for number in range(buttons.count()):
            buttons.nth(number).hover()
            desk.page.locator(".ghosts path").first.wait_for(state="attached")
            assert desk.text == text
            desk.page.mouse.move(5, 5)
            assert desk.page.locator(".ghosts path").count() == 0
        buttons.first.hover()
        desk.page.locator(".ghosts path").first.wait_for(state="attached")
        desk.page.screenshot(path=artefacts / f"touch-ghost-{count}.png")
        promised = desk.page.locator(".hint").inner_text()
        buttons.first.click()
        desk.settle()
        assert desk.text.split() == promised.split()
        assert desk.talk.exploration.answer.contour is not None
        desk.check()
        desk.page.close()


def test_a_fix_that_asks_for_a_word_leads_to_its_field(desk):
    desk.page.locator("button[aria-label='free X']").click()
    desk.page.locator("button.fix", has_text="add Z?").click()
    desk.settle()
    field = desk.page.locator(".row[data-word='Z'] input.value")
    assert field.evaluate("input => input === document.activeElement")
    assert field.input_value() == "-47.321"
    desk.page.keyboard.press("Enter")
    desk.settle()
    assert "Z-47.321" in desk.text
    field.fill("-60")
    field.press("Enter")
    desk.settle()
    assert desk.talk.state["view"]["status"]["text"] == "solved"
    assert "Z-60." in desk.text
    desk.check()


def test_what_is_pointed_at_is_lit_wherever_it_stands(browser, tmp_path):
    desk = Desk(browser, tmp_path, "G111 X100. A180. K-30. B120. P60. Q5.", start="X40. Z0.")
    page = desk.page
    kind = "node.className.baseVal === undefined ? node.classList[0] : 'svg'"
    lit = f"nodes => [...new Set(nodes.map(node => {kind}))].sort()"
    for selector in (".paper text[data-word~='P']", ".row[data-word='P'] .word"):
        page.locator(selector).first.hover()
        assert page.locator(".lit[data-word~='P']").evaluate_all(lit) == ["finding", "handle", "row", "svg"]
        assert page.locator(".row[data-word='A'].lit").count() == 0
    page.locator(".finding pre").first.hover()
    assert page.locator(".row.lit").evaluate_all("rows => rows.map(row => row.dataset.word)") == ["P"]
    desk.check()
    page.close()


def test_a_kernel_that_is_gone_is_said_within_two_seconds(desk):
    desk.page.evaluate("window.isSilent = true")
    desk.page.locator("button.free[aria-label='free A']").click()
    trouble = desk.page.locator(".trouble", has_text="Python has not answered")
    trouble.wait_for(timeout=10_000)  # two seconds, and what a busy machine adds
    assert float(desk.page.locator(".desk").evaluate("desk => getComputedStyle(desk).opacity")) < 0.6
    desk.check()


def test_a_corner_that_does_not_fit_is_pulled_back(browser, tmp_path):
    desk = Desk(browser, tmp_path, BLOCK.replace("P5.", "P60."), start="X40. Z0.")
    desk.page.locator(".row[data-word='P'] .range", has_text="0 ≤ P ≤ 51.961").wait_for()
    desk.drag("P", (-40, 70))
    assert desk.talk.state["view"]["status"]["text"] == "solved", desk.text
    desk.page.mouse.up()
    desk.check()
    desk.page.close()


@pytest.mark.parametrize(
    ("text", "options", "scheme"),
    [
        (BLOCK, {"start": "X40. Z0."}, "light"),
        (BLOCK.replace("P5.", "P60."), {"start": "X40. Z0."}, "dark"),
        (BLOCK.replace("X100.", "X?"), {"start": "X40. Z0."}, "light"),
        ("G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87", {"rules": "off"}, "dark"),
    ],
)
def test_the_explorer_is_accessible(axe, browser, tmp_path, text, options, scheme):
    desk = Desk(browser, tmp_path, text, scheme, **options)
    if desk.page.locator("summary").first.is_visible():
        desk.page.locator("summary").first.click()
    assert axe(desk.page) == []
    desk.page.set_viewport_size({"width": 390, "height": 900})
    assert axe(desk.page) == []
    desk.page.close()


def test_an_angle_whose_centre_moves_with_it_is_where_the_pointer_is(browser, tmp_path):
    text = "G17 G90 G0 X0 Y0\nG1 #ANG=70\nX80 Y25 #ANG=-30"
    desk = Desk(browser, tmp_path, text, control="isg")
    (handle,) = [each for each in desk.talk.state["view"]["handles"] if each["name"] == "3:#ANG"]
    (x, y), (u, v) = handle["center"], handle["at"]
    turned = math.degrees(math.atan2(y - v + 12, u + 7 - x) - math.atan2(y - v, u - x))
    box = desk.page.locator(".stage").bounding_box()
    scale = box["width"] / desk.talk.state["view"]["frame"]["width"]
    desk.drag("3:#ANG", (7 * scale, -12 * scale), steps=3)
    desk.page.wait_for_timeout(300)
    field = next(each for each in desk.talk.state["view"]["fields"] if each["key"] == "3:#ANG")
    assert field["value"] == pytest.approx(-30 + turned, abs=5)
    desk.page.close()


def test_a_stop_comes_before_what_is_caught(desk):
    desk.page.locator(".row[data-word='B'] .range", has_text="B").wait_for()
    desk.drag("B", (-90, 40), steps=30)
    assert desk.talk.state["view"]["status"]["text"] == "solved", desk.text
    desk.page.mouse.up()
    desk.check()


def test_two_words_bring_a_point_along_the_arrow(desk):
    def place():
        # In mm: between two slow presses the picture may be fitted.
        view = desk.talk.state["view"]
        frame, at = view["frame"], view["handles"][2]["at"]
        return [(at[axis] - frame["origin"][axis]) / frame["scale"] for axis in (0, 1)]

    before = place()
    desk.page.locator(".handle[aria-label^='V2:']").focus()
    for _ in range(6):
        desk.page.keyboard.press("ArrowLeft")
    desk.settle()
    after = place()
    assert after[0] < before[0] - 0.8
    assert after[1] == pytest.approx(before[1], abs=0.1)
    desk.check()


def test_what_is_typed_in_the_block_is_never_forgotten(desk):
    box = desk.page.locator("textarea")
    box.focus()
    desk.page.keyboard.press("End")
    desk.page.keyboard.type(" ")
    desk.page.keyboard.press("Backspace")
    field = desk.page.locator(".row[data-word='K'] input.value")
    field.fill("-50")
    field.press("Enter")
    desk.settle()
    assert "K-50." in box.input_value()
    box.fill(f"{BLOCK}\n{BLOCK}")
    box.press("Enter")
    desk.page.locator(".state", has_text="one contour can be explored at a time").wait_for()
    assert box.input_value().count("G111") == 2
    desk.check()


def test_another_control_may_be_typed_where_nobody_chose_one(desk):
    text = "G18 G90 DIAMON\nG0 X20 Z0\nG1 ANG=150 CHR=2\nG1 X60 Z-80 ANG=180"
    box = desk.page.locator("textarea")
    box.fill(text)
    box.press("Enter")
    desk.settle()
    assert desk.talk.exploration.result.control == "siemens-840d"
    assert desk.talk.state["view"]["status"]["text"] == "solved"
    desk.check()


def test_sections_that_are_opened_show_the_equations_and_follow_each_word(desk, artefacts):
    assert desk.talk.state["sections"] == {}
    desk.page.locator("details.equations > summary").click()
    section = desk.page.locator("details.equations .content")
    section.locator("math").first.wait_for()
    assert "0.866" in section.inner_text()
    assert section.locator("math[alttext*='sin(B)']").count()
    section.locator("summary", has_text="Unknowns and values").click()
    field = desk.page.locator(".row[data-word='B'] input.value")
    field.fill("150")
    field.press("Enter")
    desk.page.wait_for_function("document.querySelector('details.equations').innerText.match(/B150[^]*\\b0\\.5\\b/)")
    assert section.locator("details", has_text="Unknowns and values").get_attribute("open") is not None
    desk.page.locator(".equations tr[data-word='B']").hover()
    assert "lit" in desk.page.locator(".row[data-word='B']").get_attribute("class")
    desk.page.locator("button[aria-label='free X']").click()
    section.locator("text=Still open").first.wait_for()
    desk.page.locator("button.undo").click()
    desk.page.locator("details.calculation > summary").click()
    desk.page.locator("details.calculation svg[aria-label^='triangle']").first.wait_for()
    desk.page.screenshot(path=artefacts / "sections.png", full_page=True)
    assert {*desk.talk.state["sections"]} == {"equations", "calculation"}
    desk.check()


@pytest.mark.parametrize(
    "order", [["number", "ghost", "view"], ["view", "number"], ["sections", "ranges", "view", "ghost"]], ids=" ".join
)
def test_whatever_part_of_an_answer_comes_first_all_of_it_is_shown(desk, order):
    desk.page.evaluate("order => (window.order = order)", order)
    desk.page.locator("details.equations > summary").click()
    for value, status in (("60", "cannot be cut"), ("9", "solved")):
        field = desk.page.locator(".row[data-word='P'] input.value")
        field.fill(value)
        field.press("Enter")
        desk.page.locator(".state strong", has_text=status).wait_for()
        desk.page.locator(".paper text", has_text=f"P{value}.").first.wait_for()
        assert desk.page.locator("textarea").input_value() == desk.text == BLOCK.replace("P5.", f"P{value}.")
        desk.page.locator(".row[data-word='P'] .range", has_text="0 ≤ P ≤ 51.961").wait_for()
    desk.page.locator("details.equations math").first.wait_for()
    desk.drag("V1", (-30, 0))
    desk.page.mouse.up()
    desk.settle()
    assert desk.page.locator("textarea").input_value() == desk.text != BLOCK.replace("P5.", "P9.")
    desk.check()
