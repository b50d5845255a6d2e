"""What counts as held between the fingers of a real gripper, and what that means for its arm."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from skillc_runtime.backends.simulation.scene_spec import SceneSpec
from skillc_runtime.devices.arm import ArmLoad
from skillc_runtime.devices.gripper import CLOSED_FURTHER_M
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.working_face import working_face
from skillc_runtime.world.space.bodies import RigidBody


class Grasp:
    """The object that counts as held by one gripper: the fingers cannot tell which it is, so they are told."""

    def __init__(self, scene: SceneSpec, tell_arm: Callable[[ArmLoad | None], None]) -> None:
        """Hold nothing; `tell_arm` is called with what the hand holds from then on."""
        self._things = {each.individual: each for each in scene.graspable}
        self._names, self._tell_arm = scene.names, tell_arm
        self._thing: str | None = None
        self._held_at_m = 0.0

    def attach(self, thing: str, in_tool_centre: Pose, mass_kg: float, opening_m: float) -> None:
        """Count an object between fingers that are so far apart as held; RuntimeError if the scene has no body of it.

        Its frame is at `in_tool_centre` in the frame of the gripper's tool centre point.
        """
        if (body := self._things.get(thing)) is None:
            raise RuntimeError(
                f"{self._names.get(thing, thing)} cannot be held: it has no body. A thing to handle needs a pose and "
                "skiros:SizeX, SizeY and SizeZ in the scene"
            )
        centre = body.centre if isinstance(body, RigidBody) else np.zeros(3)
        self._tell_arm(ArmLoad(mass_kg, centre, in_tool_centre, in_tool_centre @ working_face(body.size)))
        self._thing, self._held_at_m = thing, opening_m

    def detach(self) -> None:
        """Count nothing as held."""
        if self._thing is not None:
            self._thing = None
            self._tell_arm(None)

    def holding(self, opening_m: float) -> str | None:
        """Return what counts as held by fingers that are so far apart; None once they have closed further."""
        closed = opening_m < self._held_at_m - min(CLOSED_FURTHER_M, self._held_at_m / 2)
        return None if closed else self._thing
