"""A limit that is printed holds, wherever it is printed: typed in as it is printed, the contour exists."""

import json
import re
from collections.abc import Iterator
from decimal import Decimal
from html import unescape
from math import atan2, degrees

import pytest
from calling import call, data
from editor import Editor, in_editor
from examples import law
from hypothesis import strategies as st
from msgspec import Struct
from msgspec.structs import replace

import contoursolve
from contoursolve.notebook import Conversation, begin
from contoursolve.output import range_data, report_page, word_tolerance_data

SIZE = st.integers(1_000, 9_999)


def word(thousandths: float) -> str:
    """A number as a word has it."""
    return f"{thousandths / 1000:.3f}"


class Asked(Struct, frozen=True):
    """Blocks with one number open, written as #1, and a number with which they have a contour."""

    text: str
    stated: str
    start: str = "X40. Z0."
    control: str = "fanuc-lathe"
    units: str = "mm"

    @property
    def options(self) -> dict[str, str]:
        return {"control": self.control, "units": self.units}

    @property
    def words(self) -> tuple[str, ...]:
        """The same as options of a command."""
        return "--control", self.control, "--units", self.units

    def typed(self, number: str) -> str:
        """The program with a number in the place of what is open."""
        return f"G00 {self.start}\n{self.text.replace('#1', number if '.' in number else f'{number}.')}"

    def holds(self, number: str) -> bool:
        (answer,) = contoursolve.solve(self.typed(number), depth="verdict", **self.options).answers
        return answer.contour is not None


CHAINS = {
    "G01 ,A{a} ,R#1 F0.2\nX{x} Z-80. ,A{b}": "0.1",
    "G01 Z-30. ,R{size} F0.2\nX60. Z#1": "-30.",
    "G01 Z-20. ,A#1 ,C1.\nX{x} Z-60.": "170.",
    "G01 Z-20. ,R{size}\nX{x} Z#1 ,R2.\nZ-90.": "-40.",
    "G01 Z-20. ,R#1\nX60. ,R{size}\nZ-90.": "0.1",
}


@st.composite
def drawn(draw: st.DrawFn) -> Asked:
    """Blocks in mm or inch; or a word that repeats others, which may vary by less than a thousandth."""
    about = {
        "a": word(180_000 - draw(st.integers(3_000, 30_000))),
        "b": word(180_000 - draw(st.integers(31_000, 80_000))),
        "x": word(draw(st.integers(50_000, 90_000))),
        "size": word(draw(SIZE)),
    }
    if draw(st.integers(0, 4)) == 0:
        x, z = draw(st.integers(60_000, 90_000)), draw(st.integers(300_000, 3_000_000))
        own = 180 - degrees(atan2((x - 40_000) / 2, z))
        return Asked(f"G01 X{word(x)} Z-{word(z)} ,A#1", f"{own:.5f}")
    text, stated = draw(st.sampled_from([*CHAINS.items()]))
    asked = Asked(text.format(**about), stated)
    return inches(asked) if draw(st.booleans()) else asked


def inches(asked: Asked) -> Asked:
    """The same contour in inches."""
    is_angle = ",A#1" in asked.text

    def scaled(text: str) -> str:
        return re.sub(r"(,R|,C|[XZ])(-?[\d.]+)", lambda each: f"{each[1]}{float(each[2]) / 25.4:.4f}", text)

    stated = asked.stated if is_angle else f"{float(asked.stated) / 25.4:.4f}"
    return replace(asked, text=scaled(asked.text), start=scaled(asked.start), stated=stated, units="inch")


NUMBER = r"-?\d+(?:\.\d+)?"
NOTE = re.compile(rf"(?:from|up to|to) ({NUMBER})(?! on)\b")
TABLE = re.compile(rf"\b(?:from|to)\s+({NUMBER}) (?:mm|in|deg)\b")
REASON = re.compile(rf"at (?:most|least) ({NUMBER}) (?:mm|in|deg)\b")
SHORT = re.compile(rf"(?:[≤≥=] ({NUMBER})|({NUMBER}) ≤)")


def shown(page: str) -> str:
    """The words of a page or a picture."""
    return unescape(re.sub(r"<[^>]*>|\s+", " ", re.sub(r"(?s)<(style|script).*?</\1>", " ", page)))


Limits = Iterator[tuple[str, str]]
"""Where a limit is printed, and its number."""


def of_variables(asked: Asked) -> Limits:
    """The values of a variable that nobody states."""
    program = asked.typed("#1").replace("#1.", "#1")
    text = call("check", "-", *asked.words, stdin=program).stdout
    document = data("check", "-", *asked.words, stdin=program)
    page = shown("".join(report_page(contoursolve.solve(program, **asked.options), "1")))
    told = {"check": text, "check json": json.dumps(document, indent=1), "report": page}
    for where, text in told.items():
        notes = [each.partition("#1 below")[0].partition("#1 above")[0] for each in text.split("#1 makes")[1:]]
        assert notes or "no value of #1 that was tried" in text, where
        yield from ((where, each) for note in notes for each in NOTE.findall(note.split("\n")[0].split(";")[0]))


def of_ranges(asked: Asked) -> Limits:
    """The ranges of a word."""
    found = contoursolve.ranges(asked.text, "#1", start=asked.start, **asked.options)
    bundle = found._repr_mimebundle_()
    title = str(found).split("\n")[0]
    told = {
        "range": str(found).partition("\n")[2],
        "notebook": shown(bundle["text/html"]).replace(title, " "),
        "picture": shown(bundle["image/svg+xml"]),
    }
    for where, text in told.items():
        limits = [*TABLE.findall(text), *REASON.findall(text)]
        assert limits or not found.intervals, where
        yield from ((where, each) for each in limits)
    ends = [each[side] for each in range_data(found)["ranges"] for side in ("low", "high")]
    for end in ends:
        yield from (("json", f"{each:.17f}") for each in [end["value"]] * end["included"])
        yield from (("json inside", f"{end['inside']:.17f}") for _ in [0] if end["inside"] is not None)


def of_explorers(asked: Asked) -> Limits:
    """The ranges beside a slider."""
    talk = Conversation(begin(asked.typed(asked.stated), **asked.options))
    address = re.search(r"(,?[A-Z])#1", asked.text)
    assert address is not None
    keys = [each["key"] for each in talk.state["view"]["fields"]]
    line = 2 + asked.text[: address.start()].count("\n")
    key = next(each for each in (f"{line}:{address[1]}", address[1]) if each in keys)
    talk.answer({"do": "range", "key": key})
    found = talk.state["ranges"][key]
    numbers = [next(filter(None, each)) for text in (found["note"], found["whole"]) for each in SHORT.findall(text)]
    yield from (("slider", each) for each in numbers)
    for stops, ends in zip(found["stops"], found["ends"], strict=True):
        yield from (("stop", f"{stop:.10f}") for stop, end in zip(stops, ends, strict=True) if end)
        yield from (("end", each) for end in ends for each in REASON.findall(end))


@law(drawn(), few=4, many=6)
def test_a_limit_that_is_typed_in_as_it_is_printed_has_the_contour(asked: Asked) -> None:
    limits = {*of_variables(asked), *of_ranges(asked), *of_explorers(asked)}
    for where, number in limits:
        assert asked.holds(number), (where, number, asked.typed(number))
    last = [Decimal(number) for where, number in limits if where == "check"]
    for number in last:
        # A whole step farther on it does not: nothing is given away but what rounding takes.
        step = Decimal(1).scaleb(min(int(number.as_tuple().exponent), -3))
        assert not all(asked.holds(f"{number + way * step:f}") for way in (-1, 1)), (number, asked)


def test_the_limits_of_two_corners_are_those_that_fit() -> None:
    for text, limit in (
        ("G01 ,A170. ,R#1 F0.2\nX60. Z-80. ,A150.", "2.084"),
        ("G01 Z-30. ,R5. F0.2\nX60. Z#1", "-0.834"),
    ):
        asked = Asked(text, "0.1")
        assert limit in [number for limits in (of_variables, of_ranges) for _, number in limits(asked)]


@law(st.sampled_from([1e-2, 1e-3, 1e-4, 1e-5, 3e-6]), st.integers(-9, 9), st.sampled_from("BKPX"), few=5, many=25)
def test_a_tolerance_that_is_printed_is_kept(within: float, odd: int, name: str) -> None:
    stated = {"X": "100.", "A": "170.", "K": f"-30.0000{abs(odd)}", "B": f"120.00{abs(odd)}", "P": "5.", "Q": "5."}

    def block(number: str) -> str:
        return "G111 " + " ".join(f"{each}{number if each == name else value}" for each, value in stated.items())

    def turn(number: str) -> tuple[float, float]:
        (answer,) = contoursolve.solve(f"G00 X40. Z0.\n{block(number)}", depth="verdict").answers
        assert answer.contour is not None
        return answer.contour.places["V2"]

    found = contoursolve.tolerances(block(stated[name]), name, keep="V2", within=within, start="X40. Z0.")
    own = turn(stated[name])
    limits = [("text", each) for each in TABLE.findall(shown(str(found)))]
    document = word_tolerance_data(found)
    ends = [document[side] for side in ("low", "high")]
    limits += [("json", f"{end['value']:.15f}") for end in ends if end["included"]]
    assert len(limits) >= 2
    for where, number in limits:
        moved = max(abs(one - other) for one, other in zip(turn(number), own, strict=True))
        assert moved <= within * (1 + 1e-6), (where, number, moved, within)
    for number, off in re.findall(rf"({NUMBER}) (?:mm|deg)\s+([+-]?{NUMBER}) (?:mm|deg)", str(found)):
        assert Decimal(number) == Decimal(stated[name]) + Decimal(off)


# Tools -----------------------------------------------------------------------------------------------------------

TOOLS = {
    "lathe": "G18 G21\nG00 G42 X40. Z0.\nG111 X100. A180. K-30. B120. P{size} Q5.\nG00 G40 X120.\n",
    "lathe in inch": "G18 G20\nG00 G42 X1.5 Z0.\nG111 X4. A180. K-1.2 B120. P{inch} Q.2\nG00 G40 X5.\n",
    "mill": "G17 G21\nG00 G41 X0 Y0\nG01 X{size} ,R{size}\nY20. ,R{size}\nX60.\nG40 G00 X80.\n",
}
UP_TO = re.compile(rf"(?:up to R?|at most |for the contour: )({NUMBER})")


@pytest.mark.parametrize("name", TOOLS)
@pytest.mark.parametrize("thousandths", [2_540, 3_333, 5_700, 7_001])
def test_a_tool_that_is_said_to_fit_cuts_the_contour(name: str, thousandths: int) -> None:
    program = TOOLS[name].format(size=word(thousandths), inch=f"{thousandths / 25_400:.4f}")
    tip = ("--tip", "3") if "G111" in program else ()
    control = ("--control", "yasnac-lx3") if tip else ("--control", "fanuc-mill")
    limits = [
        ("find", each)
        for each in UP_TO.findall(call("find", "-", "--word", "tool", *tip, *control, stdin=program).stdout)
    ]
    document = data("find", "-", "--word", "tool", *tip, *control, stdin=program)
    limits.append(("find json", f"{document['largest']:.12f}"))
    limits += [("find json", f"{each['high']['value']:.12f}") for each in document["contours"][0]["ranges"]]
    told = call("check", "-", "--tool", "R9.5", *tip, *control, stdin=program)
    limits += [("check", each) for each in UP_TO.findall(told.stdout)]
    report = contoursolve.solve(program, tool="R9.5", tip=3 if tip else None, control=control[1]).tool
    assert report is not None
    line = next(number for number, text in enumerate(program.split("\n"), 1) if "G01" in text or "G111" in text)
    limits += [("hover", each) for each in UP_TO.findall(report.text(line))]
    stated = f"contoursolve tool: R9.5{', tip 3' if tip else ''}"
    talk = Conversation(begin(f"({stated})\n{program}", control=control[1]))
    talk.answer({"do": "range", "key": "tool"})
    limits += [("slider", each) for each in re.findall(rf"≤ ({NUMBER})", talk.state["ranges"]["tool"]["note"])]
    assert {where for where, _ in limits} == {"find", "find json", "check", "hover", "slider"}
    for where, number in limits:
        assert call("check", "-", "--tool", f"R{number}", *tip, *control, stdin=program).exit_code == 0, (where, number)


# Fixes -----------------------------------------------------------------------------------------------------------

FIXES = (
    "G111 X{x} A170. K-{size} P2. Q1.",
    "G111 X{x} A180. B130. P2.",
    "G111 X{x} A170. K-{size} B130. P{large}",
    "G01 ,A170. ,R{large} F0.2\nX{x} Z-80. ,A140.",
    "G01 Z-{size} ,R{large} F0.2\nX{x} Z-80.",
)


@law(st.sampled_from(FIXES), SIZE, st.integers(50_000, 90_000), st.booleans(), few=3, many=20)
def test_a_number_that_a_fix_names_makes_a_contour(text: str, size: int, x: int, is_inch: bool) -> None:
    scale = 25.4 if is_inch else 1.0
    numbers = {"size": size, "x": x, "large": 10 * size}
    digits = 4 if is_inch else 3
    block = text.format(**{name: f"{each / 1000 / scale:.{digits}f}" for name, each in numbers.items()})
    start = f"G00 X{40 / scale:.4f} Z0.\n"
    words = ("--control", "yasnac-lx3" if "G111" in text else "fanuc-lathe", "--units", "inch" if is_inch else "mm")

    def is_solved(lines: str) -> bool:
        found = contoursolve.solve(start + lines, depth="verdict", control=words[1], units=words[3])
        return found.answers[0].contour is not None and not found.has_errors

    for finding in data("check", "-", *words, stdin=start + block)["diagnostics"]:
        for fix in finding["fixes"]:
            numbers = fix.get("numbers", ())
            for number in numbers:
                for end in filter(None, (each[side] for each in number["ranges"] for side in ("from", "to"))):
                    written = fix["replacement"].replace(number["word"], end, 1)
                    for other in numbers:
                        written = written.replace(other["word"], other["example"] or "", 1)
                    assert is_solved(written), (fix["description"], end, written)
        for most in re.findall(rf"write at most ({NUMBER}) (?:mm|in)$", finding["help"] or ""):
            ends = [Decimal(most), Decimal(most) + Decimal(1).scaleb(-digits)]
            typed = [re.sub(r"(,R|P)[\d.]+", rf"\g<1>{each:f}", block, count=1) for each in ends]
            assert [is_solved(each) for each in typed] == [True, False], (finding["message"], most, block)


# The editor ------------------------------------------------------------------------------------------------------


def test_the_editor_prints_the_same_limits() -> None:
    asked = Asked("G01 ,A170. ,R#1 F0.2\nX60. Z-80. ,A150.", "0.1")
    uri, limits = "file:///programs/open.nc", list[str]()

    async def use(editor: Editor) -> None:
        editor.open(uri, f"(contoursolve control: fanuc-lathe)\n{asked.typed('#1').replace('#1.', '#1')}\n")
        for found in await editor.findings(uri):
            limits.extend(
                each for note in found.message.split("#1 makes")[1:] for each in NOTE.findall(note.split("\n")[0])
            )

    in_editor(use)
    assert limits
    assert all(map(asked.holds, limits))


# Regions ---------------------------------------------------------------------------------------------------------


def test_the_edge_of_a_region_is_as_near_as_it_is_said_to_be() -> None:
    """Within what is printed of each point of a line, one of the words has a value with a contour and one without."""
    block = "G111 X100. A180. K-30. B120. P5. Q5."
    found = contoursolve.ranges(block, ("A", "P"), ((150, 210), (1, 60)), start="X40. Z0.")
    near = [float(each) for each in re.findall(r"edges within ([\d.]+) deg and ([\d.]+) mm", found.fineness)[0]]

    def holds(angle: float, size: float) -> bool:
        text = block.replace("A180.", f"A{angle:.6f}").replace("P5.", f"P{size:.6f}")
        return contoursolve.solve(f"G00 X40. Z0.\n{text}", depth="verdict").answers[0].contour is not None

    points = [each for line in found.boundaries for each in line.points[:: len(line.points) // 5 or 1]]
    for angle, size in points:
        beside = [(angle + way * near[0], size) for way in (-1, 0, 1)] + [
            (angle, size + way * near[1]) for way in (-1, 1)
        ]
        assert {holds(*each) for each in beside} == {True, False}, (angle, size)
    for line in found.boundaries:
        assert not holds(*line.outside)
