"""Inputs and outputs of a simulated cell: outputs are as skills set them, inputs as the scene states."""

from __future__ import annotations

import pytest

from simulation.cells import LAB, world
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.devices.arm import NotOffered
from skillc_runtime.devices.device_map import NoSuchDevice
from skillc_runtime.primitives.io_points import AwaitInput, SetOutput
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import AddIndividual, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import INPUT_POINT, LEVEL, OUTPUT_POINT

LAMP, PRESSURE = LAB + "Lamp-1", LAB + "Pressure-1"

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def cell() -> KinematicCell:
    """A cell with a lamp and a sensor of pressure."""
    wired = [
        AddIndividual(LAMP, (OUTPUT_POINT,)),
        AddIndividual(PRESSURE, (INPUT_POINT,)),
        SetProperty(PRESSURE, LEVEL, 4.5),
    ]
    return KinematicCell(WorldModel(world("iiwa_table").with_changes(wired)))


def run(cell: KinematicCell, primitive: Primitive) -> None:
    primitive.start()
    while primitive.tick() is not Status.SUCCESS:
        cell.advance(0.01)


def test_an_output_is_set_and_an_input_read(cell: KinematicCell) -> None:
    run(cell, SetOutput(cell, output=LAMP, level=1.0))
    assert cell.io_point(LAMP).level == cell.world.snapshot().value(LAMP, LEVEL) == 1.0
    run(cell, AwaitInput(cell, point=PRESSURE, least=4.0, most=5.0, patience=1.0))
    assert cell.world.snapshot().value(PRESSURE, LEVEL) == 4.5


def test_an_input_that_does_not_come_fails_the_skill_with_what_was_awaited(cell: KinematicCell) -> None:
    with pytest.raises(SkillFailure, match=r"lab:Pressure-1 is at 4\.5, not at least 5 and at most 6, after 0\.1 s"):
        run(cell, AwaitInput(cell, point=PRESSURE, least=5.0, most=6.0, patience=0.1))


def test_inputs_are_not_set_and_what_is_not_there_is_named(cell: KinematicCell) -> None:
    with pytest.raises(NotOffered, match="an input is not set"):
        cell.io_point(PRESSURE).set(1.0)
    with pytest.raises(NoSuchDevice, match=r"no I/O point .*Lamp-2; it has lab:Lamp-1, lab:Pressure-1"):
        cell.io_point(LAB + "Lamp-2")
