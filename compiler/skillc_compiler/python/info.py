"""What the source text of a module says about a name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

import msgspec


class NoModule(msgspec.Struct, frozen=True):
    """There is no such module; `installed` if its top-level package exists."""

    installed: bool


class BrokenModule(msgspec.Struct, frozen=True):
    """The file of the module is not valid Python."""

    line: int
    message: str


class NoName(msgspec.Struct, frozen=True):
    """The module does not define the name; `there` are the classes and functions that it defines."""

    there: tuple[str, ...]


class Unclear(msgspec.Struct, frozen=True):
    """The source text does not determine it."""


class Other(msgspec.Struct, frozen=True):
    """A value that is neither a class nor a function."""


class PythonSignature(msgspec.Struct, frozen=True):
    """The parameters of a callable.

    `by_position` are in order; the first `unnamed` of them cannot be passed by name; `by_name` only by name. `needed`
    have no default. With `args` and `named`, any others are accepted by position and by name.
    """

    by_position: tuple[str, ...] = ()
    unnamed: int = 0
    by_name: tuple[str, ...] = ()
    needed: tuple[str, ...] = ()
    args: bool = False
    named: bool = False

    def without_first(self, count: int) -> PythonSignature:
        """Return the parameters left when the first `count` are passed by position."""
        gone, rest = self.by_position[:count], self.by_position[count:]
        needed = tuple(name for name in self.needed if name not in gone)
        return PythonSignature(rest, max(0, self.unnamed - count), self.by_name, needed, self.args, self.named)


class FunctionInfo(msgspec.Struct, frozen=True):
    """A function; `signature` is None if the text does not determine it."""

    signature: PythonSignature | None
    asynchronous: bool = False


class Method(msgspec.Struct, frozen=True):
    """A method without `self`, and the class "module:Class" that defines it."""

    owner: str
    function: FunctionInfo


class ClassInfo(msgspec.Struct, frozen=True):
    """A class.

    `ancestors` are its own "module:Class" and its base classes; if `complete`, there are no others. `constructor` is
    None if the text does not determine it. `methods` are all that its text and that of its bases define, None for one
    that the text does not determine.
    """

    constructor: PythonSignature | None
    ancestors: tuple[str, ...]
    complete: bool
    methods: Mapping[str, Method | None]


TargetInfo: TypeAlias = NoModule | BrokenModule | NoName | Unclear | Other | FunctionInfo | ClassInfo
UNCLEAR = Unclear()
