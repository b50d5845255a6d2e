"""Compares the robot that ROS describes (a URDF, as `robot_description` has it) with the model of an arm.

Joints turn about lines. Base and flange may have other frames in the URDF, so the lines are compared up to one rigid
motion, with the joints where they are measured: the one that brings most lines of the model onto those of the URDF.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any
from xml.etree import ElementTree

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array

NEAR_M, NEAR_SHARE = 0.02, 0.05
"""How far a line may be off, and the sine of its angle: drivers describe robots as they were calibrated."""
OTHER_AXIS = "turns about another axis than in the model"
COMPILER = {
    "fusestatic": "false",
    "discardvisual": "true",
    "boundmass": "0.001",
    "boundinertia": "0.000001",
    "balanceinertia": "true",
}
"""Links of a URDF may have no mass, and shapes are not needed."""


@dataclass(frozen=True, slots=True)
class JointAxes:
    """The lines about which the joints turn: a point of each (n, 3) in m, and its unit vector (n, 3)."""

    points: Array
    directions: Array


def find_difference(urdf: str, names: Sequence[str], model: str, q: Array) -> str | None:
    """Return which joints turn otherwise in a URDF than in the model of a file; None if none does.

    names: of the joints in ROS, in the order of the model. q: their positions (n,) in rad.
    """
    try:
        theirs = _find_joint_axes(_load(urdf), names, q)
    except (ElementTree.ParseError, ValueError) as error:
        return f"the URDF cannot be read: {error}"
    if isinstance(theirs, str):
        return theirs
    loaded: Any = mujoco.MjModel.from_xml_path(model)
    ours = _find_joint_axes(loaded, [loaded.joint(j).name for j in range(loaded.njnt)], q)
    assert isinstance(ours, JointAxes), "a model has its own joints"
    fits = max((_compare(ours, theirs, turn) for turn in _find_turns(ours, theirs)), key=_count, default=None)
    if fits is None:
        return None if _are_parallel(ours) and _are_parallel(theirs) else "its joints turn about other axes"
    if not any(fits):
        return None
    return "; ".join(f"{name} {how}" for name, how in zip(names, fits, strict=True) if how)


def _load(urdf: str) -> Any:
    robot = ElementTree.fromstring(urdf)
    for link in robot.iter("link"):
        for part in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(part)
    for old in robot.findall("mujoco"):
        robot.remove(old)
    ElementTree.SubElement(ElementTree.SubElement(robot, "mujoco"), "compiler", COMPILER)
    return mujoco.MjModel.from_xml_string(ElementTree.tostring(robot, "unicode"))


def _find_joint_axes(model: Any, names: Sequence[str], q: Array) -> JointAxes | str:
    """Return the lines of some joints; or which of them the model lacks."""
    there = {model.joint(j).name: j for j in range(model.njnt)}
    if lacking := [name for name in names if name not in there]:
        return f"the robot has no joint {', '.join(lacking)}"
    numbers, data = [there[name] for name in names], mujoco.MjData(model)
    data.qpos[model.jnt_qposadr[numbers]] = q
    mujoco.mj_kinematics(model, data)
    return JointAxes(data.xanchor[numbers].copy(), data.xaxis[numbers].copy())


def _find_turns(ours: JointAxes, theirs: JointAxes) -> Iterator[Array]:
    """Yield the rotations (3, 3) that bring two lines of ours onto theirs, for each two that are not parallel."""
    for pair in combinations(range(len(ours.points)), 2):
        axes = [_find_axes(*lines.directions[list(pair)]) for lines in (ours, theirs)]
        if axes[0] is not None and axes[1] is not None:
            yield axes[1] @ axes[0].T


def _are_parallel(axes: JointAxes) -> bool:
    return int(np.linalg.matrix_rank(axes.directions, NEAR_SHARE)) < 2


def _find_axes(first: Array, second: Array) -> Array | None:
    """Return right-handed axes (3, 3) of two unit vectors; None if these are parallel."""
    normal = np.cross(first, second)
    length = np.linalg.norm(normal)
    if length < NEAR_SHARE:
        return None
    normal /= length
    return np.column_stack([first, normal, np.cross(first, normal)])


def _compare(ours: JointAxes, theirs: JointAxes, turn: Array) -> list[str]:
    """Return for each joint how it differs, with a rotation of the model; empty texts for those that do not."""
    directions, points = ours.directions @ turn.T, ours.points @ turn.T
    aligned = np.linalg.norm(np.cross(directions, theirs.directions), axis=1) < NEAR_SHARE
    if not aligned.any():
        return [OTHER_AXIS] * len(points)
    across = np.eye(3) - theirs.directions[:, :, None] * theirs.directions[:, None, :]
    gaps = theirs.points - points
    rows = np.concatenate(across[aligned])
    shift = np.linalg.lstsq(rows, np.concatenate([a @ g for a, g in zip(across[aligned], gaps[aligned], strict=True)]))
    away_m = [float(np.linalg.norm(a @ (g - shift[0]))) for a, g in zip(across, gaps, strict=True)]
    same_way = np.einsum("ij,ij->i", directions, theirs.directions) > 0
    return [_describe(*each) for each in zip(aligned, away_m, same_way, strict=True)]


def _describe(is_aligned: bool, away_m: float, is_same_way: bool) -> str:
    """Return how one joint differs; empty if it does not."""
    if not is_aligned:
        return OTHER_AXIS
    if away_m > NEAR_M:
        return f"turns about a line that is {1e3 * away_m:.0f} mm from that of the model"
    return "" if is_same_way else "turns opposite to the model"


def _count(fits: list[str]) -> int:
    return fits.count("")
