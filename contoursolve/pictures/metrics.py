"""How wide texts are, by the advance widths of DejaVu Sans: most other fonts are narrower, so that texts fit there."""

ASCENT, DESCENT = 0.78, 0.22
"""1 (share of the font size). What a line of capitals, digits and lower case letters takes above and below its base."""

MONO = 0.602
"""1 (share of the font size). Width of every character of DejaVu Sans Mono."""

# fmt: off
_WIDTHS = (
    318, 401, 460, 838, 636, 950, 780, 275, 390, 390, 500, 838, 318, 361, 318, 337, 636, 636, 636, 636, 636, 636, 636,
    636, 636, 636, 337, 337, 838, 838, 838, 531, 1000, 684, 686, 698, 770, 632, 575, 775, 752, 295, 295, 656, 557, 863,
    748, 787, 603, 787, 695, 635, 611, 732, 684, 989, 685, 611, 685, 390, 337, 390, 838, 500, 500, 613, 635, 550, 635,
    615, 352, 635, 634, 278, 278, 579, 278, 974, 634, 612, 635, 635, 411, 521, 392, 634, 592, 818, 592, 592, 525, 636,
    337, 636, 838,
)
# fmt: on
"""Advance widths of the characters from the blank to the tilde, thousandths of the font size."""

_FIRST, _OTHER, _BOLD = 32, 1000, 1.11


def width_of(text: str, size: float, *, is_bold: bool = False, is_mono: bool = False) -> float:
    """The width of a text, pixels; characters outside ASCII count as the widest."""
    if is_mono:
        return sum(MONO if ord(each) < 0x2E80 else 1.0 for each in text) * size  # noqa: PLR2004 - East Asian ones begin here
    total = sum(_width(ord(each) - _FIRST) for each in text)
    return total / 1000 * size * (_BOLD if is_bold else 1.0)


def _width(place: int) -> int:
    return _WIDTHS[place] if 0 <= place < len(_WIDTHS) else _OTHER


def shorten(text: str, width: float, size: float, *, is_bold: bool = False, is_mono: bool = False) -> str:
    """The text, or as much of its beginning as fits the width (pixels), with an ellipsis."""
    if width_of(text, size, is_bold=is_bold, is_mono=is_mono) <= width:
        return text
    kept = text
    while kept and width_of(kept + "…", size, is_bold=is_bold, is_mono=is_mono) > width:
        kept = kept[: max(len(kept) * 9 // 10, len(kept) - 8, 0)] if len(kept) > 80 else kept[:-1]  # noqa: PLR2004
    return kept.rstrip() + "…"


def wrap(text: str, width: float, size: float, lines: int) -> list[str]:
    """The text in at most so many lines of this width; the last one is shortened."""
    found: list[str] = []
    rest = text.split()
    while rest and len(found) < lines - 1:
        count = 1
        while count < len(rest) and width_of(" ".join(rest[: count + 1]), size) <= width:
            count += 1
        found.append(shorten(" ".join(rest[:count]), width, size))
        rest = rest[count:]
    if rest:
        found.append(shorten(" ".join(rest), width, size))
    return found
