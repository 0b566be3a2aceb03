"""What must hold after notebook 10 has run, in its kernel."""

from math import radians, tan

# The variables of the program, and those that were named, alone.
used = {int(number) for number in re.findall(r"#(\d+)", expansion.text)}
assert used <= {100, 101, *range(140, 161)}

if runs[95] is not None:
    for size, (motions, said) in runs.items():
        block = f"G111 X{size}. A180. K-30. B120. P5. Q5."
        contour = contoursolve.solve(block, start="X40. Z0.").answers[0].contour
        assert bool(said) == (contour is None)
        assert not motions or abs(motions[-1][1] - contour.end[0]) < 1e-3
    # By hand: line 2 is 10 / sin(60 deg) long, and a rounding of 20 takes 20 * tan(30 deg) of it.
    assert 20 * tan(radians(30)) + 5 * tan(radians(30)) > 10 / 0.866
    assert made[0] == []
    assert "CORNERS OVERLAP" in made[1]
