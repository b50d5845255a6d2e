"""An arm that cannot be controlled is known to the world model, for good, and the skills that need it do not run."""

from collections.abc import Callable

import mujoco
import numpy as np
import pytest
from cells import ARM, SCENES, cell

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.control.controller import ControlError
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.transactions import ChangeEvent

DEVICE_STATE = "https://w3id.org/skillc/core#deviceState"


def faults(there: SimulatedCell) -> list[ChangeEvent]:
    """Return the list that every later note of a fault goes into."""
    found: list[ChangeEvent] = []
    there.world.subscribe(lambda event: found.append(event) if "Fault" in str(event.changes) else None)
    return found


def device_state(there: SimulatedCell, scene: str) -> object:
    return there.world.snapshot().value(ARM[scene], DEVICE_STATE)


@pytest.mark.parametrize("scene", SCENES)
def test_an_arm_that_reports_no_numbers_is_broken_once(scene: str) -> None:
    there = cell(scene)
    found = faults(there)
    there.advance(0.01)
    assert device_state(there, scene) == "Idle"
    joint = there.arms[ARM[scene]]._q
    good = joint.copy()
    for _ in range(2):
        joint[:] = np.nan
        with pytest.raises(ControlError, match="not a number"):
            there.advance(0.01)
        joint[:] = good
        mujoco.mj_forward(there.model, there.data)
    assert np.isfinite(there.data.ctrl).all()
    assert device_state(there, scene) == "Fault"
    assert [event.origin.partition(": ")[2] for event in found] == ["the arm reports something that is not a number"]
    there.stops.clear()
    assert device_state(there, scene) == "Idle"


@pytest.mark.parametrize("scene", SCENES)
def test_after_bad_numbers_a_yielding_arm_can_still_be_made_stiff(scene: str) -> None:
    there = cell(scene)
    arm, link = there.arm(ARM[scene]), there.arms[ARM[scene]]._sensing.link.position
    arm.compliance.release(arm.measured.pose.rotation[:, 2])
    there.advance(0.1)
    before = arm.measured.pose.position
    link[:] = np.nan
    with pytest.raises(ControlError, match="not a number"):
        there.advance(0.001)
    arm.compliance.push_off()
    arm.compliance.restore()
    mujoco.mj_forward(there.model, there.data)
    there.advance(0.5)
    assert np.abs(arm.measured.pose.position - before).max() < 1e-3
    assert arm.compliance.commanded_stiffness.all()


def test_a_blocked_arm_is_broken_and_a_new_cell_starts_afresh() -> None:
    scene = "ur5e_whiteboard"
    there = cell(scene)
    found, arm = faults(there), there.arm(ARM[scene])
    there.model.actuator_gainprm[:] = 0.0
    there.model.actuator_biasprm[:] = 0.0
    arm.motion.move_joints(arm.measured.q + 1.0, 1.0)
    there.advance(1.5)
    assert device_state(there, scene) == "Fault"
    assert len(found) == 1
    assert "blocked" in found[0].origin
    again = SimulatedCell(WorldModel(there.world.snapshot()))
    assert device_state(again, scene) == "Idle"


@pytest.mark.parametrize("lost", [True, False], ids=["lost", "emergency stop"])
def test_an_arm_whose_stop_is_over_is_faulty_until_somebody_acknowledges_it(lost: bool) -> None:
    scene = "iiwa_table"
    there = cell(scene)
    stop: Callable[[bool], None] = (
        (lambda on: there.stops.lose(ARM[scene], on)) if lost else (lambda on: there.stops.press(on))
    )
    stop(True)
    there.advance(0.01)
    assert device_state(there, scene) == "Fault"
    stop(False)
    there.advance(0.01)
    assert device_state(there, scene) == "Fault"
    there.stops.clear()
    assert device_state(there, scene) == "Idle"


def test_an_arm_that_a_skill_stopped_is_not_broken() -> None:
    scene = "iiwa_table"
    there = cell(scene)
    found = faults(there)
    there.arm(ARM[scene]).abort("nothing to push against")
    there.advance(0.1)
    assert device_state(there, scene) == "Idle"
    assert not found


def test_a_state_once_told_is_idle_even_where_the_scene_says_fault() -> None:
    world = WorldModel(cell("iiwa_table").world.snapshot())
    world.commit([SetProperty(ARM["iiwa_table"], DEVICE_STATE, "Fault")])
    assert device_state(SimulatedCell(world), "iiwa_table") == "Idle"
