"""Fingers take hold of every movable body, carry it and let it go; what has no body is refused with a sentence."""

from __future__ import annotations

import numpy as np
import pytest

from simulation.cells import run
from simulation.cells import world as scene
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.grasp import Grasp
from skillc_runtime.primitives.move import MoveLinear
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.model import WorldModel
from space.rooms import PART, at, lab, skillc, thing

ARM, HAND, THING = lab("Panda-1"), lab("Hand-1"), lab("Thing")
IN_HAND = at(0, 0, 0)


def closed_on(shape: str, sized: bool = True) -> KinematicCell:
    """Return a cell whose fingers have closed where a thing of 5 cm is, which floats between them."""
    empty = KinematicCell(WorldModel(scene("panda_desk")))
    between = empty.arm(ARM).measured.pose
    size = (0.05, 0.05, 0.05) if sized else ()
    state = scene("panda_desk").with_changes(
        [*thing("Thing", between, size=size, cls=PART), SetProperty(THING, skillc("shape"), shape)]
    )
    cell = KinematicCell(WorldModel(state))
    gripper = cell.gripper(HAND)
    gripper.move(gripper.max_opening_m, 30.0)
    cell.advance(1.5)
    gripper.move(0.0, 30.0)
    cell.advance(1.5)
    return cell


def move(cell: KinematicCell, up_m: float) -> None:
    """Move the tool straight up."""
    start = cell.arm(ARM).motion.stopping_pose()
    target = Pose(start.position + np.array([0.0, 0.0, up_m]), start.rotation)
    run(cell, MoveLinear(cell, arm=ARM, target=target, speed=0.2))


@pytest.mark.parametrize("shape", ["box", "cylinder", "sphere", "capsule", "bin"])
def test_fingers_hold_bodies_of_all_shapes_and_let_them_go(shape: str) -> None:
    cell = closed_on(shape)
    gripper, truth = cell.gripper(HAND), cell.ground_truth
    assert gripper.touches(THING)
    assert gripper.opening_m == pytest.approx(0.05, abs=0.002)
    before = truth.body_pose(THING)
    run(
        cell, Grasp(cell, arm=ARM, gripper=HAND, object=THING, at=pose(cell.world.snapshot(), THING), place=lab("Cell"))
    )
    assert gripper.holding == THING
    move(cell, -0.1)
    assert truth.body_pose(THING).position - before.position == pytest.approx([0, 0, -0.1], abs=0.002)
    gripper.detach()
    left = truth.body_pose(THING).position
    gripper.move(gripper.max_opening_m, 30.0)
    cell.advance(1.0)
    assert truth.body_pose(THING).position == pytest.approx(left, abs=1e-6)


def test_what_has_no_size_cannot_be_held_and_says_why() -> None:
    cell = closed_on("box", sized=False)
    gripper = cell.gripper(HAND)
    assert not gripper.touches(THING)
    assert not gripper.touches(lab("Nothing"))
    with pytest.raises(KeyError):
        cell.ground_truth.body_pose(THING)
    with pytest.raises(RuntimeError, match="nothing keeps the fingers"):
        gripper.attach(THING, IN_HAND, 0.1)


def test_fingers_that_hold_something_else_do_not_count_what_has_no_body_as_held() -> None:
    cell = closed_on("box")
    with pytest.raises(RuntimeError, match="cannot be held: it had no body when the cell was built"):
        cell.gripper(HAND).attach(lab("Nothing"), IN_HAND, 0.1)
