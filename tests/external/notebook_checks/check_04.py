"""What must hold after notebook 04 has run, in its kernel."""

from math import asin, atan2, cos, degrees, hypot, radians, tan

# By hand: at A180. the first straight is 30 mm long, and a rounding takes P * tan(30 deg) of it.
rounding = contoursolve.ranges(BLOCK, "P", start=START)
assert abs(rounding.intervals[0].high.value - 30 / tan(radians(30))) < 1e-9
assert rounding.is_complete

# By hand, for other A: the first straight is 30 / cos(180 - A) long, and the corner turns by A - 120.
limit = next(each for each in region.boundaries if "first straight" in each.reason.text)
for A, P in limit.points:
    assert abs(P - 30 / cos(radians(180 - A)) / tan(radians(A - 120) / 2)) < 3 * max(region.cell)

# The map says the same: in the row A180., the rounding fits up to there and no further.
row = family["status"][(values["A"] == 180).argmax()]
assert ((row == 0) == (values["P"] <= 30 / tan(radians(30)))).all()

# By hand: at A180. line 2 is 30 / cos(30 deg) long, and the rounding takes P * tan(30 deg) of it, too.
straight = asked["straight part of line 2"][2]
assert abs(asked["asked.P"][2] - (30 / cos(radians(30)) - straight) / tan(radians(30))).max() < 1e-9
assert (~asked.has_contour).sum() == 2

# Each version is what the block says with its two values.
for A, P, end in zip(versions["A"], versions["P"], versions["corner 2.end Z"], strict=True):
    alone = contoursolve.solve(BLOCK, start=START).answer.with_words(change={"A": f"A{A}", "P": f"P{P}"})
    assert abs(alone.contour.end[0] - end) < 1e-12

# By hand: the start is hypot(30, 10) from the boss's centre. At 180 degrees the rounding begins where the line does if
# the two centres, 25 + R apart, are 30 apart in X and 10 + R in Y.
angles = contoursolve.ranges(CHAIN, "2:,A").intervals[0]
assert abs(angles.low.value - (180 + degrees(atan2(10, 30) - asin(25 / hypot(30, 10))))) < 1e-6
assert abs(contoursolve.ranges(CHAIN, ",R").intervals[0].high.value - 12.5) < 1e-9
row = chain["status"][(chain["2:,A"][:, 0] == 180).argmax()]
assert ((row == 0) == (chain[",R"][0] <= 12.5)).all()

# By hand: line 2 ends 5 * tan(30 deg) before Z-50., and so begins 0.359 mm above X40.
rise = 30 - tan(radians(60)) * (20 - 5 * tan(radians(30)))
assert abs(wanted.hits[0].value - (180 - degrees(atan2(rise, 30)))) < 1e-9
assert (len(wanted.hits), wanted.is_complete) == (1, True)

# By hand: V1 moves by 30 mm a radian of A, and line 2 then ends 30 / tan(60 deg) sooner; X moves only with X.
slopes = {each.word: each.slope for each in off.effects}
assert abs(slopes["A"][0] + radians(30) / tan(radians(60))) < 1e-9
assert abs(slopes["X"][1] - 0.5) < 1e-9  # X is a diameter
assert abs(slopes["K"][0] - 1) < 1e-9
assert slopes["P"] == (0, 0)

# A point that is dimensioned is off by its own tolerance; what is not is off by the same in both designs.
assert abs(errors["by K"]["V1"] - 0.01) < 1e-9
assert abs(errors["by Z"]["V2"] - 0.01) < 1e-9
assert abs(errors["by K"]["V2"] - errors["by Z"]["V1"]) < 1e-4
