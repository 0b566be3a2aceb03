"""Contours whose words hold variables, as formulas of these variables in the macro language of a control.

A program comes in, with sample values of its variables; lines that a control computes by itself go out. Begin with
`formula_expander`. `formula_lines` reads words that hold variables, and `word_dependence` finds how values follow them.
`contour_statements` makes statements of a contour, and `scratch_variables` gives them variables. `macro_targets`
writes them, and `trial_run` runs them.
"""
