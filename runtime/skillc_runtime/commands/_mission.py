"""From the words of a command line to a library and an assignment, or to an explanation and exit code 1."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

from skillc_compiler.goals import parse_call, parse_goal
from skillc_compiler.library.skills import SkillLibrary, Task
from skillc_dsl.diagnostics import Diagnostic, Outcome
from skillc_dsl.source import Source
from skillc_runtime.commands import _diagnostics, _files, _library, _scenes, _telling
from skillc_runtime.commands._keeping import NOT_KEPT, Keeping
from skillc_runtime.execution.assignment import AchieveGoal, Assignment, ExecuteBody
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState


@dataclass(frozen=True, slots=True)
class Mission:
    """A compiled library and what is to be done with it."""

    library: SkillLibrary
    assignment: Assignment
    world: WorldModel


def of_task(reference: str, keeping: Keeping = NOT_KEPT) -> Mission:
    """Find, compile and load the task `LIBRARY:NAME`, or the shipped task of that name."""
    library, task, scene = in_scene(reference)
    world = world_for(keeping, scene, library)
    if task.goal is not None:
        return Mission(library, Assignment(task.name, world.snapshot(), AchieveGoal(task.goal)), world)
    assert task.body is not None
    return Mission(library, Assignment(task.name, world.snapshot(), ExecuteBody(task.body)), world)


def in_scene(reference: str) -> tuple[SkillLibrary, Task, Path]:
    """Find and compile the task `LIBRARY:NAME`, or the shipped task of that name; return it with its scene's file."""
    files, name = _library.find_task(reference)
    library = compiled(files)
    task = _library.task_named(library, name)
    if task.scene is None:
        raise click.UsageError(f"the task `{name}` has no scene; run it with --scene FILE and --goal or --skill")
    path = _scenes.scene_of(task, files)
    if path is None:
        why = _scenes.why_absent(task.scene, files.places[task.source.path].parent)
        raise click.UsageError(f'the scene "{task.scene}" of `{name}` {why}')
    if task.goal is None and task.body is None:
        raise click.UsageError(f"the task `{name}` has neither a goal nor a body")
    return library, task, path


def of_scene(
    scene: Path | None, goal: str | None, skill: str | None, library_path: Path | None, keeping: Keeping = NOT_KEPT
) -> Mission:
    """Take a goal, or a call of a skill, in a scene or in what a store holds.

    The library is the shipped one unless a path is given.
    """
    library = compiled(_library.find(library_path or _library.SHIPPED / "wiping"))
    world = world_for(keeping, _files.scene_path(scene) if scene else None, library)
    state = world.snapshot()
    individuals = _scenes.classes_of(state, library.vocabulary)
    prefixes = state.vocabulary.prefixes
    if goal is not None:
        asked = parse_goal(goal, library.vocabulary, individuals, prefixes)
        return Mission(library, Assignment(goal, state, AchieveGoal(_understood(asked, goal))), world)
    assert skill is not None
    call = _understood(parse_call(skill, library, individuals, prefixes), skill)
    return Mission(library, Assignment(call.skill, state, ExecuteBody(call)), world)


def compiled(files: _library.LibraryFiles) -> SkillLibrary:
    """Compile a library; exit with its diagnostics if it has errors."""
    outcome = _library.compile_library(files)
    if not outcome.ok:
        _telling.tell(outcome.diagnostics, _library.texts(files))
        sys.exit(1)
    return outcome.value


def loaded(scene: Path, library: SkillLibrary) -> WorldState:
    """Load a scene and tell what is doubtful in it; exit with what is wrong with it."""

    def tell(problems: Sequence[Diagnostic]) -> None:
        _telling.tell(_diagnostics.with_shown_paths(problems), _diagnostics.scene_text(scene))

    try:
        return load_scene(scene, library.vocabulary, tell)
    except SceneError as error:
        tell(error.problems)
    except OSError as error:
        click.echo(f"error: the scene {scene} cannot be read: {error.strerror}", err=True)
    sys.exit(1)


def world_for(keeping: Keeping, scene: Path | None, library: SkillLibrary) -> WorldModel:
    """Return the world of a scene, or of the store that keeps it; exit with what is wrong with either."""
    if keeping.place is None:
        assert scene is not None
        return WorldModel(loaded(scene, library))
    from skillc_runtime.commands._stores import kept_world

    return kept_world(keeping, scene, library.vocabulary, lambda path: loaded(path, library))


def _understood(outcome: Outcome[Any], text: str) -> Any:
    """Return what was understood; exit with the diagnostics if it was not."""
    if outcome.value is None:
        _telling.tell(outcome.diagnostics, {"goal": Source("goal", text), "call": Source("call", text)})
        sys.exit(1)
    return outcome.value
