"""The project file: settings of the controls for all programs of a folder and the folders in it.

`contoursolve.toml`, or the table `tool.contoursolve` of `pyproject.toml`: the control, if programs do not show it, the
baseline of `check`, and one table a control:

    control = "fanuc-mill"
    baseline = "baseline.json"

    [nct-99m]
    circle-circle-q = "right-is-negative"

A program says the same for itself in a comment among its first lines, which counts more:

    (contoursolve control: nct-99m, circle-circle-q: right-is-negative)
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import Any

from contoursolve.controls import CONTROLS
from contoursolve.diagnostics import UserError, checked, did_you_mean
from contoursolve.gcode import MOST_OF_OTHERS, late_pattern, open_regular, read_toml, split_lines
from contoursolve.reading import Control

OWN, SHARED = "contoursolve.toml", "pyproject.toml"

CONTROL = "control"
"""The name of what is no setting of a control, but names the control for which programs are."""


TOOLS = "tools"
"""The name of the table of tools by their T or D words, such as T0101 = {radius = 0.8, tip = 3}; mm."""

BASELINE = "baseline"
"""The name of what is no setting either, but names the file of findings that `check` hides."""


class SettingError(UserError, ValueError):
    """A setting that there is not, or a project file that cannot be read; the message says what there is."""


@checked
def find_settings(folder: Path) -> dict[str, str]:
    """The settings, by `control.name`, of the first project file in a folder or the folders above it.

    Raises SettingError, naming the file.
    """
    found = _find(folder)
    return _settings(*found) if found is not None else {}


def find_baseline(folder: Path) -> Path | None:
    """The baseline that this file names, beside which it lies; None if it names none. Raises SettingError."""
    found = _find(folder)
    named = found[0].get(BASELINE) if found is not None else None
    return found[1].parent / named if found is not None and isinstance(named, str) else None


@checked
def find_tool_table(folder: Path, read: Callable[[str, Mapping[str, Any]], Any] = lambda _, row: row) -> dict[str, Any]:
    """The table of tools of this file, each row as it is read; empty if it has none. Raises SettingError."""
    found = _find(folder)
    tools = found[0].get(TOOLS, {}) if found is not None else {}
    if not isinstance(tools, dict) or not all(isinstance(each, dict) for each in tools.values()):
        raise SettingError(f"{found and found[1]}: write tools as T0101 = {{radius = 0.8, tip = 3}} below [{TOOLS}]")
    rows = dict[str, Any]()
    for name, row in tools.items():
        try:
            rows[name] = read(name, row)
        except ValueError as error:
            raise SettingError(f"{found and _place(found[1], TOOLS, name)}: {TOOLS}.{name}: {error}") from None
    return rows


def _find(folder: Path) -> tuple[dict[str, Any], Path] | None:
    """The table about contoursolve that holds for a folder, and its file."""
    for file in project_files(folder):
        table = _table(file) if file.exists() else None
        if table is not None:
            return table, file
    return None


def project_files(folder: Path) -> Iterator[Path]:
    """Places where the project file of a folder may be; the first one that is there counts."""
    try:
        above = folder.resolve().parents
    except OSError:  # the folder is gone
        return
    yield from (place / name for place in (folder, *above) for name in (OWN, SHARED))


_STATED = late_pattern(r"[(;\[]\s*+contoursolve\s++control\s*+:(?P<stated>[^()\[\]\r\n]*+)", re.IGNORECASE)
FIRST_LINES = 10
"""Of a program, among which it may state its control: an editor looks there, too, for what is meant for it."""


def stated_settings(lines: Iterable[str]) -> dict[str, str]:
    """Settings, by `control.name`, in a comment among the first lines of a program: its control, and settings of that.

    Raises SettingError, naming the line.

    >>> stated_settings(["O0001", "(contoursolve control: nct-99m, circle-circle-q: right-is-negative)"])
    {'control': 'nct-99m', 'nct-99m.circle-circle-q': 'right-is-negative'}
    """
    for number, line in enumerate(islice(lines, FIRST_LINES), 1):
        comment = _STATED.search(line)
        if comment is not None:
            control, *others = (part.strip() for part in comment["stated"].split(","))
            try:
                return _read_stated(control, others)
            except SettingError as error:
                raise SettingError(f"program line {number}: {error}") from None
    return {}


def restate_control(text: str, control: str, settings: Mapping[str, str]) -> str:
    """A program's text with another control and its settings in the comment that states its own, if it has one."""
    lines = split_lines(text)
    for number, line in enumerate(lines[:FIRST_LINES]):
        comment = _STATED.search(line)
        if comment is not None:
            begin, end = comment.span("stated")
            stated = ", ".join((control, *(f"{name}: {value}" for name, value in settings.items())))
            lines[number] = f"{line[:begin]} {stated}{line[end:]}"
            break
    return "".join(lines)


def _read_stated(control: str, others: Iterable[str]) -> dict[str, str]:
    if control not in CONTROLS:
        raise SettingError(_no_control(control))
    settings = {CONTROL: control}
    for other in others:
        name, colon, value = (part.strip() for part in other.partition(":"))
        if not colon or not name or not value:
            raise SettingError(f"{other!r} is no setting; write NAME: VALUE after the control")
        settings[f"{control}.{name}"] = value
    check_settings(settings)
    return settings


def _no_control(name: object) -> str:
    return f"there is no control {name!r}; {did_you_mean(str(name), CONTROLS)}choose from {', '.join(CONTROLS)}"


def read_setting(text: str) -> tuple[str, str]:
    """`control.name=value` as name and value. Raises SettingError."""
    name, equals, value = text.partition("=")
    if not equals or not name.strip() or not value.strip():
        raise SettingError(f"{text!r} is no setting; write CONTROL.NAME=VALUE, such as {_example()}")
    return name.strip(), value.strip()


def configure(control: Control, settings: Mapping[str, str] | None) -> Control:
    """A control, which need not be built in, with those of the settings by `control.name` that are about it.

    Raises SettingError, naming what there is.
    """
    if not settings:
        return control
    return _configured(settings, control).get(control.name, control)


def check_settings(settings: Mapping[str, str]) -> None:
    """Raise SettingError, naming what there is, for a setting that no control has."""
    _configured(settings, None)


def _configured(settings: Mapping[str, str], own: Control | None) -> dict[str, Control]:
    """The controls that settings are about, with these values; `own` is one that need not be built in."""
    names = {*CONTROLS, own.name} if own else {*CONTROLS}
    values: dict[str, dict[str, str]] = {}
    for full, value in settings.items():
        if full == CONTROL:
            continue
        control, _, name = full.partition(".")
        if control not in names or not name:
            meant = did_you_mean(control, names)
            raise SettingError(f"there is no setting {full!r}; {meant}write CONTROL.NAME, such as {_example()}")
        values.setdefault(control, {})[name] = value
    try:
        return {
            control: (own if own and control == own.name else CONTROLS[control]).configure(given)
            for control, given in values.items()
        }
    except ValueError as error:
        raise SettingError(str(error)) from None


def _example() -> str:
    names = (
        f"{control.name}.{setting.name}={setting.default}"
        for control in CONTROLS.values()
        for setting in control.settings
    )
    return next(names, "")


def _table(file: Path) -> dict[str, Any] | None:
    """The table about contoursolve of a file; None if it has none."""
    if file.is_dir():
        if file.name == SHARED:
            return None
        raise SettingError(f"{file} is a directory, not a file of settings")
    is_shared, text = file.name == SHARED, ""
    try:
        text = _text(file)
        if is_shared and "contoursolve" not in text:
            return None  # another tool's business
        data = read_toml(text)
    except UnicodeDecodeError:
        if is_shared:
            return None
        raise SettingError(f"{file} cannot be read: it is not UTF-8 text") from None
    except RecursionError:
        if is_shared and "tool.contoursolve" not in text:
            return None
        raise SettingError(f"{file} cannot be read: its brackets are nested too deeply") from None
    except (OSError, ValueError) as error:
        # A number of thousands of digits is a ValueError, too.
        if is_shared and "tool.contoursolve" not in text:
            return None
        reason = (str(error.strerror) if isinstance(error, OSError) else str(error)).partition(";")[0]
        raise SettingError(f"{file} cannot be read: {reason}") from None
    tool = data if not is_shared else data.get("tool")
    table = tool.get("contoursolve") if is_shared and isinstance(tool, dict) else tool
    return table if isinstance(table, dict) else None


_MOST = 50_000
"""Bytes of a file of settings; all settings of all controls take 1,000."""


def _text(file: Path) -> str:
    with open_regular(file, _MOST if file.name == OWN else MOST_OF_OTHERS) as opened:
        return opened.read().decode("utf-8")


def _settings(table: Mapping[str, Any], file: Path) -> dict[str, str]:
    settings: dict[str, str] = {}
    for control, own in table.items():
        if control == TOOLS:
            continue
        if control == CONTROL and own in CONTROLS:
            settings[CONTROL] = own
            continue
        if control == CONTROL:
            raise SettingError(f"{_place(file, CONTROL)}: {_no_control(own)}")
        if control == BASELINE and isinstance(own, str) and own.strip():
            continue
        if control == BASELINE:
            raise SettingError(
                f'{_place(file, BASELINE)}: {own!r} is no file of a baseline; write baseline = "FILE.json"'
            )
        if not isinstance(own, dict):
            meant = did_you_mean(control, (CONTROL, BASELINE)) or "write [CONTROL] above it, such as [nct-99m]"
            raise SettingError(f"{_place(file, control)}: {control!r} stands in no table; {meant.strip()}")
        if control not in CONTROLS:
            meant = did_you_mean(control, (TOOLS, *CONTROLS)) or f"tables are: {TOOLS}, {', '.join(CONTROLS)}"
            raise SettingError(f"{_place(file, control)}: there is no table [{control}]; {meant.strip()}")
        for name, value in own.items():
            if isinstance(value, (dict, list)):
                told = _place(file, control, name)
                raise SettingError(f"{told}: {control}.{name} is a table or a list; write {name} = VALUE")
            settings[f"{control}.{name}"] = str(value)
            try:
                check_settings({f"{control}.{name}": str(value)})
            except SettingError as error:
                raise SettingError(f"{_place(file, control, name)}: {error}") from None
    return settings


def _place(file: Path, *keys: str) -> str:
    """A file of settings, and the line in it that has a key, or what is nearest above it: its table."""
    table: tuple[str, ...] = ()
    wanted = ("tool", "contoursolve", *keys) if file.name == SHARED else keys
    known: dict[tuple[str, ...], int] = {(): 0}
    for number, line in enumerate(_text(file).splitlines(), 1):
        found = _KEY.match(line)
        if found is not None:
            names = tuple("".join(each) for each in _NAME.findall(found["table"] or found["key"]))
            table, names = (names, names) if found["table"] else (table, (*table, *names))
            known.setdefault(names, number)
    line_number = next((known[wanted[:most]] for most in range(len(wanted), -1, -1) if wanted[:most] in known), 0)
    return f"{file}, line {line_number}" if line_number else str(file)


_KEY = re.compile(r"\s*(?:\[\[?(?P<table>[^\]#]+)\]|(?P<key>[^=#\[]+)=)")
_NAME = re.compile(r"\"([^\"]*)\"|'([^']*)'|([\w-]+)")
"""The line of a table or of a key, and one of the names in it, between which are dots."""
