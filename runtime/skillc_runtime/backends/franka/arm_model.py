"""The arm of the facts beside the robot itself: what the robot says of its flange, its hand and its weight must fit."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Final

import mujoco
import numpy as np

from skillc_runtime.backends.control_process.link import PointMass
from skillc_runtime.motion.pose import Array, Pose, log

FLANGE_TURN: Final = np.array([[np.sqrt(0.5), np.sqrt(0.5), 0.0], [-np.sqrt(0.5), np.sqrt(0.5), 0.0], [0.0, 0.0, 1.0]])
"""The axes of the model's flange, which is turned like the hand on it, on the robot's flange: -45 deg about z."""

FAR_M, TURNED_RAD = 0.005, 0.02
"""A flange of the model that is farther from the robot's own is that of another arm."""

HAND_KG = 0.1
"""A hand whose mass differs by more from what is set in Desk is another one."""


class ArmModel:
    """The kinematics and the weight of an arm by the model of its sheet; `gravity` (3,) in m/s^2, in its base."""

    def __init__(self, file: Path, gravity: Array) -> None:
        model: Any = mujoco.MjModel.from_xml_path(str(file))
        model.opt.gravity[:] = gravity
        self._model, self._data, self._lift = model, mujoco.MjData(model), np.zeros((3, model.nv))

    def find_other_arm(self, state: Any) -> str | None:
        """Return how the flange of the model differs from that of a robot's state; None if it does not.

        Joints in another order, with other zeros or in other units would do the same.
        """
        flange, tool, on_flange = self._flange_at(np.array(state.q)), _pose(state.O_T_EE), _pose(state.F_T_EE)
        own = tool @ on_flange.inverse()
        away = float(np.linalg.norm(flange.position - own.position))
        turned = float(np.linalg.norm(log((own.rotation @ FLANGE_TURN).T @ flange.rotation)))
        if away < FAR_M and turned < TURNED_RAD:
            return None
        return (
            f"by its own account its flange is {1e3 * away:.0f} mm and {np.degrees(turned):.0f} deg away from where "
            "the model has it: the data sheet of the arm is that of another one"
        )

    def find_other_weight(self, state: Any, carried: tuple[PointMass, ...], most_n_m: float) -> str | None:
        """Return on which joint of an arm at rest there is more torque than its weight explains, and what it carries.

        None if on none there is more than `most_n_m`.
        """
        left = np.array(state.tau_J) - self._weigh(np.array(state.q), carried)
        joint = int(np.abs(left).argmax())
        if abs(left[joint]) < most_n_m:
            return None
        kg = sum(each.mass_kg for each in carried)
        return (
            f"there are {left[joint]:.1f} N m on joint {joint + 1} that the weight of the arm and of the {kg:.2f} kg "
            "that it carries by the facts does not explain: something touches it, its load or tool is another one, "
            "or its base is not as upright as the scene says"
        )

    def _flange_at(self, q: Array) -> Pose:
        self._data.qpos[:] = q
        mujoco.mj_kinematics(self._model, self._data)
        flange = self._data.site("flange")
        return Pose(flange.xpos.copy(), flange.xmat.reshape(3, 3).copy())

    def _weigh(self, q: Array, carried: tuple[PointMass, ...]) -> Array:
        """Return the torques (nv,) in N m that hold an arm and what its flange carries, at joints q (nv,) in rad."""
        flange, model, data = self._flange_at(q), self._model, self._data
        body = int(model.site("flange").bodyid[0])
        data.qvel[:] = 0.0
        mujoco.mj_comPos(model, data)
        mujoco.mj_rne(model, data, 0, data.qfrc_bias)
        torques: Array = data.qfrc_bias.copy()
        for each in carried:
            mujoco.mj_jac(model, data, self._lift, None, flange.apply(each.centre), body)
            torques -= each.mass_kg * self._lift.T @ model.opt.gravity
        return torques


def find_other_hand(state: Any, hand_kg: float) -> str | None:
    """Return how the hand that is set in Desk differs from one of that mass; None if it does not."""
    if abs(state.m_ee - hand_kg) < HAND_KG:
        return None
    return (
        f"its end effector in Desk has {state.m_ee:.2f} kg, the hand of the facts {hand_kg:.2f} kg: set the end "
        "effector, or correct the hand in the scene"
    )


def _pose(columns: Any) -> Pose:
    """Return the pose of a matrix (16,) by columns."""
    matrix = np.reshape(columns, (4, 4)).T
    return Pose(matrix[:3, 3].copy(), matrix[:3, :3].copy())
