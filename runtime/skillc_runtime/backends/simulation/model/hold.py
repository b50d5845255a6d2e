"""How a gripper holds a thing: where all its parts are, so that a model can be built in which they are one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import msgspec
import mujoco
import numpy as np

from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.motion.pose import Pose, quaternion_from_rotation


class Hold(msgspec.Struct, frozen=True):
    """A grasp that does not yield: the gripper's short name, the thing in the palm, and fingers in their parents.

    fingers: by name of the body in the model.
    """

    gripper: str
    in_palm: Pose
    fingers: Mapping[str, Pose]


def read_hold(model: Any, data: Any, gripper: str, thing: str) -> Hold:
    """Return how a gripper holds a thing, both by short name, at the positions of `data`."""
    prefix, palm = part_name(gripper, ""), model.body(part_name(gripper, "palm")).id
    names = {body: model.body(body).name for body in np.flatnonzero(model.body_jntnum).tolist()}
    fingers = {
        name: _relative(data, int(model.body_parentid[body]), body)
        for body, name in names.items()
        if name.startswith(prefix)
    }
    return Hold(gripper, _relative(data, palm, model.body(part_name(thing, "block")).id), fingers)


def add_mount(spec: Any, pose: Pose, hold: Hold | None) -> Any:
    """Add the frame in which a thing is: in the palm that holds it, or else at a pose in the world."""
    parent = spec.worldbody if hold is None else spec.body(part_name(hold.gripper, "palm"))
    place = pose if hold is None else hold.in_palm
    return parent.add_frame(pos=place.position, quat=quaternion_from_rotation(place.rotation))


def fix_fingers(spec: Any, hold: Hold) -> None:
    """Remove the joints of a gripper, and what moves them; the fingers stay where they are."""
    prefix = part_name(hold.gripper, "")
    for each in [each for each in (*spec.actuators, *spec.tendons) if each.name.startswith(prefix)]:
        spec.delete(each)
    for name, place in hold.fingers.items():
        finger = spec.body(name)
        for joint in list(finger.joints):
            spec.delete(joint)
        finger.pos, finger.quat = place.position, quaternion_from_rotation(place.rotation)
        finger.alt.type = mujoco.mjtOrientation.mjORIENTATION_QUAT


def _relative(data: Any, frame: int, body: int) -> Pose:
    """Return the pose of a body in the frame of another."""
    there, here = (Pose(data.xpos[each].copy(), data.xmat[each].reshape(3, 3).copy()) for each in (frame, body))
    return there.inverse() @ here
