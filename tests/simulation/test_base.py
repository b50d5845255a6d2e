"""A base drives within its limits, ends where it shall, and brakes when stopped."""

import numpy as np
import pytest
from cells import ARM, LAB, cell, run

from skillc_runtime.backends.mujoco.cell import SimulatedCell
from skillc_runtime.backends.simulation.bases.base import SimulatedBase
from skillc_runtime.backends.simulation.scene_spec import BaseSpec
from skillc_runtime.motion.pose import Pose
from skillc_runtime.primitives.drive import DriveBase
from skillc_runtime.world.space.frames import pose

HERON = LAB + "Heron-1"


def base_facts(there: SimulatedCell) -> BaseSpec:
    return there.scene.bases[0]


def driven(base: SimulatedBase, period: float = 0.001) -> np.ndarray:
    """Return x, y and heading of every step until the base is done."""
    rows = []
    while not base.done:
        base.step(period)
        turned = base.pose.rotation
        rows.append([*base.pose.position[:2], np.arctan2(turned[1, 0], turned[0, 0])])
    return np.array(rows)


@pytest.mark.parametrize("goal", [(1.5, -1.2, -1.57), (-0.5, 0.1, 3.0), (0.0, 0.0, 0.5), (0.03, 0.0, 0.0)])
def test_speed_and_acceleration_stay_within_the_data_sheet(goal: tuple[float, float, float]) -> None:
    there = cell("ur5e_whiteboard")
    base, facts = there.base(HERON), base_facts(there)
    x, y, heading = goal
    half = heading / 2
    base.drive_to(Pose.of((x, y, 0.0), (np.cos(half), 0.0, 0.0, np.sin(half))))
    rows = driven(base)
    np.testing.assert_allclose(rows[-1], goal, atol=2e-3)
    velocity = np.diff(np.unwrap(rows, axis=0), axis=0) / 0.001
    speed, turn = np.hypot(velocity[:, 0], velocity[:, 1]), velocity[:, 2]
    assert speed.max() <= facts.speed * 1.001
    assert np.abs(turn).max() <= facts.turn_speed * 1.001
    assert np.abs(np.diff(speed)).max() / 0.001 <= facts.acceleration * 1.05
    assert np.abs(np.diff(turn)).max() / 0.001 <= facts.turn_acceleration * 1.05


def test_a_goal_where_the_base_stands_is_reached_at_once() -> None:
    base = cell("ur5e_whiteboard").base(HERON)
    base.drive_to(base.pose)
    assert base.done


def test_a_stopped_base_brakes_and_is_not_done() -> None:
    there = cell("ur5e_whiteboard")
    base, facts = there.base(HERON), base_facts(there)
    base.drive_to(Pose.of((2.0, 0.0, 0.0)))
    for _ in range(1500):
        base.step(0.001)
    before = base.pose.position[0]
    base.stop()
    for _ in range(5000):
        base.step(0.001)
    braking = facts.speed**2 / (2 * facts.acceleration)
    assert base.pose.position[0] - before <= braking + 1e-3
    assert base.step(0.001) is None
    assert not base.done


def moving(base: SimulatedBase, seconds: float) -> list[float]:
    """Step a base and return its distance from the origin along x after every step."""
    rows = []
    for _ in range(round(seconds / 0.001)):
        base.step(0.001)
        rows.append(float(base.pose.position[0]))
    return rows


@pytest.mark.parametrize("seconds", [0.2, 1.5])
@pytest.mark.parametrize("stops_first", [True, False])
def test_a_goal_given_while_the_base_moves_makes_it_brake_first(seconds: float, stops_first: bool) -> None:
    there = cell("ur5e_whiteboard")
    base, facts = there.base(HERON), base_facts(there)
    base.drive_to(Pose.of((2.0, 0.0, 0.0)))
    way = moving(base, seconds)
    assert not base.at_rest
    if stops_first:
        base.stop()
        way += moving(base, 0.05)
    base.drive_to(Pose.of((0.3, 0.0, 0.0)))
    way += moving(base, 20.0)
    assert base.done
    assert base.at_rest
    assert way[-1] == pytest.approx(0.3, abs=1e-3)
    speed = np.diff(way) / 0.001
    assert speed.max() > 0.5 * facts.acceleration * seconds or speed.max() == pytest.approx(facts.speed, rel=0.01)
    assert np.abs(np.diff(speed)).max() / 0.001 <= facts.acceleration * 1.05


def test_the_arm_rides_along_in_its_posture() -> None:
    there = cell("ur5e_whiteboard")
    arm, before = there.arm(ARM["ur5e_whiteboard"]), there.arm(ARM["ur5e_whiteboard"]).measured.q
    run(there, DriveBase(there, robot=HERON, to=LAB + "Store"))
    store = pose(there.world.snapshot(), LAB + "Store")
    np.testing.assert_allclose(there.base(HERON).pose.position, store.position, atol=1e-3)
    np.testing.assert_allclose(arm.measured.q, before, atol=1e-3)
    relative = there.base(HERON).pose.inverse() @ arm.measured.pose
    assert np.linalg.norm(relative.position[:2]) < 1.0


def test_a_base_that_was_free_stops_at_what_gets_into_its_way_meanwhile() -> None:
    there = cell("ur5e_whiteboard")
    base, model = there.base(HERON), there.model
    base.drive_to(base.pose @ Pose.of((1.5, 0.0, 0.0)))
    there.advance(1.0)
    assert not base.at_rest
    ahead = base.pose.apply(np.array([0.9, 0.0, 0.0]))
    body = model.body("lab:StoreTable").id
    model.body_pos[body] = [*ahead[:2], 0.66]
    there.refresh()
    while not base.at_rest:
        there.advance(0.05)
    assert base.fault == "its bumper touched something"
    assert not base.done
