"""Messages between an explorer and its front end, wherever that runs: actions come in, changed data go out."""

from collections.abc import Callable, Mapping

from contoursolve.notebook import exploration as explorations
from contoursolve.notebook.exploration import Exploration, words_of
from contoursolve.notebook.exploration_view import (
    Data,
    asked_now,
    frames_of,
    ghost_of,
    picture_of,
    range_of,
    section_of,
    view_of,
)
from contoursolve.notebook.reader_edits import ReaderEdits, is_calm

_CHANGES: Mapping[str, Callable[[Exploration, Data], Exploration]] = {
    "move": lambda now, action: explorations.set_words(now, action["values"]),
    "free": lambda now, action: explorations.free(now, str(action["key"])),
    "fix": lambda now, action: explorations.apply_fix(now, int(action["finding"]), int(action["fix"])),
    "select": lambda now, action: explorations.select(now, int(action["solution"])),
    "write": lambda now, action: explorations.rewrite_block(now, str(action["text"])),
    "program": lambda now, action: explorations.rewrite(now, str(action["text"])),
    "reset": lambda now, _: explorations.reset(now),
}
"""Actions of the front end that change the block. Each can be undone."""

_FITTED = ("write", "program", "reset", "undo", "redo")
"""After these the sliders are scaled anew."""

MOST_PAST = 500
"""Changes that can be undone."""


class Conversation:
    """A contour whose words are moved: what it comes to (`exploration`), and all that a front end shows (`state`).

    The state is plain data. `view` is what `view_of` tells, `ranges` where each word has a contour, by its key, `ghost`
    what a fix or another solution would draw, `sections` those that were opened, each with the mark of the text,
    and `number` that of the last action. While a front end holds something (`is_held`), the picture stands as it did,
    and all that is held becomes one change.
    """

    def __init__(self, exploration: Exploration) -> None:
        self.exploration = exploration
        self._past: list[Exploration] = []
        self._future: list[Exploration] = []
        self._begun: tuple[Exploration, list[Exploration], list[Exploration]] = (exploration, [], [])
        """The contour when the reader took hold of it, and what could be undone and made again then."""
        self._pinned: set[str] = set()
        self._is_held = False
        self._handle: dict[str, list[str]] = {}
        """The handle that is held, with the words that it changes."""
        self._solved = exploration
        """The contour as it was last solved."""
        self._edits = ReaderEdits(exploration) if is_calm(exploration) else None
        """The contour as it was when nothing was found about it."""
        self._drawn = picture_of(exploration.answer, None, exploration.tool) if exploration.answer else None
        self.state: Data = {"view": self._viewed(is_new=True), "ranges": {}, "ghost": {}, "sections": {}, "number": 0}

    def answer(self, action: Data) -> Data:
        """Do what a front end asks for; what changes of the state. Raises nothing: what goes wrong is said in it."""
        kind = str(action.get("do"))
        if kind in _WONDERS:
            try:
                changed = _WONDERS[kind](self, action)
            except Exception:  # there is no such word, fix or solution any more
                changed = {}
        else:
            changed = {"view": self._acted(action), "ghost": {}}
        self.state |= {**changed, "number": int(action.get("number", 0))}
        return {**changed, "number": self.state["number"]}

    def _acted(self, action: Data) -> Data:
        before, pinned = self.exploration, set(self._pinned)
        try:
            self._do(action)
            return self._shown(action, before)
        except Exception as error:  # the front end waits for an answer, whatever happens: nothing changes
            # A ValueError says what makes no sense of what the reader typed.
            trouble = str(error) if isinstance(error, ValueError) else f"{type(error).__name__}: {error}"
            self.exploration, self._pinned = before, pinned
            return {**self.state["view"], "trouble": trouble, "is_new": False, "asks": [], "is_held": self._is_held}

    def _do(self, action: Data) -> None:
        """Change the contour, or only what is shown of it."""
        kind, now, is_held = action["do"], self.exploration, bool(action.get("is_held"))
        if kind in _CHANGES:
            if self._is_old(action):
                return  # it was meant for what the reader saw before
            changed = _CHANGES[kind](now, action)
            if changed.text != now.text and not (self._is_held and is_held):
                self._begun = now, [*self._past], [*self._future]
                self._past, self._future = [*self._past[-MOST_PAST:], now], []
            if kind in ("write", "program"):
                self._pinned &= _same_words(now, changed)
            self._is_held = is_held and (self._is_held or changed.text != now.text)
            self.exploration = changed
            return
        if kind == "pin":
            self._pinned ^= {str(action["key"])}
        elif kind in ("undo", "redo"):
            back, forth = (self._past, self._future) if kind == "undo" else (self._future, self._past)
            if back:
                forth.append(now)
                self.exploration = back.pop()
        elif kind == "cancel" and self._is_held:
            self.exploration, self._past, self._future = self._begun
        elif kind not in ("release", "cancel"):
            raise ValueError(f"nothing is called {kind!r} here")
        self._is_held = False

    def _shown(self, action: Data, before: Exploration) -> Data:
        """The data that change on the page after an action."""
        kind, is_held = action["do"], bool(action.get("is_held"))
        self._handle = action.get("handle", {}) if is_held else {}
        answer = self.exploration.answer
        if is_calm(self.exploration):
            self._edits = ReaderEdits(self.exploration)
        if self._edits is not None and kind in _CHANGES:
            self._edits = ReaderEdits(self._edits.calm, is_pulled=is_held)
        self._solved = self.exploration if answer is not None and answer.contour is not None else self._solved
        self._drawn = picture_of(answer, self._drawn if is_held else None, self.exploration.tool) if answer else None
        asks: list[Data] = []
        if kind == "fix" and self.exploration is not before:
            example = explorations.apply_fix(before, int(action["finding"]), int(action["fix"]), is_example=True)
            asks = asked_now(self.exploration, before, self._solved, example)
        return {**self._viewed(is_new=kind in _FITTED), "asks": asks}

    def _is_old(self, action: Data) -> bool:
        """Whether an action was meant for another text."""
        mark = self.state["view"]["mark"]
        return bool(action.get("of", mark) != mark)

    def _ranged(self, action: Data) -> Data:
        """The ranges of one word with a contour. They are worked out when nothing else is to do, and kept while they
        hold."""
        key, view, ranges = str(action["key"]), self.state["view"], self.state["ranges"]
        fields = {field["key"]: field for field in view["fields"]}
        frame = view["frames"].get(key)
        if frame is None or key not in fields or ranges.get(key, {}).get("frame") == frame:
            return {}
        try:
            found = range_of(self.exploration, fields[key])
        except Exception:  # nothing is to be told of it, and the front end does not ask again
            found = {}
        return {"ranges": {**ranges, key: {"frame": frame, **found}}}

    def _opened(self, action: Data) -> Data:
        """A section that the reader has opened, for the block as it is now."""
        name, view = str(action["name"]), self.state["view"]
        made = {"of": view["mark"], "html": section_of(self.exploration, name)}
        return {"sections": {**self.state["sections"], name: made}}

    def _ghosted(self, action: Data) -> Data:
        """The contour of a fix or of another solution, over the present picture."""
        now = self.exploration.answer
        if self._drawn is None or now is None:
            return {}
        of: Data = {name: action[name] for name in ("finding", "fix", "solution") if name in action}
        if self._is_old(action):
            return {}
        if "solution" in of:
            instead = shown = explorations.select(self.exploration, of["solution"])
        else:
            instead = explorations.apply_fix(self.exploration, of["finding"], of["fix"])
            shown = explorations.apply_fix(self.exploration, of["finding"], of["fix"], is_example=True)
        return {"ghost": {**of, "text": instead.block, "paths": ghost_of(shown, now, self._drawn)}}

    def _viewed(self, *, is_new: bool = False) -> Data:
        view = view_of(self.exploration, self._drawn, self._pinned, self._handle, self._edits)
        return {
            **view,
            "trouble": "",
            "is_new": is_new,
            "is_held": self._is_held,
            "can_undo": bool(self._past),
            "can_redo": bool(self._future),
            "frames": frames_of(self.exploration),
        }


_WONDERS: Mapping[str, Callable[[Conversation, Data], Data]] = {
    "range": Conversation._ranged,
    "ghost": Conversation._ghosted,
    "section": Conversation._opened,
}
"""Actions that change nothing of the block."""


def _same_words(one: Exploration, other: Exploration) -> set[str]:
    """The keys of words that are the same in both."""
    words = [words_of(each.answer) if each.answer is not None else {} for each in (one, other)]
    return {key for key, word in words[0].items() if key in words[1] and words[1][key].text == word.text}
