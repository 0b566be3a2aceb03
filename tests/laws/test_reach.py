"""What no edit of other blocks can mend is told without a trial, and all that is told is what all trials tell."""

import pytest
from examples import law
from hypothesis import strategies as st

from contoursolve import check
from contoursolve.diagnosis.reach import Reach

CONTROLS = ("siemens-840d", "nct-99m", "fanuc-lathe", "fanuc-mill", "mitsubishi", "heidenhain")
HEADS = {
    "siemens-840d": "G17 G90 G0 X0 Y0\nG1 F500\n",
    "nct-99m": "G17 G90 G00 X0. Y0.\nG41 D1 G01 F500.\n",
    "fanuc-lathe": "G18 G00 X0. Z0.\nG01 F500.\n",
    "heidenhain": "L X+0 Y+0 R0 F500\n",
}
MILL = "G17 G90 G00 X0. Y0.\nG01 F500.\n"
SIZES = st.sampled_from([1, 1, 1, 2, 40, 0.001])
BLOCKS = st.tuples(
    st.sampled_from(["both", "first", "second", "steps", "pair"]),
    st.integers(5, 30),
    st.sampled_from([0, 0, 10, -7]),
    st.sampled_from(["R", "R", "C", ""]),
    SIZES,
)
MISTAKES = st.lists(
    st.tuples(st.integers(0, 99), st.integers(0, 9), st.sampled_from(["drop", "digit", "sign", "twice"])), max_size=3
)


def block_texts(control: str, blocks) -> list[str]:
    """The lines of a chain, each of them possible where it stands."""
    texts, x, y = list[str](), 0.0, 0.0
    for kind, first, second, shape, size in blocks:
        start = x, y
        x, y = x + (kind != "second") * first, y + (kind not in ("first", "pair")) * (second or 5 * (kind == "second"))
        if control == "heidenhain":
            step = f"IX{x - start[0]:+.3f} IY{y - start[1]:+.3f}"
            texts.append("L " + (step if kind == "steps" else f"X{x:+.3f} Y{y:+.3f}"))
            texts += [f"RND R{size}" if shape == "R" else f"CHF {size}"] if shape else []
            continue
        one, other = ("Z", "X") if control == "fanuc-lathe" else ("X", "Y")
        corner = {"siemens-840d": {"R": " RND={}", "C": " CHR={}"}}.get(control, {"R": " ,R{}", "C": " ,C{}"})
        tail = corner[shape].format(float(size)) if shape else ""
        angle = {"siemens-840d": "ANG={}", "mitsubishi": "A{}"}.get(control, ",A{}")
        words = {
            "first": f"{one}{x:.3f}",
            "second": f"{other}{y:.3f}",
        }
        if kind == "pair" and control != "fanuc-mill":
            texts += [angle.format("30.") + tail, f"{one}{x:.3f} {other}{y:.3f} {angle.format('-30.')}" + tail]
        else:
            texts.append(words.get(kind, f"{words['first']} {words['second']}") + tail)
    return texts


def spoiled(texts: list[str], mistakes) -> list[str]:
    """The lines with words dropped, mistyped or repeated."""
    texts = list(texts)
    for number, position, how in mistakes:
        line = number % len(texts)
        words = texts[line].split(" ")
        place = position % len(words)
        if how == "drop" and len(words) > 1:
            del words[place]
        elif how == "digit":
            words[place] = words[place].replace("1", "7", 1)
        elif how == "sign":
            words[place] = words[place].replace("-", "", 1)
        else:
            words.append(words[place])
        texts[line] = " ".join(words)
    return texts


@pytest.mark.slow
@law(st.sampled_from(CONTROLS), st.lists(BLOCKS, min_size=8, max_size=12), MISTAKES, few=2, many=3)
def test_what_is_told_without_a_trial_is_what_trials_tell(control, blocks, mistakes):
    end = {"fanuc-lathe": "Z999.", "heidenhain": "L X+999", "siemens-840d": "X999"}.get(control, "X999.")
    text = HEADS.get(control, MILL) + "\n".join(spoiled(block_texts(control, blocks), mistakes)) + f"\n{end}\n"
    quick = check(text, control=control)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Reach, "leaves_a_problem", lambda _self, _edits, **_options: False)
        assert check(text, control=control) == quick
