"""What must hold after notebook 03 has run, in its kernel."""

from math import dist, isclose, radians, sin, tan

# By hand: line 2 is 30 / sin(60 deg) long. What is not straight is the rounding's setback, radius * tan(30 deg).
by_hand = (30 / sin(radians(60)) - 20) / tan(radians(30))
assert isclose(taper.asked[0].value, by_hand, abs_tol=1e-9)
assert taper.filled.blocks[0].endswith("P25.359")

# By hand: the bore's centre lies 20 and 15 mm from V1, 25 mm away, and 7, 24, 25 is a right triangle: the lines run in
# the directions (-0.6, 0.8) and (-0.936, 0.352).
assert both.status.value == "ambiguous"
assert listing.is_complete
assert isclose(min(each.contour.end[0] for each in listing.solutions), -30 - 30 * 0.936 / 0.352)
assert isclose(max(each.contour.end[0] for each in listing.solutions), -30 - 30 * 0.6 / 0.8)
assert isclose(chosen.contour.end[0], -52.5)
assert [each.selects for each in signs.solutions] == [("Q1",), ("Q-1",)]
assert (len(drawings), drawings.is_complete) == (8, True)
for drawn in drawings:
    center, radius = drawn.points["k.center"], drawn.radii["k.radius"]
    for x, y, own in ((0, 0, 1), (5, 1, 2), (2, 6, 1.5)):
        apart = dist(center, (x, y))
        assert min(abs(apart - radius - own), abs(apart - abs(radius - own))) < 1e-9
