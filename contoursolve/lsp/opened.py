"""A program that the client has open: its text, its control, and where that comes from."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from lsprotocol import types
from msgspec import Struct, field

import contoursolve
from contoursolve.lsp.positions import ClientPositions
from contoursolve.lsp.rule_pages import Pages
from contoursolve.notebook import project_settings, stated_tool

CONTROL = "control"
FIX_ALL = f"{types.CodeActionKind.SourceFixAll.value}.contoursolve"
"""The kind of the action that applies all fixes that keep the contour; an editor may ask for it when it saves."""


class ClientSettings(Struct, frozen=True):
    """Settings of the client, in its section `contoursolve`."""

    control: str = ""
    settings: Mapping[str, str] = field(default_factory=dict)
    is_hinting: bool = True
    has_lenses: bool = True
    has_pictures: bool = True
    has_commands: bool = False
    """Whether the client shows by itself what is made for it."""


def read_client_settings(section: Any, *, has_commands: bool = False) -> ClientSettings:
    """The options of a client's section; what is of another kind counts as not set.

    A client that `has_commands` is shown pictures where it does not say that: a terminal would show their data.
    """
    table = section if isinstance(section, dict) else {}

    def switch(name: str) -> bool:
        return table.get(name) is not False

    given, control = table.get("settings"), table.get(CONTROL)
    return ClientSettings(
        control if isinstance(control, str) else "",
        {str(name): str(value) for name, value in given.items()} if isinstance(given, dict) else {},
        switch("inlayHints"),
        switch("codeLenses"),
        table["pictures"] if isinstance(table.get("pictures"), bool) else has_commands,
        has_commands,
    )


class Opened:
    """One open program."""

    def __init__(
        self,
        item: types.TextDocumentItem,
        path: Path | None,
        options: ClientSettings,
        pages: Pages,
        client: types.ClientCapabilities,
        encoding: types.PositionEncodingKind | str,
    ) -> None:
        self.uri, self.version, self.path, self.pages = item.uri, item.version, path, pages
        self.client = client
        self.options, self._project = options, project_settings(path)
        self._tool: tuple[int, contoursolve.ToolReport | str | None] | None = None
        name = path.name if path else item.uri
        self.program = contoursolve.OpenProgram(item.text, settings=self._settings(), name=name)
        self.places = ClientPositions(self.program, encoding)
        text, workspace = client.text_document, client.workspace
        shown = text.publish_diagnostics if text else None
        self.tells_related = bool(shown and shown.related_information)
        formats = text.hover.content_format if text and text.hover else None
        self.reads_markdown = formats is None or types.MarkupKind.Markdown in formats
        self._has_versions = bool(workspace and workspace.workspace_edit and workspace.workspace_edit.document_changes)

    def configure(self, options: ClientSettings) -> None:
        """Follow other options, or another project file."""
        self.options, self._project = options, project_settings(self.path)
        self.program.configure(None, self._settings())
        self._tool = None

    def change(self, version: int, changes: Sequence[types.TextDocumentContentChangeEvent]) -> None:
        """Follow what was typed."""
        self.version = version
        for change in changes:
            if isinstance(change, types.TextDocumentContentChangePartial):
                begin, end = self.places.place(change.range.start), self.places.place(change.range.end)
                self.program.edit(begin, end, change.text)
            else:
                self.program.replace(change.text)

    @property
    def troubles(self) -> list[str]:
        """Problems of the project file, and reasons why the control is not known."""
        project = self._project if isinstance(self._project, str) else ""
        return [*filter(None, (project, self.program.trouble))]

    @property
    def source(self) -> str:
        """The source that names the control."""
        if self.program.control is None:
            return "none"
        if self.program.is_stated:
            return "comment"
        if isinstance(self._project, dict) and CONTROL in self._project:
            return "project file"
        return "editor setting" if self.options.control else "program"

    def workspace_edit(self, changes: Sequence[types.TextEdit]) -> types.WorkspaceEdit:
        """Some edits of this program alone."""
        if not self._has_versions:
            return types.WorkspaceEdit({self.uri: [*changes]})
        document = types.OptionalVersionedTextDocumentIdentifier(self.uri, self.version)
        return types.WorkspaceEdit(document_changes=[types.TextDocumentEdit(document, [*changes])])

    def tool(self) -> "contoursolve.ToolReport | str | None":
        """The report about the tool that the program or its project file states; the reason where nothing can be said,
        None where no tool is stated."""
        if self._tool is None or self._tool[0] != self.version:
            self._tool = self.version, stated_tool(self.program, self.path)
        return self._tool[1]

    @property
    def conventions(self) -> dict[str, str]:
        """The settings of all controls, the client's and those of the project file on top."""
        project = {} if isinstance(self._project, str) else self._project
        return {name: value for name, value in {**self.options.settings, **project}.items() if name != CONTROL}

    def _settings(self) -> dict[str, str]:
        """The same, and what names the control."""
        project = {} if isinstance(self._project, str) else self._project
        control = project.get(CONTROL, self.options.control)
        return {**self.conventions, **({CONTROL: control} if control else {})}
