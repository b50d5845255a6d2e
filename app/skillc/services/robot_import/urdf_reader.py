"""Reads an arm from a URDF: its tree is checked, its kinematics and inertia are what pinocchio reads."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from skillc.errors import RequestError
from skillc.services.robot_import.chain import Chain, choose_chain
from skillc.services.robot_import.comparison import compare
from skillc.services.robot_import.mechanism import PinocchioMechanism
from skillc.services.robot_import.possible_inertia import is_possible, nearest_possible
from skillc.services.robot_import.reading import Reading, ReadOptions
from skillc.services.robot_import.robot_model import Base, Inertia, Joint, RobotLink, RobotModel, Shape
from skillc.services.robot_import.urdf_shapes import read_shapes, stand_in
from skillc.services.robot_import.urdf_text import JOINT, LINK, arm_text
from skillc.services.robot_import.urdf_tree import UrdfJoint, UrdfTree, numbers, read_tree
from skillc_runtime.motion.pose import Array, Pose

WHOLE_TURN = 2 * np.pi
"""The range to either side of a joint without end, in rad."""


def read_urdf(path: Path, robot: ElementTree.Element, options: ReadOptions) -> Reading:
    """Return the arm of a URDF between two links.

    RequestError if there is no such arm, or what it needs is missing.
    """
    tree = read_tree(path, robot)
    chain = choose_chain(tree, options.base, options.tip)
    notes = list(_notes(tree, chain))
    joints = [_joint(tree, joint) for joint in chain.joints]
    pin = _Arm(tree, chain)
    stated = pin.model.copy()
    corrected = pin.correct_inertia() if options.correct_inertia else []
    missing: list[str] = []
    shapes = {link: read_shapes(path, tree.links[link], pin.place(link), missing) for link in pin.links}
    names = [joint.child for joint in chain.joints]
    links = tuple(
        pin.link(index, child, joint, shapes) for index, (child, joint) in enumerate(zip(names, joints, strict=True), 1)
    )
    whole = tuple(_with_stand_ins(links, notes))
    if missing:
        notes.append(
            f"{len(missing)} mesh(es) cannot be found or read, such as {missing[0]}; a folder of packages may be named "
            "in ROS_PACKAGE_PATH"
        )
    at = pin.place(chain.tip)
    flange = Pose(at.position, at.rotation @ options.turn)
    own_base = Base(chain.base, pin.shapes_of(0, shapes))
    model = RobotModel(own_base, whole, flange, chain.tip)
    source = PinocchioMechanism(pin.model, flange)
    if corrected:
        share = compare(model, PinocchioMechanism(stated, flange), source).mass_matrix
        notes.append(
            f"no body has the moments of inertia of {_some(corrected)}: the smaller ones are raised, which changes the "
            f"mass matrix by at most {100 * share:.2g} %"
        )
    return Reading(model, source, "pinocchio", tuple(notes))


class _Arm:
    """The arm in pinocchio; joints that are not in the chain are locked."""

    def __init__(self, tree: UrdfTree, chain: Chain) -> None:
        import pinocchio

        try:
            full = pinocchio.buildModelFromXML(arm_text(tree, chain))
        except (ValueError, RuntimeError) as error:
            raise RequestError(f"{tree.path} cannot be read by pinocchio: {error}") from error
        own = {JOINT + joint.name for joint in chain.joints}
        others = [number for number, name in enumerate(full.names) if number and name not in own]
        self.tree = tree
        self.model: Any = pinocchio.buildReducedModel(full, others, _rest(pinocchio, full))
        bodies = [each for each in self.model.frames if each.type == pinocchio.FrameType.BODY]
        self._frames = {each.name.removeprefix(LINK): each for each in bodies if each.name.startswith(LINK)}
        self.links = tuple(self._frames)

    def place(self, link: str) -> Pose:
        """Return the frame of a link in that of the link of the chain which it is fixed to."""
        return _pose(self._frames[link].placement)

    def inertia(self, index: int) -> Inertia | None:
        """Return the inertia of a link with all that is fixed to it; None without a mass."""
        found = self.model.inertias[index]
        if found.mass <= 0.0:
            return None
        return Inertia(float(found.mass), np.array(found.lever), np.array(found.inertia))

    def correct_inertia(self) -> list[str]:
        """Raise the moments of inertia that no body can have, and return the names of the joints that move them."""
        import pinocchio

        found = []
        for index in range(1, self.model.njoints):
            stated = self.model.inertias[index]
            if stated.mass > 0.0 and not is_possible(stated.inertia):
                mended = nearest_possible(stated.inertia)
                self.model.inertias[index] = pinocchio.Inertia(stated.mass, stated.lever, mended)
                found.append(f"what {self.model.names[index].removeprefix(JOINT)} moves")
        return found

    def shapes_of(self, index: int, shapes: dict[str, tuple[Shape, ...]]) -> tuple[Shape, ...]:
        """Return the shapes of all links that are fixed to a link of the chain, or to the base (0)."""
        return tuple(each for link in self.links if self._frames[link].parentJoint == index for each in shapes[link])

    def link(self, index: int, name: str, joint: Joint, shapes: dict[str, tuple[Shape, ...]]) -> RobotLink:
        """Return the link `name` that a joint moves. RequestError without inertia."""
        inertia = self.inertia(index)
        if inertia is None:
            raise RequestError(
                f"{self.tree.path}: link `{name}` and what is fixed to it have no mass: write an `<inertial>` "
                "with the mass, its centre and the inertia, from the maker's data or a CAD model"
            )
        placement = _pose(self.model.jointPlacements[index])
        return RobotLink(name, placement, joint, inertia, self.shapes_of(index, shapes))


def _rest(pin: Any, model: Any) -> Array:
    """Return the configuration in which joints are locked: 0, or the end of their range that is nearest."""
    q = pin.neutral(model)
    for number in range(1, model.njoints):
        joint = model.joints[number]
        if joint.nq == 1:
            low, high = model.lowerPositionLimit[joint.idx_q], model.upperPositionLimit[joint.idx_q]
            q[joint.idx_q] = np.clip(0.0, low, high)
    return np.asarray(q)


def _pose(placement: Any) -> Pose:
    return Pose(np.array(placement.translation), np.array(placement.rotation))


def _joint(tree: UrdfTree, joint: UrdfJoint) -> Joint:
    path, limit = tree.path, joint.element.find("limit")
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
    low, high = _within_soft_limits(tree, joint, low, high)
    return Joint(joint.name, joint.kind == "prismatic", axis / length, low, high, effort or None, speed or None)


def _within_soft_limits(tree: UrdfTree, joint: UrdfJoint, low: float, high: float) -> tuple[float, float]:
    """Return the part of a range to which the maker's controller keeps the joint. RequestError if there is none."""
    controller = joint.element.find("safety_controller")
    soft = [
        float(numbers(tree.path, controller, f"soft_{name}_limit", (end,))[0])
        for name, end in (("lower", low), ("upper", high))
    ]
    least, most = max(low, soft[0]), min(high, soft[1])
    if least >= most:
        raise RequestError(
            f"{tree.path}: joint `{joint.name}` cannot move: its soft limits, {soft[0]:g} and {soft[1]:g}, leave "
            f"nothing of its range, {low:g} to {high:g}"
        )
    return least, most


def _with_stand_ins(links: tuple[RobotLink, ...], notes: list[str]) -> Iterator[RobotLink]:
    """Yield the links, those without a shape with a capsule that leads to the next joint."""
    bare = []
    for link, following in zip(links, (*links[1:], None), strict=True):
        shapes = link.shapes
        if not shapes:
            bare.append(f"`{link.name}`")
            shapes = stand_in(following.placement.position) if following else ()
        yield RobotLink(link.name, link.placement, link.joint, link.inertia, shapes)
    if bare:
        notes.append(f"{_some(bare)}: no shape in the file that can be read; a capsule to the next joint is taken")


def _notes(tree: UrdfTree, chain: Chain) -> Iterator[str]:
    beyond, own = list(tree.below(chain.tip)), {joint.name for joint in chain.joints}
    if beyond:
        yield f"what is beyond `{chain.tip}` is left out ({_some(beyond)}); the scene mounts a gripper there"
    locked = [
        joint.name
        for link in tree.below(chain.base)
        if link not in beyond and (joint := tree.above[link]).moves and joint.name not in own
    ]
    if locked:
        yield f"{_some(locked)} do not belong to the chain: they are fixed at 0, or as near as their range allows"
    endless = [joint.name for joint in chain.joints if joint.kind == "continuous"]
    if endless:
        yield f"without end: {_some(endless)}; the range is set to one turn to either side"
    soft = [each.name for each in chain.joints if each.element.find("safety_controller") is not None]
    if soft:
        yield f"soft limits (`<safety_controller>`): {_some(soft)}; the range is what is within both limits"
    sliding = [joint.name for joint in chain.joints if joint.kind == "prismatic"]
    if sliding:
        yield f"sliding: {_some(sliding)}; the numbers are in m, m/s and N"
    rubbed = [joint.name for joint in chain.joints if _has_friction(tree, joint)]
    if rubbed:
        yield "damping and friction of joints (`<dynamics>`) are not taken over: models of skillc have none"


def _has_friction(tree: UrdfTree, joint: UrdfJoint) -> bool:
    element = joint.element.find("dynamics")
    return any(numbers(tree.path, element, name, (0.0,))[0] > 0 for name in ("damping", "friction"))


def _some(names: list[str]) -> str:
    return ", ".join(names[:4]) + (f" and {len(names) - 4} more" if len(names) > 4 else "")
