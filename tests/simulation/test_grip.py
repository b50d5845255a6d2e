"""What friction in the fingers does not bear slips out of them; it is noticed as soon as the fingers close further."""

import numpy as np
import pytest
from cells import ARM, ERASER, GRIPPER, HANDS, at_the_eraser, eraser_height, grasp, lift, reach_for_eraser

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.primitives.fact_monitor import FactMonitor
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.facts import RelationFact
from skillc_runtime.world.state.terms import CONTAIN, LOCATED, WEIGHT

FORCE, FRICTION = 20.0, 1.0
"""N; of rubber pads on a painted handle, as the grippers' models have it."""

LOST = r"lab:\S+ has lost lab:Eraser-1: its fingers have closed from 2\d mm to \d+ mm|a force of \d+ N on the tool"
"""What is said first: the fingers have closed, or the arm felt that a load of 5 kg was suddenly missing."""

BORNE_KG = 2 * FRICTION * FORCE / 9.81


def grasped(scene: str, kg: float, force: float) -> SimulatedCell:
    there = at_the_eraser(scene, changes=[SetProperty(ERASER, WEIGHT, kg)])
    reach_for_eraser(there, scene, force)
    grasp(there, scene)
    there.world.commit([AddRelation(GRIPPER[scene], CONTAIN, ERASER)])
    return there


def test_a_grip_bears_what_its_force_and_friction_bear() -> None:
    scene = "panda_desk"
    there = grasped(scene, 0.8 * BORNE_KG, FORCE)
    before = eraser_height(there)
    lift(there, scene)
    assert there.gripper(GRIPPER[scene]).holding == ERASER
    assert eraser_height(there) == pytest.approx(before + 0.1, abs=0.01)


@pytest.mark.parametrize("scene", HANDS)
def test_a_thing_too_heavy_for_the_grip_slips_and_the_motion_fails(scene: str) -> None:
    there = grasped(scene, 1.2 * BORNE_KG, FORCE)
    before = eraser_height(there)
    with pytest.raises(SkillFailure, match=LOST):
        lift(there, scene)
    there.advance(1.0)
    assert there.gripper(GRIPPER[scene]).holding is None
    assert eraser_height(there) == pytest.approx(before, abs=0.01), "it lies where it lay"
    told = FactMonitor(there).withdraw_contradicted()
    assert told is not None and "reports that it holds nothing, but the world model said" in told
    assert FactMonitor(there).withdraw_contradicted() is None, "it was withdrawn"
    after = there.world.snapshot()
    assert not after.holds(GRIPPER[scene], CONTAIN, ERASER)
    assert np.linalg.norm(pose(after, ERASER).position[2] - before) < 0.06, "where it was lost, as far as is known"
    assert after.value(ERASER, LOCATED) is False
    told_by = there.world.deciding_write(RelationFact(GRIPPER[scene], CONTAIN, ERASER, holds=False))
    assert told_by is not None and told_by.evidence == "reported"


@pytest.mark.parametrize("scene", HANDS)
def test_an_arm_bears_the_mass_that_is_known_so_that_far_more_does_not_throw_it(scene: str) -> None:
    there = at_the_eraser(scene, changes=[SetProperty(ERASER, WEIGHT, 35.0)])
    there.world.commit([SetProperty(ERASER, WEIGHT, 0.1)])
    reach_for_eraser(there, scene)
    grasp(there, scene)
    before = there.arm(ARM[scene]).measured.pose.position.copy()
    with pytest.raises(SkillFailure, match=LOST + r"|, or it weighs more than is known"):
        lift(there, scene)
    there.advance(1.0)
    assert there.is_at_rest()
    assert np.linalg.norm(there.arm(ARM[scene]).measured.pose.position - before) < 0.11, "no farther than it was to go"


def test_slippery_fingers_do_not_hold() -> None:
    scene = "iiwa_table"
    there = at_the_eraser(scene, changes=[SetProperty(ERASER, WEIGHT, 0.5)])
    handle = there.model.geom(there.scene.names[ERASER] + "/handle").id
    there.model.geom_friction[[*there.gripper(GRIPPER[scene]).pads, handle], 0] = 0.05
    reach_for_eraser(there, scene)
    grasp(there, scene)
    with pytest.raises(SkillFailure, match="has lost lab:Eraser-1"):
        lift(there, scene)
    assert there.arm(ARM[scene]).fault is None, "it was told once"


def test_a_jolt_is_no_slip() -> None:
    scene = "iiwa_table"
    there = grasped(scene, 0.12, 30.0)
    lift(there, scene)
    block = there.model.body(there.scene.names[ERASER] + "/block").id
    for seconds, holds in ((0.02, True), (0.1, False)):
        there.data.xfrc_applied[block, :3] = (0.0, 0.0, -90.0)
        there.advance(seconds)
        there.data.xfrc_applied[block] = 0.0
        there.advance(0.1)
        assert (there.gripper(GRIPPER[scene]).carries == ERASER) is holds
