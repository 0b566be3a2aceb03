"""Sources of a statement: the place in the user's program, and the evidence in a manual."""

from enum import Enum
from typing import NamedTuple

from msgspec import Struct


class Evidence(Enum):
    """Grade of evidence for a fact about a control."""

    PRINTED = "printed"
    """Read on a page of the control's manual."""
    DERIVED = "derived"
    """Follows from printed facts by geometry or symmetry."""
    ASSUMED = "assumed"
    """Our choice where the pages that we have are silent."""


OWN = "contoursolve"
"""In place of a manual: what no manual says."""


class Source(Struct, frozen=True):
    """The manual, the place in it, and the grade of the evidence."""

    manual: str
    place: str
    evidence: Evidence

    @property
    def is_of_manual(self) -> bool:
        """Whether it is a place in a manual, and not what we know of geometry ourselves."""
        return self.manual != OWN

    def __str__(self) -> str:
        return f"{self.manual}, {self.place} ({self.evidence.value})"


DRAWN = Source(OWN, "the drawing", Evidence.DERIVED)
"""Of a finding about a sketch, whose places are lines of its file."""


class Book(NamedTuple):
    """A manual, whose places have a grade each."""

    title: str

    def printed(self, place: str) -> Source:
        """Source of a statement that is printed on a page."""
        return Source(self.title, place, Evidence.PRINTED)

    def derived(self, place: str) -> Source:
        """Source of a statement that follows from a page."""
        return Source(self.title, place, Evidence.DERIVED)

    def assumed(self, place: str) -> Source:
        """Source of a statement that no page seen prints."""
        return Source(self.title, place, Evidence.ASSUMED)


class Span(NamedTuple):
    """A stretch of one line; line and columns count from 1, `end_column` is the first one after it.

    Line 0 is the start point that was given apart from the program.
    """

    line: int
    column: int
    end_column: int
