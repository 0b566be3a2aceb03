"""The page without Python in a real browser: Pyodide, python-flint and msgspec are those that readers load, numpy and
CasADi have stand-ins."""

import json
import shutil
from base64 import urlsafe_b64decode
from pathlib import Path
from urllib.parse import parse_qs, quote, urlencode, urlsplit
from xml.etree import ElementTree

import pytest
from browsing import Watched
from distribution import make_distribution
from numpy_host import serving
from served_page import shown_fix

from contoursolve.controls import CONTROLS
from contoursolve.workbench import Desk

pytestmark = [pytest.mark.site, pytest.mark.browser, pytest.mark.slow]
LOADED = 100_000
"""ms. Python starts in 5 to 15 s; every operation of NumPy and CasADi is a request here."""
TEXT = "{http://www.w3.org/2000/svg}text"
CONTROL = "yasnac-lx3"
BLOCK = "G111 X100. A180. K-30. B120. P5. Q5."


@pytest.fixture(scope="module")
def address(request, site, tmp_path_factory):
    """The address of the page on a server of its own, which has a copy of Pyodide."""
    core = request.config.getoption("--pyodide")
    if core is None:
        (pytest.fail if request.config.getoption("--insist") else pytest.skip)("needs --pyodide")
    folder = tmp_path_factory.mktemp("page")
    served = Path(shutil.copytree(site, folder / "site"))
    sources = served / "try" / "sources.json"
    told = json.loads(sources.read_text(encoding="utf-8"))
    version = json.loads((Path(core) / "package.json").read_text(encoding="utf-8"))["version"]
    assert f"/v{version}/" in told["pyodide"]
    sources.write_text(json.dumps({**told, "pyodide": "/pyodide/"}), encoding="utf-8")
    with serving(served, pyodide=make_distribution(Path(core), folder / "pyodide")) as host:
        yield f"{host}/try.html"


def program_of(url) -> str:
    """The program in an address."""
    packed = parse_qs(urlsplit(url).fragment)["program"][0]
    return urlsafe_b64decode(packed + "=" * (-len(packed) % 4)).decode()


def begun(page) -> None:
    """Python has come, and the program is examined."""
    trouble = page.locator(".workbench .trouble:not(:empty)").first
    page.locator(".cm-line").first.or_(trouble).wait_for(timeout=LOADED)
    assert not trouble.count(), trouble.inner_text()


def shown(page) -> dict[str, str | list[str]]:
    """What the page shows of a program and its first contour."""
    begun(page)
    page.get_by_role("tab", name="Contour", exact=True).click()
    explorer = page.locator(".contoursolve.explorer")
    explorer.locator("figure svg[role=img]").wait_for(timeout=LOADED)
    return {
        "text": "\n".join(page.locator(".cm-line").all_inner_texts()).replace("\n\n", "\n"),
        "findings": page.locator(".view.program .findings li button.go > span:last-child").all_text_contents(),
        "fixes": page.locator(".view.program .findings .fixes button").all_text_contents(),
        "status": explorer.locator(".state strong").inner_text(),
        "picture": explorer.locator("figure svg[role=img] text").all_text_contents(),
    }


def told(desk, view, text) -> dict[str, str | list[str]]:
    """The same of what Python says here."""
    looked = desk.answer({"do": "look", "program": view["id"], "line": view["contours"][0]["line"]})["state"]["view"]
    return {
        "text": text.replace("\n\n", "\n"),
        "findings": [each["message"] for each in view["findings"]],
        "fixes": [shown_fix(fix) for each in view["findings"] for fix in each["fixes"]],
        "status": looked["status"]["text"],
        "picture": ["".join(each.itertext()) for each in ElementTree.fromstring(looked["picture"]).iter(TEXT)],
    }


def test_an_example_is_mended_in_the_browser_and_its_address_shows_the_same(axe, browser, address, artefacts) -> None:
    watched = Watched(browser, viewport={"width": 1300, "height": 1300})
    page = watched.page
    page.goto(address)
    assert page.locator(".start .examples button").all_text_contents() == [each.title for each in CONTROLS.values()]
    assert axe(page) == []
    # Before anybody asks for Python, none of it is loaded.
    assert not [each for each in watched.asked if "pyodide" in each or each.endswith((".zip", ".whl"))]
    assert "cdn.jsdelivr.net" in page.locator("article").inner_text()
    page.get_by_role("button", name=CONTROLS[CONTROL].title).click()
    found = shown(page)
    # In full depth: what is found here is found there.
    desk = Desk()
    view = desk.answer({"do": "open", "example": CONTROL})
    assert found == told(desk, view, view["text"])
    assert found["fixes"]

    other = Watched(browser, color_scheme="dark", viewport={"width": 390, "height": 844})
    other.page.goto(page.url)
    begun(other.page)
    assert axe(other.page) == []
    other.page.locator(".workbench").screenshot(path=artefacts / "page-dark.png")
    again = shown(other.page)
    assert {**again, "text": ""} == {**found, "text": ""}
    # A link of before holds a block and its start.
    old = urlencode({"block": BLOCK, "start": "X40. Z0.", "control": CONTROL}, quote_via=quote)
    other.page.goto(f"{address}#{old}")
    other.page.locator(".programs [role=tab]").nth(1).wait_for(timeout=LOADED)
    other.page.get_by_role("tab", name="Program", exact=True).click()
    assert other.page.locator(".cm-line").all_inner_texts() == ["G00 X40. Z0.", BLOCK]
    other.check()
    other.page.close()

    page.locator(".view.program .findings .fixes button").first.click()
    page.wait_for_function(
        "before => document.querySelector('#workbench').shadowRoot.querySelector('.cm-content').innerText !== before",
        arg=page.locator(".cm-content").inner_text(),
        timeout=LOADED,
    )
    mended = desk.answer({"do": "fix", "program": view["id"], "seq": view["seq"], "finding": 0, "fix": 0})
    (edit,) = mended["edits"]
    fixed = f"{view['text'][: edit['from']]}{edit['text']}{view['text'][edit['to'] :]}"
    page.wait_for_url(lambda url: program_of(url) == fixed)
    page.screenshot(path=artefacts / "page.png", full_page=True)
    watched.check()
    page.close()


def test_without_pyodide_the_page_says_what_to_do_and_may_be_asked_again(browser, address) -> None:
    page = browser.new_page()
    page.route("**/pyodide/**", lambda route: route.abort())
    page.goto(address)
    button = page.get_by_role("button", name=CONTROLS[CONTROL].title)
    button.click()
    page.get_by_text("Python could not be loaded").wait_for(timeout=LOADED)
    assert "online" in page.locator(".notice .trouble").inner_text()
    assert button.is_enabled()
    assert page.get_by_role("button", name="Try again").is_visible()
    page.close()
