"""What is missing is told in the way in which contoursolve was installed."""

import sys

import pytest

import contoursolve
from contoursolve.pictures import draw_answer

_ANSWER = contoursolve.solve("G111 X100. A180. K-30. B120.", start="X40. Z0.").answers[0]
_PIPX = "pipx_metadata.json", '{"main_package": {"package": "contoursolve"}}'


def _receipt(requirements: str) -> tuple[str, str]:
    return "uv-receipt.toml", f"[tool]\nrequirements = [{requirements}]\nentrypoints = []\n"


@pytest.mark.parametrize(
    ("files", "command"),
    [
        ([], f'{sys.executable} -m pip install "contoursolve[picture]"'),
        ([("pyvenv.cfg", "home = /usr/bin\nversion = 3.12\n")], f"{sys.executable} -m pip install"),
        ([_PIPX], 'pipx inject tool "contoursolve[picture]"'),
        # As uv 0.13 writes them: from an index, from folders, with packages beside it.
        ([_receipt('{ name = "contoursolve" }')], 'uv tool install "contoursolve[picture]"'),
        (
            [_receipt('{ name = "contoursolve", extras = ["app", "report"] }, { name = "rich" }')],
            'uv tool install --with rich "contoursolve[app,picture,report]"',
        ),
        (
            [_receipt('{ name = "contoursolve", extras = ["dxf"], directory = "/my programs/contoursolve" }')],
            'uv tool install "/my programs/contoursolve[dxf,picture]"',
        ),
        (
            [_receipt('{ name = "contoursolve", editable = "/src" }')],
            'uv tool install --editable "/src[picture]"',
        ),
        # A tool of uv that has contoursolve beside it.
        (
            [_receipt('{ name = "jupyter" }, { name = "contoursolve" }'), ("pyvenv.cfg", "uv = 0.13.9\n")],
            f'uv pip install --python {sys.executable} "contoursolve[picture]"',
        ),
        ([("pyvenv.cfg", "uv = 0.13.9\n")], f'uv pip install --python {sys.executable} "contoursolve[picture]"'),
    ],
    ids=map(str, range(9)),
)
def test_a_missing_package_is_installed_as_contoursolve_was(monkeypatch, tmp_path, files, command):
    prefix = tmp_path / "tool"
    prefix.mkdir()
    for name, text in files:
        prefix.joinpath(name).write_text(text, encoding="utf-8")
    monkeypatch.setattr(sys, "prefix", str(prefix))
    if "uv pip" in command:
        monkeypatch.setattr("contoursolve.diagnostics.extras.find_spec", lambda name: None)
    assert f"install it with: {command}" in _told(monkeypatch)


def test_the_program_without_python_says_that_it_lacks_the_package(monkeypatch):
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    assert _told(monkeypatch) == (
        "a PNG picture needs resvg_py; this program is without it; "
        'where there is Python, install: python -m pip install "contoursolve[picture]"'
    )


def _told(monkeypatch) -> str:
    monkeypatch.setitem(sys.modules, "resvg_py", None)
    with pytest.raises(contoursolve.errors.MissingExtraError) as refused:
        draw_answer(_ANSWER).png()
    return str(refused.value)
