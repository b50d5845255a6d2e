"""The kinematic cell: joints follow commands, fingers stop and hold, contact pushes back, bases carry what is held."""

from __future__ import annotations

import numpy as np
import pytest

from simulation.cells import ARM, ERASER, GRIPPER, LAB, PLACE, SURFACE, reach_for_eraser, run, world
from skillc_runtime.backends.kinematic.cell import KinematicCell
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.grasp import Grasp
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.facts import PropertyFact, RelationFact
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AT, CONTAIN, DEVICE_STATE, IS_CLEAN

LIMITS = MotionLimits(speed=0.2, acceleration=0.5)


def cell(scene: str) -> KinematicCell:
    moved = [AddRelation(LAB + "Heron-1", AT, LAB + "Store")] if scene == "ur5e_whiteboard" else []
    return KinematicCell(WorldModel(world(scene).with_changes(moved)))


def holding(scene: str) -> KinematicCell:
    there = cell(scene)
    reach_for_eraser(there, scene)
    at, handles = pose(world(scene), ERASER + "-grasp"), {"arm": ARM[scene], "gripper": GRIPPER[scene]}
    run(there, Grasp(there, object=ERASER, at=at, place=PLACE[scene], **handles))
    return there


def eraser(there: KinematicCell) -> Pose:
    body = there.data.body(there.scene.names[ERASER] + "/block")
    return Pose(body.xpos.copy(), body.xmat.reshape(3, 3).copy())


def go(there: KinematicCell, scene: str, way: tuple[float, float, float]) -> None:
    motion = there.arm(ARM[scene]).motion
    start = motion.stopping_pose()
    motion.move_along(path_through([start, Pose(start.position + np.array(way), start.rotation)], LIMITS))
    there.advance(2.0)
    assert motion.done


def test_fingers_stop_at_what_they_touch_on_both_sides_and_pass_through_nothing() -> None:
    there = cell("iiwa_table")
    gripper = there.gripper(GRIPPER["iiwa_table"])
    gripper.move(0.0, 30.0)
    there.advance(5.0)
    assert gripper.opening_m == 0.0
    assert not gripper.touches(ERASER)
    with pytest.raises(RuntimeError, match="nothing keeps the fingers of lab:Robotiq-1 from closing"):
        gripper.attach(ERASER, Pose(np.zeros(3), np.eye(3)), 0.1)
    reach_for_eraser(there, "iiwa_table")
    assert gripper.opening_m == pytest.approx(0.025, abs=3e-4)
    assert not gripper.moving


@pytest.mark.parametrize("scene", ["iiwa_table", "ur5e_whiteboard"])
def test_what_is_held_moves_with_the_hand_and_stays_where_it_is_released(scene: str) -> None:
    there = holding(scene)
    before = eraser(there)
    go(there, scene, (0.02, 0.03, 0.10))
    carried = eraser(there)
    assert np.abs(carried.position - before.position - [0.02, 0.03, 0.10]).max() < 1e-3
    there.gripper(GRIPPER[scene]).detach()
    go(there, scene, (0.0, 0.0, 0.05))
    assert np.array_equal(eraser(there).position, carried.position)


def test_what_is_held_drives_along_with_the_base() -> None:
    there = holding("ur5e_whiteboard")
    go(there, "ur5e_whiteboard", (0.0, 0.0, 0.2))
    base, before, tool = there.base(LAB + "Heron-1"), eraser(there), there.arm(ARM["ur5e_whiteboard"]).measured
    in_hand, start = tool.pose.inverse() @ before, base.pose
    base.drive_to(start @ Pose(np.array([-0.5, 0.1, 0.0]), np.eye(3)))
    there.advance(30.0)
    assert base.done
    moved = base.pose @ start.inverse() @ before
    assert np.linalg.norm(moved.position - before.position) > 0.4
    assert np.abs(eraser(there).position - moved.position).max() < 1e-3
    assert np.abs((tool.pose @ in_hand).position - moved.position).max() < 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("scene", ["iiwa_table", "ur5e_whiteboard"])
def test_a_pushed_tool_presses_on_a_surface_with_the_force_that_is_commanded(scene: str) -> None:
    there = holding(scene)
    compliance, measured = there.arm(ARM[scene]).compliance, there.arm(ARM[scene]).measured
    go(there, scene, (0.0, 0.0, 0.05))
    normal = np.array([0.0, 0.0, 1.0])
    compliance.release(normal)
    for force_n in (5.0, 12.0):
        compliance.push(normal, force_n, 0.1)
        there.advance(6.0)
        assert abs(measured.velocity[2]) < 1e-3
        assert measured.wrench[2] == pytest.approx(force_n, rel=0.03)
        touch = there.data.sensor(there.scene.names[ERASER] + "/face/touch").data[0]
        assert touch == pytest.approx(force_n, rel=0.03)
    assert there.ground_truth.peak_force_n(ERASER) < 40.0


def test_only_what_does_not_depend_on_contact_counts_as_sensed() -> None:
    there = cell("ur5e_whiteboard")
    robot, surface, hand = LAB + "Heron-1", SURFACE["ur5e_whiteboard"], GRIPPER["ur5e_whiteboard"]
    at_board = RelationFact(robot, AT, LAB + "BoardStation")
    there.world.commit([AddRelation(robot, AT, LAB + "BoardStation")], "DriveBase", "reported")
    there.world.commit([SetProperty(surface, IS_CLEAN, True)], "Inspect", "sensed")
    there.world.commit([AddRelation(hand, CONTAIN, ERASER)], "Grasp", "sensed")

    def known(fact: RelationFact | PropertyFact) -> str | None:
        write = there.world.deciding_write(fact)
        return None if write is None else write.evidence

    assert known(at_board) == "reported"
    assert known(PropertyFact(ARM["ur5e_whiteboard"], DEVICE_STATE)) == "reported"
    assert known(PropertyFact(surface, IS_CLEAN)) == "idealised"
    assert known(RelationFact(hand, CONTAIN, ERASER)) == "idealised"
    there.world.commit([SetProperty(surface, IS_CLEAN, True)], "Hope")
    assert known(PropertyFact(surface, IS_CLEAN)) == "assumed"


def test_the_pose_of_what_lies_there_is_as_the_facts_say() -> None:
    there = cell("iiwa_table")
    there.advance(1.0)
    assert np.abs(eraser(there).position - pose(there.world.snapshot(), ERASER).position).max() < 1e-9
    assert there.ground_truth.variation == ""
