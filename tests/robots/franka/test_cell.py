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


@pytest.fixture
def cell(before: Peer, tmp_path: Path) -> Iterator[DeviceCell]:
    """A cell with nothing around its arm, which moves."""
    with real_cell(own_scene("sorting", "sort_parts", before.address, tmp_path)) as cell:
        sleep(LOOKED_S)
        wait(cell, lambda: is_cleared(cell))
        q = cell.arm(ARM).measured.q
        cell.arm(ARM).motion.move_joints(q + (0.3 if q[0] < 0.15 else -0.3), 0.1)
        cell.advance(0.5)
        yield cell


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


def test_an_arm_moves_within_limits_and_comes_to_rest(cell: DeviceCell, before: Peer) -> None:
    wait(cell, lambda: cell.arm(ARM).motion.done)
    assert cell.stops.report is None
    assert cell.arm(ARM).motion.tracking_error_message is None
    report = before.ask("report")
    assert report["commands"] > 500
    assert report["violations"] == []


def test_a_reflex_in_mid_motion_stops_the_cell_until_it_is_acknowledged(cell: DeviceCell, before: Peer) -> None:
    before.tell("reflex joint_reflex")
    wait(cell, lambda: cell.stops.report is not None)
    assert cell.stops.report is not None
    assert cell.stops.report.kind == "protective-stop"
    assert "the torque on a joint was above what counts as a collision" in cell.stops.report.reason
    wait(cell, lambda: is_cleared(cell))
    cell.arm(ARM).motion.move_joints(cell.arm(ARM).measured.q + 0.05, 0.1)
    wait(cell, lambda: cell.arm(ARM).motion.done)
    assert before.ask("report")["violations"] == []


def test_a_stop_button_is_an_emergency_stop_that_persists_until_it_is_released(cell: DeviceCell, before: Peer) -> None:
    before.tell("user-stop")
    wait(cell, lambda: cell.stops.report is not None and cell.stops.report.kind == "emergency-stop")
    with pytest.raises(StopPersists, match="release it"):
        cell.stops.clear()
    before.tell("release")
    wait(cell, lambda: is_cleared(cell))


def test_a_robot_that_dies_stops_the_cell_with_its_name(tmp_path: Path) -> None:
    with robot() as simulated, real_cell(own_scene("sorting", "sort_parts", simulated.address, tmp_path)) as cell:
        os.kill(simulated.process.pid, signal.SIGKILL)
        wait(cell, lambda: cell.stops.report is not None)
        assert cell.stops.report is not None
        assert simulated.address in cell.stops.report.reason
        with pytest.raises(StopPersists, match=r"cannot be used"):
            cell.stops.clear()


def test_an_arm_whose_program_is_killed_in_mid_motion_comes_to_rest_and_is_given_back(
    before: Peer, tmp_path: Path
) -> None:
    program = run_module("mover", before.address, str(tmp_path))
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
    link = FrankaDescription(before.address, catalogue.model_path("robots/fr3.xml")).make_link()
    link.connect()
    assert link.condition.kind == "ready"
    state = make_state(7)
    link.read(state)
    assert np.abs(state.dq).max() < 0.02
    link.close()
    assert before.ask("report")["violations"] == []


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
