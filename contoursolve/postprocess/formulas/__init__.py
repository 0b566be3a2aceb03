"""Contours whose words hold variables, as formulas of these variables in the macro language of a control.

A program comes in, with sample values of its variables; what a control runs by itself goes out. Begin with
`expander.FormulaExpander`. `lines` reads words that hold variables, `given` says how values of a contour follow them,
`contour` makes statements of a contour, `scratch` gives them variables, `targets` writes them, `check` runs them.
"""
