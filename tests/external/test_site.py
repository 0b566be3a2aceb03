"""The documentation site: all of it is made, every link leads somewhere, and it asks no other host for anything."""

import re
import shutil
from html.parser import HTMLParser
from pathlib import Path
from types import ModuleType
from urllib.parse import unquote, urlsplit

import pytest

import contoursolve
from contoursolve.controls import DIALECTS

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


@pytest.mark.parametrize("control", DIALECTS)
def test_every_rule_stands_on_the_page_of_its_control_with_its_examples_and_grade(site, pages, control) -> None:
    page = pages[site / "rules" / f"{control}.html"]
    sections = dict(re.findall(r"\n([\w-]+)¶\n(.*?)(?=\n[\w-]+¶\n|\Z)", page.text, re.DOTALL))
    for rule in DIALECTS[control].rules:
        assert rule.code in page.anchors
        for part in (rule.title, rule.advice, str(rule.source), *rule.rejected, *rule.accepted):
            assert " ".join(part.split()) in " ".join(sections[rule.code].split()), rule.code


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
        page.wait_for_url("**/rules/yasnac-lx3.html*g111-corner-too-large")
        assert all(urlsplit(address).scheme in ("file", "data", "blob") for address in asked)
        browser.close()
