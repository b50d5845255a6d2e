"""What the text of a module says of a name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class NoModule:
    """There is no such module; `installed` if the package it should be in is there."""

    installed: bool


@dataclass(frozen=True, slots=True)
class BrokenModule:
    """The module's file is no Python."""

    line: int
    message: str


@dataclass(frozen=True, slots=True)
class NoName:
    """The module defines nothing of that name, but `there`."""

    there: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Unclear:
    """The text alone does not tell."""


@dataclass(frozen=True, slots=True)
class Other:
    """A value that is neither a class nor a function."""


@dataclass(frozen=True, slots=True)
class PythonSignature:
    """What can be passed: `by_position` in order, the first `unnamed` of them not by name, and `by_name` only by name.

    `needed` are those without a default. With `args` and `named` any other is taken too, by position and by name.
    """

    by_position: tuple[str, ...] = ()
    unnamed: int = 0
    by_name: tuple[str, ...] = ()
    needed: tuple[str, ...] = ()
    args: bool = False
    named: bool = False

    def without_first(self, count: int) -> PythonSignature:
        """Return what is left to pass when the first `count` are passed by position."""
        gone, rest = self.by_position[:count], self.by_position[count:]
        needed = tuple(name for name in self.needed if name not in gone)
        return PythonSignature(rest, max(0, self.unnamed - count), self.by_name, needed, self.args, self.named)


@dataclass(frozen=True, slots=True)
class FunctionInfo:
    """A function; None for a signature that the text does not tell."""

    signature: PythonSignature | None
    asynchronous: bool = False


@dataclass(frozen=True, slots=True)
class Method:
    """A method, without `self`, and the class "module:Class" that defines it."""

    owner: str
    function: FunctionInfo


@dataclass(frozen=True, slots=True)
class ClassInfo:
    """A class. `ancestors` are its own "module:Class" and those it inherits from; if `complete`, there are no others.

    None for a constructor that the text does not tell. `methods` are all that its text and theirs define, None for one
    that the text does not tell.
    """

    constructor: PythonSignature | None
    ancestors: tuple[str, ...]
    complete: bool
    methods: Mapping[str, Method | None]


TargetInfo: TypeAlias = NoModule | BrokenModule | NoName | Unclear | Other | FunctionInfo | ClassInfo
UNCLEAR = Unclear()
