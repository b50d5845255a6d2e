"""Edits of the world of a cell by persons, which are inputs of the operations that go on."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import ExitStack

from skillc.cells.submitted import SubmittedOperation
from skillc.services.errors import RequestError
from skillc.services.world_edits import read_edits
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.world_edit import recorded_changes
from skillc_runtime.recording.commands import EditWorld
from skillc_runtime.recording.events import Requested
from skillc_runtime.world.state.labelled import label_change
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.transactions import StoreError


def edit_world(
    world: WorldModel,
    edits: Sequence[str],
    who: str,
    why: str,
    loop: CellLoop,
    operations: Collection[SubmittedOperation],
) -> None:
    """Change the world in one transaction, and record the edit in each operation, so that it can be repeated.

    RequestError if it is refused: nothing changes.
    """
    state, now = world.snapshot(), loop.backend.clock.now
    changes = read_edits(edits, state)
    publishers = [each.publisher for each in operations if not each.run.tree_runs]
    try:
        with ExitStack() as stack:
            for each in publishers:
                stack.enter_context(recorded_changes(world, each, now))
            world.commit(changes, f"{who}: {why}", None)
    except (WorldError, StoreError) as error:
        raise RequestError(str(error)) from error
    labelled = tuple(label_change(each, state.vocabulary) for each in changes)
    for operation in operations:
        operation.publisher(Requested(time=now, command=EditWorld(labelled, why, who=who), tick=loop.ticks))
