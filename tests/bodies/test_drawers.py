"""Drawers slide when they are pushed or pulled, and take along what lies in them; facts say how far they are open."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from simulation.cells import ARM, move_fingers, run
from simulation.cells import world as scene
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.truth.claims import find_false_claims
from skillc_runtime.motion.pose import Pose, rotation_from_angles
from skillc_runtime.primitives.move import MoveJoints, MoveLinear
from skillc_runtime.world.space.frames import move_changes, pose, relocation_changes
from skillc_runtime.world.state.changes import AddRelation, Change, ClearProperty, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import BOARDS, CONTAIN, CONTAINER, FURNITURE, ON, OPENING, SHAPE, TRAVEL
from skillc_runtime.world.state.world_state import WorldState
from space.rooms import PART, at, lab, linked, same, thing

ASIDE = 2.0
CABINET = [
    *thing("Cabinet", at(ASIDE, 0.0, 0.4), size=(0.5, 0.5, 0.4), cls=FURNITURE),
    SetProperty(lab("Cabinet"), SHAPE, "shelf"),
    SetProperty(lab("Cabinet"), BOARDS, 2),
]
DRAWER = [
    *thing("Drawer", at(ASIDE, 0.0, 0.3), size=(0.3, 0.4, 0.1), cls=CONTAINER),
    SetProperty(lab("Drawer"), TRAVEL, 0.3),
]
PART_IN_IT = [
    *thing("Part", size=(0.04, 0.04, 0.04), cls=PART),
    linked("Part", ON, "Drawer"),
    AddRelation(lab("Drawer"), CONTAIN, lab("Part")),
]


def state_with(opening_m: float = 0.0, *changes: list[Change]) -> WorldState:
    """Return a desk with a cabinet beside it, a drawer in it, and a part in that."""
    things = [*CABINET, *DRAWER, *PART_IN_IT, *(change for each in changes for change in each)]
    return scene("panda_desk").with_changes([*things, SetProperty(lab("Drawer"), OPENING, opening_m)])


def opening_m(cell: SimulatedCell) -> float:
    """Return how far the drawer really is open."""
    return float(-cell.ground_truth.body_pose(lab("Drawer")).position[1])


def pulled(cell: SimulatedCell, force_n: float, seconds: float) -> SimulatedCell:
    """Return the cell after the drawer was pulled outwards."""
    drawer = cell.data.body(cell.scene.names[lab("Drawer")])
    drawer.xfrc_applied[1] = -force_n
    cell.advance(seconds)
    drawer.xfrc_applied[1] = 0.0
    cell.advance(0.5)
    return cell


@pytest.mark.parametrize("backend", [SimulatedCell, KinematicCell])
def test_a_drawer_stays_as_far_open_as_it_is_stated(backend: Callable[..., SimulatedCell]) -> None:
    for stated in (0.0, 0.2):
        cell = backend(WorldModel(state_with(stated)))
        cell.advance(0.3)
        assert opening_m(cell) == pytest.approx(stated, abs=1e-3)


def test_a_drawer_that_is_pulled_opens_with_what_lies_in_it_as_far_as_it_can() -> None:
    cell = SimulatedCell(WorldModel(state_with()))
    cell.advance(0.2)
    in_drawer = cell.ground_truth.body_pose(lab("Drawer")).inverse() @ cell.ground_truth.body_pose(lab("Part"))
    pulled(cell, 6.0, 4.0)
    truth = cell.ground_truth
    assert opening_m(cell) == pytest.approx(0.3, abs=2e-3), "it stops at its travel"
    found = truth.body_pose(lab("Drawer")).inverse() @ truth.body_pose(lab("Part"))
    assert found.position == pytest.approx(in_drawer.position, abs=0.03), "the part may slip when the drawer stops"
    assert truth.body_pose(lab("Part")).position[1] < -0.25
    assert opening_m(pulled(cell, -6.0, 4.0)) == pytest.approx(0.0, abs=2e-3)


def test_what_is_weaker_than_the_friction_of_a_drawer_does_not_move_it() -> None:
    assert abs(opening_m(pulled(SimulatedCell(WorldModel(state_with())), 2.0, 1.0))) < 1e-3


def test_an_arm_closes_a_drawer_and_the_judge_sees_that_nobody_has_said_so() -> None:
    base = pose(scene("panda_desk"), ARM["panda_desk"])
    shut = base @ at(0.55, 0.2, 0.35)
    moved = [*relocation_changes(state_with(), lab("Cabinet"), shut @ at(0, 0.0, 0.1))]
    drawer = relocation_changes(state_with().with_changes([ClearProperty(lab("Drawer"), TRAVEL)]), lab("Drawer"), shut)
    state = state_with(0.2).with_changes([*moved, *drawer])
    cell = SimulatedCell(WorldModel(state))
    move_fingers(cell, "panda_desk", 0.0)
    down = base.rotation @ rotation_from_angles(np.pi, 0.0, np.pi / 2)
    before, behind = (Pose(base.apply(np.array([0.55, y - 0.2, 0.38])), down) for y in (-0.08, 0.1))
    arm = ARM["panda_desk"]
    run(cell, MoveJoints(cell, arm=arm, target=before, pace=0.5))
    run(cell, MoveLinear(cell, arm=arm, target=behind, speed=0.1))
    found = cell.ground_truth.body_pose(lab("Drawer")).inverse() @ pose(state, lab("Drawer"))
    assert found.position[1] < -0.05, "it was pushed in"
    assert any("Drawer" in each for each in find_false_claims(cell.scene.bodies, state, cell.ground_truth))


def test_what_lies_in_a_drawer_moves_with_it_in_the_world_model() -> None:
    shut, opened = state_with(), state_with(0.25)
    for name in ("Drawer", "Part"):
        apart = pose(opened, lab(name)).position - pose(shut, lab(name)).position
        assert apart == pytest.approx([0.0, -0.25, 0.0]), name


def test_a_drawer_that_was_seen_elsewhere_is_open_as_far_as_comes_nearest() -> None:
    state = state_with(0.1)
    for y, expected in ((-0.2, 0.2), (0.3, 0.0), (-1.0, 0.3)):
        changes = relocation_changes(state, lab("Drawer"), at(ASIDE + 0.01, y, 0.31))
        assert changes == [SetProperty(lab("Drawer"), OPENING, pytest.approx(expected))]
    seen = move_changes(state, lab("Drawer"), at(0.0, -0.2, -0.1), lab("Cabinet"))
    assert same(pose(state.with_changes(seen), lab("Drawer")), at(ASIDE, -0.2, 0.3))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ([SetProperty(lab("Drawer"), OPENING, 0.4)], "is 0.4 m open, but slides 0.3 m at most"),
        ([ClearProperty(lab("Drawer"), TRAVEL), SetProperty(lab("Drawer"), OPENING, 0.1)], "has no skillc:travel"),
        ([SetProperty(lab("Part"), TRAVEL, 0.1)], "lies free"),
    ],
)
def test_impossible_drawers_are_reported(changes: list[Change], message: str) -> None:
    with pytest.raises(SheetError, match=message):
        SimulatedCell(WorldModel(state_with(0.0, []).with_changes(changes)))


def test_a_base_stops_at_an_open_drawer() -> None:
    state = scene("ur5e_whiteboard")
    heron = lab("Heron-1")
    start, goal = pose(state, heron), pose(state, lab("Store"))
    middle = (start.position + goal.position) / 2
    drawer = [
        *thing("Drawer", at(float(middle[0]), float(middle[1]), 0.2), size=(0.3, 0.4, 0.1), cls=CONTAINER),
        SetProperty(lab("Drawer"), TRAVEL, 0.3),
    ]
    cell = SimulatedCell(WorldModel(state.with_changes(drawer)))
    cell.base(heron).drive_to(goal)
    while not cell.base(heron).at_rest:
        cell.advance(0.1)
    assert cell.base(heron).fault is not None
