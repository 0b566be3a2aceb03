"""The page without Python in a real browser: Pyodide, python-flint and msgspec are those that readers load, numpy and
CasADi have stand-ins."""

import json
import re
import shutil
from pathlib import Path
from urllib.parse import parse_qs, urlsplit
from xml.etree import ElementTree

import pytest
from browsing import Watched
from distribution import make_distribution
from numpy_host import serving

from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration import begin

pytestmark = [pytest.mark.site, pytest.mark.browser, pytest.mark.slow]
LOADED = 100_000
"""ms. Python starts in 5 to 15 s; every operation of NumPy is a request here."""
TEXT = "{http://www.w3.org/2000/svg}text"
BLOCK, START = "G111 X100. A180. K-30. B120. P60. Q5.", "X40. Z0."


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


def shown(page) -> dict[str, str | list[str]]:
    """What the explorer shows of a contour."""
    explorer = page.locator(".contoursolve.explorer")
    said = page.locator("#said", has_text=re.compile("could not|Error"))
    explorer.locator("figure svg[role=img]").or_(said).wait_for(timeout=LOADED)
    assert not said.count(), said.inner_text()
    return {
        "text": explorer.locator("textarea").input_value(),
        "status": explorer.locator(".state strong").inner_text(),
        "findings": explorer.locator(".finding pre").all_text_contents(),
        "fixes": explorer.locator("button.fix").all_text_contents(),
        "picture": explorer.locator("figure svg[role=img] text").all_text_contents(),
    }


def told(view) -> dict[str, str | list[str]]:
    """The same of what Python says here."""
    findings = view["findings"]
    return {
        "text": view["text"],
        "status": view["status"]["text"],
        "findings": [
            "".join(f"{''.join(piece for piece, _ in line)}\n" for line in each["lines"]) for each in findings
        ],
        "fixes": [f"{fix['text']} [{fix['effect']}]" for each in findings for fix in each["fixes"]],
        "picture": ["".join(each.itertext()) for each in ElementTree.fromstring(view["picture"]).iter(TEXT)],
    }


def test_a_block_is_solved_in_the_browser_and_its_address_shows_the_same(axe, browser, address, artefacts) -> None:
    watched = Watched(browser, viewport={"width": 1300, "height": 1300})
    page = watched.page
    page.goto(address)
    assert axe(page) == []
    # Before anybody asks for Python, none of it is loaded.
    assert not [each for each in watched.asked if "pyodide" in each or each.endswith((".zip", ".whl"))]
    assert "cdn.jsdelivr.net" in page.locator("article").inner_text()
    page.get_by_role("textbox", name="Block").fill(BLOCK)
    page.keyboard.press("Tab")
    page.keyboard.press("ControlOrMeta+a")
    page.keyboard.type(START)
    page.keyboard.press("Enter")
    found = shown(page)
    # In full depth: what is found here is found there.
    conversation = Conversation(begin(BLOCK, start=START))
    assert found == told(conversation.state["view"])
    assert found["fixes"]

    other = Watched(browser, color_scheme="dark")
    other.page.goto(page.url)
    assert shown(other.page) == found
    assert axe(other.page) == []
    other.page.screenshot(path=artefacts / "page-dark.png", full_page=True)
    other.check()
    other.page.close()

    page.locator("button.fix").first.click()
    page.wait_for_function(
        "before => document.querySelector('.explorer textarea').value !== before", arg=BLOCK, timeout=LOADED
    )
    wanted = told(conversation.answer({"do": "fix", "finding": 0, "fix": 0})["view"])
    assert shown(page) == wanted
    fixed = wanted["text"]
    page.wait_for_url(lambda url: parse_qs(urlsplit(url).fragment) == {"block": [fixed], "start": [START]})
    page.screenshot(path=artefacts / "page.png", full_page=True)
    watched.check()
    page.close()


def test_without_pyodide_the_page_says_what_to_do_and_may_be_asked_again(browser, address) -> None:
    page = browser.new_page()
    page.route("**/pyodide/**", lambda route: route.abort())
    page.goto(address)
    button = page.get_by_role("button", name="Load Python")
    button.click()
    page.get_by_text("Python could not be loaded").wait_for(timeout=LOADED)
    assert button.is_enabled()
    assert "online" in page.locator("#said").inner_text()
    page.close()
