"""What is said between an explorer and its front end, wherever that runs: actions come in, what is shown goes out."""

from collections.abc import Callable, Mapping

from contoursolve.notebook import exploration as explorations
from contoursolve.notebook.exploration import Exploration
from contoursolve.notebook.front_end import Data, frames_of, range_of, view_of

_ACTIONS: Mapping[str, Callable[[Exploration, Data], Exploration]] = {
    "move": lambda now, action: explorations.set_word(now, str(action["key"]), action["value"]),
    "free": lambda now, action: explorations.free(now, str(action["key"])),
    "fix": lambda now, action: explorations.apply_fix(now, int(action["finding"]), int(action["fix"])),
    "select": lambda now, action: explorations.select(now, int(action["solution"])),
    "write": lambda now, action: explorations.write(now, str(action["text"])),
    "reset": lambda now, _: explorations.reset(now),
}
"""What the front end may ask for."""


class Conversation:
    """A contour whose words are moved: what it comes to (`exploration`), and all that a front end shows (`state`).

    The state is plain data. `view` is what `view_of` tells, `ranges` where each word has a contour, by its key, and
    `ranges_number` the number of the last action that asked for such a range.
    """

    def __init__(self, exploration: Exploration) -> None:
        self.exploration = exploration
        self.state: Data = {"view": self._viewed(0, is_new=True), "ranges": {}, "ranges_number": 0}

    def answer(self, action: Data) -> Data:
        """Do what a front end asks for; what changes of the state. Raises nothing: what goes wrong is said in it."""
        number = int(action.get("number", 0))
        if action.get("do") == "range":
            changed = {**self._ranged(str(action.get("key"))), "ranges_number": number}
        else:
            changed = {"view": self._acted(action, number)}
        self.state |= changed
        return changed

    def _acted(self, action: Data, number: int) -> Data:
        trouble = ""
        try:
            self.exploration = _ACTIONS[action["do"]](self.exploration, action)
        except ValueError as error:  # what the reader typed makes no sense: nothing changes
            trouble = str(error)
        except Exception as error:  # the front end waits for an answer, whatever happens
            trouble = f"{type(error).__name__}: {error}"
        return self._viewed(number, trouble, is_new=action.get("do") in ("write", "reset"))

    def _ranged(self, key: str) -> Data:
        """Where one word has a contour. It is worked out when nothing else is to do, and kept while it holds."""
        view, ranges = self.state["view"], self.state["ranges"]
        fields = {field["key"]: field for field in view["fields"]}
        frame = view["frames"].get(key)
        if frame is None or key not in fields or ranges.get(key, {}).get("frame") == frame:
            return {}
        try:
            return {"ranges": {**ranges, key: {"frame": frame, **range_of(self.exploration, fields[key])}}}
        except Exception:  # without a range the slider moves as well
            return {"ranges": {**ranges, key: {"frame": frame}}}

    def _viewed(self, number: int, trouble: str = "", *, is_new: bool = False) -> Data:
        view = view_of(self.exploration)
        frames = frames_of(self.exploration)
        return {**view, "number": number, "trouble": trouble, "is_new": is_new, "frames": frames}
