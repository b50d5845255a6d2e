"""Chooses the cells of a server: one for each scene."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from skillc.cells.host import CellSettings
from skillc.server.state import CELLS
from skillc.services.backends import BackendName
from skillc.services.errors import RequestError
from skillc.services.libraries import compile_valid
from skillc.services.library_files import find_library, find_scene
from skillc.services.task_scenes import default_scene


def choose_cells(
    library: Path, scenes: Sequence[Path], state: Path, backend: BackendName, seed: int
) -> tuple[CellSettings, ...]:
    """Return a cell for each scene, named like its file, or for the default scene of the library's project.

    RequestError if there is no scene, or two have the same name; DiagnosticsError if the library has errors.
    """
    files = find_library(library)
    compile_valid(files)
    if not scenes:
        scene = default_scene(files.project) if files.project else None
        if scene is None:
            raise RequestError("name the scene of a cell with --cell FILE")
        scenes = (scene,)
    found = [find_scene(each).resolve() for each in scenes]
    names = [each.stem for each in found]
    if len(set(names)) < len(names):
        raise RequestError(f"two scenes have the same name: {', '.join(map(str, found))}")
    return tuple(
        CellSettings(
            name=scene.stem,
            scene=str(scene),
            library=str(library.resolve() if library.exists() else library),
            folder=str((state / CELLS / scene.stem).resolve()),
            backend=backend,
            seed=seed,
        )
        for scene in found
    )
