"""Stands in for CasADi in a browser where it cannot be installed: the real one, as it is with NumPy."""

from array import array
from typing import Any

from numpy import KINDS, Name, There, ask


class _Type(type):
    """What is called or looked up in a class is done there."""

    def __call__(cls, *args: Any, **options: Any) -> Any:
        return ask("call", f"casadi.{cls.__name__}", args, options)

    def __getattr__(cls, name: str) -> Any:
        return getattr(Name(f"casadi.{cls.__name__}"), name)


class SX(There, metaclass=_Type):
    """A matrix of expressions."""

    T = property(lambda self: ask("attribute", self, "T"))

    def __getitem__(self, place: Any) -> Any:
        return ask("operator", "getitem", (self, place))

    def __float__(self) -> float:
        return ask("builtin", "float", self)


class Function(There, metaclass=_Type):
    """Its numbers are read and written here, and computed there."""

    def buffer(self) -> Any:
        """Where it reads and writes them, and what evaluates it."""
        found = _Buffer()
        return found, lambda: found.fill(self)


class _Buffer:
    def __init__(self) -> None:
        self.arguments, self.results = dict[int, memoryview](), dict[int, memoryview]()

    def set_arg(self, number: int, memory: memoryview) -> None:
        self.arguments[number] = memory

    def set_res(self, number: int, memory: memoryview) -> None:
        self.results[number] = memory

    def fill(self, function: Function) -> None:
        """What real buffers hold then."""
        given = [self.arguments[number].tolist() for number in range(len(self.arguments))]
        found = ask("evaluate", function, given, [len(self.results[number]) for number in range(len(self.results))])
        for number, values in enumerate(found):
            self.results[number][:] = array("d", values)


KINDS.update({each.__name__: each for each in (SX, Function)})


def __getattr__(name: str) -> Any:
    if name.startswith("__"):
        raise AttributeError(name)
    return ask("attribute", Name("casadi"), name) if name.startswith("OP_") else Name(f"casadi.{name}")
