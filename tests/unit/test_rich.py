"""Records in notebooks: text, HTML and SVG of any block, whatever stands in it."""

import random
import re
import subprocess
import sys
from base64 import b64decode
from html.parser import HTMLParser
from xml.etree import ElementTree

import pandas
import pytest
from fuzzing import NAMED, examples, mutate

import contoursolve
from contoursolve import CONTROLS, families
from contoursolve.solving import ArcSegment

LARGEST = 400_000
"""Characters of one kind of data of one block."""

TEXT, HTML, SVG = "text/plain", "text/html", "image/svg+xml"
HOSTILE = (
    "<script>alert(1)</script>",
    "</style><img src=x onerror=alert(1)>",
    "]]> &amp; \" ' --> <!-- </svg>",
    "\u202e\ufeff\x07\x1b[31m\x00",
    "javascript:alert(1) {{7*7}} %s ${x}",
    "\U0001f600 \ud7ff \ufffe" * 40,
    "<" * 3000,
)
PICTURE = {*re.findall(r"\w+", "style svg title desc defs clippath rect g path polygon circle text tspan")}
TAGS = {
    *re.findall(r"\w+", "div section figure p pre code span h3 h4 details summary a img style"),
    *re.findall(r"\w+", "table caption thead tbody tr th td"),
}
IMAGE = "data:image/svg+xml;base64,"
WHOLE = "G111 X100. A180. K-30. B120. P5. Q5."
BROKEN = "N310 G111 A180. K-20. P4. B90. X66. D0.5"


class Page(HTMLParser):
    """What a browser makes of a text: its elements, its attributes, and the text between them."""

    VOID = ("br", "hr", "img", "input", "meta", "link")

    def __init__(self, text):
        super().__init__()
        self.tags, self.attributes, self.open, self.words = [], [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += attrs
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.tags.append(tag)
        self.attributes += attrs

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if not self.open or self.open[-1] != "style":
            self.words.append(data)

    def handle_comment(self, data):
        raise AssertionError(data)


def check(data, has_picture=None):
    """What holds for the data of any record."""
    assert data[TEXT]
    assert all(character == "\n" or character.isprintable() for character in data[TEXT]), data[TEXT]
    assert all(len(text) < LARGEST for text in data.values())
    page = Page(data[HTML])
    assert set(page.tags) <= TAGS
    assert [name for name, _ in page.attributes if name.startswith("on")] == []
    links = [value for name, value in page.attributes if name in ("href", "src", "xlink:href")]
    images = [b64decode(link.removeprefix(IMAGE)).decode() for link in links if link.startswith(IMAGE)]
    assert len(images) == page.tags.count("img")
    assert all(link.startswith(("#", IMAGE)) for link in links)
    assert not re.search(r"https?://(?!www\.w3\.org/2000/svg)", "".join(value or "" for _, value in page.attributes))
    assert data[HTML].count("<table") or not has_picture
    for drawn in {*images, data.get(SVG, "")} - {""}:
        root = ElementTree.fromstring(drawn)
        names = {element.tag.rpartition("}")[2].lower() for element in root.iter()}
        assert names <= PICTURE
        spoken = root.get("aria-labelledby").split()
        by_name = {element.get("id"): element.text for element in root.iter()}
        assert all(by_name[name].strip() for name in spoken)
    if has_picture:
        assert data[SVG] in images
    return page


@pytest.mark.parametrize("seed", range(10))
def test_any_block_is_shown_as_text_html_and_svg_that_hold_nothing_but_what_they_should(seed):
    rng = random.Random(f"rich {seed}")
    for number in range(3):
        control = rng.choice(NAMED)
        text = rng.choice(examples(control))
        for _ in range(rng.randrange(3)):
            text = mutate(text, rng)
        text += f" ({re.sub('[()]', '', rng.choice(HOSTILE))}) (contoursolve: {rng.choice(('', HOSTILE[0]))})"
        rules = rng.choice(("enforce", "warn", "off"))
        result = contoursolve.solve(text, control=control, rules=rules, name=rng.choice(HOSTILE))
        for record in (result, *result.answers, *result.diagnostics[:2], result.program, *result.program.blocks):
            check(record._repr_mimebundle_(), has_picture=record in result.answers)
        if number == 0:
            again = contoursolve.solve(text, control=control, rules=rules, name=result.program.name)
            assert again._repr_mimebundle_() == result._repr_mimebundle_()


def test_a_record_that_is_printed_is_the_text_that_a_notebook_shows():
    result = contoursolve.solve(BROKEN, start="X60. Z-55.")
    (answer,) = result.answers
    solved = contoursolve.solve(WHOLE, start="X40. Z0.").answers[0]
    family = contoursolve.family(WHOLE, start="X40. Z0.", vary={"P": [1, 60]})
    shown = (result, answer, result.program, *result.diagnostics, answer.diagnosis, *result.program.blocks)
    for record in (*shown, solved.contour, family, CONTROLS["yasnac-lx3"].rules[0]):
        assert str(record) == record._repr_mimebundle_()[TEXT]
        assert f"{type(record).__name__}(" not in str(record)


def test_families_and_paths_show_themselves():
    family = contoursolve.family(WHOLE, start="X40. Z0.", vary={"A": range(150, 200, 5), "P": [1, 20, 60]})
    data = family._repr_mimebundle_()
    check(data, has_picture=True)
    assert "30 contours" in data[TEXT]
    alone = contoursolve.family(WHOLE, start="X40. Z0.", vary={"A": range(150, 200, 5)})._repr_mimebundle_()
    check(alone, has_picture=True)  # the contours
    contour = contoursolve.solve(WHOLE, start="X40. Z0.").answers[0].contour
    words = check(contour._repr_mimebundle_()).words
    assert {"-50.2073", "X dia [mm]", "100.0000"} <= {*words}  # as the control writes X
    slopes = contoursolve.sensitivity(WHOLE, start="X40. Z0.")
    (row,) = (line.split() for line in str(slopes).split("\n") if "V2 X" in line)
    assert (row[:4], slopes.slopes["V2 X"]["X"]) == (["V2", "X", "dia", "1.0000"], 1.0)


@pytest.mark.parametrize("control", CONTROLS)
def test_rules_show_themselves(control):
    for rule in CONTROLS[control].rules:
        told = check(rule._repr_mimebundle_()).words
        assert (rule.code in "".join(told), sum(each.startswith("Wrong") for each in told)) == (
            True,
            len(rule.told.rejected),
        )


QUESTIONS = {
    "range": lambda block, options: families.feasible(block, "P", **options),
    "region": lambda block, options: families.region(block, ("A", "P"), ((150, 210), (1, 60)), **options),
    "region of angles": lambda block, options: families.region(block, ("A", "B"), ((90, 270), (90, 200)), **options),
    "found": lambda block, options: families.find(block, "B", "end Z-50.", **options),
    "nearest": lambda block, options: families.find(block, "B", "end Z-50. X90.", **options),
    "tolerances": lambda block, options: families.tolerances(block, {"A": 0.1, "K": 0.02}, **options),
    "derivatives": lambda block, options: families.tolerances(block, **options),
    "sensitivity": lambda block, options: families.sensitivity(block, **options),
}


@pytest.mark.parametrize("name", QUESTIONS)
def test_what_is_asked_about_families_shows_itself_with_every_reason_and_value(name):
    ask = QUESTIONS[name]
    record = ask(f"{WHOLE} ({re.sub('[()]', '', HOSTILE[0])})", {"start": "X40. Z0."})
    data = record._repr_mimebundle_()
    page = check(data, has_picture=name.startswith("r"))
    assert {"table", "caption"} <= set(page.tags)
    assert ("figure" in page.tags) is name.startswith("r")
    # Every cell of the text is in the HTML, too.
    shown = " ".join(" ".join(page.words).split()).lower()
    for line in data[TEXT].lower().splitlines():
        for cell in re.split(r"  +", line.strip()):
            assert re.sub(r"^\d\. b ", "", cell).partition(": z")[0] in shown, cell


def test_ranges_and_regions_without_an_end_or_a_contour_are_drawn():
    options = {"start": "X40. Z0."}
    for record in (
        families.feasible(WHOLE, "P", within=(1, 2), **options),
        families.feasible(WHOLE, "P", within=(90, 99), **options),
        families.region(WHOLE, ("A", "P"), ((170, 180), (1, 2)), **options),
        families.region(WHOLE, ("A", "P"), ((170, 180), (90, 99)), **options),
        families.feasible("G111 X4. A180. K-1. B120. P.2", "P", start="X2. Z0.", units="inch"),
    ):
        data = record._repr_mimebundle_()
        check(data)
        assert SVG in data
        assert "figure" in Page(data[HTML]).tags


def test_what_cannot_be_drawn_is_told_and_what_cannot_be_made_is_left_out(monkeypatch):
    answer = contoursolve.solve(WHOLE, start="X40. Z0.").answers[0]

    def fail(*_, **__):
        raise RuntimeError("no")

    monkeypatch.setattr("contoursolve.pictures.drawing.compose", fail)
    data = answer._repr_mimebundle_()
    assert SVG not in data
    assert "cannot be drawn" in "".join(Page(data[HTML]).words)
    monkeypatch.setattr("contoursolve.notebook.records_html.html_of", fail)
    assert list(answer._repr_mimebundle_()) == [TEXT]
    monkeypatch.setattr("contoursolve.notebook.mime_bundle.text_of", fail)
    assert answer._repr_mimebundle_() == {TEXT: repr(answer)}


SHELL = """
from IPython.core.interactiveshell import InteractiveShell
import contoursolve
formatter = InteractiveShell.instance().display_formatter
result = contoursolve.solve("G111 A180. B120.", start="X40. Z0.")
print(*sorted(formatter.format(result)[0]))
formatter.active_types = ["text/plain"]
print(*formatter.format(result)[0])
"""


@pytest.mark.slow
def test_ipython_asks_for_all_kinds_and_a_terminal_for_text():
    done = subprocess.run([sys.executable, "-c", SHELL], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == [f"{SVG} {HTML} {TEXT}", TEXT]


def test_the_table_of_a_path_becomes_a_data_frame_with_units_in_its_names():
    contour = contoursolve.solve(WHOLE, start="X40. Z0.").answers[0].contour
    frame = pandas.DataFrame(contour.table())
    assert [*frame.columns] == [
        *("name", "kind", "start_Z_mm", "start_X_radius_mm", "end_Z_mm", "end_X_radius_mm"),
        *("center_Z_mm", "center_X_radius_mm", "radius_mm", "turn", "angle_deg", "sweep_deg", "length_mm"),
    ]
    start = contour.start
    for row, element in zip(frame.itertuples(), contour.elements, strict=True):
        assert (row.start_Z_mm, row.start_X_radius_mm) == start
        assert (row.end_Z_mm, row.end_X_radius_mm) == element.end
        start = element.end
        assert row.length_mm == element.length
        assert (row.kind == "arc") == isinstance(element, ArcSegment)
        if row.kind == "arc":
            found = row.center_Z_mm, row.center_X_radius_mm, row.radius_mm, row.turn
            assert found == (*element.center, element.radius, element.turn.value)
    mill = contoursolve.solve("G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1").answers[0].contour
    assert {"end_X_mm", "center_Y_mm"} <= set(pandas.DataFrame(mill.table()).columns)
