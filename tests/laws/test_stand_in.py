"""The stand-in for CasADi, with which tests open the page without Python, finds what CasADi finds."""

import json
import os
import subprocess
import sys
from math import dist
from pathlib import Path
from random import Random

import generate_fanuc
import generate_slips
import generate_typing
import pytest

STAND_INS = Path(__file__).parents[1] / "support" / "stand_ins" / "python"
SOLVING = """
import json, sys
import casadi
from contoursolve import solve

found = [casadi.__file__]
for text, control in json.load(sys.stdin):
    result = solve(text, control=control)
    told = [[each.code, [[fix.replacement, fix.effect] for fix in each.fixes]] for each in result.diagnostics]
    found.append([told, [[each.status.value, each.contour and each.contour.end] for each in result.answers]])
json.dump(found, sys.stdout, default=str)
"""


def random_blocks(rng: Random, count: int) -> list[tuple[str, str]]:
    """Sound blocks, mistyped ones and spoilt ones of every form."""
    found: list[tuple[str, str]] = []
    while len(found) < count:
        for form in generate_slips.FORMS.values():
            spoilt = form(rng)
            found.append((spoilt.text, spoilt.control))
        sound = generate_typing.random_sound(rng, rng.choice(generate_typing.FORMS))
        slip = generate_typing.random_slip(sound, rng)
        found += [(sound.text(), sound.control), (slip.text if slip else sound.text(), sound.control)]
        program = generate_fanuc.random_lathe(rng, rng.randint(2, 3))
        found.append(("\n".join(generate_fanuc.disturbed(rng, program, list("XUZWIKR"))), "fanuc-lathe"))
    return found[:count]


def findings(blocks: list[tuple[str, str]], *folders: Path) -> list:
    path = os.pathsep.join([*map(str, folders), *filter(None, sys.path)])
    done = subprocess.run(
        [sys.executable, "-c", SOLVING],
        input=json.dumps(blocks),
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": path},
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.slow
def test_with_the_stand_in_for_casadi_blocks_come_to_the_same() -> None:
    blocks = random_blocks(Random(20), 20)
    (casadi, *wanted), (stand_in, *found) = findings(blocks), findings(blocks, STAND_INS)
    assert (Path(casadi).parent.name, Path(stand_in).parent.name) == ("casadi", STAND_INS.name)
    for (text, _), (told, answers), (other_told, other_answers) in zip(blocks, wanted, found, strict=True):
        assert other_told == told, text
        assert [status for status, _ in other_answers] == [status for status, _ in answers], text
        for (_, end), (_, other) in zip(answers, other_answers, strict=True):
            assert (end is None) == (other is None), text
            assert end is None or dist(end, other) <= 1e-9, text
