"""What must hold after notebook 13 has run, in its kernel."""

from math import atan, degrees, tan


def taper(wall):
    """By hand: line 2 rises by 30 mm between line 1, which ends at Z-30, and the wall before Z-50."""
    return atan(30 / (20 - wall))


def largest(wall, line_1):
    """By hand: the rounding that takes all of line 1."""
    return line_1 / tan(taper(wall) / 2)


assert abs(path[-1] - [180 - degrees(taper(3)), largest(3, 30)]).max() < 1e-9
assert abs(costs["line 1"] - (largest(3, 30) - largest(3, 29))) < 1e-5
assert abs(costs["wall"] - (largest(2.999, 30) - largest(3.001, 30)) / 0.002) < 1e-5

# 10,000 rows know a standard deviation to 1 / sqrt(20,000) of it.
names = [name for name in spread if spread[name].typical]
assert all(abs(many_drawn[name].std() / spread[name].typical - 1) < 4 / 20_000**0.5 for name in names)
assert kept(BEST) < 0.25
assert kept(SAFE) > 0.99
