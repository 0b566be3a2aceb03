"""How long `check` takes on programs of many lines, beside what LinuxCNC takes to interpret the same file, how the time
grows with the lines, and how much memory it takes."""

import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest
from test_expand_speed import spent
from test_speed import write_blocks

CHECK = (sys.executable, "-m", "contoursolve", "check")
needs_rs274 = pytest.mark.skipif(
    shutil.which("rs274") is None, reason="rs274 is not installed (Debian: linuxcnc-uspace)"
)


def write_moves(path: Path, lines: int, *, is_mill: bool) -> None:
    """Lines of G01 with X, Z and F; or of a mill with Y, too."""
    draw = Random(7)
    with path.open("w") as file:
        file.write("%\nO0001 (TEST)\nN10 G21 G40 G90 F100\nG00 X40. Z0.\n")
        for _ in range(lines):
            x, z = draw.uniform(10, 90), -draw.uniform(0, 90)
            file.write(f"G01 X{x:.3f} Y{z:.3f} Z-1. F200\n" if is_mill else f"G01 X{x:.3f} Z{z:.3f} F0.2\n")
        file.write("M30\n%\n")


@needs_rs274
@pytest.mark.parametrize(("is_mill", "control"), [(False, ()), (True, ("--control", "fanuc-mill"))])
def test_checking_a_million_plain_lines_takes_at_most_one_and_a_half_times_interpreting_them(
    is_mill, control, tmp_path, told, growth
):
    program, part = tmp_path / "long.nc", tmp_path / "part.nc"
    write_moves(program, 1_000_000, is_mill=is_mill)
    write_moves(part, 100_000, is_mill=is_mill)
    spent(*CHECK, part)
    times = [(*spent(*CHECK, *control, program), spent("rs274", "-g", program)[0]) for _ in range(2)]
    ours, memory, theirs = (min(each) for each in zip(*times, strict=True))
    what = f"check of plain lines of a {'mill' if is_mill else 'lathe'}"
    told(f"{what}, a million", f"{ours:.1f} s, {memory:.0f} MB", f"{ours / theirs:.2f} times rs274")
    growth(what, {100_000: spent(*CHECK, *control, part)[0], 1_000_000: ours})
    assert ours <= 1.5 * theirs
    assert memory <= 300


def of_sinumerik(draw: Random, number: int) -> str:
    x, y = draw.uniform(0, 90), draw.uniform(0, 90)
    forms = (
        f"N{number} G1 X{x:.3f} Y{y:.3f} F500",
        f"G3 X{x:.3f} Y{y:.3f} CR=80",
        f"G1 X={x:.3f} Y=AC({y:.3f})",
        f"; {number}",
    )
    return draw.choice(forms)


def of_variables(draw: Random, number: int) -> str:
    x, y = draw.uniform(0, 90), draw.uniform(0, 90)
    forms = (f"#{100 + number % 40}={x:.3f}", f"#1=#101+{y:.2f}", f"G1 X#1 Y{y:.3f} F100", f"X{x:.3f} Y{y:.3f}")
    return draw.choice(forms)


def of_klartext(draw: Random, number: int) -> str:
    x, y = draw.uniform(0, 90), draw.uniform(0, 90)
    forms = (f"L X{x:+.3f} Y{y:+.3f} R0 F500", f"CC X{x:+.3f} Y{y:+.3f}", f"CR X{x:+.3f} Y{y:+.3f} R+60 DR+")
    return f"{number} {draw.choice((*forms, 'L Z+5 FMAX'))}"


LANGUAGES: dict[str, tuple[str, str, Callable[[Random, int], str]]] = {
    "siemens-840d": ("G17 G90 G40\nG0 X0 Y0 Z5", "M30", of_sinumerik),
    "fanuc-mill": ("%\nO0001\n#101=5.\n#1=10.\nG21 G90 G17\nG0 X0 Y0", "M30\n%", of_variables),
    "heidenhain": ("0 BEGIN PGM T MM\n1 L X+0 Y+0 R0 FMAX", "9 END PGM T MM", of_klartext),
}


@pytest.mark.parametrize("control", LANGUAGES)
def test_checking_more_lines_of_a_language_takes_no_more_than_in_proportion(control, tmp_path, growth):
    begin, end, write = LANGUAGES[control]
    times = dict[int, float]()
    for lines in (20_000, 100_000):
        draw, program = Random(3), tmp_path / f"{lines}.nc"
        program.write_text("\n".join([begin, *(write(draw, number) for number in range(2, lines)), end]) + "\n")
        times[lines] = spent(*CHECK, "--control", control, program)[0]
    assert growth(f"check of a program for {control}", times) <= 1.2


@pytest.mark.parametrize("command", [("solve",), ("solve", "--format", "json"), ("check",)])
def test_more_mixed_blocks_take_no_more_than_in_proportion(command, tmp_path, growth):
    times = dict[int, float]()
    for number in (1_000, 10_000):
        program = tmp_path / f"{number}.nc"
        program.write_text(write_blocks(number))
        times[number] = spent(sys.executable, "-m", "contoursolve", *command, program)[0]
    assert growth(f"{' '.join(command)} of mixed blocks", times) <= 1
