"""What a user can type, name or close never ends in a traceback: there is a message, and a status that says which."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import contoursolve
from contoursolve.cli import main

BLOCK = ("--block", "G111 X100. A180. K-30. B120.", "--start", "X40. Z0.")
PROGRAM = "G00 X40. Z0.\nG111 X100. A180. B120.\n"
ODD = os.fsdecode(b"\xff")
"""A byte that is not UTF-8, as the command line has it."""


def run(*arguments: str, status: int | None = None, says: str = "") -> Result:
    result = CliRunner().invoke(main, arguments)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exc_info
    assert result.exit_code in (0, 1, 2) if status is None else result.exit_code == status, result.output
    assert says in result.output
    return result


ARCS = "G17 G90 G00 X0. Y0.\nG02 I20. J0. R20. F500\nG03 X80. Y0. R25. H0\n"
SKETCH = 'sketch = 1\npart = "milled"\nstart = { X = 0, Y = 0 }\n[[element]]\nkind = "line"\nX = 20\nAN = 30\n'
CHAIN = "--start|X0 Y0|--block|FL AN+0 LEN20|--block|FCT DR+ R10 CCA+0|--block|FLT LEN10|--control|heidenhain"


@pytest.mark.parametrize(
    ("words", "status"),
    [
        ("check|arcs.nc|--control|mitsubishi", 1),
        ("solve|arcs.nc|--control|mitsubishi", 1),
        ("diff|arcs.nc|other.nc|--control|mitsubishi", 1),
        ("verify|arcs.nc|arcs.json", 0),
        (f"family|{CHAIN}|--vary|2:R=0,10,-1", 0),
        (f"ranges|{CHAIN}|--word|2:R", 0),
        (f"find|{CHAIN}|--word|2:R|--goal|P3 Y20", 0),
        (f"sensitivity|{CHAIN}", 0),
        (f"tolerances|{CHAIN}|--tolerance|2:R=0.1", 0),
        ("write|sketch.toml|--to|fanuc-mill", 0),
        ("rules|--control|isg", 0),
    ],
    ids=lambda value: value.partition("|")[0] if isinstance(value, str) else "",
)
def test_nothing_but_the_document_is_on_standard_output(tmp_path, monkeypatch, capfd, words, status):
    """Every command that prints JSON, seen where the process writes: libraries print past `sys.stdout`."""
    monkeypatch.chdir(tmp_path)
    Path("arcs.nc").write_text(ARCS)
    Path("other.nc").write_text(ARCS.replace("R25", "R26"))
    Path("sketch.toml").write_text(SKETCH)
    if words.startswith("verify"):
        Path("arcs.json").write_text(run("solve", "arcs.nc", "--control", "mitsubishi", "--format", "json").output)
    with pytest.raises(SystemExit) as ended:
        main([*words.split("|"), "--format", "json"])
    done = capfd.readouterr()
    assert (ended.value.code, done.err) == (status, "")
    assert json.loads(done.out)["schema"].startswith("contoursolve/")


def test_every_command_that_prints_json_is_tried():
    tried = {
        words.partition("|")[0]
        for words, _ in test_nothing_but_the_document_is_on_standard_output.pytestmark[0].args[1]
    }
    for name in main.list_commands(None):
        options = {option for each in main.get_command(None, name).params for option in each.opts}
        assert ("--format" in options) == (name in tried), name


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("start", ["X60. Z-10.002", "X60. Z-10.005", "X60. Z-10.009"])
@pytest.mark.parametrize("block", ["G111 X100. A180. K-30. B120.", "G111 X100.", "G111 A180. K-30. Z-50. B120."])
def test_radii_of_an_arc_on_a_lathe_that_differ_a_little_lose_no_program(start, block):
    text = f"G0 X40. Z0.\nG02 {start} I10. J0.\n{block}"
    for rules in ("enforce", "warn", "off"):
        result = contoursolve.solve(text, control="yasnac-lx3", rules=rules)
        found = {each.code: each for each in result.diagnostics}
        assert "arc-outside-plane" in found or rules == "off"
        assert not any(code in found for code in ("arc-radii-differ", "arc-spiral"))
        assert result.answers


@pytest.mark.parametrize(("values", "says"), [
    ("A=0:1e5000:1", "beyond all travel"),
    ("A=0:1:1e-9999999999", "at most 30 decimals"),
    ("A=1e9999999999:1:1", "beyond all travel"),
    ("A=0:1e99999999:1e99999998", "beyond all travel"),
    ("A=1,1e308", "beyond all travel"),
    ("K=-1e308", "beyond all travel"),
    ("A=nan", "finite"),
    ("A=@big.csv", "field larger than"),
    ("A=@quoted.csv", "field larger than"),
    ("A=@far.csv", "beyond 1,000,000"),
    ("A=@nul.csv", "no number"),
])  # fmt: skip
def test_values_of_any_size_are_answered(folder, values, says):
    (folder / "big.csv").write_text("A\n" + "1" * 131_073)
    (folder / "quoted.csv").write_text('A\n"' + "1" * 131_073)
    (folder / "far.csv").write_text("A\n1\n1e308\n")
    (folder / "nul.csv").write_bytes(b"A\n1\x002\n")
    run("sweep", *BLOCK, "--vary", values, status=2, says=says)


def test_a_family_does_not_go_beyond_what_is_read():
    with pytest.raises(contoursolve.errors.FamilyError, match="beyond 1,000,000"):
        contoursolve.family("G111 X100. A180. K-30. B120.", start="X40. Z0.", vary={"K": [-30, 1e308]})


@pytest.mark.parametrize(("text", "own", "shared"), [
    ("tool = 3", 2, 0),
    ("tool.contoursolve = 3", 2, 0),
    ("[tool]\ncontoursolve = []", 2, 0),
    ("x = " + "[" * 100_000, 2, 0),
    ("[nct-99m]\nx = " + "[" * 5_000 + "]" * 5_000, 2, 0),
    ("[tool.contoursolve.nct-99m]\nx = " + "[" * 5_000, 2, 2),
    ("[tool.contoursolve.nct-99m]\nx = " + "1" * 100_000, 2, 2),
    ("x = " + "1" * 40_000, 2, 0),
    ("a" + ".a" * 4_000 + " = 1", 2, 0),
    ("[nct-99m]\ncircle-circle-q = {a = 1}", 2, 0),
    ("[yasnac-lx3]\nbevel = 1979-05-27", 2, 0),
])  # fmt: skip
def test_settings_of_any_text_are_answered(folder, text, own, shared):
    for name, status in (("contoursolve.toml", own), ("pyproject.toml", shared)):
        place = folder / name.partition(".")[0] / "below"
        place.mkdir(parents=True)
        (place.parent / name).write_text(text)
        (place / "part.nc").write_text("G00 X40. Z0.\nG111 X100. A180. K-30. B120.\n")
        run("check", str(place / "part.nc"), status=status, says=name if status else "")


@pytest.mark.parametrize("command", ["check", "plot", "sweep", "verify", "facts"])
@pytest.mark.parametrize("name", ["x\0.svg", "-o", "\0"])
def test_a_nul_in_any_argument_is_told(folder, command, name):
    done = CliRunner().invoke(main, [command, "part.nc", "-o", name, "x\0.dxf"])
    assert (done.exit_code, done.stdout) == (2, "")
    assert done.stderr.splitlines()[-1] == "Error: arguments with a NUL character cannot be read"


@pytest.mark.parametrize("data", [b"G00 X40. Z0. (\xe9)\n", b"G00 X40. Z0. (\xc3\xa9)\n"])
@pytest.mark.parametrize("fact", ["\udcff", "\u7c97 = 3"])
def test_a_fact_with_characters_that_the_program_cannot_hold_is_told(folder, data, fact):
    Path("fact.nc").write_bytes(data + b"G111 X100. A180. K-30. B120.\n")
    done = run("expand", "--keep-going", "fact.nc", "--fact", fact, status=1, says="NOT EXPANDED")
    assert data in done.stdout_bytes
    assert "error" in done.stderr


WAYS_IN = (
    *("check IN", "solve IN", "expand IN", "convert IN --to isg", "plot IN", "report IN", "filter IN", "verify IN IN"),
    *("diff IN IN", "write IN --to fanuc-mill", "check IN --baseline IN", "check part.nc --baseline IN"),
    *("verify part.nc IN", "plot IN.toml", "write IN.dxf --to fanuc-mill", "solve part.nc --tool-table IN"),
)
"""Commands with a file of each kind that is read."""


@pytest.mark.parametrize("way", WAYS_IN)
@pytest.mark.parametrize("kind", ["pipe", "endless", "large", "folder"])
def test_what_is_no_file_of_a_usual_size_is_refused_at_once(folder, way, kind):
    """A pipe without a writer once waited for ever; ten gigabytes of nothing were read."""
    Path("part.nc").write_text(PROGRAM)
    name = next(each for each in way.split() if each.startswith("IN"))
    if kind == "large":
        with Path(name).open("wb") as file:
            file.truncate(10**10)
    elif kind == "folder" and "check" not in way:
        Path(name).mkdir()
    elif hasattr(os, "mkfifo"):
        os.mkfifo(name) if kind == "pipe" else Path(name).symlink_to("/dev/zero")
    result = run(*way.split(), status=2)
    assert len(result.output.strip().split("\n")) <= 4, result.output


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no pipes with names")
def test_a_subprogram_that_is_a_pipe_is_not_there(folder):
    Path("part.nc").write_text(
        "(contoursolve control: fanuc-lathe)\nG00 X30. Z0.\nG01 Z-10. ,R2.\nX40.\nM98 P3000\nG01 Z-20. ,R5.\nX60."
    )
    os.mkfifo("O3000.NC")
    run("check", "part.nc", status=1, says="1 solved")
    run("check", ".", status=2, says="O3000.NC cannot be read: it is a pipe or a device")


@pytest.mark.parametrize("debug", ["", "1"])
def test_a_fault_of_our_own_is_one_sentence_and_a_status(debug):
    run = "import contoursolve.__main__ as entry; entry.commands = lambda: {}['corner 1']; entry.main()"
    environment = {**os.environ, "CONTOURSOLVE_DEBUG": debug}
    done = subprocess.run([sys.executable, "-c", run], env=environment, capture_output=True, text=True, check=False)
    first = (
        "Traceback" if debug else "Error: a fault of contoursolve 0.1.0 ended this run: KeyError 'corner 1'. Please "
    )
    assert done.stderr.startswith(first)
    assert (done.returncode, done.stderr.count("\n") == 1) == ((1, False) if debug else (2, True))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_holds_no_settings(folder):
    for name, status in (("contoursolve.toml", 2), ("pyproject.toml", 0)):
        os.mkfifo(folder / name)
        run("check", *BLOCK, status=status, says="it is a pipe or a device, not a file" if status else "")
        (folder / name).unlink()


@pytest.mark.skipif(sys.platform != "linux", reason="needs file names that are no UTF-8")
@pytest.mark.parametrize("form", ["text", "json", "sarif", "github"])
def test_names_and_blocks_need_not_be_utf8(folder, form):
    Path(f"a{ODD}.nc").write_text(PROGRAM)
    run("check", f"a{ODD}.nc", "--format", form, status=1)
    run("check", "--block", f"G111 X100. A180. B120. ({ODD})", "--start", "X40. Z0.", "--format", form, status=1)
    if form in ("text", "json"):
        run("solve", f"a{ODD}.nc", "--format", form, status=1)
        run("solve", "--block", f"G111 X100. A180. B120. K-30. ({ODD})", *BLOCK[2:], "--format", form, status=0)
    run("expand", f"a{ODD}.nc", status=1)
    done = CliRunner().invoke(main, ["expand", "--block", f"G111 X100. A180. B120. K-30. ({ODD})", *BLOCK[2:]])
    assert done.exit_code == 0
    assert b"\xff])" in done.stdout_bytes


def test_a_link_to_itself_is_no_target(folder):
    for name, command in (
        ("a.nc", ("expand",)),
        ("a.svg", ("plot",)),
        ("a.html", ("report",)),
        ("a.csv", ("sweep", "--vary", "A=170,180")),
    ):
        Path(name).symlink_to(name)
        for forced in ((), ("--force",)):
            run(*command, *BLOCK, "-o", name, *forced, status=2, says=name)
        assert [path.name for path in folder.iterdir()] == [name]
        Path(name).unlink()


@pytest.mark.parametrize("control", ["sys:x", "sys:", "builtins:x", ":x", "..:x", "os.path:join", ":", "a:b:c", ODD])
def test_whatever_is_named_as_a_control_is_answered(control):
    run("check", "--control", control, *BLOCK, status=2)


COMMAND = [sys.executable, "-m", "contoursolve"]


@pytest.mark.skipif(sys.platform == "win32", reason="needs a shell that closes streams")
@pytest.mark.parametrize(("redirected", "status"), [
    ("expand good.nc >&-", 0), *(
        pytest.param(*case, marks=pytest.mark.slow) for case in (
            ("check - <&-", 2), ("check part.nc good.nc 2>&-", 1),
            ("expand - <&-", 2), ("check part.nc <&-", 1), ("check part.nc >&-", 1),
            ("check part.nc - >&- 2>&- <&-", 2), ("solve part.nc --format json >&-", 1), ("expand part.nc >&-", 1),
            ("expand good.nc 2>&-", 0),
        )
    ),
])  # fmt: skip
def test_streams_that_are_closed_change_no_status(folder, redirected, status):
    Path("part.nc").write_text(PROGRAM)
    Path("good.nc").write_text(PROGRAM.replace("B120.", "B120. K-30."))
    shell = f'exec "$PYTHON" -m contoursolve {redirected}'
    environment = {**os.environ, "PYTHON": sys.executable, "PYTHONPATH": str(Path(contoursolve.__file__).parents[1])}
    done = subprocess.run(["sh", "-c", shell], env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == status
    assert "Traceback" not in done.stdout + done.stderr


@pytest.mark.parametrize("command", ["check", "solve", "expand", "plot", "report", "rules", "verify", "diff", "range"])
def test_an_interrupt_has_a_status_of_its_own(folder, monkeypatch, command):
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("click.Context.invoke", interrupt)
    Path("part.nc").write_text(PROGRAM)
    needs = {"verify": 2, "diff": 2, "rules": 0}.get(command, 1)
    word = ("--word", "K") if command == "range" else ()
    done = run(command, *["part.nc"] * needs, *word, status=130)
    assert "stopped" in done.output


@pytest.mark.skipif(sys.platform == "win32", reason="sends a signal")
def test_an_interrupt_ends_the_process_with_130():
    waiting = subprocess.Popen([*COMMAND, "check", "-"], stdin=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for _ in range(200):
        time.sleep(0.05)
        if Path(f"/proc/{waiting.pid}/wchan").exists() and "pipe" in Path(f"/proc/{waiting.pid}/wchan").read_text():
            break
    waiting.send_signal(signal.SIGINT)
    _, told = waiting.communicate(timeout=60)
    assert waiting.returncode == 130
    assert "Traceback" not in told


DRAWS = """
import sys
import contoursolve
from contoursolve.output.document import to_json
for asked in ("P? Q? D? C?", "C? D? K?", "X? Z? B? Q?", "U? W? I? K?"):
    for rules in ("enforce", "off"):
        for text in (f"G111 X100. A180. K-30. B120. {asked}", f"G111 A180. {asked}", f"G111 {asked} P5. X100. Y1."):
            sys.stdout.write(to_json(contoursolve.solve(text, start="X40. Z0.", rules=rules)))
for text in ("G1 X? Y80 ,A? ,R? ,C?", "G3 I? J? R? Q?\\nG1 X0 Y0 ,A?"):
    sys.stdout.write(to_json(contoursolve.solve(text, start="G17 G41 X0 Y0", control="nct-99m")))
"""


@pytest.mark.slow
def test_json_is_the_same_whatever_the_hash_seed():
    def draw(seed: int) -> bytes:
        environment = {**os.environ, "PYTHONHASHSEED": str(seed), "PYTHONPATH": os.pathsep.join(sys.path)}
        return subprocess.run([sys.executable, "-c", DRAWS], env=environment, capture_output=True, check=True).stdout

    first, other = map(draw, (0, 5))
    assert first
    assert other == first


FORKS = """
import os, sys, threading
from contoursolve.numeric import ball
import contoursolve
inside, leave = threading.Event(), threading.Event()

def stay():
    with ball.precision(ball.HIGHEST):
        inside.set()
        leave.wait()

thread = threading.Thread(target=stay)
thread.start()
inside.wait()
child = os.fork()
if not child:
    answer = contoursolve.solve("G111 X100. A180. K-30. B120.", start="X40. Z0.").answers[0]
    os._exit(0 if answer.status.value == "solved" else 3)
_, status = os.waitpid(child, 0)
leave.set()
thread.join()
sys.exit(os.waitstatus_to_exitcode(status))
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_fork_while_a_thread_solves_leaves_no_child_waiting():
    subprocess.run([sys.executable, "-W", "ignore", "-c", FORKS], check=True, timeout=120)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="needs file names with a colon")
def test_no_line_is_a_command_to_who_reads_it(folder):
    names = ["::error::x.nc", "a\n::warning::y.nc"]
    text = f"{PROGRAM}::error::z G111 X100. A18O. B120. K-30.\n( ::notice::w) G111 X100.\n"
    for name in names:
        Path(name).write_text(text)
    Path("good.nc").write_text(PROGRAM.replace("B120.", "B120. K-30."))
    Path("::debug::r.json").write_text(run("solve", "good.nc", "--format", "json").output)
    for name in names:
        for arguments in (
            ("check", name, "good.nc"), ("solve", name), ("expand", name),
            ("expand", name, "--keep-going", "-o", "::a.nc"),
            ("plot", "good.nc", "-o", "::b.svg"), ("plot", name, "-o", "::c.svg"),
            ("report", "good.nc", "-o", "::d.html"), ("report", name), ("diff", name, "good.nc"),
            ("diff", name, name), ("verify", name, "::debug::r.json"),
            ("verify", "good.nc", "::debug::r.json"), ("check", f"{name}::"), ("check", "--control", name, "good.nc"),
            ("sweep", *BLOCK, "--vary", "A=170,180", "-o", "::e.csv"), ("range", *BLOCK, "--word", name),
            ("solve", "--block", f"{name} G111", *BLOCK[2:]), ("solve", *BLOCK, "--fact", name), (name,),
            ("explain", name),
        ):  # fmt: skip
            for line in run(*arguments).output.splitlines():
                assert not line.lstrip().startswith("::"), arguments


@pytest.mark.parametrize(("comment", "column"), [
    ("(aaaaaa)", 9), ("(\u7c97\u52a0\u5de5)", 9), ("(e\u0301e\u0301)", 5), ("(\u00e9)", 4), ("(\uff21\uff22)", 7)
])  # fmt: skip
def test_marks_stand_below_what_they_mark(comment, column):
    lines = run("check", "--block", f"{comment}G111 X100. A180. Y5. B120. K-30.", *BLOCK[2:]).output.splitlines()
    marks = next(line for line in lines if "^" in line)
    assert marks.partition("| ")[2].index("^") == column - 1 + len("G111 X100. A180. ")
    assert marks.count("^") == len("Y5.")
