"""Saying in the world model where a thing is."""

from __future__ import annotations

from skillc_runtime.motion.pose import Pose, quaternion_of
from skillc_runtime.world.changes import SetProperty
from skillc_runtime.world.frames import WORLD_FRAME
from skillc_runtime.world.terms import BASE_FRAME_ID, ORIENTATION, POSITION


def placed(thing: str, at: Pose, frame: str = WORLD_FRAME) -> list[SetProperty]:
    """Return the changes that say that a thing, by IRI, is at a pose in a frame, by its FrameId."""
    values = zip((*POSITION, *ORIENTATION), (*at.position, *quaternion_of(at.rotation)), strict=True)
    numbers = [SetProperty(thing, name, float(value)) for name, value in values]
    return [SetProperty(thing, BASE_FRAME_ID, frame), *numbers]
