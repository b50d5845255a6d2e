"""Finds the libraries at a path: the one there, and those in folders below, which are libraries of their own."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from skillc.services.library.files import LibraryFiles, find_library
from skillc.services.library.source_files import refuse_unreadable
from skillc.services.project.loading import find_project
from skillc.services.project.project import MANIFEST, VIRTUAL_ENVIRONMENT
from skillc.services.reporting.files import inspect_path


def find_libraries(path: Path) -> Iterator[LibraryFiles]:
    """Yield the library at a path, and outside of projects those below it; RequestError if there is none.

    A folder is a library if it is a project or in one, or if it has `.skill` files of its own. All below belongs to it,
    except for other projects.
    """
    if inspect_path(path).kind != "folder" or find_project(path):
        yield find_library(path)
        return
    is_library = any(path.glob("*.skill"))
    below = list(_find_below(path, _is_project if is_library else _is_library))
    if is_library or not below:
        yield find_library(path)
    for folder in below:
        yield from find_libraries(folder)


def _is_project(names: Sequence[str]) -> bool:
    return MANIFEST in names


def _is_library(names: Sequence[str]) -> bool:
    return _is_project(names) or any(name.endswith(".skill") for name in names)


def _find_below(folder: Path, is_wanted: Callable[[Sequence[str]], bool]) -> Iterator[Path]:
    """Yield the nearest folders below whose files are as wanted; hidden folders and environments are not entered."""
    for place, folders, names in os.walk(folder, onerror=refuse_unreadable):
        if place != str(folder) and is_wanted(names) and VIRTUAL_ENVIRONMENT not in names:
            yield Path(place)
            folders.clear()
        if VIRTUAL_ENVIRONMENT in names:
            folders.clear()
        folders[:] = sorted(each for each in folders if not each.startswith("."))
