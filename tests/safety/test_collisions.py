"""An arm notices by its own joints that a link met something that the world model does not know, stops and says so."""

from __future__ import annotations

import numpy as np
import pytest

from safety.test_faults import is_safe
from simulation.cells import ARM, LAB, begin, cell, run, world
from simulation.test_link_contacts import BESIDE_THE_ELBOW, hidden_shelf, shelf
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.drive import DriveBase
from skillc_runtime.primitives.move import MoveJoints, MoveLinear
from skillc_runtime.primitives.path import FollowPath
from skillc_runtime.primitives.primitive import SkillFailure
from skillc_runtime.world.space.frames import pose
from skillc_runtime.world.state.changes import AddRelation, SetProperty
from skillc_runtime.world.state.model import WorldModel
from skillc_runtime.world.state.terms import AT, POSITION

BOARDS = {
    "iiwa_table": (BESIDE_THE_ELBOW, (0.4, 0.04, 0.4)),
    "ur5e_whiteboard": ((-0.05, 0.1, 1.4), (0.04, 0.4, 0.4)),
}


def swung(there: SimulatedCell, scene: str) -> Pose:
    """Return where the tool is after the first joint has turned by 1 rad."""
    base, tool = there.arms[ARM[scene]].base, there.arm(ARM[scene]).measured.pose
    turn = Pose.of((0.0, 0.0, 0.0), (np.cos(0.5), 0.0, 0.0, np.sin(0.5)))
    return base @ turn @ base.inverse() @ tool


@pytest.mark.parametrize("scene", BOARDS)
def test_a_link_that_meets_an_unknown_board_stops_the_arm(scene: str) -> None:
    place, size = BOARDS[scene]
    there = hidden_shelf(scene, place, size=size)
    with pytest.raises(SkillFailure, match=r"in the way of a link: joint \d feels \d+ N m that no force on the tool"):
        run(there, MoveJoints(there, arm=ARM[scene], target=swung(there, scene), pace=0.2))
    there.advance(0.5)
    is_safe(there, scene)
    touched = there.ground_truth.contacts()
    assert touched
    assert {each.other for each in touched} == {"lab:Shelf-1"}
    assert there.world.snapshot().vocabulary.short(ARM[scene]) in touched[0].part
    assert max(each.peak_force_n or 0.0 for each in touched) < 500.0


@pytest.mark.parametrize("scene", BOARDS)
def test_the_same_motion_without_a_board_arrives(scene: str) -> None:
    there = cell(scene)
    run(there, MoveJoints(there, arm=ARM[scene], target=swung(there, scene), pace=0.2))
    assert there.ground_truth.contacts() == ()


def test_a_line_of_the_tool_stops_as_well_where_the_elbow_meets_an_unknown_board() -> None:
    there = hidden_shelf("iiwa_table", BESIDE_THE_ELBOW)
    with pytest.raises(SkillFailure, match="in the way of a link"):
        run(there, MoveLinear(there, arm=ARM["iiwa_table"], target=beside(there), speed=0.2))


def beside(there: SimulatedCell) -> Pose:
    """Return a pose of the tool beside its start, to which the elbow passes the board."""
    tool = there.arm(ARM["iiwa_table"]).measured.pose
    return Pose(tool.position + np.array([-0.05, 0.4, 0.1]), tool.rotation)


def known_shelf() -> SimulatedCell:
    return SimulatedCell(WorldModel(world("iiwa_table").with_changes(shelf(BESIDE_THE_ELBOW))))


@pytest.mark.parametrize("motion", [MoveLinear, FollowPath])
def test_a_line_with_a_link_through_a_known_board_is_refused_before_it_moves(motion: type) -> None:
    there = known_shelf()
    target, start = beside(there), there.arm(ARM["iiwa_table"]).measured.q
    how = {"target": target} if motion is MoveLinear else {"path": [target], "blend": 0.0}
    line = motion(there, arm=ARM["iiwa_table"], speed=0.2, **how)
    with pytest.raises(
        SkillFailure, match=r"way of the tool lab:Iiwa-1 link\d would touch lab:Shelf-1 and overlap it by"
    ):
        begin(line)
    there.advance(0.3)
    assert np.abs(there.arm(ARM["iiwa_table"]).measured.q - start).max() < 0.01
    assert there.ground_truth.contacts() == ()


def test_the_same_line_without_a_board_arrives() -> None:
    there = cell("iiwa_table")
    run(there, MoveLinear(there, arm=ARM["iiwa_table"], target=beside(there), speed=0.2))


def test_fingers_may_go_where_they_touch_something() -> None:
    there = cell("iiwa_table")
    tool = there.arm(ARM["iiwa_table"]).measured.pose
    target = Pose(np.array([tool.position[0], tool.position[1], 0.74]), tool.rotation)
    begin(MoveLinear(there, arm=ARM["iiwa_table"], target=target, speed=0.1))
    assert not there.arm(ARM["iiwa_table"]).motion.done


def test_a_base_stops_where_it_drives_into_furniture() -> None:
    there = hidden_shelf("ur5e_whiteboard", (0.9, -0.5, 0.4), size=(0.3, 0.3, 0.4))
    with pytest.raises(
        SkillFailure, match=r"lab:Heron-1 stopped on the way to lab:Store: its bumper touched something"
    ):
        run(there, DriveBase(there, robot=LAB + "Heron-1", to=LAB + "Store"), 60.0)
    base = there.base(LAB + "Heron-1").pose
    there.advance(0.5)
    np.testing.assert_array_equal(there.base(LAB + "Heron-1").pose.position, base.position)
    (touched,) = there.ground_truth.contacts()
    assert (touched.part, touched.other, touched.peak_force_n) == ("lab:Heron-1", "lab:Shelf-1", None)


def test_a_base_with_nothing_in_its_way_arrives() -> None:
    there = cell("ur5e_whiteboard")
    run(there, DriveBase(there, robot=LAB + "Heron-1", to=LAB + "Store"), 60.0)
    assert there.ground_truth.contacts() == ()


def meeting() -> tuple[SimulatedCell, Pose, Pose]:
    """Return a cell in which an arm stands where the other one goes, and its next two poses."""
    near = [SetProperty(LAB + "Hatch", POSITION[1], 2.05), AddRelation(LAB + "Heron-1", AT, LAB + "Hatch")]
    there = SimulatedCell(WorldModel(world("shared_eraser").with_changes(near)))
    above, at = (pose(there.world.snapshot(), LAB + "Eraser-1-" + name) for name in ("approach", "grasp"))
    return there, above, at


def test_an_arm_does_not_go_where_another_one_stands() -> None:
    there, above, _ = meeting()
    with pytest.raises(SkillFailure, match="where it shall go lab:Robotiq-1 would touch lab:Ur5e-1 forearm_link"):
        run(there, MoveJoints(there, arm=LAB + "Iiwa-1", target=above, pace=0.3))
    assert there.ground_truth.contacts() == ()


def test_two_arms_that_meet_do_not_pass_through_each_other_and_both_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """An arm that moves is not seen by the motions of another one."""
    there, above, at = meeting()
    monkeypatch.setattr(there, "find_standing_joints", lambda arm: None)
    with pytest.raises(SkillFailure, match=r"of a link|on the tool is beyond|away from where it shall be"):
        run(there, MoveJoints(there, arm=LAB + "Iiwa-1", target=above, pace=0.3))
        run(there, MoveLinear(there, arm=LAB + "Iiwa-1", target=at, speed=0.2))
    touched = there.ground_truth.contacts()
    assert {"lab:Iiwa-1 link6", "lab:Robotiq-1 palm"} & {each.other for each in touched}
    assert "lab:Ur5e-1 forearm_link" in {each.part for each in touched}
