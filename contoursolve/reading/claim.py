"""A contour found in a program: its form, its blocks, and every word with the given that it states."""

from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from enum import Enum

from contoursolve.model import Choice, Given, Profile, Turn
from contoursolve.reading.form import Form, lay_out
from contoursolve.reading.lexicon import Lexicon
from contoursolve.reading.state import State
from contoursolve.syntax import Block, Word


class Trouble(Enum):
    """What can keep a program or a contour from being read, apart from its characters."""

    REPEATED_ADDRESS = "repeated-address"
    UNKNOWN_ADDRESS = "unknown-address"
    VARIABLE = "variable"
    WORD_IGNORED = "word-ignored"
    POINT_MISSING = "point-missing"
    VALUE_TOO_LARGE = "value-too-large"
    POSITION_UNKNOWN = "position-unknown"
    SKIPPABLE_START = "skippable-start"
    FORM_UNRESOLVED = "form-unresolved"
    NO_CONTOUR = "no-contour"
    UNDERDETERMINED = "underdetermined"
    CORNER_TWICE = "corner-twice"
    CORNER_NEGATIVE = "corner-negative"
    CORNER_NOWHERE = "corner-nowhere"
    CHOICE_MISSING = "choice-missing"


@dataclass(frozen=True, slots=True)
class Claim:
    """A contour before any check.

    `words` are the words by the name of the given that they state; `givens` their values in mm or
    degrees, without those that are variables; `circumstances` are names such as `@compensated`. `before` is the
    state at the start point, `after` the state with the modes of all its blocks.
    """

    form: Form
    lexicon: Lexicon
    blocks: tuple[Block, ...]
    before: State
    after: State
    words: Mapping[str, Word]
    givens: Mapping[str, Given]
    vocabulary: Mapping[str, tuple[str, int]]
    """The address and the block (its index) of every name that a word may state here."""
    unknown: tuple[Word, ...] = ()
    repeated: tuple[Word, ...] = ()
    circumstances: frozenset[str] = frozenset()
    choices: tuple[Choice, ...] = ()
    turn: Turn | None = None

    def stated(self) -> dict[str, Decimal | None]:
        """What the rules on combinations look at."""
        values = {name: self.givens[name].value if name in self.givens else None for name in self.words}
        return {**values, **dict.fromkeys(self.circumstances)}


def read(claim: Claim, ignored: frozenset[str]) -> Profile:
    """The profile of a claim, without the facts that the control ignores."""
    names = frozenset(claim.givens)
    sharp = frozenset(
        word for row in claim.form.corners for word in row.shapes if word in names and not claim.givens[word].value
    )
    layout = lay_out(claim.form, names - ignored, sharp, claim.turn)
    dropped = tuple(row.fact for row in claim.form.facts if row.fact.given in ignored & names)
    return Profile(
        form=claim.form.name,
        blocks=claim.blocks,
        plane=claim.after.plane,
        unit=claim.after.unit,
        layout=layout,
        start=claim.before.start(),
        givens=claim.givens,
        intersections=claim.form.intersections,
        ignored=dropped,
        choices=claim.choices,
    )
