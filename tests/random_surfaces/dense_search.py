"""Searches for a way to wipe a surface without the code that is tested: from many postures, along all lanes, in MuJoCo.

Inverse kinematics is damped least squares on MuJoCo's Jacobians, contacts are those of the model that is simulated.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import ceil, cos, pi, radians, sin
from typing import Any

import mujoco
import numpy as np

from random_surfaces.drawing import GRASP_M, TOOL_M, Surface
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Array, log

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
DEEP_M = 0.001


@dataclass(frozen=True, slots=True)
class Frame:
    """Where the tool shall be: position (3,) in m and axes (3, 3) in the world."""

    position: Array
    axes: Array


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
        self.model = model = cell.model
        self.data, self.surface = mujoco.MjData(model), surface
        named = [model.joint(each) for each in range(model.njnt)]
        arm = [each for each in named if each.name.startswith("lab:Arm-1/")]
        self.q_at = np.array([each.qposadr[0] for each in arm])
        self.v_at = np.array([each.dofadr[0] for each in arm])
        self.range = np.array([each.range for each in arm])
        self.torque = np.array([_most_torque(model, each.id) for each in arm])
        self.site = model.site("lab:Hand-1/tcp").id
        self.eraser = int(model.joint("lab:Eraser-1/free").qposadr[0])
        # The hand points down on the middle of the block; the felt is half the height of the block below that.
        self.tool_m = GRASP_M + TOOL_M[2] / 2
        held = radians(surface.held_deg)
        self.held = np.array([[cos(held), -sin(held), 0.0], [sin(held), cos(held), 0.0], [0.0, 0.0, 1.0]])
        self.home = cell.data.qpos[self.q_at].copy()
        self.rng = np.random.default_rng(0)

    def solves(self, starts: int = STARTS) -> Array | None:
        """Return a posture (nv,) in rad above the surface from which all of it can be wiped; None if none is found."""
        if not self._carries_home():
            return None
        path, tried = wiping_path(self.surface), list[Array]()
        low, high = self._start_range()
        for _ in range(starts):
            q = self._descend(self.rng.uniform(low, high), path[0])
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
        model, data = self.model, self.data
        data.qpos[self.q_at] = self.home
        mujoco.mj_kinematics(model, data)
        axes = data.site_xmat[self.site].reshape(3, 3)
        data.qpos[self.eraser : self.eraser + 3] = data.site_xpos[self.site] + GRASP_M * axes[:, 2]
        turned = (axes @ self.held @ np.diag([1.0, -1.0, -1.0])).ravel()
        mujoco.mju_mat2Quat(data.qpos[self.eraser + 3 : self.eraser + 7], turned)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        return not any(self._is_of_eraser(contact) for contact in data.contact[: data.ncon])

    def _is_of_eraser(self, contact: Any) -> bool:
        """Whether a contact is of the eraser with something else than a hand, and deep."""
        bodies = [self.model.body(self.model.geom_bodyid[each]).name for each in contact.geom]
        of_eraser = [each.startswith("lab:Eraser-1/") for each in bodies]
        of_hand = any(each.startswith("lab:Hand-1/") for each in bodies)
        return contact.dist < -DEEP_M and any(of_eraser) and not all(of_eraser) and not of_hand

    def _start_range(self) -> tuple[Array, Array]:
        room = np.minimum(ROOM_RAD, 0.1 * (self.range[:, 1] - self.range[:, 0]))
        return self.range[:, 0] + room, self.range[:, 1] - room

    def _descend(self, q: Array, target: Frame) -> Array | None:
        for _ in range(100):
            error, jacobian = self._error(q, target)
            if np.abs(error).max() < 1e-4:
                return q
            step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-4 * np.eye(6), error)
            q = np.clip(q + step / max(1.0, float(np.abs(step).max()) / 0.3), *self.range.T)
        return None

    def _follows(self, start: Array, path: list[Frame]) -> bool:
        """Whether the arm follows a path from a posture (nv,), its redundant joints pulled back to it as they are."""
        q, flat = start, np.eye(len(start))
        for target in path:
            for _ in range(3):
                error, jacobian = self._error(q, target)
                inverse = jacobian.T @ np.linalg.inv(jacobian @ jacobian.T + 1e-6 * np.eye(6))
                q = q + inverse @ error + 0.05 * (flat - inverse @ jacobian) @ (start - q)
            error, jacobian = self._error(q, target)
            if np.linalg.norm(error[:3]) > FAR_M or np.linalg.norm(error[3:]) > FAR_RAD:
                return False
            if (q < self.range[:, 0]).any() or (q > self.range[:, 1]).any() or self._is_weak(q, jacobian):
                return False
            if not self._is_free(q, fingers=False):
                return False
        return True

    def _error(self, q: Array, target: Frame) -> tuple[Array, Array]:
        """Return the error (6,) of the tool, in m and rad, and its Jacobian (6, nv)."""
        model, data = self.model, self.data
        data.qpos[self.q_at] = q
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        axes = data.site_xmat[self.site].reshape(3, 3)
        at, axes = data.site_xpos[self.site] + self.tool_m * axes[:, 2], axes @ self.held
        full = np.empty((2, 3, model.nv))
        mujoco.mj_jac(model, data, full[0], full[1], at, int(model.site_bodyid[self.site]))
        error = np.concatenate([target.position - at, log(target.axes @ axes.T)])
        return error, full[:, :, self.v_at].reshape(6, -1)

    def _is_weak(self, q: Array, jacobian: Array) -> bool:
        """Whether a motor cannot bear the arm and the force of the tool."""
        data = self.data
        data.qvel[:] = 0.0
        mujoco.mj_forward(self.model, data)
        force = -self.surface.rotation[:, 2] * self.surface.force_n
        torque = data.qfrc_bias[self.v_at] + jacobian[:3].T @ force
        return bool((np.abs(torque) > self.torque).any())

    def _is_free(self, q: Array, fingers: bool) -> bool:
        """Whether at q (nv,) no link, no palm and, if `fingers`, no finger lies in what is around or in another."""
        model, data = self.model, self.data
        data.qpos[self.q_at] = q
        data.qpos[self.eraser : self.eraser + 3] = (0.0, 0.0, -5.0)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        return not any(self._counts(contact, fingers) for contact in data.contact[: data.ncon])

    def _counts(self, contact: Any, fingers: bool) -> bool:
        """Whether a contact is of the arm or its hand, and deep; of fingers it counts only if `fingers`."""
        bodies = [self.model.body(self.model.geom_bodyid[each]).name for each in contact.geom]
        of_fingers = any("finger" in each or "thumb" in each for each in bodies)
        of_robot = any(each.startswith(("lab:Arm-1/", "lab:Hand-1/")) for each in bodies)
        return contact.dist < -DEEP_M and of_robot and (fingers or not of_fingers)


def _most_torque(model: Any, joint: int) -> float:
    for number in range(model.nu):
        if model.actuator_trnid[number, 0] == joint:
            limited = bool(model.actuator_forcelimited[number])
            most = model.actuator_forcerange[number, 1] if limited else model.actuator_ctrlrange[number, 1]
            return float(most) if most > 0 else np.inf
    return np.inf
