"""What is said between an explorer and its front end, wherever that runs: actions come in, what is shown goes out."""

from collections.abc import Callable, Mapping

from contoursolve.notebook import exploration as explorations
from contoursolve.notebook.exploration import Exploration
from contoursolve.notebook.front_end import Data, asked_now, frames_of, ghost_of, picture_of, range_of, view_of

_CHANGES: Mapping[str, Callable[[Exploration, Data], Exploration]] = {
    "move": lambda now, action: explorations.set_words(now, action["values"]),
    "free": lambda now, action: explorations.free(now, str(action["key"])),
    "fix": lambda now, action: explorations.apply_fix(now, int(action["finding"]), int(action["fix"])),
    "select": lambda now, action: explorations.select(now, int(action["solution"])),
    "write": lambda now, action: explorations.write(now, str(action["text"])),
    "reset": lambda now, _: explorations.reset(now),
}
"""What the front end may do to the block. Each can be undone."""

_FITTED = ("write", "reset", "undo", "redo")
"""After these the sliders are scaled anew."""

MOST_PAST = 500
"""Changes that can be undone."""


class Conversation:
    """A contour whose words are moved: what it comes to (`exploration`), and all that a front end shows (`state`).

    The state is plain data. `view` is what `view_of` tells, `ranges` where each word has a contour, by its key, `ghost`
    what a fix or another solution would draw, and `number` that of the last action. While a front end holds something
    (`is_held`), the picture stands as it did, and all that is held becomes one change.
    """

    def __init__(self, exploration: Exploration) -> None:
        self.exploration = exploration
        self._past: list[Exploration] = []
        self._future: list[Exploration] = []
        self._pinned: set[str] = set()
        self._is_held = False
        self._handle: dict[str, list[str]] = {}
        """The handle that is held, with the words that it changes."""
        self._solved = exploration
        """The contour as it was last solved."""
        self._drawn = picture_of(exploration.answer) if exploration.answer else None
        self.state: Data = {"view": self._viewed(is_new=True), "ranges": {}, "ghost": {}, "number": 0}

    def answer(self, action: Data) -> Data:
        """Do what a front end asks for; what changes of the state. Raises nothing: what goes wrong is said in it."""
        kind = action.get("do")
        try:
            changed = self._ranged(str(action["key"])) if kind == "range" else self._ghosted(action)
        except (ValueError, KeyError, TypeError):  # there is no such word, fix or solution any more
            changed = {}
        if kind not in ("range", "ghost"):
            changed = {"view": self._acted(action), "ghost": {}}
        self.state |= {**changed, "number": int(action.get("number", 0))}
        return {**changed, "number": self.state["number"]}

    def _acted(self, action: Data) -> Data:
        trouble, kind = "", action.get("do")
        is_held = bool(action.get("is_held"))
        before = self.exploration
        try:
            self.exploration = self._done(action)
        except ValueError as error:  # what the reader typed makes no sense: nothing changes
            trouble = str(error)
        except Exception as error:  # the front end waits for an answer, whatever happens
            trouble = f"{type(error).__name__}: {error}"
        if self.exploration is not before and kind in _CHANGES and not self._is_held:
            self._past, self._future = [*self._past[-MOST_PAST:], before], []
        self._is_held = is_held
        self._handle = action.get("handle", {}) if is_held else {}
        answer = self.exploration.answer
        self._solved = self.exploration if answer is not None and answer.contour is not None else self._solved
        self._drawn = picture_of(answer, self._drawn if is_held else None) if answer else None
        asks: list[Data] = []
        if kind == "fix" and not trouble:
            example = explorations.example_of(before, int(action["finding"]), int(action["fix"]))
            asks = asked_now(self.exploration, before, self._solved, example)
        return {**self._viewed(trouble, is_new=kind in _FITTED), "asks": asks}

    def _done(self, action: Data) -> Exploration:
        """What the contour is after an action."""
        kind, now = action["do"], self.exploration
        if kind in _CHANGES:
            return _CHANGES[kind](now, action)
        if kind == "pin":
            self._pinned ^= {str(action["key"])}
        elif kind in ("undo", "redo"):
            back, forth = (self._past, self._future) if kind == "undo" else (self._future, self._past)
            if back:
                forth.append(now)
                return back.pop()
        elif kind != "release":
            raise ValueError(f"nothing is called {kind!r} here")
        return now

    def _ranged(self, key: str) -> Data:
        """Where one word has a contour. It is worked out when nothing else is to do, and kept while it holds."""
        view, ranges = self.state["view"], self.state["ranges"]
        fields = {field["key"]: field for field in view["fields"]}
        frame = view["frames"].get(key)
        if frame is None or key not in fields or ranges.get(key, {}).get("frame") == frame:
            return {}
        return {"ranges": {**ranges, key: {"frame": frame, **range_of(self.exploration, fields[key])}}}

    def _ghosted(self, action: Data) -> Data:
        """The contour of a fix or of another solution, over the present picture."""
        now = self.exploration.answer
        if action.get("do") != "ghost" or self._drawn is None or now is None:
            return {}
        of: Data = {name: action[name] for name in ("finding", "fix", "solution") if name in action}
        if "solution" in of:
            instead = shown = explorations.select(self.exploration, of["solution"])
        else:
            instead = explorations.apply_fix(self.exploration, of["finding"], of["fix"])
            shown = explorations.example_of(self.exploration, of["finding"], of["fix"])
        return {"ghost": {**of, "text": instead.text, "paths": ghost_of(shown, now, self._drawn)}}

    def _viewed(self, trouble: str = "", *, is_new: bool = False) -> Data:
        view = view_of(self.exploration, self._drawn, self._pinned, self._handle)
        return {
            **view,
            "trouble": trouble,
            "is_new": is_new,
            "is_held": self._is_held,
            "can_undo": bool(self._past),
            "can_redo": bool(self._future),
            "frames": frames_of(self.exploration),
        }
