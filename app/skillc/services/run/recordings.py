"""Records runs as MCAP files: what a run is made of, and its file while it goes on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import msgspec

from skillc.services.library.schemas import read_schema
from skillc.services.recording.recordings import RECORDING
from skillc.services.reporting.files import writing_to
from skillc.services.reporting.reporter import Reporter
from skillc_model.codec import dumps
from skillc_model.skills import SkillLibrary
from skillc_runtime.devices.backend import Backend
from skillc_runtime.execution.attempt import CellOrigin
from skillc_runtime.recording.envelope import Recorder
from skillc_runtime.recording.mcap.contents import LIBRARY, NOT_REPEATABLE, SCENE, SETTINGS, START, RunContents
from skillc_runtime.recording.mcap.recording_file import RecordingFile
from skillc_runtime.recording.mcap.signal_tap import RecordedCell, SignalTap
from skillc_runtime.recording.run_spec import RunRequest
from skillc_runtime.recording.run_start import encode_start
from skillc_runtime.recording.signals.channels import name_devices
from skillc_runtime.scene.load import load_sheets
from skillc_runtime.scene.saving import SaveError, format_scene
from skillc_runtime.world.state.evidence import LedgerWrite
from skillc_runtime.world.state.transactions import StoreError
from skillc_runtime.world.state.world_state import WorldState


class KnownStart(msgspec.Struct, frozen=True):
    """What is known of the start of a run: the world, and for a cell that goes on from run to run all that follows.

    That are the `writes` that led to the world, the number `ticks` of the first tick, and the `checkpoint` from which
    the cell was built; `obstacle` is why there is none.
    """

    state: WorldState
    writes: tuple[LedgerWrite, ...] = ()
    ticks: int = 0
    checkpoint: bytes = b""
    obstacle: str = ""


def describe_contents(
    run: str,
    task: str,
    library: SkillLibrary,
    start: KnownStart,
    origin: CellOrigin,
    settings: RunRequest,
    sheets: WorldState | None = None,
) -> RunContents:
    """Return what a run is made of: with its library, its start, the world then also as a scene, and its settings.

    `sheets` are the facts of data sheets, which a scene does not state; they are loaded unless they are given.
    """
    attachments = {LIBRARY: dumps(library), SETTINGS: msgspec.json.encode(settings)}
    state, obstacle = start.state, start.obstacle
    if start.checkpoint:
        try:
            attachments[START] = encode_start(state, library.vocabulary, start.writes, start.ticks, start.checkpoint)
        except StoreError as error:
            obstacle = f"its start cannot be recorded: {error}"
    try:
        attachments[SCENE] = format_scene(state, sheets or load_sheets(state.vocabulary)).encode()
    except SaveError as error:
        attachments[SCENE] = f"# The world cannot be written as a scene: {error}\n".encode()
    metadata = {
        "skillc": version("skillc"),
        "run": run,
        "task": task,
        "library": library.name,
        "library_hash": library.hash,
        "scene": origin.scene,
        "seed": str(origin.seed),
        "backend": origin.backend,
    }
    if obstacle:
        metadata[NOT_REPEATABLE] = obstacle
    return RunContents(metadata, attachments, _read_event_schema())


@cache
def _read_event_schema() -> bytes:
    """Return the JSON Schema of an event without descriptions: it is in each file."""
    return msgspec.json.encode(_without_descriptions(msgspec.json.decode(read_schema("events"))))


def _without_descriptions(part: Any) -> Any:
    if isinstance(part, list):
        return [_without_descriptions(each) for each in part]
    if not isinstance(part, dict):
        return part
    kept = {name: value for name, value in part.items() if name != "description" or not isinstance(value, str)}
    return {name: _without_descriptions(value) for name, value in kept.items()}


def make_recorded_cell(backend: Backend) -> RecordedCell | None:
    """Return what of a cell is recorded besides events; None if it offers no signals, or has no devices with any."""
    live, drawing = backend.capabilities.live, backend.capabilities.drawing
    if live is None:
        return None
    tap, names = SignalTap(live), name_devices(backend.cell.world.snapshot())
    signals = tap.layout.describe(lambda device: names[device])
    return RecordedCell(tap, signals, None if drawing is None else drawing.model) if signals else None


def find_obstacle(backend: Backend) -> str:
    """Return why a run in a new cell cannot be repeated from its recording; empty if it can."""
    if backend.capabilities.lock_step is None:
        return "its cell has a time of its own"
    if backend.capabilities.commands is not None:
        return "it was a dry run, which began where devices were measured"
    return ""


@contextmanager
def recorded_in(
    folder: Path,
    describe: Callable[[], RunContents],
    backend: Backend | None,
    reporter: Reporter,
) -> Iterator[tuple[Recorder, ...]]:
    """Record a run in a `with` statement in a folder; yields who gets the events.

    ServiceError if the folder cannot be written to.
    """
    with writing_to(folder):
        folder.mkdir(parents=True, exist_ok=True)
        cell = None if backend is None else make_recorded_cell(backend)
        recording = RecordingFile(folder / RECORDING, describe, cell)
        recording.sample()
    try:
        yield (recording,)
    finally:
        recording.close()
        if recording.problem is not None:
            reporter.say(f"warning: {recording.problem}")
