"""The checks of a resolved program, one per file: each file in this folder is found as a check.

Each has `NAMES`, the diagnostics that it reports, `NEEDS`, what has to be free of errors for it to be right, and
`check(program)`. manual/NAME.md explains each diagnostic.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from importlib import import_module
from pkgutil import iter_modules
from typing import Protocol, cast

from skillc_compiler.program.causes import group_by_cause
from skillc_compiler.program.marks import Marks, Need
from skillc_compiler.program.typed import Program
from skillc_dsl.diagnostics import Diagnostic


class CheckModule(Protocol):
    """A module in this folder."""

    NAMES: tuple[str, ...]
    NEEDS: Need

    def check(self, program: Program) -> Iterator[Diagnostic]:
        """Yield the problems of the program."""
        ...


@cache
def load_checks() -> tuple[CheckModule, ...]:
    """Return all checks, in order of their file names."""
    names = sorted(module.name for module in iter_modules(__path__))
    return tuple(cast(CheckModule, import_module(f"{__name__}.{name}")) for name in names)


def run_checks(
    program: Program, errors: Iterable[Diagnostic], resolving: Sequence[Diagnostic] = ()
) -> Iterator[Diagnostic]:
    """Yield the problems that any check finds and that are independent of known errors, together with `resolving`.

    Checks that need least run first; what they find is known to the others. `resolving` are problems with names and
    types that were found before.
    """
    marks = Marks(program, (*errors, *resolving))
    for need in Need:
        checks = [one for one in load_checks() if need == one.NEEDS]
        allowed = [problem for one in checks for problem in one.check(program) if marks.allow(need, problem)]
        earlier = resolving if need == Need.NAMES else ()
        found = group_by_cause((*earlier, *allowed), program) if need in (Need.NAMES, Need.BODY) else allowed
        yield from found
        marks.add(found)
