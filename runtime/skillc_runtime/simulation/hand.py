"""What is fixed to an arm's last link, seen from the arm's base: two products for all of it, whatever it is."""

from __future__ import annotations

import numpy as np

from skillc_runtime.motion.pose import Array, Pose


class Hand:
    """Tool centre point, wrist axes and payload of an arm; all arrays are reused.

    tool: the tool centre point; wrist_axes (3, 3): one axis a row; lever (3,): from the tool centre point to the
    payload's centre of mass; all in the arm's base frame, as of the last call of `see_from`.
    """

    def __init__(self) -> None:
        self._on_link, self._in_world, self._in_base = (np.zeros((8, 3)) for _ in range(3))
        self._point, self._way = np.zeros(3), self._in_world[6]
        self.tool = Pose(self._in_base[6], self._in_base[:3].T)
        self.wrist_axes, self.lever = self._in_base[3:6], self._in_base[7]

    def hold(self, tool: Pose, wrist: Array, payload: Array) -> None:
        """Take the tool centre point, the wrist's axes (3, 3) and the payload's centre (3,), in the link's frame."""
        self._on_link[:3], self._on_link[3:6] = tool.rotation.T, wrist.T
        self._on_link[6], self._on_link[7] = tool.position, payload - tool.position

    def place(self, position: Array, rotation: Array) -> Array:
        """Follow the link to a place in the world; return the tool centre point (3,) there."""
        np.dot(self._on_link, rotation.T, out=self._in_world)
        np.add(self._way, position, out=self._point)
        return self._point

    def see_from(self, position: Array, rotation: Array) -> None:
        """Update what is public for a base at a place in the world."""
        np.subtract(self._point, position, out=self._way)
        np.dot(self._in_world, rotation, out=self._in_base)
