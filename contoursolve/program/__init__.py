"""A whole program: followed line by line, its contours solved one by one or many together.

Blocks come in from `gcode`, steps with answers and findings go out. Begin with `pipeline`.
"""
