"""What can be done with the declarations of a file: run, plan and test them, and see where they are used."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import msgspec

from skillc_compiler.ide.project_names import ProjectNames
from skillc_compiler.ide.symbols import FunctionSymbol, Occurrence, SkillSymbol, TaskSymbol, TermSymbol
from skillc_compiler.program.typed import Task, Test
from skillc_dsl.source import Span


class Lens(msgspec.Struct, frozen=True):
    """What can be done with what is declared at a place: `name` with `parameters` to give, or `places` to show."""

    span: Span
    kind: Literal["run", "plan", "test", "references"]
    name: str
    parameters: tuple[str, ...] = ()
    places: tuple[Span, ...] = ()


def find_lenses(names: ProjectNames, path: str) -> Iterator[Lens]:
    """Yield the lenses of a file: of tasks and tests, and of skills, functions and terms that it declares."""
    analysis = names.analysis
    tasks = {task.name: task for task in analysis.program.tasks}
    for each in analysis.index.by_path.get(path, ()):
        match each:
            case Occurrence(symbol=TaskSymbol(name=name), declares=True) if name in tasks:
                yield from _of_task(tasks[name], each.span)
            case Occurrence(symbol=SkillSymbol() | FunctionSymbol() | TermSymbol() as symbol, declares=True):
                others = tuple(sorted(other.span for other in names.of(symbol) if not other.declares))
                yield Lens(each.span, "references", analysis.text_of(each.span), places=others)
            case _:
                pass


def _of_task(task: Task, span: Span) -> Iterator[Lens]:
    if isinstance(task, Test):
        yield Lens(span, "test", task.name)
        return
    parameters = tuple(each.name for each in task.parameters)
    yield Lens(span, "run", task.name, parameters)
    if task.goal is not None:
        yield Lens(span, "plan", task.name, parameters)
