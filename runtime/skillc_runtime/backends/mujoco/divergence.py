"""Notices that MuJoCo cannot compute the physics any more, and says what diverged."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np

from skillc_runtime.devices.backend import BackendBroken

EXHAUSTED = {
    mujoco.mjtWarning.mjWARN_CONTACTFULL: "there is no memory for all contacts",
    mujoco.mjtWarning.mjWARN_CNSTRFULL: "there is no memory for all constraints",
}
"""Warnings about the memory of the physics: it goes on without some contacts, which makes its forces wrong."""

OF_JOINTS = {
    mujoco.mjtWarning.mjWARN_BADQACC: "the acceleration",
    mujoco.mjtWarning.mjWARN_BADQVEL: "the speed",
    mujoco.mjtWarning.mjWARN_BADQPOS: "the position",
    mujoco.mjtWarning.mjWARN_INERTIA: "the inertia",
}
"""Warnings about a joint and what of it is unusable, the cause before its consequences."""


class SimulationDiverged(BackendBroken):
    """The physics does not yield usable numbers any more; the message says what diverged, and when."""


class DivergenceMonitor:
    """Watches the warnings that MuJoCo counts in `data`; its own reset after a divergence must be disabled.

    `check` runs twice in every step, so it compares memory, which takes a third of the time of a look at each count.
    """

    def __init__(self, model: Any, data: Any) -> None:
        self._model, self._data = model, data
        self._counts = memoryview(data.warning.number)
        self._none = memoryview(np.zeros_like(data.warning.number))

    def check(self) -> None:
        """Raise SimulationDiverged if MuJoCo has warned of anything."""
        if self._counts != self._none:
            raise SimulationDiverged(f"the simulation diverged at {self._data.time:.3f} s: {self._describe()}")

    def _describe(self) -> str:
        """Describe the first of the warnings that there are."""
        warned, found = self._data.warning.number, self._data.warning.lastinfo
        for warning, what in OF_JOINTS.items():
            if warned[warning]:
                return f"{what} of {self._find_joint(warning, int(found[warning]))} is too large or no number"
        if warned[control := mujoco.mjtWarning.mjWARN_BADCTRL]:
            return f"the command of {self._model.actuator(int(found[control])).name} is too large or no number"
        return next(what for warning, what in EXHAUSTED.items() if warned[warning])

    def _find_joint(self, warning: Any, index: int) -> str:
        """Return the joint of a degree of freedom, or of a coordinate where the warning counts those."""
        model = self._model
        if warning == mujoco.mjtWarning.mjWARN_BADQPOS:
            joint = int((model.jnt_qposadr <= index).nonzero()[0][-1])
        else:
            joint = int(model.dof_jntid[index])
        return str(model.joint(joint).name or model.body(model.jnt_bodyid[joint]).name)
