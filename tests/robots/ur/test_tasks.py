"""Shipped tasks through the protocol of Universal Robots, judged by what is true behind the controller."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

from robots.ur.peer import Peer, running_peer
from robots.ur.tasks import HAND, HERE, LAB, PATIENT, compiled, opened, run_goal, scene_of
from skillc.services.library_files import SHIPPED
from skillc_model.conditions import Condition, Holds, Individual
from skillc_runtime.world.state.changes import Change, ClearProperty, SetProperty
from skillc_runtime.world.state.terms import CONTAIN, DRIVER_ADDRESS, GRIPPER_PROTOCOL, SKILLC

pytest.importorskip("rtde_control", reason="ur-rtde is not installed: pip install 'skillc[ur]'")
pytestmark = [pytest.mark.robot, pytest.mark.sim]
WIPE_N = 8.0
SHEET = SKILLC + "ur5e-sheet"
CONTACT_LIMIT_N = 80.0
"""skillc:contactForceLimit of the sheet."""

RIGID = 0.002
"""Admittance in m/(s N) of an arm that puts rigid things on rigid things, through servos that are some 25 ms late: with
the 0.008 of the sheet they met with 76 to 84 N, four times as hard as in simulation."""


def goal_of(library: str, task: str) -> Condition:
    goal = compiled(SHIPPED / library).tasks[task].goal
    assert goal is not None
    return goal


def run(
    library: str,
    scene: Path,
    goal: Condition,
    ask: Callable[[Peer], Any] = lambda _: None,
    changes: Sequence[Change] = (),
) -> tuple[Any, Any]:
    """Run a goal; return what the peer says at the end, and its answer to one more question."""
    skills = compiled(SHIPPED / library)
    with running_peer(*PATIENT, "--library", library, scene=scene) as peer:
        state = scene_of(peer, scene, skills, changes)
        with opened(peer, state) as cell:
            execution = run_goal(cell, state, skills, goal)
            told, answer = peer.tell(), ask(peer)
        assert execution.status == "succeeded", execution.failure
        assert (told["violations"], told["safety"]) == ([], "NORMAL")
        assert peer.tell()["runtime"] == "STOPPED"
    return told, answer


@pytest.mark.long
def test_the_whiteboard_is_wiped() -> None:
    goal = goal_of("wiping", "clean_whiteboard")
    told, judged = run("wiping", HERE / "whiteboard.ttl", goal, lambda peer: peer.do("judge", command_n=WIPE_N))
    assert judged["coverage"] == 1.0
    assert judged["mean_error"] < 0.05
    assert judged["rmse"] < 0.15
    assert judged["tilt_rms_deg"] < 2.0
    assert judged["lost"] == 0.0
    assert told["payload"] == pytest.approx(1.32), "gripper and eraser"


def test_a_part_is_picked_and_placed_by_fingers_behind_the_controller() -> None:
    goal = Holds(Individual(LAB + "Box-A"), CONTAIN, Individual(LAB + "Part-A"))
    slower = SetProperty(SHEET, SKILLC + "admittance", RIGID)
    # The fingers are those of a WSG, behind the socket of a Robotiq gripper at the address of the arm.
    socket = [
        SetProperty(SKILLC + "wsg50-sheet", GRIPPER_PROTOCOL, "robotiq-urcap"),
        ClearProperty(HAND, DRIVER_ADDRESS),
    ]
    told, _ = run("sorting", HERE / "parts.ttl", goal, changes=[slower, *socket])
    x, y, z = told["things"]["lab:Part-A"]
    assert (abs(x - 0.45) < 0.1, abs(y - 0.14) < 0.1, 0.6 < z < 0.68) == (True, True, True)
    assert told["carries"] is None
    assert told["most"]["measured tool force"] < CONTACT_LIMIT_N
