"""A block with free words: its text, and what a single solve makes of it with any values filled in."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal

from contoursolve import syntax
from contoursolve.dialects import Dialect
from contoursolve.examine import Answer, Depth, Policy
from contoursolve.families.ranges import FamilyError
from contoursolve.model import Length
from contoursolve.pipeline import run
from contoursolve.syntax import Program, Word


@dataclass(frozen=True, slots=True, eq=False)
class Template:
    """A program with one contour, how it is read, and its free words by the names that the user gave them."""

    program: Program
    dialect: Dialect
    unit: Length
    policy: Policy
    start: Program | None
    words: Mapping[str, Word]

    def text(self, values: Mapping[str, float]) -> str:
        """The program with these values in place of the free words'."""
        lines = {block.line: block.text for block in self.program.blocks}
        # From the right, so that the columns of the others stay true.
        for name, word in sorted(self.words.items(), key=lambda item: item[1].span, reverse=True):
            line, span = lines[word.span.line], word.span
            typed = word.address + write(values[name])
            lines[span.line] = line[: span.column - 1] + typed + line[span.end_column - 1 :]
        return "\n".join(lines.values())

    def solve(self, values: Mapping[str, float]) -> Answer:
        """What a single solve says. Raises FamilyError where the blocks are no single contour with a known start."""
        program = syntax.parse(self.text(values), self.program.name)
        result = run(program, self.dialect, self.unit, self.policy, Depth.VERDICT, self.start)
        if len(result.answers) != 1:
            reasons = [each.message for each in result.diagnostics]
            told = f"the block has {len(result.answers)} contours; a family is about one"
            raise FamilyError(reasons[0] if reasons and not result.answers else told)
        answer = result.answers[0]
        if not answer.start.is_known:
            raise FamilyError("the start point is not known; state it, such as start='X40. Z0.'")
        if answer.profile.is_extended:
            raise FamilyError("a family is about words alone: leave out ? and (contoursolve: ...)")
        return answer


def write(value: float) -> str:
    """A number as a word has it: with a point, without an exponent, and all its digits."""
    text = format(Decimal(repr(float(value))), "f")
    return text if "." in text else f"{text}."


def find_words(program: Program, names: Sequence[str]) -> dict[str, Word]:
    """The words that names such as `A`, `,A` or `2:,A` (of line 2) speak of. Raises FamilyError if one does not say
    which."""
    found: dict[str, Word] = {}
    words = [word for block in program.blocks for word in block.words if word.address not in _NEVER]
    for name in names:
        line, _, address = name.rpartition(":")
        if line and not line.isdigit():
            raise FamilyError(f"{name} names no word; write its letter, or LINE:LETTER such as 2:,A")
        same = [word for word in words if word.address == address and (not line or word.span.line == int(line))]
        if len(same) != 1:
            have = ", ".join(call(word, words) for word in words)
            told = f"{len(same)} words {address}" if same else f"no word {address}"
            raise FamilyError(f"the block has {told}{f' in line {line}' if line else ''}; its words are {have}")
        if same[0] in found.values():
            raise FamilyError(f"{name} is named twice")
        if same[0].number is None:
            raise FamilyError(f"{same[0].text} has no number to vary")
        found[name] = same[0]
    return found


_NEVER = ("G", "N", "M")
"""What says what the other words mean."""


def call(word: Word, words: Sequence[Word]) -> str:
    """The name of a word among all: its letter, with its line where several have it."""
    is_alone = sum(each.address == word.address for each in words) == 1
    return word.address if is_alone else f"{word.span.line}:{word.address}"
