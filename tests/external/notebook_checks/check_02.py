"""What must hold after notebook 02 has run, in its kernel."""

from math import atan2, degrees

assert [finding.code for answer in broken for finding in answer.diagnostics[:1]] == [
    "g111-line-1",
    "g111-a-ignored",
    "g111-corner-too-large",
    "g111-reversed",
    "g111-reversed",
    "g111-x-and-u",
]
ignored, too_large = broken[1].diagnostics[0].values, broken[2].diagnostics[0].values
assert abs(ignored["expected"] - degrees(atan2(10, -12))) < 1e-9  # the angle that I10. and K-12. make
assert too_large["limit"] == (66 - 60) / 2 - 0.5  # the shoulder, less the bevel
assert repaired.diagnostics == ()
assert [answer.contour.end for answer in repaired.answers][-1] == (-115, 42)
