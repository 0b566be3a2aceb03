"""What must hold after notebook 05 has run, in its kernel."""

assert expansion.summary.left == []
assert expansion.summary.unfamiliar == []
assert expansion.summary.deviation < 1e-4
assert all(answer.status.value == "solved" for answer in result.answers)

# By hand: the line at 120 degrees goes from Y-10 to Y20, so it ends 30 / tan(60 deg) to the left of X60.
assert "G01 X42.6795 Y20" in after

if motions is not None:
    ways = [(x, y) for _, x, y in motions]
    for answer in result.answers:
        for element in answer.contour.elements:
            x, y = element.end
            assert min(max(abs(x - at[0]), abs(y - at[1])) for at in ways) < 2e-4

lines = written_out.text.splitlines()
assert not any("M98" in line or "#" in line for line in lines)
# A block number of the subprogram would stand twice: it is left out.
assert [line for line in lines[24:] if line.startswith("G01 X60. Z-")] == ["G01 X60. Z-54.509", "G01 X60. Z-70.509"]
assert [(each.caller.cycle, each.caller.line) for each in turned.profiles] == [("G71", 11), ("G70", 21)]
