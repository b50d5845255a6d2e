"""A whole cell against a robot that others simulate, and what goes wrong in the middle of a motion."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from time import sleep

import numpy as np
import pytest

from robots.franka.cells import ARM, LOOKED_S, begin_to_move, is_cleared, own_scene, real_cell
from robots.franka.running import Peer, proxy
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.devices.backend import StopPersists
from waiting import wait_until

pytestmark = [pytest.mark.robot, pytest.mark.slow]


@pytest.fixture(scope="module")
def between(simulated: Peer) -> Iterator[Peer]:
    """The proxy before the robot of the cell."""
    with proxy(simulated) as peer:
        yield peer


@pytest.fixture(scope="module")
def opened(between: Peer, tmp_path_factory: pytest.TempPathFactory) -> Iterator[DeviceCell]:
    """A cell with nothing around its arm."""
    with real_cell(own_scene("sorting", "sort_parts", between.address, tmp_path_factory.mktemp("cell"))) as cell:
        sleep(LOOKED_S)
        yield cell


@pytest.fixture
def cell(opened: DeviceCell) -> DeviceCell:
    """That cell, whose arm moves."""
    wait_until(lambda: is_cleared(opened))
    begin_to_move(opened)
    return opened


def test_an_arm_moves_within_limits_while_packets_are_lost_and_late(cell: DeviceCell, between: Peer) -> None:
    def arrive() -> None:
        wait_until(lambda: cell.arm(ARM).motion.done)
        assert cell.stops.report is None
        assert cell.arm(ARM).motion.tracking_error_message is None

    arrive()
    between.tell("drop 0.02")
    between.tell("delay 3")
    begin_to_move(cell)
    arrive()
    between.tell("drop 0")
    between.tell("delay 0")
    report = between.ask("report")
    assert report["commands"] > 500
    assert report["dropped"] > 10
    assert report["violations"] == []
    assert report["greatest_speed_share"] < 1.0


def test_a_reflex_in_mid_motion_stops_the_cell_until_it_is_acknowledged(cell: DeviceCell, between: Peer) -> None:
    between.tell("reflex joint_reflex")
    wait_until(lambda: cell.stops.report is not None)
    assert cell.stops.report is not None
    assert cell.stops.report.kind == "protective-stop"
    assert "the torque on a joint was above what counts as a collision" in cell.stops.report.reason
    wait_until(lambda: is_cleared(cell))
    cell.arm(ARM).motion.move_joints(cell.arm(ARM).measured.q + 0.05, 0.1)
    wait_until(lambda: cell.arm(ARM).motion.done)
    assert between.ask("report")["violations"] == []


def test_a_stop_button_is_an_emergency_stop_that_persists_until_it_is_released(cell: DeviceCell, between: Peer) -> None:
    between.tell("user-stop")
    wait_until(lambda: cell.stops.report is not None and cell.stops.report.kind == "emergency-stop")
    with pytest.raises(StopPersists, match="release it"):
        cell.stops.clear()
    between.tell("release")
    wait_until(lambda: is_cleared(cell))


def test_a_robot_that_is_paused_stops_the_cell_with_its_name_and_goes_on_once_it_answers(
    cell: DeviceCell, simulated: Peer, between: Peer
) -> None:
    os.kill(simulated.process.pid, signal.SIGSTOP)
    wait_until(lambda: cell.stops.report is not None)
    assert cell.stops.report is not None
    assert f"the robot at {between.address} does not answer any more" in cell.stops.report.reason
    os.kill(simulated.process.pid, signal.SIGCONT)
    wait_until(lambda: is_cleared(cell))
    assert np.abs(cell.arm(ARM).measured.state.dq).max() < 0.05
    begin_to_move(cell)
    wait_until(lambda: cell.arm(ARM).motion.done)
    assert between.ask("report")["violations"] == []
