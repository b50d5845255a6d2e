"""The skills of arms in simulation, ticked as the tree does it, with a cell made for the test."""

import numpy as np
import pytest
from one_arm import ARM, BOARD, HOME, OneArm
from rig import HOMES, moved_by

from simulation.cells import begin
from skillc_runtime.motion.pose import Pose, exp, log, quaternion_from_rotation
from skillc_runtime.primitives.compliance import Align, Push, ReleaseAxis
from skillc_runtime.primitives.move import MoveJoints, MoveLinear, TakePosture
from skillc_runtime.primitives.overlay import OverlayCircle
from skillc_runtime.primitives.path import FollowPath
from skillc_runtime.primitives.primitive import SkillFailure, Status
from skillc_runtime.primitives.surface_location import correct_pose
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import BASE_FRAME_ID, JOINT_VALUES, ORIENTATION, POSITION

FORCE_N = {"iiwa14": 18.0, "ur5e": 8.0}


@pytest.fixture
def cell(robot):
    return OneArm(robot)


def above(robot, gap, **options):
    """A cell whose tool is above a plate, and the direction out of the plate as believed."""
    cell = OneArm(robot, gap=gap, **options)
    return cell, -cell.bench.driver.measured.pose.rotation[:, 2]


def test_move_to_a_pose_through_the_joints(cell):
    goal = moved_by(cell.arm(ARM).measured.pose, -0.05, 0.15, 0.05, turn=(0, 0, 0.4))
    cell.run(MoveJoints(cell, arm=ARM, target=goal, pace=0.5))
    cell.bench.run(0.3)
    assert np.abs(cell.arm(ARM).measured.pose.position - goal.position).max() < 1e-3
    cell.run(TakePosture(cell, arm=ARM, posture="home", pace=0.5))
    assert cell.arm(ARM).measured.at_joints(np.array(HOMES[cell.bench.robot]))


def test_out_of_reach_is_said_before_anything_moves(cell):
    q = cell.arm(ARM).measured.q
    with pytest.raises(SkillFailure, match=r"cannot reach \(3\.000, 0\.000, 0\.500\) m"):
        cell.run(MoveJoints(cell, arm=ARM, target=Pose.of((3.0, 0.0, 0.5)), pace=0.5))
    with pytest.raises(SkillFailure, match="no posture 'away'; it has home"):
        cell.run(TakePosture(cell, arm=ARM, posture="away", pace=0.5))
    cell.world.commit([SetProperty(HOME, JOINT_VALUES, "0.0 zero")])
    with pytest.raises(SkillFailure, match=r"posture home of .* is not numbers"):
        cell.run(TakePosture(cell, arm=ARM, posture="home", pace=0.5))
    with pytest.raises(SkillFailure, match=r"faster than the 0\.5 m/s"):
        cell.run(MoveLinear(cell, arm=ARM, target=cell.arm(ARM).measured.pose, speed=0.6))
    cell.bench.run(0.1)
    assert cell.arm(ARM).measured.at_joints(q)


def test_a_fault_left_over_is_told_before_anything_moves(cell):
    driver, q = cell.arm(ARM), cell.arm(ARM).measured.q
    target = moved_by(driver.measured.pose, 0.0, 0.0, 0.1)
    along = -driver.measured.pose.rotation[:, 2]
    for motion in (
        MoveJoints(cell, arm=ARM, target=target, pace=0.5),
        MoveLinear(cell, arm=ARM, target=target, speed=0.1),
        FollowPath(cell, arm=ARM, path=[target], speed=0.1, blend=0.0),
        TakePosture(cell, arm=ARM, posture="home", pace=0.5),
        ReleaseAxis(cell, arm=ARM, along=along, stiffness=0.0),
        Push(cell, arm=ARM, along=along, force=5.0, travel=0.1),
        Align(cell, arm=ARM, surface=BOARD, settle=1.0),
    ):
        driver.abort("the arm was hit")
        with pytest.raises(SkillFailure, match="the arm was hit"):
            motion.start()
        assert driver.fault is None
    cell.bench.run(0.3)
    assert cell.arm(ARM).measured.at_joints(q) and not driver.compliance.yields_along(along)


def test_a_motion_that_fails_on_the_way_ends(cell):
    motion = MoveLinear(cell, arm=ARM, target=moved_by(cell.arm(ARM).measured.pose, 0.0, 0.0, 0.1), speed=0.1)
    begin(motion)
    cell.bench.run(0.3)
    cell.arm(ARM).fault = "somebody came too near"
    with pytest.raises(SkillFailure, match="too near"):
        motion.tick()
    motion.halt("it failed")
    cell.bench.run(0.5)
    assert cell.arm(ARM).motion.done and np.linalg.norm(cell.arm(ARM).measured.velocity) < 1e-3


@pytest.mark.sim
def test_lines_and_paths(cell):
    start = cell.arm(ARM).motion.stopping_pose()
    cell.run(MoveLinear(cell, arm=ARM, target=moved_by(start, 0.0, 0.05, 0.0), speed=0.2))
    corners = [moved_by(start, 0.0, 0.1, 0.0), moved_by(start, 0.05, 0.1, 0.0), start]
    cell.run(FollowPath(cell, arm=ARM, path=corners, speed=0.2, blend=0.01))
    assert np.abs(cell.arm(ARM).measured.pose.position - start.position).max() < 5e-3


def test_a_tool_that_is_held_back_fails_with_numbers():
    cell = OneArm("iiwa14")
    start = cell.arm(ARM).motion.stopping_pose()
    cell.bench.data.xfrc_applied[cell.bench.model.body("eraser").id, 1] = -40.0
    with pytest.raises(
        SkillFailure, match=r"touches something at a height of 0\.\d+ m and meets [1-4]\d N: nothing is known"
    ):
        cell.run(MoveLinear(cell, arm=ARM, target=moved_by(start, 0.0, 0.05, 0.0), speed=0.2))


@pytest.mark.parametrize("robot", ["iiwa14", "ur5e"])
def test_motions_of_the_joints_feel_touches_as_well(robot):
    cell = OneArm(robot)
    target = moved_by(cell.arm(ARM).measured.pose, 0.0, 0.05, 0.0)
    cell.bench.data.xfrc_applied[cell.bench.model.body("eraser").id, 1] = -40.0
    with pytest.raises(SkillFailure, match=r"touches something at a height of 0\.\d+ m and meets [1-4]\d N: nothing"):
        cell.run(MoveJoints(cell, arm=ARM, target=target, pace=0.3))


@pytest.mark.sim
@pytest.mark.parametrize("gap", [0.0, 0.03, 0.09])
def test_push_meets_the_surface_wherever_it_is(robot, gap):
    cell, normal = above(robot, gap)
    cell.run(ReleaseAxis(cell, arm=ARM, along=normal, stiffness=0.0))
    push = cell.run(Push(cell, arm=ARM, along=normal, force=FORCE_N[robot], travel=0.12))
    cell.bench.run(0.5)
    force = np.array(cell.bench.log["force"]) @ normal
    assert force[-100:].mean() == pytest.approx(FORCE_N[robot], rel=0.02)
    assert force.max() < 2 * FORCE_N[robot]
    push.release()
    assert cell.arm(ARM).fault is None


@pytest.mark.sim
def test_push_gives_up_where_there_is_nothing_and_the_arm_stays_well(cell):
    normal = -cell.arm(ARM).measured.pose.rotation[:, 2]
    release = cell.run(ReleaseAxis(cell, arm=ARM, along=normal, stiffness=0.0))
    push = Push(cell, arm=ARM, along=normal, force=10.0, travel=0.04)
    with pytest.raises(SkillFailure, match="nothing to push against within 4 cm"):
        cell.run(push)
    push.release()
    release.release()
    cell.bench.run(1.0)
    start = cell.arm(ARM).motion.stopping_pose()
    assert 0.03 < np.linalg.norm(start.position - cell.bench.log["tool"][0]) < 0.08
    cell.run(MoveLinear(cell, arm=ARM, target=moved_by(start, 0.0, 0.03, 0.0), speed=0.1))


def test_push_needs_compliance_and_a_sensible_force(cell):
    normal = -cell.arm(ARM).measured.pose.rotation[:, 2]
    with pytest.raises(SkillFailure, match="within Compliance"):
        cell.run(Push(cell, arm=ARM, along=normal, force=10.0, travel=0.04))
    cell.run(ReleaseAxis(cell, arm=ARM, along=normal, stiffness=0.0))
    with pytest.raises(SkillFailure, match="60 N is more than the 50 N"):
        cell.run(Push(cell, arm=ARM, along=normal, force=60.0, travel=0.04))


@pytest.mark.sim
def test_losing_contact_stops_the_motion(robot):
    cell, normal = above(robot, 0.02)
    driver = cell.arm(ARM)
    cell.run(ReleaseAxis(cell, arm=ARM, along=normal, stiffness=0.0))
    cell.run(Push(cell, arm=ARM, along=normal, force=FORCE_N[robot], travel=0.03))
    cell.bench.model.geom_contype[cell.bench.model.geom("plate").id] = 0
    cell.bench.model.geom_conaffinity[cell.bench.model.geom("plate").id] = 0
    with pytest.raises(SkillFailure, match="contact was lost"):
        cell.run(MoveLinear(cell, arm=ARM, target=moved_by(driver.motion.stopping_pose(), 0.0, 0.2, 0.0), speed=0.05))
    cell.bench.run(1.0)
    assert np.linalg.norm(driver.measured.velocity) < 5e-3


@pytest.mark.sim
def test_the_whole_sequence_finds_the_tilted_surface_and_wipes_it(robot):
    cell, normal = above(robot, 0.03, tilt=(0.03, -0.02, 0.0))
    driver, bench = cell.arm(ARM), cell.bench
    plate = bench.model.body("plate").id
    true = Pose(bench.data.xpos[plate].copy(), bench.data.xmat[plate].reshape(3, 3).copy())
    believed = moved_by(Pose(true.position, _facing(normal)), *(0.02 * normal))
    _write(cell.world, believed)
    released = cell.run(ReleaseAxis(cell, arm=ARM, along=normal, stiffness=0.0))
    push = cell.run(Push(cell, arm=ARM, along=normal, force=FORCE_N[robot], travel=0.12))
    cell.run(Align(cell, arm=ARM, surface=BOARD, settle=3.0))
    found = _read(cell.world)
    assert np.degrees(np.arccos(found.rotation[:, 2] @ true.rotation[:, 2])) < 0.5
    assert abs((found.position - true.position) @ true.rotation[:, 2]) < 0.012  # the pad is pressed in
    start = found @ Pose(np.zeros(3), np.diag([1.0, -1.0, -1.0]))
    turn = log(driver.motion.stopping_pose().rotation @ start.rotation.T)
    lane = [moved_by(start, *(found.rotation @ [x, 0.0, 0.0]), turn=turn) for x in (0.0, 0.1, 0.0)]
    circle = OverlayCircle(cell, arm=ARM, plane=normal, radius=0.015, rate=1.0)
    circle.start()
    began = len(bench.log["force"])
    cell.run(FollowPath(cell, arm=ARM, path=lane, speed=0.1, blend=0.01), beside=[circle])
    circle.halt("the path has ended")
    force = np.array(bench.log["force"])[began:] @ true.rotation[:, 2]
    assert force.mean() == pytest.approx(FORCE_N[robot], rel=0.05)
    assert force.min() > 0.5
    push.release()
    released.release()
    cell.run(MoveLinear(cell, arm=ARM, target=moved_by(driver.motion.stopping_pose(), *(0.07 * normal)), speed=0.1))
    assert np.array(bench.log["force"])[-1] @ normal == 0.0


@pytest.mark.sim
@pytest.mark.parametrize("fails", [False, True])
def test_an_align_that_fails_or_is_halted_holds_the_tool(robot, fails):
    cell, normal = above(robot, 0.01)
    cell.run(ReleaseAxis(cell, arm=ARM, along=normal, stiffness=0.0))
    cell.run(Push(cell, arm=ARM, along=normal, force=FORCE_N[robot], travel=0.12))
    align = Align(cell, arm=ARM, surface=BOARD, settle=3.0)
    align.start()
    cell.bench.run(0.2)
    assert align.tick() is Status.RUNNING
    if fails:
        cell.arm(ARM).abort("contact was lost")
        with pytest.raises(SkillFailure, match="contact was lost"):
            align.tick()
    align.halt("stopped by the user")
    cell.bench.run(1.0)
    assert cell.arm(ARM).motion.tracking_error_message is None
    assert cell.world.snapshot().value(BOARD, POSITION[0]) is None


def test_touching_corrects_what_it_can_tell():
    believed = Pose(np.array([0.5, 0.1, 0.7]), exp(np.array([0.0, 0.0, 0.3])))
    tilt = exp(np.array([0.05, -0.03, 0.0]))
    tool = Pose(np.array([0.45, 0.2, 0.72]), tilt @ np.diag([1.0, -1.0, -1.0]))
    found = correct_pose(believed, tool)
    normal = tilt[:, 2]
    assert np.allclose(found.rotation[:, 2], normal)
    assert normal @ (found.position - tool.position) == pytest.approx(0.0)
    assert np.linalg.norm(np.cross(found.position - believed.position, normal)) == pytest.approx(0.0)
    assert correct_pose(found, tool).position == pytest.approx(found.position)
    assert np.degrees(np.linalg.norm(log(found.rotation @ believed.rotation.T))) < 3.5


def _facing(normal):
    x = np.cross([0.0, 1.0, 0.0], normal)
    x /= np.linalg.norm(x)
    return np.column_stack([x, np.cross(normal, x), normal])


def _write(world, pose):
    values = zip(POSITION + ORIENTATION, (*pose.position, *quaternion_from_rotation(pose.rotation)), strict=True)
    world.commit([SetProperty(BOARD, BASE_FRAME_ID, "map"), *(SetProperty(BOARD, k, float(v)) for k, v in values)])


def _read(world):
    read = world.snapshot().value
    return Pose.of([read(BOARD, name) for name in POSITION], [read(BOARD, name) for name in ORIENTATION])
