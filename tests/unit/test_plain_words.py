"""What users read has short sentences, and a machinist's words."""

import ast
import inspect
import re
from collections.abc import Iterator
from pathlib import Path

import click
import pytest

import contoursolve
from contoursolve.cli import main
from contoursolve.controls import CONTROLS

PACKAGE = Path(contoursolve.__file__).parent
MOST_WORDS = 20
SENTENCE_ENDS = re.compile(r"[.;:!?](?=['\"`)\]]*(?:\s|$))|\n\s*(?:\n|\*)|->")
FORBIDDEN = re.compile(
    r"\b(of which|(is|are) told|held against|there is nothing|tied|determin(ed|es|ant)|residual|constraint|infeasible|"
    r"degenerate|rank|rests? on)\b"
)
SOLVER = (
    "diagnosis/diagnose.py",
    "diagnosis/legality_table.py",
    "solving/construction.py",
    "solving/solve.py",
    "solving/step_outputs.py",
    "system",
)
"""The layers of `--explain`, the table of all sets of words, errors of programmers, the function that gives the system
of equations: these have the solver's words."""


def faults(text: str) -> list[str]:
    """Sentences that are too long, and phrases that nobody should have to read."""
    text = re.sub(r"\{[^{}]*\}|`[^`]*`", "X", text)
    lines = [line for line in text.split("\n") if not re.match(r"\s*(contoursolve |>>>)", line)]
    sentences = [sentence.split() for sentence in SENTENCE_ENDS.split("\n".join(lines))]
    long = [" ".join(words) for words in sentences if sum(any(map(str.isalnum, word)) for word in words) > MOST_WORDS]
    return [*long, *(found[0] for found in FORBIDDEN.finditer(text))]


def shown() -> Iterator[tuple[str, str]]:
    """The texts of rules, commands and public docstrings, and those that the code puts together, with their places."""
    for control in CONTROLS.values():
        for rule in control.rules:
            yield from ((rule.code, text) for text in (rule.message, rule.help, rule.note))
    context = click.Context(main)
    for name in main.list_commands(context):
        command = main.get_command(context, name)
        assert command is not None
        yield name, inspect.cleandoc(command.help or "")
        yield from ((f"{name} {each.name}", getattr(each, "help", None) or "") for each in command.params)
    yield from ((name, inspect.getdoc(getattr(contoursolve, name)) or "") for name in contoursolve.__all__)
    for path in PACKAGE.rglob("*.py"):
        place = path.relative_to(PACKAGE).as_posix()
        yield from ((place, text) for text in _constants(ast.parse(path.read_text("utf-8"))) if " " in text.strip())


def _constants(tree: ast.AST) -> Iterator[str]:
    """The texts of a module without its docstrings, an expression in them as one word."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.JoinedStr):
            yield "".join(str(part.value) if isinstance(part, ast.Constant) else "X" for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value
        elif not (isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)):
            yield from _constants(node)


@pytest.mark.slow
def test_sentences_are_short_and_plain() -> None:
    found = [(place, faults(text)) for place, text in shown() if not place.startswith(SOLVER)]
    assert len(found) > 1_000
    assert [each for each in found if each[1]] == []
