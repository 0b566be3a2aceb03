"""What must hold after notebook 06 has run, in its kernel."""

assert str(system.condition) == "sin(A - B)"
assert (system.rank, [len(step.unknowns) for step in system.steps]) == (4, [1, 1, 2])

# By hand: V1 lies on X40, 30 / tan(60 deg) before the end.
by_hand = -47.3205 + 30 / numpy.tan(numpy.radians(60))
found = outputs["points"].full()[0]
assert abs(found[0] - by_hand) < 1e-9
assert numpy.allclose(answer.contour.points["V1"], found, rtol=0, atol=1e-9)
assert abs(float(outputs["conditions"]) - numpy.sin(numpy.radians(180 - 120))) < 1e-12

# One of the 14,641 is our block.
row = (ANGLES["A"] == 180).argmax(), (ANGLES["B"] == 120).argmax()
assert abs(family["V1 Z"][row] - by_hand) < 1e-9
assert family["status"][row] == 0
