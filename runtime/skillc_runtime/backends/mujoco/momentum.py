"""What two models of one scene have in common at the instant at which a thing is grasped or released.

With all free, the speeds are v; with the thing a part of the hand, u. Then v = P u, and M = P^T M_free P is the mass
matrix of the hand with the thing. A grasp keeps the momentum along what it leaves free, M u = P^T M_free v, so the
energy falls by that of the speeds between hand and thing, and never rises. A release keeps all speeds.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.mujoco.model_map import ModelMap
from skillc_runtime.motion.pose import Array


def join(rows: ModelMap, free_model: Any, free: Any, tight_model: Any, tight: Any, blocks: dict[int, int]) -> None:
    """Give the tight model the state of the free one, in which fingers and what they hold stand still from then on.

    `blocks` are the bodies that are held, each with its first degree of freedom in the free model.
    """
    tight.time = free.time
    tight.qpos[:] = free.qpos[rows.coordinates]
    tight.mocap_pos[rows.mocaps], tight.mocap_quat[rows.mocaps] = free.mocap_pos, free.mocap_quat
    tight.eq_active[:] = free.eq_active[rows.equalities]
    mujoco.mj_kinematics(tight_model, tight)
    mujoco.mj_comPos(tight_model, tight)
    ways, mass = _ways(rows, free_model, tight_model, tight, blocks), _mass(free_model, free)
    tight.qvel[:] = np.linalg.solve(ways.T @ mass @ ways, ways.T @ (mass @ free.qvel))
    tight.qacc_warmstart[:] = free.qacc_warmstart[rows.dofs]
    free.qvel[np.setdiff1d(np.arange(free_model.nv), rows.dofs)] = 0.0


def part(rows: ModelMap, free_model: Any, free: Any, tight_model: Any, tight: Any, blocks: dict[int, int]) -> None:
    """Give the free model the state of the tight one."""
    mujoco.mj_kinematics(tight_model, tight)
    mujoco.mj_comPos(tight_model, tight)
    ways = _ways(rows, free_model, tight_model, tight, blocks)
    free.time = tight.time
    free.qpos[rows.coordinates] = tight.qpos
    for block in blocks:
        first, held = int(free_model.jnt_qposadr[free_model.body_jntadr[block]]), rows.bodies[block]
        free.qpos[first : first + 3], free.qpos[first + 3 : first + 7] = tight.xpos[held], tight.xquat[held]
    free.qvel[:], free.qacc_warmstart[:] = ways @ tight.qvel, ways @ tight.qacc_warmstart


def _ways(rows: ModelMap, free_model: Any, tight_model: Any, tight: Any, blocks: dict[int, int]) -> Array:
    """Return P (nv free, nv tight): the speeds with all free that belong to those with things held."""
    ways = np.zeros((free_model.nv, tight_model.nv))
    ways[rows.dofs, np.arange(tight_model.nv)] = 1.0
    for block, first in blocks.items():
        held, moved, turned = int(rows.bodies[block]), np.zeros((3, tight_model.nv)), np.zeros((3, tight_model.nv))
        mujoco.mj_jacBody(tight_model, tight, moved, turned, held)
        ways[first : first + 3], ways[first + 3 : first + 6] = moved, tight.xmat[held].reshape(3, 3).T @ turned
    return ways


def _mass(model: Any, data: Any) -> Array:
    full = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    return full
