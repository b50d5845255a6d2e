"""Writes the URDF of an arm of a MuJoCo model, as a driver publishes it; its frames are not those of the model."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any
from xml.etree import ElementTree

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Pose, rotation_from_quaternion

HALF_TURN = Pose(np.zeros(3), np.diag([-1.0, -1.0, 1.0]))
"""The base of a Universal Robot is turned like that in its URDF."""


def describe(model: Any, prefix: str, in_ros: Mapping[str, str]) -> str:
    """Return a chain of links with the joints of a model whose names begin with a prefix; `in_ros` renames them."""
    robot = ElementTree.Element("robot", name="robot")
    ElementTree.SubElement(robot, "link", name="base_link")
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    joints = [j for j in range(model.njnt) if model.joint(j).name.startswith(prefix)]
    first = int(model.jnt_bodyid[joints[0]])
    above, parent = Pose(data.xpos[model.body_parentid[first]], np.eye(3)) @ HALF_TURN, "base_link"
    for j in joints:
        body = int(model.jnt_bodyid[j])
        quaternion = data.xquat[body]
        here = Pose(data.xanchor[j], rotation_from_quaternion(quaternion))
        name = model.joint(j).name.removeprefix(prefix)
        _add(robot, in_ros.get(name, name), parent, above.inverse() @ here, model.jnt_axis[j])
        above, parent = here, f"{name}_link"
        robot[-1].find("child").set("link", parent)  # type: ignore[union-attr]
        ElementTree.SubElement(robot, "link", name=parent)
    return ElementTree.tostring(robot, "unicode")


def _add(robot: ElementTree.Element, name: str, parent: str, origin: Pose, axis: Any) -> None:
    joint = ElementTree.SubElement(robot, "joint", name=name, type="continuous")
    R = origin.rotation
    roll, pitch, yaw = (
        np.arctan2(R[2, 1], R[2, 2]),
        np.arcsin(np.clip(-R[2, 0], -1, 1)),
        np.arctan2(R[1, 0], R[0, 0]),
    )
    ElementTree.SubElement(joint, "parent", link=parent)
    ElementTree.SubElement(joint, "child")
    ElementTree.SubElement(joint, "origin", xyz=_text(origin.position), rpy=_text([roll, pitch, yaw]))
    ElementTree.SubElement(joint, "axis", xyz=_text(axis))


def _text(values: Any) -> str:
    return " ".join(f"{each:.9f}" for each in values)
