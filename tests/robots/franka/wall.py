"""A soft wall before the tool of a simulated robot."""

from __future__ import annotations

from typing import Any

import numpy as np

from backends.backend import WALL_N_M, WALL_N_S_M

TOOL_M = 0.1034
"""From the hand to the tool centre point, along its z."""


class Wall:
    """A spring and a damper that push the hand at the tool centre point, as `Wall` of `backends.backend`."""

    def __init__(self, model: Any, data: Any, gap_m: float) -> None:
        self._model, self._data, self.force_n, self._depth = model, data, 0.0, 0.0
        self._hand = next(each for each in range(model.nbody) if model.body(each).name.endswith("hand"))
        self.normal = -data.xmat[self._hand].reshape(3, 3)[:, 2]
        self._place = float(self.normal @ self._find_tool()) - gap_m

    def step(self) -> None:
        """Push, before a step of the simulation."""
        tool = self._find_tool()
        depth = self._place - float(self.normal @ tool)
        damping = WALL_N_S_M * (depth - self._depth) / self._model.opt.timestep
        self.force_n, self._depth = max(0.0, WALL_N_M * depth + damping) if depth > 0 else 0.0, depth
        self._apply(self.force_n * self.normal, tool)

    def remove(self) -> None:
        """Push no more."""
        self._apply(np.zeros(3), self._find_tool())

    def _find_tool(self) -> np.ndarray:
        return self._data.xpos[self._hand] + TOOL_M * self._data.xmat[self._hand].reshape(3, 3)[:, 2]

    def _apply(self, force: np.ndarray, point: np.ndarray) -> None:
        moment = np.cross(point - self._data.xipos[self._hand], force)
        self._data.xfrc_applied[self._hand] = np.concatenate([force, moment])
