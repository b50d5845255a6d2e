"""An arm whose controller runs more slowly than the physics moves evenly in between."""

import numpy as np
import pytest
from cells import ARM, world

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.arm import JointPosition, Torque
from skillc_runtime.world.state.model import WorldModel

SCENE = "ur5e_whiteboard"


@pytest.mark.parametrize("steps", [1, 2, 4])
def test_servo_targets_are_interpolated_over_the_control_period(steps: int) -> None:
    there = SimulatedCell(WorldModel(world(SCENE)), steps_per_command=steps)
    driver = there.arm(ARM[SCENE])
    driver.motion.move_joints(driver.measured.q + 0.2, 0.5)
    there.advance(0.2)
    targets = []
    for _ in range(12 * steps):
        there.advance(0.001)
        targets.append(there.data.ctrl[0])
    steepness = np.diff(targets)
    assert there.period_s == pytest.approx(0.001 * steps)
    assert steepness.min() > 0, "a held target would stand still between two commands"
    assert steepness.max() < 1.5 * steepness.min()


@pytest.mark.parametrize(("scene", "wrong"), [(SCENE, Torque(np.zeros(6))), ("iiwa_table", JointPosition(np.zeros(7)))])
def test_an_arm_refuses_what_its_interface_does_not_take(scene: str, wrong: Torque | JointPosition) -> None:
    there = SimulatedCell(WorldModel(world(scene)))
    with pytest.raises(TypeError, match="controlled arm takes no"):
        there.arms[ARM[scene]].command(wrong)
