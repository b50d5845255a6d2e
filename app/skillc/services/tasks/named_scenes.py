"""Finds the files of scenes that tasks and manifests name."""

from __future__ import annotations

from pathlib import Path

from skillc.services.library.files import LibraryFiles
from skillc.services.project.project import Project
from skillc.services.reporting.files import inspect_path
from skillc_model.skills import Task
from skillc_ontology import catalogue


def default_scene(project: Project) -> Path | None:
    """Return the file of a project's default scene, None if it names none or the file does not exist."""
    return resolve_scene(project.manifest.scene, project.root) if project.manifest.scene else None


def find_task_scene(task: Task, files: LibraryFiles) -> Path | None:
    """Return the file of a compiled task's scene, None if it does not exist."""
    assert task.scene is not None
    return resolve_scene(task.scene, files.places[task.source.path].parent)


def resolve_scene(scene: str, beside: Path) -> Path | None:
    """Return the file of a scene, in the folder `beside` or shipped; None if it does not exist."""
    if inspect_path(beside / scene).kind == "file":
        return beside / scene
    try:
        return catalogue.scene_path(scene)
    except FileNotFoundError:
        return None


def why_missing(scene: str, beside: Path) -> str:
    """Return why a scene is not found, to complete a sentence that begins with its name."""
    found = inspect_path(beside / scene)
    return "is neither beside this file nor shipped" if found.kind == "missing" else found.is_what
