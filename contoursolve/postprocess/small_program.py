"""A whole small program around the blocks of a contour: what a control must be told first, the start, and the end."""

import re
from collections.abc import Iterable, Mapping, Sequence

from contoursolve.controls import DIALECTS
from contoursolve.gcode import comment_out, parse_block
from contoursolve.geometry import Length
from contoursolve.postprocess.contour_drawing import ContourDrawing
from contoursolve.postprocess.post_processors import MachineKind, machine_of
from contoursolve.postprocess.wordings import REFERENCE, HostProgram, WrittenBlock
from contoursolve.reading import Dialect, Diameter, State, advance

_ISO = ("%", "O0001"), ("M30", "%")
_FRAMES: Mapping[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    **dict.fromkeys(("siemens-840d", "siemens-808d"), ((), ("M30",))),
    "isg": (("%CONTOUR",), ("M30",)),
    "heidenhain": (("BEGIN PGM CONTOUR {unit}",), ("M30", "END PGM CONTOUR {unit}")),
}
"""The lines with which a program begins and ends, where that is not as ISO 6983 has it."""

_ENDINGS = {"siemens-840d": ".mpf", "siemens-808d": ".mpf", "heidenhain": ".h"}
"""The ends of file names of programs, where that is not `.nc`."""

_MISSING = "Add tool, speed, feed, approach and retract: they are not in it."
_RAPID = "The next block is a rapid straight to the start of the contour. Make it a safe approach."


def ending_of(target: Dialect) -> str:
    """The end of the name of a file with a program for a control, with its dot."""
    return _ENDINGS.get(target.name, ".nc")


class SmallProgram:
    """The lines around the blocks of a contour for a control; or what stands for the program around them."""

    def __init__(self, target: Dialect, drawn: ContourDrawing, around: HostProgram | None = None) -> None:
        self.target, self.is_numbered, self.around = target, target.writing is not None, around
        self.opening = () if self.is_numbered else (_opening(target, drawn),)
        self.told = () if around is not None else (*_stated(target), *comment_out(_MISSING, target.modes.syntax))
        self.frame = [
            [line.format(unit=drawn.unit.value.upper()) for line in lines] for lines in _FRAMES.get(target.name, _ISO)
        ]

    def state(self, unit: Length) -> State:
        """The state behind its opening."""
        state = self.target.initial_state(unit)
        for line in self.opening:
            state = advance(state, parse_block(line, 1, self.target.modes.syntax), self.target.modes)
        return state

    def assemble(
        self, blocks: Sequence[WrittenBlock], lines: Iterable[str], start: Sequence[str], *, needs_side: bool
    ) -> tuple[list[str], int]:
        """All lines, and the number of the first one of the contour, from 1; `start` are the words of its begin."""
        before, behind = self.frame
        codes = self.target.modes.codes
        opening = [*self.opening]
        if self.is_numbered:
            first = " ".join(("L", *start, "R0 FMAX"))
        else:
            first = " ".join((codes[0].text, *sorted(start)))
            if self.around is not None:
                opening[-1] += f" {self.around.side}"
                first += f"\n{codes[91].text}" if self.around.form.is_incremental else ""
            elif needs_side:
                opening[-1] += f" {codes[_LEFT].text} D0"
        told = comment_out(_RAPID, self.target.modes.syntax) if self.around is None else ()
        head = [*before, *self.told, *opening, *told, *first.split("\n")]
        closing = [codes[_NO_SIDE].text] if needs_side and self.around is None else []
        numbers = {block.place: len(head) + n for n, block in enumerate(blocks) if block.place >= 0}
        own = [_REFERENCE.sub(lambda found: str(numbers.get(int(found[1]), "")), line) for line in lines]
        text = [*head, *own, *closing, *behind]
        return [f"{n} {line}" for n, line in enumerate(text)] if self.is_numbered else text, len(head) + 1


_LEFT, _NO_SIDE = 41, 40
_REFERENCE = re.compile(f"{REFERENCE}(\\d+){REFERENCE}")


def _opening(target: Dialect, drawn: ContourDrawing) -> str:
    """The block that says how the words of a program are read."""
    modes = target.modes
    rows, is_mill = modes.codes.values(), machine_of(target) is MachineKind.MILL
    codes = [next(each.text for each in rows if each.unit is drawn.unit)]
    if is_mill or target.diameter is not None:
        codes += [each.text for each in rows if each.plane and each.plane.code == drawn.plane.code]
    if 91 in modes.codes:  # noqa: PLR2004 - its code
        codes.append(modes.codes[90].text)
    if target.diameter is not None and {*drawn.plane.axes} == {"X", "Z"}:
        meant = Diameter.ON if any(drawn.plane.diameters) else Diameter.OFF
        codes += [each.text for each in rows if each.diameter is meant][:1]
    return " ".join(codes)


def _stated(target: Dialect) -> Sequence[str]:
    """The comment that states the control and its settings; none of a control that is known by its own tables alone."""
    if target.name not in DIALECTS:
        return ()
    stated = (f"{name}: {value}" for name, value in target.modes.settings.items() if name != "machine")
    return comment_out(", ".join((f"contoursolve control: {target.name}", *stated)), target.modes.syntax)
