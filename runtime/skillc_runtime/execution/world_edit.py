"""Changes the world model on request."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from skillc_runtime.execution.tree.calls.event_factory import make_change_event
from skillc_runtime.motion.pose import Pose
from skillc_runtime.recording.commands import EditWorld
from skillc_runtime.recording.events import Listener
from skillc_runtime.recording.space_claim import SpaceClaim
from skillc_runtime.world.space.placing.chosen_places import reservation_changes
from skillc_runtime.world.space.stands import stand_changes
from skillc_runtime.world.state.changes import Change
from skillc_runtime.world.state.labels.labelled_reading import change_of
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.world_state import WorldState


def edit_world(world: WorldModel, edit: EditWorld) -> None:
    """Make the changes in one transaction; WorldError or StoreError if they are refused, and then none is made."""
    world.commit([change_of(each) for each in edit.changes], f"{edit.who}: {edit.why}", None)


def write_choices(world: WorldModel, space: SpaceClaim, emit: Listener, now: float) -> WorldState:
    """Write where a plan lets bases and things stand, at the time `now` in s of the cell; return the world after that.

    Of several places of a thing at one place that is the first, which is over once the thing is there.
    """
    state = world.snapshot()
    changes: list[Change] = [
        change for each in space.stands for change in stand_changes(each.place.iri, each.x_m, each.y_m, each.yaw_rad)
    ]
    for each in {(one.thing, one.place): one for one in reversed(space.places)}.values():
        at = Pose.of(each.at.position_m, each.at.quaternion_wxyz)
        changes += reservation_changes(state, each.thing.iri, each.place.iri, each.support.iri, at)
    if not changes:
        return state
    with recorded_changes(world, emit, now):
        world.commit(changes, "the plan lets bases and things stand there")
    return world.snapshot()


@contextmanager
def recorded_changes(world: WorldModel, emit: Listener, now: float) -> Iterator[None]:
    """Emit an event for each change of the world, at the time `now` in s of the cell; a running tree does it itself."""
    stop_listening = world.subscribe(lambda change: emit(make_change_event(change, now)))
    try:
        yield
    finally:
        stop_listening()
