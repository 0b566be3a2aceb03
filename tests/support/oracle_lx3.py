"""YASNAC LX3 G112 (arc with two corners), G11 (bevelling) and G12 (rounding) from the control sheet alone.

No import of the package. A place is a complex number: real is Z, imaginary is X as radius; mm. Words come as the
control reads them: X and U are diameters, I a radius value.

G112, turning form (X or U). Words mean what the sheet's table says (p.144-146): S is the start, C = S + (K, I)
the centre, I a radius value, R the arc's radius, X the line on which corner 2 lands.
1. Line 1 runs from S parallel to Z, the way of the sign of K (derived). It meets the circle of radius R about C
   first at V1 (derived), on the near side of C. A start past that place would have to back up: refused (derived;
   146 "moves away").
2. The last place V2 is where the line parallel to Z at the programmed X meets the circle beyond C, seen along the
   travel (derived).
3. The arc from V1 to V2 does not back up (derived), so it never turns round in Z and stays on one side of C in X:
   on the side of S. S nearer the axis than C gives a hollow that dips towards the axis, S farther a crown that
   bulges from it. With the travel towards -Z a hollow is cw and a crown ccw, with +Z the other way round.
   S and the landing line on opposite sides of C: every arc between V1 and V2 backs up: refused (derived).
   S at the height of C (I0): the landing line decides, either side being free of backing up. Both at that height:
   two half circles, nothing chooses; this is nobody's to judge (`is_near`).
4. Corner 1 (P fillet, C bevel) at V1, corner 2 (Q, D) at V2 against the line parallel to Z through V2, which goes
   on the way of the sign of K (derived: it does not back up) and is not cut. A bevel is a 45 degree segment, |dZ| =
   |dX radius| = amount (derived for G111, assumed here). It goes the way of the line in Z and the way of the arc at
   the corner in X (assumed: quadrant by directions of travel, as for G111's corner 2).
5. The facing form (Z or W) is the same with the axes exchanged: line 1 parallel to X by the sign of I, landing at
   the programmed Z (derived).
Assumed: exactly one of X U Z W, and I, K and R all given; one corner word a corner; an amount of 0 is no corner;
negative amounts, R not above 0 and other words than F are refused by rule (printed: 144, 145 for words); G112 is
not modal, as G111; corners that do not fit are refused (derived for G111); K0 in the turning form (I0 in the facing
form) has no way to go and is refused (146).

The manual's example, by hand: `G01 X100. Z-50.` puts S at (-50, 50); `G112 U0 I10. K-50. P5. Q5. R30.` puts C at
(-100, 60), above S, so the arc is a hollow. V1 is sqrt(30^2 - 10^2) = 28.2843 before C: (-71.7157, 50); U0 lands at
the same X: V2 = (-128.2843, 50). The tool goes to -Z, so the arc is cw, down to X radius 30 at Z-100 and up again.
P5 turns left (ccw), outside the circle: its centre is at X radius 50 - 5 = 45, 35 from C: sqrt(35^2 - 15^2) =
31.6228, so (-68.3772, 45); it leaves line 1 at Z-68.3772 and joins the arc at C + 30/35 of that way: (-72.8948,
47.1429). Q5 mirrors it: (-127.1052, 47.1429) to (-131.6228, 50), the end. With `C5. D5.`: the bevel reaches the arc
at X radius 45, sqrt(30^2 - 15^2) = 25.9808 from C: (-69.0192, 50) to (-74.0192, 45), and (-125.9808, 45) to
(-130.9808, 50).

G11, G12 (printed: one axis a block, X(U) with K or Z(W) with I, the sign is the way the corner leaves the axis,
|K| <= |U/2|, |I| <= |W|, no or zero I/K and both axes are errors). The tool ends at the programmed coordinate,
displaced in the other axis by the amount (derived). So it goes along the axis until the amount is left, then a
45 degree segment (G11) or a quarter circle tangent to the axis line (G12). The sheet's example from X30. Z0.:
`G11 Z-20. I8.` goes (-12, 15), (-20, 23); `X80. K-7.` goes on to (-20, 33), (-27, 40).
"""

import re
from collections.abc import Sequence
from decimal import Decimal
from math import sqrt

from oracle import Element, Outcome, Words, _RefusedError as Refused, sign
from oracle_corners import Corner, connect

FAR = 1e6
"""mm. The third line has no end of its own, so no corner is too long for it."""


def g112(start: complex, words: Words) -> Outcome:
    """The arc with its corners.

    >>> example = {"U": 0, "I": 10, "K": -50, "P": 5, "Q": 5, "R": 30}
    >>> f"{g112(-50 + 50j, example).end:.4f}"
    '-131.6228+50.0000j'
    """
    outcome = Outcome(end=start)
    ends = words.keys() & set("XUZW")
    is_legal = (
        len(ends) == 1
        and words.keys() >= set("IKR")
        and words.keys() <= set("XUZWIKRPCQDF")
        and not any(words.keys() >= pair for pair in ({"C", "P"}, {"D", "Q"}))
        and all(words.get(name, 0) >= 0 for name in "CPDQ")
        and words["R"] > 0
    )
    if not is_legal:
        outcome.status = "rejected"
        return outcome
    (name,) = ends
    center = start + complex(float(words["K"]), float(words["I"]))
    landing = float(words[name]) / (2 if name in "XU" else 1)
    if name == "U":
        landing += start.imag
    if name == "W":
        landing += start.real
    try:
        if name in "XU":
            _turning(start, center, landing, words, outcome)
        else:
            _turning(_exchanged(start), _exchanged(center), landing, words, outcome)
        outcome.status = "solved"
    except Refused as refused:
        outcome.status = refused.args[0]
    if name in "ZW":
        outcome.points = {point: _exchanged(at) for point, at in outcome.points.items()}
        outcome.elements = [_mirrored(element) for element in outcome.elements]
        outcome.end = _exchanged(outcome.end)
    return outcome


def _turning(start: complex, center: complex, landing: float, words: Words, outcome: Outcome) -> None:
    radius, onward = float(words["R"]), sign((center - start).real)
    outcome.need_length(abs((center - start).real))
    near, far = start.imag - center.imag, landing - center.imag
    outcome.need(radius - abs(near))
    outcome.need(radius - abs(far))
    outcome.is_near |= any(1e-10 < abs(height) < 1e-6 for height in (near, far))
    sides = {sign(height) for height in (near, far) if abs(height) > 1e-10}
    v1 = center + complex(-onward * sqrt(max(0.0, radius**2 - near**2)), near)
    v2 = center + complex(onward * sqrt(max(0.0, radius**2 - far**2)), far)
    outcome.points = {"V1": v1, "V2": v2}
    outcome.need(onward * (v1 - start).real)
    if len(sides) != 1:
        outcome.is_near |= not sides
        outcome.need(-1)
    outcome.need_length(abs(v2 - v1))
    (side,) = sides
    sharp = [
        Element("line", start, v1),
        Element("arc", v1, v2, center, radius, "ccw" if side != onward else "cw"),
        Element("line", v2, v2 + onward * FAR),
    ]
    # Away from C on the way out of line 1 is the side; the arc comes back from there to the landing line.
    corners = {}
    for k, fillet, bevel, quadrant in ((0, "P", "C", complex(onward, side)), (1, "Q", "D", complex(onward, -side))):
        for word, kind in ((fillet, "R"), (bevel, "B")):
            if words.get(word):
                corners[k] = Corner(kind, float(words[word]), quadrant)
    connect(sharp, corners, outcome)
    third = outcome.elements.pop()
    outcome.end = third.start


def _exchanged(at: complex) -> complex:
    return complex(at.imag, at.real)


def _mirrored(element: Element) -> Element:
    start, end = _exchanged(element.start), _exchanged(element.end)
    if element.center is None:
        return Element("line", start, end)
    turn = "cw" if element.turn == "ccw" else "ccw"
    return Element("arc", start, end, _exchanged(element.center), element.radius, turn)


def g11(start: complex, words: Words) -> Outcome:
    """Along one axis, then a bevel of 45 degrees.

    >>> g11(15j, {"Z": -20, "I": 8}).end
    (-20+23j)
    """
    return _leave(start, words, is_round=False)


def g12(start: complex, words: Words) -> Outcome:
    """Along one axis, then a quarter circle.

    >>> g12(15j, {"Z": -20, "I": 8}).elements[1].center
    (-12+23j)
    """
    return _leave(start, words, is_round=True)


def _leave(start: complex, words: Words, *, is_round: bool) -> Outcome:
    outcome = Outcome(status="rejected", end=start)
    named = words.keys() - {"F"}
    amount = float(words.get("I", words.get("K", 0)))
    if named not in ({"X", "K"}, {"U", "K"}, {"Z", "I"}, {"W", "I"}) or amount == 0:
        return outcome
    (name,) = named - {"I", "K"}
    value = float(words[name]) / (2 if name in "XU" else 1)
    if name in "XU":
        travel, aside = 1j * (value - (start.imag if name == "X" else 0)), complex(amount)
    else:
        travel, aside = complex(value - (start.real if name == "Z" else 0)), 1j * amount
    try:
        outcome.need(abs(travel) - abs(amount))
    except Refused as refused:
        outcome.status = refused.args[0]
        return outcome
    outcome.status = "solved"
    along = travel / abs(travel)
    leave, end = start + travel - abs(amount) * along, start + travel + aside
    outcome.go(Element("line", start, leave))
    if is_round:
        left = (along.conjugate() * aside).imag > 0
        outcome.go(Element("arc", leave, end, leave + aside, abs(amount), "ccw" if left else "cw"))
    else:
        outcome.go(Element("line", leave, end))
    return outcome


WORD = re.compile(r"([A-Z])\s*([-+]?(?:\d+\.?\d*|\.\d+))")
FORMS = {"112": g112, "11": g11, "12": g12}


def contours(program: Sequence[str]) -> list[Outcome]:
    """Reads a program in mm and follows each of its blocks of G112, G11, G12 and of G01 with I or K.

    A number without a decimal point counts in 0.001 mm (printed).
    """
    found: list[Outcome] = []
    at, in_force = 0j, "00"
    for line in program:
        words: dict[str, Decimal] = {}
        code = in_force
        for address, text in WORD.findall(line):
            if address == "G":
                code = text
                in_force = in_force if text == "112" else text  # G11 and G12 are modal; G112 like G111 is not (assumed)
            elif address != "N":
                words[address] = Decimal(text) * (1 if "." in text else Decimal("0.001"))
        is_bevel = code in ("1", "01") and bool(words.keys() & {"I", "K"})
        if code in FORMS or is_bevel:
            found.append((g11 if is_bevel else FORMS[code])(at, words))
            at = found[-1].end
        else:
            z, x = words.get("Z", at.real), words.get("X", 2 * at.imag) / 2
            at = complex(z, x) + complex(words.get("W", 0), words.get("U", Decimal(0)) / 2)
    return found
