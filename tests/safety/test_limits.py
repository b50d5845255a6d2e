"""Limits that are facts hold below the skills: whoever moves an arm, beyond them it holds still and says why."""

from __future__ import annotations

import numpy as np
import pytest

from safety.test_faults import is_safe
from simulation.cells import ARM, GRIPPER, LAB, SCENES, begin, cell, run, world
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.names import part_name
from skillc_runtime.control.driver import CompliantArmDriver
from skillc_runtime.control.supervision.safety import Workspace
from skillc_runtime.devices.motion_interface import Infeasible
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.move import MoveJoints, MoveLinear
from skillc_runtime.primitives.overlay import OverlayCircle
from skillc_runtime.primitives.path import FollowPath
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.space.frames import placement_changes
from skillc_runtime.world.state.changes import AddIndividual, AddRelation, Change, SetProperty
from skillc_runtime.world.state.data_sheet import SheetError
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import FRAME_ID, HAS_SHEET, HAS_WORKSPACE, SIZE, SKILLC, TOOL_SPEED_LIMIT


def cell_with(scene: str, changes: list[Change]) -> SimulatedCell:
    return SimulatedCell(WorldModel(world(scene).with_changes(changes)))


def moved(arm: CompliantArmDriver, *way: float) -> Pose:
    return Pose(arm.motion.stopping_pose().position + np.array(way), arm.motion.stopping_pose().rotation)


def pushed(there: SimulatedCell, scene: str, force: tuple[float, float, float], seconds: float) -> None:
    """Let something push the palm with a force in N in the world."""
    body = there.data.body(part_name(there.scene.names[GRIPPER[scene]], "palm"))
    body.xfrc_applied[:3] = force
    there.advance(seconds)
    body.xfrc_applied[:3] = 0.0


@pytest.mark.parametrize("scene", SCENES)
def test_the_tool_stops_where_it_is_pushed_too_hard(scene: str) -> None:
    there = cell(scene)
    arm = there.arm(ARM[scene])
    there.advance(0.05)
    pushed(there, scene, (0.0, 40.0, 0.0), 0.1)
    assert arm.fault is None
    arm.compliance.release(np.array([0.0, 1.0, 0.0]))
    arm.compliance.push(np.array([0.0, 1.0, 0.0]), 5.0)
    pushed(there, scene, (0.0, 150.0, 0.0), 0.1)
    assert arm.fault is not None
    assert "N on the tool is beyond the 80 N" in arm.fault
    assert not arm.compliance.commanded_wrench.any()
    told = there.secure()
    assert len(told) == 2
    assert "had stopped: a force" in told[0]
    assert "left yielding" in told[1]
    is_safe(there, scene)
    assert there.secure() == ()


@pytest.mark.parametrize("force", [(30.0, 0.0, 0.0), (0.0, -30.0, 0.0), (0.0, 20.0, 30.0)])
def test_an_arm_without_sensor_feels_what_pushes_its_tool(force: tuple[float, float, float]) -> None:
    there = cell("iiwa_table")
    arm = there.arm(ARM["iiwa_table"])
    arm.motion.hold_position()
    there.advance(0.05)
    observer = arm._safety.momentum_observer
    assert observer is not None
    assert np.linalg.norm(observer.wrench(arm.measured.state)[:3]) < 2.0
    pushed(there, "iiwa_table", force, 0.15)
    felt = observer.wrench(arm.measured.state)[:3]
    assert np.abs(felt - force).max() < 3.0


@pytest.mark.parametrize("scene", SCENES)
def test_a_tool_that_is_too_fast_is_stopped(scene: str) -> None:
    sheet = next(iter(world(scene).objects(ARM[scene], HAS_SHEET)))
    there = cell_with(scene, [SetProperty(sheet, TOOL_SPEED_LIMIT, 0.1)])
    arm = there.arm(ARM[scene])
    run(there, MoveLinear(there, arm=ARM[scene], target=moved(arm, 0.0, 0.0, 0.03), speed=0.09))
    with pytest.raises(SkillFailure, match=r"moves with 0\.1\d m/s, beyond the 0\.1 m/s"):
        run(there, MoveLinear(there, arm=ARM[scene], target=moved(arm, 0.0, 0.0, -0.1), speed=0.3))
    is_safe(there, scene)


@pytest.mark.parametrize("scene", SCENES)
def test_joints_go_more_slowly_where_the_tool_would_be_too_fast(scene: str) -> None:
    sheet = next(iter(world(scene).objects(ARM[scene], HAS_SHEET)))
    there = cell_with(scene, [SetProperty(sheet, TOOL_SPEED_LIMIT, 0.4)])
    arm, fastest = there.arm(ARM[scene]), 0.0
    goal = arm.measured.q + {"iiwa_table": 0.4, "ur5e_whiteboard": -0.4}[scene]
    arm.motion.move_joints(goal, 1.0)
    for _ in range(400):
        there.advance(0.01)
        fastest = max(fastest, float(np.linalg.norm(arm.measured.velocity[:3])))
        if arm.motion.done:
            break
    assert arm.fault is None
    assert arm.measured.at_joints(goal)
    assert 0.25 < fastest < 0.4


def test_an_overlay_that_is_too_fast_is_refused() -> None:
    there = cell("iiwa_table")
    circle = OverlayCircle(there, arm=ARM["iiwa_table"], plane=np.array([0.0, 0.0, 1.0]), radius=0.05, rate=2.0)
    with pytest.raises(SkillFailure, match=r"50 mm at 2 Hz runs with 0\.63 m/s, faster than the 0\.5 m/s"):
        circle.start()


def boxed(scene: str) -> tuple[SimulatedCell, CompliantArmDriver, Pose]:
    """Return a cell whose tool must stay within 3 cm around its start, its arm, and that start."""
    start = cell(scene).arm(ARM[scene]).measured.pose
    there = cell_with(scene, workspace(scene, start))
    return there, there.arm(ARM[scene]), start


@pytest.mark.parametrize("scene", SCENES)
def test_a_tool_that_leaves_its_workspace_is_stopped_and_may_come_back(scene: str) -> None:
    there, arm, start = boxed(scene)
    up = np.array([0.0, 0.0, 1.0])
    arm.compliance.release(up)
    arm.compliance.push(-up, 25.0)
    for _ in range(500):
        if arm.fault is not None:
            break
        there.advance(0.01)
    assert arm.fault is not None
    assert "mm outside the arm's workspace" in arm.fault
    there.secure()
    is_safe(there, scene)
    assert 0.03 < arm.measured.pose.position[2] - start.position[2] < 0.045
    with pytest.raises(SkillFailure, match=r"its tool would be \d+ mm outside"):
        run(there, MoveLinear(there, arm=ARM[scene], target=moved(arm, 0.0, 0.0, 0.01), speed=0.1))
    outside = arm.outside_workspace_m
    with pytest.raises(SkillFailure, match=r"its tool would be \d+ mm outside"):
        run(there, MoveLinear(there, arm=ARM[scene], target=moved(arm, 0.0, 0.0, -outside / 2), speed=0.1))
    run(there, MoveLinear(there, arm=ARM[scene], target=start, speed=0.1))
    assert np.abs(arm.measured.pose.position - start.position).max() < 2e-3


@pytest.mark.parametrize("scene", SCENES)
def test_motions_that_leave_the_workspace_are_refused_before_anything_moves(scene: str) -> None:
    there, arm, start = boxed(scene)
    there.advance(0.05)
    out, back = moved(arm, 0.0, 0.0, 0.1), arm.motion.stopping_pose()
    upwards = arm.motion.inverse_kinematics(out, arm.measured.q)
    assert upwards is not None
    refused = (
        MoveLinear(there, arm=ARM[scene], target=out, speed=0.1),
        FollowPath(there, arm=ARM[scene], path=[out, back], speed=0.1, blend=0.0),
        MoveJoints(there, arm=ARM[scene], target=out, pace=0.5),
        OverlayCircle(there, arm=ARM[scene], plane=np.array([0.0, 0.0, 1.0]), radius=0.04, rate=0.2),
    )
    for each in refused:
        with pytest.raises(SkillFailure, match=r"its tool would be \d+ mm outside the arm's workspace, at \("):
            begin(each)
    with pytest.raises(Infeasible, match="outside the arm's workspace"):
        arm.motion.move_joints(upwards, 0.5)
    there.advance(0.3)
    assert np.abs(arm.measured.pose.position - start.position).max() < 2e-3
    run(there, MoveLinear(there, arm=ARM[scene], target=moved(arm, 0.0, 0.0, 0.02), speed=0.1))
    run(there, MoveJoints(there, arm=ARM[scene], target=start, pace=0.5))
    OverlayCircle(there, arm=ARM[scene], plane=np.array([0.0, 0.0, 1.0]), radius=0.02, rate=0.2).start()


def test_an_arm_that_starts_outside_its_workspace_is_refused() -> None:
    start = cell("iiwa_table").arm(ARM["iiwa_table"]).measured.pose
    away = Pose(start.position + np.array([0.0, 0.0, 0.1]), start.rotation)
    with pytest.raises(SheetError, match=r"lab:Iiwa-1 starts \d+ mm outside the arm's workspace; enlarge that"):
        cell_with("iiwa_table", workspace("iiwa_table", away))


def workspace(scene: str, middle: Pose) -> list[Change]:
    """Say that the tool stays within 3 cm around a place."""
    box = LAB + "Box"
    sizes = [SetProperty(box, name, 0.06) for name in SIZE]
    kind, frame = AddIndividual(box, (SKILLC + "Workspace",)), SetProperty(box, FRAME_ID, "box")
    return [kind, frame, *placement_changes(box, middle), *sizes, AddRelation(ARM[scene], HAS_WORKSPACE, box)]


@pytest.mark.parametrize(("point", "outside"), [((0.9, 1.0, 3.0), 0.0), ((1.2, 1.0, 3.0), 0.1), ((1.4, 2.4, 3.0), 0.5)])
def test_how_far_outside_a_box(point: tuple[float, float, float], outside: float) -> None:
    turned = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    box = Workspace(Pose(np.array([1.0, 1.0, 3.0]), turned), np.array([2.0, 0.2, 0.2]))
    assert box.outside(np.array(point)) == pytest.approx(outside)
