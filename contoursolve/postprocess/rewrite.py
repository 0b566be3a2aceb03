"""Expands a program of any length from an open file into bytes, of which none are delivered before all are known."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from typing import IO, Any, Protocol

from msgspec import Struct

from contoursolve.execution import ProgramKind, kind_of
from contoursolve.gcode import Block, OpenFile, parse, parse_block
from contoursolve.postprocess.expander import Expander
from contoursolve.postprocess.expansion import OPENING, expand_lines, lines_of_facts, opening_of
from contoursolve.postprocess.expansion_report import ExpansionOptions, Left, Summary, left_unread
from contoursolve.postprocess.numbering import numbers_of
from contoursolve.postprocess.post_processors import Numbering
from contoursolve.program import (
    Lines,
    Recogniser,
    Request,
    SeveralControlsError,
    blocks_of_called_files,
    check_settings,
    check_start,
    choose_alike,
    conclusions,
    configure,
    for_machine,
    named_control,
)
from contoursolve.reading import Control

_BATCH = 1 << 16
"""Characters that are encoded at once."""

_CHUNK = 1 << 20
_REPORTED = 0.01
"""Share of a program after which the progress is told again."""


class Writer(Protocol):
    """Another way to read and write a program."""

    def lines(self, *args: Any, **options: Any) -> Lines:
        """The lines of the program on their way; arguments as for `Lines`."""

    def expander(self, *args: Any) -> Expander:
        """The pass over the program; arguments as for `Expander`."""


class Rewritten(Struct, frozen=True):
    """An expanded program in a temporary file, where the opening goes, and what became of the contours."""

    body: IO[bytes]
    place: int
    opening: bytes
    control: str | None
    summary: Summary

    def pieces(self) -> Iterator[bytes]:
        """The bytes of the program, in order."""
        self.body.seek(0)
        yield self.body.read(self.place)
        yield self.opening
        while chunk := self.body.read(_CHUNK):
            yield chunk


def rewrite(
    source: OpenFile,
    body: IO[bytes],
    options: ExpansionOptions,
    asked: Request,
    *,
    control: str | Control | None = None,
    settings: Mapping[str, str] | None = None,
    progress: Callable[[float], None] = lambda _: None,
    writer: Writer | None = None,
) -> Rewritten:
    """Expand a program into `body`, for the control of this name, or that it shows, with these settings; `progress` is
    told which share of it has been read; a `writer` reads and writes it in another way.

    Raises UnknownControlError, SettingError and FactPlaceError, as `solve` does. With facts, all of the program is
    held in memory, to see which contour they are about.
    """
    unread: list[Left] = []
    recogniser = Recogniser(source.name)
    named, chosen = named_control(control, settings), None
    with suppress(SeveralControlsError):
        chosen = named or _recognise(recogniser, _blocks(source, unread))
    shows = recogniser.signs or recogniser.may_turn
    if chosen is None and (shows or blocks_of_called_files(source.lines(), asked.around)):
        chosen = choose_alike(None, parse(source.read(), source.name), asked, settings)
    summary = Summary()
    body.write(source.mark)
    if chosen is None:
        check_settings(settings or {})
        summary.left += unread
        lines: Iterable[str | object] = source.lines()
    else:
        chosen = configure(chosen, settings)
        if not isinstance(control, Control):
            chosen = for_machine(chosen, settings or {}, source.lines())
        asked = asked.of(chosen, source.lines)
        check_start(asked)
        summary.concluded += conclusions(asked, ())
        places = lines_of_facts(parse(source.read(), source.name), asked) if asked.facts else {}
        is_certain = bool(named or recogniser.begun) or not recogniser.is_sure
        lines = expand_lines(
            (writer.lines if writer else Lines)(source.lines(), chosen, places, is_certain=is_certain),
            chosen,
            asked,
            options,
            summary,
            numbers=numbers_of(source.lines(), chosen) if options.numbering is Numbering.ALL else None,
            runs=ProgramKind.IN_ORDER if writer else kind_of(source.lines(), chosen.modes.language),
            expander=writer.expander if writer else None,
        )
    held: list[str] = []
    size, place, told = 0, len(source.mark), 0.0
    for line in lines:
        if line is OPENING:
            body.write(source.encode("".join(held)))
            held, size, place = [], 0, body.tell()
            continue
        held.append(str(line))
        size += len(held[-1])
        if size >= _BATCH:
            body.write(source.encode("".join(held)))
            held, size = [], 0
            if source.share - told >= _REPORTED:
                told = source.share
                progress(told)
    body.write(source.encode("".join(held)))
    opening = opening_of(options, chosen, asked.unit, summary) if chosen else ""
    return Rewritten(body, place, source.encode(opening), chosen.name if chosen else None, summary)


def _recognise(recogniser: Recogniser, blocks: Iterable[Block]) -> Control | None:
    """The control that blocks are for. Where its words are its own, it is known at once."""
    for block in blocks:
        recogniser.look(block)
        if recogniser.is_sure:
            break
    return recogniser.find()


def _blocks(source: OpenFile, unread: list[Left]) -> Iterator[Block]:
    """The blocks of a program; those that are too long to be read are added to `unread`."""
    for number, line in enumerate(source.lines(), 1):
        block = parse_block(line.rstrip("\r\n"), number)
        unread += filter(None, [left_unread(block)])
        yield block
