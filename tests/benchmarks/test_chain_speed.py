"""How long contours of hundreds and thousands of elements take, with a mistake and without, and how that grows."""

import sys
from time import process_time

import pytest
from long_chains import angles, corners, klartext
from test_expand_speed import spent

from contoursolve import solve

SIZES = (50, 100, 200, 300)

CHAINS = {
    "an FK chain, a word twice": (klartext, "twice", "heidenhain"),
    "an FK chain, a word that disagrees": (klartext, "disagrees", "heidenhain"),
    "an FK chain, a word missing": (klartext, "missing", "heidenhain"),
    "an NCT chain, an angle reversed": (angles, "reversed", "nct-99m"),
    "an NCT chain, a corner too large": (angles, "large", "nct-99m"),
}

CORNERS = {
    "corners": ("nct-99m", 5.0),
    "corners of FK": ("heidenhain", 5.0),
    "corners of a lathe": ("fanuc-lathe", 5.0),
    "no corner on a line": ("siemens-840d", 0.0),
    "no corner on a line, NCT": ("nct-99m", 0.0),
}


def seconds(text: str, control: str) -> float:
    begin = process_time()
    solve(text, control=control)
    return process_time() - begin


@pytest.mark.parametrize("what", CHAINS)
def test_a_mistake_in_a_chain_costs_no_more_than_its_length(what, told, growth):
    chain, mistake, control = CHAINS[what]
    seconds(chain(20, mistake), control)
    # Once each: what was solved before is known.
    found = {size: seconds(chain(size, mistake), control) for size in SIZES}
    right = seconds(chain(SIZES[-1] + 2), control)
    told(
        f"{what}, {SIZES[-1]} elements", f"{found[SIZES[-1]]:.2f} s", f"{found[SIZES[-1]] / right:.0f} times the right"
    )
    assert growth(what, found) <= 1.5


@pytest.mark.parametrize("what", CORNERS)
def test_thousands_of_corners_take_time_and_memory_by_their_number(what, told, growth, tmp_path):
    control, rise = CORNERS[what]
    time, memory = dict[int, float](), dict[int, float]()
    for number in (400, 800, 1_600, 3_200):
        path = tmp_path / f"{number}.nc"
        path.write_text(corners(number, control, rise), encoding="ascii")
        # What is wrong is no error of the command.
        script = f"import contoursolve as c; c.solve(open({str(path)!r}).read(), control={control!r})"
        time[number], memory[number] = spent(sys.executable, "-c", script)
    told(f"{what}, 3,200", f"{time[3_200]:.1f} s", f"{memory[3_200]:.0f} MB, {memory[400]:.0f} MB for 400")
    assert growth(what, time) <= 1.5
    assert memory[3_200] - memory[400] <= 9 * (memory[800] - memory[400])
