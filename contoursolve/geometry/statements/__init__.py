"""Further facts about a drawing: statements, their textual form, and the draft that they add to.

A text such as `length of line 1 = 30` comes in, facts of a profile go out. Begin with `statement`.
"""
