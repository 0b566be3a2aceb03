"""What must hold after notebook 11 has run, in its kernel."""

assert shaft.rank == 4
assert str(both.condition) == "sin(A - B)"
assert abs(both.subs(B=160).margin) < 1e-12
assert len(boss.system.solve().items) == 2
