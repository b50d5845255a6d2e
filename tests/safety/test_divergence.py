"""A simulation that diverges stops for ever: the run fails with what diverged and when, and all its ends are told."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from safety.faults import LIBRARY, prepared
from simulation.cells import ARM, GRIPPER, cell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.mujoco.divergence import SimulationDiverged
from skillc_runtime.devices.backend import BackendBroken
from skillc_runtime.execution.execute import execute_task
from skillc_runtime.motion.pose import Pose
from skillc_runtime.recording.events import Event, NodeEnded, NodeStarted, TaskEnded
from skillc_runtime.world.state.terms import DEVICE_STATE

SCENES = ("iiwa_table", "ur5e_whiteboard", "panda_desk")
HUGE_N = 1e14


@pytest.mark.parametrize("scene", SCENES)
def test_a_run_whose_simulation_diverges_fails_and_tells_all_ends(scene: str) -> None:
    there, told = cell(scene), list[Event]()
    ticks = 0

    def push_hard() -> None:
        nonlocal ticks
        ticks += 1
        there.push_hand(ARM[scene], np.array([HUGE_N if ticks == 5 else 0.0, 0.0, 0.0]))

    body = prepared(there, scene, f"{scene} Push")
    execution = execute_task(body, LIBRARY, there, (told.append,), push_hard)
    assert execution.status == "failed"
    assert execution.failure is not None
    assert execution.failure.message == there.broken
    assert there.broken is not None
    assert there.broken.startswith("the simulation diverged at 0.05")
    assert f"the acceleration of {there.scene.names[ARM[scene]]}/" in there.broken
    started = [event.node for event in told if isinstance(event, NodeStarted)]
    assert len(started) > 2
    assert sorted(started) == sorted(event.node for event in told if isinstance(event, NodeEnded))
    assert isinstance(told[-1], TaskEnded)
    assert there.world.snapshot().value(ARM[scene], DEVICE_STATE) == "Fault"
    again = execute_task(body, LIBRARY, there)
    assert again.status == "failed"
    assert again.failure is not None
    assert again.failure.message == there.broken
    stands_still(there)


def stands_still(there: SimulatedCell) -> None:
    """Nothing moves and no time passes in a broken cell; securing it finds nothing that could still do harm."""
    before, now = there.drawing.posture().joints, there.now
    for _ in range(3):
        with pytest.raises(BackendBroken, match=str(there.broken)[:30]):
            there.advance(0.01)
    there.secure()
    assert there.is_at_rest()
    assert there.now == now
    np.testing.assert_array_equal(there.drawing.posture().joints, before)


def nan_force(there: SimulatedCell) -> None:
    there.push_hand(ARM["iiwa_table"], np.full(3, math.nan))


def nan_opening(there: SimulatedCell) -> None:
    there.gripper(GRIPPER["iiwa_table"]).move(math.nan, 20.0)


def absurd_speed(there: SimulatedCell) -> None:
    there.data.qvel[2] = 1e12


def absurd_inertia(there: SimulatedCell) -> None:
    """The arm's links have lost their masses and inertias, and its motors their rotors."""
    there.model.body_mass[:], there.model.body_inertia[:], there.model.dof_armature[:] = 0.0, 0.0, 0.0


@pytest.mark.parametrize(
    ("disturb", "what"),
    [
        (nan_force, "the acceleration of lab:Iiwa-1/joint1"),
        (nan_opening, "the command of lab:Robotiq-1/opening"),
        (absurd_speed, "the speed of lab:Iiwa-1/joint3"),
        (absurd_inertia, "the (inertia|acceleration) of lab:"),
    ],
)
def test_what_diverged_is_named(disturb: object, what: str) -> None:
    assert callable(disturb)
    there = cell("iiwa_table")
    there.advance(0.1)
    assert there.broken is None
    disturb(there)
    with pytest.raises(SimulationDiverged, match=rf"the simulation diverged at 0\.1\d\d s: {what}.* too large or no"):
        there.advance(0.1)
    stands_still(there)


def test_mujoco_itself_would_begin_again() -> None:
    there = cell("iiwa_table")
    there.advance(0.1)
    there.model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    there.push_hand(ARM["iiwa_table"], np.full(3, math.nan))
    mujoco.mj_step2(there.model, there.data)
    assert there.now < 0.1, "MuJoCo has changed, and the flag may not be needed any more"


def test_a_hard_push_that_the_physics_can_bear_breaks_nothing() -> None:
    there = cell("iiwa_table")
    there.push_hand(ARM["iiwa_table"], np.array([200.0, 0.0, 0.0]))
    there.advance(0.5)
    assert there.broken is None


def test_a_base_refuses_a_goal_that_is_no_number() -> None:
    there = cell("ur5e_whiteboard")
    (robot,) = (each.individual for each in there.scene.bases)
    with pytest.raises(ValueError, match="no number"):
        there.base(robot).drive_to(Pose.of((math.nan, 0.0, 0.0)))
    assert there.is_at_rest()
