"""How cells of a robot that others simulate begin and end, and tasks of the Panda in them."""

from __future__ import annotations

import os
import signal
from pathlib import Path
from threading import Thread
from time import monotonic, sleep

import numpy as np
import pytest

from robots.franka.cells import begin_to_move, carry_out, is_cleared, own_scene, real_cell
from robots.franka.running import Peer, run_module
from skillc_ontology import catalogue
from skillc_runtime.backends.control_process.link import make_state
from skillc_runtime.backends.franka.link import FrankaDescription
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.devices.backend import StopPersists
from waiting import LONG_S, wait_until

pytestmark = [pytest.mark.robot, pytest.mark.slow]


def test_an_arm_whose_program_is_killed_in_mid_motion_comes_to_rest_and_is_given_back(
    before: Peer, tmp_path: Path
) -> None:
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
    began = before.ask("report")["commands"]
    wait_until(lambda: before.ask("report")["commands"] > began + 300)
    program.kill()
    program.communicate()
    ends, last = monotonic() + LONG_S, -1
    while (commands := before.ask("report")["commands"]) != last:
        assert monotonic() < ends, "the robot is still commanded"
        last = commands
        sleep(0.3)


def test_an_arm_that_is_not_ready_when_its_cell_is_opened_is_reported_and_one_that_dies_with_its_name(
    simulated: Peer, before: Peer, tmp_path: Path
) -> None:
    before.tell("mode 3")
    before.tell("swap 4 6")
    with real_cell(own_scene("sorting", "sort_parts", before.address, tmp_path)) as cell:
        wait_until(lambda: cell.stops.report is not None)
        assert cell.stops.report is not None
        assert "the robot is guided by hand" in cell.stops.report.reason
        before.tell("release")
        wait_until(lambda: "is not as the facts say" in refuse(cell))
        assert "that of another one" in refuse(cell)
        assert before.ask("report")["commands"] == 0
        before.tell("swap 0 0")
        wait_until(lambda: is_cleared(cell))
        begin_to_move(cell)
        os.kill(simulated.process.pid, signal.SIGKILL)
        wait_until(lambda: cell.stops.report is not None)
        assert before.address in cell.stops.report.reason
        assert before.ask("report")["violations"] == []
        assert "there is no connection" in refuse(cell)


def refuse(cell: DeviceCell) -> str:
    """Acknowledge a stop; return why it persists, nothing if it does not."""
    try:
        cell.stops.clear()
    except StopPersists as persists:
        return str(persists)
    return ""


@pytest.mark.long
def test_a_reflex_in_mid_wipe_ends_the_task_at_rest_and_once_it_is_acknowledged_the_desk_is_finished(
    tmp_path: Path,
) -> None:
    from robots.franka.body import BODY, open_task

    with open_task(BODY.task("wipe", tmp_path), tmp_path) as (cell, simulated, between):

        def bump() -> None:
            wait_until(lambda: float(simulated.ask("wiped")) > 0.3)
            between.tell("reflex cartesian_reflex")

        person = Thread(target=bump, daemon=True)
        person.start()
        stopped = carry_out("wiping", "clean_desk", cell)
        person.join()
        assert stopped.status == "failed"
        assert "the force on the tool was above what counts as a collision" in str(stopped.failure)
        assert cell.stops.report is not None
        assert cell.stops.report.kind == "protective-stop"
        assert cell.is_at_rest()
        wait_until(lambda: is_cleared(cell))
        done = carry_out("wiping", "clean_desk", cell)
        assert done.status == "succeeded", done.failure
        assert simulated.ask("wiped") > 0.99
        assert between.ask("report")["violations"] == []
