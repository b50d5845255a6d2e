"""The calibration step: `mj_step` of a fixed minimal model, which costs of control and physics are compared with.

Machines differ, and their load changes; ratios to this step within one run differ little. It is a step as the Python
package of MuJoCo makes it, with timers, which cells stop: so figures of all commits have one unit.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import CDLL, c_void_p
from pathlib import Path
from time import process_time
from typing import Any

import mujoco
import numpy as np

JOINTS, CONTACTS, STEPS, BURSTS = 7, 4, 200, 40

_LINK = (
    '<body pos="{place}"><joint axis="{axis}" stiffness="400" damping="20" armature=".05"/>'
    '<inertial pos=".05 0 0" mass="2" diaginertia=".02 .02 .02"/>{inside}</body>'
)
_TOOL = '<geom type="box" pos="0 0 -.221" size=".05 .025 .02" solref=".05 1" solimp=".2 .9 .01"/>'
_SCENE = (
    '<mujoco><option timestep=".001" integrator="implicitfast" cone="elliptic"/>'
    '<worldbody><geom type="plane" size="2 2 .1"/>{arm}</worldbody></mujoco>'
)
_PLACES = ("0 0 .24", *("0.1 0 0",) * (JOINTS - 1))
_AXES = ("0 0 1", "0 1 0", "1 0 0", "0 1 0", "1 0 0", "0 1 0", "0 0 1")


def make_minimal_arm() -> tuple[Any, Any]:
    """Return a model and data of an arm that presses its tool, a box and part of its last link, on a plane."""
    inside = _TOOL
    for place, axis in zip(reversed(_PLACES), reversed(_AXES), strict=True):
        inside = _LINK.format(place=place, axis=axis, inside=inside)
    model = mujoco.MjModel.from_xml_string(_SCENE.format(arm=inside))
    model.body_gravcomp[:] = 1.0
    data = mujoco.MjData(model)
    data.qfrc_applied[1] = 10.0
    for _ in range(500):
        mujoco.mj_step(model, data)
    assert model.nv == JOINTS, model.nv
    assert data.ncon == CONTACTS, data.ncon
    return model, data


@contextmanager
def timers() -> Iterator[None]:
    """Let MuJoCo measure how long parts of steps take, as it does unless a cell has stopped that."""
    folder = Path(mujoco.__file__).parent
    path = next(each for each in folder.iterdir() if each.name.startswith(("libmujoco.", "mujoco.dll")))
    clock = c_void_p.in_dll(CDLL(str(path)), "mjcb_time")
    before = clock.value
    mujoco.set_mjcb_time(None)
    yield
    clock.value = before


def calibration_step_us(bursts_of_steps: int = BURSTS) -> float:
    """Return what the calibration step costs now, in us: the median of bursts."""
    model, data = make_minimal_arm()
    bursts = []
    with timers():
        for _ in range(bursts_of_steps):
            began = process_time()
            for _ in range(STEPS):
                mujoco.mj_step(model, data)
            bursts.append((process_time() - began) / STEPS)
    return 1e6 * float(np.median(bursts))


if __name__ == "__main__":
    print(f"calibration step {calibration_step_us():.2f} us")
