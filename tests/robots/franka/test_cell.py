"""Whole cells against a robot that others simulate: tasks of the Panda, and what goes wrong in the middle of them."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from time import monotonic, sleep

import numpy as np
import pytest

from robots.franka.cells import LAB, carry_out, own_scene, real_cell
from robots.franka.running import Peer, proxy, robot, run_module
from skillc_ontology import catalogue
from skillc_runtime.backends.control_process.link import make_state
from skillc_runtime.backends.franka.link import FrankaDescription
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.devices.backend import StopPersists

pytestmark = [pytest.mark.robot, pytest.mark.slow]

HERE = Path(__file__).parent
ARM = LAB + "Arm-1"
LOOKED_S = 0.2
"""A cell has looked at its devices after this time."""


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
    wait(opened, lambda: is_cleared(opened))
    begin_to_move(opened)
    return opened


def begin_to_move(cell: DeviceCell) -> None:
    """Begin a slow motion of all joints."""
    q = cell.arm(ARM).measured.q
    cell.arm(ARM).motion.move_joints(q + (0.3 if q[0] < 0.15 else -0.3), 0.1)
    cell.advance(0.5)


def is_cleared(cell: DeviceCell) -> bool:
    """Acknowledge a stop, such as that of an arm that still moved when it was taken; tell whether none is left."""
    with suppress(StopPersists):
        cell.stops.clear()
    return cell.stops.report is None


def wait(cell: DeviceCell, until: Callable[[], bool]) -> None:
    """Wait for what must happen."""
    ends = monotonic() + 20.0
    while not until():
        assert monotonic() < ends, "it has not happened"
        sleep(0.02)


def test_an_arm_moves_within_limits_while_packets_are_lost_and_late(cell: DeviceCell, between: Peer) -> None:
    def arrive() -> None:
        wait(cell, lambda: cell.arm(ARM).motion.done)
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
    wait(cell, lambda: cell.stops.report is not None)
    assert cell.stops.report is not None
    assert cell.stops.report.kind == "protective-stop"
    assert "the torque on a joint was above what counts as a collision" in cell.stops.report.reason
    wait(cell, lambda: is_cleared(cell))
    cell.arm(ARM).motion.move_joints(cell.arm(ARM).measured.q + 0.05, 0.1)
    wait(cell, lambda: cell.arm(ARM).motion.done)
    assert between.ask("report")["violations"] == []


def test_a_stop_button_is_an_emergency_stop_that_persists_until_it_is_released(cell: DeviceCell, between: Peer) -> None:
    between.tell("user-stop")
    wait(cell, lambda: cell.stops.report is not None and cell.stops.report.kind == "emergency-stop")
    with pytest.raises(StopPersists, match="release it"):
        cell.stops.clear()
    between.tell("release")
    wait(cell, lambda: is_cleared(cell))


def test_a_robot_that_is_paused_stops_the_cell_with_its_name_and_goes_on_once_it_answers(
    cell: DeviceCell, simulated: Peer, between: Peer
) -> None:
    os.kill(simulated.process.pid, signal.SIGSTOP)
    wait(cell, lambda: cell.stops.report is not None)
    assert cell.stops.report is not None
    assert f"the robot at {between.address} does not answer any more" in cell.stops.report.reason
    os.kill(simulated.process.pid, signal.SIGCONT)
    wait(cell, lambda: is_cleared(cell))
    assert np.abs(cell.arm(ARM).measured.dq).max() < 0.05
    begin_to_move(cell)
    wait(cell, lambda: cell.arm(ARM).motion.done)
    assert between.ask("report")["violations"] == []


def test_an_arm_that_is_not_ready_when_its_cell_is_opened_is_reported_and_one_that_dies_with_its_name(
    tmp_path: Path,
) -> None:
    with robot() as simulated, proxy(simulated) as between:
        between.tell("mode 3")
        between.tell("swap 1 3")
        with real_cell(own_scene("sorting", "sort_parts", between.address, tmp_path)) as cell:
            wait(cell, lambda: cell.stops.report is not None)
            assert cell.stops.report is not None
            assert "the robot is guided by hand" in cell.stops.report.reason
            between.tell("release")
            sleep(LOOKED_S)
            with pytest.raises(StopPersists, match=r"is not as the facts say: .* that of another one"):
                cell.stops.clear()
            assert between.ask("report")["commands"] == 0
            between.tell("swap 0 0")
            sleep(LOOKED_S)
            cell.stops.clear()
            begin_to_move(cell)
            os.kill(simulated.process.pid, signal.SIGKILL)
            wait(cell, lambda: cell.stops.report is not None)
            assert between.address in cell.stops.report.reason
            assert between.ask("report")["violations"] == []
            with pytest.raises(StopPersists, match=r"cannot be used"):
                cell.stops.clear()


def test_an_arm_whose_program_is_killed_in_mid_motion_comes_to_rest_and_is_given_back(tmp_path: Path) -> None:
    with robot() as simulated, proxy(simulated) as before:
        kill_in_motion(before, tmp_path)
        link = FrankaDescription(before.address, catalogue.model_path("robots/fr3.xml")).make_link()
        link.connect()
        assert link.condition.kind == "ready"
        state = make_state(7)
        link.read(state)
        assert np.abs(state.dq).max() < 0.02
        link.close()
        assert before.ask("report")["violations"] == []


def kill_in_motion(before: Peer, folder: Path) -> None:
    """Kill a program that moves the arm, and wait until nobody commands it any more."""
    program = run_module("mover", before.address, str(folder))
    assert program.stdout is not None
    assert program.stdout.readline() == "moving\n"
    sleep(0.5)
    program.kill()
    program.communicate()
    ends, last = monotonic() + 20.0, -1
    while (commands := before.ask("report")["commands"]) != last:
        assert monotonic() < ends, "the robot is still commanded"
        last = commands
        sleep(0.3)


def test_a_button_is_pressed_within_limits(tmp_path: Path) -> None:
    with robot(HERE / "button.xml") as simulated, proxy(simulated) as between:
        world = own_scene("contact", "press_button_panda", between.address, tmp_path)
        with real_cell(world, simulated) as cell:
            done = carry_out("contact", "press_button_panda", cell)
        assert done.status == "succeeded", done.failure
        assert between.ask("report")["violations"] == []


@pytest.mark.long
def test_parts_are_put_into_their_boxes_within_limits(tmp_path: Path) -> None:
    with robot(HERE / "parts.xml") as simulated, proxy(simulated) as between:
        with real_cell(own_scene("sorting", "sort_parts", between.address, tmp_path), simulated) as cell:
            done = carry_out("sorting", "sort_parts", cell)
        assert done.status == "succeeded", done.failure
        for part, box_y in (("Part-A", 0.15), ("Part-B", 0.36)):
            np.testing.assert_allclose(simulated.ask(f"pose {part}")[:2], [0.45, box_y], atol=0.02)
        assert between.ask("report")["violations"] == []


@pytest.mark.long
def test_a_desk_is_wiped_well_and_within_limits(tmp_path: Path) -> None:
    with robot(HERE / "desk.xml") as simulated, proxy(simulated) as between:
        with real_cell(own_scene("wiping", "clean_desk", between.address, tmp_path), simulated) as cell:
            simulated.ask("wipe Desk-1 Eraser-1")
            done = carry_out("wiping", "clean_desk", cell)
        assert done.status == "succeeded", done.failure
        assert simulated.ask("wiped") > 0.99
        simulated.ask(f"save {tmp_path / 'samples.npy'}")
        _, force, tilt = np.load(tmp_path / "samples.npy").T
        touching = np.flatnonzero(force > 5.0)
        wiping = slice(touching[len(touching) // 4], touching[3 * len(touching) // 4])
        assert force[wiping].mean() == pytest.approx(10.0, rel=0.1)
        assert force[wiping].min() > 0.5
        assert np.degrees(np.sqrt((tilt[wiping] ** 2).mean())) < 1.0
        assert between.ask("report")["violations"] == []
