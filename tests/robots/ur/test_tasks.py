"""Shipped tasks through the protocol of Universal Robots, with what only this protocol has."""

from __future__ import annotations

from pathlib import Path
from threading import Thread

import numpy as np
import pytest

from robots.ur.body import BODY
from robots.ur.emulator.grippers import ROBOTIQ_PORT
from robots.ur.peer import Peer, running_peer
from robots.ur.tasks import BOARD, HAND, PATIENT, opened, run_goal, with_peer
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import DRIVER_ADDRESS, GRIPPER_PROTOCOL, IS_CLEAN, SKILLC
from waiting import wait_until

pytest.importorskip("rtde_control", reason="ur-rtde is not installed: pip install 'skillc[ur]'")
pytestmark = [pytest.mark.robot, pytest.mark.long]
CONTACT_LIMIT_N = 80.0
"""skillc:contactForceLimit of the sheet."""


def test_a_part_is_picked_and_placed_by_fingers_behind_the_controller(tmp_path: Path) -> None:
    """The fingers are those of a WSG, behind the socket of a Robotiq gripper."""
    task = BODY.task("pick and place", tmp_path)
    with running_peer(*PATIENT, "--library", task.library.name, scene=task.scene) as peer:
        socket = SetProperty(HAND, DRIVER_ADDRESS, f"{peer.host}:{ROBOTIQ_PORT}")
        protocol = SetProperty(SKILLC + "wsg50-sheet", GRIPPER_PROTOCOL, "robotiq-urcap")
        state = with_peer(peer, task.state).with_changes([socket, protocol])
        with opened(peer, state) as cell:
            execution = run_goal(cell, state, task.library, task.goal)
            told = peer.tell()
        assert execution.status == "succeeded", execution.failure
        assert (told["violations"], told["safety"], told["carries"]) == ([], "NORMAL", None)
        x, y, z = told["things"]["lab:Part-A"]
        assert (abs(x - 0.45) < 0.1, abs(y - 0.14) < 0.1, 0.6 < z < 0.68) == (True, True, True)
        assert told["most"]["measured tool force"] < CONTACT_LIMIT_N
        assert peer.tell()["runtime"] == "STOPPED"


def is_wiping(peer: Peer) -> bool:
    """Whether some of the board is wiped, and the eraser presses on it."""
    return bool(peer.do("inspect", surface=BOARD)) and np.linalg.norm(peer.tell()["wrench"][:3]) > 4.0


def test_a_protective_stop_in_mid_wipe_ends_it_with_the_cause_and_it_is_wiped_afterwards(tmp_path: Path) -> None:
    task = BODY.task("wipe", tmp_path)
    with running_peer(*PATIENT, "--unlock", "1.0", "--library", task.library.name, scene=task.scene) as peer:

        def step_in() -> None:
            wait_until(lambda: is_wiping(peer))
            peer.do("protect")

        state = with_peer(peer, task.state)
        with opened(peer, state) as cell:
            person = Thread(target=step_in, daemon=True)
            person.start()
            execution = run_goal(cell, state, task.library, task.goal)
            person.join()
            assert execution.status == "failed"
            assert "has stopped by itself (protective stop)" in str(execution.failure)
            told = peer.tell()
            assert np.abs(told["dq"]).max() < 1e-3
            stopped_at = told["now"]
            wait_until(lambda: peer.tell()["now"] > stopped_at + 1.1)
            cell.stops.clear()
            assert cell.stops.report is None
            again = run_goal(cell, cell.world.snapshot(), task.library, task.goal)
            assert again.status == "succeeded", again.failure
            assert cell.world.snapshot().value(BOARD, IS_CLEAN) is True
        told = peer.tell()
        assert (told["violations"], told["safety"], told["runtime"]) == ([], "NORMAL", "STOPPED")
