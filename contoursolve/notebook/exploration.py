"""A contour that is being explored: the block's text, and every way to change it. Nothing here knows a notebook."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from decimal import Decimal, InvalidOperation
from itertools import islice, product
from math import hypot
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from contoursolve.api import solve
from contoursolve.diagnosis import (
    FARTHEST,
    Answer,
    Edit,
    EditKind,
    Solution,
    apply_edits,
    join,
    list_solutions,
    word_keys,
    write_word,
)
from contoursolve.diagnostics import Diagnostic, Span
from contoursolve.gcode import FACT, TypedPlace, Word, parse, split_lines, typed_places, words_called
from contoursolve.geometry import Pick, Unit
from contoursolve.notebook.block_place import BlockPlace
from contoursolve.output import stated_words
from contoursolve.program import Changes, Result, UnknownControlError, changed, changes_of
from contoursolve.reading import Control, Lexicon
from contoursolve.solving import Status
from contoursolve.tool_radius import FROM_PROGRAM, SideName, Tool, ToolReport, make_tool, radius_in, read_tool, tool_in

SAME = 1e-3
"""mm. Contours whose points are this close are one: a fact that selects is written with three decimals."""

TOOL = "tool"
"""The key of the radius of the tool, beside those of words."""

MOST_DIGITS = 8
"""Of a number; controls read no more."""

_DECIMALS = 4
"""Of the radius of a tool, at most."""

MOST_TRIED = 16
"""Ways to write what selects a solution that are tried."""


Examiner = Callable[[str], Result]


class Exploration(Struct, frozen=True):
    """The text of a contour as it is now, what it comes to, and what it was first."""

    text: str
    options: Mapping[str, Any]
    """Options of the reading: the other arguments of `solve`."""
    result: Result
    origin: tuple[str, BlockPlace | None]
    """The text and the place as they were first."""
    place: BlockPlace | None = None
    """The place of the block in a program of which it is a part; None where the text has nothing else to explore."""
    last: Mapping[str, str] = field(default_factory=dict)
    """Text of a word before it was freed, by its key."""
    is_recognised: bool = False
    """Whether the words told the control, so that others may tell another one."""
    side: SideName | None = None
    """The side of the contour on which the tool runs, where the text does not say it."""
    tool: ToolReport | None = None
    """The report about the tool that the text states, if it states one."""
    examine: Examiner | None = None
    """The examination of a text, with the result that `solve` has; None for `solve` itself."""

    @property
    def answer(self) -> Answer | None:
        """The contour; None while the block holds none."""
        return next(iter(self.answers), None)

    @property
    def answers(self) -> Sequence[Answer]:
        """The contours of the block: one at most, but where a reader has typed more."""
        return [each for each in self.result.answers if any(map(self.has, each.lines))]

    @property
    def block(self) -> str:
        """The text of the block that is explored."""
        blocks = self.result.program.blocks
        return self.text if self.place is None else "\n".join(each.text for each in blocks if self.has(each.line))

    def has(self, line: int) -> bool:
        """Whether a line of the program is one of the block's."""
        return self.place is None or self.place.has(line, len(self.result.program.blocks))

    @property
    def findings(self) -> Sequence[tuple[int, Diagnostic]]:
        """The findings about the block, each with its number among those of the program."""
        result, own = self.result, {id(found) for each in self.answers for found in each.diagnostics}
        return [
            (number, each)
            for number, each in enumerate(result.diagnostics)
            if id(each) in own or self.has(result.place(each.span).line)
        ]


def begin(
    text: str,
    facts: Iterable[str] = (),
    line: int | None = None,
    tool: str | None = None,
    side: SideName | None = None,
    examine: Examiner | None = None,
    **options: Any,
) -> Exploration:
    """An exploration of the only contour of a text, or of the one to which a line of it belongs. Facts and a tool are
    written into it as comments. A program that is open may `examine` it: only what a change makes necessary.

    Raises ValueError if the text has several contours and no line chooses, or that belongs to none; and as `solve`.
    """
    (result, report), place = _examined(text, side, options, examine), None
    if line is not None:
        lines = result.contour_at(line).lines
        place = BlockPlace(lines[0] - 1, len(result.program.blocks) - lines[-1])
    # A reader may take out the word by which the control is recognised.
    is_recognised = options.get("control") is None
    kept = {**options, "control": options["control"] if isinstance(options.get("control"), Control) else result.control}
    now = Exploration(text, kept, result, (text, place), place, {}, is_recognised, side, report, examine)
    _check_single(now)
    if tool is not None:
        read_tool(tool)
        first = now.answer.lines[0] if now.answer is not None else 1
        stated = result.program.syntax.remark.format(f"contoursolve tool: {tool.strip()}")
        now = _edited(now, [Edit(EditKind.ADD, FACT, text=stated, line=first)])
    several = [facts] if isinstance(facts, str) else list(facts)
    if several:
        now = _edited(now, [_fact_edit(now, several)])
    return replace(now, origin=(now.text, now.place))


def _examined(
    text: str, side: SideName | None, options: Mapping[str, Any], examine: Examiner | None = None
) -> tuple[Result, ToolReport | None]:
    """The result of a text, with what is said of the tool that it states."""
    if any(tool_in(line) is not None for line in split_lines(text)):
        result = solve(text, tool=FROM_PROGRAM, side=side, **options)
        return result, result.tool
    return examine(text) if examine is not None else solve(text, **options), None


def _check_single(exploration: Exploration) -> None:
    """Raise ValueError if a block makes several contours."""
    answers = exploration.answers
    if len(answers) < 2:  # noqa: PLR2004
        return
    lines = [str(answer.lines[0]) for answer in answers]
    if len({*lines}) == 1:
        raise ValueError(
            f"program line {lines[0]} makes {len(answers)} contours, one each time it runs; explore its block alone, "
            "with numbers for its variables"
        )
    whole = "this text" if exploration.place is None else "this block"
    advice = f"; choose one, such as line={lines[0]}" if exploration.place is None else ""
    raise ValueError(
        f"one contour can be explored at a time; {whole} has {len(answers)} (program lines {', '.join(lines)}){advice}"
    )


def _fact_edit(exploration: Exploration, facts: Sequence[str]) -> Edit:
    """The comment that states facts about a contour in its last block."""
    program = exploration.result.program
    stated = "; ".join(facts).replace("(", "[").replace(")", "]")
    last = max((each.line for each in program.blocks if each.words and exploration.has(each.line)), default=1)
    return Edit(EditKind.ADD, FACT, text=program.syntax.remark.format(f"contoursolve: {stated}"), line=last)


def write(exploration: Exploration, text: str) -> Exploration:
    """The same contour with another text of the whole program. Raises as `solve`."""
    place = exploration.place.in_another(exploration.text, text) if exploration.place is not None else None
    return _solved(exploration, text, place)


def _solved(exploration: Exploration, text: str, place: BlockPlace | None) -> Exploration:
    found = _examined(text, exploration.side, exploration.options, exploration.examine)
    return _with_result(exploration, text, place, *found)


def _with_result(
    exploration: Exploration, text: str, place: BlockPlace | None, result: Result, tool: ToolReport | None
) -> Exploration:
    now = replace(exploration, text=text, place=place, result=result, tool=tool)
    if place is not None and now.answer is not None:  # a contour may take in the lines beside it
        lines, count = now.answer.lines, len(result.program.blocks)
        widened = BlockPlace(min(place.before, lines[0] - 1), min(place.behind, count - lines[-1]))
        now = replace(now, place=widened)
    words = words_of(now.answer) if now.answer is not None else {}
    return replace(now, last={key: old for key, old in now.last.items() if key in words and words[key].is_asked})


def rewrite(exploration: Exploration, text: str) -> Exploration:
    """Another text of the whole program, perhaps for another control, if nobody chose one. Raises ValueError if it has
    several contours, and as `solve`."""
    return _rewritten(write(exploration, text))


def rewrite_block(exploration: Exploration, text: str) -> Exploration:
    """Another text of the block, with all lines around it as they are; as `rewrite`."""
    if exploration.place is None:
        return rewrite(exploration, text)
    lines = [each.line for each in exploration.result.program.blocks if exploration.has(each.line)]
    if not lines:  # all of the block was taken out
        around = split_lines(exploration.text)
        around.insert(exploration.place.before, f"{text}\n")
        whole = "".join(around)
    else:
        changes: dict[int, str | None] = dict.fromkeys(lines)
        whole = changed(exploration.text, {**changes, lines[0]: text})
    return _rewritten(_solved(exploration, whole, exploration.place))


def _rewritten(now: Exploration) -> Exploration:
    """Text that a reader typed, read for another control if it is for that one alone."""
    if now.is_recognised:
        try:
            other, tool = _examined(now.text, now.side, {**now.options, "control": None})
        except UnknownControlError:
            other, tool = None, None  # several read it, or none
        if other is not None and other.answers and other.control != now.result.control:
            options = {**now.options, "control": other.control}
            now = _with_result(replace(now, options=options), now.text, now.place, other, tool)
    _check_single(now)
    return now


def reset(exploration: Exploration) -> Exploration:
    """The contour as it was first."""
    return _solved(exploration, *exploration.origin)


def words_of(answer: Answer) -> dict[str, Word]:
    """The words of a contour by their keys, in the order of the program: `A` where only one block of the contour has
    that address, else with its line, `2:,A`."""
    keys = word_keys(answer.claim.words.values())
    words = {word.span: word for word in answer.claim.words.values()}
    return {key: words[span] for span, key in keys.items()}


def places_of(answer: Answer) -> dict[Span, TypedPlace]:
    """The places of the words of a contour in the text, by their places in its blocks with numbers for variables."""
    return typed_places(answer.claim.words.values(), answer.claim.blocks)


class ComputedWord(Struct, frozen=True):
    """A word as it is typed, and the variables and expressions that give its value."""

    text: str
    formulas: tuple[str, ...]

    @property
    def told(self) -> str:
        """The reason why it cannot be moved."""
        names = join([each.lstrip("+-") for each in self.formulas])
        return f"{self.text} takes its value from {names}; change that in the program"


def computed_words(exploration: Exploration) -> dict[str, ComputedWord]:
    """The words of the contour whose values are variables or expressions, by their keys."""
    answer = exploration.answer
    if answer is None:
        return {}
    texts, places = {each.line: each.text for each in exploration.result.program.blocks}, places_of(answer)
    found = {}
    for key, word in words_of(answer).items():
        span, formulas = places[word.span]
        if formulas:
            text = texts[span.line][span.column - 1 : span.end_column - 1].strip()
            found[key] = ComputedWord(text, formulas)
    return found


def values_of(exploration: Exploration) -> dict[str, float]:
    """The values of the words as they are typed, by their keys; none of those that are asked for, or computed."""
    answer = exploration.answer
    computed = computed_words(exploration)
    words = () if answer is None else stated_words(answer)
    found = {each.key: each.value for each in words if each.key not in computed}
    tool = tool_place(exploration)
    found |= {TOOL: float(tool[1].radius)} if tool is not None else {}
    return {key: value for key, value in found.items() if value is not None and key != FACT}


def set_word(exploration: Exploration, key: str, value: float | str) -> Exploration:
    """The contour with a word at another value, in the unit in which the word is written, rounded to the least
    increment of the control. Raises ValueError if there is no such word, or this is no number."""
    return set_words(exploration, {key: value})


def set_words(exploration: Exploration, values: Mapping[str, float | str]) -> Exploration:
    """The contour with several words at other values at once; as `set_word`."""
    edits = []
    for key, value in values.items():
        place = tool_place(exploration) if key == TOOL else None
        if place is not None:
            span, old = place
            radius = make_tool(round(_decimal(TOOL, value), _DECIMALS), None).radius
            text = f"{radius.normalize():f}"
            edits.append(Edit(EditKind.CHANGE, FACT, span, f"{old.radius}", text))
            continue
        answer, _, word = _find(exploration, key)
        edits.append(_change(answer, word, _written(answer, word, value)))
    return _edited(exploration, edits)


def tool_place(exploration: Exploration) -> tuple[Span, Tool] | None:
    """The place where the text states the radius of the tool that cuts the contour, and that tool."""
    last = exploration.answer.lines[0] if exploration.answer is not None else 0
    for block in reversed(exploration.result.program.blocks[:last]):
        found, tool = radius_in(block.text), tool_in(block.text)
        if found is not None and tool is not None:
            return Span(block.line, *found), tool
    return None


def is_movable(answer: Answer, word: Word) -> bool:
    """Whether a word has a value that can be moved, or a sign that can be turned; not one that says which facts a chain
    has, by its sign or by the number of a block."""
    row = answer.claim.lexicon.addresses.get(word.address)
    return row is not None and not (answer.claim.form.is_general and row.unit is Unit.SIGN)


def free(exploration: Exploration, key: str) -> Exploration:
    """The contour with `?` for a word; a word that was freed gets back the value that the others give it, or the one
    that it had."""
    answer, key, word = _find(exploration, key)
    if not word.is_asked:
        freed = _edited(exploration, [_change(answer, word, answer.claim.lexicon.spell(word.address, "?"))])
        return replace(freed, last={**exploration.last, key: word.text})
    found = next((each for each in answer.asked if each.question.word.span == word.span), None)
    text = exploration.last.get(key, answer.claim.lexicon.spell(word.address, "0."))
    if found is not None and found.value is not None:
        text = write_word(word.address, found.value, answer.claim.lexicon, answer.unit)
        text = _signed(text, word.address, exploration.last.get(key, ""), answer.claim.lexicon)
    return _edited(exploration, [_change(answer, word, text)])


def apply_fix(exploration: Exploration, finding: int, number: int, *, is_example: bool = False) -> Exploration:
    """The contour with a fix of one of the result's findings, whose gaps have the numbers of its example if
    `is_example`. Raises ValueError if there is none."""
    result = exploration.result
    findings = result.diagnostics
    if not (0 <= finding < len(findings) and 0 <= number < len(findings[finding].fixes)):
        raise ValueError(f"there is no fix {number} of finding {finding}")
    fix = findings[finding].fixes[number]
    if is_example:
        fix = replace(fix, replacement=fix.example or fix.replacement)
    old = {block.line: block.text for block in result.program.blocks}
    return _changed(exploration, changes_of(fix, result.lines_of(findings[finding]), old))


def select(exploration: Exploration, number: int) -> Exploration:
    """The contour with the words or the fact that select one of its solutions; facts that say no more than the words
    that they answered are left out then. Raises ValueError if nothing selects it."""
    answer = exploration.answer
    listing = list_solutions(answer) if answer else None
    if answer is None or listing is None or not 0 <= number < len(listing.solutions):
        raise ValueError(f"there is no solution {number}")
    wanted = listing.solutions[number]
    if wanted.picks:
        return _edited(exploration, _picking(answer, wanted.picks))
    first = None
    for edits in islice(_selecting(exploration, answer, wanted), MOST_TRIED):
        tried = _edited(exploration, edits)
        first = first or tried
        if _is_chosen(tried, wanted, SAME):
            is_told_by_words = any(
                block.words
                for text in wanted.selects
                for block in parse(text, syntax=tried.result.program.syntax).blocks
            )
            return _without_echoes(tried, wanted) if is_told_by_words else tried
    if first is None:
        raise ValueError(f"no word selects {wanted.name}")
    return first


def _picking(answer: Answer, picks: Sequence[Pick]) -> Iterator[Edit]:
    """The words that choose a solution by its numbers: those that are there changed, the others behind their elements.
    One that has nothing to choose any more chooses the first."""
    claim, word = answer.claim, answer.claim.form.free.picking
    lines = {name: block.line for block, names in zip(claim.blocks, claim.makes, strict=True) for name in names}
    wanted = {each.element: each.number for each in picks}
    present = {each.element: claim.words[each.given] for each in answer.profile.picks if each.given}
    for element, old in present.items():
        yield _change(answer, old, claim.lexicon.spell(word, str(wanted.get(element, 1))))
    for element in wanted.keys() - present.keys():
        line = lines[answer.profile.figure.path[element - 1].name]
        yield Edit(EditKind.ADD, word, text="\n" + claim.lexicon.spell(word, str(wanted[element])), line=line)


def _selecting(exploration: Exploration, answer: Answer, wanted: Solution) -> Iterator[Sequence[Edit]]:
    """The edits that write what selects a solution, for every block in which that can be written."""
    ways = []
    for text in wanted.selects:
        address = next(
            (word.address for word in parse(text, syntax=exploration.result.program.syntax).blocks[0].words), FACT
        )
        present = [word for word in words_of(answer).values() if word.address == address]
        lines = [block.line for block in reversed(answer.claim.blocks) if block.words]
        ways.append(
            [_change(answer, word, text) for word in present]
            or [Edit(EditKind.ADD, address, text=text, line=line) for line in lines]
        )
    yield from product(*ways) if ways else ()


def _edited(exploration: Exploration, edits: Iterable[Edit]) -> Exploration:
    """The contour with edits of its blocks made."""
    blocks = exploration.result.program.blocks
    texts = zip(blocks, apply_edits(blocks, edits), strict=True)
    return _changed(exploration, {block.line: text for block, text in texts if text != block.text})


def _changed(exploration: Exploration, changes: Changes) -> Exploration:
    """The contour with other texts of lines; those around keep every character."""
    place = exploration.place
    moved = place.after_changes(changes, len(exploration.result.program.blocks)) if place is not None else None
    return _solved(exploration, changed(exploration.text, changes), moved)


def _change(answer: Answer, word: Word, text: str) -> Edit:
    """The edit that writes a text for a word of a contour, where that was typed."""
    return Edit(EditKind.CHANGE, word.address, places_of(answer)[word.span].span, word.text, text)


def _find(exploration: Exploration, name: str) -> tuple[Answer, str, Word]:
    """The word of a name, with its key."""
    answer = exploration.answer
    words = words_of(answer) if answer else {}
    called = words_called(name, words.values())
    if answer is None or len(called) != 1:
        several = f"{len(called)} words {name}" if called else f"no word {name}"
        raise ValueError(f"the contour has {several}; there are {', '.join(words) or 'none'}")
    key = next(key for key, word in words.items() if word is called[0])
    if not is_movable(answer, words[key]):
        raise ValueError(f"{key} has no value to move")
    if key in (computed := computed_words(exploration)):
        raise ValueError(computed[key].told)
    return answer, key, words[key]


def _written(answer: Answer, word: Word, value: float | str) -> str:
    """A word with another number, as the control reads it."""
    number = _decimal(word.address, value)
    lexicon = answer.claim.lexicon
    if lexicon.addresses[word.address].unit is Unit.SIGN:
        return lexicon.spell(word.address, "-1" if number < 0 else "1")
    meant = lexicon.value(replace(word, number=number, has_point=True, is_asked=False), answer.unit)
    text = write_word(word.address, float(meant or 0), lexicon, answer.unit)
    is_signed = any("+" in each.text for each in answer.claim.words.values())
    is_negative = lexicon.number_of(word.text, word.address)[:1] == "-"
    return _signed(text, word.address, "+" if is_signed and is_negative else word.text, lexicon)


def _decimal(name: str, value: float | str) -> Decimal:
    """A number that a reader gives, perhaps with a decimal comma. Raises ValueError for what is none."""
    try:
        number = Decimal(value.replace(",", ".") if isinstance(value, str) else str(value))
    except InvalidOperation:
        number = Decimal("NaN")
    if not number.is_finite():
        raise ValueError(f"{name} needs a number, not {value!r}")
    if number.adjusted() > MOST_DIGITS:
        raise ValueError(f"{name} takes numbers below {10 ** (MOST_DIGITS + 1):,}, not {value}")
    return number


def _signed(text: str, address: str, like: str, lexicon: Lexicon) -> str:
    """A word whose number has a plus as another one's has, unless it is negative."""
    number = lexicon.number_of(text, address)
    return lexicon.spell(address, f"+{number}") if "+" in like and number[:1] not in ("-", "+") else text


def _without_echoes(exploration: Exploration, wanted: Solution) -> Exploration:
    """The contour without the facts that only say what its words say: those by which a word was asked for, now that its
    value is written. It moves no farther than values that are filled in may move it."""
    blocks = [block for block in exploration.result.program.blocks if exploration.has(block.line)]
    facts = [each for block in blocks for each in block.directives]
    for fact in reversed(facts):
        if exploration.answer is None or exploration.answer.status is not Status.OVERDETERMINED:
            break
        shorter = _edited(exploration, [Edit(EditKind.DROP, FACT, fact.span, fact.text)])
        if _is_chosen(shorter, wanted, FARTHEST):
            exploration = shorter
    return exploration


def _is_chosen(exploration: Exploration, wanted: Solution, within: float) -> bool:
    """Whether the contour is now the one that was wanted, to a distance in mm."""
    contour = exploration.answer.contour if exploration.answer else None
    if contour is None or wanted.contour is None or contour.points.keys() != wanted.contour.points.keys():
        return False
    pairs = [(contour.end, wanted.contour.end)]
    pairs += [(at, wanted.contour.points[name]) for name, at in contour.points.items()]
    return all(hypot(one[0] - other[0], one[1] - other[1]) < within for one, other in pairs)
