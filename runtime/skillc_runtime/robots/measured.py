"""What an arm measured last, as the world sees it."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.robots.arm import ArmState

NEAR_JOINT_RAD = 0.02
"""How far a joint may be from its reference to count as there."""

STILL_RAD_S = 0.03
"""Joints slower than this rest; the noise of a force sensor alone moves those of a compliant arm with 0.02 rad/s."""

Observer: TypeAlias = Callable[[ArmState], None]
"""Sees what was measured, in the arm's base frame, after every control period."""


class Measured:
    """The last state of an arm, in world axes, SI units; `base` tells where the arm stands."""

    def __init__(self, base: Callable[[], Pose], state: ArmState) -> None:
        self._base, self._state = base, state

    @property
    def pose(self) -> Pose:
        """The measured tool pose."""
        return self._base() @ self._state.tool

    @property
    def velocity(self) -> Array:
        """The measured twist (6,) of the tool, m/s and rad/s."""
        return self._in_world(self._state.jacobian @ self._state.dq)

    @property
    def q(self) -> Array:
        """The measured joints (nv,) in rad."""
        return self._state.q.copy()

    @property
    def still(self) -> bool:
        """Whether no joint moves."""
        return bool(np.abs(self._state.dq).max() < STILL_RAD_S)

    def at_joints(self, q: Array) -> bool:
        """Tell whether the joints are measured to be at q (nv,)."""
        return bool(np.abs(self._state.q - q).max() < NEAR_JOINT_RAD)

    def in_world(self, place: Array) -> Array:
        """Return a place (3,) of the arm's base frame in the world."""
        return self._base().at(place)

    def in_base(self, direction: Array) -> Array:
        """Return a direction (3,) of the world in the arm's base axes."""
        return self._base().rotation.T @ direction

    def _in_world(self, vector: Array) -> Array:
        return (vector.reshape(2, 3) @ self._base().rotation.T).ravel()
