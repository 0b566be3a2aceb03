"""The explorer as a widget of a notebook: actions come from the front end, views go to it."""

from collections.abc import Callable, Mapping
from importlib.resources import files
from typing import Any

import anywidget
import traitlets

from contoursolve.notebook import exploration as explorations
from contoursolve.notebook.exploration import Exploration
from contoursolve.notebook.front_end import frames_of, range_of, view_of
from contoursolve.notebook.records import bundle
from contoursolve.output.html import notebook_style
from contoursolve.program.pipeline import Result

_HOUSE = files("contoursolve.notebook")

_ACTIONS: Mapping[str, Callable[[Exploration, Mapping[str, Any]], Exploration]] = {
    "move": lambda now, action: explorations.set_word(now, str(action["key"]), action["value"]),
    "free": lambda now, action: explorations.free(now, str(action["key"])),
    "fix": lambda now, action: explorations.apply_fix(now, int(action["finding"]), int(action["fix"])),
    "select": lambda now, action: explorations.select(now, int(action["solution"])),
    "write": lambda now, action: explorations.write(now, str(action["text"])),
    "reset": lambda now, _: explorations.reset(now),
}
"""What the front end may ask for."""


class Explorer(anywidget.AnyWidget):
    """A contour whose words can be moved; see `explore`."""

    _esm = (_HOUSE / "explorer.js").read_text(encoding="utf-8")
    _css = notebook_style() + (_HOUSE / "explorer.css").read_text(encoding="utf-8")

    view = traitlets.Dict().tag(sync=True)
    """What is shown; see `view_of`."""
    action = traitlets.Dict().tag(sync=True)
    """What the reader did last."""
    ranges = traitlets.Dict().tag(sync=True)
    """Where each word has a contour, by its key."""
    ranges_number = traitlets.Int(0).tag(sync=True)

    def __init__(self, exploration: Exploration) -> None:
        self._exploration = exploration
        super().__init__(view=self._viewed(0, is_new=True))

    @property
    def text(self) -> str:
        """The block as it is now."""
        return self._exploration.text

    @property
    def result(self) -> Result:
        """What the block comes to."""
        return self._exploration.result

    @traitlets.observe("action")
    def _act(self, change: Mapping[str, Any]) -> None:
        action = change["new"]
        number = int(action.get("number", 0))
        if action.get("do") == "range":
            try:
                self._tell_range(str(action.get("key")))
            finally:
                self.ranges_number = number
            return
        trouble = ""
        try:
            self._exploration = _ACTIONS[action["do"]](self._exploration, action)
        except ValueError as error:  # what the reader typed makes no sense: nothing changes
            trouble = str(error)
        except Exception as error:  # the front end waits for an answer, whatever happens
            trouble = f"{type(error).__name__}: {error}"
        self.view = self._viewed(number, trouble, is_new=action.get("do") in ("write", "reset"))

    def _tell_range(self, key: str) -> None:
        """Where one word has a contour. It is worked out when nothing else is to do, and kept while it holds."""
        fields = {field["key"]: field for field in self.view["fields"]}
        frame = self.view["frames"].get(key)
        if frame is not None and key in fields and self.ranges.get(key, {}).get("frame") != frame:
            self.ranges = {**self.ranges, key: {"frame": frame, **range_of(self._exploration, fields[key])}}

    def _viewed(self, number: int, trouble: str = "", *, is_new: bool = False) -> dict[str, Any]:
        view = view_of(self._exploration)
        frames = frames_of(self._exploration)
        return {**view, "number": number, "trouble": trouble, "is_new": is_new, "frames": frames}

    def _repr_mimebundle_(self, **options: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        """The widget, and beside it for whoever has no kernel the picture of the contour and its text."""
        shown = super()._repr_mimebundle_(**options)
        data, metadata = shown if isinstance(shown, tuple) else (shown or {}, {})
        return {**data, **bundle(self._exploration.answer or self._exploration.result)}, metadata
