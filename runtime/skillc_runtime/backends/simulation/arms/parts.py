"""Finds the parts of an arm in the MuJoCo model of a cell."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.names import mount_name, part_name
from skillc_runtime.backends.simulation.scene_spec import ArmSpec
from skillc_runtime.devices.arm import ArmLimits
from skillc_runtime.motion.pose import Pose


def find_live_body(data: Any, body: int) -> Pose:
    """Return the pose of a body in the world; its arrays change with the simulation."""
    return Pose(data.xpos[body], data.xmat[body].reshape(3, 3))


def find_actuator(joint: int, model: Any) -> int:
    """Return the actuator of a joint; `actuator_trnid` of other actuators may be the index of a tendon."""
    on_joints = model.actuator_trntype == mujoco.mjtTrn.mjTRN_JOINT
    return int(np.flatnonzero(on_joints & (model.actuator_trnid[:, 0] == joint))[0])


def find_root(model: Any, body: int, prefix: str) -> int:
    """Return the outermost body of the arm that `body` belongs to."""
    while model.body(model.body_parentid[body]).name.startswith(prefix):
        body = int(model.body_parentid[body])
    return int(body)


def find_mount(model: Any, name: str, base: int) -> int:
    """Return the body that stands where the world model has the base of an arm, whose own body is `base`."""
    mount = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, mount_name(name))
    return base if mount < 0 else int(mount)


def find_tool(model: Any, name: str, gripper: str | None) -> Pose:
    """Return the gripper's tool centre point, or the flange of an arm without gripper, in the last link's frame."""
    flange = find_site(model.site(part_name(name, "flange")))
    return flange if gripper is None else flange @ find_site(model.site(part_name(gripper, "tcp")))


def find_site(site: Any) -> Pose:
    """Return the pose of a site in the frame of its body."""
    return Pose.of(site.pos, site.quat)


def read_limits(model: Any, joints: list[int], actuator: int, facts: ArmSpec) -> ArmLimits:
    """Return the limits of joints; `actuator` is that of the first, and the others follow it."""
    span = slice(actuator, actuator + len(joints))
    force, control = model.actuator_forcerange[span, 1], model.actuator_ctrlrange[span, 1]
    effort = force if facts.has_servos else control
    sheet, count = facts.sheet, len(joints)
    stated = sheet.has("jointAccelerations")
    fastest = sheet.limits("jointAccelerations", count) if stated else np.full(count, np.inf)
    return ArmLimits(model.jnt_range[joints].copy(), sheet.limits("jointSpeeds", count), effort.copy(), fastest)
