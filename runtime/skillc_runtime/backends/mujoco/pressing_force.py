"""The force with which some bodies of a simulation press on all others, from the contacts of a step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array


def pressing_force(model: Any, data: Any, roots: Sequence[int]) -> Array:
    """Return the force (3,) in N, world axes, with which bodies and what is fixed below them press on the rest.

    roots: ids of the bodies. A person who leads a hand touches nothing in the simulation, and does not count.
    """
    inside = np.zeros(model.nbody, dtype=bool)
    inside[list(roots)] = True
    for body in range(1, model.nbody):  # parents stand before their children
        inside[body] |= inside[model.body_parentid[body]]
    total, wrench = np.zeros(3), np.zeros(6)
    touching = inside[model.geom_bodyid[data.contact.geom]] if data.ncon else np.zeros((0, 2), dtype=bool)
    for contact in np.flatnonzero(touching[:, 0] != touching[:, 1]):
        mujoco.mj_contactForce(model, data, int(contact), wrench)
        force = data.contact.frame[contact].reshape(3, 3).T @ wrench[:3]  # of the first body on the second
        total += force if touching[contact, 0] else -force
    return np.asarray(total)
