"""Notices that MuJoCo cannot compute the physics any more, and says what diverged."""

from __future__ import annotations

from typing import Any

import msgspec
import mujoco

from skillc_runtime.backends.simulation.machine_code import find_warnings
from skillc_runtime.backends.simulation.steps import OnMemory
from skillc_runtime.devices.backend import BackendBroken
from skillc_runtime.motion.arrays import Integers
from skillc_runtime.motion.numerics.compiled import bind, compiled

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


class Warnings(msgspec.Struct, frozen=True):
    """found (1, n): for each warning of MuJoCo 0, or something else if it was given."""

    found: Integers


@compiled
def find_warning(warnings: Warnings, now: float) -> int:
    """Return 1 if there is a warning."""
    for number in range(warnings.found.shape[1]):
        if warnings.found[0, number] != 0:
            return 1
    return 0


class DivergenceMonitor(OnMemory):
    """Watches the warnings that MuJoCo counts in `data`; its own reset after a divergence must be disabled.

    Each half of a step is followed by a look at them.
    """

    def __init__(self, model: Any, data: Any) -> None:
        super().__init__(bind(find_warning, Warnings(find_warnings(data))))
        self._model, self._data = model, data

    def act(self, events: int, now: float) -> bool:
        """Raise SimulationDiverged."""
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
