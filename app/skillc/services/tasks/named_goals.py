"""The goals and calls that a `skillc.toml` names, as tasks."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import msgspec

from skillc.errors import DiagnosticsError, RequestError, ServiceError
from skillc.extras import missing_extras
from skillc.services.project.project import Project
from skillc.services.reporting.reporter import SilentReporter
from skillc.services.scene.stores import load_world
from skillc.services.tasks import named_scenes
from skillc.services.tasks import scenes as task_scenes
from skillc.services.tasks.diagnostics import TaskDiagnostics
from skillc.services.tasks.individuals import classes_by_individual
from skillc.services.tasks.space_problems import OutOfTime, SpaceJudge, SpaceProblem
from skillc_compiler.goals.parsing import home_of, parse_call, parse_goal
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.position import Position
from skillc_model.skills import SkillLibrary, Task


def named_scene(project: Project, name: str) -> Path:
    """Return the scene of a goal that a manifest names. RequestError if there is none."""
    scene = project.manifest.tasks[name].scene or project.manifest.scene
    if scene is None:
        raise RequestError(f"the task `{name}` of skillc.toml has no scene, and the project has no default `scene`")
    path = named_scenes.resolve_scene(scene, project.root)
    if path is None:
        raise RequestError(f'the scene "{scene}" of `{name}` is neither in {project.root} nor shipped')
    return path


def make_named_task(project: Project, name: str, library: SkillLibrary, scene: Path) -> Task:
    """Return the task of a goal or call that a manifest names. DiagnosticsError at it if it has errors."""
    named = project.manifest.tasks[name]
    state = load_world(scene, library.vocabulary, SilentReporter())
    individuals = classes_by_individual(state, library.vocabulary)
    prefixes = state.vocabulary.prefixes
    key, text = ("goal", named.goal) if named.goal is not None else ("call", named.call or "")
    place = project.place_of("tasks", name, key)
    source = Position(place.path, place.line, place.column)
    if key == "goal":
        goal = parse_goal(text, library.vocabulary, individuals, prefixes, home_of(library), library.skills)
        _require_valid(goal, project, name, key)
        return Task(name=name, scene=str(scene), goal=goal.value, goal_text=text, source=source)
    call = parse_call(text, library, individuals, prefixes)
    _require_valid(call, project, name, key)
    return Task(name=name, scene=str(scene), body=call.value, source=source)


def check_named_goals(project: Project, library: SkillLibrary, look: SpaceJudge | None = None) -> Iterator[Diagnostic]:
    """Yield the diagnostics of all goals and calls that a manifest names, at their places in it.

    `look` looks in space at those that have no errors.
    """
    for name in project.manifest.tasks:
        try:
            scene = named_scene(project, name)
            task = make_named_task(project, name, library, scene)
            yield from () if look is None or missing_extras("run") else _in_space(task, scene, library, look)
        except DiagnosticsError as error:
            yield from (each for each in error.diagnostics if each.span.path == project.source.path)
        except ServiceError as error:
            yield Diagnostic("wrong-setting", project.place_of("tasks", name), str(error))


def _in_space(task: Task, file: Path, library: SkillLibrary, look: SpaceJudge) -> Iterator[Diagnostic]:
    """Yield the diagnostic of a step that does not go in space, at the task in the manifest."""
    scene = task_scenes.read_scene(file, library.vocabulary).value
    if scene is None or not scene.ok:
        return
    of_task = TaskDiagnostics(str, scene, task)
    match look(library, scene, task):
        case SpaceProblem() as found:
            yield of_task.infeasible(msgspec.structs.replace(found, call=None))
        case OutOfTime() as given_up:
            yield of_task.unlooked(given_up)
        case None:
            pass


def _require_valid(outcome: Outcome[object], project: Project, name: str, key: str) -> None:
    """Raise DiagnosticsError, with places in the manifest, if a goal or call has errors."""
    if outcome.value is not None:
        return
    place = project.place_of("tasks", name, key)
    moved = [replace(each, span=place, labels=(), fix=None) for each in outcome.diagnostics]
    raise DiagnosticsError(moved, {project.source.path: project.source})
