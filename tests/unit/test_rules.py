"""Every row of the catalogue proves itself: its rejected examples raise it, its accepted ones do not."""

import pytest
from examples import some_of

from contoursolve import Result, UnknownControlError
from contoursolve.api import follow_program, parse
from contoursolve.controls import DIALECTS
from contoursolve.controls.geometry_rules import GEOMETRY_RULES

WITHOUT_REJECTED_EXAMPLE = {
    "move-in-increments": "check --strict alone tells it; test_command_line.py asks for it",
    "subprogram-refused": "it is about another file; test_subprograms.py writes one",
    "subprogram-solved": "it is about another file; test_subprograms.py writes one",
    "control-called": "it is about another file; test_subprograms.py writes one",
    "not-verified": "an answer that fails its own equations is an error of contoursolve; no block is known to cause it",
    "heidenhain-first-taken": "a setting asks for it; test_free_contours.py sets it",
    "cnc-pilot-angle-redundant": "a setting forbids it; test_cnc_pilot.py sets it",
    "cnc-pilot-selection": "Q is 0 or 1, and of two solutions either is there",
    "fanuc-angle-redundant": "a setting forbids it; test_fanuc.py sets it",
    "fanuc-corner-straight": "a setting refuses it; test_fanuc.py sets it",
    "haas-corner-straight": "the same",
    **{
        f"haas-{code}": "a setting allows corners beside arcs; test_fanuc.py sets it"
        for code in ("center-and-radius", "circle-undefined", "radius-without-end")
    },
    "mitsubishi-corner-arc": "a setting forbids it; test_mitsubishi.py sets it",
    "mitsubishi-chamfer-along-arc": "the same",
    "mitsubishi-h-missing": "the same",
    "mitsubishi-centre-of-diameter": "the same",
    "mitsubishi-centre-from-end": "the same",
    "fanuc-chamfer-along-arc": "a setting forbids it; test_fanuc.py sets it",
    "fanuc-angle-supplementary": "the same",
    "siemens-chamfer-along-arc": "a setting forbids it; test_siemens.py sets it",
    "siemens-closing-increment": "the same",
    "count-open": "two forms of one block each: every fact about them leads to a closed form or a search that ends",
    "arc-radius-differs": "an arc is looked at where a rule refuses it; test_robust.py lets the rules warn only",
    "start-diameter": "the start point is stated apart from the program; test_siemens.py has it",
    "start-units": "the start point is stated apart from the program; test_command_line.py has it",
    "word-unused": "where the rules are enforced, one of them names the word; test_lathe.py switches them off",
    "only-unproven": "the same; test_completeness.py gives a search up",
    "search-unfinished": "the same; test_solutions.py has sketches whose search does not end",
}

ALARMS = {
    "yasnac-lx3": {"050", "144", "145", "146"},
    "nct-99m": {"3011", "3012", "3014", "3017", "3081", "3084"},
    "fanuc-lathe": {"039", "050", "051", "052", "053", "054", "055", "056", "057", "058", "212"},
    "fanuc-mill": {"039", "050", "051", "052", "053", "054", "055"},
    "haas-lathe": set(),
    "haas-mill": set(),
    "mitsubishi": {"P33", "P392", "P393", "P394", "P395", "P396", "P397"},
    "siemens-840d": {"10790", "10791", "10792", "10793", "10794", "10795", "14040"},
    "siemens-808d": {"10790", "10791", "10792", "10793", "10794", "10795", "14040"},
    "heidenhain": {"402-0008", "402-0009"},
    "isg": {"21892", "21895", "21904", "21910", "20012", "20130", "20351"},
}
"""The alarm numbers on the pages that we have; no other may be invented."""

SHARED = {id(rule) for rule in DIALECTS["yasnac-lx3"].rules} & {id(rule) for rule in DIALECTS["nct-99m"].rules}
GENERAL = {id(rule) for rule in GEOMETRY_RULES}
"""Rows of any control that has none of its own about the same; test_own_control.py proves them."""
RULES = {
    (name, rule.code): rule for name, dialect in DIALECTS.items() for rule in dialect.rules if id(rule) not in GENERAL
}


def examples(kind):
    """(control, code, program); the rows that all controls share once, with the control that the words show."""
    shared = {id(rule): rule for rule in RULES.values() if id(rule) in SHARED}
    rows = [(None, "common", rule) for rule in shared.values()]
    rows += [(control, control, rule) for (control, _), rule in RULES.items() if id(rule) not in SHARED]
    return [
        pytest.param(control, rule.code, program, id=f"{name}-{rule.code}-{number}")
        for control, name, rule in rows
        for number, program in enumerate(getattr(rule, kind), 1)
    ]


def examine(program: str, control: str | None) -> Result:
    """The control of a common row's example is the one that its words show, else the lathe."""
    try:
        result = read_all(program, control)
    except UnknownControlError as error:
        return read_all(program, error.choices[0])
    is_told = result.control or any(each.code == "control-unknown" for each in result.diagnostics)
    return result if is_told else read_all(program, "yasnac-lx3")


def read_all(program: str, control: str | None) -> Result:
    """With the findings about every line."""
    return follow_program(parse(program), control=control, strict=True).collect()


@some_of(("control", "code", "program"), examples("rejected"), one_in=3)
def test_rejected_example_raises_its_code(control, code, program):
    found = examine(program, control).diagnostics
    assert code in {each.code for each in found}
    for each in found:
        line = program.split("\n")[each.span.line - 1]
        assert 1 <= each.span.column < each.span.end_column <= max(len(line), 1) + 1
        assert not set("{}") & set(each.message + each.help)
        assert "None" not in each.message + each.help
        assert "\n" not in each.message


@some_of(("control", "code", "program"), examples("accepted"), one_in=3)
def test_accepted_example_raises_no_error_and_not_its_code(control, code, program):
    result = examine(program, control)
    assert code not in {each.code for each in result.diagnostics}
    assert not result.has_errors


def test_every_rule_has_examples_of_both_kinds():
    assert {code for (_, code), rule in RULES.items() if not rule.accepted} == set()
    assert {code for (_, code), rule in RULES.items() if not rule.rejected} == set(WITHOUT_REJECTED_EXAMPLE)


def test_every_rule_has_one_code_in_its_control():
    for dialect in DIALECTS.values():
        codes = [rule.code for rule in dialect.rules]
        assert sorted(codes) == sorted(set(codes))


def test_no_alarm_number_is_invented():
    for (control, _), rule in RULES.items():
        assert rule.alarm is None or rule.alarm.number.split()[0] in ALARMS[control]


GRADES = {
    "g111-parallel": "derived",
    "g111-reversed": "derived",
    "g111-corner-2-with-three": "assumed",
    "g111-corner-2-without-b": "derived",
}
"""What the sheet of the control says of rows that once claimed more."""

PRINTED_ALARMS = {"g11-both-axes", "g112-m-s-t", "g112-c-and-p", "g112-d-and-q"} | {
    "g112-missed",
    "g112-reversed",
    "g112-bevel-band",
}
"""Of the LX3: what Table 2.44 lists (p. 146), and error 050 (p. 31-32)."""


def test_grades_are_those_of_the_sheet():
    rules = {code: rule for (control, code), rule in RULES.items() if control == "yasnac-lx3"}
    assert {code: rules[code].source.evidence.value for code in GRADES} == GRADES
    graded = {code: rule.alarm.evidence.value for code, rule in rules.items() if rule.alarm}
    assert {code for code, grade in graded.items() if grade == "printed"} == PRINTED_ALARMS
    assert set(graded.values()) == {"printed", "assumed"}


def test_nothing_cites_a_page_that_has_not_been_seen():
    for dialect in DIALECTS.values():
        sources = [rule.source for rule in dialect.rules]
        sources += [each.source for each in (*dialect.settings, *dialect.assumptions)]
        sources += [each.source for each in dialect.modes.lexicon.addresses.values()]
        sources += [each.source for each in dialect.modes.codes.values()]
        assert not [each for each in sources if "138" in each.place and "LX3" in each.manual]


def test_every_event_has_a_row_in_every_control_that_it_can_happen_in():
    """A finding without a row would be a crash; events that only one control knows are in one table."""
    common = {rule.about for rule in RULES.values() if id(rule) in SHARED and rule.about}
    for kind in {type(about) for about in common}:
        missing = set(kind) - {rule.about for rule in RULES.values()}
        assert not missing
