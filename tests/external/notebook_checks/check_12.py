path = tool.runs[0].path
assert [each.kind.name for each in tool.runs[0].faults] == []
assert [round(each.radius, 4) for each in path.elements if hasattr(each, "radius")] == [0.8, 1.2, 0.8]
assert [each.end for each in path.elements][-1] == path.end
assert len([each for each in tool.findings if "without G42" in each.message]) == 3
assert [run.path is None for run in neck.tool.runs] == [True]
assert "interference: 4 mm" in picture.svg
