"""What must hold after notebook 09 has run, in its kernel."""

from math import atan2, cos, hypot, pi, radians, sin, sqrt, tan


def slope(radius, length=50.0, low=40.0):
    """The line that leaves the arc and ends at X90: its length and its angle in radians; None where it is in the arc.
    By hand: the centre of the arc lies to the right of the first line."""
    x = length * cos(radians(80)) + radius * cos(radians(-10))
    y = length * sin(radians(80)) + radius * sin(radians(-10))
    squared = (90 - x) ** 2 + (low - y) ** 2 - radius**2
    if squared < 0:
        return None
    return sqrt(squared), atan2(low - y, 90 - x) - atan2(radius, sqrt(squared))


def setback(angle):
    """What RND R8 takes of a line at this angle; the next line runs straight down."""
    return 8 * tan(abs(angle + pi / 2) / 2)


def room(radius, length=50.0):
    """What is left of the sloping line; below 0 where there is no plate."""
    line = slope(radius, length)
    return line[0] - setback(line[1]) if line else -1.0


ends = {each.name: each.end for each in plate.contour.elements}
straight, angle = slope(15)
assert hypot(ends["line 2"][0] - 50 * cos(radians(80)), ends["line 2"][1] - 50 * sin(radians(80))) < 1e-9
assert hypot(ends["arc 3"][0] - 90 + straight * cos(angle), ends["arc 3"][1] - 40 + straight * sin(angle)) < 1e-9
assert abs(ends["corner 4"][1] - (40 - setback(angle))) < 1e-9
assert hypot(*ends["line 8"]) < 1e-9

# By hand: the line at 60 degrees passes the centre at a distance, and meets the circle half a chord before and behind.
middle, beside = 40 * cos(radians(60)) + 40 * sin(radians(60)), 40 * sin(radians(60)) - 40 * cos(radians(60))
places = sorted(hypot(*each.contour.points["P2"]) for each in listing.solutions)
assert listing.is_complete
assert abs(places[0] - (middle - sqrt(30**2 - beside**2))) < 1e-9
assert abs(places[1] - (middle + sqrt(30**2 - beside**2))) < 1e-9
assert (both.status.value, chosen.status.value) == ("ambiguous", "solved")
assert abs(hypot(*chosen.contour.points["P2"]) - places[0]) < 1e-9

# Without the angle, it is the plate again.
assert contradiction.status.value == "conflicting"
assert [line.partition(" ")[2] for line in fix.replacement.splitlines()] == [*PLATE]

# A plate exists as long as the rounding leaves something of the line before it.
assert all(answer.status.value == "solved" for answer in fan.values())
rows = zip(family["R"].flat, family["LEN"].flat, family["status"].flat, strict=True)
assert all((status == 0) == (room(radius, length) > 0) for radius, length, status in rows)
assert all(abs(left - room(radius)) < 1e-9 for radius, left in zip(radii["R"], radii["line 4.room"], strict=True))

# The corner at X90 is as low as the rounding and the chamfer below it allow.
lowest = low.intervals[0].low.value
assert low.is_complete
assert abs(lowest - 5 - setback(slope(15, low=lowest)[1])) < 1e-6
assert plain.summary.replaced == 1
assert "C X+28.253 Y+60.848 DR-" in plain.text
assert not {"FL", "FLT", "FCT"} & set(plain.text.split())
assert moved.summary.replaced == 1
