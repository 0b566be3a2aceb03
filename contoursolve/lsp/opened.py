"""A program that the client has open: its text, its control, and where that comes from."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from lsprotocol import types
from msgspec import Struct, field

from contoursolve import OpenProgram, SettingError, find_settings
from contoursolve.lsp.pages import Pages
from contoursolve.lsp.places import Places

CONTROL = "control"


class Options(Struct, frozen=True):
    """What the client is set to, in its section `contoursolve`."""

    control: str = ""
    settings: Mapping[str, str] = field(default_factory=dict)
    is_hinting: bool = True
    has_lenses: bool = True
    has_pictures: bool = True
    block_numbers: int = 0


def read_options(section: Any) -> Options:
    """The options of a client's section; what is of another kind counts as not set."""
    table = section if isinstance(section, dict) else {}

    def switch(name: str) -> bool:
        return table.get(name) is not False

    style, given, control = table.get("format"), table.get("settings"), table.get(CONTROL)
    step = style.get("blockNumbers") if isinstance(style, dict) else 0
    return Options(
        control if isinstance(control, str) else "",
        {str(name): str(value) for name, value in given.items()} if isinstance(given, dict) else {},
        switch("inlayHints"),
        switch("codeLenses"),
        switch("pictures"),
        step if isinstance(step, int) and not isinstance(step, bool) and step > 0 else 0,
    )


class Opened:
    """One open program."""

    def __init__(
        self,
        item: types.TextDocumentItem,
        path: Path | None,
        options: Options,
        pages: Pages,
        client: types.ClientCapabilities,
        encoding: types.PositionEncodingKind | str,
    ) -> None:
        self.uri, self.version, self.path, self.pages = item.uri, item.version, path, pages
        self.options, self._project = options, _project_of(path)
        name = path.name if path else item.uri
        self.program = OpenProgram(item.text, settings=self._settings(), name=name)
        self.places = Places(self.program, encoding)
        text, workspace = client.text_document, client.workspace
        shown = text.publish_diagnostics if text else None
        self.tells_related = bool(shown and shown.related_information)
        self._has_versions = bool(workspace and workspace.workspace_edit and workspace.workspace_edit.document_changes)

    def configure(self, options: Options) -> None:
        """Follow other options, or another project file."""
        self.options, self._project = options, _project_of(self.path)
        self.program.configure(None, self._settings())

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
    def trouble(self) -> str:
        """What is wrong with the project file, or why the control is not known."""
        return self._project if isinstance(self._project, str) else self.program.trouble

    @property
    def line_end(self) -> str:
        """How its lines end."""
        return next((end for end in ("\r\n", "\n", "\r") if end in self.program.text), "\n")

    @property
    def source(self) -> str:
        """What names the control."""
        if self.program.dialect is None:
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

    def _settings(self) -> dict[str, str]:
        """The client's settings, and those of the project file on top."""
        own = {CONTROL: self.options.control} if self.options.control else {}
        project = {} if isinstance(self._project, str) else self._project
        return {**own, **self.options.settings, **project}


def _project_of(path: Path | None) -> dict[str, str] | str:
    """The settings of the project file of a program, or what is wrong with it."""
    try:
        return find_settings(path.parent) if path is not None else {}
    except SettingError as error:
        return str(error)
