"""Every row of every control's catalogue proves itself, in the words of that control."""

import re
from collections import defaultdict

import pytest

from contoursolve.controls import CONTROLS
from contoursolve.gcode import FaultKind
from contoursolve.reading import ArcIssue, ReadIssue
from contoursolve.solving import NoteKind, RefusalKind
from contoursolve.try_examples import try_example

ALARMS = {
    "yasnac-lx3": {"050", "144", "145", "146"},
    "nct-99m": {"3011", "3012", "3014", "3017", "3081", "3084"},
    "fanuc-lathe": {
        *("020", "022", "028", "039", "050", "051", "052", "053", "054", "055", "056", "057", "058", "065", "212")
    },
    "fanuc-mill": {"020", "022", "028", "039", "050", "051", "052", "053", "054", "055"},
    "mitsubishi": {"P33", "P70", "P71", "P382", "P383", "P392", "P393", "P394", "P395", "P396", "P397"},
    "siemens-840d": {"10790", "10791", "10792", "10793", "10794", "10795", "14040"},
    "siemens-808d": {"10790", "10791", "10792", "10793", "10794", "10795", "14040"},
    "heidenhain": {"402-0008", "402-0009"},
    "isg": {*("20012", "20034", "20036", "20130", "20351", "21024", "21758", "21892", "21895", "21904", "21910")},
}
"""The alarm numbers on the pages that we have; no other may be invented."""

RULES = {(name, rule.code): rule for name, control in CONTROLS.items() for rule in control.catalogue}
EXAMPLES = defaultdict[tuple[str, str, str, str], dict[str, bool]](dict)
"""The rules that each example is about, and whether it is right for them. Many a right one is that of several rules."""

for (name, code), rule in RULES.items():
    for is_right, programs in ((False, rule.rejected), (True, rule.accepted)):
        for program in programs:
            EXAMPLES[name, rule.options, rule.file, program][code] = is_right


def label_of(name, codes):
    """The first rule of an example that is wrong for one, or else of all."""
    return f"{name}-{next((code for code in codes if not codes[code]), next(iter(codes)))}"


@pytest.mark.parametrize(
    ("name", "program", "codes"),
    [pytest.param(name, program, codes, id=label_of(name, codes)) for (name, _, _, program), codes in EXAMPLES.items()],
)
def test_an_example_says_what_its_control_says(name, program, codes):
    control = CONTROLS[name]
    result = try_example(control, RULES[name, next(iter(codes))], program)
    found = {each.code for each in result.diagnostics}
    assert {code: code not in found for code in codes} == codes
    assert not (all(codes.values()) and result.has_errors)
    assert found <= {each.code for each in control.catalogue}
    for each in result.diagnostics:
        # Line 0 is the start point that an option states.
        line = program.split("\n")[each.span.line - 1] if each.span.line else "X" * each.span.end_column
        assert 1 <= each.span.column < each.span.end_column <= max(len(line), 1) + 1
        assert not set("{}\n") & set(each.message + each.help)
        assert "None" not in each.message + each.help
        assert unwritten(each) == []


ASKED = re.compile(r"write (,?[A-FH-Z]-?\d[\d.]*+|-?\d[\d.]*+ deg)(?! if that is meant)")
"""What a help tells to write, unless it asks whether that is meant."""

NUMBER = re.compile(r"-?\d+\.?\d*")


def unwritten(finding):
    """What the help of a finding with fixes tells to write, and no fix writes."""
    told = ASKED.findall(finding.help) if finding.fixes else []
    written = {float(each) for fix in finding.fixes for each in NUMBER.findall(fix.replacement)}
    return [each for each in told if float(NUMBER.search(each)[0]) not in written]


@pytest.mark.parametrize("control", CONTROLS)
def test_every_rule_has_one_code_and_examples_of_both_kinds_and_no_alarm_is_invented(control):
    rules = [rule.told for rule in CONTROLS[control].rules if not rule.absent]
    assert [rule.code for rule in rules if not (rule.accepted and rule.rejected)] == []
    codes = [rule.code for rule in CONTROLS[control].rules]
    assert sorted(codes) == sorted(set(codes))
    assert {rule.alarm.number.split()[0] for rule in rules if rule.alarm} <= ALARMS.get(control, set())


GRADES = {
    "g111-parallel": "derived",
    "g111-reversed": "derived",
    "g111-corner-2-with-three": "assumed",
    "g111-corner-2-without-b": "derived",
}
"""What the sheet of the control says of rows that once claimed more."""

PRINTED_ALARMS = {
    *("g11-both-axes", "g112-m-s-t", "g112-c-and-p", "g112-d-and-q"),
    *("g112-missed", "g112-reversed", "g112-bevel-band"),
}
"""Of the LX3: what Table 2.44 lists (p. 146), and error 050 (p. 31-32)."""


def test_grades_are_those_of_the_sheet():
    rules = {code: rule for (control, code), rule in RULES.items() if control == "yasnac-lx3"}
    assert {code: rules[code].source.evidence.value for code in GRADES} == GRADES
    graded = {code: rule.alarm.evidence.value for code, rule in rules.items() if rule.alarm}
    assert {code for code, grade in graded.items() if grade == "printed"} == PRINTED_ALARMS
    assert set(graded.values()) == {"printed", "assumed"}


def test_nothing_cites_a_page_that_has_not_been_seen():
    for control in CONTROLS.values():
        sources = [rule.source for rule in control.rules]
        sources += [each.source for each in (*control.settings, *control.assumptions)]
        sources += [each.source for each in control.modes.lexicon.addresses.values()]
        sources += [each.source for each in control.modes.codes.values()]
        assert not [each for each in sources if "138" in each.place and "LX3" in each.manual]


def test_every_event_has_a_row_in_every_control_that_it_can_happen_in():
    """A finding without a row would be a crash; events that only one control knows are in one table."""
    for kind in (FaultKind, ReadIssue, RefusalKind, NoteKind, ArcIssue):
        assert not set(kind) - {rule.about for control in CONTROLS.values() for rule in control.rules}
