"""The explorer as a widget of a notebook."""

from collections.abc import Mapping
from importlib.resources import files
from typing import Any

import anywidget
import traitlets

from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration import Exploration
from contoursolve.notebook.mime_bundle import bundle
from contoursolve.output import notebook_style
from contoursolve.program import Result

_HOUSE = files(__package__)


class Explorer(anywidget.AnyWidget):
    """A contour whose words can be moved; see `explore`."""

    _esm = (_HOUSE / "explorer.js").read_text(encoding="utf-8")
    _css = notebook_style() + (_HOUSE / "explorer.css").read_text(encoding="utf-8")

    view = traitlets.Dict().tag(sync=True)
    ranges = traitlets.Dict().tag(sync=True)
    ghost = traitlets.Dict().tag(sync=True)
    number = traitlets.Int(0).tag(sync=True)
    action = traitlets.Dict().tag(sync=True)
    """Last action of the reader; the other traits are the state of `Conversation`."""

    def __init__(self, exploration: Exploration) -> None:
        self._conversation = Conversation(exploration)
        super().__init__(**self._conversation.state)

    @property
    def text(self) -> str:
        """The block as it is now."""
        return self._conversation.exploration.text

    @property
    def result(self) -> Result:
        """The result for the block as it is now."""
        return self._conversation.exploration.result

    @traitlets.observe("action")
    def _act(self, change: Mapping[str, Any]) -> None:
        with self.hold_sync():  # all that changes goes in one message
            for name, value in self._conversation.answer(change["new"]).items():
                self.set_trait(name, value)

    def _repr_mimebundle_(self, **options: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        """The widget, and beside it for whoever has no kernel the picture of the contour and its text."""
        shown = super()._repr_mimebundle_(**options)
        data, metadata = shown if isinstance(shown, tuple) else (shown or {}, {})
        now = self._conversation.exploration
        return {**data, **bundle(now.answer or now.result)}, metadata
