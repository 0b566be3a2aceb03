"""Fixes that the command line applies, and findings that a baseline hides."""

import json
import os
import subprocess
import sys
from difflib import SequenceMatcher
from pathlib import Path
from random import Random

import pytest
from calling import call
from click.testing import Result
from fuzzing import damaged

from contoursolve import fix, solve
from contoursolve.gcode import decode, split_lines

START = "G00 X40. Z0.\n"
IGNORED, KEPT = "G111 A135. I10. K-12. B180. Z-40.", "G111 I10. K-12. B180. Z-40."
COOLANT = "G111 X100. A180. K-30. B120. M08"
TOO_LARGE, FITS = "G111 A180. K-30. P90. B120. X100.", "G111 A180. K-30. P9. B120. X100."


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def save(data: bytes | str, name: str = "part.nc") -> str:
    Path(name).write_bytes(data.encode() if isinstance(data, str) else data)
    return name


def check(*arguments: str, status: int | None = None, stdin: bytes | None = None) -> Result:
    done = call("check", *arguments, stdin=stdin)
    assert status is None or done.exit_code == status, done.output
    return done


# Bytes and files -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_all_but_the_edit_keeps_its_bytes(encoding, end):
    """A comment of another alphabet, blanks, a tape's marks, a line with another end, and none at the end."""
    lines = ["%", "(\u00e4 \u00b0)", "", START.strip() + "  \t", f"{IGNORED} (\u00d8)", START.strip(), COOLANT]
    text = end.join(lines).replace(f"\u00d8){end}", "\u00d8)\r\n")
    new = text.replace(IGNORED, KEPT).replace(COOLANT, f"M08{end}G111 X100. A180. K-30. B120.")
    name = save(text.encode(encoding))
    done = check(name, "--fix", status=0)
    assert Path(name).read_bytes() == new.encode(encoding)
    assert "part.nc:5: fixed: delete A135. [g111-a-ignored]" in done.stderr
    assert done.stdout.endswith("2 contours solved, no problems; 2 fixes applied\n")


def test_standard_input_is_fixed_on_standard_output():
    text = (START + IGNORED + " (\u00e4)\r\n" + START + TOO_LARGE).encode("cp1252")
    for format_ in ("text", "json"):
        done = check("-", "--fix", "--format", format_, stdin=text, status=1)
        assert done.stdout_bytes == text.replace(IGNORED.encode(), KEPT.encode())
        assert "g111-corner-too-large" in done.stderr
    again = check("-", "--fix", stdin=(START + KEPT).encode(), status=0)
    assert again.stdout == START + KEPT
    assert check("--block", IGNORED, "--start", "X40. Z0.", "--fix", status=0).stdout == f"{KEPT}\n"


# Diffs and formats ----------------------------------------------------------------------------------------


def test_a_diff_shows_what_fix_writes_and_writes_nothing():
    name = save(START + COOLANT)
    done = check(name, "--diff", status=1)
    assert done.stdout.splitlines() == [
        "--- part.nc",
        "+++ part.nc",
        "@@ -1,2 +1,3 @@",
        f" {START.strip()}",
        f"-{COOLANT}",
        "\\ No newline at end of file",
        "+M08",
        "+G111 X100. A180. K-30. B120.",
        "\\ No newline at end of file",
    ]
    assert "would fix: move M08" in done.stderr
    assert Path(name).read_text() == START + COOLANT
    assert "needs" not in check(name, "--diff", "--unsafe-fixes", status=1).stderr
    assert "goes without --format json" in check(name, "--diff", "--format", "json", status=2).stderr


# Fixes that change the contour ----------------------------------------------------------------------------


def test_fixes_that_change_the_contour_need_a_terminal_or_yes():
    name = save(START + TOO_LARGE)
    for arguments in ((name, "--unsafe-fixes"), ("-", "--unsafe-fixes", "--fix")):
        assert "give --yes to apply them all, or --diff" in check(*arguments, status=2, stdin=b"").stderr
    assert "give both" in check(name, "--fix", "--yes", status=2).stderr
    done = check(name, "--unsafe-fixes", "--yes", status=0)
    assert Path(name).read_text() == START + FITS
    assert "the contour ends at Z-47.321 mm X100.000 mm" in done.stderr


@pytest.mark.skipif(sys.platform == "win32", reason="a terminal of POSIX")
@pytest.mark.parametrize(
    ("answers", "fitting", "status"), [("y n", "10", 1), ("n y", "01", 1), ("a", "11", 0), ("q", "00", 1)]
)
def test_each_question_shows_the_line_before_and_after(answers, fitting, status):
    import pty  # noqa: PLC0415 - POSIX alone

    name = save(f"{START}{TOO_LARGE}\n" * 2)
    terminal, end = pty.openpty()
    command = [sys.executable, "-m", "contoursolve", "check", name, "--unsafe-fixes"]
    with subprocess.Popen(command, stdin=end, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as running:
        os.write(terminal, "".join(f"{answer}\n" for answer in answers.split()).encode())
        _, asked = running.communicate(timeout=60)
    os.close(end)
    os.close(terminal)
    assert running.returncode == status
    assert asked.count(f"  - {TOO_LARGE}".encode()) == len(answers.split())
    assert f"  + {FITS}".encode() in asked
    assert b"part.nc:2: error[g111-corner-too-large]: the rounding P" in asked
    lines = Path(name).read_text().splitlines()[1::2]
    assert lines == [FITS if fits == "1" else TOO_LARGE for fits in fitting]


# Laws -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("seed", range(15, 27))
def test_fixing_a_damaged_program_leaves_no_safe_fix_and_every_other_byte(seed):
    data, control = damaged(seed)
    fixes_applied(save(data), control, Random(seed))


def fixes_applied(name: str, control: str, draw: Random) -> None:
    """Applies them, and holds what the command promises."""
    old = decode(Path(name).read_bytes(), name)
    mended = fix(old, control=control)
    done = check(name, "--control", control, "--fix")
    text = decode(Path(name).read_bytes(), name)
    assert text == mended.text
    before, after = solve(old, control=control).diagnostics, solve(text, control=control).diagnostics
    errors, left = ([each.code for each in found if each.is_error] for found in (before, after))
    assert done.exit_code == (2 if "no-contour" in left else int(bool(left)))
    assert len(left) <= len(errors)
    assert {*left} <= {*errors}
    safe = {each.code for each in after if each.fixes and each.fixes[0].applicability.value == "safe"}
    assert safe <= {each.finding.code for each in mended.left}
    touched = {line for each in mended.applied for line in each.old.values()}
    lines, now = split_lines(old), old
    codes = SequenceMatcher(None, lines, split_lines(text), autojunk=False).get_opcodes()
    gone = [line for tag, first, last, *_ in codes if tag != "equal" for line in lines[first:last]]
    assert {line.rstrip("\r\n") for line in gone} <= touched
    # In whatever order they are applied by hand, they make the same program.
    while not mended.left and (fixes := safe_fixes_by_line(now, control)):
        now = by_hand(now, draw.choice(fixes))
    assert mended.left or now == text


def safe_fixes_by_line(text: str, control: str) -> list[dict[int, str]]:
    """For each finding the lines that its first fix writes, if it keeps the contour, unless it writes what is there."""
    result, lines, found = solve(text, control=control), split_lines(text), []
    for finding in result.diagnostics:
        fix = next((fix for fix in finding.fixes[:1] if fix.applicability.value == "safe"), None)
        new = fix.by_line(result.lines_of(finding)) if fix else {}
        found += [new] if any(lines[line - 1].rstrip("\r\n") != each for line, each in new.items()) else []
    return found


def by_hand(text: str, new: dict[int, str]) -> str:
    """A text with other lines; an empty one is taken out, with its end."""
    lines = split_lines(text)
    ends = [line[len(line.rstrip("\r\n")) :] for line in lines]
    for line, each in new.items():
        between = ends[line - 1] or ends[line - 2]
        lines[line - 1] = each.replace("\n", between) + ends[line - 1] if each else ""
    return "".join(lines)


def test_a_fix_that_brings_another_error_is_not_applied_and_said():
    """With G01 in force, the block behind it would be a contour that states its end twice."""
    name = save(f"{START}G111 A180. K-30. B120. X100.\nX40. Z0.\nX180. U50. K-7.\n")
    before = Path(name).read_text()
    done = check(name, "--unsafe-fixes", "--yes")
    assert "part.nc:3: not fixed: write G01 if this is a cut" in done.stderr
    assert "it brings error[g11-axis-twice-x]" in done.stderr
    assert done.stdout.endswith("1 fix not applied\n")
    assert Path(name).read_text() == before


# Baselines ------------------------------------------------------------------------------------------------


def test_a_baseline_hides_what_was_there_by_the_text_of_the_block():
    name = save(START + IGNORED + "\n" + START + TOO_LARGE)
    done = check(name, "--write-baseline", "known.json", status=0)
    assert done.stdout == ""
    assert "known.json written: 2 findings" in done.stderr
    written = Path("known.json").read_bytes()
    assert json.loads(written)["schema"] == "contoursolve/baseline/1"
    check(name, "--write-baseline", "known.json", status=0)
    assert Path("known.json").read_bytes() == written
    save(f"(a comment)\n\n{START}{IGNORED}\n{START}{TOO_LARGE}\n{START}{TOO_LARGE}")
    done = check(name, "--baseline", "known.json", status=1)
    assert done.stdout.count("error[g111-corner-too-large]") == 1
    assert "part.nc:8:18" in done.stdout
    assert done.stdout.splitlines()[-1].endswith("1 error; 2 hidden by the baseline")
    told = json.loads(check(name, "--baseline", "known.json", "--format", "json", status=1).stdout)
    assert ([each["line"] for each in told["diagnostics"]], told["programs"][0]["hidden"]) == ([8], 2)


def test_fix_leaves_what_a_baseline_hides():
    name = save(START + IGNORED + "\n")
    check(name, "--write-baseline", "known.json")
    save(f"{START}{IGNORED}\n{START}{COOLANT}\n{START}{IGNORED}\n")
    check(name, "--baseline", "known.json", "--fix", status=0)
    moved = COOLANT.replace(" M08", "")
    assert Path(name).read_text() == f"{START}{IGNORED}\n{START}M08\n{moved}\n{START}{KEPT}\n"


def test_a_baseline_tells_what_is_gone_in_one_line():
    name = save(START + IGNORED + "\n" + START + TOO_LARGE)
    check(name, "--write-baseline", "known.json")
    save(START + KEPT)
    done = check(name, "--baseline", "known.json", status=0)
    assert done.stderr.splitlines() == [
        "known.json: 2 findings in it are gone; --write-baseline known.json writes it anew"
    ]


@pytest.mark.parametrize(
    "content",
    [
        None, "", "[]", "{}", '{"schema": "contoursolve/baseline/1"}', "\x00\xff",
        '{"schema": "contoursolve/baseline/1", "programs": {"part.nc": [{"code": "x"}]}}',
        '{"schema": "contoursolve/baseline/1", "programs": {"part.nc": [{"code": 1, "block": "", "count": -1}]}}',
        "[" * 100_000,
    ],
)  # fmt: skip
def test_a_bad_baseline_is_one_sentence(content):
    name = save(START + KEPT)
    if content is not None:
        Path("known.json").write_text(content, encoding="latin-1")
    done = check(name, "--baseline", "known.json", status=2)
    assert len(done.output.splitlines()) == 1
    assert "known.json" in done.output
    if content is not None:
        assert check(name, "--write-baseline", "known.json", status=2).output == done.output
        assert Path("known.json").read_text(encoding="latin-1") == content


def test_the_project_file_names_a_baseline_for_its_folder():
    Path("parts").mkdir()
    name = save(START + TOO_LARGE, "parts/part.nc")
    check(name, "--write-baseline", "known.json")
    save('baseline = "known.json"\n', "contoursolve.toml")
    assert "1 hidden by the baseline" in check(name, status=0).stdout
    assert check(save(START + TOO_LARGE, "parts/other.nc"), status=1)
    save("baseline = 3\n", "contoursolve.toml")
    assert "3 is no file of a baseline" in check(name, status=2).stderr
