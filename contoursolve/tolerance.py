"""Every tolerance of the package, with its unit and its reason."""

RESIDUAL = 1e-9
"""mm. Largest residual of an original equation in a solved contour: a millionth of the controls'
least increment, and ten times the rounding error of coordinates of `LARGEST` size."""

LENGTH = 1e-9
"""mm. Lengths up to this count as zero: an element this short is left out, a corner that lacks
this little room still fits. It covers the rounding of a length that is zero or fits exactly. It is not half an
increment, to which words are exact: a path that fits by so much only would run backwards by as much, and a control
may refuse it. The fix, the largest value that fits, is safe on every control."""

REGULAR = 1e-12
"""1 (sine of an angle). A determinant of unit directions below this is zero: 1e-12 is 5,000 times
the rounding of a sine and 10 million times smaller than the sine of the least angle, 0.001 deg."""

TOUCHING = 16 * 2.0**-52
"""1 (share of the radius plus the coordinates, counted from the start point). A line whose distance to the
centre differs from the radius by less than this touches the circle: the difference is then below the
rounding of the distance itself."""

ERROR_BOUND_WARNING = 1e-6
"""mm. A contour whose coordinates may be off by more than this is reported: a thousandth of the
controls' least increment."""

RADIUS_DIFFERENCE = 0.01
"""mm. Allowed difference of the radii at two points of one circle. Controls compare it with a machine parameter whose
factory value we have not seen; 0.01 mm is our assumption, and a setting of each control."""

CIRCLE_DEVIATION = 0.016
"""mm. The same on HEIDENHAIN controls: the most that they allow (printed, TNC 320 p. 155)."""

ARC_START = 0.5
"""1 (share of the allowed difference of the radii). How far off an arc that stays as it is may begin behind an expanded
contour: the other half is for its own words."""

INCREMENT, INCREMENT_INCH, INCREMENT_ANGLE = 0.001, 0.0001 * 25.4, 0.001
"""mm, mm of a program in inches, degrees. The least increments of the controls. What a word gives is exact to half of
its own; that of a diameter counts half as a radius (see `Fact.allowance`)."""

AGREEMENT = 0.001
"""mm or degrees. Facts of other kinds than words agree within this."""

TRAVEL = 100_000.0
"""mm. How far from the start point a contour may lie that a control can make: as large as a machine is. A list of
solutions that is called complete holds all of them so far; a setting of each control."""

LARGEST = 1_000_000.0
"""mm or degrees. The largest value read: one kilometre. Beyond it, doubles no longer hold 1e-9 mm."""
