"""The kinematics of an arm in a simulated model, by MuJoCo's Jacobians: none of the code that is tested."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.model.contact_bits import CARRIES, PAD
from skillc_runtime.motion.pose import Array, log

DEEP_M = 0.001
"""How deep bodies overlap where they touch by more than is left by resting on each other; a hand rests on nothing."""


@dataclass(frozen=True, slots=True)
class Frame:
    """Where a tool shall be: position (3,) in m and axes (3, 3) in the world."""

    position: Array
    axes: Array


class ArmInModel:
    """An arm of a model, with its hand, whose tool is `tool_m` before its tool centre point, turned by axes (3, 3)."""

    def __init__(
        self, model: Any, data: Any, number: int = 1, tool_m: float = 0.0, turned: Array | None = None
    ) -> None:
        self.model, self.data = model, data
        self.name, self.hand = f"lab:Arm-{number}/", f"lab:Hand-{number}/"
        named = [model.joint(each) for each in range(model.njnt)]
        self.joints = [each for each in named if each.name.startswith(self.name)]
        self.q_at = np.array([each.qposadr[0] for each in self.joints])
        self.v_at = np.array([each.dofadr[0] for each in self.joints])
        self.fingers = np.array([each.qposadr[0] for each in named if each.name.startswith(self.hand)])
        self.range = np.array([each.range for each in self.joints])
        self.site = model.site(f"{self.hand}tcp").id
        self._tool_m, self._turned = tool_m, np.eye(3) if turned is None else turned

    def place(self, q: Array) -> Frame:
        """Return where the tool is at q (nv,) in rad."""
        self.data.qpos[self.q_at] = q
        mujoco.mj_kinematics(self.model, self.data)
        axes = self.data.site_xmat[self.site].reshape(3, 3)
        return Frame(self.data.site_xpos[self.site] + self._tool_m * axes[:, 2], axes @ self._turned)

    def find_error(self, q: Array, target: Frame) -> tuple[Array, Array]:
        """Return the error (6,) of the tool at q (nv,) in rad, in m and rad, and its Jacobian (6, nv)."""
        there = self.place(q)
        mujoco.mj_comPos(self.model, self.data)
        full = np.empty((2, 3, self.model.nv))
        mujoco.mj_jac(self.model, self.data, full[0], full[1], there.position, int(self.model.site_bodyid[self.site]))
        error = np.concatenate([target.position - there.position, log(target.axes @ there.axes.T)])
        return error, full[:, :, self.v_at].reshape(6, -1)

    def descend(self, q: Array, target: Frame, steps: int = 100) -> Array | None:
        """Return a posture (nv,) in rad with the tool at a target, found from q (nv,); None if none is found."""
        for _ in range(steps):
            error, jacobian = self.find_error(q, target)
            if np.abs(error).max() < 1e-4:
                return q
            step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-4 * np.eye(6), error)
            q = np.clip(q + step / max(1.0, float(np.abs(step).max()) / 0.3), *self.range.T)
        return None


def copy_with_solid_pads(model: Any) -> Any:
    """Return a copy of a model in which the pads of fingers touch what is fixed, too, not parts alone."""
    solid = copy(model)
    solid.geom_conaffinity[model.geom_contype == PAD] |= CARRIES
    return solid


def touching_bodies(model: Any, data: Any) -> list[tuple[str, str]]:
    """Return the names of the bodies that overlap as they are placed in `data`."""
    mujoco.mj_kinematics(model, data)
    mujoco.mj_collision(model, data)
    found = list[tuple[str, str]]()
    for each in data.contact[: data.ncon]:
        one, other = (model.body(model.geom_bodyid[geom]).name for geom in each.geom)
        may_rest = not any(body.startswith("lab:Hand-") for body in (one, other))
        if each.dist < (-DEEP_M if may_rest else 0.0):
            found.append((one, other))
    return found
