"""An arm whose joints are where a device measures them has the model, weight and wrench of a simulated one."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from simulation.cells import cell
from skillc_runtime.backends.control_process.fingers import find_fingers
from skillc_runtime.backends.control_process.link import LinkAbilities, StateView, make_state
from skillc_runtime.backends.control_process.periods.device_arm import DeviceArm, build_arm
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.devices.arm import ArmLoad
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.world.state.data_sheet import SheetError

IIWA, UR5E = "iiwa_table", "ur5e_whiteboard"
HELD = Pose(np.array([0.0, 0.01, 0.05]), np.eye(3))
LOAD = ArmLoad(0.4, np.array([0.01, 0.0, 0.02]), HELD, HELD)


def build(simulated: SimulatedCell, **able: object) -> DeviceArm:
    facts = simulated.scene.arms[0]
    abilities = LinkAbilities(facts.modes, **{"wrench": "without-weight", **able})  # type: ignore[arg-type]
    return build_arm(facts, simulated.scene.names, abilities, 0.001)


def read(q: Array, dq: Array, wrench: Array | None = None) -> StateView:
    state = make_state(q.size)
    state.buffer[:] = 0.0
    state.q[:], state.dq[:] = q, dq
    if wrench is not None:
        state.wrench[:] = wrench
    return state


@pytest.mark.parametrize("scene", [IIWA, UR5E])
def test_it_is_the_arm_of_a_simulation_in_any_posture(scene: str) -> None:
    simulated = cell(scene)
    facts, arm = simulated.scene.arms[0], build(simulated)
    other, rng = simulated.arms[facts.individual], np.random.default_rng(0)
    assert facts.gripper is not None
    fingers, shares = find_fingers(simulated.model, simulated.scene.names[facts.gripper.individual])
    for opening_m in (None, 0.0, 0.02, 0.05, 0.02):
        if opening_m is not None:
            arm.set_fingers(opening_m)
            simulated.data.qpos[fingers] = opening_m / shares.sum()
        q, dq = facts.home + rng.uniform(-0.3, 0.3, facts.home.size), rng.uniform(-0.5, 0.5, facts.home.size)
        for each in (arm, other):
            each.set_load(LOAD)
        other._q[:], other._dq[:] = q, dq
        mujoco.mj_forward(simulated.model, simulated.data)
        arm.measure(read(q, dq), 1.0)
        mine, theirs = arm.state(), other.state()
        np.testing.assert_allclose(mine.tool.position, theirs.tool.position, atol=1e-9)
        np.testing.assert_allclose(mine.jacobian, theirs.jacobian, atol=1e-9)
        np.testing.assert_allclose(mine.mass_matrix, theirs.mass_matrix, atol=1e-9)
        np.testing.assert_allclose(mine.bias, theirs.bias, atol=1e-9)


def test_what_carries_it_at_rest_is_its_bias_at_rest() -> None:
    simulated = cell(IIWA)
    arm, home = build(simulated, carries_weight=True), simulated.scene.arms[0].home
    arm.set_load(LOAD)
    arm.measure(read(home, np.zeros(7)), 0.0)
    at_rest = arm.state().bias.copy()
    np.testing.assert_allclose(arm.weight_torques, at_rest, atol=1e-9)
    assert np.abs(at_rest).max() > 10.0
    arm.measure(read(home, np.ones(7)), 0.001)
    assert np.abs(arm.state().bias - at_rest).max() > 0.1
    np.testing.assert_allclose(arm.weight_torques, at_rest, atol=1e-9)


@pytest.mark.parametrize("kind", ["with-weight", "with-held-weight", "without-weight"])
def test_a_wrench_at_the_flange_is_one_at_the_tool_and_without_weight(kind: str) -> None:
    simulated = cell(UR5E)
    home, still = simulated.scene.arms[0].home, np.zeros(6)
    arm = build(simulated, wrench=kind)
    arm.set_load(LOAD)
    arm.measure(read(home, still), 0.0)
    flange, tool = arm.flange_at(home), arm.state().tool
    force = np.array([3.0, -2.0, 10.0])
    down = np.array([0.0, 0.0, -9.81])
    felt = np.concatenate(
        [flange.rotation.T @ force, flange.rotation.T @ np.cross(tool.position - flange.position, force)]
    )
    has = {"with-weight": (arm.hand, arm.held), "with-held-weight": (arm.held,), "without-weight": ()}
    for mass in has[kind]:
        weight = mass.mass_kg * flange.rotation.T @ down
        felt += np.concatenate([weight, np.cross(mass.centre, weight)])
    arm.measure(read(home, still, felt), 0.001)
    wrench = arm.state().wrench
    np.testing.assert_allclose(wrench, [*force, 0.0, 0.0, 0.0], atol=1e-9)
    assert arm.hand.mass_kg > 0.3
    arm.tare()
    np.testing.assert_allclose(arm.state().wrench, 0.0, atol=1e-9)


def test_a_device_that_does_not_fit_the_facts_is_told() -> None:
    with pytest.raises(SheetError, match="lab:Ur5e-1 has a force-torque sensor in the scene; its device measures no"):
        build(cell(UR5E), wrench="none")
    facts = cell(IIWA).scene
    with pytest.raises(SheetError, match="takes torque commands in the scene; its device takes position commands"):
        build_arm(facts.arms[0], facts.names, LinkAbilities(("position",)), 0.001)
