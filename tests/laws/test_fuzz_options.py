"""Options that nobody would give: every command ends with a status of its own, and never in a traceback."""

import random
import resource
import string
import warnings
from pathlib import Path

import pytest
from click.testing import CliRunner

from contoursolve.cli import main

OPTIONS = 6_000
SHARDS = 6
"""A failing shard names its seed, so that one failure is repeated in seconds."""

LONGEST = 20.0
"""Seconds of processor time that no command may need; all of them take a hundredth of it."""

BLOCKS = (
    ("--block", "G111 X100. A180. K-30. B120. P5. Q5.", "--start", "X40. Z0."),
    ("--block", "G111 X100. A180. B120. K?", "--start", "X40. Z0.", "--fact", "length of line 1 = 30"),
    ("--block", "G1 ,A225 ,R5", "--block", "G1 X10 Y20 ,A180", "--start", "G17 G41 X90 Y60", "--control", "nct-99m"),
    ("part.nc",),
    ("odd.nc",),
)
TOOL = ("--tool", "R0.8", "--tip", "3", "--side", "right")
COMMANDS = {
    "check": ((), ("--format", "json"), ("--format", "sarif"), ("--format", "github"), ("--fail-on", "warning"), TOOL),
    "solve": ((), ("--format", "json"), ("--explain",), ("--rules", "off"), ("--units", "inch"), TOOL),
    "expand": (
        (),
        ("--post", "linuxcnc"),
        ("--decimals", "3"),
        ("--arcs", "radius"),
        ("--keep-going",),
        ("-o", "x.nc"),
        TOOL,
    ),
    "diff": (("part.nc",), ("odd.nc", "--format", "json")),
    "plot": (("-o", "x.svg", "--force"), ("-o", "x.dxf")),
    "verify": (("result.json",), ("part.nc", "--format", "json")),
    "rules": ((), ("--control", "nct-99m")),
    "explain": (("g111-line-1",), ("words-missing",)),
    "facts": ((),),
    "filter": (("part.nc",),),
    "range": (("--word", "K"), ("--word", "A", "--within", "170:190")),
    "find": (("--word", "K", "--bring", "end Z-54."),),
    "sensitivity": ((), ("--tolerance", "K=0.1")),
    "sweep": (("--vary", "A=170:190:10"), ("--vary", "K=-30,-31", "--format", "json"), ("--vary", "A=@values.csv")),
}
HEAVY = ("range", "find", "sensitivity", "sweep", "plot")
"""Commands that are rarely run to their end here; most of their arguments are wrong."""

ATOMS = (
    *(
        "",
        " ",
        "-",
        "--",
        "=",
        ":",
        ",",
        ".",
        "@",
        "?",
        "#1",
        "(",
        ")",
        "[",
        "\n",
        "\t",
        "\0",
        "\x1b",
        "\u7c97",
        "\u0663",
    ),
    *(
        "1e308",
        "-1e308",
        "1e-400",
        "1e9999999999",
        "nan",
        "inf",
        "-0",
        "9" * 30,
        "0.1",
        "1:2:0",
        "0:1:1e-99",
        "1_0",
        "0x1",
    ),
    *("--format", "json", "--control", "sys:x", "nct-99m", "--set", "a.b=c", "--rules", "off", "--units", "inch"),
    *("--block", "--start", "--fact", "G111", "X1", "A180.", "length of line 1 = 1e999", "Z of end of line 2 = ?"),
    *("/", "..", "nowhere.nc", "part.nc", "odd.nc", "values.csv", "@values.csv:B", "x.png", "-o", "-", "\udcff", "::x"),
    *("--help", "-h", "--version", "--vary", "--word", "--bring", "--within", "K", "start.X", "end", "V1", "line 1"),
)
PART = "%\nO1\nG00 X40. Z0.\nG111 X100. A180. K-30. B120. P5. Q5.\nG01 X120.\nM30\n%\n"
ODD = "G0 X40. Z0.\nG111 X100. A180. B120.\nG111 X1O0. A180. K--30. B120.\nG02 X60. Z-10.005 I10. J0.\nG111 ((\n"


def mutate(arguments: list[str], draw: random.Random) -> list[str]:
    """One random change of arguments, or within one of them."""
    place, changed = draw.randrange(len(arguments) + 1), list(arguments)
    text = changed[place] if place < len(changed) else ""
    at = draw.randrange(len(text) + 1)
    match draw.randrange(7):
        case 0 | 1:
            changed[place : place + 1] = [draw.choice(ATOMS)]
        case 2:
            changed[place:place] = [draw.choice(ATOMS)]
        case 3:
            changed[place : place + 1] = []
        case 4:
            changed[place : place + 1] = [text[:at] + draw.choice(ATOMS) + text[at:]]
        case 5:
            changed[place : place + 1] = [text[:at] + draw.choice(string.printable) + text[at + 1 :]]
        case _:
            changed[place : place + 1] = [text[:at] + text[at + 1 :]]
    return changed


def arguments_of(draw: random.Random) -> list[str]:
    command = draw.choice(tuple(COMMANDS))
    if command in HEAVY and draw.random() < 0.7:
        command = draw.choice(tuple(COMMANDS))
    given = () if command in ("rules", "explain", "facts", "filter") else draw.choice(BLOCKS)
    arguments = [*given, *draw.choice(COMMANDS[command])]
    for _ in range(draw.choice((1, 1, 1, 2, 4))):
        arguments = mutate(arguments, draw)
    if command in HEAVY and draw.random() < 0.8:
        arguments.append(draw.choice(("--no-such-option", "--units=yard", "--start")))
    made = [command, *arguments] if draw.random() < 0.99 else mutate([command, *arguments], draw)
    return ["below" if _is_outside(each) else each for each in made]


def _is_outside(argument: str) -> bool:
    """Whether an argument is a folder beside the test's own: a command would read every program of the machine."""
    try:
        return Path(argument).is_dir() and not Path(argument).resolve().is_relative_to(Path.cwd())
    except (OSError, ValueError):
        return False


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "part.nc").write_text(PART)
    (tmp_path / "odd.nc").write_text(ODD)
    (tmp_path / "values.csv").write_text("A,B\n170,1\n180,1e308\n")
    (tmp_path / "result.json").write_text(
        CliRunner().invoke(main, ["solve", str(tmp_path / "part.nc"), "--format", "json"]).output
    )
    below = tmp_path / "below"
    below.mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("name", ["x\0.svg", "-o", "\0"])
def test_a_nul_in_any_argument_is_told(folder, command, name):
    done = CliRunner().invoke(main, [command, "part.nc", "-o", name, "x\0.dxf"])
    assert (done.exit_code, done.stdout) == (2, "")
    assert done.stderr.splitlines()[-1] == "Error: arguments with a NUL character cannot be read"


@pytest.mark.parametrize("data", [b"G00 X40. Z0. (\xe9)\n", b"G00 X40. Z0. (\xc3\xa9)\n"])
@pytest.mark.parametrize("fact", ["\udcff", "\u7c97 = 3"])
def test_a_fact_with_characters_that_the_program_cannot_hold_is_told(folder, data, fact):
    (folder / "fact.nc").write_bytes(data + b"G111 X100. A180. K-30. B120.\n")
    done = CliRunner().invoke(main, ["expand", "--keep-going", "fact.nc", "--fact", fact])
    assert done.exit_code == 1
    assert "NOT EXPANDED" in done.stdout
    assert data in done.stdout_bytes
    assert "error" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(SHARDS))
def test_mutated_options_are_answered(folder, seed):
    draw, runner = random.Random(seed), CliRunner()
    for _ in range(OPTIONS // SHARDS):
        arguments = arguments_of(draw)
        begin = resource.getrusage(resource.RUSAGE_SELF).ru_utime
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            done = runner.invoke(main, arguments, input="G111 X1\n")
        is_answered = done.exception is None or isinstance(done.exception, SystemExit)
        assert is_answered, (seed, arguments, done.exc_info)
        assert done.exit_code in (0, 1, 2), (seed, arguments, done.output)
        assert resource.getrusage(resource.RUSAGE_SELF).ru_utime - begin < LONGEST, (seed, arguments)
