"""Libraries none of whose tasks runs in a cell with bodies: their skills act as declared, and need no implementations.

The back ends are those that tasks name, None for a task that names none; `is_symbolic` says of each whether its cells
are without bodies.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Test
from skillc_dsl.diagnostics import Diagnostic


def list_backends(program: Program) -> Iterator[str | None]:
    """Yield the back ends of the tasks of a program, without those of its tests."""
    return (each.backend.text if each.backend else None for each in program.tasks if not isinstance(each, Test))


def is_bodiless(backends: Iterable[str | None], is_symbolic: Callable[[str | None], bool]) -> bool:
    """Whether no task runs in a cell with bodies; without tasks, whether one that names no back end would not."""
    return all(map(is_symbolic, {*backends} or {None}))


def without_unasked(
    found: Iterable[Diagnostic], backends: Iterable[str | None], is_symbolic: Callable[[str | None], bool]
) -> tuple[Diagnostic, ...]:
    """Return the diagnostics of compiling that count where tasks run."""
    left_out = {"no-implementation"} if is_bodiless(backends, is_symbolic) else set[str]()
    return tuple(each for each in found if each.name not in left_out)
