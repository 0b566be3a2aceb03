"""Laws of fixes, completions and diagnoses on legal blocks that were broken in one of ten ways."""

import re
from dataclasses import dataclass, field
from decimal import Decimal
from functools import lru_cache
from itertools import product
from math import hypot
from random import Random
from typing import Any

import numpy
import pytest
from records import replace
from test_diagnosis import EQUATIONS, START, Words, answer_to, assert_layers_fit, block_of, rows_of, verdicts

from contoursolve import Answer, Severity
from contoursolve.diagnostics import Applicability

AGREEMENT = 0.001
"""mm or degrees: the least increment."""


@dataclass(frozen=True)
class Case:
    """A block with something wrong: words by address, what else is written in it, and how."""

    kind: str
    words: Words
    extra: tuple[str, ...] = ()
    with_comma: str = ""
    start: tuple[Decimal, Decimal] = (Decimal(40), Decimal(0))
    """X as diameter, Z."""
    order: tuple[int, ...] = field(default=())

    @property
    def text(self) -> str:
        words = []
        for name, value in self.words.items():
            text = f"{value:f}" if "." in f"{value:f}" else f"{value:f}.0"
            words.append(name + (text.replace(".", ",") if name == self.with_comma else text))
        words += self.extra
        return " ".join(["G111", *(words[index] for index in self.order or range(len(words)))])

    @property
    def start_text(self) -> str:
        return "X{:.4f} Z{:.4f}".format(*self.start)

    def solve(self, **options: str) -> Answer:
        return answer_to(self.text, start=self.start_text, **options)


def good_words(random: Random) -> tuple[Words, Answer]:
    """A legal block that is solved without a finding; in steps of 0.5 inch, so that inches write it exactly."""
    while True:
        first = random.sample("AIK", 2)
        second = random.choice(("BX", "BU", "BZ", "BW", "XZ", "UW", "XW"))
        if random.random() < 0.2:
            first, second = first[:1], random.choice(("BXZ", "BUW"))
        corners = random.choice(("", "P", "C", "PQ", "CD", "Q", "PD"))
        if "B" not in second or len(second) == 3:
            corners = corners.strip("QD")
        names = [*first, *second, *corners]
        random.shuffle(names)
        words = {name: random.choice((1, 2, 3)) * Decimal("0.254") if name in "CPDQ"
                 else Decimal(15 * random.randint(-11, 12)) if name in "AB"
                 else random.choice((-3, -2, -1, 1, 2, 3)) * Decimal("12.7") for name in names}  # fmt: skip
        answer = answer_to(block_of(words), depth="verdict")
        if answer.status.value == "solved" and not answer.diagnostics:
            return words, answer


def implied(words: Words, answer: Answer, name: str) -> Decimal:
    """The value that a word would have in the contour, to the least increment."""
    (v1z, v1x), (v2z, v2x) = answer.contour.points["V1"], answer.contour.points["V2"]
    value = {
        "A": numpy.degrees(numpy.arctan2(v1x - 20, v1z)),
        "I": v1x - 20, "K": v1z,
        "B": numpy.degrees(numpy.arctan2(v2x - v1x, v2z - v1z)),
        "X": 2 * v2x, "U": 2 * (v2x - 20), "Z": v2z, "W": v2z,
    }[name]  # fmt: skip
    return Decimal(f"{float(value):.3f}")


KINDS = (
    "missing", "agrees", "disagrees", "corner too large", "sign", "x and u", "c and p", "angle", "m08", "comma",
)  # fmt: skip


def broken(random: Random, kind: str) -> Case:
    while True:
        words, answer = good_words(random)
        lines = [name for name in words if name in EQUATIONS]
        twins = {"X": "U", "U": "X", "Z": "W", "W": "Z"}
        spare = [name for name in EQUATIONS if name not in words and twins.get(name, "-") not in words]
        angles = [name for name in "AB" if name in words]
        match kind:
            case "missing":
                gone = random.choice(lines)
                return Case(kind, {name: value for name, value in words.items() if name != gone})
            case "agrees" | "disagrees" if spare:
                name = random.choice(spare)
                off = Decimal("12.7") if kind == "disagrees" else 0
                return Case(kind, words | {name: implied(words, answer, name) + off})
            case "corner too large" if corners := [name for name in words if name in "CPDQ"]:
                return Case(kind, words | {random.choice(corners): Decimal(254)})
            case "sign":
                name = random.choice(lines)
                value = words[name]
                turned = value - 180 if value > 0 else value + 180
                return Case(kind, words | {name: turned if name in "AB" else -value})
            case "x and u" if "X" in words or "U" in words:
                return Case(kind, words | {name: implied(words, answer, name) for name in "XU" if name not in words})
            case "c and p" if "C" in words or "P" in words:
                return Case(kind, words | {name: Decimal("0.508") for name in "CP" if name not in words})
            case "angle" if angles:
                name = random.choice(angles)
                return Case(kind, words | {name: words[name] + random.choice((-720, 720))})
            case "m08":
                return Case(kind, words, ("M08",))
            case "comma":
                return Case(kind, words, with_comma=random.choice(list(words)))


@lru_cache
def broken_block(seed: int) -> tuple[Case, Answer]:
    case = broken(Random(seed), KINDS[seed % len(KINDS)])
    return case, case.solve()


BROKEN = pytest.mark.parametrize("seed", range(30))


def fixes_of(answer: Answer) -> tuple[Any, ...]:
    return tuple(fix for finding in answer.diagnostics for fix in finding.fixes)


def applied(answer: Answer) -> list[Any]:
    """The fixes that write numbers."""
    return [fix for fix in fixes_of(answer) if fix.applicability is not Applicability.PLACEHOLDER]


def same_contour(one: Any, other: Any) -> bool:
    if len(one.elements) != len(other.elements):
        return False
    pairs = [(a.end, b.end) for a, b in zip(one.elements, other.elements, strict=True)]
    pairs += [(one.points[name], other.points[name]) for name in one.points]
    return all(hypot(a[0] - b[0], a[1] - b[1]) <= AGREEMENT for a, b in pairs)


@BROKEN
def test_a_fix_does_what_it_says_and_removes_its_findings(seed):
    """It is solved, ends where it says, and is called safe exactly if it keeps the contour."""
    case, answer = broken_block(seed)
    old = {finding.code for finding in answer.diagnostics}
    reference = answer.contour or case.solve(rules="off").contour
    for fix in applied(answer):
        again = answer_to(fix.replacement, start=case.start_text)
        assert again.status.value == "solved", (case.text, fix)
        # A path that crosses the spindle axis, or turns far, may be meant.
        told = [each for each in again.diagnostics if each.code not in ("axis-crossed", "suspected")]
        for each in (each for each in told if each.severity is not Severity.INFO):
            assert each.code not in old, (case.text, fix, each.code)
            assert each.code.endswith("-ignored"), (case.text, fix, each.code)
            assert each.values["off_by_mm"] <= AGREEMENT, (case.text, fix)
        z, x = again.contour.end
        said = re.search(r"the contour ends at Z(\S+) mm X(\S+) mm", fix.description).groups()
        assert [float(each) for each in said] == pytest.approx([z, 2 * x], abs=0.0005 + 1e-9), (case.text, fix)
        is_same = reference is not None and same_contour(reference, again.contour)
        # What else the machine does is not the contour.
        is_kept = not re.search("delete [MSTF]", fix.description)
        assert (fix.applicability is Applicability.SAFE) == (is_same and is_kept), (case.text, fix)


@BROKEN
def test_every_single_word_whose_dropping_mends_a_block_is_offered_and_every_block_has_a_fix(seed):
    """Against trying each word."""
    case, answer = broken_block(seed)
    offered, words = {fix.replacement for fix in fixes_of(answer)}, case.text.split()
    assert offered or not answer.diagnostics or case.kind == "sign", case.text
    if not answer.diagnostics or case.kind == "comma":  # that word is corrected, not dropped
        return
    for index in range(1, len(words)):
        text = " ".join(words[:index] + words[index + 1 :])
        again = answer_to(text, start=case.start_text, depth="verdict")
        if again.status.value == "solved" and not again.diagnostics:
            # A list has at most four.
            assert text in offered or len(offered) == 4, (case.text, words[index])


NUMBERS = ("30.", "-30.", "120.", "5.", "-150.", "67.")


@BROKEN
def test_a_placeholder_makes_a_legal_determined_block_for_some_number(seed):
    case, answer = broken_block(seed)
    random = Random(seed)
    placeholders = [fix for fix in fixes_of(answer) if fix.applicability is Applicability.PLACEHOLDER]
    for fix in random.sample(placeholders, min(3, len(placeholders))):
        assert "the contour ends" not in fix.description
        texts = [re.sub(r"\?", lambda _: random.choice(NUMBERS), fix.replacement) for _ in range(12)]
        found = {answer_to(text, start=case.start_text, depth="verdict").status.value for text in texts}
        assert found & {"solved", "no-solution"}, (case.text, fix, found)
        assert "rejected" not in found, (case.text, fix)


# What does not change a diagnosis ---------------------------------------------------------------------


def mirrored(case: Case) -> Case:
    words = {
        name: 180 - value if name in "AB" else -value if name in "KZW" else value for name, value in case.words.items()
    }
    return replace(case, words=words, start=(case.start[0], -case.start[1]))


def shifted(case: Case) -> Case:
    by = {"X": Decimal(2000), "Z": Decimal(1000)}
    words = {name: value + by.get(name, 0) for name, value in case.words.items()}
    return replace(case, words=words, start=(case.start[0] + 2000, case.start[1] + 1000))


def shuffled(case: Case) -> Case:
    order = list(range(len(case.words) + len(case.extra)))
    Random(case.text).shuffle(order)
    return replace(case, order=tuple(order))


def in_inches(case: Case) -> Case:
    words = {name: value if name in "AB" else value / Decimal("25.4") for name, value in case.words.items()}
    return replace(case, words=words, start=(case.start[0] / Decimal("25.4"), case.start[1] / Decimal("25.4")))


def verdict(answer: Answer) -> dict[str, Any]:
    diagnosis = answer.diagnosis
    # Moved by 2 m, a path crosses the spindle axis no more, and other numbers are another one with its point moved.
    findings = [each for each in answer.diagnostics if each.code not in ("axis-crossed", "suspected")]
    return {
        "status": answer.status,
        "codes": {finding.code for finding in findings},
        "layers": diagnosis and verdicts(answer),
        "ties": diagnosis and {(frozenset(tie.addresses), tie.is_conflict) for tie in diagnosis.ties},
        "freedoms": diagnosis and {(each.point, each.direction is None) for each in diagnosis.freedoms},
        # How many there are depends on how numbers are written: slips of typing explain some of them.
        "fixes": any(each.fixes for each in findings),
    }


CHANGED = [
    (change, rules, number + len(KINDS) * (place % 4))
    for number in range(len(KINDS))
    for place, (change, rules) in enumerate(product((shuffled, mirrored, shifted, in_inches), ("enforce", "off")))
]
"""Each change under either policy of rules, of a block broken in each way."""


@pytest.mark.parametrize(("change", "rules", "seed"), CHANGED)
def test_diagnosis_does_not_depend_on_order_unit_mirror_image_or_shift(change, rules, seed):
    case, before = broken_block(seed)
    units = "inch" if change is in_inches else "mm"
    if change is in_inches and case.kind in ("agrees", "x and u"):
        return  # their values are rounded to the millimetre's least increment
    own = replace(case, start=(Decimal("38.1"), case.start[1])) if change is in_inches else case
    one = before if own == case and rules == "enforce" else own.solve(rules=rules)
    other = change(own).solve(rules=rules, units=units)
    assert verdict(one) == verdict(other), own.text
    if change is shuffled and rules == "enforce":
        assert_layers_fit(one)
        texts = [{frozenset(fix.replacement.split()) for fix in fixes_of(each)} for each in (one, other)]
        assert texts[0] == texts[1]


# Other words and completions ------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("address", "told"),
    [("K", "the blocks have no word K; they have G, A, I, Z"), ("Z", "the blocks have 2 words Z$")],
)
def test_with_words_refuses_to_edit_a_word_that_is_not_there_once(address, told):
    with pytest.raises(ValueError, match=told):
        answer_to("G111 A135. I10. Z-40. Z-40.", start=START).with_words(drop=[address])


@pytest.mark.parametrize("seed", range(0, 100, 5))
def test_completions_are_exactly_the_words_that_make_a_block_legal_and_determined(seed):
    """Restated from the manual: the missing one of two of A, I, K or of two of line 2."""
    case = broken(Random(seed), "missing" if seed % 10 else KINDS[seed // 10 % 10])
    answer = case.solve(depth="verdict")
    found = answer.completions
    for each in found:
        assert each.word in each.block
        assert each.word.endswith("?") == (each.contour is None)
    if case.kind != "missing" or answer.status.value == "solved":
        return
    lines, second = set(case.words) & set(EQUATIONS), {"B": "B", "X": "X", "U": "X", "Z": "Z", "W": "Z"}
    first, slots = lines & set("AIK"), {second[name] for name in lines if name in second}
    legal = set()
    for name in set(EQUATIONS) - lines:
        own, then = first | ({name} & set("AIK")), slots | ({second[name]} if name in second else set())
        is_twice = name in second and second[name] in slots
        is_cornered = {"X", "Z"} <= then and set(case.words) & set("DQ")
        if not is_twice and not is_cornered and (len(own), len(then)) in ((2, 2), (1, 3)):
            legal.add(name)
    # A legal word that leaves the block singular at these values, or without a contour, whatever its number,
    # completes nothing.
    addresses = {each.word[0] for each in found}
    assert addresses <= legal, case.text
    for name in legal - addresses:
        matrices = [rows_of(case.words | {name: Decimal(value)})[0] for value in ("30", "67.1")]
        is_singular = max(numpy.linalg.matrix_rank(each, tol=1e-9) for each in matrices) < 4
        for number in () if is_singular else range(-175, 180, 10):
            tried = replace(case, words=case.words | {name: Decimal(number)}).solve(depth="verdict")
            assert tried.contour is None, (case.text, name)
