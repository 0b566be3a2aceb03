"""The words of whole programs beside their path: one row a function, with a cell for each kind of control.

A cell is read and written alike. Its words are blocks with `{}` for a number; of several texts, the first is written.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum

from contoursolve.diagnostics import Book, Source
from contoursolve.postprocess.post_processors import MachineKind, machine_of
from contoursolve.reading import Control


class ControlKind(Enum):
    """Kind of control: those of one kind write a program beside its path alike."""

    FANUC_LATHE = "Fanuc lathe, G-code system A"
    HAAS_LATHE = "Haas lathe"
    FANUC_MILL = "Fanuc mill"
    HAAS_MILL = "Haas mill"
    MITSUBISHI_MILL = "Mitsubishi mill"
    SINUMERIK = "SINUMERIK"
    ISG = "ISG kernel"
    KLARTEXT = "Klartext"
    CNC_PILOT = "CNC PILOT"

    @property
    def is_fanuc(self) -> bool:
        """Whether its programs look as those of Fanuc: `%`, O, a point in every length."""
        return self in _FANUC

    @property
    def family(self) -> "ControlKind":
        """The kind whose words it has where it has none of its own."""
        return _LIKE.get(self, self)

    @property
    def is_lathe(self) -> bool:
        """Whether it is on lathes alone."""
        return self in (ControlKind.FANUC_LATHE, ControlKind.HAAS_LATHE, ControlKind.CNC_PILOT)


_FANUC = (
    ControlKind.FANUC_LATHE,
    ControlKind.HAAS_LATHE,
    ControlKind.FANUC_MILL,
    ControlKind.HAAS_MILL,
    ControlKind.MITSUBISHI_MILL,
)

_BY_NAME = {
    "fanuc-lathe": ControlKind.FANUC_LATHE,
    "yasnac-lx3": ControlKind.FANUC_LATHE,
    "haas-lathe": ControlKind.HAAS_LATHE,
    "haas-mill": ControlKind.HAAS_MILL,
    "mitsubishi": ControlKind.MITSUBISHI_MILL,
    "siemens-840d": ControlKind.SINUMERIK,
    "siemens-808d": ControlKind.SINUMERIK,
    "isg": ControlKind.ISG,
    "heidenhain": ControlKind.KLARTEXT,
    "cnc-pilot": ControlKind.CNC_PILOT,
}


def kind_of_control(control: Control) -> ControlKind:
    """The kind of a control; one that is not built in is taken for a Fanuc of its kind of machine."""
    usual = {MachineKind.LATHE: ControlKind.FANUC_LATHE, MachineKind.MILL: ControlKind.FANUC_MILL}[machine_of(control)]
    return _BY_NAME.get(control.name, ControlKind.KLARTEXT if control.writing is not None else usual)


def are_alike(one: Control, other: Control) -> bool:
    """Whether two controls read the same words beside the path alike, statements among them."""
    return kind_of_control(one).family is kind_of_control(other).family


class ProgramFunction(Enum):
    """Function of a word beside the path."""

    FEED_A_MINUTE = "feed a minute"
    FEED_A_TURN = "feed a revolution"
    CUTTING_SPEED = "constant cutting speed"
    CUTTING_SPEED_A_MINUTE = "constant cutting speed with feed a minute"
    TURNING_SPEED = "constant speed of the spindle"
    TURNING_SPEED_A_MINUTE = "constant speed of the spindle with feed a minute"
    MOST_TURNS = "highest speed of the spindle"
    SPEED = "speed of the spindle"
    FEED = "feed"
    TOOL = "tool"
    TOOL_CHANGE = "tool change"
    LENGTH = "tool length"
    NO_LENGTH = "end of the tool length"
    NO_CYCLE = "end of a cycle"
    STOP_EXACTLY = "exact stop in one block"
    STOPS = "exact stop"
    NO_STOPS = "contouring"
    DWELL = "dwell, s"
    HOLD = "program stop"
    OPTIONAL_STOP = "optional stop"
    END = "program end"
    CLOCKWISE = "spindle clockwise"
    COUNTER = "spindle counter-clockwise"
    SPINDLE_STOP = "spindle stop"
    MIST = "second coolant"
    COOLANT = "coolant"
    NO_COOLANT = "coolant off"
    OFFSET_1 = "work offset 1"
    OFFSET_2 = "work offset 2"
    OFFSET_3 = "work offset 3"
    OFFSET_4 = "work offset 4"
    OFFSET_5 = "work offset 5"
    OFFSET_6 = "work offset 6"
    SHIFT = "shift of the coordinate system"
    MM = "lengths in mm"
    INCH = "lengths in inch"

    @property
    def is_offset(self) -> bool:
        """Whether it selects a work offset."""
        return self in OFFSETS


OFFSETS = tuple(each for each in ProgramFunction if each.name.startswith("OFFSET_"))


@dataclass(frozen=True, slots=True)
class Cell:
    """The words of a function on a kind of control, and where that stands. No texts: it goes without, and nothing is
    lost."""

    source: Source
    texts: tuple[str, ...]


def _of(title: str, place: str, *texts: str) -> Cell:
    return Cell(Book(title).printed(place), texts)


def _post(place: str, *texts: str) -> Cell:
    return Cell(Book("posts of CAM systems").assumed(place), texts)


def _recalled(*texts: str) -> Cell:
    return Cell(Book("the project's own tables").assumed("recalled, page not seen"), texts)


def _derived(*texts: str) -> Cell:
    return Cell(Book("the project's own tables").derived("follows from the rows beside it"), texts)


_30, _0P = "Fanuc 30i B-63944EN/02", "Fanuc 0i-PC B-64154EN/01"
_16T, _PB = "Fanuc 16/18-C lathe", "Fanuc 18i-PB B-63684EN/01"
_ONE, _F06 = "SINUMERIK programming 12/2019", "SINUMERIK fundamentals 11/2006"
_828, _8O, _8M = "SINUMERIK 828D 09/2011", "SINUMERIK 808D", "SINUMERIK 808D milling 09/2017"
_IM, _I = "Siemens ISO milling 04.07", "Beckhoff TF5200"
_K0, _K1, _K3, _K6 = "TNC 360", "TNC 128", "TNC 320 ISO", "TNC 640 1/2015"

_FL, _FM, _S, _IS, _K = (
    ControlKind.FANUC_LATHE,
    ControlKind.FANUC_MILL,
    ControlKind.SINUMERIK,
    ControlKind.ISG,
    ControlKind.KLARTEXT,
)
_HL, _HM, _M, _P = ControlKind.HAAS_LATHE, ControlKind.HAAS_MILL, ControlKind.MITSUBISHI_MILL, ControlKind.CNC_PILOT

_LIKE = {_HL: _FL, _HM: _FM, _M: _FM}
"""The kinds whose cells are those of another one where they have none of their own."""

_ALL_M = {
    ProgramFunction.HOLD: ("M00", "M0"),
    ProgramFunction.OPTIONAL_STOP: ("M01", "M1"),
    ProgramFunction.CLOCKWISE: ("M03", "M3"),
    ProgramFunction.COUNTER: ("M04", "M4"),
    ProgramFunction.SPINDLE_STOP: ("M05", "M5"),
    ProgramFunction.COOLANT: ("M08", "M8"),
    ProgramFunction.NO_COOLANT: ("M09", "M9"),
}


_PLAIN_OFFSETS = 4
"""Work offsets that SINUMERIK calls as Fanuc does; there, G58 and G59 shift a frame."""


def _everywhere(*text: str) -> Mapping[ControlKind, Cell]:
    return {
        _FL: _of("Fanuc", "M codes, p. 418935691 of TF5200 beside it", *text),
        _FM: _of("Fanuc", "M codes, p. 418935691 of TF5200 beside it", *text),
        _S: _of("SINUMERIK 802D ISO dialect", "p. 8-44", *text),
        _IS: _of(_I, "418935691", *text),
        _K: _of(_K0, "card of M functions", *text),
        _P: _recalled(*text),
    }


TABLE: Mapping[ProgramFunction, Mapping[ControlKind, Cell]] = {
    ProgramFunction.MM: {
        _FL: _of(_30, "p. 192", "G21"),
        _FM: _of(_30, "p. 192", "G21"),
        _S: _of(_828, "p. 341", "G710", "G71"),
        _IS: _of(_I, "206272267", "G71"),
        _K: _recalled(),
        _P: _recalled(),
    },
    ProgramFunction.INCH: {
        _FL: _of(_30, "p. 192", "G20"),
        _FM: _of(_30, "p. 192", "G20"),
        _S: _of(_828, "p. 341", "G700", "G70"),
        _IS: _of(_I, "206272267", "G70"),
        _K: _recalled(),
    },
    ProgramFunction.FEED_A_MINUTE: {
        _FL: _recalled("G98"),
        _FM: _of(_30, "p. 144", "G94"),
        _S: _recalled("G94"),
        _IS: _recalled("G94"),
        _K: _recalled(),
        _P: _recalled("G94"),
    },
    ProgramFunction.FEED_A_TURN: {
        _FL: _recalled("G99"),
        _FM: _of(_30, "p. 144", "G95"),
        _S: _recalled("G95"),
        _IS: _recalled("G95"),
        _K: _of(_K3, "p. 279", "M136"),
        _P: _recalled("G95"),
    },
    ProgramFunction.CUTTING_SPEED: {
        _FL: _of(_16T, "copy page 127", "G96"),
        _FM: _recalled("G96"),
        _S: _of(_ONE, "p. 99", "G96"),
        _IS: _of(_I, "208088587", "G96"),
        _P: _recalled("G96"),
    },
    ProgramFunction.CUTTING_SPEED_A_MINUTE: {
        _FL: _derived("G96"),
        _S: _of(_ONE, "p. 99", "G961"),
        _IS: _derived("G96"),
    },
    ProgramFunction.TURNING_SPEED: {
        _FL: _of(_16T, "copy page 127", "G97"),
        _FM: _recalled("G97"),
        _S: _of(_ONE, "p. 99", "G97"),
        _IS: _of(_I, "208088587", "G97"),
        _K: _recalled(),
        _P: _recalled("G97"),
    },
    ProgramFunction.TURNING_SPEED_A_MINUTE: {
        _FL: _derived("G97"),
        _S: _of(_ONE, "p. 99", "G971"),
        _IS: _derived("G97"),
    },
    ProgramFunction.MOST_TURNS: {
        _FL: _of(_16T, "copy page 127", "G50 S{}"),
        _FM: _recalled("G92 S{}"),
        _S: _of(_ONE, "p. 99", "LIMS={}"),
        _P: _recalled("G26 S{}"),
    },
    ProgramFunction.STOP_EXACTLY: {
        _FM: _of(_0P, "p. 53", "G09"),
        _S: _of(_ONE, "p. 293", "G9"),
        _IS: _of(_I, "206301707", "G60"),
    },
    ProgramFunction.STOPS: {
        _FM: _of(_0P, "p. 53", "G61"),
        _S: _of(_ONE, "p. 293", "G60"),
        _IS: _of(_I, "206307595", "G360"),
    },
    ProgramFunction.NO_STOPS: {
        _FM: _of(_0P, "p. 53", "G64"),
        _S: _of(_ONE, "p. 293", "G64"),
        _IS: _of(_I, "206307595", "G359"),
    },
    ProgramFunction.NO_CYCLE: {
        _FL: _recalled("G80"),
        _FM: _recalled("G80"),
        _S: _derived(),
        _IS: _derived(),
        _K: _derived(),
    },
    ProgramFunction.LENGTH: {
        _FL: _derived(),
        _FM: _of(_IM, "p. 3-42", "G43 H{}"),
        _S: _recalled("D{}"),
        _IS: _of(_I, "306370955", "D{}"),
        _K: _of(_K1, "p. 163"),
    },
    ProgramFunction.NO_LENGTH: {
        _FL: _derived(),
        _FM: _of(_IM, "p. 3-42", "G49"),
        _S: _recalled("D0"),
        _IS: _of(_I, "306370955", "D0"),
        _K: _derived(),
    },
    ProgramFunction.TOOL: {
        _FL: _post("fanuc-turning", "T{}"),
        _FM: _post("fanuc", "T{}"),
        _S: _recalled("T{}"),
        _IS: _recalled("T{}"),
        _K: _recalled("TOOL CALL {} Z"),
    },
    ProgramFunction.TOOL_CHANGE: {
        _FL: _derived(),
        _FM: _recalled("M06", "M6"),
        _S: _of("SINUMERIK 11/2006", "p. 13", "M6"),
        _IS: _of(_I, "418935691", "M06", "M6"),
        _K: _recalled(),
    },
    ProgramFunction.DWELL: {
        _FL: _of(_IM, "p. 3-67", "G04 P{ms}", "G04 X{}", "G04 U{}"),
        _FM: _of(_IM, "p. 3-67", "G04 P{ms}", "G04 X{}"),
        _S: _of(_8M, "p. 327", "G4 F{}"),
        _IS: _of(_I, "206132747", "G04 {}"),
        _K: _of(_K6, "p. 631", "CYCL DEF 9.0 DWELL TIME | CYCL DEF 9.1 DWELL {}"),
        _P: _recalled("G4 F{}"),
    },
    ProgramFunction.SHIFT: {
        _FM: _recalled("G52 {}"),
        _S: _of(_ONE, "p. 315", "TRANS {}"),
        _IS: _of(_I, "206145291", "G92 {}"),
        _K: _recalled("CYCL DEF 7.0 DATUM SHIFT | CYCL DEF 7.{place} {}"),
    },
    ProgramFunction.END: {
        _FL: _recalled("M30", "M02", "M2"),
        _FM: _recalled("M30", "M02", "M2"),
        _S: _recalled("M30", "M2", "M02"),
        _IS: _of(_I, "206761227", "M30", "M02", "M2"),
        _K: _recalled("M30", "M2"),
        _P: _recalled("M30"),
    },
    ProgramFunction.MIST: {
        _FL: _post("fanuc", "M07", "M7"),
        _FM: _post("fanuc", "M07", "M7"),
        _S: _of(_8O, "p. 365", "M7"),
        _IS: _recalled("M07", "M7"),
    },
    **{
        function: {
            _FL: _recalled(f"G{53 + n}"),
            _FM: _recalled(f"G{53 + n}"),
            _S: _of(_F06, "p. 100", f"G{53 + n}") if n <= _PLAIN_OFFSETS else _of(_IM, "p. 3-47", f"G{500 + n}"),
            _IS: _recalled(f"G{53 + n}"),
            _P: _recalled(f"G{53 + n}"),
        }
        for n, function in enumerate(OFFSETS, 1)
    },
    **{function: _everywhere(*texts) for function, texts in _ALL_M.items()},
}
"""A kind that a row does not name has no words for it: what says it is not converted."""


def cell_of(function: ProgramFunction, kind: ControlKind) -> Cell | None:
    """The words of a function on a kind of control; None if it has none."""
    row = TABLE.get(function, {})
    return row.get(kind) or row.get(kind.family)


def words_of_control(control: Control) -> Iterator[str]:
    """A line for each function: the words of a control for it, and where that stands, with its grade."""
    for function in TABLE:
        cell = cell_of(function, kind_of_control(control))
        text = ", ".join(cell.texts) or "goes without" if cell is not None else "not converted"
        yield f"{function.value}: {text}" + (f" ({cell.source})" if cell is not None else "")
