"""The explorer as a widget of a notebook."""

from collections.abc import Mapping
from importlib.resources import files
from typing import Any

import anywidget
import traitlets

from contoursolve.diagnosis import Answer
from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration import Exploration, values_of
from contoursolve.notebook.mime_bundle import bundle, with_widget
from contoursolve.output import notebook_style
from contoursolve.program import Result

_HOUSE = files(__package__)


class Explorer(anywidget.AnyWidget):
    """A contour whose words can be moved; see `explore`."""

    _esm = (_HOUSE / "explorer.js").read_text(encoding="utf-8")
    _css = notebook_style(has_tool=True) + (_HOUSE / "explorer.css").read_text(encoding="utf-8")

    view = traitlets.Dict().tag(sync=True)
    ranges = traitlets.Dict().tag(sync=True)
    ghost = traitlets.Dict().tag(sync=True)
    sections = traitlets.Dict().tag(sync=True)
    number = traitlets.Int(0).tag(sync=True)
    action = traitlets.Dict().tag(sync=True)
    """Last action of the reader; the other traits so far are the state of `Conversation`."""

    text = traitlets.Unicode()
    """The block as it is now, or the program of which it is one; another one may be set."""
    values = traitlets.Dict()
    """The values of its words as they are typed, by their keys; some or all may be set, `{"A": 120.0}`."""
    answer = traitlets.Instance(Answer, allow_none=True, read_only=True)
    """The contour that it comes to; None while the block holds none."""
    result = traitlets.Instance(Result, read_only=True)
    """All that it comes to."""

    def __init__(self, exploration: Exploration) -> None:
        self._conversation = Conversation(exploration)
        self._is_telling = False
        super().__init__(**self._conversation.state)
        self._tell()

    @traitlets.observe("action")
    def _act(self, change: Mapping[str, Any]) -> None:
        self._do(change["new"])

    @traitlets.observe("text")
    def _write(self, change: Mapping[str, Any]) -> None:
        if not self._is_telling:
            self._set({"do": "program", "text": change["new"]})

    @traitlets.observe("values")
    def _move(self, change: Mapping[str, Any]) -> None:
        if not self._is_telling:
            self._set({"do": "move", "values": dict(change["new"])})

    def _set(self, action: dict[str, Any]) -> None:
        """Do what Python sets. Raises ValueError for what makes no sense; the contour is then as before."""
        self._do({**action, "number": self.number})
        if self.view["trouble"]:
            raise ValueError(self.view["trouble"])

    def _do(self, action: dict[str, Any]) -> None:
        """Change the contour, and tell whoever looks at it."""
        with self.hold_sync():  # all that changes goes in one message
            for name, value in self._conversation.answer(action).items():
                self.set_trait(name, value)
            self._tell()

    def _tell(self) -> None:
        """The traits that say what the contour is now."""
        now = self._conversation.exploration
        self._is_telling = True
        try:
            self.set_trait("result", now.result)
            self.set_trait("answer", now.answer)
            self.set_trait("text", now.text)
            self.set_trait("values", values_of(now))
        finally:
            self._is_telling = False

    def _repr_mimebundle_(self, **options: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        """The widget, and beside it for whoever has no kernel the picture of the contour and its text."""
        data, metadata = with_widget(super()._repr_mimebundle_(**options))
        now = self._conversation.exploration
        return {**data, **bundle(now.answer or now.result)}, metadata
