"""Edits of the world of a cell by persons, which are inputs of the operations that go on."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import ExitStack
from typing import assert_never

import numpy as np

from skillc.cells.operations.submitted import SubmittedOperation
from skillc.contract.messages import Edit, Place
from skillc.contract.sample import PoseNumbers
from skillc.errors import RequestError
from skillc.services.scene.world_edits import read_edits
from skillc_runtime.execution.cell_loop import CellLoop
from skillc_runtime.execution.world_edit import recorded_changes
from skillc_runtime.motion.pose import Pose, rotation_from_quaternion
from skillc_runtime.recording.commands import EditWorld
from skillc_runtime.recording.events import Requested
from skillc_runtime.world.space.frame_tree import FrameError
from skillc_runtime.world.space.frames import place_changes
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.labels.labelling import label_change
from skillc_runtime.world.state.model import WorldError, WorldModel
from skillc_runtime.world.state.names import NoSuchName, resolve_individual
from skillc_runtime.world.state.transactions import StoreError
from skillc_runtime.world.state.world_state import WorldState

LEAST_LENGTH = 1e-6
"""Quaternions that are shorter say nothing about a direction."""


def edit_world(
    world: WorldModel,
    wanted: Edit | Place,
    loop: CellLoop,
    operations: Collection[SubmittedOperation],
) -> None:
    """Change the world in one transaction, and record the edit in each operation, so that it can be repeated.

    RequestError if it is refused: nothing changes.
    """
    state, now = world.snapshot(), loop.backend.clock.now
    changes = _read_changes(wanted, state)
    publishers = [each.publisher for each in operations if not each.run.tree_runs]
    try:
        with ExitStack() as stack:
            for each in publishers:
                stack.enter_context(recorded_changes(world, each, now))
            world.commit(changes, f"{wanted.who}: {wanted.why}", None)
    except (WorldError, StoreError) as error:
        raise RequestError(str(error)) from error
    labelled = tuple(label_change(each, state.vocabulary) for each in changes)
    for operation in operations:
        operation.publisher(
            Requested(time=now, command=EditWorld(labelled, wanted.why, who=wanted.who), tick=loop.ticks)
        )


def _read_changes(wanted: Edit | Place, state: WorldState) -> Sequence[Change]:
    match wanted:
        case Edit(edits=edits):
            return read_edits(edits, state)
        case Place(thing=thing, pose=pose):
            return _place(thing, pose, state)
        case _:
            assert_never(wanted)


def _place(thing: str, at: PoseNumbers, state: WorldState) -> Sequence[Change]:
    """Return the changes that say where a thing is in the world; RequestError if there is no such place or thing."""
    position, quaternion = np.array(at[:3]), np.array(at[3:])
    length = float(np.linalg.norm(quaternion))
    if not np.isfinite(at).all() or not np.isfinite(length) or length < LEAST_LENGTH:
        raise RequestError("a pose is a position in m and a quaternion (w, x, y, z) whose length is not 0")
    try:
        individual = resolve_individual(thing, state)
        return place_changes(state, individual, Pose(position, rotation_from_quaternion(quaternion / length)))
    except (NoSuchName, FrameError) as error:
        raise RequestError(str(error)) from error
