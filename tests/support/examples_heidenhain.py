"""Worked examples of free contour programming, as whole programs."""

from vectors import program_of

PROGRAMS = {
    "g1": """\
0 BEGIN PGM FKEXAMP1 MM
5 L X-20 Y-20 R0 FMAX
8 L X+0 Y+0 RL F250
9 RND R1
10 FPOL X+50 Y+20
11 FL LEN64.5 CLSD+ P1X+15 P1Y+35
12 FSELECT 1
13 FL PR+67 AN+21
14 FL IX+15 IY+0
15 FL LEN 40 PAR 11
16 FSELECT 2
17 FL X+75 Y+20
18 FL CLSD-
19 END PGM FKEXAMP1 MM
""",
    **{name.lower(): program_of("heidenhain", f"HF-{name}") + "\n" for name in ("G2", "G3", "G6")},
    "g5": program_of("heidenhain", "HF-G5-belt") + "\n",
}
