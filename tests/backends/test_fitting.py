"""A controller that does not fit its arm is told before anything moves."""

from __future__ import annotations

import re

import pytest
from msgspec.structs import replace

from simulation.cells import ARM, LAB, world
from skillc_runtime.backends.mujoco.arm import SimulatedArm
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.arms.driver_factory import make_driver
from skillc_runtime.world.state.changes import Change, RemoveRelation, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import COMPLIANT_CONTROLLER, HAS_SENSOR, SKILLC

UR5E, IIWA = "ur5e_whiteboard", "iiwa_table"


def controlled_by(scene: str, name: str) -> Change:
    return SetProperty(ARM[scene], COMPLIANT_CONTROLLER, name)


@pytest.mark.parametrize(
    ("scene", "change", "says"),
    [
        (UR5E, controlled_by(UR5E, "impedance"), "has no number skillc:dampingFloor"),
        (IIWA, controlled_by(IIWA, "forward_dynamics"), "has no number skillc:admittance"),
        (IIWA, controlled_by(IIWA, "forward_dynamics_velocity"), "has no number skillc:admittance"),
        (UR5E, RemoveRelation(ARM[UR5E], HAS_SENSOR, LAB + "ForceTorque-1"), "needs a force/torque sensor"),
    ],
)
def test_what_is_missing_is_told(scene: str, change: Change, says: str) -> None:
    with pytest.raises(SheetError, match=re.escape(says)):
        SimulatedCell(WorldModel(world(scene).with_changes([change])))


def test_a_law_whose_commands_the_arm_does_not_take_is_told() -> None:
    sheet = {"dampingFloor": 60.0, "rotationalDampingFloor": 3.0, "nullspaceStiffness": 10.0, "torqueRate": 1000.0}
    facts = [SetProperty(SKILLC + "ur5e-sheet", SKILLC + name, value) for name, value in sheet.items()]
    with pytest.raises(
        SheetError, match="lab:Ur5e-1 has the controller 'impedance': the arm takes position and velocity"
    ):
        SimulatedCell(WorldModel(world(UR5E).with_changes([controlled_by(UR5E, "impedance"), *facts])))


def test_an_arm_that_takes_positions_only_refuses_speeds() -> None:
    there = SimulatedCell(WorldModel(world(UR5E)))
    facts = replace(there.scene.arms[0], modes=("position",), controller="forward_dynamics_velocity", gripper=None)
    start = there.variation.start(facts)
    arm = SimulatedArm(facts, there.scene.names, there.physics, start, 0)
    with pytest.raises(SheetError, match="the arm takes position commands, not velocity commands"):
        make_driver(facts, arm, there.period_s)
