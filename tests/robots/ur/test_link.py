"""The link to an arm of Universal Robots, against an emulated controller, with the library that users have."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import mujoco
import numpy as np
import pytest

from robots.ur.linking import Loop, connected, describe, swing
from robots.ur.peer import Peer
from robots.ur.proxy import Proxy, running_proxy
from skillc_ontology.catalogue import model_path
from skillc_runtime.backends.control_process.link import ControlRefused, LinkLost, PointMass
from skillc_runtime.backends.ur.link import UrLink
from skillc_runtime.devices.backend import BackendUnavailable
from waiting import wait_until

pytest.importorskip("rtde_control", reason="ur-rtde is not installed: pip install 'skillc[ur]'")
pytestmark = [pytest.mark.robot, pytest.mark.slow]


def test_it_reads_what_the_arm_measures_without_taking_control(peer: Peer) -> None:
    before = peer.tell()["loaded"]
    with connected(peer) as loop:
        loop.run(20)
        told = peer.tell()
        assert loop.link.condition.kind == "ready"
        assert loop.state.q == pytest.approx(np.array(told["q"]), abs=1e-3)
        assert np.isfinite(loop.state.buffer).all()
        assert (told["runtime"], told["loaded"]) == ("STOPPED", before)


def test_it_moves_within_limits_and_gives_control_back(peer: Peer) -> None:
    with connected(peer) as loop:
        start = loop.state.q.copy()
        loop.link.take_control("position")
        assert loop.link.condition.kind == "in-control"
        farthest = 0.0

        def wanted(cycle: int, state: object) -> np.ndarray:
            nonlocal farthest
            farthest = max(farthest, loop.state.q[0] - start[0])
            return swing(start, 0, 0.2, 500)(cycle, loop.state)

        loop.run(600, wanted)
        assert 0.19 < farthest < 0.21
        assert loop.state.q == pytest.approx(start, abs=2e-3)
        loop.link.give_back()
        loop.run(5)
        assert (loop.link.condition.kind, peer.tell()["runtime"]) == ("ready", "STOPPED")
    assert 0.5 < peer.tell()["most"]["speed"] < 0.7


def test_it_takes_joint_speeds(peer: Peer) -> None:
    with connected(peer) as loop:
        start = loop.state.q.copy()
        loop.link.take_control("velocity")
        before = loop.state.stamp_s[0]
        loop.run(200, lambda _c, _s: np.array([0.1, 0.0, 0.0, 0.0, 0.0, 0.0]), "velocity")
        seconds = loop.state.stamp_s[0] - before
        loop.run(60, lambda _c, _s: np.zeros(6), "velocity")
        assert 0.01 < loop.state.q[0] - start[0] < 0.12 * seconds + 0.01
        assert np.abs(loop.state.dq).max() < 1e-3


def test_the_wrench_is_that_on_the_flange_without_weight_and_offset(peer: Peer) -> None:
    hand = PointMass(1.2, np.array([0.0, 0.0, 0.06]))
    with connected(peer) as loop:
        loop.link.set_load(hand, PointMass(0.0, np.zeros(3)))
        loop.link.take_control("position")
        start = loop.state.q.copy()
        hold = lambda _c, _s: start  # noqa: E731
        loop.run(20, hold)
        assert peer.tell()["payload"] == pytest.approx(1.2)
        loop.link.tare()
        assert np.abs(mean_wrench(loop, hold)[:3]).max() < 0.3
        peer.do("push", force_n=[0.0, 0.0, -10.0])
        pushed = mean_wrench(loop, hold)
        peer.do("push", force_n=[0.0, 0.0, 0.0])
        rotation = flange_rotation(loop)
        assert rotation @ pushed[:3] == pytest.approx([0.0, 0.0, -10.0], abs=0.5)


def test_control_is_not_taken_from_somebody_else(peer: Peer) -> None:
    with connected(peer) as first, connected(peer) as second:
        first.link.take_control("position")
        for _ in range(10):
            second.run(1)
            first.run(1, lambda _c, state: state.q.copy())
        assert second.link.condition.kind == "not-in-control"
        with pytest.raises(ControlRefused, match="executes another program"):
            second.link.take_control("position")
        first.run(20, lambda _c, state: state.q.copy())
        assert first.link.condition.kind == "in-control"


def test_control_by_torques_is_refused_before_a_program_is_sent(peer: Peer) -> None:
    before = peer.tell()["loaded"]
    with connected(peer) as loop:
        assert loop.link.abilities.modes == ("position", "velocity")
        with pytest.raises(ControlRefused, match="takes positions and speeds of its joints, and no torque commands"):
            loop.link.take_control("torque")
    assert peer.tell()["loaded"] == before


def test_the_program_ends_when_commands_are_missing(peer: Peer) -> None:
    with connected(peer) as loop:
        loop.link.take_control("position")
        start = loop.state.q.copy()
        loop.run(100, swing(start, 0, 0.2, 500))
        wait_until(lambda: peer.tell()["runtime"] == "STOPPED")
        assert np.abs(peer.tell()["dq"]).max() < 1e-6
        loop.run(5)
        assert loop.link.condition.kind == "not-in-control"
        assert "ur:commandTimeout" in loop.link.condition.sentence
        loop.link.recover()
        loop.run(5)
        assert loop.link.condition.kind == "ready"


@contextmanager
def through_a_network(peer: Peer, silence_s: float = 0.5) -> Iterator[tuple[Proxy, Loop]]:
    """Connect through a proxy."""
    with running_proxy(peer.host + "1", peer.host) as proxy:
        link = UrLink(describe(proxy.host, silence_s=silence_s))
        link.connect()
        loop = Loop(link)
        loop.run(1)
        yield proxy, loop
        link.close()


def test_a_network_that_delays_jitters_and_stalls_commands_nothing_beyond_limits(peer: Peer) -> None:
    with through_a_network(peer, silence_s=2.0) as (proxy, loop):
        start = loop.state.q.copy()
        loop.link.take_control("position")
        proxy.set(delay=0.01, jitter=0.02)
        wanted = swing(start, 0, 0.1, 400)
        loop.run(200, wanted)
        # A packet that is lost comes again, after all that waits for it; 0.2 s is what kernels wait for at least.
        proxy.set(stall=0.2)
        loop.run(200, lambda cycle, state: wanted(200 + cycle, state))
        assert loop.link.condition.kind == "in-control"
        proxy.set(delay=0.0, jitter=0.0)
        loop.run(50, lambda _c, _s: start)
        told = peer.tell()
        assert told["safety"] == "NORMAL"
        assert np.array(told["q"]) == pytest.approx(start, abs=0.01)


def test_a_cable_that_is_unplugged_stops_the_arm_on_both_sides(peer: Peer) -> None:
    with through_a_network(peer) as (proxy, loop):
        wanted = swing(loop.state.q.copy(), 0, 0.3, 600)
        loop.link.take_control("position")
        loop.run(150, wanted)
        proxy.set(hold=True)
        with pytest.raises(LinkLost, match="has sent no state for 500 ms"):
            loop.run(2000, lambda cycle, state: wanted(150 + cycle, state))
        wait_until(lambda: peer.tell()["runtime"] == "STOPPED")
        wait_until(lambda: np.abs(peer.tell()["dq"]).max() < 1e-6)
        proxy.set(hold=False)


def test_a_controller_that_is_off_is_named() -> None:
    link = UrLink(describe("127.0.0.99"))
    with pytest.raises(BackendUnavailable, match=r"Ur5e-1 at 127\.0\.0\.99 \(port 29999\) does not answer"):
        link.connect()
    link.close()


def model_with(tmp_path: Path, right: str, wrong: str) -> Path:
    """Return a model of the arm in which something is wrong."""
    text = model_path("robots/ur5e.xml").read_text()
    assert right in text
    model = tmp_path / "wrong.xml"
    model.write_text(text.replace(right, wrong, 1))
    return model


PAN = '<joint name="shoulder_pan" axis="0 0 1"'
WRIST = '<joint name="wrist_3" axis="0 0 1"'


@pytest.mark.parametrize(
    ("right", "wrong", "says"),
    [
        (
            '<body name="forearm_link" pos="-0.425',
            '<body name="forearm_link" pos="-0.6127',
            r"is \d+ mm and 0 deg away",
        ),
        ('<site name="flange"/>', '<site name="flange" euler="0 0 1.5708"/>', "is 0 mm and 90 deg away"),
    ],
)
def test_an_arm_that_is_not_its_model_is_found_before_it_moves(
    peer: Peer, tmp_path: Path, right: str, wrong: str, says: str
) -> None:
    before = peer.tell()["commands"]
    with connected(peer, model=model_with(tmp_path, right, wrong)) as loop:
        with pytest.raises(ControlRefused, match=says):
            loop.link.take_control("position")
        assert (peer.tell()["commands"], peer.tell()["runtime"]) == (before, "STOPPED")


def bring_to_zero(peer: Peer, joint: int) -> None:
    """Move a joint to 0, from wherever the tests before have left it."""
    with connected(peer) as loop:
        loop.link.take_control("position")
        loop.run(600, swing(loop.state.q.copy(), joint, -loop.state.q[joint], 1200))
        assert abs(loop.state.q[joint]) < 0.1


@pytest.mark.parametrize(("joint", "axis"), [(0, PAN), (5, WRIST)])
def test_a_joint_that_turns_the_other_way_is_found_as_soon_as_it_shows(
    peer: Peer, tmp_path: Path, joint: int, axis: str
) -> None:
    wrong = model_with(tmp_path, axis, axis.replace("0 0 1", "0 0 -1"))
    bring_to_zero(peer, joint)
    # Near 0 nothing shows, and here less than what is tolerated.
    with connected(peer, model=wrong, tolerance_m=0.15, tolerance_rad=0.3) as loop:
        start = loop.state.q.copy()
        loop.link.take_control("position")
        wanted = swing(start, joint, 0.8, 1500)
        for cycle in range(750):
            if loop.link.condition.kind == "in-control":
                loop.run(1, lambda _c, state, cycle=cycle: wanted(cycle, state))  # type: ignore[misc]
        assert loop.link.condition.kind == "wrong-mode"
        assert "away from where its model says" in loop.link.condition.sentence
        assert abs(loop.state.q[joint] - start[joint]) < 0.6
        loop.link.give_back()


def test_a_gripper_that_weighs_less_than_its_model_is_found_before_it_moves(peer: Peer) -> None:
    before = peer.tell()["commands"]
    with connected(peer, offset_n=12.0) as loop:
        loop.link.set_load(PointMass(3.2, np.array([0.0, 0.0, 0.06])), PointMass(0.0, np.zeros(3)))
        with pytest.raises(ControlRefused, match=r"feels \d+ N before anything is done.*does not weigh what its model"):
            loop.link.take_control("position")
        assert (peer.tell()["commands"], peer.tell()["runtime"]) == (before, "STOPPED")


def mean_wrench(loop: Loop, hold: object) -> np.ndarray:
    """Return the mean of the wrench (6,) over 200 cycles, after it has settled."""
    loop.run(100, hold)  # type: ignore[arg-type]
    rows = []
    for _ in range(200):
        loop.run(1, hold)  # type: ignore[arg-type]
        rows.append(loop.state.wrench.copy())
    return np.mean(rows, axis=0)


def flange_rotation(loop: Loop) -> np.ndarray:
    """Return the axes (3, 3) of the flange in the arm's base, which stands upright in the world."""
    model = mujoco.MjModel.from_xml_path(str(model_path("robots/ur5e.xml")))
    data = mujoco.MjData(model)
    data.qpos[:] = loop.state.q
    mujoco.mj_kinematics(model, data)
    return np.array(data.site("flange").xmat).reshape(3, 3)
