"""Checks a recorded run: its events against its library, and a simulated run by running it again from its inputs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import msgspec

from skillc.errors import ServiceError
from skillc.services.project.backends import make_backend
from skillc.services.replaying.inputs import RunInputs, build_beginning, read_inputs
from skillc.services.reporting.reporter import Reporter
from skillc.services.run.recordings import find_obstacle
from skillc_runtime.devices.backend import Backend
from skillc_runtime.devices.checkpoints import CheckpointError
from skillc_runtime.execution.consistency import check_events
from skillc_runtime.execution.repeat import Divergence, NotRepeatable, Repetition, repeat_run
from skillc_runtime.recording.events import Event, Listener
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel

BUILT_BY_PROGRAM = "a program built its cell"


class DifferentEvent(msgspec.Struct, frozen=True):
    """The first event, by number from 1, that was another one when the run was repeated; None for no event."""

    number: int
    recorded: dict[str, Any] | None
    repeated: dict[str, Any] | None


class ReplayCheck(msgspec.Struct, frozen=True, kw_only=True):
    """What the check of a run found.

    `checked` if it was looked whether events can follow those before them; `impossible` is why one cannot, None if all
    can. `repeated` is how many events were the same when the run was repeated, None if it was not repeated, and `note`
    says why not. `difference` is the first event that was another one.
    """

    run: str
    events: int
    checked: bool = True
    impossible: str | None = None
    repeated: int | None = None
    note: str = ""
    difference: DifferentEvent | None = None

    @property
    def ok(self) -> bool:
        """Whether nothing was found."""
        return self.impossible is None and self.difference is None


def check_run(run: Path, library: Path | None, reporter: Reporter) -> ReplayCheck:
    """Check a run, given its folder or recording; `library` is used in place of the recorded one.

    What `read_inputs` raises.
    """
    inputs = read_inputs(run, library, reporter)
    count = len(inputs.events)
    if inputs.obstacle:  # what others did meanwhile is not recorded, and an event may follow from that
        return ReplayCheck(run=str(run), events=count, checked=False, note=inputs.obstacle)
    impossible = check_events(inputs.events, inputs.library, inputs.world)
    if impossible is not None:
        return ReplayCheck(run=str(run), events=count, impossible=str(impossible), note="the events are impossible")
    if not inputs.start.backend:
        return ReplayCheck(run=str(run), events=count, note=BUILT_BY_PROGRAM)
    reporter.say("the events are possible with the library; running again from the seed, requests and plans")
    try:
        difference, same = _repeat(inputs)
    except NotRepeatable as error:
        return ReplayCheck(run=str(run), events=count, note=str(error))
    return ReplayCheck(run=str(run), events=count, repeated=same, difference=difference)


def _repeat(inputs: RunInputs) -> tuple[DifferentEvent | None, int]:
    """Run again; return the first event that differs, and how many were the same. NotRepeatable; ServiceError."""
    cell = build_cell(inputs)
    try:
        repetition = repeat(inputs, cell)
    finally:
        cell.close()
    found = repetition.difference
    return (None if found is None else _describe(found)), len(repetition.events) if found is None else found.number - 1


def repeat(
    inputs: RunInputs,
    cell: Backend,
    listeners: Sequence[Listener] = (),
    after_tick: Sequence[Callable[[], None]] = (),
) -> Repetition:
    """Run again in a cell that `build_cell` returned; arguments and errors as of `repeat_run`."""
    ticks = inputs.beginning.ticks if inputs.beginning is not None else 0
    disturber = cell.capabilities.disturber
    disturb = None if disturber is None else disturber.disturb
    return repeat_run(inputs.events, inputs.library, cell, listeners, after_tick, disturb, ticks)


def build_cell(inputs: RunInputs) -> Backend:
    """Return the cell of a recorded run as it was at its start. ServiceError if that is not possible."""
    start = inputs.start
    if not start.backend:
        raise ServiceError(f"the run cannot be repeated: {BUILT_BY_PROGRAM}")
    beginning, world = inputs.beginning, WorldModel(inputs.world)
    if beginning is not None:
        world = build_beginning(beginning, inputs.library, Path(start.scene))
    try:
        cell = make_backend(start.backend, world, start.seed, beginning.simulation if beginning is not None else None)
    except (SheetError, FrameError, CheckpointError) as error:
        raise ServiceError(f"the scene of the run cannot be simulated: {error}") from error
    if obstacle := find_obstacle(cell):  # a real cell must not move because somebody looks at a recording
        cell.close()
        raise ServiceError(f"the run cannot be repeated: {obstacle}")
    return cell


def _describe(found: Divergence) -> DifferentEvent:
    return DifferentEvent(found.number, _as_data(found.recorded), _as_data(found.repeated))


def _as_data(event: Event | None) -> dict[str, Any] | None:
    if event is None:
        return None
    value: dict[str, Any] = msgspec.to_builtins(event)
    return value
