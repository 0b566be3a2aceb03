"""Random actions: the desk raises nothing, keeps the reader's text, and its memory does not grow."""

import gc
import random
import sys
import threading
from base64 import b64encode
from itertools import accumulate

import pytest
from editor import random_edit
from workbench_page import Page, units

from contoursolve.controls import CONTROLS
from contoursolve.workbench import Desk
from contoursolve.workbench.desk import ACTIONS, MOST_WINDOWS

NAMES = ("a.nc", "b.h", "c.mpf", "../d.nc", "con", "")
JUNK = (None, True, -1, 10**30, 1.5, "", "\ud800", "x" * 1_000, [], [[]], {}, {"do": "move"}, [None], "\0", "Ø\r\n(")
FIELDS = ("program", "seq", "edits", "text", "name", "line", "action", "finding", "fix", "control", "values", "tool")
EXPLORING = ("move", "free", "fix", "select", "write", "pin", "undo", "redo", "cancel", "range", "section", "junk")
QUICK = sorted({*ACTIONS} - {"report", "png", "dxf", "verify", "convert", "variables", "tool", "drawing", "fix_all"})


class RandomPage(Page):
    """A page whose reader does anything."""

    def step(self, draw):
        roll = draw.random()
        if roll < 0.1 and self.program:
            self.type_anything(draw)
        elif roll < 0.13:
            self.open_anything(draw)
        elif roll < 0.15 and self.program:
            self.explore_anything(draw)
        elif roll < 0.5:
            fields = {name: draw.choice(JUNK) for name in draw.sample(FIELDS, draw.randrange(4))}
            self.desk.answer({"window": self.window, "do": draw.choice((*QUICK, "none")), **fields})
            self.renew()
        else:
            do = draw.choice(QUICK if draw.random() < 0.97 else sorted(ACTIONS))
            self.ask(do, finding=draw.randrange(3), fix=draw.randrange(3), line=draw.randrange(1, 9), to="fanuc-lathe")
            self.renew() if do in ("close", "open") else None

    def renew(self):
        """Take the program as the desk has it."""
        if "trouble" in self.ask("view"):
            self.program = ""

    def open_anything(self, draw):
        roll = draw.random()
        if roll < 0.6:
            self.ask("open", example=draw.choice([*CONTROLS]))
        elif roll < 0.8:
            self.ask("open", name=draw.choice(NAMES), base64=b64encode(draw.randbytes(draw.randrange(60))).decode())
            self.renew()
        else:
            self.ask("open", name=draw.choice(NAMES))

    def type_anything(self, draw):
        lines = self.text.split("\n")
        begin, end, new = random_edit(lines, draw)
        starts = [0, *accumulate(units(line) + 1 for line in lines)]
        first, last = (
            min(starts[line] + column - 1, starts[line + 1] - 1)
            for line, column in ((min(line, len(lines)) - 1, column) for line, column in (begin, end))
        )
        if first <= last and self.text.isascii():
            new = new.replace("\r\n", "\n").replace("\r", "\n")
            self.text = self.text[:first] + new + self.text[last:]
            self.ask("edit", edits=[{"from": first, "to": last, "text": new}])

    def explore_anything(self, draw):
        line = draw.randrange(1, self.text.count("\n") + 2)
        action = {"do": draw.choice(EXPLORING), "key": draw.choice("XPKAZ"), "is_held": draw.random() < 0.5}
        action |= {"values": {draw.choice("XPKAZ"): draw.choice((1.0, -5, "x", 1e9))}, "finding": 0, "fix": 0}
        action |= {"solution": draw.randrange(3), "text": "G111 X90. A180. K-30. B120.", "name": "calculation"}
        self.ask("look", line=line)
        self.ask("act", line=line, action=action)


class CheckedDesk(Desk):
    """A desk whose replies are those of an action that was understood, or refused with a reason."""

    def answer(self, action, **options):
        reply = super().answer(action, **options)
        assert "please report it" not in reply.get("trouble", ""), (action, reply)
        return reply


def size_of_all() -> int:
    gc.collect()
    return sum(map(sys.getsizeof, gc.get_objects()))


def walk(folder, steps, seed):
    """Random actions in more windows than the desk knows; the sizes of everything that is held, after each quarter."""
    (folder / "a.nc").write_bytes(b"G00 X40. Z0.\r\nG111 X100. A180. K-30. B120. P60.\r\n" * 3)
    draw, desk, sizes = random.Random(seed), CheckedDesk(folder), []
    pages = [RandomPage(desk, f"window {number}") for number in range(MOST_WINDOWS + 3)]
    for step in range(steps):
        page = draw.choice(pages)
        page.step(draw)
        if page.program and "is_gone" in (seen := page.ask("view")):
            page.program = ""
        elif page.program:
            assert seen["text"] == page.text, step
        page.view = {}
        if (step + 1) % (steps // 4) == 0:
            sizes.append(size_of_all())
    return sizes


@pytest.mark.slow
def test_memory_stays_flat_over_many_random_actions(tmp_path):
    sizes = walk(tmp_path, 200, 2)
    assert max(sizes[2:]) < 1.1 * max(sizes[:2])


@pytest.mark.slow
def test_windows_at_the_same_time_find_what_each_finds_alone(tmp_path):
    desk, differences = CheckedDesk(tmp_path), []

    def work(number):
        draw, page = random.Random(number), RandomPage(desk, f"window {number}")
        for _ in range(40):
            page.open_anything(draw) if not page.program or draw.random() < 0.2 else page.type_anything(draw)
            if page.program and page.view["control"]:
                alone = Page(CheckedDesk()).ask(
                    "open", name=page.view["name"], text=page.text, control=page.view["control"]["name"]
                )
                differences.extend([page.text] * (alone["findings"] != page.ask("view")["findings"]))
        differences.append("")

    working = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for each in working:
        each.start()
    for each in working:
        each.join()
    assert differences == [""] * 4
