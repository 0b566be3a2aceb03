"""The project file: settings of the controls for all programs of a folder and the folders in it.

`contoursolve.toml`, or the table `tool.contoursolve` of `pyproject.toml`, with one table a control:

    [nct-99m]
    circle-circle-q = "right-is-negative"
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from contoursolve.dialects import DIALECTS, Dialect

OWN, SHARED = "contoursolve.toml", "pyproject.toml"


class SettingError(ValueError):
    """A setting that there is not, or a project file that cannot be read; the message says what there is."""


def find_settings(folder: Path) -> dict[str, str]:
    """The settings, by `control.name`, of the first project file in a folder or the folders above it.

    Raises SettingError, naming the file.
    """
    for place in (folder, *folder.resolve().parents):
        for name in (OWN, SHARED):
            file = place / name
            table = _table(file) if file.exists() else None
            if table is not None:
                return _settings(table, file)
    return {}


def read_setting(text: str) -> tuple[str, str]:
    """`control.name=value` as name and value. Raises SettingError."""
    name, equals, value = text.partition("=")
    if not equals or not name.strip() or not value.strip():
        raise SettingError(f"{text!r} is no setting; write CONTROL.NAME=VALUE, such as {_example()}")
    return name.strip(), value.strip()


def configure(dialect: Dialect, settings: Mapping[str, str] | None) -> Dialect:
    """A control, which need not be built in, with those of the settings by `control.name` that are about it.

    Raises SettingError, naming what there is.
    """
    if not settings:
        return dialect
    return _configured(settings, {**DIALECTS, dialect.name: dialect}).get(dialect.name, dialect)


def check_settings(settings: Mapping[str, str]) -> None:
    """Raise SettingError, naming what there is, for a setting that no control has."""
    _configured(settings, DIALECTS)


def _configured(settings: Mapping[str, str], controls: Mapping[str, Dialect]) -> dict[str, Dialect]:
    """The controls that settings are about, with these values."""
    values: dict[str, dict[str, str]] = {}
    for full, value in settings.items():
        control, _, name = full.partition(".")
        if control not in controls or not name:
            raise SettingError(f"there is no setting {full!r}; write CONTROL.NAME, such as {_example()}")
        values.setdefault(control, {})[name] = value
    try:
        return {control: controls[control].configure(given) for control, given in values.items()}
    except ValueError as error:
        raise SettingError(str(error)) from None


def _example() -> str:
    names = (
        f"{dialect.name}.{setting.name}={setting.default}"
        for dialect in DIALECTS.values()
        for setting in dialect.settings
    )
    return next(names, "")


def _table(file: Path) -> dict[str, Any] | None:
    """What a file says about contoursolve; None if nothing."""
    import tomllib  # noqa: PLC0415 - most folders have no such file

    if file.is_dir():
        if file.name == SHARED:
            return None
        raise SettingError(f"{file} is a directory, not a file of settings")
    text = ""
    try:
        text = file.read_text(encoding="utf-8")
        data = tomllib.loads(text)
    except UnicodeDecodeError:
        if file.name == SHARED:
            return None  # another tool's business
        raise SettingError(f"{file} cannot be read: it is not UTF-8 text") from None
    except (OSError, tomllib.TOMLDecodeError) as error:
        if file.name == SHARED and "tool.contoursolve" not in text:
            return None  # another tool's business
        raise SettingError(f"{file} cannot be read: {error}") from None
    if file.name == OWN:
        return data
    tool = data.get("tool", {}).get("contoursolve")
    return tool if isinstance(tool, dict) else None


def _settings(table: Mapping[str, Any], file: Path) -> dict[str, str]:
    settings = {
        f"{control}.{name}": str(value)
        for control, own in table.items()
        if isinstance(own, dict)
        for name, value in own.items()
    }
    for name, own in table.items():
        if not isinstance(own, dict):
            raise SettingError(f"{file}: {name!r} stands in no table; write [CONTROL] above it, such as [nct-99m]")
    try:
        check_settings(settings)
    except SettingError as error:
        raise SettingError(f"{file}: {error}") from None
    return settings
