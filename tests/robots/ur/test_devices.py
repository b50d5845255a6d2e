"""Grippers with sockets and the inputs and outputs of a controller, emulated with real fingers between."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from robots.ur.emulator.grippers import ROBOTIQ_PORT, WSG_PORT
from robots.ur.peer import Peer
from skillc_runtime.backends.devices.fingers import FingerDevice, Fingers
from skillc_runtime.backends.devices.robotiq import RobotiqFingers
from skillc_runtime.backends.devices.wsg import WsgFingers
from skillc_runtime.backends.simulation.scene_spec import GripperSpec
from skillc_runtime.backends.ur.cell import TERMINALS, Wire, WiredPoint
from skillc_runtime.backends.ur.io import UrIo
from skillc_runtime.devices.arm import NotOffered
from skillc_runtime.devices.backend import BackendUnavailable
from skillc_runtime.motion.pose import Pose
from waiting import wait_until

pytestmark = [pytest.mark.robot, pytest.mark.slow]

FACTS = GripperSpec("hand", Path("none.xml"), 0.11, 80.0, 0.05, opening_bias_m=0.001)
THING = "http://example.org/lab#Eraser-1"
HERE = Pose.of((0.0, 0.0, 0.0))
KINDS = ["robotiq", "wsg"]


def device_of(kind: str, peer: Peer) -> FingerDevice:
    if kind == "robotiq":
        return RobotiqFingers("Hand-1", f"{peer.host}:{ROBOTIQ_PORT}", FACTS)
    return WsgFingers("Hand-1", f"{peer.host}:{WSG_PORT}", FACTS)


@pytest.fixture(params=KINDS)
def hand(request: pytest.FixtureRequest, peer: Peer) -> Iterator[tuple[Fingers, list[object]]]:
    """A gripper, open, and what its arm was told."""
    told: list[object] = []
    device = device_of(request.param, peer)
    fingers = Fingers(device, FACTS, lambda *held: told.append(held), lambda: told.append(None))
    move(fingers, 0.08)
    yield fingers, told
    peer.do("block", thing="")
    move(fingers, 0.08)
    fingers.close()


def move(fingers: Fingers, opening_m: float, force_n: float = 30.0) -> None:
    fingers.move(opening_m, force_n)
    assert fingers.moving
    wait_until(lambda: not fingers.moving)


def test_fingers_open_and_close_on_nothing(hand: tuple[Fingers, list[object]], peer: Peer) -> None:
    fingers, told = hand
    move(fingers, 0.05)
    assert fingers.opening_m == pytest.approx(0.05, abs=0.002)
    assert peer.tell()["opening_m"] == pytest.approx(0.05, abs=0.002)
    move(fingers, 0.0)
    assert (fingers.blocked, fingers.opening_m < 0.002) == (False, True)
    with pytest.raises(RuntimeError, match="nothing keeps the fingers of Hand-1"):
        fingers.attach(THING, HERE, 0.1)
    assert told == []


def test_a_grasp_holds_and_its_loss_is_told(hand: tuple[Fingers, list[object]], peer: Peer) -> None:
    fingers, told = hand
    peer.do("block", thing=THING)
    move(fingers, 0.0)
    assert fingers.blocked
    assert fingers.opening_m == pytest.approx(0.025, abs=0.003)
    fingers.attach(THING, HERE, 0.12)
    assert (fingers.holding, told) == (THING, [(THING, HERE, 0.12, fingers.opening_m)])
    assert fingers.find_fault() is None
    peer.do("block", thing="")
    wait_until(lambda: fingers.holding is None)
    assert "has lost Eraser-1: its fingers have closed from 2" in (fingers.find_fault() or "")
    fingers.recover()
    assert (fingers.find_fault(), told[1:]) == (None, [None])


def test_fingers_stop(hand: tuple[Fingers, list[object]]) -> None:
    fingers, _ = hand
    fingers.move(0.0, 30.0)
    wait_until(lambda: fingers.opening_m < 0.07)
    fingers.stop()
    wait_until(lambda: not fingers.moving)
    assert fingers.opening_m > 0.01


def test_a_gripper_that_falls_silent_is_named_and_comes_back(hand: tuple[Fingers, list[object]], peer: Peer) -> None:
    fingers, _ = hand
    with peer.paused():
        wait_until(lambda: fingers.find_fault() is not None)
        assert f"Hand-1 at {peer.host}" in (fingers.find_fault() or "")
        assert not fingers.moving
    fingers.recover()
    move(fingers, 0.05)
    assert fingers.find_fault() is None


@pytest.mark.parametrize(("kind", "cure"), [("robotiq", "is the URCap of the gripper installed"), ("wsg", "text")])
def test_a_gripper_that_is_not_there_is_named(kind: str, cure: str) -> None:
    nobody = Peer("127.0.0.98", None)  # type: ignore[arg-type]
    with pytest.raises(BackendUnavailable, match=rf"Hand-1 at 127\.0\.0\.98:\d+ does not answer.*{cure}"):
        Fingers(device_of(kind, nobody), FACTS, lambda *_: None, lambda: None)


def test_inputs_and_outputs_of_the_controller(peer: Peer) -> None:
    io = UrIo("Ur5e-1", peer.host)
    points = {terminal: WiredPoint(io, Wire(terminal, 1)) for terminal in TERMINALS}
    peer.do("input", bits=1 << 1)
    peer.do("analog", values=[0.0, 2.5])
    wait_until(lambda: points["digitalInput"].switched and points["analogInput"].level == 2.5)
    for terminal, level in (("digitalOutput", 1.0), ("analogOutput", 5.0), ("speedSlider", 0.4)):
        points[terminal].set(level)
        wait_until(lambda point=points[terminal], level=level: point.level == pytest.approx(level))  # type: ignore[misc]
    for number in (9, 17):
        io.set_digital_output(number, True)
    wait_until(lambda: io.digital_output(17))
    io.set_digital_output(9, False)
    wait_until(lambda: peer.tell()["outputs"] == 1 << 1 | 1 << 17)
    assert (peer.tell()["analog_outputs"], peer.tell()["slider"]) == ([0.0, 0.5], 0.4)
    points["speedSlider"].set(1.0)
    for terminal in ("digitalOutput", "analogOutput", "speedSlider"):
        with pytest.raises(ValueError, match=r"is set to .*, not to 12"):
            points[terminal].set(12.0)
    with pytest.raises(NotOffered, match="an input is not set"):
        points["digitalInput"].set(1.0)
    with pytest.raises(BackendUnavailable, match="somebody else sets speed_slider_mask"):
        UrIo("Ur5e-1", peer.host)
    io.close()


def test_inputs_of_a_controller_that_falls_silent_are_a_fault_until_they_come_back(peer: Peer) -> None:
    io = UrIo("Ur5e-1", peer.host)
    with peer.paused():
        wait_until(lambda: io.find_fault() is not None)
        assert "the inputs and outputs of Ur5e-1 do not answer" in (io.find_fault() or "")
    io.recover()
    peer.do("input", bits=1 << 3)
    wait_until(lambda: io.digital_input(3))
    assert io.find_fault() is None
    io.close()
