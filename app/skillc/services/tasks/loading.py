"""Loads a task by name, or a goal or call from its text: compiled library, world and assignment."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Literal, NamedTuple

import msgspec
from msgspec import structs

from skillc.errors import RequestError
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import LibraryFiles, find_library, find_scene
from skillc.services.project.backends import BackendName, adapt_library, require_backend
from skillc.services.project.loading import find_project
from skillc.services.project.project import DEFAULT_BACKEND
from skillc.services.reporting.files import inspect_path
from skillc.services.reporting.reporter import Reporter
from skillc.services.scene.stores import NO_STORE, StoreChoice, open_world
from skillc.services.tasks import named_scenes
from skillc.services.tasks.assignments import assign_call, assign_goal, assign_several, assign_task, read_condition
from skillc.services.tasks.listing import choose_task, default_library, find_task, split_reference
from skillc_model.skills import PlanMeasure, SkillLibrary, Task
from skillc_runtime.execution.assignment import AchieveGoal, Assignment
from skillc_runtime.recording.run_spec import RunSpec
from skillc_runtime.world.state.model import WorldModel

_CALL = re.compile(r"\s*[A-Za-z]\w*\(")
_CONDITION = re.compile(r"\(|[=<>]")


class LoadedTask(msgspec.Struct, frozen=True):
    """A compiled library, the assignment to carry out, and its world; the file of its scene, empty if it is stored.

    `backend` is where it runs.
    """

    library: SkillLibrary
    assignment: Assignment
    world: WorldModel
    scene: str = ""
    backend: BackendName = DEFAULT_BACKEND


class FoundTask(NamedTuple):
    """A task, the library that it is run with, the file of its scene, and the back end in whose cell it runs."""

    library: SkillLibrary
    task: Task
    scene: Path
    backend: BackendName


def fill_in(spec: RunSpec, store: StoreChoice = NO_STORE) -> RunSpec:
    """Return a specification with the task or the scene of the project here, if it names none and no store is used."""
    if spec.task is not None or store.place is not None:
        return spec
    if (spec.scene, spec.goal, spec.call, spec.library) == (None, None, None, None):
        return structs.replace(spec, task=choose_task(None))
    project = find_project(Path()) if spec.scene is None else None
    scene = named_scenes.default_scene(project) if project else None
    return structs.replace(spec, scene=spec.scene or (None if scene is None else str(scene)))


def check_request(spec: RunSpec, store: StoreChoice = NO_STORE, calls: bool = True) -> None:
    """Raise RequestError if it is not clear what is to be done, or where; `calls`: whether a call is possible too."""
    if spec.task is None and spec.arguments:
        raise RequestError("arguments are the values of the parameters of a TASK; none is named")
    if spec.task is not None:
        for task in (spec.task, *spec.beside):
            _check_task(task, spec, calls)
        if spec.beside and spec.arguments:
            raise RequestError("several tasks at once take no arguments")
        return
    if spec.beside:
        raise RequestError("only tasks are planned together: a goal joins conditions with `and`")
    choice = "--goal TEXT or --call CALL" if calls else "--goal TEXT"
    if spec.goal is not None and spec.call is not None:
        raise RequestError("either --goal or --call says what is to be done, not both")
    if spec.goal is None and spec.call is None:
        listed = "name either a TASK (`skillc tasks` lists them)"
        raise RequestError(f"{listed}, or --scene FILE (or --store) with {choice}")
    if (spec.scene or store.place) is None:
        given = "--goal" if spec.goal is not None else "--call"
        raise RequestError(f"{given} needs the scene: `--scene FILE`, a file here or a shipped one, or `--store`")


def _check_task(task: str, spec: RunSpec, calls: bool) -> None:
    """Raise RequestError if a goal or call is given besides a task, or in place of its name."""
    if spec.scene or spec.goal or spec.call or spec.library:
        raise RequestError("a TASK cannot be used with --scene, --goal, --call or --library")
    path, colon, _ = task.rpartition(":")
    if colon and inspect_path(Path(path)).kind in ("file", "folder"):
        return  # names of files may have the characters of a condition
    if _CALL.match(task):
        form = f"is given as `--scene FILE --call '{task}'`"
        raise RequestError(f"a call of a skill {form if calls else 'has no plan: name a task, or give a goal'}")
    if _CONDITION.search(task):
        raise RequestError(f"a goal is given as `--scene FILE --goal '{task}'`")


@contextmanager
def load_task(spec: RunSpec, reporter: Reporter, store: StoreChoice = NO_STORE) -> Iterator[LoadedTask]:
    """Find, compile and load what is to be done: the task `LIBRARY:NAME`, or a goal or a call in a scene or a store.

    The library of a goal or call is that of the project here, or the shipped one, unless the specification names one.
    What the specification says holds always is added to what the task says. A store is closed at the end.
    """
    loading = _load_goal(spec, store, reporter) if spec.task is None else _load_named(spec.task, spec, store, reporter)
    with loading as loaded:
        yield with_always(loaded, spec.always)


def find_task_in_scene(reference: str, backend: BackendName | None = None) -> FoundTask:
    """Find and compile the task `LIBRARY:NAME`, or that of the project here or shipped; return it with its scene file.

    It runs in a cell of `backend`, or if that is None of its own back end, and the library is as such cells run it.

    A goal or call that a `skillc.toml` names becomes a task of the library.
    """
    files, name = split_reference(reference)
    library = compile_valid(files)
    own = library.tasks[name].backend if name in library.tasks else None
    chosen = _choose_backend(backend, own, files)
    library = adapt_library(library, chosen)
    if name not in library.tasks and files.project and name in files.project.manifest.tasks:
        # What reads goals is slow to import.
        from skillc.services.tasks.named_goals import make_named_task, named_scene

        scene = named_scene(files.project, name)
        task = make_named_task(files.project, name, library, scene)
        return FoundTask(structs.replace(library, tasks={**library.tasks, name: task}), task, scene, chosen)
    task = find_task(library, name)
    if task.goal is None and task.body is None:
        raise RequestError(f"the task `{name}` has neither a goal nor a body")
    return FoundTask(library, task, find_scene_of(task, files), chosen)


def _choose_backend(wanted: BackendName | None, of_task: str | None, files: LibraryFiles) -> BackendName:
    """Return the first back end that is named: as wanted, by the task, by its project, by the project here.

    RequestError if it is not installed.
    """
    here = find_project(Path())
    default = here.manifest.tool.run.backend if here else None
    return require_backend(files._replace(backend=wanted).backend_of(of_task, default))


def with_project_deadline(spec: RunSpec, loaded: LoadedTask) -> RunSpec:
    """Return a specification with the deadline of the project here, if neither it nor the task limits the time."""
    here = find_project(Path())
    if here is None or spec.deadline_s is not None or loaded.assignment.within_s is not None:
        return spec
    return structs.replace(spec, deadline_s=here.manifest.tool.run.deadline)


def with_project_measure(spec: RunSpec, loaded: LoadedTask, command: Literal["run", "plan"]) -> RunSpec:
    """Return a specification with what the project here minimises, if neither it nor the task says."""
    here, objective = find_project(Path()), loaded.assignment.objective
    if here is None or spec.minimise or not isinstance(objective, AchieveGoal) or objective.minimise:
        return spec
    tool = here.manifest.tool
    return structs.replace(spec, minimise=tool.run.minimise if command == "run" else tool.plan.minimise)


def with_always(loaded: LoadedTask, conditions: Sequence[str]) -> LoadedTask:
    """Return the task with conditions that it keeps besides its own; DiagnosticsError for errors in them."""
    assignment = loaded.assignment
    more = tuple(read_condition(each, loaded.library, assignment.state) for each in conditions)
    return structs.replace(loaded, assignment=structs.replace(assignment, always=(*assignment.always, *more)))


def find_scene_of(task: Task, files: LibraryFiles) -> Path:
    """Return the file of a task's scene, or of the default one of its project. RequestError if there is none."""
    if task.scene is None:
        default = named_scenes.default_scene(files.project) if files.project else None
        if default is None:
            how = "run it with --scene FILE and --goal or --call"
            raise RequestError(f"the task `{task.name}` has no scene; {how}")
        return default
    path = named_scenes.find_task_scene(task, files)
    if path is None:
        why = named_scenes.why_missing(task.scene, files.places[task.source.path].parent)
        raise RequestError(f'the scene "{task.scene}" of `{task.name}` {why}')
    return path


@contextmanager
def _load_named(reference: str, spec: RunSpec, store: StoreChoice, reporter: Reporter) -> Iterator[LoadedTask]:
    library, task, scene, backend = found = find_task_in_scene(reference, spec.backend)
    beside = [_find_beside(each, found, spec.backend) for each in spec.beside]
    with open_world(store, scene, library.vocabulary, reporter) as world:
        state = world.snapshot()
        several = assign_several((task, *beside), library, state) if beside else None
        assignment = several or assign_task(task, library, state, spec.arguments)
        yield LoadedTask(library, assignment, world, _origin(store, scene), backend)


def _find_beside(reference: str, first: FoundTask, backend: BackendName | None) -> Task:
    """Return a task that is done at once with the `first` one; RequestError if it is of another library or scene."""
    found = find_task_in_scene(reference, backend)
    for what, one, other in (
        ("the library", first.library.hash, found.library.hash),
        ("the scene", first.scene, found.scene),
        ("the back end", first.backend, found.backend),
    ):
        if one != other:
            raise RequestError(f"`{found.task.name}` does not have {what} of `{first.task.name}`")
    if found.task.name == first.task.name:
        raise RequestError(f"the task `{found.task.name}` is named twice")
    return found.task


@contextmanager
def _load_goal(spec: RunSpec, store: StoreChoice, reporter: Reporter) -> Iterator[LoadedTask]:
    files = find_library(Path(spec.library)) if spec.library else default_library()
    backend = _choose_backend(spec.backend, None, files)
    library = adapt_library(compile_valid(files), backend)
    scene = find_scene(Path(spec.scene)) if spec.scene else None
    with open_world(store, scene, library.vocabulary, reporter) as world:
        state = world.snapshot()
        if spec.goal is not None:
            assignment = assign_goal(spec.goal, library, state)
        else:
            assert spec.call is not None
            assignment = assign_call(spec.call, library, state)
        yield LoadedTask(library, assignment, world, _origin(store, scene), backend)


def _origin(store: StoreChoice, scene: Path | None) -> str:
    """Return the file of the scene that a world was read from; empty if it comes from a store."""
    return str(scene) if scene is not None and store.place is None else ""


def with_measure(loaded: LoadedTask, minimise: PlanMeasure | None) -> LoadedTask:
    """Return the task with what is minimised in place of what it says, if any; RequestError if it has no goal."""
    assignment = loaded.assignment
    if minimise is None:
        return loaded
    if not isinstance(assignment.objective, AchieveGoal):
        raise RequestError(f"`{assignment.name}` has a body, not a goal: there is no plan to minimise")
    return structs.replace(
        loaded, assignment=structs.replace(assignment, objective=AchieveGoal(assignment.objective.goal, minimise))
    )
