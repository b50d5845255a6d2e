"""Whether an arm has a posture in which its hand is at a pose."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from skillc_runtime.control.inverse_kinematics import solve_inverse_kinematics
from skillc_runtime.control.laws.virtual_arm import VirtualArm, load_virtual_model
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.data_sheet import SheetError, sheet_of
from skillc_runtime.world.state.terms import HAS_GRIPPER
from skillc_runtime.world.state.world_state import WorldState

ROUND = 6
"""Decimals to which poses are compared with those that were solved before."""


@dataclass(frozen=True, slots=True, eq=False)
class HandReach:
    """An arm with a gripper: its IRIs, its base in the world, its models, and its home posture (nv,) in rad."""

    arm: str
    gripper: str
    base: Pose
    models: tuple[str, str]
    home: tuple[float, ...]

    def reaches(self, hand: Pose) -> bool:
        """Whether some posture puts the hand at a pose in the world; the same answer in each call."""
        there = self.base.inverse() @ hand
        place = tuple(np.round(there.position, ROUND).tolist())
        turn = tuple(np.round(there.rotation, ROUND).ravel().tolist())
        return _reaches(self.models, self.home, place, turn)


def read_hand_reaches(state: WorldState) -> list[HandReach]:
    """Return all arms that have a gripper, in order of IRI; their models are loaded.

    SheetError or FrameError if their facts are missing, or do not fit the models.
    """
    pairs = sorted((arm, gripper) for arm, gripper in state.pairs(HAS_GRIPPER))
    return [_read(state, arm, gripper) for arm, gripper in pairs]


def _read(state: WorldState, arm: str, gripper: str) -> HandReach:
    sheet = sheet_of(state, arm)
    models = str(sheet.model), str(sheet_of(state, gripper).model)
    home = tuple(sheet.posture("home").tolist())
    _arm_with_hand(models, home)
    return HandReach(arm, gripper, pose(state, arm), models, home)


@lru_cache(maxsize=1000)
def _reaches(
    models: tuple[str, str], home: tuple[float, ...], place: tuple[float, ...], turn: tuple[float, ...]
) -> bool:
    arm, limits = _arm_with_hand(models, home)
    target = Pose(np.array(place), np.array(turn).reshape(3, 3))
    return solve_inverse_kinematics(arm, target, np.array(home), limits) is not None


@lru_cache(maxsize=8)
def _arm_with_hand(models: tuple[str, str], home: tuple[float, ...]) -> tuple[VirtualArm, Array]:
    """Return an arm whose tool is the centre of its empty hand, and the ranges (nv, 2) of its joints in rad.

    SheetError if a model cannot be read, lacks its flange or its tool centre point, or has other joints than `home`.
    """
    # The simulator is slow to import.
    from pathlib import Path

    import mujoco

    try:
        model = load_virtual_model(Path(models[0]))
        hand = mujoco.MjModel.from_xml_path(models[1])
        data = mujoco.MjData(hand)
        mujoco.mj_kinematics(hand, data)
        centre = data.site("tcp")
        arm, q = VirtualArm(model), np.array(home)
        arm.update_kinematics(q)
    except (ValueError, KeyError) as error:
        raise SheetError(f"the models of the data sheets cannot be used: {error}") from error
    arm.mount_tool(q, arm.tool @ Pose(centre.xpos.copy(), centre.xmat.reshape(3, 3).copy()))
    return arm, model.jnt_range.copy()
