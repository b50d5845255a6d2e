"""An experiment by its content: a library, a scene and the files that they need, so that any machine can run it."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path

import msgspec

from skillc_model import codec
from skillc_ontology import catalogue
from skillc_runtime.devices.reality import set_reality
from skillc_runtime.evaluation.trials.experiment import TrialRunner
from skillc_runtime.evaluation.trials.identity import compute_digest
from skillc_runtime.evaluation.trials.trial import TrialDisturbance
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.terms import MESH
from skillc_runtime.world.state.world_state import WorldState


class Experiment(msgspec.Struct, frozen=True, kw_only=True):
    """What trials run: a compiled library as JSON, the name of its task, the disturbance, and the file of a scene.

    `reality` is how far devices are from what they should be, as the facts say if it is None. `folders` are the
    ontology folders that the scene is read with: for each the contents of its files, by their paths.
    """

    library: bytes
    task: str
    disturbance: TrialDisturbance
    scene_name: str
    scene: bytes
    folders: tuple[dict[str, bytes], ...] = ()
    reality: str | None = None

    @property
    def library_digest(self) -> str:
        """A digest of the library with its task."""
        return compute_digest((self.library,))

    @property
    def scene_digest(self) -> str:
        """A digest of the scene and of what it is read with."""
        files = (
            part for folder in self.folders for path, content in folder.items() for part in (path.encode(), content)
        )
        return compute_digest((self.scene, *files))


def read_folders(state: WorldState) -> tuple[dict[str, bytes], ...]:
    """Read what the world of a scene needs: data sheets and models in the user's folders, and meshes; OSError if not.

    Meshes from the current folder are a folder of their own. Those that are named by absolute paths do not travel.
    """
    own = [dict(_read_sheets(folder)) for folder in catalogue.user_folders()]
    meshes = {name: Path(name).read_bytes() for name in sorted(_mesh_names(state)) if _is_here(name)}
    return tuple(folder for folder in (meshes, *own) if folder)


def prepare_runner(experiment: Experiment) -> TrialRunner:
    """Make the runner of an experiment in a process of its own, which then sees only the experiment's folders.

    LibraryError, SceneError or OSError if the library or the scene cannot be loaded.
    """
    place = Path(tempfile.mkdtemp())
    folders = [place / str(number) for number in range(len(experiment.folders))]
    for folder, files in zip(folders, experiment.folders, strict=True):
        _write(folder, files.items())
    _write(place, [(experiment.scene_name, experiment.scene)])
    catalogue.replace_folders(folders)
    library = codec.loads(experiment.library, "the library")
    state = load_scene(place / experiment.scene_name, library.vocabulary)
    if experiment.reality is not None:
        state = set_reality(state, experiment.reality)
    return TrialRunner(library, state, experiment.task, experiment.disturbance)


def _read_sheets(folder: Path) -> Iterator[tuple[str, bytes]]:
    for name in catalogue.SHEET_FOLDERS:
        for path in sorted((folder / name).rglob("*")):
            if path.is_file():
                yield path.relative_to(folder).as_posix(), path.read_bytes()


def _mesh_names(state: WorldState) -> set[str]:
    names = (state.value(each, MESH) for each in state.individuals) if MESH in state.stored else ()
    return {name for name in names if isinstance(name, str)}


def _is_here(name: str) -> bool:
    """Whether a mesh is found from the current folder, and may be written below another one."""
    return not Path(name).is_absolute() and ".." not in Path(name).parts and Path(name).is_file()


def _write(folder: Path, files: Iterable[tuple[str, bytes]]) -> None:
    for name, content in files:
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
