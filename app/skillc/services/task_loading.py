"""Loads a task by name, or a goal or call from its text: compiled library, world and assignment."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path

import msgspec

from skillc.errors import RequestError
from skillc.services import task_scenes
from skillc.services.assignments import assign_call, assign_goal, assign_task
from skillc.services.libraries import compile_valid, find_task
from skillc.services.library_files import LibraryFiles, find_library, find_scene
from skillc.services.named_goals import make_named_task, named_scene
from skillc.services.project.loading import find_project
from skillc.services.reporting import Reporter
from skillc.services.stores import NO_STORE, StoreChoice, open_world
from skillc.services.task_list import choose_task, default_library, split_reference
from skillc_model.skills import SkillLibrary, Task
from skillc_runtime.execution.assignment import Assignment
from skillc_runtime.world.state.model import WorldModel


@dataclass(frozen=True, slots=True)
class TaskRequest:
    """The task `LIBRARY:NAME`, or a goal or a skill call in a scene or in a stored world.

    The library of a goal or call is that of the project here, or the shipped one, unless `library` is given.
    `arguments` are the values of the task's parameters, as they are written in a call.
    """

    task: str | None = None
    scene: Path | None = None
    goal: str | None = None
    call: str | None = None
    library: Path | None = None
    store: StoreChoice = NO_STORE
    arguments: Mapping[str, str] = field(default_factory=dict)

    def with_defaults(self) -> TaskRequest:
        """Return the request with the task or the scene of the project here, if it names none."""
        if self.task is not None or self.store.place is not None:
            return self
        if (self.scene, self.goal, self.call, self.library) == (None, None, None, None):
            return replace(self, task=choose_task(None))
        project = find_project(Path()) if self.scene is None else None
        scene = task_scenes.default_scene(project) if project else None
        return replace(self, scene=self.scene or scene)

    def check(self, calls: bool = True) -> None:
        """Raise RequestError if options conflict or are missing; `calls`: whether a call is possible too."""
        if self.task is None and self.arguments:
            raise RequestError("arguments are the values of the parameters of a TASK; none is named")
        if self.task is not None and (self.scene or self.goal or self.call or self.library):
            raise RequestError("a TASK cannot be used with --scene, --goal, --skill or --library")
        nothing = (self.goal is None) == (self.call is None)
        if self.task is None and ((self.scene or self.store.place) is None or nothing):
            choice = "--goal TEXT or --skill CALL" if calls else "--goal TEXT"
            listed = "name either a TASK (`skillc tasks` lists them)"
            raise RequestError(f"{listed}, or --scene FILE (or --store) with {choice}")


@dataclass(frozen=True, slots=True)
class LoadedTask:
    """A compiled library, the assignment to carry out, and its world; the file of its scene, empty if it is stored."""

    library: SkillLibrary
    assignment: Assignment
    world: WorldModel
    scene: str = ""


@contextmanager
def load_task(request: TaskRequest, reporter: Reporter) -> Iterator[LoadedTask]:
    """Find, compile and load what is requested; a store is closed at the end."""
    loading = _load_goal(request, reporter) if request.task is None else _load_named(request.task, request, reporter)
    with loading as loaded:
        yield loaded


def find_task_in_scene(reference: str) -> tuple[SkillLibrary, Task, Path]:
    """Find and compile the task `LIBRARY:NAME`, or that of the project here or shipped; return it with its scene file.

    A goal or call that a `skillc.toml` names becomes a task of the library.
    """
    files, name = split_reference(reference)
    library = compile_valid(files)
    if name not in library.tasks and files.project and name in files.project.manifest.tasks:
        scene = named_scene(files.project, name)
        task = make_named_task(files.project, name, library, scene)
        return msgspec.structs.replace(library, tasks={**library.tasks, name: task}), task, scene
    task = find_task(library, name)
    if task.goal is None and task.body is None:
        raise RequestError(f"the task `{name}` has neither a goal nor a body")
    return library, task, _find_scene(task, files)


def _find_scene(task: Task, files: LibraryFiles) -> Path:
    """Return the file of a task's scene, or of the default one of its project. RequestError if there is none."""
    if task.scene is None:
        default = task_scenes.default_scene(files.project) if files.project else None
        if default is None:
            how = "run it with --scene FILE and --goal or --skill"
            raise RequestError(f"the task `{task.name}` has no scene; {how}")
        return default
    path = task_scenes.find_task_scene(task, files)
    if path is None:
        why = task_scenes.why_missing(task.scene, files.places[task.source.path].parent)
        raise RequestError(f'the scene "{task.scene}" of `{task.name}` {why}')
    return path


@contextmanager
def _load_named(reference: str, request: TaskRequest, reporter: Reporter) -> Iterator[LoadedTask]:
    library, task, scene = find_task_in_scene(reference)
    with open_world(request.store, scene, library.vocabulary, reporter) as world:
        assignment = assign_task(task, library, world.snapshot(), request.arguments)
        yield LoadedTask(library, assignment, world, _origin(request, scene))


@contextmanager
def _load_goal(request: TaskRequest, reporter: Reporter) -> Iterator[LoadedTask]:
    library = compile_valid(find_library(request.library) if request.library else default_library())
    scene = find_scene(request.scene) if request.scene else None
    with open_world(request.store, scene, library.vocabulary, reporter) as world:
        state = world.snapshot()
        if request.goal is not None:
            assignment = assign_goal(request.goal, library, state)
        else:
            assert request.call is not None
            assignment = assign_call(request.call, library, state)
        yield LoadedTask(library, assignment, world, _origin(request, scene))


def _origin(request: TaskRequest, scene: Path | None) -> str:
    """Return the file of the scene that a world was read from; empty if it comes from a store."""
    return str(scene) if scene is not None and request.store.place is None else ""
