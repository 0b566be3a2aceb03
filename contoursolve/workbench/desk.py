"""The desk of the workbench: what a page asks for, and what it is told. No web is known here.

`Desk.answer` takes an action and gives a reply, both plain data. It raises nothing: what goes wrong is one sentence,
and the reader's text stays.
"""

import base64
import binascii
import logging
from codecs import BOM_UTF8
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from secrets import token_hex
from threading import Lock
from typing import Any

from msgspec import ValidationError, convert
from msgspec.structs import replace

import contoursolve
from contoursolve.controls import CONTROLS, DRAWINGS, ChainFinder, ControlName, words_of_drawing
from contoursolve.diagnosis import word_keys
from contoursolve.diagnostics import ProgramError, UserError
from contoursolve.gcode import typed_places
from contoursolve.output import notebook_style
from contoursolve.postprocess import MachineKind, machine_of
from contoursolve.program import for_kind, likely_fixes, mend_open, safe_fixes
from contoursolve.workbench.explored import Explored
from contoursolve.workbench.fields import ActionError, Data, read_field
from contoursolve.workbench.files import ENCODINGS, FileConflictError, FileText, Folder, mark_of, safe_name, text_of
from contoursolve.workbench.open_view import ProgramView, TextEdit

logger = logging.getLogger(__name__)

MOST_WINDOWS, MOST_PROGRAMS = 32, 16
"""Windows that are known, and programs that each has. The oldest go first; a page opens them again with its text."""

MOST_EXAMINED, MOST_LINES = 8, 200_000
"""Programs of all windows, and their lines, that stay examined: 10,000 lines take 40 MB."""


class PageWindow:
    """A window, and its programs by their numbers."""

    def __init__(self) -> None:
        self.programs: dict[str, ProgramView] = {}
        self.busy = 0


class Desk:
    """The programs that are open in the windows of a page. Actions of one window come one after the other; those of
    several may come at once.

    >>> desk = Desk()
    >>> reply = desk.answer({"window": "a", "do": "open", "name": "part.nc", "text": "G00 X40. Z0.\\nG01 Z-60."})
    >>> reply["name"], reply["lines"], reply["has_changes"]
    ('part.nc', 2, True)
    """

    def __init__(self, folder: Path | None = None, *, first: str = "") -> None:
        self.folder = Folder(folder) if folder is not None else None
        self.first = first
        self._windows: dict[str, PageWindow] = {}
        self._examined: dict[str, tuple[PageWindow, ProgramView]] = {}
        """The programs that may be examined, the newest last."""
        self._lock = Lock()

    def answer(self, action: Mapping[str, Any]) -> Data:
        """The reply to an action of a window."""
        do = action.get("do") if isinstance(action, Mapping) else None
        try:
            if not isinstance(do, str) or do not in ACTIONS:
                raise ActionError(f"nothing is called {do!r} here")
            with self._window(action) as window:
                return ACTIONS[do](self, window, action)
        except FileConflictError as error:
            return {"trouble": str(error), "conflict": error.mark}
        except ActionError as error:
            return {"trouble": str(error), **error.more}
        except (UserError, ProgramError, ValueError) as error:
            return {"trouble": str(error)}
        except Exception as error:  # the page waits for an answer, whatever happens
            logger.exception("%s", do)
            return {"trouble": f"{do} did not work: {type(error).__name__}: {error}; please report it"}

    @contextmanager
    def _window(self, action: Mapping[str, Any]) -> Iterator[PageWindow]:
        """The window of an action, the newest from now on; afterwards, the oldest programs are put to rest."""
        name = str(action.get("window", ""))[:_LONGEST_NAME]
        with self._lock:
            window = self._windows.pop(name, None) or PageWindow()
            self._windows[name] = window
            window.busy += 1
            while len(self._windows) > MOST_WINDOWS:
                del self._windows[next(iter(self._windows))]
        try:
            yield window
        finally:
            with self._lock:
                window.busy -= 1
                self._rest()

    def _rest(self) -> None:
        lines = sum(view.line_count for _, view in self._examined.values())
        for number, (window, view) in [*self._examined.items()][:-1]:
            if len(self._examined) <= MOST_EXAMINED and lines <= MOST_LINES:
                break
            if not window.busy:
                lines -= view.line_count
                view.rest()
                del self._examined[number]

    def program(self, window: PageWindow, action: Mapping[str, Any]) -> ProgramView:
        """The program of an action, the newest of its window from now on. Raises ActionError."""
        number = str(action.get("program", ""))
        found = window.programs.pop(number, None)
        if found is None:
            raise ActionError("the workbench does not have this program any more; open it again", is_gone=True)
        self._keep(window, found)
        return found

    def _keep(self, window: PageWindow, view: ProgramView) -> None:
        """Take a program for the newest of its window, and of all."""
        window.programs[view.number] = view
        while len(window.programs) > MOST_PROGRAMS:
            self.close(window, next(iter(window.programs)))
        with self._lock:
            self._examined.pop(view.number, None)
            self._examined[view.number] = window, view

    def add(self, window: PageWindow, file: FileText, control: ControlName | None) -> ProgramView:
        """Another program of a window."""
        path = self.folder.path / file.name if self.folder is not None else None
        # No page may take it for one that it has from a desk before.
        view = ProgramView(token_hex(8), file, path)
        view.configure(control)
        self._keep(window, view)
        return view

    def close(self, window: PageWindow, number: str) -> None:
        """Forget a program of a window."""
        with self._lock:
            window.programs.pop(number, None)
            self._examined.pop(number, None)

    def files(self) -> Folder:
        """The folder. Raises ActionError where there is none."""
        if self.folder is None:
            raise ActionError("there is no folder here: open a file by dropping it, and save it by your browser")
        return self.folder


_LONGEST_NAME = 64

# Actions ------------------------------------------------------------------------------------------------------------


def _hello(desk: Desk, _window: PageWindow, _action: Mapping[str, Any]) -> Data:
    return {
        "version": contoursolve.__version__,
        "controls": [
            {
                "name": name,
                "title": each.title,
                "may_be_target": isinstance(each.find, ChainFinder),
                "machines": [kind.value for kind in MachineKind if machine_of(for_kind(each, {}, kind.value)) is kind],
            }
            for name, each in CONTROLS.items()
        ],
        "folder": desk.folder.name if desk.folder is not None else "",
        "may_write": desk.folder is not None,
        "open": desk.first,
        "style": notebook_style(has_tool=True),
        "drawing_words": {
            part: {kind: dict(words_of_drawing(part, kind)) for kind in ("line", "arc")} for part in DRAWINGS
        },
        "examples": [{"control": name, "title": each.title} for name, each in CONTROLS.items()],
    }


def _files(desk: Desk, _window: PageWindow, _action: Mapping[str, Any]) -> Data:
    found, left_out = desk.files().names()
    return {"files": found, "left_out": left_out}


def _open(desk: Desk, window: PageWindow, action: Mapping[str, Any]) -> Data:
    control, name = _control_of(action), read_field(action, "name", str, "program.nc")
    if "example" in action:
        name, text = _example(read_field(action, "example", str))
        return desk.add(window, FileText(name, text), control or action["example"]).view(is_whole=True)
    if "base64" in action:
        data = _bytes(action)
        return desk.add(window, text_of(data, safe_name(name), is_file=False), control).view(is_whole=True)
    if "text" not in action:
        return desk.add(window, desk.files().read(name), control).view(is_whole=True)
    program = desk.add(window, _kept(desk, action, name), control)
    program.replace(read_field(action, "text", str))
    program.seq = 0
    return program.view(is_whole=True)


def _kept(desk: Desk, action: Mapping[str, Any], name: str) -> FileText:
    """The file of a text that a page has kept: as it is, with the mark that the page knows; else what the page says of
    it."""
    base, encoding = read_field(action, "base", str, ""), read_field(action, "encoding", str, "utf-8")
    line_end = read_field(action, "line_end", str, "\n")
    if encoding not in ENCODINGS or line_end not in ("\n", "\r\n", "\r"):
        raise ActionError(f"programs are in {' or '.join(ENCODINGS)}, with lines that end in LF, CRLF or CR")
    if base and desk.folder is not None:
        with suppress(UserError):
            return replace(desk.folder.read(name), mark=base)
    order_mark = BOM_UTF8 if read_field(action, "has_order_mark", bool, False) else b""
    return FileText(safe_name(name), line_end, encoding, order_mark, base)


def _example(control: str) -> tuple[str, str]:
    """The name and the text of a small program with a mistake, for a control: a corner that does not fit, if it has an
    example of that."""
    known = CONTROLS.get(control)
    if known is None:
        raise ActionError(f"{control!r} is no control here")
    rules = sorted(known.catalogue, key=lambda rule: not rule.code.endswith("corner-too-large"))
    return f"example-{control}.nc", f"{rules[0].rejected[0]}\n"


def _edit(program: ProgramView, action: Mapping[str, Any]) -> Data:
    if "text" in action:
        program.replace(read_field(action, "text", str))
    else:
        _check_seq(program, action)
        try:
            program.edit(convert(action.get("edits"), list[TextEdit]))
        except ValidationError:
            raise ActionError("edits are a list of {from, to, text}; nothing was changed") from None
    try:
        return program.view()
    except Exception as error:  # the text is the reader's: it stays, whatever cannot be said of it
        logger.exception("edit")
        program.rest()
        return {
            "trouble": f"this text could not be examined: {type(error).__name__}: {error}; please report it",
            "seq": program.seq,
        }


def _check_seq(program: ProgramView, action: Mapping[str, Any]) -> None:
    if action.get("seq") != program.seq:
        raise ActionError(
            "this was meant for another text of the program; nothing was changed",
            is_old=True,
            text="\n".join(program.lines()),
            seq=program.seq,
        )


def _set_control(program: ProgramView, action: Mapping[str, Any]) -> Data:
    program.configure(_control_of(action))
    return program.view(is_whole=True)


def _fix(program: ProgramView, action: Mapping[str, Any]) -> Data:
    _check_seq(program, action)
    finding, lines = program.finding(read_field(action, "finding", int))
    number = read_field(action, "fix", int)
    if not 0 <= number < len(finding.fixes):
        raise ActionError(f"there is no fix {number + 1} of this finding; nothing was changed")
    edits = program.changed_by(program.program.edits_of(program.changes_of(finding.fixes[number], lines)))
    return {**program.view(), "edits": edits}


_WAYS = {"safe": safe_fixes, "likely": likely_fixes}


def _fix_all(program: ProgramView, action: Mapping[str, Any]) -> Data:
    way = _WAYS.get(read_field(action, "kind", str, "safe"))
    if way is None:
        raise ActionError("all fixes are applied by kind: safe, or likely")
    mended = mend_open(program.program, way)
    edits = program.become(mended.text)
    left = [{"line": each.line, "text": f"{each.fix.description}: {each.trouble}"} for each in mended.left]
    return {**program.view(), "edits": edits, "applied": len(mended.applied), "left": left}


def _look(program: ProgramView, action: Mapping[str, Any]) -> Data:
    return _explored(program, program.look(read_field(action, "line", int)))


def _act(program: ProgramView, action: Mapping[str, Any]) -> Data:
    changed, edits = program.act(read_field(action, "action", dict), read_field(action, "line", int))
    return {**_explored(program, program.explored, changed), **({**program.view(), "edits": edits} if edits else {})}


def _explored(program: ProgramView, explored: Explored | None, changed: Data | None = None) -> Data:
    """The reply about the contour that is explored."""
    if explored is None:
        return {"line": None, "last": None}
    told: Data = {"state": explored.conversation.state} if changed is None else {"changed": changed}
    answer = explored.conversation.exploration.answer
    words, blocks = (answer.claim.words.values(), answer.claim.blocks) if answer is not None else ((), ())
    typed, keys = typed_places(words, blocks), word_keys(words)
    own = {key: typed[span].span for span, key in keys.items() if explored.first <= span.line <= explored.last}
    places = {key: program.stretch(span) for key, span in own.items()}
    told["words"] = {key: [each["line"], each["from"], each["to"]] for key, each in places.items()}
    return {"line": explored.first, "last": explored.last, "seq": program.seq, **told}


def _save(desk: Desk, window: PageWindow, action: Mapping[str, Any]) -> Data:
    if action.get("program") is None:
        return _save_other(desk, action)
    program, folder = desk.program(window, action), desk.files()
    file = program.file
    name = read_field(action, "name", str, file.name)
    base = read_field(action, "over", str, file.mark if name == file.name else "")
    mark = folder.write(name, replace(file, name=name).encode(program.text), base)
    program.file = replace(file, name=name, mark=mark)
    return {"saved": name, "base": mark, "has_changes": False, "seq": program.seq}


def _save_other(desk: Desk, action: Mapping[str, Any]) -> Data:
    """Save what is no program that is open: a sketch, or what was made of a program."""
    name, base = read_field(action, "name", str), read_field(action, "base", str, "")
    data = _bytes(action) if "base64" in action else read_field(action, "text", str).encode("utf-8")
    return {"saved": name, "base": desk.files().write(name, data, read_field(action, "over", str, base))}


def _file_of(desk: Desk, action: Mapping[str, Any]) -> bytes:
    """The file that an action brings, or names in the folder. Raises ActionError and FileRefusedError."""
    return _bytes(action) if "base64" in action else desk.files().read_bytes(read_field(action, "name", str))


def _read_sketch(desk: Desk, _window: PageWindow, action: Mapping[str, Any]) -> Data:
    name, mark = read_field(action, "name", str), ""
    if "text" in action:
        text = read_field(action, "text", str)
    else:
        data = _file_of(desk, action)
        mark = mark_of(data) if "base64" not in action else ""
        try:
            text = data.decode("utf-8")
        except UnicodeDecodeError:
            raise ActionError(f"{name} is no sketch: a sketch is TOML or JSON in UTF-8") from None
    return {**_later("sketching").sketch_in(text), "name": name, "base": mark}


def _close(desk: Desk, window: PageWindow, action: Mapping[str, Any]) -> Data:
    desk.close(window, str(action.get("program", "")))
    return {}


def _later(module: str) -> Any:
    """A module that a page asks for after it is shown."""
    return import_module(f"contoursolve.workbench.{module}")


def _of(answer: Callable[[ProgramView, Mapping[str, Any]], Data]) -> "Answering":
    """The answer by the program of an action."""
    return lambda desk, window, action: answer(desk.program(window, action), action)


def _made(view: ProgramView, action: Mapping[str, Any]) -> Data:
    made: Data = _later("products").answer_with(action["do"], view, action)
    return made


def _compare(desk: Desk, window: PageWindow, action: Mapping[str, Any]) -> Data:
    new = desk.program(window, {**action, "program": action.get("with")})
    told: Data = _later("products").compared(desk.program(window, action), new)
    return told


Answering = Callable[[Desk, PageWindow, Mapping[str, Any]], Data]

ACTIONS: dict[str, Answering] = {
    "hello": _hello,
    "files": _files,
    "open": _open,
    "view": _of(lambda program, _: program.view(is_whole=True)),
    "go_on": _of(lambda program, _: program.view()),
    "edit": _of(_edit),
    "control": _of(_set_control),
    "fix": _of(_fix),
    "fix_all": _of(_fix_all),
    "look": _of(_look),
    "act": _of(_act),
    "compare": _compare,
    "save": _save,
    "close": _close,
    **dict.fromkeys(
        ("drawing", "tool", "variables", "expand", "convert", "report", "dxf", "png", "verify"), _of(_made)
    ),
    "sketch": lambda _desk, _window, action: _later("sketching").known_of_sketch(action),
    "sketch_words": lambda _desk, _window, action: _later("sketching").words_of_sketch(action),
    "sketch_open": _read_sketch,
    "dxf_in": lambda desk, _window, action: _later("sketching").sketch_in_drawing(_file_of(desk, action), action),
}
"""Functions that answer, by the name of the action."""


def _control_of(action: Mapping[str, Any]) -> ControlName | None:
    """The control that an action chooses; None where it chooses none."""
    control: str | None = read_field(action, "control", str, None)
    found = next((each for each in CONTROLS if each == control), None)
    if control is not None and found is None:
        raise ActionError(f"{control!r} is no control here")
    return found


def _bytes(action: Mapping[str, Any]) -> bytes:
    try:
        return base64.b64decode(read_field(action, "base64", str), validate=True)
    except binascii.Error:
        raise ActionError("the file did not arrive whole; drop it again") from None
