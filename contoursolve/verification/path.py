"""What holds for every path, whatever its form: no gaps, nothing without length, arcs on their circles."""

from contoursolve.tolerance import LENGTH
from contoursolve.verification.case import Case
from contoursolve.verification.claimed import ClaimedCertificate
from contoursolve.verification.ledger import Ledger
from contoursolve.verification.measure import PRINTED

SHORTEST = LENGTH - 2 * PRINTED
"""mm. Elements shorter than this are left out; the ends of this one were rounded to 12 decimals."""

CERTIFICATE_KINDS = ("exact", "unique", "verified", "unknown")


def check_path(case: Case, ledger: Ledger, slack: float) -> None:
    """The claimed elements as a path from the start to the claimed end; arcs may end so far off their circles, mm,
    where the words put them there."""
    here, name = 0j, "the start"
    for number, move in enumerate(case.moves, 1):
        own = f"element {number}"
        ledger.measure(f"{own} begins at {name}", (), abs(move.start - here), case.limit)
        length = abs(move.end - move.start)
        ledger.require(f"{own} has a length", (), length >= SHORTEST, f"it is {length:.3g} mm long")
        if move.circle:
            center, radius = move.circle.center, move.circle.radius
            ledger.require(f"{own} has a radius", (), radius > 0, f"it is {radius:g} mm")
            ledger.measure(f"{own} begins on its circle", (), abs(move.start - center) - radius, case.limit)
            ledger.measure(f"{own} ends on its circle", (), abs(move.end - center) - radius, case.limit + slack)
        here, name = move.end, f"the end of {own}"
    if ledger.require("the result says where the contour ends", (), case.end is not None, "end is null"):
        ledger.measure(f"the contour ends at {name}", (), abs((case.end or 0j) - here), case.limit)


def check_certificate(certificate: ClaimedCertificate, limit: float, ledger: Ledger) -> None:
    """What can be said of a certificate alone; its radius is held against every point that is worked out.

    `limit` (mm) is how much is next to nothing.
    """
    kind, radius = certificate.kind, certificate.radius
    named = kind in CERTIFICATE_KINDS
    ledger.require("the certificate is of a known kind", (), named, f"it is {ascii(kind)[:60]}")
    if kind == "unknown" and certificate.reason is not None:
        ledger.require("the certificate says why it proves nothing", (), bool(certificate.reason), "there is no reason")
    if certificate.gap is not None:
        ledger.measure("the certificate calls double what just touches", (), certificate.gap, limit)
    if radius is None:
        ledger.omit("the certificate", "it names no radius")
        return
    ledger.require("the certificate's radius is not negative", (), radius >= 0, f"it is {radius:g} mm")
    # An exact number may have no double, or no twelve decimals, that are exactly it.
    is_exact = radius <= PRINTED if kind == "exact" else radius != 0
    ledger.require(
        "the certificate is exact if its radius is next to nothing",
        (),
        is_exact,
        f"it is {kind}, and the radius {radius:g} mm",
    )
    if radius > 0:
        digit = float(f"{radius:.17e}".partition("e")[0])
        ledger.require(
            "the certificate's radius has one digit", (), abs(digit - round(digit)) < DIGIT, f"it is {radius!r} mm"
        )


DIGIT = 1e-12
"""1. The rounding of a number of one digit."""
