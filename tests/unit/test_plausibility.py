"""The model that orders fixes: what its weights are worth, and that the order of words in a block changes nothing."""

import json
from importlib import import_module
from pathlib import Path

import pytest

from contoursolve import solve

plausibility = import_module("contoursolve.diagnosis.plausibility")
Feature, FEATURES = plausibility.Feature, plausibility.FEATURES
SLIPS = {each["id"]: each for each in json.loads((Path(__file__).parents[1] / "slips" / "by_hand.json").read_text())}

PROGRAMS = {
    "centre": ("fanuc-mill", "G17 G90|G00 X0. Y0.|G01 X60. ,R4. F300|G02 X60. Y50. I15. J-25. ,R4.|G01 X0.|Y0."),
    "two corners": ("nct-99m", "G17 G90|G0 X0 Y0|G1 X55 ,R6 F200|Y35 ,C3 ,R1|X0 Y12"),
    "circle": ("nct-99m", "G17 G0 X90 Y0|G42 G1 X50 D0|G3 X-50 Y0 R55|G1 X-50 Y42.857 ,A171.87 Q-1|G40 G0 Y70"),
    "turn": ("yasnac-lx3", "G00 X40. Z0.|G111 A400. K-30. B120. X100."),
}
"""Controls and programs, besides those of the corpus."""

DECIDES = {
    Feature.KIND: ("ya-spindle-01", "write K-28. for I-28."),
    Feature.ROUND: ("nc-plate-02", "write ,R8 for ,R88"),
    Feature.NEAR: ("ya-flange-02", "write I15. for K15."),
    Feature.FAMILIAR: ("fm-frame-02", "write Y65. for Y56."),
    Feature.POINTS: ("circle", "write R50 for R55"),
    Feature.TURNS_BACK: ("fl-full-03", "write Z-25. for Z-52."),
    Feature.INWARD: ("fl-cone-06", "write X70. for X7."),
    Feature.TURNING: ("nc-cam-03", "write I-40 for I40"),
    Feature.WIDE: ("centre", "write J25. for J-25."),
    Feature.ACROSS: ("turn", "write A200. for A400."),
    Feature.LARGE: ("two corners", "delete ,R1"),
    Feature.LONG: ("nc-hook-08", "write X10 for X-10"),
    Feature.SAME: ("mi-lever-02", "write A350. for A170."),
}
"""A slip, and its first fix, for each feature that decides which fix comes first."""

DECIDES_BEHIND = {Feature.BEHIND_START, Feature.WARNING, Feature.SEEN}
"""Those that order only the fixes behind the first one, as far as the corpora of slips tell; the first of them also
tells what is suspected."""


def first_fix(name: str, lines: list[str] | None = None) -> str:
    if name in PROGRAMS:
        control, text = PROGRAMS[name]
        found = solve(text.replace("|", "\n"), control=control).diagnostics
    else:
        entry = SLIPS[name]
        settings = dict(each.split("=", 1) for each in entry["settings"])
        text = "\n".join(lines or entry["slip"])
        found = solve(f"{text}\n", control=entry["control"], settings=settings).diagnostics
    return next((fix.description for each in found for fix in each.fixes), "")


def test_every_feature_has_a_weight_above_zero_and_a_reason():
    assert FEATURES.keys() == set(Feature) == DECIDES.keys() | DECIDES_BEHIND
    assert all(weight > 0 and reason for weight, reason in FEATURES.values())


@pytest.mark.parametrize("feature", DECIDES, ids=lambda feature: feature.value)
def test_without_its_weight_another_fix_comes_first(feature, monkeypatch):
    name, expected = DECIDES[feature]
    assert first_fix(name).startswith(expected)
    monkeypatch.setitem(FEATURES, feature, (0.0, FEATURES[feature][1]))
    assert not first_fix(name).startswith(expected)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ya-spindle-01", "nc-plate-02", "ya-flange-02", "mi-lever-02"])
def test_the_first_fix_is_the_same_in_whatever_order_words_stand(name):
    lines = [line.split() for line in SLIPS[name]["slip"]]
    numbers = [[word for word in line[:1] if word.startswith("N")] for line in lines]
    turned = [" ".join((*number, *reversed(line[len(number) :]))) for number, line in zip(numbers, lines, strict=True)]
    assert first_fix(name, turned) == first_fix(name)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("he-wing-01", "write FLT for FL"),
        ("he-star-02", "add PA?"),
        ("he-plate-02", "write RND for RDN"),
        ("hm-slot-06", "write I25. for I85. (the centre counted from the start)"),
        ("nc-hook-02", "write I10 for I0; write J0 for J-40"),
        ("ya-bush-03", "write Z-70. for Z-7."),
        ("fl-full-08", "write X46. for X-46. (a minus sign too many)"),
        ("hl-axle-09", "write Z-52. for X-52."),
        ("fm-bracket-01", "write G91 for G90"),
    ],
)
def test_the_first_fix_undoes_the_slip(name, expected):
    assert first_fix(name).startswith(expected)
