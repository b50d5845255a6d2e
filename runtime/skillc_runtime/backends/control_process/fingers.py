"""Where the fingers of a gripper are in a model."""

from __future__ import annotations

from typing import Any

import numpy as np

from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.motion.pose import Array


def find_fingers(model: Any, name: str) -> tuple[Array, Array]:
    """Return where the positions of the fingers of a gripper are, and their shares of its opening."""
    tendon = int(model.actuator_trnid[model.actuator(part_name(name, "opening")).id, 0])
    first = int(model.tendon_adr[tendon])
    span = slice(first, first + int(model.tendon_num[tendon]))
    places: Array = model.jnt_qposadr[model.wrap_objid[span]]
    return places, np.asarray(model.wrap_prm[span])
