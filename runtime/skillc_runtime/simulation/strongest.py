"""The greatest force that a tool felt: of all its contacts together, fingers aside, as a vector."""

from __future__ import annotations

from math import sqrt
from typing import Any

import mujoco
import numpy as np

from skillc_runtime.motion.pose import Array
from skillc_runtime.simulation.names import part

GREATEST_FRICTION = 1.0
"""No surface here is rougher; so no contact force is longer than sqrt(2) of its normal part."""

TOUCHES_SURFACES = 2
"""The contact bit of geoms that meet surfaces and furniture, not fingers."""


class StrongestForce:
    """The greatest length so far of the sum of contact forces on one tool, N."""

    def __init__(self, tool: str, model: Any, data: Any) -> None:
        """Look at a tool of that name in the model."""
        geoms = (g for g in range(model.ngeom) if model.geom(g).name.startswith(part(tool, "")))
        self._geoms = frozenset(g for g in geoms if model.geom_contype[g] & TOUCHES_SURFACES)
        self._model, self._data = model, data
        self._pair = np.zeros(6)
        self.newton = 0.0

    def sample(self, normal_n: float) -> None:
        """Take in one step, of which the sum of all normal forces in N is known: mostly too small to look closer."""
        if normal_n * sqrt(1 + GREATEST_FRICTION**2) > self.newton:
            self.newton = max(self.newton, float(np.linalg.norm(self._sum())))

    def _sum(self) -> Array:
        """Return the force (3,) of all contacts on the tool, in the world."""
        total = np.zeros(3)
        for i, contact in enumerate(self._data.contact):
            on_first = contact.geom1 in self._geoms
            if on_first == (contact.geom2 in self._geoms):
                continue
            mujoco.mj_contactForce(self._model, self._data, i, self._pair)
            total += (-1 if on_first else 1) * (contact.frame.reshape(3, 3).T @ self._pair[:3])
        return total
