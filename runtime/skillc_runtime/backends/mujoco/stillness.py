"""Tells whether what no hand holds lies still in a simulation with physics: nothing falls, rolls, tips or slides."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

import numpy as np

from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.backends.simulation.scene_spec import SceneSpec

STILL_M_S, STILL_RAD_S = 0.01, 0.1
"""What moves slower than this lies still, unless it begins to fall."""

STILL_M_S2 = 1.0
"""What gets faster than this begins to fall, or bounces."""


def lie_still(scene: SceneSpec, held: Collection[str | None], model: Any, data: Any) -> bool:
    """Whether all that lies free or slides is still, besides what is `held`, in the last step of `data`."""
    names = scene.names
    free = [part_name(names[each.individual], "free") for each in scene.graspable if each.individual not in held]
    sliding = [part_name(names[each.individual], "slide") for each in scene.bodies if each.slide is not None]
    return all(_is_still(model.joint(each), data) for each in (*free, *sliding))


def _is_still(joint: Any, data: Any) -> bool:
    """Whether the first three velocities of a joint, m/s, the others, rad/s, and accelerations, m/s^2, are small."""
    first = int(joint.dofadr[0])
    dofs = slice(first, first + len(joint.damping))
    velocity, acceleration = data.qvel[dofs], data.qacc[dofs]
    return bool(
        np.linalg.norm(velocity[:3]) < STILL_M_S
        and np.linalg.norm(velocity[3:]) < STILL_RAD_S
        and np.linalg.norm(acceleration[:3]) < STILL_M_S2
    )
