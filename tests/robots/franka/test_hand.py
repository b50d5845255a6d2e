"""The Franka Hand against a simulated one: it opens, closes on things, stops on the way, and says when it is gone."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, cast

import pytest

from robots.franka.running import Peer, own_address, robot
from skillc_runtime.backends.franka.hand import FrankaHand
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.devices.backend import BackendUnavailable, StopPersists
from skillc_runtime.motion.pose import Pose
from waiting import wait_until

pytestmark = [pytest.mark.robot, pytest.mark.slow]

FACTS = GripperSpec("hand", Path("none.xml"), 0.08, 70.0, 0.05, opening_bias_m=0.002)
HERE = Pose.of((0.0, 0.0, 0.0))


class HoldingArm:
    """Notes what it is told to hold."""

    def __init__(self) -> None:
        self.held: list[Any] = []

    def hold(self, thing: str, in_tool_centre: Pose, mass_kg: float, opening_m: float) -> None:
        self.held.append((thing, mass_kg))

    def set_load(self, load: None) -> None:
        self.held.append(load)


@pytest.fixture
def hand(simulated: Peer) -> Iterator[FrankaHand]:
    hand = FrankaHand(FACTS, simulated.address, cast("Any", HoldingArm()))
    yield hand
    hand.close()


def move(hand: FrankaHand, opening_m: float) -> None:
    hand.move(opening_m, 30.0)
    assert hand.moving
    wait_until(lambda: not hand.moving)
    assert hand.fault is None


def test_it_moves_where_it_is_told_and_is_not_blocked_by_nothing(hand: FrankaHand) -> None:
    move(hand, 0.06)
    assert hand.opening_m == pytest.approx(0.06, abs=0.003)
    assert not hand.blocked
    move(hand, 0.0)
    assert hand.opening_m < FACTS.opening_bias_m
    assert not hand.blocked
    with pytest.raises(RuntimeError, match="nothing keeps the fingers"):
        hand.attach("part", HERE, 0.1)


def test_it_stops_on_the_way(hand: FrankaHand) -> None:
    move(hand, 0.08)
    hand.move(0.0, 30.0)
    time.sleep(0.3)
    hand.stop()
    assert not hand.moving
    assert hand.fault is None
    assert 0.005 < hand.opening_m < 0.075
    move(hand, 0.08)
    assert hand.opening_m > 0.075


def test_what_is_between_the_fingers_blocks_them_and_counts_as_held_until_they_close_further(tmp_path: Path) -> None:
    scene = '<mujoco><worldbody><geom type="box" size="0.02 0.02 0.12" pos="0.554 0 0.42"/></worldbody></mujoco>'
    (tmp_path / "part.xml").write_text(scene, "utf-8")
    with robot(tmp_path / "part.xml") as simulated:
        arm = HoldingArm()
        hand = FrankaHand(FACTS, simulated.address, cast("Any", arm))
        move(hand, 0.0)
        assert hand.blocked
        assert hand.opening_m > 0.02
        hand.attach("part", HERE, 0.1)
        assert hand.holding == "part"
        hand.detach()
        assert hand.holding is None
        assert arm.held == [("part", 0.1), None]
        simulated.close()
        wait_until(lambda: hand.fault is not None)
        assert hand.fault is not None
        assert simulated.address in hand.fault
        with pytest.raises(StopPersists, match="there is no connection"):
            hand.recover()
        hand.close()


def test_a_hand_that_is_not_there_is_told_with_what_to_do() -> None:
    with pytest.raises(BackendUnavailable, match="is a Franka Hand set as end effector in Desk"):
        FrankaHand(FACTS, own_address(), cast("Any", HoldingArm()))


def test_fingers_that_do_not_open_as_far_as_the_sheet_says_have_not_been_homed(simulated: Peer) -> None:
    wide = GripperSpec("hand", Path("none.xml"), 0.11, 70.0, 0.05)
    with pytest.raises(BackendUnavailable, match="opens to 80 mm, not to 110 mm: home it in Desk"):
        FrankaHand(wide, simulated.address, cast("Any", HoldingArm()))
