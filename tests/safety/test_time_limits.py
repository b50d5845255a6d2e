"""A device that never arrives is a failure that says so: fingers, bases, arms, buttons and pushed tools."""

from __future__ import annotations

from collections import deque
from copy import deepcopy

import numpy as np
import pytest

from safety.faults import things
from simulation.cells import ARM, ERASER, GRIPPER, LAB, begin, cell, grasp, reach_for_eraser, run
from skillc_runtime.backends.mujoco import gripper as fingers
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.bases.base import SimulatedBase
from skillc_runtime.devices.arm import Command
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.button import AwaitSwitch
from skillc_runtime.primitives.compliance import Push
from skillc_runtime.primitives.drive import DriveBase
from skillc_runtime.primitives.grasp import Release
from skillc_runtime.primitives.gripper import ThreeFingerGripper
from skillc_runtime.primitives.move import MoveLinear
from skillc_runtime.primitives.primitive import SkillFailure, Status

IIWA, UR5E = "iiwa_table", "ur5e_whiteboard"


def delay_commands(there: SimulatedCell, arm: str, periods: int) -> None:
    """Let the commands of an arm arrive some control periods late."""
    motors, late = there.arms[arm]._motors, deque[Command]()
    take = motors.command

    def command(given: Command) -> None:
        late.append(deepcopy(given))
        if len(late) > periods:
            take(late.popleft())

    motors.command = command  # type: ignore[method-assign]
    there.steps.runs_program = False


def beside(there: SimulatedCell, scene: str, *way: float) -> MoveLinear:
    """Return the motion of the tool by a vector."""
    start = there.arm(ARM[scene]).motion.stopping_pose()
    return MoveLinear(there, arm=ARM[scene], target=Pose(start.position + np.array(way), start.rotation), speed=0.2)


def test_an_arm_that_its_delayed_commands_shake_is_stopped() -> None:
    there = cell(IIWA)
    delay_commands(there, ARM[IIWA], 10)
    there.advance(0.1)
    with pytest.raises(SkillFailure):
        run(there, beside(there, IIWA, 0.0, 0.0, -0.1))
    there.advance(0.5)
    stopped = there.arm(ARM[IIWA]).measured.q.copy()
    run(there, ThreeFingerGripper(there, gripper=GRIPPER[IIWA], opening=0.0, force=20.0))
    assert there.arm(ARM[IIWA]).measured.q == pytest.approx(stopped, abs=1e-3)
    assert there.broken is None


def test_fingers_that_never_come_to_rest_do_not_close_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    there = cell(IIWA)
    monkeypatch.setattr(fingers, "STILL_M_S", -1.0)
    closing = ThreeFingerGripper(there, gripper=GRIPPER[IIWA], opening=0.0, force=20.0)
    with pytest.raises(SkillFailure, match=r"lab:Robotiq-1 have not come to rest within 4.5 s: they are .* not 0 mm"):
        run(there, closing)


def test_a_delay_that_an_arm_can_bear_delays_no_gripper() -> None:
    there = cell(IIWA)
    delay_commands(there, ARM[IIWA], 2)
    run(there, beside(there, IIWA, 0.0, 0.0, -0.1))
    run(there, ThreeFingerGripper(there, gripper=GRIPPER[IIWA], opening=0.0, force=20.0))


def test_fingers_that_never_come_to_rest_do_not_release_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    there = cell(IIWA)
    reach_for_eraser(there, IIWA)
    grasp(there, IIWA)
    monkeypatch.setattr(fingers, "STILL_M_S", -1.0)
    release = Release(there, arm=ARM[IIWA], gripper=GRIPPER[IIWA], object=ERASER, to=LAB + "Cell")
    with pytest.raises(SkillFailure, match=r"lab:Robotiq-1 have not come to rest within 4.5 s: they are \d+ mm open"):
        run(there, release)


def test_a_base_that_is_stuck_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    there = cell(UR5E)
    robot, place = things(UR5E)["robot"], LAB + "Store"
    monkeypatch.setattr(SimulatedBase, "step", lambda *_: None)
    drive = DriveBase(there, robot=robot, to=place)
    with pytest.raises(SkillFailure, match=r"lab:Heron-1 has not arrived at .* within \d+ s: it is \d.\d\d m away"):
        run(there, drive, 120.0)


def test_an_arm_that_stands_before_the_end_of_its_motion_fails() -> None:
    there = cell(IIWA)
    move = beside(there, IIWA, 0.0, 0.0, -0.1)
    begin(move)
    there.advance(0.2)
    assert move.tick() is Status.RUNNING
    there.arm(ARM[IIWA]).motion.pause()
    with pytest.raises(SkillFailure, match="stood still for 5 s before the end of its motion"):
        _tick(there, move, 10.0)


def test_a_motion_that_is_paused_for_a_short_time_goes_on() -> None:
    there = cell(IIWA)
    move = beside(there, IIWA, 0.0, 0.0, -0.1)
    begin(move)
    there.advance(0.2)
    move.pause()
    there.advance(3.0)
    move.resume()
    _tick(there, move, 10.0)


def _tick(there: SimulatedCell, move: MoveLinear, seconds: float) -> None:
    for _ in range(round(seconds / 0.02)):
        if move.tick() is Status.SUCCESS:
            return
        there.advance(0.02)
    raise AssertionError("the motion does not end")


def test_a_button_that_nobody_presses_fails() -> None:
    scene = "ur5e_button"
    there = cell(scene)
    await_switch = AwaitSwitch(there, arm=things(scene)["arm"], button=things(scene)["button"], patience=2.0)
    with pytest.raises(SkillFailure, match="has not switched within 2 s"):
        run(there, await_switch, 10.0)


def test_a_tool_that_gets_nowhere_while_it_approaches_fails() -> None:
    there = cell(IIWA)
    there.arm(ARM[IIWA]).compliance.release(np.array([0.0, 0.0, 1.0]))
    push = Push(there, arm=ARM[IIWA], along=np.array([0.0, 0.0, 1.0]), force=5.0, travel=0.2)
    there.steps = there.steps_without_control
    with pytest.raises(SkillFailure, match="neither touches anything nor gets anywhere"):
        run(there, push, 60.0)
