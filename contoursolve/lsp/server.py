"""The server: what it can do, and what it does with each message of its client.

A client waits for what it can do: this module needs nothing that solves or draws, and whoever does imports it.
"""

import asyncio
import gc
import logging
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from importlib import import_module
from itertools import count
from math import inf
from pathlib import Path
from time import monotonic
from typing import Any
from urllib.parse import urlsplit

from lsprotocol import types
from pygls.lsp.server import LanguageServer
from pygls.protocol import LanguageServerProtocol, lsp_method
from pygls.uris import to_fs_path

import contoursolve
from contoursolve.lsp.opened import FIX_ALL, ClientSettings, Opened, read_client_settings
from contoursolve.lsp.rule_pages import Pages

logger = logging.getLogger(__name__)

SECTION = "contoursolve"
Steps = Iterator[tuple[Any, tuple[Any, ...], None]]
"""Handlers that pygls calls one after the other, with their arguments."""

STATUS, PICTURE = "contoursolve/status", "contoursolve/picture"

PATIENCE = 5.0
"""Seconds until a client that was asked for its options has to answer."""

REST = 0.15
"""Seconds without a further edit until a program is examined that is edited faster than it can be."""

MOMENT, TURNS = 0.01, 16
"""Seconds for which is examined before messages are looked at, and turns of the loop that one takes to be read and
answered."""

SOON = 0.5
"""Seconds after which a hover says what it can."""

LONG = 1.0
"""Seconds of an examination after which is told what it has found so far, and again whenever it took twice as long."""


class Protocol(LanguageServerProtocol):
    """The protocol without the texts that pygls keeps besides: applying a change to its own text, it overwrites the
    places of the change (`position_from_client_units` of pygls 2.1), and it has other ends of lines."""

    @lsp_method(types.TEXT_DOCUMENT_DID_OPEN)
    def lsp_text_document__did_open(self, params: types.DidOpenTextDocumentParams) -> Steps:
        """Tell the server alone."""
        yield self.fm.features[types.TEXT_DOCUMENT_DID_OPEN], (params,), None

    @lsp_method(types.TEXT_DOCUMENT_DID_CHANGE)
    def lsp_text_document__did_change(self, params: types.DidChangeTextDocumentParams) -> Steps:
        """Tell the server alone."""
        yield self.fm.features[types.TEXT_DOCUMENT_DID_CHANGE], (params,), None

    @lsp_method(types.TEXT_DOCUMENT_DID_CLOSE)
    def lsp_text_document__did_close(self, params: types.DidCloseTextDocumentParams) -> Steps:
        """Tell the server alone."""
        yield self.fm.features[types.TEXT_DOCUMENT_DID_CLOSE], (params,), None


class Server(LanguageServer):
    """One client, and the programs that it has open."""

    def __init__(self) -> None:
        super().__init__(SECTION, contoursolve.__version__, protocol_cls=Protocol)
        self.opened: dict[str, Opened] = {}
        self.checking: dict[str, asyncio.Task[None]] = {}
        self.options, self.pages = ClientSettings(), Pages()
        self.has_client_commands = False
        self.is_configured = asyncio.Event()
        self._numbers = count(1)

    def open(self, item: types.TextDocumentItem) -> None:
        """Begin to follow a program."""
        path = to_fs_path(item.uri) if urlsplit(item.uri).scheme == "file" else None
        encoding = self.server_capabilities.position_encoding or types.PositionEncodingKind.Utf16
        self.opened[item.uri] = Opened(
            item, Path(path) if path else None, self.options, self.pages, self.client_capabilities, encoding
        )
        self.begin_check(item.uri)

    def begin_check(self, uri: str) -> None:
        """Examine what an edit made necessary, a little at a time; what was begun before that is left."""
        before = self.checking.get(uri)
        is_hurried = before is not None and not before.done()
        if before is not None:
            before.cancel()
        rest = REST if is_hurried else 0.0
        self.checking[uri] = asyncio.get_running_loop().create_task(self._check(self.opened[uri], rest))

    async def _check(self, opened: Opened, rest: float) -> None:
        token, told = "", monotonic()
        try:
            await self._until_configured()
            await asyncio.sleep(rest)
            begun = told = monotonic()
            while not _go_on(opened):
                for _ in range(TURNS):
                    await asyncio.sleep(0)
                if monotonic() - told > max(LONG, told - begun):
                    token, told = token or self._begin_progress(opened), monotonic()
                    self._tell_so_far(opened, token)
            self._tell(opened)
            # A command collects none of the cycles that an edit leaves behind.
            gc.collect(0)
        except Exception as error:  # what is told stays as it was, and the next edit is examined again
            logger.exception("%s was not examined", opened.uri)
            message = f"{opened.program.name} was not examined: {type(error).__name__}: {error}; please report it"
            self.window_show_message(types.ShowMessageParams(types.MessageType.Error, message))
        finally:
            if token in self.work_done_progress.tokens:
                self.work_done_progress.end(token, types.WorkDoneProgressEnd())

    def _begin_progress(self, opened: Opened) -> str:
        """Have the client show the progress of an examination, if it can; the name of what it shows."""
        token, window = f"{SECTION} {next(self._numbers)}", self.client_capabilities.window
        if window and window.work_done_progress:
            self.work_done_progress.create(token)
            self.work_done_progress.begin(token, types.WorkDoneProgressBegin(f"Examining {opened.program.name}"))
        return token

    def _tell_so_far(self, opened: Opened, token: str) -> None:
        """Send the findings of an examination that goes on, and how far it is. They are not those of this version."""
        from contoursolve.lsp.findings import diagnostics_of  # noqa: PLC0415 - as in `initialized`

        found = diagnostics_of(opened)
        self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(opened.uri, found))
        if token in self.work_done_progress.tokens:
            done, lines = opened.program.examined, len(opened.program.blocks)
            report = types.WorkDoneProgressReport(message=f"line {done} of {lines}", percentage=100 * done // lines)
            self.work_done_progress.report(token, report)

    async def _until_configured(self) -> None:
        """Wait until the client has told its options: with others, the control may be another one."""
        with suppress(TimeoutError):
            await asyncio.wait_for(self.is_configured.wait(), PATIENCE)
        self.is_configured.set()

    def _tell(self, opened: Opened) -> None:
        """Send the findings about a program, and how it stands."""
        from contoursolve.lsp.findings import diagnostics_of  # noqa: PLC0415 - as in `initialized`

        found = diagnostics_of(opened)
        self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(opened.uri, found, opened.version))
        statuses = [contour.answer.status for contour in opened.program.contours]
        severities = [finding.severity for finding in opened.program.diagnostics]
        status = {
            "uri": opened.uri,
            "control": opened.program.control.name if opened.program.control else None,
            "source": opened.source,
            "contours": len(statuses),
            "solved": statuses.count(contoursolve.Status.SOLVED),
            "errors": severities.count(contoursolve.Severity.ERROR),
            "warnings": severities.count(contoursolve.Severity.WARNING),
            "message": "; ".join(opened.troubles),
        }
        self.protocol.notify(STATUS, status)
        workspace = self.client_capabilities.workspace
        if workspace and workspace.inlay_hint and workspace.inlay_hint.refresh_support:
            self.workspace_inlay_hint_refresh(None)
        if workspace and workspace.code_lens and workspace.code_lens.refresh_support:
            self.workspace_code_lens_refresh(None)

    async def examined(self, uri: str, lines: tuple[int, int] | None = None, patience: float = inf) -> Opened | None:
        """A program with all of it examined, or the lines from one to another, which are before all others, or as far
        as that gets in so many seconds; None if it is not open."""
        end, pause = monotonic() + patience, None if lines is None else MOMENT
        while uri in self.checking and not self.checking[uri].done() and monotonic() < end:
            if lines is not None and self.is_configured.is_set():
                program = self.opened[uri].program
                if program.is_examined(*lines):
                    break
                program.look(*lines)
            await asyncio.wait([self.checking[uri]], timeout=pause)
        return self.opened.get(uri)

    def close(self, uri: str) -> None:
        """Forget a program, and its findings."""
        task = self.checking.pop(uri, None)
        if task is not None:
            task.cancel()
        if self.opened.pop(uri, None) is not None:
            self.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, []))

    def configure(self, section: Any) -> None:
        """Follow the client's options."""
        self.options = read_client_settings(section, has_commands=self.has_client_commands)
        self.follow_projects()

    def follow_projects(self) -> None:
        """Read the project files again."""
        for uri, opened in self.opened.items():
            opened.configure(self.options)
            self.begin_check(uri)

    async def ask_options(self) -> None:
        """Ask the client for its section, if it can be asked."""
        workspace = self.client_capabilities.workspace
        if workspace and workspace.configuration:
            wanted = types.ConfigurationParams([types.ConfigurationItem(section=SECTION)])
            sections = await self.workspace_configuration_async(wanted)
            if sections and sections[0] is not None:
                self.configure(sections[0])
        self.is_configured.set()

    async def show(self, uri: str, what: str) -> None:
        """Have the client show a file, or else say where it is."""
        window = self.client_capabilities.window
        if window and window.show_document and window.show_document.support:
            await self.window_show_document_async(types.ShowDocumentParams(uri, take_focus=True))
        else:
            message = f"{what}: {to_fs_path(uri)}"
            self.window_show_message(types.ShowMessageParams(types.MessageType.Info, message))


server = Server()


def _go_on(opened: Opened) -> bool:
    """Examine a program for a moment; whether everything is up to date."""
    end = monotonic() + MOMENT
    while not opened.program.check(1):
        if monotonic() > end:
            return False
    return True


def _handler(method: str, patience: float | None) -> Callable[[Any], Any]:
    """A handler of requests about a program, answered when all of it is examined; with `patience`, of those about a
    place or a range, answered when it is examined up to there, or after so many seconds; null if it is not open."""

    async def handle(params: Any) -> Any:
        from contoursolve.lsp.answers import ANSWERS  # noqa: PLC0415 - as in `initialized`

        uri, lines = params.text_document.uri, None
        if patience is not None:
            ends = (params.range.start, params.range.end) if hasattr(params, "range") else (params.position,) * 2
            lines = ends[0].line + 1, ends[1].line + 1
        opened = await server.examined(uri, lines, inf if patience is None else patience)
        return None if opened is None else ANSWERS[method](opened, params)

    return handle


@server.feature(types.INITIALIZE)
def initialize(params: types.InitializeParams) -> None:
    """Take the client's options."""
    given = params.initialization_options
    table = given if isinstance(given, dict) else _table(given)
    server.has_client_commands = table.get("clientCommands") is True
    # Some clients send their whole configuration, with the name of its section.
    server.options = read_client_settings(table.get(SECTION, table), has_commands=server.has_client_commands)


def _table(record: Any) -> Mapping[str, Any]:
    """The fields of an object of JSON, which pygls makes a named tuple."""
    fields = getattr(record, "_asdict", None)
    if fields is None:
        return {}
    return {name: _table(value) if hasattr(value, "_asdict") else value for name, value in fields().items()}


@server.feature(types.INITIALIZED)
async def initialized(_: types.InitializedParams) -> None:
    """Ask for the options, and to be told of project files that change."""
    # The client has its first answer: now everything is loaded that the next ones need.
    from contoursolve.lsp import answers  # noqa: F401, PLC0415

    # A hover over a word tells its equations, for which sympy is imported, and that takes long.
    asyncio.get_running_loop().run_in_executor(None, import_module, "sympy")
    await server.ask_options()
    workspace = server.client_capabilities.workspace
    watching = workspace.did_change_watched_files if workspace else None
    if watching and watching.dynamic_registration:
        names = ("**/contoursolve.toml", "**/pyproject.toml")
        watched = types.DidChangeWatchedFilesRegistrationOptions([types.FileSystemWatcher(name) for name in names])
        wanted = types.Registration("project-files", types.WORKSPACE_DID_CHANGE_WATCHED_FILES, watched)
        await server.client_register_capability_async(types.RegistrationParams([wanted]))


@server.feature(types.WORKSPACE_DID_CHANGE_CONFIGURATION)
async def change_configuration(params: types.DidChangeConfigurationParams) -> None:
    """Follow the options; a client that cannot be asked sends them."""
    workspace = server.client_capabilities.workspace
    if workspace and workspace.configuration:
        await server.ask_options()
        return
    table = params.settings if isinstance(params.settings, dict) else _table(params.settings)
    server.configure(table.get(SECTION, table))


@server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
def change_files(_: types.DidChangeWatchedFilesParams) -> None:
    """A project file has changed."""
    server.follow_projects()


@server.feature(types.TEXT_DOCUMENT_DID_OPEN)
def did_open(params: types.DidOpenTextDocumentParams) -> None:
    """Follow a program."""
    server.open(params.text_document)


@server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
def did_change(params: types.DidChangeTextDocumentParams) -> None:
    """Follow what is typed."""
    opened = server.opened.get(params.text_document.uri)
    if opened is not None:
        opened.change(params.text_document.version, params.content_changes)
        server.begin_check(opened.uri)


@server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
def did_close(params: types.DidCloseTextDocumentParams) -> None:
    """Forget a program."""
    server.close(params.text_document.uri)


@server.feature(types.SHUTDOWN)
def shutdown(_: Any = None) -> None:
    """Leave no files behind."""
    server.pages.close()


_REQUESTS: tuple[tuple[str, Any, float | None], ...] = (
    (
        types.TEXT_DOCUMENT_CODE_ACTION,
        types.CodeActionOptions([types.CodeActionKind.QuickFix, FIX_ALL], resolve_provider=True),
        None,
    ),
    (types.TEXT_DOCUMENT_HOVER, None, SOON),
    (types.TEXT_DOCUMENT_INLAY_HINT, None, inf),
    (types.TEXT_DOCUMENT_COMPLETION, types.CompletionOptions(trigger_characters=[" ", ",", "#"]), inf),
    (types.TEXT_DOCUMENT_SIGNATURE_HELP, types.SignatureHelpOptions([" "]), inf),
    (types.TEXT_DOCUMENT_DOCUMENT_SYMBOL, None, None),
    (types.TEXT_DOCUMENT_FOLDING_RANGE, None, None),
    (types.TEXT_DOCUMENT_CODE_LENS, None, None),
)
"""Requests of a client about a program, with the options that it is told, and the seconds that it waits for a place in
it, if it is not about the whole; `answers` has the functions that answer."""

for _name, _options, _patience in _REQUESTS:
    server.feature(_name, _options)(_handler(_name, _patience))


@server.feature(types.CODE_ACTION_RESOLVE)
async def resolve_action(action: types.CodeAction) -> types.CodeAction:
    """An action that was chosen, with its edit."""
    from contoursolve.lsp.findings import uri_of, with_edit  # noqa: PLC0415 - as in `initialized`

    opened = await server.examined(uri_of(action))
    return action if opened is None else with_edit(opened, action)


@server.feature(PICTURE)
async def picture(params: Any) -> Any:
    """The contour under the cursor as a picture, with the places of its words."""
    from contoursolve.lsp import commands  # noqa: PLC0415 - as in `initialized`

    opened = await server.examined(params.textDocument.uri, (params.position.line + 1,) * 2)
    if opened is None:
        return None
    return commands.picture_of(opened, types.Position(params.position.line, params.position.character))


_COMMANDS = {
    "expand": "expand_program",
    "convert": "convert_program",
    "report": "report_on",
    "explore": "notebook_of",
}
"""Functions of `commands` that make something of a program for a client, by the name of the command."""


def _command(make: str) -> Callable[..., Any]:
    async def handle(uri: str, *arguments: Any) -> Any:
        from contoursolve.lsp import commands  # noqa: PLC0415 - as in `initialized`

        return getattr(commands, make)(await server.examined(uri), *arguments)

    return handle


for _name, _make in _COMMANDS.items():
    server.command(f"contoursolve.{_name}")(_command(_make))


@server.command("contoursolve.controls")
def controls() -> Any:
    """The controls that can be chosen."""
    return [{"name": each.name, "title": each.title} for each in contoursolve.CONTROLS.values()]


@server.command("contoursolve.explain")
async def explain(code: str, control: str) -> None:
    """Show the page about a rule."""
    uri = server.pages.uri(code, contoursolve.CONTROLS.get(control))
    if uri:
        await server.show(uri, code)


@server.command("contoursolve.show")
async def show(what: str, uri: str, line: int) -> None:
    """Write a picture, a notebook or the plain program into a file, and show it: for clients without commands of their
    own."""
    from contoursolve.lsp import commands  # noqa: PLC0415 - as in `initialized`

    opened = await server.examined(uri)
    name, text = commands.file_of(opened, what, line)
    if text is None:
        server.window_show_message(types.ShowMessageParams(types.MessageType.Warning, name))
        return
    await server.show(server.pages.write(name, [text]), what)
