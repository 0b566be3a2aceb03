"""What a family is made of but for its values: plain data, from which any process makes the same functions."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from contoursolve import syntax
from contoursolve.choices import choice_of
from contoursolve.diagnostic import Severity
from contoursolve.dialects import DIALECTS, Dialect
from contoursolve.examine import Policy
from contoursolve.families.ranges import name_of
from contoursolve.families.template import RefusedError, Template, find_words
from contoursolve.model import Length
from contoursolve.pipeline import run
from contoursolve.reading import Trouble
from contoursolve.recognise import UnknownControlError, choose


@dataclass(frozen=True, slots=True)
class Recipe:
    """A block, the names of its free words, and how it is read: the arguments of `family`, but for the values."""

    block: str
    names: tuple[str, ...]
    start: str | None
    control: str | Dialect | None
    facts: tuple[str, ...]
    units: str
    rules: str
    settings: tuple[tuple[str, str], ...]

    def template(self) -> Template:
        """The block with its free words. Raises FamilyError for a word that is not there, UnknownControlError,
        SettingError, and ValueError for units or rules that are none of their choices."""
        for name, text in (("block", self.block), ("start", self.start or "")):
            if not isinstance(text, str):
                raise TypeError(f"the {name} is a text (str), not {type(text).__name__}")
        program = syntax.parse(self.block, "<block>")
        unit, policy = choice_of(Length, self.units, "units"), choice_of(Policy, self.rules, "rules")
        start = syntax.parse(self.start, "<start>", first_line=0) if self.start is not None else None
        dialect = choose(self.control, program, dict(self.settings))
        if dialect is None:
            unread = run(program, None, unit, policy, start=start)
            errors = [each for each in unread.diagnostics if each.severity is Severity.ERROR]
            if any(each.about is not Trouble.NO_CONTOUR for each in errors):
                raise RefusedError(unread)
            choices = ", ".join(DIALECTS)
            raise UnknownControlError(f"the block does not tell its control; name it; choose from {choices}")
        facts = tuple(syntax.read_directive(fact, -number) for number, fact in enumerate(self.facts, 1))
        template = Template(program, dialect, unit, policy, start, {}, facts)
        return replace(template, words=find_words(template, self.names))


def recipe_of(
    block: str,
    names: Iterable[str] = (),
    *,
    start: str | None,
    control: str | Dialect | None,
    facts: Iterable[str] = (),
    units: str,
    rules: str,
    settings: Mapping[str, str] | None,
) -> Recipe:
    """The recipe of a block with the words of these names free; a text alone is one fact."""
    stated = (facts,) if isinstance(facts, str) else tuple(facts)
    options = tuple(sorted((settings or {}).items()))
    return Recipe(block, tuple(map(name_of, names)), start, control, stated, units, rules, options)
