"""Skills that move joints, in cells with a pillar in the way: physics says that it is never touched."""

from __future__ import annotations

import numpy as np
import pytest

from collision.around import aside, cell, pillar, posture, true_gap
from collision.test_ways import UPRIGHT
from simulation.cells import ARM, SCENES, begin
from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.collision import path_planning as ways
from skillc_runtime.primitives.move import MoveJoints, TakePosture
from skillc_runtime.primitives.primitive import Primitive, SkillFailure, Status
from skillc_runtime.world.state.changes import Change


def gaps(there: SimulatedCell, scene: str, primitive: Primitive) -> list[float]:
    """Do something; return how far the arm really was from the pillar all the time."""
    found = []
    begin(primitive)
    for _ in range(1500):
        found.append(true_gap(there, scene, "Pillar"))
        if primitive.tick() is Status.SUCCESS:
            return found
        there.advance(0.02)
    raise AssertionError("it does not end")


def stage(scene: str, *more: Change) -> SimulatedCell:
    """A cell with a pillar and a posture `aside` behind it."""
    changes = [*pillar(scene), *posture(scene, "aside", aside(scene).tolist()), *more]
    there = cell(scene, changes)
    there.advance(0.02)
    return there


def take(there: SimulatedCell, scene: str, name: str) -> TakePosture:
    return TakePosture(there, arm=ARM[scene], posture=name, pace=0.6)


@pytest.mark.parametrize("scene", SCENES)
def test_straight_it_would_hit(scene: str) -> None:
    there = stage(scene)
    arm = there.arm(ARM[scene])
    arm.motion.move_joints(aside(scene), 0.6)
    found = [true_gap(there, scene, "Pillar")]
    while not arm.motion.done:
        there.advance(0.02)
        found.append(true_gap(there, scene, "Pillar"))
    assert found[0] > 0.05 - 1e-9 and min(found) < 0.0


@pytest.mark.parametrize("scene", SCENES)
def test_it_goes_around(scene: str) -> None:
    there = stage(scene)
    assert min(gaps(there, scene, take(there, scene, "aside"))) > 0.005
    assert there.arm(ARM[scene]).measured.at_joints(aside(scene))


@pytest.mark.sim
def test_a_pose_behind_it_is_reached_too() -> None:
    there = stage("iiwa_table")
    arm = there.arm(ARM["iiwa_table"])
    target = arm._task.kinematics.tool_at(aside("iiwa_table"), arm.measured.state)[0]
    target = arm.measured.base() @ target
    assert min(gaps(there, "iiwa_table", MoveJoints(there, arm=ARM["iiwa_table"], target=target, pace=0.6))) > 0.005
    there.advance(0.3)
    assert np.abs(arm.measured.pose.position - target.position).max() < 2e-3


def test_without_search_it_goes_over_a_posture_of_its_sheet(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ways, "SEARCHES", ())
    there = stage("iiwa_table", *posture("iiwa_table", "upright", UPRIGHT))
    assert min(gaps(there, "iiwa_table", take(there, "iiwa_table", "aside"))) > 0.005
    assert there.arm(ARM["iiwa_table"]).measured.at_joints(aside("iiwa_table"))


@pytest.mark.parametrize("scene", SCENES)
def test_where_no_way_is_known_nothing_moves(scene: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ways, "SEARCHES", ())
    there = stage(scene)
    q = there.arm(ARM[scene]).measured.q
    with pytest.raises(SkillFailure, match="would touch lab:Pillar"):
        begin(take(there, scene, "aside"))
    there.advance(0.2)
    assert there.arm(ARM[scene]).measured.at_joints(q)
