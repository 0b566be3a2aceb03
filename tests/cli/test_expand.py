"""Whole programs in plain G-code: what replaces a contour, and that nothing else changes."""

import os
import re
import subprocess
import sys
from configparser import ConfigParser
from pathlib import Path

import pytest
from calling import call
from examples import law
from hypothesis import strategies as st
from interpreter import RefusedError, interpret

import contoursolve
from contoursolve.comparison import compare, follow
from contoursolve.controls import CONTROLS, PLAIN as TARGET_CONTROLS
from contoursolve.diagnostics import Severity
from contoursolve.gcode import parse
from contoursolve.geometry import Length
from contoursolve.postprocess import POSTS, MachineKind
from contoursolve.program import Request, run as run_program

PROGRAMS = Path(__file__).parents[2] / "notebooks" / "programs"
TAPER = "G111 A180. K-30. B120. X100."
START = "G00 X40. Z0.\n"


def run(*arguments, stdin=None):
    done = call(*arguments, stdin=stdin)
    return done.exit_code, done.stdout_bytes, done.stderr


def path_of(text, control, unit=Length.MM):
    """The path of a program; blocks that are not solved are a part of it, with the modes that they rely on."""
    return follow(run_program(parse(text), Request(control, unit)), control, unit, control.modes.axes)


# --- Rounding ------------------------------------------------------------------------------------------


TARGETS = {"same": ("yasnac-lx3", "nct-99m"), "fanuc": ("fanuc-lathe", "fanuc-mill"), "linuxcnc": ("linuxcnc",) * 2}


@pytest.mark.parametrize("post", TARGETS)
@pytest.mark.parametrize("arcs", ["center", "radius"])
@pytest.mark.parametrize(
    ("decimals", "unit", "name"),
    [
        *((1, "mm", "shaft"), (2, "inch", "shaft"), (3, "mm", "roller"), (4, "inch", "roller")),
        *((1, "inch", "plate"), (2, "mm", "plate"), (3, "inch", "cover"), (4, "mm", "cover")),
    ],
)
def test_with_few_decimals_every_arc_is_still_one(post, arcs, decimals, unit, name):
    programs = [PROGRAMS.joinpath(f"{name}.nc").read_text()]
    programs += [f"{START}G112 U0 I10. K-50. P5. Q5. R30."] if name == "shaft" else []
    options = {"post": post, "arcs": arcs, "units": unit, "comments": False, "keep_untranslated": True}
    for program in programs:
        text = program.replace("G21", "") if unit == "inch" else program
        written = contoursolve.expand(text, decimals=decimals, **options)
        if written.text is None:  # an arc of the program's own begins where a contour ends
            told = r"its arc begins .*, which is rounded by .* mm: take (\d) decimals"
            (least,) = {int(re.fullmatch(told, left.reason)[1]) for left in written.summary.left}
            assert decimals < least
            written = contoursolve.expand(text, decimals=least, **options)
        control = CONTROLS[written.control]
        own = re.sub("^G[78] G1[78] .*\n", "", written.text, flags=re.MULTILINE)
        found = contoursolve.check(own, control=control, units=unit)
        assert [each for each in found if each.severity is Severity.ERROR] == []
        if written.summary.misread:
            continue
        target = (CONTROLS | TARGET_CONTROLS)[TARGETS[post][written.control == "nct-99m"]]
        reasons = [each.reason for each in path_of(written.text, target, Length(unit)).unfollowed]
        assert [each for each in reasons if "radius of the arc is" in each or "too small" in each] == []


# --- What replaces a contour ---------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (START + "G111 A180. B120. X100.", "g111-line-1"),
        (f"{TAPER}", "position-unknown"),
        (f"G00 X40. Z0.\nG02 X40. Z-10. R30.\n{TAPER}\nG28 U0\nM98 P7", "program line 5 relies on the G2 before it"),
        (
            "G00 X40. Z0.\nG90 X30. Z-10.\nG00 X40. Z0.\nG11 Z-20. I8.\nX80. K-7.\nM99",
            "program line 6 relies on the G11",
        ),
        (f"G00 X40. Z0.\nG90 X40. Z-10.\nG50 X40. Z0.\n{TAPER}\nX30.", "program line 5 relies on the G90 before it"),
        (f"{START}{TAPER}\n{TAPER}{2000 * ' '}", "the block has 2,028 characters and was not read"),
        (f"G00 X40. Z0.\n{TAPER}{2000 * ' '}", "the block has 2,028 characters and was not read"),
        (f"G50 X40. Z0.\n{TAPER}\nX50.", "program line 3 relies on what the control starts with"),
        ("G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\n/G1 X-50 Y42.857 ,A171.87 Q-1", "some of its blocks begin with /"),
        (f"{START}/G01 X50.\n{TAPER}", "it begins where a block with / leads"),
    ],
)
def test_what_cannot_be_expanded_is_told_and_nothing_is_written(text, reason):
    expansion = contoursolve.expand(text)
    assert expansion.text is None
    assert expansion.summary.left[0].reason.startswith(reason)
    kept = contoursolve.expand(text, keep_going=True)
    assert f"(NOT EXPANDED: {reason}" in kept.text or kept.control is None
    assert contoursolve.expand(kept.text, keep_going=True, control=kept.control).text == kept.text


def test_what_the_target_reads_otherwise_is_named_once():
    text = f"G50 S2000\nG50 S1500\n{START}{TAPER}\nG01 X50 F.1\nG01 U5.\nIF [#1 GT 2] GOTO 5"
    for post, told in (
        ("same", []),
        ("fanuc", []),
        ("linuxcnc", [(1, "G50"), (5, "X50"), (5, "F.1"), (6, "U5."), (7, "IF [#1 GT 2] GOTO 5")]),
    ):
        found = contoursolve.expand(text, post=post).summary.unfamiliar
        assert sorted((each.line, each.text) for each in found) == sorted(told)


def test_a_word_that_the_control_ignores_is_not_passed_over():
    text = f"{START}G111 A135. I10. K-12. B180. Z-40."
    assert contoursolve.expand(text).summary.warnings == 1
    said = run("expand", "-", stdin=text)[2]
    assert "program line 2: warning[g111-a-ignored]: the control ignores A135." in said
    assert "1 warning: contoursolve check says more about it" in said
    said = run("expand", "-", stdin=f"{text}\n" * 30)[2]
    assert said.count("warning[g111-a-ignored]") == 20
    assert "and 10 warnings more" in said


@pytest.mark.parametrize(
    ("post", "line"),
    [
        ("same", "G90 X30. Z-60."),
        ("fanuc", "G90 X30. Z-60."),
        ("linuxcnc", "G90"),
        ("linuxcnc", "G28 U0 W0"),  # LinuxCNC stops: a bad character
        ("linuxcnc", "G50 X300000 Z200000"),  # LinuxCNC stops: it has no such code
        ("linuxcnc", "G04 X1000"),  # LinuxCNC stops: no P
        ("linuxcnc", "T0303"),  # LinuxCNC stops: not in its table
        ("linuxcnc", "M98 P1000"),
        ("linuxcnc", "X0 Z0"),
        ("linuxcnc", "G98 F100"),
    ],
)
def test_what_changes_no_path_or_stops_the_target_is_only_told(post, line):
    text = f"{START}{TAPER}\n{line}\nG00 X50."
    expansion = contoursolve.expand(text, post=post)
    assert expansion.summary.misread == []
    assert f"\n{line}\n" in expansion.text
    assert run("expand", "-", "--post", post, stdin=text)[0] == 0


@pytest.mark.interpreter
@pytest.mark.parametrize("machine", MachineKind)
@pytest.mark.parametrize("stride", [15])
def test_linuxcnc_stops_at_every_code_of_which_no_row_says_what_it_does(machine, stride, tmp_path):
    reading = POSTS["linuxcnc"].readings[machine]
    opening = POSTS["linuxcnc"].opening[machine].format(unit="G21")
    codes = [code for code in range(120) if code not in reading.g and f"G{code}" not in reading.otherwise]
    assert len(codes) > 50
    for code in codes[::stride]:
        for words in ("", "X50. Z-60.", "Z-60. R1. Q1. P1"):
            with pytest.raises(RefusedError):
                interpret(f"{opening} F100\nG00 X40. Z0.\nG{code} {words}\nM2\n", tmp_path)


ROUNDED = "N0120 G111 A180. K-30. B120. X100. P5."


def test_numbers_that_cannot_stand_where_they_are_needed_are_told():
    text = START + ROUNDED + "\nG70 P100 Q120"
    (left,) = contoursolve.expand(text).summary.left
    assert (
        left.reason == "the profile of program line 3 ends with N120 of program line 2, which is more than one line now"
    )
    full = START + ROUNDED + "\n(" + " ".join(f"N{n}" for n in range(1, 9999)) + ")"
    (left,) = contoursolve.expand(full, block_numbers="all").summary.left
    assert "no block number up to 9999 is free" in left.reason


# --- What stays as it is -------------------------------------------------------------------------------


def in_row(text):
    return text.split("|")


PLAIN = st.sampled_from(
    in_row("%||O0001 (NAME)| G00 x40.0 Z+0.50 |n20 G01X1Y2F.3|X41.|(G111 X5)|#100=5.|M08|\x02G4 X1.|W-1. U-.5")
)
ENDS = st.sampled_from(["\n", "\r\n", "\r"])


@law(
    st.lists(PLAIN | st.just(START + TAPER + " P2.") | st.just("G111 A180."), max_size=12),
    ENDS,
    st.sampled_from(["same", "linuxcnc", "fanuc"]),
    few=2,
)
def test_only_contours_change_and_only_once(blocks, end, post):
    blocks = [each.replace("\n", end) for each in blocks]
    text = end.join(blocks)
    options = {"post": post, "control": "yasnac-lx3", "keep_going": True, "keep_untranslated": True}
    once = contoursolve.expand(text, **options)
    plain = [line for line in re.split(r"\r\n|\n|\r", text) if not line.startswith("G111")]
    rest = iter(re.split(r"\r\n|\n|\r", once.text))
    assert all(line in rest for line in plain)  # in this order, every one of them
    assert contoursolve.expand(once.text, **options).text == once.text
    if once.summary.replaced == 0 and not once.summary.left:
        assert once.text == text


LATHE_LINES = in_row(
    "%||(A COMMENT)|G00 X40. Z0.|X41. (X9.)|N5 Z-1. F.2|G01 x42.Z-2.|W-1.|G01 U.5|G02 X43. Z-3. R9.|G90 X30.|G28 U0|M08"
    "|M98 P1|/X44.|X45. X46.|X1.5.|#1=2|X[#1]|G50 X40. Z1.|G20|G111 A180. K-30. B120. X100.|G111 A180."
    "|G111 A180. K-30. B120. U60. P2.|G112 U0 I10. K-50. P5. Q5. R30.|G11 Z-20. I8. F30|X80. K-7.|G12 U10. K1."
    "|G01 X50. K-2.|X44. Z-4. R9.|X20. K7.|U1. K7.|G32 X30. Z-20. F1.|Z-30.|IF [#1 GT 2] GOTO 5|M99|M30|G04 X1."
)
MILL_LINES = in_row(
    "|(A COMMENT)|G17 G90 G41 G0 X50 Y0|G91|G90|X10 Y5|G1 X20|Y7 F100 (,R2)|G0 X1 Y1 Z1 M3|G3 X-50 Y0 R50"
    "|G1 X-50 Y42.857 ,A171.87 Q-1|G1 ,A150|X10 Y20 ,A225|X30 Y30 ,C2|Y10 ,R1|G81 X1 Y1 Z-1 R1|G80|G18|N7"
)


@law(
    st.sampled_from(("yasnac-lx3", "nct-99m")).flatmap(
        lambda control: st.tuples(
            st.just(control),
            st.lists(st.sampled_from(LATHE_LINES if control == "yasnac-lx3" else MILL_LINES), min_size=2, max_size=10),
        )
    ),
    few=2,
)
def test_what_is_left_means_the_same_and_expanding_again_changes_nothing(program):
    control, lines = program
    if "M30" in lines:
        lines = lines[: lines.index("M30") + 1]  # no control comes to what stands behind
    text = "\n".join(("G00 X40. Z0." if control == "yasnac-lx3" else "G17 G41 G0 X50 Y0 D1", *lines))
    once = contoursolve.expand(text, control=control, keep_going=True)
    assert contoursolve.expand(once.text, control=control, keep_going=True).text == once.text
    found = compare(path_of(text, CONTROLS[control]), path_of(once.text, CONTROLS[control]), 0.003)
    assert found.is_equal, found.difference


# --- Files ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (b"\xef\xbb\xbf(\xc3\x84)\r\n", b"\r\n(\xc3\x96)"),
        (b"(\xc4)\n", b"\n(\xd6 \xb5)\n"),
        (b"%\r\x02", b"\r%\r\x1a"),
        (b"", b""),
    ],
    ids=["UTF-8 with its mark, CRLF", "Latin-1, LF", "tape, CR", "nothing"],
)
def test_every_other_byte_stays(before, after, tmp_path):
    old, new = tmp_path / "old.nc", tmp_path / "new.nc"
    end = b"\r\n" if b"\r\n" in before else b"\r" if b"\r" in before else b"\n"
    old.write_bytes(before + b"G00 X40. Z0." + end + TAPER.encode() + after)
    assert run("expand", old, "-o", new)[0] == 0
    comment = b"(" + TAPER.encode() + b")" + end
    replaced = comment + b"G01 X40. Z-30." + end + b"G01 X100. Z-47.321"
    assert new.read_bytes() == before + b"G00 X40. Z0." + end + replaced + after


def test_a_target_is_not_replaced_unless_that_is_asked_for(tmp_path):
    old, new = tmp_path / "old.nc", tmp_path / "new.nc"
    old.write_text(START + TAPER + "\n")
    new.write_text("mine")
    for arguments, message in (
        (("-o", new), "exists; give --force"),
        (("-o", old), "is the program itself"),
        (("-o", tmp_path), "is a directory"),
        (("-o", tmp_path / "no" / "new.nc"), "is no directory; make it first"),
        (("--in-place", "-o", new), "--in-place takes"),
    ):
        status, output, errors = run("expand", old, *arguments)
        assert (status, output) == (2, b"")
        assert message in errors
    assert new.read_text() == "mine"
    assert run("expand", old, "-o", new, "--force")[0] == 0
    assert "G01" in new.read_text()
    old.write_text(START + "G111 A180.\n")
    assert run("expand", old, "-o", new, "--force")[0] == 1
    assert "G01" in new.read_text()
    assert sorted(each.name for each in tmp_path.iterdir()) == ["new.nc", "old.nc"]


def test_in_place_keeps_every_older_file(tmp_path):
    old = tmp_path / "old.nc"
    (tmp_path / "old.nc.bak").write_text("an older one")
    text = START + TAPER + "\n"
    old.write_text(text)
    status, _, errors = run("expand", "--in-place", old)
    assert status == 0
    assert "old.nc.bak2" in errors
    assert (tmp_path / "old.nc.bak").read_text() == "an older one"
    assert (tmp_path / "old.nc.bak2").read_text() == text
    assert "G01" in old.read_text()
    run("expand", "--in-place", old)  # nothing is left to expand, nothing is written
    assert len(list(tmp_path.iterdir())) == 3


DIES = """
import os, signal, sys
left = int(sys.argv[1])
def hook(event, arguments):
    global left
    if event.partition(".")[0] in ("open", "os", "shutil") and any("old.nc" in str(each) for each in arguments):
        left -= 1
        if not left:
            os.kill(os.getpid(), signal.SIGKILL)
sys.addaudithook(hook)
from contoursolve.cli import main
main(["expand", "--in-place", sys.argv[2]])
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")
def test_killed_before_any_step_on_a_file_nothing_is_lost(tmp_path):
    text = START + TAPER + "\n"
    whole = contoursolve.expand(text).text
    outcomes = []
    # The steps at which what lies in the folder becomes another; the last one is not reached.
    for step in (1, 3, 6, 7, 9, 12, 13, 14, 15):
        folder = tmp_path / str(step)
        folder.mkdir()
        old = folder / "old.nc"
        old.write_text(text)
        done = subprocess.run([sys.executable, "-c", DIES, str(step), str(old)], capture_output=True, check=False)
        backups = [each.read_text() for each in folder.glob("old.nc.bak*")]
        assert old.read_text() in (text, whole)
        assert backups in ([], [text])  # never a part of it
        assert backups or old.read_text() == text
        outcomes.append((done.returncode, old.read_text() == whole))
        if not done.returncode:
            break
    assert {code for code, _ in outcomes[:-1]} == {-9}
    assert [done for _, done in outcomes] == sorted(done for _, done in outcomes)
    assert outcomes[-2:] == [(-9, True), (0, True)]


# --- Progress ------------------------------------------------------------------------------------------


@pytest.mark.skipif(sys.platform == "win32", reason="an open file cannot be cut there")
@pytest.mark.slow
def test_a_program_that_is_cut_while_it_is_expanded_is_noticed(tmp_path):
    old = tmp_path / "old.nc"
    # A comment is read by itself, so that not all of the program is held when the first share of it is done.
    old.write_text(START + f"M8 ({'X' * 100})\n" * 12_000 + START + TAPER + "\n")
    with subprocess.Popen(
        [sys.executable, "-m", "contoursolve", "filter", str(old)], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as process:
        assert process.stderr.readline().startswith(b"FILTER_PROGRESS=")
        os.truncate(old, old.stat().st_size - 7)
        output, errors = process.communicate()
    assert (process.returncode, output) == (2, b"")
    assert b"old.nc was changed while it was read; start again" in errors


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="there are no pseudo-terminals")
@pytest.mark.parametrize(
    ("lines", "is_terminal", "is_shown"), [(30_000, True, True), (30_000, False, False), (30, True, False)]
)
def test_progress_is_shown_on_a_terminal_and_nowhere_else(lines, is_terminal, is_shown, tmp_path):
    import pty  # noqa: PLC0415 - only where there are terminals

    old, new = tmp_path / "old.nc", tmp_path / "new.nc"
    old.write_text(START + "G01 X41. F.1\n" * lines + START + TAPER + "\n")
    with new.open("wb") as out:
        mine, its = pty.openpty() if is_terminal else os.pipe()
        process = subprocess.Popen([sys.executable, "-m", "contoursolve", "expand", str(old)], stdout=out, stderr=its)
        os.close(its)
        said = b""
        while piece := _read(mine):
            said += piece
        os.close(mine)
        assert process.wait() == 0
    assert (b"expanding  [" in said) == is_shown
    assert (b"100%" in said) == is_shown
    assert said.decode().splitlines()[-1] == "1 contour expanded, at most 0.0005 mm off"
    assert new.read_text() == contoursolve.expand(old.read_text()).text


def _read(descriptor):
    try:
        return os.read(descriptor, 4096)
    except OSError:  # a pseudo-terminal of which the other end is closed
        return b""


# --- LinuxCNC's filter ---------------------------------------------------------------------------------


def open_in_linuxcnc(file, folder):
    """What LinuxCNC's screen AXIS does with a file whose ending its INI file names: the status, the program that it
    loads, what it tells the user, and how the bar moves. The lines of the INI file are those of docs/programs.md."""
    text = PROGRAMS.parent.parent.joinpath("docs", "programs.md").read_text()
    ini = ConfigParser()
    ini.read_string(re.search(r"^    \[FILTER\]\n(?:    .+\n)+", text, re.MULTILINE)[0].replace("    ", ""))
    assert ini["FILTER"]["PROGRAM_EXTENSION"].startswith(f"{file.suffix} ")
    (folder / "bin").mkdir(exist_ok=True)
    command = folder / "bin" / "contoursolve"
    command.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m contoursolve "$@"\n')
    command.chmod(0o755)
    quoted = str(file).replace("'", "'\\''")
    done = subprocess.run(
        ["sh", "-c", f"{ini['FILTER'][file.suffix[1:]]} '{quoted}'"],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        check=False,
        env={**os.environ, "AXIS_PROGRESS_BAR": "1", "PATH": f"{command.parent}:{os.environ['PATH']}"},
    )
    said, steps = [], []
    for line in done.stderr.decode().splitlines():
        progress = re.match(r"^FILTER_PROGRESS=(\d*)$", line)
        (steps if progress else said).append(int(progress[1]) if progress else line)
    return done.returncode, done.stdout, "\n".join(said), steps


@pytest.mark.interpreter
@pytest.mark.skipif(sys.platform == "win32", reason="LinuxCNC has a shell")
def test_linuxcnc_opens_an_old_program_through_the_filter(tmp_path):
    old = tmp_path / "an old one's.nc"
    lines = "G01 X41. F100.\nG00 X40. Z0.\n" * 6_000
    old.write_text(START + lines + TAPER + " P5. Q5.\nM30\n")
    status, program, said, steps = open_in_linuxcnc(old, tmp_path)
    assert status == 0
    assert len(steps) > 1
    assert steps == sorted(steps)
    assert steps[-1] == 100
    assert said.splitlines()[-1] == "1 contour expanded, at most 6e-05 mm off"
    motions = interpret(program.decode(), tmp_path)[-4:]
    assert [motion.kind for motion in motions] == ["line", "cw", "line", "ccw"]
    assert abs(motions[-1].end - (-50.2073 + 50j)) < 1e-4


def test_a_profile_that_is_written_elsewhere_needs_its_call():
    text = (PROGRAMS.parents[1] / "docs" / "programs" / "bush.arc").read_text()
    assert contoursolve.expand(text, inline=True).text is None
    kept = contoursolve.expand(text, inline=True, keep_going=True).text
    assert 'N60 CYCLE95("L_BUSH",' in kept
    assert kept.count("%_N_") == 1
