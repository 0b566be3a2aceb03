"""The documentation site: all of it is made, every link leads somewhere, and it asks no other host for anything."""

import re
import shutil
from html.parser import HTMLParser
from pathlib import Path
from types import ModuleType
from urllib.parse import unquote, urlsplit

import pytest

import contoursolve
from contoursolve.controls import CONTROLS

pytestmark = pytest.mark.site
OPEN_ROOTS = """
const attach = Element.prototype.attachShadow;
Element.prototype.attachShadow = function (options) { return attach.call(this, {...options, mode: "open"}); };
"""
"""For the browser: what the search finds stands in a part of the page that scripts cannot read otherwise."""
ROOT = Path(__file__).parents[2]


class Page(HTMLParser):
    """What a page has: anchors, links, what it loads, and its text."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.words: list[str] = []
        self.feed(path.read_text(encoding="utf-8"))
        self.text = "".join(self.words)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for name, value in attrs:
            if name == "id":
                self.anchors.add(value or "")
            elif name in ("href", "src", "srcset", "data") and value:
                (self.links if tag == "a" else self.loaded).append(value)

    def handle_data(self, data: str) -> None:
        self.words.append(data)


@pytest.fixture(scope="session")
def pages(site) -> dict[Path, Page]:
    return {path: Page(path) for path in site.rglob("*.html")}


def test_no_page_loads_anything_from_another_host(site, pages) -> None:
    assert len(pages) > len(list((ROOT / "docs").glob("*.md")))
    for path, page in pages.items():
        for link in page.loaded:
            assert not urlsplit(link).scheme.startswith("http"), path
            assert not link.startswith("//"), path
    for path in site.rglob("*.css"):
        assert not re.findall(r"(?:@import|url\()\s*[\"']?(?:https?:)?//[^)]*", path.read_text(encoding="utf-8")), path


def test_every_link_leads_to_a_file_of_the_site_and_to_an_anchor_in_it(site, pages) -> None:
    for path, page in pages.items():
        if path.name == "404.html":  # a server shows it at any address
            continue
        for link in page.links + page.loaded:
            address = urlsplit(link)
            if address.scheme:
                continue
            target = (path.parent / unquote(address.path)).resolve() if address.path else path
            assert target.is_file(), f"{path}: {link}"
            assert target.is_relative_to(site), f"{path}: {link}"
            anchor = unquote(address.fragment)
            assert not anchor or target not in pages or anchor in pages[target].anchors, f"{path}: {link}"


def sections(page: Page) -> dict[str, str]:
    return {name: " ".join(text.split()) for name, text in re.findall(SECTION, page.text, re.DOTALL)}


SECTION = r"\n([^\n]+)\u00b6\n(.*?)(?=\n[^\n]+\u00b6\n|\Z)"


@pytest.mark.parametrize("control", CONTROLS)
def test_every_rule_stands_on_a_page_of_its_control_with_its_examples_and_grade(site, pages, control) -> None:
    own = [pages[path] for path in sorted((site / "rules" / control).glob("*.html"))]
    told = {name: text for page in own for name, text in sections(page).items()}
    for rule in CONTROLS[control].catalogue:
        lines = [line[:100] for text in (*rule.rejected, *rule.accepted) for line in text.split("\n")]
        for part in (rule.title, rule.advice, str(rule.source), *lines):
            assert " ".join(part.split()) in told[f"{rule.code}, {CONTROLS[control].title}"], rule.code
    for row in CONTROLS[control].modes.lexicon.addresses.values():
        typed = {"ROUNDING": "RND R", "CHAMFER": "CHF"}.get(row.address, f"{row.address}=")
        text = next(text for name, text in told.items() if name.split(", ")[0] in (row.address, typed))
        assert row.meaning in text, row.address
        assert "Right" in text or "No contour of this control uses it" in text, row.address


@pytest.mark.parametrize("number", ["146", "055, PS0055", "21892", "402-0008", "10751", "P33"])
def test_an_alarm_number_leads_to_the_rules_behind_it(site, pages, number) -> None:
    assert re.search(r"[a-z]+-[a-z-]+, ", sections(pages[site / "rules" / "alarms.html"])[number])


def test_every_public_name_stands_in_the_reference(site, pages) -> None:
    public = {name for name in contoursolve.__all__ if not isinstance(getattr(contoursolve, name), ModuleType)}
    assert {f"contoursolve.{name}" for name in public} <= pages[site / "reference.html"].anchors


def test_a_notebook_shows_its_code_and_pictures(site, pages) -> None:
    page = pages[site / "notebooks" / "02_why_is_my_block_refused.html"]
    assert "contoursolve.solve(program)" in page.text
    assert sum(link.endswith(".svg") for link in page.loaded) >= 4


@pytest.mark.browser
def test_the_search_works_in_a_page_that_is_opened_as_a_file(site) -> None:
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - skipped without it

    with sync_playwright() as play:
        program = shutil.which("chromium") or shutil.which("chromium-browser")
        browser = play.chromium.launch(executable_path=program, args=["--no-sandbox", "--disable-gpu"])
        page = browser.new_page()
        asked: list[str] = []
        page.on("request", lambda request: asked.append(request.url))
        page.add_init_script(OPEN_ROOTS)
        page.goto((site / "rules" / "nct-99m.html").as_uri())
        page.keyboard.press("/")
        page.get_by_placeholder("Search").fill("g111 corner too large")
        page.get_by_role("option", name="g111-corner-too-large").first.click()
        page.wait_for_url("**/rules/yasnac-lx3/g111-corner-too-large.html*")
        titles = {each: each for each in (",R", "#500", "RND=", "RND R", "G111", "CHF=")}
        for word, title in {**titles, ",R0.4": ",R", "RND=5": "RND=", "B0": "B, B0"}.items():
            page.goto((site / "index.html").as_uri())
            page.keyboard.press("/")
            page.get_by_placeholder("Search").fill(word)
            found = page.get_by_role("option").filter(has_text=re.compile(f"^{re.escape(title)}"))
            found.first.wait_for()
            first = [page.get_by_role("option").nth(at).get_attribute("href") or "" for at in range(3)]
            assert any(re.search(r"words\.html.*-(word|variable)$", each) for each in first), (word, first)
        assert all(urlsplit(address).scheme in ("file", "data", "blob") for address in asked)
        browser.close()


@pytest.mark.browser
@pytest.mark.parametrize("width", [1280, 390])
def test_the_texts_of_pictures_are_at_least_9_px_high(site, width) -> None:
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - skipped without it

    with sync_playwright() as play:
        program = shutil.which("chromium") or shutil.which("chromium-browser")
        browser = play.chromium.launch(executable_path=program, args=["--no-sandbox", "--disable-gpu"])
        page = browser.new_page(viewport={"width": width, "height": 900})
        for name in ("rules/fanuc-lathe/words.html", "notebooks/02_why_is_my_block_refused.html"):
            page.goto((site / name).as_uri())
            shown = page.eval_on_selector_all("img[src$='.svg']", "all => all.map(img => [img.src, img.width])")
            assert len(shown) >= 4
            for source, wide in shown:
                drawn = Path(unquote(urlsplit(source).path)).read_text(encoding="utf-8")
                sizes = [float(size) for size in re.findall(r'font-size="([\d.]+)"', drawn)]
                assert min(sizes) * wide / float(re.search(r'viewBox="0 0 ([\d.]+)', drawn)[1]) >= 9, source
            assert page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0
        browser.close()
