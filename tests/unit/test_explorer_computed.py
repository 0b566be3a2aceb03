"""Words whose values are variables or expressions: the explorer leaves them, and every other character, as they are."""

import pytest
from test_explorer import Talk

import contoursolve
from contoursolve.workbench import Desk

PROGRAMS = [
    (
        "fanuc-lathe",
        (
            "#100=24.\n#101=1.5\nG0 X16. Z0.\nN30 G1 X#100 ,C1.5 F0.2 (X#100 ,C1.5)\n"
            "N35 Z-20. ,R[#101*2.]\nN40 X[#100+12.] ,A120.\nN45 Z - [#100 + 8.]"
        ),
        {"4:X": "X#100", ",R": ",R[#101*2.]", "6:X": "X[#100+12.]"},
    ),
    # A call gives the values, which are longer than what is typed.
    (
        "fanuc-lathe",
        "G0 X60. Z0.\nG65 P2 X58.1234 D0.12345\nM30\nO2\nG1 X#24,C#7,A100.\nZ-[#24/2.],C1.5;(Z-1)\nX70.\nM99",
        {"5:X": "X#24", "5:,C": ",C#7", "Z": "Z-[#24/2.]"},
    ),
    # An empty variable leaves its word out.
    ("fanuc-lathe", "#1=#0\n#2=3\nG0 X40. Z0.\nG1 ,A180. X#1 Z#1 ,R#2\nU20. W-20.", {",R": ",R#2"}),
    (
        *("fanuc-lathe", "G0 X40. Z0.\n#1=20. (NEXT)\nG1 W[-#1] ,R[3.] (SET)\nU#1 ,A120."),
        {"W": "W[-#1]", ",R": ",R[3.]", "U": "U#1"},
    ),
    (
        *("fanuc-mill", "#1=10.\nG17 G90 G0 X0 Y0\nG1 X-[#1],R#1 F200.\nY[#1*3.],C2.\nX[50.-#1/2.]"),
        {"3:X": "X-[#1]", ",R": ",R#1", "Y": "Y[#1*3.]", "5:X": "X[50.-#1/2.]"},
    ),
    (
        *("nct-99m", "#1=5\nG17 G41 G0 X50 Y0\nG3 X-50 Y0 R[#1*10] Q-1\nG1 X-[#1*10] Y42.857 ,A171.87"),
        {"R": "R[#1*10]", "4:X": "X-[#1*10]"},
    ),
    (
        *("yasnac-lx3", "#100=40.\nG00 X#100 Z0.\nG111 X[#100*2.5]A180. K-[#100] B120. P5."),
        {"X": "X[#100*2.5]", "K": "K-[#100]"},
    ),
    (
        *("haas-lathe", "#100 = 24.\nG00 X16. Z0.\nG01 X#100 ,C1.5\nZ-[#100 - 4.] ,R3.\nX36."),
        {"3:X": "X#100", "Z": "Z-[#100 - 4.]"},
    ),
    ("haas-mill", "#3=2.5\nG17 G00 X0 Y0\nG01 X#3 ,R1.\nY[#3*4] ,C0.5\nX20.", {"3:X": "X#3", "Y": "Y[#3*4]"}),
    (
        *("mitsubishi", "#100=24.\nG18 G00 X16. Z0.\nG01 X#100 ,C1.5\nZ-[#100-4.] ,R3.\nX36. ,A120."),
        {"3:X": "X#100", "Z": "Z-[#100-4.]"},
    ),
    (
        "siemens-840d",
        "DEF REAL W_1=60\nR1=5\nG18 G90\nG0 X40 Z0\nG1 Z=-R1*4 RND=R1 F0.2 ; RND=R1\nG1 X=IC(R1*4) ANG=120\nG1 Z=-W_1",
        {"Z": "Z=-R1*4", "RND": "RND=R1", "X=IC": "X=IC(R1*4)"},
    ),
    (
        *("siemens-808d", "R1=5.25\nG18 G90\nG0 X40 Z0\nG1 Z=-(R1*4) RND=2\nG1 X=IC(20) ANG=R1+115.5\nG1 Z-60"),
        {"Z": "Z=-(R1*4)", "ANG": "ANG=R1+115.5"},
    ),
    (
        *("isg", "P1=5\nG18 G90\nG0 X40 Z0\nG1 Z=-P1*4 #RND=P1\nG1 X[P1*12] #CHF=2\nZ-50\n"),
        {"4:Z": "Z=-P1*4", "#RND": "#RND=P1", "X": "X[P1*12]"},
    ),
    (
        "heidenhain",
        (
            "0 BEGIN PGM A MM\n1 Q1 = 50\n2 Q2 = 3\n3 L X+0 Y+0 R0 FMAX\n4 FPOL X+0 Y+0\n"
            "5 FL X+Q1 Y-Q2 F500\n6 RND R3\n7 FL X+90 Y+Q1\n8 END PGM A MM"
        ),
        {"6:X": "X+Q1", "6:Y": "Y-Q2", "8:Y": "Y+Q1"},
    ),
]


def begun(control, text):
    line = contoursolve.solve(text, control=control).answers[0].lines[0]
    return Talk(text, line=line, control=control)


def assert_only_changed(text, now, words):
    """Nothing but these words, none of which stands twice in a line outside of a comment, has another text."""
    pairs = list(zip(text.split("\n"), now.text.split("\n"), strict=True))
    changed = [(old, new) for old, new in pairs if old != new]
    for key, word in words.items():
        typed = now.field(key)["word"]
        changed = [(old.replace(word, typed, 1) if word in old else old, new) for old, new in changed]
    assert [(old, new) for old, new in changed if old != new] == []


@pytest.mark.slow
@pytest.mark.parametrize(("control", "text", "computed"), PROGRAMS)
def test_a_word_with_a_variable_stays_and_moves_of_others_keep_every_character(control, text, computed):
    now = begun(control, text)
    fields = {each["key"]: each for each in now.view["fields"]}
    movable = {key: each["word"] for key, each in fields.items() if key not in computed}
    assert len(movable) >= 1
    assert {key: each["word"] for key, each in fields.items() if each["state"] == "computed"} == computed
    assert computed.keys() & now.view["frames"].keys() == set()
    assert {key for handle in now.view["handles"] for key in handle["keys"]} & computed.keys() == set()
    for key, typed in computed.items():
        assert fields[key]["reason"].startswith(f"{typed} takes its value from ")
        for action in ({"do": "move", "values": {key: 7.5}}, {"do": "free", "key": key}):
            now.own.answer(action)
            assert (now.text, now.view["trouble"][-28:]) == (text, "; change that in the program")
    for key, word in movable.items():
        assert_only_changed(text, now.do("move", values={key: fields[key]["value"] + 1}), {key: word})
        assert_only_changed(text, now.do("undo").do("free", key=key), {key: word})
        assert (now.field(key)["state"], now.do("undo").text) == ("free", text)
    several = {key: fields[key]["value"] + 0.5 for key in movable if key != "Q"}
    now.do("move", values=several)
    assert_only_changed(text, now, {key: movable[key] for key in several})
    assert {key: now.field(key)["value"] for key in several} == pytest.approx(several)


def test_the_page_writes_beside_a_variable_and_marks_whole_words():
    desk, (_, text, computed) = Desk(), PROGRAMS[0]
    opened = desk.answer({"window": "a", "do": "open", "text": text, "control": "fanuc-lathe"})
    about = {"window": "a", "program": opened["id"], "line": 4}

    def marked(words):
        lines = desk.answer({**about, "do": "view"})["text"].split("\n")
        return {key: lines[line - 1][begin:end] for key, (line, begin, end) in words.items()}

    looked = desk.answer({**about, "do": "look"})
    assert marked(looked["words"]) == {**computed, ",C": ",C1.5", "Z": "Z-20.", ",A": ",A120."}
    acted = desk.answer({**about, "do": "act", "action": {"do": "move", "values": {",C": "2"}}})
    assert [each["text"] for each in acted["edits"]] == ["2."]
    assert marked(acted["words"]) == {**computed, ",C": ",C2.", "Z": "Z-20.", ",A": ",A120."}
    refused = desk.answer({**about, "do": "act", "action": {"do": "move", "values": {"4:X": 26}}})
    assert refused["changed"]["view"]["trouble"] == "X#100 takes its value from #100; change that in the program"
    assert "edits" not in refused


@pytest.mark.boundary
def test_a_range_beside_a_variable_is_that_of_the_whole_program():
    now = begun(*PROGRAMS[0][:2])
    least, most = now.range(",C")["intervals"][0]
    assert least == 0
    assert [now.has_contour(",C", value) for value in (most - 0.01, most + 0.01)] == [True, False]
