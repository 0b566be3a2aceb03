"""The arcs of each control: how it reads them outside contours, how exact it wants them, and its rows and settings."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from msgspec import Struct

from contoursolve.controls.arc_rules import (
    POLAR,
    ArcExamples,
    ArcRows,
    assumed,
    both_setting,
    centres_setting,
    in_codes,
    negative_radius_setting,
    no_centre_setting,
    number_of_arcs,
    off_arc_setting,
    printed,
    radius_difference_setting,
    remember_polar,
)
from contoursolve.controls.control_settings import setting
from contoursolve.diagnostics import Alarm, Evidence, Source
from contoursolve.reading import ArcIssue, ArcTable, Beyond, BothStated, Dialect, Setting, State
from contoursolve.tolerance import CIRCLE_DEVIATION


class ArcFacts(Struct, frozen=True):
    """The arcs of one control: its table, its rows, and its settings besides those that it has."""

    table: ArcTable
    rows: ArcRows
    settings: tuple[Setting, ...]


def reading_arcs(dialect: Dialect, **own: Any) -> Dialect:
    """A control that reads arcs outside contours as its facts say, and as fields of its table do."""
    facts = ARC_FACTS[dialect.name]
    remember = dialect.modes.remember or (remember_polar if facts.table.others else None)
    return replace(
        dialect,
        modes=replace(dialect.modes, arcs=replace(facts.table, **own), remember=remember),
        rules=(*dialect.rules, *facts.rows.rules()),
        settings=(*dialect.settings, *facts.settings),
    )


def _alarm(number: str, *, is_printed: bool = True) -> Alarm:
    return Alarm(number, Evidence.PRINTED if is_printed else Evidence.ASSUMED)


_ON_MILL = in_codes("G17 G90 G21\nG00 X0 Y0\nG01 X0 Y0 F200.\n", "XY", "IJ")
_ON_LATHE = in_codes("G00 X40. Z0.\nG01 Z0. F0.2\n", "ZX", "KI", at=(0, 40), halved=2)

# Fanuc and Haas --------------------------------------------------------------------------------------------------

_LIST, _MANUAL = "FANUC alarm list", "FANUC 16/18/160/180-C lathe operator's manual"
_FANUC = ArcTable(both=BothStated.RADIUS_COUNTS, is_still=True, others=frozenset({POLAR}))
_RADII = assumed(_LIST, "alarm 020: parameter 3410 says how much is allowed")
_FANUC_SETTINGS = (
    radius_difference_setting(assumed("FANUC parameter 3410", "its value is one of each machine"), least="0"),
    off_arc_setting(printed(_MANUAL, "an arc, then a line; the alarm list: a spiral, for another series")),
    no_centre_setting(assumed("FANUC parameter 3403, bit 5", "recalled")),
    centres_setting(assumed("FANUC lathes and mills", "centres count from the start")),
)
_FANUC_ISSUES: dict[ArcIssue, tuple[Source, Alarm | None]] = {
    ArcIssue.RADII_DIFFER: (_RADII, _alarm("020 OVER TOLERANCE OF RADIUS")),
    ArcIssue.SPIRAL: (_RADII, None),
    ArcIssue.RADIUS_SMALL: (assumed(_LIST, "arcs by R: no alarm is printed for it"), None),
    ArcIssue.MOVES_NOTHING: (printed(_MANUAL, "circular interpolation: an arc of 0 deg"), None),
    ArcIssue.UNDEFINED: (printed(_LIST, "alarm 022"), _alarm("022 R OR I,J,K COMMAND NOT FOUND")),
    ArcIssue.RUNS_LINE: (assumed("FANUC parameter 3403, bit 5", "recalled"), None),
    ArcIssue.OUTSIDE_PLANE: (printed(_LIST, "alarm 028"), _alarm("028 ILLEGAL PLANE SELECT")),
    ArcIssue.EMPTY: (assumed(_LIST, "circular interpolation: not described"), None),
}
_OPTIONS = {
    ArcIssue.SPIRAL: "--set CONTROL.radius-difference=0",
    ArcIssue.RUNS_LINE: "--set CONTROL.no-centre=line",
    ArcIssue.OVER_HALF: "--set CONTROL.negative-radius=error",
}
_LINES_RUN = {ArcIssue.UNDEFINED: "a parameter lets older sets run a straight line"}
_065 = _alarm("065")
_OF_PROFILES: dict[ArcIssue, tuple[Source, Alarm | None]] = {
    ArcIssue.PROFILE_ARC: (Source(_LIST, "alarm 065: that an arc causes it", Evidence.DERIVED), _065),
    ArcIssue.PROFILE_CODE: (printed(_LIST, "alarm 065: its first block without G00 or G01"), _065),
}
_OVER = {ArcIssue.OVER_HALF: (printed(_MANUAL, "circular interpolation: by R less than 180 deg"), None)}
_FANUC_MILL_ISSUES = {**_FANUC_ISSUES, ArcIssue.MOVES_NOTHING: (assumed(_MANUAL, "that mills do so, too"), None)}

_HAAS = "Haas operator's manual"
_HAAS_ISSUES: dict[ArcIssue, tuple[Source, Alarm | None]] = {
    ArcIssue.RADII_DIFFER: (assumed(_HAAS, "G02, G03: 0.0010 inch is allowed"), None),
    ArcIssue.RADIUS_SMALL: (assumed(_HAAS, "G02, G03: R"), None),
    ArcIssue.FULL_BY_RADIUS: (assumed(_HAAS, "G02, G03: R"), None),
    ArcIssue.UNDEFINED: (assumed(_HAAS, "G02, G03: I, J, K or R"), None),
    ArcIssue.BOTH: (assumed(_HAAS, "G02, G03: not described"), None),
    ArcIssue.OUTSIDE_PLANE: (assumed(_HAAS, "G17, G18, G19"), None),
    ArcIssue.EMPTY: (assumed(_HAAS, "G02, G03: not described"), None),
}
_HAAS_TABLE = ArcTable(both=BothStated.AGREES, others=frozenset({POLAR}))
_HAAS_SETTINGS = (
    radius_difference_setting(assumed(_HAAS, "0.0010 inch or 0.01 mm")),
    both_setting(assumed(_HAAS, "not described")),
    centres_setting(printed(_HAAS, "G02, G03: I, J, K count from the start")),
)


def _lathe(table: ArcTable) -> ArcTable:
    """The table of a lathe, whose other planes have axes that are not followed."""
    return replace(table, planes=frozenset({"G18"}))


# SINUMERIK and ISG -----------------------------------------------------------------------------------------------

_SIEMENS = "SINUMERIK NC programming manual"
_14040 = _alarm("14040 (error in the end point of a circle)")
_SIEMENS_FACTS = ArcFacts(
    ArcTable(share=0.001, both=BothStated.AGREES, opening="AR", through="CIP", beside=frozenset({"TURN"})),
    ArcRows(
        {
            ArcIssue.RADII_DIFFER: (printed("SINUMERIK alarm 14040", "machine data 21000 and 21010"), _14040),
            ArcIssue.RADIUS_SMALL: (assumed(_SIEMENS, "CR: no alarm is printed for it"), None),
            ArcIssue.FULL_BY_RADIUS: (printed("SINUMERIK alarm 14040", "cause 1"), _14040),
            ArcIssue.UNDEFINED: (assumed(_SIEMENS, "circular interpolation"), None),
            ArcIssue.BOTH: (assumed(_SIEMENS, "a form with both is printed; no word on a clash"), None),
            ArcIssue.OUTSIDE_PLANE: (assumed(_SIEMENS, "G17, G18, G19"), None),
            ArcIssue.EMPTY: (assumed(_SIEMENS, "circular interpolation"), None),
            ArcIssue.OPENING: (assumed(_SIEMENS, "AR, the opening angle: its range is recalled"), None),
            ArcIssue.IN_LINE: (Source(_SIEMENS, "CIP: three points in line are on no circle", Evidence.DERIVED), None),
        },
        in_codes("G17 G90 G71\nG0 X0 Y0\nG1 X0 Y0 F200\n", "XY", "IJ", "CR="),
        wrong={ArcIssue.OPENING: "G02 X20. Y0. AR=400.", ArcIssue.IN_LINE: "CIP X20. Y0. I1=10. J1=0."},
        is_by_agreement=True,
    ),
    (
        radius_difference_setting(assumed("SINUMERIK machine datum 21000", "CIRCLE_ERROR_CONST, value recalled")),
        number_of_arcs(
            "radius-difference-factor",
            "the share of the radius by which the radii of an arc may differ, where that is more",
            "0.001",
            assumed("SINUMERIK machine datum 21010", "CIRCLE_ERROR_FACTOR, value recalled"),
            "1",
            "",
        ),
        both_setting(assumed(_SIEMENS, "a form with both is printed; no word on a clash")),
        centres_setting(printed(_SIEMENS, "circular interpolation: I, J, K count from the start")),
    ),
)

_ISG = "ISG kernel, programming manual"
G161, G164, G165 = "G161", "G164", "G165"
"""Names of what stays in force: centres as coordinates; no correction of centres, and the correction."""


def _isg_in_force(table: ArcTable, state: State) -> ArcTable:
    """The table where G161, G164 or G165 is in force."""
    if G161 in state.memory:
        table = replace(table, counts_from_origin=True)
    if G165 in state.memory:
        return replace(table, beyond=Beyond.MOVES_CENTRE, issue=ArcIssue.RADII_DIFFER)
    if G164 not in state.memory and table.beyond is Beyond.MOVES_CENTRE:
        return table
    return replace(table, beyond=Beyond.REFUSES, issue=ArcIssue.RADII_UNCORRECTED, difference=0.005, share=0.0001)


def _uncorrected(dialect: Dialect) -> Dialect:
    arcs = replace(ISG_FACTS.table, beyond=Beyond.REFUSES)
    return replace(dialect, modes=replace(dialect.modes, arcs=arcs))


_MOVED = printed("ISG kernel, channel parameters", "P-CHAN-00059 and P-CHAN-00060")
ISG_FACTS = ArcFacts(
    ArcTable(
        beyond=Beyond.MOVES_CENTRE,
        needs_end=False,
        has_pitch=True,
        shift=2.0,
        shift_share=0.05,
        in_force=_isg_in_force,
    ),
    ArcRows(
        {
            ArcIssue.RADII_DIFFER: (_MOVED, None),
            ArcIssue.RADII_UNCORRECTED: (printed(_ISG, "G164; P-CHAN-00171 and P-CHAN-00172"), _alarm("21758")),
            ArcIssue.CENTRE_MOVES: (_MOVED, None),
            ArcIssue.RADIUS_SMALL: (assumed(_ISG, "circular interpolation: not described"), None),
            ArcIssue.FULL_BY_RADIUS: (printed(_ISG, "error 20034"), _alarm("20034")),
            ArcIssue.UNDEFINED: (assumed(_ISG, "circular interpolation; error 20036 is printed for G164"), None),
            ArcIssue.BOTH: (printed(_ISG, "error 21024, newer 22159"), _alarm("21024")),
            ArcIssue.OUTSIDE_PLANE: (assumed(_ISG, "G17, G18, G19"), None),
            ArcIssue.EMPTY: (assumed(_ISG, "circular interpolation"), None),
        },
        in_codes("G17 G90 G71\nG0 X0 Y0\nG1 X0 Y0 F200\n", "XY", "IJ"),
        differs=30,
        before={ArcIssue.RADII_UNCORRECTED: "G164\n"},
    ),
    (
        setting(
            "centre-correction",
            "whether the control moves a centre that is not as far from both ends, before the program says it",
            {"on": "it does: G165", "off": "it does not: G164"},
            printed(_ISG, "G165 is the initial state"),
            {"off": _uncorrected},
        ),
        number_of_arcs("centre-shift", "by how much a centre is moved", "2", _MOVED, "100"),
        number_of_arcs(
            "centre-shift-share", "by which share of the radius a centre is moved", "5", _MOVED, "100", "percent"
        ),
        centres_setting(printed(_ISG, "G162 is the initial state")),
    ),
)

# The others ------------------------------------------------------------------------------------------------------

_NCT = "NCT 99M/2000M Programmer's Manual"
_3012, _3014 = _alarm("3012 ERRONEOUS CIRCLE DEF. R"), _alarm("3014 ERRONEOUS CIRCLE DEF.")
_NCT_FACTS = ArcFacts(
    ArcTable(others=frozenset({POLAR})),
    ArcRows(
        {
            ArcIssue.RADII_DIFFER: (
                assumed(_NCT, "p. 26 (4.3): alarm 3011; the allowed difference is a machine parameter"),
                _alarm("3011 RADIUS DIFFERENCE"),
            ),
            ArcIssue.RADIUS_SMALL: (Source(_NCT, "p. 25: R; no alarm is printed for it", Evidence.DERIVED), None),
            ArcIssue.FULL_BY_RADIUS: (printed(_NCT, "p. 26 (4.3): alarm 3012, end equals start"), _3012),
            ArcIssue.UNDEFINED: (printed(_NCT, "p. 26 (4.3): alarm 3014"), _3014),
            ArcIssue.BOTH: (printed(_NCT, "16.3.3, p. 129"), None),
            ArcIssue.OUTSIDE_PLANE: (printed(_NCT, "p. 26 (4.3): alarm 3014"), _3014),
            ArcIssue.EMPTY: (assumed(_NCT, "p. 26 (4.3): not described"), None),
        },
        _ON_MILL,
        # With both coordinates of its end it begins in an intersection.
        wrong={ArcIssue.BOTH: "G02 X20. I10. J0. R12."},
    ),
    (centres_setting(printed(_NCT, "p. 25: centres count from the start")),),
)

_MITSUBISHI = "Mitsubishi M700V/M70V programming manual"
_P33, _P70 = (_alarm(each, is_printed=False) for each in ("P33 (format error)", "P70 (end point deviation of an arc)"))
_P71 = _alarm("P71 (centre of an arc cannot be calculated)", is_printed=False)
_MITSUBISHI_FACTS = ArcFacts(
    replace(_FANUC, is_still=False),
    ArcRows(
        {
            ArcIssue.RADII_DIFFER: (assumed(_MITSUBISHI, "parameter 1084 says how much is allowed"), _P70),
            ArcIssue.RADIUS_SMALL: (assumed(_MITSUBISHI, "arcs by R"), _P71),
            ArcIssue.FULL_BY_RADIUS: (assumed(_MITSUBISHI, "arcs by R"), _P70),
            ArcIssue.UNDEFINED: (assumed(_MITSUBISHI, "circular interpolation"), _P33),
            ArcIssue.RUNS_LINE: (assumed(_MITSUBISHI, "parameter 11029"), None),
            ArcIssue.OUTSIDE_PLANE: (assumed(_MITSUBISHI, "G17, G18, G19"), None),
            ArcIssue.EMPTY: (assumed(_MITSUBISHI, "circular interpolation"), None),
        },
        _ON_MILL,
        options=_OPTIONS,
        notes={ArcIssue.UNDEFINED: "a parameter makes it a straight line"},
    ),
    (
        radius_difference_setting(assumed(_MITSUBISHI, "parameter 1084")),
        no_centre_setting(assumed(_MITSUBISHI, "parameter 11029")),
        centres_setting(assumed(_MITSUBISHI, "centres count from the start")),
    ),
)

_YASNAC = "YASNAC LX3 Instruction Manual"
_RELATIVE = Source("YASNAC PC NC programming manual", "p. 2-5 to 2-9, a relative of the control", Evidence.DERIVED)
_ARCS_LX3 = assumed(_YASNAC, "circular interpolation: not on the pages that we have")
_YASNAC_FACTS = ArcFacts(
    _lathe(ArcTable(beyond=Beyond.SPIRAL, both=BothStated.AGREES)),
    ArcRows(
        {
            ArcIssue.SPIRAL: (_RELATIVE, None),
            ArcIssue.RADIUS_SMALL: (_ARCS_LX3, None),
            ArcIssue.FULL_BY_RADIUS: (_ARCS_LX3, None),
            ArcIssue.UNDEFINED: (_ARCS_LX3, None),
            ArcIssue.BOTH: (_ARCS_LX3, None),
            ArcIssue.OUTSIDE_PLANE: (_ARCS_LX3, None),
            ArcIssue.EMPTY: (_ARCS_LX3, None),
        },
        _ON_LATHE,
        is_by_agreement=True,
    ),
    (
        radius_difference_setting(assumed(_YASNAC, "circular interpolation; our choice")),
        both_setting(_ARCS_LX3),
        centres_setting(_RELATIVE),
    ),
)


def _in_klartext(
    first: float, second: float, center: tuple[float, float] | None, radius: float | None, more: str
) -> str:
    end = f"X{first:+g} Y{second:+g}"
    if radius is not None:
        return f"2 CR {end} R{radius:+g} DR- {more}".rstrip()
    about = "" if center is None else f"2 CC X{center[0]:+g} Y{center[1]:+g}\n"
    return f"{about}3 C {end} DR- {more}".rstrip()


_TNC = "HEIDENHAIN TNC user's manuals"
_HEIDENHAIN_ISSUES: dict[ArcIssue, tuple[Source, Alarm | None]] = {
    ArcIssue.RADII_DIFFER: (printed(_TNC, "TNC 320 p. 155: at most 0.016 mm"), None),
    ArcIssue.RADIUS_SMALL: (assumed(_TNC, "CR: not described"), None),
    ArcIssue.FULL_BY_RADIUS: (printed(_TNC, "CR: two half circles make a full one"), None),
    ArcIssue.UNDEFINED: (printed(_TNC, "C: a centre CC stands before it"), None),
    ArcIssue.EMPTY: (assumed(_TNC, "not described"), None),
}

ARC_FACTS: Mapping[str, ArcFacts] = {
    "fanuc-lathe": ArcFacts(
        _lathe(_FANUC),
        ArcRows({**_FANUC_ISSUES, **_OVER, **_OF_PROFILES}, _ON_LATHE, options=_OPTIONS, notes=_LINES_RUN),
        (
            *_FANUC_SETTINGS,
            negative_radius_setting(printed(_MANUAL, "circular interpolation: under 180 deg on 16/18-C")),
        ),
    ),
    "fanuc-mill": ArcFacts(
        _FANUC, ArcRows(_FANUC_MILL_ISSUES, _ON_MILL, options=_OPTIONS, notes=_LINES_RUN), _FANUC_SETTINGS
    ),
    "haas-lathe": ArcFacts(
        _lathe(_HAAS_TABLE),
        ArcRows(
            {**_HAAS_ISSUES, ArcIssue.PROFILE_ARC: (assumed(_HAAS, "G71, G72: no page seen"), None)},
            _ON_LATHE,
            warns_of=frozenset({ArcIssue.PROFILE_ARC}),
            is_by_agreement=True,
        ),
        _HAAS_SETTINGS,
    ),
    "haas-mill": ArcFacts(_HAAS_TABLE, ArcRows(_HAAS_ISSUES, _ON_MILL, is_by_agreement=True), _HAAS_SETTINGS),
    "siemens-840d": _SIEMENS_FACTS,
    "siemens-808d": _SIEMENS_FACTS,
    "isg": ISG_FACTS,
    "nct-99m": _NCT_FACTS,
    "mitsubishi": _MITSUBISHI_FACTS,
    "yasnac-lx3": _YASNAC_FACTS,
    "heidenhain": ArcFacts(
        ArcTable(difference=CIRCLE_DEVIATION),
        ArcRows(
            _HEIDENHAIN_ISSUES,
            ArcExamples("0 BEGIN PGM A MM\n1 L X+0 Y+0 R0 F500\n", _in_klartext),
        ),
        (radius_difference_setting(printed(_TNC, "TNC 320 p. 155: circleDeviation"), CIRCLE_DEVIATION),),
    ),
}
"""By the name of the control. On a CNC PILOT each arc is a contour."""
