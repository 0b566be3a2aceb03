"""Long contours with one mistake, or with one in each corner."""

from math import cos, radians, sin


def klartext(elements: int, mistake: str = "") -> str:
    """Lines of FK, each with its direction and length or with its end. The mistake in the middle is a word `twice`, a
    word that `disagrees`, or one that is `missing`."""
    lines, x, y = [], 0.0, 0.0
    for number in range(elements):
        angle = number * 37 % 90 - 20
        x, y = x + 10 * cos(radians(angle)), y + 10 * sin(radians(angle))
        lines.append(f"FL X{x:+.3f} Y{y:+.3f}" if number % 2 else f"FL AN{angle:+.3f} LEN 10")
    middle = elements // 4 * 2
    if mistake == "missing":
        lines[middle] = lines[middle].replace(" LEN 10", "")
    elif mistake:
        lines[middle + (mistake == "disagrees")] += " AN+77"
    return "\n".join(["0 BEGIN PGM A MM", "1 L X+0 Y+0 RL F300", *lines, "END PGM A MM"])


def angles(elements: int, mistake: str = "") -> str:
    """Pairs of lines of NCT 99M, the first by its angle alone. The mistake in the middle is an angle that is
    `reversed`, a corner that is too `large`, or an angle that stands there `twice`."""
    lines, x, y = [], 0.0, 0.0
    for number in range(elements):
        angle = 30 if number % 2 else 60
        x, y = x + 10 * cos(radians(angle)), y + 10 * sin(radians(angle))
        corner = " ,R1" if number < elements - 1 else ""
        lines.append(f"G1 ,A{angle} X{x:.3f} Y{y:.3f}{corner}" if number % 2 else f"G1 ,A{angle}")
    middle = elements // 4 * 2
    if mistake == "reversed":
        lines[middle] = "G1 ,A-60"
    elif mistake == "large":
        lines[middle + 1] = lines[middle + 1].replace(",R1", ",R50")
    elif mistake:
        lines[middle] += " ,A77"
    return "\n".join(["G17 G90", "G42 G0 X0 Y0 D0", *lines])


def corners(number: int, control: str, rise: float = 5.0) -> str:
    """Lines up and down with a corner between any two; without a rise, all on one line, where no corner can be."""
    corner = "RND=1." if control.startswith("siemens") else ",R1."
    ends = [(10 * at, at % 2 * rise) for at in range(1, number + 2)]
    if control == "heidenhain":
        lines = [f"FL X{x:+d} Y{y:+.3f}\nRND R1" for x, y in ends]
        return (
            "\n".join(["0 BEGIN PGM A MM", "1 L X+0 Y+0 RL F300", *lines]).removesuffix("\nRND R1") + "\nEND PGM A MM"
        )
    lathe = control == "fanuc-lathe"
    lines = [f"G1 Z-{x}. X{100 + 2 * y:.3f} {corner}" if lathe else f"G1 X{x}. Y{y:.3f} {corner}" for x, y in ends]
    begin = ["G0 X100. Z0."] if lathe else ["G17 G90", "G0 X0. Y0."]
    return "\n".join([*begin, *lines]).removesuffix(f" {corner}")
