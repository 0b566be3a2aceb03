"""The map of two words as a widget of a notebook, with the explorer of the contour that the reader chose below it."""

from collections.abc import Mapping, Sequence
from importlib.resources import files
from typing import Any

import traitlets

from contoursolve.families import Family, FeasibleRegion
from contoursolve.notebook.conversation import Conversation
from contoursolve.notebook.exploration import Exploration, begin
from contoursolve.notebook.explorer import Explorer
from contoursolve.notebook.mime_bundle import text_of, with_widget
from contoursolve.notebook.records import bounded
from contoursolve.output import LiveMap, html_text, map_element, map_path, map_script, map_style

_LAST = "export default { render };"
"""The last line of the explorer's front end, in whose place that of the map stands."""


class MapExplorer(Explorer):
    """A map whose values can be pointed at; see `explore`."""

    _esm = (
        str(Explorer._esm).replace(_LAST, "")
        + map_script()
        + files(__package__).joinpath("map_explorer.js").read_text(encoding="utf-8")
    )
    _css = str(Explorer._css) + map_style()

    frames = traitlets.Dict().tag(sync=True)
    """The map, its values, and the contours on a grid of them."""
    drawing = traitlets.Unicode().tag(sync=True)
    """The picture of the map."""
    place = traitlets.Dict().tag(sync=True)
    """Values at which the reader looks, and whether they are to be opened."""
    seen = traitlets.Dict().tag(sync=True)
    """The answer to that: a text and a path."""

    def __init__(self, record: Family | FeasibleRegion, result: str | None = None) -> None:
        self._live = LiveMap(record, result)
        self._record = record
        super().__init__(self._opened(self._live.stated))
        self.set_trait("frames", self._live.data())
        self.set_trait("drawing", self._live.picture.svg)

    def _opened(self, values: Sequence[float]) -> Exploration:
        """The exploration of the block with values of both words."""
        spec, filled = self._live.spec, self._live.filled(values)
        asked = filled.asked
        start = None if asked.start is None else "\n".join(block.text for block in asked.start.blocks)
        return begin(
            "\n".join(block.text for block in filled.program.blocks),
            [fact.text for fact in asked.facts],
            start=start,
            control=spec.control,
            units=spec.units,
            rules=spec.rules,
            settings=dict(spec.settings),
        )

    @traitlets.observe("place")
    def _look(self, change: Mapping[str, Any]) -> None:
        """Tell the front end what is at a place, and open it if it wants that. What goes wrong is told, too."""
        asked = change["new"]
        seen: dict[str, Any] = {"number": asked.get("number", 0), "values": asked.get("values"), "is_open": False}
        try:
            values = [float(each) for each in asked["values"]]
            frame = self._live.look(values)
            line = map_path(frame.contour, self._live_view) if frame.contour is not None else ""
            seen |= {"text": frame.text, "path": line}
            if asked.get("is_open"):
                self.open_at(*values)
                seen["is_open"] = True
        except Exception as error:  # the front end waits for an answer, whatever happens
            seen |= {"text": str(error) if isinstance(error, ValueError) else type(error).__name__, "path": ""}
        self.set_trait("seen", seen)

    @property
    def _live_view(self) -> Sequence[float]:
        found: Sequence[float] = self.frames["view"]
        return found

    def open_at(self, first: float, second: float) -> None:
        """Open the contour of these values of both words in the explorer below the map."""
        conversation = Conversation(self._opened((first, second)))
        conversation.state["number"] = self.number
        with self.hold_sync():
            self._conversation = conversation
            for name, value in conversation.state.items():
                self.set_trait(name, value)
            self._tell()

    def _repr_mimebundle_(self, **options: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        """The widget, and beside it for whoever has no kernel the map with the contours that it holds."""
        data, metadata = with_widget(super()._repr_mimebundle_(**options))
        shown = {
            "text/plain": bounded(text_of(self._record)),
            "text/html": html_text(map_element(self._live)),
            "image/svg+xml": self._live.picture.svg,
        }
        return {**data, **shown}, metadata
