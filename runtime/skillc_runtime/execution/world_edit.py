"""Changes the world model on request."""

from __future__ import annotations

from skillc_runtime.recording.commands import EditWorld
from skillc_runtime.world.state.labelled_reading import change_of
from skillc_runtime.world.state.model import WorldModel


def edit_world(world: WorldModel, edit: EditWorld) -> None:
    """Make the changes in one transaction; WorldError or StoreError if they are refused, and then none is made."""
    world.commit([change_of(each) for each in edit.changes], f"{edit.who}: {edit.why}", None)
