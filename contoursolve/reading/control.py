"""A control: a record of tables, and how its contours are found among the blocks."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from msgspec import Struct

from contoursolve.diagnostics import did_you_mean, from_above
from contoursolve.gcode import Block, Word
from contoursolve.geometry import CornerShape, Length, Plane
from contoursolve.reading.contour_form import Assumption, ContourForm, Setting
from contoursolve.reading.follow import Finder
from contoursolve.reading.lexicon import Diameter
from contoursolve.reading.modal_state import Modes, Position, State, with_diameters
from contoursolve.reading.parsed_contour import ParsedContour, ReadIssue
from contoursolve.reading.rules import Rule, Rules
from contoursolve.reading.writer import Writing

Follower = Callable[..., "Iterator[Behind]"]
"""(name of the form, path or None, what gives the state behind it, the blocks behind it, modes) to what
is wrong with the block behind a contour."""


class Behind(Struct, frozen=True):
    """Something that is wrong with the block behind a contour: about what, its words, and what the row says of it.

    `lengths` (mm, as the axis counts) and `angles` (degrees) are what the fields, or the message, leave open: the
    program's unit says how they are written. `meant` is the block with which it would be right.
    """

    about: ReadIssue
    state: State
    block: Block
    words: tuple[Word, ...]
    fields: Mapping[str, str]
    lengths: Mapping[str, float] = {}
    angles: Mapping[str, float] = {}
    values: Mapping[str, float] = {}
    meant: Block | None = None
    contour: ParsedContour | None = None
    """The contour that the block would be then; of one without a path it is not said that it is meant."""
    advice: str = ""
    """The nature of the meant block, where it is no contour."""


class Taken(Struct, frozen=True):
    """Something about its control that was concluded from a program: of which kind, and what its reader is told."""

    about: ReadIssue
    fields: Mapping[str, str]


Y_AXIS, POLAR_WORDS, SEMICOLON_COMMENT, NAMED_FILE = "Y", "polar words", "comment behind ;", "ending of the file"
"""Marks of a program, by which `Control.excluded_by` says that it is for another control."""


class LegalBlock(Struct, frozen=True):
    """An example of a block, or of several, that a control accepts: the smallest set of words of its form, with values
    that make a contour."""

    form: str
    title: str
    addresses: tuple[str, ...]
    text: str


@dataclass(frozen=True, slots=True)
class Control:
    """One control, as tables. It need not be built in: every function takes one as `control`.

    A relative of a control has a name of its own and the tables in which it differs:

        from dataclasses import replace
        from contoursolve.controls import NCT_99M

        mine = replace(NCT_99M, name="mine", title="the mill in hall 2", rules=...)
        contoursolve.solve(text, control=mine)

    One from scratch is five tables (`notebooks/07_add_a_control.ipynb` writes one):

    * the lexicon in `modes`: addresses, what a number without a point means, G codes, axes;
    * `forms`: the points of a drawing, the facts that words state about them, the path and its corners;
    * `find` reads blocks into claims of a form, and states which of two solutions the control takes, by name;
    * `rules`: `COMMON_RULES`, rows of its own, then `GEOMETRY_RULES` (of `controls.geometry_rules`), so that whatever
      can happen has a row;
    * how it writes numbers is in the lexicon; a target of your own for `expand` is a `Post`.

    Names of forms are not those of a built-in control: what sympy has said about these is kept by them.
    """

    name: str
    """The name by which it is chosen, such as `fanuc-lathe`."""
    title: str
    """The name of the control for a reader."""
    modes: Modes
    plane: Plane
    """The axes of a contour where no code has selected a plane."""
    forms: tuple[ContourForm, ...]
    rules: tuple[Rule, ...]
    find: Finder
    signs: Callable[[Block], Sequence[Word]]
    """The words of a block that make a contour for this control."""
    rare: frozenset[str] = frozenset()
    """Words that it has, too, but by which another control is known."""
    excluded_by: frozenset[str] = frozenset()
    """Marks of a program that is for another control, whatever words of this one it has: `Y_AXIS` and its kin."""
    contours: str = ""
    """The signs of a contour block, for a reader."""
    settings: tuple[Setting, ...] = ()
    """Conventions on which the manual is silent."""
    diameter: Diameter | None = None
    """The words of X that are diameters at first, where codes switch that."""
    motion: int | None = None
    """The motion that is in force before the program states one."""
    has_modal_motions: bool = True
    """Whether a motion stays in force, so that the next block need not say it."""
    has_runs: bool = True
    """Whether a contour may be several blocks in a row."""
    corners: tuple[tuple[str, int, CornerShape], ...] = ()
    """The words that make the corner after their block, each with the sign of its number and the shape; of a control
    whose words are no `Language`."""
    follow: Follower | None = None
    """Finds what is wrong with the block after a contour, though it is no part of it."""
    writing: Writing | None = None
    """The writing of its programs, where it is not programmed in G codes."""
    taken: "tuple[Taken, ...]" = ()
    """The things that were concluded from the program at hand, where that does not say it."""

    def __hash__(self) -> int:
        return hash((type(self), self.name))

    def __post_init__(self) -> None:
        # A setting is named with its control, so that it can be typed as it is shown.
        rules: Iterable[Rule] = self.rules
        if any("{control}" in each.help and each.control != self.name for each in rules):
            rules = [replace(each, control=self.name) if "{control}" in each.help else each for each in rules]
        if not isinstance(rules, Rules):
            object.__setattr__(self, "rules", Rules(rules))

    @property
    def examples(self) -> tuple[LegalBlock, ...]:
        """Examples of all its forms, with the smallest sets of words of each."""
        found: tuple[LegalBlock, ...] = from_above("legal_blocks", self)
        return found

    @property
    def catalogue(self) -> tuple[Rule, ...]:
        """The rules that a program of this control can meet, with their examples."""
        return tuple(rule.told for rule in self.rules if not rule.absent)

    @property
    def assumptions(self) -> tuple[Assumption, ...]:
        """The things that it is taken to accept, in any of its forms."""
        return tuple(dict.fromkeys(each for form in self.forms for each in form.assumptions))

    def configure(self, values: Mapping[str, str]) -> "Control":
        """The control with other values of its settings.

        Raises ValueError, naming what there is, if there is no such setting or no such value.
        """
        known = {setting.name: setting for setting in self.settings}
        for name, value in values.items():
            if name not in known:
                names = ", ".join(known) or "none"
                meant = did_you_mean(name, known)
                raise ValueError(f"{self.name} has no setting {name!r}; {meant}settings are: {names}")
            choices = known[name].choices(value)
            if choices:
                choices = did_you_mean(value, known[name].values) + choices
                raise ValueError(f"{self.name}.{name} cannot be {value!r}; {choices}")
        changed = replace(self, modes=replace(self.modes, settings={**self.modes.settings, **values}))
        for name, value in values.items():
            changed = known[name].change(changed, value)
        return changed

    def initial_state(self, unit: Length) -> State:
        """The state before the first block: the position is not known, nothing is compensated."""
        reason = "nothing before it gives an absolute position"
        axes = {axis: Position(None, reason) for axis in self.modes.axes}
        state = State(
            axes,
            self.motion,
            self.plane,
            unit,
            is_incremental=False,
            compensation=40,
            diameter=self.diameter,
            travel=self.modes.travel,
            zero=self.modes.zero.first,
        )
        return with_diameters(state)
