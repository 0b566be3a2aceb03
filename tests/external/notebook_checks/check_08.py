"""What must hold after notebook 08 has run, in its kernel."""

EXPECTED = [(-27.114, 20.0), (-31.444, 22.5), (-47.321, 50.0)]
for control, answer in paths.items():
    found = [each.end for each in answer.contour.elements]
    assert len(found) == len(EXPECTED), control
    assert all(
        abs(a - b) < 1e-3 for one, two in zip(found, EXPECTED, strict=True) for a, b in zip(one, two, strict=True)
    )

errors = {
    control: contoursolve.check(text.replace(LOST[control], ""), control=control) for control, text in PART.items()
}
assert all(any(each.severity is contoursolve.Severity.ERROR for each in found) for found in errors.values())
for control in ("fanuc-lathe", "siemens-840d"):
    assert contoursolve.convert(PART["yasnac-lx3"], control, settings=LATHE).text
