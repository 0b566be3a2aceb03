"""Words of a block that the control has not, and those of its words that they were meant to be."""

import re
from bisect import bisect_right
from collections.abc import Collection, Container, Iterable, Iterator, Sequence
from enum import Enum
from functools import lru_cache

from msgspec.structs import replace

from contoursolve.diagnosis.explain import Context, report
from contoursolve.diagnosis.wording import either
from contoursolve.diagnostics import Basis, Diagnostic, Severity, Span, typing_distance
from contoursolve.gcode import Block, FaultKind, Word
from contoursolve.reading import Bearing, Code, Control, Effect, Lexicon, Modes, ReadIssue, State, codes_of, not_read

_SHORTEST = 2
"""Letters of an address by which no other one is meant."""
_LONG = 5
"""Letters of an address from which on two slips may have been made in it."""
_MOST = 3
"""Words that may have been meant, of which a message tells."""

_ROLES = (
    ("rounding", ("RND", "RN", "RD", "RO", "RA", "FIL", "R")),
    ("chamfer", ("CHR", "CHF", "CH", "FAS", "BEV", "C")),
    ("angle", ("ANG", "AN", "WI", "A")),
)
"""The beginnings of the meanings of corners and angles, and how such words begin on one control or another."""


def meant_by(word: Word, known: Collection[str], lexicon: Lexicon) -> list[str]:
    """The words that one was meant to be that the control has not, the most plausible first: the same with a comma or a
    number sign or without it, one with the same letters but for a slip, what another control calls so."""
    number = _number(word, lexicon)
    return [lexicon.spell(each, number) for each in _meant(word, known, lexicon)] if number else []


def _meant(word: Word, known: Collection[str], lexicon: Lexicon) -> list[str]:
    """Their addresses."""
    bare = word.address.lstrip(",#")
    others = [each for each in known if each != word.address and each.lstrip(",#")]
    own = lexicon.addresses
    same = [each for each in others if each.lstrip(",#") == bare and each in own]
    near = sorted((distance, each) for each in others if (distance := _apart(bare, _typed(each, lexicon))) is not None)
    near = [each for each in near if each[1] in own] or near
    roles = [each for each in others if _role(each, lexicon) and _role(each, lexicon) == _begins_like(word.address)]
    corners = [each for each in others if word.address.startswith(",") and each.startswith(",")]
    if _begins_like(word.address):
        corners = []
    elif len(bare) == 1 and corners:
        # Which of them it is shows in the number, if at all.
        is_angle = abs(float(word.number or 0)) > _LARGEST_CORNER
        corners.sort(key=lambda each: (_role(each, lexicon) == "angle") is not is_angle)
    return [*dict.fromkeys([*same, *(each for _, each in near), *roles, *corners])]


def _typed(address: str, lexicon: Lexicon) -> str:
    """The pattern of the name of a word."""
    text = lexicon.spell(address, "")
    return text.split()[0].strip("=") if " " in text else address


_LARGEST_CORNER = 44
"""A number beyond which it is an angle rather than the size of a corner."""


def _number(word: Word, lexicon: Lexicon) -> str:
    number = lexicon.number_of(word.text, word.address)
    return number if number and (number.strip("+-.0123456789,?") == "") else ""


def _role(address: str, lexicon: Lexicon) -> str:
    row = lexicon.addresses.get(address)
    return next((role for role, _ in _ROLES if row and row.meaning.startswith(role)), "")


def _part(address: str, lexicon: Lexicon) -> str:
    """The same where words of two lines differ: `radius of the first rounding`."""
    row = lexicon.addresses.get(address)
    return next((role for role, begin in _PARTS if row and row.meaning.startswith(begin)), "")


_PARTS = (
    *(("rounding", f"radius of the {which} rounding") for which in ("first", "second")),
    *(("chamfer", f"amount of the {which} bevel") for which in ("first", "second")),
    ("angle", "travel direction of line"),
)
"""The beginnings of the meanings of such words."""


def _begins_like(address: str) -> str:
    """The meaning of a word on another control, by how it begins; of one letter, it is the letter."""
    bare, has_sign = address.lstrip(",#"), address[0] in ",#"
    if len(bare) == 1 and not has_sign:
        # A and C are axes of many machines.
        return "rounding" if bare == "R" else ""
    return next(
        (role for role, names in _ROLES for name in names if bare == name or (len(name) > 1 and bare.startswith(name))),
        "",
    )


def _apart(typed: str, other: str) -> int | None:
    """By how many slips two addresses differ: letters too many, lost, exchanged or swapped; None for too many."""
    meant = other.lstrip(",#")
    if min(len(typed), len(meant)) < _SHORTEST or "=" in meant or typed == meant:
        return None
    most = 2 if min(len(typed), len(meant)) >= _LONG else 1
    if abs(len(typed) - len(meant)) > most:
        return None
    distance = typing_distance(typed, meant)
    return distance if distance <= most else None


def names_like(typed: str, lexicon: Lexicon, codes: Iterable[str]) -> Iterator[str]:
    """The names that a word or a code may have been meant to have, as they are typed: one letter too many, lost or
    exchanged, or the same letters in another order; of two letters the last alone if there is such a name."""
    bare, known = typed.upper(), (*codes, *(_name(each, lexicon) for each in lexicon.plain_names()))
    names = (name for name in dict.fromkeys(known) if name.strip("#,").isalpha() and name != bare)
    found = [name for name in names if _is_like(bare.lstrip("#"), name.lstrip("#"))]
    turned = [name for name in found if len(bare) == _SHORTEST and sorted(name) == sorted(bare)]
    yield from turned or found


def _name(address: str, lexicon: Lexicon) -> str:
    """The name of a word as it is typed, without what its number needs before it."""
    return lexicon.spell(address, "").partition("(")[0].split("=")[0].split()[0]


def _is_like(typed: str, name: str) -> bool:
    if len(typed) < _SHORTEST or len(name) < _SHORTEST:
        return False
    return (
        typed == name
        or sorted(typed) == sorted(name)
        or (max(len(typed), len(name)) > _SHORTEST and typing_distance(typed, name) == 1)
    )


_STRETCH = re.compile(
    r"(?>(?:(?P<sign>[,#.]++)[ \t]*+)?)(?P<name>[A-Z]++)(?>(?:(?<=[A-Z]{2})[ \t]++R(?![A-Z]))?)"
    r"(?P<between>[ \t]*+[=:,]*+[ \t]*+)(?P<number>[+-]?+(?:\d[\d.,]*+|\.\d[\d.,]*+))",
    re.IGNORECASE | re.ASCII,
)
"""Text that is typed like a word of a contour, however it is spelled."""


@lru_cache(maxsize=16)
def _stretches(text: str) -> list[re.Match[str]]:
    """The parts of a line that are typed like words; a line may have many faults, and each is looked up in it."""
    return [*_STRETCH.finditer(text)]


def corner_at(text: str, span: Span, lexicon: Lexicon, *, in_contour: bool = False) -> tuple[Word, list[str]] | None:
    """The stretch of a line at some columns that is typed like a word of a corner or an angle and is none, and the
    words that may have been meant, none where the control has no such words; None if it is like no such word."""
    stretches = _stretches(text)
    at = bisect_right(stretches, span.column - 1, key=re.Match.end)
    if at == len(stretches) or stretches[at].start() >= span.end_column - 1:
        return None
    found = stretches[at]
    name, number = found["name"].upper(), found["number"]
    number = number.replace(",", ".") if number.count(",") == 1 and "." not in number else number.strip(",")
    is_signed = bool(found["sign"] or "," in found["between"] or ("=" in found["between"] and len(name) == 1))
    word = Word(f"#{name}" if is_signed else name, None, False, found[0], span)
    place = Span(span.line, found.start() + 1, found.end() + 1)
    known = [each for each in lexicon.addresses if _role(each, lexicon) or (in_contour and _part(each, lexicon))]
    meant = [lexicon.spell(each, number) for each in _meant(word, known, lexicon)]
    alike = [each for each in known if _typed(each, lexicon).partition(" ")[0].lstrip(",#") == name]
    own = [lexicon.spell(each, number) for each in alike]
    if in_contour and not (own or meant):
        meant = [lexicon.spell(each, number) for each in known if _part(each, lexicon) == _begins_like(word.address)]
    meant = [each for each in dict.fromkeys([*own, *meant]) if each != found[0].strip()]
    typed = replace(word, address=(found["sign"] or "") + name, span=place)
    is_torn = len(name) > 1 and not own and not is_signed
    is_like = bool(meant) or ((is_torn or typed.address.startswith(",")) and bool(_begins_like(word.address)))
    return (typed, meant) if is_like and (not meant or number.count(".") <= 1) else None


def explain_corners(
    context: Context, text: str, findings: Sequence[Diagnostic], lexicon: Lexicon, others: Container[str]
) -> Iterator[Diagnostic]:
    """Findings about a line that is no contour, in which each stretch that is typed like a word of a corner or an angle
    is told as such; `others` are those words of other controls."""
    told: set[Span] = set()
    for each in findings:
        found = corner_at(text, each.span, lexicon) if each.about in _UNREADABLE else None
        if found is not None and _MEANT in each.help and _is_spelled(found[0].address, lexicon):
            # That another number is meant is told already.
            found = None
        if found is None:
            yield each
        elif found[0].span not in told:
            told.add(found[0].span)
            word, meant = found
            if meant and word.address not in others:
                finding = report(context, ReadIssue.WORD_MISTYPED, Basis.RULE, [word], meant=either(meant[:_MOST]))
            else:
                advice = f"write {either(meant[:_MOST])} if that is meant" if meant else "write out what it means"
                finding = report(context, ReadIssue.COMMA_WORD_UNKNOWN, Basis.RULE, [word], advice=advice)
            yield replace(finding, severity=Severity.ERROR, source=lexicon.unknown or finding.source)


_MEANT = "if that is meant"


UNITS = ("mm", "in", "inch", "deg", "grad", "\N{DEGREE SIGN}")
"""Text that readers write behind a number, and no control reads."""


def corner_words(lexicon: Lexicon) -> Iterator[str]:
    """The addresses of several characters that make corners and angles."""
    yield from (each for each in lexicon.addresses if is_corner_word(each, lexicon))


def is_corner_word(address: str, lexicon: Lexicon) -> bool:
    """Whether an address has several characters and makes corners or angles."""
    return len(address) > 1 and bool(_role(address, lexicon))


def _is_spelled(name: str, lexicon: Lexicon) -> bool:
    """Whether a name of several characters is that of a word of the control."""
    return len(name) > 1 and any(_typed(each, lexicon) == name for each in lexicon.addresses)


_UNREADABLE: frozenset[Enum | None] = frozenset(
    {FaultKind.STRAY_CHARACTER, FaultKind.NUMBER_MISSING, FaultKind.NUMBER_MALFORMED}
    | {ReadIssue.CODE_UNKNOWN, ReadIssue.WORD_UNKNOWN}
)


# Blocks ----------------------------------------------------------------------------------------------------------

_OF_A_MOVE = (
    Effect.MOTION,
    Effect.PLANE,
    Effect.UNITS,
    Effect.ABSOLUTE,
    Effect.INCREMENTAL,
    Effect.COMPENSATION,
    Effect.NONE,
    Effect.SHIFT,
    Effect.CONTOUR,
)
"""The effects of the codes of a block whose axis words are where it ends."""
_LINES, _ARCS, _RADII = (0, 1), (2, 3), ("R", "CR")
_PLAIN = (0, 1, 2, 3, 17, 18, 19, 20, 21, 40, 41, 42, 70, 71, 90, 91)
"""Codes that have no argument."""


def moves(block: Block, here: State, modes: Modes, signs: Sequence[Word]) -> bool:
    """Whether a block moves an axis of the plane, is an arc, or has a word of a contour; `here` is the state with its
    codes in force, `signs` are such words."""
    if block.macro is not None or any(modes.is_call(word) for word in block.words):
        return False
    codes = codes_of(block, modes)
    if any(isinstance(code, Word) or code.effect not in _OF_A_MOVE for code in codes):
        return False
    cycle = modes.codes.get(here.motion) if here.motion is not None else None
    if cycle is not None and cycle.effect is not Effect.MOTION:
        return False
    rows = (modes.lexicon.addresses.get(word.address) for word in block.words)
    # An arc that is stated draws one, wherever it ends.
    is_arc = any(not isinstance(code, Word) and code.number in _ARCS and code.effect is Effect.MOTION for code in codes)
    return bool(signs) or is_arc or any(row and row.axis in here.plane.axes for row in rows)


def has_corners(block: Block, here: State, modes: Modes) -> bool:
    """Whether a block may have a word of a corner: it moves an axis of the plane in a line or an arc; where corners are
    blocks of their own, it is not read as any other."""
    if modes.follow is not None:
        has_function = any(word.address == "G" for word in block.words)
        return block.macro is None and (not has_function or any(fault.text.startswith(",") for fault in block.faults))
    is_torn = any(
        fault.text.startswith(",") or corner_at(block.text, fault.span, modes.lexicon) for fault in block.faults
    )
    is_cut = here.motion in _CUTTING and (is_torn or moves(block, here, modes, ()))
    return is_cut or _has_unread_code(block, here, modes)


_CUTTING = (1, 2, 3)


def _has_unread_code(block: Block, here: State, modes: Modes) -> bool:
    """Whether a block moves an axis of the plane, and has what is read as the name of a code."""
    rows = (modes.lexicon.addresses.get(word.address) for word in block.words)
    named = any(word.address == "G" and word.number is None for word in block.words)
    return named and here.motion in _CUTTING and any(row and row.axis in here.plane.axes for row in rows)


def like_corners(block: Block, modes: Modes, others: Container[str]) -> bool:
    """Whether a block has a word that the control has not, and that is almost one of a corner or an angle; `others`
    are those of other controls, which may be meant as they stand."""
    lexicon = modes.lexicon
    if block.macro is not None:
        return False
    names = [
        word
        for word in block.words
        if len(word.address) > 1 and word.number is not None and not is_known(word.address, lexicon)
        if word.address not in others
        if word.address not in lexicon.addresses and lexicon.bearing(word.address) is None
    ]
    corners = [*corner_words(lexicon)] if names else []
    return any(
        each.address.lstrip(",#") in _NAMES
        or any(_apart(each.address.lstrip(",#"), _typed(corner, lexicon)) is not None for corner in corners)
        for each in names
    )


_NAMES = frozenset(name for _, names in _ROLES for name in names if len(name) > 1)
"""The names of corners and angles on one control or another, by more than a letter."""


def is_known(address: str, lexicon: Lexicon) -> bool:
    """Whether a word may stand in any block that moves: it moves an axis, or has nothing to do with the path."""
    row = lexicon.addresses.get(address)
    return address == "G" or (row is not None and bool(row.axis)) or lexicon.is_beside(address)


def explain_codes_by_name(context: Context, block: Block, modes: Modes) -> Iterator[Diagnostic]:
    """Codes of a block that the control has not."""
    for word, code in zip((word for word in block.words if word.address == "G"), codes_of(block, modes), strict=True):
        is_own = word.text.strip().upper() in modes.lexicon.addresses
        if isinstance(code, Word) and word.number is None and block.faults and not is_own:
            # Where characters cannot be read, a name may be a part of what they mean.
            continue
        if isinstance(code, Word):
            yield from _unknown_code(context, word, modes)


def _unknown_code(context: Context, word: Word, modes: Modes) -> Iterator[Diagnostic]:
    name = word.text.strip()
    if word.number is None:
        bare = name.partition("(")[0].strip().upper()
        if bare in modes.lexicon.addresses:
            yield report(context, FaultKind.NUMBER_MISSING, Basis.RULE, [replace(word, address=bare)])
            return
        known = [*modes.syntax.codes, *modes.lexicon.plain_names()]
        near = sorted((distance, each) for each in known if (distance := _apart(bare, each)) is not None)
        meant = [f"{each}=" if each in modes.lexicon.addresses else each for _, each in near]
    else:
        digits = f"{word.number:f}"
        codes = [code for code in modes.codes.values() if not code.name and code.text.lstrip("G0") != digits]
        alike = [code for code in codes if typing_distance(digits, str(code.number)) == 1]
        likely = sorted(code.text for code in alike if _weight(code) == max(map(_weight, alike)))
        # Of several that are as near, none is more likely, unless they are those of contours.
        meant = likely if len(likely) == 1 or max(map(_weight, alike), default=0) > 1 else []
    row = context.row(ReadIssue.CODE_UNKNOWN)
    advice = f"write {either(meant[:_MOST])} if that is meant" if meant else "write out what it does"
    if name.lower() in UNITS:
        advice = f"delete {name}: a number has no unit after it"
    yield report(context, row, Basis.RULE, [word], name=name, advice=advice)


def explain_call(context: Context, name: str, control: Control) -> Iterator[Diagnostic]:
    """A subprogram that is nowhere, and has almost the name of a command."""
    near = sorted((distance, each) for each in control.modes.syntax.codes if (distance := _apart(name, each)) == 1)
    if near:
        named = either([each for _, each in near[:_MOST]])
        advice = (
            f"write {named} if that is meant; else name the folder of the subprogram with --path. A command of the "
            f"machine builder that moves nothing is stated with --setting {control.name}.words={name}"
        )
        yield report(context, ReadIssue.CODE_UNKNOWN, Basis.RULE, [], name=name, advice=advice)


def _weight(code: Code) -> int:
    """A measure of how much a code has to do with contours."""
    return (code.effect in (Effect.CONTOUR, Effect.CORNER)) * 2 + (code.effect is Effect.MOTION)


def name_of(word: Word) -> str:
    """The name of a word apart from its value."""
    return not_read(word.text).split()[-2] if word.address in ("G", "M") else word.address


def not_read_yet(context: Context, word: Word, *, is_needed: bool) -> Diagnostic:
    """A word of the control that contoursolve does not read; an error where a contour needs it."""
    finding = report(context, ReadIssue.NOT_READ, Basis.RULE, [word], name=name_of(word))
    return replace(finding, severity=Severity.ERROR) if is_needed else finding


def explain_vocabulary(
    context: Context, block: Block, here: State, modes: Modes, others: Container[str]
) -> Iterator[Diagnostic]:
    """The words of a block that moves which the control has not; `others` are those of other controls by which these
    are known, `here` is the state with its codes in force."""
    lexicon, has_code = modes.lexicon, _has_code(block)
    is_line = modes.follow is not None and any(word.text.strip().upper() == "L" for word in block.words)
    for word in block.words:
        bearing = lexicon.bearing(word.address)
        if is_known(word.address, lexicon) or (bearing is Bearing.ARGUMENT and has_code):
            continue
        if word.address in lexicon.addresses:
            if (is_line or (here.motion in _LINES and not has_code)) and word.address not in modes.lasting:
                yield report(context, ReadIssue.WORD_IDLE, Basis.RULE, [word])
            continue
        if f",{word.address}" not in lexicon.addresses and bearing not in (Bearing.UNREAD, Bearing.END):
            is_radius = here.motion in _ARCS and word.address in _RADII
            yield _unknown_word(context, word, lexicon, others, (modes.radius,) if is_radius else ())


def _has_code(block: Block) -> bool:
    """Whether a block has a code to which an argument may belong."""
    return any(word.address == "M" or (word.address == "G" and word.number not in _PLAIN) for word in block.words)


def _unknown_word(
    context: Context, word: Word, lexicon: Lexicon, others: Container[str], likely: Sequence[str]
) -> Diagnostic:
    """A word that the control has not: an error where the control stops at it, else a warning; `likely` are addresses
    that are meant before all others."""
    sure = [lexicon.spell(each, _number(word, lexicon)) for each in likely if _number(word, lexicon)]
    meant = sure or meant_by(word, lexicon.plain_names(), lexicon)
    if word.address in others:
        advice = f"write {either(meant[:_MOST])} if that is meant" if meant else "write out what it means"
        finding = report(context, ReadIssue.COMMA_WORD_UNKNOWN, Basis.RULE, [word], advice=advice)
    elif meant:
        finding = report(context, ReadIssue.WORD_MISTYPED, Basis.RULE, [word], meant=either(meant[:_MOST]))
    else:
        finding = report(context, ReadIssue.WORD_UNKNOWN, Basis.RULE, [word])
    stops = lexicon.unknown if meant or word.address in others else None
    return replace(finding, severity=Severity.ERROR, source=stops) if stops else finding
