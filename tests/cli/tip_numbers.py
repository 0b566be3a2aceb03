"""The picture of the numbers of imaginary tips on the page about tools."""

from contoursolve.geometry import Turn
from contoursolve.pictures import Mark, MarkKind, Picture, Role, TextRun, Theme, Trail, Weight
from contoursolve.pictures.layout import lay_out
from contoursolve.pictures.scene import Scene, Thin
from contoursolve.pictures.svg import finish
from contoursolve.solving import ArcSegment
from contoursolve.tool_radius.tool import TIPS

APART = 3.4
"""Radii from one nose to the next."""


def tip_numbers() -> Picture:
    """Every tip from 1 to 9 beside its nose, each where the tip lies; 0 is as 9."""
    parts = []
    for number, (across, up) in TIPS.items():
        if number == 0:
            continue
        x, y = across * APART * 1.6, up * APART
        begin, tip = (x + 1.0, y), (x + across, y + up)
        parts.append(Trail((ArcSegment("", begin, begin, (x, y), 1.0, Turn.CCW),), Role.TOOL, Weight.BESIDE))
        if across and up:
            parts += [Thin(tip, at, Role.MUTED, is_dashed=False) for at in ((x, y + up), (x + across, y))]
        told = (TextRun("0 and 9" if number == 9 else str(number), Role.INK),)
        parts.append(Mark(tip, MarkKind.TIP, told, role=Role.CONFLICTING))
    scene = Scene(
        "The number of the tip: where the programmed point lies beside the nose",
        ("Z", "X, away from the axis"),
        tuple(parts),
        remarks=((TextRun("The red dot is the programmed point.", Role.CONFLICTING),),),
        meanings={Role.TOOL: "the nose of the tool"},
    )
    words = "Seen from the centre of the nose, with Z to the right and X up. " + " ".join(
        f"Tip {number}: {_place(*place)}." for number, place in TIPS.items()
    )
    return finish(lay_out(scene), Theme.PAGE, words)


def _place(across: float, up: float) -> str:
    ways = [{-1: "left", 1: "right"}.get(across, ""), {-1: "down", 1: "up"}.get(up, "")]
    return " and ".join(filter(None, ways)) or "the centre itself"
