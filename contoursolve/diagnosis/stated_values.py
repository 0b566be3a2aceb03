"""The values that some words of a contour fix of its drawing."""

from collections.abc import Mapping

from msgspec import Struct

from contoursolve.geometry import Profile
from contoursolve.reading import ParsedContour, read
from contoursolve.solving import AffineFacts, Circuit, affine_facts, is_conflict, lookup


class Geometry(Struct, frozen=True):
    """The values that some words fix of the drawing, as far as they do not contradict each other."""

    profile: Profile
    affine: AffineFacts | None
    conflicts: tuple[Circuit, ...]
    """Of facts that are tied and disagree."""
    fixed: Mapping[str, float]

    @classmethod
    def of(cls, claim: ParsedContour, kept: frozenset[str] | None = None) -> "Geometry":
        names = frozenset(claim.givens)
        profile = read(claim, names - (names if kept is None else kept))
        affine = affine_facts(profile, profile.facts)
        circuits = affine.circuits().found if affine else ()
        conflicts = tuple(each for each in circuits if affine and is_conflict(each, profile, affine))
        fixed = affine.fixed_by(profile.facts) if affine and profile.facts and not conflicts else {}
        return cls(profile, affine, conflicts, fixed)

    @property
    def is_singular(self) -> bool:
        """Whether the words leave something free although there are enough of them."""
        affine = self.affine
        return affine is not None and len(affine.facts) >= len(affine.unknowns) and bool(affine.freedoms())

    def implied(self, claim: ParsedContour, name: str) -> float | None:
        """The value (mm or degrees) that a word would have."""
        at = lookup(self.profile, dict(self.fixed))
        for row in claim.form.outline.facts:
            if row.fact.given == name and all(each in at.scalars for each in row.fact.reads()):
                return row.fact.implied(at)
        return None
