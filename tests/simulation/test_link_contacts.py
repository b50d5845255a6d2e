"""Links, hands and tools meet what stands around in the simulation; the ground truth says what touched what."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from simulation.cells import ARM, ERASER, LAB, cell, grasp, lift, reach_for_eraser, world
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.model.contact_bits import LINK
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import AddIndividual, Change, RemoveIndividual, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import FURNITURE, SIZE

IIWA, SHELF = ARM["iiwa_table"], LAB + "Shelf-1"
BESIDE_THE_ELBOW = (0.15, 0.14, 1.55)


def shelf(place: tuple[float, float, float], size: tuple[float, float, float] = (0.4, 0.04, 0.4)) -> list[Change]:
    """Return a board with the middle of its top at a place, in m in the world."""
    numbers = [SetProperty(SHELF, name, extent) for name, extent in zip(SIZE, size, strict=True)]
    return [AddIndividual(SHELF, (FURNITURE,)), *numbers, *placement_changes(SHELF, Pose(np.array(place), np.eye(3)))]


def hidden_shelf(scene: str, place: tuple[float, float, float], **how: tuple[float, float, float]) -> SimulatedCell:
    """Return a cell with a board that the world model does not have."""
    there = SimulatedCell(WorldModel(world(scene).with_changes(shelf(place, **how))))
    there.world.commit([RemoveIndividual(SHELF)], "test", "assumed")
    return there


def push_elbow(there: SimulatedCell) -> None:
    """Turn the first joint, which moves the elbow by 16 cm."""
    arm = there.arm(IIWA)
    arm.motion.move_joints(arm.measured.q + np.array([0.6, 0, 0, 0, 0, 0, 0]), 0.3)
    there.advance(2.0)


def test_a_link_that_meets_a_board_is_recorded_with_its_force() -> None:
    there = hidden_shelf("iiwa_table", BESIDE_THE_ELBOW)
    push_elbow(there)
    found = there.ground_truth.contacts()
    assert {(each.part, each.other) for each in found} <= {(f"lab:Iiwa-1 link{n}", "lab:Shelf-1") for n in (3, 4, 5)}
    assert found
    assert 10.0 < max(each.peak_force_n or 0.0 for each in found) < 500.0
    assert all(0.0 < each.start_s <= each.end_s <= there.now for each in found)


def test_a_link_with_nothing_in_its_way_touches_nothing() -> None:
    there = cell("iiwa_table")
    push_elbow(there)
    assert there.ground_truth.contacts() == ()


@pytest.mark.parametrize("scene", ["iiwa_table", "ur5e_whiteboard", "panda_desk"])
def test_no_posture_of_a_data_sheet_makes_an_arm_touch_itself(scene: str) -> None:
    there = cell(scene)
    geoms = there.data.contact.geom
    assert not (there.model.geom_contype[geoms] == LINK).all(axis=1).any()
    assert (there.model.geom_contype == LINK).sum() > 10


def test_an_arm_that_is_folded_onto_itself_meets_itself() -> None:
    there = cell("iiwa_table")
    there.data.qpos[:7] = (0.0, -2.09, 0.0, 2.09, 0.0, 2.09, 0.0)
    mujoco.mj_forward(there.model, there.data)
    links = [pair for pair in there.data.contact.geom if (there.model.geom_contype[pair] == LINK).all()]
    assert links


def test_a_grasp_and_what_it_lifts_are_no_unwanted_contact() -> None:
    there = cell("iiwa_table")
    reach_for_eraser(there, "iiwa_table")
    grasp(there, "iiwa_table")
    lift(there, "iiwa_table")
    assert there.ground_truth.contacts() == ()
    handle = there.model.geom(there.scene.names[ERASER] + "/handle").id
    assert there.model.geom_contype[handle] == LINK, "what a gripper holds meets what its arm meets"
