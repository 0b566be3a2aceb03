"""The page without Python, in a real browser: Pyodide, python-flint and msgspec as a reader loads them, and stand-ins for
numpy and CasADi."""

import json
import re
import shutil
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest
from distribution import make_distribution
from numpy_host import serve
from test_browser import FLAGS, Watched

from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration import begin

pytestmark = [pytest.mark.site, pytest.mark.browser, pytest.mark.slow]
LOADED = 100_000
"""ms. Python starts in 5 to 15 s; every operation of NumPy is a request here."""
BLOCK, START = "G111 X100. A180. K-30. B120. P60. Q5.", "X40. Z0."


@pytest.fixture(scope="module")
def browser():
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - skipped without it

    with sync_playwright() as play:
        program = shutil.which("chromium") or shutil.which("chromium-browser")
        found = play.chromium.launch(executable_path=program, args=FLAGS)
        yield found
        found.close()


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
    server = serve(served, pyodide=make_distribution(Path(core), folder / "pyodide"))
    yield f"http://127.0.0.1:{server.server_port}/try.html"
    server.shutdown()


def shown(page) -> dict[str, str]:
    """What the explorer shows of a contour."""
    explorer = page.locator(".contoursolve.explorer")
    said = page.locator("#said", has_text=re.compile("could not|Error"))
    explorer.locator("figure svg").or_(said).wait_for(timeout=LOADED)
    assert not said.count(), said.inner_text()
    parts = {"state": ".state", "findings": ".findings", "picture": "figure"}
    texts = {name: explorer.locator(selector).text_content() for name, selector in parts.items()}
    return {**texts, "text": explorer.locator("textarea").input_value()}


def test_a_block_is_solved_in_the_browser_and_its_address_shows_the_same(browser, address, request) -> None:
    watched = Watched(browser, viewport={"width": 1300, "height": 1300})
    page = watched.page
    page.goto(address)
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
    view = conversation.state["view"]
    assert found["state"].startswith(view["status"]["text"])
    told = "".join("".join(piece for piece, _ in line) for each in view["findings"] for line in each["lines"])
    assert "".join(told.split()) in "".join(found["findings"].split())
    assert re.sub(r"<[^>]*>|\s", "", view["picture"]) == "".join(found["picture"].split())

    other = Watched(browser)
    other.page.goto(page.url)
    assert shown(other.page) == found
    other.check()
    other.page.close()

    page.locator("button.fix").first.click()
    page.locator(".finding.error").wait_for(state="detached", timeout=LOADED)
    fixed = conversation.answer({"do": "fix", "finding": 0, "fix": 0})["view"]["text"]
    assert shown(page)["text"] == fixed != BLOCK
    assert parse_qs(urlsplit(page.url).fragment) == {"block": [fixed], "start": [START]}
    if folder := request.config.getoption("--screenshots"):
        page.screenshot(path=Path(folder) / "page.png", full_page=True)
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
