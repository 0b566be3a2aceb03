"""The floors of the house: a room imports only from lower floors; some imports are for some rooms only."""

import ast
import inspect
import pydoc
import re
import subprocess
import sys
import typing
from collections import Counter
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from itertools import pairwise
from pathlib import Path

import pytest

import contoursolve
from contoursolve.controls import CONTROLS
from contoursolve.solving import RefusalKind

FLOORS = (
    "tolerance diagnostics numeric",
    "gcode",
    "geometry execution",
    "reading solving",
    "diagnosis controls",
    "program",
    "comparison families",
    "postprocess pictures tool_radius",
    "api output questions sketches",
    "comparing editing errors notebook outcomes tables try_examples",
    "__init__",
    "lsp cli workbench",
    "__main__",
)
FLOOR_OF = {room: number for number, rooms in enumerate(FLOORS) for room in rooms.split()}
HOUSE = Path(contoursolve.__file__).parent
MODULES = sorted(HOUSE.rglob("*.py"))
PATHS = {
    ".".join(("contoursolve", *path.relative_to(HOUSE).with_suffix("").parts)).removesuffix(".__init__"): path
    for path in MODULES
}


STATEMENT = re.compile(r"^ *from (\S+) import +(\([^)]*\)|.*)$|^ *import +(.*)$", re.MULTILINE)
NAMED = re.compile(r"""[^\\]["'](contoursolve\.\w+)""")
"""A module that is named by a text."""


def room_of(module: Path) -> str:
    return module.relative_to(HOUSE).with_suffix("").parts[0]


@cache
def text_of(module: Path) -> str:
    return module.read_text(encoding="utf-8")


@cache
def code_of(module: Path) -> str:
    """The text without docstrings and long texts."""
    return re.sub(r'""".*?"""', '""', text_of(module), flags=re.DOTALL)


@cache
def parsed(module: Path) -> ast.Module:
    return ast.parse(text_of(module))


def saying(*words: str) -> list[Path]:
    """The modules in which one of these words stands: no other one is parsed."""
    return [module for module in MODULES if any(word in text_of(module) for word in words)]


def short(module: Path) -> str:
    return module.relative_to(HOUSE).as_posix()


def names_in(listed: str) -> list[str]:
    """The names of an import statement, without brackets, comments and what they are called here."""
    plain = re.sub(r"#.*|[()\\]", "", listed)
    return [name for each in plain.split(",") if (name := each.split(" as ")[0].strip())]


@cache
def exported(package: str) -> dict[str, str]:
    """What a package lists for others: each name, and the module that has it."""
    stub = PATHS[package].with_suffix(".pyi")
    if PATHS[package].name != "__init__.py" or not stub.exists():
        return {}
    return {
        name: f"{package}.{home.lstrip('.') or name}"
        for home, listed, _ in STATEMENT.findall(text_of(stub))
        for name in names_in(listed)
    }


@cache
def imports(module: Path) -> tuple[str, ...]:
    """Full names of everything imported anywhere in a module, or named as a module by a text."""
    return tuple(_imports(module))


def _imports(module: Path) -> Iterator[str]:
    for source, listed, plain in STATEMENT.findall(code_of(module)):
        assert not source.startswith("."), f"{module}: a relative import hides the room"
        yield from (f"{source}.{name}" for name in names_in(listed)) if source else names_in(plain)
    # A file beside a module, or its neighbours by their names.
    named = NAMED.findall(code_of(module))
    yield from (name for name in named if not name.endswith(("toml", f".{room_of(module)}")))
    if module.name == "__init__.py":
        package = next(name for name, path in PATHS.items() if path == module)
        yield from (f"{home}.{name}" for name, home in exported(package).items())


def home_of(name: str) -> str | None:
    """The module of the house that an imported name is in, however many packages list it on the way."""
    if name in PATHS:
        return name
    package, _, last = name.rpartition(".")
    while package in PATHS and last in exported(package):
        package = exported(package)[last]
    return package if package in PATHS else None


def needed(module: Path) -> set[str]:
    return {home for name in imports(module) if (home := home_of(name)) is not None and PATHS[home] != module}


def rooms(module: Path) -> Iterator[str]:
    for name in imports(module):
        house, _, rest = name.partition(".")
        if house == "contoursolve":
            room = rest.split(".")[0]
            yield room if room in FLOOR_OF else "__init__"


def test_no_file_stands_in_a_circle():
    """Of files, whose imports are followed through the lists of packages to where a name is defined."""
    graph = {name: needed(path) for name, path in PATHS.items()}
    TopologicalSorter(graph).prepare()  # raises CycleError, which names the files


def test_nothing_is_imported_past_what_a_package_lists():
    past = [
        (short(module), source)
        for module in MODULES
        for source, _, _ in STATEMENT.findall(code_of(module))
        if source.startswith("contoursolve.") and source.count(".") > 1 and source.split(".")[1] != room_of(module)
    ]
    assert past == []


def test_a_room_imports_only_from_lower_floors():
    assert {room_of(module) for module in MODULES} == FLOOR_OF.keys()
    assert {path.parent.name for path in HOUSE.glob("*/*.py")} <= FLOOR_OF.keys()
    assert (len(FLOOR_OF), len(FLOORS)) <= (32, 13)
    above = [
        (short(module), room)
        for module in MODULES
        for room in rooms(module)
        if room != room_of(module) and FLOOR_OF[room] >= FLOOR_OF[room_of(module)]
    ]
    assert above == []


def test_the_language_server_knows_what_the_package_exports():
    known = {room for module in MODULES if room_of(module) == "lsp" for room in rooms(module)}
    # contoursolve.controls is the name of a command there.
    assert known - {"controls"} == {
        "__init__",
        "diagnosis",
        "diagnostics",
        "editing",
        "errors",
        "lsp",
        "notebook",
        "output",
        "pictures",
        "reading",
    }


ONE_DOOR = {
    "SciPy, sympy, CasADi and FLINT": (r"^ *(?:from|import) (?:sympy|casadi|flint|scipy)\b", {"numeric"}),
    # LAPACK prints on standard output, or hangs at what is not finite: what eliminates does neither.
    "what iterates": (r"\blinalg\.(?!(?:inv|solve|det|norm|LinAlgError)\b)\w", {"numeric/linear_algebra.py"}),
    "the maker of parsed contours": (r"\bParsedContour\(", {"reading/contour_builder.py"}),
    "the maker of rules from rows, column by column": (
        r"(?<!class )\bRule\(",
        {"controls/rule_rows.py", "tool_radius/faults.py"},
    ),
    # Who needs a control says which; where nothing tells it, what holds for all of them counts.
    "a control that stands in where none is named": (r"""CONTROLS\[["']""", set()),
    # Python before 3.11.5 reads that wrongly (gh-106052); an atomic group says the same.
    "a group that is repeated possessively": (r"^(?!\s*#).*(?<!\\)\)[?*+]\+", set()),
}
"""Patterns of code, and the rooms or files that alone may have it."""


@pytest.mark.parametrize("name", ONE_DOOR)
def test_some_code_stands_behind_one_door(name):
    pattern, doors = ONE_DOOR[name]
    having = [module for module in MODULES if re.search(pattern, code_of(module), re.MULTILINE)]
    assert {short(module) if short(module) in doors else room_of(module) for module in having} == doors


G111 = "contoursolve.solve('G111 X100. A180. K-30. {}', start='X40. Z0.').answers[0]"
PAIR = r"contoursolve.solve('G17 G41 G0 X50 Y0\nG3 X-50 Y0 R50\nG1 X-50 Y42.857 ,A171.87 Q-1').answers[0]"
MANY = r"contoursolve.solve('G0 X40. Z0.\n' + 'G111 X100. A180. K-30. B120.\nG0 X40. Z0.\n' * 60).answers[59].contour"
HEAVY = {"anywidget", "htpy", "matplotlib", "pyarrow", "scipy", "sympy", "xarray", "contoursolve.families"}
IN_A_BROWSER = "import sys; sys.modules |= dict.fromkeys({}); import contoursolve.notebook.conversation"
USES = {
    "importing the package": "pass",
    "solving G111": f"{G111.format('B120. P5.')}.contour.end",
    "solving a circle and a line": f"{PAIR}.contour.end",
    "refusing G111": f"{G111.format('')}.diagnostics[0]",
    "solving many": MANY,
}


def test_the_page_that_solves_in_the_browser_needs_neither_sympy_nor_what_a_terminal_needs():
    lacking = ["sympy", "click", "anywidget", "matplotlib", "scipy", "packaging"]
    subprocess.run([sys.executable, "-c", IN_A_BROWSER.format(lacking)], check=True)


def test_nothing_heavy_is_needed_for_what_is_done_most():
    """One after the other in one process."""
    told = f"print(*sorted({HEAVY} & sys.modules.keys()))"
    program = "\n".join(("import sys, contoursolve", *(f"{use}\n{told}" for use in USES.values())))
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert dict(zip(USES, done.stdout.splitlines(), strict=True)) == dict.fromkeys(USES, "")


def test_no_name_that_a_package_lists_is_that_of_another_of_its_modules():
    """Importing the module would put it in the place of the name."""
    for package in PATHS:
        of_modules = {f"{package}.{name}": home for name, home in exported(package).items()}
        assert {name: home for name, home in of_modules.items() if name in PATHS and home != name} == {}


def test_no_public_class_name_has_two_meanings():
    homes: dict[str, list[str]] = {}
    for module in MODULES:
        for name in re.findall(r"^class ([A-Z]\w*)", code_of(module), re.MULTILINE):
            homes.setdefault(name, []).append(short(module))
    assert {name: files for name, files in homes.items() if len(files) > 1} == {}


def test_help_and_the_types_of_every_public_name_can_be_asked_for():
    assert "class Answer(" in pydoc.render_doc(contoursolve, renderer=pydoc.plaintext)
    for name in contoursolve.__all__:
        thing = getattr(contoursolve, name)
        if callable(thing):
            assert typing.get_type_hints(thing) is not None
            assert inspect.isclass(thing) or "(" in str(inspect.signature(thing))
        for each in vars(thing).values() if inspect.isclass(thing) else ():
            function = getattr(each, "fget", getattr(each, "func", getattr(each, "__func__", each)))
            if inspect.isfunction(function):
                assert typing.get_type_hints(function) is not None


def attributes_of(record: type) -> set[str]:
    """The fields that the docstring of a class tells of, or a text below them."""
    told = inspect.getdoc(record) or ""
    below = {
        before.target.id
        for node in parsed(Path(inspect.getfile(record))).body
        if isinstance(node, ast.ClassDef) and node.name == record.__name__
        for before, after in pairwise(node.body)
        if isinstance(before, ast.AnnAssign) and isinstance(before.target, ast.Name) and isinstance(after, ast.Expr)
    }
    return below | {*re.findall(r"^ {4}(\w+): ", told, re.MULTILINE), *re.findall(r"`(\w+)\b", told)}


LENGTHS = re.compile(r"Point|float|Decimal")
UNITS = re.compile(r"\b(mm|deg|degrees|inch|unit|as (they are|it is|the words are) (written|typed))\b")


def test_the_fields_of_every_public_record_are_told_of_and_numbers_with_their_units():
    untold, without_unit = list[str](), list[str]()
    for name in contoursolve.__all__:
        record = getattr(contoursolve, name)
        fields = getattr(record, "__struct_fields__", None) or tuple(getattr(record, "__dataclass_fields__", ()))
        if not inspect.isclass(record) or not fields:
            continue
        told = attributes_of(record)
        untold += [f"{name}.{field}" for field in fields if field not in told]
        is_measured = any(LENGTHS.search(str(record.__annotations__[field])) for field in fields)
        without_unit += [name] if is_measured and not UNITS.search(record.__doc__) else []
    assert (untold, without_unit) == ([], [])


PUBLIC = """
    solve check fix explain parse system family ranges find sensitivity tolerances expand convert write diff verify
    draw export report explore exercise read_sketch read_dxf
    errors editing tables pictures
    Program Block Word Control CONTROLS Sketch ContourSketch SketchElement SketchCorner OpenProgram
    Result Answer Contour LineSegment ArcSegment Status Solution Solutions EquationSystem Diagnosis
    Diagnostic Severity Basis Fix FixedProgram
    Family FeasibleRange FeasibleRegion FoundValues Sensitivity Tolerances ToleranceRange
    Drawings Drawing Expansion Conversion Comparison Receipt WrittenContours ToolReport Picture Exercise
"""
"""By kind: verbs, modules, input, contours, findings, values, others."""


def test_the_front_door_has_few_names():
    """What is asked of one record is a method of it, and what few need stands in a module."""
    assert sorted(contoursolve.__all__) == sorted(PUBLIC.split())
    assert len(contoursolve.__all__) <= 70
    errors = [getattr(contoursolve.errors, name) for name in contoursolve.errors.__all__]
    assert all(issubclass(each, contoursolve.errors.UserError) for each in errors)
    for door in (contoursolve.editing, contoursolve.tables):
        assert all(hasattr(door, name) for name in door.__all__)


UNDER_CONTROLS = ["tolerance", "diagnostics", "numeric", "gcode", "geometry", "reading", "solving"]
STANDARD = {*range(10), 17, 18, 19, 30, 40, 41, 42, 60, 90, 91}
"""Codes that mean the same on all controls: ISO 6983."""
CODE = re.compile(r"\bG0*(\d+)")


def literals(module: Path) -> Iterator[str]:
    """The texts of a module that are no docstrings."""
    tree = parsed(module)
    told = {id(each.value) for each in ast.walk(tree) if isinstance(each, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in told:
            yield node.value


def test_no_control_is_known_below_the_tables_of_the_controls():
    """Not by its name, its words or its codes: what differs is a field of a table."""
    names = {part for name in CONTROLS for part in name.split("-")} - {"lathe", "mill", "cnc"}
    named = re.compile(rf"\b({'|'.join(sorted(names))}|sinumerik|klartext|tnc)\b", re.IGNORECASE)
    lexicons = [control.modes.lexicon for control in CONTROLS.values()]
    addresses = {each for one in lexicons for each in (*one.addresses, *one.spelling.names)}
    words = {each for each in addresses if len(each.lstrip(",#")) > 1}
    found = []
    for module in MODULES:
        is_under = room_of(module) in UNDER_CONTROLS
        for text in literals(module) if is_under or room_of(module) == "diagnosis" else ():
            is_code = any(int(number) not in STANDARD for number in CODE.findall(text))
            if named.search(text) or (is_under and (text.strip() in words or is_code)):
                found.append((short(module), text))
        for node in ast.walk(parsed(module)) if is_under else ():
            if isinstance(node, ast.Set) and all(isinstance(each, ast.Constant) for each in node.elts):
                codes = {each.value for each in node.elts if isinstance(each.value, int)}
                found += [(short(module), ast.unparse(node))] if codes - STANDARD else []
    assert found == []


def described(tree: ast.Module) -> Iterator[tuple[str, bool]]:
    """The docstrings of a module, also those below a value, and whether each is that of a predicate."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            is_bool = isinstance(node, ast.FunctionDef) and node.returns and ast.unparse(node.returns) == "bool"
            yield ast.get_docstring(node) or "", bool(is_bool)
        for before, after in pairwise(node.body) if isinstance(node, ast.Module | ast.ClassDef) else ():
            if isinstance(before, ast.Assign | ast.AnnAssign) and isinstance(after, ast.Expr):
                text = after.value.value if isinstance(after.value, ast.Constant) else None
                is_bool = isinstance(before, ast.AnnAssign) and ast.unparse(before.annotation) == "bool"
                yield text if isinstance(text, str) else "", is_bool


@pytest.mark.slow
def test_a_docstring_opens_with_the_thing_or_the_verb():
    """Not with a question about it; "whether" is right for a predicate alone."""
    opener, again = re.compile(r"(What|Whether|Where|Which|How|Why)\b"), list[str]()
    for module in saying(*(f'"""{word} ' for word in ("What", "Whether", "Where", "Which", "How", "Why"))):
        for text, is_predicate in described(parsed(module)):
            found = opener.match(text)
            if found and not (is_predicate and found[1] == "Whether"):
                again.append(f"{short(module)}: {text}")
    assert again == []


def test_what_a_package_and_the_page_of_the_house_say_to_begin_with_is_there():
    lost = []
    for name, path in PATHS.items():
        if path.name == "__init__.py":
            text = ast.get_docstring(parsed(path)) or ""
            first = re.findall(r"`(\w+)`", re.split("[Bb]egin with", text, maxsplit=1)[-1].partition(".")[0])
            lost += [f"{name}.{each}" for each in first if "egin with" in text and f"{name}.{each}" not in PATHS]
    page = (Path(__file__).parents[2] / "docs" / "architecture.md").read_text(encoding="utf-8")
    for rooms_of_row, files in re.findall(r"^\| \d+ \| (.*?) \|.*\| (.*?) \|$", page, re.MULTILINE):
        folders = [HOUSE / room for room in re.findall(r"`(\w+)`", rooms_of_row)]
        for file in re.findall(r"`(\w+\.py)`", files):
            lost += [] if any((folder / file).exists() for folder in folders) else [f"{rooms_of_row}: {file}"]
    assert lost == []


MOST_EQUAL_LINES = 12


def code_lines(module: Path) -> list[str]:
    """The lines of code of a module: without comments, docstrings, imports, and brackets alone."""
    lines = (re.sub(r"(^|  )#.*", "", line).strip() for line in STATEMENT.sub("", code_of(module)).splitlines())
    return [line for line in lines if re.search(r"\w", line)]


def test_no_two_places_share_more_than_twelve_equal_lines():
    places: dict[tuple[str, ...], list[str]] = {}
    for module in MODULES:
        lines = code_lines(module)
        for first in range(len(lines) - MOST_EQUAL_LINES):
            run = tuple(lines[first : first + MOST_EQUAL_LINES + 1])
            places.setdefault(run, []).append(short(module))
    assert {run[0]: found for run, found in places.items() if len(found) > 1} == {}


def test_nothing_stands_in_the_tests_that_none_of_them_uses():
    texts = {path: text_of(path) for path in Path(__file__).parents[1].rglob("*.py") if "stand_ins" not in path.parts}
    words = {path: Counter(re.findall(r"\w+", text)) for path, text in texts.items()}
    alone = {
        f"{path.name}: {name}"
        for path, text in texts.items()
        for node in ast.parse(text).body
        for name in [getattr(node, "name", "") or ast.unparse(getattr(node, "targets", [ast.Constant(0)])[0])]
        if name.isidentifier() and words[path][name] == 1 and not name.startswith(("test_", "pytest"))
        and not any(path.stem in each and name in each for at, each in words.items() if at != path)
        and not getattr(node, "decorator_list", [])
    }  # fmt: skip
    assert not alone, alone


def test_a_geometric_event_is_one_row_and_few_files_name_it():
    named: dict[str, set[str]] = {}
    for module in MODULES:
        for name in re.findall(r"RefusalKind\.([A-Z_]+)", code_of(module)):
            named.setdefault(name, set()).add(short(module))
    told = {kind.name for kind in RefusalKind if kind.event.message}
    many = {name: files for name in told if len(files := named.get(name, set())) > 3}
    assert not many


KINDS = [HOUSE / "geometry" / f"{name}.py" for name in ("points", "lines", "touching")]
BUILDING = ("controls", "reading", "geometry")
"""Rooms that state constraints: what they write names the kind."""
MOST_NAMING, MOST_ASKING = 1.95, 0.3
"""Files, on average of all kinds, that name one outside its own; and of these, those that do not state any but ask of
which kind one is. Both fall with each question that becomes a field of the kind; the first rises with a control."""


def test_what_others_ask_of_a_constraint_is_a_field_of_its_kind():
    """Of which kind it is, few files ask."""
    kinds = {name for path in KINDS for name in re.findall(r"^class (\w+)", code_of(path), re.MULTILINE)}
    naming, asking = Counter[str](), Counter[str]()
    for module in {*saying(*kinds)} - {*KINDS}:
        tree = parsed(module)
        own = {each.name for each in ast.walk(tree) if isinstance(each, ast.ClassDef)}
        used = {each.id for each in ast.walk(tree) if isinstance(each, ast.Name)} & kinds - own
        imported = {each.name for each in ast.walk(tree) if isinstance(each, ast.alias)}
        naming.update(used & imported)
        asking.update(used & imported if room_of(module) not in BUILDING else ())
    assert naming.total() / len(kinds) <= MOST_NAMING, naming
    assert asking.total() / len(kinds) <= MOST_ASKING, asking
