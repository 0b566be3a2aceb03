"""Small faults that a program can have: a sign, a comparison, a dropped condition, two branches exchanged."""

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import accumulate, chain
from pathlib import Path

PACKAGE = "contoursolve"

KINDS = ("sign", "comparison", "condition", "branches")
"""The kinds of faults, which are drawn in turn."""

_OTHERS: dict[type[ast.cmpop], tuple[str, ...]] = {
    ast.Lt: ("<=", ">", ">="),
    ast.LtE: ("<", ">", ">="),
    ast.Gt: (">=", "<", "<="),
    ast.GtE: (">", "<", "<="),
    ast.Eq: ("!=",),
    ast.NotEq: ("==",),
    ast.In: ("not in",),
    ast.NotIn: ("in",),
    ast.Is: ("is not",),
    ast.IsNot: ("is",),
}
"""What may stand for a comparison. The first three differ where both sides are equal, or elsewhere."""


@dataclass(frozen=True, slots=True, order=True)
class Fault:
    """One change of one file: the bytes from `start` to `end` become `new`."""

    file: str
    """From the root of the repository, with slashes."""
    line: int
    start: int
    end: int
    new: str
    kind: str
    old: str

    @property
    def room(self) -> str:
        """The folder of the package in which the file lies, or the file."""
        return self.file.split("/")[1].removesuffix(".py")

    @property
    def change(self) -> str:
        """What stands there for what, on one line."""
        return f"{' '.join(self.new.split())} for {' '.join(self.old.split())}"

    def apply(self, source: bytes) -> bytes:
        """The file with the fault, with as many lines as before."""
        lost = source.count(b"\n", self.start, self.end) - self.new.count("\n")
        new = f"({self.new}{chr(10) * lost})" if lost else self.new
        return source[: self.start] + new.encode() + source[self.end :]


Span = tuple[int, int]

Change = tuple[str, Span, str]
"""A kind, a place, and the new text."""


def all_faults(root: Path) -> list[Fault]:
    """Every fault that could be put into the package, in the order of files and places."""
    return [
        fault
        for path in sorted((root / PACKAGE).rglob("*.py"))
        for fault in faults_of(path.read_bytes(), path.relative_to(root).as_posix())
    ]


def faults_of(source: bytes, file: str) -> list[Fault]:
    """Every fault that could be put into one file."""
    text, found = _Text(source), set()
    for node in _nodes_that_run(ast.parse(source)):
        for kind, (first, last), new in chain(_signs(node, text), _conditions(node, text), _branches(node, text)):
            line = source.count(b"\n", 0, first) + 1
            found.add(Fault(file, line, first, last, new, kind, source[first:last].decode()))
    return sorted(found)


def _nodes_that_run(node: ast.AST) -> Iterator[ast.AST]:
    """The nodes of a module without annotations, texts, and what only a type checker or a command reads."""
    skipped = [getattr(node, "annotation", None), getattr(node, "returns", None)]
    for inner in ast.iter_child_nodes(node):
        if inner in skipped or isinstance(inner, ast.JoinedStr):  # before 3.12 a place in such a text is not told
            continue
        asked = ast.walk(inner.test) if isinstance(inner, ast.If) else ()
        if {"TYPE_CHECKING", "__name__"}.isdisjoint(each.id for each in asked if isinstance(each, ast.Name)):
            yield inner
            yield from _nodes_that_run(inner)


class _Text:
    """The source, with the places of nodes."""

    def __init__(self, source: bytes) -> None:
        self.source = source
        self.starts = [0, *accumulate(map(len, source.splitlines(keepends=True)))]

    def span(self, node: ast.AST) -> Span:
        first, last = self.starts[node.lineno - 1], self.starts[node.end_lineno - 1]
        return first + node.col_offset, last + node.end_col_offset

    def of(self, node: ast.AST) -> str:
        first, last = self.span(node)
        return f"({self.source[first:last].decode()})"

    def between(self, left: ast.AST, right: ast.AST) -> Span:
        """Where an operator stands between two parts, without the brackets around these."""
        first, last = self.span(left)[1], self.span(right)[0]
        words = self.source[first:last].strip(b"() \n\\")
        at = self.source.find(words, first)
        return at, at + len(words)


def _signs(node: ast.AST, text: _Text) -> Iterator[Change]:
    """A plus for a minus, and comparisons that are another one."""
    match node:
        case ast.BinOp(op=ast.Add() | ast.Sub()) if not _is_text(node.left) and not _is_text(node.right):
            yield "sign", text.between(node.left, node.right), "-" if isinstance(node.op, ast.Add) else "+"
        case ast.AugAssign(op=ast.Add() | ast.Sub()) if not _is_text(node.value):
            yield "sign", text.between(node.target, node.value), "-=" if isinstance(node.op, ast.Add) else "+="
        case ast.UnaryOp(op=ast.USub()):
            yield "sign", text.span(node), text.of(node.operand)
        case ast.Compare():
            for left, operator, right in zip([node.left, *node.comparators], node.ops, node.comparators, strict=False):
                for other in _OTHERS[type(operator)]:
                    yield "comparison", text.between(left, right), other


def _conditions(node: ast.AST, text: _Text) -> Iterator[Change]:
    """A condition that is not asked."""
    match node:
        case ast.UnaryOp(op=ast.Not()):
            yield "condition", text.span(node), text.of(node.operand)
        case ast.BoolOp():
            word = " and " if isinstance(node.op, ast.And) else " or "
            for dropped in node.values:
                kept = [text.of(each) for each in node.values if each is not dropped]
                yield "condition", text.span(node), f"({word.join(kept)})"
        case ast.comprehension():
            for test in node.ifs:
                yield "condition", text.span(test), "True"
        case ast.If(orelse=[]):
            yield "condition", text.span(node.test), "True"
            yield "condition", text.span(node.test), "False"


def _branches(node: ast.AST, text: _Text) -> Iterator[Change]:
    """Two branches that are exchanged."""
    match node:
        case ast.IfExp():
            yield (
                "branches",
                text.span(node),
                f"({text.of(node.orelse)} if {text.of(node.test)} else {text.of(node.body)})",
            )
        case ast.If(orelse=[_, *_]):
            yield "branches", text.span(node.test), f"(not {text.of(node.test)})"


def _is_text(node: ast.AST) -> bool:
    """Whether a part is text or a list, which has no sign."""
    if isinstance(node, ast.BinOp):
        return _is_text(node.left) or _is_text(node.right)
    kinds = (ast.JoinedStr, ast.List, ast.Tuple, ast.ListComp, ast.Dict, ast.Set)
    return isinstance(node, kinds) or (isinstance(node, ast.Constant) and isinstance(node.value, str | bytes))
