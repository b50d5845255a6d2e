"""Arcs, jerk limits and overlays on an arm, and how what does not fit it is told."""

import numpy as np
import pytest
from msgspec.structs import replace
from one_arm import ARM, BOARD, OneArm
from rig import GAINS, HOMES, moved_by

from simulation.cells import begin
from skillc_runtime.motion.pose import Pose, log
from skillc_runtime.primitives.arc import MoveArc
from skillc_runtime.primitives.move import MoveLinear
from skillc_runtime.primitives.overlay import OverlayCircle, OverlayLissajous, OverlaySine, OverlaySpiral
from skillc_runtime.primitives.path import FollowPath
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import SIZE

UP = np.array([0.0, 0.0, 1.0])


@pytest.fixture
def cell(robot):
    return OneArm(robot)


def planned(cell, motion):
    """Start a motion; return what its reference is to be at 500 times, the arm's base being the world."""
    found, driver = [], cell.bench.driver
    driver.motion.follow_tool = found.append
    begin(motion)
    del driver.motion.follow_tool
    trajectory = found[0].in_base
    times = np.linspace(0.0, trajectory.duration, 500)
    return [trajectory.at(time) for time in times], times[1]


def test_an_arc_goes_through_its_place_on_the_way_and_turns_the_tool(cell):
    start = cell.arm(ARM).measured.pose
    target = moved_by(start, 0.0, 0.1, 0.0, turn=(0.0, 0.0, 0.4))
    motion = MoveArc(cell, arm=ARM, via=moved_by(start, 0.0, 0.05, 0.05), target=target, speed=0.15)
    seen, _ = planned(cell, motion)
    centre = start.position + np.array([0.0, 0.05, 0.0])
    assert all(np.linalg.norm(each.pose.position - centre) == pytest.approx(0.05, abs=1e-3) for each in seen)
    assert max(each.pose.position[2] for each in seen) == pytest.approx(start.position[2] + 0.05, abs=1e-3)
    cell.run(motion)
    assert np.linalg.norm(cell.arm(ARM).measured.pose.position - target.position) < 0.005
    assert np.linalg.norm(log(cell.arm(ARM).measured.pose.rotation @ target.rotation.T)) < 0.05


def test_places_on_a_line_make_no_arc_and_are_told(cell):
    start = cell.arm(ARM).measured.pose
    via, target = moved_by(start, 0.0, 0.1, 0.0), moved_by(start, 0.0, 0.2, 0.0)
    with pytest.raises(
        SkillFailure, match=r"three points on a line make no circle: start at \(.*\) m in the frame 'map'"
    ):
        cell.run(MoveArc(cell, arm=ARM, via=via, target=target, speed=0.1))


def test_a_jerk_limit_of_the_arm_holds_for_lines_paths_and_arcs(cell):
    driver = cell.bench.driver
    driver.task_limits = replace(GAINS[cell.bench.robot].limits, jerk_m_s3=4.0)
    start = driver.measured.pose
    corner, target = moved_by(start, 0.0, 0.05, 0.0), moved_by(start, 0.0, 0.05, 0.05)
    motions = [
        MoveLinear(cell, arm=ARM, target=corner, speed=0.1),
        MoveArc(cell, arm=ARM, via=moved_by(start, 0.0, 0.03, 0.02), target=corner, speed=0.1),
        FollowPath(cell, arm=ARM, path=[corner, target], speed=0.1, blend=0.01),
    ]
    for motion in motions:
        seen, step = planned(cell, motion)
        change = np.diff([each.acceleration[:3] for each in seen], axis=0) / step
        assert 1.0 < np.linalg.norm(change, axis=1).max() <= 2 * 4.0 * 1.01


def test_without_a_jerk_limit_acceleration_jumps(cell):
    target = moved_by(cell.arm(ARM).measured.pose, 0.0, 0.05, 0.0)
    seen, _ = planned(cell, MoveLinear(cell, arm=ARM, target=target, speed=0.1))
    assert np.abs(np.diff([each.acceleration[:3] for each in seen], axis=0)).max() > 0.4


OVERLAYS = {
    "circle": lambda cell: OverlayCircle(cell, arm=ARM, plane=UP, radius=0.01, rate=1.0),
    "sine": lambda cell: OverlaySine(cell, arm=ARM, along=np.array([0.0, 1.0, 0.0]), amplitude=0.01, rate=1.0),
    "spiral": lambda cell: OverlaySpiral(cell, arm=ARM, plane=UP, pitch=0.004, speed=0.03, radius=0.01),
    "lissajous": lambda cell: OverlayLissajous(
        cell,
        arm=ARM,
        plane=UP,
        along=np.array([1.0, 0.0, 0.3]),
        width=0.01,
        height=0.005,
        rate=1.0,
        across_rate=2.0,
        phase=0.0,
    ),
}


@pytest.mark.parametrize("name", OVERLAYS)
def test_an_overlay_grows_from_nothing_and_fades_to_nothing(name):
    cell = OneArm("ur5e")
    driver, start, overlay, seen = (
        cell.bench.driver,
        cell.arm(ARM).motion.stopping_pose().position,
        OVERLAYS[name](cell),
        [],
    )
    overlay.start()
    for step in range(260):
        if step == 200:
            overlay.halt("enough")
        driver.step(0.02 + 0.01 * step)
        seen.append(driver.motion.reference)
    away = np.array([np.linalg.norm(each.pose.position - start) for each in seen])
    speeds = np.array([np.linalg.norm(each.twist[:3]) for each in seen])
    assert away[0] < 1e-6
    assert away[-1] < 1e-9
    assert 0.008 < away.max() < 0.0115
    assert np.abs(np.diff(speeds)).max() < 0.02
    assert all(abs(float((each.pose.position - start) @ UP)) < 1e-6 for each in seen)


def test_an_overlay_that_the_arm_cannot_do_is_refused_before_it_moves(cell):
    q, limits = cell.arm(ARM).measured.q, cell.bench.limits
    with pytest.raises(SkillFailure, match=r"a circle of 50 mm at 3 Hz runs with 0\.94 m/s, faster than the 0\.5 m/s"):
        cell.run(OverlayCircle(cell, arm=ARM, plane=UP, radius=0.05, rate=3.0))
    cell.bench.driver._task.limits = replace(limits, velocity=np.full_like(limits.velocity, 0.05))
    with pytest.raises(
        SkillFailure, match=r"joint \w+ would have to move with 0\.\d+ rad/s, faster than the 0\.05 rad/s"
    ):
        cell.run(OverlayCircle(cell, arm=ARM, plane=UP, radius=0.015, rate=1.0))
    with pytest.raises(SkillFailure, match="a direction `along` that lies in its plane"):
        OverlayLissajous(
            cell, arm=ARM, plane=UP, along=UP, width=0.01, height=0.01, rate=1.0, across_rate=1.0, phase=0.0
        )
    cell.bench.run(0.2)
    assert np.abs(cell.arm(ARM).measured.q - q).max() < 0.01


def test_what_does_not_fit_names_the_joint_and_the_place_on_the_surface():
    cell = OneArm("ur5e", base=Pose.of((1.0, 0.0, 0.2)))
    driver, start = cell.bench.driver, cell.arm(ARM).measured.pose
    ranges = driver.limits.range.copy()
    ranges[0] = HOMES["ur5e"][0] - 0.1, HOMES["ur5e"][0] + 0.1
    driver._task.limits = replace(driver.limits, range=ranges)
    sideways = moved_by(start, 0.0, 0.3, 0.0)
    with pytest.raises(SkillFailure) as alone:
        cell.run(MoveLinear(cell, arm=ARM, target=sideways, speed=0.1))
    assert "the motion does not fit the arm: the joint shoulder_pan would have to be at 0." in str(alone.value)
    assert str(alone.value).endswith(f" {start.position[2]:.3f}) m in the frame 'map'")
    board = placement_changes(BOARD, Pose(start.position - 0.05 * UP, np.eye(3)))
    cell.world.commit([*board, *(SetProperty(BOARD, name, 0.4) for name in SIZE)])
    with pytest.raises(SkillFailure, match=r"m in the frame 'map', which is \(0\.000, 0\.\d+, 0\.050\) m on .*Board"):
        cell.run(MoveLinear(cell, arm=ARM, target=sideways, speed=0.1))
