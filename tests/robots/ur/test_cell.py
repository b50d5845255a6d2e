"""A cell of one arm with its gripper and what is wired to it: what it does, and how it ends when something goes wrong.

One controller and one cell serve all tests, so each leaves both in order; the last one cuts the power.
"""

from __future__ import annotations

from collections.abc import Iterator
from threading import Thread

import numpy as np
import pytest

from robots.ur.peer import Peer, running_peer
from robots.ur.tasks import ARM, HERE, LAB, PATIENT, compiled, opened, run_call, run_goal, scene_of
from skillc_model.skills import SkillLibrary
from skillc_ontology import catalogue
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.devices.backend import BackendBroken, StopPersists
from skillc_runtime.motion.paths.path import path_through
from skillc_runtime.motion.paths.segments import MotionLimits
from skillc_runtime.motion.pose import Pose
from skillc_runtime.world.state.changes import AddIndividual, SetProperty
from skillc_runtime.world.state.terms import INPUT_POINT, LEVEL, OUTPUT_POINT, UR
from skillc_runtime.world.state.world_state import WorldState
from waiting import wait_until

pytest.importorskip("rtde_control", reason="ur-rtde is not installed: pip install 'skillc[ur]'")
pytestmark = [pytest.mark.robot, pytest.mark.sim]
BUTTON_CELL = catalogue.scene_path("ur5e_button")
LAMP, BARRIER = LAB + "Lamp-1", LAB + "Barrier-1"
WIRED = [
    AddIndividual(LAMP, (OUTPUT_POINT,)), SetProperty(LAMP, UR + "digitalOutput", 5),
    AddIndividual(BARRIER, (INPUT_POINT,)), SetProperty(BARRIER, UR + "digitalInput", 6),
]  # fmt: skip
AWAIT = "AwaitInput(point: lab:Barrier-1, least: 0.5"
UNLOCK_S = 1.0


@pytest.fixture(scope="module")
def library() -> SkillLibrary:
    """A library that presses buttons, and uses inputs and outputs."""
    return compiled(HERE / "wired.skill")


@pytest.fixture(scope="module")
def peer() -> Iterator[Peer]:
    """A controller with a button before its arm."""
    with running_peer(*PATIENT, "--unlock", str(UNLOCK_S), scene=BUTTON_CELL) as running:
        yield running


@pytest.fixture(scope="module")
def state(peer: Peer, library: SkillLibrary) -> WorldState:
    """The scene, with the facts of the controller and what is wired to it."""
    return scene_of(peer, BUTTON_CELL, library, WIRED)


@pytest.fixture(scope="module")
def shared(peer: Peer, state: WorldState) -> Iterator[DeviceCell]:
    """The cell, opened before the brakes were released and the panel was switched to remote control."""
    peer.do("lose", mode="IDLE")
    peer.do("remote", on=False)
    with opened(peer, state) as made:
        yield made


@pytest.fixture
def resting(shared: DeviceCell) -> Iterator[DeviceCell]:
    """The cell, which rests afterwards."""
    yield shared
    shared.watchdog.retire("test")
    shared.secure()


@pytest.fixture
def cell(resting: DeviceCell, peer: Peer) -> DeviceCell:
    """The cell, whose brakes are released and whose panel is in remote control, whatever ran before."""
    if peer.tell()["mode"] == "IDLE":
        await_fault(resting)
        resting.watchdog.retire("test")
        peer.do("power")
        peer.do("remote", on=True)
        resting.stops.clear()
    return resting


def begin_to_move(cell: DeviceCell, peer: Peer, way: float = 0.2) -> None:
    """Begin a slow motion of the tool, as a new run, and wait until it moves."""
    cell.watchdog.retire("test")
    assert cell.watchdog.beat("test", cell.now)
    arm = cell.arm(ARM)
    start = arm.motion.stopping_pose()
    goal = Pose(start.position + np.array([0.0, way, 0.0]), start.rotation)
    arm.motion.move_along(path_through([start, goal], MotionLimits(speed=0.05, acceleration=0.5)))
    wait_until(lambda: np.abs(peer.tell()["dq"]).max() > 0.02)


def await_fault(cell: DeviceCell) -> str:
    """Let time pass until the cell says why it cannot go on."""
    for _ in range(1000):
        cell.watchdog.beat("test", cell.now)
        try:
            cell.advance(0.02)
        except BackendBroken as broken:
            return str(broken)
    raise AssertionError("nothing has been noticed")


def test_brakes_and_local_control_are_stops_of_the_cell_one_after_the_other(resting: DeviceCell, peer: Peer) -> None:
    before = peer.tell()["loaded"]
    assert "has its brakes on: switch it on and release its brakes at its panel" in await_fault(resting)
    peer.do("power")
    with pytest.raises(StopPersists, match="is in local control: switch its panel to remote control"):
        resting.stops.clear()
    assert peer.tell()["loaded"] == before, "nothing is sent to it"
    peer.do("remote", on=True)
    resting.stops.clear()
    assert peer.tell()["job"] != "Stop"
    begin_to_move(resting, peer)


def test_a_protective_stop_in_a_task_fails_it_with_the_cause_and_can_be_acknowledged(
    cell: DeviceCell, peer: Peer, state: WorldState, library: SkillLibrary
) -> None:
    def step_in() -> None:
        wait_until(lambda: np.abs(peer.tell()["dq"]).max() > 0.1)
        peer.do("protect")

    goal = library.tasks["press_button"].goal
    assert goal is not None
    person = Thread(target=step_in, daemon=True)
    person.start()
    execution = run_goal(cell, state, library, goal)
    person.join()
    assert execution.status == "failed"
    assert "has stopped by itself (protective stop)" in str(execution.failure)
    wait_until(lambda: np.abs(peer.tell()["dq"]).max() < 1e-3)
    report = cell.stops.report
    assert report is not None
    assert (report.kind, "lab:Ur5e-1" in report.reason) == ("protective-stop", True)
    seen_at = peer.tell()["now"]
    wait_until(lambda: peer.tell()["now"] > seen_at + UNLOCK_S)
    cell.stops.clear()
    begin_to_move(cell, peer)


def test_a_button_is_pressed_and_its_input_read(
    cell: DeviceCell, peer: Peer, state: WorldState, library: SkillLibrary
) -> None:
    goal = library.tasks["press_button"].goal
    assert goal is not None
    execution = run_goal(cell, state, library, goal)
    assert execution.status == "succeeded", execution.failure
    told = peer.tell()
    assert (told["violations"], told["safety"]) == ([], "NORMAL")
    assert told["payload"] == pytest.approx(1.2), "the gripper alone"


def test_a_skill_switches_an_output_and_waits_for_an_input(
    cell: DeviceCell, peer: Peer, state: WorldState, library: SkillLibrary
) -> None:
    assert run_call(cell, state, library, "SetOutput(output: lab:Lamp-1, level: 1.0)").status == "succeeded"
    assert peer.tell()["outputs"] >> 5 & 1
    wrong = run_call(cell, state, library, "SetOutput(output: lab:Lamp-1, level: 2.0)")
    assert "a digital output is set to 0 or 1, not to 2" in str(wrong.failure)
    dark = run_call(cell, state, library, f"{AWAIT}, patience: 0.2 s)")
    assert "lab:Barrier-1 is at 0, not at least 0.5, after 0.2 s" in str(dark.failure)
    peer.do("input", bits=1 << 6)
    assert run_call(cell, state, library, f"{AWAIT})").status == "succeeded"
    assert cell.world.snapshot().value(BARRIER, LEVEL) == 1.0


def test_a_speed_slider_slows_a_motion_and_lets_it_go_on(cell: DeviceCell, peer: Peer) -> None:
    """At 0 the arm all but stands still, and what is commanded does not run away from it."""
    begin_to_move(cell, peer)
    arm = cell.arm(ARM)

    def speed() -> float:
        cell.watchdog.beat("test", cell.now)
        return float(np.linalg.norm(arm.motion.reference.twist[:3]))

    wait_until(lambda: speed() > 0.045)
    for share in (0.2, 0.0):
        peer.do("slider", share=share)
        wait_until(lambda most=0.055 * share + 0.001: speed() < most)  # type: ignore[misc]
    peer.do("slider", share=1.0)
    wait_until(lambda: speed() > 0.045)
    assert arm.motion.tracking_error_message is None
    assert peer.tell()["violations"] == []


@pytest.mark.parametrize(
    ("what", "words", "says", "persists", "cure"),
    [
        ("program", {}, "has ended", "executes another program: stop that at its panel", "stop"),
        ("lose", {"mode": "POWER_OFF"}, "has no power", "has no power", "power"),
        ("press", {}, "emergency stop", "release it, then switch the arm on", "release"),
    ],
)
def test_what_takes_the_arm_in_motion_is_named_until_it_is_over(
    cell: DeviceCell, peer: Peer, what: str, words: dict[str, str], says: str, persists: str, cure: str
) -> None:
    begin_to_move(cell, peer)
    peer.do(what, **words)
    assert says in await_fault(cell)
    wait_until(lambda: np.abs(peer.tell()["dq"]).max() < 1e-3)
    with pytest.raises(StopPersists, match=persists):
        cell.stops.clear()
    assert (peer.tell()["runtime"] == "PLAYING") == (what == "program"), "the program of somebody else goes on"
    peer.do(cure)
    if cure == "release":
        peer.do("power")
    wait_until(lambda: peer.tell()["runtime"] == "STOPPED")
    cell.stops.clear()
    begin_to_move(cell, peer)
    assert peer.tell()["violations"] == []


def test_a_controller_that_stands_still_is_named_and_comes_back(cell: DeviceCell, peer: Peer) -> None:
    begin_to_move(cell, peer)
    with peer.paused():
        found = await_fault(cell)
        assert "has sent no state for" in found or "not answer: timed out" in found, "whichever is noticed first"
    wait_until(lambda: peer.tell()["runtime"] == "STOPPED")
    wait_until(lambda: np.abs(peer.tell()["dq"]).max() < 1e-3)
    cell.stops.clear()
    begin_to_move(cell, peer)
    assert peer.tell()["violations"] == []


def test_a_controller_whose_power_is_cut_in_motion_is_named(cell: DeviceCell, peer: Peer) -> None:
    begin_to_move(cell, peer)
    peer.kill()
    lost = "the inputs and outputs of lab:Ur5e-1 do not answer: the connection was closed"
    assert (why := await_fault(cell)) == lost or f"Ur5e-1 at {peer.host}" in why, "whichever is noticed first"
    assert cell.is_at_rest()
