"""The limits of a Franka Research 3 as its maker publishes them, written a second time to check what is commanded.

Source: the maker's interface specification and libfranka's rate_limiting.h (limits of speed near the ends of joints).
"""

from __future__ import annotations

import numpy as np

TORQUE = np.array([87.0, 87.0, 87.0, 87.0, 12.0, 12.0, 12.0])
TORQUE_PER_MS = 1.0
LOWEST = np.array([-2.7437, -1.7837, -2.9007, -3.0421, -2.8065, 0.5445, -3.0159])
HIGHEST = np.array([2.7437, 1.7837, 2.9007, -0.1518, 2.8065, 4.5169, 3.0159])
SPEED = np.array([2.62, 2.62, 2.62, 2.62, 5.26, 4.18, 5.26])
TWICE_BRAKING = np.array([12.0, 5.17, 7.0, 8.0, 34.0, 11.0, 34.0])
OFFSET = np.array([0.30, 0.20, 0.20, 0.30, 0.35, 0.35, 0.35])
LOWEST_FOR_SPEED = np.array([-2.7501, -1.7918, -2.9065, -3.0481, -2.8101, 0.54092, -3.0196])
HIGHEST_FOR_SPEED = np.array([2.7501, 1.7918, 2.9065, -0.1458, 2.8101, 4.5205, 3.0196])
LOST_IN_ROW = 20
"""After so many states without a command, a robot stops (communication_constraints_violation)."""


def fastest(q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the lowest and the highest speeds (7,) in rad/s at joints q (7,) in rad."""
    up = np.sqrt(np.maximum(0.0, TWICE_BRAKING * (HIGHEST_FOR_SPEED - q))) - OFFSET
    down = np.sqrt(np.maximum(0.0, TWICE_BRAKING * (q - LOWEST_FOR_SPEED))) - OFFSET
    return -np.minimum(SPEED, np.maximum(0.0, down)), np.minimum(SPEED, np.maximum(0.0, up))
