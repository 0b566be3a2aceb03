"""The only modules that know sympy and casadi."""
