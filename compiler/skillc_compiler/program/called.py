"""Which implementations a body may run, through any number of calls."""

from __future__ import annotations

from collections.abc import Iterator

from skillc_compiler.program.program import Program
from skillc_compiler.program.typed import Implementation, Task, TypedNode
from skillc_compiler.program.walk import calls_in


def called_by(program: Program, of: Implementation | Task) -> tuple[Implementation, ...]:
    """Return all implementations of the skills that a body calls itself."""
    if of.key not in program.called:
        calls = calls_in(of.body) if isinstance(of.body, TypedNode) else ()
        names = sorted({call.skill.name for call in calls if call.skill is not None})
        program.called[of.key] = tuple(each for name in names for each in program.implementations_of.get(name, ()))
    return program.called[of.key]


def run_by(program: Program, of: Implementation | Task) -> tuple[Implementation, ...]:
    """Return all implementations that a body may run, through any number of calls."""
    return tuple(_reach(program, called_by(program, of), set()))


def may_run_one_that_runs_it(program: Program, of: Implementation) -> bool:
    """Whether an implementation may run another one that may run it."""
    others = _reach(program, called_by(program, of), {of.key})
    return any(of.key == each.key for other in others for each in called_by(program, other))


def _reach(program: Program, start: tuple[Implementation, ...], seen: set[str]) -> Iterator[Implementation]:
    """Yield implementations and all that they may run, but for those seen."""
    waiting = [*start]
    while waiting:
        one = waiting.pop()
        if one.key not in seen:
            seen.add(one.key)
            yield one
            waiting += called_by(program, one)
