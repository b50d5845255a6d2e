"""What a recorded run was made of: its events, its library and its world at the start."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from msgspec import structs

from skillc.errors import RequestError, ServiceError
from skillc.services.library.compiled_libraries import compile_valid
from skillc.services.library.files import SHIPPED, find_library
from skillc.services.project.backends import adapt_library
from skillc.services.project.loading import find_project
from skillc.services.recording.recordings import find_mcap, find_recording, is_mcap, read_envelopes
from skillc.services.reporting.files import inspect_path
from skillc.services.reporting.reporter import Reporter
from skillc_model.codec import LibraryError, loads
from skillc_model.skills import Primitive, SkillLibrary
from skillc_runtime.recording.events import Event, TaskStarted
from skillc_runtime.recording.mcap.contents import LIBRARY, NOT_REPEATABLE, SCENE, START
from skillc_runtime.recording.mcap.reader import read_recording
from skillc_runtime.recording.reader import TraceError
from skillc_runtime.recording.run_start import RunStart, StartError, build_world_again, decode_start
from skillc_runtime.scene.documents import SceneError
from skillc_runtime.scene.load import load_scene
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import StoreError
from skillc_runtime.world.state.world_state import WorldState

SHIPPED_CODE = ("skillc", "skillc_runtime", "skillc_skills")
"""The packages whose Python a library in a recording may name: what a recording brings along is never executed."""


@dataclass(frozen=True, slots=True)
class RunInputs:
    """A recorded run: all its events, the first of which is `start`, its library, and its world before the first.

    `wall_time_s` is how long it took on the wall clock. `beginning` is what it began from in a cell that had run
    before, None for a new cell; `obstacle` is why it cannot be repeated, empty if it can.
    """

    start: TaskStarted
    events: tuple[Event, ...]
    library: SkillLibrary
    world: WorldState
    wall_time_s: float
    beginning: RunStart | None = None
    obstacle: str = ""


def read_inputs(run: Path, library: Path | SkillLibrary | None, reporter: Reporter) -> RunInputs:
    """Read what a run was made of, given its folder or recording; `library` is used in place of the recorded one.

    One that is compiled already is used only if it is the one of the run.

    RequestError if the library must be given; ServiceError if anything cannot be read, DiagnosticsError for a library
    with errors.
    """
    path = find_recording(run)
    envelopes = read_envelopes(path, reporter)
    events = tuple(each.event for each in envelopes)
    if not events or not isinstance(events[0], TaskStarted):
        raise ServiceError(f"{path} does not begin with the start of a task")
    start = events[0]
    metadata, attachments = _read_contents(path)
    found = adapt_library(_find_library(start, attachments, library, path), start.backend)
    wall_time_s = (envelopes[-1].wall_time_ns - envelopes[0].wall_time_ns) * 1e-9
    beginning = _read_beginning(attachments, path)
    if beginning is None:
        world = _load_world(start, attachments, found, path)
    else:
        world = build_beginning(beginning, found, path).snapshot()
    return RunInputs(start, events, found, world, wall_time_s, beginning, metadata.get(NOT_REPEATABLE, ""))


def build_beginning(beginning: RunStart, library: SkillLibrary, path: Path) -> WorldModel:
    """Return the world from which a run began, with its evidence; ServiceError if the recording does not have it."""
    try:
        return build_world_again(beginning, library.vocabulary)
    except (StartError, StoreError) as error:
        raise ServiceError(f"the world at the start of {path} cannot be read: {error}") from error


def _read_beginning(attachments: Mapping[str, bytes], path: Path) -> RunStart | None:
    try:
        return decode_start(attachments[START]) if START in attachments else None
    except StartError as error:
        raise ServiceError(f"the start in {path} cannot be read: {error}") from error


def _read_contents(path: Path) -> tuple[Mapping[str, str], Mapping[str, bytes]]:
    """Return the metadata and the files in the recording of a run, by name; none if it has only events."""
    mcap = path if is_mcap(path) else find_mcap(path.parent)
    if mcap is None:
        return {}, {}
    try:
        recording = read_recording(mcap)
        return recording.metadata, recording.attachments
    except TraceError as error:
        raise ServiceError(str(error)) from error
    except OSError as error:
        raise ServiceError(f"{mcap} cannot be read: {error.strerror or error}") from error


def _find_library(
    start: TaskStarted, attachments: Mapping[str, bytes], library: Path | SkillLibrary | None, path: Path
) -> SkillLibrary:
    if isinstance(library, SkillLibrary) and library.hash == start.hash:
        return library
    if isinstance(library, Path):  # its name is that of its folder, which may be another one by now
        return structs.replace(compile_valid(find_library(library)), name=start.library)
    if LIBRARY not in attachments:
        if not (SHIPPED / start.library).is_dir():
            raise RequestError(f"{path} has no library: give the library `{start.library}` with --library")
        return compile_valid(find_library(SHIPPED / start.library))
    try:
        found = loads(attachments[LIBRARY], f"the library in {path}")
    except LibraryError as error:
        raise ServiceError(str(error)) from error
    foreign = next((each for each in _list_python(found) if each.partition(".")[0] not in SHIPPED_CODE), None)
    if foreign is None:
        return found
    if (own := _find_here(start.library)) is not None:
        return compile_valid(find_library(own))
    why = f"the library `{start.library}` uses the Python module {foreign}, and a recording executes no code"
    raise RequestError(f"{why}: give the library with --library, or go to the folder of its project")


def _find_here(library: str) -> Path | None:
    """Return the folder of a library that is the project here, or one that it depends on; None if it is neither."""
    here = find_project(Path())
    return {each.name: each.root for each in (here, *here.others())}.get(library) if here is not None else None


def _list_python(library: SkillLibrary) -> Iterator[str]:
    """Yield the modules that a library names."""
    for implementation in library.implementations.values():
        if isinstance(implementation.body, Primitive):
            yield implementation.body.python.partition(":")[0]
    vocabulary = library.vocabulary
    yield from (each.computed_by.partition(":")[0] for each in vocabulary.relations.values() if each.computed_by)
    yield from (each.computed_by.partition(":")[0] for each in vocabulary.properties.values() if each.computed_by)
    yield from (each.python.partition(":")[0] for each in vocabulary.functions.values())


def _load_world(start: TaskStarted, attachments: Mapping[str, bytes], library: SkillLibrary, path: Path) -> WorldState:
    """Return the world at the start: the scene in the recording, else the file of the scene."""
    text = attachments.get(SCENE, b"")
    with TemporaryDirectory(prefix="skillc-replay-") as folder:
        file = Path(folder) / SCENE
        file.write_bytes(text)
        scene = file if text and not text.startswith(b"# The world cannot") else Path(start.scene)
        if not start.scene and scene is not file:
            raise ServiceError(f"{path} has no scene: the world of the run came from a store")
        if inspect_path(scene).kind != "file":
            raise ServiceError(f"{path} has no scene, and {scene} does not exist")
        try:
            return load_scene(scene, library.vocabulary)
        except SceneError as error:
            raise ServiceError(f"the scene of {path} cannot be loaded: {error}") from error
