"""The arcs of each control: how it reads them outside contours, how exact it wants them, and its rows and settings."""

from collections.abc import Mapping
from dataclasses import replace
from decimal import Decimal
from typing import Any

from msgspec import Struct

from contoursolve.controls.arc_rules import (
    ARC_SETTINGS,
    ARCS,
    POLAR,
    ArcExamples,
    ArcRows,
    arc_setting,
    in_codes,
    number_of_arcs,
    remember_polar,
)
from contoursolve.controls.control_settings import setting
from contoursolve.controls.rule_rows import row, with_rows
from contoursolve.diagnostics import Alarm, Book, Evidence, Severity
from contoursolve.reading import CENTRES, ArcIssue, ArcTable, Beyond, BothStated, Control, Setting, State
from contoursolve.tolerance import CIRCLE_DEVIATION


class ArcFacts(Struct, frozen=True):
    """The arcs of one control: its table, its rows, and its settings besides those that it has."""

    table: ArcTable
    rows: ArcRows
    settings: tuple[Setting, ...]


def reading_arcs(control: Control, **own: Any) -> Control:
    """A control that reads arcs outside contours as its facts say, and as fields of its table do."""
    facts = ARC_FACTS[control.name]
    remember = control.modes.remember or (remember_polar if facts.table.others else None)
    return replace(
        control,
        modes=replace(control.modes, arcs=replace(facts.table, **own), remember=remember),
        rules=(*control.rules, *facts.rows.rules()),
        settings=(*control.settings, *facts.settings),
    )


def _alarm(number: str, *, is_printed: bool = True) -> Alarm:
    return Alarm(number, Evidence.PRINTED if is_printed else Evidence.ASSUMED)


_ON_MILL = in_codes("G17 G90 G21\nG00 X0 Y0\nG01 X0 Y0 F200.\n", "XY", "IJ")
_ON_LATHE = in_codes("G00 X40. Z0.\nG01 Z0. F0.2\n", "ZX", "KI", at=(0, 40), halved=2)

# Fanuc and Haas --------------------------------------------------------------------------------------------------

_LIST, _MANUAL = Book("FANUC alarm list"), Book("FANUC 16/18/160/180-C lathe operator's manual")
_FANUC = ArcTable(both=BothStated.RADIUS_COUNTS, is_still=True, others=frozenset({POLAR}))
_3403, _AS_LINE = Book("FANUC parameter 3403, bit 5").assumed("recalled"), "--setting CONTROL.no-centre=line"
_RADII = _LIST.assumed("alarm 020: parameter 3410 says how much is allowed")
_FANUC_SETTINGS = (
    arc_setting(
        "radius-difference",
        Book("FANUC parameter 3410").assumed("its value is one of each machine"),
        meaning=ARC_SETTINGS["radius-difference"].meaning + "; 0 where the control does not look",
        bounds=(Decimal(0), Decimal(10)),
    ),
    arc_setting("off-arc", _MANUAL.printed("an arc, then a line; the alarm list: a spiral, for another series")),
    arc_setting("no-centre", _3403),
    arc_setting(CENTRES, Book("FANUC lathes and mills").assumed("centres count from the start")),
)
_FANUC_ROWS = (
    row("arc-radii-differ", like=ARCS, source=_RADII, alarm=_alarm("020 OVER TOLERANCE OF RADIUS")),
    row("arc-spiral", like=ARCS, source=_RADII, options="--setting CONTROL.radius-difference=0"),
    row("arc-radius-small", like=ARCS, source=_LIST.assumed("arcs by R: no alarm is printed for it")),
    row("arc-moves-nothing", like=ARCS, source=_MANUAL.printed("circular interpolation: an arc of 0 deg")),
    row(
        "arc-undefined",
        like=ARCS,
        source=_LIST.printed("alarm 022"),
        alarm=_alarm("022 R OR I,J,K COMMAND NOT FOUND"),
        note="a parameter lets older sets run a straight line",
    ),
    row("arc-runs-line", like=ARCS, source=_3403, options=_AS_LINE),
    row("arc-outside-plane", like=ARCS, source=_LIST.printed("alarm 028"), alarm=_alarm("028 ILLEGAL PLANE SELECT")),
    row("arc-empty-circle", like=ARCS, source=_LIST.assumed("circular interpolation: not described")),
)
_065 = _alarm("065")
_OF_PROFILES = (
    row("profile-begins-with-arc", like=ARCS, source=_LIST.derived("alarm 065: that an arc causes it"), alarm=_065),
    row(
        "profile-begins-without-code",
        like=ARCS,
        source=_LIST.printed("alarm 065: its first block without G00 or G01"),
        alarm=_065,
    ),
)
_OVER = row(
    "arc-over-half",
    like=ARCS,
    source=_MANUAL.printed("circular interpolation: by R less than 180 deg"),
    options="--setting CONTROL.negative-radius=error",
)
_STILL = row("arc-moves-nothing", like=ARCS, source=_MANUAL.assumed("that mills do so, too"))

_HAAS = Book("Haas operator's manual")
_HAAS_ROWS = (
    row("arc-radii-differ", like=ARCS, source=_HAAS.assumed("G02, G03: 0.0010 inch is allowed")),
    row("arc-radius-small", like=ARCS, source=_HAAS.assumed("G02, G03: R")),
    row("arc-full-by-radius", like=ARCS, source=_HAAS.assumed("G02, G03: R")),
    row("arc-undefined", like=ARCS, source=_HAAS.assumed("G02, G03: I, J, K or R")),
    row("arc-both", like=ARCS, source=_HAAS.assumed("G02, G03: not described")),
    row("arc-outside-plane", like=ARCS, source=_HAAS.assumed("G17, G18, G19")),
    row("arc-empty-circle", like=ARCS, source=_HAAS.assumed("G02, G03: not described")),
)
_UNSEEN = row(
    "profile-begins-with-arc", like=ARCS, source=_HAAS.assumed("G71, G72: no page seen"), severity=Severity.WARNING
)
_HAAS_TABLE = ArcTable(both=BothStated.AGREES, others=frozenset({POLAR}))
_HAAS_SETTINGS = (
    arc_setting("radius-difference", _HAAS.assumed("0.0010 inch or 0.01 mm")),
    arc_setting("centre-and-radius", _HAAS.assumed("not described")),
    arc_setting(CENTRES, _HAAS.printed("G02, G03: I, J, K count from the start")),
)


def _lathe(table: ArcTable) -> ArcTable:
    """The table of a lathe, whose other planes have axes that are not followed."""
    return replace(table, planes=frozenset({"G18"}))


# SINUMERIK and ISG -----------------------------------------------------------------------------------------------

_SIEMENS = Book("SINUMERIK NC programming manual")
_14040 = _alarm("14040 (error in the end point of a circle)")
_SIEMENS_FACTS = ArcFacts(
    ArcTable(share=0.001, both=BothStated.AGREES, opening="AR", through="CIP", beside=frozenset({"TURN"})),
    ArcRows(
        (
            row(
                "arc-radii-differ",
                like=ARCS,
                source=Book("SINUMERIK alarm 14040").printed("machine data 21000 and 21010"),
                alarm=_14040,
            ),
            row("arc-radius-small", like=ARCS, source=_SIEMENS.assumed("CR: no alarm is printed for it")),
            row("arc-full-by-radius", like=ARCS, source=Book("SINUMERIK alarm 14040").printed("cause 1"), alarm=_14040),
            row("arc-undefined", like=ARCS, source=_SIEMENS.assumed("circular interpolation")),
            row("arc-both", like=ARCS, source=_SIEMENS.assumed("a form with both is printed; no word on a clash")),
            row("arc-outside-plane", like=ARCS, source=_SIEMENS.assumed("G17, G18, G19")),
            row("arc-empty-circle", like=ARCS, source=_SIEMENS.assumed("circular interpolation")),
            row(
                "arc-opening-angle", like=ARCS, source=_SIEMENS.assumed("AR, the opening angle: its range is recalled")
            ),
            row("arc-in-line", like=ARCS, source=_SIEMENS.derived("CIP: three points in line are on no circle")),
        ),
        in_codes("G17 G90 G71\nG0 X0 Y0\nG1 X0 Y0 F200\n", "XY", "IJ", "CR="),
        wrong={ArcIssue.OPENING: "G02 X20. Y0. AR=400.", ArcIssue.IN_LINE: "CIP X20. Y0. I1=10. J1=0."},
        is_by_agreement=True,
    ),
    (
        arc_setting(
            "radius-difference", Book("SINUMERIK machine datum 21000").assumed("CIRCLE_ERROR_CONST, value recalled")
        ),
        number_of_arcs(
            "radius-difference-factor",
            "the share of the radius by which the radii of an arc may differ, where that is more",
            "0.001",
            Book("SINUMERIK machine datum 21010").assumed("CIRCLE_ERROR_FACTOR, value recalled"),
            "1",
            "",
        ),
        arc_setting("centre-and-radius", _SIEMENS.assumed("a form with both is printed; no word on a clash")),
        arc_setting(CENTRES, _SIEMENS.printed("circular interpolation: I, J, K count from the start")),
    ),
)

_ISG = Book("ISG kernel, programming manual")
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


def _uncorrected(control: Control) -> Control:
    arcs = replace(ISG_FACTS.table, beyond=Beyond.REFUSES)
    return replace(control, modes=replace(control.modes, arcs=arcs))


_MOVED = Book("ISG kernel, channel parameters").printed("P-CHAN-00059 and P-CHAN-00060")
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
        (
            row("arc-radii-differ", like=ARCS, source=_MOVED),
            row(
                "arc-radii-uncorrected",
                like=ARCS,
                source=_ISG.printed("G164; P-CHAN-00171 and P-CHAN-00172"),
                alarm=_alarm("21758"),
            ),
            row("arc-centre-moves", like=ARCS, source=_MOVED),
            row("arc-radius-small", like=ARCS, source=_ISG.assumed("circular interpolation: not described")),
            row("arc-full-by-radius", like=ARCS, source=_ISG.printed("error 20034"), alarm=_alarm("20034")),
            row(
                "arc-undefined",
                like=ARCS,
                source=_ISG.assumed("circular interpolation; error 20036 is printed for G164"),
            ),
            row("arc-both", like=ARCS, source=_ISG.printed("error 21024, newer 22159"), alarm=_alarm("21024")),
            row("arc-outside-plane", like=ARCS, source=_ISG.assumed("G17, G18, G19")),
            row("arc-empty-circle", like=ARCS, source=_ISG.assumed("circular interpolation")),
        ),
        in_codes("G17 G90 G71\nG0 X0 Y0\nG1 X0 Y0 F200\n", "XY", "IJ"),
        differs=30,
        before={ArcIssue.RADII_UNCORRECTED: "G164\n"},
    ),
    (
        setting(
            "centre-correction",
            "whether the control moves a centre that is not as far from both ends, before the program says it",
            {"on": "it does: G165", "off": "it does not: G164"},
            _ISG.printed("G165 is the initial state"),
            {"off": _uncorrected},
        ),
        number_of_arcs("centre-shift", "by how much a centre is moved", "2", _MOVED, "100"),
        number_of_arcs(
            "centre-shift-share", "by which share of the radius a centre is moved", "5", _MOVED, "100", "percent"
        ),
        arc_setting(CENTRES, _ISG.printed("G162 is the initial state")),
    ),
)

# The others ------------------------------------------------------------------------------------------------------

_NCT = Book("NCT 99M/2000M Programmer's Manual")
_3012, _3014 = _alarm("3012 ERRONEOUS CIRCLE DEF. R"), _alarm("3014 ERRONEOUS CIRCLE DEF.")
_NCT_FACTS = ArcFacts(
    ArcTable(others=frozenset({POLAR})),
    ArcRows(
        (
            row(
                "arc-radii-differ",
                like=ARCS,
                alarm=_alarm("3011 RADIUS DIFFERENCE"),
                source=_NCT.assumed("p. 26 (4.3): alarm 3011; the allowed difference is a machine parameter"),
            ),
            row("arc-radius-small", like=ARCS, source=_NCT.derived("p. 25: R; no alarm is printed for it")),
            row(
                "arc-full-by-radius",
                like=ARCS,
                source=_NCT.printed("p. 26 (4.3): alarm 3012, end equals start"),
                alarm=_3012,
            ),
            row("arc-undefined", like=ARCS, source=_NCT.printed("p. 26 (4.3): alarm 3014"), alarm=_3014),
            row("arc-both", like=ARCS, source=_NCT.printed("16.3.3, p. 129")),
            row("arc-outside-plane", like=ARCS, source=_NCT.printed("p. 26 (4.3): alarm 3014"), alarm=_3014),
            row("arc-empty-circle", like=ARCS, source=_NCT.assumed("p. 26 (4.3): not described")),
        ),
        _ON_MILL,
        # With both coordinates of its end it begins in an intersection.
        wrong={ArcIssue.BOTH: "G02 X20. I10. J0. R12."},
    ),
    (arc_setting(CENTRES, _NCT.printed("p. 25: centres count from the start")),),
)

_MITSUBISHI = Book("Mitsubishi M700V/M70V programming manual")
_P33, _P70 = (_alarm(each, is_printed=False) for each in ("P33 (format error)", "P70 (end point deviation of an arc)"))
_P71 = _alarm("P71 (centre of an arc cannot be calculated)", is_printed=False)
_MITSUBISHI_FACTS = ArcFacts(
    replace(_FANUC, is_still=False),
    ArcRows(
        (
            row(
                "arc-radii-differ",
                like=ARCS,
                source=_MITSUBISHI.assumed("parameter 1084 says how much is allowed"),
                alarm=_P70,
            ),
            row("arc-radius-small", like=ARCS, source=_MITSUBISHI.assumed("arcs by R"), alarm=_P71),
            row("arc-full-by-radius", like=ARCS, source=_MITSUBISHI.assumed("arcs by R"), alarm=_P70),
            row(
                "arc-undefined",
                like=ARCS,
                source=_MITSUBISHI.assumed("circular interpolation"),
                alarm=_P33,
                note="a parameter makes it a straight line",
            ),
            row("arc-runs-line", like=ARCS, source=_MITSUBISHI.assumed("parameter 11029"), options=_AS_LINE),
            row("arc-outside-plane", like=ARCS, source=_MITSUBISHI.assumed("G17, G18, G19")),
            row("arc-empty-circle", like=ARCS, source=_MITSUBISHI.assumed("circular interpolation")),
        ),
        _ON_MILL,
    ),
    (
        arc_setting("radius-difference", _MITSUBISHI.assumed("parameter 1084")),
        arc_setting("no-centre", _MITSUBISHI.assumed("parameter 11029")),
        arc_setting(CENTRES, _MITSUBISHI.assumed("centres count from the start")),
    ),
)

_YASNAC = Book("YASNAC LX3 Instruction Manual")
_RELATIVE = Book("YASNAC PC NC programming manual").derived("p. 2-5 to 2-9, a relative of the control")
_ARCS_LX3 = _YASNAC.assumed("circular interpolation: not on the pages that we have")
_YASNAC_FACTS = ArcFacts(
    _lathe(ArcTable(beyond=Beyond.SPIRAL, both=BothStated.AGREES)),
    ArcRows(
        (
            row("arc-spiral", like=ARCS, source=_RELATIVE),
            row("arc-radius-small", like=ARCS, source=_ARCS_LX3),
            row("arc-full-by-radius", like=ARCS, source=_ARCS_LX3),
            row("arc-undefined", like=ARCS, source=_ARCS_LX3),
            row("arc-both", like=ARCS, source=_ARCS_LX3),
            row("arc-outside-plane", like=ARCS, source=_ARCS_LX3),
            row("arc-empty-circle", like=ARCS, source=_ARCS_LX3),
        ),
        _ON_LATHE,
        is_by_agreement=True,
    ),
    (
        arc_setting("radius-difference", _YASNAC.assumed("circular interpolation; our choice")),
        arc_setting("centre-and-radius", _ARCS_LX3),
        arc_setting(CENTRES, _RELATIVE),
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


_TNC = Book("HEIDENHAIN TNC user's manuals")
_HEIDENHAIN_ROWS = (
    row("arc-radii-differ", like=ARCS, source=_TNC.printed("TNC 320 p. 155: at most 0.016 mm")),
    row("arc-radius-small", like=ARCS, source=_TNC.assumed("CR: not described")),
    row("arc-full-by-radius", like=ARCS, source=_TNC.printed("CR: two half circles make a full one")),
    row("arc-undefined", like=ARCS, source=_TNC.printed("C: a centre CC stands before it")),
    row("arc-empty-circle", like=ARCS, source=_TNC.assumed("not described")),
)

ARC_FACTS: Mapping[str, ArcFacts] = {
    "fanuc-lathe": ArcFacts(
        _lathe(_FANUC),
        ArcRows((*_FANUC_ROWS, _OVER, *_OF_PROFILES), _ON_LATHE),
        (
            *_FANUC_SETTINGS,
            arc_setting("negative-radius", _MANUAL.printed("circular interpolation: under 180 deg on 16/18-C")),
        ),
    ),
    "fanuc-mill": ArcFacts(_FANUC, ArcRows(with_rows(_FANUC_ROWS, _STILL), _ON_MILL), _FANUC_SETTINGS),
    "haas-lathe": ArcFacts(
        _lathe(_HAAS_TABLE),
        ArcRows((*_HAAS_ROWS, _UNSEEN), _ON_LATHE, is_by_agreement=True),
        _HAAS_SETTINGS,
    ),
    "haas-mill": ArcFacts(_HAAS_TABLE, ArcRows(_HAAS_ROWS, _ON_MILL, is_by_agreement=True), _HAAS_SETTINGS),
    "siemens-840d": _SIEMENS_FACTS,
    "siemens-808d": _SIEMENS_FACTS,
    "isg": ISG_FACTS,
    "nct-99m": _NCT_FACTS,
    "mitsubishi": _MITSUBISHI_FACTS,
    "yasnac-lx3": _YASNAC_FACTS,
    "heidenhain": ArcFacts(
        ArcTable(difference=CIRCLE_DEVIATION),
        ArcRows(_HEIDENHAIN_ROWS, ArcExamples("0 BEGIN PGM A MM\n1 L X+0 Y+0 R0 F500\n", _in_klartext)),
        (
            arc_setting(
                "radius-difference",
                _TNC.printed("TNC 320 p. 155: circleDeviation"),
                values={f"{CIRCLE_DEVIATION}": "mm"},
                default=f"{CIRCLE_DEVIATION}",
            ),
        ),
    ),
}
"""By the name of the control. On a CNC PILOT each arc is a contour."""
