"""The wrist sensor reports what the environment does to the tool, with the right sign, at the right place."""

import numpy as np
import pytest
from cells import ARM, GRIPPER, LAB, world

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.arm import ArmLoad
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import FORCE_NOISE, TORQUE_NOISE

SCENE = "ur5e_whiteboard"
SENSOR = LAB + "ForceTorque-1"


def silent() -> SimulatedCell:
    """Return a cell in which the sensor has no noise."""
    state = world(SCENE).with_changes([SetProperty(SENSOR, noise, 0.0) for noise in (FORCE_NOISE, TORQUE_NOISE)])
    return SimulatedCell(WorldModel(state))


def loaded(force_n: tuple[float, float, float]) -> tuple[SimulatedCell, np.ndarray]:
    """Return a resting cell in which a force in world axes acts at the hand's centre of mass, and that point."""
    there = silent()
    palm = there.model.body(there.scene.names[GRIPPER[SCENE]] + "/palm").id
    there.data.xfrc_applied[palm, :3] = force_n
    there.advance(0.5)
    return there, there.data.xipos[palm].copy()


@pytest.mark.parametrize("force_n", [(0.0, 0.0, 0.0), (0.0, 0.0, -20.0), (5.0, -3.0, 8.0)])
def test_a_force_on_the_hand_is_reported_at_the_tool_centre_point(force_n: tuple[float, float, float]) -> None:
    there, point = loaded(force_n)
    arm = there.arm(ARM[SCENE])
    np.testing.assert_allclose(arm.measured.wrench[:3], force_n, atol=1e-2)
    np.testing.assert_allclose(
        arm.measured.wrench[3:], np.cross(point - arm.measured.pose.position, force_n), atol=1e-2
    )


def test_a_hanging_mass_that_nobody_announced_pulls_down_and_an_announced_one_does_not() -> None:
    there, _ = loaded((0.0, 0.0, -9.81 * 2.0))
    simulated, driver = there.arms[ARM[SCENE]], there.arm(ARM[SCENE])
    assert driver.measured.wrench[2] == pytest.approx(-19.62, abs=0.01)
    name = there.scene.names[GRIPPER[SCENE]]
    palm = there.model.body(f"{name}/palm")
    in_link = Pose.of(there.model.body(f"{name}/palm").pos, there.model.body(f"{name}/palm").quat).apply(palm.ipos)
    here, centre = Pose(np.zeros(3), np.eye(3)), simulated.fixed_tool.inverse().apply(in_link)
    simulated.set_load(ArmLoad(2.0, centre, here, here))
    there.advance(0.3)
    np.testing.assert_allclose(driver.measured.wrench, 0.0, atol=0.02)


def test_shaking_the_empty_hand_feels_like_nothing() -> None:
    there = silent()
    driver = there.arm(ARM[SCENE])
    there.advance(0.2)
    goal = driver.measured.q + np.array([0.3, 0.2, -0.3, 0.2, 0.3, 0.4])
    driver.motion.move_joints(goal, 0.5)
    felt = []
    while not driver.motion.done:
        there.advance(0.005)
        felt.append(np.linalg.norm(driver.measured.wrench[:3]))
    assert len(felt) > 20
    assert max(felt) < 2.0
