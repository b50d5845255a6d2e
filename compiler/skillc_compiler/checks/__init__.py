"""The checks on a resolved program, one per file; a file in this folder is a check, and nothing else is registered.

Each has `NAMES`, the diagnostics that it reports, and `check(program)`; manual/NAME.md explains each of them.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol, cast

from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic


class Check(Protocol):
    """What a module in this folder is."""

    NAMES: tuple[str, ...]

    def check(self, program: Program) -> Iterator[Diagnostic]:
        """Yield what is wrong in the program."""
        ...


@cache
def checks() -> tuple[Check, ...]:
    """Return all checks, in order of their files' names."""
    names = sorted(module.name for module in iter_modules(__path__))
    return tuple(cast(Check, import_module(f"{__name__}.{name}")) for name in names)


def check(program: Program) -> Iterator[Diagnostic]:
    """Yield what all checks find."""
    for one in checks():
        yield from one.check(program)
