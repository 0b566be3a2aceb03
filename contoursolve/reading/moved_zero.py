"""Moves of the coordinate system, as rows of tables: a code, an address or a variable, how, and which axes are not
known behind it. Every block is asked, whether it belongs to a contour or not."""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from decimal import Decimal
from enum import Enum

from msgspec import Struct
from msgspec.structs import replace

from contoursolve.diagnostics import Source
from contoursolve.gcode import Block, Word

WORK, TOOL, LENGTH = "work offset", "tool offset", "length of the tool"
"""Groups of offsets: of each, one is in force."""


class ZeroMove(Enum):
    """The ways in which the coordinate system moves."""

    SELECT = "selects an offset of a table"
    """The one that is in force again moves nothing."""
    SET = "numbers of the block take the place of those in force on their axes"
    FINE = "numbers of the block take the place of those of a second shift, beside the first one"
    ADD = "numbers of the block come to those in force"
    REPLACE = "numbers of the block take the place of all that is in force"
    """Without numbers, nothing is left of it."""
    TURN = "turns, mirrors or scales"
    """Without a word, nothing is left of it."""
    TURN_FURTHER = "turns, mirrors or scales what is in force"
    FORMULA = "a formula takes the place of all that is in force"
    OTHER = "by an amount that the block does not say"
    DATA = "changes entries of tables, which may be in force"
    LATER = "changes entries of tables, in force from their next selection on"


Offset = tuple[tuple[str, Decimal | int], ...]
"""The offset in force: addresses with their numbers."""


Zero = Mapping[str, "Offset | Decimal"]
"""The zero in force: offsets by their group, and shifts by numbers, mm, by their axis."""
_Shifts = tuple[Decimal | None, Decimal | None]
"""The shift of an axis and the second one beside it, mm; None where it is not known."""
_ZERO = Decimal(0)


class Entry(Struct, frozen=True):
    """An entry of a table that a block changes: its group, the offset, None where it is in force whatever is selected,
    and its axes; none for all. Of numbers that begin with another one, such as T0102, `digits` tells how many count. If
    it `fades`, the offset has other numbers where it is selected next."""

    group: str
    offset: Offset | None = None
    axes: tuple[str, ...] = ()
    digits: int = 0
    fades: bool = False

    def is_in(self, zero: Zero) -> bool:
        """Whether it is in force, or may be."""
        in_force = zero.get(self.group)
        if self.digits and isinstance(in_force, tuple):
            most = 10**self.digits
            if any(0 < number < most for _, number in in_force):
                # In T11, each digit may count alone.
                return True
            in_force = tuple((address, number % most) for address, number in in_force)
        return self.offset is None or in_force is None or in_force == self.offset


Entries = Callable[[Block, tuple[str, ...]], Iterable[Entry]]
"""(a block, the axes of its words) to the entries that it changes."""


@dataclass(frozen=True, slots=True)
class ZeroRow:
    """One row: names as they are written, how each moves the coordinate system, and by what it is known.

    `axes` are those that are not known then, by the code of the plane where that matters; none for all. `words` are
    the addresses that tell which offset is selected.
    """

    names: str
    move: ZeroMove
    source: Source
    group: str = ""
    axes: tuple[str, ...] | Mapping[str, tuple[str, ...]] = ()
    words: str = ""
    indexed: Decimal | None = None
    """The number of the code that an offset of further ones has: G54 P1 is G54.1 P1."""
    stands_for: Offset = ()
    """The offset that it selects, where another code has that as well."""
    goes_on: bool = False
    """Whether what it does not say stays as it was: G43 alone keeps H."""
    adds_increments: bool = False
    """Whether its numbers come to those in force where increments are in force."""
    entries: Entries | None = None

    def axes_in(self, plane: str) -> tuple[str, ...]:
        """The axes that are not known behind it, where a plane is in force."""
        return self.axes.get(plane, ()) if isinstance(self.axes, Mapping) else self.axes


class Moved(Struct, frozen=True):
    """The move of a block: by how much each axis, mm, None where that is not known; what is in force then, and why."""

    by: Mapping[str, Decimal | None]
    zero: Zero
    reason: str


@dataclass(frozen=True, slots=True)
class ZeroTable:
    """All that moves the coordinate system of a control: rows by the numbers of G codes, and by other names.

    `first` is what is in force where a program begins. `variables` gives the entries that an assignment changes, by the
    name of its variable; empty for one whose index is not known.
    """

    codes: Mapping[int, ZeroRow] = field(default_factory=dict)
    names: Mapping[str, ZeroRow] = field(default_factory=dict)
    beside: tuple[ZeroRow, ...] = ()
    """Those of variables and statements, which are found in other ways: commas part their names."""
    first: Zero = field(default_factory=dict)
    variables: Callable[[str], Iterable[Entry]] | None = None
    commands: re.Pattern[str] | None = None
    """Commands beside words that turn, mirror or scale axes, by their name, and whether they begin or end that."""

    def rows_in(self, block: Block) -> list[tuple[ZeroRow, Word]]:
        """The rows that a block's words ask for."""
        found = list[tuple[ZeroRow, Word]]()
        codes, names = self.codes, self.names
        for word in block.words:
            address = word.address
            if address == "G":
                row = None if word.number is None else codes.get(word.number)  # type: ignore[call-overload]
            else:
                row = names.get(address)
                if row is None and (address == "M" or "[" in address):
                    name = f"M{word.number}" if address == "M" else address.partition("[")[0]
                    row = names.get(name)
            if row is not None:
                found.append((row, word))
        return found


NOTHING_MOVES = ZeroTable()


def table_of(
    rows: Iterable[ZeroRow],
    numbers: Mapping[str, int],
    axes: Iterable[str] = (),
    first: Zero | None = None,
    variables: Callable[[str], Iterable[Entry]] | None = None,
    beside: Iterable[ZeroRow] = (),
) -> ZeroTable:
    """The table of some rows; `numbers` are those of codes that are no G and a number. On `axes`, no shift is in force
    where a program begins. Rows `beside` are those of variables and statements."""
    codes, names = dict[int, ZeroRow](), dict[str, ZeroRow]()
    for row in rows:
        for name in row.names.split():
            if name in numbers:
                codes[numbers[name]] = row
            elif re.fullmatch(r"G[\d.]+", name):
                codes[Decimal(name[1:])] = row  # type: ignore[index]
            names[name] = row
    at_first = {key: _ZERO for axis in axes for key in (_shift(axis), _fine(axis))}
    return ZeroTable(codes, names, tuple(beside), {**at_first, **(first or {})}, variables)


_TURNED = "turned by "


def with_turn(zero: Zero, name: str, *, is_on: bool) -> Zero:
    """The zero in which something of that name turns, mirrors or scales axes, or does so no more."""
    kept = {key: value for key, value in zero.items() if key != _TURNED + name}
    return {**kept, _TURNED + name: ()} if is_on else kept


def turns_in(zero: Zero) -> frozenset[str]:
    """The names of what turns, mirrors or scales axes; an empty one for shifts that are not known."""
    return frozenset(key.removeprefix(_TURNED) for key in zero if key.startswith(_TURNED))


def commanded(zero: Zero, table: ZeroTable, text: str) -> Zero:
    """The zero behind a command."""
    found = table.commands.match(text) if table.commands is not None else None
    return zero if found is None else with_turn(zero, found["name"].upper(), is_on=found["end"] is None)


def shift_in(zero: Zero, axis: str) -> Decimal | None:
    """The shift of an axis by numbers, mm; None where it is not known."""
    first, second = (zero.get(name) for name in (_shift(axis), _fine(axis)))
    return first + second if isinstance(first, Decimal) and isinstance(second, Decimal) else None


def _shift(axis: str) -> str:
    return f"shift {axis}"


def _fine(axis: str) -> str:
    return f"fine shift {axis}"


def forget_shifts(zero: Zero) -> Zero:
    """The zero without shifts by numbers: they are not known, or not along the axes."""
    kept = {name: value for name, value in zero.items() if not isinstance(value, Decimal)}
    return zero if len(kept) == len(zero) else kept


def move_zero(
    zero: Zero,
    row: ZeroRow,
    word: Word,
    block: Block,
    numbers: Mapping[str, Decimal | None],
    axes: tuple[str, ...],
    plane: str,
    mm: Callable[[str, Decimal], Decimal | None],
) -> Moved | None:
    """The move by a word of a block, where `zero` is in force; None for nothing. `numbers` are the values of the
    block's axis words, mm; `mm` gives that of a number that a formula states for an axis."""
    reason = _reason(row, word, block)
    every = row.axes_in(plane) or (() if isinstance(row.axes, Mapping) else axes)
    every = tuple(axis for axis in every if axis in axes)
    lost = Moved(dict.fromkeys(every), zero, reason)
    match row.move:
        case ZeroMove.SELECT:
            return _select(zero, row, word, block, lost)
        case ZeroMove.DATA:
            concerned = row.entries(block, tuple(numbers)) if row.entries is not None else (Entry(row.group),)
            return change_entries(zero, concerned, axes, reason)
        case ZeroMove.LATER:
            return Moved({}, _with_other_data(zero, row.group), reason)
        case ZeroMove.OTHER:
            return replace(lost, zero=_with_other_data(zero, row.group))
        case _:
            stated = _formula(word, block, axes, mm) if row.move is ZeroMove.FORMULA else numbers
            return shift_zero(zero, row.move, block, stated, axes, reason)


def _with_other_data(zero: Zero, group: str) -> Zero:
    """The zero where the numbers of an offset are others, so that the same one is another one."""
    return {**{name: value for name, value in zero.items() if name != group}, **({_DATA: ()} if group == WORK else {})}


_DATA = "numbers of a work offset"
"""Stands in what is in force where some were changed, or may have been, since a call that saves the modes."""
UNKNOWN_ZERO: Zero = {_DATA: ()}
"""The zero of which nothing is known."""


def unknown_zero(zero: Zero) -> Zero:
    """The zero of which no more is known than what turns axes, as long as nothing ends it."""
    return {**UNKNOWN_ZERO, **{key: value for key, value in zero.items() if key.startswith(_TURNED)}}


def zero_at_call(zero: Zero) -> Zero:
    """The zero in which a subprogram begins that saves the modes."""
    return {name: value for name, value in zero.items() if name != _DATA} if _DATA in zero else zero


def is_along_axes(zero: Zero, first: Zero) -> bool:
    """Whether all shifts that a control has are known, so that nothing is turned."""
    return not turns_in(zero) and all(name in zero for name, value in first.items() if isinstance(value, Decimal))


def change_entries(zero: Zero, entries: Iterable[Entry], axes: tuple[str, ...], reason: str) -> Moved | None:
    """The move by a change of entries of tables: those that are in force, or may be."""
    lost, now = dict[str, None](), zero
    for entry in entries:
        if entry.is_in(zero):
            lost.update(dict.fromkeys(axis for axis in entry.axes or axes if axis in axes))
        if entry.fades:
            now = _with_other_data(now, entry.group)
    return Moved(lost, now, f"{reason}, which is in force or may be") if lost or now is not zero else None


_ASSIGNED = re.compile(r"(?P<name>\#\d++|V\.G\.[^ \t=]++)[ \t]*+[-+*/]?=|\#\[[^=]*\][ \t]*+=", re.IGNORECASE)
"""A variable of the machine that is set, one by one on controls that write # or V.G."""


def zero_brought_back(before: Zero, now: Zero, axes: tuple[str, ...], reason: str) -> Moved:
    """The move where a work offset and shifts are in force again that were so before; those of tools stay."""
    by = dict[str, Decimal | None]()
    for axis in axes:
        old, new = (_sum(*_shifts_of(zero, axis)) for zero in (now, before))
        if before.get(WORK) != now.get(WORK) or _DATA in now or old is None or new is None:
            # Where neither is known, what runs may have changed it; so may whoever writes the numbers of an offset.
            by[axis] = None
        elif old != new:
            by[axis] = new - old
    # What a program changes of the offset in force, it may leave changed: printed, a machine datum.
    from_now = (TOOL, LENGTH) if WORK in now else (TOOL, LENGTH, WORK)
    kept = {name: value for name, value in before.items() if name not in from_now}
    return Moved(by, kept | {name: value for name, value in now.items() if name in (*from_now, _DATA)}, reason)


def zero_written_back(
    before: Zero, now: Zero, table: ZeroTable, axes: tuple[str, ...], mm: Decimal
) -> Iterator[str] | None:
    """Blocks that put a work offset and shifts in force again that were so before, where a unit has so many mm; None
    where what was in force is not known."""
    work, frames = before.get(WORK), {move: row.names.split()[0] for row in table.codes.values() for move in [row.move]}
    shifts = [(axis, before.get(_shift(axis)), before.get(_fine(axis))) for axis in axes]
    is_moved = any(before.get(key) != now.get(key) for axis in axes for key in (_shift(axis), _fine(axis)))
    is_other = work != now.get(WORK) and (not isinstance(work, tuple) or _DATA in now)
    if is_other or (is_moved and any(None in each for each in shifts)):
        return None
    lines = list[str]()
    if isinstance(work, tuple) and work != now.get(WORK):
        lines.append(" ".join(f"{address}{Decimal(number).normalize():f}" for address, number in work))
    if is_moved:
        lines.append(frames[ZeroMove.REPLACE])
    for move, key in ((ZeroMove.REPLACE, _shift), (ZeroMove.ADD, _fine)) if is_moved else ():
        amounts = ((axis, before.get(key(axis))) for axis in axes)
        words = [f"{axis}{amount / mm:f}" for axis, amount in amounts if isinstance(amount, Decimal) and amount]
        lines += [" ".join([frames[move], *words])] if words else []
    return iter(lines)


def _reason(row: ZeroRow, word: Word, block: Block) -> str:
    if row.move is ZeroMove.DATA:
        words = [each.text.strip() for each in block.words if each is word or each.address in ("L", "P")]
        return f"{' '.join(words)} changes an offset"
    text = " ".join(word.text.split())
    return f"{text} {'changes the ' + row.group if row.group in (TOOL, LENGTH) else 'changes the coordinate system'}"


def _select(zero: Zero, row: ZeroRow, word: Word, block: Block, lost: Moved) -> Moved | None:
    """The move by the selection of an offset. Behind a block that may be skipped, it is not known which is in force."""
    told = [(each.address, each.number) for each in block.words if each.address in row.words.split()]
    own = () if word.address in row.words.split() else ((word.address, word.number),)
    parts = dict[str, Decimal | int | None]([*own, *told])
    if row.indexed is not None and "P" in parts:
        parts["G"] = row.indexed
    parts = dict(row.stands_for) if row.stands_for else parts
    before = zero.get(row.group)
    if row.goes_on:
        parts = {**(dict(before) if isinstance(before, tuple) else {}), **parts}
    offset = tuple(sorted(parts.items()))
    if before == offset:
        return None
    kept = {name: value for name, value in zero.items() if name != row.group}
    is_known = not block.is_skippable and None not in parts.values()
    return replace(lost, zero={**kept, row.group: offset} if is_known else kept)


def shift_zero(
    zero: Zero,
    move: ZeroMove,
    block: Block,
    numbers: Mapping[str, Decimal | None] | None,
    axes: tuple[str, ...],
    reason: str,
) -> Moved:
    """The move by a shift with numbers in its block: by new minus old, mm, where both are known and nothing is turned.
    Of None, nothing is known."""
    shifts = {axis: _shifts_of(zero, axis) for axis in axes}
    is_bare = all(each.address in ("N", "G") for each in block.words)
    new: Mapping[str, _Shifts] = {}
    match move:
        case _ if numbers is None:
            pass
        case ZeroMove.FORMULA:
            new = {axis: (numbers.get(axis, _ZERO), _ZERO) for axis in axes}
            return _shifted(with_turn(zero, "", is_on=False), shifts, new, reason)
        case ZeroMove.SET:
            new = {axis: (value, shifts[axis][1]) for axis, value in numbers.items()}
        case ZeroMove.FINE:
            new = {axis: (shifts[axis][0], value) for axis, value in numbers.items()}
        case ZeroMove.ADD:
            new = {axis: (shifts[axis][0], _sum(shifts[axis][1], value)) for axis, value in numbers.items()}
        case ZeroMove.REPLACE | ZeroMove.TURN if is_bare:
            zero = with_turn(zero, "", is_on=False)
            return _shifted(zero, shifts, dict.fromkeys(axes, (_ZERO, _ZERO)), reason)
        case ZeroMove.REPLACE if not any(fine for _, fine in shifts.values()):
            # Whether the shift of an axis that is not named stays, manuals contradict.
            new = {
                axis: (numbers.get(axis, _ZERO if shift == 0 else None), fine) for axis, (shift, fine) in shifts.items()
            }
        case _:
            pass
    if not new or block.is_skippable or any(None in shifts[axis] for axis in new):
        return Moved(dict.fromkeys(axes), with_turn(forget_shifts(zero), "", is_on=True), reason)
    return _shifted(zero, shifts, new, reason)


def _shifted(
    zero: Zero,
    old: Mapping[str, _Shifts],
    new: Mapping[str, _Shifts],
    reason: str,
) -> Moved:
    """The reason that takes the place of shifts, where they have been along the axes."""
    sums = {axis: (_sum(*old[axis]), _sum(*each)) for axis, each in new.items()}
    by = {
        axis: None if before is None or after is None else after - before
        for axis, (before, after) in sums.items()
        if before is None or before != after
    }
    now = dict(zero)
    for axis, (shift, fine) in new.items():
        for name, value in ((_shift(axis), shift), (_fine(axis), fine)):
            now.pop(name, None)
            if isinstance(value, Decimal):
                now[name] = value
    return Moved(by, now, reason)


def _shifts_of(zero: Zero, axis: str) -> _Shifts:
    if turns_in(zero):
        return None, None
    first, second = (zero.get(name) for name in (_shift(axis), _fine(axis)))
    return first if isinstance(first, Decimal) else None, second if isinstance(second, Decimal) else None


def _sum(one: Decimal | None, other: Decimal | None) -> Decimal | None:
    return None if one is None or other is None else one + other


_PLAIN_SHIFT = re.compile(r"[$\w]++[ \t]*+=[ \t]*+CTRANS[ \t]*+\((?P<pairs>[^()]*+)\)[ \t]*+(?:;.*+)?$", re.IGNORECASE)
_PAIR = re.compile(
    r"[ \t]*+(?P<axis>[A-Z]\d?)[ \t]*+,[ \t]*+(?P<number>[+-]?+(?>\d++\.?+\d*+|\.\d++))[ \t]*+", re.IGNORECASE
)


def _formula(
    word: Word, block: Block, axes: tuple[str, ...], mm: Callable[[str, Decimal], Decimal | None]
) -> Mapping[str, Decimal | None] | None:
    """The shift that a frame states by numbers along axes alone; None for another frame."""
    found = _PLAIN_SHIFT.match(block.text, word.span.column - 1)
    if found is None or block.is_skippable:
        return None
    parts = found["pairs"].split(",")
    pairs = [_PAIR.fullmatch(",".join(parts[at : at + 2])) for at in range(0, len(parts), 2)]
    read = {each["axis"].upper(): Decimal(each["number"]) for each in pairs if each is not None}
    if len(read) < len(pairs) or not read.keys() <= {*axes}:
        return None
    return {axis: mm(axis, number) for axis, number in read.items()}


def entries_of_assignment(table: ZeroTable, block: Block) -> Iterator[Entry]:
    """The entries of tables that an assignment changes."""
    if table.variables is None or block.macro is None:
        return
    for found in _ASSIGNED.finditer(block.syntax.comment.sub("", block.text)):
        yield from table.variables((found["name"] or "").upper())
