"""The extension in a real editor: VS Code's workbench as code-server runs it. Nothing leaves the machine."""

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import zipfile
from collections import Counter
from contextlib import contextmanager
from pathlib import Path
from urllib.parse import quote, urlsplit

import pytest
from browsing import CHROMIUM, launched
from serving import SECONDS, wait_for

import contoursolve
from contoursolve import fix

pytestmark = [pytest.mark.editor, pytest.mark.needs("playwright", "pygls", "lsprotocol", "htpy")]

HOUSE = Path(contoursolve.__file__).parent.parent
EXTENSION = HOUSE / "editors" / "vscode"
PROGRAMS = HOUSE / "notebooks" / "programs"
CODE_SERVERS = {"20": "4.100.3", "22": "4.117.0", "24": "4.139.1"}
"""The last code-server for each node."""
NODES = f"node {' or '.join(CODE_SERVERS)}"
CLIPBOARD = ["clipboard-read", "clipboard-write"]
REPOSITORY = "https://example.org/owner/contoursolve"
IN_PACKAGE = {
    "[Content_Types].xml", "extension.vsixmanifest", "extension/LICENSE.txt", "extension/dist/extension.js",
    "extension/dist/licences.txt", "extension/dist/page.js", "extension/languages/gcode.json",
    "extension/languages/klartext.json", "extension/languages/sinumerik.json", "extension/media/icon.png",
    "extension/media/picture.css", "extension/package.json", "extension/readme.md",
    "extension/syntaxes/gcode.tmLanguage.json", "extension/syntaxes/klartext.tmLanguage.json",
    "extension/syntaxes/sinumerik.tmLanguage.json",
}  # fmt: skip
SETTINGS = {
    "contoursolve.python": sys.executable,
    "editor.minimap.enabled": False,
    "extensions.autoCheckUpdates": False,
    "extensions.ignoreRecommendations": True,
    "files.associations": {"*.h": "klartext"},
    "files.autoSave": "off",
    "security.workspace.trust.enabled": False,
    "telemetry.telemetryLevel": "off",
    "window.autoDetectColorScheme": True,
    "workbench.enableExperiments": False,
    "workbench.startupEditor": "none",
    "workbench.tips.enabled": False,
}


def run(*command, folder, **environment):
    words, around = [shutil.which(command[0]) or command[0], *command[1:]], {**os.environ, **environment}
    done = subprocess.run(words, cwd=folder, env=around, capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout + done.stderr


@pytest.fixture(scope="module")
def package(code_server, tmp_path_factory):
    """The extension as users install it, made from what the repository has."""
    house = tmp_path_factory.mktemp("house")
    folder = house / "editors" / "vscode"
    shutil.copytree(EXTENSION, folder, ignore=shutil.ignore_patterns("node_modules", "dist", "build", "*.vsix"))
    shutil.copy(HOUSE / "LICENSE", house)
    (house / "contoursolve").mkdir()
    shutil.copy(HOUSE / "contoursolve" / "__init__.py", house / "contoursolve")
    run("npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", folder=folder)
    told = run("npm", "run", "package", folder=folder, REPOSITORY=REPOSITORY)
    assert "warning" not in told.lower()
    return folder / "contoursolve.vsix"


@pytest.fixture(scope="module")
def code_server(request, tmp_path_factory):
    """The program that starts code-server."""
    node = shutil.which("node") and run("node", "-p", "process.versions.node.split('.')[0]", folder=HOUSE).strip()
    if not CHROMIUM or node not in CODE_SERVERS:
        (pytest.fail if request.config.getoption("--insist") else pytest.skip)(f"needs chromium and {NODES}")
    folder = Path(request.config.getoption("--code-server") or tmp_path_factory.mktemp("code-server"))
    root = folder / "node_modules" / "code-server"
    entry = root / "out" / "node" / "entry.js"
    if entry.exists():
        return entry
    # Its own scripts compile a terminal and a log for which nobody asks here.
    install = ("npm", "install", "--ignore-scripts", "--no-audit", "--no-fund", "--omit=dev")
    run(*install, f"code-server@{CODE_SERVERS[node]}", folder=folder)
    for part in ("lib/vscode", "lib/vscode/extensions"):
        run(*install, folder=root / part)
    (root / "lib" / "vscode" / "node_modules.asar").symlink_to("node_modules")
    # There is no password, so that nobody compiles what hashes one.
    hashing = next(place for place in (folder, root) if (place / "node_modules" / "argon2").exists())
    (hashing / "node_modules" / "argon2" / "argon2.cjs").write_text("module.exports = {}\n")
    (hashing / "node_modules" / "argon2" / "package.json").write_text('{"name": "argon2", "main": "argon2.cjs"}\n')
    return entry


@contextmanager
def serving(entry, package, folder, **settings):
    """The address of a program in an editor that has the extension, and a home of its own."""
    data = folder / "data"
    for kind in ("User", "Machine"):  # where Python is, the settings of the machine say
        (data / kind).mkdir(parents=True)
        (data / kind / "settings.json").write_text(json.dumps(SETTINGS | settings))
    (folder / "config.yaml").write_text("auth: none\ncert: false\n")
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    command = [
        "node", str(entry), "--config", str(folder / "config.yaml"), "--user-data-dir", str(data),
        "--extensions-dir", str(folder / "extensions"),
    ]  # fmt: skip
    options = [
        "--auth", "none", "--bind-addr", f"127.0.0.1:{port}", "--disable-telemetry", "--disable-update-check",
        "--disable-workspace-trust", "--disable-getting-started-override",
    ]  # fmt: skip
    own = {"HOME": str(folder), "PYTHONPATH": str(HOUSE), "EXTENSIONS_GALLERY": "{}"}
    environment = {**os.environ, **own}
    installed = subprocess.run(
        [*command, "--install-extension", str(package)], env=environment, capture_output=True, text=True, check=False
    )
    assert "successfully installed" in installed.stdout, installed.stdout + installed.stderr
    log = folder / "code-server.log"
    with log.open("wb") as output:
        server = subprocess.Popen([*command, *options], env=environment, stdout=output, stderr=output)
    try:
        wait_for(f"http://127.0.0.1:{port}/healthz", server, log)
        yield f"http://127.0.0.1:{port}"
    finally:
        server.terminate()
        server.wait(SECONDS)


@pytest.fixture(scope="module")
def address(code_server, package, tmp_path_factory):
    with serving(code_server, package, tmp_path_factory.mktemp("editor")) as found:
        yield found


@pytest.fixture(scope="module")
def browser():
    # No name is looked up: what asks another host fails, and is seen.
    yield from launched("--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1, EXCLUDE localhost")


@pytest.fixture
def window(browser, artefacts, request):
    """Opens a window of an editor; how it ends is kept, and whom it asked is looked at."""
    opened = []

    def open_one(address, program):
        opened.append(Editor(browser, address, program))
        return opened[-1]

    yield open_one
    for number, editor in enumerate(opened):
        editor.page.screenshot(path=artefacts / f"vscode-end-{request.node.name}-{number}.png")
        editor.check()


class Editor:
    """A window of the editor with one program; afterwards it has asked nobody but this machine."""

    def __init__(self, browser, address, program):
        self.context = browser.new_context(viewport={"width": 1600, "height": 1150}, permissions=CLIPBOARD)
        self.page = self.context.new_page()
        self.page.set_default_timeout(SECONDS * 1000)
        self.program, self.asked, self.own = program, [], set()
        self.context.on("request", lambda request: self.asked.append(request.url))
        self.context.on("response", self.note)
        self.page.on("websocket", lambda channel: self.asked.append(channel.url))
        place = f"vscode-remote://{urlsplit(address).netloc}{quote(str(program))}"
        payload = quote(json.dumps([["openFile", place]]))
        self.page.goto(f"{address}/?folder={quote(str(program.parent))}&payload={payload}")
        self.status = self.page.locator("[id='contoursolve.contoursolve.contoursolve.status']")
        self.page.locator(".monaco-editor .view-line").first.wait_for()

    def note(self, response):
        # Frames of the workbench name files by a host that is none; its own worker answers.
        if response.from_service_worker and urlsplit(response.url).hostname.endswith(".vscode-cdn.net"):
            self.own.add(response.url)

    def press(self, *keys):
        for key in keys:
            self.page.keyboard.press(key)

    def command(self, title):
        self.press("F1")
        box = self.page.locator(".quick-input-widget input.input")
        box.fill(f">contoursolve: {title}")
        self.page.locator(".quick-input-list .monaco-list-row", has_text=title).first.wait_for()
        self.press("Enter")

    def go_to(self, line, column=1):
        """The cursor's place, counted from 1."""
        self.press("Control+1", "Control+G")
        box = self.page.locator(".quick-input-widget input.input")
        box.fill(f":{line}:{column}")
        self.press("Enter")
        self.cursor(line, column)

    def cursor(self, line, column):
        """Waits until the cursor is there."""
        self.page.locator("[id='status.editor.selection']", has_text=f"Ln {line}, Col {column}").wait_for()

    def problems(self):
        """How many errors, warnings and infos the status bar counts."""
        text = self.page.locator("[id='status.problems'] a").get_attribute("aria-label")
        return {kind.lower(): int(number) for kind, number in re.findall(r"(Error|Warning|Info)s: (\d+)", text)}

    def line(self, text):
        return self.page.locator(".view-line", has_text=text)

    def copy_all(self):
        """The text of the document in sight."""
        self.press("Control+A", "Control+C", "Home")
        return self.page.evaluate("navigator.clipboard.readText()")

    def webview(self):
        """The page of a view: a frame in a frame."""
        return self.page.frame_locator("iframe.webview").frame_locator("iframe#active-frame")

    def check(self):
        local = ("127.0.0.1", "localhost")
        strangers = [
            url
            for url in self.asked
            if url not in self.own
            and urlsplit(url).scheme not in ("data", "blob", "about")
            and urlsplit(url).hostname not in local
        ]
        assert strangers == []
        assert self.asked
        self.context.close()


def blanks(text):
    """Monaco shows blanks that do not break."""
    return text.replace(" ", "\u00a0")


def findings_of(program):
    done = subprocess.run(
        [sys.executable, "-m", "contoursolve", "check", str(program), "--format", "json"],
        capture_output=True,
        text=True,
        check=False,
    )
    return json.loads(done.stdout)["diagnostics"]


@pytest.fixture
def program(tmp_path):
    copy = tmp_path / "work" / "shaft_broken.nc"
    copy.parent.mkdir()
    return shutil.copy(PROGRAMS / "shaft_broken.nc", copy)


def test_the_package_has_what_it_needs_and_says_where_the_project_lies(package):
    with zipfile.ZipFile(package) as packed:
        assert set(packed.namelist()) == IN_PACKAGE
        manifest = json.loads(packed.read("extension/package.json"))
        page = packed.read("extension/readme.md").decode()
    assert manifest["version"] == contoursolve.__version__
    assert manifest["repository"]["url"] == f"{REPOSITORY}.git"
    assert manifest["bugs"]["url"] == manifest["qna"] == f"{REPOSITORY}/issues"
    place = f"v{contoursolve.__version__}/editors/vscode/"
    targets = re.findall(r"\]\(([^)#]+)\)", page)
    assert all(each.startswith(f"{REPOSITORY}/") and place in each for each in targets)
    assert all((EXTENSION / each.partition(place)[2]).exists() for each in targets)
    assert len(targets) > 2


def test_findings_fixes_and_pictures_stand_beside_the_program(window, address, program, artefacts):
    before = program.read_bytes()
    findings = findings_of(program)
    editor = window(address, program)
    page = editor.page
    editor.status.filter(has_text="yasnac-lx3: 1 of 6 solved").wait_for()
    page.locator(".squiggly-error").first.wait_for()
    page.screenshot(path=artefacts / "vscode-findings.png")

    counts = Counter(finding["severity"] for finding in findings)
    assert editor.problems() == counts
    assert counts["error"] == 5
    for severity in counts:
        places = {
            (each["line"], each["column"], each["end_column"]) for each in findings if each["severity"] == severity
        }
        assert page.locator(f".squiggly-{severity}").count() == len(places), severity

    # The first fix for the corner that is too large; the error goes, and the end of the contour comes.
    editor.go_to(21, 24)
    editor.press("Control+.")
    page.locator(".action-widget .action", has_text="P2.5").first.wait_for()
    page.screenshot(path=artefacts / "vscode-fixes.png")
    editor.press("Enter")
    editor.line("N310").filter(has_text="P2.5").wait_for()
    editor.status.filter(has_text="yasnac-lx3: 2 of 6 solved").wait_for()
    assert editor.problems() == counts - Counter(error=1)
    editor.line("N310").filter(has_text="Z-75.5").wait_for()

    # A page about the rule of the next finding.
    editor.go_to(25, 23)
    editor.press("Control+.")
    actions = page.locator(".action-widget .action")
    actions.filter(has_text="Explain g111-reversed").wait_for()
    for _ in range(actions.count()):
        if "Explain" not in page.locator(".action-widget .action.focused").inner_text():
            editor.press("ArrowDown")
    editor.press("Enter")
    editor.webview().locator("h1", has_text="g111-reversed").wait_for()
    page.screenshot(path=artefacts / "vscode-fixed.png")

    assert program.read_bytes() == before


def test_fix_all_applies_every_fix_that_keeps_the_contour(window, address, program):
    editor = window(address, program)
    editor.status.filter(has_text="yasnac-lx3: 1 of 6 solved").wait_for()
    editor.page.locator(".squiggly-error").first.wait_for()
    wanted = fix(program.read_text(encoding="utf-8"))
    assert wanted.applied
    editor.go_to(1)
    editor.press("F1")
    editor.page.locator(".quick-input-widget input.input").fill(">Fix All")
    editor.page.locator(".quick-input-list .monaco-list-row", has_text=re.compile("^Fix All")).first.click()
    for each in wanted.applied:
        for new in filter(None, each.changes.values()):
            editor.line(blanks(new)).wait_for()
    assert editor.copy_all().replace("\r\n", "\n") == wanted.text


def test_the_picture_follows_the_cursor_and_both_show_a_word(window, address, program, artefacts):
    editor = window(address, program)
    page, picture = editor.page, editor.webview()
    editor.status.filter(has_text="yasnac-lx3").wait_for()
    editor.go_to(21, 24)
    editor.command("Draw the Contour Beside")
    picture.locator("text[data-word='P'].marked").first.wait_for()
    page.screenshot(path=artefacts / "vscode-picture.png")
    assert "the rounding P4. does not fit" in picture.locator("section").inner_text()

    # Another word, another contour, and a block that is none.
    editor.go_to(21, 12)
    picture.locator("text[data-word='A'].marked").first.wait_for()
    assert picture.locator("text[data-word='P'].marked").count() == 0
    editor.go_to(17, 12)
    picture.locator("svg title", has_text="line 17").wait_for(state="attached")
    editor.go_to(9)
    picture.locator("section", has_text="Line 9 is no part of a contour.").wait_for()
    assert picture.locator("svg").count() == 0

    # The picture points at a word of the program.
    editor.go_to(21, 1)
    word = picture.locator("text[data-word='K']").first
    word.hover()
    highlight = page.locator(".view-overlays [class*='TextEditorDecorationType']")
    highlight.wait_for()
    assert highlight.evaluate(TEXT_IN) == "K-20."
    page.screenshot(path=artefacts / "vscode-pointed.png")
    word.click()
    editor.cursor(21, 17)
    picture.locator("text[data-word='K'].marked").first.wait_for()

    # The picture has the theme of the editor.
    papers = []
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        picture.locator(f"body.vscode-{scheme}").wait_for()
        papers.append(picture.locator("svg > rect").first.evaluate("paper => getComputedStyle(paper).fill"))
        assert papers[-1] == page.locator(".monaco-editor-background").first.evaluate(BACKGROUND)
    assert papers[0] == "rgb(255, 255, 255)" != papers[1]
    page.screenshot(path=artefacts / "vscode-dark.png")

    # An edit of the program changes the picture.
    page.keyboard.type("(")
    picture.locator("[data-word='K']").first.wait_for(state="detached")
    editor.press("Control+Z")
    picture.locator("text[data-word='K'].marked").first.wait_for()


def test_commands_make_new_documents_and_leave_the_program(window, address, tmp_path, artefacts):
    program = tmp_path / "work" / "shaft.nc"
    program.parent.mkdir()
    shutil.copy(PROGRAMS / "shaft.nc", program)
    before = program.read_bytes()
    editor = window(address, program)
    page = editor.page
    editor.status.filter(has_text="yasnac-lx3: 7 of 7 solved").wait_for()

    editor.command("Expand to Plain Blocks")
    page.get_by_role("tab", name="shaft-plain.nc").wait_for()
    assert_same_lines(editor.copy_all(), contoursolve.expand(before.decode()).text)
    editor.press("Control+1")
    editor.command("Convert for Another Control")
    page.locator(".quick-input-list .monaco-list-row", has_text="fanuc-lathe").click()
    page.get_by_role("tab", name="shaft-fanuc-lathe.nc").wait_for()
    assert_same_lines(editor.copy_all(), contoursolve.convert(before.decode(), "fanuc-lathe").text)
    page.screenshot(path=artefacts / "vscode-convert.png")
    assert sum(editor.problems().values()) == 0

    editor.press("Control+1")
    editor.command("Show the Report")
    page.get_by_role("tab", name="Report: shaft.nc").wait_for()
    report = editor.webview()
    report.locator("#contours figure svg").wait_for()
    assert report.locator("#program .listing code").count() == len(before.splitlines())
    page.screenshot(path=artefacts / "vscode-report.png")

    editor.go_to(71, 12)
    editor.command("Explore the Contour")
    page.locator(".notebook-editor .view-line", has_text="contoursolve.explore").wait_for()
    page.screenshot(path=artefacts / "vscode-explore.png")

    editor.press("Control+1")
    editor.command("Choose the Control")
    page.locator(".quick-input-list .monaco-list-row", has_text="nct-99m").click()
    editor.status.filter(has_text="nct-99m: no contours").wait_for()
    editor.command("Restart the Server")
    editor.status.wait_for(state="detached")
    editor.status.filter(has_text="nct-99m: no contours").wait_for()
    assert program.read_bytes() == before


def test_klartext_has_the_picture_and_the_commands(window, address, tmp_path, artefacts):
    program = tmp_path / "work" / "cam.h"
    program.parent.mkdir()
    shutil.copy(HOUSE / "docs" / "programs" / "cam.h", program)
    text = program.read_text(encoding="utf-8")
    editor = window(address, program)
    page, picture = editor.page, editor.webview()
    editor.status.filter(has_text="heidenhain: 1 of 1 solved").wait_for()
    colours = editor.line("FCT").locator("span span").evaluate_all(COLORS)
    assert len(set(colours)) > 2

    editor.go_to(11, 7)
    editor.press("Control+K", "v")
    picture.locator("text[data-word].marked, tspan[data-word].marked").first.wait_for()
    assert "R15" in picture.locator("svg").text_content()
    page.locator(".action-label[aria-label*='Draw the Contour Beside']").wait_for()
    page.screenshot(path=artefacts / "vscode-klartext.png")

    editor.press("Control+1")
    editor.command("Expand to Plain Blocks")
    page.get_by_role("tab", name="cam-plain.h").wait_for()
    page.locator("[id='status.editor.mode']", has_text="Klartext").wait_for()
    assert_same_lines(editor.copy_all(), contoursolve.expand(text).text)
    editor.press("Control+1")
    editor.go_to(10)
    editor.command("Explore the Contour")
    page.locator(".notebook-editor .view-line", has_text="contoursolve.explore").wait_for()
    assert program.read_text(encoding="utf-8") == text


def assert_same_lines(found, expected):
    assert found.splitlines() == expected.splitlines()


def test_a_python_without_the_package_is_told_what_to_type(window, code_server, package, program, tmp_path, artefacts):
    run(sys.executable, "-m", "venv", "--without-pip", "bare", folder=tmp_path)
    python = next(path for path in (tmp_path / "bare").glob("*/python*") if path.stem == "python")
    with serving(code_server, package, tmp_path / "editor", **{"contoursolve.python": str(python)}) as address:
        editor = window(address, program)
        message = editor.page.locator(".notification-toast")
        command = f'{python} -m pip install "contoursolve[lsp]"'
        message.filter(has_text="This Python lacks contoursolve. Type this in a terminal").wait_for()
        assert message.filter(has_text=command).count() == 1
        assert message.count() == 1
        editor.page.screenshot(path=artefacts / "vscode-no-python.png")
        message.get_by_role("button", name="Copy").click()
        message.wait_for(state="detached")
        editor.page.wait_for_function(COPIED, arg=command)
        # A Python that is not there.
        for kind in ("User", "Machine"):
            changed = tmp_path / "editor" / "data" / kind / "settings.json"
            changed.write_text(json.dumps(SETTINGS | {"contoursolve.python": "/nowhere/python"}))
        message.filter(has_text="contoursolve cannot run /nowhere/python").wait_for()
        assert message.filter(has_text='python3 -m pip install "contoursolve[lsp]"').count() == 1


@pytest.mark.skipif(sys.platform == "win32", reason="the program is a script for a shell")
def test_the_program_in_the_folder_of_the_extension_serves(window, code_server, package, program, tmp_path):
    bundle = tmp_path / "bundle" / "contoursolve"
    bundle.parent.mkdir()
    bundle.write_text(f'#!/bin/sh\necho "$0 $@" >> "{tmp_path}/asked"\nexec "{sys.executable}" -m contoursolve "$@"\n')
    bundle.chmod(0o755)
    target = {"SERVER": str(bundle.parent), "TARGET": "linux-x64"}
    run("node", "package.mjs", folder=package.parent, **target)
    packed = shutil.move(package.parent / "contoursolve.vsix", tmp_path / "bundled.vsix")
    run("node", "package.mjs", folder=package.parent, REPOSITORY=REPOSITORY)
    with serving(code_server, packed, tmp_path / "editor", **{"contoursolve.python": ""}) as address:
        editor = window(address, program)
        editor.status.filter(has_text="yasnac-lx3: 1 of 6 solved").wait_for()
    (asked,) = (tmp_path / "asked").read_text().splitlines()
    assert re.search(r"/extensions/contoursolve\.contoursolve[^/]*/server/contoursolve lsp$", asked)


@pytest.mark.skipif(sys.platform == "win32", reason="the interpreter is a script for a shell")
def test_the_environment_of_the_folder_is_found(window, code_server, package, program, tmp_path):
    python = program.parent / ".venv" / "bin" / "python"
    python.parent.mkdir(parents=True)
    python.write_text(f'#!/bin/sh\necho "$@" >> "{tmp_path}/asked"\nexec "{sys.executable}" "$@"\n')
    python.chmod(0o755)
    with serving(code_server, package, tmp_path / "editor", **{"contoursolve.python": ""}) as address:
        editor = window(address, program)
        editor.status.filter(has_text="yasnac-lx3: 1 of 6 solved").wait_for()
    asked = (tmp_path / "asked").read_text().splitlines()
    assert asked[0].endswith("import contoursolve, pygls")
    assert asked[1:] == ["-P -m contoursolve lsp"]


COPIED = "async command => await navigator.clipboard.readText() === command"
COLORS = "spans => spans.map(span => getComputedStyle(span).color)"
BACKGROUND = "editor => getComputedStyle(editor).backgroundColor"
TEXT_IN = """box => {
  const inside = box.getBoundingClientRect(), range = document.createRange();
  let text = "";
  const walker = document.createTreeWalker(document.querySelector(".view-lines"), NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    for (let at = 0; at < walker.currentNode.length; at++) {
      range.setStart(walker.currentNode, at);
      range.setEnd(walker.currentNode, at + 1);
      const { x, y, width, height } = range.getBoundingClientRect();
      const [middle, centre] = [x + width / 2, y + height / 2];
      if (inside.left < middle && middle < inside.right && inside.top < centre && centre < inside.bottom) {
        text += range.toString();
      }
    }
  }
  return text;
}"""
