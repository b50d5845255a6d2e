"""The checks of a resolved program, one per file: each file in this folder is found as a check.

Each has `NAMES`, the diagnostics that it reports, and `check(program)`. manual/NAME.md explains each diagnostic.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol, cast

from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic


class CheckModule(Protocol):
    """A module in this folder."""

    NAMES: tuple[str, ...]

    def check(self, program: Program) -> Iterator[Diagnostic]:
        """Yield the problems of the program."""
        ...


@cache
def load_checks() -> tuple[CheckModule, ...]:
    """Return all checks, in order of their file names."""
    names = sorted(module.name for module in iter_modules(__path__))
    return tuple(cast(CheckModule, import_module(f"{__name__}.{name}")) for name in names)


def run_checks(program: Program) -> Iterator[Diagnostic]:
    """Yield the problems that any check finds."""
    for one in load_checks():
        yield from one.check(program)
