"""One pass over a program: contours whose words hold variables become formulas, the others plain G-code."""

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from decimal import Decimal
from itertools import count
from typing import Any

from contoursolve.diagnosis import Answer, Policy
from contoursolve.execution import Assign, ProgramEnd, When, place_in, write_term
from contoursolve.gcode import Block, Passage, blocks_in, comment_out, words_of
from contoursolve.numeric import Affine, Term, Variable
from contoursolve.postprocess.expander import Expander
from contoursolve.postprocess.expansion_report import Left
from contoursolve.postprocess.formulas.cases import Case, Fork, case_of
from contoursolve.postprocess.formulas.contour_statements import BlockUnits, Body, Choose, Leg, Said, Statement
from contoursolve.postprocess.formulas.formula_lines import FormulaLines, Free, MacroLine
from contoursolve.postprocess.formulas.macro_targets import PREFIXES, MacroTarget, TargetWriter, lowered
from contoursolve.postprocess.formulas.scratch_variables import Scratch, allocate, apart, names_of, place, renamed
from contoursolve.postprocess.formulas.trial_run import Runner, difference
from contoursolve.postprocess.formulas.word_dependence import STEP, FormulaError, Reader, at
from contoursolve.program import Step
from contoursolve.reading import ContourBlock, Position, State, advance, blocks_of, carried


class FormulaExpander(Expander):
    """One pass over one program with variables."""

    lines: FormulaLines

    def __init__(
        self, *args: Any, target: MacroTarget, scratch: Scratch, policy: Policy, taken: Collection[str], label: int
    ) -> None:
        super().__init__(*args)
        self.target, self.scratch, self.policy, self.taken = target, scratch, policy, taken
        self.writer = TargetWriter(target, self.control.plane, label)
        self.axes: dict[str, Affine | None] = {}
        """The axes whose place follows variables, mm; None where that cannot be told any more."""
        self.free: dict[str, Free] = {}
        self.written = 0
        """How many contours are formulas."""

    # Where the tool is

    def _pass(self, passage: Passage, state: State) -> Iterator[str | object]:
        said = words_of(passage.text, passage.syntax)
        self.axes = {axis: each for axis, each in self.axes.items() if axis not in said}
        if said and self.is_foreign and self.target.is_klartext:
            for block in blocks_in(passage):
                yield from self._keep(block, state)
            return
        yield from super()._pass(passage, state)

    def _keep(self, block: Block, state: State, there: int | None = None) -> Iterator[str]:
        macro = self.lines.macros.get(block.line)
        if macro is not None or self.axes:
            self._follow(block, state)
        if macro is not None and not macro.code.words and all(isinstance(x, ProgramEnd) for x in macro.code.statements):
            macro = None
        is_other = self.is_foreign and self.target.is_klartext and bool(block.words)
        if not is_other and (macro is None or not self.is_foreign):
            yield from super()._keep(block, state, there)
            return
        text = self._in_its_language(macro) if macro is not None and not is_other else ""
        if not text:
            reason = f"{block.text.strip()} is no contour: write it in {self.target.notation} by hand"
            self.summary.left.append(Left((block.line,), reason, (), {block.line: block.text}))
        yield (text or block.text) + self.lines.take_end(block.line)

    @property
    def is_foreign(self) -> bool:
        """Whether variables have other names on the target."""
        return self.target.prefix != PREFIXES.get(self.lines.language.name if self.lines.language else "", "#")

    def _in_its_language(self, macro: MacroLine) -> str:
        """A line that assigns, or has words with variables, as the target has it; empty if that cannot be told."""
        code = macro.code
        if not all(isinstance(each, Assign) for each in code.statements):
            return ""
        text = code.rest
        for word in reversed(code.words):
            value = f"{self.target.equals}{write_term(self._own(word.value), self.target.notation)}"
            text = word.put(value, text)
        statements = [
            Assign(self._own(each.variable), self._own(each.value))  # type: ignore[arg-type]
            for each in code.statements
            if isinstance(each, Assign)
        ]
        return self.lines.end.join([*([text.rstrip()] if text.strip() else []), *self.writer.lines(statements)])

    def _follow(self, block: Block, state: State) -> None:
        """Follow a block outside contours to its end, and note the values that it changes."""
        macro = self.lines.macros.get(block.line)
        slots = {slot.free.name: slot.free for slot in macro.slots} if macro else {}
        held = {axis: each for axis, each in self.axes.items() if each is not None}
        free = {**self.free, **slots}
        known = {name: each.value for name, each in free.items()}

        def after(values: Mapping[str, Decimal]) -> State:
            moved = {axis: Position(at(each, values), "", state.axes[axis].span) for axis, each in held.items()}
            typed = macro.typed(block, values)[0] if macro else block
            return advance(state.move(moved), typed, self.modes)

        here = after(known).axes
        names = [*slots, *dict.fromkeys(name for each in held.values() for name in each.factors)]
        beside = {name: after({**known, name: known[name] + STEP}).axes for name in names}
        for axis, position in here.items():
            value = position.value
            if value is None:
                continue
            moved = {name: beside[name][axis].value for name in names}
            factors = {
                name: (each - value) / STEP for name, each in moved.items() if each is not None and each != value
            }
            if factors:
                rest = value - sum((factors[name] * known[name] for name in factors), Decimal(0))
                self.axes[axis] = Affine(factors, rest)
            elif self.axes.get(axis) is not None or any(word.address == axis for word in block.words):
                self.axes.pop(axis, None)
        self.free = free
        changed = {name for each in (macro.code.statements if macro else ()) for name in _set_by(each)}
        for axis, each in list(self.axes.items()):
            used = {name for free_name in (each.factors if each else ()) for name in names_of(free[free_name].term)}
            if changed & used:
                self.axes[axis] = None

    # What is replaced

    def _replace(self, step: Step, answer: Answer) -> Iterator[str]:
        axes = answer.plane.axes
        is_plain = not any(block.line in self.lines.macros for block in answer.claim.blocks)
        if is_plain and not any(axis in self.axes for axis in axes):
            yield from super()._replace(step, answer)
            return
        try:
            texts = list(self._formulas(step, answer))
        except FormulaError as error:
            for axis in axes:
                self.axes[axis] = None
            yield from self._leave(step, answer, f"no formulas: {error}")
            return
        self.summary.replaced += 1
        self.written += 1
        self.summary.warn(answer.diagnostics)
        yield from texts

    def _reader(self, step: Step, answer: Answer) -> Reader:
        """The contour as it follows variables. Raises FormulaError."""
        blocks, macros = answer.claim.blocks, self.lines.macros
        own = {
            slot.free.name: slot.free for block in blocks if block.line in macros for slot in macros[block.line].slots
        }
        axes = dict[str, Affine]()
        for axis in answer.plane.axes:
            if axis in self.axes:
                value = self.axes[axis]
                if value is None:
                    raise FormulaError(f"{axis} of its start follows variables that have changed")
                axes[axis] = value
        names = {name for each in axes.values() for name in each.factors}
        free = {**{name: self.free[name] for name in self.free if name in names}, **own}
        return Reader(self.control, self.policy, tuple(step.blocks), macros, answer.claim.before, axes, free)

    def _formulas(self, step: Step, answer: Answer) -> Iterator[str]:
        if answer.start.is_relative and not all(part.state.is_incremental for part in self._parts(answer)):
            raise FormulaError("where it begins is not known")
        self.writer.plane, reader = answer.plane, self._reader(step, answer)
        parts = {each.block.line: each for each in blocks_of(answer.claim, step.before, self.modes)}

        def writing_of(other: Answer) -> dict[str, BlockUnits]:
            figure = other.profile.figure
            names = [each.name for each in (*figure.path, *figure.corners)]
            return {name: self._writing(_part_of(name, parts), other) for name in names}

        case = case_of(reader, {}, writing_of)
        lines = [line for line in parts if any(map(parts[line].makes, writing_of(answer)))]
        making = [parts[line] for line in lines]
        words = {block.line: self._beside(block, parts[block.line]) for block in step.blocks if block.line in parts}
        if isinstance(case, Body):
            split = [_of_block(case, making, place) for place in range(len(lines))]
        else:
            # Each case is written as a whole, with what its blocks say besides.
            split = [_of_cases(case, making, [words.pop(line) for line in lines])]
        statements, ends = self._placed(reader, split, case)
        self._check(reader, [each for block in statements for each in block], writing_of)
        self._end(answer, reader, ends, self._writing(making[-1], answer))
        for block in step.blocks:
            if block.line not in parts:
                yield from super()._keep(block, step.before)
                continue
            first, last = words.get(block.line, ((), ()))
            place = lines.index(block.line) if block.line in lines else len(statements)
            own = self.writer.lines(statements[place]) if place < len(statements) else ()
            end = self.lines.take_end(block.line)
            text = [*self._commented_out(block), *first, *own, *last]
            yield (end or self.lines.end).join(text) + end if text else ""
        self.motion = NO_MOTION

    def _writing(self, part: ContourBlock, answer: Answer) -> BlockUnits:
        """The units of the words of a block."""
        mm = float(part.state.unit.in_mm)
        first, second = ((2 if is_diameter else 1) / mm for is_diameter in answer.plane.diameters)
        return BlockUnits((first, second), part.state.is_incremental)

    def _placed(
        self, reader: Reader, blocks: Sequence[Sequence[Statement]], case: Case
    ) -> tuple[list[list[Statement]], list[Term]]:
        """The statements of blocks in variables of the control, and where the contour ends."""
        numbers, terms = count(), {name: self._own(each.term) for name, each in reader.free.items()}
        simple = {name: term for name, term in terms.items() if isinstance(term, Variable)}
        found = [[place(each, simple) for each in lowered(block, self.target, numbers)] for block in blocks]
        found[0] = [*(Assign(Variable(name), term) for name, term in terms.items() if name not in simple), *found[0]]
        held = (term for axis in self.axes.values() if axis for name in axis.factors for term in [self.free[name].term])
        taken = {*self.taken, *(name for term in held for name in names_of(self._own(term)))}
        ends = case.end if isinstance(case, Body) else END
        return allocate(found, self.scratch, taken, [place_in(each, simple) for each in ends])

    def _own(self, term: Term) -> Term:
        """A term of the program in variables of the target."""
        return renamed(term, self.target.prefix) if self.is_foreign else term

    def _check(
        self, reader: Reader, statements: Sequence[Statement], writing: Callable[[Answer], Mapping[str, BlockUnits]]
    ) -> None:
        """Hold what is written against single solves, for the example and beside it. Raises FormulaError."""
        known = {name: value for each in reader.free.values() for name, value in each.known.items()}
        tried = [known, *({**known, name: value * by} for name, value in known.items() for by in BESIDE)]
        for values in tried:
            runner = Runner(values)
            rows = {name: Decimal(repr(runner.value(each.term))) for name, each in reader.free.items()}
            answer = reader.answer(rows if values is not known else {})
            own = {getattr(self._own(Variable(name)), "name", name): value for name, value in values.items()}
            problem = difference(statements, own, answer, writing(answer))
            if problem:
                shown = ", ".join(f"{name}={value:g}" for name, value in values.items())
                raise FormulaError(f"{problem}, at {shown}")

    def _end(self, answer: Answer, reader: Reader, ends: Sequence[Term], writing: BlockUnits) -> None:
        """Set the position behind a contour to its end."""
        contour = answer.contour
        if contour is None:
            raise FormulaError("the example has no contour")
        rows = zip(answer.plane.axes, ends, contour.end, writing.scales, strict=True)
        for axis, term, at_end, scale in rows:
            name = f"end of program line {answer.lines[-1]} on {axis}"
            names = names_of(term)
            if not names or answer.start.is_relative:
                self.axes.pop(axis, None)
                continue
            value = at_end * scale
            known = {each: free.known[each] for free in reader.free.values() for each in names if each in free.known}
            self.free[name] = Free(name, term, Decimal(repr(value)), known or {next(iter(names)): value})
            self.axes[axis] = Affine({name: Decimal(repr(1 / scale))}, Decimal(0))

    def _commented_out(self, block: Block) -> list[str]:
        return comment_out(block.text.strip(), self._syntax_of(block)) if self.options.has_comments else []

    def _beside(self, block: Block, part: ContourBlock) -> tuple[Sequence[str], Sequence[str]]:
        """The lines before the path of a block and those behind it, for everything else that it says. Raises
        FormulaError."""
        if block.is_skippable:
            raise FormulaError("its blocks begin with /")
        rest = carried(block, self.modes)
        own = {word.text.strip(): new for word, new in self._switches(block) if new}
        self.watch.look(block, [word for word in rest.kept if word.text.strip() not in own], part.state, None)
        said = [[*(own.get(code, code) for code in rest.codes), *rest.words]]
        if rest.numbers or said[0]:
            self._tell(block, self.numberer.number(block, [*rest.numbers], said))
        return [" ".join(words) for words in said if words], [" ".join(rest.last)] if rest.last else []


NO_MOTION = -1
"""The motion in force behind formulas: what it is, their values tell."""

BESIDE = (0.95, 1.05)
"""Shares of the example at which formulas are checked as well."""

END = Variable("end:0"), Variable("end:1")
"""Variables for the end of each of several cases."""


def _of_block(case: Body, parts: Sequence[ContourBlock], number: int) -> list[Statement]:
    """The statements for one of the blocks that make a contour."""
    found: list[Statement] = []
    held: list[Statement] = []
    at_last = number
    for each in case.statements:
        held.append(each)
        if isinstance(each, Leg):
            at_last = next(place for place, part in enumerate(parts) if part.makes(each.name))
            found += held if at_last == number else []
            held = []
    return found + (held if at_last == number else [])


def _of_cases(
    case: Case, parts: Sequence[ContourBlock], beside: Sequence[tuple[Sequence[str], Sequence[str]]]
) -> list[Statement]:
    """The statements for all blocks, case by case; `beside` is what they say before and behind."""
    if isinstance(case, Fork):
        then, otherwise = (
            tuple(apart(_of_cases(each, parts, beside), tag, {own.name for own in END}))
            for tag, each in (("then ", case.then), ("else ", case.otherwise))
        )
        return [Choose(case.condition, then, otherwise)]
    found: list[Statement] = []
    for number, (before, behind) in enumerate(beside):
        found += [*map(Said, before), *_of_block(case, parts, number), *map(Said, behind)]
    return [*found, *(Assign(own, end) for own, end in zip(END, case.end, strict=True))]


def _part_of(name: str, parts: Mapping[int, ContourBlock]) -> ContourBlock:
    return next(part for part in parts.values() if part.makes(name))


def _set_by(statement: object) -> set[str]:
    """The variables that a statement may change."""
    if isinstance(statement, When):
        return {name for each in statement.then for name in _set_by(each)}
    variable = getattr(statement, "variable", None)
    return {variable.name} if isinstance(variable, Variable) else set()
