"""Finds the project that a path is in, and reads it."""

from __future__ import annotations

import os
from pathlib import Path

from skillc.errors import DiagnosticsError, RequestError
from skillc.services.project.project import MANIFEST, Project, find_root
from skillc_dsl.encoding import decode, read_file
from skillc_dsl.source import Source


def find_project(path: Path) -> Project | None:
    """Return the project that a path is in, None if it is in none; its root is relative if the path is.

    DiagnosticsError if its manifest has errors or a dependency cannot be found.
    """
    root = find_root(path)
    if root is None:
        return None
    return load_project(root if path.is_absolute() else Path(os.path.relpath(root)))


def load_project(root: Path) -> Project:
    """Return the project in a folder with a `skillc.toml`. DiagnosticsError if it has errors."""
    # Most commands run in no project.
    from skillc.services.project.dependencies import resolve_dependencies
    from skillc.services.project.manifest import read_manifest

    source = _read(root / MANIFEST)
    outcome = read_manifest(source)
    if outcome.value is None:
        raise DiagnosticsError(outcome.diagnostics, {source.path: source})
    return resolve_dependencies(Project(root, outcome.value, source))


def _read(file: Path) -> Source:
    shown, here = file, Path.cwd()
    if file.is_absolute() and file.is_relative_to(here):
        shown = file.relative_to(here)
    try:
        return decode(str(shown), read_file(file))
    except OSError as error:
        raise RequestError(f"{shown} cannot be read: {error.strerror}") from error
