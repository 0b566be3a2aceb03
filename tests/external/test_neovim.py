"""Neovim with the lines of docs/editors.md: it shows the findings of a program, and applies fixes."""

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from contoursolve import Severity, check, fix

pytestmark = [pytest.mark.editor, pytest.mark.needs("pygls", "lsprotocol")]

ROOT = Path(__file__).parents[2]
FIRST_WITH_CONFIG = (0, 11)
LONGEST = 60_000
"""Milliseconds that the server may take to start and to answer on a busy machine."""

DRIVER = """
local longest, errors = LONGEST, { severity = vim.diagnostic.severity.ERROR }
local seen = {}

local function look(name)
  seen[name] = vim.tbl_map(function(each)
    return { line = each.lnum + 1, code = each.code or each.user_data.lsp.code, message = each.message }
  end, vim.diagnostic.get(0, errors))
end

local function ask(method, params)
  for _, answer in pairs(vim.lsp.buf_request_sync(0, method, params, longest) or {}) do
    return answer.result
  end
end

local function drive()
  vim.wait(longest, function() return #vim.diagnostic.get(0, errors) >= EXPECTED end)
  look("before")
  local found = vim.diagnostic.get(0, errors)[2]
  vim.api.nvim_win_set_cursor(0, { found.lnum + 1, found.col })
  local params = vim.lsp.util.make_range_params(0, "utf-16")
  params.context = { diagnostics = { { range = params.range, message = found.message, severity = 1 } } }
  local actions = ask("textDocument/codeAction", params)
  seen.actions = vim.tbl_map(function(each) return each.title end, actions)
  local action = actions[1].edit and actions[1] or ask("codeAction/resolve", actions[1])
  vim.lsp.util.apply_workspace_edit(action.edit, "utf-16")
  vim.wait(longest, function() return #vim.diagnostic.get(0, errors) < #seen.before end)
  look("after")
  params.context = { diagnostics = {}, only = { "source.fixAll.contoursolve" } }
  local all = ask("textDocument/codeAction", params)[1]
  all = all.edit and all or ask("codeAction/resolve", all)
  vim.lsp.util.apply_workspace_edit(all.edit, "utf-16")
  seen.fixed = vim.api.nvim_buf_get_lines(0, 0, -1, false)
  seen.filetype = vim.bo.filetype
end

local done, trouble = xpcall(drive, debug.traceback)
seen.trouble = not done and trouble or nil
vim.fn.writefile({ vim.json.encode(seen) }, "seen.json")
vim.cmd("qall!")
"""


def version_of(nvim: str) -> tuple[int, int]:
    said = subprocess.run([nvim, "--version"], capture_output=True, text=True, check=True).stdout
    major, minor = re.search(r"v(\d+)\.(\d+)", said).groups()
    return int(major), int(minor)


def lines_of(name: str) -> str:
    """The lines of the page for an editor."""
    page = (ROOT / "docs" / "editors.md").read_text(encoding="utf-8")
    (found,) = re.findall(rf"<!-- {re.escape(name)} -->\n```\w+\n(.*?)```", page, re.DOTALL)
    return found


@pytest.mark.skipif(sys.platform == "win32", reason="the command is a script for a shell")
def test_neovim_shows_findings_and_applies_a_fix(tmp_path, request) -> None:
    nvim = shutil.which("nvim")
    if nvim is None:
        (pytest.fail if request.config.getoption("--insist") else pytest.skip)(
            "needs nvim (Debian: apt-get install neovim)"
        )
    command = tmp_path / "bin" / "contoursolve"
    command.parent.mkdir()
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m contoursolve "$@"\n', encoding="utf-8")
    command.chmod(0o755)
    program = Path(shutil.copy(ROOT / "notebooks" / "programs" / "shaft_broken.nc", tmp_path))
    expected = [each for each in check(program) if each.severity is Severity.ERROR]
    name = "neovim" if version_of(nvim) >= FIRST_WITH_CONFIG else "neovim-0.7"
    (tmp_path / "init.lua").write_text(lines_of(name), encoding="utf-8")
    (tmp_path / "driver.lua").write_text(
        DRIVER.replace("LONGEST", str(LONGEST)).replace("EXPECTED", str(len(expected))), encoding="utf-8"
    )

    own = {"PATH": f"{command.parent}{os.pathsep}{os.environ['PATH']}", "PYTHONPATH": str(ROOT), "HOME": str(tmp_path)}
    own |= {f"XDG_{each}_HOME": str(tmp_path / each.lower()) for each in ("CONFIG", "DATA", "STATE", "CACHE")}
    opened = [nvim, "--headless", "-n", "-u", "init.lua", program.name, "-c", "luafile driver.lua"]
    done = subprocess.run(
        opened, cwd=tmp_path, env=os.environ | own, capture_output=True, text=True, timeout=240, check=False
    )
    seen = json.loads((tmp_path / "seen.json").read_text(encoding="utf-8"))

    assert "trouble" not in seen, (seen["trouble"], done.stderr)
    assert [(each["line"], each["code"]) for each in seen["before"]] == [
        (each.span.line, each.code) for each in expected
    ]
    mended = expected[1]
    assert mended.fixes[0].description.split(" ->")[0] in seen["actions"][0]
    assert [each["line"] for each in seen["after"]] == [each.span.line for each in expected if each is not mended]
    first = mended.fixes[0]
    wanted = fix(program.read_text(encoding="utf-8").replace(first.replaced, first.replacement, 1))
    assert wanted.applied
    assert seen["fixed"] == wanted.text.splitlines()
    assert first.replacement in seen["fixed"]
    assert seen["filetype"] == "gcode"
