"""A whole small program around the blocks of a contour, read as its control does: how far it is off the drawn one."""

import re
from collections.abc import Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.comparison import Motion, ToolPath, Travel, along, compare, follow
from contoursolve.controls import CONTROLS
from contoursolve.diagnosis import Depth
from contoursolve.gcode import comment_out, parse, parse_block
from contoursolve.geometry import Length
from contoursolve.postprocess.contour_drawing import ContourDrawing
from contoursolve.postprocess.post_processors import SAME, MachineKind, machine_of
from contoursolve.postprocess.wordings import REFERENCE, HostProgram, WrittenBlock, said
from contoursolve.program import Request, run
from contoursolve.reading import Control, Diameter, ReadIssue, State, advance
from contoursolve.solving import Point

_ISO = ("%", "O0001"), ("M30", "%"), ".nc"
_FRAMES: Mapping[str, tuple[tuple[str, ...], tuple[str, ...], str]] = {
    **dict.fromkeys(("siemens-840d", "siemens-808d"), ((), ("M30",), ".mpf")),
    "isg": (("%CONTOUR",), ("M30",), ".nc"),
    "cnc-pilot": (("FERTIGTEIL",), ("ENDE",), ".nc"),
    "heidenhain": (("BEGIN PGM CONTOUR {unit}",), ("M30", "END PGM CONTOUR {unit}"), ".h"),
}
"""The lines with which a program begins and ends, and the end of its file's name, where that is not as ISO 6983 has
it."""

_MISSING = "Add tool, speed, feed, approach and retract: they are not in it."
_RAPID = "The next block is a rapid straight to the start of the contour. Make it a safe approach."

_SAME = 1e-6
"""mm. A contour whose words are exact is read back to within this."""

_UNITS_OFF = 2
"""A contour with rounded words is read back to within so many units of the last decimal of its control."""


def ending_of(target: Control) -> str:
    """The end of the name of a file with a program for a control, with its dot."""
    return _FRAMES.get(target.name, _ISO)[2]


def says_unit(target: Control, unit: Length) -> bool:
    """Whether a program for a control can say its unit: by a code, or in its first line. Nobody has to say mm."""
    return (
        unit is Length.MM
        or target.modes.code_of(unit) != ""
        or any("{unit}" in line for line in _FRAMES.get(target.name, _ISO)[0])
    )


class ReadBack(Struct, frozen=True):
    """A small program as it is read back: by how much its contour is off, mm, and where it ends. Where it is another
    contour, or has a finding, `deviation` is None: `block` of the contour is to blame, or a `word`, for a `reason`."""

    text: str
    lines: tuple[str, ...]
    """Those of the contour."""
    deviation: float | None = None
    end: Point = (0.0, 0.0)
    block: int = 0
    word: str = ""
    """The text to which a finding points."""
    reason: str = ""


class SmallProgram:
    """The lines around the blocks of a contour for a control; or what stands for the program around them."""

    def __init__(self, target: Control, drawn: ContourDrawing, around: HostProgram | None = None) -> None:
        self.target, self.is_numbered, self.around = target, target.writing is not None, around
        self.opening = () if self.is_numbered else (*filter(None, (_opening(target, drawn),)),)
        self.told = () if around is not None else (*_stated(target), *comment_out(_MISSING, target.modes.syntax))
        unit = drawn.unit.value.upper()
        frame = _FRAMES.get(target.name, _ISO)
        self.before, self.behind = ([line.format(unit=unit) for line in lines] for lines in frame[:2])

    def state(self, unit: Length) -> State:
        """The state behind its opening."""
        state = self.target.initial_state(unit)
        for line in self.opening:
            state = advance(state, parse_block(line, 1, self.target.modes.syntax), self.target.modes)
        return state

    def read(
        self,
        drawn: ContourDrawing,
        start: Sequence[str],
        blocks: Sequence[WrittenBlock],
        *,
        is_exact: bool,
        needs_side: bool = False,
        is_part: bool = False,
    ) -> ReadBack:
        """Read the program with these blocks, which begins at the words of `start`, as its control does, and compare
        its cuts with a contour. It has no error; unless it is there already, no finding at all, and if the contour is
        no `is_part`, no doubt about what is meant."""
        lines, head = self._assemble(start, blocks, needs_side=needs_side)
        own = slice(len(head), len(head) + len(blocks))
        written = ReadBack("\n".join(lines) + "\n", tuple(lines[own]))
        found = self._read_at(Depth.VERDICT, written, drawn, is_exact=is_exact)
        # Doubts take longer, and repairs of what is wrong anyway much longer.
        if found.deviation is not None and not is_part and self.around is None:
            found = self._read_at(Depth.FINDINGS, written, drawn, is_exact=is_exact)
        return found if found.deviation is not None else replace(found, block=found.block - len(head))

    def _assemble(
        self, start: Sequence[str], blocks: Sequence[WrittenBlock], *, needs_side: bool
    ) -> tuple[list[str], list[str]]:
        """All lines, and those before the contour."""
        codes, around, opening, closing = self.target.modes.codes, self.around, [*self.opening], []
        told = comment_out(_RAPID, self.target.modes.syntax) if around is None else []
        if around is not None:
            form = around.form
            places = (at / form.mm * scale for at, scale in zip(around.here, form.scales, strict=True))
            start = [f"{axis}{at:.9f}" for axis, at in zip(form.plane.axes, places, strict=True)]
        first = [" ".join(("L", *start, "R0 FMAX") if self.is_numbered else (codes[0].text, *sorted(start)))]
        if around is not None:
            opening[-1] += f" {around.side}"
            first += [codes[91].text] if around.form.is_incremental else []
        elif needs_side:
            opening[-1] += f" {codes[_LEFT].text} D0"
            closing = [codes[_NO_SIDE].text]
        head = [*self.before, *self.told, *opening, *told, *first]
        numbers = {block.place: len(head) + n for n, block in enumerate(blocks) if block.place >= 0}
        own = [_REFERENCE.sub(lambda found: str(numbers.get(int(found[1]), "")), line) for line in said(blocks)[0]]
        text = [*head, *own, *closing, *self.behind]
        return [f"{n} {line}" for n, line in enumerate(text)] if self.is_numbered else text, head

    def _read_at(self, depth: Depth, written: ReadBack, drawn: ContourDrawing, *, is_exact: bool) -> ReadBack:
        """The contour read with some depth; the `block` to blame is that of the program."""
        modes, axes, is_strict = self.target.modes, drawn.plane.axes, self.around is None
        asked = Request(self.target, drawn.unit, depth=depth, is_strict=is_strict)
        result = run(parse(written.text, syntax=modes.syntax), asked)
        for finding in result.diagnostics:
            if finding.is_error or (is_strict and finding.about is not ReadIssue.NO_CONTOUR):
                span = finding.span
                text = written.text.split("\n")[span.line - 1] if span.line > 0 else ""
                word = text[span.column - 1 : span.end_column - 1]
                return replace(written, block=span.line - 1, word=word, reason=f"{finding.code}: {finding.message}")
        path = follow(result, self.target, drawn.unit, axes)
        # The first move leads to where the contour begins, from a place that is not known.
        steps = tuple(
            replace(each, compensation=_NO_SIDE) if isinstance(each, Travel) else each
            for each in path.steps
            if not (isinstance(each, Travel) and None in each.start)
        )
        last = steps[-1] if steps else None
        if not isinstance(last, Travel):
            return replace(written, reason="rounded numbers lead elsewhere: no motion")
        motion = Motion.RAPID if self.around is not None and self.around.is_rapid else Motion.FEED
        meant = tuple(replace(along(last, each, axes), motion=motion) for each in drawn.path)
        unit = 10.0 ** -SAME.digits(drawn.unit, modes.lexicon.numbers) * float(drawn.unit.in_mm)
        same = compare(
            ToolPath("", "", axes, meant), replace(path, steps=steps), _SAME if is_exact else _UNITS_OFF * unit
        )
        if same.difference is None:
            return replace(written, deviation=same.deviation, end=(last.end[0] or 0.0, last.end[1] or 0.0))
        blamed, reason = same.difference.new or last, same.difference.reason
        return replace(written, block=blamed.line - 1, reason=f"rounded numbers lead elsewhere: {reason}")


_LEFT, _NO_SIDE = 41, 40
_REFERENCE = re.compile(f"{REFERENCE}(\\d+){REFERENCE}")


def _opening(target: Control, drawn: ContourDrawing) -> str:
    """The block that says how the words of a program are read."""
    modes = target.modes
    rows, is_mill = modes.codes.values(), machine_of(target) is MachineKind.MILL
    codes = [*filter(None, [modes.code_of(drawn.unit)])]
    if is_mill or target.diameter is not None:
        codes += [each.text for each in rows if each.plane and each.plane.code == drawn.plane.code]
    if 91 in modes.codes:  # noqa: PLR2004 - its code
        codes.append(modes.codes[90].text)
    if target.diameter is not None and {*drawn.plane.axes} == {"X", "Z"}:
        meant = Diameter.ON if any(drawn.plane.diameters) else Diameter.OFF
        codes += [each.text for each in rows if each.diameter is meant][:1]
    return " ".join(codes)


def _stated(target: Control) -> Sequence[str]:
    """The comment that states the control and its settings; none of a control that is known by its own tables alone."""
    if target.name not in CONTROLS:
        return ()
    stated = (f"{name}: {value}" for name, value in target.modes.settings.items() if name != "machine")
    return comment_out(", ".join((f"contoursolve control: {target.name}", *stated)), target.modes.syntax)
