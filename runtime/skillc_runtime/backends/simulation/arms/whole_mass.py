"""The mass matrix of a whole cell, which MuJoCo computes for Python and for machine code alike."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from skillc_runtime.backends.simulation.machine_code import address_of

BEFORE = ("mj_kinematics", "mj_comPos", "mj_crb")
"""What computes the inertia that the matrix is made of."""


class WholeMass:
    """matrix (nv, nv): in kg m^2, as of the last `compute`.

    calls (4, 4): the addresses of functions of MuJoCo, 0 for those that are not called, and of model, data and
    `matrix`, which only the last one takes.
    """

    def __init__(self, model: Any, data: Any) -> None:
        self._model, self._data = model, data
        self.matrix = np.zeros((model.nv, model.nv))
        self.calls = np.zeros((len(BEFORE) + 1, 4), dtype=np.int64)
        self.calls[:, 1:] = model._address, data._address, self.matrix.ctypes.data
        self.calls[-1, 0] = address_of("mj_fullM")
        self._is_stepped = True

    def let_be_stepped(self, is_stepped: bool) -> None:
        """Say whether steps compute the inertia in the data from now on, or it has to be computed before."""
        self._is_stepped = is_stepped
        self.calls[:-1, 0] = [0 if is_stepped else address_of(each) for each in BEFORE]

    def compute(self) -> None:
        """Compute the matrix of the positions in the data."""
        if not self._is_stepped:
            for each in BEFORE:
                getattr(mujoco, each)(self._model, self._data)
        mujoco.mj_fullM(self._model, self._data, self.matrix)
