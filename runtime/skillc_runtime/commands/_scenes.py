"""The scenes of a library's tasks, for checking what the tasks name."""

from __future__ import annotations

from pathlib import Path

from skillc_compiler.library.skills import SkillLibrary, Task
from skillc_dsl.diagnostics import Diagnostic, Outcome, did_you_mean
from skillc_dsl.source import Source, Span
from skillc_ontology import catalogue
from skillc_runtime.commands import _diagnostics
from skillc_runtime.commands._library import LibraryFiles
from skillc_runtime.world.documents import SceneError
from skillc_runtime.world.scene import load_scene

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
        try:
            state = load_scene(path, library.vocabulary)
        except SceneError as error:
            problems += _diagnostics.of_problems(error.problems)
        else:
            found[name] = {iri: sorted(state.types(iri)) for iri in state.individuals}
    return Outcome(found, tuple(problems)), read


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
