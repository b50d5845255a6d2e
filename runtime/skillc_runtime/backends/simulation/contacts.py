"""The contacts of the present step, by the geoms of the model of a cell, whichever model they were computed with."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from skillc_runtime.motion.pose import Array


class Contacts:
    """Reads contacts and their forces; `data` and `model` are those with which they are computed."""

    def __init__(self, model: Any, data: Any) -> None:
        self._geoms = np.arange(model.ngeom)
        self.model, self.data = model, data

    def read_from(self, model: Any, data: Any, geoms: NDArray[np.int64]) -> None:
        """Read other data from now on; `geoms` are the numbers (ngeom,) in the cell's model of the geoms there."""
        self.model, self.data, self._geoms = model, data, geoms

    @property
    def geoms(self) -> NDArray[np.int64]:
        """The geoms (n, 2) of each contact, in the model of the cell."""
        found: NDArray[np.int64] = self._geoms[self.data.contact.geom].reshape(-1, 2)
        return found

    def force(self, number: int) -> Array:
        """Return the force (3,) in N of a contact of the last step, in the world: of its first geom on the second."""
        wrench = np.zeros(6)
        mujoco.mj_contactForce(self.model, self.data, number, wrench)
        force: Array = self.data.contact.frame[number].reshape(3, 3).T @ wrench[:3]
        return force
