"""What must hold after notebook 06 has run, in its kernel."""

A, B = (symbols.direction(letter) for letter in "AB")
assert sympy.simplify(determinant**2 - (A[1] * B[0] - A[0] * B[1]) ** 2) == 0  # sin(A - B), up to its sign
assert verdict.condition == "sin(A - B)"
assert [len(step.unknowns) for step in construction.steps] == [1, 1, 2]

# By hand: V1 lies on X40, 30 / tan(60 deg) before the end.
by_hand = -47.3205 + 30 / numpy.tan(numpy.radians(60))
assert abs(outputs["V1.0"] - by_hand) < 1e-9
assert numpy.allclose(answer.contour.points["V1"], (outputs["V1.0"], outputs["V1.1"]), rtol=0, atol=1e-9)
assert abs(outputs["determinant:2"] ** 2 - numpy.sin(numpy.radians(180 - 120)) ** 2) < 1e-12

# One of the 14,641 is our block.
row = (ANGLES["A"] == 180).argmax(), (ANGLES["B"] == 120).argmax()
assert abs(family["V1.Z"][row] - by_hand) < 1e-9
assert family["status"][row] == 0
