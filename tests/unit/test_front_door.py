"""Functions that know what they are given: a text or a file; one word, two or the tool; a record to draw or write."""

import json
from pathlib import Path

import pytest

import contoursolve
from contoursolve.errors import FamilyError, UserError

BLOCK, START = "G111 X100. A180. K-30. B120. P5. Q5.", "X40. Z0."
PROGRAM = "G00 X40. Z0.\r\nG111 A135. I10. K-12. B180. Z-40.\r\n"


def test_a_text_a_file_and_a_parsed_program_are_solved_alike(tmp_path: Path):
    path = tmp_path / "shaft.nc"
    path.write_bytes(PROGRAM.encode())
    told = [contoursolve.solve(each) for each in (PROGRAM, path, contoursolve.parse(path))]
    assert len({str(each.answer.contour) for each in told}) == 1
    assert [each.program.name for each in told] == ["<program>", str(path), str(path)]
    findings = [contoursolve.check(each) for each in (PROGRAM, path)]
    assert findings[0] == findings[1] != ()
    assert contoursolve.fix(path).text == contoursolve.fix(PROGRAM).text == PROGRAM.replace("A135. ", "")
    with pytest.raises(ValueError, match=r"say Path\('shaft.nc'\)"):
        contoursolve.solve("shaft.nc")
    with pytest.raises(contoursolve.errors.UnreadableProgramError):
        contoursolve.check(tmp_path / "none.nc")


def test_the_name_of_a_file_is_no_program():
    for write in (contoursolve.expand, lambda text: contoursolve.convert(text, "fanuc-lathe")):
        with pytest.raises(ValueError, match=r"shaft\.nc is the name of a file, not its text: say Path\('shaft\.nc'\)"):
            write("shaft.nc")
        with pytest.raises(ValueError, match="no such file"):
            write(Path("shaft.nc"))
        with pytest.raises(TypeError, match="text is"):
            write(3)


def test_a_result_has_the_tool_for_which_it_was_solved():
    result = contoursolve.solve(BLOCK, start=START, tool="R0.8, tip 3", side="right")
    assert result.tool.runs[0].path is not None
    assert "tool" in result.tool.text(1) or "nose" in result.tool.text(1)
    plain = contoursolve.solve(BLOCK, start=START)
    assert plain.tool is None
    assert contoursolve.draw(result).svg != contoursolve.draw(plain).svg == plain.answer.draw().svg
    assert contoursolve.draw(plain, tool=result.tool).svg == contoursolve.draw(result).svg
    with pytest.raises(ValueError, match="'right' is about a tool, and there is none"):
        contoursolve.solve(BLOCK, start=START, side="right")


def test_ranges_and_families_take_the_tool_as_a_word():
    about = {"start": START, "side": "right", "tip": 3}
    radii = contoursolve.ranges(BLOCK, "tool", **about)
    assert [*radii] == [(1,)]
    fits = contoursolve.family(BLOCK, vary={"tool": [0.4, 20.0]}, **about)["tool.fits"].tolist()
    assert fits == [each in radii[1,] for each in (0.4, 20.0)]
    with pytest.raises(FamilyError, match="side is about a tool, and goes with the word tool"):
        contoursolve.ranges(BLOCK, "P", **about)
    with pytest.raises(FamilyError, match="side is about a tool"):
        contoursolve.family(BLOCK, vary={"P": [5]}, **about)
    with pytest.raises(FamilyError, match="two words take a range for each"):
        contoursolve.ranges(BLOCK, ("A", "P"), start=START)


def test_tolerances_have_a_direction():
    effects = contoursolve.tolerances(BLOCK, allowed={"A": 0.1}, start=START)
    room = contoursolve.tolerances(BLOCK, "A", keep="end Z", within=0.01, start=START)
    (of_a,) = (each.moves for each in effects.effects if each.word == "A")
    assert room.linear == pytest.approx(0.01 * 0.1 / of_a, rel=0.01)
    with pytest.raises(FamilyError, match="keep and within are about one word"):
        contoursolve.tolerances(BLOCK, keep="end Z", within=0.01, start=START)
    with pytest.raises(FamilyError, match="how far A may be off takes keep"):
        contoursolve.tolerances(BLOCK, "A", allowed={"A": 0.1}, start=START)


def test_a_picture_says_which_options_its_record_has():
    answer = contoursolve.solve(BLOCK, start=START).answer
    assert contoursolve.draw(answer, title="mine", theme="dark").title == "mine"
    with pytest.raises(TypeError, match="a picture of Answer has no option 'result'; it has theme, title, like"):
        contoursolve.draw(answer, result="end.Z")
    with pytest.raises(TypeError, match="Contour has no picture by itself; one is drawn of Answer, Result"):
        contoursolve.draw(answer.contour)
    with pytest.raises(ValueError, match="theme cannot be 'blue'; choose from light, dark, page"):
        contoursolve.draw(answer, theme="blue")
    with pytest.raises(ValueError, match="nothing of the sketch can be drawn"):
        contoursolve.draw(contoursolve.ContourSketch("milled"))


def test_a_file_is_written_by_its_ending(tmp_path: Path):
    result = contoursolve.solve(BLOCK, start=START)
    family = contoursolve.family(BLOCK, start=START, vary={"A": [170, 180], "P": [4, 5, 6]})
    for record, name in (
        (result, "a.dxf"), (result, "a.json"), (result, "a.html"), (family, "a.csv"), (family, "b.html")
    ):  # fmt: skip
        contoursolve.export(record, tmp_path / name)
        assert (tmp_path / name).stat().st_size > 100
    assert json.loads((tmp_path / "a.json").read_text(encoding="utf-8"))["contours"][0]["status"] == "solved"
    assert len((tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()) == 7
    assert contoursolve.report(result) == (tmp_path / "a.html").read_text(encoding="utf-8")
    with pytest.raises(ValueError, match=r"a file ends in \.dxf, \.json"):
        contoursolve.export(result, tmp_path / "a.txt")
    for record, name, told in (
        (family, "a.dxf", r"Family is not written as \.dxf, but as \.csv, \.parquet, \.html"),
        (result.answer, "a.json", r"Answer is not written as \.json; that is for Result"),
    ):
        with pytest.raises(ValueError, match=told):
            contoursolve.export(record, tmp_path / name)
    for name in ("a.csv", "a.parquet", "a.html"):
        with pytest.raises(UserError, match="cannot be written"):
            contoursolve.export(family, tmp_path / "no folder" / name)
    with pytest.raises(ValueError, match="the drawing would be empty"):
        contoursolve.export(contoursolve.solve("G111 X100. B120.", start=START), tmp_path / "b.dxf")
    with pytest.raises(ValueError, match="only the map of a family or a region is coloured by a result"):
        contoursolve.export(result, tmp_path / "b.json", result="end Z")
    tool = contoursolve.solve(BLOCK, start=START, tool="R0.8, tip 3", side="right").tool
    with pytest.raises(ValueError, match="the file of a Family has no tool"):
        contoursolve.export(family, tmp_path / "b.csv", tool=tool)
    with pytest.raises(TypeError, match="a picture of Family has no option 'tool'"):
        contoursolve.draw(family, tool=tool)
    assert not [*tmp_path.glob("b.[jcd]*")]


def test_a_misspelt_name_tells_what_was_meant():
    with pytest.raises(AttributeError, match="no attribute 'slove'; did you mean solve"):
        _ = contoursolve.slove
    with pytest.raises(UserError, match="unknown control 'siemens'; did you mean siemens-840d or siemens-808d"):
        contoursolve.solve("G01", control="siemens")
    with pytest.raises(UserError, match="give the record itself"):
        contoursolve.solve("G01", control="lathe:MY_LATHE")
    system = contoursolve.system(BLOCK, start=START)
    with pytest.raises(TypeError, match="a function takes all words"):
        system.function(["A"])
    with pytest.raises(ValueError, match=r"could follow; still open: Z_V1, X_V1 and Z_V2"):
        contoursolve.system(BLOCK.replace("K-30.", ""), start=START).function()
    assert system.of_word("B120.") == system.of_word("B")
    with pytest.raises(TypeError, match=r"tool is a text such as .*, not 0\.8"):
        contoursolve.solve(BLOCK, start=START, tool=0.8)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="side cannot be 'rigth'; choose from left, right"):
        contoursolve.solve(BLOCK, start=START, tool="R0.8, tip 3", side="rigth")
    with pytest.raises(TypeError, match=r"several words are allowed=\{'A': 0.1\}"):
        contoursolve.tolerances(BLOCK, {"A": 0.1}, start=START)  # type: ignore[call-overload]


def test_a_rule_is_explained_by_its_code_or_its_alarm():
    page = contoursolve.explain("g111-line-1", "yasnac-lx3")
    assert page.startswith("# g111-line-1")
    assert contoursolve.explain("146").count("# ") > 1
    with pytest.raises(UserError, match="no rule has the code or the alarm 'g111-line-9'; did you mean g111-line"):
        contoursolve.explain("g111-line-9")
