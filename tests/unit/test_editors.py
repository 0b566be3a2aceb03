"""What editors are given: their tables are whole, and say what the package says. No node is needed."""

import json
import re
from itertools import chain
from pathlib import Path

import pytest

import contoursolve
from contoursolve.pictures.theme import DARK_COLORS, LEVELS, LIGHT_COLORS, Role

HOUSE = Path(contoursolve.__file__).parent.parent
EXTENSION = HOUSE / "editors" / "vscode"
pytestmark = pytest.mark.skipif(not EXTENSION.exists(), reason="installed without the sources of the editors")


def read(path):
    return (EXTENSION / path).read_text(encoding="utf-8")


def contributed(kind):
    return json.loads(read("package.json"))["contributes"][kind]


def patterns_of(language):
    return json.loads(read(f"syntaxes/{language}.tmLanguage.json"))["patterns"]


def scopes(line, patterns):
    """What a line is made of: texts with their scopes, as TextMate finds them."""
    found, at = [], 0
    while at < len(line):
        matches = [
            (match, pattern)
            for pattern in patterns
            if (match := re.compile(pattern.get("match", pattern.get("begin"))).search(line, at))
        ]
        if not matches:
            break
        match, pattern = min(matches, key=lambda pair: pair[0].start())
        assert match.end() > match.start(), pattern
        captures = pattern.get("captures", pattern.get("beginCaptures", {}))
        found += [(match[int(group)], scope["name"]) for group, scope in captures.items() if match[int(group)]]
        at = match.end()
        if "end" in pattern:
            end = re.compile(pattern["end"]).search(line, at)
            found += scopes(line[at : end.start()], pattern["patterns"])
            at = end.end()
        elif not captures:
            found.append((match[0], pattern["name"]))
    return found


def test_every_language_has_a_grammar_and_a_configuration_and_no_two_share_an_extension():
    languages = contributed("languages")
    grammars = {row["language"]: row for row in contributed("grammars")}
    assert grammars.keys() == {language["id"] for language in languages}
    for language in languages:
        row = grammars[language["id"]]
        assert json.loads(read(row["path"]))["scopeName"] == row["scopeName"]
        re.compile(json.loads(read(language["configuration"]))["wordPattern"])
        assert language.get("extensions") or re.compile(language["firstLine"])
    extensions = list(chain.from_iterable(language.get("extensions", ()) for language in languages))
    assert len(extensions) == len(set(extensions))
    assert ".h" not in extensions  # It belongs to C.


@pytest.mark.parametrize(
    ("language", "line", "expected"),
    [
        ("gcode", "/N10 G01X20.,R2.(ROUND)", "skip label g-code axis numeric corner numeric comment"),
        ("gcode", "N20 G111 A180. K-30. P?", "label g-code axis numeric parameter numeric parameter numeric"),
        ("gcode", "(contoursolve: line 2 tangent)", "punctuation fact entity support"),
        ("gcode", "(contoursolve control: nct-99m)", "punctuation fact control"),
        ("gcode", "X30. #ANG=120 #RND 5", "axis numeric corner operator numeric corner numeric"),
        ("gcode", "#100=SIN[30.] X#100", "macro operator macro numeric axis macro"),
        ("gcode", "IF[#1GT5]GOTO20", "flow macro word numeric flow numeric"),
        ("gcode", "O0112", "program"),
        ("gcode", "T0404 M08", "storage numeric m-code"),
        ("sinumerik", "N10 G1 X=IC(5) ANG=120 RND=5 ; END", "label g-code axis operator function numeric corner"),
        ("sinumerik", "N20 G1X10 Z-5", "label g-code axis numeric axis numeric"),
        ("sinumerik", "R1=5 IF R1 > 3 GOTOF ENDE", "parameter operator numeric flow parameter operator numeric flow"),
        ("sinumerik", 'T="A" S200 S2=30', "storage operator string storage numeric storage operator numeric"),
        ("sinumerik", "N30 DIAMON CT X20", "label command command axis numeric"),
        ("klartext", "0 BEGIN PGM WELLE MM", "label program function unit"),
        ("klartext", "5 L X+20 Y-30,5 R0 FMAX M3", "label path axis numeric axis numeric modifier modifier m-code"),
        ("klartext", "6 FC DR- R15 CLSD+ CCX+20", "label free modifier parameter numeric corner numeric"),
        ("klartext", "7 RND R5 F200", "label corner parameter numeric storage numeric"),
    ],
)
def test_a_grammar_tells_words_apart(language, line, expected):
    found = [scope for _, scope in scopes(line, patterns_of(language))]
    assert all(scope.endswith(f".{language}") for scope in found)
    pairs = list(zip(expected.split(), found, strict=False))
    assert (len(pairs), [kind for kind, scope in pairs if kind not in scope]) == (len(expected.split()), []), found


PROGRAMS = [*(HOUSE / "notebooks" / "programs").glob("*.nc"), *(HOUSE / "docs" / "programs").glob("*.[hm]*")]
LANGUAGES = {".nc": "gcode", ".mpf": "sinumerik", ".h": "klartext"}


@pytest.mark.parametrize("program", sorted(PROGRAMS), ids=lambda path: path.stem)
def test_every_character_of_a_program_is_coloured(program):
    patterns = patterns_of(LANGUAGES[program.suffix])
    for line in program.read_text(encoding="utf-8").splitlines():
        if "contoursolve:" not in line:
            coloured = "".join(text for text, _ in scopes(line, patterns))
            assert re.sub(r"\s", "", coloured) == re.sub(r"\s", "", line)


def test_the_picture_has_the_colours_of_the_package():
    light, dark = re.findall(r"\{\n((?:  --cs-.*\n)+)\}", read("media/picture.css"))
    for block, colors in ((light, LIGHT_COLORS), (dark, DARK_COLORS)):
        found = dict(re.findall(r"--cs-([\w-]+): (#\w+);", block))
        assert found.pop("marked") == colors[Role.GIVEN]
        # An editor shows contours; levels are of maps, guesses of sketches.
        others = (Role.PAPER, Role.INK, Role.GUESSED, *LEVELS)
        assert found == {role.value: colors[role] for role in Role if role not in others}


def test_nothing_names_a_registry_and_the_icon_is_as_the_marketplace_wants_it():
    locked, package = (json.loads(read(name)) for name in ("package-lock.json", "package.json"))
    assert [name for name, each in locked["packages"].items() if "resolved" in each] == []
    assert locked["version"] == locked["packages"][""]["version"] == package["version"]
    data = (EXTENSION / package["icon"]).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    assert [int.from_bytes(data[at : at + 4], "big") for at in (16, 20)] == [128, 128]
