"""A control that is not built in goes through every door; the notebook 07 writes one from scratch."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import MISSING, fields, is_dataclass, replace
from functools import partial
from inspect import Parameter, isfunction, signature
from pathlib import Path
from typing import get_args

import numpy
import pytest
from click.testing import CliRunner
from msgspec import NODEFAULT, Struct
from msgspec.structs import fields as struct_fields

import contoursolve
from contoursolve import CONTROLS
from contoursolve.__main__ import commands
from contoursolve.controls import GEOMETRY_RULES, NCT_99M, ControlName
from contoursolve.diagnosis import Depth, Policy
from contoursolve.families import Branches, BranchesName
from contoursolve.geometry import Length
from contoursolve.postprocess import POSTS, Arcs, ArcsName, Numbering, NumberingName, PostName
from contoursolve.postprocess.formulas.formula_request import POST_NAMES
from contoursolve.program import Depths, FollowKeywords, Rules, SolveOptions, Units
from contoursolve.reading import ParsedContour
from contoursolve.solving import NoteKind, RefusalKind
from contoursolve.tool_radius import OutsideCorner, OutsideName, SideName, ToolSide

GENERAL = {rule.about for rule in GEOMETRY_RULES}


def relative(control):
    """A relative whose rules about geometry are the general ones."""
    own = tuple(rule for rule in control.rules if rule.about not in GENERAL)
    return replace(control, name="mine", title="the machine in hall 2", rules=own + GEOMETRY_RULES)


MINE = relative(NCT_99M)


def find_as_theirs(blocks, index, state, modes):
    found = NCT_99M.find(blocks, index, state, modes)
    return replace(found, form=replace(found.form, name="their own")) if isinstance(found, ParsedContour) else found


THEIRS = replace(MINE, name="theirs", find=find_as_theirs)
"""A control with forms of its own."""
BARE = replace(MINE, name="bare", forms=())
PAIR = "G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1"


NUMBERED = {RefusalKind.PICK_NONE, NoteKind.PICK_OPEN, NoteKind.PICK_FIRST}
"""Events of a control alone whose words choose solutions by numbers."""


def test_with_the_general_rows_every_event_of_geometry_has_a_row():
    assert (set(RefusalKind) | set(NoteKind)) - NUMBERED <= {rule.about for rule in MINE.rules}


PARALLEL = "G17 G41 G0 X90 Y10\nG1 ,A150\nG1 X10 Y20 ,A150"


def test_the_rows_of_the_control_itself_come_first_and_a_missing_one_is_named():
    own = replace(GEOMETRY_RULES[0], code="own-parallel")
    (found,) = contoursolve.check(PARALLEL, control=replace(MINE, rules=(own, *MINE.rules)))
    assert found.code == "own-parallel"
    rules = tuple(rule for rule in MINE.rules if rule.about is not RefusalKind.LINES_PARALLEL)
    with pytest.raises(LookupError, match=r"no row about RefusalKind.LINES_PARALLEL; .*GEOMETRY_RULES"):
        contoursolve.check(PARALLEL, control=replace(MINE, rules=rules))


DOORS = [
    getattr(contoursolve, name)
    for name in (
        "solve",
        "system",
        "check",
        "expand",
        "convert",
        "family",
        "ranges",
        "find",
        "sensitivity",
        "tolerances",
        "explore",
    )
]


def test_what_users_write_for_a_choice_is_one_of_its_values():
    """The texts that the types of the doors admit."""
    of_types = {
        ControlName: CONTROLS,
        Units: [each.value for each in Length],
        Rules: [each.value for each in Policy],
        Depths: [each.value for each in Depth],
        SideName: [each.value for each in ToolSide],
        OutsideName: [each.value for each in OutsideCorner],
        ArcsName: [each.value for each in Arcs],
        NumberingName: [each.value for each in Numbering],
        BranchesName: [each.value for each in Branches],
        PostName: POST_NAMES,
    }
    for names, values in of_types.items():
        assert get_args(names) == tuple(values)
    assert {name: CONTROLS[name].name for name in CONTROLS} == {name: name for name in get_args(ControlName)}
    assert CONTROLS.get("no control") is None


def test_the_keywords_of_every_door_are_the_fields_of_one_record():
    """With its defaults; a keyword that is none of a door is refused by its name."""
    told, names = SolveOptions(), {*SolveOptions.__struct_fields__}
    assert set(FollowKeywords.__annotations__) == names
    for door in DOORS:
        own = {each.name: each.default for each in signature(door).parameters.values() if each.name in names}
        assert own == {name: getattr(told, name) for name in own}
        assert {"control", "units", "rules", "settings"} <= own.keys()
        assert {"start", "facts"} <= own.keys() or door is contoursolve.convert
    for name in contoursolve.__all__:
        if isfunction(door := getattr(contoursolve, name)):
            kinds = {each.name: each.kind for each in signature(door).parameters.values()}
            assert Parameter.VAR_KEYWORD not in kinds.values(), name
    with pytest.raises(TypeError, match=r"check\(\) got an unexpected keyword argument 'depth'"):
        contoursolve.check("G1 X0", depth="full")


def test_every_door_takes_a_control_as_its_tables():
    result = contoursolve.solve(PAIR, control=MINE)
    answer = result.answer
    assert result.control == "mine"
    assert answer.contour == contoursolve.solve(PAIR).answers[0].contour
    assert contoursolve.check(PAIR, control=MINE) == ()
    other = answer.with_words(change={"Q": "Q1"})
    assert other.contour.points["P1"] == pytest.approx((-30, 40), abs=1e-3)
    line, start = "G1 X30 ,A45", "X0 Y0"
    bare = contoursolve.solve("G1 ,A45", start=start, control=MINE).answer
    assert [each.word for each in bare.completions] == ["X?", "Y?"]
    found = contoursolve.family(line, start=start, vary={",A": [0.0, 45.0]}, control=MINE)
    assert found["N1 Y"].tolist() == pytest.approx([0, 30])
    slopes = contoursolve.sensitivity(line, start=start, control=MINE).slopes
    assert slopes["N1 Y"]["X"] == pytest.approx(1)
    assert contoursolve.ranges(line, "X", start=start, control=MINE).intervals[0].low.value == 0
    explorer = contoursolve.explore(PAIR, control=MINE)
    explorer.values = {"Q": 1}
    assert (explorer.result.control, explorer.text) == ("mine", PAIR.replace("Q-1", "Q1"))


def test_its_contours_show_themselves_with_a_lexicon_of_their_own():
    lexicon = replace(NCT_99M.modes.lexicon)
    result = contoursolve.solve(PAIR, control=replace(MINE, modes=replace(MINE.modes, lexicon=lexicon)))
    for shown in (result, result.answers[0]):
        bundle = shown._repr_mimebundle_()
        assert {"text/plain", "text/html", "image/svg+xml"} <= bundle.keys()
        assert "circular-linear intersection" in bundle["text/plain"]


def test_an_executor_takes_a_control_whose_functions_can_be_sent():
    line, values = "G1 X30 ,A45", {",A": [0.0, 45.0]}
    with ThreadPoolExecutor(1) as executor:
        found = contoursolve.family(line, start="X0 Y0", vary=values, control=MINE, executor=executor)
        assert found["N1 Y"].tolist() == pytest.approx([0, 30])
        nameless = replace(MINE, signs=lambda _: ())
        with pytest.raises(contoursolve.errors.FamilyError, match="functions must stand in a module"):
            contoursolve.family(line, start="X0 Y0", vary=values, control=nameless, executor=executor)


# On the command line --------------------------------------------------------------------------------------

LINE = ("--block", "G1 X30 ,A45", "--start", "X0 Y0")
COMMANDS = {
    "check": ("check", "p.nc"),
    "solve": ("solve", "p.nc"),
    "expand": ("expand", "p.nc"),
    "filter": ("filter", "p.nc"),
    "diff": ("diff", "p.nc", "p.nc"),
    "convert": ("convert", "points.nc", "--to", "fanuc-mill"),
    "plot": ("plot", "p.nc", "--force"),
    "sweep": ("sweep", *LINE, "--vary", ",A=0:80:1", "--workers", "2"),
    "range": ("range", *LINE, "--word", "X"),
    "find": ("find", *LINE, "--word", ",A", "--goal", "end Y20"),
    "sensitivity": ("sensitivity", *LINE),
    "explain": ("explain", "3017"),
}


@pytest.fixture
def run(tmp_path, monkeypatch):
    (tmp_path / "p.nc").write_text(PAIR)
    (tmp_path / "points.nc").write_text("G17 G90 G0 X0. Y0.\nG1 X30. ,C10.\nX40. Y40.\n")
    (tmp_path / "tables_of_mine.py").write_text("from test_own_control import BARE, MINE, THEIRS\nOTHER = 5\n")
    (tmp_path / "tables_that_fail.py").write_text("1 / 0\n")
    monkeypatch.chdir(tmp_path)

    def run_(*arguments):
        done = CliRunner().invoke(commands(), arguments)
        assert done.exception is None or isinstance(done.exception, SystemExit), done.exception
        return done.exit_code, done.output

    return run_


def test_a_sketch_is_written_for_the_tables_of_a_module(run, tmp_path):
    (tmp_path / "s.toml").write_text(
        'sketch = 1\npart = "milled"\nstart = { X = 0, Y = 0 }\n'
        '[[element]]\nkind = "line"\nAN = 60\n[[element]]\nkind = "line"\nX = 80\nY = 20\nAN = -30\n'
    )
    status, output = run("write", "s.toml", "--to", "tables_of_mine:MINE")
    named, built_in = run("write", "s.toml", "--to", "nct-99m")
    # Tables of one's own have no name that a comment could state.
    assert (status, output) == (named, built_in.replace("(contoursolve control: nct-99m)\n", ""))
    assert "G01 ,A60\nX80 Y20 ,A-30\n" in output


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_takes_the_tables_of_a_module(run, name):
    status, output = run(*COMMANDS[name], "--control", "tables_of_mine:MINE")
    built_in = run(*COMMANDS[name], "--control", "nct-99m")
    # That a control is shown by the program is only known of those that are built in.
    shown = f"control: {NCT_99M.title} (from ,A171.87 and Q-1 in program line 3)"
    output = output.replace("control: mine (as asked for)", shown)
    assert (status, output.replace("mine", "nct-99m")) == built_in
    assert status == 0


@pytest.mark.slow
def test_the_other_commands_take_them_too(run):
    mine = ("--control", "tables_of_mine:MINE")
    assert run("report", "p.nc", *mine)[0] == 0
    assert "<dd>mine</dd>" in Path("p.html").read_text(encoding="utf-8")
    assert run("rules", *mine)[1].startswith("mine: the machine in hall 2")
    assert run("rules", "--table", *mine)[0] == 0
    told = "bare: this control has no table of word sets, because none of its forms has a sample\n"
    assert run("rules", "--table", "--control", "tables_of_mine:BARE") == (0, told)
    Path("r.json").write_text(run("solve", "p.nc", "--format", "json", *mine)[1], encoding="utf-8")
    assert run("verify", "p.nc", "r.json", *mine)[0] == 0
    told = run("verify", "p.nc", "r.json")[1]
    assert f"unknown control 'mine'; choose from {', '.join(CONTROLS)}, or name the tables" in told
    broken = run("check", "--block", PAIR.replace("Q-1", ",R2 ,C2"), "--format", "sarif", *mine)
    assert '"ruleId": "nct-two-corners"' in broken[1]


@pytest.mark.parametrize(("block", "status"), [(PAIR, "solved"), (PAIR.replace("Q-1", ",R2 ,C2"), "rejected")])
def test_verify_checks_forms_that_are_not_built_in(run, block, status):
    theirs = ("--control", "tables_of_mine:THEIRS")
    Path("p.nc").write_text(block, encoding="utf-8")
    result = run("solve", "p.nc", "--format", "json", *theirs)[1]
    Path("r.json").write_text(result, encoding="utf-8")
    code, output = run("verify", "p.nc", "r.json", *theirs)
    told = "verified" if status == "solved" else "path verified, status not checked"
    said = {"solved": "solved", "rejected": "cannot be cut"}[status]
    assert (code, f"p.nc:2: their own: the result says {said}: {told} (" in output) == (0, True)
    other = "solved" if status == "rejected" else "no-solution"
    wrong = result.replace(f'"status": "{status}"', f'"status": "{other}"')
    for each in (wrong, *(result.replace(f'"{name}": [\n     3', f'"{name}": [\n     4') for name in ("end", "P1"))):
        Path("r.json").write_text(each, encoding="utf-8")
        assert run("verify", "p.nc", "r.json", *theirs)[0] == (0 if each == result else 1)


@pytest.mark.parametrize(
    ("control", "said"),
    [
        ("tables_of_mine:OTHER", "tables_of_mine.py) has no contoursolve.Control of the name 'OTHER'"),
        ("tables_of_mine:", "of the name ''"),
        ("absent_tables:MINE", "absent_tables cannot be imported: ModuleNotFoundError"),
        ("tables_of_mine.py:MINE", "; write the module without .py, tables_of_mine:NAME"),
        ("tables_that_fail:MINE", "tables_that_fail cannot be imported: ZeroDivisionError: division by zero"),
        (":MINE", "cannot be imported: ValueError"),
        ("mine", "'mine' is not one of 'yasnac-lx3', 'nct-99m'"),
    ],
)
def test_tables_that_are_none_are_told_in_a_line(run, control, said):
    status, output = run("solve", "p.nc", "--control", control)
    assert (status, said in output, "Traceback" in output) == (2, True, False), output


# Every field of the tables --------------------------------------------------------------------------------

PAGE = Path(__file__).parents[2] / "docs" / "adding-a-control.md"
FILLED = {"Control.taken", "Modes.settings", "Rule.file"}
"""What the package fills in when a program is read or written, or asks for in the examples of rules."""


@pytest.fixture(scope="module")
def signed():
    """The control of the page in which the sign of a corner word tells its shape."""
    found = {}
    exec(
        PAGE.read_text(encoding="utf-8").partition("<!-- file: signed.py -->\n```python\n")[2].partition("```")[0],
        found,
    )
    return found["SIGNED"]


def test_the_sign_of_a_corner_word_tells_its_shape_at_every_door(signed):
    program = "G00 X20. Z0.\nG01 Z-20. ,R{}\nX40.\nZ-60.\n"
    rounded, cut = (program.format(size) for size in ("5.", "-5."))
    theirs = {rounded: rounded, cut: cut.replace(",R-", ",C")}
    for own, their in theirs.items():
        contour = contoursolve.solve(own, control=signed).answer.contour
        assert contour == contoursolve.solve(their, control="fanuc-lathe").answer.contour
        written = contoursolve.convert(their, control="fanuc-lathe", to=signed).text
        assert contoursolve.solve(written, control=signed).answer.contour.length == pytest.approx(contour.length)
        assert f"Z-20. {own.splitlines()[1][10:]}\n" in written
        assert contoursolve.expand(own, control=signed, post="fanuc").text.count("G01") >= 2
    (finding,) = contoursolve.check(program.format("-25."), control=signed)
    assert finding.message.startswith("the chamfer ,R-25.")
    assert "write ,R-10. for ,R-25." in "".join(each.description for each in finding.fixes)
    found = contoursolve.family(cut, vary={",R": [-4.0, 4.0]}, control=signed)
    assert numpy.isnan(found["corner 1.center Z"]).tolist() == [True, False]
    (interval,) = contoursolve.ranges(cut, ",R", control=signed).intervals
    assert (interval.low.value, interval.high.value) == pytest.approx((-10, 10))
    assert contoursolve.system(cut, control=signed).function()(R=5) is not None


def is_table(each):
    return is_dataclass(each) or (isinstance(each, type) and issubclass(each, Struct))


def fields_of(kind):
    """The fields that one writes, with their defaults."""
    if is_dataclass(kind):
        rows = ((each.name, each.default, each.default_factory, MISSING) for each in fields(kind) if each.init)
    elif issubclass(kind, Struct):
        rows = ((each.name, each.default, each.default_factory, NODEFAULT) for each in struct_fields(kind))
    else:
        rows = ()
    return [(name, default if make is none else make()) for name, default, make, none in rows]


def test_every_field_of_the_tables_has_an_example_that_runs(signed):
    """In a control of the package, as it is or with a setting, or on the page about adding one."""
    tables = [each for each in map(partial(getattr, contoursolve.tables), dir(contoursolve.tables)) if is_table(each)]
    used = {f"{kind.__name__}.{name}": False for kind in (contoursolve.Control, *tables) for name, _ in fields_of(kind)}
    controls = [*(CONTROLS[name] for name in CONTROLS), signed]
    changed = [change(each) for each in controls for row in each.settings for change in row.changes.values()]
    seen, left = {}, [*controls, *changed, *POSTS.values()]
    while left:
        each = left.pop()
        if id(each) in seen:
            continue
        seen[id(each)] = each
        if isinstance(each, Mapping):
            left += [*each.keys(), *each.values()]
        elif isinstance(each, tuple | list | frozenset):
            left += each
        for name, default in fields_of(type(each)):
            left.append(value := getattr(each, name))
            used[f"{type(each).__name__}.{name}"] = used.get(f"{type(each).__name__}.{name}") or bool(value or default)
        left += [each.language] if isinstance(each, contoursolve.tables.ChainFinder) else []
    written = {
        name for name in used if name.partition(".")[0] in {kind.__name__ for kind in (contoursolve.Control, *tables)}
    }
    assert {name for name in written if not used[name]} == FILLED
