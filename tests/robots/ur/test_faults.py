"""What goes wrong on the way to a controller, and at it: found, and the arm ends at rest with the cause."""

from __future__ import annotations

from collections.abc import Iterator
from threading import Thread

import numpy as np
import pytest

from robots.ur.linking import Loop, describe, swing
from robots.ur.peer import Peer, running_peer, wait_until
from robots.ur.proxy import running_proxy
from robots.ur.tasks import ARM, PATIENT, compiled, opened, run_goal, scene_of
from skillc_ontology import catalogue
from skillc_runtime.backends.control_process.link import LinkLost
from skillc_runtime.backends.real_time.device_cell import DeviceCell
from skillc_runtime.backends.ur.link import UrLink
from skillc_runtime.devices.backend import BackendBroken, BackendUnavailable, StopPersists
from skillc_runtime.motion.path import path_through
from skillc_runtime.motion.pose import Pose
from skillc_runtime.motion.segments import MotionLimits
from skillc_runtime.world.state.changes import SetProperty
from skillc_runtime.world.state.terms import DRIVER_ADDRESS

pytest.importorskip("rtde_control", reason="ur-rtde is not installed: pip install 'skillc[ur]'")
pytestmark = [pytest.mark.robot, pytest.mark.sim]
BUTTON_CELL = catalogue.scene_path("ur5e_button")


def near(peer: Peer) -> str:
    """Return an address beside that of a peer."""
    return peer.host + "1"


def test_a_network_that_delays_and_jitters_commands_nothing_beyond_limits() -> None:
    with running_peer() as peer, running_proxy(near(peer), peer.host) as proxy:
        link = UrLink(describe(proxy.host, silence_s=2.0))
        link.connect()
        loop = Loop(link)
        loop.run(1)
        start = loop.state.q.copy()
        link.take_control("position")
        proxy.set(delay=0.01, jitter=0.02)
        loop.run(400, swing(start, 0, 0.1, 400))
        assert link.condition.kind == "in-control"
        proxy.set(delay=0.0, jitter=0.0)
        loop.run(50, lambda _c, _s: start)
        told = peer.tell()
        assert (told["violations"], told["safety"]) == ([], "NORMAL")
        assert np.array(told["q"]) == pytest.approx(start, abs=0.01)
        link.close()


def test_a_cable_that_is_unplugged_stops_the_arm_on_both_sides() -> None:
    with running_peer() as peer, running_proxy(near(peer), peer.host) as proxy:
        link = UrLink(describe(proxy.host))
        link.connect()
        loop = Loop(link)
        loop.run(1)
        start = loop.state.q.copy()
        link.take_control("position")
        wanted = swing(start, 0, 0.3, 600)
        loop.run(150, wanted)
        proxy.set(hold=True)
        with pytest.raises(LinkLost, match="has sent no state for 500 ms"):
            loop.run(2000, lambda cycle, state: wanted(150 + cycle, state))
        wait_until(lambda: peer.tell()["runtime"] == "STOPPED")
        wait_until(lambda: np.abs(peer.tell()["dq"]).max() < 1e-6)
        assert peer.tell()["violations"] == []
        proxy.set(hold=False)
        link.close()


@pytest.fixture
def peer() -> Iterator[Peer]:
    with running_peer(*PATIENT, "--unlock", "2.0", scene=BUTTON_CELL) as running:
        yield running


@pytest.fixture
def cell(peer: Peer) -> Iterator[DeviceCell]:
    library = compiled("contact")
    with opened(peer, scene_of(peer, BUTTON_CELL, library)) as made:
        yield made


def begin_to_move(cell: DeviceCell, peer: Peer) -> None:
    """Begin a slow motion of the tool, and wait until it moves."""
    assert cell.watchdog.beat("test", cell.now)
    arm = cell.arm(ARM)
    start = arm.motion.stopping_pose()
    goal = Pose(start.position + np.array([0.0, 0.2, 0.0]), start.rotation)
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


def test_a_protective_stop_in_motion_is_named_and_can_be_acknowledged(cell: DeviceCell, peer: Peer) -> None:
    begin_to_move(cell, peer)
    peer.do("protect")
    assert "has stopped by itself (protective stop)" in await_fault(cell)
    wait_until(lambda: np.abs(peer.tell()["dq"]).max() < 1e-3)
    report = cell.stops.report
    assert report is not None
    assert (report.kind, "lab:Ur5e-1" in report.reason) == ("protective-stop", True)
    with pytest.raises(StopPersists, match="until 5s after occurrence"):
        cell.stops.clear()
    stopped_at = peer.tell()["now"]
    wait_until(lambda: peer.tell()["now"] > stopped_at + 2.1)
    cell.stops.clear()
    assert cell.stops.report is None
    begin_to_move(cell, peer)
    assert peer.tell()["violations"] == []


def test_a_protective_stop_in_a_task_fails_it_with_the_cause(cell: DeviceCell, peer: Peer) -> None:
    def step_in() -> None:
        wait_until(lambda: np.abs(peer.tell()["dq"]).max() > 0.1, 60.0)
        peer.do("protect")

    library = compiled("contact")
    goal = library.tasks["press_button"].goal
    assert goal is not None
    person = Thread(target=step_in, daemon=True)
    person.start()
    execution = run_goal(cell, scene_of(peer, BUTTON_CELL, library), library, goal)
    person.join()
    assert execution.status == "failed"
    assert "has stopped by itself (protective stop)" in str(execution.failure)
    wait_until(lambda: np.abs(peer.tell()["dq"]).max() < 1e-3)
    assert peer.tell()["violations"] == []


def test_a_controller_whose_power_is_cut_in_motion_is_named(cell: DeviceCell, peer: Peer) -> None:
    begin_to_move(cell, peer)
    peer.kill()
    assert f"Ur5e-1 at {peer.host}" in await_fault(cell)
    assert cell.is_at_rest()


def test_a_panel_in_local_control_is_a_stop_of_the_cell(peer: Peer) -> None:
    peer.do("remote", on=False)
    library = compiled("contact")
    with opened(peer, scene_of(peer, BUTTON_CELL, library)) as cell:
        wait_until(lambda: cell.stops.report is not None)
        report = cell.stops.report
        assert report is not None
        assert "is in local control: switch its panel to remote control" in report.reason
        assert peer.tell()["commands"] == 0


def test_an_address_where_nobody_is_and_one_that_nobody_states(peer: Peer) -> None:
    library = compiled("contact")
    nobody = scene_of(peer, BUTTON_CELL, library, [SetProperty(ARM, DRIVER_ADDRESS, "127.0.0.97")])
    with pytest.raises(BackendUnavailable, match=r"127\.0\.0\.97 \(port 29999\) does not answer"), opened(peer, nobody):
        pass
