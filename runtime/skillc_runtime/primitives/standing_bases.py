"""Where mobile bases stand that stopped on their way."""

from __future__ import annotations

from contextlib import suppress

from skillc_runtime.devices.cell import Cell
from skillc_runtime.world.space.frame_tree import FrameError, Unplaced, frame_tree_of
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import Change, ClearProperty
from skillc_runtime.world.state.terms import BASE_FRAME_ID, MOBILE_ROBOT, ORIENTATION, POSITION
from skillc_runtime.world.state.world_state import WorldState


def place_standing_bases(cell: Cell) -> None:
    """Write the pose of each base at rest that is known to be nowhere, as the base reports it."""
    state = cell.world.snapshot()
    changes: list[Change] = []
    for robot in sorted(state.instances(MOBILE_ROBOT)):
        with suppress(KeyError, FrameError):
            if _is_nowhere(state, robot) and (base := cell.base(robot)).at_rest:
                changes += placement_changes(robot, base.pose)
    if changes:
        cell.world.commit(changes, "the bases report where they stand", "reported")


def leaving_changes(state: WorldState, robot: str) -> list[Change]:
    """Return the changes that take a robot from the pose where it stands: its base drives away; none without one."""
    if BASE_FRAME_ID not in state.stored or state.value(robot, BASE_FRAME_ID) is None:
        return []
    stated = (name for name in (BASE_FRAME_ID, *POSITION, *ORIENTATION) if name in state.stored)
    return [ClearProperty(robot, name) for name in stated if state.value(robot, name) is not None]


def _is_nowhere(state: WorldState, robot: str) -> bool:
    try:
        frame_tree_of(state).carrier(robot)
    except Unplaced:
        return True
    return False
