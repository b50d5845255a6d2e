"""Machine code runs the steps of a cell as Python does, to the last bit, and Python takes over where it has to."""

from __future__ import annotations

import hashlib

import mujoco
import numpy as np
import pytest
from cells import ARM, GRIPPER, world

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.machine_code import find_counts, find_geoms, find_warnings
from skillc_runtime.devices.backend import BackendBroken
from skillc_runtime.devices.disturbances import PushArm
from skillc_runtime.motion.numerics.compiled import COMPILES
from skillc_runtime.motion.overlays import Circle, Spiral
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose, rotation_from_quaternion
from skillc_runtime.recording.mcap.sample_layout import SampledBlock
from skillc_runtime.recording.mcap.signal_tap import SignalTap
from skillc_runtime.world.state.model import WorldModel

pytestmark = pytest.mark.skipif(not COMPILES, reason="nothing is compiled here")


def both_ways(scene: str, steps_per_command: int = 1) -> tuple[SimulatedCell, SimulatedCell]:
    """The same cell twice: run by machine code where it can, and by Python alone."""
    cells = [SimulatedCell(WorldModel(world(scene)), seed=3, steps_per_command=steps_per_command) for _ in range(2)]
    cells[1].steps.runs_program = False
    return cells[0], cells[1]


def digest(cell: SimulatedCell, blocks: list[SampledBlock]) -> str:
    """A digest of all that a cell is and has recorded."""
    data, found = cell.data, hashlib.sha256()
    for array in (data.qpos, data.qvel, data.qacc_warmstart, data.ctrl, data.qfrc_applied, data.sensordata):
        found.update(array.tobytes())
    for block in blocks:
        found.update(bytes(block.content) + str((block.first_s, block.rows, block.poses)).encode())
    for observer in cell._observers.values():
        found.update(observer.recorder.recording().rows.tobytes())
    return found.hexdigest()


def keep_busy(cell: SimulatedCell, scene: str) -> str:
    """Let the arm move joints and tool, with an overlay, while fingers move and somebody pushes the hand."""
    blocks, (driver, hand) = list[SampledBlock](), (cell.arm(ARM[scene]), cell.gripper(GRIPPER[scene]))
    tap = SignalTap(cell.capabilities.live)
    tap.add(blocks.append)
    driver.motion.move_joints(driver.motion.stopping_joints() + 0.05, 0.5)
    for tick in range(60):
        cell.advance(0.01)
        if tick == 20:
            start = driver.motion.stopping_pose()
            goal = Pose(start.position + np.array([0.0, 0.0, 0.05]), start.rotation)
            driver.motion.move_along(path_through([start, goal], MotionLimits(speed=0.2, acceleration=0.8)))
            overlay = driver.motion.add_overlay(Circle(0.01, 0.1), np.eye(3), 0.05)
            driver.motion.add_overlay(Spiral(0.004, 0.05, 0.01), np.eye(3), 0.05)
        if tick == 30:
            hand.move(0.02, 20.0)
            cell.disturber.disturb(PushArm(ARM[scene], (0.0, 20.0, 0.0), 0.033))
        if tick == 45:
            driver.motion.remove_overlay(overlay)
    tap.remove(blocks.append)
    assert sum(block.rows for block in blocks) == round(0.6 / cell.period_s)
    return digest(cell, blocks)


@pytest.mark.slow
@pytest.mark.parametrize(("scene", "steps_per_command"), [("iiwa_table", 1), ("ur5e_whiteboard", 2)])
def test_both_ways_give_the_same_to_the_last_bit(scene: str, steps_per_command: int) -> None:
    by_program, by_python = both_ways(scene, steps_per_command)
    assert keep_busy(by_program, scene) == keep_busy(by_python, scene)
    assert by_program.now == by_python.now == by_program.data.time


def test_a_person_guides_a_tool_in_both_ways_alike() -> None:
    found = []
    for cell in both_ways("iiwa_guiding"):
        arm = cell.arm(ARM["iiwa_table"])
        for axis in np.eye(3):
            arm.compliance.release(axis)
        for _ in range(150):
            cell.advance(0.01)
        (guidance,) = cell.ground_truth.guidances()
        found.append((digest(cell, []), guidance.times.tobytes(), guidance.forces.tobytes()))
        assert guidance.forces.max() > 1.0
    assert found[0] == found[1]


@pytest.mark.slow
def test_a_divergence_is_noticed_in_the_step_in_which_it_happens() -> None:
    told = []
    for cell in both_ways("iiwa_table"):
        cell.arm(ARM["iiwa_table"]).motion.stopping_pose()
        cell.advance(0.1)
        cell.data.qvel[0] = 1e12
        with pytest.raises(BackendBroken) as refused:
            cell.advance(0.1)
        told.append(str(refused.value))
        with pytest.raises(BackendBroken):
            cell.advance(0.1)
    assert told[0] == told[1]


def test_mujoco_counts_where_machine_code_reads_it() -> None:
    falling = "".join(f'<body pos="0 {y} .09"><freejoint/><geom size=".1"/></body>' for y in range(3))
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody><geom type="plane" size="9 9 1"/>{falling}</worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    counts, warnings, seen = find_counts(data), find_warnings(data), set[int]()
    for height in (0.0, 0.05, 1.0):
        data.qpos[2::7][: len(seen) + 1] += height
        mujoco.mj_forward(model, data)
        assert int(counts[0, 0]) & 0xFFFFFFFF == data.ncon
        assert not warnings.any()
        seen.add(data.ncon)
    assert len(seen) > 1
    data.qpos[0] = np.nan
    mujoco.mj_step(model, data)
    assert data.warning.number.any() and warnings.any()


def test_a_cell_reads_no_clock_in_its_steps_unless_it_is_given_back() -> None:
    cell = both_ways("iiwa_table")[0]
    cell.advance(0.01)
    assert cell.data.timer.number.any()
    assert not cell.data.timer.duration.any()
    mujoco.set_mjcb_time(None)
    cell.advance(0.01)
    assert cell.data.timer.duration.any()


def test_machine_code_reads_which_geoms_are_in_contact() -> None:
    falling = "".join(f'<body pos="0 {y} 1"><freejoint/><geom size=".1"/></body>' for y in range(3))
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody><geom type="plane" size="9 9 1"/>{falling}</worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    seen = set[tuple[int, ...]]()
    for down in ([0], [1], [0, 1], [2, 1], [0, 2], [0, 1, 2]):
        data.qpos[2::7] = [0.09 if ball in down else 1.0 for ball in range(3)]
        mujoco.mj_forward(model, data)
        assert data.ncon == len(down)
        found = find_geoms(data)
        assert found[: len(down), :2].tobytes().count(data.contact.geom[0].tobytes()) == 1
        seen.add(tuple(found[: len(down), :2].ravel().tolist()))
    assert len(seen) == 6


def test_a_base_drives_in_both_ways_alike_and_machine_code_makes_most_of_its_steps() -> None:
    found, by_python = [], []
    for cell in both_ways("ur5e_whiteboard"):
        (base,) = cell._bases.values()
        goal = Pose.of((0.3, -0.2, 0.0), (np.cos(0.6), 0.0, 0.0, np.sin(0.6)))
        base.drive_to(base.pose @ goal)
        made, way = base.step, []
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(base, "step", lambda period_s, made=made: by_python.append(period_s) or made(period_s))
            while not base.at_rest:
                cell.advance(0.01)
                places = cell.data.mocap_pos, cell.data.mocap_quat, base.pose.rotation
                way.append([each.tobytes() for each in places])
        assert base.done
        turned = rotation_from_quaternion(cell.data.mocap_quat[0])
        np.testing.assert_allclose(base.pose.rotation, turned, atol=1e-12)
        found.append((digest(cell, []), way))
    assert found[0] == found[1]
    assert 100 < len(by_python) / 2 < 0.25 * len(found[0][1]) * 10
