"""Programs of other people: no noise about what no contour depends on, and nothing lost that one does."""

import codecs

from calling import call as run
from examples import law
from hypothesis import strategies as st

import contoursolve

START, TAPER = "G00 X40. Z0.", "G111 X100. A180. K-30. B120."
GOOD = f"{START}\n{TAPER}\n"

FAULTY = {
    "G00 X4O. Z0.": "G00 X40. Z0.",
    "G00 X40.0.0 Z0.": "G00 X40.00 Z0.",
    "G00 X40. Z0$.": "G00 X40. Z0.",
    "G00 X45. Z2. (face G00 X40. Z0.": "G00 X45. Z2.\nG00 X40. Z0.",
    "G2O": "G20",
    "G 9l": "G91",
    "GO1 X40.": "G01 X40.",
    "G00 X40. X41. Z0.": "G00 X40. Z0.",
    "G00 U-2.0.0": "G00 U-2.0",
    "S1OOO M3": "S1000 M3",
    "T01O1": "T0101",
    "F0.2@": "F0.2",
    "#<depth> = 3": "",
    "o100 if [#1 GT 2]": "",
    "G01 Z2. ;feed": "G01 Z2.",
}
"""Lines of programs with a slip, each with what is meant."""
CLEAN = ("G00 X40. Z0.", "G01 X41. F0.2", "G00 U1. W1.", "G90", "G21", "M8", "T0202", "(note)", "%", "")


def end_of(text: str) -> object:
    (answer,) = contoursolve.solve(text, control="yasnac-lx3").answers
    return answer.status, answer.contour and answer.contour.end


@law(st.lists(st.sampled_from([*FAULTY, *CLEAN]), min_size=1, max_size=6))
def test_a_slip_that_changes_a_contour_is_told(lines):
    text = "\n".join([START, *lines, TAPER])
    meant = "\n".join([START, *(FAULTY.get(line, line) for line in lines), TAPER])
    found = contoursolve.check(text, control="yasnac-lx3")
    every = contoursolve.check(text, control="yasnac-lx3", strict=True)
    assert {*map(str, found)} <= {*map(str, every)}
    if end_of(text) != end_of(meant):
        slips = [number for number, line in enumerate(lines, 2) if line in FAULTY]
        named = " ".join([*(f"line {each.span.line}," for each in found), *(each.message for each in found)])
        assert any(f"line {number}" in named for number in slips), (text, named)


@law(st.lists(st.sampled_from([*FAULTY, *CLEAN]), max_size=8))
def test_a_program_without_contours_is_one_line(lines):
    text = "\n".join(lines)
    told = run("check", "-", "--control", "yasnac-lx3", stdin=text)
    assert (told.exit_code, told.output.count("\n")) == (0, 1), told.output
    assert not run("check", "-", stdin=text).exit_code


@law(st.lists(st.binary(max_size=40), max_size=12), st.sampled_from(["utf-8", "cp1252", "latin-1"]))
def test_expand_gives_back_every_byte_outside_contours(lines, encoding):
    odd = b"".join(b"(" + bytes(each for each in line if each > 31 and each not in b"()") + b")\n" for line in lines)
    kept = odd + "(Ø 40 Maß ±0,1)\r\n".encode(encoding) + b"M30\n\x1a\0\0"
    leader = bytes(60)
    done = run("expand", "-", "--no-comments", stdin=leader + GOOD.encode() + kept)
    assert done.stdout_bytes.startswith(leader + START.encode() + b"\n")
    assert done.stdout_bytes.endswith(b"\n" + kept)
    marked = codecs.BOM_UTF8 + kept
    assert run("expand", "-", "--control", "nct-99m", stdin=marked).stdout_bytes == marked


def test_what_is_passed_over_is_told_where_every_line_is(tmp_path):
    program = tmp_path / "flood.nc"
    program.write_text(GOOD + "M9\nG01 X1..2\n" * 30 + "@\n" * 412)
    assert run("check", program).output == "1 contour solved, no problems\n"
    short, long = run("check", program, "--strict"), run("check", program, "--strict", "--all")
    assert (short.exit_code, long.exit_code) == (1, 1)
    assert "number-malformed]: the same in program lines 6, 8, 10" in short.output
    assert "72, 73, 74, 75 and 399 more; --all shows each" in short.output
    assert (short.output.count("number-malformed"), long.output.count("number-malformed")) == (2, 30)
    assert short.output.splitlines()[-1] == long.output.splitlines()[-1]
    assert run("check", program, "--strict", "--format", "json").output.count('"number-malformed"') == 30


def test_a_program_for_another_control_is_one_line_whatever_its_size():
    text = "".join(f"{number} L X+{number} Y-2 R0 FMAX M3\n" for number in range(1, 400))
    for control in ("yasnac-lx3", "siemens-840d"):
        told = run("check", "-", "--control", control, stdin=f"0 BEGIN PGM A MM\n{text}")
        assert (told.exit_code, told.output.count("\n")) == (2, 1)
        assert "BEGIN PGM in program line 1 is for heidenhain: try --control heidenhain" in told.output
