"""The state of a simulated arm: one object, renewed by every call, right, and for reading only."""

import mujoco
import numpy as np
import pytest
from cells import ARM, SCENES, cell

from skillc_runtime.motion.pose import Pose, log


@pytest.mark.parametrize("scene", SCENES)
def test_it_is_renewed_and_cannot_be_written(scene: str) -> None:
    there = cell(scene)
    arm = there.arms[ARM[scene]]
    state = arm.state()
    before = state.q.copy()
    there.arm(ARM[scene]).motion.move_joints(before + 0.1, 1.0)
    there.advance(0.5)
    assert arm.state() is state
    assert np.abs(state.q - before).max() > 0.01
    for array in (state.q, state.dq, state.jacobian, state.bias, state.wrench, state.tool.position):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0.0


@pytest.mark.parametrize("scene", SCENES)
def test_the_jacobian_is_the_derivative_of_the_tool(scene: str) -> None:
    there = cell(scene)
    arm, h = there.arms[ARM[scene]], 1e-6
    jacobian, home = arm.state().jacobian.copy(), arm.state().q.copy()

    def tool_at(q: np.ndarray) -> Pose:
        arm._q[:] = q
        mujoco.mj_forward(there.model, there.data)
        tool = arm.state().tool
        return Pose(tool.position.copy(), tool.rotation.copy())

    for joint, step in enumerate(h * np.eye(home.size)):
        low, high = tool_at(home - step), tool_at(home + step)
        turn = log(high.rotation @ low.rotation.T)
        slope = np.array([*(high.position - low.position), *turn]) / (2 * h)
        np.testing.assert_allclose(slope, jacobian[:, joint], atol=1e-6)
