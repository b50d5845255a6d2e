"""Path planning avoids the solids that bodies are made of: the room in a bin is free, its walls are not."""

from __future__ import annotations

import numpy as np

from simulation.cells import world as scene
from skillc_runtime.collision.arm_assembly import read_arm_assembly
from skillc_runtime.collision.scenery import read_scenery
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.terms import CONTAIN, CONTAINER
from space.rooms import PART, at, lab, skillc, thing

ORIGIN = at(0, 0, 0)


def test_the_room_in_a_bin_is_free_and_its_walls_are_not() -> None:
    state = scene("panda_desk").with_changes(thing("Bin", at(0.5, 0.5, 0.1), size=(0.2, 0.2, 0.1), cls=CONTAINER))
    walls = [each.solid_at(ORIGIN) for each in read_scenery(state, ORIGIN).blocks if each.name.endswith("Bin")]
    assert len(walls) == 5

    def is_free(*point: float) -> bool:
        return all((np.abs(np.array(point) - each.place.position) > each.half).any() for each in walls)

    assert is_free(0.5, 0.5, 0.1)
    assert not is_free(0.401, 0.5, 0.1)
    assert not is_free(0.5, 0.5, 0.051)


def test_a_held_body_keeps_its_shape_in_the_hand() -> None:
    hand, arm = lab("Hand-1"), lab("Panda-1")
    held = thing("Ball", at(0, 0, 0.02), frame="hand", size=(0.04, 0.04, 0.04), cls=PART)
    state = scene("panda_desk").with_changes(
        [*held, SetProperty(lab("Ball"), skillc("shape"), "sphere"), AddRelation(hand, CONTAIN, lab("Ball"))]
    )
    assembly = read_arm_assembly(state, arm, {hand: 0.04})
    assert assembly.hand is not None
    (ball,) = assembly.hand.held
    assert ball.kind == "sphere"
    np.testing.assert_allclose(ball.solid_at(Pose.of((0, 0, 1))).place.position, [0, 0, 1.02])
