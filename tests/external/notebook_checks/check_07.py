"""What must hold after notebook 07 has run, in its kernel."""

V1, V2 = answer.contour.points["P1"], answer.contour.points["V1"]
assert abs(V1[0] + 30) < 1e-4
assert V1[1] == 20
assert V2 == (-47.3205, 50)  # X100. is a diameter

manual = contoursolve.solve("G111 X100. A180. K-30. B120. P5. Q5.", start="X40. Z0.").answers[0]
for mine, theirs in zip(answer.contour.elements, manual.contour.elements, strict=False):
    assert max(map(abs, (mine.end[0] - theirs.end[0], mine.end[1] - theirs.end[1]))) < 1e-4
assert len(answer.contour.elements) == len(manual.contour.elements) + 1  # and the line to Z-60.
assert answer.contour.end == (-60, 50)
assert cousin.contour == answer.contour

for rule in OWN_RULES:
    for program in rule.accepted:
        assert rule.code not in {each.code for each in contoursolve.check(program, control=MY_LATHE)}
    for program in rule.rejected:
        assert rule.code in {each.code for each in contoursolve.check(program, control=MY_LATHE)}

assert [finding.code for finding in found.values()] == [
    "end-open",
    "lines-parallel",
    "words-conflict",
    "two-corners",
    "corner-too-large",
]
