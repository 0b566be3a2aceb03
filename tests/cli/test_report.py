"""The report: one page that holds everything, loads nothing, and links both ways."""

import re
from html.parser import HTMLParser
from itertools import pairwise
from pathlib import Path

import pytest
from click.testing import CliRunner

import contoursolve
from contoursolve.cli import main
from contoursolve.output.report import report_page

PROGRAMS = sorted((Path(__file__).parents[2] / "notebooks" / "programs").glob("*.nc"))
BROKEN = next(path for path in PROGRAMS if path.stem == "shaft_broken")
HOSTILE = "</style><script>alert(1)</script><img src=x onerror=alert(1)> &amp; \" ' \u202e \x07"
VOID = ("meta",)


def run(*arguments, **options):
    done = CliRunner().invoke(main, ["report", *map(str, arguments)], **options)
    assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
    return done.exit_code, done.output


class Page(HTMLParser):
    """What a browser makes of the page."""

    def __init__(self, text):
        super().__init__()
        self.text, self.elements, self.open, self.words, self.marked = text, [], [], [], []
        self.feed(text)
        self.close()
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if "style" not in self.open:
            self.words.append(data)
        if self.elements and self.elements[-1][1].get("class", "").startswith("mark "):
            self.marked.append(data)

    def all(self, tag):
        return [attributes for each, attributes in self.elements if each == tag]

    @property
    def shown(self):
        return "".join(self.words)


@pytest.fixture(scope="module")
def broken():
    return contoursolve.solve(BROKEN)


def page_of(result):
    return Page("".join(report_page(result, "0")))


def test_the_page_is_made_of_headings_in_order(broken):
    page = page_of(broken)
    levels = [int(tag[1]) for tag, _ in page.elements if re.fullmatch("h[1-6]", tag)]
    assert levels.count(1) == 1
    assert all(after - before <= 1 for before, after in pairwise(levels))
    assert all(each.get("scope") for each in page.all("th"))
    assert page.elements[0] == ("html", {"lang": "en"})


def test_findings_that_say_the_same_are_one_and_right_contours_have_one_line():
    wrong = "G00 X40. Z0.\nG01 Z-10. ,R50.\nX60.\nG00 X100. Z0.\nG01 Z-10. ,R50.\nX120.\nG00 X40. Z50.\n"
    right = "G01 Z-20. ,R2.\nX90.\n"
    result = contoursolve.solve(wrong + right, control="fanuc-lathe")
    page = page_of(result)
    groups = [each for each in page.all("div") if (each.get("class") or "").startswith("group")]
    assert (len(result.answers), sum(each.is_error for each in result.diagnostics), len(groups)) == (3, 2, 1)
    assert "1 finding more of this kind, program line " in page.shown
    assert [each["id"] for each in page.all("article")] == ["contour-1", "contour-2"]
    assert "points-3" in page.text


def test_rows_and_findings_have_the_names_of_the_picture(broken):
    result, page = broken, page_of(broken)
    drawn = {name for _, each in page.elements for name in (each.get("data-word") or "").split()}
    rows = [each for each in page.all("tr") if each.get("data-word")]
    assert {each["data-word"] for each in rows} == drawn == {word for a in result.answers for word in a.claim.words}
    assert {f"#{each['id']}" for each in rows} <= {each["href"] for each in page.all("a")}
    found = [each for each in page.all("section") if each.get("data-finding")]
    shown = [each for each in result.answers if f'id="contour-{1 + result.answers.index(each)}"' in page.text]
    assert [*map(bool, (each.contour is None for each in shown))] == [True] * len(shown)
    assert len(found) == sum(len(answer.diagnostics) for answer in shown)
    (corner,) = (each for each in found if "P" in each.get("data-word", "").split())
    assert corner["data-finding"] == "1"
    for name in ('data-word~="P"', 'data-element="line\\20 1"', 'data-finding~="1"'):
        assert f".contoursolve article:has([{name}]:is(:hover,:focus-within,:target)) [{name}]" in page.text


def test_whatever_stands_in_the_program_is_text_on_the_page():
    inside = HOSTILE.replace("(", "[").replace(")", "]")
    text = f"G00 X40. Z0. ({inside})\nG111 X100. A180. K-30. B120. (contoursolve: {inside})\nQ1{HOSTILE}"
    page = page_of(contoursolve.solve(text, control="yasnac-lx3", name=f"{HOSTILE}.nc"))
    assert {"script", "img"}.isdisjoint(tag for tag, _ in page.elements)
    assert not any(name.startswith("on") for _, attributes in page.elements for name in attributes)
    assert "<script>alert" in page.shown
    assert "\x07" not in page.text


@pytest.mark.parametrize("text", ["", "%\n%", "G0 X1 Y1\nM30", "(nothing)"], ids=["empty", "marks", "moves", "comment"])
def test_a_program_without_a_contour_has_a_page(text):
    page = page_of(contoursolve.solve(text))
    assert "no contour" in page.shown


def test_the_command_writes_one_page_and_tells_by_its_status_whether_there_are_errors(tmp_path):
    target = tmp_path / "page.html"
    code, output = run(BROKEN, "-o", target)
    assert (code, output.splitlines()[-1]) == (1, f"{target} written")
    assert "5 errors, 3 warnings" in output
    code, output = run(BROKEN, "-o", target)
    assert (code, "give --force to replace it" in output) == (2, True)
    code, _ = run(PROGRAMS[0], "-o", target, "--force")
    assert code == 0
    assert PROGRAMS[0].name in target.read_text(encoding="utf-8")
    run("-", "-o", tmp_path / "c.html", input="G00 X40. Z0.\nG111 A180. B120.")
    assert "Contour 1, program line 2" in Page((tmp_path / "c.html").read_text(encoding="utf-8")).shown


@pytest.mark.parametrize(
    ("arguments", "message"),
    [(["x.nc", "-o", "x.pdf"], "x.pdf: pages end in .html"), (["-", "-o", "absent/x.html"], "is no directory")],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_what_cannot_be_done_is_said_in_a_line(tmp_path, monkeypatch, arguments, message):
    monkeypatch.chdir(tmp_path)
    code, output = run(*arguments, input="")
    assert code == 2
    assert message in output
    assert list(tmp_path.iterdir()) == []


def test_a_page_that_nobody_named_has_the_name_of_its_program(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, output = run(PROGRAMS[0])
    assert (code, output.splitlines()[-1]) == (0, f"{PROGRAMS[0].stem}.html written")
    assert run(PROGRAMS[0])[0] == 0
    page = tmp_path / f"{PROGRAMS[0].stem}.html"
    page.write_text("mine")
    assert "exists; give --force to replace it" in run(PROGRAMS[0])[1]
    assert page.read_text() == "mine"
    run("-", input="G00 X40. Z0.\nG111 X100. A180. K-30. B120.")
    assert {each.name for each in tmp_path.iterdir()} == {f"{PROGRAMS[0].stem}.html", "contour.html"}
