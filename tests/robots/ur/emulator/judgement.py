"""How a tool has really rubbed a surface: what the simulator behind the controller knows, and no client."""

from __future__ import annotations

import numpy as np

from robots.ur.emulator.plant import Plant
from skillc_runtime.motion.pose import rotation_from_quaternion

SLOW_M_S = 0.02
"""A tool that is pressed on and moves faster than this wipes."""


def judge_rubbing(plant: Plant, command_n: float) -> dict[str, float]:
    """Return mean error and RMSE of the normal force as shares of the command, tilt in deg, lost share, and coverage.

    Over all samples between the first and the last one in which the pressed tool moves.
    """
    rows = np.array(plant.rubs)
    moving = np.flatnonzero(np.linalg.norm(rows[:, 9:12], axis=1) > SLOW_M_S)
    rows = rows[moving[0] : moving[-1] + 1]
    (surface,) = plant.scene.surfaces
    normal = plant.coverage[surface.individual].normal
    tilts = [np.degrees(np.arccos(min(abs(rotation_from_quaternion(row[5:9])[:, 2] @ normal), 1.0))) for row in rows]
    force = rows[:, 1]
    expected = round((rows[-1, 0] - rows[0, 0]) / plant.period_s) + 1
    return {
        "seconds": float(rows[-1, 0] - rows[0, 0]),
        "mean_error": float(abs(force.mean() / command_n - 1.0)),
        "rmse": float(np.sqrt(np.mean((force - command_n) ** 2)) / command_n),
        "greatest_n": float(force.max()),
        "tilt_rms_deg": float(np.sqrt(np.mean(np.square(tilts)))),
        "lost": 1.0 - len(rows) / expected,
        "coverage": plant.camera().inspect(surface.individual),
    }
