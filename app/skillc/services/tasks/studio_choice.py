"""Chooses what the studio serves: a library, the scenes of its cells, and perhaps a task of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from skillc.errors import RequestError
from skillc.services.library.files import SHIPPED, LibraryFiles, find_library
from skillc.services.tasks.listing import TaskEntry, default_library, split_reference, tasks_of
from skillc.services.tasks.named_scenes import default_scene, resolve_scene
from skillc_dsl.spelling import did_you_mean

MAX_SCENES = 4
"""How many scenes of tasks become cells by themselves; each is a process."""


@dataclass(frozen=True, slots=True)
class StudioChoice:
    """A library, the scenes of its cells, and the names of the cell and the task to begin with, empty for none."""

    library: Path
    scenes: tuple[Path, ...]
    cell: str = ""
    task: str = ""


def choose_studio(what: str | None, scenes: Sequence[Path]) -> StudioChoice:
    """Return what `what` names: a library or a task, by default the library of the project here, or the wiping library.

    Without `scenes` they are that of the task, or those of the library's tasks. The cell to begin with is that of the
    first scene, if anything is named. RequestError if there is none such.
    """
    if what is not None and not _is_library(what):
        return _choose_task(what, scenes)
    files = find_library(Path(what)) if what is not None else default_library()
    place = Path(what) if what is not None and Path(what).is_file() else files.root
    found = tuple(scenes) or tuple(_find_scenes(files, tasks_of(files)))
    return StudioChoice(place, found, found[0].stem if found and (what is not None or scenes) else "")


def _is_library(what: str) -> bool:
    return Path(what).exists() or (SHIPPED / what).is_dir() or what.endswith(".skill")


def _choose_task(reference: str, scenes: Sequence[Path]) -> StudioChoice:
    files, name = split_reference(reference)
    entries = {each.name: each for each in tasks_of(files)}
    if name not in entries:
        near = did_you_mean(name, entries)
        raise RequestError(f"there is no library and no task `{reference}`{f'; {near}' if near else ''}")
    found = tuple(scenes) or tuple(_find_scenes(files, (entries[name],)))
    if not found:
        raise RequestError(f"the task `{reference}` names no scene that exists; name one with --cell FILE")
    return StudioChoice(files.root, found, found[0].stem, name)


def _find_scenes(files: LibraryFiles, tasks: Sequence[TaskEntry]) -> Iterator[Path]:
    """Yield the scenes of tasks, one of each name, MAX_SCENES at most; the default one of a project first."""
    default = default_scene(files.project) if files.project else None
    written = (resolve_scene(each.scene, Path(each.file).parent) for each in tasks if each.scene)
    ordered = [each for each in ((default, *written) if len(tasks) != 1 else (*written, default)) if each is not None]
    by_name = {each.stem: each for each in reversed(ordered)}
    names = list(dict.fromkeys(each.stem for each in ordered))
    yield from (by_name[name] for name in names[: 1 if len(tasks) == 1 else MAX_SCENES])
