"""The contour editor of the workbench in a real browser: contours of drawings are built by keyboard alone."""

import re
from decimal import Decimal
from pathlib import Path

import pytest
from served_page import expect, said

import contoursolve
from contoursolve.sketches import plain_sketch, read_sketch

pytestmark = [pytest.mark.browser, pytest.mark.needs("starlette", "uvicorn")]
SKETCHES = Path(__file__).parents[1] / "sketches"
CONTROLS = {"turned": ("yasnac-lx3", "fanuc-lathe", "haas-lathe"), "milled": ("nct-99m", "heidenhain", "fanuc-mill")}
WAY = """([number, field]) => {
  const place = number ? `[data-number="${number}"]` : ".chain-head";
  const wanted = [...document.querySelectorAll(`${place} :is([data-field], button, summary)`)]
    .find(each => (each.dataset.field ?? each.textContent) === field);
  if (wanted === document.activeElement) return "";
  const isBehind = document.activeElement.compareDocumentPosition(wanted) & Node.DOCUMENT_POSITION_FOLLOWING;
  return isBehind ? "Tab" : "Shift+Tab";
}"""

MOST_TABS = 200


class Keyboard:
    """The keyboard of a page: goes to fields by the tab key, and fills them in."""

    def __init__(self, page):
        self.page, self.press, self.type = page, page.keyboard.press, page.keyboard.type

    def go(self, number, field):
        for _ in range(MOST_TABS):
            key = self.page.evaluate(WAY, [number, field])
            if not key:
                return
            self.press(key)
        raise AssertionError(f"no tab leads to {field} of {number}")

    def fill(self, number, field, text):
        self.go(number, field)
        self.press("Control+a")
        self.type(str(text))

    def choose(self, number, field, text):
        self.go(number, field)
        self.type(text)

    def build(self, plain):
        """Build the sketch of a table."""
        self.choose(0, "part", plain["part"].capitalize())
        if plain.get("unit") == "inch":
            self.choose(0, "unit", "inch")
        if plain.get("closed"):
            self.go(0, "closed")
            self.press("Space")
        for axis, value in plain["start"].items():
            self.fill(0, f"start.{axis}", value)
        if plain.get("facts") or plain.get("pole"):
            self.go(0, "More")
            self.press("Enter")
            for axis, value in plain.get("pole", {}).items():
                self.fill(0, f"pole.{axis}", value)
            self.fill(0, "facts", "\n".join(plain.get("facts", ())))
        for number, each in enumerate(plain["element"], 1):
            self.press("Control+Enter" if each["kind"] == "line" else "Control+Shift+Enter")
            self.element(number, dict(each))

    def element(self, number, each):
        del each["kind"]
        turn = each.pop("turn", None)
        if turn:
            self.choose(number, "turn", {"cw": "Clock", "ccw": "Counter"}[turn])
        if each.pop("tangent", False):
            self.go(number, "tangent")
            self.press("Space")
        corner, guess, facts = (each.pop(name, {}) for name in ("corner", "guess", "facts"))
        for shape, size in corner.items():
            self.choose(number, "shape", shape.capitalize())
            self.fill(number, "corner", size)
        usual = {"X", "Y", "Z", "AN", "LEN", "R", "CCX", "CCY", "CCZ"} - ({"AN", "LEN"} if turn else set())
        rest = {**{n: v for n, v in each.items() if n not in usual}, **{f"guess.{n}": v for n, v in guess.items()}}
        for name in usual & {*each}:
            self.fill(number, name, each[name])
        if rest or facts:
            self.go(number, "More")
            self.press("Enter")
        for name, value in rest.items():
            self.fill(number, name, value)
        if facts:
            self.fill(number, "facts", "\n".join(facts))


BUILT = "fk_cam fk_two_circles guessed_meeting milled_chord milled_distances turned_recess_inch turned_taper_by_length"
"""The fewest sketches that have every field of all."""


@pytest.mark.parametrize("path", [SKETCHES / f"{name}.toml" for name in BUILT.split()], ids=lambda path: path.stem)
def test_a_contour_is_built_by_keyboard_alone_and_written_for_three_controls(path, opened, folder) -> None:
    sketch = read_sketch(path.read_text(encoding="utf-8"))
    page = opened()
    page.get_by_role("button", name="New contour").press("Enter")
    page.locator("[data-field=part]").wait_for()
    keyboard = Keyboard(page)
    keyboard.build(plain_sketch(sketch))
    page.locator(".missing.done").wait_for()
    # Decimal commas are those of the reader: the file has points.
    keyboard.press("Control+Shift+s")
    page.get_by_label("Name in the folder").fill(path.name)
    keyboard.press("Enter")
    said(page, f"Saved as {path.name}.")
    assert read_sketch((folder / path.name).read_text(encoding="utf-8")) == sketch
    page.get_by_role("tab", name="Words").click()
    is_milled = sketch.part == "milled"
    expect(page.locator(f"option[value={CONTROLS['turned' if is_milled else 'milled'][0]}]")).to_have_count(1)
    for control in CONTROLS[sketch.part]:
        page.get_by_label("Write it for").select_option(control)
        # Two controls may have the same words: until the new ones are there, those before are the other control's.
        expect(page.get_by_text("Writing \N{HORIZONTAL ELLIPSIS}")).to_have_count(0)
        wanted = contoursolve.write(sketch, control).candidates
        expect(page.locator(".candidate pre")).to_have_text(["\n".join(each.lines) for each in wanted])
    expect(page.get_by_text("Tool, speed, feed, approach and retract are yours to add.")).to_be_visible()
    with page.expect_download() as got:
        page.locator(".candidate").first.get_by_role("button", name="Download").click()
    assert got.value.suggested_filename == f"{path.stem}-{control}.nc"


OPEN = """sketch = 1
part = "turned"
start = { Z = 0, X = 20 }
[[element]]
kind = "line"
AN = 180
[[element]]
kind = "line"
AN = 90
X = 60
"""


WRONG = {
    "open": ("", ""),
    "asked": ("AN = 180", 'AN = "?"'),
    "contradicting": ("AN = 180", "AN = 180\nZ = -30\nLEN = 20"),
    "twice": ("X = 60", "X = 60\nZ = -30\nLEN = 9"),
}


@pytest.mark.parametrize(("old", "new"), WRONG.values(), ids=WRONG)
def test_what_is_missing_or_wrong_is_said_as_python_says_it(old, new, opened, folder) -> None:
    text = OPEN.replace(old, new, 1)
    (folder / "wrong.toml").write_text(text, encoding="utf-8")
    page = opened()
    page.get_by_role("button", name="wrong.toml").click()
    page.locator(".card").first.wait_for()
    known = contoursolve.editing.sketch_view(read_sketch(text), with_ranges=True)
    expect(page.locator(".missing")).to_have_text(known["said"])
    states = [each["state"] for each in known["elements"] if not each["name"].startswith("corner")]
    for number, state in enumerate(states):
        expect(page.locator(".card").nth(number)).to_have_attribute("data-state", state)
    # The picture, its legend and the cards have one name for a state.
    chips = page.locator(".card .chip").all_inner_texts()
    told = [each["told"] for each in known["elements"] if not each["name"].startswith("corner")]
    assert [chip.partition(":")[0] for chip in chips] == told
    expect(page.locator(".entries button")).to_have_count(len(known["entries"]))


def test_a_value_that_is_no_number_is_marked_and_undone(opened) -> None:
    page = opened()
    page.get_by_role("button", name="New contour").click()
    page.get_by_role("button", name="Add a line").click()
    field = page.get_by_label("line 1: Length")
    field.fill("3O")
    page.locator(".missing.wrong").wait_for()
    page.wait_for_function("() => document.querySelector('[data-field=LEN]').getAttribute('aria-invalid') === 'true'")
    page.keyboard.press("Control+z")
    assert field.input_value() == ""
    page.keyboard.press("Control+z")
    page.locator(".card").wait_for(state="detached")
    page.keyboard.press("Control+y")
    page.locator(".card").wait_for()


SHAFT = """sketch = 1
part = "turned"
start = { Z = 0, X = 20 }
[[element]]
kind = "line"
Z = -30
X = 20
"""


def test_an_entry_that_cannot_be_read_marks_picture_and_cards_and_is_not_saved(opened, folder) -> None:
    (folder / "shaft.toml").write_text(SHAFT, encoding="utf-8")
    page = opened()
    page.get_by_role("button", name="shaft.toml", exact=True).click()
    expect(page.locator(".missing")).to_have_text("the contour is finished")
    card, picture, trouble = page.locator(".card"), page.locator(".chain-picture"), page.locator(".trouble")
    for wrong in ("thirty", "-99999999999", "15*2"):
        page.get_by_label("line 1: End X").fill(wrong)
        page.locator(".missing.wrong", has_text="line 1: X").wait_for()
        expect(card).to_have_attribute("data-state", "unchecked")
        expect(card.locator(".chip")).to_have_text("not checked")
        expect(picture.get_by_text("Not up to date")).to_be_visible()
    head = page.locator(".head").bounding_box()
    for keys in ("Control+s", "Control+Shift+s"):
        # A message moves nothing, and Escape closes it.
        page.keyboard.press("Escape")
        expect(trouble).to_be_hidden()
        page.keyboard.press(keys)
        expect(trouble).to_have_text(re.compile("^Not saved. Mend this first: line 1: X"))
        expect(page.get_by_role("dialog")).to_have_count(0)
        assert page.locator(".head").bounding_box() == head
        assert (folder / "shaft.toml").read_text(encoding="utf-8") == SHAFT
    page.get_by_role("tab", name="Words").click()
    expect(page.locator(".candidate")).to_have_count(0)
    expect(page.locator(".result.words > [role=status]")).to_contain_text("line 1: X")
    page.get_by_label("line 1: End X").fill("30,5")
    expect(trouble).to_be_empty()
    expect(card).to_have_attribute("data-state", "known")
    expect(page.locator(".candidate").first).to_contain_text("30.5")
    page.keyboard.press("Control+s")
    said(page, "Saved as shaft.toml.")
    assert read_sketch((folder / "shaft.toml").read_text(encoding="utf-8")).elements[0].words["X"] == Decimal("30.5")


def test_the_keys_stay_in_the_editor_whatever_is_made_anew(opened, folder) -> None:
    (folder / "wrong.toml").write_text(OPEN.replace("AN = 180", "AN = 180\nZ = -30\nLEN = 20"), encoding="utf-8")
    page = opened()
    page.get_by_role("button", name="wrong.toml", exact=True).click()
    page.locator(".chain-findings .fixes button").first.press("Enter")
    expect(page.locator(".missing")).to_have_text("the contour is finished")
    for keys in ("Alt+Delete", "Control+z", "Control+z", "Control+y", "Control+Enter", "Alt+ArrowUp", "Alt+Delete"):
        assert page.evaluate("document.activeElement.closest('.pane.chain') !== null"), keys
        page.keyboard.press(keys)
    page.get_by_role("button", name="Guess by touch").press("Enter")
    page.keyboard.press("Escape")
    expect(page.get_by_role("button", name="Guess by touch")).to_have_attribute("aria-pressed", "false")


def test_the_sense_of_a_new_arc_is_asked_for_and_is_no_error(opened) -> None:
    page = opened()
    page.get_by_role("button", name="New contour").click()
    page.get_by_role("button", name="Add a line").click()
    page.get_by_role("button", name="Add an arc").click()
    expect(page.locator(".missing")).to_have_text("the sense of arc 2 is missing: clockwise or counter-clockwise")
    expect(page.locator(".chain-findings .error")).to_have_count(0)
    page.get_by_role("button", name="Sense of arc 2").click()
    expect(page.get_by_label("arc 2: sense")).to_be_focused()
    page.keyboard.type("Clock")
    expect(page.locator(".missing")).to_contain_text("are missing")


def test_new_contours_begin_with_their_picture_and_have_names_of_their_own(opened) -> None:
    page = opened()
    for number in range(3):
        if number:
            page.get_by_role("tab", name="Words").click()
            page.get_by_role("button", name="File").click()
            page.get_by_role("menuitem", name="New contour").click()
        else:
            page.get_by_role("button", name="New contour").click()
        expect(page.get_by_role("tab", name="Drawing")).to_have_attribute("aria-selected", "true")
    expect(page.locator(".programs [role=tab]")).to_have_text(["new contour", "new contour 2", "new contour 3"])


def test_a_card_stays_as_high_whatever_its_state(opened, folder) -> None:
    wrong = SHAFT.replace("X = 20\n", "X = 20\nLEN = 99\n")
    (folder / "slant.toml").write_text(wrong + SHAFT.partition("[[")[1] + SHAFT.partition("[[")[2], encoding="utf-8")
    page = opened()
    page.get_by_role("button", name="slant.toml").click()
    first, second = page.locator(".card").nth(0), page.locator(".card").nth(1)
    expect(first.locator(".chip")).to_contain_text("contradicts the rest: off by")
    high = first.bounding_box()["height"]
    page.get_by_label("line 1: Length").fill("")
    expect(first.locator(".chip")).to_have_text("known")
    assert first.bounding_box()["height"] == high
    # Before the first element is nothing to which it could be tangent.
    expect(first.get_by_text("tangent")).to_be_hidden()
    expect(second.get_by_text("tangent to the one before")).to_be_visible()


def test_the_picture_of_a_sketch_can_be_read_on_a_phone_and_be_enlarged(opened, folder) -> None:
    (folder / "shaft.toml").write_text(SHAFT, encoding="utf-8")
    page = opened(screen="phone")
    page.get_by_role("button", name="shaft.toml", exact=True).click()
    page.get_by_role("tab", name="Drawing").click()
    text = page.locator(".chain-picture svg text").first
    text.wait_for()
    # At first all of it is in sight.
    is_whole = "box => box.scrollWidth <= box.clientWidth"
    assert page.locator(".chain-picture .canvas").evaluate(is_whole)
    page.get_by_role("button", name="Larger").click()
    small = text.bounding_box()["height"]
    assert small >= READABLE
    for _ in range(2):
        page.get_by_role("button", name="Larger").click()
    assert text.bounding_box()["height"] > 1.9 * small
    page.get_by_role("button", name="Whole").click()
    assert page.locator(".chain-picture .canvas").evaluate(is_whole)


def test_what_is_said_of_an_older_sketch_is_marked_until_the_new_one_is_worked_out(opened, folder) -> None:
    (folder / "open.toml").write_text(OPEN, encoding="utf-8")
    page = opened()
    page.get_by_role("button", name="open.toml", exact=True).click()
    pane, said_above = page.locator(".pane.chain"), page.locator(".missing")
    expect(said_above).to_contain_text("one entry is missing")
    expect(pane).not_to_have_class(re.compile("waiting"))
    held = []
    page.route("**/ask", lambda route: held.insert(0, route))
    with page.expect_request("**/ask"):
        page.get_by_label("line 1: End Z").fill("-30")
    expect(pane).to_have_class(re.compile("waiting older"))
    expect(said_above).to_have_css("opacity", "0.35")
    with page.expect_request("**/ask"):
        held.pop().continue_()
    expect(pane).to_have_class(re.compile("waiting$"))
    held.pop().continue_()
    expect(pane).not_to_have_class(re.compile("waiting"))
    expect(said_above).to_have_text("the contour is finished")
    expect(said_above).to_have_css("opacity", "1")


def test_a_guess_says_of_which_place_it_is(opened) -> None:
    page = opened()
    page.get_by_role("button", name="New contour").click()
    page.get_by_role("button", name="Add an arc").click()
    page.get_by_role("button", name="More of arc 1").click()
    for place in ("end, Z", "end, X", "centre, Z", "centre, X"):
        page.get_by_label(f"arc 1: guess of its {place}", exact=True).wait_for()


READABLE = 11
"""Pixels of the box of a line of text."""


@pytest.mark.parametrize("screen", ["desktop", "phone, dark"])
def test_every_view_of_the_editor_can_be_reached_and_read(screen, axe, opened, folder, artefacts) -> None:
    (folder / "axe.toml").write_text(OPEN, encoding="utf-8")
    page = opened(screen=screen)
    page.get_by_role("button", name="axe.toml").click()
    page.locator(".missing:not(:empty)").wait_for()
    assert axe(page) == []
    for tab in page.locator(".pane.chain .views button").all():
        tab.click()
        assert axe(page) == []
        page.screenshot(path=artefacts / f"chain-{screen.replace(', ', '-')}-{tab.inner_text()}.png")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
