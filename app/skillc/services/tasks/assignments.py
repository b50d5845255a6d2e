"""Makes what a cell carries out, from a task, a goal or a call, with a compiled library and the present world.

What reads goals and calls is slow to import: a task without arguments needs none of it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, cast

from msgspec import structs

from skillc.errors import DiagnosticsError, RequestError
from skillc.services.tasks.individuals import classes_by_individual
from skillc_dsl.diagnostics import Outcome
from skillc_dsl.source import Source
from skillc_model.conditions import And, Condition
from skillc_model.format_condition import format_condition
from skillc_model.rewriting import substitute
from skillc_model.skills import Skill, SkillLibrary, Task, TaskPart
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody
from skillc_runtime.world.state.world_state import WorldState


def assign_task(
    task: Task, library: SkillLibrary, state: WorldState, arguments: Mapping[str, str] | None = None
) -> Assignment:
    """Return the assignment of a task with `arguments`, the values of its parameters as written in a call.

    DiagnosticsError if an argument is missing, or has errors; RequestError for a task without a goal and a body.
    """
    task = bind_task(task, library, state, arguments or {})
    if task.goal is not None:
        return Assignment(task.name, state, AchieveGoal(task.goal, task.minimise), None, task.within_s, task.always)
    if task.body is None:
        raise RequestError(f"the task `{task.name}` has neither a goal nor a body")
    return Assignment(task.name, state, ExecuteBody(task.body), None, task.within_s, task.always)


def assign_several(tasks: Sequence[Task], library: SkillLibrary, state: WorldState) -> Assignment:
    """Return the assignment of several tasks at once, none of which takes arguments; the first has precedence.

    DiagnosticsError if an argument is missing; RequestError for a task without a goal, or if they minimise different
    things.
    """
    bound = [bind_task(each, library, state, {}) for each in tasks]
    parts, measures = [], {each.minimise for each in bound if each.minimise is not None}
    for each in bound:
        if each.goal is None:
            raise RequestError(f"the task `{each.name}` has no goal: only tasks with goals are planned together")
        parts.append(TaskPart(name=each.name, goal=each.goal, within_s=each.within_s))
    if len(measures) > 1:
        stated = ", ".join(f"`{each.name}` minimises {each.minimise}" for each in bound if each.minimise)
        raise RequestError(f"tasks that are planned together minimise the same: {stated}")
    return Assignment(
        " + ".join(each.name for each in bound),
        state,
        AchieveGoal(And(tuple(each.goal for each in parts)), *measures),
        always=tuple(dict.fromkeys(condition for each in bound for condition in each.always)),
        parts=tuple(parts),
    )


def write_call(name: str, arguments: Mapping[str, str]) -> str:
    """Return a call of a task with arguments as text."""
    return f"{name}({', '.join(f'{each}: {value}' for each, value in arguments.items())})"


def bind_task(task: Task, library: SkillLibrary, state: WorldState, arguments: Mapping[str, str]) -> Task:
    """Return a task with values in place of its parameters; they are read like those of a skill of its name.

    DiagnosticsError if an argument is missing, or has errors; RequestError if the task takes none.
    """
    if not task.parameters:
        if arguments:
            raise RequestError(f"the task `{task.name}` takes no arguments")
        return task
    from skillc_compiler.goals.parsing import parse_call

    written = write_call(task.name, arguments)
    head = Skill(name=task.name, parameters=task.parameters, source=task.source)
    individuals = classes_by_individual(state, library.vocabulary)
    only = structs.replace(library, skills={task.name: head})
    values = _valid(parse_call(written, only, individuals, state.vocabulary.prefixes), written).arguments
    return structs.replace(
        task,
        name=written,
        parameters=(),
        goal=None if task.goal is None else substitute(task.goal, values),
        body=None if task.body is None else substitute(task.body, values),
        always=tuple(substitute(each, values) for each in task.always),
    )


def assign_goal(text: str, library: SkillLibrary, state: WorldState) -> Assignment:
    """Return the assignment of a goal, as a condition, in PDDL or in JSON; DiagnosticsError if it has errors."""
    from skillc_compiler.goals.json_text import is_json
    from skillc_compiler.goals.parsing import home_of, parse_goal

    individuals = classes_by_individual(state, library.vocabulary)
    prefixes, home = state.vocabulary.prefixes, home_of(library)
    goal = _valid(parse_goal(text, library.vocabulary, individuals, prefixes, home, library.skills), text)
    name = format_condition(goal, state.vocabulary) if is_json(text) else text
    return Assignment(name, state, AchieveGoal(goal))


def read_condition(text: str, library: SkillLibrary, state: WorldState) -> Condition:
    """Return a condition, which is written like a goal; DiagnosticsError if it has errors."""
    from skillc_compiler.goals.parsing import home_of, parse_goal

    vocabulary, prefixes = library.vocabulary, state.vocabulary.prefixes
    individuals = classes_by_individual(state, vocabulary)
    read = parse_goal(text, vocabulary, individuals, prefixes, home_of(library), what="condition")
    return cast("Condition", _valid(read, text))


def assign_call(text: str, library: SkillLibrary, state: WorldState) -> Assignment:
    """Return the assignment of a skill call such as `Wipe(surface: lab:Board)`; DiagnosticsError for errors in it."""
    from skillc_compiler.goals.parsing import parse_call

    individuals = classes_by_individual(state, library.vocabulary)
    call = _valid(parse_call(text, library, individuals, state.vocabulary.prefixes), text)
    return Assignment(call.skill, state, ExecuteBody(call))


def _valid(outcome: Outcome[Any], text: str) -> Any:
    """Return the value of a parsed text; DiagnosticsError if it has errors."""
    if outcome.value is None:
        sources = {each: Source(each, text) for each in ("goal", "condition", "call")}
        raise DiagnosticsError(outcome.diagnostics, sources)
    return outcome.value
