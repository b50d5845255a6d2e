"""Checks that what a manifest names exists, and that the lock file is that of the libraries that are used."""

from __future__ import annotations

from collections.abc import Iterator

from skillc.errors import RequestError
from skillc.extras import MODULES, require
from skillc.services.library.files import LibraryFiles
from skillc.services.project.backends import require_backend
from skillc.services.project.lock import check_lock
from skillc.services.project.project import Project
from skillc.services.tasks.listing import task_names
from skillc.services.tasks.named_scenes import default_scene
from skillc_dsl.diagnostics import Diagnostic
from skillc_dsl.spelling import did_you_mean
from skillc_ontology import catalogue


def check_project(project: Project, files: LibraryFiles) -> Iterator[Diagnostic]:
    """Yield the diagnostics of a manifest without errors; `files` is its library."""
    manifest = project.manifest
    if manifest.scene is not None and default_scene(project) is None:
        message = f'the scene "{manifest.scene}" is neither in this project nor shipped'
        hint = did_you_mean(manifest.scene, catalogue.scene_names())
        yield Diagnostic("wrong-setting", project.place_of("scene"), message, hint)
    for folder, path in zip(manifest.ontology, project.ontologies, strict=True):
        if not path.is_dir():
            yield Diagnostic("wrong-setting", project.place_of("ontology"), f'there is no folder "{folder}"')
    whole = len(files.sources) > 1 or files.root == project.root
    if manifest.task is not None and whole and manifest.task not in task_names(files):
        message = f"there is no task `{manifest.task}` in this project"
        yield Diagnostic(
            "wrong-setting", project.place_of("task"), message, did_you_mean(manifest.task, task_names(files))
        )
    yield from _check_backend(project)
    if project.ontologies:
        # What reads data sheets imports much.
        from skillc.services.check.device_checks import check_project_sheets

        yield from check_project_sheets(project)
    yield from check_lock(project)


def _check_backend(project: Project) -> Iterator[Diagnostic]:
    """Yield a diagnostic if `run` would not find the back end, or the packages that it needs."""
    backend = project.manifest.tool.run.backend
    if backend is None:
        return
    try:
        require_backend(backend)
        require(f"the back end `{backend}`", *({backend} & MODULES.keys()))
    except RequestError as error:
        yield Diagnostic("wrong-setting", project.place_of("tool", "run", "backend"), str(error))
