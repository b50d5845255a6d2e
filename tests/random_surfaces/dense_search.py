"""Searches for a way to wipe a surface without the code that is tested: from many postures, along all lanes, in MuJoCo.

Inverse kinematics is damped least squares on MuJoCo's Jacobians, contacts are those of the model that is simulated.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import ceil, cos, pi, radians, sin
from typing import Any

import mujoco
import numpy as np

from judged_looks.arm_in_model import ArmInModel, Frame, touching_bodies
from random_surfaces.drawing import GRASP_M, TOOL_M, Surface
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Array

STARTS = 200
"""From how many random postures the arm is brought above the surface."""

STEP_M = 0.02
ABOVE_M = 0.07
OVERHANG_M = (0.024, 0.012)
"""How far the tool reaches beyond the surface at the ends of lanes and beside them, as the manual has it."""

OVERLAP, RADIUS_M = 0.2, 0.015
"""What the skill says of its lanes and of its circle."""

FAR_M, FAR_RAD = 0.003, 0.03
ROOM_RAD = 0.05
"""How far joints are at least from the ends of their ranges at the start: nearer, springs push them back."""


def wiping_path(surface: Surface) -> list[Frame]:
    """Return poses of the tool, STEP_M apart: above the middle, down, along all lanes, and up again.

    Where on its circle the tool is at a point of a lane nobody knows, so it is everywhere on it.
    """
    first = 0 if surface.size[0] >= surface.size[1] else 1
    along, across = np.eye(3)[first], np.eye(3)[1 - first]
    axes = surface.rotation @ np.column_stack([along, np.cross([0, 0, -1], along), [0, 0, -1]])
    long, wide = surface.size[first], surface.size[1 - first]
    half = (
        max(long / 2 - (TOOL_M[0] / 2 - OVERHANG_M[0]), 0),
        max(wide / 2 - (TOOL_M[1] / 2 - OVERHANG_M[1]), 0),
    )
    lanes = ceil(2 * half[1] / (TOOL_M[1] * (1 - OVERLAP)) - 1e-9) + 1
    corners = [np.zeros(3)]
    for number, aside in enumerate(np.linspace(-half[1], half[1], lanes) if lanes > 1 else [0.0]):
        way = half[0] if number % 2 else -half[0]
        corners += [aside * across + way * along, aside * across - way * along]
    above = np.array([0.0, 0.0, ABOVE_M])
    points = [above, *_between([above, corners[0], corners[1]])]
    circle = [RADIUS_M * np.array([cos(turn), sin(turn), 0.0]) for turn in (0.0, pi / 2, pi, 3 * pi / 2)]
    points += [point + offset for point in _between(corners[1:]) for offset in circle]
    points += _between([corners[-1], above])
    return [Frame(surface.rotation @ each + surface.at, axes) for each in points]


def _between(corners: list[Array]) -> Iterator[Array]:
    for one, other in pairwise(corners):
        count = max(1, ceil(float(np.linalg.norm(other - one)) / STEP_M))
        for index in range(1, count + 1):
            yield one + index / count * (other - one)


class DenseSearch:
    """A search in the model of a cell with one arm at home, whose hand is to hold the eraser at its grasping pose."""

    def __init__(self, cell: SimulatedCell, surface: Surface) -> None:
        self.model, self.surface = cell.model, surface
        self.data = data = mujoco.MjData(cell.model)
        held = radians(surface.held_deg)
        self.held = np.array([[cos(held), -sin(held), 0.0], [sin(held), cos(held), 0.0], [0.0, 0.0, 1.0]])
        # The hand points down on the middle of the block; the felt is half the height of the block below that.
        self.arm = ArmInModel(cell.model, data, tool_m=GRASP_M + TOOL_M[2] / 2, turned=self.held)
        self.torque = np.array([_most_torque(cell.model, each.id) for each in self.arm.joints])
        self.eraser = int(cell.model.joint("lab:Eraser-1/free").qposadr[0])
        self.home = cell.data.qpos[self.arm.q_at].copy()
        self.rng = np.random.default_rng(0)

    def solves(self, starts: int = STARTS) -> Array | None:
        """Return a posture (nv,) in rad above the surface from which all of it can be wiped; None if none is found."""
        if not self._is_free(self.home, fingers=True) or not self._carries_home():
            return None
        path, tried = wiping_path(self.surface), list[Array]()
        low, high = self._start_range()
        for _ in range(starts):
            q = self.arm.descend(self.rng.uniform(low, high), path[0])
            if q is None or (q < low).any() or (q > high).any():
                continue
            if any(np.abs(q - each).max() < 0.1 for each in tried):
                continue
            tried.append(q)
            if self._is_free(q, fingers=True) and self._follows(q, path):
                return q
        return None

    def _carries_home(self) -> bool:
        """Whether the arm can hold the eraser at home, where it begins, and whereto it takes it."""
        there = self.arm.place(self.home)
        block = slice(self.eraser, self.eraser + 3)
        self.data.qpos[block] = there.position - TOOL_M[2] / 2 * there.axes[:, 2]
        turned = (there.axes @ np.diag([1.0, -1.0, -1.0])).ravel()
        mujoco.mju_mat2Quat(self.data.qpos[self.eraser + 3 : self.eraser + 7], turned)
        return not any(_is_of_eraser(pair) for pair in touching_bodies(self.model, self.data))

    def _start_range(self) -> tuple[Array, Array]:
        low, high = self.arm.range.T
        room = np.minimum(ROOM_RAD, 0.1 * (high - low))
        return low + room, high - room

    def _follows(self, start: Array, path: list[Frame]) -> bool:
        """Whether the arm follows a path from a posture (nv,), its redundant joints pulled back to it as they are."""
        q, flat, (low, high) = start, np.eye(len(start)), self.arm.range.T
        for target in path:
            for _ in range(3):
                error, jacobian = self.arm.find_error(q, target)
                inverse = jacobian.T @ np.linalg.inv(jacobian @ jacobian.T + 1e-6 * np.eye(6))
                q = q + inverse @ error + 0.05 * (flat - inverse @ jacobian) @ (start - q)
            error, jacobian = self.arm.find_error(q, target)
            if np.linalg.norm(error[:3]) > FAR_M or np.linalg.norm(error[3:]) > FAR_RAD:
                return False
            if (q < low).any() or (q > high).any() or self._is_weak(jacobian):
                return False
            if not self._is_free(q, fingers=False):
                return False
        return True

    def _is_weak(self, jacobian: Array) -> bool:
        """Whether a motor cannot bear the arm as it is and the force of the tool; jacobian (6, nv)."""
        data = self.data
        data.qvel[:] = 0.0
        mujoco.mj_forward(self.model, data)
        force = -self.surface.rotation[:, 2] * self.surface.force_n
        torque = data.qfrc_bias[self.arm.v_at] + jacobian[:3].T @ force
        return bool((np.abs(torque) > self.torque).any())

    def _is_free(self, q: Array, fingers: bool) -> bool:
        """Whether at q (nv,) no link, no palm and, if `fingers`, no finger lies in what is around or in another."""
        self.data.qpos[self.arm.q_at] = q
        self.data.qpos[self.eraser : self.eraser + 3] = (0.0, 0.0, -5.0)
        return not any(_is_of_robot(pair, fingers) for pair in touching_bodies(self.model, self.data))


def _is_of_robot(bodies: tuple[str, str], fingers: bool) -> bool:
    """Whether the arm or its hand is one of two bodies; fingers count only if `fingers`."""
    of_fingers = any("finger" in each or "thumb" in each for each in bodies)
    return any(each.startswith(("lab:Arm-1/", "lab:Hand-1/")) for each in bodies) and (fingers or not of_fingers)


def _is_of_eraser(bodies: tuple[str, str]) -> bool:
    """Whether the eraser is one of two bodies, and the other one not a part of it or of the hand."""
    of_eraser = any(each.startswith("lab:Eraser-1/") for each in bodies)
    return of_eraser and not all(each.startswith(("lab:Eraser-1/", "lab:Hand-1/")) for each in bodies)


def _most_torque(model: Any, joint: int) -> float:
    for number in range(model.nu):
        if model.actuator_trnid[number, 0] == joint:
            limited = bool(model.actuator_forcelimited[number])
            most = model.actuator_forcerange[number, 1] if limited else model.actuator_ctrlrange[number, 1]
            return float(most) if most > 0 else np.inf
    return np.inf
