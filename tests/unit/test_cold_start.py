"""What a command loads before it answers: counted, as the clock of a test machine tells nothing."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from contoursolve import CONTROLS

COUNTED = """
import re, sys
compile, compiled = re.compile, []
def counted(pattern, flags=0):
    frame = sys._getframe(1)
    compiled.extend([pattern] if frame.f_globals["__name__"].startswith("contoursolve") else [])
    return compile(pattern, flags)
re.compile = counted
from contoursolve.__main__ import main
try:
    main()
finally:
    own = [name for name in sys.modules if name.startswith("contoursolve")]
    print(len(own), len(compiled), *sorted({name.split(".")[0] for name in sys.modules} | {*own}), file=sys.stderr)
"""


def loaded_by(*arguments: str, told: str = "") -> tuple[int, int, set[str]]:
    """The modules of contoursolve that a command loads and the patterns that it compiles: how many of both, and the
    names of these modules and of all packages."""
    command = [sys.executable, "-c", COUNTED, *arguments]
    done = subprocess.run(command, check=False, capture_output=True, text=True, input=told)
    modules, patterns, *names = done.stderr.splitlines()[-1].split()
    return int(modules), int(patterns), {*names}


@pytest.mark.parametrize(
    ("program", "control", "most"),
    [
        ("G00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.", "yasnac_lx3", (164, 69)),
        ("G18 DIAMON G0 X20 Z0\nG1 X40 RND=2\nZ-50", "siemens", (168, 79)),
        ("0 BEGIN PGM A MM\n1 L X+0 Y+0\n2 FL X+20 Y+20\n3 FL AN+0 LEN20\n4 END PGM A MM", "heidenhain", (195, 118)),
    ],
)
def test_the_solve_of_one_block_loads_the_tables_of_its_control_alone(
    program: str, control: str, most: tuple[int, int], tmp_path: Path
) -> None:
    """They were 238 modules of contoursolve and 126 patterns when all controls were loaded."""
    path = tmp_path / "one.nc"
    path.write_text(program, encoding="utf-8")
    modules, patterns, names = loaded_by("solve", str(path))
    tables = {name.split(".")[2] for name in names if name.startswith("contoursolve.controls.")}
    assert tables & {name.replace("-", "_").split("_8")[0] for name in CONTROLS} == {control}
    assert (modules <= most[0], patterns <= most[1]) == (True, True), (modules, patterns)
    assert not names & {"sympy", "scipy", "htpy", "pygls"}


THREADS = """
import os, sys
from contoursolve.__main__ import main
sys.argv = ["contoursolve", "--version"]
try:
    main()
finally:
    told = [os.environ.get(name) for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS")]
    print(*told, "numpy" in sys.modules)
"""


@pytest.mark.parametrize(
    ("own", "told"), [({}, "1 None"), ({"OPENBLAS_NUM_THREADS": "2"}, "2 None"), ({"OMP_NUM_THREADS": "2"}, "None 2")]
)
def test_a_command_takes_one_thread_for_linear_algebra_unless_its_user_says_more(
    own: dict[str, str], told: str
) -> None:
    clean = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    done = subprocess.run([sys.executable, "-c", THREADS], check=True, capture_output=True, text=True, env=clean | own)
    assert done.stdout.splitlines()[-1] == f"{told} False"


def message(method: str, number: int | None = None) -> str:
    told = {"jsonrpc": "2.0", "method": method} | ({} if number is None else {"id": number})
    if method == "initialize":
        told["params"] = {"processId": None, "rootUri": None, "capabilities": {}}
    text = json.dumps(told)
    return f"Content-Length: {len(text)}\r\n\r\n{text}"


def test_an_editor_is_answered_before_anything_is_loaded_that_solves() -> None:
    pytest.importorskip("pygls")
    modules, _, names = loaded_by("lsp", told=message("initialize", 1) + message("shutdown", 2) + message("exit"))
    assert "pygls" in names
    assert not names & {"numpy", "casadi", "flint", "contoursolve.api", "contoursolve.solving"}
    assert modules <= 20
