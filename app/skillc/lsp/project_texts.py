"""Reads the texts of a project beside its skills that name terms and individuals: RDF files and the manifest."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import pyoxigraph as ox

from skillc.lsp import files
from skillc.lsp.files import Root
from skillc.lsp.scenes import read_text
from skillc.services.library.files import LibraryFiles
from skillc.services.project.goal_texts import read_goals
from skillc.services.project.project import MANIFEST
from skillc_compiler.ide.analysis import Analysis
from skillc_compiler.ide.project_names import FixedText, NamedGoal, ProjectNames
from skillc_dsl.source import Source
from skillc_ontology import catalogue
from skillc_rdf.formats.detect import detect_format

if TYPE_CHECKING:
    from skillc.services.tasks.scenes import TaskScenes

EDITED = (".ttl", ".trig", ".nt", ".nq")
"""The ends of the names of files whose names are edited."""
_FORMATS = (ox.RdfFormat.TURTLE, ox.RdfFormat.TRIG, ox.RdfFormat.N_QUADS)
_NOT_TURTLE = "which is not Turtle: rename it there first"
_PACKED = "which is compressed: rename it there first"


def read_names(
    analysis: Analysis, root: Root, around: LibraryFiles, scenes: TaskScenes | None, buffers: Mapping[Path, str]
) -> ProjectNames:
    """Return the names in the texts of a project; `buffers` replace files on disk."""
    shown = {file: path for path, file in around.places.items()}
    turtle: dict[str, str] = {}
    outside: dict[str, str] = {}
    fixed: dict[str, FixedText] = {}
    paths: dict[Path, str] = {}
    for file in files.list_rdf(root):
        path, text = shown.get(file) or file.relative_to(root.folder).as_posix(), _read(file, buffers)
        paths[file.resolve()] = path
        if file.name.endswith(EDITED) and detect_format(Source(file.name, text)) in _FORMATS:
            turtle[path] = text
        elif file.suffix != ".xml" or detect_format(Source(file.name, text)) not in _FORMATS:
            fixed[path] = FixedText(text, _PACKED if file.suffix == ".gz" else _NOT_TURTLE)
    of_tasks = scenes.files if scenes else {}
    for file in sorted({each.resolve() for each in of_tasks.values()} - paths.keys()):
        path = str(file.relative_to(catalogue.ROOT) if file.is_relative_to(catalogue.ROOT) else file)
        outside[path] = _read(file, buffers)
    manifest = around.project.source.text if around.project else ""
    goals = []
    for goal in read_goals(around.project) if around.project else ():
        if isinstance(goal, NamedGoal):
            goals.append(goal)
        else:
            fixed[f"{MANIFEST}, `{goal[0]}`"] = FixedText(goal[1], "with escapes: rename it there first")
    chosen = {task: paths[file.resolve()] for task, file in of_tasks.items() if file.resolve() in paths}
    return ProjectNames(analysis, turtle, outside, fixed, tuple(goals), {MANIFEST: manifest} if goals else {}, chosen)


def _read(file: Path, buffers: Mapping[Path, str]) -> str:
    """Return the text of a file; an empty one if it cannot be read."""
    try:
        return read_text(file, buffers)
    except OSError:
        return ""
