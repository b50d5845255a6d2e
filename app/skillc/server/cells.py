"""Chooses the cells of a server: one for each scene, with the library that the scene belongs to."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from skillc.cells.settings import CellSettings
from skillc.errors import RequestError
from skillc.server.served_library import ServedLibrary, open_library
from skillc.server.state import CELLS
from skillc.services.library.files import find_scene
from skillc.services.project.backends import BackendName
from skillc.services.project.loading import find_project
from skillc.services.tasks.named_scenes import default_scene
from skillc_ontology import catalogue


@dataclass(frozen=True, slots=True)
class ServedCells:
    """The libraries of a server, and its cells."""

    libraries: tuple[ServedLibrary, ...]
    cells: tuple[CellSettings, ...]

    def find_library(self, cell: CellSettings) -> ServedLibrary:
        """Return the library of a cell."""
        return next(each for each in self.libraries if each.path == cell.library)


def choose_cells(
    libraries: Sequence[Path], scenes: Sequence[Path], state: Path, backend: BackendName, seed: int
) -> ServedCells:
    """Return a cell for each scene, named like its file, or for the default scenes of the libraries' projects.

    A scene is here, in the folder of a library, or shipped. A cell has the library in whose folder its scene is,
    otherwise the first one. RequestError if there is no scene, or two have the same name; DiagnosticsError if a
    library has errors.
    """
    folders = [each for each in libraries if each.is_dir() and each.resolve() != Path().resolve()]
    wanted = [find_scene(each, folders).resolve() for each in scenes or _default_scenes(libraries)]
    opened = tuple(open_library(each, wanted) for each in libraries)
    if not wanted:
        raise RequestError("name the scene of a cell with --cell FILE")
    names = [each.stem for each in wanted]
    if len(set(names)) < len(names):
        raise RequestError(f"two scenes have the same name: {', '.join(map(str, wanted))}")
    for each in opened:
        catalogue.add_folders(each.ontologies)
        sys.path.extend(folder for folder in each.modules if folder not in sys.path)
    return ServedCells(opened, tuple(_make(each, opened, state, backend, seed) for each in wanted))


def _make(
    scene: Path, libraries: Sequence[ServedLibrary], state: Path, backend: BackendName, seed: int
) -> CellSettings:
    library = _choose_library(scene, libraries)
    return CellSettings(
        name=scene.stem,
        scene=str(scene),
        library=library.path,
        folder=str((state / CELLS / scene.stem).resolve()),
        backend=backend,
        seed=seed,
        content=library.checked.content,
        modules=library.checked.basis.modules,
        environment=library.environment,
    )


def _choose_library(scene: Path, libraries: Sequence[ServedLibrary]) -> ServedLibrary:
    """Return the library in whose folder a scene is, the innermost one; otherwise the first one."""
    own = {each.checked.basis.folders[0]: each for each in reversed(libraries)}
    return next((own[str(folder)] for folder in scene.parents if str(folder) in own), libraries[0])


def _default_scenes(libraries: Sequence[Path]) -> Iterator[Path]:
    for each in libraries:
        project = find_project(each) if each.is_dir() else None
        scene = default_scene(project) if project else None
        if scene is not None:
            yield scene
