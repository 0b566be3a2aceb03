"""The manual of each control, from its tables and from examples that are run: its words, its rules, its alarms."""

import re
from collections.abc import Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from hashlib import sha256
from html import escape
from itertools import groupby

from contoursolve.controls import COMMON_RULES, CONTROLS, GEOMETRY_RULES
from contoursolve.diagnostics import Diagnostic
from contoursolve.gcode import FaultKind
from contoursolve.geometry import Unit
from contoursolve.output import alarm_rows
from contoursolve.pictures import draw_result
from contoursolve.program import Result
from contoursolve.reading import THIS_CONTROL, Address, Code, Control, Effect, ReadIssue, Rule, Setting, WithoutPoint
from contoursolve.try_examples import try_example

SHORT = 4
"""Words of a meaning that stands in the title of a section."""

IN_ALL = frozenset.intersection(*(frozenset(each.name for each in one.settings) for one in CONTROLS.values()))
"""Settings that every control has."""

HOW_TO_READ = "[How to read this page](../index.md#how-to-read)"

LONGEST = 100
"""Characters of a line that is shown; only the rule about long blocks has longer ones."""

_READING = frozenset(rule.code for rule in COMMON_RULES if isinstance(rule.about, ReadIssue))
_FACTS = re.compile(
    r"fact|reference-|trusted|asked|start-units|start-diam|words-(missing|conf|red)|several|no-point|axis-"
)
_GENERAL = _READING | {rule.code for rule in (*COMMON_RULES, *GEOMETRY_RULES)}


@dataclass(frozen=True, slots=True)
class Shown:
    """An example as a page shows it: the program, what is said of it, and its picture, or nothing; and its words by
    address, and the addresses of those that the finding marks."""

    text: str
    told: str
    picture: str
    words: Mapping[str, str]
    marked: frozenset[str]


@dataclass(frozen=True, slots=True)
class Manual:
    """A control with the examples of its rules as they were run, and the pictures by name."""

    name: str
    shown: Mapping[str, tuple[tuple[Shown, ...], tuple[Shown, ...]]]
    pictures: Mapping[str, str]

    @property
    def control(self) -> Control:
        """The tables."""
        return CONTROLS[self.name]

    def place(self, code: str) -> str:
        """The page of a rule, seen from the folder `rules`."""
        return f"{self.name}/{code}.md"


def group_of(rule: Rule) -> str:
    """The title of the group of a rule: a control's own ones by the begin of their codes."""
    if rule.code not in _GENERAL:
        return f"Own rules: {rule.code.partition('-')[0].upper()}"
    if isinstance(rule.about, FaultKind):
        return "Characters and numbers"
    if _FACTS.match(rule.code):
        return "What a contour needs, and facts"
    return "Words, positions, programs" if rule.code in _READING else GEOMETRY


GEOMETRY = "Lines, arcs and corners"


def manuals() -> list[Manual]:
    """All controls, each with its examples run. Ends the build at one that does not say what it is for."""
    with ProcessPoolExecutor() as pool:
        return [*pool.map(manual_of, CONTROLS)]


def manual_of(name: str) -> Manual:
    """A control with its examples run, and the pictures of those that show something."""
    control, shown, pictures = CONTROLS[name], {}, dict[str, str]()
    for rule in control.catalogue:
        if not rule.accepted or not rule.rejected:
            raise SystemExit(f"{control} has no example of {rule.code}: add a gap or a slip to its examples.py")
        wrong = tuple(_shown(control, rule, text, pictures, is_right=False) for text in rule.rejected)
        shown[rule.code] = wrong, tuple(_shown(control, rule, text, pictures, is_right=True) for text in rule.accepted)
    return Manual(name, shown, pictures)


def _shown(control: Control, rule: Rule, text: str, pictures: dict[str, str], *, is_right: bool) -> Shown:
    for depth in ("verdict", "full"):  # few findings need all that is known
        result = try_example(control, rule, text, depth)
        told = next((each for each in result.diagnostics if each.code == rule.code), None)
        if is_right or told:
            break
    if (told is None) is not is_right or (is_right and result.has_errors):
        raise SystemExit(f"{control.name}: an example of {rule.code} says something else:\n{text}")
    is_drawn = result.answers and (is_right or (rule.code not in _GENERAL or group_of(rule) == GEOMETRY))
    name = f"{sha256(f'{control.name}{rule.options}{text}'.encode()).hexdigest()[:16]}.svg" if is_drawn else ""
    if name and name not in pictures:
        pictures[name] = draw_result(result).svg
    message = f"{told.message}; {told.help}" if told else ""
    words = {word.address: word.text for block in result.program.blocks for word in block.words}
    return Shown(text, message, name, words, _marked(result, told) if told else frozenset())


def _marked(result: Result, told: Diagnostic) -> frozenset[str]:
    spans = {label.span for label in told.labels}
    return frozenset(word.address for block in result.program.blocks for word in block.words if word.span in spans)


# Pages -------------------------------------------------------------------------------------------------------


def control_page(manual: Manual) -> Iterator[str]:
    """The page that leads to the words, rules, settings and assumptions of a control."""
    control, rules = manual.control, sorted(manual.control.catalogue, key=lambda rule: (group_of(rule), rule.code))
    yield f"# {control.title}\n"
    yield f"contoursolve calls it `{control.name}`. Its contours are {control.contours}.\n"
    yield f"* [Its words]({control.name}/words.md): what each means, a right block, and what goes wrong with it"
    yield "* [Alarm numbers](alarms.md) of the machine, and what they mean"
    yield f"\n## All {len(rules)} rules {{ #rules }}"
    for group, several in groupby(rules, key=group_of):
        yield f"\n### {group}\n"
        yield "| rule | what it says | severity | grade | alarm |\n|---|---|---|---|---|"
        for rule in several:
            alarm = f"{rule.alarm.number} ({rule.alarm.evidence.value})" if rule.alarm else ""
            cells = (plain(rule.title), rule.severity.value, rule.source.evidence.value, alarm)
            yield f"| [{rule.code}]({manual.place(rule.code)}) | {' | '.join(cells)} |"
    yield "\n## Settings { #settings }\n"
    yield "What the manual leaves open, and you can choose:\n"
    last = ""
    for setting in sorted(control.settings, key=lambda each: each.name in IN_ALL):  # the sort is stable
        title = "Settings that all controls have" if setting.name in IN_ALL else f"{setting.name}, a setting"
        if title != last:
            yield f"\n### {title} {{ #{setting_anchor(setting)} }}\n"
        last = title
        yield f"* **{plain(setting.meaning)}** ({plain(str(setting.source))})"
        for value, meaning in setting.values.items():
            default = ", the default" if value == setting.default else ""
            yield f"    * `--setting {control.name}.{setting.name}={value}`{default}: {plain(meaning)}"
        if setting.bounds:
            yield f"    * {plain(setting.choices(''))}"
    yield "\n## Assumptions { #assumptions }\n"
    for each in control.assumptions:
        yield f"* `{each.name}`: {plain(each.meaning)} ({plain(str(each.source))})"


def setting_anchor(setting: Setting) -> str:
    """Where a setting stands on the page of its control."""
    return "settings-of-all" if setting.name in IN_ALL else f"{setting.name}-setting"


def rule_page(manual: Manual, rule: Rule) -> Iterator[str]:
    """A rule: what it says, why, a wrong block and a right one, alarm, source and grade."""
    yield f"# {rule.code}, {manual.control.title}\n"
    yield f"[All rules](../{manual.name}.md#rules) · [Words](words.md) · {HOW_TO_READ}\n"
    yield f"{rule.severity.value.capitalize()}: {plain(rule.title)}\n"
    yield f"* What to do: {plain(rule.advice)}"
    if rule.note:
        yield f"* Good to know: {plain(rule.note)}"
    yield f"* Source: {plain(str(rule.source))}"
    if rule.alarm:
        yield f"* Alarm of the control: {rule.alarm.number} ({rule.alarm.evidence.value})"
    if rule.options:
        yield f"* These blocks are checked with `{rule.options.replace(THIS_CONTROL, manual.name)}`"
    for title, examples in zip(("Wrong", "Right"), manual.shown[rule.code], strict=True):
        for each in examples:
            yield f"\n{title}:\n"
            yield from fenced(each.text)
            if each.told:
                yield f"\n> {plain(each.told)}"
            if each.picture:
                yield f"\n![{title} block of {rule.code}](../pictures/{each.picture}){{ width=640 loading=lazy }}"
    if rule.file:
        name, _, text = rule.file.partition("\n")
        yield f"\nThe file `{name}` beside it:\n"
        yield from fenced(text)


def contour_codes(control: Control) -> list[Code]:
    """The codes that begin a contour or make a corner, if they are no words with a number."""
    codes, words = control.modes.codes.values(), control.modes.lexicon.addresses
    return [code for code in codes if code.effect in (Effect.CONTOUR, Effect.CORNER) and code.text not in words]


def words_title(control: Control) -> str:
    """The title of the page of words: with its codes, which the search finds then before all that contains them."""
    return " ".join(("words", *(code.text for code in contour_codes(control))))


def words_page(manual: Manual) -> Iterator[str]:
    """The words of a control: each with its meaning, unit, a right block, and what goes wrong with it."""
    control = manual.control
    yield f"# {control.title}: {words_title(control)}\n"
    yield f"[All rules of this control](../{manual.name}.md#rules) · {HOW_TO_READ}\n"
    yield plain(f"Numbers: {_numbers(control)} ({control.modes.lexicon.numbers.source}).")
    for row in control.modes.lexicon.addresses.values():
        yield from _word_section(manual, typed(row.address, manual), row.address, row.meaning, _kind(row, control), row)
    for code in contour_codes(control):
        yield from _word_section(manual, code.text, code.text, code.meaning, "a code of contours", code)
    yield from _variable_section(manual)


def _variable_section(manual: Manual) -> Iterator[str]:
    rule = next(rule for rule in manual.control.catalogue if rule.about is ReadIssue.VARIABLE)
    wrong, right = manual.shown[rule.code]
    is_followed = manual.control.modes.language is not None
    example = right[-1] if is_followed else wrong[0]
    name = re.findall(r"#\d+|\b[RPQ]\d{1,3}\b", example.text)[0]
    yield f"\n## {name}, a variable\n"
    value = f"Its value is that of the program, or of `--variable {name}=NUMBER`" if is_followed else plain(rule.advice)
    yield f"A number may be a variable: `{name}`. {value[0].upper()}{value[1:]}.\n"
    yield f"* What goes wrong with it: [{rule.code}](../{manual.place(rule.code)})"
    if is_followed:
        yield from _right_block(manual, rule.code, example, name)


def typed(address: str, manual: Manual) -> str:
    """An address as it is typed: with an equals sign where numbers of it need one; of RND R5, that without the 5."""
    every = [each for pair in manual.shown.values() for examples in pair for each in examples]
    word, texts = next((each.words[address] for each in every if address in each.words), ""), (e.text for e in every)
    if address.isalpha() and not word.startswith(address[:3]):
        return word.rstrip("+-.0123456789 ") or address
    name = address.partition("=")[0]
    has_sign = len(name) > 1 and any(f"{name}=" in text for text in texts)
    return address if "=" in address or not has_sign else f"{address}="


def _numbers(control: Control) -> str:
    numbers = control.modes.lexicon.numbers
    if numbers.without_point is WithoutPoint.AS_WRITTEN:
        return "one without a decimal point is in mm, or inches, as one with a point"
    return f"one without a decimal point counts steps of {numbers.mm} mm: 12 is {12 * numbers.mm} mm"


_UNITS = {Unit.MM: "mm, or inches", Unit.DEGREE: "degrees", Unit.SIGN: "its sign or its number counts"}


def _kind(row: Address, control: Control) -> str:
    """The unit of a word's number, and from where it is counted."""
    told = [_UNITS[row.unit]]
    if row.axis:
        codes = {code.effect: code.text for code in reversed(control.modes.codes.values())}
        modal = [codes.get(effect) for effect in (Effect.ABSOLUTE, Effect.INCREMENTAL)]
        by_code = f"absolute with {modal[0]}, an increment with {modal[1]}" if all(modal) else "absolute"
        told.append(f"counted along {row.axis}")
        told.append("an increment" if row.is_increment else "absolute" if row.is_absolute else by_code)
        if row.axis == "X" and control.diameter is not None:
            told.append("a diameter or a radius, as the program or a setting says")
        elif row.is_diameter:
            told.append("a diameter")
    return "; ".join(told)


def _word_section(
    manual: Manual, name: str, address: str, meaning: str, kind: str, row: Address | Code
) -> Iterator[str]:
    short = re.split("[:;,]", meaning)[0]  # in the title, where the search looks first
    title = f"{name}, {plain(short)}" if len(short.split()) <= SHORT else name
    title = f"{name}, {name}0" if re.search("(?:^|[,;] )0 ", meaning) else title
    yield f"\n## {title} {{ #{re.sub('[^a-z0-9]+', '-', name.lower()).strip('-') or 'word'}-word }}\n"
    yield f"`{name}`: {plain(meaning)}\n"
    yield f"* Unit: {plain(kind)}{_signed(manual, address, row)}"
    yield f"* Source: {plain(str(row.source))}"
    where, is_code = re.compile(rf"(?<![\w,#]){re.escape(name)}(?![A-Za-z])"), isinstance(row, Code)
    touching = [each for each in manual.control.settings if where.search(f"{each.meaning} {' '.join(each.values)}")]
    if touching:
        place = f"../{manual.name}.md"
        told = (f"[{each.name}]({place}#{setting_anchor(each)}) ({plain(each.meaning)})" for each in touching)
        yield f"* Settings: {', '.join(told)}"
    wrong = [
        code
        for code, (examples, _) in manual.shown.items()
        if any(address in each.marked or (is_code and code.startswith(address.lower())) for each in examples)
    ]
    if wrong:
        links = ", ".join(f"[{code}](../{manual.place(code)})" for code in sorted(wrong))
        yield f"* What goes wrong with it: {links}"
    right = sorted(
        (
            (each, code)
            for code, (_, examples) in manual.shown.items()
            for each in examples
            if address in each.words or ((is_code or len(name) > 1) and where.search(each.text))
        ),
        key=lambda shown: (not shown[0].picture, len(shown[0].text), shown[0].text),
    )
    if right:
        yield from _right_block(manual, right[0][1], right[0][0], name)
    elif any(code in wrong for code in ("word-idle", "word-unused")):
        yield "\nNo contour of this control uses it: contoursolve reads it, and warns where it says nothing."
    else:
        raise SystemExit(f"{manual.name} has no right block with {name}: add one to `right` in its examples.py")


def _signed(manual: Manual, address: str, row: Address | Code) -> str:
    """Of a length along no axis that may be negative: such a word."""
    if isinstance(row, Code) or row.axis or row.unit is not Unit.MM:
        return ""
    right = (each.words.get(address, "") for _, examples in manual.shown.values() for each in examples)
    word = next((each for each in right if "-" in each), "")
    return f"; with a sign, as in `{word}`" if word else ""


def _right_block(manual: Manual, code: str, right: Shown, name: str) -> Iterator[str]:
    rule = next(rule for rule in manual.control.catalogue if rule.code == code)
    with_options = f", with `{rule.options.replace(THIS_CONTROL, manual.name)}`" if rule.options else ""
    yield f"\nRight{with_options}:\n"
    yield from fenced(right.text)
    if right.picture:
        yield f"\n![A right block with {name}](../pictures/{right.picture}){{ width=640 loading=lazy }}"


def alarms_page(all_manuals: list[Manual]) -> Iterator[str]:
    """The alarm numbers of all machines, each with what contoursolve says of it."""
    yield "# Alarm numbers\n"
    yield "Look for the number that your machine shows. `contoursolve explain NUMBER` says the same in the terminal."
    yield "[How to read these pages](index.md#how-to-read) tells what `<word>` and `(assumed)` mean.\n"
    places = {manual.name: manual for manual in all_manuals}
    rows: dict[str, list[str]] = {}
    known: dict[str, dict[str, None]] = {manual.name: {} for manual in all_manuals}
    for row in alarm_rows(CONTROLS.values()):
        manual = places[row.control]
        told = f"[{row.rule.code}]({manual.place(row.rule.code)})" if row.rule.code in manual.shown else row.rule.code
        line = f"* {manual.control.title}, {plain(row.alarm.number)} ({row.alarm.evidence.value}): {told}, "
        for number in row.numbers:
            known[row.control][plain(number)] = None
            rows.setdefault(number, []).append(line + plain(row.rule.title))
    yield "## Which alarm numbers are here?\n"
    yield "Is your number not here, such as one about `,C` or `,R`?"
    yield "`contoursolve check PROGRAM` names the wrong word without the number.\n"
    yield "| control | alarm numbers |\n|---|---|"
    for control, numbers in known.items():
        told = ", ".join(sorted(numbers, key=by_number)) or "none that we know"
        yield f"| [{places[control].control.title}]({control}.md) | {told} |"
    for number in sorted(rows, key=by_number):
        is_newer = len(number) == len("055") and any("Fanuc" in line for line in rows[number])
        yield f"\n## {number}{f', PS{number:0>4}' if is_newer else ''}\n"
        yield from dict.fromkeys(rows[number])


def by_number(number: str) -> tuple[bool, int, str]:
    """The order of alarm numbers."""
    return not number.isdigit(), len(number), number


def fenced(text: str) -> Iterator[str]:
    """A block of a program."""
    yield "````text"
    yield from (line if len(line) <= LONGEST else f"{line[:LONGEST]} ..." for line in text.rstrip("\n").split("\n"))
    yield "````"


def plain(text: str) -> str:
    """Text of the tables as text of a page, whose gaps `<word>` are no HTML."""
    return re.sub(r"([\\`*_\[\]|#])", r"\\\1", escape(text, quote=False))
