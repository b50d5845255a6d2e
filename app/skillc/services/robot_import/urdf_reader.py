"""Reads an arm from a URDF: its tree is checked, its kinematics and inertia are what MuJoCo reads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import mujoco
import numpy as np

from skillc.errors import RequestError
from skillc.services.robot_import.arm_reader import ArmReader, Reading, ReadOptions
from skillc.services.robot_import.chain import Chain, choose_chain, cut_to_chain, fixed_to, list_some, other_joints
from skillc.services.robot_import.possible_inertia import correct_inertia
from skillc.services.robot_import.robot_model import WHOLE_TURN, Joint, Shape
from skillc.services.robot_import.urdf_shapes import read_shapes
from skillc.services.robot_import.urdf_tree import UrdfJoint, UrdfTree, numbers, read_tree
from skillc_runtime.motion.pose import Pose, exp, quaternion_from_rotation


def read_urdf(path: Path, robot: ElementTree.Element, options: ReadOptions) -> Reading:
    """Return the arm of a URDF between two links.

    RequestError if there is no such arm, or what it needs is missing.
    """
    tree = read_tree(path, robot)
    spec = _load(tree)
    chain = choose_chain(path, spec, "link", options.base, options.tip)
    moving = [tree.above[body.name] for body in chain.moved]
    for joint in moving:
        _check_motor(path, joint, chain)
    joints = [_joint(path, joint) for joint in moving]
    for body in chain.moved:
        _check_mass(path, body)
    for other in other_joints(spec, chain):
        _move_to_range(other)
    notes = [*cut_to_chain(spec, chain, "0, or as near as their range allows"), *_notes(path, moving)]
    missing: list[str] = []
    arm = ArmReader(path, spec, chain, options, correct_inertia(spec) if options.correct_inertia else {})

    def find_shapes(bodies: Sequence[int]) -> Iterator[tuple[int, Shape]]:
        for body in bodies:
            for shape in read_shapes(path, tree.links[arm.model.body(body).name], missing):
                yield body, shape

    reading = arm.read(joints, find_shapes, None, notes)
    if not missing:
        return reading
    return reading.with_notes(
        f"{len(missing)} mesh(es) cannot be found or read, such as {missing[0]}; a folder of packages may be named "
        "in ROS_PACKAGE_PATH"
    )


def _load(tree: UrdfTree) -> Any:
    """Return the links with their inertia and the joints, without looks, as MuJoCo reads them. RequestError."""
    if "world" in tree.above:
        raise RequestError(f"{tree.path}: a link with a joint above it cannot be called `world`, as the root of all is")
    robot = ElementTree.Element("robot", name="arm")
    own = ElementTree.SubElement(robot, "mujoco")
    ElementTree.SubElement(own, "compiler", fusestatic="false", inertiafromgeom="false")
    for name, link in tree.links.items():
        for inertial in link.findall("inertial"):
            for tag in ("mass", "inertia"):
                part = inertial.find(tag)
                if lost := [each for each in _COUNTS[tag] if part is None or part.get(each) is None]:
                    raise RequestError(
                        f'{tree.path}: the `<inertial>` of link `{name}` has no `<{tag} {lost[0]}="..">`'
                    )
        ElementTree.SubElement(robot, "link", name=name).extend(link.findall("inertial"))
    for joint in tree.above.values():
        copied = ElementTree.SubElement(robot, "joint", name=joint.name, type=joint.kind)
        for tag in ("parent", "child", "origin", "axis"):
            copied.extend(joint.element.findall(tag))
        limit = joint.element.find("limit")
        low, high = (float(numbers(tree.path, limit, name, (0.0,))[0]) for name in ("lower", "upper"))
        if low < high:
            ElementTree.SubElement(copied, "limit", lower=f"{low}", upper=f"{high}")
    for element in robot.iter():
        for name, count in _COUNTS.get(str(element.tag), {}).items():
            numbers(tree.path, element, name, (0.0,) * count)
    try:
        return mujoco.MjSpec.from_string(ElementTree.tostring(robot, "unicode"))
    except ValueError as error:
        raise RequestError(f"{tree.path} cannot be read by MuJoCo: {' '.join(str(error).split())}") from error


_COUNTS = {
    "origin": {"xyz": 3, "rpy": 3},
    "axis": {"xyz": 3},
    "mass": {"value": 1},
    "inertia": dict.fromkeys(("ixx", "iyy", "izz", "ixy", "ixz", "iyz"), 1),
}
"""How many numbers attributes have."""


def _check_motor(path: Path, joint: UrdfJoint, chain: Chain) -> None:
    """Refuse a joint of the arm that has no motor of its own. RequestError."""
    between = f"between `{chain.base}` and `{chain.tip}`"
    if joint.kind in ("floating", "planar"):
        raise RequestError(
            f"{path}: joint `{joint.name}` {between} is {joint.kind}: no motor moves it; start below "
            "it with --base LINK"
        )
    if joint.element.find("mimic") is not None:
        raise RequestError(
            f"{path}: joint `{joint.name}` {between} follows another one (`<mimic>`); every joint of an arm needs its "
            "own motor"
        )


def _check_mass(path: Path, body: Any) -> None:
    if sum(each.mass for each in (body, *fixed_to(body))) <= 0.0:
        raise RequestError(
            f"{path}: link `{body.name}` and what is fixed to it have no mass: write an `<inertial>` with the mass, "
            "its centre and the inertia, from the maker's data or a CAD model"
        )


def _move_to_range(joint: Any) -> None:
    """Move what is on a joint to the end of its range that is nearest to 0, if 0 is not in it."""
    low, high = joint.range
    if low < high and (least := float(np.clip(0.0, low, high))):
        way = least * joint.axis / np.linalg.norm(joint.axis)
        slides = joint.type == mujoco.mjtJoint.mjJNT_SLIDE
        moved = Pose(way, np.eye(3)) if slides else Pose(np.zeros(3), exp(way))
        there = Pose.of(joint.parent.pos, joint.parent.quat) @ moved
        joint.parent.pos, joint.parent.quat = there.position, quaternion_from_rotation(there.rotation)


def _joint(path: Path, joint: UrdfJoint) -> Joint:
    limit = joint.element.find("limit")
    axis = numbers(path, joint.element.find("axis"), "xyz", (1.0, 0.0, 0.0))
    length = float(np.linalg.norm(axis))
    if length < 1e-9:
        raise RequestError(f"{path}: the axis of joint `{joint.name}` has length 0")
    low, high, effort, speed = (
        float(numbers(path, limit, name, (0.0,))[0]) for name in ("lower", "upper", "effort", "velocity")
    )
    if joint.kind == "continuous":
        low, high = -WHOLE_TURN, WHOLE_TURN
    elif low >= high:
        raise RequestError(
            f"{path}: joint `{joint.name}` cannot move: its limits are {low:g} and {high:g}; write "
            '`<limit lower=".." upper=".." ..>`, or the type `continuous` for a joint without end'
        )
    low, high = _within_soft_limits(path, joint, low, high)
    return Joint(joint.name, joint.kind == "prismatic", axis / length, low, high, effort or None, speed or None)


def _within_soft_limits(path: Path, joint: UrdfJoint, low: float, high: float) -> tuple[float, float]:
    """Return the part of a range to which the maker's controller keeps the joint. RequestError if there is none."""
    controller = joint.element.find("safety_controller")
    soft = [
        float(numbers(path, controller, f"soft_{name}_limit", (end,))[0])
        for name, end in (("lower", low), ("upper", high))
    ]
    least, most = max(low, soft[0]), min(high, soft[1])
    if least >= most:
        raise RequestError(
            f"{path}: joint `{joint.name}` cannot move: its soft limits, {soft[0]:g} and {soft[1]:g}, leave "
            f"nothing of its range, {low:g} to {high:g}"
        )
    return least, most


def _notes(path: Path, joints: Sequence[UrdfJoint]) -> Iterator[str]:
    endless = [joint.name for joint in joints if joint.kind == "continuous"]
    if endless:
        yield f"without end: {list_some(endless)}; the range is set to one turn to either side"
    soft = [each.name for each in joints if each.element.find("safety_controller") is not None]
    if soft:
        yield f"soft limits (`<safety_controller>`): {list_some(soft)}; the range is what is within both limits"
    sliding = [joint.name for joint in joints if joint.kind == "prismatic"]
    if sliding:
        yield f"sliding: {list_some(sliding)}; the numbers are in m, m/s and N"
    dynamics = [element for joint in joints if (element := joint.element.find("dynamics")) is not None]
    if any(numbers(path, each, name, (0.0,))[0] > 0 for each in dynamics for name in ("damping", "friction")):
        yield "damping and friction of joints (`<dynamics>`) are not taken over: models of skillc have none"
