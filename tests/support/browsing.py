"""A browser that a test watches: it asks nobody but this machine."""

import shutil
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from serving import SECONDS

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
FLAGS = [
    "--no-sandbox",  # as root in a container
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]


def launched(*flags):
    """A browser with more flags, until a fixture that yields from this ends."""
    from playwright.sync_api import sync_playwright  # noqa: PLC0415 - skipped without it

    with sync_playwright() as play:
        found = play.chromium.launch(executable_path=CHROMIUM, args=[*FLAGS, *flags])
        yield found
        found.close()


@pytest.fixture(scope="module")
def browser():
    yield from launched()


@pytest.fixture
def artefacts(request, tmp_path):
    folder = Path(request.config.getoption("--screenshots") or tmp_path)
    folder.mkdir(parents=True, exist_ok=True)
    return folder


VIOLATIONS = "async () => (await axe.run()).violations.map(each => [each.id, each.nodes.map(node => node.html)])"


@pytest.fixture
def axe(request):
    """Tells which rules of axe-core a page breaks, and where."""
    script = request.config.getoption("--axe")
    if not script:
        pytest.skip("--axe names axe.min.js of axe-core, to hold the page against its rules")

    def violations(page):
        page.evaluate(Path(script).read_text(encoding="utf-8"))
        return page.evaluate(VIOLATIONS)

    return violations


class Watched:
    """A page of the browser; afterwards it has asked nobody but this machine, and complained about nothing."""

    def __init__(self, browser, **options):
        self.page = browser.new_page(**options)
        self.page.set_default_timeout(SECONDS * 1000)
        self.asked, self.complaints = [], []
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.on("websocket", lambda channel: self.asked.append(channel.url))
        self.page.on("console", lambda line: self.complaints.append(line.text) if line.type == "error" else None)
        self.page.on("pageerror", lambda error: self.complaints.append(str(error)))

    def check(self):
        strangers = [
            url
            for url in self.asked
            if urlsplit(url).scheme not in ("data", "blob", "file", "about") and urlsplit(url).hostname != "127.0.0.1"
        ]
        assert strangers == []
        assert self.complaints == []
        assert self.asked
