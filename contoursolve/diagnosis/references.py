"""References: coordinates that are compared with a contour, and not used."""

from collections.abc import Iterator

from msgspec.structs import replace

from contoursolve.diagnosis.examine import Answer
from contoursolve.diagnosis.explain import context_of, report
from contoursolve.diagnosis.wording import length_text
from contoursolve.diagnostics import Basis, Diagnostic
from contoursolve.gcode import Block, Named, Word
from contoursolve.geometry import Length
from contoursolve.reading import ReadIssue, Rule
from contoursolve.solving import Point
from contoursolve.tolerance import INCREMENT, INCREMENT_INCH


def compare_reference(
    answer: Answer, named: Named, block: Block | None, rules: tuple[Rule, ...]
) -> Iterator[Diagnostic]:
    """The findings about words that are named as references: those beside a block of the contour are compared with the
    end of what that block draws, a virtual intersection where a corner follows, all others with the end of the contour.

    Within half an increment a word is met. A word that states no coordinate is refused.
    """
    context = replace(
        context_of(answer.claim, rules), place=named.span if named.span.line > 0 else answer.claim.blocks[-1].span
    )
    if not named.words:
        reason = "write words such as Z-50."
        yield report(context, ReadIssue.REFERENCE_UNUSED, Basis.RULE, [], named=named.text or "nothing", reason=reason)
    for word in named.words:
        # Words that are named apart from the program have no place in it.
        marked = [word] if named.span.line > 0 else []
        reason = _why_not(answer, word)
        place = None if reason else _place(answer, block)
        if place is None:
            reason = reason or "the contour is not solved"
            yield report(
                context, ReadIssue.REFERENCE_UNUSED, Basis.RULE, marked, named=word.text.strip(), reason=reason
            )
            continue
        name, point = place
        axis = answer.plane.axes.index(answer.claim.lexicon.addresses[word.address].axis)
        width = 2 if answer.claim.lexicon.addresses[word.address].is_diameter else 1
        stated = float(answer.claim.lexicon.value(word, answer.unit) or 0) * width
        actual = point[axis] * width
        off = abs(actual - stated)
        is_met = off <= (INCREMENT_INCH if answer.unit is Length.INCH else INCREMENT) / 2
        yield report(
            context,
            ReadIssue.REFERENCE_MET if is_met else ReadIssue.REFERENCE_MISSED,
            Basis.NUMERICAL,
            marked,
            {"expected": stated, "actual": actual, "off_by_mm": off / width},
            named=word.text.strip(),
            off=length_text(off, answer.unit),
            where=name,
            there=f"{answer.plane.axes[axis]}{length_text(actual, answer.unit)}",
        )


def _why_not(answer: Answer, word: Word) -> str:
    """The reason why a word cannot be compared; empty if it can. It is a coordinate whatever G90 and G91 say."""
    claim = answer.claim
    row = claim.lexicon.addresses.get(word.address)
    axes = " and ".join(answer.plane.axes)
    if row is None or row.axis not in answer.plane.axes:
        return f"it is no coordinate along {axes}"
    if row.is_increment:
        return "it is an increment; name the coordinate of the end"
    return "" if word.number is not None and not word.is_asked else "it has no number"


def _place(answer: Answer, block: Block | None) -> tuple[str, Point] | None:
    """The point with which a reference beside a block is compared, in words and its place; None without a contour."""
    contour, claim = answer.contour, answer.claim
    if contour is None:
        return None
    if block is not None and len(claim.blocks) > 1:
        number = [each.line for each in claim.blocks].index(block.line)
        path = answer.profile.figure.path
        made = claim.makes[number] if claim.makes else (path[number].name,)
        head = next((each.head for each in reversed(path) if each.name in made), "")
        if head in contour.places:
            return f"the end of program line {block.line}", contour.places[head]
    return "its end", contour.end
