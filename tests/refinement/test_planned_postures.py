"""The postures with which a plan was looked at, as a run takes them."""

import numpy as np

from skillc_runtime.motion.pose import Pose, rotation_from_angles
from skillc_runtime.primitives.planned_postures import PlannedPosture, PlannedPostures

DOWN = (0.0, 1.0, 0.0, 0.0)
HERE, THERE = Pose.of((0.4, 0.1, 0.8), DOWN), Pose.of((0.6, 0.1, 0.8), DOWN)


def planned(*tools: Pose) -> tuple[PlannedPostures, list[tuple[str, str]]]:
    """Postures of an arm, the first joint of which is at the number of its pose, and what is told."""
    told = list[tuple[str, str]]()
    postures = [PlannedPosture("arm", tool, np.array([float(number)])) for number, tool in enumerate(tools)]
    return PlannedPostures(postures, lambda arm, what: told.append((arm, what))), told


def found(postures: PlannedPostures, tool: Pose) -> float | None:
    q = postures.find("arm", tool)
    return None if q is None else float(q[0])


def test_each_pose_has_its_posture_and_of_equal_ones_the_next_is_taken():
    postures, told = planned(HERE, THERE, HERE, THERE)
    assert [found(postures, each) for each in (HERE, THERE, HERE, THERE, HERE)] == [0, 1, 2, 3, 0]
    assert not told


def test_steps_that_are_skipped_leave_the_others_their_postures():
    postures, _ = planned(HERE, THERE, HERE, THERE)
    assert [found(postures, each) for each in (THERE, THERE, HERE)] == [1, 3, 0]


def test_a_thing_a_little_elsewhere_is_reached_in_the_same_posture_one_farther_away_is_told():
    postures, told = planned(HERE, THERE)
    turned = Pose(THERE.position, THERE.rotation @ rotation_from_angles(0.0, 0.0, 0.1))
    assert found(postures, Pose(HERE.position + np.array([0.0, 0.04, 0.0]), HERE.rotation)) == 0
    assert found(postures, turned) == 1
    assert not told
    assert found(postures, Pose(HERE.position + np.array([0.0, 0.07, 0.0]), HERE.rotation)) is None
    assert found(postures, Pose(HERE.position, HERE.rotation @ rotation_from_angles(0.0, 0.0, 0.5))) is None
    assert [arm for arm, _ in told] == ["arm", "arm"]
    assert "0.07 m and 0 degrees" in told[0][1] and "0.00 m and 29 degrees" in told[1][1]


def test_of_an_arm_for_which_nothing_was_planned_nothing_is_told():
    postures, told = planned(HERE)
    assert postures.find("other", HERE) is None
    assert not told
