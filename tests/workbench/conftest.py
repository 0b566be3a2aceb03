"""The workbench on a server process of its own, and its page on a screen."""

import pytest
from browsing import Watched
from served_page import SCREENS
from small_disk import SmallDisk
from test_server import Served


@pytest.fixture
def small_disk(tmp_path):
    disk = SmallDisk(tmp_path / "disk")
    yield disk
    disk.unmount()


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("parts")


@pytest.fixture(scope="module")
def served(folder):
    server = Served(folder, is_sliced=True)
    yield server
    server.end()


@pytest.fixture
def opened(browser, served):
    """Opens the workbench on a screen; afterwards the page has asked nobody but the server."""
    pages = []

    def open_page(program=None, screen="desktop", server=served):
        watched = Watched(browser, **SCREENS[screen])
        pages.append(watched)
        watched.page.goto(f"http://{server.host}:{server.port}/?token={server.token}")
        if program is not None:
            watched.page.get_by_role("button", name=program, exact=True).click()
            watched.page.locator(".cm-line").first.wait_for()
        return watched.page

    yield open_page
    for each in pages:
        each.check()
        each.page.close()
