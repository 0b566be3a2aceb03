"""What must hold after notebook 01 has run, in its kernel."""

from math import cos, dist, hypot, isclose, radians, sin, tan

# By hand: line 2 leaves line 1 at Z-30 and rises 30 mm at 60 degrees, so it ends at Z-30 - 30 / tan(60 deg). Both
# corners turn by 60 degrees and take 5 * tan(30 deg) of each line.
setback = 5 * tan(radians(30))
end = -30 - 30 / tan(radians(60))
along = setback * cos(radians(60)), setback * sin(radians(60))
by_hand = [(-30 + setback, 20), (-30 - along[0], 20 + along[1]), (end + along[0], 50 - along[1]), (end - setback, 50)]
for element, place in zip(turned.contour.elements, by_hand, strict=True):
    assert dist(element.end, place) < 1e-9

# By hand: the point is on the circle of radius 50 about X0 Y0, near the 3-4-5 triangle.
assert isclose(hypot(x, y), 50, abs_tol=1e-9)
assert (round(x, 3), round(y, 3)) == (40, 30)
