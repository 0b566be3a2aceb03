"""A real browser: the explorer in JupyterLab, and the report in light and dark. Nothing leaves the machine."""

import json
import os
import re
import secrets
import socket
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from browsing import Watched
from serving import SECONDS, wait_for

import contoursolve
from contoursolve.diagnosis import status_text
from contoursolve.output import map_page

pytestmark = pytest.mark.browser

HOUSE = Path(contoursolve.__file__).parent.parent
PROGRAMS = HOUSE / "notebooks" / "programs"
BLOCK = "G111 X100. A180. K-30. B120. P5. Q5."
NOTEBOOK = HOUSE / "notebooks" / "01_first_contour.ipynb"


@contextmanager
def jupyterlab(folder):
    """The address of a JupyterLab with a home of its own."""
    home = folder / "home"
    settings = {
        # Otherwise it asks a server for news.
        "apputils-extension/notification": {"fetchNews": "false", "checkForUpdates": False},
        # All cells are on the page, also those that are not in sight.
        "notebook-extension/tracker": {"windowingMode": "none"},
    }
    for name, values in settings.items():
        file = home / "settings" / "@jupyterlab" / f"{name}.jupyterlab-settings"
        file.parent.mkdir(parents=True)
        file.write_text(json.dumps(values))
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    token = secrets.token_hex(16)
    own = {
        "HOME": home,
        "IPYTHONDIR": home / "ipython",
        "JUPYTER_CONFIG_DIR": home / "config",
        "JUPYTER_DATA_DIR": home / "data",
        "JUPYTER_RUNTIME_DIR": home / "runtime",
        "JUPYTERLAB_SETTINGS_DIR": home / "settings",
        "JUPYTERLAB_WORKSPACES_DIR": home / "workspaces",
        "JUPYTER_PREFER_ENV_PATH": "1",
        "JUPYTER_TOKEN": token,
        "PYTHONPATH": HOUSE,
    }
    command = [
        sys.executable, "-m", "jupyterlab", "--no-browser", "--allow-root", "--ServerApp.ip=127.0.0.1",
        f"--ServerApp.port={port}", "--ServerApp.port_retries=0", f"--ServerApp.root_dir={folder}",
        "--LabApp.expose_app_in_browser=True", "--LabApp.extension_manager=readonly",
    ]  # fmt: skip
    log = folder / "jupyterlab.log"
    environment = {**os.environ, **{name: str(value) for name, value in own.items()}}
    with log.open("wb") as output:
        server = subprocess.Popen(command, env=environment, stdout=output, stderr=output)
    try:
        wait_for(f"http://127.0.0.1:{port}/api/status?token={token}", server, log)
        yield lambda path: f"http://127.0.0.1:{port}/doc/tree/{path}?token={token}"
    finally:
        server.terminate()
        server.wait(SECONDS)


def write_notebook(path):
    """The first notebook, where there is one, with a result of our own; else one with the explorer."""
    kind = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None}
    document = {"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}
    texts = [f"import contoursolve\ncontoursolve.explore({BLOCK!r}, start='X40. Z0.')", BROKEN]
    if NOTEBOOK.exists():
        document, texts = json.loads(NOTEBOOK.read_text(encoding="utf-8")), [BROKEN]
    document["metadata"]["kernelspec"] = {"name": "python3", "display_name": "Python 3", "language": "python"}
    document["cells"] += [{**kind, "id": f"browser-{number}", "source": text} for number, text in enumerate(texts)]
    path.write_text(json.dumps(document), encoding="utf-8")


BROKEN = "contoursolve.solve('N310 G111 A180. K-20. P4. B90. X66. D0.5', start='X60. Z-55.')"
LOADED = "window.jupyterapp?.shell.currentWidget?.content?.widgets?.length > 0"
IDLE = "window.jupyterapp.shell.currentWidget.sessionContext.session?.kernel?.status === 'idle'"


@contextmanager
def opened(browser, notebook, width, height):
    """A page of JupyterLab with a notebook whose kernel waits; in the end, nothing may have gone wrong in it."""
    with jupyterlab(notebook.parent) as address:
        watched = Watched(browser, viewport={"width": width, "height": height})
        watched.page.goto(address(notebook.name))
        watched.page.wait_for_function(LOADED)
        watched.page.wait_for_function(IDLE)
        yield watched.page
        watched.check()
        watched.page.close()


DIFFERS = "([selector, before]) => document.querySelector(selector).innerHTML !== before"
READS = "([selector, value]) => document.querySelector(selector).value === value"
EXPLORER = ".contoursolve.explorer"


@pytest.mark.slow
def test_in_jupyterlab_a_slider_moves_the_path_and_a_finding_comes_and_goes(browser, tmp_path, artefacts):
    write_notebook(tmp_path / "explore.ipynb")
    with opened(browser, tmp_path / "explore.ipynb", 1400, 1500) as page:
        page.evaluate("window.jupyterapp.commands.execute('notebook:run-all-cells')")
        explorer = page.locator(".contoursolve.explorer").first
        explorer.locator(".paper svg").wait_for()
        page.locator(".jp-OutputArea-output .contoursolve .finding.error").first.wait_for()
        explorer.scroll_into_view_if_needed()
        before = explorer.locator(".paper").inner_html()
        page.screenshot(path=artefacts / "jupyterlab-solved.png")

        # Its range comes when nothing else is to do, and the slider then reaches beyond it.
        row = explorer.locator(".row", has=page.locator("input[type=range][aria-label^='P:']"))
        row.locator(".range", has_text="0 ≤ P ≤ 51.961").wait_for()
        assert row.locator(".band span").count() == 1
        slider = row.locator("input[type=range]")
        slider.focus()
        slider.press("PageUp")
        page.wait_for_function(DIFFERS, arg=[f"{EXPLORER} .paper", before])
        assert explorer.locator(".finding").count() == 0
        slider.press("End")
        finding = explorer.locator(".finding.error").first
        finding.wait_for()
        assert "does not fit" in finding.inner_text()
        page.screenshot(path=artefacts / "jupyterlab-refused.png")
        explorer.screenshot(path=artefacts / "explorer.png")
        slider.press("PageDown")
        finding.wait_for(state="detached")
        assert explorer.locator(".state").inner_text().startswith("solved")

        number = row.locator("input.value")
        kept = number.input_value()
        number.fill("")
        number.press("Enter")
        page.wait_for_function("([input, kept]) => input.value === kept", arg=[number.element_handle(), kept])
        number.fill("60")
        number.press("Enter")
        finding.wait_for()
        fix = explorer.locator("button.fix", has_text="write P51.961")
        fix.click()
        finding.wait_for(state="detached")
        assert "P51." in explorer.locator("textarea").input_value()

        explorer.locator("details.equations > summary").click()
        explorer.locator("details.equations tr[data-word='A'] math").first.wait_for()
        explorer.locator("details.equations > summary").click()
        explorer.locator("button.free[aria-label='free A']").click()
        explorer.locator(".row[data-state='free']").wait_for()
        page.screenshot(path=artefacts / "jupyterlab-free.png")
        explorer.locator("button.reset").click()
        page.wait_for_function(READS, arg=[f"{EXPLORER} textarea", BLOCK])

        page.evaluate("window.jupyterapp.commands.execute('apputils:change-theme', {theme: 'JupyterLab Dark'})")
        page.wait_for_selector("body[data-jp-theme-light='false']", state="attached")
        page.wait_for_selector("[data-theme='dark'] > .contoursolve.explorer")
        page.screenshot(path=artefacts / "jupyterlab-dark.png")

        page.evaluate("window.jupyterapp.shell.currentWidget.sessionContext.shutdown()")
        explorer.locator(".trouble", has_text="The kernel is gone").wait_for()


REGION = f"""region = contoursolve.ranges({BLOCK!r}, ("A", "P"), ((150, 210), (1, 60)), start="X40. Z0.")"""
MAP = ".contoursolve.map"


def region_here():
    return contoursolve.ranges(BLOCK, ("A", "P"), ((150, 210), (1, 60)), start="X40. Z0.")


def point_at(page, share_across, share_up):
    """Move the pointer to a place of a map, by shares of its plane: 610 by 400 of 760 pixels, from (92, 56)."""
    box = page.locator(f"{MAP} .paper").bounding_box()
    scale = box["width"] / 760
    page.mouse.move(box["x"] + scale * (92 + 610 * share_across), box["y"] + scale * (56 + 400 * (1 - share_up)))


def told(page):
    """The values and the text of a map, as they stand on the page."""
    values, *texts = page.locator(f"{MAP} .told").inner_text().split("\n")
    return [float(each) for each in re.findall(r"-?[\d.]+(?= )", values)], texts


def check_told(page):
    """What a map tells is what single solves say of these values."""
    (first, second), (state, *_) = told(page)
    result = contoursolve.solve(BLOCK.replace("A180.", f"A{first}").replace("P5.", f"P{second}"), start="X40. Z0.")
    answer = result.answers[0]
    assert state.startswith(status_text(answer.status))
    is_empty = page.locator(f"{MAP} .drawing.empty").count() == 1
    assert is_empty == (answer.contour is None)
    if answer.contour is not None:
        assert state == f"solved, end {answer.end_text}"
    return first, second


@pytest.mark.parametrize("kind", ["page", "output"])
def test_a_map_answers_to_the_pointer_and_to_keys_without_a_kernel(browser, tmp_path, artefacts, kind):
    region = region_here()
    if kind == "page":
        text = map_page(region, "line 1.room")
    else:  # what a notebook that is exported has
        text = contoursolve.explore(region, result="line 1.room")._repr_mimebundle_()[0]["text/html"]
        text = f"<!doctype html><meta charset=utf-8><title>x</title>{text * 2}"
    (tmp_path / "map.html").write_text(text, encoding="utf-8")
    for scheme in ("light", "dark"):
        watched = Watched(browser, viewport={"width": 1240, "height": 760}, color_scheme=scheme)
        page = watched.page
        page.goto((tmp_path / "map.html").as_uri())
        if kind == "output":  # shown twice, each is alive
            assert page.locator(f"{MAP} .stage").count() == 2
            page.evaluate("document.querySelectorAll('.contoursolve.map')[1].remove()")
        assert check_told(page) == pytest.approx((180, 5), abs=1.5)
        seen = []
        for share_across, share_up in ((0.2, 0.3), (0.8, 0.2), (0.9, 0.95)):
            point_at(page, share_across, share_up)
            first, second = check_told(page)
            assert first == pytest.approx(150 + 60 * share_across, abs=1)
            assert second == pytest.approx(1 + 59 * share_up, abs=1.5)
            seen.append(page.locator(f"{MAP} .small .path").get_attribute("d"))
            page.screenshot(path=artefacts / f"map-{kind}-{scheme}-{len(seen)}.png")
        assert len({*seen}) == 3
        assert told(page)[1] == ["cannot be cut: corner too large"]
        stage = page.locator(f"{MAP} .stage")
        stage.focus()
        for _ in range(30):
            stage.press("ArrowDown")
        first, second = check_told(page)
        assert second == 1
        assert re.fullmatch(r"straight part of line 1 [\d.]+ mm", told(page)[1][1])
        stage.press("ArrowLeft")
        assert check_told(page)[0] < first
        held = re.search(
            r"holds the contours of (\d+) by (\d+) values, the map has 305 by 201", page.locator(MAP).inner_text()
        )
        assert held is not None
        assert int(held[1]) * int(held[2]) <= 800
        page.set_viewport_size({"width": 400, "height": 800})
        assert page.evaluate(OVERFLOW) == 0
        watched.check()
        page.close()


@pytest.mark.parametrize(("scheme", "width"), [("light", 1240), ("dark", 390)])
def test_the_page_of_a_map_is_accessible(axe, browser, tmp_path, scheme, width):
    (tmp_path / "map.html").write_text(map_page(region_here(), "end Z"), encoding="utf-8")
    watched = Watched(browser, viewport={"width": width, "height": 900}, color_scheme=scheme)
    watched.page.goto((tmp_path / "map.html").as_uri())
    assert axe(watched.page) == []
    watched.page.locator(f"{MAP} .stage").focus()
    for _ in range(40):
        watched.page.keyboard.press("ArrowUp")
    watched.page.locator(f"{MAP} .nothing").wait_for()
    assert axe(watched.page) == []
    watched.check()
    watched.page.close()


@pytest.mark.slow
def test_in_jupyterlab_a_map_is_solved_where_the_pointer_is_and_opens_the_explorer(browser, tmp_path, artefacts):
    kind = {"cell_type": "code", "metadata": {}, "outputs": [], "execution_count": None, "id": "map"}
    cell = {**kind, "source": f"import contoursolve\n{REGION}\ncontoursolve.explore(region, result='end Z')"}
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    document = {"cells": [cell], "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    (tmp_path / "map.ipynb").write_text(json.dumps(document), encoding="utf-8")
    with opened(browser, tmp_path / "map.ipynb", 1500, 1900) as page:
        page.evaluate("window.jupyterapp.commands.execute('notebook:run-all-cells')")
        page.locator(f"{MAP} .stage").wait_for()
        point_at(page, 0.213, 0.307)
        page.wait_for_timeout(500)
        (first, second), _ = told(page)
        assert first == pytest.approx(150 + 60 * 0.213, abs=0.11)  # finer than the frames
        assert second == pytest.approx(1 + 59 * 0.307, abs=0.16)
        check_told(page)
        point_at(page, 0.9, 0.95)
        page.locator(f"{MAP} .told", has_text="does not fit").wait_for()
        assert page.locator(EXPLORER).count() == 0
        point_at(page, 0.3, 0.2)
        page.mouse.down()
        page.mouse.up()
        page.locator(f"{EXPLORER} .paper svg").wait_for()
        (first, second), _ = told(page)
        wanted = page.locator(f"{EXPLORER} textarea").input_value()
        assert f"A{first:g}" in wanted
        assert f"P{second:g}" in wanted
        page.screenshot(path=artefacts / "jupyterlab-map.png")
        stage = page.locator(f"{MAP} .stage")
        stage.focus()
        stage.press("ArrowUp")
        stage.press("Enter")
        page.wait_for_function(DIFFERS_VALUE, arg=[f"{EXPLORER} textarea", wanted])
        slider = page.locator(f"{EXPLORER} input[type=range][aria-label^='P:']")
        before = page.locator(f"{EXPLORER} textarea").input_value()
        slider.focus()
        slider.press("ArrowRight")
        page.wait_for_function(DIFFERS_VALUE, arg=[f"{EXPLORER} textarea", before])
        page.evaluate("window.jupyterapp.commands.execute('apputils:change-theme', {theme: 'JupyterLab Dark'})")
        page.wait_for_selector("body[data-jp-theme-light='false']", state="attached")
        page.wait_for_selector(f"[data-theme='dark'] > {MAP}")
        page.locator(".jp-Splash, #jupyterlab-splash").first.wait_for(state="hidden")
        page.screenshot(path=artefacts / "jupyterlab-map-dark.png")


DIFFERS_VALUE = "([selector, value]) => document.querySelector(selector).value !== value"


SHOWING = "window.jupyterapp.shell.currentWidget.content.widgets.filter(cell => cell.model.outputs?.length)"
WIDTHS = "images => Promise.all(images.map(image => image.decode().then(() => image.naturalWidth)))"


@pytest.mark.slow
def test_in_jupyterlab_a_notebook_that_nobody_trusts_or_runs_shows_its_pictures(browser, tmp_path, artefacts):
    document = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    shown = contoursolve.solve("G111 X100. A180. K-30. B120. P60.", start="X40. Z0.")._repr_mimebundle_()
    output = {"output_type": "display_data", "metadata": {}, "data": shown}
    cell = {"cell_type": "code", "metadata": {}, "execution_count": 1, "id": "browser", "source": "solve"}
    document["cells"].append({**cell, "outputs": [output]})
    outputs = [each.get("data", {}) for cell in document["cells"] for each in cell.get("outputs", ())]
    pictures = sum("image/svg+xml" in data for data in outputs)
    assert pictures >= 4
    (tmp_path / "unknown.ipynb").write_text(json.dumps(document), encoding="utf-8")
    with opened(browser, tmp_path / "unknown.ipynb", 1400, 1500) as page:
        assert page.evaluate(f"{SHOWING}.map(cell => cell.model.trusted)") == [False] * len(outputs)
        images = page.locator(".jp-OutputArea-output img")
        images.last.wait_for()
        assert images.evaluate_all(WIDTHS) == [760] * pictures
        assert page.locator(".jp-OutputArea-output svg").count() == 0
        images.last.scroll_into_view_if_needed()
        page.screenshot(path=artefacts / "jupyterlab-untrusted.png")


def write_report(target, *options):
    """The report of a broken program of the notebooks, as the command writes it; with `--explain`, each contour."""
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "contoursolve",
            "report",
            str(PROGRAMS / "shaft_broken.nc"),
            "-o",
            str(target),
            *options,
        ],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1, done.stderr
    return target.as_uri()


OVERFLOW = "document.documentElement.scrollWidth - document.documentElement.clientWidth"
BREAKS = """[["h3", "breakAfter"], [".blocks", "breakAfter"], ["figure", "breakBefore"], ["figure", "breakInside"]]
  .map(([selector, which]) => getComputedStyle(document.querySelector(`article ${selector}`))[which])"""
PAPER = "getComputedStyle(document.body).backgroundColor"


def test_the_report_opens_in_light_and_dark_and_prints(browser, tmp_path, artefacts):
    written = write_report(tmp_path / "report.html", "--explain")
    papers = []
    for scheme in ("light", "dark"):
        watched = Watched(browser, viewport={"width": 1280, "height": 1600}, color_scheme=scheme)
        page = watched.page
        page.goto(written)
        assert page.locator("article figure svg").count() == page.locator("article").count() >= 6
        assert page.locator("#contours > figure svg").count() == 1
        papers.append(page.evaluate(PAPER))
        page.screenshot(path=artefacts / f"report-{scheme}.png")
        page.screenshot(path=artefacts / f"report-{scheme}-all.png", full_page=True)
        page.set_viewport_size({"width": 480, "height": 900})
        assert page.evaluate(OVERFLOW) == 0
        for target in page.locator("a[href^='#']").evaluate_all("links => links.map(link => link.hash)"):
            assert page.locator(f"[id='{target[1:]}']").count() == 1, target
        if scheme == "dark":
            page.pdf(path=artefacts / "report.pdf", format="A4")
            page.emulate_media(media="print")
            papers.append(page.evaluate(PAPER))
            assert page.evaluate(BREAKS) == ["avoid"] * 4
        watched.check()
        page.close()
    assert papers == ["rgb(255, 255, 255)", "rgb(16, 21, 31)", "rgb(255, 255, 255)"]


@pytest.mark.parametrize(("scheme", "width"), [("light", 1280), ("dark", 390)])
def test_the_report_is_accessible(axe, browser, tmp_path, scheme, width):
    watched = Watched(browser, viewport={"width": width, "height": 900}, color_scheme=scheme)
    watched.page.goto(write_report(tmp_path / "page.html"))
    assert axe(watched.page) == []
    watched.check()
    watched.page.close()


SMALLEST = """() => Math.min(...[...document.querySelectorAll("figure > svg")].flatMap(svg => {
  const scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
  return [...svg.querySelectorAll("text")].map(text => scale * Number(text.getAttribute("font-size")));
}))"""
LIT = """article => [...article.querySelectorAll("[data-word], [data-element], [data-point], [data-finding]")]
  .filter(each => getComputedStyle(each).backgroundColor !== "rgba(0, 0, 0, 0)")
  .map(each => [each.localName, ...Object.entries(each.dataset).map(pair => pair.join("="))].join(" "))"""


def test_the_report_lights_what_belongs_together_without_a_script(browser, tmp_path, artefacts):
    watched = Watched(browser, viewport={"width": 390, "height": 900}, has_touch=True)
    page = watched.page
    page.goto(write_report(tmp_path / "page.html", "--explain"))
    assert page.evaluate(SMALLEST) >= 9
    assert page.evaluate(OVERFLOW) == 0
    third = page.locator("#contour-3")
    assert third.evaluate(LIT) == []
    row = third.locator("tr[data-word='P']")
    row.locator("a").focus()
    by_row = third.evaluate(LIT)
    assert {each.split()[0] for each in by_row} >= {"tr", "text", "tspan", "path", "section"}
    assert all("word=P" in each or "P " in each or " P" in each for each in by_row)
    third.screenshot(path=artefacts / "report-lit.png")
    page.locator("body").click(position={"x": 2, "y": 2})
    assert third.evaluate(LIT) == []
    row.locator("td").first.hover()
    assert third.evaluate(LIT) == by_row
    third.locator("svg text[data-word~='P']").first.hover()
    assert set(by_row) <= set(third.evaluate(LIT))
    page.mouse.move(0, 0)
    page.goto(page.url + "#finding-3")  # as a marked word of the program leads to it
    name = third.locator(".finding").first.get_attribute("id")
    page.evaluate("name => { location.hash = name }", name)
    lit = third.evaluate(LIT)
    assert set(by_row) <= set(lit)
    assert any(each.startswith("tspan") for each in lit)
    assert page.locator("#contour-4").evaluate(LIT) == []
    second = page.locator("#contour-2")
    second.locator("tr[data-element='line 1'] a").focus()
    assert "path element=line 1" in second.evaluate(LIT)
    watched.check()
    page.close()
