"""The scenes of a library's tasks, for checking what the tasks name."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from skillc_compiler.library.skills import SkillLibrary, Task
from skillc_dsl.diagnostics import Diagnostic, Outcome, did_you_mean
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue
from skillc_runtime.commands import _diagnostics, _foresight
from skillc_runtime.commands._library import LibraryFiles
from skillc_runtime.world.documents import SceneError
from skillc_runtime.world.scene import Scene, read_scene
from skillc_runtime.world.state import WorldState

LONGEST_TASK = 10
"""How many lines below its name a task's goal stands at most."""

Individuals = dict[str, list[str]]
"""The IRIs of a scene with their classes."""


def path_of(task: Task, files: LibraryFiles) -> Path | None:
    """Return a task's scene, relative to the task's file or shipped; None where there is no such file."""
    assert task.scene is not None
    beside = files.places[task.source.path].parent / task.scene
    if beside.is_file():
        return beside
    try:
        return catalogue.scene(task.scene)
    except FileNotFoundError:
        return None


def individuals_of(library: SkillLibrary, files: LibraryFiles) -> tuple[Outcome[dict[str, Individuals]], set[Path]]:
    """Return the individuals in the scene of each task, with what is wrong with the scenes, and the files read."""
    found: dict[str, Individuals] = {}
    problems: list[Diagnostic] = []
    read: set[Path] = set()
    for name, task in library.tasks.items():
        path = path_of(task, files) if task.scene else None
        if path is None:
            problems += [_unknown(task, files)] if task.scene else []
            continue
        read.add(path)
        scene = _read(path, library)
        problems += scene.diagnostics
        if scene.ok and scene.value is not None:
            found[name] = classes_of(scene.value.state, library)
    return Outcome(found, tuple(problems)), read


def classes_of(state: WorldState, library: SkillLibrary) -> Individuals:
    """Return the individuals of a world with their classes, as the library knows them: the scene may have its own."""
    known = library.vocabulary.classes.keys()
    above = state.vocabulary.ancestors
    return {
        iri: sorted({each for cls in state.types(iri) for each in ({cls} if cls in known else above[cls] & known)})
        for iri in state.individuals
    }


def foreseen(compiled: Outcome[SkillLibrary], files: LibraryFiles, scene: Path | None) -> list[Diagnostic]:
    """Return what keeps tasks from being done in their scenes, and whom in them or in `scene` no implementation fits.

    Of libraries and scenes with mistakes nothing is foreseen, and nothing that was told while compiling.
    """
    if not compiled.ok:
        return []
    library = compiled.value
    own = {source.path for source in files.sources}
    placed = [(task, path_of(task, files)) for task in library.tasks.values() if task.scene and task.source.path in own]
    paths = {path for path in (scene, *(path for _, path in placed)) if path is not None}
    scenes = {path: read.value for path in sorted(paths) if (read := _read(path, library)).ok and read.value}
    of_tasks = (
        _foresight.of_task(task, library, files, scenes[path]) for task, path in placed if path and path in scenes
    )
    of_individuals = (_foresight.of_individuals(library, read, str(path)) for path, read in scenes.items())
    errors = [each for found in of_tasks for each in found if not _told(each, compiled.diagnostics)]
    shown = {(label.span.path, label.span.line) for each in errors for label in each.labels}
    others = [each for found in of_individuals for each in found]
    return [*errors, *(each for each in others if (each.span.path, each.span.line) not in shown)]


def _told(foreseen: Diagnostic, compiled: Sequence[Diagnostic]) -> bool:
    """Whether compiling has said already, some lines below the task's first, that no skill does what a goal asks."""
    goals = [each.span for each in compiled if each.name == "unachievable-goal"]
    first = foreseen.span
    return foreseen.name == "unreachable-goal" and any(
        goal.path == first.path and 0 <= goal.line - first.line <= LONGEST_TASK for goal in goals
    )


def _read(path: Path, library: SkillLibrary) -> Outcome[Scene | None]:
    try:
        scene = read_scene(path, library.vocabulary)
    except SceneError as error:
        return Outcome(None, tuple(_diagnostics.of_problems(error.problems)))
    return Outcome(scene, tuple(_diagnostics.of_problems(scene.problems)))


def texts_of(paths: set[Path]) -> dict[str, Source]:
    """Return the texts of scenes by the path that diagnostics show."""
    return {shown: source for path in paths for shown, source in _diagnostics.scene_text(path).items()}


def _unknown(task: Task, files: LibraryFiles) -> Diagnostic:
    place, scene = task.source, task.scene or ""
    span = Span(files.shown(place.path), place.line, place.column, place.line, place.column + 1)
    shipped = did_you_mean(scene, catalogue.scenes())
    return Diagnostic(
        "unknown-scene",
        span,
        f'the task `{task.name}` has the scene "{scene}", which is neither beside this file nor shipped',
        shipped,
    )
