"""Fingers close on a thing, contact from both sides makes a grasp, and the arm knows what it carries."""

import re

import numpy as np
import pytest
from cells import (
    ARM,
    ERASER,
    GRIPPER,
    HANDS,
    PLACE,
    SCENES,
    at_the_eraser,
    cell,
    eraser_height,
    grasp,
    lift,
    move_fingers,
    reach_for_eraser,
    run,
)

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.primitives.grasp import Release
from skillc_runtime.primitives.gripper import ParallelGripper
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.world.space.frame_tree import WORLD_FRAME, FrameError
from skillc_runtime.world.space.frames import placement_changes, pose
from skillc_runtime.world.state.changes import AddRelation, ClearProperty, SetProperty
from skillc_runtime.world.state.terms import (
    BASE_FRAME_ID,
    CONTAIN,
    FRAME_ID,
    GRASP_WIDTH,
    LOCATED,
    POSITION,
    SKILLC,
    WIDTH_TOLERANCE,
)


def release(there: SimulatedCell, scene: str) -> Release:
    return Release(there, arm=ARM[scene], gripper=GRIPPER[scene], object=ERASER, to=PLACE[scene])


@pytest.mark.parametrize("scene", HANDS)
def test_a_grasped_eraser_is_lifted_and_let_go_where_something_carries_it(scene: str) -> None:
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    lying = eraser_height(there)
    assert there.gripper(GRIPPER[scene]).touches(ERASER)
    assert there.gripper(GRIPPER[scene]).opening_m == pytest.approx(0.025, abs=0.003)
    grasp(there, scene)
    assert there.gripper(GRIPPER[scene]).holding == ERASER
    lift(there, scene)
    assert eraser_height(there) == pytest.approx(lying + 0.1, abs=0.002)
    letting_go = release(there, scene)
    with pytest.raises(SkillFailure, match="nothing supports lab:Eraser-1 where it should stand"):
        run(there, letting_go)
    letting_go.halt("failed")
    with pytest.raises(SkillFailure, match="only Release lets it go"):
        move_fingers(there, scene, 0.065)
    there.advance(0.5)
    assert there.gripper(GRIPPER[scene]).holding == ERASER
    assert eraser_height(there) == pytest.approx(lying + 0.07, abs=0.005), "it was lowered by 3 cm, and is held"
    lift(there, scene, -0.065)
    run(there, release(there, scene))
    assert there.gripper(GRIPPER[scene]).holding is None
    assert pose(there.world.snapshot(), ERASER).position[2] == pytest.approx(lying, abs=0.002)


def test_a_held_thing_is_somewhere_in_the_hand() -> None:
    scene = "iiwa_table"
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    before = there.world.snapshot()
    in_hand = pose(before, ERASER + "-grasp").inverse() @ pose(before, ERASER)
    grasp(there, scene)
    held = there.world.snapshot()
    with pytest.raises(FrameError, match="does not say where lab:Robotiq-1 is"):
        pose(held, ERASER)
    assert held.value(ERASER, BASE_FRAME_ID) == held.value(GRIPPER[scene], FRAME_ID)
    assert [held.value(ERASER, axis) for axis in POSITION] == pytest.approx(in_hand.position)
    reached = placement_changes(GRIPPER[scene], Pose.of((1.0, 2.0, 3.0)))
    there.world.commit(reached)
    assert pose(there.world.snapshot(), ERASER).position == pytest.approx(np.array([1.0, 2.0, 3.0]) + in_hand.position)


@pytest.mark.parametrize(("opened_m", "free"), [(0.002, False), (0.01, True)])
def test_a_release_halted_half_way_tells_what_is_true(opened_m: float, free: bool) -> None:
    scene = "iiwa_table"
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    grasp(there, scene)
    there.world.commit([AddRelation(GRIPPER[scene], CONTAIN, ERASER)])
    hand, letting_go = there.gripper(GRIPPER[scene]), release(there, scene)
    held_at = hand.opening_m
    letting_go.start()
    while hand.opening_m < held_at + opened_m:
        assert letting_go.tick() is Status.RUNNING
        there.advance(0.001)
    letting_go.tick()
    letting_go.halt("enough")
    after = there.world.snapshot()
    assert after.holds(PLACE[scene], CONTAIN, ERASER) is free
    assert after.holds(GRIPPER[scene], CONTAIN, ERASER) is not free
    assert (hand.holding is None) is free
    assert (after.value(ERASER, BASE_FRAME_ID) == WORLD_FRAME) is free


def test_fingers_that_cannot_open_do_not_let_go() -> None:
    scene = "iiwa_table"
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    grasp(there, scene)
    hand, letting_go = there.gripper(GRIPPER[scene]), release(there, scene)
    letting_go.start()
    while not hand.moving:
        letting_go.tick()
        there.advance(0.01)
    hand.stop()
    with pytest.raises(SkillFailure, match=r"came to rest 2\d mm open: lab:Eraser-1 is not free"):
        letting_go.tick()
    assert hand.holding == ERASER


def test_fingers_feel_that_something_is_as_wide_as_what_they_should_hold() -> None:
    scene = "iiwa_table"
    there = at_the_eraser(scene, changes=[SetProperty(ERASER, GRASP_WIDTH, 0.04)])
    reach_for_eraser(there, scene)
    with pytest.raises(SkillFailure, match=r"its fingers stand 2\d\.\d mm open, lab:Eraser-1 is 40\.0 mm wide"):
        grasp(there, scene)
    assert there.gripper(GRIPPER[scene]).holding is None
    there.world.commit([SetProperty(ERASER, WIDTH_TOLERANCE, 0.02)])
    grasp(there, scene)
    assert there.gripper(GRIPPER[scene]).holding == ERASER


def test_what_somebody_takes_away_is_missed_when_the_fingers_have_closed() -> None:
    scene = "iiwa_table"
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    grasp(there, scene)
    hand, joint = there.gripper(GRIPPER[scene]), there.model.joint(there.scene.names[ERASER] + "/free").qposadr[0]
    hand.lose()
    there.data.qpos[joint] += 0.3
    assert hand.carries is None
    assert hand.holding == ERASER, "no finger has moved yet"
    there.advance(1.0)
    assert hand.holding is None
    fault = there.arm(ARM[scene]).take_fault()
    assert fault is not None and re.search(r"lost lab:Eraser-1: its fingers have closed from 2\d mm", fault)


def test_a_measured_opening_has_the_errors_of_the_data_sheet_and_follows_from_the_seed() -> None:
    def openings(seed: int) -> list[float]:
        there, found = cell("iiwa_table", seed), []
        for _ in range(200):
            there.advance(0.02)
            found.append(there.gripper(GRIPPER["iiwa_table"]).opening_m)
        return found

    first, wide = openings(1), 0.155 / 2
    assert first == openings(1)
    assert 0.00015 < np.std(first) < 0.00025
    biases = [float(np.mean(each)) - wide for each in (first, openings(2), openings(3))]
    assert 1e-4 < max(map(abs, biases)) < 0.0011
    assert len({round(each, 6) for each in biases}) == 3


def mean_force(there: SimulatedCell, arm: CompliantArmDriver) -> Array:
    """Return what the arm feels, in N, the noise of its sensors evened out."""
    felt = []
    for _ in range(100):
        there.advance(0.001)
        felt.append(arm.measured.wrench[:3])
    return np.asarray(np.mean(felt, axis=0))


@pytest.mark.parametrize("scene", SCENES)
def test_the_tool_centre_point_becomes_the_felt_and_the_weight_is_known(scene: str) -> None:
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    grasp(there, scene)
    lift(there, scene)
    there.advance(0.5)
    arm = there.arm(ARM[scene])
    felt = there.data.site(there.scene.names[ERASER] + "/face")
    np.testing.assert_allclose(arm.measured.pose.position, felt.xpos, atol=0.002)
    np.testing.assert_allclose(arm.measured.pose.rotation, felt.xmat.reshape(3, 3), atol=0.01)
    assert np.linalg.norm(mean_force(there, arm)) < 0.3, "the weight of hand and eraser must not look like a contact"


@pytest.mark.parametrize("scene", SCENES)
def test_nothing_is_grasped_where_no_eraser_is(scene: str) -> None:
    there = at_the_eraser(scene)
    joint = there.model.joint(there.scene.names[ERASER] + "/free").qposadr[0]
    there.data.qpos[joint] += 0.2
    reach_for_eraser(there, scene)
    assert not there.gripper(GRIPPER[scene]).touches(ERASER)
    with pytest.raises(SkillFailure, match=r": nothing keeps its fingers from closing, they stand [01] mm open"):
        grasp(there, scene)
    assert there.world.snapshot().value(ERASER, LOCATED) is False, "it is not believed where it was any more"
    with pytest.raises(RuntimeError):
        there.gripper(GRIPPER[scene]).attach(ERASER, pose(there.world.snapshot(), ERASER), 0.1)
    assert there.gripper(GRIPPER[scene]).holding is None


def test_one_finger_is_no_grasp() -> None:
    there = cell("iiwa_table")
    reach_for_eraser(there, "iiwa_table")
    hand = there.gripper(GRIPPER["iiwa_table"])
    pads = sorted(hand.pads)
    assert len(pads) == 3
    there.model.geom_contype[pads[0]] = there.model.geom_conaffinity[pads[0]] = 0
    there.advance(0.3)
    assert not hand.touches(ERASER), "the thumb touches nothing any more"


def test_fingers_stop_with_the_force_they_were_given() -> None:
    scene = "ur5e_whiteboard"
    there = at_the_eraser(scene)
    reach_for_eraser(there, scene)
    move_fingers(there, scene, 0.0, force=12.0)
    there.advance(0.3)
    name = there.scene.names[GRIPPER[scene]]
    assert abs(there.data.actuator(f"{name}/opening").force[0]) == pytest.approx(12.0, rel=0.01)


def test_a_gripper_refuses_to_open_too_wide() -> None:
    there = cell("ur5e_whiteboard")
    with pytest.raises(SkillFailure, match="opens to 110 mm, not to 150 mm"):
        ParallelGripper(there, gripper=GRIPPER["ur5e_whiteboard"], opening=0.15, force=20.0).start()


def test_three_fingers_move_in_the_steps_of_their_sheet() -> None:
    there = cell("iiwa_table")
    move_fingers(there, "iiwa_table", 0.1)
    count = round(0.1 / 0.155 * 255) * 0.155 / 255
    assert there.gripper(GRIPPER["iiwa_table"]).opening_m == pytest.approx(count, abs=2e-3)


def test_three_fingers_need_the_steps_of_their_sheet() -> None:
    there = cell("iiwa_table")
    there.world.commit([ClearProperty(SKILLC + "robotiq-3f-sheet", SKILLC + "commandSteps")])
    with pytest.raises(SkillFailure, match="skillc:robotiq-3f-sheet has no number skillc:commandSteps"):
        move_fingers(there, "iiwa_table", 0.1)


def test_releasing_what_is_not_held_fails() -> None:
    there = cell("iiwa_table")
    with pytest.raises(SkillFailure, match="holds nothing"):
        release(there, "iiwa_table").start()


def test_the_same_seed_gives_the_same_recording() -> None:
    def recorded(seed: int) -> bytes:
        there = at_the_eraser("iiwa_table", seed)
        reach_for_eraser(there, "iiwa_table")
        grasp(there, "iiwa_table")
        lift(there, "iiwa_table")
        rows = there.ground_truth.recording(ERASER).rows
        assert len(rows) > 500
        return rows.tobytes()

    assert recorded(5) == recorded(5)
