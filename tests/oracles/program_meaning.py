"""Draws programs and holds what the package says of them against the reference interpreters.

`python tests/oracles/program_meaning.py --count 1000 --seed 1` counts what was the same, what was unknown and why, and
prints each program of which something else was said.
"""

import argparse
import re
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace

from drawn_meanings import drawn
from meaning_path import CONTROLS, Hard, Open, Path, are_alike, path_of, runs
from reference_interpreter import Move, Stopped

from contoursolve import Answer, solve

PRODUCT = {"siemens-turning": "siemens-840d"}
UNKNOWN = ("position-unknown", "mode-unknown", "variable", "not-followed", "start")


@dataclass(frozen=True)
class Verdict:
    """What came out for a contour: `same`, `unknown`, `refused`, `wrong`, `missing`, `hard`; its lines, and why."""

    kind: str
    lines: tuple[int, ...]
    cause: str = ""
    told: object = None
    expected: object = None


def judged(text: str, control: str) -> Iterator[Verdict]:
    """A verdict about each contour that is told, and each that is not."""
    try:
        ways = runs(text, control)
    except Stopped as error:
        yield Verdict("hard", (), str(error))
        return
    moving = {move.line for way in ways for move in way}
    result = solve(text, control=PRODUCT.get(control, control), depth="verdict")
    told, covered = defaultdict[tuple[int, ...], list[Answer]](list), set[int]()
    for answer in result.answers:
        lines = tuple(line for line in answer.lines if line in moving)
        if lines:
            told[lines].append(answer)
        covered |= {*lines}
    refused = {lines[0] for lines, answers in told.items() if any(each.status.value != "solved" for each in answers)}
    # A vacant variable takes a word out, so that a contour may end before where it ends on another pass.
    begins = Counter(lines[0] for lines in told)
    for lines, answers in told.items():
        is_other = lines[0] in refused or begins[lines[0]] > 1
        yield from _of_contour(lines, answers, [*_runs_of(lines, ways)], is_other=is_other)
    wanted = {move.line for way in ways for move in way if move.corner or move.angle is not None}
    if wanted - covered:
        causes = [each for each in result.diagnostics if each.code.endswith(UNKNOWN) or each.severity.value == "error"]
        cause = plain(f"{causes[0].code}: {causes[0].message}") if causes else "nothing is said"
        yield Verdict("unknown" if causes else "missing", tuple(sorted(wanted - covered)), cause)


def _runs_of(lines: tuple[int, ...], ways: list[list[Move]]) -> Iterator[tuple[list[Move], bool]]:
    """The moves on these lines each time when they run in a row, and whether corners join them, and to no others."""
    for way in ways:
        for at in range(len(way) - len(lines) + 1):
            part = way[at : at + len(lines)]
            if tuple(move.line for move in part) == lines:
                is_joined = all(each.corner is not None or each.angle is not None for each in part[:-1])
                is_alone = part[-1].corner is None and (at == 0 or way[at - 1].corner is None)
                yield part, is_joined and is_alone


def _of_contour(
    lines: tuple[int, ...], answers: list[Answer], parts: list[tuple[list[Move], bool]], *, is_other: bool
) -> Iterator[Verdict]:
    """The verdict about a contour; if another pass of it `is_other`, it is refused or has other lines."""
    if any(each.start.is_relative for each in answers):
        yield Verdict("unknown", lines, "start-relative: a shape without a place")
        return
    solved = [own for each in answers if each.status.value == "solved" and (own := path_told(each))]
    try:
        # Where a corner beside it is refused, a contour begins at its point, or ends there.
        possible = [(path_of(part), is_whole) for part, is_whole in parts]
    except Hard:
        yield Verdict("hard", lines)
        return
    expected = [path for path, is_whole in possible if is_whole]
    paths = [each for each in expected if isinstance(each, Path)]
    for own in solved:
        if not any(isinstance(each, Path) and are_alike(own, each) for each, _ in possible):
            yield Verdict("wrong", lines, "", own, [each for each, _ in possible])
            return
    if len(solved) == len(answers) and not is_other and not all(_is_told(each, solved) for each in paths):
        yield Verdict("wrong", lines, "not all", solved, expected)
    elif len(solved) == len(answers) and len(paths) < len(expected) and not is_other:
        yield Verdict("wrong", lines, "not always known", solved, expected)
    elif len(solved) == len(answers):
        yield Verdict("same", lines)
    elif parts:
        yield _of_refused(lines, answers, [each for each, _ in possible])


def _of_refused(lines: tuple[int, ...], answers: list[Answer], expected: list[Path | Open | None]) -> Verdict:
    """The verdict where something is not solved: unknown with a line, or refused for another reason."""
    left = next(each for each in answers if each.status.value != "solved")
    errors = [each for each in left.diagnostics if each.is_error] or [*left.diagnostics]
    cause = errors[0] if errors else None
    is_unknown = cause is not None and cause.code.endswith(UNKNOWN)
    names_line = cause is not None and bool(re.search(r"program lines? \d", cause.message) or cause.notes)
    kind = "unknown" if is_unknown and names_line else "lineless" if is_unknown else "refused"
    if kind == "refused" and None in expected:
        kind = "same"
    known = "" if any(isinstance(each, Open) for each in expected) else "known: "
    return Verdict(kind, lines, known + plain(f"{cause.code}: {cause.message}" if cause else left.status.value), left)


def _is_told(path: Path, solved: list[Path]) -> bool:
    """Whether a path is told, or one that ends at the same points, or goes the same steps from somewhere else."""
    moved = [shifted(each, path.start - each.start) for each in solved]
    return any(are_alike(replace(path, start=each.start), each) for each in [*solved, *moved])


def shifted(path: Path, by: complex) -> Path:
    ends = tuple((end + by, None if center is None else center + by) for end, center in path.elements)
    return Path(path.start + by, ends)


def path_told(answer: Answer) -> Path | None:
    """The path of an answer, without elements of no length."""
    if answer.contour is None or None in answer.start.values:
        return None
    start, kept = complex(*map(float, answer.start.values)), list[tuple[complex, complex | None]]()
    at = start
    for each in answer.contour.elements:
        end, center = complex(*each.end), getattr(each, "center", None)
        if abs(end - at) > 1e-6:
            kept.append((end, complex(*center) if center is not None else None))
        at = end
    return Path(start, tuple(kept))


_FRAMEWORK = re.compile(r"G18 G71|G17 G71|G21|M30|M17|RET|M99|PROC|O\d|ENDIF|ENDWHILE|ENDFOR|END1|T0101|L\d+:|N\d")
"""Lines without which a program is another one."""


def smallest(text: str, control: str, kind: str) -> str:
    """The program with as few lines as still come to a verdict of this kind."""
    lines, size = text.split("\n"), len(text.split("\n")) // 2
    while size:
        at = 0
        while at < len(lines):
            kept = [line for line in lines[at : at + size] if _FRAMEWORK.match(line)]
            left = lines[:at] + kept + lines[at + size :]
            if len(left) < len(lines) and _comes_to("\n".join(left), control, kind):
                lines, at = left, at + len(kept)
            else:
                at += size
        size //= 2
    return "\n".join(lines)


def _comes_to(text: str, control: str, kind: str) -> bool:
    try:
        return any(each.kind == kind for each in judged(text, control))
    except Exception:  # no program of this kind
        return False


def plain(message: str) -> str:
    """A message without its numbers and names."""
    code, _, said = message.partition(": ")
    return f"{code}: " + " ".join(re.findall(r"(?<![\w.=#])[a-z]+(?![\w.=#])", said))


def say(text: str) -> None:
    sys.stdout.write(f"{text}\n")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--control", choices=CONTROLS, action="append")
    parser.add_argument("--show", default="wrong,missing", help="the kinds of verdicts of which programs are printed")
    parser.add_argument("--small", action="store_true", help="print them with as few lines as possible")
    asked = parser.parse_args()
    kinds, causes, shown = Counter[tuple[str, str]](), Counter[tuple[str, str]](), asked.show.split(",")
    for number in range(asked.seed, asked.seed + asked.count):
        for control in asked.control or CONTROLS:
            text = drawn(str(number), control)
            found = [*judged(text, control)]
            for each in found:
                kinds[control, each.kind] += 1
                if each.kind not in ("same", "hard"):
                    causes[each.kind, each.cause] += 1
            if any(each.kind in shown for each in found):
                say(f"\n=== seed {number} {control}")
                if asked.small:
                    text = smallest(text, control, next(each.kind for each in found if each.kind in shown))
                    found = [*judged(text, control)]
                say("\n".join(f"{at:3} {line}" for at, line in enumerate(text.split("\n"), 1)))
                for each in found:
                    if each.kind in shown:
                        say(f"--- {each.kind} {each.lines} {each.cause}")
                        say(f"  told {each.told}\n  is   {each.expected}")
    for (control, kind), times in sorted(kinds.items()):
        say(f"{control:16} {kind:10} {times}")
    for (kind, cause), times in causes.most_common():
        say(f"{times:6} {kind:8} {cause}")


if __name__ == "__main__":
    main()
